"""Certified w(z): this crate beside python-flint (Arb), same points, same run.

    python3 benches/compare_flint.py

Builds and calls `examples/faddeeva_reference_timing.rs`. Both sides give balls whose components are
both accurate to the bits asked for. Arb's route is `exp(-z^2) erfc(-iz)` at a working precision that
is found by trial; two times are given for it:

    adaptive   the trial included (30 bits more, then as many as were missing), as in our figure
    told       the precision that suffices for the point known in advance: Arb's arithmetic alone

Best of several interleaved runs. Times in microseconds a value. Exits with 1
if the values disagree.
"""

import os
import random
import subprocess
import sys
import time

import flint
from flint import acb, arb, ctx

DIGITS = (30, 100, 1000, 10000)
POINTS = {30: 100, 100: 60, 1000: 8, 10000: 2}
ROUNDS = 5


def point_sets(count):
    rng = random.Random(1)
    u = rng.uniform
    makers = {
        "square |Re|<8, 0<Im<8": lambda: (u(-8, 8), u(0, 8)),
        "below: |Re|<8, -6<Im<0": lambda: (u(-8, 8), u(-6, 0)),
        "small |z|<1": lambda: (u(-0.7, 0.7), u(-0.7, 0.7)),
        "beside the real axis": lambda: (u(-8, 8), 10 ** u(-30, -1)),
        "beside the imaginary axis": lambda: (10 ** u(-30, -1), u(-6, 8)),
        "middle |z|<57": lambda: (u(-40, 40), u(0, 40)),
        "far |z|<1e4": lambda: (u(-1e4, 1e4), u(0, 1e4)),
    }
    return {name: [make() for _ in range(count)] for name, make in makers.items()}


def told(x, y, bits):
    ctx.prec = bits
    z = acb(x, y)
    return (-z * z).exp() * (acb(0, -1) * z).erfc()


def adaptive(x, y, bits):
    precision = bits + 30
    while True:
        w = told(x, y, precision)
        have = min(w.real.rel_accuracy_bits(), w.imag.rel_accuracy_bits())
        if have >= bits:
            return w, precision
        precision = precision + bits - have + 10 if have > 0 else 2 * precision


def clock(f):
    start = time.perf_counter()
    f()
    return time.perf_counter() - start


def main():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    build = ["cargo", "build", "--release", "--example", "faddeeva_reference_timing"]
    subprocess.run(build, check=True, cwd=root)
    target = os.environ.get("CARGO_TARGET_DIR", os.path.join(root, "target"))
    binary = os.path.join(target, "release", "examples", "faddeeva_reference_timing")
    print(f"python-flint {flint.__version__}, FLINT {flint.__FLINT_VERSION__}; us a value")
    print(f"{'digits':>6}  {'points':28}{'ours':>10}{'adaptive':>10}{'told':>10}   told/ours")
    worst, wrong = float("inf"), 0
    for digits in DIGITS:
        bits = int(digits * 3.3219281) + 1
        sets = point_sets(POINTS[digits])
        lines = "\n".join(f"{n.replace(',', ';')},{x!r},{y!r}" for n, s in sets.items() for x, y in s)
        mine, theirs, known = {}, {}, {}
        precisions = {n: [adaptive(*p, bits)[1] for p in s] for n, s in sets.items()}
        for _ in range(ROUNDS):
            run = subprocess.run([binary, str(bits)], input=lines, check=True, capture_output=True, text=True)
            values = []
            for line in run.stdout.splitlines():
                if line.startswith("time "):
                    name, seconds = line[5:].rsplit(" ", 1)
                    name = name.replace(";", ",")
                    mine[name] = min(float(seconds), mine.get(name, 1.0))
                else:
                    values.append(line.split()[1:])
            for name, s in sets.items():
                a = clock(lambda: [adaptive(*p, bits) for p in s]) / len(s)
                b = clock(lambda: [told(*p, q) for p, q in zip(s, precisions[name])]) / len(s)
                theirs[name] = min(a, theirs.get(name, 1.0))
                known[name] = min(b, known.get(name, 1.0))
        flat = [(p, q) for n in sets for p, q in zip(sets[n], precisions[n])]
        for (p, q), texts in zip(flat, values, strict=True):
            w = told(*p, q)
            for part, text in zip((w.real, w.imag), texts):
                if not abs(arb(text) - part) < abs(part) * arb("1e-26"):
                    wrong += 1
                    print(f"disagreement at {p}: {text} and {part.str(30)}")
        for name in sets:
            ratio = known[name] / mine[name]
            worst = min(worst, ratio)
            print(f"{digits:6}  {name:28}{mine[name] * 1e6:10.2f}{theirs[name] * 1e6:10.2f}{known[name] * 1e6:10.2f}   {ratio:9.2f}")
    print(f"smallest ratio {worst:.2f}; {wrong} components disagree")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
