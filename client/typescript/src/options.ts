// What may be asked for, and how it stands in the request.
import {
  booleanOf, checkNames, checkObject, integerOf, numberOf, stringOf, unsigned64Of,
} from "./checks";
import { invalidField } from "./errors";
import type { BodyPartGroup as BodyPartGroupName } from "./generated/capfit/v1/BodyPartGroup";
import type { Budget } from "./generated/capfit/v1/Budget";
import type { FitOptions as WireOptions } from "./generated/capfit/v1/FitOptions";
import type { Landmark as WireLandmark } from "./generated/capfit/v1/Landmark";
import {
  type BodyPartGroup, type FitMode, type Quality, type Sex, type SkinningForm,
  bodyPartGroups, fitModes, qualities, sexes, skinningForms,
} from "./words";

/** x, y, z. */
export type Vector = [number, number, number];

/** What is wanted. The budget is one of: maxPrimitives; maxSpheres, maxCapsules or both;
 *  maxPolygonError. */
export interface FitOptions {
  /** Spheres and cones together, a sphere that several cones share counted once: 15 to 1000.
   *  Default: 64, where nothing else limits. */
  maxPrimitives?: number;
  /** Spheres, counted apart: 10 to 500. */
  maxSpheres?: number;
  /** Capsules, counted apart: 5 to 1000. */
  maxCapsules?: number;
  /** Outside area / area that each feature polygon is brought down to: 0.001 to 2. */
  maxPolygonError?: number;
  /** A cloth engine by name, whose limits hold beside the budget; serverInfo() lists them. */
  engine?: string;
  /** Default: "enclose". */
  fitMode?: FitMode;
  /** Default: "paper". */
  quality?: Quality;
  /** The parts to fit. Default: torso, arms and legs. */
  parts?: "all" | readonly BodyPartGroup[];
  /** Parts without which a body is refused. Default: none. */
  requireParts?: "all" | readonly BodyPartGroup[];
  /** Whether the bust may be split in three. Default: "auto". */
  sex?: Sex;
  /** Weights that carry the spheres along. Default: "none". */
  skinning?: SkinningForm;
  /** Landmarks that the caller knows better, by name, in the mesh's unit and axes. */
  landmarks?: Readonly<Record<string, Readonly<Vector>>>;
  /** Seed of the random restarts: a whole number up to 2^53, or a bigint of 64 bits. Default: 0. */
  seed?: number | bigint;
  /** Whether the feature polygons with their circles come back too. Default: false. */
  wantFeaturePolygons?: boolean;
  /** Whether the signed distance of every vertex comes back too. Default: false. */
  wantVertexGaps?: boolean;
  /** How far a vertex may stick out, in metres: 0 to 0.1. Default: 0. */
  toleranceM?: number;
  /** Names of meshes or materials of the file that are the body's; * and ? stand for others. */
  includeParts?: readonly string[];
  /** Names of those that are not. */
  excludeParts?: readonly string[];
  /** Whether hair is enclosed too. Default: false. */
  includeHair?: boolean;
  /** Whether skirts are enclosed too. Default: false. */
  includeSkirt?: boolean;
}

// One writer for each option, so that a new one cannot be forgotten here.
type Writers = {
  [Name in keyof Required<FitOptions>]: (value: FitOptions[Name], wire: WireOptions) => void;
};

