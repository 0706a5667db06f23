#!/usr/bin/env bash
# The same as approximate.sh in one message each way, for bodies below the server's
# max_message_bytes (16 MiB unless set otherwise): the answer is one JSON object.
#
#   approximate_unary.sh HOST:PORT BODY
#
# With grpcurl: ... | grpcurl -plaintext -max-msg-sz 16777216 -d @ HOST:PORT \
#   capfit.v1.BodyApproximationService/ApproximateBodyUnary
set -euo pipefail
server=$1 body=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
buf=${BUF:-$(PATH=$PATH:$here/../../../node_modules/.bin:$PWD/node_modules/.bin type -P buf)} ||
  { echo "no buf: npm install @bufbuild/buf" >&2; exit 1; }
{
  printf '{"options": {"budget": {"max_primitives": 64}}, "mesh": {"file": {"data": "'
  base64 -w 0 "$body"
  echo '"}}}'
} | "$buf" curl --protocol grpc --http2-prior-knowledge -d @- \
  "http://$server/capfit.v1.BodyApproximationService/ApproximateBodyUnary"
