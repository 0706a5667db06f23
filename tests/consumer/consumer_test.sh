#!/usr/bin/env bash
# Installs capfit to a new prefix, builds the C++ samples against it as anybody would, without flags,
# and runs them: in this process without gRPC, and with a server. All must print what the sample of
# the build tree prints, to the last bit.
#
#   consumer_test.sh BUILD_FOLDER CMAKE OWN_ALGEBRA
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$1 cmake=$2 in_tree=$3
scratch=$(mktemp -d)
server_pid=
cleanup() {
  [ -z "$server_pid" ] || kill -KILL "$server_pid" 2>/dev/null || true  # or it has ended
  rm -rf "$scratch"
}
trap cleanup EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
# quietly WHAT COMMAND...: output only where it fails
quietly() {
  local what=$1; shift
  echo "$what"
  "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "$what"; }
}

# Installed in one place, used in another: no path of either may be written down.
quietly "install" "$cmake" --install "$build" --prefix "$scratch/first"
mv "$scratch/first" "$scratch/prefix"
prefix=$scratch/prefix
for file in bin/capfit bin/capfit-server include/capfit/core/pipeline/fit.h \
            include/capfit/client/body_client.h include/capfit/capfit/v1/service.grpc.pb.h \
            share/capfit/proto/capfit/v1/service.proto share/doc/capfit/LICENSE; do
  [ -s "$prefix/$file" ] || fail "$file was not installed"
done
[ ! -e "$prefix/include/core" ] || fail "include/core would be in the way of others"
if grep -rlE "$root|$build|$scratch" "$prefix"/lib*/cmake "$prefix"/lib*/*/cmake 2>/dev/null; then
  fail "the package names folders of this machine"
fi

cp -r "$root/client/samples/cpp" "$scratch/samples"
cp -r "$root/tests/consumer/own_algebra" "$scratch/own_algebra"
# configure_and_build SOURCE BUILD ARGUMENTS...
configure_and_build() {
  local source=$1 folder=$2; shift 2
  quietly "configure $(basename "$folder")" "$cmake" -S "$source" -B "$folder" -G Ninja \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@"
  if grep -nE -- '-march|-Wall|-W[a-z]|-fno-' "$folder/compile_commands.json"; then
    fail "users get flags that are ours"
  fi
  quietly "build $(basename "$folder")" "$cmake" --build "$folder" -j 2
}
no_grpc=(-DCMAKE_DISABLE_FIND_PACKAGE_gRPC=ON -DCMAKE_DISABLE_FIND_PACKAGE_Protobuf=ON)
configure_and_build "$scratch/own_algebra" "$scratch/core_only" "${no_grpc[@]}" \
  -DSAMPLES="$scratch/samples"
configure_and_build "$scratch/samples" "$scratch/all"
mkdir "$scratch/later"
cat >"$scratch/later/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(later LANGUAGES CXX)
find_package(capfit 0.999 REQUIRED)
CMAKE
! "$cmake" -S "$scratch/later" -B "$scratch/later/build" -DCMAKE_PREFIX_PATH="$prefix" \
  >"$scratch/log" 2>&1 || fail "a later version than the installed one was found"

export PATH=$prefix/bin:$PATH
capfit-server --listen 127.0.0.1:0 --port-file "$scratch/port" 2>"$scratch/server_log" &
server_pid=$!
for _ in $(seq 300); do
  [ -s "$scratch/port" ] && break
  kill -0 "$server_pid" 2>/dev/null || { cat "$scratch/server_log" >&2; exit 1; }
  sleep 0.1
done
body=$scratch/body.obj
capfit mannequin -o "$body" --faces 6000
"$in_tree" "$body" >"$scratch/wanted" 2>"$scratch/wanted_alignment"
[ "$(grep -c '^sphere ' "$scratch/wanted")" -gt 9 ] || fail "the sample of the build tree fits nothing"
check() {
  local name=$1; shift
  "$@" >"$scratch/got" 2>"$scratch/messages" || fail "$name: $(cat "$scratch/messages")"
  cmp "$scratch/wanted" "$scratch/got" || fail "$name: other bits: $(diff "$scratch/wanted" "$scratch/got" | head -n 4)"
  echo "$name: the same bits"
}
check core_only "$scratch/core_only/own_algebra" "$body"
cmp "$scratch/wanted_alignment" "$scratch/messages" || fail "users align other than the library"
check fit_here "$scratch/all/fit_here" "$body"
check approximate "$scratch/all/approximate" "127.0.0.1:$(cat "$scratch/port")" "$body"
