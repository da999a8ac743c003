//! Every bound of the method against exact values.

use super::coefficient::Coefficient;
use super::enclosed::{Enclosed, exponential_above, orthogonal};
use super::expansion::Expansion;
use super::remainder::Remainders;
use super::set::ErrorSet;
use super::step::{Failure, Place, Setting};
use super::variation::{Flow, Scaled, without_tail};
use super::*;
use crate::draw::Draw;
use crate::elementary as real;
use rug::Rational;

const BITS: u32 = 80;

fn number(q: (i64, i64)) -> Ball {
    Ball::rational(300, &Rational::from(q))
}

/// A number in [−1, 1].
fn unit(draw: &mut Draw) -> f64 {
    draw.below(2001) as f64 / 1000.0 - 1.0
}

type Function = fn(&Ball) -> real::Evaluated;
type Written = fn(&mut Program, Slot) -> Slot;

/// Functions of the time or of a state near 1/4, as programs and in balls.
fn functions() -> Vec<(&'static str, Written, Function)> {
    fn one(p: &mut Program) -> Slot {
        p.constant()
    }
    fn inverse(p: &mut Program, below: Slot) -> Slot {
        let one = one(p);
        p.push(Operation::Div(one, below))
    }
    fn sum_of_squares(p: &mut Program, a: Slot, sign: bool) -> Slot {
        let one = one(p);
        let square = p.push(Operation::Square(a));
        p.push(match sign {
            true => Operation::Add(one, square),
            false => Operation::Sub(one, square),
        })
    }
    vec![
        (
            "square",
            |p, a| p.push(Operation::Square(a)),
            |x| real::sqr(x, 300),
        ),
        (
            "cube",
            |p, a| {
                let square = p.push(Operation::Square(a));
                p.push(Operation::Mul(a, square))
            },
            |x| real::powi(x, 3, 300),
        ),
        (
            "sixth power",
            |p, a| {
                let square = p.push(Operation::Square(a));
                let cube = p.push(Operation::Mul(a, square));
                p.push(Operation::Mul(cube, cube))
            },
            |x| real::powi(x, 6, 300),
        ),
        ("1/a", inverse, |x| real::recip(x, 300)),
        (
            "sqrt",
            |p, a| p.push(Operation::Sqrt(a)),
            |x| real::sqrt(x, 300),
        ),
        (
            "exp",
            |p, a| p.push(Operation::Exp(a)),
            |x| real::exp(x, 300),
        ),
        ("sin", |p, a| p.sine_cosine(a).0, |x| real::sin(x, 300)),
        ("cos", |p, a| p.sine_cosine(a).1, |x| real::cos(x, 300)),
        (
            "a^(-3/2)",
            |p, a| p.push(Operation::Power(a, -3, 2)),
            |x| real::pow(x, &number((-3, 2)), 300),
        ),
        (
            "a^(1/3)",
            |p, a| p.push(Operation::Power(a, 1, 3)),
            |x| real::cbrt(x, 300),
        ),
        (
            "exp(a) sin(a)",
            |p, a| {
                let (exponential, sine) = (p.push(Operation::Exp(a)), p.sine_cosine(a).0);
                p.push(Operation::Mul(exponential, sine))
            },
            |x| real::mul(&real::exp(x, 300)?, &real::sin(x, 300)?, 300),
        ),
        (
            "log",
            |p, a| {
                let slope = inverse(p, a);
                p.push(Operation::Primitive(Primitive::Log, vec![(a, slope)]))
            },
            |x| real::log(x, 300),
        ),
        (
            "atan",
            |p, a| {
                let below = sum_of_squares(p, a, true);
                let slope = inverse(p, below);
                p.push(Operation::Primitive(Primitive::Atan, vec![(a, slope)]))
            },
            |x| real::atan(x, 300),
        ),
        (
            "asin",
            |p, a| {
                let below = sum_of_squares(p, a, false);
                let root = p.push(Operation::Sqrt(below));
                let slope = inverse(p, root);
                p.push(Operation::Primitive(Primitive::Asin, vec![(a, slope)]))
            },
            |x| real::asin(x, 300),
        ),
    ]
}

