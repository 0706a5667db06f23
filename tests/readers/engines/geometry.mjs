// Points, quaternions (x, y, z, w) and the solids of a set, as the checks of this folder need them.
import { expectedSolids, readJson, signedDistance } from '../gltf/files.mjs';

export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const scale = (a, s) => a.map((x) => x * s);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export function rotate(q, v) {
  const axis = q.slice(0, 3);
  const twice = scale(cross(axis, v), 2);
  return add(add(v, scale(twice, q[3])), cross(axis, twice));
}
// The turn `b`, then the turn `a`.
export const multiply = (a, b) => [
  a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
  a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
  a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
  a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
export const turnAboutX = (angle) => [Math.sin(angle / 2), 0, 0, Math.cos(angle / 2)];

// A frame { position, rotation } of the first one's, seen from where the first one is seen.
export const compose = (outer, inner) => ({
  position: add(outer.position, rotate(outer.rotation, inner.position)),
  rotation: multiply(outer.rotation, inner.rotation),
});

// What the result has, in metres with Y up, at rest or in the pose: each solid with one sphere or two
// { center, radius }.
export function uprightSolids(folder, isPosed = false) {
  const expected = readJson(`${folder}/expected.json`);
  return expectedSolids(expected, expected.upright_from_mesh, expected.metres_per_unit, isPosed);
}

const AT_REST = { position: [0, 0, 0], rotation: [0, 0, 0, 1] };
// How each joint has moved in the pose: frames { position, rotation }, by index; of -1 not at all.
export function jointMoves(folder) {
  const { joints } = readJson(`${folder}/expected.json`);
  return (index) => (index < 0 ? AT_REST : joints[index].moved_upright);
}

// The frame of a joint as the files of shapes have it; of -1 the one that all is in.
export const jointOf = (file, index) => (index < 0 ? AT_REST : file.joints[index]);

// How far a solid of one sphere or two reaches in a direction of length 1.
export const reach = (ends, direction) =>
  Math.max(...ends.map((end) => dot(end.center, direction) + end.radius));

// Directions all around, evenly.
export function directions(count) {
  return Array.from({ length: count }, (_, i) => {
    const y = 1 - (2 * i + 1) / count;
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    const r = Math.sqrt(1 - y * y);
    return [r * Math.cos(angle), y, r * Math.sin(angle)];
  });
}

// Points of the surface of a solid, evenly over its ends and along its cone.
export function surfacePoints(ends, count) {
  const points = [];
  for (const direction of directions(count)) {
    const at = ends.map((end) => add(end.center, scale(direction, end.radius)));
    for (const point of at) points.push(point);
    if (at.length < 2) continue;
    for (const t of [0.1, 0.3, 0.5, 0.7, 0.9]) points.push(add(scale(at[0], 1 - t), scale(at[1], t)));
  }
  return points.filter((p) => signedDistance(ends, p) > -1e-9);
}
