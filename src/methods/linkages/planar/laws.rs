//! Identities that the solver's values of planar linkages have to satisfy.

use super::conditions;
use super::drawn::Linkage;
use super::input::{PlanarForcesInput, PlanarLinkageInput};
use crate::audit::{Law, largest};
use crate::methods::common::held;
use crate::methods::inputs::Fields;
use crate::solvers::planar::{Drive, GROUND, Mechanism};

const U: f64 = f64::EPSILON / 2.0;

pub(super) fn of_linkages() -> Vec<Law> {
    vec![
        Law {
            name: "mirror",
            statement: "mirrored at the x-axis, angles and ordinates change their sign and nothing else, within \
                        16 u of size and condition",
            residual: |x| mirror(|i| i.motion(), x),
        },
        Law {
            name: "scale",
            statement: "lengths times 2 leave angles and their derivatives bit for bit the same",
            residual: |x| scale(|i| i.motion(), x),
        },
        Law {
            name: "exchange",
            statement: "driven by its last body instead, at that body's angle, the linkage has the inverse rates, \
                        within 64 u of their conditions",
            residual: exchange,
        },
    ]
}

pub(super) fn of_reduction() -> Vec<Law> {
    vec![Law {
        name: "power-balance",
        statement: "the drive torque is that of the equations of Newton and Euler, within 16 u of size and condition",
        residual: power_balance,
    }]
}

pub(super) fn of_reactions() -> Vec<Law> {
    vec![
        Law {
            name: "virtual-work",
            statement: "in a translation of all bodies the pins on the ground do the work of weight and inertia, \
                        within 16 u of sizes and conditions",
            residual: |x| virtual_work(|i| i.forces(), x),
        },
        Law {
            name: "masses",
            statement: "masses and inertias times 2 double the forces bit for bit",
            residual: |x| masses(|i| i.forces(), x),
        },
    ]
}

/// A difference over what is allowed, which may be nothing.
fn share(off: f64, allowed: f64) -> f64 {
    match off == 0.0 {
        true => 0.0,
        false => off.abs() / allowed,
    }
}

/// The largest difference over what is allowed, `k u (|value| + condition)`.
fn within(k: f64, here: &[f64], there: &[f64], conditions: &[f64]) -> f64 {
    let all = here.iter().zip(there).zip(conditions);
    largest(all.map(|((a, b), c)| share(a - b, k * U * (a.abs() + c))))
}

type Solve = fn(PlanarLinkageInput) -> Result<Vec<f64>, &'static str>;
type SolveForces = fn(PlanarForcesInput) -> Result<Vec<f64>, &'static str>;

fn mirror(solve: Solve, x: &[f64]) -> Option<f64> {
    let i = PlanarLinkageInput::unpack(x)?;
    let here = solve(i).ok()?;
    let other = Linkage::of(&i).mirrored();
    let Ok(mut there) = solve(other.input()) else {
        return held(false);
    };
    // θ and its derivatives over φ: the first is even. Of x, y and their derivatives each
    // derivative changes the sign.
    let signs = [-1.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0];
    for (value, sign) in there.iter_mut().zip(signs.iter().cycle()) {
        *value *= sign;
    }
    let conditions = conditions::of_motion(x)?;
    Some(within(16.0, &here, &there, &conditions))
}

fn scale(solve: Solve, x: &[f64]) -> Option<f64> {
    let i = PlanarLinkageInput::unpack(x)?;
    let here = solve(i).ok()?;
    let other = Linkage::of(&i).scaled(2.0);
    let there = solve(other.input()).ok();
    held(there.is_some_and(|there| turns(&here).eq(turns(&there))))
}

/// Each body's angle and its derivatives, the first of its nine values.
fn turns(values: &[f64]) -> impl Iterator<Item = &[f64]> {
    values.chunks(9).map(|of_body| &of_body[..3])
}

