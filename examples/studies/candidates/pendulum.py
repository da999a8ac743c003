"""mechaudit audit examples/studies/pendulum.toml --exec 'python3 examples/studies/candidates/pendulum.py'"""

from math import cos, pi, sqrt

from serve import serve


def period(amplitude, length):
    """The arithmetic-geometric mean of 1 and the cosine of half the amplitude."""
    x, y = 1.0, cos(amplitude / 2.0)
    for _ in range(6):
        x, y = (x + y) / 2.0, sqrt(x * y)
    return 2.0 * pi * sqrt(length / 9.80665) / x


serve("arithmetic-geometric mean", period)
