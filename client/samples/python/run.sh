#!/usr/bin/env bash
# Generates the Python modules (packages protobuf-compiler, protobuf-compiler-grpc, python3-grpcio,
# python3-protobuf) and runs the sample.
#
#   client/samples/python/run.sh HOST:PORT BODY
set -euo pipefail
samples=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
proto=$samples/../../../proto
generated=$(mktemp -d)
trap 'rm -rf "$generated"' EXIT
protoc -I "$proto" --python_out="$generated" --grpc_python_out="$generated" \
  --plugin=protoc-gen-grpc_python="$(command -v grpc_python_plugin)" "$proto"/capfit/v1/*.proto
# Debian's own Python: the one that its python3-grpcio belongs to.
PYTHONPATH=$generated /usr/bin/python3 "$samples/approximate.py" "$@"
