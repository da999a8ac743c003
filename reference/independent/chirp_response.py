#!/usr/bin/env python3
"""Independent values of the chirp-forced oscillator, by mpmath's quadrature and ODE solver.

    y'' + 2n y' + w^2 y = w^2 cos(theta),  theta = k (omega0 t + eps t^2/2) + delta,  y(0) = y0, y'(0) = v0

y, y' and the complex amplitude A of the response from rest (Re A e^{-i theta}) by Gauss-Legendre quadrature
of the convolution integral in pieces of a few radians, without the Faddeeva function; y'' from the
equation. Where the column says so, y and y' by `odefun` (Taylor series in time) as well, to 15 digits.
Nothing of mechaudit is used, and nothing is proved.

    python3 reference/independent/chirp_response.py            # writes chirp_response.csv beside it
    python3 reference/independent/chirp_response.py --check    # compares instead, exit 1 if it differs

Columns: w, n, eps, omega0, k, delta, y0, v0, t (exact decimals), then y, v, a, A_re, A_im; 30 digits.
"""
import mpmath as mp

from check import run

DIGITS = 30

CASES = [
    # run-up from rest, before and long after resonance
    ("10", "0.5", "4", "0", "2", "0", "0", "0", "1.5"),
    ("10", "0.5", "4", "0", "2", "0", "0", "0", "4"),
    # run-down with an initial state
    ("10", "0.5", "-4", "30", "2", "0.3", "0.1", "-2", "8"),
    # reversal through zero speed, both resonances passed
    ("2", "0.01", "0.5", "-9", "1", "0.25", "0", "0", "40"),
    # undamped, in resonance: constant speed, and a slow sweep
    ("3", "0", "0", "3", "1", "0.5", "0", "0", "20"),
    ("3", "0", "1e-9", "3", "1", "0.5", "0.5", "0", "20"),
    # critical, beside it, overdamped
    ("2", "2", "1.5", "-1", "1", "0.5", "0.5", "-1", "6"),
    ("2", "2.000000001", "1.5", "-1", "1", "0.5", "0.5", "-1", "6"),
    ("2", "1.999999999", "1.5", "-1", "1", "0.5", "0.5", "-1", "6"),
    ("2", "11", "-1.5", "4", "3", "0.5", "0.5", "-1", "5"),
    # quasi-static, and a constant force
    ("50", "3", "0.001", "0.02", "1", "1", "0", "0", "12"),
    ("5", "0.3", "4", "1", "0", "0.7", "0.1", "0.2", "3"),
    # a fast sweep, a short time
    ("1", "0.05", "200", "-3", "4", "0.1", "0", "0", "0.4"),
    ("7", "0.2", "3", "5", "9", "-1.1", "0", "0", "1e-6"),
]
BY_ODE = {0, 2, 6, 9}


def impulse(w, n, s):
    """K(s), K'(s)."""
    x = (n * n - w * w) * s * s
    e = mp.exp(-n * s)
    if x == 0:
        k = s * e
        return k, e - n * k
    root = mp.sqrt(x)  # imaginary when underdamped
    k = (s * e * mp.sinh(root) / root).real if isinstance(root, mp.mpc) else s * e * mp.sinh(root) / root
    return k, mp.re(e * mp.cosh(root)) - n * k


def row(index, case):
    mp.mp.dps = DIGITS + 20
    w, n, eps, omega0, k, delta, y0, v0, t = [mp.mpf(x) for x in case]
    theta = lambda s: k * (omega0 * s + eps * s * s / 2) + delta
    speed = w + 2 * n + abs(k) * max(abs(omega0), abs(omega0 + eps * t))
    pieces = mp.linspace(0, t, int(mp.ceil(speed * t / 4)) + 2)
    force = lambda s: mp.expj(-theta(t - s))
    psi = w * w * mp.quad(lambda s: impulse(w, n, s)[0] * force(s), pieces, method="gauss-legendre")
    rate = w * w * mp.quad(lambda s: impulse(w, n, s)[1] * force(s), pieces, method="gauss-legendre")
    free, slope = impulse(w, n, t)
    y = psi.real + y0 * (slope + 2 * n * free) + v0 * free
    v = rate.real + v0 * slope - w * w * y0 * free
    a = w * w * mp.cos(theta(t)) - 2 * n * v - w * w * y
    amplitude = psi * mp.expj(theta(t))
    if k == 0:
        amplitude = mp.mpc(amplitude.real, 0)
    if index in BY_ODE:
        mp.mp.dps = 20
        f = mp.odefun(lambda s, u: [u[1], w * w * (mp.cos(theta(s)) - u[0]) - 2 * n * u[1]], 0, [y0, v0])
        for ours, theirs in zip((y, v), f(t)):
            assert abs(ours - theirs) < mp.mpf(10) ** -15 * (1 + abs(ours)), (case, ours, theirs)
        mp.mp.dps = DIGITS + 20
    return [mp.nstr(x, DIGITS) for x in (y, v, a, amplitude.real, amplitude.imag)]


def table():
    lines = ["w,n,eps,omega0,k,delta,y0,v0,t,y,v,a,A_re,A_im"]
    for index, case in enumerate(CASES):
        lines.append(",".join([*case, *row(index, case)]))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    run(__file__, table)
