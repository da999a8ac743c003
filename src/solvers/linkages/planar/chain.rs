//! A mechanism as a tree of bodies from the ground and the closures that are left.
//!
//! Every body hangs by one joint, its entry, on a body placed before it. Unknown are the bodies'
//! angles and, where the entry is a slide or slot, a displacement; slides and the drive tie angles
//! to one another, so that a slider has none of its own. The joints that are no entries give the
//! closure equations. Group by group there are as many as unknowns, so the Jacobian is block
//! triangular. Lengths are in units of a power of two metres near the largest dimension.

use super::check::unit;
use super::model::{Guide, Point};
use super::plane::wrapped;
use num_complex::Complex64;

/// A point fixed on a body, in the chain's unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub body: usize,
    pub at: Complex64,
}

/// A directed line fixed on a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rail {
    pub body: usize,
    pub at: Complex64,
    pub along: Complex64,
}

impl Rail {
    /// The point at a displacement.
    pub(super) fn at(&self, s: f64) -> Spot {
        Spot {
            body: self.body,
            at: self.at + self.along * s,
        }
    }
}

/// An angle: `u + offset + drive φ`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turn {
    pub unknown: Option<usize>,
    pub offset: f64,
    pub drive: f64,
}

/// A displacement along a rail.
#[derive(Clone, Copy, Debug)]
pub(super) enum Travel {
    Unknown(usize),
    Drive,
}

/// How a body hangs on one placed before it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Entry {
    Ground,
    /// A point of its own on a point of the other.
    Pin {
        on: Spot,
        own: Complex64,
    },
    /// A point of its own on a rail of the other.
    OnRail {
        rail: Rail,
        own: Complex64,
        travel: Travel,
    },
    /// A rail of its own through a point of the other.
    WithRail {
        on: Spot,
        at: Complex64,
        along: Complex64,
        travel: Travel,
    },
}

/// A closure equation, zero where the joint is together.
#[derive(Clone, Copy, Debug)]
pub(super) enum Closure {
    /// `a − b`, two rows.
    Pin { a: Spot, b: Spot },
    /// `along × (point − at)`.
    Line { rail: Rail, point: Spot },
    /// `θ_b − θ_a − offset − drive φ`, to the nearest whole turn.
    Tie {
        a: usize,
        b: usize,
        offset: f64,
        drive: f64,
    },
    /// `θ_b − θ_c − ratio (θ_a − θ_c) − phase`.
    Gears {
        wheels: [usize; 2],
        carrier: usize,
        ratio: f64,
        phase: f64,
    },
    /// `along · (point − at) − radius (θ_wheel − θ_guide) − phase`.
    Rack {
        rail: Rail,
        point: Spot,
        wheel: usize,
        radius: f64,
        phase: f64,
    },
}

impl Closure {
    pub(super) fn rows(&self) -> usize {
        match self {
            Closure::Pin { .. } => 2,
            _ => 1,
        }
    }
}

/// An angle tied to another by a slide or the drive: `θ_b = θ_a + offset + drive φ`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tie {
    /// The slide; none is the drive.
    pub joint: Option<usize>,
    pub a: usize,
    pub b: usize,
    pub offset: f64,
    pub drive: f64,
}

/// Bounds on the second derivatives of one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bound {
    /// Of the unknowns twice.
    pub k: f64,
    /// Of the unknowns and the drive.
    pub m: f64,
    /// Of the drive twice.
    pub w: f64,
}

/// A vector fixed on a body, which turns with an unknown or the drive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm {
    pub body: usize,
    /// The unknown's column, or that of the drive.
    pub column: usize,
    pub arm: Complex64,
    /// How fast the body turns with it, negative on the way to the closure's point b.
    pub by: f64,
}

/// Unknowns and closures of one group.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub bodies: Vec<usize>,
    /// The same in the order in which they are placed.
    pub placed: Vec<usize>,
    pub unknowns: std::ops::Range<usize>,
    pub rows: std::ops::Range<usize>,
    pub closures: std::ops::Range<usize>,
}

/// The tree and what closes it.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// For each body; the ground hangs on nothing.
    pub entries: Vec<Entry>,
    /// For each body the joint of its entry, and for pins the place of the body's own point in it.
    pub hung: Vec<(usize, usize)>,
    /// The number of forces, one for each point but a pin's first, of the joints before each, and
    /// of all.
    pub forces: Vec<usize>,
    /// For each body the tie that gives its angle, by number.
    pub tied: Vec<Option<usize>>,
    pub turns: Vec<Turn>,
    /// The bodies in the order in which they are placed, without the ground.
    pub order: Vec<usize>,
    pub closures: Vec<Closure>,
    /// For each closure its joint, and for pins the place of point a in it; none of ties.
    pub closed: Vec<Option<(usize, usize)>>,
    /// For each closure the bounds of its rows, where they are the same at every position.
    pub bounds: Vec<Option<Bound>>,
    /// For each pin what it depends on, where that is the same at every position.
    pub arms: Vec<Option<Vec<Arm>>>,
    pub blocks: Vec<Block>,
    /// The number of each body's block, counted from 1; 0 for the ground.
    pub group: Vec<usize>,
    pub ties: Vec<Tie>,
    /// Number of unknowns and of rows.
    pub unknowns: usize,
    /// Which unknowns are displacements.
    pub lengths: Vec<bool>,
    /// Metres of one unit of length.
    pub metres: f64,
    /// Tells whether the drive is a displacement.
    pub linear: bool,
}

pub(super) fn spot(p: &Point, metres: f64) -> Spot {
    // The unit is a power of two: its reciprocal is exact.
    let units = 1.0 / metres;
    let [x, y] = p.at.map(|l| l.m() * units);
    Spot {
        body: p.body,
        at: Complex64::new(x, y),
    }
}

pub(super) fn rail(g: &Guide, metres: f64) -> Rail {
    let Spot { body, at } = spot(&g.origin, metres);
    Rail {
        body,
        at,
        along: unit(g.direction),
    }
}

impl Chain {
    pub(super) fn body_count(&self) -> usize {
        self.entries.len()
    }

    /// Returns whether a body is known before another's group.
    pub(super) fn precedes(&self, body: usize, other: usize) -> bool {
        self.group[body] < self.group[other]
    }

    /// The difference of two values of an unknown, of angles to the nearest turn.
    pub(super) fn apart(&self, unknown: usize, a: f64, b: f64) -> f64 {
        match self.lengths[unknown] {
            true => (a - b).abs(),
            false => wrapped(a - b).abs(),
        }
    }

    /// The column of a displacement; that of the drive is after those of the unknowns.
    pub(super) fn column(&self, travel: Travel) -> usize {
        match travel {
            Travel::Unknown(k) => k,
            Travel::Drive => self.unknowns,
        }
    }
}
