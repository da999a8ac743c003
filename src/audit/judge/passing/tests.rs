//! Judgements in doubles against those of bounds with exponents.

use super::*;
use crate::budget::{Budget, NormBudget};
use crate::expected::Expected;
use crate::judge::judge_values;
use crate::method::Output;
use crate::ulp::Format;
use mechaudit_reference::{Ball, Mag};
use proptest::prelude::*;
use rug::Float;

/// A midpoint of `bits` bits with a radius, and a double that is off by some ulps.
#[derive(Clone, Debug)]
struct Drawn {
    ball: Ball,
    got: f64,
}

fn drawn(single: bool) -> impl Strategy<Value = Drawn> {
    let bits = prop_oneof![
        Just(53u32),
        Just(64),
        Just(80),
        Just(128),
        Just(160),
        Just(320)
    ];
    let exponent = match single {
        true => prop_oneof![6 => -20i32..20, 1 => -155i32..130, 1 => -130i32..-110],
        false => prop_oneof![6 => -20i32..20, 2 => -400i32..400, 1 => -1090i32..1030],
    };
    // Of powers of two, and of what lies next to them, in every tenth case.
    let head = prop_oneof![9 => any::<u64>(), 1 => Just(0), 1 => Just(u64::MAX)];
    let number = (bits, exponent, head, any::<[u64; 4]>(), any::<bool>());
    let radius = prop_oneof![1 => Just(None), 6 => (30i64..170).prop_map(Some), 1 => (-5i64..500).prop_map(Some)];
    (number, radius, 1.0..2.0f64, 0u32..9, any::<bool>()).prop_map(
        move |((bits, k, head, rest, minus), radius, r, off, up)| {
            let words = rest
                .iter()
                .enumerate()
                .map(|(i, w)| Float::with_val(64, *w) >> (64 * (i as i32 + 2)));
            let head = Float::with_val(400, head) >> 64;
            let sum = words.fold(1 + head, |sum: Float, w| sum + w);
            let mid = Float::with_val(bits, sum) << k;
            let mid = if minus { -mid } else { mid };
            let round = |x: f64| if single { f64::from(x as f32) } else { x };
            let mut got = round(mid.to_f64());
            for _ in 0..off {
                let step = if single { 1 << 29 } else { 1 };
                let bits = got.to_bits();
                got = f64::from_bits(if up {
                    bits + step
                } else {
                    bits.saturating_sub(step)
                });
            }
            let rad = radius.map_or(Mag::ZERO, |s| Mag::from_f64(r).shift(i64::from(k) - s));
            Drawn {
                ball: Ball::new(mid, rad),
                got,
            }
        },
    )
}

fn bits(x: &Judgement) -> Vec<u64> {
    let each = x
        .components
        .iter()
        .flat_map(|c| [c.ulps, c.of_budget, c.conditioned, c.condition]);
    let all = each.chain([x.normwise, x.norm_of_budget]);
    // NaN is one.
    all.map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() })
        .collect()
}

/// Compares the two judgements of the same answer; returns true if there are two.
fn agree(all: &[Drawn], factor: f64, norm: Option<f64>, format: Format) -> bool {
    let output = |name| Output {
        name,
        unit: "1",
        budget: Budget::new(Limit::Ulps(factor), "planted"),
    };
    let outputs = [output("x"), output("y")];
    let norm = norm.map(|factor| NormBudget::new(factor, "planted"));
    let rules = Rules {
        outputs: &outputs,
        norm: norm.as_ref(),
        format,
    };
    let got: Vec<f64> = all.iter().map(|d| d.got).collect();
    let balls: Vec<Ball> = all.iter().map(|d| d.ball.clone()).collect();
    let expected: Vec<Expected> = balls.iter().cloned().map(Expected::Number).collect();
    let mut quick = 0;
    for values in [Values::Numbers(&balls), Values::Expected(&expected)] {
        let due = judge_values(&rules, &got, values, None);
        let Some(found) = passing(&rules, &got, values) else {
            continue;
        };
        quick += 1;
        assert_eq!(due.verdict, Verdict::Pass, "{all:?}");
        assert!(
            !due.wide && due.kind.is_none() && due.reason.is_none(),
            "{all:?}"
        );
        assert_eq!(bits(&found), bits(&due), "{all:?}");
        let parts = |j: &Judgement| -> Vec<_> {
            j.components
                .iter()
                .map(|c| (c.output, c.verdict, c.kind))
                .collect()
        };
        assert_eq!(parts(&found), parts(&due));
    }
    assert!(quick != 1);
    quick > 0
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn judgements_in_doubles_are_those_of_bounds(
        all in prop::collection::vec(drawn(false), 1..5),
        factor in prop_oneof![4 => 0.5..9.0f64, 1 => 1e-31..1e-29f64, 1 => 1e29..1e31f64],
        norm in prop::option::of(prop_oneof![3 => 1.0..16.0f64, 1 => 1e29..1e31f64]),
    ) {
        agree(&all, factor, norm, Format::Double);
    }

    #[test]
    fn and_of_single_precision(
        all in prop::collection::vec(drawn(true), 1..4),
        factor in 0.5..9.0f64,
        norm in prop::option::of(1.0..16.0f64),
    ) {
        agree(&all, factor, norm, Format::Single);
    }

    /// As a rule there is a judgement in doubles: of numbers whose errors are in the budget.
    #[test]
    fn usual_values_are_judged_in_doubles(bits in any::<[u64; 2]>(), k in -900i32..900) {
        let third: Float = Float::with_val(160, 1) / 3;
        let usual = |w: u64| {
            let mid: Float = (third.clone() + (Float::with_val(64, w) >> 70)) << k;
            let got = mid.to_f64();
            Drawn { ball: Ball::new(mid, Mag::power_of_two(i64::from(k) - 110)), got }
        };
        prop_assert!(agree(&bits.map(usual), 4.0, Some(4.0), Format::Double));
    }
}

