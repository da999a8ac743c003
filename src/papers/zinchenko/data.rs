//! The sand screen: the example's linkage, with its masses as printed and as recovered.

use crate::machine::{self, Source, class_iii::Linkage};
use crate::reference::class_iii::{self, Configuration, ExactAngle, Geometry, Masses};
use crate::reference::{Decimal, Undecided};
use crate::solvers::class_iii::{ClassIii, State};
use crate::solvers::{reduction, units::Angle};
use rug::Rational;
use std::sync::LazyLock;

/// Crank angle of row 0, in degrees.
pub(super) const START_DEG: &str = "14.426";
/// φ4 printed for row 0, in degrees: it selects the assembly mode.
const START_PHI4_DEG: &str = "22.558";
/// Angle between rows, in degrees.
const STEP_DEG: (i32, i32) = (15, 2);

/// Centres of mass of links 2 to 5 as printed, in centimetres and degrees: l_S2 = 0.53 l2,
/// l_S3 = 0.3 l3, l_S4 = 0.25 l_B (on C–B), l_S5 = 0.2 l5.
const PRINTED_CENTRES: [(&str, &str); 4] =
    [("55.12", "0"), ("18", "0"), ("5.5", "-39.3"), ("9.7", "0")];

/// The linkage with the recovered masses and its state at row 0. Lengths are read as centimetres:
/// the paper names no unit, and only centimetres reproduce its tables.
static SCREEN: LazyLock<(Box<Linkage>, State)> = LazyLock::new(|| {
    let text = include_str!("../../../examples/sand-screen.toml");
    let Ok(machine::Linkage::ClassIii(linkage)) = machine::Linkage::read(&Source::toml(text))
    else {
        unreachable!("the example is a linkage of class III")
    };
    let at = decimal(START_DEG);
    let branch = machine::class_iii::choose(&linkage.solver, &at, None, &linkage.start);
    let start = branch.expect("the paper's linkage can be assembled").start;
    (linkage, start)
});

pub(super) fn decimal(text: &str) -> Rational {
    Decimal::parse(text).expect("a decimal in the source").value
}

/// The dimensions, exactly, in metres.
pub fn geometry() -> Geometry {
    SCREEN.0.exact.clone()
}

/// The masses with the centres recovered from the tables, exactly: inertias of links 3 and 5 are
/// about their pivots, as formula (3) has them.
pub fn recovered() -> Masses {
    let masses = SCREEN.0.masses.as_ref();
    masses.expect("the example has masses").exact.clone()
}

/// The masses with the printed centres.
pub(super) fn printed() -> Masses {
    let mut masses = recovered();
    for (body, (radius, angle)) in masses.bodies[1..].iter_mut().zip(PRINTED_CENTRES) {
        body.radius = decimal(radius) / 100;
        body.angle = ExactAngle::Degrees(decimal(angle));
    }
    masses
}

/// Crank angle of a row (possibly fractional) in degrees.
pub fn row_angle(row: &Rational) -> ExactAngle {
    ExactAngle::Degrees(decimal(START_DEG) + Rational::from(STEP_DEG) * row)
}

/// The linkage with the recovered masses, as the solvers take them, and its state at the crank
/// angle of row 0.
pub fn solver_start() -> (ClassIii, reduction::Masses, State) {
    let (linkage, start) = &*SCREEN;
    let masses = linkage.masses.as_ref().expect("the example has masses");
    (linkage.solver, masses.solver, *start)
}

/// The states at `n` equally spaced crank angles from row 0.
pub(super) fn states(n: usize) -> Vec<State> {
    let (linkage, _, start) = solver_start();
    let angle = |j: usize| Angle::from_rad(start.phi1 + (360.0 * j as f64 / n as f64).to_radians());
    let all = linkage.sweep(&start, (0..n).map(angle));
    all.expect("the paper's crank turns fully")
}

/// The reference linkage and the certified configuration of row 0 on the paper's assembly mode:
/// the one whose φ4 rounds to the printed value.
///
/// # Errors
/// [`Undecided`] when the precision does not decide which one that is.
pub fn start(bits: u32) -> Result<(class_iii::Linkage, Configuration), Undecided> {
    let linkage = class_iii::Linkage::new(&geometry(), bits);
    let modes = linkage.modes(&row_angle(&Rational::new()).to_ball(bits))?;
    let printed = ExactAngle::Degrees(decimal(START_PHI4_DEG)).to_ball(bits);
    // Half a unit of the printed third decimal, in radians, is below 1e-5.
    let is_near = |phi4: &crate::reference::Ball| (phi4 - &printed).abs().upper() < 1e-5;
    match modes.into_iter().find(|m| is_near(&m.phi4)) {
        Some(mode) => Ok((linkage, mode.configuration)),
        None => Err(Undecided::new(
            bits,
            "no assembly mode has the printed phi4",
        )),
    }
}
