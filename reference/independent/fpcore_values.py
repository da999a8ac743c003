#!/usr/bin/env python3
"""Certified values of FPCore formulas against mpmath at 1200 digits.

    python3 reference/independent/fpcore_values.py FOLDER [--count 4] [--program PROGRAM]

For each core of the `.fpcore` files of a folder, `mechaudit points FILE#NUMBER --digits 25` writes inputs and values. This
script reads the core by itself and evaluates it at the same inputs with mpmath, all numbers and operations at 1200 digits,
and again at 1500: a value counts where both agree to 30 digits (or are both without a real value). It has to be the
certified one, to half a unit of the 25th digit. Prints a row for each core, then the counts; the exit code is 1 if a
value differs.
"""

import argparse
import csv
import pathlib
import re
import signal
import subprocess
import sys

import mpmath as mp

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[()\[\]]|[^\s()\[\];"]+|;[^\n]*')
CONSTANTS = {
    "PI": lambda: mp.pi + 0, "E": lambda: mp.e + 0, "LN2": lambda: mp.log(2), "LN10": lambda: mp.log(10),
    "LOG2E": lambda: 1 / mp.log(2), "LOG10E": lambda: 1 / mp.log(10), "PI_2": lambda: mp.pi / 2, "PI_4": lambda: mp.pi / 4,
    "M_1_PI": lambda: 1 / mp.pi, "M_2_PI": lambda: 2 / mp.pi, "M_2_SQRTPI": lambda: 2 / mp.sqrt(mp.pi),
    "SQRT2": lambda: mp.sqrt(2), "SQRT1_2": lambda: 1 / mp.sqrt(2), "TRUE": lambda: True, "FALSE": lambda: False,
}
COMPARE = {"<": lambda a, b: a < b, ">": lambda a, b: a > b, "<=": lambda a, b: a <= b, ">=": lambda a, b: a >= b,
           "==": lambda a, b: a == b}


class Undefined(Exception):
    """There is no real value."""


class Unknown(Exception):
    """An operation that this script does not have, or too much work."""


def real(x):
    if isinstance(x, bool):
        return x
    if isinstance(x, mp.mpc):
        if x.imag != 0:
            raise Undefined
        x = x.real
    if not mp.isfinite(x):
        raise Undefined
    return x


def power(a, b):
    if a == 0 and b <= 0:
        if b == 0:
            return mp.mpf(1)
        raise Undefined
    if a < 0 and b != mp.floor(b):
        raise Undefined
    return mp.power(a, b)


def positive(f):
    def of(x):
        if x <= 0:
            raise Undefined
        return f(x)
    return of


def divided(a, b=None):
    if b is None:
        a, b = 1, a
    if b == 0:
        raise Undefined
    return a / b


def rounded(x):
    """Halves away from zero."""
    return mp.sign(x) * mp.floor(abs(x) + mp.mpf(1) / 2)


FUNCTIONS = {
    "+": lambda *x: mp.fsum(x), "-": lambda a, *b: a - b[0] if b else -a, "*": lambda *x: mp.fprod(x), "/": divided,
    "fabs": abs, "sqrt": mp.sqrt, "cbrt": lambda x: mp.sign(x) * mp.cbrt(abs(x)), "hypot": mp.hypot, "fma": lambda a, b, c: a * b + c,
    "exp": mp.exp, "exp2": lambda x: mp.power(2, x), "expm1": mp.expm1, "log": positive(mp.log),
    "log2": positive(lambda x: mp.log(x) / mp.log(2)), "log10": positive(lambda x: mp.log(x) / mp.log(10)),
    "log1p": lambda x: positive(mp.log)(1 + x), "pow": power, "sin": mp.sin, "cos": mp.cos, "tan": mp.tan, "asin": mp.asin,
    "acos": mp.acos, "atan": mp.atan, "atan2": mp.atan2, "sinh": mp.sinh, "cosh": mp.cosh, "tanh": mp.tanh,
    "asinh": mp.asinh, "acosh": mp.acosh, "atanh": mp.atanh, "erf": mp.erf, "erfc": mp.erfc, "tgamma": mp.gamma,
    "lgamma": lambda x: mp.log(abs(mp.gamma(x))), "fmin": min, "fmax": max, "fdim": lambda a, b: max(a - b, mp.mpf(0)),
    "floor": mp.floor, "ceil": mp.ceil, "trunc": lambda x: mp.sign(x) * mp.floor(abs(x)), "round": rounded,
    "fmod": lambda a, b: a - b * mp.sign(divided(a, b)) * mp.floor(abs(a / b)), "copysign": lambda a, b: abs(a) * (-1 if b < 0 else 1),
}


def parse(text):
    """The expressions of a text as nested lists."""
    stack = [[]]
    for token in TOKEN.findall(text):
        if token[0] == ";":
            continue
        if token in "([":
            stack.append([])
        elif token in ")]":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(token)
    return stack[0]


def number(text):
    if re.fullmatch(r"[+-]?\d+/\d+", text):
        a, b = text.split("/")
        return mp.mpf(int(a)) / int(b)
    if "0x" in text:
        return mp.mpf(float.fromhex(text))
    return mp.mpf(text)


def later(e, names):
    """The value of an expression, once it is asked for."""
    kept = []

    def ask():
        if not kept:
            kept.append(value(e, names))
        return kept[0]
    return ask


def value(e, names):
    if isinstance(e, str):
        if e in names:
            known = names[e]
            # A name that is not used need not have a value.
            return known() if callable(known) else known
        if e in CONSTANTS:
            return CONSTANTS[e]()
        try:
            return number(e)
        except ValueError:
            raise Unknown(e) from None
    head, rest = e[0], e[1:]
    if head == "!":
        return value(rest[-1], names)
    if head == "if":
        return value(rest[1] if value(rest[0], names) else rest[2], names)
    if head in ("let", "let*"):
        inner = dict(names)
        for name, x in rest[0]:
            inner[name] = later(x, dict(inner) if head == "let*" else names)
        return value(rest[1], inner)
    if head in ("while", "while*"):
        inner = dict(names)
        for name, start, _ in rest[1]:
            inner[name] = value(start, inner if head == "while*" else names)
        while value(rest[0], inner):
            old = dict(inner)
            for name, _, update in rest[1]:
                inner[name] = value(update, inner if head == "while*" else old)
        return value(rest[2], inner)
    if head == "and":
        return all(value(x, names) for x in rest)
    if head == "or":
        return any(value(x, names) for x in rest)
    if head == "not":
        return not value(rest[0], names)
    x = [value(a, names) for a in rest]
    if head in COMPARE:
        return all(COMPARE[head](a, b) for a, b in zip(x, x[1:]))
    if head == "!=":
        return all(a != b for k, a in enumerate(x) for b in x[k + 1:])
    if head not in FUNCTIONS:
        raise Unknown(head)
    try:
        return real(FUNCTIONS[head](*x))
    except (ZeroDivisionError, ValueError):
        raise Undefined from None


def late(*_):
    raise Unknown("too long")


def witness(body, names):
    """The value to 30 digits: a number, "nan", or None where mpmath decides nothing."""
    found = []
    for digits in (1200, 1500):
        mp.mp.dps = digits
        signal.alarm(10)
        try:
            found.append(value(body, {k: mp.mpf(v) for k, v in names.items()}))
        except Undefined:
            found.append("nan")
        except (Unknown, OverflowError, MemoryError, RecursionError):
            found.append(None)
        finally:
            signal.alarm(0)
    a, b = found
    if a is None or b is None or "nan" in (str(a), str(b)):
        return a if a == b else None
    return b if a == b or abs(a - b) <= abs(b) * mp.mpf(10) ** -30 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=4)
    parser.add_argument("--program", default="mechaudit")
    a = parser.parse_args()
    signal.signal(signal.SIGALRM, late)
    sys.setrecursionlimit(20000)
    all_counts = [0, 0, 0]
    print("file,core,agree,undecided,differ,first")
    for file in sorted(a.folder.glob("*.fpcore")):
        cores = [c for c in parse(file.read_text()) if c and c[0] == "FPCore"]
        for k, core in enumerate(cores, 1):
            arguments = next(p for p in core[1:] if isinstance(p, list))
            names = [p if isinstance(p, str) else p[-1] for p in arguments]
            body = core[core.index(":spec") + 1] if ":spec" in core else core[-1]
            command = [a.program, "points", f"{file}#{k}", "--digits", "25", "--count", str(a.count), "--output", "-"]
            done = subprocess.run(command, capture_output=True, text=True)
            lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
            counts, first = [0, 0, 0], ""
            for row in list(csv.reader(lines))[1:]:
                found = row[len(names)]
                due = witness(body, {n: float.fromhex(x) for n, x in zip(names, row)}) if found else None
                if due is None or isinstance(due, bool):
                    counts[1] += 1
                    continue
                if str(due) == "nan" or found == "nan":
                    same = str(due) == found
                elif "inf" in found:
                    same = abs(due) > mp.mpf(2) ** (2 ** 20) and (due < 0) == found.startswith("-")
                else:
                    same = abs(mp.mpf(found) - due) <= abs(due) * mp.mpf(10) ** -24
                counts[0 if same else 2] += 1
                if not same and not first:
                    first = f"{' '.join(row)} mpmath {mp.nstr(due, 25) if due != 'nan' else due}"
            name = f"no points: {done.stderr.strip()[:80]}" if len(lines) < 2 else ""
            print(f"{file.name},{k},{counts[0]},{counts[1]},{counts[2]},{first or name}", flush=True)
            all_counts = [x + y for x, y in zip(all_counts, counts)]
    print("# agree {}, undecided {}, differ {}".format(*all_counts))
    sys.exit(1 if all_counts[2] else 0)


if __name__ == "__main__":
    main()
