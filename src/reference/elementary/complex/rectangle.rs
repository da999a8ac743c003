//! Rectangles of the complex plane between doubles, for bounds on holomorphic functions.
//!
//! The contract is that of balls: the result of an operation holds the result for any numbers of the
//! operands. Sums and products of ends are rounded to nearest and moved to the next double
//! outwards; functions are off by what stands at them in `coarse`.

mod special;

use super::super::support::{BITS, doubles, ends, hull_of_doubles};
use super::super::trigonometric::{outwards, waves};
use super::super::{coarse, hyperbolic};
use super::exponential::{inverse_of_doubles, root_of_doubles};
use crate::{Ball, ComplexBall, Mag};

type Interval = [f64; 2];

/// A rectangle: the least and the greatest real and imaginary part, which are finite.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    re: Interval,
    im: Interval,
}

fn sum(a: Interval, b: Interval) -> Interval {
    [(a[0] + b[0]).next_down(), (a[1] + b[1]).next_up()]
}

fn product(a: Interval, b: Interval) -> Interval {
    let [w, x, y, z] = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    let low = w.min(x).min(y.min(z));
    let high = w.max(x).max(y.max(z));
    [low.next_down(), high.next_up()]
}

fn square(a: Interval) -> Interval {
    let [low, high] = [a[0] * a[0], a[1] * a[1]];
    let least = match a[0] <= 0.0 && a[1] >= 0.0 {
        true => 0.0,
        false => low.min(high).next_down(),
    };
    [least, low.max(high).next_up()]
}

fn negative([low, high]: Interval) -> Interval {
    [-high, -low]
}

/// The least distance from zero of an end whose inverse is taken.
const TINY: f64 = 1e-140;

/// Moves ends that lie next to zero outwards.
fn without_tiny([low, high]: Interval) -> Interval {
    let down = |x: f64| match x.abs() < TINY {
        true if x < 0.0 => -TINY,
        true => 0.0,
        false => x,
    };
    [down(low), -down(-high)]
}

impl Rectangle {
    fn new(re: Interval, im: Interval) -> Option<Rectangle> {
        let is_finite = [re, im].as_flattened().iter().all(|x| x.is_finite());
        is_finite.then_some(Rectangle { re, im })
    }

    /// The rectangle around a ball.
    pub fn of_ball(z: &ComplexBall) -> Option<Rectangle> {
        let of = |x: &Ball| doubles(&ends(x, BITS));
        Rectangle::new(of(&z.re), of(&z.im))
    }

    /// The interval of real numbers between two doubles.
    pub fn real(x: Interval) -> Option<Rectangle> {
        Rectangle::new(x, [0.0; 2])
    }

    /// The rectangle of the numbers whose parts lie between doubles.
    pub fn complex(re: Interval, im: Interval) -> Option<Rectangle> {
        Rectangle::new(re, im)
    }

    /// The ball around it.
    pub fn to_ball(&self) -> Option<ComplexBall> {
        let of = |x: Interval| hull_of_doubles(BITS, x).ok();
        Some(ComplexBall::new(of(self.re)?, of(self.im)?))
    }

    /// The interval of the real parts.
    pub fn real_part(&self) -> Interval {
        self.re
    }

    /// An upper bound on the absolute value.
    pub fn magnitude(&self) -> Mag {
        let size = |x: Interval| Mag::from_f64(x[1].max(-x[0]));
        let (a, b) = (size(self.re), size(self.im));
        a.mul(a).add(b.mul(b)).sqrt()
    }

    /// `−z`.
    #[must_use]
    pub fn negative(&self) -> Rectangle {
        Rectangle {
            re: negative(self.re),
            im: negative(self.im),
        }
    }

    /// `z + w`.
    pub fn add(&self, w: &Rectangle) -> Option<Rectangle> {
        Rectangle::new(sum(self.re, w.re), sum(self.im, w.im))
    }

