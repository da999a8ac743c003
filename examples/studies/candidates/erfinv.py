"""mechaudit audit examples/studies/erfinv.toml --exec 'python3 examples/studies/candidates/erfinv.py'"""

from math import copysign, erf, erfc, exp, log1p, pi, sqrt

from serve import serve


def erfinv(y):
    """Newton's method on erf, or on erfc where 1 - |y| is exact."""
    if y == 0.0:
        return y
    a = abs(y)
    logarithm = log1p(-a * a)
    m = 2.0 / (pi * 0.147) + logarithm / 2.0
    x = sqrt(-logarithm / 0.147 / (sqrt(m * m - logarithm / 0.147) + m))
    for _ in range(6):
        residual = erf(x) - a if a < 0.5 else (1.0 - a) - erfc(x)
        x -= residual * sqrt(pi) / 2.0 * exp(x * x)
    return copysign(x, y)


serve("Newton's method", erfinv)
