//! The four-bar linkage: crank and RRR dyad.

use super::error::DyadError;
use super::motion::{Assembly, LinkMotion, PointMotion};
use super::numeric::{check_lengths, scale};
use super::rows::{self, Rows};
use super::rrr::{Kernel, Span, check_finite, joint_motion, link, solve_span};
use crate::arctangent;
use crate::double_double::{Dd, sign_of_sum};
use crate::real::{Masked, ROUND};
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
        let [a, b, c, _] = self.scaled();
        let Moved {
            kernel: k,
            angles: [phi2, phi3],
            gamma,
            crank: [cos, sin],
        } = rows::at(self, phi, assembly);
        k.check([b, c], self.exponent)?;
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
            transmission: Angle::from_rad(gamma),
            determinant_m2,
        })
    }
}

/// A position in scaled lengths.
pub(super) struct Moved<R> {
    kernel: Kernel<R>,
    /// Of coupler and rocker.
    angles: [R; 2],
    gamma: R,
    /// Cosine and sine of the crank angle.
    crank: [R; 2],
}

impl Rows for FourBar {
    type Moved<R> = Moved<R>;

    #[inline(always)]
    fn moved<R: Masked>(&self, phi: R, (sin, cos): (R, R), s: f64) -> Moved<R> {
        let like = |v: f64| phi.like(v);
        let [a, b, c, d] = self.scaled();
        let crank = [like(a) * cos, like(a) * sin];
        let x = like(-a).fma(cos, like(d));
        let span = Span {
            d: [x, -crank[1]],
            d1: if a <= d {
                [crank[1], -crank[0]]
            } else {
                [like(0.0), like(-d)]
            },
            d2: if a <= d { crank } else { [like(-d), like(0.0)] },
            // D·D' = a d sin φ1 in both frames.
            radial: Some([
                like(a * d) * sin,
                if a <= d {
                    like(a) * like(d).fma(cos, like(-a))
                } else {
                    like(-d) * x
                },
            ]),
        };
        let mut kernel = solve_span(&span, [b, c], s);
        if a > d {
            kernel.rates2[0] = kernel.rates2[0] + like(1.0);
            kernel.rates3[0] = kernel.rates3[0] + like(1.0);
        }
        let s = like(s);
        let angles = if a <= d {
            let theta = arctangent::angle(span.d[1], span.d[0]);
            [
                s.fma(kernel.alpha.angle(), theta),
                s.fma(kernel.beta.supplement(), theta),
            ]
        } else {
            let principal = arctangent::angle(-span.d[1], -span.d[0]);
            let turns = (phi - principal).fma(like(1.0 / TAU), like(ROUND)) - like(ROUND);
            let eta = turns.fma(like(TAU), principal) + turns * like(2.0 * Dd::PI.lo);
            [
                (-s).fma(kernel.alpha.supplement(), eta),
                (-s).fma(kernel.beta.angle(), eta),
            ]
        };
        let gamma = kernel.gamma.angle();
        Moved {
            kernel,
            angles,
            gamma,
            crank: [cos, sin],
        }
    }

    #[inline(always)]
    fn row<R: Masked>(&self, m: &Moved<R>) -> ([R; 8], R::Mask) {
        let k = &m.kernel;
        let row = [
            m.angles[0],
            m.angles[1],
            k.rates2[0],
            k.rates3[0],
            k.rates2[1],
            k.rates3[1],
            m.gamma,
            scale(k.determinant, 2 * self.exponent),
        ];
        // Not so where it is no number: the links do not reach.
        let zero = k.determinant.like(0.0);
        (row, zero.below(k.determinant.magnitude()))
    }

    #[inline(always)]
    fn relative<R: Masked>(&self, phi: R) -> R {
        phi
    }
}
