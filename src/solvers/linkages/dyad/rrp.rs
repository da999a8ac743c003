//! The RRP dyad: a rod with revolute joints, one of them on a slider along a fixed guide.

use super::error::DyadError;
use super::motion::{Assembly, LinkMotion, PointMotion};
use super::numeric::{check_lengths, dot, exponent, scale};
use crate::arctangent::first_quadrant;
use crate::double_double::Dd;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Masked;
use crate::units::{Angle, Length};
use std::f64::consts::PI;

/// A fixed straight guide through a point, with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    /// A point of the guide in metres; the slider's coordinate counts from here.
    pub origin_m: [f64; 2],
    /// The direction, from the x-axis.
    pub direction: Angle,
}

/// A rod between a moving point `A` and a slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RrpDyad {
    rod: Length,
    assembly: Assembly,
}

/// Position and derivatives of an RRP dyad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RrpMotion {
    /// The slider's coordinate along the guide in metres.
    pub slider_m: f64,
    /// Its first derivative, in metres for each unit of the parameter.
    pub slider_first_m: f64,
    /// Its second derivative, in metres for each unit of the parameter squared.
    pub slider_second_m: f64,
    /// The rod, from `A` to the slider. Relative to the guide its angle lies in `[−π/2, π/2]` for
    /// the positive and in `[π/2, 3π/2]` for the negative assembly, so that it is continuous.
    pub rod: LinkMotion,
    /// The angle between rod and guide, 0 to π/2: the pressure angle. Zero where force is passed
    /// on best.
    pub pressure: Angle,
    /// π/2 minus the pressure angle, in `(0, π/2]`.
    pub transmission: Angle,
    /// The rod's component along the guide in metres, the determinant of the velocity equations
    /// divided by the rod's length.
    pub determinant_m: f64,
}

impl RrpDyad {
    /// A dyad with the given rod.
    ///
    /// # Errors
    /// [`DyadError::NotFinite`], [`DyadError::NotPositive`].
    pub fn new(rod: Length, assembly: Assembly) -> Result<RrpDyad, DyadError> {
        check_lengths(&[("rod", rod)], &[])?;
        Ok(RrpDyad { rod, assembly })
    }

    /// Solves the dyad for the point `A` and the guide.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::{Assembly, Guide, PointMotion, RrpDyad};
    /// use mechaudit_solvers::units::{Angle, Length};
    /// let dyad = RrpDyad::new(Length::from_m(5.0), Assembly::Positive)?;
    /// let guide = Guide { origin_m: [0.0, 0.0], direction: Angle::from_rad(0.0) };
    /// let m = dyad.solve(&PointMotion::fixed([1.0, 3.0]), &guide)?;
    /// assert_eq!(m.slider_m, 5.0);
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    ///
    /// # Errors
    /// [`DyadError::Unreachable`] where the guide is farther from `A` than the rod is long,
    /// [`DyadError::Singular`] where the rod is normal to the guide, [`DyadError::NotFinite`],
    /// [`DyadError::Overflow`].
    pub fn solve(&self, a: &PointMotion, guide: &Guide) -> Result<RrpMotion, DyadError> {
        a.check("the point")?;
        let direction = guide.direction.rad();
        for value in [guide.origin_m[0], guide.origin_m[1], direction] {
            if !value.is_finite() {
                return Err(DyadError::NotFinite {
                    what: "guide",
                    value,
                });
            }
        }
        let b = self.rod.m();
        let e = exponent(b);
        let (sin, cos) = direction.sin_cos();
        let relative = [0, 1].map(|i| a.position_m[i] - guide.origin_m[i]);
        let along = [relative, a.first_m, a.second_m].map(|v| scale(dot(v, [cos, sin]), -e));
        let across = [relative, a.first_m, a.second_m].map(|v| scale(-dot(v, [-sin, cos]), -e));
        let b = scale(b, -e);
        let alone = Alone {
            along,
            across,
            b,
            direction,
            assembly: self.assembly,
        };
        with_best(alone).motion(b, e)
    }
}

/// One dyad by itself.
pub(super) struct Alone {
    pub along: [f64; 3],
    pub across: [f64; 3],
    pub b: f64,
    pub direction: f64,
    pub assembly: Assembly,
}

impl Task for Alone {
    type Output = Slid<f64>;
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Slid<f64> {
        let s = self.assembly.sign();
        solve_guide(self.along, self.across, self.b, self.direction, s)
    }
}

/// The kernel. `along` is the coordinate `p` of `A` along the guide with its derivatives, `across`
/// the distance `h` from `A` to the guide, both scaled. With `R = √((b − h)(b + h))`, the rod's
/// angle θ to the guide, `b sin θ = h`, `b cos θ = s R`:
///
/// ```text
/// x = p + s R         x' = p' − h θ'           x'' = p'' − h' θ' − h θ''                  (7)
/// θ' = h' / (s R)     θ'' = (h'' + h θ'²) / (s R)                                         (8)
/// ```
#[inline(always)]
pub(super) fn solve_guide<R: Masked>(
    along: [R; 3],
    across: [R; 3],
    b: f64,
    direction: f64,
    s: f64,
) -> Slid<R> {
    let [h, h1, h2] = across;
    let like = |v: f64| h.like(v);
    let root = ((like(b) - h) * (like(b) + h)).root();
    let reach = like(s) * root;
    let first = h1 / reach;
    let second = (h * first).fma(first, h2) / reach;
    let tilt = first_quadrant(h.magnitude(), root).with_sign_of(h);
    let angle = match s > 0.0 {
        true => like(direction) + tilt,
        false => like((direction + PI) + Dd::PI.lo) - tilt,
    };
    Slid {
        slider: [
            along[0] + reach,
            (-h).fma(first, along[1]),
            (-h).fma(second, (-h1).fma(first, along[2])),
        ],
        rod: [angle, first, second],
        tilt,
        transmission: first_quadrant(root, h.magnitude()),
        reach,
        height: h,
    }
}

/// A position in scaled lengths.
pub(super) struct Slid<R> {
    pub slider: [R; 3],
    pub rod: [R; 3],
    tilt: R,
    pub transmission: R,
    pub reach: R,
    /// The distance `h`.
    height: R,
}

impl Slid<f64> {
    /// The motion in metres.
    pub fn motion(&self, b: f64, e: i32) -> Result<RrpMotion, DyadError> {
        let h = self.height;
        let (span_m, least_m, most_m) = (scale(h.abs(), e), 0.0, scale(b, e));
        // Also where the distance has overflowed to an infinity or to NaN.
        if h.is_nan() || h.abs() > b {
            return Err(DyadError::Unreachable {
                span_m,
                least_m,
                most_m,
            });
        }
        if self.reach == 0.0 {
            return Err(DyadError::Singular {
                span_m,
                least_m,
                most_m,
            });
        }
        let [slider_m, slider_first_m, slider_second_m] = self.slider.map(|x| scale(x, e));
        let [angle, first, second] = self.rod;
        let values = [slider_m, slider_first_m, slider_second_m, first, second];
        if values.iter().any(|x| !x.is_finite()) {
            return Err(DyadError::Overflow {
                what: "the motion of the slider or rod",
            });
        }
        Ok(RrpMotion {
            slider_m,
            slider_first_m,
            slider_second_m,
            rod: LinkMotion {
                angle: Angle::from_rad(angle),
                first,
                second,
            },
            pressure: Angle::from_rad(self.tilt.abs()),
            transmission: Angle::from_rad(self.transmission),
            determinant_m: scale(self.reach, e),
        })
    }
}
