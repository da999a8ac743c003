//! Linkages drawn at random at a position: the pins first, then the bodies' frames, so that each
//! can be assembled.

use super::input::{BITS, PlanarForcesInput, PlanarLinkageInput, REACH};
use crate::audit::Draw;
use crate::reference::Ball;
use std::f64::consts::PI;

type Place = [f64; 2];

/// Places that are tried for a pin before all is drawn anew.
const TRIES: usize = 50;
/// Linkages are drawn where the reference tells the position from others with all angles this far
/// off, in radians. Nearer to a fold `f64` need not tell two positions apart: of linkages told up
/// to 3.3e-6 rad off the solver, whose closures round to 1e-13, left some unproved.
const TOLD: f64 = 5e-6;

/// Assur groups that are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Group {
    /// Two bodies, class II.
    Dyad,
    /// A ternary body on three binary ones, class III.
    Triad,
    /// Two ternary bodies with two binary ones between them, class IV.
    FourCornered,
    /// Two ternary bodies on one pin, two binary ones at each, order 4.
    SixBodies,
}

impl Group {
    fn bodies(self) -> usize {
        match self {
            Group::Dyad => 2,
            Group::Triad | Group::FourCornered => 4,
            Group::SixBodies => 6,
        }
    }
}

/// Where the inner pins of groups are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Places {
    /// Anywhere.
    Ordinary,
    /// Off a singular position by this part of the links: dyads stretched, the three links of a
    /// triad through one point.
    NearFold(f64),
    /// Crowded about the first outer pin, so that links differ by such a factor.
    Crowded(f64),
}

/// Pins with their bodies and places at the position drawn.
struct Drawing {
    bodies: usize,
    pins: Vec<([usize; 2], Place)>,
}

fn apart([a, b]: Place, [c, d]: Place) -> f64 {
    libm::hypot(a - c, b - d)
}

fn anywhere(d: &mut Draw) -> Place {
    [d.uniform(-1.0, 1.0), d.uniform(-1.0, 1.0)]
}

/// `from + t (to − from)`, off the line by a part of its length.
fn beside(from: Place, to: Place, t: f64, off: f64) -> Place {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    [from[0] + t * x - off * y, from[1] + t * y + off * x]
}

impl Drawing {
    /// A crank on the ground and the groups, each on bodies before it; none where there is no room
    /// between its pins.
    fn new(d: &mut Draw, groups: &[Group], places: Places) -> Option<Drawing> {
        let mut all = Drawing {
            bodies: 1,
            pins: vec![([0, 1], anywhere(d))],
        };
        for group in groups {
            all.add(d, *group, places)?;
        }
        Some(all)
    }

