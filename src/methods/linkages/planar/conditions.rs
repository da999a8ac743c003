//! Condition numbers of a planar linkage by implicit differentiation: `Σ |p ∂f/∂p|` over the data
//! of a [`Flow`], and what the coefficients of its linear systems add.

use super::flow::{C, Flow, I, Motion, Path, Spot, cross, dot};
use super::input::{PlanarForcesInput, PlanarLinkageInput};
use super::inverse::Inverse;
use crate::methods::inputs::Fields;

/// Returns the condition numbers of the motion of a linkage in the method's layout.
pub(super) fn of_motion(numbers: &[f64]) -> Option<Vec<f64>> {
    let linkage = PlanarLinkageInput::unpack(numbers)?;
    Some(flow(&linkage)?.of_motion())
}

/// Returns the condition numbers of the reduction of a linkage in motion.
pub(super) fn of_reduction(numbers: &[f64]) -> Option<Vec<f64>> {
    let i = PlanarForcesInput::unpack(numbers)?;
    Some(flow(&i.linkage)?.of_reduction(&i))
}

/// Returns the condition numbers of the forces in the pins of a linkage in motion.
pub(super) fn of_reactions(numbers: &[f64]) -> Option<Vec<f64>> {
    let i = PlanarForcesInput::unpack(numbers)?;
    flow(&i.linkage)?.of_reactions(&i)
}

/// Returns the linkage at the angles of the reference.
fn flow(linkage: &PlanarLinkageInput) -> Option<Flow> {
    Flow::new(linkage, &linkage.angles()?)
}

impl Flow {
    /// Of nine values a body: angle, centre of mass, with derivatives.
    pub(super) fn of_motion(&self) -> Vec<f64> {
        let mut sum = vec![[0.0; 9]; self.bodies];
        for datum in self.data() {
            let d = self.moved(&datum);
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
        self.each(|size, changes, d, _| {
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
        sum.iter().zip(systems).map(|(a, b)| a + b).collect()
    }

    /// Of the forces in the pins; none at a singular position.
    pub(super) fn of_reactions(&self, i: &PlanarForcesInput) -> Option<Vec<f64>> {
        let n = 3 * self.bodies;
        let g = C::new(i.gx, i.gy);
        let (square, forward) = (i.speed * i.speed, i.acceleration);
        let arm = |s: &Spot| self.direction[s.body] * (s.at - self.centres[s.body - 1]);
        let mut matrix = vec![vec![0.0; n]; n];
        for (j, pin) in self.pins.iter().enumerate() {
            for (s, sign) in pin.iter().zip([-1.0, 1.0]) {
                let Some(k) = s.body.checked_sub(1) else {
                    continue;
                };
                let arm = arm(s);
                matrix[3 * k][2 * j] = sign;
                matrix[3 * k + 1][2 * j + 1] = sign;
                matrix[3 * k + 2][2 * j] = -sign * arm.im;
                matrix[3 * k + 2][2 * j + 1] = sign * arm.re;
            }
        }
        matrix[2][n - 1] = 1.0;
        let inverse = Inverse::of(matrix.clone())?;
        let due = |mass: f64, by: C, inertia: f64, turn: f64| {
            [mass * by.re, mass * by.im, inertia * turn]
        };
        let in_time = |p: &Path| p[2] * square + p[1] * forward;
        let turning = |t: &[f64; 3]| t[2] * square + t[1] * forward;
        let paths: Vec<Path> = (0..self.bodies)
            .map(|k| self.path(self.centre(k)))
            .collect();
        let rows = |of: &dyn Fn(usize) -> [f64; 3]| -> Vec<f64> {
            (0..self.bodies).flat_map(of).collect()
        };
        let right = rows(&|k| {
            let turn = turning(&self.motion.turn[k + 1]);
            due(i.m[k], in_time(&paths[k]) - g, i.j[k], turn)
        });
        let forces = inverse.times(&right);
        let force = |j: usize| C::new(forces[2 * j], forces[2 * j + 1]);
        let mut sum = vec![0.0; 2 * self.pins.len()];
        let mut add = |size: f64, right: Vec<f64>| {
            let change = inverse.times(&right);
            let pairs = sum.iter_mut().zip(&change);
            pairs.for_each(|(s, c)| *s += size * c.abs());
        };
        let only = |at: usize, v: [f64; 3]| rows(&|k| if k == at { v } else { [0.0; 3] });
        for k in 0..self.bodies {
            let by = in_time(&paths[k]) - g;
            add(i.m[k], only(k, [by.re, by.im, 0.0]));
            let turn = turning(&self.motion.turn[k + 1]);
            add(i.j[k], only(k, [0.0, 0.0, turn]));
        }
        for (size, along) in [(i.gx.abs(), C::new(1.0, 0.0)), (i.gy.abs(), I)] {
            add(size, rows(&|k| due(i.m[k], -along, 0.0, 0.0)));
        }
        for (size, order) in [(2.0 * square, 2), (forward.abs(), 1)] {
            let turn = |k: usize| self.motion.turn[k + 1][order];
            add(
                size,
                rows(&|k| due(i.m[k], paths[k][order], i.j[k], turn(k))),
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
        });
        let sizes = |row: &Vec<f64>| row.iter().zip(&forces).map(|(a, x)| (a * x).abs()).sum();
        let mut right: Vec<f64> = matrix.iter().map(sizes).collect();
        for k in 0..self.bodies {
            let [path, turn] = self.system(k);
            let in_time = |of: [f64; 2]| of[1] * square + of[0] * forward.abs();
            right[3 * k] += i.m[k] * in_time(path);
            right[3 * k + 1] += i.m[k] * in_time(path);
            right[3 * k + 2] += i.j[k] * in_time(turn);
        }
        let systems = inverse.abs().times(&right);
        Some(sum.iter().zip(systems).map(|(a, b)| a + b).collect())
    }
}
