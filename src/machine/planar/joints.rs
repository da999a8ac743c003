//! Joints and drive.

use super::bodies::Bodies;
use super::file::{Drive as DriveSection, File, Joint as Section, Kind};
use crate::machine::quantity::{AngularAcceleration, Dimension, Quantity, Velocity};
use crate::machine::source::{Refusal, Source};
use crate::reference::nearest_f64;
use crate::solvers::planar::{Description, Drive, GROUND, Guide, Joint, Named, Point};
use crate::solvers::units::{Acceleration, Angle, AngularVelocity, Length};
use std::str::FromStr;

/// One section `[[joint]]`.
struct Reader<'a> {
    source: &'a Source,
    bodies: &'a Bodies,
    section: &'a Section,
    at: String,
}

/// Bodies, joints and drive, and the joints' names.
pub(super) fn read(
    source: &Source,
    file: &File,
    bodies: &Bodies,
) -> Result<(Description, Vec<String>), Refusal> {
    let mut joints: Vec<Named<Joint>> = Vec::new();
    for (k, section) in file.joint.iter().enumerate() {
        let at = format!("joint[{k}]");
        let reader = Reader {
            source,
            bodies,
            section,
            at,
        };
        let pinned = section.point.clone().filter(|_| section.kind == Kind::Pin);
        let name = section.name.clone().or(pinned);
        let name = name.unwrap_or_else(|| format!("{}-{}", section.kind.word(), k + 1));
        if joints.iter().any(|j| j.name == name) {
            let rule = format!(
                "{}: a joint with the name {name:?} stands before it",
                reader.at
            );
            return Err(source.breach(&reader.at, rule));
        }
        let part = reader.joint(&joints)?;
        joints.push(Named { name, part });
    }
    pinned(source, bodies, &joints)?;
    let drive = match &file.drive {
        Some(drive) => driven(source, drive, bodies, &joints)?,
        // Nothing holds a coordinate: no one looks at it.
        None => Description::new().drive,
    };
    let names = joints.iter().map(|j| j.name.clone()).collect();
    Ok((
        Description {
            bodies: bodies.names.clone(),
            joints,
            drive,
        },
        names,
    ))
}

/// Points of one name on several bodies have to be a pin, or one of them is meant to be another.
fn pinned(source: &Source, bodies: &Bodies, joints: &[Named<Joint>]) -> Result<(), Refusal> {
    for outline in bodies.outlines() {
        for (name, point) in &outline {
            let all = bodies.all(name);
            let held = |p: &Point| {
                joints.iter().any(|j| match &j.part {
                    Joint::Pin { points } => points.contains(p),
                    Joint::Slide {
                        slider: q, guide, ..
                    }
                    | Joint::Slot {
                        pin: q,
                        slot: guide,
                    } => p == q || *p == guide.origin,
                    _ => false,
                })
            };
            if all.len() > 1 && !held(point) {
                let names: Vec<&str> = all.iter().map(|p| &*bodies.names[p.body]).collect();
                let rule = format!(
                    "{} have a point {name:?}, and no joint holds that of {}",
                    names.join(" and "),
                    bodies.names[point.body]
                );
                return Err(source.breach("joint", rule));
            }
        }
    }
    Ok(())
}

