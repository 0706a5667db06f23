// Reads an exported GLB with the Khronos validator and three.js, and compares it with the result
// and with the file that the body came in.
//
//   node check_gltf.mjs EXPORTED.glb EXPECTED.json ORIGINAL|- rigged|still|upright
//
// rigged: joints are posed too; upright: the file is in metres, +Y up, whatever the body came in.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
import { colliderProblems } from './collider_schema.mjs';
import { check, distance, expectedSolids, finish, near, readJson, same, splitGlb } from './files.mjs';
import { THREE, loadScene, turn, vector } from './three_scene.mjs';

const [path, expectedPath, originalPath, frame] = process.argv.slice(2);
const bytes = readFileSync(path);
const expected = readJson(expectedPath);
const upright = frame === 'upright';
const solids = expectedSolids(expected, upright ? expected.upright_from_mesh : null,
  upright ? expected.metres_per_unit : 1);
// 1e-6 m in the file's unit.
const tolerance = upright ? 1e-6 : 1e-6 / expected.metres_per_unit;

async function severities(data) {
  const { issues } = await validator.validateBytes(new Uint8Array(data), { maxIssues: 0 });
  return issues;
}

function checkOriginal(description, binary) {
  const before = splitGlb(readFileSync(originalPath));
  check(binary.subarray(0, before.binary.length).equals(before.binary), 'the binary chunk changed');
  for (const [key, value] of Object.entries(before.description)) {
    if (['extensionsUsed', 'extensions', 'extras', 'buffers', 'scenes'].includes(key)) continue;
    const now = description[key];
    if (!Array.isArray(value)) {
      check(same(value, now), `${key} changed`);
      continue;
    }
    value.forEach((entry, i) => {
      const kept = key === 'nodes' ? { ...now[i], children: entry.children } : now[i];
      check(same(entry, kept), `${key}[${i}] changed`);
      const children = entry.children ?? [];
      check(children.every((c, k) => now[i].children[k] === c), `${key}[${i}].children changed`);
    });
  }
  for (const name of before.description.extensionsUsed ?? []) {
    check(description.extensionsUsed.includes(name), `${name} is no longer declared`);
  }
}

// Where a reader finds the ends of each collider now: by name, centres in the scene, radii.
function findColliders(gltf) {
  const found = new Map();
  const { shapes } = gltf.parser.json.extensions.KHR_implicit_shapes;
  gltf.scene.traverse((object) => {
    const collider = object.userData.gltfExtensions?.KHR_physics_rigid_bodies?.collider;
    if (!collider) return;
    const name = object.userData.name ?? object.name;
    check(!found.has(name), `two colliders are called ${name}`);
    const shape = shapes[collider.geometry.shape];
    const at = (y) => new THREE.Vector3(0, y, 0).applyMatrix4(object.matrixWorld).toArray();
    const half = shape.capsule ? shape.capsule.height / 2 : 0;
    found.set(name, {
      object,
      ends: shape.capsule
        ? [{ center: at(-half), radius: shape.capsule.radiusBottom },
          { center: at(half), radius: shape.capsule.radiusTop }]
        : [{ center: at(0), radius: shape.sphere.radius }],
    });
  });
  return found;
}

function checkColliders(found) {
  check(found.size === solids.length, `${found.size} colliders for ${solids.length}`);
  for (const solid of solids) {
    const collider = found.get(solid.name);
    if (!collider) { check(false, `${solid.name} is missing`); continue; }
    check(collider.ends.length === solid.ends.length, `${solid.name} is another shape`);
    solid.ends.forEach((end, i) => {
      near(distance(collider.ends[i].center, end.center), 0, tolerance, `${solid.name} centre ${i}`);
      near(collider.ends[i].radius, end.radius, tolerance, `${solid.name} radius ${i}`);
    });
    const size = new THREE.Vector3().setFromMatrixScale(collider.object.matrixWorld);
    for (const s of size.toArray()) near(s, 1, 1e-5, `${solid.name} is scaled`);
  }
}

// Poses each joint with the reader's own nodes: colliders move rigidly with their joint.
async function checkPosed(gltf, found) {
  const { parser } = gltf;
  const nodes = await Promise.all(expected.joints.map((j) => parser.getDependency('node', j.node)));
  const before = nodes.map((node) => node.matrixWorld.clone().invert());
  const places = new Map([...found].map(([name, c]) => [name, c.ends.map((e) => vector(e.center))]));
  nodes.forEach(turn);
  gltf.scene.updateMatrixWorld(true);
  let furthest = 0;
  const now = findColliders(gltf);
  for (const solid of solids) {
    const moved = nodes[solid.joint].matrixWorld.clone().multiply(before[solid.joint]);
    now.get(solid.name).ends.forEach((end, i) => {
      const place = places.get(solid.name)[i].clone();
      furthest = Math.max(furthest, distance(place.toArray(), end.center));
      near(place.applyMatrix4(moved).distanceTo(vector(end.center)), 0, 10 * tolerance,
        `${solid.name} after posing`);
    });
  }
  check(furthest > 0.1 / expected.metres_per_unit, 'posing moved next to nothing');
}

const { description, binary } = splitGlb(bytes);
const issues = await severities(bytes);
const known = originalPath === '-' ? { numErrors: 0, numWarnings: 0 }
  : await severities(readFileSync(originalPath));
for (const message of issues.messages) if (message.severity === 0) console.error(message);
near(issues.numErrors, 0, 0, 'errors of the validator');
check(issues.numWarnings <= known.numWarnings, `${issues.numWarnings} warnings of the validator`);
if (issues.numWarnings > 0) console.log(`${issues.numWarnings} warnings, all the original's own`);
for (const problem of colliderProblems(description)) check(false, problem);
if (originalPath !== '-') checkOriginal(description, binary);
const gltf = await loadScene(bytes);
const found = findColliders(gltf);
checkColliders(found);
if (frame === 'rigged') await checkPosed(gltf, found);
finish(`${path}: ${found.size} colliders`);
