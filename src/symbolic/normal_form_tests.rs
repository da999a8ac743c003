//! Texts of normal forms, zeros, and divisors that are zero.

use crate::{Definitions, Exact, ExpSum, Fraction, Gauss, Poly, Symbol, gcd, parse};

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).unwrap()
}

fn form(text: &str) -> ExpSum {
    Exact::default()
        .value(&Definitions::default(), &parse(text).unwrap())
        .unwrap()
}

fn fraction(text: &str) -> Fraction {
    form(text).as_fraction().unwrap()
}

fn poly(text: &str) -> Poly {
    let f = fraction(text);
    assert!(f.den().is_one(), "{text}");
    f.num().clone()
}

/// Constants come first, then by the names.
#[test]
fn texts_of_polynomials() {
    for (text, due) in [
        ("x - x", "0"),
        ("0*x", "0"),
        ("-1", "-1"),
        ("y + x", "x+y"),
        ("-x - y", "-x-y"),
        ("3*x^2*y - 1", "-1+3*x^2*y"),
        ("1 - 2*x", "1-2*x"),
        ("(1 + i)*x + i*y", "(1+i)*x+i*y"),
    ] {
        assert_eq!(poly(text).to_string(), due, "{text}");
    }
}

/// A denominator that is more than one power has brackets, and so has a numerator of several terms.
#[test]
fn texts_of_fractions() {
    for (text, due) in [
        ("x/y", "x/y"),
        ("x/y^2", "x/y^2"),
        ("-x/y", "-x/y"),
        ("x/(2*y)", "1/2*x/y"),
        ("x/(y*z)", "x/(y*z)"),
        ("x/(y + 1)", "x/(1+y)"),
        ("x/(y + z)", "x/(y+z)"),
        ("(x + 1)/y", "(1+x)/y"),
        ("(x + 1)/(x*y)", "(1+x)/(x*y)"),
        ("(x + y)/2", "1/2*x+1/2*y"),
        ("x/x", "1"),
    ] {
        let found = fraction(text).to_string();
        assert_eq!(found, due);
        assert_eq!(fraction(&found), fraction(text), "{text}");
    }
}

#[test]
fn texts_of_sums_of_exponentials() {
    for (text, due) in [
        ("exp(x) - exp(x)", "0"),
        ("exp(x)", "exp(x)"),
        ("-exp(x)", "-exp(x)"),
        ("2*y*exp(x)", "2*y*exp(x)"),
        ("(y + 1)*exp(x)", "(1+y)*exp(x)"),
        ("(y + z + 1)*exp(x)", "(1+y+z)*exp(x)"),
        ("(y + 1)/z*exp(x)", "(1+y)/z*exp(x)"),
        ("y + 1 + exp(x)", "1+y + exp(x)"),
        ("1 - exp(x)", "1 -exp(x)"),
        ("1 + exp(x) + exp(y)", "1 + exp(x) + exp(y)"),
        ("1 - exp(x) - 2*exp(y)", "1 -exp(x) -2*exp(y)"),
        ("exp(x/y)/z", "1/z*exp(x/y)"),
    ] {
        let found = form(text).to_string();
        assert_eq!(found, due);
        assert_eq!(form(&found), form(text), "{text}");
    }
}

/// In the exponent, in the coefficient, and in one term of several.
#[test]
fn where_symbols_occur() {
    for (text, due) in [
        ("x", true),
        ("y*exp(x)", true),
        ("x*exp(y)", true),
        ("1 + exp(y) + x*exp(2*y)", true),
        ("1 + exp(x)", true),
        ("1/x", true),
        ("x/x", false),
        ("1 + y*exp(z)", false),
        ("0", false),
    ] {
        assert_eq!(form(text).contains(symbol("x")), due, "{text}");
    }
}

#[test]
fn values_of_constants() {
    let number = |a, b| Some(Gauss::new(a, b));
    assert_eq!(fraction("3 - 2*i").as_constant(), number(3, -2));
    assert_eq!(fraction("(x + 1)*6/(2*x + 2)").as_constant(), number(3, 0));
    assert_eq!(fraction("x - x").as_constant(), number(0, 0));
    for text in ["x", "1/x", "3/x", "1 + 1/x"] {
        assert_eq!(fraction(text).as_constant(), None, "{text}");
    }
}

#[test]
fn nothing_is_divided_by_zero() {
    let (zero, one, x) = (Poly::zero(), Poly::integer(1), Poly::symbol(symbol("x")));
    for above in [&zero, &one, &x] {
        assert_eq!(Fraction::new(above.clone(), zero.clone()), None);
    }
    assert_eq!(Fraction::new(zero.clone(), x), Some(Fraction::zero()));
    assert_eq!(Fraction::zero().inverse(), None);
    assert_eq!(ExpSum::zero().inverse(), None);
}

/// Zero has no terms, whatever it came from.
#[test]
fn zeros_have_no_terms() {
    let p = poly("x + 2*y - i");
    for zero in [
        p.scaled(&Gauss::default()),
        &p * &Poly::zero(),
        &p - &p,
        Poly::constant(Gauss::default()),
    ] {
        assert!(zero.is_zero() && zero == Poly::zero(), "{zero}");
        assert_eq!(zero.terms().count(), 0);
    }
}

#[test]
fn monomials_have_coefficient_one() {
    let m = vec![(symbol("x"), 2), (symbol("y"), 1)];
    assert_eq!(Poly::monomial(&m), poly("x^2*y"));
}

/// Names are printable throughout, not only somewhere.
#[test]
fn names_without_blanks() {
    for bad in ["a b", "a\t", " a", "ab\n", "a\u{7f}", "aω"] {
        assert_eq!(Symbol::new(bad), None, "{bad:?}");
    }
}

/// Of products whose other factors have none in common; the degrees in x and y differ either way.
#[test]
fn common_divisors_are_the_common_factors() {
    for (first, second, common) in [
        ("x + 1", "x - 1", "1"),
        ("x^3*(x + y)", "(x - y)*(x^4 + 1)", "1"),
        ("(x + y)*(x^2 + 1)", "(x^5 + y)*(x + y)^2", "x + y"),
        ("(x^5 + y)*(x + y)^2", "(x + y)*(x^2 + 1)", "x + y"),
        ("3*x*y", "6*y*z", "y"),
        ("2", "x", "1"),
        ("x", "i", "1"),
        ("x*(x + z)*(y^3 + z)", "y*(x + z)*(x^3 + z)", "x + z"),
        (
            "(x*y - 1)*(x + z^2)",
            "(x*y - 1)*(y + z)*(z + 3)",
            "x*y - 1",
        ),
        ("(y + 1)*(x^2 + y)", "(y + 1)*(x^3 + y)", "y + 1"),
        ("0", "2*x + 2", "x + 1"),
    ] {
        let (a, b, due) = (poly(first), poly(second), poly(common));
        for found in [gcd(&a, &b), gcd(&b, &a)] {
            assert!(found.leading().is_one());
            // Equal but for a constant: each divides the other.
            let ratio = found.divided_by(&due).and_then(|q| q.as_constant());
            assert!(
                ratio.is_some_and(|q| !q.is_zero()),
                "{first}, {second}: {found}"
            );
        }
    }
    assert!(gcd(&Poly::zero(), &Poly::zero()).is_zero());
}
