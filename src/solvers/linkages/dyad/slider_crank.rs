//! The slider-crank: crank and RRP dyad.

use super::error::DyadError;
use super::motion::Assembly;
use super::numeric::{check_lengths, scale};
use super::rows::{self, Rows};
use super::rrp::{RrpMotion, Slid, solve_guide};
use crate::double_double::sign_of_sum;
use crate::real::Masked;
use crate::units::{Angle, Length};
use std::f64::consts::PI;

/// A slider-crank: crank `a` about the origin, rod `b`, and a guide with the direction δ at the
/// signed distance `e` from the origin.
///
/// The guide passes through `e (−sin δ, cos δ)`, the foot of the normal from the origin, from
/// which the slider's coordinate counts: the offset is positive where the guide passes to the left
/// of the origin, seen along δ. The crank angle φ1 counts from the x-axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrank {
    crank: Length,
    rod: Length,
    offset: Length,
    direction: Angle,
    exponent: i32,
}

/// Position and derivatives with respect to the crank angle.
pub type SliderCrankMotion = RrpMotion;

/// A dead centre: crank and rod on one line, `x' = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadCentre {
    /// The crank angle less the guide's direction, `φ1 − δ`, in `(−π, π]`.
    pub crank_from_guide: Angle,
    /// The slider's coordinate.
    pub slider: Length,
}

/// The dead centres of one assembly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadCentres {
    /// Crank and rod stretched; there is always one.
    pub extended: DeadCentre,
    /// Crank and rod folded, if the linkage reaches it.
    pub folded: Option<DeadCentre>,
}

impl SliderCrank {
    /// A slider-crank with the given lengths and direction of the guide.
    ///
    /// # Errors
    /// [`DyadError::NotFinite`], [`DyadError::NotPositive`] (crank and rod),
    /// [`DyadError::LengthRatio`], and [`DyadError::CannotClose`] where `|e| ≥ a + b`.
    pub fn new(
        crank: Length,
        rod: Length,
        offset: Length,
        direction: Angle,
    ) -> Result<SliderCrank, DyadError> {
        let exponent = check_lengths(&[("crank", crank), ("rod", rod)], &[("offset", offset)])?;
        if !direction.rad().is_finite() {
            return Err(DyadError::NotFinite {
                what: "direction",
                value: direction.rad(),
            });
        }
        let linkage = SliderCrank {
            crank,
            rod,
            offset,
            direction,
            exponent,
        };
        let [a, b, e] = linkage.scaled();
        if sign_of_sum(&[e.abs(), -a, -b]) >= 0.0 {
            return Err(DyadError::CannotClose {
                what: "offset",
                longest_m: offset.m().abs(),
                others_m: scale(a + b, exponent),
            });
        }
        Ok(linkage)
    }

    /// The length of the crank.
    pub fn crank(&self) -> Length {
        self.crank
    }

    /// The length of the rod.
    pub fn rod(&self) -> Length {
        self.rod
    }

    /// The offset of the guide.
    pub fn offset(&self) -> Length {
        self.offset
    }

    /// The direction of the guide.
    pub fn direction(&self) -> Angle {
        self.direction
    }

    fn scaled(&self) -> [f64; 3] {
        [self.crank, self.rod, self.offset].map(|l| scale(l.m(), -self.exponent))
    }

    /// Returns whether the crank turns fully without a singular position, `b > a + |e|`; decided
    /// exactly.
    pub fn turns_fully(&self) -> bool {
        let [a, b, e] = self.scaled();
        sign_of_sum(&[b, -a, -e.abs()]) > 0.0
    }

    /// The limits of `φ1 − δ` where the rod is normal to the guide, as the angles ψ in
    /// `[−π/2, π/2]` with `sin ψ = (e − b)/a` and `sin ψ = (e + b)/a`: the crank reaches the
    /// angles whose sine lies between. `None` where that side sets no limit.
    pub fn crank_limits(&self) -> (Option<Angle>, Option<Angle>) {
        let [a, b, e] = self.scaled();
        // cos ψ = √((a − n)(a + n))/a for sin ψ = n/a.
        let angle = |b: f64| {
            let inside = sign_of_sum(&[a, e, b]) > 0.0 && sign_of_sum(&[a, -e, -b]) > 0.0;
            let n = e + b;
            inside.then(|| {
                let cos = ((a - n).max(0.0) * (a + n).max(0.0)).sqrt();
                Angle::from_rad(n.atan2(cos))
            })
        };
        (angle(-b), angle(b))
    }