/// The polynomial of a slot at a distance from the start.
fn polynomial<C: Coefficient>(expansion: &Expansion<'_, C>, slot: Slot, s: &Ball) -> Ball {
    let c = &expansion.coefficients[slot];
    let zero = Ball::integer(300, 0);
    c.iter().rev().fold(zero, |sum, c| &sum * s + c.to_ball())
}

/// Bounds of one function over a step of length 1/16, for a state within `tube` of 1/4 + s, at few
/// orders: what the polynomial leaves out is far above rounding.
fn check<C: Coefficient>(tube: f64, bits: u32) {
    for (name, build, function) in functions() {
        let mut program = Program::new();
        let state = program.push(Operation::State(0));
        let slot = build(&mut program, state);
        let constants = vec![Ball::integer(64, 1); program.constants()];
        let mut expansion = Expansion::<C>::new(&program, bits);
        let (quarter, _) = C::of(&number((1, 4)), bits);
        let (one, _) = C::of(&number((1, 1)), bits);
        let time = Ball::integer(64, 0);
        expansion.begin(&constants, &time, &[quarter]).unwrap();
        for k in 1..=4 {
            let state = if k == 1 { one.clone() } else { C::zero(bits) };
            expansion.advance(&[state], &one);
        }
        let h = Mag::power_of_two(-4);
        let bounds = Remainders::new(&expansion, h, &[Mag::from_f64(tube)]).unwrap();
        let radius = bounds.radius(slot);
        let mut worst = Mag::ZERO;
        for s in [(-1, 16), (-1, 40), (0, 1), (1, 50), (1, 16)] {
            for off in [-tube, 0.0, tube] {
                let x = number((1, 4)) + number(s) + Ball::exact(300, off);
                let due = function(&x).unwrap();
                let found = polynomial(&expansion, slot, &number(s));
                let gap = &due - &found;
                assert!(
                    gap.mignitude() <= radius,
                    "{name} {s:?} {off}: {gap:?} {radius:?}"
                );
                worst = worst.max(gap.magnitude());
                assert!(bounds.range(slot).overlaps(&due), "{name}");
            }
        }
        // No more than some hundred times what is needed.
        let floor = Mag::power_of_two(-i64::from(bits) + 8);
        assert!(
            radius <= worst.shift(8).max(floor),
            "{name}: {radius:?} {worst:?}"
        );
    }
}

#[test]
fn remainders_hold_and_are_near() {
    check::<Float>(0.0, BITS);
    check::<Float>(1e-3, BITS);
    check::<f64>(0.0, 53);
    check::<f64>(1e-3, 53);
}

#[test]
fn an_angle_of_a_point() {
    let mut program = Program::new();
    let [y, x] = [0, 1].map(|i| program.push(Operation::State(i)));
    let squares = [y, x].map(|a| program.push(Operation::Square(a)));
    let sum = program.push(Operation::Add(squares[0], squares[1]));
    let [by_y, to_x] = [x, y].map(|a| program.push(Operation::Div(a, sum)));
    let by_x = program.push(Operation::Neg(to_x));
    let parts = vec![(y, by_y), (x, by_x)];
    let angle = program.push(Operation::Primitive(Primitive::Atan2, parts));
    let at = |y: f64, x: f64, rad: f64| {
        let [y, x] = [y, x].map(|v| Ball::exact(BITS, v).widened(Mag::from_f64(rad)));
        values(
            &program,
            &[],
            &Ball::integer(64, 0),
            &[y, x],
            &[angle],
            BITS,
        )
    };
    let found = at(1.0, -2.0, 0.25).unwrap();
    for (y, x) in [(1.25, -2.25), (0.75, -1.75), (1.25, -1.75)] {
        let due = real::atan2(&Ball::exact(BITS, y), &Ball::exact(BITS, x), BITS).unwrap();
        assert!(found[0].overlaps(&due));
    }
    assert!(at(0.0, -2.0, 0.25).is_err(), "the cut");
    assert!(at(0.0, 2.0, 0.25).is_ok());
}

