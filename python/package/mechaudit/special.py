"""The Faddeeva function and its relatives as NumPy ufuncs.

Drop-in replacements of the functions of the same names in `scipy.special`: the same arguments, types
and casting. Values have the bits of the Rust solvers. Where special values differ, they do so on
purpose; the package's README has the table.
"""

from __future__ import annotations

from ._mechaudit import (
    dawsn,
    erf,
    erfc,
    erfcx,
    erfi,
    voigt_profile,
    wofz,
    wofz_derivative,
)

__all__ = [
    "dawsn",
    "erf",
    "erfc",
    "erfcx",
    "erfi",
    "voigt_profile",
    "wofz",
    "wofz_derivative",
]
