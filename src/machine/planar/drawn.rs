//! The position in which a mechanism is drawn: the drive there, and what ranks prove of it.

use super::bodies::{Bodies, Exact};
use super::branch::wrapped;
use super::file::{File, Kind};
use crate::reference::nearest_f64;
use crate::reference::planar::{Drawing, DrawnPin, Frame, Freedom, Mobility};
use crate::solvers::planar::{Description, Drive, GROUND, MechanismError, Point};

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

/// The drive in the position drawn, in degrees or metres, where every moving body is drawn.
pub(super) fn drive(file: &File, bodies: &Bodies, description: &Description) -> Option<f64> {
    if !bodies.drawn.iter().all(|drawn| *drawn) {
        return None;
    }
    match description.drive {
        drive @ Drive::Angle { .. } => {
            Some(wrapped(super::offset(drive, &bodies.lines)).to_degrees())
        }
        Drive::Displacement { joint } => {
            let (point, guide) = description.joints.get(joint)?.part.guided()?;
            let [[x, y], [x0, y0]] = [seen(file, point)?, seen(file, &guide.origin)?];
            let (sin, cos) = guide.direction.rad().sin_cos();
            Some((x - x0) * cos + (y - y0) * sin)
        }
    }
}

/// Where a point of the ground or of a drawn body is in the drawing, whose axes are those of all
/// frames.
fn seen(file: &File, point: &Point) -> Option<[f64; 2]> {
    let origin = match point.body {
        GROUND => [0.0; 2],
        body => {
            let first = file.body.get(body - 1)?.drawn.first()?;
            let at = file.points.get(first)?;
            [0, 1].map(|i| nearest_f64(&at[i].value))
        }
    };
    Some([0, 1].map(|i| origin[i] + point.at[i].m()))
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
    use super::super::{Certifier, Columns, Machine, Reach, choose, values};
    use super::*;
    use crate::machine::Source;

    /// Velocities, equations and rank, what it means for motions, which bodies are held too often
    /// and which move if not all.
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

    fn read(text: &str) -> Machine {
        Machine::read(&Source::toml(text)).unwrap()
    }

    /// A crank of 30 mm and a rod of 50 mm that a slide on the ground's line through O drives,
    /// drawn at 40 mm.
    fn slide_driven(range: [u32; 2], slider: &str) -> Machine {
        let [from, to] = range;
        read(&format!(
            "type = \"planar\"\n[points]\nO = [\"0 mm\", \"0 mm\"]\nA = [\"0 mm\", \"30 mm\"]\n\
             B = [\"40 mm\", \"0 mm\"]\n[ground]\ndrawn = [\"O\"]\n\
             [[body]]\nname = \"crank\"\ndrawn = [\"O\", \"A\"]\n\
             [[body]]\nname = \"rod\"\ndrawn = [\"A\", \"B\"]\n\
             [[body]]\nname = \"slider\"\ndrawn = [\"B\"]\n\
             [[joint]]\nkind = \"pin\"\npoint = \"O\"\n[[joint]]\nkind = \"pin\"\npoint = \"A\"\n\
             [[joint]]\nkind = \"pin\"\npoint = \"B\"\n\
             [[joint]]\nkind = \"slide\"\nname = \"guide\"\nbody = \"slider\"\npoint = \"B\"\nthrough = \"O\"\n\
             direction = \"0 deg\"\n{slider}\
             [drive]\njoint = \"guide\"\nrange = [\"{from} mm\", \"{to} mm\"]\nstep = \"10 mm\"\n"
        ))
    }

    /// The drawing is the start of a drive by displacement too: its value, and which of the two
    /// modes. A slider drawn by one point may be turned on its guide. From there the branch reaches
    /// to 20 mm and 80 mm, where rod and crank are in line.
    #[test]
    fn a_slide_starts_as_drawn() {
        for slider in ["", "turn = \"90 deg\"\n"] {
            for range in [[30, 60], [20, 80], [50, 60]] {
                let machine = slide_driven(range, slider);
                let at = machine.start.at.unwrap();
                assert!((at - 0.04).abs() < 1e-15 && machine.start.drawn);
                let branch = choose(&machine, at, None).unwrap();
                assert_eq!(branch.modes, 2);
                let crank = machine.line(&branch.start, 1);
                assert!((crank - 90f64.to_radians()).abs() < 1e-12);
                let Reach::Part { low, high } = branch.reach else {
                    panic!("a range");
                };
                match range {
                    [20, 80] => {
                        assert!((low.unwrap().drive - 0.02).abs() < 1e-9);
                        assert!((high.unwrap().drive - 0.08).abs() < 1e-9);
                    }
                    _ => assert_eq!((low, high), (None, None)),
                }
                for drive in range.map(|mm| f64::from(mm) / 1000.0) {
                    let end = [0.02, 0.08].contains(&drive);
                    assert_eq!(branch.turned_to(&machine, drive).is_none(), end);
                    assert_eq!(branch.end_at(&machine, drive).is_some(), end);
                }
            }
        }
    }

    /// A four-bar linkage that the angle at its coupler's end drives: as drawn, and the same by
    /// lengths.
    fn coupler_rocker() -> [Machine; 2] {
        let joints =
            ["O", "A", "C", "D"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
        let end = format!(
            "{}[drive]\nbody = \"rocker\"\nfrom = \"coupler\"\n",
            joints.concat()
        );
        let drawn = format!(
            "type = \"planar\"\n[points]\nO = [\"0 mm\", \"0 mm\"]\nA = [\"30 mm\", \"40 mm\"]\n\
             C = [\"110 mm\", \"100 mm\"]\nD = [\"110 mm\", \"0 mm\"]\n[ground]\ndrawn = [\"O\", \"D\"]\n\
             [[body]]\nname = \"crank\"\ndrawn = [\"O\", \"A\"]\n\
             [[body]]\nname = \"coupler\"\ndrawn = [\"A\", \"C\"]\n\
             [[body]]\nname = \"rocker\"\ndrawn = [\"C\", \"D\"]\n{end}"
        );
        let lengths = format!(
            "type = \"planar\"\n[ground.points]\nO = [\"0 mm\", \"0 mm\"]\nD = [\"110 mm\", \"0 mm\"]\n\
             [[body]]\nname = \"crank\"\nends = [\"O\", \"A\"]\nlength = \"50 mm\"\n\
             [[body]]\nname = \"coupler\"\nends = [\"A\", \"C\"]\nlength = \"100 mm\"\n\
             [[body]]\nname = \"rocker\"\nends = [\"C\", \"D\"]\nlength = \"100 mm\"\n{end}\
             [start]\nat = \"-126.86989764584402 deg\"\nnear = {{ crank = \"53.13 deg\" }}\n"
        );
        [drawn, lengths].map(|text| read(&text))
    }

    /// An angle that is measured from another body is that between the two bodies' lines: at the
    /// start, at the folds, at every row, in certified digits.
    #[test]
    fn an_angle_from_another_body_is_that_between_lines() {
        let [drawn, lengths] = coupler_rocker();
        let branches = [&drawn, &lengths].map(|m| {
            let at = m.start.at.unwrap();
            assert!((at + 126.869_897_645_844_02).abs() < 1e-12, "{at}");
            choose(m, at.to_radians(), None).unwrap()
        });
        for branch in &branches {
            let Reach::Part { low, high } = branch.reach else {
                panic!("two folds");
            };
            for (end, due) in [(low, -145.084_793_753), (high, -73.739_795_292)] {
                assert!((end.unwrap().drive.to_degrees() - due).abs() < 1e-6);
            }
        }
        for degrees in [-140, -126, -100, -75] {
            let drive = f64::from(degrees).to_radians();
            let [a, b] = [(&drawn, &branches[0]), (&lengths, &branches[1])].map(|(m, branch)| {
                let state = m.solver.follow(&branch.start, m.inner(drive)).unwrap();
                let angle = m.line(&state, 3) - m.line(&state, 2);
                assert!(wrapped(angle - drive).abs() < 1e-12);
                let row = values(m, None, &state, Columns::default());
                let digits = Certifier::new(m, 15)
                    .unwrap()
                    .values(&degrees.into(), &state, false);
                for (digits, x) in digits.iter().zip(&row) {
                    let digits: f64 = digits.as_deref().expect("digits").parse().unwrap();
                    assert!((digits - x).abs() < 1e-9 * (1.0 + x.abs()));
                }
                row
            });
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{degrees}: {a} {b}");
            }
        }
    }
}
