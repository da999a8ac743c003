//! Hangs the bodies, group by group, on joints to those placed before them, and closes the rest.

use super::chain::{Block, Chain, Closure, Entry, Spot, Tie, Travel, Turn, rail, spot};
use super::model::{Description, Drive, GROUND, Guide, Joint, Point};
use super::structure::Structure;

/// A joint by which a body may hang, or a closure.
struct Candidate {
    entry: Entry,
    /// The body that hangs and the one it hangs on.
    bodies: [usize; 2],
    /// The less the better.
    cost: u32,
    /// Where it comes from: the joint, and of a pin the number of its point.
    source: (usize, usize),
}

struct Builder<'a> {
    description: &'a Description,
    /// The drive, where one holds a coordinate.
    drive: Option<Drive>,
    metres: f64,
    placed: Vec<bool>,
    used: Vec<(usize, usize)>,
    /// Ties that hold because an angle was defined by them.
    kept: Vec<usize>,
    chain: Chain,
}

impl Chain {
    /// `metres` is the unit of length, a power of two.
    pub(super) fn new(description: &Description, structure: &Structure, metres: f64) -> Chain {
        let groups = structure.groups.iter().map(|g| &g.bodies[..]);
        let drive = Some(description.drive);
        let mut chain = Chain::of_groups(description, drive, groups, metres);
        chain.bounds = super::bounds::constant(&chain);
        chain
    }

    /// The chain of all bodies without a drive: more unknowns than rows by the degrees of freedom.
    /// Bodies that hang on nothing are not in its order.
    pub(super) fn free(description: &Description, metres: f64) -> Chain {
        let all: Vec<usize> = (1..description.bodies.len()).collect();
        Chain::of_groups(description, None, std::iter::once(&all[..]), metres)
    }

    fn of_groups<'g>(
        description: &Description,
        drive: Option<Drive>,
        groups: impl Iterator<Item = &'g [usize]>,
        metres: f64,
    ) -> Chain {
        let n = description.bodies.len();
        let mut placed = vec![false; n];
        placed[GROUND] = true;
        let mut builder = Builder {
            description,
            drive,
            metres,
            placed,
            used: Vec::new(),
            kept: Vec::new(),
            chain: Chain {
                entries: vec![Entry::Ground; n],
                hung: vec![(0, 0); n],
                forces: forces(description),
                tied: vec![None; n],
                turns: vec![Turn::default(); n],
                order: Vec::new(),
                closures: Vec::new(),
                closed: Vec::new(),
                bounds: Vec::new(),
                arms: Vec::new(),
                blocks: Vec::new(),
                group: vec![0; n],
                ties: ties(description, drive),
                unknowns: 0,
                lengths: Vec::new(),
                metres,
                linear: matches!(drive, Some(Drive::Displacement { .. })),
            },
        };
        for group in groups {
            builder.block(group);
        }
        let mut chain = builder.chain;
        chain.arms = super::arms::constant(&chain);
        chain
    }
}

fn forces(description: &Description) -> Vec<usize> {
    let mut all = vec![0];
    for joint in &description.joints {
        let own = match &joint.part {
            Joint::Pin { points } => points.len() - 1,
            Joint::Slide { .. } | Joint::Slot { .. } => 1,
            Joint::Gears { .. } | Joint::Rack { .. } => 0,
        };
        all.push(all[all.len() - 1] + own);
    }
    all
}

fn ties(description: &Description, drive: Option<Drive>) -> Vec<Tie> {
    let joints = description.joints.iter().enumerate();
    let slides = joints.filter_map(|(k, j)| match &j.part {
        Joint::Slide {
            slider,
            guide,
            turn,
        } => Some(Tie {
            joint: Some(k),
            a: guide.origin.body,
            b: slider.body,
            offset: turn.rad(),
            drive: 0.0,
        }),
        _ => None,
    });
    let drive = match drive {
        Some(Drive::Angle { body, from }) => Some(Tie {
            joint: None,
            a: from,
            b: body,
            offset: 0.0,
            drive: 1.0,
        }),
        _ => None,
    };
    slides.chain(drive).collect()
}

