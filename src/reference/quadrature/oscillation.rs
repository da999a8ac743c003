//! Integrals of oscillations up to an end, along a line in the complex plane on which they decay.
//!
//! Let u grow without bound towards the end, and let the integrand times `|dx/du|` be the sum of
//! waves `e^(iωu) g(u)`. If g is holomorphic for `Re u ≥ u₁` and `Im u ≥ 0`, and tends to zero there,
//! then by Cauchy's theorem and Jordan's lemma (for `ω > 0`; below the line for `ω < 0`)
//!
//! `∫_{u₁}^∞ e^(iωu) g(u) du = i e^(iωu₁) ∫_0^∞ e^(−ωs) g(u₁ + is) ds`,
//!
//! and the integral on the left converges. That g is holomorphic is proved on rectangles up to
//! `|u| = R`, and beyond it all at once, by a [`Sector`].

use super::adaptive::adaptive;
use super::{End, Integrand, Run, Segment};
use crate::elementary::complex as elementary;
use crate::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::collections::VecDeque;

/// An integrand next to an end as a sum of waves, `f(x) = Σ e^(iωu) A(x)`, where x is `u^(1/m)` next
/// to infinity, and its distance from a finite end is `u^(−1/m)`.
pub trait Waves {
    /// The order m.
    fn order(&self) -> u32;

    /// The angular frequencies ω of the waves, none of which is zero.
    fn frequencies(&self) -> &[Ball];

    /// Encloses the amplitude A of a wave on a rectangle of complex numbers, where it is proved to be
    /// holomorphic: the one function on all of them that A is on the real line.
    fn amplitude(&mut self, wave: usize, x: &ComplexBall, bits: u32) -> Option<ComplexBall>;

    /// The amplitude of a wave on a sector next to the end, where it is proved to be holomorphic, from x
    /// and its distance from a finite end, or `|x|`.
    fn beside(&mut self, wave: usize, x: &Sector, distance: &Sector) -> Option<Sector>;

    /// The part of the integrand without a wave, if there is one.
    fn rest(&mut self) -> Option<&mut dyn Integrand>;
}

/// A holomorphic function `w^p h(w)` of `w = 1/u` on a quarter of the disc around zero, right of the
/// imaginary axis: the values of h there, of which none may be taken at zero.
#[derive(Clone, Debug)]
pub struct Sector {
    power: Rational,
    values: ComplexBall,
    region: Region,
    /// The number that a constant is, where it is rational.
    rational: Option<Rational>,
}

/// The quarter of the disc with `|w| ≤ reach`.
#[derive(Clone, Copy, Debug)]
struct Region {
    reach: Mag,
    /// True if the imaginary part of w is not positive.
    below: bool,
}

impl Region {
    /// Encloses `w^p` for a positive power.
    fn power(&self, p: &Rational, bits: u32) -> ComplexBall {
        let reach = Ball::new(self.reach.to_float(), Mag::ZERO).with_prec(bits);
        let most = match reach.is_zero() {
            true => Mag::ZERO,
            false => (reach.ln() * Ball::rational(bits, p)).exp().magnitude(),
        };
        let zero = Ball::integer(bits, 0);
        if *p > 1 {
            return ComplexBall::new(zero.widened(most), zero.widened(most));
        }
        let half = Ball::new(most.shift(-1).to_float(), most.shift(-1)).with_prec(bits);
        let im = if self.below { -&half } else { half.clone() };
        ComplexBall::new(half, im)
    }
}

