//! Certified values of a four-bar linkage or a slider-crank at a crank angle in degrees.
//!
//! The reference takes a rational number of radians, and a number of degrees is none. So it is
//! evaluated at a rational angle within a proven distance of the angle meant, and each value is
//! widened by that distance times a bound on its derivative in between.
//!
//! # The bounds
//! Let `D` be the determinant, `b c sin(φ3 − φ2)` for the four-bar and `b cos θ` for the
//! slider-crank with the rod at the angle θ to the guide. Wherever it is not zero
//!
//! ```text
//! D φ2' = ± a c sin(φ1 − φ3)       D φ3' = ± a b sin(φ1 − φ2)       D θ' = −a cos ψ
//! |(D²)'| ≤ 2 a b c (b + c)        |(D²)'| ≤ 2 a (|e| + a)
//! ```
//!
//! so over a distance ε the determinant stays above `m = √(D² − ε max|(D²)'|)`, and as long as
//! that is positive the assembly is the same. For `f D = N` the derivatives are bounded, one from
//! the other, by
//!
//! ```text
//! |f| ≤ |N|/m     |f'| ≤ (|N'| + |f||D'|)/m     |f''| ≤ (|N''| + 2|f'||D'| + |f||D''|)/m
//! ```

use super::values::{Values, at_crank_speed};
use super::{Dyad, Reached, Shape, singular};
use crate::machine::first_bits;
use crate::reference::dyad::{four_bar, slider_crank};
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
        if within_reach(&dyad.shape, degrees, bits) == Some(false) {
            return Proved::Unreachable;
        }
        if let Some(values) = values(dyad, degrees, assembly, bits) {
            for (text, x) in proved.iter_mut().zip(&values) {
                if text.is_none() {
                    *text = x.to_decimal(digits as usize);
                }
            }
        }
        bits *= 2;
    }
    Proved::Values(proved)
}

/// Returns whether the dyad can be joined, or `None` if that cannot be decided with `bits` bits.
fn within_reach(shape: &Shape, degrees: &Rational, bits: u32) -> Option<bool> {
    let ball = |q: &Rational| Ball::rational(bits, q);
    let (sin, cos) = shape.relative(degrees, bits).sin_cos();
    let rest = match shape {
        Shape::FourBar { exact, .. } => {
            let [a, b, c, d] = exact;
            let squares = Rational::from(a * a) + Rational::from(d * d);
            let span = ball(&squares) - ball(&(Rational::from(a * d) * 2u32)) * cos;
            let most = ball(&Rational::from(b + c).square()) - &span;
            let least = span - ball(&Rational::from(b - c).square());
            [most, least]
        }
        Shape::SliderCrank { exact, .. } => {
            let [a, b, e] = exact;
            let height = ball(e) - ball(a) * sin;
            [ball(b) - &height, ball(b) + &height]
        }
    };
    if rest.iter().any(Ball::is_negative) {
        Some(false)
    } else if rest.iter().all(Ball::is_positive) {
        Some(true)
    } else {
        None
    }
}

/// The values of a row in the order of the columns, enclosed.
fn values(dyad: &Dyad, degrees: &Rational, assembly: Assembly, bits: u32) -> Option<Vec<Ball>> {
    let angle = dyad.shape.relative(degrees, bits);
    let rational = angle.mid().to_rational()?;
    let distance = Ball::new(angle.rad().to_float(), Mag::ZERO);
    let left = assembly == Assembly::Positive;
    let (near, bounds) = near(&dyad.shape, &rational, left, bits, &distance)?;
    let mut v = widened(near, &bounds, &distance);
    match &dyad.shape {
        Shape::FourBar { exact, .. } => parallelogram(exact, degrees, left, &mut v),
        Shape::SliderCrank { direction, .. } => {
            slider_zeros(dyad, degrees, left, &mut v);
            v[1] = &v[1] + &direction.to_ball(bits);
        }
    }
    if let Some(crank) = &dyad.crank {
        let (w, e) = (crank.omega.to_ball(bits), crank.epsilon.to_ball(bits));
        v = at_crank_speed(v, |f, s| (f * &w, s * w.square() + f * &e));
    }
    let per_radian = &Ball::integer(bits, 180) / &Ball::pi(bits);
    for &i in dyad.shape.angles() {
        v[i] = &v[i] * &per_radian;
    }
    Some(v.to_vec())
}

