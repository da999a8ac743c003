"""Rounding-error bounds of formulas over boxes, as a second proof beside that of the program.

A formula runs once over a box, forwards with intervals between doubles and backwards with derivatives. Operation i makes
an error in one of two forms, chosen per box: v + theta d_i with |d_i| at most half a unit of the largest result, or
v (1 + theta e_i) with |e_i| <= u where the result comes near zero on one side of it. At theta = 0 that is the exact value,
at theta = 1 what the code computes, so by the mean value theorem the error is at most sum |d_i| |df/dv_i| with the
derivatives on all of the path; nothing of second order is left over. Each end of an interval moves outwards by one
number of binary64 for every rounding to nearest; functions come from Arb.
"""
import math

from flint import arb, fmpq

INF = math.inf
UP = lambda x: math.nextafter(x, INF)
DOWN = lambda x: math.nextafter(x, -INF)

# Units by which results of the GNU C library on x86-64 differ from the exact value: its authors' statement for binary64
# in the sources of exp, log, pow, sin, cos and atan, else half a unit more than sysdeps/x86_64/fpu/libm-test-ulps has.
STATED = {"exp": 0.52, "exp2": 0.52, "log": 0.55, "sin": 0.55, "cos": 0.55, "atan": 0.56}
TESTED = {"tan": 1.5, "expm1": 1.5, "log1p": 1.5, "asin": 1.5, "acos": 1.5, "log2": 2.5, "log10": 2.5,
          "sinh": 2.5, "cosh": 2.5, "tanh": 2.5}


class NoBound(Exception):
    """The box has no bound here."""


def outward(lo, hi):
    if not lo <= hi:
        raise NoBound
    return DOWN(lo), UP(hi)


def size(x):
    return max(abs(x[0]), abs(x[1]))


def least(x):
    return 0.0 if x[0] <= 0.0 <= x[1] else min(abs(x[0]), abs(x[1]))


def plus(a, b, way):
    """A sum and the number beyond it, or the sum alone where it is not rounded."""
    s = a + b
    t = s - a
    return s if (a - (s - t)) + (b - t) == 0.0 else way(s)


def times(a, b, way):
    p = a * b
    if p != p:
        raise NoBound
    is_power = lambda x: abs(math.frexp(x)[0]) == 0.5
    is_exact = a == 0.0 or b == 0.0 or (is_power(a) or is_power(b)) and 1e-300 < abs(p) < INF
    return p if is_exact else way(p)


def add(x, y):
    lo, hi = plus(x[0], y[0], DOWN), plus(x[1], y[1], UP)
    if not lo <= hi:
        raise NoBound
    return lo, hi


def mul(x, y):
    pairs = ((x[0], y[0]), (x[0], y[1]), (x[1], y[0]), (x[1], y[1]))
    return min(times(a, b, DOWN) for a, b in pairs), max(times(a, b, UP) for a, b in pairs)


def div(x, y):
    if y[0] <= 0.0 <= y[1]:
        raise NoBound
    ends = (x[0] / y[0], x[0] / y[1], x[1] / y[0], x[1] / y[1])
    return outward(min(ends), max(ends))


def square(x):
    lo, hi = least(x), size(x)
    return max(DOWN(lo * lo), 0.0), UP(hi * hi)


def hull(x, y):
    return min(x[0], y[0]), max(x[1], y[1])


def ball(x):
    return arb(x[0]).union(arb(x[1]))


def ends_of(value):
    lo, hi = float(value.lower()), float(value.upper())
    return outward(lo, hi)


def rising(name):
    """A function that does not fall: from its values at the ends."""
    def of(x):
        at = [getattr(arb(e), name)() for e in x]
        return outward(DOWN(float(at[0].lower())), UP(float(at[1].upper())))
    return of


def falling(name):
    return lambda x: tuple(-e for e in rising(name)(x))[::-1]


def smooth(name):
    return lambda x: ends_of(getattr(ball(x), name)())


def within_one(name):
    return lambda x: tuple(min(max(e, -1.0), 1.0) for e in smooth(name)(x))


def of_arb(f):
    return lambda x: ends_of(f(ball(x)))


