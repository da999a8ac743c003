//! Points around the first zeros, where the code sums a Taylor series about the stored zero.
//!
//! With `δ = z − z_k`, `w = (2i/√π)(δ + h(δ))`, `h = δ² Σ g_n δⁿ`: as `w(z_k) = 0`,
//! `w′ = −2zw + 2i/√π`, the coefficients `d_n = g_{n−2}` obey `d_0 = 0`, `d_1 = 1`,
//! `n d_n = −2 (z_k d_{n−1} + d_{n−2})`.
//!
//! * **δ.** `x − z₀` is exact (Sterbenz), so is the sum with `−z₁`, `d + d₂`; `d₂ − z₂` is rounded,
//!   by at most `u(u|d| + |z₂|)`, and not at all where `x = z₀`. Elsewhere `|d|` is at least half a
//!   spacing of x, and `|z₂| ≤ 2⁻⁵³ |z₁|` at most `2⁻⁵³` of that: the pair is within `2.1u²` of
//!   itself and the error of the stored zero, a certified ball less the three parts.
//! * **h** is computed from the leading part δ₁, `|δ − δ₁| ≤ u|δ₁|`. Since
//!   `h′ = w′√π/(2i) − 1 = −2zw √π/(2i)`, h changes by at most `2|z||w|u|δ₁|` of `2/√π`, on the way
//!   |w| by less than 10⁻¹² of itself: relative to w it is `2|z||δ|u`.
//! * **Truncation.** `Σ |g̃_n − g_n| Dⁿ⁺²`, the terms that follow as far as they are computed, and
//!   a tail: on `|δ| ≤ 1` Grönwall's inequality for w′ gives `|w| ≤ (2/√π) e^{2(|z_k| + 1)}`, so
//!   that `|d_n| ≤ e^{2(|z_k| + 1)}`.
//! * **Rounding.** The code runs over rectangles of δ₁, in shells down to the distance of the f64
//!   next to the zero; the lower parts are any numbers that they may be. A rectangle on which the
//!   code surely gives up is none of these.

use super::phase::{U, around_zero};
use super::reflection::Value;
use crate::ProofError;
use crate::bounds::{above, exp_up, power_up, rational};
use crate::constants::TWO_OVER_SQRT_PI;
use crate::cover::Rectangle;
use crate::formula::TWO_52;
use crate::interval::{hypot_up, larger, product_up, sum_up, up};
use crate::tracked::{Rounding, Setting, Tracked, Tracking, evaluate};
use mechaudit_reference::{Ball, ComplexBall, faddeeva};
use mechaudit_solvers::faddeeva::proof::lower as code;
use rayon::prelude::*;
use rug::Rational;

const BITS: u32 = 320;
/// Coefficients g that are stored, and d that are computed.
const STORED: usize = 20;
const TERMS: usize = 60;
/// Above 2/√π.
const SLOPE: f64 = std::f64::consts::FRAC_2_SQRT_PI * (1.0 + f64::EPSILON);

/// A stored zero and its row, for tests perhaps with a fault.
#[derive(Clone)]
pub(crate) struct Zero {
    /// Of the solver.
    pub row: [f64; 46],
    /// Above the absolute value of the zero.
    size: f64,
    /// `|g̃_n − g_n|`, then `|d_n|` of what is left out.
    errors: Vec<f64>,
    /// The distance of the three parts from the zero.
    off: f64,
}

/// Describes what is proved around the zeros.
#[derive(Clone, Copy, Debug, Default)]
pub struct AroundZeros {
    /// Of the norm, in units of 2⁻⁵².
    pub norm: f64,
    /// Rectangles.
    pub boxes: usize,
    /// Where it is attained, the centre of the rectangle as `Re z` and `−Im z`.
    pub at: Option<Rectangle>,
}

/// Places of the real and the imaginary part of `g_n` in a row.
fn places(n: usize) -> [usize; 2] {
    let at = 6 + 8 * (n / 4) + n % 4;
    [at, at + 4]
}

