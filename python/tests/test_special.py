"""The ufuncs: NumPy's machinery, bits, special values."""

import pickle
import warnings

import mechaudit
import numpy as np
import pytest
import scipy.special
from mechaudit import special

COMPLEX = ("wofz", "wofz_derivative", "erf", "erfc", "erfcx", "erfi", "dawsn")
REAL = ("erf", "erfc", "erfcx", "erfi", "dawsn")
METHODS = {
    "wofz": "faddeeva",
    "wofz_derivative": "faddeeva-derivative",
    "erf": "erf",
    "erfc": "erfc",
    "erfcx": "erfcx",
    "erfi": "erfi",
    "dawsn": "dawson",
}


def plane(n, seed=1):
    rng = np.random.default_rng(seed)
    return rng.uniform(-8, 8, n) + 1j * rng.uniform(-4, 8, n)


def same(a, b):
    """Equal bit by bit, but for what NaNs carry."""
    a, b = np.atleast_1d(a), np.atleast_1d(b)
    assert a.dtype == b.dtype and a.shape == b.shape
    parts = [(a.real, b.real), (a.imag, b.imag)] if a.dtype.kind == "c" else [(a, b)]
    for p, q in parts:
        np.testing.assert_array_equal(p, q)
        finite = ~np.isnan(p)
        np.testing.assert_array_equal(np.signbit(p[finite]), np.signbit(q[finite]))


@pytest.fixture(params=COMPLEX)
def f(request):
    return getattr(special, request.param)


def test_they_are_ufuncs_with_scipy_s_types():
    for name in special.__all__:
        ours = getattr(special, name)
        assert isinstance(ours, np.ufunc) and ours.__name__ == name
        theirs = getattr(scipy.special, name, None)
        if theirs is not None:
            assert (ours.nin, ours.nout, ours.types) == (theirs.nin, theirs.nout, theirs.types)


@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs the methods of the full build")
@pytest.mark.parametrize("name", COMPLEX)
def test_bits_are_those_of_the_rust_solvers(name):
    """Batches behind contiguous arrays against the solver called point by point in Rust."""
    run = mechaudit._mechaudit.Run(METHODS[name], seed=5, cases=40)
    block = run.block(0, len(run))
    z = np.empty(len(block), complex)
    z.real, z.imag = block[:, 0], block[:, 1]
    own = np.array([run.own(i) or [np.nan, np.nan] for i in range(len(run))])
    w = getattr(special, name)(z)
    same(w.real, own[:, 0])
    same(w.imag, own[:, 1])


@pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs the methods of the full build")
def test_bits_of_the_voigt_profile():
    run = mechaudit._mechaudit.Run("voigt", seed=5, cases=40)
    block = run.block(0, len(run))
    own = np.array([(run.own(i) or [np.nan])[0] for i in range(len(run))])
    same(special.voigt_profile(*block.T), own)
    x, sigma, gamma = block[:, 0], 0.7, 0.2
    same(special.voigt_profile(x, sigma, gamma), [special.voigt_profile(t, sigma, gamma) for t in x])


@pytest.mark.parametrize("n", [0, 1, 2, 4, 5, 7, 100, 2047, 2048, 2049, 5000])
def test_one_by_one_is_all_at_once(f, n):
    z = plane(n)
    same(f(z), np.array([f(t) for t in z], dtype=complex))


def test_layouts_give_the_same_bits(f):
    z = plane(3000)
    w = f(z)
    spread = np.zeros(6000, complex)
    spread[::2] = z
    same(f(spread[::2]), w)
    same(f(z[::-1]), w[::-1])
    off = np.empty(16 * len(z) + 1, np.uint8)[1:].view(complex)
    off[:] = z
    assert not off.flags.aligned
    same(f(off), w)
    swapped = z.astype(">c16")
    same(f(swapped), w)
    table = z.reshape(60, 50)
    same(f(table.T), w.reshape(60, 50).T)
    same(f(np.asfortranarray(table)), w.reshape(60, 50))
    same(f(np.broadcast_to(z[:5, None], (5, 7))), np.broadcast_to(w[:5, None], (5, 7)))


def test_out_where_and_in_place(f):
    z = plane(3000)
    w = f(z)
    out = np.full(3000, 7j)
    assert f(z, out=out) is out
    same(out, w)
    kept = np.full(3000, 7j)
    mask = z.real > 0
    f(z, out=kept, where=mask)
    same(kept, np.where(mask, w, 7j))
    again = z.copy()
    f(again, out=again)
    same(again, w)
    shifted = z.copy()
    f(shifted[:-1], out=shifted[1:])
    same(shifted[1:], w[:-1])
    turned = z.copy()
    f(turned[::-1], out=turned)
    same(turned, w[::-1])
    strided = np.zeros((3000, 2), complex)
    f(z, out=strided[:, 1])
    same(strided[:, 1], w)
    assert not strided[:, 0].any()


def test_single_precision_is_rounded_once(f):
    z = plane(3000).astype(np.complex64)
    w = f(z)
    assert w.dtype == np.complex64
    same(w, f(z.astype(complex)).astype(np.complex64))
    in_place = z.copy()
    f(in_place, out=in_place)
    same(in_place, w)
    if f.__name__ in REAL:
        x = z.real.copy()
        same(f(x), f(x.astype(float)).astype(np.float32))
    x, s, g = (np.abs(t) for t in (z.real, z.imag, z.real[::-1]))
    v = special.voigt_profile(x, s, g)
    assert v.dtype == np.float32
    same(v, special.voigt_profile(*(t.astype(float) for t in (x, s, g))).astype(np.float32))


