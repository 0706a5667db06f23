// What a fit gives.
import type { BodyFacts__Output as WireBodyFacts } from "./generated/capfit/v1/BodyFacts";
import type {
  EffectiveBudget__Output as WireBudget,
} from "./generated/capfit/v1/EffectiveBudget";
import type {
  EffectiveOptions__Output as WireOptions,
} from "./generated/capfit/v1/EffectiveOptions";
import type { Engine__Output as WireEngine } from "./generated/capfit/v1/Engine";
import type { GapStatistics__Output } from "./generated/capfit/v1/GapStatistics";
import type { MeshPart__Output as WireMeshPart } from "./generated/capfit/v1/MeshPart";
import type { Metrics__Output as WireMetrics } from "./generated/capfit/v1/Metrics";
import type { PartMetrics__Output as WirePartMetrics } from "./generated/capfit/v1/PartMetrics";
import type { ServerLimits__Output } from "./generated/capfit/v1/ServerLimits";
import type { Warning } from "./errors";
import type { Vector } from "./options";
import { type ResultJson, resultJson } from "./result_json";
import type {
  BodyPart, BodyPartGroup, Bone, CapsuleProfile, FitMode, LandmarkMethod, LengthUnit, MeshFileFormat,
  MeshPartKind,
  Quality, Sex, SkinningForm, Stage, UpAxis,
} from "./words";

/** A place and a size in the measures of a bone between two landmarks: holds for any body. */
export interface BodyPlace {
  /** "upper_arm", ...: the stretch between two landmarks that it hangs on. */
  bone: Bone;
  /** Whether the bone is the one on the body's right. */
  isRight: boolean;
  /** In bone lengths from its first end; beyond the ends in bone radii. */
  along: number;
  /** Across the bone, in bone radii. */
  aside: number;
  /** Across the bone, in bone radii. */
  ahead: number;
  /** The sphere's radius, in bone radii. */
  radius: number;
}

/** A ball, in the caller's unit and axes. */
export interface Sphere {
  center: Vector;
  radius: number;
  /** The part that it belongs to. */
  part: BodyPart;
  /** "left_forearm_2", ...: unique in the result. */
  name: string;
  /** The sphere on the other side of the body; its own index on the mid-plane. null: the body is
   *  not symmetric. */
  mirror: number | null;
  /** Where on the body it is, in measures that hold for any body. null: the body lacks the landmarks. */
  place: BodyPlace | null;
  /** The feature polygon that it comes from. null: none, or none were asked for. */
  polygon: number | null;
  /** The joint that carries it best, an index into joints. null: no skeleton holds the mesh. */
  joint: number | null;
  /** How far that one joint misleads the centre when any joint turns by 30 degrees, in metres. */
  jointDriftM: number | null;
}

/** The convex hull of two spheres. */
export interface Capsule {
  /** Index into spheres. */
  first: number;
  /** Index into spheres, larger than `first`. */
  second: number;
  /** The part that it belongs to: of two parts that it joins, the later one. */
  part: BodyPart;
  /** The joint that carries both of its ends best. null: no skeleton holds the mesh. */
  joint: number | null;
}

/** A joint of the skeleton that came with the mesh, where its node stands in the file. */
export interface Joint {
  /** May be empty. */
  name: string;
  /** Index of the nearest joint above it; null: none is. */
  parent: number | null;
  /** What the file itself calls it (VRM: "leftLowerArm"); often empty. */
  humanBone: string;
  /** From the node's own frame to the mesh's: 3 rows of 4 numbers, row after row. */
  toMesh: number[];
  /** Index among the file's nodes; null where no file says. */
  node: number | null;
}

/** The vertices that carry a sphere's centre: the sum of weight * vertex. */
export interface SparseRow {
  vertices: number[];
  weights: number[];
}

/** The joints that carry a sphere's centre: the sum of weight * toMesh * offset. */
export interface BoneRow {
  joints: number[];
  weights: number[];
  /** In the joint's own frame and unit. */
  offsets: Vector[];
}

/** A landmark of the body. */
export interface Landmark {
  /** In the caller's unit and axes. */
  position: Vector;
  method: LandmarkMethod | null;
  /** How sure the method is, from 0 to 1. */
  confidence: number;
}

/** A cross section of the body with the circles fitted to it, in the caller's unit and axes. */
export interface FeaturePolygon {
  name: string;
  part: BodyPart;
  outline: Vector[];
  circles: { center: Vector; radius: number }[];
  /** Area of the circles outside the polygon / area of the polygon. */
  outsideAreaRatio: number;
}

/** Distances between the body's surface and that of the primitives, in metres. */
export type GapStatistics = GapStatistics__Output;

type Replaced<Message, New> = Omit<Message, keyof New> & New;

/** How good a result is for one part of the body. */
export type PartMetrics = Replaced<Omit<WirePartMetrics, "part">, { gap: GapStatistics }>;

/** How good a result is. */
export type Metrics = Replaced<
  WireMetrics,
  { gap: GapStatistics; parts: Partial<Record<BodyPart, PartMetrics>> }
