#!/usr/bin/env bash
# Builds the Python package with Debian's own tools and no network, and installs it into a folder.
#
#   install_package.sh TARGET    exit code 77: a package is missing, said loudly
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
target=$(realpath -m "$1")
python=/usr/bin/python3
export PATH=/usr/bin:$PATH
export PIP_ROOT_USER_ACTION=ignore PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1

skip() { echo "SKIPPED: $*; deploy/install_packages.sh test" >&2; exit 77; }
"$python" -W ignore -c "import google.protobuf, grpc, jsonschema, numpy, setuptools, pip, wheel" ||
  skip "Debian's /usr/bin/python3 lacks a package"
command -v grpc_python_plugin protoc >/dev/null || skip "no protoc or grpc_python_plugin"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wheel() {
  "$python" -m pip wheel --quiet --no-index --no-deps --no-build-isolation -w "$1" "$2"
}
# From a copy, as a build leaves files beside its sources, and from a source distribution, which
# must carry all that it needs.
mkdir -p "$scratch/repository/client"
cp -r "$root/proto" "$root/LICENSE" "$scratch/repository"
cp -r "$root/client/python" "$scratch/repository/client"
cd "$scratch/repository/client/python"
wheel "$scratch/from_tree" .
"$python" -c 'import sys; from setuptools import build_meta; build_meta.build_sdist(sys.argv[1])' \
  "$scratch" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
cd "$scratch"
rm -rf repository
wheel from_sdist capfit-*.tar.gz
files() {
  "$python" -m zipfile --list "$1" | awk 'NR > 1 && $1 !~ /RECORD|METADATA/ {print $1, $NF}' | sort
}
diff <(files from_tree/*.whl) <(files from_sdist/*.whl)

rm -rf "$target"
"$python" -m pip install --quiet --no-index --no-deps --target "$target" from_tree/*.whl
echo "installed $(basename from_tree/*.whl)"
