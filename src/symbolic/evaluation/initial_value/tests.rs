//! Certified motions against values from elsewhere and against closed forms.

use super::crossing::{cross, enclosed, times};
use super::field::Smooth;
use super::{InitialValueProblem, Limits, MotionError, ProblemError, State, Trajectory};
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator, Goal, Value};
use crate::{Definitions, parse};
use mechaudit_reference::elementary as real;
use mechaudit_reference::{Ball, Mag};
use rug::Rational;

/// A problem without inputs: a text `name = start, rate; …`.
fn problem(text: &str) -> Result<InitialValueProblem, ProblemError> {
    let states: Vec<State> = text
        .split(';')
        .map(|line| {
            let (name, rest) = line.split_once('=').unwrap();
            let (start, rate) = rest.split_once(" -> ").unwrap();
            let [start, rate] = [start, rate].map(|text| parse(text.trim()).unwrap());
            State::new(name.trim(), start, rate)
        })
        .collect();
    let zero = parse("0").unwrap();
    InitialValueProblem::new(&Definitions::default(), &[], "t", &zero, &states)
}

fn trajectory(text: &str) -> Trajectory {
    let problem = problem(text).unwrap();
    problem.trajectory(&[], limited()).unwrap()
}

fn bits(digits: u32) -> Goal {
    Goal::Bits(digits * 10 / 3 + 8)
}

/// The decimals of all states at a time.
fn decimals(motion: &mut Trajectory, time: (i64, i64), digits: u32) -> Vec<String> {
    let found = motion.at(&Rational::from(time), bits(digits));
    let decimal = |ball: &Ball| {
        let text = ball.to_decimal(digits as usize);
        text.unwrap_or_else(|| format!("{ball:?}"))
    };
    match found {
        Ok(balls) => balls.iter().map(decimal).collect(),
        Err(error) => vec![error.to_string()],
    }
}

/// The limits of a test: what does not end soon is wrong.
fn limited() -> Limits {
    Limits {
        bits: 512,
        steps: 20_000,
    }
}

/// Repeatable numbers.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: u64) -> i64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as i64 % n as i64
    }

    fn fraction(&mut self) -> Rational {
        Rational::from((self.below(4001) - 2000, 1000))
    }
}

/// `e^{At} y` by the exponential series in balls: `‖At‖^n/n!` bounds each entry of its terms, and
/// those beyond the last add up to at most twice the first of them, since each is at most half its
/// predecessor.
fn exponential(a: &[Vec<Rational>], y: &[Rational], t: &Rational) -> Vec<Ball> {
    const BITS: u32 = 300;
    let ball = |q: &Rational| Ball::rational(BITS, q);
    let mut term: Vec<Ball> = y.iter().map(ball).collect();
    let mut sum = term.clone();
    let rows = a
        .iter()
        .map(|row| row.iter().fold(Rational::new(), |s, x| s + x.clone().abs()));
    let norm = rows.max().unwrap() * t.clone().abs();
    let mut bound = Ball::rational(BITS, &y.iter().map(|x| x.clone().abs()).max().unwrap());
    let mut k = 0;
    while k < 20
        || k < 4 * norm.to_f64() as u32
        || bound.magnitude() > mechaudit_reference::Mag::power_of_two(-280)
    {
        k += 1;
        let share = Ball::rational(BITS, &Rational::from(t / k));
        let next = a.iter().map(|row| {
            let products = row.iter().zip(&term).map(|(a, y)| ball(a) * y);
            products.fold(Ball::integer(BITS, 0), |s, x| s + x) * &share
        });
        term = next.collect();
        sum.iter_mut().zip(&term).for_each(|(s, x)| *s = &*s + x);
        bound = bound * Ball::rational(BITS, &(norm.clone() / k));
    }
    sum.iter()
        .map(|s| s.widened(bound.magnitude().shift(1)))
        .collect()
}

#[test]
fn linear_systems_with_random_matrices() {
    let mut draw = Draw(1);
    for n in 1..=4 {
        for _ in 0..3 {
            let a: Vec<Vec<Rational>> = (0..n)
                .map(|_| (0..n).map(|_| draw.fraction()).collect())
                .collect();
            let y: Vec<Rational> = (0..n).map(|_| draw.fraction()).collect();
            let line = |i: usize| {
                let terms: Vec<String> = (0..n).map(|j| format!("({})*y{j}", a[i][j])).collect();
                format!("y{i} = {} -> {}", y[i], terms.join(" + "))
            };
            let text: Vec<String> = (0..n).map(line).collect();
            let mut motion = trajectory(&text.join("; "));
            for _ in 0..3 {
                let t = draw.fraction() * 2;
                let found = motion.at(&t, bits(20)).unwrap();
                for (found, due) in found.iter().zip(exponential(&a, &y, &t)) {
                    assert!(found.overlaps(&due), "{text:?} at {t}: {found:?} {due:?}");
                    assert!(found.accuracy_bits() >= 66 || due.contains_zero());
                }
            }
        }
    }
}

