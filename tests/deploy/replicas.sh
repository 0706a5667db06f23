# For tests to source: a scratch folder and replicas of $server, which all end with the test.
scratch=$(mktemp -d)
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done  # some have ended by themselves
  wait
  rm -rf "$scratch"
}
trap cleanup EXIT

free_port() { /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# start_replica NAME FLAGS...: does not wait for it.
start_replica() {
  local name=$1
  shift
  "$server" --listen 127.0.0.1:0 --port-file "$scratch/$name" "$@" 2>"$scratch/$name.log" &
  pids+=($!)
}

# address_of NAME: as soon as it listens.
address_of() {
  for _ in $(seq 300); do [ -s "$scratch/$1" ] && break; sleep 0.1; done
  [ -s "$scratch/$1" ] || { echo "no replica $1" >&2; cat "$scratch/$1.log" >&2; exit 1; }
  echo "127.0.0.1:$(cat "$scratch/$1")"
}