impl Builder<'_> {
    fn block(&mut self, bodies: &[usize]) {
        let (first, row) = (self.chain.unknowns, self.rows());
        let closure = self.chain.closures.len();
        for _ in bodies {
            let best = self.candidates().into_iter().filter(|c| {
                let [own, on] = c.bodies;
                bodies.contains(&own) && !self.placed[own] && self.placed[on]
            });
            let Some(best) = best.min_by_key(|c| c.cost) else {
                break;
            };
            self.place(best);
        }
        self.close();
        let rows = self.rows();
        let placed = self.chain.order.iter().copied();
        let block = Block {
            bodies: bodies.to_vec(),
            placed: placed.filter(|b| bodies.contains(b)).collect(),
            unknowns: first..self.chain.unknowns,
            rows: row..rows,
            closures: closure..self.chain.closures.len(),
        };
        self.chain.blocks.push(block);
        bodies
            .iter()
            .for_each(|&b| self.chain.group[b] = self.chain.blocks.len());
    }

    fn rows(&self) -> usize {
        self.chain.closures.iter().map(Closure::rows).sum()
    }

    /// Every joint seen from either side. Of a pin the point on the body placed first carries the
    /// others.
    fn candidates(&self) -> Vec<Candidate> {
        let mut all = Vec::new();
        let driven = match self.drive {
            Some(Drive::Displacement { joint }) => Some(joint),
            _ => None,
        };
        for (k, joint) in self.description.joints.iter().enumerate() {
            match &joint.part {
                Joint::Pin { points } => {
                    let Some((anchor, on)) = self.anchor(points) else {
                        continue;
                    };
                    for (i, p) in points.iter().enumerate() {
                        if i != anchor {
                            let own = spot(p, self.metres);
                            all.push(Candidate {
                                entry: Entry::Pin { on, own: own.at },
                                bodies: [own.body, on.body],
                                cost: 2,
                                source: (k, i),
                            });
                        }
                    }
                }
                Joint::Slide {
                    slider: point,
                    guide,
                    ..
                }
                | Joint::Slot {
                    pin: point,
                    slot: guide,
                } => {
                    let slot = matches!(joint.part, Joint::Slot { .. });
                    let travel = match driven == Some(k) {
                        true => Travel::Drive,
                        false => Travel::Unknown(self.chain.unknowns),
                    };
                    let (p, rail) = (spot(point, self.metres), rail(guide, self.metres));
                    let cost = match (driven == Some(k), slot) {
                        (true, _) => 0,
                        (false, false) => 1,
                        (false, true) => 3,
                    };
                    let source = (k, 0);
                    all.push(Candidate {
                        entry: Entry::OnRail {
                            rail,
                            own: p.at,
                            travel,
                        },
                        bodies: [p.body, rail.body],
                        cost,
                        source,
                    });
                    let (at, along) = (rail.at, rail.along);
                    all.push(Candidate {
                        entry: Entry::WithRail {
                            on: p,
                            at,
                            along,
                            travel,
                        },
                        bodies: [rail.body, p.body],
                        cost,
                        source,
                    });
                }
                Joint::Gears { .. } | Joint::Rack { .. } => {}
            }
        }
        all
    }

    /// The point of a pin on the body placed first.
    fn anchor(&self, points: &[Point]) -> Option<(usize, Spot)> {
        let rank = |p: &Point| match p.body {
            GROUND => Some(0),
            b => self.chain.order.iter().position(|&x| x == b).map(|k| k + 1),
        };
        let best = (0..points.len())
            .filter_map(|k| Some((rank(&points[k])?, k)))
            .min()?;
        Some((best.1, spot(&points[best.1], self.metres)))
    }

    fn place(&mut self, candidate: Candidate) {
        let body = candidate.bodies[0];
        if let Entry::OnRail {
            travel: Travel::Unknown(_),
            ..
        }
        | Entry::WithRail {
            travel: Travel::Unknown(_),
            ..
        } = candidate.entry
        {
            self.unknown(true);
        }
        let tied = (0..self.chain.ties.len()).find_map(|k| {
            let t = self.chain.ties[k];
            let turn = |from: usize, sign: f64| {
                let base = self.chain.turns[from];
                (
                    k,
                    Turn {
                        offset: base.offset + sign * t.offset,
                        drive: base.drive + sign * t.drive,
                        ..base
                    },
                )
            };
            match (t.a, t.b) {
                (a, b) if b == body && self.placed[a] => Some(turn(a, 1.0)),
                (a, b) if a == body && self.placed[b] => Some(turn(b, -1.0)),
                _ => None,
            }
        });
        self.chain.turns[body] = match tied {
            Some((k, turn)) => {
                self.kept.push(k);
                self.chain.tied[body] = Some(k);
                turn
            }
            None => Turn {
                unknown: Some(self.unknown(false)),
                ..Turn::default()
            },
        };
        self.chain.entries[body] = candidate.entry;
        self.chain.hung[body] = candidate.source;
        self.chain.order.push(body);
        self.placed[body] = true;
        self.used.push(candidate.source);
    }

    fn unknown(&mut self, length: bool) -> usize {
        self.chain.lengths.push(length);
        self.chain.unknowns += 1;
        self.chain.unknowns - 1
    }

    /// Closures of all joints whose bodies are placed and that are not taken care of.
    fn close(&mut self) {
        for k in 0..self.description.joints.len() {
            self.close_joint(k);
        }
        for k in 0..self.chain.ties.len() {
            let Tie {
                a,
                b,
                offset,
                drive,
                ..
            } = self.chain.ties[k];
            if self.placed[a] && self.placed[b] && !self.kept.contains(&k) {
                self.kept.push(k);
                self.add(
                    None,
                    Closure::Tie {
                        a,
                        b,
                        offset,
                        drive,
                    },
                );
            }
        }
    }

    fn add(&mut self, joint: Option<(usize, usize)>, closure: Closure) {
        self.chain.closures.push(closure);
        self.chain.closed.push(joint);
    }

    /// Adds the closure of a joint if its bodies are placed and nothing has taken care of it.
    fn add_once(&mut self, source: (usize, usize), bodies: &[usize], closure: Closure) {
        if bodies.iter().all(|&b| self.placed[b]) && !self.used.contains(&source) {
            self.used.push(source);
            self.add(Some(source), closure);
        }
    }

    fn close_joint(&mut self, k: usize) {
        let description = self.description;
        let metres = self.metres;
        let line = |point: &Point, guide: &Guide| Closure::Line {
            rail: rail(guide, metres),
            point: spot(point, metres),
        };
        match &description.joints[k].part {
            Joint::Pin { points } => {
                let Some((anchor, b)) = self.anchor(points) else {
                    return;
                };
                for (i, p) in points.iter().enumerate().filter(|(i, _)| *i != anchor) {
                    let a = spot(p, metres);
                    self.add_once((k, i), &[p.body], Closure::Pin { a, b });
                }
            }
            // Never the driven slide, which is the entry of the body that is placed last.
            Joint::Slide {
                slider: p, guide, ..
            }
            | Joint::Slot {
                pin: p,
                slot: guide,
            } => self.add_once((k, 0), &[p.body, guide.origin.body], line(p, guide)),
            Joint::Gears {
                wheels,
                carrier,
                ratio,
                phase,
            } => {
                let closure = Closure::Gears {
                    wheels: *wheels,
                    carrier: *carrier,
                    ratio: *ratio,
                    phase: phase.rad(),
                };
                self.add_once((k, 0), &[wheels[0], wheels[1], *carrier], closure);
            }
            Joint::Rack {
                wheel,
                slide,
                radius,
                phase,
            } => {
                let Joint::Slide { slider, guide, .. } = &description.joints[*slide].part else {
                    return;
                };
                let closure = Closure::Rack {
                    rail: rail(guide, metres),
                    point: spot(slider, metres),
                    wheel: *wheel,
                    radius: radius.m() / metres,
                    phase: phase.m() / metres,
                };
                self.add_once((k, 0), &[*wheel, slider.body, guide.origin.body], closure);
            }
        }
    }
}
