#!/usr/bin/env bash
# Both libraries have what the headers declare, and nothing else to be seen; the lean static one has at most 2.8 MB.
#
#     capi/tests/symbols.sh [--lean] PREFIX
set -euo pipefail
most=4100000
[ "$1" != --lean ] || { most=2800000 && shift; }
prefix=$1
lib=$prefix/lib/libmechaudit.so
include=$prefix/include

# Names before a parenthesis in declarations.
declared() { cc -E -P "$1" | grep -Eo "$2 *\(" | tr -d ' (' | sort -u; }
mechaudit=$(declared "$include/mechaudit.h" 'mechaudit_[a-z_]+')
libcerf=$(cc -E -P -I"$include" "$include/mechaudit/cerf.h" | tr -d '\n' | tr ';' '\n' |
    grep -E '^ *(double|_cerf_cmplx) [a-z_]+\(' | sed -E 's/^ *[a-z_]+ ([a-z_]+)\(.*/\1/' | sort -u |
    grep -E '^(w_of_z|(im|re)_w_of_[xz]|c?erf[a-z]*|c?dawson|voigt[a-z_]*)$' | grep -vE '^erfc?$')
exported=$(nm -D --defined-only "$lib" | awk '{print $3}' | sort)
plain=$(grep -v '^_Z' <<<"$exported")
mangled=$(grep '^_Z' <<<"$exported" | c++filt | sed 's/(.*//' | sort)

compare() { diff <(echo "$2") <(echo "$3") || { echo "symbols: $1" >&2 && exit 1; }; }
compare 'declared in the headers (<) and exported (>)' "$(sort -u <<<"$mechaudit"$'\n'"$libcerf")" "$plain"
compare "libcerf's names in C (<) and in C++ (>)" "$libcerf" "$mangled"
[ "$(wc -l <<<"$libcerf")" = 14 ] || { echo "symbols: $(wc -l <<<"$libcerf") names of libcerf" >&2 && exit 1; }

soname=$(objdump -p "$lib" | awk '/SONAME/{print $2}')
version=$(sed -n 's/^Version: //p' "$prefix/lib/pkgconfig/mechaudit.pc")
# Before 1.0 a minor version may change the interface.
[ "$soname" = "libmechaudit.so.${version%.*}" ] || { echo "symbols: soname $soname" >&2 && exit 1; }
needed=$(objdump -p "$lib" | awk '/NEEDED/{print $2}' | grep -vE '^(libc|libm|libgcc_s|ld-linux.*)\.so' || true)
[ -z "$needed" ] || { echo "symbols: needs $needed" >&2 && exit 1; }
if nm -D "$lib" | grep -iE 'gmp|mpfr'; then exit 1; fi

static=$(nm -g --defined-only "$prefix/lib/libmechaudit.a" | awk 'NF == 3 {print $3}' | sort)
compare 'visible in the shared (<) and in the static library (>)' "$exported" "$static"
size=$(stat -L -c %s "$prefix/lib/libmechaudit.a")
echo "libmechaudit.a: $size bytes, libmechaudit.so: $(stat -L -c %s "$lib") bytes"
[ "$size" -le "$most" ] || { echo "symbols: the static library has more than $most bytes" >&2 && exit 1; }
echo "symbols: 7 passed, 0 failed"
