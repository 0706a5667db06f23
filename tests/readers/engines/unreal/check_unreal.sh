#!/usr/bin/env bash
# Runs unreal_physics_asset.py with a stand-in for the editor's module `unreal`, which records what the
# script makes, and compares that with the result.
#
#   check_unreal.sh SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for folder in "$1"/*/; do python3 "$here/run_script.py" "${folder%/}"; done
