#!/usr/bin/env bash
# The examples of nginx and haproxy in front of two real replicas: streams and unary calls pass, also
# when a replica stops in between. The settings of deploy/kubernetes are read by the server.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
server=$1 capfit=$2
skip() { echo "SKIPPED: $*" >&2; exit 77; }
"$server" --config deploy/kubernetes/capfit.toml --check-config
command -v nginx >/dev/null && command -v haproxy >/dev/null || skip "no nginx or haproxy: deploy/install_packages.sh deploy"
scratch=$(mktemp -d)
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait
  rm -rf "$scratch"
}
trap cleanup EXIT

for name in one two; do
  "$server" --listen 127.0.0.1:0 --port-file "$scratch/$name" 2>"$scratch/$name.log" &
  pids+=($!)
done
for name in one two; do
  for _ in $(seq 300); do [ -s "$scratch/$name" ] && break; sleep 0.1; done
  [ -s "$scratch/$name" ] || { echo "no replica $name" >&2; exit 1; }
done
front() { /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# check FILE COMMAND...: @ in the command stands for the settings.
check() {
  local file=$1 port settings
  shift
  port=$(front)
  settings=$scratch/$(basename "$file")
  sed "s/127.0.0.1:50051/127.0.0.1:$(cat "$scratch/one")/; s/127.0.0.1:50052/127.0.0.1:$(cat "$scratch/two")/
       s/127.0.0.1:50050/127.0.0.1:$port/" "$file" >"$settings"
  "${@//@/$settings}" >"$scratch/proxy.log" 2>&1 &
  pids+=($!)
  for _ in $(seq 100); do "$capfit" info --probe --server "127.0.0.1:$port" 2>/dev/null && break; sleep 0.1; done
  for kind in "" --stream; do
    "$capfit" load --server "127.0.0.1:$port" --faces 2000,20000 --parts torso --clients 2 \
      --duration 3 --attempts 4 --strict $kind
  done
}
check deploy/proxies/nginx.conf nginx -c @ -p "$scratch" -e "$scratch/nginx_errors" -g "daemon off; pid $scratch/nginx.pid;"
check deploy/proxies/haproxy.cfg haproxy -f @
