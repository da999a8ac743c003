//! Taylor coefficients of all values of a program along a path, one order at a time.
//!
//! The recurrences are those of Moore (*Interval Analysis*, 1966, chapter 11) and of Griewank and
//! Walther (*Evaluating Derivatives*, 2nd ed. 2008, table 13.2): with `v = Σ v_k s^k`
//!
//! | v | coefficient |
//! |---|---|
//! | a b | `v_k = Σ_j a_j b_{k−j}` |
//! | a/b | `v_k = (a_k − Σ_{j≥1} b_j v_{k−j})/b_0` |
//! | √a | `v_k = (a_k − Σ_{0<j<k} v_j v_{k−j})/(2 v_0)` |
//! | e^a | `k v_k = Σ_{j≥1} j a_j v_{k−j}` |
//! | a^α | `k a_0 v_k = Σ_{j≥1} (α j − (k − j)) a_j v_{k−j}` |
//! | `v′ = Σ w u′` | `k v_k = Σ Σ_{j≥1} j u_j w_{k−j}` |
//!
//! Coefficients are rounded numbers; what they leave out is the subject of [`super::remainder`].

use super::coefficient::Coefficient;
use super::program::{Operation, Primitive, Program, Slot};
use crate::elementary as real;
use crate::elementary::{Evaluated, NoValue};
use crate::{Ball, Mag};
use rug::Rational;

/// A value of a program without an enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Obstacle {
    /// The place of the operation.
    pub slot: Slot,
    /// Why there is none.
    pub reason: NoValue,
}

/// The coefficients of all values of a program up to an order.
pub(super) struct Expansion<'p, C> {
    pub program: &'p Program,
    pub bits: u32,
    /// The coefficients of each value; those of a polynomial of the time end with its degree.
    pub coefficients: Vec<Vec<C>>,
    /// `k c_k` of the values whose rates are needed.
    pub rates: Vec<Vec<C>>,
    /// Distances of first coefficients from the exact functions of the first coefficients of
    /// operands; of constants and the time from the exact values.
    pub off: Vec<Mag>,
    has_rate: Vec<bool>,
    orders: usize,
}

/// `0..orders` of the indices i with `low ≤ i`, `i < a` and `k − i < b`.
fn terms(a: usize, b: usize, k: usize, low: usize) -> Option<(usize, usize)> {
    let low = low.max((k + 1).saturating_sub(b));
    let high = k.min(a.checked_sub(1)?);
    (low <= high).then_some((low, high))
}

