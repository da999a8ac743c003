#!/usr/bin/env python3
"""Checks the boxes of a proof of a formula with python-flint alone.

    mechaudit prove FILE.fpcore#NAME --boxes boxes.csv
    python3 reference/independent/formula_proof.py FILE.fpcore NAME boxes.csv [--points 2000] [--cuts 100] [--factor 1.1] [--seed 1]
        [--round-inputs] [--proved PERCENT]

    mechaudit prove FILE.toml --solver NAME --together RE,IM --boxes boxes.csv
    python3 reference/independent/formula_proof.py FILE.toml NAME boxes.csv --together RE,IM

A core in binary64 or binary32, or the formulas of a study's solver NAME: one output, or two as the real and the imaginary
part of one result, whose error is the absolute value of the complex one.

Covering: the boxes of each measure hold the whole domain that `:pre` or the inputs state by ends (other conditions
leave holes, at which the condition has to fail). Proof: each box is cut until bounds of its parts, found by
formula_bound.py, are at most --factor times the bound that the file states, at most --cuts times. Points: random numbers and corners,
those of every box that has no such proof and some of all others; the body is carried out operation by operation by
Python's floats, in binary32 with each result rounded once more, the value comes from Arb, and the error has to be below
the box's bound. Elementary functions are those of Python's C library; in binary32 a formula may have
`+ - * / sqrt fabs fmin fmax fma` alone: of the first rounding twice gives what rounding once does (S. A. Figueroa, 1995).
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

import formula_bound

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


def step(x, to, short):
    """The number next to x towards another."""
    if not short:
        return math.nextafter(x, to)
    bits = struct.unpack("i", struct.pack("f", x))[0]
    if x == 0:
        return math.copysign(2.0**-149, to)
    return struct.unpack("f", struct.pack("i", bits + (1 if (x > 0) == (to > x) else -1)))[0]


def nearest_single(q):
    """Rounded once, not by way of binary64."""
    x = single(nearest(q))
    near = [x, *(step(x, to, True) for to in (-math.inf, math.inf))]
    odd = lambda y: struct.unpack("I", struct.pack("f", y))[0] & 1
    return min(near, key=lambda y: (abs(fmpq(*y.as_integer_ratio()) - q), odd(y)))


class Undecided(Exception):
    """A comparison that the enclosures of both sides leave open."""


def fraction(x):
    return fmpq(*x.as_integer_ratio())


class Floats:
    """Python's floats: one rounding an operation."""

    functions = {name: getattr(math, name) for name in (
        "sin cos tan asin acos atan atan2 sinh cosh tanh exp exp2 expm1 log log2 log10 log1p sqrt fabs pow hypot").split()}
    functions |= {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b,
                  "neg": lambda a: -a, "fmin": min, "fmax": max}
    pi = math.pi

    def number(self, q):
        return nearest(q)

    def call(self, head, x):
        if head == "fma":
            exact = fraction(x[0]) * fraction(x[1]) + fraction(x[2])
            return self.number(exact) if exact != 0 else x[0] * x[1] + x[2]
        return self.functions[head](*x)

    def is_less(self, a, b):
        return a < b



class Singles(Floats):
    """Numbers of binary32: results of binary64, which is more than twice as wide, rounded again."""

    functions = {name: Floats.functions[name] for name in "+ - * / neg fmin fmax sqrt fabs".split()}
    pi = single(math.pi)

    def number(self, q):
        return nearest_single(q)

    def call(self, head, x):
        return single(super().call(head, x))


