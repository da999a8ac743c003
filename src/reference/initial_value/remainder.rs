//! Remainders of the Taylor polynomials of a program's values over a step.
//!
//! # Statement
//! Let `s` be the variable of the expansion, `|s| ≤ h`, and let each state i be any number within
//! `tube_i` of its polynomial at s. Then each value v of the program is within `radius_v` of its
//! polynomial at s. The statement holds for every s and every such choice of the states by itself:
//! nothing is assumed about derivatives of the states.
//!
//! # Bounds
//! With `‖v‖ = Σ |v_k| h^k` and `‖v′‖ = Σ k |v_k| h^k`, `T(a, b) = Σ_{i+j>K} |a_i| |b_j| h^{i+j}`
//! for the powers of a product above the order K, and γ for the rounding of sums of K + 6 products
//! (Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002, §3.1), the radius r_v
//! is
//!
//! | v | radius |
//! |---|---|
//! | a + b | `r_a + r_b + u‖v‖` |
//! | a b | `‖a‖ r_b + ‖b‖ r_a + r_a r_b + T(a, b) + γ‖a‖‖b‖` |
//! | a/b | `(r_a + ‖v‖ r_b + ρ)/min|b|`, `ρ = T(b, v) + γ(‖a‖ + ‖b‖‖v‖)` bounds `a − v b` of the polynomials |
//! | √a | `(r_a + ρ)/(√min a + min v)`, `ρ = T(v, v) + γ(‖a‖ + ‖v‖²)` bounds `a − v²` of the polynomials |
//! | e^a | `max e^a (r_a + max e^{−a} (o + ρ))`, `ρ = T(a′, v) + γ‖a′‖‖v‖` bounds `v′ − a′v`: then `v e^{−a}` is within `max e^{−a} (o + ρ)` of 1 |
//! | sin a, cos a | `r_a + o_s + o_c + ρ_s + ρ_c`, likewise for `(cos + i sin) e^{−ia}` |
//! | a^α | `max a^α (max a^{−α} o + max a^{−α−1} ρ) + |α| max a^{α−1} r_a`, `ρ` bounds `a v′ − α a′ v` |
//! | `v′ = Σ w u′` | `o + Σ (max|w| r_u + ‖u′‖ r_w + T(u′, w) + γ‖u′‖‖w‖)` |
//!
//! where o is the distance of the first coefficient from the function of the operands' first
//! coefficients, and ranges take in the radii. The last line compares v with the function along the
//! polynomials of its arguments, and uses that the bounds on w hold for any arguments within their
//! radii.

use super::coefficient::{Coefficient, gamma};
use super::expansion::{Expansion, Obstacle};
use super::program::{Operation, Primitive, Slot};
use crate::elementary as real;
use crate::elementary::NoValue;
use crate::{Ball, Mag};
use rug::Rational;

/// Magnitudes of the terms of one polynomial over a step.
#[derive(Clone, Debug, Default)]
struct Sizes {
    /// `|c_k| h^k`.
    terms: Vec<Mag>,
    /// `tails[k]` is the sum of the terms from k on.
    tails: Vec<Mag>,
}

impl Sizes {
    fn of(terms: Vec<Mag>) -> Sizes {
        let mut tails = vec![Mag::ZERO; terms.len() + 1];
        for k in (0..terms.len()).rev() {
            tails[k] = tails[k + 1].add(terms[k]);
        }
        Sizes { terms, tails }
    }

    /// The sum of the terms from k on.
    fn from(&self, k: usize) -> Mag {
        self.tails.get(k).copied().unwrap_or(Mag::ZERO)
    }

    fn norm(&self) -> Mag {
        self.from(0)
    }

    /// `Σ_{i+j>K} |a_i| |b_j|`.
    fn beyond(&self, other: &Sizes, order: usize) -> Mag {
        let mut sum = Mag::ZERO;
        for (i, a) in self.terms.iter().enumerate() {
            let rest = other.from((order + 1).saturating_sub(i));
            if !rest.is_zero() {
                sum = sum.add(a.mul(rest));
            }
        }
        sum
    }
}

/// Bounds on what the polynomials of all values leave out.
pub(super) struct Remainders<'e, 'p, C> {
    expansion: &'e Expansion<'p, C>,
    sizes: Vec<Sizes>,
    rates: Vec<Sizes>,
    radii: Vec<Mag>,
}

/// `h^k` for all k up to an order, rounded up.
pub(super) fn powers(h: Mag, order: usize) -> Vec<Mag> {
    let mut power = Mag::power_of_two(0);
    let mut all = Vec::with_capacity(order + 1);
    for _ in 0..=order {
        all.push(power);
        power = power.mul(h);
    }
    all
}

const WIDE: NoValue = NoValue::Undecided("a value without a bound over a step");

