//! Linkages of the types that have sections of their own, as bodies and joints in exact numbers.

use super::super::bodies::Bodies;
use super::super::exact::radians;
use super::super::file::{Drive, File, Joint, Kind};
use super::super::loads::ExactMass;
use super::start::{ExactGiven, Start};
use crate::machine::class_iii::{self, choose};
use crate::machine::dyad::{Dyad, Shape};
use crate::machine::linkage::Linkage;
use crate::machine::quantity::Quantity;
use crate::machine::run_up::start_speed;
use crate::machine::source::{Refusal, Source};
use crate::reference::class_iii::{Body, ExactAngle};
use crate::reference::planar::{Place, Real};
use crate::solvers::dyad::DyadError;
use crate::solvers::planar::GROUND;
use crate::solvers::planar::dynamics::Coordinate;
use crate::solvers::units::Angle;
use rug::Rational;

/// Bodies, joints, masses and start of a mechanism.
pub(super) struct Parts {
    pub file: File,
    pub bodies: Bodies,
    pub masses: Vec<ExactMass>,
    /// Where a motion begins, unless the sections of the file say it.
    pub start: Option<Start>,
}

/// A body's name with its points.
type Outline<'a> = (&'a str, Vec<(&'a str, Place)>);

fn place(x: &Rational, y: &Rational) -> Place {
    [x.clone().into(), y.clone().into()]
}

fn origin() -> Place {
    [Real::default(), Real::default()]
}

/// A point at a distance along a body's axis.
fn along(x: &Rational) -> Place {
    [x.clone().into(), Real::default()]
}

fn pin(point: &str) -> Joint {
    Joint {
        point: Some(point.into()),
        ..Joint::default()
    }
}

fn file(crank: &str, gravity: &Rational, joints: Vec<Joint>) -> File {
    let mut file = File::default();
    file.gravity = Some(Quantity::si(gravity.clone()));
    file.joint = joints;
    file.drive = Some(Drive {
        body: Some(crank.into()),
        ..Drive::default()
    });
    file
}

/// The masses of links whose frames have their origins at the joints that the radii are measured
/// from.
fn masses(source: &Source, names: &[&str], links: &[Body]) -> Result<Vec<ExactMass>, Refusal> {
    let mut all = Vec::new();
    for (k, (name, link)) in names.iter().zip(links).enumerate() {
        let mut inertia = link.inertia.clone();
        if link.about_pivot {
            inertia -= Rational::from(link.radius.square_ref()) * &link.mass;
        }
        if inertia < 0 {
            let at = format!("bodies.{name}");
            let rule = format!(
                "{at}.inertia about the pivot is less than the mass times the square of the radius"
            );
            return Err(source.breach(&at, rule));
        }
        if link.mass.is_zero() && inertia.is_zero() {
            continue;
        }
        all.push(ExactMass {
            body: k + 1,
            mass: link.mass.clone(),
            inertia,
            centre: Real::unit(&link.angle).map(|x| x * &link.radius),
        });
    }
    Ok(all)
}

/// The parts from a linkage's outlines; `near` holds the angles of its links behind the crank.
fn parts(
    source: &Source,
    mut file: File,
    name: Option<String>,
    outlines: Vec<Outline>,
    (links, angle, near): (&[Body], ExactAngle, Vec<f64>),
) -> Result<Parts, Refusal> {
    file.name = name;
    let names: Vec<&str> = outlines[1..].iter().map(|o| o.0).collect();
    let speed = start_speed(source)?;
    let crank = ExactGiven {
        coordinate: Coordinate::Angle {
            body: 1,
            from: GROUND,
        },
        value: angle,
        speed: match speed {
            Some(q) if q.degrees => ExactAngle::Degrees(q.value),
            Some(q) => ExactAngle::Radians(q.value),
            None => ExactAngle::Radians(Rational::new()),
        },
    };
    Ok(Parts {
        masses: masses(source, &names, links)?,
        start: Some(Start {
            given: vec![crank],
            near: (2..).zip(near).collect(),
            mode: None,
        }),
        bodies: Bodies::of(
            outlines
                .into_iter()
                .map(|(name, points)| (name.into(), points))
                .collect(),
        ),
        file,
    })
}

impl Parts {
    /// The parts of the mechanism that the file describes, of any type.
    pub(super) fn read(source: &Source) -> Result<Parts, Refusal> {
        if Linkage::is_planar(source)? {
            let file: File = source.parse()?;
            let bodies = Bodies::new(source, &file)?;
            return Ok(Parts {
                masses: super::super::loads::masses(source, &file)?,
                start: None,
                bodies,
                file,
            });
        }
        match Linkage::read(source)? {
            Linkage::ClassIii(linkage) => of_class_iii(source, &linkage),
            Linkage::Dyad(dyad) => of_dyad(source, &dyad),
            Linkage::Planar(_) => unreachable!("a planar mechanism is read above"),
        }
    }
}

fn of_class_iii(source: &Source, linkage: &class_iii::Linkage) -> Result<Parts, Refusal> {
    let g = &linkage.exact;
    let start = linkage.start_degrees().unwrap_or_default();
    let branch = choose(&linkage.solver, &start, None, &linkage.start);
    let branch = branch.map_err(|e| source.refuse("start", e))?;
    let p = branch.start.positions;
    let outlines = vec![
        (
            "ground",
            vec![
                ("O1", origin()),
                ("O3", place(&g.o3[0], &g.o3[1])),
                ("O5", place(&g.o5[0], &g.o5[1])),
            ],
        ),
        ("1", vec![("O1", origin()), ("A", along(&g.l1))]),
        ("2", vec![("A", origin()), ("B", along(&g.l2))]),
        ("3", vec![("O3", origin()), ("C", along(&g.l3))]),
        (
            "4",
            vec![
                ("C", origin()),
                ("D", along(&g.l4)),
                ("B", Real::unit(&g.phi_b).map(|x| x * &g.lb)),
            ],
        ),
        ("5", vec![("O5", origin()), ("D", along(&g.l5))]),
    ];
    let weightless = Rational::new();
    let (links, gravity) = match &linkage.masses {
        Some(masses) => (&masses.exact.bodies[..], &masses.exact.gravity),
        None => (&[][..], &weightless),
    };
    let pins = Vec::from(["O1", "O3", "O5", "A", "B", "C", "D"].map(pin));
    let angle = linkage.start.phi1.as_ref().map(Quantity::exact_angle);
    let near = [p.phi2, p.phi3, p.phi4, p.phi5].to_vec();
    let angle = angle.unwrap_or_else(|| ExactAngle::Degrees(Rational::new()));
    let file = file("1", gravity, pins);
    let name = linkage.name.clone();
    parts(source, file, name, outlines, (links, angle, near))
}

/// The angles of coupler and rocker, or of rod and slider, which does not turn.
fn links_of(dyad: &Dyad, crank: Angle) -> Result<Vec<f64>, DyadError> {
    Ok(match &dyad.shape {
        Shape::FourBar { solver, .. } => {
            let at = solver.position(crank, dyad.assembly)?;
            vec![at.coupler.angle.rad(), at.rocker.angle.rad()]
        }
        Shape::SliderCrank { solver, .. } => {
            let at = solver.position(crank, dyad.assembly)?;
            vec![at.rod.angle.rad(), 0.0]
        }
    })
}

fn of_dyad(source: &Source, dyad: &Dyad) -> Result<Parts, Refusal> {
    let [crank, middle, last] = dyad.shape.links();
    let angle = dyad.exact.start.clone();
    let near = links_of(dyad, Angle::from_rad(radians(&angle)));
    let near = near.map_err(|e| source.refuse("start", e))?;
    let mut joints = Vec::from(["O1", "A", "B"].map(pin));
    let (a, b, ground, end) = match &dyad.shape {
        Shape::FourBar { exact, .. } => {
            let [a, b, c, frame] = exact;
            joints.push(pin("O3"));
            let rocker = vec![("O3", origin()), ("B", along(c))];
            (a, b, ("O3", along(frame)), rocker)
        }
        Shape::SliderCrank {
            exact, direction, ..
        } => {
            let [a, b, offset] = exact;
            joints.push(Joint {
                kind: Kind::Slide,
                name: Some("guide".into()),
                point: Some("B".into()),
                body: Some(last.into()),
                through: Some("O3".into()),
                direction: Some(direction.clone()),
                ..Joint::default()
            });
            let [x, y] = Real::unit(&direction.exact_angle());
            let foot = [-y, x].map(|x| x * offset);
            (a, b, ("O3", foot), vec![("B", origin())])
        }
    };
    let outlines = vec![
        ("ground", vec![("O1", origin()), ground]),
        (crank, vec![("O1", origin()), ("A", along(a))]),
        (middle, vec![("A", origin()), ("B", along(b))]),
        (last, end),
    ];
    let file = file(crank, &dyad.exact.gravity, joints);
    let (name, links) = (dyad.name.clone(), &dyad.exact.bodies[..]);
    parts(source, file, name, outlines, (links, angle, near))
}
