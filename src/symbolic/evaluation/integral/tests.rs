//! Integrals across jumps and singularities, and under one another.

use super::super::tests::value;
use mechaudit_reference::Ball;
use rug::Rational;

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

/// Fifty-three jumps, which are placed one after the other; the sum of the integrals between them by
/// mpmath.
#[test]
fn many_jumps_are_placed() {
    let text = "int(t, 0, 4, (exp(t) - floor(exp(t)))*sin(t + exp(t)))";
    assert_eq!(value(text, (1, 1), 25), "0.1019751191629379748556958");
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

/// Kinks and jumps at random places: integrals of pieces whose antiderivatives are known.
#[test]
fn integrals_of_random_pieces_are_exact() {
    let mut state = 5_u64;
    let mut draw = |most: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        i64::try_from((state >> 33) % most).unwrap()
    };
    for _ in 0..12 {
        // 0 < a/97 < b/97 < 1, and a slope.
        let a = 1 + draw(60);
        let b = a + 1 + draw(90 - a as u64);
        let c = 1 + draw(9);
        let [p, q] = [a, b].map(|x| Rational::from((x, 97)));
        let cubic = |x: &Rational| {
            let square = Rational::from(x * x);
            let sum = Rational::from(&p + &q);
            Rational::from(&square * x) / 3 - sum * square / 2 + Rational::from(&p * &q) * x
        };
        let [zero, one] = [0, 1].map(Rational::from);
        let of = |from: &Rational, to: &Rational| cubic(to) - cubic(from);
        let product = of(&zero, &p) - of(&p, &q) + of(&q, &one);
        // ∫ max(x, p) = p² + (1 − p²)/2, and ∫ floor(c x + p) is the sum of the lengths above k.
        let largest = Rational::from(&p * &p) / 2 + Rational::from((1, 2));
        let steps = (1..=c + 1).map(|k| {
            let at = Rational::from(k) - &p;
            (one.clone() - at / c).max(zero.clone())
        });
        let floor = steps.fold(zero.clone(), |sum, length| sum + length);
        let choice = Rational::from(&q * &q) / 2 - (one.clone() - &q);
        for (text, due) in [
            (
                format!("int(t, 0, 1, abs((t - {a}/97)*(t - {b}/97)))"),
                product,
            ),
            (format!("int(t, 0, 1, max(t, {a}/97))"), largest),
            (format!("int(t, 0, 1, floor({c}*t + {a}/97))"), floor),
            (format!("int(t, 0, 1, if(97*t < {b}, t, -1))"), choice),
        ] {
            let found = value(&text, (1, 1), 25);
            let due = if due == 0 {
                "0".into()
            } else {
                Ball::rational(200, &due).to_decimal(25).unwrap()
            };
            assert_eq!(found, due, "{text}");
        }
    }
}

/// Values by hand and by Arb.
#[test]
fn integrals_across_many_choices() {
    for (text, due) in [
        (
            "int(t, 0, 2, abs(abs(t - 1) - 1/3))",
            "0.5555555555555555555555556",
        ),
        (
            "int(t, 0, pi, max(sin(t), cos(t)))",
            "2.414213562373095048801689",
        ),
        (
            "int(t, 1, 4, abs(t - 2)*floor(t))",
            "6.000000000000000000000000",
        ),
        (
            "int(t, 0, 1, abs(t^2 - 1/2)*sqrt(t))",
            "0.1788965933338516317557143",
        ),
        (
            "im(int(t, -1, 1, i*(-1 + i*t)^(-1/2)))",
            "0.3947364538712398641592048",
        ),
        (
            "im(int(t, 0, 40, tgamma(1 + i*t)))",
            "-0.1544796413200427446901885",
        ),
        (
            "re(int(t, 1/10, 2, log(-1 + i*t)/(t + i)))",
            "2.880943673394016361306927",
        ),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

/// Functions that have a limit from above on a cut along the real axis, where they are not real: the
/// interval of integration ends at their branch point. Antiderivatives by hand.
#[test]
fn integrals_from_branch_points() {
    for (text, due) in [
        ("int(t, 0, 1, sqrt(t))", "0.6666666666666666666666667"),
        ("int(t, 0, 4, sqrt(t)/2 + t)", "10.66666666666666666666667"),
        ("int(t, 1, 2, sqrt(t - 1))", "0.6666666666666666666666667"),
        ("int(t, 0, 1, t^1.5)", "0.4000000000000000000000000"),
        ("int(t, 0, 1, sqrt(1 - t))", "0.6666666666666666666666667"),
        ("int(t, 0, 1, atan(sqrt(t)))", "0.5707963267948966192313217"),
        ("int(t, 1, 2, acosh(t))", "0.9018649862807561237226464"),
        ("int(t, -1, 1, 1/cbrt(t)^2)", "6.000000000000000000000000"),
        (
            "int(t, 0, 1, 1/cbrt(t - 3/7)^2)",
            "4.751321923486191727116126",
        ),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

/// Parts of complex functions continue by their mirror images: antiderivatives by hand, and `Si(1)`,
/// `γ − Ci(1)` and `2 Si(1/2)` by Arb for those of `(e^{it} − 1)/it`.
#[test]
fn integrals_of_parts_of_complex_functions() {
    for (text, due) in [
        ("int(t, 0, 1, re(exp(i*t)))", "0.8414709848078965066525023"),
        (
            "int(t, 1, 2, im((1 + i)*t + conj(t + i)))",
            "0.5000000000000000000000000",
        ),
        (
            "int(t, 0, 2, abs(3/5*t + 4/5*i*t + 3 + 4*i))",
            "12.00000000000000000000000",
        ),
        ("int(t, 0, 1, arg(1 + i*t))", "0.4388245731174756549070448"),
        (
            "int(t, 0, 1, re(int(s, 0, 1, exp(i*s*t))))",
            "0.9460830703671830149413533",
        ),
        (
            "int(t, 0, 1, im(int(s, 0, 1, exp(i*s*t))))",
            "0.2398117420005647259438659",
        ),
        (
            "int(t, 0, 1, abs(int(s, 0, 1, exp(i*s*t))))",
            "0.9862148360861333783232534",
        ),
        ("int(t, 0, 2, im(W(t)))", "0.8984010550552933409248050"),
        ("int(t, 0, 2, im(W(t + i)))", "0.3464497052904477943784570"),
    ] {
        assert_eq!(value(text, (1, 1), 25), due, "{text}");
    }
}

/// A part without values that is never chosen, but may be on a wide interval, does not make an
/// integral undefined.
#[test]
fn a_part_that_is_never_chosen_need_not_be_defined() {
    let text = "int(t, -1, 1, if(-2 < t*(t - 2), cbrt(t), log(-1 - t^2)))";
    let found = value(text, (1, 1), 10);
    assert!(found.starts_with("undecided"), "{found}");
}
