#!/usr/bin/env bash
# The examples in C, C++ and Fortran, built by CMake from what is installed, and with pkg-config.
#
#     capi/tests/examples.sh PREFIX
set -euo pipefail
prefix=$(cd "$1" && pwd)
top=$(cd "$(dirname "$0")/../.." && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
count=0
expect() { # PROGRAM LINE
    "$1" | tee "$out/text"
    grep -qF -- "$2" "$out/text" || { echo "examples: $1 does not say '$2'" >&2 && exit 1; }
    count=$((count + 1))
}
built() { # LANGUAGE
    cmake -S "$top/examples/$1" -B "$out/$1" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >"$out/log" &&
        cmake --build "$out/$1" >>"$out/log" || { cat "$out/log" && exit 1; }
}
built c
expect "$out/c/voigt" 'w(1 + i)    0.3047442052569126 +0.2082189382028316i'
expect "$out/c/spline" 'refused: x[0] = 5 is outside [0, 4]'
built cpp
expect "$out/cpp/faddeeva" 1
[ "$(uniq "$out/text" | wc -l)" = 2 ] || { echo "examples: three names, several values" >&2 && exit 1; }
built fortran
expect "$out/fortran/profile" 'refused: x[0] = 5 is outside [0, 4]'

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
version=$(pkg-config --modversion mechaudit)
grep -qF "set(PACKAGE_VERSION \"$version\")" "$prefix/share/mechaudit/cmake/mechauditConfigVersion.cmake" ||
    { echo "examples: CMake's version is not $version" >&2 && exit 1; }
cc "$top/examples/c/voigt.c" $(pkg-config --cflags --libs mechaudit) -o "$out/voigt"
LD_LIBRARY_PATH=$prefix/lib expect "$out/voigt" 'half width'
cc "$top/examples/c/voigt.c" -I"$prefix/include" $(pkg-config --static --libs-only-other mechaudit) \
    "$prefix/lib/libmechaudit.a" -lm -o "$out/voigt"
expect "$out/voigt" 'half width'
echo "examples: $count passed, 0 failed"
