// The check of the collider extensions finds what is wrong: each of these files has one mistake.
import { colliderProblems } from './collider_schema.mjs';
import { check, finish } from './files.mjs';

const sound = () => ({
  extensionsUsed: ['KHR_implicit_shapes', 'KHR_physics_rigid_bodies'],
  extensions: {
    KHR_implicit_shapes: {
      shapes: [
        { type: 'capsule', capsule: { height: 1, radiusTop: 0.1, radiusBottom: 0.2 } },
        { type: 'sphere', sphere: { radius: 0.1 } },
      ],
    },
  },
  nodes: [
    {},
    { extensions: { KHR_physics_rigid_bodies: { collider: { geometry: { shape: 1 } } } } },
  ],
});
const shape = (gltf, s) => gltf.extensions.KHR_implicit_shapes.shapes[s];
const body = (gltf) => gltf.nodes[1].extensions.KHR_physics_rigid_bodies;
const mistakes = {
  'height 0': (g) => { shape(g, 0).capsule.height = 0; },
  'height -3': (g) => { shape(g, 0).capsule.height = -3; },
  'no radii': (g) => { Object.assign(shape(g, 0).capsule, { radiusTop: 0, radiusBottom: 0 }); },
  'radius of text': (g) => { shape(g, 0).capsule.radiusTop = '0.1'; },
  'old word': (g) => { shape(g, 0).capsule.radius = 0.1; },
  'sphere of 0': (g) => { shape(g, 1).sphere.radius = 0; },
  'no type': (g) => { delete shape(g, 0).type; },
  'two kinds': (g) => { shape(g, 0).sphere = { radius: 1 }; },
  'no shapes': (g) => { g.extensions.KHR_implicit_shapes.shapes = []; },
  'shape out of range': (g) => { body(g).collider.geometry.shape = 2; },
  'shape of a draft': (g) => { body(g).collider = { shape: 1 }; },
  'shapes not declared': (g) => { g.extensionsUsed.shift(); },
  'bodies not declared': (g) => { g.extensionsUsed.pop(); },
  'declared twice': (g) => { g.extensionsUsed.push('KHR_implicit_shapes'); },
};

check(colliderProblems(sound()).length === 0, `sound: ${colliderProblems(sound())}`);
for (const [name, make] of Object.entries(mistakes)) {
  const gltf = sound();
  make(gltf);
  check(colliderProblems(gltf).length > 0, `not found: ${name}`);
}
finish(`${Object.keys(mistakes).length} mistakes`);
