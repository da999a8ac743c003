#!/usr/bin/env bash
# The example for JAX: its handler compiled against jaxlib's headers, its derivatives compared.
#
#     PYTHON=PYTHON-WITH-JAX capi/tests/jax.sh PREFIX
set -euo pipefail
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")/../../examples/jax"
python=${PYTHON:-python3}
if ! include=$("$python" -c 'import jax; print(jax.ffi.include_dir())' 2>/dev/null); then
    echo "jax: skipped, $python has no jax with a foreign function interface"
    exit 0
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
c++ -std=c++17 -O2 -Wall -Wextra -shared -fPIC faddeeva_ffi.cc -isystem "$include" -I"$prefix/include" \
    "$prefix/lib/libmechaudit.so" -Wl,-rpath,"$prefix/lib" -o "$out/handler.so"
JAX_PLATFORMS=cpu FADDEEVA_FFI=$out/handler.so "$python" faddeeva_jax.py
echo "jax: 1 passed, 0 failed"
