#!/usr/bin/env python3
"""Checks the intervals of the proofs of erf, erfc, erfcx and Dawson's function of a real argument, with python-flint
alone.

    mechaudit prove erfcx --boxes erfcx.csv   # or faddeeva --part real, with all four
    python3 reference/independent/real_line_proof.py erfcx erfcx.csv [--points 2000] [--seed 1]

Covering: every finite number of either sign, of an odd function every positive one, by the bits of the numbers.
Points: ends of intervals and random numbers in them. At each the formula that the code uses is found from its published
limits; it has to be the interval's, with its centre. It is carried out operation by operation, each rounded exactly, with
the tables as they stand in the source; the value comes from Arb. The error has to be below the interval's bound.
"""
import argparse
import csv
import functools
import math
import pathlib
import random
import sys
from fractions import Fraction

from flint import arb, ctx

from faddeeva_proof import LN_2, LOG2_E, MAX, ROUND, A, bits, fma, number, rows_of, two_prod, w

ODD = ("erf", "dawson")
TWO_OVER_ROOT = (1.1283791670955126, 1.533545961316588e-17)
HALF_ROOT = (0.886226925452758, -3.8332932499128993e-17)
INVERSE_ROOT = (0.5641895835477563, 7.66772980658294e-18)
THIRD_LOW = -float.fromhex("0x1.5555555555555p-56")
EXP = [1.0 / math.factorial(n) for n in range(3, 14)]
FEW_OF_EXP = [1.0 / math.factorial(n) for n in range(2, 10)]


def coefficients(count, step):
    c, before = [1.0], (1.0, 1.0)
    for n in range(1, count):
        value, before = step(n, *before)
        c.append(value)
    return c


def dawson_step(n, f, two):
    f, two = f * (2 * n + 1), two * -2.0
    return two / f, (f, two)


DAWSON = coefficients(18, dawson_step)

# Sums of two numbers, as the code has them.


def two_sum(a, b):
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def fast_two_sum(a, b):
    s = a + b
    return s, b - (s - a)


def negative(x):
    return -x[0], -x[1]


def times(x, y):
    p, q = two_prod(x[0], y[0])
    return fast_two_sum(p, q + fma(x[1], y[0], fma(x[0], y[1], x[1] * y[1])))


def times_number(x, b):
    p, q = two_prod(x[0], b)
    return fast_two_sum(p, fma(x[1], b, q))


def over(x, b):
    q = x[0] / b
    p = two_prod(q, b)
    r = (x[0] - p[0]) - p[1] + fma(q, -0.0, x[1])
    return fast_two_sum(q, r / b)


def paired(c, x):
    xx, n = x * x, len(c)
    even, odd = c[(n - 1) & ~1], c[(n - 2) | 1]
    for k in range(n - 3, -1, -1):
        if k % 2 == 0:
            even = fma(xx, even, c[k])
        else:
            odd = fma(xx, odd, c[k])
    return fma(x, odd, even)


def exp_square(x, sign):
    """e^(sign x^2) as a sum and the exponent of a power of two."""
    h, lo = two_prod(sign * x, x)
    h, lo = fast_two_sum(h, lo)
    k = fma(h, LOG2_E, ROUND) - ROUND
    r, s = two_sum(fma(-k, LN_2[0], h), fma(-k, LN_2[1], lo))
    half = two_prod(r, 0.5 * r)
    p = fast_two_sum(1.0, r)
    q = fast_two_sum(p[0], half[0])
    tail = fma(r * r * r, paired(EXP, r), fma(s, r, s))
    return fast_two_sum(q[0], p[1] + q[1] + (half[1] + tail)), int(k)


def odd_real(c, low, x):
    hi, lo = two_prod(x, x)
    p = c[-1]
    for k in range(len(c) - 2, 1, -1):
        p = fma(hi, p, c[k])
    first = two_prod(c[1], hi)
    g = fast_two_sum(first[0], fma(hi * hi, p, first[1] + fma(c[1], lo, low * hi)))
    h = fast_two_sum(1.0, g[0])
    return times_number((h[0], h[1] + g[1]), x)


