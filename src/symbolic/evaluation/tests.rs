//! Values of formulas in balls and in floating point.

use super::{
    Algebraic, Answer, Balls, Certified, Elementary, Evaluator, Floating, Format, Goal, Value,
};
use crate::fpcore::parse_cores;
use crate::graph::Graph;
use crate::{Definitions, parse};
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::Rational;
use std::sync::Arc;

/// The value of a formula of x, to `digits` digits, or the reason why there is none.
pub(super) fn value(text: &str, x: (i64, i64), digits: usize) -> String {
    value_in(Graph::new(["x".to_string()]), text, x, digits)
}

/// The value in a graph without nodes.
pub(super) fn value_in(mut graph: Graph, text: &str, x: (i64, i64), digits: usize) -> String {
    let definitions = Definitions::default();
    let e = parse(text).unwrap();
    let id = graph.build(&definitions, &e).unwrap();
    let goal = Goal::Bits((digits as f64 * 3.33) as u32 + 8);
    let algebra = Algebraic {
        definitions,
        expressions: vec![(id, e)],
    };
    let mut certified = Certified::new(Arc::new(graph), 4096).with_algebra(Arc::new(algebra));
    match &certified.values(&[Rational::from(x)], &[id], goal)[0] {
        Answer::Number(ball) => ball.to_decimal(digits).unwrap_or_else(|| "?".into()),
        Answer::Zero => "0".into(),
        Answer::Huge { negative } => if *negative { "-huge" } else { "huge" }.into(),
        Answer::Undefined { reason, place } => format!("undefined: {reason}: {place}"),
        Answer::Undecided(u) => format!("undecided: {}: {}", u.reason, u.place),
    }
}

