#!/usr/bin/env python3
"""Holds certified integrals of random formulas against antiderivatives that are known beforehand, by mpmath.

    python3 reference/independent/random_integrals.py --binary target/release/mechaudit [--integrals 60] [--seed 1]

An antiderivative F that is continuous from a to b is drawn: sums, products and functions of t, of powers and roots
with a branch point at an end (`(t - a)^(1/3)`, `sqrt(b - t)`), and of roots, cube roots and absolute values with a
singularity between the ends. The integral of its derivative has to be F(b) - F(a). Every third integral is of a part
of a complex function: of the real or imaginary part of F', of the derivative of |F|, or of a part of an integral
within. Exit 1 if a value is more than a unit of its 15th digit off, or if less than two thirds have a value.
"""
import argparse
import pathlib
import random
import subprocess
import sys
import tempfile

import mpmath as mp

mp.mp.dps = 60
DIGITS = 15

# Functions of u that are continuous everywhere, and their derivatives.
FUNCTIONS = [
    ("exp(({u})/4)", "exp(({u})/4)/4"),
    ("sin(2*({u}))", "2*cos(2*({u}))"),
    ("cos({u})", "-sin({u})"),
    ("atan({u})", "1/(1 + ({u})^2)"),
    ("tanh({u})", "1/cosh({u})^2"),
    ("erf({u})", "2/sqrt(pi)*exp(-({u})^2)"),
    ("log(2 + ({u})^2)", "2*({u})/(2 + ({u})^2)"),
    ("({u})^2", "2*({u})"),
    ("1/(1 + ({u})^2)", "-2*({u})/(1 + ({u})^2)^2"),
    ("asinh({u})", "1/sqrt(1 + ({u})^2)"),
    ("sqrt(1 + ({u})^2)", "({u})/sqrt(1 + ({u})^2)"),
    ("abs({u})", "if({u} < 0, -1, 1)"),
    ("log(1 + abs({u}))", "if({u} < 0, -1, 1)/(1 + abs({u}))"),
]
# Functions of t on [a, b], with a branch point at an end or a singularity at c between them.
ATOMS = [
    ("t", "1"),
    ("sqrt(t - ({a}))", "1/(2*sqrt(t - ({a})))"),
    ("(t - ({a}))^(3/2)", "3/2*sqrt(t - ({a}))"),
    ("(t - ({a}))^(1/3)", "1/3*(t - ({a}))^(-2/3)"),
    ("({b} - t)^(5/4)", "-5/4*({b} - t)^(1/4)"),
    ("sqrt({b} - t)", "-1/(2*sqrt({b} - t))"),
    ("sqrt(({b} - t)*(t - ({a})))", "(({a}) + ({b}) - 2*t)/(2*sqrt(({b} - t)*(t - ({a}))))"),
    ("(t - ({a}))*log(t - ({a}))", "log(t - ({a})) + 1"),
    ("abs(t - ({c}))", "if(t < {c}, -1, 1)"),
    ("sqrt(abs(t - ({c})))", "(t - ({c}))/(2*abs(t - ({c}))^(3/2))"),
    ("abs(t - ({c}))^(3/2)", "3/2*(t - ({c}))/sqrt(abs(t - ({c})))"),
    ("cbrt(t - ({c}))", "1/(3*cbrt(t - ({c}))^2)"),
    ("fmax(t, {c})", "if(t < {c}, 0, 1)"),
]
# Complex functions of u with two derivatives, holomorphic next to the real line.
COMPLEX = [
    ("exp({k}*{u})", "{k}*exp({k}*{u})", "({k})^2*exp({k}*{u})"),
    ("sin({k}*{u})", "{k}*cos({k}*{u})", "-({k})^2*sin({k}*{u})"),
    ("1/({u} + {z})", "-1/({u} + {z})^2", "2/({u} + {z})^3"),
    ("log({u} + {z})", "1/({u} + {z})", "-1/({u} + {z})^2"),
    ("({u} + {z})^(5/2)", "5/2*({u} + {z})^(3/2)", "15/4*sqrt({u} + {z})"),
]
NAMES = {name: getattr(mp, name) for name in ("exp", "sin", "cos", "atan", "tanh", "erf", "asinh", "sqrt", "pi")}
NAMES |= {"i": mp.j, "re": mp.re, "im": mp.im, "conj": mp.conj}
NAMES |= {"abs": abs, "fmax": max, "cbrt": lambda x: mp.sign(x) * mp.cbrt(abs(x))}
# The only logarithm of zero has zero as a factor.
NAMES |= {"log": lambda x: mp.log(x) if x else x}


