// Builds the shapes of jolt_colliders.json in Jolt and compares what Jolt then has with the result.
//
//   node check_jolt.mjs FOLDER
import { check, distance, finish, near, readJson } from '../gltf/files.mjs';
import { uprightSolids } from './geometry.mjs';
import { addBody, makeWorld, spheresOf } from './jolt_world.mjs';

const folder = process.argv[2];
const file = readJson(`${folder}/jolt_colliders.json`);
const solids = uprightSolids(folder);
const world = makeWorld();
check(file.shapes.length === solids.length, `${file.shapes.length} shapes for ${solids.length}`);
solids.forEach((solid, i) => {
  const shape = file.shapes[i];
  check(shape.name === solid.name, `shape ${i} is ${shape.name}, not ${solid.name}`);
  const spheres = spheresOf(addBody(world, file, shape).body);
  check(spheres.length === solid.ends.length, `${solid.name} has ${spheres.length} spheres`);
  solid.ends.forEach((end, k) => {
    near(distance(spheres[k].center, end.center), 0, 1e-6, `${solid.name}: centre ${k}`);
    near(spheres[k].radius, end.radius, 1e-6, `${solid.name}: radius ${k}`);
  });
});
finish(`${solids.length} shapes in Jolt`);
