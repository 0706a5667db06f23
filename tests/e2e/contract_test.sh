#!/usr/bin/env bash
# The contract as the checks see it: clean as it is, and refused when a field goes or changes its
# number. Exit code 77 (skipped): buf is not installed.
set -euo pipefail
project=$1
cd "$project"
[ -x node_modules/.bin/buf ] || { echo "SKIPPED: buf is not installed (npm install)"; exit 77; }
.ci/buf

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r buf.yaml proto "$folder"
release=$(printf '%s\n' "$PWD"/tests/data/contract/capfit-*.binpb | sort -V | tail -n 1)
buf=$PWD/node_modules/.bin/buf
broken() { # what, sed expression
  cp proto/capfit/v1/*.proto "$folder/proto/capfit/v1/"
  sed -i -E "$2" "$folder/proto/capfit/v1/options.proto"
  if (cd "$folder" && "$buf" breaking --against "$release") >/dev/null 2>&1; then
    echo "$1 was not noticed" >&2
    exit 1
  fi
}
broken "a field that is gone" '/string engine = 13;/d'
broken "another number" 's/uint64 seed = 8;/uint64 seed = 80;/'
broken "another type" 's/double tolerance_m = 10;/float tolerance_m = 10;/'
