use super::super::growth::Side::{Lower, Upper};
use super::*;

const BITS: u32 = 300;

/// A formula in both arithmetics.
type Case = (&'static str, fn(&Germ) -> Option<Germ>, fn(&Ball) -> Ball);

fn int(n: i64) -> Ball {
    Ball::integer(BITS, n)
}

fn number(n: i64) -> Germ {
    Germ::constant(&Ball::integer(64, n), 2)
}

fn sin(x: &Ball) -> Ball {
    x.sin_cos().0
}

fn cos(x: &Ball) -> Ball {
    x.sin_cos().1
}

/// Checks the bounds of a formula next to an end, at distances from the greatest to tiny ones.
fn check((name, germ, value): &Case, end: &End, k: u32, due: [f64; 3]) {
    let x = Germ::variable(end, k, 128);
    let found = germ(&x).unwrap_or_else(|| panic!("{name} at {end:?}"));
    let bounds = found.bounds().unwrap();
    let upper = bounds.upper.exponents();
    for (found, due) in upper.iter().zip(due) {
        assert!(
            (found - due).abs() < 0.02 * due.abs() + 1e-9,
            "{name}: {upper:?} for {due:?}"
        );
    }
    let last = if upper[2] != 0.0 { k + 3 } else { 90 };
    for j in (k..=last).chain([k]) {
        for part in [1.0, 0.83, 0.61, 0.505] {
            let s = Ball::exact(BITS, part).shift(-(j as i32));
            let at = match end {
                End::Above(a) => a.with_prec(BITS) + &s,
                End::Below(a) => a.with_prec(BITS) - &s,
                End::PlusInfinity => s.recip(),
                End::MinusInfinity => -s.recip(),
            };
            let f = value(&at);
            let t = -Float::with_val(128, s.mid().ln_ref());
            let upper = bounds.upper.at(&t, Upper);
            assert!(
                upper >= f.mignitude(),
                "{name} at {part}·2^−{j}: {upper:?} {f:?}"
            );
            if let Some(lower) = &bounds.lower {
                assert!(
                    lower.at(&t, Lower) <= f.magnitude(),
                    "{name} at {part}·2^−{j}: {lower:?} {f:?}"
                );
            }
            match bounds.sign {
                Sign::Positive => assert!(!f.is_negative(), "{name}"),
                Sign::Negative => assert!(!f.is_positive(), "{name}"),
                Sign::Unknown => {}
            }
        }
    }
}

#[test]
fn formulas_next_to_zero() {
    let end = End::Above(Ball::integer(64, 0));
    let cases: [(Case, [f64; 3]); 26] = [
        (
            ("x^2 - x", |x| x.mul(x)?.sub(x), |x| x.square() - x),
            [1.0, 0.0, 0.0],
        ),
        (("ln x", |x| x.ln(), |x| x.ln()), [0.0, 1.0, 0.0]),
        (
            ("1/sqrt x", |x| x.sqrt()?.recip(), |x| x.sqrt().recip()),
            [-0.5, 0.0, 0.0],
        ),
        (
            (
                "sqrt x ln x",
                |x| x.sqrt()?.mul(&x.ln()?),
                |x| x.sqrt() * x.ln(),
            ),
            [0.5, 1.0, 0.0],
        ),
        (("sin x/x", |x| x.sin()?.div(x), |x| sin(x) / x), [0.0; 3]),
        (
            (
                "(1 - cos x)/x^2",
                |x| number(1).sub(&x.cos()?)?.div(&x.powi(2)?),
                |x| (int(1) - cos(x)) / x.square(),
            ),
            [0.0; 3],
        ),
        (
            ("1/sin x", |x| x.sin()?.recip(), |x| sin(x).recip()),
            [-1.0, 0.0, 0.0],
        ),
        (
            ("ln sin x", |x| x.sin()?.ln(), |x| sin(x).ln()),
            [0.0, 1.0, 0.0],
        ),
        (
            (
                "ln(1+x)/x^(3/2)",
                |x| x.add(&number(1))?.ln()?.div(&x.mul(&x.sqrt()?)?),
                |x| (int(1) + x).ln() / (x * x.sqrt()),
            ),
            [-0.5, 0.0, 0.0],
        ),
        (
            (
                "x/(e^x - 1)",
                |x| x.div(&x.exp()?.sub(&number(1))?),
                |x| x / (x.exp() - int(1)),
            ),
            [0.0; 3],
        ),
        (
            ("x^x", |x| x.mul(&x.ln()?)?.exp(), |x| (x * x.ln()).exp()),
            [0.0; 3],
        ),
        (
            (
                "exp(-1/x)",
                |x| x.recip()?.neg().exp(),
                |x| (-x.recip()).exp(),
            ),
            [0.0, 0.0, 1.0],
        ),
        (
            (
                "exp(-1/x)/x^3",
                |x| x.recip()?.neg().exp()?.div(&x.powi(3)?),
                |x| (-x.recip()).exp() / (x * x.square()),
            ),
            [-3.0, 0.0, 1.0],
        ),
        (
            ("sin(1/x)", |x| x.recip()?.sin(), |x| sin(&x.recip())),
            [0.0; 3],
        ),
        (
            ("sin(sqrt x)", |x| x.sqrt()?.sin(), |x| sin(&x.sqrt())),
            [0.5, 0.0, 0.0],
        ),
        (
            ("ln(x)^2", |x| x.ln()?.powi(2), |x| x.ln().square()),
            [0.0, 2.0, 0.0],
        ),
        (
            ("1/ln x", |x| x.ln()?.recip(), |x| x.ln().recip()),
            [0.0, -1.0, 0.0],
        ),
        (
            (
                "1/(sqrt x + x)",
                |x| x.sqrt()?.add(x)?.recip(),
                |x| (x.sqrt() + x).recip(),
            ),
            [-0.5, 0.0, 0.0],
        ),
        (
            (
                "1/(1 + ln(x)^2)",
                |x| number(1).add(&x.ln()?.powi(2)?)?.recip(),
                |x| (int(1) + x.ln().square()).recip(),
            ),
            [0.0, -2.0, 0.0],
        ),
        (
            (
                "sqrt(-ln x)",
                |x| x.ln()?.neg().sqrt(),
                |x| (-x.ln()).sqrt(),
            ),
            [0.0, 0.5, 0.0],
        ),
        (
            ("ln(-ln x)", |x| x.ln()?.neg().ln(), |x| (-x.ln()).ln()),
            [0.0, 0.25, 0.0],
        ),
        (
            (
                "x^(1/3)",
                |x| x.pow(&(Ball::integer(128, 1) / Ball::integer(128, 3))),
                |x| (x.ln() / int(3)).exp(),
            ),
            [1.0 / 3.0, 0.0, 0.0],
        ),
        (
            ("atan(x)/x", |x| x.atan()?.div(x), |x| x.atan2(&int(1)) / x),
            [0.0; 3],
        ),
        (
            (
                "x^0.1 sin x",
                |x| x.pow(&Ball::exact(64, 0.1))?.mul(&x.sin()?),
                |x| (x.ln() * Ball::exact(64, 0.1)).exp() * sin(x),
            ),
            [1.1, 0.0, 0.0],
        ),
        (
            (
                "x^0.1 - x^1.1",
                |x| {
                    let power = x.pow(&Ball::exact(64, 0.1))?;
                    power.sub(&power.mul(x)?)
                },
                |x| (x.ln() * Ball::exact(64, 0.1)).exp() * (int(1) - x),
            ),
            [0.1, 0.0, 0.0],
        ),
        (
            (
                "atan(1/x)",
                |x| x.recip()?.atan(),
                |x| x.recip().atan2(&int(1)),
            ),
            [0.0; 3],
        ),
    ];
    for (case, due) in &cases {
        for k in [4, 9] {
            check(case, &end, k, *due);
        }
    }
}

#[test]
fn formulas_next_to_other_ends() {
    let one = || Ball::integer(64, 1);
    let below: [(Case, [f64; 3]); 6] = [
        (
            (
                "1 - x^2",
                |x| number(1).sub(&x.mul(x)?),
                |x| int(1) - x.square(),
            ),
            [1.0, 0.0, 0.0],
        ),
        (
            (
                "1/sqrt(1-x^2)",
                |x| number(1).sub(&x.mul(x)?)?.sqrt()?.recip(),
                |x| (int(1) - x.square()).sqrt().recip(),
            ),
            [-0.5, 0.0, 0.0],
        ),
        (
            (
                "ln(x)/(1-x)",
                |x| x.ln()?.div(&number(1).sub(x)?),
                |x| x.ln() / (int(1) - x),
            ),
            [0.0; 3],
        ),
        (
            ("ln(1-x)", |x| number(1).sub(x)?.ln(), |x| (int(1) - x).ln()),
            [0.0, 1.0, 0.0],
        ),
        (
            ("1/ln x", |x| x.ln()?.recip(), |x| x.ln().recip()),
            [-1.0, 0.0, 0.0],
        ),
        (
            (
                "abs(x-1)^2",
                |x| x.sub(&number(1))?.abs()?.powi(2),
                |x| (x - &int(1)).square(),
            ),
            [2.0, 0.0, 0.0],
        ),
    ];
    for (case, due) in &below {
        check(case, &End::Below(one()), 3, *due);
        check(case, &End::Below(one()), 8, *due);
    }
    let far: [(Case, [f64; 3]); 12] = [
        (
            (
                "exp(-x^2)",
                |x| x.mul(x)?.neg().exp(),
                |x| (-x.square()).exp(),
            ),
            [0.0, 0.0, 1.0],
        ),
        (
            (
                "exp(-x^2+x)",
                |x| x.sub(&x.mul(x)?)?.exp(),
                |x| (x - x.square()).exp(),
            ),
            [0.0, 0.0, 0.992],
        ),
        (
            (
                "1/(1+x^2)",
                |x| number(1).add(&x.mul(x)?)?.recip(),
                |x| (int(1) + x.square()).recip(),
            ),
            [2.0, 0.0, 0.0],
        ),
        (
            (
                "1/(x - 1)",
                |x| x.sub(&number(1))?.recip(),
                |x| (x - &int(1)).recip(),
            ),
            [1.0, 0.0, 0.0],
        ),
        (
            (
                "2/(e^x + e^-x)",
                |x| number(2).div(&x.exp()?.add(&x.neg().exp()?)?),
                |x| int(2) / (x.exp() + (-x).exp()),
            ),
            [0.0, 0.0, 1.0],
        ),
        (
            (
                "tanh x",
                |x| {
                    let (a, b) = (x.exp()?, x.neg().exp()?);
                    a.sub(&b)?.div(&a.add(&b)?)
                },
                |x| (x.exp() - (-x).exp()) / (x.exp() + (-x).exp()),
            ),
            [0.0; 3],
        ),
        (
            (
                "x e^-x/(1 + e^-x)",
                |x| {
                    let e = x.neg().exp()?;
                    x.mul(&e)?.div(&number(1).add(&e)?)
                },
                |x| x * (-x).exp() / (int(1) + (-x).exp()),
            ),
            [-1.0, 0.0, 1.0],
        ),
        (
            (
                "ln(x)/x^3",
                |x| x.ln()?.div(&x.powi(3)?),
                |x| x.ln() / (x * x.square()),
            ),
            [3.0, 1.0, 0.0],
        ),
        (
            (
                "ln(1+1/x)",
                |x| number(1).add(&x.recip()?)?.ln(),
                |x| (int(1) + x.recip()).ln(),
            ),
            [1.0, 0.0, 0.0],
        ),
        (
            (
                "sqrt(x^2+1)-x",
                |x| x.mul(x)?.add(&number(1))?.sqrt()?.sub(x),
                |x| (x.square() + int(1)).sqrt() - x,
            ),
            [1.0, 0.0, 0.0],
        ),
        (
            (
                "exp(-sqrt x)",
                |x| x.sqrt()?.neg().exp(),
                |x| (-x.sqrt()).exp(),
            ),
            [0.0, 0.0, 1.0],
        ),
        (
            ("exp(-e^x)", |x| x.exp()?.neg().exp(), |x| (-x.exp()).exp()),
            [0.0, 0.0, 1.0],
        ),
    ];
    for (case, due) in &far {
        check(case, &End::PlusInfinity, 7, *due);
        check(case, &End::PlusInfinity, 9, *due);
    }
    let negative: Case = ("exp(x)/x", |x| x.exp()?.div(x), |x| x.exp() / x);
    check(&negative, &End::MinusInfinity, 3, [1.0, 0.0, 1.0]);
}

/// A function that is undefined somewhere, or not known to be defined, has no bound.
#[test]
fn what_is_not_proved_has_no_bound() {
    let zero = Germ::variable(&End::Above(Ball::integer(64, 0)), 4, 128);
    assert!(zero.neg().ln().is_none() && zero.neg().sqrt().is_none());
    assert!(zero.sub(&zero).unwrap().recip().is_none());
    // A zero that is known by a ball alone.
    let pi = Ball::pi(128);
    let sine = Germ::variable(&End::Below(pi), 4, 128).sin().unwrap();
    assert!(sine.recip().is_none() && sine.ln().is_none());
    // sin(1/x) has zeros, and 1/4 − x one at the end of the range.
    let wild = zero.recip().unwrap().sin().unwrap();
    assert!(wild.recip().is_none() && wild.ln().is_none());
    let quarter = Germ::constant(&Ball::exact(64, 0.25), 2);
    let near = Germ::variable(&End::Above(Ball::integer(64, 0)), 2, 128);
    assert!(quarter.sub(&near).unwrap().recip().is_none());
    assert!(quarter.sub(&zero).unwrap().recip().is_some());
    // e^(e^x) is beyond such bounds.
    let far = Germ::variable(&End::PlusInfinity, 4, 128);
    assert!(far.exp().unwrap().exp().is_none());
    assert!(
        zero.pow(&Ball::integer(64, 0).widened(Mag::from_f64(1.0)))
            .is_none()
    );
    // A choice of two is bounded by both.
    let either = zero.ln().unwrap().either(&zero.recip().unwrap()).unwrap();
    assert_eq!(either.growth().unwrap().exponents()[0], -1.0);
    assert!(!either.is_positive() && !either.is_negative() && either.recip().is_none());
}
