//! Triads (a ternary link on three binary ones, pins only) by the polynomial of [`class_iii`].
//!
//! [`class_iii`]: crate::class_iii

use super::chain::{Block, Chain, Closure, Entry, Spot};
use super::plane::wrapped;
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

#[cfg(test)]
mod tests {
    use super::super::mechanism::Mechanism;
    use super::super::model::{Description, GROUND};
    use super::super::tests::{Random, class_iii, double_butterfly, four_bar, slider_crank, turn};

    /// A triad whose bodies have their pins anywhere in their frames, the bodies in this order:
    /// links to the crank and to two points of the ground, and the ternary body; `flipped` lists
    /// the points of each pin the other way round.
    fn triad(random: &mut Random, order: [usize; 4], flipped: bool) -> Mechanism {
        let mut d = Description::new();
        let crank = d.body("crank");
        let mut numbers = [0; 4];
        for k in order {
            numbers[k] = d.body(["two", "three", "five", "plate"][k]);
        }
        let plate = numbers[3];
        let mut pin = |a: (usize, [f64; 2]), b: (usize, [f64; 2])| {
            d.pin("pin", &if flipped { [b, a] } else { [a, b] });
        };
        pin((GROUND, [0.0, 0.0]), (crank, [0.0, 0.0]));
        let bases = [
            (crank, [0.1, 0.05]),
            (GROUND, [0.75, 0.93]),
            (GROUND, [1.285, 1.035]),
        ];
        let on_plate = [[0.15, -0.12], [0.0, 0.1], [0.55, 0.2]];
        let lengths = [1.0, 0.6, 0.5];
        for k in 0..3 {
            let [x, y] = std::array::from_fn(|_| random.between(-0.3, 0.3));
            let angle = random.between(-3.0, 3.0);
            let end = [x + lengths[k] * angle.cos(), y + lengths[k] * angle.sin()];
            pin(bases[k], (numbers[k], [x, y]));
            pin((numbers[k], end), (plate, on_plate[k]));
        }
        Mechanism::new(d).unwrap()
    }

    /// The homotopy gives the same modes.
    #[test]
    fn triads_in_any_frames_and_order() {
        let mut random = Random(5);
        let mut seen = 0;
        for order in [[0, 1, 2, 3], [3, 2, 1, 0], [1, 3, 0, 2], [2, 0, 3, 1]] {
            for flipped in [false, true] {
                let mut m = triad(&mut random, order, flipped);
                assert!(m.triads[0].is_none() && m.triads[1].is_some());
                let found = m.assembly_modes(0.6);
                m.triads.fill(None);
                let due = m.assembly_modes(0.6);
                assert!(found.complete && due.complete);
                assert_eq!(found.states.len(), due.states.len());
                for (a, b) in found.states.iter().zip(&due.states) {
                    let apart = a.pose.u.iter().zip(&b.pose.u).map(|(x, y)| turn(*x, *y));
                    assert!(apart.fold(0.0, f64::max) < 1e-9);
                }
                // The polynomial's own angles close the loops before any correction.
                let triad = triad_of(&m);
                for pose in due.states.iter().map(|s| &s.pose) {
                    let (angles, _) = triad.modes(pose).unwrap();
                    assert_eq!(angles.len(), due.states.len());
                    let near = |all: &super::Angles| {
                        let off =
                            |&(body, angle): &(usize, f64)| turn(pose.angle(&m.chain, body), angle);
                        all.iter().map(off).fold(0.0, f64::max) < 1e-9
                    };
                    assert_eq!(angles.iter().filter(|a| near(a)).count(), 1);
                    seen += 1;
                }
            }
        }
        assert!(seen >= 16, "{seen}");
    }

    fn triad_of(m: &Mechanism) -> super::Triad {
        super::Triad::of(&m.chain, &m.chain.blocks[1]).unwrap()
    }

    #[test]
    fn other_groups_are_none() {
        let none = |m: Mechanism| m.triads.iter().all(Option::is_none);
        assert!(none(four_bar([0.1, 0.4, 0.3, 0.35])));
        assert!(none(slider_crank([0.1, 0.3, 0.02])));
        assert!(none(double_butterfly()));
        // Two ternary bodies with two links between them: as many bodies and pins.
        let mut d = Description::new();
        let [crank, a, b, c, e] = ["crank", "a", "b", "c", "e"].map(|n| d.body(n));
        for (name, p, q) in [
            ("O", (GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])),
            ("A", (crank, [0.2, 0.0]), (a, [0.0, 0.0])),
            ("B", (GROUND, [1.0, 0.1]), (b, [0.0, 0.0])),
            ("C", (a, [0.5, 0.2]), (c, [0.0, 0.0])),
            ("D", (c, [0.6, 0.0]), (b, [0.4, 0.3])),
            ("E", (a, [0.6, -0.2]), (e, [0.0, 0.0])),
            ("F", (e, [0.5, 0.0]), (b, [0.5, -0.3])),
        ] {
            d.pin(name, &[p, q]);
        }
        assert!(none(Mechanism::new(d).unwrap()));
        // A triad that the drive turns is none: a body's angle is known.
        let mut class_iii = class_iii(&super::super::tests::SAND_SCREEN)
            .description()
            .clone();
        class_iii.drive = super::super::model::Drive::Angle {
            body: 4,
            from: GROUND,
        };
        assert!(none(Mechanism::new(class_iii).unwrap()));
    }
}
