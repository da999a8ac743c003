//! The SCCA family: sine, constant, cosine acceleration.
//!
//! On the accelerating half, `0 ≤ x ≤ 1/2`, with `b + c + d = 1`:
//!
//! ```text
//! s'' = C_a sin(πx/b)                    x ≤ b/2
//! s'' = C_a                              b/2 ≤ x ≤ (1 − d)/2
//! s'' = C_a cos(π(x − (1 − d)/2)/d)      (1 − d)/2 ≤ x
//! ```

use super::error::{CamLawError, finite};
use super::motion::{Motion, Peaks, factor, times};
use crate::double_double::{Dd, sign_of_sum, two_prod, two_sum};
use crate::hex::hex;
use std::f64::consts::PI;

/// `b + c + d` may differ from one by this much: each was rounded once.
const SUM_TOLERANCE: f64 = 4.0 * f64::EPSILON;

/// `(π − 2)/(2π²)`.
const SINE_PART: Dd = Dd::new(hex("0x1.d9c62f2e193cbp-5"), hex("0x1.3a950143f6642p-60"));
/// `1/π²`.
const COSINE_PART: Dd = Dd::new(hex("0x1.9f02f6222c72p-4"), hex("-0x1.24a918f92ba3dp-58"));
/// `1/π`.
const INV_PI: Dd = Dd::new(std::f64::consts::FRAC_1_PI, hex("-0x1.6b01ec5417056p-56"));

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scca {
    pub(crate) b: f64,
    pub(crate) c: f64,
    pub(crate) d: f64,
    /// C_a.
    pub(crate) acceleration: f64,
    sine: Part,
    cosine: Part,
}

/// A sine or a cosine over a share of the stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    /// π by the share: radians for a length on the stroke.
    frequency: Dd,
    /// C_a times that: the largest jerk.
    jerk: Dd,
}

impl Part {
    fn new(share: f64, acceleration: Dd) -> Part {
        let frequency = Dd::PI.div(Dd::from(share));
        let jerk = frequency * acceleration;
        Part {
            frequency: factor(frequency),
            jerk: factor(jerk),
        }
    }
}

/// A place in a half of the stroke: how far it is from the stroke's end and how long the half is,
/// exactly, and where it is in the symmetric law: `0 ≤ y ≤ 1/2`, rounded, and `left = 1 − 2y`.
pub(super) struct Place {
    pub distance: Dd,
    pub share: Dd,
    pub y: f64,
    pub left: f64,
}

impl Place {
    /// The sign of `2y − part`, of the numbers as they are: a jerk that vanishes on one side of a
    /// joint and is rounded on the other would be wrong by more than its condition.
    fn beyond(&self, part: Dd) -> f64 {
        let rough = 2.0 * self.y - part.hi;
        if rough.abs() > 1e-14 {
            return rough;
        }
        let Place {
            distance, share, ..
        } = self;
        let [p, q, r, s] = [
            two_prod(-share.hi, part.hi),
            two_prod(-share.hi, part.lo),
            two_prod(-share.lo, part.hi),
            two_prod(-share.lo, part.lo),
        ];
        sign_of_sum(&[
            distance.hi,
            distance.lo,
            p.hi,
            p.lo,
            q.hi,
            q.lo,
            r.hi,
            r.lo,
            s.hi,
            s.lo,
        ])
    }
}

/// `x − sin x` for `0 ≤ x ≤ π/2`, by its Taylor series.
fn x_minus_sin(x: f64) -> f64 {
    let y = x * x;
    let divisors = [342.0, 272.0, 210.0, 156.0, 110.0, 72.0, 42.0, 20.0];
    let tail = divisors.iter().fold(1.0, |sum, d| 1.0 - y / d * sum);
    x * y / 6.0 * tail
}

