"""mechaudit audit examples/studies/kepler.toml --exec 'python3 examples/studies/candidates/kepler.py'"""

from math import cos, sin

from serve import serve


def eccentric_anomaly(mean, e):
    """Newton's method, which cannot cycle from 0.85 e beyond the mean anomaly."""
    x = mean + 0.85 * e
    for _ in range(12):
        x -= (x - e * sin(x) - mean) / (1.0 - e * cos(x))
    return x


serve("Newton's method", eccentric_anomaly)
