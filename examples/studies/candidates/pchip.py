"""mechaudit audit examples/studies/pchip.toml --exec 'python3 examples/studies/candidates/pchip.py'"""

from serve import serve


def slope(h1, h2, d1, d2):
    """The weighted harmonic mean of both slopes."""
    if not (d1 > 0.0 and d2 > 0.0 or d1 < 0.0 and d2 < 0.0):
        return 0.0
    return 3.0 * (h1 + h2) / ((2.0 * h2 + h1) / d1 + (h2 + 2.0 * h1) / d2)


serve("harmonic mean", slope)
