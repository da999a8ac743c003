"""Tridiagonal systems: the code that is audited in test_accuracy.py."""


def sweep(lower, diagonal, upper, d):
    """The solution by elimination without pivoting; ZeroDivisionError where a pivot vanishes."""
    pivots, x = list(diagonal), list(d)
    for i in range(1, len(x)):
        factor = lower[i - 1] / pivots[i - 1]
        pivots[i] -= factor * upper[i - 1]
        x[i] -= factor * x[i - 1]
    for i in reversed(range(len(x))):
        if i + 1 < len(x):
            x[i] -= upper[i] * x[i + 1]
        x[i] /= pivots[i]
    return x
