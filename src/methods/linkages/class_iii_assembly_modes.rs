//! All assembly modes of the class-III linkage: their number and every angle.

use super::class_iii::{COINCIDING, ClassIiiGeometry, NO_LENGTH, PROOF, coincide, shorten};
use crate::audit::{Budget, Domain, Draw, Law, Limit, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::{output, point, region};
use crate::methods::definition::{Definition, conditions_at_reference, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::class_iii::Linkage;
use crate::reference::{Ball, Mag};
use crate::solvers::units::Angle;
use rug::Rational;
use std::f64::consts::TAU;

inputs! {
    /// A class-III linkage at a crank angle.
    pub struct ClassIiiAssemblyModesInput {
        geometry: (ClassIiiGeometry);
        phi1: number "phi1", "rad";
    }
}

/// All assembly modes of the class-III linkage.
///
/// A candidate is a `Fn(&[l1, l2, l3, l4, l5, lB, phiB, x3, y3, x5, y5], phi1) ->
/// Vec<[phi2, phi3, phi4, phi5]>`, the modes by `phi4`; no mode at all is a refusal.
#[derive(Clone, Copy, Debug)]
pub struct ClassIiiAssemblyModes;

method! {
    ClassIiiAssemblyModes "class-iii-assembly-modes":
        Fn(&[f64; 11], f64), |f, i| f(&i.geometry.values(), i.phi1)
}

const BITS_OF_CONDITIONS: u32 = 192;

const BUDGET: Budget = Budget {
    limit: Limit::Conditioned(4.0),
    reason: "each mode is polished by Newton's method on the loop equations, whose residual is a \
             few rounding errors of the lengths",
};

const PAPER: [f64; 11] = [
    0.10,
    1.04,
    0.60,
    0.64,
    0.485,
    0.22,
    -0.685_914_396,
    0.75,
    0.93,
    1.285,
    1.035,
];

/// Crank angle of the fold at 217.27° for the numbers above.
const FOLD: f64 = 3.792_092_161_844_882;

/// A linkage with joint B on joint D, and a crank angle.
const B_ON_D: [f64; 12] = [
    0.25, 1.34, 0.61, 0.51, 0.8, 0.51, 0.0, -0.06, 0.73, 0.47, 0.73, -2.49,
];

/// The paper's linkage at a crank angle.
fn paper_at(phi1: f64) -> Vec<f64> {
    [&PAPER[..], &[phi1]].concat()
}

fn linkage(i: ClassIiiAssemblyModesInput<Rational>, bits: u32) -> Result<Linkage, Uncertified> {
    Ok(Linkage::new(&i.geometry.exact()?, bits))
}

impl Definition for ClassIiiAssemblyModes {
    type Input<'a, T: Number> = ClassIiiAssemblyModesInput<'a, T>;
    const SUMMARY: &'static str =
        "every assembly mode of the class-III linkage: their number and all angles";
    const SOURCE: &'static str = "elimination of joint C from the loop equations of Zinchenko (2008): degree 6 in e^(i phi4)";

    fn outputs() -> Vec<Output> {
        ["phi2", "phi3", "phi4", "phi5"]
            .map(|name| output(name, "rad", BUDGET))
            .to_vec()
    }

    fn rows() -> Option<Rows> {
        Some(Rows {
            index: "k",
            count: "modes",
            meaning: "the assembly modes by increasing phi4",
        })
    }

    fn domain() -> Domain {
        Domain {
            regions: vec![
                region("paper", "Zinchenko's linkage at any crank angle", |d| {
                    paper_at(d.uniform(0.0, TAU))
                }),
                region(
                    "near-fold",
                    "1e-1 to 1e-8 rad on either side of where two of its modes merge: \
                                  the number has to be right",
                    |d| {
                        let offset = d.log_uniform(1e-8, 0.1);
                        paper_at(FOLD + d.signed(offset))
                    },
                ),
                region(
                    "random",
                    "random lengths (factor 10) and pivots within reach; two to six \
                                  modes, or none",
                    random,
                ),
                region("coinciding", COINCIDING, |d| changed(d, coincide)),
                region("no-length", NO_LENGTH, |d| changed(d, shorten)),
            ],
            check_points: vec![
                point("paper-row-0", paper_at(14.426f64.to_radians())),
                point("b-on-d", B_ON_D.to_vec()),
            ],
        }
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let linkage = i.geometry.solver()?;
        let found = linkage.assembly_modes(Angle::from_rad(i.phi1));
        if found.modes.is_empty() {
            return Err("cannot be assembled");
        }
        Ok(found.modes.iter().flat_map(|m| m.to_array()).collect())
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let linkage = linkage(i, bits)?;
        let modes = linkage.modes(&Ball::rational(bits, i.phi1))?;
        if modes.is_empty() {
            return Err(Uncertified::Refused("cannot be assembled"));
        }
        let mut values = Vec::new();
        for mode in &modes {
            values.extend(linkage.kinematics(&mode.configuration)?.angles);
        }
        Ok(ReferenceAnswer::bounded(values, PROOF))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions_at_reference::<Self>(numbers, BITS_OF_CONDITIONS)
    }

    /// By implicit differentiation, at the reference's angles.
    fn conditions_at(numbers: &[f64], values: &[Ball]) -> Option<Vec<f64>> {
        let bits = values.first()?.prec();
        let exact = exact(numbers)?;
        let i = Self::unpack(&exact)?;
        let linkage = linkage(i, bits).ok()?;
        let phi1 = Ball::rational(bits, i.phi1);
        let mut all = Vec::new();
        for angles in values.chunks(4) {
            let at = linkage.placed(&phi1, &angles[1], &angles[3]);
            all.extend(linkage.angle_conditions(&phi1, &at)?.map(Mag::to_f64));
        }
        Some(all)
    }

    fn laws() -> Vec<Law> {
        Vec::new()
    }
}

/// A random linkage whose geometry is changed.
fn changed(d: &mut Draw, change: fn(&mut Draw, &mut ClassIiiGeometry)) -> Vec<f64> {
    let numbers = random(d);
    let mut input = ClassIiiAssemblyModes::unpack(&numbers).expect("twelve numbers");
    change(d, &mut input.geometry);
    input.to_vec()
}

fn random(d: &mut Draw) -> Vec<f64> {
    let mut x: Vec<f64> = (0..6).map(|_| d.log_uniform(0.1, 1.0)).collect();
    x.push(d.uniform(-3.1, 3.1));
    for _ in 0..2 {
        let (r, a) = (d.uniform(0.05, 1.2), d.uniform(-3.1, 3.1));
        x.extend([r * libm::cos(a), r * libm::sin(a)]);
    }
    x.push(d.uniform(-3.1, 3.1));
    x
}