    /// `z w`.
    pub fn mul(&self, w: &Rectangle) -> Option<Rectangle> {
        if w.im == [0.0; 2] {
            return Rectangle::new(product(self.re, w.re), product(self.im, w.re));
        }
        if self.im == [0.0; 2] {
            return w.mul(self);
        }
        Rectangle::new(
            sum(product(self.re, w.re), negative(product(self.im, w.im))),
            sum(product(self.re, w.im), product(self.im, w.re)),
        )
    }

    fn square(&self) -> Option<Rectangle> {
        let [x, y] = product(self.re, self.im);
        Rectangle::new(
            sum(square(self.re), negative(square(self.im))),
            [2.0 * x, 2.0 * y],
        )
    }

    /// `z^k` by squaring; of the inverse for k < 0.
    pub fn power(&self, k: i32) -> Option<Rectangle> {
        let z = match k < 0 {
            true => self.inverse()?,
            false => *self,
        };
        let k = k.unsigned_abs();
        let mut found: Option<Rectangle> = None;
        for place in (0..32 - k.leading_zeros()).rev() {
            if let Some(power) = found {
                found = Some(power.square()?);
            }
            if k >> place & 1 == 1 {
                found = Some(match found {
                    Some(power) => power.mul(&z)?,
                    None => z,
                });
            }
        }
        found
    }

    /// `1/z`; none where zero may be in it.
    pub fn inverse(&self) -> Option<Rectangle> {
        let is_off = |x: Interval| x[0] >= TINY || x[1] <= -TINY;
        if !is_off(self.re) && !is_off(self.im) {
            return None;
        }
        let [re, im] = inverse_of_doubles([self.re, self.im].map(without_tiny))?;
        Rectangle::new(re, im)
    }

    /// The side of the real axis of all numbers, where they are off it: 1 above it.
    fn side(&self) -> Option<f64> {
        match self.im {
            [low, _] if low > 0.0 => Some(1.0),
            [_, high] if high < 0.0 => Some(-1.0),
            _ => None,
        }
    }

    /// The principal square root off its cut.
    pub fn sqrt(&self) -> Option<Rectangle> {
        if self.re[0] < TINY {
            let side = self.side()?;
            // √z = ±i √−z, and √z = e^(±iπ/4) √(∓i z), the upper sign above the axis.
            return match self.re[1] <= -TINY {
                true => Some(self.negative().sqrt()?.turned_by(side)),
                false => {
                    let half = std::f64::consts::FRAC_1_SQRT_2;
                    let half = [half.next_down(), half.next_up()];
                    let eighth = Rectangle::new(half, half)?;
                    let eighth = if side > 0.0 { eighth } else { eighth.conj() };
                    let aside = self.turned_by(-side);
                    (aside.re[0] >= TINY).then(|| aside.sqrt()?.mul(&eighth))?
                }
            };
        }
        let [re, im] = root_of_doubles([self.re, self.im].map(without_tiny))?;
        Rectangle::new(re, im)
    }

    /// `e^z = e^x (cos y + i sin y)`.
    pub fn exp(&self) -> Option<Rectangle> {
        if !self.re.iter().all(|x| x.abs() <= coarse::EXPONENTS) {
            return None;
        }
        let e = outwards(self.re.map(coarse::exp));
        let [sin, cos] = waves(self.im)?;
        Rectangle::new(product(e, cos), product(e, sin))
    }

    /// `sinh z` and `cosh z`.
    fn hyperbolic(&self) -> Option<[Rectangle; 2]> {
        let [sinh, cosh] = hyperbolic::ranges(self.re)?;
        let [sin, cos] = waves(self.im)?;
        Some([
            Rectangle::new(product(sinh, cos), product(cosh, sin))?,
            Rectangle::new(product(cosh, cos), product(sinh, sin))?,
        ])
    }

