// Messages of the answer as members of a result: enums become words, vectors [x, y, z].
import { brokenContract } from "./errors";
import type { BodyFacts__Output } from "./generated/capfit/v1/BodyFacts";
import type { BodyPlace__Output } from "./generated/capfit/v1/BodyPlace";
import type { BodyPart__Output } from "./generated/capfit/v1/BodyPart";
import type { BodyPartGroup__Output } from "./generated/capfit/v1/BodyPartGroup";
import type { BoneWeights__Output } from "./generated/capfit/v1/BoneWeights";
import type { Capsule__Output } from "./generated/capfit/v1/Capsule";
import type { EffectiveBudget__Output } from "./generated/capfit/v1/EffectiveBudget";
import type { EffectiveOptions__Output } from "./generated/capfit/v1/EffectiveOptions";
import type { FeaturePolygon__Output } from "./generated/capfit/v1/FeaturePolygon";
import type { GetServerInfoResponse__Output } from "./generated/capfit/v1/GetServerInfoResponse";
import type { Joint__Output } from "./generated/capfit/v1/Joint";
import type { Landmark__Output } from "./generated/capfit/v1/Landmark";
import type { Metrics__Output } from "./generated/capfit/v1/Metrics";
import type { PartMetrics__Output } from "./generated/capfit/v1/PartMetrics";
import type { SparseWeights__Output } from "./generated/capfit/v1/SparseWeights";
import type { Sphere__Output } from "./generated/capfit/v1/Sphere";
import type { StageTime__Output } from "./generated/capfit/v1/StageTime";
import type { Summary__Output } from "./generated/capfit/v1/Summary";
import type { Vector3__Output } from "./generated/capfit/v1/Vector3";
import type { Vector } from "./options";
import type {
  BodyFacts, BodyPlace, BoneRow, Capsule, EffectiveBudget, EffectiveOptions, FeaturePolygon, Joint, Landmark,
  Metrics, PartMetrics, ServerInfo, SparseRow, Sphere, Summary,
} from "./result";
import {
  type BodyPart, type BodyPartGroup, bodyPartGroups, bodyParts, bones, capsuleProfiles, fitModes,
  landmarkMethods, lengthUnits, meshFileFormats, meshPartKinds, qualities, sexes, skinningForms,
  stages, upAxes,
} from "./words";

// What the contract promises to be there.
export function filled<Value>(value: Value | null | undefined, name: string): Value {
  if (value === null || value === undefined) throw brokenContract(`${name} is not there`);
  return value;
}

function vectorOf(vector: Vector3__Output | null): Vector {
  const { x, y, z } = filled(vector, "a vector");
  return [x, y, z];
}

function partOf(part: BodyPart__Output): BodyPart {
  return filled(bodyParts.fromWire(part), "a part");
}

function placeOf(place: BodyPlace__Output | null): BodyPlace | null {
  return place && { ...place, bone: filled(bones.fromWire(place.bone), "a bone") };
}

export function sphereOf(sphere: Sphere__Output): Sphere {
  return {
    center: vectorOf(sphere.center),
    radius: sphere.radius,
    part: partOf(sphere.part),
    name: sphere.name,
    mirror: sphere.mirror ?? null,
    place: placeOf(sphere.place),
    polygon: sphere.polygon ?? null,
    joint: sphere.joint ?? null,
    jointDriftM: sphere.jointDriftM ?? null,
  };
}

export function capsuleOf(capsule: Capsule__Output): Capsule {
  const { firstSphere: first, secondSphere: second, part } = capsule;
  return { first, second, part: partOf(part), joint: capsule.joint ?? null };
}

export function jointOf(joint: Joint__Output): Joint {
  return {
    name: joint.name,
    parent: joint.parent ?? null,
    humanBone: joint.humanBone,
    toMesh: joint.toMesh,
    node: joint.node ?? null,
  };
}

// Where each row of a matrix begins and ends.
function rowsOf(sizes: readonly number[], count: number): [number, number][] {
  let end = 0;
  const rows = sizes.map((size): [number, number] => [end, (end += size)]);
  if (end !== count || sizes.some((size) => size < 0)) {
    throw brokenContract(`rows of ${end} weights, of which there are ${count}`);
  }
  return rows;
}

export function sparseRowsOf(sparse: SparseWeights__Output, vertexCount: number): SparseRow[] {
  const { rowSizes, vertexSteps, weights } = sparse;
  if (vertexSteps.length !== weights.length || vertexSteps.some((step) => step < 0)) {
    throw brokenContract("sparse weights that do not fit together");
  }
  return rowsOf(rowSizes, weights.length).map(([begin, end]) => {
    let vertex = 0;
    const vertices = vertexSteps.slice(begin, end).map((step) => (vertex += step));
    if (vertex >= vertexCount) throw brokenContract(`sparse weights of vertex ${vertex}`);
    return { vertices, weights: weights.slice(begin, end) };
  });
}

