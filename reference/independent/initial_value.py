#!/usr/bin/env python3
"""Independent values of initial value problems, by Taylor series of mpmath's numbers.

Each right-hand side is written here by hand as recurrences for its Taylor coefficients. Steps are so short that the
last terms of the series are below the tolerance. Every problem is integrated twice, with other tolerances, orders
and precisions, and recorded to 30 digits where the two agree to 30. Robertson's reaction is stiff: a series takes hours
to t = 400, where its values are those of an implicit method of order 23, to 20 digits; up to t = 40 it gives the
series' values, in half a minute. Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/initial_value.py            # writes initial_value.csv beside it
    python3 reference/independent/initial_value.py --check    # recomputes the short ones and compares, exit 1 if one differs
    python3 reference/independent/initial_value.py --check --all    # all of them: hours, or minutes with gmpy2

Columns: problem, inputs (as in examples/studies/motion), time, state, value (30 digits).
"""
import os
import pathlib
import sys

import mpmath as mp
from mpmath import mpf

DIGITS = 30


class Series:
    """The Taylor coefficients of a function of time; each is computed from those before it, when it is asked for."""

    def __init__(self, rule, *parts):
        self.rule, self.parts, self.c = rule, parts, []

    def __getitem__(self, k):
        while len(self.c) <= k:
            self.c.append(self.rule(self, len(self.c)))
        return self.c[k]

    def upto(self, k):
        self[k]
        return self.c[: k + 1]

    def __add__(self, other):
        a, b = self, wrap(other)
        return Series(lambda s, k: a[k] + b[k])

    def __sub__(self, other):
        a, b = self, wrap(other)
        return Series(lambda s, k: a[k] - b[k])

    def __mul__(self, other):
        if not isinstance(other, Series):
            q, a = other, self
            return Series(lambda s, k: q * a[k])
        a, b = self, other
        return Series(lambda s, k: product(a, b, k))

    def __truediv__(self, other):
        if not isinstance(other, Series):
            q, a = other, self
            return Series(lambda s, k: a[k] / q)
        a, b = self, other
        # s b = a
        return Series(lambda s, k: (a[k] - mp.fdot(zip(s.c, reversed(b.upto(k)[1:])))) / b[0] if k else a[0] / b[0])

    def __pow__(self, p):
        """A constant power p: s' a = p a' s."""
        if p == 2:
            return self * self
        a, slope = self, self.derivative()

        def rule(s, k):
            if k == 0:
                return a[0] ** p
            earlier = s.c[::-1]
            rest = (p + 1) * mp.fdot(zip(slope.upto(k - 1), earlier)) - k * mp.fdot(zip(a.upto(k)[1:], earlier))
            return rest / (k * a[0])

        return Series(rule)

    def derivative(self):
        return Series(lambda s, k: (k + 1) * self[k + 1])

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return self * -1

    def __rsub__(self, other):
        return wrap(other) - self

    def __rtruediv__(self, other):
        return wrap(other) / self


def wrap(x):
    if isinstance(x, Series):
        return x
    return Series(lambda s, k: mpf(x) if k == 0 else mpf(0))


def product(a, b, k):
    return mp.fdot(zip(a.upto(k), reversed(b.upto(k))))


def sin_cos(a):
    """sin' = a' cos, cos' = -a' sin."""

    slope = a.derivative()
    s = Series(lambda s, k: product(slope, c, k - 1) / k if k else mp.sin(a[0]))
    c = Series(lambda c, k: -product(slope, s, k - 1) / k if k else mp.cos(a[0]))
    return s, c


def q(text):
    """An exact quotient or decimal at the working precision."""
    above, _, below = text.partition("/")
    return mpf(above) / mpf(below or "1")


def pendulum(t, theta, omega):
    return [omega, -q("9.81") * sin_cos(theta)[0]]


def duffing(t, x, v):
    phase = t * q("0.5") + t * t * (q("0.05") / 2)
    return [v, sin_cos(phase)[1] * q("0.8") - v * q("0.1") - x - x * x * x * q("0.5")]


def van_der_pol(mu):
    return lambda t, x, y: [y, (1 - x * x) * y * q(mu) - x]


def lorenz(t, x, y, z):
    return [(y - x) * 10, x * (28 - z) - y, x * y - z * q("8/3")]