impl Sector {
    /// A power of w.
    fn power_of_w(power: Rational, region: Region, bits: u32) -> Sector {
        Sector {
            power,
            values: ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0)),
            region,
            rational: None,
        }
    }

    /// x and its distance.
    fn variable(end: &End, m: u32, region: Region, bits: u32) -> [Sector; 2] {
        let one = Rational::from((1, m));
        let power = match end {
            End::PlusInfinity | End::MinusInfinity => -one,
            End::Above(_) | End::Below(_) => one,
        };
        let distance = Sector::power_of_w(power, region, bits);
        let at = |a: &Ball| {
            let at = ComplexBall::new(a.with_prec(bits), Ball::integer(bits, 0));
            distance.constant(&at)
        };
        let x = match end {
            End::PlusInfinity => distance.clone(),
            End::MinusInfinity => distance.negative(),
            End::Above(a) => at(a).add(&distance),
            End::Below(a) => at(a).add(&distance.negative()),
        };
        [x, distance]
    }

    /// A constant on the same sector.
    #[must_use]
    pub fn constant(&self, value: &ComplexBall) -> Sector {
        Sector {
            power: Rational::new(),
            values: value.clone(),
            region: self.region,
            rational: None,
        }
    }

    /// A rational number on the same sector.
    #[must_use]
    pub fn rational(&self, q: &Rational) -> Sector {
        let value = Ball::rational(self.bits(), q);
        let value = ComplexBall::new(value, Ball::integer(self.bits(), 0));
        Sector {
            rational: Some(q.clone()),
            ..self.constant(&value)
        }
    }

    /// The number that a constant is, where that is known to be rational.
    pub fn to_rational(&self) -> Option<&Rational> {
        self.rational.as_ref()
    }

    /// A function `f` with `f(0) = 0` of a function that tends to zero, from the derivative: `f(z)/z`
    /// is a mean of its values between 0 and z.
    pub fn vanishing(
        &self,
        slope: impl FnOnce(&ComplexBall) -> Option<ComplexBall>,
    ) -> Option<Sector> {
        if self.power <= 0 {
            return None;
        }
        let mean = slope(&self.values()?)?;
        Some(self.mul(&self.constant(&mean)))
    }

    /// The bits of the values.
    fn bits(&self) -> u32 {
        self.values.re.prec()
    }

    /// `f + g`.
    #[must_use]
    pub fn add(&self, other: &Sector) -> Sector {
        let (low, high) = match self.power <= other.power {
            true => (self, other),
            false => (other, self),
        };
        let raised = Rational::from(&high.power - &low.power);
        let term = match raised.is_zero() {
            true => high.values.clone(),
            false => &high.values * &self.region.power(&raised, self.bits()),
        };
        Sector {
            power: low.power.clone(),
            values: &low.values + &term,
            region: self.region,
            rational: None,
        }
    }

    /// `−f`.
    #[must_use]
    pub fn negative(&self) -> Sector {
        Sector {
            values: -&self.values,
            rational: self.rational.clone().map(|q| -q),
            ..self.clone()
        }
    }

    /// `f g`.
    #[must_use]
    pub fn mul(&self, other: &Sector) -> Sector {
        Sector {
            power: Rational::from(&self.power + &other.power),
            values: &self.values * &other.values,
            region: self.region,
            rational: None,
        }
    }

    /// `1/f`, where f has no zeros but at the end.
    pub fn inverse(&self) -> Option<Sector> {
        let one = ComplexBall::new(Ball::integer(self.bits(), 1), Ball::integer(self.bits(), 0));
        Some(Sector {
            power: Rational::from(-&self.power),
            values: elementary::div(&one, &self.values, self.bits()).ok()?,
            region: self.region,
            rational: None,
        })
    }

    /// `f^n`.
    pub fn power(&self, n: i32) -> Option<Sector> {
        let base = match n < 0 {
            true => self.inverse()?,
            false => self.clone(),
        };
        let one = ComplexBall::new(Ball::integer(self.bits(), 1), Ball::integer(self.bits(), 0));
        let mut product = self.constant(&one);
        for _ in 0..n.unsigned_abs() {
            product = product.mul(&base);
        }
        Some(product)
    }

    /// The principal power `f^q`.
    pub fn real_power(&self, q: &Rational) -> Option<Sector> {
        // The argument of w^p h is the sum of those of its factors, which are both at most a right
        // angle.
        let is_principal =
            self.values.re.is_positive() && Rational::from(self.power.abs_ref()) <= 1;
        if !self.power.is_zero() && !is_principal {
            return None;
        }
        let exponent = Ball::rational(self.bits(), q);
        let exponent = ComplexBall::new(exponent, Ball::integer(self.bits(), 0));
        Some(Sector {
            power: Rational::from(&self.power * q),
            values: elementary::pow(&self.values, &exponent, self.bits()).ok()?,
            region: self.region,
            rational: None,
        })
    }

    /// The values of a function that is bounded on the sector.
    pub fn values(&self) -> Option<ComplexBall> {
        match self.power.cmp0() {
            Ordering::Less => None,
            Ordering::Equal => Some(self.values.clone()),
            Ordering::Greater => Some(&self.values * &self.region.power(&self.power, self.bits())),
        }
    }
}

