//! Exponentials and the Gaussian of complex arguments in 256 bits.

use super::long::Long;
use crate::payne_hanek;

/// Real and imaginary part.
pub(super) type Complex = (Long, Long);

/// ln 2.
pub(super) const LN_2: Long = Long::parts(
    0,
    [
        0xb172_17f7_d1cf_79ab,
        0xc9e3_b398_03f2_f6af,
        0x40f3_4326_7298_b62d,
        0x8a0d_175b_8baa_fa2c,
    ],
);
/// π/2.
pub(super) const HALF_PI: Long = Long::parts(
    1,
    [
        0xc90f_daa2_2168_c234,
        0xc4c6_628b_80dc_1cd1,
        0x2902_4e08_8a67_cc74,
        0x020b_bea6_3b13_9b22,
    ],
);

pub(super) fn times((a, b): Complex, (c, d): Complex) -> Complex {
    (a * c - b * d, a * d + b * c)
}

pub(super) fn plus((a, b): Complex, (c, d): Complex) -> Complex {
    (a + c, b + d)
}

/// `1/(a + i b)`
pub(super) fn reciprocal((a, b): Complex) -> Complex {
    let r = (a.square() + b.square()).recip();
    (a * r, -(b * r))
}

/// An angle: quarter turns, and the rest in [−π/4, π/4].
#[derive(Clone, Copy)]
pub(super) struct Angle {
    pub quarters: i64,
    pub rest: Long,
}

impl Angle {
    /// `x` quarter turns, `|x| < 2⁵²`.
    pub(super) fn quarters(x: f64) -> Angle {
        let whole = x.round_ties_even();
        Angle {
            quarters: whole as i64,
            rest: Long::from(x - whole) * HALF_PI,
        }
    }
}

/// Each halving of the argument of the series takes a squaring.
const HALVINGS: i64 = 8;
/// Terms: `(0.9/2⁸)²⁴/24!` is below 2⁻²⁷⁴.
const TERMS: u64 = 24;

/// `e^{x + iφ}`; relative error of each component about 2⁻²⁴⁰ for `|x| < 2¹⁰` and where φ has few
/// quarters.
pub(super) fn exp(x: Long, phi: Angle) -> Complex {
    let k = (x.value() * std::f64::consts::LOG2_E).round_ties_even();
    let r = (
        (x - Long::from(k) * LN_2).scale(-HALVINGS),
        phi.rest.scale(-HALVINGS),
    );
    let one = (Long::ONE, Long::ZERO);
    let mut e = one;
    for n in (1..=TERMS).rev() {
        let (re, im) = times(e, r);
        e = plus(one, (re.over(n), im.over(n)));
    }
    for _ in 0..HALVINGS {
        e = times(e, e);
    }
    let (re, im) = (e.0.scale(k as i64), e.1.scale(k as i64));
    match phi.quarters & 3 {
        0 => (re, im),
        1 => (-im, re),
        2 => (-re, -im),
        _ => (im, -re),
    }
}

/// The phase `2 a y`, `a ≥ 0`.
fn phase(a: f64, y: f64) -> Angle {
    // Beyond, 318 digits of its fraction are known, and at least 212 of them are right.
    if a * y.abs() < 0.25 {
        return Angle {
            quarters: 0,
            rest: (Long::from(a) * Long::from(y)).scale(1),
        };
    }
    let (quarters, negative, fraction) = payne_hanek::fraction(a, y);
    let rest = Long::normal(negative, 0, &fraction) * HALF_PI;
    match y < 0.0 {
        true => Angle {
            quarters: -quarters,
            rest: -rest,
        },
        false => Angle { quarters, rest },
    }
}

/// `e^{−z²}` at `z = a + i y`, `a ≥ 0`, `|Re z²| < 2¹⁰`: each component to 2⁻²¹⁰ of the modulus.
pub(super) fn gaussian(a: f64, y: f64) -> Complex {
    let (p, q) = (Long::from(a), Long::from(y));
    let (re, im) = exp((q - p) * (q + p), phase(a, y));
    (re, -im)
}

#[cfg(test)]
mod tests;
