//! The four-bar linkage: crank and RRR dyad.

use super::error::DyadError;
use super::motion::{Assembly, LinkMotion, PointMotion};
use super::numeric::{check_lengths, scale};
use super::rrr::{Span, check_finite, joint_motion, link, solve_span};
use crate::double_double::{Dd, sign_of_sum};
use crate::units::{Angle, Length};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A four-bar linkage: crank `a` about the origin `O`, coupler `b`, rocker `c` about the point
/// `(d, 0)`, frame `d`. The crank angle φ1 counts from the x-axis, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar {
    crank: Length,
    coupler: Length,
    rocker: Length,
    frame: Length,
    exponent: i32,
}

/// Position and derivatives with respect to the crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBarMotion {
    /// The joint of coupler and rocker.
    pub joint: PointMotion,
    /// The coupler, from the crank to the joint; the angle is continuous, see
    /// [`FourBar::position`].
    pub coupler: LinkMotion,
    /// The rocker, from its pivot to the joint; the angle is continuous.
    pub rocker: LinkMotion,
    /// The angle between coupler and rocker, in `(0, π)`.
    pub transmission: Angle,
    /// The determinant of the velocity equations, `b c sin(φ3 − φ2)`, in m².
    pub determinant_m2: f64,
}

impl FourBarMotion {
    /// The pressure angle `|π/2 − transmission|`.
    pub fn pressure_angle(&self) -> Angle {
        Angle::from_rad((FRAC_PI_2 - self.transmission.rad()).abs())
    }
}

