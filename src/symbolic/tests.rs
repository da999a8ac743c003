//! Property tests of the normal forms: ring axioms, differentiation rules, agreement with balls.

use super::*;
use mechaudit_reference::ComplexBall;
use proptest::prelude::*;
use rug::Rational;
use rug::ops::Pow;

fn small() -> impl Strategy<Value = Gauss> {
    (-3_i32..4, 1_i32..4, -2_i32..3).prop_map(|(a, b, c)| Gauss::new((a, b), c))
}

fn poly() -> impl Strategy<Value = Poly> {
    let term = (small(), 0_u32..3, 0_u32..3, 0_u32..2);
    prop::collection::vec(term, 0..4).prop_map(|terms| {
        let x = |n: &str| Poly::symbol(Symbol::new(n).unwrap());
        terms.into_iter().fold(Poly::zero(), |sum, (c, i, j, k)| {
            let m = &(&x("x").pow(i) * &x("y").pow(j)) * &x("z").pow(k);
            &sum + &m.scaled(&c)
        })
    })
}

fn nonzero() -> impl Strategy<Value = Poly> {
    poly().prop_filter("not zero", |p| !p.is_zero())
}

/// Of low degree, because sums of three of them have common denominators of three times that.
fn fraction() -> impl Strategy<Value = Fraction> {
    let linear = || {
        (small(), small(), small()).prop_map(|(a, b, c)| {
            let x = |n: &str, c: &Gauss| Poly::symbol(Symbol::new(n).unwrap()).scaled(c);
            &(&x("x", &a) + &x("y", &b)) + &Poly::constant(c)
        })
    };
    let below = linear().prop_filter("not zero", |p| !p.is_zero());
    (linear(), linear(), below).prop_map(|(a, b, c)| Fraction::new(&a * &b, c).unwrap())
}

/// Text of an expression in x, y, t with a root, exponentials and an integral.
fn text() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_string()),
        Just("y".to_string()),
        Just("t".to_string()),
        Just("i".to_string()),
        Just("sqrt(2*x)".to_string()),
        Just("sqrt(x + y)".to_string()),
        Just("exp(i*t - x)".to_string()),
        Just("cos(2*t)".to_string()),
        Just("W(x*t)".to_string()),
        Just("int(s, 0, t, exp(-i*s^2 + y*s))".to_string()),
        (1_u32..5).prop_map(|n| n.to_string()),
    ];
    leaf.prop_recursive(3, 8, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} + {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} - {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("{a}*{b}")),
            (inner.clone(), 1_u32..3).prop_map(|(a, k)| format!("({a})^{k}")),
            (inner, 1_u32..4).prop_map(|(a, k)| format!("({a})/(x + {k})")),
        ]
    })
}

fn value(exact: &mut Exact, text: &str) -> ExpSum {
    exact
        .value(&Definitions::default(), &parse(text).unwrap())
        .unwrap()
}

