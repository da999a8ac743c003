#!/usr/bin/env python3
"""Checks the boxes of a proof of a formula in FPCore, in binary64, with python-flint alone.

    mechaudit prove FILE.fpcore#NAME --boxes boxes.csv
    python3 reference/independent/formula_proof.py FILE.fpcore NAME boxes.csv [--points 2000] [--seed 1] [--round-inputs]

Covering: the boxes of each measure hold the whole domain that `:pre` states by ends of the arguments (other conditions
leave holes, at which the condition has to fail). Points: random numbers and corners of boxes; the body is carried out
operation by operation by Python's floats, the value comes from Arb, and the error has to be below the box's bound.
Elementary functions are those of Python's C library.
"""
import argparse
import csv
import math
import random
import sys

from flint import arb, ctx, fmpq

ctx.prec = 300


def tokens(text):
    text = "\n".join(line.split(";")[0] for line in text.splitlines())
    return text.translate(str.maketrans({"(": " ( ", "[": " ( ", ")": " ) ", "]": " ) "})).split()


def tree(words):
    word = words.pop()
    if word != "(":
        return word
    out = []
    while words[-1] != ")":
        out.append(tree(words))
    words.pop()
    return out


def cores(text):
    words = tokens(text)[::-1]
    while words:
        yield tree(words)


def number(text):
    try:
        if "/" in text:
            p, q = text.split("/")
            return fmpq(int(p), int(q))
        mantissa, _, power = text.lower().partition("e")
        whole, _, digits = mantissa.partition(".")
        value = fmpq(int(whole + digits), 10 ** len(digits)) if whole + digits not in ("", "-") else None
        return value * fmpq(10) ** int(power or 0)
    except (ValueError, TypeError):
        return None


def nearest(q):
    return int(q.p) / int(q.q)