def axis_row(c, t):
    p2 = t * t
    p4 = p2 * p2
    p = c[-4:]
    for at in range(len(c) - 8, 3, -4):
        p = [fma(p4, p[m], c[at + m]) for m in range(4)]
    q = (p[0] + p2 * p[2]) + (t * p[1] + (t * p2) * p[3])
    a = two_prod(c[2], t)
    h = two_sum(c[0], a[0])
    return fast_two_sum(h[0], h[1] + (a[1] + fma(c[3], t, c[1]) + p2 * q))


def polynomial(s, t, terms):
    s2, t2 = fma(s, s, -(t + t)), t * t
    o1, o2, e1, e2 = A[terms - 1], 0.0, A[terms], 0.0
    for k in range(terms - 2, 2, -2):
        o1, o2, e1, e2 = fma(s2, o1, fma(-t2, o2, A[k - 1])), o1, fma(s2, e1, fma(-t2, e2, A[k])), e1
    if terms > 2:
        oa, ob, ea, eb = fma(-t2, o2, A[1]), o1, fma(-t2, e2, A[2]), e1
    else:
        oa, ob, ea, eb = o1, o2, e1, e2
    oa, ob = fma(-t, ob, oa), s * ob
    ea, eb = fma(-t, eb, ea), s * eb
    return fma(s, ob + ea, fma(fma(s, s, -t), eb, oa)), fma(s, eb, ob + ea)


def series(a, b, terms, real):
    """Re w at i b, or Im w at a."""
    x = b if real else a
    a, b = max(a, 1e-140), max(b, 1e-140)
    xx, yy = two_prod(a, a), two_prod(b, b)
    r2 = two_sum(xx[0], yy[0])
    low = r2[1] + (xx[1] + yy[1])
    inverse = 1.0 / r2[0]
    e = fma(-r2[0], inverse, 1.0) - low * inverse
    p = two_prod(inverse, INVERSE_ROOT[0])
    inverse_low = p[1] + fma(inverse, INVERSE_ROOT[1], p[0] * e)
    t = inverse * inverse
    b1, b2 = polynomial(2.0 * (xx[0] - yy[0]) * t, t, terms)
    turned = 3.0 * xx[0] - yy[0] if real else xx[0] - 3.0 * yy[0]
    g = t * fma(turned, b1, -b2)
    m = two_prod(x, p[0])
    return fast_two_sum(m[0], fma(g, m[0], fma(x, inverse_low, m[1])))


# Which formula, and its value.


def terms_at(r2):
    return next(n for limit, n in ((112.0, 26), (1024.0, 14), (1048576.0, 6), (1e200, 2)) if r2 < limit)


def square_of(x):
    return (x + 1e-150) * (x + 1e-150)


def nearest(x, parts):
    return float(round(Fraction(x) * parts)) / parts


VALUES = rows_of("ON_THE_AXIS")


def split_product(a, b):
    """The product of two sums of two numbers by halves of their bits."""
    def halves(x):
        c = 134217729.0 * x
        high = c - (c - x)
        return high, x - high
    p = a[0] * b[0]
    (a1, a2), (b1, b2) = halves(a[0]), halves(b[0])
    lost = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2
    return fast_two_sum(p, lost + (a[0] * b[1] + a[1] * b[0]))


def plus(a, b):
    s, t = two_sum(a[0], b[0])
    return fast_two_sum(s, t + (a[1] + b[1]))


@functools.cache
def row(function, centre):
    """Value, slope and higher coefficients at a centre, by the equation of the function."""
    v = VALUES[int(16 * centre)]
    e, erfcx, dawson = v[:2], v[2:4], v[4:]
    twice = (2.0 * centre, 0.0)
    if function == "erf":
        value, slope = plus((1.0, 0.0), negative(split_product(e, erfcx))), split_product(e, TWO_OVER_ROOT)
    else:
        value, slope = dawson, plus(TWO_OVER_ROOT, negative(split_product(dawson, twice)))
    c = [value[0], slope[0]]
    for n in range(8):
        part = n * c[n] / (n + 1) if function == "erf" else c[n]
        c.append(-2.0 * (centre * c[n + 1] + part) / (n + 2))
    return [*value, *slope, *c[2:]]


def about(function, x):
    """Centre and value of the row that serves x."""
    centre = nearest(x, 16)
    return centre, axis_row(row(function, centre), x - centre)


def quotient(x, y):
    q = x[0] / y[0]
    rest = plus(x, negative(split_product(y, (q, 0.0))))
    return fast_two_sum(q, rest[0] / y[0])


