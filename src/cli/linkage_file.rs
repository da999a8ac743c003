//! The file that describes a linkage, in TOML or JSON. Every quantity is a string with its unit.

use super::dyad_file::{self, Dyad};
use super::failure::Failure;
use super::fields::{CrankMotion, Written, crank_motion, may, need, parse};
use super::quantity::{Kind, Quantity};
use mechaudit::reference::class_iii as exact;
use mechaudit::solvers::class_iii::{ClassIii, Geometry};
use mechaudit::solvers::reduction::{Body, Masses, MomentOfInertia};
use mechaudit::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use rug::Rational;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Files longer than this are not descriptions of a linkage.
const LONGEST_FILE: u64 = 1 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// Read in [`Head`].
    #[serde(rename = "type")]
    _kind: Option<String>,
    name: Option<String>,
    gravity: Option<Written>,
    crank_speed: Option<Written>,
    crank_acceleration: Option<Written>,
    geometry: Option<GeometryTable>,
    start: Option<StartTable>,
    #[serde(default)]
    bodies: BTreeMap<String, BodyTable>,
    /// These belong to `runup`.
    #[serde(rename = "motor")]
    _motor: Option<IgnoredAny>,
    #[serde(rename = "load")]
    _load: Option<IgnoredAny>,
    #[serde(rename = "run")]
    _run: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GeometryTable {
    l1: Option<Written>,
    l2: Option<Written>,
    l3: Option<Written>,
    l4: Option<Written>,
    l5: Option<Written>,
    lb: Option<Written>,
    phi_b: Option<Written>,
    x3: Option<Written>,
    y3: Option<Written>,
    x5: Option<Written>,
    y5: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StartTable {
    phi1: Option<Written>,
    phi4: Option<Written>,
    mode: Option<usize>,
    #[serde(rename = "speed")]
    _speed: Option<IgnoredAny>,
}

/// A body's table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyTable {
    pub mass: Option<Written>,
    inertia: Option<Written>,
    inertia_about: Option<String>,
    radius: Option<Written>,
    angle: Option<Written>,
}

/// Which branch is meant.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Crank angle at which the branch is chosen.
    pub phi1: Option<Quantity>,
    /// The mode with φ4 nearest to this.
    pub phi4: Option<Quantity>,
    /// The mode of this number, counted from 0 by φ4.
    pub mode: Option<usize>,
}

/// Masses for the solver and for the reference.
pub struct BothMasses {
    pub solver: Masses,
    pub exact: exact::Masses,
}

/// A linkage as described, once as floating-point numbers and once exactly.
pub struct Linkage {
    pub name: Option<String>,
    pub solver: ClassIii,
    pub exact: exact::Geometry,
    pub masses: Option<BothMasses>,
    pub crank: Option<CrankMotion>,
    pub start: Start,
}

/// A linkage of one of the known types.
pub enum Described {
    ClassIii(Box<Linkage>),
    Dyad(Box<Dyad>),
}

/// The type alone; everything else is read by the type's own table.
#[derive(Deserialize)]
struct Head {
    #[serde(rename = "type")]
    kind: Option<String>,
}

/// Reads the description in `path`, or on standard input if that is `-`.
pub fn read(path: &Path) -> Result<Described, Failure> {
    let (text, json) = text(path)?;
    described(&text, json, false)
        .map_err(|what| Failure::new(format!("{}: {what}", path.display())))
}

/// The text of a description and whether it is JSON.
pub fn text(path: &Path) -> Result<(String, bool), Failure> {
    let name = path.display().to_string();
    let about = |what: String| Failure::new(format!("{name}: {what}"));
    let bytes = bytes(path).map_err(|e| about(e.to_string()))?;
    if bytes.len() as u64 > LONGEST_FILE {
        return Err(about("the file is longer than 1 MiB".into()));
    }
    let text = String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        about(format!("the file is not UTF-8 text (at byte {at})"))
    })?;
    let text = text.trim_start_matches('\u{feff}');
    if text.trim().is_empty() {
        return Err(about("the file is empty".into()));
    }
    let json = match path.extension().and_then(|e| e.to_str()) {
        Some("json") => true,
        Some("toml") => false,
        _ => text.trim_start().starts_with('{'),
    };
    Ok((text.to_owned(), json))
}

