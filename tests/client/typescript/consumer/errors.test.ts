// Failures of a real server and of calls that never reach one.
import assert from "node:assert/strict";
import { after, test } from "node:test";

import { CapfitClient, CapfitError } from "capfit";

import { address, file, triangles, vertices } from "./bodies.js";

const client = new CapfitClient(address);
after(() => client.close());

async function errorOf(call: Promise<unknown>): Promise<CapfitError> {
  try {
    await call;
  } catch (error) {
    assert.ok(error instanceof CapfitError, String(error));
    return error;
  }
  return assert.fail("the call succeeded");
}

test("a value beyond its range names field, value and limit", async () => {
  const error = await errorOf(client.approximate({ file }, { maxPrimitives: 3 }));
  assert.equal(error.code, "INVALID_ARGUMENT");
  assert.equal(error.reason, "OUT_OF_RANGE");
  assert.equal(error.field, "options.budget.max_primitives");
  assert.equal(error.value, "3");
  assert.match(error.limit!, /15/);
  assert.match(error.message, /options\.budget\.max_primitives/);
});

test("faults of the mesh are named as the caller counts", async () => {
  const broken = Float32Array.from(vertices);
  broken[22] = NaN;
  const notFinite = await errorOf(client.approximate({ vertices: broken, faces: triangles }));
  assert.equal(notFinite.reason, "NOT_FINITE");
  assert.equal(notFinite.field, "mesh.arrays.positions[22]");

  const text = await errorOf(client.approximate({ file: Buffer.from("no mesh at all") }));
  assert.equal(text.code, "INVALID_ARGUMENT");
  assert.match(text.reason!, /^(UNSUPPORTED|MALFORMED)_FILE$/);

  const empty = await errorOf(client.approximate({ file: new Uint8Array(0) }));
  assert.equal(empty.reason, "MISSING");
});

test("a mesh that is no body", async () => {
  const corners = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
  const faces = Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3);
  const error = await errorOf(client.approximate({ vertices: corners, faces }));
  assert.equal(error.code, "FAILED_PRECONDITION");
  assert.equal(error.reason, "NOT_A_BODY");
});

test("bones of a mesh without any are refused", async () => {
  const error = await errorOf(client.approximate({ file }, { skinning: "bones" }));
  assert.equal(error.code, "INVALID_ARGUMENT");
  assert.equal(error.reason, "CONFLICT");
  assert.equal(error.field, "options.skinning");
});

// What proto-loader would drop, cut off or replace by the default.
const refused: [string, string, string, () => Promise<unknown>][] = [
  ["another case", "options.maxprimitives", "UNKNOWN_VALUE",
    // @ts-expect-error no such option
    () => client.approximate({ file }, { maxprimitives: 32 })],
  ["the wire's name", "options.max_primitives", "UNKNOWN_VALUE",
    // @ts-expect-error no such option
    () => client.approximate({ file }, { max_primitives: 32 })],
  ["the wire's nesting", "options.budget", "UNKNOWN_VALUE",
    // @ts-expect-error no such option
    () => client.approximate({ file }, { budget: { maxPrimitives: 32 } })],
  ["a mesh's member", "options.unit", "UNKNOWN_VALUE",
    // @ts-expect-error no such option
    () => client.approximate({ file }, { unit: "metre" })],
  ["an option in the mesh", "mesh.maxPrimitives", "UNKNOWN_VALUE",
    // @ts-expect-error no such member
    () => client.approximate({ file, maxPrimitives: 32 })],
  ["an option in the call", "call.timeout", "UNKNOWN_VALUE",
    // @ts-expect-error no such member
    () => client.approximate({ file }, {}, { timeout: 3 })],
  ["an unknown word", "options.quality", "UNKNOWN_VALUE",
    // @ts-expect-error no such word
    () => client.approximate({ file }, { quality: "TIGHT" })],
  ["an unknown part", "options.parts[1]", "UNKNOWN_VALUE",
    // @ts-expect-error no such word
    () => client.approximate({ file }, { parts: ["torso", "tail"] })],
  ["a string for a number", "options.budget.max_primitives", "UNKNOWN_VALUE",
    // @ts-expect-error not a number
    () => client.approximate({ file }, { maxPrimitives: "32" })],
  ["a path for bytes", "mesh.file", "UNKNOWN_VALUE",
    // @ts-expect-error not bytes
    () => client.approximate({ file: "body.obj" })],
  ["plain numbers for vertices", "mesh.vertices", "UNKNOWN_VALUE",
    // @ts-expect-error not a typed array
    () => client.approximate({ vertices: [1, 2, 3], faces: triangles })],
  ["a fraction", "options.budget.max_primitives", "OUT_OF_RANGE",
    () => client.approximate({ file }, { maxPrimitives: 64.5 })],
  ["NaN", "options.budget.max_primitives", "NOT_FINITE",
    () => client.approximate({ file }, { maxPrimitives: NaN })],
  ["a seed below 0", "options.seed", "OUT_OF_RANGE",
    () => client.approximate({ file }, { seed: -1 })],
  ["two budgets", "options.budget", "CONFLICT",
    () => client.approximate({ file }, { maxPrimitives: 32, maxSpheres: 32 })],
  ["half a vertex", "mesh.arrays.positions_double", "COUNT_MISMATCH",
    () => client.approximate({ vertices: vertices.subarray(1), faces: triangles })],
  ["no time", "call.timeoutMs", "OUT_OF_RANGE",
    () => client.approximate({ file }, {}, { timeoutMs: 0 })],
];
for (const [name, field, reason, call] of refused) {
  test(`refused before anything is sent: ${name}`, async () => {
    const error = await errorOf(call());
    assert.deepEqual([error.code, error.field, error.reason], ["INVALID_ARGUMENT", field, reason]);
  });
}

test("a near name is suggested", async () => {
  const options = { max_primitives: 32 } as object;
  assert.match((await errorOf(client.approximate({ file }, options))).message, /maxPrimitives\?/);
});

test("the time of a call ends it", async () => {
  const error = await errorOf(client.approximate({ file }, {}, { timeoutMs: 1 }));
  assert.deepEqual([error.code, error.reason], ["DEADLINE_EXCEEDED", "DEADLINE_EXCEEDED"]);
});

test("a signal ends a call", async () => {
  const stop = new AbortController();
  const why = new Error("enough");
  const error = await errorOf(client.approximate({ file }, { quality: "tight" }, {
    signal: stop.signal,
    onProgress: () => stop.abort(why),
  }));
  assert.deepEqual([error.code, error.reason, error.cause], ["CANCELLED", "CANCELLED", why]);
  assert.equal((await errorOf(client.serverInfo({ signal: stop.signal }))).code, "CANCELLED");
});

test("what onProgress throws ends the call", async () => {
  const why = new Error("no more");
  const call = client.approximate({ file }, {}, { onProgress: () => { throw why; } });
  await assert.rejects(call, (error) => error === why);
});

test("a server that is not there is named", async () => {
  const nobody = new CapfitClient("127.0.0.1:1");
  for (const call of [nobody.serverInfo(), nobody.approximate({ file })]) {
    const error = await errorOf(call);
    assert.equal(error.code, "UNAVAILABLE");
    assert.match(error.message, /cannot reach 127\.0\.0\.1:1/);
    assert.equal(error.reason, undefined);
  }
  nobody.close();
});

test("an address without a port means the default port", async () => {
  const nobody = new CapfitClient("capfit.invalid");
  assert.match((await errorOf(nobody.serverInfo())).message, /capfit\.invalid:50051/);
  nobody.close();
});