class Floats:
    """Python's floats: one rounding an operation."""

    number = staticmethod(nearest)
    functions = {name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan", "fabs")}


class Exact:
    """Balls of Arb."""

    number = staticmethod(arb)
    functions = {name: (lambda x, name=name: getattr(x, name)()) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan")}


Exact.functions["fabs"] = abs


def value(e, names, kind):
    if isinstance(e, str):
        if e in names:
            return names[e]
        if e == "PI":
            return math.pi if kind is Floats else arb.pi()
        return kind.number(number(e))
    head, *rest = e
    if head in ("let", "let*"):
        inner = dict(names)
        for name, of in rest[0]:
            inner[name] = value(of, inner if head == "let*" else names, kind)
        return value(rest[1], inner, kind)
    x = [value(r, names, kind) for r in rest]
    if head == "-" and len(x) == 1:
        return -x[0]
    if head in "+-*/":
        out = x[0]
        for y in x[1:]:
            out = {"+": out + y, "-": out - y, "*": out * y}[head] if head != "/" else out / y
        return out
    return kind.functions[head](*x)


def holds(e, names):
    """Whether a condition holds: false only if it certainly fails."""
    head, *rest = e
    if head == "and":
        return all(holds(r, names) for r in rest)
    x = [value(r, names, Exact) for r in rest]
    fails = {"<=": lambda a, b: a > b, ">=": lambda a, b: a < b, "<": lambda a, b: a >= b, ">": lambda a, b: a <= b}[head]
    return not any(fails(a, b) for a, b in zip(x, x[1:]))


def hole(domain, boxes):
    """The middle of a part of the domain that no box holds, or none. Ends of real inputs touch; those of floats are
    neighbours."""
    meets = [b for b in boxes if all(p <= t and s <= q for (p, q), (s, t) in zip(domain, b))]
    if any(all(s <= p and q <= t for (p, q), (s, t) in zip(domain, b)) for b in meets):
        return None
    cuts = [sorted({e for b in meets for e in (b[k][0], math.nextafter(b[k][1], math.inf)) if p < e <= q})
            for k, (p, q) in enumerate(domain)]
    k = max(range(len(domain)), key=lambda k: len(cuts[k]), default=0)
    if not cuts or not cuts[k]:
        return [p / 2 + q / 2 for p, q in domain]
    at = cuts[k][len(cuts[k]) // 2]
    low, high = list(domain), list(domain)
    low[k], high[k] = (domain[k][0], math.nextafter(at, -math.inf)), (at, domain[k][1])
    return hole(low, meets) or hole(high, meets)


def ends_of(e, names):
    """The ends of arguments that a condition states."""
    out = {n: [-math.inf, math.inf] for n in names}

    def narrow(e):
        head, *rest = e
        if head == "and":
            for r in rest:
                narrow(r)
            return
        if head in (">", ">="):
            rest = rest[::-1]
        for a, b in zip(rest, rest[1:]):
            if isinstance(a, str) and isinstance(b, str):
                if b in out and number(a) is not None:
                    out[b][0] = max(out[b][0], nearest(number(a)))
                if a in out and number(b) is not None:
                    out[a][1] = min(out[a][1], nearest(number(b)))

    narrow(e)
    return [tuple(out[n]) for n in names]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("name")
    parser.add_argument("boxes")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--round-inputs", action="store_true")
    args = parser.parse_args()
    core = next(c for c in cores(open(args.file).read()) if c[1] == args.name)
    names, body = core[2], core[-1]
    pre = core[core.index(":pre") + 1]
    rows = {}
    for row in csv.DictReader(open(args.boxes)):
        box = [tuple(float.fromhex(row[f"{n}_{end}"]) for end in ("from", "to")) for n in names]
        bound = float("inf") if row["bound"] == "inf" else float.fromhex(row["bound"])
        rows.setdefault(row["measure"], []).append((box, bound))
    draw = random.Random(args.seed)
    domain = ends_of(pre, names)
    worst = {}
    for measure, boxes in rows.items():
        # Inward by a unit: the decimal ends may lie between floats.
        inside = [(math.nextafter(p, math.inf), math.nextafter(q, -math.inf)) if p < q else (p, q) for p, q in domain]
        missing = hole(inside, [b for b, _ in boxes])
        if missing is not None and holds(pre, {n: arb(x) for n, x in zip(names, missing)}):
            sys.exit(f"{measure}: no box holds {missing}")
        for k in range(args.points):
            box, bound = draw.choice(boxes)
            x = [draw.choice(d) if k % 2 else draw.uniform(*d) for d in box]
            real = [arb(v) for v in x]
            if args.round_inputs:
                # Any real number that rounds to x: a little away from it.
                real = [r + arb(v).abs_upper() * arb(draw.uniform(-0.49, 0.49)) * arb(2) ** -53 for r, v in zip(real, x)]
                real = [max(min(r, arb(q)), arb(p)) for r, (p, q) in zip(real, box)]
            if bound == math.inf or not holds(pre, dict(zip(names, real))):
                continue
            # More bits where 300 do not tell a small bound from the error.
            for ctx.prec in (300, 4000):
                exact = value(body, dict(zip(names, real)), Exact)
                error = abs(arb(value(body, dict(zip(names, x)), Floats)) - exact)
                if measure == "relative":
                    error = error / abs(exact)
                if measure == "ulps":
                    size = abs(float(exact.mid()))
                    error = error / arb(math.ulp(size))
                if error <= arb(bound):
                    break
            else:
                sys.exit(f"{measure}: at {x} the error is {error}, the bound {bound}")
            ctx.prec = 300
            worst[measure] = max(worst.get(measure, 0.0), float(error.mid()))
    for measure, boxes in rows.items():
        most = max(bound for _, bound in boxes)
        print(f"{measure}: {len(boxes)} boxes cover the domain, bound {most:.4e}, worst of {args.points} points {worst.get(measure, 0.0):.4e}")


if __name__ == "__main__":
    main()