/// `y′ = f(y) − f(q(t)) + q′(t)` has the solution q, whose values are rational.
#[test]
fn every_function_of_the_language_with_a_known_solution() {
    let q = "(1/(2 + t))";
    let exact = |t: &Rational| Rational::from(1) / (t.clone() + 2u32);
    for f in [
        "#",
        "#^3",
        "#^-2",
        "1/(1 + #)",
        "sqrt(#)",
        "exp(#)",
        "exp2(#)",
        "exp10(#)",
        "expm1(#)",
        "log(#)",
        "log2(#)",
        "log10(#)",
        "log1p(#)",
        "cbrt(#)",
        "sin(#)",
        "cos(#)",
        "tan(#)",
        "asin(#)",
        "acos(#)",
        "atan(#)",
        "sinh(#)",
        "cosh(#)",
        "tanh(#)",
        "asinh(#)",
        "acosh(1 + #)",
        "atanh(#)",
        "erf(#)",
        "erfc(#)",
        "erfcx(#)",
        "erfi(#)",
        "dawson(#)",
        "pow(#, 3/2)",
        "pow(#, -1/3)",
        "pow(#, pi)",
        "pow(2, #)",
        "pow(1 + t, #)",
        "atan2(#, t - 3)",
        "hypot(#, t)",
        "abs(# - 2)",
        "fmin(#, 3)",
        "fmax(#, 3*#)",
        "fdim(#, 3)",
        "floor(#)*#",
        "if(# < 2, #^2, 0)",
        "if(# > 2 or t > 7, 0, #*t)",
        "fma(#, #, t)",
        "copysign(#, t - 9)",
        "round(#/9)",
        "int(s, 0, 1, exp(s))*#",
        "tgamma(3/2)*#^2",
    ] {
        let [f, at_q] = ["y", q].map(|y| f.replace('#', y));
        let text = format!("y = 1/2 -> {f} - ({at_q}) - 1/(2 + t)^2");
        let mut motion = trajectory(&text);
        for t in [(1, 2), (5, 4), (-1, 3)] {
            let t = Rational::from(t);
            match motion.at(&t, bits(25)) {
                Ok(found) => {
                    assert!(found[0].contains(&exact(&t)), "{f} at {t}: {:?}", found[0]);
                    assert!(found[0].accuracy_bits() >= 87, "{f} at {t}");
                }
                Err(error) => panic!("{f} at {t}: {error}"),
            }
        }
    }
}

/// Polynomial fields in three states around a known polynomial solution.
#[test]
fn random_polynomial_fields_with_a_known_solution() {
    let mut draw = Draw(5);
    for _ in 0..6 {
        let c: Vec<Vec<i64>> = (0..3)
            .map(|_| (0..4).map(|_| draw.below(9) - 4).collect())
            .collect();
        let q = |i: usize| {
            format!(
                "(({})/8 + ({})*t/8 + ({})*t^2/8 + ({})*t^3/16)",
                c[i][0], c[i][1], c[i][2], c[i][3]
            )
        };
        let rate = |i: usize| {
            format!(
                "(({})/8 + ({})*t/4 + 3*({})*t^2/16)",
                c[i][1], c[i][2], c[i][3]
            )
        };
        let exact = |i: usize, t: &Rational| {
            let mut sum = Rational::from((c[i][3], 16));
            for k in (0..3).rev() {
                sum = sum * t + Rational::from((c[i][k], 8));
            }
            sum
        };
        let mut lines = Vec::new();
        for i in 0..3 {
            let (mut f, mut g) = (String::from("0"), String::from("0"));
            for _ in 0..3 {
                let (k, a, b) = (
                    draw.below(7) - 3,
                    draw.below(3) as usize,
                    draw.below(3) as usize,
                );
                let power = 1 + draw.below(2);
                f += &format!(" + ({k})*y{a}^{power}*y{b}");
                g += &format!(" + ({k})*{}^{power}*{}", q(a), q(b));
            }
            lines.push(format!(
                "y{i} = ({})/8 -> {f} - ({g}) + {}",
                c[i][0],
                rate(i)
            ));
        }
        let mut motion = trajectory(&lines.join("; "));
        for t in [(1, 3), (-2, 5), (1, 1)] {
            let t = Rational::from(t);
            let found = motion.at(&t, bits(20)).unwrap();
            for (i, found) in found.iter().enumerate() {
                assert!(found.contains(&exact(i, &t)), "{lines:?} at {t}");
            }
        }
    }
}

