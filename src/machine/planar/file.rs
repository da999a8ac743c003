//! The sections of a mechanism's file.

use crate::machine::quantity::{
    Damping, Quantity, Stiffness, TorsionalStiffness, ViscousResistance,
};
use crate::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// Coordinates.
pub(super) type Place = [Quantity<Length>; 2];

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    /// Read before.
    #[serde(rename = "type")]
    _type: Option<IgnoredAny>,
    pub name: Option<String>,
    /// Standard gravity otherwise.
    pub gravity: Option<Quantity<Acceleration>>,
    /// −90 deg otherwise.
    pub gravity_direction: Option<Quantity<Angle>>,
    /// Points of the drawing.
    #[serde(default)]
    pub points: BTreeMap<String, Place>,
    #[serde(default)]
    pub ground: Ground,
    #[serde(default)]
    pub body: Vec<Body>,
    #[serde(default)]
    pub joint: Vec<Joint>,
    /// A file for a motion alone has none.
    pub drive: Option<Drive>,
    #[serde(default)]
    pub start: Start,
    pub motion: Option<Motion>,
    #[serde(default)]
    pub force: Vec<Force>,
    #[serde(default)]
    pub torque: Vec<Torque>,
    #[serde(default)]
    pub spring: Vec<Spring>,
    #[serde(default)]
    pub torsion_spring: Vec<TorsionSpring>,
    #[serde(default)]
    pub damper: Vec<Damper>,
    #[serde(default)]
    pub torsion_damper: Vec<TorsionDamper>,
    /// These belong to a run-up.
    #[serde(rename = "motor")]
    _motor: Option<IgnoredAny>,
    #[serde(rename = "load")]
    _load: Option<IgnoredAny>,
    #[serde(rename = "run")]
    _run: Option<IgnoredAny>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Ground {
    #[serde(default)]
    pub points: BTreeMap<String, Place>,
    #[serde(default)]
    pub drawn: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    pub name: String,
    /// In the body's own frame.
    #[serde(default)]
    pub points: BTreeMap<String, Place>,
    /// Points of the drawing that it has; its angle is that of the line from the first to the
    /// second.
    #[serde(default)]
    pub drawn: Vec<String>,
    /// Two points at a distance, or three with sides.
    #[serde(default)]
    pub ends: Vec<String>,
    pub length: Option<Quantity<Length>>,
    /// From the first end to the second, second to third, third to first.
    pub sides: Option<[Quantity<Length>; 3]>,
    /// True if the three ends follow one another clockwise.
    #[serde(default)]
    pub clockwise: bool,
    pub mass: Option<Quantity<Mass>>,
    pub inertia: Option<Quantity<Inertia>>,
    pub centre: Option<Place>,
}

#[derive(Clone, Copy, Default, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    #[default]
    Pin,
    Slide,
    Slot,
    Gears,
    Rack,
}

impl Kind {
    pub fn word(self) -> &'static str {
        match self {
            Kind::Pin => "pin",
            Kind::Slide => "slide",
            Kind::Slot => "slot",
            Kind::Gears => "gears",
            Kind::Rack => "rack",
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Joint {
    pub kind: Kind,
    pub name: Option<String>,
    // Pin: all bodies that have this point. Slide and slot: the point on the guide.
    pub point: Option<String>,
    pub body: Option<String>,
    pub on: Option<String>,
    pub through: Option<String>,
    pub toward: Option<String>,
    pub direction: Option<Quantity<Angle>>,
    pub turn: Option<Quantity<Angle>>,
    pub wheels: Option<[String; 2]>,
    pub carrier: Option<String>,
    pub teeth: Option<[u32; 2]>,
    pub internal: Option<bool>,
    pub phase: Option<Quantity<Angle>>,
    pub wheel: Option<String>,
    pub slide: Option<String>,
    pub radius: Option<Quantity<Length>>,
    pub offset: Option<Quantity<Length>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Drive {
    pub body: Option<String>,
    pub from: Option<String>,
    pub joint: Option<String>,
    pub speed: Option<String>,
    pub acceleration: Option<String>,
    /// Of a displacement: first and last value.
    pub range: Option<[Quantity<Length>; 2]>,
    pub step: Option<Quantity<Length>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Start {
    pub at: Option<String>,
    pub mode: Option<usize>,
    #[serde(default)]
    pub near: BTreeMap<String, Quantity<Angle>>,
    /// Of the drive, where a run-up or a motion begins.
    pub speed: Option<String>,
}

/// Where a motion begins, and what drives it by formulas.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Motion {
    /// As many coordinates as there are degrees of freedom, by the names of bodies and of slides.
    #[serde(default)]
    pub start: BTreeMap<String, Coordinate>,
    /// Bodies with the angles of their lines, near which they are.
    #[serde(default)]
    pub near: BTreeMap<String, Quantity<Angle>>,
    /// Names that the formulas may use, with their values as formulas.
    #[serde(default)]
    pub parameters: BTreeMap<String, String>,
    #[serde(default)]
    pub torque: Vec<TorqueLaw>,
    #[serde(default)]
    pub force: Vec<ForceLaw>,
    /// The motion ends where this formula changes its sign.
    pub until: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Coordinate {
    pub at: String,
    pub speed: Option<String>,
    /// The body that an angle is measured from.
    pub from: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorqueLaw {
    pub body: String,
    pub from: Option<String>,
    /// In N·m.
    pub formula: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ForceLaw {
    pub at: String,
    /// In N.
    pub x: Option<String>,
    pub y: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Force {
    pub at: String,
    pub direction: Quantity<Angle>,
    /// The body that the direction is fixed on.
    pub with: Option<String>,
    pub value: Option<String>,
    pub table: Option<Vec<[String; 2]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Torque {
    pub body: String,
    pub from: Option<String>,
    pub value: Option<String>,
    pub table: Option<Vec<[String; 2]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spring {
    pub ends: [String; 2],
    pub stiffness: Quantity<Stiffness>,
    pub length: Quantity<Length>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorsionSpring {
    pub body: String,
    pub from: Option<String>,
    pub stiffness: Quantity<TorsionalStiffness>,
    pub angle: Quantity<Angle>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Damper {
    pub ends: [String; 2],
    pub damping: Quantity<Damping>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorsionDamper {
    pub body: String,
    pub from: Option<String>,
    pub damping: Quantity<ViscousResistance>,
}
