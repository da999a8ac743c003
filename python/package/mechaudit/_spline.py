"""Splines with the interfaces of scipy's `CubicSpline`, `PchipInterpolator` and `Akima1DInterpolator`."""

from __future__ import annotations

from collections.abc import Sized
from fractions import Fraction
from typing import Any

import numpy as np

from . import _mechaudit
from ._checks import whole
from ._exact import exact, hexadecimal, of_hexadecimal

__all__ = ["Akima1DInterpolator", "CubicSpline", "PchipInterpolator"]

#: Orders of derivatives and integrals: each integral is one more pass over the coefficients.
_HIGHEST_ORDER = 100

_NAMED = {
    "not-a-knot": ("not-a-knot", 0.0),
    "natural": ("second", 0.0),
    "clamped": ("first", 0.0),
}


def _real_array(name: str, a: Any) -> Any:
    array = np.asarray(a)
    if np.issubdtype(array.dtype, np.complexfloating):
        raise ValueError(f"`{name}` must contain real values.")
    array = array.astype(np.float64)
    if not np.all(np.isfinite(array)):
        raise ValueError(f"`{name}` must contain only finite values.")
    return array


class CubicSpline:
    """Cubic spline through points, twice continuously differentiable.

    Parameters
    ----------
    x : array_like, shape (n,)
        Knots, finite and strictly increasing, at least two.
    y : array_like
        Ordinates; their dimension `axis` has the length n. Complex ones are taken part by part.
    axis : int
        The dimension of `y` that belongs to `x`.
    bc_type : str or tuple of two
        'not-a-knot' (the default), 'periodic', 'clamped', 'natural', or a condition for each end:
        one of these but 'periodic', or ``(order, value)`` with order 1 or 2 and the value of that
        derivative, of the shape of `y` without `axis`.
    extrapolate : {True, False, 'periodic', None}
        Outside of the knots: the polynomial of the end, NaN, or periodically. None is 'periodic' for
        a periodic spline and True otherwise.
    certified : bool
        Also keep the data exactly and answer `certified`: everything rational arithmetic gives.

    Attributes
    ----------
    x : ndarray
        The knots.
    c : ndarray, shape (4, n-1, ...)
        Coefficients of the local polynomials, the third power first.
    axis : int
        As given.
    extrapolate : bool or 'periodic'
        What is done outside of the knots.
    uniform : bool
        Whether the knots were found to be equally spaced: each of them the float nearest to
        ``x[0] + k*step``, as those of `numpy.arange` with whole numbers are, and those of
        `numpy.linspace` from 0. Then no search is needed.

    Notes
    -----
    Values come from the second derivatives at the knots, in fractions of a segment;
    ``mechaudit.audit("cubic-spline-not-a-knot", f)`` and its like judge any spline. `c` is made for
    those who want it and is not what is evaluated.

    Examples
    --------
    >>> import numpy as np
    >>> from mechaudit import CubicSpline
    >>> x = np.linspace(0, 1, 11)
    >>> s = CubicSpline(x, x**3)
    >>> bool(abs(s(0.55) - 0.55**3) < 1e-15), s.uniform
    (True, True)
    >>> round(float(s(0.5, 1)), 12), round(float(s.integrate(0, 1)), 12)
    (0.75, 0.25)
    """

    def __init__(
        self,
        x: Any,
        y: Any,
        axis: int = 0,
        bc_type: Any = "not-a-knot",
        extrapolate: bool | str | None = None,
        *,
        certified: bool = False,
    ) -> None:
        if certified and not _mechaudit.HAS_ORACLE:
            raise ValueError("certified=True needs references, which this build of mechaudit is without")
        if not isinstance(bc_type, (str, Sized)):
            raise TypeError(f"`bc_type` must be a name or two conditions, one of each end, got {bc_type!r}")
        x = _real_array("x", x)
        y = np.asarray(y)
        if y.dtype.kind not in "fiubc":
            raise TypeError(f"`y` must hold numbers, got {y.dtype}")
        is_complex = np.issubdtype(y.dtype, np.complexfloating) or _has_complex_end(bc_type)
        y = y.astype(np.complex128 if is_complex else np.float64)
        if x.ndim != 1:
            raise ValueError("`x` must be 1-dimensional.")
        if x.shape[0] < 2:
            raise ValueError("`x` must contain at least 2 elements.")
        axis = whole("axis", axis, -64, 64)
        if not -y.ndim <= axis < y.ndim:
            raise ValueError(f"axis = {axis} is out of bounds for `y` of dimension {y.ndim}.")
        axis %= y.ndim
        if x.shape[0] != y.shape[axis]:
            raise ValueError(f"The length of `y` along `axis`={axis} doesn't match the length of `x`")
        if not np.all(np.isfinite(y)):
            raise ValueError("`y` must contain only finite values.")
        if np.any(np.diff(x) <= 0):
            raise ValueError("`x` must be strictly increasing sequence.")
        y = np.moveaxis(y, axis, 0)
        self.x = x
        self.axis = axis
        self._shape = y.shape[1:]
        self._complex = is_complex
        ends = self._conditions(bc_type, y)
        if extrapolate is None:
            extrapolate = "periodic" if ends is None else True
        if extrapolate not in (True, False, "periodic"):
            raise ValueError(f"extrapolate must be True, False, 'periodic' or None, got {extrapolate!r}")
        self.extrapolate = extrapolate if extrapolate == "periodic" else bool(extrapolate)
        self._arguments = (np.moveaxis(y, 0, axis), bc_type, certified)
        flat = y.reshape(len(x), -1)
        self._y = flat
        if is_complex:
            self._y = np.stack([flat.real, flat.imag], axis=-1).reshape(len(x), -1)
        self._ends = ends
        wrap = self.extrapolate == "periodic"
        self._columns = [
            self._made(np.ascontiguousarray(column), k, wrap) for k, column in enumerate(self._y.T)
        ]
        self._certified = certified

    def _made(self, column: Any, k: int, wrap: bool) -> Any:
        """The solver's spline through one column of ordinates."""
        ends = None if self._ends is None else [(kind, float(v[k])) for kind, v in self._ends]
        return _mechaudit.Spline(self.x, column, ends, wrap)

    def _again(self, extrapolate: bool | str) -> CubicSpline:
        """The same spline with another behaviour outside of its knots."""
        y, bc_type, _ = self._arguments
        return CubicSpline(self.x, y, self.axis, bc_type, extrapolate)

    def _conditions(self, bc_type: Any, y: Any) -> Any:
        if isinstance(bc_type, str):
            if bc_type == "periodic":
                if not np.allclose(y[0], y[-1], rtol=1e-15, atol=1e-15):
                    raise ValueError(
                        f"The first and last `y` point along axis {self.axis} must be identical "
                        "(within machine precision) when bc_type='periodic'."
                    )
                y[-1] = y[0]
                return None
            bc_type = (bc_type, bc_type)
        elif len(bc_type) != 2:
            raise ValueError("`bc_type` must contain 2 elements to specify start and end conditions.")
        if "periodic" in [b for b in bc_type if isinstance(b, str)]:
            raise ValueError(
                "'periodic' `bc_type` is defined for both curve ends and cannot be used with other "
                "boundary conditions."
            )
        ends = [self._condition(b) for b in bc_type]
        if len(self.x) == 2 and {kind for kind, _ in ends} != {"not-a-knot"}:
            # There is no knot to be none; the chord's slope stands in, as with scipy.
            chord = self._split((y[1] - y[0]) / (self.x[1] - self.x[0]))
            ends = [("first", chord) if kind == "not-a-knot" else (kind, v) for kind, v in ends]
        return ends

    def _split(self, value: Any) -> Any:
        """Values in columns, real and imaginary parts side by side."""
        value = np.asarray(value, np.complex128 if self._complex else np.float64).reshape(-1)
        if not self._complex:
            return value
        return np.stack([value.real, value.imag], axis=-1).reshape(-1)

    def _condition(self, condition: Any) -> tuple[str, Any]:
        width = int(np.prod(self._shape)) * (2 if self._complex else 1)
        if isinstance(condition, str):
            if condition not in _NAMED:
                raise ValueError(f"bc_type={condition} is not allowed.")
            kind, named = _NAMED[condition]
            return kind, np.full(width, named)
        try:
            order, value = condition
        except Exception as e:
            raise ValueError(
                "A specified derivative value must be given in the form (order, value)."
            ) from e
        if order not in (1, 2):
            raise ValueError("The specified derivative order must be 1 or 2.")
        value = np.asarray(value)
        if value.shape != self._shape:
            raise ValueError(
                f"`deriv_value` shape {value.shape} is not the expected one - {self._shape}."
            )
        return ("first", "second")[order - 1], self._split(value)

    def __reduce__(self) -> tuple[Any, ...]:
        y, bc_type, certified = self._arguments
        return _rebuilt, (self.x, y, self.axis, bc_type, self.extrapolate, certified)

    @property
    def uniform(self) -> bool:
        return bool(self._columns) and self._columns[0].uniform

    @property
    def c(self) -> Any:
        c = self._joined(self._coefficients())
        return c.reshape(4, len(self.x) - 1, *self._shape)

    def _coefficients(self) -> Any:
        m = np.stack([s.second_derivatives() for s in self._columns], axis=-1)
        h = np.diff(self.x)[:, None]
        slope = np.diff(self._y, axis=0) / h
        low, high = m[:-1], m[1:]
        return np.stack(
            [(high - low) / (6 * h), low / 2, slope - h * (2 * low + high) / 6, self._y[:-1]]
        )

    def _joined(self, columns: Any) -> Any:
        """Real and imaginary columns as complex ones."""
        if not self._complex:
            return columns
        return columns[..., ::2] + 1j * columns[..., 1::2]

    def __call__(self, x: Any, nu: int = 0, extrapolate: bool | str | None = None) -> Any:
        """Evaluate the spline or one of its derivatives.

        Parameters
        ----------
        x : array_like
            Where.
        nu : int
            The order of the derivative; negative ones are integrals from the first knot.
        extrapolate : {True, False, 'periodic', None}
            Instead of the spline's own.

        Returns
        -------
        ndarray
            The dimension `axis` of the ordinates is replaced by those of `x`.
        """
        nu = whole("nu", nu, -_HIGHEST_ORDER, _HIGHEST_ORDER)
        if extrapolate is None:
            extrapolate = self.extrapolate
        points = np.asarray(x)
        if np.issubdtype(points.dtype, np.complexfloating):
            raise TypeError("the points of a spline are real")
        points = points.astype(np.float64)
        shape = points.shape
        flat = points.reshape(-1)
        if extrapolate == "periodic":
            first, period = self.x[0], self.x[-1] - self.x[0]
            flat = first + (flat - first) % period
        good = np.isfinite(flat)
        if not extrapolate:
            good &= (flat >= self.x[0]) & (flat <= self.x[-1])
        inside = np.ascontiguousarray(flat[good])
        out = np.full((len(flat), len(self._columns)), np.nan)
        for k, column in enumerate(self._columns):
            if nu >= 0:
                out[good, k] = column.values(inside, nu)
            else:
                out[good, k] = self._antiderivative(k, inside, -nu)
        out = self._joined(out).reshape(shape + self._shape)
        # The points' dimensions stand where `axis` stood.
        k = len(shape)
        order = (*range(k, k + self.axis), *range(k), *range(k + self.axis, out.ndim))
        return np.asarray(out.transpose(order))

    def _antiderivative(self, k: int, x: Any, order: int) -> Any:
        c = self._integrated(order)[:, :, k]
        i = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, c.shape[1] - 1)
        u = x - self.x[i]
        value = c[0, i]
        for power in c[1:]:
            value = value * u + power[i]
        return value

    def _integrated(self, order: int) -> Any:
        """Coefficients of the integral of that order which is zero at the first knot."""
        c = self._coefficients()
        h = np.diff(self.x)[:, None]
        for _ in range(order):
            powers = np.arange(c.shape[0], 0, -1)[:, None, None]
            c = np.concatenate([c / powers, np.zeros_like(c[:1])])
            value = np.zeros_like(c[0])
            for coefficient in c:
                value = value * h + coefficient
            c[-1, 1:] = np.cumsum(value[:-1], axis=0)
        return c

    def derivative(self, nu: int = 1) -> Derivative:
        """The derivative of that order as a function of its own; negative orders are integrals."""
        return Derivative(self, nu)

    def antiderivative(self, nu: int = 1) -> Derivative:
        """The integral of that order from the first knot as a function of its own."""
        return Derivative(self, -nu)

    def integrate(self, a: float, b: float, extrapolate: bool | str | None = None) -> Any:
        """The definite integral from `a` to `b`.

        Returns
        -------
        ndarray
            Of the shape of the ordinates without `axis`; NaN where the limits are outside of the
            knots and nothing is extrapolated.
        """
        if extrapolate is None:
            extrapolate = self.extrapolate
        a, b = float(a), float(b)
        if not extrapolate and (min(a, b) < self.x[0] or max(a, b) > self.x[-1]):
            found = np.full(len(self._columns), np.nan)
        elif (extrapolate == "periodic") != (self.extrapolate == "periodic"):
            return self._again("periodic" if extrapolate == "periodic" else True).integrate(a, b)
        else:
            found = np.array([s.integral(a, b) for s in self._columns])
        return np.asarray(self._joined(found).reshape(self._shape))

    def solve(self, y: float = 0.0, discontinuity: bool = True, extrapolate: Any = None) -> Any:
        """Where the spline has the value `y`.

        Parameters
        ----------
        y : float
            The value.
        discontinuity : bool
            Of no effect: a spline has none.
        extrapolate : {True, False, 'periodic', None}
            Whether roots outside of the knots count; periodic ones are those of one period.

        Returns
        -------
        ndarray
            The roots in order; an interval where the spline is `y` gives its start, then NaN. An
            object array of such arrays for several columns.
        """
        if self._complex:
            raise ValueError("Root finding is only for real-valued polynomials")
        if extrapolate is None:
            extrapolate = self.extrapolate
        outside = bool(extrapolate) and extrapolate != "periodic"
        c = self.c.reshape(4, len(self.x) - 1, -1)
        found = [self._roots_of(c[:, :, k], float(y), outside) for k in range(c.shape[2])]
        if not self._shape:
            return found[0]
        all_roots = np.empty(len(found), dtype=object)
        for k, roots in enumerate(found):
            all_roots[k] = roots
        return all_roots.reshape(self._shape)

    def roots(self, discontinuity: bool = True, extrapolate: Any = None) -> Any:
        """Where the spline is zero, see `solve`."""
        return self.solve(0.0, discontinuity, extrapolate)

    def _roots_of(self, c: Any, y: float, outside: bool) -> Any:
        roots: list[float] = []
        last = len(self.x) - 2
        for i in range(last + 1):
            coefficients = c[:, i].copy()
            coefficients[3] -= y
            h = self.x[i + 1] - self.x[i]
            if not np.any(coefficients):
                roots.extend((float(self.x[i]), float("nan")))
                continue
            found = np.roots(coefficients)
            scale = max(h, 1e-300)
            real = found.real[np.abs(found.imag) <= 1e-9 * np.maximum(np.abs(found), scale)]
            low = -np.inf if outside and i == 0 else 0.0
            high = np.inf if outside and i == last else h
            for t in np.sort(real):
                slack = 1e-12 * scale
                if low - slack <= t <= high + slack:
                    t = min(max(t, low), high)
                    root = float(self.x[i] + t)
                    if not roots or not abs(root - roots[-1]) <= 1e-9 * scale:
                        roots.append(root)
        return np.array(roots)

    def certified(self, x: Any, nu: int = 0) -> Any:
        """Exact values as fractions, for a spline made with ``certified=True``.

        Parameters
        ----------
        x : number, str or list of them
            Points within the knots or outside of them, taken exactly; outside, the polynomial of the
            end goes on.
        nu : int
            The order of the derivative, 0 to 3.

        Returns
        -------
        Fraction, or a list of them
            What exact arithmetic on the data gives: no rounding at all.

        Examples
        --------
        >>> from mechaudit import CubicSpline
        >>> s = CubicSpline([0, 1, 2, 4], [0, 1, 8, 64], certified=True)
        >>> s.certified("1/3")
        Fraction(1, 27)
        """
        if not isinstance(x, (list, tuple, np.ndarray)):
            return self._exactly([self._at(x, nu)])[0]
        return self._exactly([self._at(t, nu) for t in x])

    def certified_integral(self, a: Any, b: Any) -> Fraction:
        """The integral from `a` to `b` exactly."""
        return self._exactly([(hexadecimal(exact("a", a)), hexadecimal(exact("b", b)))])[0]

    def _at(self, x: Any, nu: int) -> Any:
        return hexadecimal(exact("x", x)), whole("nu", nu, 0, 3)

    def _exactly(self, asked: list[Any]) -> list[Fraction]:
        if not self._certified:
            raise ValueError("certified values need a spline made with certified=True")
        if len(self._columns) != 1:
            raise ValueError(f"certified values are for one column of ordinates, got {len(self._columns)}")
        kinds, values = self._exact_kinds()
        fractions = [
            [hexadecimal(Fraction(*float(t).as_integer_ratio())) for t in column]
            for column in (self.x, self._y[:, 0], values)
        ]
        low, high = fractions[2]
        found = _mechaudit.spline(fractions[0], fractions[1], kinds, (low, high), asked)
        return [of_hexadecimal(q) for q in found]

    def _exact_kinds(self) -> tuple[list[str], tuple[float, float]]:
        """What makes the exact spline the only one: a kind, or one for each end, and the end values."""
        if self._ends is None:
            return ["periodic"], (0.0, 0.0)
        (kind, first), (other, last) = self._ends
        return [kind, other], (float(first[0]), float(last[0]))