class Exact(Floats):
    """Balls of Arb."""

    functions = dict(Floats.functions)
    functions |= {name: (lambda x, name=name: getattr(x, name)()) for name in (
        "sin cos tan asin acos atan sinh cosh tanh exp expm1 log log1p sqrt").split()}
    functions |= {"fabs": abs, "fmin": lambda a, b: a.min(b), "fmax": lambda a, b: a.max(b), "fma": lambda a, b, c: a * b + c,
                  "exp2": lambda x: arb(2) ** x, "log2": lambda x: x.log() / arb.const_log2(), "pow": lambda x, y: x ** y,
                  "log10": lambda x: x.log() / arb.const_log10(), "hypot": lambda x, y: (x * x + y * y).sqrt(),
                  "atan2": lambda y, x: arb.atan2(y, x)}

    @property
    def pi(self):
        return arb.pi()

    def number(self, q):
        return arb(q)

    def call(self, head, x):
        return self.functions[head](*x)

    def is_less(self, a, b):
        if not (a < b or a >= b):
            raise Undecided
        return a < b


class Bounds:
    """Places of a run over a box."""

    def __init__(self, run):
        self.run = run
        self.short = run.is_single

    @property
    def pi(self):
        return self.run.constant(arb.pi(), single(math.pi) if self.short else math.pi)

    def number(self, q):
        return self.run.constant(arb(q), (nearest_single if self.short else nearest)(q))

    def call(self, head, x):
        run = self.run
        own = {"+": run.sum, "-": lambda a, b: run.sum(a, b, -1.0), "*": run.product, "/": run.quotient, "neg": run.negative,
               "fma": run.fma, "sqrt": run.root, "fabs": run.absolute, "fmax": run.larger,
               "fmin": lambda a, b: run.larger(a, b, -1.0), "pow": run.power, "hypot": run.hypot, "atan2": run.angle}
        return own[head](*x) if head in own else run.smooth(head, *x)

    def is_less(self, a, b):
        x, y = self.run.path[a], self.run.path[b]
        if x[1] < y[0] or x[0] >= y[1]:
            return x[1] < y[0]
        raise Undecided

def value(e, names, kind):
    if isinstance(e, str):
        if e in names:
            return names[e]
        return kind.pi if e == "PI" else kind.number(number(e))
    head, *rest = e
    if head in ("let", "let*"):
        inner = dict(names)
        for name, of in rest[0]:
            inner[name] = value(of, inner if head == "let*" else names, kind)
        return value(rest[1], inner, kind)
    if head == "if":
        try:
            return value(rest[1] if decided(rest[0], names, kind) else rest[2], names, kind)
        except Undecided:
            if not isinstance(kind, Bounds):
                raise
        yes, no = (value(r, names, kind) for r in rest[1:])
        return kind.run.choice(yes, no, compares_exactly(rest[0], names, kind))
    if head in ("while", "while*"):
        inner = dict(names)
        for name, start, _ in rest[1]:
            inner[name] = value(start, inner if head == "while*" else names, kind)
        while decided(rest[0], inner, kind):
            old = inner if head == "while*" else dict(inner)
            for name, _, update in rest[1]:
                inner[name] = value(update, old, kind)
        return value(rest[2], inner, kind)
    x = [value(r, names, kind) for r in rest]
    if head == "-" and len(x) == 1:
        return kind.call("neg", x)
    if head in "+-*/":
        out = x[0]
        for y in x[1:]:
            out = kind.call(head, [out, y])
        return out
    return kind.call(head, x)


def decided(e, names, kind):
    """A condition that is true or false.

    Raises `Undecided` where enclosures leave it open."""
    if isinstance(e, str):
        return e == "TRUE"
    head, *rest = e
    if head in ("and", "or", "not"):
        x = [decided(r, names, kind) for r in rest]
        return not x[0] if head == "not" else all(x) if head == "and" else any(x)
    x = [value(r, names, kind) for r in rest]
    pairs = list(zip(x, x[1:]))
    if head in ("==", "!="):
        same = [not kind.is_less(a, b) and not kind.is_less(b, a) for a, b in pairs]
        return all(same) if head == "==" else not any(same)
    if head in (">", "<="):
        found = [kind.is_less(b, a) for a, b in pairs]
    else:
        found = [kind.is_less(a, b) for a, b in pairs]
    return all(found) if head in "<>" else not any(found)


