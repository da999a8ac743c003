//! The input data of Zinchenko (2008): as printed, and as recovered from his tables.

use crate::reference::class_iii::{Body, ExactAngle, Geometry, Masses};
use crate::reference::{Decimal, class_iii};
use crate::solvers::class_iii as f64_linkage;
use crate::solvers::reduction::{self, MomentOfInertia};
use crate::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use rug::Rational;

/// Lengths as printed, in centimetres: the paper names no unit, and only centimetres reproduce its
/// tables.
pub(super) const LENGTHS_CM: [(&str, &str); 10] = [
    ("l1", "10"),
    ("l2", "104"),
    ("l3", "60"),
    ("l4", "64"),
    ("l5", "48.5"),
    ("lB", "22"),
    ("x3", "75"),
    ("y3", "93"),
    ("x5", "128.5"),
    ("y5", "103.5"),
];

/// φB as printed, in degrees.
pub const PHI_B_DEG: &str = "-39.3";
/// Crank angle of row 0, in degrees.
pub const START_DEG: &str = "14.426";
/// φ4 printed for row 0, in degrees: it selects the assembly mode.
pub const START_PHI4_DEG: &str = "22.558";
/// Masses of links 2 to 5 in kg, as printed.
pub const MASSES_KG: [&str; 4] = ["10", "5", "550", "3.5"];
/// Moments of inertia of links 2 to 5 in kg·m², as printed.
pub const INERTIAS_KG_M2: [&str; 4] = ["0.8", "0.5", "18", "0.2"];
/// Acceleration of gravity in m/s²; not printed.
pub const GRAVITY: &str = "9.81";
/// Angle between rows, in degrees.
pub const STEP_DEG: (i32, i32) = (15, 2);

/// Centre of mass of a link: radius in centimetres, angle in degrees from the link's axis.
pub type Polar = (&'static str, &'static str);

/// The centres of mass of links 2 to 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Centres(pub [Polar; 4]);

/// As printed: l_S2 = 0.53 l2, l_S3 = 0.3 l3, l_S4 = 0.25 l_B (on C–B), l_S5 = 0.2 l5.
pub const PRINTED: Centres = Centres([
    ("55.12", "0"),
    ("18", "0"),
    ("5.5", PHI_B_DEG),
    ("9.7", "0"),
]);

/// As recovered from the tables (see the recovery).
pub const RECOVERED: Centres = Centres([("50", "0"), ("30", "0"), ("25", "-12"), ("20", "0")]);

pub(super) fn decimal(text: &str) -> Rational {
    Decimal::parse(text).expect("a decimal in the source").value
}

fn metres(cm: &str) -> Rational {
    decimal(cm) / 100
}

fn length(name: &str) -> Rational {
    let found = LENGTHS_CM.iter().find(|l| l.0 == name);
    metres(found.expect("a known length").1)
}

/// The dimensions, exactly, in metres.
pub fn geometry() -> Geometry {
    Geometry {
        l1: length("l1"),
        l2: length("l2"),
        l3: length("l3"),
        l4: length("l4"),
        l5: length("l5"),
        lb: length("lB"),
        phi_b: ExactAngle::Degrees(decimal(PHI_B_DEG)),
        o3: [length("x3"), length("y3")],
        o5: [length("x5"), length("y5")],
    }
}

/// The masses, exactly: inertias of links 3 and 5 about their pivots as formula (3) has them.
pub fn masses(centres: Centres) -> Masses {
    let nothing = || Body {
        mass: Rational::new(),
        inertia: Rational::new(),
        about_pivot: true,
        radius: Rational::new(),
        angle: ExactAngle::Degrees(Rational::new()),
    };
    let body = |i: usize| Body {
        mass: decimal(MASSES_KG[i]),
        inertia: decimal(INERTIAS_KG_M2[i]),
        about_pivot: i == 1 || i == 3,
        radius: metres(centres.0[i].0),
        angle: ExactAngle::Degrees(decimal(centres.0[i].1)),
    };
    Masses {
        bodies: [nothing(), body(0), body(1), body(2), body(3)],
        gravity: decimal(GRAVITY),
    }
}

/// Crank angle of a row (possibly fractional) in degrees.
pub fn row_angle(row: &Rational) -> ExactAngle {
    let step = Rational::from(STEP_DEG);
    ExactAngle::Degrees(decimal(START_DEG) + step * row)
}

fn nearest(text: &str) -> f64 {
    text.parse().expect("a decimal in the source")
}

