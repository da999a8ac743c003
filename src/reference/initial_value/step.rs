//! One step: the Taylor polynomial from the midpoint of the start, and the proof of its error.
//!
//! # Proof
//! Let p be the polynomial of degree N from an exact start m, `τ = s/h`, and `d_i ≥ |p_i′ − h
//! f_i(t, p)|` its defect on the step ([`Remainders`] with states that are exactly p). For a
//! solution y of the differential equation with `|y_i(0) − m_i| ≤ a_i` the difference `e = y − p`
//! satisfies `e′ = h J̄ e + d̃`, `|d̃| ≤ d`, as long as `|e_i| ≤ T_i`, where J̄ is a mean of
//! Jacobians at points within T of p. With the majorant M of h J over that tube, `|e| ≤ exp(M)(a +
//! d)`. If this is less than T in every component, e cannot leave the tube before the end of the
//! step: the solution exists up to there, and lies in it. No a-priori box has to be found first.
//!
//! Two solutions in the tube differ by `Φ(τ)` times the difference of their starts, Φ within
//! [`Flow`]: errors of the start are carried on by it, and `exp(M) d` is added.

use super::coefficient::Coefficient;
use super::enclosed::Enclosed;
use super::expansion::{Expansion, Obstacle};
use super::remainder::{Remainders, powers};
use super::set::ErrorSet;
use super::variation::{Flow, Scaled};
use super::{Constants, Field};
use crate::{Ball, Mag};
use rug::{Float, Rational};

/// Bits between the error that a step may add and the rounding of the working precision.
const GUARD: i64 = 12;

/// Terms of the linearised flow at first.
const FLOW_TERMS: usize = 18;

/// Terms of the linearised flow at most: beyond them the cancellation of `exp(−x)` in doubles is as
/// large as what is left out.
const MOST_FLOW_TERMS: usize = 90;

/// The largest relative error of a linearised flow by truncation and rounding.
const LARGEST_TRUNCATION: f64 = 1e-4;

/// A state of the motion: an exact time, a midpoint and the sets of its errors.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub time: Rational,
    pub mid: Vec<Float>,
    /// A matrix that the linearised flow carries along; its errors are those sets that follow the
    /// one of the states, column by column.
    pub carried: Option<Enclosed>,
    pub errors: ErrorSet,
}

/// Reason why a step of some length is not proved.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Failure {
    /// A rate or a derivative of it without a bound, however short the step is.
    Obstacle {
        in_jacobian: bool,
        obstacle: Obstacle,
    },
    /// The steps become too short.
    Short { pole: f64 },
    /// The errors are too large for a proof.
    Wide,
}

/// A step that is proved.
#[derive(Clone, Debug)]
pub(super) struct Step {
    start: Place,
    /// The length, negative where the motion is followed backwards.
    pub h: f64,
    /// Coefficients of the states in powers of the time since the start.
    p: Vec<Vec<Float>>,
    /// The error of the polynomial from the midpoint.
    error: Vec<Mag>,
    flow: Flow,
    weights: Vec<f64>,
    bits: u32,
}

/// The field, constants and precision of a step.
pub(super) struct Setting<'a> {
    pub field: &'a Field,
    pub constants: &'a Constants,
    pub bits: u32,
    pub order: usize,
}

/// A power of two near a magnitude.
fn weight(size: Mag) -> f64 {
    let e = size.exponent().unwrap_or(0).clamp(-200, 200);
    (e as f64).exp2()
}

/// A number of few bits at most as large.
fn short(h: f64) -> f64 {
    f64::from_bits(h.to_bits() & !((1u64 << 44) - 1))
}

