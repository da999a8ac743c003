//! Degrees of freedom, redundant joints and Assur groups, by counting.
//!
//! With the drive held and the ground's pebbles gathered, every body pays for three constraints.
//! The strongly connected components of the graph "pays for a constraint with" are the smallest
//! sets of bodies that can be solved by themselves once those before them are known: the Assur
//! groups (Servatius, Shai & Whiteley, *Combinatorial characterization of the Assur graphs from
//! engineering*, Eur. J. Combin. 31 (2010), Theorem 3.3).

use super::check::DRIVE;
use super::error::MechanismError;
use super::model::{Description, Drive, GROUND, Joint, Named};
use super::pebbles::{Pebbles, components};

/// Bodies that are solved together once those of the groups before them are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The bodies, in ascending order.
    pub bodies: Vec<usize>,
    /// Holds what it is.
    pub kind: GroupKind,
    /// Joints with bodies of groups before it or with the ground; the drive is none.
    pub order: usize,
}

/// The kind of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupKind {
    /// The driven body, solved by the drive alone against the ground (Artobolevsky's class I) or a
    /// body known before.
    Driver,
    /// One body held by three constraints without the drive, such as a gear wheel or a lever with a
    /// slot.
    Single,
    /// An Assur group; its class is the number of joints on the most complex closed contour, rigid
    /// (a link) or not (a cycle of links), 2 for dyads (Artobolevsky, *Theory of mechanisms and
    /// machines*, § 13).
    Assur {
        /// The class.
        class: usize,
    },
}

/// Describes what counting tells of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// The groups in the order in which they can be solved.
    pub groups: Vec<Group>,
}

/// The game's vertices: bodies first, then pins of three or more bodies.
struct Vertices {
    pebbles: Vec<usize>,
    /// For each joint its constraints.
    edges: Vec<Vec<[usize; 2]>>,
    drive: [usize; 2],
}

impl Vertices {
    fn new(description: &Description) -> Vertices {
        let mut pebbles = vec![3; description.bodies.len()];
        let mut edges = Vec::new();
        for joint in &description.joints {
            edges.push(match &joint.part {
                Joint::Pin { points } if points.len() == 2 => {
                    vec![[points[0].body, points[1].body]; 2]
                }
                Joint::Pin { points } => {
                    let pin = pebbles.len();
                    pebbles.push(2);
                    points.iter().flat_map(|p| [[p.body, pin]; 2]).collect()
                }
                Joint::Slide { slider, guide, .. } => vec![[slider.body, guide.origin.body]; 2],
                Joint::Slot { pin, slot } => vec![[pin.body, slot.origin.body]],
                Joint::Gears { wheels, .. } => vec![*wheels],
                Joint::Rack { wheel, slide, .. } => match &description.joints[*slide].part {
                    Joint::Slide { slider, .. } => vec![[*wheel, slider.body]],
                    _ => Vec::new(),
                },
            });
        }
        Vertices {
            pebbles,
            edges,
            drive: driven(description),
        }
    }
}

/// The bodies whose relative motion the drive prescribes.
pub(super) fn driven(description: &Description) -> [usize; 2] {
    match description.drive {
        Drive::Angle { body, from } => [body, from],
        Drive::Displacement { joint } => match &description.joints[joint].part {
            Joint::Slide { slider, guide, .. } => [slider.body, guide.origin.body],
            _ => [GROUND, GROUND],
        },
    }
}

/// Counts a description whose parts have been checked.
///
/// # Errors
/// [`MechanismError::OverConstrained`], [`MechanismError::Locked`], [`MechanismError::Loose`].
pub(super) fn structure(description: &Description) -> Result<Structure, MechanismError> {
    let bodies = description.bodies.len();
    let name = |v: &usize| description.bodies.get(*v).cloned();
    let names = |set: &[usize]| -> Vec<String> { set.iter().filter_map(name).collect() };
    let vertices = Vertices::new(description);
    let mut game = Pebbles::new(vertices.pebbles);
    for (Named { name, .. }, edges) in description.joints.iter().zip(&vertices.edges) {
        for [a, b] in edges {
            game.insert(*a, *b)
                .map_err(|set| MechanismError::OverConstrained {
                    what: name.clone(),
                    bodies: names(&set),
                })?;
        }
    }
    let [a, b] = vertices.drive;
    game.insert(a, b).map_err(|set| MechanismError::Locked {
        what: DRIVE.into(),
        bodies: names(&set),
    })?;
    let moving = game.hold(GROUND);
    if game.freedoms() > 0 {
        return Err(MechanismError::Loose {
            freedoms: game.freedoms(),
            bodies: names(&moving),
        });
    }
    let mut groups = Vec::new();
    let mut known = vec![GROUND];
    for component in components(game.paid()) {
        let own = |v: &usize| *v < bodies && *v != GROUND;
        let members: Vec<usize> = component.into_iter().filter(own).collect();
        if !members.is_empty() {
            groups.push(group(description, members.clone(), &known));
            known.extend(members);
        }
    }
    Ok(Structure { groups })
}

