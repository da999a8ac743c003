//! How a planar linkage moves with its data, by implicit differentiation in `f64` at the
//! reference's angles.
//!
//! With origins O and angles θ of the bodies, `F(q, p) = 0` says that every pin's points
//! `O + e^{iθ} z` coincide and that the first angle is φ. A datum p moves q, q', q'' by
//! `F_q δq = −F_p δp` and the same differentiated once and twice by the drive with what the lower
//! orders give on the right. `Σ |p ∂f/∂p|` follows by one pass for each datum.
//!
//! To these come the equations themselves, as they are solved one after another, each as if it had
//! data of its own. A position closes the loops to within the rounding of their terms: a gap of
//! that size in each is a datum which moves q and, through it alone, q' and q''. The linear systems
//! for q' and q'' add Skeel's `|F_q⁻¹| (|F_q| |q'| + |right side|)` (*J. ACM* 26 (1979) 494–526),
//! in every loop of an Assur group of the group's largest term: a loop is a sum around it, and a
//! group's loops are solved together. What errors of rates make of the squared ones on the right is
//! each pin's own. Without these a rate on which position and coefficients have opposite effects,
//! the data being what they may, would have to be found without using the position, a body that by
//! its structure moves as another does would have to have the difference of both exactly, and one
//! that hardly moves among others that do would have to be found without them.

use super::input::PlanarLinkageInput;
use super::inverse::{Inverse, add};

pub(super) type C = num_complex::Complex64;

pub(super) const I: C = C::new(0.0, 1.0);

/// The scalar product of two vectors.
pub(super) fn dot(a: C, b: C) -> f64 {
    a.re * b.re + a.im * b.im
}

/// The cross product of two vectors.
pub(super) fn cross(a: C, b: C) -> f64 {
    a.re * b.im - a.im * b.re
}

/// A point of a body.
#[derive(Clone, Copy)]
pub(super) struct Spot {
    /// 0 is the ground.
    pub body: usize,
    pub at: C,
}

/// Origins and angles with two derivatives, or their changes, of the ground and all bodies.
#[derive(Clone)]
pub(super) struct Motion {
    pub origin: Vec<[C; 3]>,
    pub turn: Vec<[f64; 3]>,
}

impl Motion {
    pub(super) fn still(bodies: usize) -> Motion {
        Motion {
            origin: vec![[C::default(); 3]; bodies + 1],
            turn: vec![[0.0; 3]; bodies + 1],
        }
    }

    /// Sets one order from a solution of the loops.
    fn set(&mut self, order: usize, q: &[f64]) {
        for k in 1..self.turn.len() {
            let at = 3 * (k - 1);
            self.origin[k][order] = C::new(q[at], q[at + 1]);
            self.turn[k][order] = q[at + 2];
        }
    }
}

/// A datum: its size, and what it changes.
pub(super) struct Datum {
    pub size: f64,
    pub of: Change,
}

/// Describes what a datum changes.
#[derive(Clone, Copy)]
pub(super) enum Change {
    Drive,
    /// A pin's point on its body of that side, by so much for each unit.
    Point(usize, usize, C),
    /// The gap between a pin's points.
    Gap(usize, C),
}

/// A linkage at a position.
pub(super) struct Flow {
    pub bodies: usize,
    pub pins: Vec<[Spot; 2]>,
    pub centres: Vec<C>,
    pub phi: f64,
    /// `e^{iθ}` of the ground and all bodies.
    pub direction: Vec<C>,
    pub motion: Motion,
    /// Gives what a right side of the loops makes of origins and angles.
    pub loops: Inverse,
    /// The first and second derivatives that a turn of each body by 1 makes with the loops closed.
    turned: Vec<[Vec<f64>; 2]>,
    /// Holds what the coefficients of the systems for the first and second derivatives make of
    /// origins and angles.
    pub systems: Vec<[[f64; 2]; 2]>,
}

/// A centre of mass with its derivatives, or its changes.
pub(super) type Path = [C; 3];

