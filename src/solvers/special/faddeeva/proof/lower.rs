//! Describes what the lower half-plane is made of: the formulas that serve it alone, `e^{−z²}` in
//! its parts, and the limits of the reflection.

use super::super::asymptotic::series;
use super::super::branch::formula_at;
use super::super::reflection as limits;
use super::super::rows::{REACH, below_real_axis, disc_cell, disc_row, zero_row};
use super::super::taylor::{ComplexRow, complex_row as unevaluated};
use super::super::{
    asymptotic, branch::Branch, long_functions, long_w, plane, tables, trapezoidal, zeros,
};
use super::{Real, Row, Vectors};
use crate::double_double::Dd;
use crate::double_double_functions as functions;
use crate::exponential as exponentials;
use crate::lanes::{Lanes, Task, with_best};
use crate::numbers::One;

/// Two numbers whose sum is meant.
pub type Pair<R> = (R, R);

fn dd<R>((hi, lo): Pair<R>) -> Dd<R> {
    Dd { hi, lo }
}

fn pair<R>(x: Dd<R>) -> Pair<R> {
    (x.hi, x.lo)
}

fn pairs<R>((x, y): (Dd<R>, Dd<R>)) -> [Pair<R>; 2] {
    [pair(x), pair(y)]
}

/// The formula at `a − i b`, zeros apart.
pub fn formula(a: f64, b: f64) -> Branch {
    formula_at(a, -b)
}

/// The row of the cell of the lower half-disc around `a − i b`, and the distance from its centre.
pub fn disc(a: f64, b: f64) -> (&'static Row, f64, f64) {
    let [n, dx, dy] = disc_cell(a, -b);
    (&disc_row(n).0, dx, dy)
}

/// w at distance `dx + i dy` from the centre of a row, unevaluated.
pub fn complex_row<L: Vectors>(
    lanes: L,
    row: &Row,
    dx: L::Scalar,
    dy: L::Scalar,
) -> [Pair<L::Scalar>; 2] {
    pairs(unevaluated(lanes, &ComplexRow(*row), dx, dy))
}

/// w at distance `t` from a centre on the real axis and `y < 0` from the axis.
pub fn real_axis_value<L: Vectors>(
    lanes: L,
    row: &Row,
    t: L::Scalar,
    y: L::Scalar,
) -> (L::Scalar, L::Scalar) {
    let (re, im) = unevaluated(lanes, &ComplexRow(*row), t, below_real_axis(y));
    (re.hi, im.hi)
}

/// The asymptotic series with N terms, unevaluated.
pub fn asymptotic<R: Real, const N: usize>(a: R, b: R) -> [Pair<R>; 2] {
    pairs(series::<R, N>(a, b))
}

/// w in the strip beside the real axis, at `a + i y`, and whether its terms cancel.
pub fn in_strip<R: Real>(a: R, y: R) -> (R, R, R::Mask) {
    plane::in_strip(a, y)
}

/// The same next to the real axis.
pub fn on_real_line<R: Real>(a: R, y: R) -> (R, R, R::Mask) {
    plane::on_real_line(a, y)
}

/// The stored zeros, and half the side of the square around each, times its real part.
pub fn zero_rows() -> (Vec<&'static [f64; 46]>, f64) {
    ((0..tables::ZEROS.len()).map(zero_row).collect(), REACH)
}

/// `a + i y` less the zero of a row.
pub fn offset<R: Real>(row: &[f64; 46], a: R, y: R) -> [Pair<R>; 2] {
    pairs(zeros::offset(row, a, y))
}

/// w at a distance from the zero of a row; `true` where it fails.
pub fn at_offset<L: Vectors>(
    lanes: L,
    row: &[f64; 46],
    [dx, dy]: [Pair<L::Scalar>; 2],
) -> (L::Scalar, L::Scalar, <L::Scalar as Real>::Mask) {
    zeros::at_offset(lanes, row, dd(dx), dd(dy))
}

/// `e^x = (hi + lo) 2^k`, and `ROUND + k`.
pub fn exp<R: Real>(x: Pair<R>) -> (Pair<R>, R) {
    let (e, n) = exponentials::exp(dd(x));
    (pair(e), n)
}

/// The same as one number.
pub fn exp_rounded<R: Real>(x: Pair<R>) -> (R, R) {
    exponentials::exp_rounded(dd(x))
}

/// The same of one number.
pub fn exp_short<R: Real>(x: R) -> (R, R) {
    exponentials::exp_short(x)
}

/// A phase less `k π/2`.
pub fn without_quarters<R: Real>(theta: Pair<R>, k: R) -> Pair<R> {
    pair(exponentials::without_quarters(dd(theta), k))
}

/// `(sin, cos)` of a reduced phase.
pub fn sin_cos<R: Real>(r: Pair<R>) -> [Pair<R>; 2] {
    pairs(exponentials::sin_cos_accurate(dd(r)))
}

/// The same as one number each.
pub fn sin_cos_rounded<R: Real>(r: Pair<R>) -> (R, R) {
    exponentials::sin_cos_rounded(dd(r))
}

/// The leading parts of those whose sine is not so accurate.
pub fn sin_cos_leading<R: Real>(r: Pair<R>) -> (R, R) {
    let (s, c) = exponentials::sin_cos_reduced(dd(r));
    (s.hi, c.hi)
}

