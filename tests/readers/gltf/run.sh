#!/usr/bin/env bash
# Exports of avatars and bodies (see which_samples.sh), read by the Khronos glTF validator, three.js,
# three-vrm and TinyUSDZ.
#
#   run.sh EXPORT_SAMPLES
#
# The packages are those of package.json: in node_modules beside it (tests/run.sh installs them), or
# installed into a scratch folder. Exit code 77: no npm, no packages, or no bodies, said loudly.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../which_samples.sh"
root=$(cd "$here/../../.." && pwd)
export_samples=$(realpath "$1")
avatars=$(realpath -m "${CAPFIT_AVATARS:-$root/../shared/avatars}")
bodies=$(realpath -m "${CAPFIT_BODIES:-$root/../shared/bodies}")

skip() { echo "SKIPPED: $*" >&2; exit 77; }
command -v node >/dev/null || skip "no Node.js: deploy/install_packages.sh test"
[ -e "$avatars/truth.json" ] || skip "no avatars in $avatars; set CAPFIT_AVATARS"
[ -e "$bodies/female_average_rest.obj" ] || skip "no bodies in $bodies; set CAPFIT_BODIES"

scratch=$(mktemp -d)
mkdir "$scratch/in"
trap 'rm -rf "$scratch"' EXIT
checks=$here
if [ ! -d "$here/node_modules/gltf-validator" ]; then
  command -v npm >/dev/null || skip "no npm: deploy/install_packages.sh test"
  checks=$scratch/checks
  mkdir "$checks"
  cp "$here"/*.mjs "$here/package.json" "$checks/"
  (cd "$checks" && npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts) \
    >/dev/null 2>&1 || skip "npm cannot install the readers: cd $here && npm install"
fi

failed=0
run() { (cd "$checks" && node "$@") || { failed=1; echo "FAILED: $*" >&2; }; }
# BODY FORMAT: its exports, in $out.
samples() {
  name=$(basename "${1%.*}")
  out=$scratch/$name.$2
  "$export_samples" "$1" "$2" "$out"
}

run collider_schema_test.mjs
mapfile -t files < <(which_samples "$avatars" glb)
for body in "${files[@]}"; do
  samples "$body" all
  kind=$(node -p 'require(process.argv[1]).joints.length > 0 ? "rigged" : "still"' \
    "$out/expected.json")
  run check_gltf.mjs "$out/${name}_colliders.glb" "$out/expected.json" "$body" "$kind"
  run check_gltf.mjs "$out/preview.glb" "$out/expected.json" "$body" "$kind"
  run check_usd.mjs "$out/${name}_colliders.usda" "$out/expected.json" tapered
  run check_usd.mjs "$out/uniform.usda" "$out/expected.json" uniform
  run check_meshes.mjs "$out/${name}_hulls" "$out/expected.json" hulls
  run check_meshes.mjs "$out/${name}_union" "$out/expected.json" union
done
mapfile -t files < <(which_samples "$bodies" obj)
for body in "${files[@]}"; do
  samples "$body" all
  run check_gltf.mjs "$out/${name}_colliders.glb" "$out/expected.json" - upright
  run check_usd.mjs "$out/${name}_colliders.usda" "$out/expected.json" tapered
  run check_gltf.mjs "$out/preview.glb" "$out/expected.json" - upright
  run check_meshes.mjs "$out/${name}_hulls" "$out/expected.json" hulls
  run check_meshes.mjs "$out/${name}_union" "$out/expected.json" union
done
# Text with its buffer inside comes back as a GLB.
run make_text.mjs "$avatars/armour_man.glb" "$scratch/in/text.gltf"
samples "$scratch/in/text.gltf" gltf_preview
run check_gltf.mjs "$out/preview.glb" "$out/expected.json" "$avatars/armour_man.glb" rigged
# The avatars that have the names of VRM's sample rig.
for body in skirt_woman dressed_deleted_quantised; do
  for version in 0 1; do
    vrm=$scratch/in/${body}_$version.vrm
    run make_vrm.mjs "$avatars/$body.glb" "$version" "$vrm"
    samples "$vrm" vrm
    run check_vrm.mjs "$out/${name}_colliders.vrm" "$out/expected.json" "$vrm"
  done
done
exit "$failed"
