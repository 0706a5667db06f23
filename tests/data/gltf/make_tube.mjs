// Makes the files of tests/data/gltf: a bent tube of 12 rings, held by two joints, in four packings.
//   npm install @gltf-transform/core @gltf-transform/extensions @gltf-transform/functions draco3d meshoptimizer
//   node make_tube.mjs FOLDER
import { Document, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, meshopt } from '@gltf-transform/functions';
import draco3d from 'draco3d';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';

const RINGS = 12, ROUND = 10;
function tube() {
  const positions = [], joints = [], weights = [], indices = [];
  for (let r = 0; r < RINGS; ++r) {
    for (let k = 0; k < ROUND; ++k) {
      const angle = 2 * Math.PI * k / ROUND, upper = r / (RINGS - 1);
      positions.push(0.1 * Math.cos(angle), upper, 0.1 * Math.sin(angle));
      joints.push(0, 1, 0, 0);
      weights.push(1 - upper, upper, 0, 0);
      if (r === 0) continue;
      const a = (r - 1) * ROUND + k, b = (r - 1) * ROUND + (k + 1) % ROUND;
      indices.push(a, a + ROUND, b, b, a + ROUND, b + ROUND);
    }
  }
  const document = new Document(), buffer = document.createBuffer();
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const primitive = document.createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', new Float32Array(positions)))
    .setAttribute('JOINTS_0', accessor('VEC4', new Uint8Array(joints)))
    .setAttribute('WEIGHTS_0', accessor('VEC4', new Float32Array(weights)))
    .setIndices(accessor('SCALAR', new Uint16Array(indices)))
    .setMaterial(document.createMaterial('cloth'));
  // Bound upright, the upper joint half-way up; it has been bent by 90 degrees since.
  const upper = document.createNode('upper').setTranslation([0, 0.5, 0]).setRotation([0, 0, Math.SQRT1_2, Math.SQRT1_2]);
  const lower = document.createNode('lower').addChild(upper);
  const binds = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1,  1,0,0,0, 0,1,0,0, 0,0,1,0, 0,-0.5,0,1];
  const skin = document.createSkin().addJoint(lower).addJoint(upper)
    .setInverseBindMatrices(accessor('MAT4', new Float32Array(binds)));
  const node = document.createNode('tube').setMesh(document.createMesh('tube').addPrimitive(primitive)).setSkin(skin);
  document.createScene().addChild(lower).addChild(node);
  return document;
}

await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(), 'meshopt.encoder': MeshoptEncoder,
  'draco3d.decoder': await draco3d.createDecoderModule(), 'meshopt.decoder': MeshoptDecoder});
async function write(name, ...transforms) {
  const document = tube();
  await document.transform(...transforms);
  await io.write(`${process.argv[2]}/${name}.glb`, document);
}
await write('tube');
await write('tube_draco_edgebreaker', draco({method: 'edgebreaker', quantizePosition: 16, quantizeGeneric: 16}));
await write('tube_draco_sequential', draco({method: 'sequential', quantizePosition: 16, quantizeGeneric: 16}));
await write('tube_meshopt', meshopt({encoder: MeshoptEncoder, level: 'medium', quantizePosition: 16, quantizeWeight: 16}));
