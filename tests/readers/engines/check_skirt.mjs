// Hangs a skirt on the colliders of jolt_colliders.json in Jolt, lets it settle, swings the legs by 25
// degrees about the hips, and looks at every frame: no vertex may be more than 1 mm inside of the
// result's solids, and the skirt must touch them (one that fell off is nowhere inside either).
//
//   node check_skirt.mjs FOLDER [FRAMES.json]     writes some frames for a picture
import { writeFileSync } from 'node:fs';
import { check, distance, finish, readJson, signedDistance } from '../gltf/files.mjs';
import {
  add, multiply, rotate, subtract, turnAboutX, uprightSolids,
} from './geometry.mjs';
import { addBody, makeWorld, moveBody } from './jolt_world.mjs';
import { COLUMNS, FACES, ROWS, STEPS, VERTEX_RADIUS, addSkirt, skirtPoints } from './skirt.mjs';

const FRAME = 1 / 60;
const SETTLING = 180;
const SWINGING = 216; // three periods
const PERIOD = 1.2;
const SWING = (25 * Math.PI) / 180;
const ALLOWED_INSIDE = 1e-3;
const TOUCHING = VERTEX_RADIUS + 2e-3;
const LEG = /^(left|right)_(thigh|knee|calf|ankle|foot|toe)/;

const [folder, framesPath] = process.argv.slice(2);
const file = readJson(`${folder}/jolt_colliders.json`);
const solids = uprightSolids(folder);

// A solid swings with a leg where all its spheres are of that leg.
function sideOf(shape) {
  const sides = shape.spheres.map((name) => LEG.exec(name)?.[1]);
  return sides.every((side) => side && side === sides[0]) ? sides[0] : null;
}

// The hip is where the topmost sphere of the leg is.
function hipOf(side) {
  const own = solids.filter((_, i) => sideOf(file.shapes[i]) === side).flatMap((s) => s.ends);
  return own.reduce((top, end) => (end.center[1] > top.center[1] ? end : top)).center;
}

const world = makeWorld();
const parts = file.shapes.map((shape, i) => ({
  ...addBody(world, file, shape), side: sideOf(shape), ends: solids[i].ends,
}));
const hips = { left: hipOf('left'), right: hipOf('right') };
const trunk = solids.filter((_, i) => file.shapes[i].spheres.every((n) => !/arm|hand/.test(n)));
const middle = [(hips.left[0] + hips.right[0]) / 2, 0, (hips.left[2] + hips.right[2]) / 2];
const waist = (hips.left[1] + hips.right[1]) / 2 + 0.18;
const skirt = addSkirt(world, trunk, [middle[0], middle[2]], waist);

// A frame after the leg turned about the hip, about the body's own left-right axis.
function swung(frame, side, angle) {
  const turn = turnAboutX(side === 'left' ? angle : -angle);
  return {
    position: add(hips[side], rotate(turn, subtract(frame.position, hips[side]))),
    rotation: multiply(turn, frame.rotation),
  };
}
function pose(angle) {
  for (const part of parts) {
    if (!part.side) continue;
    moveBody(world, part.id, swung(part.place, part.side, angle), FRAME);
  }
}
function posedEnds(angle) {
  return parts.map((part) => (!part.side ? part.ends : part.ends.map((end) => ({
    center: swung({ position: end.center, rotation: [0, 0, 0, 1] }, part.side, angle).position,
    radius: end.radius,
  }))));
}

// The ball around a solid, by which most of them are known to be far from a vertex.
function withBall(ends) {
  const [a, b = a] = ends;
  const center = add(a.center, b.center).map((x) => x / 2);
  return { ends, center, radius: distance(a.center, center) + Math.max(a.radius, b.radius) };
}
// Of all vertices: how deep the worst is inside, and how many touch.
function measure(points, posed) {
  const balls = posed.map(withBall);
  let least = Infinity;
  let touching = 0;
  for (const point of points) {
    let nearest = Infinity;
    for (const { ends, center, radius } of balls) {
      if (distance(point, center) - radius >= nearest) continue;
      nearest = Math.min(nearest, signedDistance(ends, point));
    }
    least = Math.min(least, nearest);
    if (nearest <= TOUCHING) touching += 1;
  }
  return { inside: -least, touching };
}
function worstStretch(points) {
  let worst = 0;
  for (const [a, b, c] of FACES) {
    for (const [i, j] of [[a, b], [b, c], [c, a]]) {
      worst = Math.max(worst, distance(points[i], points[j]) / distance(skirt.sewn[i], skirt.sewn[j]));
    }
  }
  return worst;
}

check(skirt.sewn.length === 8000 && ROWS * COLUMNS === 8000, 'the skirt has 8,000 vertices');
const start = measure(skirt.sewn, posedEnds(0));
check(start.inside < 0, `the skirt is sewn ${start.inside} m inside of the body`);
let worst = -Infinity;
let touching = [Infinity, 0];
let stretch = 0;
let milliseconds = 0;
const kept = [];
for (let frame = 0; frame < SETTLING + SWINGING; ++frame) {
  const time = Math.max(0, frame + 1 - SETTLING) * FRAME;
  const angle = SWING * Math.sin((2 * Math.PI * time) / PERIOD);
  pose(angle);
  const before = performance.now();
  world.jolt.Step(FRAME, STEPS);
  milliseconds += performance.now() - before;
  const points = skirtPoints(skirt);
  const ends = posedEnds(angle);
  const { inside, touching: count } = measure(points, ends);
  worst = Math.max(worst, inside);
  if (frame >= SETTLING - 1) touching = [Math.min(touching[0], count), Math.max(touching[1], count)];
  if (frame % 6 === 5) stretch = Math.max(stretch, worstStretch(points));
  if ([SETTLING - 1, SETTLING + 17, SETTLING + 53].includes(frame)) kept.push({ points, ends });
}
check(skirtPoints(skirt).every((p) => p.every(Number.isFinite)), 'every vertex is somewhere');
check(worst <= ALLOWED_INSIDE, `a vertex was ${worst * 1e3} mm inside`);
check(touching[0] >= 20, `only ${touching[0]} vertices touched the body`);
check(stretch < 2, `an edge was stretched ${stretch} times`);
if (framesPath) writeFileSync(framesPath, JSON.stringify({ faces: FACES, frames: kept }));
finish(`skirt: deepest ${(worst * 1e3).toFixed(3)} mm, touching ${touching[0]} to ${touching[1]}, ` +
  `stretch ${stretch.toFixed(2)}, ${(milliseconds / (SETTLING + SWINGING)).toFixed(1)} ms a frame`);
