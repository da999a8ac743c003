"""The audit of a callable: what passes, what is found, what can be reproduced."""

import math
import pickle
import threading

import mechaudit
import numpy as np
import pytest
import scipy.special
from mechaudit import special

pytestmark = [
    pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references"),
    # Planted faults compute what they like.
    pytest.mark.filterwarnings("ignore::RuntimeWarning"),
]


def audit(f, **options):
    return mechaudit.audit("faddeeva", f, **{"cases": 10, "progress": False, **options})


def test_ours_pass_vectorised_and_scalar():
    both = [audit(special.wofz), audit(lambda z: complex(special.wofz(complex(z)))), audit("ours")]
    assert [r.mode for r in both] == ["vectorised", "scalar", "in Rust"]
    for report in both:
        assert report.passed and report.cases == report.passed_cases > 300
        assert report.assert_within_budget() is report and not report.findings
        assert report.facts["outputs"] == both[0].facts["outputs"]


def test_planted_faults_are_found():
    """Each of these is one way of being wrong; none may pass."""
    w = special.wofz

    def where(z, wrong, value):
        out = w(z)
        out[wrong] = value(z[wrong], out[wrong])
        return out

    faults = {
        "last digits": lambda z: w(z) * (1 + 4e-15),
        "one region": lambda z: where(z, abs(z.imag) < 1e-3, lambda z, w: w.real * (1 + 1e-13) + 1j * w.imag),
        "conjugate": lambda z: np.conj(w(z)),
        "NaN": lambda z: where(z, abs(z) > 1e5, lambda z, w: np.nan * w),
        "zero": lambda z: np.zeros_like(z),
        "sign of zero": lambda z: w(z) + 0.0,
        "infinity": lambda z: where(z, np.isinf(w(z).real), lambda z, w: -w),
        "single": lambda z: w(z.astype(np.complex64)),
        "scipy": scipy.special.wofz,
    }
    for name, f in faults.items():
        report = audit(f)
        assert not report.passed, name
        assert report.passed_cases < report.cases, name
        with pytest.raises(AssertionError, match="mechaudit.case"):
            report.assert_within_budget()


def test_every_method_passes_through_python():
    for method in mechaudit.methods():
        if method["name"] == "run-up":
            continue  # Seconds for a case.
        report = mechaudit.audit(method["name"], "ours", cases=2, progress=False)
        assert report.passed, report


def test_other_shapes_of_callables():
    assert mechaudit.audit("voigt", special.voigt_profile, cases=10).passed
    assert mechaudit.audit("voigt", lambda *a: float(special.voigt_profile(*a)), cases=5).passed
    from mechaudit import solve_cyclic, solve_tridiagonal

    for name, solve in (("tridiagonal", solve_tridiagonal), ("cyclic-tridiagonal", solve_cyclic)):
        report = mechaudit.audit(name, lambda *a, solve=solve: solve(*a).x, cases=5)
        assert report.passed and report.mode == "scalar", report

    def spline(x, y, q0, q1):
        s = mechaudit.CubicSpline(x, y)
        if not x[0] <= min(q0, q1) <= max(q0, q1) <= x[-1]:
            raise ValueError("outside of the knots")
        row = lambda p, q: [s(p), s(p, 1), s(p, 2), s(p, 3), s.integrate(p, q)]  # noqa: E731
        return [row(q0, q1), row(q1, q0)]

    report = mechaudit.audit("cubic-spline-not-a-knot", spline, cases=20)
    assert report.mode == "scalar" and report.passed, report


