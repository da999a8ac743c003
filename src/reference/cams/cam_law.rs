//! Laws of motion of cam followers.
//!
//! Polynomial laws and splines are exact, piece by piece. An SCCA law is integrated zone by zone
//! from its acceleration, and the whole is divided by the displacement it reaches: no constant of
//! the family is used.
//!
//! With a share `λ` of the stroke spent accelerating and `μ = 1 − λ` the zones are, up to a common
//! factor,
//!
//! ```text
//! s'' =  cos(π(x − λb)/2λb)/2λ           0 ≤ x ≤ λb
//!        1/2λ                            up to λ(1 − d)
//!        cos(π(x − λ(1 − d))/2λd)/2λ     up to λ
//! ```
//!
//! and their mirror image, stretched to `μ` and with the other sign.

use crate::ball::Ball;
use crate::cubic_spline::Spline;
use rug::Rational;

/// `amplitude · cos(π frequency (x − origin))` from `start` to `end`.
#[derive(Clone, Debug)]
pub(super) struct Zone {
    pub(super) start: Rational,
    pub(super) end: Rational,
    pub(super) amplitude: Rational,
    pub(super) frequency: Rational,
    pub(super) origin: Rational,
}

/// A polynomial in powers of `x − start`.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) start: Rational,
    pub(super) end: Rational,
    pub(super) coefficients: Vec<Rational>,
}

#[derive(Clone, Debug)]
pub(super) enum Form {
    Zones(Vec<Zone>),
    Pieces(Vec<Piece>),
}

/// A law of motion on the stroke `0 ≤ x ≤ 1`.
#[derive(Clone, Debug)]
pub struct Law(pub(super) Form);

/// A law that is symmetric about the middle of its stroke.
#[derive(Clone, Debug)]
pub enum Family {
    /// SCCA with sine share `b`, cosine share `d` and the rest constant.
    Scca {
        /// Sine share.
        b: Rational,
        /// Cosine share.
        d: Rational,
    },
    /// The polynomial 3-4-5.
    Polynomial345,
    /// The polynomial 4-5-6-7.
    Polynomial4567,
}

fn q(n: i32) -> Rational {
    Rational::from(n)
}

/// `p(α + βu)` in powers of `u`.
fn composed(p: &[Rational], alpha: &Rational, beta: &Rational) -> Vec<Rational> {
    let mut sum: Vec<Rational> = Vec::new();
    for c in p.iter().rev() {
        let mut next = vec![Rational::new(); sum.len() + 1];
        for (k, s) in sum.iter().enumerate() {
            next[k] += Rational::from(s * alpha);
            next[k + 1] += Rational::from(s * beta);
        }
        next[0] += c;
        sum = next;
    }
    sum
}

/// `p(x)` and all derivatives there, the highest last.
pub(super) fn derivatives(p: &[Rational], x: &Rational) -> Vec<Rational> {
    let mut factor = q(1);
    let taylor = composed(p, x, &q(1));
    let scaled = taylor.into_iter().enumerate().map(|(k, c)| {
        factor *= k.max(1) as u32;
        c * &factor
    });
    scaled.collect()
}

fn zones(b: &Rational, d: &Rational, fraction: &Rational) -> Vec<Zone> {
    let mut all = Vec::new();
    let other = q(1) - fraction;
    for (share, down) in [(fraction, false), (&other, true)] {
        // Distances from the end of the stroke on this side.
        let sine = Rational::from(share * b);
        let cosine = share * (q(1) - d);
        let amplitude = Rational::from(share * 2u32).recip();
        let wave = |part: &Rational| (Rational::from(share * part) * 2u32).recip();
        let parts = [
            (
                q(0),
                sine.clone(),
                b != &0,
                (b != &0).then(|| wave(b)),
                sine.clone(),
            ),
            (sine.clone(), cosine.clone(), sine != cosine, None, q(0)),
            (
                cosine.clone(),
                share.clone(),
                d != &0,
                (d != &0).then(|| wave(d)),
                cosine,
            ),
        ];
        let mut side: Vec<Zone> = Vec::new();
        for (from, to, exists, frequency, origin) in parts {
            if !exists {
                continue;
            }
            let mirror = |x: Rational| if down { q(1) - x } else { x };
            let (start, end) = if down {
                (mirror(to), mirror(from))
            } else {
                (from, to)
            };
            side.push(Zone {
                start,
                end,
                amplitude: if down {
                    -amplitude.clone()
                } else {
                    amplitude.clone()
                },
                frequency: frequency.unwrap_or_default(),
                origin: mirror(origin),
            });
        }
        if down {
            side.reverse();
        }
        all.extend(side);
    }
    all
}

