#!/usr/bin/env python3
"""Independent values of two short run-ups, by mpmath alone.

1. The sand screen from rest at 14.426 degrees under a Kloss motor (omega_c = 10 rad/s, M_n = 200 N m,
   k = 2.2, s_n = 0.05 at the crank, I_1 = 0): crank angle and speed after 0.5 ms and 1 ms by mpmath's
   `odefun` (Taylor series from numerical differences) in time; positions by Newton's method on the
   loop equations in the link angles, rates by implicit differentiation.
2. A bare rotor (I = 0.9 kg m^2, M_k = 22 N m, S_k = 0.2, omega_c = 157 rad/s): the speed after 1 s and
   10 s as the root of the closed solution t(S).

Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/run_up.py            # writes run_up.csv beside it
    python3 reference/independent/run_up.py --check    # compares instead, exit 1 if it differs

Columns: case, t (s), phi (rad; empty for the rotor), psi (rad/s); 16 digits.
"""
import mpmath as mp

from check import run

mp.mp.dps = 22
DIGITS = 16

deg = lambda: mp.pi / 180


def data():
    cm = mp.mpf(1) / 100
    l1, l2, l3, l4, l5, lb = [mp.mpf(x) * cm for x in ("10", "104", "60", "64", "48.5", "22")]
    o3 = mp.mpc(75 * cm, 93 * cm)
    o5 = mp.mpc(mp.mpf("128.5") * cm, mp.mpf("103.5") * cm)
    return l1, l2, l3, l4, l5, lb, mp.mpf("-39.3") * deg(), o3, o5


# link: (mass, inertia, inertia about the pivot, radius in cm, angle in degrees)
BODIES = {
    2: ("10", "0.8", False, 50, 0),
    3: ("5", "0.5", True, 30, 0),
    4: ("550", "18", False, 25, -12),
    5: ("3.5", "0.2", True, 20, 0),
}
GUESS = ["14.426", "-76.174", "22.558", "-65.721"]
last = {}


def solve(columns, rhs):
    return mp.lu_solve(mp.matrix(columns), mp.matrix(rhs))


def reduced(phi):
    """I_n, dI_n/dphi and M_o."""
    l1, l2, l3, l4, l5, lb, beta, o3, o5 = data()
    e = mp.expj
    p = last.get("p") or [mp.mpf(x) * deg() for x in GUESS]
    rows = lambda z1, z2: [z1.real, z1.imag, z2.real, z2.imag]
    for _ in range(60):
        u2, u3, u4, u5, ub = l2 * e(p[0]), l3 * e(p[1]), l4 * e(p[2]), l5 * e(p[3]), lb * e(p[2] + beta)
        f = rows(l1 * e(phi) + u2 - o3 - u3 - ub, o3 + u3 + u4 - o5 - u5)
        # Derivatives by phi2 .. phi5.
        col = [rows(1j * u2, 0 * u2), rows(-1j * u3, 1j * u3), rows(-1j * ub, 1j * u4), rows(0 * u5, -1j * u5)]
        m = [[col[c][r] for c in range(4)] for r in range(4)]
        step = solve(m, [-x for x in f])
        p = [a + b for a, b in zip(p, step)]
        if max(abs(x) for x in step) < mp.mpf(2) ** (-mp.mp.prec // 2 - 8):
            break
    else:
        raise ArithmeticError("no convergence")
    last["p"] = p
    u2, u3, u4, u5, ub = l2 * e(p[0]), l3 * e(p[1]), l4 * e(p[2]), l5 * e(p[3]), lb * e(p[2] + beta)
    col = [rows(1j * u2, 0 * u2), rows(-1j * u3, 1j * u3), rows(-1j * ub, 1j * u4), rows(0 * u5, -1j * u5)]
    m = [[col[c][r] for c in range(4)] for r in range(4)]
    a1 = 1j * l1 * e(phi)
    w = solve(m, [-x for x in rows(a1, 0 * a1)])
    bend = rows(-l1 * e(phi) - u2 * w[0] ** 2 + u3 * w[1] ** 2 + ub * w[2] ** 2,
                -u3 * w[1] ** 2 - u4 * w[2] ** 2 + u5 * w[3] ** 2)
    q = solve(m, [-x for x in bend])
    # Velocities and accelerations (per crank speed) of the links' origins.
    c1, c2 = 1j * u3 * w[1], 1j * u3 * q[1] - u3 * w[1] ** 2
    origin = {2: (a1, -l1 * e(phi)), 3: (0, 0), 4: (c1, c2), 5: (0, 0)}
    total = slope = moment = mp.mpf(0)
    for i, link in enumerate((2, 3, 4, 5)):
        mass, inertia, pivot, r, angle = BODIES[link]
        mass, inertia = mp.mpf(mass), mp.mpf(inertia)
        arm = mp.mpf(r) / 100 * e(p[i] + angle * deg())
        v = origin[link][0] + 1j * arm * w[i]
        acc = origin[link][1] + 1j * arm * q[i] - arm * w[i] ** 2
        total += inertia * w[i] ** 2
        slope += 2 * inertia * w[i] * q[i]
        if not pivot:
            total += mass * abs(v) ** 2
            slope += 2 * mass * (v * mp.conj(acc)).real
        moment -= mass * mp.mpf("9.81") * v.imag
    return total, slope, moment


def motion(t, y):
    phi, psi = y
    inertia, slope, moment = reduced(phi)
    k, s_n, m_n, wc = mp.mpf("2.2"), mp.mpf("0.05"), 200, 10
    s, sk = (wc - psi) / mp.mpf(wc), s_n * (k + mp.sqrt(k**2 - 1))
    motor = 2 * k * m_n * s * sk / (s**2 + sk**2)
    return [psi, (motor + moment - psi**2 * slope / 2) / inertia]


def table():
    show = lambda x: mp.nstr(x, DIGITS, min_fixed=-5, max_fixed=50)
    lines = ["case,t_s,phi_rad,psi_rad_per_s"]
    f = mp.odefun(motion, 0, [mp.mpf("14.426") * deg(), mp.mpf(0)], tol=mp.mpf(10) ** -19)
    for t in ("0.0005", "0.001"):
        phi, psi = f(mp.mpf(t))
        lines.append(f"sand screen,{t},{show(phi)},{show(psi)}")
    i, mk, sk, wc = mp.mpf("0.9"), 22, mp.mpf("0.2"), 157
    for t, guess in (("1", "0.94"), ("10", "0.045")):
        time = lambda s: i * wc / (2 * mk) * (sk * mp.log(1 / s) + (1 - s**2) / (2 * sk)) - mp.mpf(t)
        lines.append(f"bare rotor,{t},,{show(wc * (1 - mp.findroot(time, mp.mpf(guess))))}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
