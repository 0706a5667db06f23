#!/usr/bin/env bash
# Packs the TypeScript client, installs the tarball into a project that knows nothing of the source
# tree, type-checks that project, and runs its tests against a real server.
#
#   package_test.sh SERVER CAPFIT VERSION
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
server=$1 capfit=$2 version=$3
source_package=$root/client/typescript

skip() { echo "SKIPPED: $*" >&2; exit 77; }
fail() { echo "$*" >&2; exit 1; }
# Each block of TypeScript of a page as a module: PREFIX1.mts, PREFIX2.mts, ...
examples_of() {
  awk -v prefix="$2" '/^```ts$/ { file = prefix (++count) ".mts"; next } /^```$/ { file = "" }
    file { print > file } END { exit count == 0 }' "$1" || fail "$1 has no example"
}
command -v npm >/dev/null || skip "no npm: apt-get install npm"
compiler=$(node -p 'require(process.argv[1]).devDependencies.typescript' "$source_package/package.json")
node_types=$(node -p 'require(process.argv[1]).devDependencies["@types/node"]' \
  "$source_package/package.json")
npm view "typescript@$compiler" version >/dev/null 2>&1 || skip "npm cannot reach its registry"
install=(npm install --silent --no-audit --no-fund --no-package-lock --ignore-scripts)

scratch=$(mktemp -d)
server_pid=
cleanup() {
  [ -z "$server_pid" ] || kill -KILL "$server_pid" 2>/dev/null || true  # or it has ended
  rm -rf "$scratch"
}
trap cleanup EXIT

# A copy, so that nothing is made in the source tree and nothing that lies there is packed.
mkdir -p "$scratch/tree/client/typescript" "$scratch/tree/proto" "$scratch/consumer"
cp "$root/LICENSE" "$scratch/tree/"
cp -R "$root/proto/capfit" "$root/proto/google" "$scratch/tree/proto/"
package=$scratch/tree/client/typescript
cp -R "$source_package/"{package.json,tsconfig.json,README.md,scripts,src} "$package/"
rm -rf "$package/src/generated"
[ "$(node -p 'require(process.argv[1]).version' "$package/package.json")" = "$version" ] ||
  fail "client/typescript/package.json does not have the project's version $version"
(cd "$package" && "${install[@]}" && npm pack --silent >/dev/null)
tarball=$package/capfit-$version.tgz
listing=$(tar -tzf "$tarball")
for file in LICENSE README.md dist/index.js dist/index.d.ts proto/capfit/v1/service.proto; do
  grep -qx "package/$file" <<<"$listing" || fail "the tarball has no $file"
done
if grep -E 'package/(src|scripts|node_modules)/' <<<"$listing"; then fail "packed in vain"; fi
mkdir "$scratch/unpacked" && tar -xzf "$tarball" -C "$scratch/unpacked"
if grep -rlF -e "$scratch" -e "$root" "$scratch/unpacked"; then fail "paths of this machine"; fi

cp -R "$here/consumer/." "$scratch/consumer/"
cd "$scratch/consumer"
mkdir documented
for page in "$source_package/README.md" "$root/docs/clients.md"; do
  examples_of "$page" "documented/$(basename "$page" .md)"
done
"${install[@]}" "$tarball" "typescript@$compiler" "@types/node@$node_types"
node_modules/.bin/tsc

"$server" --listen 127.0.0.1:0 --port-file "$scratch/port" 2>"$scratch/log" &
server_pid=$!
for _ in $(seq 300); do
  [ -s "$scratch/port" ] && break
  kill -0 "$server_pid" 2>/dev/null || { cat "$scratch/log" >&2; exit 1; }
  sleep 0.1
done
export CAPFIT_ADDRESS=127.0.0.1:$(cat "$scratch/port") CAPFIT_VERSION=$version
export CAPFIT_BODY=$scratch/body.obj CAPFIT_RESULT=$scratch/result.json
"$capfit" mannequin -o "$CAPFIT_BODY" --faces 6000
"$capfit" approximate "$CAPFIT_BODY" -o "$CAPFIT_RESULT" --server "$CAPFIT_ADDRESS" --quiet \
  --parts all --max-primitives 80 --seed 7
node --test out/*.test.js plain.test.cjs plain.test.mjs

# The examples as they stand, but for body and address.
for example in out/documented/*.mjs; do
  sed "s/body\.glb/body.obj/; s/127\.0\.0\.1:50051/$CAPFIT_ADDRESS/" "$example" >"$example.run.mjs"
  (cd "$scratch" && node "consumer/$example.run.mjs" >"$scratch/out" 2>&1) ||
    fail "$(basename "$example"): $(cat "$scratch/out")"
done

kill -TERM "$server_pid"
wait "$server_pid"
server_pid=
