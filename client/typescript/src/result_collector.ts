// Gathers the messages of an answer into a result. What the contract does not allow is an error: a
// result is whole or it is not there.
import { brokenContract } from "./errors";
import { ExportFiles } from "./extras";
import type {
  ApproximateBodyResponse__Output as Response,
} from "./generated/capfit/v1/ApproximateBodyResponse";
import type { PrimitiveSet__Output } from "./generated/capfit/v1/PrimitiveSet";
import type { SkinningChunk__Output } from "./generated/capfit/v1/SkinningChunk";
import type { Summary__Output } from "./generated/capfit/v1/Summary";
import type { VertexGapsChunk__Output } from "./generated/capfit/v1/VertexGapsChunk";
import {
  type BoneRow, type FeaturePolygon, type Landmark, Result, type SparseRow,
} from "./result";
import type { Warning } from "./errors";
import {
  boneRowsOf, capsuleOf, filled, jointOf, landmarkOf, metricsOf, polygonOf, sparseRowsOf, sphereOf,
  summaryOf,
} from "./result_conversion";
import { type Stage, stages } from "./words";

/** How far a fit is. */
export interface Progress {
  stage: Stage;
  /** Estimate for the whole fit, from 0 to 1. Falls only where a new attempt begins. */
  fractionDone: number;
}

export type ProgressFunction = (progress: Progress) => void;

// Numbers that come in pieces, in order and without gaps.
class Pieces {
  private count = 0;

  constructor(readonly numbers: Float32Array, private readonly what: string) {}

  add(begin: number, piece: readonly number[]): void {
    if (begin !== this.count || begin + piece.length > this.numbers.length) {
      throw brokenContract(`${this.what} are not where the ones before end`);
    }
    this.numbers.set(piece, begin);
    this.count += piece.length;
  }

  whole(): Float32Array {
    if (this.count === this.numbers.length) return this.numbers;
    throw brokenContract(`${this.count} ${this.what} of ${this.numbers.length}`);
  }
}

export class ResultCollector {
  private readonly warnings: Warning[] = [];
  private readonly landmarks: Record<string, Landmark> = {};
  private readonly polygons: FeaturePolygon[] = [];
  private primitives: PrimitiveSet__Output | undefined;
  private weights: Pieces | undefined;
  private columnCount = 0;
  private sparseWeights: SparseRow[] | undefined;
  private boneWeights: BoneRow[] | undefined;
  private gaps: Pieces | undefined;
  private readonly exports = new ExportFiles();
  private summary: Summary__Output | undefined;

  constructor(
    private readonly onProgress: ProgressFunction | undefined,
    private readonly wantsPolygons: boolean,
  ) {}

  add(response: Response): void {
    if (response.progress) {
      const { stage, fractionDone } = response.progress;
      this.onProgress?.({ stage: filled(stages.fromWire(stage), "progress.stage"), fractionDone });
    } else if (response.warning) {
      this.warnings.push(response.warning);
    } else if (response.landmarks) {
      for (const one of response.landmarks.landmarks) this.landmarks[one.name] = landmarkOf(one);
    } else if (response.featurePolygon) {
      this.polygons.push(polygonOf(response.featurePolygon));
    } else if (response.primitives) {
      this.primitives = response.primitives;
    } else if (response.skinning) {
      this.addWeights(response.skinning);
    } else if (response.vertexGaps) {
      this.addGaps(response.vertexGaps);
    } else if (response.exportChunk) {
      this.exports.add(response.exportChunk);
    } else if (response.summary) {
      this.summary = response.summary;
    }
  }

  finish(): Result {
    const primitives = filled(this.primitives, "primitives");
    const summary = filled(this.summary, "summary");
    return new Result({
      spheres: primitives.spheres.map(sphereOf),
      capsules: primitives.capsules.map(capsuleOf),
      landmarks: this.landmarks,
      warnings: this.warnings,
      metrics: metricsOf(filled(summary.metrics, "summary.metrics")),
      weights: this.weightRows(primitives.spheres.length),
      sparseWeights: this.ofEachSphere(this.sparseWeights, primitives.spheres.length),
      boneWeights: this.ofEachSphere(this.boneWeights, primitives.spheres.length),
      joints: primitives.joints.map(jointOf),
      vertexGaps: this.gaps?.whole(),
      featurePolygons: this.wantsPolygons ? this.polygons : undefined,
      exports: this.exports.whole(),
      summary: summaryOf(summary),
    });
  }

  private addWeights(chunk: SkinningChunk__Output): void {
    if (chunk.sparse) {
      this.sparseWeights = sparseRowsOf(chunk.sparse, chunk.totalVertexCount);
      return;
    }
    if (chunk.bones) {
      this.boneWeights = boneRowsOf(chunk.bones, this.primitives?.joints.length ?? 0);
      return;
    }
    const dense = filled(chunk.dense, "skinning.dense");
    this.columnCount = chunk.totalVertexCount;
    this.weights ??= new Pieces(
      new Float32Array(chunk.totalSphereCount * chunk.totalVertexCount), "weights");
    this.weights.add(chunk.firstSphere * this.columnCount + dense.firstVertex, dense.weights);
  }

  private addGaps(chunk: VertexGapsChunk__Output): void {
    this.gaps ??= new Pieces(new Float32Array(chunk.totalVertexCount), "vertex gaps");
    this.gaps.add(chunk.firstVertex, chunk.gaps);
  }

  private ofEachSphere<Row>(rows: Row[] | undefined, sphereCount: number): Row[] | undefined {
    if (rows === undefined || rows.length === sphereCount) return rows;
    throw brokenContract(`${rows.length} rows of weights for ${sphereCount} spheres`);
  }

  private weightRows(sphereCount: number): Float32Array[] | undefined {
    const numbers = this.weights?.whole();
    if (numbers === undefined) return undefined;
    return Array.from({ length: sphereCount }, (_, row) =>
      numbers.subarray(row * this.columnCount, (row + 1) * this.columnCount));
  }
}
