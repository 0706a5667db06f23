#!/usr/bin/env bash
# Installs the Debian 12 packages that capfit needs; does nothing where they are there already.
#
#   deploy/install_packages.sh [build] [test] [deploy] [bench] [check] [run]
#
#   build  compiler and libraries                     (default)
#   test   what the tests call besides: Python and the builder of its package, JSON Schema, buf, plugins,
#          physics engines and a C# compiler that read exports
#   deploy what tests/deploy holds the files of deploy/ against; some of it starts services of its own
#   bench  what draws the plots of the evaluation
#   check  formatter, linter, fuzzer and sanitizer runtimes
#   run    the shared libraries of the finished programs only
set -euo pipefail

build=(
  g++ cmake ninja-build ccache pkg-config ca-certificates
  libabsl-dev libgrpc++-dev protobuf-compiler protobuf-compiler-grpc libprotobuf-dev libssl-dev
  libopenmesh-dev libeigen3-dev libtbb-dev libdraco-dev libmeshoptimizer-dev
  libspdlog-dev prometheus-cpp-dev libcli11-dev libhiredis-dev nlohmann-json3-dev libcairo2-dev
  libgtest-dev libgmock-dev libbenchmark-dev
)
test=(
  python3 python3-grpcio python3-protobuf python3-numpy python3-jsonschema
  python3-pip python3-setuptools python3-wheel npm git
  protoc-gen-go protoc-gen-go-grpc protobuf-compiler-grpc-java-plugin
  libbullet-dev liburdfdom-dev mono-mcs openssl prometheus redis-server
)
deploy=(prometheus nginx haproxy kubernetes-client python3-yaml)
bench=(python3 python3-matplotlib)
check=(clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev git python3 mypy)
run=(libprometheus-cpp-core1.0 libprometheus-cpp-pull1.0 libhiredis0.14 libgrpc++1.51 libtbb12 libspdlog1.10 libcairo2 libopenmesh1 libdraco7 libmeshoptimizer2d)

wanted=()
for group in "${@:-build}"; do
  case "$group" in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    deploy) wanted+=("${deploy[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    check) wanted+=("${check[@]}") ;;
    run) wanted+=("${run[@]}") ;;
    *) echo "install_packages.sh: no group '$group' (build, test, deploy, bench, check, run)" >&2; exit 2 ;;
  esac
done

installed=$(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' 2>/dev/null | sed -n 's/^ii *//p')
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "$package" <<<"$installed" || missing+=("$package")
done
# The same program from another source serves as well as Debian's package, and may exclude it.
serves() { command -v "$1" >/dev/null 2>&1 && missing=("${missing[@]/#$2/}") || true; }
serves npm npm
serves kubectl kubernetes-client
missing=(${missing[@]+${missing[@]}})
[ "${#missing[@]}" -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "missing packages: ${missing[*]}; run as root: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing ${#missing[@]} packages: ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -q &&
       "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
         apt-get install -q -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "install_packages.sh: apt-get failed" >&2
  exit 1
fi
