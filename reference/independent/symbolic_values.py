"""The language of `mechaudit identity` in mpmath: texts of expressions read and evaluated at a point.

Roots and arguments are principal values, integrals go along the straight path, a derivative is a difference quotient at
three times the digits. A series of like terms is a sum over four indices with weights of its own: two series that are
equal term by term are equal under any weights, and a product of series is not the series of products.
"""

import functools
import random
from fractions import Fraction

import mpmath as mp

FUNCTIONS = ("exp", "sqrt", "sin", "cos", "W", "re", "im", "abs", "arg", "arctan")
#: What no symbol is called.
CONSTANTS = ("pi", "i", "inf", "each", "n_num")
#: Digits without and with integrals or endless sums; what an integral is accurate to is the third.
DIGITS, DIGITS_OF_INTEGRALS, INTEGRAL = 80, 40, mp.mpf("1e-27")
#: What remains of larger terms is rounding below this; without integrals, below three quarters of the digits.
TRIMMED_INTEGRAL = mp.mpf("1e-22")


class Undefined(Exception):
    """A division by zero, or another value that there is not."""


class Unclear(Exception):
    """Not evaluated here with certainty; nothing follows."""


class Reader:
    """Recursive descent over a text; trees are tuples that begin with their kind."""

    def __init__(self, text):
        self.text, self.at = text, 0

    def peek(self):
        while self.text[self.at : self.at + 1].isspace():
            self.at += 1
        return self.text[self.at : self.at + 1]

    def taken(self, c):
        if self.peek() != c:
            return False
        self.at += 1
        return True

    def expect(self, c):
        if not self.taken(c):
            raise ValueError(f"expected {c!r} at {self.at} in {self.text!r}")

    def run(self, is_so):
        self.peek()
        start = self.at
        while self.at < len(self.text) and is_so(self.text[self.at]):
            self.at += 1
        return self.text[start : self.at]

    def name(self):
        return self.run(lambda c: c.isalnum() or c in "_'")

    def sum(self):
        terms = [("neg", self.product()) if self.taken("-") else self.product()]
        while self.peek() in ("+", "-") and self.peek():
            minus = self.taken("-") or not self.taken("+")
            terms.append(("neg", self.product()) if minus else self.product())
        return terms[0] if len(terms) == 1 else ("add", *terms)

    def product(self):
        out = self.power()
        while self.peek() in ("*", "/") and self.peek():
            kind = "mul" if self.taken("*") else "div"
            if kind == "div":
                self.expect("/")
            out = (kind, out, self.power())
        return out

    def power(self):
        base = self.atom()
        if not self.taken("^"):
            return base
        bracket = self.taken("(")
        sign = -1 if bracket and self.taken("-") else 1
        k = int(self.run(str.isdigit))
        if bracket:
            self.expect(")")
        return ("pow", base, sign * k)

    def arguments(self, kinds):
        self.expect("(")
        out = []
        for k, kind in enumerate(kinds):
            if k:
                self.expect(",")
            out.append(self.name() if kind == "n" else self.sum())
        self.expect(")")
        return out

    def atom(self):
        if self.taken("("):
            inner = self.sum()
            self.expect(")")
            return inner
        if self.peek().isdigit():
            return ("num", self.run(lambda c: c.isdigit() or c == "."))
        name = self.name()
        if name in FUNCTIONS:
            return ("call", name, *self.arguments("e"))
        if name in ("int", "sum"):
            return (name, *self.arguments("neee"))
        if name == "series":
            return ("series", *self.arguments("ne"))
        if name == "at":
            return ("at", *self.arguments("ene"))
        if name == "D" and self.peek() == "(":
            return ("D", *self.arguments("en"))
        if name == "i":
            return ("i",)
        if self.taken("["):
            index = self.sum()
            self.expect("]")
            return ("index", name, index)
        if not name:
            raise ValueError(f"expected an expression at {self.at} in {self.text!r}")
        return ("sym", name)


