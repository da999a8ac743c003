//! The file that describes a four-bar linkage or a slider-crank.

use super::fields::{CrankMotion, Written, crank_motion, in_degrees, may, need, parse};
use super::quantity::{Kind, Quantity, nearest};
use mechaudit::reference::Ball;
use mechaudit::reference::class_iii::ExactAngle;
use mechaudit::solvers::dyad::{Assembly, FourBar, SliderCrank};
use mechaudit::solvers::units::{Angle, Length};
use rug::Rational;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};

/// The types that are described here.
pub const TYPES: [&str; 2] = ["four-bar", "slider-crank"];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File<G> {
    #[serde(rename = "type")]
    kind: String,
    name: Option<String>,
    gravity: Option<Written>,
    crank_speed: Option<Written>,
    crank_acceleration: Option<Written>,
    geometry: Option<G>,
    start: Option<StartTable>,
    bodies: Option<IgnoredAny>,
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
struct StartTable {
    phi1: Option<Written>,
    assembly: Option<String>,
    #[serde(rename = "speed")]
    _speed: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FourBarTable {
    crank: Option<Written>,
    coupler: Option<Written>,
    rocker: Option<Written>,
    frame: Option<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SliderCrankTable {
    crank: Option<Written>,
    rod: Option<Written>,
    offset: Option<Written>,
    direction: Option<Written>,
}

/// The linkage itself, once as floating-point numbers and once exactly.
pub enum Shape {
    FourBar {
        solver: FourBar,
        /// Crank, coupler, rocker, frame in metres.
        exact: [Rational; 4],
    },
    SliderCrank {
        solver: SliderCrank,
        /// Crank, rod, offset in metres.
        exact: [Rational; 3],
        /// Direction of the guide.
        direction: Quantity,
    },
}

/// A linkage of one crank and one dyad, as described.
pub struct Dyad {
    pub name: Option<String>,
    pub shape: Shape,
    pub crank: Option<CrankMotion>,
    /// Crank angle of the first row in degrees.
    pub start: Option<Rational>,
    pub assembly: Assembly,
}

/// Reads the description of a linkage of one of the [`TYPES`].
pub fn read(kind: &str, text: &str, json: bool, with_bodies: bool) -> Result<Dyad, String> {
    if kind == TYPES[0] {
        File::check(parse(text, json)?, FourBarTable::shape, with_bodies)
    } else {
        File::check(parse(text, json)?, SliderCrankTable::shape, with_bodies)
    }
}

impl<G: DeserializeOwned> File<G> {
    fn check(
        self,
        shape: impl FnOnce(&G) -> Result<Shape, String>,
        with_bodies: bool,
    ) -> Result<Dyad, String> {
        if self.bodies.is_some() && !with_bodies {
            return Err(format!(
                "[bodies] is not possible with type = {:?} here: rows with masses are for class-iii only; runup takes them",
                self.kind
            ));
        }
        may(Kind::Acceleration, "gravity", &self.gravity)?;
        let table = self.geometry.as_ref();
        let table = table.ok_or("the table [geometry] is missing")?;
        let (phi1, assembly) = match &self.start {
            Some(start) => (
                may(Kind::Angle, "start.phi1", &start.phi1)?,
                start.assembly.as_deref(),
            ),
            None => (None, None),
        };
        Ok(Dyad {
            shape: shape(table)?,
            name: self.name,
            crank: crank_motion(&self.crank_speed, &self.crank_acceleration)?,
            start: phi1.as_ref().and_then(in_degrees),
            assembly: match assembly {
                None | Some("positive") => Assembly::Positive,
                Some("negative") => Assembly::Negative,
                Some(other) => {
                    return Err(format!(
                        "start.assembly = {other:?} must be \"positive\" or \"negative\""
                    ));
                }
            },
        })
    }
}

fn length(name: &str, written: &Option<Written>) -> Result<Rational, String> {
    need(Kind::Length, &format!("geometry.{name}"), written).map(|q| q.value)
}

fn metres(q: &Rational) -> Length {
    Length::from_m(nearest(q))
}

impl FourBarTable {
    fn shape(&self) -> Result<Shape, String> {
        let exact = [
            length("crank", &self.crank)?,
            length("coupler", &self.coupler)?,
            length("rocker", &self.rocker)?,
            length("frame", &self.frame)?,
        ];
        let [a, b, c, d] = exact.each_ref().map(metres);
        let solver = FourBar::new(a, b, c, d).map_err(|e| format!("geometry: {e}"))?;
        Ok(Shape::FourBar { solver, exact })
    }
}

impl SliderCrankTable {
    fn shape(&self) -> Result<Shape, String> {
        let zero = || Quantity::si(Rational::new());
        let offset = may(Kind::Length, "geometry.offset", &self.offset)?.unwrap_or_else(zero);
        let exact = [
            length("crank", &self.crank)?,
            length("rod", &self.rod)?,
            offset.value,
        ];
        let direction = may(Kind::Angle, "geometry.direction", &self.direction)?;
        let direction = direction.unwrap_or_else(zero);
        let [a, b, e] = exact.each_ref().map(metres);
        let delta = Angle::from_rad(direction.to_f64());
        let solver = SliderCrank::new(a, b, e, delta).map_err(|e| format!("geometry: {e}"))?;
        Ok(Shape::SliderCrank {
            solver,
            exact,
            direction,
        })
    }
}

impl Shape {
    /// The name of the type.
    pub fn kind(&self) -> &'static str {
        match self {
            Shape::FourBar { .. } => TYPES[0],
            Shape::SliderCrank { .. } => TYPES[1],
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

    /// The crank angle from the frame or from the guide, in radians, enclosed.
    pub fn relative(&self, degrees: &Rational, bits: u32) -> Ball {
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
    pub fn rational_cos_sin(&self, degrees: &Rational) -> (Option<Rational>, Option<Rational>) {
        match self.relative_degrees(degrees) {
            Some(psi) => (cosine(&psi), cosine(&(psi - 90u32))),
            None => (None, None),
        }
    }

    /// Whether the dyad is stretched, folded or out of reach, where that can be told exactly. At
    /// no other angle of a rational number of degrees is it stretched or folded: the condition is
    /// a rational value of the cosine (four-bar) or sine (slider-crank).
    pub fn exactly_beyond(&self, degrees: &Rational) -> bool {
        match (self, self.rational_cos_sin(degrees)) {
            (Shape::FourBar { exact, .. }, (Some(cos), _)) => {
                let [a, b, c, d] = exact;
                let span = Rational::from(a * a) + Rational::from(d * d)
                    - Rational::from(a * d) * cos * 2u32;
                span >= Rational::from(b + c).square() || span <= Rational::from(b - c).square()
            }
            (Shape::SliderCrank { exact, .. }, (_, Some(sin))) => {
                let [a, b, e] = exact;
                (Rational::from(e) - sin * a).abs() >= *b
            }
            _ => false,
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
mod tests {
    use super::cosine;
    use rug::Rational;

    #[test]
    fn rational_cosines_are_those_of_niven() {
        for k in -720..=720i32 {
            let x = f64::from(k).to_radians().cos();
            let near = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|r| (x - r).abs() < 1e-9);
            let found = cosine(&Rational::from(k));
            assert_eq!(found.is_some(), near.contains(&true), "{k}");
            if let Some(c) = found {
                assert!((c.to_f64() - x).abs() < 1e-9, "{k}");
            }
        }
        assert_eq!(cosine(&Rational::from((121, 2))), None);
    }
}
