//! Certified four-bar and slider-crank: joints as intersections of circles and lines, derivatives
//! by implicit differentiation of the constraints in Cartesian coordinates.
//!
//! For the joint `C` of two links of lengths `b` and `c` at the points `A` and `B` the constraints
//! and their first two derivatives are
//!
//! ```text
//! |C − A|² = b²                                  |C − B|² = c²
//! (C − A)·C' = (C − A)·A'                        (C − B)·C' = (C − B)·B'
//! (C − A)·C'' = (C − A)·A'' − |C' − A'|²         (C − B)·C'' = (C − B)·B'' − |C' − B'|²
//! ```
//!
//! and the angle of a link `v` of length `l` obeys `φ' = v × v'/l²`, `φ'' = v × v''/l²`.
//!
//! # Deciding what cannot be reached
//! Lengths and angles are rational. For a rational angle other than zero the cosine is
//! transcendental (Lindemann), and so is the discriminant, which is linear in it (four-bar), or a
//! quadratic with rational coefficients in the sine (slider-crank): it is not zero, and balls
//! decide its sign at some precision. For the angle zero it is computed exactly.

use crate::ball::{Ball, dot};
use crate::{ComplexBall, Mag, Undecided};
use rug::{Float, Rational};
use std::cmp::Ordering;

mod zeros;

/// Why there are no values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DyadRefusal {
    /// A length that has to be positive is not.
    #[error("a length is not positive")]
    NotPositive,
    /// The links cannot be joined in any position, or only in one where all lie on one line.
    #[error("one length is not shorter than the others together")]
    CannotClose,
    /// The dyad certainly cannot be joined.
    #[error("the dyad cannot be joined in this position")]
    Unreachable,
    /// The determinant is exactly zero.
    #[error("the determinant is zero")]
    Singular,
    /// Not decided.
    #[error(transparent)]
    Undecided(#[from] Undecided),
}

/// Position and derivatives of a four-bar linkage.
#[derive(Clone, Debug)]
pub struct FourBarBalls {
    /// The joint of coupler and rocker.
    pub joint: [Ball; 2],
    /// Coupler angle with first and second derivative.
    pub coupler: [Ball; 3],
    /// Rocker angle with first and second derivative.
    pub rocker: [Ball; 3],
    /// Angle between coupler and rocker.
    pub transmission: Ball,
    /// `(C − A) × (C − B)`.
    pub determinant: Ball,
}

/// Position and derivatives of a slider-crank.
#[derive(Clone, Debug)]
pub struct SliderCrankBalls {
    /// The slider's coordinate with first and second derivative.
    pub slider: [Ball; 3],
    /// The rod's angle with first and second derivative.
    pub rod: [Ball; 3],
    /// π/2 minus the acute angle between rod and guide.
    pub transmission: Ball,
}

fn scaled(k: &Ball, v: &ComplexBall) -> ComplexBall {
    ComplexBall::new(k * &v.re, k * &v.im)
}

fn inner(a: &ComplexBall, b: &ComplexBall) -> Ball {
    dot(a.re.prec(), [(&a.re, &b.re), (&a.im, &b.im)])
}

fn undecided(bits: u32, reason: &str) -> DyadRefusal {
    DyadRefusal::Undecided(Undecided::new(bits, reason))
}

/// The sign of a ball that is known not to hold zero exactly.
fn sign(x: &Ball, bits: u32, what: &str) -> Result<Ordering, DyadRefusal> {
    if x.is_positive() {
        Ok(Ordering::Greater)
    } else if x.is_negative() {
        Ok(Ordering::Less)
    } else {
        Err(undecided(bits, &format!("the sign of {what}")))
    }
}

/// `x + 2πk` with the integer `k` that brings it next to `near`. What is left between the two, at
/// most a quarter turn wherever this is called, has to be certainly less than 0.4 turns.
fn lifted(x: &Ball, near: &Ball, bits: u32) -> Result<Ball, DyadRefusal> {
    let turn = Ball::pi(bits + 32).shift(1);
    let turns = &(near - x) / &turn;
    let whole = Float::with_val(turns.prec(), turns.mid().round_ref());
    let k = Ball::new(whole, Mag::ZERO);
    if (&turns - &k).magnitude() < Mag::from_f64(0.4) {
        if k.is_zero() {
            return Ok(x.clone());
        }
        Ok(x + k * turn)
    } else {
        Err(undecided(bits, "the turn of an angle"))
    }
}