const writers: Writers = {
  maxPrimitives(value, wire) {
    const field = "options.budget.max_primitives";
    budgetFor("maxPrimitives", wire).maxPrimitives = integerOf(value, field);
  },
  maxSpheres(value, wire) {
    const field = "options.budget.spheres_and_capsules.max_spheres";
    apartLimit(wire).maxSpheres = integerOf(value, field);
  },
  maxCapsules(value, wire) {
    const field = "options.budget.spheres_and_capsules.max_capsules";
    apartLimit(wire).maxCapsules = integerOf(value, field);
  },
  maxPolygonError(value, wire) {
    const field = "options.budget.max_polygon_error";
    budgetFor("maxPolygonError", wire).maxPolygonError = numberOf(value, field);
  },
  engine: (value, wire) => { wire.engine = stringOf(value, "options.engine"); },
  fitMode: (value, wire) => { wire.fitMode = fitModes.toWire(value, "options.fit_mode"); },
  quality: (value, wire) => { wire.quality = qualities.toWire(value, "options.quality"); },
  parts: (value, wire) => { wire.parts = partsOf(value, "options.parts"); },
  requireParts(value, wire) { wire.requireParts = partsOf(value, "options.require_parts"); },
  sex: (value, wire) => { wire.sex = sexes.toWire(value, "options.sex"); },
  skinning(value, wire) { wire.skinning = skinningForms.toWire(value, "options.skinning"); },
  landmarks: (value, wire) => { wire.landmarks = landmarksOf(value); },
  seed: (value, wire) => { wire.seed = unsigned64Of(value, "options.seed"); },
  wantFeaturePolygons(value, wire) {
    wire.wantFeaturePolygons = booleanOf(value, "options.want_feature_polygons");
  },
  wantVertexGaps(value, wire) {
    wire.wantVertexGaps = booleanOf(value, "options.want_vertex_gaps");
  },
  toleranceM: (value, wire) => { wire.toleranceM = numberOf(value, "options.tolerance_m"); },
  includeParts: (value, wire) => { wire.includeParts = namesOf(value, "options.include_parts"); },
  excludeParts: (value, wire) => { wire.excludeParts = namesOf(value, "options.exclude_parts"); },
  includeHair(value, wire) { wire.includeHair = booleanOf(value, "options.include_hair"); },
  includeSkirt(value, wire) { wire.includeSkirt = booleanOf(value, "options.include_skirt"); },
};

/** Throws CapfitError for names and words that the contract does not know. */
export function optionsToWire(options: FitOptions): WireOptions {
  checkObject(options, "options");
  checkNames(options, Object.keys(writers), "options");
  const wire: WireOptions = {};
  for (const name of Object.keys(writers) as (keyof FitOptions)[]) {
    const write = writers[name] as (value: unknown, wire: WireOptions) => void;
    if (options[name] !== undefined) write(options[name], wire);
  }
  return wire;
}

// The wire would keep the last of two ways to limit, and say nothing.
function budgetFor(kind: NonNullable<Budget["limit"]>, wire: WireOptions): Budget {
  const budget = (wire.budget ??= {});
  if (budget.limit !== undefined && budget.limit !== kind) {
    throw invalidField("CONFLICT", "options.budget",
      "must be one of maxPrimitives, maxSpheres with maxCapsules, and maxPolygonError");
  }
  budget.limit = kind;
  return budget;
}

function apartLimit(wire: WireOptions): NonNullable<Budget["spheresAndCapsules"]> {
  return (budgetFor("spheresAndCapsules", wire).spheresAndCapsules ??= {});
}

function partsOf(value: unknown, field: string): BodyPartGroupName[] {
  const words: unknown = value === "all" ? bodyPartGroups.words : value;
  if (!Array.isArray(words)) {
    throw invalidField("UNKNOWN_VALUE", field, 'must be "all" or a list of parts', value);
  }
  return words.map((word, index) => bodyPartGroups.toWire(word, `${field}[${index}]`));
}

function namesOf(value: unknown, field: string): string[] {
  if (!Array.isArray(value)) {
    throw invalidField("UNKNOWN_VALUE", field, "must be a list of names", value);
  }
  return value.map((name, index) => stringOf(name, `${field}[${index}]`));
}

function landmarksOf(value: unknown): WireLandmark[] {
  checkObject(value, "options.landmarks");
  return Object.entries(value).map(([name, position], index) => {
    const field = `options.landmarks[${index}].position`;
    if (!Array.isArray(position) || position.length !== 3) {
      throw invalidField("UNKNOWN_VALUE", field, `(${name}) must be [x, y, z]`);
    }
    const [x, y, z] = position.map((coordinate) => numberOf(coordinate, field)) as Vector;
    return { name, position: { x, y, z } };
  });
}