export function boneRowsOf(bones: BoneWeights__Output, jointCount: number): BoneRow[] {
  const { rowSizes, joints, weights, offsets } = bones;
  if (joints.length !== weights.length || offsets.length !== 3 * weights.length
    || joints.some((at) => at < 0 || at >= jointCount)) {
    throw brokenContract("bone weights that do not fit together");
  }
  return rowsOf(rowSizes, weights.length).map(([begin, end]) => ({
    joints: joints.slice(begin, end),
    weights: weights.slice(begin, end),
    offsets: joints.slice(begin, end).map((_, i): Vector => {
      const at = 3 * (begin + i);
      return [offsets[at]!, offsets[at + 1]!, offsets[at + 2]!];
    }),
  }));
}

export function landmarkOf(landmark: Landmark__Output): Landmark {
  return {
    position: vectorOf(landmark.position),
    method: landmarkMethods.fromWire(landmark.method),
    confidence: landmark.confidence,
  };
}

export function polygonOf(polygon: FeaturePolygon__Output): FeaturePolygon {
  return {
    name: polygon.name,
    part: partOf(polygon.part),
    outline: polygon.outline.map(vectorOf),
    circles: polygon.circles.map(({ center, radius }) => ({ center: vectorOf(center), radius })),
    outsideAreaRatio: polygon.outsideAreaRatio,
  };
}

export function metricsOf(metrics: Metrics__Output): Metrics {
  const parts = metrics.parts.map((part) => [partOf(part.part), partMetricsOf(part)] as const);
  return {
    ...metrics,
    gap: filled(metrics.gap, "metrics.gap"),
    parts: Object.fromEntries(parts) as Metrics["parts"],
  };
}

function partMetricsOf({ part: _, ...metrics }: PartMetrics__Output): PartMetrics {
  return { ...metrics, gap: filled(metrics.gap, "metrics.parts.gap") };
}

export function summaryOf(summary: Summary__Output): Summary {
  const similarity = filled(summary.bodyFromCaller, "summary.body_from_caller");
  return {
    requestId: summary.requestId,
    version: summary.version,
    stages: stageSecondsOf(summary.stages),
    seconds: summary.seconds,
    bodyFromCaller: { ...similarity, translation: vectorOf(similarity.translation) },
    options: optionsOf(filled(summary.options, "summary.options")),
    body: bodyOf(filled(summary.body, "summary.body")),
  };
}

function stageSecondsOf(times: readonly StageTime__Output[]): Summary["stages"] {
  const pairs = times.map(({ stage, seconds }) => [stages.fromWire(stage), seconds]);
  return Object.fromEntries(pairs) as Summary["stages"];
}

function bodyOf(body: BodyFacts__Output): BodyFacts {
  return {
    ...body,
    boxMin: vectorOf(body.boxMin),
    boxMax: vectorOf(body.boxMax),
    parts: body.parts.map((part) => ({ ...part, kind: meshPartKinds.fromWire(part.kind) })),
  };
}

function optionsOf(options: EffectiveOptions__Output): EffectiveOptions {
  return {
    ...options,
    budget: budgetOf(filled(options.budget, "summary.options.budget")),
    fitMode: fitModes.fromWire(options.fitMode),
    quality: qualities.fromWire(options.quality),
    parts: groupsOf(options.parts),
    requireParts: groupsOf(options.requireParts),
    sex: sexes.fromWire(options.sex),
    skinning: skinningForms.fromWire(options.skinning),
    capsuleProfile: capsuleProfiles.fromWire(options.capsuleProfile),
    unit: lengthUnits.fromWire(options.unit),
    upAxis: upAxes.fromWire(options.upAxis),
  };
}

function groupsOf(groups: readonly BodyPartGroup__Output[]): BodyPartGroup[] {
  return groups.map((group) => filled(bodyPartGroups.fromWire(group), "a part"));
}

// Without protobufjs' marks of what is set ("_maxPrimitives").
function budgetOf(budget: EffectiveBudget__Output): EffectiveBudget {
  return Object.fromEntries(Object.entries(budget).filter(([name]) => !name.startsWith("_")));
}

export function serverInfoOf(info: GetServerInfoResponse__Output): ServerInfo {
  return {
    version: info.version,
    limits: filled(info.limits, "limits"),
    formats: info.formats.map((format) => filled(meshFileFormats.fromWire(format), "a format")),
    engines: info.engines.map((engine) => ({
      ...engine,
      profile: capsuleProfiles.fromWire(engine.profile),
    })),
    features: info.features,
    layouts: info.layouts,
    exportFormats: info.exportFormats,
  };
}
