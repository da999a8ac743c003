#!/usr/bin/env python3
"""Functions of balls against balls of Arb (python-flint).

    python3 reference/independent/elementary.py [--balls 300] [--seed 1] [--function sin,tgamma] [--rectangles]
        [--binary PROGRAM]

The example `elementary` of the references answers random operands: narrow balls and wide ones, exact numbers, poles,
zeros, ends of domains, integers and halves, huge and tiny numbers. At the midpoint and at other exact points of the
operands the value of Arb has to meet the ball that was answered, at a precision that grows until Arb's radius is small
beside the answer's. A function said to be undefined has to be undefined at each of these points, one that overflows has
to be beyond 2^(2^30 - 2) with that sign, and an exact operand is undecided only where it is huge. Prints JSON with what
does not hold and, for narrow balls, how much wider the answer is than the values are apart and rounding allows. Exits
with 1 if anything does not hold.

With `--rectangles` the operands are wide, thin, tiny and huge rectangles of numbers of 53 bits, and the points are their
corners, points of their edges and others inside. `of_arb` is the answer's width over that of Arb's own enclosure.
"""

import argparse
import collections
import itertools
import json
import math
import random
import subprocess
import sys
from fractions import Fraction

from flint import acb, acb_series, arb, ctx

#: Bits at which a value is given up.
MOST = 1 << 14
#: Points of the operands for each answer.
POINTS = 4
#: Exponents beyond which a point is not formed exactly.
SPAN = 6000


class Dyadic:
    """m 2^e, exactly."""

    def __init__(self, m, e=0):
        self.m, self.e = m, e

    def __add__(self, other):
        e = min(self.e, other.e)
        return Dyadic((self.m << (self.e - e)) + (other.m << (other.e - e)), e)

    def top(self):
        """The exponent of the leading bit, and one."""
        return self.m.bit_length() + self.e if self.m else 0

    def arb(self):
        return arb(0) if self.m == 0 else arb((self.m, self.e))

    def cmp(self, n):
        """The sign of the difference from an integer."""
        if self.m == 0 or n == 0 or (self.m < 0) != (n < 0) or self.top() > 64:
            return (self.m > 0) - (self.m < 0) if self.m else (n < 0) - (n > 0)
        if self.top() < -64:
            return (n < 0) - (n > 0)
        d = (self + Dyadic(-n)).m
        return (d > 0) - (d < 0)

    def is_integer(self):
        return self.m == 0 or self.e >= 0 or self.m & ((1 << min(-self.e, self.m.bit_length() + 1)) - 1) == 0

    def odd(self):
        return self.e <= 0 and self.m >> -self.e & 1 == 1

    def floor(self):
        return self.m << self.e if self.e >= 0 else self.m >> -self.e

    def __neg__(self):
        return Dyadic(-self.m, self.e)


HALF = Dyadic(1, -1)


def f_round(x):
    return -f_round(-x) if x.m < 0 else (x + HALF).floor()


def f_even(x):
    n = (x + HALF).floor()
    tie = Dyadic(n) + -HALF
    return n - (n & 1) if (tie + -x).m == 0 else n


def f_trunc(x):
    return -((-x).floor()) if x.m < 0 else x.floor()


def aligned(x, y):
    e = min(x.e, y.e)
    return x.m << (x.e - e), y.m << (y.e - e), e


def f_fmod(x, y):
    a, b, e = aligned(x, y)
    r = abs(a) % abs(b)
    return Dyadic(-r if a < 0 else r, e).arb()


def f_remainder(x, y):
    a, b, e = aligned(x, y)
    b = abs(b)
    n, r = divmod(a, b)
    if 2 * r > b or (2 * r == b and n & 1):
        r -= b
    return Dyadic(r, e).arb()


def f_pow(x, y):
    if y.m == 0:
        return arb(1)
    if x.m == 0:
        return arb(0)
    size = (y.arb() * abs(x.arb()).log()).exp()
    return -size if x.m < 0 and y.odd() else size


def f_lgamma(x):
    v = x.arb()
    return v.lgamma() if x.m > 0 else (arb.pi() / (v.sin_pi() * (1 - v).gamma())).__abs__().log()


def f_gamma(x):
    v = x.arb()
    return v.gamma() if x.m > 0 else arb.pi() / (v.sin_pi() * (1 - v).gamma())


def faddeeva(z):
    return (-z * z).exp() * (acb(0, -1) * z).erfc()


