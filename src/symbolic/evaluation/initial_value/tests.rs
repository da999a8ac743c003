//! Certified motions against values from elsewhere and against closed forms.

use super::{InitialValueProblem, Limits, MotionError, ProblemError, State, Trajectory};
use crate::evaluation::Goal;
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
    Goal::Bits(digits * 10 / 3 + 4)
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
    let slope = motion.sensitivities(&Rational::from((4, 3)), 60).unwrap();
    assert!(slope[0][0].overlaps(&at[0]) && slope[0][0].accuracy_bits() >= 60);
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
    // A start at a switch that the motion leaves.
    assert_eq!(
        at("y = 0 -> 1 + abs(y)", (1, 1)).0,
        Ok("1.7182818284590452354".into())
    );
    // Motion that stays at a switch.
    let sliding = at("y = 1 -> if(y > 0, -1, 1)", (3, 1));
    assert!(
        matches!(sliding.0, Err(MotionError::Undecided { ref reached, ref reason }) if (reached.to_f64() - 1.0).abs() < 1e-6 && reason.contains("touch")),
        "{sliding:?}"
    );
    // Motion that touches a switch.
    let touching = at("y = 1 -> v; v = -2 -> if(y > 0, 2, 0)", (3, 1));
    assert!(
        matches!(touching.0, Err(MotionError::Undecided { .. })),
        "{touching:?}"
    );
}

/// Rates that jump: the derivative by a parameter jumps with them.
#[test]
fn derivatives_across_switches() {
    let motion = |inputs: &[&str], values: &[(i64, i64)], text: &str| {
        let definitions = Definitions::default();
        let states: Vec<State> = text
            .split(';')
            .map(|line| {
                let (name, rest) = line.split_once('=').unwrap();
                let (start, rate) = rest.split_once("->").unwrap();
                State::new(name.trim(), parse(start).unwrap(), parse(rate).unwrap())
            })
            .collect();
        let start = parse("0").unwrap();
        let problem = InitialValueProblem::new(&definitions, inputs, "t", &start, &states).unwrap();
        let values: Vec<Rational> = values.iter().map(|q| Rational::from(*q)).collect();
        problem.trajectory(&values, limited()).unwrap()
    };
    let check = |mut m: Trajectory, t: (i64, i64), due: &[(i64, i64)]| {
        let found = m.sensitivities(&Rational::from(t), 60).unwrap();
        for (found, due) in found.iter().flatten().zip(due) {
            assert!(found.contains(&Rational::from(*due)), "{found:?} {due:?}");
            assert!(found.rad() < Mag::power_of_two(-50), "{found:?}");
        }
    };
    // Reaches 1 at t = 1 − p, then moves twice as fast: y = 1 + 2 (t − 1 + p).
    let m = motion(&["p"], &[(1, 4)], "y = p -> if(y < 1, 1, 2)");
    check(m, (1, 2), &[(1, 1)]);
    let m = motion(&["p"], &[(1, 4)], "y = p -> if(y < 1, 1, 2)");
    check(m, (2, 1), &[(2, 1)]);
    // The time of the switch is a parameter: y = q + k (t − q).
    let m = motion(&["q", "k"], &[(1, 3), (5, 1)], "y = 0 -> if(t < q, 1, k)");
    check(m, (3, 1), &[(-4, 1), (8, 3)]);
    // Rates that are continuous: y = −(p − t)²/2 up to t = p, then (t − p)²/2.
    let m = motion(&["p"], &[(1, 3)], "y = -p^2/2 -> abs(t - p)");
    check(m, (1, 1), &[(-2, 3)]);
    // Up with 1 and down with −3, and the sum of both as a second state.
    let text = "y = 0 -> if(t < p, 1, -3); z = 0 -> y";
    let m = motion(&["p"], &[(1, 2)], text);
    check(m, (1, 1), &[(4, 1), (2, 1)]);
}
