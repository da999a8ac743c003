//! Limits, signs of zero, definitions from W, what is proved.

use super::relative::*;
use super::*;
use crate::audit::{Expected, ProvedError};
use crate::methods::special::complex::{C, infinity, number};
use crate::reference::Ball;
use crate::solvers::faddeeva::faddeeva as w;

fn agrees<R: Relative>() {
    for z in [C::new(0.5, 0.7), C::new(-1.2, 0.3), C::new(0.8, -0.6)] {
        let value = (R::VALUE)(z);
        let near = |got: C, due: C, by: f64| {
            let name = R::OUTPUTS[0];
            assert!(
                (got - due).norm() < by * due.norm(),
                "{name} at {z}: {got} {due}"
            );
        };
        near(R::from_w(w, z), value, 1e-13);
        let step = 1e-4;
        let beside = (R::VALUE)(z + step) - (R::VALUE)(z - step);
        near(R::slope(z, value), beside / (2.0 * step), 1e-6);
    }
}

/// An infinity, ±0 or NaN as they are; of a ball its middle.
fn plain(d: Expected) -> String {
    let signed = |size: f64, negative: bool| if negative { -size } else { size };
    let value = match d {
        Expected::Number(ball) => ball.mid().to_f64(),
        Expected::Infinity { negative } => signed(f64::INFINITY, negative),
        Expected::Zero { negative, .. } => signed(0.0, negative),
        Expected::NotANumber => f64::NAN,
    };
    format!("{value:?}")
}

#[test]
fn limits_of_odd_functions() {
    let inf = f64::INFINITY;
    for (x, y, due) in [
        (inf, 0.0, ["3.0", "0.0"]),
        (-inf, 0.0, ["-3.0", "0.0"]),
        (inf, 1.0, ["3.0", "0.0"]),
        (-inf, -1.0, ["-3.0", "0.0"]),
        (0.0, inf, ["0.0", "inf"]),
        (-0.0, -inf, ["0.0", "-inf"]),
        (1.0, inf, ["NaN", "NaN"]),
        (inf, inf, ["NaN", "NaN"]),
        (f64::NAN, 0.0, ["NaN", "0.0"]),
        (0.0, f64::NAN, ["0.0", "NaN"]),
        (f64::NAN, 1.0, ["NaN", "NaN"]),
    ] {
        assert_eq!(odd_limit(3, x, y).map(plain), due, "{x} {y}");
    }
}

#[test]
fn negated_values_have_the_other_sign() {
    let zero = |negative| Expected::Zero {
        ball: Ball::integer(64, 0),
        negative,
    };
    for (value, due) in [
        (number(2), "-2.0"),
        (infinity(1.0), "-inf"),
        (infinity(-1.0), "inf"),
        (zero(false), "-0.0"),
        (zero(true), "0.0"),
        (Expected::NotANumber, "NaN"),
    ] {
        assert_eq!(plain(negated(value)), due);
    }
}

#[test]
fn signs_where_a_component_vanishes() {
    for (x, factor, due) in [
        (0.0, 1.0, Some(false)),
        (-0.0, 1.0, Some(true)),
        (0.0, -1.0, Some(true)),
        (-0.0, -1.0, Some(false)),
        (1.0, 1.0, None),
    ] {
        assert_eq!(on_axis(x, factor), due, "{x} {factor}");
    }
    assert_eq!(odd_signs(-0.0, 0.0), [Some(true), Some(false)]);
}

/// The formula behind a value of erfcx is that of w at `i z`, and the report says so.
#[test]
fn the_branch_of_erfcx_is_that_of_w() {
    for z in [C::new(0.5, 0.7), C::new(3.0, -0.3), C::new(9.0, 2.0)] {
        let at = <Erfcx as Relative>::branch(z).expect("a branch");
        assert!(at.seam.ends_with(" of i z"), "{}", at.seam);
    }
}

/// The search for points next to zero curves starts at the function itself and goes by its slope.
#[test]
fn definitions_from_w_and_slopes() {
    agrees::<FaddeevaDerivative>();
    agrees::<Erf>();
    agrees::<Erfc>();
    agrees::<Erfcx>();
    agrees::<Erfi>();
    agrees::<Dawson>();
}

/// Limits of both components; zeros without their sign, NaN where there are none.
fn limits<R: Relative>(x: f64, y: f64) -> [String; 2] {
    R::limit(x, y).map(|due| match plain(due) {
        zero if zero == "-0.0" => "0.0".into(),
        other => other,
    })
}

const INF: f64 = f64::INFINITY;
const NAN: f64 = f64::NAN;