fn overlap(a: &ComplexBall, b: &ComplexBall) -> bool {
    a.re.overlaps(&b.re) && a.im.overlaps(&b.im)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn polynomials_are_a_ring(a in poly(), b in poly(), c in poly()) {
        prop_assert_eq!(&a + &b, &b + &a);
        prop_assert_eq!(&a * &b, &b * &a);
        prop_assert_eq!(&(&a + &b) + &c, &a + &(&b + &c));
        prop_assert_eq!(&(&a * &b) * &c, &a * &(&b * &c));
        prop_assert_eq!(&a * &(&b + &c), &(&a * &b) + &(&a * &c));
        prop_assert_eq!(&a - &a, Poly::zero());
        prop_assert_eq!(&a * &Poly::integer(1), a.clone());
        let x = Symbol::new("x").unwrap();
        prop_assert_eq!(Poly::from_coefficients(x, &a.coefficients(x)), a.clone());
        prop_assert_eq!((&a * &b).conj(), &a.conj() * &b.conj());
    }

    #[test]
    fn division_and_common_divisors(a in nonzero(), b in nonzero(), c in nonzero()) {
        let product = &a * &c;
        prop_assert_eq!(product.divided_by(&c), Some(a.clone()));
        let g = gcd(&product, &(&b * &c));
        prop_assert!(g.divided_by(&c).is_some(), "{} does not divide {}", c, g);
        prop_assert!(product.divided_by(&g).is_some());
        prop_assert!((&b * &c).divided_by(&g).is_some());
    }

    #[test]
    fn fractions_are_a_field(a in fraction(), b in fraction(), c in fraction()) {
        prop_assert_eq!(&a + &b, &b + &a);
        prop_assert_eq!(&(&a + &b) + &c, &a + &(&b + &c));
        prop_assert_eq!(&a * &(&b + &c), &(&a * &b) + &(&a * &c));
        prop_assert!((&a - &a).is_zero());
        if let Some(inverse) = a.inverse() {
            prop_assert_eq!(&a * &inverse, Fraction::integer(1));
        }
        // Leibniz and the quotient rule.
        let x = Symbol::new("x").unwrap();
        let leibniz = &(&a.derivative(x) * &b) + &(&a * &b.derivative(x));
        prop_assert_eq!((&a * &b).derivative(x), leibniz);
    }

    #[test]
    fn sums_of_exponentials_are_a_ring(a in text(), b in text(), c in text()) {
        let e = &mut Exact::default();
        let (a, b, c) = (value(e, &a), value(e, &b), value(e, &c));
        let p = |x: &ExpSum, y: &ExpSum| e.algebra.product(x, y);
        prop_assert_eq!(p(&a, &b), p(&b, &a));
        prop_assert_eq!(p(&p(&a, &b), &c), p(&a, &p(&b, &c)));
        prop_assert_eq!(p(&a, &(&b + &c)), &p(&a, &b) + &p(&a, &c));
        prop_assert!((&a - &a).is_zero());
        prop_assert_eq!(e.algebra.reduce(&a), a);
    }

    #[test]
    fn derivations_are_linear_and_obey_leibniz(a in text(), b in text()) {
        let e = &mut Exact::default();
        let (a, b) = (value(e, &a), value(e, &b));
        let s = |n| Symbol::new(n).unwrap();
        let d = Derivation::from([
            (s("t"), ExpSum::integer(1)),
            (s("x"), value(e, "y*exp(i*t)")),
        ]);
        let algebra = &e.algebra;
        let d = |x: &ExpSum| algebra.derive(x, &d).unwrap();
        prop_assert_eq!(d(&(&a + &b)), &d(&a) + &d(&b));
        let product = algebra.product(&a, &b);
        let leibniz = &algebra.product(&d(&a), &b) + &algebra.product(&a, &d(&b));
        prop_assert_eq!(d(&product), algebra.reduce(&leibniz));
    }

    #[test]
    fn normal_forms_agree_with_balls(a in text(), turn in 0_u32..4) {
        let definitions = Definitions::default();
        let point = Point::sample(turn);
        let mut exact = Exact::default();
        let e = parse(&a).unwrap();
        let form = exact.value(&definitions, &e).unwrap();
        let through = enclose_form(&exact.algebra, &form, &point).unwrap();
        let straight = Enclosures::new(&point).value(&definitions, &e).unwrap();
        prop_assert!(overlap(&through, &straight), "{a}: {form}");
        // Integrals are enclosed to forty bits.
        let size = 1.0 + straight.re.magnitude().to_f64() + straight.im.magnitude().to_f64();
        prop_assert!(straight.re.rad().to_f64() / size < 1e-10, "{a}");
    }

    #[test]
    fn derivatives_agree_with_difference_quotients(a in text()) {
        let definitions = Definitions::default();
        let quotient = |h: i32| {
            let value = |k: i32| {
                let t = Rational::from((3, 4)) + Rational::from((k, 1 << h));
                let named = [("t".to_string(), t)].into();
                let point = Point { named, sample: Some(0) };
                let z = Enclosures::new(&point).value(&definitions, &parse(&a).unwrap());
                let z = z.unwrap();
                (z.re.to_f64(), z.im.to_f64())
            };
            let (up, down) = (value(1), value(-1));
            let step = f64::from(1 << h) / 2.0;
            ((up.0 - down.0) * step, (up.1 - down.1) * step)
        };
        let point = Point {
            named: [("t".to_string(), Rational::from((3, 4)))].into(),
            sample: Some(0),
        };
        let d = enclose(&definitions, &parse(&format!("D({a}, t)")).unwrap(), &point).unwrap();
        let near = quotient(12);
        let size = 1.0 + d.re.to_f64().abs() + d.im.to_f64().abs();
        let off = (near.0 - d.re.to_f64()).abs() + (near.1 - d.im.to_f64()).abs();
        // The second-order term is 10^-7 times a third derivative.
        prop_assert!(off / size < 1e-2, "{a}: {near:?} against {d:?}");
    }
}

