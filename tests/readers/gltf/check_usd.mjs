// Reads an exported USD layer with TinyUSDZ, takes the text that it writes again, and compares what
// stands there with the result.
//
//   node check_usd.mjs EXPORTED.usda EXPECTED.json tapered|uniform
import { copyFileSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { check, distance, expectedSolids, finish, near, readJson } from './files.mjs';
import { coverageProblems } from './hulls.mjs';
import { THREE } from './three_scene.mjs';

const [path, expectedPath, profile] = process.argv.slice(2);
const expected = readJson(expectedPath);
const [solids, posed] = [false, true].map((isPosed) =>
  expectedSolids(expected, expected.upright_from_mesh, expected.metres_per_unit, isPosed));

// The package is made for browsers: it wants to be a module, and not to know where it is.
async function readLayer(text) {
  const folder = dirname(createRequire(import.meta.url).resolve('tinyusdz/package.json'));
  const scratch = mkdtempSync(join(tmpdir(), 'tinyusdz-'));
  try {
    copyFileSync(join(folder, 'tinyusdz.js'), join(scratch, 'tinyusdz.mjs'));
    Object.defineProperty(process, 'type', { value: 'renderer' });
    globalThis.WorkerGlobalScope ??= class {};
    const { default: start } = await import(join(scratch, 'tinyusdz.mjs'));
    const module = await start({ wasmBinary: readFileSync(join(folder, 'tinyusdz.wasm')) });
    const loader = new module.TinyUSDZLoaderNative();
    check(loader.loadAsLayerFromBinary(text, 'layer.usda'), `TinyUSDZ: ${loader.error?.()}`);
    return loader.layerToString();
  } finally {
    rmSync(scratch, { recursive: true });
  }
}

const numbers = (text) => text.match(/-?[\d.]+(?:e[-+]?\d+)?/g).map(Number);

// Prims with their attributes and the place of each in the scene.
function primsOf(text) {
  const prims = [];
  const open = [];
  let next = null;
  for (const line of text.split('\n').map((l) => l.trim())) {
    const def = line.match(/^def (\w+) "(.*)"/);
    const value = line.match(/^(?:custom |uniform )*[\w[\]]+ ([\w:]+) = (.*)$/);
    if (def) next = { type: def[1], name: def[2], parent: open.at(-1) };
    if (line === '{' && next) { prims.push(next); open.push(next); next = null; }
    if (line === '}') open.pop();
    if (value && open.length > 0 && !next) open.at(-1)[value[1]] = value[2];
  }
  for (const prim of prims) {
    prim.place = new THREE.Matrix4();
    if (prim['xformOp:translate']) {
      const [w, x, y, z] = numbers(prim['xformOp:orient']);
      prim.place.compose(new THREE.Vector3(...numbers(prim['xformOp:translate'])),
        new THREE.Quaternion(x, y, z, w), new THREE.Vector3(1, 1, 1));
      check(prim.xformOpOrder.replace(/\s/g, '') === '["xformOp:translate","xformOp:orient"]',
        `${prim.name}: ${prim.xformOpOrder}`);
    }
    if (prim.parent) prim.place.premultiply(prim.parent.place);
  }
  return prims;
}

// The Xform that a joint's prims are below, moved as the joint moves in the pose.
function movedBy(joint) {
  if (!joint) return new THREE.Matrix4();
  const { position, rotation } = joint.moved_upright;
  return new THREE.Matrix4().compose(new THREE.Vector3(...position),
    new THREE.Quaternion(...rotation), new THREE.Vector3(1, 1, 1));
}

function endsOf(prim, moved = new THREE.Matrix4()) {
  const place = moved.clone().multiply(prim.place);
  const at = (y) => new THREE.Vector3(0, y, 0).applyMatrix4(place).toArray();
  const of = (key) => Number(prim[key]);
  if (prim.type === 'Sphere') return [{ center: at(0), radius: of('radius') }];
  check(prim.axis === '"Y"' && of('height') > 0, `${prim.name}: ${prim.axis}, ${prim.height}`);
  const [low, high] = prim.type === 'Capsule_1' ? ['radiusBottom', 'radiusTop'] : ['radius', 'radius'];
  return [{ center: at(-of('height') / 2), radius: of(low) },
    { center: at(of('height') / 2), radius: of(high) }];
}

function checkExtent(prim) {
  const [x0, y0, z0, x1, y1, z1] = numbers(prim.extent);
  const radius = Math.max(...endsOf(prim).map((e) => e.radius));
  const [low, high] = [endsOf(prim)[0], endsOf(prim).at(-1)];
  const half = prim.type === 'Sphere' ? 0 : Number(prim.height) / 2;
  const box = [-radius, -half - low.radius, -radius, radius, half + high.radius, radius];
  [x0, y0, z0, x1, y1, z1].forEach((v, i) => near(v, box[i], 1e-6, `${prim.name} extent ${i}`));
}

const bytes = readFileSync(path);
const text = await readLayer(bytes);
check(/metersPerUnit = 1\b/.test(text) && /upAxis = "Y"/.test(text), 'unit or axis is lost');
const prims = primsOf(text);
const colliders = prims.filter((prim) => prim.type !== 'Xform');
const jointsUsed = new Set(solids.map((s) => s.joint));
check(prims.length - colliders.length === jointsUsed.size + 1, 'not one Xform a joint');
// What TinyUSDZ does not write back.
const schemas = bytes.toString().match(/prepend apiSchemas = \["PhysicsCollisionAPI"\]/g) ?? [];
check(schemas.length === colliders.length, `${schemas.length} colliders of ${colliders.length}`);
const known = profile === 'tapered' ? ['Sphere', 'Capsule_1'] : ['Sphere', 'Capsule'];
colliders.forEach(checkExtent);
for (const [s, solid] of solids.entries()) {
  const own = colliders.filter((prim) => prim['capfit:name'] === JSON.stringify(solid.name));
  const joint = expected.joints[solid.joint]?.name;
  for (const prim of own) {
    check(known.includes(prim.type), `${prim.name} is a ${prim.type}`);
    check(prim.parent['capfit:joint'] === (joint && JSON.stringify(joint)), `${prim.name} hangs wrong`);
  }
  for (const [isPosed, wanted] of [[false, solid], [true, posed[s]]]) {
    const ends = own.map((prim) => endsOf(prim, isPosed ? movedBy(expected.joints[solid.joint]) : undefined));
    if (profile === 'uniform') {
      for (const problem of coverageProblems(wanted, ends, 0.005, 1)) check(false, problem);
      continue;
    }
    check(ends.length === 1, `${ends.length} prims for ${solid.name}`);
    ends[0].forEach((end, i) => {
      near(distance(end.center, wanted.ends[i].center), 0, 1e-6, `${solid.name} centre ${i}`);
      near(end.radius, wanted.ends[i].radius, 1e-6, `${solid.name} radius ${i}`);
    });
  }
}
finish(`${path}: ${colliders.length} colliders`);
