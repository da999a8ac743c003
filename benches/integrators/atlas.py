#!/usr/bin/env python3
"""An atlas of integrators: work and error on studies with [ode], against certified states.

    python3 benches/integrators/atlas.py --binary target/release/mechaudit > benches/integrators/atlas.csv

scipy's methods run in this interpreter, on right-hand sides that are those of the files in examples/studies/motion, compiled to
one Python function each; those of the Rust crates run in the program of this folder, which is built first. The error is the
largest difference from the certified state at the end over the largest state. Times are processor time, the best of three
runs. Needs numpy and scipy.
"""
import argparse
import csv
import io
import itertools
import math
import pathlib
import re
import subprocess
import sys
import time
import tomllib
from fractions import Fraction

import numpy as np
from scipy.integrate import solve_ivp

HERE = pathlib.Path(__file__).resolve().parent
FOLDER = HERE.parents[1] / "examples/studies/motion"

# Study, inputs, end; the last two are stiff.
PROBLEMS = [
    ("lorenz", {}, "10"),
    ("kepler-orbit", {}, "20"),
    ("arenstorf", {}, "17.0652165601579625588917206249"),
    ("pleiades", {}, "3"),
    ("van-der-pol", {"mu": "10"}, "20"),
    ("hires", {}, "321.8122"),
]
METHODS = ["RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA"]
STIFF = {"Radau", "BDF", "LSODA"}
TOLERANCES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13]
# A run that takes more evaluations is given up.
MOST = 200_000


class TooMany(Exception):
    pass


def python(text):
    """A formula of a study in Python."""
    text = re.sub(r"(?<![\w.])(\d+(?:\.\d*)?(?:e[+-]?\d+)?)/(\d+)(?![\w.])", r"(\1/\2)", str(text))
    return text.replace("^", "**")


def problem(name, inputs):
    """The right-hand side and the start of a study, in double precision."""
    study = tomllib.loads((FOLDER / f"{name}.toml").read_text())
    states = study["ode"]["states"]
    time_name = study["ode"].get("time", "t")
    lines = [f"def rhs({time_name}, y_):", f"    {', '.join(states)}, = y_.tolist()"]
    given = {**study.get("parameters", {}), **inputs}
    scope = {**vars(math), **{k: eval(python(v), dict(vars(math))) for k, v in given.items()}}
    lets = dict(study.get("let", {}))
    # A name comes after those it uses.
    while lets:
        ready = [k for k, v in lets.items() if not set(re.findall(r"[A-Za-z_]\w*", v)) & (set(lets) - {k})]
        lines += [f"    {k} = {python(lets.pop(k))}" for k in ready]
    lines.append(f"    return [{', '.join(python(s['rate']) for s in states.values())}]")
    exec("\n".join(lines), scope)
    start = [float(eval(python(s["start"]), scope)) for s in states.values()]
    return scope["rhs"], np.array(start), list(states)


def certified(binary, name, inputs, end, digits=20):
    """The certified states at the end."""
    sets = [word for k, v in inputs.items() for word in ("--set", f"{k}={v}")]
    command = [binary, "motion", FOLDER / f"{name}.toml", "--times", end, "--digits", str(digits), "--format", "csv"]
    done = subprocess.run([*command, *sets], capture_output=True, text=True)
    row = next(csv.DictReader(io.StringIO(done.stdout)), None)
    if done.returncode != 0 or row is None:
        sys.exit(f"{name}: no certified states: {done.stderr.strip()}")
    return row


def run(rhs, start, end, method, tolerance):
    """The end of a run, evaluations, and the best of three times."""
    count = 0

    def counted(t, y):
        nonlocal count
        count += 1
        if count > MOST:
            raise TooMany
        return rhs(t, y)

    best = math.inf
    for _ in range(3):
        count = 0
        begin = time.process_time()
        done = solve_ivp(counted, (0.0, end), start, method=method, rtol=tolerance, atol=tolerance * 1e-3)
        best = min(best, time.process_time() - begin)
        if not done.success:
            return None
        if best > 5:
            break
    return done.y[:, -1], done.nfev, best


def scipy_runs(name, inputs, end):
    """Method, tolerance, states, evaluations and seconds of scipy's runs; no states where one is given up."""
    rhs, start, _ = problem(name, inputs)
    for method in METHODS:
        for tolerance in TOLERANCES:
            # scipy raises a smaller one to 100 units of rounding.
            if name == "hires" and method not in STIFF and tolerance < 1e-9:
                continue
            try:
                found = run(rhs, start, float(Fraction(end)), method, tolerance)
            except TooMany:
                found = None
            yield f"scipy {method}", tolerance, *(found or (None, "", ""))


def crates():
    """The runs of the Rust crates by problem."""
    command = ["cargo", "run", "--quiet", "--release", "--manifest-path", HERE / "Cargo.toml"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    runs = {}
    for name, method, tolerance, count, seconds, *states in csv.reader(io.StringIO(done.stdout)):
        states = [float(s) for s in states] or None
        runs.setdefault(name, []).append((method, float(tolerance), states, count, seconds and float(seconds)))
    return runs


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--binary", default="target/release/mechaudit")
    parser.add_argument("--problems", nargs="*", default=[p[0] for p in PROBLEMS])
    args = parser.parse_args()
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("problem method tolerance error evaluations seconds".split())
    of_crates = crates()
    for name, inputs, end in PROBLEMS:
        if name not in args.problems:
            continue
        row = certified(args.binary, name, inputs, end)
        truth = [Fraction(row[s]) for s in problem(name, inputs)[2]]
        size = max(abs(x) for x in truth)
        for method, tolerance, y, count, seconds in itertools.chain(of_crates[name], scipy_runs(name, inputs, end)):
            if y is None or not all(map(math.isfinite, y)):
                out.writerow([name, method, tolerance, "", "", ""])
                continue
            error = max(abs(Fraction(float(a)) - b) for a, b in zip(y, truth)) / size
            out.writerow([name, method, tolerance, f"{float(error):.2e}", count, f"{seconds:.2e}"])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
