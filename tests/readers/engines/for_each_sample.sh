#!/usr/bin/env bash
# Calls a program with the folder of each sample as its last argument; fails where one call fails.
#
#   for_each_sample.sh SAMPLES PROGRAM [ARGUMENTS]
set -euo pipefail
samples=$1
shift
failed=0
for folder in "$samples"/*/; do
  folder=${folder%/}
  echo "$(basename "$folder"): "
  "$@" "$folder" || failed=1
done
exit "$failed"
