"""Splines and tridiagonal systems beside scipy and exact arithmetic."""

import pickle
from fractions import Fraction

import mechaudit
import numpy as np
import pytest
from mechaudit import (
    Akima1DInterpolator,
    CubicSpline,
    PchipInterpolator,
    solve_cyclic,
    solve_tridiagonal,
)
from scipy import interpolate
from scipy.interpolate import CubicSpline as Theirs
from scipy.linalg import solve_banded

rng = np.random.default_rng(11)
X = np.sort(rng.uniform(-3, 5, 40))
Y = rng.normal(size=(40, 3, 2))
ENDS = ["not-a-knot", "natural", "clamped", ((1, Y[0]), (2, Y[1])), ("natural", (1, Y[2]))]


@pytest.mark.parametrize("bc_type", ENDS)
@pytest.mark.parametrize("nu", [-2, -1, 0, 1, 2, 3, 4])
def test_beside_scipy(bc_type, nu):
    ours, theirs = CubicSpline(X, Y, bc_type=bc_type), Theirs(X, Y, bc_type=bc_type)
    at = rng.uniform(-4, 6, (5, 7))
    got = ours(at, nu)
    due = theirs(at, nu) if nu >= 0 else theirs.antiderivative(-nu)(at)
    np.testing.assert_allclose(got, due, rtol=1e-8, atol=1e-8 * np.abs(due).max())
    np.testing.assert_allclose(ours.c, theirs.c, rtol=1e-6, atol=1e-6 * np.abs(theirs.c).max())
    if nu > 0:
        np.testing.assert_array_equal(ours.derivative(nu)(at), got)
    if nu < 0:
        np.testing.assert_array_equal(ours.antiderivative(-nu)(at), got)


@pytest.mark.parametrize("extrapolate", [True, False, "periodic"])
def test_outside(extrapolate):
    y = Y[:, 0, 0].copy()
    y[-1] = y[0]
    ours = CubicSpline(X, y, bc_type="periodic", extrapolate=extrapolate)
    theirs = Theirs(X, y, bc_type="periodic", extrapolate=extrapolate)
    at = np.concatenate([rng.uniform(-20, 20, 100), [np.nan]])
    np.testing.assert_allclose(ours(at), theirs(at), rtol=1e-9, atol=1e-9 * np.nanmax(np.abs(theirs(at))))
    for a, b in ((-1, 2), (2, -1), (-4, 7), (-30, 31)):
        due = theirs.integrate(a, b)
        np.testing.assert_allclose(ours.integrate(a, b), due, rtol=1e-8, atol=1e-10)
    assert ours.extrapolate == extrapolate


def test_equal_spacing_is_found():
    for x in (np.arange(10.0), np.linspace(0, 1, 11), -3 + 0.25 * np.arange(50), np.linspace(0, 7, 1000)):
        s = CubicSpline(x, np.sin(x))
        assert s.uniform
        at = np.linspace(x[0], x[-1], 777)
        np.testing.assert_allclose(s(at), Theirs(x, np.sin(x))(at), rtol=1e-11, atol=1e-12)
    assert not CubicSpline(X, Y).uniform
    moved = np.arange(10.0)
    moved[4] = np.nextafter(4.0, 5.0)
    assert not CubicSpline(moved, np.sin(moved)).uniform


def test_roots():
    x = np.linspace(0, 20, 81)
    s = CubicSpline(x, np.sin(x))
    np.testing.assert_allclose(s.roots(extrapolate=False), np.pi * np.arange(7), atol=1e-4)
    np.testing.assert_allclose(s.roots(), Theirs(x, np.sin(x)).roots(), atol=1e-7)
    np.testing.assert_allclose(s.solve(0.5), Theirs(x, np.sin(x)).solve(0.5), atol=1e-7)
    columns = CubicSpline(x, np.stack([np.sin(x), np.cos(x)], axis=1)).roots()
    assert columns.shape == (2,) and len(columns[1]) >= 6
    with pytest.raises(ValueError):
        CubicSpline(x, 1j * x).roots()


