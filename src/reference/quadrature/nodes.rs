//! Gauss–Legendre rules of any degree at any precision, each node and weight enclosed, and their
//! error.

use crate::{Ball, Ball128, Complex128, ComplexBall, Mag};
use rug::Float;
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

/// A rule of n nodes on `[−1, 1]`, which is symmetric.
#[derive(Debug)]
pub(super) struct Rule {
    /// The weight of the node zero, where the number of nodes is odd.
    pub centre: Option<Ball>,
    /// The positive nodes with their weights, descending.
    pub positive: Vec<(Ball, Ball)>,
    short: OnceCell<Option<ShortRule>>,
}

/// A rule in machine words.
#[derive(Debug)]
struct ShortRule {
    centre: Option<Ball128>,
    positive: Vec<(Ball128, Ball128)>,
}

/// Values that are summed in machine words.
pub(super) trait Short: Copy {
    /// The same with midpoints in MPFR.
    type Long;
    const ZERO: Self;
    fn plus(&self, other: &Self) -> Option<Self>;
    fn times(&self, factor: &Ball128) -> Option<Self>;
    fn to_long(self) -> Option<Self::Long>;
}

impl Short for Ball128 {
    type Long = Ball;
    const ZERO: Ball128 = Ball128::ZERO;
    fn plus(&self, other: &Ball128) -> Option<Ball128> {
        self.add(other)
    }
    fn times(&self, factor: &Ball128) -> Option<Ball128> {
        self.mul(factor)
    }
    fn to_long(self) -> Option<Ball> {
        self.to_ball()
    }
}

impl Short for Complex128 {
    type Long = ComplexBall;
    const ZERO: Complex128 = Complex128::ZERO;
    fn plus(&self, other: &Complex128) -> Option<Complex128> {
        self.add(other)
    }
    fn times(&self, factor: &Ball128) -> Option<Complex128> {
        self.scaled(factor)
    }
    fn to_long(self) -> Option<ComplexBall> {
        self.to_ball()
    }
}

/// The numbers of nodes in use: `2^(k/4)`, rounded, so that no more than 1.25 times the nodes
/// needed are evaluated.
pub(super) const DEGREES: [u32; 43] = [
    2, 3, 4, 5, 6, 7, 8, 10, 11, 13, 16, 19, 23, 27, 32, 38, 45, 54, 64, 76, 91, 108, 128, 152,
    181, 215, 256, 304, 362, 431, 512, 609, 724, 861, 1024, 1218, 1448, 1722, 2048, 2435, 2896,
    3444, 4096,
];

thread_local! {
    /// Rules by degree and precision.
    static RULES: RefCell<HashMap<(u32, u32), Rc<Rule>>> = RefCell::new(HashMap::new());
}

/// The most rules that are kept.
const KEPT: usize = 512;

/// The rule of n nodes whose nodes and weights have at least `bits` bits.
pub(super) fn rule(n: u32, bits: u32) -> Option<Rc<Rule>> {
    let bits = bits.next_multiple_of(32);
    if let Some(found) = RULES.with_borrow(|rules| rules.get(&(n, bits)).cloned()) {
        return Some(found);
    }
    let made = Rc::new(Rule::new(n, bits)?);
    RULES.with_borrow_mut(|rules| {
        if rules.len() >= KEPT {
            rules.clear();
        }
        rules.insert((n, bits), made.clone());
    });
    Some(made)
}

/// `P_n(x)` and `P_{n−1}(x)` for an exact x in `[−1, 1]`, by `P_{k+1} = x P_k + k (x P_k −
/// P_{k−1})/(k+1)`.
fn legendre(n: u32, x: &Float, bits: u32) -> (Float, Float) {
    let mut before = Float::with_val(bits, 1);
    let mut p = Float::with_val(bits, x);
    for k in 1..n {
        let along = Float::with_val(bits, x * &p);
        // The new value of `before` is the correction: no number is allocated for it.
        before -= &along;
        before *= k;
        before /= k + 1;
        before = along - before;
        std::mem::swap(&mut before, &mut p);
    }
    (p, before)
}

