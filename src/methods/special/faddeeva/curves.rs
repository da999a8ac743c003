//! Points next to zeros of W and to the curves on which a component of W is zero.
//!
//! They are found with the reference, so that a case stays what it is when the solver changes.

use crate::audit::Draw;
use crate::reference::faddeeva::{w_f64, zero as certified};
use std::sync::OnceLock;

/// Zeros kept.
const ZEROS: usize = 400;

/// The `f64` next to the k-th zero with positive real part, k = 1 … 400.
pub(in crate::methods::special) fn zero(k: usize) -> [f64; 2] {
    static ALL: [OnceLock<[f64; 2]>; ZEROS] = [const { OnceLock::new() }; ZEROS];
    *ALL[(k - 1) % ZEROS].get_or_init(|| match certified(k as u32, 60) {
        Ok(z) => [z.re.to_f64(), z.im.to_f64()],
        // An argument that the audit shows as not finite.
        Err(_) => [f64::NAN; 2],
    })
}

/// A component.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::methods::special) enum Part {
    Re,
    Im,
}

/// The component, with its sign proved. Bits that a step of the secant has no use for would cost a second evaluation
/// next to its zeros.
fn value(x: f64, y: f64, part: Part) -> f64 {
    let w = w_f64(x, y, 30).map(|w| match part {
        Part::Re => w.re.to_f64(),
        Part::Im => w.im.to_f64(),
    });
    // Undecided: taken for a zero.
    w.unwrap_or(0.0)
}

/// A sign change of f between a and b by bisection with steps of the secant (Illinois).
pub(in crate::methods::special) fn crossing(f: impl Fn(f64) -> f64, a: f64, b: f64) -> Option<f64> {
    let (mut a, mut b) = (a, b);
    let (mut p, mut q) = (f(a), f(b));
    if !(p * q < 0.0) || !p.is_finite() || !q.is_finite() {
        return None;
    }
    for _ in 0..60 {
        let c = b - q * (b - a) / (q - p);
        if !(c > a.min(b) && c < a.max(b)) {
            break;
        }
        let r = f(c);
        if r == 0.0 {
            return Some(c);
        }
        if (r < 0.0) == (q < 0.0) {
            p /= 2.0;
        } else {
            (a, p) = (b, q);
        }
        if (c - b).abs() <= c.abs() * f64::EPSILON {
            return Some(c);
        }
        (b, q) = (c, r);
    }
    Some(b)
}

/// `x` moved by up to three of its last places, so that the `f64` next to a crossing is among them, or by a relative
/// 1e-15 and more.
pub(in crate::methods::special) fn next_to(d: &mut Draw, x: f64, most: f64) -> f64 {
    if d.chance(0.5) {
        return (0..d.integer(0, 6))
            .fold(x.next_down().next_down().next_down(), |x, _| x.next_up());
    }
    let shift = d.log_uniform(1e-15, most);
    x + x * d.signed(shift)
}

/// A point of the lower half-plane next to a curve on which the component is zero.
pub(in crate::methods::special) fn beside_curve(d: &mut Draw, part: Part) -> Vec<f64> {
    let far = d.chance(0.25);
    let b = match far {
        true => d.log_uniform(20.0, 1e6),
        false => d.uniform(0.3, 20.0),
    };
    let a = match far {
        true => b + d.uniform(-300.0, 20.0) / (2.0 * b),
        false => d.uniform(0.0, b + 0.5),
    };
    // Where 2e^{-z^2} leads, a sign changes within a quarter of a turn of 2ab.
    let step = std::f64::consts::PI / (8.0 * b);
    let f = |x: f64| value(x, -b, part);
    let mut x = a;
    for _ in 0..6 {
        if let Some(c) = crossing(f, x, x + step) {
            let c = next_to(d, c, 1e-2);
            return vec![d.signed(c), -b];
        }
        x += step;
    }
    // No curve crosses here: the point itself.
    vec![d.signed(a), -b]
}

/// A point just below the real axis, next to the curve `e^{-x²} ≈ |y|/(√π x²)` on which Re W = 0.
pub(in crate::methods::special) fn beside_flat_curve(d: &mut Draw) -> Vec<f64> {
    let x = d.uniform(2.3, 26.5);
    let guess = std::f64::consts::PI.sqrt() * x * x * (-x * x).exp();
    let f = |y: f64| value(x, -y, Part::Re);
    let y = crossing(f, guess * 0.2, guess * 5.0).unwrap_or(guess);
    let y = next_to(d, y, 1e-1);
    vec![d.signed(x), -y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_lie_beside_the_curves() {
        let mut found = 0;
        for i in 0..100 {
            let mut d = Draw::new(1, "m", "r", i);
            for part in [Part::Re, Part::Im] {
                let z = beside_curve(&mut d, part);
                let (re, im) = (value(z[0], z[1], Part::Re), value(z[0], z[1], Part::Im));
                let (small, size) = match part {
                    Part::Re => (re, im),
                    Part::Im => (im, re),
                };
                found += usize::from(small.abs() < 0.3 * size.abs());
            }
            let z = beside_flat_curve(&mut d);
            let re = value(z[0], z[1], Part::Re);
            assert!(re.abs() < 0.2 * (-z[0] * z[0]).exp(), "{z:?} {re}");
        }
        assert!(found > 150, "{found}");
    }

    #[test]
    fn the_first_zero() {
        // DLMF table 7.13.1: erfc has its first zero at -1.3548101281 + 1.9914668428 i.
        let z = zero(1);
        assert!((z[0] - 1.991_466_842_8).abs() < 1e-9 && (z[1] + 1.354_810_128_1).abs() < 1e-9);
    }
}
