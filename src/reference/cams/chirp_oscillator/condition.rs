//! How much the response depends on its inputs.

use super::closed_form::parts;
use super::problem::{Parts, Problem};
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};

/// Working precisions of the estimate.
const BITS: [u32; 4] = [160, 320, 960, 2560];
/// What the values have to be accurate to, relative to the largest part.
const ACCURACY: i64 = 70;
/// Relative step of its differences, a power of two.
const STEP: u32 = 40;

/// For each of `y, y′, y″, Re A, Im A` what `|x|` lacks of `|f| + Σ_j |x_j ∂f/∂x_j|`, the sum over all
/// nine inputs.
///
/// For the motion `f` is the complex response from rest, `ψ, ψ′, ψ″`, and the free vibration from the
/// initial state beside it: nothing is small where the real motion passes through zero. Re A and Im A
/// stand for themselves: in the first moments one is of a higher order in t than the other. An estimate by
/// one-sided differences in `w, n, ε, Ω₀, t` (k enters through `kε` and `kΩ₀` alone); exact for the
/// others. `None` where the precision of the estimate does not suffice.
pub fn conditions(problem: &Problem) -> Option<[f64; 5]> {
    BITS.into_iter().find_map(|bits| at(problem, bits))
}

fn at(problem: &Problem, bits: u32) -> Option<[f64; 5]> {
    let base = Row::new(&parts(problem, bits))?;
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
        Some(Row::new(&parts(&p, bits))?.slope(&base))
    };
    let inputs: [Input; 3] = [|p| &mut p.w, |p| &mut p.n, |p| &mut p.t];
    for input in inputs {
        add(&moved(input)?);
    }
    let (eps, omega0) = (moved(|p| &mut p.eps)?, moved(|p| &mut p.omega0)?);
    add(&eps);
    add(&omega0);
    add(&eps.plus(&omega0));
    // δ turns ψ and leaves A alone; y₀ and v₀ scale what they start.
    let delta = Float::with_val(64, &problem.delta).abs();
    add(&base.turned(&delta));
    let zero = Rational::new;
    let only = |y0: Rational, v0: Rational| {
        let problem = Problem {
            y0,
            v0,
            ..problem.clone()
        };
        Row::free(super::free::vibration(&problem, bits))
    };
    add(&only(problem.y0.clone(), zero()));
    add(&only(zero(), problem.v0.clone()));
    let components = base.components();
    if sums.iter().any(|sum| !sum.is_finite()) {
        return None;
    }
    Some(std::array::from_fn(|i| {
        let sum = sums[i].to_f64();
        (sum - components[i].to_f64().abs()).max(0.0)
    }))
}

/// Midpoints: real and imaginary parts of `ψ, ψ′, ψ″, A`, then the free vibration.
struct Row([Float; 11]);

impl Row {
    /// `None` unless the differences are worth something.
    fn new(parts: &Parts) -> Option<Row> {
        let decided = |z: &ComplexBall| {
            let size = z.magnitude();
            z.radius() <= size.shift(-ACCURACY) || size.is_zero()
        };
        let complex = || parts.forced.iter().chain([&parts.amplitude]);
        if !complex().all(decided) {
            return None;
        }
        let mut balls = complex().flat_map(|z| [&z.re, &z.im]).chain(&parts.free);
        Some(Row(std::array::from_fn(|_| {
            balls.next().expect("eleven").mid().clone()
        })))
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
            let x = if i < 6 {
                self.0[i].clone()
            } else {
                Float::new(64)
            };
            x * delta
        }))
    }

    /// `y, y′, y″, Re A, Im A`
    fn components(&self) -> [Float; 5] {
        let r = &self.0;
        let sum = |i: usize| Float::with_val(64, &r[2 * i] + &r[8 + i]);
        [sum(0), sum(1), sum(2), r[6].clone(), r[7].clone()]
    }

    /// Sizes of `ψ, ψ′, ψ″` with the free vibration, of Re A and of Im A.
    fn magnitudes(&self) -> [Mag; 5] {
        let size = |i: usize| {
            Mag::above(&Float::with_val(
                64,
                self.0[2 * i].hypot_ref(&self.0[2 * i + 1]),
            ))
        };
        std::array::from_fn(|i| match i {
            3 | 4 => Mag::above(&self.0[3 + i]),
            _ => size(i).add(Mag::above(&self.0[8 + i])),
        })
    }
}
