#!/usr/bin/env python3
"""Independent values of Andrews' squeezing mechanism at t = 0.01, 0.02 and 0.03 s, by mpmath alone.

The printed equations M(q) q'' + G' lambda = f, g(q) = 0 with the printed parameters are reduced to one equation of
second order for beta: the other angles in closed form by circles that meet (three dyads), their rates and
accelerations by 2 x 2 systems. It is integrated in time by extrapolation of the explicit midpoint rule after Gragg,
Bulirsch and Stoer. At the end the full system of 13 equations gives accelerations and multipliers.

Nothing of mechaudit is used, neither the energy nor an integral over beta, and nothing is proved.

    python3 reference/independent/andrews.py            # writes andrews.csv beside it
    python3 reference/independent/andrews.py --check    # compares instead, exit 1 if it differs

Columns: t (s), quantity, value; 20 digits.
"""
import mpmath as mp

from check import run

mp.mp.dps = 32
DIGITS = 20
TIMES = ["0.01", "0.02", "0.03"]
# Steps from one of the times to the next, and columns of the extrapolation.
STEPS = 40
COLUMNS = 14

PARAMETERS = """m1 0.04325 m2 0.00365 m3 0.02373 m4 0.00706 m5 0.07050 m6 0.00706 m7 0.05498 xa -0.06934 ya -0.00227
xb -0.03635 yb 0.03273 xc 0.014 yc 0.072 c0 4530 i1 2.194e-6 i2 4.410e-7 i3 5.255e-6 i4 5.667e-7 i5 1.169e-5
i6 5.667e-7 i7 1.912e-5 d 28e-3 da 115e-4 e 2e-2 ea 1421e-5 rr 7e-3 ra 92e-5 l0 7785e-5 ss 35e-3 sa 1874e-5
sb 1043e-5 sc 18e-3 sd 2e-2 ta 2308e-5 tb 916e-5 u 4e-2 ua 1228e-5 ub 449e-5 zf 2e-2 zt 4e-2 fa 1421e-5
mom 33e-3""".split()
p = {name: mp.mpf(value) for name, value in zip(PARAMETERS[::2], PARAMETERS[1::2])}
A, B = mp.mpc(p["xa"], p["ya"]), mp.mpc(p["xb"], p["yb"])
I = mp.mpc(0, 1)
ZERO, ONE = mp.mpf(0), mp.mpf(1)


def meet(a, ra, b, rb, side):
    """Where the circles around a and b meet, on the given side of the line from a to b."""
    way = b - a
    n = way.real**2 + way.imag**2
    along = (n + ra**2 - rb**2) / (2 * n)
    return a + way * (along + side * I * mp.sqrt(ra**2 / n - along**2))


def position(beta):
    """beta, Theta, gamma, Phi, delta, Omega, epsilon."""
    crank = p["rr"] * mp.expj(beta)
    joint = meet(crank, p["d"], B, p["ss"], 1)
    link = mp.arg(crank - joint)
    gamma = mp.arg(I * (joint - B))
    knee = meet(A, p["zt"], joint, p["e"], 1)
    delta = mp.arg(knee - A)
    phi = mp.arg(I * (joint - knee)) - delta
    knee = meet(A, p["u"], joint, p["zf"], -1)
    epsilon = mp.arg(I * (knee - A))
    omega = mp.arg(joint - knee) - epsilon
    return [beta, link - beta, gamma, phi, delta, omega, epsilon]


def jacobian(q):
    """The printed G."""
    beta, theta, gamma, phi, delta, omega, epsilon = q
    s, c = mp.sin(beta + theta), mp.cos(beta + theta)
    rows = [[ZERO] * 7 for _ in range(6)]
    for k in (0, 2, 4):
        rows[k][0], rows[k][1] = -p["rr"] * mp.sin(beta) + p["d"] * s, p["d"] * s
        rows[k + 1][0], rows[k + 1][1] = p["rr"] * mp.cos(beta) - p["d"] * c, -p["d"] * c
    rows[0][2], rows[1][2] = -p["ss"] * mp.cos(gamma), -p["ss"] * mp.sin(gamma)
    sum4, sum6 = phi + delta, omega + epsilon
    rows[2][3], rows[3][3] = -p["e"] * mp.cos(sum4), -p["e"] * mp.sin(sum4)
    rows[2][4] = rows[2][3] + p["zt"] * mp.sin(delta)
    rows[3][4] = rows[3][3] - p["zt"] * mp.cos(delta)
    rows[4][5], rows[5][5] = p["zf"] * mp.sin(sum6), -p["zf"] * mp.cos(sum6)
    rows[4][6] = rows[4][5] - p["u"] * mp.cos(epsilon)
    rows[5][6] = rows[5][5] - p["u"] * mp.sin(epsilon)
    return rows


