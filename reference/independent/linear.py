#!/usr/bin/env python3
"""Independent answers of linear problems, roots and systems of equations, by mpmath in 80 digits.

Matrices are drawn with a fixed seed or named: Hilbert, Pascal, Frank, second differences. mpmath eliminates with pivots,
turns symmetric matrices to tridiagonal ones, and finds roots by the secant method or Newton's with a numerical Jacobian.
It proves nothing; it is a witness that the same problem was solved.

    python3 reference/independent/linear.py            # writes linear.csv beside it
    python3 reference/independent/linear.py --check    # compares instead, exit 1 if it differs

Columns: kind, rows, columns, numbers of the problem (fractions; a matrix by rows, then the right-hand side or the second
matrix; the ends of an interval, a start), answers to 30 digits (a matrix by rows, eigenvalues in ascending order, all
roots of the interval).
"""
import random
from fractions import Fraction

import mpmath as mp

from check import run

mp.mp.dps = 80


def number(q):
    return mp.mpf(q.numerator) / q.denominator


def matrix(rows, columns, entries):
    return mp.matrix([[number(entries[i * columns + j]) for j in range(columns)] for i in range(rows)])


def shown(x):
    """30 digits; what is left of a zero is zero."""
    return "0" if abs(x) < mp.mpf(10) ** -60 else mp.nstr(x, 30)


def line(kind, rows, columns, numbers, answers):
    return ",".join([kind, str(rows), str(columns), " ".join(map(str, numbers)), " ".join(map(shown, answers))])


def hilbert(n):
    return [Fraction(1, i + j + 1) for i in range(n) for j in range(n)]


def pascal(n):
    return [Fraction(int(mp.binomial(i + j, i))) for i in range(n) for j in range(n)]


def frank(n):
    return [Fraction(n - max(i, j) if j >= i - 1 else 0) for i in range(n) for j in range(n)]


def drawn(draw, count):
    return [Fraction(draw.randint(-99, 99), draw.choice((1, 2, 7, 64))) for _ in range(count)]


def symmetric(draw, n):
    a = drawn(draw, n * n)
    return [a[min(i, j) * n + max(i, j)] for i in range(n) for j in range(n)]


def definite(draw, n):
    """T Tᵀ and the unit matrix."""
    t = [draw.randint(-3, 3) for _ in range(n * n)]
    return [
        Fraction(sum(t[i * n + k] * t[j * n + k] for k in range(n)) + (i == j)) for i in range(n) for j in range(n)
    ]


def solutions(a, n, sides):
    columns = [mp.lu_solve(a, sides[:, k]) for k in range(sides.cols)]
    return [columns[k][i] for i in range(n) for k in range(sides.cols)]


def eigenvalues(a):
    return sorted(mp.eigsy(a, eigvals_only=True))


def pencil(a, b):
    inverse = mp.inverse(mp.cholesky(b))
    c = inverse * a * inverse.T
    return eigenvalues((c + c.T) / 2)


def linear_rows(draw):
    for n, entries in [(8, hilbert(8)), (12, pascal(12)), (10, frank(10)), *((n, drawn(draw, n * n)) for n in (2, 3, 5, 9))]:
        side = drawn(draw, n)
        a = matrix(n, n, entries)
        yield line("solve", n, n, entries + side, solutions(a, n, matrix(n, 1, side)))
        yield line("determinant", n, n, entries, [mp.det(a)])
    for n, entries in [(5, hilbert(5)), (4, drawn(draw, 16))]:
        yield line("inverse", n, n, entries, list(mp.inverse(matrix(n, n, entries))))
    for rows, columns in [(6, 2), (9, 4), (12, 3)]:
        entries, side = drawn(draw, rows * columns), drawn(draw, rows)
        a, b = matrix(rows, columns, entries), matrix(rows, 1, side)
        yield line("least-squares", rows, columns, entries + side, list(mp.qr_solve(a, b)[0]))
    # Powers of 1 to 9, of condition 10⁷.
    powers = [Fraction(x) ** k for x in range(1, 10) for k in range(6)]
    side = drawn(draw, 9)
    yield line("least-squares", 9, 6, powers + side, list(mp.qr_solve(matrix(9, 6, powers), matrix(9, 1, side))[0]))


