//! The rules for each joint by itself.

use super::error::MechanismError;
use super::model::{Description, Drive, Guide, Joint, Point};
use crate::units::{Angle, Length};

/// Bodies at most, the ground included, and joints at most.
const MOST: usize = 200;

/// A name for the drive in messages.
pub(super) const DRIVE: &str = "the drive";

/// The checks of one part, whose name messages carry.
struct Checker<'a> {
    description: &'a Description,
    what: String,
}

impl Checker<'_> {
    fn finite(&self, part: &str, value: f64) -> Result<(), MechanismError> {
        match value.is_finite() {
            true => Ok(()),
            false => Err(MechanismError::NotFinite {
                what: format!("{part} of {}", self.what),
                value,
            }),
        }
    }

    fn body(&self, body: usize) -> Result<(), MechanismError> {
        let last = self.description.bodies.len() - 1;
        match body <= last {
            true => Ok(()),
            false => Err(MechanismError::NoSuchBody {
                what: self.what.clone(),
                body,
                last,
            }),
        }
    }

    fn point(&self, p: &Point) -> Result<(), MechanismError> {
        self.body(p.body)?;
        p.at.iter()
            .try_for_each(|x| self.finite("a coordinate", x.m()))
    }

    fn guide(&self, g: &Guide) -> Result<(), MechanismError> {
        self.point(&g.origin)?;
        self.finite("the direction", g.direction.rad())
    }

    fn two(&self, a: usize, b: usize) -> Result<(), MechanismError> {
        match a != b {
            true => Ok(()),
            false => Err(MechanismError::SameBody {
                what: self.what.clone(),
                body: self.description.bodies[a].clone(),
            }),
        }
    }

    fn slide(&self, joint: usize) -> Result<(), MechanismError> {
        match self.description.joints.get(joint).map(|j| &j.part) {
            Some(Joint::Slide { .. }) => Ok(()),
            _ => Err(MechanismError::NoSlide {
                what: self.what.clone(),
                joint,
            }),
        }
    }

    fn nonzero(&self, part: &str, value: f64) -> Result<(), MechanismError> {
        self.finite(part, value)?;
        match value != 0.0 {
            true => Ok(()),
            false => Err(MechanismError::Zero {
                what: format!("{part} of {}", self.what),
            }),
        }
    }

    fn joint(&self, joint: &Joint) -> Result<(), MechanismError> {
        match joint {
            Joint::Pin { points } => {
                points.iter().try_for_each(|p| self.point(p))?;
                if points.len() < 2 {
                    return Err(MechanismError::LonelyPin {
                        joint: self.what.clone(),
                        count: points.len(),
                    });
                }
                for (k, p) in points.iter().enumerate() {
                    points[..k]
                        .iter()
                        .try_for_each(|q| self.two(p.body, q.body))?;
                }
                Ok(())
            }
            Joint::Slide {
                slider,
                guide,
                turn,
            } => {
                self.point(slider)?;
                self.guide(guide)?;
                self.finite("the turn", turn.rad())?;
                self.two(slider.body, guide.origin.body)
            }
            Joint::Slot { pin, slot } => {
                self.point(pin)?;
                self.guide(slot)?;
                self.two(pin.body, slot.origin.body)
            }
            Joint::Gears {
                wheels: [a, b],
                carrier,
                ratio,
                phase,
            } => {
                [*a, *b, *carrier].iter().try_for_each(|&x| self.body(x))?;
                for (x, y) in [(a, b), (a, carrier), (b, carrier)] {
                    self.two(*x, *y)?;
                }
                self.nonzero("the ratio", *ratio)?;
                self.finite("the phase", phase.rad())
            }
            Joint::Rack {
                wheel,
                slide,
                radius,
                phase,
            } => {
                self.body(*wheel)?;
                self.slide(*slide)?;
                self.nonzero("the radius", radius.m())?;
                self.finite("the phase", phase.m())?;
                let Joint::Slide { slider, guide, .. } = &self.description.joints[*slide].part
                else {
                    unreachable!("a slide, as checked");
                };
                self.two(*wheel, slider.body)?;
                self.two(*wheel, guide.origin.body)
            }
        }
    }
}