def read(text):
    """The tree of an expression."""
    reader = Reader(text)
    tree = reader.sum()
    if reader.peek():
        raise ValueError(f"unexpected {reader.peek()!r} in {text!r}")
    return tree


def text_of(tree):
    """A text that reads back, every operation in brackets."""
    kind, *parts = tree
    if kind in ("num", "sym"):
        return parts[0]
    if kind == "i":
        return "i"
    t = [p if isinstance(p, str) else text_of(p) if isinstance(p, tuple) else p for p in parts]
    if kind == "index":
        return f"{t[0]}[{t[1]}]"
    if kind == "neg":
        return f"(-{t[0]})"
    if kind in ("add", "mul", "div"):
        return "(" + {"add": " + ", "mul": "*", "div": "/"}[kind].join(t) + ")"
    if kind == "pow":
        exponent = t[1] if t[1] >= 0 else f"({t[1]})"
        return f"({t[0]})^{exponent}"
    if kind == "call":
        return f"{t[0]}({t[1]})"
    return f"{kind}({', '.join(t)})"


def parts_of(tree):
    """The tree and all trees within it."""
    yield tree
    for part in tree[1:]:
        if isinstance(part, tuple):
            yield from parts_of(part)


class Point:
    """Positive rational values of the symbols, drawn when they are first asked for."""

    def __init__(self, key, kind):
        self.key, self.kind, self.given = key, kind, {}

    def value(self, name):
        if name not in self.given:
            self.given[name] = self.draw(random.Random(f"{self.key}/{name}"))
        return self.given[name]

    def draw(self, rng):
        if self.kind == "wide":
            return Fraction(rng.randrange(100, 1000), 100) * Fraction(10) ** rng.randrange(-4, 4)
        if self.kind == "middle":
            return Fraction(rng.randrange(20, 500), 100)
        if self.kind == "near":
            return 1 + Fraction(rng.randrange(-99, 100), 2000)
        return Fraction(rng.randrange(1, 9), rng.choice((1, 1, 2, 3)))

    def weight(self, k):
        return Fraction(random.Random(f"{self.key}/weight {k}").randrange(1, 400), 97)


class Given(Point):
    """The values at the program's own point. There a series is its term at the index as a symbol, or nothing."""

    def __init__(self, given, terms):
        self.given, self.terms = given, terms

    def value(self, name):
        if name not in self.given:
            raise Unclear(f"no value of {name}")
        return self.given[name]

    weight = None


def rational(q):
    return mp.mpf(q.numerator) / q.denominator


def plain(z):
    """A real number as such."""
    return z.real if isinstance(z, mp.mpc) and z.imag == 0 else z


def legendre(count, digits):
    """Nodes and weights of Gauss and Legendre on (0, 1)."""
    with mp.workdps(digits):
        out = []
        for k in range(count):
            x = mp.cos(mp.pi * (k + 0.75) / (count + 0.5))
            for _ in range(60):
                p, q = x, mp.mpf(1)
                for n in range(2, count + 1):
                    p, q = ((2 * n - 1) * x * p - (n - 1) * q) / n, p
                slope = count * (x * p - q) / (x * x - 1)
                step = p / slope
                x -= step
                if abs(step) < mp.mpf(10) ** (5 - digits):
                    break
            out.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
        return out