def banded_rows(draw):
    """Rows of lower + 1 + upper entries, with lower in the place of columns."""
    for n, lower, upper in [(9, 1, 1), (12, 2, 1), (15, 1, 3)]:
        width = lower + 1 + upper
        band = drawn(draw, n * width)
        for i in range(n):
            for k in range(width):
                if not 0 <= i + k - lower < n:
                    band[i * width + k] = Fraction(0)
        a = mp.matrix(n, n)
        for i in range(n):
            for k in range(width):
                if 0 <= i + k - lower < n:
                    a[i, i + k - lower] = number(band[i * width + k])
        side = drawn(draw, n)
        yield line(f"banded-{width}", n, lower, band + side, solutions(a, n, matrix(n, 1, side)))


def eigenvalue_rows(draw):
    differences = [Fraction(2 * (i == j) - (abs(i - j) == 1)) for i in range(9) for j in range(9)]
    # Each eigenvalue of Wilkinson's matrix is near another one, the largest by 10⁻¹³.
    wilkinson = [Fraction(abs(10 - i) if i == j else int(abs(i - j) == 1)) for i in range(21) for j in range(21)]
    ones = [Fraction(1 + (i == j)) for i in range(6) for j in range(6)]
    cases = [(8, hilbert(8)), (10, pascal(10)), (9, differences), (21, wilkinson), (6, ones)]
    for n, entries in cases + [(n, symmetric(draw, n)) for n in (2, 3, 6)]:
        yield line("eigenvalues", n, n, entries, eigenvalues(matrix(n, n, entries)))
    for n in (2, 4, 7):
        a, b = symmetric(draw, n), definite(draw, n)
        yield line("pencil", n, n, a + b, pencil(matrix(n, n, a), matrix(n, n, b)))
    yield line("pencil", 5, 5, hilbert(5) + pascal(5), pencil(matrix(5, 5, hilbert(5)), matrix(5, 5, pascal(5))))


#: Functions by name, with an interval and starts near all roots in it.
ROOTS = {
    "cos(x)-x": (lambda x: mp.cos(x) - x, 0, 2, [0.7]),
    "x*exp(x)-1": (lambda x: x * mp.exp(x) - 1, 0, 2, [0.6]),
    "x^5-x-1": (lambda x: x**5 - x - 1, -2, 2, [1.2]),
    "wilkinson-5": (lambda x: (x - 1) * (x - 2) * (x - 3) * (x - 4) * (x - 5) + mp.mpf(2) ** -20, 0, 6, [1, 2, 3, 4, 5]),
    "sin(x^2)": (lambda x: mp.sin(x * x), 1, 5, [mp.sqrt(mp.pi * k) for k in range(1, 8)]),
    "exp(x)-2-x": (lambda x: mp.exp(x) - 2 - x, -3, 3, [-1.8, 1.1]),
}

#: Systems by name, with a start.
SYSTEMS = {
    "circle-and-cubic": (lambda x, y: [x * x + y * y - 4, x**3 - y], ["6/5", "8/5"]),
    "kepler": (lambda a, r: [a - mp.mpf(3) / 5 * mp.sin(a) - 1, r - 1 + mp.mpf(3) / 5 * mp.cos(a)], ["3/2", "1"]),
    "three-spheres": (
        lambda x, y, z: [x * x + y * y + z * z - 9, (x - 1) ** 2 + y * y - z, x * y * z - 1],
        ["3/2", "1/3", "2"],
    ),
}


def root_rows():
    for name, (f, low, high, starts) in ROOTS.items():
        yield line(name, 1, 1, [low, high], sorted(mp.findroot(f, s) for s in starts))
    for name, (f, start) in SYSTEMS.items():
        x = mp.findroot(f, [number(Fraction(s)) for s in start])
        yield line(name, len(start), 1, start, list(x))


def table():
    draw = random.Random(1969)
    lines = ["kind,rows,columns,numbers,answers"]
    for rows in (linear_rows(draw), banded_rows(draw), eigenvalue_rows(draw), root_rows()):
        lines += rows
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
