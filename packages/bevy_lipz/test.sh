#!/usr/bin/env bash
# Checks the plugin: format, lints, tests, the README's program, and, if ALSA is installed, players that follow recordings.
# The first run builds Bevy without its renderer, which takes minutes. If LIPZ_TOOLS is set, ALSA is required.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=0

cargo fmt --check --all
cargo clippy --quiet --locked --all-targets -- -D warnings
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