fn decided(text: &str) -> Identity {
    Identity::of(&Definitions::default(), &parse_equation(text).unwrap())
}

fn are_proved(equations: &[&str]) {
    for text in equations {
        let found = decided(text);
        assert_eq!(found.outcome, Outcome::Proved, "{text}: {found:?}");
    }
}

fn are_not_proved(equations: &[&str]) {
    for text in equations {
        let found = decided(text);
        assert_ne!(found.outcome, Outcome::Proved, "{text}: {found:?}");
    }
}

#[test]
fn identities() {
    are_proved(&[
        "exp(i*pi) = -1",
        "exp(3*i*pi/2 + x) = -i*exp(x)",
        "sin(x)^2 + cos(x)^2 = 1",
        "sqrt(8*x^3*y) = 2*x*sqrt(2)*sqrt(x)*sqrt(y)",
        "1/(a + sqrt(n*eps)) = (a - sqrt(n*eps))/(a^2 - n*eps)",
        "sqrt(-i/2) = (1 - i)/2",
        "D(W(z), z) = -2*z*W(z) + 2*i/sqrt(pi)",
        "W(-z) = 2*exp(-z^2) - W(z)",
        "D(int(s, 0, t, exp(-i*s^2/2)*cos(w*(t - s))), t) \
           = exp(-i*t^2/2) - w*int(s, 0, t, exp(-i*s^2/2)*sin(w*(t - s)))",
        "at(D(exp(a*t), t), t, 0) = a",
        "int(x, a, b, x^2) = (b^3 - a^3)/3",
        "sum(k, 1, 3, k*a[k]) = a_1 + 2*a_2 + 3*a_3",
        "re(exp(i*x)) = cos(x)",
        "im(exp(i*x)) = sin(x)",
        "im(3*x + i*y) = y",
        "int(x, a, b, exp(i*x)) = (exp(i*b) - exp(i*a))/i",
        "int(x, 0, b, 5*exp(c*x)) = 5*(exp(c*b) - 1)/c",
        "int(x, 0, 2, exp(x) + x) = exp(2) + 1",
        "at(t^2 - 3*t + x, t, 2) = x - 2",
        "at(exp(t*y) - t*exp(y), t, 1) = 0",
        "abs(r*exp(i*x)) = r",
        "1/T*int(t, 0, T, cos(2*pi*3*t/T)^2) = 1/2",
        "0.94*50 = 47",
    ]);
}

/// A difference of positive symbols has either sign, so that its root and that of its opposite are
/// no multiples of each other by a constant.
#[test]
fn roots_of_differences_keep_their_branch() {
    are_not_proved(&[
        "sqrt(y - x) = i*sqrt(x - y)",
        "sqrt(y - x) = -i*sqrt(x - y)",
        "sqrt(1 - x)*sqrt(x - 1) = i*(1 - x)",
        "sqrt(i*(x - y)) = (1 + i)/sqrt(2)*sqrt(x - y)",
    ]);
    are_proved(&[
        "sqrt(-x) = i*sqrt(x)",
        "sqrt(2*x - 2*y) = sqrt(2)*sqrt(x - y)",
        "sqrt(4*y - 4*x) = 2*sqrt(y - x)",
        "sqrt(y - x)^2 = y - x",
        "sqrt(-x - y) = i*sqrt(x + y)",
        "sqrt(2*i*(x + y)) = (1 + i)*sqrt(x + y)",
        "1/(sqrt(y - x) + y) = (y - sqrt(y - x))/(y^2 - y + x)",
    ]);
}