impl Setting<'_> {
    /// The coefficients of the states and of all values of the program from a place on.
    pub fn expand(
        &self,
        place: &Place,
    ) -> Result<(Expansion<'_, Float>, Vec<Vec<Float>>), Obstacle> {
        let field = self.field;
        let time = Ball::rational(self.bits, &place.time);
        let mut expansion = Expansion::new(&field.rates, self.bits);
        expansion.begin(&self.constants.rates, &time, &place.mid)?;
        let mut p: Vec<Vec<Float>> = place.mid.iter().map(|m| vec![m.clone()]).collect();
        let one = Float::with_val(self.bits, 1);
        for k in 1..=self.order {
            let next = field.outputs.iter().map(|slot| {
                let rate = expansion.coefficients[*slot].get(k - 1);
                rate.map_or_else(|| Float::new(self.bits), |rate| rate.divided(k as i64))
            });
            let next: Vec<Float> = next.collect();
            expansion.advance(&next, &one);
            p.iter_mut().zip(next).for_each(|(p, next)| p.push(next));
        }
        Ok((expansion, p))
    }

    /// The defect of the polynomials over `|s| ≤ |h|`.
    fn defect(
        &self,
        expansion: &Expansion<'_, Float>,
        p: &[Vec<Float>],
        h: f64,
    ) -> Result<Vec<Mag>, Obstacle> {
        let h = Mag::from_f64(h);
        let exact = vec![Mag::ZERO; p.len()];
        let bounds = Remainders::new(expansion, h, &exact)?;
        let powers = powers(h, self.order + 1);
        let defect = self.field.outputs.iter().zip(p).map(|(slot, p)| {
            // p_k is the rounded quotient of a coefficient of the rate by k.
            let rounding = p.iter().enumerate().fold(Mag::ZERO, |sum, (k, c)| {
                let size = Mag::above(c).mul(powers[k]);
                sum.add(size.mul(Mag::from_f64(k as f64)))
            });
            let rounding = rounding.shift(-i64::from(self.bits));
            // The coefficient of the rate that has no counterpart in the polynomial.
            let last = expansion.coefficients[*slot].get(self.order);
            let last = last.map_or(Mag::ZERO, |c| Mag::above(c).mul(powers[self.order + 1]));
            h.mul(bounds.radius(*slot)).add(rounding).add(last)
        });
        Ok(defect.collect())
    }

    /// A length for which the last coefficients are as small as the working precision.
    fn first_length(&self, p: &[Vec<Float>]) -> f64 {
        let goal = -(f64::from(self.bits) - GUARD as f64);
        let log2 = |x: &Float| {
            let size = Mag::above(x);
            size.exponent().map(|e| e as f64)
        };
        let mut length = f64::INFINITY;
        let largest = p.iter().filter_map(|p| log2(&p[0]));
        let largest = largest.fold(f64::NEG_INFINITY, f64::max);
        for p in p {
            let own = log2(&p[0]).unwrap_or(largest);
            let scale = own.max(largest - 40.0).max(-1000.0);
            for k in self.order.saturating_sub(2)..=self.order {
                if let Some(last) = log2(&p[k]) {
                    length = length.min(((scale + goal - last) / k as f64).exp2());
                }
            }
        }
        length
    }

    /// A step from a place, forwards or backwards, at most so long.
    pub fn step(&self, place: &Place, backward: bool, longest: f64) -> Result<Step, Failure> {
        let in_rates = |obstacle| Failure::Obstacle {
            in_jacobian: false,
            obstacle,
        };
        let (expansion, p) = self.expand(place).map_err(in_rates)?;
        let sign = if backward { -1.0 } else { 1.0 };
        let mut length = short(self.first_length(&p).min(longest));
        let floor = length * (-60f64).exp2();
        let mut found = None;
        let mut obstacle = None;
        let mut last_excess = f64::INFINITY;
        for _ in 0..64 {
            if !(length > floor) {
                break;
            }
            match self.defect(&expansion, &p, sign * length) {
                Err(o) => {
                    obstacle = Some(o);
                    length = short(length * 0.5);
                    continue;
                }
                Ok(defect) => {
                    let excess = self.excess(&p, length, &defect);
                    found = Some((length, defect));
                    // Rounding does not fall with the length as truncation does.
                    let is_rounding = excess > last_excess - 4.0;
                    if excess <= 0.0 || is_rounding {
                        break;
                    }
                    last_excess = excess;
                    let share = (-excess / self.order as f64).exp2().clamp(0.25, 0.97);
                    length = short(length * share);
                }
            }
        }
        let Some((mut length, mut defect)) = found else {
            return Err(match obstacle {
                Some(obstacle) => in_rates(obstacle),
                None => Failure::Short { pole: length },
            });
        };
        // Ever faster: of a solution whose coefficients vanish the first length is no guess.
        for k in 0..16 {
            match self.proved(place, (&expansion, &p[..]), sign * length, &defect) {
                Err(Failure::Wide) => {}
                done => return done,
            }
            length = short(length * (-1.0 - f64::from(k / 2)).exp2());
            defect = self
                .defect(&expansion, &p, sign * length)
                .map_err(in_rates)?;
        }
        Err(Failure::Wide)
    }

    /// The binary logarithm of the largest defect in units of what is allowed.
    fn excess(&self, p: &[Vec<Float>], h: f64, defect: &[Mag]) -> f64 {
        let sizes = sizes(p, h);
        let largest = sizes.iter().fold(Mag::ZERO, |m, s| m.max(*s));
        let mut excess = f64::NEG_INFINITY;
        for (size, d) in sizes.iter().zip(defect) {
            let scale = size.max(largest.shift(-40)).exponent().unwrap_or(0);
            let allowed = scale - i64::from(self.bits) + GUARD;
            if let Some(d) = d.exponent() {
                excess = excess.max((d - allowed) as f64);
            }
        }
        excess
    }

    /// The proof for a length.
    pub fn proved(
        &self,
        place: &Place,
        (expansion, p): (&Expansion<'_, Float>, &[Vec<Float>]),
        h: f64,
        defect: &[Mag],
    ) -> Result<Step, Failure> {
        let sizes = sizes(p, h);
        let largest = sizes.iter().fold(Mag::ZERO, |m, s| m.max(*s));
        // In units of a state that is nothing but rounding, rounded slopes by others are not small.
        let least = largest.shift(-40);
        let weights: Vec<f64> = sizes.iter().map(|s| weight(s.max(least))).collect();
        let start = place.errors.radii();
        let all: Vec<Mag> = start.iter().zip(defect).map(|(a, d)| a.add(*d)).collect();
        // Narrower tubes would not make the Jacobian's doubles any better.
        let mut tubes: Vec<Mag> = all
            .iter()
            .zip(&sizes)
            .map(|(e, size)| e.shift(4).max(size.shift(-56)).max(Mag::power_of_two(-900)))
            .collect();
        let time = Ball::rational(64, &place.time);
        let highest = self.order.max(MOST_FLOW_TERMS);
        let mut order = FLOW_TERMS.min(self.order);
        for _ in 0..16 {
            let states = Scaled::new(p, h, order);
            let flow = Flow::new(
                self.field,
                &self.constants.jacobian,
                (&time, h),
                &states,
                &tubes,
                &weights,
            );
            let flow = match flow {
                Ok(flow) => flow,
                // A shorter step may do.
                Err(obstacle) if tubes.iter().zip(&sizes).any(|(t, s)| *t > s.shift(-40)) => {
                    let _ = obstacle;
                    return Err(Failure::Wide);
                }
                Err(obstacle) => {
                    return match h.abs() > (-60f64).exp2() * place.time.to_f64().abs().max(1e-30) {
                        true => Err(Failure::Wide),
                        false => Err(Failure::Obstacle {
                            in_jacobian: true,
                            obstacle,
                        }),
                    };
                }
            };
            let reached = flow.growth(&all);
            if !reached.iter().all(|r| r.is_finite()) {
                return Err(Failure::Wide);
            }
            if !reached
                .iter()
                .zip(&tubes)
                .all(|(reached, tube)| reached < tube)
            {
                tubes = reached
                    .iter()
                    .zip(&tubes)
                    .map(|(r, t)| r.shift(1).max(*t))
                    .collect();
                continue;
            }
            // The rates are defined, and as smooth as their formulas, all over the tube.
            if Remainders::new(expansion, Mag::from_f64(h), &tubes).is_err() {
                return Err(Failure::Wide);
            }
            let error = flow.truncation(&weights);
            if error > 1e-9 && order < highest {
                order = flow.order_for(1e-12).max(order + 12).min(highest);
                continue;
            }
            // Errors of the start would grow by it at each step, even where the motion contracts
            // them.
            if !(error < LARGEST_TRUNCATION) {
                return Err(Failure::Wide);
            }
            return Ok(Step {
                start: place.clone(),
                h,
                p: p.to_vec(),
                error: flow.growth(defect),
                flow,
                weights,
                bits: self.bits,
            });
        }
        Err(Failure::Wide)
    }
}

