//! A linkage of class III as its file describes it, its branches, and its rows in the user's
//! units: in floating point and as certified decimals.

mod branch;
mod certified;
mod columns;
mod motion;
mod path;

pub use branch::{Branch, BranchError, End, Reach, TURNS, choose, unassembled};
pub use certified::Certifier;
pub use columns::{names, values};
pub use motion::{motion, positions};
pub use path::path;

use super::quantity::Quantity;
use super::sections::{BodySection, CrankMotion, File, massless, rounded};
use super::source::{Refusal, Source};
use crate::reference::class_iii as exact;
use crate::reference::nearest_f64;
use crate::solvers::class_iii::{ClassIii, Geometry};
use crate::solvers::reduction::Masses;
use crate::solvers::units::{Acceleration, Angle, Length};
use rug::Rational;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GeometrySection {
    l1: Quantity<Length>,
    l2: Quantity<Length>,
    l3: Quantity<Length>,
    l4: Quantity<Length>,
    l5: Quantity<Length>,
    lb: Quantity<Length>,
    phi_b: Quantity<Angle>,
    x3: Quantity<Length>,
    y3: Quantity<Length>,
    x5: Quantity<Length>,
    y5: Quantity<Length>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StartSection {
    phi1: Option<Quantity<Angle>>,
    phi4: Option<Quantity<Angle>>,
    mode: Option<usize>,
    /// This belongs to a run-up.
    #[serde(rename = "speed")]
    _speed: Option<IgnoredAny>,
}

/// Which branch is meant.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Crank angle at which the branch is chosen.
    pub phi1: Option<Quantity<Angle>>,
    /// The mode with φ4 nearest to this.
    pub phi4: Option<Quantity<Angle>>,
    /// The mode of this number, counted from 0 by φ4.
    pub mode: Option<usize>,
}

/// Masses for the solver and for the reference.
pub struct BothMasses {
    /// In floating point.
    pub solver: Masses,
    /// Exactly.
    pub exact: exact::Masses,
}

/// A linkage as described, once as floating-point numbers and once exactly.
pub struct Linkage {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// In floating point.
    pub solver: ClassIii,
    /// Its dimensions in metres, exactly.
    pub exact: exact::Geometry,
    /// Where the file gives bodies.
    pub masses: Option<BothMasses>,
    /// Where the file gives the crank's speed.
    pub crank: Option<CrankMotion>,
    /// Which branch is meant.
    pub start: Start,
}

type Bodies = BTreeMap<String, BodySection>;

impl Linkage {
    /// Reads the description of a linkage of class III.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn read(source: &Source) -> Result<Linkage, Refusal> {
        let file: File<GeometrySection, StartSection, Bodies> = source.parse()?;
        if !file.points.is_empty() {
            let rule = "points of links are for type = \"four-bar\" and \"slider-crank\"";
            return Err(source.breach("points", rule));
        }
        let crank = file.crank(source)?;
        let (geometry, exact) = file.geometry.read();
        let solver = ClassIii::new(geometry).map_err(|e| source.refuse("geometry", e))?;
        let masses = match &file.bodies {
            Some(bodies) if !bodies.is_empty() => Some(masses(source, bodies, &file.gravity())?),
            _ => None,
        };
        let start = match file.start {
            None => Start::default(),
            Some(t) if t.phi4.is_some() && t.mode.is_some() => {
                let rule = "start.phi4 and start.mode exclude each other";
                return Err(source.breach("start.mode", rule));
            }
            Some(StartSection {
                phi1, phi4, mode, ..
            }) => Start { phi1, phi4, mode },
        };
        Ok(Linkage {
            name: file.name,
            solver,
            exact,
            masses,
            crank,
            start,
        })
    }

    /// The file's start angle in degrees.
    pub fn start_degrees(&self) -> Option<Rational> {
        self.start.phi1.as_ref()?.in_degrees()
    }
}

fn masses(
    source: &Source,
    sections: &Bodies,
    gravity: &Quantity<Acceleration>,
) -> Result<BothMasses, Refusal> {
    let mut bodies: [exact::Body; 5] = std::array::from_fn(|_| massless());
    for (key, section) in sections {
        let Ok(link @ 1..=5) = key.parse::<usize>() else {
            let rule = format!("[bodies.{key}]: links are numbered from 1 (crank) to 5");
            return Err(source.breach(&format!("bodies.{key}"), rule));
        };
        bodies[link - 1] = section.exact();
    }
    let solver = Masses::new(
        bodies.each_ref().map(rounded),
        Acceleration::from_m_per_s2(gravity.to_f64()),
    );
    Ok(BothMasses {
        solver: solver.map_err(|e| source.refuse("bodies", e))?,
        exact: exact::Masses {
            bodies,
            gravity: gravity.value.clone(),
        },
    })
}

