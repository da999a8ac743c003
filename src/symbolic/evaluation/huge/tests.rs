//! Values next to where there are none, and beyond the exponents.

use super::super::tests::value_in;
use crate::graph::Graph;
use crate::{Definitions, parse};

/// Where a function has no value, what depends on it has none.
#[test]
fn values_next_to_where_there_are_none() {
    let no_log = "undefined: the logarithm of a number that is not positive: log";
    let (of_x, of_number) = (format!("{no_log}(x)"), format!("{no_log}(-2)"));
    for (text, x, due) in [
        ("D(log(x), x)", -2, of_x.as_str()),
        ("D(x + log(-2), x)", 1, of_number.as_str()),
        ("D(int(t, 0, inf, exp(-t)*log(x)), x)", -2, of_x.as_str()),
        // Left of the imaginary axis, by mpmath.
        ("D(re(acosh(x + i/2)), x)", -2, "-0.51571488570496049682"),
        (
            "arg(x + 0*i)",
            0,
            "undefined: the argument of zero: arg(x + 0*i)",
        ),
        ("0*inf + x", 1, "undefined: zero times infinity: 0*inf"),
        (
            "inf - inf + x",
            1,
            "undecided: a number beyond 2^(2^30): inf - inf",
        ),
        ("airyai(x) - airyai(x)", 1, "0"),
        ("log(x) - log(x)", -1, of_x.as_str()),
        ("if(erf(x) < erf(x), 1, 2)", 1, "2.0000000000000000000"),
        // Huge numbers are known by their lower bounds alone.
        (
            "sqrt(exp(x))",
            1_000_000_000,
            "undecided: a number that may be within 2^(2^30): sqrt(exp(x))",
        ),
        (
            "if(sqrt(exp(x)) < exp(7*x/10), 1, 2)",
            1_000_000_000,
            "undecided: a comparison of numbers that may be equal: sqrt(exp(x)) < exp(7*x/10)",
        ),
        (
            "if(exp(x) > -exp(x/10), 1, 2)",
            2_000_000_000,
            "1.0000000000000000000",
        ),
        (
            "if(exp(x) < inf, 1, 2)",
            2_000_000_000,
            "1.0000000000000000000",
        ),
        // A step, the end of a domain and a pole, at numbers that the algebra knows.
        ("floor(sqrt(x)*sqrt(3)/sqrt(6))", 2, "1.0000000000000000000"),
        ("acos(sqrt(x)*sqrt(3)/sqrt(6))", 2, "0"),
        (
            "log1p(cos(pi)^3) + x",
            2,
            "undefined: log1p of a number that is not above -1: log1p(cos(PI)^3)",
        ),
        (
            "floor(x - exp(-4000))",
            1,
            "undecided: a value that is not accurate enough: floor(x - exp(-4000))",
        ),
        ("log1p(remainder(x/2, 1/3))", 3, "0.15415067982725830429"),
    ] {
        let graph = Graph::new(["x".to_string()]).of_real_functions();
        assert_eq!(value_in(graph, text, (x, 1), 20), due, "{text}");
    }
    let no_derivative = parse("D(re(tgamma(x + i)), x)").unwrap();
    let mut graph = Graph::new(["x".to_string()]);
    assert!(
        graph
            .build(&Definitions::default(), &no_derivative)
            .is_err()
    );
}