/// The dimensions for the f64 solver.
///
/// # Panics
/// Never: the paper's geometry is valid.
pub fn solver_linkage() -> f64_linkage::ClassIii {
    let cm = |name: &str| {
        let found = LENGTHS_CM.iter().find(|l| l.0 == name);
        Length::from_cm(nearest(found.expect("a known length").1))
    };
    let geometry = f64_linkage::Geometry {
        l1: cm("l1"),
        l2: cm("l2"),
        l3: cm("l3"),
        l4: cm("l4"),
        l5: cm("l5"),
        lb: cm("lB"),
        phi_b: Angle::from_deg(nearest(PHI_B_DEG)),
        x3: cm("x3"),
        y3: cm("y3"),
        x5: cm("x5"),
        y5: cm("y5"),
    };
    f64_linkage::ClassIii::new(geometry).expect("the paper's geometry is valid")
}

/// The linkage with the recovered masses, as the solvers take them, and its state at the crank
/// angle of row 0.
///
/// # Panics
/// Never: the paper's linkage can be assembled there.
pub fn solver_start() -> (f64_linkage::ClassIii, reduction::Masses, f64_linkage::State) {
    let linkage = solver_linkage();
    let phi1 = Angle::from_deg(14.426);
    let mode = linkage.assembly_modes(phi1).modes[2];
    let start = linkage.state_near(phi1, mode).expect("closed");
    (linkage, MassParameters::new(RECOVERED).masses(), start)
}

/// Everything about the masses that the tables may determine, as plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassParameters {
    /// Masses of links 2 to 5, kg.
    pub mass: [f64; 4],
    /// Inertias of links 2 to 5, kg·m².
    pub inertia: [f64; 4],
    /// Centres of mass of links 2 to 5 along and across the link, m.
    pub centre: [[f64; 2]; 4],
    /// Gravity, m/s².
    pub gravity: f64,
}

impl MassParameters {
    /// The printed masses and inertias with these centres of mass.
    pub fn new(centres: Centres) -> MassParameters {
        MassParameters {
            mass: MASSES_KG.map(nearest),
            inertia: INERTIAS_KG_M2.map(nearest),
            centre: centres.0.map(|(r, a)| {
                let (r, a) = (nearest(r) / 100.0, nearest(a).to_radians());
                [r * a.cos(), r * a.sin()]
            }),
            gravity: nearest(GRAVITY),
        }
    }

    /// The same for the f64 solver.
    ///
    /// # Panics
    /// When a mass is negative or not finite.
    pub fn masses(&self) -> reduction::Masses {
        let body = |i: usize| {
            let j = Inertia::from_kg_m2(self.inertia[i]);
            let [x, y] = self.centre[i];
            reduction::Body {
                mass: Mass::from_kg(self.mass[i]),
                inertia: if i == 1 || i == 3 {
                    MomentOfInertia::AboutPivot(j)
                } else {
                    MomentOfInertia::AboutCentreOfMass(j)
                },
                radius: Length::from_m(x.hypot(y)),
                angle: Angle::from_rad(y.atan2(x)),
            }
        };
        let crank = reduction::Body {
            mass: Mass::from_kg(0.0),
            inertia: MomentOfInertia::AboutPivot(Inertia::from_kg_m2(0.0)),
            radius: Length::from_m(0.0),
            angle: Angle::from_rad(0.0),
        };
        let bodies = [crank, body(0), body(1), body(2), body(3)];
        reduction::Masses::new(bodies, Acceleration::from_m_per_s2(self.gravity))
            .expect("masses of the paper are valid")
    }
}

/// The reference linkage and the certified configuration of row 0 on the paper's assembly mode:
/// the one whose φ4 rounds to the printed value.
///
/// # Errors
/// [`crate::reference::Undecided`] when the precision does not decide which one that is.
pub fn start(
    bits: u32,
) -> Result<(class_iii::Linkage, class_iii::Configuration), crate::reference::Undecided> {
    let linkage = class_iii::Linkage::new(&geometry(), bits);
    let phi1 = row_angle(&Rational::new()).to_ball(bits);
    let printed = ExactAngle::Degrees(decimal(START_PHI4_DEG)).to_ball(bits);
    // Half a unit of the printed third decimal, in radians, is below 1e-5.
    let mode = linkage
        .modes(&phi1)?
        .into_iter()
        .find(|m| (&m.phi4 - &printed).abs().upper() < 1e-5);
    let mode = mode.ok_or_else(|| crate::reference::Undecided {
        bits,
        reason: "no assembly mode has the printed phi4".into(),
    })?;
    Ok((linkage, mode.configuration))
}
