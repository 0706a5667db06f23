// Reads an exported VRM with the Khronos validator and three-vrm, and compares it with the result.
//
//   node check_vrm.mjs EXPORTED.vrm EXPECTED.json ORIGINAL.vrm
//
// Of what came from one capsule: its union contains the capsule, and stands out by 5 mm at most.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
import { VRMLoaderPlugin } from '@pixiv/three-vrm';
import { check, distance, expectedSolids, finish, near, readJson, same, splitGlb } from './files.mjs';
import { coverageProblems } from './hulls.mjs';
import { THREE, loadScene, pose, vector } from './three_scene.mjs';

const OVERSHOOT_M = 0.005;
const [path, expectedPath, originalPath] = process.argv.slice(2);
const bytes = readFileSync(path);
const expected = readJson(expectedPath);
const solids = expectedSolids(expected, null, 1);
const unit = 1 / expected.metres_per_unit;
const tolerance = 1e-6 * unit;

const endsOf = (collider) => {
  const { shape } = collider;
  const at = (p) => p.clone().applyMatrix4(collider.matrixWorld).toArray();
  const head = { center: at(shape.offset), radius: shape.radius };
  return shape.type === 'capsule' ? [head, { center: at(shape.tail), radius: shape.radius }] : [head];
};

// Colliders as the file lists them: [node, name of the solid or nothing].
function listedColliders(description) {
  const second = description.extensions.VRMC_springBone;
  if (second) return second.colliders.map((c) => [c.node, c.extras?.capfit]);
  const groups = description.extensions.VRM.secondaryAnimation.colliderGroups;
  const first = groups.length - solids.length;
  return groups.flatMap((g, i) => g.colliders.map(() => [g.node, solids[i - first]?.name]));
}

// The new colliders by the name of their solid. three-vrm hangs them below their nodes, in the
// file's order.
async function ownColliders(gltf, description) {
  const own = new Map(solids.map((s) => [s.name, []]));
  const seen = new Map();
  for (const [index, name] of listedColliders(description)) {
    const node = await gltf.parser.getDependency('node', index);
    const nth = seen.get(index) ?? 0;
    seen.set(index, nth + 1);
    const collider = node.children.filter((child) => child.colliderMatrix)[nth];
    check(collider, `node ${index} has no collider ${nth}`);
    if (name !== undefined) own.get(name).push(collider);
  }
  return own;
}

function checkCoverage(own) {
  for (const solid of solids) {
    const pieces = own.get(solid.name).map(endsOf);
    for (const problem of coverageProblems(solid, pieces, OVERSHOOT_M * unit, unit)) {
      check(false, problem);
    }
  }
}

// At rest none of a spring's moving joints touches what it collides with, and so nothing moves.
function checkSprings(vrm, own) {
  const names = new Set([...own.values()].flat());
  const joined = new Map();
  for (const joint of vrm.springBoneManager.joints) {
    const name = joint.bone.name.split('_')[0];
    const colliders = joint.colliderGroups.flatMap((g) => g.colliders).filter((c) => names.has(c));
    joined.set(name, colliders.length);
    const tail = (joint.child ?? joint.bone).getWorldPosition(new THREE.Vector3());
    for (const collider of joint.child ? colliders : []) {
      const apart = collider.shape.calculateCollision(collider.colliderMatrix, tail,
        joint.settings.hitRadius, new THREE.Vector3());
      check(apart >= -tolerance, `${joint.bone.name} lies in a collider by ${-apart}`);
    }
  }
  check(joined.get('tail') === names.size, `the free spring has ${joined.get('tail')} colliders`);
  check(joined.get('hair') > 0 && joined.get('hair') < names.size, `${joined.get('hair')} at hair`);
  const joints = [...vrm.springBoneManager.joints];
  const tips = joints.map((j) => j.bone.getWorldPosition(new THREE.Vector3()));
  for (let frame = 0; frame < 60; frame += 1) vrm.springBoneManager.update(1 / 60);
  vrm.scene.updateMatrixWorld(true);
  joints.forEach((joint, i) => {
    const moved = joint.bone.getWorldPosition(new THREE.Vector3()).distanceTo(tips[i]);
    check(moved < 1e-4 * unit, `${joint.bone.name} moved by ${moved} at rest`);
  });
}

// Each piece moves as `animate` moves its joint.
async function checkPosed(gltf, own) {
  const nodes = await Promise.all(
    expected.joints.map((j) => gltf.parser.getDependency('node', j.node)));
  const rest = new Map([...own].map(([name, colliders]) => [name, colliders.map(endsOf)]));
  pose(gltf.scene, nodes, expected.joints);
  const matrix = ([x, y, z]) => new THREE.Matrix4().set(...x, ...y, ...z, 0, 0, 0, 1);
  const posed = expectedSolids(expected, null, 1, true);
  let furthest = 0;
  solids.forEach((solid, s) => {
    const { to_mesh: before, posed: after } = expected.joints[solid.joint];
    const moved = matrix(after).multiply(matrix(before).invert());
    const now = own.get(solid.name).map(endsOf);
    now.flat().forEach((end, i) => {
      const place = vector(rest.get(solid.name).flat()[i].center);
      furthest = Math.max(furthest, distance(place.toArray(), end.center));
      near(place.applyMatrix4(moved).distanceTo(vector(end.center)), 0, 10 * tolerance,
        `${solid.name} after posing`);
    });
    for (const problem of coverageProblems(posed[s], now, OVERSHOOT_M * unit, unit)) {
      check(false, `after posing: ${problem}`);
    }
  });
  check(furthest > 0.1 * unit, 'posing moved next to nothing');
}

function checkAuthored(description) {
  const before = splitGlb(readFileSync(originalPath)).description.extensions;
  const [was, now] = [before, description.extensions].map((e) =>
    e.VRMC_springBone ?? e.VRM.secondaryAnimation);
  for (const key of ['colliders', 'colliderGroups']) {
    (was[key] ?? []).forEach((entry, i) => {
      check(same(entry, now[key][i]), `${key}[${i}] changed`);
    });
  }
  const springs = (e) => e.springs ?? e.boneGroups;
  springs(was).forEach((spring, i) => {
    check(springs(now)[i].colliderGroups.slice(0, 1)[0] === spring.colliderGroups[0],
      `spring ${i} lost its own group`);
  });
}

const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 0 });
const known = (await validator.validateBytes(new Uint8Array(readFileSync(originalPath)))).issues;
for (const message of issues.messages) if (message.severity === 0) console.error(message);
near(issues.numErrors, 0, 0, 'errors of the validator');
check(issues.numWarnings <= known.numWarnings, `${issues.numWarnings} warnings of the validator`);
const gltf = await loadScene(bytes, [(parser) => new VRMLoaderPlugin(parser)]);
const { vrm } = gltf.userData;
check(vrm?.springBoneManager, 'three-vrm found no springs');
const { description } = splitGlb(bytes);
checkAuthored(description);
const own = await ownColliders(gltf, description);
checkCoverage(own);
checkSprings(vrm, own);
await checkPosed(gltf, own);
finish(`${path}: ${[...own.values()].flat().length} colliders for ${solids.length}`);
