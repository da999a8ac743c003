"""Speed beside scipy, interleaved in one process: ratios, scipy's time divided by ours.

``python benches/beside_scipy.py [--quick]`` prints the table of the README. Arrays of up to 10 000 points are taken in
turn from several: a processor learns the branches of a function at the points of one small array that comes again.
"""

import argparse
import time

import numpy as np
import scipy
import scipy.special
from mechaudit import special

REGIONS = {
    "a": "|z| = 1e-8..1e8 logarithmic, Im z >= 0",
    "b": "|Re z|, |Im z| <= 8, Im z >= 0",
    "c": "|z| < 1",
    "d": "-6 <= Im z < 0, |Re z| <= 8",
    "e": "both diagonals, |z| = 0.01..1e4, relative damping 0..0.1",
    "f": "within 1e-12..0.1 of the first five zeros of w",
    "g": "Im z = 1e-300..0.1 logarithmic, Re z = 0..30",
}
ZEROS = np.array(
    [
        1.9914668428338796 - 1.3548101281120062j,
        2.6911490242514388 - 2.1770449060896159j,
        3.2353308684352816 - 2.7843876132230400j,
        3.6973097024862427 - 3.2874107918834750j,
        4.1061072847022670 - 3.7259487194572360j,
    ]
)


def points(region, n, rng):
    """Random points in random order."""
    angle = rng.uniform(0, np.pi, n)
    match region:
        case "a":
            return 10 ** rng.uniform(-8, 8, n) * np.exp(1j * angle)
        case "b":
            return rng.uniform(-8, 8, n) + 1j * rng.uniform(0, 8, n)
        case "c":
            return np.sqrt(rng.uniform(0, 1, n)) * np.exp(2j * angle)
        case "d":
            return rng.uniform(-8, 8, n) + 1j * rng.uniform(-6, 0, n)
        case "e":
            size = 10 ** rng.uniform(-2, 4, n)
            turn = np.where(rng.uniform(size=n) < 0.5, 0.25, -0.25) * np.pi
            return size * np.exp(1j * turn) * (1 + 1j * rng.uniform(0, 0.1, n))
        case "f":
            off = 10 ** rng.uniform(-12, -1, n)
            return ZEROS[rng.integers(0, 5, n)] + off * np.exp(2j * angle)
        case _:
            return rng.uniform(0, 30, n) + 1j * 10 ** rng.uniform(-300, -1, n)


def in_turn(n, draw):
    """Arguments for one call after another: the least number of draws, up to 100, that has 20 000 points."""
    return [draw(n) for _ in range(max(1, min(100, 20_000 // n)))]


def ratio(ours, theirs, calls, seconds):
    """The median over passes of their processor time by ours, each pass timing both, one after the other."""
    loops = 1
    while True:
        start = time.thread_time()
        for _ in range(loops):
            for arguments in calls:
                ours(*arguments)
        spent = time.thread_time() - start
        if spent > 2e-3:
            break
        loops *= 4
    found, own = [], []
    end = time.perf_counter() + seconds
    while time.perf_counter() < end or len(found) < 5:
        spent = []
        for f in (ours, theirs):
            start = time.thread_time()
            for _ in range(loops):
                for arguments in calls:
                    f(*arguments)
            spent.append(time.thread_time() - start)
        found.append(spent[1] / spent[0])
        own.append(spent[0] / (loops * len(calls)))
    return float(np.median(found)), float(np.median(own))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a tenth of the time")
    seconds = 0.2 if parser.parse_args().quick else 2.0
    rng = np.random.default_rng(1)
    print(f"scipy {scipy.__version__}, numpy {np.__version__}; scipy's time divided by ours\n")
    sizes = (1, 10, 100, 1000, 10_000, 1_000_000)
    heads = " | ".join(f"{n:,} point{'s' * (n > 1)}".replace(",", " ") for n in sizes)
    print(f"| `wofz` in region | {heads} |")
    print("|---|" + "---|" * len(sizes))
    for region, meaning in REGIONS.items():
        cells = []
        for n in sizes:
            calls = in_turn(n, lambda n: (points(region, n, rng),))
            out = np.empty_like(calls[0][0])
            found, _ = ratio(
                lambda z: special.wofz(z, out=out),
                lambda z: scipy.special.wofz(z, out=out),
                calls,
                seconds,
            )
            cells.append(f"{found:.1f}")
        print(f"| {region}: {meaning.replace('|', chr(92) + '|')} | " + " | ".join(cells) + " |", flush=True)
    print(f"\n| other functions | {heads} |")
    print("|---|" + "---|" * len(sizes))
    for name in ("erf", "erfc", "erfcx", "erfi", "dawsn"):
        for kind in ("real", "complex"):
            cells = []
            for n in sizes:
                calls = in_turn(n, lambda n: (points("b", n, rng),))
                if kind == "real":
                    calls = [(z.real.copy(),) for (z,) in calls]
                out = np.empty_like(calls[0][0])
                found, _ = ratio(
                    lambda z, f=getattr(special, name), out=out: f(z, out=out),
                    lambda z, f=getattr(scipy.special, name), out=out: f(z, out=out),
                    calls,
                    seconds,
                )
                cells.append(f"{found:.2f}")
            print(f"| `{name}`, {kind} | " + " | ".join(cells) + " |", flush=True)
    cells = []
    for n in sizes:
        found, _ = ratio(
            special.wofz_derivative,
            lambda z: 2j / np.sqrt(np.pi) - 2 * z * scipy.special.wofz(z),
            in_turn(n, lambda n: (points("b", n, rng),)),
            seconds,
        )
        cells.append(f"{found:.2f}")
    print("| `wofz_derivative` beside `2j/sqrt(pi) - 2*z*wofz(z)` | " + " | ".join(cells) + " |", flush=True)
    for what, widths in (
        ("one σ and γ", lambda n: (1.0, 0.2)),
        ("arrays of σ and γ", lambda n: (rng.uniform(0.5, 2, n), rng.uniform(0.1, 2, n))),
    ):
        cells = []
        for n in sizes:
            calls = in_turn(n, lambda n: (rng.uniform(-8, 8, n), *widths(n)))
            found, _ = ratio(special.voigt_profile, scipy.special.voigt_profile, calls, seconds)
            cells.append(f"{found:.2f}")
        print(f"| `voigt_profile`, {what} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
