//! Taylor models: a polynomial with floating-point coefficients and one bound for all that it
//! leaves out.
//!
//! A [`TaylorModel`] stands for every function f on a set X inside the closed complex unit disc
//! with `|f(x) − Σ c_k x^k| ≤ rad` for all x in X. X is the whole disc or a part of it (a real
//! segment); the operations do not care, because they only use `|x| ≤ 1`:
//!
//! * `|Σ c_k x^k| ≤ ‖c‖ = Σ |c_k|`;
//! * a product leaves out the powers above the order, at most `Σ_{i+j>N} |a_i||b_j|`, and
//!   `‖a‖ rad_b + ‖b‖ rad_a + rad_a rad_b`;
//! * each coefficient is a sum of at most n products, each product and each sum but the first
//!   rounded, so that all coefficients together are wrong by at most `γ_n ‖a‖ ‖b‖`,
//!   `γ_n = nu/(1 − nu)`, `u = 2^−p` (Higham, *Accuracy and Stability of Numerical Algorithms*,
//!   2nd ed. 2002, §3.1).
//!
//! Makino, Berz, *Int. J. Pure Appl. Math.* 4 (2003) 379–456, describe the arithmetic.

use super::ball::Ball;
use super::dot;
use super::mag::Mag;
use rug::Float;

/// A polynomial in one variable, `|x| ≤ 1`, and a bound on the distance to the function.
#[derive(Clone, Debug)]
pub(crate) struct TaylorModel {
    c: Vec<Float>,
    rad: Mag,
}

/// An upper bound on `n u / (1 − n u)` at `bits` bits, for `n u < 1/2`.
fn gamma(n: usize, bits: u32) -> Mag {
    debug_assert!(bits >= 40 && n < 1 << 30);
    Mag::from_f64(n as f64 * 1.0001).shift(-i64::from(bits))
}

/// `Σ |c_k|`, rounded up.
fn norm(c: &[Float]) -> Mag {
    c.iter().fold(Mag::ZERO, |s, x| s.add(Mag::above(x)))
}

/// Coefficient k of the product of two series, from terms `from..=to` of the first.
pub(crate) fn convolution(
    a: &[Float],
    b: &[Float],
    k: usize,
    from: usize,
    to: usize,
    bits: u32,
) -> Float {
    if a.is_empty() || b.is_empty() {
        return Float::new(bits);
    }
    let low = from.max((k + 1).saturating_sub(b.len()));
    let high = to.min(k).min(a.len() - 1);
    dot::convolution([a, b], k, [low, high], |_| 1, bits)
}

impl TaylorModel {
    /// From coefficients taken as exact.
    pub(crate) fn polynomial(c: Vec<Float>) -> TaylorModel {
        TaylorModel { c, rad: Mag::ZERO }
    }

    /// From coefficients each rounded once, by at most u times its rounded value (1 + u), and the
    /// bound on the rest.
    fn rounded(c: Vec<Float>, bits: u32, rad: Mag) -> TaylorModel {
        let rad = rad.add(gamma(1, bits).mul(norm(&c).shift(1)));
        TaylorModel { c, rad }
    }

    /// From balls.
    pub(crate) fn from_balls(c: &[Ball]) -> TaylorModel {
        TaylorModel {
            rad: c.iter().fold(Mag::ZERO, |s, b| s.add(b.rad())),
            c: c.iter().map(|b| b.mid().clone()).collect(),
        }
    }

    /// A number.
    pub(crate) fn constant(c: &Ball) -> TaylorModel {
        TaylorModel::from_balls(std::slice::from_ref(c))
    }

    /// The coefficients.
    pub(crate) fn coefficients(&self) -> &[Float] {
        &self.c
    }

    /// The bound on what the polynomial leaves out.
    pub(crate) fn rad(&self) -> Mag {
        self.rad
    }

    /// Working precision in bits.
    pub(crate) fn bits(&self) -> u32 {
        self.c.first().map_or(64, Float::prec)
    }

    /// With the bound enlarged.
    pub(crate) fn widened(mut self, extra: Mag) -> TaylorModel {
        self.rad = self.rad.add(extra);
        self
    }

    /// An upper bound on |f|.
    pub(crate) fn norm(&self) -> Mag {
        norm(&self.c).add(self.rad)
    }

    /// A 64-bit ball that holds every value.
    pub(crate) fn range(&self) -> Ball {
        let Some(first) = self.c.first() else {
            return Ball::integer(64, 0).widened(self.rad);
        };
        let rest = norm(&self.c[1..]).add(self.rad);
        Ball::new(first.clone(), rest).with_prec(64)
    }

    /// At another working precision.
    pub(crate) fn with_prec(&self, bits: u32) -> TaylorModel {
        let c = self.c.iter().map(|x| Float::with_val(bits, x));
        TaylorModel::rounded(c.collect(), bits, self.rad)
    }