impl Reader<'_> {
    fn breach(&self, rule: &str) -> Refusal {
        self.source.breach(&self.at, format!("{}: {rule}", self.at))
    }

    fn place(&self, key: &str) -> String {
        format!("{}.{key}", self.at)
    }

    /// A value that this kind of joint needs.
    fn needs<'v, T>(&self, key: &str, value: &'v Option<T>) -> Result<&'v T, Refusal> {
        value
            .as_ref()
            .ok_or_else(|| self.breach(&format!("a {} needs {key}", self.section.kind.word())))
    }

    fn body(&self, key: &str, value: &Option<String>) -> Result<usize, Refusal> {
        self.bodies
            .find(self.source, &self.place(key), self.needs(key, value)?)
    }

    /// No other keys than those of this kind.
    fn only(&self, keys: &[&str]) -> Result<(), Refusal> {
        let s = self.section;
        let given = [
            ("point", s.point.is_some()),
            ("body", s.body.is_some()),
            ("on", s.on.is_some()),
            ("through", s.through.is_some()),
            ("toward", s.toward.is_some()),
            ("direction", s.direction.is_some()),
            ("turn", s.turn.is_some()),
            ("wheels", s.wheels.is_some()),
            ("carrier", s.carrier.is_some()),
            ("teeth", s.teeth.is_some()),
            ("internal", s.internal.is_some()),
            ("phase", s.phase.is_some()),
            ("wheel", s.wheel.is_some()),
            ("slide", s.slide.is_some()),
            ("radius", s.radius.is_some()),
            ("offset", s.offset.is_some()),
        ];
        match given.iter().find(|(key, is)| *is && !keys.contains(key)) {
            None => Ok(()),
            Some((key, _)) => Err(self.source.breach(
                &self.place(key),
                format!("{}: a {} has no {key}", self.at, s.kind.word()),
            )),
        }
    }

    fn joint(&self, before: &[Named<Joint>]) -> Result<Joint, Refusal> {
        let s = self.section;
        match s.kind {
            Kind::Pin => {
                self.only(&["point"])?;
                let name = self.needs("point", &s.point)?;
                let points = self.bodies.all(name);
                match points.len() {
                    0 | 1 => Err(self.breach(&format!(
                        "point = {name:?} is on {} body; a pin joins all bodies that have the point",
                        points.len()
                    ))),
                    _ => Ok(Joint::Pin { points }),
                }
            }
            Kind::Slide | Kind::Slot => {
                let slide = s.kind == Kind::Slide;
                let keys = [
                    "point",
                    "body",
                    "on",
                    "through",
                    "toward",
                    "direction",
                    "turn",
                ];
                self.only(if slide { &keys } else { &keys[..6] })?;
                let body = self.body("body", &s.body)?;
                let point = self.point("point", body, self.needs("point", &s.point)?)?;
                let guide = self.guide()?;
                let turn = s.turn.as_ref().map_or(0.0, Quantity::to_f64);
                Ok(match slide {
                    true => Joint::Slide {
                        slider: point,
                        guide,
                        turn: Angle::from_rad(turn),
                    },
                    false => Joint::Slot {
                        pin: point,
                        slot: guide,
                    },
                })
            }
            Kind::Gears => {
                self.only(&["wheels", "carrier", "teeth", "internal", "phase"])?;
                let [a, b] = self.needs("wheels", &s.wheels)?;
                let wheel = |name| self.bodies.find(self.source, &self.place("wheels"), name);
                let wheels = [wheel(a)?, wheel(b)?];
                let carrier = match &s.carrier {
                    Some(_) => self.body("carrier", &s.carrier)?,
                    None => GROUND,
                };
                let [p, q] = *self.needs("teeth", &s.teeth)?;
                if p == 0 || q == 0 {
                    return Err(self.breach("teeth must be positive"));
                }
                let size = f64::from(p) / f64::from(q);
                let ratio = if s.internal == Some(true) {
                    size
                } else {
                    -size
                };
                let phase = s.phase.as_ref().map_or(0.0, Quantity::to_f64);
                Ok(Joint::Gears {
                    wheels,
                    carrier,
                    ratio,
                    phase: Angle::from_rad(phase),
                })
            }
            Kind::Rack => {
                self.only(&["wheel", "slide", "radius", "offset"])?;
                let wheel = self.body("wheel", &s.wheel)?;
                let name = self.needs("slide", &s.slide)?;
                let slide = before.iter().position(|j| j.name == *name).ok_or_else(|| {
                    self.breach(&format!("slide = {name:?} is no joint before it"))
                })?;
                let m = |q: &Quantity<Length>| Length::from_m(nearest_f64(&q.value));
                Ok(Joint::Rack {
                    wheel,
                    slide,
                    radius: m(self.needs("radius", &s.radius)?),
                    phase: s.offset.as_ref().map_or(Length::from_m(0.0), m),
                })
            }
        }
    }

    fn point(&self, key: &str, body: usize, name: &str) -> Result<Point, Refusal> {
        self.bodies.on(body, name).ok_or_else(|| {
            let place = self.place(key);
            let rule = format!(
                "{place} = {name:?} is no point of {}",
                self.bodies.names[body]
            );
            self.source.breach(&place, rule)
        })
    }

    /// The line on the body `on` through a point of it, in a direction or toward another point.
    fn guide(&self) -> Result<Guide, Refusal> {
        let s = self.section;
        let on = match &s.on {
            Some(_) => self.body("on", &s.on)?,
            None => GROUND,
        };
        let origin = self.point("through", on, self.needs("through", &s.through)?)?;
        let direction = match (&s.direction, &s.toward) {
            (Some(a), None) => a.to_f64(),
            (None, Some(name)) => {
                let to = self.point("toward", on, name)?;
                let [x, y] = [0, 1].map(|i| to.at[i].m() - origin.at[i].m());
                if x == 0.0 && y == 0.0 {
                    return Err(self.breach("through and toward are one point"));
                }
                y.atan2(x)
            }
            _ => return Err(self.breach("either direction or toward")),
        };
        Ok(Guide {
            origin,
            direction: Angle::from_rad(direction),
        })
    }
}

