"""Certified digits of the Faddeeva function and its relatives.

Every answer holds a ball with a proven radius: the value lies in `interval`, and `str` gives it
rounded correctly to the digits asked for. What cannot be proved raises `Undecided`; where there is no
value, `DomainError` is raised.

Arguments are taken exactly as they are: floats, integers, `fractions.Fraction`, `decimal.Decimal`,
strings ("0.1" is a tenth, 0.1 is the float next to it), mpmath numbers, complex numbers, and sequences
of them, for which a list comes back.

Examples
--------
>>> from mechaudit import certified
>>> print(certified.wofz(1 + 1j, digits=30))
0.304744205256912592457138841070 + 0.208218938202831627287437347...j
>>> print(certified.erf("0.1", digits=40))
0.1124629160182848922032750717439683832217
"""

from __future__ import annotations

import importlib.util
from decimal import MAX_EMAX, MIN_EMIN, ROUND_HALF_EVEN, Context, Decimal, InvalidOperation, Overflow, Subnormal
from fractions import Fraction
from typing import Any, Protocol

from . import _mechaudit
from ._checks import whole
from ._exact import exact, hexadecimal, is_sequence, parts
from ._mechaudit import DomainError, Undecided

__all__ = [
    "Complex",
    "DomainError",
    "Real",
    "Undecided",
    "dawsn",
    "erf",
    "erfc",
    "erfcx",
    "erfi",
    "voigt_profile",
    "wofz",
    "wofz_derivative",
    "zeros",
]

#: More digits take longer than anybody waits without wanting to interrupt.
_MOST_DIGITS = 10_000
#: The numbers of zeros that can be asked for end here.
_MOST_ZEROS = 1_000_000
#: Digits beyond those asked for, of which rounding is decided; raised until it is.
_GUARDS = (6, 30, 150)
#: A radius is at least this many bits below the number in `interval`, which writes the ends out.
_SHORTEST_RADIUS = 1 << 16
#: The largest exponent of an end.
_LARGEST_EXPONENT = 1 << 22


def _mpmath() -> Any:
    if importlib.util.find_spec("mpmath") is None:
        return None
    import mpmath

    return mpmath


def context(digits: int, rounding: str = ROUND_HALF_EVEN) -> Context:
    """The context of every decimal here: the thread's own, which may have any precision, range and traps, has no
    part in them."""
    return Context(
        prec=digits,
        rounding=rounding,
        Emin=MIN_EMIN,
        Emax=MAX_EMAX,
        capitals=1,
        clamp=0,
        flags=[],
        traps=[InvalidOperation, Overflow, Subnormal],
    )


def written(number: Decimal) -> str:
    """A decimal as text, which for `str` depends on the thread's context."""
    return context(1).to_sci_string(number)


def half_unit(x: Real) -> Decimal:
    """Half a unit of the last digit, which is as far as a decimal rounded correctly can be off."""
    exponent = int(x.decimal.adjusted()) - x.digits + 1
    return Decimal((0, (5,), exponent - 1))


def _rounded(text: str, digits: int) -> Decimal | None:
    """The decimal rounded to `digits`, if an error of a unit of its last digit does not matter."""
    try:
        near = Decimal(text, context(1))
        if not near:
            # Only an exact zero is written so.
            return Decimal(0)
        figures, exponent = near.as_tuple()[1:]
        unit = Decimal((0, (1,), int(exponent)))
        narrow, wide = context(digits), context(len(figures) + 2)
        low, high = (narrow.plus(end) for end in (wide.subtract(near, unit), wide.add(near, unit)))
        # The same number may be written with fewer digits at one end: 0.99999 and 1.0000.
        return narrow.plus(near) if low == high else None
    except ArithmeticError:
        raise DomainError(
            f"the value, {text[:12]}...{text[-24:]}, has an exponent beyond what a Decimal holds"
        ) from None


