#!/usr/bin/env bash
# Runs the line of docs/clients.md that generates a language's code from the contract, looks whether
# messages and stubs come out under the names that the page uses, and compiles the page's program
# where there is a compiler (none is asked for: Go and Java are large; C# has no gRPC in Debian).
#
#   generate_test.sh go|csharp|java
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
language=$1
page=docs/clients.md

skip() { echo "SKIPPED: $*" >&2; exit 77; }
fail() { echo "$language: $*" >&2; exit 1; }
need() { command -v "$1" >/dev/null || skip "no $1: apt-get install $2"; }
PATH=$PWD/node_modules/.bin:$PATH
command -v buf >/dev/null || skip "no buf: run .ci/buf once, it installs it"
case "$language" in
  go) need protoc-gen-go protoc-gen-go
      need protoc-gen-go-grpc protoc-gen-go-grpc ;;
  csharp) need protoc protobuf-compiler ;;
  java) need protoc protobuf-compiler
        need grpc_java_plugin protobuf-compiler-grpc-java-plugin ;;
esac

line="buf generate --template client/$language/buf.gen.yaml --path proto/capfit -o OUTPUT"
grep -qxF "$line" "$page" || fail "$page does not have the line '$line'"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
output=$scratch/src
eval "${line/OUTPUT/\"\$output\"}"

# has FILE TEXT
has() { grep -qF -e "$2" "$output/$1" || fail "$1 has no '$2'"; }
# The page's block of code of this language, in FILE.
program() {
  awk -v first="\`\`\`$language" '/^```$/ { on = 0 } on { print } $0 == first { on = 1 }' "$page" >"$1"
  [ -s "$1" ] || fail "$page has no program"
}
not_compiled() { echo "NOTE: no $1: the program of $page was not compiled"; }

program "$scratch/program"
case "$language" in
  go)
    has capfit/v1/options.pb.go 'package capfitv1'
    has capfit/v1/error.pb.go 'ErrorReason_ERROR_REASON_NOT_A_BODY'
    has capfit/v1/service_grpc.pb.go 'func NewBodyApproximationServiceClient('
    has capfit/v1/service_grpc.pb.go 'ApproximateBodyUnary(ctx context.Context'
    sources=/usr/share/gocode
    if command -v go >/dev/null && [ -d "$sources/src/google.golang.org/grpc" ]; then
      cp "$scratch/program" "$scratch/fit.go"
      GO111MODULE=off GOPATH=$scratch:$sources go vet "$scratch/fit.go"
    else
      not_compiled "golang-go with golang-google-grpc-dev"
    fi ;;
  csharp)
    has Capfit/V1/Options.cs 'namespace Capfit.V1'
    has Capfit/V1/Options.cs 'public int MaxPrimitives'
    has Capfit/V1/Options.cs '[pbr::OriginalName("QUALITY_TIGHT")] Tight'
    has Capfit/V1/Mesh.cs 'public sealed partial class InlineFile'
    has Capfit/V1/Service.cs 'public sealed partial class ApproximateBodyUnaryRequest'
    has Capfit/V1/Error.cs 'NotABody' ;;
  java)
    has capfit/v1/FitOptions.java 'package capfit.v1;'
    has capfit/v1/ErrorReason.java 'ERROR_REASON_NOT_A_BODY'
    has capfit/v1/BodyApproximationServiceGrpc.java 'ServiceBlockingStub newBlockingStub('
    if command -v javac >/dev/null && [ -e /usr/share/java/grpc-stub.jar ]; then
      cp "$scratch/program" "$scratch/Fit.java"
      jars=$(printf '%s:' /usr/share/java/{grpc-*,protobuf*,guava*,*jsr305*,*annotation*}.jar)
      javac -nowarn -cp "$jars" -d "$scratch/classes" -sourcepath "$output" "$scratch/Fit.java"
    else
      not_compiled "javac with libgrpc-java"
    fi ;;
esac
