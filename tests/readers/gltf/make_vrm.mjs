// A VRM of a rigged GLB: human bones by the names of its nodes, two springs, one collider group.
//
//   node make_vrm.mjs BODY.glb 0|1 OUT.vrm
//
// Names are those of VRoid (J_Bip_L_UpperArm). VRM 0 keeps the node's places: it faces +Z here,
// which readers do not mind. The springs are two chains of three new nodes: "hair", which begins at
// the head and so lies inside of what encloses it, and "tail" 40 cm behind the hips, which is free.
import { readFileSync, writeFileSync } from 'node:fs';
import { joinGlb, splitGlb } from './files.mjs';

const [input, version, output] = process.argv.slice(2);
const { description: gltf, binary } = splitGlb(readFileSync(input));

const BONES = {
  hips: 'J_Bip_C_Hips', spine: 'J_Bip_C_Spine', chest: 'J_Bip_C_Chest',
  upperChest: 'J_Bip_C_UpperChest', neck: 'J_Bip_C_Neck', head: 'J_Bip_C_Head',
};
for (const [side, letter] of [['left', 'L'], ['right', 'R']]) {
  for (const bone of ['Shoulder', 'UpperArm', 'LowerArm', 'Hand', 'UpperLeg', 'LowerLeg', 'Foot']) {
    BONES[side + bone] = `J_Bip_${letter}_${bone}`;
  }
  BONES[`${side}Toes`] = `J_Bip_${letter}_ToeBase`;
}
const nodeOf = (name) => gltf.nodes.findIndex((node) => node.name === name);
const bones = Object.fromEntries(Object.entries(BONES).map(([bone, name]) => [bone, nodeOf(name)])
  .filter(([, node]) => node >= 0));
for (const bone of ['hips', 'head', 'leftUpperLeg', 'rightHand']) {
  if (bones[bone] === undefined) throw new Error(`${input} has no node for ${bone}`);
}

function addChain(parent, name, steps) {
  const chain = steps.map((translation, i) => {
    gltf.nodes.push({ name: `${name}_${i}`, translation });
    return gltf.nodes.length - 1;
  });
  chain.slice(1).forEach((node, i) => { gltf.nodes[chain[i]].children = [node]; });
  (gltf.nodes[parent].children ??= []).push(chain[0]);
  return chain;
}
const hair = addChain(bones.head, 'hair', [[0, 0.05, 0], [0, 0.02, 0], [0, 0.02, 0]]);
const tail = addChain(bones.hips, 'tail', [[0, 0, -0.4], [0, -0.1, -0.1], [0, -0.1, -0.1]]);

gltf.extensionsUsed = [...(gltf.extensionsUsed ?? []), ...(version === '1'
  ? ['VRMC_vrm', 'VRMC_springBone'] : ['VRM'])];
gltf.extensions ??= {};
if (version === '1') {
  const spring = (name, chain) => ({
    name, joints: chain.map((node) => ({ node, hitRadius: 0.01 })), colliderGroups: [0],
  });
  gltf.extensions.VRMC_vrm = {
    specVersion: '1.0',
    meta: { name: 'sample', authors: ['capfit'], licenseUrl: 'https://vrm.dev/licenses/1.0/' },
    humanoid: {
      humanBones: Object.fromEntries(Object.entries(bones).map(([b, node]) => [b, { node }])),
    },
  };
  gltf.extensions.VRMC_springBone = {
    specVersion: '1.0',
    colliders: [{ node: bones.head, shape: { sphere: { offset: [0, 0, 0], radius: 0.01 } } }],
    colliderGroups: [{ name: 'authored', colliders: [0] }],
    springs: [spring('hair', hair), spring('tail', tail)],
  };
} else {
  const group = (comment, chain) => ({
    comment, stiffiness: 1, gravityPower: 0, dragForce: 0.4, center: -1, hitRadius: 0.01,
    bones: [chain[0]], colliderGroups: [0],
  });
  gltf.extensions.VRM = {
    exporterVersion: 'capfit test',
    specVersion: '0.0',
    meta: { title: 'sample' },
    humanoid: { humanBones: Object.entries(bones).map(([bone, node]) => ({ bone, node })) },
    firstPerson: {},
    blendShapeMaster: { blendShapeGroups: [] },
    secondaryAnimation: {
      boneGroups: [group('hair', hair), group('tail', tail)],
      colliderGroups: [{
        node: bones.head, colliders: [{ offset: { x: 0, y: 0, z: 0 }, radius: 0.01 }],
      }],
    },
    materialProperties: [],
  };
}
writeFileSync(output, joinGlb(gltf, binary));