def f_voigt(x, s, g):
    x, s, g = x.arb(), s.arb(), g.arb()
    if s == 0:
        return g / (arb.pi() * (x * x + g * g))
    return faddeeva(acb(x, g) / (s * arb(2).sqrt())).real / (s * (2 * arb.pi()).sqrt())


def f_atan2(y, x):
    if y.m == 0:
        return arb.pi() if x.m < 0 else arb(0)
    return arb.atan2(y.arb(), x.arb())


def one(name):
    return lambda x: getattr(x.arb(), name)()


def through(f):
    return lambda *all: f(*(x.arb() for x in all))


def whole(f):
    return lambda x: arb(f(x))


def always(*_):
    return True


def nonnegative(x):
    return x.m >= 0


def positive(x):
    return x.m > 0


def in_unit(x):
    return x.cmp(1) <= 0 <= x.cmp(-1)


def no_pole(x):
    return x.m > 0 or not x.is_integer()


def pow_defined(x, y):
    if y.m == 0 or x.m > 0:
        return True
    return y.m > 0 if x.m == 0 else y.is_integer()


def second(_, y):
    return y.m != 0


def first(which):
    return lambda x, y: x if which(x, y) else y


def less(x, y):
    return (x + -y).m < 0


#: Name: value at exact points, whether there is one, and special places of each operand.
FUNCTIONS = {
    "sqrt": (one("sqrt"), nonnegative, [[0, 1, 4]]),
    "cbrt": (through(lambda x: x.root(3) if x > 0 else -(-x).root(3) if x < 0 else x), always, [[0, 1, -8]]),
    "exp": (one("exp"), always, [[0, 1, -700, 700, 744261117, -744261118]]),
    "exp2": (through(lambda x: (x * arb(2).log()).exp()), always, [[0, 1, -5, 1073741822, -1073741824]]),
    "exp10": (through(lambda x: (x * arb(10).log()).exp()), always, [[0, 1, -5, 323228496]]),
    "expm1": (one("expm1"), always, [[0, 1, -50, 700]]),
    "log": (one("log"), positive, [[0, 1, 2]]),
    "log2": (through(lambda x: x.log() / arb(2).log()), positive, [[0, 1, 2, 1024]]),
    "log10": (through(lambda x: x.log() / arb(10).log()), positive, [[0, 1, 10, 1000]]),
    "log1p": (one("log1p"), lambda x: x.cmp(-1) > 0, [[0, 1, -1]]),
    "sin": (one("sin"), always, [[0, math.pi / 2, math.pi, 100]]),
    "cos": (one("cos"), always, [[0, math.pi / 2, math.pi, 100]]),
    "tan": (one("tan"), always, [[0, math.pi / 2, -math.pi / 2, math.pi]]),
    "sinpi": (one("sin_pi"), always, [[0, 0.5, 1, -7.5]]),
    "cospi": (one("cos_pi"), always, [[0, 0.5, 1, -7.5]]),
    "tanpi": (one("tan_pi"), lambda x: Dyadic(2 * x.m, x.e).is_integer() is False or x.is_integer(), [[0, 0.5, 1, -7.5]]),
    "asin": (one("asin"), in_unit, [[0, 1, -1]]),
    "acos": (one("acos"), in_unit, [[0, 1, -1]]),
    "atan": (one("atan"), always, [[0, 1, -1]]),
    "sinh": (one("sinh"), always, [[0, 1, -20]]),
    "cosh": (one("cosh"), always, [[0, 1, -20]]),
    "tanh": (one("tanh"), always, [[0, 1, -20, 100]]),
    "asinh": (one("asinh"), always, [[0, 1, -20]]),
    "acosh": (one("acosh"), lambda x: x.cmp(1) >= 0, [[1, 2, 20]]),
    "atanh": (one("atanh"), lambda x: x.cmp(1) < 0 < x.cmp(-1), [[0, 1, -1]]),
    "erf": (one("erf"), always, [[0, 1, -3, 8]]),
    "erfc": (one("erfc"), always, [[0, 1, -3, 8, 27]]),
    "erfcx": (through(lambda x: (x * x).exp() * x.erfc()), always, [[0, 1, -3, 8, 27, 1e5, -3e4]]),
    "erfi": (one("erfi"), always, [[0, 1, -3, 8, 27, 3e4]]),
    "dawson": (through(lambda x: (-x * x).exp() * x.erfi() * arb.pi().sqrt() / 2), always, [[0, 0.924138873, -0.924138873, 8, 27, 1e3]]),
    "tgamma": (f_gamma, no_pole, [[0, 1, 2, 1.4616321449683622, -1, -2, -7, -30.5, 171]]),
    "lgamma": (f_lgamma, no_pole, [[0, 1, 2, 1.4616321449683622, -1, -2, -7, -30.5, 171]]),
    "digamma": (one("digamma"), no_pole, [[0, 1, 2, 1.4616321449683622, -1, -2, -7, -30.5, 171]]),
    "fabs": (through(abs), always, [[0, 1, -1]]),
    "floor": (whole(lambda x: x.floor()), always, [[0, 1, -1, 0.5, 1000]]),
    "ceil": (whole(lambda x: -((-x).floor())), always, [[0, 1, -1, 0.5, 1000]]),
    "round": (whole(f_round), always, [[0, 0.5, -0.5, 1.5, 2.5, 1000]]),
    "trunc": (whole(f_trunc), always, [[0, 1, -1, 0.5, 1000]]),
    "nearbyint": (whole(f_even), always, [[0, 0.5, -0.5, 1.5, 2.5, 1000]]),
    "recip": (through(lambda x: 1 / x), lambda x: x.m != 0, [[0, 1, 3]]),
    "sqr": (through(lambda x: x * x), always, [[0, 1, 3]]),
    "hypot": (through(lambda x, y: (x * x + y * y).sqrt()), always, [[0, 3], [0, 4]]),
    "pow": (f_pow, pow_defined, [[0, 1, 2, -2, -1], [0, 0.5, 1, 2, -3, 7]]),
    "atan2": (f_atan2, always, [[0, 1, -1], [0, 1, -1]]),
    "fmin": (lambda x, y: (x if less(x, y) else y).arb(), always, [[0, 1], [0, 1]]),
    "fmax": (lambda x, y: (y if less(x, y) else x).arb(), always, [[0, 1], [0, 1]]),
    "fdim": (lambda x, y: arb(0) if less(x, y) else (x + -y).arb(), always, [[0, 1], [0, 1]]),
    "fmod": (f_fmod, second, [[0, 1, 6, 7.5], [0, 1, 3, 2.5]]),
    "remainder": (f_remainder, second, [[0, 1, 6, 7.5], [0, 1, 3, 2.5]]),
    "copysign": (lambda x, y: -abs(x.arb()) if y.m < 0 else abs(x.arb()), always, [[0, 1], [0, 1]]),
    "add": (lambda x, y: (x + y).arb(), always, [[0, 1], [0, -1]]),
    "sub": (lambda x, y: (x + -y).arb(), always, [[0, 1], [0, 1]]),
    "mul": (through(lambda x, y: x * y), always, [[0, 1], [0, 3]]),
    "div": (through(lambda x, y: x / y), second, [[0, 1], [0, 3]]),
    "fma": (lambda x, y, z: (Dyadic(x.m * y.m, x.e + y.e) + z).arb(), always, [[0, 2], [0, 3], [0, -6]]),
    "voigt": (
        f_voigt,
        lambda x, s, g: s.m >= 0 and g.m >= 0 and (s.m, g.m) != (0, 0),
        [[0, 1, 20], [0, 1, 0.1], [0, 1, 0.01, 5]],
    ),
}

