//! `e^{−z²}` as the solver computes it: how far from it the number is, as a part of its absolute
//! value.
//!
//! With `−z² = x − iθ`, `x = y² − a²`, `θ = 2ay`, the code has `2^k e (c − i s)`, each of the three
//! factors from the solver's own functions, which are run over boxes of their arguments. The
//! quadrant, which swaps and signs c and s, is exact.
//!
//! * **x** is formed as `(y − a)(y + a)` from two exact sums and an exact product, `d₁ s₁ + p`, and
//!   three `fma`s of what is left: with P = |d₁ s₁| and |d₂| ≤ u|d₁|, |s₂| ≤ u|s₁|, |p| ≤ uP their
//!   results are at most 2.1 uP, 3.1 uP and 3.2 uP, so that they round by at most 8.4 u²P, and
//!   `P ≤ |x|/(1 − u)²`: [`ARGUMENT`] is a bound of the error as a part of x. The short form has
//!   one number, three roundings and so `3.01 u |x|`.
//! * **θ** is `two_prod(2a, y)`, exact.
//! * **k** is the integer next to `x log₂ e` in floating-point arithmetic, followed for each that
//!   it may be.
//! * `e` is run over intervals of the leading part of x, its low part any number that it may have.
//! * **θ − k π/2**: [`super::phase`].
//! * c and s are run over intervals of the leading part of the reduced phase.
//!
//! The products `e c`, `e s` are rounded once (u of the absolute value), or kept as two numbers to
//! [`PRODUCT`].

use super::phase::{self, Phase, U, around_zero};
use crate::ProofError;
use crate::grid::{exponent, power_of_two};
use crate::interval::{Interval, hypot_up, larger, product_up, quotient_up, sum_up, up};
use crate::tracked::{Rounding, Setting, Tracked, evaluate};
use crate::truncation::exponential_error;
use mechaudit_solvers::faddeeva::proof::lower as code;
use rayon::prelude::*;

/// `9 u²`: what the pair x is wrong by, as a part of it.
const ARGUMENT: f64 = 9.0 * U * U;
/// A product of two pairs, `a₁b₁` exactly and `a₁b₂ + (a₂b₁ + p)` rounded twice: at most
/// `u(2.1 + 3.2)u`, and `a₂b₂` left out, `u²`; less than `8u²` of the product.
const PRODUCT: f64 = 8.0 * U * U;

/// The arguments between which `e^x` is proved: above, 2e^x overflows (`ln 2¹⁰²⁴ = 709.78…`);
/// below, it is less than 2⁻¹⁰⁰⁰ and so is what the code has for it.
pub(crate) const LEAST: f64 = -700.0;
const MOST: f64 = 710.5;
/// Above the binary exponents of `e^X` there.
const MOST_EXPONENT: f64 = 1100.0;

/// The functions of an exponential that may be at fault, for tests.
#[derive(Clone)]
pub struct Factors {
    /// The stored numbers.
    pub constants: fn() -> code::Constants,
    /// Tells whether the low part of the argument is handed on.
    pub low_part: bool,
    /// How operations round.
    pub rounding: Rounding,
}

impl Default for Factors {
    fn default() -> Factors {
        Factors {
            constants: code::constants,
            low_part: true,
            rounding: Rounding::default(),
        }
    }
}

/// Bounds of `|computed − e^{−z²}|/|e^{−z²}|` without the power of two.
#[derive(Clone, Copy, Debug)]
pub struct Exponential {
    /// As pairs.
    pub pair: f64,
    /// As one number for each component.
    pub rounded: f64,
    /// With fewer digits: for `x = 0`, and what is added for each unit of |x|.
    pub short: [f64; 2],
    /// Sine and cosine alone, the leading parts of pairs.
    pub leading: f64,
    /// Boxes that were run.
    pub boxes: usize,
}

/// An error in each form of a factor.
#[derive(Clone, Copy, Default)]
struct Errors {
    pair: f64,
    rounded: f64,
    short: f64,
    leading: f64,
}

impl Errors {
    fn max(self, other: Errors) -> Errors {
        Errors {
            pair: larger(self.pair, other.pair),
            rounded: larger(self.rounded, other.rounded),
            short: larger(self.short, other.short),
            leading: larger(self.leading, other.leading),
        }
    }