class _LocalSpline(CubicSpline):
    """Slopes at the knots from neighbouring points instead of a condition for each end."""

    _slopes: str

    def _start(self, x: Any, y: Any, axis: int, extrapolate: Any, certified: bool) -> None:
        if np.iscomplexobj(y):
            raise ValueError(f"`{type(self).__name__}` only works with real values for `y`.")
        super().__init__(x, y, axis, "natural", extrapolate, certified=certified)

    def _made(self, column: Any, k: int, wrap: bool) -> Any:
        return _mechaudit.HermiteSpline(self.x, column, self._slopes, wrap)

    @property
    def uniform(self) -> bool:
        return False

    def _coefficients(self) -> Any:
        s = np.stack([column.slopes() for column in self._columns], axis=-1)
        h = np.diff(self.x)[:, None]
        slope = np.diff(self._y, axis=0) / h
        over_left, over_right = s[:-1] - slope, s[1:] - slope
        both = over_left + over_right
        return np.stack([both / h / h, -(both + over_left) / h, s[:-1], self._y[:-1]])

    def _exact_kinds(self) -> tuple[list[str], tuple[float, float]]:
        return [self._slopes], (0.0, 0.0)


class PchipInterpolator(_LocalSpline):
    """Monotone piecewise cubic interpolant of Fritsch and Butland, with the interface of scipy's.

    Parameters
    ----------
    x, y, axis
        As of `CubicSpline`; `y` is real.
    extrapolate : {True, False, 'periodic', None}
        Outside of the knots: the polynomial of the end, NaN, or periodically. None is True.
    certified : bool
        Answer `certified` as well: everything rational arithmetic gives.

    Examples
    --------
    >>> from mechaudit import PchipInterpolator
    >>> s = PchipInterpolator([0, 1, 3, 4], [0, 1, 5, 4], certified=True)
    >>> s.certified(1, nu=1)
    Fraction(9, 7)
    """

    _slopes = "pchip"

    def __init__(
        self,
        x: Any,
        y: Any,
        axis: int = 0,
        extrapolate: bool | str | None = None,
        *,
        certified: bool = False,
    ) -> None:
        self._start(x, y, axis, extrapolate, certified)

    def _again(self, extrapolate: bool | str) -> CubicSpline:
        return PchipInterpolator(self.x, self._arguments[0], self.axis, extrapolate)

    def __reduce__(self) -> tuple[Any, ...]:
        y, _, certified = self._arguments
        return _rebuilt_pchip, (self.x, y, self.axis, self.extrapolate, certified)


