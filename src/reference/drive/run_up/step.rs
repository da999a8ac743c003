//! One step along the path: the equation, the candidate and the length of the step.
//! [`super::proof`] proves it.
//!
//! # Equation along the path
//! On a piece of the path without a stop let `φ = φ_0 ± σ(u)`, `σ' = σ_1 u^w`, `0 ≤ u ≤ 1`, and
//! let v be the speed along the path, `T(v)` the motor's torque along it, `J = I_n + I_1`,
//! `G = ±σ' S` with S in the place of dI_n/dφ (`G = J_u` when S is the derivative of I_n). Then
//!
//! ```text
//! J v v_u = σ' (T(v) ± M_o) − ½ G v²       t_u = σ'/v                                   (1)
//! ```
//!
//! The first equation is scalar and does not contain t, so nothing wraps, and t is a quadrature.
//!
use super::linkage_panel::Panel;
use super::piece::Piece;
use super::proof::Proof;
use super::series::{Equation, reciprocal};
use super::setting::{Refusal, Setting};
use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag};
use rug::Float;

/// Positions within a panel are multiples of 2^−GRID of its half-width.
pub(super) const GRID: u32 = 64;

/// Where a step starts: a position in its panel, and the speed along the path.
pub(super) struct Start {
    /// `w = (φ − φ_c)/h`.
    pub x: Float,
    /// A bound on the distance to the true position.
    pub slack: Mag,
    /// `None` at rest.
    pub speed: Option<Ball>,
}

/// `first · c(f u)`.
fn rescaled(c: &[Float], f: &Float, first: Float, bits: u32) -> Vec<Float> {
    let mut power = first;
    c.iter()
        .map(|x| {
            let y = Float::with_val(bits, x * &power);
            power *= f;
            y
        })
        .collect()
}

/// The share of the scale at which the last coefficients fall below 2^−bits of the first, and all
/// but the first add up to less than `sum` of it.
fn usable(c: &[Float], bits: u32, sum: f64) -> f64 {
    let Some(e0) = c.first().and_then(Float::get_exp) else {
        return 0.0;
    };
    let mut log2 = 0f64;
    let n = c.len();
    for k in n.saturating_sub(4).max(1)..n {
        if n > 8
            && let Some(e) = c[k].get_exp()
        {
            let excess = f64::from(e - e0) + f64::from(bits);
            log2 = log2.min(-excess / k as f64);
        }
    }
    // Ratios as f64 on a logarithmic scale.
    let ratio: Vec<(f64, f64)> = c[1..]
        .iter()
        .enumerate()
        .filter_map(|(k, x)| {
            let e = x.get_exp()?;
            let m = Float::with_val(53, x / &c[0]).abs().to_f64();
            let log = if m > 0.0 && m.is_finite() {
                m.log2()
            } else {
                f64::from(e - e0)
            };
            Some((k as f64 + 1.0, log))
        })
        .collect();
    let total = |l: f64| ratio.iter().map(|(k, r)| (r + k * l).exp2()).sum::<f64>();
    for _ in 0..400 {
        if total(log2) <= sum {
            return log2.exp2();
        }
        log2 -= 0.25;
    }
    0.0
}

/// The model about the start at `bits`, wherever the true start lies, over the reach of a step.
fn moved(m: &TaylorModel, start: &Start, bits: u32, reach: Mag) -> TaylorModel {
    let here = Float::with_val(bits, &start.x);
    let off = Mag::above(&Float::with_val(64, &here - &start.x));
    let slack = start.slack.add(off);
    m.shifted(&here, reach).widened(m.motion(slack.shift(1)))
}

