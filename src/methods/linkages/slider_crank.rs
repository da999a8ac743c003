//! The slider-crank.

use super::four_bar::{refusal, side};
use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Uncertified};
use crate::methods::common::{central_difference, conditioned, held, point, region};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::dyad::slider_crank;
use crate::solvers::dyad::{self, SliderCrankMotion};
use crate::solvers::units::{Angle, Length};
use rug::Rational;
use std::cmp::Ordering;
use std::f64::consts::PI;

inputs! {
    /// A slider-crank at a crank angle.
    pub struct SliderCrankInput {
        a: number "a (crank)", "m";
        b: number "b (rod)", "m";
        e: number "e (offset)", "m";
        delta: number "delta (guide)", "rad";
        phi1: number "phi1", "rad";
        assembly: choice "assembly (1 or -1)", "1";
    }
}

/// Crank and RRP dyad: slider and rod with both derivatives, transmission angle.
///
/// A candidate is a
/// `Fn([crank, rod, offset], guide's angle, phi1, positive assembly) ->
/// [x, x', x'', phi2, phi2', phi2'', mu]`,
/// metres and radians, derivatives by `phi1`.
#[derive(Clone, Copy, Debug)]
pub struct SliderCrank;

method! {
    SliderCrank "slider-crank":
        Fn([f64; 3], f64, f64, bool), |f, i| f([i.a, i.b, i.e], i.delta, i.phi1, i.assembly > 0.0)
}

const POSITION: &str = "a mixed forward-backward stable position: a few roundings of each length \
    and of the difference of the two angles";
const FIRST: &str = "the position's errors pass into one quotient and one product";
const SECOND: &str = "a square of the first derivative, one more quotient, three terms added";

fn motion(i: SliderCrankInput) -> Result<SliderCrankMotion, &'static str> {
    let [a, b, e] = [i.a, i.b, i.e].map(Length::from_m);
    dyad::SliderCrank::new(a, b, e, Angle::from_rad(i.delta))
        .and_then(|l| l.position(Angle::from_rad(i.phi1), side(i.assembly)))
        .map_err(|e| e.name())
}

fn values(m: &SliderCrankMotion) -> Vec<f64> {
    vec![
        m.slider_m,
        m.slider_first_m,
        m.slider_second_m,
        m.rod.angle.rad(),
        m.rod.first,
        m.rod.second,
        m.transmission.rad(),
    ]
}

impl Definition for SliderCrank {
    type Input<'a, T: Number> = SliderCrankInput<'a, T>;
    const SUMMARY: &'static str =
        "slider-crank with offset: slider, rod, derivatives by the crank angle, transmission angle";
    const SOURCE: &'static str = "loop equation and its derivatives, equations (7) and (8) of the solver; Artobolevskii, \
         Theory of Mechanisms and Machines, class-II groups";

    fn outputs() -> Vec<Output> {
        vec![
            conditioned("x", "m", 4.0, POSITION),
            conditioned("x'", "m", 4.0, FIRST),
            conditioned("x''", "m", 6.0, SECOND),
            conditioned("phi2", "rad", 4.0, POSITION),
            conditioned("phi2'", "1", 4.0, FIRST),
            conditioned("phi2''", "1", 6.0, SECOND),
            conditioned("mu", "rad", 4.0, POSITION),
        ]
    }

