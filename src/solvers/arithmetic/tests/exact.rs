//! Exact values to compare with.

use crate::double_double::Dd;
use mechaudit_reference::{Ball, faddeeva};
use rug::float::Constant;
use rug::{Float, Rational};

/// Digits of what is called exact below: more than any number here has, and any difference needs.
pub const BITS: u32 = 640;

pub fn float(x: f64) -> Float {
    Float::with_val(BITS, x)
}

pub fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

/// `hi + lo`, exactly.
pub fn sum(x: Dd) -> Rational {
    rational(x.hi) + rational(x.lo)
}

pub fn wide(x: Dd) -> Float {
    float(x.hi) + x.lo
}

pub fn pi(bits: u32) -> Float {
    Float::with_val(bits, Constant::Pi)
}

/// `|x − y|/|size|`.
pub fn error(x: &Float, y: &Float, size: &Float) -> f64 {
    let d = Float::with_val(BITS, x - y).abs();
    if d.is_zero() {
        return 0.0;
    }
    (d / size).abs().to_f64()
}

/// `|x − y|/|y|` in units of u² = 2⁻¹⁰⁶.
pub fn in_squares(x: Dd, y: &Rational) -> f64 {
    let d = (sum(x) - y).abs();
    if d == 0 {
        return 0.0;
    }
    ((d / Rational::from(y.abs_ref())) << 106u32).to_f64()
}

/// Returns whether the parts are those of the number in the ball: each the nearest `f64` to what is
/// left.
pub fn are_parts(ball: &Ball, parts: &[f64]) -> bool {
    let mut rest = ball.clone();
    parts.iter().all(|&part| {
        let decided = rest.lower().to_f64() == rest.upper().to_f64();
        let right = rest.lower().to_f64() == part;
        rest = &rest - &Ball::exact(rest.prec(), part);
        decided && right
    })
}

/// w at `a + i y`, each component to 2⁻²⁰⁰ of itself.
pub fn w(a: f64, y: f64) -> (Float, Float) {
    let w = faddeeva::w_f64(a, y, 200).expect("decided");
    (w.re.mid().clone(), w.im.mid().clone())
}

/// Real and imaginary part of `e^{−z²}` at `z = a + i y`, to [`BITS`] digits.
pub fn gaussian(a: f64, y: f64) -> (Float, Float) {
    // The exponents of the largest squares are below 2048.
    let prec = 4400;
    let (a, y) = (Float::with_val(prec, a), Float::with_val(prec, y));
    let size = Float::with_val(prec, y.square_ref()) - Float::with_val(prec, a.square_ref());
    let phase: Float = Float::with_val(prec, &a * &y) * 2;
    let e = Float::with_val(BITS, size.exp_ref());
    let (s, c) = (
        Float::with_val(BITS, phase.sin_ref()),
        Float::with_val(BITS, phase.cos_ref()),
    );
    (c * &e, -(s * e))
}

/// `x` scaled by `2^k` where `n = ROUND + k`.
pub fn shifted(x: Dd, n: f64) -> Float {
    wide(x) << (n - crate::real::ROUND) as i32
}

/// The neighbouring `f64` between which f changes its sign.
pub fn crossing(f: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<[f64; 2]> {
    let (mut low, mut high) = (low, high);
    let sign = f(low) < 0.0;
    if sign == (f(high) < 0.0) {
        return None;
    }
    while low.next_up() < high {
        let t = (low + (high - low) / 2.0)
            .max(low.next_up())
            .min(high.next_down());
        if (f(t) < 0.0) == sign {
            low = t;
        } else {
            high = t;
        }
    }
    Some([low, high])
}
