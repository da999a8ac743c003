//! Points that the code computes again because terms cancel: in pairs of `f64`, and where even
//! those have too few digits in 256 bits.
//!
//! Let `z = a − ib`, `r = |z| ≥ 1`, `x = 2|e^{−z²}| = m 2^{k+1}`, `m ≤ 1.4143`. The error E is
//! proved as a part of `M = max(2^{k+1}, max(a, b)/r²)`, where `1/r ≤ √2 max(a, b)/r²`. The code
//! uses pairs only where the real part is above `P max(2^{k+1}, b/r²)` and the imaginary part above
//! `P a/r²`, so that they are above `P M` together: K is `E/(P − E)` and half a unit.
//!
//! Below, units of u². A sum of pairs is within 3 of itself, a product within 4, a square within 5,
//! a sum or product with an `f64` within 2 (Joldes, Muller & Popescu, as quoted by the solver), a
//! quotient within [`DIV`]. Underflow is below 2⁻¹⁰⁰⁰ and is not counted.
//!
//! * **Quotient** of `A = (H, l)` by `b = (B, m)`: `q = H/B` rounded, `qB` exactly, `H − p` exact
//!   (Sterbenz). What is left, `R = A − q b`, `|R| ≤ 3u|H|`, is formed with roundings of at most u²
//!   + 2u² + 3u² of H, divided by B for b (3u²) and rounded (3u²).
//! * **Exponential.** `|x − k ln 2| ≤` [`HALF_LN_2`] with errors 3, 3 and 2 of it; an eighth of it
//!   in the series, whose first 8 coefficients are pairs; three doublings `2m + m²`; 1 is added.
//!   Sine and cosine likewise, within [`REDUCED`] (the phase by Payne & Hanek: 64). The series by
//!   Horner's rule with absolute values of coefficients and argument.
//! * **−Re z²** is wrong by at most `9|Re z²|` (as in [`super::exponential`]). The exponential is
//!   below `2²⁰⁰` where it comes to this, and as a part `|Re z²| x ≤ 140 max(x, 1/r)` for
//!   `r < 5800`, `240 max(x, 1/r)` for `r < 2³³³`.
//! * **Sums over nodes.** With `d = |z − t|`, `d′ = |z + t|`, `ϱ = r²/(d d′)`: since `d′ ≥ r`,
//!   `d ≥ D = h/4` for the rule that is chosen, and `r ≤ d + t`, `ϱ ≤ r/d ≤ 1 + t/D`. `r² − t²` is
//!   wrong by `3r²` and 2 of itself, `|z² − t²|²` therefore by `6ϱ + 14` of itself, the weight
//!   divided by it by `6ϱ + 28`, each component of a term by `9ϱ + 40` of `weight/d`, and eleven
//!   sums, a factor and the last sum make `9ϱ + 80`. So r times the error of both components is at
//!   most `√2 Σ weight (1 + t/D)(9(1 + t/D) + 80)`.
//! * **Residue**, `2e^{−z²}(1 + κG − iGσ)/(1 + 2κG + G²)`, `κ ≥ 0`, `G ≤ 1`: the factor is at most
//!   one, the divisor at least. Its phase, `2π(64a − 23n)/23`, is wrong by 18 of at most π; its
//!   exponent by 5 of itself, times G at most `5/e`.
//! * **Truncation.** The rule's remainder on lines at `A = π/h` and at c above the axis is (head of
//!   `trapezoidal.rs` of the reference) at most
//!   `(1/√π)(e^{−A²}/A + e^{c² − 2cA}/|b − c|)/(1 − e^{−2cA})`: `c = A` but for b within 0.74 of
//!   it, where `c = 15/2`, above which the residue is below 2⁻²⁰⁰ of x. Nodes left out from S on:
//!   `(8/π) e^{−S²}(1 + 1/(2hS))`.
//! * **From |z| = 4096 on**: four terms. `1/(√π r²)` and the last products are pairs, within 30. In
//!   the correction g `3a² − b²` is wrong by `9u r²`, `b₁` by 1.01u, what they make by 9.1u r²,
//!   `1/r⁴` by 4.01u of itself: together 17u/r². What is left out: `√(11e/2) T₄`. Where `r⁴`
//!   overflows g is zero, or below 2⁻⁴⁰⁰ in any case.
//! * **256 bits.** Products are within 2⁻²⁵⁴, sums within that of the larger term, reciprocals
//!   within 2⁻²⁵¹; `e^{x + iφ}` is within `(8|x| + 2¹²) 2⁻²⁵⁴` (24 steps of Horner's rule, then 8
//!   squarings, each doubling the error) and the error of its phase, 2⁻²¹¹ (digits of 2/π left
//!   out). Weights by 52 quotients: 2⁻²³¹; terms as above with `ϱ ≤ 1 + 16t`: 2⁻²²⁷/r; the
//!   remainder with `h = 1/4` and nodes from 13 on: 2⁻²²⁵; twelve terms beyond: 2⁻²⁸⁰. All of it is
//!   below [`LONG`] of M. That |w| is not as small is the subject of [`super::apart`].