/// `Σ |p_k| |h|^k`.
fn sizes(p: &[Vec<Float>], h: f64) -> Vec<Mag> {
    let powers = powers(Mag::from_f64(h), p[0].len());
    let size = |p: &Vec<Float>| {
        let terms = p.iter().zip(&powers);
        terms.fold(Mag::ZERO, |sum, (c, power)| {
            sum.add(Mag::above(c).mul(*power))
        })
    };
    p.iter().map(size).collect()
}

impl Step {
    /// The time of the start.
    pub fn start(&self) -> &Rational {
        &self.start.time
    }

    /// The time of the end.
    pub fn end(&self) -> Rational {
        let h = Rational::from_f64(self.h).expect("a finite length");
        &self.start.time + h
    }

    /// The solution from the midpoint of the start, without the errors of the start, and the
    /// linearised flow, at all times within `reach` of a time since the start.
    fn along(&self, since: &Rational, reach: Mag) -> (Vec<Ball>, Enclosed) {
        let bits = self.bits + 16;
        let s = Ball::rational(bits, since).widened(reach);
        let values = self.p.iter().zip(&self.error).map(|(p, error)| {
            let zero = Ball::integer(bits, 0);
            let sum = p
                .iter()
                .rev()
                .fold(zero, |sum, c| &sum * &s + Ball::new(c.clone(), Mag::ZERO));
            sum.widened(*error)
        });
        let h = Rational::from_f64(self.h).expect("a finite length");
        let tau = since / h;
        let near = tau.to_f64().clamp(0.0, 1.0);
        let share = reach.div(Mag::from_f64(self.h)).to_f64();
        let flow = self.flow.at(near, (share + near * f64::EPSILON).next_up());
        (values.collect(), flow)
    }