def test_exceptions_shapes_and_types_are_findings():
    def kinds(f, **options):
        report = audit(f, **options)
        assert not report.passed
        for finding in report.findings:
            assert isinstance(eval(finding.reproducer), mechaudit.Case)
        return {f.kind for f in report.findings}

    def fails(z):
        raise RuntimeError("not today")

    assert kinds(fails) == {"RuntimeError"}
    assert "TypeError" in kinds(lambda z: "text")
    assert "TypeError" in kinds(lambda z: None)
    assert kinds(lambda z: special.wofz(z).astype(np.complex64)) == {"complex64"}
    assert "NaN" in kinds(lambda z: special.wofz(z) * np.nan)
    assert kinds(lambda z: special.wofz(z)[:-1], vectorised=True) == {"ValueError"}

    def some(z):
        if np.any(abs(z) > 100):
            raise OverflowError("too far")
        return special.wofz(z)

    report = audit(some)
    found = {f.kind: f for f in report.findings}
    assert set(found) == {"OverflowError"} and found["OverflowError"].count > 10
    assert report.passed_cases > 100

    def overwrites(z):
        w = special.wofz(z)
        z[:] = 0
        return w

    assert [f.kind for f in audit(overwrites).findings] == ["overwritten"]


def test_worst_cases_can_be_called_again():
    report = audit(scipy.special.wofz, cases=30)
    worst = report.worst(10)
    assert len({c["region"] for c in worst}) == 10
    excess = [c["share"] for c in worst]
    assert excess == sorted(excess, reverse=True)
    for found in worst:
        case = eval(found["reproducer"])
        assert list(case.input) == found["input"]
        again = case.judge(scipy.special.wofz)
        assert not again.passed and again.worst(1)[0]["got"] == pytest.approx(found["got"], nan_ok=True)
        assert case.judge(special.wofz).passed


def test_regions_boxes_outputs_and_budgets():
    assert {r["region"] for r in audit(special.wofz, regions=["mid", "lower"]).rows()} == {"mid", "lower"}
    report = audit(special.wofz, box={"Re z": (0, 8), "Im z": (1e-9, 1, "log")}, cases=50)
    assert report.cases == 50 and report.passed
    for case in report.worst(10):
        assert 0 <= case["input"][0] < 8 and 1e-9 <= case["input"][1] < 1
    assert {r["output"] for r in audit(special.wofz, outputs="Re W").rows()} == {"Re W"}
    rough = audit(lambda z: special.wofz(z) * (1 + 1e-10), regions="mid", ulps=1e7)
    assert rough.passed and "10000000 ulp" in str(rough)
    assert not audit(special.wofz, regions="mid", cases=100, ulps=0.3).passed
    assert audit(special.wofz, seed=1).facts != audit(special.wofz, seed=2).facts


def test_boxes_neighbourhoods_and_their_cases():
    def scipys(**where):
        report = audit(scipy.special.wofz, ulps=1e-3, cases=20, **where)
        assert not report.passed
        for found in report.worst(3):
            case = eval(found["reproducer"])
            assert list(case.input) == found["input"] and not case.judge(lambda z: 0 * z).passed
        return report

    report = scipys(box={"Im z": (1e-9, 1, "+-log")}, regions=["mid", "far"])
    assert {r["region"] for r in report.rows()} == {"mid", "far"}
    assert all("--region mid --region far" in c["place"] for c in report.worst(3))
    fixed = scipys(box="Re z=6, Im z=log 1e-9..1e-3")
    assert all(c["input"][0] == 6 for c in fixed.worst(10))
    for near in (6 + 1e-8j, (6, 1e-8), "6,1e-8", "hard/1"):
        report = scipys(near=near, radius=1e-3)
        assert {r["region"] for r in report.rows()} == {"near"}
    ordinary = audit(special.wofz, ordinary=True)
    assert 0 < ordinary.cases < audit(special.wofz).cases


def test_budgets_of_ones_own():
    rough = lambda z: special.wofz(z) * (1 + 1e-10)  # noqa: E731
    options = {"regions": "mid", "cases": 50}
    assert audit(rough, relative=1.1e-10, **options).passed
    assert not audit(rough, relative=0.9e-10, **options).passed
    assert audit(rough, absolute=1e-9, **options).passed
    assert audit(rough, relative=1e-11, absolute=1e-9, **options).passed
    assert audit(rough, normwise=1.1e-10, **options).passed
    report = audit(rough, normwise=0.9e-10, **options)
    assert not report.passed and "9e-11 of the norm" in str(report)


