"""What an audit costs beside references and callable alone: processor time, medians of five ratios.

``python benches/overhead.py``
"""

import time

import mechaudit
import numpy as np
import scipy.special
from mechaudit import special
from mechaudit._methods import Description

BLOCK = 4096


def one_by_one(z):
    return complex(special.wofz(z))


def seconds(f):
    start = time.process_time()
    f()
    return time.process_time() - start


def main():
    print("| method | callable | cases | audit / (references + callable) |")
    print("|---|---|---|---|")
    for method, f, name, cases in (
        ("faddeeva", special.wofz, "`wofz`", 2000),
        ("faddeeva", scipy.special.wofz, "scipy's `wofz`, half of whose cases fail", 2000),
        ("faddeeva", one_by_one, "`wofz`, point by point", 500),
        ("voigt", special.voigt_profile, "`voigt_profile`", 2000),
    ):
        ratios = []
        for _ in range(5):
            run = mechaudit._mechaudit.Run(method, seed=1, cases=cases)
            count = len(run)
            description = Description(method)
            block = run.block(0, count)
            if f is one_by_one:
                calls = [(complex(*row),) for row in block]
            else:
                calls = [description.arguments(block[k : k + BLOCK]) for k in range(0, count, BLOCK)]

            def references(run=run, count=count):
                # The method's own solver, in Rust, is a small part of it.
                for k in range(0, count, BLOCK):
                    run.judge_own(k, min(count, k + BLOCK))
                run.finish(False)

            whole = seconds(lambda: mechaudit.audit(method, f, cases=cases, progress=False))
            parts = seconds(references) + seconds(lambda: [f(*call) for call in calls])
            ratios.append(whole / parts)
        print(f"| {method} | {name} | {count} | {np.median(ratios):.2f} |", flush=True)


if __name__ == "__main__":
    main()
