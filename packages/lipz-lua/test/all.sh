#!/bin/sh
# Runs all tests in each Lua on this machine, and in LÖVE. Fails if there is none, or if a test fails. If LIPZ_TOOLS is
# set, also fails if one of those is missing that `.ci/install` brings.
cd "$(dirname "$0")/.." || exit 1
count=0
for needed in luajit lua5.1 lua5.3 lua5.4 love; do
    if [ -n "${LIPZ_TOOLS:-}" ] && ! command -v "$needed" >/dev/null; then
        echo "needs $needed" >&2
        exit 1
    fi
done
for lua in luajit lua5.1 lua5.2 lua5.3 lua5.4; do
    command -v "$lua" >/dev/null || continue
    echo "== $lua"
    "$lua" test/run.lua || exit 1
    count=$((count + 1))
done
if command -v love >/dev/null; then
    echo "== love"
    love test/love || exit 1
    count=$((count + 1))
fi
echo "$count kinds of Lua"
test "$count" -gt 0
