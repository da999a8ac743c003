#!/usr/bin/env python3
"""Independent values of definite integrals, by mpmath's tanh-sinh and Gauss-Legendre quadrature.

Each integral is computed twice, with 60 and with 75 digits and other break points, and recorded to 40 digits
where the two agree to 45. The integrands are written here by hand. Nothing of mechaudit is used, and
nothing is proved.

    python3 reference/independent/quadrature.py            # writes quadrature.csv beside it
    python3 reference/independent/quadrature.py --check    # compares instead, exit 1 if it differs

Columns: integral, value (40 digits).
"""
import mpmath as mp

from check import run

DIGITS = 40
inf = mp.inf


def sech(x):
    return 1 / mp.cosh(x)


def peaks(x):
    tenth = mp.mpf(1) / 10
    return sech(10 * (x - 2 * tenth)) ** 2 + sech(100 * (x - 4 * tenth)) ** 4 + sech(1000 * (x - 6 * tenth)) ** 6


def roots():
    """Zeros of x^4 + 10x^3 + 19x^2 - 6x - 6 in (0, 1)."""
    found = mp.polyroots([1, 10, 19, -6, -6], maxsteps=500, extraprec=400)
    return sorted(mp.re(z) for z in found if abs(mp.im(z)) < mp.mpf(10) ** -30 and 0 < mp.re(z) < 1)


# name: integrand, break points at two densities
CASES = {
    "sin(x) from 0 to 100": (mp.sin, [0, *range(5, 100, 5), 100]),
    "4/(1+x^2) from 0 to 1": (lambda x: 4 / (1 + x * x), [0, 1]),
    "1/(1+x^2) from 0 to inf": (lambda x: 1 / (1 + x * x), [0, 1, inf]),
    "4 sqrt(1-x^2) from 0 to 1": (lambda x: 4 * mp.sqrt((1 - x) * (1 + x)), [0, 1]),
    "sin(x+exp(x)) from 0 to 4": (lambda x: mp.sin(x + mp.exp(x)), [0, 1, 2, 2.5, 3, 3.25, 3.5, 3.75, 4]),
    "|x^4+10x^3+19x^2-6x-6| exp(x) from 0 to 1": (
        lambda x: abs(x**4 + 10 * x**3 + 19 * x**2 - 6 * x - 6) * mp.exp(x), lambda: [0, *roots(), 1]),
    "exp(-x^2) from 0 to inf": (lambda x: mp.exp(-x * x), [0, 1, 2, 4, 8, 13]),
    "sech(x) from 0 to inf": (sech, [0, 1, 2, 4, 8, 16, 32, 64, 128, 180]),
    "x exp(-x)/(1+exp(-x)) from 0 to inf": (
        lambda x: x * mp.exp(-x) / (1 + mp.exp(-x)), [0, 1, 2, 4, 8, 16, 32, 64, 128, 190]),
    "log(x)/x^3 from 1 to inf": (lambda x: mp.log(x) / x**3, [1, 2, inf]),
    "log(x) from 0 to 1": (mp.log, [0, 1]),
    # x = exp(-u)
    "1/sqrt(x) from 0 to 1": (lambda u: mp.exp(-u / 2), [0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 400]),
    "sqrt(x) log(x) from 0 to 1": (lambda x: mp.sqrt(x) * mp.log(x), [0, 1]),
    "-log(x)/(1+x) from 0 to 1": (lambda x: -mp.log(x) / (1 + x), [0, 1]),
    # x = u^2
    "exp(-x)/sqrt(x) from 0 to inf": (lambda u: 2 * mp.exp(-u * u), [0, 1, 2, 4, 8, 14]),
    "sech(10(x-0.2))^2+sech(100(x-0.4))^4+sech(1000(x-0.6))^6 from 0 to 1": (
        peaks, [0, 0.1, 0.2, 0.3, 0.35, 0.38, 0.39, 0.4, 0.41, 0.42, 0.45, 0.5, 0.55, 0.58, 0.59, 0.595, 0.598, 0.599,
                0.6, 0.601, 0.602, 0.605, 0.61, 0.62, 0.65, 0.7, 0.8, 0.9, 1]),
    "max(sin(x),cos(x)) from 0 to pi": (lambda x: max(mp.sin(x), mp.cos(x)), lambda: [0, mp.pi / 4, mp.pi]),
    "x sin(x)/(1+cos(x)^2) from 0 to pi": (lambda x: x * mp.sin(x) / (1 + mp.cos(x) ** 2), lambda: [0, 1, 2, mp.pi]),
    "(exp(x)-floor(exp(x))) sin(x+exp(x)) from 0 to 4": (
        lambda x: (mp.exp(x) - mp.floor(mp.exp(x))) * mp.sin(x + mp.exp(x)),
        lambda: [mp.log(n) for n in range(1, 55)] + [4]),
    "x^x from 0 to 1": (lambda x: mp.exp(x * mp.log(x)), [0, 1]),
    "exp(-x^2+x) from -inf to inf": (
        lambda x: mp.exp(-x * x + x), [-13, -8, -4, -2, -1, 0, 0.5, 1, 2, 3, 5, 9, 14]),
}


def computed(digits, f, points, fine):
    with mp.workdps(digits):
        points = [mp.mpf(p) for p in (points() if callable(points) else points)]
        if fine:
            halves = [(a + b) / 2 for a, b in zip(points, points[1:]) if b != inf]
            points = sorted(points + halves)
        return mp.quad(f, points, maxdegree=12)


def table():
    lines = ["integral,value"]
    for name, (f, points) in CASES.items():
        first, second = computed(60, f, points, False), computed(75, f, points, True)
        with mp.workdps(75):
            if abs(first - second) > abs(second) * mp.mpf(10) ** -45:
                raise SystemExit(f"{name}: {first} and {second}")
            text = mp.nstr(second, DIGITS, strip_zeros=False)
        lines.append(f'"{name}",{text}' if "," in name else f"{name},{text}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
