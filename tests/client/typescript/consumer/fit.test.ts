// Results of a real server.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";

import {
  CapfitClient, CapfitError, type Progress, type Result, type Sphere, type Vector,
} from "capfit";

import { address, file, polygons, triangles, vertices } from "./bodies.js";

const client = new CapfitClient(address);
after(() => client.close());

const vertexCount = vertices.length / 3;
const distance = (a: Vector, b: Vector) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

function checkModel(result: Result): void {
  const { spheres, capsules, metrics } = result;
  assert.ok(spheres.length >= 10);
  assert.equal(metrics.sphereCount, spheres.length);
  assert.equal(metrics.capsuleCount, capsules.length);
  assert.equal(new Set(spheres.map(({ name }) => name)).size, spheres.length);
  assert.ok(spheres.every(({ radius, center }) => radius > 0 && center.every(Number.isFinite)));
  for (const { first, second } of capsules) {
    assert.ok(0 <= first && first < second && second < spheres.length);
  }
}

test("a file gives spheres and capsules with their parts, names and mirrors", async () => {
  const seen: Progress[] = [];
  const result = await client.approximate(
    { file, format: "obj" },
    { maxPrimitives: 64, parts: "all", quality: "tight" },
    { timeoutMs: 120_000, onProgress: (progress) => seen.push(progress), requestId: "a job" },
  );
  checkModel(result);
  assert.ok(result.metrics.primitiveCount <= 64);
  assert.ok(result.spheres.some(({ part }) => part === "head"));
  result.spheres.forEach(({ mirror }, index) => {
    assert.equal(result.spheres[mirror!]?.mirror, index, `mirror of sphere ${index}`);
  });
  assert.ok(result.metrics.volumeError > 0 && result.metrics.volumeError < 1);
  assert.ok(result.metrics.parts.left_arm!.gap.meanM > 0);
  assert.ok(distance(result.landmarks["left_wrist"]!.position, [0, 0, 0]) > 0);
  for (const { method, confidence } of Object.values(result.landmarks)) {
    assert.ok(method === "measured" || method === "ratio");
    assert.ok(confidence > 0 && confidence <= 1);
  }
  assert.equal(result.weights, undefined);
  assert.equal(result.vertexGaps, undefined);
  assert.equal(result.featurePolygons, undefined);

  const { summary } = result;
  assert.equal(summary.requestId, "a job");
  assert.equal(summary.version, process.env["CAPFIT_VERSION"]);
  assert.deepEqual(summary.options.budget, { maxPrimitives: 64 });
  assert.equal(summary.options.quality, "tight");
  assert.equal(summary.options.fitMode, "enclose");
  assert.deepEqual(summary.options.parts, ["torso", "arms", "legs", "head", "hands", "feet"]);
  assert.equal(summary.body.vertexCount, vertexCount);
  assert.ok(summary.seconds > 0 && summary.stages.mesh! > 0);

  assert.ok(seen.length > 1);
  seen.forEach(({ fractionDone }, index) => {
    assert.ok(fractionDone >= (seen[index - 1]?.fractionDone ?? 0) && fractionDone <= 1);
  });
});

test("arrays give the spheres of the file", async () => {
  const wanted = await client.approximate({ file });
  for (const faces of [triangles, polygons]) {
    const result = await client.approximate({ vertices, faces });
    assert.deepEqual(result.spheres, wanted.spheres);
    assert.deepEqual(result.capsules, wanted.capsules);
  }
  // Of many primitives some hang in a balance that the rounding tips.
  const few = { maxPrimitives: 32 };
  const exact = await client.approximate({ vertices, faces: polygons }, few);
  const rounded = Float32Array.from(vertices);
  const single = await client.approximate({ vertices: rounded, faces: polygons }, few);
  assert.equal(single.spheres.length, exact.spheres.length);
  single.spheres.forEach(({ center }, index) => {
    assert.ok(distance(center, exact.spheres[index]!.center) < 1e-4);
  });
});

test("sparse weights carry the centres and stand in the file", async () => {
  const result = await client.approximate({ file }, { skinning: "sparse" });
  const rows = result.sparseWeights!;
  assert.equal(rows.length, result.spheres.length);
  result.spheres.forEach(({ center, joint }: Sphere, index) => {
    assert.equal(joint, null);
    const sum: Vector = [0, 0, 0];
    const { vertices: indices, weights } = rows[index]!;
    assert.ok(indices.length <= 128);
    indices.forEach((vertex, i) => {
      for (let axis = 0; axis < 3; axis++) sum[axis]! += weights[i]! * vertices[3 * vertex + axis]!;
    });
    assert.ok(distance(sum, center) < 1e-5, `sphere ${index} is carried to ${sum}`);
  });
  assert.equal(result.toJson().sparse_weights!.rows.length, rows.length);
  assert.equal(result.toJson().joints, undefined);
});

test("weights carry the centres", async () => {
  const { spheres, weights } = await client.approximate({ file }, { skinning: "dense" });
  assert.equal(weights!.length, spheres.length);
  spheres.forEach(({ center }: Sphere, index) => {
    const row = weights![index]!;
    assert.equal(row.length, vertexCount);
    const sum: Vector = [0, 0, 0];
    row.forEach((weight, vertex) => {
      for (let axis = 0; axis < 3; axis++) sum[axis]! += weight * vertices[3 * vertex + axis]!;
    });
    assert.ok(distance(sum, center) < 1e-3, `sphere ${index} is carried to ${sum}`);
  });
});

