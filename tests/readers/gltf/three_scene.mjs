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

// Turns a joint about its own place, by an angle that differs from joint to joint.
export function turn(object, index) {
  const axis = new THREE.Vector3(1, (index % 3) - 1, ((index * 7) % 5) - 2).normalize();
  const angle = 0.3 + 0.1 * (index % 7);
  object.quaternion.multiply(new THREE.Quaternion().setFromAxisAngle(axis, angle));
}

export { THREE };
