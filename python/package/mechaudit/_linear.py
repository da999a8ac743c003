"""Tridiagonal systems by the sweep, with the evidence for the solution."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from . import _mechaudit

__all__ = ["Solution", "Stability", "solve_cyclic", "solve_tridiagonal"]


class Stability(NamedTuple):
    """Bounds of the errors of a solution.

    Attributes
    ----------
    growth : float
        The largest entry that elimination produced, relative to its row.
    dominant : bool
        Whether the matrix is diagonally dominant, by rows or by columns.
    rcond : float
        Estimated reciprocal condition number in the 1-norm.
    skeel : float
        Estimated condition number by Skeel.
    relative_error : float
        Estimated bound on the relative error.
    reliable : bool
        Whether the sweep without pivoting was stable enough.
    """

    growth: float
    dominant: bool
    rcond: float
    skeel: float
    relative_error: float
    reliable: bool


class Solution:
    """A solution with the evidence for it, which unpacks as ``x, stability``.

    Attributes
    ----------
    x : ndarray
        The unknowns.
    stability : Stability
        How far they can be trusted: computed when it is read first, which takes as long as a dozen
        solutions.
    """

    __slots__ = ("_bands", "_evidence", "_stability", "x")

    def __init__(self, x: Any, evidence: Any, bands: list[Any]) -> None:
        self.x = x
        self._evidence = evidence
        # Of their own: the caller may write to his arrays.
        self._bands = [band.copy() for band in bands]
        self._stability: Stability | None = None

    @property
    def stability(self) -> Stability:
        if self._stability is None:
            self._stability = Stability(*self._evidence(*self._bands))
        return self._stability

    def __iter__(self) -> Iterator[Any]:
        yield self.x
        yield self.stability

    def __repr__(self) -> str:
        return f"Solution(x={self.x!r}, stability={self.stability!r})"


def _array(name: str, a: Any) -> Any:
    array = np.asarray(a)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name} must hold real numbers, got {array.dtype}")
    return array.astype(np.float64, copy=False)


def _solve(function: Any, evidence: Any, lower: Any, diagonal: Any, upper: Any, d: Any) -> Solution:
    bands = [np.ascontiguousarray(_array(n, a)) for n, a in zip(("lower", "diagonal", "upper"), (lower, diagonal, upper))]
    for name, band in zip(("lower", "diagonal", "upper"), bands):
        if band.ndim != 1:
            raise ValueError(f"{name} must have one dimension, got {band.ndim}")
    right = _array("d", d)
    n = len(bands[1])
    if right.ndim == 0 or right.shape[0] != n:
        raise ValueError(f"d must have {n} rows as the diagonal has, got shape {right.shape}")
    # Each right-hand side in one piece, and so each solution.
    columns = np.ascontiguousarray(right.reshape(n, math.prod(right.shape[1:])).T)
    x = function(*bands, columns.reshape(-1)).reshape(columns.shape).T.reshape(right.shape)
    return Solution(x, evidence, bands)


def solve_tridiagonal(lower: Any, diagonal: Any, upper: Any, d: Any) -> Solution:
    """Solve ``A x = d`` for a tridiagonal matrix by the sweep (Thomas's algorithm).

    Parameters
    ----------
    lower, diagonal, upper : array_like
        The bands of A: n - 1, n and n - 1 numbers.
    d : array_like, shape (n,) or (n, ...)
        Right-hand sides.

    Returns
    -------
    Solution
        `x`, of the shape of `d`, and `stability`.

    Raises
    ------
    ValueError
        Lengths that do not fit, a number that is not finite, a pivot that is zero.

    See Also
    --------
    scipy.linalg.solve_banded : Pivots, and takes any number of bands.

    Examples
    --------
    >>> from mechaudit import solve_tridiagonal
    >>> s = solve_tridiagonal([1, 1], [4, 4, 4], [1, 1], [6, 12, 14])
    >>> s.x
    array([1., 2., 3.])
    >>> s.stability.reliable
    True
    """
    return _solve(_mechaudit.solve_tridiagonal, _mechaudit.tridiagonal_stability, lower, diagonal, upper, d)


def solve_cyclic(lower: Any, diagonal: Any, upper: Any, d: Any) -> Solution:
    """Solve ``A x = d`` for a cyclic tridiagonal matrix.

    Parameters
    ----------
    lower, diagonal, upper : array_like
        n numbers each: row i is ``lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1]``, with
        indices modulo n.
    d : array_like, shape (n,) or (n, ...)
        Right-hand sides.

    Returns
    -------
    Solution
        `x`, of the shape of `d`, and `stability`.

    Raises
    ------
    ValueError
        Fewer than three rows, lengths that do not fit, a number that is not finite, a pivot that is
        zero.

    Examples
    --------
    >>> from mechaudit import solve_cyclic
    >>> solve_cyclic([1] * 4, [4] * 4, [1] * 4, [6, 6, 6, 6]).x
    array([1., 1., 1., 1.])
    """
    return _solve(_mechaudit.solve_cyclic, _mechaudit.cyclic_stability, lower, diagonal, upper, d)