impl Scca {
    pub(super) fn new(b: f64, c: f64, d: f64) -> Result<Scca, CamLawError> {
        for (name, value) in [("b", b), ("c", c), ("d", d)] {
            if finite(name, value)? < 0.0 {
                return Err(CamLawError::Negative { name, value });
            }
        }
        let sum = b + c + d;
        if !((sum - 1.0).abs() <= SUM_TOLERANCE) {
            return Err(CamLawError::PartsSum { sum });
        }
        // The constant part takes up what rounding left; without one, the shorter other part.
        let (long, short) = if b > d { (b, d) } else { (d, b) };
        let rest = (1.0 - long) - short;
        let (b, c, d) = match (c > 0.0 && rest >= 0.0, b > d) {
            (true, _) => (b, rest, d),
            (false, true) => (b, 0.0, 1.0 - b),
            (false, false) => (1.0 - d, 0.0, d),
        };
        // s(1/2)/C_a, all terms positive; in double-double, because C_a is a factor of everything.
        let v = INV_PI.mul_f(b);
        let sine = SINE_PART * two_prod(b, b) + v.mul_f(0.5 * c);
        let constant = two_prod(c, c).scale(0.125) + v.add_f(0.5 * c).mul_f(0.5 * d);
        let middle = sine + constant + COSINE_PART * two_prod(d, d);
        Ok(Scca::scaled(b, c, d, Dd::from(0.5).div(middle)))
    }

    fn scaled(b: f64, c: f64, d: f64, acceleration: Dd) -> Scca {
        Scca {
            b,
            c,
            d,
            acceleration: acceleration.value(),
            sine: Part::new(b, acceleration),
            cosine: Part::new(d, acceleration),
        }
    }

    /// `y − (1 − d)/2`, the difference exact.
    fn depth_in_cosine(&self, y: f64, left: f64) -> f64 {
        if self.d >= 0.5 {
            y - 0.5 * (1.0 - self.d)
        } else {
            0.5 * (self.d - left)
        }
    }

    /// `b/2 − y`, the difference exact.
    fn left_of_sine(&self, y: f64, left: f64) -> f64 {
        if self.b >= 0.5 {
            0.5 * (left - (1.0 - self.b))
        } else {
            0.5 * self.b - y
        }
    }

    /// The accelerating half.
    pub(super) fn half(&self, place: &Place) -> Motion {
        let (b, c, d) = (self.b, self.c, self.d);
        let (y, left) = (place.y, place.left);
        let normalised = if place.beyond(Dd::from(b)) < 0.0 {
            let phi = times(y, self.sine.frequency);
            let half_sine = (0.5 * phi).sin();
            let rest = times(self.left_of_sine(y, left), self.sine.frequency);
            Motion {
                displacement: (b / PI) * (b / PI) * x_minus_sin(phi),
                velocity: b / PI * (2.0 * half_sine * half_sine),
                acceleration: phi.sin(),
                jerk: times(rest.sin(), self.sine.jerk),
            }
        } else {
            let (s1, v1) = (b * b * SINE_PART.hi, b / PI);
            if place.beyond(two_sum(1.0, -d)) > 0.0 {
                let t = self.depth_in_cosine(y, left);
                let (s2, v2) = (s1 + 0.5 * c * (v1 + 0.25 * c), v1 + 0.5 * c);
                let phi = times(t, self.cosine.frequency);
                let half_sine = (0.5 * phi).sin();
                // From the middle of the stroke, where the acceleration vanishes.
                let rest = times(0.5 * left, self.cosine.frequency);
                Motion {
                    displacement: s2 + v2 * t + (d / PI) * (d / PI) * (2.0 * half_sine * half_sine),
                    velocity: v2 + d / PI * phi.sin(),
                    acceleration: if rest < phi { rest.sin() } else { phi.cos() },
                    jerk: -times(phi.sin(), self.cosine.jerk),
                }
            } else {
                let t = y - 0.5 * b;
                Motion {
                    displacement: s1 + t * (v1 + 0.5 * t),
                    velocity: v1 + t,
                    acceleration: 1.0,
                    jerk: 0.0,
                }
            }
        };
        Motion {
            jerk: normalised.jerk,
            ..normalised.scaled(self.acceleration)
        }
    }

    /// `1/2 − s` at `r` before the middle: what each part from there on adds.
    pub(super) fn until_middle(&self, r: f64) -> f64 {
        let (b, c, d) = (self.b, self.c, self.d);
        let (v1, v2) = (b / PI, b / PI + 0.5 * c);
        let mut sum = 0.0;
        let cosine = r.min(0.5 * d);
        if cosine > 0.0 {
            let phi = times(cosine, self.cosine.frequency);
            sum += v2 * cosine + (d / PI) * (d / PI) * phi.sin();
        }
        let constant = (r - 0.5 * d).clamp(0.0, 0.5 * c);
        sum += constant * (v2 - 0.5 * constant);
        let sine = (r - 0.5 * (c + d)).clamp(0.0, 0.5 * b);
        if sine > 0.0 {
            let half = (0.5 * times(sine, self.sine.frequency)).sin();
            sum += v1 * (sine - v1 * (2.0 * half * half));
        }
        self.acceleration * sum
    }

