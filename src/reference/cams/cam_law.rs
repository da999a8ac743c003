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
use crate::lu::BallLu;
use rug::{Integer, Rational};

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

/// How a clamped spline changes with one of its data: a piecewise cubic σ that vanishes outside.
///
/// With an ordinate, σ is the spline through one there and zero at the other knots. With a knot
/// x_j, σ is C¹ and takes the value `−s'(x_j)` there and zero at the other knots, and its second
/// derivative jumps by minus the jump of `s'''`: differentiate `s(x_j) = y_j` and the continuity of
/// `s''` there.
pub(super) struct Variation {
    /// The value of the varied datum.
    pub(super) datum: Ball,
    /// `∫ σ dx`.
    pub(super) integral: Ball,
    /// Jumps of σ', σ'', σ''' at each knot.
    pub(super) jumps: Vec<Vec<Ball>>,
}

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
    // Repeated synthetic division.
    let mut taylor = p.to_vec();
    let degree = p.len().saturating_sub(1);
    for i in 0..degree {
        for j in (i..degree).rev() {
            let carried = Rational::from(&taylor[j + 1] * x);
            taylor[j] += carried;
        }
    }
    derivatives_at_zero(&taylor)
}

/// `p(0)` and all derivatives there.
pub(super) fn derivatives_at_zero(p: &[Rational]) -> Vec<Rational> {
    let mut factor = Integer::from(1);
    let scaled = p.iter().enumerate().map(|(k, c)| {
        factor *= k.max(1) as u32;
        Rational::from(c * &factor)
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

    /// The variations of a clamped spline with its inner knots and ordinates; none of other laws.
    pub(super) fn spline_variations(&self, bits: u32) -> Vec<Variation> {
        let Form::Pieces(pieces) = &self.0 else {
            return Vec::new();
        };
        let n = pieces.len();
        if n < 2 || pieces.iter().any(|p| p.coefficients.len() != 4) {
            return Vec::new();
        }
        let ball = |r: &Rational| Ball::rational(bits, r);
        let zero = || Ball::integer(bits, 0);
        let h: Vec<Ball> = pieces
            .iter()
            .map(|p| ball(&Rational::from(&p.end - &p.start)))
            .collect();
        let inverse: Vec<Ball> = h.iter().map(Ball::recip).collect();
        // Continuity of σ'' at the inner knots, its slopes there being unknown.
        let row = |i: usize| {
            let mut row = vec![zero(); n - 1];
            row[i - 1] = (&inverse[i - 1] + &inverse[i]).shift(1);
            if i > 1 {
                row[i - 2] = inverse[i - 1].clone();
            }
            if i < n - 1 {
                row[i] = inverse[i].clone();
            }
            row
        };
        let Some(matrix) = BallLu::new((1..n).map(row).collect()) else {
            return Vec::new();
        };
        let (three, six) = (Ball::integer(bits, 3), Ball::integer(bits, 6));
        let varied = |j: usize, datum: Ball, value: Ball, bend: Ball| {
            let mut v = vec![zero(); n + 1];
            v[j] = value;
            let chord: Vec<Ball> = (0..n).map(|i| (&v[i + 1] - &v[i]) * &inverse[i]).collect();
            let right = |i: usize| {
                let sum = &chord[i - 1] * &inverse[i - 1] + &chord[i] * &inverse[i];
                let sum = sum * &three;
                if i == j { sum - bend.shift(-1) } else { sum }
            };
            let mut m = vec![zero()];
            m.extend(matrix.solve(&(1..n).map(right).collect::<Vec<_>>()));
            m.push(zero());
            // Of each piece: σ'' at its start and at its end, and σ'''.
            let piece = |i: usize| {
                let (a, b, d) = (&m[i], &m[i + 1], &chord[i] * &six);
                let start = (&d - a.shift(2) - b.shift(1)) * &inverse[i];
                let end = (a.shift(1) + b.shift(2) - &d) * &inverse[i];
                let third = ((a + b) * &six - d.shift(1)) * &inverse[i] * &inverse[i];
                [start, end, third]
            };
            let of: Vec<[Ball; 3]> = (0..n).map(piece).collect();
            let jump = |k: usize| {
                let second = match k {
                    0 => of[0][0].clone(),
                    _ if k == n => -&of[n - 1][1],
                    _ if k == j => bend.clone(),
                    _ => zero(),
                };
                let before = if k > 0 { of[k - 1][2].clone() } else { zero() };
                let after = if k < n { of[k][2].clone() } else { zero() };
                vec![zero(), second, after - before]
            };
            let area = |i: usize| {
                let bent = (&m[i] - &m[i + 1]) * &h[i] / &six;
                ((&v[i] + &v[i + 1]) + bent).shift(-1) * &h[i]
            };
            Variation {
                datum,
                integral: (0..n).fold(zero(), |sum, i| sum + area(i)),
                jumps: (0..=n).map(jump).collect(),
            }
        };
        let inner = (1..n).flat_map(|j| {
            let (before, at) = (&pieces[j - 1].coefficients, &pieces[j].coefficients);
            // Minus the jump of s''' = 6 c₃.
            let bend = ball(&(Rational::from(&before[3] - &at[3]) * 6u32));
            let knot = varied(j, ball(&pieces[j].start), -ball(&at[1]), bend);
            let ordinate = varied(j, ball(&at[0]), Ball::integer(bits, 1), zero());
            [knot, ordinate]
        });
        inner.collect()
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
                let mut jet = [at.displacement, at.velocity, a, j, k].map(|v| v / reached);
                // Both sides of the stroke gain the same velocity.
                if *x == 0 || *x == 1 {
                    let end = i64::from(*x == 1);
                    (jet[0], jet[1]) = (Ball::integer(bits, end), Ball::integer(bits, 0));
                }
                jet
            }
        }
    }

    /// Returns the lift of the zones, by which they are divided; exactly one for pieces.
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

/// Sine and cosine of `π t`, exactly where `2t` is a whole number: elsewhere neither is zero.
fn sin_cos_of_half_turns(t: &Rational, bits: u32) -> (Ball, Ball) {
    let quarters = Rational::from(t * 2u32);
    if !quarters.is_integer() {
        return (Ball::pi(bits) * Ball::rational(bits, t)).sin_cos();
    }
    let (s, c) = match quarters.numer().mod_u(4) {
        0 => (0, 1),
        1 => (1, 0),
        2 => (0, -1),
        _ => (-1, 0),
    };
    (Ball::integer(bits, s), Ball::integer(bits, c))
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
        let wave = |x: &Rational| {
            let turns = Rational::from(x - &zone.origin) * &zone.frequency;
            sin_cos_of_half_turns(&turns, bits)
        };
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
mod tests;
