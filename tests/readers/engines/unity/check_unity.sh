#!/usr/bin/env bash
# Compiles CapfitColliders.cs against stand-ins for Unity's classes, with and without Magica Cloth 2 and
# the editor, runs it on a hierarchy of bones, and compares what it makes with the result.
#
#   check_unity.sh SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
samples=$1
for program in mcs mono; do
  command -v "$program" >/dev/null || {
    echo "SKIPPED: no $program: apt-get install mono-mcs" >&2
    exit 77
  }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
first=("$samples"/*/)
script=${first[0]}CapfitColliders.cs
build() {
  local program=$1 target=$2
  shift 2
  mcs -warnaserror -warn:4 "-target:$target" "-out:$scratch/$program" "$@" "$here/UnityStandIn.cs" "$script"
}
build plain.dll library
build magica.dll library -define:MAGICACLOTH2
build editor.dll library -define:UNITY_EDITOR
build check.exe exe -define:MAGICACLOTH2 -define:UNITY_EDITOR "$here/MakeColliders.cs"
for folder in "$samples"/*/; do
  # Only what it says of its origin differs.
  diff <(grep -v '^//' "$script") <(grep -v '^//' "$folder/CapfitColliders.cs") >/dev/null ||
    { echo "another script in $folder" >&2; exit 1; }
  python3 "$here/compare_unity.py" bones "${folder%/}" >"$scratch/bones.json"
  mono "$scratch/check.exe" "$folder/unity_colliders.json" "$scratch/bones.json" >"$scratch/made.txt"
  python3 "$here/compare_unity.py" compare "${folder%/}" "$scratch/made.txt"
done
