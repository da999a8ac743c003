//! Four-bar linkages and slider-cranks with masses, reduced to the crank.

use super::model::{Coefficients, ModelError, ReducedModel, checked_angle};
use crate::class_iii::PointMotion;
use crate::dyad::{Assembly, FourBar, LinkMotion, SliderCrank};
use crate::reduction::{Body, BodyError, BodyMotion, check_body, reduce};
use crate::units::{Acceleration, Angle, Mass};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// A four-bar linkage with masses. Gravity acts along −y.
///
/// Centres of mass are given in the frames of the links: the crank's from its pivot along the
/// crank, the coupler's from the crank's end along the coupler, the rocker's from its pivot along
/// the rocker.
#[derive(Clone, Debug)]
pub struct FourBarModel {
    linkage: FourBar,
    assembly: Assembly,
    bodies: [Body; 3],
    gravity: f64,
    dead: Vec<f64>,
}

impl FourBarModel {
    /// Crank, coupler and rocker; the coupler's inertia is about its centre of mass.
    ///
    /// # Errors
    /// [`BodyError`], links numbered 1 to 3.
    pub fn new(
        linkage: FourBar,
        assembly: Assembly,
        bodies: [Body; 3],
        gravity: Acceleration,
    ) -> Result<FourBarModel, BodyError> {
        for (i, body) in bodies.iter().enumerate() {
            check_body(i + 1, body, i == 1, gravity)?;
        }
        let d = linkage.dead_positions(assembly);
        let dead = [d.extended, d.folded];
        Ok(FourBarModel {
            linkage,
            assembly,
            bodies,
            gravity: gravity.m_per_s2(),
            dead: sorted(dead.iter().flatten().map(|d| d.crank.rad())),
        })
    }
}

impl ReducedModel for FourBarModel {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        checked_angle(phi)?;
        let m = self
            .linkage
            .position(Angle::from_rad(phi), self.assembly)
            .map_err(|source| ModelError::Dyad { phi, source })?;
        let crank = crank_motion(phi);
        let tip = carried([0.0; 2], crank, self.linkage.crank().m(), 0.0);
        let pivot = PointMotion {
            r: [self.linkage.frame().m(), 0.0],
            first: [0.0; 2],
            second: [0.0; 2],
        };
        let [b1, b2, b3] = self.bodies;
        Ok(reduced(
            [
                (b1, about([0.0; 2], &b1, crank)),
                (b2, on(&tip, &b2, m.coupler)),
                (b3, on(&pivot, &b3, m.rocker)),
            ],
            self.gravity,
        ))
    }

    fn dead_positions(&self) -> &[f64] {
        &self.dead
    }
}

/// A slider-crank with masses. Gravity acts along −y.
#[derive(Clone, Debug)]
pub struct SliderCrankModel {
    linkage: SliderCrank,
    assembly: Assembly,
    bodies: [Body; 2],
    slider: Mass,
    gravity: Acceleration,
    dead: Vec<f64>,
}

impl SliderCrankModel {
    /// Crank and rod (its centre of mass from the crank's end along the rod, its inertia about it)
    /// and the mass of the slider, which does not turn.
    ///
    /// # Errors
    /// [`BodyError`], links numbered 1 to 3.
    pub fn new(
        linkage: SliderCrank,
        assembly: Assembly,
        bodies: [Body; 2],
        slider: Mass,
        gravity: Acceleration,
    ) -> Result<SliderCrankModel, BodyError> {
        for (i, body) in bodies.iter().enumerate() {
            check_body(i + 1, body, i == 1, gravity)?;
        }
        check_body(3, &point_mass(slider), true, gravity)?;
        let d = linkage.dead_centres(assembly);
        let direction = linkage.direction().rad();
        let dead = [Some(d.extended), d.folded];
        Ok(SliderCrankModel {
            linkage,
            assembly,
            bodies,
            slider,
            gravity,
            dead: sorted(
                dead.iter()
                    .flatten()
                    .map(|d| d.crank_from_guide.rad() + direction),
            ),
        })
    }
}

impl ReducedModel for SliderCrankModel {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        checked_angle(phi)?;
        let m = self
            .linkage
            .position(Angle::from_rad(phi), self.assembly)
            .map_err(|source| ModelError::Dyad { phi, source })?;
        let crank = crank_motion(phi);
        let tip = carried([0.0; 2], crank, self.linkage.crank().m(), 0.0);
        let (sin, cos) = self.linkage.direction().rad().sin_cos();
        let along = |x: f64| [x * cos, x * sin];
        let slider = BodyMotion {
            // The slider's place does not matter, only its motion.
            centre: PointMotion {
                r: along(m.slider_m),
                first: along(m.slider_first_m),
                second: along(m.slider_second_m),
            },
            first: 0.0,
            second: 0.0,
        };
        let [b1, b2] = self.bodies;
        Ok(reduced(
            [
                (b1, about([0.0; 2], &b1, crank)),
                (b2, on(&tip, &b2, m.rod)),
                (point_mass(self.slider), slider),
            ],
            self.gravity.m_per_s2(),
        ))
    }

    fn dead_positions(&self) -> &[f64] {
        &self.dead
    }
}