def nudge(x):
    """A distance from a cut on the side to which its values belong, far below the place on it."""
    return Dyadic(1, min(-3000, 2 * x.top() - 3000))


def beside(f, real=lambda x: False, imaginary=lambda y: False):
    """A function of z with cuts on an axis: on them the limit from above, and from the right."""

    def value(x, y):
        if y.m == 0 and real(x):
            y = nudge(x)
        if x.m == 0 and imaginary(y):
            x = nudge(y)
        return f(acb(x.arb(), y.arb()))

    return value


def beyond_one(x):
    return x.cmp(1) >= 0 or x.cmp(-1) <= 0


def negative(x):
    return x.m <= 0


def plane(name, real=lambda x: False, imaginary=lambda y: False):
    return beside(lambda z: getattr(z, name)(), real, imaginary)


def c_pow(a, b, c, d):
    z, w = acb(a.arb(), b.arb()), acb(c.arb(), d.arb())
    if c.m == 0 and d.m == 0:
        return acb(1)
    if a.m == 0 and b.m == 0:
        return acb(0)
    if d.m == 0 and c.is_integer() and abs(c.floor()) < 1000:
        return z ** c.floor()
    return (w * z.log()).exp()


def off_zero(*all):
    return any(x.m for x in all)


def off_pole(x, y):
    return y.m != 0 or no_pole(x)


