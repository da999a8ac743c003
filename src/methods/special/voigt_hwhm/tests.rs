//! Laws judge planted widths, and apply up to their limits.

use super::*;
use crate::audit::Draw;
use crate::methods::special::faddeeva::regions::seams;

const HOLDS: Option<f64> = Some(0.0);
const BROKEN: Option<f64> = Some(f64::INFINITY);

#[test]
fn plain_numbers_are_far_from_both_ends_of_the_range() {
    for (t, due) in [
        (1e-300, true),
        (0.9e-300, false),
        (0.9e300, true),
        (1e300, false),
        (-1.0, false),
        (f64::NAN, false),
    ] {
        assert_eq!(plain(t), due, "{t:e}");
    }
}

#[test]
fn a_width_that_does_not_scale_breaks_the_law_of_units() {
    let input = [1.0, 2.0];
    assert_eq!(units(|s, g| s + g, &input), HOLDS);
    assert_eq!(units(|s, _| s + 2.0, &input), BROKEN);
    assert_eq!(units(|_, g| 1.0 + g, &input), BROKEN);
    for (input, due) in [
        ([0.0, 1.0], HOLDS),
        ([1.0, 0.0], HOLDS),
        ([0.0, 0.0], None),
        ([1e-301, 1.0], None),
        ([1.0, 1e-301], None),
        ([0.8e300, 0.8e300], None),
        ([3.0, -1.0], None),
        ([-1.0, 3.0], None),
    ] {
        assert_eq!(units(|s, g| s + g, &input), due, "{input:?}");
    }
}

/// For γ alone V(0) = 1/(πγ), and x = γ.
#[test]
fn half_the_height_is_compared_where_all_numbers_are_plain() {
    for (g, applies) in [
        (1e-300, true),
        (0.9e-300, false),
        (1.5e299, true),
        (1.7e299, false),
    ] {
        let law = half(&[0.0, g]);
        assert_eq!(law.is_some(), applies, "{g:e}");
        assert!(law.is_none_or(|r| r < 1.0), "{g:e} {law:?}");
    }
    assert_eq!(half(&[1.0]), None);
}

#[test]
fn a_part_alone_has_its_own_width() {
    let unit = SQRT_2 * LN_2.sqrt();
    let law = |of_s: f64, of_g: f64, input: &[f64]| {
        pure(
            |s, g| match s == 0.0 {
                true => of_g * g,
                false => of_s * unit * s,
            },
            input,
        )
    };
    let input = [1.0, 2.0];
    assert_eq!(law(1.0, 1.0, &input), HOLDS);
    assert_eq!(law(1.0, 1.0 + f64::EPSILON, &input), BROKEN);
    for (off, due) in [(4.0, HOLDS), (10.0, BROKEN)] {
        assert_eq!(law(1.0 + off * U, 1.0, &input), due, "{off}");
        assert_eq!(law(1.0 - off * U, 1.0, &input), due, "-{off}");
    }
    for input in [[0.0, 1.0], [1.0, 0.0]] {
        assert_eq!(law(1.0, 1.0, &input), None);
    }
}

fn shown(answer: ReferenceAnswer) -> String {
    match answer {
        ReferenceAnswer::Expected(dues, _) => dues[0].to_decimal(5).unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_due_at_the_ends_of_the_widths() {
    let method = crate::methods::find("voigt-hwhm").unwrap();
    for (input, due) in [
        ([0.0, 0.0], "0"),
        ([0.0, 2.0], "2.0000"),
        // √(2 ln 2) σ.
        ([1.0, 0.0], "1.1774"),
        ([-1.0, 1.0], "nan"),
        ([1.0, -1.0], "nan"),
    ] {
        let exact = input.map(|x| Rational::from_f64(x).unwrap());
        assert_eq!(shown(method.reference(&exact, 128)), due, "{input:?}");
    }
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for (input, due) in [
        ([inf, 1.0], "inf"),
        ([inf, 0.0], "inf"),
        ([0.0, inf], "inf"),
        ([inf, inf], "inf"),
        ([inf, -1.0], "nan"),
        ([-1.0, inf], "nan"),
        ([-inf, 1.0], "nan"),
        ([nan, inf], "nan"),
        ([inf, nan], "nan"),
    ] {
        assert_eq!(shown(method.reference_not_finite(&input)), due, "{input:?}");
    }
    assert_eq!(method.signs_of_zero(&[0.0, 0.0]), [Some(false)]);
}

#[test]
fn every_seam_is_drawn() {
    let all = regions();
    let region = all.iter().find(|r| r.name == "seams").unwrap();
    let drawn: Vec<f64> = (0..8000)
        .map(|k| (region.sample)(&mut Draw::new(1, "voigt-hwhm", "seams", k)))
        .map(|x| x[1] / x[0] / SQRT_2)
        .collect();
    for expected in seams(&LINES) {
        let near = |p: &&f64| (**p / expected - 1.0).abs() < 1e-6;
        let count = drawn.iter().filter(near).count();
        assert!(count > 30, "{expected}: {count}");
    }
}