class Akima1DInterpolator(_LocalSpline):
    """Akima's interpolant of 1970 or the modified one, with the interface of scipy's.

    Where both of Akima's weights are exactly 0 the slope is the mean of the two chords; scipy takes its
    fallback already below 1e-9 of the largest sum of weights anywhere in the data.

    Parameters
    ----------
    x, y, axis
        As of `CubicSpline`; `y` is real.
    method : {'akima', 'makima'}
        Akima's weights, or those of MATLAB's `makima`.
    extrapolate : {True, False, 'periodic', None}
        Outside of the knots: the polynomial of the end, NaN, or periodically. None is False.
    certified : bool
        Answer `certified` as well: everything rational arithmetic gives.
    """

    def __init__(
        self,
        x: Any,
        y: Any,
        axis: int = 0,
        *,
        method: str = "akima",
        extrapolate: bool | str | None = None,
        certified: bool = False,
    ) -> None:
        if method not in ("akima", "makima"):
            raise NotImplementedError(f"`method`={method} is unsupported.")
        self._slopes = method
        self._start(x, y, axis, False if extrapolate is None else extrapolate, certified)

    def _again(self, extrapolate: bool | str) -> CubicSpline:
        y = self._arguments[0]
        return Akima1DInterpolator(self.x, y, self.axis, method=self._slopes, extrapolate=extrapolate)

    def __reduce__(self) -> tuple[Any, ...]:
        y, _, certified = self._arguments
        return _rebuilt_akima, (self.x, y, self.axis, self._slopes, self.extrapolate, certified)