#[test]
fn exponentials_of_matrices_are_below_their_bounds() {
    let mut draw = Draw(7);
    for n in 1..=4 {
        for size in [0.01, 0.3, 3.0] {
            let a: Vec<f64> = (0..n * n).map(|_| size * unit(&mut draw).abs()).collect();
            let weights: Vec<f64> = (0..n).map(|i| (3.0 * i as f64 - 4.0).exp2()).collect();
            let bound = exponential_above(&a, &weights);
            // The series, in exact numbers.
            let q = |x: f64| Rational::from_f64(x).unwrap();
            let mut term: Vec<Rational> = (0..n * n)
                .map(|k| i32::from(k % n == k / n).into())
                .collect();
            let mut sum = term.clone();
            for k in 1..40u32 {
                let next = (0..n * n).map(|e| {
                    let products =
                        (0..n).map(|l| Rational::from(&term[e / n * n + l] * &q(a[l * n + e % n])));
                    products.fold(Rational::new(), |s, x| s + x) / k
                });
                term = next.map(|x| q(x.to_f64())).collect();
                (0..n * n).for_each(|e| sum[e] += &term[e]);
            }
            for e in 0..n * n {
                let due = sum[e].to_f64();
                assert!(bound[e] >= due * (1.0 - 1e-12), "{} {due}", bound[e]);
                assert!(bound[e] <= due * 1.01 + 1e-2, "{} {due}", bound[e]);
            }
        }
    }
}

#[test]
fn sets_hold_the_images_of_their_errors() {
    let mut draw = Draw(11);
    for n in 1..=5 {
        for case in 0..20 {
            let radii: Vec<Mag> = (0..n)
                .map(|_| Mag::from_f64(unit(&mut draw).abs() + 1e-3))
                .collect();
            let weights: Vec<f64> = (0..n).map(|i| (i as f64 - 2.0).exp2()).collect();
            let mut set = ErrorSet::of_boxes(&[radii], &weights);
            for _ in 0..5 {
                let matrix =
                    |draw: &mut Draw| -> Vec<f64> { (0..n * n).map(|_| unit(draw)).collect() };
                let mut flow = Enclosed::exact(n, matrix(&mut draw));
                flow.rad.fill(if case % 2 == 0 { 0.0 } else { 1e-3 });
                // Errors in one direction only are not to be lost.
                let size = [1.0, 1e-9, 1e3][case % 3];
                let extra: Vec<Mag> = (0..n)
                    .map(|_| Mag::from_f64(size * unit(&mut draw).abs()))
                    .collect();
                let image = set.radii_after(&flow);
                set = set.moved(&flow, std::slice::from_ref(&extra), &weights);
                let least = image[0]
                    .iter()
                    .zip(&extra)
                    .map(|(a, b)| a.to_f64() + b.to_f64());
                for (found, least) in set.radii().iter().zip(least) {
                    assert!(found.to_f64() >= least * (1.0 - 1e-9), "{found:?} {least}");
                }
            }
        }
    }
}

/// The coordinates of the corners of a square, in a basis that is not quite orthogonal; a basis
/// that is far from it is refused.
#[test]
fn coordinates_hold_in_bases_that_are_nearly_orthogonal() {
    let one = Mag::from_f64(1.0);
    let square = ErrorSet::of_boxes(&[vec![one; 2]], &[1.0; 2]);
    let image = Enclosed::exact(2, vec![1.0, 0.0, 0.0, 1.0]);
    let turned = |q: [f64; 4]| {
        let none = [vec![Mag::ZERO; 2]];
        square.in_basis(&image, &none, &[1.0; 2], q.to_vec())
    };
    // x_1 = e_1 − e_2/10, x_2 = e_2.
    let boxes = turned([1.0, 0.1, 0.0, 1.0]).unwrap().boxes;
    let least = [1.1, 1.0].map(Mag::from_f64);
    assert!(
        boxes[0].iter().zip(least).all(|(r, least)| *r >= least),
        "{boxes:?}"
    );
    assert!(turned([1.0, 1.0, 1.0, 1.0]).is_none());
}

