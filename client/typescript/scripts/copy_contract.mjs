// Copies what the package needs from the rest of the project: the contract, the messages of the
// error details, and the licence. What was made before goes first, so that nothing old is packed.
import { cpSync, mkdirSync, rmSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const packageFolder = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const project = path.resolve(packageFolder, "../..");

for (const made of ["dist", "proto", "src/generated"]) {
  rmSync(path.join(packageFolder, made), { recursive: true, force: true });
}
for (const folder of ["capfit/v1", "google/rpc"]) {
  const target = path.join(packageFolder, "proto", folder);
  mkdirSync(target, { recursive: true });
  cpSync(path.join(project, "proto", folder), target, {
    recursive: true,
    filter: (source) => !source.endsWith(".md"),
  });
}
cpSync(path.join(project, "LICENSE"), path.join(packageFolder, "LICENSE"));
