// three.js's own glTF loader without a browser.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

globalThis.self ??= globalThis;
globalThis.ProgressEvent ??= class extends Event {};
globalThis.createImageBitmap ??= async () => ({ width: 1, height: 1, close() {} });

// `plugins`: functions from the parser to a plugin.
export async function loadScene(bytes, plugins = []) {
  const loader = new GLTFLoader();
  for (const plugin of plugins) loader.register(plugin);
  const copy = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const gltf = await loader.parseAsync(copy, '');
  gltf.scene.updateMatrixWorld(true);
  return gltf;
}

export const vector = (p) => new THREE.Vector3(p[0], p[1], p[2]);

// Puts the nodes of the joints where they are in the pose; parents first, whatever their order. What
// hangs below follows by the scene's own matrices.
export function pose(scene, nodes, joints) {
  const depthOf = (j) => (joints[j].parent < 0 ? 0 : 1 + depthOf(joints[j].parent));
  const order = joints.map((_, j) => j).sort((a, b) => depthOf(a) - depthOf(b));
  for (const j of order) {
    const [x, y, z] = joints[j].posed;
    const node = nodes[j];
    node.matrix.set(...x, ...y, ...z, 0, 0, 0, 1)
      .premultiply(node.parent.matrixWorld.clone().invert());
    node.matrixAutoUpdate = false;
    scene.updateMatrixWorld(true);
  }
}

export { THREE };
