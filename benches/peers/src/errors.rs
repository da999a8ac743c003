//! The error of one value against the certified reference.

use mechaudit::audit::{ulp_exponent, ulps};
use mechaudit::reference::{Ball, ComplexBall};
use num_complex::Complex64;

/// Errors of one value. `eps = 2⁻⁵²`; relative errors are taken against `max(|ref|, 2⁻¹⁰²²)`, so
/// that a subnormal reference does not ask for digits it cannot have. Every figure is an upper
/// bound that includes the radius of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// `|got − ref| / |ref|` of the complex numbers, in eps.
    pub normwise: f64,
    /// Of the real and the imaginary part, each relative to itself, in eps.
    pub relative: [f64; 2],
    /// Of the real and the imaginary part in ulps of the reference: `2^(e−52)` for a reference in
    /// `[2^e, 2^(e+1))`, never below `2⁻¹⁰⁷⁴`.
    pub ulps: [f64; 2],
}

/// The outcome of a comparison.
#[derive(Clone, Copy, Debug)]
pub enum Outcome {
    /// Both parts are finite, as they should be.
    Finite(Errors),
    /// A part is to be infinite, and every part is of the right kind and sign.
    Infinite,
    /// NaN or an infinity where a finite value is due, or a wrong infinity, or none.
    WrongKind,
    /// The reference does not tell.
    Undecided,
}

/// Returns the infinity that a part rounds to, if it overflows.
fn overflow(part: &Ball) -> Option<f64> {
    // The largest double and half its ulp: 2^1024 − 2^970.
    let rounded = part.mid().to_f64();
    rounded.is_infinite().then_some(rounded)
}

/// `|part| 2^-(k+52)`, below 2, with its ulp `2^k`.
fn scaled(part: &Ball) -> (f64, i64) {
    let k = ulp_exponent(part.mid());
    (part.mignitude().shift(-(k + 52)).to_f64(), k)
}

/// `2^n` for `n <= 0`.
fn two_to(n: i64) -> f64 {
    (n.max(-1100) as f64).exp2()
}

/// Compares.
pub fn compare(got: Complex64, reference: &ComplexBall) -> Outcome {
    let parts = [(got.re, &reference.re), (got.im, &reference.im)];
    if parts.iter().any(|(_, r)| !r.is_finite()) {
        return Outcome::Undecided;
    }
    let due = parts.map(|(_, r)| overflow(r));
    let right = |(g, r): (f64, Option<f64>)| match r {
        Some(infinity) => g == infinity,
        None => g.is_finite(),
    };
    if !right((got.re, due[0])) || !right((got.im, due[1])) {
        return Outcome::WrongKind;
    }
    if due.iter().any(Option::is_some) {
        return Outcome::Infinite;
    }
    let mut high = [0.0; 2];
    let mut relative = [0.0; 2];
    let mut size = [(0.0, 0); 2];
    for (i, (g, r)) in parts.into_iter().enumerate() {
        let (lo, hi) = ulps(g, r);
        if hi - lo > 0.01 * hi.max(1.0) {
            return Outcome::Undecided;
        }
        size[i] = scaled(r);
        high[i] = hi;
        // Below 1 only for a subnormal reference: then 2^(k+52) is 2^-1022.
        relative[i] = hi / size[i].0.max(1.0);
    }
    let top = size[0].1.max(size[1].1);
    let in_top =
        |x: [f64; 2]| (x[0] * two_to(size[0].1 - top)).hypot(x[1] * two_to(size[1].1 - top));
    let norm = in_top([size[0].0, size[1].0]);
    Outcome::Finite(Errors {
        normwise: in_top(high) / norm.max(1.0),
        relative,
        ulps: high,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    fn ball(re: f64, im: f64) -> ComplexBall {
        ComplexBall::new(Ball::exact(128, re), Ball::exact(128, im))
    }

    fn finite(got: (f64, f64), re: f64, im: f64) -> Errors {
        match compare(Complex64::new(got.0, got.1), &ball(re, im)) {
            Outcome::Finite(e) => e,
            other => panic!("{other:?}"),
        }
    }

    const EPS: f64 = f64::EPSILON;

    #[test]
    fn planted_errors_are_measured() {
        let e = finite((1.5 + 2.0 * EPS, -1e-3), 1.5, -1e-3);
        assert!((e.ulps[0] - 2.0).abs() < 1e-9 && e.ulps[1] < 1e-9);
        assert!((e.relative[0] - 2.0 / 1.5).abs() < 1e-9);
        assert!((e.normwise - 2.0 / 1.5).abs() < 1e-5);
        // An error of the smaller part counts little in the norm, fully by itself.
        let e = finite((1.0, 2e-300), 1.0, 1e-300);
        assert!(e.normwise < 1e-200);
        assert!((e.relative[1] * EPS - 1.0).abs() < 1e-9);
        // 3-4-5: the error i eps is eps / 5.
        let e = finite((3.0, 4.0 + 4.0 * EPS), 3.0, 4.0);
        assert!((e.normwise - 0.8).abs() < 1e-9, "{e:?}");
        assert!((e.relative[1] - 1.0).abs() < 1e-9);
    }

    #[test]
    fn subnormal_references_ask_for_absolute_accuracy() {
        let tiny = f64::from_bits(1);
        let e = finite((1.0, 2.0 * tiny), 1.0, tiny);
        assert!((e.ulps[1] - 1.0).abs() < 1e-9 && (e.relative[1] - 1.0).abs() < 1e-9);
        let e = finite((0.0, 0.0), tiny, tiny);
        assert!((e.normwise - 2f64.sqrt()).abs() < 1e-6);
        let e = finite((1.0, -0.0), 1.0, 0.0);
        assert!(e.ulps[1] == 0.0 && e.relative[1] == 0.0);
    }

    #[test]
    fn kinds() {
        let at = |re, im, r: &ComplexBall| compare(Complex64::new(re, im), r);
        let one = ball(1.0, 1.0);
        for (re, im) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0)] {
            assert!(matches!(at(re, im, &one), Outcome::WrongKind));
        }
        let huge = Ball::new(
            Float::with_val(128, f64::MAX) * 2u32,
            mechaudit::reference::Mag::ZERO,
        );
        let huge = ComplexBall::new(-huge, Ball::exact(128, 1.0));
        assert!(matches!(
            at(f64::NEG_INFINITY, 1.0, &huge),
            Outcome::Infinite
        ));
        assert!(matches!(at(f64::INFINITY, 1.0, &huge), Outcome::WrongKind));
        assert!(matches!(at(f64::MIN, 1.0, &huge), Outcome::WrongKind));
        let vague = Ball::new(
            Float::with_val(128, 1.0),
            mechaudit::reference::Mag::from_f64(1e-16),
        );
        let vague = ComplexBall::new(vague, Ball::exact(128, 1.0));
        assert!(matches!(at(1.0, 1.0, &vague), Outcome::Undecided));
    }
}