def test_complex_ordinates_and_axes():
    y = Y[:, :, 0] + 1j * Y[:, :, 1]
    for axis in (0, 1, -1):
        turned = np.moveaxis(y, 0, axis)
        ours, theirs = CubicSpline(X, turned, axis=axis), Theirs(X, turned, axis=axis)
        at = rng.uniform(-3, 5, (2, 4))
        np.testing.assert_allclose(ours(at), theirs(at), rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(ours.integrate(0, 1), theirs.integrate(0, 1), rtol=1e-9)


def test_refusals():
    x, y = [0, 1, 2, 3], [0, 1, 0, 1]
    for bad in (
        {"x": [0, 1, 1, 2]},
        {"x": [0, 1, 2, np.nan]},
        {"y": [0, 1, 0, np.inf]},
        {"x": [0, 1, 2]},
        {"x": [0], "y": [1]},
        {"bc_type": "periodic"},
        {"bc_type": "smooth"},
        {"bc_type": ("natural", (3, 0))},
        {"bc_type": ("natural", "periodic")},
        {"extrapolate": "wrong"},
        {"axis": 2},
    ):
        with pytest.raises(ValueError):
            CubicSpline(**{"x": x, "y": y, **bad})
    with pytest.raises(TypeError):
        CubicSpline(x, ["a", "b", "c", "d"])
    for neither in (None, 2, iter("nc")):
        with pytest.raises(TypeError, match="`bc_type` must be a name or two conditions"):
            CubicSpline(x, y, bc_type=neither)
    with pytest.raises(TypeError):
        CubicSpline(x, y)(1j)


def test_pickle():
    s = CubicSpline(X, Y, bc_type="natural", extrapolate=False)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(s))(X), s(X))


@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references")
@pytest.mark.parametrize("bc_type", ["not-a-knot", "natural", "clamped", ((2, 0.5), (2, -1.0))])
def test_exact_values(bc_type):
    x, y = [0.0, 0.5, 2.0, 3.25, 4.0], [1.0, -2.0, 0.125, 3.0, 1.0]
    s = CubicSpline(x, y, bc_type=bc_type, certified=True)
    at = [0.0, 0.3, 1.7, 3.25, 3.9]
    for nu in range(4):
        for t, exact in zip(at, s.certified(at, nu)):
            assert isinstance(exact, Fraction)
            assert abs(float(exact) - s(t, nu)) <= 1e-12 * max(1, abs(exact))
    assert abs(float(s.certified_integral(0, "3.9")) - s.integrate(0, 3.9)) < 1e-12
    assert s.certified(0.5) == -2
    with pytest.raises(ValueError, match="certified=True"):
        CubicSpline(x, y).certified(1)


LOCAL = [
    (PchipInterpolator, interpolate.PchipInterpolator, {}, "pchip"),
    (Akima1DInterpolator, interpolate.Akima1DInterpolator, {}, "akima"),
    (Akima1DInterpolator, interpolate.Akima1DInterpolator, {"method": "makima"}, "modified-akima"),
]


@pytest.mark.parametrize(("ours", "theirs", "named", "method"), LOCAL)
@pytest.mark.parametrize("nu", [-1, 0, 1, 2, 3, 4])
def test_local_slopes_beside_scipy(ours, theirs, named, method, nu):
    s, t = ours(X, Y, **named), theirs(X, Y, **named)
    at = rng.uniform(-4, 6, (5, 7))
    due = t(at, nu) if nu >= 0 else t.antiderivative(-nu)(at)
    np.testing.assert_allclose(s(at, nu), due, rtol=1e-8, atol=1e-8 * np.nanmax(np.abs(due)))
    np.testing.assert_allclose(s.c, t.c, rtol=1e-6, atol=1e-6 * np.abs(t.c).max())
    np.testing.assert_allclose(s.integrate(0, 1), t.integrate(0, 1), rtol=1e-9, atol=1e-11)
    again = pickle.loads(pickle.dumps(s))
    assert type(again) is ours and np.array_equal(again(X), s(X)) and not s.uniform


