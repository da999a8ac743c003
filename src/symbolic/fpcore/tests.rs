//! Tests of the reader of FPCore.

use super::*;

fn one(text: &str) -> Result<Core, CoreError> {
    let mut cores = parse_cores(text)?;
    cores.remove(0)
}

#[test]
fn cores_are_read() {
    let core = one(
        "; a comment\n(FPCore cancel (x (! :precision binary32 y))\n :name \"Cancellation\"\n \
                    :pre (< 0 x y 1e3) :spec (- x y)\n (let* ((a (+ x 1)) (b (* a y))) (- a b E)))",
    )
    .unwrap();
    assert_eq!(core.title(), "cancel");
    assert_eq!(core.arguments, ["x", "y"]);
    assert_eq!((core.line, core.name.as_deref()), (2, Some("Cancellation")));
    assert_eq!(
        core.pre.unwrap().0.to_string(),
        "(0 < x) and (x < y) and (y < 1e3)"
    );
    assert_eq!(core.spec.unwrap().to_string(), "x - y");
    assert_eq!(core.body.to_string(), "let(a, x + 1, b, a*y, a - b - E)");
}

#[test]
fn operators_and_loops() {
    for (text, due) in [
        ("(FPCore (x) (- x))", "-x"),
        ("(FPCore (x) (pow x 1/3))", "pow(x, 1/3)"),
        (
            "(FPCore (x) (if (and (> x 0) (not (== x 1))) (log x) NAN))",
            "if((x > 0) and (not (x == 1)), log(x), 0/0)",
        ),
        (
            "(FPCore (n) (while (<= i n) ([s 0 (+ s i)] [i 1 (+ i 1)]) s))",
            "while_all(i <= n, s, 0, s + i, i, 1, i + 1, s)",
        ),
        (
            "(FPCore (x) (! :precision binary64 (fma x (digits 5 -1 10) -2.5)))",
            "fma(x, 1/2, -2.5)",
        ),
        ("(FPCore (E) (* E PI))", "E*PI"),
        ("(FPCore (x) (!= x 1 2))", ""),
    ] {
        let core = one(text);
        if due.is_empty() {
            assert!(matches!(core.unwrap().body, Expr::And(parts) if parts.len() == 3));
            continue;
        }
        assert_eq!(core.unwrap().body.to_string(), due, "{text}");
    }
}

/// The precision that a body asks for is not replaced by binary64 unseen.
#[test]
fn other_roundings_are_seen() {
    for (text, due) in [
        ("(FPCore (x) (! :precision binary32 (/ x 3)))", "binary32"),
        ("(FPCore (x) (+ 1 (! :precision binary64 (/ x 3))))", ""),
        (
            "(FPCore (x) :precision binary32 (! :precision binary32 x))",
            "",
        ),
        ("(FPCore (x) :precision binary80 x)", "binary80"),
        ("(FPCore ((! :precision integer n)) n)", "integer"),
        ("(FPCore (x) :round toZero x)", "toZero"),
        ("(FPCore (x) :round nearestEven x)", ""),
    ] {
        let found = one(text).unwrap().other_rounding;
        assert_eq!(found.as_deref().unwrap_or_default(), due, "{text}");
    }
}

#[test]
fn faults_have_their_place() {
    for (text, due) in [
        (
            "(FPCore (x) (+ x\n  y))",
            "line 2, column 3: the name y is not bound",
        ),
        (
            "(FPCore (x) (sin x x))",
            "line 1, column 13: sin takes 1 argument, not 2",
        ),
        (
            "(FPCore (x) (foo x))",
            "line 1, column 14: there is no operator foo",
        ),
        (
            "(FPCore (x) (tensor ([i 3]) x))",
            "line 1, column 13: tensor is for tensors, and only real scalars are read",
        ),
        (
            "(FPCore (x) x",
            "line 1, column 1: a bracket that is not closed",
        ),
        (
            "(FPCore (x) 1e999999)",
            "line 1, column 13: 1e999999 is no number, or too long for one",
        ),
        (
            "(FPCore (x x) x)",
            "line 1, column 12: the argument x is named twice",
        ),
        (
            "(FPCore (x inf) x)",
            "line 1, column 12: inf is infinity, and no name",
        ),
        (
            "(FPCore (x) (let ((a 1) (b a)) b))",
            "line 1, column 28: the name a is not bound",
        ),
    ] {
        assert_eq!(one(text).unwrap_err().to_string(), due, "{text}");
    }
    assert!(one(&"(".repeat(100_000)).is_err());
}