/// Checks every part by itself.
pub(super) fn check(description: &Description) -> Result<(), MechanismError> {
    for (what, count) in [
        ("bodies", description.bodies.len()),
        ("joints", description.joints.len()),
    ] {
        if count > MOST {
            return Err(MechanismError::TooMany {
                what,
                count,
                most: MOST,
            });
        }
    }
    let checker = |what: &str| Checker {
        description,
        what: what.into(),
    };
    for joint in &description.joints {
        checker(&joint.name).joint(&joint.part)?;
    }
    let drive = checker(DRIVE);
    match description.drive {
        Drive::Angle { body, from } => {
            drive.body(body)?;
            drive.body(from)?;
            drive.two(body, from)
        }
        Drive::Displacement { joint } => drive.slide(joint),
    }
}

/// The largest coordinate of the joints, in metres.
pub(super) fn largest(description: &Description) -> Result<f64, MechanismError> {
    let size = |l: &Length| l.m().abs();
    let of = |joint: &Joint| -> f64 {
        let points: Vec<&Point> = match joint {
            Joint::Pin { points } => points.iter().collect(),
            Joint::Rack { radius, .. } => return size(radius),
            _ => {
                let guided = joint.guided();
                guided.map_or(Vec::new(), |(p, guide)| vec![p, &guide.origin])
            }
        };
        points
            .iter()
            .flat_map(|p| &p.at)
            .map(size)
            .fold(0.0, f64::max)
    };
    let largest_m = description
        .joints
        .iter()
        .map(|j| of(&j.part))
        .fold(0.0, f64::max);
    match (1e-100..=1e100).contains(&largest_m) {
        true => Ok(largest_m),
        false => Err(MechanismError::Size { largest_m }),
    }
}

/// A unit vector.
pub(super) fn unit(angle: Angle) -> num_complex::Complex64 {
    let (s, c) = angle.rad().sin_cos();
    num_complex::Complex64::new(c, s)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{four_bar, gears, slot};
    use super::*;

    #[test]
    fn as_many_bodies_and_joints_as_allowed() {
        let mut d = Description::new();
        while d.bodies.len() < MOST {
            d.body("more");
        }
        assert_eq!(check(&d), Ok(()));
        d.body("one too many");
        let error = MechanismError::TooMany {
            what: "bodies",
            count: MOST + 1,
            most: MOST,
        };
        assert_eq!(check(&d), Err(error));
    }

    #[test]
    fn slots_and_ratios_are_checked() {
        let plain = four_bar([0.1, 0.4, 0.3, 0.35]).description().clone();
        let with = |joint: Joint| {
            let mut d = plain.clone();
            d.joint("it", joint);
            check(&d)
        };
        let slot = |body: usize, direction: f64| {
            with(slot((1, [0.1, 0.0]), (body, [0.0, 0.0]), direction))
        };
        assert_eq!(slot(3, 0.5), Ok(()));
        assert!(matches!(
            slot(9, 0.5),
            Err(MechanismError::NoSuchBody { body: 9, .. })
        ));
        assert!(matches!(
            slot(3, f64::NAN),
            Err(MechanismError::NotFinite { .. })
        ));
        let gears = |ratio: f64| with(gears([1, 3], 0, ratio, 0.0));
        for ratio in [1.0, -0.5, 1e-300] {
            assert_eq!(gears(ratio), Ok(()));
        }
        assert!(matches!(gears(0.0), Err(MechanismError::Zero { .. })));
        assert!(matches!(
            gears(f64::INFINITY),
            Err(MechanismError::NotFinite { .. })
        ));
    }

    #[test]
    fn sizes_from_1e_100_to_1e100_metres() {
        let of = |x: f64| {
            let mut d = Description::new();
            let crank = d.body("crank");
            d.pin("O", &[(0, [x, 0.0]), (crank, [0.0, 0.0])]);
            largest(&d)
        };
        for x in [1.1e-100, 0.9e100, -1.0] {
            assert_eq!(of(x), Ok(x.abs()));
        }
        for x in [0.9e-100, 1.1e100, 0.0] {
            assert_eq!(of(x), Err(MechanismError::Size { largest_m: x }));
        }
    }
}