class Real:
    """A real number with a proven error.

    Attributes
    ----------
    decimal : decimal.Decimal
        The value rounded correctly to `digits` significant digits.
    value : mpmath.mpf or decimal.Decimal
        The midpoint of the ball, exactly, if mpmath is installed; else `decimal`.
    radius : mpmath.mpf or decimal.Decimal
        A bound on the distance from `value` to the true value.
    interval : tuple of fractions.Fraction
        Two exact numbers between which the true value lies.
    digits : int
        Significant digits asked for.
    """

    __slots__ = ("_mid", "_rad", "decimal", "digits")

    def __init__(
        self, decimal: Decimal, digits: int, mid: tuple[int, int], rad: tuple[int, int]
    ) -> None:
        self.decimal = decimal
        self.digits = digits
        self._mid = mid
        self._rad = rad

    def _mpf(self, power: tuple[int, int]) -> Any:
        mpmath = _mpmath()
        return mpmath.mp.make_mpf(mpmath.libmp.from_man_exp(*power))

    @property
    def value(self) -> Any:
        return self.decimal if _mpmath() is None else self._mpf(self._mid)

    @property
    def radius(self) -> Any:
        if _mpmath() is not None:
            return self._mpf(self._rad)
        if not self._rad[0] and self.decimal == self._fraction(self._mid):
            return Decimal(0)
        return half_unit(self)

    @property
    def size(self) -> int:
        """The exponent of the smallest power of two above the midpoint; 0 for zero."""
        mantissa, exponent = self._mid
        return mantissa.bit_length() + exponent if mantissa else 0

    def _fraction(self, power: tuple[int, int]) -> Fraction:
        mantissa, exponent = power
        if not mantissa:
            return Fraction(0)
        if abs(exponent) > _LARGEST_EXPONENT:
            raise OverflowError(f"the number has a binary exponent of {exponent}: use value")
        return Fraction(mantissa) * Fraction(2) ** exponent

    @property
    def interval(self) -> tuple[Fraction, Fraction]:
        rad, least = self._rad, self.size - _SHORTEST_RADIUS
        if self._mid[0] and rad[0] and rad[0].bit_length() + rad[1] < least:
            # Widened, so that the ends are no longer than they have to be.
            rad = (1, least)
        mid, off = self._fraction(self._mid), self._fraction(rad)
        return mid - off, mid + off

    def arb(self) -> Any:
        """The ball as a `flint.arb`; needs python-flint."""
        flint = _flint()
        return flint.arb(self._mid, self._rad)

    def __float__(self) -> float:
        """The nearest float, for numbers that are none as well as can be told."""
        # Numbers beyond every float need not be written out.
        if self.size > 1025:
            raise OverflowError(f"the number has a binary exponent of {self.size}: use value")
        if self.size < -1100:
            return -0.0 if self._mid[0] < 0 else 0.0
        return float(self._fraction(self._mid))

    def __str__(self) -> str:
        return written(self.decimal)

    def __repr__(self) -> str:
        return f"Real('{self}')"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Real):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[Any, ...]:
        return self._mid, self._rad, self.digits

    def __reduce__(self) -> tuple[Any, ...]:
        return Real, (self.decimal, self.digits, self._mid, self._rad)


class Complex:
    """A complex number, each component with a proven error.

    Attributes
    ----------
    real, imag : Real
        The components.
    """

    __slots__ = ("imag", "real")

    def __init__(self, real: Real, imag: Real) -> None:
        self.real = real
        self.imag = imag

    @property
    def value(self) -> Any:
        """An `mpmath.mpc` with the midpoints, or a tuple of two `decimal.Decimal` without mpmath."""
        mpmath = _mpmath()
        if mpmath is None:
            return self.real.value, self.imag.value
        return mpmath.mp.make_mpc((self.real.value._mpf_, self.imag.value._mpf_))

    @property
    def radius(self) -> tuple[Any, Any]:
        """The radii of both components."""
        return self.real.radius, self.imag.radius

    @property
    def interval(self) -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
        """The intervals of both components."""
        return self.real.interval, self.imag.interval

    @property
    def digits(self) -> int:
        """Significant digits asked for."""
        return self.real.digits

    def acb(self) -> Any:
        """The balls as a `flint.acb`; needs python-flint."""
        return _flint().acb(self.real.arb(), self.imag.arb())

    def __complex__(self) -> complex:
        return complex(float(self.real), float(self.imag))

    def __str__(self) -> str:
        sign = "-" if self.imag.decimal.is_signed() else "+"
        return f"{self.real} {sign} {written(self.imag.decimal.copy_abs())}j"

    def __repr__(self) -> str:
        return f"Complex('{self}')"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Complex):
            return NotImplemented
        return self.real == other.real and self.imag == other.imag

    def __hash__(self) -> int:
        return hash((self.real, self.imag))

    def __reduce__(self) -> tuple[Any, ...]:
        return Complex, (self.real, self.imag)


