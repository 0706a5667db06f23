#!/usr/bin/env bash
# Builds the container image, with a registry or without one.
#
#   deploy/build_image.sh [--tag NAME] [--programs FOLDER] [-- ARGUMENTS OF THE ENGINE'S BUILD]
#
#   --tag NAME         of the image; default: capfit
#   --programs FOLDER  a build of Debian 12 (build/release) whose programs are taken, instead of
#                      compiling again in the image's first stage
#
# The engine is podman, else docker; CONTAINER_ENGINE names another. Where the base image
# debian:bookworm-slim is neither here nor can be pulled, debootstrap makes it from Debian's packages
# (as root; packages debootstrap, podman, runc; see docs/deployment.md for podman's settings).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

base=docker.io/library/debian:bookworm-slim
tag=capfit
programs=
while [ $# -gt 0 ]; do
  case "$1" in
    --tag) tag=$2; shift 2 ;;
    --programs) programs=$2; shift 2 ;;
    --) shift; break ;;
    *) echo "build_image.sh: no option '$1' (--tag, --programs)" >&2; exit 2 ;;
  esac
done
engine=${CONTAINER_ENGINE:-$(command -v podman || command -v docker || true)}
[ -n "$engine" ] || { echo "build_image.sh: neither podman nor docker is here" >&2; exit 1; }

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# What an image has no use for: packages that were unpacked, lists, documents, languages.
make_base() {
  command -v debootstrap >/dev/null || { echo "build_image.sh: no registry and no debootstrap" >&2; exit 1; }
  echo "no registry: making $base from Debian's packages"
  debootstrap --variant=minbase --include=ca-certificates bookworm "$scratch/base" >"$scratch/log" ||
    { tail -n 20 "$scratch/log" >&2; exit 1; }
  rm -rf "$scratch/base"/var/cache/apt/* "$scratch/base"/var/lib/apt/lists/* \
    "$scratch/base"/usr/share/{doc,man,info,locale}/* "$scratch/base"/var/log/*
  tar -C "$scratch/base" -c . | "$engine" import - "$base" >/dev/null
}

if ! "$engine" image inspect "$base" >/dev/null 2>&1; then
  timeout 60 "$engine" pull -q "$base" >/dev/null 2>&1 || make_base
fi

# Podman's own format has no HEALTHCHECK.
build=("$engine" build --network=host -t "$tag")
[ "$(basename "$engine")" != podman ] || build+=(--format docker)
if [ -z "$programs" ]; then
  "${build[@]}" "$@" .
else
  # The second stage of the Dockerfile alone, with these programs in place of the first.
  context=$scratch/context
  mkdir -p "$context/deploy" "$context/src/build/release/"{server,client}
  cp deploy/install_packages.sh "$context/deploy/"
  strip -o "$context/src/build/release/server/capfit-server" "$programs/server/capfit-server"
  strip -o "$context/src/build/release/client/capfit" "$programs/client/capfit"
  { echo "FROM scratch AS build"
    echo "COPY src /src"
    sed -n '/ AS run$/,$p' Dockerfile; } >"$context/Dockerfile"
  "${build[@]}" "$@" "$context"
fi
"$engine" image inspect --format '{{.Size}}' "$tag" |
  awk -v tag="$tag" '{ printf "%s: %.0f MB\n", tag, $1 / 1e6 }'