def off_one(x, y):
    return y.m != 0 or x.cmp(1) != 0


def off_units(x, y):
    return y.m != 0 or not (x.cmp(1) == 0 or x.cmp(-1) == 0)


UNIT = [[0, 1, -1, 0.5], [0, 1, -1, 0.5]]
WAVES = [[0, math.pi / 2, -math.pi], [0, math.pi / 2, -math.pi]]
BELLS = [[0, 1, -3, 8, 27], [0, 1, -3, 8, 27]]
POLES = [[0, 1, 2, 0.5, -1, -7, -30.5], [0, 1, -3, 20]]

FUNCTIONS |= {
    "complex_exp": (plane("exp"), always, WAVES),
    "complex_expm1": (plane("expm1"), always, WAVES),
    "complex_log": (plane("log"), off_zero, UNIT),
    "complex_log1p": (plane("log1p"), lambda x, y: y.m != 0 or x.cmp(-1) != 0, UNIT),
    "complex_sqrt": (plane("sqrt"), always, UNIT),
    "complex_cbrt": (beside(lambda z: acb(0) if z == 0 else (z.log() / 3).exp()), always, UNIT),
    "complex_recip": (beside(lambda z: 1 / z), off_zero, UNIT),
    "complex_div": (lambda a, b, c, d: acb(a.arb(), b.arb()) / acb(c.arb(), d.arb()), lambda a, b, c, d: off_zero(c, d), UNIT + UNIT),
    "complex_pow": (c_pow, lambda a, b, c, d: (c.m, d.m) == (0, 0) or off_zero(a, b) or c.m > 0, UNIT + [[0, 1, 2, -3, 0.5, 700], [0, 0, 1]]),
    "complex_sin": (plane("sin"), always, WAVES),
    "complex_cos": (plane("cos"), always, WAVES),
    "complex_tan": (plane("tan"), always, WAVES),
    "complex_sinh": (plane("sinh"), always, WAVES),
    "complex_cosh": (plane("cosh"), always, WAVES),
    "complex_tanh": (plane("tanh"), always, WAVES),
    "complex_asin": (plane("asin", real=beyond_one), always, UNIT),
    "complex_acos": (plane("acos", real=beyond_one), always, UNIT),
    "complex_atan": (plane("atan", imaginary=beyond_one), lambda x, y: off_units(y, x), UNIT),
    "complex_asinh": (plane("asinh", imaginary=beyond_one), always, UNIT),
    "complex_acosh": (plane("acosh", real=lambda x: x.cmp(1) <= 0), always, UNIT),
    "complex_atanh": (plane("atanh", real=beyond_one), off_units, UNIT),
    "complex_erf": (plane("erf"), always, BELLS),
    "complex_erfc": (plane("erfc"), always, BELLS),
    "complex_erfi": (plane("erfi"), always, BELLS),
    "complex_erfcx": (beside(lambda z: (z * z).exp() * z.erfc()), always, BELLS),
    "complex_w": (beside(faddeeva), always, BELLS),
    "complex_dawson": (beside(lambda z: (-z * z).exp() * z.erfi() * arb.pi().sqrt() / 2), always, BELLS),
    "complex_tgamma": (plane("gamma"), off_pole, POLES),
    "complex_lgamma": (plane("lgamma", real=negative), off_pole, POLES),
}

ORDERS = [0, 1, 2, 3, 5, 10, 40, -1, -2, 0.5, 1.5, 2.25]
TURNS = [0, 1, -3, 8, 30, 45, 100, -60, 2.404825557695773]
SPREAD = [[0, 1, -3, 8, 30, 60], [0, 1, -3, 8, 30, 60]]


def f_bessel(name):
    """A Bessel function of an order and a number, from above its cut."""

    def value(order, x, y=Dyadic(0)):
        if y.m == 0 and x.m < 0 and not order.is_integer():
            y = nudge(x)
        z, n = acb(x.arb(), y.arb()), acb(order.arb())
        if name == "j":
            return z.bessel_j(n)
        return z.bessel_i(n) if name == "i" else (-z).exp() * z.bessel_i(n)

    return value


def on_line(f):
    return lambda *all: f(*all).real


def of_order(order, x):
    return order.is_integer() or x.m >= 0