/// A step from `start` towards `limit`, at most half a panel long and at most `longest`.
pub(super) fn step(
    set: &Setting,
    panel: &Panel,
    start: &Start,
    limit: &Float,
    longest: f64,
) -> Result<Piece, Refusal> {
    let bits = set.bits;
    let wide = bits + 64;
    let rest = start.speed.is_none();
    let sign = if set.backward { -1 } else { 1 };
    let left = Float::with_val(wide, limit - &start.x).abs();
    let far = Float::with_val(wide, longest);
    let scale = if left < far { left.clone() } else { far };
    let reach = Mag::above(&scale);
    let moved = |m: &TaylorModel| moved(m, start, bits, reach);
    let inertia = moved(&panel.inertia).plus_ball(&set.rotor);
    let (slope, moment) = (moved(&panel.slope), moved(&panel.moment));
    let along = |m: &TaylorModel, theta: &Ball| {
        let m = m.contracted(&(if set.backward { -theta } else { theta.clone() }));
        if rest { m.of_square(2 * set.order) } else { m }
    };
    let sigma = |theta: &Ball| {
        let s = &set.half_width * theta;
        (if rest { s.shift(1) } else { s }).with_prec(bits)
    };

    // Candidate at the full scale, then at the share of it that the coefficients allow.
    let whole = Ball::new(scale.clone(), Mag::ZERO);
    let s1 = sigma(&whole);
    let signed = if set.backward { -&s1 } else { s1.clone() };
    let (n, d) = set.motor.midpoints();
    let at_scale = along(&inertia, &whole);
    let chi = Equation {
        inertia: at_scale.coefficients(),
        slope: along(&slope, &whole).scaled(&signed).coefficients(),
        moment: along(&moment, &whole).scaled(&signed).coefficients(),
        numerator: n.map(|n| n * s1.mid()),
        denominator: d,
        bits,
    }
    .solve(start.speed.as_ref().map(Ball::mid), set.order)
    .ok_or("the motion cannot be developed from its start")?;
    let inverse = reciprocal(&chi, set.order, bits);
    // A low degree is not driven into tiny steps: the last term may stay above rounding.
    let small = bits.min(3 * set.order as u32);
    let share = usable(&chi, small, 0.25)
        .min(usable(&inverse, small, 1.0))
        .min(usable(at_scale.coefficients(), 0, 0.5));
    let part = if rest { share * share } else { share };
    let (x1, theta) = if part >= 1.0 {
        let x1 = if scale == left {
            limit.clone()
        } else {
            on_grid(&start.x, &scale, sign, wide)
        };
        let theta = Float::with_val(wide, &x1 - &start.x).abs();
        (x1, theta)
    } else {
        let x1 = on_grid(&start.x, &Float::with_val(wide, &scale * part), sign, wide);
        let theta = Float::with_val(wide, &x1 - &start.x) * sign;
        (x1, theta)
    };
    if !(theta > 0) {
        return Err("the steps become too short: a stop, or a singular motion");
    }
    let mut f = Float::with_val(bits, &theta / &scale);
    if rest {
        f.sqrt_mut();
    }
    // From rest p = u χ, so χ takes one factor more, and its reciprocal one less.
    let one = Float::with_val(bits, 1);
    let (more, less) = if rest {
        (f.clone(), Float::with_val(bits, &one / &f))
    } else {
        (one.clone(), one)
    };
    let chi = TaylorModel::polynomial(rescaled(&chi, &f, more, bits));
    let inverse = TaylorModel::polynomial(rescaled(&inverse, &f, less, bits));

    // Models over the step: from the true start to x1.
    let theta = Ball::new(theta, start.slack);
    let s1 = sigma(&theta);
    let signed = if set.backward { -&s1 } else { s1.clone() };
    let inertia = along(&inertia, &theta);
    let slope = along(&slope, &theta).scaled(&signed);
    let moment = along(&moment, &theta).scaled(&signed);
    let proof = Proof {
        set,
        rest,
        chi,
        inertia,
        slope,
        moment,
        s1: &s1,
    };
    let done = proof.bound(start.speed.as_ref(), &inverse)?;
    Ok(Piece {
        x0: start.x.clone(),
        slack: start.slack,
        backward: set.backward,
        x1,
        theta,
        rest,
        duration: done.time.eval(&Ball::integer(bits, 1)),
        chi: proof.chi,
        chi_error: done.chi_error,
        time: done.time,
        time_rate: done.time_rate,
        speed: done.speed,
    })
}

