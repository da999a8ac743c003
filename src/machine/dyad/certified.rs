//! Certified values of a four-bar linkage or a slider-crank at a crank angle in degrees.
//!
//! A number of degrees is no rational number of radians: the reference takes the ball of the angle.

use super::values::{Values, at_crank_speed};
use super::{Dyad, Reached, Shape, singular};
use crate::machine::first_bits;
use crate::reference::dyad::{DyadRefusal, four_bar_within, slider_crank_within};
use crate::reference::{Ball, Mag};
use crate::solvers::dyad::Assembly;
use rug::{Complete, Rational};

/// A digit still open at this many times the first precision stays undecided.
const RAISED_AT_MOST: u32 = 16;

/// The proof at a crank angle.
pub enum Proved {
    /// The values of the row with the digits asked for; `None` where they could not be proved.
    Values(Values<Option<String>>),
    /// The position where both assemblies are one, and no derivatives: those have no value there.
    Singular(Values<Option<String>>),
    /// The crank does not reach the angle.
    Unreachable,
}

/// The values at a crank angle with the digits asked for.
///
/// ```
/// use mechaudit_cli::machine::{dyad, Linkage, Source};
/// use mechaudit::solvers::dyad::Assembly;
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/../../examples/slider-crank.toml"
/// )));
/// let Linkage::Dyad(linkage) = Linkage::read(&source)? else { unreachable!() };
/// let degrees = (75, 2).into();
/// let proved = dyad::certified(&linkage, &degrees, Assembly::Positive, 20);
/// let dyad::Proved::Values([Some(slider), ..]) = proved else { unreachable!() };
/// let near = dyad::floating(&linkage, &degrees, Assembly::Positive)?.unwrap()[0];
/// assert!((slider.parse::<f64>()? - near).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certified(dyad: &Dyad, degrees: &Rational, assembly: Assembly, digits: u32) -> Proved {
    match dyad.shape.reached(degrees) {
        None => {}
        Some(Reached::Beyond) => return Proved::Unreachable,
        Some(Reached::Singular) => {
            let found = singular::certified(&dyad.shape, degrees, digits);
            return found.map_or(Proved::Unreachable, Proved::Singular);
        }
    }
    let first = first_bits(digits).max(128);
    let mut proved: Values<Option<String>> = Default::default();
    let mut bits = first;
    while bits <= RAISED_AT_MOST * first && proved.iter().any(Option::is_none) {
        match values(dyad, degrees, assembly, bits) {
            Ok(values) => {
                for (text, x) in proved.iter_mut().zip(&values) {
                    *text = text.take().or_else(|| x.to_decimal(digits as usize));
                }
            }
            Err(DyadRefusal::Unreachable) => return Proved::Unreachable,
            Err(_) => {}
        }
        bits *= 2;
    }
    Proved::Values(proved)
}

/// The values of a row in the order of the columns, enclosed.
fn values(
    dyad: &Dyad,
    degrees: &Rational,
    assembly: Assembly,
    bits: u32,
) -> Result<Values<Ball>, DyadRefusal> {
    let angle = dyad.shape.relative(degrees, bits);
    let left = assembly == Assembly::Positive;
    let mut v = match &dyad.shape {
        Shape::FourBar { exact, .. } => {
            let m = four_bar_within(exact, &angle, left)?;
            let ([p2, f2, s2], [p3, f3, s3]) = (m.coupler, m.rocker);
            let mut v = [p2, p3, f2, f3, s2, s3, m.transmission, m.determinant];
            parallelogram(exact, degrees, left, &mut v);
            v
        }
        Shape::SliderCrank {
            exact, direction, ..
        } => {
            let m = slider_crank_within(exact, &angle, left)?;
            let ([x, x1, x2], [p, p1, p2]) = (m.slider, m.rod);
            let reach = Ball::rational(bits, &exact[1]) * m.transmission.sin_cos().0;
            let reach = if left { reach } else { -reach };
            let mut v = [x, p, x1, p1, x2, p2, m.transmission, reach];
            slider_zeros(dyad, degrees, left, &mut v);
            v[1] = &v[1] + &direction.to_ball(bits);
            v
        }
    };
    if let Some(crank) = &dyad.crank {
        let (w, e) = (crank.omega.to_ball(bits), crank.epsilon.to_ball(bits));
        v = at_crank_speed(v, |f, s| (f * &w, s * w.square() + f * &e));
    }
    let per_radian = &Ball::integer(bits, 180) / &Ball::pi(bits);
    for &i in dyad.shape.angles() {
        v[i] = &v[i] * &per_radian;
    }
    Ok(v)
}

/// A parallelogram, crank and rocker on the same side of the frame: the coupler only shifts.
///
/// Digits of a value that is zero cannot be proved from an enclosure.
fn parallelogram(l: &[Rational; 4], degrees: &Rational, left: bool, v: &mut Values<Ball>) {
    let turns = Rational::from(degrees / 360u32);
    let rest = (&turns - Rational::from(turns.floor_ref())) * 2u32;
    let parallel = !rest.is_integer() && rest.floor_ref().complete() == u32::from(!left);
    if l[0] != l[2] || l[1] != l[3] || !parallel {
        return;
    }
    let zero = || Ball::integer(v[0].prec(), 0);
    // φ2 is a whole number of turns: zero if it may be zero and is less than one.
    let whole = v[0].contains_zero() && v[0].magnitude() < Mag::from_f64(std::f64::consts::TAU);
    let (z0, z2, z4, z5) = (zero(), zero(), zero(), zero());
    if whole {
        v[0] = z0;
    }
    (v[2], v[4], v[5]) = (z2, z4, z5);
}

