"""Lets mechaudit audit sweep(): one input a line, one answer a line."""

import sys

from sweep import sweep

print("# name: sweep.py\n# version: 0.1.0")
for line in sys.stdin:
    if line.startswith("#"):
        continue
    v = [float.fromhex(field) for field in line.split(",")]
    n = (len(v) + 2) // 4
    if n < 1 or len(v) != 4 * n - 2:
        print("refuse bad layout")
        continue
    try:
        x = sweep(v[: n - 1], v[n - 1 : 2 * n - 1], v[2 * n - 1 : 3 * n - 2], v[3 * n - 2 :])
        print(",".join(value.hex() for value in x))
    except ZeroDivisionError:
        print("refuse singular")
