//! Integrals of oscillations up to an end, against closed forms and values by mpmath.

use super::super::tests::value;

const HALF_PI: &str = "1.570796326794896619231322";

#[test]
fn classical_integrals() {
    for (text, due) in [
        ("int(t, 0, inf, sin(t)/t)", HALF_PI),
        ("int(t, 0, inf, (sin(t)/t)^2)", HALF_PI),
        ("int(t, -inf, 0, (1 - cos(t))/t^2)", HALF_PI),
        // π/4, 3π/8 and log(3)/2.
        (
            "int(t, 0, inf, sin(t)*cos(t)/t)",
            "0.7853981633974483096156608",
        ),
        ("int(t, 0, inf, (sin(t)/t)^3)", "1.178097245096172464423491"),
        (
            "int(t, 0, inf, sin(t)*sin(2*t)/t)",
            "0.5493061443340548456976226",
        ),
        // π/2 e^(−2) and π/2 e^(−1).
        (
            "int(t, 0, inf, cos(2*t)/(1 + t^2))",
            "0.2125841657938181642195612",
        ),
        (
            "int(t, 0, inf, t*sin(t)/(1 + t^2))",
            "0.5778636748954608589550466",
        ),
        // √(π/8) and √(π/2).
        ("int(t, 0, inf, sin(t^2))", "0.6266570686577501256039413"),
        (
            "int(t, 0, inf, cos(t)/sqrt(t))",
            "1.253314137315500251207883",
        ),
        // sin(1) − Ci(1), from both sides.
        ("int(t, 0, 1, sin(1/t))", "0.5040670619069283719898561"),
        (
            "int(t, 1, 2, sin(1/(2 - t)))",
            "0.5040670619069283719898561",
        ),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

#[test]
fn phases_and_amplitudes_that_vary() {
    for (text, due) in [
        (
            "int(t, 0, inf, sin(t + 1/(1 + t))/(t + 1))",
            "0.8646213140256960194098",
        ),
        (
            "int(t, 1, inf, cos(pi*t)/t^1.5)",
            "-0.09869300216390831288137",
        ),
        (
            "int(t, 0, inf, sin(t)/((t - 3)^2 + 4))",
            "0.09238045854759473465936",
        ),
        ("int(t, 0, 1, t*sin(1/(1 - t)))", "0.1255370447827670621081"),
        ("int(t, 0, 1, cos(3/t^2))", "-0.07093921336202908383290"),
        ("int(t, 0, 1, sin(1/t)/sqrt(t))", "0.5714732926457051898216"),
    ] {
        assert_eq!(value(text, (1, 1), 22), due, "{text}");
    }
}

/// Amplitudes that have poles beside the line, or do not tend to zero, prove nothing.
#[test]
fn what_need_not_converge_is_undecided() {
    for text in [
        "int(t, 0, inf, sin(t))",
        "int(t, 0, inf, sin(t)^2)",
        "int(t, 1, inf, t*cos(t))",
        "int(t, 0, 1, sin(1/t)/t^2)",
        // The poles lie to the right of all lines that are tried.
        "int(t, 0, inf, sin(t)/((t - 1000)^2 + 1))",
        "int(t, 0, inf, sin(t)*sqrt((t - 1000)^2 + 1)/t^2)",
        "int(t, 0, inf, sin(t)/(t - 1000))",
    ] {
        let found = value(text, (1, 1), 15);
        assert!(found.starts_with("undecided"), "{text}: {found}");
    }
}
