"""Tridiagonal systems beside LAPACK's ``dgtsv``: its time over ours, interleaved in one run.

``python3 benches/compare_lapack.py PREFIX`` after ``capi/install PREFIX``; needs numpy, scipy, and for the
last columns the Python package. ``dgtsv`` is scipy's, called as it is meant to be: it pivots and overwrites copies,
which are made outside of its time. Ours eliminates without pivoting and writes to an array of its own. A cyclic system
is beside ``dgtsv`` with two right-hand sides, the second one for the correction by a matrix of rank one; a batch of
systems of 64 rows beside as many calls of ``dgtsv``.
"""

import ctypes
import sys
import time

import numpy as np
from scipy.linalg.lapack import dgtsv

try:
    from mechaudit import solve_cyclic, solve_tridiagonal
except ImportError:
    solve_cyclic = solve_tridiagonal = None

LIBRARY = ctypes.CDLL(f"{sys.argv[1]}/lib/libmechaudit.so")
POINTER = ctypes.POINTER(ctypes.c_double)


def least_ratio(ours, theirs, seconds):
    """Their least time by ours over interleaved passes, and ours."""
    passes = []
    end = time.perf_counter() + seconds
    while time.perf_counter() < end or len(passes) < 9:
        passes.append((ours(), theirs()))
    own, other = np.min(passes, axis=0)
    return other / own, own


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
    cells = ["C, no estimate", "C, with it", "C, cyclic", "cyclic, with it", "C, batch of 64 rows"]
    cells += ["Python, one", "Python, cyclic", "Python, 8 right-hand sides", "ours, C, ns a row"]
    print("| n | " + " | ".join(cells) + " |")
    print("|---" * (len(cells) + 1) + "|")
    for n in (1024, 10_240, 1_024_000):
        loops = max(1, 200_000 // n)
        lower, upper = rng.uniform(-1, 1, (2, n))
        diagonal = 2 + rng.uniform(0, 1, n)
        d, x, estimate = rng.uniform(-1, 1, n), np.empty(n), ctypes.c_double()
        many = np.asfortranarray(rng.uniform(-1, 1, (n, 8)))
        size = ctypes.c_size_t

        def at(*arrays):
            return [v.ctypes.data_as(POINTER) for v in arrays]

        def ours(function, bands, with_estimate):
            wanted = ctypes.byref(estimate) if with_estimate else None
            call, arguments = getattr(LIBRARY, function), [size(n), *at(*bands, d, x), wanted, None]
            return lambda: call(*arguments) and exit(1)

        def theirs(*bands):
            assert dgtsv(*bands, 1, 1, 1, 1)[-1] == 0

        def copies(d):
            return lambda: (lower[1:].copy(), diagonal.copy(), upper[:-1].copy(), d.copy(order="F"))

        def small(lower, diagonal, upper, d):
            for k in range(0, n, 64):
                theirs(lower[k + 1 : k + 64], diagonal[k : k + 64], upper[k : k + 63], d[k : k + 64])

        systems = [size(n // 64), size(64), *at(lower, diagonal, upper, d, x), None]

        def batch():
            assert LIBRARY.mechaudit_tridiagonal_solve_batch(*systems) == 0

        one = (lower[1:].copy(), diagonal, upper[:-1].copy())
        cyclic = (lower, diagonal, upper)
        peer = timed(theirs, loops, copies(d))
        two = timed(theirs, loops, copies(many[:, :2]))
        eight = timed(theirs, loops, copies(many))
        tridiagonal, closed = "mechaudit_tridiagonal_solve", "mechaudit_cyclic_tridiagonal_solve"
        pairs = [
            (ours(tridiagonal, one, False), peer),
            (ours(tridiagonal, one, True), peer),
            (ours(closed, cyclic, False), two),
            (ours(closed, cyclic, True), two),
            (batch, timed(small, max(1, loops // 8), lambda: tuple(v.copy() for v in (lower, diagonal, upper, d)))),
        ]
        if solve_tridiagonal:
            pairs += [
                (lambda: solve_tridiagonal(*one, d), peer),
                (lambda: solve_cyclic(*cyclic, d), two),
                (lambda: solve_tridiagonal(*one, many), eight),
            ]
        found = [least_ratio(timed(own, loops), other, 2) for own, other in pairs]
        pairs[0][0]()
        np.testing.assert_allclose(x, dgtsv(*copies(d)())[3], rtol=1e-10, atol=1e-13)
        ratios = [f"{ratio:.2f}" for ratio, _ in found] + [""] * (8 - len(found))
        print(f"| {n} | " + " | ".join(ratios) + f" | {1e9 * found[0][1] / n:.1f} |", flush=True)


if __name__ == "__main__":
    main()
