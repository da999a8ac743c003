//! What ranks prove of a mechanism in the position in which it is drawn.

use super::bodies::{Bodies, Exact};
use super::file::{File, Kind};
use crate::reference::planar::{Drawing, DrawnPin, Frame, Freedom, Mobility};
use crate::solvers::planar::{GROUND, MechanismError};

/// A mechanism refused by its count, and what is proved of its drawing.
#[derive(Debug, thiserror::Error)]
#[error("{cause}; {proved}")]
pub(super) struct Special {
    #[source]
    cause: MechanismError,
    proved: String,
}

impl Special {
    pub(super) fn new(cause: MechanismError, freedom: &Freedom, bodies: &Bodies) -> Special {
        Special {
            cause,
            proved: words(freedom, &bodies.names),
        }
    }
}

/// The ranks at the drawing, where every moving body is drawn and every joint a pin.
pub(super) fn freedom(file: &File, bodies: &Bodies) -> Option<Freedom> {
    if !bodies.drawn.iter().all(|drawn| *drawn) {
        return None;
    }
    let mut pins = Vec::new();
    for joint in &file.joint {
        let name = joint.point.as_ref().filter(|_| joint.kind == Kind::Pin)?;
        let at = place(file, name)?;
        let frame = |body: usize| match body {
            GROUND => Frame::Ground,
            body => Frame::Body(body - 1),
        };
        let on: Vec<Frame> = bodies.all(name).iter().map(|p| frame(p.body)).collect();
        let (first, rest) = on.split_first()?;
        pins.extend(rest.iter().map(|other| DrawnPin {
            frames: [*first, *other],
            at: at.clone(),
        }));
    }
    let drawing = Drawing::new(bodies.names.len() - 1, pins).ok()?;
    Some(drawing.freedom())
}

/// Where a point is drawn; the ground's own points have to be there as well.
fn place(file: &File, name: &str) -> Option<Exact> {
    let exact = |[x, y]: &super::file::Place| [x.value.clone(), y.value.clone()];
    match (file.points.get(name), file.ground.points.get(name)) {
        (Some(at), Some(fixed)) if exact(at) != exact(fixed) => None,
        (at, fixed) => at.or(fixed).map(exact),
    }
}

/// One line about the drawing; `bodies` has the ground first.
pub(super) fn words(freedom: &Freedom, bodies: &[String]) -> String {
    let count = |n: usize| match n {
        1 => "one degree of freedom".into(),
        n => format!("{n} degrees of freedom"),
    };
    let moves = match freedom.mobility {
        Mobility::Locked => "nothing can move".into(),
        Mobility::Regular { freedoms } => count(freedoms),
        Mobility::Turning { most: 1 } => "it moves, with one degree of freedom".into(),
        Mobility::Turning { most } => format!("it moves, with at most {}", count(most)),
        Mobility::Undecided { most } => {
            format!("undecided whether it moves, with at most {}", count(most))
        }
    };
    let names = |of: &[usize]| -> String {
        let of: Vec<&str> = of.iter().map(|k| &*bodies[k + 1]).collect();
        of.join(", ")
    };
    let mut line = format!(
        "as drawn, proved: rank {} of {} equations for {} velocities, {moves}",
        freedom.rank, freedom.equations, freedom.velocities
    );
    if freedom.redundant() > 0 {
        let strained = names(&freedom.strained);
        line += &format!("; {} redundant among {strained}", freedom.redundant());
    }
    if freedom.movable.len() + 1 < bodies.len() && !freedom.movable.is_empty() {
        line += &format!("; can move: {}", names(&freedom.movable));
    }
    line
}
