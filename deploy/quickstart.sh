#!/usr/bin/env bash
# From a fresh Debian 12 to a fitted body: installs the packages, builds, starts the server on a free
# loopback port, makes a sample mannequin, has it fitted over the network, draws the result, stops
# the server. A second run takes seconds.
#
#   deploy/quickstart.sh [OUTPUT_FOLDER]        default: out/quickstart
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${1:-out/quickstart}
say() { printf '\n\033[1m%s\033[0m\n' "$*"; }

say "1/5  packages"
deploy/install_packages.sh build

say "2/5  build (the first time takes some minutes)"
cmake --preset release >/dev/null
cmake --build --preset release --target capfit_server capfit_client_main
server=build/release/server/capfit-server
capfit=build/release/client/capfit

say "3/5  server"
mkdir -p "$out"
rm -f "$out/port"
"$server" --listen 127.0.0.1:0 --port-file "$out/port" >"$out/server.log" 2>&1 &
server_pid=$!
stop_server() { kill -TERM "$server_pid" 2>/dev/null || true; }
trap stop_server EXIT
for _ in $(seq 100); do
  [ -s "$out/port" ] && break
  kill -0 "$server_pid" 2>/dev/null || { cat "$out/server.log" >&2; exit 1; }
  sleep 0.1
done
port=$(cat "$out/port")
echo "capfit-server listens on 127.0.0.1:$port (log: $out/server.log)"

say "4/5  a sample mannequin, fitted over the network"
"$capfit" mannequin -o "$out/mannequin.obj"
"$capfit" approximate "$out/mannequin.obj" -o "$out/result.json" \
  --server "127.0.0.1:$port" --parts all --max-primitives 64 --progress

say "5/5  picture"
"$capfit" render "$out/mannequin.obj" "$out/result.json" -o "$out/result.png"

kill -TERM "$server_pid"
wait "$server_pid"
trap - EXIT
say "done"
echo "result:  $out/result.json"
echo "picture: $out/result.png"
