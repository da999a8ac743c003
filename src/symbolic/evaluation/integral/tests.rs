//! Integrals across jumps and singularities, and under one another.

use super::super::tests::value;

/// Evaluations of integrals within integrals are counted together.
#[test]
fn nested_integrals_end() {
    let text = "int(t, 0, 1, int(s, 0, 1, int(r, 0, 1, floor(7*s + 3*t + 2*r))))";
    let found = value(text, (1, 1), 20);
    assert!(
        found.starts_with("undecided: the limit on evaluations"),
        "{found}"
    );
}

/// An interval that holds a jump holds the values on both sides.
#[test]
fn integrals_are_cut_at_jumps() {
    for (text, due) in [
        ("int(t, 0, 1, if(t^2 < 1/2, 1, 2))", "1.29289321881"),
        (
            "int(t, 0, 1, if(t < x and t > 1/7, t, 0))",
            "0.0697959183673",
        ),
        ("int(t, 0, 1, if(not (t == x), t, 5))", "0.500000000000"),
        ("int(t, 0, 1, if(t < x, 1, log(t - 2/5)))", "undecided"),
    ] {
        let found = value(text, (2, 5), 12);
        assert!(found.starts_with(due), "{text}: {found}");
    }
}

#[test]
fn a_part_that_is_zero_inside_is_not_so_at_the_end() {
    let text = "int(t, 0, 1, sqrt(abs(t - 0.3))*log(abs(t - 0.3))/t^0.75)";
    assert_eq!(value(text, (1, 1), 25), "-2.623011242198388074846757");
}

/// Singularities at zeros between the limits of an integral; values by mpmath.
#[test]
fn integrals_across_singularities() {
    for (text, due) in [
        (
            "int(t, 0, 1, log(abs(t - 0.3)))",
            "-1.610864302054893463025671",
        ),
        (
            "int(t, 0, 1, 1/sqrt(abs(t - 0.3)))",
            "2.768765168078483322870284",
        ),
        (
            "int(t, 0, 2, log(abs(sin(3*t) - 0.3)))",
            "-1.372727628504118500424428",
        ),
        (
            "int(t, -1, 1, log(abs(t))*exp(t))",
            "-2.114501750751457029143685",
        ),
        (
            "int(t, 0, 1, log(abs(t^2 - t + 0.2))/(1 + t))",
            "-2.187221220779856597628555",
        ),
        (
            "int(t, 0, 1, abs(t - 0.3)^(-0.25))",
            "1.560860834923300960051109",
        ),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
    for text in [
        "int(t, 0, 1, 1/(t - 0.3))",
        "int(t, 0, 1, 1/abs(t - 0.3))",
        "int(t, 0, 1, abs(t - 0.3)^(-1.25))",
    ] {
        assert!(value(text, (1, 1), 25).starts_with("undecided"), "{text}");
    }
}
