//! Fourier coefficients of a cam cycle, from its corners: where one zone or piece of its laws goes
//! over into the next.
//!
//! With `q = 2nB` for a stroke of `B` turns, polynomial pieces are integrated by parts to the end,
//!
//! ```text
//! ∫ s' e^{−iπqx} dx = Σ_k e^{−iπq x_k} Σ_j [s^(j)](x_k)/(iπq)^j
//! ```
//!
//! with the jumps `[s^(j)]` of the derivatives, `s` being constant outside the stroke. The velocity
//! of an SCCA law vanishes at both ends, `∫ s' e^{−iπqx} dx = (1/iπq) ∫ s'' e^{−iπqx} dx`, and over a
//! zone of it
//!
//! ```text
//! ∫ cos(πr(x − x*)) e^{−iπqx} dx = e^{−iπqx} (iq cos πr(x − x*) − r sin πr(x − x*))/π(q² − r²)
//! ```
//!
//! between its ends. Near resonance, `q ≈ ±r`, it is `½ Σ_± ∫ e^{±iπr(x−x*) − iπqx} dx` instead, and
//! `∫ e^{iπκx} dx` over a width `w` about `m` is `w e^{iπκm} sinc(πκw/2)`. All `q`, `r` and `κ` are
//! rational, so phases are reduced exactly and resonance (`κ = 0`) is decided. From one harmonic to
//! the next each corner turns by the same angle.

use super::cam_law::{Form, Law, Zone, derivatives, derivatives_at_zero};
use crate::ball::Ball;
use crate::complex::ComplexBall;
use crate::mag::Mag;
use rug::Rational;
use std::f64::consts::PI;

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

/// `∫ e^{−iπq(x − start)} cos(πr(x − origin)) dx` over a zone, for any `q`.
fn near_resonance(zone: &Zone, q: &Rational, bits: u32) -> ComplexBall {
    let (start, width) = (Rational::new(), Rational::from(&zone.end - &zone.start));
    let origin = Rational::from(&zone.origin - &zone.start);
    let side = |r: &Rational| {
        let kappa = Rational::from(r - q);
        let turn = cis(&-Rational::from(r * &origin), bits);
        &turn * &exponential(&kappa, &start, &width, bits)
    };
    let minus = -zone.frequency.clone();
    let sum = &side(&zone.frequency) + &side(&minus);
    ComplexBall::new(sum.re.shift(-1), sum.im.shift(-1))
}

/// Bits that `q ± r` may lose by cancellation before the formula for resonance is taken.
const CANCELLED: i64 = 24;

/// A zone between corners `left` and `left + 1`.
struct Wave<'a> {
    zone: &'a Zone,
    left: usize,
    amplitude: Ball,
    frequency: Ball,
    /// `cos πr(x − x*)` and `r sin πr(x − x*)` at both ends.
    ends: [(Ball, Ball); 2],
}

impl Wave<'_> {
    fn new(zone: &Zone, left: usize, bits: u32) -> Wave<'_> {
        let frequency = Ball::rational(bits, &zone.frequency);
        let ends = [&zone.start, &zone.end].map(|x| {
            let phase = Rational::from(x - &zone.origin) * &zone.frequency;
            let ComplexBall { re, im } = quarter(&phase, bits).unwrap_or_else(|| cis(&phase, bits));
            (re, im * &frequency)
        });
        Wave {
            zone,
            left,
            amplitude: Ball::rational(bits, &zone.amplitude),
            frequency,
            ends,
        }
    }

    /// Adds the zone's `π ∫ s'' e^{−iπqx} dx`, with the phases of the corners.
    fn add_to(&self, sum: &mut ComplexBall, q: &Rational, phases: &[ComplexBall]) {
        let bits = self.amplitude.prec();
        let ball = Ball::rational(bits, q);
        let gaps = [&ball - &self.frequency, &ball + &self.frequency];
        let little = ball.magnitude().shift(-CANCELLED);
        let cancelled = |gap: &Ball| gap.mignitude() <= little;
        if gaps.iter().any(cancelled) {
            let whole =
                near_resonance(self.zone, q, bits).scaled(&(Ball::pi(bits) * &self.amplitude));
            *sum = &*sum + &(&whole * &phases[self.left]);
            return;
        }
        let share = &self.amplitude / (&gaps[0] * &gaps[1]);
        let turning = &share * &ball;
        let [from, to] = [0, 1].map(|end| {
            let (cosine, sine) = &self.ends[end];
            let value = ComplexBall::new(-(sine * &share), cosine * &turning);
            &value * &phases[self.left + end]
        });
        *sum = &*sum + &(&to - &from);
    }
}