def formula(draw, depth, ends):
    """A function and its derivative, as texts."""
    if depth == 0:
        return tuple(part.format(**ends) for part in draw.choice(ATOMS))
    u, du = formula(draw, depth - 1, ends)
    if draw.random() < 0.5:
        f, df = draw.choice(FUNCTIONS)
        return f.format(u=u), f"({df.format(u=u)})*({du})"
    v, dv = formula(draw, draw.randrange(depth), ends)
    sign = draw.choice("+-*")
    if sign == "*":
        return f"({u})*({v})", f"({du})*({v}) + ({u})*({dv})"
    return f"{u} {sign} ({v})", f"{du} {sign} ({dv})"


def at(text, t):
    exact = "".join(f"mpf({part})" if part.isdigit() else part for part in split(text.replace("^", "**")))
    return eval(exact, {"t": t, "mpf": mp.mpf, **NAMES})


def split(text):
    """Runs of digits, and what stands between them."""
    part = ""
    for character in text:
        if part and character.isdigit() != part[-1].isdigit():
            yield part
            part = ""
        part += character
    yield part


def complex_atom(draw, u):
    """A complex function of a real number and its derivatives, as texts."""
    constants = {"k": draw.choice(["i", "(1 + i)", "(i/2 - 1)", "(2 - i)"])}
    constants["z"] = draw.choice(["i", "(1 + i)", "(i/2 - 2)", "(1/3 - 2*i)"])
    return [f"({part.format(u=u, **constants)})" for part in draw.choice(COMPLEX)]


def complex_part(draw, a, b):
    """A part of a complex function as a text, and what its integral has to be."""
    part = draw.choice(["re", "im", "abs", "within"])
    if part == "within":
        # E(b) - E(a) - (b - a) E'(a) is the integral of E'(t) - E'(a).
        state = draw.getstate()
        e, de, _ = complex_atom(draw, "t")
        draw.setstate(state)
        _, _, dde = complex_atom(draw, f"({a} + s*(t - ({a})))")
        part = draw.choice(["re", "im"])
        due = at(e, mp.mpf(b)) - at(e, mp.mpf(a)) - (b - a) * at(de, mp.mpf(a))
        return f"{part}(int(s, 0, 1, (t - ({a}))*{dde}))", NAMES[part](due)
    (f, df, _), (g, dg, _) = complex_atom(draw, "t"), complex_atom(draw, "t")
    if draw.random() < 0.5:
        f, df = f"({f} + {g})", f"({df} + {dg})"
    else:
        f, df = f"({f}*{g})", f"({df}*{g} + {f}*{dg})"
    ends = [NAMES[part](at(f, mp.mpf(t))) for t in (a, b)]
    text = f"re(conj({f})*{df})/abs({f})" if part == "abs" else f"{part}({df})"
    return text, ends[1] - ends[0]


def drawn(draw):
    """An integral as a text, and what it has to be."""
    a = draw.choice([0, 0, -1, 1])
    b = a + draw.choice([1, 2, 3])
    ends = {"a": a, "b": b, "c": f"({a} + {draw.choice([1, 2, 3, 5])}*({b - a})/7)"}
    due = mp.mpf(0)
    is_complex = draw.randrange(3) == 0
    # An integral that is zero has no first digit.
    while not abs(due) > mp.mpf(10) ** -10:
        if is_complex:
            integrand, due = complex_part(draw, a, b)
        else:
            antiderivative, integrand = formula(draw, draw.choice([0, 0, 1, 1, 2]), ends)
            due = at(antiderivative, mp.mpf(b)) - at(antiderivative, mp.mpf(a))
    return f"int(t, {a}, {b}, {integrand})", due


def check(description, drawn, digits, integrals):
    """Holds integrals that are drawn against what they have to be, and ends the program."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", required=True)
    parser.add_argument("--integrals", type=int, default=integrals)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    wrong = decided = 0
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "integrals.toml"
        for _ in range(options.integrals):
            text, due = drawn(draw)
            study.write_text(
                '[inputs]\nx = { from = 0, to = 1 }\n[outputs]\n'
                f'y = {{ is = "{text}", budget = "1 ulp", why = "a random integral" }}\n'
            )
            command = [options.binary, "eval", study, "--digits", str(digits)]
            try:
                ended = subprocess.run(command, input="0.5\n", capture_output=True, text=True, timeout=120)
            except subprocess.TimeoutExpired:
                print(f"no answer: {text}")
                continue
            answer = ended.stdout.strip()
            if answer in ("", "undecided", "nan"):
                print(f"{answer or ended.stderr.strip()}: {text}")
                continue
            decided += 1
            if abs(mp.mpf(answer) - due) > abs(due) * mp.mpf(10) ** (1 - digits):
                wrong += 1
                print(f"wrong: {text} is {mp.nstr(due, digits + 3)}, not {answer}")
    print(f"{decided} of {options.integrals} integrals have a value, {wrong} of them wrong")
    sys.exit(wrong > 0 or 3 * decided < 2 * options.integrals)


if __name__ == "__main__":
    check(__doc__, drawn, DIGITS, 60)
