//! DOP853: an explicit method of order 8 with a choice of the step and an interpolant of order 7.

use super::dop853_table::{ALL, DENSE, ERROR_3, ERROR_5, NODES, STAGE, STAGES, WEIGHTS};

/// Why a step was not taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepError<E> {
    /// The right-hand side has no value, however small the step.
    #[error(transparent)]
    Rate(E),
    /// The step became too small to change the time.
    #[error("the step became too small at t = {t} s: the motion is not smooth there, or it ends")]
    Small {
        /// The time reached.
        t: f64,
    },
}

/// Factors by which a step may change at once.
const CHANGE: [f64; 2] = [0.2, 10.0];
/// The part of the step that the error estimate allows which is taken: with 0.9 nearly a fifth of
/// the steps of a swinging four-bar are rejected, which costs what shorter steps cost.
const SAFETY: f64 = 0.8;

/// A solution of y′ = f(t, y) under way.
///
/// ```
/// use mechaudit_solvers::initial_value::Dop853;
/// // y″ = −y from (1, 0) to t = 1.
/// let mut f = |_: f64, y: &[f64], out: &mut [f64]| {
///     (out[0], out[1]) = (y[1], -y[0]);
///     Ok::<(), std::convert::Infallible>(())
/// };
/// let mut solution = Dop853::new(0.0, &[1.0, 0.0], 1e-13);
/// while solution.t() < 1.0 {
///     solution.step(1.0, &mut f)?;
/// }
/// assert!((solution.y()[0] - 1f64.cos()).abs() < 1e-13);
/// # Ok::<(), mechaudit_solvers::initial_value::StepError<std::convert::Infallible>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Dop853 {
    t: f64,
    y: Vec<f64>,
    t_before: f64,
    y_before: Vec<f64>,
    /// The next step that is tried; none before the first.
    h: Option<f64>,
    tolerance: f64,
    /// The stages of the last step, stage by stage.
    k: Vec<f64>,
    /// Holds f(t, y).
    rate: Option<Vec<f64>>,
    /// The interpolant of the last step, where it has been asked for.
    dense: Vec<f64>,
    has_dense: bool,
    trial: Vec<f64>,
    /// Evaluations of the right-hand side.
    evaluations: u64,
}

/// `Σ w k` of component i.
#[inline(always)]
fn combined(k: &[f64], n: usize, i: usize, weights: &[(usize, f64)]) -> f64 {
    weights.iter().fold(0.0, |s, (j, w)| s + w * k[j * n + i])
}

impl Dop853 {
    /// The solution through (t, y). The error of a step is kept below `tolerance (1 + |y|)` for
    /// each component, in the mean of squares.
    pub fn new(t: f64, y: &[f64], tolerance: f64) -> Dop853 {
        let n = y.len();
        Dop853 {
            t,
            y: y.to_vec(),
            t_before: t,
            y_before: y.to_vec(),
            h: None,
            tolerance,
            k: vec![0.0; ALL * n],
            rate: None,
            dense: vec![0.0; 7 * n],
            has_dense: false,
            trial: vec![0.0; n],
            evaluations: 0,
        }
    }

    /// The time reached.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// The time at which the last step began.
    pub fn t_before(&self) -> f64 {
        self.t_before
    }

    /// The solution at [`Dop853::t`].
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// How often the right-hand side was evaluated.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Goes on from other values at the time reached, such as those in other coordinates.
    pub fn set(&mut self, y: &[f64]) {
        self.y.copy_from_slice(y);
        self.rate = None;
    }

    /// Takes one step, which ends at `end` at the latest (a time after that reached).
    ///
    /// # Errors
    /// [`StepError`].
    pub fn step<E>(
        &mut self,
        end: f64,
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), StepError<E>> {
        let n = self.y.len();
        let first = match self.rate.take() {
            Some(rate) => rate,
            None => {
                let mut rate = vec![0.0; n];
                self.evaluations += 1;
                f(self.t, &self.y, &mut rate).map_err(StepError::Rate)?;
                rate
            }
        };
        let mut h = self.h.unwrap_or_else(|| self.first_step(&first));
        let mut rejected = false;
        loop {
            let last = self.t + h >= end - 1e-3 * h;
            if last {
                h = end - self.t;
            }
            if !(h > 4.0 * f64::EPSILON * self.t.abs().max(h)) {
                return Err(StepError::Small { t: self.t });
            }
            self.k[..n].copy_from_slice(&first);
            let error = match self.stages(h, f) {
                Ok(()) => self.error(h),
                Err(e) if h <= 1e-12 * (1.0 + self.t.abs()) => return Err(StepError::Rate(e)),
                Err(_) => f64::INFINITY,
            };
            let wanted = match error.is_finite() {
                true => (SAFETY * error.max(1e-20).powf(-0.125)).clamp(CHANGE[0], CHANGE[1]),
                false => CHANGE[0],
            };
            if error <= 1.0 {
                self.t_before = self.t;
                self.t = if last { end } else { self.t + h };
                std::mem::swap(&mut self.y, &mut self.y_before);
                self.y.copy_from_slice(&self.trial);
                self.rate = Some(self.k[STAGES * n..(STAGES + 1) * n].to_vec());
                self.has_dense = false;
                let next = h * if rejected { wanted.min(1.0) } else { wanted };
                // A step cut short by the end says little of the next.
                self.h = Some(if last {
                    next.max(self.h.unwrap_or(next))
                } else {
                    next
                });
                return Ok(());
            }
            rejected = true;
            h *= wanted.min(SAFETY);
            self.h = Some(h);
        }
    }

