// The test's body, as a file and as arrays.
import { readFileSync } from "node:fs";

export const address = process.env["CAPFIT_ADDRESS"]!;
export const file: Uint8Array = readFileSync(process.env["CAPFIT_BODY"]!);

const lines = Buffer.from(file).toString().split("\n").map((line) => line.trim().split(/\s+/));
const faces = lines.filter(([kind]) => kind === "f")
  .map(([, ...corners]) => corners.map((corner) => parseInt(corner, 10) - 1));

export const vertices = Float64Array.from(
  lines.filter(([kind]) => kind === "v").flatMap(([, x, y, z]) => [x, y, z].map(Number)),
);
/** Fans, as the server splits polygons. */
export const triangles = Uint32Array.from(
  faces.flatMap((face) => face.slice(2).flatMap((_, i) => [face[0]!, face[i + 1]!, face[i + 2]!])),
);
export const polygons = {
  sizes: Uint32Array.from(faces.map((face) => face.length)),
  indices: Uint32Array.from(faces.flat()),
};
