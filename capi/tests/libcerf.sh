#!/usr/bin/env bash
# libcerf's own test programs, compiled as they are against our header and linked with our library.
#
#     LIBCERF_SRC=FOLDER capi/tests/libcerf.sh PREFIX
#
# FOLDER holds the unpacked source of libcerf 2 or 3 (test/*test.c, lib/*.h). Several folders, separated by
# `:`, are several versions. Without LIBCERF_SRC nothing is done. C and, from version 3 on, C++.
set -euo pipefail
prefix=$(cd "$1" && pwd)
if [ -z "${LIBCERF_SRC:-}" ]; then
    echo "libcerf: skipped, LIBCERF_SRC names no source of libcerf"
    exit 0
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
passed=0 failed=0
IFS=: read -ra folders <<<"$LIBCERF_SRC"
for folder in "${folders[@]}"; do
    tests=("$folder"/test/*test.c)
    [ -e "${tests[0]}" ] || { echo "libcerf: no test/*test.c in $folder" >&2 && exit 1; }
    # The tools of the tests include libcerf's internal headers, not its cerf.h: that is ours.
    mkdir -p "$out/internal"
    rm -f "$out"/internal/*
    for header in "$folder"/lib/*.h; do
        [ "$(basename "$header")" = cerf.h ] || cp "$header" "$out/internal"
    done
    include=(-I"$prefix/include/mechaudit" -I"$out/internal" -I"$folder/test")
    for source in "${tests[@]}"; do
        name=$(basename "$source" .c)
        if cc -std=gnu11 -O2 "${include[@]}" "$source" "$prefix/lib/libmechaudit.so" -Wl,-rpath,"$prefix/lib" -lm \
            -o "$out/$name" && "$out/$name" >"$out/text"; then
            passed=$((passed + 1))
        else
            failed=$((failed + 1))
        fi
        echo "$name: $(tail -1 "$out/text")"
    done
done
echo "libcerf: $passed passed, $failed failed"
[ "$failed" = 0 ]
