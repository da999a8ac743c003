#!/usr/bin/env python3
"""Proves every core of files in FPCore and writes a row for each: bounds, published bound, worst found, boxes, seconds.

    python3 reference/kernels/measure.py PROGRAM [FILE.fpcore ...] [--only NAME] [--limit 6000] [--evals 1500] [--jobs 1]
    python3 reference/kernels/measure.py PROGRAM FPBench/benchmarks/*.fpcore --straight --exact-inputs --limit 1000

Without files the kernels are those of kernels.fpcore, whose published bounds (published.csv) take inputs for real numbers
that are rounded first; a hunt looks at numbers of the format. --straight takes the cores with `:pre` and without loops
alone. Columns: ratio is a bound divided by the published one, gap by the worst found; domain is finite or not; why, where
there is no bound of the absolute error. Counts stand in the last line of standard error.
"""
import argparse
import concurrent.futures
import csv
import json
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).parent
MEASURES = ("absolute", "relative", "ulps")


def cores(text):
    """The texts of the cores of a file."""
    text = re.sub(r';[^\n]*|"(?:\\.|[^"\\])*"', lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    depth = 0
    for k, c in enumerate(text):
        if c in "([":
            begin = k if depth == 0 else begin
            depth += 1
        elif c in ")]":
            depth -= 1
            if depth == 0:
                yield text[begin:k + 1]


def row(job):
    args, file, number, core, published = job
    name = re.match(r"\(FPCore\s+([^\s()]+)", core)
    name = name[1] if name else str(number)
    command = [args.program, "prove", f"{file}#{number}", "--format", "json", "--limit", args.limit, "--evals", args.evals]
    begin = time.time()
    try:
        done = subprocess.run(command + ([] if args.exact_inputs else ["--round-inputs"]), capture_output=True, text=True,
                              timeout=args.seconds)
        told = done.stderr.strip().split("\n")[-1]
        v = json.loads(done.stdout or "{}")
    except subprocess.TimeoutExpired:
        told, v = f"no answer in {args.seconds:g} s", {}
    out = {"kernel": name, "file": pathlib.Path(file).stem, "seconds": f"{time.time() - begin:.1f}"}
    if not v:
        return out | {"why": told.split(": ", 1)[-1]}
    show = lambda x: "" if x is None else f"{x:.4e}"
    ratio = lambda a, b: f"{a / b:.3f}" if a is not None and b else ""
    found = {m: (v["witness"][m] or {}).get("error") for m in MEASURES}
    bound = {"absolute": v["absolute_error"], "relative": v["relative_error"], "ulps": v["ulps"]}
    for m in MEASURES:
        out |= {m: show(bound[m]), f"{m}_found": show(found[m]), f"{m}_gap": ratio(bound[m], found[m])}
    out |= {"published": show(published.get(name)), "ratio": ratio(bound["absolute"], published.get(name))}
    finite = all(max(abs(lo), abs(hi)) < 1e300 for lo, hi in v["domain"])
    return out | {"domain": "finite" if finite else "infinite", "boxes": " ".join(str(v["boxes"][m]) for m in MEASURES),
                  "why": v["why"] or ""}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("files", nargs="*", default=[str(HERE / "kernels.fpcore")])
    parser.add_argument("--only")
    parser.add_argument("--limit", default="6000")
    parser.add_argument("--evals", default="1500")
    parser.add_argument("--seconds", type=float, default=300, help="given to each core")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--exact-inputs", action="store_true")
    parser.add_argument("--straight", action="store_true")
    args = parser.parse_args()
    published = {r["kernel"]: float(r["absolute_error"]) for r in csv.DictReader(open(HERE / "published.csv"))}
    jobs = []
    for file in args.files:
        for number, core in enumerate(cores(open(file).read()), 1):
            if args.straight and (":pre" not in core or re.search(r"[(\[](while|for|tensor)\b", core)):
                continue
            if args.only in (None, str(number), *re.findall(r"^\(FPCore\s+([^\s()]+)", core)):
                jobs.append((args, file, number, core, published))
    columns = ["file", "kernel", "domain"] + [m + end for m in MEASURES for end in ("", "_found", "_gap")]
    columns += ["published", "ratio", "boxes", "seconds", "why"]
    out = csv.DictWriter(sys.stdout, columns, restval="", lineterminator="\n")
    out.writeheader()
    rows = []
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for found in pool.map(row, jobs):
            rows.append(found)
            out.writerow(found)
            sys.stdout.flush()
    finite = [r for r in rows if r.get("domain") == "finite"]
    count = lambda some, column: sum(1 for r in some if r.get(column))
    near = lambda m: sum(1 for r in rows if r.get(f"{m}_gap") and float(r[f"{m}_gap"]) <= 4)
    print(f"{len(rows)} cores, {len(finite)} with a finite domain, of which {count(finite, 'absolute')} have a bound of the "
          f"absolute error and {count(finite, 'relative')} of the relative one; at most 4 times the worst found: "
          + ", ".join(f"{near(m)} {m}" for m in MEASURES)
          + f"; at most 1.001 times the published one: {sum(1 for r in rows if r.get('ratio') and float(r['ratio']) <= 1.001)}",
          file=sys.stderr)


if __name__ == "__main__":
    main()
