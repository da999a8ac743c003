#!/usr/bin/env python3
"""Independent values of Jansen's leg at twelve crank angles, by mpmath alone.

Each joint is the meeting point of two circles, on a side that is told: X above the crank pin and P, Z below them, Y left of
the way from P to X, W left of the way from Z to Y, F left of the way from Z to W. Jansen's thirteen numbers are those of his
site (strandbeest.com, "Explains").

Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/jansen_leg.py            # writes jansen_leg.csv beside it
    python3 reference/independent/jansen_leg.py --check    # compares instead, exit 1 if it differs

Columns: crank angle in degrees, then x and y of X, Y, Z, W, F in Jansen's unit; 40 digits.
"""
import mpmath as mp

from check import run

mp.mp.dps = 60
DIGITS = 40

BARS = "a 38 b 41.5 c 39.3 d 40.1 e 55.8 f 39.4 g 36.7 h 65.7 i 49 j 50 k 61.9 l 7.8 m 15".split()
L = {k: mp.mpf(v) for k, v in zip(BARS[::2], BARS[1::2])}


def meet(p, r, q, s):
    """The point at r from p and at s from q, left of the way from p to q."""
    way = q - p
    d = abs(way)
    along = (r**2 - s**2 + d**2) / (2 * d)
    return p + way / d * mp.mpc(along, mp.sqrt(r**2 - along**2))


def leg(degrees):
    m = L["m"] * mp.expj(mp.pi * degrees / 180)
    p = mp.mpc(-L["a"], -L["l"])
    x = meet(p, L["b"], m, L["j"])
    y = meet(p, L["d"], x, L["e"])
    z = meet(m, L["k"], p, L["c"])
    w = meet(z, L["g"], y, L["f"])
    f = meet(z, L["i"], w, L["h"])
    return [x, y, z, w, f]


def table():
    lines = ["deg," + ",".join(f"{c}_{n}" for n in "XYZWF" for c in "xy")]
    for degrees in range(0, 360, 30):
        parts = [part for point in leg(degrees) for part in (point.real, point.imag)]
        lines.append(f"{degrees}," + ",".join(mp.nstr(v, DIGITS) for v in parts))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
