#!/usr/bin/env bash
# Fits all bodies and avatars there are, and writes what engines get: OUT/NAME/... for each. OUT/edge is
# a made-up set that needs no body.
#
#   make_samples.sh EXPORT_SAMPLES OUT
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
samples=$1 out=$2
bodies=${CAPFIT_BODIES:-$root/../shared/bodies}
avatars=${CAPFIT_AVATARS:-$root/../shared/avatars}
formats=unity,unreal,nvcloth,jolt,bullet,rapier,mujoco,mujoco_meshes,urdf,csv

rm -rf "$out"
"$samples" - "$formats" "$out/edge"
shopt -s nullglob
files=("$bodies"/*.obj "$avatars"/*.glb)
[ "${#files[@]}" -gt 0 ] || echo "SKIPPED: no bodies in $bodies and no avatars in $avatars" >&2
for file in "${files[@]}"; do
  name=$(basename "$file")
  "$samples" "$file" "$formats" "$out/${name%.*}"
done
echo "$((${#files[@]} + 1)) samples"
