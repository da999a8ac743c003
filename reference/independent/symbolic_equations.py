"""Random equations in the language of `mechaudit identity`: true by construction, false, and without a value.

A true one begins with an instance of a rule (its two sides are equal for all positive values of the symbols), is put
into further operations on both sides, and is reordered. A false one has something changed in one side, or is a rule
that is often taken for true. One without a value divides by a zero that is hidden. What is meant to be false may come
out true; whoever evaluates it finds that out.
"""

import collections
import math
import random

import symbolic_values as values

#: What `--define` is given, for all equations.
DEFINITIONS = (
    "rho = sqrt(x^2 + y^2)",
    "zeta = x + i*y",
    "tau = exp(i*x)",
    "kappa = sqrt(3 + 2*sqrt(2))",
    "mean = (a + b)/2",
    "gap = sqrt(x - y)",
    "t: q = -a*q",
    "t: x = y",
    "t: y = -x",
)

Equation = collections.namedtuple("Equation", "kind calculus left right truth")
#: The three kinds of equations; `None` for what the values have to tell.
TRUE, FALSE, NO_VALUE = "true", "false", "without a value"

#: Closed forms of cos(pi*p/q).
COSINES = {
    (0, 1): "1", (1, 1): "-1", (1, 2): "0", (1, 3): "1/2", (2, 3): "-1/2", (1, 4): "sqrt(2)/2",
    (3, 4): "-sqrt(2)/2", (1, 6): "sqrt(3)/2", (5, 6): "-sqrt(3)/2", (1, 5): "(1 + sqrt(5))/4",
    (2, 5): "(sqrt(5) - 1)/4", (1, 8): "sqrt(2 + sqrt(2))/2", (3, 8): "sqrt(2 - sqrt(2))/2",
    (1, 12): "(sqrt(6) + sqrt(2))/4", (5, 12): "(sqrt(6) - sqrt(2))/4",
    (1, 10): "sqrt(10 + 2*sqrt(5))/4",
}  # fmt: skip


class Grammar:
    """Texts drawn from a random stream; every text that is returned stands in brackets or is an atom."""

    def __init__(self, rng):
        self.rng = rng
        self.symbols = rng.sample(("x", "y", "a", "b", "z"), 2)

    def one(self, *choices):
        return self.rng.choice(choices)

    def whole(self, low=1, high=7):
        return str(self.rng.randrange(low, high + 1))

    def number(self):
        k = self.rng.randrange(6)
        if k < 3:
            return self.whole()
        if k < 5:
            return f"({self.whole(1, 9)}/{self.whole(2, 7)})"
        return self.one("0.5", "1.25", "0.2", "2.75")

    def symbol(self):
        return self.rng.choice(self.symbols)

    def positive(self, depth=2):
        """Positive whatever the symbols are."""
        if depth == 0:
            return self.one(self.symbol(), self.symbol(), self.number())
        p = self.positive
        d = depth - 1
        return self.one(
            lambda: self.symbol(),
            lambda: self.symbol(),
            lambda: self.number(),
            lambda: f"sqrt({p(d)})",
            lambda: f"({p(d)} + {p(d)})",
            lambda: f"({p(d)}*{p(d)})",
            lambda: f"({p(d)}/{p(d)})",
            lambda: f"({self.symbol()}^{self.whole(2, 3)})",
            lambda: self.one("rho", "kappa", "mean", "pi"),
            lambda: f"({p(d)} + sqrt({p(d)}))",
        )()

    def real(self, depth=2):
        d = depth - 1
        if depth <= 0:
            return self.one(self.symbol(), f"(-{self.symbol()})", self.number())
        return self.one(
            lambda: self.positive(depth),
            lambda: f"({self.positive(d)} - {self.positive(d)})",
            lambda: f"({self.positive(d)} - {self.positive(d)})",
            lambda: f"(-{self.positive(d)})",
            lambda: f"cos({self.real(d)})",
            lambda: f"sin({self.real(d)})",
            lambda: f"({self.real(d)}*{self.real(d)})",
        )()

    def complex(self, depth=2):
        d = depth - 1
        return self.one(
            lambda: f"({self.real(d)} + i*{self.real(d)})",
            lambda: f"({self.number()} + {self.number()}*i)",
            lambda: f"(i*{self.real(d)})",
            lambda: f"({self.positive(d)}*exp(i*{self.real(0)}))",
            lambda: f"sqrt({self.symbols[0]} - {self.symbols[1]})",
            lambda: self.one("zeta", "tau", "gap"),
        )()

    def turn(self):
        """A rational number p/q, for an angle of p/q pi."""
        q = self.one(2, 3, 4, 5, 6, 7, 8, 10, 12)
        return self.rng.randrange(-2 * q + 1, 2 * q), q

    @staticmethod
    def angle(p, q):
        return f"({p}*pi/{q})" if p >= 0 else f"(-{-p}*pi/{q})"

    @staticmethod
    def reduced(p, q):
        """In (-1, 1]."""
        p %= 2 * q
        return p - 2 * q if p > q else p

    def rational_gap(self):
        """A rational number of any sign, as a text."""
        n, m = self.rng.randrange(-9, 10), self.rng.randrange(1, 5)
        return f"({n}/{m})" if n >= 0 else f"(-{-n}/{m})"


def rule(calculus, weight=1):
    def add(f):
        RULES.append((f.__name__, calculus, weight, f))
        return f

    return add


RULES = []


@rule(False, 3)
def nested_roots_of_numbers(g):
    p, q = g.rng.randrange(2, 12), g.rng.randrange(1, 12)
    if p == q:
        p += 1
    p, q = max(p, q), min(p, q)
    c = g.one("", "", f"{g.whole(2, 5)}/{g.whole(2, 7)}")
    scale = f"({c})*" if c else ""
    sign = g.one("+", "-")
    return f"sqrt({scale}({p + q} {sign} 2*sqrt({p * q})))", (
        f"sqrt({c or 1})*(sqrt({p}) {sign} sqrt({q}))"
    )