/// The coordinate u next to an end.
struct Coordinate<'a> {
    end: &'a End,
    m: u32,
}

impl Coordinate<'_> {
    fn is_infinite(&self) -> bool {
        matches!(self.end, End::PlusInfinity | End::MinusInfinity)
    }

    /// `u^(1/m)` or its inverse, of a number right of the imaginary axis.
    fn distance(&self, u: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let one = ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0));
        let root = match self.m {
            1 => u.clone(),
            m => {
                let exponent = Ball::rational(bits, &Rational::from((1, m)));
                let exponent = ComplexBall::new(exponent, Ball::integer(bits, 0));
                elementary::pow(u, &exponent, bits).ok()?
            }
        };
        match self.is_infinite() {
            true => Some(root),
            false => elementary::div(&one, &root, bits).ok(),
        }
    }

    fn place(&self, u: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let distance = self.distance(u, bits)?;
        let real = |a: &Ball| ComplexBall::new(a.with_prec(bits), Ball::integer(bits, 0));
        Some(match self.end {
            End::PlusInfinity => distance,
            End::MinusInfinity => -&distance,
            End::Above(a) => &real(a) + &distance,
            End::Below(a) => &real(a) - &distance,
        })
    }

    /// `|dx/du|`, which is the distance over `m u`.
    fn rate(&self, u: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let distance = self.distance(u, bits)?;
        let below = u.scaled(&Ball::integer(bits, self.m.into()));
        elementary::div(&distance, &below, bits).ok()
    }
}

/// One wave along the line on which it decays.
struct Decaying<'a> {
    waves: &'a mut dyn Waves,
    wave: usize,
    coordinate: Coordinate<'a>,
    start: Ball,
    /// The frequency, and whether it is positive.
    frequency: Ball,
    above: bool,
}

impl<'a> Decaying<'a> {
    /// From `u = 2^start` on.
    fn new(waves: &'a mut dyn Waves, wave: usize, end: &'a End, start: u32) -> Decaying<'a> {
        let m = waves.order();
        let frequency = waves.frequencies()[wave].clone();
        Decaying {
            waves,
            wave,
            coordinate: Coordinate { end, m },
            start: Ball::new(Float::with_val(64, 1) << start, Mag::ZERO),
            above: frequency.is_positive(),
            frequency,
        }
    }

    fn amplitude(&mut self, u: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let x = self.coordinate.place(u, bits)?;
        let amplitude = self.waves.amplitude(self.wave, &x, bits)?;
        let product = &amplitude * &self.coordinate.rate(u, bits)?;
        product.magnitude().is_finite().then_some(product)
    }

    /// `z` turned by a right angle to where the wave decays.
    fn turned(&self, z: &ComplexBall) -> ComplexBall {
        match self.above {
            true => z.turned(),
            false => -&z.turned(),
        }
    }

    /// Proves that the amplitude is holomorphic and tends to zero, and bounds it for `|u| ≥ R`.
    fn proof(&mut self, far: u32) -> Option<Mag> {
        const BITS: u32 = 64;
        let region = Region {
            reach: Mag::power_of_two(-i64::from(far)),
            below: self.above,
        };
        let (end, m) = (self.coordinate.end, self.coordinate.m);
        let [x, distance] = Sector::variable(end, m, region, BITS);
        let amplitude = self.waves.beside(self.wave, &x, &distance)?;
        // |dx/du| is w^(1 ∓ 1/m)/m.
        let one = Rational::from((1, m));
        let rate = match self.coordinate.is_infinite() {
            true => 1 - one,
            false => 1 + one,
        };
        let power = Rational::from(&amplitude.power + &rate);
        if power.cmp0() != Ordering::Greater {
            return None;
        }
        let most = region.power(&power, BITS).magnitude();
        let most = most.mul(amplitude.values.magnitude());
        self.is_holomorphic_within(far)?;
        most.is_finite().then_some(most)
    }

    /// Proves that the amplitude is holomorphic on the square from the start to `2^far`, and as far
    /// away from the real line.
    fn is_holomorphic_within(&mut self, far: u32) -> Option<()> {
        const BITS: u32 = 64;
        const MOST: usize = 1 << 9;
        let far = Float::with_val(BITS, 1) << far;
        let zero = Float::with_val(BITS, 0);
        let mut open = VecDeque::from([[self.start.lower(), far.clone(), zero, far]]);
        let mut tried = 0;
        while let Some([left, right, low, high]) = open.pop_front() {
            tried += 1;
            let across = Ball::between(BITS, &low, &high);
            let across = if self.above { across } else { -across };
            let u = ComplexBall::new(Ball::between(BITS, &left, &right), across);
            if self.amplitude(&u, BITS).is_some() {
                continue;
            }
            if tried + open.len() > MOST {
                return None;
            }
            let half = |a: &Float, b: &Float| Float::with_val(BITS, a + b) >> 1u32;
            let (x, y) = (half(&left, &right), half(&low, &high));
            for (a, b) in [(&left, &x), (&x, &right)] {
                for (c, d) in [(&low, &y), (&y, &high)] {
                    open.push_back([a, b, c, d].map(Float::clone));
                }
            }
        }
        Some(())
    }
}

