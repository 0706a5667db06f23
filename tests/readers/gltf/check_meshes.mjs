// Reads exported meshes with three.js and the Khronos validator, and compares them with the result.
//
//   node check_meshes.mjs STEM EXPECTED.json hulls|union      (STEM.obj and STEM.glb)
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { check, expectedSolids, finish, near, readJson, signedDistance } from './files.mjs';
import { surfacePoints } from './hulls.mjs';
import { THREE, loadScene } from './three_scene.mjs';

const [stem, expectedPath, kind] = process.argv.slice(2);
const expected = readJson(expectedPath);
const solids = expectedSolids(expected, expected.upright_from_mesh, expected.metres_per_unit);
// Of the radius, with 32 segments around the axis.
const DEVIATION = 1 / Math.cos(Math.PI / 32) ** 2 - 1;

// Triangles as points, in the scene.
function trianglesOf(mesh) {
  const geometry = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry;
  const { array } = geometry.getAttribute('position');
  const points = [];
  for (let i = 0; i < array.length; i += 3) {
    points.push(new THREE.Vector3(...array.slice(i, i + 3)).applyMatrix4(mesh.matrixWorld));
  }
  return Array.from({ length: points.length / 3 }, (_, t) => points.slice(3 * t, 3 * t + 3));
}

// Every edge belongs to two triangles that run it in opposite directions. Returns the volume.
function checkClosed(name, triangles) {
  const key = (p) => p.toArray().map((v) => Math.round(v * 1e8)).join();
  const edges = new Map();
  for (const triangle of triangles) {
    const corners = triangle.map(key);
    corners.forEach((corner, i) => {
      const edge = `${corner}>${corners[(i + 1) % 3]}`;
      edges.set(edge, (edges.get(edge) ?? 0) + 1);
    });
  }
  let open = 0;
  for (const [edge, count] of edges) {
    if (edges.get(edge.split('>').reverse().join('>')) !== count) open += 1;
  }
  check(open === 0, `${name} has ${open} open edges`);
  const volume = triangles.reduce((sum, [a, b, c]) => sum + a.dot(b.clone().cross(c)) / 6, 0);
  check(volume > 0, `${name} has the volume ${volume}`);
  return volume;
}

function checkHull(solid, triangles) {
  checkClosed(solid.name, triangles);
  const points = surfacePoints(solid.ends, 1).map((p) => new THREE.Vector3(...p));
  let out = -Infinity;
  for (const [a, b, c] of triangles) {
    const normal = b.clone().sub(a).cross(c.clone().sub(a));
    if (normal.length() < 1e-12) continue;
    normal.normalize();
    for (const point of points) out = Math.max(out, point.clone().sub(a).dot(normal));
  }
  check(out <= 1e-6, `${solid.name} sticks out of its mesh by ${out}`);
  const largest = DEVIATION * Math.max(...solid.ends.map((e) => e.radius));
  for (const corner of triangles.flat()) {
    const off = signedDistance(solid.ends, corner.toArray());
    check(off > -1e-6 && off <= largest + 1e-6, `${solid.name} is off by ${off}`);
  }
}

function checkUnion(triangles) {
  const volume = checkClosed('the union', triangles);
  const off = ({ x, y, z }) => {
    let least = Infinity;
    for (const solid of solids) least = Math.min(least, signedDistance(solid.ends, [x, y, z]));
    return least;
  };
  const corners = triangles.flat().filter((_, i) => i % 7 === 0);
  const middles = triangles.map(([a, b, c]) => a.clone().add(b).add(c).divideScalar(3));
  const ofMiddles = middles.map(off);
  const depth = -Math.min(...corners.map(off), ...ofMiddles);
  check(depth < 2e-4, `the union's mesh dips into it by ${depth}`);
  const far = ofMiddles.filter((d) => d > 2e-3).length / middles.length;
  check(far < 0.05, `${far} of the union's faces lie more than 2 mm outside`);
  // The true volume, by evenly strewn points.
  const box = new THREE.Box3().setFromPoints(corners);
  const size = box.getSize(new THREE.Vector3());
  let inside = 0;
  const POINTS = 60000;
  for (let i = 1; i <= POINTS; i += 1) {
    const at = new THREE.Vector3(halton(i, 2), halton(i, 3), halton(i, 5)).multiply(size);
    if (off(at.add(box.min)) < 0) inside += 1;
  }
  near(volume / ((inside / POINTS) * size.x * size.y * size.z), 1.01, 0.012, 'volume of the union');
}

function halton(index, base) {
  let value = 0;
  for (let i = index, f = 1 / base; i > 0; i = Math.floor(i / base), f /= base) value += f * (i % base);
  return value;
}

const bytes = readFileSync(`${stem}.glb`);
const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 0 });
near(issues.numErrors, 0, 0, 'errors of the validator');
near(issues.numWarnings, 0, 0, 'warnings of the validator');
const gltf = await loadScene(bytes);
const fromGlb = [];
gltf.scene.traverse((object) => { if (object.isMesh) fromGlb.push(object); });
const fromObj = new OBJLoader().parse(readFileSync(`${stem}.obj`, 'utf8')).children;
check(fromObj.length === fromGlb.length, `${fromObj.length} groups, ${fromGlb.length} nodes`);
fromGlb.forEach((mesh, m) => {
  const [a, b] = [mesh, fromObj[m]].map(trianglesOf);
  check((mesh.userData.name ?? mesh.name) === fromObj[m].name, `${mesh.name}, ${fromObj[m].name}`);
  const [left, right] = [a.flat(), b.flat()];
  check(left.length === right.length && left.every((p, i) => p.distanceTo(right[i]) < 1e-6),
    `${mesh.name} differs in its two files`);
  if (kind === 'union') return checkUnion(b);
  check(fromObj[m].name === solids[m].name, `${fromObj[m].name} is not ${solids[m].name}`);
  checkHull(solids[m], b);
});
check(fromObj.length === (kind === 'union' ? 1 : solids.length), `${fromObj.length} meshes`);
finish(`${stem}: ${fromObj.length} meshes`);