    /// `∫ s dx` over the accelerating half, all terms positive.
    pub(crate) fn half_mean(&self) -> f64 {
        let (b, c, d) = (self.b, self.c, self.d);
        let (s1, v1) = (b * b * SINE_PART.hi, b / PI);
        let (t, u) = (0.5 * c, 0.5 * d);
        let (s2, v2) = (s1 + t * (v1 + 0.5 * t), v1 + t);
        let sine = (b / PI).powi(3) * (PI * PI / 8.0 - 1.0);
        let constant = t * (s1 + t * (0.5 * v1 + t / 6.0));
        let cosine = u * (s2 + 0.5 * u * v2) + (d / PI).powi(3) * (0.5 * PI - 1.0);
        self.acceleration * (sine + constant + cosine)
    }

    pub(super) fn peaks(&self) -> Peaks {
        let ca = self.acceleration;
        let part = |width: f64| match width > 0.0 {
            true => ca * PI / width,
            false => f64::INFINITY,
        };
        Peaks {
            velocity: ca * (self.b / PI + 0.5 * self.c + self.d / PI),
            acceleration: ca,
            deceleration: ca,
            jerk: part(self.b).max(part(self.d)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(d: f64) -> Scca {
        Scca::scaled(0.0, 1.0 - d, d, Dd::from(1.0))
    }

    fn at(y: f64) -> Place {
        Place {
            distance: Dd::from(y),
            share: Dd::from(0.5),
            y,
            left: 1.0 - 2.0 * y,
        }
    }

    /// `2y > 1 − d` of the numbers as they are: where the difference of either pair is exact the
    /// other is not, and would say the opposite here.
    #[test]
    fn where_the_cosine_begins() {
        let in_cosine = |d: f64, y: f64| at(y).beyond(two_sum(1.0, -d)) > 0.0;
        for (d, y) in [
            (0.1, 0.45),
            (0.2, 0.4),
            (0.09, 0.455),
            (0.7, 0.150_000_000_000_000_05),
            (0.51, 0.245_000_000_000_000_02),
        ] {
            assert!(in_cosine(d, y), "{d} {y}");
            assert!(!in_cosine(d, y.next_down()), "{d} {y}");
        }
        // The place itself belongs to the part before.
        for (d, y) in [(0.75, 0.125), (0.25, 0.375), (0.5, 0.25)] {
            assert!(!in_cosine(d, y) && in_cosine(d, y.next_up()));
        }
    }

    /// The half is shorter than 1/2 by an ulp, so that the place lies beyond the sine by less than
    /// y can say.
    #[test]
    fn a_joint_of_an_asymmetric_law() {
        let law = crate::cam_law::MotionLaw::scca(0.625, 0.25, 0.125).expect("a law");
        let law = law.with_acceleration_fraction(0.5f64.next_down());
        let law = law.expect("a share");
        assert_eq!(law.motion(0.3125).expect("a motion").jerk, 0.0);
        let before = law.motion(0.3125f64.next_down()).expect("a motion").jerk;
        assert!(before > 0.0 && before < 1e-12, "{before:e}");
    }

    /// `y − (1 − d)/2` of the numbers as they are, in rational arithmetic.
    #[test]
    fn how_deep_in_the_cosine() {
        for (d, y, due) in [
            (0.6, 0.21, 0.009_999_999_999_999_981),
            (0.6, 0.22, 0.019_999_999_999_999_99),
            (0.1, 0.5, 0.05),
            (0.1, 0.46, 0.010_000_000_000_000_023),
        ] {
            assert_eq!(with(d).depth_in_cosine(y, 1.0 - 2.0 * y), due, "{d} {y}");
        }
    }

    /// A cosine without width makes the jerk infinite, whatever the sign of its zero.
    #[test]
    fn a_part_without_width() {
        for (b, d) in [(0.0, 0.5), (-0.0, 0.5), (0.5, 0.0), (0.5, -0.0)] {
            let law = Scca::new(b, 0.5, d).expect("a law");
            assert_eq!(law.peaks().jerk, f64::INFINITY, "{b} {d}");
        }
    }
}
