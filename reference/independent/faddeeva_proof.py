#!/usr/bin/env python3
"""Checks the rectangles of the proof of the error bound of the Faddeeva function, with python-flint alone.

    mechaudit prove faddeeva --boxes boxes.csv
    python3 reference/independent/faddeeva_proof.py boxes.csv [--points 2000] [--shells 40] [--seed 1]

Covering: in a random sample of the shells 2^k <= max(Re z, Im z) < 2^(k+1), by the bits of the numbers, exactly.
Points: random ones, and corners of rectangles. At each the formula that the code uses is found from its published
limits, with exact arithmetic for |z|^2; one of the rectangles that hold the point has to have this formula, with this
centre. The formula is carried out operation by operation, each rounded exactly, with the tables as they stand in the
source; w comes from Arb. The error has to be below the rectangle's bounds.
"""
import argparse
import csv
import math
import pathlib
import random
import re
import struct
import sys
from fractions import Fraction

from flint import acb, arb, ctx

ctx.prec = 300
MAX = struct.unpack("<Q", struct.pack("<d", sys.float_info.max))[0]
SOURCE = pathlib.Path(__file__).parents[2] / "src/solvers/special/faddeeva"


def bits(x):
    return struct.unpack("<Q", struct.pack("<d", x))[0]


def number(n):
    return struct.unpack("<d", struct.pack("<Q", n))[0]


def rounded(q):
    """The nearest double of a fraction: a quotient of integers is rounded once."""
    return q.numerator / q.denominator


def fma(a, b, c):
    s = Fraction(a) * Fraction(b) + Fraction(c)
    return rounded(s) if s else a * b + c


def two_prod(a, b):
    p = a * b
    return p, fma(a, b, -p)


# Formulas, as the code has them.

ROOT = 0.5641895835477563
ROOT_LO = 7.66772980658294e-18
SQRT_PI = 1.772453850905516
A = [1.0]
for n in range(1, 27):
    A.append(A[-1] * (n - 0.5))
K = [-2.0 * ROOT, 1.0, -4.0 / 3.0 * ROOT, 0.5, -8.0 / 15.0 * ROOT, 1.0 / 6.0, -16.0 / 105.0 * ROOT, 1.0 / 24.0]


def nine_terms(x, y):
    p, minus = y + y, -fma(x, x, y * y)
    last, follows = fma(p, K[7], K[6]), K[7]
    for n in range(6, 1, -1):
        last, follows = fma(p, last, fma(minus, follows, K[n - 1])), last
    rest = fma(p, last, minus * follows)
    small = fma(y, rest, minus * last)
    return 1.0 + fma(y, K[0], small), -fma(x, K[0], x * rest)


def reciprocal(large, small):
    hi0, lo0 = two_prod(large, large)
    hi = fma(small, small, hi0)
    lo = fma(small, small, hi0 - hi) + lo0
    f = ROOT / hi
    rest = fma(-hi, f, ROOT) + fma(-f, lo, ROOT_LO)
    return f, rest * SQRT_PI


def polynomial(s, t, terms):
    s2, t2 = fma(s, s, -(t + t)), t * t
    o1, o2, e1, e2 = A[terms - 1], 0.0, A[terms], 0.0
    k = terms - 2
    while k > 2:
        o = fma(s2, o1, fma(-t2, o2, A[k - 1]))
        e = fma(s2, e1, fma(-t2, e2, A[k]))
        o1, o2, e1, e2 = o, o1, e, e1
        k -= 2
    oa, ob, ea, eb = fma(-t2, o2, A[1]), o1, fma(-t2, e2, A[2]), e1
    oa, ob = fma(-t, ob, oa), s * ob
    ea, eb = fma(-t, eb, ea), s * eb
    return fma(s, ob + ea, fma(fma(s, s, -t), eb, oa)), fma(s, eb, ob + ea)


def series(a, b, terms):
    x, y = max(a, 1e-140), max(b, 1e-140)
    f, error = reciprocal(max(x, y), min(x, y))
    if terms == 2:
        t = f * SQRT_PI
        c = (x * x - y * y) * t
        c2, square = c + c, fma(4.0 * c, c, -1.0)
        h, k = t * A[1], t * t * A[2]
        gu = fma(k, square + c2, fma(h, c2 + 1.0, error))
        gv = fma(k, square - c2, fma(h, c2 - 1.0, error))
    else:
        xx, yy = x * x, y * y
        t = f * f * math.pi
        s = 2.0 * (xx - yy) * t
        b1, b2 = polynomial(s, t, terms)
        gu = t * fma(3.0 * xx - yy, b1, -b2) + error
        gv = t * fma(xx - 3.0 * yy, b1, -b2) + error
    p, q = b * f, a * f
    return fma(gu, p, p), fma(gv, q, q)