def curvature(q, v):
    """d(G v)/dt for fixed v': minus the second derivatives of the links' vectors."""
    beta, theta, gamma, phi, delta, omega, epsilon = q
    turn = lambda length, angle, rate: length * mp.expj(angle) * rate**2
    joint = -turn(p["rr"], beta, v[0]) + turn(p["d"], beta + theta, v[0] + v[1])
    three = turn(-I * p["ss"], gamma, v[2])
    four = turn(-I * p["e"], phi + delta, v[3] + v[4]) + turn(p["zt"], delta, v[4])
    six = turn(p["zf"], omega + epsilon, v[5] + v[6]) + turn(-I * p["u"], epsilon, v[6])
    sums = [joint + three, joint + four, joint + six]
    return [part for z in sums for part in (z.real, z.imag)]


def chain(rows, first, rest):
    """q' or q'' from its first element and G q = rest, pair by pair: each pair of equations brings two unknowns."""
    out = [first] + [ZERO] * 6
    pairs = [(0, 1, 2), (2, 3, 4), (4, 5, 6)]
    for k, i, j in pairs:
        known = [0] if k == 0 else [0, 1]
        right = [rest[k + r] - sum(rows[k + r][m] * out[m] for m in known) for r in (0, 1)]
        a, b, c, d = rows[k][i], rows[k][j], rows[k + 1][i], rows[k + 1][j]
        det = a * d - b * c
        out[i], out[j] = (right[0] * d - b * right[1]) / det, (a * right[1] - right[0] * c) / det
    return out


def mass(q):
    """The printed M."""
    theta, phi, omega = q[1], q[3], q[5]
    m = [[ZERO] * 7 for _ in range(7)]
    arm, back = p["e"] - p["ea"], p["zf"] - p["fa"]
    cross = p["da"] * p["rr"] * mp.cos(theta)
    m[0][0] = p["m1"] * p["ra"]**2 + p["m2"] * (p["rr"]**2 - 2 * cross + p["da"]**2) + p["i1"] + p["i2"]
    m[0][1] = m[1][0] = p["m2"] * (p["da"]**2 - cross) + p["i2"]
    m[1][1] = p["m2"] * p["da"]**2 + p["i2"]
    m[2][2] = p["m3"] * (p["sa"]**2 + p["sb"]**2) + p["i3"]
    m[3][3] = p["m4"] * arm**2 + p["i4"]
    lever = p["zt"] * arm * mp.sin(phi)
    m[3][4] = m[4][3] = p["m4"] * (arm**2 + lever) + p["i4"]
    m[4][4] = (p["m4"] * (p["zt"]**2 + 2 * lever + arm**2) + p["m5"] * (p["ta"]**2 + p["tb"]**2)
               + p["i4"] + p["i5"])
    m[5][5] = p["m6"] * back**2 + p["i6"]
    lever = p["u"] * back * mp.sin(omega)
    m[5][6] = m[6][5] = p["m6"] * (back**2 - lever) + p["i6"]
    m[6][6] = (p["m6"] * (back**2 - 2 * lever + p["u"]**2) + p["m7"] * (p["ua"]**2 + p["ub"]**2)
               + p["i6"] + p["i7"])
    return m