use super::phase::REDUCED;
use super::phase::U;
use crate::ProofError;
use crate::bounds::{above, exp_up, power_up, rational};
use crate::formula::TWO_52;
use crate::grid::power_of_two;
use crate::interval::{down, hypot_up, larger, product_up, quotient_up, sum_up, up};
use mechaudit_reference::{Ball, Mag};
use mechaudit_solvers::faddeeva::proof::lower as code;
use rug::{Integer, Rational};

const BITS: u32 = 600;
/// Errors of operations with pairs, in units of u².
const ADD: f64 = 3.01;
const MUL: f64 = 4.01;
const ADD_F: f64 = 2.01;
const DIV: f64 = 12.1;
const HALF_LN_2: f64 = 0.346_58;
/// The largest |Re z²| that counts, below |z| = 4096 and beyond.
const EXPONENTS: [f64; 2] = [140.0, 240.0];
/// The error in 256 bits, as a part of M.
const LONG: i32 = -200;
/// States what is left for errors of second order.
const SLACK: f64 = 1.0 + 1e-6;

/// Bounds of the norm, in units of 2⁻⁵².
#[derive(Clone, Copy, Debug)]
pub struct Again {
    /// In pairs, `|z| < 4096`.
    pub near: f64,
    /// In pairs beyond.
    pub far: f64,
    /// In 256 bits.
    pub long: f64,
}

fn pair([hi, lo]: [f64; 2]) -> Rational {
    rational(hi) + rational(lo)
}

/// `|stored − exact|`.
fn off(stored: &Rational, exact: &Ball) -> f64 {
    above(&(&Ball::rational(BITS, stored) - exact))
}

/// In units of u².
fn units(x: f64) -> f64 {
    quotient_up(quotient_up(x, U), U)
}

fn sum(terms: &[f64]) -> f64 {
    terms.iter().fold(0.0, |s, t| sum_up(s, *t))
}

/// `Σ c_j y^j` by Horner's rule, the first 8 coefficients and their sums in pairs: a bound of
/// `Σ |c_j| |y|^j`, and of the error in units of u², that of y being `dy`.
fn series(c: &[([f64; 2], Rational)], y: f64, dy: f64) -> [f64; 2] {
    const PAIRS: usize = 8;
    let (mut size, mut error) = (0.0, 0.0);
    for (j, (stored, exact)) in c.iter().enumerate().rev() {
        let coefficient = up(stored[0].abs() * (1.0 + 1e-15));
        let before = size;
        size = sum_up(coefficient, product_up(y, before));
        error = product_up(y, error);
        match j < PAIRS {
            // In units of u: y is rounded, so are c and the sum.
            false => error = sum(&[error, product_up(y, before), coefficient, size]),
            true => {
                if j + 1 == PAIRS {
                    error = quotient_up(error, U);
                }
                let constant = Rational::from(&pair(*stored) - exact).abs();
                error = sum(&[
                    error,
                    product_up(dy, before),
                    product_up(MUL, product_up(y, before)),
                    product_up(ADD, size),
                    units(up(constant.to_f64())),
                ]);
            }
        }
    }
    [size, product_up(error, SLACK)]
}

/// `1/n!` as stored, and exactly.
fn coefficient(c: &code::Again, n: usize) -> ([f64; 2], Rational) {
    let factorial = Integer::from(Integer::factorial(n as u32));
    (c.inverse_factorial[n], Rational::from((1, factorial)))
}

/// Returns what follows the powers of y below n in a series with coefficients below `1/m!`, in
/// units of u².
fn left_out(y: f64, n: u32, m: u32) -> f64 {
    let factorial = Integer::from(Integer::factorial(m)).to_f64();
    units(product_up(
        1.1,
        quotient_up(power_up(y, n), down(factorial)),
    ))
}

/// `e^x` in pairs without the error of x, as a part of it, in units of u².
fn exponential(c: &code::Again) -> f64 {
    let ln_2 = Ball::integer(BITS, 2).ln();
    let parts: Rational = c.ln_2.into_iter().map(rational).sum();
    let reduction = product_up(HALF_LN_2, sum(&[ADD, ADD, ADD_F]));
    let reduction = sum_up(reduction, units(product_up(2200.0, off(&parts, &ln_2))));
    let (y, dy) = (up(HALF_LN_2 / 8.0), up(reduction / 8.0));
    let all: Vec<_> = (1..=16).map(|n| coefficient(c, n)).collect();
    let [size, error] = series(&all, y, dy);
    let mut m = product_up(y, size);
    let mut e = sum(&[
        product_up(dy, size),
        product_up(y, error),
        product_up(MUL, m),
        left_out(y, 17, 17),
    ]);
    for _ in 0..3 {
        let square = product_up(m, m);
        let next = sum_up(2.0 * m, square);
        e = sum(&[
            product_up(2.0 * e, up(1.0 + m)),
            product_up(MUL, square),
            product_up(ADD, next),
        ]);
        m = next;
    }
    let e = sum_up(e, product_up(ADD_F, up(1.0 + m)));
    // e^{−½ ln 2} = 0.7071…
    product_up(quotient_up(e, 0.707), SLACK)
}

