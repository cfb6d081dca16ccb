#!/usr/bin/env bash
# Checks the plugin: format, lints, the files of its package, licences and sources of dependencies, tests, the README's
# program, and, if ALSA is installed, players that follow recordings.
# The first run builds Bevy without its renderer, which takes minutes. If LIPZ_TOOLS is set, ALSA and cargo-deny are
# required.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=0

cargo fmt --check --all
cargo clippy --quiet --locked --all-targets -- -D warnings
files=$(cargo package --list --allow-dirty --locked)
for needed in LICENSE-APACHE LICENSE-MIT README.md src/lib.rs; do
    grep -qx "$needed" <<<"$files" || { echo "the package lacks $needed" >&2; exit 1; }
done
if grep -E '^(tests|recordings)/' <<<"$files"; then
    echo "the package contains these tests" >&2
    exit 1
fi
# In the folder of `.ci/install`, or on the path.
deny=$(command -v ../../target/tools/bin/cargo-deny cargo-deny | head -n 1 || true)
if [ -n "$deny" ]; then
    "$deny" --locked check --hide-inclusion-graph licenses bans sources
elif [ -n "${LIPZ_TOOLS:-}" ]; then
    echo "needs cargo-deny" >&2
    exit 1
else
    echo "skipped: licences and sources of dependencies, because cargo-deny is not installed"
fi
cargo test --quiet --locked
if pkg-config --exists alsa; then
    cargo clippy --quiet --locked --package bevy_lipz_recordings --all-targets -- -D warnings
    cargo test --quiet --locked --package bevy_lipz_recordings
elif [ -n "${LIPZ_TOOLS:-}" ]; then
    echo "needs the headers of ALSA (libasound2-dev)" >&2
    exit 1
else
    echo "skipped: players that follow recordings, because the headers of ALSA (libasound2-dev) are not installed"
fi
