#!/usr/bin/env python3
"""Independent values of interpolants, by scipy: PCHIP, Akima, modified Akima, cubic splines with a
condition of its own at each end, and periodic ones beyond their knots.

Knots are multiples of 1/64 and ordinates of 1/32, drawn with a fixed seed, half of them small whole
numbers, where chords are often equal, level or opposite. scipy computes in floats and proves nothing.

    python3 reference/independent/splines.py            # writes splines.csv beside it
    python3 reference/independent/splines.py --check    # compares instead, exit 1 if it differs

Columns: method of mechaudit, knots, ordinates, end conditions (kind and value of each end: 0
not-a-knot, 1 first derivative, 2 second derivative), query, then S, S', S'', S''' to 12 digits.
"""
import random

import numpy as np
import scipy
from scipy.interpolate import Akima1DInterpolator, CubicSpline, PchipInterpolator

from check import run

ROWS_OF_EACH = 40


def points(draw, whole):
    n = draw.randint(3, 8)
    x = [draw.randint(-256, 256) / 64]
    for _ in range(n - 1):
        x.append(x[-1] + (draw.randint(1, 3) if whole else draw.randint(32, 128) / 64))
    y = [float(draw.randint(-3, 3)) if whole else draw.randint(-160, 160) / 32 for _ in x]
    return x, y


def end(draw):
    kind = draw.randint(0, 2)
    return kind, draw.randint(-64, 64) / 32 if kind else 0.0


def fitted(method, x, y, ends):
    if method == "pchip":
        return PchipInterpolator(x, y)
    if method in ("akima", "modified-akima"):
        return Akima1DInterpolator(x, y, method="makima" if "modified" in method else "akima")
    if method == "cubic-spline-periodic":
        return CubicSpline(x, y, bc_type="periodic")
    conditions = tuple("not-a-knot" if kind == 0 else (kind, value) for kind, value in ends)
    return CubicSpline(x, y, bc_type=conditions)


def row(draw, method, index):
    x, y = points(draw, index % 2 == 0)
    ends = [end(draw), end(draw)] if "ends" in method else []
    q = x[0] + draw.randint(1, 999) / 1024 * (x[-1] - x[0])
    if method == "cubic-spline-periodic":
        y[-1] = y[0]
        q += draw.randint(-5, 5) * (x[-1] - x[0])
    s = fitted(method, np.array(x), np.array(y), ends)
    values = [float(s(q, nu)) for nu in range(4)]

    def listed(numbers):
        return " ".join(repr(float(v)) for v in numbers)

    conditions = listed(v for pair in ends for v in pair)
    # Adding 0 makes negative zeros positive.
    shown = [f"{v + 0.0:.12g}" for v in values]
    return ",".join([method, listed(x), listed(y), conditions, repr(q), *shown])


def table():
    draw = random.Random(1970)
    lines = ["method,x,y,ends,q,S,S1,S2,S3"]
    for method in ("pchip", "akima", "modified-akima", "cubic-spline-mixed-ends", "cubic-spline-periodic"):
        lines += [row(draw, method, index) for index in range(ROWS_OF_EACH)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table, f"scipy {scipy.__version__}")
