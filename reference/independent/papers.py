#!/usr/bin/env python3
"""Verdicts of `mechaudit paper` on symbols with domains against mpmath, over random requirements.

    python3 reference/independent/papers.py [--count 400] [--seed 1] [--binary mechaudit]

Writes a paper of random entries whose symbols are positive, real, an integer, or between two numbers, and decides it in one
run. mpmath evaluates each requirement in 50 digits at random points of the domains, their ends and zero among them. What
must not be:

* a requirement proved that fails at a point where both sides are defined;
* a requirement refuted at a point outside of the domains, or at which it holds.

Prints a table of verdicts and what must not be; exits with 1 if there is any.
"""

import argparse
import collections
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

import mpmath as mp

mp.mp.dps = 50
#: Symbols with their domains as the file states them, and as two ends.
SYMBOLS = {
    "p": ('"positive"', (0, None)),
    "x": ('"real"', (None, None)),
    "n": ('"integer"', (1, None)),
    "u": ("[0, 1]", (0, 1)),
    "v": ("[-2, -1]", (-2, -1)),
    "w": ("[-1, 3]", (-1, 3)),
}
FUNCTIONS = {"sin": mp.sin, "cos": mp.cos, "exp": mp.exp, "sqrt": mp.sqrt, "abs": abs, "pi": mp.pi}


def term(rng, names, depth):
    """A random expression in some symbols."""
    if depth == 0 or rng.random() < 0.2:
        return rng.choice(names) if rng.random() < 0.75 else str(rng.randint(1, 4))
    a, b = (term(rng, names, depth - 1) for _ in "ab")
    forms = [f"({a} + {b})", f"({a} - {b})", f"{a}*{b}", f"({a})^2", f"(-({a}))"]
    return rng.choice(forms + ([f"sin({a})", f"cos({a})"] if depth == 1 else []))


def requirement(rng):
    """A requirement that may hold everywhere, on a part of the line, or nowhere."""
    names = rng.sample(sorted(SYMBOLS), rng.randint(1, 2))
    a, b = (term(rng, names, rng.randint(1, 2)) for _ in "ab")
    x = rng.choice(names)
    bounded = [s for s in names if s in "uvw"]
    forms = [
        f"sqrt(({a})^2) = {a}", f"sqrt(({a})^2) = -({a})", f"sqrt({x}^2) = {x}", f"sqrt({x}^2) = (-{x})",
        f"abs({x}) = {x}", f"abs({x}) = -{x}", f"({a} + {b})^2 = ({a})^2 + 2*({a})*({b}) + ({b})^2",
        f"({a} + {b})^2 = ({a})^2 + ({a})*({b}) + ({b})^2", f"sin(2*({a})) = 2*sin({a})*cos({a})",
        f"sin(-({a})) = sin({a})", f"cos(pi*{x})^2 = 1", f"sqrt({x}^4) = {x}^2", f"{x}*abs({x}) = {x}^2",
        f"{a} = {b}", f"({a})/{x} = ({a})*{x}/{x}^2",
    ]
    if bounded and len(names) == len(bounded):
        margin = rng.choice(["0", "1/100", "1", "9", "40"])
        forms += [f"{a} < {b} + {margin}", f"({a})^2 ~ {b} within {rng.choice(['1/2', '3', '40'])}"] * 4
    return names, rng.choice(forms)


def python(text):
    """The expression in Python."""
    return re.sub(r"\b(\d+)\b", r"mp.mpf(\1)", text.replace("^", "**"))


def holds(text, point):
    """Whether it holds at a point; none where a side is undefined or the difference is too small to tell."""
    value = lambda part: eval(python(part), {**FUNCTIONS, "mp": mp}, dict(point))
    try:
        if " ~ " in text:
            left, rest = text.split(" ~ ")
            right, bound = rest.split(" within ")
            slack = value(bound) - abs(value(left) - value(right))
            return None if abs(slack) < mp.mpf("1e-30") else slack > 0
        if " < " in text:
            left, right = text.split(" < ")
            slack = value(right) - value(left)
            return None if abs(slack) < mp.mpf("1e-30") else slack > 0
        left, right = map(value, text.split(" = "))
        return abs(left - right) <= mp.mpf("1e-30") * (1 + abs(left) + abs(right))
    except ZeroDivisionError:
        return None


def points(rng, names):
    """Points of the domains."""
    for k in range(24):
        point = {}
        for name in names:
            low, high = SYMBOLS[name][1]
            if name == "n":
                value = Fraction(rng.randint(1, 9))
            elif low is not None and high is not None:
                value = low + (high - low) * Fraction(rng.randint(0, 64), 64)
            else:
                value = Fraction(rng.randint(1, 400), rng.choice([1, 7, 100]))
                value = value if low == 0 else value * rng.choice([-1, 0, 1])
            point[name] = mp.mpf(value.numerator) / value.denominator
        yield point


def inside(name, value):
    """Whether a value lies in the domain of a symbol."""
    low, high = SYMBOLS[name][1]
    whole = name != "n" or value.denominator == 1
    strict = name != "p" or value > 0
    return whole and strict and (low is None or value >= low) and (high is None or value <= high)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--binary", default="mechaudit")
    args = parser.parse_args()
    rng = random.Random(args.seed)
    entries = [requirement(rng) for _ in range(args.count)]
    lines = ['title = "Random requirements"', "[symbols]"]
    lines += [f'{name} = {{ means = "a symbol", domain = {text} }}' for name, (text, _) in SYMBOLS.items()]
    for k, (_, text) in enumerate(entries):
        lines += ["[[entry]]", f'id = "e{k}"', 'place = "-"', f'requires = "{text}"']
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "paper.toml"
        file.write_text("\n".join(lines) + "\n")
        command = [args.binary, "paper", str(file), "--ledger", "--format", "json"]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(run.stderr)
    counts, wrong = collections.Counter(), []
    for (names, text), entry in zip(entries, json.loads(run.stdout)["entries"], strict=True):
        verdict = entry["verdict"]
        seen = [holds(text, point) for point in points(rng, names)]
        truth = "false" if False in seen else "not seen to fail"
        counts[verdict, truth] += 1
        if verdict == "proved" and False in seen:
            wrong.append(f"proved, but false: {text}")
        if verdict == "refuted":
            point = {n: Fraction(v) for n, v in (entry["obligations"][0]["witness"] or {"point": []})["point"]}
            if not all(inside(n, v) for n, v in point.items()):
                wrong.append(f"refuted outside of the domain: {text} at {point}")
            exact = {n: mp.mpf(v.numerator) / v.denominator for n, v in point.items()}
            if set(names) <= set(exact) and holds(text, exact) is not False:
                wrong.append(f"refuted where it holds: {text} at {point}")
    for (verdict, truth), n in sorted(counts.items()):
        print(f"{n:6} {verdict}, {truth}")
    print("\n".join(wrong) if wrong else "nothing is wrong")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