/// The bodies of a joint; of a rack the wheel and the rack.
fn joined(description: &Description, joint: &Joint) -> Vec<usize> {
    match joint {
        Joint::Pin { points } => points.iter().map(|p| p.body).collect(),
        Joint::Slide { slider, guide, .. } => vec![slider.body, guide.origin.body],
        Joint::Slot { pin, slot } => vec![pin.body, slot.origin.body],
        Joint::Gears { wheels, .. } => wheels.to_vec(),
        Joint::Rack { wheel, slide, .. } => match &description.joints[*slide].part {
            Joint::Slide { slider, .. } => vec![*wheel, slider.body],
            _ => vec![*wheel],
        },
    }
}

/// Joints with bodies of later groups belong to those.
fn group(description: &Description, bodies: Vec<usize>, known: &[usize]) -> Group {
    let inside = |b: &usize| bodies.contains(b);
    // Contours run from bodies to joints and back: a pin of many bodies joins any two of them,
    // once.
    let (mut order, mut inner, mut joints) = (0, Vec::new(), bodies.len());
    let mut pairs = vec![0usize; bodies.len()];
    for joint in &description.joints {
        let mut all = joined(description, &joint.part);
        all.retain(|b| inside(b) || known.contains(b));
        let ours: Vec<usize> = (0..bodies.len())
            .filter(|&k| all.contains(&bodies[k]))
            .collect();
        if ours.is_empty() || all.len() < 2 {
            continue;
        }
        ours.iter().for_each(|&k| pairs[k] += 1);
        inner.extend(ours.iter().map(|&k| [k, joints]));
        joints += 1;
        order += usize::from(all.iter().any(|b| !inside(b)));
    }
    let drive = driven(description);
    let placed = |b: &usize| inside(b) || known.contains(b);
    let driven = drive.iter().all(placed) && drive.iter().any(inside);
    let kind = match bodies.len() {
        1 if driven => GroupKind::Driver,
        1 => GroupKind::Single,
        _ => {
            let rigid = pairs.iter().copied().filter(|&p| p > 2).max();
            let contour = (0..inner.len())
                .filter_map(|k| Some(shortest_cycle(joints, &inner, k)? / 2))
                .max();
            let class = rigid.into_iter().chain(contour).max().unwrap_or(2);
            GroupKind::Assur { class }
        }
    };
    Group {
        bodies,
        kind,
        order,
    }
}