fn sorted(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = angles.map(|a| a.rem_euclid(TAU)).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn point_mass(mass: Mass) -> Body {
    use crate::reduction::MomentOfInertia;
    use crate::units::{Inertia, Length};
    Body {
        mass,
        inertia: MomentOfInertia::AboutCentreOfMass(Inertia::from_kg_m2(0.0)),
        radius: Length::from_m(0.0),
        angle: Angle::from_rad(0.0),
    }
}

fn crank_motion(phi: f64) -> LinkMotion {
    LinkMotion {
        angle: Angle::from_rad(phi),
        first: 1.0,
        second: 0.0,
    }
}

fn reduced(bodies: [(Body, BodyMotion); 3], gravity: f64) -> Coefficients {
    let r = reduce(bodies, gravity);
    Coefficients {
        inertia: r.inertia_kg_m2,
        inertia_derivative: r.inertia_derivative_kg_m2,
        moment: r.moment_n_m,
    }
}

/// The point at the polar place `(radius, angle)` of a link that turns about a fixed point.
fn carried(pivot: [f64; 2], link: LinkMotion, radius: f64, angle: f64) -> PointMotion {
    let (s, c) = (link.angle.rad() + angle).sin_cos();
    let z = Complex64::new(c, s) * radius;
    let (w, e) = (link.first, link.second);
    PointMotion {
        r: [pivot[0] + z.re, pivot[1] + z.im],
        first: [-z.im * w, z.re * w],
        second: [-z.im * e - z.re * w * w, z.re * e - z.im * w * w],
    }
}

fn about(pivot: [f64; 2], body: &Body, link: LinkMotion) -> BodyMotion {
    BodyMotion {
        centre: carried(pivot, link, body.radius.m(), body.angle.rad()),
        first: link.first,
        second: link.second,
    }
}

/// A body on a link whose origin moves.
fn on(origin: &PointMotion, body: &Body, link: LinkMotion) -> BodyMotion {
    let mut motion = about([0.0; 2], body, link);
    for i in 0..2 {
        motion.centre.r[i] += origin.r[i];
        motion.centre.first[i] += origin.first[i];
        motion.centre.second[i] += origin.second[i];
    }
    motion
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::reduction::MomentOfInertia;
    use crate::units::{Inertia, Length};

    fn body(mass: f64, inertia: f64, radius: f64, pivot: bool) -> Body {
        let j = Inertia::from_kg_m2(inertia);
        Body {
            mass: Mass::from_kg(mass),
            inertia: match pivot {
                true => MomentOfInertia::AboutPivot(j),
                false => MomentOfInertia::AboutCentreOfMass(j),
            },
            radius: Length::from_m(radius),
            angle: Angle::from_deg(7.0),
        }
    }

    pub(crate) fn four_bar() -> FourBarModel {
        let [a, b, c, d] = [10.0, 40.0, 30.0, 35.0].map(Length::from_cm);
        FourBarModel::new(
            FourBar::new(a, b, c, d).unwrap(),
            Assembly::Positive,
            [
                body(1.0, 0.02, 0.04, true),
                body(4.0, 0.05, 0.2, false),
                body(3.0, 0.15, 0.14, true),
            ],
            Acceleration::from_m_per_s2(9.81),
        )
        .unwrap()
    }

    pub(crate) fn slider_crank() -> SliderCrankModel {
        let l = Length::from_mm;
        SliderCrankModel::new(
            SliderCrank::new(l(50.0), l(180.0), l(15.0), Angle::from_deg(20.0)).unwrap(),
            Assembly::Positive,
            [body(0.5, 0.001, 0.01, false), body(1.2, 0.004, 0.06, false)],
            Mass::from_kg(2.0),
            Acceleration::from_m_per_s2(9.81),
        )
        .unwrap()
    }

    /// dI_n/dφ is the derivative of I_n, and M_o has no mean: weights return what they take.
    #[test]
    fn coefficients_belong_together() {
        let models: [&dyn ReducedModel; 2] = [&four_bar(), &slider_crank()];
        for model in models {
            assert_eq!(model.dead_positions().len(), 2);
            let h = 1e-5;
            let mut mean = 0.0;
            for k in 0..360 {
                let phi = f64::from(k).to_radians() + 0.01;
                let at = |x: f64| model.coefficients(x).unwrap();
                let c = at(phi);
                let d = (at(phi + h).inertia - at(phi - h).inertia) / (2.0 * h);
                assert!((d - c.inertia_derivative).abs() < 1e-8, "{k}: {d} {c:?}");
                assert!(c.inertia > 0.0);
                mean += c.moment / 360.0;
            }
            assert!(mean.abs() < 1e-12, "{mean}");
        }
    }

    /// Places and their derivatives by the angle of the crank: `first` is the derivative of `r`,
    /// and `second` that of `first`.
    #[test]
    fn points_on_links() {
        // The link turns as 0.4 + 1.5 x − x².
        let link = |x: f64| LinkMotion {
            angle: Angle::from_rad(0.4 + 1.5 * x - x * x),
            first: 1.5 - 2.0 * x,
            second: -2.0,
        };
        let p = carried([3.0, -5.0], link(0.0), 2.0, 0.25);
        assert!((p.r[0] - (3.0 + 2.0 * 0.65f64.cos())).abs() < 1e-15);
        assert!((p.r[1] - (-5.0 + 2.0 * 0.65f64.sin())).abs() < 1e-15);
        let b = body(1.0, 1.0, 0.5, false);
        let origin = |x: f64| PointMotion {
            r: [1.0 + 3.0 * x * x, 2.0 - x],
            first: [6.0 * x, -1.0],
            second: [6.0, 0.0],
        };
        let moving = |x: f64| on(&origin(x), &b, link(x)).centre;
        let here = moving(0.0);
        let angle = 0.4 + 7f64.to_radians();
        assert!((here.r[0] - (1.0 + 0.5 * angle.cos())).abs() < 1e-15);
        assert!((here.r[1] - (2.0 + 0.5 * angle.sin())).abs() < 1e-15);
        let h = 1e-5;
        let points: [&dyn Fn(f64) -> PointMotion; 2] =
            [&moving, &|x| carried([3.0, -5.0], link(x), 2.0, 0.25)];
        for at in points {
            let (a, p, b) = (at(-h), at(0.0), at(h));
            for i in 0..2 {
                let slope = |a: [f64; 2], b: [f64; 2]| (b[i] - a[i]) / (2.0 * h);
                assert!((slope(a.r, b.r) - p.first[i]).abs() < 1e-8);
                assert!((slope(a.first, b.first) - p.second[i]).abs() < 1e-8);
            }
        }
    }

    /// Without weights it does not matter which way the guide points.
    #[test]
    fn a_turned_guide_has_the_same_inertia() {
        let l = Length::from_mm;
        let turned = |degrees: f64| {
            SliderCrankModel::new(
                SliderCrank::new(l(50.0), l(180.0), l(15.0), Angle::from_deg(degrees)).unwrap(),
                Assembly::Positive,
                [body(0.5, 0.001, 0.01, false), body(1.2, 0.004, 0.06, false)],
                Mass::from_kg(2.0),
                Acceleration::from_m_per_s2(0.0),
            )
            .unwrap()
        };
        let straight = turned(0.0);
        for degrees in [20.0, 90.0, -130.0] {
            for phi in [0.1, 1.0, 2.5, 4.0] {
                let a = straight.coefficients(phi).unwrap();
                let b = turned(degrees).coefficients(phi + f64::to_radians(degrees));
                let b = b.unwrap();
                assert!((a.inertia - b.inertia).abs() < 1e-16, "{degrees} {phi}");
                assert!((a.inertia_derivative - b.inertia_derivative).abs() < 1e-16);
                assert_eq!((a.moment, b.moment), (0.0, 0.0));
            }
        }
    }

    #[test]
    fn bad_bodies_are_refused() {
        let [a, b, c, d] = [10.0, 40.0, 30.0, 35.0].map(Length::from_cm);
        let linkage = FourBar::new(a, b, c, d).unwrap();
        let g = Acceleration::from_m_per_s2(9.81);
        let good = body(1.0, 0.02, 0.04, false);
        let make = |bodies| FourBarModel::new(linkage, Assembly::Positive, bodies, g).unwrap_err();
        let e = make([good, body(1.0, 1.0, 1.0, true), good]);
        assert_eq!(e, BodyError::NoPivot { link: 2 });
        let e = make([good, good, body(-1.0, 1.0, 1.0, true)]).to_string();
        assert!(e.contains("mass of link 3 = -1 kg"), "{e}");
    }
}