impl GeometrySection {
    fn read(&self) -> (Geometry, exact::Geometry) {
        let q = |l: &Quantity<Length>| l.value.clone();
        let m = |l: &Quantity<Length>| Length::from_m(nearest_f64(&l.value));
        let geometry = Geometry {
            l1: m(&self.l1),
            l2: m(&self.l2),
            l3: m(&self.l3),
            l4: m(&self.l4),
            l5: m(&self.l5),
            lb: m(&self.lb),
            phi_b: Angle::from_rad(self.phi_b.to_f64()),
            x3: m(&self.x3),
            y3: m(&self.y3),
            x5: m(&self.x5),
            y5: m(&self.y5),
        };
        let exact = exact::Geometry {
            l1: q(&self.l1),
            l2: q(&self.l2),
            l3: q(&self.l3),
            l4: q(&self.l4),
            l5: q(&self.l5),
            lb: q(&self.lb),
            phi_b: self.phi_b.exact_angle(),
            o3: [q(&self.x3), q(&self.y3)],
            o5: [q(&self.x5), q(&self.y5)],
        };
        (geometry, exact)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine;

    fn read_text(text: &str) -> Result<Linkage, Refusal> {
        match machine::Linkage::read(&Source::toml(text))? {
            machine::Linkage::ClassIii(linkage) => Ok(*linkage),
            _ => unreachable!("of class III"),
        }
    }

    const GOOD: &str = include_str!("../../../examples/sand-screen.toml");

    #[test]
    fn the_example_is_read_exactly() {
        let l = read_text(GOOD).unwrap();
        assert_eq!(l.exact.l5, Rational::from((485, 1000)));
        assert_eq!(l.solver.geometry().l5.m(), 0.485);
        let masses = l.masses.unwrap();
        assert_eq!(masses.exact.bodies[3].mass, 550);
        assert!(masses.exact.bodies[2].about_pivot && !masses.exact.bodies[1].about_pivot);
        assert_eq!(masses.exact.gravity, Rational::from((981, 100)));
    }

    #[test]
    fn both_forms_give_the_same_geometry() {
        let json = include_str!("../../../examples/sand-screen.json");
        let json = Linkage::read(&Source::json(json)).unwrap();
        assert_eq!(json.exact, read_text(GOOD).unwrap().exact);
    }

    /// The angles at which there is a mode, in parts to a tenth of a degree.
    #[test]
    fn where_there_are_modes_is_said() {
        let linkage = |crank: &str| {
            let text = GOOD.replacen("\"10 cm\"", crank, 1);
            read_text(&text).unwrap().solver
        };
        let long = linkage("\"70 cm\"");
        let BranchError::NotHere { degrees, parts } = unassembled(&long, 12.5) else {
            panic!("assembled somewhere");
        };
        assert_eq!(degrees, 12.5);
        assert!(!parts.is_empty());
        let modes = |tenths: f64| {
            long.assembly_modes(Angle::from_deg(tenths / 10.0))
                .modes
                .len()
        };
        for [from, to] in parts.iter().map(|p| p.map(|x| (10.0 * x).round())) {
            assert!((0.0..3600.0).contains(&from) && from <= to && to < 3600.0);
            assert!(modes(from) > 0 && modes(to) > 0, "{from} {to}");
            assert!(modes(0.5 * (from + to)) > 0, "{from} {to}");
            assert!(from == 0.0 || modes(from - 1.0) == 0, "{from}");
            assert!(to == 3599.0 || modes(to + 1.0) == 0, "{to}");
        }
        for tenths in (5..3600).step_by(90) {
            let tenths = f64::from(tenths);
            let told = parts
                .iter()
                .any(|p| (10.0 * p[0]..=10.0 * p[1]).contains(&tenths));
            assert_eq!(told, modes(tenths) > 0, "{tenths}");
        }
        let nowhere = linkage("\"900 cm\"");
        assert!(matches!(unassembled(&nowhere, 0.0), BranchError::Nowhere));
    }

    #[test]
    fn refusals_name_the_field() {
        for (from, to, part) in [
            ("\"48.5 cm\"", "48.5", "geometry.l5 = \"48.5\" has no unit"),
            ("\"48.5 cm\"", "nan", "geometry.l5"),
            ("\"48.5 cm\"", "\"48.5 kg\"", "is not a length"),
            ("l5 =", "l6 =", "unknown field `l6`"),
            ("l5 = \"48.5 cm\"", "", "geometry.l5 is missing"),
            (
                "\"10 kg\"",
                "\"-10 kg\"",
                "mass of link 2 = -10 kg must not be negative",
            ),
            ("bodies.5", "bodies.6", "[bodies.6]"),
            (
                "\"centre of mass\"",
                "\"somewhere\"",
                "must be \"centre of mass\" or \"pivot\"",
            ),
            ("class-iii", "class-v", "type = \"class-v\""),
            ("[geometry]", "[geometri]", "geometri"),
            (
                "\"10 cm\" ",
                "\"0 cm\" ",
                "l1 = 0 m must be a positive length",
            ),
        ] {
            let text = GOOD.replacen(from, to, 1);
            assert_ne!(text, GOOD, "{from}");
            let e = read_text(&text).err().unwrap().to_string();
            assert!(e.contains(part), "{from} → {to}: {e}");
            assert!(!e.contains('\n'), "{e}");
        }
    }
}