impl Flow {
    /// The linkage with its bodies at those angles; none at a singular position.
    pub(super) fn new(i: &PlanarLinkageInput, angles: &[f64]) -> Option<Flow> {
        let bodies = i.near.len();
        let spot = |body: usize, x: f64, y: f64| Spot {
            body,
            at: C::new(x, y),
        };
        let ends = |(k, [a, b]): (usize, [usize; 2])| {
            [spot(a, i.xa[k], i.ya[k]), spot(b, i.xb[k], i.yb[k])]
        };
        let pins: Vec<[Spot; 2]> = i.joined()?.into_iter().enumerate().map(ends).collect();
        let mut direction = vec![C::new(1.0, 0.0)];
        direction.extend(angles.iter().map(|t| C::new(t.cos(), t.sin())));
        let n = 3 * bodies;
        let mut matrix = vec![vec![0.0; n]; n];
        for (row, pin) in pins.iter().enumerate() {
            for (spot, sign) in pin.iter().zip([1.0, -1.0]) {
                let Some(k) = spot.body.checked_sub(1) else {
                    continue;
                };
                let arm = I * direction[spot.body] * spot.at;
                matrix[2 * row][3 * k] = sign;
                matrix[2 * row + 1][3 * k + 1] = sign;
                matrix[2 * row][3 * k + 2] = sign * arm.re;
                matrix[2 * row + 1][3 * k + 2] = sign * arm.im;
            }
        }
        matrix[n - 1][2] = 1.0;
        let mut flow = Flow {
            bodies,
            pins,
            centres: (i.xs.iter().zip(i.ys).map(|(&x, &y)| C::new(x, y))).collect(),
            phi: i.phi,
            direction,
            motion: Motion::still(bodies),
            loops: Inverse::of(matrix)?,
            turned: Vec::new(),
            systems: vec![[[0.0; 2]; 2]; bodies + 1],
        };
        flow.place(angles);
        let drive = flow.closed(|_| C::default(), 1.0);
        flow.motion.set(1, &flow.loops.times(&drive));
        let second = |s: &Spot| {
            let w = flow.motion.turn[s.body][1];
            flow.direction[s.body] * s.at * (w * w)
        };
        let right = flow.closed(second, 0.0);
        flow.motion.set(2, &flow.loops.times(&right));
        let turned = (0..=bodies).map(|k| {
            let mut d = Motion::still(bodies);
            d.turn[k][0] = 1.0;
            let of = |order: usize| flow.closed(|s| -flow.change(*s, C::default(), &d)[order], 0.0);
            [1, 2].map(|order| flow.loops.times(&of(order)))
        });
        flow.turned = turned.collect();
        flow.systems = flow.of_systems()?;
        Some(flow)
    }

    /// The bodies' angles, and their origins from pin to pin.
    fn place(&mut self, angles: &[f64]) {
        for (turn, angle) in self.motion.turn[1..].iter_mut().zip(angles) {
            turn[0] = *angle;
        }
        let mut known = vec![false; self.bodies + 1];
        known[0] = true;
        for _ in 0..self.bodies {
            for [a, b] in &self.pins {
                let (from, to) = match (known[a.body], known[b.body]) {
                    (true, false) => (a, b),
                    (false, true) => (b, a),
                    _ => continue,
                };
                let arm = |s: &Spot| self.direction[s.body] * s.at;
                self.motion.origin[to.body][0] =
                    self.motion.origin[from.body][0] + arm(from) - arm(to);
                known[to.body] = true;
            }
        }
    }

    /// Returns what the systems make of origins and angles if each loop is closed to within the
    /// largest term of its group, and what errors of rates make of the squared ones on the right.
    fn of_systems(&self) -> Option<Vec<[[f64; 2]; 2]>> {
        let inverse = self.loops.abs();
        let group = groups(self.bodies, &self.pins)?;
        let of_group = |[a, b]: &[Spot; 2]| group[a.body].max(group[b.body]);
        let mut all = vec![[[0.0; 2]; 2]; self.bodies + 1];
        for order in [1, 2] {
            let mut largest = vec![0.0f64; self.bodies + 1];
            for pin in &self.pins {
                let terms = pin.iter().map(|s| self.rounded(s, order));
                let most = &mut largest[of_group(pin)];
                *most = terms.fold(*most, f64::max);
            }
            let mut right = vec![0.0; 3 * self.bodies];
            for (row, pin) in self.pins.iter().enumerate() {
                let squares: f64 = match order {
                    1 => 0.0,
                    _ => (pin.iter())
                        .map(|s| {
                            2.0 * s.at.norm()
                                * self.motion.turn[s.body][1].abs()
                                * all[s.body][1][0]
                        })
                        .sum(),
                };
                let gap = 2.0 * largest[of_group(pin)] + squares;
                right[2 * row] = gap;
                right[2 * row + 1] = gap;
            }
            let size = inverse.times(&right);
            for (k, of) in all.iter_mut().skip(1).enumerate() {
                of[0][order - 1] = size[3 * k].max(size[3 * k + 1]);
                of[1][order - 1] = size[3 * k + 2];
            }
        }
        Some(all)
    }