# Values over an interval, and derivatives there.
VALUES = {name: rising(name) for name in ("exp", "expm1", "log", "log1p", "atan", "asin", "sinh", "tanh")}
VALUES |= {"sin": within_one("sin"), "cos": within_one("cos"), "tan": smooth("tan"), "cosh": smooth("cosh"), "acos": smooth("acos"),
           "exp2": of_arb(lambda x: (x * arb.const_log2()).exp()), "log2": of_arb(lambda x: x.log() / arb.const_log2()),
           "log10": of_arb(lambda x: x.log() / arb.const_log10())}
SLOPES = {
    "exp": lambda x: x.exp(), "expm1": lambda x: x.exp(), "exp2": lambda x: (x * arb.const_log2()).exp() * arb.const_log2(),
    "log": lambda x: 1 / x, "log1p": lambda x: 1 / (1 + x), "log2": lambda x: 1 / (x * arb.const_log2()),
    "log10": lambda x: 1 / (x * arb.const_log10()), "sin": lambda x: x.cos(), "cos": lambda x: -x.sin(),
    "tan": lambda x: 1 + x.tan() ** 2, "atan": lambda x: 1 / (1 + x * x), "asin": lambda x: (1 - x * x).rsqrt(),
    "acos": lambda x: -(1 - x * x).rsqrt(), "sinh": lambda x: x.cosh(), "cosh": lambda x: x.sinh(),
    "tanh": lambda x: 1 - x.tanh() ** 2,
}
FORMATS = {"binary64": (53, -1074, 1024), "binary32": (24, -149, 128)}