@rule(False)
def nested_roots_with_a_factor(g):
    # (a + b sqrt(r))^2, and one level more.
    a, b, r = g.rng.randrange(1, 6), g.rng.randrange(1, 5), g.one(2, 3, 5, 6, 7)
    inside = f"({a * a + b * b * r} + {2 * a * b}*sqrt({r}))"
    if g.rng.randrange(3):
        return f"sqrt({inside})", f"({a} + {b}*sqrt({r}))"
    c = g.rng.randrange(1, 4)
    return (
        f"sqrt({inside} + {c * c} + {2 * c}*sqrt({inside}))",
        f"({a + c} + {b}*sqrt({r}))",
    )


@rule(False, 3)
def nested_roots_of_symbols(g):
    p, q = g.positive(1), g.positive(1)
    if g.rng.randrange(3):
        return f"sqrt({p} + {q} + 2*sqrt({p}*{q}))", f"(sqrt({p}) + sqrt({q}))"
    return f"sqrt({p} + {q} - 2*sqrt({p}*{q}))", f"abs(sqrt({p}) - sqrt({q}))"


@rule(False)
def nested_roots_of_one_symbol(g):
    p, k = g.symbol(), g.rng.randrange(1, 5)
    return g.one(
        (f"sqrt({p} + {2 * k}*sqrt({p}) + {k * k})", f"(sqrt({p}) + {k})"),
        (f"sqrt({p} - {2 * k}*sqrt({p}) + {k * k})", f"abs(sqrt({p}) - {k})"),
        (f"sqrt({p}^2 + 2*{p}*sqrt({p}) + {p})", f"({p} + sqrt({p}))"),
        (f"sqrt({p} + sqrt({p}^2 - 1))*sqrt(2)", f"(sqrt({p} + 1) + sqrt({p} - 1))"),
        (f"sqrt(2*{p} + 2*sqrt({p}^2 + {k}*{p}) + {k})", f"(sqrt({p}) + sqrt({p} + {k}))"),
    )


@rule(False, 2)
def roots_of_products(g):
    p, q = g.positive(2), g.positive(1)
    return g.one(
        (f"sqrt({p}*{q})", f"sqrt({p})*sqrt({q})"),
        (f"sqrt({p}/{q})", f"sqrt({p})/sqrt({q})"),
        (f"sqrt({p}/{q})", f"sqrt({p}*{q})/{q}"),
        (f"sqrt({p}^2*{q})", f"{p}*sqrt({q})"),
        (f"sqrt({p}^3)", f"{p}*sqrt({p})"),
        (f"sqrt(sqrt({p})*sqrt({q}))^2", f"sqrt({p}*{q})"),
    )


@rule(False, 2)
def kinks(g):
    r, s = g.real(2), g.real(1)
    return g.one(
        (f"sqrt({r}^2)", f"abs({r})"),
        (f"abs({r})^2", f"{r}^2"),
        (f"abs({r}*{s})", f"abs({r})*abs({s})"),
        (f"abs(-{r})", f"abs({r})"),
        (f"abs(abs({r}))", f"abs({r})"),
        (f"sqrt({r}^2*{s}^2)", f"abs({r}*{s})"),
        (f"(abs({r} + {s}) + abs({r} - {s}))^2", f"(2*{r}^2 + 2*{s}^2 + 2*abs({r}^2 - {s}^2))"),
    )


@rule(False, 2)
def roots_of_differences(g):
    x, y = g.symbols
    k = g.rng.randrange(2, 5)
    return g.one(
        (f"sqrt({x} - {y})^2", f"({x} - {y})"),
        (f"sqrt({k * k}*{x} - {k * k}*{y})", f"{k}*sqrt({x} - {y})"),
        (f"sqrt({x} - {y})*sqrt({y} - {x})", f"i*abs({x} - {y})"),
        (f"abs(sqrt({x} - {y}))", f"sqrt(abs({x} - {y}))"),
        (f"re(sqrt({x} - {y}))*im(sqrt({x} - {y}))", "0"),
        (f"re(sqrt({x} - {y}))^2 - im(sqrt({x} - {y}))^2", f"({x} - {y})"),
        (f"1/sqrt({x} - {y})", f"sqrt({x} - {y})/({x} - {y})"),
        (f"sqrt({x} - {y})*sqrt({x} + {y})", f"sqrt({x}^2 - {y}^2)"),
        (f"sqrt(-{x} - {y})", f"i*sqrt({x} + {y})"),
        (f"sqrt({x}/{y} - 1)", f"sqrt({x} - {y})/sqrt({y})"),
    )


@rule(False, 2)
def rational_denominators(g):
    p, q = g.positive(1), g.positive(1)
    return g.one(
        (f"1/(sqrt({p}) + {q})", f"(sqrt({p}) - {q})/({p} - {q}^2)"),
        (f"1/(sqrt({p}) + sqrt({q}))", f"(sqrt({p}) - sqrt({q}))/({p} - {q})"),
        (f"1/(1 + sqrt(2) + sqrt(3))", "(2 + sqrt(2) - sqrt(6))/4"),
        (f"{p}/(sqrt({p}))", f"sqrt({p})"),
        (f"(sqrt({p} + 1) - sqrt({p}))*(sqrt({p} + 1) + sqrt({p}))", "1"),
    )