/// The length of the shortest cycle over an edge, if there is any.
fn shortest_cycle(n: usize, edges: &[[usize; 2]], over: usize) -> Option<usize> {
    let [from, to] = edges[over];
    let mut distance = vec![usize::MAX; n];
    distance[from] = 0;
    let mut queue = std::collections::VecDeque::from([from]);
    while let Some(v) = queue.pop_front() {
        for (k, e) in edges.iter().enumerate() {
            let w = match e {
                _ if k == over => continue,
                [a, b] if *a == v => *b,
                [a, b] if *b == v => *a,
                _ => continue,
            };
            if distance[w] == usize::MAX {
                distance[w] = distance[v] + 1;
                queue.push_back(w);
            }
        }
    }
    (distance[to] < usize::MAX).then(|| distance[to] + 1)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{gears, rack, slide, slot};
    use super::*;

    /// Bodies by number; each pin names those it joins, 0 is the ground. Body 1 is driven.
    fn groups(bodies: usize, pins: &[&[usize]]) -> Vec<Group> {
        let mut d = Description::new();
        for k in 1..=bodies {
            d.body(k.to_string());
        }
        for pin in pins {
            let points: Vec<_> = pin.iter().map(|&b| (b, [0.0, 0.0])).collect();
            d.pin("pin", &points);
        }
        structure(&d).unwrap().groups
    }

    fn assur(bodies: &[usize], class: usize, order: usize) -> Group {
        Group {
            bodies: bodies.to_vec(),
            kind: GroupKind::Assur { class },
            order,
        }
    }

    fn driver() -> Group {
        Group {
            bodies: vec![1],
            kind: GroupKind::Driver,
            order: 1,
        }
    }

    #[test]
    fn classes_and_orders() {
        let crank: &[&[usize]] = &[&[0, 1]];
        let with = |pins: &[&'static [usize]]| [crank, pins].concat();
        for (bodies, pins, due) in [
            (3, with(&[&[1, 2], &[2, 3], &[3, 0]]), assur(&[2, 3], 2, 2)),
            // A ternary body on three links; its pins listed either way.
            (
                5,
                with(&[&[1, 2], &[0, 3], &[5, 0], &[4, 2], &[3, 4], &[4, 5]]),
                assur(&[2, 3, 4, 5], 3, 3),
            ),
            // Two ternary bodies with two links between them: a contour of four.
            (
                5,
                with(&[&[1, 2], &[0, 3], &[2, 4], &[4, 3], &[2, 5], &[5, 3]]),
                assur(&[2, 3, 4, 5], 4, 2),
            ),
            // The double butterfly: a contour of five.
            (
                7,
                with(&[
                    &[1, 2],
                    &[2, 3],
                    &[3, 4],
                    &[3, 6],
                    &[6, 5],
                    &[5, 7],
                    &[7, 4],
                    &[4, 0],
                    &[1, 5],
                ]),
                assur(&[2, 3, 4, 5, 6, 7], 5, 3),
            ),
            // Two ternary bodies on one pin, two links at each: no contour.
            (
                7,
                with(&[
                    &[2, 3],
                    &[2, 4],
                    &[2, 5],
                    &[3, 6],
                    &[3, 7],
                    &[4, 0],
                    &[5, 0],
                    &[6, 0],
                    &[7, 1],
                ]),
                assur(&[2, 3, 4, 5, 6, 7], 3, 4),
            ),
            // A triangle of bodies, a link on one of its pins: a contour of three, whatever their
            // numbers.
            (
                5,
                with(&[&[2, 3, 4], &[3, 1], &[4, 5], &[5, 2], &[5, 0]]),
                assur(&[2, 3, 4, 5], 3, 2),
            ),
        ] {
            assert_eq!(groups(bodies, &pins), [driver(), due], "{pins:?}");
        }
    }

    /// Checks that what a later group hangs on adds nothing to the class of the group that bears
    /// it.
    #[test]
    fn later_groups_do_not_count() {
        let pins: &[&[usize]] = &[
            &[0, 1],
            &[1, 2],
            &[2, 3],
            &[3, 0],
            &[2, 4],
            &[4, 5],
            &[5, 0],
        ];
        let due = [driver(), assur(&[2, 3], 2, 2), assur(&[4, 5], 2, 2)];
        assert_eq!(groups(5, pins), due);
    }

    /// A pin that a later group hangs on belongs to the bodies that are known there.
    #[test]
    fn a_dyad_on_the_pin_of_a_dyad() {
        let pins: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 3, 4], &[3, 0], &[4, 5], &[5, 0]];
        let due = [driver(), assur(&[2, 3], 2, 2), assur(&[4, 5], 2, 2)];
        assert_eq!(groups(5, pins), due);
    }

    /// A body on a pin and a slot of the ground, and another driven against it.
    fn driven_from_a_still_body() -> Vec<Group> {
        let mut d = Description::new();
        let [still, arm] = ["still", "arm"].map(|n| d.body(n));
        d.pin("A", &[(GROUND, [0.0, 0.0]), (still, [0.0, 0.0])]);
        d.joint("slot", slot((still, [0.5, 0.0]), (GROUND, [0.5, 0.0]), 0.3));
        d.pin("B", &[(still, [1.0, 0.0]), (arm, [0.0, 0.0])]);
        d.drive = Drive::Angle {
            body: arm,
            from: still,
        };
        structure(&d).unwrap().groups
    }

    #[test]
    fn single_bodies_and_drivers() {
        let mut d = Description::new();
        let [a, b, slider] = ["a", "b", "slider"].map(|n| d.body(n));
        d.pin("A", &[(GROUND, [0.0, 0.0]), (a, [0.0, 0.0])]);
        d.pin("B", &[(GROUND, [1.0, 0.0]), (b, [0.0, 0.0])]);
        d.joint("mesh", gears([a, b], GROUND, -0.5, 0.0));
        let guide = d.joint(
            "guide",
            slide((slider, [0.0, 0.0]), (GROUND, [0.0, 2.0]), 0.0),
        );
        let rack = rack(b, guide, [0.3, 0.0]);
        d.joint("rack", rack);
        let single = |body: usize, order: usize| Group {
            bodies: vec![body],
            kind: GroupKind::Single,
            order,
        };
        let driven = |body: usize, order: usize| Group {
            kind: GroupKind::Driver,
            ..single(body, order)
        };
        let by_angle = structure(&d).unwrap().groups;
        assert_eq!(by_angle, [driven(a, 1), single(b, 2), single(slider, 2)]);
        d.drive = Drive::Displacement { joint: guide };
        let by_slide = structure(&d).unwrap().groups;
        assert_eq!(driven_from_a_still_body(), [single(1, 2), driven(2, 1)]);
        assert_eq!(by_slide, [driven(slider, 1), single(b, 2), single(a, 2)]);
    }
}
