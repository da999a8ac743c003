#!/usr/bin/env python3
"""Independent values of the N four-bar mechanism, N = 1, 2, 10, 40, at t = 5, 10, 15 and 20 s, by mpmath alone.

Bars as the specification has them, N + 1 cranks and N rods of 1 m and 1 kg: kinetic and potential energy are summed over
the bars, each with its own centre and turning, on the parallelogram branch with theta from x. Lagrange's equation for theta
is integrated in time by extrapolation of the explicit midpoint rule after Gragg, Bulirsch and Stoer. Beside it stands the
closed solution by mpmath's Jacobian elliptic functions, which has to agree. The first time at which all bars lie on one line
is an incomplete elliptic integral of mpmath's.

Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/n_four_bar.py            # writes n_four_bar.csv beside it
    python3 reference/independent/n_four_bar.py --check    # compares instead, exit 1 if it differs

Columns: N, t (s), quantity, value; 20 digits. Rows without a time: period and first passage in s.
"""
import mpmath as mp

from check import run

mp.mp.dps = 34
DIGITS = 20
SIZES = [1, 2, 10, 40]
TIMES = [5, 10, 15, 20]
# Steps for a second, and columns of the extrapolation.
STEPS = 24
COLUMNS = 12

GRAVITY = mp.mpf("9.81")
I = mp.mpc(0, 1)


def bars(n, theta):
    """Centre by theta, its derivative, and how much the bar turns with theta."""
    crank, slope = mp.expj(theta), I * mp.expj(theta)
    cranks = [(k + crank / 2, slope / 2, 1) for k in range(n + 1)]
    rods = [(k + crank + mp.mpf(1) / 2, slope, 0) for k in range(n)]
    return cranks + rods


def inertia(n, theta):
    return mp.fsum(abs(slope)**2 + mp.mpf(turn) / 12 for _, slope, turn in bars(n, theta))


def pull(n, theta):
    """-dV/dtheta."""
    return -GRAVITY * mp.fsum(slope.imag for _, slope, _ in bars(n, theta))


class Motion:
    """theta'' = pull/inertia: the inertia of these bars is the same at every angle, looked at at three."""

    def __init__(self, n):
        values = [inertia(n, mp.mpf(t)) for t in ("0.3", "1.7", "4.1")]
        assert max(abs(v - values[0]) for v in values) < mp.mpf(10)**-30
        # The sum over the bars is the one at theta = 0 times the cosine.
        self.scale = pull(n, mp.mpf(0)) / values[0]
        assert abs(pull(n, mp.mpf(1)) / values[0] - self.scale * mp.cos(1)) < mp.mpf(10)**-30

    def midpoint(self, y, h, n):
        h = h / n
        slope = lambda y: (y[1], self.scale * mp.cos(y[0]))
        step = lambda a, b, k: tuple(x + k * s for x, s in zip(a, slope(b)))
        before, at = y, step(y, y, h)
        for _ in range(n - 1):
            before, at = at, step(before, at, 2 * h)
        return tuple((a + b + h * s) / 2 for a, b, s in zip(at, before, slope(at)))

    def extrapolated(self, y, h):
        table = []
        for k in range(COLUMNS):
            row = [self.midpoint(y, h, 2 * (k + 1))]
            for j in range(k):
                ratio = (mp.mpf(k + 1) / (k - j))**2 - 1
                row.append(tuple(a + (a - b) / ratio for a, b in zip(row[j], table[k - 1][j])))
            table.append(row)
        return table[-1][-1]


def closed(n, t):
    """x, y of B0 by elliptic functions: with psi = am(u), the angle from the bottom is 2 psi."""
    top, bottom = ends(n)
    m = 1 - top / bottom
    u = mp.sqrt(bottom) * (t - period(n) / 2) / 2
    sn, cn = (mp.ellipfun(f, u, m=m) for f in ("sn", "cn"))
    return -2 * sn * cn, 2 * sn**2 - 1


def ends(n):
    """Squares of the speed at the top and at the bottom, by the energies there."""
    height = lambda theta: mp.fsum(c.imag for c, _, _ in bars(n, theta))
    fall = 2 * GRAVITY * (height(mp.pi / 2) - height(-mp.pi / 2)) / inertia(n, mp.mpf(0))
    return mp.mpf(1), 1 + fall


def period(n):
    top, bottom = ends(n)
    return 4 * mp.ellipk(1 - top / bottom) / mp.sqrt(bottom)


def passage(n):
    """From the top to a quarter of a turn: half a period less what is left from there to the bottom."""
    top, bottom = ends(n)
    return period(n) / 2 - 2 * mp.ellipf(mp.pi / 4, 1 - top / bottom) / mp.sqrt(bottom)


def table():
    lines = ["N,t_s,quantity,value"]
    for n in SIZES:
        motion = Motion(n)
        y, now = (mp.pi / 2, mp.mpf(-1)), 0
        lines += [f"{n},,{name},{mp.nstr(v, DIGITS)}" for name, v in (("period", period(n)), ("passage", passage(n)))]
        for t in TIMES:
            for _ in range((t - now) * STEPS):
                y = motion.extrapolated(y, mp.mpf(1) / STEPS)
            now = t
            x, z = mp.cos(y[0]), mp.sin(y[0])
            other = closed(n, mp.mpf(t))
            assert max(abs(x - other[0]), abs(z - other[1])) < mp.mpf(10)**-22, (n, t)
            values = [("x", x), ("y", z), ("vx", -z * y[1]), ("vy", x * y[1])]
            lines += [f"{n},{t},{name},{mp.nstr(v, DIGITS)}" for name, v in values]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
