#!/usr/bin/env bash
# Runs the line of docs/clients.md that generates a language's code from the contract, and looks
# whether messages and stubs come out under the names that the page uses.
#
#   generate_test.sh go|csharp|java
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
language=$1

skip() { echo "SKIPPED: $*" >&2; exit 77; }
fail() { echo "$language: $*" >&2; exit 1; }
need() { command -v "$1" >/dev/null || skip "no $1: apt-get install $2"; }
PATH=$PWD/node_modules/.bin:$PATH
need buf "npm, then run .ci/buf once: it installs it"
case "$language" in
  go) need protoc-gen-go protoc-gen-go
      need protoc-gen-go-grpc protoc-gen-go-grpc ;;
  csharp) need protoc protobuf-compiler ;;
  java) need protoc protobuf-compiler
        need grpc_java_plugin protobuf-compiler-grpc-java-plugin ;;
esac

line="buf generate --template client/$language/buf.gen.yaml --path proto/capfit -o OUTPUT"
grep -qF "$line" docs/clients.md || fail "docs/clients.md does not have the line '$line'"
output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT
eval "${line/OUTPUT/\"\$output\"}"

# has FILE TEXT
has() { grep -qF -e "$2" "$output/$1" || fail "$1 has no '$2'"; }
case "$language" in
  go)
    has capfit/v1/options.pb.go 'package capfitv1'
    has capfit/v1/options.pb.go 'type FitOptions struct'
    has capfit/v1/error.pb.go 'ErrorReason_ERROR_REASON_NOT_A_BODY'
    has capfit/v1/service_grpc.pb.go 'func NewBodyApproximationServiceClient('
    has capfit/v1/service_grpc.pb.go 'ApproximateBodyUnary(ctx context.Context' ;;
  csharp)
    has Capfit/V1/Options.cs 'namespace Capfit.V1'
    has Capfit/V1/Options.cs 'class FitOptions'
    has Capfit/V1/Service.cs 'class ApproximateBodyUnaryRequest'
    has Capfit/V1/Error.cs 'NotABody' ;;
  java)
    has capfit/v1/FitOptions.java 'package capfit.v1;'
    has capfit/v1/ErrorReason.java 'ERROR_REASON_NOT_A_BODY'
    has capfit/v1/BodyApproximationServiceGrpc.java 'BodyApproximationServiceBlockingStub newBlockingStub('
    has capfit/v1/BodyApproximationServiceGrpc.java 'approximateBodyUnary(' ;;
esac