/// Sine and cosine together of a phase whose error, the reduction included, is `dr` units.
fn circle(c: &code::Again, dr: f64) -> f64 {
    let square = up(REDUCED * REDUCED);
    let dy = sum_up(product_up(2.0 * REDUCED, dr), product_up(MUL, square));
    let of = |first: usize| -> [f64; 2] {
        let all: Vec<_> = (0..14).map(|j| coefficient(c, 2 * j + first)).collect();
        series(&all, square, dy)
    };
    let ([s, ds], [k, dk]) = (of(1), of(0));
    let sine = sum(&[
        product_up(REDUCED, ds),
        product_up(s, dr),
        product_up(MUL, product_up(REDUCED, s)),
        left_out(square, 14, 29),
    ]);
    let cosine = sum(&[dk, product_up(MUL, k), left_out(square, 14, 28)]);
    product_up(hypot_up(sine, cosine), SLACK)
}

/// A phase of at most that many quarters less a multiple of π/2, in units of u².
fn reduction(half_pi: [f64; 3], quarters: f64) -> f64 {
    let parts: Rational = half_pi.into_iter().map(rational).sum();
    let left = product_up(quarters, off(&parts, &Ball::pi(BITS).shift(-1)));
    sum_up(product_up(REDUCED, sum(&[ADD, ADD, ADD_F])), units(left))
}

/// Half the nodes and the step of the rule in pairs, `h = 23/64`.
const STEP: f64 = 23.0 / 64.0;

/// `r` times the error of the sums, in units of u²; the stored nodes and weights are compared with
/// what they stand for.
fn sums(c: &code::Again) -> Result<f64, ProofError> {
    let distance = down(0.25 * STEP * (1.0 - 1e-9));
    let mut worst: f64 = 0.0;
    for rule in 0..2 {
        let mut all = 0.0;
        for (k, node) in c.nodes[rule].iter().enumerate() {
            let twice = 2 * k as u32 + rule as u32;
            let t = Rational::from((23 * twice, 128));
            let square = Rational::from(&t * &t);
            if Rational::from_f64(*node).as_ref() != Some(&square) {
                return Err(ProofError::Fails(format!(
                    "node {k} of the trapezoidal rule is wrong"
                )));
            }
            // 2h/π e^{−t²}, half of it at zero.
            let step = Rational::from((if twice == 0 { 23 } else { 46 }, 64));
            let exact = (-Ball::rational(BITS, &square)).exp();
            let exact = &(&exact * &Ball::rational(BITS, &step)) * &Ball::pi(BITS).recip();
            let [hi, lo] = c.weights[rule].map(|part| part[k]);
            let weight = above(&exact);
            let missing = units(quotient_up(off(&pair([hi, lo]), &exact), down(weight)));
            let t = up(t.to_f64());
            let by = sum_up(1.0, quotient_up(t, distance));
            let factor = sum(&[product_up(9.03, by), 80.0, product_up(1.01, missing)]);
            all = sum_up(all, product_up(weight, product_up(by, factor)));
        }
        worst = larger(worst, all);
    }
    Ok(product_up(std::f64::consts::SQRT_2, worst) * SLACK)
}

/// The remainder of the rule, and the nodes left out.
fn truncation() -> f64 {
    // A = 8.7418…, so that 8 is 0.74 below it.
    let most = std::f64::consts::PI / STEP;
    let least = down(down(most));
    let own = exp_up(-down(least * least));
    let other = exp_up(up(56.25 - down(15.0 * least)));
    let lines = sum(&[
        quotient_up(own, least),
        quotient_up(own, 0.74),
        quotient_up(other, 0.5),
    ]);
    let first = 24.0 * STEP;
    // 8/π, and 1 + 1/(2hS).
    let nodes = product_up(product_up(2.5465, exp_up(-down(first * first))), 1.17);
    // 1/√π, and 1 − e^{−2cA}.
    product_up(sum_up(product_up(0.5642, lines), nodes), 1.001)
}