impl Integrand for Decaying<'_> {
    fn enclose(&mut self, s: &ComplexBall, _: bool, bits: u32) -> Option<ComplexBall> {
        let start = ComplexBall::new(self.start.with_prec(bits), Ball::integer(bits, 0));
        let u = &start + &self.turned(s);
        let decay = elementary::exp(&-&s.scaled(&self.frequency.abs()), bits).ok()?;
        Some(&self.amplitude(&u, bits)? * &decay)
    }
}

/// Powers of two for R that are tried.
const FAR: [u32; 4] = [2, 4, 7, 12];

/// The integral of the waves of an integrand from a distance to the end. The distance is `2^place`
/// next to infinity, and `2^−place` from a finite end.
pub(super) fn integral(
    waves: &mut dyn Waves,
    end: &End,
    place: u32,
    run: &mut Run,
) -> Option<Ball> {
    let m = waves.order();
    let start = place.checked_mul(m)?;
    // Every wave is proved to be integrable before one is.
    let mut proofs = Vec::new();
    for wave in 0..waves.frequencies().len() {
        let mut decaying = Decaying::new(&mut *waves, wave, end, start);
        proofs.push(FAR.iter().find_map(|k| {
            let far = start.checked_add(*k)?;
            decaying.proof(far).map(|most| (far, most))
        })?);
    }
    let mut total = ComplexBall::zero(64);
    for (wave, (far, most)) in proofs.into_iter().enumerate() {
        let mut decaying = Decaying::new(&mut *waves, wave, end, start);
        let frequency = decaying.frequency.abs();
        let least = frequency.mignitude();
        // Beyond S ≥ R the integral is at most the bound times e^(−ωS)/ω.
        let bits = most.div(least).div(run.tail).exponent().unwrap_or(0).max(1);
        let length = (bits as f64 * std::f64::consts::LN_2 / least.to_f64()).max(1.0);
        let length = Float::with_val(64, length).max(&(Float::with_val(64, 1) << far));
        let length = Ball::new(length, Mag::ZERO);
        let decay = (-(&length * &frequency)).exp().magnitude();
        let cut = most.mul(decay).div(least);
        let mut segment = Segment {
            origin: ComplexBall::zero(64),
            direction: ComplexBall::new(length, Ball::integer(64, 0)),
            f: &mut decaying,
        };
        let breaks = [0, 1].map(|t| Float::with_val(64, t));
        let sum = adaptive(&mut segment, &breaks, &mut run.tolerance, &mut run.budget);
        if sum.hindered.is_some() {
            return None;
        }
        let sum = sum.value?.widened(cut);
        let bits = sum.re.prec().max(128);
        let phase = decaying.frequency.with_prec(bits) * decaying.start.with_prec(bits);
        let unit = ComplexBall::unit(&phase);
        total = &total + &(&decaying.turned(&sum) * &unit);
    }
    // The integrand is real.
    Some(total.re)
}

#[cfg(test)]
mod tests;