    /// The states at a time of the step.
    pub fn at(&self, time: &Rational) -> Vec<Ball> {
        self.over(time, time)
    }

    /// The states at all times from one time of the step to another.
    pub fn over(&self, from: &Rational, to: &Rational) -> Vec<Ball> {
        let middle = Rational::from(from + to) / 2u32;
        let half = Ball::rational(64, &(Rational::from(to - from) / 2u32)).magnitude();
        let (values, flow) = self.along(&(middle - &self.start.time), half);
        let errors = self.start.errors.radii_after(&flow).swap_remove(0);
        values
            .into_iter()
            .zip(errors)
            .map(|(value, error)| value.widened(error))
            .collect()
    }

    /// The matrix that is carried along at a time of the step, row by row; none where there is none.
    pub fn carried(&self, time: &Rational) -> Vec<Ball> {
        let Some(carried) = &self.start.carried else {
            return Vec::new();
        };
        let (_, flow) = self.along(&Rational::from(time - &self.start.time), Mag::ZERO);
        let errors = self.start.errors.radii_after(&flow);
        let image = flow.times(carried);
        let entry = |k: usize| {
            let error = Mag::from_f64(image.rad[k]).add(errors[1 + k % image.n][k / image.n]);
            Ball::exact(64, image.mid[k]).widened(error)
        };
        (0..image.mid.len()).map(entry).collect()
    }

    /// The place at the end.
    pub fn next(&self) -> Place {
        let time = self.end();
        let (values, flow) = self.along(&Rational::from(&time - &self.start.time), Mag::ZERO);
        let rounded: Vec<Ball> = values.iter().map(|v| v.with_prec(self.bits)).collect();
        let mut extra = vec![rounded.iter().map(Ball::rad).collect()];
        let carried = self.start.carried.as_ref().map(|carried| {
            let image = flow.times(carried);
            extra.extend(image.columns_of_radii());
            Enclosed::exact(image.n, image.mid)
        });
        Place {
            time,
            carried,
            mid: rounded.iter().map(|b| b.mid().clone()).collect(),
            errors: self.start.errors.moved(&flow, &extra, &self.weights),
        }
    }

    /// The ratio of the last two coefficients: the distance of a singularity, roughly.
    pub fn pole(&self) -> f64 {
        let n = self.p[0].len() - 1;
        let ratio = |p: &Vec<Float>| {
            let ratio = Float::with_val(53, &p[n - 1] / &p[n]).to_f64();
            if ratio.is_finite() {
                ratio
            } else {
                f64::INFINITY
            }
        };
        let all = self.p.iter().map(ratio);
        all.fold(f64::INFINITY, |a, b| if b.abs() < a.abs() { b } else { a })
    }

    /// Bounds on the magnitudes of the states over the step.
    pub fn sizes(&self) -> Vec<Mag> {
        sizes(&self.p, self.h)
    }
}
