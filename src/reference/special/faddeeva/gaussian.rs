//! `e^{−z²}` by components, with an exponent of any size.
//!
//! `e^{−(x+iy)²} = e^{y²−x²} (cos 2xy − i sin 2xy)`. The arguments of exp, sin and cos are formed
//! by ball arithmetic with `2 log2|z|` bits beyond the working precision, so that their absolute
//! error is below 2^-prec however large z is.

use super::scaled::Scaled;
use crate::{Ball, Mag};
use rug::{Float, Integer};

/// `e^{−z²} = 2^k (c − i s)`.
pub(super) struct Gaussian {
    pub c: Ball,
    pub s: Ball,
    pub k: Integer,
}

/// Beyond this exponent (of e) the result is scaled by a power of two.
const DIRECT: f64 = 1e8;

impl Gaussian {
    pub fn new(x: &Ball, y: &Ball, prec: u32) -> Gaussian {
        let t = (y - x) * &(y + x);
        let (e, k) = exp_scaled(&t, prec);
        let (sin, cos) = (x * y).shift(1).sin_cos();
        Gaussian {
            c: &e * &cos.with_prec(prec),
            s: &e * &sin.with_prec(prec),
            k,
        }
    }

    /// Only a bound on the modulus is known.
    pub fn absent(bound: Mag, prec: u32) -> Gaussian {
        let around_zero = Ball::new(Float::new(prec), bound);
        Gaussian {
            c: around_zero.clone(),
            s: around_zero,
            k: Integer::new(),
        }
    }

    /// The two components `(cos, sin)` times two to the power asked for, relative to 2^by:
    /// `(c, s) 2^(k − by)`. What falls below 2^-(2^29) becomes `0 ± 2^-(2^29)`.
    pub fn relative_to(&self, by: &Integer) -> (Ball, Ball) {
        let k = Integer::from(&self.k - by);
        (Scaled::shifted(&self.c, &k), Scaled::shifted(&self.s, &k))
    }
}

/// `e^t = m 2^k`, with k = 0 unless |t| is very large, and then m in [1/2, 2].
pub(super) fn exp_scaled(t: &Ball, prec: u32) -> (Ball, Integer) {
    let size = t.mid().to_f64().abs();
    if size < DIRECT {
        return (t.with_prec(prec).exp(), Integer::new());
    }
    let ln2 = Ball::integer(t.prec(), 2).ln();
    let k = Float::with_val(t.prec(), t.mid() / ln2.mid());
    let Some(k) = k.to_integer() else {
        return (t.exp(), Integer::new());
    };
    let turns = Ball::new(Float::with_val(k.significant_bits().max(64), &k), Mag::ZERO);
    let rest = t - &(&turns * &ln2);
    (rest.with_prec(prec).exp(), k)
}