def f_zeta(order, x, y=Dyadic(0)):
    n, s = order.floor(), acb(x.arb(), y.arb())
    if max(x.top(), y.top()) > 13:
        # Next to 1; Arb takes long to say so.
        raise ValueError
    if n == 0:
        return s.zeta()
    # python-flint multiplies with the precision of series.
    cap, ctx.cap = ctx.cap, n + 1
    try:
        return acb_series([s, 1], prec=n + 1).zeta()[n] * math.factorial(n)
    finally:
        ctx.cap = cap


def f_pe(a, b, c, d):
    return acb(a.arb(), b.arb()).elliptic_p(acb(c.arb(), d.arb()))


def f_pe_prime(a, b, c, d):
    z, tau = acb(a.arb(), b.arb()), acb(c.arb(), d.arb())
    cap, ctx.cap = ctx.cap, 2
    try:
        return acb_series([z, 1], prec=2).elliptic_p(tau)[1]
    finally:
        ctx.cap = cap


def off_lattice(a, b, c, d):
    """Returns true if a + ib is no m + n(c + id)."""
    a, b, c, d = (Fraction(x.m) * Fraction(2) ** x.e for x in (a, b, c, d))
    return d != 0 and ((b / d).denominator != 1 or (a - b / d * c).denominator != 1)


def above_branch_point(x):
    # Beyond that a number needs more bits to be told from it than are drawn.
    if x.m >= 0:
        return True
    ctx.prec = 2000
    return bool(x.arb() * arb(1).exp() > -1)


LINE = [[0, 1, -1, 5, -20, 100]]
FUNCTIONS |= {
    "airyai": (one("airy_ai"), always, LINE),
    "airyaiprime": (through(lambda x: x.airy_ai(derivative=1)), always, LINE),
    "airybi": (one("airy_bi"), always, LINE),
    "airybiprime": (through(lambda x: x.airy_bi(derivative=1)), always, LINE),
    "si": (one("si"), always, [[0, 1, -3, 60, -1000]]),
    "ci": (one("ci"), positive, [[0, 1, 0.6165, 60, 1000]]),
    "ei": (one("ei"), off_zero, [[0, 1, 0.3725074107813666, -1, 60, -1000]]),
    "e1": (through(lambda x: x.expint(1)), positive, [[0, 1, 60, 1000]]),
    "lambertw": (one("lambertw"), above_branch_point, [[0, 1, -0.36787944117144233, -0.3, math.e, 1000]]),
    "lambertwm1": (
        through(lambda x: x.lambertw(-1)),
        lambda x: x.m < 0 and above_branch_point(x),
        [[0, -0.36787944117144233, -0.3, -0.01]],
    ),
    "zeta": (on_line(lambda x: f_zeta(Dyadic(0), x)), lambda x: x.cmp(1) != 0, [[0, 1, 2, -2, 0.5, 50]]),
    "zetaderivative": (on_line(f_zeta), lambda n, x: x.cmp(1) != 0, [[0], [0, 1, 2, -2, 0.5, 50]]),
    "besselj": (on_line(f_bessel("j")), of_order, [[0], TURNS]),
    "besseli": (on_line(f_bessel("i")), of_order, [[0], TURNS]),
    "besselie": (on_line(f_bessel("ie")), of_order, [[0], TURNS]),
    "complex_airyai": (plane("airy_ai"), always, SPREAD),
    "complex_airyaiprime": (beside(lambda z: z.airy_ai(derivative=1)), always, SPREAD),
    "complex_airybi": (plane("airy_bi"), always, SPREAD),
    "complex_airybiprime": (beside(lambda z: z.airy_bi(derivative=1)), always, SPREAD),
    "complex_si": (plane("si"), always, SPREAD),
    "complex_ci": (plane("ci", real=negative), off_zero, SPREAD),
    "complex_e1": (beside(lambda z: z.expint(1), real=negative), off_zero, SPREAD),
    "complex_lambertw": (plane("lambertw", real=lambda x: x.m < 0 and not above_branch_point(x)), always, UNIT),
    "complex_zeta": (lambda x, y: f_zeta(Dyadic(0), x, y), off_one, [[0, 1, 0.5, -2, 20], [0, 1, 14.134725, 100]]),
    "complex_zetaderivative": (f_zeta, lambda n, x, y: off_one(x, y), [[0], [0, 1, 0.5, -2, 20], [0, 1, 14.134725, 100]]),
    "complex_besselj": (f_bessel("j"), always, [[0], *SPREAD]),
    "complex_besseli": (f_bessel("i"), always, [[0], *SPREAD]),
    "complex_besselie": (f_bessel("ie"), always, [[0], *SPREAD]),
    "complex_weierstrassp": (f_pe, off_lattice, [*UNIT, [0], [0]]),
    "complex_weierstrasspprime": (f_pe_prime, off_lattice, [*UNIT, [0], [0]]),
}