fn driven(
    source: &Source,
    d: &DriveSection,
    bodies: &Bodies,
    joints: &[Named<Joint>],
) -> Result<Drive, Refusal> {
    match (&d.body, &d.joint) {
        (Some(body), None) => {
            let body = bodies.find(source, "drive.body", body)?;
            let from = match &d.from {
                Some(name) => bodies.find(source, "drive.from", name)?,
                None => GROUND,
            };
            if d.range.is_some() || d.step.is_some() {
                let rule = "drive.range and drive.step are for a displacement; an angle has --from-deg, --to-deg and --step-deg";
                return Err(source.breach("drive", rule));
            }
            Ok(Drive::Angle { body, from })
        }
        (None, Some(name)) => match joints.iter().position(|j| j.name == *name) {
            Some(joint) => Ok(Drive::Displacement { joint }),
            None => {
                let rule = format!("drive.joint = {name:?} is no joint");
                Err(source.breach("drive.joint", rule))
            }
        },
        _ => Err(source.breach(
            "drive",
            "drive needs either body, whose angle it is, or joint, a slide",
        )),
    }
}

/// The motion of the drive.
pub(super) struct DriveMotion {
    pub speed: Option<[f64; 2]>,
    pub window: Option<[f64; 3]>,
}

/// A quantity whose dimension depends on the drive.
pub(super) fn quantity<D: Dimension>(
    source: &Source,
    at: &str,
    text: &str,
) -> Result<f64, Refusal> {
    exactly::<D>(source, at, text).map(|q| q.to_f64())
}

/// A quantity as written.
pub(super) fn exactly<D: Dimension>(
    source: &Source,
    at: &str,
    text: &str,
) -> Result<Quantity<D>, Refusal> {
    Quantity::<D>::from_str(text).map_err(|e| source.breach(at, format!("{at} = {e}")))
}

/// A value of the drive: degrees or metres.
pub(super) fn drive_value(
    source: &Source,
    at: &str,
    text: &str,
    rotary: bool,
) -> Result<f64, Refusal> {
    match rotary {
        true => {
            let angle = exactly::<Angle>(source, at, text)?.in_degrees();
            Ok(angle.map_or(f64::NAN, |d| nearest_f64(&d)))
        }
        false => quantity::<Length>(source, at, text),
    }
}

pub(super) fn drive(
    source: &Source,
    d: &DriveSection,
    rotary: bool,
) -> Result<DriveMotion, Refusal> {
    let speed = |text: &str| match rotary {
        true => quantity::<AngularVelocity>(source, "drive.speed", text),
        false => quantity::<Velocity>(source, "drive.speed", text),
    };
    let acceleration = |text: &str| match rotary {
        true => quantity::<AngularAcceleration>(source, "drive.acceleration", text),
        false => quantity::<Acceleration>(source, "drive.acceleration", text),
    };
    let speed = match (&d.speed, &d.acceleration) {
        (Some(w), None) => Some([speed(w)?, 0.0]),
        (Some(w), Some(e)) => Some([speed(w)?, acceleration(e)?]),
        (None, None) => None,
        (None, Some(_)) => {
            let rule = "drive.acceleration needs drive.speed";
            return Err(source.breach("drive.acceleration", rule));
        }
    };
    let window = match (&d.range, &d.step, rotary) {
        (_, _, true) => None,
        (Some([from, to]), Some(step), false) => {
            let [from, to, step] = [from, to, step].map(|q| nearest_f64(&q.value));
            let good = from.is_finite() && to.is_finite() && to >= from && step > 0.0;
            if !(good && (to - from) / step <= 1e6) {
                let rule = "drive.range must ascend, and drive.step be positive and give at most a million rows";
                return Err(source.breach("drive.range", rule));
            }
            Some([from, to, step])
        }
        _ => {
            let rule = "a drive by displacement needs range and step";
            return Err(source.breach("drive", rule));
        }
    };
    Ok(DriveMotion { speed, window })
}

#[cfg(test)]
mod tests;
