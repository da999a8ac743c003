#!/usr/bin/env python3
"""Independent values of the sand screen's rows, by mpmath alone.

Positions: findroot on the loop equations in the link angles. Derivatives: Taylor coefficients of
the solved angles by repeated implicit differentiation, here simply mpmath's numerical `diff` at
high precision. Reduced quantities from their definitions. Nothing of mechaudit is used.

    python3 reference/independent/class_iii_rows.py            # writes class_iii_rows.csv beside it
    python3 reference/independent/class_iii_rows.py --check    # compares instead, exit 1 if it differs

Columns: row, phi2..phi5 (rad), I_n, dI_n/dphi (kg m^2), M_o, dM_o/dphi (N m); 40 digits.
"""
import mpmath as mp

from check import run

mp.mp.dps = 110
DIGITS = 40

cm = mp.mpf(1) / 100
deg = mp.pi / 180
l1, l2, l3, l4, l5, lb = [mp.mpf(x) * cm for x in ("10", "104", "60", "64", "48.5", "22")]
phi_b = mp.mpf("-39.3") * deg
o3 = mp.mpc(mp.mpf("75") * cm, mp.mpf("93") * cm)
o5 = mp.mpc(mp.mpf("128.5") * cm, mp.mpf("103.5") * cm)
g = mp.mpf("9.81")
# link: (mass, inertia, inertia about the pivot, radius, angle)
bodies = {
    2: (mp.mpf(10), mp.mpf("0.8"), False, 50 * cm, mp.mpf(0)),
    3: (mp.mpf(5), mp.mpf("0.5"), True, 30 * cm, mp.mpf(0)),
    4: (mp.mpf(550), mp.mpf(18), False, 25 * cm, -12 * deg),
    5: (mp.mpf("3.5"), mp.mpf("0.2"), True, 20 * cm, mp.mpf(0)),
}
e = mp.expj


def angles(phi1, start):
    def loops(p2, p3, p4, p5):
        c = o3 + l3 * e(p3)
        one = l1 * e(phi1) + l2 * e(p2) - c - lb * e(p4 + phi_b)
        two = c + l4 * e(p4) - o5 - l5 * e(p5)
        return one.real, one.imag, two.real, two.imag

    return list(mp.findroot(loops, start, tol=mp.mpf(10) ** -200, maxsteps=60))


def centres(phi1, p):
    p2, p3, p4, p5 = p
    a = l1 * e(phi1)
    c = o3 + l3 * e(p3)
    s = {2: (a, p2), 3: (o3, p3), 4: (c, p4), 5: (o5, p5)}
    return {k: o + bodies[k][3] * e(q + bodies[k][4]) for k, (o, q) in s.items()}


def energies(n, at, s, h):
    """I_n and U at the crank angle of number n, from central differences of order 8 with step h at 110 digits."""
    w = {1: mp.mpf(4) / 5, 2: -mp.mpf(1) / 5, 3: mp.mpf(4) / 105, 4: -mp.mpf(1) / 280}
    d = lambda f: sum(w[k] * (f(n + k) - f(n - k)) for k in w) / h
    total = mp.mpf(0)
    for i, link in enumerate((2, 3, 4, 5)):
        m, j, pivot, _, _ = bodies[link]
        omega = d(lambda k: at[k][i])
        v = d(lambda k: s[k][link])
        total += j * omega**2 + (0 if pivot else m * abs(v) ** 2)
    u = g * sum(bodies[link][0] * s[n][link].imag for link in bodies)
    return total, u


def table():
    h = mp.mpf(10) ** -8  # truncation h^8 = 1e-64, rounding 1e-110/1e-8
    w = {1: mp.mpf(4) / 5, 2: -mp.mpf(1) / 5, 3: mp.mpf(4) / 105, 4: -mp.mpf(1) / 280}
    w2 = {0: -mp.mpf(205) / 72, 1: mp.mpf(8) / 5, 2: -mp.mpf(1) / 5, 3: mp.mpf(8) / 315, 4: -mp.mpf(1) / 560}
    start = [x * deg for x in (mp.mpf("14.426"), mp.mpf("-76.174"), mp.mpf("22.558"), mp.mpf("-65.721"))]
    lines = ["row,phi2_rad,phi3_rad,phi4_rad,phi5_rad,I_n_kg_m2,dI_n_kg_m2,M_o_N_m,dM_o_N_m"]
    for row in range(48):
        phi1 = (mp.mpf("14.426") + mp.mpf(15) * row / 2) * deg
        start = angles(phi1, start)
        at = {k: angles(phi1 + k * h, start) if k else start for k in range(-8, 9)}
        s = {k: centres(phi1 + k * h, at[k]) for k in at}
        data = {k: energies(k, at, s, h) for k in range(-4, 5)}
        i_n = data[0][0]
        d_i = sum(w[k] * (data[k][0] - data[-k][0]) for k in w) / h
        moment = -sum(w[k] * (data[k][1] - data[-k][1]) for k in w) / h
        second = sum(w2[k] * ((data[k][1] + data[-k][1]) if k else data[0][1]) for k in w2) / h**2
        values = [*start, i_n, d_i, moment, -second]
        digits = [mp.nstr(v, DIGITS, min_fixed=-5, max_fixed=50) for v in values]
        lines.append(",".join([str(row), *digits]))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