/// Reads a description; a dyad may have bodies only where they are of use.
pub fn described(text: &str, json: bool, dyads_with_bodies: bool) -> Result<Described, String> {
    let head: Head = parse(text, json)?;
    match head.kind.as_deref() {
        None | Some("class-iii") => {
            let file: File = parse(text, json)?;
            Ok(Described::ClassIii(Box::new(file.check()?)))
        }
        Some(kind) if dyad_file::TYPES.contains(&kind) => Ok(Described::Dyad(Box::new(
            dyad_file::read(kind, text, json, dyads_with_bodies)?,
        ))),
        Some(other) => Err(format!(
            "type = {other:?} is not known here; write \"class-iii\", \"four-bar\" or \"slider-crank\""
        )),
    }
}

fn bytes(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if path == Path::new("-") {
        let input = std::io::stdin().lock();
        input.take(LONGEST_FILE + 1).read_to_end(&mut bytes)?;
    } else {
        let file = std::fs::File::open(path)?;
        file.take(LONGEST_FILE + 1).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

impl File {
    fn check(self) -> Result<Linkage, String> {
        let table = self
            .geometry
            .as_ref()
            .ok_or("the table [geometry] is missing")?;
        let (geometry, exact) = table.read()?;
        let gravity = may(Kind::Acceleration, "gravity", &self.gravity)?
            .unwrap_or_else(|| Quantity::si(Rational::from((980_665, 100_000))));
        let crank = crank_motion(&self.crank_speed, &self.crank_acceleration)?;
        Ok(Linkage {
            name: self.name.clone(),
            solver: ClassIii::new(geometry).map_err(|e| format!("geometry: {e}"))?,
            exact,
            masses: self.masses(&gravity)?,
            crank,
            start: self.start()?,
        })
    }

    fn start(&self) -> Result<Start, String> {
        let Some(table) = &self.start else {
            return Ok(Start::default());
        };
        let start = Start {
            phi1: may(Kind::Angle, "start.phi1", &table.phi1)?,
            phi4: may(Kind::Angle, "start.phi4", &table.phi4)?,
            mode: table.mode,
        };
        if start.phi4.is_some() && start.mode.is_some() {
            return Err("start.phi4 and start.mode exclude each other".into());
        }
        Ok(start)
    }

    fn masses(&self, gravity: &Quantity) -> Result<Option<BothMasses>, String> {
        if self.bodies.is_empty() {
            return Ok(None);
        }
        let nothing = || exact::Body {
            mass: Rational::new(),
            inertia: Rational::new(),
            about_pivot: false,
            radius: Rational::new(),
            angle: exact::ExactAngle::Radians(Rational::new()),
        };
        let mut bodies: [exact::Body; 5] = std::array::from_fn(|_| nothing());
        for (key, table) in &self.bodies {
            let link = match key.parse::<usize>() {
                Ok(k @ 1..=5) => k,
                _ => {
                    return Err(format!(
                        "[bodies.{key}]: links are numbered from 1 (crank) to 5"
                    ));
                }
            };
            bodies[link - 1] = table.read(&format!("bodies.{key}"))?;
        }
        let solver = Masses::new(
            bodies.clone().map(|b| rounded(&b)),
            Acceleration::from_m_per_s2(gravity.to_f64()),
        );
        Ok(Some(BothMasses {
            solver: solver.map_err(|e| format!("bodies: {e}"))?,
            exact: exact::Masses {
                bodies,
                gravity: gravity.value.clone(),
            },
        }))
    }
}

/// A body in floating point.
pub fn rounded(b: &exact::Body) -> Body {
    let si = super::quantity::nearest;
    let inertia = Inertia::from_kg_m2(si(&b.inertia));
    Body {
        mass: Mass::from_kg(si(&b.mass)),
        inertia: match b.about_pivot {
            true => MomentOfInertia::AboutPivot(inertia),
            false => MomentOfInertia::AboutCentreOfMass(inertia),
        },
        radius: Length::from_m(si(&b.radius)),
        angle: match &b.angle {
            exact::ExactAngle::Radians(q) => Angle::from_rad(si(q)),
            exact::ExactAngle::Degrees(q) => Angle::from_deg(si(q)),
        },
    }
}

impl GeometryTable {
    fn read(&self) -> Result<(Geometry, exact::Geometry), String> {
        let length = |field: &str, w: &Option<Written>| {
            need(Kind::Length, &format!("geometry.{field}"), w).map(|q| q.value)
        };
        let phi_b = need(Kind::Angle, "geometry.phi_b", &self.phi_b)?;
        let exact = exact::Geometry {
            l1: length("l1", &self.l1)?,
            l2: length("l2", &self.l2)?,
            l3: length("l3", &self.l3)?,
            l4: length("l4", &self.l4)?,
            l5: length("l5", &self.l5)?,
            lb: length("lb", &self.lb)?,
            phi_b: phi_b.exact_angle(),
            o3: [length("x3", &self.x3)?, length("y3", &self.y3)?],
            o5: [length("x5", &self.x5)?, length("y5", &self.y5)?],
        };
        let m = |q: &Rational| Length::from_m(super::quantity::nearest(q));
        let geometry = Geometry {
            l1: m(&exact.l1),
            l2: m(&exact.l2),
            l3: m(&exact.l3),
            l4: m(&exact.l4),
            l5: m(&exact.l5),
            lb: m(&exact.lb),
            phi_b: Angle::from_rad(phi_b.to_f64()),
            x3: m(&exact.o3[0]),
            y3: m(&exact.o3[1]),
            x5: m(&exact.o5[0]),
            y5: m(&exact.o5[1]),
        };
        Ok((geometry, exact))
    }
}

impl BodyTable {
    /// The body, exactly; `at` names the table.
    pub fn read(&self, at: &str) -> Result<exact::Body, String> {
        let field = |name: &str| format!("{at}.{name}");
        let about_pivot = match self.inertia_about.as_deref() {
            None | Some("centre of mass") => false,
            Some("pivot") => true,
            Some(other) => {
                return Err(format!(
                    "{at}.inertia_about = {other:?} must be \"centre of mass\" or \"pivot\""
                ));
            }
        };
        let angle = may(Kind::Angle, &field("angle"), &self.angle)?;
        Ok(exact::Body {
            mass: need(Kind::Mass, &field("mass"), &self.mass)?.value,
            inertia: need(Kind::Inertia, &field("inertia"), &self.inertia)?.value,
            about_pivot,
            radius: need(Kind::Length, &field("radius"), &self.radius)?.value,
            angle: angle.map_or(exact::ExactAngle::Degrees(Rational::new()), |q| {
                q.exact_angle()
            }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Result<Linkage, String> {
        match described(text, false, false)? {
            Described::ClassIii(linkage) => Ok(*linkage),
            Described::Dyad(_) => Err("not of class III".into()),
        }
    }

    const GOOD: &str = include_str!("../../examples/sand-screen.toml");

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
        let json = include_str!("../../examples/sand-screen.json");
        let json = parse::<File>(json, true).unwrap().check().unwrap();
        assert_eq!(json.exact, read_text(GOOD).unwrap().exact);
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
            let e = read_text(&text).err().unwrap();
            assert!(e.contains(part), "{from} → {to}: {e}");
            assert!(!e.contains('\n'), "{e}");
        }
    }
}