    fn map(self, f: impl Fn(f64) -> f64) -> Errors {
        Errors {
            pair: f(self.pair),
            rounded: f(self.rounded),
            short: f(self.short),
            leading: f(self.leading),
        }
    }
}

/// Cuts `[lo, hi]` into intervals of `f64`s no longer than `step`.
fn intervals(lo: f64, hi: f64, step: f64) -> Vec<[f64; 2]> {
    let n = ((hi - lo) / step).ceil() as usize;
    let at = |i: usize| match i {
        0 => lo,
        _ if i == n => hi,
        _ => lo + (hi - lo) * (i as f64 / n as f64),
    };
    // Each begins where its neighbour ends: they share that number.
    (0..n).map(|i| [at(i), at(i + 1)]).collect()
}

/// The intervals of x: of each k the numbers that are surely next to `k ln 2`, cut into equal
/// parts, and between two k what may be next to either.
fn arguments() -> Vec<[f64; 2]> {
    const EITHER: f64 = 1e-9;
    const PARTS: usize = 20;
    let ln_2 = std::f64::consts::LN_2;
    let mut all = Vec::new();
    let mut from = LEAST - 1.0;
    let mut k = (from / ln_2).floor();
    while from < MOST {
        let edge = (k + 0.5) * ln_2;
        if edge - EITHER > from {
            let step = (edge - EITHER - from) / PARTS as f64;
            all.extend(intervals(from, edge - EITHER, 1.0001 * step));
            all.push([edge - EITHER, edge + EITHER]);
            from = edge + EITHER;
        }
        k += 1.0;
    }
    all
}

/// Returns what the low part of a pair may be: half a unit in the last place of the leading one.
fn low([lo, hi]: [f64; 2]) -> f64 {
    let most = Interval::new(lo, hi).magnitude();
    power_of_two((exponent(most) - 53).max(-1074))
}

/// An error as a part of the least value.
fn relative(error: f64, exact: Interval) -> f64 {
    quotient_up(error, exact.mignitude())
}

/// `e^x` over an interval of its leading part, each error as a part of it.
fn of_exp(f: &Factors, at: [f64; 2]) -> Result<Errors, &'static str> {
    let relative = |r: crate::tracked::Result| relative(r.error, r.exact);
    let both = evaluate(Setting::new(&[], f.rounding), || {
        let h = Tracked::input(0, at);
        let l = around_zero(if f.low_part { low(at) } else { 0.0 });
        let ((hi, lo), _) = code::exp((h, l));
        Errors {
            pair: relative(hi.exact_sum(lo)),
            rounded: relative(code::exp_rounded((h, l)).0.result()),
            ..Errors::default()
        }
    })?;
    let short = evaluate(Setting::new(&[], f.rounding), || Errors {
        short: relative(code::exp_short(Tracked::input(0, at)).0.result()),
        ..Errors::default()
    })?;
    let worst = both
        .into_iter()
        .chain(short)
        .fold(Errors::default(), Errors::max);
    // A low part that is not handed on is missing.
    let missing = if f.low_part {
        0.0
    } else {
        product_up(1.01, low(at))
    };
    Ok(Errors {
        pair: sum_up(worst.pair, missing),
        rounded: sum_up(worst.rounded, missing),
        ..worst
    })
}

/// Returns what the code makes of the low part l at `|x|` differs from `l cos x` by, with l
/// `(1 − x²/2)` and l alone, and from `l sin x` with `l x`.
fn of_low_part(x: f64, l: f64) -> [f64; 3] {
    let square = product_up(x, x);
    let cubed = product_up(square, x);
    [
        product_up(l, quotient_up(product_up(cubed, x), 24.0)),
        product_up(l, product_up(0.5, square)),
        product_up(l, sum_up(quotient_up(cubed, 6.0), product_up(l, l))),
    ]
}

/// The intervals of reduced phases.
fn circle() -> Vec<[f64; 2]> {
    intervals(-phase::REDUCED, phase::REDUCED, 1.0 / 96.0)
}