test("vertex gaps and feature polygons come where they are asked for", async () => {
  const result = await client.approximate(
    { file }, { parts: "all", wantVertexGaps: true, wantFeaturePolygons: true });
  assert.equal(result.vertexGaps!.length, vertexCount);
  assert.ok(Math.max(...result.vertexGaps!.filter((gap) => !Number.isNaN(gap))) < 1e-4);
  const featurePolygons = result.featurePolygons!;
  assert.ok(featurePolygons.some(({ name }) => name === "waist"));
  assert.ok(featurePolygons.every(({ outline, circles }) =>
    outline.length >= 3 && circles.every(({ radius }) => radius >= 0)));
  const used = result.spheres.map(({ polygon }) => polygon).filter((polygon) => polygon !== null);
  assert.ok(used.length > 0 && used.every((polygon) => featurePolygons[polygon!] !== undefined));
  const json = result.toJson();
  assert.equal(json.feature_polygons!.length, featurePolygons.length);
  assert.deepEqual(json.sphere_polygons, result.spheres.map(({ polygon }) => polygon));
});

test("a layout is kept, by name and from a former result", async () => {
  const kept = ({ spheres, capsules }: Result) => ({
    names: spheres.map(({ name }) => name),
    ends: capsules.map(({ first, second }) => [first, second]),
  });
  const first = await client.approximate({ file }, {}, { layout: "standard-32" });
  const standard = (await client.serverInfo()).layouts.find(({ name }) => name === "standard-32")!;
  assert.equal(first.spheres.length, standard.sphereCount);
  const second = await client.approximate({ file }, { quality: "tight" }, { layout: first });
  assert.deepEqual(kept(second), kept(first));
  await assert.rejects(client.approximate({ file }, {}, { layout: "standard-33" }),
    (error: CapfitError) => error.code === "INVALID_ARGUMENT" && error.field === "layout.name");
});

test("files for engines come along, whole", async () => {
  const { exports, spheres } = await client.approximate(
    { file }, {}, { exports: ["csv", { format: "usd", plain: true, maxOvershootM: 0.01 }] });
  const names = Object.keys(exports);
  assert.ok(names.some((name) => name.endsWith(".usda")));
  const csv = names.filter((name) => name.endsWith(".csv"))
    .map((name) => new TextDecoder().decode(exports[name]!)).join("\n");
  assert.ok(spheres.every(({ name }) => csv.includes(name)));
  const none = await client.approximate({ file });
  assert.deepEqual(none.exports, {});
  await assert.rejects(client.approximate({ file }, {}, { exports: ["dae"] }),
    (error: CapfitError) => error.code === "INVALID_ARGUMENT" && error.field === "exports[0].format");
});

test("every option arrives", async () => {
  const first = await client.approximate({ file });
  const { position } = first.landmarks["left_wrist"]!;
  const result = await client.approximate(
    { file, unit: "metre", upAxis: "y" },
    {
      maxSpheres: 40, maxCapsules: 30, engine: "nvcloth", fitMode: "best_fit", quality: "paper",
      parts: ["torso", "arms"], requireParts: ["arms"], sex: "female", skinning: "none",
      landmarks: { left_wrist: position }, seed: 2n ** 40n + 1n,
    },
  );
  checkModel(result);
  assert.equal(result.landmarks["left_wrist"]!.method, "caller");
  const { options } = result.summary;
  assert.equal(options.budget.maxSpheres! <= 40, true);
  assert.equal(options.budget.maxCapsules! <= 30, true);
  assert.equal(options.engine, "nvcloth");
  assert.equal(options.fitMode, "best_fit");
  assert.deepEqual(options.parts, ["torso", "arms"]);
  assert.deepEqual(options.requireParts, ["arms"]);
  assert.equal(options.sex, "female");
  assert.equal(options.callerLandmarkCount, 1);
  assert.equal(options.seed, 2 ** 40 + 1);
  assert.equal(options.unit, "metre");
  assert.equal(options.upAxis, "y");

  const loose = await client.approximate({ file }, { maxPolygonError: 1.5, toleranceM: 0.01 });
  assert.equal(loose.summary.options.budget.maxPolygonError, 1.5);
  assert.equal(loose.summary.options.toleranceM, 0.01);
});

test("toJson is what the command line writes", async () => {
  const result = await client.approximate({ file }, { parts: "all", maxPrimitives: 80, seed: 7 });
  const ours = JSON.parse(JSON.stringify(result));
  assert.deepEqual(ours, result.toJson());
  const theirs = JSON.parse(readFileSync(process.env["CAPFIT_RESULT"]!, "utf8"));
  assert.deepEqual(Object.keys(ours.stages), Object.keys(theirs.stages));
  for (const json of [ours, theirs]) {
    delete json.seconds;
    delete json.stages;
  }
  assert.deepEqual(ours, theirs);
  assert.deepEqual(Object.keys(ours), Object.keys(theirs));
});

test("the server tells what it takes", async () => {
  const info = await client.serverInfo();
  assert.equal(info.version, process.env["CAPFIT_VERSION"]);
  assert.ok(info.limits.maxUploadBytes > 1e6);
  assert.deepEqual(info.formats, ["obj", "ply", "stl", "off", "glb"]);
  assert.ok(info.engines.some(({ name, profile }) => name === "nvcloth" && profile !== null));
  assert.ok(info.features.includes("quality.tight"));
});