/// To 25 digits by mpmath.
#[test]
fn special_functions_at_a_point() {
    for (text, due) in [
        ("besselj(0, x)", "0.7651976865579665514497175"),
        ("besselj(2, 5*x/2)", "0.4460590584396172267359408"),
        ("besselj(1/3, x)", "0.7308764021694480477492936"),
        ("D(besselj(1/3, x), x)", "-0.05528517526742190203361208"),
        ("D(besselie(1/4, x), x)", "-0.1578008938212776641412808"),
        ("besseli(x + 2/3, 60)", "5758084656377955684363943"),
        ("im(besselj(x*7/5, 2*i))", "0.9657414419089343575104651"),
        ("besseli(1, x)", "0.5651591039924850272076960"),
        ("besselie(1, x)*exp(x)", "0.5651591039924850272076960"),
        ("airyai(x)", "0.1352924163128814155241474"),
        ("airyaiprime(-2*x)", "0.6182590207416910414062643"),
        ("airybi(x)", "1.207423594952871259436379"),
        ("sinint(2*x)", "1.605412976802694848576720"),
        ("cosint(2*x)", "0.4229808287748649956985652"),
        ("expi(2*x)", "4.954234356001890163379505"),
        ("expint(2*x)", "0.04890051070806111956723984"),
        ("lambertw(x)", "0.5671432904097838729999687"),
        ("lambertwm1(-x/4)", "-2.153292364110349649169099"),
        ("riemannzeta(3*x)", "1.202056903159594285399738"),
        ("D(riemannzeta(2*x), x)", "-1.875096508631687507405148"),
        ("im(lgamma(1 + i*x))", "-0.3016403204675331978875317"),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

/// Differences from numbers near them, to 25 digits by mpmath: the integral and the root have to be
/// known to more than those.
#[test]
fn integrals_and_roots_that_cancel() {
    for (text, due) in [
        (
            "int(t, 0, x, exp(-t^2)) - 0.746824132812427025399",
            "4.674361318530053544996868e-22",
        ),
        (
            "root(t, x, 2*x, t^2 - 2) - 1.414213562373095048801",
            "6.887242096980785696718754e-22",
        ),
        // A root that is far smaller than its interval.
        (
            "root(t, -1e-20, 2e-20, t - 1e-20*sin(t) - 1e-90*x)",
            "1.000000000000000000010000e-90",
        ),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

/// Differences that would take thousands of bits, to 25 digits by mpmath.
#[test]
fn identities_spare_precision() {
    for (text, due) in [
        (
            "(- 1 (/ 1 (+ 1 (exp (* -9000 x)))))",
            "2.236983963488984692781503e-3909",
        ),
        (
            "(- 1 (/ 1 (+ (exp (* -9000 x)) 1)))",
            "2.236983963488984692781503e-3909",
        ),
        (
            "(- (pow E (* 1e-300 x)) 1)",
            "1.000000000000000000000000e-300",
        ),
        // Others that look like them.
        (
            "(- 1 (/ 2 (+ 1 (exp (* -9000 x)))))",
            "-1.000000000000000000000000",
        ),
        ("(pow PI x)", "3.141592653589793238462643"),
    ] {
        let core = parse_cores(&format!("(FPCore (x) {text})"))
            .unwrap()
            .remove(0);
        let mut graph = Graph::new(["x".to_string()]).of_real_functions();
        let id = graph
            .build(&Definitions::default(), &core.unwrap().body)
            .unwrap();
        let mut certified = Certified::new(Arc::new(graph), 192);
        let found = certified.values(&[Rational::from(1)], &[id], Goal::Bits(92));
        let Answer::Number(ball) = &found[0] else {
            panic!("{text}: {found:?}");
        };
        assert_eq!(ball.to_decimal(25).as_deref(), Some(due), "{text}");
    }
}

/// Derivatives obey the differential equation: its residual is zero.
#[test]
fn special_functions_have_their_derivatives() {
    for text in [
        "D(besselj(0, x), x) + besselj(1, x)",
        "D(besseli(2, x), x) - (besseli(1, x) + besseli(3, x))/2",
        "D(besselie(2, x), x) - (besselie(1, x) + besselie(3, x))/2 + besselie(2, x)",
        "D(D(airyai(x), x), x) - x*airyai(x)",
        "D(D(airybi(x), x), x) - x*airybi(x)",
        "D(sinint(x), x) - sin(x)/x",
        "D(cosint(x), x) - cos(x)/x",
        "D(expi(x), x) - exp(x)/x",
        "D(expint(x), x) + exp(-x)/x",
        "D(lambertw(x), x)*x*(1 + lambertw(x)) - lambertw(x)",
        "D(lambertwm1(-x), x)*x*(1 + lambertwm1(-x)) - lambertwm1(-x)",
        "D(zetaderivative(1, x), x) - zetaderivative(2, x)",
        "re(D(weierp(x, i), x) - weierpprime(x, i))",
    ] {
        let e = parse(text).unwrap();
        let mut graph = Graph::new(["x".to_string()]);
        let id = graph.build(&Definitions::default(), &e).unwrap();
        let mut evaluator = Evaluator::new(Arc::new(graph), Balls::new(160));
        evaluator.set_input(0, Value::Real(Ball::exact(160, 0.3125)));
        let found = evaluator.value(id).unwrap().real().unwrap().clone();
        let small = Mag::power_of_two(-120);
        assert!(found.contains_zero() && found.rad() < small, "{text}");
    }
}

#[test]
fn formulas_at_a_point() {
    for (text, x, due) in [
        (
            "log(1 + x) - x",
            (1, 1_000_000_000),
            "-4.9999999966666666692e-19",
        ),
        ("sqrt(2)*sqrt(3) - sqrt(6)", (1, 1), "0"),
        ("sin(x)^2 + cos(x)^2 - 1", (1, 3), "0"),
        ("(1 - cos(x))/x^2", (1, 1 << 40), "0.50000000000000000000"),
        ("exp(10^300*x)", (1, 1), "huge"),
        ("1/(1 + exp(10^300*x))", (0, 1), "0.50000000000000000000"),
        (
            "log(x)",
            (-1, 1),
            "undefined: the logarithm of a number that is not positive: log(x)",
        ),
        (
            "1/(x - 1)",
            (1, 1),
            "undefined: division by zero: 1/(x - 1)",
        ),
        ("if(x < 1, x^2, 2*x)", (1, 2), "0.25000000000000000000"),
        (
            "while(k < 10, k, 0, k + 1, s, 0, s + x*k, s)",
            (1, 1),
            "55.000000000000000000",
        ),
        ("sum(k, 1, 100, 1/k^2)", (1, 1), "1.6349839001848928651"),
        (
            "let(y, x + 1, z, y^2, z - y)",
            (2, 1),
            "6.0000000000000000000",
        ),
        ("D(sin(x)*exp(x), x)", (0, 1), "1.0000000000000000000"),
        ("root(y, 0, 2, y^2 - x)", (2, 1), "1.4142135623730950488"),
        // The logarithm does not depend on y.
        (
            "root(y, 1, 20, y + log(x))",
            (1, 20),
            "2.9957322735539909934",
        ),
        (
            "D(root(y, 0, 2, y^2 - x), x)",
            (2, 1),
            "0.35355339059327376220",
        ),
        ("int(t, 0, 1, exp(x*t))", (1, 1), "1.7182818284590452354"),
        (
            "D(int(t, 0, x, exp(x*t)), x)",
            (1, 1),
            "3.7182818284590452354",
        ),
        (
            "int(t, 0, inf, exp(-t^2))",
            (1, 1),
            "0.88622692545275801365",
        ),
        ("int(t, 0, 1, 1/sqrt(t))", (1, 1), "2.0000000000000000000"),
        // Odd but for a part far below the accuracy of the sine's integral.
        (
            "int(t, -10, 10, sin(t) + exp(-200 - t^2))",
            (1, 1),
            "2.4528927280692988577e-87",
        ),
        (
            "int(t, 0, inf, t/tgamma(1 + t))",
            (1, 1),
            "2.8077702420285193652",
        ),
        (
            "sum(n, 0, inf, 1/tgamma(n + 1))",
            (1, 1),
            "2.7182818284590452354",
        ),
        (
            "sum(n, 1, inf, n*exp(-n*x))",
            (1, 1),
            "0.92067359420779231895",
        ),
        ("sum(n, -2, inf, x^n)", (1, 3), "13.500000000000000000"),
        (
            "sum(n, 1, inf, 1/n^2)",
            (1, 1),
            "undecided: the limit on rounds of loops and terms of sums: sum(n, 1, inf, 1/n^2)",
        ),
        (
            "sum(n, 1, inf, x^n)",
            (1, 1),
            "undecided: a sum to infinity whose terms are not bounded: sum(n, 1, inf, pow(x, n))",
        ),
        // Across the cut of the square root and of a power.
        (
            "im(int(t, -1, 1, i*sqrt(-1 + i*t)))",
            (1, 1),
            "0.47520766279255650035",
        ),
        (
            "im(int(t, -1, 1, i*(-1 + i*t)^(-1/2)))",
            (1, 1),
            "0.39473645387123986416",
        ),
        ("int(t, 0, 3, floor(t)*x)", (1, 1), "3.0000000000000000000"),
        // Integrals under integrals, with limits that move, and along a segment of the plane
        // (mpmath).
        (
            "int(t, 0, 1, int(u, 0, t, exp(x*u^2)))",
            (1, 1),
            "0.60351083167765899112",
        ),
        (
            "int(t, 0, 1, int(u, 0, t, sin(t*u)))",
            (1, 1),
            "0.11990587100028236297",
        ),
        (
            "int(t, 0, 1, int(u, t, 2*t, 1/(x + u)))",
            (1, 1),
            "0.26162407188227391826",
        ),
        (
            "re(int(t, 0, 1 + 2*i, exp(-t^2)))",
            (1, 1),
            "-0.47558797736394259587",
        ),
        (
            "im(int(t, 0, 1 + 2*i, exp(-t^2)))",
            (1, 1),
            "-4.4746871004750177094",
        ),
        // All roots, in ascending order, of exactly as many; their number.
        (
            "root(y, -2, 2, y^3 - x*y, 1, 3)",
            (2, 1),
            "-1.4142135623730950488",
        ),
        (
            "root(y, -2, 2, y^3 - x*y, 3, 3)",
            (2, 1),
            "1.4142135623730950488",
        ),
        (
            "D(root(y, -2, 2, y^3 - x*y, 3, 3), x)",
            (2, 1),
            "0.35355339059327376220",
        ),
        ("roots(y, 0, 10, sin(x*y))", (2, 1), "7.0000000000000000000"),
        (
            "root(y, 0, 1, log(-x - y^2))",
            (2, 1),
            "undefined: the logarithm of a number that is not positive: log(-x - y^2)",
        ),
        (
            "root(y, -2, 2, y^3 - x*y, 1, 2)",
            (2, 1),
            "undefined: another number of roots in the interval: root(y, -2, 2, y^3 - x*y)",
        ),
        // The algebra compares numbers that balls cannot.
        (
            "if(sqrt(x)*sqrt(3) < sqrt(6), 1, 2)",
            (2, 1),
            "2.0000000000000000000",
        ),
        (
            "if(sqrt(x)*sqrt(3) == sqrt(6), 1, 2)",
            (2, 1),
            "1.0000000000000000000",
        ),
        (
            "if(sqrt(x)*sqrt(3) != sqrt(6), 1, x)",
            (2, 1),
            "2.0000000000000000000",
        ),
        (
            "if(sqrt(x)*sqrt(3) >= sqrt(6), 1/x, x)",
            (2, 1),
            "0.50000000000000000000",
        ),
        (
            "if(sqrt(x)*sqrt(3) == sqrt(6), 1, 3)",
            (3, 1),
            "3.0000000000000000000",
        ),
        (
            "sqrt(sqrt(x)*sqrt(3) - sqrt(6)) + x",
            (2, 1),
            "2.0000000000000000000",
        ),
        // Too close for the balls, and not equal.
        (
            "if(x + exp(-4000) == x, 1, 2)",
            (1, 1),
            "undecided: a comparison of numbers that may be equal: x + exp(-4000) == x",
        ),
        (
            "1/(sqrt(x)*sqrt(3) - sqrt(6))",
            (2, 1),
            "undefined: division by zero: 1/(sqrt(x)*sqrt(3) - sqrt(6))",
        ),
        ("re(W(x + i))", (1, 1), "0.30474420525691259246"),
        (
            "D(while(k < 3, k, 0, k + 1, p, 1, p*x, p), x)",
            (2, 1),
            "12.000000000000000000",
        ),
    ] {
        assert_eq!(value(text, x, 20), due, "{text}");
    }
}

/// Sums to infinity against their closed forms.
#[test]
fn sums_to_infinity_have_their_closed_forms() {
    for (sum, closed) in [
        ("sum(n, 0, inf, x^n)", "1/(1 - x)"),
        ("sum(n, 0, inf, n^3*x^n)", "x*(1 + 4*x + x^2)/(1 - x)^4"),
        ("sum(n, 0, inf, x^n/tgamma(n + 1))", "exp(x)"),
        (
            "sum(n, -3, inf, n*exp(-n*x))",
            "exp(-x)/(1 - exp(-x))^2 - exp(x) - 2*exp(2*x) - 3*exp(3*x)",
        ),
    ] {
        for x in [(1, 10), (1, 3), (5, 8), (37, 40)] {
            assert_eq!(value(sum, x, 30), value(closed, x, 30), "{sum} at {x:?}");
        }
    }
    // A derivative term by term is not proved to be one.
    let mut graph = Graph::new(["x".to_string()]);
    let slope = parse("D(sum(n, 0, inf, x^n), x)").unwrap();
    assert!(graph.build(&Definitions::default(), &slope).is_err());
}

#[test]
fn floating_point_has_one_rounding_an_operation() {
    let mut graph = Graph::new(["x".to_string(), "y".to_string()]);
    let definitions = Definitions::default();
    let mut at = |text: &str, format: Format, x: f64, y: f64| {
        let id = graph.build(&definitions, &parse(text).unwrap()).unwrap();
        let elementary = Elementary::Platform;
        let graph = Arc::new(graph.clone());
        let mut evaluator = Evaluator::new(graph, Floating { format, elementary });
        evaluator.set_input(0, x.into());
        evaluator.set_input(1, y.into());
        evaluator.value(id).unwrap().real().unwrap()
    };
    assert_eq!(at("x + y - x", Format::Double, 1e16, 1.0), 0.0);
    assert_eq!(
        at("fma(x, y, -1)", Format::Double, 1.0 + f64::EPSILON, 1.0),
        f64::EPSILON
    );
    assert_eq!(at("x*0.1", Format::Single, 1.0, 0.0), f64::from(0.1f32));
    assert_eq!(at("x/y", Format::Single, 1.0, 3.0), f64::from(1.0f32 / 3.0));
    assert_eq!(
        at("sin(pi)", Format::Double, 0.0, 0.0),
        std::f64::consts::PI.sin()
    );
}

/// Numbers that are equal but have no exact balls are seen to be equal where they are rational.
#[test]
fn equal_rational_numbers_are_compared() {
    for (text, x, due) in [
        ("if(x*3 <= 1, 5, 7)", (1, 3), "5.0000000000000000000"),
        (
            "while(t < 1, t, 0, t + 0.1, n, 0, n + 1, n)",
            (1, 1),
            "10.000000000000000000",
        ),
        (
            "1/(x*3 - 1)",
            (1, 3),
            "undefined: division by zero: 1/(x*3 - 1)",
        ),
        (
            "while(x > 0, n, 0, n + 1, n)",
            (1, 1),
            "undecided: the limit on rounds of loops and terms of sums: the last n",
        ),
    ] {
        assert_eq!(value(text, x, 20), due, "{text}");
    }
}

/// Rational functions of rational numbers that no ball holds: quotients are whole numbers and
/// halves.
#[test]
fn rational_functions_are_exact() {
    for (text, x, due) in [
        ("fmod(3, x)", (1, 3), "0"),
        ("fmod(-7*x, 2*x)", (1, 3), "-0.33333"),
        (
            "fmod(x, x - 1/3)",
            (1, 3),
            "undefined: the remainder of a division by zero: fmod(x, x - 1/3)",
        ),
        ("remainder(5*x, 2*x)", (1, 3), "0.33333"),
        ("remainder(7*x, 2*x)", (1, 3), "-0.33333"),
        ("remainder(-7*x, 2*x)", (1, 3), "0.33333"),
        ("round(x*3/2)", (5, 3), "3.0000"),
        ("round(-x*3/2)", (5, 3), "-3.0000"),
        ("nearbyint(x*3/2)", (5, 3), "2.0000"),
        ("nearbyint(-x*3/2)", (7, 3), "-4.0000"),
        ("nearbyint(x)", (5, 3), "2.0000"),
        ("floor(fmin(x*3, 1)) + ceil(fmax(x*3, 1))", (1, 3), "2.0000"),
        (
            "floor(fdim(x*3, 1)) + trunc(fma(x, 3, 1))",
            (1, 3),
            "2.0000",
        ),
        ("floor(copysign(x*3, -1))", (1, 3), "-1.0000"),
    ] {
        assert_eq!(value(text, x, 5), due, "{text} at {x:?}");
    }
}

/// A function that is not holomorphic has no value where one is asked for that is.
#[test]
fn continuations_are_holomorphic() {
    let holds = |text: &str, re: f64| {
        let mut graph = Graph::new(["x".to_string()]);
        let id = graph.build(&Definitions::default(), &parse(text).unwrap());
        let balls = Balls {
            holomorphic: true,
            wide: true,
            ..Balls::new(64)
        };
        let mut evaluator = Evaluator::new(Arc::new(graph), balls);
        let part = |x: f64| Ball::exact(64, x).widened(Mag::from_f64(0.25));
        let z = ComplexBall::new(part(re), part(0.0));
        evaluator.set_input(0, Value::Continued(z));
        evaluator.value(id.unwrap()).is_ok()
    };
    for (text, re, due) in [
        ("exp(i*x)*x", 1.0, true),
        ("sqrt(i*x - 1)", 1.0, true),
        // Across the cut.
        ("sqrt(i*x - 1)", 0.0, false),
        ("abs(exp(i*x))", 1.0, false),
        ("re(exp(i*x))", 1.0, false),
        ("re(W(x))", 1.0, false),
        ("abs(x)", 1.0, true),
        ("abs(x)", 0.1, false),
        ("sqrt(x)", 1.0, true),
        ("sqrt(x)", 0.1, false),
        ("floor(x)", 1.5, true),
        ("floor(x)", 1.0, false),
        ("if(x < 1, x, 1)", 1.5, true),
        ("if(x < 1, x, 1)", 1.0, false),
        ("1/x", 0.1, false),
    ] {
        assert_eq!(holds(text, re), due, "{text} at {re}");
    }
}

/// A jump may hide a root from a derivative, and an end may be the root itself.
#[test]
fn roots_are_proved_to_be_the_only_ones_and_inside() {
    for text in [
        "root(y, 0, 2, y - 2*floor(y) - 1/2)",
        "root(y, 0, sqrt(x), y^2 - x)",
    ] {
        let found = value(text, (2, 1), 20);
        assert!(found.starts_with("undecided: a root"), "{text}: {found}");
    }
}

/// Nothing is proved by a derivative across a jump, which moves with the parameter of an integral
/// or lies between the ends of a search.
#[test]
fn derivatives_do_not_cross_jumps() {
    for body in [
        "if(u < x, 1, 0)",
        "copysign(1, u - x)",
        "atan2(u - x, -1)",
        "arg(-1 + i*(u - x))",
        "im(log(-1 + i*(u - x)))",
        "im((-1 + i*(u - x))^(3/2))",
    ] {
        let slope = value(&format!("D(int(u, 0, 1, {body}), x)"), (2, 5), 5);
        assert!(slope.starts_with("undecided"), "{body}: {slope}");
    }
    for body in ["copysign(1, y)", "atan2(y, -1)", "if(y < 0, -1, 1)"] {
        let found = value(&format!("root(y, -1, 1, {body} + 2*y)"), (2, 5), 5);
        assert!(found.starts_with("undecided"), "{body}: {found}");
    }
    for (text, due) in [
        ("D(int(u, 0, 1, if(u < 1/3, x^2, 0)), x)", "0.26667"),
        ("D(int(u, 0, 1, fmax(u, x)), x)", "0.40000"),
        ("D(int(u, 0, 1, copysign(x, u - 1/3)), x)", "0.33333"),
    ] {
        assert_eq!(value(text, (2, 5), 5), due, "{text}");
    }
}
