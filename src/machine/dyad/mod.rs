//! A four-bar linkage or a slider-crank as its file describes it, and its rows in the user's units:
//! in floating point and as certified decimals.

mod certified;
mod motion;
mod path;
mod range;
mod singular;
mod values;

pub use certified::{Proved, certified};
pub use motion::{drives, motion};
pub use path::{Position, path, position, range};
pub use range::{Dead, Turn, dead, swing, turn};
pub use singular::{Meeting, Reached, meetings};
pub use values::{ASSEMBLIES, Row, RowError, Values, floating, names, number, table};

use super::planar::{self, LinkPoint};
use super::quantity::Quantity;
use super::sections::{BodySection, CrankMotion, File, LinkPoints, massless, rounded};
use super::source::{Refusal, Source};
use crate::reference::class_iii::{self as exact, ExactAngle};
use crate::reference::{Ball, nearest_f64};
use crate::solvers::dyad::{Assembly, FourBar, SliderCrank};
use crate::solvers::reduction::Body;
use crate::solvers::units::{Acceleration, Angle, Length, Mass};
use rug::Rational;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StartSection {
    phi1: Option<Quantity<Angle>>,
    #[serde(default)]
    assembly: AssemblyName,
    /// This belongs to a run-up.
    #[serde(rename = "speed")]
    _speed: Option<IgnoredAny>,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum AssemblyName {
    #[default]
    Positive,
    Negative,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FourBarSection {
    crank: Quantity<Length>,
    coupler: Quantity<Length>,
    rocker: Quantity<Length>,
    frame: Quantity<Length>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FourBarBodies {
    crank: Option<BodySection>,
    coupler: Option<BodySection>,
    rocker: Option<BodySection>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SliderCrankSection {
    crank: Quantity<Length>,
    rod: Quantity<Length>,
    offset: Option<Quantity<Length>>,
    direction: Option<Quantity<Angle>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SliderCrankBodies {
    crank: Option<BodySection>,
    rod: Option<BodySection>,
    slider: Option<SliderSection>,
}

/// A slider does not turn: of a body's fields it has the mass only.
#[derive(Deserialize)]
struct SliderSection {
    mass: Quantity<Mass>,
}

/// The linkage itself, once as floating-point numbers and once exactly.
pub enum Shape {
    /// A four-bar linkage.
    FourBar {
        /// In floating point.
        solver: FourBar,
        /// Crank, coupler, rocker, frame in metres.
        exact: [Rational; 4],
        /// Crank, coupler and rocker, where the file gives bodies.
        bodies: Option<[Body; 3]>,
    },
    /// A slider-crank.
    SliderCrank {
        /// In floating point.
        solver: SliderCrank,
        /// Crank, rod, offset in metres.
        exact: [Rational; 3],
        /// Direction of the guide.
        direction: Quantity<Angle>,
        /// Crank and rod, and the slider's mass, where the file gives bodies.
        bodies: Option<([Body; 2], Mass)>,
    },
}

/// A linkage of one crank and one dyad, as described.
pub struct Dyad {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// The linkage itself.
    pub shape: Shape,
    /// Where the file gives the crank's speed.
    pub crank: Option<CrankMotion>,
    /// Standard gravity unless the file gives another.
    pub gravity: Acceleration,
    /// Crank angle of the first row in degrees.
    pub start: Option<Rational>,
    /// The assembly that is meant.
    pub assembly: Assembly,
    /// Named points on the links.
    pub points: Vec<LinkPoint>,
    /// The numbers of a motion.
    pub exact: ExactNumbers,
}

/// The numbers of a linkage's motion, exactly.
pub struct ExactNumbers {
    /// The links, the crank first; none where the file gives no bodies.
    pub bodies: Vec<exact::Body>,
    /// The acceleration of gravity in m/s², downwards.
    pub gravity: Rational,
    /// The crank angle of the first row.
    pub start: ExactAngle,
}

/// Reads the description of a four-bar linkage.
pub(super) fn four_bar(source: &Source) -> Result<Dyad, Refusal> {
    dyad(source, |g: &FourBarSection, b: Option<&FourBarBodies>| {
        let exact = [&g.crank, &g.coupler, &g.rocker, &g.frame].map(|l| l.value.clone());
        let [a, b_, c, d] = exact.each_ref().map(metres);
        let solver = FourBar::new(a, b_, c, d).map_err(|e| source.refuse("geometry", e))?;
        let links = b.map(|b| [&b.crank, &b.coupler, &b.rocker]);
        let links = links.filter(|l| l.iter().any(|b| b.is_some()));
        let links = links.map(|l| l.map(link));
        let shape = Shape::FourBar {
            solver,
            exact,
            bodies: links.as_ref().map(|l| l.each_ref().map(rounded)),
        };
        Ok((shape, links.into_iter().flatten().collect()))
    })
}

/// Reads the description of a slider-crank.
pub(super) fn slider_crank(source: &Source) -> Result<Dyad, Refusal> {
    dyad(
        source,
        |g: &SliderCrankSection, b: Option<&SliderCrankBodies>| {
            let offset = g
                .offset
                .as_ref()
                .map_or(Rational::new(), |l| l.value.clone());
            let exact = [g.crank.value.clone(), g.rod.value.clone(), offset];
            let direction = g.direction.clone();
            let direction = direction.unwrap_or_else(|| Quantity::si(Rational::new()));
            let [a, b_, e] = exact.each_ref().map(metres);
            let delta = Angle::from_rad(direction.to_f64());
            let solver =
                SliderCrank::new(a, b_, e, delta).map_err(|e| source.refuse("geometry", e))?;
            let b = b.filter(|b| b.crank.is_some() || b.rod.is_some() || b.slider.is_some());
            let links = b.map(|b| {
                let mut slider = massless();
                if let Some(section) = &b.slider {
                    slider.mass = section.mass.value.clone();
                }
                [link(&b.crank), link(&b.rod), slider]
            });
            let bodies = links.as_ref().map(|[crank, rod, slider]| {
                let mass = Mass::from_kg(nearest_f64(&slider.mass));
                ([rounded(crank), rounded(rod)], mass)
            });
            let shape = Shape::SliderCrank {
                solver,
                exact,
                direction,
                bodies,
            };
            Ok((shape, links.into_iter().flatten().collect()))
        },
    )
}

fn dyad<G: DeserializeOwned, B: DeserializeOwned>(
    source: &Source,
    shape: impl FnOnce(&G, Option<&B>) -> Result<(Shape, Vec<exact::Body>), Refusal>,
) -> Result<Dyad, Refusal> {
    let file: File<G, StartSection, B> = source.parse()?;
    let start = file.start.as_ref();
    let (shape, bodies) = shape(&file.geometry, file.bodies.as_ref())?;
    let angle = start.and_then(|s| s.phi1.as_ref());
    let none = || ExactAngle::Degrees(Rational::new());
    Ok(Dyad {
        crank: file.crank(source)?,
        points: points(source, &shape, &file.points)?,
        shape,
        gravity: Acceleration::from_m_per_s2(file.gravity().to_f64()),
        start: start.and_then(|s| s.phi1.as_ref()?.in_degrees()),
        assembly: match start.map_or(AssemblyName::Positive, |s| s.assembly) {
            AssemblyName::Positive => Assembly::Positive,
            AssemblyName::Negative => Assembly::Negative,
        },
        exact: ExactNumbers {
            bodies,
            gravity: file.gravity().value,
            start: angle.map_or_else(none, Quantity::exact_angle),
        },
        name: file.name,
    })
}

/// The section `[points]`: for each link its points by name, in the link's frame.
fn points(source: &Source, shape: &Shape, section: &LinkPoints) -> Result<Vec<LinkPoint>, Refusal> {
    let mut all: Vec<LinkPoint> = Vec::new();
    for (link, of_link) in section {
        let place = format!("points.{link}");
        let Some(body) = shape.links().iter().position(|name| name == link) else {
            let meant = crate::audit::did_you_mean(link, &shape.links());
            let names = shape.links().join(", ");
            let rule = format!(
                "points.{link} is no link{meant}: a {} has {names}",
                shape.type_name()
            );
            return Err(source.breach(&place, rule));
        };
        for (name, [x, y]) in of_link {
            planar::check_name(source, &place, name)?;
            if ["A", "B"].contains(&&**name) || all.iter().any(|p| p.1 == *name) {
                let rule = format!("{place}: the name {name:?} is taken");
                return Err(source.breach(&place, rule));
            }
            all.push((body, name.clone(), [x.value.clone(), y.value.clone()]));
        }
    }
    Ok(all)
}

fn metres(q: &Rational) -> Length {
    Length::from_m(nearest_f64(q))
}

/// A link without a section has no mass.
fn link(section: &Option<BodySection>) -> exact::Body {
    section.as_ref().map_or_else(massless, BodySection::exact)
}

impl Shape {
    /// The name of the type.
    pub fn type_name(&self) -> &'static str {
        match self {
            Shape::FourBar { .. } => "four-bar",
            Shape::SliderCrank { .. } => "slider-crank",
        }
    }

    /// The names of the links, the crank first.
    pub fn links(&self) -> [&'static str; 3] {
        match self {
            Shape::FourBar { .. } => ["crank", "coupler", "rocker"],
            Shape::SliderCrank { .. } => ["crank", "rod", "slider"],
        }
    }

    /// Returns true if the file gives bodies.
    pub fn has_bodies(&self) -> bool {
        match self {
            Shape::FourBar { bodies, .. } => bodies.is_some(),
            Shape::SliderCrank { bodies, .. } => bodies.is_some(),
        }
    }

    /// Which of the values are angles.
    pub(super) fn angles(&self) -> &'static [usize] {
        match self {
            Shape::FourBar { .. } => &[0, 1, 6],
            Shape::SliderCrank { .. } => &[1, 6],
        }
    }

    /// The crank angle from the frame or from the guide, in degrees; `None` where the guide's
    /// direction is given in radians.
    fn relative_degrees(&self, degrees: &Rational) -> Option<Rational> {
        match self {
            Shape::FourBar { .. } => Some(degrees.clone()),
            Shape::SliderCrank { direction: d, .. } => {
                (d.degrees || d.value == 0).then(|| Rational::from(degrees - &d.value))
            }
        }
    }

    /// The guide's direction in degrees, if multiples of 30° from it have a rational cosine or sine.
    fn rational_from(&self) -> Option<f64> {
        match self {
            Shape::SliderCrank { direction: d, .. } if d.degrees => Some(nearest_f64(&d.value)),
            Shape::SliderCrank { direction: d, .. } if d.value != 0 => None,
            _ => Some(0.0),
        }
    }

    /// The crank angle from the frame or from the guide, in radians, enclosed.
    pub(super) fn relative(&self, degrees: &Rational, bits: u32) -> Ball {
        let ball = |d: Rational| ExactAngle::Degrees(d).to_ball(bits);
        match (self.relative_degrees(degrees), self) {
            (Some(psi), _) => ball(psi),
            (None, Shape::SliderCrank { direction, .. }) => {
                ball(degrees.clone()) - direction.to_ball(bits)
            }
            (None, Shape::FourBar { .. }) => ball(degrees.clone()),
        }
    }

    /// Cosine and sine of that angle where they are known to be rational.
    pub(super) fn rational_cos_sin(
        &self,
        degrees: &Rational,
    ) -> (Option<Rational>, Option<Rational>) {
        match self.relative_degrees(degrees) {
            Some(psi) => (cosine(&psi), cosine(&(psi - 90u32))),
            None => (None, None),
        }
    }
}

/// The cosine of an angle in degrees if it is rational: by Niven's theorem only 0, ±1/2 and ±1
/// occur among rational angles.
fn cosine(degrees: &Rational) -> Option<Rational> {
    let turns = Rational::from(degrees / 360u32).floor();
    let rest = degrees - turns * 360u32;
    if *rest.denom() != 1 {
        return None;
    }
    match rest.numer().to_u32()? {
        0 => Some(Rational::from(1)),
        60 | 300 => Some(Rational::from((1, 2))),
        90 | 270 => Some(Rational::new()),
        120 | 240 => Some(Rational::from((-1, 2))),
        180 => Some(Rational::from(-1)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
