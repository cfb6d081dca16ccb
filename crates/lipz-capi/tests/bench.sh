#!/usr/bin/env bash
# Measures the library in C and C++, as `cargo xtask capi` has built it.
# LIPZ_CAPI is the folder that it has written; by default target/capi.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
capi=${LIPZ_CAPI:-${CARGO_TARGET_DIR:-target}/capi}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
options=(-O2 -Wall -Wextra -Werror -I "$capi/include")
cc -std=c99 "${options[@]}" crates/lipz-capi/tests/bench.c "$capi/lib/liblipz.a" -o "$out/c" \
    -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc
c++ -std=c++17 "${options[@]}" crates/lipz-capi/tests/bench.cpp "$capi/lib/liblipz.a" -o "$out/cpp"
"$out/c" fixtures/banks/v1
"$out/cpp" fixtures/banks/v1
