#!/usr/bin/env bash
# The tests in C and C++ on AArch64 under qemu: double _Complex by value there too, and the same bits in every value,
# NaN included, as on x86-64.
#
#     capi/tests/aarch64.sh PREFIX
#
# Needs a cross compiler and qemu-aarch64 (Debian: g++-aarch64-linux-gnu, qemu-user); Rust's standard library for
# AArch64 is the installed toolchain's or, with a compiler of its own, Debian testing's, unpacked into target/aarch64.
set -euo pipefail
prefix=$(cd "$1" && pwd)
top=$(cd "$(dirname "$0")/../.." && pwd)
cd "$top"
for program in aarch64-linux-gnu-g++ aarch64-linux-gnu-gcc qemu-aarch64; do
    command -v $program >/dev/null || { echo "aarch64: skipped, no $program" && exit 0; }
done
target=aarch64-unknown-linux-gnu
root=$top/target/aarch64
rustc=$root/rustc
if [ -d "$(rustc --print target-libdir --target $target 2>/dev/null)" ]; then
    rustc=$(command -v rustc)
elif [ ! -x "$rustc" ]; then
    [ "$(uname -m)" = x86_64 ] && capi/debian "$root" rustc libstd-rust-dev libstd-rust-dev:arm64 ||
        { echo "aarch64: skipped, no standard library of Rust for $target" && exit 0; }
    lib=$root/usr/lib/x86_64-linux-gnu
    printf '#!/bin/sh\nexec "%s" --library-path "%s" "%s" --sysroot "%s" "$@"\n' \
        "$(echo "$lib"/ld-linux-*.so.*)" "$lib" "$root/usr/bin/rustc" "$root/usr" >"$rustc"
    chmod +x "$rustc"
fi
# Without optimisation: there are no times to be taken here.
RUSTC=$rustc CARGO_TARGET_DIR=$root/cargo CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    cargo build --quiet --locked --profile unoptimised --package mechaudit-capi --target $target
library=$root/cargo/$target/unoptimised/libmechaudit.a

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cd capi/tests
count=0
for source in abi.c api.c names.cpp; do
    name=${source%.*}
    compiler=gcc flags=(-O1)
    [ "$source" = names.cpp ] && compiler=g++ flags=(-O1 -std=c++17)
    aarch64-linux-gnu-$compiler "${flags[@]}" -I../include "$source" "$library" -lm -lpthread -ldl -o "$out/$name"
    qemu-aarch64 -L /usr/aarch64-linux-gnu "$out/$name" >"$out/$name.txt" || { cat "$out/$name.txt" && exit 1; }
    tail -1 "$out/$name.txt"
    count=$((count + 1))
done
cc -O1 -I../include abi.c "$prefix/lib/libmechaudit.so" -Wl,-rpath,"$prefix/lib" -lm -o "$out/here"
"$out/here" >"$out/here.txt"
here=$(grep digest "$out/here.txt") there=$(grep digest "$out/abi.txt")
[ "$here" = "$there" ] || { echo "aarch64: $there, on this machine $here" >&2 && exit 1; }
echo "$there on both"
echo "aarch64: $((count + 1)) passed, 0 failed"
