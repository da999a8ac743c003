//! The parts of a mechanism in exact data.

use super::real::Real;
use crate::class_iii::ExactAngle;
use rug::Rational;

/// A point or a vector, in the unit of length of the mechanism.
pub type Point = [Rational; 2];

/// A point or a vector whose coordinates need not be fractions.
pub type Place = [Real; 2];

/// Describes what a point belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The ground; its coordinates are the mechanism's.
    Ground,
    /// A moving body, by its index; coordinates in its own axes.
    Body(usize),
}

impl Frame {
    /// The index of a moving body.
    pub(super) fn body(self) -> Option<usize> {
        match self {
            Frame::Ground => None,
            Frame::Body(i) => Some(i),
        }
    }
}

/// A point of a body or of the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// Whose point.
    pub frame: Frame,
    /// Where in it.
    pub point: Place,
}

impl Attachment {
    /// A point of a body.
    pub fn body<N: Into<Real>>(index: usize, point: [N; 2]) -> Attachment {
        Attachment {
            frame: Frame::Body(index),
            point: point.map(N::into),
        }
    }

    /// A point of the ground.
    pub fn ground<N: Into<Real>>(point: [N; 2]) -> Attachment {
        Attachment {
            frame: Frame::Ground,
            point: point.map(N::into),
        }
    }
}

/// A moving body. Mass and inertia are zero where only positions are asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Its name in messages.
    pub name: String,
    /// Mass.
    pub mass: Rational,
    /// Moment of inertia about the centre of mass.
    pub inertia: Rational,
    /// Centre of mass in the body's axes.
    pub centre: Point,
}

impl Body {
    /// A body without mass.
    pub fn massless(name: &str) -> Body {
        Body {
            name: name.into(),
            ..Body::default()
        }
    }
}

/// A joint. Several bodies on one pin are several pins at one point.
#[derive(Clone, Debug, PartialEq)]
pub enum Joint {
    /// The two points coincide: two equations.
    Pin {
        /// One point.
        a: Attachment,
        /// The other.
        b: Attachment,
    },
    /// Point b lies at `a + s d` with the direction d fixed in a's frame, and the axes of b's frame
    /// are those of a's turned by `turn`. Three equations and one coordinate: s, in units of |d|.
    Slide {
        /// A point of the guide.
        a: Attachment,
        /// The guide's direction d in the axes of a's frame; not zero.
        direction: Place,
        /// A point of the slider.
        b: Attachment,
        /// Angle from the axes of a's frame to those of b's.
        turn: ExactAngle,
    },
    /// Point b lies at `a + s d`: two equations and the coordinate s, in units of |d|.
    Slot {
        /// A point of the slot.
        a: Attachment,
        /// The slot's direction d in the axes of a's frame; not zero.
        direction: Place,
        /// The pin's centre.
        b: Attachment,
    },
    /// Gears whose centres a carrier holds: `ψ_b − ψ_c = ratio (ψ_a − ψ_c) + offset`, with ψ_c = 0
    /// where that is the ground.
    Gear {
        /// One gear.
        a: Frame,
        /// The other.
        b: Frame,
        /// Holds what holds the centres.
        carrier: Frame,
        /// Turns of b for one turn of a, as the carrier sees them; negative where they mesh
        /// outside.
        ratio: Rational,
        /// `ψ_b − ψ_c` at `ψ_a = ψ_c`.
        offset: ExactAngle,
    },
    /// Rack and pinion: `s = ratio (ψ − ψ_a) + offset` for the coordinate s of a slide with its
    /// guide on a.
    Rack {
        /// The pinion.
        pinion: Frame,
        /// The index of the joint that is the rack's slide.
        slide: usize,
        /// Travel for an angle of one radian.
        ratio: Rational,
        /// Travel at `ψ = ψ_a`.
        offset: Rational,
    },
}

impl Joint {
    /// Returns whether it brings a coordinate with it.
    pub(super) fn slides(&self) -> bool {
        matches!(self, Joint::Slide { .. } | Joint::Slot { .. })
    }
}

/// A linear form in the coordinates, which the drive holds at a given value: the angle of one body,
/// the difference of two angles, a displacement.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive(pub Vec<(usize, Rational)>);

impl Drive {
    /// The coordinate of that index.
    pub fn coordinate(index: usize) -> Drive {
        Drive(vec![(index, Rational::from(1))])
    }

    /// `x_b − x_a`: the angle of body b relative to body a.
    pub fn relative(a: usize, b: usize) -> Drive {
        Drive(vec![(a, Rational::from(-1)), (b, Rational::from(1))])
    }
}

/// Describes what makes a set of bodies and joints no mechanism of one degree of freedom.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MechanismError {
    /// An index is out of range.
    #[error("joint {joint} names a body or joint that does not exist")]
    Missing {
        /// The joint.
        joint: usize,
    },
    /// A joint between a frame and itself.
    #[error("joint {joint} joins a body to itself")]
    Itself {
        /// The joint.
        joint: usize,
    },
    /// A direction is zero.
    #[error("the direction of joint {joint} is zero")]
    Direction {
        /// The joint.
        joint: usize,
    },
    /// A mass or inertia is negative.
    #[error("body {0}: mass and inertia are not negative")]
    Negative(String),
    /// A body hangs on nothing.
    #[error("body {0} is not joined to the ground by pins, slides or slots")]
    Loose(String),
    /// Not one equation for every coordinate but one.
    #[error("{equations} equations for {coordinates} coordinates: {} degrees of freedom instead of one",
            *coordinates as i64 - *equations as i64)]
    Freedom {
        /// Angles and displacements.
        coordinates: usize,
        /// Equations of loops, slides, gears and racks.
        equations: usize,
    },
    /// The drive names a coordinate that does not exist, or none.
    #[error("the drive names no coordinate of the mechanism")]
    Drive,
}
