// The package from CommonJS, without types.
const assert = require("node:assert/strict");
const { test } = require("node:test");

const { CapfitClient, CapfitError, Result } = require("capfit");

test("require() gives the client", async () => {
  const client = new CapfitClient(process.env.CAPFIT_ADDRESS);
  assert.equal((await client.serverInfo()).version, process.env.CAPFIT_VERSION);
  client.close();
  assert.equal(typeof Result, "function");
});

test("the contract is there for stubs of other makes", () => {
  assert.ok(require.resolve("capfit/proto/capfit/v1/service.proto"));
});

test("a call without a mesh says what is missing", async () => {
  const client = new CapfitClient(process.env.CAPFIT_ADDRESS);
  for (const mesh of [undefined, null, "body.glb", {}]) {
    await assert.rejects(client.approximate(mesh), (error) =>
      error instanceof CapfitError && error.field === "mesh");
  }
  client.close();
});
