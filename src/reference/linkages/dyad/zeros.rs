//! Values of four-bars and slider-cranks that are exactly zero.
//!
//! Lengths and angles are rational. Every value but the angles is algebraic in `e^{iφ}` (for the
//! slider-crank in `e^{i(φ−δ)}`), which is transcendental for a rational angle other than zero
//! (Lindemann). There such a value is zero only if it is zero all along its branch, which the four
//! families below exhaust; at the angle zero everything is a rational expression of the lengths
//! and one square root.
//!
//! # Branches along which a value is zero
//! A derivative that vanishes along a branch of the four-bar makes an angle `k φ + c`. Then `b² =
//! |d + c e3 − a e1|²` is constant in φ: of its terms with the frequencies `|k|`, 1 and `|k − 1|`,
//! whose factors are not zero, one is constant and the two others cancel, so that `k` is 0 or 1.
//! With `k = 1` the linkage is a parallelogram, `a = c` and `b = d`; with `k = 0` the joint rests
//! on the crank's pivot, `a = b` and `c = d`. The coupler in the place of the rocker gives the
//! same two. The joint's coordinates vanish along a branch only where it rests.
//!
//! The slider-crank has `x' = −a sin ψ + h a cos ψ/R` with `ψ = φ − δ`, `h = e − a sin ψ` and `R²
//! = b² − h²`, and `R³ φ2'' = ±a (a e + (b² − e² − a²) sin ψ + a e sin² ψ)`. Both vanish along a
//! branch only if `a = b` and `e = 0`: the slider then rests on the crank's pivot, or the rod
//! turns as fast as the crank, the other way round. An angle of the rod that is zero makes `e − a
//! sin ψ + b sin δ` zero, which by Lindemann and Weierstrass needs `ψ = 0`, or `ψ = δ` with `a =
//! b` and `e = 0`.

use super::{FourBarBalls, SliderCrankBalls};
use crate::{Ball, Mag};
use rug::Rational;

/// Only what a ball leaves open is made zero.
fn put(values: &mut [&mut Ball]) {
    for value in values.iter_mut().filter(|value| value.contains_zero()) {
        let bits = value.prec();
        **value = Ball::integer(bits, 0);
    }
}

/// Makes an angle zero that is known to be a whole number of turns, if it is none but zero.
fn put_whole_turns(angle: &mut Ball) {
    if angle.magnitude() < Mag::from_f64(1.0) {
        put(&mut [angle]);
    }
}

/// Makes the values exactly zero that are, in a position of a four-bar that is not singular. `sin`
/// is the sine of `phi`.
pub(super) fn of_four_bar(
    out: &mut FourBarBalls,
    lengths: &[Rational; 4],
    (phi, sin): (&Rational, &Ball),
    left: bool,
) {
    let [a, b, c, d] = lengths;
    if *phi == 0 {
        return of_four_bar_at_zero(out, lengths);
    }
    let [_, coupler1, coupler2] = &mut out.coupler;
    let [_, rocker1, rocker2] = &mut out.rocker;
    if a == c && b == d && decided(sin, left) {
        put(&mut [coupler1, coupler2, rocker2]);
        put_whole_turns(&mut out.coupler[0]);
    } else if a == b && c == d && decided(sin, !left) {
        let [x, y] = &mut out.joint;
        put(&mut [coupler2, rocker1, rocker2, x, y]);
    }
}

/// Returns whether the sign is certain, and the one asked for.
fn decided(x: &Ball, positive: bool) -> bool {
    match positive {
        true => x.is_positive(),
        false => x.is_negative(),
    }
}

/// With the crank on the frame, `C − A = (x, v)` and `C − B = (y, v)`, the second derivatives are
/// a rational number times `v`, and so are `φ2'' b² = x Y − v (X + a)` and `φ3'' c² = y Y − v X`,
/// where `C'' = (X, Y)`.
fn of_four_bar_at_zero(out: &mut FourBarBalls, [a, b, c, d]: &[Rational; 4]) {
    let span = Rational::from(d - a);
    let squares = b.clone().square() - c.clone().square();
    let x = (span.clone().square() + squares) / (Rational::from(&span) * 2u32);
    let y = Rational::from(&x - &span);
    let v2 = b.clone().square() - x.clone().square();
    // C' = (a v, −a y)/D; its squares are rational.
    let first2 = (a.clone().square() / span.clone().square()) * (v2.clone() + y.clone().square());
    // C' − A' = (a v, −a y − a D)/D = (a v, −a x)/D.
    let relative2 =
        (a.clone().square() / span.clone().square()) * (v2.clone() + x.clone().square());
    let r1 = -Rational::from(a * &x) - relative2;
    let r2 = -first2;
    let across = Rational::from(&r1 - &r2) / &span;
    // v Y, and with it v times each of the two numerators.
    let v_up = r2 - Rational::from(&y * &across);
    let coupler = Rational::from(&x * &v_up) - v2.clone() * Rational::from(&across + a);
    let rocker = Rational::from(&y * &v_up) - v2 * &across;
    if coupler == 0 {
        put(&mut [&mut out.coupler[2]]);
    }
    if rocker == 0 {
        put(&mut [&mut out.rocker[2]]);
    }
    if Rational::from(a + &x) == 0 {
        put(&mut [&mut out.joint[0]]);
    }
}

/// Makes the values exactly zero that are, in a position of a slider-crank that is not singular.
/// `cos` is the cosine of the angle from the guide to the crank.
pub(super) fn of_slider_crank(
    out: &mut SliderCrankBalls,
    [a, b, e]: &[Rational; 3],
    (delta, phi): (&Rational, &Rational),
    cos: &Ball,
    ahead: bool,
) {
    let isosceles = a == b && *e == 0;
    let [x, x1, x2] = &mut out.slider;
    let [angle, _, angle2] = &mut out.rod;
    if phi == delta {
        let reach2 = b.clone().square() - e.clone().square();
        let a2 = a.clone().square();
        if *e == 0 {
            put(&mut [x1, angle2]);
            if *delta == 0 && ahead {
                put(&mut [angle]);
            }
        }
        if !ahead && reach2 == a2 {
            put(&mut [x]);
        }
        // x'' = −a ± a² b²/R³.
        if !ahead && reach2.clone().square() * reach2 == a2 * b.clone().square().square() {
            put(&mut [x2]);
        }
    } else if isosceles && decided(cos, ahead) {
        put(&mut [angle2]);
        // φ2 = 2δ − φ but for whole turns.
        if *phi == Rational::from(delta * 2) {
            put_whole_turns(angle);
        }
    } else if isosceles && decided(cos, !ahead) {
        put(&mut [x, x1, x2, angle2]);
    }
}