LOG2_E = 1.4426950408889634
ROUND = 6755399441055744.0
LN_2 = [float.fromhex("0x1.62e42fefa3p-1"), float.fromhex("0x1.3de6af278ece6p-42")]
EXP = [1.0 / math.factorial(n) for n in range(2, 14)]


def paired(c, x):
    xx = x * x
    even, odd = c[-2], c[-1]
    for k in range(len(c) - 3, -1, -1):
        if k % 2 == 0:
            even = fma(xx, even, c[k])
        else:
            odd = fma(xx, odd, c[k])
    return fma(x, odd, even)


def exp_rounded(hi, lo):
    k = fma(hi, LOG2_E, ROUND) - ROUND
    r = fma(-k, LN_2[0], hi)
    lo = fma(-k, LN_2[1], lo)
    s = r + lo
    lo = lo - (s - r)
    return 1.0 + (s + fma(s * s, paired(EXP, s), lo)), int(k)


def by_fours(c, x):
    x2 = x * x
    x4 = x2 * x2
    p = fma(x4, fma(x4, c[8], c[4]), c[0])
    q = fma(x4, fma(x4, c[9], c[5]), c[1])
    s = fma(x4, c[6], c[2])
    t = fma(x4, c[7], c[3])
    return fma(x2, fma(x, t, s), fma(x, q, p))


def beside_real_axis(a, b, next_to):
    hi, lo = two_prod(a, a)
    if next_to:
        f = ROOT / hi
        error = (fma(-hi, f, ROOT) + fma(-f, lo, ROOT_LO)) * SQRT_PI
        v = f * SQRT_PI
        gu, gv = fma(v, by_fours(REAL_LINE[1], v), error), fma(v, by_fours(REAL_LINE[0], v), error)
        exponent = (-hi, -lo)
    else:
        y = max(b, 1e-140)
        f, error = reciprocal(a, y)
        xx, yy = a * a, y * y
        t = f * f * math.pi
        b1, b2 = polynomial(2.0 * (xx - yy) * t, t, 16)
        gu, gv = t * fma(3.0 * xx - yy, b1, -b2) + error, t * fma(xx - 3.0 * yy, b1, -b2) + error
        exponent = (-hi, fma(y, y, -lo))
    q = a * f
    u, v = fma(gu, f, f), fma(gv, q, q)
    if b * u > 2.5e-19:
        return b * u, v
    e, k = exp_rounded(*exponent)
    return fma(b * 2.0**200, u, math.ldexp(e, k + 200)) * 2.0**-200, v


def plus(a, b, x, y, u, v):
    return fma(x, u, fma(-y, v, a)), fma(x, v, fma(y, u, b))


def square(x, y):
    return fma(x, x, -(y * y)), (x + x) * y


def row(c, dx, dy):
    x2, y2 = square(dx, dy)
    x4, y4 = square(x2, y2)
    re, im = list(c[32:36]), list(c[36:40])
    for at in (24, 16, 8):
        for m in range(4):
            a, b = c[at + m], c[at + 4 + m]
            r = fma(x4, re[m], fma(-y4, im[m], a))
            im[m] = fma(x4, im[m], fma(y4, re[m], b))
            re[m] = r
    even = plus(re[0], im[0], x2, y2, re[2], im[2])
    odd = plus(re[1], im[1], x2, y2, re[3], im[3])
    qr, qi = plus(*even, dx, dy, *odd)
    low = fma(c[5], dx, fma(-c[7], dy, c[1])), fma(c[5], dy, fma(c[7], dx, c[3]))
    re, im = plus(*plus(*low, x2, y2, qr, qi), dx, dy, c[4], c[6])
    return c[0] + re, c[2] + im


def rows_of(name):
    """The rows of a table."""
    text = (SOURCE / "tables.rs").read_text()
    body = text[text.index(f"static {name}:"):]
    body = body[: body.index("\n];")]
    body = body[body.index("= [") + 3 :]
    return [[float(x) for x in r.split(",") if x.strip()] for r in re.findall(r"\[([^][]*)\]", body)]


def tables():
    """Those of w, and the polynomials of the real line."""
    text = (SOURCE / "tables.rs").read_text()
    body = text[text.index("REAL_LINE:"):]
    body = body[body.index("="):]
    line = re.findall(r"\[([^][]*)\]", body[: body.index("];")])
    return rows_of("CELLS"), rows_of("REAL_AXIS"), [[float(x) for x in r.split(",") if x.strip()] for r in line]


