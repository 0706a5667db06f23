#!/usr/bin/env bash
# The image: built, small, without rights, and what it does when it is asked, loaded and stopped.
#   CAPFIT_TEST_CONTAINERS=1 tests/deploy/container_test.sh BUILD_FOLDER
# CAPFIT_CONTAINER_BUILD are further arguments of deploy/build_image.sh, CAPFIT_CONTAINER_RUN of the
# engine's run; each pair of containers has a network of its own.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
[ "${CAPFIT_TEST_CONTAINERS:-}" = 1 ] || { echo "SKIPPED: set CAPFIT_TEST_CONTAINERS=1" >&2; exit 77; }
engine=${CONTAINER_ENGINE:-$(command -v podman || command -v docker)}
fail() { echo "FAILED: $*" >&2; exit 1; }
read -ra build_more <<<"${CAPFIT_CONTAINER_BUILD:-}"
read -ra run_more <<<"${CAPFIT_CONTAINER_RUN:-}"

deploy/build_image.sh --tag capfit-test --programs "$build" ${build_more[@]+"${build_more[@]}"}
bytes=$("$engine" image inspect --format '{{.Size}}' capfit-test)
[ "$bytes" -le 200000000 ] || fail "the image has $bytes bytes"
[ "$("$engine" image inspect --format '{{.Config.User}}' capfit-test)" = 65534:65534 ] || fail "it runs as root"

cleanup() { "$engine" rm -f capfit-test-server >/dev/null 2>&1 || true; }  # or there is none
trap cleanup EXIT
cleanup
limits=(--read-only --cap-drop ALL --security-opt no-new-privileges ${run_more[@]+"${run_more[@]}"})
"$engine" run -d --name capfit-test-server "${limits[@]}" --memory 1g capfit-test >/dev/null
inside() { "$engine" exec capfit-test-server "$@"; }
for _ in $(seq 100); do inside capfit info --probe 2>/dev/null && break; sleep 0.1; done
inside capfit info --probe || fail "it does not serve"
inside id -u | grep -qx 65534 || fail "it runs as $(inside id -u)"
if inside touch /file 2>/dev/null; then fail "its root can be written"; fi
inside grep CapEff /proc/1/status | grep -q 0000000000000000 || fail "it has capabilities"

# Container against container, in the server's network.
"$engine" run --rm "${limits[@]}" --network container:capfit-test-server --entrypoint capfit capfit-test \
  load --clients 4 --duration 10 --faces 4000,20000 --strict

"$engine" kill --signal TERM capfit-test-server >/dev/null
[ "$("$engine" wait capfit-test-server)" = 0 ] || fail "SIGTERM does not end it with 0"
echo "the image has $((bytes / 1000000)) MB"