def part(x, n):
    return quotient(x, (n, 0.0))


@functools.cache
def erfc_row(c):
    """Value and slope of erfc at a centre, from those at a multiple of 1/16."""
    k = math.floor(16.0 * c + 0.5)
    x, h = k / 16.0, c - k / 16.0
    e, erfcx = VALUES[k][:2], VALUES[k][2:4]
    value, slope = split_product(e, erfcx), negative(split_product(e, TWO_OVER_ROOT))
    before, last = (0.0, 0.0), slope
    for n in range(24 if h != 0.0 else 0):
        value = plus(value, part(split_product(last, (h, 0.0)), n + 1.0))
        following = plus(split_product(last, (x, 0.0)), split_product(before, (h, 0.0)))
        following = part(split_product(following, (-2.0 * h, 0.0)), n + 1.0)
        slope = plus(slope, following)
        before, last = last, following
    return *value, *slope


def erfc_terms(k, first, count):
    return [1.0 / (math.factorial(k) * math.factorial(m) * (m + 2 * k + 1)) for m in range(first, first + count)]


ERFC_TERMS = [erfc_terms(0, 1, 8), erfc_terms(1, 0, 7), erfc_terms(2, 0, 4), erfc_terms(3, 0, 1)]


def horner(u, c):
    value = c[-1]
    for x in reversed(c[:-1]):
        value = fma(u, value, x)
    return value


def about_centre(row, c, t):
    """Value at distance t from value and slope at a centre."""
    value, low, slope, slope_low = row
    u, v = (c + c) * -t, t * t
    k0, k1, k2, k3 = (horner(u, terms) for terms in ERFC_TERMS)
    p = fma(u, k0, -(v * fma(-v, fma(-v, k3, k2), k1)))
    a = two_prod(slope, t)
    s = two_sum(value, a[0])
    return fast_two_sum(s[0], s[1] + fma(a[0], p, a[1] + fma(slope_low, t, low)))


def erfc_right(x):
    """Centre and value of erfc from value and slope at the centre."""
    c = nearest(x, 128)
    return c, about_centre(erfc_row(c), c, x - c)


def erfcx_about(x):
    """Centre and value of erfcx from that at a centre of the same sign."""
    c = math.copysign(nearest(abs(x), 128), x)
    value, slope = erfc_row(abs(c))[:2], erfc_row(abs(c))[2:]
    if math.copysign(1.0, x) < 0.0:
        value = plus((2.0, 0.0), negative(value))
    at = split_product(value, quotient(negative(TWO_OVER_ROOT), slope))
    t = x - c
    hi, lo = about_centre([*at, *negative(TWO_OVER_ROOT)], c, t)
    w = fma(c + c, t, t * t)
    growth = fma(w * w, paired(FEW_OF_EXP, w), w)
    return c, hi + fma(hi, growth, lo)


def erfcx_right(x):
    """Terms, and the sum."""
    n = terms_at(square_of(x))
    return n, series(0.0, x, n, True)


def scaled(x, k):
    half = k // 2
    return math.ldexp(math.ldexp(x, half), k - half)


def product(x):
    e, k = exp_square(x, -1.0)
    return times(e, erfcx_right(x)[1]), k


def computed(function, x):
    """Name of the formula, centre, value."""
    b = abs(x)
    if function in ODD:
        x = b
    if function == "erf":
        if b >= 5.96875:
            return "1", None, 1.0
        centre, value = about("erf", b)
        return "Taylor series", centre, sum(value)
    if function == "erfc":
        if b < 8.0 - 1.0 / 256.0:
            centre, t = erfc_right(b)
            if math.copysign(1.0, x) > 0.0:
                return "Taylor series", centre, sum(t)
            s = fast_two_sum(2.0, -t[0])
            return "2 - erfc |x|", centre, s[0] + (s[1] - t[1])
        if x < 0.0:
            return "2", None, 2.0
        if b >= 30.0:
            return "0", None, 0.0
        t, k = product(b)
        return "exp(-x^2) erfcx x asymptotic", None, scaled(sum(t), k)
    huge = b > 2e100 or not square_of(b) < 1e200
    if function == "dawson":
        if b < 0.5:
            return "Maclaurin series", None, sum(odd_real(DAWSON, 2.0 * THIRD_LOW, x))
        if huge:
            return "1/(2x)", None, 0.5 / x
        r2 = x * x
        if r2 < 80.0:
            centre, v = about("dawson", x)
            return "Taylor series", centre, sum(times(v, HALF_ROOT))
        n = terms_at(r2)
        return f"asymptotic {n} terms", None, sum(times(series(x, 0.0, n, False), HALF_ROOT))
    if b < 8.0 - 1.0 / 256.0:
        return "Taylor series", *erfcx_about(x)
    if math.copysign(1.0, x) > 0.0:
        if huge:
            k = math.frexp(x)[1] - 1
            return "1/(sqrt(pi) x) scaled", None, scaled(over(INVERSE_ROOT, math.ldexp(x, -k))[0], -k)
        n, right = erfcx_right(x)
        return f"asymptotic {n} terms", None, sum(right)
    if b > 30.0:
        return "infinity", None, math.inf
    e, k = exp_square(b, 1.0)
    try:
        return "2 exp(x^2)", None, scaled(sum(e), k + 1)
    except OverflowError:
        return "infinity", None, math.inf


