"""Rows of a four-bar and a slider-crank beside the textbook's closed form in vectorised numpy.

``python3 benches/compare_dyads.py`` with the Python package installed: angles, their first and second derivatives at
200 000 crank angles, numpy's time over ours, interleaved in one run. `Linkage.sweep` has the transmission angle and the
determinant as well, and knows where a linkage cannot be joined.
"""

import time

import numpy as np
from mechaudit import Linkage

ANGLES = 200_000
BARS = {"crank": 0.1, "coupler": 0.4, "rocker": 0.3, "frame": 0.35}
SLIDER = {"crank": 0.05, "rod": 0.2, "offset": 0.01}


def linkage(kind, lengths):
    return Linkage.from_dict({"type": kind, "geometry": {name: f"{length} m" for name, length in lengths.items()}})


def four_bar(phi, crank, coupler, rocker, frame):
    """φ2, φ3 by the angle of the diagonal and the law of cosines, rates and accelerations by Cramer's rule."""
    sin, cos = np.sin(phi), np.cos(phi)
    x, y = frame - crank * cos, -crank * sin
    square = x * x + y * y
    length = np.sqrt(square)
    theta = np.arctan2(y, x)
    phi2 = theta + np.arccos((square + coupler**2 - rocker**2) / (2 * coupler * length))
    phi3 = np.arctan2(crank * sin + coupler * np.sin(phi2), crank * cos + coupler * np.cos(phi2) - frame)
    turn = np.sin(phi3 - phi2)
    first2 = crank * np.sin(phi - phi3) / (coupler * turn)
    first3 = crank * np.sin(phi - phi2) / (rocker * turn)
    right2 = crank * np.cos(phi - phi3) + coupler * first2**2 * np.cos(phi2 - phi3) - rocker * first3**2
    right3 = crank * np.cos(phi - phi2) + coupler * first2**2 - rocker * first3**2 * np.cos(phi3 - phi2)
    return phi2, phi3, first2, first3, right2 / (coupler * turn), right3 / (rocker * turn)


def slider_crank(phi, crank, rod, offset):
    sin, cos = np.sin(phi), np.cos(phi)
    height = offset - crank * sin
    tilt = np.arcsin(height / rod)
    reach = rod * np.cos(tilt)
    first = -crank * cos / reach
    second = (crank * sin + height * first**2) / reach
    return (
        crank * cos + reach,
        tilt,
        -crank * sin - height * first,
        first,
        -crank * cos + crank * cos * first - height * second,
        second,
    )


def seconds(function):
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def main():
    phi = np.linspace(0.1, 359.9, ANGLES)
    radians = np.radians(phi)
    print("| | numpy, ns a row | ours, ns a row | ratio |")
    print("|---|---|---|---|")
    for kind, lengths, peer in (("four-bar", BARS, four_bar), ("slider-crank", SLIDER, slider_crank)):
        ours = linkage(kind, lengths)
        rows, due = ours.sweep(phi), peer(radians, **lengths)
        for name, due in zip(rows.dtype.names[2:8], due):
            due = np.degrees(due) if name.endswith("_deg") else due
            np.testing.assert_allclose(np.asarray(rows[name]), due, rtol=1e-9, atol=1e-9)
        pairs = [(seconds(lambda: ours.sweep(phi)), seconds(lambda: peer(radians, **lengths))) for _ in range(31)]
        own, other = np.min(pairs, axis=0) / ANGLES * 1e9
        print(f"| {kind} | {other:.0f} | {own:.0f} | {other / own:.1f} |")


if __name__ == "__main__":
    main()
