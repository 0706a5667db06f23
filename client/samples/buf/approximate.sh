#!/usr/bin/env bash
# Fits a body on a capfit server with `buf curl` (or grpcurl): JSON in, JSON out, by reflection.
#
#   client/samples/buf/approximate.sh HOST:PORT BODY
#
# With grpcurl the same messages go in by
#   ... | grpcurl -plaintext -d @ HOST:PORT capfit.v1.BodyApproximationService/ApproximateBody
set -euo pipefail
server=$1 body=$2
buf=${BUF:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)/node_modules/.bin/buf}
{
  echo '{"header": {"mesh": {"file": {}}, "options": {"budget": {"max_primitives": 64}}}}'
  # A file goes in as base64, in pieces of 240 KiB (a multiple of 3 bytes needs no padding).
  base64 -w 327680 "$body" | sed 's/.*/{"chunk": {"file_bytes": "&"}}/'
} | "$buf" curl --protocol grpc --http2-prior-knowledge -d @- \
  "http://$server/capfit.v1.BodyApproximationService/ApproximateBody"