    /// The size of the terms of a point's derivative.
    fn rounded(&self, s: &Spot, order: usize) -> f64 {
        let [_, first, second] = self.motion.turn[s.body].map(f64::abs);
        let turning = match order {
            1 => first,
            _ => second + first * first,
        };
        self.motion.origin[s.body][order].norm() + s.at.norm() * turning
    }

    /// Returns what the systems make of the first and second derivative of a body's centre of mass
    /// and of its angle.
    pub(super) fn system(&self, k: usize) -> [[f64; 2]; 2] {
        let [origin, turn] = self.systems[k + 1];
        let arm = self.centres[k].norm();
        let first = self.motion.turn[k + 1][1].abs();
        let path = [
            origin[0] + arm * turn[0],
            origin[1] + arm * (turn[1] + 2.0 * first * turn[0]),
        ];
        [path, turn]
    }

    /// The right side with the difference of a pin's two points of `of`, and the drive's.
    fn closed(&self, of: impl Fn(&Spot) -> C, drive: f64) -> Vec<f64> {
        let mut right = vec![0.0; 3 * self.bodies];
        for (row, [a, b]) in self.pins.iter().enumerate() {
            let gap = of(a) - of(b);
            right[2 * row] = gap.re;
            right[2 * row + 1] = gap.im;
        }
        right[3 * self.bodies - 1] = drive;
        right
    }

    /// A point with its derivatives, the origin's position left out.
    pub(super) fn path(&self, s: Spot) -> Path {
        let arm = self.direction[s.body] * s.at;
        let [_, v, a] = self.motion.origin[s.body];
        let [_, first, second] = self.motion.turn[s.body];
        let along = I * second - first * first;
        [arm, v + arm * I * first, a + arm * along]
    }

    /// How a point and its derivatives change with the bodies and with its place in the body.
    pub(super) fn change(&self, s: Spot, by: C, d: &Motion) -> Path {
        let e = self.direction[s.body];
        let [_, first, second] = self.motion.turn[s.body];
        let [turn, turn1, turn2] = d.turn[s.body];
        let [o, o1, o2] = d.origin[s.body];
        let moved = I * turn * s.at + by;
        let squared = moved * (first * first) + s.at * (2.0 * first * turn1);
        [
            o + e * moved,
            o1 + e * I * (moved * first + s.at * turn1),
            o2 + e * (I * (moved * second + s.at * turn2) - squared),
        ]
    }

    /// How the bodies move with a datum.
    pub(super) fn moved(&self, datum: &Datum) -> Motion {
        let still = Motion::still(self.bodies);
        let mut d = still.clone();
        for order in 0..3 {
            let mut right = vec![0.0; 3 * self.bodies];
            let gap = match datum.of {
                Change::Point(pin, side, by) => {
                    let change = self.change(self.pins[pin][side], by, &still)[order];
                    Some((pin, if side == 0 { -change } else { change }))
                }
                Change::Gap(pin, by) => (order == 0).then_some((pin, by)),
                Change::Drive => None,
            };
            match gap {
                Some((pin, gap)) => right[2 * pin..][..2].copy_from_slice(&[gap.re, gap.im]),
                None if order == 0 => right[3 * self.bodies - 1] = 1.0,
                None => {}
            }
            let mut q = self.loops.times(&right);
            for ([turn, turn1, _], [first, second]) in d.turn.iter().zip(&self.turned) {
                match order {
                    1 => add(&mut q, *turn, first),
                    2 => {
                        add(&mut q, *turn, second);
                        add(&mut q, 2.0 * turn1, first);
                    }
                    _ => {}
                }
            }
            d.set(order, &q);
        }
        d
    }