def rossler(t, x, y, z):
    return [-y - z, x + y * q("0.2"), q("0.2") + z * (x - q("5.7"))]


def double_pendulum(t, a, b, v, w):
    g = q("9.81")
    sine, cosine = sin_cos(a - b)
    below = 3 - sin_cos((a - b) * 2)[1]
    first = sin_cos(a)[0] * (-3 * g) - sin_cos(a - b * 2)[0] * g - sine * 2 * (w * w + v * v * cosine)
    second = sine * 2 * (v * v * 2 + sin_cos(a)[1] * (2 * g) + w * w * cosine)
    return [v, w, first / below, second / below]


def kepler(t, x, y, u, v):
    cube = (x * x + y * y) ** q("-3/2")
    return [u, v, -x * cube, -y * cube]


def arenstorf(t, x, y, u, v):
    mu = q("0.012277471")
    nu = 1 - mu
    a = ((x + mu) ** 2 + y * y) ** q("-3/2") * nu
    b = ((x - nu) ** 2 + y * y) ** q("-3/2") * mu
    return [u, v, x + v * 2 - (x + mu) * a - (x - nu) * b, y - u * 2 - y * a - y * b]


def brusselator(t, u, v):
    product = u * u * v
    return [1 + product - u * 4, u * 3 - product]


def rigid_body(t, a, b, c):
    return [b * c, -a * c, a * b * q("-0.51")]


def kloss(t, phi, omega):
    slip = 1 - omega / 157
    ratio = slip / q("0.2")
    return [omega, (60 / (ratio + 1 / ratio) - 2 - omega * omega * q("0.0004")) / q("0.1")]


def robertson(t, a, b, c):
    first, third = b * c * 10000 - a * q("0.04"), b * b * 30000000
    return [first, -first - third, third]


def hires(t, a, b, c, d, e, f, g, h):
    fast = f * h * 280
    return [
        q("0.0007") - a * q("1.71") + b * q("0.43") + c * q("8.32"),
        a * q("1.71") - b * q("8.75"),
        d * q("0.43") + e * q("0.035") - c * q("10.03"),
        b * q("8.32") + c * q("1.71") - d * q("1.12"),
        (f + g) * q("0.43") - e * q("1.745"),
        d * q("0.69") + e * q("1.71") - f * q("0.43") + g * q("0.69") - fast,
        fast - g * q("1.81"),
        g * q("1.81") - fast,
    ]


def prothero_robinson(t, y):
    sine, cosine = sin_cos(t)
    return [(y - cosine) * -1000 - sine]


def pleiades(t, *states):
    x, y, u, v = states[:7], states[7:14], states[14:21], states[21:]
    rates = [[None] * 7, [None] * 7]
    for i in range(7):
        for j in range(i):
            d = [x[i] - x[j], y[i] - y[j]]
            cube = (d[0] * d[0] + d[1] * d[1]) ** q("-3/2")
            for r, along in zip(rates, d):
                pull = along * cube
                for k, by in ((i, -(j + 1)), (j, i + 1)):
                    r[k] = pull * by if r[k] is None else r[k] + pull * by
    return [*u, *v, *rates[0], *rates[1]]


PLEIADES = "3 3 -1 -3 2 -2 2 3 -3 2 0 0 -4 4 0 0 0 0 0 1.75 -1.5 0 0 0 -1.25 1 0 0".split()

