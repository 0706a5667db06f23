export { type CallOptions, CapfitClient, type ClientOptions, type InfoOptions } from "./client";
export type { Security } from "./connection";
export { CapfitError, type ErrorReason, type StatusCode, type Warning } from "./errors";
export type { ExportRequest, Extras, KnownLayout } from "./extras";
export type { ArrayMesh, FileMesh, Frame, Mesh, PolygonFaces } from "./mesh";
export type { FitOptions, Vector } from "./options";
export {
  type BodyFacts, type BoneRow, type Capsule, type EffectiveBudget, type EffectiveOptions, type Engine,
  type FeaturePolygon, type GapStatistics, type Joint, type Landmark, type Metrics, type PartMetrics, Result,
  type ServerInfo, type ServerLimits, type Similarity, type SparseRow, type Sphere, type Summary,
} from "./result";
export type { Progress, ProgressFunction } from "./result_collector";
export type { ResultJson } from "./result_json";
export type {
  BodyPart, BodyPartGroup, CapsuleProfile, FitMode, LandmarkMethod, LengthUnit, MeshFileFormat,
  MeshPartKind, Quality, Sex, SkinningForm, Stage, UpAxis,
} from "./words";
