//! One step along the path, proved.
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
//! # Defect
//! The candidate `p = u^w χ̃(u)` has a polynomial χ̃ > 0. With the motor as N/D the defect of (1)
//! times D is a polynomial expression of known functions,
//!
//! ```text
//! F = D (J p p_u + ½ G p² ∓ σ' M_o) − σ' N                                              (2)
//! ```
//!
//! (arguments p), evaluated in Taylor models, whose norm bounds it over the whole step; D ≥ S_k².
//!
//! # Error
//! Let J̃ be the polynomial of J's model and `e = ½ J̃ (v² − p²)`. Subtracting (1) for v and (2),
//!
//! ```text
//! e_u = a e − (J̃/J) F/D,     a = J̃_u/J̃ − G/J + 2 σ' m/(J (v + p))                       (3)
//! ```
//!
//! with m a value of `dM_d/dv` between p and v (mean value theorem). If a ≤ ā and |F|/D ≤ b over a
//! tube about p, the variation of constants gives
//! `|e(u)| ≤ |e(0)| e^{āu} + (J̃/J) b ∫_0^u e^{ā(u−s)} ds` as long as v stays in the tube; v is
//! continuous, so it cannot leave a tube that is wider than what follows from the bound. No box has
//! to be guessed: the tube is `|v − p| ≤ 2^−16 p`, and the step is refused if the bound does not
//! prove it. From rest (w = 1) every term of (3) has the factor u, hence `|e| ≤ ½ b u² e^{max(ā,0)}`
//! and the same argument holds for `χ = v/u`, with `χ(0)² = σ_1 (T(0) ± M_o)/J` from (1).
//!
//! Differential inequalities of this kind: Walter, *Ordinary Differential Equations*, 1998, §9.
//! Time: `t_u = σ_1/χ`, with a polynomial q ≈ 1/χ̃ and `|1/χ̃ − q| ≤ |1 − χ̃ q|/χ̃`.

use super::linkage_panel::Panel;
use super::motor::Characteristic;
use super::series::{Equation, reciprocal};
use crate::reference::taylor_model::TaylorModel;
use crate::reference::{Ball, Mag};
use rug::Float;
use rug::float::Round;

/// Half-width of the tube, relative: 2^−16.
const TUBE: i64 = -16;
/// Positions within a panel are multiples of 2^−GRID of its half-width.
pub(super) const GRID: u32 = 64;

/// What stays the same over a run.
pub(super) struct Setting {
    pub bits: u32,
    pub order: usize,
    /// Half the width of a panel in radians.
    pub half_width: Ball,
    /// I_1.
    pub rotor: Ball,
    /// Along the path.
    pub motor: Characteristic,
    /// Whether φ falls along the path.
    pub backward: bool,
}

/// Where a step starts: a position in its panel, and the speed along the path.
pub(super) struct Start {
    /// `w = (φ − φ_c)/h`.
    pub x: Float,
    /// What the true position may differ by.
    pub slack: Mag,
    /// `None` at rest.
    pub speed: Option<Ball>,
}

/// A proved step: the motion for `0 ≤ u ≤ 1`.
pub(super) struct Piece {
    x0: Float,
    slack: Mag,
    backward: bool,
    /// End of the step in the panel.
    pub x1: Float,
    theta: Ball,
    rest: bool,
    chi: TaylorModel,
    /// |χ − χ̃| over the step.
    chi_error: Mag,
    /// Time since the start of the step.
    time: TaylorModel,
    /// A lower bound on dt/du (from rest: on `dt/d(u)` as well, t_u = σ_1/χ).
    time_rate: Mag,
    /// Time at the end.
    pub duration: Ball,
    /// Speed along the path at the end.
    pub speed: Ball,
}

/// Why a step could not be proved.
pub(super) type Refusal = &'static str;

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

/// `e^x` rounded up.
fn exp_above(x: f64) -> Mag {
    let mut e = Float::with_val(64, x);
    e.exp_round(Round::Up);
    Mag::above(&e)
}

/// The most that e can be, at the end, anywhere, and in the mean over the step.
struct Growth {
    end: Mag,
    most: Mag,
    mean: Mag,
}