fn halves(p: &[i32], fraction: &Rational) -> Vec<Piece> {
    let p: Vec<Rational> = p.iter().map(|&c| q(c)).collect();
    let up = Rational::from(fraction * 2u32);
    let down = q(2) - &up;
    let scaled = |c: Vec<Rational>, f: &Rational| -> Vec<Rational> {
        c.into_iter().map(|c| c * f).collect()
    };
    let rising = scaled(composed(&p, &q(0), &up.clone().recip()), &up);
    // 1 − 2μ s(1/2 − u/2μ) with u from the middle on.
    let half = Rational::from((1, 2));
    let mut falling = scaled(composed(&p, &half, &-down.clone().recip()), &-down);
    falling[0] += 1u32;
    let piece = |start: &Rational, end: Rational, coefficients| Piece {
        start: start.clone(),
        end,
        coefficients,
    };
    vec![
        piece(&q(0), fraction.clone(), rising),
        piece(fraction, q(1), falling),
    ]
}

impl Law {
    /// A symmetric law, its accelerating half stretched to `fraction` of the stroke.
    pub fn stretched(family: &Family, fraction: &Rational) -> Law {
        Law(match family {
            Family::Scca { b, d } => Form::Zones(zones(b, d, fraction)),
            Family::Polynomial345 => Form::Pieces(halves(&[0, 0, 0, 10, -15, 6], fraction)),
            Family::Polynomial4567 => {
                Form::Pieces(halves(&[0, 0, 0, 0, 35, -84, 70, -20], fraction))
            }
        })
    }

    /// `Σ c_k x^k / Σ c_k`; none if the sum is zero.
    pub fn polynomial(coefficients: &[Rational]) -> Option<Law> {
        let sum: Rational = coefficients.iter().sum();
        if sum == 0 {
            return None;
        }
        let scaled = coefficients.iter().map(|c| Rational::from(c / &sum));
        Some(Law(Form::Pieces(vec![Piece {
            start: q(0),
            end: q(1),
            coefficients: scaled.collect(),
        }])))
    }

    /// A spline on the given knots.
    pub fn spline(spline: &Spline, knots: &[Rational]) -> Law {
        let piece = |k: usize| {
            let jet = spline.eval_on(k, &knots[k]);
            let divisors = [1u32, 1, 2, 6];
            Piece {
                start: knots[k].clone(),
                end: knots[k + 1].clone(),
                coefficients: jet.into_iter().zip(divisors).map(|(v, d)| v / d).collect(),
            }
        };
        Law(Form::Pieces((0..knots.len() - 1).map(piece).collect()))
    }

    /// `s` and its first four derivatives at `x`: at a joint those to the right, at the end of the
    /// stroke those to the left.
    pub fn jet(&self, x: &Rational, bits: u32) -> [Ball; 5] {
        match &self.0 {
            Form::Pieces(pieces) => {
                let last = pieces.len() - 1;
                let k = pieces.iter().position(|p| *x < p.end).unwrap_or(last);
                let at = Rational::from(x - &pieces[k].start);
                let d = derivatives(&pieces[k].coefficients, &at);
                std::array::from_fn(|i| Ball::rational(bits, d.get(i).unwrap_or(&Rational::new())))
            }
            Form::Zones(zones) => {
                let mut state = State::zero(bits);
                let mut found = None;
                let last = zones.len() - 1;
                for (k, zone) in zones.iter().enumerate() {
                    if found.is_none() && (*x < zone.end || k == last) {
                        found = Some(state.inside(zone, x, bits));
                    }
                    state = state.inside(zone, &zone.end, bits).0;
                }
                let (at, [a, j, k]) = found.expect("there is a zone");
                let reached = &state.displacement;
                [at.displacement, at.velocity, a, j, k].map(|v| v / reached)
            }
        }
    }

    /// What the zones reach, by which they are to be divided; exactly one for pieces.
    pub(super) fn reached(&self, bits: u32) -> Ball {
        match &self.0 {
            Form::Pieces(_) => Ball::integer(bits, 1),
            Form::Zones(zones) => State::through(zones, bits).displacement,
        }
    }

    /// `∫ s dx` over the stroke.
    pub fn mean(&self, bits: u32) -> Ball {
        match &self.0 {
            Form::Pieces(pieces) => {
                let mut sum = Rational::new();
                for piece in pieces {
                    let width = Rational::from(&piece.end - &piece.start);
                    let mut power = width.clone();
                    for (k, c) in piece.coefficients.iter().enumerate() {
                        sum += Rational::from(c * &power) / (k as u32 + 1);
                        power *= &width;
                    }
                }
                Ball::rational(bits, &sum)
            }
            Form::Zones(zones) => {
                let end = State::through(zones, bits);
                end.area / end.displacement
            }
        }
    }
}

