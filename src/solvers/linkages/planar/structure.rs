//! Degrees of freedom, redundant joints and Assur groups, by counting.
//!
//! With the drive held and the ground's pebbles gathered, every body pays for three constraints. The
//! strongly connected components of the graph "pays for a constraint with" are the smallest sets of
//! bodies that can be solved by themselves once those before them are known: the Assur groups
//! (Servatius, Shai & Whiteley, *Combinatorial characterization of the Assur graphs from
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
    /// What it is.
    pub kind: GroupKind,
    /// Joints with bodies of groups before it or with the ground; the drive is none.
    pub order: usize,
}

/// The kind of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupKind {
    /// The driven body, solved by the drive alone (with the ground: Artobolevsky's class I).
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

/// What counting tells of a mechanism.
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
    // Of a pin the bodies inside are joined to one another, and once to those known.
    let (mut order, mut inner) = (0, Vec::new());
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
        inner.extend(ours.windows(2).map(|w| [w[0], w[1]]));
        order += usize::from(all.iter().any(|b| !inside(b)));
    }
    let drive = driven(description);
    let driven = drive.iter().all(|b| inside(b) || *b == GROUND) && drive.iter().any(inside);
    let kind = match bodies.len() {
        1 if driven => GroupKind::Driver,
        1 => GroupKind::Single,
        n => {
            let rigid = pairs.iter().copied().filter(|&p| p > 2).max();
            let contour = (0..inner.len())
                .filter_map(|k| shortest_cycle(n, &inner, k))
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