/// `e^{iπx}` where both parts are −1, 0 or 1.
fn quarter(x: &Rational, bits: u32) -> Option<ComplexBall> {
    let x = half_turns(x) * 2u32;
    let (re, im) = match (*x.denom() == 1).then(|| x.numer().to_i32())?? {
        0 => (1, 0),
        1 => (0, 1),
        -1 => (0, -1),
        _ => (-1, 0),
    };
    Some(ComplexBall::new(
        Ball::integer(bits, re),
        Ball::integer(bits, im),
    ))
}

/// What a law contributes at its corners.
enum Parts<'a> {
    /// Jumps of the derivatives from the first on, at each corner.
    Jumps(Vec<Vec<Ball>>),
    /// The zones, and what they reach.
    Waves(Vec<Wave<'a>>, Ball),
}

/// A law ready for any `q`.
struct Transform<'a> {
    corners: Vec<&'a Rational>,
    parts: Parts<'a>,
}

impl Transform<'_> {
    fn new(law: &Law, bits: u32) -> Transform<'_> {
        let mut corners: Vec<&Rational> = Vec::new();
        // The number of the corner where a part begins; it ends at the next.
        let mut between = |start, end| {
            if corners.last() != Some(&start) {
                corners.push(start);
            }
            corners.push(end);
            corners.len() - 2
        };
        let parts = match &law.0 {
            Form::Zones(zones) => {
                let waves = zones
                    .iter()
                    .map(|zone| Wave::new(zone, between(&zone.start, &zone.end), bits));
                Parts::Waves(waves.collect(), law.reached(bits))
            }
            Form::Pieces(pieces) => {
                let mut jumps: Vec<Vec<Rational>> = Vec::new();
                for piece in pieces {
                    let left = between(&piece.start, &piece.end);
                    jumps.resize_with(left + 2, Vec::new);
                    let width = Rational::from(&piece.end - &piece.start);
                    add_jumps(&mut jumps[left], derivatives_at_zero(&piece.coefficients));
                    let end = derivatives(&piece.coefficients, &width);
                    add_jumps(&mut jumps[left + 1], end.into_iter().map(|d| -d));
                }
                let balls = |j: &Vec<Rational>| j.iter().map(|j| Ball::rational(bits, j)).collect();
                Parts::Jumps(jumps.iter().map(balls).collect())
            }
        };
        Transform { corners, parts }
    }

    /// `e^{−iπp} ∫_0^1 s' e^{−iπqx} dx`, `q ≠ 0`, with the phases `e^{−iπ(p + q x_k)}` of the corners.
    fn at(&self, q: &Rational, phases: &[ComplexBall], bits: u32) -> ComplexBall {
        let pi = Ball::pi(bits);
        let angle = &pi * Ball::rational(bits, q);
        match &self.parts {
            Parts::Jumps(jumps) => by_jumps(jumps, &angle, phases),
            Parts::Waves(waves, reached) => {
                let mut sum = ComplexBall::zero(bits);
                for wave in waves {
                    wave.add_to(&mut sum, q, phases);
                }
                let iq = angle * pi * reached;
                // Division by i.
                -&sum.scaled(&iq.recip()).turned()
            }
        }
    }
}

/// Adds derivatives, of which the zeroth does not count.
fn add_jumps(jumps: &mut Vec<Rational>, derivatives: impl IntoIterator<Item = Rational>) {
    for (k, d) in derivatives.into_iter().skip(1).enumerate() {
        match jumps.get_mut(k) {
            Some(jump) => *jump += d,
            None => jumps.push(d),
        }
    }
}

/// `Σ_k phase_k Σ_j jump_kj/(iπq)^j`, with `πq` given.
fn by_jumps(jumps: &[Vec<Ball>], angle: &Ball, phases: &[ComplexBall]) -> ComplexBall {
    let bits = angle.prec();
    let inverse = angle.recip();
    let longest = jumps.iter().map(Vec::len).max().unwrap_or(0);
    let mut powers = vec![inverse.clone()];
    while powers.len() < longest {
        powers.push(&powers[powers.len() - 1] * &inverse);
    }
    let mut sum = ComplexBall::zero(bits);
    for (jumps, phase) in jumps.iter().zip(phases) {
        // 1/i, 1/i², …: −i, −1, i, 1.
        let mut value = ComplexBall::zero(bits);
        for (k, (jump, power)) in jumps.iter().zip(&powers).enumerate() {
            if jump.is_zero() {
                continue;
            }
            let term = jump * power;
            match k % 4 {
                0 => value.im = value.im - term,
                1 => value.re = value.re - term,
                2 => value.im = value.im + term,
                _ => value.re = value.re + term,
            }
        }
        sum = &sum + &(&value * phase);
    }
    sum
}

