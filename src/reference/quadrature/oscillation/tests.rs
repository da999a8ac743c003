//! Sines times amplitudes up to infinity, and functions on sectors.

use super::super::{Goal, Integral, Limit, integrate};
use super::*;
use crate::draw::Draw;
use crate::elementary as real;

fn number(n: i64, bits: u32) -> ComplexBall {
    ComplexBall::new(Ball::integer(bits, n), Ball::integer(bits, 0))
}

/// `sin(x) x^k/((x − p)² + q²)`.
#[derive(Clone, Copy)]
struct Sine {
    k: i32,
    p: i64,
    q: i64,
}

/// The frequencies of a sine.
struct SineWaves {
    sine: Sine,
    frequencies: [Ball; 2],
}

impl Sine {
    fn amplitude(&self, x: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        let off = x - &number(self.p, bits);
        let below = &(&off * &off) + &number(self.q * self.q, bits);
        let mut value = elementary::div(&number(1, bits), &below, bits).ok()?;
        for _ in 0..self.k {
            value = &value * x;
        }
        Some(value)
    }
}

/// The factor of the wave `e^(±ix)` of a sine.
fn factor(wave: usize) -> ComplexBall {
    let half = Ball::exact(64, if wave == 0 { -0.5 } else { 0.5 });
    ComplexBall::new(Ball::integer(64, 0), half)
}

impl Waves for SineWaves {
    fn order(&self) -> u32 {
        1
    }

    fn frequencies(&self) -> &[Ball] {
        &self.frequencies
    }

    fn amplitude(&mut self, wave: usize, x: &ComplexBall, bits: u32) -> Option<ComplexBall> {
        Some(&self.sine.amplitude(x, bits)? * &factor(wave))
    }

    fn beside(&mut self, wave: usize, x: &Sector, _: &Sector) -> Option<Sector> {
        let of = |n: i64| x.constant(&number(n, 64));
        let off = x.add(&of(-self.sine.p));
        let below = off.mul(&off).add(&of(self.sine.q * self.sine.q));
        let product = x.power(self.sine.k)?.mul(&below.inverse()?);
        Some(product.mul(&x.constant(&factor(wave))))
    }

    fn rest(&mut self) -> Option<&mut dyn Integrand> {
        None
    }
}

impl Integrand for Sine {
    fn enclose(&mut self, x: &ComplexBall, _: bool, bits: u32) -> Option<ComplexBall> {
        let amplitude = self.amplitude(x, bits)?;
        if !x.im.is_zero() {
            return Some(&amplitude * &elementary::sin(x, bits).ok()?);
        }
        let sine = real::sin(&x.re, bits).ok()?;
        Some(ComplexBall::new(
            amplitude.re * sine,
            Ball::integer(bits, 0),
        ))
    }

    fn waves(&mut self, _: &End) -> Option<Box<dyn Waves>> {
        let frequencies = [1, -1].map(|n| Ball::integer(128, n));
        Some(Box::new(SineWaves {
            sine: *self,
            frequencies,
        }))
    }
}

fn to_infinity(mut sine: Sine, from: i64, goal: &Goal) -> Integral<Ball> {
    let from = Limit::Finite(Ball::integer(64, from));
    integrate(&mut sine, &from, &Limit::PlusInfinity, goal)
}

/// Integrals by mpmath.
const DUE: [(Sine, i64, &str); 3] = [
    (
        Sine { k: 0, p: 3, q: 2 },
        0,
        "0.0923804585475947346593571628",
    ),
    (
        Sine { k: 1, p: 0, q: 1 },
        0,
        "0.577863674895460858955046570",
    ),
    (
        Sine { k: 1, p: 0, q: 0 },
        1,
        "0.624713256427713604289968426",
    ),
];

#[test]
fn sines_over_polynomials() {
    for (sine, from, due) in DUE {
        let found = to_infinity(sine, from, &Goal::digits(25));
        let value = found.value.expect(due);
        assert!(found.hindrance.is_none(), "{due}");
        let due = Float::with_val(128, Float::parse(due).unwrap());
        let off = Mag::above(&Float::with_val(128, value.mid() - &due).abs());
        assert!(
            off <= value.rad().add(Mag::power_of_two(-84)),
            "{due} {value:?}"
        );
        assert!(value.rad() <= Mag::power_of_two(-82), "{due} {value:?}");
    }
}

