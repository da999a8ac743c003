//! Joints and drive by exact numbers, as certified digits need them.

use super::Machine;
use super::bodies::Bodies;
use super::certified::NotExact;
use super::file::{Drive, Joint as Section, Kind};
use crate::reference::class_iii::ExactAngle;
use crate::reference::nearest_f64;
use crate::reference::planar::{self as reference, Attachment, Frame, Place, Real};
use crate::solvers::planar::{Description, GROUND, Joint, Point};
use rug::Rational;

/// The numbers of a joint.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ExactJoint {
    /// A pin has points alone.
    Pin,
    /// A slide, or a slot, which has no turn.
    Guided {
        /// The guide's direction in the axes of its body, of length one.
        direction: [Real; 2],
        /// The slider's angle less that of the guide's body.
        turn: ExactAngle,
    },
    /// Gears.
    Gears { ratio: Rational, phase: ExactAngle },
    /// A rack; metres.
    Rack { radius: Rational, phase: Rational },
}

/// The numbers of all joints, in the file's order; `None` for a guide whose direction is not
/// determined. The file has been checked before.
pub(super) fn joints(sections: &[Section], bodies: &Bodies) -> Vec<Option<ExactJoint>> {
    sections.iter().map(|s| joint(s, bodies)).collect()
}

/// First value, last value and step of a drive by displacement, in metres.
pub(super) fn window(drive: &Option<Drive>) -> Option<[Rational; 3]> {
    let drive = drive.as_ref()?;
    let ([from, to], step) = (drive.range.as_ref()?, drive.step.as_ref()?);
    Some([from, to, step].map(|q| q.value.clone()))
}

fn joint(s: &Section, bodies: &Bodies) -> Option<ExactJoint> {
    let none = || ExactAngle::Degrees(Rational::new());
    Some(match s.kind {
        Kind::Pin => ExactJoint::Pin,
        Kind::Slide | Kind::Slot => ExactJoint::Guided {
            direction: direction(s, bodies)?,
            turn: s.turn.as_ref().map_or_else(none, |a| a.exact_angle()),
        },
        Kind::Gears => {
            let [first, second] = s.teeth?;
            let size = Rational::from((first, second));
            ExactJoint::Gears {
                ratio: if s.internal == Some(true) {
                    size
                } else {
                    -size
                },
                phase: s.phase.as_ref().map_or_else(none, |a| a.exact_angle()),
            }
        }
        Kind::Rack => {
            let metres = |q: &crate::machine::quantity::Quantity<_>| q.value.clone();
            ExactJoint::Rack {
                radius: s.radius.as_ref().map(metres)?,
                phase: s.offset.as_ref().map(metres).unwrap_or_default(),
            }
        }
    })
}

/// The unit vector along a guide.
fn direction(s: &Section, bodies: &Bodies) -> Option<[Real; 2]> {
    if let Some(angle) = &s.direction {
        return Some(Real::unit(&angle.exact_angle()));
    }
    let on = match &s.on {
        Some(name) => bodies.names.iter().position(|n| n == name)?,
        None => GROUND,
    };
    let place = |name: &Option<String>| bodies.place(on, name.as_deref()?);
    let [from, to] = [place(&s.through)?, place(&s.toward)?];
    let along = [0, 1].map(|i| {
        let mut way = to[i].clone();
        way += &-from[i].clone();
        way
    });
    Real::along(&along)
}

/// An angle in radians as a quantity is rounded.
pub(super) fn radians(a: &ExactAngle) -> f64 {
    match a {
        ExactAngle::Radians(q) => nearest_f64(q),
        ExactAngle::Degrees(q) => nearest_f64(q).to_radians(),
    }
}

/// The exact numbers of a description.
pub(super) struct Exact<'a> {
    pub description: &'a Description,
    /// The exact places of all points of each body.
    pub points: &'a [Vec<(Point, Option<Place>)>],
    pub joints: &'a [Option<ExactJoint>],
}

impl Machine {
    pub(super) fn exactly(&self) -> Exact<'_> {
        Exact {
            description: self.solver.description(),
            points: &self.exact,
            joints: &self.exact_joints,
        }
    }
}

/// The joints as the reference takes them.
pub(super) fn reference_joints(machine: &Exact) -> Result<Vec<reference::Joint>, NotExact> {
    let mut joints = Vec::new();
    // Where the parts of each joint begin; a pin of n bodies is n − 1 pairs.
    let mut first = Vec::new();
    let described = &machine.description.joints;
    for (joint, exact) in described.iter().zip(machine.joints) {
        first.push(joints.len());
        let Some(exact) = exact else {
            let joint = joint.name.clone();
            return Err(NotExact::Guide { joint });
        };
        match (&joint.part, exact.clone()) {
            (Joint::Pin { points }, _) => {
                for b in &points[1..] {
                    joints.push(reference::Joint::Pin {
                        a: attached(machine, &points[0])?,
                        b: attached(machine, b)?,
                    });
                }
            }
            (Joint::Slide { slider, guide, .. }, ExactJoint::Guided { direction, turn }) => {
                joints.push(reference::Joint::Slide {
                    a: attached(machine, &guide.origin)?,
                    direction,
                    b: attached(machine, slider)?,
                    turn,
                });
            }
            (Joint::Slot { pin, slot }, ExactJoint::Guided { direction, .. }) => {
                joints.push(reference::Joint::Slot {
                    a: attached(machine, &slot.origin)?,
                    direction,
                    b: attached(machine, pin)?,
                });
            }
            (
                Joint::Gears {
                    wheels, carrier, ..
                },
                ExactJoint::Gears { ratio, phase },
            ) => {
                joints.push(reference::Joint::Gear {
                    a: frame(wheels[0]),
                    b: frame(wheels[1]),
                    carrier: frame(*carrier),
                    ratio,
                    offset: phase,
                });
            }
            (Joint::Rack { wheel, slide, .. }, ExactJoint::Rack { radius, phase }) => {
                joints.push(reference::Joint::Rack {
                    pinion: frame(*wheel),
                    slide: first[*slide],
                    ratio: radius,
                    offset: phase,
                });
            }
            _ => unreachable!("the numbers are those of the file's joint"),
        }
    }
    Ok(joints)
}

pub(super) fn frame(body: usize) -> Frame {
    match body {
        GROUND => Frame::Ground,
        body => Frame::Body(body - 1),
    }
}

/// A point exactly.
pub(super) fn attached(machine: &Exact, point: &Point) -> Result<Attachment, NotExact> {
    let body = || machine.description.bodies[point.body].clone();
    let same = machine.points[point.body].iter().filter(|p| p.0 == *point);
    let mut places = same.map(|p| p.1.as_ref());
    let first = places
        .next()
        .flatten()
        .ok_or_else(|| NotExact::Sides { body: body() })?;
    // Two points that are one when rounded could be confused.
    if places.any(|other| other != Some(first)) {
        return Err(NotExact::Point { body: body() });
    }
    Ok(Attachment {
        frame: frame(point.body),
        point: first.clone(),
    })
}