/// `(sin, cos)` of a phase less `k π/2`, with fewer digits.
pub fn sin_cos_short<R: Real>(theta: Pair<R>, k: R) -> (R, R) {
    exponentials::sin_cos_short(dd(theta), k)
}

/// The stored constants of the exponential, the sine and the cosine.
pub struct Constants {
    /// `1/n!` from `n = 2` on.
    pub exp: [f64; 12],
    /// ln 2 in two parts.
    pub ln_2: [f64; 2],
    /// `(−1)^j/(2j + 3)!`.
    pub sin: [f64; 8],
    /// The same of the accurate sine, after [`sixth`](Self::sixth).
    pub sin_from_fifth: [f64; 7],
    /// `(−1)^j/(2j + 4)!`.
    pub cos: [f64; 7],
    /// 1/6 in two parts.
    pub sixth: [f64; 2],
    /// π/2 in three parts.
    pub half_pi: [f64; 3],
    /// The binary digits of 2/π after the point.
    pub two_over_pi: &'static [u64],
}

/// The solver's.
pub fn constants() -> Constants {
    let c = &exponentials::CONSTANTS;
    let mut exp = [0.5; 12];
    exp[1..].copy_from_slice(c.exp);
    Constants {
        exp,
        ln_2: exponentials::of_rounded().1,
        sin: *c.sin,
        sin_from_fifth: *c.sin_from_fifth,
        cos: *c.cos,
        sixth: c.sixth,
        half_pi: c.half_pi,
        two_over_pi: c.two_over_pi,
    }
}

/// The limits of the reflection.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// A component below this part of that of w(−z) is computed again.
    pub cancelled: f64,
    /// Both are where neither is above this part of the larger one of w(−z).
    pub both_cancelled: f64,
    /// `|Re z²|` above which one term dominates.
    pub dominant: f64,
    /// `Re z²` above which `e^{−z²}` is not added.
    pub negligible: f64,
    /// Binary exponents of `e^{−z²}` from which w(−z) is not added.
    pub alone: f64,
    /// `2ab` from which phases are reduced with more digits of π.
    pub large_phase: f64,
}

/// The solver's.
pub const LIMITS: Limits = Limits {
    cancelled: limits::CANCELLED,
    both_cancelled: limits::BOTH_CANCELLED,
    dominant: limits::DOMINANT,
    negligible: limits::NEGLIGIBLE,
    alone: limits::ALONE,
    large_phase: exponentials::LARGE_PHASE,
};

/// Describes what the values that are computed again are made of.
#[derive(Clone)]
pub struct Again {
    /// The squares of the nodes of both trapezoidal rules.
    pub nodes: [[f64; trapezoidal::NODES]; 2],
    /// Leading and low parts of the weights.
    pub weights: [[[f64; trapezoidal::NODES]; 2]; 2],
    /// Half the nodes that each rule of 256 bits has, and `Im z` above which it has no residue.
    pub long_rule: (u32, f64),
    /// `1/n!`, in two parts.
    pub inverse_factorial: &'static [[f64; 2]],
    /// ln 2 in three parts.
    pub ln_2: [f64; 3],
    /// 2π, and 2π/23, in two parts.
    pub two_pi: [Pair<f64>; 2],
    /// 1/√π in two parts.
    pub inverse_sqrt_pi: Pair<f64>,
    /// ln 2, π/2 and 1/√π in 256 bits: `0.m · 2^exponent`.
    pub long: [(i64, [u64; 4]); 3],
    /// The part of its terms below which a component is computed in 256 bits: below |z| = 4096, and
    /// beyond.
    pub vanishing: [f64; 2],
}

/// The solver's.
pub fn again() -> Again {
    let (two_pi, part) = trapezoidal::CONSTANTS;
    Again {
        nodes: tables::TRAPEZOIDAL_NODES,
        weights: tables::TRAPEZOIDAL_WEIGHTS,
        long_rule: long_w::RULE,
        inverse_factorial: functions::CONSTANTS.0,
        ln_2: functions::CONSTANTS.1,
        two_pi: [pair(two_pi), pair(part)],
        inverse_sqrt_pi: pair(super::super::constants::INV_SQRT_PI),
        long: [
            long_functions::LN_2,
            long_functions::HALF_PI,
            long_w::INV_SQRT_PI,
        ]
        .map(|x| x.words()),
        vanishing: [4095.0, 4097.0].map(|a| long_w::vanishing_part(a, a)),
    }
}

struct Pairs(f64, f64);

impl Task for Pairs {
    type Output = (Dd, Dd, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (Dd, Dd, f64) {
        match self.0.max(self.1) < 4096.0 {
            true => trapezoidal::lower(One(lanes), self.0, self.1),
            false => asymptotic::large(lanes, self.0, self.1),
        }
    }
}

/// w at `a − i b`, `1 ≤ |z| ≤ 10¹⁰⁰`, as it is computed again in pairs.
pub fn in_pairs(a: f64, b: f64) -> [Pair<f64>; 2] {
    let (re, im, _) = with_best(Pairs(a, b));
    pairs((re, im))
}

/// The same in 256 bits, rounded.
pub fn in_long(a: f64, b: f64) -> (f64, f64) {
    long_w::lower(a, b)
}