/// A rotation does not make a set larger, however often it is applied.
#[test]
fn sets_turn_without_wrapping() {
    let (s, c) = 0.7f64.sin_cos();
    let flow = Enclosed::exact(2, vec![c, -s, s, c]);
    let one = Mag::from_f64(1.0);
    let mut set = ErrorSet::of_boxes(&[vec![one, one]], &[1.0, 1.0]);
    for _ in 0..1000 {
        set = set.moved(&flow, &[vec![Mag::ZERO; 2]], &[1.0, 1.0]);
    }
    assert!(set.radii().iter().all(|r| *r < Mag::from_f64(1.5)));
}

#[test]
fn bases_are_orthogonal() {
    let mut draw = Draw(3);
    for n in 1..=6 {
        for rank in 0..=n {
            let a: Vec<f64> = (0..n * n)
                .map(|k| if k % n < rank { unit(&mut draw) } else { 0.0 })
                .collect();
            let q = orthogonal(n, &a);
            for i in 0..n {
                for j in 0..n {
                    let dot: f64 = (0..n).map(|k| q[k * n + i] * q[k * n + j]).sum();
                    assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-13);
                }
            }
        }
    }
}

#[test]
fn terms_that_are_left_out_are_counted() {
    let (kept, rest) = without_tail(vec![1.0, -1e-3, 1e-18, -2e-18]);
    assert_eq!(kept, [1.0, -1e-3]);
    assert!((3e-18..3.1e-18).contains(&rest), "{rest}");
    assert!(without_tail(vec![1.0, f64::INFINITY]).1.is_infinite());
}

/// The flow of `y′ = A y` at few orders, where truncation is far above rounding.
#[test]
fn flows_hold_the_exponential() {
    let entries = [(1, 2), (-3, 4), (5, 4), (-1, 1)];
    let mut jacobian = Program::new();
    let slots = entries.map(|_| jacobian.constant());
    let places = (0..4).map(|k| (k / 2, k % 2, slots[k])).collect();
    let field = Field::new(Program::new(), vec![0, 0], jacobian, places);
    let constants: Vec<Ball> = entries.iter().map(|q| number(*q)).collect();
    let time = Ball::integer(64, 0);
    for h in [0.5, -0.5, 1.5] {
        for order in [3, 5, 9] {
            let p = vec![vec![Float::with_val(BITS, 1); order + 1]; 2];
            let states = Scaled::new(&p, h, order);
            let tubes = [Mag::power_of_two(-60); 2];
            let weights = [1.0, 1.0];
            let flow = Flow::new(&field, &constants, (&time, h), &states, &tubes, &weights);
            let flow = flow.unwrap();
            for tau in [0.25, 1.0] {
                let a: Vec<f64> = entries
                    .iter()
                    .map(|q| h * tau * q.0 as f64 / q.1 as f64)
                    .collect();
                let (mut term, mut due) = ([1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]);
                for k in 1..40 {
                    let product =
                        |e: usize| term[e / 2 * 2] * a[e % 2] + term[e / 2 * 2 + 1] * a[2 + e % 2];
                    term = [0, 1, 2, 3].map(|e| product(e) / f64::from(k));
                    (0..4).for_each(|e| due[e] += term[e]);
                }
                let found = flow.at(tau, 0.0);
                for e in 0..4 {
                    let gap = (found.mid[e] - due[e]).abs();
                    assert!(
                        gap <= found.rad[e] + 1e-14,
                        "{h} {order} {tau}: {gap} {found:?}"
                    );
                }
            }
        }
    }
}