@functools.cache
def trim(digits):
    return mp.mpf(10) ** (-3 * digits // 4)


RULES = {}


def rules():
    if not RULES:
        # As many digits as a derivative of an integral is computed with.
        RULES.update({n: legendre(n, 3 * DIGITS_OF_INTEGRALS + 10) for n in (20, 32)})
    return RULES[20], RULES[32]


class Evaluation:
    """Values at a point; `names` are definitions, `derivations` lists of (symbol, image)."""

    def __init__(self, names, derivations, point):
        self.names, self.derivations, self.point = names, derivations, point
        self.depth = self.evaluations = 0
        self.coarse, self.noise = False, mp.mpf(0)

    def value(self, tree, factor=1):
        """The value with `factor` times the digits."""
        self.coarse = any(self.is_coarse(t) for t in self.reached(tree))
        with mp.workdps(factor * (DIGITS_OF_INTEGRALS if self.coarse else DIGITS)):
            z = mp.mpmathify(self.of(tree, {}))
            if not mp.isfinite(z):
                raise Unclear("not finite")
            return z

    def reached(self, tree, seen=()):
        for t in parts_of(tree):
            yield t
            if t[0] == "sym" and t[1] in self.names and t[1] not in seen:
                yield from self.reached(self.names[t[1]], (*seen, t[1]))

    @staticmethod
    def is_coarse(t):
        return t[0] == "int" or (t[0] == "sum" and t[3] == ("sym", "inf"))

    def trimmed(self, z, scale):
        """Without parts that have cancelled to nothing but rounding."""
        least = scale * (TRIMMED_INTEGRAL if self.coarse and mp.mp.dps == DIGITS_OF_INTEGRALS else trim(mp.mp.dps))
        if isinstance(z, mp.mpc):
            re = mp.mpf(0) if abs(z.real) < least else z.real
            im = mp.mpf(0) if abs(z.imag) < least else z.imag
            return mp.mpc(re, im) if im else re
        return mp.mpf(0) if abs(z) < least else z

    def of(self, tree, env):
        self.evaluations += 1
        if self.evaluations > 100_000:
            raise Unclear("too long")
        return getattr(self, "of_" + tree[0])(env, *tree[1:])

    def of_num(self, env, digits):
        return rational(Fraction(digits))

    def of_i(self, env):
        return mp.mpc(0, 1)

    def of_sym(self, env, name):
        if name in env:
            return env[name]
        if name == "pi":
            return +mp.pi
        if name in CONSTANTS:
            raise Undefined(f"{name} as a number")
        if name in self.names:
            if self.depth > 50:
                raise Undefined("a circle of definitions")
            self.depth += 1
            try:
                return self.of(self.names[name], env)
            finally:
                self.depth -= 1
        return rational(self.point.value(name))

    def of_index(self, env, name, index):
        if index[0] == "sym" and index[1] not in env:
            if index[1] in CONSTANTS:
                raise Undefined(f"the index {index[1]}")
            return self.of_sym(env, f"{name}_{index[1]}")
        k = self.of(index, env)
        if not mp.isint(k):
            raise Unclear("an index that is not whole")
        return self.of_sym(env, f"{name}_{int(k)}")

    def of_neg(self, env, x):
        return -self.of(x, env)

    def of_add(self, env, *terms):
        values = [self.of(t, env) for t in terms]
        return self.trimmed(sum(values), max(abs(v) for v in values))

    def of_mul(self, env, *factors):
        product = self.of(factors[0], env)
        for f in factors[1:]:
            f = self.of(f, env)
            both = isinstance(product, mp.mpc) and isinstance(f, mp.mpc)
            product *= f
            if both:
                product = self.trimmed(product, abs(product))
        return plain(product)

    def of_div(self, env, a, b):
        a, b = self.of(a, env), self.of(b, env)
        if b == 0:
            raise Undefined("a division by zero")
        return self.trimmed(a / b, abs(a / b)) if isinstance(b, mp.mpc) else a / b

    def of_pow(self, env, x, k):
        x = self.of(x, env)
        if k < 0 and x == 0:
            raise Undefined("a division by zero")
        z = x**k
        return self.trimmed(z, abs(z)) if isinstance(x, mp.mpc) else z

    def of_call(self, env, name, x):
        x = plain(self.of(x, env))
        if name == "re":
            return mp.re(x)
        if name == "im":
            return mp.im(x)
        if name == "abs":
            return abs(x)
        if name == "arg":
            if x == 0:
                raise Undefined("the argument of zero")
            return mp.arg(x)
        if name == "arctan":
            if isinstance(x, mp.mpc):
                raise Unclear("the arc tangent of a complex number")
            return mp.atan(x)
        if abs(x) > 10**6 and name in ("exp", "W", "sin", "cos"):
            raise Unclear("too large")
        if name == "W" and isinstance(x, mp.mpf):
            # Either part by itself, however small.
            return mp.exp(-x * x) * mp.mpc(1, mp.erfi(x))
        if name == "W":
            z = mp.exp(-x * x) * mp.erfc(-1j * x)
        else:
            z = {"exp": mp.exp, "sqrt": mp.sqrt, "sin": mp.sin, "cos": mp.cos}[name](x)
        return self.trimmed(z, abs(z) if name in ("exp", "sqrt", "W") else mp.mpf(1))

    def of_at(self, env, body, name, value):
        if name in CONSTANTS:
            raise Undefined(f"a value of {name}")
        return self.of(body, {**env, name: self.of(value, env)})

    def of_D(self, env, body, by):
        """A central difference: of d digits with steps of 10^-d, in 3 d digits."""
        digits = mp.mp.dps
        if digits > 10 * DIGITS:
            raise Unclear("too many derivatives")
        with mp.workdps(3 * digits):
            images = {by: mp.mpf(1)}
            for symbol, image in self.derivations.get(by, ()):
                images[symbol] = self.of(image, env)
            if any(s in self.names or s in CONSTANTS for s in images):
                raise Unclear("a derivative by what is defined")
            here = {s: self.of_sym(env, s) for s in images}
            h = mp.mpf(10) ** -digits
            ends = []
            for sign in (1, -1):
                there = {s: here[s] + sign * h * image for s, image in images.items()}
                ends.append(self.of(body, {**env, **there}))
            out = (ends[0] - ends[1]) / (2 * h)
        return self.trimmed(out, abs(out) + mp.mpf(10) ** (-digits // 2) * abs(ends[0]))

    def of_series(self, env, name, body):
        if self.point.weight is None and not self.point.terms:
            return mp.mpf(0)
        if self.point.weight is None:
            return self.of(body, {k: v for k, v in env.items() if k != name})
        terms = (rational(self.point.weight(k)) * self.of(body, {**env, name: mp.mpf(k)}) for k in range(1, 5))
        return sum(terms)

    def of_sum(self, env, name, low, high, body):
        low = self.of(low, env)
        endless = high == ("sym", "inf")
        high = low if endless else self.of(high, env)
        if not (mp.isint(low) and mp.isint(high)):
            raise Unclear("limits that are not whole")
        if high - low > 2000:
            raise Unclear("too many terms")

        def term(k):
            return self.of(body, {**env, name: mp.mpf(k)})

        if endless:
            return self.endless_sum(term, int(low))
        terms = [term(k) for k in range(int(low), int(high) + 1)]
        return self.trimmed(sum(terms, mp.mpf(0)), max(map(abs, terms), default=mp.mpf(0)))

    def endless_sum(self, term, low):
        """Term by term where they fall like powers, by Richardson's extrapolation where they fall like 1/n^2."""
        total, before, largest = mp.mpf(0), None, mp.mpf(0)
        for k in range(low, low + 600):
            t = term(k)
            total += t
            largest = max(largest, abs(t))
            ratio = abs(t / before) if before else mp.mpf(1)
            small = abs(t) <= largest * INTEGRAL * mp.mpf("1e-6")
            if small and (ratio < 0.97 or t == 0) and k > low + 12:
                return total
            before = t
            if k == low + 75:
                half = abs(t)
            if k == low + 150 and ratio > 0.98:
                # Like 1/k^(1 + a little) at least.
                if abs(t) * mp.mpf(2.4) > half:
                    raise Unclear("a sum that may have no value")
                break
        found = []
        for digits in (32, 40):
            with mp.workdps(digits):
                found.append(mp.nsum(lambda n: term(int(n)), [low, mp.inf]))
        if abs(found[0] - found[1]) > abs(found[1]) * mp.mpf("1e-24"):
            raise Unclear("a sum that is not found")
        return found[1]

    def of_int(self, env, name, low, high, body):
        ends = []
        for limit in (low, high):
            sign = -1 if limit[0] == "neg" else 1
            if limit == ("sym", "inf") or limit == ("neg", ("sym", "inf")):
                ends.append(sign * mp.inf)
            else:
                ends.append(self.of(limit, env))

        def f(s):
            return self.of(body, {**env, name: s})

        kinked = any(t[0] == "call" and t[1] in ("abs", "sqrt", "arg") for t in self.reached(body))
        a, b = ends
        if mp.isinf(a) and mp.isinf(b):
            return self.tail(f, mp.mpf(0), 1) - self.tail(f, mp.mpf(0), -1) if a < b else mp.mpf(0)
        if mp.isinf(a):
            return -self.tail(f, b, -1) if a < 0 else self.no_path()
        if mp.isinf(b):
            return self.tail(f, a, 1) if b > 0 else self.no_path()
        cuts = [mp.mpf(0), mp.mpf(1)]
        if kinked:
            cuts[1:1] = self.kinks(env, name, a, b, body)
        total, size = mp.mpf(0), mp.mpf(0)
        for low, high in zip(cuts, cuts[1:]):
            start, step = a + (b - a) * low, (b - a) * (high - low)
            if kinked:
                # A root of the distance to an end becomes smooth.
                smooth = self.smoothed(f, start, step)
                part, largest = self.piece(smooth, mp.mpf(0), mp.mpf(1))
            else:
                part, largest = self.piece(f, start, step)
            total, size = total + part, max(size, largest)
        return self.trimmed(total, size)

    @staticmethod
    def smoothed(f, start, step):
        return lambda t: f(start + step * t * t * (3 - 2 * t)) * 6 * t * (1 - t) * step

    @staticmethod
    def no_path():
        raise Unclear("a path from infinity")

    def kinks(self, env, name, a, b, body):
        """Where on the way a linear argument of a function with a kink is zero."""
        found = set()
        for t in self.reached(body):
            if t[0] != "call" or t[1] not in ("abs", "sqrt", "arg"):
                continue
            for inner in parts_of(t[2]):
                try:
                    u, v = (self.of(inner, {**env, name: s}) for s in (a, b))
                    if u == v:
                        continue
                    at = plain(u / (u - v))
                    here = self.of(inner, {**env, name: a + (b - a) * at})
                except (Undefined, Unclear):
                    continue
                if isinstance(at, mp.mpf) and 0 < at < 1 and abs(here) < abs(u - v) * mp.mpf("1e-20"):
                    found.add(at)
        return sorted(found)

    def piece(self, f, start, step, floor=0, depth=0):
        """The integral over a straight piece, halved until two rules agree, and the integrand's size. What is far below
        `floor` need not be found."""
        few, many = rules()
        values = [f(start + step * x) for x, _ in many]
        whole = sum(w * v for (_, w), v in zip(many, values)) * step
        largest = max(abs(v) for v in values) * abs(step)
        rough = sum(w * f(start + step * x) for x, w in few) * step
        if abs(whole - rough) <= INTEGRAL * max(largest, floor):
            self.noise = max(self.noise, 10**4 * INTEGRAL * max(largest, floor))
            return whole, largest
        if depth == 5:
            raise Unclear("an integral that is not found")
        first, left = self.piece(f, start, step / 2, floor, depth + 1)
        second, right = self.piece(f, start + step / 2, step / 2, floor, depth + 1)
        return first + second, max(left, right)

    def tail(self, f, start, sign):
        """The integral from here on, in pieces twice as long each, until nothing is left."""
        total, step, largest = mp.mpf(0), mp.mpf(sign), mp.mpf(0)
        for k in range(14):
            part, size = self.piece(f, start, step, largest)
            total, start, largest = total + part, start + step, max(largest, abs(part))
            if size <= largest * INTEGRAL:
                return self.trimmed(total, largest)
            if k > 5 and size > largest / 100:
                break
            step *= 2
        raise Unclear("an integral that does not end")
