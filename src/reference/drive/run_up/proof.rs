//! The proof of one step: its defect, and the error that follows from it.
//!
//! Notation and equation (1) as in [`super::step`].
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
//! tube about p, the variation of constants gives `|e(u)| ≤ |e(0)| e^{āu} + (J̃/J) b ∫_0^u
//! e^{ā(u−s)} ds` as long as v stays in the tube; v is continuous, so it cannot leave a tube that
//! is wider than what follows from the bound. No box has to be guessed: the tube is `|v − p| ≤
//! 2^−16 p`, and the step is refused if the bound does not prove it. From rest (w = 1) e(0) = 0 and
//! F has the factor u, so with b for |F|/(uD) `|e| ≤ ½ b u² e^{max(ā,0)}`, and the same argument
//! holds for `χ = v/u`: at u = 0, where (1) gives `χ² = σ_1 (T(0) ± M_o)/J`, the difference of the
//! squares is `F/(u D J)`, which the bound covers.
//!
//! Differential inequalities of this kind: Walter, *Ordinary Differential Equations*, 1998, §9.
//! Time: `t_u = σ_1/χ`, with a polynomial q ≈ 1/χ̃ and `|1/χ̃ − q| ≤ |1 − χ̃ q|/χ̃`.

use super::setting::{Refusal, Setting};
use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag};
use rug::Float;
use rug::float::Round;

/// Half-width of the tube, relative: 2^−16.
const TUBE: i64 = -16;

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

/// The speeds of a step whose speed stays in the tube: from rest, those between as well.
fn speeds(tube: &Ball, rest: bool) -> Ball {
    match rest {
        true => tube.union(&Ball::integer(64, 0)),
        false => tube.clone(),
    }
}

fn growth(rest: bool, rate: f64, start: Mag, defect: Mag) -> Growth {
    let all = |most: Mag| Growth {
        end: most,
        most,
        mean: most,
    };
    if rest {
        // |e|/u².
        return all(defect.shift(-1).mul(exp_above(rate.max(0.0))));
    }
    if rate > 0.0 {
        return all(start.add(defect).mul(exp_above(rate)));
    }
    let one = Mag::from_f64(1.0);
    let share = one.div(Mag::from_f64(rate)).min(one);
    let added = defect.mul(share);
    Growth {
        end: start.mul(exp_above(rate)).add(added),
        most: start.add(added),
        mean: start.mul(share).add(added),
    }
}

/// `½ J |v² − p²|` at the start, p being the midpoint of v.
fn start_error(inertia: &Float, v: &Ball) -> Mag {
    let j0 = Mag::above(inertia);
    j0.mul(v.magnitude()).mul(v.rad())
}

/// The terms of (2) and (3), over one step.
pub(super) struct Proof<'a> {
    pub set: &'a Setting,
    /// True if w = 1.
    pub rest: bool,
    /// χ̃.
    pub chi: TaylorModel,
    /// J.
    pub inertia: TaylorModel,
    /// `G/u^w`.
    pub slope: TaylorModel,
    /// `±σ_1 M_o`.
    pub moment: TaylorModel,
    /// σ_1.
    pub s1: &'a Ball,
}

/// The proved bounds.
pub(super) struct Bounds {
    /// |χ − χ̃| over the step.
    pub chi_error: Mag,
    /// Time since the start of the step.
    pub time: TaylorModel,
    /// A lower bound on t_u.
    pub time_rate: Mag,
    /// v at the end.
    pub speed: Ball,
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

    /// The bounds, from the ball of the speed at the start (`None` at rest) and the polynomial
    /// q ≈ 1/χ̃.
    pub fn bound(&self, start: Option<&Ball>, inverse: &TaylorModel) -> Result<Bounds, Refusal> {
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
        let speeds = speeds(&tube, self.rest);
        let m = self.set.motor.slope(&speeds).with_prec(64).upper();
        let point = |x: Float| Ball::new(x, Mag::ZERO);
        let (jm, cm, s1) = match m < 0 {
            true => (j.upper(), tube.upper(), self.s1.lower()),
            false => (j.lower(), tube.lower(), self.s1.upper()),
        };
        let motor = point(m) * point(s1) / (point(jm) * point(cm));
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
        let e0 = start.map_or(Mag::ZERO, |v| start_error(&centre.coefficients()[0], v));
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
        Ok(Bounds {
            chi_error,
            time: inverse.scaled(self.s1).integral().widened(off),
            time_rate: below_quotient(self.s1, tube.magnitude()),
            speed: v.widened(end),
        })
    }
}

/// A lower bound on `a/b`, b an upper bound.
fn below_quotient(a: &Ball, b: Mag) -> Mag {
    let (a, b) = (a.mignitude().to_float(), b.to_float());
    Mag::below(&Float::with_val_round(53, &a / &b, Round::Down).0)
}

/// Faults that tests plant, to see them found.
#[cfg(test)]
pub(super) mod planted {
    use std::cell::Cell;
    thread_local! {
        pub static FORGET_DEFECT: Cell<bool> = const { Cell::new(false) };
    }
}

#[cfg(test)]
mod tests;
