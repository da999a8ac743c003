//! Tests of the reader of formulas.

use super::*;

#[test]
fn text_comes_back() {
    for text in [
        "a + b*c - d/e^2",
        "-(a - b)*c",
        "2*i/sqrt(pi)*int(z, 0, z, exp(z^2))",
        "a/(b*c)",
        "a*(b/c)",
        "a - (b - c)",
        "sum(n, 1, inf, a[n]*cos(n*x))",
        "c*series(n, D[n]*x)",
        "at(D(psi, t), t, 0)^2",
        "x^(-2)*0.94",
        "a + (-b)*c",
        "x^y^2 - (x^y)^2 + x^(-y) + x^5000",
        "if(a < b <= c and not a == 1, 1e-3, 0x1.8p-2)",
        "let(x, 2, y, x + a, x*y) + fma(a, b, c)",
        "while(k < 10, k, 0, k + 1, s, 1, s*k, s)",
        "root(x, 0, 1, cos(x) - x) + atan2(y, x)",
        "gamma(gamma) + e",
    ] {
        let once = parse(text).unwrap();
        assert_eq!(
            parse(&once.to_string()).unwrap(),
            once,
            "{text} gave {once}"
        );
    }
    assert_eq!(parse("a*b/c*d").unwrap().to_string(), "a*b/c*d");
}

/// Every other name is a constant or a fault; a declared name wins.
#[test]
fn declared_names() {
    let read = |text: &str| parse_declared(text, &|name| ["x", "e", "W", "n"].contains(&name));
    assert_eq!(read("e + E").unwrap().to_string(), "e + E");
    assert_eq!(
        read("sum(k, 1, n, k*x)").unwrap(),
        parse("sum(k, 1, n, k*x)").unwrap()
    );
    read("while(k < n, k, 0, k + 1, k)").unwrap();
    for (text, at) in [("x + y", 4), ("sum(k, 1, 3, k) + k", 18), ("D(x, t)", 5)] {
        match read(text) {
            Err(SymbolicError::Unknown { at: place, .. }) => assert_eq!(place, at, "{text}"),
            other => panic!("{text}: {other:?}"),
        }
    }
    for text in [
        "W(x)",
        "while(k < n, j, 0, j + 1, j)",
        "let_all(a, 1, b, a, b)",
        "exp",
    ] {
        assert!(read(text).is_err(), "{text}");
    }
}

#[test]
fn faults_are_named() {
    for (text, reason) in [
        ("", "expected an expression"),
        ("a +", "expected an expression"),
        ("(a", "expected ')'"),
        ("a b", "unexpected 'b'"),
        ("x^", "expected an expression"),
        ("pow(x)", "pow takes 2 arguments, not 1"),
        ("if(x, 1)", "if takes 3 arguments, not 2"),
        ("0x", "expected a decimal number"),
        ("1e99999", "expected a decimal number"),
        ("1.2.3", "expected a decimal number"),
        ("exp", "expected '('"),
        ("int(x, 0, 1)", "expected ','"),
        ("ω", "unexpected 'ω'"),
    ] {
        match parse(text) {
            Err(SymbolicError::Parse { reason: r, .. }) => assert_eq!(r, reason, "{text}"),
            other => panic!("{text}: {other:?}"),
        }
    }
    assert!(parse(&"(".repeat(5000)).is_err());
    // A quotient of quotients is as deep as it is long; dropping it must not need a deep stack.
    assert!(parse(&format!("a{}", "/a".repeat(90))).is_ok());
    assert!(parse(&format!("a{}", "/a".repeat(300_000))).is_err());
    assert!(matches!(
        parse("a_name_that_is_too_long"),
        Err(SymbolicError::Name(_))
    ));
    assert!(parse_equation("a = b = c").is_err() && parse_equation("a").is_err());
}
