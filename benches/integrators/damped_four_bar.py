"""The damped four-bar of examples/motion/four-bar-damped.toml by scipy: 10^4 output rows at a tolerance of 1e-12.

Usage: python damped_four_bar.py [PROGRAM], PROGRAM being `mechaudit` built with optimisation. Runs both in turn and prints
the seconds of processor time of each, user and system, and their ratio, least and median, and the largest difference of the
crank's angle. The equations of motion are those with multipliers in the three angles, in plain Python, solved by numpy at
each evaluation; the program's time is that of its whole process, from its start to its last row of CSV.
"""

import csv
import io
import pathlib
import resource
import subprocess
import sys
import time
from math import cos, pi, sin
from statistics import median

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

FILE = pathlib.Path(__file__).resolve().parents[2] / "examples/motion/four-bar-damped.toml"

G, END, ROWS = 9.81, 5.0, 10_000
RUNS = 7
L1, L2, L3, L0 = 0.1, 0.4, 0.3, 0.35
M1, M2, M3 = 1.0, 2.0, 1.5
J1, J2, J3 = 0.002, 0.03, 0.012
DAMPING = 0.05


def accelerations(q, w):
    a, b, c = q
    ca, sa, cb, sb, cc, sc = cos(a), sin(a), cos(b), sin(b), cos(c), sin(c)
    # The coupler's centre at (0.2, 0.01) of its frame.
    ux, uy = 0.2 * cb - 0.01 * sb, 0.2 * sb + 0.01 * cb
    k = np.zeros((5, 5))
    k[0, 0] = J1 + M1 * 0.05**2 + M2 * L1**2
    k[0, 1] = k[1, 0] = M2 * L1 * (ca * ux + sa * uy)
    k[1, 1] = J2 + M2 * (0.2**2 + 0.01**2)
    k[2, 2] = J3 + M3 * 0.15**2
    g = np.array([[-L1 * sa, -L2 * sb, L3 * sc], [L1 * ca, L2 * cb, -L3 * cc]])
    k[3:, :3] = g
    k[:3, 3:] = g.T
    s = sa * ux - ca * uy
    f = np.empty(5)
    f[0] = -G * (M1 * 0.05 * ca + M2 * L1 * ca) - M2 * L1 * s * w[1] ** 2
    f[1] = -G * M2 * ux + M2 * L1 * s * w[0] ** 2
    f[2] = -G * M3 * 0.15 * cc - DAMPING * w[2]
    f[3] = L1 * ca * w[0] ** 2 + L2 * cb * w[1] ** 2 - L3 * cc * w[2] ** 2
    f[4] = L1 * sa * w[0] ** 2 + L2 * sb * w[1] ** 2 - L3 * sc * w[2] ** 2
    return np.linalg.solve(k, f)[:3]


def start():
    a, wa = pi / 3, 3.0
    x, y = L1 * cos(a), L1 * sin(a)

    def closed(v):
        b, c = v
        return [x + L2 * cos(b) - L0 - L3 * cos(c), y + L2 * sin(b) - L3 * sin(c)]

    b, c = fsolve(closed, [0.6, 100 * pi / 180], xtol=1e-15)
    matrix = [[-L2 * sin(b), L3 * sin(c)], [L2 * cos(b), -L3 * cos(c)]]
    wb, wc = np.linalg.solve(matrix, [L1 * sin(a) * wa, -L1 * cos(a) * wa])
    return np.array([a, b, c, wa, wb, wc])


def solved(times):
    """The motion by scipy, and its processor time: other work on the machine does not count."""
    begun = time.process_time()
    motion = solve_ivp(
        lambda t, y: np.concatenate([y[3:], accelerations(y[:3], y[3:])]),
        (0, END),
        start(),
        method="DOP853",
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
    )
    return motion, time.process_time() - begun


def written(program):
    """The rows of the program, and its processor time."""
    command = [program, "motion", FILE, "--times", f"0:{END}:{END / ROWS}", "--format", "csv"]
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, ended.ru_utime + ended.ru_stime - begun.ru_utime - begun.ru_stime


def shown(seconds):
    return f"{min(seconds):.4f} s (median {median(seconds):.4f})"


def main():
    times = np.linspace(0, END, ROWS + 1)
    scipy, own = [], []
    for _ in range(RUNS):
        motion, seconds = solved(times)
        scipy.append(seconds)
        # Short as they are, several for each.
        for _ in range(4 if sys.argv[1:] else 0):
            text, seconds = written(sys.argv[1])
            own.append(seconds)
    print(f"scipy solve_ivp DOP853: {shown(scipy)}, {motion.nfev} evaluations")
    if not own:
        return
    rows = list(csv.DictReader(io.StringIO(text)))
    crank = np.array([float(r["theta_crank"]) for r in rows])
    print(f"mechaudit motion, whole process with {len(rows)} rows of CSV: {shown(own)}")
    print(f"ratio of the least 1/{min(scipy) / min(own):.1f}, of the medians 1/{median(scipy) / median(own):.1f}")
    print(f"largest difference of the crank's angle: {np.abs(crank - motion.y[0]).max():.1e} rad")


if __name__ == "__main__":
    main()