fn exchange(x: &[f64]) -> Option<f64> {
    let i = PlanarLinkageInput::unpack(x)?;
    let here = i.motion().ok()?;
    let last = i.near.len();
    let of_last = 9 * (last - 1);
    let [angle, rate, second] = [0, 1, 2].map(|n| here[of_last + n]);
    let conditions = conditions::of_motion(x)?;
    // A last body that hardly moves, or whose rate is not known well, drives nothing.
    let vague = conditions[of_last + 1] / rate.abs();
    let known = angle.abs() + conditions[of_last];
    if !(rate.abs() > 1e-2 && vague < 1e4) {
        return None;
    }
    let mut description = i.solver().ok()?.description().clone();
    description.drive = Drive::Angle {
        body: last,
        from: GROUND,
    };
    // The other drive may leave a group that is not solved, or a mechanism in which it moves only a
    // part.
    let mechanism = Mechanism::new(description).ok()?;
    // Beside a dead position of that body two positions may be next to what was given.
    let near: Vec<f64> = (0..last).map(|k| here[9 * k]).collect();
    let driven = PlanarLinkageInput {
        phi: angle,
        near: &near,
        ..i
    };
    let state = driven.state(&mechanism).ok()?;
    let worst = (0..last).map(|k| {
        let due = here[9 * k + 1] / rate;
        let got = mechanism.body_angle(&state, k + 1).first;
        // The derivative by the last body's angle, which is rounded.
        let slope = (here[9 * k + 2] - due * second) / (rate * rate);
        let condition = conditions[9 * k + 1] / rate.abs() + due.abs() * vague;
        let allowed = 64.0 * U * (due.abs() + condition + slope.abs() * known);
        share(got - due, allowed)
    });
    Some(largest(worst))
}

fn power_balance(x: &[f64]) -> Option<f64> {
    let i = PlanarForcesInput::unpack(x)?;
    let mechanism = i.linkage.solver().ok()?;
    let loads = i.loads(&mechanism).ok()?;
    let state = i.linkage.state(&mechanism).ok()?;
    let reduced = loads.reduce(&mechanism, &state);
    let due = reduced.drive(i.speed, i.acceleration);
    let got = loads
        .reactions(&mechanism, &state, i.speed, i.acceleration)
        .ok()?
        .drive;
    let conditions = conditions::of_reduction(x)?;
    Some(within(16.0, &[due], &[got], &conditions[4..]))
}

/// Returns what the pins on the ground exert, and what weight and inertia ask for.
fn virtual_work(solve: SolveForces, x: &[f64]) -> Option<f64> {
    let i = PlanarForcesInput::unpack(x)?;
    let forces = solve(i).ok()?;
    let rows = i.linkage.motion().ok()?;
    let sizes = conditions::of_reactions(x)?;
    let moving = i.linkage.to_vec();
    let of_motion = conditions::of_motion(&moving)?;
    let worst = [0, 1].map(|axis| {
        let (mut sum, mut allowed) = (0.0, 0.0);
        for (k, (a, b)) in i.linkage.a.iter().zip(i.linkage.b).enumerate() {
            let sign = f64::from(u8::from(*a == 0.0)) - f64::from(u8::from(*b == 0.0));
            sum += sign * forces[2 * k + axis];
            allowed += sign.abs() * (forces[2 * k + axis].abs() + sizes[2 * k + axis]);
        }
        let g = [i.gx, i.gy][axis];
        for (k, m) in i.m.iter().enumerate() {
            let (first, second) = (9 * k + 5 + axis, 9 * k + 7 + axis);
            let square = i.speed * i.speed;
            let by = rows[second] * square + rows[first] * i.acceleration;
            sum -= m * (by - g);
            let condition = of_motion[second] * square + of_motion[first] * i.acceleration.abs();
            allowed += m * (by.abs() + g.abs() + condition);
        }
        share(sum, 16.0 * U * allowed)
    });
    Some(largest(worst))
}

fn masses(solve: SolveForces, x: &[f64]) -> Option<f64> {
    let i = PlanarForcesInput::unpack(x)?;
    let here = solve(i).ok()?;
    let twice = |v: &[f64]| -> Vec<f64> { v.iter().map(|x| 2.0 * x).collect() };
    let (m, j) = (twice(i.m), twice(i.j));
    let heavier = PlanarForcesInput { m: &m, j: &j, ..i };
    let there = solve(heavier).ok();
    held(there == Some(twice(&here)))
}

#[cfg(test)]
mod tests;
