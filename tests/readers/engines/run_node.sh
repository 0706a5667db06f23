#!/usr/bin/env bash
# Runs a check of this folder on every sample with the packages that install_npm.sh put into BUILD.
#
#   run_node.sh CHECK.mjs BUILD SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
check=$1 build=$2 samples=$3
skip() { echo "SKIPPED: $*" >&2; exit 77; }
[ -d "$build/node_modules" ] || skip "no packages: npm install did not work, see readers.engines.npm"
# Node looks for packages beside the files of the program.
mkdir -p "$build/engines" "$build/gltf"
cp "$here"/*.mjs "$build/engines/"
cp "$here/../gltf/files.mjs" "$build/gltf/"
cp "$build/package.json" "$build/gltf/"
cp "$build/package.json" "$build/engines/"
if [ "$check" = check_skirt.mjs ]; then
  # Half a minute each: two of them.
  found=0
  for name in female_average_rest dressed_full_woman; do
    [ -d "$samples/$name" ] || continue
    found=1
    node "$build/engines/$check" "$samples/$name"
  done
  [ "$found" -eq 1 ] || skip "no body to hang a skirt on; set CAPFIT_BODIES"
  exit 0
fi
"$here/for_each_sample.sh" "$samples" node "$build/engines/$check"