CELLS, REAL_AXIS, REAL_LINE = tables()


def w(x, y):
    """Arb's, or the asymptotic series where its arguments are out of reach; each component to 80 bits where possible."""
    for ctx.prec in (300, 3000):
        z = acb(arb(x), arb(y))
        value = (-z * z).exp() * (acb(0, -1) * z).erfc() if max(x, y) < 1e6 else far(z)
        if all(part.rel_accuracy_bits() > 80 for part in (value.real, value.imag)):
            break
    return value


def far(z):
    """Sum_{n<30} with Olver's remainder: in the closed quadrant at most sqrt(e (N + 3/2)) Gamma(N + 1/2)/(pi |z|^(2N+1))."""
    q, term, total = 1 / (z * z), acb(1), acb(0)
    terms = 30
    for n in range(terms):
        total += term
        term *= q * (2 * n + 1) / 2
    size = (arb(1).exp() * (terms + arb("1.5"))).sqrt() * (arb(terms) + arb("0.5")).gamma() / arb.pi()
    radius = size / abs(z) ** (2 * terms + 1)
    main = acb(0, 1) / (arb.pi().sqrt() * z) * total
    ball = arb(0, radius.upper())
    return main + acb(ball, ball)


def centre_row(rows, centre):
    value = w(*centre)
    re, im = float(value.real), float(value.imag)
    for c in rows:
        if abs(c[0] - re) <= 2e-16 * abs(re) + 1e-300 and abs(c[2] - im) <= 2e-16 * abs(im) + 1e-300:
            return c
    sys.exit(f"no row about {centre}")


RINGS = [
    (Fraction(0), "Maclaurin 9 terms"), (Fraction(1, 16384), "Maclaurin 21 terms"), (Fraction(1, 16), "Taylor cell"),
    (Fraction(48), "asymptotic 26 terms"), (Fraction(112), "asymptotic 14 terms"), (Fraction(1024), "asymptotic 6 terms"),
    (Fraction(5120), "asymptotic 4 terms"), (Fraction(1048576), "asymptotic 2 terms"), (Fraction(1e200), "scaled"),
]


def used(a, b):
    """The formula of the code at a + i b, a > 0, and its centre."""
    raised = b + 1e-150
    try:
        r2 = Fraction(fma(a, a, raised * raised))
    except OverflowError:
        return "scaled", None
    if b <= 0.125 and Fraction(5, 4) <= r2 < 768:
        if r2 < 80:
            return "Taylor real axis", (float(round(Fraction(a) * 16)) / 16, 0.0)
        return ("real line" if b < 2.0**-28 else "strip"), None
    name = [name for limit, name in RINGS if r2 >= limit][-1]
    if name == "Taylor cell":
        fine = max(a, b) < 3.75 or b <= 0.25
        pitch = Fraction(1, 4) if fine else Fraction(1, 2)
        return name, tuple(float(round(Fraction(x) / pitch) * pitch) for x in (a, b))
    return name, None


def computed(name, centre, a, b):
    if name == "Maclaurin 9 terms":
        return nine_terms(a, b)
    if name.startswith("asymptotic"):
        return series(a, b, int(name.split()[1]))
    if name in ("strip", "real line"):
        return beside_real_axis(a, b, name == "real line")
    if name == "Taylor cell":
        return row(centre_row(CELLS, centre), a - centre[0], b - centre[1])
    if name == "Taylor real axis":
        return row(centre_row(REAL_AXIS, centre), a - centre[0], max(b, 1e-80))
    return None


