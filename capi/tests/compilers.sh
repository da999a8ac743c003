#!/usr/bin/env bash
# The headers under every standard and compiler, without a warning; the tests in C and C++, against the shared
# and the static library.
#
#     capi/tests/compilers.sh [--one] PREFIX
#
# --one takes one compiler and one standard of each language, for what depends on the library alone.
set -euo pipefail
ccs=(gcc clang "${CLANG:-}") c_standards=(c99 c11 c17 c2x c23)
cxxs=(g++ clang++ "${CLANG:+${CLANG/clang/clang++}}") cpp_standards=(c++17 c++20 c++2b)
if [ "$1" = --one ]; then
    ccs=(gcc) c_standards=(c17) cxxs=(g++) cpp_standards=(c++17)
    shift
fi
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
flags=(-Wall -Wextra -Wpedantic -Werror -I"$prefix/include")
shared=("$prefix/lib/libmechaudit.so" -Wl,-rpath,"$prefix/lib" -lm)
static=("$prefix/lib/libmechaudit.a" -lm -lpthread -ldl)
count=0

# Whether a compiler knows a standard.
knows() { "$1" "-std=$2" -x "$3" -fsyntax-only /dev/null 2>/dev/null; }
compilers() { for c in "$@"; do command -v "$c" || true; done; }

for cc in $(compilers "${ccs[@]}"); do
    for std in "${c_standards[@]}"; do
        knows "$cc" $std c || continue
        for header in mechaudit.h mechaudit/cerf.h; do
            # Twice, and with the standard headers it might clash with.
            printf '#include <math.h>\n#include <complex.h>\n#include <%s>\n#include <%s>\nint used(void);\n' $header $header |
                "$cc" -std=$std "${flags[@]}" -x c -fsyntax-only -
            count=$((count + 1))
        done
        "$cc" -std=$std "${flags[@]}" -O1 abi.c "${shared[@]}" -o "$out/abi"
        "$cc" -std=$std "${flags[@]}" -O1 api.c "${static[@]}" -o "$out/api"
        "$out/abi" >"$out/abi.txt" && "$out/api" >"$out/api.txt" || { cat "$out"/*.txt && exit 1; }
        digest=$(grep digest "$out/abi.txt")
        [ "${first:=$digest}" = "$digest" ] || { echo "compilers: $digest, with others $first" && exit 1; }
        count=$((count + 2))
        echo "$(basename "$cc") $std: $digest"
    done
done
for cxx in $(compilers "${cxxs[@]}"); do
    for std in "${cpp_standards[@]}"; do
        knows "$cxx" $std c++ || continue
        "$cxx" -std=$std "${flags[@]}" -O1 names.cpp "${shared[@]}" -o "$out/names"
        "$out/names" >"$out/names.txt" || { cat "$out/names.txt" && exit 1; }
        count=$((count + 1))
        echo "$(basename "$cxx") $std"
    done
done
echo "compilers: $count passed, 0 failed"