/// Numbers so far apart that no double holds both.
#[test]
fn numbers_of_every_size_are_added() {
    for k in [-1000, -201, -200, -199, 0, 199, 200, 201, 900] {
        for radius in [None, Some(-90), Some(-290)] {
            let at = |k: i32| {
                let mid: Float = (Float::with_val(140, 1) / 3) << k;
                let rad = radius.map_or(Mag::ZERO, |r| Mag::power_of_two(i64::from(k) + r));
                Drawn {
                    got: mid.to_f64().next_up(),
                    ball: Ball::new(mid, rad),
                }
            };
            assert!(
                agree(&[at(0), at(k)], 4.0, Some(9.0), Format::Double),
                "{k}"
            );
            assert!(
                agree(&[at(k), at(0), at(-k / 2)], 4.0, Some(9.0), Format::Double),
                "{k}"
            );
        }
    }
}

/// Leaves values over their budget, wide references, other limits and extreme exponents to the
/// exact path.
#[test]
fn the_rest_is_not_judged() {
    let third = Ball::new(Float::with_val(140, 1) / 3, Mag::ZERO);
    let near = third.mid().to_f64();
    let of = |ball: &Ball, got: f64| {
        agree(
            &[Drawn {
                ball: ball.clone(),
                got,
            }],
            4.0,
            None,
            Format::Double,
        )
    };
    assert!(of(&third, near) && of(&-third.clone(), -near));
    assert!(!of(&third, near + 5.0 * 2f64.powi(-54)));
    assert!(of(&third, near + 3.0 * 2f64.powi(-54)));
    for bad in [f64::NAN, f64::INFINITY, -near, 0.0, 5e-324, 2.0 * near] {
        assert!(!of(&third, bad), "{bad}");
    }
    // A radius of an ulp is most of what would be said, a tenth of a tenth of one is not.
    assert!(!of(&third.widened(Mag::power_of_two(-54)), near));
    assert!(of(&third.widened(Mag::power_of_two(-62)), near));
    assert!(!of(&third.widened(Mag::INFINITY), near));
    let zero = Ball::integer(64, 0);
    assert!(!of(&zero, 0.0));
    // Subnormal numbers, and those whose ulps are.
    for (k, due) in [(-1074, false), (-1022, false), (-1000, true)] {
        assert_eq!(
            of(&third.shift(k), near * 2f64.powi(-600) * 2f64.powi(k + 600)),
            due,
            "{k}"
        );
    }
    // A norm over its budget.
    let off = Drawn {
        ball: third,
        got: near + 3.0 * 2f64.powi(-54),
    };
    assert!(!agree(
        std::slice::from_ref(&off),
        4.0,
        Some(1.0),
        Format::Double
    ));
    assert!(agree(&[off], 4.0, Some(9.0), Format::Double));
}

/// Other limits, and none.
#[test]
fn other_limits_are_not_judged() {
    let budget = Budget::new(Limit::Relative(1e-10), "planted");
    let outputs = [Output {
        name: "x",
        unit: "1",
        budget,
    }];
    let rules = Rules {
        outputs: &outputs,
        norm: None,
        format: Format::Double,
    };
    let one = [Ball::exact(64, 1.0)];
    assert!(passing(&rules, &[1.0], Values::Numbers(&one)).is_none());
    assert!(passing(&rules, &[], Values::Numbers(&[])).is_none());
}
