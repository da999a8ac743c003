//! Where verdicts and kinds change.

use super::*;

fn exactly(expected: Expected) -> ReferenceAnswer {
    ReferenceAnswer::Expected(vec![expected], Proof::Exact)
}

fn one(
    limit: Limit,
    format: Format,
    got: f64,
    expected: Expected,
    condition: Option<f64>,
) -> Judgement {
    let outputs = outputs(limit);
    let rules = Rules {
        outputs: &outputs,
        norm: None,
        format,
    };
    let conditions = condition.map(|c| [c]);
    let conditions = conditions.as_ref().map(|c| c.as_slice());
    let answer = SolverAnswer::Values(vec![got]);
    judge_by(&rules, &answer, &exactly(expected), conditions)
}

/// Of a zero the condition number is infinite, whatever the derivatives are.
#[test]
fn zero_has_no_finite_condition_number() {
    for c in [0.0, 3.0] {
        let zero = Expected::Number(Ball::integer(64, 0));
        let found = one(Limit::Absolute(1.0), Format::Double, 0.0, zero, Some(c));
        assert_eq!(found.components[0].condition, f64::INFINITY, "{c}");
        assert_eq!(found.verdict, Verdict::Pass);
    }
    let number = Expected::Number(Ball::integer(64, 4));
    let found = one(Limit::Absolute(1.0), Format::Double, 4.0, number, Some(0.0));
    assert_eq!(found.components[0].condition, 0.0);
}

/// A rounding of the smallest numbers is free under every relative limit, beside an absolute one
/// far below it as well.
#[test]
fn roundings_of_the_smallest_numbers_are_free() {
    for (format, least, absolute) in [
        (Format::Single, 2f64.powi(-149), 1e-300),
        (Format::Double, 5e-324, 5e-324),
    ] {
        for limit in [
            Limit::RelativeOrAbsolute(1e-12, absolute),
            Limit::Relative(1e-12),
            Limit::OfNorm(1e-12),
        ] {
            for (got, verdict) in [
                (1.0, Verdict::Pass),
                (2.0, Verdict::Pass),
                (0.0, Verdict::Over),
                (3.0, Verdict::Over),
            ] {
                let reference = Ball::exact(64, 1.5).shift(least.log2() as i32);
                let judged = |format| {
                    let expected = Expected::Number(reference.clone());
                    one(limit, format, got * least, expected, None).verdict
                };
                assert_eq!(judged(format), verdict, "{limit} {got}");
                assert!(format == Format::Double || judged(Format::Double) == Verdict::Over);
            }
        }
    }
}

/// A number for an infinity is wrong in kind where the reference certainly rounds to one: from half
/// a unit beyond the largest number on.
#[test]
fn a_number_is_no_infinity_from_the_border_on() {
    for format in [Format::Double, Format::Single] {
        let edge = format.overflow();
        let verdict = |expected: Ball| {
            one(
                Limit::Ulps(4.0),
                format,
                1.0,
                Expected::Number(expected),
                None,
            )
            .verdict
        };
        assert_eq!(verdict(edge.clone()), Verdict::WrongKind);
        assert_eq!(verdict(-&edge), Verdict::WrongKind);
        let unit = Mag::power_of_two(100);
        let wide = edge.widened(unit);
        assert_eq!(verdict(wide.clone()), Verdict::Over);
        assert_eq!(verdict(-&wide), Verdict::Over);
        let by = |k: f64| {
            let mid = Float::with_val(1200, edge.mid()) + Float::with_val(64, k);
            Ball::new(mid, Mag::ZERO)
        };
        assert_eq!(verdict(by(-0.5)), Verdict::Over);
        assert_eq!(verdict(by(0.5)), Verdict::WrongKind);
    }
}