/// A bound on the error of both values of [`legendre`].
///
/// With `|P_k| ≤ 1`, computed values below 2 and a relative error `u = 2^−bits` of each operation,
/// a step adds at most 24 u. If step k adds `ε_k`, the generating function e of the errors
/// satisfies `(1 − 2xt + t²) e' = (x − t) e + Σ k ε_k t^(k−1)`, hence `e = G ∫ G Σ k ε_k w^(k−1)
/// dw` with the generating function G of the polynomials, whose coefficients are at most those of
/// `1/(1 − t)`. The coefficients of e are at most those of `max ε_k (1 − t)^−3/2`: `(n+1)(n+2)/4
/// max ε_k`.
fn legendre_error(n: u32, bits: u32) -> Mag {
    let n = f64::from(n);
    Mag::from_f64(6.0 * (n + 1.0) * (n + 2.0)).shift(-i64::from(bits))
}

/// The slope `P_n' = n (P_{n−1} − x P_n)/(1 − x²)`, rounded to nearest throughout.
fn slope(n: u32, x: &Float, p: &Float, before: &Float) -> Float {
    let bits = p.prec();
    let up = Float::with_val(bits, before - Float::with_val(bits, x * p)) * n;
    up / (1 - Float::with_val(bits, x.square_ref()))
}

/// The zero of `P_n` next to x, by Newton's method to `bits` bits.
fn refined(n: u32, x: f64, bits: u32) -> Float {
    let mut near = Float::with_val(53, x);
    // A double, with its four arithmetic operations alone, is the same on every machine.
    for _ in 0..4 {
        let x = near.to_f64();
        let (mut before, mut p) = (1.0, x);
        for k in 1..n {
            let along = x * p;
            let next = along + (along - before) * f64::from(k) / f64::from(k + 1);
            (before, p) = (p, next);
        }
        let slope = f64::from(n) * (before - x * p) / ((1.0 - x) * (1.0 + x));
        near = Float::with_val(53, x - p / slope);
    }
    // Each step doubles the accurate bits.
    let mut accurate = 40;
    while accurate < bits {
        accurate = (2 * accurate).min(bits);
        let work = accurate + 2 * n.ilog2() + 16;
        near.set_prec(work);
        let (p, before) = legendre(n, &near, work);
        let rate = slope(n, &near, &p, &before);
        near -= p / rate;
    }
    near
}

/// A bound on `|P_n''|` where `1 − x²` is at least `rest`: the differential equation `(1 − x²) P''
/// = 2x P' − n(n+1) P` with `|P| ≤ 1` and Bernstein's inequality `|P'| ≤ n/√(1 − x²)`.
fn curvature(n: u32, rest: Mag) -> Mag {
    let n = f64::from(n);
    let rate = Mag::from_f64(2.0 * n).div(rest);
    rate.add(Mag::from_f64(n * (n + 1.0))).div(rest)
}

/// Node and weight next to an approximation, if the interval Newton step proves a zero.
fn proved(n: u32, near: &Float, bits: u32) -> Option<(Ball, Ball)> {
    let (p, before) = legendre(n, near, bits);
    let error = legendre_error(n, bits);
    if !(error < Mag::from_f64(1.0)) {
        return None;
    }
    let (p, before) = (Ball::new(p, error), Ball::new(before, error));
    let x = Ball::new(near.clone(), Mag::ZERO);
    let one = Ball::integer(bits, 1);
    let whole = Ball::integer(bits, i64::from(n));
    let rate = &whole * &(&before - &(&x * &p)) / (&one - &x.square());
    // An interval of four times the expected step, and the slope over it.
    let radius = p.magnitude().div(rate.mignitude()).shift(2);
    let reach = Ball::new(near.clone(), radius);
    let rest = (&one - &reach.square()).mignitude();
    if !radius.is_finite() || !reach.is_positive() || rest.is_zero() {
        return None;
    }
    let rate = rate.widened(radius.mul(curvature(n, rest)));
    let step = &p / &rate;
    if !(step.magnitude() < radius) {
        return None;
    }
    let node = &x - &step;
    let weight = Ball::integer(bits, 2) / ((&one - &node.square()) * rate.square());
    Some((node, weight))
}

