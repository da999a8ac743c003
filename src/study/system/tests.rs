//! Studies with systems of equations.

use crate::audit::{Method, ReferenceAnswer};
use crate::study::Study;
use rug::Rational;

fn digits(text: &str, inputs: &[Rational], count: u32) -> Vec<String> {
    let study = Study::parse(text, "system").unwrap();
    let found = study.digits(inputs, count).into_iter();
    let word = |v: crate::methods::CertifiedValue| match (v.decimal, v.why) {
        (Some(decimal), None) => decimal,
        (decimal, why) => format!(
            "{}: {}",
            decimal.unwrap_or_default(),
            why.unwrap_or_default()
        ),
    };
    found.map(word).collect()
}

fn fault(text: &str) -> String {
    Study::parse(text, "system").err().unwrap().to_string()
}

/// A circle and an exponential meet twice; `near` tells which point is meant, a box finds it alone.
#[test]
fn a_start_or_a_box_picks_the_solution() {
    let system = |u: &str, v: &str| {
        format!(
            "[system]\nunknowns = {{ u = {{ {u} }}, v = {{ {v} }} }}\n\
             equations = [\"u^2 + v^2 = 4\", \"exp(u) + v = 1\"]\n"
        )
    };
    // By Newton's method for u² + (1 − eᵘ)² = 4 in decimal arithmetic of 40 digits.
    let right = ["1.004168738474", "-1.729637287025"];
    let left = ["-1.816264068825", "0.8373677998912"];
    let near = system("near = 1", "near = -1.7");
    let found = digits(&near, &[], 13);
    assert_eq!(found[0][..13], right[0][..13]);
    assert_eq!(found[1][..13], right[1][..13]);
    for (u, v, due) in [
        ("between = [0, 2]", "between = [-2, 0]", right),
        ("between = [-2, 0]", "between = [0, 1]", left),
        ("near = -1.8", "between = [0.5, 1]", left),
    ] {
        let found = digits(&system(u, v), &[], 13);
        assert_eq!(
            [&found[0][..13], &found[1][..13]],
            due.map(|d| &d[..13]),
            "{u} {v}"
        );
    }
    let none = digits(&system("between = [0, 2]", "between = [-1, 0]"), &[], 10);
    assert!(
        none[0].starts_with("nan: no solution in the box"),
        "{none:?}"
    );
    let two = digits(&system("between = [-3, 3]", "between = [-3, 3]"), &[], 10);
    assert!(
        two[0].starts_with("nan: more than one solution in the box"),
        "{two:?}"
    );
    // There is none with v in this range, whatever u is.
    let outside = digits(&system("near = 1.2", "between = [-1, 0]"), &[], 10);
    assert!(
        outside[0].contains("outside of an unknown's range"),
        "{outside:?}"
    );
}

/// Numbers that have no finite binary expansion, names of `[let]` and parameters, exact solutions.
#[test]
fn equations_use_all_names() {
    let text = r#"
        [inputs]
        s = { from = 0, to = 10 }
        p = { from = 0, to = 10 }
        [parameters]
        two = 2
        [let]
        sum = "a + b"
        [system]
        unknowns = { a = { near = "s" }, b = { near = 0 } }
        equations = ["sum = s*sqrt(two)/sqrt(2)", "a*b = p"]
        [outputs]
        a = { unit = "m", budget = "4 ulp", why = "a test" }
        d = "a - b"
    "#;
    let third = Rational::from((1, 3));
    // a and b are the roots of x² − s x + p with s = 10/3, p = 1: 3 and 1/3.
    let found = digits(text, &[third * 10, Rational::from(1)], 30);
    assert_eq!(found[0], format!("3.{}", "0".repeat(29)));
    assert_eq!(found[1], format!("2.{}7", "6".repeat(28)));
    let study = Study::parse(text, "system").unwrap();
    assert_eq!(study.outputs()[0].unit, "m");
    // ∂a/∂s = a/(a − b), ∂a/∂p = −1/(a − b) at s = 5, p = 6.
    let conditions = study.conditions(&[5.0, 6.0]).unwrap();
    assert!((conditions[0] - 21.0).abs() < 1e-5, "{conditions:?}");
    assert!(matches!(
        study.reference(&[Rational::from(5), Rational::from(6)], 160),
        ReferenceAnswer::Expected(..)
    ));
    let zero = "[system]\nunknowns = { x = { near = 0.3 }, y = { near = 0.8 } }\n\
                equations = [\"x + y = 1\", \"x*y + x = 0\"]";
    assert_eq!(digits(zero, &[], 10), ["0", "1.000000000"]);
    // Two circles that touch: a double solution stays open.
    let double = "[system]\nunknowns = { x = { near = 0.9 }, y = { near = 0.1 } }\n\
                  equations = [\"x^2 + y^2 = 1\", \"(x - 2)^2 + y^2 = 1\"]";
    assert!(digits(double, &[], 10)[0].starts_with(": no solution is proved near the start"));
}

/// Constants below an equation are computed at the precision of the answer, not at that of the
/// first coarse box.
#[test]
fn constants_keep_their_digits() {
    let text = "[system]\nunknowns = { x = { between = [1, 2] } }\nequations = [\"x^2 = sqrt(2)\"]";
    let found = digits(text, &[], 60);
    // 2^(1/4)
    assert_eq!(found[0][..20], *"1.189207115002721066");
    assert_eq!(found[0].len(), 61);
    let root = "[outputs]\nx = { root_of = \"x^2 - sqrt(2)\", between = [1, 2] }";
    assert_eq!(digits(root, &[], 60), found);
}

#[test]
fn faults_name_their_place() {
    for (text, due) in [
        (
            "[system]\nunknowns = { u = { near = 1 } }\nequations = [\"u = 1\", \"u = 2\"]",
            "line 3, column 13: 2 equations for 1 unknowns",
        ),
        (
            "[system]\nunknowns = { u = 1 }\nequations = [\"u = 1\"]",
            "line 2, column 18: the unknown u needs near = NUMBER or between = [LOW, HIGH]",
        ),
        (
            "[system]\nunknowns = { u = { near = 1 } }\nequations = [\"w = 1\"]",
            "line 3, column 15: the name w is not declared",
        ),
        (
            "[inputs]\nu = { from = 0, to = 1 }\n[system]\nunknowns = { u = { near = 1 } }\nequations = [\"u = 1\"]",
            "the name u is declared twice",
        ),
        (
            "where = \"u < 1\"\n[system]\nunknowns = { u = { near = 1 } }\nequations = [\"u = 1\"]",
            "a condition on the inputs depends on the unknown u",
        ),
        ("[system]\nequations = [\"u = 1\"]", "a system has unknowns"),
    ] {
        let found = fault(text);
        assert!(found.contains(due), "{found}");
    }
}