/// A variable of an integral and a symbol with a value put in have either sign, and what hides them
/// is not constant.
#[test]
fn bound_variables_have_any_sign() {
    are_not_proved(&[
        "int(s, -1, 1, sqrt(s^2)) = 0",
        "int(s, -1, 1, abs(s)) = 0",
        "int(s, 0, 1, sqrt(s + 1)) = int(s, 1, 2, sqrt(s + 1))",
        "at(sqrt(x^2), x, -1) = -1",
        "at(abs(x), x, -3) = -3",
        "at(sqrt(1 + sqrt(x)), x, 9) = sqrt(1 + sqrt(x))",
        "at(arg(x), x, -1) = 0",
        "re(sqrt(x - y)) = sqrt(x - y)",
        "abs(sqrt(x - y)) = sqrt(x - y)",
    ]);
    are_proved(&[
        "int(s, -1, 1, sqrt(2)*s^2) = 2*sqrt(2)/3",
        "at(sqrt(y)*x, x, -1) = -sqrt(y)",
        "re(sqrt(x + y)*exp(i*t)) = sqrt(x + y)*cos(t)",
        "abs(sqrt(2)*sqrt(x)) = sqrt(2)*sqrt(x)",
        "int(s, 0, t, exp(-s^2*x)) = int(s, 0, t*sqrt(x), exp(-s^2))/sqrt(x)",
    ]);
}

/// An integral without a closed form hides its variable and has any sign, as the last two tell: one
/// of them is true.
#[test]
fn integrals_have_any_sign() {
    are_not_proved(&[
        "int(s, 0, 1, int(u, 0, s, exp(u^2))) = int(s, 1, 2, int(u, 0, s, exp(u^2)))",
        "arg(int(s, 0, 1, exp(i*s^2))) = 0",
        "sqrt(int(s, 0, 2, exp(2*i*s^2 + i*s))^2) = -int(s, 0, 2, exp(2*i*s^2 + i*s))",
        "sqrt(int(s, 0, 2, exp(2*i*s^2 + i*s))^2) = int(s, 0, 2, exp(2*i*s^2 + i*s))",
    ]);
}

/// A path longer than the series reaches is cut, and its parts add up to the whole.
#[test]
fn a_long_path_is_cut() {
    let none = Definitions::default();
    let point = Point::default();
    let value = |text: &str| {
        let e = parse(text).unwrap();
        Enclosures::new(&point).value(&none, &e).unwrap()
    };
    for (integral, closed) in [
        ("int(s, 1, 31, exp(i*s))", "(exp(31*i) - exp(i))/i"),
        (
            "int(s, -3, 40, exp((i - 1/9)*s))",
            "(exp(40*(i - 1/9)) - exp(-3*(i - 1/9)))/(i - 1/9)",
        ),
        (
            "int(s, 0, 1 + 2*i, exp(-s^2) + 2*s*exp(-s^2))",
            "int(s, 0, 1 + 2*i, exp(-s^2)) + 1 - exp(-(1 + 2*i)^2)",
        ),
    ] {
        let (sum, exact) = (value(integral), value(closed));
        assert!(overlap(&sum, &exact), "{integral}: {sum:?} {exact:?}");
        let wide = sum.re.rad().max(sum.im.rad()).to_f64();
        assert!(wide < 1e-12, "{integral}: {wide}");
    }
}

/// The arc tangent of what is real but for an uncertain part encloses that part's share.
#[test]
fn an_arc_tangent_of_what_may_be_complex() {
    let none = Definitions::default();
    let point = Point::default();
    let value = |text: &str| {
        let e = parse(text).unwrap();
        Enclosures::new(&point).value(&none, &e)
    };
    // Im z is 10^-300, far below what the balls tell from zero; the arc tangent at 1 has half of
    // it.
    let near = value("arctan(1 + i*(re(exp(i*pi)) + 1 + 1/10^300))").unwrap();
    let half = Rational::from((1, 2)) / rug::Integer::from(10).pow(300);
    assert!(near.im.contains(&half) && !near.im.is_zero(), "{near:?}");
    let quarter = value("pi/4").unwrap();
    assert!(overlap(&near, &quarter));
    let real = value("arctan(1)").unwrap();
    assert!(real.im.is_zero() && overlap(&real, &quarter));
    // log(3)/2 on the imaginary axis.
    let above = value("arctan(i/2)").unwrap();
    assert!((above.im.to_f64() - 0.549306144334055).abs() < 1e-14 && above.re.contains_zero());
}

/// A root that is an element of the field, but with a branch that depends on the symbols, is no
/// multiple of the others, and no divisor is made of it that may be zero.
#[test]
fn dependent_roots_are_kept_apart() {
    are_not_proved(&[
        "1/(sqrt(x - y) - i*sqrt(y - x)) = 0",
        "1/(sqrt((x - y)^2) - x + y) = 1/(2*(y - x))",
        "sqrt((x - y)^2*(x + 1)) = (x - y)*sqrt(x + 1)",
    ]);
    let sum = "sqrt((x - y)^2) + sqrt((y - x)^2) = 2*abs(x - y)";
    are_proved(&[sum]);
}

