#!/usr/bin/env python3
"""Independent values of w(z) = exp(-z^2) erfc(-iz) and its relatives, by mpmath and by Arb.

mpmath: its own erfc (erf and erfi likewise) at rising precision until two precisions give the same
40 digits. Arb (python-flint): balls at rising precision until 40 digits of each component are
certain. Nothing of mechaudit is used.

    python3 reference/independent/faddeeva_values.py            # writes faddeeva_values.csv beside it
    python3 reference/independent/faddeeva_values.py --check    # compares instead, exit 1 if it differs

Writing needs both packages. The check recomputes the columns of mpmath always, and those of Arb
where python-flint is installed.

Columns: function, re, im (exact decimals; for w_zero the number of the zero and 0), then real and
imaginary part by mpmath and by Arb, 40 digits, 0 where the component is exactly zero.
"""
import os
import pathlib
import sys

import mpmath as mp

try:
    import flint
except ImportError:
    flint = None

DIGITS = 40

W_POINTS = [
    # moderate arguments, both half-planes
    ("0", "0"), ("1", "1"), ("0.5", "0.25"), ("-0.5", "0.25"), ("3", "0.1"), ("6.25", "0.5"),
    ("-2.5", "4"), ("7.9", "7.9"), ("1", "-1"), ("5.5", "-2.25"), ("-7.75", "-5.5"), ("0.01", "-0.02"),
    # the axes, and beside them
    ("0", "1"), ("0", "-4"), ("0", "25"), ("2", "0"), ("12", "0"), ("100", "0"),
    ("3", "1e-10"), ("3", "1e-300"), ("0.924", "1e-300"), ("8", "-1e-30"), ("27", "1e-300"), ("500", "1e-200"),
    ("1e-300", "3"), ("1e-300", "-3"), ("1e-40", "0.5"), ("1e-200", "50"),
    # near zeros of w, and near a zero curve of one component
    ("1.9914668428", "-1.3548101281"), ("2.6911490243", "-2.1770449061"), ("3.23533", "-2.78439"),
    ("-1.99146684283387957728", "-1.35481012811200624890"), ("2.2", "-0.002"),
    # diagonal rays past resonance
    ("10", "-10"), ("10", "-10.5"), ("31.5", "-31"), ("100", "-100.01"), ("1e4", "-1e4"), ("1000", "1000"),
    # far, small, extreme
    ("1e10", "1e-10"), ("1e10", "1e10"), ("-1e100", "1"), ("1e-20", "1e-20"), ("1e-300", "1e-300"),
    ("1e160", "1e160"), ("1e5", "3e-5"),
]
OTHERS = [("0.5", "0.25"), ("-3", "2"), ("2.5", "1e-200"), ("1e-200", "2.5"), ("1e-30", "-1e-31"), ("0", "2"),
          ("-4", "0"), ("6", "-5.5"), ("0.999", "8")]
ZEROS = [1, 2, 3, 10]


def cases():
    for re, im in W_POINTS:
        yield "w", re, im
    for name in ("erf", "erfc", "erfcx", "erfi", "dawson", "w_derivative_1", "w_derivative_5"):
        for re, im in OTHERS:
            yield name, re, im
    for k in ZEROS:
        yield "w_zero", str(k), "0"


def exact_zero(name, re, im):
    """Which components are exactly zero."""
    x0, y0 = float(re) == 0, float(im) == 0
    if name in ("erf", "erfi", "dawson"):
        return x0, y0
    if name == "erfc":
        return False, y0
    if name == "erfcx":
        return False, y0
    if name.startswith("w_derivative"):
        return x0, False  # odd orders only
    return False, x0 and name == "w"


def derivative(z, w, c, n):
    """w^(n) from w^(n+2) = -2z w^(n+1) - 2(n+1) w^(n); c = 2i/sqrt(pi)."""
    a, b = w, -2 * z * w + c
    for k in range(n - 1):
        a, b = b, -2 * z * b - 2 * (k + 1) * a
    return b


