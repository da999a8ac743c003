#!/usr/bin/env python3
"""Certified digits of W(z) against balls of Arb (python-flint), at precisions from 30 to 300 digits.

    python3 reference/independent/containment.py --points 1e7 [--seed 1] [--processes 2] [--binary mechaudit]

The program certifies each component to be off by one unit of its last digit at most. Points are drawn block by block,
each block from its own seed and with its own number of digits; `mechaudit eval faddeeva --digits N` answers a block. At
each point Arb's W = exp(-z^2) erfc(-iz), at a precision that grows until it is decided, has to lie within that unit,
whole with its radius. Prints JSON: points, components, the worst distance in units by digits, and what does not hold; a
block that is done is not done again when the same command is given with `--state FILE` (a line for each block). Exits
with 1 if anything is outside or undecided.
"""

import argparse
import json
import math
import multiprocessing
import pathlib
import random
import subprocess
import sys
import time

from flint import acb, arb, ctx, fmpz

#: Points of a block.
BLOCK = 2000
#: Bits at which a component is given up as undecided.
MOST = 1 << 16


def log_uniform(u, low, high):
    return math.exp(u(math.log(low), math.log(high)))


def point(rng):
    """A point of one of these parts of the plane, in turn at random."""
    u = rng.uniform
    sign = rng.choice
    part = rng.randrange(8)
    if part == 0:
        return u(-8, 8), u(0, 8)
    if part == 1:
        return u(-8, 8), u(-6, 0)
    if part == 2:
        r, angle = log_uniform(u, 1e-30, 1), u(0, math.tau)
        return r * math.cos(angle), r * math.sin(angle)
    if part == 3:
        return u(-30, 30), sign((-1, 1)) * log_uniform(u, 1e-300, 0.3)
    if part == 4:
        return sign((-1, 1)) * log_uniform(u, 1e-300, 0.5), u(-27, 30)
    if part == 5:
        r, angle = log_uniform(u, 7, 1e8), u(0, math.pi)
        return r * math.cos(angle), abs(r * math.sin(angle))
    if part == 6:
        x = sign((-1, 1)) * log_uniform(u, 0.01, 30)
        return x, sign((-1, 1)) * abs(x) * (1 + sign((-1, 1)) * log_uniform(u, 1e-17, 1e-3))
    # Beside the zeros of W, near the rays below the axis: 2 y^2 - 2 x^2 nearly log.
    n = rng.randrange(1, 40)
    size = math.sqrt(math.pi * (n - 0.125))
    shift = math.log(2 * size * math.sqrt(2 * math.pi)) / (4 * size)
    off = log_uniform(u, 1e-12, 0.1)
    return size + shift + off * u(-1, 1), -size + shift + off * u(-1, 1)


def distance(text, exact):
    """How far the ball of a value may be from a decimal, in units of its last digit: a ball."""
    mantissa, _, exponent = text.lower().partition("e")
    digits = mantissa.lstrip("-").replace(".", "")
    places = len(mantissa.partition(".")[2])
    number = fmpz(int(digits)) * (-1 if mantissa.startswith("-") else 1)
    scale = places - int(exponent or 0)
    return abs(exact * arb(10) ** scale - arb(number))


def arb_w(x, y, bits):
    ctx.prec = bits
    z = acb(arb(x), arb(y))
    return (-z * z).exp() * (acb(0, -1) * z).erfc()


def judged(x, y, texts, digits):
    """For each component its distance in units, or why there is none."""
    bits = int(digits * 3.33) + 60
    while True:
        w = arb_w(x, y, bits)
        found = []
        for text, value in zip(texts, (w.real, w.imag), strict=True):
            if float(text) == 0 and not any(c in text for c in "123456789"):
                # A component that is zero by symmetry: exactly zero there, on an axis alone.
                found.append(0.0 if 0 in value and x == 0 else "zero where none is due")
                continue
            d = distance(text, value)
            if d <= 1:
                found.append(float(d.abs_upper()))
            elif d > 1:
                found.append(f"outside by {d}")
            else:
                break
        if len(found) == 2:
            return found
        # As many bits more as the component has lost; most of them are known after one trial.
        have = min(w.real.rel_accuracy_bits(), w.imag.rel_accuracy_bits())
        bits = 2 * bits if have <= 0 else bits + max(int(digits * 3.33) + 40 - have, 64)
        if bits > MOST:
            return ["undecided", "undecided"]


def block(job):
    seed, number, size, binary = job
    rng = random.Random(f"{seed}/{number}")
    digits = round(math.exp(rng.uniform(math.log(30), math.log(300))))
    points = [point(rng) for _ in range(size)]
    lines = "".join(f"{x.hex()},{y.hex()}\n" for x, y in points)
    command = [binary, "eval", "faddeeva", "--digits", str(digits), "--threads", "1"]
    answers = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout.splitlines()
    if len(answers) != size:
        raise ValueError(f"{len(answers)} answers to {size} points")
    worst, wrong = 0.0, []
    for (x, y), answer in zip(points, answers, strict=True):
        for name, found in zip(("Re", "Im"), judged(x, y, answer.split(","), digits), strict=True):
            if isinstance(found, str):
                wrong.append([digits, x.hex(), y.hex(), name, found])
            else:
                worst = max(worst, found)
    return {"block": number, "points": size, "digits": digits, "worst": worst, "wrong": wrong}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=lambda t: int(float(t)), default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--binary", default="mechaudit")
    parser.add_argument("--state", type=pathlib.Path)
    args = parser.parse_args()
    sizes = [min(BLOCK, args.points - at) for at in range(0, args.points, BLOCK)]
    done = {}
    if args.state and args.state.exists():
        for line in args.state.read_text().splitlines():
            try:
                known = json.loads(line)
            except json.JSONDecodeError:
                # Half a line of a run that was killed.
                continue
            if known["seed"] == args.seed and sizes[known["block"] : known["block"] + 1] == [known["points"]]:
                done[known["block"]] = known
    jobs = [(args.seed, k, n, args.binary) for k, n in enumerate(sizes) if k not in done]
    started = time.monotonic()
    with multiprocessing.Pool(args.processes) as pool:
        for found in pool.imap_unordered(block, jobs):
            done[found["block"]] = found
            if args.state:
                with args.state.open("a") as out:
                    out.write(json.dumps({"seed": args.seed, **found}) + "\n")
    seconds = time.monotonic() - started
    bands = {}
    for found in done.values():
        band = bands.setdefault(min(found["digits"] // 50 * 50, 250), [0, 0.0])
        band[0] += found["points"]
        band[1] = max(band[1], found["worst"])
    wrong = [w for found in done.values() for w in found["wrong"]]
    summary = {
        "points": sum(found["points"] for found in done.values()),
        "components": 2 * sum(found["points"] for found in done.values()),
        "seed": args.seed,
        "digits": {f"{low or 30} to {low + 49 + (low == 250)}": {"points": n, "worst_units": w} for low, (n, w) in sorted(bands.items())},
        "not_contained": len(wrong),
        "first": wrong[:20],
    }
    print(json.dumps(summary, indent=2))
    here = sum(n for _, _, n, _ in jobs)
    print(f"{here} points in {seconds:.1f} s on {args.processes} processes", file=sys.stderr)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