#[test]
fn refutations_have_a_witness() {
    for text in [
        "sin(x)^2 - cos(x)^2 = 1",
        "exp(x)*exp(y) = exp(x*y)",
        "sqrt(n*eps) = n*eps",
        "int(x, a, b, exp(i*x)) = (exp(i*b) + exp(i*a))/i",
        "im(exp(i*x)) = -sin(x)",
        "W(-z) = W(z)",
        "int(s, 0, 1, exp(s^2)) = int(s, 0, 1, exp(-s^2))",
        "arctan(im(x + i*y)/re(x + i*y)) = arg(-x - i*y)",
    ] {
        let found = decided(text);
        assert_eq!(found.outcome, Outcome::Refuted, "{text}");
        assert!(found.witness.is_some_and(|w| w.residual != "0"), "{text}");
    }
    let exact = decided("(a + b)^2 = a^2 + b^2");
    assert_eq!(exact.residual.as_deref(), Some("2*a*b"));
}

#[test]
fn what_cannot_be_said_is_undecided_or_an_error() {
    // True for positive x, but no relation between two arc tangents is known.
    let found = decided("arctan(x) + arctan(1/x) = pi/2");
    assert_eq!(found.outcome, Outcome::Undecided);
    assert!(found.error.is_none());
    let zero = Definitions::default();
    let mut e = Exact::default();
    for text in [
        "1/(x - x)",
        "1/(exp(x)*(1 + exp(-x)) - exp(x) - 1)",
        "int(s, 0, 1, exp(s^3))",
        "int(s, 0, 1, 1/(1 + s))",
    ] {
        assert!(e.value(&zero, &parse(text).unwrap()).is_err(), "{text}");
    }
    let mut circle = Definitions::default();
    circle.set("a", parse("b + 1").unwrap());
    circle.set("b", parse("a").unwrap());
    let found = Exact::default().value(&circle, &parse("a").unwrap());
    assert!(matches!(found, Err(SymbolicError::Circular(_))));
}

/// Values put in, and variables bound, whose names are used outside as well.
#[test]
fn bound_names_end_where_they_are_bound() {
    are_proved(&[
        "at(x^2 + x, x, 3) = 12",
        "at(x^2 - x*y, x, y + 1) = y + 1",
        "x + at(x^2, x, 3) + x = 9 + 2*x",
        "x + int(x, 0, 1, 2*x) + x = 1 + 2*x",
        "int(s, 1, 2, exp(t*s)) = (exp(2*t) - exp(t))/t",
        "int(s, 1, 2, exp(t*s + x)) = exp(x)*(exp(2*t) - exp(t))/t",
        "im((1 + 2*i)*x) = 2*x",
        "im((3 - 5*i)*x*y) = -5*x*y",
        "im(7*x) = 0",
        "sqrt(x) - at(z^2, z, 2) = sqrt(x) - 4",
        "at(sqrt(y)*sqrt(x + y)*z, z, 2) = 2*sqrt(y)*sqrt(x + y)",
        "at(W(z) + W(y), z, x) = W(x) + W(y)",
        "at(at(u + x, x, 2), u, exp(i*t) + sqrt(x)*exp(-t)) = exp(i*t) + sqrt(x)*exp(-t) + 2",
        "x + D(x^2, x) + x = 4*x",
    ]);
    // An exponential of an exponential is beyond the algebra.
    let found = decided("at(exp(a*t), t, exp(b)) = exp(a*exp(b))");
    assert_ne!(found.outcome, Outcome::Refuted, "{found:?}");
    // The value has exponentials, so that it is bound from the start.
    let none = Definitions::default();
    let mut exact = Exact::default();
    let mut form = |text: &str| exact.value(&none, &parse(text).unwrap());
    assert_eq!(form("at(t^2, t, exp(b)) + t"), form("exp(2*b) + t"));
    for text in [
        "arg(exp(i*t)*sqrt(x - y))",
        // A denominator may have any sign.
        "arg(x/(y - 1)*exp(i*t))",
        // Only one of the terms of what is bound hides x.
        "at(D(u*x, x), u, exp(i*t) + sqrt(x)*exp(-t))",
    ] {
        let found = form(text);
        assert!(
            matches!(found, Err(SymbolicError::Unsupported(_))),
            "{text}: {found:?}"
        );
    }
}

