//! The sections common to files of linkages of every type: motion of the crank, gravity, bodies.

use super::quantity::{AngularAcceleration, Quantity};
use super::source::{Refusal, Source};
use crate::reference::class_iii as exact;
use crate::reference::nearest_f64;
use crate::solvers::reduction::{Body, MomentOfInertia};
use crate::solvers::units::{Acceleration, Angle, AngularVelocity, Inertia, Length, Mass};
use rug::Rational;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// The motion of the crank.
#[derive(Clone, Debug)]
pub struct CrankMotion {
    /// Angular velocity.
    pub omega: Quantity<AngularVelocity>,
    /// Angular acceleration.
    pub epsilon: Quantity<AngularAcceleration>,
}

/// Named points on links, in the links' frames.
pub(super) type LinkPoints = BTreeMap<String, BTreeMap<String, [Quantity<Length>; 2]>>;

/// The file: what every type has, and its own sections of geometry, start and bodies.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File<G, S, B> {
    /// Read before the rest: [`Linkage::read`](super::Linkage::read).
    #[serde(rename = "type")]
    _type: Option<IgnoredAny>,
    pub name: Option<String>,
    gravity: Option<Quantity<Acceleration>>,
    crank_speed: Option<Quantity<AngularVelocity>>,
    crank_acceleration: Option<Quantity<AngularAcceleration>>,
    pub geometry: G,
    pub start: Option<S>,
    pub bodies: Option<B>,
    /// Of a four-bar linkage or slider-crank.
    #[serde(default)]
    pub points: LinkPoints,
    /// These belong to a run-up.
    #[serde(rename = "motor")]
    _motor: Option<IgnoredAny>,
    #[serde(rename = "load")]
    _load: Option<IgnoredAny>,
    #[serde(rename = "run")]
    _run: Option<IgnoredAny>,
}

impl<G, S, B> File<G, S, B> {
    /// Standard gravity unless the file gives another.
    pub fn gravity(&self) -> Quantity<Acceleration> {
        let standard = || Quantity::si(Rational::from((980_665, 100_000)));
        self.gravity.clone().unwrap_or_else(standard)
    }

    /// The motion of the crank, if given.
    pub fn crank(&self, source: &Source) -> Result<Option<CrankMotion>, Refusal> {
        match (&self.crank_speed, &self.crank_acceleration) {
            (Some(omega), epsilon) => {
                let none = || Quantity::si(Rational::new());
                Ok(Some(CrankMotion {
                    omega: omega.clone(),
                    epsilon: epsilon.clone().unwrap_or_else(none),
                }))
            }
            (None, None) => Ok(None),
            (None, Some(_)) => {
                Err(source.breach("crank_acceleration", "crank_acceleration needs crank_speed"))
            }
        }
    }
}

/// A body's section.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodySection {
    mass: Quantity<Mass>,
    inertia: Quantity<Inertia>,
    #[serde(default)]
    inertia_about: About,
    radius: Quantity<Length>,
    angle: Option<Quantity<Angle>>,
}

#[derive(Clone, Copy, Default, Deserialize)]
enum About {
    #[default]
    #[serde(rename = "centre of mass")]
    CentreOfMass,
    #[serde(rename = "pivot")]
    Pivot,
}

impl BodySection {
    /// The body, exactly.
    pub fn exact(&self) -> exact::Body {
        let none = exact::ExactAngle::Degrees(Rational::new());
        exact::Body {
            mass: self.mass.value.clone(),
            inertia: self.inertia.value.clone(),
            about_pivot: matches!(self.inertia_about, About::Pivot),
            radius: self.radius.value.clone(),
            angle: self.angle.as_ref().map_or(none, Quantity::exact_angle),
        }
    }
}

/// A link without mass.
pub(super) fn massless() -> exact::Body {
    exact::Body {
        mass: Rational::new(),
        inertia: Rational::new(),
        about_pivot: false,
        radius: Rational::new(),
        angle: exact::ExactAngle::Radians(Rational::new()),
    }
}

/// A body in floating point.
pub(super) fn rounded(b: &exact::Body) -> Body {
    let inertia = Inertia::from_kg_m2(nearest_f64(&b.inertia));
    Body {
        mass: Mass::from_kg(nearest_f64(&b.mass)),
        inertia: match b.about_pivot {
            true => MomentOfInertia::AboutPivot(inertia),
            false => MomentOfInertia::AboutCentreOfMass(inertia),
        },
        radius: Length::from_m(nearest_f64(&b.radius)),
        angle: match &b.angle {
            exact::ExactAngle::Radians(q) => Angle::from_rad(nearest_f64(q)),
            exact::ExactAngle::Degrees(q) => Angle::from_deg(nearest_f64(q)),
        },
    }
}
