// Builds the shapes of rapier_colliders.json in Rapier, each on a kinematic body for its joint. Balls and
// capsules must be the result's; a convex hull must hold its capsule and reach out no further than the
// file says: at rest, and after Rapier has moved the bodies with their joints.
//
//   node check_rapier.mjs FOLDER
import RAPIER from '@dimforge/rapier3d-compat';
import { check, distance, finish, near, readJson } from '../gltf/files.mjs';
import {
  add, compose, directions, dot, jointMoves, jointOf, reach, rotate, uprightSolids,
} from './geometry.mjs';

const TOLERANCE = 1e-6;
// Rapier keeps places and turns as floats.
const POSED_TOLERANCE = 5e-6;
const folder = process.argv[2];
const file = readJson(`${folder}/rapier_colliders.json`);
const solids = uprightSolids(folder);
const moves = jointMoves(folder);
await RAPIER.init();
const world = new RAPIER.World({ x: 0, y: -9.81, z: 0 });

function descriptionOf(shape) {
  if (shape.shape === 'ball') return RAPIER.ColliderDesc.ball(shape.radius);
  if (shape.shape === 'capsule') return RAPIER.ColliderDesc.capsule(shape.half_height, shape.radius);
  return RAPIER.ColliderDesc.convexHull(new Float32Array(shape.points));
}
const list = ({ x, y, z }) => [x, y, z];
const turn = ([x, y, z, w]) => ({ x, y, z, w });

// The body that a joint moves; of -1 one that stays.
const bodies = new Map();
function bodyOf(joint) {
  if (!bodies.has(joint)) {
    const { position, rotation } = jointOf(file, joint);
    bodies.set(joint, world.createRigidBody(RAPIER.RigidBodyDesc.kinematicPositionBased()
      .setTranslation(...position).setRotation(turn(rotation))));
  }
  return bodies.get(joint);
}

function checkHull(collider, place, solid, shape, tolerance) {
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
  check(least >= -tolerance, `${solid.name}: the hull leaves out ${-least} m`);
  check(most <= shape.deviation + tolerance, `${solid.name}: the hull is ${most} m too large`);
  return most;
}

function checkCollider(collider, shape, solid, tolerance) {
  const { x, y, z, w } = collider.rotation();
  const place = { position: list(collider.translation()), rotation: [x, y, z, w] };
  if (shape.shape === 'convexHull') {
    largest = Math.max(largest, checkHull(collider, place, solid, shape, tolerance));
    return;
  }
  const up = shape.shape === 'capsule' ? collider.halfHeight() : 0;
  [-up, up].slice(0, solid.ends.length).forEach((height, k) => {
    const center = add(place.position, rotate(place.rotation, [0, height, 0]));
    near(distance(center, solid.ends[k].center), 0, tolerance, `${solid.name}: centre ${k}`);
    near(collider.radius(), solid.ends[k].radius, TOLERANCE, `${solid.name}: radius`);
  });
}

check(file.shapes.length === solids.length, `${file.shapes.length} shapes for ${solids.length}`);
let largest = 0;
const colliders = solids.map((solid, i) => {
  const shape = file.shapes[i];
  check(shape.name === solid.name, `shape ${i} is ${shape.name}, not ${solid.name}`);
  const collider = world.createCollider(descriptionOf(shape)
    .setTranslation(...shape.joint_position).setRotation(turn(shape.joint_rotation)),
  bodyOf(shape.joint));
  checkCollider(collider, shape, solid, TOLERANCE);
  return collider;
});
for (const [joint, body] of bodies) {
  const { position, rotation } = compose(moves(joint), jointOf(file, joint));
  const [x, y, z] = position;
  body.setNextKinematicTranslation({ x, y, z });
  body.setNextKinematicRotation(turn(rotation));
}
world.step();
uprightSolids(folder, true).forEach((solid, i) =>
  checkCollider(colliders[i], file.shapes[i], solid, POSED_TOLERANCE));
finish(`${solids.length} shapes in Rapier, at rest and posed, hulls up to ` +
  `${(largest * 1e3).toFixed(2)} mm too large`);
