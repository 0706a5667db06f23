// Builds the shapes of rapier_colliders.json in Rapier. Balls and capsules must be the result's; a
// convex hull must hold its capsule and reach out no further than the file says.
//
//   node check_rapier.mjs FOLDER
import RAPIER from '@dimforge/rapier3d-compat';
import { check, distance, finish, near, readJson } from '../gltf/files.mjs';
import { add, compose, directions, dot, jointOf, reach, rotate, uprightSolids } from './geometry.mjs';

const TOLERANCE = 1e-6;
const folder = process.argv[2];
const file = readJson(`${folder}/rapier_colliders.json`);
const solids = uprightSolids(folder);
await RAPIER.init();
const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 });

function descriptionOf(shape) {
  if (shape.shape === 'ball') return RAPIER.ColliderDesc.ball(shape.radius);
  if (shape.shape === 'capsule') return RAPIER.ColliderDesc.capsule(shape.half_height, shape.radius);
  return RAPIER.ColliderDesc.convexHull(new Float32Array(shape.points));
}
const list = ({ x, y, z }) => [x, y, z];

function checkHull(collider, place, solid, shape) {
  const flat = collider.vertices();
  const points = [];
  for (let i = 0; i < flat.length; i += 3) {
    points.push(add(place.position, rotate(place.rotation, Array.from(flat.slice(i, i + 3)))));
  }
  let least = Infinity;
  let most = -Infinity;
  for (const direction of directions(500)) {
    const beyond = Math.max(...points.map((p) => dot(p, direction))) - reach(solid.ends, direction);
    least = Math.min(least, beyond);
    most = Math.max(most, beyond);
  }
  check(least >= -TOLERANCE, `${solid.name}: the hull leaves out ${-least} m`);
  check(most <= shape.deviation + TOLERANCE, `${solid.name}: the hull is ${most} m too large`);
  return most;
}

check(file.shapes.length === solids.length, `${file.shapes.length} shapes for ${solids.length}`);
let largest = 0;
solids.forEach((solid, i) => {
  const shape = file.shapes[i];
  check(shape.name === solid.name, `shape ${i} is ${shape.name}, not ${solid.name}`);
  const wanted = compose(jointOf(file, shape.joint),
    { position: shape.joint_position, rotation: shape.joint_rotation });
  const [x, y, z, w] = wanted.rotation;
  const collider = world.createCollider(
    descriptionOf(shape).setTranslation(...wanted.position).setRotation({ x, y, z, w }));
  const turn = collider.rotation();
  const place = { position: list(collider.translation()), rotation: [turn.x, turn.y, turn.z, turn.w] };
  if (shape.shape === 'convexHull') {
    largest = Math.max(largest, checkHull(collider, place, solid, shape));
    return;
  }
  const up = shape.shape === 'capsule' ? collider.halfHeight() : 0;
  [-up, up].slice(0, solid.ends.length).forEach((height, k) => {
    const center = add(place.position, rotate(place.rotation, [0, height, 0]));
    near(distance(center, solid.ends[k].center), 0, TOLERANCE, `${solid.name}: centre ${k}`);
    near(collider.radius(), solid.ends[k].radius, TOLERANCE, `${solid.name}: radius`);
  });
});
finish(`${solids.length} shapes in Rapier, hulls up to ${(largest * 1e3).toFixed(2)} mm too large`);