/// Equally spaced harmonics.
#[derive(Clone, Copy, Debug)]
pub struct Orders {
    /// The first.
    pub first: u32,
    /// From one to the next.
    pub stride: u32,
    /// How many.
    pub count: u32,
}

impl Orders {
    fn iter(self) -> impl Iterator<Item = u32> {
        (0..self.count).map(move |k| self.first + k * self.stride)
    }
}

/// `e^{−2πin(start + B x_k)}` at each corner, and what it turns by from one harmonic to the next.
struct Phases {
    now: Vec<ComplexBall>,
    step: Vec<ComplexBall>,
}

impl Phases {
    fn new(stroke: &Stroke, corners: &[&Rational], orders: Orders, bits: u32) -> Phases {
        let turned = |n: u32| -> Vec<ComplexBall> {
            let place = |x: &&Rational| Rational::from(&stroke.turns * *x) + &stroke.start;
            let corners = corners.iter().map(place);
            corners
                .map(|place| cis(&-(place * n * 2u32), bits))
                .collect()
        };
        Phases {
            now: turned(orders.first),
            step: match orders.count {
                0 | 1 => Vec::new(),
                _ => turned(orders.stride),
            },
        }
    }

    fn advance(&mut self) {
        for (now, step) in self.now.iter_mut().zip(&self.step) {
            *now = &*now * step;
        }
    }
}

/// About as many bits as the terms of the integration by parts are greater than one: at most `bits`.
fn guard(law: &Law, q: f64, bits: u32) -> u32 {
    let Form::Pieces(pieces) = &law.0 else {
        return 0;
    };
    let mut lost = 0.0f64;
    for piece in pieces {
        let width = Rational::from(&piece.end - &piece.start).to_f64();
        let mut p: Vec<f64> = piece
            .coefficients
            .iter()
            .map(|c| c.to_f64().abs())
            .collect();
        for j in 1..p.len() {
            // The next derivative of Σ |c_k| x^k, greatest at the end of the piece.
            p.remove(0);
            for (k, c) in p.iter_mut().enumerate() {
                *c *= k as f64 + 1.0;
            }
            let most = p.iter().rev().fold(0.0, |sum, c| sum * width + c);
            lost = lost.max(most.log2() - j as f64 * (PI * q).log2());
        }
    }
    (lost.ceil() as u32).min(bits)
}

/// `∫ f' e^{−inθ} dθ` of a stroke of height one, for each of the harmonics.
fn shares(stroke: &Stroke, orders: Orders, bits: u32) -> Vec<ComplexBall> {
    let q = 2.0 * stroke.turns.to_f64() * f64::from(orders.first);
    let bits = bits + guard(&stroke.law, q, bits);
    let law = Transform::new(&stroke.law, bits);
    let mut phases = Phases::new(stroke, &law.corners, orders, bits);
    let share = |n: u32| {
        let q = Rational::from(&stroke.turns * n) * 2u32;
        let share = law.at(&q, &phases.now, bits);
        phases.advance();
        share
    };
    orders.iter().map(share).collect()
}

/// `lift/πn`.
fn scale(lift: &Rational, n: u32, bits: u32) -> Ball {
    Ball::rational(bits, &Rational::from(lift / n)) / Ball::pi(bits)
}

/// `a_n` and `b_n` of a cycle that rises by `lift` and, unless it is carried on, returns.
pub fn harmonics(
    lift: &Rational,
    rise: &Stroke,
    fall: Option<&Stroke>,
    orders: Orders,
    bits: u32,
) -> Vec<[Ball; 2]> {
    let mut sums = shares(rise, orders, bits);
    if let Some(fall) = fall {
        for (up, down) in sums.iter_mut().zip(shares(fall, orders, bits)) {
            *up = &*up - &down;
        }
    }
    let coefficients = |(n, z): (u32, ComplexBall)| {
        let scale = scale(lift, n, bits);
        [z.im, z.re].map(|part| part.with_prec(bits) * &scale)
    };
    orders.iter().zip(sums).map(coefficients).collect()
}