    /// The places of pins on a body.
    fn on(&self, body: usize) -> impl Iterator<Item = Place> + '_ {
        self.pins
            .iter()
            .filter(move |(ends, _)| ends.contains(&body))
            .map(|p| p.1)
    }

    /// A place on a body for an outer pin: sometimes that of a moving pin which is there, else away
    /// from all.
    fn outer(&self, d: &mut Draw, body: usize) -> Option<Place> {
        let there: Vec<Place> = self.on(body).collect();
        let moves = |p: &&Place| self.on(0).all(|q| q != **p);
        let moving: Vec<Place> = there.iter().filter(moves).copied().collect();
        if !moving.is_empty() && d.chance(0.15) {
            return Some(moving[d.integer(0, moving.len() - 1)]);
        }
        (0..TRIES).find_map(|_| {
            let place = anywhere(d);
            let clear = there.iter().all(|p| apart(*p, place) > 0.2);
            clear.then_some(place)
        })
    }

    /// Bodies that a group hangs on: the first moves, the second is another.
    fn bases(&self, d: &mut Draw, count: usize) -> Vec<usize> {
        let first = d.integer(1, self.bodies);
        let second = (first + d.integer(1, self.bodies)) % (self.bodies + 1);
        let mut all = vec![first, second];
        all.extend((2..count).map(|_| d.integer(0, self.bodies)));
        all
    }

    fn add(&mut self, d: &mut Draw, group: Group, places: Places) -> Option<()> {
        let n = self.bodies;
        let b = |k: usize| n + 1 + k;
        // Bodies of inner pins; the body of the group that each outer pin is on.
        let (inner, outer): (Vec<[usize; 2]>, Vec<usize>) = match group {
            Group::Dyad => (vec![[b(0), b(1)]], vec![b(0), b(1)]),
            Group::Triad => (
                vec![[b(0), b(3)], [b(1), b(3)], [b(2), b(3)]],
                vec![b(0), b(1), b(2)],
            ),
            Group::FourCornered => (
                vec![[b(0), b(2)], [b(2), b(1)], [b(0), b(3)], [b(3), b(1)]],
                vec![b(0), b(1)],
            ),
            Group::SixBodies => (
                vec![
                    [b(0), b(1)],
                    [b(0), b(2)],
                    [b(0), b(3)],
                    [b(1), b(4)],
                    [b(1), b(5)],
                ],
                vec![b(2), b(3), b(4), b(5)],
            ),
        };
        let bases = self.bases(d, outer.len());
        let first = self.pins.len();
        let ends = bases.into_iter().zip(outer);
        for (base, body) in ends {
            let place = self.outer(d, base)?;
            self.pins.push(([base, body], place));
        }
        let fixed: Vec<Place> = self.pins[first..].iter().map(|p| p.1).collect();
        self.bodies += group.bodies();
        let near = self.pins.len();
        let least = match places {
            Places::Crowded(size) => 0.2 * size,
            _ => 0.15,
        };
        (0..TRIES).find_map(|_| {
            let at = inner_places(d, group, &fixed, inner.len(), places);
            self.pins.truncate(near);
            self.pins
                .extend(inner.iter().zip(at).map(|(ends, at)| (*ends, at)));
            let spaced = (n + 1..=self.bodies).all(|body| self.spaced(body, least));
            spaced.then_some(())
        })
    }

    /// Returns whether the pins of a body are apart.
    fn spaced(&self, body: usize, least: f64) -> bool {
        let all: Vec<Place> = self.on(body).collect();
        let far = |(k, p): (usize, &Place)| all[..k].iter().all(|q| apart(*p, *q) > least);
        all.iter().enumerate().all(far)
    }

    /// Frames, centres of mass and angles for the bodies; with every number exact but for the
    /// rounding of the pins.
    fn framed(&self, d: &mut Draw) -> Linkage {
        let n = self.bodies;
        let mut frames = vec![([0.0, 0.0], 0.0)];
        for body in 1..=n {
            let origin = match d.chance(0.5) {
                true => self.on(body).next().unwrap_or_default(),
                false => anywhere(d),
            };
            frames.push((origin, d.uniform(-PI, PI)));
        }
        let local = |body: usize, at: Place| -> Place {
            let (origin, angle): (Place, f64) = frames[body];
            let ([x, y], (s, c)) = ([at[0] - origin[0], at[1] - origin[1]], libm::sincos(angle));
            [c * x + s * y, c * y - s * x]
        };
        let mut all = Linkage {
            phi: frames[1].1,
            near: frames[1..].iter().map(|f| f.1).collect(),
            ..Linkage::default()
        };
        for ([a, b], at) in &self.pins {
            all.a.push(*a as f64);
            all.b.push(*b as f64);
            let ([xa, ya], [xb, yb]) = (local(*a, *at), local(*b, *at));
            all.xa.push(xa);
            all.ya.push(ya);
            all.xb.push(xb);
            all.yb.push(yb);
        }
        for _ in 0..n {
            let [x, y] = anywhere(d);
            all.xs.push(x);
            all.ys.push(y);
        }
        all
    }
}

fn inner_places(
    d: &mut Draw,
    group: Group,
    outer: &[Place],
    count: usize,
    places: Places,
) -> Vec<Place> {
    match (places, group) {
        (Places::NearFold(off), Group::Dyad) => {
            let t = match d.chance(0.5) {
                true => d.uniform(0.2, 0.8),
                false => d.uniform(-1.0, -0.3),
            };
            vec![beside(outer[0], outer[1], t, d.signed(off))]
        }
        (Places::NearFold(off), Group::Triad) => {
            let meet = anywhere(d);
            let link = |e: &Place| {
                let t = d.uniform(0.3, 0.8);
                beside(*e, meet, t, d.signed(off))
            };
            outer.iter().map(link).collect()
        }
        (Places::Crowded(size), _) => {
            let about = |_| {
                let [x, y] = anywhere(d);
                [outer[0][0] + size * x, outer[0][1] + size * y]
            };
            (0..count).map(about).collect()
        }
        _ => (0..count).map(|_| anywhere(d)).collect(),
    }
}

/// A linkage as an input holds it.
#[derive(Clone, Debug, Default)]
pub(super) struct Linkage {
    pub phi: f64,
    pub a: Vec<f64>,
    pub b: Vec<f64>,
    pub xa: Vec<f64>,
    pub ya: Vec<f64>,
    pub xb: Vec<f64>,
    pub yb: Vec<f64>,
    pub xs: Vec<f64>,
    pub ys: Vec<f64>,
    pub near: Vec<f64>,
}

