#!/usr/bin/env bash
# Runs one of the samples against a real server with a mannequin, and compares what it prints with
# the command line's own result.
#
#   sample_test.sh python|cpp|buf|buf_unary SERVER CAPFIT CPP_SAMPLE PYTHON_SITE
#
# PYTHON_SITE: where tests/client/python/install_package.sh has put the package.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
sample=$1 server=$2 capfit=$3 cpp_sample=$4 python_site=$5
buf=$(PATH=$PATH:$root/node_modules/.bin type -P buf || true)  # without one: SKIPPED below

skip() { echo "SKIPPED: $*" >&2; exit 77; }
case "$sample" in
  python) PYTHONPATH=$python_site /usr/bin/python3 -c 'import capfit' 2>/dev/null ||
            skip "no package in $python_site, see the test python_client.install" ;;
  buf*) [ -n "$buf" ] || skip "no buf: run .ci/buf once, it installs it" ;;
esac

scratch=$(mktemp -d)
server_pid=
cleanup() {
  [ -z "$server_pid" ] || { kill -KILL "$server_pid" 2>/dev/null || true; }  # or it has ended
  rm -rf "$scratch"
}
trap cleanup EXIT
"$server" --listen 127.0.0.1:0 --port-file "$scratch/port" 2>"$scratch/log" &
server_pid=$!
for _ in $(seq 300); do
  [ -s "$scratch/port" ] && break
  kill -0 "$server_pid" 2>/dev/null || { cat "$scratch/log" >&2; exit 1; }
  sleep 0.1
done
address=127.0.0.1:$(cat "$scratch/port")
body=$scratch/body.obj
"$capfit" mannequin -o "$body" --faces 6000

# How many spheres and capsules the command line gets with the sample's options.
expect() {
  "$capfit" approximate "$body" -o "$scratch/result.json" --server "$address" --quiet "$@"
  /usr/bin/python3 -c 'import json,sys; r=json.load(open(sys.argv[1])); print(len(r["spheres"]), len(r["capsules"]))' \
    "$scratch/result.json"
}
# How many spheres and capsules the last message of JSON answers has; it must have the summary too.
count_json() {
  /usr/bin/python3 - "$scratch/out" <<'PY'
import json, sys
text, decoder, place, primitives = open(sys.argv[1]).read(), json.JSONDecoder(), 0, None
while place < len(text.rstrip()):
    message, place = decoder.raw_decode(text, place)
    while place < len(text) and text[place].isspace():
        place += 1
    primitives = message.get("primitives", primitives)
assert "metrics" in message["summary"], "the last message is the summary"
print(len(primitives["spheres"]), len(primitives["capsules"]))
PY
}
# Samples are copied away from the repository: they need nothing beside them.
outside() {
  mkdir "$scratch/outside"
  cp "$root/client/samples/$1" "$scratch/outside/"
  cd "$scratch/outside"
}
count() { echo "$(grep -c '^sphere ' "$scratch/out") $(grep -c '^capsule ' "$scratch/out")"; }

case "$sample" in
  python)
    outside python/approximate.py
    PYTHONPATH=$python_site /usr/bin/python3 approximate.py "$address" "$body" >"$scratch/out"
    wanted=$(expect) got=$(count) ;;
  cpp)
    "$cpp_sample" "$address" "$body" >"$scratch/out"
    wanted=$(expect --max-spheres 32 --max-capsules 32) got=$(count) ;;
  buf)
    outside buf/approximate.sh
    PATH=$(dirname "$buf"):$PATH ./approximate.sh "$address" "$body" >"$scratch/out"
    wanted=$(expect) got=$(count_json)
    # Reflection shows all services, health too.
    methods=$("$buf" curl --protocol grpc --http2-prior-knowledge \
      --list-methods "http://$address")
    for method in capfit.v1.BodyApproximationService/ApproximateBody \
                  capfit.v1.BodyApproximationService/GetServerInfo grpc.health.v1.Health/Check; do
      grep -qF "$method" <<<"$methods" || { echo "reflection does not list $method" >&2; exit 1; }
    done
    # buf's exit code is 8 times the gRPC code: 3 is INVALID_ARGUMENT.
    code=0
    echo '{"chunk": {"file_bytes": "AAAA"}}' | "$buf" curl --protocol grpc \
      --http2-prior-knowledge -d @- \
      "http://$address/capfit.v1.BodyApproximationService/ApproximateBody" 2>"$scratch/error" || code=$?
    [ "$code" -eq 24 ] || { echo "a chunk before the header gave exit code $code" >&2; exit 1; }
    grep -q 'chunk came before the header' "$scratch/error" ;;
  buf_unary)
    # In the repository, where the buf that npm installed is found.
    "$root/client/samples/buf/approximate_unary.sh" "$address" "$body" >"$scratch/out"
    wanted=$(expect) got=$(count_json) ;;
esac
[ "$got" = "$wanted" ] || { echo "$sample: got '$got' spheres and capsules, wanted '$wanted'" >&2; exit 1; }
[ "${wanted% *}" -gt 9 ] || { echo "only '$wanted' spheres and capsules" >&2; exit 1; }

kill -TERM "$server_pid"
wait "$server_pid"
server_pid=
echo "$sample: $got spheres and capsules"
