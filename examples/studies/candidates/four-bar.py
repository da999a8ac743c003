"""mechaudit audit examples/studies/four-bar.toml --exec 'python3 examples/studies/candidates/four-bar.py'"""

from math import asin, atan2, cos, hypot, pi, sin, sqrt

from serve import serve


def rocker_angle(phi, crank, coupler, rocker):
    """The triangle of coupler, rocker and diagonal, half of its angle by its sides."""
    dx, dy = 1.0 - crank * cos(phi), crank * sin(phi)
    d = hypot(dx, dy)
    half = asin(sqrt((coupler - rocker + d) * (coupler + rocker - d) / (4.0 * rocker * d)))
    return pi - atan2(dy, dx) - 2.0 * half


serve("half angle", rocker_angle)