def test_single_precision():
    def single(z):
        assert z.dtype == np.complex64
        return special.wofz(z)

    report = audit(single, single=True, regions="mid", cases=50)
    assert report.passed and not report.findings
    assert all(np.float32(x) == x for c in report.worst(10) for x in c["input"])
    coarse = audit(lambda z: special.wofz(z) * np.float32(1 + 1e-5), single=True, regions="mid")
    assert not coarse.passed
    case = eval(coarse.worst(1)[0]["reproducer"])
    assert "--single" in case.place and list(case.input) == coarse.worst(1)[0]["input"]
    assert case.judge(single).passed
    scalar = audit(lambda z: special.wofz(z), single=True, regions="mid", vectorised=False)
    assert scalar.passed and not scalar.findings


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"method": "fadeeva"}, "faddeeva"),
        ({"regions": "nowhere"}, "nowhere"),
        ({"outputs": "Abs W"}, "Abs W"),
        ({"cases": 0}, "cases"),
        ({"seed": -1}, "seed"),
        ({"box": {"x": (0, 1)}}, "Re z"),
        ({"box": {"Re z": (1, 0)}}, "lower end comes first"),
        ({"box": {"Re z": (-1, 1, "log")}}, "one sign"),
        ({"box": {"Re z": (0, 1, 2)}}, "two numbers"),
        ({"box": {"Re z": (0, "one")}}, "two numbers"),
        ({"box": "Re z=0..1", "near": "one", "radius": 0.1}, "exclude"),
        ({"near": "one"}, "need each other"),
        ({"near": "nowhere", "radius": 0.1}, "nowhere"),
        ({"near": 1j, "radius": 2.0}, "radius"),
        ({"ulps": 0}, "positive"),
        ({"ulps": math.inf}, "positive"),
        ({"ulps": 1, "relative": 1}, "exclude"),
        ({"relative": -1e-10}, "positive"),
    ],
)
def test_bad_arguments_name_themselves(options, word):
    with pytest.raises(ValueError, match=word):
        mechaudit.audit(**{"method": "faddeeva", "f": special.wofz, **options})


NO_CALLABLES = (None, "", "our", "scipy.special.wofz", 1, [special.wofz], {"f": special.wofz}, special)


@pytest.mark.parametrize("bad", NO_CALLABLES, ids=repr)
def test_what_is_not_callable_is_refused_wherever_a_callable_is_due(bad):
    """An import that failed must not turn a test green."""
    case = mechaudit.case("faddeeva", "--at 1,1")
    calls = [
        lambda: mechaudit.audit("faddeeva", bad),
        lambda: mechaudit.audit("faddeeva", f=bad, cases=5),
        lambda: case.judge(bad),
        lambda: mechaudit.compare("faddeeva", {"mine": bad}),
        lambda: mechaudit.compare("faddeeva", {"good": special.wofz, "mine": bad}),
    ]
    if not isinstance(bad, dict):
        calls.append(lambda: mechaudit.compare("faddeeva", bad))
    for call in calls:
        with pytest.raises(TypeError, match="callable"):
            call()
    with pytest.raises(TypeError):
        mechaudit.audit("faddeeva")
    with pytest.raises(TypeError, match="name"):
        mechaudit.compare("faddeeva", {1: special.wofz})


FOUR_BAR = """
type = "four-bar"
[geometry]
crank = "2 cm"
coupler = "7 cm"
rocker = "9 cm"
frame = "6 cm"
"""


