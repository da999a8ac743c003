#!/usr/bin/env python3
"""FLINT's 39 example integrals to 30 digits: this project beside FLINT's own program, in one run.

    (cd benches/formulas && cargo build --release --bin integrals)
    sed 's/TIMEIT_ONCE_/TIMEIT_/' FLINT/examples/integrals.c > integrals.c     # repeats short ones
    cc -O2 integrals.c -lflint -lm -o flint-integrals
    python3 benches/compare_integrals.py benches/formulas/target/release/integrals ./flint-integrals

FLINT's program gets `-prec 128 -goal 104` and with that an absolute tolerance of 2^-128, ours 110 bits of the value. A row for each integral: microseconds of processor time of both,
ours over FLINT's, and whether the value of 30 digits lies in FLINT's ball. Exits with 1 if one does not.
"""

import csv
import re
import subprocess
import sys
from fractions import Fraction

#: Integrals of which ours is the imaginary part.
IMAGINARY = {11, 28, 29, 35}
BALL = re.compile(r"\[([^\]\s]*) ?(?:\+/- )?([^\]]*)\]")


def balls(text):
    """Midpoint and radius of the parts of a value of FLINT."""
    for mid, radius in BALL.findall(text):
        if mid == "+/-":
            mid = "0"
        yield Fraction(mid), Fraction(radius or 0)


def flint(program, number):
    try:
        command = [program, "-i", str(number), "-prec", "128", "-goal", "104"]
        out = subprocess.run(command, capture_output=True, text=True, timeout=120).stdout
    except subprocess.TimeoutExpired:
        return None, []
    time = re.search(r"cpu/wall\(s\): (\S+)", out)
    value = re.search(rf"^I{number} = (\[.*)", out, re.M)
    return float(time[1]) * 1e6 if time else None, list(balls(value[1])) if value else []


def main():
    ours, theirs = sys.argv[1:]
    rows = {}
    for row in csv.DictReader(subprocess.run([ours], capture_output=True, text=True).stdout.splitlines()):
        rows[int(row["number"])] = row
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["number", "microseconds", "flint_microseconds", "ratio", "value", "agrees"])
    bad = decided = 0
    for number in range(39):
        time, parts = flint(theirs, number)
        their_time = "" if time is None else f"{time:.1f}"
        row = rows.get(number)
        if row is None:
            table.writerow([number, "", their_time, "", "not in the language", ""])
            continue
        agrees = ratio = ""
        try:
            value = Fraction(row["value"])
            decided += 1
            part = 1 if number in IMAGINARY and len(parts) > 1 else 0
            if parts:
                mid, radius = parts[part]
                off = abs(value - mid) <= radius + abs(value) * Fraction(1, 10**29)
                agrees = "yes" if off else "no"
                bad += not off
            if time:
                ratio = f"{float(row['microseconds']) / time:.2f}"
        except ValueError:
            pass
        table.writerow([number, row["microseconds"], their_time, ratio, row["value"].split(":")[0], agrees])
    print(f"# {decided} of 39 decided, {bad} outside of FLINT's balls")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
