// What is tried again and what is not, and errors of servers yet to come.
import assert from "node:assert/strict";
import { test } from "node:test";
import { status } from "@grpc/grpc-js";

import { CapfitClient, CapfitError } from "capfit";

import { file } from "./bodies.js";
import { type Answer, FakeServer, trailers } from "./fake_server.js";

const full = (pushback?: string, wait?: object): Answer => ({
  code: status.RESOURCE_EXHAUSTED,
  details: "all places are taken",
  metadata: trailers(
    [
      { type: "google.rpc.ErrorInfo", value: { reason: "SERVER_FULL", domain: "capfit" } },
      ...(wait ? [{ type: "google.rpc.RetryInfo", value: { retryDelay: wait } } as const] : []),
    ],
    pushback,
  ),
});
const info: Answer = { messages: [{ version: "9", limits: {}, features: ["a.word"] }] };

async function withServer(
  answer: (call: number) => Answer,
  use: (client: CapfitClient, server: FakeServer) => Promise<void>,
): Promise<void> {
  const server = new FakeServer(answer);
  const client = new CapfitClient(await server.start());
  try {
    await use(client, server);
  } finally {
    client.close();
    server.stop();
  }
}

const isCapfitError = (check: (error: CapfitError) => boolean) => (error: unknown) =>
  error instanceof CapfitError && check(error);

test("a full server is asked again after the pause that it names", () =>
  withServer((call) => (call < 3 ? full("50") : info), async (client, server) => {
    const begin = Date.now();
    assert.equal((await client.serverInfo()).version, "9");
    assert.equal(server.calls, 3);
    assert.ok(Date.now() - begin >= 98);
  }));

test("four attempts, then the error tells the pause", () =>
  withServer(() => full("7"), async (client, server) => {
    await assert.rejects(client.approximate({ file }), isCapfitError((error) =>
      error.code === "RESOURCE_EXHAUSTED" && error.reason === "SERVER_FULL" &&
      error.retryMs === 7 && error.message === "all places are taken"));
    assert.equal(server.calls, 4);
  }));

test("RetryInfo alone serves as well", () => {
  const wait = { nanos: 2e7 };
  return withServer((call) => (call < 2 ? full(undefined, wait) : info), async (client, server) => {
    await client.serverInfo();
    assert.equal(server.calls, 2);
  });
});

for (const [name, pushback] of [["no pause", undefined], ["a pause below 0", "-1"]] as const) {
  test(`not asked again: ${name}`, () =>
    withServer(() => full(pushback), async (client, server) => {
      await assert.rejects(client.serverInfo(), CapfitError);
      assert.equal(server.calls, 1);
    }));
}

test("not asked again: a pause that ends after the call's time", () =>
  withServer(() => full("60000"), async (client, server) => {
    await assert.rejects(client.serverInfo({ timeoutMs: 50000 }),
      isCapfitError((error) => error.code === "RESOURCE_EXHAUSTED"));
    assert.equal(server.calls, 1);
  }));

test("a stopping server is asked again", () => {
  const stopping = { code: status.UNAVAILABLE, details: "stopping", metadata: trailers([]) };
  return withServer((call) => (call < 2 ? stopping : info), async (client, server) => {
    await client.serverInfo();
    assert.equal(server.calls, 2);
  });
});

test("a signal ends the pause", () => {
  const stop = new AbortController();
  const answer = () => {
    setTimeout(() => stop.abort(), 100);
    return full("100000");
  };
  return withServer(answer, async (client, server) => {
    await assert.rejects(client.approximate({ file }, {}, { signal: stop.signal }),
      isCapfitError((error) => error.code === "CANCELLED"));
    assert.equal(server.calls, 1);
  });
});

test("all details of an error, known or not, and its warnings", () => {
  const warning = { code: "HOLES_CLOSED", message: "2 holes were closed", count: 2 };
  const metadata = { field: "mesh.file", line: "7495", value: "x", limit: "y", news: "z" };
  const answer: Answer = {
    code: status.FAILED_PRECONDITION,
    details: "file line 7495",
    metadata: trailers([
      { type: "other.Detail", value: {} },
      { type: "google.rpc.ErrorInfo", value: { reason: "A_LATER_REASON", metadata } },
      { type: "capfit.v1.Warning", value: warning },
    ]),
  };
  return withServer(() => answer, async (client, server) => {
    await assert.rejects(client.approximate({ file }), (error) => {
      assert.ok(error instanceof CapfitError);
      const { code, reason, field, value, limit, retryMs } = error;
      assert.deepEqual(
        { code, reason, field, value, limit, retryMs },
        {
          code: "FAILED_PRECONDITION", reason: "A_LATER_REASON", field: "mesh.file", value: "x",
          limit: "y", retryMs: undefined,
        });
      assert.deepEqual(error.metadata, metadata);
      assert.deepEqual(error.warnings, [warning]);
      return true;
    });
    assert.equal(server.calls, 1);
  });
});

const primitives = { primitives: { spheres: [{ center: {}, radius: 1, part: 1, name: "a" }] } };
const weights = (firstSphere: number) => ({
  skinning: {
    totalSphereCount: 2, totalVertexCount: 2, firstSphere, sphereCount: 1,
    dense: { vertexCount: 2, weights: [0.5, 0.5] },
  },
});
const broken: [string, object[]][] = [
  ["no summary", [primitives]],
  ["nothing", []],
  ["weights out of order", [primitives, weights(1)]],
  ["half of the weights", [primitives, weights(0), { summary: { metrics: { gap: {} } } }]],
];
for (const [name, messages] of broken) {
  test(`an answer that breaks the contract is no result: ${name}`, () =>
    withServer(() => ({ messages }), async (client) => {
      await assert.rejects(client.approximate({ file }), isCapfitError((error) =>
        error.code === "INTERNAL" && /breaks the contract/.test(error.message)));
    }));
}
