#!/usr/bin/env python3
"""Checks the boxes of a proof of a formula with python-flint alone.

    mechaudit prove FILE.fpcore#NAME --boxes boxes.csv
    python3 reference/independent/formula_proof.py FILE.fpcore NAME boxes.csv [--points 2000] [--seed 1] [--round-inputs]

    mechaudit prove FILE.toml --solver NAME --together RE,IM --boxes boxes.csv
    python3 reference/independent/formula_proof.py FILE.toml NAME boxes.csv --together RE,IM

A core in binary64 or binary32, or the formulas of a study's solver NAME: one output, or two as the real and the imaginary
part of one result, whose error is the absolute value of the complex one.

Covering: the boxes of each measure hold the whole domain that `:pre` or the inputs state by ends (other conditions
leave holes, at which the condition has to fail). Points: random numbers and corners of boxes; the body is carried out
operation by operation by Python's floats, in binary32 with each result rounded once more, the value comes from Arb, and
the error has to be below the box's bound. Elementary functions are those of Python's C library; in binary32 a formula
may have `+ - * / sqrt fabs` alone, of which rounding twice gives what rounding once does (S. A. Figueroa, 1995).
"""
import argparse
import ast
import csv
import math
import random
import struct
import sys
import tomllib

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


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def nearest_single(q):
    """Rounded once, not by way of binary64."""
    x = single(nearest(q))
    near = [x, *(step(x, to, True) for to in (-math.inf, math.inf))]
    odd = lambda y: struct.unpack("I", struct.pack("f", y))[0] & 1
    return min(near, key=lambda y: (abs(fmpq(*y.as_integer_ratio()) - q), odd(y)))


def step(x, to, short):
    """The number next to x towards another."""
    if not short:
        return math.nextafter(x, to)
    bits = struct.unpack("i", struct.pack("f", x))[0]
    if x == 0:
        return math.copysign(2.0**-149, to)
    return struct.unpack("f", struct.pack("i", bits + (1 if (x > 0) == (to > x) else -1)))[0]


