"""w(z), wrong in many ways: too few terms, refusals, NaN; under a name that has to be escaped."""

import math
import sys

print("# name: <script>alert(1)</script> & \"w\"")
print("# version: 0")


def w(z):
    if not (math.isfinite(z.real) and math.isfinite(z.imag)):
        return complex(math.nan, math.nan)
    if abs(z) < 4:
        total, power = 0j, 1 + 0j
        for n in range(60):
            total += power / math.gamma(n / 2 + 1)
            power *= 1j * z
        return total
    return 1j / math.sqrt(math.pi) / z * (1 + 0.5 / z / z)


for line in sys.stdin:
    try:
        value = w(complex(*map(float.fromhex, line.split(","))))
        print(f"{value.real.hex()},{value.imag.hex()}")
    except (ArithmeticError, ValueError):
        print("refuse out of range")