impl<'e, 'p, C: Coefficient> Remainders<'e, 'p, C> {
    /// Bounds over `|s| ≤ h` for states within `tubes` of their polynomials.
    ///
    /// # Errors
    /// An operation whose values are not bounded, or not defined, for all these states.
    pub fn new(
        expansion: &'e Expansion<'p, C>,
        h: Mag,
        tubes: &[Mag],
    ) -> Result<Remainders<'e, 'p, C>, Obstacle> {
        let powers = powers(h, expansion.order());
        let sizes = |c: &Vec<C>| {
            let terms = c
                .iter()
                .zip(&powers)
                .map(|(c, power)| c.above().mul(*power));
            Sizes::of(terms.collect())
        };
        let mut all = Remainders {
            sizes: expansion.coefficients.iter().map(sizes).collect(),
            rates: expansion.rates.iter().map(sizes).collect(),
            radii: Vec::with_capacity(expansion.coefficients.len()),
            expansion,
        };
        for (slot, operation) in expansion.program.operations().iter().enumerate() {
            let radius = all
                .radius_of(slot, operation, tubes)
                .and_then(|radius| match radius.is_finite() {
                    true => Ok(radius),
                    false => Err(WIDE),
                })
                .map_err(|reason| Obstacle { slot, reason })?;
            all.radii.push(radius);
        }
        Ok(all)
    }

    /// The bound on what the polynomial leaves out.
    pub fn radius(&self, slot: Slot) -> Mag {
        self.radii[slot]
    }

    /// `Σ |c_k| h^k`.
    pub fn norm(&self, slot: Slot) -> Mag {
        self.sizes[slot].norm()
    }

    /// A ball that holds all values over the step.
    pub fn range(&self, slot: Slot) -> Ball {
        self.around(slot, self.radii[slot])
    }

    fn around(&self, slot: Slot, radius: Mag) -> Ball {
        let first = self.expansion.coefficients[slot][0].to_ball();
        first
            .widened(self.sizes[slot].from(1).add(radius))
            .with_prec(64)
    }

    fn radius_of(&self, slot: Slot, operation: &Operation, tubes: &[Mag]) -> Result<Mag, NoValue> {
        let e = self.expansion;
        let order = e.order();
        let gamma = gamma(order + 6, e.bits);
        let r = |slot: &Slot| self.radii[*slot];
        let n = |slot: &Slot| self.sizes[*slot].norm();
        let off = e.off[slot];
        let own = self.sizes[slot].norm();
        let least = C::least();
        let radius = match operation {
            Operation::Constant(_) | Operation::Time => off,
            Operation::State(i) => tubes[*i],
            Operation::Neg(a) => r(a),
            Operation::Add(a, b) | Operation::Sub(a, b) => {
                let rounding = own.shift(-i64::from(e.bits));
                r(a).add(r(b)).add(rounding)
            }
            Operation::Mul(a, b) => {
                let carried = n(a).add(r(a)).mul(r(b)).add(n(b).mul(r(a)));
                let beyond = self.sizes[*a].beyond(&self.sizes[*b], order);
                let rounding = gamma.mul(n(a)).mul(n(b));
                carried.add(beyond).add(rounding).add(least)
            }
            Operation::Square(a) => {
                let carried = n(a).shift(1).add(r(a)).mul(r(a));
                let beyond = self.sizes[*a].beyond(&self.sizes[*a], order);
                let rounding = gamma.mul(n(a)).mul(n(a));
                carried.add(beyond).add(rounding).add(least)
            }
            Operation::Div(a, b) => {
                let low = self.range(*b).mignitude();
                if low.is_zero() {
                    return Err(NoValue::Undecided("the divisor may be zero"));
                }
                let beyond = self.sizes[*b].beyond(&self.sizes[slot], order);
                let products = n(a).add(n(b).mul(own));
                let defect = beyond.add(gamma.mul(products));
                let lost = least.mul(Mag::power_of_two(0).add(n(b)));
                let carried = r(a).add(own.mul(r(b)));
                carried.add(defect).add(lost).div(low)
            }
            Operation::Sqrt(a) => {
                let low = positive(&self.range(*a))?;
                let root = Ball::new(low.to_float(), Mag::ZERO).sqrt().mignitude();
                let first = e.coefficients[slot][0].to_ball();
                let candidate = match first.is_positive() {
                    true => first.mignitude().sub_below(self.sizes[slot].from(1)),
                    false => Mag::ZERO,
                };
                if candidate.is_zero() {
                    return Err(WIDE);
                }
                let defect = self.sizes[slot].beyond(&self.sizes[slot], order);
                let rounding = gamma.mul(n(a).add(own.mul(own)));
                let lost = least.mul(Mag::power_of_two(0).add(own));
                let above = r(a).add(defect).add(rounding).add(lost);
                above.div(root.add_below(candidate))
            }
            Operation::Exp(a) => {
                let range = self.range(*a);
                let up = real::exp(&range, 64)?.magnitude();
                let down = real::exp(&-range, 64)?.magnitude();
                let defect = off.add(self.slope_defect(*a, slot, gamma)).add(least);
                up.mul(r(a).add(down.mul(defect)))
            }
            Operation::Sine(a) => self.turn(*a, slot, gamma).add(r(a)).add(least),
            Operation::Cosine(a) => self.turn(*a, slot - 1, gamma).add(r(a)).add(least),
            Operation::Power(a, p, q) => {
                let range = self.range(*a);
                positive(&range)?;
                let exponent = Rational::from((*p, *q));
                let power = |exponent: Rational| {
                    let exponent = Ball::rational(64, &exponent);
                    real::pow(&range, &exponent, 64).map(|x| x.magnitude())
                };
                let alpha = Ball::rational(64, &exponent).magnitude();
                let (a, v) = (*a, slot);
                // ρ = a v′ − α a′ v.
                let (a_rates, v_rates) = (self.rates_of(a), self.rates_of(v));
                let first = self.sizes[a].beyond(&v_rates, order);
                let second = a_rates.beyond(&self.sizes[v], order);
                let products = self.sizes[a].norm().mul(v_rates.norm());
                let others = a_rates.norm().mul(own);
                let defect = first.add(products.mul(gamma));
                let defect = defect.add(alpha.mul(second.add(others.mul(gamma))));
                let lost = least.mul(Mag::power_of_two(64).add(self.sizes[a].norm().shift(24)));
                let one = Rational::from(1);
                let inverse = power(-exponent.clone())?.mul(off);
                let inverse = inverse.add(power(-(exponent.clone() + &one))?.mul(defect.add(lost)));
                let along = power(exponent.clone())?.mul(inverse);
                along.add(alpha.mul(power(exponent - one)?).mul(self.radii[a]))
            }
            Operation::Primitive(f, parts) => {
                self.domain(*f, parts)?;
                let mut sum = off.add(least);
                for (u, w) in parts {
                    let slope = n(w).add(r(w));
                    let rates = self.rates[*u].norm();
                    sum = sum.add(slope.mul(r(u))).add(rates.mul(r(w)));
                    sum = sum.add(self.slope_defect(*u, *w, gamma));
                }
                sum
            }
        };
        Ok(radius)
    }

