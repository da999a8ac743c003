//! Fourier series of a cam cycle.
//!
//! In the signs of Gembara & Senyk, with θ the shaft's angle:
//!
//! ```text
//! f(θ) = a_0 + Σ_n (a_n cos nθ + b_n sin nθ)                                             (4)
//! a_0 = (1/2π) ∫ f dθ,  a_n = (1/π) ∫ f cos nθ dθ,  b_n = (1/π) ∫ f sin nθ dθ            (5)
//! f(θ) = a_0 + Σ_n D_n cos(nθ + δ_n),  a_n = D_n cos δ_n,  b_n = −D_n sin δ_n            (6)
//! ```
//!
//! With `F` the transform of a stroke's velocity, strokes of `B_r` and `B_f` turns centred at `θ_r`
//! and `θ_f` and the lift `h`
//!
//! ```text
//! D_n e^{iδ_n} = a_n − i b_n = (h/iπn) [e^{−inθ_r} F_r(2πnB_r) − e^{−inθ_f} F_f(2πnB_f)].
//! ```
//!
//! Angles are kept in turns; `n` times an angle is reduced exactly, so a coefficient is that of the
//! angles given, for every `n` up to 10⁶.
//!
//! # Accuracy
//! Errors of `a_n` and `b_n`, in `2⁻⁵³` of the largest of the case's eight pairs, worst found over
//! 4000 random cases in each of eight regions (all laws, strokes of 0.001 to 0.45 turns, harmonics
//! up to 9·10⁵; seed 9): 90, where the budget is 128 for a condition of one;
//! `mechaudit audit cam-fourier-series` repeats the search. A law with two even halves has a
//! transform without imaginary part. Each coefficient is a difference of two strokes' shares: near
//! the zeros of `F`, and where the shares cancel, the error is that of the shares; but not in a
//! lift so short that `n` of them are an eighth of a turn, whose shares differ from `e^{−inθ}` by
//! little and are summed by what they differ.
//!
//! # Sources
//! Gembara & Senyk, eqs (4)–(6); the period there is the shaft's turn.

mod quadrature;
mod tail;
mod transform;
mod turns;

use super::cam_law::{CamCycle, MotionLaw, Shape};
use crate::double_double::Dd;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use tail::Decay;
use transform::{SHORT, Transform};
use turns::Turns;

/// The largest harmonic that is given.
pub const LAST_HARMONIC: u32 = 1_000_000;

/// One harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// n.
    pub order: u32,
    /// `a_n`, in the unit of the lift.
    pub a: f64,
    /// `b_n`, in the unit of the lift.
    pub b: f64,
}

impl Harmonic {
    /// `D_n = √(a_n² + b_n²)`.
    pub fn amplitude(&self) -> f64 {
        self.a.hypot(self.b)
    }

    /// `δ_n = atan2(−b_n, a_n)`, in radians.
    pub fn phase(&self) -> f64 {
        (-self.b).atan2(self.a)
    }

    /// `a_n − i b_n = D_n e^{iδ_n}`.
    pub fn complex(&self) -> Complex64 {
        Complex64::new(self.a, -self.b)
    }
}

/// Why there is no harmonic.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FourierSeriesError {
    /// A harmonic that is not 1 to 10⁶.
    #[error("harmonic {order} is not between 1 and {LAST_HARMONIC}")]
    Order {
        /// Its number.
        order: u32,
    },
    /// A tolerance that is not positive and finite.
    #[error("tolerance {value} is not a positive number")]
    Tolerance {
        /// The number.
        value: f64,
    },
    /// More harmonics than are given.
    #[error(
        "{needed:e} harmonics would be needed for a tolerance of {tolerance:e}, at most {LAST_HARMONIC} are given"
    )]
    TooMany {
        /// How many.
        needed: f64,
        /// For what.
        tolerance: f64,
    },
    /// The sum does not converge absolutely.
    #[error("the harmonics of the {derivative}. derivative have no finite sum")]
    Diverges {
        /// Derivative of the displacement.
        derivative: u32,
    },
}

/// A stroke in the series.
#[derive(Clone, Debug)]
struct Part {
    transform: Transform,
    decays: Vec<Decay>,
    turns: f64,
    /// The angles whose sum is that of the centre.
    before: Vec<f64>,
}