@pytest.mark.parametrize("name", REAL)
def test_real_arguments(name):
    f = getattr(special, name)
    x = np.concatenate([np.linspace(-30, 30, 4001), [0.0, -0.0, np.inf, -np.inf, np.nan, 5e-324]])
    y = f(x)
    assert y.dtype == np.float64
    with np.errstate(all="ignore"):
        theirs = getattr(scipy.special, name)(x)
        # scipy's erfi is infinite from 26.64 on, the function is above the range from 26.72 on.
        far = (np.abs(x) > 26.6) & (np.abs(x) < 26.8) & (name == "erfi")
        np.testing.assert_allclose(y[~far], theirs[~far], rtol=1e-13, atol=1e-307)
    for kind in (np.int8, np.int16, np.int64, np.float16, bool):
        few = np.array([0, 1, 1], dtype=kind)
        assert f(few).dtype == getattr(scipy.special, name)(few).dtype
        same(f(few), f(few.astype(float)))


def test_voigt_broadcasts():
    x = np.linspace(-3, 3, 50)[:, None, None]
    sigma = np.array([0.0, 0.1, 1.0])[:, None]
    gamma = np.array([0.0, 0.2])
    v = special.voigt_profile(x, sigma, gamma)
    assert v.shape == (50, 3, 2)
    np.testing.assert_allclose(v, scipy.special.voigt_profile(x, sigma, gamma), rtol=1e-12)
    # Out over one of the inputs.
    widths = np.full(50, 0.3)
    expected = special.voigt_profile(x[:, 0, 0], widths, 0.1)
    special.voigt_profile(x[:, 0, 0], widths, 0.1, out=widths)
    same(widths, expected)


def test_nothing_is_left_in_the_floating_point_status(f):
    z = np.concatenate([plane(3000), 1e200 * plane(3000, 2), [np.nan, np.inf, -1j * np.inf, 0]])
    with warnings.catch_warnings(), np.errstate(all="raise"):
        warnings.simplefilter("error")
        f(z)
        f(z[::2])
        f(z[:3])
    # Flags that others raised are theirs.
    with np.errstate(all="warn"), pytest.warns(RuntimeWarning):
        np.divide(f(np.array([1.0])).real, 0.0)


def test_wrong_arguments_are_refused():
    for bad in ("a", None, object(), np.array(["x"])):
        with pytest.raises(TypeError):
            special.wofz(bad)
    with pytest.raises(TypeError):
        special.wofz(np.longdouble(1))
    with pytest.raises(TypeError):
        special.wofz(1, 2, 3)
    with pytest.raises(ValueError):
        special.wofz(np.zeros(3), out=np.zeros(4, complex))
    with pytest.raises(TypeError):
        special.wofz(np.zeros(3), out=np.zeros(3))
    with pytest.raises(TypeError):
        special.voigt_profile(1j, 1.0, 1.0)


def test_they_are_pickled_by_name():
    for name in special.__all__:
        f = getattr(special, name)
        assert pickle.loads(pickle.dumps(f)) is f


def test_subclasses():
    pd = pytest.importorskip("pandas")
    series = pd.Series([0.5, 1.0], index=["a", "b"])
    got = special.erf(series)
    assert isinstance(got, pd.Series) and list(got.index) == ["a", "b"]
    same(got.to_numpy(), special.erf(series.to_numpy()))
    units = pytest.importorskip("astropy.units")
    quantity = np.array([0.5, 1.0]) * units.dimensionless_unscaled
    # astropy knows the functions of scipy.special by name; of ours it says that it does not know them.
    with pytest.raises(TypeError):
        special.erf(quantity)
    same(special.erf(quantity.value), special.erf(np.array([0.5, 1.0])))

    class Tagged(np.ndarray):
        def __array_ufunc__(self, ufunc, method, *inputs, **kwargs):
            return ufunc.__name__, method

    assert special.wofz(np.zeros(2).view(Tagged)) == ("wofz", "__call__")
    matrix = np.ma.masked_array([0.5, 1.0], mask=[False, True])
    assert isinstance(special.erf(matrix), np.ma.MaskedArray)


def test_special_values():
    inf, nan = np.inf, np.nan
    w = special.wofz
    assert w(0) == 1 and w(complex(3, inf)) == 0 and w(complex(inf, 2)) == 0
    assert w(complex(0, -inf)) == complex(inf, 0)
    for z in (complex(1, -inf), complex(nan, 1), complex(1, nan)):
        assert np.isnan(w(z).real) and np.isnan(w(z).imag)
    on_axis = w(complex(0, nan))
    assert np.isnan(on_axis.real) and on_axis.imag == 0
    assert special.erf(inf) == 1 and special.erfc(-inf) == 2 and special.erfcx(inf) == 0
    assert special.erfcx(-inf) == inf and special.dawsn(-inf) == 0
    assert np.isnan(special.voigt_profile(0.0, -1.0, 1.0))