    /// `i z`.
    fn turned(&self) -> Rectangle {
        Rectangle {
            re: negative(self.im),
            im: self.re,
        }
    }

    /// `i z`, or `−i z` for a negative sign.
    fn turned_by(&self, sign: f64) -> Rectangle {
        match sign > 0.0 {
            true => self.turned(),
            false => self.turned().negative(),
        }
    }

    fn conj(&self) -> Rectangle {
        Rectangle {
            re: self.re,
            im: negative(self.im),
        }
    }

    /// `sinh z`.
    pub fn sinh(&self) -> Option<Rectangle> {
        Some(self.hyperbolic()?[0])
    }

    /// `cosh z`.
    pub fn cosh(&self) -> Option<Rectangle> {
        Some(self.hyperbolic()?[1])
    }

    /// `1/cosh z`, at most `1/√(sinh² x + cos² y)`.
    pub fn sech(&self) -> Option<Rectangle> {
        let [sinh, _] = hyperbolic::ranges(self.re)?;
        let [_, cos] = waves(self.im)?;
        let least = (square(sinh)[0] + square(cos)[0]).next_down();
        if least < TINY {
            return None;
        }
        let most = (1.0 / least.sqrt().next_down()).next_up();
        match self.cosh()?.inverse() {
            Some(found) if found.magnitude() <= Mag::from_f64(most) => Some(found),
            _ => Rectangle::new([-most, most], [-most, most]),
        }
    }

    /// `1/cos z`.
    pub fn sec(&self) -> Option<Rectangle> {
        self.turned().sech()
    }

    /// `sin z = −i sinh iz`.
    pub fn sin(&self) -> Option<Rectangle> {
        let Rectangle { re, im } = self.turned().sinh()?;
        Some(Rectangle {
            re: im,
            im: negative(re),
        })
    }