fn all_finite<'a>(balls: impl IntoIterator<Item = &'a Ball>, bits: u32) -> Result<(), DyadRefusal> {
    if balls.into_iter().all(Ball::is_finite) {
        Ok(())
    } else {
        Err(undecided(bits, "a division by what may be zero"))
    }
}

/// The four-bar linkage with `[crank, coupler, rocker, frame]` at the crank angle `phi` (radians),
/// joint to the left of the line from the crank's end to the rocker's pivot if `left`.
///
/// The crank turns about the origin, the rocker about `(d, 0)`. The angles are those values of
/// `arg(C − A)` and `arg(C − B)` that are continuous in `phi`: next to
/// `arg D + arg((C − A)/D)` with both arguments in `(−π, π]` if `a ≤ d`, and next to
/// `η + arg((A − C)/D)` with `η = arg(−D)` within a quarter turn of `phi` if `a > d`, where
/// `D = B − A`; for the rocker with `C − B` in the place of `C − A`.
///
/// ```
/// use mechaudit_reference::dyad::four_bar;
/// use rug::Rational;
/// // Crank 1 along the frame 6, coupler 3, rocker 4: a 3-4-5 triangle.
/// let l = [1, 3, 4, 6].map(Rational::from);
/// let m = four_bar(&l, &Rational::new(), true, 128)?;
/// assert!(m.joint[1].contains(&Rational::from((12, 5))));
/// assert!(m.determinant.contains(&Rational::from(12)));
/// # Ok::<(), mechaudit_reference::dyad::DyadRefusal>(())
/// ```
///
/// # Errors
/// See [`DyadRefusal`].
pub fn four_bar(
    lengths: &[Rational; 4],
    phi: &Rational,
    left: bool,
    bits: u32,
) -> Result<FourBarBalls, DyadRefusal> {
    four_bar_closes(lengths)?;
    if phi.cmp0() == Ordering::Equal {
        let [a, b, c, d] = lengths;
        let q = Rational::from(d - a).square();
        let ends = [Rational::from(b - c), Rational::from(b + c)].map(Rational::square);
        match (q.cmp(&ends[0]), q.cmp(&ends[1])) {
            (Ordering::Less, _) | (_, Ordering::Greater) => return Err(DyadRefusal::Unreachable),
            (Ordering::Equal, _) | (_, Ordering::Equal) => return Err(DyadRefusal::Singular),
            _ => {}
        }
    }
    let angle = Ball::rational(bits, phi);
    let (mut out, sin) = enclosed_four_bar(lengths, &angle, left)?;
    zeros::of_four_bar(&mut out, lengths, (phi, &sin), left);
    Ok(out)
}

/// The values of [`four_bar`] at every crank angle of a ball; those that are zero need not be found
/// to be.
///
/// # Errors
/// See [`DyadRefusal`]; each holds for all angles of the ball.
pub fn four_bar_within(
    lengths: &[Rational; 4],
    phi: &Ball,
    left: bool,
) -> Result<FourBarBalls, DyadRefusal> {
    four_bar_closes(lengths)?;
    Ok(enclosed_four_bar(lengths, phi, left)?.0)
}

fn four_bar_closes(lengths: &[Rational; 4]) -> Result<(), DyadRefusal> {
    if lengths.iter().any(|l| l.cmp0() != Ordering::Greater) {
        return Err(DyadRefusal::NotPositive);
    }
    let perimeter: Rational = lengths.iter().sum();
    match lengths.iter().any(|l| Rational::from(l * 2) >= perimeter) {
        true => Err(DyadRefusal::CannotClose),
        false => Ok(()),
    }
}

