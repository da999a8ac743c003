//! Fourier coefficients of a cam cycle, integrated zone by zone.
//!
//! With `q = 2πnB` for a stroke of `B` turns
//!
//! ```text
//! ∫ s' e^{−iqx} dx = (1/iq) ∫ s'' e^{−iqx} dx
//! ```
//!
//! for an SCCA law, whose velocity vanishes at both ends; a zone of it is
//! `½ Σ_± ∫ e^{±iπr(x−x*) − iqx} dx`, and `∫ e^{iπκx} dx` over a width `w` about `m` is
//! `w e^{iπκm} sinc(πκw/2)`. All the `κ` are rational, so phases are reduced exactly and resonance
//! (`κ = 0`) is decided. Polynomial pieces are integrated by parts to the end.

use super::cam_law::{Form, Law, Piece, Zone, derivatives};
use crate::ball::Ball;
use crate::complex::ComplexBall;
use rug::Rational;

/// A rise or a return.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// Its law.
    pub law: Law,
    /// Where it starts, in turns.
    pub start: Rational,
    /// How long it is, in turns.
    pub turns: Rational,
}

/// `x mod 2`, in `[−1, 1)`.
fn half_turns(x: &Rational) -> Rational {
    let shifted = Rational::from(x + 1u32) / 2u32;
    let floor = Rational::from(shifted.floor_ref());
    (shifted - floor) * 2u32 - 1u32
}

/// `e^{iπx}`.
fn cis(x: &Rational, bits: u32) -> ComplexBall {
    ComplexBall::unit(&(Ball::pi(bits) * Ball::rational(bits, &half_turns(x))))
}

/// `∫ e^{iπκx} dx` between two places.
fn exponential(kappa: &Rational, from: &Rational, to: &Rational, bits: u32) -> ComplexBall {
    let width = Rational::from(to - from);
    let mid = Rational::from(from + to) / 2u32;
    let phase = cis(&Rational::from(kappa * &mid), bits);
    let argument = Rational::from(kappa * &width) / 2u32;
    let length = Ball::rational(bits, &width);
    if argument == 0 {
        return phase.scaled(&length);
    }
    let sine = cis(&argument, bits).im;
    let pi = Ball::pi(bits) * Ball::rational(bits, &argument);
    phase.scaled(&(length * sine / pi))
}

fn zone(zone: &Zone, q: &Rational, bits: u32) -> ComplexBall {
    let side = |r: &Rational| {
        let kappa = Rational::from(r - q);
        let turn = cis(&-Rational::from(r * &zone.origin), bits);
        &turn * &exponential(&kappa, &zone.start, &zone.end, bits)
    };
    let minus = -zone.frequency.clone();
    let sum = &side(&zone.frequency) + &side(&minus);
    sum.scaled(&Ball::rational(bits, &zone.amplitude).shift(-1))
}

/// `Σ_j (p^(j)(a) e^{−iqa} − p^(j)(b) e^{−iqb})/(iq)^j`, with `q` in half turns.
fn piece(piece: &Piece, q: &Rational, bits: u32) -> ComplexBall {
    let per_iq = {
        let per_q = (Ball::pi(bits) * Ball::rational(bits, q)).recip();
        ComplexBall::new(Ball::integer(bits, 0), -per_q)
    };
    let width = Rational::from(&piece.end - &piece.start);
    let ends = [(&piece.start, Rational::new()), (&piece.end, width)];
    let [a, b] = ends.map(|(x, since)| {
        let d = derivatives(&piece.coefficients, &since);
        let mut sum = ComplexBall::zero(bits);
        for d in d.iter().skip(1).rev() {
            sum.re = &sum.re + Ball::rational(bits, d);
            sum = &sum * &per_iq;
        }
        &sum * &cis(&-Rational::from(q * x), bits)
    });
    &a - &b
}

/// `∫_0^1 s' e^{−iπqx} dx`, `q ≠ 0`.
fn transform(law: &Law, q: &Rational, bits: u32) -> ComplexBall {
    let zero = ComplexBall::zero(bits);
    match &law.0 {
        Form::Pieces(pieces) => pieces.iter().fold(zero, |sum, p| &sum + &piece(p, q, bits)),
        Form::Zones(zones) => {
            let sum = zones.iter().fold(zero, |sum, z| &sum + &zone(z, q, bits));
            let iq = Ball::pi(bits) * Ball::rational(bits, q) * law.reached(bits);
            // Division by i.
            sum.scaled(&iq.recip())
                .turned()
                .scaled(&Ball::integer(bits, -1))
        }
    }
}

/// `a_n` and `b_n` of a cycle that rises by `lift` and, unless it is carried on, returns.
pub fn harmonic(
    lift: &Rational,
    rise: &Stroke,
    fall: Option<&Stroke>,
    n: u32,
    bits: u32,
) -> [Ball; 2] {
    let share = |stroke: &Stroke| {
        let q = Rational::from(&stroke.turns * n) * 2u32;
        let turn = -(Rational::from(&stroke.start * n) * 2u32);
        &cis(&turn, bits) * &transform(&stroke.law, &q, bits)
    };
    let up = share(rise);
    let z = match fall {
        Some(fall) => &up - &share(fall),
        None => up,
    };
    let scale = Ball::rational(bits, &Rational::from(lift / n)) / Ball::pi(bits);
    [z.im * &scale, z.re * &scale]
}

