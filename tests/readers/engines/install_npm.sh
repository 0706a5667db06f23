#!/usr/bin/env bash
# Installs the packages of package.json into BUILD/node_modules, once for each package.json.
#
#   install_npm.sh BUILD
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
skip() { echo "SKIPPED: $*" >&2; exit 77; }
command -v npm >/dev/null || skip "no npm: apt-get install npm"
[ -d "$build/node_modules" ] && cmp -s "$here/package.json" "$build/package.json" && exit 0
mkdir -p "$build"
rm -rf "$build/node_modules"
cp "$here/package.json" "$build/package.json.new"
mkdir -p "$build/npm" && mv "$build/package.json.new" "$build/npm/package.json"
(cd "$build/npm" &&
  npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts) ||
  skip "npm could not install $here/package.json"
mv "$build/npm/node_modules" "$build/node_modules"
mv "$build/npm/package.json" "$build/package.json"
