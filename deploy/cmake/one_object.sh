#!/usr/bin/env bash
# Links static libraries to one relocatable object whose inline functions are its own.
#
#   one_object.sh LD OBJCOPY NM OUTPUT.o LIBRARY...
#
# Otherwise the linker takes one copy of each inline function (Eigen's solvers, say) for a whole
# program, and the first it meets is the caller's: compiled for another machine or without
# optimisation it changes the last bits of a fit and makes it four times slower.
set -euo pipefail
ld=$1 objcopy=$2 nm=$3 output=$4
shift 4
inline=$output.inline
"$ld" --relocatable --force-group-allocation --whole-archive "$@" -o "$output"
"$nm" --defined-only "$output" | sed -n 's/^[0-9a-f]* [WVu] //p' >"$inline"
# Weakened first: what is marked unique in a process cannot be made local at once.
"$objcopy" --weaken-symbols="$inline" "$output"
"$objcopy" --localize-symbols="$inline" "$output"
rm "$inline"