impl Rule {
    /// Encloses every positive zero by the interval Newton method: `x − P(x)/P'(X)` in the interior
    /// of X holds a zero, and as many balls as zeros that do not meet hold all. The slope at the
    /// zero lies in `P'(X)`, and the weight is `2/((1 − x²) P'(x)²)`. None if a zero is not proved.
    fn new(n: u32, bits: u32) -> Option<Rule> {
        let work = bits + 3 * n.ilog2() + 24;
        let mut positive: Vec<(Ball, Ball)> = Vec::with_capacity(n as usize / 2);
        for i in 1..=n / 2 {
            let angle = std::f64::consts::PI * (f64::from(i) - 0.25) / (f64::from(n) + 0.5);
            // The cosine of MPFR is the same on every machine.
            let start = Float::with_val(53, angle).cos().to_f64();
            let (node, weight) = proved(n, &refined(n, start, work), work)?;
            if positive
                .last()
                .is_some_and(|(x, _)| !(x - &node).is_positive())
                || !node.is_positive()
            {
                return None;
            }
            positive.push((node.with_prec(bits), weight.with_prec(bits)));
        }
        let centre = (n % 2 == 1).then(|| {
            // P_n(0) is exactly zero: P_n'(0) = n P_{n−1}(0).
            let (_, before) = legendre(n, &Float::new(work), work);
            let rate =
                Ball::new(before, legendre_error(n, work)) * Ball::integer(work, i64::from(n));
            (Ball::integer(work, 2) / rate.square()).with_prec(bits)
        });
        let short = OnceCell::new();
        Some(Rule {
            centre,
            positive,
            short,
        })
    }

    /// The sum over the nodes between `mid ± half` in machine words.
    pub fn short_sum<V: Short>(
        &self,
        [mid, half]: [&Ball; 2],
        mut at: impl FnMut(&Ball128) -> Option<V>,
    ) -> Option<V::Long> {
        let of = Ball128::of_ball;
        let make = || {
            let positive = self.positive.iter().map(|(x, w)| Some((of(x)?, of(w)?)));
            Some(ShortRule {
                centre: match &self.centre {
                    Some(weight) => Some(of(weight)?),
                    None => None,
                },
                positive: positive.collect::<Option<_>>()?,
            })
        };
        let rule = self.short.get_or_init(make).as_ref()?;
        let [mid, half] = [of(mid)?, of(half)?];
        let mut sum = match &rule.centre {
            Some(weight) => at(&mid)?.times(weight)?,
            None => V::ZERO,
        };
        for (x, weight) in &rule.positive {
            let off = x.mul(&half)?;
            let both = at(&mid.sub(&off)?)?.plus(&at(&mid.add(&off)?)?)?;
            sum = sum.plus(&both.times(weight)?)?;
        }
        sum.times(&half)?.to_long()
    }
}

/// An upper bound on `x^n`.
pub(super) fn power(x: Mag, n: u32) -> Mag {
    let (mut square, mut result) = (x, Mag::from_f64(1.0));
    for bit in 0..u32::BITS - n.leading_zeros() {
        if n >> bit & 1 == 1 {
            result = result.mul(square);
        }
        square = square.mul(square);
    }
    result
}

/// A bound on the error of n ≥ 2 nodes for an integrand that is holomorphic and at most `most`
/// within the ellipse with the foci ±1 and the half-axes `(ρ ± 1/ρ)/2`.
///
/// The Chebyshev coefficients are at most `2 M ρ^−k`; the rule is exact below degree 2n and odd
/// terms vanish; `|∫ T_k| ≤ 2/(k² − 1)`, and the rule's value is at most 2. The even terms from 2n
/// on add up to `(64/15) M ρ^−2n/(1 − ρ^−2)` at most (Rabinowitz 1969; Trefethen, *Approximation
/// Theory and Approximation Practice*, 2013, Thm 19.3).
pub(super) fn error(most: Mag, rho: f64, n: u32) -> Mag {
    debug_assert!(n >= 2 && rho > 1.0);
    let one = Mag::from_f64(1.0);
    let inverse = one.div(Mag::from_f64(rho));
    let square = inverse.mul(inverse);
    let factor = Mag::from_f64(64.0).div(Mag::from_f64(15.0));
    factor
        .mul(most)
        .mul(power(square, n))
        .div(one.sub_below(square))
}

