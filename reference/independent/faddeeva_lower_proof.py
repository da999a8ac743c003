#!/usr/bin/env python3
"""Checks the rectangles of the proof below the real axis, with python-flint.

    mechaudit prove faddeeva --part lower --boxes lower.csv
    python3 reference/independent/faddeeva_lower_proof.py lower.csv [--binary mechaudit] [--points 20000] [--shells 40]

Covering: in all shells 2^k <= max(Re z, -Im z) < 2^(k+1) up to 256 and in a random sample of those beyond, by the bits
of the numbers, exactly: every pair is in a rectangle, but where w overflows, which is decided by fractions.
Points: random ones, corners of rectangles, points beside zeros of w. The program's `mechaudit eval faddeeva` gives the
64-bit values, Arb gives w. At each point |error| <= norm * 2^-52 |w| with the smallest bound among the rectangles of
formulas that stand alone; where two terms are added, with the largest of those that hold the point, or, where they
cancel and the point is computed again or by a stored zero, or where one dominates, with K = 2.5.
"""
import argparse
import csv
import math
import pathlib
import random
import subprocess
import sys
from fractions import Fraction

from faddeeva_proof import bits, hole, number, shell
from flint import acb, arb, ctx

K = 2.5
#: Bounds of points computed again, up to |z| = 4096 and beyond.
AGAIN = 0.564, 2.196
#: Two terms are added, and the value is used where they leave at least this part of w(-z).
REFLECTED = ("cell both terms", "26 terms both terms", "14 terms both terms", "6 terms both terms")
DOMINATED = "one term dominates"
#: Largest exponent of 2 e^(b^2 - a^2) / sqrt(2), below which neither component certainly overflows.
OVERFLOW = Fraction(70945, 100)
#: |z|^2 from which z is scaled: another inequality.
HUGE = Fraction(10) ** 200
LAST = 332


def quadrant(k):
    """A shell of Re z >= 0, Im z < 0 as squares of bits of Re z and -Im z."""
    start = bits(math.ldexp(1.0, k - 1)) if k > -8 else 0
    end = bits(math.ldexp(1.0, k)) - 1
    if k <= -8:
        return [[(0, end), (1, end)]]
    return [[(start, end), (1, end)], [(0, start - 1), (start, end)]]


def overflows(a, b):
    return Fraction(b) ** 2 - Fraction(a) ** 2 > OVERFLOW


def all_overflow(square):
    """Of the exponent b^2 - a^2 the least is at this corner."""
    return overflows(number(square[0][1]), number(square[1][0]))


def w(x, y):
    for ctx.prec in (200, 400, 3000):
        z = acb(arb(x), arb(y))
        value = (-z * z).exp() * (acb(0, -1) * z).erfc()
        if value.real.is_finite() and abs(value).rel_accuracy_bits() > 60:
            return value
    return None


def beside_a_zero(choose):
    """2 e^(-z^2) = w(-z) nearly, for the zero of number n."""
    n = choose.randrange(1, 4000)
    size = math.sqrt(math.pi * (n - 0.125))
    shift = math.log(2 * size * math.sqrt(2 * math.pi)) / (4 * size)
    off = math.exp(choose.uniform(math.log(1e-15), math.log(0.3)))
    return size + shift + off * choose.uniform(-1, 1), size - shift + off * choose.uniform(-1, 1)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("boxes", type=pathlib.Path)
    arguments.add_argument("--binary", default="mechaudit")
    arguments.add_argument("--points", type=int, default=20000)
    arguments.add_argument("--shells", type=int, default=40)
    arguments.add_argument("--seed", type=int, default=1)
    args = arguments.parse_args()
    choose = random.Random(args.seed)
    shells = {}
    with args.boxes.open() as file:
        for line in csv.DictReader(file):
            p, q, r, s = (float.fromhex(line[k]) for k in ("re_from", "re_to", "im_from", "im_to"))
            ends = p, q, -s, -r
            norm = float.fromhex(line["norm"]) if line["norm"] else None
            shells.setdefault(shell(q, -r), []).append((ends, line["formula"], norm))
    if sorted(shells) != list(range(-8, LAST + 2)):
        sys.exit("a shell is missing")
    near = [k for k in shells if k <= 8]
    covered = near + choose.sample([k for k in shells if k > 8], args.shells)
    for k in covered:
        boxes = [[(bits(e[0]), bits(e[1])), (bits(e[2]), bits(e[3]))] for e, *_ in shells[k]]
        for part in quadrant(k):
            found = hole(part, boxes, all_overflow)
            if found:
                sys.exit(f"no box holds {found[0]!r} - {found[1]!r} i")
    points = []
    while len(points) < args.points:
        if len(points) % 4 == 0:
            a, b = beside_a_zero(choose)
        else:
            k = choose.choice(near if len(points) % 2 else [k for k in shells if k <= 20])
            ends = choose.choice(shells[k])[0]
            if len(points) % 3 == 0:
                a, b = choose.choice(ends[:2]), choose.choice(ends[2:])
            else:
                a = number(choose.randint(bits(ends[0]), bits(ends[1])))
                b = number(choose.randint(bits(ends[2]), bits(ends[3])))
        if not overflows(a, b):
            points.append((a, b))
    text = "".join(f"{a.hex()},-{b.hex()}\n" for a, b in points)
    out = subprocess.run([args.binary, "eval", "faddeeva"], input=text, capture_output=True, text=True, check=True)
    answers = out.stdout.split("\n")
    worst, counts = {}, {}
    for (a, b), answer in zip(points, answers):
        got = [float.fromhex(x) for x in answer.split(",")]
        holding = [box for box in shells[shell(a, b)] if box[0][0] <= a <= box[0][1] and box[0][2] <= b <= box[0][3]]
        if not holding:
            sys.exit(f"no box holds {a!r} - {b!r} i")
        exact = w(a, -b)
        if exact is None or not all(map(math.isfinite, got)):
            sys.exit(f"nothing to compare at {a!r} - {b!r} i: {got}")
        alone = [box for box in holding if box[1] not in REFLECTED and box[1] != DOMINATED]
        if alone:
            name, norm = min(((box[1], box[2]) for box in alone), key=lambda box: box[1])
            if len({box[1] for box in holding}) > 1:
                norm = max(box[2] or K for box in holding)
        else:
            name = holding[0][1]
            mirrored = w(-a, b)
            cancelled = not abs(exact) > 0.2 * abs(mirrored)
            norm = K if cancelled or any(box[2] is None for box in holding) else max(box[2] for box in holding)
            # One component may have been computed again.
            norm = max(norm, AGAIN[max(a, b) > 2048])
        off = abs(acb(arb(got[0]) - exact.real, arb(got[1]) - exact.imag))
        allowed = abs(exact) * norm * arb(2) ** -52
        if not off <= allowed:
            sys.exit(f"{name} at {a!r} - {b!r} i: error {off} above {allowed}")
        worst[name] = max(worst.get(name, 0.0), float(off / allowed))
        counts[name] = counts.get(name, 0) + 1
    print(f"{len(covered)} of {len(shells)} shells are covered; {len(points)} points, the error as a part of the bound:")
    for name in sorted(counts):
        print(f"  {name}: {counts[name]}, at most {worst[name]:.3f}")


if __name__ == "__main__":
    main()
