"""Studies: problems of the user's own, as formulas and files."""

import math
from fractions import Fraction
from pathlib import Path

import mechaudit
import pytest

pytestmark = pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs references")

STUDIES = Path(__file__).resolve().parents[2] / "examples" / "studies"
ROOTS = """
[inputs]
x = { from = 0, to = 1e300, spacing = "log" }
[outputs]
y = { is = "sqrt(x + 1) - sqrt(x)", budget = "4 ulp", why = "five roundings" }
[solver.naive]
y = "sqrt(x + 1) - sqrt(x)"
[solver.stable]
y = "1/(sqrt(x + 1) + sqrt(x))"
"""


def stable(x):
    return 1 / (math.sqrt(x + 1) + math.sqrt(x))


def test_three_lines_audit_a_formula():
    study = mechaudit.formula("sqrt(x + 1) - sqrt(x)", x=(0, 1e10))
    assert study.audit(stable, cases=10).passed
    bad = study.audit(lambda x: math.sqrt(x + 1) - math.sqrt(x), cases=10)
    assert not bad.passed
    case = eval(bad.worst(1)[0]["reproducer"])
    assert case.judge(stable).passed


@pytest.mark.parametrize("values", [[1, 0.5], ("1", "1/2"), {"e": Fraction(1, 2), "M": 1}])
def test_certified_digits_are_strings(values):
    # mpmath: findroot(lambda E: E - sin(E)/2 - 1, 1.5)
    kepler = mechaudit.Study(STUDIES / "kepler.toml")
    assert (kepler.inputs, kepler.outputs) == (["M", "e"], ["E"])
    assert kepler.eval(values, digits=30) == ["1.49870113351784831405798549726"]


def test_solvers_answer_in_floats():
    x = 2.0**40
    naive, exact = mechaudit.Study(ROOTS), mechaudit.Study(ROOTS, solver="stable")
    assert naive.eval(x) == [math.sqrt(x + 1) - math.sqrt(x)]
    assert exact.eval([x]) == [stable(x)]
    assert not naive.audit(cases=10).passed
    assert exact.audit(cases=10).passed


def test_words_stand_for_values_that_are_no_numbers():
    study = mechaudit.Study(
        "[inputs]\nx = { from = 0, to = 1 }\n[outputs]\nzero = 'sqrt(2)*sqrt(3) - sqrt(6)'\n"
        "none = 'log(x - 1)'\nopen = 'if(x + exp(-40000) == x, 1, 2)'\n"
    )
    assert study.eval(0.5, digits=10) == ["0", "nan", "undecided"]


def test_a_study_is_described():
    facts = mechaudit.Study(ROOTS).describe()
    assert facts["definitions"] == {"y": "sqrt(x + 1) - sqrt(x)"}
    assert facts["solvers"] == ["naive", "stable"]
    assert facts["budgets"] == [("y", "4 ulp", "five roundings")]
    assert any("not independent" in remark for remark in facts["remarks"])


def test_functions_of_methods_take_studies():
    path = str(STUDIES / "cancellation.toml")
    study = mechaudit.Study(path)
    for method in (study, path):
        assert mechaudit.audit(method, stable, cases=5).passed
        assert len(mechaudit.points(method, 3, regions="domain")) == 3
        assert mechaudit.judge(method, [[1e10]], [stable(1e10)]).passed
        assert str(mechaudit.case(method, "--at 10000000000.0").due(20)[0]) == (
            "0.0000049999999998750000000"
        )


def test_a_file_is_read_as_it_is_now(tmp_path):
    path = tmp_path / "study.toml"
    text = "[inputs]\nx = {{}}\n[outputs]\ny = '{}'\n"
    path.write_text(text.format("x + 1"))
    first = mechaudit.Study(path)
    path.write_text(text.format("x + 100"))
    second = mechaudit.Study(path)
    assert (first.eval(1, digits=3), second.eval(1, digits=3)) == (["2.00"], ["101"])
    assert mechaudit.judge(str(path), [[1.0]], [101.0]).passed


def test_a_core_of_a_file():
    study = mechaudit.Study(f"{STUDIES / 'textbook.fpcore'}#versine")
    assert study.eval("0.001", digits=20) == ["0.00000049999995833333472222"]
    assert mechaudit.Study("(FPCore (x) (sqrt x))").eval(2, digits=10) == ["1.414213562"]


@pytest.mark.parametrize(
    ("make", "error", "part"),
    [
        (lambda: mechaudit.Study("missing.toml"), ValueError, "cannot read the file"),
        (lambda: mechaudit.Study(3), TypeError, "path or a text"),
        (lambda: mechaudit.Study(ROOTS, solver="stabel"), ValueError, 'did you mean "stable"'),
        (lambda: mechaudit.Study(ROOTS.replace("sqrt(x)", "sqrt(xx)")), ValueError, "line 5, column"),
        (lambda: mechaudit.formula("sin(y)", x=(0, 1)), ValueError, "the name y is not declared"),
        (lambda: mechaudit.formula("sin(x)", x=(1, 0)), ValueError, "the range of x is empty"),
        (lambda: mechaudit.formula("sin(x)", x=3), ValueError, "a range is a pair"),
        (lambda: mechaudit.formula("sin(x)", x=(0, 1)).eval(1), ValueError, "states no solver"),
        (lambda: mechaudit.Study(ROOTS).eval([1, 2], digits=5), ValueError, "2 numbers for 1 inputs"),
        (lambda: mechaudit.Study(ROOTS).eval({"y": 1}, digits=5), ValueError, "no input 'y'"),
        (lambda: mechaudit.Study(ROOTS).eval({}, digits=5), ValueError, "input x is missing"),
        (lambda: mechaudit.Study(ROOTS).eval(math.nan, digits=5), mechaudit.DomainError, "finite"),
        (lambda: mechaudit.Study(ROOTS).eval(1, digits=0), ValueError, "digits"),
    ],
)
def test_bad_input_is_refused(make, error, part):
    with pytest.raises(error, match=part.replace("(", r"\(")):
        make()