/// The values at a rational angle in radians from frame or guide, the rod's angle from the guide
/// too, and bounds on their derivatives within the distance.
fn near(
    shape: &Shape,
    angle: &Rational,
    left: bool,
    bits: u32,
    distance: &Ball,
) -> Option<(Values<Ball>, Values<Ball>)> {
    match shape {
        Shape::FourBar { exact, .. } => {
            let m = four_bar(exact, angle, left, bits).ok()?;
            let bounds = four_bar_bounds(exact, &m.determinant, distance)?;
            let ([p2, f2, s2], [p3, f3, s3]) = (m.coupler, m.rocker);
            let near = [p2, p3, f2, f3, s2, s3, m.transmission, m.determinant];
            Some((near, bounds))
        }
        Shape::SliderCrank { exact, .. } => {
            let m = slider_crank(exact, &Rational::new(), angle, left, bits).ok()?;
            let ([x, x1, x2], [p, p1, p2]) = (m.slider, m.rod);
            let reach = Ball::rational(bits, &exact[1]) * m.transmission.sin_cos().0;
            let reach = if left { reach } else { -reach };
            let bounds = slider_bounds(exact, &reach, distance)?;
            Some(([x, p, x1, p1, x2, p2, m.transmission, reach], bounds))
        }
    }
}

fn widened(near: Values<Ball>, bounds: &Values<Ball>, distance: &Ball) -> Values<Ball> {
    if distance.is_zero() {
        return near;
    }
    std::array::from_fn(|i| near[i].widened((&bounds[i] * distance).magnitude()))
}

/// The bound on `f''` where `f D = N` and `|D| ≥ m`, from those on `N''`, `D'`, `D''`, `f`, `f'`.
fn third(n2: &Ball, d1: &Ball, d2: &Ball, m: &Ball, f: &Ball, f1: &Ball) -> Ball {
    (n2 + (f1 * d1).shift(1) + f * d2) / m
}

/// The least absolute value of the determinant within the distance, where it is proved positive.
fn least(determinant: &Ball, rate: &Ball, distance: &Ball) -> Option<Ball> {
    let square = determinant.square() - rate * distance;
    square.is_positive().then(|| square.sqrt())
}

/// Bounds on the derivatives of φ2, φ3, their first and second derivatives, transmission angle and
/// determinant.
fn four_bar_bounds(l: &[Rational; 4], determinant: &Ball, distance: &Ball) -> Option<Values<Ball>> {
    let bits = determinant.prec();
    let [a, b, c, _] = l.each_ref().map(|q| Ball::rational(bits, q));
    let abc = &a * &b * &c;
    let m = least(determinant, &(&abc * (&b + &c)).shift(1), distance)?;
    let one = Ball::integer(bits, 1);
    let (n2, n3) = (&a * &c, &a * &b);
    let (p2, p3) = (&n2 / &m, &n3 / &m);
    let turn = &p2 + &p3;
    let d1 = &b * &c * &turn;
    // The numerator for φ2 holds φ1 − φ3, the one for φ3 holds φ1 − φ2.
    let (r2, r3) = (&one + &p3, &one + &p2);
    let q2 = (&n2 * &r2 + &p2 * &d1) / &m;
    let q3 = (&n3 * &r3 + &p3 * &d1) / &m;
    let d2 = &b * &c * (turn.square() + &q2 + &q3);
    let t2 = third(&(&n2 * (r2.square() + &q3)), &d1, &d2, &m, &p2, &q2);
    let t3 = third(&(&n3 * (r3.square() + &q2)), &d1, &d2, &m, &p3, &q3);
    Some([p2, p3, q2, q3, t2, t3, turn, d1])
}