def by_mpmath(name, re, im):
    if name == "w_zero":
        mp.mp.dps = 3 * DIGITS
        lam = mp.sqrt((int(re) - mp.mpf(1) / 8) * mp.pi)
        mu = mp.log(lam * mp.sqrt(2 * mp.pi)) / (4 * lam)
        root = mp.mpc(lam + mu, mu - lam)
        for _ in range(9):
            w = mp.exp(-root * root) * mp.erfc(-1j * root)
            root -= w / (-2 * root * w + mp.mpc(0, 2 / mp.sqrt(mp.pi)))
        return mp.nstr(root.real, DIGITS), mp.nstr(root.imag, DIGITS)

    def once(dps):
        mp.mp.dps = dps
        x, y = mp.mpf(re), mp.mpf(im)
        z = mp.mpc(x, y)
        w = lambda t: mp.exp(-t * t) * mp.erfc(-1j * t)
        if name == "w":
            v = mp.mpc(mp.exp(-x * x), w(z).imag) if y == 0 else w(z)
        elif name == "erf":
            v = mp.erf(z)
        elif name == "erfc":
            # On the imaginary axis the real part is one.
            v = mp.mpc(1, mp.erfc(z).imag) if x == 0 else mp.erfc(z)
        elif name == "erfcx":
            v = mp.exp(z * z) * mp.erfc(z)
        elif name == "erfi":
            v = mp.erfi(z)
        elif name == "dawson":
            v = mp.sqrt(mp.pi) / 2 * mp.exp(-z * z) * mp.erfi(z)
        else:
            v = derivative(z, w(z), mp.mpc(0, 2 / mp.sqrt(mp.pi)), int(name[-1]))
        v = mp.mpc(v)
        zero = exact_zero(name, re, im)
        return tuple("0" if z else mp.nstr(part, DIGITS) for z, part in zip(zero, (v.real, v.imag)))

    dps, last = 120, None
    while True:
        now = once(dps)
        if now == last:
            return now
        dps, last = 2 * dps, now


def nearest(ball, digits):
    """The ball's digits in mpmath's spelling, or None if it does not decide them."""
    if not (ball.rel_accuracy_bits() > (digits + 12) * 3.33):
        return None
    mp.mp.dps = digits + 15
    return mp.nstr(mp.mpf(ball.mid().str(digits + 12, radius=False)), digits)


def by_arb(name, re, im):
    acb, arb, ctx = flint.acb, flint.arb, flint.ctx
    bits = 256
    while True:
        ctx.prec = bits
        i = acb(0, 1)
        c = 2 * i / arb.pi().sqrt()
        w = lambda t: (-t * t).exp() * (-i * t).erfc()
        if name == "w_zero":
            mp.mp.dps = DIGITS + 25
            start = [mp.nstr(mp.mpf(t), 20) for t in by_mpmath(name, re, im)]
            z = acb(arb(start[0]), arb(start[1]))
            for _ in range(6):
                v = w(z)
                z = z - v / (-2 * z * v + c)
                z = acb(z.real.mid(), z.imag.mid())
            # A last step, bounded by the derivative 2i/sqrt(pi) at the zero and a generous factor.
            step = w(z).abs_upper()
            z = acb(arb(z.real.mid(), 4 * step), arb(z.imag.mid(), 4 * step))
            v, zero = z, (False, False)
        else:
            x, y = arb(re), arb(im)
            z = acb(x, y)
            v = {
                "w": lambda: acb((-x * x).exp(), w(z).imag) if float(im) == 0 else w(z),
                "erf": lambda: z.erf(),
                "erfc": lambda: acb(1, z.erfc().imag) if float(re) == 0 else z.erfc(),
                "erfcx": lambda: (z * z).exp() * z.erfc(),
                "erfi": lambda: z.erfi(),
                "dawson": lambda: arb.pi().sqrt() / 2 * (-z * z).exp() * z.erfi(),
            }.get(name, lambda: derivative(z, w(z), c, int(name[-1])))()
            zero = exact_zero(name, re, im)
        parts = tuple("0" if z else nearest(part, DIGITS) for z, part in zip(zero, (v.real, v.imag)))
        if None not in parts:
            return parts
        bits *= 2
        if bits > 1 << 20:
            sys.exit(f"Arb does not decide {name} at {re}, {im}")


def main():
    path = pathlib.Path(__file__).with_suffix(".csv")
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(f"unknown argument {sys.argv[1]!r}: only --check is known")
    if flint is None and not check:
        sys.exit("python-flint is needed to write the values")
    recorded = path.read_text().splitlines()[1:] if check else None
    lines = ["function,re,im,mpmath_re,mpmath_im,arb_re,arb_im"]
    for k, (name, re, im) in enumerate(cases()):
        if flint is not None:
            arb = by_arb(name, re, im)
        else:
            arb = recorded[k].split(",")[5:7]
        lines.append(",".join([name, re, im, *by_mpmath(name, re, im), *arb]))
    text = "\n".join(lines) + "\n"
    if check:
        if path.read_text() != text:
            sys.exit(f"{path.name} differs from what mpmath {mp.__version__} gives")
        which = "mpmath" if flint is None else "mpmath and Arb"
        print(f"{path.name}: {len(lines) - 1} rows as recorded ({which})")
    else:
        temporary = path.with_suffix(".tmp")
        temporary.write_text(text)
        os.replace(temporary, path)


if __name__ == "__main__":
    main()
