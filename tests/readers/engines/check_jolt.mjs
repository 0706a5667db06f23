// Builds the shapes of jolt_colliders.json in Jolt and compares what Jolt then has with the result, at
// rest and after Jolt has moved each body with its joint.
//
//   node check_jolt.mjs FOLDER
import { check, distance, finish, near, readJson } from '../gltf/files.mjs';
import { compose, jointMoves, uprightSolids } from './geometry.mjs';
import { addBody, makeWorld, moveBody, spheresOf } from './jolt_world.mjs';

const SECOND = 1;
// Jolt turns bodies by velocities, in floats.
const POSED_TOLERANCE = 2e-5;

const folder = process.argv[2];
const file = readJson(`${folder}/jolt_colliders.json`);
const solids = uprightSolids(folder);
const world = makeWorld();

function checkSpheres(body, solid, tolerance) {
  const spheres = spheresOf(body);
  check(spheres.length === solid.ends.length, `${solid.name} has ${spheres.length} spheres`);
  solid.ends.forEach((end, k) => {
    near(distance(spheres[k].center, end.center), 0, tolerance, `${solid.name}: centre ${k}`);
    near(spheres[k].radius, end.radius, 1e-6, `${solid.name}: radius ${k}`);
  });
}

check(file.shapes.length === solids.length, `${file.shapes.length} shapes for ${solids.length}`);
const bodies = solids.map((solid, i) => {
  const shape = file.shapes[i];
  check(shape.name === solid.name, `shape ${i} is ${shape.name}, not ${solid.name}`);
  const made = addBody(world, file, shape);
  checkSpheres(made.body, solid, 1e-6);
  return made;
});
const moves = jointMoves(folder);
bodies.forEach(({ id, place }, i) =>
  moveBody(world, id, compose(moves(file.shapes[i].joint), place), SECOND));
world.jolt.Step(SECOND, 1);
uprightSolids(folder, true).forEach((solid, i) =>
  checkSpheres(bodies[i].body, solid, POSED_TOLERANCE));
finish(`${solids.length} shapes in Jolt, at rest and posed`);
