"""Certified digits against mpmath and Arb, and what is refused."""

import pickle
from decimal import Decimal
from fractions import Fraction

import mechaudit
import numpy as np
import pytest

pytestmark = pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references")
if mechaudit.HAS_ORACLE:
    from mechaudit import certified

mpmath = pytest.importorskip("mpmath")


def test_against_mpmath():
    rng = np.random.default_rng(3)
    with mpmath.workdps(60):
        for z in rng.uniform(-4, 4, 20) + 1j * rng.uniform(-3, 4, 20):
            t = mpmath.mpc(z)
            w = mpmath.exp(-t * t) * mpmath.erfc(-1j * t)
            for found, due in (
                (certified.wofz(z), w),
                (certified.wofz_derivative(z), -2 * t * w + 2j / mpmath.sqrt(mpmath.pi)),
                (certified.erf(z), mpmath.erf(t)),
                (certified.erfc(z), mpmath.erfc(t)),
                (certified.erfcx(z), mpmath.exp(t * t) * mpmath.erfc(t)),
                (certified.erfi(z), mpmath.erfi(t)),
                (certified.dawsn(z), mpmath.exp(-t * t) * mpmath.erfi(t) * mpmath.sqrt(mpmath.pi) / 2),
            ):
                for part, exact in ((found.real, due.real), (found.imag, due.imag)):
                    assert abs(mpmath.mpf(str(part)) - exact) <= abs(exact) * mpmath.mpf(10) ** -29
                    assert abs(part.value - exact) <= part.radius + abs(exact) * mpmath.mpf(10) ** -50


def test_voigt():
    with mpmath.workdps(50):
        x, s, g = mpmath.mpf(1) / 3, mpmath.mpf("0.7"), mpmath.mpf(2)
        z = (x + 1j * g) / (s * mpmath.sqrt(2))
        due = (mpmath.exp(-z * z) * mpmath.erfc(-1j * z)).real / (s * mpmath.sqrt(2 * mpmath.pi))
        found = certified.voigt_profile(Fraction(1, 3), "0.7", 2)
        assert abs(mpmath.mpf(str(found)) - due) < mpmath.mpf(10) ** -30
    with pytest.raises(mechaudit.DomainError):
        certified.voigt_profile(1, -1, 1)


def test_the_last_digit_is_rounded_correctly():
    """At every number of digits the answer is the rounding of a longer one."""
    for z in (0.1, 1 + 2j, 3 - 1j, 1e-5j, 40):
        long = certified.wofz(z, digits=80)
        for digits in range(1, 45):
            short = certified.wofz(z, digits=digits)
            for a, b in ((short.real, long.real), (short.imag, long.imag)):
                assert a.decimal == b.decimal.normalize().__round__(0) if not b.decimal else True
                low, high = b.interval
                unit = Fraction(10) ** (a.decimal.adjusted() - digits + 1)
                assert abs(Fraction(a.decimal) - low) <= unit / 2
                assert abs(Fraction(a.decimal) - high) <= unit / 2
                assert len(a.decimal.as_tuple().digits) == digits or not a.decimal


def test_inputs_are_taken_exactly():
    tenth = [Fraction(1, 10), Decimal("0.1"), "0.1", "1/10", "1e-1"]
    values = {str(certified.erf(x, digits=40)) for x in tenth}
    assert values == {"0.1124629160182848922032750717439683832217"}
    floats = [0.1, np.float64(0.1), float.hex(0.1), mpmath.mpf(0.1), Fraction(0.1)]
    assert len({str(certified.erf(x, digits=40)) for x in floats}) == 1
    assert str(certified.erf(0.1, digits=40)) not in values
    assert certified.erf(np.float32(0.5)) == certified.erf(0.5)
    assert certified.erf(np.int16(2)) == certified.erf(2)
    both = certified.wofz(mpmath.mpc(1, 2))
    assert both == certified.wofz(1 + 2j) == certified.wofz(np.complex64(1 + 2j))


def test_sequences():
    z = [0.5, "0.25", 1 + 1j]
    found = certified.wofz(z, digits=12)
    assert found == [certified.wofz(t, digits=12) for t in z]
    table = np.arange(6.0).reshape(2, 3)
    rows = certified.erf(table, digits=10)
    assert [len(row) for row in rows] == [3, 3]
    assert certified.erf([]) == []
    assert certified.voigt_profile([0, 1], 1, 1)[1] == certified.voigt_profile(1, 1, 1)


def test_zeros():
    found = certified.zeros(3, digits=40)
    for z in found:
        with mpmath.workdps(60):
            w = mpmath.exp(-z.value**2) * mpmath.erfc(-1j * z.value)
            assert abs(w) < mpmath.mpf(10) ** -35
    assert certified.zeros(1, digits=40, first=3) == found[2:]
    e = certified.zeros(1, function="erf")[0]
    assert str(e.real).startswith("1.4506161632") and str(e.imag).startswith("1.8809430001")
    for bad in ({"count": -1}, {"count": 1, "first": 0}, {"count": 1, "function": "sin"}):
        with pytest.raises(ValueError):
            certified.zeros(**bad)


