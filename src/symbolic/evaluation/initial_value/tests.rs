//! Certified motions against values from elsewhere and against closed forms.

use super::{InitialValueProblem, Limits, MotionError, ProblemError, State, Trajectory};
use crate::evaluation::Goal;
use crate::{Definitions, parse};
use mechaudit_reference::elementary as real;
use mechaudit_reference::{Ball, Mag};
use rug::Rational;

mod sliding;
mod switches;

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