class Floats:
    """Python's floats: one rounding an operation."""

    number = staticmethod(nearest)
    functions = {name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan", "fabs")}


class Singles:
    """Numbers of binary32: results of binary64, which is more than twice as wide, rounded again."""

    number = staticmethod(nearest_single)
    functions = {name: (lambda x, of=of: single(of(x))) for name, of in (("sqrt", math.sqrt), ("fabs", abs))}


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
            return {Floats: math.pi, Singles: single(math.pi)}.get(kind) or arb.pi()
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
            out = single(out) if kind is Singles else out
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


def hole(domain, boxes, after):
    """The middle of a part of the domain that no box holds, or none. Ends of real inputs touch; those of floats are
    neighbours, of which `after` gives the next."""
    meets = [b for b in boxes if all(p <= t and s <= q for (p, q), (s, t) in zip(domain, b))]
    if any(all(s <= p and q <= t for (p, q), (s, t) in zip(domain, b)) for b in meets):
        return None
    cuts = [sorted({e for b in meets for e in (b[k][0], after(b[k][1], math.inf)) if p < e <= q})
            for k, (p, q) in enumerate(domain)]
    k = max(range(len(domain)), key=lambda k: len(cuts[k]), default=0)
    if not cuts or not cuts[k]:
        return [p / 2 + q / 2 for p, q in domain]
    at = cuts[k][len(cuts[k]) // 2]
    low, high = list(domain), list(domain)
    low[k], high[k] = (domain[k][0], after(at, -math.inf)), (at, domain[k][1])
    return hole(low, meets, after) or hole(high, meets, after)


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


def prefix(e):
    """An expression of a study as one of FPCore; a square is a product."""
    if isinstance(e, ast.Constant):
        return str(e.value)
    if isinstance(e, ast.Name):
        return {"pi": "PI"}.get(e.id, e.id)
    if isinstance(e, ast.UnaryOp):
        return ["-", prefix(e.operand)]
    if isinstance(e, ast.Call):
        return [{"abs": "fabs", "ln": "log"}.get(e.func.id, e.func.id), *map(prefix, e.args)]
    x, y = prefix(e.left), prefix(e.right)
    if isinstance(e.op, ast.Pow):
        if y != "2":
            sys.exit("of powers squares alone are carried out here")
        return ["*", x, x]
    return [{ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(e.op)], x, y]


def opened(args):
    """Names of the inputs, the condition on them, the bodies, and whether they are in binary32."""
    if not args.file.endswith(".toml"):
        core = next(c for c in cores(open(args.file).read()) if c[1] == args.name)
        short = ":precision" in core and core[core.index(":precision") + 1] == "binary32"
        return core[2], core[core.index(":pre") + 1], [core[-1]], short
    study = tomllib.load(open(args.file, "rb"))
    solver, inputs = study["solver"][args.name], study["inputs"]
    wanted = args.together.split(",") if args.together else list(study["outputs"])
    if len(wanted) != (2 if args.together else 1):
        sys.exit("one output, or two of --together")
    parse = lambda text: prefix(ast.parse(text.replace("^", "**"), mode="eval").body)
    pre = ["and", *(["<=", repr(i["from"]), n, repr(i["to"])] for n, i in inputs.items())]
    return list(inputs), pre, [parse(solver[w.strip()]) for w in wanted], solver.get("format") == "binary32"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("name")
    parser.add_argument("boxes")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--round-inputs", action="store_true")
    parser.add_argument("--together", metavar="RE,IM")
    args = parser.parse_args()
    names, pre, bodies, short = opened(args)
    kind, digits = (Singles, 24) if short else (Floats, 53)
    after = lambda x, to: step(x, to, short and not args.round_inputs)
    rows = {}
    for row in csv.DictReader(open(args.boxes)):
        box = [tuple(float.fromhex(row[f"{n}_{end}"]) for end in ("from", "to")) for n in names]
        bound = float("inf") if row["bound"] == "inf" else float.fromhex(row["bound"])
        rows.setdefault(row["measure"], []).append((box, bound))
    if not rows:
        sys.exit("no boxes")
    draw = random.Random(args.seed)
    domain = ends_of(pre, names)
    worst = {}
    for measure, boxes in rows.items():
        # Inward by a unit: the decimal ends may lie between floats.
        inside = [(step(single(p), math.inf, True), step(single(q), -math.inf, True)) if short and p < q
                  else (math.nextafter(p, math.inf), math.nextafter(q, -math.inf)) if p < q else (p, q) for p, q in domain]
        missing = hole(inside, [b for b, _ in boxes], after)
        if missing is not None and holds(pre, {n: arb(x) for n, x in zip(names, missing)}):
            sys.exit(f"{measure}: no box holds {missing}")
        for k in range(args.points):
            box, bound = draw.choice(boxes)
            x = [draw.choice(d) if k % 2 else draw.uniform(*d) for d in box]
            x = [single(v) if short else v for v in x]
            if short and not args.round_inputs:
                x = [min(max(v, p), q) for v, (p, q) in zip(x, box)]
            real = [arb(v) for v in x]
            if args.round_inputs:
                # Any real number that rounds to x: a little away from it.
                away = [arb(v).abs_upper() * arb(draw.uniform(-0.49, 0.49)) * arb(2) ** -digits for v in x]
                real = [r + d for r, d in zip(real, away)]
                if any(not (arb(p) <= r <= arb(q)) for r, (p, q) in zip(real, box)):
                    continue
            if bound == math.inf or not holds(pre, dict(zip(names, real))):
                continue
            # More bits where 300 do not tell a small bound from the error.
            for ctx.prec in (300, 4000):
                exact = [value(body, dict(zip(names, real)), Exact) for body in bodies]
                parts = [arb(value(body, dict(zip(names, x)), kind)) - e for body, e in zip(bodies, exact)]
                size = lambda parts: abs(parts[0]) if len(parts) == 1 else sum(p * p for p in parts).sqrt()
                error = size(parts)
                # A value of zero is computed without an error, or has no relative one.
                if measure == "relative" and error != 0:
                    error = error / size(exact)
                if measure == "ulps":
                    most = abs(float(exact[0].mid()))
                    error = error / arb(max(math.ulp(most) * (2.0**29 if short else 1), 2.0**-149 if short else 0))
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