def hole(whole, boxes, allowed=lambda square: False):
    """A pair of numbers, by their bits, that no box holds; squares are cut until one box holds them, or none holds any of
    them and they are allowed to be left out."""
    stack = [(whole, boxes)]
    while stack:
        square_, some = stack.pop()
        here = [r for r in some if all(r[i][0] <= square_[i][1] and square_[i][0] <= r[i][1] for i in (0, 1))]
        if any(all(r[i][0] <= square_[i][0] and square_[i][1] <= r[i][1] for i in (0, 1)) for r in here):
            continue
        if not here and allowed(square_):
            continue
        if not here:
            return tuple(number(side[0]) for side in square_)
        # Ends of boxes inside the square: without any each of them holds it.
        cuts = [sorted({e for r in here for e in (r[i][0], r[i][1] + 1) if square_[i][0] < e <= square_[i][1]}) for i in (0, 1)]
        i = 0 if len(cuts[0]) >= len(cuts[1]) else 1
        at = cuts[i][len(cuts[i]) // 2]
        low, high = list(square_), list(square_)
        low[i], high[i] = (square_[i][0], at - 1), (at, square_[i][1])
        stack += [(low, here), (high, here)]
    return None


def shell(a, b):
    most = max(a, b)
    return max(math.frexp(most)[1], -8) if most > 0 else -8


def parts_of(k):
    """A shell of the open quadrant and of the axis Re z = 0 as squares of bits."""
    tiny, last = 1, MAX
    start = bits(math.ldexp(1.0, k - 1)) if k > -8 else 0
    end = bits(math.ldexp(1.0, k)) - 1 if k < 1024 else last
    if k <= -8:
        return [[(tiny, end), (0, end)], [(0, 0), (0, end)]]
    return [[(start, end), (0, end)], [(tiny, start - 1), (start, end)], [(0, 0), (start, end)]]


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("boxes", type=pathlib.Path)
    arguments.add_argument("--points", type=int, default=2000)
    arguments.add_argument("--shells", type=int, default=40)
    arguments.add_argument("--seed", type=int, default=1)
    args = arguments.parse_args()
    choose = random.Random(args.seed)
    shells = {}
    with args.boxes.open() as file:
        for line in csv.DictReader(file):
            ends = [float.fromhex(line[k]) for k in ("re_from", "re_to", "im_from", "im_to")]
            centre = (float.fromhex(line["centre_re"]), float.fromhex(line["centre_im"])) if line["centre_re"] else None
            bounds = [float.fromhex(line[k]) for k in ("norm", "re", "im", "tiny")]
            shells.setdefault(shell(ends[1], ends[3]), []).append((ends, line["formula"], centre, bounds))
    if not shells:
        sys.exit("no boxes")
    near = [k for k in shells if k <= 8]
    rest = [k for k in shells if k > 8]
    covered = near + choose.sample(rest, min(args.shells, len(rest)))
    if sorted(shells) != list(range(-8, max(shells) + 1)):
        sys.exit("a shell is missing")
    for k in covered:
        boxes = [[(bits(e[0]), bits(e[1])), (bits(e[2]), bits(e[3]))] for e, *_ in shells[k]]
        for part in parts_of(k):
            found = hole(part, boxes)
            if found:
                sys.exit(f"no box holds {found}")
    worst, emulated, counts = 0.0, 0, {}
    for i in range(args.points):
        k = choose.choice(near if i % 2 else sorted(shells))
        ends = choose.choice(shells[k])[0]
        if i % 3 == 0:
            a, b = choose.choice(ends[:2]), choose.choice(ends[2:])
        else:
            a = number(choose.randint(bits(ends[0]), bits(ends[1])))
            b = number(choose.randint(bits(ends[2]), bits(ends[3])))
        if a == 0.0:
            continue
        name, centre = used(a, b)
        holding = [box for box in shells[shell(a, b)] if box[0][0] <= a <= box[0][1] and box[0][2] <= b <= box[0][3]]
        same = [box for box in holding if box[1] == name and box[2] == centre]
        if not same:
            sys.exit(f"no box of the formula {name} {centre} holds {a!r} + {b!r} i, but {[h[1:3] for h in holding]}")
        values = computed(name, centre, a, b)
        if values is None:
            continue
        emulated += 1
        counts[name] = counts.get(name, 0) + 1
        exact = w(a, b)
        off = [abs(arb(v) - e) for v, e in zip(values, (exact.real, exact.imag))]
        norm, re, im, tiny = same[0][3]
        size = abs(exact)
        unit = arb(2) ** -1075
        allowed = size * norm * arb(2) ** -52 + 2 * tiny * unit
        error = abs(acb(*off))
        if not error <= allowed:
            sys.exit(f"{name} at {a!r} + {b!r} i: error {error} above {allowed}")
        worst = max(worst, float(error / allowed))
        for v, e, c in zip(off, (exact.real, exact.imag), (re, im)):
            if math.isfinite(c) and e.rel_accuracy_bits() > 60 and float(e) > 0:
                ulp = arb(2) ** max(math.frexp(float(e))[1] - 53, -1074)
                if not v <= c * ulp + tiny * unit:
                    sys.exit(f"{name} at {a!r} + {b!r} i: a component is off by {v / ulp} units, above {c}")
    print(f"{len(covered)} of {len(shells)} shells are covered; at {emulated} points the error is at most {worst:.3f} of the bound")
    for name, count in sorted(counts.items()):
        print(f"  {name}: {count}")


if __name__ == "__main__":
    main()