/// Few digits, so that the end of the line counts beside all other errors.
#[test]
fn what_is_cut_off_widens_the_result() {
    for (sine, from, due) in DUE {
        let due = Float::with_val(128, Float::parse(due).unwrap());
        for bits in 3..14 {
            let value = to_infinity(sine, from, &Goal::bits(bits)).value.unwrap();
            let off = Mag::above(&Float::with_val(128, value.mid() - &due).abs());
            assert!(off <= value.rad(), "{bits}: {due} {value:?}");
        }
    }
}

/// Poles right of the line, and amplitudes that do not tend to zero.
#[test]
fn what_is_not_proved_has_no_value() {
    for (k, p, q) in [(0, 1000, 1), (0, 3000, 2), (2, 0, 1), (3, 0, 1)] {
        let found = to_infinity(Sine { k, p, q }, 0, &Goal::bits(20));
        assert!(found.value.is_none(), "{k} {p} {q}");
    }
}

/// Random expressions on sectors hold their values at random points.
#[test]
fn sectors_hold_their_functions() {
    let mut draw = Draw(11);
    let bits = 64;
    let mut held = 0;
    for round in 0..4000 {
        let below = round % 2 == 0;
        let region = Region {
            reach: Mag::power_of_two(-2),
            below,
        };
        let end = match round % 3 {
            0 => End::PlusInfinity,
            1 => End::Above(Ball::integer(bits, 0)),
            _ => End::Below(Ball::integer(bits, 3)),
        };
        let m = 1 + round % 2;
        // A point of the sector.
        let size = 0.001 + draw.below(249) as f64 / 1000.0;
        let turn = draw.below(157) as f64 / 100.0;
        let turn = if below { -turn } else { turn };
        let w = ComplexBall::new(
            Ball::exact(bits, size * f64::cos(turn)),
            Ball::exact(bits, size * f64::sin(turn)),
        );
        let u = elementary::div(&number(1, bits), &w, bits).unwrap();
        let x = Coordinate { end: &end, m }.place(&u, bits).unwrap();
        let [variable, distance] = Sector::variable(&end, m, region, bits);
        let way = Coordinate { end: &end, m }.distance(&u, bits).unwrap();
        let mut all = vec![(variable, x), (distance, way)];
        for _ in 0..6 {
            let (f, z) = all[draw.below(all.len() as u64) as usize].clone();
            let (g, y) = all[draw.below(all.len() as u64) as usize].clone();
            let n = draw.below(7) as i64 - 3;
            let q = Rational::from((draw.below(7) as i64 - 3, 2));
            let exponent = ComplexBall::new(Ball::rational(bits, &q), Ball::integer(bits, 0));
            let found = match draw.below(8) {
                0 => Some((f.add(&g), &z + &y)),
                1 => Some((f.mul(&g), &z * &y)),
                2 => Some((f.negative(), -&z)),
                3 => Some((f.add(&f.constant(&number(n, bits))), &z + &number(n, bits))),
                6 => f
                    .vanishing(|z| elementary::exp(z, bits).ok())
                    .zip(elementary::expm1(&z, bits).ok()),
                4 => f
                    .inverse()
                    .zip(elementary::div(&number(1, bits), &z, bits).ok()),
                5 => f
                    .real_power(&q)
                    .zip(elementary::pow(&z, &exponent, bits).ok()),
                _ => {
                    let turned = f.constant(&number(1, bits).turned()).mul(&f);
                    Some((turned, z.turned()))
                }
            };
            all.extend(found);
        }
        for (f, z) in all {
            let power = ComplexBall::new(Ball::rational(bits, &f.power), Ball::integer(bits, 0));
            let power = elementary::pow(&w, &power, bits).unwrap();
            let within = &power * &f.values;
            assert!(
                within.re.overlaps(&z.re) && within.im.overlaps(&z.im),
                "{f:?} {z:?} at {w:?}"
            );
            if let Some(values) = f.values() {
                assert!(
                    values.re.overlaps(&z.re) && values.im.overlaps(&z.im),
                    "{f:?} {z:?}"
                );
                held += 1;
            }
        }
    }
    assert!(held > 4000, "{held}");
}
