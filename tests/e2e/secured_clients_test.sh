#!/usr/bin/env bash
# A server with TLS, clients' certificates and tokens, as docs/security.md sets it up, and full calls
# by the command line, Python, Node.js and buf curl; without any of the three nobody gets through.
#
#   secured_clients_test.sh capfit|python|node|buf SERVER CAPFIT PYTHON_SITE
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
client=$1 server=$2 capfit=$3 python_site=$4
buf=$(PATH=$PATH:$root/node_modules/.bin type -P buf || true)  # without one: SKIPPED below
skip() { echo "SKIPPED: $*" >&2; exit 77; }
fail() { echo "FAILED: $*" >&2; exit 1; }
command -v openssl >/dev/null || skip "no openssl: apt-get install openssl"
case "$client" in
  python) PYTHONPATH=$python_site /usr/bin/python3 -c 'import capfit' 2>/dev/null ||
            skip "no package in $python_site, see the test python_client.install" ;;
  node) command -v npm >/dev/null || skip "no npm: apt-get install npm" ;;
  buf) [ -n "$buf" ] || skip "no buf: run .ci/buf once, it installs it" ;;
esac

scratch=$(mktemp -d)
server_pid=
cleanup() {
  [ -z "$server_pid" ] || { kill -KILL "$server_pid" 2>/dev/null || true; }  # or it has ended
  rm -rf "$scratch"
}
trap cleanup EXIT
cd "$scratch"

# sign NAME: NAME.pem and NAME.key, by the authority.
sign() {
  openssl req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -keyout "$1.key" -out "$1.csr" -subj "/CN=$1" 2>/dev/null
  openssl x509 -req -in "$1.csr" -CA ca.pem -CAkey ca.key -CAcreateserial -days 1 -out "$1.pem" \
    -extfile <(echo "subjectAltName=DNS:localhost,IP:127.0.0.1") 2>/dev/null
}
openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -keyout ca.key -out ca.pem -days 1 -subj "/CN=authority" 2>/dev/null
sign server
sign client
openssl rand -hex 32 >token
echo "tests $(tr -d '\n' <token | sha256sum | cut -d ' ' -f 1)" >tokens

"$server" --listen 127.0.0.1:0 --port-file port --tls-certificate server.pem --tls-key server.key \
  --tls-client-ca ca.pem --token-file tokens 2>log &
server_pid=$!
for _ in $(seq 300); do
  [ -s port ] && break
  kill -0 "$server_pid" 2>/dev/null || { cat log >&2; exit 1; }
  sleep 0.1
done
address=127.0.0.1:$(cat port)
"$capfit" mannequin -o body.obj --faces 4000

with_capfit() {
  local tls=(--server "$address" --tls-ca ca.pem --tls-certificate client.pem --tls-key client.key)
  "$capfit" approximate body.obj -o result.json --quiet "${tls[@]}" --token-file token
  "$capfit" info --probe "${tls[@]}" || fail "the probe needs a token"
  ! "$capfit" info "${tls[@]}" 2>err || fail "no token, and served"
  grep -q "UNAUTHENTICATED: this server asks for a token" err || fail "$(cat err)"
  ! "$capfit" info --server "$address" --tls-ca ca.pem --token-file token --timeout 3 2>err || fail "no certificate, and served"
  ! "$capfit" info --server "$address" --token-file token --timeout 3 2>err || fail "no TLS, and served"
}
with_python() {
  PYTHONPATH=$python_site /usr/bin/python3 - "$address" <<'PYTHON'
import pathlib, sys
import capfit
read = lambda name: pathlib.Path(name).read_bytes()
tls = dict(root_certificates=read("ca.pem"), certificate=read("client.pem"), key=read("client.key"))
with capfit.Client(sys.argv[1], **tls, token=read("token").decode().strip()) as client:
    assert len(client.approximate("body.obj").spheres) > 10
    assert client.server_info().version
port = sys.argv[1].split(":")[1]
with capfit.Client(f"localhost:{port},127.0.0.1:{port}", **tls, token=read("token").decode().strip()) as client:
    assert client.server_info().version
for wrong, code in ((dict(tls), "UNAUTHENTICATED"), (dict(tls, token="guess"), "UNAUTHENTICATED"),
                    (dict(root_certificates=tls["root_certificates"], token="guess"), "UNAVAILABLE"),
                    (dict(token="guess"), "UNAVAILABLE")):
    with capfit.Client(sys.argv[1], **wrong) as client:
        try:
            client.server_info(timeout=3)
        except capfit.CapfitError as error:
            assert error.code == code, error
        else:
            raise AssertionError(f"served with {sorted(wrong)}")
PYTHON
}
with_node() {
  mkdir -p tree/client/typescript tree/proto consumer
  cp "$root/LICENSE" tree/
  cp -R "$root/proto/capfit" "$root/proto/google" tree/proto/
  cp -R "$root/client/typescript/"{package.json,tsconfig.json,README.md,scripts,src} tree/client/typescript/
  rm -rf tree/client/typescript/src/generated
  local install=(npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts)
  (cd tree/client/typescript && "${install[@]}" >/dev/null 2>&1) || skip "npm cannot reach its registry"
  (cd tree/client/typescript && npm pack --silent >/dev/null)
  (cd consumer && echo '{}' >package.json && "${install[@]}" ../tree/client/typescript/capfit-*.tgz)
  cat >consumer/call.cjs <<'JS'
const { readFileSync } = require("node:fs");
const { CapfitClient } = require("capfit");
const read = (name) => readFileSync(`../${name}`);
const address = process.argv[2];
const tls = { rootCertificates: read("ca.pem"), certificate: read("client.pem"), key: read("client.key") };
const token = read("token").toString().trim();
async function main() {
  for (const place of [address, `${address},${address}`]) {
    const client = new CapfitClient(place, { ...tls, token, serverName: "localhost" });
    const result = await client.approximate({ file: read("body.obj") });
    if (!(result.spheres.length > 10)) throw new Error("no spheres");
    client.close();
  }
  const cases = [[tls, "UNAUTHENTICATED"], [{ ...tls, token: "guess" }, "UNAUTHENTICATED"], [{ token }, "UNAVAILABLE"]];
  for (const [options, code] of cases) {
    const client = new CapfitClient(address, options);
    const error = await client.serverInfo({ timeoutMs: 3000 }).then(() => undefined, (problem) => problem);
    if (error?.code !== code) throw new Error(`${error?.code}, not ${code}: ${error?.message}`);
    client.close();
  }
}
main().catch((error) => { console.error(error); process.exit(1); });
JS
  (cd consumer && node call.cjs "$address")
}
with_buf() {
  local url=https://$address/capfit.v1.BodyApproximationService/ApproximateBodyUnary
  local call=("$buf" curl --protocol grpc --cacert ca.pem --cert client.pem --key client.key)
  echo "{\"mesh\": {\"file\": {\"data\": \"$(base64 -w 0 body.obj)\"}}}" >request.json
  "${call[@]}" -H "authorization: Bearer $(cat token)" --reflect-header '*' -d @request.json "$url" >answer.json
  grep -q '"spheres"' answer.json || fail "no spheres"
  local code=0
  "${call[@]}" -d @request.json "$url" >answer.json 2>err || code=$?
  [ "$code" = 128 ] || fail "exit code $code without a token: $(cat err)"  # 8 * UNAUTHENTICATED
}
"with_$client"
! grep -F "$(cat token)" log || fail "the token stands in the log"