def takers_of_whole_numbers():
    """Every argument that counts, numbers or seeds something: its name, a call with it, a value beyond it."""
    linkage = mechaudit.Linkage.from_toml(FOUR_BAR)
    spline = mechaudit.CubicSpline([0, 1, 2, 4], [0, 1, 8, 64], certified=True)
    case = mechaudit.case("faddeeva", "--at 1,1")
    certified = mechaudit.certified
    wofz = special.wofz
    return [
        ("cases", lambda n: mechaudit.audit("faddeeva", wofz, cases=n), 10**12),
        ("cases", lambda n: mechaudit.compare("faddeeva", {"w": wofz}, cases=n), 10**12),
        ("seed", lambda n: mechaudit.audit("faddeeva", wofz, seed=n, cases=1), 2**64),
        ("seed", lambda n: mechaudit.points("faddeeva", 1, seed=n), 2**64),
        ("seed", lambda n: mechaudit.vectors("faddeeva", 1, seed=n), 2**64),
        ("n", lambda n: mechaudit.points("faddeeva", n), 10**12),
        ("n", lambda n: mechaudit.vectors("faddeeva", n), 10**12),
        ("digits", lambda n: mechaudit.vectors("faddeeva", 1, n), 10**6),
        ("digits", lambda n: certified.erf(1, digits=n), 10**6),
        ("digits", lambda n: certified.voigt_profile(1, 1, 1, digits=n), 10**6),
        ("digits", lambda n: certified.zeros(1, digits=n), 10**6),
        ("count", lambda n: certified.zeros(n), 10**12),
        ("first", lambda n: certified.zeros(1, first=n), 10**12),
        ("digits", lambda n: case.due(n), 10**6),
        ("digits", lambda n: linkage.certified(10, digits=n), 10**6),
        ("branch", lambda n: linkage.certified(10, branch=n), 2**40),
        ("branch", lambda n: linkage.sweep([0, 1], branch=n), 2**40),
        ("branch", lambda n: linkage.svg(n), 2**40),
        ("nu", lambda n: spline(0.5, n), 10**12),
        ("nu", lambda n: spline.certified("1/2", n), 10**12),
        ("axis", lambda n: mechaudit.CubicSpline([0, 1, 2], [0, 1, 2], n), 10**12),
        ("harmonics", lambda n: mechaudit.Cam("x\n", harmonics=n), 10**12),
    ]


@pytest.mark.parametrize("k", range(22))
def test_what_counts_is_a_whole_number_within_limits(k):
    takers = takers_of_whole_numbers()
    assert len(takers) == 22
    name, call, beyond = takers[k]
    for bad in ("x", "1", 1.5, 2.0, True, [1], 1j, math.nan):
        with pytest.raises(TypeError, match=f"{name} must be an integer, got"):
            call(bad)
    for bad in (beyond, -beyond):
        with pytest.raises(ValueError, match=f"{name} must be between -?[0-9]+ and [0-9]+, got {bad}"):
            call(bad)


def test_names_and_numbers_are_checked():
    for options, error, word in (
        ({"regions": 1}, TypeError, "regions"),
        ({"regions": [1]}, TypeError, "regions"),
        ({"regions": []}, ValueError, "regions"),
        ({"outputs": []}, ValueError, "outputs"),
        ({"outputs": [None]}, TypeError, "outputs"),
        ({"box": {"Re z": None}}, TypeError, "box: Re z"),
        ({"near": [None, 1], "radius": 0.1}, TypeError, "near"),
        ({"near": 1j, "radius": "x"}, TypeError, "radius"),
        ({"ulps": "x"}, TypeError, "ulps"),
        ({"relative": [1]}, TypeError, "relative"),
    ):
        with pytest.raises(error, match=word):
            mechaudit.audit("faddeeva", special.wofz, **options)
    linkage = mechaudit.Linkage.from_toml(FOUR_BAR)
    with pytest.raises(TypeError, match="phi"):
        linkage.modes("x")
    with pytest.raises(TypeError, match="tolerance"):
        linkage.run_up(tolerance="x")
    for points in (None, "x", 1.0):
        with pytest.raises(TypeError, match="points"):
            mechaudit.judge("faddeeva", points, [1.0])
    with pytest.raises(TypeError, match="description"):
        mechaudit.Linkage.from_toml(None)


def test_what_cannot_end_is_refused_after_a_moment():
    """A slow callable at many cases: by what the first ones took."""
    import time

    def slow(z):
        time.sleep(0.02)
        return complex(special.wofz(complex(z)))

    begin = time.monotonic()
    with pytest.raises(ValueError, match="more than 30 days are refused"):
        mechaudit.audit("faddeeva", slow, cases=10**9, vectorised=False, progress=False)
    assert time.monotonic() - begin < 60


