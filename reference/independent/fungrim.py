"""Writes topics of Fungrim, the Mathematical Functions Grimoire, as a paper that mechaudit decides.

    git clone https://github.com/fredrik-johansson/fungrim
    python3 fungrim.py fungrim error_functions error-functions.toml
    mechaudit paper error-functions.toml --ledger

The second argument is a module of pygrim/formulas. Only formulas are read and none is kept here. Standard error says how
many entries are definitions or pictures, how many the language of studies cannot express, and how many are written.

Variables of the file are positive numbers. An identity of analytic functions that holds for those holds in the whole
region around them in which both sides are analytic; where a formula has a conjugate, a modulus or a part, a complex variable is written as x + i y.
Integer parameters are given small values, and the note of such an entry says which: it is decided for those alone.
Error functions are written by W (DLMF 7.2.3, 7.5.1), and special values of other functions as integrals or functions of
the language: DLMF 13.4.1 with t = s^2 and 1 - s^2, 13.6.8, and 10.16.1.
"""

import importlib
import math
import sys

SAME = "Exp Sqrt Sin Cos Sinh Cosh Tanh Log Asin Acos Asinh Acosh Atanh Atan2 Abs Re Im Arg".split()
NAMES = {name: name.lower() for name in SAME} | {"Atan": "arctan", "Conjugate": "conj", "Gamma": "tgamma"}
PARTS = {"Abs", "Re", "Im", "Arg", "Conjugate"}
# The values that an integer parameter may take, by its set, and the values that are tried.
SETS = {"ZZ": range(-2, 4)}


class NotExpressed(Exception):
    pass