    /// `cos z = cosh iz`.
    pub fn cos(&self) -> Option<Rectangle> {
        self.turned().cosh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::{ComplexEvaluated, complex as c};
    use rug::Float;

    fn exact(x: f64, y: f64) -> ComplexBall {
        let of = |x: f64| Ball::new(Float::with_val(53, x), Mag::ZERO);
        ComplexBall::new(of(x), of(y))
    }

    /// A stream of numbers between zero and one.
    struct Draws(u64);

    impl Draws {
        fn next(&mut self) -> f64 {
            let Draws(state) = self;
            *state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (*state >> 11) as f64 / (1_u64 << 53) as f64
        }

        /// A side of any length.
        fn side(&mut self) -> Interval {
            let x = 16.0 * self.next() - 8.0;
            let x = if self.next() < 0.25 { x.round() } else { x };
            [x, x + (43.0 * self.next() - 40.0).exp2()]
        }

        /// An end or a number between them.
        fn within(&mut self, [low, high]: Interval) -> f64 {
            match self.next() {
                ..0.3 => low,
                ..0.6 => high,
                _ => (low + self.next() * (high - low)).clamp(low, high),
            }
        }
    }

    /// Corners, points of edges and inner points of rectangles of all shapes have values inside.
    fn holds(
        draws: u32,
        name: &str,
        rectangle: impl Fn(&Rectangle) -> Option<Rectangle>,
        ball: impl Fn(&ComplexBall) -> ComplexEvaluated,
    ) {
        let (number, mut draws, mut found) = (draws, Draws(1), 0);
        for _ in 0..number {
            let z = Rectangle::new(draws.side(), draws.side()).unwrap();
            let Some(value) = rectangle(&z).and_then(|z| z.to_ball()) else {
                continue;
            };
            found += 1;
            for _ in 0..12 {
                let (x, y) = (draws.within(z.re), draws.within(z.im));
                let due = ball(&exact(x, y)).unwrap();
                let is_inside = value.re.overlaps(&due.re) && value.im.overlaps(&due.im);
                assert!(is_inside, "{name}: {z:?} at {x} {y}: {value:?}");
            }
        }
        assert!(found > number / 4, "{name}: {found}");
    }

    #[test]
    fn rectangles_hold_all_values() {
        let p = 100;
        holds(800, "inverse", Rectangle::inverse, |z| c::recip(z, p));
        holds(800, "sqrt", Rectangle::sqrt, |z| c::sqrt(z, p));
        holds(800, "exp", Rectangle::exp, |z| c::exp(z, p));
        holds(800, "sinh", Rectangle::sinh, |z| c::sinh(z, p));
        holds(800, "cosh", Rectangle::cosh, |z| c::cosh(z, p));
        holds(800, "sin", Rectangle::sin, |z| c::sin(z, p));
        holds(800, "cos", Rectangle::cos, |z| c::cos(z, p));
    }

    #[test]
    fn products_are_inside() {
        holds(800, "cube", |z| z.power(3), |z| Ok(&(z * z) * z));
        holds(
            800,
            "z − z²",
            |z| z.add(&z.mul(z)?.negative()),
            |z| Ok(z - &(z * z)),
        );
    }

    #[test]
    fn secants_are_inside() {
        let p = 100;
        holds(800, "sech", Rectangle::sech, |z| {
            c::recip(&c::cosh(z, p)?, p)
        });
        holds(800, "sec", Rectangle::sec, |z| c::recip(&c::cos(z, p)?, p));
    }

    #[test]
    fn special_functions_are_inside() {
        let p = 64;
        holds(300, "log", Rectangle::log, |z| c::log(z, p));
        holds(300, "tgamma", Rectangle::tgamma, |z| c::tgamma(z, p));
        // Zero at poles.
        let due = |z: &ComplexBall| c::inverse_gamma(z, p).or(Ok(ComplexBall::zero(p)));
        holds(300, "1/tgamma", Rectangle::inverse_gamma, due);
        holds(300, "lambertw", Rectangle::lambertw, |z| c::lambertw(z, p));
        let far = |z: &Rectangle| z.mul(&Rectangle::real([16.0; 2])?);
        let of = |z: &ComplexBall| z.scaled(&Ball::exact(53, 16.0));
        holds(
            300,
            "far lambertw",
            |z| far(z)?.lambertw(),
            |z| c::lambertw(&of(z), p),
        );
        holds(
            300,
            "far tgamma",
            |z| far(z)?.tgamma(),
            |z| c::tgamma(&of(z), p),
        );
        let inverse = |z: &Rectangle| far(z)?.inverse_gamma();
        holds(300, "far 1/tgamma", inverse, |z| due(&of(z)));
    }

    #[test]
    fn rectangles_across_cuts_have_no_values() {
        for (re, im) in [([-2.0, -1.0], [-1.0, 1.0]), ([-0.5, 1.0], [0.0, 1.0])] {
            let z = Rectangle::new(re, im).unwrap();
            assert!(z.lambertw().is_none() && z.log().is_none() && z.tgamma().is_none());
        }
    }

    /// A bound is near the greatest value.
    #[test]
    fn rectangles_are_not_much_too_large() {
        let z = Rectangle::new([1.0, 1.5], [0.0, 0.5]).unwrap();
        let size = |z: Option<Rectangle>| z.unwrap().magnitude().to_f64();
        assert!(size(z.exp()) < 1.5_f64.exp() * 1.13);
        assert!(size(z.inverse()) < 1.13);
        assert!(size(z.log()) < 0.7 && size(z.lambertw()) < 2.6);
        assert!(size(z.tgamma()) < 1.5 && size(z.inverse_gamma()) < 2.7);
        assert!(size(z.power(2)) < 3.0);
        assert!(size(z.sqrt()) < 1.31);
        assert!(
            Rectangle::new([-1.0, 1.0], [-1.0, 1.0])
                .unwrap()
                .inverse()
                .is_none()
        );
    }
}
