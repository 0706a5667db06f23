// A GLB as .gltf: text with its buffer inside.   node make_text.mjs BODY.glb OUT.gltf
import { readFileSync, writeFileSync } from 'node:fs';
import { splitGlb } from './files.mjs';

const { description, binary } = splitGlb(readFileSync(process.argv[2]));
description.buffers[0].uri =
  `data:application/octet-stream;base64,${binary.toString('base64')}`;
writeFileSync(process.argv[3], JSON.stringify(description));
