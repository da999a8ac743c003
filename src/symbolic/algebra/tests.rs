//! Roots, their derivatives, conjugates and exponents of half turns, by what defines them.

use super::*;

fn symbol(name: &str) -> Symbol {
    Symbol::new(name).unwrap()
}

fn number(c: Gauss) -> Fraction {
    Fraction::constant(c)
}

fn of(p: &Poly) -> Fraction {
    Fraction::from(p.clone())
}

/// Returns true if `√f` squared is f, in an algebra of its own.
fn squares(f: &Fraction) -> bool {
    let mut algebra = Algebra::new();
    let root = algebra.sqrt(f).unwrap_or_else(|e| panic!("{f}: {e}"));
    algebra.reduce_fraction(&(&root * &root)) == *f
}

#[test]
fn roots_squared_are_their_radicands() {
    let (x, y) = (Poly::symbol(symbol("x")), Poly::symbol(symbol("y")));
    let i = Gauss::i();
    let difference = &x + &-&y;
    for f in [
        x.clone(),
        x.pow(3),
        &x * &y,
        (&x + &Poly::integer(3)).scaled(&Gauss::real(12)),
        difference.clone(),
        -&difference,
        difference.scaled(&Gauss::real(-18)),
        difference.scaled(&(&i * &Gauss::real(2))),
        Poly::integer(0),
    ] {
        assert!(squares(&of(&f)), "{f}");
    }
    let ratio = &of(&x) * &of(&y.pow(3)).inverse().unwrap();
    assert!(squares(&ratio));
    // √(xy) = √x √y.
    let mut algebra = Algebra::new();
    let [both, first, second] = [&x * &y, x, y].map(|p| algebra.sqrt(&of(&p)).unwrap());
    assert_eq!(algebra.reduce_fraction(&(&first * &second)), both);
}

#[test]
fn roots_of_numbers() {
    for (a, b) in [
        (1, 2),
        (2, 3),
        (-1, 2),
        (-3, 1),
        (12, 1),
        (-8, 27),
        (3, 50),
        (5, 7),
    ] {
        assert!(squares(&number(Gauss::real((a, b)))), "{a}/{b}");
    }
    // Two prime factors beyond those that are tried, once and twice.
    let (p, q) = (10_007i64, 10_009i64);
    assert!(squares(&Fraction::integer(3 * p * p)));
    for n in [p, 2 * p, p * q] {
        assert!(Algebra::new().sqrt(&Fraction::integer(n)).is_err(), "{n}");
    }
    // (2 + i)² times r.
    for r in [2, 3, 5, 6, 7, 10, 11, 13, 14, 15] {
        assert!(squares(&number(Gauss::new(3 * r, 4 * r))), "{r}");
    }
    assert!(squares(&number(Gauss::new(1, 1))));
}

/// A root of what may be negative is real where it is positive: no unit comes out of `√(y − x)`.
#[test]
fn no_unit_comes_out_of_a_difference() {
    let (x, y) = (Poly::symbol(symbol("x")), Poly::symbol(symbol("y")));
    for f in [&x + &-&y, &y + &-&x] {
        let root = Algebra::new().sqrt(&of(&f)).unwrap();
        assert!(root.num().terms().all(|(_, c)| c.im.is_zero()), "{root}");
    }
    // Of what is negative everywhere it does.
    let root = Algebra::new().sqrt(&of(&-&x)).unwrap();
    assert!(root.num().terms().all(|(_, c)| c.re.is_zero()), "{root}");
}

#[test]
fn derivatives_of_roots_quotients_and_integrals() {
    let x = symbol("x");
    let along: Derivation = [(x, ExpSum::integer(1))].into();
    let mut algebra = Algebra::new();
    let fx = Fraction::symbol(x);
    let root = algebra.sqrt(&fx).unwrap();
    // 2 √x d√x = 1
    let d = algebra.derive(&root.clone().into(), &along).unwrap();
    let twice = ExpSum::from(&root * &Fraction::integer(2));
    assert_eq!(algebra.product(&twice, &d), ExpSum::integer(1));
    // x² d(1/x) = −1
    let d = algebra
        .derive(&fx.inverse().unwrap().into(), &along)
        .unwrap();
    assert_eq!(
        algebra.product(&(&fx * &fx).into(), &d),
        ExpSum::integer(-1)
    );
    // dG(x) = e^{x²} dx
    let g = algebra.antiderivative(&fx).unwrap();
    let d = algebra.derive(&g.clone().into(), &along).unwrap();
    assert_eq!(d, algebra.exp(&(&fx * &fx).into()).unwrap());
    assert!(algebra.conj(&g.clone().into()).is_err());
    assert!(algebra.conj(&root.clone().into()).is_ok());
    let text = algebra.text(&ExpSum::from(&g * &root));
    assert!(text.contains("G(x)") && text.contains("sqrt(x)"), "{text}");
}

/// G is odd, on every ray.
#[test]
fn the_antiderivative_is_odd() {
    let mut algebra = Algebra::new();
    assert!(algebra.antiderivative(&Fraction::zero()).unwrap().is_zero());
    for c in [
        Gauss::real(1),
        Gauss::new(0, (1, 2)),
        Gauss::new(0, 3),
        Gauss::new(-1, 2),
    ] {
        let z = &Fraction::symbol(symbol("x")) * &number(c);
        let (g, minus) = (
            algebra.antiderivative(&z).unwrap(),
            algebra.antiderivative(&-&z).unwrap(),
        );
        assert_eq!(minus, -&g);
        assert!(!g.is_zero());
    }
}

/// `e^{iπ/2} = i` and nothing else comes out of an exponent.
#[test]
fn half_turns_are_units() {
    let mut algebra = Algebra::new();
    let pi = Fraction::symbol(symbol("pi"));
    let mut e = |c: Gauss| algebra.exp(&(&pi * &number(c)).into()).unwrap();
    assert_eq!(e(Gauss::new(0, (1, 2))), ExpSum::constant(Gauss::i()));
    assert_eq!(e(Gauss::new(0, 1)), ExpSum::integer(-1));
    let both = e(Gauss::new(1, (1, 2)));
    assert!(both.as_fraction().is_none());
    assert_ne!(both, ExpSum::constant(Gauss::i()));
    // A root of unity that is no number of square roots stays an exponential.
    let seventh = e(Gauss::new(0, (2, 7)));
    assert!(seventh.as_fraction().is_none());
    let mut power = seventh.clone();
    for _ in 1..7 {
        power = algebra.product(&power, &seventh);
    }
    assert_eq!(power, ExpSum::integer(1));
}

/// Nothing is adjoined for what has a rational root.
#[test]
fn rational_roots_adjoin_nothing() {
    let mut algebra = Algebra::new();
    for c in [Gauss::default(), Gauss::real((9, 4)), Gauss::new(3, 4)] {
        let root = algebra.sqrt(&number(c.clone())).unwrap();
        assert_eq!(&root * &root, number(c));
    }
    assert!(algebra.roots().is_empty());
}
