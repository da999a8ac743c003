"""Linkages, run-ups and cams of the repository's examples."""

import json
import pickle
from pathlib import Path

import mechaudit
import numpy as np
import pytest

pytestmark = pytest.mark.skipif(not mechaudit.HAS_ORACLE, reason="needs descriptions of machines")
if mechaudit.HAS_ORACLE:
    from mechaudit import Cam, Linkage

EXAMPLES = Path(__file__).parents[2] / "examples"
FOUR_BAR = {
    "type": "four-bar",
    "geometry": {"crank": "2 cm", "coupler": "7 cm", "rocker": "9 cm", "frame": "6 cm"},
}


@pytest.mark.parametrize("name", ["sand-screen.toml", "four-bar.toml", "slider-crank.toml"])
def test_rows_and_certified_digits_agree(name):
    linkage = Linkage.from_toml(EXAMPLES / name)
    rows = linkage.sweep(np.arange(0.0, 361.0, 30.0))
    assert rows.dtype.names[:2] == ("phi1_deg", "branch") and len(rows) == 13
    for k in (0, 3, 7):
        if np.isnan(rows[rows.dtype.names[2]][k]):
            continue
        digits = linkage.certified(str(30 * k), 20)
        for column, text in digits.items():
            assert text is not None
            value = float(text)
            off = abs(value - rows[column][k])
            if column.endswith("_deg"):
                off = abs((off + 180) % 360 - 180)
            assert off <= 1e-9 * max(1, abs(value)), (column, text, rows[column][k])


def test_modes():
    linkage = Linkage.from_toml(EXAMPLES / "sand-screen.toml")
    modes = linkage.modes(14.426)
    assert 2 <= len(modes) <= 6 and list(modes["branch"]) == list(range(len(modes)))
    assert linkage.name and linkage.type == "class-iii"


def test_dictionaries_and_json():
    linkage = Linkage.from_dict(FOUR_BAR)
    again = Linkage.from_toml(json.dumps(FOUR_BAR, indent=1))
    angles = np.linspace(0, 360, 13)
    for a, b in zip(linkage.sweep(angles, 1).tolist(), again.sweep(angles, 1).tolist()):
        np.testing.assert_array_equal(a, b)
    same = Linkage.from_toml(EXAMPLES / "sand-screen.json").sweep([10.0])
    assert same["phi2_deg"][0] == Linkage.from_toml(EXAMPLES / "sand-screen.toml").sweep([10.0])["phi2_deg"][0]


def test_where_the_crank_does_not_reach():
    rocker = Linkage.from_dict(
        {**FOUR_BAR, "geometry": {"crank": "9 cm", "coupler": "4 cm", "rocker": "3 cm", "frame": "4 cm"}}
    )
    rows = rocker.sweep([0.0, 180.0])
    assert np.isnan(rows["phi2_deg"][1])
    with pytest.raises(mechaudit.DomainError, match="180"):
        rocker.certified(180)


def test_run_up():
    rows = Linkage.from_toml(EXAMPLES / "four-bar-run-up.toml").run_up()
    assert rows["t_s"][0] == 0 and rows["omega_rad_per_s"][-1] > 0 and rows.outcome
    scale = np.abs(rows["kinetic_energy_J"]).max()
    assert np.abs(rows["energy_balance_J"]).max() < 1e-5 * scale
    with pytest.raises(ValueError, match="motor"):
        Linkage.from_dict(FOUR_BAR).run_up()


def test_cam():
    cam = Cam(EXAMPLES / "chirp-run-up.toml", harmonics=50)
    rows = cam.response([0.0, 0.5, 1.0])
    assert rows.dtype.names[0] == "t_s" and np.isfinite(rows["shaft_deg"]).all() and cam.harmonics == 50
    again = pickle.loads(pickle.dumps(cam))
    assert again.response([0.5]).tolist() == cam.response([0.5]).tolist()
    with pytest.raises(ValueError):
        Cam(EXAMPLES / "chirp-run-up.toml", harmonics=0)
    with pytest.raises(ValueError):
        Cam("[oscillator]\nfrequency = 3\n")