/// Values of the slider-crank that are exactly zero: with `h = e − a sin ψ` the rod's height,
/// `b sin θ = h`, `b cos θ θ' = −a cos ψ`, `b cos θ θ'' = a sin ψ + h θ'²`, `x' = −a sin ψ − h θ'`.
fn slider_zeros(dyad: &Dyad, degrees: &Rational, ahead: bool, v: &mut Values<Ball>) {
    let Shape::SliderCrank { exact, .. } = &dyad.shape else {
        return;
    };
    let [a, _, e] = exact;
    let (cos, sin) = dyad.shape.rational_cos_sin(degrees);
    let bits = v[0].prec();
    let zero = || Ball::integer(bits, 0);
    if cos.is_some_and(|c| c == 0) {
        v[3] = zero();
    }
    let Some(sin) = sin else { return };
    let in_line = sin.clone() * a == *e;
    if in_line && ahead {
        v[1] = zero();
    }
    if in_line && sin == 0 {
        (v[2], v[5]) = (zero(), zero());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Linkage, Source};

    /// Pins 1.2 m apart where the dyad spans 4 m to 8 m, and 9.8 m.
    #[test]
    fn what_is_too_near_or_too_far_is_beyond_reach() {
        let text = |frame: u32| {
            format!(
                "type = \"four-bar\"\n[geometry]\ncrank = \"3 m\"\ncoupler = \"6 m\"\n\
                 rocker = \"2 m\"\nframe = \"{frame} m\""
            )
        };
        for (frame, degrees) in [(4, 10), (7, 170)] {
            let Linkage::Dyad(dyad) = Linkage::read(&Source::toml(text(frame))).unwrap() else {
                unreachable!("a dyad");
            };
            let proved = |degrees: i32| certified(&dyad, &degrees.into(), Assembly::Positive, 10);
            assert!(matches!(proved(degrees), Proved::Unreachable));
            assert!(matches!(proved(90), Proved::Values(_)));
        }
    }

    /// Only the coupler of a parallelogram shifts; that of a crossed one turns.
    #[test]
    fn parallelograms_are_told_from_crossed_ones() {
        let text = "type = \"four-bar\"\n[geometry]\ncrank = \"1 m\"\ncoupler = \"3 m\"\n\
                    rocker = \"1 m\"\nframe = \"3 m\"";
        let Linkage::Dyad(dyad) = Linkage::read(&Source::toml(text)).unwrap() else {
            unreachable!("a dyad");
        };
        let mut shifted = Vec::new();
        for assembly in [Assembly::Positive, Assembly::Negative] {
            for degrees in [50, 130, 230, 310, 410] {
                let at = Rational::from(degrees);
                let floats = super::super::floating(&dyad, &at, assembly)
                    .unwrap()
                    .unwrap();
                let Proved::Values(proved) = certified(&dyad, &at, assembly, 15) else {
                    panic!("within reach");
                };
                for (k, (text, x)) in proved.iter().zip(floats).enumerate() {
                    let text = text.as_deref().expect("all digits");
                    let near = (text.parse::<f64>().unwrap() - x).abs() < 1e-9 * (1.0 + x.abs());
                    assert!(near, "value {k} at {degrees}: {text} {x}");
                }
                let rate = proved[2].as_deref();
                shifted.push(rate.expect("a rate") == "0");
            }
        }
        let [left, right] = [&shifted[..5], &shifted[5..]];
        assert!(left.iter().zip(right).all(|(l, r)| l != r), "{shifted:?}");
    }

    /// The coupler's angle is a whole number of turns: none where it may be zero and is less than
    /// one, else it stays open.
    #[test]
    fn the_coupler_of_a_parallelogram_has_turned_by_nothing_or_by_turns() {
        let l = [1, 3, 1, 3].map(Rational::from);
        let turn = std::f64::consts::TAU;
        for (angle, radius, due) in [
            (0.0, 1e-20, true),
            (1e-21, 1e-20, true),
            (turn, 1e-15, false),
            (0.0, 7.0, false),
            (2.0, 1e-15, false),
        ] {
            let ball = Ball::exact(128, angle).widened(Mag::from_f64(radius));
            let mut v: Values<Ball> = std::array::from_fn(|_| Ball::exact(128, turn));
            v[0] = ball.clone();
            parallelogram(&l, &50.into(), true, &mut v);
            assert_eq!(v[0].is_zero(), due, "{angle} {radius}");
            assert!(due || v[0].contains_ball(&ball));
            assert!([2, 4, 5].iter().all(|i| v[*i].is_zero()));
            assert!([1, 3, 6, 7].iter().all(|i| !v[*i].is_zero()));
        }
    }
}