/// `a_0`; of a cycle without a return that of `f − lift · θ/2π` with `f = 0` where it starts.
pub fn mean(lift: &Rational, rise: &Stroke, fall: Option<&Stroke>, bits: u32) -> Ball {
    let ball = |r: &Rational| Ball::rational(bits, r);
    let rising = ball(&rise.turns) * rise.law.mean(bits);
    let top = Rational::from(&rise.start + &rise.turns);
    let sum = match fall {
        Some(fall) => {
            let dwell = ball(&Rational::from(&fall.start - &top));
            let falling = ball(&fall.turns) * (Ball::integer(bits, 1) - fall.law.mean(bits));
            rising + dwell + falling
        }
        None => {
            let floor = Rational::from(rise.start.floor_ref());
            let since = Rational::from(&rise.start - &floor);
            let rest = Rational::from((1, 2)) - since - &rise.turns;
            rising + ball(&rest)
        }
    };
    sum * ball(lift)
}

/// `∫_0^1 s' e^{−iqx} dx` by the Taylor series of the exponential, for small `q` in radians: the
/// remainder after `terms` terms is at most `q^terms/terms! · ∫|s'|`, with `s' ≥ 0` given.
#[cfg(test)]
fn by_moments(moments: &[Ball], q: &Ball, bits: u32) -> ComplexBall {
    let mut sum = ComplexBall::zero(bits);
    let mut term = ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0));
    for (k, m) in moments.iter().enumerate() {
        sum = &sum + &term.scaled(m);
        let next = q / Ball::integer(bits, k as i64 + 1);
        // Times −iq/(k+1).
        term = -&term.turned().scaled(&next);
    }
    sum.widened(term.magnitude())
}

#[cfg(test)]
mod tests {
    use super::super::cam_law::Family;
    use super::*;

    fn r(n: i32, d: i32) -> Rational {
        Rational::from((n, d))
    }

    /// Moments `∫ s' x^k` of a polynomial law, exactly.
    fn moments(law: &Law, count: usize, bits: u32) -> Vec<Ball> {
        let Form::Pieces(pieces) = &law.0 else {
            panic!("a polynomial law");
        };
        assert!(pieces.len() == 1);
        let c = &pieces[0].coefficients;
        let one = |k: usize| {
            let terms = c
                .iter()
                .enumerate()
                .skip(1)
                .map(|(j, c)| Rational::from(c * j as u32) / (j + k) as u32);
            Ball::rational(bits, &terms.sum())
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn pieces_agree_with_moments() {
        let c: Vec<Rational> = [0, 0, 0, 10, -15, 6].map(|c| r(c, 1)).into();
        let law = Law::polynomial(&c).unwrap();
        for q in [r(1, 100), r(3, 7), r(16, 3)] {
            let direct = transform(&law, &q, 256);
            let radians = Ball::pi(256) * Ball::rational(256, &q);
            let series = by_moments(&moments(&law, 120, 256), &radians, 256);
            assert!(direct.overlaps(&series));
            assert!(direct.re.accuracy_bits() > 150 && series.re.accuracy_bits() > 150);
        }
    }

    #[test]
    fn zones_agree_with_known_transforms() {
        // About the middle of the stroke: π² cos(q/2)/(π² − q²) and sinc(q/2) 4π²/(4π² − q²).
        let bits = 192;
        let about_middle = |b, d, q: &Rational| {
            let law = Law::stretched(&Family::Scca { b, d }, &r(1, 2));
            &transform(&law, q, bits) * &cis(&(q.clone() / 2u32), bits)
        };
        for q in [r(1, 3), r(7, 2), r(1001, 7)] {
            let half = q.clone() / 2u32;
            let wave = cis(&half, bits);
            let square = Rational::from(&q * &q);
            let harmonic = &wave.re / Ball::rational(bits, &(r(1, 1) - &square));
            let found = about_middle(r(0, 1), r(1, 1), &q);
            assert!(found.re.overlaps(&harmonic) && found.im.contains(&r(0, 1)));
            let sinc = &wave.im / (Ball::pi(bits) * Ball::rational(bits, &half));
            let cycloidal = sinc * Ball::rational(bits, &(r(4, 1) / (r(4, 1) - &square)));
            let found = about_middle(r(1, 2), r(1, 2), &q);
            assert!(found.re.overlaps(&cycloidal) && found.re.accuracy_bits() > 150);
        }
        // At resonance, q = π: π/4.
        let found = about_middle(r(0, 1), r(1, 1), &r(1, 1));
        assert!(found.re.overlaps(&Ball::pi(bits).shift(-2)) && found.re.accuracy_bits() > 170);
    }

    #[test]
    fn half_turns_up_and_down() {
        let law = Law::stretched(
            &Family::Scca {
                b: r(0, 1),
                d: r(1, 1),
            },
            &r(1, 2),
        );
        let stroke = |start| Stroke {
            law: law.clone(),
            start,
            turns: r(1, 2),
        };
        let (rise, fall) = (stroke(r(0, 1)), stroke(r(1, 2)));
        let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), 1, 128);
        assert!(a.contains(&r(-1, 1)) && a.accuracy_bits() > 110 && b.contains(&r(0, 1)));
        assert!(mean(&r(2, 1), &rise, Some(&fall), 128).contains(&r(1, 1)));
        for n in [2, 3, 1000] {
            let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), n, 128);
            assert!(a.contains(&r(0, 1)) && b.contains(&r(0, 1)));
        }
    }
}