/// The bound on the growth of errors of `x′ = (6 t − 2) x`, `y′ = x`: x is `e^{3 t² − 2 t}`, `e` at t = 1,
/// and y its integral, 1.07899 by mpmath.
#[test]
fn growth_is_bounded_where_the_jacobian_changes_its_sign() {
    let mut jacobian = Program::new();
    let time = jacobian.push(Operation::Time);
    let [six, two, one] = [(); 3].map(|()| jacobian.constant());
    let rise = jacobian.push(Operation::Mul(six, time));
    let rate = jacobian.push(Operation::Sub(rise, two));
    let places = vec![(0, 0, rate), (1, 0, one)];
    let field = Field::new(Program::new(), vec![0, 0], jacobian, places);
    let constants = [6, 2, 1].map(|k| number((k, 1)));
    let p = vec![vec![Float::with_val(BITS, 1); 10]; 2];
    let states = Scaled::new(&p, 1.0, 9);
    let time = (&Ball::integer(64, 0), 1.0);
    let flow = Flow::new(
        &field,
        &constants,
        time,
        &states,
        &[Mag::ZERO; 2],
        &[1.0; 2],
    );
    let growth = flow.unwrap().growth(&[Mag::power_of_two(0), Mag::ZERO]);
    assert!(growth[0] > Mag::from_f64(2.7), "{growth:?}");
    assert!(growth[1] > Mag::from_f64(1.0789), "{growth:?}");
}

/// `y′ = y²`.
fn quadratic() -> Field {
    let mut rates = Program::new();
    let y = rates.push(Operation::State(0));
    let square = rates.push(Operation::Square(y));
    let mut jacobian = Program::new();
    let y = jacobian.push(Operation::State(0));
    let double = jacobian.push(Operation::Add(y, y));
    Field::new(rates, vec![square], jacobian, vec![(0, 0, double)])
}

const NO_CONSTANTS: Constants = Constants {
    rates: Vec::new(),
    jacobian: Vec::new(),
};

/// All states within a radius of some at time zero.
fn about<const N: usize>(states: [f64; N], radius: f64) -> Place {
    Place {
        time: Rational::from(0),
        mid: states.map(|x| Float::with_val(BITS, x)).into(),
        errors: ErrorSet::of_boxes(&[vec![Mag::from_f64(radius); N]], &[1.0; N]),
        carried: None,
    }
}

/// A start from which some solutions end within the step is refused, and one from which none does
/// is not.
#[test]
fn a_tube_that_is_left_proves_nothing() {
    let field = quadratic();
    let setting = Setting {
        field: &field,
        constants: &NO_CONSTANTS,
        bits: BITS,
        order: 30,
    };
    let place = |radius| about([1.0], radius);
    let (expansion, p) = setting.expand(&place(0.0)).unwrap();
    // Every coefficient is 1.
    assert!(p[0].iter().all(|c| *c == 1));
    let defect = [Mag::from_f64(1e-6)];
    let proved = |radius, h| setting.proved(&place(radius), (&expansion, &p[..]), h, &defect);
    assert!(proved(1e-9, 0.125).is_ok());
    // 1/(1/1.9 − t) has its pole at 0.526.
    assert_eq!(proved(0.9, 0.6).err(), Some(Failure::Wide));
    // The whole set may reach 1/(1/(1 + r) − t) at the end, and does so within the bounds.
    let step = proved(1e-3, 0.25).unwrap();
    let end = &step.at(&Rational::from((1, 4)))[0];
    for start in [1001, 999] {
        let exact = Rational::from((4 * start, 4000 - start));
        assert!(end.contains(&exact), "{end:?}");
    }
}

