//! A proved step, evaluated at times within it.

use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag};
use rug::Float;

/// A proved step: the motion for `0 ≤ u ≤ 1`.
pub(super) struct Piece {
    pub x0: Float,
    pub slack: Mag,
    pub backward: bool,
    /// End of the step in the panel.
    pub x1: Float,
    pub theta: Ball,
    pub rest: bool,
    pub chi: TaylorModel,
    /// |χ − χ̃| over the step.
    pub chi_error: Mag,
    /// Time since the start of the step.
    pub time: TaylorModel,
    /// A lower bound on dt/du.
    pub time_rate: Mag,
    /// Time at the end.
    pub duration: Ball,
    /// Speed along the path at the end.
    pub speed: Ball,
}

impl Piece {
    /// The position in the panel, and the speed along the path, at the time `since` the start of
    /// the step, provided that it lies within the step.
    pub(super) fn at(&self, since: &Ball) -> (Ball, Ball) {
        let bits = self.chi.bits();
        let c = self.time.coefficients();
        let one = Float::with_val(bits, 1);
        // A root of the polynomial by the false position of its slope, kept in [0, 1].
        let value = |u: &Float| c.iter().rev().fold(Float::new(bits), |s, x| s * u + x);
        let slope = |u: &Float| {
            c.iter()
                .enumerate()
                .skip(1)
                .rev()
                .fold(Float::new(bits), |s, (k, x)| {
                    s * u + Float::with_val(bits, x * k as u32)
                })
        };
        let mut u = Float::with_val(bits, since.mid() / self.duration.mid());
        for _ in 0..60 {
            let miss = value(&u) - since.mid();
            let by = Float::with_val(bits, &miss / slope(&u));
            u -= &by;
            if !(u >= 0) {
                u = Float::new(bits);
            }
            if u > 1 {
                u = one.clone();
            }
            let tiny = by.is_zero() || by.get_exp().is_some_and(|e| e < 4 - bits as i32);
            if tiny {
                break;
            }
        }
        // |u − u_true| ≤ |t(u) − T| / min t_u.
        let at = Ball::new(u.clone(), Mag::ZERO);
        let miss = (self.time.eval(&at) - since).magnitude();
        let u = Ball::new(u, miss.div(self.time_rate));
        let chi = self.chi.eval(&u).widened(self.chi_error);
        let (advance, speed) = if self.rest {
            (u.square(), &u * &chi)
        } else {
            (u, chi)
        };
        let way = &advance * &self.theta;
        let from = Ball::new(self.x0.clone(), self.slack);
        let x = if self.backward {
            from - way
        } else {
            from + way
        };
        (x, speed)
    }
}