    /// The value at a point of X.
    pub(crate) fn eval(&self, x: &Ball) -> Ball {
        let bits = self.bits();
        let mut sum = Ball::integer(bits, 0);
        for c in self.c.iter().rev() {
            sum = &sum * x + Ball::new(c.clone(), Mag::ZERO);
        }
        sum.widened(self.rad)
    }

    fn linear(&self, other: &TaylorModel, f: impl Fn(&Float, &Float) -> Float) -> TaylorModel {
        let bits = self.bits().max(other.bits());
        let zero = Float::new(bits);
        let n = self.c.len().max(other.c.len());
        let at = |m: &'_ TaylorModel, k: usize| m.c.get(k).cloned().unwrap_or_else(|| zero.clone());
        let c = (0..n).map(|k| f(&at(self, k), &at(other, k)));
        TaylorModel::rounded(c.collect(), bits, self.rad.add(other.rad))
    }

    /// Sum.
    pub(crate) fn plus(&self, other: &TaylorModel) -> TaylorModel {
        let bits = self.bits().max(other.bits());
        self.linear(other, |a, b| Float::with_val(bits, a + b))
    }

    /// Difference.
    pub(crate) fn minus(&self, other: &TaylorModel) -> TaylorModel {
        let bits = self.bits().max(other.bits());
        self.linear(other, |a, b| Float::with_val(bits, a - b))
    }

    /// Sum with a number.
    pub(crate) fn plus_ball(&self, b: &Ball) -> TaylorModel {
        self.plus(&TaylorModel::constant(&b.with_prec(self.bits())))
    }

    /// Product with a number.
    pub(crate) fn scaled(&self, k: &Ball) -> TaylorModel {
        let bits = self.bits();
        let k = k.with_prec(bits);
        let c = self.c.iter().map(|x| Float::with_val(bits, x * k.mid()));
        let rad = self.rad.mul(k.magnitude());
        let rad = rad.add(norm(&self.c).mul(k.rad()));
        TaylorModel::rounded(c.collect(), bits, rad)
    }

    /// Product, powers above `order` moved into the bound.
    pub(crate) fn times(&self, other: &TaylorModel, order: usize) -> TaylorModel {
        let bits = self.bits().max(other.bits());
        let (a, b) = (&self.c, &other.c);
        if a.is_empty() || b.is_empty() {
            let rad = self.norm().mul(other.norm());
            return TaylorModel {
                c: vec![Float::new(bits)],
                rad,
            };
        }
        let top = (a.len() + b.len() - 2).min(order);
        let coefficient = |k: usize| match std::ptr::eq(self, other) {
            true => square_coefficient(a, k, bits),
            false => convolution(a, b, k, 0, k, bits),
        };
        let c = (0..=top).map(coefficient).collect();
        let (na, nb) = (norm(a), norm(b));
        let mut rad = na
            .mul(other.rad)
            .add(nb.mul(self.rad))
            .add(self.rad.mul(other.rad));
        let terms = a.len().min(b.len()).min(top + 1) + 1;
        rad = rad.add(gamma(terms, bits).mul(na).mul(nb));
        rad = rad.add(left_out(a, b, order));
        TaylorModel { c, rad }
    }

    /// Square.
    pub(crate) fn squared(&self, order: usize) -> TaylorModel {
        self.times(self, order)
    }

    /// `f(θ y)` as a model in y, for `|θ| ≤ 1`; coefficients of powers above `order` that are left
    /// over stay (the degree does not grow).
    pub(crate) fn contracted(&self, theta: &Ball) -> TaylorModel {
        let bits = self.bits();
        let mut rad = self.rad;
        let mut power = Ball::integer(bits, 1);
        let mut c = Vec::with_capacity(self.c.len());
        for x in &self.c {
            let y = Float::with_val(bits, x * power.mid());
            // |x|·rad + one rounding.
            rad = rad.add(Mag::above(x).mul(power.rad()));
            rad = rad.add(Mag::above(&y).shift(1 - i64::from(bits)));
            c.push(y);
            power = power * theta;
        }
        TaylorModel { c, rad }
    }

    /// `f(x0 + y)` as a polynomial in y for an exact x0, with the bound that holds where `x0 + y`
    /// is in X and `|y| ≤ reach`.
    ///
    /// Repeated synthetic division. A monomial meets at most `2n` roundings on its way, and with
    /// all signs positive the results add up to at most `Σ |c_k| (|x0| + reach)^k` there, so the
    /// rounding is at most `γ_{2n}` times that. Powers of y are not rescaled here, so the caller
    /// must rescale with [`TaylorModel::contracted`] before taking a norm.
    pub(crate) fn shifted(&self, x0: &Float, reach: Mag) -> TaylorModel {
        let n = self.c.len();
        if x0.is_zero() {
            return self.clone();
        }
        let mut c = self.c.clone();
        for i in 0..n.saturating_sub(1) {
            for j in (i..n - 1).rev() {
                let (low, high) = c.split_at_mut(j + 1);
                low[j] += x0 * &high[0];
            }
        }
        let width = Mag::above(x0).add(reach);
        let majorant = self
            .c
            .iter()
            .rev()
            .fold(Mag::ZERO, |s, x| s.mul(width).add(Mag::above(x)));
        TaylorModel {
            c,
            rad: self.rad.add(gamma(2 * n + 1, self.bits()).mul(majorant)),
        }
    }

