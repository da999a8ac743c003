//! How much the response depends on its inputs.

use super::closed_form::parts;
use super::problem::{Parts, Problem};
use crate::reference::{Ball, Mag};
use rug::{Float, Rational};

/// Working precision of the estimate.
const BITS: u32 = 160;
/// Relative step of its differences, a power of two.
const STEP: u32 = 40;

/// For `y, y′, y″` and `A` the sums `|f| + Σ_j |x_j ∂f/∂x_j|` over all nine inputs.
///
/// `f` is the complex response from rest, `ψ, ψ′, ψ″` or `A`, plus the free vibration from the
/// initial state: nothing is small where the real motion passes through zero. An estimate by one-sided
/// differences in `w, n, ε, Ω₀, t` (k enters through `kε` and `kΩ₀` alone); exact for the others.
/// `None` where the precision of the estimate does not suffice.
pub fn conditions(problem: &Problem) -> Option<[f64; 4]> {
    let base = Row::new(&parts(problem, BITS));
    let mut sums = base.magnitudes();
    let mut add = |row: &Row| {
        for (sum, size) in sums.iter_mut().zip(row.magnitudes()) {
            *sum = sum.add(size);
        }
    };
    type Input = fn(&mut Problem) -> &mut Rational;
    let moved = |input: Input| {
        let mut p = problem.clone();
        *input(&mut p) *= Rational::from(1) + (Rational::from(1) >> STEP);
        Row::new(&parts(&p, BITS)).slope(&base)
    };
    let inputs: [Input; 3] = [|p| &mut p.w, |p| &mut p.n, |p| &mut p.t];
    for input in inputs {
        add(&moved(input));
    }
    let (eps, omega0) = (moved(|p| &mut p.eps), moved(|p| &mut p.omega0));
    add(&eps);
    add(&omega0);
    add(&eps.plus(&omega0));
    // δ turns ψ and leaves A alone; y₀ and v₀ scale what they start.
    let delta = Float::with_val(64, &problem.delta).abs();
    add(&base.turned(&delta));
    let zero = Rational::new;
    let only = |y0: Rational, v0: Rational| {
        let problem = Problem { y0, v0, ..problem.clone() };
        Row::free(super::free::vibration(&problem, BITS))
    };
    add(&only(problem.y0.clone(), zero()));
    add(&only(zero(), problem.v0.clone()));
    let found = sums.map(Mag::to_f64);
    found.iter().all(|x| x.is_finite()).then_some(found)
}

/// Midpoints: real and imaginary parts of `ψ, ψ′, ψ″, A`, then the free vibration.
struct Row([Float; 11]);

impl Row {
    fn new(parts: &Parts) -> Row {
        let complex = parts.forced.iter().chain([&parts.amplitude]);
        let balls = complex.flat_map(|z| [&z.re, &z.im]).chain(&parts.free);
        let mut balls = balls.map(|b| match b.is_finite() {
            true => b.mid().clone(),
            false => Float::with_val(64, rug::float::Special::Infinity),
        });
        Row(std::array::from_fn(|_| balls.next().expect("eleven")))
    }

    fn free(motion: [Ball; 3]) -> Row {
        let mut row = Row(std::array::from_fn(|_| Float::new(64)));
        for (to, from) in row.0[8..].iter_mut().zip(motion) {
            *to = from.mid().clone();
        }
        row
    }

    fn slope(&self, base: &Row) -> Row {
        Row(std::array::from_fn(|i| {
            Float::with_val(64, &self.0[i] - &base.0[i]) << STEP
        }))
    }

    fn plus(&self, other: &Row) -> Row {
        Row(std::array::from_fn(|i| {
            Float::with_val(64, &self.0[i] + &other.0[i])
        }))
    }

    /// `δ ∂/∂δ`.
    fn turned(&self, delta: &Float) -> Row {
        Row(std::array::from_fn(|i| {
            let x = if i < 6 { self.0[i].clone() } else { Float::new(64) };
            x * delta
        }))
    }

    fn magnitudes(&self) -> [Mag; 4] {
        let size = |i: usize| Mag::above(&Float::with_val(64, self.0[2 * i].hypot_ref(&self.0[2 * i + 1])));
        std::array::from_fn(|i| match i {
            3 => size(3),
            _ => size(i).add(Mag::above(&self.0[8 + i])),
        })
    }
}