def compares_exactly(e, names, kind):
    """Whether a condition compares numbers without errors alone."""
    if isinstance(e, str):
        return True
    head, *rest = e
    if head in ("and", "or", "not"):
        return all(compares_exactly(r, names, kind) for r in rest)
    return all(kind.run.is_exact[value(r, names, kind)] for r in rest)


def holds(e, names):
    """Whether a condition holds: false only if it certainly fails."""
    try:
        return decided(e, names, Exact())
    except Undecided:
        return True


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


def proved(case, measure, box, bound, most):
    """Whether the error is below a bound in each part of a box; parts are halved, at most so many times."""
    waiting = [box]
    while waiting:
        part = waiting.pop()
        if bounded(case, measure, part) <= bound:
            continue
        k = max(range(len(part)), key=lambda k: case.width(part[k]))
        low, high = part[k]
        middle = case.middle(low, high)
        if most == 0 or not low < high:
            return False
        most -= 1
        for side in ((low, middle), (middle if case.is_real else case.after(middle, math.inf), high)):
            if side[0] <= side[1]:
                waiting.append([*part[:k], side, *part[k + 1:]])
    return True


class Case:
    """A formula with its inputs, and how numbers of its format follow each other."""

    def __init__(self, args):
        self.names, self.condition, self.bodies, self.short = opened(args)
        self.is_real = args.round_inputs
        self.kind, self.digits = (Singles(), 24) if self.short else (Floats(), 53)

    def after(self, x, to):
        return step(x, to, self.short and not self.is_real)

    def width(self, side):
        """Of a side as a part of its larger end; a side across zero goes first."""
        low, high = side
        return (high - low) / max(abs(low), abs(high)) if low < high else 0.0

    def middle(self, low, high):
        x = low / 2 + high / 2
        if low > 0 and high / low > 16 or high < 0 and low / high > 16:
            x = math.copysign(math.sqrt(abs(low)) * math.sqrt(abs(high)), low)
        return single(x) if self.short and not self.is_real else x


def bounded(case, measure, box):
    """A bound of the error over a box, infinite if there is none."""
    try:
        run = formula_bound.Run("binary32" if case.short else "binary64")
        kind = Bounds(run)
        names = {n: run.input(x, case.is_real) for n, x in zip(case.names, box)}
        places = [value(body, names, kind) for body in case.bodies]
        errors = [run.bound(at) for at in places]
        # The exact value is on the path as well.
        least = [formula_bound.least(run.path[at]) for at in places]
    except (formula_bound.NoBound, Undecided, ZeroDivisionError, OverflowError, ValueError):
        return math.inf
    norm = lambda x, way: x[0] if len(x) == 1 else math.nextafter(math.nextafter(math.hypot(*x), way), way)
    error = norm(errors, math.inf)
    if measure == "relative":
        size = norm(least, 0.0)
        return 0.0 if error == 0.0 else math.nextafter(error / size, math.inf) if size > 0 else math.inf
    if measure == "ulps":
        return math.nextafter(error / run.unit(least[0]), math.inf)
    return error


def point(case, draw, box, corner):
    """Inputs in a box: numbers of the format, and the real numbers that they stand for; or none."""
    x = [draw.choice(d) if corner else draw.uniform(*d) for d in box]
    if case.short:
        x = [single(v) for v in x]
        if not case.is_real:
            x = [min(max(v, p), q) for v, (p, q) in zip(x, box)]
    real = [arb(v) for v in x]
    if case.is_real:
        # Any real number that rounds to x: a little away from it.
        away = [arb(v).abs_upper() * arb(draw.uniform(-0.49, 0.49)) * arb(2) ** -case.digits for v in x]
        real = [r + d for r, d in zip(real, away)]
        if any(not (arb(p) <= r <= arb(q)) for r, (p, q) in zip(real, box)):
            return None
    return x, real


