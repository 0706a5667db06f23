#!/usr/bin/env bash
# Compiles nvcloth_colliders.h as C and as C++ with all warnings as errors, and compares what programs
# see in it with the result.
#
#   check_nvcloth.sh SAMPLES
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
samples=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp "$here/print_colliders.c" "$scratch/print.c"
cp "$here/print_colliders.c" "$scratch/print.cc"
warnings=(-Wall -Wextra -Wpedantic -Werror -Wcomment)
for folder in "$samples"/*/; do
  ${CC:-cc} -std=c99 "${warnings[@]}" -I"$folder" "$scratch/print.c" -o "$scratch/c"
  ${CXX:-c++} -std=c++11 "${warnings[@]}" -I"$folder" "$scratch/print.cc" -o "$scratch/cc"
  "$scratch/c" >"$scratch/c.txt"
  "$scratch/cc" | cmp - "$scratch/c.txt"
  python3 "$here/compare_colliders.py" "${folder%/}" "$scratch/c.txt"
done
