#!/usr/bin/env python3
"""Verdicts of `mechaudit identity` against mpmath at random points, over random equations.

    python3 reference/independent/symbolic.py [--count 2000] [--seed 1] [--binary mechaudit]
        [--show undecided|false|kinds] [--equations FILE]

Half of the equations are true by construction, the others are meant to be false or divide by a hidden zero
(symbolic_equations.py). The program decides all of them in one run; mpmath evaluates both sides in 80 digits (50 where
there are integrals) at points with values of the symbols that differ by orders of magnitude (symbolic_values.py). What
must not be:

* an equation proved whose sides differ at a point where both are defined, or one that has no value at any point;
* an equation refuted that is true by construction;
* a refutation whose sides do not differ at the program's own point.

Sides differ when they do by more than 1e-20 of the larger one; the digits are tripled before anything is called wrong.
Prints a table by class and what must not be; exits with 1 if there is any. `--equations` takes texts `LEFT = RIGHT`, one
a line, in place of random ones.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import time
from fractions import Fraction

import mpmath as mp
import symbolic_equations as equations
from symbolic_values import Evaluation, Given, Point, Unclear, Undefined, read, text_of

#: Sides that differ by less, relative to the larger one, are equal.
APART = mp.mpf("1e-20")
#: Points tried: their kinds, in turn.
POINTS = ("middle", "wide", "whole", "near", "middle", "wide")
CALCULUS_POINTS = ("middle", "near", "whole", "middle")
#: Lines that the program may refuse to read before the run is given up.
REFUSALS = 200
#: Seconds that the program has for all, beside a twentieth for each equation, and for one alone.
SECONDS, ALONE = 60, 10
#: Lines without an answer among which the one is that takes too long.
TOGETHER = 64
NOT_READ = {"outcome": "undecided", "reason": "not read", "witness": None}
NO_ANSWER = {"outcome": "undecided", "reason": f"no answer within {ALONE} s", "witness": None}

OPEN = "open"

#: What the values tell of an equation.
Values = collections.namedtuple("Values", "compared differs undefined")


def definitions():
    names, derivations = {}, {}
    for text in equations.DEFINITIONS:
        left, right = text.split("=", 1)
        by, colon, symbol = left.partition(":")
        if colon:
            derivations.setdefault(by.strip(), []).append((symbol.strip(), read(right)))
        else:
            names[left.strip()] = read(right)
    return names, derivations


NAMES, DERIVATIONS = definitions()


def differ(left, right, point, factor=1, apart=APART):
    """Whether the sides differ at a point."""
    first, second = (Evaluation(NAMES, DERIVATIONS, point) for _ in range(2))
    a, b = first.value(left, factor), second.value(right, factor)
    if first.coarse or second.coarse:
        apart = max(apart, APART)
    return abs(a - b) > max(apart * max(abs(a), abs(b)), first.noise, second.noise)


def certainly(left, right, point):
    """The same with three times the digits, where that can be told."""
    try:
        return differ(left, right, point, 3)
    except (Undefined, Unclear, mp.libmp.NoConvergence, ValueError, OverflowError):
        return False


def evaluated(left, right, points, until):
    """Where the sides are compared, the first point at which they differ, and how often one is undefined."""
    compared = undefined = 0
    for point in points:
        try:
            found = differ(left, right, point)
        except Undefined:
            undefined += 1
            continue
        except (Unclear, mp.libmp.NoConvergence, ValueError, OverflowError):
            continue
        compared += 1
        if found:
            return Values(compared, point, undefined)
        if compared >= until:
            break
    return Values(compared, None, undefined)


def run(binary, lines, seconds):
    """The program's objects for the lines that it answers in this time, and how it ended, `None` for not at all."""
    command = [binary, "identity", "--format", "json"]
    for text in equations.DEFINITIONS:
        command += ["--define", text]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
        try:
            out, err = program.communicate("".join(line + "\n" for line in lines).encode(), timeout=seconds)
            status = program.returncode
        except subprocess.TimeoutExpired:
            program.kill()
            out, err = program.communicate()
            status = None
    # The last line of a program that was ended may be half a line.
    found = [json.loads(line) for line in out.decode().splitlines(keepends=True) if line.endswith("\n")]
    return found, status, err.decode().strip()


def answers(binary, lines):
    """The program's objects, one a line; NOT_READ and NO_ANSWER in the place of some."""
    out = []
    while len(out) < len(lines):
        rest = lines[len(out) :]
        found, status, err = run(binary, rest, SECONDS + len(rest) / 20)
        out += found
        if len(out) == len(lines):
            break
        if status is None:
            # One of the next is at fault.
            for line in lines[len(out) : len(out) + TOGETHER]:
                found, status, err = run(binary, [line], ALONE)
                out.append(found[0] if found else NO_ANSWER if status is None else NOT_READ)
        elif status == 2 and f"line {len(found) + 1} " in err:
            out.append(NOT_READ)
        else:
            sys.exit(f"the program ended with {status} near {lines[len(out)]!r}: {err[-500:]}")
        if out.count(NOT_READ) > REFUSALS:
            sys.exit(f"{REFUSALS} lines are not read, the last is {lines[len(out) - 1]!r}: {err}")
    return out