def test_what_has_no_value():
    for bad in (float("nan"), float("inf"), complex(0, float("inf")), "inf", Decimal("nan"), mpmath.inf):
        with pytest.raises(mechaudit.DomainError, match="finite"):
            certified.wofz(bad)
    for bad in (None, object(), True, b"1"):
        with pytest.raises(TypeError, match="z:"):
            certified.wofz(bad)
    for bad in ("x", "1/0", "", "1e200000"):
        with pytest.raises(ValueError, match="z:"):
            certified.wofz(bad)
    for bad in (0, -1, 10_001):
        with pytest.raises(ValueError, match="digits"):
            certified.wofz(1, digits=bad)
    for bad in (1.5, "3", True):
        with pytest.raises(TypeError, match="digits"):
            certified.wofz(1, digits=bad)
    # Below every exponent of a Decimal.
    with pytest.raises(mechaudit.DomainError, match="exponent"):
        certified.wofz(1e300)
    assert issubclass(mechaudit.DomainError, ValueError)
    assert issubclass(mechaudit.Undecided, ArithmeticError)


def test_exact_values_and_zeros():
    one = certified.wofz(0)
    assert one.real.interval == (1, 1) and one.imag.interval == (0, 0) and one.real.radius == 0
    assert str(certified.erf(0)) == "0" and complex(one) == 1


def test_many_digits():
    text = str(certified.erf("0.5", digits=2000))
    with mpmath.workdps(2010):
        assert abs(mpmath.mpf(text) - mpmath.erf(mpmath.mpf(1) / 2)) < mpmath.mpf(10) ** -1999


def test_balls_of_arb():
    flint = pytest.importorskip("flint")
    z = 1.25 + 0.5j
    found = certified.erf(z, digits=50)
    ball = found.acb()
    assert isinstance(ball, flint.acb)
    old = flint.ctx.prec
    try:
        flint.ctx.prec = 300
        due = flint.acb(1.25, 0.5).erf()
        assert found.real.arb().overlaps(due.real) and found.imag.arb().overlaps(due.imag)
    finally:
        flint.ctx.prec = old


def test_the_context_of_the_thread_has_no_part():
    """Digits, range, traps and capitals of the thread's decimals change nothing."""
    import decimal

    # From numbers as they are to some far beyond the default range of a Decimal.
    arguments = (0.1, 40, 1e-5j, 2000, "2000", 3000 - 1j, "1e-99999")
    functions = (certified.erf, certified.erfc, certified.erfi, certified.dawsn, certified.wofz)

    def texts():
        found = []
        for f in functions:
            for z in arguments:
                try:
                    found.append(str(f(z, digits=25)))
                except mechaudit.DomainError as e:
                    found.append(str(e))
        return found

    due = texts()
    assert any("E+1737" in text for text in due) and any("E-1737" in text for text in due)
    everything = list(decimal.Context().flags)
    for hostile in (
        decimal.Context(prec=1, Emin=-1, Emax=1, capitals=0, traps=everything),
        decimal.Context(prec=2, Emin=-9, Emax=9, rounding=decimal.ROUND_UP, traps=[]),
    ):
        with decimal.localcontext(hostile):
            assert texts() == due


def test_values_beyond_the_default_range_are_rounded_correctly():
    """Below 1e-1000026 as well the rounding is that of a longer answer."""
    for f, z in ((certified.erfc, "1600"), (certified.erfi, "2000"), (certified.erfc, "2000")):
        short, long = f(z, digits=12), f(z, digits=40)
        exponent = long.decimal.adjusted()
        assert abs(exponent) > 1_000_026 and short.decimal.adjusted() == exponent
        # As integers, whose arithmetic has no range.
        shift = len(long.decimal.as_tuple().digits) - 12
        digits = int("".join(map(str, long.decimal.as_tuple().digits)))
        due, rest = divmod(digits, 10**shift)
        due += rest > 10**shift // 2
        assert int("".join(map(str, short.decimal.as_tuple().digits))) == due
        with mpmath.workdps(30):
            m = mpmath.erfc(mpmath.mpf(z)) if f is certified.erfc else mpmath.erfi(mpmath.mpf(z))
            assert abs(mpmath.mpf(str(long)) / m - 1) < mpmath.mpf(10) ** -25


def test_an_interval_is_no_longer_than_it_has_to_be():
    """A radius of e**-1600000000 would take half a gigabit to write out."""
    low, high = certified.erfc("-40000").interval
    assert low <= 2 <= high and 0 <= high - low < Fraction(1, 2**60_000)
    assert float(certified.erfc("2000")) == 0.0 and float(certified.wofz("1e4").real) == 0.0
    with pytest.raises(OverflowError, match="exponent of 5770"):
        float(certified.erfi("2000"))


def test_exponents_that_fill_the_memory_are_refused():
    for bad in ("1e9999999999999999999999", "1e99999999999999999999/3", "-1E+99999999999999999999999"):
        with pytest.raises(ValueError, match="z:"):
            certified.erf(bad)


def test_without_mpmath(monkeypatch):
    monkeypatch.setattr(certified, "_mpmath", lambda: None)
    x = certified.erf("0.1", digits=20)
    assert x.value == x.decimal and x.radius == Decimal("5e-21")
    low, high = x.interval
    assert low <= high and abs(Fraction(x.value) - low) <= Fraction(x.radius)
    z = certified.wofz(1j, digits=20)
    assert z.value == (z.real.decimal, Decimal(0)) and z.radius[1] == 0


def test_answers_are_pickled_and_compared():
    z = certified.wofz(1 + 1j)
    assert pickle.loads(pickle.dumps(z)) == z and hash(z) == hash(certified.wofz(1 + 1j))
    assert z != certified.wofz(2) and z.real != 1 and "0.3047" in repr(z)
    assert str(certified.wofz(1 - 1j)).count("j") == 1
