#!/usr/bin/env bash
# All tests of the C library, on a library installed into target/capi; the lean one for its size and its values.
#
#     [LIBCERF_SRC=FOLDER] [PYTHON=PYTHON-WITH-JAX] capi/tests/run.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
tests=capi/tests
prefix=$PWD/target/capi/prefix
step() { printf '\n-- %s\n' "$*" && "$@"; }

step $tests/header.sh
step capi/install "$prefix"
for test in symbols compilers memory examples libcerf preload aarch64 jax; do
    step $tests/$test.sh "$prefix"
done
step capi/install --lean "$prefix-lean"
step $tests/symbols.sh --lean "$prefix-lean"
if grep -q avx2 /proc/cpuinfo; then
    step $tests/compilers.sh --one "$prefix-lean"
fi
