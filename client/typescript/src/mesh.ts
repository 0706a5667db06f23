// Meshes as the caller has them, and the messages that upload them.
import { checkNames, checkObject } from "./checks";
import { invalidField } from "./errors";
import type { ArrayEncoding } from "./generated/capfit/v1/ArrayEncoding";
import type { MeshArrays } from "./generated/capfit/v1/MeshArrays";
import type { MeshChunk } from "./generated/capfit/v1/MeshChunk";
import type { MeshHeader } from "./generated/capfit/v1/MeshHeader";
import {
  type LengthUnit, type MeshFileFormat, type UpAxis, lengthUnits, meshFileFormats, upAxes,
} from "./words";

/** What may be told about a mesh's coordinates. Results come back in the same unit and axes. */
export interface Frame {
  /** Default: found from the body's height. */
  unit?: LengthUnit;
  /** Default: found from the body. */
  upAxis?: UpAxis;
}

/** A mesh file. */
export interface FileMesh extends Frame {
  /** The bytes of the file; a Buffer is one too. */
  file: Uint8Array;
  /** Default: found from the first bytes. */
  format?: MeshFileFormat;
}

/** Faces of any number of corners. */
export interface PolygonFaces {
  /** How many corners each face has. */
  sizes: Uint32Array;
  /** The corners of all faces, one face after the other, counted from 0. */
  indices: Uint32Array;
}

/** A mesh as arrays. */
export interface ArrayMesh extends Frame {
  /** x, y, z of vertex 0, then of vertex 1, ... They are sent in the precision that they have. */
  vertices: Float32Array | Float64Array;
  /** Three vertex indices for each triangle, or faces of any number of corners. */
  faces: Uint32Array | PolygonFaces;
}

/** What is to be fitted. */
export type Mesh = FileMesh | ArrayMesh;

/** A mesh that is ready to be uploaded, as often as it takes. */
export interface Upload {
  header: MeshHeader;
  chunks(): Generator<MeshChunk>;
}

const CHUNK_BYTES = 256 * 1024;

/** Throws CapfitError for what is no mesh. */
export function uploadOf(mesh: Mesh): Upload {
  checkObject(mesh, "mesh");
  if ("file" in mesh && "vertices" in mesh) {
    throw invalidField("CONFLICT", "mesh", "must have a file or vertices, not both");
  }
  if ("file" in mesh) return fileUpload(mesh);
  if ("vertices" in mesh) return arrayUpload(mesh);
  throw invalidField("MISSING", "mesh", "must have a file, or vertices and faces");
}

function frameOf(mesh: Frame): MeshHeader {
  const header: MeshHeader = {};
  if (mesh.unit !== undefined) header.unit = lengthUnits.toWire(mesh.unit, "mesh.unit");
  if (mesh.upAxis !== undefined) header.upAxis = upAxes.toWire(mesh.upAxis, "mesh.up_axis");
  return header;
}

function fileUpload(mesh: FileMesh): Upload {
  checkNames(mesh, ["file", "format", "unit", "upAxis"], "mesh");
  const bytes: unknown = mesh.file;
  if (!(bytes instanceof Uint8Array)) {
    throw invalidField("UNKNOWN_VALUE", "mesh.file", "must be the bytes of a file (Uint8Array)");
  }
  const format =
    mesh.format === undefined ? {} : { format: meshFileFormats.toWire(mesh.format, "mesh.format") };
  return {
    header: { ...frameOf(mesh), file: { ...format, byteCount: bytes.length } },
    *chunks() {
      for (const piece of pieces(bytes)) {
        yield { fileBytes: Buffer.from(piece.buffer, piece.byteOffset, piece.byteLength) };
      }
    },
  };
}

function arrayUpload(mesh: ArrayMesh): Upload {
  checkNames(mesh, ["vertices", "faces", "unit", "upAxis"], "mesh");
  const { vertices, faces } = mesh;
  if (!(vertices instanceof Float32Array || vertices instanceof Float64Array)) {
    throw invalidField("UNKNOWN_VALUE", "mesh.vertices", "must be a Float32Array or Float64Array");
  }
  const isSingle = vertices instanceof Float32Array;
  const arrays: [keyof MeshArrays, Float32Array | Float64Array | Uint32Array][] = [
    [isSingle ? "positions" : "positionsDouble", vertices],
    ...faceArrays(faces),
  ];
  const field = isSingle ? "positions" : "positions_double";
  const encoding: ArrayEncoding = {
    vertexCount: wholeThirds(vertices.length, `mesh.arrays.${field}`),
    faceCount: faceCountOf(faces),
  };
  return {
    header: { ...frameOf(mesh), arrays: encoding },
    *chunks() {
      for (const [name, array] of arrays) {
        for (const piece of pieces(array)) yield { arrays: { [name]: Array.from(piece) } };
      }
    },
  };
}

function faceArrays(faces: Uint32Array | PolygonFaces): [keyof MeshArrays, Uint32Array][] {
  if (faces instanceof Uint32Array) return [["triangleIndices", faces]];
  checkObject(faces, "mesh.faces");
  checkNames(faces, ["sizes", "indices"], "mesh.faces");
  if (!(faces.sizes instanceof Uint32Array && faces.indices instanceof Uint32Array)) {
    throw invalidField("UNKNOWN_VALUE", "mesh.faces",
      "must be a Uint32Array of triangles, or {sizes, indices} of two Uint32Arrays");
  }
  return [["faceSizes", faces.sizes], ["faceIndices", faces.indices]];
}

function faceCountOf(faces: Uint32Array | PolygonFaces): number {
  if (!(faces instanceof Uint32Array)) return faces.sizes.length;
  return wholeThirds(faces.length, "mesh.arrays.triangle_indices");
}

function wholeThirds(length: number, field: string): number {
  if (length % 3 !== 0) {
    throw invalidField("COUNT_MISMATCH", field, "must have three numbers for each element", length);
  }
  return length / 3;
}

// Views, not copies.
function* pieces<Numbers extends Uint8Array | Float32Array | Float64Array | Uint32Array>(
  array: Numbers,
): Generator<Numbers> {
  const length = CHUNK_BYTES / array.BYTES_PER_ELEMENT;
  for (let begin = 0; begin < array.length; begin += length) {
    yield array.subarray(begin, begin + length) as Numbers;
  }
}
