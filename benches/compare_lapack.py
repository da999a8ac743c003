"""Tridiagonal systems beside LAPACK's ``dgtsv``: its time over ours, interleaved in one run.

``python3 benches/compare_lapack.py PREFIX`` after ``capi/install PREFIX``; needs numpy, scipy, and for the
last columns the Python package. ``dgtsv`` is scipy's, called as it is meant to be: it pivots and overwrites copies,
which are made outside of its time. Ours eliminates without pivoting and writes to an array of its own.
"""

import ctypes
import sys
import time

import numpy as np
from scipy.linalg.lapack import dgtsv

try:
    from mechaudit import solve_tridiagonal
except ImportError:
    solve_tridiagonal = None

LIBRARY = ctypes.CDLL(f"{sys.argv[1]}/lib/libmechaudit.so")
POINTER = ctypes.POINTER(ctypes.c_double)


def median_ratio(ours, theirs, seconds):
    """The median over passes of their time by ours, and the least time of ours."""
    ratios, least = [], np.inf
    end = time.perf_counter() + seconds
    while time.perf_counter() < end or len(ratios) < 9:
        a, b = ours(), theirs()
        ratios.append(b / a)
        least = min(least, a)
    return float(np.median(ratios)), least


def timed(function, loops, prepare=lambda: ()):
    """A function that gives the seconds of one call."""

    def run():
        spent = 0.0
        for _ in range(loops):
            arguments = prepare()
            start = time.perf_counter()
            function(*arguments)
            spent += time.perf_counter() - start
        return spent / loops

    return run


def main():
    rng = np.random.default_rng(1)
    print("| n | C, no estimate | C, with it | Python, one | Python, 8 right-hand sides | ours, C, ns a row |")
    print("|---|---|---|---|---|---|")
    for n in (1000, 10_000, 1_000_000):
        loops = max(1, 200_000 // n)
        lower, upper = rng.uniform(-1, 1, (2, n - 1))
        diagonal = 2 + rng.uniform(0, 1, n)
        d, x, estimate = rng.uniform(-1, 1, n), np.empty(n), ctypes.c_double()
        at = [v.ctypes.data_as(POINTER) for v in (lower, diagonal, upper, d, x)]
        call = LIBRARY.mechaudit_tridiagonal_solve

        def ours(with_estimate):
            status = call(ctypes.c_size_t(n), *at, ctypes.byref(estimate) if with_estimate else None, None)
            assert status == 0

        def theirs(*bands):
            assert dgtsv(*bands, 1, 1, 1, 1)[-1] == 0

        def copies(d=d):
            return lower.copy(), diagonal.copy(), upper.copy(), d.copy(order="F")

        peer = timed(theirs, loops, copies)
        cells = []
        for with_estimate in (False, True):
            found, least = median_ratio(timed(lambda e=with_estimate: ours(e), loops), peer, 2)
            cells.append(f"{found:.2f}")
            if not with_estimate:
                own = least
        np.testing.assert_allclose(x, dgtsv(*copies())[3], rtol=1e-10, atol=1e-13)
        if solve_tridiagonal:
            many = np.asfortranarray(rng.uniform(-1, 1, (n, 8)))
            one = timed(lambda: solve_tridiagonal(lower, diagonal, upper, d).x, loops)
            cells.append(f"{median_ratio(one, peer, 2)[0]:.2f}")
            eight = timed(lambda: solve_tridiagonal(lower, diagonal, upper, many).x, loops)
            cells.append(f"{median_ratio(eight, timed(theirs, loops, lambda: copies(many)), 2)[0]:.2f}")
        else:
            cells += ["", ""]
        print(f"| {n} | " + " | ".join(cells) + f" | {1e9 * own / n:.1f} |", flush=True)


if __name__ == "__main__":
    main()