class Writer:
    """Writes expressions of one entry."""

    def __init__(self, integers, complex_names, calls):
        self.integers, self.complex_names, self.calls, self.symbols = integers, complex_names, calls, set()

    def name(self, e):
        if e.head() is not None and str(e.head()) == "Subscript":
            return "_".join(str(a) for a in e.args())
        return str(e) + "_" if str(e) in ("i", "e", "D") else str(e)

    def number(self, e):
        """The integer that an expression has for the values of the integer parameters."""
        if e.is_integer():
            return e._integer
        if e.is_symbol() and str(e) in self.integers:
            return self.integers[str(e)]
        head = str(e.head()) if e.head() is not None else ""
        if head in ("Binomial", "Factorial"):
            a = [self.number(x) for x in e.args()]
            return None if None in a else math.comb(*a) if head == "Binomial" else math.factorial(*a)
        if head in ("Add", "Sub", "Mul", "Neg", "Pos", "Parentheses", "Div", "Floor"):
            if head == "Floor":
                return self.floor(e.args()[0])
            a = [self.number(x) for x in e.args()]
            if None in a:
                return None
            if head == "Div":
                return a[0] // a[1] if a[1] and a[0] % a[1] == 0 else None
            product = 1
            for x in a:
                product *= x
            return {"Add": sum(a), "Sub": a[0] - sum(a[1:]), "Mul": product, "Neg": -a[0]}.get(head, a[0])
        return None

    def floor(self, e):
        if str(e.head()) == "Div":
            above, below = (self.number(x) for x in e.args())
            return None if None in (above, below) else above // below
        return self.number(e)

    def write(self, e):
        n = self.number(e)
        if n is not None:
            return str(n) if n >= 0 else f"({n})"
        if e in self.calls:
            return "(" + self.write(self.calls[e]) + ")"
        if e.is_symbol():
            fixed = {"Pi": "pi", "ConstI": "i", "Infinity": "inf"}.get(str(e))
            if fixed:
                return fixed
            if str(e) in self.complex_names:
                self.symbols |= {f"{e}_x", f"{e}_y"}
                return f"({e}_x + i*{e}_y)"
            if not str(e)[0].islower() or len(str(e)) > 14:
                raise NotExpressed(str(e))
            self.symbols.add(self.name(e))
            return self.name(e)
        head, args = str(e.head()), e.args()
        if head == "Subscript":
            self.symbols.add(self.name(e))
            return self.name(e)
        if head in ("Parentheses", "Brackets", "Braces", "Pos"):
            return self.write(args[0])
        if head in ("Add", "Sub", "Mul", "Div"):
            sign = {"Add": " + ", "Sub": " - ", "Mul": "*", "Div": "/"}[head]
            return "(" + sign.join(self.write(a) for a in args) + ")"
        if head == "Neg":
            return f"(-{self.write(args[0])})"
        if head == "Pow":
            n = self.number(args[1])
            exponent = str(n) if n is not None else f"({self.write(args[1])})"
            return f"({self.write(args[0])}^{exponent})"
        if head in NAMES:
            return f"{NAMES[head]}(" + ", ".join(self.write(a) for a in args) + ")"
        if head in ("Sum", "Product") and str(args[1].head()) == "For":
            variable, low, high = args[1].args()
            ends = self.number(low), self.number(high)
            if None not in ends:
                return self.expanded(" + " if head == "Sum" else "*", str(variable), ends, args[0])
        if head in ("Integral", "Sum") and str(args[1].head()) == "For":
            return self.bound("int" if head == "Integral" else "sum", *args[1].args(), args[0])
        if head in ("ComplexDerivative", "RealDerivative"):
            return self.derivative(args[0], *args[1].args())
        return self.special(head, args)

    def expanded(self, sign, variable, ends, body):
        """A finite sum or product of which the number of terms is known."""
        before, parts = self.integers, []
        for k in range(ends[0], ends[1] + 1):
            self.integers = before | {variable: k}
            parts.append(self.write(body))
        self.integers = before
        return "(" + sign.join(parts) + ")" if parts else "0" if "+" in sign else "1"

    def bound(self, word, variable, low, high, body):
        low, high = self.write(low), self.write(high)
        # A bound variable is neither a symbol nor a parameter.
        inside = Writer({k: v for k, v in self.integers.items() if k != str(variable)}, self.complex_names, self.calls)
        text = inside.write(body)
        self.symbols |= inside.symbols - {str(variable)}
        return f"{word}({variable}, {low}, {high}, {text})"

    def derivative(self, body, variable, at, order):
        n = self.number(order)
        if at != variable or n is None or not 0 <= n <= 4 or str(variable) in self.complex_names:
            raise NotExpressed("a derivative")
        text = self.write(body)
        for _ in range(n):
            text = f"D({text}, {variable})"
        return text

    def special(self, head, args):
        if head == "Tan":
            z = self.write(args[0])
            return f"(sin({z})/cos({z}))"
        # The algebra has W; DLMF 7.2.3 and 7.5.1.
        if head in ("Erf", "Erfc", "Erfi"):
            z = self.write(args[0])
            erfc = f"exp(-({z})^2)*W(i*({z}))"
            erfi = f"(-i*(1 - exp(({z})^2)*W(-({z}))))"
            return {"Erfc": f"({erfc})", "Erf": f"(1 - {erfc})", "Erfi": erfi}[head]
        texts = [str(a) for a in args[:-1]]
        if head == "Hypergeometric1F1" and texts == ["Div(1, 2)", "Div(3, 2)"]:
            return f"int(q_, 0, 1, exp({self.write(args[2])}*q_^2))"
        if head == "Hypergeometric1F1" and texts == ["1", "Div(3, 2)"]:
            return f"int(q_, 0, 1, exp({self.write(args[2])}*(1 - q_^2)))"
        if head == "HypergeometricUStar" and texts == ["Div(1, 2)", "Div(1, 2)"]:
            w = self.write(args[2])
            return f"(sqrt({w})*sqrt(pi)*exp({w})*exp(-{w})*W(i*sqrt({w})))"
        if head == "BesselJ" and texts == ["Div(1, 2)"]:
            w = self.write(args[1])
            return f"(sqrt(2/(pi*{w}))*sin({w}))"
        raise NotExpressed(head)