    /// `k |c_k| h^k` of any value.
    fn rates_of(&self, slot: Slot) -> Sizes {
        let terms = self.sizes[slot].terms.iter().enumerate();
        Sizes::of(
            terms
                .map(|(k, term)| term.mul(Mag::from_f64(k as f64)))
                .collect(),
        )
    }

    /// `T(u′, w) + γ‖u′‖‖w‖`.
    fn slope_defect(&self, u: Slot, w: Slot, gamma: Mag) -> Mag {
        let (rates, sizes) = (&self.rates[u], &self.sizes[w]);
        let beyond = rates.beyond(sizes, self.expansion.order());
        beyond.add(gamma.mul(rates.norm()).mul(sizes.norm()))
    }

    /// The distance of the polynomials of a sine and a cosine from the functions of that of the
    /// angle.
    fn turn(&self, a: Slot, sine: Slot, gamma: Mag) -> Mag {
        let [s, c] = [sine, sine + 1].map(|slot| {
            let off = self.expansion.off[slot];
            off.add(self.slope_defect(a, slot, gamma)).add(C::least())
        });
        s.add(c)
    }

    /// Checks that a function is defined all over the ranges of its arguments, as far as its slopes
    /// do not.
    fn domain(&self, f: Primitive, parts: &[(Slot, Slot)]) -> Result<(), NoValue> {
        let ranges = || parts.iter().map(|part| self.range(part.0));
        match f {
            Primitive::Log => {
                let range = self.range(parts[0].0);
                positive(&range).map(|_| ())
            }
            // The branch is cut where x ≤ 0 and y = 0.
            Primitive::Atan2 => {
                let off_cut = match ranges().collect::<Vec<_>>().as_slice() {
                    [y, x] => !y.contains_zero() || x.is_positive(),
                    _ => false,
                };
                match off_cut {
                    true => Ok(()),
                    false => Err(NoValue::Undecided("the angle of a point at its cut")),
                }
            }
            // The first coefficient is in the domain, and the slopes are finite all over a range
            // that holds it.
            _ => Ok(()),
        }
    }
}

/// A positive lower bound.
fn positive(range: &Ball) -> Result<Mag, NoValue> {
    match range.is_positive() {
        true => Ok(range.mignitude()),
        false => Err(NoValue::Undecided(
            "a root or a logarithm of what may be zero",
        )),
    }
}
