#!/usr/bin/env bash
# Fits a body on a capfit server with `buf curl`: JSON in, JSON out. The server describes its
# messages itself (reflection), so this file works anywhere, with nothing beside it.
#
#   approximate.sh HOST:PORT BODY
#
# `buf` on the PATH, or where BUF names it, or installed by npm in the repository or this folder.
# With grpcurl the same messages go in by
#   ... | grpcurl -plaintext -d @ HOST:PORT capfit.v1.BodyApproximationService/ApproximateBody
set -euo pipefail
server=$1 body=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
buf=${BUF:-$(PATH=$PATH:$here/../../../node_modules/.bin:$PWD/node_modules/.bin type -P buf)} ||
  { echo "no buf: npm install @bufbuild/buf" >&2; exit 1; }
{
  echo '{"header": {"mesh": {"file": {}}, "options": {"budget": {"max_primitives": 64}}}}'
  # A file goes in as base64, in pieces of 240 KiB (a multiple of 3 bytes needs no padding).
  base64 -w 327680 "$body" | sed 's/.*/{"chunk": {"file_bytes": "&"}}/'
} | "$buf" curl --protocol grpc --http2-prior-knowledge -d @- \
  "http://$server/capfit.v1.BodyApproximationService/ApproximateBody"
