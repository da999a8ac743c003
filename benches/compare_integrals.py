#!/usr/bin/env python3
"""FLINT's 39 example integrals to 30 digits: this project beside FLINT's own program, in one run.

    (cd benches/formulas && cargo build --release --bin integrals)
    sed 's/TIMEIT_ONCE_/TIMEIT_/' FLINT/examples/integrals.c > integrals.c     # repeats short ones
    cc -O2 integrals.c -lflint -lm -o flint-integrals
    python3 benches/compare_integrals.py benches/formulas/target/release/integrals ./flint-integrals

FLINT's program gets `-prec 128 -goal 104` and with that an absolute tolerance of 2^-128, ours 110 bits of the value. Both
take turns. A row for each integral: medians of the microseconds of processor time of both, the median of ours over FLINT's,
and whether the value of 30 digits lies in FLINT's ball. Exits with 1 if one does not.
"""

import csv
import re
import statistics
import subprocess
import sys
import time
from fractions import Fraction

#: No integral has more turns, and none begins another after this time.
TURNS = 7
SECONDS = 4

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
    """Microseconds and value of FLINT's program."""
    try:
        command = [program, "-i", str(number), "-prec", "128", "-goal", "104"]
        out = subprocess.run(command, capture_output=True, text=True, timeout=120).stdout
    except subprocess.TimeoutExpired:
        return None, []
    spent = re.search(r"cpu/wall\(s\): (\S+)", out)
    value = re.search(rf"^I{number} = (\[.*)", out, re.M)
    return float(spent[1]) * 1e6 if spent else None, list(balls(value[1])) if value else []


def ours(program, number):
    """Microseconds and value of this project, None where it has no such formula."""
    out = subprocess.run([program, str(number)], capture_output=True, text=True).stdout
    for row in csv.DictReader(out.splitlines()):
        return float(row["microseconds"]), row["value"]
    return None, None


def main():
    own, their = sys.argv[1:]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["number", "microseconds", "flint_microseconds", "ratio", "value", "agrees"])
    bad = decided = 0
    for number in range(39):
        turns = []
        start = time.monotonic()
        while len(turns) < TURNS and (not turns or time.monotonic() - start < SECONDS):
            spent, value = ours(own, number)
            theirs, parts = flint(their, number)
            if spent is None:
                break
            turns.append((spent, theirs))
        if not turns:
            table.writerow([number, "", "", "", "not in the language", ""])
            continue
        timed = [(a, b) for a, b in turns if b]
        ratio = f"{statistics.median(a / b for a, b in timed):.2f}" if timed else ""
        agrees = ""
        try:
            exact = Fraction(value)
        except ValueError:
            value, ratio = value.split(":")[0], ""
        else:
            decided += 1
            part = 1 if number in IMAGINARY and len(parts) > 1 else 0
            if parts:
                mid, radius = parts[part]
                inside = abs(exact - mid) <= radius + abs(exact) * Fraction(1, 10**29)
                agrees = "yes" if inside else "no"
                bad += not inside
        spent = f"{statistics.median(a for a, _ in turns):.1f}"
        theirs = f"{statistics.median(b for _, b in timed):.1f}" if timed else ""
        table.writerow([number, spent, theirs, ratio, value, agrees])
        sys.stdout.flush()
    print(f"# {decided} of 39 decided, {bad} outside of FLINT's balls")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