impl Linkage {
    /// One of the groups, its angles given to a random number of digits: as few as leave the
    /// position the nearest one.
    pub(super) fn drawn(d: &mut Draw, groups: &[Group], places: Places) -> Linkage {
        loop {
            let Some(drawing) = Drawing::new(d, groups, places) else {
                continue;
            };
            let mut all = drawing.framed(d);
            let decided = all.decider();
            let exact = all.near.clone();
            let off = exact.iter().skip(1).map(|x| x + TOLD);
            let far: Vec<f64> = exact.iter().take(1).copied().chain(off).collect();
            if !decided(&far) {
                continue;
            }
            let mut size = d.log_uniform(1e-8, 0.05);
            for _ in 0..8 {
                for (near, exact) in all.near.iter_mut().zip(&exact).skip(1) {
                    *near = exact + d.uniform(-size, size);
                }
                if decided(&all.near) {
                    return all;
                }
                size /= 16.0;
            }
        }
    }

    /// Returns the test that angles are those of a position which the reference proves to be the
    /// nearest: [`PlanarLinkageInput::is_placed`], the linkage being made once.
    fn decider(&self) -> impl Fn(&[f64]) -> bool + use<> {
        let linkage = self.input().exactly(|i| i.massless(BITS).ok()).flatten();
        let phi = Ball::exact(BITS, self.phi);
        move |near| {
            let nearest = linkage.as_ref().map(|l| l.nearest(&phi, near, REACH));
            matches!(nearest, Some(Ok(Some(_))))
        }
    }

    /// A dyad on a crank whose first link is made too long.
    pub(super) fn apart(d: &mut Draw) -> Linkage {
        let mut all = Linkage::drawn(d, &[Group::Dyad], Places::Ordinary);
        // Pins: crank, outer ones of links 2 and 3, the inner one, whose a is link 2.
        let from = [all.xb[1], all.yb[1]];
        let mut factor = d.uniform(3.0, 8.0);
        while all.input().is_placed() || !all.is_open() {
            all.xa[3] = from[0] + (all.xa[3] - from[0]) * factor;
            all.ya[3] = from[1] + (all.ya[3] - from[1]) * factor;
            factor = 2.0;
        }
        all
    }

    /// Returns whether the reference proves that no position is near.
    fn is_open(&self) -> bool {
        let placed = self.input().exactly(|i| i.placed(BITS).err());
        placed.flatten() == Some(crate::audit::Uncertified::Refused(super::input::NONE))
    }

    /// Every length times the factor.
    pub(super) fn scaled(mut self, factor: f64) -> Linkage {
        let lists = [
            &mut self.xa,
            &mut self.ya,
            &mut self.xb,
            &mut self.yb,
            &mut self.xs,
            &mut self.ys,
        ];
        lists.into_iter().flatten().for_each(|x| *x *= factor);
        self
    }

    /// The linkage of an input.
    pub(super) fn of(i: &PlanarLinkageInput) -> Linkage {
        Linkage {
            phi: i.phi,
            a: i.a.to_vec(),
            b: i.b.to_vec(),
            xa: i.xa.to_vec(),
            ya: i.ya.to_vec(),
            xb: i.xb.to_vec(),
            yb: i.yb.to_vec(),
            xs: i.xs.to_vec(),
            ys: i.ys.to_vec(),
            near: i.near.to_vec(),
        }
    }

    /// Mirrored at the x-axis.
    pub(super) fn mirrored(mut self) -> Linkage {
        let lists = [&mut self.ya, &mut self.yb, &mut self.ys, &mut self.near];
        lists.into_iter().flatten().for_each(|x| *x = -*x);
        self.phi = -self.phi;
        self
    }

    pub(super) fn input(&self) -> PlanarLinkageInput<'_> {
        PlanarLinkageInput {
            bodies: self.near.len() as f64,
            pins: self.a.len() as f64,
            phi: self.phi,
            a: &self.a,
            b: &self.b,
            xa: &self.xa,
            ya: &self.ya,
            xb: &self.xb,
            yb: &self.yb,
            xs: &self.xs,
            ys: &self.ys,
            near: &self.near,
        }
    }

    /// With masses drawn at random, in motion.
    pub(super) fn in_motion(&self, d: &mut Draw) -> Vec<f64> {
        let of = |d: &mut Draw, lo, hi| -> Vec<f64> {
            (0..self.near.len())
                .map(|_| d.log_uniform(lo, hi))
                .collect()
        };
        let (m, j) = (of(d, 0.1, 10.0), of(d, 0.01, 1.0));
        let (speed, acceleration) = (d.uniform(-20.0, 20.0), d.uniform(-100.0, 100.0));
        let [gx, gy] = match d.chance(0.5) {
            true => [0.0, -9.81],
            false => anywhere(d).map(|g| 10.0 * g),
        };
        let all = PlanarForcesInput {
            speed,
            acceleration,
            gx,
            gy,
            linkage: self.input(),
            m: &m,
            j: &j,
        };
        all.to_vec()
    }
}