def test_interrupt_gives_what_was_found():
    calls = 0

    def f(z):
        nonlocal calls
        calls += 1
        if calls > 100:
            raise KeyboardInterrupt
        return complex(special.wofz(complex(z)))

    report = audit(f, vectorised=False)
    assert report.interrupted and not report.passed
    assert 0 < report.cases <= 100 == report.passed_cases or report.passed_cases == report.cases
    assert "interrupted" in str(report)


def test_progress(capfd):
    pytest.importorskip("tqdm")
    assert audit(special.wofz, progress=True).passed
    shown = capfd.readouterr().err
    assert "100%" in shown and "cases" in shown
    assert audit(special.wofz, progress=False).passed and not capfd.readouterr().err


def test_reports_are_shown(tmp_path):
    report = audit(scipy.special.wofz)
    text, page = str(report), report._repr_html_()
    assert "FAIL" in text and "mechaudit points faddeeva" in text and "ulps" in text
    assert page.startswith("<p>") and "<table>" in page
    hostile = audit(special.wofz, name="<script>")
    assert "<script>" not in hostile._repr_html_()
    hostile.html(tmp_path / "report.html")
    written = (tmp_path / "report.html").read_text()
    assert written.startswith("<!doctype html>") and "&lt;script&gt;" in written
    assert "http:" not in written.split("</style>")[1].split("<script>")[0]
    (tmp_path / "page.html").write_text("before")
    report.html(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert "NOT as expected" in page and 'mechaudit.case(\\"faddeeva\\"' in page
    frame = pytest.importorskip("pandas") and report.to_frame()
    assert {"region", "output", "worst_ulps", "passed"} <= set(frame.columns) and len(frame) > 30


def test_judge():
    z = np.array([0j, 1 + 1j, 3 - 2j, 1e300])
    assert mechaudit.judge("faddeeva", z, special.wofz(z)).passed
    report = mechaudit.judge("faddeeva", z, special.wofz(z) * (1 + 1e-12))
    assert not report.passed and report.passed_cases == 0
    assert mechaudit.judge("faddeeva", z, special.wofz(z).real[:, None], outputs="Re W").passed
    p = mechaudit.points("voigt", 5)
    values = special.voigt_profile(p["x"], p["sigma"], p["gamma"])
    assert mechaudit.judge("voigt", p, values[:, None]).passed
    with pytest.raises(ValueError):
        mechaudit.judge("faddeeva", z, [1, 2])
    with pytest.raises(TypeError):
        mechaudit.judge("faddeeva", z, z, wrong=1)


def test_points_are_those_of_the_audit():
    p = mechaudit.points("faddeeva", 3, seed=9)
    q = mechaudit.points("faddeeva", 3, seed=9)
    assert np.array_equal(p, q) and p.dtype.names == ("Re z", "Im z", "region")
    one = mechaudit.points("tridiagonal", 2)
    assert all(len(a) == 4 for _, a in one)
    first = mechaudit.case("faddeeva", f"--region {p['region'][0]} --seed 9 --case 0")
    assert first.input == (p["Re z"][0], p["Im z"][0])


def test_cases():
    case = mechaudit.case("faddeeva", "--at 0x1p+0,1")
    assert case.arguments == (1 + 1j,) and case.region == "given"
    assert str(case.due(20)[0]) == "0.30474420525691259246" and "remainder" in case.proof
    assert pickle.loads(pickle.dumps(case)).input == case.input
    assert mechaudit.case("faddeeva", "--hard-case 1").region == "hard"
    for bad in ("--near one", "--near one --radius 9 --case 1", "--box Re=1 --case 0", "", "--at", "--at x", "--region mid", "--check-point no", "--hard-case 999", "--other 1"):
        with pytest.raises(ValueError):
            mechaudit.case("faddeeva", bad)
    with pytest.raises(ValueError):
        mechaudit.case("faddeeva", "--at 1")


def test_compare():
    found = mechaudit.compare(
        "faddeeva", {"scipy": scipy.special.wofz, "ours": special.wofz}, cases=10, progress=False
    )
    assert not found.passed and found.reports["ours"].passed
    rows = found.rows()
    assert {r["best"] for r in rows} <= {"scipy", "ours"} and rows[0].keys() >= {"scipy", "ours"}
    assert "ns a case" in str(found) and found.seconds_per_case["ours"] > 0
    with pytest.raises(ValueError):
        mechaudit.compare("faddeeva", {})


def test_vectors(tmp_path):
    pytest.importorskip("pandas")
    found = mechaudit.vectors("faddeeva", 2, 30, regions=["mid", "near-zeros"])
    assert len(found) == 4 and found.proofs[0] and len(found.to_frame()) == 4
    # The floats nearest to the certified values pass any budget above half a unit.
    z = found.inputs[:, 0] + 1j * found.inputs[:, 1]
    assert mechaudit.judge("faddeeva", z, found.values, ulps=0.5001).passed
    found.to_csv(tmp_path / "v.csv")
    lines = (tmp_path / "v.csv").read_text().splitlines()
    assert lines[0].startswith("region,in0_real,in0_imag,out0_real,out0_real_radius") and len(lines) == 5
    assert float.fromhex(lines[1].split(",")[1]) == found.inputs[0, 0]
    found.to_npz(tmp_path / "v.npz")
    with np.load(tmp_path / "v.npz") as arrays:
        np.testing.assert_array_equal(arrays["out0_real"], found.values[:, 0])


FIXED = [m["name"] for m in mechaudit.methods() if m["fixed"]] if mechaudit.HAS_ORACLE else []


@pytest.mark.parametrize("method", FIXED)
def test_vectors_of_every_method(method):
    """Forty in each region: values of any size, and a thread whose decimals have three digits and trap everything."""
    import decimal

    hostile = decimal.Context(prec=3, Emin=-9, Emax=9, capitals=0, traps=list(decimal.Context().flags))
    with decimal.localcontext(hostile):
        found = mechaudit.vectors(method, 40, 20)
    assert len(found) > 0
    assert len({len(found), len(found.inputs), len(found.values), len(found.decimals), len(found.proofs)}) == 1
    for row, values, radii in zip(found.decimals, found.values, found.radii):
        for text, value, radius in zip(row, values, radii):
            # The decimal and the float stand for the same value.
            assert "e" not in text and "e" not in radius
            near = decimal.Decimal(text)
            unit = decimal.Decimal((0, (1,), near.adjusted() - 19)) if near else 0
            assert 0 <= decimal.Decimal(radius) <= unit
            if abs(near.adjusted()) < 290:
                assert float(text) == pytest.approx(value, rel=1e-15)


def test_vectors_in_the_layout_of_xsref(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    for method, stem, metadata in (
        ("faddeeva", "cd-cd", {b"in": b"D", b"out": b"D", b"function": b"wofz"}),
        ("voigt", "d_d_d-d", {b"in": b"ddd", b"out": b"d", b"function": b"voigt_profile"}),
    ):
        found = mechaudit.vectors(method, 1, 25)
        first, second = found.to_parquet(tmp_path / method)
        assert (first.name, second.name) == (f"In_{stem}.parquet", f"Out_{stem}.parquet")
        inputs, outputs = parquet.read_table(first), parquet.read_table(second)
        known = inputs.schema.metadata
        assert {k: known[k] for k in metadata} == metadata
        assert outputs.num_rows == inputs.num_rows == len(found)
        assert not any(outputs["fallback"].to_pylist()) and all(outputs["proof"].to_pylist())
        assert b"input_checksum" in outputs.schema.metadata
    with pytest.raises(ValueError, match="layout"):
        mechaudit.vectors("four-bar", 1, 20).to_parquet(tmp_path)
    with pytest.raises(ValueError, match="fixed"):
        mechaudit.vectors("tridiagonal", 1)


def test_threads():
    """Audits side by side find what one alone finds."""
    alone = audit(special.wofz).facts
    found = [None] * 4

    def work(k):
        found[k] = audit(special.wofz).facts

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(str(f) == str(alone) for f in found)