/// Bounds on the derivatives of the slider's coordinate, θ, their first and second derivatives,
/// transmission angle and determinant.
fn slider_bounds(l: &[Rational; 3], determinant: &Ball, distance: &Ball) -> Option<Values<Ball>> {
    let bits = determinant.prec();
    let [a, b, e] = l.each_ref().map(|q| Ball::rational(bits, q));
    let m = least(determinant, &(&a * (&e.abs() + &a)).shift(1), distance)?;
    let p = &a / &m;
    let d1 = &b * &p;
    let q = (&a + &p * &d1) / &m;
    let d2 = &b * (p.square() + &q);
    let t = third(&a, &d1, &d2, &m, &p, &q);
    let d3 = &b * (&p * p.square() + Ball::integer(bits, 3) * &p * &q + &t);
    // x = a cos ψ + D.
    Some([&a + &d1, p.clone(), &a + d2, q, &a + d3, t, p, d1])
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

    fn shape(kind: &str, geometry: &str) -> Shape {
        let text = format!("type = \"{kind}\"\n[geometry]\n{geometry}");
        match Linkage::read(&Source::toml(text)).unwrap() {
            Linkage::Dyad(dyad) => dyad.shape,
            _ => unreachable!("a dyad"),
        }
    }

    /// `x = a cos ψ + b cos θ` with θ′ ≤ p, θ″ ≤ q, θ‴ ≤ t: the derivatives of `cos θ` are at most
    /// p, p² + q and p³ + 3pq + t.
    #[test]
    fn bounds_of_the_slider_are_those_of_its_angle() {
        let l = [2, 5, 1].map(Rational::from);
        let [determinant, distance] = [3.0, 0.25].map(|x| Ball::exact(128, x));
        let found =
            slider_bounds(&l, &determinant, &distance).expect("away from the dead position");
        let [x1, p, x2, q, x3, t, ..] = found.map(|b| b.mid().to_f64());
        let cosine = [p, p * p + q, p.powi(3) + 3.0 * p * q + t];
        for (x, c) in [x1, x2, x3].into_iter().zip(cosine) {
            assert!((x / (2.0 + 5.0 * c) - 1.0).abs() < 1e-14, "{x} {c}");
        }
    }

    /// With `D f = N`, where `N` is `n` times the sine of the crank's angle less the other link's:
    /// each derivative of the product by the rule, `|D| ≥ m` and all sines and cosines at most 1.
    #[test]
    fn bounds_of_the_four_bar_are_those_of_its_angles() {
        let l = [2, 5, 4, 6].map(Rational::from);
        let [determinant, distance] = [19.0, 0.25].map(|x| Ball::exact(128, x));
        let found =
            four_bar_bounds(&l, &determinant, &distance).expect("away from the dead position");
        let [p2, p3, q2, q3, t2, t3, turn, d1] = found.map(|b| b.mid().to_f64());
        let m = (19f64.powi(2) - 0.25 * 2.0 * 40.0 * 9.0).sqrt();
        let (first, second) = (20.0 * (p2 + p3), 20.0 * ((p2 + p3).powi(2) + q2 + q3));
        let near = |x: f64, due: f64| assert!((x / due - 1.0).abs() < 1e-14, "{x} {due}");
        near(turn, p2 + p3);
        near(d1, first);
        for (n, [p, q, t], [other, its]) in [
            (8.0, [p2, q2, t2], [p3, q3]),
            (10.0, [p3, q3, t3], [p2, q2]),
        ] {
            near(m * p, n);
            near(m * q, n * (1.0 + other) + p * first);
            let of_numerator = n * ((1.0 + other).powi(2) + its);
            near(m * t, of_numerator + 2.0 * q * first + p * second);
        }
    }

    fn shapes() -> [Shape; 6] {
        let four = |l: [u32; 4]| {
            let [a, b, c, d] = l;
            let text = format!(
                "crank = \"{a} m\"\ncoupler = \"{b} m\"\nrocker = \"{c} m\"\nframe = \"{d} m\""
            );
            shape("four-bar", &text)
        };
        let slider = |a: u32, b: u32, e: i32| {
            let text = format!("crank = \"{a} m\"\nrod = \"{b} m\"\noffset = \"{e} m\"");
            shape("slider-crank", &text)
        };
        [
            four([10, 40, 30, 35]),
            four([35, 40, 30, 10]),
            four([30, 40, 30, 35]),
            slider(2, 5, 1),
            slider(3, 5, -1),
            slider(5, 4, 3),
        ]
    }

    /// The bound on a first derivative is its numerator's over the least determinant: no
    /// determinant within the distance is below that.
    #[test]
    fn no_determinant_is_below_the_least() {
        let step = Rational::from((1, 50));
        let (distance, nothing) = (Ball::rational(128, &step), Ball::integer(128, 0));
        let (mut checked, mut tightest) = (0, f64::INFINITY);
        for shape in &shapes() {
            let (numerator, of) = match shape {
                Shape::FourBar { exact, .. } => (Rational::from(&exact[0] * &exact[2]), 0),
                Shape::SliderCrank { exact, .. } => (exact[0].clone(), 1),
            };
            for (k, left) in (-150..150).flat_map(|k| [(k, true), (k, false)]) {
                let at = Rational::from((k, 50));
                let Some((_, bounds)) = near(shape, &at, left, 128, &distance) else {
                    continue;
                };
                let least = &Ball::rational(128, &numerator) / &bounds[of];
                for j in [-1, 1] {
                    let other = Rational::from(&step * j) + &at;
                    let (there, _) = near(shape, &other, left, 128, &nothing).unwrap();
                    let ratio = (&there[7].abs() / &least).mid().to_f64();
                    assert!(ratio >= 1.0, "{ratio} at {at}");
                    tightest = f64::min(tightest, ratio);
                    checked += 1;
                }
            }
        }
        assert!(checked > 4000, "{checked}");
        assert!(tightest < 1.01, "{tightest}");
    }

    /// Every value within the distance lies in the widened ball, and the bounds are not idle.
    #[test]
    fn widened_values_hold_those_at_all_angles_within_the_distance() {
        let shapes = shapes();
        let step = Rational::from((1, 2000));
        let distance = Ball::rational(128, &step);
        let nothing = Ball::integer(128, 0);
        let (mut checked, mut tightest) = (0, f64::INFINITY);
        for shape in &shapes {
            for (k, left) in (-30..30).flat_map(|k| [(k, true), (k, false)]) {
                let at = Rational::from((k, 10));
                let Some((here, bounds)) = near(shape, &at, left, 128, &distance) else {
                    continue;
                };
                let wide = widened(here.clone(), &bounds, &distance);
                for j in [-4i32, -1, 2, 4] {
                    let other = Rational::from((j, 4)) * &step + &at;
                    let (there, _) = near(shape, &other, left, 128, &nothing).unwrap();
                    for i in 0..8 {
                        assert!(wide[i].contains_ball(&there[i]), "value {i} at {at}");
                        let moved = (&there[i] - &here[i]).magnitude().to_f64();
                        tightest = f64::min(tightest, wide[i].rad().to_f64() / moved);
                        checked += 1;
                    }
                }
            }
        }
        assert!(checked > 5000, "{checked}");
        assert!(tightest < 1.5, "{tightest}");
    }

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
            assert_eq!(within_reach(&dyad.shape, &degrees.into(), 128), Some(false));
            assert_eq!(within_reach(&dyad.shape, &90.into(), 128), Some(true));
            let proved = certified(&dyad, &degrees.into(), Assembly::Positive, 10);
            assert!(matches!(proved, Proved::Unreachable));
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

    /// The two links of the dyad may be joined in either order: with their lengths, the bounds of
    /// coupler and rocker change places.
    #[test]
    fn bounds_of_coupler_and_rocker_are_those_of_the_exchanged_linkage() {
        let [determinant, distance] = [900.0, 0.01].map(|x| Ball::exact(128, x));
        let of = |l: [u32; 4]| {
            let found = four_bar_bounds(&l.map(Rational::from), &determinant, &distance);
            found.unwrap().map(|b| b.mid().to_f64())
        };
        let [p2, p3, q2, q3, t2, t3, turn, d1] = of([10, 40, 30, 35]);
        let exchanged = of([10, 30, 40, 35]);
        for (x, due) in exchanged
            .into_iter()
            .zip([p3, p2, q3, q2, t3, t2, turn, d1])
        {
            assert!((x / due - 1.0).abs() < 1e-14, "{x} {due}");
        }
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
