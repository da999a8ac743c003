//! Where verdicts and kinds change.

use super::*;

fn exactly(due: Due) -> ReferenceAnswer {
    ReferenceAnswer::Dues(vec![due], Proof::Exact)
}

fn one(limit: Limit, format: Format, got: f64, due: Due, condition: Option<f64>) -> Judgement {
    let outputs = outputs(limit);
    let rules = Rules {
        outputs: &outputs,
        norm: None,
        format,
    };
    let conditions = condition.map(|c| [c]);
    let conditions = conditions.as_ref().map(|c| c.as_slice());
    let answer = SolverAnswer::Values(vec![got]);
    judge_by(&rules, &answer, &exactly(due), conditions)
}

/// What is wrong where no number is due has its kind in its place, and what is right has none.
#[test]
fn kinds_where_no_number_is_due() {
    let kind = |got: f64, due: Due| {
        let found = one(Limit::Ulps(4.0), Format::Double, got, due, None);
        let c = &found.components[0];
        assert_eq!(c.kind, found.kind);
        assert!(c.ulps.is_nan() && c.conditioned.is_nan() && c.condition.is_nan());
        (c.verdict, c.kind, c.of_budget)
    };
    let infinity = || Due::Infinity { negative: false };
    let wrong = |kind| (Verdict::WrongKind, Some(kind), f64::INFINITY);
    let right = (Verdict::Pass, None, 0.0);
    assert_eq!(kind(f64::INFINITY, infinity()), right);
    assert_eq!(kind(f64::NAN, Due::NotANumber), right);
    assert_eq!(kind(f64::NAN, infinity()), wrong(Kind::Nan));
    assert_eq!(kind(f64::NEG_INFINITY, infinity()), wrong(Kind::Infinity));
    assert_eq!(kind(1.0, infinity()), wrong(Kind::Finite));
    assert_eq!(kind(0.0, Due::NotANumber), wrong(Kind::Finite));
}

/// Of a zero the condition number is infinite, whatever the derivatives are.
#[test]
fn zero_has_no_finite_condition_number() {
    for c in [0.0, 3.0] {
        let zero = Due::Number(Ball::integer(64, 0));
        let found = one(Limit::Absolute(1.0), Format::Double, 0.0, zero, Some(c));
        assert_eq!(found.components[0].condition, f64::INFINITY, "{c}");
        assert_eq!(found.verdict, Verdict::Pass);
    }
    let number = Due::Number(Ball::integer(64, 4));
    let found = one(Limit::Absolute(1.0), Format::Double, 4.0, number, Some(0.0));
    assert_eq!(found.components[0].condition, 0.0);
}

/// A rounding of the smallest f32 is free beside an absolute limit far below it.
#[test]
fn the_smallest_numbers_of_single_precision() {
    let least = 2f64.powi(-149);
    let judged = |got: f64, limit: Limit, format: Format| {
        let due = Due::Number(Ball::exact(64, 1.5 * least));
        one(limit, format, got, due, None).verdict
    };
    for limit in [
        Limit::RelativeOrAbsolute(1e-12, 1e-300),
        Limit::Relative(1e-12),
        Limit::OfNorm(1e-12),
    ] {
        for (got, verdict) in [
            (least, Verdict::Pass),
            (2.0 * least, Verdict::Pass),
            (0.0, Verdict::Over),
            (3.0 * least, Verdict::Over),
        ] {
            assert_eq!(
                judged(got, limit, Format::Single),
                verdict,
                "{limit} {got:e}"
            );
            assert_eq!(judged(got, limit, Format::Double), Verdict::Over);
        }
    }
}

/// A number for an infinity is wrong in kind where the reference certainly rounds to one: from half a unit beyond
/// the largest number on.
#[test]
fn a_number_is_no_infinity_from_the_border_on() {
    for format in [Format::Double, Format::Single] {
        let edge = format.overflow();
        let verdict =
            |due: Ball| one(Limit::Ulps(4.0), format, 1.0, Due::Number(due), None).verdict;
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
            Due::Number(ball),
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
            Due::Number(ball),
            None,
        );
        found.verdict
    };
    assert_eq!(below(901, 900), Verdict::Undecided);
    assert_eq!(below(901, 899), Verdict::WrongKind);
    assert_eq!(below(899, 898), Verdict::Pass);
    // Bounds of 53 bits do not tell a number from one that is larger by 2^-80 of it.
    let judged = |got: f64, mid: Float, limit: f64| {
        let due = Due::Number(Ball::new(mid, Mag::ZERO));
        one(Limit::Absolute(limit), Format::Double, got, due, None).verdict
    };
    let more: Float = Float::with_val(128, 2f64.powi(-80)) + 1;
    assert_eq!(judged(0.0, more.clone(), 1.0), Verdict::Undecided);
    let below = Float::with_val(1200, edge.mid()) - (more << 900u32);
    let infinite = judged(f64::INFINITY, below, 2f64.powi(900));
    assert_eq!(infinite, Verdict::Undecided);
}

/// The norm of an error is a multiple of u of the norm, for subnormal norms of the smallest normal number.
#[test]
fn norms_have_a_least_size() {
    let normwise = |got: f64, due: f64, format: Format| {
        let due = Due::Number(Ball::exact(64, due));
        one(Limit::Absolute(1.0), format, got, due, None).normwise
    };
    let near = |x: f64, due: f64| (x - due).abs() <= 1e-9 * due;
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