/// The values, and the sine of the crank angle.
fn enclosed_four_bar(
    lengths: &[Rational; 4],
    phi: &Ball,
    left: bool,
) -> Result<(FourBarBalls, Ball), DyadRefusal> {
    let bits = phi.prec();
    let [ra, rb, rc, rd] = lengths;
    // Constants of the discriminant, exact.
    let most = Rational::from(rb + rc).square();
    let least = Rational::from(rb - rc).square();
    let ball = |x: &Rational| Ball::rational(bits, x);
    let (b2, c2) = (ball(&rb.clone().square()), ball(&rc.clone().square()));
    let (sin, cos) = phi.sin_cos();
    let (a, d) = (ball(ra), ball(rd));
    let zero = Ball::integer(bits, 0);
    let end = ComplexBall::new(&a * &cos, &a * &sin);
    let (end1, end2) = (end.turned(), -&end);
    let pivot = ComplexBall::new(d, zero.clone());
    let span = &pivot - &end;
    let q = span.norm_sqr();
    let outer = ball(&most) - &q;
    let inside = &q - ball(&least);
    for (x, what) in [(&outer, "(b+c)² − |AB|²"), (&inside, "|AB|² − (b−c)²")] {
        if sign(x, bits, what)? == Ordering::Less {
            return Err(DyadRefusal::Unreachable);
        }
    }
    // C = A + u D ± v D⊥.
    let twice = q.shift(1);
    let u = &(&q + &b2 - &c2) / &twice;
    let v = &(&outer * &inside).sqrt() / &twice;
    let v = if left { v } else { -v };
    let joint = &(&end + &scaled(&u, &span)) + &scaled(&v, &span.turned());
    let coupler = &joint - &end;
    let rocker = &joint - &pivot;
    let determinant = coupler.cross(&rocker);

    let solve = |r1: &Ball, r2: &Ball| {
        let x = (r1 * &rocker.im - r2 * &coupler.im) / &determinant;
        let y = (r2 * &coupler.re - r1 * &rocker.re) / &determinant;
        ComplexBall::new(x, y)
    };
    let joint1 = solve(&inner(&coupler, &end1), &zero);
    let relative1 = &joint1 - &end1;
    let r1 = inner(&coupler, &end2) - relative1.norm_sqr();
    let joint2 = solve(&r1, &-joint1.norm_sqr());
    let relative2 = &joint2 - &end2;

    let one = Ball::integer(bits, 1);
    let (near2, near3) = if ra <= rd {
        let theta = span.arg();
        (&theta + v.atan2(&u), &theta + v.atan2(&(&u - &one)))
    } else {
        let eta = lifted(&(-&span).arg(), phi, bits)?;
        let minus = -&v;
        (&eta + minus.atan2(&-&u), &eta + minus.atan2(&(&one - &u)))
    };
    all_finite([&near2, &near3], bits)?;
    let phi2 = lifted(&coupler.arg(), &near2, bits)?;
    let phi3 = lifted(&rocker.arg(), &near3, bits)?;
    let [coupler1, coupler2] = [relative1, relative2].map(|v| coupler.cross(&v) / &b2);
    let [rocker1, rocker2] = [joint1, joint2].map(|v| rocker.cross(&v) / &c2);
    let out = FourBarBalls {
        coupler: [phi2, coupler1, coupler2],
        rocker: [phi3, rocker1, rocker2],
        transmission: determinant.abs().atan2(&inner(&coupler, &rocker)),
        joint: [joint.re, joint.im],
        determinant,
    };
    let all = out.joint.iter().chain(&out.coupler).chain(&out.rocker);
    all_finite(all.chain([&out.transmission, &out.determinant]), bits)?;
    Ok((out, sin))
}

/// The slider-crank with `[crank, rod, offset]`, guide direction `delta` and crank angle `phi`
/// (radians), slider ahead of the crank's end if `ahead`.
///
/// The slider's coordinate `x` is the root of
/// `x² − 2 x A·t + |A|² + e² − 2 e A·n − b² = 0` with the guide's unit vectors `t`, `n`. The rod's
/// angle is that value of `arg(P − A)` that differs from `delta` by at most π/2 if `ahead`, and
/// from `delta + π` otherwise.
///
/// ```
/// use mechaudit_reference::dyad::slider_crank;
/// use rug::Rational;
/// // Crank 1 along the guide, rod 5, offset 3.
/// let l = [1, 5, 3].map(Rational::from);
/// let m = slider_crank(&l, &Rational::new(), &Rational::new(), true, 128)?;
/// assert!(m.slider[0].contains(&Rational::from(5)));
/// # Ok::<(), mechaudit_reference::dyad::DyadRefusal>(())
/// ```
///
/// # Errors
/// See [`DyadRefusal`].
pub fn slider_crank(
    lengths: &[Rational; 3],
    delta: &Rational,
    phi: &Rational,
    ahead: bool,
    bits: u32,
) -> Result<SliderCrankBalls, DyadRefusal> {
    slider_crank_closes(lengths)?;
    if phi == delta {
        match lengths[2].clone().abs().cmp(&lengths[1]) {
            Ordering::Greater => return Err(DyadRefusal::Unreachable),
            Ordering::Equal => return Err(DyadRefusal::Singular),
            Ordering::Less => {}
        }
    }
    let angle = Ball::rational(bits, phi);
    let (mut out, along) = enclosed_slider_crank(lengths, delta, &angle, ahead)?;
    zeros::of_slider_crank(&mut out, lengths, (delta, phi), &along, ahead);
    Ok(out)
}