    /// A first step from the sizes of the solution and its rate (Hairer, Nørsett, Wanner, II.4).
    fn first_step(&self, rate: &[f64]) -> f64 {
        let size = |v: &[f64]| {
            let parts = v.iter().zip(&self.y);
            let sum: f64 = parts.map(|(v, y)| (v / (1.0 + y.abs())).powi(2)).sum();
            sum.sqrt()
        };
        let (d0, d1) = (size(&self.y), size(rate));
        let h = if d0 < 1e-5 || d1 < 1e-5 {
            1e-3
        } else {
            1e-2 * d0 / d1
        };
        h.min(100.0 * self.tolerance.powf(0.125) * h)
    }

    /// The stages 1 to 12 from stage 0, and the solution after the step.
    fn stages<E>(
        &mut self,
        h: f64,
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        for s in 1..=STAGES {
            let weights = if s == STAGES { WEIGHTS } else { STAGE[s] };
            self.stage(s, weights, (self.t, h), false, f)?;
        }
        Ok(())
    }

    fn stage<E>(
        &mut self,
        s: usize,
        weights: &[(usize, f64)],
        (t, h): (f64, f64),
        before: bool,
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let n = self.y.len();
        let from = if before { &self.y_before } else { &self.y };
        for i in 0..n {
            self.trial[i] = from[i] + h * combined(&self.k, n, i, weights);
        }
        self.evaluations += 1;
        f(
            t + NODES[s] * h,
            &self.trial,
            &mut self.k[s * n..(s + 1) * n],
        )
    }

    /// The estimated error over the tolerance: of order 8, from estimates of order 5 and 3.
    fn error(&self, h: f64) -> f64 {
        let n = self.y.len();
        let (mut five, mut three) = (0.0, 0.0);
        for i in 0..n {
            let scale = self.tolerance * (1.0 + self.y[i].abs().max(self.trial[i].abs()));
            five += (combined(&self.k, n, i, ERROR_5) / scale).powi(2);
            three += (combined(&self.k, n, i, ERROR_3) / scale).powi(2);
        }
        if five == 0.0 {
            return three;
        }
        h.abs() * five / ((five + 0.01 * three) * n as f64).sqrt()
    }

    /// The solution at a time within the last step, by its interpolant.
    ///
    /// # Errors
    /// Those of the right-hand side, which is evaluated three times for the first such time of a
    /// step.
    pub fn between<E>(
        &mut self,
        t: f64,
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
        out: &mut [f64],
    ) -> Result<(), E> {
        if t == self.t {
            out.copy_from_slice(&self.y);
            return Ok(());
        }
        if !self.has_dense {
            self.interpolant(f)?;
        }
        let n = self.y.len();
        let x = (t - self.t_before) / (self.t - self.t_before);
        for (i, out) in out.iter_mut().enumerate() {
            let mut sum = 0.0;
            for power in (0..7).rev() {
                let factor = if power % 2 == 0 { x } else { 1.0 - x };
                sum = (sum + self.dense[power * n + i]) * factor;
            }
            *out = self.y_before[i] + sum;
        }
        Ok(())
    }

    fn interpolant<E>(
        &mut self,
        f: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let (n, h) = (self.y.len(), self.t - self.t_before);
        for s in STAGES + 1..ALL {
            self.stage(s, STAGE[s], (self.t_before, h), true, f)?;
        }
        for i in 0..n {
            let change = self.y[i] - self.y_before[i];
            let (first, last) = (h * self.k[i], h * self.k[STAGES * n + i]);
            self.dense[i] = change;
            self.dense[n + i] = first - change;
            self.dense[2 * n + i] = 2.0 * change - last - first;
            for (power, weights) in (3..).zip(DENSE) {
                self.dense[power * n + i] = h * combined(&self.k, n, i, weights);
            }
        }
        self.has_dense = true;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
