#!/usr/bin/env bash
# Downloads the archive of a release, compares its checksum, puts lipz on the PATH, and runs it.
set -euo pipefail

fail() {
    echo "::error title=lipz::$1"
    exit 1
}

extension=tar.gz
case "$RUNNER_OS-$RUNNER_ARCH" in
    Linux-X64) target=x86_64-unknown-linux-gnu ;;
    Linux-ARM64) target=aarch64-unknown-linux-gnu ;;
    macOS-X64) target=x86_64-apple-darwin ;;
    macOS-ARM64) target=aarch64-apple-darwin ;;
    Windows-X64) target=x86_64-pc-windows-msvc extension=zip ;;
    *) fail "There is no archive for $RUNNER_OS on $RUNNER_ARCH. Use pip or cargo instead." ;;
esac

version=${LIPZ_VERSION#v}
name="lipz-v$version-$target"
folder="$RUNNER_TEMP/lipz"
# A mirror may take the place of GitHub.
address="${LIPZ_RELEASES:-https://github.com/lipz/lipz/releases}/download/v$version/$name.$extension"
mkdir -p "$folder"
archive="$folder/$name.$extension"

download() {
    curl --fail --silent --show-error --location --retry 3 --output "$2" "$1" || fail "$1 cannot be downloaded."
}

download "$address" "$archive"
expected=${LIPZ_CHECKSUM:-}
if [ -z "$expected" ]; then
    download "$address.sha256" "$archive.sha256"
    expected=$(cut -d ' ' -f 1 "$archive.sha256")
fi
if command -v sha256sum >/dev/null; then
    found=$(sha256sum "$archive" | cut -d ' ' -f 1)
else
    found=$(shasum -a 256 "$archive" | cut -d ' ' -f 1)
fi
if [ "$found" != "$expected" ]; then
    rm "$archive"
    fail "The checksum of $name.$extension is $found, and not $expected."
fi

case "$extension" in
    zip) 7z x -y -o"$folder" "$archive" >/dev/null ;;
    *) tar -xzf "$archive" -C "$folder" ;;
esac
echo "$folder/$name" >>"$GITHUB_PATH"
if [ -n "$LIPZ_ARGS" ]; then
    # Divided at spaces, as on a command line.
    # shellcheck disable=SC2086
    "$folder/$name/lipz" $LIPZ_ARGS
fi
