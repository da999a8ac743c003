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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Source;

    /// Velocities, equations and rank, what it means for motions, which bodies are held too often and which move if not all.
    #[test]
    fn a_drawing_is_told_in_one_line() {
        let bodies = ["ground", "a", "b", "c"].map(String::from);
        let line = |rank: usize, movable: &[usize], strained: &[usize], mobility: Mobility| {
            let freedom = Freedom {
                velocities: 9,
                equations: 8,
                rank,
                movable: movable.to_vec(),
                strained: strained.to_vec(),
                mobility,
            };
            let all = words(&freedom, &bodies);
            let due = format!("as drawn, proved: rank {rank} of 8 equations for 9 velocities, ");
            all.strip_prefix(&due).expect("ranks").to_string()
        };
        let all = &[0, 1, 2][..];
        for (found, due) in [
            (
                line(8, all, &[], Mobility::Regular { freedoms: 1 }),
                "one degree of freedom",
            ),
            (
                line(8, all, &[], Mobility::Regular { freedoms: 2 }),
                "2 degrees of freedom",
            ),
            (
                line(8, &[1, 2], &[], Mobility::Regular { freedoms: 1 }),
                "one degree of freedom; can move: b, c",
            ),
            (line(8, &[], &[], Mobility::Locked), "nothing can move"),
            (
                line(7, &[0], &[1, 2], Mobility::Turning { most: 1 }),
                "it moves, with one degree of freedom; 1 redundant among b, c; can move: a",
            ),
            (
                line(6, all, &[0, 2], Mobility::Turning { most: 3 }),
                "it moves, with at most 3 degrees of freedom; 2 redundant among a, c",
            ),
            (
                line(7, all, all, Mobility::Undecided { most: 1 }),
                "undecided whether it moves, with at most one degree of freedom; 1 redundant among a, b, c",
            ),
        ] {
            assert_eq!(found, due);
        }
    }

    fn ranks(text: &str) -> Option<Freedom> {
        let source = Source::toml(text);
        let file: File = source.parse().unwrap();
        freedom(&file, &Bodies::new(&source, &file).unwrap())
    }

    /// A pin of n bodies is n − 1 pairs; ranks are for pins and bodies that are drawn.
    #[test]
    fn ranks_are_those_of_drawn_pins() {
        let watt = include_str!("../../../examples/watt-1.toml");
        let found = ranks(watt).unwrap();
        let counts = (found.velocities, found.equations, found.rank);
        assert_eq!((counts, found.movable.len()), ((15, 14, 14), 5));
        // Three bodies at one point.
        let text = "points = { A = [\"0 m\", \"0 m\"], B = [\"1 m\", \"2 m\"], C = [\"2 m\", \"0 m\"] }\n\
                    drive = { body = \"a\" }\nground = { drawn = [\"A\", \"C\"] }\n\
                    body = [{ name = \"a\", drawn = [\"A\", \"B\"] }, { name = \"b\", drawn = [\"B\", \"C\"] }, { name = \"c\", drawn = [\"B\"] }]\n\
                    joint = [{ kind = \"pin\", point = \"A\" }, { kind = \"pin\", point = \"B\" }, { kind = \"pin\", point = \"C\" }]\n";
        let found = ranks(text).unwrap();
        assert_eq!((found.velocities, found.equations, found.rank), (9, 8, 8));
        assert_eq!(found.movable, [2]);
        // Points of the ground's own have to be where they are drawn.
        let own = text.replace(
            "ground = { drawn = [\"A\", \"C\"] }",
            "ground = { drawn = [\"C\"], points = { A = [\"0 m\", \"0 m\"] } }",
        );
        assert_eq!(ranks(&own), Some(found));
        for (from, to) in [
            ("A = [\"0 m\", \"0 m\"] } }", "A = [\"0 m\", \"1 mm\"] } }"),
            (
                "{ name = \"c\", drawn = [\"B\"] }",
                "{ name = \"c\", points = { B = [\"0 m\", \"0 m\"] } }",
            ),
            (
                "{ kind = \"pin\", point = \"A\" }",
                "{ kind = \"slot\", point = \"A\", body = \"a\", through = \"C\", direction = \"0 deg\" }",
            ),
            ("{ kind = \"pin\", point = \"A\" }", "{ kind = \"pin\" }"),
        ] {
            let other = own.replace(from, to);
            assert_ne!(other, own, "{from}");
            assert_eq!(ranks(&other), None, "{to}");
        }
    }
}