def integer_parameters(assumptions):
    """Parameters that are integers, with the values that are tried."""
    found = {}

    def look(e):
        if e.head() is None:
            return
        if str(e.head()) == "Element":
            variable, where = e.args()
            text = str(where)
            if text in SETS:
                found[str(variable)] = list(SETS[text])
            elif text.startswith("ZZGreaterEqual("):
                low = int(text[len("ZZGreaterEqual("):-1])
                found[str(variable)] = list(range(low, low + 5))
        for a in e.args():
            look(a)

    for e in assumptions:
        look(e)
    return found


def requirements(formula, integers, complex_names):
    """The requirements of one formula for one choice of the integer parameters, and its symbols."""
    calls = {}
    if str(formula.head()) == "Where":
        body, *rest = formula.args()
        for e in rest:
            left, right = e.args()
            calls[left] = right
        formula = body
    if str(formula.head()) != "Equal":
        raise NotExpressed(str(formula.head()))
    writer = Writer(integers, complex_names, calls)
    first, *rest = [writer.write(side) for side in formula.args()]
    return [f"{first} = {side}" for side in rest], writer.symbols


def main(folder, module, out):
    sys.path.insert(0, folder)
    expr = importlib.import_module("pygrim.expr")
    load(folder, module)
    counts = {"definition or picture": 0, "not expressed": 0, "written": 0}
    entries, symbols, missing = [], set(), []
    for entry in expr.all_entries:
        key = entry.get_arg_with_head(expr.ID).args()[0]._text
        formula = entry.get_arg_with_head(expr.Formula)
        if formula is None:
            counts["definition or picture"] += 1
            continue
        formula = formula.args()[0]
        given = entry.get_arg_with_head(expr.Assumptions)
        given = given.args() if given is not None else ()
        integers = integer_parameters(given)
        heads = {str(s) for s in formula.symbols()}
        variables = entry.get_arg_with_head(expr.Variables)
        names = [str(v) for v in variables.args()] if variables is not None else []
        real = " ".join(str(g) for g in given)
        is_real = {n for n in names if f"Element({n}, RR)" in real}
        complex_names = {n for n in names if heads & PARTS and n not in is_real and n not in integers}
        choices = [{}]
        for name, values in integers.items():
            choices = [c | {name: v} for c in choices for v in values]
        try:
            texts = []
            for choice in choices:
                more, used = requirements(formula, choice, complex_names)
                texts += [t for t in more if t not in texts]
                symbols |= used
        except NotExpressed as reason:
            counts["not expressed"] += 1
            missing.append(f"{key} {reason}")
            continue
        counts["written"] += 1
        note = "; ".join(f"{n} = {v[0]}..{v[-1]}" for n, v in integers.items())
        entries.append((key, texts, note))
    with open(out, "w", encoding="utf-8") as f:
        f.write(f'title = "Fungrim, {module}"\nauthors = "F. Johansson and others"\n')
        f.write(f'source = "pygrim/formulas/{module}.py"\n\n[symbols]\n')
        for name in sorted(symbols):
            f.write(f'{name} = "a variable"\n')
        for key, texts, note in entries:
            f.write(f'\n[[entry]]\nid = "{key}"\nplace = "{key}"\nrequires = [\n')
            f.writelines(f'    "{t}",\n' for t in texts)
            f.write("]\n")
            if note:
                f.write(f'note = "For {note} alone."\n')
    print(", ".join(f"{n} {what}" for what, n in counts.items()), file=sys.stderr)
    for line in missing:
        print("not expressed:", line, file=sys.stderr)


def load(folder, module):
    """Runs one module of formulas without its siblings."""
    import types

    package = types.ModuleType("pygrim.formulas")
    package.__path__ = [f"{folder}/pygrim/formulas"]
    sys.modules["pygrim.formulas"] = package
    importlib.import_module(f"pygrim.formulas.{module}")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
