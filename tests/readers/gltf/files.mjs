// Files and points for the checks of this folder.
import { readFileSync } from 'node:fs';

export const readJson = (path) => JSON.parse(readFileSync(path, 'utf8'));

// The description and the binary chunk of a GLB.
export function splitGlb(bytes) {
  const length = bytes.readUInt32LE(12);
  const description = JSON.parse(bytes.subarray(20, 20 + length).toString('utf8'));
  const rest = bytes.subarray(20 + length);
  const binary = rest.length < 8 ? Buffer.alloc(0) : rest.subarray(8, 8 + rest.readUInt32LE(0));
  return { description, binary };
}

export function joinGlb(description, binary) {
  const text = Buffer.from(JSON.stringify(description));
  const json = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const data = Buffer.concat([binary, Buffer.alloc(-binary.length & 3)]);
  const header = Buffer.alloc(20);
  header.write('glTF');
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(28 + json.length + data.length, 8);
  header.writeUInt32LE(json.length, 12);
  header.write('JSON', 16);
  const second = Buffer.alloc(8);
  second.writeUInt32LE(data.length, 0);
  second.write('BIN\0', 4);
  return Buffer.concat([header, json, second, data]);
}

// (Math.hypot takes ten times as long.)
const norm = (x, y, z) => Math.sqrt(x * x + y * y + z * z);
export const distance = (a, b) => norm(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

// The exact signed distance from a point to the hull of one sphere or two, negative inside. Called
// some million times: no arrays of its own.
export function signedDistance(ends, p) {
  const a = ends[0];
  const x = p[0] - a.center[0];
  const y = p[1] - a.center[1];
  const z = p[2] - a.center[2];
  const fromA = norm(x, y, z);
  if (ends.length === 1) return fromA - a.radius;
  const b = ends[1];
  const axisX = b.center[0] - a.center[0];
  const axisY = b.center[1] - a.center[1];
  const axisZ = b.center[2] - a.center[2];
  const length = norm(axisX, axisY, axisZ);
  const sine = (a.radius - b.radius) / length;
  const cosine = Math.sqrt(1 - sine * sine);
  const along = (x * axisX + y * axisY + z * axisZ) / length;
  const across = Math.sqrt(Math.max(0, fromA * fromA - along * along));
  const slant = cosine * along - sine * across;
  if (slant <= 0) return fromA - a.radius;
  if (slant >= cosine * length) return distance(b.center, p) - b.radius;
  return cosine * across + sine * along - a.radius;
}

// Three rows of four times a point.
export const applyRows = (rows, p) =>
  rows.map((r) => r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3]);

// What is expected in a frame that `rows` lead to, which scale by `scale`, at rest or in the pose:
// each solid with its name, joint, and one sphere or two. A capsule of which one end contains the
// other is a sphere.
export function expectedSolids(expected, rows, scale, isPosed = false) {
  const to = (p) => (rows ? applyRows(rows, p) : p);
  const spheres = expected.spheres.map((s) => ({
    ...s,
    center: to(isPosed ? s.posed_center : s.center),
    radius: s.radius * scale,
  }));
  const solids = expected.capsules.map((c) => {
    const [a, b] = c.spheres.map((i, k) => (
      isPosed ? { ...spheres[i], center: to(c.posed_centers[k]) } : spheres[i]));
    const ends = distance(a.center, b.center) <= Math.abs(a.radius - b.radius)
      ? [a.radius >= b.radius ? a : b] : [a, b];
    return { name: c.name, joint: c.joint, ends };
  });
  for (const s of spheres) if (s.lone) solids.push({ name: s.name, joint: s.joint, ends: [s] });
  return solids;
}

// Whether two values of JSON are equal, in whatever order their members come.
export function same(a, b) {
  if (Array.isArray(a)) {
    return Array.isArray(b) && a.length === b.length && a.every((entry, i) => same(entry, b[i]));
  }
  if (a === null || b === null || typeof a !== 'object' || typeof b !== 'object') return a === b;
  const keys = (o) => Object.keys(o).filter((key) => o[key] !== undefined);
  return keys(a).length === keys(b).length && keys(a).every((key) => same(a[key], b[key]));
}

let failures = 0;
// Says what is wrong; the program ends with 1 where it was called (see finish).
export function check(is_so, message) {
  if (is_so) return;
  failures += 1;
  if (failures <= 20) console.error(`FAILED: ${message}`);
}
export function near(a, b, tolerance, message) {
  check(Math.abs(a - b) <= tolerance, `${message}: ${a} for ${b}`);
}
export function finish(message) {
  console.log(failures === 0 ? `ok: ${message}` : `${failures} failures: ${message}`);
  process.exit(failures === 0 ? 0 : 1);
}