# Name of the study, its inputs, right-hand side, names and starts of the states, times, and whether it is short.
CASES = [
    ("pendulum-swing", "", pendulum, "theta omega", lambda: [q("3.14"), mpf(0)], ["1", "5", "10"], True),
    ("duffing-chirp", "", duffing, "x v", lambda: [mpf(0)] * 2, ["10", "30"], False),
    ("van-der-pol", "1", van_der_pol("1"), "x y", lambda: [mpf(2), mpf(0)], ["5", "20"], True),
    ("van-der-pol", "10", van_der_pol("10"), "x y", lambda: [mpf(2), mpf(0)], ["5", "20"], False),
    ("van-der-pol", "100", van_der_pol("100"), "x y", lambda: [mpf(2), mpf(0)], ["10", "100"], False),
    ("lorenz", "", lorenz, "x y z", lambda: [mpf(1)] * 3, ["1", "5", "10"], False),
    ("rossler", "", rossler, "x y z", lambda: [mpf(1), mpf(1), mpf(0)], ["10", "50"], False),
    ("double-pendulum", "", double_pendulum, "theta1 theta2 omega1 omega2",
     lambda: [mp.pi / 2, mp.pi / 2, mpf(0), mpf(0)], ["1", "5"], False),
    ("kepler-orbit", "", kepler, "x y u v", lambda: [q("0.1"), mpf(0), mpf(0), mp.sqrt(19)], ["3", "20"], False),
    ("arenstorf", "", arenstorf, "x y u v", lambda: [q("0.994"), mpf(0), mpf(0), q("-2.00158510637908252240537862224")],
     ["5", "17"], False),
    ("brusselator", "", brusselator, "u v", lambda: [q("1.5"), mpf(3)], ["5", "20"], True),
    ("rigid-body", "", rigid_body, "y1 y2 y3", lambda: [mpf(0), mpf(1), mpf(1)], ["5", "20"], True),
    ("kloss-run-up", "", kloss, "phi omega", lambda: [mpf(0)] * 2, ["0.5", "2"], True),
    ("prothero-robinson", "", prothero_robinson, "y", lambda: [mpf(2)], ["0.01", "10"], False),
    ("hires", "", hires, "y1 y2 y3 y4 y5 y6 y7 y8", lambda: [mpf(1)] + [mpf(0)] * 6 + [q("0.0057")],
     ["5", "321.8122"], False),
    ("robertson", "", robertson, "y1 y2 y3", lambda: [mpf(1), mpf(0), mpf(0)], ["0.4", "4", "40"], False),
    ("robertson", "", None, "y1 y2 y3", None, ["400"], False),
    ("pleiades", "", pleiades, " ".join(f"{a}{i}" for a in "xyuv" for i in range(1, 8)),
     lambda: [q(s) for s in PLEIADES], ["1", "3"], False),
]


def taylor(field, time, states, order):
    """Coefficients of all states about a time."""
    def rate(i):
        return lambda s, k: states[i] if k == 0 else rates[i][k - 1] / k

    t = Series(lambda s, k: time if k == 0 else mpf(1) if k == 1 else mpf(0))
    series = [Series(rate(i)) for i in range(len(states))]
    rates = [wrap(r) for r in field(t, *series)]
    return [s.upto(order) for s in series]


def integrated(field, start, times, digits, order):
    """States at times, each term of the series that is left out below 10^-digits of the largest state."""
    with mp.workdps(digits + 15):
        time, states, found = mpf(0), start(), []
        for end in map(q, times):
            while time < end:
                series = taylor(field, time, states, order)
                size = max(1, *(abs(s[0]) for s in series)) * mpf(10) ** -digits
                # The last terms; several, for some vanish where the start is symmetric.
                last_terms = range(order - 11, order + 1)
                growth = max((abs(s[k]) ** (mpf(1) / k) for s in series for k in last_terms if s[k]), default=mpf(0))
                step = min(end - time, size ** (mpf(1) / order) / growth * q("0.9") if growth else end)
                last = step == end - time
                states = [mp.polyval(s[::-1], step) for s in series]
                time = end if last else time + step
            found.append([+s for s in states])
        return found


def radau(stages):
    """Nodes and weights of the collocation method of Radau IIA, of order 2 stages - 1 and L-stable."""
    nodes = [mpf(1)]
    for k in range(1, stages):
        def value(x):
            """(P_s - P_(s-1))/(x - 1) on [-1, 1] by its zeros that are known already."""
            return (mp.legendre(stages, x) - mp.legendre(stages - 1, x)) / mp.fprod([x - 1, *(x - 2 * c + 1 for c in nodes[1:])])

        guess = mp.cos(2 * mp.pi * k / (2 * stages - 1))
        nodes.append((mp.findroot(value, (guess, guess * q("0.999") + q("0.0001"))) + 1) / 2)
    powers = mp.matrix(stages, stages)
    moments = mp.matrix(stages, stages)
    for i, c in enumerate(nodes):
        for k in range(stages):
            powers[i, k], moments[i, k] = c**k, c ** (k + 1) / (k + 1)
    weights = moments * mp.inverse(powers)
    return [[weights[i, j] for j in range(stages)] for i in range(stages)]


