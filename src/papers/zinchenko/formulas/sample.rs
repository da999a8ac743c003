//! The paper's data and certified positions to try the formulas on.

use crate::papers::zinchenko::data;
use crate::reference::class_iii::{Body, Configuration, ExactAngle, Kinematics, Linkage, Masses};
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Working precision.
pub(super) const BITS: u32 = 224;

/// Rows of table 2 that the formulas are tried on: one in each sixth of the turn or so, with link
/// rates of either sign and both numbers of assembly modes.
pub(super) const ROWS: [u32; 5] = [6, 11, 22, 30, 41];

/// A number of the paper.
pub(super) fn number(text: &str) -> Rational {
    data::decimal(text)
}

/// A number as a ball.
pub(super) fn ball(text: &str) -> Ball {
    Ball::rational(BITS, &number(text))
}

/// Degrees as a ball of radians.
pub(super) fn degrees(angle: &Rational, bits: u32) -> Ball {
    ExactAngle::Degrees(angle.clone()).to_ball(bits)
}

/// Crank angle of a row in degrees.
pub(super) fn row_angle(row: u32) -> Rational {
    number(data::START_DEG) + Rational::from(data::STEP_DEG) * row
}

/// The linkage in metres.
pub(super) fn linkage(bits: u32) -> Linkage {
    Linkage::new(&data::geometry(), bits)
}

/// Row 0 on the paper's assembly mode.
pub(super) fn row_zero(linkage: &Linkage) -> Result<Configuration, Undecided> {
    data::start(linkage.bits()).map(|(_, q)| q)
}

/// Lengths in centimetres, φ_B in radians.
pub(super) struct Dimensions {
    pub l1: Ball,
    pub l2: Ball,
    pub l3: Ball,
    pub l4: Ball,
    pub l5: Ball,
    pub lb: Ball,
    pub phi_b: Ball,
    /// O3, O5.
    pub pivots: [[Ball; 2]; 2],
    /// Distance of the centres of mass 2 … 5 and their angle in radians.
    pub centres: [(Ball, Ball); 4],
}

/// Angles of links 1 to 5 with their derivatives by the crank angle, certified by a reference that
/// uses none of the paper's equations.
pub(super) struct Position {
    pub configuration: Configuration,
    pub kinematics: Kinematics,
    /// φ1 … φ5.
    pub phi: [Ball; 5],
    /// dφ/dφ1, the first being one.
    pub first: [Ball; 5],
    /// d²φ/dφ1², the first being zero.
    pub second: [Ball; 5],
}

/// What the formulas are tried on.
pub(super) struct Sample {
    pub linkage: Linkage,
    pub dimensions: Dimensions,
    pub positions: Vec<Position>,
}

impl Sample {
    /// Positions at [`ROWS`].
    pub(super) fn new() -> Result<Sample, Undecided> {
        let linkage = linkage(BITS);
        let mut here = row_zero(&linkage)?;
        let mut at = 0;
        let mut positions = Vec::new();
        for row in ROWS {
            let angle = |row| degrees(&row_angle(row), BITS);
            here = linkage
                .follow(&here, &angle(at), &angle(row))
                .ok_or_else(|| Undecided {
                    bits: BITS,
                    reason: format!("the branch could not be followed to row {row}"),
                })?;
            at = row;
            let k = linkage.kinematics(&here)?;
            let five = |first: Ball, rest: &[Ball; 4]| {
                let [a, b, c, d] = rest.clone();
                [first, a, b, c, d]
            };
            positions.push(Position {
                configuration: here.clone(),
                phi: five(angle(row), &k.angles),
                first: five(Ball::integer(BITS, 1), &k.first),
                second: five(Ball::integer(BITS, 0), &k.second),
                kinematics: k,
            });
        }
        let [l1, l2, l3, l4, l5, lb, x3, y3, x5, y5] = data::LENGTHS_CM.map(|l| ball(l.1));
        Ok(Sample {
            linkage,
            dimensions: Dimensions {
                l1,
                l2,
                l3,
                l4,
                l5,
                lb,
                phi_b: degrees(&number(data::PHI_B_DEG), BITS),
                pivots: [[x3, y3], [x5, y5]],
                centres: data::RECOVERED
                    .0
                    .map(|(r, a)| (ball(r), degrees(&number(a), BITS))),
            },
            positions,
        })
    }
}

/// How the moments of inertia of links 3 and 5 are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rockers {
    /// The printed value is about the fixed pivot.
    AboutPivot,
    /// The same links given by their moment about the centre of mass, `I − m s²`.
    Steiner,
    /// The printed value is about the centre of mass.
    AboutCentre,
}

/// The masses in kg, m; `crank` is I_1.
pub(super) fn masses(rockers: Rockers, crank: &Rational) -> Masses {
    let body = |i: usize| {
        let rocker = i == 1 || i == 3;
        let radius = number(data::RECOVERED.0[i].0) / 100;
        let mass = number(data::MASSES_KG[i]);
        let mut inertia = number(data::INERTIAS_KG_M2[i]);
        if rocker && rockers == Rockers::Steiner {
            inertia -= Rational::from(&radius * &radius) * &mass;
        }
        Body {
            mass,
            inertia,
            about_pivot: rocker && rockers == Rockers::AboutPivot,
            radius,
            angle: ExactAngle::Degrees(number(data::RECOVERED.0[i].1)),
        }
    };
    let first = Body {
        mass: Rational::new(),
        inertia: crank.clone(),
        about_pivot: true,
        radius: Rational::new(),
        angle: ExactAngle::Degrees(Rational::new()),
    };
    Masses {
        bodies: [first, body(0), body(1), body(2), body(3)],
        gravity: number(data::GRAVITY),
    }
}

/// m2 … m5, I1 … I5 and g as balls.
pub(super) struct Loads {
    pub m: [Ball; 4],
    pub i: [Ball; 5],
    pub g: Ball,
}

impl Loads {
    pub(super) fn new(crank: &Rational) -> Loads {
        let [a, b, c, d] = data::INERTIAS_KG_M2.map(ball);
        Loads {
            m: data::MASSES_KG.map(ball),
            i: [Ball::rational(BITS, crank), a, b, c, d],
            g: ball(data::GRAVITY),
        }
    }
}
