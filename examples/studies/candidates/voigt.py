"""mechaudit audit examples/studies/voigt.toml --exec 'python3 examples/studies/candidates/voigt.py'"""

from cmath import exp
from math import exp as real_exp
from math import floor, log, pi, sqrt

from serve import serve

# Trapezoidal sums of M. Al Azah and S. N. Chandler-Wilde, SIAM J. Numer. Anal. 59, 2021.
STEP = sqrt(pi / 12)
MIDS = [(k + 0.5) * STEP for k in range(16)]
WHOLES = [k * STEP for k in range(1, 16)]


def real_part(z, nodes):
    """The real part of (2ihz/pi) times the sum of exp(-t^2)/(z^2 - t^2), whose terms are positive."""
    z2, square = z * z, abs(z) ** 2
    terms = (real_exp(-t * t) * (square + t * t) / abs(z2 - t * t) ** 2 for t in nodes)
    return 2.0 * STEP / pi * z.imag * sum(terms)


def real_w(z):
    """Re W(z) in the first quadrant."""
    if z.imag >= pi / STEP:
        return real_part(z, MIDS)
    phase = z.real / STEP - floor(z.real / STEP)
    if z.imag < z.real and 0.25 <= phase <= 0.75:
        sums, sign = real_part(z, WHOLES) + STEP * z.imag / (pi * abs(z) ** 2), -1.0
    else:
        sums, sign = real_part(z, MIDS), 1.0
    # The residue of the pole at z.
    return sums + (2.0 * exp(-z * z) / (1.0 + sign * exp(-2j * pi * z / STEP))).real


def both(x, gauss, lorentz):
    scale = 2.0 * sqrt(log(2.0)) / gauss
    h = real_w(complex(abs(x) * scale, lorentz / 2.0 * scale))
    return h * scale / sqrt(pi), h


serve("trapezoidal sums", both)