def exact(function, x):
    for ctx.prec in (300, 3000):
        y = arb(x)
        if function == "erf":
            value = y.erf()
        elif function == "erfc":
            value = y.erfc() if x < 1e6 else arb(0)
        elif function == "dawson":
            value = w(x, 0.0).imag * arb.pi().sqrt() / 2
        elif x > 0.0:
            value = w(0.0, x).real
        else:
            value = (y * y).exp() * y.erfc()
        if value.rel_accuracy_bits() > 80 or x == 0.0:
            break
    return value


def check_covering(function, intervals):
    for negative_side in (False, True):
        if negative_side and function in ODD:
            continue
        ends = sorted(tuple(bits(abs(e)) for e in i) for i in intervals if (math.copysign(1.0, i[1]) < 0.0) == negative_side)
        follows = 0
        for lo, hi in (sorted(e) for e in ends):
            if lo != follows:
                sys.exit(f"no interval holds {number(follows)!r}, negative: {negative_side}")
            follows = hi + 1
        if follows != MAX + 1:
            sys.exit(f"no interval holds {number(follows)!r}, negative: {negative_side}")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("function", choices=["erf", "erfc", "erfcx", "dawson"])
    arguments.add_argument("intervals", type=pathlib.Path)
    arguments.add_argument("--points", type=int, default=2000)
    arguments.add_argument("--seed", type=int, default=1)
    args = arguments.parse_args()
    choose = random.Random(args.seed)
    with args.intervals.open() as file:
        rows = [
            ([float.fromhex(r[k]) for k in ("from", "to")], r["formula"], float.fromhex(r["centre"]) if r["centre"] else None, float.fromhex(r["ulps"]))
            for r in csv.DictReader(file)
            if r["function"] == args.function
        ]
    check_covering(args.function, [ends for ends, *_ in rows])
    kinds = sorted({name for _, name, *_ in rows})
    of_kind = {name: [r for r in rows if r[1] == name] for name in kinds}
    worst, counts = 0.0, {}
    for i in range(args.points):
        ends, name, centre, bound = choose.choice(of_kind[kinds[i % len(kinds)]])
        low, high = sorted(bits(abs(e)) for e in ends)
        size = choose.choice([number(low), number(high), number(choose.randint(low, high)), number(choose.randint(low, high))])
        x = math.copysign(size, ends[1])
        used, about, value = computed(args.function, x)
        if (used, about) != (name, centre):
            sys.exit(f"at {x!r} the formula is {used} {about}, not {name} {centre}")
        due = exact(args.function, x)
        if math.isinf(value):
            if not due > arb(sys.float_info.max):
                sys.exit(f"infinity at {x!r}, where the value is {due}")
            continue
        e = max(math.frexp(float(due))[1] - 53, -1074)
        off = abs(arb(value) - due) * arb(2) ** -e
        if not off <= bound:
            sys.exit(f"{name} at {x!r}: off by {off} units, above {bound}")
        worst = max(worst, float(off / bound) if bound > 1e-9 else 0.0)
        counts[name] = counts.get(name, 0) + 1
    print(f"{args.function}: {len(rows)} intervals cover the line; at {sum(counts.values())} points the error is at most {worst:.3f} of the bound")
    for name, count in sorted(counts.items()):
        print(f"  {name}: {count}")


if __name__ == "__main__":
    main()