#: Operations on rectangles between doubles, which are undecided where doubles do not bound them.
RECTANGLES = {
    "inverse": FUNCTIONS["complex_recip"],
    "mul": (lambda a, b, c, d: acb(a.arb(), b.arb()) * acb(c.arb(), d.arb()), always, UNIT + UNIT),
    "cube": (beside(lambda z: z**3), always, UNIT),
    "sech": (plane("sech"), always, WAVES),
    "sec": (plane("sec"), always, WAVES),
} | {name: FUNCTIONS[f"complex_{name}"] for name in ("sqrt", "exp", "sinh", "cosh", "sin", "cos")}
FUNCTIONS |= {f"rectangle_{name}": of for name, of in RECTANGLES.items()}

#: Operands that are drawn from a list, by their place.
PICKED = {name: {0: ORDERS} for name in FUNCTIONS if "bessel" in name}
PICKED |= {name: {0: [0, 1, 2, 5]} for name in FUNCTIONS if "zetaderivative" in name}
PICKED |= {name: {2: [0, 0.5, -0.3, 7], 3: [1, 0.875, 0.5, 3]} for name in FUNCTIONS if "weierstrass" in name}
#: Exponents from which an exact operand may be undecided, where they are not those of all.
REACH = {name: 9 for name in FUNCTIONS if "zeta" in name}
REACH |= {name: 4000 for name in FUNCTIONS if name in ("si", "ci", "ei", "e1") or "airy" in name or "bessel" in name or "lambert" in name}

#: Functions whose points are formed as integers.
EXACT = {"floor", "ceil", "round", "trunc", "nearbyint", "fmin", "fmax", "fdim", "fmod", "remainder", "add", "sub", "fma"}
#: Functions with jumps, or whose balls are hulls: their widths are not judged.
HULLS = EXACT | {"copysign", "fabs"}


def number(rng, places, exact):
    """A midpoint (m, e) of some bits near one of these parts of the line."""
    bits = rng.choice([2, 11, 24, 53, 64, 113, 200, 300])
    kind = rng.randrange(10)
    if kind < 3:
        m = round(math.ldexp(rng.choice(places), 200))
        m += rng.choice([0, 0, 1, -1]) << max(0, 200 - rng.randrange(1, 200))
        x = Dyadic(m, -200)
    elif kind < 7:
        x = Dyadic(rng.randrange(-(1 << bits), 1 << bits), -bits + rng.randrange(-4, 7))
    elif kind == 7:
        x = Dyadic(rng.randrange(-20, 21), rng.choice([0, -1]))
    else:
        reach = 900 if exact else rng.choice([60, 200, 1000, 5000, 1 << 18, 1 << 29])
        x = Dyadic(rng.randrange(-(1 << bits), 1 << bits), -bits + rng.randrange(-reach, reach + 1))
    # Rounded to that number of bits; what is at a place needs all of them.
    if kind >= 3 and x.m.bit_length() > bits:
        cut = x.m.bit_length() - bits
        x = Dyadic(x.m >> cut, x.e + cut)
    return max(bits, x.m.bit_length(), 2), x


def radius(rng, x):
    """A radius (r, s) of 53 bits."""
    kind = rng.randrange(8)
    if kind < 2:
        return Dyadic(0)
    m = rng.randrange(1 << 52, 1 << 53)
    top = x.top()
    if kind < 6:
        return Dyadic(m, top - 52 - rng.choice([rng.randrange(1, 400), rng.randrange(1, 80), rng.randrange(8, 30)]))
    if kind == 6:
        return Dyadic(m, min(top, 40) - 52 - rng.randrange(-1, 12))
    return Dyadic(m, -52 - rng.randrange(-6, 70))


def side(rng, places):
    """A midpoint of 53 bits and a radius: a wide, a thin, a tiny or a huge side of a rectangle."""
    if rng.randrange(3) == 0:
        x = Dyadic(round(math.ldexp(rng.choice(places), 53)), -53)
    else:
        reach = rng.choice([2, 6, 6, 12, 300])
        x = Dyadic(rng.randrange(-(1 << 53), 1 << 53), -53 + rng.randrange(-reach, reach + 1))
    size = max(x.top(), -2) if rng.randrange(2) else x.top()
    below = rng.choice([rng.randrange(-2, 10), rng.randrange(-2, 10), rng.randrange(10, 60)])
    return max(53, x.m.bit_length()), x, Dyadic(rng.randrange(1 << 52, 1 << 53), size - 53 - below)


