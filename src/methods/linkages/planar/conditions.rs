//! Condition numbers of a planar linkage by implicit differentiation, in `f64` at the reference's angles.
//!
//! With origins O and angles θ of the bodies, `F(q, p) = 0` says that every pin's points `O + e^{iθ} z` coincide and that
//! the first angle is φ. A datum p moves q, q', q'' by `F_q δq = −F_p δp` and the same differentiated once and twice by
//! the drive with what the lower orders give on the right. `Σ |p ∂f/∂p|` follows by one pass for each datum.
//!
//! To these come the coefficients of the linear systems for q' and q'', as if each were a datum: Skeel's
//! `|F_q⁻¹| (|F_q| |q'| + |right side|)` (*J. ACM* 26 (1979) 494–526). Without them a body that by its structure moves as
//! another does, the data being what they may, would have to have the difference of both exactly.

use super::input::{PlanarForcesInput, PlanarLinkageInput};
use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

type C = Complex<f64>;

const I: C = C::new(0.0, 1.0);

/// The scalar product of two vectors.
fn dot(a: C, b: C) -> f64 {
    a.re * b.re + a.im * b.im
}

/// The cross product of two vectors.
fn cross(a: C, b: C) -> f64 {
    a.re * b.im - a.im * b.re
}

/// A point of a body.
#[derive(Clone, Copy)]
struct Spot {
    /// 0 is the ground.
    body: usize,
    at: C,
}

/// Origins and angles with two derivatives, or their changes, of the ground and all bodies.
#[derive(Clone)]
struct Motion {
    origin: Vec<[C; 3]>,
    turn: Vec<[f64; 3]>,
}

impl Motion {
    fn still(bodies: usize) -> Motion {
        Motion {
            origin: vec![[C::default(); 3]; bodies + 1],
            turn: vec![[0.0; 3]; bodies + 1],
        }
    }

    /// Sets one order from a solution of the loops.
    fn set(&mut self, order: usize, q: &DVector<f64>) {
        for k in 1..self.turn.len() {
            let at = 3 * (k - 1);
            self.origin[k][order] = C::new(q[at], q[at + 1]);
            self.turn[k][order] = q[at + 2];
        }
    }
}

/// A datum: its size, and which point or the drive it moves.
struct Datum {
    size: f64,
    /// The pin, its side and the change of the point; none is the drive.
    of: Option<(usize, usize, C)>,
}

/// A linkage at a position.
pub(super) struct Flow {
    bodies: usize,
    pins: Vec<[Spot; 2]>,
    centres: Vec<C>,
    phi: f64,
    /// `e^{iθ}` of the ground and all bodies.
    direction: Vec<C>,
    motion: Motion,
    loops: LU<f64, Dyn, Dyn>,
    /// What the coefficients of the systems for the first and second derivatives make of origins and angles.
    systems: Vec<[[f64; 2]; 2]>,
}

