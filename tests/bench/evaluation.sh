#!/usr/bin/env bash
# The paper's evaluation (figures 9 and 10, table 1) on all bodies, as docs/evaluation.md.
#
#   tests/bench/evaluation.sh [--quick] [--budgets 22,64,...] [--kept]
#
# --quick: 3 bodies, 3 budgets, one run for the times, into build/evaluation/quick. --kept: fits
# nothing and writes the page of what an interrupted run has measured.
#
# Installs what it needs, builds the bench preset, then fits and measures one after the other with
# two threads, and goes on where it stopped: what the same programs have done for the same body is
# kept in build/evaluation. About half an hour the first time on two cores.
#
#   CAPFIT_BODIES  folder of bodies (default ../shared/bodies); without it the built-in mannequins
#   CAPFIT_JUDGE   another program that measures, called as JUDGE BODY RESULT --json; without it
#                  `capfit evaluate` does
#   CAPFIT_BUILD   folder of a finished build to use in place of build/bench
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

deploy/install_packages.sh build bench
build=${CAPFIT_BUILD:-build/bench}
if [ -z "${CAPFIT_BUILD:-}" ]; then
  cmake --preset bench >/dev/null
  cmake --build --preset bench --target client/capfit capfit_published_fit capfit_sphere_mesh
fi
# The Python that has Debian's packages: the first one on the PATH may be another.
exec /usr/bin/python3 tests/bench/evaluation.py --capfit "$build/client/capfit" \
  --published "$build/tests/bench/published_fit" \
  --sphere-mesh "$build/tests/bench/sphere_mesh/sphere_mesh" "$@"