#[test]
fn limits_of_the_error_functions() {
    let none = ["NaN", "NaN"];
    for (x, y, erf, erfc, erfi) in [
        (INF, 0.0, ["1.0", "0.0"], ["0.0", "0.0"], ["inf", "0.0"]),
        (-INF, 2.0, ["-1.0", "0.0"], ["2.0", "0.0"], none),
        (-INF, 0.0, ["-1.0", "0.0"], ["2.0", "0.0"], ["-inf", "0.0"]),
        (0.0, INF, ["0.0", "inf"], ["1.0", "-inf"], ["0.0", "1.0"]),
        (0.0, -INF, ["0.0", "-inf"], ["1.0", "inf"], ["0.0", "-1.0"]),
        (2.0, INF, none, none, ["0.0", "1.0"]),
        (INF, INF, none, none, none),
        (NAN, 0.0, ["NaN", "0.0"], ["NaN", "0.0"], ["NaN", "0.0"]),
        (0.0, NAN, ["0.0", "NaN"], ["1.0", "NaN"], ["0.0", "NaN"]),
        (NAN, NAN, none, none, none),
    ] {
        assert_eq!(limits::<Erf>(x, y), erf, "erf {x} {y}");
        assert_eq!(limits::<Erfc>(x, y), erfc, "erfc {x} {y}");
        assert_eq!(limits::<Erfi>(x, y), erfi, "erfi {x} {y}");
    }
}

#[test]
fn limits_of_scaled_functions() {
    let (none, zero) = (["NaN", "NaN"], ["0.0", "0.0"]);
    for (x, y, erfcx, dawson, slope) in [
        (INF, 0.0, zero, zero, zero),
        (-INF, 0.0, ["inf", "0.0"], zero, zero),
        (-INF, 1.0, none, zero, zero),
        (0.0, INF, zero, ["0.0", "inf"], zero),
        (0.0, -INF, zero, ["0.0", "-inf"], ["0.0", "inf"]),
        (-0.0, -INF, zero, ["0.0", "-inf"], ["0.0", "inf"]),
        (1.0, -INF, zero, none, none),
        (1.0, INF, zero, none, zero),
        (INF, -INF, zero, none, none),
        (0.0, NAN, none, ["0.0", "NaN"], ["0.0", "NaN"]),
        (NAN, 0.0, ["NaN", "0.0"], ["NaN", "0.0"], none),
        (NAN, 1.0, none, none, none),
        (1.0, NAN, none, none, none),
    ] {
        assert_eq!(limits::<Erfcx>(x, y), erfcx, "erfcx {x} {y}");
        assert_eq!(limits::<Dawson>(x, y), dawson, "dawson {x} {y}");
        assert_eq!(limits::<FaddeevaDerivative>(x, y), slope, "W' {x} {y}");
    }
}

/// F' is positive up to 0.924138873…, where F is largest; far out F is 1/(2z) = (x − iy)/(2|z|²).
#[test]
fn signs_of_zero_of_dawson() {
    let (plus, minus) = (Some(false), Some(true));
    let most = 0.924_138_873_004_591_8f64;
    for (x, y, due) in [
        (0.5, 0.0, [None, plus]),
        (0.5, -0.0, [None, minus]),
        (-0.5, 0.0, [None, plus]),
        (2.0, 0.0, [None, minus]),
        (2.0, -0.0, [None, plus]),
        (-2.0, 0.0, [None, minus]),
        (most - 1e-15, 0.0, [None, plus]),
        (most + 1e-15, 0.0, [None, minus]),
        (0.0, 0.0, [plus, plus]),
        (-0.0, -0.0, [minus, minus]),
        (-0.0, 3.0, [minus, None]),
        (INF, 0.0, [None, minus]),
        (-INF, -0.0, [None, plus]),
        (INF, 1.0, [None, minus]),
        (INF, -1.0, [None, plus]),
        (INF, INF, [None, None]),
        (INF, NAN, [None, None]),
        (NAN, 0.0, [None, None]),
        (1.0, 1.0, [None, None]),
    ] {
        assert_eq!(
            <Dawson as Relative>::signs_of_zero(x, y),
            due,
            "{x:e} {y:e}"
        );
    }
}

