#!/usr/bin/env bash
# The shared library exports what the headers declare, and nothing else; it and the static one have the sizes
# promised.
#
#     capi/tests/symbols.sh PREFIX
set -euo pipefail
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
[ "$soname" = libmechaudit.so.0.1 ] || { echo "symbols: soname $soname" >&2 && exit 1; }
needed=$(objdump -p "$lib" | awk '/NEEDED/{print $2}' | grep -vE '^(libc|libm|libgcc_s|ld-linux.*)\.so' || true)
[ -z "$needed" ] || { echo "symbols: needs $needed" >&2 && exit 1; }
if nm -D "$lib" | grep -iE 'gmp|mpfr'; then exit 1; fi

for file in "$prefix/lib/libmechaudit.a" "$lib"; do
    size=$(stat -L -c %s "$file")
    echo "$(basename "$file"): $size bytes"
    [ "$size" -le $((2 << 20)) ] || { echo "symbols: more than 2 MiB" >&2 && exit 1; }
done
echo "symbols: 6 passed, 0 failed"
