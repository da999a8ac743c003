"""mechaudit audit examples/studies/ndtr.toml --exec 'python3 examples/studies/candidates/ndtr.py'"""

from math import erfc, log, log1p, sqrt

from serve import serve


def both(x):
    """By erfc of whichever tail is small; the logarithm of the larger one by log1p."""
    below = erfc(-x / sqrt(2.0)) / 2.0
    if x < 0.0:
        return below, log(below)
    return below, log1p(-erfc(x / sqrt(2.0)) / 2.0)


serve("erfc of the C library", both)