impl Part {
    fn new(law: &MotionLaw, turns: f64, before: &[f64]) -> Part {
        let transform = Transform::new(law);
        Part {
            decays: tail::decays(law, &transform),
            transform,
            turns,
            before: before.to_vec(),
        }
    }

    /// `e^{−inθ}`
    fn wave(&self, n: f64) -> Complex64 {
        let centre = Turns::multiple(n, self.turns).times(self.transform.centre);
        let angle = self
            .before
            .iter()
            .fold(centre, |sum, &turns| sum.plus(Turns::multiple(n, turns)));
        angle.cis().conj()
    }

    /// `e^{−inθ} F`.
    fn share(&self, n: f64) -> Complex64 {
        self.wave(n) * self.transform.at(Turns::multiple(n, self.turns))
    }

    /// The difference of the shares of two strokes with a dwell between them, where all of it is so
    /// short that they cancel: `e^{−inθ_r} [1 − e^{−iΔ} + (F_r − 1) − e^{−iΔ} (F_f − 1)]`, Δ the
    /// angle from centre to centre.
    fn short_difference(&self, fall: &Part, dwell: f64, n: f64) -> Option<Complex64> {
        let [up, down] = [self, fall].map(|p| Turns::multiple(n, p.turns));
        let after = up.minus(up.times(self.transform.centre));
        let before = down.times(fall.transform.centre);
        let angle = after.plus(Turns::multiple(n, dwell)).plus(before);
        if n * (self.turns + dwell + fall.turns) > SHORT {
            return None;
        }
        let (up, down) = (self.transform.less_one(up)?, fall.transform.less_one(down)?);
        let step = angle.cis_less_one().conj();
        Some(self.wave(n) * (up - down - step * (1.0 + down)))
    }

    /// `T_p/β^p`, if the law has a bound of that order.
    fn bound(&self, order: i32) -> Option<f64> {
        let decay = self.decays.iter().find(|d| d.order == order)?;
        Some(decay.variation / (TAU * self.turns).powi(order))
    }
}

/// The Fourier series of a cycle.
///
/// ```
/// use mechaudit_solvers::cam_law::{CamCycle, MotionLaw, Stroke};
/// use mechaudit_solvers::fourier_series::FourierSeries;
/// // Simple harmonic motion up and down, half a turn each, is (h/2)(1 − cos θ).
/// let half = || Stroke { law: MotionLaw::simple_harmonic(), turns: 0.5 };
/// let series = FourierSeries::new(&CamCycle::rise_return(2.0, half(), half())?);
/// assert_eq!(series.mean(), 1.0);
/// assert!((series.harmonic(1)?.a + 1.0).abs() < 1e-15);
/// assert_eq!(series.harmonic(8)?.amplitude(), 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FourierSeries {
    lift: f64,
    mean: f64,
    high_dwell: f64,
    parts: Vec<Part>,
}

/// `∫_0^1 s dx` and what it lacks of one. A polynomial's may be next to zero or to one.
fn means(law: &MotionLaw) -> [f64; 2] {
    let halves = |middle: f64| {
        let fraction = law.acceleration_fraction();
        (1.0 - fraction) + 4.0 * middle * (2.0 * fraction - 1.0)
    };
    let mean = match law.shape() {
        Shape::Polynomial(p) => p.mean(),
        Shape::Tabulated(t) => Dd::from(t.mean()),
        // ∫ of the accelerating half, from 0 to 1/2.
        Shape::Scca(s) => Dd::from(halves(s.half_mean())),
        Shape::Symmetric(p) => Dd::from(halves(p.half_mean())),
    };
    [mean, Dd::from(1.0) - mean].map(Dd::value)
}

impl FourierSeries {
    /// The series of a cycle. Of one without a return it is that of the displacement less
    /// `lift · θ/2π`, which is what repeats.
    pub fn new(cycle: &CamCycle) -> FourierSeries {
        let (h, rise) = (cycle.lift(), cycle.rise());
        let (start, top) = (cycle.start(), cycle.high_dwell());
        let mut parts = vec![Part::new(&rise.law, rise.turns, &[start])];
        let mean = match cycle.fall() {
            Some(fall) => {
                parts.push(Part::new(&fall.law, fall.turns, &[start, rise.turns, top]));
                let ([up, _], [_, down]) = (means(&rise.law), means(&fall.law));
                rise.turns * up + top + fall.turns * down
            }
            // Of f − hθ/2π over a turn that begins with the rise.
            None => {
                let since = start - start.floor();
                0.5 - rise.turns * means(&rise.law)[1] - since
            }
        };
        FourierSeries {
            lift: h,
            mean: h * mean,
            high_dwell: top,
            parts,
        }
    }

