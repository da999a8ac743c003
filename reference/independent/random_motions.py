#!/usr/bin/env python3
"""Holds certified motions of random initial value problems against solutions in closed form, by mpmath.

    python3 reference/independent/random_motions.py --binary target/release/mechaudit [--problems 12] [--seed 1]

Three kinds of problems, each with a solution that is known before the equation is written. *Composed*: states u_i(t)
are drawn, and the rate of y_i is u_i' with terms that vanish where the states are as drawn. *Bilinear*: a mass on a
spring of another stiffness on either side. *Friction*: a spring and dry friction, for as long as the body moves.
Exit 1 if a value is more than a unit of its 20th digit off, or is not decided.
"""
import argparse
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import mpmath as mp

mp.mp.dps = 50
DIGITS = 20

# A function of t and its derivative.
TERMS = [
    ("sin({a}*t)", "{a}*cos({a}*t)"),
    ("cos({a}*t)", "-{a}*sin({a}*t)"),
    ("exp({a}*t/4)", "{a}/4*exp({a}*t/4)"),
    ("1/(1 + t^2)", "-2*t/(1 + t^2)^2"),
    ("log(2 + t)", "1/(2 + t)"),
    ("sqrt(1 + t)", "1/(2*sqrt(1 + t))"),
]
# Terms that vanish with the difference d of a state from what was drawn, beside a state y.
VANISHING = [
    "{d}", "sin({d})", "({d})^3", "({d})*exp(-({d}))", "tanh({d})", "({d})/(1 + ({d})^2)", "atan({d})", "({d})*{y}",
    "({d})*cos(t*{y})", "({d})*abs({y})", "({d})*if({y} > 0, 1, 2)", "({d})*fmax({y}, 0.2)", "erf({d})", "asinh({d})",
    "log1p(({d})^2)", "({d})*sqrt(1 + {y}^2)",
]
FUNCTIONS = {name: getattr(mp, name) for name in ("sin", "cos", "exp", "log", "sqrt")}


def value(text, t):
    exact = re.sub(r"\d+(\.\d+)?", lambda m: f"mpf('{m[0]}')", text.replace("^", "**"))
    return eval(exact, {"t": t, "mpf": mp.mpf, **FUNCTIONS})


def composed(draw):
    drawn = []
    for _ in range(draw.randint(1, 3)):
        terms = [draw.choice(TERMS) for _ in range(draw.randint(1, 3))]
        sizes = [draw.choice(["1", "2", "0.5", "1.3", "3"]) for _ in terms]
        both = [" + ".join(f"({term[k].format(a=a)})" for term, a in zip(terms, sizes)) for k in (0, 1)]
        drawn.append(both)
    states = []
    for k, (u, rate) in enumerate(drawn):
        for _ in range(draw.randint(0, 2)):
            j = draw.randrange(len(drawn))
            term = draw.choice(VANISHING).format(d=f"y{j} - ({drawn[j][0]})", y=f"y{j}")
            rate += f" - {draw.choice(['1', '0.5', '0.3'])}*({term})"
        states.append((f"y{k}", re.sub(r"\bt\b", "(0)", u), rate))
    return states, lambda t: [value(u, t) for u, _ in drawn]


def bilinear(draw):
    x0, right, left = (draw.choice(c) for c in (["0.3", "1", "2"], ["1", "4", "2.5"], ["0.3", "1.7", "9"]))
    states = [("x", x0, "v"), ("v", "0", f"-if(x > 0, {right}, {left})*x")]
    a, b = mp.sqrt(mp.mpf(right)), mp.sqrt(mp.mpf(left))
    speed = mp.mpf(x0) * a

    def at(t):
        # From the last crossing to the right on; the motion begins half a right half-swing after one.
        s = mp.fmod(t + mp.pi / (2 * a), mp.pi / a + mp.pi / b)
        w, s, sign = (a, s, 1) if s < mp.pi / a else (b, s - mp.pi / a, -1)
        return [sign * speed / w * mp.sin(w * s), sign * speed * mp.cos(w * s)]

    return states, at


def friction(draw):
    k, mu, x0 = draw.choice(["1", "4", "2.5"]), "0.05", draw.choice(["1", "1.5", "2"])
    states = [("x", x0, "v"), ("v", "0", f"-{k}*x - {mu}*copysign(1, v)")]
    w, off = mp.sqrt(mp.mpf(k)), mp.mpf(mu) / mp.mpf(k)

    def at(t):
        swings = int(mp.floor(t * w / mp.pi))
        x, centre = mp.mpf(x0), off
        for _ in range(swings):
            x, centre = 2 * centre - x, -centre
        assert abs(x) > off, "the body stands still"
        angle = w * t - swings * mp.pi
        return [centre + (x - centre) * mp.cos(angle), -(x - centre) * w * mp.sin(angle)]

    return states, at


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=pathlib.Path, required=True)
    parser.add_argument("--problems", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    draw = random.Random(args.seed)
    times = ["0.5", "1", "2.25", "4.7"]
    wrong = compared = 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(args.problems):
            states, at = (composed, bilinear, friction)[number % 3](draw)
            rows = "\n".join(f'{name} = {{ start = "{start}", rate = "{rate}" }}' for name, start, rate in states)
            study = pathlib.Path(folder) / "motion.toml"
            study.write_text(f'[ode]\nuntil = "5"\n[ode.states]\n{rows}\n')
            line = [args.binary, "eval", study, "--digits", str(DIGITS)]
            found = subprocess.run(line, input="\n".join(times), capture_output=True, text=True, timeout=600)
            answers = found.stdout.split()
            if len(answers) != len(times):
                sys.exit(f"{rows}\n{found.stderr}")
            for t, answer in zip(times, answers):
                for due, text in zip(at(mp.mpf(t)), answer.split(","), strict=True):
                    compared += 1
                    near = text != "undecided" and abs(mp.mpf(text) - due) <= abs(due) * mp.mpf(10) ** (1 - DIGITS)
                    if not near:
                        wrong += 1
                        print(f"at {t}: {text}, due {mp.nstr(due, DIGITS)}\n{rows}\n{found.stderr}")
    print(f"{compared} values of {args.problems} motions, {wrong} wrong or undecided")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