    fn domain() -> Domain {
        Domain {
            regions: vec![
                region(
                    "central",
                    "e = 0, b/a in [1.5, 8], any direction, phi1 over several turns",
                    |r| {
                        let a = r.uniform(0.05, 1.0);
                        let b = a * r.uniform(1.5, 8.0);
                        let delta = r.uniform(-PI, PI);
                        let phi = r.uniform(-20.0, 20.0);
                        finish(r, a, b, 0.0, delta, phi)
                    },
                ),
                region(
                    "offset",
                    "b > a + |e|, any direction, phi1 in [-pi, pi]",
                    |r| {
                        let (a, e) = (r.uniform(0.05, 1.0), r.uniform(-1.0, 1.0));
                        let b = (a + e.abs()) * r.uniform(1.05, 5.0);
                        let delta = r.uniform(-PI, PI);
                        let phi = r.uniform(-PI, PI);
                        finish(r, a, b, e, delta, phi)
                    },
                ),
                region(
                    "horizontal",
                    "delta = 0, b > a + |e|, phi1 down to 1e-6 from zero",
                    |r| {
                        let (a, e) = (r.uniform(0.05, 1.0), r.uniform(-1.0, 1.0));
                        let b = (a + e.abs()) * r.uniform(1.05, 5.0);
                        let size = r.log_uniform(1e-6, PI);
                        let phi = r.signed(size);
                        finish(r, a, b, e, 0.0, phi)
                    },
                ),
                region(
                    "near-normal",
                    "the rod within 1e-10 to 1e-2 (in 1 - |sin|) of normal to the guide",
                    |r| {
                        let gap = r.log_uniform(1e-10, 1e-2);
                        near_limit(r, 1.0 - gap)
                    },
                ),
                region(
                    "different-lengths",
                    "a, b, e over eight decades, the rod within reach",
                    |r| loop {
                        let [a, b, e] = [(); 3].map(|()| r.log_uniform(1e-6, 1e2));
                        let e = r.signed(e);
                        let (delta, phi) = (r.uniform(-PI, PI), r.uniform(-PI, PI));
                        if (e - a * libm::sin(phi - delta)).abs() < 0.999 * b {
                            return finish(r, a, b, e, delta, phi);
                        }
                    },
                ),
                region(
                    "swinging-crank",
                    "b < a + |e|: the crank does not turn fully; within its range",
                    |r| loop {
                        let [a, b] = [(); 2].map(|()| r.uniform(0.2, 2.0));
                        let e = r.uniform(-2.0, 2.0);
                        let (delta, phi) = (r.uniform(-PI, PI), r.uniform(-PI, PI));
                        let h = e - a * libm::sin(phi - delta);
                        if b < a + e.abs() && h.abs() < 0.999 * b {
                            return finish(r, a, b, e, delta, phi);
                        }
                    },
                ),
                region(
                    "unreachable",
                    "the guide 1e-9 to 0.5 farther from the crank's end than the rod is long",
                    |r| {
                        let gap = r.log_uniform(1e-9, 0.5);
                        near_limit(r, 1.0 + gap)
                    },
                ),
            ],
            check_points: vec![
                point("triangle-3-4-5", [3.0, 5.0, 0.0, 0.0, PI / 2.0, 1.0]),
                point("offset-triangle", [1.0, 5.0, 3.0, 0.0, 0.0, 1.0]),
                point("offset-triangle-behind", [1.0, 5.0, 3.0, 0.0, 0.0, -1.0]),
                point("upper-dead-centre", [1.0, 4.0, 0.0, 0.0, 0.0, 1.0]),
                point("lower-dead-centre", [1.0, 4.0, 0.0, 0.0, PI, 1.0]),
                point("along-the-guide", [1.0, 4.0, 0.5, 0.7, 0.7, 1.0]),
                point("vertical-guide", [0.1, 0.35, 0.0, PI / 2.0, 1.0, 1.0]),
                point("equal-crank-and-rod", [1.0, 1.0, 0.0, 0.0, 1.0, 1.0]),
                point("rod-normal-exactly", [1.0, 5.0, 5.0, 0.3, 0.3, 1.0]),
                point("out-of-reach", [1.0, 5.0, 5.5, 0.3, 0.3, 1.0]),
                point("never-closed", [1.0, 5.0, -6.0, 0.3, 0.3, 1.0]),
            ],
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.assembly.abs() == 1.0
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        Ok(values(&motion(i)?))
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let lengths = [i.a, i.b, i.e].map(Rational::clone);
        let ahead = i.assembly.cmp0() == Ordering::Greater;
        let m = slider_crank(&lengths, i.delta, i.phi1, ahead, bits).map_err(refusal)?;
        let mut values = m.slider.to_vec();
        values.extend(m.rod);
        values.push(m.transmission);
        Ok(ReferenceAnswer::bounded(
            values,
            "intersection of circle and line in ball arithmetic, implicit differentiation",
        ))
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "closure",
                statement: "the slider is b from the crank's end within 16 u of the lengths",
                residual: closure,
            },
            Law {
                name: "scale",
                statement: "lengths times 2^7 scale the slider and leave angles bit for bit",
                residual: scale_law,
            },
            Law {
                name: "mirror",
                statement: "-e, -delta, -phi1 keep the slider and mirror the rod bit for bit",
                residual: mirror,
            },
            Law {
                name: "velocity",
                statement: "x' is the central difference of x within 1e-5 of the lengths, for mu above 30 degrees",
                residual: velocity,
            },
        ]
    }
}