/// Neither a derivative by a variable that is bound outside of it, nor one or a value put in that
/// would reach into a value bound outside, is taken for one of the free symbol.
#[test]
fn derivatives_by_bound_variables() {
    are_not_proved(&[
        "int(x, 0, 1, D(x^2, x)) = 2*x",
        "sum(k, 1, 3, D(k^2, k)) = 6*k",
        "at(D(x^2, x), x, exp(t)) = 2*x",
        "at(D(x*y, x), y, exp(x)) = (1 + x)*exp(x)",
        "at(D(x*y, x), y, exp(sqrt(x))) = exp(sqrt(x)) + sqrt(x)/2*exp(sqrt(x))",
        "at(at(x*y, x, 3), y, exp(x)) = 3*exp(3)",
    ]);
    for text in [
        "int(x, 0, 1, D(x^2, x)) = 1",
        "sum(k, 1, 3, D(k^2, k)) = 12",
        "at(D(x^2, x), x, exp(t)) = 2*exp(t)",
        "at(D(x*y, x), y, exp(x)) = exp(x)",
        "at(at(x*y, x, 3), y, exp(x)) = 3*exp(x)",
    ] {
        let found = decided(text);
        assert_ne!(found.outcome, Outcome::Refuted, "{text}: {found:?}");
    }
    are_proved(&[
        "at(D(x*y, x), y, exp(t)) = exp(t)",
        "at(at(x*y, x, 3), y, 2*x) = 6*x",
        "at(D(x*y, x), y, 2*x) = 2*x",
        "int(s, 0, 1, D(s*x, x)) = 1/2",
        "int(x, 0, 1, at(D(x^2, x), x, 3)) = 6",
    ]);
}

/// Derivations of definitions, and names that stand for something else outside of what binds them.
#[test]
fn definitions_and_bound_names() {
    let lines = ["x = y^2", "t: v = 3*v", "w = v*y"];
    let definitions = Definitions::read(&lines).unwrap();
    let none = Definitions::default();
    let mut exact = Exact::default();
    for (text, due) in [
        ("D(v^2, t)", "6*v^2"),
        ("D(w*t, t)", "3*v*y*t + v*y"),
        // By the symbol itself, whatever the name stands for, and only inside.
        ("D(x^2, x) - x", "2*x - y^2"),
        ("at(x + 1, x, 3)*x", "4*y^2"),
        ("at(u^2, u, exp(t)) + x", "exp(2*t) + y^2"),
    ] {
        let found = exact.value(&definitions, &parse(text).unwrap()).unwrap();
        let due = exact.value(&none, &parse(due).unwrap()).unwrap();
        assert_eq!(found, due, "{text}");
    }
}

/// Whatever grows without bound ends, undecided.
#[test]
fn work_has_a_limit() {
    let doubling: Vec<String> = (0..38)
        .map(|k| format!("d{k} = d{}*d{}", k + 1, k + 1))
        .chain(["d38 = x + y".to_string(), "t: u = D(u, t)".to_string()])
        .collect();
    let lines: Vec<&str> = doubling.iter().map(String::as_str).collect();
    let definitions = Definitions::read(&lines).unwrap();
    let roots = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].map(|p| format!("sqrt({p})"));
    for text in [
        "d0 = x",
        "D(u, t) = 0",
        "sum(n, 1, 1000000000, n) = 0",
        "(((2^1000)^1000)^1000)^1000 = 1",
        "(x + y + z + 1)^1000 = 1",
        &format!("1/({}) = 0", roots.join(" + ")),
        "1/(1/(sqrt(2*x) + sqrt(x + y + 2*sqrt(x*y))) + (1 - x)) = 0",
    ] {
        let found = Identity::of(&definitions, &parse_equation(text).unwrap());
        assert_ne!(found.outcome, Outcome::Proved, "{text}");
    }
    let sum = decided("sum(n, 1, 1000000000, n) = 0");
    assert_eq!(sum.error, Some(SymbolicError::Work));
}

