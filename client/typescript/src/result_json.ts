// result.json, format version 1: docs/result.schema.json has all members. The contract's names, so
// camelCase becomes snake_case again.
import type { FeaturePolygon, ResultMembers, Sphere } from "./result";
import type { Vector } from "./options";
import type { BodyPart, LengthUnit, UpAxis } from "./words";

type Json = null | boolean | number | string | Json[] | { [name: string]: Json };

/** The file's members. Lengths are in `unit`, but for those whose name ends with _m. */
export interface ResultJson {
  format: "capfit-result";
  format_version: 1;
  version: string;
  unit: LengthUnit | null;
  metres_per_unit: number;
  up_axis: UpAxis | null;
  request_id?: string;
  body_from_caller: { rotation: number[]; scale: number; translation: Vector };
  body: { [name: string]: Json };
  options: { [name: string]: Json };
  /** x, y, z and radius of each. */
  spheres: [number, number, number, number][];
  /** Two indices into `spheres` of each. */
  capsules: [number, number][];
  sphere_names: string[];
  sphere_parts: BodyPart[];
  sphere_mirrors: (number | null)[];
  sphere_places: ({ [name: string]: Json } | null)[];
  sphere_polygons?: (number | null)[];
  capsule_parts: BodyPart[];
  joints?: { [name: string]: Json }[];
  sphere_joints?: (number | null)[];
  sphere_joint_drift_m?: (number | null)[];
  capsule_joints?: (number | null)[];
  sparse_weights?: { vertex_count: number; rows: { [name: string]: Json }[] };
  bone_weights?: { rows: { [name: string]: Json }[] };
  landmarks: { [name: string]: Json };
  warnings: { code: string; message: string; count: number }[];
  metrics: { [name: string]: Json };
  stages: { [stage: string]: number };
  seconds: number;
  feature_polygons?: { [name: string]: Json }[];
}

export function resultJson(result: ResultMembers): ResultJson {
  const { spheres, capsules, summary, featurePolygons } = result;
  return {
    format: "capfit-result",
    format_version: 1,
    version: summary.version,
    unit: summary.options.unit,
    metres_per_unit: summary.bodyFromCaller.scale,
    up_axis: summary.options.upAxis,
    ...(summary.requestId === "" ? {} : { request_id: summary.requestId }),
    body_from_caller: { ...summary.bodyFromCaller },
    body: snakeCased(summary.body),
    options: snakeCased(summary.options),
    spheres: spheres.map(({ center, radius }) => [...center, radius]),
    capsules: capsules.map(({ first, second }) => [first, second]),
    sphere_names: spheres.map(({ name }) => name),
    sphere_parts: spheres.map(({ part }) => part),
    sphere_mirrors: spheres.map(({ mirror }) => mirror),
    sphere_places: spheres.map(({ place }) => place && snakeCased(place)),
    ...polygonsOf(spheres, featurePolygons),
    capsule_parts: capsules.map(({ part }) => part),
    ...skinningOf(result),
    landmarks: Object.fromEntries(
      Object.entries(result.landmarks).map(([name, landmark]) => [name, snakeCased(landmark)]),
    ),
    warnings: result.warnings.map((warning) => ({ ...warning })),
    metrics: snakeCased(result.metrics),
    stages: { ...summary.stages } as Record<string, number>,
    seconds: summary.seconds,
    ...(featurePolygons && { feature_polygons: featurePolygons.map(polygonJson) }),
  };
}

// What there is of joints and of the weights that have no files of their own.
function skinningOf(result: ResultMembers): Partial<ResultJson> {
  const { spheres, capsules, joints, sparseWeights, boneWeights, summary } = result;
  const isHung = spheres.length > 0 && spheres[0]!.joint !== null;
  return {
    ...(joints.length > 0 && { joints: joints.map(snakeCased) }),
    ...(isHung && {
      sphere_joints: spheres.map(({ joint }) => joint),
      sphere_joint_drift_m: spheres.map(({ jointDriftM }) => jointDriftM),
      capsule_joints: capsules.map(({ joint }) => joint),
    }),
    ...(sparseWeights && {
      sparse_weights: {
        vertex_count: summary.body.vertexCount, rows: sparseWeights.map(snakeCased),
      },
    }),
    ...(boneWeights && { bone_weights: { rows: boneWeights.map(snakeCased) } }),
  };
}

function polygonsOf(
  spheres: readonly Sphere[],
  featurePolygons: readonly FeaturePolygon[] | undefined,
): Pick<ResultJson, "sphere_polygons"> {
  return featurePolygons ? { sphere_polygons: spheres.map(({ polygon }) => polygon) } : {};
}

function polygonJson(polygon: FeaturePolygon): { [name: string]: Json } {
  const circles = polygon.circles.map(({ center, radius }) => [...center, radius]);
  return snakeCased({ ...polygon, circles });
}

function snakeCased(members: object): { [name: string]: Json } {
  return Object.fromEntries(
    Object.entries(members).map(([name, value]) => [
      name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`),
      jsonOf(value),
    ]),
  );
}

function jsonOf(value: unknown): Json {
  if (Array.isArray(value)) return value.map(jsonOf);
  return typeof value === "object" && value !== null ? snakeCased(value) : (value as Json);
}
