#!/usr/bin/env bash
# Compiles the package as Unity would, with stubs of the engine and warnings as errors, and runs all tests with Mono.
# Needs mono-mcs, mono-runtime, libmono-system-core4.0-cil and python3. LIPZ_TEST_OUT keeps the assemblies in a folder.
set -euo pipefail
package=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
root=$(cd "$package/../.." && pwd)
tests=$package/test~
out=${LIPZ_TEST_OUT:-$(mktemp -d)}
mkdir -p "$out"
[ -n "${LIPZ_TEST_OUT:-}" ] || trap 'rm -rf "$out"' EXIT

# compile FILE FOLDER... [-- REFERENCE...]: an assembly of all sources in folders.
compile() {
    local file=$1 folders=() options=(-langversion:7.2 -optimize+ -warn:4 -warnaserror)
    shift
    while [ $# -gt 0 ] && [ "$1" != -- ]; do folders+=("$1") && shift; done
    [ $# -gt 0 ] && shift
    for reference in "$@"; do options+=("-r:$out/$reference.dll"); done
    # Fields of components are set by the editor (CS0649). Everything public is documented (CS1591).
    case $file in Lipz.*) options+=("-doc:$out/$file.xml" -nowarn:0649) ;; esac
    case $file in *.dll) options+=(-target:library) ;; esac
    local sources
    mapfile -d '' sources < <(find "${folders[@]}" -name '*.cs' -print0 | sort -z)
    mcs "${options[@]}" -out:"$out/$file" "${sources[@]}"
}

python3 "$tests/package.py" "$root"
python3 "$tests/pages.py" guide "$root/docs/guides/unity.md" "$out/guide"

compile reader.exe "$package/Runtime/Reader" "$tests/reader"
mono "$out/reader.exe" "$root"

compile Lipz.Reader.dll "$package/Runtime/Reader"

# The program at the start of the readme, with the output that the readme shows.
python3 "$tests/pages.py" readme "$package/README.md" "$out/first"
compile first.exe "$out/first" -- Lipz.Reader
cp "$root/fixtures/banks/v1/drama.lipzbank" "$out/first/dialogue.lipzbank"
(cd "$out/first" && mono ../first.exe | sed 's/ *$//' | diff expected.txt -)
echo "program of the readme: same output"

# With the references of the asmdef files, which package.py compares.
compile UnityEngine.dll "$tests/stubs/UnityEngine"
compile Unity.Timeline.dll "$tests/stubs/Unity.Timeline" -- UnityEngine
compile UnityEditor.dll "$tests/stubs/UnityEditor" -- UnityEngine
compile nunit.framework.dll "$tests/stubs/nunit.framework"
compile Lipz.Unity.dll "$package/Runtime/Unity" -- Lipz.Reader UnityEngine
compile Lipz.Timeline.dll "$package/Runtime/Timeline" -- Lipz.Reader Lipz.Unity Unity.Timeline UnityEngine
compile Lipz.Editor.dll "$package/Editor" -- Lipz.Reader Lipz.Unity UnityEngine UnityEditor
compile Lipz.Tests.dll "$package/Tests/Runtime" -- Lipz.Reader Lipz.Unity UnityEngine nunit.framework
compile unity.exe "$tests/unity" "$package/Samples~/Conversation" "$out/guide" -- \
    Lipz.Reader Lipz.Unity Lipz.Timeline Lipz.Editor Lipz.Tests UnityEngine Unity.Timeline UnityEditor nunit.framework
mono "$out/unity.exe" "$root" "$out/guide/expected.txt"