impl FourBar {
    /// A linkage with the given lengths.
    ///
    /// # Errors
    /// [`DyadError::NotFinite`], [`DyadError::NotPositive`], [`DyadError::LengthRatio`], and
    /// [`DyadError::CannotClose`] where one length is not shorter than the other three together.
    pub fn new(
        crank: Length,
        coupler: Length,
        rocker: Length,
        frame: Length,
    ) -> Result<FourBar, DyadError> {
        let named = [
            ("crank", crank),
            ("coupler", coupler),
            ("rocker", rocker),
            ("frame", frame),
        ];
        let exponent = check_lengths(&named, &[])?;
        let bar = FourBar {
            crank,
            coupler,
            rocker,
            frame,
            exponent,
        };
        let l = bar.scaled();
        for i in 0..4 {
            let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4].map(|j| l[j]);
            if sign_of_sum(&[l[i], -others[0], -others[1], -others[2]]) >= 0.0 {
                return Err(DyadError::CannotClose {
                    what: named[i].0,
                    longest_m: named[i].1.m(),
                    others_m: scale(others.iter().sum(), exponent),
                });
            }
        }
        Ok(bar)
    }

    /// The length of the crank.
    pub fn crank(&self) -> Length {
        self.crank
    }

    /// The length of the coupler.
    pub fn coupler(&self) -> Length {
        self.coupler
    }

    /// The length of the rocker.
    pub fn rocker(&self) -> Length {
        self.rocker
    }

    /// The distance of the fixed pivots.
    pub fn frame(&self) -> Length {
        self.frame
    }

    /// Crank, coupler, rocker and frame times a power of two, the longest in `[1, 2)`.
    pub(super) fn scaled(&self) -> [f64; 4] {
        [self.crank, self.coupler, self.rocker, self.frame].map(|l| scale(l.m(), -self.exponent))
    }

    /// Position and derivatives at the crank angle φ1.
    ///
    /// With `e_i = (cos φi, sin φi)` the loop equation is `a e1 + b e2 = (d, 0) + c e3`; the dyad
    /// spans `D = (d, 0) − a e1`, with `D' = −a e1⊥` and `D'' = a e1`, in (2) to (4). For `a > d`
    /// the same equations are used in axes that turn with the crank, where only the frame moves,
    /// `D' = (0, −d)` and `D'' = (−d, 0)`, and `φ'` is one more than the rate found: with crank
    /// and rocker long and nearly equal the terms of (3) would cancel in fixed axes.
    ///
    /// # Which angle
    /// Coupler and rocker angles are continuous in φ1 over the whole real line where the crank
    /// turns fully, so they are not reduced to one turn. With the angles α, β of the triangle at
    /// the crank's end and at the rocker's pivot and the assembly's sign s:
    ///
    /// ```text
    /// a ≤ d:  φ2 = θ + s α,        φ3 = θ + s (π − β),   θ = arg D in [−π/2, π/2]           (5)
    /// a > d:  φ2 = η − s (π − α),  φ3 = η − s β,         η = arg(−D) in (φ1 − π/2, φ1 + π/2) (6)
    /// ```
    ///
    /// In both `φ3 − φ2 = s γ` with the transmission angle γ.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::{Assembly, FourBar};
    /// use mechaudit_solvers::units::{Angle, Length};
    /// // A parallelogram: the coupler stays parallel to the frame. The other assembly is the
    /// // antiparallelogram.
    /// let [a, b] = [0.2, 0.5].map(Length::from_m);
    /// let m = FourBar::new(a, b, a, b)?.position(Angle::from_deg(60.0), Assembly::Positive)?;
    /// assert!(m.coupler.angle.rad().abs() < 1e-15);
    /// assert!((m.rocker.angle.deg() - 60.0).abs() < 1e-13);
    /// assert!((m.rocker.first - 1.0).abs() < 1e-14);
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    ///
    /// # Errors
    /// [`DyadError::Unreachable`], [`DyadError::Singular`], [`DyadError::NotFinite`],
    /// [`DyadError::Overflow`].
    pub fn position(&self, phi1: Angle, assembly: Assembly) -> Result<FourBarMotion, DyadError> {
        let phi = phi1.rad();
        if !phi.is_finite() {
            return Err(DyadError::NotFinite {
                what: "crank angle",
                value: phi,
            });
        }
        let [a, b, c, d] = self.scaled();
        let (sin, cos) = phi.sin_cos();
        let x = d - a * cos;
        let span = Span {
            d: [x, -a * sin],
            d1: if a <= d {
                [a * sin, -a * cos]
            } else {
                [0.0, -d]
            },
            d2: if a <= d {
                [a * cos, a * sin]
            } else {
                [-d, 0.0]
            },
            // D·D' = a d sin φ1 in both frames.
            radial: Some([a * d * sin, if a <= d { a * (d * cos - a) } else { -d * x }]),
        };
        let mut k = solve_span(&span, b, c, assembly, self.exponent)?;
        if a > d {
            k.rates2[0] += 1.0;
            k.rates3[0] += 1.0;
        }
        let s = assembly.sign();
        let (phi2, phi3) = if a <= d {
            let theta = span.d[1].atan2(span.d[0]);
            (theta + s * k.alpha.angle(), theta + s * k.beta.supplement())
        } else {
            let principal = (-span.d[1]).atan2(-span.d[0]);
            let turns = ((phi - principal) / TAU).round();
            let eta = (principal + turns * TAU) + turns * (2.0 * Dd::PI.lo);
            (eta - s * k.alpha.supplement(), eta - s * k.beta.angle())
        };
        let m = |v: f64| scale(v, self.exponent);
        let crank_end = PointMotion {
            position_m: [m(a * cos), m(a * sin)],
            first_m: [m(-a * sin), m(a * cos)],
            second_m: [m(-a * cos), m(-a * sin)],
        };
        let joint = joint_motion(&crank_end, self.coupler.m(), k.e2, k.rates2);
        let determinant_m2 = scale(k.determinant, 2 * self.exponent);
        check_finite(&joint, &[k.rates2, k.rates3], determinant_m2)?;
        Ok(FourBarMotion {
            joint,
            coupler: link(phi2, k.rates2),
            rocker: link(phi3, k.rates3),
            transmission: Angle::from_rad(k.gamma),
            determinant_m2,
        })
    }
}