def _flint() -> Any:
    try:
        import flint
    except ImportError:
        raise ImportError("balls of Arb need the package python-flint") from None
    return flint


def _checked(digits: int) -> int:
    return whole("digits", digits, 1, _MOST_DIGITS)


def _power(pair: tuple[str, str]) -> tuple[int, int]:
    return int(pair[0], 16), int(pair[1])


def _real(component: tuple[Any, Any, Any], digits: int) -> Real | None:
    text, mid, rad = component
    decimal = None if text is None else _rounded(text, digits)
    return None if decimal is None else Real(decimal, digits, _power(mid), _power(rad))


def _components(ask: Any, count: int, digits: int) -> list[list[Real]]:
    """`ask` with a growing number of digits until all of them can be rounded."""
    found: list[list[Real] | None] = [None] * count
    for guard in _GUARDS:
        open_rows = [i for i, row in enumerate(found) if row is None]
        for i, row in zip(open_rows, ask(open_rows, digits + guard)):
            reals = [_real(component, digits) for component in row]
            if all(r is not None for r in reals):
                found[i] = [r for r in reals if r is not None]
        if None not in found:
            return [row for row in found if row is not None]
    raise Undecided(f"{digits} digits could not be certified")


def _evaluate(method: str, arguments: list[list[Fraction]], digits: int) -> list[list[Real]]:
    rows = [[hexadecimal(x) for x in row] for row in arguments]

    def ask(which: list[int], more: int) -> Any:
        return _mechaudit.certify(method, [rows[i] for i in which], more)

    return _components(ask, len(rows), digits)


def _function(method: str, z: Any, digits: int, always_complex: bool, name: str) -> Any:
    digits = _checked(digits)
    single = not is_sequence(z)
    numbers = [z] if single else list(z)
    if any(is_sequence(x) for x in numbers):
        return [_function(method, row, digits, always_complex, name) for row in numbers]
    taken = [parts("z", x) for x in numbers]
    found = _evaluate(method, [[re, im] for re, im, _ in taken], digits)
    answers = [
        Complex(re, im) if is_complex or always_complex else re
        for (re, im), (_, _, is_complex) in zip(found, taken)
    ]
    return answers[0] if single else answers


class _Function(Protocol):
    def __call__(self, z: Any, *, digits: int = 30) -> Any: ...


def _certified(
    name: str, method: str, formula: str, example: str, always_complex: bool
) -> _Function:
    def function(z: Any, *, digits: int = 30) -> Any:
        return _function(method, z, digits, always_complex, name)

    answer = "Complex" if always_complex else "Real, or Complex where `z` is of a complex type"
    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"""{formula}

    Parameters
    ----------
    z : number, str or sequence
        The argument, taken exactly.
    digits : int
        Significant digits of each component, 1 to {_MOST_DIGITS}.

    Returns
    -------
    {answer}, or a list of them
        Each component rounded correctly, in a ball with a proven radius.

    Raises
    ------
    Undecided
        The digits could not be proved.
    DomainError
        The argument is not finite.

    Examples
    --------
    >>> from mechaudit import certified
    {example}
    """
    return function


