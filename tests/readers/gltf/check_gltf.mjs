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
import { THREE, loadScene, pose } from './three_scene.mjs';

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

function checkColliders(found, wanted, tolerance) {
  check(found.size === wanted.length, `${found.size} colliders for ${wanted.length}`);
  for (const solid of wanted) {
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

// Poses each joint by the reader's own nodes: colliders are where `animate` has them, and have moved.
async function checkPosed(gltf) {
  const nodes = await Promise.all(
    expected.joints.map((j) => gltf.parser.getDependency('node', j.node)));
  pose(gltf.scene, nodes, expected.joints);
  const posed = expectedSolids(expected, null, 1, true);
  const furthest = Math.max(...posed.map((solid, i) =>
    distance(solid.ends[0].center, solids[i].ends[0].center)));
  check(furthest > 0.1 / expected.metres_per_unit, 'posing moved next to nothing');
  checkColliders(findColliders(gltf), posed, 10 * tolerance);
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
checkColliders(found, solids, tolerance);
if (frame === 'rigged') await checkPosed(gltf);
finish(`${path}: ${found.size} colliders`);