/// A centre of mass with its derivatives, or its changes.
type Path = [C; 3];

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
        let mut matrix = DMatrix::zeros(n, n);
        for (row, pin) in pins.iter().enumerate() {
            for (spot, sign) in pin.iter().zip([1.0, -1.0]) {
                let Some(k) = spot.body.checked_sub(1) else {
                    continue;
                };
                let arm = I * direction[spot.body] * spot.at;
                matrix[(2 * row, 3 * k)] = sign;
                matrix[(2 * row + 1, 3 * k + 1)] = sign;
                matrix[(2 * row, 3 * k + 2)] = sign * arm.re;
                matrix[(2 * row + 1, 3 * k + 2)] = sign * arm.im;
            }
        }
        matrix[(n - 1, 2)] = 1.0;
        let mut flow = Flow {
            bodies,
            pins,
            centres: (i.xs.iter().zip(i.ys).map(|(&x, &y)| C::new(x, y))).collect(),
            phi: i.phi,
            direction,
            motion: Motion::still(bodies),
            loops: matrix.lu(),
            systems: vec![[[0.0; 2]; 2]; bodies + 1],
        };
        // Origins are not needed: only their derivatives are.
        let mut right = DVector::zeros(n);
        right[n - 1] = 1.0;
        flow.motion.set(1, &flow.loops.solve(&right)?);
        let second = |s: &Spot| {
            let w = flow.motion.turn[s.body][1];
            flow.direction[s.body] * s.at * (w * w)
        };
        let right = flow.closed(second, 0.0);
        flow.motion.set(2, &flow.loops.solve(&right)?);
        flow.systems = flow.of_systems()?;
        Some(flow)
    }

    fn of_systems(&self) -> Option<Vec<[[f64; 2]; 2]>> {
        let inverse = self.loops.try_inverse()?.abs();
        let mut all = vec![[[0.0; 2]; 2]; self.bodies + 1];
        for order in [1, 2] {
            let mut right = DVector::zeros(3 * self.bodies);
            for (row, s) in (self.pins.iter().enumerate()).flat_map(|(j, p)| p.map(|s| (2 * j, s)))
            {
                let o = self.motion.origin[s.body];
                let [_, first, second] = self.motion.turn[s.body];
                let arm = s.at.norm();
                let turning = match order {
                    1 => arm * first.abs(),
                    _ => {
                        arm * (second.abs() + first * first + 2.0 * first.abs() * all[s.body][1][0])
                    }
                };
                right[row] += o[order].re.abs() + turning;
                right[row + 1] += o[order].im.abs() + turning;
            }
            let size = &inverse * right;
            for (k, of) in all.iter_mut().skip(1).enumerate() {
                of[0][order - 1] = size[3 * k].max(size[3 * k + 1]);
                of[1][order - 1] = size[3 * k + 2];
            }
        }
        Some(all)
    }

    /// What the systems make of the first and second derivative of a body's centre of mass and of its angle.
    fn system(&self, k: usize) -> [[f64; 2]; 2] {
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
    fn closed(&self, of: impl Fn(&Spot) -> C, drive: f64) -> DVector<f64> {
        let mut right = DVector::zeros(3 * self.bodies);
        for (row, [a, b]) in self.pins.iter().enumerate() {
            let gap = of(a) - of(b);
            right[2 * row] = gap.re;
            right[2 * row + 1] = gap.im;
        }
        right[3 * self.bodies - 1] = drive;
        right
    }

    /// A point with its derivatives, the origin's position left out.
    fn path(&self, s: Spot) -> Path {
        let arm = self.direction[s.body] * s.at;
        let [_, v, a] = self.motion.origin[s.body];
        let [_, first, second] = self.motion.turn[s.body];
        let along = I * second - first * first;
        [arm, v + arm * I * first, a + arm * along]
    }

    /// How a point and its derivatives change with the bodies and with its place in the body.
    fn change(&self, s: Spot, by: C, d: &Motion) -> Path {
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
    fn moved(&self, datum: &Datum) -> Option<Motion> {
        let mut d = Motion::still(self.bodies);
        for order in 0..3 {
            let mut right = DVector::zeros(3 * self.bodies);
            for (row, pin) in self.pins.iter().enumerate() {
                for (side, sign) in [(0, -1.0), (1, 1.0)] {
                    let by = self.by(datum, row, side);
                    let gap = self.change(pin[side], by, &d)[order] * sign;
                    right[2 * row] += gap.re;
                    right[2 * row + 1] += gap.im;
                }
            }
            if order == 0 && datum.of.is_none() {
                right[3 * self.bodies - 1] = 1.0;
            }
            d.set(order, &self.loops.solve(&right)?);
        }
        Some(d)
    }

    /// How the datum moves a pin's point in its body.
    fn by(&self, datum: &Datum, pin: usize, side: usize) -> C {
        match datum.of {
            Some((p, s, by)) if (p, s) == (pin, side) => by,
            _ => C::default(),
        }
    }

    /// Drive and pins' coordinates.
    fn data(&self) -> Vec<Datum> {
        let mut all = vec![Datum {
            size: self.phi.abs(),
            of: None,
        }];
        for (pin, ends) in self.pins.iter().enumerate() {
            for (side, end) in ends.iter().enumerate() {
                for (size, by) in [(end.at.re, C::new(1.0, 0.0)), (end.at.im, I)] {
                    all.push(Datum {
                        size: size.abs(),
                        of: Some((pin, side, by)),
                    });
                }
            }
        }
        all.retain(|d| d.size > 0.0);
        all
    }

    fn centre(&self, k: usize) -> Spot {
        Spot {
            body: k + 1,
            at: self.centres[k],
        }
    }

    /// The two data of a centre of mass with their sizes.
    fn of_centre(&self, k: usize) -> [(f64, C); 2] {
        let c = self.centres[k];
        [(c.re.abs(), C::new(1.0, 0.0)), (c.im.abs(), I)]
    }

    /// Of nine values a body: angle, centre of mass, with derivatives; infinite at a singular position.
    pub(super) fn of_motion(&self) -> Vec<f64> {
        let mut sum = vec![[0.0; 9]; self.bodies];
        for datum in self.data() {
            let Some(d) = self.moved(&datum) else {
                return vec![f64::INFINITY; 9 * self.bodies];
            };
            for (k, sum) in sum.iter_mut().enumerate() {
                let path = self.change(self.centre(k), C::default(), &d);
                let values = d.turn[k + 1]
                    .into_iter()
                    .chain(path.into_iter().flat_map(|z| [z.re, z.im]));
                for (s, v) in sum.iter_mut().zip(values) {
                    *s += datum.size * v.abs();
                }
            }
        }
        let still = Motion::still(self.bodies);
        for (k, sum) in sum.iter_mut().enumerate() {
            for (size, by) in self.of_centre(k) {
                let path = self.change(self.centre(k), by, &still);
                let values = path.into_iter().flat_map(|z| [z.re, z.im]);
                for (s, v) in sum[3..].iter_mut().zip(values) {
                    *s += size * v.abs();
                }
            }
            let [path, turn] = self.system(k);
            for order in 0..2 {
                sum[1 + order] += turn[order];
                sum[5 + 2 * order] += path[order];
                sum[6 + 2 * order] += path[order];
            }
        }
        sum.concat()
    }

    /// Runs over every geometric datum with its size and the changes of centres and angles.
    fn each(
        &self,
        mut go: impl FnMut(f64, &[Path], &Motion, &dyn Fn(usize, usize) -> C),
    ) -> Option<()> {
        for datum in self.data() {
            let d = self.moved(&datum)?;
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
        Some(())
    }

    /// Of `I_n, dI_n/dφ, M_o, dM_o/dφ, Q`.
    pub(super) fn of_reduction(&self, i: &PlanarForcesInput) -> Vec<f64> {
        let g = C::new(i.gx, i.gy);
        let paths: Vec<Path> = (0..self.bodies)
            .map(|k| self.path(self.centre(k)))
            .collect();
        let square = i.speed * i.speed;
        let torque = |v: [f64; 4]| v[0] * i.acceleration + 0.5 * v[1] * square - v[2];
        let mut sum = [0.0; 5];
        let mut add = |size: f64, v: [f64; 4]| {
            let all = [v[0], v[1], v[2], v[3], torque(v)];
            sum.iter_mut()
                .zip(all)
                .for_each(|(s, v)| *s += size * v.abs());
        };
        let mut total = [0.0; 4];
        let mut systems = [0.0; 5];
        for (k, [_, v, a]) in paths.iter().enumerate() {
            let [_, w, e] = self.motion.turn[k + 1];
            let of_mass = [dot(*v, *v), 2.0 * dot(*v, *a), dot(g, *v), dot(g, *a)];
            let of_inertia = [w * w, 2.0 * w * e, 0.0, 0.0];
            add(i.m[k], of_mass);
            add(i.j[k], of_inertia);
            (0..4).for_each(|n| total[n] += i.m[k] * of_mass[n] + i.j[k] * of_inertia[n]);
        }
        for (size, along) in [(i.gx.abs(), C::new(1.0, 0.0)), (i.gy.abs(), I)] {
            let heavy = |n: usize| -> f64 {
                let terms = paths.iter().zip(i.m).map(|(p, m)| m * dot(along, p[n]));
                terms.sum()
            };
            add(size, [0.0, 0.0, heavy(1), heavy(2)]);
        }
        let size = |z: C| z.re.abs() + z.im.abs();
        for (k, [_, v, a]) in paths.iter().enumerate() {
            let ([path, turn], [_, w, e]) = (self.system(k), self.motion.turn[k + 1]);
            let (m, j, w, e) = (i.m[k], i.j[k], w.abs(), e.abs());
            let inertia = 2.0 * (m * size(*v) * path[0] + j * w * turn[0]);
            let by_path = m * (size(*v) * path[1] + size(*a) * path[0]);
            let slope = 2.0 * (by_path + j * (w * turn[1] + e * turn[0]));
            let heavy = path.map(|x| m * size(g) * x);
            let of = [inertia, slope, heavy[0], heavy[1]];
            let torque = inertia * i.acceleration.abs() + 0.5 * slope * square + heavy[0];
            of.into_iter()
                .chain([torque])
                .zip(&mut systems)
                .for_each(|(v, s)| *s += v);
        }
        let done = self.each(|size, changes, d, _| {
            let mut v = [0.0; 4];
            for (k, ([_, s1, s2], [_, d1, d2])) in paths.iter().zip(changes).enumerate() {
                let ([_, w, e], [_, dw, de]) = (self.motion.turn[k + 1], d.turn[k + 1]);
                let (m, j) = (i.m[k], i.j[k]);
                v[0] += 2.0 * (m * dot(*s1, *d1) + j * w * dw);
                v[1] += 2.0 * (m * (dot(*d1, *s2) + dot(*s1, *d2)) + j * (dw * e + w * de));
                v[2] += m * dot(g, *d1);
                v[3] += m * dot(g, *d2);
            }
            add(size, v);
        });
        sum[4] += (total[0] * i.acceleration).abs() + (total[1] * square).abs();
        match done {
            Some(()) => sum.iter().zip(systems).map(|(a, b)| a + b).collect(),
            None => vec![f64::INFINITY; 5],
        }
    }

    /// Of the forces in the pins; none at a singular position.
    pub(super) fn of_reactions(&self, i: &PlanarForcesInput) -> Option<Vec<f64>> {
        let n = 3 * self.bodies;
        let g = C::new(i.gx, i.gy);
        let (square, forward) = (i.speed * i.speed, i.acceleration);
        let arm = |s: &Spot| self.direction[s.body] * (s.at - self.centres[s.body - 1]);
        let mut matrix = DMatrix::zeros(n, n);
        for (j, pin) in self.pins.iter().enumerate() {
            for (s, sign) in pin.iter().zip([-1.0, 1.0]) {
                let Some(k) = s.body.checked_sub(1) else {
                    continue;
                };
                let arm = arm(s);
                matrix[(3 * k, 2 * j)] = sign;
                matrix[(3 * k + 1, 2 * j + 1)] = sign;
                matrix[(3 * k + 2, 2 * j)] = -sign * arm.im;
                matrix[(3 * k + 2, 2 * j + 1)] = sign * arm.re;
            }
        }
        matrix[(2, n - 1)] = 1.0;
        let sizes = matrix.abs();
        let lu = matrix.lu();
        let due = |mass: f64, by: C, inertia: f64, turn: f64| {
            [mass * by.re, mass * by.im, inertia * turn]
        };
        let in_time = |p: &Path| p[2] * square + p[1] * forward;
        let turning = |t: &[f64; 3]| t[2] * square + t[1] * forward;
        let paths: Vec<Path> = (0..self.bodies)
            .map(|k| self.path(self.centre(k)))
            .collect();
        let rows = |of: &dyn Fn(usize) -> [f64; 3]| {
            DVector::from_iterator(n, (0..self.bodies).flat_map(of))
        };
        let right = rows(&|k| {
            let turn = turning(&self.motion.turn[k + 1]);
            due(i.m[k], in_time(&paths[k]) - g, i.j[k], turn)
        });
        let forces = lu.solve(&right)?;
        let force = |j: usize| C::new(forces[2 * j], forces[2 * j + 1]);
        let mut sum = vec![0.0; 2 * self.pins.len()];
        let mut add = |size: f64, right: DVector<f64>| {
            let Some(change) = lu.solve(&right) else {
                return;
            };
            let pairs = sum.iter_mut().zip(change.iter());
            pairs.for_each(|(s, c)| *s += size * c.abs());
        };
        let only = |at: usize, v: [f64; 3]| rows(&|k| if k == at { v } else { [0.0; 3] });
        for k in 0..self.bodies {
            add(i.m[k], only(k, due(1.0, in_time(&paths[k]) - g, 0.0, 0.0)));
            let turn = turning(&self.motion.turn[k + 1]);
            add(i.j[k], only(k, [0.0, 0.0, turn]));
        }
        for (size, along) in [(i.gx.abs(), C::new(1.0, 0.0)), (i.gy.abs(), I)] {
            add(size, rows(&|k| due(i.m[k], -along, 0.0, 0.0)));
        }
        for (size, order, factor) in [(2.0 * square, 2, 1.0), (forward.abs(), 1, forward.signum())]
        {
            add(
                size,
                rows(&|k| {
                    let turn = self.motion.turn[k + 1][order] * factor;
                    due(i.m[k], paths[k][order] * factor, i.j[k], turn)
                }),
            );
        }
        self.each(|size, changes, d, by| {
            let mut right = rows(&|k| {
                due(
                    i.m[k],
                    in_time(&changes[k]),
                    i.j[k],
                    turning(&d.turn[k + 1]),
                )
            });
            for (j, pin) in self.pins.iter().enumerate() {
                for (side, sign) in [(0, -1.0), (1, 1.0)] {
                    let Some(k) = pin[side].body.checked_sub(1) else {
                        continue;
                    };
                    let place = self.change(pin[side], by(j, side), d)[0];
                    right[3 * k + 2] -= sign * cross(place - changes[k][0], force(j));
                }
            }
            add(size, right);
        })?;
        let mut right = sizes * forces.abs();
        for k in 0..self.bodies {
            let [path, turn] = self.system(k);
            let in_time = |of: [f64; 2]| of[1] * square + of[0] * forward.abs();
            right[3 * k] += i.m[k] * in_time(path);
            right[3 * k + 1] += i.m[k] * in_time(path);
            right[3 * k + 2] += i.j[k] * in_time(turn);
        }
        let systems = lu.try_inverse()?.abs() * right;
        Some(sum.iter().zip(systems.iter()).map(|(a, b)| a + b).collect())
    }
}
