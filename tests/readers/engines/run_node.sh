#!/usr/bin/env bash
# Runs a check of this folder on every sample.
#
#   run_node.sh CHECK.mjs SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
check=$1 samples=$2
skip() { echo "SKIPPED: $*" >&2; exit 77; }
command -v node >/dev/null || skip "no node: apt-get install npm"
[ -d "$here/node_modules/jolt-physics" ] ||
  skip "no packages: run 'npm install --no-package-lock' in tests/readers/engines, or tests/run.sh"
if [ "$check" = check_skirt.mjs ]; then
  # Half a minute each: two of them.
  found=0
  for name in female_average_rest dressed_full_woman; do
    [ -d "$samples/$name" ] || continue
    found=1
    node "$here/$check" "$samples/$name"
  done
  [ "$found" -eq 1 ] || skip "no body to hang a skirt on; set CAPFIT_BODIES"
  exit 0
fi
"$here/for_each_sample.sh" "$samples" node "$here/$check"