impl Zero {
    /// Zero number k, from 1, with a row for it.
    ///
    /// # Errors
    /// If the reference is undecided.
    pub fn of(row: &[f64; 46], k: u32) -> Result<Zero, ProofError> {
        let z = faddeeva::zero(k, BITS)?;
        let off =
            |stored: Rational, exact: &Ball| above(&(&Ball::rational(2 * BITS, &stored) - exact));
        let sum = |at: usize| (at..at + 3).fold(Rational::new(), |s, i| s + rational(row[i]));
        let ball = |n: i64| ComplexBall::new(Ball::integer(BITS, n), Ball::integer(BITS, 0));
        let (mut before, mut here) = (ball(0), ball(1));
        let mut errors = Vec::new();
        for n in 2..TERMS {
            let factor = Ball::rational(BITS, &Rational::from((-2, n as u32)));
            let next = (&(&z * &here) + &before).scaled(&factor);
            (before, here) = (here, next);
            errors.push(match n - 2 {
                g if g < STORED => {
                    let [p, q] = places(g);
                    hypot_up(
                        off(rational(row[p]), &here.re),
                        off(rational(row[q]), &here.im),
                    )
                }
                _ => hypot_up(above(&here.re), above(&here.im)),
            });
        }
        Ok(Zero {
            row: *row,
            size: hypot_up(above(&z.re), above(&z.im)),
            errors,
            off: hypot_up(off(sum(0), &z.re), off(sum(3), &z.im)),
        })
    }

    /// A bound of what the series without rounding is wrong by, as a part of `|δ| ≤ D`.
    fn within(&self, d: f64) -> f64 {
        let (mut sum, mut power) = (0.0, d);
        for e in &self.errors {
            sum = sum_up(sum, product_up(*e, power));
            power = product_up(power, d);
        }
        sum_up(sum, tail(self.size, d))
    }

    /// Half the side of the square that holds all δ, and the least distance of an f64 from the zero
    /// in one of the coordinates.
    fn shells(&self, reach: f64) -> [f64; 2] {
        let nearest = self.row[1].abs().max(self.row[4].abs());
        [reach / self.row[0] * (1.0 + 1e-12), nearest * (1.0 - 1e-14)]
    }
}

/// Above `Σ |d_n| Dⁿ⁻¹` from `TERMS` on, `|d_n| ≤ e^{2(|z_k| + 1)}`, D below 1/10.
fn tail(size: f64, d: f64) -> f64 {
    let most = exp_up(up(2.0 * up(size + 1.0)));
    product_up(product_up(1.2, most), power_up(d, TERMS as u32 - 1))
}

/// Above |δ| with its low parts, `|δ₁|` at most `(x, y)`.
fn farthest(x: f64, y: f64) -> f64 {
    up(hypot_up(x, y) * (1.0 + 1e-12))
}

/// Returns what rounding makes of δ: `2.1u²` of itself, beside the error of the stored zero.
fn of_offset(d: f64, off: f64) -> f64 {
    sum_up(product_up(2.1 * U, product_up(U, d)), off)
}

/// `2|z||δ|u` with `|z| ≤ |z_k| + |δ|`, and what |w| changes on the way.
fn turn(size: f64, d: f64) -> f64 {
    product_up(product_up(2.0, up(size + d)), product_up(d, U)) * (1.0 + 1e-9)
}

/// Rectangles are cut into no more parts.
const DEPTH: u32 = 14;

type Signed = [[f64; 2]; 2];

/// The square ring between two distances as rectangles.
fn ring(inner: f64, outer: f64) -> [Signed; 4] {
    let whole = [-outer, outer];
    let side = [-inner, inner];
    [
        [[inner, outer], whole],
        [[-outer, -inner], whole],
        [side, [inner, outer]],
        [side, [-outer, -inner]],
    ]
}

/// Square rings that cover all δ from `least` to `outer` in the larger of its parts.
fn rings(outer: f64, least: f64) -> Vec<Signed> {
    let mut all = Vec::new();
    let mut from = outer;
    while from > least {
        let inner = 0.5 * from;
        all.extend(ring(inner, from));
        from = inner;
    }
    all
}

/// The largest bound with its rectangle.
fn largest(found: Vec<(f64, Signed)>) -> Option<(f64, Signed)> {
    found.into_iter().max_by(|p, q| p.0.total_cmp(&q.0))
}

