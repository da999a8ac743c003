//! Peaucellier's cell of `examples/peaucellier-cell.toml`: its point D moves on a straight line, by
//! exact algebra.
//!
//! With O at the origin and the crank's pin A, the pins B and C at |OB| = |OC| = b from O and |AB|
//! = |AC| = a from A are `α A ± h i A` with `α = (1 + k/|A|²)/2`, `h² = b²/|A|² − α²` and `k = b² −
//! a²`, and the rhombus has its fourth corner at `D = B + C − A`. The crank's circle through O is
//! `A = r (1 + e^{iφ})`, `t = tan(φ/2)`.

use mechaudit_symbolic::{Definitions, Identity, Outcome, parse_equation};

const FILE: &str = include_str!("../../examples/peaucellier-cell.toml");

fn outcome(equation: &str) -> Outcome {
    let equation = parse_equation(equation).expect("an equation");
    Identity::of(&Definitions::default(), &equation).outcome
}

fn proved(equation: &str) {
    assert_eq!(outcome(equation), Outcome::Proved, "{equation}");
}

#[test]
fn the_line_is_straight() {
    // b, a and r of the file, in millimetres.
    for (body, length) in [
        ("crank", 40),
        ("OB", 100),
        ("OC", 100),
        ("AB", 40),
        ("AC", 40),
        ("BD", 40),
        ("CD", 40),
    ] {
        let (_, rest) = FILE.split_once(&format!("name = \"{body}\"")).expect(body);
        let (_, rest) = rest.split_once("length = \"").expect(body);
        assert!(rest.starts_with(&format!("{length} mm")), "{body}");
    }
    assert!(FILE.contains(r#"Q = ["40 mm", "0 mm"]"#) && FILE.contains(r#"O = ["0 mm", "0 mm"]"#));
    let k = "(100^2 - 40^2)";
    // A point α A + h i A, whatever A, α and h are: its squared distances from O and from A.
    let (bx, by) = ("(q*x - h*y)", "(q*y + h*x)");
    let n = "(x^2 + y^2)";
    proved(&format!("{bx}^2 + {by}^2 = (q^2 + h^2)*{n}"));
    proved(&format!(
        "({bx} - x)^2 + ({by} - y)^2 = ((1 - q)^2 + h^2)*{n}"
    ));
    // With α and h² these are b² and a².
    let q = format!("((1 + {k}/n)/2)");
    let square = format!("(100^2/n - {q}^2)");
    proved(&format!("({q}^2 + {square})*n = 100^2"));
    proved(&format!("((1 - {q})^2 + {square})*n = 40^2"));
    // B + C − A = (2 α − 1) A = (k/|A|²) A.
    proved(&format!("2*{q} - 1 = {k}/n"));
    // On the crank's circle: the abscissa of D is 105 mm less a deviation of zero, at every angle.
    let (c, s) = ("((1 - t^2)/(1 + t^2))", "(2*t/(1 + t^2))");
    let (x, y) = (format!("(40*(1 + {c}))"), format!("(40*{s})"));
    let d = |a: &str, line: &str| format!("{k}*{a}/({x}^2 + {y}^2) - {line} = 0");
    proved(&d(&x, "105"));
    proved(&d(&y, "105*t"));
    // Another line is none.
    assert_eq!(outcome(&d(&x, "104")), Outcome::Refuted);
}
