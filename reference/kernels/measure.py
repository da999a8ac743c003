#!/usr/bin/env python3
"""Proves every kernel of a file in FPCore and writes a row for each: bounds, published bound, worst found, seconds.

    python3 reference/kernels/measure.py target/release/mechaudit [--file kernels.fpcore] [--only NAME] [--limit 20000]

Inputs are real and rounded first, as in the published bounds (published.csv); a hunt looks at numbers of the format.
"""
import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--file", default=str(HERE / "kernels.fpcore"))
    parser.add_argument("--only")
    parser.add_argument("--limit", default="20000")
    parser.add_argument("--evals", default="2000")
    parser.add_argument("--exact-inputs", action="store_true")
    args = parser.parse_args()
    published = {r["kernel"]: float(r["absolute_error"]) for r in csv.DictReader(open(HERE / "published.csv"))}
    names = re.findall(r"^\(FPCore (\w+)", open(args.file).read(), re.M)
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["kernel", "absolute", "published", "share", "found", "gap", "relative", "relative_gap", "ulps", "boxes", "seconds"])
    for name in names:
        if args.only and name != args.only:
            continue
        line = [args.program, "prove", f"{args.file}#{name}", "--format", "json", "--limit", args.limit, "--evals", args.evals]
        begin = time.time()
        done = subprocess.run(line + ([] if args.exact_inputs else ["--round-inputs"]), capture_output=True, text=True)
        seconds = time.time() - begin
        if not done.stdout:
            out.writerow([name, done.stderr.strip()])
            continue
        v = json.loads(done.stdout)

        def found(measure):
            return (v["witness"][measure] or {}).get("error")

        def ratio(a, b):
            return f"{a / b:.3f}" if a is not None and b else ""

        show = lambda x: "" if x is None else f"{x:.4e}"
        a, r = v["absolute_error"], v["relative_error"]
        boxes = " ".join(str(v["boxes"][m]) for m in ("absolute", "relative", "ulps"))
        out.writerow([name, show(a), show(published.get(name)), ratio(a, published.get(name)), show(found("absolute")),
                      ratio(a, found("absolute")), show(r), ratio(r, found("relative")), show(v["ulps"]), boxes, f"{seconds:.1f}"])
        sys.stdout.flush()


if __name__ == "__main__":
    main()
