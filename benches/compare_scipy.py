"""Natural cubic spline: this crate beside scipy.interpolate.CubicSpline, same data, same run.

    python3 benches/compare_scipy.py

Builds and calls `examples/spline_timing.rs`. Everything is single-threaded except the line that
says parallel. Times are the best of several runs; their runs are interleaved, so that a change of
clock rate or load meets both. Exits with 1 if the values disagree.

Where the result goes matters: memory that the system hands out during the call costs more than the
whole evaluation. So both sides are measured both ways, and like is divided by like:

    reused   written to a buffer that has been written before. For scipy this is its inner routine
             `PPoly._evaluate`, without the allocation that `spline(x)` does.
    fresh    `spline(x)` as everybody calls it, which allocates; ours into a new `Vec`.

`floor` is the loop `out[i] = 2 x[i]` in the same program with the same memory: what reading the
points and writing the results costs at least. numpy asks the system for huge pages and `Vec` does
not, so that the fresh floors differ; on Linux with glibc, `GLIBC_TUNABLES=glibc.malloc.hugetlb=1`
makes `Vec` ask too, and those lines are repeated with it. Whether it gets them varied from process
to process when this was written; `floor_huge_pages_fresh` tells.
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


def ours(directory, binary, **environment):
    out = subprocess.run(
        [binary, str(KNOTS), str(POINTS), f"{directory}/in", f"{directory}/out"],
        check=True,
        capture_output=True,
        text=True,
        env=os.environ | environment,
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

    mine, theirs = {}, {}
    buffer = np.ones((POINTS, 1))
    with tempfile.TemporaryDirectory() as directory:
        np.concatenate([y, at]).astype("<f8").tofile(f"{directory}/in")
        for _ in range(ROUNDS):
            for name, seconds in ours(directory, binary).items():
                mine[name] = min(seconds, mine.get(name, np.inf))
            huge = ours(directory, binary, GLIBC_TUNABLES="glibc.malloc.hugetlb=1")
            for name, seconds in huge.items():
                if name.endswith("fresh"):
                    name = name.replace("_fresh", "_huge_pages_fresh")
                    mine[name] = min(seconds, mine.get(name, np.inf))
            spline = CubicSpline(x, y, bc_type="natural")
            for name, f in {
                "fit": lambda: CubicSpline(x, y, bc_type="natural"),
                "floor, reused": lambda: np.multiply(at, 2.0, out=buffer[:, 0]),
                "floor, fresh": lambda: np.multiply(at, 2.0),
                "values, reused": lambda: spline._evaluate(at, 0, True, buffer),
                "values, fresh": lambda: spline(at),
            }.items():
                seconds, result = best(f, SCIPY_RUNS)
                theirs[name] = min(seconds, theirs.get(name, np.inf))
        values = result
        got = np.fromfile(f"{directory}/out", dtype="<f8")

    difference = np.max(np.abs(got - values)) / np.max(np.abs(values))
    print(f"scipy {scipy.__version__}, numpy {np.__version__}; {KNOTS} knots, {POINTS} sorted points")
    print(f"largest difference of values: {difference:.2e} of the largest value")
    if not np.array_equal(buffer[:, 0], values):
        print("scipy's inner routine gives other values than its public one")
        return 1
    print(f"{'':34}{'seconds':>10}  scipy/ours")
    for name, seconds in theirs.items():
        print(f"{'scipy ' + name:34}{seconds:10.4f}")
    for name, seconds in mine.items():
        kind = name.split("_")[0]
        if kind != "fit":
            kind += ", fresh" if name.endswith("fresh") else ", reused"
        print(f"{name:34}{seconds:10.4f}  {theirs[kind] / seconds:8.1f}")
    return 0 if difference < 1e-14 else 1


if __name__ == "__main__":
    sys.exit(main())
