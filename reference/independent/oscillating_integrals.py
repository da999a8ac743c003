#!/usr/bin/env python3
"""Holds certified integrals of random oscillations up to an end against extrapolated sums by mpmath.

    python3 reference/independent/oscillating_integrals.py --binary target/release/mechaudit [--integrals 40] [--seed 1]

An amplitude that tends to zero and a product of sines and cosines are drawn in u, which is the variable up to
infinity or the inverse of the distance from a finite end. mpmath integrates from zero to zero of the oscillation and
extrapolates (`quadosc`). Exit 1 if a value is more than a unit of its tenth digit off, or if less than two thirds have
a value.
"""
import mpmath as mp
from random_integrals import check, split

# `random_integrals` needs more.
mp.mp.dps = 25
DIGITS = 10

AMPLITUDES = [
    "1/u",
    "1/(u + 3)",
    "1/(u^2 + 2)",
    "u/(u^2 + 1)",
    "1/((u - 3)^2 + 2)",
    "1/sqrt(u + 1)",
    "u^(-3/2)",
    "u^(-1/3)/(1 + 1/u)",
    "sqrt(1 + 1/u)/u",
    "exp(-1/u)/u",
    "exp(1/(1 + u))/(2*u)",
    "log(1 + 1/u)",
    "atan(2/u)",
    "1/((u - 50)^2 + 1)",
]
# Waves, and sums of waves of one frequency each that are equal to them: `quadosc` extrapolates these.
WAVES = [
    ("sin({w}*u)", [("sin({w}*u)", 1)]),
    ("cos({w}*u)", [("cos({w}*u)", 1)]),
    ("sin({w}*u + 1/(1 + u))", [("sin({w}*u + 1/(1 + u))", 1)]),
    ("cos({w}*u - sqrt(1 + 1/u))", [("cos({w}*u - sqrt(1 + 1/u))", 1)]),
    ("sin({w}*u + 1)", [("sin({w}*u + 1)", 1)]),
    ("cos({w}*u)*sin(3*{w}*u)", [("sin(4*{w}*u)/2", 4), ("sin(2*{w}*u)/2", 2)]),
    ("sin({w}*u)^3", [("3*sin({w}*u)/4", 1), ("-sin(3*{w}*u)/4", 3)]),
]


def at(text, u):
    names = {name: getattr(mp, name) for name in ("sin", "cos", "sqrt", "exp", "log", "atan")}
    exact = "".join(f"mpf({part})" if part.isdigit() else part for part in split(text.replace("^", "**")))
    return eval(exact, {"u": u, "mpf": mp.mpf, **names})


def drawn(draw):
    """An integral as a text, and what it has to be."""
    amplitude = draw.choice(AMPLITUDES)
    wave, parts = draw.choice(WAVES)
    frequency = draw.choice([1, 2, 3])
    text = f"({amplitude})*{wave.format(w=frequency)}"
    start = draw.choice([1, 2])
    due = mp.mpf(0)
    for part, multiple in parts:
        part = f"({amplitude})*({part.format(w=frequency)})"
        due += mp.quadosc(lambda u: at(part, u), [start, mp.inf], omega=multiple * frequency)
    place = draw.choice(["inf", "-inf", "above", "below"])
    put = lambda u: text.replace("exp", "EXP").replace("u", u).replace("EXP", "exp")
    if place == "inf":
        return f"int(t, {start}, inf, {put('t')})", due
    if place == "-inf":
        return f"int(t, -inf, -{start}, {put('(-t)')})", due
    a = draw.choice([0, 1, -2])
    if place == "above":
        return f"int(t, {a}, {a} + 1/{start}, {put(f'(1/(t - ({a})))')}/(t - ({a}))^2)", due
    return f"int(t, {a} - 1/{start}, {a}, {put(f'(1/(({a}) - t))')}/(({a}) - t)^2)", due


if __name__ == "__main__":
    check(__doc__, drawn, DIGITS, 40)
