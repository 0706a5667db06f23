// The package as an ECMAScript module, without types.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { test } from "node:test";

import { CapfitClient, CapfitError } from "capfit";

test("import gives the client", async () => {
  const client = new CapfitClient(process.env.CAPFIT_ADDRESS);
  const result = await client.approximate({ file: await readFile(process.env.CAPFIT_BODY) });
  client.close();
  assert.equal(result.metrics.primitiveCount <= 64, true);
});

test("import and require() share their classes", () => {
  const require = createRequire(import.meta.url);
  assert.equal(require("capfit").CapfitError, CapfitError);
});
