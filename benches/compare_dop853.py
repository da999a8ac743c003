#!/usr/bin/env python3
"""Times the chirp-forced oscillator against scipy's DOP853, both on one core, in interleaved runs.

A hundred turns of the shaft from rest (eps = 4 rad/s^2), 20 harmonics of amplitude 1/k^2 and phase 0.3 k,
w = 200 rad/s, n = 4 rad/s, displacements at 10^4 times. scipy: solve_ivp with DOP853, rtol 1e-10,
atol 1e-12, the sum over harmonics as one numpy expression.

Needs numpy and scipy. Run from the repository: python3 benches/compare_dop853.py
"""
import os
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
import numpy as np
import scipy
from scipy.integrate import solve_ivp

W, N, EPS, HARMONICS, TIMES = 200.0, 4.0, 4.0, 20, 10_000
ROUNDS = 3


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    build = ["cargo", "build", "--release", "--no-default-features", "--example", "chirp_timing"]
    subprocess.run(build, check=True, cwd=root)
    target = os.environ.get("CARGO_TARGET_DIR", os.path.join(root, "target"))
    binary = os.path.join(target, "release", "examples", "chirp_timing")

    k = np.arange(1.0, HARMONICS + 1)
    amplitude, phase = W * W / (k * k), 0.3 * k
    end = np.sqrt(400.0 * np.pi / EPS)
    at = np.linspace(0.0, end, TIMES)

    def motion(t, u):
        force = amplitude @ np.cos(k * (0.5 * EPS * t * t) + phase)
        return u[1], force - 2.0 * N * u[1] - W * W * u[0]

    mine, theirs = np.inf, np.inf
    with tempfile.TemporaryDirectory() as directory:
        path = f"{directory}/out"
        for _ in range(ROUNDS):
            out = subprocess.run([binary, path], check=True, capture_output=True, text=True).stdout
            mine = min(mine, float(out))
            start = time.perf_counter()
            found = solve_ivp(motion, (0.0, end), (0.0, 0.0), "DOP853", at, rtol=1e-10, atol=1e-12)
            theirs = min(theirs, time.perf_counter() - start)
        ours = np.fromfile(path, dtype="<f8")
    difference = np.max(np.abs(ours - found.y[0])) / np.max(np.abs(found.y[0]))
    print(f"scipy {scipy.__version__}, numpy {np.__version__}; {found.nfev} evaluations of DOP853")
    print(f"largest difference: {difference:.1e} of the largest displacement")
    print(f"scipy {theirs:.4f} s, ours {mine:.6f} s: {theirs / mine:.0f} x")
    return 0 if difference < 1e-7 else 1


if __name__ == "__main__":
    sys.exit(main())
