//! Condition numbers of the response.
//!
//! With a chirp (κ ≠ 0) and off critical damping by the derivatives of `E(λ; ν, κ, t)`,
//!
//! ```text
//! ∂E/∂ν = iE′,   ∂E/∂κ = itE′ − iE″/2,   ∂E/∂t = G + iκE′
//! ```
//!
//! and of the roots `λ = −n ± s`, `s² = n² − w²`: four values of w are enough. Otherwise, and where
//! that is not sharp enough, by differences.

use super::closed_form::{Exponent, Roots, mirrored, parts, roots};
use super::parts::Parts;
use super::problem::Problem;
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};

/// Working precisions of the derivatives.
const BITS_OF_DERIVATIVES: [u32; 2] = [160, 320];
/// Bits that the sums of the derivatives have to be accurate to.
const SHARP: i64 = 44;
/// Working precisions of the differences.
const BITS: [u32; 4] = [160, 320, 960, 2560];
/// The accuracy that the values need, in bits relative to the largest part.
const ACCURACY: i64 = 70;
/// Relative step of its differences, a power of two.
const STEP: u32 = 40;

/// For each of `y, y′, y″, Re A, Im A` what `|x|` lacks of `|f| + Σ_j |x_j ∂f/∂x_j|`, the sum over
/// all nine inputs.
///
/// For the motion `f` is the complex response from rest, `ψ, ψ′, ψ″`, and the free vibration from
/// the initial state beside it: nothing is small where the real motion passes through zero. Re A
/// and Im A stand for themselves: in the first moments one is of a higher order in t than the
/// other. k enters through `kε` and `kΩ₀` alone. `None` where no precision suffices.
pub fn conditions(problem: &Problem) -> Option<[f64; 5]> {
    let mut precisions = BITS_OF_DERIVATIVES.into_iter();
    precisions
        .find_map(|bits| by_derivatives(problem, bits))
        .or_else(|| BITS.into_iter().find_map(|bits| at(problem, bits)))
}

/// The effect of a change of one input, multiplied by it, at a time: on `E[λ₊, λ₋]`, `(λE)[λ₊,
/// λ₋]`, θ, w² and n.
struct Change {
    amplitude: ComplexBall,
    rate: ComplexBall,
    theta: Ball,
    square: Ball,
    n: Ball,
}

