"""Arguments that count or are called: what they have to be, and the error that says so."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__: list[str] = []

#: Seeds are 64 bits wide.
LARGEST_SEED = 2**64 - 1
#: More branches than any mechanism has.
_MOST_BRANCHES = 2**32 - 1


def whole(name: str, value: Any, least: int, most: int) -> int:
    """The value as an integer within limits."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} must be an integer, got {value!r}")
    number: int = value.__index__()
    if not least <= number <= most:
        raise ValueError(f"{name} must be between {least} and {most}, got {number}")
    return number


def seed(value: Any) -> int:
    """The key of a random stream."""
    return whole("seed", value, 0, LARGEST_SEED)


def branch(value: Any) -> int | None:
    """The number of an assembly mode, or None."""
    return None if value is None else whole("branch", value, 0, _MOST_BRANCHES)


def function(name: str, value: Any) -> Callable[..., Any]:
    """The value, which has to be callable."""
    if not callable(value):
        raise TypeError(f"{name} must be callable, got {value!r}")
    found: Callable[..., Any] = value
    return found


def number(name: str, value: Any) -> float:
    """The value as a float."""
    if isinstance(value, (str, bytes, bool)):
        raise TypeError(f"{name} must be a number, got {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} must be a number, got {value!r}") from None


def names(name: str, value: Any) -> list[str] | None:
    """One name or several as a list; None stays None."""
    if value is None:
        return None
    if isinstance(value, str):
        return [value]
    try:
        found = list(value)
    except TypeError:
        raise TypeError(f"{name} must be a name or a list of names, got {value!r}") from None
    for one in found:
        if not isinstance(one, str):
            raise TypeError(f"{name} must hold names, got {one!r}")
    if not found:
        raise ValueError(f"{name} must hold at least one name")
    return found