/// The least number of [`DEGREES`] that brings the error below a bound, up to a greatest one.
pub(super) fn degree(most: Mag, rho: f64, goal: Mag, greatest: u32) -> Option<u32> {
    let enough = |n: &u32| error(most, rho, *n) <= goal;
    let all = DEGREES.iter().take_while(|n| **n <= greatest);
    all.copied().find(enough)
}

/// The half-axes `(ρ ± 1/ρ)/2`, rounded up.
pub(super) fn half_axes(rho: f64) -> [Mag; 2] {
    let one = Mag::from_f64(1.0);
    let (upper, lower) = (one.div(Mag::from_f64(rho)), 1.0 / rho);
    let major = Mag::from_f64(rho).add(upper).shift(-1);
    // One step below the rounded quotient is a lower bound.
    let minor = Mag::from_f64((rho - lower.next_down()).next_up()).shift(-1);
    [major, minor]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;
    use rug::ops::Pow;

    /// A rule of n nodes is exact for powers below `2n`.
    #[test]
    fn powers_are_exact_below_twice_the_nodes() {
        for n in [2u32, 3, 4, 11, 32, 45] {
            for bits in [64, 300] {
                let rule = Rule::new(n, bits).unwrap();
                for k in (0..2 * n).step_by(2) {
                    let mut sum = match (&rule.centre, k) {
                        (Some(weight), 0) => weight.clone(),
                        _ => Ball::integer(bits, 0),
                    };
                    for (x, w) in &rule.positive {
                        let power = (0..k).fold(Ball::integer(bits, 1), |p, _| p * x);
                        sum = sum + (&power * w).shift(1);
                    }
                    assert!(sum.contains(&Rational::from((2, k + 1))), "{n} {k}");
                    let least = i64::from(bits) - 12;
                    assert!(sum.rad() < Mag::power_of_two(-least), "{n} {k} {bits}");
                }
            }
        }
    }

    /// The nodes are those of the other proof of this room, which works with balls throughout.
    #[test]
    fn nodes_agree_with_the_recurrence_in_balls() {
        for n in [2u32, 3, 16, 23] {
            let other = crate::gauss_legendre::GaussLegendre::new(n as usize, 120).unwrap();
            let rule = Rule::new(n, 120).unwrap();
            for ((x, w), (y, v)) in rule.positive.iter().zip(other.nodes.iter().rev()) {
                assert!(x.overlaps(y) && w.overlaps(v), "{n}");
            }
            assert_eq!(rule.positive.len(), n as usize / 2);
        }
    }

    /// Values by the recurrence against exact ones lie within the bound, and a thousandth of it is
    /// too little nowhere near: the bound is used at `bits` where it is far below the radii that
    /// matter.
    #[test]
    fn the_error_of_the_recurrence() {
        for (n, bits) in [(2u32, 24), (9, 30), (40, 53), (150, 70)] {
            for k in 1..40 {
                let x = Float::with_val(24, k) / 40;
                let exact = |n: u32| {
                    let x = Ball::new(Float::with_val(1000, &x), Mag::ZERO);
                    let (mut before, mut p) = (Ball::integer(1000, 1), x.clone());
                    for k in 1..i64::from(n) {
                        let next = (Ball::integer(1000, 2 * k + 1) * (&x * &p)
                            - Ball::integer(1000, k) * &before)
                            / Ball::integer(1000, k + 1);
                        before = p;
                        p = next;
                    }
                    [p, before]
                };
                let (p, before) = legendre(n, &x, bits);
                let error = legendre_error(n, bits);
                for (found, due) in [p, before].into_iter().zip(exact(n)) {
                    assert!(Ball::new(found, error).contains_ball(&due), "{n} {k}");
                }
            }
        }
    }

    /// The second derivative of `P_3 = (5x³ − 3x)/2` is 15 x.
    #[test]
    fn the_curvature_is_a_bound() {
        for k in 0..100 {
            let x = f64::from(k) / 100.0;
            let bound = curvature(3, Mag::from_f64(1.0 - x * x)).to_f64();
            assert!(bound >= 15.0 * x, "{x}");
        }
        // P_n''(0) = −n(n+1) P_n(0) is the larger term of the two.
        let (middle, _) = legendre(40, &Float::new(100), 100);
        let due = middle.to_f64().abs() * 40.0 * 41.0;
        assert!(curvature(40, Mag::from_f64(1.0)).to_f64() >= due);
    }

    /// Not every start lies next to a zero, and no ball is given that holds none.
    #[test]
    fn what_is_no_zero_is_no_node() {
        let due = (Ball::integer(200, 1) / Ball::integer(200, 3)).sqrt();
        let mut refused = 0;
        for i in 1..200 {
            let near = Float::with_val(100, i) / 200;
            let found = proved(2, &near, 100);
            refused += u32::from(found.is_none());
            assert!(found.is_none_or(|(node, _)| node.is_finite() && node.overlaps(&due)));
        }
        assert!(refused > 20, "{refused}");
        assert!(proved(9, &Float::with_val(100, 0.999), 100).is_none());
    }

    /// ∫ 1/(x² + a²) with poles at ±ia just outside the ellipse: the bound holds, and a thousandth
    /// of it does not.
    #[test]
    fn the_bound_holds_and_is_near() {
        let bits = 128;
        let a = Rational::from((77, 100));
        let square = Ball::rational(bits, &Rational::from(a.square_ref()));
        for n in [4u32, 6, 8] {
            let rule = rule(n, bits).unwrap();
            let mut sum = Ball::integer(bits, 0);
            for (x, w) in &rule.positive {
                sum = sum + (w / &(x.square() + &square)).shift(1);
            }
            let a = Ball::rational(bits, &a);
            let due = Ball::integer(bits, 1).atan2(&a).shift(1) / &a;
            let most =
                Ball::integer(bits, 1) / (&square - Ball::rational(bits, &Rational::from((9, 16))));
            let bound = error(most.magnitude(), 2.0, n);
            let off = sum - due;
            assert!(off.magnitude() < bound, "{n}");
            assert!(off.mignitude() > bound.shift(-10), "{n}");
            assert_eq!(degree(most.magnitude(), 2.0, bound, 4096), Some(n));
            assert_eq!(degree(most.magnitude(), 2.0, bound, 3), None);
        }
    }

    #[test]
    fn half_axes_are_rounded_up_and_no_farther() {
        for rho in [1.1, 1.5, 2.0, 2.4, 3.75, 1e3, 1e9] {
            let exact = Rational::from_f64(rho).unwrap();
            let other = Rational::from(exact.recip_ref());
            let due = [
                Rational::from(&exact + &other) / 2,
                Rational::from(&exact - &other) / 2,
            ];
            for (found, due) in half_axes(rho).iter().zip(due) {
                let found = found.to_float().to_rational().unwrap();
                assert!(found >= due && found <= due * Rational::from_f64(1.0 + 1e-14).unwrap());
            }
        }
    }

    #[test]
    fn powers_are_upper_bounds() {
        for (x, n) in [(0.3, 0), (0.3, 1), (0.7, 13), (1.5, 64)] {
            let due: Float = Float::with_val(2000, x).pow(n);
            let due = due.to_rational().unwrap();
            let found = power(Mag::from_f64(x), n).to_float().to_rational().unwrap();
            assert!(found >= due && found <= due * Rational::from_f64(1.0 + 1e-13).unwrap());
        }
    }
}