class Run:
    """The operations of a formula over a box, each behind its operands: the enclosure of all values on the path, the power
    of two of which what is computed is a multiple, the bound of the error made, and the derivatives by the operands."""

    def __init__(self, form):
        self.digits, self.tiny, self.top = FORMATS[form]
        self.is_single = form == "binary32"
        self.path, self.grid, self.error, self.slopes, self.is_exact = [], [], [], [], []

    def push(self, path, grid, error, slopes):
        self.is_exact.append(error == 0.0 and all(self.is_exact[j] for j, _ in slopes))
        for kept, one in zip((self.path, self.grid, self.error, self.slopes), (path, grid, error, slopes)):
            kept.append(one)
        return len(self.path) - 1

    def half_unit(self, most):
        """Half the spacing of numbers at results of at most this size."""
        m, e = math.frexp(most)
        return 2.0 ** max(e - (m == 0.5) - self.digits - 1, self.tiny - 1) if most else 0.0

    def unit(self, x):
        """The unit in the last place of a number."""
        return 2.0 ** max(math.frexp(x)[1] - self.digits, self.tiny) if x else 2.0 ** self.tiny

    def grain(self, x):
        """A power of two of which every number of the format in an interval is a multiple."""
        if x[0] == x[1]:
            n, d = x[0].as_integer_ratio()
            return (n & -n).bit_length() - d.bit_length() if n else self.top
        return max(math.frexp(least(x))[1] - self.digits, self.tiny) if least(x) else self.tiny

    def rounded(self, value, slopes, grid=None, ulps=0.5, underflows=True):
        """The result of an operation whose exact value lies in an interval."""
        most = size(value)
        if not most < 2.0 ** (self.top - 1):
            raise NoBound
        if grid is not None and self.tiny <= grid and most < 2.0 ** min(grid + self.digits, 1023):
            return self.push(value, max(grid, self.grain(value)), 0.0, slopes)
        eta = 2.0 ** (self.tiny - 1) if underflows else 0.0
        error = 2.0 * ulps * self.half_unit(most)
        near = least(value) if value[0] > 0.0 or value[1] < 0.0 else 0.0 if value[0] == 0.0 or value[1] == 0.0 else INF
        if error <= near / 1024 and near < INF or near == INF:
            path = DOWN(value[0] - error), UP(value[1] + error)
        else:
            share = UP(2.0 * ulps) * 2.0 ** -self.digits
            path = mul(value, (DOWN(1.0 - share), UP(1.0 + share)))
            path = (path[0] - eta, path[1] + eta) if eta else (path[0] if value[0] else 0.0, path[1] if value[1] else 0.0)
            error = UP(UP(share * most) + eta)
            slopes = [(j, mul(d, (DOWN(1.0 - share), UP(1.0 + share)))) for j, d in slopes]
        return self.push(path, self.grain(path), error, slopes)

    def constant(self, exact, nearest):
        """A number that the format may round: an enclosure, and what stands for it."""
        off = abs(arb(nearest) - exact)
        lo, hi = float(exact.lower()), float(exact.upper())
        x = hull((nearest, nearest), (lo, hi) if arb(lo) == exact == arb(hi) else outward(lo, hi))
        return self.push(x, self.grain((nearest, nearest)), UP(float(off.upper())) if off != 0 else 0.0, [])

    def input(self, x, is_rounded):
        if not is_rounded:
            return self.push(x, self.grain(x), 0.0, [])
        return self.rounded(x, [])

    def sum(self, a, b, sign=1.0):
        x, y = self.path[a], self.path[b]
        y = y if sign > 0 else (-y[1], -y[0])
        slopes = [(a, (1.0, 1.0)), (b, (sign, sign))]
        grid = min(self.grid[a], self.grid[b])
        same = lambda p, q: p[0] >= q[1] / 2 and p[1] <= 2 * q[0]
        minus = (-y[1], -y[0])
        if same(x, minus) and x[0] > 0 or same((-x[1], -x[0]), y) and y[0] > 0:
            value = add(x, y)  # Sterbenz's lemma.
            return self.push(value, max(grid, self.grain(value)), 0.0, slopes)
        return self.rounded(add(x, y), slopes, grid, underflows=False)

    def product(self, a, b):
        x, y = self.path[a], self.path[b]
        value = square(x) if a == b else mul(x, y)
        slopes = [(a, (2 * x[0], 2 * x[1]))] if a == b else [(a, y), (b, x)]
        grid = self.grid[a] + self.grid[b]
        for p, q in ((x, a), (y, b)):
            # A power of two.
            if p[0] == p[1] and abs(math.frexp(p[0])[0]) == 0.5 and self.error[q] == 0.0:
                other = b if q == a else a
                shifted = self.grid[other] + math.frexp(p[0])[1] - 1
                if shifted >= self.tiny and size(value) < 2.0 ** (self.top - 1):
                    return self.push(value, shifted, 0.0, slopes)
        return self.rounded(value, slopes, grid)

    def quotient(self, a, b):
        x, y = self.path[a], self.path[b]
        value = div(x, y)
        by_b = div(value, y)
        slopes = [(a, div((1.0, 1.0), y)), (b, (-by_b[1], -by_b[0]))]
        grid = None
        if y[0] == y[1] and abs(math.frexp(y[0])[0]) == 0.5 and self.error[b] == 0.0:
            shifted = self.grid[a] - math.frexp(y[0])[1] + 1
            if shifted >= self.tiny:
                return self.push(value, shifted, 0.0, slopes)
        return self.rounded(value, slopes, grid)

    def fma(self, a, b, c):
        x, y, z = self.path[a], self.path[b], self.path[c]
        grid = min(self.grid[a] + self.grid[b], self.grid[c])
        return self.rounded(add(mul(x, y), z), [(a, y), (b, x), (c, (1.0, 1.0))], grid)

    def root(self, a):
        x = self.path[a]
        if x[0] <= 0.0:
            raise NoBound
        value = DOWN(math.sqrt(x[0])), UP(math.sqrt(x[1]))
        return self.rounded(value, [(a, div((0.5, 0.5), value))], underflows=False)

    def negative(self, a):
        x = self.path[a]
        return self.push((-x[1], -x[0]), self.grid[a], 0.0, [(a, (-1.0, -1.0))])

    def absolute(self, a):
        x = self.path[a]
        slope = (1.0, 1.0) if x[0] >= 0 else (-1.0, -1.0) if x[1] <= 0 else (-1.0, 1.0)
        return self.push((least(x), size(x)), self.grid[a], 0.0, [(a, slope)])

    def larger(self, a, b, sign=1.0):
        """The larger of two, or with sign -1 the smaller."""
        x, y = self.path[a], self.path[b]
        if sign < 0:
            x, y = y, x
            first, second = b, a
        else:
            first, second = a, b
        if x[0] >= y[1]:
            return a
        if y[0] >= x[1]:
            return b
        x, y = self.path[a], self.path[b]
        pick = max if sign > 0 else min
        value = pick(x[0], y[0]), pick(x[1], y[1])
        return self.push(value, min(self.grid[a], self.grid[b]), 0.0, [(a, (0.0, 1.0)), (b, (0.0, 1.0))])

    def choice(self, a, b, is_same):
        """Either of two: that of the code may be the other than that of the exact value, or is the same."""
        x, y = self.path[a], self.path[b]
        apart = size(add(x, (-y[1], -y[0]))) if a != b and not is_same else 0.0
        # Between the two at theta = 0, and as far from there as their errors take them.
        away = 0.0 if is_same else max(self.bound(a), self.bound(b))
        path = hull(x, y)
        path = DOWN(path[0] - away), UP(path[1] + away)
        return self.push(path, min(self.grid[a], self.grid[b]), apart, [(a, (0.0, 1.0)), (b, (0.0, 1.0))])

    def smooth(self, name, a):
        x = self.path[a]
        ulps = STATED.get(name) if not self.is_single else {"exp": 1.5}.get(name, TESTED.get(name, 1.5))
        ulps = ulps or TESTED[name]
        return self.rounded(VALUES[name](x), [(a, ends_of(SLOPES[name](ball(x))))], ulps=ulps)

    def power(self, a, b):
        x, y = self.path[a], self.path[b]
        ulps = 1.5 if self.is_single else 0.55
        if y[0] == y[1] == int(y[0]) and abs(y[0]) <= 64:
            k = int(y[0])
            # Powers of a midpoint and a radius cross zero where the interval does not.
            ends = [arb(e) ** k for e in x]
            if x[0] <= 0.0 <= x[1]:
                if k < 0:
                    raise NoBound
                ends.append(arb(0) ** k if k else arb(1))
            value = min(DOWN(float(e.lower())) for e in ends), max(UP(float(e.upper())) for e in ends)
            return self.rounded(value, [(a, ends_of(k * ball(x) ** (k - 1)))], ulps=ulps)
        if x[0] <= 0.0:
            raise NoBound
        p, q = ball(x), ball(y)
        value = (p.log() * q).exp()
        return self.rounded(ends_of(value), [(a, ends_of(value * q / p)), (b, ends_of(value * p.log()))], ulps=ulps)

    def hypot(self, a, b):
        x, y = self.path[a], self.path[b]
        squares = add(square(x), square(y))
        if squares[0] <= 0.0:
            raise NoBound
        h = DOWN(math.sqrt(squares[0])), UP(math.sqrt(squares[1]))
        return self.rounded(h, [(a, div(x, h)), (b, div(y, h))], ulps=1.5)

    def angle(self, a, b):
        y, x = self.path[a], self.path[b]
        squares = add(square(x), square(y))
        if x[0] <= 0.0 <= y[1] and y[0] <= 0.0 or squares[0] <= 0.0:
            raise NoBound
        value = ball(y).atan2(ball(x)) if hasattr(arb, "atan2") else arb.atan2(ball(y), ball(x))
        minus = div(y, squares)
        return self.rounded(ends_of(value), [(a, div(x, squares)), (b, (-minus[1], -minus[0]))], ulps=2.5)

    def bound(self, at):
        """The bound of the error of an operation's result, with all errors before it."""
        by = [None] * (at + 1)
        by[at] = (1.0, 1.0)
        total = 0.0
        for i in range(at, -1, -1):
            if by[i] is None:
                continue
            if self.error[i]:
                total = UP(total + UP(self.error[i] * size(by[i])))
            for j, d in self.slopes[i]:
                part = by[i] if d == (1.0, 1.0) else mul(by[i], d)
                by[j] = part if by[j] is None else add(by[j], part)
        return total