/// By derivatives; `None` without a chirp, at critical damping and where they are not sharp enough.
fn by_derivatives(problem: &Problem, bits: u32) -> Option<[f64; 5]> {
    // Another sign of k conjugates everything.
    let (p, _) = mirrored(problem);
    if p.kappa() == 0 || p.t == 0 {
        return None;
    }
    let real = |q: &Rational| Ball::rational(bits, q);
    let zero = || Ball::integer(bits, 0);
    let i_times = |z: &ComplexBall, x: &Ball| z.turned().scaled(x);
    let Roots { slow, fast, gap } = roots(&p, bits)?;
    let exponent = Exponent::new(&p, bits);
    let (nu, kappa, t, w, n) = (
        real(&p.nu()),
        real(&p.kappa()),
        real(&p.t),
        real(&p.w),
        real(&p.n),
    );
    let lambda = [slow, fast];
    let [up, down] = [&lambda[0], &lambda[1]].map(|l| exponent.derivatives(l, &kappa));
    let e = [up?, down?];
    // Divided differences of a function of the root and of λ times it.
    let one = ComplexBall::new(Ball::integer(bits, 1), zero());
    let per_gap = one.div(&gap);
    let divided = |f: &dyn Fn(usize) -> ComplexBall| {
        let f = [f(0), f(1)];
        let turned = [0, 1].map(|j| &lambda[j] * &f[j]);
        [f, turned].map(|f| &(&f[0] - &f[1]) * &per_gap)
    };
    let [amplitude, rate] = divided(&|j| e[j][1].clone());
    let fixed_roots = |f: &dyn Fn(usize) -> ComplexBall, theta: Ball| {
        let [amplitude, rate] = divided(f);
        Change {
            amplitude,
            rate,
            theta,
            square: zero(),
            n: zero(),
        }
    };
    // The roots move by `both` together and by ±`apart`.
    let moved_roots = |both: &ComplexBall, apart: &ComplexBall, square: Ball, n: Ball| {
        let by = [both + apart, both - apart];
        let wider = &apart.scaled(&Ball::integer(bits, 2)) * &per_gap;
        let f = [0, 1].map(|j| &e[j][2] * &by[j]);
        let turned = [0, 1].map(|j| &(&lambda[j] * &f[j]) + &(&e[j][1] * &by[j]));
        let [amplitude, rate] = [(f, &amplitude), (turned, &rate)]
            .map(|(f, base)| &(&(&f[0] - &f[1]) * &per_gap) - &(base * &wider));
        Change {
            amplitude,
            rate,
            theta: zero(),
            square,
            n,
        }
    };
    let still = ComplexBall::zero(bits);
    let per_s = per_gap.scaled(&Ball::integer(bits, 2));
    let square = w.square();
    let by_w = moved_roots(&still, &per_s.scaled(&-&square), square.shift(1), zero());
    let back = ComplexBall::new(-&n, zero());
    let by_n = moved_roots(&back, &per_s.scaled(&n.square()), zero(), n.clone());
    let kt = &kappa * &t;
    let by_t = fixed_roots(
        &|j| (&e[j][0] + &i_times(&e[j][2], &kappa)).scaled(&t),
        (&nu + &kt) * &t,
    );
    let by_nu = fixed_roots(&|j| i_times(&e[j][2], &nu), &nu * &t);
    let by_kappa = fixed_roots(
        &|j| &i_times(&e[j][2], &kt) - &i_times(&e[j][3], &kappa.shift(-1)),
        (&kt * &t).shift(-1),
    );

    let base = Parts::new(&p, bits, &amplitude, &rate);
    let carrier = p.carrier(bits);
    let changed = |c: &Change| -> [ComplexBall; 4] {
        let turned = |z: &ComplexBall| -&i_times(z, &c.theta);
        let a = &c.amplitude.scaled(&square) + &amplitude.scaled(&c.square);
        let psi = &(&a * &carrier) + &turned(&base.forced[0]);
        let r = &c.rate.scaled(&square) + &rate.scaled(&c.square);
        let first = &(&r * &carrier) + &turned(&base.forced[1]);
        let gain = &(&turned(&carrier) - &psi).scaled(&square)
            + &(&carrier - &base.forced[0]).scaled(&c.square);
        let lost = &first.scaled(&n) + &base.forced[1].scaled(&c.n);
        let second = &gain - &lost.scaled(&Ball::integer(bits, 2));
        [psi, first, second, a]
    };
    let [by_w, by_n, by_t, by_nu, by_kappa] =
        [by_w, by_n, by_t, by_nu, by_kappa].map(|c| changed(&c));
    let by_k = [0, 1, 2, 3].map(|i| &by_nu[i] + &by_kappa[i]);
    let delta = real(&p.delta);
    let by_delta = [0, 1, 2].map(|i| base.forced[i].scaled(&delta));

    // The free vibration is cheap: differences, and what the initial state scales.
    let free = |change: &dyn Fn(&mut Problem)| {
        let mut p = p.clone();
        change(&mut p);
        Row::free(super::free::vibration(&p, bits))
    };
    let here = Row::free(base.free.clone());
    let up = |x: &mut Rational| *x *= Rational::from(1) + (Rational::from(1) >> STEP);
    let moved_free = [
        free(&|p| up(&mut p.w)),
        free(&|p| up(&mut p.n)),
        free(&|p| up(&mut p.t)),
    ]
    .map(|row| row.slope(&here));
    let y0 = free(&|p| p.v0 = Rational::new());
    let v0 = free(&|p| p.y0 = Rational::new());

    let own: [ComplexBall; 4] = {
        let [a, b, c] = base.forced.clone();
        [a, b, c, base.amplitude.clone()]
    };
    let mut sums = [Mag::ZERO; 5];
    let mut radii = [Mag::ZERO; 5];
    let changes: [&[ComplexBall]; 8] = [
        &own, &by_w, &by_n, &by_t, &by_nu, &by_kappa, &by_k, &by_delta,
    ];
    for change in changes {
        for (i, z) in change.iter().enumerate() {
            if i < 3 {
                sums[i] = sums[i].add(z.magnitude());
                radii[i] = radii[i].add(z.radius());
            } else {
                for (k, part) in [&z.re, &z.im].into_iter().enumerate() {
                    sums[3 + k] = sums[3 + k].add(part.magnitude());
                    radii[3 + k] = radii[3 + k].add(part.rad());
                }
            }
        }
    }
    for row in moved_free.iter().chain([&here, &y0, &v0]) {
        for (sum, size) in sums.iter_mut().zip(row.magnitudes()) {
            *sum = sum.add(size);
        }
    }
    let sharp = |(sum, radius): (&Mag, &Mag)| sum.is_finite() && *radius <= sum.shift(-SHARP);
    if !sums.iter().zip(&radii).all(sharp) {
        return None;
    }
    let response = base.response();
    let components = response.components();
    Some(std::array::from_fn(|i| {
        (sums[i].to_f64() - components[i].to_f64().abs()).max(0.0)
    }))
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
            size.is_finite() && (z.radius() <= size.shift(-ACCURACY) || size.is_zero())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(values: [f64; 9]) -> Problem {
        Problem::new(&values.map(|x| Rational::from_f64(x).unwrap())).unwrap()
    }

    /// `w, n, ε, Ω₀, k, δ, y₀, v₀, t`
    const PROBLEMS: [[f64; 9]; 8] = [
        [10.0, 0.5, 4.0, 0.0, 2.0, 0.3, 0.0, 0.0, 1.5],
        [10.0, 0.5, 4.0, 0.0, -2.0, 0.3, 0.1, -0.7, 1.5],
        [2.0, 0.0, -1.5, 6.0, 1.0, 0.0, 0.0, 0.2, 7.0],
        [1.5, 4.0, 0.7, -1.0, 3.0, -2.0, 1.0, 0.0, 2.0],
        [3.0, 3.0000001, 0.7, -1.0, 3.0, -2.0, 1.0, 0.0, 2.0],
        [3.0, 0.1, 1e-4, 2.0, 1.0, 1.0, 0.0, 0.0, 5.0],
        [3.0, 0.1, 5.0, 2.0, 1.0, 1.0, 0.5, 0.5, 1e-3],
        [100.0, 2.0, 0.2, 0.0, 7.0, 1.0, 0.5, 0.5, 60.0],
    ];

    #[test]
    fn derivatives_are_limits_of_differences() {
        for values in PROBLEMS {
            let p = problem(values);
            let found = by_derivatives(&p, 320).unwrap();
            let due = at(&p, 960).unwrap();
            for (found, due) in found.iter().zip(due) {
                assert!(
                    (found / due - 1.0).abs() < 1e-8,
                    "{values:?}: {found} {due}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_derivatives_is_left_to_differences() {
        let steady = problem([3.0, 0.1, 0.0, 2.0, 1.0, 1.0, 0.5, 0.5, 1.0]);
        let critical = problem([3.0, 3.0, 1.0, 2.0, 1.0, 1.0, 0.5, 0.5, 1.0]);
        // A chirp so slow that the recurrences lose everything.
        let slow = problem([3.0, 0.1, 1e-60, 2.0, 1.0, 1.0, 0.5, 0.5, 1.0]);
        for p in [&steady, &critical, &slow] {
            assert!(by_derivatives(p, 160).is_none());
            assert!(conditions(p).is_some());
        }
    }

    /// Whatever is not sharp is refused: the motion where so great a phase leaves few bits of it,
    /// and Im A alone where it is of a higher order in t than all others.
    #[test]
    fn derivatives_that_are_not_sharp_are_refused() {
        let with = |delta: f64, t: f64| problem([3.0, 0.1, 5.0, 2.0, 1.0, delta, 0.5, 0.5, t]);
        let power = |k: i32| 2f64.powi(k);
        // A phase of 2^130 is known to 2^-30; one of 2^100, to 2^-60.
        assert!(by_derivatives(&with(power(130), 0.7), 160).is_none());
        assert!(by_derivatives(&with(power(100), 0.7), 160).is_some());
        // One of 2^115 just does, and A is as sharp as ever beside an acceleration a thousand times
        // as great.
        let fast = problem([32.0, 0.0, 5.0, 30.0, 1.0, power(115), 0.5, 0.5, 3.3]);
        assert!(by_derivatives(&fast, 160).is_some());
        assert!(by_derivatives(&with(1.0, power(-40)), 160).is_none());
        for t in [power(-40), power(-35), 1.0] {
            let [derivatives, differences] = [
                by_derivatives(&with(1.0, t), 320).unwrap(),
                at(&with(1.0, t), 960).unwrap(),
            ];
            for (found, due) in derivatives.iter().zip(differences) {
                assert!((found / due - 1.0).abs() < 1e-8, "{t}: {found} {due}");
            }
        }
        // No number stands for none: κ = t = 1.
        assert!(
            by_derivatives(&problem([3.0, 0.1, 1.0, 2.0, 1.0, 1.0, 0.5, 0.5, 1.0]), 160).is_some()
        );
    }

    /// Too few bits for differences: for none of the values, for the motion alone, and where
    /// nothing is known.
    #[test]
    fn differences_of_undecided_values_are_refused() {
        let p = problem([3.0, 0.1, 5.0, 2.0, 1.0, 1.0, 0.5, 0.5, 0.7]);
        assert!(at(&p, 64).is_none() && at(&p, 160).is_some());
        let turned = Problem {
            delta: Rational::from(1) << 130u32,
            ..p
        };
        assert!(at(&turned, 160).is_none() && at(&turned, 320).is_some());
        // So near to undamped resonance that 160 bits do not tell λ + iν from zero.
        let resonant = problem([1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 4.0]);
        let near = Problem {
            omega0: Rational::from(1) + (Rational::from(1) >> 400u32),
            ..resonant.clone()
        };
        assert!(at(&near, 160).is_none());
        let (near, resonant) = (conditions(&near).unwrap(), conditions(&resonant).unwrap());
        for (near, resonant) in near.iter().zip(resonant) {
            assert!((near / resonant - 1.0).abs() < 1e-8, "{near} {resonant}");
        }
    }

    /// At `t = 0` the motion is `y₀, v₀, w² cos δ − w² y₀ − 2n v₀`: every summand by hand.
    #[test]
    fn conditions_of_the_initial_state() {
        for [w, n, delta, y0, v0] in [
            [3.0, 0.125, 1.0, 0.5, 0.5],
            [3.0, 0.125, -2.0, 0.5, -0.25],
            [2.0, 5.0, 0.0, 0.0, 3.0],
        ] {
            let p = problem([w, n, 5.0, 2.0, 1.0, delta, y0, v0, 0.0]);
            let found = conditions(&p).unwrap();
            let (spring, damper) = (w * w * y0, 2.0 * n * v0);
            // The force itself and through w and δ; of the free vibration itself, w, n, y₀ and v₀.
            let force = w * w * (3.0 + delta.abs());
            let free = (spring + damper).abs() + 3.0 * spring.abs() + 2.0 * damper.abs();
            let second = force + free - (w * w * delta.cos() - spring - damper).abs();
            for (found, due) in found.iter().zip([y0.abs(), v0.abs(), second, 0.0, 0.0]) {
                assert!((found - due).abs() <= 1e-9 * due, "{found} {due}");
            }
        }
    }
}
