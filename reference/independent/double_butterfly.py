#!/usr/bin/env python3
"""Independent assembly modes of the double butterfly of examples/double-butterfly.toml, by mpmath alone.

With the driven link ACD in place let b, x, y be the unit numbers by which BFJ, EFG, DHI are turned from the drawing. The bars
CE, GH, IJ keep their lengths: |C - E|^2, |G - H|^2 and |I - J|^2 are what they were. For a given b, the first is quadratic in x
and the third in y, and the product of the second over the four pairs of roots, cleared of leading coefficients, is a
polynomial in b. Its coefficients are taken from its values at roots of unity by a discrete Fourier transform, its roots by
mpmath's polyroots; those where a leading coefficient vanishes are none of the linkage. A mode is real where b, x and y lie on
the unit circle.

Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/double_butterfly.py            # writes double_butterfly.csv beside it
    python3 reference/independent/double_butterfly.py --check    # compares instead, exit 1 if it differs

Columns: turn of ACD from the drawing in degrees, solutions in complex numbers, mode, turns of CE, EFG, BFJ, DHI, GH, IJ from the
drawing in radians; 40 digits. Modes by ascending turn of BFJ.
"""
import mpmath as mp

from check import run

mp.mp.dps = 120
DIGITS = 40
NODES = 32

POINTS = {
    "A": ("0", "0"), "B": ("6.17", "0"), "C": ("-0.21", "1.94"), "D": ("1.4", "0.48"), "E": ("2.69", "3.37"),
    "F": ("5.84", "3.17"), "G": ("5.37", "1.82"), "H": ("3.63", "1.03"), "I": ("4.67", "-1.09"), "J": ("4.13", "2.05"),
}
P = {name: mp.mpc(*(mp.mpf(v) for v in at)) for name, at in POINTS.items()}


def way(a, b):
    return P[b] - P[a]


def turned(u, u_conjugate, z):
    """A vector and its conjugate, both free of each other where u is no unit number."""
    return u * z, u_conjugate * mp.conj(z)


def add(p, q, sign=1):
    return p[0] + sign * q[0], p[1] + sign * q[1]


def quadratic(fixed, arm, length):
    """|fixed + u arm|^2 = length^2 times u: its coefficients by descending powers of u."""
    middle = fixed[0] * fixed[1] + abs(arm)**2 - length**2
    return fixed[1] * arm, middle, fixed[0] * mp.conj(arm)


def roots(c2, c1, c0):
    s = mp.sqrt(c1**2 - 4 * c2 * c0)
    return [(-c1 + s) / (2 * c2), (-c1 - s) / (2 * c2)]


class Linkage:
    def __init__(self, degrees):
        u = mp.expj(mp.pi * degrees / 180)
        self.c, self.d = ((u * P[n], mp.conj(u * P[n])) for n in "CD")

    def pairs(self, b):
        """Leading coefficients and roots for x and y."""
        base = (P["B"], mp.conj(P["B"]))
        self.f, j = (add(base, turned(b, 1 / b, way("B", n))) for n in "FJ")
        for_x = quadratic(add(self.f, self.c, -1), way("F", "E"), abs(way("C", "E")))
        for_y = quadratic(add(self.d, j, -1), way("D", "I"), abs(way("I", "J")))
        return for_x, for_y

    def gap(self, x, y):
        g = add(self.f, turned(x, 1 / x, way("F", "G")))
        h = add(self.d, turned(y, 1 / y, way("D", "H")))
        z = add(g, h, -1)
        return z[0] * z[1] - abs(way("G", "H"))**2

    def product(self, b):
        for_x, for_y = self.pairs(b)
        out = mp.mpf(1)
        for x in roots(*for_x):
            for y in roots(*for_y):
                out *= self.gap(x, y)
        # Poles of the product: x or y at zero or infinity.
        return out * (for_x[0] * for_x[2] * for_y[0] * for_y[2])**2

    def solutions(self):
        """Every b of the polynomial with its x and y."""
        w = [mp.expjpi(mp.mpf(2 * k) / NODES) for k in range(NODES)]
        values = [self.product(b) for b in w]
        c = {n: mp.fsum(v / b**n for v, b in zip(values, w)) / NODES for n in range(-NODES // 2, NODES // 2)}
        size = max(abs(v) for v in c.values())
        kept = sorted(n for n, v in c.items() if abs(v) > size * mp.mpf(10)**-80)
        assert kept[0] > -NODES // 2 + 1 and kept[-1] < NODES // 2 - 1
        out = []
        for b in mp.polyroots([c[n] for n in range(kept[-1], kept[0] - 1, -1)], maxsteps=500, extraprec=800):
            for_x, for_y = self.pairs(b)
            if min(abs(v) for v in (for_x[0], for_x[2], for_y[0], for_y[2])) < mp.mpf(10)**-20:
                continue
            x, y = min(((x, y) for x in roots(*for_x) for y in roots(*for_y)), key=lambda p: abs(self.gap(*p)))
            assert abs(self.gap(x, y)) < mp.mpf(10)**-60
            out.append((b, x, y))
        return out

    def real(self, b, x, y):
        on = [abs(abs(u) - 1) for u in (b, x, y)]
        assert max(on) < mp.mpf(10)**-60 or max(on) > mp.mpf(10)**-6
        return max(on) < mp.mpf(10)**-60

    def angles(self, b, x, y):
        e, g = (P["B"] + b * way("B", "F") + x * way("F", n) for n in "EG")
        h, i = (self.d[0] + y * way("D", n) for n in "HI")
        j = P["B"] + b * way("B", "J")
        bars = [(e - self.c[0]) / way("C", "E"), x, b, y, (h - g) / way("G", "H"), (j - i) / way("I", "J")]
        return [mp.arg(u) for u in bars]


def table():
    lines = ["deg,solutions,mode," + ",".join(["CE", "EFG", "BFJ", "DHI", "GH", "IJ"])]
    for degrees in (0, 90, 180, 270):
        linkage = Linkage(degrees)
        found = linkage.solutions()
        modes = sorted((linkage.angles(*s) for s in found if linkage.real(*s)), key=lambda a: a[2])
        for mode, angles in enumerate(modes):
            shown = [mp.nstr(mp.chop(v, mp.mpf(10)**-50), DIGITS) for v in angles]
            lines.append(f"{degrees},{len(found)},{mode}," + ",".join(shown))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