def test_refusals_name_value_rule_and_line():
    text = (EXAMPLES / "four-bar.toml").read_text()
    with pytest.raises(ValueError, match=r"kg"):
        Linkage.from_toml(text.replace("cm", "kg"))
    with pytest.raises(ValueError, match="line"):
        Linkage.from_toml("type = 'four-bar'\n[geometry]\ncrank = 3\n")
    with pytest.raises(FileNotFoundError):
        Linkage.from_toml("no-such-file.toml")
    linkage = Linkage.from_dict(FOUR_BAR)
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match="phi"):
            linkage.sweep([bad])
    with pytest.raises(ValueError, match="branch"):
        linkage.sweep([0.0], 2)
    with pytest.raises(ValueError, match="dimension"):
        linkage.sweep([[0.0]])


def test_pandas_plot_and_drawing(monkeypatch):
    linkage = Linkage.from_toml(EXAMPLES / "sand-screen.toml")
    rows = linkage.sweep(np.arange(0.0, 30.0, 5.0))
    frame = pytest.importorskip("pandas") and rows.to_pandas()
    assert list(frame.columns) == list(rows.dtype.names)
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = rows.plot("phi2_deg")
    assert axes.get_xlabel() == "phi1_deg" and axes.get_ylabel() == "phi2_deg"
    rows.plot(["phi2_deg", "phi3_deg"], ax=axes)
    with pytest.raises(ValueError, match="phi9"):
        rows.plot("phi9_deg")
    svg = linkage._repr_html_()
    assert "<svg" in svg and svg == linkage.svg()
    import xml.etree.ElementTree as xml

    xml.fromstring(svg)
    assert "four-bar" in Linkage.from_dict(FOUR_BAR)._repr_html_()


def test_pickle():
    linkage = Linkage.from_dict(FOUR_BAR)
    again = pickle.loads(pickle.dumps(linkage))
    assert again.sweep([10.0]).tolist() == linkage.sweep([10.0]).tolist()
    rows = linkage.sweep([10.0])
    assert pickle.loads(pickle.dumps(rows)).tolist() == rows.tolist()


def test_mechanisms_of_bodies_and_joints():
    linkage = mechaudit.Linkage.from_toml(EXAMPLES / "watt-1.toml")
    assert linkage.type == "planar"
    modes = linkage.modes(70)
    assert len(modes) >= 2 and list(modes["branch"]) == list(range(len(modes)))
    rows = linkage.sweep(np.arange(0, 360, 5), branch=0)
    assert rows.dtype.names[:2] == ("phi_deg", "branch") and len(rows) == 72
    for given, phi, branch in [
        ("watt-1.toml", 70, 0),
        ("jansen-leg.toml", 30, None),
        ("cylinder-boom.toml", "0.95", None),
    ]:
        linkage = mechaudit.Linkage.from_toml(EXAMPLES / given)
        floats = linkage.sweep([float(phi)], branch=branch)
        digits = linkage.certified(phi, 25, branch)
        for column, text in digits.items():
            if column in floats.dtype.names:
                assert float(text) == pytest.approx(floats[column][0], abs=1e-9), (given, column)
    with pytest.raises(mechaudit.DomainError, match="no row"):
        mechaudit.Linkage.from_toml(EXAMPLES / "peaucellier-cell.toml").certified(180)
    linkage = mechaudit.Linkage.from_toml(EXAMPLES / "watt-1.toml")
    assert "<svg" in linkage.svg(0) and linkage.svg(0) != linkage.svg(1)
    boom = mechaudit.Linkage.from_toml(EXAMPLES / "cylinder-boom.toml")
    assert "<svg" in boom.svg()
    for name in ("four-bar.toml", "slider-crank.toml"):
        assert "<svg" in mechaudit.Linkage.from_toml(EXAMPLES / name).svg()
    assert boom.sweep([1.0]).dtype.names[0] == "s_m"
    with pytest.raises(ValueError, match="line"):
        mechaudit.Linkage.from_toml('type = "planar"\n[[body]]\nname = "a"\nlenght = "1 m"\n')