def rectangle_points(rng, operands):
    """Corners, points of edges and inner points."""
    ends = [(x + -r, x + r) for _, x, r in operands]

    def inside(x, r):
        t = rng.randrange(-(1 << 20), (1 << 20) + 1)
        return x + Dyadic(r.m * t, r.e - 20)

    points = list(itertools.product(*ends))
    for k in range(24):
        point = [inside(x, r) for _, x, r in operands]
        if k < 16:
            place = rng.randrange(len(point))
            point[place] = rng.choice(ends[place])
        points.append(tuple(point))
    return points


class Interval(Dyadic):
    """A midpoint with the operand's whole ball as its value in Arb."""

    def __init__(self, x, r):
        super().__init__(x.m, x.e)
        self.r = r

    def arb(self):
        return super().arb() + arb(0, self.r.arb())


def draws(rng, x, r):
    """Exact points of the ball: its midpoint, its ends, and others between them."""
    points = [x]
    if r.m and abs(x.e - r.e) < SPAN:
        points += [x + r, x + -r]
        for _ in range(POINTS):
            t = rng.randrange(-(1 << 20), (1 << 20) + 1)
            points.append(x + Dyadic(r.m * t, r.e - 20))
        if x.top() < 60 and r.top() > -200:
            # An integer or a half beside the midpoint, where it is inside.
            near = Dyadic(f_round(Dyadic(2 * x.m, x.e)), -1)
            d = near + -x
            if (Dyadic(abs(d.m), d.e) + -r).m <= 0:
                points.append(near)
    return points


def parts_of(value):
    return [value.real, value.imag] if isinstance(value, acb) else [value]


def all_meet(value, balls):
    """Whether each component meets its ball; none if one is too wide to tell."""
    found = [meets(v, mid, rad) for v, (mid, rad) in zip(parts_of(value), balls, strict=True)]
    return False if False in found else None if None in found else True


def meets(value, mid, rad):
    """Whether a value of Arb meets a ball; none if it is too wide to tell."""
    d = abs(value - mid)
    if d > rad:
        return False
    if not value.is_finite():
        return None
    return True if d <= rad or value.rad() * 1024 <= rad else None


def at(f, points, judge, bits):
    """A verdict at a precision that grows until there is one."""
    while bits <= MOST:
        ctx.prec = bits
        try:
            found = judge(f(*points))
        except (ValueError, ZeroDivisionError, OverflowError):
            found = None
        if found is not None:
            return found
        bits *= 2
    return None


def written(bits, x, r):
    return f"{bits} {x.m} {x.e} {r.m} {r.e}"


