"""Numbers as exact fractions, whatever type they come in."""

from __future__ import annotations

import numbers
from decimal import Context, Decimal, InvalidOperation
from fractions import Fraction
from typing import Any

import numpy as np

from ._mechaudit import DomainError

#: Exponents beyond these would fill the memory with digits.
_LARGEST_EXPONENT = 100_000

#: What is no number raises an exception, whatever the thread's own context does.
_READING = Context(traps=[InvalidOperation])


def _finite(name: str, x: Any) -> DomainError:
    return DomainError(f"{name} = {x} has no certified value: it must be finite")


def _of_string(name: str, text: str) -> Fraction:
    body = text.strip()
    try:
        if body.lower().lstrip("+-").startswith("0x"):
            return Fraction(*float.fromhex(body).as_integer_ratio())
        number = Decimal(body, _READING)
    except (ArithmeticError, ValueError):
        pass
    else:
        if not number.is_finite():
            raise _finite(name, text)
        return _of_decimal(name, number)
    try:
        # An exponent that no Decimal holds would fill the memory with digits.
        if "/" in body and "e" not in body.lower():
            return Fraction(body)
        raise ValueError
    except (ValueError, ZeroDivisionError):
        raise ValueError(
            f"{name}: {text!r} is neither a decimal number nor a fraction p/q"
        ) from None


def _of_decimal(name: str, number: Decimal) -> Fraction:
    if not number.is_finite():
        raise _finite(name, number)
    if abs(number.adjusted()) > _LARGEST_EXPONENT:
        raise ValueError(f"{name}: the exponent of {number} is beyond +-{_LARGEST_EXPONENT}")
    return Fraction(number)


def _of_mpf(name: str, x: Any) -> Fraction:
    sign, mantissa, exponent, _ = x._mpf_
    if not mantissa and exponent:
        raise _finite(name, x)
    if abs(exponent) > 4 * _LARGEST_EXPONENT:
        raise ValueError(f"{name}: the exponent of {x} is beyond 2**+-{4 * _LARGEST_EXPONENT}")
    value = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    return -value if sign else value


def exact(name: str, x: Any) -> Fraction:
    """The number itself; `name` is the argument's, for messages."""
    if isinstance(x, (bool, np.bool_)):
        raise TypeError(f"{name}: a truth value is no number")
    if isinstance(x, str):
        return _of_string(name, x)
    if isinstance(x, Decimal):
        return _of_decimal(name, x)
    if isinstance(x, Fraction):
        return x
    if isinstance(x, numbers.Integral):
        return Fraction(int(x))
    if hasattr(x, "_mpf_"):
        return _of_mpf(name, x)
    if isinstance(x, (float, np.floating)):
        if not np.isfinite(x):
            raise _finite(name, x)
        return Fraction(*x.as_integer_ratio())
    if hasattr(x, "p") and hasattr(x, "q"):
        return Fraction(int(x.p), int(x.q))
    if hasattr(x, "is_exact") and hasattr(x, "man_exp"):
        if not x.is_exact():
            raise TypeError(f"{name}: the ball {x} is no number; give its midpoint")
        mantissa, exponent = x.man_exp()
        return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    raise TypeError(
        f"{name}: {type(x).__name__} is no number; float, int, Fraction, Decimal, str and mpmath "
        "numbers are"
    )


def parts(name: str, z: Any) -> tuple[Fraction, Fraction, bool]:
    """Real and imaginary part, and whether the number is of a complex type."""
    if hasattr(z, "_mpc_"):
        return exact(name, z.real), exact(name, z.imag), True
    if isinstance(z, (complex, np.complexfloating)):
        return exact(name, z.real), exact(name, z.imag), True
    return exact(name, z), Fraction(0), False


def is_sequence(x: Any) -> bool:
    """Whether it is a sequence of numbers rather than one."""
    if isinstance(x, np.ndarray):
        return x.ndim > 0
    return isinstance(x, (list, tuple)) or (
        hasattr(x, "__array__") and hasattr(x, "__len__") and not np.isscalar(x)
    )


def hexadecimal(x: Fraction) -> tuple[str, str]:
    """A fraction as the compiled part takes it."""
    return format(x.numerator, "x"), format(x.denominator, "x")


def of_hexadecimal(pair: tuple[str, str]) -> Fraction:
    """A fraction as the compiled part gives it."""
    return Fraction(int(pair[0], 16), int(pair[1], 16))