impl<'p, C: Coefficient> Expansion<'p, C> {
    /// Starts an expansion without coefficients.
    pub fn new(program: &'p Program, bits: u32) -> Expansion<'p, C> {
        let n = program.operations().len();
        let mut has_rate = vec![false; n];
        for operation in program.operations() {
            match operation {
                Operation::Exp(a) | Operation::Sine(a) => has_rate[*a] = true,
                Operation::Primitive(_, parts) => {
                    parts.iter().for_each(|p| has_rate[p.0] = true);
                }
                _ => {}
            }
        }
        Expansion {
            program,
            bits,
            coefficients: vec![Vec::new(); n],
            rates: vec![Vec::new(); n],
            off: vec![Mag::ZERO; n],
            has_rate,
            orders: 0,
        }
    }

    /// The highest order of all coefficients.
    pub fn order(&self) -> usize {
        self.orders - 1
    }

    /// Adds the coefficients of order zero at a time and states.
    ///
    /// # Errors
    /// An operation without a value.
    pub fn begin(&mut self, constants: &[Ball], time: &Ball, states: &[C]) -> Result<(), Obstacle> {
        for (slot, operation) in self.program.operations().iter().enumerate() {
            let (first, off) = self
                .first(operation, constants, time, states)
                .map_err(|reason| Obstacle { slot, reason })?;
            self.off[slot] = off;
            self.coefficients[slot].push(first);
            if self.has_rate[slot] {
                self.rates[slot].push(C::zero(self.bits));
            }
        }
        self.orders = 1;
        Ok(())
    }

    fn first(
        &self,
        operation: &Operation,
        constants: &[Ball],
        time: &Ball,
        states: &[C],
    ) -> Result<(C, Mag), NoValue> {
        let p = self.bits;
        let at = |slot: &Slot| &self.coefficients[*slot][0];
        let ball = |slot: &Slot| at(slot).to_ball();
        let exact = |value: C| Ok((value, Mag::ZERO));
        let found = |value: Evaluated| value.map(|value| C::of(&value, p));
        match operation {
            Operation::Constant(k) => Ok(C::of(&constants[*k], p)),
            Operation::Time => Ok(C::of(time, p)),
            Operation::State(i) => exact(states[*i].clone()),
            Operation::Neg(a) => exact(at(a).negative()),
            Operation::Add(a, b) => exact(at(a).plus(at(b))),
            Operation::Sub(a, b) => exact(at(a).minus(at(b))),
            Operation::Mul(a, b) => exact(C::convolution(
                &self.coefficients[*a],
                &self.coefficients[*b],
                0,
                0,
                0,
                p,
            )),
            Operation::Square(a) => {
                let a = &self.coefficients[*a];
                exact(C::convolution(a, a, 0, 0, 0, p))
            }
            Operation::Div(_, b) if at(b).is_zero() => {
                let is_constant = self.program.degree(*b) == 0 && self.off[*b].is_zero();
                Err(match is_constant {
                    true => NoValue::Undefined("division by zero"),
                    false => NoValue::Undecided("the divisor may be zero"),
                })
            }
            Operation::Div(a, b) => exact(at(a).over(at(b))),
            Operation::Sqrt(a) => found(positive(&ball(a)).and_then(|a| real::sqrt(a, p))),
            Operation::Exp(a) => found(real::exp(&ball(a), p)),
            Operation::Sine(a) => found(real::sin(&ball(a), p)),
            Operation::Cosine(a) => found(real::cos(&ball(a), p)),
            Operation::Power(a, n, d) => {
                let exponent = Ball::rational(p, &Rational::from((*n, *d)));
                found(positive(&ball(a)).and_then(|a| real::pow(a, &exponent, p)))
            }
            Operation::Primitive(f, parts) => {
                let [a, b] = [0, 1].map(|k| parts.get(k).map(|part| ball(&part.0)));
                let (a, b) = (a.unwrap_or_else(|| time.clone()), b);
                found(match (f, b) {
                    (Primitive::Log, _) => real::log(&a, p),
                    (Primitive::Atan, _) => real::atan(&a, p),
                    (Primitive::Asin, _) => real::asin(&a, p),
                    (Primitive::Asinh, _) => real::asinh(&a, p),
                    (Primitive::Acosh, _) => real::acosh(&a, p),
                    (Primitive::Atanh, _) => real::atanh(&a, p),
                    (Primitive::Erf, _) => real::erf(&a, p),
                    (Primitive::Erfi, _) => real::erfi(&a, p),
                    (Primitive::Atan2, Some(b)) => real::atan2(&a, &b, p),
                    (Primitive::Atan2, None) => Err(NoValue::Undefined("an angle of a number")),
                })
            }
        }
    }

    /// Adds the coefficients of the next order; `states` are those of the states, and `pace` is the
    /// derivative of the time by the variable of the expansion.
    pub fn advance(&mut self, states: &[C], pace: &C) {
        let (p, k) = (self.bits, self.orders);
        for (slot, operation) in self.program.operations().iter().enumerate() {
            if k > self.program.degree(slot) {
                continue;
            }
            let next = match operation {
                Operation::Constant(_) => continue,
                Operation::Time => pace.clone(),
                Operation::State(i) => states[*i].clone(),
                _ => self.next(slot, operation, k, p),
            };
            if self.has_rate[slot] {
                self.rates[slot].push(next.times(k as i64));
            }
            self.coefficients[slot].push(next);
        }
        self.orders += 1;
    }

    fn product(&self, a: &[C], b: &[C], k: usize, low: usize) -> C {
        match terms(a.len(), b.len(), k, low) {
            Some((low, high)) => C::convolution(a, b, k, low, high, self.bits),
            None => C::zero(self.bits),
        }
    }

    /// `Σ a_j a_{k−j}` over `low ≤ j ≤ k − low`.
    fn square(&self, a: &[C], k: usize, low: usize) -> C {
        let Some((low, _)) = terms(a.len(), a.len(), k, low) else {
            return C::zero(self.bits);
        };
        // The terms of j and k − j are equal.
        let weight = |j: usize| if 2 * j == k { 1 } else { 2 };
        C::weighted(a, a, k, [low, k / 2], weight, self.bits)
    }

    /// Coefficient k of an operation, the others being known.
    fn next(&self, slot: Slot, operation: &Operation, k: usize, p: u32) -> C {
        let c = &self.coefficients;
        let at = |slot: &Slot, k: usize| c[*slot].get(k).cloned();
        let or_zero = |x: Option<C>| x.unwrap_or_else(|| C::zero(p));
        let own = &c[slot];
        match operation {
            Operation::Constant(_) | Operation::Time | Operation::State(_) => C::zero(p),
            Operation::Neg(a) => or_zero(at(a, k).map(|a| a.negative())),
            Operation::Add(a, b) => match (at(a, k), at(b, k)) {
                (Some(a), Some(b)) => a.plus(&b),
                (a, b) => or_zero(a.or(b)),
            },
            Operation::Sub(a, b) => match (at(a, k), at(b, k)) {
                (Some(a), Some(b)) => a.minus(&b),
                (a, b) => or_zero(a.or(b.map(|b| b.negative()))),
            },
            Operation::Mul(a, b) => self.product(&c[*a], &c[*b], k, 0),
            Operation::Square(a) => self.square(&c[*a], k, 0),
            Operation::Div(a, b) => {
                let sum = self.product(&c[*b], own, k, 1);
                let above = match at(a, k) {
                    Some(a) => a.minus(&sum),
                    None => sum.negative(),
                };
                above.over(&c[*b][0])
            }
            Operation::Sqrt(a) => {
                let sum = self.square(own, k, 1);
                let above = match at(a, k) {
                    Some(a) => a.minus(&sum),
                    None => sum.negative(),
                };
                above.over(&own[0].doubled())
            }
            Operation::Exp(a) => self.product(&self.rates[*a], own, k, 1).divided(k as i64),
            Operation::Sine(a) => {
                let cosine = &c[slot + 1];
                self.product(&self.rates[*a], cosine, k, 1)
                    .divided(k as i64)
            }
            Operation::Cosine(a) => {
                let sum = self.product(&self.rates[*a], &c[slot - 1][..k], k, 1);
                sum.negative().divided(k as i64)
            }
            Operation::Power(a, n, d) => {
                let (n, d) = (i64::from(*n), i64::from(*d));
                let a = &c[*a];
                let Some((low, high)) = terms(a.len(), own.len(), k, 1) else {
                    return C::zero(p);
                };
                let weight = |j: usize| n * j as i64 - d * (k - j) as i64;
                let sum = C::weighted(a, own, k, [low, high], weight, p);
                sum.divided(d * k as i64).over(&a[0])
            }
            Operation::Primitive(_, parts) => {
                let mut sum = C::zero(p);
                for (u, w) in parts {
                    sum = sum.plus(&self.product(&self.rates[*u], &c[*w], k, 1));
                }
                sum.divided(k as i64)
            }
        }
    }
}

/// A positive number.
fn positive(a: &Ball) -> Result<&Ball, NoValue> {
    match () {
        () if a.is_positive() => Ok(a),
        () if a.is_negative() => Err(NoValue::Undefined("a root of a negative number")),
        () => Err(NoValue::Undecided("a root of what may be zero")),
    }
}
