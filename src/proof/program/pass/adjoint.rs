//! Derivatives of a solver's number by the errors in it, where those of a pair cancel.

use super::super::tape::{Op, Place, Tape};
use super::Pass;
use crate::exact::Exact;
use crate::grid::{exponent, power_of_two};
use crate::interval::Interval;

/// The most terms of a [`Combination`].
const MOST: usize = 4;

/// A derivative as a sum of a few others, each a whole number of times, and a rest.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Combination {
    terms: [(Place, f64); MOST],
    count: usize,
    rest: Exact,
}

impl Combination {
    fn of(place: Place) -> Combination {
        let mut one = Combination::default();
        one.terms[0] = (place, 1.0);
        one.count = 1;
        one
    }

    fn terms(&self) -> &[(Place, f64)] {
        &self.terms[..self.count]
    }

    /// Adds a whole number of times another one.
    fn add(&mut self, other: &Combination, factor: f64, adjoint: &[Exact]) {
        self.rest = self.rest + other.rest * Exact::point(factor);
        for (place, times) in other.terms() {
            let times = times * factor;
            let known = self.terms().iter().position(|t| t.0 == *place);
            match known.unwrap_or(self.count) {
                MOST => self.rest = self.rest + adjoint[*place] * Exact::point(times),
                at => {
                    self.terms[at] = (*place, self.terms[at].1 + times);
                    self.count = self.count.max(at + 1);
                }
            }
        }
    }

    fn sum(&self, adjoint: &[Exact]) -> Exact {
        let terms = self.terms().iter().filter(|t| t.1 != 0.0);
        terms.fold(self.rest, |sum, (place, times)| {
            sum + adjoint[*place] * Exact::point(*times)
        })
    }
}

impl Pass {
    /// Computes `∂f/∂δ_i` of a solver's number, in units of [`Self::unit_of_adjoints`].
    pub fn look_back(&mut self, tape: &Tape, root: Place) {
        let unit = Exact::point(self.unit_of_adjoints(root));
        let Some(s) = &mut self.solver else { return };
        s.adjoint.clear();
        s.adjoint.resize(root + 1, Exact::ZERO);
        for all in [&mut s.adjoint_of, &mut s.taken_of] {
            all.clear();
            all.resize(root + 1, Combination::default());
        }
        (s.adjoint[root], s.adjoint_of[root].rest) = (unit, unit);
        for i in (0..=root).rev() {
            let op = tape.ops[i];
            // A sum of others, or else one of its own.
            let passed = match s.adjoint_of[i] {
                of if of.count > 0 && of.rest.is_zero() => {
                    s.adjoint[i] = of.sum(&s.adjoint);
                    of
                }
                _ => Combination::of(i),
            };
            if let Op::Lost(a) = op {
                s.taken_of[a] = passed;
            }
            let above = s.adjoint[i];
            if above.is_zero() {
                continue;
            }
            let (operands, count) = op.operands();
            for (k, a) in operands.into_iter().enumerate().take(count) {
                if !self.noisy[a] {
                    continue;
                }
                let partial = self.partial[i][k];
                let on_path = |a: Place| s.exact[a].widened(self.error[a]);
                // Far out derivatives of quotients underflow, but not these products.
                let product = match (op, k) {
                    (Op::Mul(a, b) | Op::Fma(a, b, _), 0) if a == b => {
                        above * (on_path(a) + on_path(a))
                    }
                    (Op::Mul(a, b) | Op::Fma(a, b, _), 1) if a == b => Exact::ZERO,
                    (Op::Mul(_, b) | Op::Fma(_, b, _), 0) => above * on_path(b),
                    (Op::Mul(a, _) | Op::Fma(a, ..), 1) => above * on_path(a),
                    (Op::Div(_, b), 0) => above.over(on_path(b)),
                    (Op::Div(_, b), 1) => -(above * on_path(i)).over(on_path(b)),
                    (Op::Plain(_), _) => above * s.sigma,
                    _ => above * Exact::within(partial),
                };
                s.adjoint[a] = s.adjoint[a] + product;
                match partial.is_point() && partial.lo.abs() == 1.0 {
                    true => s.adjoint_of[a].add(&passed, partial.lo, &s.adjoint),
                    false => s.adjoint_of[a].rest = s.adjoint_of[a].rest + product,
                }
            }
        }
    }

    /// Returns the number that stands for one in derivatives of a number: where it is tiny and
    /// others are large, far out, they would underflow.
    pub(super) fn unit_of_adjoints(&self, root: Place) -> f64 {
        let size = self.value[root].magnitude();
        let known = self.solver.is_some() && size.is_normal();
        power_of_two(if known { -exponent(size) } else { 0 }.clamp(-500, 900))
    }

    /// `∂f/∂δ_i`, less by what is taken back of the error: of a pair of which both parts go into
    /// one sum nothing is left.
    pub(super) fn coefficient(&self, i: Place) -> Interval {
        let Some(s) = &self.solver else {
            return self.adjoint[i];
        };
        let taken = &s.taken_of[i];
        if taken.count == 0 {
            return s.adjoint[i].range;
        }
        let mut left = s.adjoint_of[i];
        left.add(taken, -1.0, &s.adjoint);
        left.sum(&s.adjoint).range
    }
}