    /// The dead centres.
    ///
    /// Stretched the slider is `a + b` from the origin, folded `|b − a|`: the coordinate is
    /// `±√((b ± a − e)(b ± a + e))`.
    pub fn dead_centres(&self, assembly: Assembly) -> DeadCentres {
        let [a, b, e] = self.scaled();
        let s = assembly.sign();
        let centre = |x: f64, psi: f64| DeadCentre {
            crank_from_guide: Angle::from_rad(psi),
            slider: Length::from_m(scale(x, self.exponent)),
        };
        let root = |l: f64| ((l - e).max(0.0) * (l + e).max(0.0)).sqrt();
        let x = s * root(a + b);
        let extended = centre(x, e.atan2(x));
        let reached =
            sign_of_sum(&[b, -a, -e.abs()]) >= 0.0 || sign_of_sum(&[a, -b, -e.abs()]) >= 0.0;
        let folded = (reached && a != b).then(|| {
            if b > a {
                // The crank points away from the slider.
                let x = s * root(b - a);
                let psi = (-e).atan2(-x);
                centre(x, if psi == -PI { PI } else { psi })
            } else {
                // The slider lies on the crank, behind its end.
                let x = -s * root(a - b);
                centre(x, e.atan2(x))
            }
        });
        DeadCentres { extended, folded }
    }

    /// The stroke of a linkage whose crank turns fully:
    /// `√((b+a)² − e²) − √((b−a)² − e²) = 4ab / (sum of the roots)`.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::SliderCrank;
    /// use mechaudit_solvers::units::{Angle, Length};
    /// let l = Length::from_mm;
    /// let central = SliderCrank::new(l(50.0), l(200.0), l(0.0), Angle::from_rad(0.0))?;
    /// assert!((central.stroke().unwrap().mm() - 100.0).abs() < 1e-12);
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    pub fn stroke(&self) -> Option<Length> {
        let [a, b, e] = self.scaled();
        let root = |l: f64| ((l - e) * (l + e)).sqrt();
        self.turns_fully()
            .then(|| 4.0 * a * b / (root(b + a) + root((b - a).max(e.abs()))))
            .map(|x| Length::from_m(scale(x, self.exponent)))
    }

    /// Position and derivatives at the crank angle φ1.
    ///
    /// With `ψ = φ1 − δ` the crank's end has the coordinate `p = a cos ψ` along the guide and the
    /// distance `h = e − a sin ψ` from it; the rest is (7) and (8). The rod's angle is δ plus its
    /// angle to the guide and is continuous in φ1, see [`RrpMotion::rod`].
    ///
    /// # Errors
    /// [`DyadError::Unreachable`], [`DyadError::Singular`], [`DyadError::NotFinite`],
    /// [`DyadError::Overflow`].
    pub fn position(
        &self,
        phi1: Angle,
        assembly: Assembly,
    ) -> Result<SliderCrankMotion, DyadError> {
        let phi = phi1.rad();
        if !(phi - self.direction.rad()).is_finite() {
            return Err(DyadError::NotFinite {
                what: "crank angle",
                value: phi,
            });
        }
        let moved = rows::at(self, phi, assembly);
        moved.motion(self.scaled()[1], self.exponent)
    }
}

impl Rows for SliderCrank {
    type Moved<R> = Slid<R>;

    #[inline(always)]
    fn relative<R: Masked>(&self, phi: R) -> R {
        phi - phi.like(self.direction.rad())
    }

    #[inline(always)]
    fn moved<R: Masked>(&self, phi: R, (sin, cos): (R, R), s: f64) -> Slid<R> {
        let [a, b, e] = self.scaled();
        let (p, q) = (phi.like(a) * cos, phi.like(a) * sin);
        let h = phi.like(-a).fma(sin, phi.like(e));
        solve_guide([p, -q, -p], [h, -p, q], b, self.direction.rad(), s)
    }

    #[inline(always)]
    fn row<R: Masked>(&self, m: &Slid<R>) -> ([R; 8], R::Mask) {
        let slider = m.slider.map(
            #[inline(always)]
            |x| scale(x, self.exponent),
        );
        let row = [
            slider[0],
            m.rod[0],
            slider[1],
            m.rod[1],
            slider[2],
            m.rod[2],
            m.transmission,
            scale(m.reach, self.exponent),
        ];
        // Not so where it is no number: the guide is out of reach.
        (row, m.reach.like(0.0).below(m.reach.magnitude()))
    }
}
