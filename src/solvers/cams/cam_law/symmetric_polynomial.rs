//! The 3-4-5 and 4-5-6-7 polynomials: `s' ∝ (x(1 − x))^(k−1)` with `k` = 3, 4.

use super::motion::{Motion, Peaks};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SymmetricPolynomial {
    Degree5,
    Degree7,
}

impl SymmetricPolynomial {
    /// The stroke on `0 ≤ x ≤ 1/2`, with `left = 1 − 2x`; `s` as a sum of positive terms.
    pub(super) fn half(self, x: f64, left: f64) -> Motion {
        let z = 1.0 - x;
        // xz = (1 − left²)/4, and 1 − kxz likewise: each of them as it is rounded less.
        let square = left * left;
        let outer = x < 0.25;
        let p = match outer {
            true => x * z,
            false => 0.25 * (1.0 - square),
        };
        let jerk = |k: f64| match outer {
            true => 1.0 - k * p,
            false => 0.25 * k * square - (0.25 * k - 1.0),
        };
        match self {
            SymmetricPolynomial::Degree5 => Motion {
                displacement: x * x * x * (10.0 * z * z + x * (5.0 * z + x)),
                velocity: 30.0 * p * p,
                acceleration: 60.0 * p * left,
                jerk: 60.0 * jerk(6.0),
            },
            SymmetricPolynomial::Degree7 => {
                let bernstein = 35.0 * z * z * z + x * (21.0 * z * z + x * (7.0 * z + x));
                Motion {
                    displacement: (x * x) * (x * x) * bernstein,
                    velocity: 140.0 * p * p * p,
                    acceleration: 420.0 * p * p * left,
                    jerk: 840.0 * p * jerk(5.0),
                }
            }
        }
    }

    /// `1/2 − s` at `r` before the middle.
    pub(super) fn until_middle(self, r: f64) -> f64 {
        let q = r * r;
        r * match self {
            SymmetricPolynomial::Degree5 => 1.875 - q * (5.0 - 6.0 * q),
            SymmetricPolynomial::Degree7 => 2.1875 - q * (8.75 - q * (21.0 - 20.0 * q)),
        }
    }

    pub(super) fn peaks(self) -> Peaks {
        let (velocity, acceleration, jerk) = match self {
            SymmetricPolynomial::Degree5 => (1.875, 10.0 / 3f64.sqrt(), 60.0),
            SymmetricPolynomial::Degree7 => (2.1875, 84.0 / 25.0 * 5f64.sqrt(), 52.5),
        };
        Peaks {
            velocity,
            acceleration,
            deceleration: acceleration,
            jerk,
        }
    }

    /// `∫ s dx` over the accelerating half.
    pub(crate) fn half_mean(self) -> f64 {
        match self {
            SymmetricPolynomial::Degree5 => 5.0 / 64.0,
            SymmetricPolynomial::Degree7 => 35.0 / 512.0,
        }
    }

    /// Derivatives of orders 1, 2, … at the start of the stroke.
    pub(crate) fn at_start(self) -> &'static [f64] {
        match self {
            SymmetricPolynomial::Degree5 => &[0.0, 0.0, 60.0, -360.0, 720.0],
            SymmetricPolynomial::Degree7 => {
                &[0.0, 0.0, 0.0, 840.0, -10_080.0, 50_400.0, -100_800.0]
            }
        }
    }

    /// Derivatives of orders 1, 2, … in the middle of the stroke.
    pub(crate) fn in_middle(self) -> &'static [f64] {
        match self {
            SymmetricPolynomial::Degree5 => &[1.875, 0.0, -30.0, 0.0, 720.0],
            SymmetricPolynomial::Degree7 => &[2.1875, 0.0, -52.5, 0.0, 2_520.0, 0.0, -100_800.0],
        }
    }
}