def error_at(case, measure, x, real, bound):
    """The error at a point where it is below the bound, or none if the precision does not tell."""
    # More bits where 300 do not tell a small bound from the error.
    for ctx.prec in (300, 4000):
        exact = [value(body, dict(zip(case.names, real)), Exact()) for body in case.bodies]
        parts = [arb(value(body, dict(zip(case.names, x)), case.kind)) - e for body, e in zip(case.bodies, exact)]
        size = lambda parts: abs(parts[0]) if len(parts) == 1 else sum(p * p for p in parts).sqrt()
        error = size(parts)
        # A value of zero is computed without an error, or has no relative one.
        if measure == "relative" and error != 0:
            error = error / size(exact)
        if measure == "ulps":
            most = abs(float(exact[0].mid()))
            error = error / arb(max(math.ulp(most) * (2.0**29 if case.short else 1), 2.0**-149 if case.short else 0))
        if error <= arb(bound):
            break
    else:
        sys.exit(f"{measure}: at {x} the error is {error}, the bound {bound}")
    ctx.prec = 300
    return float(error.mid())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("name")
    parser.add_argument("boxes")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--cuts", type=int, default=100, help="the most that a box is cut for a proof")
    parser.add_argument("--factor", type=float, default=1.1, help="by which bounds proved here may be above the file's")
    parser.add_argument("--proved", type=float, default=0.0, help="per cent of the boxes that have to be proved")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--round-inputs", action="store_true")
    parser.add_argument("--together", metavar="RE,IM")
    args = parser.parse_args()
    case = Case(args)
    short = case.short
    rows = {}
    for row in csv.DictReader(open(args.boxes)):
        box = [tuple(float.fromhex(row[f"{n}_{end}"]) for end in ("from", "to")) for n in case.names]
        bound = float("inf") if row["bound"] == "inf" else float.fromhex(row["bound"])
        rows.setdefault(row["measure"], []).append((box, bound))
    if not rows:
        sys.exit("no boxes")
    draw = random.Random(args.seed)
    domain = ends_of(case.condition, case.names)
    for measure, boxes in rows.items():
        # Inward by a unit: the decimal ends may lie between floats.
        inside = [(step(single(p), math.inf, True), step(single(q), -math.inf, True)) if short and p < q
                  else (math.nextafter(p, math.inf), math.nextafter(q, -math.inf)) if p < q else (p, q) for p, q in domain]
        missing = hole(inside, [b for b, _ in boxes], case.after)
        if missing is not None and holds(case.condition, {n: arb(x) for n, x in zip(case.names, missing)}):
            sys.exit(f"{measure}: no box holds {missing}")
        finite = [(box, bound) for box, bound in boxes if bound != math.inf]
        ctx.prec = 64
        open_ = [b for b in finite if not proved(case, measure, b[0], b[1] * args.factor, args.cuts)]
        ctx.prec = 300
        # The boxes without a proof in turn, then any.
        chosen = [open_[k % len(open_)] for k in range(max(args.points // 2, 4 * len(open_)))] if open_ else []
        chosen += [draw.choice(finite) for _ in range(args.points - len(chosen))] if finite else []
        worst, counted = 0.0, 0
        for k, (box, bound) in enumerate(chosen):
            at = point(case, draw, box, k // max(len(open_), 1) % 2)
            try:
                if at is None or not holds(case.condition, dict(zip(case.names, at[1]))):
                    continue
                worst = max(worst, error_at(case, measure, *at, bound))
                counted += 1
            except Undecided:
                continue
        share = 100.0 * (len(finite) - len(open_)) / len(finite) if finite else 0.0
        most = max(bound for _, bound in boxes)
        print(f"{measure}: {len(boxes)} boxes cover the domain, bound {most:.4e}, {len(finite) - len(open_)} proved again "
              f"({share:.1f} %), worst of {counted} points {worst:.4e}")
        if share < args.proved:
            sys.exit(f"{measure}: fewer than {args.proved} % of the boxes are proved again")


if __name__ == "__main__":
    main()