fn growth(rest: bool, rate: f64, start: Mag, defect: Mag) -> Growth {
    if rest {
        // |e|/u².
        let all = defect.shift(-1).mul(exp_above(rate.max(0.0)));
        return Growth {
            end: all,
            most: all,
            mean: all,
        };
    }
    if rate > 0.0 {
        let all = start.add(defect).mul(exp_above(rate));
        return Growth {
            end: all,
            most: all,
            mean: all,
        };
    }
    let one = Mag::from_f64(1.0);
    let share = one.div(Mag::from_f64(rate));
    let share = if share < one { share } else { one };
    let added = defect.mul(share);
    Growth {
        end: start.mul(exp_above(rate)).add(added),
        most: start.add(added),
        mean: start.mul(share).add(added),
    }
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
    let here = Float::with_val(bits, &start.x);
    let moved = |m: &TaylorModel| {
        let slack = start
            .slack
            .add(Mag::above(&Float::with_val(64, &here - &start.x)));
        m.shifted(&here, reach).widened(m.motion(slack.shift(1)))
    };
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

struct Proof<'a> {
    set: &'a Setting,
    rest: bool,
    chi: TaylorModel,
    inertia: TaylorModel,
    /// `G/u^w`.
    slope: TaylorModel,
    /// `±σ_1 M_o`.
    moment: TaylorModel,
    s1: &'a Ball,
}

/// Faults that tests plant, to see them found.
#[cfg(test)]
pub(super) mod planted {
    use std::cell::Cell;
    thread_local! {
        pub static FORGET_DEFECT: Cell<bool> = const { Cell::new(false) };
    }
}

struct Bounds {
    chi_error: Mag,
    time: TaylorModel,
    time_rate: Mag,
    speed: Ball,
}

impl Proof<'_> {
    /// F/u^w of (2).
    fn defect(&self) -> TaylorModel {
        let (bits, order) = (self.set.bits, self.set.order);
        let p = if self.rest {
            self.chi.times_x()
        } else {
            self.chi.clone()
        };
        let rate = p.derivative(Mag::ZERO);
        let p2 = p.squared(order);
        let half = Ball::exact(bits, 0.5);
        let force = self
            .inertia
            .times(&self.chi, order)
            .times(&rate, order)
            .plus(&self.slope.times(&p2, order).scaled(&half))
            .minus(&self.moment);
        let [n0, n1] = &self.set.motor.numerator;
        let numerator = p.scaled(n1).plus_ball(n0).scaled(self.s1);
        match &self.set.motor.denominator {
            None => force.minus(&numerator),
            Some([d0, d1, d2]) => {
                let d = p2.scaled(d2).plus(&p.scaled(d1)).plus_ball(d0);
                force.times(&d, order).minus(&numerator)
            }
        }
    }

    fn bound(&self, start: Option<&Ball>, inverse: &TaylorModel) -> Result<Bounds, Refusal> {
        let bits = self.set.bits;
        let lost = "the speed may vanish within the step";
        let range = self.chi.range();
        let j = self.inertia.range();
        let centre = self.inertia.centre();
        let (low, j_low) = (range.mignitude(), j.mignitude());
        let jc_low = centre.range().mignitude();
        if !range.is_positive() || !j.is_positive() || jc_low.is_zero() {
            return Err(lost);
        }
        // The tube.
        let slack = range.magnitude().shift(TUBE);
        let tube = range.widened(slack);
        let low_tube = low.sub_below(slack);
        if low_tube.is_zero() {
            return Err(lost);
        }
        // ā of (3).
        let speeds = if self.rest {
            Ball::between(64, &Float::new(64), &tube.upper())
        } else {
            tube.clone()
        };
        let m = self.set.motor.slope(&speeds).with_prec(64).upper();
        let point = |x: Float| Ball::new(x, Mag::ZERO);
        let (jm, cm) = if m < 0 {
            (j.upper(), tube.upper())
        } else {
            (j.lower(), tube.lower())
        };
        let s1 = if m < 0 {
            self.s1.lower()
        } else {
            self.s1.upper()
        };
        let motor = point(m) * point(s1.clone()) / (point(jm) * point(cm));
        let j_u = centre.derivative(Mag::ZERO);
        let g = if self.rest {
            self.slope.times_x()
        } else {
            self.slope.clone()
        };
        let inconsistent = j_u.minus(&g).norm().div(j_low);
        let tails = j_u.norm().mul(self.inertia.rad()).div(j_low).div(jc_low);
        let rate = motor
            .with_prec(64)
            .widened(inconsistent.add(tails))
            .upper()
            .to_f64_round(Round::Up);
        if !rate.is_finite() {
            return Err("the error's growth over the step is not bounded");
        }
        // b and e(0).
        let ratio = Mag::from_f64(1.0).add(self.inertia.rad().div(j_low));
        let defect = self
            .defect()
            .norm()
            .div(self.set.motor.denominator_below())
            .mul(ratio);
        #[cfg(test)]
        let defect = if planted::FORGET_DEFECT.get() {
            Mag::ZERO
        } else {
            defect
        };
        let e0 = start.map_or(Mag::ZERO, |v| {
            let j0 = Mag::above(&centre.coefficients()[0]);
            j0.mul(v.magnitude()).mul(v.rad())
        });
        let e = growth(self.rest, rate, e0, defect);
        let chi_error = e.most.div(jc_low).div(low_tube);
        if !(chi_error < slack) {
            return Err("the error leaves its tube");
        }
        // Speed at the end.
        let one = Ball::integer(bits, 1);
        let v = self.chi.eval(&one);
        let end = e
            .end
            .div(centre.eval(&one).mignitude())
            .div(v.mignitude().sub_below(slack));
        // Time.
        let residual = self
            .chi
            .times(inverse, self.set.order)
            .plus_ball(&Ball::integer(bits, -1));
        let off = residual
            .norm()
            .div(low)
            .add(e.mean.div(jc_low).div(low_tube).div(low_tube).div(low));
        let off = off.mul(self.s1.magnitude());
        let fastest = Mag::above(&tube.upper());
        Ok(Bounds {
            chi_error,
            time: inverse.scaled(self.s1).integral().widened(off),
            time_rate: below_quotient(self.s1, fastest),
            speed: v.widened(end),
        })
    }
}

