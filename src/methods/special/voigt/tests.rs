//! Describes what is due at the ends of the widths; laws judge planted densities.

use super::*;
use std::cell::Cell;

fn shown(answer: ReferenceAnswer) -> String {
    match answer {
        ReferenceAnswer::Expected(dues, _) => dues[0].to_decimal(5).unwrap(),
        other => panic!("{other:?}"),
    }
}

/// A point mass where both widths are zero; no width is negative.
#[test]
fn what_is_due_at_the_ends_of_the_widths() {
    let method = crate::methods::find("voigt").unwrap();
    for (input, due) in [
        ([0.0, 0.0, 0.0], "inf"),
        ([1.0, 0.0, 0.0], "0"),
        ([0.0, -1.0, 1.0], "nan"),
        ([0.0, 1.0, -1.0], "nan"),
        // 1/(π γ).
        ([0.0, 0.0, 1.0], "0.31831"),
        // 1/(σ √(2π)).
        ([0.0, 1.0, 0.0], "0.39894"),
    ] {
        let exact = input.map(|x| Rational::from_f64(x).unwrap());
        assert_eq!(shown(method.reference(&exact, 128)), due, "{input:?}");
    }
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for (input, due) in [
        ([inf, 1.0, 1.0], "0"),
        ([-inf, 0.0, 0.0], "0"),
        ([0.0, inf, 1.0], "0"),
        ([0.0, 1.0, inf], "0"),
        ([nan, 1.0, 1.0], "nan"),
        ([nan, inf, 1.0], "nan"),
        ([0.0, -inf, 1.0], "nan"),
        ([inf, 1.0, -1.0], "nan"),
        ([0.0, nan, 1.0], "nan"),
        ([0.0, 1.0, nan], "nan"),
    ] {
        assert_eq!(shown(method.reference_not_finite(&input)), due, "{input:?}");
    }
    assert_eq!(method.signs_of_zero(&[inf, 1.0, 1.0]), [Some(false)]);
}
use std::collections::BTreeSet;

#[test]
fn batches_have_all_lengths_from_x_on() {
    let lengths: BTreeSet<usize> = (0..20)
        .map(|k| {
            let length = Cell::new(0);
            let x = 1.0 + f64::from(k) * f64::EPSILON;
            let refused = batch_agrees([x, 1.0, 0.5], |points, _, _, _| {
                length.set(points.len());
                assert_eq!(points[0], x);
                false
            });
            assert_eq!(refused, Some(f64::INFINITY));
            length.get()
        })
        .collect();
    assert_eq!(lengths, (1..=9).collect());
}

#[test]
fn a_batch_that_differs_or_refuses_breaks_the_law() {
    let broken = f64::INFINITY;
    for (by, done, due) in [
        (1.0, true, 0.0),
        (1.0, false, broken),
        (1.0 + f64::EPSILON, true, broken),
    ] {
        let law = batch_agrees([1.5, 1.0, 0.5], |points, s, g, values| {
            for (value, &x) in values.iter_mut().zip(points) {
                *value = voigt(x, s, g) * by;
            }
            done
        });
        assert_eq!(law, Some(due), "{by} {done}");
    }
}

#[test]
fn beside_the_peak_the_profile_may_exceed_it_by_rounding_alone() {
    let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
    let tiny = f64::from_bits(1);
    for (v, top, due) in [
        (0.5, 1.0, holds),
        (1.0 + 12.0 * U, 1.0, holds),
        (1.0 + 14.0 * U, 1.0, broken),
        (3.0, 2.0, broken),
        (6.0 * tiny, 0.0, holds),
        (7.0 * tiny, 0.0, broken),
        (-tiny, 1.0, broken),
        (f64::NAN, 1.0, None),
    ] {
        assert_eq!(peak(v, top), due, "{v:e} {top:e}");
    }
}

#[test]
fn the_law_with_w_holds_up_to_a_million() {
    let law = |x: f64| by_w(&[x, 1.0, 1.0]);
    assert!(law(1.4e6).is_some_and(|r| r < 1.0));
    assert_eq!(law(1.5e6), None);
}

#[test]
fn the_law_with_w_asks_for_widths_of_a_profile() {
    let holds = |s: f64, g: f64| by_w(&[s, s, g]).map(|r| r < 1.0);
    for (s, g, due) in [
        (1e-100, 1e-100, Some(true)),
        (0.9e-100, 1e-100, None),
        (0.9e100, 1e100, Some(true)),
        (1e100, 1e100, None),
        (1.0, 0.0, Some(true)),
        (1.0, -1e-300, None),
        (1.0, f64::NAN, None),
        (-1.0, 1.0, None),
    ] {
        assert_eq!(holds(s, g), due, "{s:e} {g:e}");
    }
}

#[test]
fn a_function_that_is_no_density_breaks_the_laws() {
    let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
    let input = [3.0, 2.0, 1.0];
    assert_eq!(even(|x, s, g| x * x + s + g, &input), holds);
    assert_eq!(even(|x, s, g| x + s + g, &input), broken);
    assert_eq!(units(|x, s, g| 1.0 / (x + s + g), &input), holds);
    assert_eq!(units(|_, _, _| 1.0, &input), broken);
    for one in [0, 1, 2] {
        let of_others = |x: f64, s: f64, g: f64| {
            let mut all = [x, s, g];
            all[one] = 1.0;
            1.0 / all.iter().sum::<f64>()
        };
        assert_eq!(units(of_others, &input), broken, "{one}");
    }
    assert_eq!(units(|_, _, _| 1.0, &input[..2]), None);
}

#[test]
fn units_are_changed_where_nothing_is_subnormal() {
    for (t, applies) in [
        (1e-300, true),
        (0.9e-300, false),
        (0.0, true),
        (-1e-300, true),
        (f64::INFINITY, false),
        (f64::NAN, false),
    ] {
        for place in [0, 1, 2] {
            let mut input = [1.0; 3];
            input[place] = t;
            let law = units(|_, _, _| 1.0, &input);
            assert_eq!(law.is_some(), applies, "{t:e} at {place}");
        }
    }
    for (v, applies) in [
        (1e-300, true),
        (0.9e-300, false),
        (0.0, false),
        (f64::INFINITY, false),
    ] {
        let law = units(|_, _, _| v, &[1.0; 3]);
        assert_eq!(law.is_some(), applies, "{v:e}");
    }
}
