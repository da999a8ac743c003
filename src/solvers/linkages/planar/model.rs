//! Bodies, joints and the drive, as they are given.

use crate::units::{Angle, Length};

/// The number of the ground among the bodies.
pub const GROUND: usize = 0;

/// A point fixed on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The body's number.
    pub body: usize,
    /// Its coordinates in the body's frame.
    pub at: [Length; 2],
}

impl Point {
    /// The point (x, y) of a body.
    pub fn new(body: usize, x: Length, y: Length) -> Point {
        Point { body, at: [x, y] }
    }

    /// The point (x, y) in metres of a body.
    pub fn from_m(body: usize, [x, y]: [f64; 2]) -> Point {
        Point::new(body, Length::from_m(x), Length::from_m(y))
    }
}

/// A directed line fixed on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    /// A point on it, from which displacements are counted.
    pub origin: Point,
    /// Its direction in the body's frame.
    pub direction: Angle,
}

/// Describes what holds bodies together.
#[derive(Clone, Debug, PartialEq)]
pub enum Joint {
    /// A revolute joint; all these points are one. Bodies are named once each.
    Pin {
        /// A point of each body.
        points: Vec<Point>,
    },
    /// A prismatic joint: a point stays on the guide, and the slider does not turn against it.
    Slide {
        /// The point of the slider.
        slider: Point,
        /// The guide.
        guide: Guide,
        /// The slider's angle less that of the guide's body.
        turn: Angle,
    },
    /// A pin in a slot: a point stays on the slot's line.
    Slot {
        /// The pin.
        pin: Point,
        /// The slot.
        slot: Guide,
    },
    /// Two wheels that roll on each other, seen from the carrier of their centres:
    /// `θ_second − θ_carrier = ratio (θ_first − θ_carrier) + phase`. The ratio is negative for
    /// wheels that turn against each other. The centres are pinned to the carrier by joints of
    /// their own.
    Gears {
        /// The wheels.
        wheels: [usize; 2],
        /// The body that carries their centres.
        carrier: usize,
        /// Turns of the second for one turn of the first.
        ratio: f64,
        /// Angle of the second where that of the first is zero.
        phase: Angle,
    },
    /// A wheel that rolls on a rack: `s = radius (θ_wheel − θ_guide) + phase`, with the
    /// displacement s of the slide that carries the rack.
    Rack {
        /// The wheel.
        wheel: usize,
        /// The number of the rack's [`Joint::Slide`].
        slide: usize,
        /// Pitch radius, negative if the rack moves against the guide as the wheel turns forward.
        radius: Length,
        /// Displacement where the wheel's angle is zero.
        phase: Length,
    },
}

impl Joint {
    /// The point and the guide of a slide or slot.
    pub fn guided(&self) -> Option<(&Point, &Guide)> {
        match self {
            Joint::Slide { slider, guide, .. } => Some((slider, guide)),
            Joint::Slot { pin, slot } => Some((pin, slot)),
            _ => None,
        }
    }
}

/// Describes what moves the mechanism: the coordinate that everything is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// The angle of a body, less that of another.
    Angle {
        /// The driven body.
        body: usize,
        /// The body that its angle is measured from.
        from: usize,
    },
    /// The displacement of a slide: of the slider's point from the guide's origin along the guide.
    Displacement {
        /// The number of the [`Joint::Slide`].
        joint: usize,
    },
}

/// A part with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named<T> {
    /// As messages call it.
    pub name: String,
    /// The part.
    pub part: T,
}

/// A mechanism as given. Body 0 is the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Names of the bodies, the ground first.
    pub bodies: Vec<String>,
    /// The joints.
    pub joints: Vec<Named<Joint>>,
    /// The drive.
    pub drive: Drive,
}

impl Description {
    /// Nothing but the ground and, at first, a drive to be replaced.
    pub fn new() -> Description {
        Description {
            bodies: vec!["ground".into()],
            joints: Vec::new(),
            drive: Drive::Angle {
                body: 1,
                from: GROUND,
            },
        }
    }

    /// Adds a body and returns its number.
    pub fn body(&mut self, name: impl Into<String>) -> usize {
        self.bodies.push(name.into());
        self.bodies.len() - 1
    }

    /// Adds a joint and returns its number.
    pub fn joint(&mut self, name: impl Into<String>, part: Joint) -> usize {
        let name = name.into();
        self.joints.push(Named { name, part });
        self.joints.len() - 1
    }

    /// Adds a pin through points given by body and coordinates in metres.
    pub fn pin(&mut self, name: impl Into<String>, points: &[(usize, [f64; 2])]) -> usize {
        let points = points.iter().map(|&(b, at)| Point::from_m(b, at)).collect();
        self.joint(name, Joint::Pin { points })
    }
}

impl Default for Description {
    fn default() -> Description {
        Description::new()
    }
}
