//! Triads (a ternary link on three binary ones, pins only) by the polynomial of [`class_iii`].
//!
//! [`class_iii`]: crate::class_iii

use super::chain::{Block, Chain, Closure, Entry, Spot};
use super::isotropic::wrapped;
use super::pose::Pose;
use crate::class_iii::{ClassIii, Geometry};
use crate::units::{Angle, Length};
use num_complex::Complex64;

/// A binary link of a triad.
#[derive(Clone, Copy, Debug)]
struct Leg {
    body: usize,
    /// On a known body.
    outer: Spot,
    /// The leg's ends in its own frame: at the known body and at the plate.
    own: [Complex64; 2],
    /// Its end in the plate's frame.
    plate: Complex64,
}

/// The bodies of a triad with their angles.
type Angles = [(usize, f64); 4];

/// A triad.
#[derive(Clone, Debug)]
pub(super) struct Triad {
    plate: usize,
    legs: [Leg; 3],
}

impl Triad {
    /// The triad that a group is, if it is one.
    pub(super) fn of(chain: &Chain, block: &Block) -> Option<Triad> {
        let pins = pins(chain, block)?;
        if block.bodies.len() != 4 || pins.len() != 6 {
            return None;
        }
        let inside = |b: usize| block.bodies.contains(&b);
        let outer = |p: &[Spot; 2]| !inside(p[0].body) || !inside(p[1].body);
        let end = |p: &[Spot; 2], body: usize| p.iter().find(|s| s.body == body).map(|s| s.at);
        let plate = *block.bodies.iter().find(|&&b| {
            let own = || pins.iter().filter(|p| end(p, b).is_some());
            own().count() == 3 && !own().any(outer)
        })?;
        let leg = |body: usize| -> Option<Leg> {
            let to_plate = pins
                .iter()
                .find(|p| end(p, body).is_some() && end(p, plate).is_some())?;
            let to_known = pins.iter().find(|p| end(p, body).is_some() && outer(p))?;
            Some(Leg {
                body,
                outer: *to_known.iter().find(|s| !inside(s.body))?,
                own: [end(to_known, body)?, end(to_plate, body)?],
                plate: end(to_plate, plate)?,
            })
        };
        let legs: Vec<Leg> = block
            .bodies
            .iter()
            .filter(|&&b| b != plate)
            .map(|&b| leg(b))
            .collect::<Option<_>>()?;
        Some(Triad {
            plate,
            legs: legs.try_into().ok()?,
        })
    }

    /// Angles of the bodies at every assembly mode, and whether modes are near merging; `None` for
    /// dimensions that the polynomial does not take.
    pub(super) fn modes(&self, pose: &Pose) -> Option<(Vec<Angles>, bool)> {
        let [two, three, five] = &self.legs;
        let length = |l: &Leg| (l.own[1] - l.own[0]).norm();
        let [a, o3, o5] = [two, three, five].map(|l| pose.at(l.outer));
        let (cd, cb) = (five.plate - three.plate, two.plate - three.plate);
        // The crank's pivot is anywhere, and its angle zero.
        let crank = length(two);
        let origin = a - crank;
        let m = Length::from_m;
        let (u3, u5) = (o3 - origin, o5 - origin);
        let linkage = ClassIii::new(Geometry {
            l1: m(crank),
            l2: m(crank),
            l3: m(length(three)),
            l4: m(cd.norm()),
            l5: m(length(five)),
            lb: m(cb.norm()),
            phi_b: Angle::from_rad((cb / cd).arg()),
            x3: m(u3.re),
            y3: m(u3.im),
            x5: m(u5.re),
            y5: m(u5.im),
        })
        .ok()?;
        let found = linkage.assembly_modes(Angle::from_rad(0.0));
        // A link's angle there is that of the line between its joints.
        let frame = |l: &Leg, angle: f64| wrapped(angle - (l.own[1] - l.own[0]).arg());
        let modes = found.modes.iter().map(|p| {
            [
                (two.body, frame(two, p.phi2)),
                (three.body, frame(three, p.phi3)),
                (five.body, frame(five, p.phi5)),
                (self.plate, wrapped(p.phi4 - cd.arg())),
            ]
        });
        Some((modes.collect(), found.near_fold))
    }
}

/// The pins of a group that has nothing else.
fn pins(chain: &Chain, block: &Block) -> Option<Vec<[Spot; 2]>> {
    let entries = block.bodies.iter().map(|&body| match chain.entries[body] {
        Entry::Pin { on, own } => Some([Spot { body, at: own }, on]),
        _ => None,
    });
    let closures = chain.closures[block.closures.clone()]
        .iter()
        .map(|c| match *c {
            Closure::Pin { a, b } => Some([a, b]),
            _ => None,
        });
    let free = block.bodies.iter().all(|&b| {
        chain.turns[b]
            .unknown
            .is_some_and(|k| block.unknowns.contains(&k))
    });
    free.then(|| entries.chain(closures).collect::<Option<Vec<_>>>())?
}