/// `∫ s`, `s` and `s'` up to a place, before division by what is reached.
#[derive(Clone, Debug)]
struct State {
    area: Ball,
    displacement: Ball,
    velocity: Ball,
}

impl State {
    fn zero(bits: u32) -> State {
        let zero = || Ball::integer(bits, 0);
        State {
            area: zero(),
            displacement: zero(),
            velocity: zero(),
        }
    }

    fn through(zones: &[Zone], bits: u32) -> State {
        let start = State::zero(bits);
        zones.iter().fold(start, |s, z| s.inside(z, &z.end, bits).0)
    }

    /// From the start of a zone to `x`: the state there, and `s''`, `s'''`, `s''''`.
    fn inside(&self, zone: &Zone, x: &Rational, bits: u32) -> (State, [Ball; 3]) {
        let ball = |r: &Rational| Ball::rational(bits, r);
        let t = ball(&Rational::from(x - &zone.start));
        let a = ball(&zone.amplitude);
        let half_square = (&t * &t).shift(-1);
        let drift = State {
            area: &self.area + &self.displacement * &t + &self.velocity * &half_square,
            displacement: &self.displacement + &self.velocity * &t,
            velocity: self.velocity.clone(),
        };
        if zone.frequency == 0 {
            let zero = Ball::integer(bits, 0);
            let third = &half_square * &t / Ball::integer(bits, 3);
            let state = State {
                area: drift.area + &a * &third,
                displacement: drift.displacement + &a * &half_square,
                velocity: drift.velocity + &a * &t,
            };
            return (state, [a, zero.clone(), zero]);
        }
        let w = Ball::pi(bits) * ball(&zone.frequency);
        let wave = |x: &Rational| (&w * ball(&Rational::from(x - &zone.origin))).sin_cos();
        let (s0, c0) = wave(&zone.start);
        let (s, c) = wave(x);
        let (first, second) = (&a / &w, &a / (&w * &w));
        let state = State {
            area: drift.area + &second * (&c0 * &t - (&s - &s0) / &w) - &first * &s0 * &half_square,
            displacement: drift.displacement + &second * (&c0 - &c) - &first * &s0 * &t,
            velocity: drift.velocity + &first * (&s - &s0),
        };
        let fourth = -(&a * &w * &w * &c);
        (state, [&a * &c, -(&a * &w * &s), fourth])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r(n: i32, d: i32) -> Rational {
        Rational::from((n, d))
    }

    #[test]
    fn cycloidal_and_harmonic_values() {
        let law = |b, d| Law::stretched(&Family::Scca { b, d }, &r(1, 2));
        let pi = Ball::pi(128);
        // s(1/4) = 1/4 − 1/2π; C_a = 2π.
        let jet = law(r(1, 2), r(1, 2)).jet(&r(1, 4), 128);
        let expected = Ball::rational(128, &r(1, 4)) - pi.shift(1).recip();
        assert!(jet[0].overlaps(&expected) && jet[0].accuracy_bits() > 110);
        assert!(jet[2].overlaps(&pi.shift(1)));
        // (1 − cos πx)/2 at x = 1/3.
        let jet = law(r(0, 1), r(1, 1)).jet(&r(1, 3), 128);
        assert!(jet[0].contains(&r(1, 4)));
        let mean = law(r(1, 5), r(1, 3)).mean(128);
        assert!(mean.contains(&r(1, 2)) && mean.accuracy_bits() > 110);
    }

    #[test]
    fn halves_fit_together() {
        for family in [
            Family::Polynomial345,
            Family::Polynomial4567,
            Family::Scca {
                b: r(1, 5),
                d: r(2, 5),
            },
        ] {
            let law = Law::stretched(&family, &r(1, 3));
            let tiny = r(1, 1 << 30);
            let [before, after] = [r(1, 3) - tiny, r(1, 3)].map(|x| law.jet(&x, 128));
            let close = |a: &Ball, b: &Ball| (a - b).magnitude().to_f64() < 1e-5;
            for k in 0..3 {
                assert!(close(&before[k], &after[k]), "{family:?} {k}");
            }
            let end = law.jet(&r(1, 1), 128);
            assert!(end[0].contains(&r(1, 1)) && end[1].contains(&r(0, 1)));
        }
    }
}