/// `y′ = atan2(y, x)` with `x′ = x²` has a smooth Jacobian across the cut, but no smooth rates.
#[test]
fn rates_that_jump_in_the_tube_prove_nothing() {
    let mut rates = Program::new();
    let [y, x] = [0, 1].map(|i| rates.push(Operation::State(i)));
    let slopes = |program: &mut Program, [y, x]: [Slot; 2]| {
        let squares = [y, x].map(|a| program.push(Operation::Square(a)));
        let sum = program.push(Operation::Add(squares[0], squares[1]));
        let [by_y, to_x] = [x, y].map(|a| program.push(Operation::Div(a, sum)));
        [by_y, program.push(Operation::Neg(to_x))]
    };
    let [by_y, by_x] = slopes(&mut rates, [y, x]);
    let parts = vec![(y, by_y), (x, by_x)];
    let angle = rates.push(Operation::Primitive(Primitive::Atan2, parts));
    let square = rates.push(Operation::Square(x));
    let mut jacobian = Program::new();
    let [y, x] = [0, 1].map(|i| jacobian.push(Operation::State(i)));
    let [by_y, by_x] = slopes(&mut jacobian, [y, x]);
    let double = jacobian.push(Operation::Add(x, x));
    let entries = vec![(0, 0, by_y), (0, 1, by_x), (1, 1, double)];
    let field = Field::new(rates, vec![angle, square], jacobian, entries);
    let setting = Setting {
        field: &field,
        constants: &NO_CONSTANTS,
        bits: BITS,
        order: 20,
    };
    let place = |radius| about([0.01, -2.0], radius);
    let (expansion, p) = setting.expand(&place(0.0)).unwrap();
    let defect = [Mag::from_f64(1e-9); 2];
    let proved = |radius| {
        let of = (&expansion, &p[..]);
        setting.proved(&place(radius), of, 1.0 / 1024.0, &defect)
    };
    assert!(proved(1e-6).is_ok());
    assert_eq!(proved(1e-3).err(), Some(Failure::Wide));
}

/// `1/(1 − t)` at many times, before and after the start.
#[test]
fn a_rational_solution() {
    let field = quadratic();
    let constants = Constants {
        rates: Vec::new(),
        jacobian: Vec::new(),
    };
    for bits in [64, 100, 200] {
        let mut solution = Solution::new(Rational::from(0), &[Ball::integer(bits, 1)], bits);
        let mut steps = 1000;
        for t in [(1, 3), (9, 10), (-7, 2), (1, 1000), (-1, 50), (99, 100)] {
            let t = Rational::from(t);
            let at = solution.at(&field, &constants, &t, &mut steps).unwrap();
            let exact: Rational = 1 / (1 - t.clone());
            assert!(at[0].contains(&exact), "{t}: {:?}", at[0]);
            assert!(at[0].accuracy_bits() > i64::from(bits) - 40, "{t} {bits}");
        }
        let beyond = solution.at(&field, &constants, &Rational::from(2), &mut steps);
        let Err(Stopped::Unbounded { reached, near }) = beyond else {
            panic!("{beyond:?}");
        };
        assert!(reached < 1 && reached > 0.999 && (near - 1.0).abs() < 1e-6);
    }
}

/// `∂y/∂y_0 = 1/(1 − t)²`, times a matrix that is known to one part in 64.
#[test]
fn a_matrix_is_carried_along() {
    let field = quadratic();
    let constants = Constants {
        rates: Vec::new(),
        jacobian: Vec::new(),
    };
    let start = [Ball::integer(BITS, 1)];
    let matrix = [Ball::integer(64, 1).widened(Mag::power_of_two(-6))];
    let mut solution = Solution::new(Rational::from(0), &start, BITS).carrying(&matrix);
    let mut steps = 1000;
    for t in [(1, 1000), (-7, 2), (9, 10), (1, 3), (0, 1)] {
        let t = Rational::from(t);
        let found = solution
            .carried(&field, &constants, &t, &mut steps)
            .unwrap();
        let exact: Rational = 1 / Rational::from(1 - &t).square();
        for share in [63, 65] {
            let end = Rational::from(&exact * share) / 64;
            assert!(found[0].contains(&end), "{t}: {found:?}");
        }
        let width = Mag::from_f64(exact.to_f64() / 64.0 * 1.0001);
        assert!(found[0].rad() <= width, "{t}: {found:?}");
    }
}