@pytest.mark.parametrize(("ours", "theirs", "named", "method"), LOCAL)
@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references")
def test_local_slopes_exactly(ours, theirs, named, method):
    x, y = [0, 1, 3, 4, 6], [0, 1, 5, 4, 4]
    s = ours(x, y, certified=True, **named)
    at = Fraction(5, 2)
    for nu in range(4):
        assert abs(float(s.certified(at, nu)) - s(2.5, nu)) < 1e-13
    assert abs(float(s.certified_integral(0, 5)) - s.integrate(0, 5)) < 1e-13


def test_local_slopes_refuse():
    with pytest.raises(ValueError, match="real values"):
        PchipInterpolator([0, 1], [0, 1j])
    with pytest.raises(NotImplementedError):
        Akima1DInterpolator([0, 1], [0, 1], method="smooth")
    assert np.isnan(Akima1DInterpolator([0, 1], [0, 1])(2))
    assert PchipInterpolator([0, 1], [0, 1])(2) == 2
    assert PchipInterpolator([0, 1, 2], [0, 1, 0], extrapolate="periodic")(2.5) == 0.75


def test_a_small_bend_far_from_a_large_one():
    x, y = np.arange(8.0), [0, 0, 1e-12, 3e-12, 4e-12, 4e-12, 1, 2]
    assert abs(Akima1DInterpolator(x, y)(2.0, 1) - 1.5e-12) < 1e-26


@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references")
def test_exact_values_with_mixed_ends():
    s = CubicSpline([0, 1, 2], [0, 1, 8], bc_type=((1, 0.0), (2, 12.0)), certified=True)
    assert s.certified("1/3") == Fraction(1, 27)
    s = CubicSpline([0, 1, 2, 3], [0, 1, 8, 27], bc_type=("not-a-knot", (1, 27.0)), certified=True)
    assert s.certified("5/2") == Fraction(125, 8)


def test_systems():
    n = 50
    lower, upper = rng.normal(size=(2, n - 1))
    diagonal = 5 + rng.normal(size=n)
    d = rng.normal(size=(n, 2, 3))
    banded = np.zeros((3, n))
    banded[0, 1:], banded[1], banded[2, :-1] = upper, diagonal, lower
    got = solve_tridiagonal(lower, diagonal, upper, d)
    due = solve_banded((1, 1), banded, d.reshape(n, -1)).reshape(d.shape)
    np.testing.assert_allclose(got.x, due, rtol=1e-12, atol=1e-13)
    assert got.stability.reliable and got.stability.relative_error < 1e-12
    # The evidence is that of the matrix as it was, and comes with the solution.
    one = solve_tridiagonal(lower, diagonal, upper, d[:, 0, 0])
    diagonal_before = diagonal.copy()
    diagonal[:] = np.nan
    x, stability = one
    diagonal[:] = diagonal_before
    np.testing.assert_allclose(x, got.x[:, 0, 0], rtol=1e-13, atol=1e-14)
    assert stability == got.stability and "reliable=True" in repr(one)
    lower, upper = rng.normal(size=(2, n))
    full = np.diag(diagonal) + np.diag(lower[1:], -1) + np.diag(upper[:-1], 1)
    full[0, -1], full[-1, 0] = lower[0], upper[-1]
    x = solve_cyclic(lower, diagonal, upper, d[:, 0, 0]).x
    np.testing.assert_allclose(x, np.linalg.solve(full, d[:, 0, 0]), rtol=1e-11, atol=1e-12)
    weak = solve_tridiagonal([1.0], [1e-20, 1.0], [1.0], [1.0, 2.0])
    assert not weak.stability.reliable
    for bad in (([1], [0, 1], [1], [1, 1]), ([1, 2], [1, 1], [1], [1, 1]), ([1], [1, 1], [1], [1, np.nan])):
        with pytest.raises(ValueError):
            solve_tridiagonal(*bad)
    with pytest.raises(ValueError, match="0 unknowns"):
        solve_tridiagonal([], [], [], [])
    with pytest.raises(TypeError):
        solve_tridiagonal([1j], [1, 1], [1], [1, 1])
    with pytest.raises(ValueError):
        solve_cyclic([1, 1], [4, 4], [1, 1], [1, 1])