def forces(q, v):
    """The printed f."""
    beta, theta, gamma, phi, delta, omega, epsilon = q
    end = mp.mpc(p["xb"], p["yb"]) + mp.mpc(p["sd"], -p["sc"]) * mp.expj(gamma)
    way = end - mp.mpc(p["xc"], p["yc"])
    length = abs(way)
    pull = -p["c0"] * (length - p["l0"]) / length * way
    s, c = mp.sin(gamma), mp.cos(gamma)
    lever = p["m2"] * p["da"] * p["rr"] * mp.sin(theta)
    four = p["m4"] * p["zt"] * (p["e"] - p["ea"]) * mp.cos(phi)
    six = p["m6"] * p["u"] * (p["zf"] - p["fa"]) * mp.cos(omega)
    return [
        p["mom"] - lever * v[1] * (v[1] + 2 * v[0]),
        lever * v[0]**2,
        pull.real * (p["sc"] * c - p["sd"] * s) + pull.imag * (p["sd"] * c + p["sc"] * s),
        four * v[4]**2,
        -four * v[3] * (v[3] + 2 * v[4]),
        -six * v[6]**2,
        six * v[5] * (v[5] + 2 * v[6]),
    ]


def acceleration(beta, speed):
    """beta'', by the equations of motion along the one direction that the constraints leave."""
    q = position(beta)
    rows = jacobian(q)
    along = chain(rows, ONE, [ZERO] * 6)
    v = [a * speed for a in along]
    rest = chain(rows, ZERO, [-x for x in curvature(q, v)])
    m, f = mass(q), forces(q, v)
    pulled = [sum(m[i][j] * along[j] for j in range(7)) for i in range(7)]
    reduced = mp.fdot(pulled, along)
    return (mp.fdot(along, f) - mp.fdot(pulled, rest)) / reduced


def midpoint(y, h, n):
    """n explicit midpoint steps over h, smoothed at the end after Gragg."""
    h = h / n
    step = lambda a, b, k: (a[0] + k * b[1], a[1] + k * acceleration(*b))
    before, at = y, step(y, y, h)
    for _ in range(n - 1):
        before, at = at, step(before, at, 2 * h)
    slope = (at[1], acceleration(*at))
    return tuple((a + b + h * k) / 2 for a, b, k in zip(at, before, slope))


def extrapolated(y, h):
    table = []
    for k in range(COLUMNS):
        row = [midpoint(y, h, 2 * (k + 1))]
        for j in range(k):
            ratio = (mp.mpf(k + 1) / (k - j))**2 - 1
            row.append(tuple(a + (a - b) / ratio for a, b in zip(row[j], table[k - 1][j])))
        table.append(row)
    return table[-1][-1]


def start():
    """beta with Theta = 0: crank and link on one line, |P - B| = ss."""
    reach = p["d"] - p["rr"]
    # P = -reach e^(i beta).
    to = abs(B)
    angle = mp.acos((reach**2 + to**2 - p["ss"]**2) / (2 * reach * to))
    return min((mp.arg(-B) + s * angle for s in (1, -1)), key=lambda b: abs(b + mp.mpf("0.0617")))


def everything(beta, speed):
    q = position(beta)
    # Theta counts turns with beta.
    q[1] -= 2 * mp.pi * mp.nint((q[1] + beta) / (2 * mp.pi))
    rows = jacobian(q)
    v = chain(rows, speed, [ZERO] * 6)
    m, f, rest = mass(q), forces(q, v), curvature(q, v)
    matrix = mp.zeros(13, 13)
    right = mp.zeros(13, 1)
    for i in range(7):
        right[i] = f[i]
        for j in range(7):
            matrix[i, j] = m[i][j]
        for k in range(6):
            matrix[i, 7 + k] = matrix[7 + k, i] = rows[k][i]
    for k in range(6):
        right[7 + k] = -rest[k]
    return q + v + list(mp.lu_solve(matrix, right))


ANGLES = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"]
NAMES = ANGLES + [a + "_dot" for a in ANGLES] + [a + "_ddot" for a in ANGLES] + [f"lambda_{k}" for k in range(1, 7)]


def table():
    lines = ["t_s,quantity,value"]
    y, before = (start(), ZERO), ZERO
    for text in TIMES:
        h = (mp.mpf(text) - before) / STEPS
        for _ in range(STEPS):
            y = extrapolated(y, h)
        before = mp.mpf(text)
        values = everything(*y)
        lines += [f"{text},{n},{mp.nstr(v, DIGITS)}" for n, v in zip(NAMES, values)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