/// An error that may be just what is allowed is not certainly over it.
#[test]
fn an_error_that_may_be_allowed_is_undecided() {
    let judged = |mid: f64, radius: f64, got: f64| {
        let ball = Ball::new(Float::with_val(64, mid), Mag::from_f64(radius));
        let found = one(
            Limit::Absolute(1.0),
            Format::Double,
            got,
            Expected::Number(ball),
            None,
        );
        found.verdict
    };
    assert_eq!(judged(3.0, 1.0, 1.0), Verdict::Undecided);
    assert_eq!(judged(3.0, 0.5, 1.0), Verdict::Over);
    assert_eq!(judged(3.0, 0.5, 2.75), Verdict::Pass);
    assert_eq!(judged(3.0, 0.5, 2.0), Verdict::Undecided);
    // An infinity likewise.
    let edge = Format::Double.overflow();
    let below = |k: i64, radius: i64| {
        let mid = Float::with_val(1200, edge.mid()) - Mag::power_of_two(k).to_float();
        let ball = Ball::new(mid, Mag::power_of_two(radius));
        let limit = Limit::Absolute(2f64.powi(900));
        let found = one(
            limit,
            Format::Double,
            f64::INFINITY,
            Expected::Number(ball),
            None,
        );
        found.verdict
    };
    assert_eq!(below(901, 900), Verdict::Undecided);
    assert_eq!(below(901, 899), Verdict::WrongKind);
    assert_eq!(below(899, 898), Verdict::Pass);
    // Bounds of 53 bits do not tell a number from one that is larger by 2^-80 of it.
    let judged = |got: f64, mid: Float, limit: f64| {
        let expected = Expected::Number(Ball::new(mid, Mag::ZERO));
        one(Limit::Absolute(limit), Format::Double, got, expected, None).verdict
    };
    let more: Float = Float::with_val(128, 2f64.powi(-80)) + 1;
    assert_eq!(judged(0.0, more.clone(), 1.0), Verdict::Undecided);
    let below = Float::with_val(1200, edge.mid()) - (more << 900u32);
    let infinite = judged(f64::INFINITY, below, 2f64.powi(900));
    assert_eq!(infinite, Verdict::Undecided);
}

/// The norm of an error is a multiple of u of the norm, for subnormal norms of the smallest normal
/// number.
#[test]
fn norms_have_a_least_size() {
    let normwise = |got: f64, expected: f64, format: Format| {
        let expected = Expected::Number(Ball::exact(64, expected));
        one(Limit::Absolute(1.0), format, got, expected, None).normwise
    };
    let near = |x: f64, expected: f64| (x - expected).abs() <= 1e-9 * expected;
    let tiny = f64::MIN_POSITIVE;
    // A unit of the smallest numbers is two u of the smallest normal one.
    assert!(near(
        normwise(tiny / 2.0 + 5e-324, tiny / 2.0, Format::Double),
        2.0
    ));
    assert!(near(normwise(5e-324, 0.0, Format::Double), 2.0));
    assert!(near(
        normwise(4.0 * tiny, 2.0 * tiny, Format::Double),
        2f64.powi(53)
    ));
    let single = f64::from(f32::MIN_POSITIVE);
    assert!(near(normwise(2f64.powi(-149), 0.0, Format::Single), 2.0));
    assert!(near(
        normwise(2.0 * single, single, Format::Single),
        2f64.powi(24)
    ));
}

/// `1` where the error is `part` of what is left of the reference and a constant: the reference `1
/// − e` for the error `e = part (1 − e + more)`, which is made larger by `by` of it.
fn reference_of(part: &Float, more: f64, by: f64) -> Ball {
    let e = Float::with_val(400, part * (Float::with_val(400, more) + 1))
        / (Float::with_val(400, part) + 1);
    let e = e * (Float::with_val(400, by) + 1);
    Ball::new(1 - e, Mag::ZERO)
}

/// An error larger than the budget by 2^-60 of it is no pass, whatever the limit; within it by
/// 2^-45 it passes.
#[test]
fn a_pass_is_within_the_budget() {
    let mut undecided = 0;
    for k in 1..300 {
        let r = f64::from(k) * 0.0037;
        let c = f64::from(k) * 0.0113;
        let part = |u: i32| Float::with_val(400, r) >> u;
        for (limit, part, more) in [
            (Limit::Relative(r), part(0), 0.0),
            (Limit::RelativeOrAbsolute(r, 1e-9), part(0), 0.0),
            (Limit::Conditioned(r), part(53), c),
            (Limit::Normwise(r), part(53), c),
        ] {
            let judged = |by: f64| {
                let expected = Expected::Number(reference_of(&part, more, by));
                one(limit, Format::Double, 1.0, expected, Some(c)).verdict
            };
            let verdict = judged(2f64.powi(-60));
            assert!(verdict != Verdict::Pass, "{limit} {c}");
            undecided += u32::from(verdict == Verdict::Undecided);
            assert_eq!(judged(-(2f64.powi(-45))), Verdict::Pass, "{limit} {c}");
            assert_eq!(judged(2f64.powi(-45)), Verdict::Over, "{limit} {c}");
        }
    }
    assert!(undecided > 0);
}

