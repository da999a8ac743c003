"""mechaudit audit examples/studies/colebrook.toml --exec 'python3 examples/studies/candidates/colebrook.py'"""

from math import log, log10

from serve import serve


def inverse_root_of_friction(reynolds, roughness):
    """Newton's method from the explicit formula of S. E. Haaland."""
    a, b = roughness / 3.7, 2.51 / reynolds
    z = -1.8 * log10(a**1.11 + 6.9 / reynolds)
    for _ in range(6):
        s = a + b * z
        z -= (z + 2.0 * log10(s)) / (1.0 + 2.0 * b / (s * log(10.0)))
    return z


serve("Newton's method", inverse_root_of_friction)