def check(name, count, seed, program, rectangles=False):
    f, defined, places = FUNCTIONS[name]
    rng = random.Random(f"{seed}/{name}")
    exact = name in EXACT
    cases = []
    for _ in range(count):
        operands = []
        for k, p in enumerate(places):
            picked = PICKED.get(name, {}).get(k)
            if picked:
                x = Dyadic(round(math.ldexp(rng.choice(picked), 60)), -60)
                operands.append((64, x, Dyadic(0)))
                continue
            if rectangles:
                operands.append(side(rng, p))
                continue
            bits, x = number(rng, p, exact)
            operands.append((bits, x, radius(rng, x)))
        prec = rng.choice([53, 64, 128] if rectangles else [2, 24, 53, 64, 100, 128, 256, 300])
        cases.append((prec, operands))
    lines = [f"{name} {prec} " + " ".join(written(*o) for o in operands) for prec, operands in cases]
    run = subprocess.run([program], input="\n".join(lines) + "\n", capture_output=True, text=True, check=False)
    answers = run.stdout.splitlines()
    tally = collections.Counter()
    wrong, ratios, of_arb = [], [], []
    if len(answers) != len(lines):
        return tally, [[lines[min(len(answers), len(lines) - 1)], run.stderr[-300:]]], ratios, of_arb
    for line, (prec, operands), answer in zip(lines, cases, answers, strict=True):
        if rectangles:
            all_points = rectangle_points(rng, operands)
        else:
            drawn = [draws(rng, x, r) for _, x, r in operands]
            size = max(map(len, drawn))
            all_points = [tuple(d[k] if k < len(d) else rng.choice(d) for d in drawn) for k in range(size)]
        words = answer.split()
        tally[words[0] if words[0].isalpha() else "ball"] += 1
        bits = prec + 64 + max(0, *(min(abs(x.top()), 4000) for _, x, _ in operands))
        if words[0] == "undefined":
            wrong += [[line, "defined", str(p[0].arb())] for p in all_points if defined(*p)]
            continue
        if words[0] == "undecided":
            if all(r.m == 0 for _, _, r in operands) and not name.startswith("rectangle_"):
                reach = REACH.get(name, 4000 if name.startswith("complex_") else 10000)
                huge = max(abs(x.top()) for _, x, _ in operands) > reach
                tally["exact and undecided"] += 1
                if not huge:
                    wrong.append([line, "an exact operand is undecided"])
            continue
        if words[0] == "overflow":
            sign = -1 if words[1] == "-" else 1
            for p in all_points:
                if not defined(*p):
                    wrong.append([line, "overflow where undefined"])
                    continue

                def beyond(v, sign=sign):
                    v = abs(v) if isinstance(v, acb) else v * sign
                    bound = arb((1, (1 << 30) - 2))
                    return True if v >= bound else False if v < bound else None

                found = at(f, p, beyond, bits)
                tally["open"] += found is None
                if found is False:
                    wrong.append([line, "no overflow", str(p[0].arb())])
            continue
        fours = [words[k : k + 4] for k in range(0, len(words), 4)]
        balls = [(Dyadic(int(m), int(e)).arb(), Dyadic(int(float(r)), int(s)).arb()) for m, e, r, s in fours]
        for k, p in enumerate(all_points):
            if not defined(*p):
                wrong.append([line, answer, "undefined at a point", str(p[0].arb())])
                continue
            found = at(f, p, lambda v: all_meet(v, balls), bits)
            tally["points"] += 1
            tally["open"] += found is None
            if found is False:
                wrong.append([line, answer, "outside", k, *(str(x.arb()) for x in p)])
        if rectangles:
            ctx.prec = prec
            try:
                theirs = parts_of(f(*(Interval(x, r) for _, x, r in operands)))
                widths = [rad / their.rad() for their, (_, rad) in zip(theirs, balls, strict=True) if their.is_finite()]
                of_arb += [float(w.mid()) for w in widths if w < 1e300]
            except (ValueError, ZeroDivisionError, OverflowError):
                pass
            continue
        narrow = all(r.m == 0 or (r.top() < -12 and r.top() < x.top() - 12) for _, x, r in operands)
        if name not in HULLS and narrow and len(all_points) > 1 and max(abs(x.top()) for _, x, _ in operands) < 300:
            ctx.prec = 2000
            try:
                values = [f(*p) for p in all_points[:3]]
                spread = max(abs(v - values[0]).abs_upper() for v in values)
                size = max(abs(mid).abs_upper() for mid, _ in balls)
                due = spread + size * arb((1, -prec))
                rad = max(rad for _, rad in balls)
                if rad > 0 and due > 0 and size > 0:
                    ratios.append((float((rad / due).mid()), line))
            except (ValueError, ZeroDivisionError, OverflowError):
                pass
    return tally, wrong, ratios, of_arb


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--balls", type=lambda t: int(float(t)), default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--function", default=",".join(FUNCTIONS))
    parser.add_argument("--rectangles", action="store_true")
    parser.add_argument("--binary", default="target/debug/examples/elementary")
    args = parser.parse_args()
    failed, summary = False, {}
    for name in args.function.split(","):
        tally, wrong, ratios, of_arb = check(name, args.balls, args.seed, args.binary, args.rectangles)
        ratios.sort()
        found = dict(tally)
        if ratios:
            found["wider"] = {"median": round(ratios[len(ratios) // 2][0], 2), "worst": round(ratios[-1][0], 2), "at": ratios[-1][1]}
        if of_arb:
            of_arb.sort()
            found["of_arb"] = {"median": round(of_arb[len(of_arb) // 2], 3), "90 %": float(f"{of_arb[len(of_arb) * 9 // 10]:.3g}")}
        if wrong:
            found["wrong"], found["first"] = len(wrong), wrong[:5]
            failed = True
        summary[name] = found
        print(json.dumps({name: found}), flush=True)
    sys.exit(failed)


if __name__ == "__main__":
    main()
