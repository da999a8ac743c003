#!/usr/bin/env python3
"""Holds proved rounding-error bounds of random formulas against errors in exact arithmetic.

    python3 reference/independent/random_proofs.py --binary target/release/mechaudit [--formulas 40] [--seed 1]

Formulas of + - * / fma, fmin, fmax, fdim, fabs, squares and `if`, in binary64 and binary32, over ranges of usual and
of subnormal numbers. The body is carried out here in fractions, each operation rounded to the nearest number of the
format by integers alone, at random inputs, at ends of the ranges and next to powers of two. Exit 1 if an error is
larger than the bound of the absolute or relative error or of the ulps.
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile
from fractions import Fraction

# Bits of the significand, exponent of the smallest number.
FORMATS = {"binary64": (53, -1074), "binary32": (24, -149)}


def unit(q, form):
    """The unit in the last place of a number."""
    bits, least = FORMATS[form]
    if q == 0:
        return Fraction(2) ** least
    n, d = abs(q.numerator), q.denominator
    e = n.bit_length() - d.bit_length()
    e -= Fraction(2) ** e > abs(q)
    return Fraction(2) ** max(e + 1 - bits, least)


def nearest(q, form):
    u = unit(q, form)
    return round(q / u) * u  # Halves to even.


BINARY = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "fmin": min,
    "fmax": max,
    "fdim": lambda a, b: max(a - b, Fraction(0)),
}
COMPARED = {"<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b}


def formula(draw, depth):
    """A text, and the function from inputs and a rounding to a value."""
    if depth == 0 or draw.random() < 0.1:
        name = draw.choice(["x", "y", "x", "y", "1", "2", "3", "0.5", "0.1", "7", "1e-3", "1e8", "1e-40"])
        if name in "xy":
            return name, lambda at, _: at[name]
        return name, lambda _, rounded: rounded(Fraction(name))
    parts = [formula(draw, depth - 1) for _ in range(4)]
    (a, f), (b, g), (c, h), (d, k) = parts
    kind = draw.random()
    if kind < 0.65:
        op = draw.choice("++--**/")
        of = BINARY[op]
        return f"(({a}) {op} ({b}))", lambda at, r: r(of(f(at, r), g(at, r)))
    if kind < 0.75:
        name = draw.choice(["fmin", "fmax", "fdim"])
        of = BINARY[name]
        return f"{name}({a}, {b})", lambda at, r: r(of(f(at, r), g(at, r)))
    if kind < 0.82:
        return f"fma({a}, {b}, {c})", lambda at, r: r(f(at, r) * g(at, r) + h(at, r))
    if kind < 0.88:
        return f"fabs({a})", lambda at, r: abs(f(at, r))
    if kind < 0.93:
        return f"({a})^2", lambda at, r: r(f(at, r) ** 2)
    op = draw.choice(list(COMPARED))
    holds = COMPARED[op]
    return f"if(({a}) {op} ({b}), {c}, {d})", lambda at, r: h(at, r) if holds(f(at, r), g(at, r)) else k(at, r)


RANGES = [
    (1, 2), (0, 1), (-1, 1), (-2, 5), (1, 1000), ("0.5", "0.501"), (3, 3), (0, "1e-38"), ("1e-310", "1e-305"), (-8, -1),
]


def inputs(draw, ends, form):
    low, high = (Fraction(end) for end in ends)
    near = draw.choice([low, high, Fraction(1), Fraction(2), Fraction(1, 2), Fraction(0), Fraction(4)])
    x = low + (high - low) * Fraction(draw.random()) if draw.random() < 0.5 else near
    x = nearest(x, form)
    x += draw.choice([0, 0, 1, -1, 2]) * unit(x, form)
    inside = [nearest(low, form), nearest(high, form)]
    inside = [inside[0] + (inside[0] < low) * unit(low, form), inside[1] - (inside[1] > high) * unit(high, form)]
    return nearest(min(max(x, inside[0]), inside[1]), form)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=pathlib.Path, required=True)
    parser.add_argument("--formulas", type=int, default=40)
    parser.add_argument("--points", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    draw = random.Random(args.seed)
    bounded = compared = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "formula.toml"
        for number in range(args.formulas):
            form = draw.choice(list(FORMATS))
            text, of = formula(draw, draw.randint(1, 4))
            ends = {name: draw.choice(RANGES) for name in "xy"}
            rows = [f'{name} = {{ from = "{a}", to = "{b}" }}' for name, (a, b) in ends.items()]
            solver = f'[solver.s]\nformat = "{form}"\no = "{text}"'
            study.write_text("[inputs]\n" + "\n".join(rows) + f'\n[outputs]\no = "{text}"\n{solver}\n')
            line = [args.binary, "prove", study, "--format", "json", "--limit", "200", "--evals", "40"]
            found = subprocess.run(line, capture_output=True, text=True, timeout=600)
            if found.returncode == 2:
                # A range without a number of the format, nothing else.
                if not any(said in found.stderr for said in ("holds no binary", "no number of the format")):
                    sys.exit(f"{study.read_text()}{found.stderr}")
                continue
            found = json.loads(found.stdout)
            bounds = {key: found[key] for key in ("absolute_error", "relative_error", "ulps")}
            bounded += any(bound is not None for bound in bounds.values())
            for _ in range(args.points):
                at = {name: inputs(draw, ends[name], form) for name in "xy"}
                try:
                    due, got = of(at, lambda q: q), of(at, lambda q: nearest(q, form))
                except ZeroDivisionError:
                    continue
                off = abs(got - due)
                errors = {"absolute_error": off, "ulps": off / unit(due, form)}
                errors["relative_error"] = off / abs(due) if due else Fraction(off > 0)
                compared += 1
                for key, error in errors.items():
                    if bounds[key] is not None and error > Fraction(bounds[key]):
                        wrong += 1
                        print(f"{key} {float(error)} above {bounds[key]} at {at}\n{study.read_text()}")
    print(f"{args.formulas} formulas, {bounded} with bounds, {compared} points, {wrong} errors above their bounds")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