/// Values of Lorenz's equations and of the pendulum that a Taylor series in mpmath gives at 34
/// digits, and of a run-up of Kloss's motor in closed form.
#[test]
fn values_from_elsewhere() {
    let mut lorenz =
        trajectory("x = 1 -> 10*(y - x); y = 1 -> x*(28 - z) - y; z = 1 -> x*y - 8/3*z");
    let at = decimals(&mut lorenz, (1, 1), 20);
    assert_eq!(at[0], "-9.3785700109250623608");
    let kloss = "w = 0 -> 44/((1 - w/157)/0.2 + 0.2/(1 - w/157))/0.9; phi = 0 -> w";
    assert_eq!(
        decimals(&mut trajectory(kloss), (10, 1), 23)[0],
        "149.89407213860833449354"
    );
}

/// The energy of a pendulum that nearly reaches the top is kept.
#[test]
fn near_the_separatrix() {
    let mut motion = trajectory("theta = 3.1415 -> omega; omega = 0 -> -sin(theta)");
    for t in [(7, 1), (40, 1), (-13, 1)] {
        let found = motion.at(&Rational::from(t), bits(25)).unwrap();
        let energy =
            |theta: &Ball, omega: &Ball| omega.square().shift(-1) - real::cos(theta, 200).unwrap();
        let [start, zero] =
            [(31415, 10000), (0, 1)].map(|q| Ball::rational(200, &Rational::from(q)));
        assert!(energy(&found[0], &found[1]).overlaps(&energy(&start, &zero)));
        assert!(found.iter().all(|ball| ball.accuracy_bits() >= 87));
    }
}

#[test]
fn starts_and_times_are_exact() {
    let definitions = Definitions::default();
    let state = State::new("y", parse("sqrt(2)").unwrap(), parse("k*y").unwrap());
    let start = parse("1/3").unwrap();
    let problem = InitialValueProblem::new(&definitions, &["k"], "s", &start, &[state]).unwrap();
    let mut motion = problem
        .trajectory(&[Rational::from(-2)], limited())
        .unwrap();
    assert_eq!(*motion.start(), Rational::from((1, 3)));
    let at = motion.at(&Rational::from((1, 3)), bits(30)).unwrap();
    assert_eq!(
        at[0].to_decimal(30).unwrap(),
        "1.41421356237309504880168872421"
    );
    // The derivative by k of √2 e^{k u} is u times it.
    let at = motion.at(&Rational::from((4, 3)), bits(30)).unwrap();
    let found = motion.derivatives(&Rational::from((4, 3))).unwrap();
    let slope = &found.by_inputs[0][0];
    assert!(
        slope.overlaps(&at[0]) && slope.accuracy_bits() >= 36,
        "{slope:?} {at:?}"
    );
    let irrational = InitialValueProblem::new(
        &definitions,
        &[],
        "s",
        &parse("pi").unwrap(),
        &[State::new("y", parse("1").unwrap(), parse("y").unwrap())],
    );
    let refused = irrational
        .unwrap()
        .trajectory(&[], limited())
        .err()
        .unwrap();
    assert_eq!(
        refused.to_string(),
        "the start of the time PI is not a rational number"
    );
}

