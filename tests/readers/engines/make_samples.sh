#!/usr/bin/env bash
# Fits bodies and avatars (see which_samples.sh) and writes what engines get: OUT/NAME/... for each.
# OUT/edge is a made-up set that needs no body.
#
#   make_samples.sh EXPORT_SAMPLES OUT
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../which_samples.sh"
root=$(cd "$here/../../.." && pwd)
samples=$1 out=$2
bodies=${CAPFIT_BODIES:-$root/../shared/bodies}
avatars=${CAPFIT_AVATARS:-$root/../shared/avatars}
formats=unity,unreal,nvcloth,jolt,bullet,rapier,mujoco,mujoco_meshes,urdf,csv

rm -rf "$out"
"$samples" - "$formats" "$out/edge"
mapfile -t files < <(which_samples "$bodies" obj; which_samples "$avatars" glb)
[ "${#files[@]}" -gt 0 ] || echo "SKIPPED: no bodies in $bodies and no avatars in $avatars" >&2
for file in "${files[@]}"; do
  name=$(basename "$file")
  "$samples" "$file" "$formats" "$out/${name%.*}"
done
echo "$((${#files[@]} + 1)) samples"
