#!/usr/bin/env bash
# The header is what cbindgen makes of the crate: written with --write, compared without.
set -euo pipefail
cd "$(dirname "$0")/.."
made=$(mktemp)
trap 'rm -f "$made"' EXIT
# It does not know the type that the header defines by hand.
./tools cbindgen --quiet --config cbindgen.toml --output "$made" . 2>/dev/null
if [ "${1:-}" = --write ]; then
    cp "$made" include/mechaudit.h
else
    diff -u include/mechaudit.h "$made" || { echo "run capi/tests/header.sh --write" >&2 && exit 1; }
fi
echo "header: 1 passed, 0 failed"
