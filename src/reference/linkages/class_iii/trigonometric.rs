//! All zeros of a real trigonometric polynomial `T(θ) = c_0 + 2 Re Σ c_k e^{ikθ}` of degree 3.
//!
//! On an interval of half-width r about m, Taylor's theorem with `|T''| ≤ L = 2 Σ k² |c_k|` gives
//!
//! * no zero if `|T(m)| > |T'(m)| r + L r²/2`,
//! * at most one zero if `|T'(m)| > L r`, and then one exactly if T changes sign.
//!
//! Intervals that show neither are halved.

use crate::{Ball, ComplexBall, Mag, Undecided};
use rug::Float;

/// T.
pub(super) struct Trigonometric {
    bits: u32,
    /// `c_0 … c_3`.
    c: Vec<ComplexBall>,
    /// Bound on |T''|, and on |T'|, since `k ≤ k²`.
    curvature: Mag,
}

/// The largest number of zeros that an interval can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Zeros {
    None,
    AtMostOne,
    Unknown,
}

/// By T and T' in the middle of an interval of half-width r.
fn zeros_within(t: &Ball, slope: &Ball, curvature: Mag, r: Mag) -> Zeros {
    let reach = slope.magnitude().mul(r);
    let bend = curvature.mul(r);
    if t.mignitude() > reach.add(bend.mul(r).shift(-1)) {
        Zeros::None
    } else if slope.mignitude() > bend {
        Zeros::AtMostOne
    } else {
        Zeros::Unknown
    }
}

/// The larger part of an interval to either side of a point in it.
fn half_width(lo: &Float, mid: &Float, hi: &Float) -> Mag {
    let [lo, mid, hi] = [lo, mid, hi].map(|x| Ball::new(x.clone(), Mag::ZERO));
    (&hi - &mid).magnitude().max((&mid - &lo).magnitude())
}

/// Returns whether T changes sign between two values of it; nothing where one cannot be told from
/// zero.
fn changes_sign(a: &Ball, b: &Ball) -> Option<bool> {
    let told = |x: &Ball| x.is_positive() || x.is_negative();
    (told(a) && told(b)).then(|| a.is_positive() != b.is_positive())
}

/// Steps towards a zero, at most.
const ROUNDS: u32 = 200;

/// 2⁻⁵⁰: from so near the position itself goes on.
const NEAR: f64 = 4.0 * f64::EPSILON;

const ON_A_CUT: &str = "a zero of the resultant lies on a cut";

impl Trigonometric {
    pub(super) fn new(bits: u32, c: Vec<ComplexBall>) -> Trigonometric {
        let term = |(k, x): (usize, &ComplexBall)| {
            let size = x.re.magnitude().add(x.im.magnitude());
            size.mul(Mag::from_f64((2 * k * k) as f64))
        };
        let curvature = c.iter().enumerate().map(term).fold(Mag::ZERO, Mag::add);
        Trigonometric { bits, c, curvature }
    }

    pub(super) fn bits(&self) -> u32 {
        self.bits
    }

    pub(super) fn with_prec(&self, bits: u32) -> Trigonometric {
        let c = |x: &ComplexBall| ComplexBall::new(x.re.with_prec(bits), x.im.with_prec(bits));
        Trigonometric::new(bits, self.c.iter().map(c).collect())
    }

    fn undecided(&self, reason: &str) -> Undecided {
        Undecided::new(self.bits, reason)
    }

    /// `(T, T')` at an exact angle.
    fn value(&self, theta: &Float) -> (Ball, Ball) {
        let tau = ComplexBall::unit(&Ball::new(theta.clone(), Mag::ZERO).with_prec(self.bits));
        let mut power = tau.clone();
        let mut t = self.c[0].re.clone();
        let mut d = Ball::integer(self.bits, 0);
        for k in 1..=3 {
            let term = &self.c[k] * &power;
            t = t + term.re.shift(1);
            d = d - (&term.im * &Ball::integer(self.bits, 2 * k as i64));
            power = &power * &tau;
        }
        (t, d)
    }

    /// Returns whether T certainly has no zero within `gap` of an angle.
    fn keeps_its_sign(&self, theta: &Float, gap: &Ball) -> bool {
        self.value(theta).0.mignitude() > self.curvature.mul(gap.magnitude())
    }

    /// Disjoint intervals with exactly one zero of T each; together they hold all zeros.
    pub(super) fn isolate(&self) -> Result<Vec<(Float, Float)>, Undecided> {
        // A whole turn cut at odd places, so that a zero on a cut is unlikely.
        let parts = 12;
        let cut = |k: u32| {
            let turn = Float::with_val(self.bits, rug::float::Constant::Pi) << 1u32;
            turn * k / parts - 2.71875
        };
        let mut open: Vec<_> = (0..parts).map(|k| (cut(k), cut(k + 1), 0)).collect();
        // The turn is closed by an overlap so small that the first interval's lower end, moved
        // down by it, decides nothing new: T keeps its sign there or the case is undecided.
        let ends = [cut(parts), cut(0)].map(|x| Ball::new(x, Mag::ZERO));
        let gap = Ball::pi(self.bits).shift(1) - &(&ends[0] - &ends[1]);
        if !self.keeps_its_sign(&cut(0), &gap) {
            return Err(self.undecided(ON_A_CUT));
        }
        let deepest = self.bits / 2;
        let mut found = Vec::new();
        while let Some((lo, hi, depth)) = open.pop() {
            let mid = Float::with_val(self.bits, &lo + &hi) >> 1u32;
            let (t, slope) = self.value(&mid);
            match zeros_within(&t, &slope, self.curvature, half_width(&lo, &mid, &hi)) {
                Zeros::None => {}
                Zeros::AtMostOne => match changes_sign(&self.value(&lo).0, &self.value(&hi).0) {
                    Some(true) => found.push((lo, hi)),
                    Some(false) => {}
                    None => return Err(self.undecided(ON_A_CUT)),
                },
                Zeros::Unknown if depth == deepest => {
                    return Err(self.undecided("two assembly modes are too close to tell apart"));
                }
                Zeros::Unknown => {
                    open.push((lo, mid.clone(), depth + 1));
                    open.push((mid, hi, depth + 1));
                }
            }
        }
        Ok(found)
    }

    /// An approximate zero in an isolating interval.
    pub(super) fn approximate(&self, lo: &Float, hi: &Float) -> Float {
        let (mut lo, mut hi) = (lo.clone(), hi.clone());
        let rising = self.value(&lo).0.is_negative();
        let mut x = Float::with_val(self.bits, &lo + &hi) >> 1u32;
        for _ in 0..ROUNDS {
            let (t, d) = self.value(&x);
            if t.mid().is_zero() {
                return x;
            }
            if t.mid().is_sign_negative() == rising {
                lo.clone_from(&x);
            } else {
                hi.clone_from(&x);
            }
            let step = Float::with_val(self.bits, t.mid() / d.mid());
            let mut next = Float::with_val(self.bits, &x - &step);
            if !(next > lo && next < hi) {
                next = Float::with_val(self.bits, &lo + &hi) >> 1u32;
            }
            let moved = Float::with_val(self.bits, &next - &x).to_f64();
            x = next;
            if moved.abs() <= NEAR {
                break;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests;
