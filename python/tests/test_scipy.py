"""scipy's own tests with our functions in place of its own, from its own package."""

import os
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import pytest

HERE = Path(__file__).parent

#: scipy's tests that call the functions, by name. None is skipped.
SPECIAL = [
    "test_basic.py::TestCephes::test_dawsn",
    "test_basic.py::TestCephes::test_erf",
    "test_basic.py::TestCephes::test_erf_symmetry",
    "test_basic.py::TestCephes::test_erfc",
    "test_basic.py::TestCephes::test_wofz",
    "test_basic.py::TestErf::test_erf",
    "test_basic.py::TestErf::test_erfc_consistent",
    "test_basic.py::TestErf::test_erfcx_consistent",
    "test_basic.py::TestErf::test_erfi_consistent",
    "test_basic.py::TestErf::test_dawsn_consistent",
    "test_basic.py::TestErf::test_erf_nan_inf",
    "test_basic.py::TestErf::test_erfc_nan_inf",
    "test_basic.py::TestErf::test_erfcx_nan_inf",
    "test_basic.py::TestErf::test_erfi_nan_inf",
    "test_basic.py::TestErf::test_dawsn_nan_inf",
    "test_basic.py::TestErf::test_wofz_nan_inf",
    "test_cython_special.py::test_cython_api[dawsn]",
    "test_cython_special.py::test_cython_api[erf]",
    "test_cython_special.py::test_cython_api[erfc]",
    "test_cython_special.py::test_cython_api[erfcx]",
    "test_cython_special.py::test_cython_api[erfi]",
    "test_cython_special.py::test_cython_api[voigt_profile]",
    "test_cython_special.py::test_cython_api[wofz]",
    *(
        f"test_data.py::test_boost[<Data for {function}: {data}_ipp-{data}>]"
        for data in ("erf_data", "erf_large_data", "erf_small_data")
        for function in ("erf", "erf (complex)", "erfc")
    ),
    "test_erfinv.py::TestInverseErrorFunction::test_compliment",
    "test_faddeeva.py::TestVoigtProfile::test_nan",
    "test_faddeeva.py::TestVoigtProfile::test_inf",
    "test_faddeeva.py::TestVoigtProfile::test_against_mathematica",
    "test_faddeeva.py::TestVoigtProfile::test_symmetry",
    "test_faddeeva.py::TestVoigtProfile::test_corner_cases",
    "test_faddeeva.py::TestVoigtProfile::test_continuity",
    "test_mpmath.py::test_erf_complex",
    "test_mpmath.py::TestSystematic::test_erf",
    "test_mpmath.py::TestSystematic::test_erf_complex",
    "test_mpmath.py::TestSystematic::test_erfc",
    "test_mpmath.py::TestSystematic::test_erfc_complex",
    "test_mpmath.py::TestSystematic::test_erfi",
    "test_mpmath.py::TestSystematic::test_erfi_complex",
    *(
        f"{test}[{name}]"
        for test in ("test_nan_inputs.py::test_nan_inputs", "test_ufunc_signatures.py::test_ufunc_signatures")
        for name in ("dawsn", "erf", "erfc", "erfcx", "erfi", "voigt_profile", "wofz")
    ),
]

#: Those that fail because the value differs on purpose; the README's table says why.
ON_PURPOSE = {
    "test_cython_special.py::test_cython_api[voigt_profile]": "negative widths are refused with NaN",
}

SPLINE = ["test_polyint.py::TestCubicSpline", "test_polyint.py::test_shapes", "test_polyint.py::test_deriv_shapes"]
ZERO_SIZE = "test_polyint.py::TestZeroSizeArrays::test_zero_size"


def run(plugin, folder, tests, tmp_path, *more):
    """Outcomes by name; whether every test asked for was run is for the caller to see."""
    report = tmp_path / "report.xml"
    paths = []
    for test in tests:
        file, _, rest = test.partition("::")
        paths.append(f"{folder / file}::{rest}")
    environment = {**os.environ, "PYTHONPATH": str(HERE), "SCIPY_XSLOW": "1"}
    environment.pop("SCIPY_ARRAY_API", None)
    command = [
        sys.executable, "-m", "pytest", "-p", plugin, "-p", "no:cacheprovider", "-q",
        "--disable-warnings", f"--junitxml={report}", f"--rootdir={folder.parent.parent}",
        f"--confcutdir={folder.parent.parent}", "-o", "addopts=", *more, *paths,
    ]  # fmt: skip
    done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True, timeout=600)
    assert report.exists(), done.stdout + done.stderr
    outcomes = {}
    for case in xml.parse(report).iter("testcase"):
        parts = case.get("classname").split(".")
        at = next(i for i, part in enumerate(parts) if part.startswith("test_"))
        name = "::".join([parts[at] + ".py", *parts[at + 1 :], case.get("name")])
        kinds = [child.tag for child in case if child.tag in ("failure", "error", "skipped")]
        outcomes[name] = kinds[0] if kinds else "passed"
    return outcomes, done.stdout


@pytest.mark.slow
def test_special(tmp_path):
    import scipy.special.tests as tests

    outcomes, text = run("scipy_drop_in", Path(tests.__path__[0]), SPECIAL, tmp_path)
    bases = {name.split("[")[0] for name in outcomes}
    missing = [t for t in SPECIAL if t not in outcomes and t not in bases]
    assert not missing, text
    others = {name: what for name, what in outcomes.items() if what != "passed"}
    assert others == dict.fromkeys(ON_PURPOSE, "failure"), text


def test_cubic_spline(tmp_path):
    import scipy.interpolate.tests as tests

    folder = Path(tests.__path__[0])
    outcomes, text = run("scipy_spline_drop_in", folder, SPLINE, tmp_path)
    others = {name: what for name, what in outcomes.items() if what != "passed"}
    assert len(outcomes) >= 11 and not others, text
    outcomes, text = run("scipy_spline_drop_in", folder, [ZERO_SIZE], tmp_path, "-k", "CubicSpline")
    assert outcomes and set(outcomes.values()) == {"passed"}, text