def solved(rows):
    """The solution of linear equations whose rows end with their right sides."""
    n = len(rows)
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(k + 1, n):
            if rows[i][k]:
                factor = rows[i][k] / rows[k][k]
                rows[i][k + 1 :] = [a - factor * b for a, b in zip(rows[i][k + 1 :], rows[k][k + 1 :])]
    x = [mpf(0)] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - mp.fdot(zip(rows[k][k + 1 : n], x[k + 1 :]))) / rows[k][k]
    return x


def stiff_robertson(times, digits, stages, growth):
    """Robertson's reaction by Radau IIA with Newton's method, y1 = 1 - y2 - y3, in steps that grow with the time."""
    with mp.workdps(digits + 15):
        weights = radau(stages)
        tolerance = mpf(10) ** -digits
        time, y, found = mpf(0), [mpf(0), mpf(0)], []
        step = q("1/20000")
        for end in map(q, times):
            while time < end:
                h = min(max(step, time * growth), end - time)
                stage = [list(y) for _ in range(stages)]
                for _ in range(30):
                    rates = [[(1 - b - c) * q("0.04") - 10000 * b * c - 30000000 * b * b, 30000000 * b * b] for b, c in stage]
                    system = []
                    for i in range(stages):
                        for state in range(2):
                            row = []
                            for j, (b, c) in enumerate(stage):
                                slopes = [(q("-0.04") - 10000 * c - 60000000 * b, q("-0.04") - 10000 * b), (60000000 * b, mpf(0))]
                                row += [(1 if i == j and state == k else 0) - h * weights[i][j] * slopes[state][k] for k in range(2)]
                            due = y[state] + h * mp.fdot(weights[i], [r[state] for r in rates])
                            system.append(row + [due - stage[i][state]])
                    moved = solved(system)
                    stage = [[b + moved[2 * i], c + moved[2 * i + 1]] for i, (b, c) in enumerate(stage)]
                    if max(map(abs, moved)) < tolerance * mpf(10) ** -6:
                        break
                else:
                    sys.exit(f"robertson: Newton's method does not end at {time}")
                time = end if h == end - time else time + h
                y = stage[0]
            found.append([1 - y[0] - y[1], *y])
        return found


def rows(case):
    name, inputs, field, names, start, times, _ = case
    digits = DIGITS if field else 20
    if field is None:
        first = stiff_robertson(times, 30, 11, q("1/5"))
        second = stiff_robertson(times, 34, 12, q("1/6"))
    else:
        first = integrated(field, start, times, 42, 36)
        second = integrated(field, start, times, 48, 42)
    with mp.workdps(60):
        for time, a, b in zip(times, first, second):
            for state, x, y in zip(names.split(), a, b):
                if abs(x - y) > abs(y) * mpf(10) ** -digits:
                    sys.exit(f"{name}, {state} at {time}: {x} and {y}")
                yield f"{name},{inputs},{time},{state},{mp.nstr(y, digits, strip_zeros=False)}"


HEADER = "problem,inputs,time,state,value"


def main():
    path = pathlib.Path(__file__).with_suffix(".csv")
    if sys.argv[1:] not in ([], ["--check"], ["--check", "--all"]):
        sys.exit(f"unknown arguments {sys.argv[1:]}: only --check and --check --all are known")
    if sys.argv[1:]:
        recorded = path.read_text().splitlines()
        found = [row for case in CASES if case[-1] or sys.argv[2:] for row in rows(case)]
        missing = [row for row in found if row not in recorded]
        if missing or recorded[0] != HEADER:
            sys.exit(f"{path.name} differs from what mpmath {mp.__version__} gives: {missing[:1]}")
        print(f"{path.name}: {len(found)} of {len(recorded) - 1} rows recomputed, as recorded")
        return
    lines = [HEADER]
    for case in CASES:
        lines.extend(rows(case))
        print(case[0], case[1], file=sys.stderr, flush=True)
    temporary = path.with_suffix(".tmp")
    temporary.write_text("\n".join(lines) + "\n")
    os.replace(temporary, path)


if __name__ == "__main__":
    main()