fn finish(r: &mut Draw, a: f64, b: f64, e: f64, delta: f64, phi1: f64) -> Vec<f64> {
    let assembly = r.signed(1.0);
    SliderCrankInput {
        a,
        b,
        e,
        delta,
        phi1,
        assembly,
    }
    .to_vec()
}

/// The guide at `share` of the rod's length from the crank's end.
fn near_limit(r: &mut Draw, share: f64) -> Vec<f64> {
    loop {
        let [a, b] = [(); 2].map(|()| r.uniform(0.2, 2.0));
        let (delta, phi) = (r.uniform(-PI, PI), r.uniform(-PI, PI));
        let h = r.signed(b * share);
        let e = h + a * libm::sin(phi - delta);
        // The linkage as such has to close.
        if e.abs() < (a + b) * (1.0 - 1e-9) {
            return finish(r, a, b, e, delta, phi);
        }
    }
}

const U: f64 = f64::EPSILON / 2.0;

fn closure(x: &[f64]) -> Option<f64> {
    let i = SliderCrank::unpack(x)?;
    let m = motion(i).ok()?;
    let psi = i.phi1 - i.delta;
    let along = m.slider_m - i.a * psi.cos();
    let across = i.e - i.a * psi.sin();
    Some((along.hypot(across) - i.b).abs() / (16.0 * U * (i.a + i.b + i.e.abs())))
}

fn scale_law(x: &[f64]) -> Option<f64> {
    let i = SliderCrank::unpack(x)?;
    let here = values(&motion(i).ok()?);
    let [a, b, e] = [i.a, i.b, i.e].map(|l| l * 128.0);
    let there = values(&motion(SliderCrankInput { a, b, e, ..i }).ok()?);
    held(scaled(&here, &there))
}

/// Place and derivatives of the slider are lengths; angles are none.
fn scaled(here: &[f64], there: &[f64]) -> bool {
    let units = [128.0; 3].into_iter().chain(std::iter::repeat(1.0));
    let turned = here.iter().zip(units).map(|(x, unit)| x * unit);
    there.iter().copied().eq(turned)
}

fn mirror(x: &[f64]) -> Option<f64> {
    let i = SliderCrank::unpack(x)?;
    let here = values(&motion(i).ok()?);
    let [e, delta, phi1] = [-i.e, -i.delta, -i.phi1];
    let there = values(
        &motion(SliderCrankInput {
            e,
            delta,
            phi1,
            ..i
        })
        .ok()?,
    );
    held(mirrored(&here, &there, i.assembly))
}

/// x and x'' are even in the crank angle, x' is odd; the rod's angle is odd where the slider is
/// ahead (behind, it is mirrored at π).
fn mirrored(here: &[f64], there: &[f64], assembly: f64) -> bool {
    let even = [0, 2, 4, 6].iter().all(|&i| here[i] == there[i]);
    let odd = [1, 5].iter().all(|&i| here[i] == -there[i]);
    let angle = assembly < 0.0 || here[3] == -there[3];
    even && odd && angle
}

fn velocity(x: &[f64]) -> Option<f64> {
    const H: f64 = 1e-4;
    let i = SliderCrank::unpack(x)?;
    let m = motion(i).ok()?;
    let place = |phi1: f64| {
        let mut moved = i;
        moved.phi1 = phi1;
        motion(moved).ok().map(|m| m.slider_m)
    };
    let rate = central_difference(place, i.phi1, H)?;
    let size = i.a + i.b + i.e.abs();
    let calm = m.transmission.rad().sin() > 0.5 && size < 10.0 * i.b;
    calm.then(|| (rate - m.slider_first_m).abs() / (1e3 * H * H * size))
}

#[cfg(test)]
mod tests;