wofz = _certified(
    "wofz",
    "faddeeva",
    "The Faddeeva function ``exp(-z**2) * erfc(-1j * z)``.",
    ">>> print(certified.wofz(1j, digits=25).real)\n    0.4275835761558070044107503",
    True,
)
wofz_derivative = _certified(
    "wofz_derivative",
    "faddeeva-derivative",
    "The derivative of the Faddeeva function.",
    ">>> print(certified.wofz_derivative(0, digits=20).imag)\n    1.1283791670955125739",
    True,
)
erf = _certified(
    "erf",
    "erf",
    "The error function.",
    ">>> print(certified.erf(0.5, digits=20))\n    0.52049987781304653768",
    False,
)
erfc = _certified(
    "erfc",
    "erfc",
    "The complementary error function.",
    ">>> print(certified.erfc(10, digits=20))\n    2.0884875837625447570E-45",
    False,
)
erfcx = _certified(
    "erfcx",
    "erfcx",
    "The scaled complementary error function.",
    ">>> print(certified.erfcx(1, digits=20))\n    0.42758357615580700441",
    False,
)
erfi = _certified(
    "erfi",
    "erfi",
    "The imaginary error function.",
    ">>> print(certified.erfi(1, digits=20))\n    1.6504257587975428760",
    False,
)
dawsn = _certified(
    "dawsn",
    "dawson",
    "Dawson's integral.",
    ">>> print(certified.dawsn(1, digits=20))\n    0.53807950691276841914",
    False,
)


def voigt_profile(x: Any, sigma: Any, gamma: Any, *, digits: int = 30) -> Any:
    """The Voigt profile, see `mechaudit.special.voigt_profile`.

    Parameters
    ----------
    x, sigma, gamma : number or str, or `x` a sequence of them
        Distance from the centre, standard deviation and half-width, taken exactly.
    digits : int
        Significant digits, 1 to 10000.

    Returns
    -------
    Real, or a list of them where `x` is a sequence

    Raises
    ------
    Undecided
        The digits could not be proved.
    DomainError
        An argument is not finite, a width is negative, or there is no value.

    Examples
    --------
    >>> from mechaudit import certified
    >>> print(certified.voigt_profile(1, 1, 1, digits=20))
    0.16579566268916645707
    """
    digits = _checked(digits)
    single = not is_sequence(x)
    widths = [exact("sigma", sigma), exact("gamma", gamma)]
    if min(widths) < 0 or max(widths) == 0:
        raise DomainError(
            f"sigma = {sigma} and gamma = {gamma} must not be negative, nor both zero"
        )
    numbers = [x] if single else list(x)
    found = _evaluate("voigt", [[exact("x", t), *widths] for t in numbers], digits)
    answers = [row[0] for row in found]
    return answers[0] if single else answers


def zeros(count: int, *, digits: int = 30, function: str = "wofz", first: int = 1) -> list[Complex]:
    """Zeros in the right half-plane, counted by increasing modulus.

    Parameters
    ----------
    count : int
        How many.
    digits : int
        Significant digits of each component, 1 to 10000.
    function : {'wofz', 'erf'}
        Of which function. Those of w lie in the lower half-plane, in pairs z and -conj(z); those of
        erf in the first quadrant stand for z, -z and their conjugates, beside the zero at 0.
    first : int
        The number of the first one, counted from 1.

    Returns
    -------
    list of Complex
        Existence and uniqueness next to each are proved by the Newton-Kantorovich theorem.

    Examples
    --------
    >>> from mechaudit import certified
    >>> print(certified.zeros(1, digits=20)[0])
    1.9914668428338795773 - 1.3548101281120062489j
    """
    digits = _checked(digits)
    count = whole("count", count, 0, _MOST_ZEROS)
    first = whole("first", first, 1, _MOST_ZEROS)
    if first + count > _MOST_ZEROS:
        raise ValueError(f"first + count must not exceed {_MOST_ZEROS}, got {first + count}")

    def ask(which: list[int], more: int) -> Any:
        return [_mechaudit.zero(function, first + k, more) for k in which]

    return [Complex(re, im) for re, im in _components(ask, count, digits)]