#[test]
fn problems_that_are_none() {
    let refused = |text: &str| {
        problem(text)
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    assert_eq!(refused("y = 1 -> y; y = 2 -> 1"), "y is declared twice");
    assert_eq!(
        refused("y = z -> y; z = 2 -> 1"),
        "the start of y depends on z, which has no value before the start"
    );
    assert_eq!(
        refused("y = 1 -> i*y"),
        "the rate of y is not a real number"
    );
    assert_eq!(refused("y = 1 -> q"), "the rate of y: q has no value");
}

#[test]
fn motions_that_end() {
    let ends = |text: &str, t: (i64, i64)| {
        let problem = problem(text).unwrap();
        let motion = problem.trajectory(&[], limited());
        let at = motion.and_then(|mut motion| motion.at(&Rational::from(t), bits(20)));
        at.map(|balls| balls[0].to_decimal(12).unwrap_or_default())
    };
    let blow_up = |text: &str, at: f64| match ends(text, (10, 1)) {
        Err(MotionError::BlowUp { reached, near }) => {
            assert!((near - at).abs() < 1e-6, "{text}: {near}");
            assert!(
                reached.to_f64() <= at && reached.to_f64() > at - 1e-3,
                "{text}: {reached}"
            );
        }
        other => panic!("{text}: {other:?}"),
    };
    blow_up("y = 1 -> y^2", 1.0);
    blow_up("y = 0 -> 1 + y^2", std::f64::consts::FRAC_PI_2);
    blow_up("y = 0 -> exp(y)", 1.0);
    // Both sides of √ are smooth, its end is not.
    let end = ends("y = 1 -> -1/y", (1, 1));
    assert!(
        matches!(end, Err(MotionError::Undecided { ref reached, .. }) if *reached < 0.5 && *reached > 0.49),
        "{end:?}"
    );
    let undefined = |text: &str| match ends(text, (1, 1)) {
        Err(error @ (MotionError::Rate { .. } | MotionError::Start { .. })) => error.to_string(),
        other => panic!("{text}: {other:?}"),
    };
    assert_eq!(
        undefined("y = 0 -> 1/y"),
        "the rate of y has no value at 0: the divisor may be zero: 1/y"
    );
    assert_eq!(
        undefined("y = -1 -> log(y)"),
        "the rate of y has no value at 0: the logarithm of a number that is not positive: log(y)"
    );
    assert_eq!(
        undefined("y = 1 -> y; z = log(-1) -> 1"),
        "the start of z has no value: the logarithm of a number that is not positive: log(-1)"
    );
    let limited = problem("y = 1 -> cos(t)*y").unwrap();
    let mut motion = limited
        .trajectory(
            &[],
            Limits {
                bits: 256,
                steps: 5,
            },
        )
        .unwrap();
    let end = motion.at(&Rational::from(1000), bits(20));
    assert!(
        matches!(end, Err(MotionError::Undecided { ref reason, .. }) if reason.contains("limit")),
        "{end:?}"
    );
}

/// Motions whose rates change from one formula to another, in closed form.
#[test]
fn switches() {
    let at = |text: &str, t: (i64, i64)| {
        let mut motion = trajectory(text);
        let found = motion.at(&Rational::from(t), bits(25));
        let decimal = |ball: &Ball| ball.to_decimal(20).unwrap_or_else(|| format!("{ball:?}"));
        (
            found.map(|balls| decimal(&balls[0])),
            motion
                .switches()
                .into_iter()
                .map(|s| s.0)
                .collect::<Vec<_>>(),
        )
    };
    // x = cos t until π/2, then x″ = −4x: x = −sin(2(t − π/2))/2, then cos again.
    let spring = "x = 1 -> v; v = 0 -> -if(x < 0, 4*x, x)";
    assert_eq!(at(spring, (1, 1)).0, Ok("0.54030230586813971740".into()));
    assert_eq!(at(spring, (2, 1)).0, Ok("-0.37840124765396412569".into()));
    let absolute = at("y = -1 -> 1 + abs(y)/2", (3, 1));
    // y = 2 − 3 e^{−t/2} until y = 0 at t_1 = 2 log(3/2), then y = 2 (e^{(t − t_1)/2} − 1).
    assert_eq!(absolute.0, Ok("3.9755854271174197635".into()));
    let half_turn = Ball::pi(200).shift(-1);
    let first = &at(spring, (2, 1)).1[0];
    assert!(
        first.overlaps(&half_turn) && first.accuracy_bits() > 100,
        "{first:?}"
    );
    // The steps of floor are at 1 and 2.
    assert_eq!(
        at("y = 0 -> floor(t)", (5, 2)).0,
        Ok("2.0000000000000000000".into())
    );
    assert_eq!(
        at("y = 0 -> fmax(t - 1, 0)", (3, 1)).0,
        Ok("2.0000000000000000000".into())
    );
    // y = (t − 1)² − 1/4 is below zero for a time of 1 within a step.
    let below = "z = 0 -> if(y < 0, 1, 0); y = 3/4 -> 2*(t - 1)";
    assert_eq!(at(below, (3, 1)).0, Ok("1.0000000000000000000".into()));
    // A start at a switch that the motion leaves.
    assert_eq!(
        at("y = 0 -> 1 + abs(y)", (1, 1)).0,
        Ok("1.7182818284590452354".into())
    );
    let before = at("y = 1 -> if(y > 0, -1, 1)", (1, 2)).0;
    assert_eq!(before, Ok("0.50000000000000000000".into()));
    // Where the rate is zero at the switch alone the motion may stay there.
    for text in [
        "y = 0 -> if(y == 1, 0, 1)",
        "y = 1 -> if(y == 1, 0, 1)",
        "y = 2 -> if(y == 1, 0, -1)",
        "y = 0 -> if(y >= 1 and y <= 1, 0, 1)",
        "y = 0 -> if(not (y < 1 or y > 1), 0, 1)",
    ] {
        let found = at(text, (2, 1)).0;
        assert!(
            matches!(
                found,
                Err(MotionError::Undecided { .. } | MotionError::Rate { .. })
            ),
            "{text}: {found:?}"
        );
    }
    // y′ = y + 1 but at one value, where y′ = 1.
    assert_eq!(
        at("y = 0 -> 1 + if(y != 1/3, y, 0)", (1, 1)).0,
        Ok("1.7182818284590452354".into())
    );
    assert_eq!(
        at("y = 0 -> if(t == 1, 100, 1)", (2, 1)).0,
        Ok("2.0000000000000000000".into())
    );
    // Motion that touches a switch.
    let touching = at("y = 1 -> v; v = -2 -> if(y > 0, 2, 0)", (3, 1));
    assert!(
        matches!(touching.0, Err(MotionError::Undecided { .. })),
        "{touching:?}"
    );
}

/// A problem with inputs, whose values are given.
fn with_inputs(inputs: &[(&str, (i64, i64))], text: &str) -> Trajectory {
    let states: Vec<State> = text
        .split(';')
        .map(|line| {
            let (name, rest) = line.split_once('=').unwrap();
            let (start, rate) = rest.split_once("->").unwrap();
            State::new(name.trim(), parse(start).unwrap(), parse(rate).unwrap())
        })
        .collect();
    let start = parse("0").unwrap();
    let names: Vec<&str> = inputs.iter().map(|input| input.0).collect();
    let definitions = Definitions::default();
    let problem = InitialValueProblem::new(&definitions, &names, "t", &start, &states).unwrap();
    let values: Vec<Rational> = inputs.iter().map(|q| Rational::from(q.1)).collect();
    problem.trajectory(&values, limited()).unwrap()
}

/// Compares the derivatives by the starts, then by the inputs, state by state.
fn check_derivatives(mut motion: Trajectory, t: (i64, i64), due: &[f64]) {
    let found = motion.derivatives(&Rational::from(t)).unwrap();
    let rows = found.by_starts.iter().zip(&found.by_inputs);
    let all: Vec<&Ball> = rows.flat_map(|(a, b)| a.iter().chain(b)).collect();
    assert_eq!(all.len(), due.len());
    for (found, due) in all.iter().zip(due) {
        if due.is_nan() {
            assert!(!found.is_finite(), "{found:?}");
            continue;
        }
        // The expected values are rounded themselves.
        let rounding = Mag::from_f64(due.abs() * 1e-15);
        let near = Ball::exact(64, *due).widened(rounding);
        assert!(found.overlaps(&near), "{found:?} {due}");
        assert!(
            found.rad() <= Mag::from_f64(1e-7 * (1.0 + due.abs())),
            "{found:?}"
        );
    }
}

#[test]
fn derivatives_of_motions_in_closed_form() {
    // x = a cos ωt + b/ω sin ωt.
    let (w, t, b): (f64, f64, f64) = (1.5, 8.0, -1.0);
    let (s, c) = (w * t).sin_cos();
    let by_w = [
        -t * s + b * (t * c / w - s / w / w),
        -s - w * t * c - b * t * s,
    ];
    let due = [c, s / w, by_w[0], -w * s, c, by_w[1]];
    let oscillator = with_inputs(&[("w", (3, 2))], "x = 1 -> v; v = -1 -> -w^2*x");
    check_derivatives(oscillator, (8, 1), &due);
    // y = K/(1 + (K/a − 1) e^{−rt}).
    let (k, r, a, t) = (4.0f64, 2.0f64, 0.5f64, 1.5);
    let e = (-r * t).exp();
    let below = 1.0 + (k / a - 1.0) * e;
    let square = below * below;
    let by_k = 1.0 / below - k * e / a / square;
    let due = [
        k * k * e / (a * a * square),
        by_k,
        k * (k / a - 1.0) * t * e / square,
    ];
    let inputs = [("k", (4, 1)), ("r", (2, 1))];
    check_derivatives(
        with_inputs(&inputs, "y = 1/2 -> r*y*(1 - y/k)"),
        (3, 2),
        &due,
    );
    // A start that is a function of the input: √q e^{−qt}, forwards and backwards.
    for t in [1.0f64, -1.0] {
        let (q, e) = (2.0f64, (-2.0 * t).exp());
        let due = [e, e / (2.0 * q.sqrt()) - q.sqrt() * t * e];
        let decay = with_inputs(&[("q", (2, 1))], "y = sqrt(q) -> -q*y");
        check_derivatives(decay, (t as i64, 1), &due);
    }
}

/// Rates that jump: the derivatives jump with them.
#[test]
fn derivatives_across_switches() {
    // Reaches 1 at t = 1 − p, then moves twice as fast: y = 1 + 2 (t − 1 + p).
    let rise = || with_inputs(&[("p", (1, 4))], "y = p -> if(y < 1, 1, 2)");
    check_derivatives(rise(), (1, 2), &[1.0, 1.0]);
    check_derivatives(rise(), (2, 1), &[2.0, 2.0]);
    check_derivatives(rise(), (0, 1), &[1.0, 1.0]);
    // The time of the switch is a parameter: y = q + k (t − q).
    let inputs = [("q", (1, 3)), ("k", (5, 1))];
    let turn = with_inputs(&inputs, "y = 0 -> if(t < q, 1, k)");
    check_derivatives(turn, (3, 1), &[1.0, -4.0, 8.0 / 3.0]);
    // Rates that are continuous: y = −(p − t)²/2 up to t = p, then (t − p)²/2.
    let smooth = with_inputs(&[("p", (1, 3))], "y = -p^2/2 -> abs(t - p)");
    check_derivatives(smooth, (1, 1), &[1.0, -2.0 / 3.0]);
    // Up with 1 and down with −3, and the sum of both as a second state.
    let text = "y = 0 -> if(t < p, 1, -3); z = 0 -> y";
    let both = with_inputs(&[("p", (1, 2))], text);
    check_derivatives(both, (1, 1), &[1.0, 0.0, 4.0, 1.0, 1.0, 2.0]);
    // x = cos t, then −2 sin((t − π/2)/2): by the start (x = a cos t), x at π/2 switches at the
    // same time whatever a is.
    let spring = with_inputs(&[], "x = 1 -> v; v = 0 -> -if(x < 0, x/4, x)");
    let t = 2.0 - std::f64::consts::FRAC_PI_2;
    let (s, c) = (t / 2.0).sin_cos();
    check_derivatives(spring, (2, 1), &[-2.0 * s, c, -c, -s / 2.0]);
}

/// Switches at one instant: times that steps of floor share, and a place at a time.
#[test]
fn switches_at_one_instant() {
    let at = |text: &str, t: (i64, i64)| decimals(&mut trajectory(text), t, 15)[0].clone();
    // ∫ floor(t) + floor(2t) over [0, 5/2] is 3/2 + 1 and 1/2 + 1 + 3/2 + 2.
    assert_eq!(
        at("y = 0 -> floor(t) + floor(2*t) - 1/2", (5, 2)),
        "5.75000000000000"
    );
    // y = t up to 1, where both switch; then the rate is 2 + 3.
    let both = "y = 0 -> if(y < 1, 1, 2) + if(t < 1, 0, 3)";
    assert_eq!(at(both, (2, 1)), "6.00000000000000");
    assert_eq!(at(both, (1, 2)), "0.500000000000000");
    let three = "y = 0 -> 1 + if(y < 1, 0, 2) + if(z < 2, 0, 3) + floor(t); z = 1 -> 1";
    assert_eq!(at(three, (3, 2)), "4.50000000000000");
    // Two of the same: they come to rest at once.
    let twins = "x = 0 -> v; v = 1 -> -if(v > 0, 1, 2); y = 0 -> w; w = 1 -> -if(w > 0, 1, 2)";
    assert_eq!(at(twins, (2, 1)), "-0.500000000000000");
    // One that is crossed and one that is touched.
    let touched = at(
        "y = -1 -> 1 + if(t < 1, 0, 1); z = 1 -> if(y < 0, -1, 1)*abs(z)",
        (3, 1),
    );
    assert_eq!(touched, "4.00000000000000");
    // Times that nothing moves: the derivatives pass.
    let steps = with_inputs(&[("k", (3, 1))], "y = 1 -> k*(floor(t) + floor(2*t))");
    check_derivatives(steps, (9, 4), &[1.0, 5.5]);
    // A place that moves and a time that does not: which comes first decides.
    let both = with_inputs(
        &[("k", (1, 1))],
        "y = 0 -> k + if(y < 1, 0, 1) + if(t < 1, 0, 3)",
    );
    check_derivatives(both, (2, 1), &[f64::NAN, f64::NAN]);
}

#[test]
fn starts_at_switches() {
    let start = |text: &str| with_inputs(&[("k", (2, 1))], text);
    // The start does not leave the switch with k: v = −3kt; with v it does.
    let rest = start("x = 1 -> v; v = 0 -> -k*if(v > 0, 1, 3)");
    check_derivatives(rest, (1, 1), &[1.0, f64::NAN, -1.5, 0.0, f64::NAN, -3.0]);
    let rest = start("x = 1 -> v; v = 0 -> -k*if(v > 0, 1, 3)");
    check_derivatives(rest, (0, 1), &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let moved = start("y = k - 2 -> 1 + if(y < 0, 0, 1)");
    check_derivatives(moved, (1, 1), &[f64::NAN, f64::NAN]);
    // Two at once.
    let both = start("y = 0 -> k + abs(y) + floor(t)");
    let e = std::f64::consts::E.sqrt();
    check_derivatives(both, (1, 2), &[f64::NAN, e - 1.0]);
}

/// Motions that slide along a switch, in closed form.
#[test]
fn sliding() {
    let at = |text: &str, t: (i64, i64)| decimals(&mut trajectory(text), t, 25);
    // A mass on a belt of speed 1/2: it slips up to π/6, is carried to x = 1 at π/6 + √3, and slips
    // again.
    let belt = "x = 0 -> v; v = 0 -> -x + if(v < 1/2, 1, -1)";
    assert_eq!(at(belt, (2, 1))[0], "0.8721752084164119166977232");
    assert_eq!(
        at(belt, (3, 1)),
        ["1.338747083361802856853530", "0.3677640731690247446766366"].map(String::from)
    );
    // A shaft that a brake holds, frees, holds and frees: it turns from asin(3/4) to 3.0587…, and
    // back from π + asin(3/4) on.
    let brake =
        "phi = 0 -> omega; omega = 0 -> 2*sin(t) - if(omega > 0, 3/2, if(omega < 0, -3/2, 0))";
    assert_eq!(at(brake, (1, 2)), ["0", "0"].map(String::from));
    assert_eq!(
        at(brake, (3, 2)),
        [
            "0.04867554177916467445847864",
            "0.2034943706691109871538447"
        ]
        .map(String::from)
    );
    assert_eq!(at(brake, (3, 1))[1], "0.07495376720540772187336997");
    assert_eq!(at(brake, (7, 2))[0], "0.5936135612396032973184968");
    assert_eq!(
        at(brake, (9, 2)),
        [
            "0.5688896853623904819204025",
            "-0.1357661555276472530632258"
        ]
        .map(String::from)
    );
    // Motions that touch the switch from one side or reach a second one are undecided.
    let touches = at(belt, (9, 1)).concat();
    assert!(
        touches.contains("8.538") && touches.contains("touch"),
        "{touches}"
    );
    let both = "x = 1 -> if(x > 0, -1, 1); y = 2 -> if(y > 0, -1, 1)";
    assert_eq!(
        at(both, (3, 2)),
        ["0", "0.5000000000000000000000000"].map(String::from)
    );
    let two = at(both, (3, 1)).concat();
    assert!(two.contains("two switches"), "{two}");
    // Other states have rates of their own where y is zero.
    let own = "x = 0 -> if(y == 0, 7, 1); y = 1 -> if(y > 0, -1, 1)";
    assert_eq!(at(own, (1, 2))[0], "0.5000000000000000000000000");
    let own = at(own, (3, 1)).concat();
    assert!(own.contains("rates of its own"), "{own}");
    // The past of a motion at rest is not determined.
    let held = at("w = 0 -> 1 - if(w > 0, 2, -2)", (-1, 2)).concat();
    assert!(held.contains("the side of a switch"), "{held}");
    // The same resistance by its size and the sign of the rate.
    let signed = "phi = 0 -> omega; omega = 0 -> 2*sin(t) - copysign(3/2, omega)";
    assert_eq!(at(signed, (9, 2)), at(brake, (9, 2)));
    let signed = "phi = 0 -> omega; omega = 0 -> 2*sin(t) - 3/2*omega/abs(omega)";
    assert!(at(signed, (9, 2)).concat().contains("no value"));
    // Leaves at t = 1 with ω = (t − 1)² (t − 2) (t − 3)/10, which comes to rest at 2; a polynomial,
    // whose steps end far beyond that.
    let turns =
        "w = 0 -> 1 + (t - 1)*((2*t - 5)*(t - 1) + 2*(t - 2)*(t - 3))/10 - if(w > 0, 1, -1)";
    assert_eq!(at(turns, (3, 2)), ["0.01875000000000000000000000"]);
    assert_eq!(at(turns, (9, 4)), ["0"]);
    // Jumps of the torque while the brake holds.
    let steps = "w = 0 -> if(t < 1, 1, if(t < 2, -1, 3)) - if(w > 0, 2, -2)";
    assert_eq!(at(steps, (3, 2)), ["0"]);
    let jump = at(steps, (3, 1)).concat();
    assert!(
        jump.contains("undecided") && jump.contains("leaves"),
        "{jump}"
    );
}

#[test]
fn derivatives_of_sliding_motions() {
    let root = 3f64.sqrt() / 2.0;
    let belt = with_inputs(
        &[("u", (1, 2))],
        "x = 0 -> v; v = 0 -> -x + if(v < u, 1, -1)",
    );
    check_derivatives(belt, (2, 1), &[root, 0.5, 1.476401224401701, 0.0, 0.0, 1.0]);
    let brake = || {
        let rate = "2*sin(t) - if(omega > 0, c, if(omega < 0, -c, 0))";
        with_inputs(
            &[("c", (3, 2))],
            &format!("phi = 0 -> omega; omega = 0 -> {rate}"),
        )
    };
    let open = f64::NAN;
    check_derivatives(
        brake(),
        (7, 2),
        &[1.0, open, -2.44354535027441, 0.0, open, 0.0],
    );
    let due = [1.0, open, -2.313319204280961, 0.0, open, 0.5103452674287258];
    check_derivatives(brake(), (9, 2), &due);
}

/// The fields of a problem without inputs on sides of its first switch, at a time and states.
fn fields(text: &str, sides: &[Side], time: (i64, i64)) -> (Vec<Smooth>, Vec<Switch>) {
    let problem = problem(text).unwrap();
    let mut evaluator = Evaluator::new(problem.graph.clone(), Balls::new(128));
    evaluator.set_input(0, Value::rational(128, Rational::from(time)));
    let switches: Vec<Switch> = problem.switches.iter().map(|s| s.0).collect();
    let field = |side: &Side| {
        let known = switches.first().map(|s| (*s, side.clone()));
        Smooth::new(&problem, &mut evaluator, &known.into_iter().collect()).unwrap()
    };
    (sides.iter().map(field).collect(), switches)
}

/// From y = 1/2 with the rate −1 it takes at least 1/2 to come to rest at zero.
#[test]
fn a_switch_is_reached_before_the_motion_slides() {
    let sides = [Side::Positive, Side::Negative];
    let (pieces, switches) = fields("y = 0 -> if(y > 0, -1, 1)", &sides, (0, 1));
    let pieces: Vec<&Smooth> = pieces.iter().collect();
    let [start, half] = [(0, 1), (1, 2)].map(Rational::from);
    let states = [Ball::rational(128, &half)];
    let width = (Rational::from((1, 64)), false);
    let Ok(crossing) = cross((&start, &states), &pieces, &switches, width, 128) else {
        panic!("not crossed")
    };
    assert!(
        crossing.slides && crossing.after >= half,
        "{}",
        crossing.after
    );
}

/// e^t over a quarter.
#[test]
fn all_solutions_are_in_the_box_of_a_way_across() {
    let (pieces, _) = fields("y = 1 -> y", &[Side::Positive], (0, 1));
    let [start, quarter] = [(0, 1), (1, 4)].map(Rational::from);
    let span = times(128, &start, &quarter);
    let way = Ball::rational(128, &quarter);
    let (hull, end) = enclosed(&[Ball::integer(128, 1)], &[&pieces[0]], &span, &way).unwrap();
    let due = real::exp(&way, 128).unwrap();
    assert!(
        end[0].contains_ball(&due) && hull[0].contains_ball(&due),
        "{hull:?} {end:?}"
    );
}