/// `(sin, cos)` over an interval of the leading part of a reduced phase, `at` within ±0.79: the
/// absolute value of both errors.
///
/// Without rounding the code has `S(x) + l (1 − x²/2)` and `C(x) − l x` for the phase `x + l`, S
/// and C polynomials ([`phase::polynomials`]); `l cos x` and `l sin x` are due, which differ by at
/// most `|l| x⁴/24` and `|l||x|³/6` (`|l| x²/2` where the sine has l itself), and by l² what
/// follows.
fn of_circle(
    f: &Factors,
    phase: &Phase,
    of_polynomials: [[f64; 2]; 2],
    at: [f64; 2],
) -> Result<Errors, &'static str> {
    let (x, l) = (Interval::new(at[0], at[1]).magnitude(), low(at));
    let error = |s: crate::tracked::Result, c: crate::tracked::Result| [s.error, c.error];
    let both = evaluate(Setting::new(&[], f.rounding), || {
        let r = (Tracked::input(0, at), around_zero(l));
        let [(sh, sl), (ch, cl)] = code::sin_cos(r);
        let (s, c) = code::sin_cos_rounded(r);
        let (p, q) = code::sin_cos_leading(r);
        [
            error(sh.exact_sum(sl), ch.exact_sum(cl)),
            error(s.result(), c.result()),
            error(p.result(), q.result()),
        ]
    })?;
    let second = product_up(l, l);
    let [sine, sine_rounded, cosine] = of_low_part(x, l);
    let all = |[s, c]: [f64; 2], missing: f64, of: [f64; 2]| {
        sum_up(
            hypot_up(
                sum_up(s, sum_up(missing, sum_up(second, of[0]))),
                sum_up(c, sum_up(cosine, sum_up(second, of[1]))),
            ),
            phase.error,
        )
    };
    let [accurate, rounded] = of_polynomials;
    let mut worst = Errors::default();
    for [p, r, q] in both {
        worst = worst.max(Errors {
            pair: all(p, sine, accurate),
            rounded: all(r, sine_rounded, rounded),
            leading: all(q, sine, rounded),
            ..Errors::default()
        });
    }
    Ok(worst)
}

impl Exponential {
    /// The bounds for the solver's code.
    ///
    /// # Errors
    /// Why there are none.
    pub fn of(f: &Factors) -> Result<Exponential, ProofError> {
        let c = (f.constants)();
        let phase = Phase::of(&c, f.rounding)?;
        let of_series = exponential_error(&c.exp, c.ln_2, MOST_EXPONENT);
        let all = arguments();
        let circle = circle();
        let worst = |each: Vec<Result<Errors, &'static str>>| {
            let all: Result<Vec<Errors>, &str> = each.into_iter().collect();
            all.map(|all| all.into_iter().fold(Errors::default(), Errors::max))
                .map_err(ProofError::from)
        };
        let polynomials = phase::polynomials(&c);
        let e = worst(all.par_iter().map(|at| of_exp(f, *at)).collect())?;
        let e = e.map(|x| sum_up(x, of_series));
        let t = worst(
            circle
                .par_iter()
                .map(|at| of_circle(f, &phase, polynomials, *at))
                .collect(),
        )?;
        let t = Errors {
            short: phase.short,
            ..t
        };
        let boxes = [all.len(), circle.len(), phase.boxes];
        Ok(Exponential::together(e, t, boxes.into_iter().sum()))
    }

    /// `e^x` and the sine and cosine multiplied, with the error of x.
    fn together(e: Errors, t: Errors, boxes: usize) -> Exponential {
        // (1 + p)(1 + q) − 1, and the error of x.
        let both = |p: f64, q: f64, more: f64| {
            let sum = sum_up(sum_up(p, q), product_up(p, q));
            product_up(sum_up(sum, more), 1.0 + 1e-12)
        };
        let argument = product_up(712.0, ARGUMENT);
        Exponential {
            pair: both(e.pair, t.pair, sum_up(argument, PRODUCT)),
            rounded: both(e.rounded, t.rounded, sum_up(argument, U)),
            leading: t.leading,
            short: [both(e.short, t.short, U), up(3.01 * U)],
            boxes,
        }
    }
}

#[cfg(test)]
mod tests;