/// `x ± length`, not further, on the grid of positions.
fn on_grid(x: &Float, length: &Float, sign: i32, bits: u32) -> Float {
    let aim = Float::with_val(bits, length * sign) + x;
    let mut scaled = aim << GRID;
    if sign > 0 {
        scaled.floor_mut();
    } else {
        scaled.ceil_mut();
    }
    scaled >> GRID
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;

    /// From anywhere in the slack the model about the start holds the function, and not much more.
    #[test]
    fn the_start_may_lie_anywhere_in_its_slack() {
        let bits = 100;
        let c: Vec<Float> = [1.0, -2.0, 0.0, 0.5, 3.0]
            .map(|x| Float::with_val(bits, x))
            .into();
        let f = TaylorModel::polynomial(c);
        for slack in [0.0, 1e-12, 1e-6] {
            let start = Start {
                x: Float::with_val(200, 0.3) + Float::with_val(200, 1e-40),
                slack: Mag::from_f64(slack),
                speed: None,
            };
            let model = moved(&f, &start, bits, Mag::from_f64(0.4));
            for off in [-slack, slack] {
                for y in [-0.375, 0.0, 0.25] {
                    let x = Float::with_val(300, &start.x + off) + y;
                    let due = f.eval(&Ball::new(x, Mag::ZERO));
                    let found = model.eval(&Ball::exact(300, y));
                    assert!(found.contains_ball(&due), "{slack} {off} {y}");
                }
            }
            assert!(model.rad() < Mag::from_f64(40.0 * slack + 1e-27), "{slack}");
        }
    }

    /// On the grid, no further than the length, and less than a unit short of it.
    #[test]
    fn steps_end_on_the_grid() {
        let unit = (-64f64).exp2();
        for x in [0.0, -0.75, 0.5] {
            let x = Float::with_val(128, x);
            for length in [0.3, 1e-3, 0.125] {
                for sign in [-1, 1] {
                    let length = Float::with_val(128, length);
                    let end = on_grid(&x, &length, sign, 128);
                    assert!((end.clone() << GRID).is_integer());
                    let way = Float::with_val(200, &end - &x) * sign;
                    assert!(
                        way <= length && way > length.clone() - unit,
                        "{x} {length} {sign}"
                    );
                }
            }
        }
    }

    /// A share keeps both conditions; twice as large a one does not, unless it is all of the scale.
    #[test]
    fn shares_are_within_both_conditions() {
        let mut draw = Draw(60);
        for n in [1, 2, 8, 9, 10, 14, 30] {
            for _ in 0..30 {
                let fall = draw.below(9) as i32;
                let c = (0..n).map(|k| match draw.below(8) {
                    0 => Float::new(60),
                    _ => Float::with_val(60, draw.sized(-2, 4)) >> (k as i32 * fall),
                });
                let c: Vec<Float> = c.collect();
                for (bits, sum) in [(0, 0.25), (40, 1.0), (60, 0.25)] {
                    let share = usable(&c, bits, sum);
                    if c[0].is_zero() {
                        assert_eq!(share, 0.0);
                        continue;
                    }
                    let kept = |share: f64| {
                        let size = |k: usize| {
                            let part = Float::with_val(53, &c[k] / &c[0]).to_f64().abs();
                            part * share.powi(k as i32)
                        };
                        let least = (1.0 - f64::from(bits)).exp2() * (1.0 + 1e-12);
                        let falls = n <= 8 || (n - 4..n).all(|k| size(k) <= least);
                        falls && (1..n).map(size).sum::<f64>() <= sum * (1.0 + 1e-12)
                    };
                    assert!(kept(share), "{n} {bits} {sum}: {share}");
                    assert!(
                        share == 1.0 || !kept(2.0 * share),
                        "{n} {bits} {sum}: {share}"
                    );
                }
            }
        }
    }
}
