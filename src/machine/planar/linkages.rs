//! Linkages of the types that have sections of their own, as bodies and joints in exact numbers.

use super::FurtherError;
use super::bodies::Bodies;
use super::file::{Drive, File, Joint, Kind};
use super::loads::ExactMass;
#[cfg(feature = "report")]
use crate::machine::class_iii;
use crate::machine::dyad::{Dyad, Shape};
use crate::machine::quantity::Quantity;
use crate::reference::class_iii::Body;
use crate::reference::nearest_f64;
use crate::reference::planar::{Place, Real};
use rug::Rational;

/// Bodies, joints, drive and masses of a mechanism.
pub(super) struct Parts {
    pub file: File,
    pub bodies: Bodies,
    pub masses: Vec<ExactMass>,
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
fn masses(names: &[&str], links: &[Body]) -> Result<Vec<ExactMass>, FurtherError> {
    let mut all = Vec::new();
    for (k, (name, link)) in names.iter().zip(links).enumerate() {
        let mut inertia = link.inertia.clone();
        let least = Rational::from(link.radius.square_ref()) * &link.mass;
        if link.about_pivot {
            if inertia < least {
                return Err(FurtherError::Inertia {
                    body: (*name).into(),
                    inertia: nearest_f64(&inertia),
                    least: nearest_f64(&least),
                });
            }
            inertia -= least;
        }
        if !(link.mass.is_zero() && inertia.is_zero()) {
            all.push(ExactMass {
                body: k + 1,
                mass: link.mass.clone(),
                inertia,
                centre: Real::unit(&link.angle).map(|x| x * &link.radius),
            });
        }
    }
    Ok(all)
}

/// The parts from the outlines of bodies, the ground first.
fn parts(
    mut file: File,
    name: &Option<String>,
    outlines: Vec<Outline>,
    links: &[Body],
) -> Result<Parts, FurtherError> {
    file.name.clone_from(name);
    let names: Vec<&str> = outlines[1..].iter().map(|o| o.0).collect();
    let named = outlines.iter().map(|o| (o.0.into(), o.1.clone()));
    Ok(Parts {
        masses: masses(&names, links)?,
        bodies: Bodies::of(named.collect()),
        file,
    })
}

/// The parts of a linkage of class III, the crank first.
#[cfg(feature = "report")]
pub(super) fn of_class_iii(linkage: &class_iii::Linkage) -> Result<Parts, FurtherError> {
    let g = &linkage.exact;
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
    parts(file("1", gravity, pins), &linkage.name, outlines, links)
}

/// The parts of a four-bar linkage or slider-crank. The frames of the links have their origin at
/// the joint nearer to the crank's pivot, that of the rocker at its own pivot, and x toward the
/// other joint.
pub(super) fn of_dyad(dyad: &Dyad) -> Result<Parts, FurtherError> {
    let [crank, middle, last] = dyad.shape.links();
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
    let mut outlines = vec![
        ("ground", vec![("O1", origin()), ground]),
        (crank, vec![("O1", origin()), ("A", along(a))]),
        (middle, vec![("A", origin()), ("B", along(b))]),
        (last, end),
    ];
    for (link, name, [x, y]) in &dyad.points {
        outlines[link + 1].1.push((name, place(x, y)));
    }
    let file = file(crank, &dyad.exact.gravity, joints);
    parts(file, &dyad.name, outlines, &dyad.exact.bodies)
}
