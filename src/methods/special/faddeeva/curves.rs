//! Points next to zeros of W and to the curves on which a component of W is zero.
//!
//! They are found with the reference, so that a case stays what it is when the solver changes.

use crate::audit::Draw;
use crate::methods::special::relatives::C;
use crate::reference::faddeeva::{w_f64, zero as certified};
use std::f64::consts::{FRAC_2_SQRT_PI, PI};
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

/// The direction of a line in the plane.
#[derive(Clone, Copy)]
pub(in crate::methods::special) enum Along {
    Re,
    Im,
}

/// Where a component of an analytic function f is zero on the line through `z`. A step goes to where it would be if
/// f went on as an exponential function, but no further than `most`, over which a component turns by a quarter or less;
/// a step whose square over `most` is less than a place of `f64` is the last. `f` gives value and derivative, the
/// derivative to a few digits. Nothing where eight steps do not get there, or get to an axis.
pub(in crate::methods::special) fn zero_on_line(
    f: impl Fn(C) -> Option<[C; 2]>,
    part: Part,
    along: Along,
    z: C,
    most: f64,
) -> Option<f64> {
    let (mut t, at): (f64, &dyn Fn(f64) -> C) = match along {
        Along::Re => (z.re, &|t| C::new(t, z.im)),
        Along::Im => (z.im, &|t| C::new(z.re, t)),
    };
    for _ in 0..8 {
        let [value, slope] = f(at(t))?;
        let slope = match along {
            Along::Re => slope,
            Along::Im => C::i() * slope,
        };
        // From where the argument of f is to where the component is zero.
        let turn = match part {
            Part::Re => libm::atan(value.re / value.im),
            Part::Im => -libm::atan(value.im / value.re),
        };
        let step = turn / (slope / value).im;
        if step.is_nan() {
            return None;
        }
        t += step.clamp(-most, most);
        if step * step <= f64::EPSILON / 16.0 * t.abs() * most {
            // On an axis a component is zero by symmetry.
            return (t.abs() > most / 4.0).then_some(t);
        }
    }
    None
}

/// W with proved components and its derivative −2zW + 2i/√π (DLMF 7.10.2), roughly. More bits would cost a
/// second evaluation next to zeros.
fn w_and_slope(z: C) -> Option<[C; 2]> {
    let w = w_f64(z.re, z.im, 30).ok()?;
    let w = C::new(w.re.to_f64(), w.im.to_f64());
    Some([w, C::new(0.0, FRAC_2_SQRT_PI) - 2.0 * z * w])
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

/// A point of the lower half-plane next to a curve on which the component is zero; where none is found, the point
/// that it was looked for from.
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
    // Where 2e^{-z^2} leads, a component turns like cos 2ab.
    let turn = PI / (4.0 * b);
    let x = match zero_on_line(w_and_slope, part, Along::Re, C::new(a, -b), turn) {
        Some(x) => next_to(d, x, 1e-2),
        None => a,
    };
    vec![d.signed(x), -b]
}

/// A point just below the real axis, next to the curve `e^{-x²} ≈ |y|/(√π x²)` on which Re W = 0.
pub(in crate::methods::special) fn beside_flat_curve(d: &mut Draw) -> Vec<f64> {
    let x = d.uniform(2.3, 26.5);
    let guess = PI.sqrt() * x * x * libm::exp(-x * x);
    let z = C::new(x, -guess);
    let y = zero_on_line(w_and_slope, Part::Re, Along::Im, z, guess / 2.0).map_or(guess, |y| -y);
    let y = next_to(d, y, 1e-1);
    vec![d.signed(x), -y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn component(x: f64, y: f64, part: Part) -> f64 {
        let w = w_f64(x, y, 30).unwrap();
        match part {
            Part::Re => w.re.to_f64(),
            Part::Im => w.im.to_f64(),
        }
    }

    /// Of 100 lines parallel to the real axis at least 90 meet a curve, and a component changes its sign within two
    /// places of where they do.
    #[test]
    fn zeros_on_lines_are_those_of_f64() {
        for part in [Part::Re, Part::Im] {
            let mut found = 0;
            for i in 0..100 {
                let mut d = Draw::new(2, "m", "r", i);
                let b = d.log_uniform(0.5, 1e4);
                let z = C::new(b * (1.0 - d.unit() * (20.0 / (b * b)).min(0.9)), -b);
                let turn = PI / (4.0 * b);
                let Some(x) = zero_on_line(w_and_slope, part, Along::Re, z, turn) else {
                    continue;
                };
                let ends = [x.next_down().next_down(), x.next_up().next_up()];
                let [p, q] = ends.map(|x| component(x, -b, part));
                assert!(p * q <= 0.0, "{x:e} {b:e}: {p:e} {q:e}");
                found += 1;
            }
            assert!(found >= 90, "{found}");
        }
    }

    #[test]
    fn the_points_lie_beside_the_curves() {
        let mut found = 0;
        for i in 0..100 {
            let mut d = Draw::new(1, "m", "r", i);
            for part in [Part::Re, Part::Im] {
                let z = beside_curve(&mut d, part);
                let [re, im] = [Part::Re, Part::Im].map(|p| component(z[0], z[1], p));
                let (small, size) = match part {
                    Part::Re => (re, im),
                    Part::Im => (im, re),
                };
                found += usize::from(small.abs() < 0.3 * size.abs());
            }
            let z = beside_flat_curve(&mut d);
            let re = component(z[0], z[1], Part::Re);
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