/// Under a normwise limit an infinite condition number of one value allows nothing of another:
/// values of 1 and 2 ulps off beside an infinity that is due, and beside a number.
#[test]
fn an_infinite_condition_allows_nothing_elsewhere() {
    let outputs = outputs(Limit::Normwise(4.0));
    let number = |x: f64| Expected::Number(Ball::exact(64, x));
    let judged = |expected: [Expected; 2], got: [f64; 2], conditions: [f64; 2]| {
        let answer = SolverAnswer::Values(got.to_vec());
        let reference = ReferenceAnswer::Expected(expected.to_vec(), Proof::Exact);
        let found = judge(&outputs, &answer, &reference, Some(&conditions));
        (found.verdict, found.components[1].verdict)
    };
    // 4 u of 1 + 1 are 4 ulps of one.
    let (near, far) = (1.0 + 4.0 * f64::EPSILON, 1.0 + 5.0 * f64::EPSILON);
    let infinity = || Expected::Infinity { negative: false };
    for c in [f64::INFINITY, f64::NAN] {
        let beside = |got| judged([infinity(), number(1.0)], [f64::INFINITY, got], [c, 1.0]);
        assert_eq!(beside(near), (Verdict::Pass, Verdict::Pass));
        assert_eq!(beside(far), (Verdict::Over, Verdict::Over));
        assert_eq!(beside(1e300), (Verdict::Over, Verdict::Over));
        // The number's own condition is not known: it cannot be decided.
        let beside = |got| judged([number(1.0), number(1.0)], [1.0, got], [c, 1.0]);
        assert_eq!(beside(near), (Verdict::Undecided, Verdict::Pass));
        assert_eq!(beside(far), (Verdict::Over, Verdict::Over));
    }
}

/// A norm of very many values is bounded from below as one of few: each sum is rounded up.
#[test]
fn a_bound_on_a_norm_of_many_values_is_below() {
    for n in [1u32, 1000, 100_000] {
        let mut squares = Squares::default();
        for _ in 0..n {
            squares.add(Some(Mag::from_f64(1.0)), Mag::ZERO, Mag::ZERO);
        }
        let root = squares.norms(Format::Double).0.to_float();
        let expected = Float::with_val(200, n).sqrt();
        assert!(root < expected, "{n}");
        assert!(root > expected * (1.0 - 2f64.powi(-32)), "{n}");
        assert_eq!(squares.terms, n as usize);
    }
    // Shares that are recorded depend on it.
    for (n, slack) in [(0, -40), (1, -40), (1024, -40), (2048, -39), (8192, -37)] {
        let root = Squares::root_below(Mag::from_f64(4.0), n).to_f64() / 2.0;
        let expected = 1.0 - 2f64.powi(slack);
        assert!((expected..expected + 2f64.powi(-50)).contains(&root), "{n}");
    }
}

/// A share of a normwise budget is that of the largest value with its condition number.
#[test]
fn a_share_is_of_the_largest_value() {
    let share = |expected: [f64; 2], conditions: [f64; 2]| {
        let got = SolverAnswer::Values(vec![expected[0] + 6.0 * f64::EPSILON, expected[1]]);
        let o = outputs(Limit::Normwise(4.0));
        let found = judge(&o, &got, &exact(&expected), Some(&conditions));
        assert_eq!(found.verdict, Verdict::Pass);
        found.share()
    };
    // 12 u of 4 u (4 + 8), (1 + 11), (1 + 2).
    let near = |x: f64, expected: f64| (x - expected).abs() < 1e-12;
    assert!(near(share([1.0, 4.0], [1.0, 8.0]), 0.25));
    assert!(near(share([1.0, 1.0], [11.0, 2.0]), 0.25));
    assert!(near(share([1.0, 0.5], [2.0, 0.25]), 1.0));
}
