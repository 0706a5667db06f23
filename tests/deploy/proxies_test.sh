#!/usr/bin/env bash
# The examples of nginx and haproxy in front of two real replicas: streams and unary calls pass. The
# settings of deploy/kubernetes are read by the server.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
server=$1 capfit=$2
skip() { echo "SKIPPED: $*" >&2; exit 77; }
"$server" --config deploy/kubernetes/capfit.toml --check-config
command -v nginx >/dev/null && command -v haproxy >/dev/null || skip "no nginx or haproxy: deploy/install_packages.sh deploy"
source tests/deploy/replicas.sh
start_replica one
start_replica two
one=$(address_of one)
two=$(address_of two)

# check FILE COMMAND...: @ in the command stands for the settings.
check() {
  local file=$1 port settings
  shift
  port=$(free_port)
  settings=$scratch/$(basename "$file")
  sed "s/127.0.0.1:50051/$one/; s/127.0.0.1:50052/$two/
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
