#!/usr/bin/env bash
# The manifests of Kubernetes: put together by kubectl, and held against the API's schemas.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
skip() { echo "SKIPPED: $*" >&2; exit 77; }
command -v kubectl >/dev/null || skip "no kubectl"
command -v npm >/dev/null || skip "no npm: apt-get install npm"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for part in kubernetes kubernetes/catalogue; do
  kubectl kustomize "deploy/$part" >>"$scratch/all.yaml"
  echo --- >>"$scratch/all.yaml"
done
cd "$scratch"
npm install --silent --no-audit --no-fund --ignore-scripts kubernetes-models@4.5.1 js-yaml@4.1.0 \
  >/dev/null 2>&1 || skip "npm cannot reach its registry"
cat >validate.cjs <<'JS'
const yaml = require("js-yaml");
const { readFileSync } = require("node:fs");
const check = (object) => new (require(`kubernetes-models/${object.apiVersion}`)[object.kind])(object).validate();
const objects = yaml.loadAll(readFileSync("all.yaml", "utf8")).filter((object) => object);
for (const object of objects) {
  try {
    check(object);
  } catch (error) {
    throw new Error(`${object.kind}: ${error.message}`);
  }
  console.log(object.kind, object.metadata.name);
}
// The check itself: a misspelt member must be seen.
const deployment = objects.find((object) => object.kind === "Deployment");
deployment.spec.template.spec.containers[0].port = [];
deployment.spec.replicas = "two";
let seen = false;
try { check(deployment); } catch { seen = true; }
if (!seen) throw new Error("a wrong Deployment passes");
// What a server that is trusted asks of its pod.
const pod = objects.find((object) => object.kind === "Deployment").spec.template.spec;
const inside = pod.containers[0].securityContext;
if (!inside.readOnlyRootFilesystem || inside.allowPrivilegeEscalation !== false ||
    inside.capabilities.drop[0] !== "ALL" || !pod.securityContext.runAsNonRoot) {
  throw new Error("the pod may do more than it needs");
}
const settings = objects.find((object) => object.kind === "ConfigMap").data["capfit.toml"];
const seconds = (name) => Number(new RegExp(`^${name} = (.*)$`, "m").exec(settings)[1]);
if (seconds("drain-delay-seconds") + seconds("drain-seconds") >= pod.terminationGracePeriodSeconds) {
  throw new Error("Kubernetes kills the pod before it has drained");
}
JS
node validate.cjs