/// Equations that were proved although they are false, or have no value on one side.
#[test]
fn false_equations_are_not_proved() {
    let lines = ["N = sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2)", "z = r*exp(i*p)"];
    let definitions = Definitions::read(&lines).unwrap();
    for text in [
        // Divisions by a hidden zero.
        "1/(sqrt(3 + 2*sqrt(2)) + 1 + sqrt(2)) = 0",
        "1/(sqrt(x + 2*sqrt(x) + 1) + sqrt(x) + 1) = 0",
        "1/(sqrt(5 + 2*sqrt(6)) + sqrt(2) + sqrt(3)) = 0",
        "exp(1/(sqrt(3 + 2*sqrt(2)) + 1 + sqrt(2))) = 1",
        "x/N = y/N",
        "N/N = 1",
        "1/(sqrt(x + y + 2*sqrt(x*y)) - sqrt(x) - sqrt(y)) = 0",
        "1/(1/(sqrt(2*x) + sqrt(x + y + 2*sqrt(x*y))) + (1 - x)) = 0",
        "at((u^2 - 1)/(u - 1), u, 1 + N) = 2",
        // Arguments beyond their range.
        "arg(exp(7*i)) = 7",
        "arg(exp(5*i*pi/4)) = 5*pi/4",
        "arg(exp(4*i*x)) = 4*x",
        "arg(z^3) = 3*arg(z)",
        "arg(exp(i*sqrt(x - y))) = sqrt(x - y)",
        "arg(r*exp(i*x)) = x",
        // Conjugates of complex values.
        "at(re(x), x, i) = i",
        "at(im(x), x, i) = 0",
        "at(abs(exp(i*x)), x, i) = 1",
        "int(s, 0, i, re(s)) = -1/2",
        "int(s, 0, i, abs(exp(i*s))) = i",
        "int(s, 0, sqrt(x - y), re(s)) = (x - y)/2",
        // Conventions.
        "sum(n, 1, inf, 1/n^2) = 49/36",
        "sum(n, 5, inf, a[n]) = 0",
        "sum(n, 1, n_num, 1) = 3",
        "series(n, a[n])*series(n, b[n]) = series(n, a[n]*b[n])",
        "series(n, x) + 1 = series(n, x + 1)",
        "exp(series(n, x)) = series(n, exp(x))",
        "a[inf] = a_3",
        "at(a[k], k, 1) = a_k",
        "inf - inf = 0",
        "at(x*(1/x), x, 0) = 1",
        "at(D(x*(1/x), x), x, 0) = 0",
    ] {
        let found = Identity::of(&definitions, &parse_equation(text).unwrap());
        assert_ne!(found.outcome, Outcome::Proved, "{text}");
    }
    for text in [
        "D(x, x)/(sqrt(3 + 2*sqrt(2)) + 1 + sqrt(2)) = (sqrt(2) - 1)/2",
        "1/(sqrt(3 + 2*sqrt(2)) + 1 + sqrt(2)) = (sqrt(2) - 1)/2",
        "sqrt(2 + sqrt(3)) = (sqrt(6) + sqrt(2))/2",
        "D(x, x)*arg(exp(7*i)) = 7 - 2*pi",
        "sum(n, 1, inf, 1/n^2) = pi^2/6",
        "int(x, 0, inf, exp(-x)) = 1",
        "cos(pi/3) = 1/2",
    ] {
        let found = Identity::of(&definitions, &parse_equation(text).unwrap());
        assert_eq!(found.outcome, Outcome::Proved, "{text}: {found:?}");
    }
}

/// Constants are neither bound nor defined.
#[test]
fn constants_are_no_variables() {
    for text in [
        "at(exp(2*i*pi), pi, 1) = 1",
        "int(i, 0, 1, i) = 1/2",
        "sum(inf, 1, 2, 1) = 2",
        "D(pi, pi) = 1",
        "series(pi, pi) = 1",
    ] {
        let found = parse_equation(text);
        assert!(
            matches!(found, Err(SymbolicError::Reserved(_))),
            "{text}: {found:?}"
        );
    }
    let found = Definitions::read(&["pi = 3"]);
    assert!(matches!(found, Err(SymbolicError::Reserved(_))));
}

/// A name without a value has none.
#[test]
fn enclosures_need_values() {
    let e = parse("x + 1").unwrap();
    let found = Enclosures::new(&Point::default()).value(&Definitions::default(), &e);
    assert_eq!(found.unwrap_err(), SymbolicError::NoValue("x".into()));
}
