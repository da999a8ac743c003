#!/usr/bin/env bash
# Programs that were linked with another libcerf run with ours by LD_PRELOAD: one compiled here against the
# system's libcerf, and, where they are installed, BornAgain and gnuplot. Values before and after are printed; those
# after have to be those of a program linked with our library.
#
#     capi/tests/preload.sh PREFIX
set -euo pipefail
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")"
ours=$prefix/lib/libmechaudit.so
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
passed=0
if ! printf '#include <cerf.h>\n' | cc -E - >/dev/null 2>&1; then
    echo "preload: skipped, no libcerf is installed"
    exit 0
fi
cc -O1 preload.c -lcerf -o "$out/theirs"
cc -O1 -I"$prefix/include/mechaudit" preload.c "$ours" -Wl,-rpath,"$prefix/lib" -o "$out/ours"
ldd "$out/theirs" | grep -o 'libcerf.so[^ ]*'
"$out/theirs" >"$out/before"
LD_PRELOAD=$ours "$out/theirs" >"$out/after"
"$out/ours" >"$out/due"
diff "$out/after" "$out/due" || { echo "preload: other values than linked with it" >&2 && exit 1; }
if cmp -s "$out/before" "$out/after"; then
    echo "preload: nothing has changed, so nothing was tried" >&2
    exit 1
fi
paste -d'\n' "$out/before" "$out/after" | awk 'NR % 2 { before = $0; next } before == $0 { print "  " $0; next } { print "- " before; print "+ " $0 }'
passed=$((passed + 1))

# Where a program gets a function from.
bound() { LD_DEBUG=bindings LD_PRELOAD=$ours "${@:2}" 2>&1 >/dev/null | grep -q "to $ours .*\`$1'"; }

# libcerf 3 is two libraries, for C and for C++: the latter from Debian testing, which takes itself to be newer
# than the system's C library.
theirs=$PWD/../../target/libcerf
if [ -e "$theirs/usr/include/cerf.h" ] || ../debian "$theirs" libcerf-dev; then
    lib=$theirs/usr/lib/$(uname -m)-linux-gnu
    c++ -O1 -I"$theirs/usr/include" preload.cpp "$lib/libcerfcpp.so" -Wl,--allow-shlib-undefined -o "$out/theirs"
    c++ -O1 -I"$prefix/include/mechaudit" preload.cpp "$ours" -Wl,-rpath,"$prefix/lib" -o "$out/ours"
    mkdir "$out/lib"
    cp "$lib"/libcerfcpp.so.* "$out/lib"
    LD_LIBRARY_PATH=$out/lib "$out/theirs" >"$out/before"
    LD_LIBRARY_PATH=$out/lib LD_PRELOAD=$ours "$out/theirs" >"$out/after"
    "$out/ours" >"$out/due"
    ! cmp -s "$out/before" "$out/after" && diff "$out/after" "$out/due" ||
        { echo "preload: other values than linked with it, or none changed, in C++" >&2 && exit 1; }
    basename "$lib"/libcerfcpp.so.*.*
    passed=$((passed + 1))
else
    echo "preload: no libcerf of Debian testing"
fi

# BornAgain: diffuse scattering by correlated rough layers, which calls cerfcx.
if /usr/bin/python3 -c 'import bornagain' 2>/dev/null; then
    /usr/bin/python3 bornagain_layers.py >"$out/before"
    LD_PRELOAD=$ours /usr/bin/python3 bornagain_layers.py >"$out/after"
    bound cerfcx /usr/bin/python3 bornagain_layers.py || { echo "preload: BornAgain's cerfcx is not ours" >&2 && exit 1; }
    paste -d'\n' "$out/before" "$out/after"
    python3 - "$out/before" "$out/after" <<'EOF'
import sys
before, after = ([float(x) for x in open(f).read().split()] for f in sys.argv[1:])
assert len(before) == len(after) > 0 and any(before)
assert all(abs(a - b) <= 1e-9 * abs(b) for a, b in zip(after, before)), "intensities differ"
EOF
    passed=$((passed + 1))
else
    echo "preload: BornAgain is not installed"
fi

# gnuplot, where it was built with libcerf; Debian's is not.
if gnuplot=$(command -v gnuplot) && ldd "$(readlink -f "$gnuplot")" | grep -q libcerf; then
    echo 'print sprintf("%.15g %.15g", voigt(1, 2), real(cerf({1, -2})))' >"$out/plot"
    LD_PRELOAD=$ours gnuplot "$out/plot" 2>"$out/after" && cat "$out/after"
    bound voigt gnuplot "$out/plot" || { echo "preload: gnuplot's voigt is not ours" >&2 && exit 1; }
    passed=$((passed + 1))
else
    echo "preload: no gnuplot that is linked with libcerf"
fi
echo "preload: $passed passed, 0 failed"
