#!/usr/bin/env bash
# Compiles the plugin with each compiler, as Unreal would, against stubs of the engine, and runs its tests with the C
# library, also with sanitizers. Needs g++ or clang++, and python3. If mcs is installed, compiles the build rules too. If
# LIPZ_TOOLS is set, all of them are required.
# `run.sh bench` only measures a rendered frame, with the first compiler.
# LIPZ_CAPI is the folder that `cargo xtask capi` has written; by default target/capi.
set -euo pipefail
plugin=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
root=$(cd "$plugin/../.." && pwd)
tests=$plugin/test
capi=${LIPZ_CAPI:-${CARGO_TARGET_DIR:-$root/target}/capi}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
if [ ! -f "$capi/lib/liblipz.a" ]; then
    echo "no C library in $capi: run \`cargo xtask capi\`, or set LIPZ_CAPI" >&2
    exit 1
fi

for needed in g++ clang++ mcs; do
    if [ -n "${LIPZ_TOOLS:-}" ] && ! command -v "$needed" >/dev/null; then
        echo "needs $needed" >&2
        exit 1
    fi
done

mkdir "$out/generated" "$out/guide"
python3 "$tests/pages.py" "$root/docs/guides/unreal.md" "$out/guide"
python3 "$tests/header_tool.py" "$out/generated" "$plugin"/Source/*/Public/*.h "$plugin"/Source/*/Private/*.h "$out/guide/Talker.h"
python3 -m json.tool "$plugin/Lipz.uplugin" >/dev/null
if command -v mcs >/dev/null; then
    mcs -warnaserror -target:library -out:"$out/rules.dll" "$plugin"/Source/*/*.Build.cs "$tests/stubs/UnrealBuildTool.cs"
fi

# Unreal compiles without exceptions and run-time types, and with these warnings.
options=(-std=c++20 -Wall -Wextra -Werror -Wshadow -Wundef -fno-exceptions -fno-rtti
    -I "$tests/stubs" -isystem "$capi/include" -I "$out/generated" -I "$out/guide"
    -I "$plugin/Source/Lipz/Public" -I "$plugin/Source/Lipz/Private" -I "$plugin/Source/LipzEditor/Public"
    -DEXPECTED_OF_GUIDE="\"$out/guide/expected.txt\"")
product=("$plugin"/Source/*/Private/*.cpp "$out/guide/Talker.cpp")
compilers=0
for compiler in g++ clang++; do
    command -v "$compiler" >/dev/null || continue
    compilers=$((compilers + 1))
    # The sanitizers and the headers of one compiler are enough.
    builds=("-O0")
    if [ "${1:-}" = bench ]; then
        builds=("-O2")
    elif [ "$compilers" -eq 1 ]; then
        builds=("-O2" "-O0 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all")
        # Each header alone, and all sources of a module as one, as Unreal may do.
        printf '%s\0' "$plugin"/Source/*/Public/*.h "$plugin"/Source/*/Private/*.h | xargs -0 -P "$(nproc)" -I {} \
            "$compiler" "${options[@]}" -fsyntax-only -x c++ -include {} /dev/null
        printf '#include "%s"\n' "$plugin"/Source/Lipz/Private/*.cpp | "$compiler" "${options[@]}" -fsyntax-only -x c++ -
    fi
    for flags in "${builds[@]}"; do
        objects=$out/$compiler${flags//[^a-z]/}
        mkdir "$objects"
        read -ra flag <<<"$flags"
        # As many at a time as there are processors.
        printf '%s\0' "${product[@]}" "$tests"/stubs/*.cpp "$tests"/tests/*.cpp | xargs -0 -P "$(nproc)" -I {} sh -c \
            'file=$1; shift; "$@" -c "$file" -o "'"$objects"'/$(basename "$file" .cpp).o"' sh {} "$compiler" "${options[@]}" "${flag[@]}"
        "$compiler" "${flag[@]}" "$objects"/*.o "$capi/lib/liblipz.a" -o "$objects/unreal"
        echo "== $compiler $flags"
        "$objects/unreal" "$root" "$@"
    done
    [ "${1:-}" != bench ] || exit 0
done
[ "$compilers" -gt 0 ] || { echo "no compiler" >&2; exit 1; }