/// `Σ_j |x_j ∂f/∂x_j|` over the inner knots and ordinates of a stroke whose law is a clamped spline:
/// of the mean, and of each `a_n` and `b_n`.
///
/// All are linear in the law, so their derivatives are those of its variations
/// (`Law::spline_variations`).
pub fn data_conditions(
    lift: &Rational,
    stroke: &Stroke,
    orders: Orders,
    bits: u32,
) -> (Mag, Vec<[Mag; 2]>) {
    let variations = stroke.law.spline_variations(bits);
    let length = Ball::rational(bits, &Rational::from(lift * &stroke.turns));
    let mean = variations.iter().fold(Mag::ZERO, |sum, v| {
        sum.add((&length * &v.integral * &v.datum).magnitude())
    });
    let law = Transform::new(&stroke.law, bits);
    let mut phases = Phases::new(stroke, &law.corners, orders, bits);
    let at = |n: u32| {
        let q = Rational::from(&stroke.turns * n) * 2u32;
        let angle = Ball::pi(bits) * Ball::rational(bits, &q);
        let scale = scale(lift, n, bits);
        let mut sums = [Mag::ZERO; 2];
        for v in &variations {
            let z = by_jumps(&v.jumps, &angle, &phases.now);
            let factor = &scale * &v.datum;
            for (sum, part) in sums.iter_mut().zip([z.im, z.re]) {
                *sum = sum.add((part * &factor).magnitude());
            }
        }
        phases.advance();
        sums
    };
    (mean, orders.iter().map(at).collect())
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

    fn harmonic(lift: &Rational, rise: &Stroke, fall: Option<&Stroke>, n: u32) -> [Ball; 2] {
        let orders = Orders {
            first: n,
            stride: 0,
            count: 1,
        };
        harmonics(lift, rise, fall, orders, 128).remove(0)
    }

    /// With the phases of a stroke that starts at zero.
    fn transform(law: &Law, q: &Rational, bits: u32) -> ComplexBall {
        let ready = Transform::new(law, bits);
        let phase = |x: &&Rational| cis(&-Rational::from(q * *x), bits);
        let phases: Vec<ComplexBall> = ready.corners.iter().map(phase).collect();
        ready.at(q, &phases, bits)
    }

    /// Zone by zone in the form that holds at resonance.
    fn slowly(law: &Law, q: &Rational, bits: u32) -> ComplexBall {
        let Form::Zones(zones) = &law.0 else {
            panic!("an SCCA law");
        };
        let mut sum = ComplexBall::zero(bits);
        for z in zones {
            let moved = cis(&-Rational::from(q * &z.start), bits);
            let amplitude = Ball::rational(bits, &z.amplitude);
            sum = &sum + &(&near_resonance(z, q, bits).scaled(&amplitude) * &moved);
        }
        let iq = Ball::pi(bits) * Ball::rational(bits, q) * law.reached(bits);
        -&sum.scaled(&iq.recip()).turned()
    }

    fn scca(b: Rational, d: Rational, fraction: Rational) -> Law {
        Law::stretched(&Family::Scca { b, d }, &fraction)
    }

    #[test]
    fn corners_agree_with_the_form_for_resonance() {
        let laws = [
            scca(r(1, 4), r(1, 2), r(1, 3)),
            scca(r(0, 1), r(1, 1), r(1, 2)),
            scca(r(1, 5), r(0, 1), r(9, 10)),
            scca(r(0, 1), r(0, 1), r(2, 5)),
        ];
        for law in &laws {
            for q in [r(1, 7), r(2, 1), r(3, 1), r(31, 3), r(1234567, 10)] {
                let (fast, slow) = (transform(law, &q, 192), slowly(law, &q, 192));
                assert!(fast.overlaps(&slow), "{q}");
                // Relative to the bound 4 max s'/πq.
                let scale = Mag::power_of_two(-150).div(Mag::above(&rug::Float::with_val(53, &q)));
                assert!(fast.radius() < scale && slow.radius() < scale, "{q}");
            }
        }
    }

    #[test]
    fn beside_a_resonance_no_bits_are_lost() {
        // A quarter wave over 1/4 of the stroke: r = 2.
        let law = scca(r(1, 2), r(1, 2), r(1, 2));
        for k in [4, 20, 23, 24, 25, 40, 100] {
            let q = r(2, 1) + (r(1, 1) >> k);
            let (fast, precise) = (transform(&law, &q, 128), slowly(&law, &q, 400));
            assert!(fast.overlaps(&precise), "2^-{k}");
            assert!(fast.radius() < Mag::power_of_two(-90), "2^-{k}");
        }
    }

    #[test]
    fn a_moved_corner_is_noticed() {
        // Planted: one phase is off by 1e-20 turns.
        let law = scca(r(1, 4), r(1, 2), r(1, 3));
        let q = r(7, 3);
        let ready = Transform::new(&law, 128);
        let mut phases: Vec<ComplexBall> = ready
            .corners
            .iter()
            .map(|x| cis(&-Rational::from(&q * *x), 128))
            .collect();
        let due = slowly(&law, &q, 128);
        assert!(ready.at(&q, &phases, 128).overlaps(&due));
        let off = Rational::from((1, 10u64.pow(19))) / 10u32;
        phases[1] = &phases[1] * &cis(&off, 128);
        assert!(!ready.at(&q, &phases, 128).overlaps(&due));
    }

    #[test]
    fn short_strokes_keep_their_digits() {
        let c: Vec<Rational> = [0, 0, 0, 0, 35, -84, 70, -20].map(|c| r(c, 1)).into();
        let rise = Stroke {
            law: Law::polynomial(&c).unwrap(),
            start: r(1, 7),
            turns: r(1, 1000),
        };
        let [a, b] = harmonic(&r(1, 1), &rise, None, 1);
        assert!(a.rad() < Mag::power_of_two(-120) && b.rad() < Mag::power_of_two(-120));
    }

    #[test]
    fn equal_steps_are_single_harmonics() {
        let stroke = |law, start, turns| Stroke { law, start, turns };
        let rise = stroke(scca(r(1, 4), r(1, 2), r(1, 3)), r(1, 7), r(1, 3));
        let c: Vec<Rational> = [0, 0, 0, 10, -15, 6].map(|c| r(c, 1)).into();
        let fall = stroke(Law::polynomial(&c).unwrap(), r(1, 2), r(2, 5));
        let orders = Orders {
            first: 900_000,
            stride: 7,
            count: 8,
        };
        let all = harmonics(&r(3, 2), &rise, Some(&fall), orders, 128);
        for (n, [a, b]) in orders.iter().zip(&all) {
            let [c, d] = harmonic(&r(3, 2), &rise, Some(&fall), n);
            assert!(a.overlaps(&c) && b.overlaps(&d));
            assert!(a.rad() < Mag::power_of_two(-130) && b.rad() < Mag::power_of_two(-130));
        }
    }

    #[test]
    fn conditions_of_a_table_are_its_differences() {
        use crate::cubic_spline::Spline;
        let knots = [r(0, 1), r(1, 5), r(1, 2), r(9, 10), r(1, 1)];
        let ordinates = [r(0, 1), r(1, 9), r(2, 3), r(4, 5), r(1, 1)];
        let stroke = |x: &[Rational], y: &[Rational]| Stroke {
            law: Law::spline(&Spline::clamped(x, y, &r(0, 1), &r(0, 1)).unwrap(), x),
            start: r(1, 11),
            turns: r(2, 7),
        };
        let orders = Orders {
            first: 3,
            stride: 2,
            count: 3,
        };
        let values = |stroke: &Stroke| -> Vec<Ball> {
            // The condition of the mean is that of one stroke: its area.
            let area = stroke.law.mean(300) * Ball::rational(300, &stroke.turns);
            let harmonics = harmonics(&r(1, 1), stroke, None, orders, 300);
            std::iter::once(area)
                .chain(harmonics.into_iter().flatten())
                .collect()
        };
        let base = stroke(&knots, &ordinates);
        let before = values(&base);
        let mut due = vec![0.0; before.len()];
        for j in 1..4 {
            for of_knot in [true, false] {
                let (mut x, mut y) = (knots.clone(), ordinates.clone());
                let moved = if of_knot { &mut x[j] } else { &mut y[j] };
                *moved *= r(1, 1) + (r(1, 1) >> 60);
                for ((sum, a), b) in due.iter_mut().zip(values(&stroke(&x, &y))).zip(&before) {
                    *sum += (a - b).shift(60).to_f64().abs();
                }
            }
        }
        let (mean, found) = data_conditions(&r(1, 1), &base, orders, 128);
        let found = std::iter::once(mean).chain(found.into_iter().flatten());
        for (found, due) in found.zip(due) {
            assert!(
                (found.to_f64() / due - 1.0).abs() < 1e-13,
                "{found:?} {due}"
            );
        }
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
        let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), 1);
        assert!(a.contains(&r(-1, 1)) && a.accuracy_bits() > 110 && b.contains(&r(0, 1)));
        assert!(mean(&r(2, 1), &rise, Some(&fall), 128).contains(&r(1, 1)));
        for n in [2, 3, 1000] {
            let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), n);
            assert!(a.contains(&r(0, 1)) && b.contains(&r(0, 1)));
        }
    }
}