def judged(number, equation, answer, seed):
    """The equation's truth as far as it is known, its outcome, and what must not be, if anything is."""
    left, right = read(equation.left), read(equation.right)
    kinds = CALCULUS_POINTS if equation.calculus else POINTS
    points = [Point(f"{seed}/{number}/{k}", kind) for k, kind in enumerate(kinds)]
    truth = equation.truth
    known = evaluated(left, right, points, 2 if truth == equations.TRUE else 9)
    outcome = answer["outcome"]
    if truth == equations.TRUE and known.differs and certainly(left, right, known.differs):
        return truth, outcome, f"true by construction, but not at {shown(known.differs)}: a fault of the grammar"
    if known.differs:
        truth = equations.FALSE
    elif not known.compared and (known.undefined or truth == equations.NO_VALUE):
        truth = equations.NO_VALUE
    elif truth != equations.TRUE:
        # It may be true, or true at these points.
        truth = OPEN
    wrong = NO_ANSWER["reason"] if answer is NO_ANSWER else None
    if outcome == "proved":
        if known.differs and certainly(left, right, known.differs):
            wrong = f"proved, but false at {shown(known.differs)}"
        elif truth == equations.NO_VALUE:
            wrong = "proved, but without a value"
    if outcome == "refuted":
        if truth == equations.TRUE:
            wrong = "refuted, but true by construction"
        else:
            wrong = unconfirmed(left, right, answer["witness"])
    return truth, outcome, wrong


def unconfirmed(left, right, witness):
    """What is wrong with a refutation at its own point."""
    given = {name: Fraction(value) for name, value in witness["point"].items()}
    point = Given(given, True)
    # Differences as small as the second trial sees count; the third is for formal series.
    trials = ((point, 1, APART), (point, 10, mp.mpf(10) ** -400), (Given(given, False), 1, APART))
    try:
        if any(differ(left, right, *trial) for trial in trials):
            return None
    except Undefined as why:
        return f"refuted where there is {why}: {shown(point)}"
    except (Unclear, mp.libmp.NoConvergence, ValueError, OverflowError):
        # Not evaluated here.
        return None
    return f"refuted, but equal at {shown(point)}"


def shown(point):
    return ", ".join(f"{name} = {value}" for name, value in sorted(point.given.items())) or "every point"


def table(rows):
    """Rows of a table by class."""
    print(f"{'class':<10} {'':<16} {'equations':>9} {'proved':>7} {'refuted':>8} {'undecided':>10} {'share':>8}")
    for calculus in (False, True):
        for truth in (equations.TRUE, equations.FALSE, equations.NO_VALUE, OPEN):
            found = [r for r in rows if r[0].calculus == calculus and r[1] == truth]
            count = collections.Counter(r[2] for r in found)
            share = count["undecided"] / len(found) if found else 0
            print(
                f"{'calculus' if calculus else 'algebraic':<10} {truth:<16} {len(found):>9} {count['proved']:>7} "
                f"{count['refuted']:>8} {count['undecided']:>10} {share:>8.1%}"
            )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--binary", default="mechaudit")
    parser.add_argument("--show", choices=("undecided", "false", "kinds"))
    parser.add_argument("--equations", type=pathlib.Path)
    args = parser.parse_args()
    if args.equations:
        lines = [line.strip() for line in args.equations.read_text().splitlines()]
        lines = [line for line in lines if line and not line.startswith("#")]
        sides = [line.split("=", 1) for line in lines]
        all_of_them = [equations.Equation("given", False, a.strip(), b.strip(), None) for a, b in sides]
    else:
        all_of_them = equations.equations(args.seed, args.count)
        lines = [f"{e.left} = {e.right}" for e in all_of_them]
    started = time.process_time()
    found = answers(args.binary, lines)
    rows, wrong = [], []
    for number, (equation, answer) in enumerate(zip(all_of_them, found, strict=True)):
        truth, outcome, why = judged(number, equation, answer, args.seed)
        rows.append((equation, truth, outcome))
        if why:
            wrong.append((equation, why))
        reason = answer["reason"] or ""
        if args.equations:
            print(f"{truth}: {lines[number]}: {outcome} {reason}")
        if args.show == outcome == "undecided" and truth == equations.TRUE:
            print(f"{equation.kind}: {lines[number]}: {reason}")
        if args.show == "false" and truth in (equations.FALSE, equations.NO_VALUE) and outcome != "refuted":
            print(f"{equation.kind}: {lines[number]}: {outcome} {reason}")
    if args.show == "kinds":
        by_kind = collections.defaultdict(collections.Counter)
        for equation, truth, outcome in rows:
            if truth == equations.TRUE:
                by_kind[equation.kind][outcome] += 1
        for kind, count in sorted(by_kind.items()):
            print(f"{kind:<40} proved {count['proved']:>5}, undecided {count['undecided']:>5}")
    table(rows)
    for equation, why in wrong:
        print(f"WRONG ({equation.kind}): {equation.left} = {equation.right}: {why}")
    print(f"{len(rows)} equations, seed {args.seed}: {len(wrong)} wrong verdicts")
    print(f"{time.process_time() - started:.1f} s of mpmath", file=sys.stderr)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
