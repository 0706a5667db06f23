#!/usr/bin/env bash
# Installs what the tests need, builds everything and runs all tests.
#
#   tests/run.sh [ARGUMENTS FOR CTEST]     e.g.  tests/run.sh -R circle_test
#
# Real bodies are used where CAPFIT_BODIES names their folder (default: ../shared/bodies beside the
# project); without them the tests that need them say so and are skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install_packages.sh build test
cmake --preset release >/dev/null
cmake --build --preset release
# The stand-in for grpcurl; its test says SKIPPED where the registry cannot be reached.
[ -x node_modules/.bin/buf ] || npm install --silent --no-audit --no-fund --no-package-lock ||
  echo "NOTE: npm could not install buf; the test that calls it will be SKIPPED"
# The programs that read the exports.
for readers in tests/readers/*/package.json; do
  folder=$(dirname "$readers")
  [ -d "$folder/node_modules" ] || (cd "$folder" &&
    npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts) ||
    echo "NOTE: npm could not install $folder; its tests will be SKIPPED"
done
bodies=${CAPFIT_BODIES:-../shared/bodies}
if [ ! -e "$bodies/female_average_rest.obj" ]; then
  echo "NOTE: no real bodies in $bodies: tests that need them will be SKIPPED (set CAPFIT_BODIES)"
fi
exec ctest --preset release -j"$(nproc)" --output-on-failure "$@"