    /// A bound on how much the polynomial part changes when its argument moves by at most `by`
    /// inside the unit disc: `by Σ k |c_k|`.
    pub(crate) fn motion(&self, by: Mag) -> Mag {
        let slope = self.c.iter().enumerate().fold(Mag::ZERO, |s, (k, x)| {
            s.add(Mag::above(x).mul(Mag::from_f64(k as f64)))
        });
        slope.mul(by)
    }

    /// `f(u²)` up to the power `order`.
    pub(crate) fn of_square(&self, order: usize) -> TaylorModel {
        let bits = self.bits();
        let kept = self.c.len().min(order / 2 + 1);
        let mut c = vec![Float::new(bits); (2 * kept).saturating_sub(1)];
        for (k, x) in self.c[..kept].iter().enumerate() {
            c[2 * k] = x.clone();
        }
        TaylorModel {
            c,
            rad: self.rad.add(norm(&self.c[kept..])),
        }
    }

    /// `x f(x)`.
    pub(crate) fn times_x(&self) -> TaylorModel {
        let mut c = vec![Float::new(self.bits())];
        c.extend_from_slice(&self.c);
        TaylorModel { c, rad: self.rad }
    }

    /// The polynomial alone.
    pub(crate) fn centre(&self) -> TaylorModel {
        TaylorModel::polynomial(self.c.clone())
    }

    /// The derivative of the polynomial; `tail` bounds the derivative of the rest.
    pub(crate) fn derivative(&self, tail: Mag) -> TaylorModel {
        let bits = self.bits();
        let terms = self.c.iter().enumerate().skip(1);
        let mut c: Vec<Float> = terms
            .map(|(k, x)| Float::with_val(bits, x * k as u32))
            .collect();
        if c.is_empty() {
            c.push(Float::new(bits));
        }
        TaylorModel::rounded(c, bits, tail)
    }

    /// `∫_0^x`.
    pub(crate) fn integral(&self) -> TaylorModel {
        let bits = self.bits();
        let mut c = vec![Float::new(bits)];
        let terms = self.c.iter().zip(1u32..);
        c.extend(terms.map(|(x, k)| Float::with_val(bits, x / k)));
        TaylorModel::rounded(c, bits, self.rad)
    }

    /// `e^{i(φ + h x)}` as (cosine, sine), for `h ≤ 1`.
    ///
    /// The terms above the order N ≥ 1 add up to at most twice the first of them,
    /// `h^{N+1}/(N+1)!`, since each is at most half its predecessor.
    pub(crate) fn cos_sin(phi: &Ball, h: &Ball, order: usize) -> (TaylorModel, TaylorModel) {
        let bits = phi.prec();
        let (s, c) = phi.sin_cos();
        let mut power = Ball::integer(bits, 1);
        let (mut cosine, mut sine) = (Vec::new(), Vec::new());
        for k in 0..=order {
            let (p, q) = match k % 4 {
                0 => (c.clone(), s.clone()),
                1 => (-&s, c.clone()),
                2 => (-&c, -&s),
                _ => (s.clone(), -&c),
            };
            cosine.push(&power * &p);
            sine.push(&power * &q);
            power = &power * h / Ball::integer(bits, k as i64 + 1);
        }
        let tail = if order >= 1 && h.magnitude() <= Mag::from_f64(1.0) {
            power.magnitude().shift(1)
        } else {
            Mag::INFINITY
        };
        let model = |v: &[Ball]| TaylorModel::from_balls(v).widened(tail);
        (model(&cosine), model(&sine))
    }
}

fn square_coefficient(a: &[Float], k: usize, bits: u32) -> Float {
    let low = (k + 1).saturating_sub(a.len());
    let weight = |i: usize| if 2 * i == k { 1 } else { 2 };
    dot::convolution([a, a], k, [low, k / 2], weight, bits)
}

/// `Σ_{i+j>order} |a_i||b_j|`, rounded up.
fn left_out(a: &[Float], b: &[Float], order: usize) -> Mag {
    if a.len() + b.len() < order + 3 {
        return Mag::ZERO;
    }
    // suffix[j] = Σ_{m ≥ j} |b_m|
    let mut suffix = vec![Mag::ZERO; b.len() + 1];
    for j in (0..b.len()).rev() {
        suffix[j] = suffix[j + 1].add(Mag::above(&b[j]));
    }
    let mut sum = Mag::ZERO;
    for (i, x) in a.iter().enumerate() {
        let from = (order + 1).saturating_sub(i);
        if from < b.len() {
            sum = sum.add(Mag::above(x).mul(suffix[from]));
        }
    }
    sum
}

#[cfg(test)]
mod tests;