/// A lower bound on `a/b`, b an upper bound.
fn below_quotient(a: &Ball, b: Mag) -> Mag {
    let q = Float::with_val_round(53, a.mignitude().to_float() / b.to_float(), Round::Down).0;
    Mag::below(&q)
}

impl Piece {
    /// The position in the panel, and the speed along the path, at the time `since` the start of
    /// the step, provided that it lies within the step.
    pub(super) fn at(&self, since: &Ball) -> (Ball, Ball) {
        let bits = self.chi.bits();
        let c = self.time.coefficients();
        let one = Float::with_val(bits, 1);
        // A root of the polynomial by the false position of its slope, kept in [0, 1].
        let value = |u: &Float| c.iter().rev().fold(Float::new(bits), |s, x| s * u + x);
        let slope = |u: &Float| {
            c.iter()
                .enumerate()
                .skip(1)
                .rev()
                .fold(Float::new(bits), |s, (k, x)| {
                    s * u + Float::with_val(bits, x * k as u32)
                })
        };
        let mut u = Float::with_val(bits, since.mid() / self.duration.mid());
        for _ in 0..60 {
            let miss = value(&u) - since.mid();
            let by = Float::with_val(bits, &miss / slope(&u));
            u -= &by;
            if !(u >= 0) {
                u = Float::new(bits);
            }
            if u > 1 {
                u = one.clone();
            }
            let tiny = by.is_zero() || by.get_exp().is_some_and(|e| e < 4 - bits as i32);
            if tiny {
                break;
            }
        }
        // |u − u_true| ≤ |t(u) − T| / min t_u.
        let at = Ball::new(u.clone(), Mag::ZERO);
        let miss = (self.time.eval(&at) - since).magnitude();
        let u = Ball::new(u, miss.div(self.time_rate));
        let chi = self.chi.eval(&u).widened(self.chi_error);
        let (advance, speed) = if self.rest {
            (u.square(), &u * &chi)
        } else {
            (u, chi)
        };
        let way = &advance * &self.theta;
        let from = Ball::new(self.x0.clone(), self.slack);
        let x = if self.backward {
            from - way
        } else {
            from + way
        };
        (x, speed)
    }
}