/// A rectangle of offsets from the zero of a row as `Re z` and `−Im z`.
fn place(row: &[f64; 46], [re, im]: Signed) -> Rectangle {
    let [x, y] = [row[0], row[3]];
    Rectangle {
        a: re.map(|d| x + d),
        b: [-(y + im[1]), -(y + im[0])],
    }
}

fn most([lo, hi]: [f64; 2]) -> f64 {
    lo.abs().max(hi.abs())
}

/// The bound of the norm over a rectangle of δ₁, zero where the code surely gives up.
fn bound(zero: &Zero, rounding: Rounding, at: &Signed) -> Result<f64, &'static str> {
    let setting = Setting::new(&TWO_OVER_SQRT_PI, rounding);
    let [x, y] = at.map(most);
    let d = farthest(x, y);
    let ways = evaluate(setting, || {
        let part = |i: usize| (Tracked::input(i, at[i]), around_zero(up(most(at[i]) * U)));
        let (re, im, lost) = code::at_offset(Tracking, &zero.row, [part(0), part(1)]);
        (lost, [re.result(), im.result()])
    })?;
    let missing = sum_up(product_up(zero.within(d), d), of_offset(d, zero.off));
    let turn = turn(zero.size, d);
    let kept = ways.into_iter().filter(|(lost, _)| !lost);
    let norms = kept.map(|(_, parts)| {
        let value = Value::of(parts, product_up(SLOPE, missing));
        sum_up(value.norm(), product_up(turn, TWO_52))
    });
    Ok(norms.fold(0.0, larger))
}

fn refine(
    zero: &Zero,
    rounding: Rounding,
    target: f64,
    at: Signed,
    depth: u32,
    found: &mut Vec<(f64, Signed)>,
) -> Result<(), ProofError> {
    let why = match bound(zero, rounding, &at) {
        Ok(norm) if norm <= target => {
            found.push((norm, at));
            return Ok(());
        }
        Ok(norm) => format!("the bound is {norm}"),
        Err(why) => why.into(),
    };
    if depth == DEPTH {
        return Err(ProofError::Fails(format!(
            "around {:?} at {at:?}: {why}",
            &zero.row[..6]
        )));
    }
    let across = usize::from(at[1][1] - at[1][0] > at[0][1] - at[0][0]);
    let [lo, hi] = at[across];
    let middle = lo + 0.5 * (hi - lo);
    for half in [[lo, middle], [middle, hi]] {
        let mut part = at;
        part[across] = half;
        refine(zero, rounding, target, part, depth + 1, found)?;
    }
    Ok(())
}

impl AroundZeros {
    /// The zeros of the solver.
    ///
    /// # Errors
    /// If the reference is undecided about one.
    pub(crate) fn rows() -> Result<Vec<Zero>, ProofError> {
        let (rows, _) = code::zero_rows();
        let numbered: Vec<_> = rows.into_iter().zip(1..).collect();
        numbered
            .into_par_iter()
            .map(|(row, k)| Zero::of(row, k))
            .collect()
    }

    /// The bound around all of them.
    ///
    /// # Errors
    /// Where there is none.
    pub(crate) fn of(
        zeros: &[Zero],
        rounding: Rounding,
        target: f64,
    ) -> Result<AroundZeros, ProofError> {
        let (_, reach) = code::zero_rows();
        let rings = zeros.iter().flat_map(|zero| {
            let [outer, least] = zero.shells(reach);
            rings(outer, least).into_iter().map(move |r| (zero, r))
        });
        let rings: Vec<(&Zero, Signed)> = rings.collect();
        let each: Result<Vec<_>, ProofError> = rings
            .into_par_iter()
            .map(|(zero, at)| {
                let mut found = Vec::new();
                refine(zero, rounding, target, at, 0, &mut found)?;
                let boxes = found.len();
                let worst = largest(found).ok_or("no rectangle")?;
                Ok((zero, worst, boxes))
            })
            .collect();
        let mut all = AroundZeros::default();
        for (zero, (norm, at), boxes) in each? {
            all.boxes += boxes;
            if norm > all.norm {
                all.norm = norm;
                all.at = Some(place(&zero.row, at));
            }
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests;