def _rebuilt_pchip(x: Any, y: Any, axis: int, extrapolate: Any, certified: bool) -> PchipInterpolator:
    return PchipInterpolator(x, y, axis, extrapolate, certified=certified)


def _rebuilt_akima(
    x: Any, y: Any, axis: int, method: str, extrapolate: Any, certified: bool
) -> Akima1DInterpolator:
    return Akima1DInterpolator(
        x, y, axis, method=method, extrapolate=extrapolate, certified=certified
    )


def _has_complex_end(bc_type: Any) -> bool:
    if isinstance(bc_type, str):
        return False
    pairs = [b for b in bc_type if not isinstance(b, str)]
    try:
        return any(np.iscomplexobj(value) for _, value in pairs)
    except (TypeError, ValueError):
        # The place where it is read reports what is wrong with it.
        return False


def _rebuilt(x: Any, y: Any, axis: int, bc_type: Any, extrapolate: Any, certified: bool) -> CubicSpline:
    return CubicSpline(x, y, axis, bc_type, extrapolate, certified=certified)


class Derivative:
    """A derivative of a spline, or an integral where the order is negative."""

    def __init__(self, spline: CubicSpline, order: int) -> None:
        self.spline = spline
        self.order = order

    @property
    def x(self) -> Any:
        """The knots."""
        return self.spline.x

    def __call__(self, x: Any, nu: int = 0, extrapolate: bool | str | None = None) -> Any:
        """Evaluate it, or a further derivative."""
        return self.spline(x, self.order + nu, extrapolate)

    def derivative(self, nu: int = 1) -> Derivative:
        """A further derivative."""
        return Derivative(self.spline, self.order + nu)

    def antiderivative(self, nu: int = 1) -> Derivative:
        """The function whose derivative of that order this is."""
        return Derivative(self.spline, self.order - nu)

    def integrate(self, a: float, b: float) -> Any:
        """The definite integral from `a` to `b`: a difference of two values."""
        return self.spline(b, self.order - 1) - self.spline(a, self.order - 1)