    /// `a_0`.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Harmonic `n`.
    ///
    /// # Errors
    /// [`FourierSeriesError::Order`].
    pub fn harmonic(&self, order: u32) -> Result<Harmonic, FourierSeriesError> {
        if !(1..=LAST_HARMONIC).contains(&order) {
            return Err(FourierSeriesError::Order { order });
        }
        let n = f64::from(order);
        let short = match &self.parts[..] {
            [rise, fall] => rise.short_difference(fall, self.high_dwell, n),
            _ => None,
        };
        let shares = || self.parts.iter().map(|p| p.share(n));
        let z = short.or_else(|| shares().reduce(|up, down| up - down));
        let z = z.unwrap_or_default();
        let scale = self.lift / (PI * n);
        // z/i = Im z − i Re z.
        Ok(Harmonic {
            order,
            a: scale * z.im,
            b: scale * z.re,
        })
    }

    /// Harmonics 1 to `last`.
    ///
    /// # Errors
    /// [`FourierSeriesError::Order`].
    pub fn harmonics(&self, last: u32) -> Result<Vec<Harmonic>, FourierSeriesError> {
        (1..=last).map(|n| self.harmonic(n)).collect()
    }

    /// An upper bound on `Σ_{n>N} n^k D_n`, what the `k`-th derivative in the shaft's angle loses
    /// without the harmonics beyond `N`: `Σ_strokes h T_p β^−p/(π (p − k) N^(p−k))`, the best over
    /// `p`. Infinite where no such sum is bounded.
    pub fn tail_bound(&self, after: u32, derivative: u32) -> f64 {
        let n = f64::from(after.max(1));
        let k = derivative as i32;
        let bounds = self.parts.iter().map(|part| {
            let orders = part.decays.iter().map(|d| d.order).filter(|p| *p > k);
            let of_order = |p: i32| {
                let variation = part.bound(p).unwrap_or(f64::INFINITY);
                variation / (f64::from(p - k) * n.powi(p - k))
            };
            orders.map(of_order).fold(f64::INFINITY, f64::min)
        });
        let sum: f64 = bounds.sum();
        // Beyond the first harmonic the bound starts at N = 1; with none taken, that one is added.
        let first = match after {
            0 => self.harmonic(1).map_or(f64::INFINITY, |h| h.amplitude()),
            _ => 0.0,
        };
        self.lift.abs() / PI * sum * (1.0 + 1e-14) + first * (1.0 + 1e-12)
    }

    /// The number of harmonics that leave at most `tolerance` (in the unit of the lift) of the
    /// `k`-th derivative in the shaft's angle.
    ///
    /// # Errors
    /// A tolerance that is not positive; a derivative whose harmonics have no finite sum; more
    /// than 10⁶ harmonics.
    pub fn harmonics_for(
        &self,
        tolerance: f64,
        derivative: u32,
    ) -> Result<u32, FourierSeriesError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(FourierSeriesError::Tolerance { value: tolerance });
        }
        if self.tail_bound(1, derivative) == f64::INFINITY {
            return Err(FourierSeriesError::Diverges { derivative });
        }
        let (mut low, mut high) = (0, LAST_HARMONIC);
        let rest = self.tail_bound(high, derivative);
        if rest > tolerance {
            // The slowest stroke decides how many more.
            let slowest = self
                .parts
                .iter()
                .flat_map(|p| p.decays.iter().map(|d| d.order));
            let power = slowest.max().map_or(1, |p| p - derivative as i32);
            return Err(FourierSeriesError::TooMany {
                needed: f64::from(high) * (rest / tolerance).powf(1.0 / f64::from(power)),
                tolerance,
            });
        }
        while high - low > 1 {
            let mid = low + (high - low) / 2;
            match self.tail_bound(mid, derivative) <= tolerance {
                true => high = mid,
                false => low = mid,
            }
        }
        Ok(high)
    }
}

#[cfg(test)]
mod tests;
