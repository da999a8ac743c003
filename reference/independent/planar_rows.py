#!/usr/bin/env python3
"""Independent rows of mechanisms with slides, slots, gears, racks and sides, by mpmath alone.

Each mechanism of `examples/` is written down in closed form here, by circles that meet, with the side on which they do;
derivatives are numerical ones of these forms. `epicyclic` and `hung-lever` are described in tests/library/planar_rows.rs.

Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/planar_rows.py            # writes planar_rows.csv beside it
    python3 reference/independent/planar_rows.py --check    # compares instead, exit 1 if it differs

Columns: mechanism, drive (degrees or metres), then name and value of a quantity with its first and second derivative by the
drive (radians or metres), 35 digits; angles are in degrees.
"""
import mpmath as mp

from check import run

mp.mp.dps = 90
DIGITS = 35


def meet(p, r, q, s):
    """The point at r from p and at s from q, left of the way from p to q."""
    way = q - p
    d = abs(way)
    along = (r**2 - s**2 + d**2) / (2 * d)
    return p + way / d * mp.mpc(along, mp.sqrt(r**2 - along**2))


def quick_return(phi):
    """Whitworth's quick return: the slot runs from Q through the crank pin."""
    pin = mp.mpc(0, "0.12") + mp.mpf("0.05") * mp.expj(phi)
    lever = mp.arg(pin)
    b = mp.mpf("0.24") * mp.expj(lever)
    height = mp.mpf("0.26") - b.imag
    c = mp.mpc(b.real - mp.sqrt(mp.mpf("0.08") ** 2 - height**2), "0.26")
    return {"lever_deg": lever, "link_deg": mp.arg(c - b), "s_slot_m": abs(pin), "s_guide_m": c.real,
            "x_A_m": pin.real, "y_B_m": b.imag}


def cylinder_boom(s):
    """The boom's end of the cylinder is left of the way from P to O."""
    arm = mp.mpc("1.2", "-0.1")
    p = mp.mpc("0.4", "-0.6")
    r = meet(mp.mpc(0), abs(arm), p, s)
    boom = mp.arg(r) - mp.arg(arm)
    top = 3 * mp.expj(boom)
    along = mp.arg(r - p)
    return {"boom_deg": boom, "barrel_deg": along, "rod_deg": along, "x_T_m": top.real, "y_R_m": r.imag}


def rack_and_wheel(phi):
    """The rocker's angle lies between 0 and 180 degrees; gears 30 to 20 outside, a rack at 4 cm."""
    a = mp.mpf("0.1") * mp.expj(phi)
    b = meet(a, mp.mpf("0.4"), mp.mpc("0.35"), mp.mpf("0.3"))
    rocker = mp.arg(b - mp.mpf("0.35"))
    wheel = -3 * rocker / 2
    return {"rocker_deg": rocker, "coupler_deg": mp.arg(b - a), "wheel_deg": wheel, "s_guide_m": wheel / 25}


def jansen_leg(phi):
    """Sides and circles as in jansen_leg.py; lengths in metres."""
    cm = lambda text: mp.mpf(text) / 100
    m = cm(15) * mp.expj(phi)
    p = mp.mpc(cm(-38), cm("-7.8"))
    x = meet(p, cm("41.5"), m, cm(50))
    y = meet(p, cm("40.1"), x, cm("55.8"))
    z = meet(m, cm("61.9"), p, cm("39.3"))
    w = meet(z, cm("36.7"), y, cm("39.4"))
    f = meet(z, cm(49), w, cm("65.7"))
    return {"bde_deg": mp.arg(x - p), "f_deg": mp.arg(w - y), "ghi_deg": mp.arg(w - z), "x_F_m": f.real, "y_F_m": f.imag}


def peaucellier(phi):
    """A on the circle about Q; B and C on either side of the way from O to A; D mirrors A in BC."""
    a = mp.mpf("0.04") * (1 + mp.expj(phi))
    b = meet(mp.mpc(0), mp.mpf("0.1"), a, mp.mpf("0.04"))
    c = meet(a, mp.mpf("0.04"), mp.mpc(0), mp.mpf("0.1"))
    d = b + c - a
    return {"OB_deg": mp.arg(b), "BD_deg": mp.arg(d - b), "y_D_m": d.imag}


def epicyclic(phi):
    """A planet on an arm of 7 cm rolls about a fixed wheel, 40 to 30 teeth, 10 degrees ahead; its pin F, 2 cm
    out, moves a block on a line through (1 cm, 2 cm) that climbs 20 degrees, by a link of 11 cm that ends above."""
    planet = phi + mp.mpf(4) / 3 * phi + mp.pi / 18
    pin = mp.mpf("0.07") * mp.expj(phi) + mp.mpf("0.02") * mp.expj(planet)
    line = mp.expj(mp.pi / 9)
    there = (pin - mp.mpc("0.01", "0.02")) / line
    s = there.real + mp.sqrt(mp.mpf("0.11") ** 2 - there.imag**2)
    end = mp.mpc("0.01", "0.02") + s * line
    return {"planet_deg": planet, "link_deg": mp.arg(end - pin), "s_line_m": s, "block_deg": mp.mpf(1), "x_F_m": pin.real}


def hung_lever(phi):
    """A slot from the first to the third corner of a triangle with sides 6, 5, 4, the first on O and the second side's end
    turned clockwise, takes a crank's pin at 1 from (0, 3)."""
    pin = mp.mpc(0, 3) + mp.expj(phi)
    third = mp.mpc(mp.mpf(36 + 16 - 25) / 12, 0)
    third -= mp.mpc(0, mp.sqrt(16 - third.real**2))
    plate = mp.arg(pin) - mp.arg(third)
    corner = 6 * mp.expj(plate)
    return {"plate_deg": plate, "s_slot_m": abs(pin), "x_B_m": corner.real, "y_B_m": corner.imag}


MECHANISMS = [
    ("quick-return", quick_return, [20, 75, 200, 310]),
    ("cylinder-boom", cylinder_boom, ["0.95", "1.2", "1.35"]),
    ("rack-and-wheel", rack_and_wheel, [10, 100, 230, 350]),
    ("jansen-leg", jansen_leg, [15, 130, 260]),
    ("peaucellier-cell", peaucellier, [10, -25, 60]),
    ("epicyclic", epicyclic, [5, 40, 100]),
    ("hung-lever", hung_lever, [15, 160, 300]),
]


def table():
    lines = ["mechanism,drive,quantity,value,first,second"]
    for name, rows, drives in MECHANISMS:
        for drive in drives:
            metres = isinstance(drive, str)
            at = mp.mpf(drive) if metres else mp.pi * drive / 180
            for quantity in rows(at):
                one = lambda x: rows(x)[quantity]
                value = one(at)
                if quantity.endswith("_deg"):
                    value = value * 180 / mp.pi
                    value -= 360 * mp.nint(value / 360)
                values = [value, mp.diff(one, at, 1), mp.diff(one, at, 2)]
                # A value of zero shows the rounding of the forms.
                values = [mp.mpf(0) if abs(v) < mp.mpf(10) ** -30 else v for v in values]
                lines.append(f"{name},{drive},{quantity}," + ",".join(mp.nstr(v, DIGITS) for v in values))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