#[test]
fn signs_of_zero_of_the_error_functions() {
    let (plus, minus) = (Some(false), Some(true));
    for (x, y, odd, erfc) in [
        (0.0, -0.0, [plus, minus], [None, plus]),
        (-0.0, 2.0, [minus, None], [None, None]),
        (2.0, 0.0, [None, plus], [None, minus]),
    ] {
        assert_eq!(<Erf as Relative>::signs_of_zero(x, y), odd, "{x} {y}");
        assert_eq!(<Erfi as Relative>::signs_of_zero(x, y), odd, "{x} {y}");
        assert_eq!(<Erfc as Relative>::signs_of_zero(x, y), erfc, "{x} {y}");
    }
    // erfcx falls along the real axis and is 1/(√π z) far out.
    for (x, y, due) in [
        (2.0, 0.0, [None, minus]),
        (2.0, -0.0, [None, plus]),
        (INF, 1.0, [plus, minus]),
        (1.0, INF, [plus, minus]),
        (1.0, -INF, [plus, plus]),
    ] {
        assert_eq!(<Erfcx as Relative>::signs_of_zero(x, y), due, "{x} {y}");
    }
}

#[test]
fn functions_of_a_real_argument_have_proved_bounds() {
    for name in ["dawson", "erf", "erfc", "erfcx"] {
        let proved = crate::methods::find(name).unwrap().proved();
        let [bound] = &proved[..] else {
            panic!("{name}: {proved:?}");
        };
        assert_eq!(bound.error, ProvedError::Ulps(0.875), "{name}");
        assert_eq!(bound.inputs, format!("real arguments, by {name}_real"));
        assert_eq!(bound.command, format!("mechaudit prove {name}"));
    }
    let [bound] = &crate::methods::find("faddeeva").unwrap().proved()[..] else {
        panic!("W has one bound");
    };
    assert_eq!(bound.error, ProvedError::Norm(2.5));
    assert_eq!(bound.inputs, "Im z >= 0");
    for name in ["erfi", "faddeeva-derivative", "voigt"] {
        let proved = crate::methods::find(name).unwrap().proved();
        assert!(proved.is_empty(), "{name}");
    }
}

/// The phase of e^{−z²} is known to 1e-30 for |z| up to 1e8: on the diagonal, where its size is 1,
/// laws with it apply up to there.
#[test]
fn laws_with_an_exponential_end_at_a_hundred_million() {
    for (method, name) in [
        ("faddeeva", "reflection"),
        ("erf", "faddeeva"),
        ("erfc", "scaled"),
        ("erfcx", "reflection"),
        ("erfi", "dawson"),
    ] {
        let laws = crate::methods::find(method).unwrap().laws();
        let law = laws.iter().find(|l| l.name == name).unwrap().residual;
        for (x, applies) in [(7.07e7, true), (7.08e7, false)] {
            let found = law(&[x, x]);
            assert_eq!(found.is_some(), applies, "{method} {name} {x:e}");
            assert!(found.is_none_or(|r| r <= 1.0), "{method} {name}: {found:?}");
        }
        for bad in [[NAN, 1.0], [1.0, NAN], [INF, 1.0]] {
            assert_eq!(law(&bad), None, "{method} {name} {bad:?}");
        }
        assert_eq!(law(&[1.0]), None, "{method} {name}");
    }
}

/// On an axis, where W and its relatives are small or near one.
#[test]
fn a_hundred_million_itself_is_not_beyond_it() {
    for (method, name, z) in [
        ("faddeeva", "reflection", [1e8, 0.0]),
        ("erf", "faddeeva", [1e8, 0.0]),
        ("erfcx", "reflection", [0.0, 1e8]),
    ] {
        let laws = crate::methods::find(method).unwrap().laws();
        let law = laws.iter().find(|l| l.name == name).unwrap().residual;
        assert!(law(&z).is_some_and(|r| r <= 1.0), "{method} {name}");
    }
}

/// W(−iy) = 2e^{y²} − …, and the sum with W(iy) is as large.
#[test]
fn the_reflection_of_w_ends_where_sums_may_overflow() {
    let laws = crate::methods::find("faddeeva").unwrap().laws();
    let law = laws
        .iter()
        .find(|l| l.name == "reflection")
        .unwrap()
        .residual;
    for (half, applies) in [(0.45e307f64, true), (0.55e307, false)] {
        let found = law(&[0.0, -half.ln().sqrt()]);
        assert_eq!(found.is_some(), applies, "{half:e}");
    }
}

/// On the left erf is the sum of terms that grow, so the law with W stands on the right alone.
#[test]
fn the_law_of_erf_with_w_stands_on_the_right() {
    let laws = <Erf as Relative>::laws();
    let law = laws.iter().find(|l| l.name == "faddeeva").unwrap().residual;
    assert!(law(&[0.0, 1.0]).is_some() && law(&[-0.0, 1.0]).is_some());
    assert_eq!(law(&[-1e-300, 1.0]), None);
}
