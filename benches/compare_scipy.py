"""Natural cubic spline: this crate beside scipy.interpolate.CubicSpline, same data, same run.

    python3 benches/compare_scipy.py

Builds and calls `examples/spline_timing.rs`. Everything is single-threaded except the line that
says parallel. Times are the best of several runs; the two programs take turns, so that a change of
clock rate or load in between meets both. Exits with 1 if the values disagree.
"""

import os
import subprocess
import sys
import tempfile
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
import scipy
from scipy.interpolate import CubicSpline

KNOTS = 1_000_000
POINTS = 10_000_000
ROUNDS = 3
SCIPY_RUNS = 3


def best(f, runs):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        result = f()
        times.append(time.perf_counter() - start)
    return min(times), result


def ours(directory, binary):
    out = subprocess.run(
        [binary, str(KNOTS), str(POINTS), f"{directory}/in", f"{directory}/out"],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return {name: float(seconds) for name, seconds in (line.split() for line in out.splitlines())}


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    build = ["cargo", "build", "--release", "--example", "spline_timing"]
    subprocess.run(build, check=True, cwd=root)
    target = os.environ.get("CARGO_TARGET_DIR", os.path.join(root, "target"))
    binary = os.path.join(target, "release", "examples", "spline_timing")

    rng = np.random.default_rng(1)
    x = np.arange(KNOTS, dtype=float)
    y = np.sin(0.01 * x) + 0.1 * rng.standard_normal(KNOTS)
    at = np.sort(rng.uniform(0.0, KNOTS - 1.0, POINTS))

    mine, scipy_fit, scipy_values = {}, np.inf, np.inf
    with tempfile.TemporaryDirectory() as directory:
        np.concatenate([y, at]).astype("<f8").tofile(f"{directory}/in")
        for _ in range(ROUNDS):
            for name, seconds in ours(directory, binary).items():
                mine[name] = min(seconds, mine.get(name, np.inf))
            seconds, spline = best(lambda: CubicSpline(x, y, bc_type="natural"), SCIPY_RUNS)
            scipy_fit = min(scipy_fit, seconds)
            seconds, values = best(lambda: spline(at), SCIPY_RUNS)
            scipy_values = min(scipy_values, seconds)
        got = np.fromfile(f"{directory}/out", dtype="<f8")

    difference = np.max(np.abs(got - values)) / np.max(np.abs(values))
    print(f"scipy {scipy.__version__}, numpy {np.__version__}; {KNOTS} knots, {POINTS} sorted points")
    print(f"largest difference of values: {difference:.2e} of the largest value")
    print(f"{'':26}{'seconds':>10}  scipy/ours")
    print(f"{'scipy fit':26}{scipy_fit:10.4f}")
    for name in ("fit_uniform", "fit_any_knots"):
        print(f"{name:26}{mine[name]:10.4f}  {scipy_fit / mine[name]:8.1f}")
    print(f"{'scipy values':26}{scipy_values:10.4f}")
    for name in mine:
        if name.startswith(("values", "floor")):
            print(f"{name:26}{mine[name]:10.4f}  {scipy_values / mine[name]:8.1f}")
    return 0 if difference < 1e-14 else 1


if __name__ == "__main__":
    sys.exit(main())