/// The values of [`slider_crank`] at every crank angle of a ball, from a guide of direction zero;
/// those that are zero need not be found to be.
///
/// # Errors
/// See [`DyadRefusal`]; each holds for all angles of the ball.
pub fn slider_crank_within(
    lengths: &[Rational; 3],
    phi: &Ball,
    ahead: bool,
) -> Result<SliderCrankBalls, DyadRefusal> {
    slider_crank_closes(lengths)?;
    Ok(enclosed_slider_crank(lengths, &Rational::new(), phi, ahead)?.0)
}

fn slider_crank_closes([a, b, e]: &[Rational; 3]) -> Result<(), DyadRefusal> {
    if a.cmp0() != Ordering::Greater || b.cmp0() != Ordering::Greater {
        return Err(DyadRefusal::NotPositive);
    }
    match e.clone().abs() >= Rational::from(a + b) {
        true => Err(DyadRefusal::CannotClose),
        false => Ok(()),
    }
}

/// The values, and the crank's end along the guide.
fn enclosed_slider_crank(
    lengths: &[Rational; 3],
    delta: &Rational,
    phi: &Ball,
    ahead: bool,
) -> Result<(SliderCrankBalls, Ball), DyadRefusal> {
    let bits = phi.prec();
    let ball = |x: &Rational| Ball::rational(bits, x);
    let [a, b, e] = lengths.each_ref().map(ball);
    let (sin, cos) = phi.sin_cos();
    let (sd, cd) = ball(delta).sin_cos();
    let t = ComplexBall::new(cd, sd);
    let n = t.turned();
    let end = ComplexBall::new(&a * &cos, &a * &sin);
    let (end1, end2) = (end.turned(), -&end);
    let (p, q) = (inner(&end, &t), inner(&end, &n));
    // A quarter of the discriminant; (A·t)² + (A·n)² = |A|² = a².
    let b2 = b.square();
    let rest = a.square() + e.square() - (&e * &q).shift(1) - &b2;
    let quarter = p.square() - rest;
    if sign(&quarter, bits, "the discriminant")? == Ordering::Less {
        return Err(DyadRefusal::Unreachable);
    }
    let root = quarter.sqrt();
    let root = if ahead { root } else { -root };
    let x = &p + &root;
    let rod = &(&scaled(&x, &t) + &scaled(&e, &n)) - &end;
    let reach = inner(&rod, &t);
    let x1 = &inner(&rod, &end1) / &reach;
    let relative1 = &scaled(&x1, &t) - &end1;
    let x2 = &(inner(&rod, &end2) - relative1.norm_sqr()) / &reach;
    let relative2 = &scaled(&x2, &t) - &end2;
    let height = inner(&rod, &n);
    let tilt = height.atan2(&reach.abs());
    let near = if ahead {
        ball(delta) + &tilt
    } else {
        ball(delta) + Ball::pi(bits) - &tilt
    };
    all_finite([&near, &rod.re, &rod.im], bits)?;
    let angle = lifted(&rod.arg(), &near, bits)?;
    let [rod1, rod2] = [relative1, relative2].map(|v| rod.cross(&v) / &b2);
    let out = SliderCrankBalls {
        rod: [angle, rod1, rod2],
        transmission: reach.abs().atan2(&height.abs()),
        slider: [x, x1, x2],
    };
    let all = out.slider.iter().chain(&out.rod);
    all_finite(all.chain([&out.transmission]), bits)?;
    Ok((out, p))
}

#[cfg(test)]
mod tests;