/// Returns whether the constants of 256 bits are the numbers they stand for, each within 2⁻²⁵⁵ of
/// itself.
fn are_long(c: &code::Again) -> bool {
    let root = Ball::pi(BITS).sqrt().recip();
    let exact = [Ball::integer(BITS, 2).ln(), Ball::pi(BITS).shift(-1), root];
    c.long.iter().zip(exact).all(|((exponent, words), exact)| {
        let mut m = Integer::new();
        for w in words {
            m = (m << 64) + *w;
        }
        let stored = Ball::rational(BITS, &Rational::from(m)).shift(*exponent as i32 - 256);
        (&stored - &exact).magnitude() <= exact.mignitude().mul_below(Mag::power_of_two(-255))
    })
}

/// Returns whether errors in units of u² are those of rounding.
fn are_pairs(errors: &[f64]) -> bool {
    errors.iter().all(|e| *e <= 0.9)
}

/// The errors of phases in units of u²: below 4096² · 2.01 · 2/π quarters, beyond, there by Payne &
/// Hanek too, and of the residue.
fn phases(half_pi: [f64; 3]) -> [f64; 3] {
    let turn = product_up(up(std::f64::consts::PI), sum(&[DIV, MUL, 1.0]));
    [
        reduction(half_pi, 4e7),
        larger(reduction(half_pi, 7e8), product_up(64.0, REDUCED)),
        sum_up(turn, reduction(half_pi, 3.0)),
    ]
}

/// `e/(P − e) + ½` in units of 2⁻⁵².
fn norm(e: f64, part: f64) -> f64 {
    let left = down(down(part * (1.0 - 1e-12)) - e);
    sum_up(quotient_up(e, left) * TWO_52, 0.5 + 1e-6)
}

impl Again {
    /// The bounds for the solver's code.
    ///
    /// # Errors
    /// If a stored number is not what it stands for.
    pub fn of(c: &code::Again, half_pi: [f64; 3]) -> Result<Again, ProofError> {
        let pi = Ball::pi(BITS).shift(1);
        let part = &pi * &Ball::rational(BITS, &Rational::from((1, 23)));
        let of_two_pi: Vec<f64> = [pi, part]
            .iter()
            .zip(c.two_pi)
            .map(|(exact, (hi, lo))| units(quotient_up(off(&pair([hi, lo]), exact), down(hi))))
            .collect();
        let (hi, lo) = c.inverse_sqrt_pi;
        let of_root = units(2.0 * off(&pair([hi, lo]), &Ball::pi(BITS).sqrt().recip()));
        if !(are_pairs(&of_two_pi) && are_pairs(&[of_root])) {
            return Err("2π or 1/√π in pairs are wrong".into());
        }
        if !are_long(c) || c.long_rule != (52, 12.5) {
            return Err("the numbers of 256 bits are wrong".into());
        }
        let e = exponential(c);
        let [near, far, turn] = phases(half_pi).map(|off| circle(c, off));
        // The modulus of the residue, G.
        let g = sum_up(e, quotient_up(sum_up(MUL, 1.0), 2.7));
        let p = sum(&[turn, g, MUL, 2.0 * ADD_F]);
        let q = sum(&[turn, g, MUL]);
        let divisor = sum(&[g, 2.0 * turn, 3.0 * ADD, 3.0 * g, 3.0 * MUL, 4.0 * ADD_F]);
        let residue = sum(&[
            up(1.4143 * up(MUL + ADD)),
            hypot_up(p, q),
            divisor,
            DIV,
            ADD,
        ]);
        let gaussian = |circle: f64, x: f64| sum(&[product_up(9.0, x), e, circle, MUL]);
        let u2 = U * U;
        // 1/r ≤ √2 max(a, b)/r²; x ≤ 1.4143 times its power of two.
        let root = up(std::f64::consts::SQRT_2);
        let near = {
            let x = sum_up(gaussian(near, EXPONENTS[0]), residue);
            let all = sum_up(product_up(x, 1.4143), product_up(root, sums(c)?));
            let rule = product_up(truncation(), 4096.0 * 2.0);
            norm(
                up(sum_up(product_up(all, u2), rule) * SLACK),
                c.vanishing[0],
            )
        };
        let far = {
            let x = sum_up(gaussian(far, EXPONENTS[1]), ADD);
            // 1/r², and √(11e/2) · 105/16 r⁻⁸.
            let t = power_of_two(-24);
            let missing = product_up(25.4, power_up(t, 4));
            let image = sum(&[17.0 * U * t, 30.0 * u2, missing]);
            let e = sum_up(
                product_up(product_up(x, 1.4143), u2),
                product_up(0.798, image),
            );
            norm(up(e * SLACK), c.vanishing[1])
        };
        let apart = power_of_two(super::apart::APART);
        let long = norm(power_of_two(LONG), apart);
        Ok(Again { near, far, long })
    }
}

#[cfg(test)]
mod tests;