    /// How the datum moves a pin's point in its body.
    pub(super) fn by(&self, datum: &Datum, pin: usize, side: usize) -> C {
        match datum.of {
            Change::Point(p, s, by) if (p, s) == (pin, side) => by,
            _ => C::default(),
        }
    }

    /// Drive, pins' coordinates, loops.
    pub(super) fn data(&self) -> Vec<Datum> {
        let mut all = vec![Datum {
            size: self.phi.abs(),
            of: Change::Drive,
        }];
        for (pin, ends) in self.pins.iter().enumerate() {
            for (side, end) in ends.iter().enumerate() {
                for (size, by) in [(end.at.re, C::new(1.0, 0.0)), (end.at.im, I)] {
                    all.push(Datum {
                        size: size.abs(),
                        of: Change::Point(pin, side, by),
                    });
                }
            }
            let size: f64 = ends.iter().map(|s| self.terms(s)).sum();
            all.extend([C::new(1.0, 0.0), I].map(|by| Datum {
                size,
                of: Change::Gap(pin, by),
            }));
        }
        all.retain(|d| d.size > 0.0);
        all
    }

    /// The size of the terms of a point, `O + e^{iθ} z`, θ being rounded too.
    fn terms(&self, s: &Spot) -> f64 {
        let turn = self.motion.turn[s.body][0].abs().max(1.0);
        self.motion.origin[s.body][0].norm() + turn * s.at.norm()
    }

    pub(super) fn centre(&self, k: usize) -> Spot {
        Spot {
            body: k + 1,
            at: self.centres[k],
        }
    }

    /// The two data of a centre of mass with their sizes.
    pub(super) fn of_centre(&self, k: usize) -> [(f64, C); 2] {
        let c = self.centres[k];
        [(c.re.abs(), C::new(1.0, 0.0)), (c.im.abs(), I)]
    }

    /// Runs over every geometric datum with its size and the changes of centres and angles.
    pub(super) fn each(
        &self,
        mut go: impl FnMut(f64, &[Path], &Motion, &dyn Fn(usize, usize) -> C),
    ) {
        for datum in self.data() {
            let d = self.moved(&datum);
            let change = |k| self.change(self.centre(k), C::default(), &d);
            let paths: Vec<Path> = (0..self.bodies).map(change).collect();
            go(datum.size, &paths, &d, &|pin, side| {
                self.by(&datum, pin, side)
            });
        }
        let still = Motion::still(self.bodies);
        for k in 0..self.bodies {
            for (size, by) in self.of_centre(k).into_iter().filter(|d| d.0 > 0.0) {
                let mut paths = vec![[C::default(); 3]; self.bodies];
                paths[k] = self.change(self.centre(k), by, &still);
                go(size, &paths, &still, &|_, _| C::default());
            }
        }
    }
}

/// The number of each body's Assur group in their order, 0 for ground and driven body: again and
/// again the fewest bodies that the pins among them and to those before determine. Counted here: a
/// fault of the solver's own count would widen what it is judged by.
fn groups(bodies: usize, pins: &[[Spot; 2]]) -> Option<Vec<usize>> {
    let mut group: Vec<Option<usize>> = vec![None; bodies + 1];
    group[..2].fill(Some(0));
    // A bit for each body.
    let mut sets: Vec<usize> = (1..1 << (bodies - 1)).map(|set| set << 2).collect();
    sets.sort_by_key(|set| set.count_ones());
    for number in 1.. {
        let free = |body: usize| group[body].is_none();
        if !(1..=bodies).any(free) {
            break;
        }
        let found = sets.iter().copied().find(|set| {
            let within = |body: usize| set >> body & 1 == 1;
            let placed = |body: usize| within(body) || !free(body);
            let joins = |[a, b]: &&[Spot; 2]| {
                (within(a.body) || within(b.body)) && placed(a.body) && placed(b.body)
            };
            let mut all = group.iter().enumerate();
            all.all(|(body, group)| !within(body) || group.is_none())
                && 2 * pins.iter().filter(joins).count() == 3 * set.count_ones() as usize
        })?;
        for (body, group) in group.iter_mut().enumerate() {
            if found >> body & 1 == 1 {
                *group = Some(number);
            }
        }
    }
    group.into_iter().collect()
}

#[cfg(test)]
mod tests;
