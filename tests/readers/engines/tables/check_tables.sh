#!/usr/bin/env bash
# Reads spheres.csv and capsules.csv as scripts do, and compares them with the result.
#
#   check_tables.sh SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for folder in "$1"/*/; do python3 "$here/compare_tables.py" "${folder%/}"; done