>;

/** All limits that held together; those that are not there did not limit. */
export type EffectiveBudget = Omit<WireBudget, `_${string}`>;

/** What held in the end: defaults filled in, the engine's limits applied, unit and axis as found. A
 *  seed above 2^53 is rounded here, not in the request. */
export type EffectiveOptions = Replaced<
  WireOptions,
  {
    budget: EffectiveBudget;
    fitMode: FitMode | null;
    quality: Quality | null;
    parts: BodyPartGroup[];
    requireParts: BodyPartGroup[];
    sex: Sex | null;
    skinning: SkinningForm | null;
    capsuleProfile: CapsuleProfile | null;
    unit: LengthUnit | null;
    upAxis: UpAxis | null;
  }
>;

/** Pieces of one part of a file, and what they were taken for. */
export type MeshPart = Replaced<
  WireMeshPart,
  { kind: MeshPartKind | null; shellCount: number; faceCount: number }
>;

/** The mesh that was fitted, as it came. */
export type BodyFacts = Replaced<
  WireBodyFacts,
  { boxMin: Vector; boxMax: Vector; parts: MeshPart[] }
>;

/** y = scale * (rotation * x) + translation. */
export interface Similarity {
  /** Nine numbers, row after row. */
  rotation: number[];
  /** Metres per caller's unit. */
  scale: number;
  /** In metres. */
  translation: Vector;
}

/** The facts of the fit. */
export interface Summary {
  /** The caller's name for the job. */
  requestId: string;
  /** Version of the server. */
  version: string;
  /** Seconds of each stage that was needed. */
  stages: Partial<Record<Stage, number>>;
  /** Seconds of the whole fit, without upload and queueing. */
  seconds: number;
  /** To the body's own frame: metres, +Y up, facing +Z, lowest point at y = 0. */
  bodyFromCaller: Similarity;
  options: EffectiveOptions;
  body: BodyFacts;
}

/** The members of a result. */
export interface ResultMembers {
  spheres: Sphere[];
  capsules: Capsule[];
  /** By name. */
  landmarks: Record<string, Landmark>;
  warnings: Warning[];
  metrics: Metrics;
  /** Where option skinning is "dense": for each sphere the weight of every vertex. */
  weights: Float32Array[] | undefined;
  /** Where option skinning is "sparse": one row for each sphere. */
  sparseWeights: SparseRow[] | undefined;
  /** Where option skinning is "bones": one row for each sphere. */
  boneWeights: BoneRow[] | undefined;
  /** The skeleton that came with the mesh; empty: none did. */
  joints: Joint[];
  /** Where option wantVertexGaps is set: for each of the caller's vertices, in the caller's unit;
   *  > 0 outside the primitives, NaN for what is not fitted. */
  vertexGaps: Float32Array | undefined;
  /** Where option wantFeaturePolygons is set. */
  featurePolygons: FeaturePolygon[] | undefined;
  /** The files that were asked for, by name. */
  exports: Record<string, Uint8Array>;
  summary: Summary;
}

/** The fitted model: the union of all spheres and capsules, and what is known about it. */
export class Result implements ResultMembers {
  readonly spheres!: Sphere[];
  readonly capsules!: Capsule[];
  readonly landmarks!: Record<string, Landmark>;
  readonly warnings!: Warning[];
  readonly metrics!: Metrics;
  readonly weights: Float32Array[] | undefined;
  readonly sparseWeights: SparseRow[] | undefined;
  readonly boneWeights: BoneRow[] | undefined;
  readonly joints!: Joint[];
  readonly vertexGaps: Float32Array | undefined;
  readonly featurePolygons: FeaturePolygon[] | undefined;
  readonly exports!: Record<string, Uint8Array>;
  readonly summary!: Summary;

  constructor(members: ResultMembers) {
    Object.assign(this, members);
  }

  /** As result.json has it, format version 1: what the command line's tools read. Without dense
   *  weights and vertex gaps, which are files of their own. */
  toJson(): ResultJson {
    return resultJson(this);
  }

  /** The same, so that JSON.stringify(result) writes a result.json. */
  toJSON(): ResultJson {
    return this.toJson();
  }
}

/** A cloth engine and what it takes; 0: no limit of its own. */
export type Engine = Replaced<WireEngine, { profile: CapsuleProfile | null }>;

/** What the server accepts. */
export type ServerLimits = ServerLimits__Output;

/** What the server is and what it accepts. */
export interface ServerInfo {
  version: string;
  limits: ServerLimits;
  formats: MeshFileFormat[];
  engines: Engine[];
  /** What it can do, in the words of the contract, e.g. "quality.tight". */
  features: string[];
  /** Layouts that it can keep. */
  layouts: { name: string; sphereCount: number; capsuleCount: number }[];
  /** Files for engines that it can make; needsOriginal: the body must come as such a file. */
  exportFormats: { name: string; summary: string; needsOriginal: boolean }[];
}
