// Beside the options: the layout to keep, and the files for engines that are to come along.
import { booleanOf, checkNames, checkObject, numberOf, stringOf } from "./checks";
import { brokenContract, invalidField } from "./errors";
import type { ExportChunk__Output } from "./generated/capfit/v1/ExportChunk";
import type { ExportRequest as WireExport } from "./generated/capfit/v1/ExportRequest";
import type { Layout as WireLayout } from "./generated/capfit/v1/Layout";
import type { Sphere as WireSphere } from "./generated/capfit/v1/Sphere";
import type { Capsule, Sphere } from "./result";
import { bodyParts, bones } from "./words";

/** Spheres and capsules to keep: those of a former result, of which only names, parts, places and
 *  mirror images count. */
export interface KnownLayout {
  spheres: readonly Sphere[];
  capsules: readonly Capsule[];
}

/** A file for an engine. */
export interface ExportRequest {
  /** "gltf", "unity", ...: serverInfo() lists them. */
  format: string;
  /** gltf: each collider also as a translucent mesh. Default: false. */
  preview?: boolean;
  /** usd, mujoco: shapes that every reader knows in place of tapered capsules. Default: false. */
  plain?: boolean;
  /** Where capsules have one radius: how far they may stand out, in metres. Default: 0.005. */
  maxOvershootM?: number;
}

/** What else may be asked of one fit. */
export interface Extras {
  /** The same spheres and capsules by the same numbers and names, in place of a budget: a standard
   *  layout by name, or that of a former result. */
  layout?: string | KnownLayout;
  /** Files for engines, by format or with details; they come as Result.exports. */
  exports?: readonly (string | ExportRequest)[];
}

export const EXTRA_NAMES = ["layout", "exports"] as const;

function sphereToWire({ name, part, mirror, place }: Sphere, index: number): WireSphere {
  const field = `layout.set.spheres[${index}]`;
  const sphere: WireSphere = {
    name: stringOf(name, `${field}.name`), part: bodyParts.toWire(part, `${field}.part`),
  };
  if (mirror !== null) sphere.mirror = mirror;
  if (place) sphere.place = { ...place, bone: bones.toWire(place.bone, `${field}.place.bone`) };
  return sphere;
}

export function layoutToWire(layout: string | KnownLayout): WireLayout {
  if (typeof layout === "string") return { name: layout };
  checkObject(layout, "layout");
  if (!Array.isArray(layout.spheres) || !Array.isArray(layout.capsules)) {
    throw invalidField("UNKNOWN_VALUE", "layout", "must be a name or a result");
  }
  return {
    set: {
      spheres: layout.spheres.map(sphereToWire),
      capsules: (layout.capsules as readonly Capsule[]).map(
        ({ first, second }) => ({ firstSphere: first, secondSphere: second })),
    },
  };
}

function exportToWire(request: string | ExportRequest, index: number): WireExport {
  if (typeof request === "string") return { format: request };
  const field = `exports[${index}]`;
  checkObject(request, field);
  checkNames(request, ["format", "preview", "plain", "maxOvershootM"], field);
  const wire: WireExport = { format: stringOf(request.format, `${field}.format`) };
  if (request.preview !== undefined) wire.preview = booleanOf(request.preview, `${field}.preview`);
  if (request.plain !== undefined) wire.plain = booleanOf(request.plain, `${field}.plain`);
  if (request.maxOvershootM !== undefined) {
    wire.maxOvershootM = numberOf(request.maxOvershootM, `${field}.max_overshoot_m`);
  }
  return wire;
}

export function exportsToWire(requests: readonly (string | ExportRequest)[]): WireExport[] {
  if (!Array.isArray(requests)) {
    throw invalidField("UNKNOWN_VALUE", "exports", "must be a list of formats", requests);
  }
  return requests.map(exportToWire);
}

/** Files that come in pieces, each piece where the one before ends. */
export class ExportFiles {
  private readonly files = new Map<string, { pieces: Uint8Array[]; bytes: number; all: number }>();

  add({ name, firstByte, totalBytes, data }: ExportChunk__Output): void {
    const all = Number(totalBytes);
    const file = this.files.get(name) ?? { pieces: [], bytes: 0, all };
    if (file.bytes !== Number(firstByte) || file.bytes + data.length > all || all !== file.all) {
      throw brokenContract(`bytes of ${name} are not where the ones before end`);
    }
    file.pieces.push(data);
    file.bytes += data.length;
    this.files.set(name, file);
  }

  whole(): Record<string, Uint8Array> {
    const whole: Record<string, Uint8Array> = {};
    for (const [name, { pieces, bytes, all }] of this.files) {
      if (bytes !== all) throw brokenContract(`${bytes} bytes of ${all} of ${name}`);
      whole[name] = new Uint8Array(Buffer.concat(pieces));
    }
    return whole;
  }
}