@rule(False, 2)
def fields(g):
    p, q = g.complex(1), g.real(1)
    x = g.symbol()
    return g.one(
        (f"({p} + {q})^2", f"({p}^2 + 2*{p}*{q} + {q}^2)"),
        (f"({p} - {q})*({p} + {q})", f"({p}^2 - {q}^2)"),
        (f"({p} + {q})^3", f"({p}^3 + 3*{p}^2*{q} + 3*{p}*{q}^2 + {q}^3)"),
        (f"1/({x}*({x} + 1))", f"(1/{x} - 1/({x} + 1))"),
        (f"({p}^2 - {q}^2)/({p} - {q})", f"({p} + {q})"),
        (f"{p}/{q} + {q}/{p}", f"({p}^2 + {q}^2)/({p}*{q})"),
    )


@rule(False, 3)
def parts_of_complex_numbers(g):
    r, s = g.real(1), g.real(1)
    z, w = g.complex(2), g.complex(1)
    return g.one(
        (f"re({r} + i*{s})", r),
        (f"im({r} + i*{s})", s),
        (f"abs({r} + i*{s})", f"sqrt({r}^2 + {s}^2)"),
        (f"re({z})^2 + im({z})^2", f"abs({z})^2"),
        (f"re({z}) + i*im({z})", z),
        (f"abs({z}*{w})", f"abs({z})*abs({w})"),
        (f"abs({z}^2)", f"abs({z})^2"),
        (f"re(i*{z})", f"(-im({z}))"),
        (f"im({z} + {w})", f"im({z}) + im({w})"),
        (f"re({z}*{w})", f"re({z})*re({w}) - im({z})*im({w})"),
        (f"abs(exp(i*{r}))", "1"),
        (f"abs(exp({z}))", f"exp(re({z}))"),
        (f"sqrt({z}^2)^2", f"{z}^2"),
        (f"sqrt({z})^2", z),
        (f"re(exp(i*{r}))", f"cos({r})"),
        (f"im(exp(-i*{r}))", f"(-sin({r}))"),
    )


@rule(False, 3)
def arguments(g):
    p, r = g.positive(1), g.real(1)
    n, m = g.turn()
    k = g.rng.randrange(-12, 13)
    turns = math.floor(k / (2 * math.pi) + 0.5)
    return g.one(
        (f"arg({p}*exp(i*{g.angle(n, m)}))", g.angle(g.reduced(n, m), m)),
        (f"arg(exp(i*({k})))", f"({k} - ({2 * turns})*pi)"),
        (f"arg({p})", "0"),
        (f"arg(-{p})", "pi"),
        (f"arg(i*{p})", "pi/2"),
        (f"arg(-i*{p})", "(-pi/2)"),
        (f"arg({p} + i*{p})", "pi/4"),
        (f"arg(-{p} - i*{p})", "(-3*pi/4)"),
        (f"abs({r})*exp(i*arg({r}))", r),
        (f"arg(zeta/x)", "arg(zeta)"),
        (f"abs(zeta)*cos(arg(zeta))", "x"),
        (f"arg(zeta)", "arctan(y/x)"),
        (f"arg(x - i*y)", "(-arg(zeta))"),
        (f"arg(gap)", "(pi/4)*(1 - (x - y)/abs(x - y))"),
    )


@rule(False, 4)
def angles_in_parts_of_pi(g):
    (p, q), value = g.rng.choice(list(COSINES.items()))
    k = g.rng.randrange(-2, 3)
    shift = f"{2 * k}*pi" if k >= 0 else f"(-{-2 * k}*pi)"
    r = g.real(1)
    n, m = g.turn()
    return g.one(
        (f"cos({p}*pi/{q})", value),
        (f"cos({p}*pi/{q} + {shift})", value),
        (f"sin({p}*pi/{q} + pi/2)", value),
        (f"exp(i*{p}*pi/{q}) + exp(-i*{p}*pi/{q})", f"2*({value})"),
        (f"sin({r} + pi/2)", f"cos({r})"),
        (f"cos({r} + pi/3)", f"(cos({r})/2 - sqrt(3)/2*sin({r}))"),
        (f"exp({r} + i*{g.angle(n, m)})", f"exp({r})*(cos({n % (2 * m)}*pi/{m}) + i*sin({n % (2 * m)}*pi/{m}))"),
        (f"cos(pi/7) - cos(2*pi/7) + cos(3*pi/7)", "1/2"),
        (f"cos(pi/5)*cos(2*pi/5)", "1/4"),
        (f"sin(pi/9)*sin(2*pi/9)*sin(4*pi/9)", "sqrt(3)/8"),
        (f"exp(i*{g.angle(n, m)})^{m}", "1" if n % 2 == 0 else "-1"),
        (f"cos(pi/{m})^2 + sin(pi/{m})^2", "1"),
        (f"sin(2*pi/{m})", f"2*sin(pi/{m})*cos(pi/{m})"),
        (f"sqrt(2 + 2*cos(pi/{m}))", f"2*cos(pi/{2 * m})"),
    )


@rule(False, 2)
def trigonometry(g):
    r, s = g.real(1), g.one(g.real(1), g.symbol())
    return g.one(
        (f"sin({r})^2 + cos({r})^2", "1"),
        (f"sin({r} + {s})", f"(sin({r})*cos({s}) + cos({r})*sin({s}))"),
        (f"cos(2*{r})", f"(1 - 2*sin({r})^2)"),
        (f"cos({r}) + cos({s})", f"2*cos(({r} + {s})/2)*cos(({r} - {s})/2)"),
        (f"sin(3*{r})", f"(3*sin({r}) - 4*sin({r})^3)"),
        (f"sqrt(1 - cos({r})^2)", f"abs(sin({r}))"),
        (f"sqrt(2 + 2*cos({r}))", f"2*abs(cos({r}/2))"),
        (f"sin({r})/(1 + cos({r}))", f"(1 - cos({r}))/sin({r})"),
    )


