"""mechaudit audit examples/studies/spring-mass.toml --exec 'python3 examples/studies/candidates/spring-mass.py'"""

from math import hypot, sqrt

from serve import serve


def squares(k11, k12, k21, k22, m11, m12, m21, m22):
    """The eigenvalues of inv(L) K inv(L)' with M = L L'."""
    if k12 != k21 or m12 != m21:
        raise ValueError("not symmetric")
    l11 = sqrt(m11)
    l21 = m12 / l11
    l22 = sqrt(m22 - l21 * l21)
    a = k11 / l11 / l11
    b = (k12 / l11 - a * l21) / l22
    c = (k22 - l21 * (2.0 * k12 / l11 - l21 * a)) / l22 / l22
    middle, half = 0.5 * (a + c), hypot(0.5 * (a - c), b)
    return middle - half, middle + half


serve("closed form", squares)
