#!/usr/bin/env python3
"""One row for each core of a folder of FPCore files: how far the suite decides it, and how wrong its body is.

    python3 reference/independent/fpcore_table.py FOLDER [--cases 64] [--seconds 60] [--program PROGRAM] [--output TABLE.csv]

Each core is audited by `mechaudit audit FILE.fpcore#NUMBER --ulps 1 --format json`: the body in binary64 against the
certified values of its real function, at random points of its domain, at the ends of the domain and where conditions flip.
Columns: file, number and name of the core, cases, decided and undecided (by the judge, against one ulp), wrong_kind (no
real value where the body gives a number, or the other way round), the worst error of the body in ulps and the input that
shows it, and why a core is refused, or that it took more processor time than allowed. The counts stand in the last line of
standard error; the exit code is 1 if a core is refused.
"""

import argparse
import csv
import io
import json
import os
import pathlib
import re
import resource
import subprocess
import sys

COLUMNS = ["file", "number", "core", "cases", "decided", "undecided", "wrong_kind", "worst_ulps", "input", "refused"]


def short(x):
    return f"{x:.3g}" if isinstance(x, (int, float)) else str(x)


def row_of(program, file, number, cases, seconds):
    """The row of a core."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    command = [program, "audit", f"{file}#{number}", "--ulps", "1", "--cases", str(cases), "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limited)
    row = {"file": file.name, "number": number}
    if not done.stdout.strip():
        told = done.stderr.strip().split("#", 1)[-1].split(": ", 1)[-1]
        return row | {"refused": told or f"no answer in {seconds} s of processor time"}
    method = json.loads(done.stdout)["methods"][0]
    total = method["total"]
    worst, at = None, ""
    for output in total["outputs"]:
        largest = output["ulps"]["max"]
        if output["ulps"]["count"] and (worst is None or largest > worst):
            worst = largest
            cells = [cell for cell in output["histogram"] if cell.get("worst")]
            if cells:
                last = max(cells, key=lambda c: -9999 if c["exponent"] is None else c["exponent"])
                at = " ".join(repr(x) if isinstance(x, float) else str(x) for x in last["worst"]["input"])
    kinds = total["kinds"]
    return row | {
        "core": method["summary"],
        "cases": total["cases"],
        "decided": total["cases"] - total["undecided"] - total["reference_failed"],
        "undecided": total["undecided"] + total["reference_failed"],
        "wrong_kind": sum(kinds.values()),
        "worst_ulps": "" if worst is None else short(worst),
        "input": at,
        "refused": "",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--cases", type=int, default=64)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--program", default="mechaudit")
    parser.add_argument("--output", type=pathlib.Path)
    a = parser.parse_args()
    files = sorted(a.folder.glob("*.fpcore"))
    if not files:
        sys.exit(f"{a.folder}: no .fpcore files")
    rows = []
    for file in files:
        cores = len(re.findall(r"^\s*\(FPCore", file.read_text(), re.M))
        rows += [row_of(a.program, file, k, a.cases, a.seconds) for k in range(1, cores + 1)]
    text = io.StringIO()
    table = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    if a.output:
        temporary = a.output.with_suffix(".tmp")
        temporary.write_text(text.getvalue())
        os.replace(temporary, a.output)
    else:
        sys.stdout.write(text.getvalue())
    audited = [row for row in rows if not row["refused"]]
    counts = {key: sum(row[key] for row in audited) for key in ("cases", "decided", "undecided", "wrong_kind")}
    refused = len(rows) - len(audited)
    print(f"{len(audited)} cores, {refused} refused; " + ", ".join(f"{k} {v}" for k, v in counts.items()), file=sys.stderr)
    sys.exit(1 if refused else 0)


if __name__ == "__main__":
    main()