@rule(False, 2)
def exponentials(g):
    z, w, k = g.complex(1), g.real(1), g.rng.randrange(2, 5)
    return g.one(
        (f"exp({z} + {w})", f"exp({z})*exp({w})"),
        (f"exp({z})^{k}", f"exp({k}*{z})"),
        (f"1/exp({z})", f"exp(-{z})"),
        (f"sqrt(exp({w}))", f"exp({w}/2)"),
        (f"(exp({w}) - exp(-{w}))^2 + 4", f"(exp({w}) + exp(-{w}))^2"),
        (f"exp({z})/(1 + exp({z}))", f"1/(1 + exp(-{z}))"),
        (f"exp({w}*(1 + 1/{w}))", f"exp({w} + 1)"),
    )


@rule(False, 2)
def finite_sums(g):
    n, x = g.rng.randrange(2, 6), g.symbol()
    return g.one(
        (f"sum(n, 1, {n}, n)", str(n * (n + 1) // 2)),
        (f"sum(k, 1, {n}, k*{x})", f"{n * (n + 1) // 2}*{x}"),
        (f"sum(k, 1, {n}, a[k]*{x})", "(" + " + ".join(f"a_{k}*{x}" for k in range(1, n + 1)) + ")"),
        (f"sum(n, 0, {n}, exp(n*{x}))", f"(exp({n + 1}*{x}) - 1)/(exp({x}) - 1)"),
        (f"sum(n, 1, {n}, 1/(n*(n + 1)))", f"(1 - 1/{n + 1})"),
        (f"sum(n, 1, {n}, sqrt(n + 1) - sqrt(n))", f"(sqrt({n + 1}) - 1)"),
        (f"sum(k, 0, {n}, cos(2*k*pi/{n + 1}))", "0"),
        (f"sum(n, 3, {n}, {x})", f"{max(n - 2, 0)}*{x}"),
        (f"sum(n, 1, {n}, sum(m, 1, n, m))", str(n * (n + 1) * (n + 2) // 6)),
        (f"sum(n, -1, 1, abs(n - {x}) - abs(n))", f"(abs(1 + {x}) + {x} + abs(1 - {x}) - 2)"),
    )


@rule(False, 3)
def values_put_in(g):
    x, y = g.symbols
    p = g.positive(1)
    z = g.complex(1)
    return g.one(
        (f"at({x}^2 + {y}*{x}, {x}, {z})", f"({z}^2 + {y}*{z})"),
        (f"at(sqrt({x}), {x}, {p})", f"sqrt({p})"),
        (f"at(sqrt({x}^2), {x}, -{p})", p),
        (f"at(re({x}), {x}, 2 + 3*i)", "2"),
        (f"at(im({x})*{y}, {x}, 2 + 3*i)", f"3*{y}"),
        (f"at(abs({x}), {x}, 3 + 4*i)", "5"),
        (f"at(exp(i*{x}), {x}, i*{p})", f"exp(-{p})"),
        (f"at(re(exp({x})), {x}, i*{y})", f"cos({y})"),
        (f"at(abs({x} - 2), {x}, 1)", "1"),
        (f"at(1/({x} + 1), {x}, i)", "(1 - i)/2"),
        (f"at(at({x}*{y}, {x}, {y}), {y}, 3)", "9"),
        (f"at(arg({x}), {x}, -1)", "pi"),
        (f"at(zeta, x, i*y)", "2*i*y"),
        (f"at(abs(zeta), x, {p})", f"sqrt({p}^2 + y^2)"),
        (f"at({x} + 1, {x}, {z})^2", f"({z} + 1)^2"),
    )


@rule(False, 2)
def definitions(g):
    return g.one(
        ("rho^2", "(x^2 + y^2)"),
        ("abs(zeta)", "rho"),
        ("zeta^2", "(x^2 - y^2 + 2*i*x*y)"),
        ("kappa", "(1 + sqrt(2))"),
        ("kappa^2 - 2*kappa", "1"),
        ("mean^2 - a*b", "((a - b)/2)^2"),
        ("tau + 1/tau", "2*cos(x)"),
        ("gap^2", "(x - y)"),
        ("rho/zeta", "(x - i*y)/rho"),
        ("sqrt(rho + x)*sqrt(rho - x)", "y"),
        ("sqrt((rho + x)/2) + i*sqrt((rho - x)/2)", "sqrt(zeta)"),
        ("1/(kappa - 1)", "sqrt(2)/2"),
        ("abs(tau + 1)^2", "(2 + 2*cos(x))"),
    )


@rule(True, 3)
def derivatives(g):
    x, y = g.symbols
    p = g.positive(1)
    k = g.rng.randrange(2, 5)
    return g.one(
        (f"D({x}^{k}*{y}, {x})", f"{k}*{x}^{k - 1}*{y}"),
        (f"D(exp({k}*{x}*{y}), {x})", f"{k}*{y}*exp({k}*{x}*{y})"),
        (f"D(sqrt({x} + {y}), {x})", f"1/(2*sqrt({x} + {y}))"),
        (f"D(sin({x})*{p}, {x})", f"({p}*cos({x}) + sin({x})*D({p}, {x}))"),
        (f"D({x}/({x} + {y}), {x})", f"{y}/({x} + {y})^2"),
        (f"D(D({x}^{k}, {x}), {x})", f"{k * (k - 1)}*{x}^{k - 2}"),
        (f"D(sqrt({x}^2 + {y}^2), {x})", f"{x}/sqrt({x}^2 + {y}^2)"),
        (f"D(W({y}*{x}), {x})", f"{y}*(-2*{y}*{x}*W({y}*{x}) + 2*i/sqrt(pi))"),
        (f"D(abs({x} - {y}), {x})", f"({x} - {y})/abs({x} - {y})"),
        (f"D(arctan({x}), {x})", f"1/(1 + {x}^2)"),
        (f"D(int(s, 0, {x}, exp(-s^2)), {x})", f"exp(-{x}^2)"),
        (f"at(D({x}^{k}, {x}), {x}, {p})", f"{k}*{p}^{k - 1}"),
        (f"at(D(exp({y}*{x}), {x}), {x}, 0)", y),
        (f"D(re(exp(i*{x})), {x})", f"(-sin({x}))"),
        ("D(q^2, t)", "(-2*a*q^2)"),
        ("D(rho, t)", "0"),
        ("D(x*q, t)", "(y*q - a*x*q)"),
        ("D(zeta, t)", "(-i*zeta)"),
        (f"D({p}*{x}, {x})", f"({p} + {x}*D({p}, {x}))"),
        (f"D({x}, {x})/{p}", f"1/{p}"),
    )


@rule(True, 3)
def integrals(g):
    x, y = g.symbols
    k = g.rng.randrange(1, 4)
    c = g.one(x, str(k), f"({x} + 1)")
    return g.one(
        (f"int(s, 0, {x}, s^{k})", f"{x}^{k + 1}/{k + 1}"),
        (f"int(s, {x}, {y}, 2*s + {x})", f"({y}^2 - 2*{x}^2 + {x}*{y})"),
        (f"int(s, 0, {x}, exp({k}*s))", f"(exp({k}*{x}) - 1)/{k}"),
        (f"int(s, 0, pi, sin(s))", "2"),
        (f"int(s, 0, 1, cos({x}*s))", f"sin({x})/{x}"),
        (f"int(s, 0, 2*pi, cos({k}*s)^2)", "pi"),
        (f"int(s, 0, {x}, s*exp(-s))", f"(1 - (1 + {x})*exp(-{x}))"),
        (f"int(s, 0, {x}, exp(-{c}*s^2))", f"int(s, 0, {x}*sqrt({c}), exp(-s^2))/sqrt({c})"),
        (f"int(s, 0, {x}, exp(s^2))", f"sqrt(pi)/(2*i)*(exp({x}^2)*W({x}) - 1)"),
        (f"int(s, 0, {x}, s*exp(-s^2))", f"(1 - exp(-{x}^2))/2"),
        (f"int(s, 0, {x}, D(s^2*exp(s), s))", f"{x}^2*exp({x})"),
        (f"int(s, 0, {x} + {y}, exp(-s))", f"(int(s, 0, {x}, exp(-s)) + int(s, {x}, {x} + {y}, exp(-s)))"),
        (f"int(s, 0, 1, {x}*s + int(u, 0, s, u))", f"({x}/2 + 1/6)"),
        (f"int(s, -1, 1, abs(s))", "1"),
        (f"int(s, 0, 2, abs(s - 1))", "1"),
        (f"int(s, -1, 2, sqrt(s^2))", "5/2"),
        (f"int(s, 0, {x}, sqrt(s))", f"2*{x}*sqrt({x})/3"),
        (f"int(s, 0, i, re(s))", "0"),
        (f"int(s, 0, 1 + i, re(s))", "(1 + i)/2"),
        (f"int(s, 0, i, im(s))", "i/2"),
        (f"int(s, 0, i*{x}, exp(s))", f"(exp(i*{x}) - 1)"),
        (f"int(s, 0, i, abs(exp(i*s)))", "i*(1 - exp(-1))"),
        (f"int(s, 0, 1, 1/(1 + s^2))", "pi/4"),
        (f"int(s, 0, {x}, 1/(1 + s)^2)", f"{x}/(1 + {x})"),
        (f"int(s, 0, 1, int(u, 0, {x}, s*u))", f"{x}^2/4"),
    )


@rule(True, 3)
def integrals_without_end(g):
    x, y = g.symbols
    c = g.one(x, f"({x} + {g.whole()})", g.whole(), f"({x}*{y})")
    k = g.rng.randrange(0, 4)
    return g.one(
        (f"int(s, 0, inf, exp(-{c}*s))", f"1/{c}"),
        (f"int(s, 0, inf, s^{k}*exp(-{c}*s))", f"{math.factorial(k)}/{c}^{k + 1}"),
        (f"int(s, 0, inf, exp(-{c}*s^2))", f"sqrt(pi)/(2*sqrt({c}))"),
        (f"int(s, -inf, inf, exp(-s^2))", "sqrt(pi)"),
        (f"int(s, {x}, inf, exp(-s))", f"exp(-{x})"),
        (f"int(s, 0, inf, s*exp(-{c}*s^2))", f"1/(2*{c})"),
        (f"int(s, 0, inf, exp(-{c}*s)*cos({y}*s))", f"{c}/({c}^2 + {y}^2)"),
        (f"int(s, 0, inf, exp(-s^2)) - int(s, 0, {x}, exp(-s^2))", f"int(s, {x}, inf, exp(-s^2))"),
        (f"int(s, 0, inf, exp(-s^2)*cos(2*{x}*s))", f"sqrt(pi)/2*exp(-{x}^2)"),
        (f"int(s, 0, inf, exp(-s^2 + 2*i*{x}*s))", f"sqrt(pi)/2*W({x})"),
    )


@rule(True, 2)
def sums_without_end(g):
    x = g.symbol()
    k = g.rng.randrange(1, 4)
    return g.one(
        ("sum(n, 1, inf, 1/n^2)", "pi^2/6"),
        ("sum(n, 1, inf, 1/n^4)", "pi^4/90"),
        ("sum(n, 1, inf, 1/(n*(n + 1)))", "1"),
        (f"sum(n, 0, inf, exp(-n*{x}))", f"1/(1 - exp(-{x}))"),
        (f"sum(n, {k}, inf, exp(-n*{x}))", f"exp(-{k}*{x})/(1 - exp(-{x}))"),
        (f"sum(n, 1, inf, n*exp(-n*{x}))", f"exp(-{x})/(1 - exp(-{x}))^2"),
        (f"sum(n, 1, inf, {x}*exp(-n))", f"{x}*sum(n, 1, inf, exp(-n))"),
        (f"sum(n, 1, inf, exp(-n) + exp(-2*n))", "(sum(n, 1, inf, exp(-n)) + sum(n, 1, inf, exp(-2*n)))"),
        (f"sum(n, 0, inf, exp(-n*{x})*cos(n))", f"re(1/(1 - exp(i - {x})))"),
        (f"sum(n, 1, inf, exp(-n))", f"exp(-1) + sum(n, 2, inf, exp(-n))"),
        (f"sum(n, {k}, inf, 0)", "0"),
    )


@rule(True)
def series(g):
    x, c = g.symbol(), g.one(g.positive(1), "i", g.number())
    return g.one(
        (f"series(n, c[n]) + series(n, d[n])", "series(n, c[n] + d[n])"),
        (f"{c}*series(n, c[n])", f"series(n, {c}*c[n])"),
        (f"D(series(n, c[n]*{x}^2), {x})", f"series(n, 2*c[n]*{x})"),
        (f"series(n, (c[n] + 1)^2)", "series(n, c[n]^2 + 2*c[n] + 1)"),
        (f"series(n, c[n]*sin(n*{x}))", f"(-1)*D(series(n, c[n]*cos(n*{x})/n), {x})"),
        (f"int(s, 0, {x}, series(n, c[n]*s))", f"series(n, c[n])*{x}^2/2"),
        (f"series(n, exp(i*n*{x}))", f"(series(n, cos(n*{x})) + i*series(n, sin(n*{x})))"),
    )


@rule(True, 2)
def probability_integrals(g):
    x, p = g.symbol(), g.positive(1)
    return g.one(
        (f"W(-{p})", f"(2*exp(-{p}^2) - W({p}))"),
        ("W(0)", "1"),
        (f"re(W({p}))", f"exp(-{p}^2)"),
        (f"im(W(i*{p}))", "0"),
        (f"W({p})", f"exp(-{p}^2)*(1 + 2*i/sqrt(pi)*int(s, 0, {p}, exp(s^2)))"),
        (f"W(i*{x})", f"exp({x}^2)*(1 - 2/sqrt(pi)*int(s, 0, {x}, exp(-s^2)))"),
        (f"W({x} + {x})", f"W(2*{x})"),
        (f"W(-i*{x}) + W(i*{x})", f"2*exp({x}^2)"),
    )


@rule(True, 2)
def arc_tangents(g):
    x, p = g.symbol(), g.positive(1)
    return g.one(
        ("arctan(1)", "pi/4"),
        ("arctan(sqrt(3))", "pi/3"),
        ("arctan(sqrt(2) - 1)", "pi/8"),
        ("arctan(0)", "0"),
        (f"arctan({p}) + arctan(1/{p})", "pi/2"),
        (f"arctan(-{p})", f"(-arctan({p}))"),
        (f"sin(arctan({x}))", f"{x}/sqrt(1 + {x}^2)"),
        (f"cos(arctan({p}))^2", f"1/(1 + {p}^2)"),
        (f"exp(2*i*arctan({x}))", f"(1 + i*{x})/(1 - i*{x})"),
        ("4*arctan(1/5) - arctan(1/239)", "pi/4"),
        (f"arctan({x})", f"int(s, 0, {x}, 1/(1 + s^2))"),
        (f"2*arctan(sqrt({x}^2 + 1) - {x})", f"(pi/2 - arctan({x}))"),
    )


def tempting(g):
    """What is often taken for true."""
    x, y = g.symbols
    z, w, p = g.complex(1), g.complex(1), g.positive(1)
    k = g.rng.randrange(1, 13)
    n, m = g.turn()
    return g.one(
        (False, f"sqrt({z}^2)", z),
        (False, f"sqrt({z}*{w})", f"sqrt({z})*sqrt({w})"),
        (False, f"sqrt({y} - {x})", f"i*sqrt({x} - {y})"),
        (False, f"sqrt(({x} - {y})^2)", f"({x} - {y})"),
        (False, f"sqrt({x}^2 - {y}^2)/sqrt({x} - {y})", f"sqrt({x} + {y})"),
        (False, f"sqrt(({x} - {y})/({x} + {y}))", f"sqrt({y} - {x})/sqrt(-{x} - {y})"),
        (False, f"abs({x} - {y})", f"({x} - {y})"),
        (False, f"sqrt({x} + {y} - 2*sqrt({x}*{y}))", f"(sqrt({x}) - sqrt({y}))"),
        (False, f"sqrt({x} - 2*sqrt({x}) + 1)", f"(1 - sqrt({x}))"),
        (False, f"arg(exp({k}*i))", str(k)),
        (False, f"arg(exp(i*{g.angle(n, m)}))", g.angle(n, m)),
        (False, f"arg(exp({k}*i*{x}))", f"{k}*{x}"),
        (False, f"arg({x}*exp(i*{y}))", y),
        (False, f"arg(({x}*exp(i*{y}))^3)", f"3*arg({x}*exp(i*{y}))"),
        (False, f"arg(exp(i*sqrt({x} - {y})))", f"sqrt({x} - {y})"),
        (False, f"arg(({x} - {y})*exp(i))", "1"),
        (False, f"arg({z}*{w})", f"arg({z}) + arg({w})"),
        (False, f"arctan(sin({x})/cos({x}))", x),
        (False, f"at(re({x}), {x}, i)", "i"),
        (False, f"at(re({x}), {x}, {z})", z),
        (False, f"at(im({x}), {x}, {z})", "0"),
        (False, f"at(abs(exp(i*{x})), {x}, {z})", "1"),
        (False, f"at(abs({x}), {x}, -{p})", f"(-{p})"),
        (False, f"at(arg(exp(i*{x})), {x}, {k})", str(k)),
        (False, f"at(abs(zeta), x, {z})", f"sqrt({z}^2 + y^2)"),
        (False, f"at(exp(2*i*{x}*pi), {x}, 1/2)", "1"),
        (False, f"re({z}^2)", f"re({z})^2"),
        (False, f"re(sqrt({x} - {y}))", f"sqrt({x} - {y})"),
        (False, f"sum(n, 1, 4, a[n])^2", "sum(n, 1, 4, a[n]^2)"),
        (False, f"sqrt(sin({x})^2)", f"sin({x})"),
        (False, f"sqrt(1 - sin({x})^2)", f"cos({x})"),
        (True, f"int(s, 0, i, re(s))", "-1/2"),
        (True, f"int(s, 0, i, abs(exp(i*s)))", "i"),
        (True, f"int(s, 0, sqrt({x} - {y}), re(s))", f"({x} - {y})/2"),
        (True, f"int(s, 0, 1 + i, im(s))", "0"),
        (True, f"int(s, -1, 1, sqrt(s^2))", "0"),
        (True, f"int(s, 0, 2*{x}, abs(s - {x}))", "0"),
        (True, "sum(n, 1, inf, 1/n^2)", "49/36"),
        (True, f"sum(n, 1, inf, exp(-n*{x}))", f"exp(-{x}) + exp(-2*{x}) + exp(-3*{x})"),
        (True, f"sum(n, 5, inf, exp(-n*{x}))", "0"),
        (True, "series(n, c[n])*series(n, d[n])", "series(n, c[n]*d[n])"),
        (True, f"series(n, {x}) + 1", f"series(n, {x} + 1)"),
        (True, f"exp(series(n, c[n]*{x}))", f"series(n, exp(c[n]*{x}))"),
        (True, "series(n, c[n])^2", "series(n, c[n]^2)"),
        (True, f"series(n, {x})", x),
        (True, "1/series(n, c[n])", "series(n, 1/c[n])"),
        (True, "re(sqrt(series(n, c[n])))", "sqrt(series(n, c[n]))"),
        (True, "series(n, c[n]) + 0*n", "c_n"),
        (True, f"int(s, 0, inf, exp(-{x}*s))", f"(1 - exp(-{x}))/{x}"),
        (True, f"int(s, 0, inf, exp(-s^2))", "sqrt(pi)"),
        (True, f"im(W({x}))", "0"),
        (True, f"re(W({z}))", f"exp(-({z})^2)"),
        (True, f"D(abs({x} - {y}), {x})", "1"),
        (True, f"D(at({x}^2, {x}, {y}), {y})", "0"),
        (True, f"D(sqrt(({x} - {y})^2), {x})", "1"),
        (True, f"int({x}, 0, 1, D({x}^2, {x}))", f"2*{x}"),
        (True, f"arctan({x}) + arctan({y})", f"arctan(({x} + {y})/(1 - {x}*{y}))"),
        (True, f"arctan(tau)", "arctan(1/tau)"),
    )


def no_zero(g):
    """A denominator that is not zero, though a conjugate of it is."""
    x, y = g.symbols
    _, _, left, right = pair(g, False)
    n = g.one(f"({left} + {right})", f"({left} + {right} + {x})", f"(2*{left} + {right})")
    p = g.positive(1)
    return g.one(
        (False, f"1/{n}", "0"),
        (False, f"{p}/{n}", "0"),
        (False, f"{x}/{n}", f"{y}/{n}"),
        (False, f"exp(1/{n})", "1"),
        (False, f"1/(1/{n} + (1 - {x}))", "0"),
        (False, f"{n}/{n}", "0"),
        (True, f"D({x}, {x})/{n}", "0"),
        (True, f"D({x}/{n}, {x})", "0"),
    )


def pair(g, calculus):
    """An instance of a rule: its name and two equal sides."""
    chosen = [r for r in RULES if calculus or not r[1]]
    if calculus:
        chosen += [r for r in RULES if r[1]] * 4
    name, is_calculus, _, f = g.rng.choices(chosen, [r[2] for r in chosen])[0]
    left, right = f(g)
    return name.replace("_", " "), is_calculus, f"({left})", f"({right})"


def around(g, calculus, left, right):
    """An operation on both sides."""
    k = g.rng.randrange(11 if calculus else 10)
    p, x = g.positive(1), g.symbol()
    if k == 0:
        _, more, l2, r2 = pair(g, False)
        op = g.one("+", "-", "*")
        return f"({left} {op} {l2})", f"({right} {op} {r2})"
    if k == 1:
        return f"({left} - {right})", "0"
    if k == 2:
        return f"({left}*{p})", f"({p}*{right})"
    if k == 3:
        return f"({p}/(1 + {left}^2))", f"({p}/({right}^2 + 1))"
    if k == 4:
        f = g.one("exp", "sin", "abs", "re", "im", "sqrt", "cos")
        return f"{f}({left})", f"{f}({right})"
    if k == 5:
        return f"({left}^2)", f"({right}*{left})"
    if k == 6:
        # A zero that is hidden in a denominator which is none.
        return f"(1/({left} - {right} + {p}))", f"(1/{p})"
    if k == 7:
        return f"({left} + {p})", f"({p} + {right})"
    if k == 8:
        # Not zero, but a conjugate of it is.
        return f"({p}/({left} + {right}))", f"({p}/(2*{right}))"
    if k == 10:
        return f"(D({x}, {x})*{left})", right
    return left, right


def reordered(g, tree):
    """With some terms and factors exchanged."""
    kind, *parts = tree
    parts = [reordered(g, p) if isinstance(p, tuple) else p for p in parts]
    if kind in ("add", "mul") and g.rng.random() < 0.3:
        g.rng.shuffle(parts)
    return (kind, *parts)


SWAPS = {"sin": "cos", "cos": "sin", "re": "im", "im": "re", "abs": "re", "sqrt": "abs", "exp": "W"}


def changed(g, tree):
    """With one thing different."""
    places = sum(1 for _ in values.parts_of(tree))
    at = g.rng.randrange(places)

    def go(t):
        nonlocal at
        here, at = at == 0, at - 1
        if here:
            return different(g, t)
        return (t[0], *(go(p) if isinstance(p, tuple) else p for p in t[1:]))

    return go(tree)


def different(g, t):
    kind = t[0]
    if kind == "num":
        return ("num", str(int(float(t[1])) + g.one(1, 2)))
    if kind == "sym" and t[1] not in ("inf", "pi"):
        return ("sym", g.one("x", "y", "a"))
    if kind == "i":
        return ("neg", t)
    if kind == "neg":
        return t[1]
    if kind in ("add", "mul") and g.rng.random() < 0.5:
        return (kind, *t[1:-1], ("neg", t[-1]))
    if kind == "pow":
        return ("pow", t[1], t[2] + 1)
    if kind == "call" and t[1] in SWAPS:
        return ("call", SWAPS[t[1]], t[2]) if g.rng.random() < 0.5 else t[2]
    if kind == "sym":
        return t
    return g.one(("neg", t), ("mul", ("num", "2"), t), ("call", "re", t), ("call", "abs", t))


def without_value(g, calculus):
    """A division by a zero that is hidden."""
    name, is_calculus, left, right = pair(g, calculus and g.rng.random() < 0.5)
    zero = f"({left} - {right})"
    x, p = g.symbol(), g.positive(1)
    return name, is_calculus, *g.one(
        (f"{p}/{zero}", "0"),
        (f"{p}/{zero}", f"{x}/{zero}"),
        (f"exp(1/{zero})", "1"),
        (f"{zero}/{zero}", "1"),
        (f"{zero}/{zero}", "0"),
        (f"{p}*{zero}^(-1)", f"{p}*{zero}^(-1)"),
        (f"1/(1/{zero})", zero),
        (f"re({p}/{zero})", f"{p}/{zero}"),
        (f"sqrt({p}/{zero}^2)", f"sqrt({p})/{zero}"),
        (f"sum(n, 0, 2, {p}/({zero}*n))", f"{p}/{zero}"),
        (f"at({p}/z, z, {zero})", "0"),
        (f"at((z^2 - 1)/(z - 1), z, 1 + {zero})", "2"),
        (f"at(z*(1/z), z, {zero})", "1"),
        (f"at(sin(z)/z, z, {zero})", "1"),
    )


def without_value_elsewhere(g):
    """Sums and integrals that have no value, constants bound."""
    x = g.symbol()
    return g.one(
        (True, "sum(n, 1, inf, 1/n)", "11/6"),
        (True, f"sum(n, 1, inf, exp(n*{x}))", f"exp({x})/(1 - exp({x}))"),
        (True, f"sum(n, 1, inf, {x}) - sum(n, 1, inf, {x})", "0"),
        (True, f"int(s, 0, inf, exp({x}*s))", f"(-1/{x})"),
        (True, f"int(s, 0, inf, {x}) - int(s, 0, inf, {x})", "0"),
        (True, f"int(s, 0, inf, cos({x}*s))", "0"),
        (True, f"int(s, -1, 1, 1/s^2)", "(-2)"),
        (True, f"int(s, 0, {x}, 1/s)*0", "0"),
        (False, "at(exp(2*i*pi), pi, 1)", "1"),
        (False, "a[inf]", "a_3"),
        (False, "sum(n, 1, n_num, 1)", "3"),
        (False, "inf - inf", "0"),
        (False, f"{x}/inf", "0"),
        (False, f"at(at({x}/z, z, a - b), a, b)", "0"),
    )


def equation(rng):
    """One at random: half of them true by construction."""
    g = Grammar(rng)
    calculus = rng.random() < 0.45
    kind = rng.random()
    if kind < 0.03:
        if rng.random() < 0.5:
            is_calculus, left, right = without_value_elsewhere(g)
            return Equation("without a value", is_calculus, left, right, NO_VALUE)
        name, is_calculus, left, right = without_value(g, calculus)
        return Equation(name, is_calculus, left, right, NO_VALUE)
    if kind < 0.06:
        name, is_calculus, left, right = without_value(g, calculus)
        return Equation(name, is_calculus, left, right, NO_VALUE)
    if kind < 0.22:
        draw = g.one(tempting, tempting, tempting, no_zero)
        is_calculus, left, right = draw(g)
        while is_calculus != calculus:
            is_calculus, left, right = draw(g)
        for _ in range(rng.choice((0, 0, 0, 1))):
            left, right = around(g, calculus, f"({left})", f"({right})")
        return Equation("tempting", is_calculus, left, right, FALSE)
    name, is_calculus, left, right = pair(g, calculus)
    for _ in range(rng.choice((0, 0, 1, 1, 2))):
        left, right = around(g, calculus, left, right)
    if rng.random() < 0.3:
        left, right = right, left
    left, right = (reordered(g, values.read(t)) for t in (left, right))
    truth = TRUE
    if kind < 0.5:
        truth = FALSE
        if rng.random() < 0.5:
            left = changed(g, left)
        else:
            right = changed(g, right)
    return Equation(name, is_calculus, values.text_of(left), values.text_of(right), truth)


def equations(seed, count):
    """That many, all different, as one stream for each seed."""
    rng, seen, out = random.Random(seed), set(), []
    while len(out) < count:
        found = equation(rng)
        line = (found.left, found.right)
        if line not in seen:
            seen.add(line)
            out.append(found)
    return out
