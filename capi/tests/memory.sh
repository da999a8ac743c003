#!/usr/bin/env bash
# AddressSanitizer with UndefinedBehaviorSanitizer, and valgrind, over the tests and the examples in C and C++.
#
#     capi/tests/memory.sh PREFIX
set -euo pipefail
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
static=(-I"$prefix/include" "$prefix/lib/libmechaudit.a" -lm -lpthread -ldl)
examples=../../examples
count=0
build() { # NAME SOURCE FLAGS…
    local compiler=cc
    case $2 in *.cpp) compiler="c++ -std=c++17" ;; esac
    $compiler -g -O1 "${@:3}" "$2" "${static[@]}" -o "$out/$1"
}
for source in api.c abi.c names.cpp $examples/c/voigt.c $examples/c/spline.c $examples/cpp/faddeeva.cpp; do
    name=$(basename "$source")
    build asan "$source" -fsanitize=address,undefined -fno-sanitize-recover=all
    ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1 "$out/asan" >"$out/text" 2>&1 || { cat "$out/text" && exit 1; }
    build plain "$source"
    ../tools valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=all "$out/plain" \
        >"$out/text" 2>&1 || { tail -40 "$out/text" && exit 1; }
    echo "$name"
    count=$((count + 2))
done
echo "memory: $count passed, 0 failed"
