//! Derivatives of operations by their operands and of all of them by the inputs; backward, of the
//! result by every rounding error.

use super::super::elementary::{power, range, slopes};
use super::super::tape::{Op, Place, Tape};
use super::{Pass, one};
use crate::interval::Interval;
use mechaudit_symbolic::Func;

impl Pass {
    /// Derivatives of the last operation.
    pub(super) fn link(&mut self, op: Op, with_slopes: bool) {
        let last = self.partial.len() - 1;
        let (operands, count) = op.operands();
        let noisy = operands[..count].iter().any(|a| self.noisy[*a]);
        self.noisy[last] |= noisy;
        let v = |k: usize| self.value[operands[k]];
        let here = self.value[last];
        let constant = Interval::ZERO;
        // First derivatives, and the second ones by pairs of operands: aa, ab, bb.
        let mut second = [constant; 3];
        let first = match op {
            Op::Input(_) | Op::Constant(..) | Op::Step(..) | Op::Lost(_) => [constant; 3],
            Op::If(..) => self.partial[last],
            Op::Neg(_) => [-one(), constant, constant],
            Op::Near(..) => [one(), constant, constant],
            // The small input itself is the derivative, of which more is known.
            Op::Plain(_) => [Interval::ALL, constant, constant],
            Op::Add(..) => [one(), one(), constant],
            Op::Sub(..) => [one(), -one(), constant],
            Op::Abs(_) => {
                let x = v(0);
                let sign = if x.lo >= 0.0 {
                    one()
                } else if x.hi <= 0.0 {
                    -one()
                } else {
                    second[0] = Interval::ALL;
                    Interval { lo: -1.0, hi: 1.0 }
                };
                [sign, constant, constant]
            }
            Op::Min(..) | Op::Max(..) => {
                let (x, y) = (v(0), v(1));
                let (low, high) = (x.hi <= y.lo, y.hi <= x.lo);
                let is_min = matches!(op, Op::Min(..));
                let share = match (low, high) {
                    (true, _) => Interval::point(f64::from(u8::from(is_min))),
                    (_, true) => Interval::point(f64::from(u8::from(!is_min))),
                    _ => {
                        second = [Interval::ALL; 3];
                        Interval { lo: 0.0, hi: 1.0 }
                    }
                };
                [share, one() - share, constant]
            }
            Op::Mul(a, b) if a == b => {
                second[0] = Interval::point(2.0);
                [Interval::point(2.0) * v(0), constant, constant]
            }
            Op::Mul(..) => {
                second[1] = one();
                [v(1), v(0), constant]
            }
            Op::Fma(a, b, _) if a == b => {
                second[0] = Interval::point(2.0);
                [Interval::point(2.0) * v(0), constant, one()]
            }
            Op::Fma(..) => {
                second[1] = one();
                [v(1), v(0), one()]
            }
            Op::Div(..) => {
                let (x, y) = (v(0), v(1));
                let square = y.square();
                second[1] = -(one() / square);
                second[2] = Interval::point(2.0) * x / (square * y);
                // The square may overflow.
                let slope = (x / square).meet(here / y);
                [one() / y, -slope, constant]
            }
            Op::Sqrt(_) => {
                let root = v(0).sqrt();
                let slope = Interval::point(0.5) / root;
                second[0] = Interval::point(-0.5) * slope / v(0);
                [slope, constant, constant]
            }
            Op::Smooth(f, ..) => {
                let [slope, curve] = slopes(f, v(0), here);
                second[0] = curve;
                [slope, constant, constant]
            }
            Op::Power(_, k, _) => {
                let x = v(0);
                let of = |c: i64, k: i32| Interval::point(c as f64) * power(x, k);
                let k_long = i64::from(k);
                second[0] = of(k_long * (k_long - 1), k - 2);
                [of(k_long, k - 1), constant, constant]
            }
            Op::Pow(..) => {
                let (x, y) = (v(0), v(1));
                let log = range(Func::Log, x);
                let less = y - one();
                let slope = range(Func::Exp, less * log);
                let value = range(Func::Exp, y * log);
                second[0] = y * less * range(Func::Exp, (less - one()) * log);
                second[1] = slope * (one() + y * log);
                second[2] = value * log.square();
                [y * slope, value * log, constant]
            }
            Op::Hypot(..) => {
                let (x, y) = (v(0), v(1));
                let h = (x.square() + y.square()).sqrt();
                let cube = h * h.square();
                second[0] = y.square() / cube;
                second[1] = -(x * y / cube);
                second[2] = x.square() / cube;
                [x / h, y / h, constant]
            }
            Op::Atan2(..) => {
                let (y, x) = (v(0), v(1));
                let square = x.square() + y.square();
                let fourth = square.square();
                second[0] = Interval::point(-2.0) * x * y / fourth;
                second[1] = (y.square() - x.square()) / fourth;
                second[2] = -second[0];
                [x / square, -(y / square), constant]
            }
        };
        self.partial[last] = first;
        if !with_slopes {
            return;
        }
        let n = self.inputs;
        for j in 0..n {
            let slopes = [0, 1, 2].map(|k| match k < count {
                true => self.slope[operands[k] * n + j],
                false => Interval::ZERO,
            });
            let mut own = match op {
                Op::Input(k) if k == j => one(),
                _ => Interval::ZERO,
            };
            for (partial, slope) in first.iter().zip(slopes) {
                // A factor twice has its derivative with the first.
                own = own + *partial * slope;
            }
            self.slope.push(own);
            let [x, y, _] = slopes;
            self.curve.push(second[0] * x + second[1] * y);
            self.curve.push(second[1] * x + second[2] * y);
        }
    }

    /// Computes `∂f/∂δ_i` of the operation at a place, and the derivatives of these by the inputs.
    pub fn backward(&mut self, tape: &Tape, root: Place, with_slopes: bool) {
        let (n, len) = (self.inputs, tape.ops.len());
        self.adjoint.clear();
        self.adjoint.resize(len, Interval::ZERO);
        self.adjoint_slope.clear();
        self.adjoint_slope
            .resize(if with_slopes { len * n } else { 0 }, Interval::ZERO);
        self.adjoint[root] = one();
        for i in (0..=root).rev() {
            let (operands, count) = tape.ops[i].operands();
            let above = self.adjoint[i];
            let flat = !with_slopes
                || self.adjoint_slope[i * n..(i + 1) * n]
                    .iter()
                    .all(|s| s.is_zero());
            if count == 0 || (above.is_zero() && flat) {
                continue;
            }
            for (k, a) in operands.iter().copied().enumerate().take(count) {
                let partial = self.partial[i][k];
                if !self.noisy[a] {
                    continue;
                }
                self.adjoint[a] = self.adjoint[a] + above * partial;
                if !with_slopes {
                    continue;
                }
                for j in 0..n {
                    let curve = match k {
                        2 => Interval::ZERO,
                        k => self.curve[(i * n + j) * 2 + k],
                    };
                    let add = self.adjoint_slope[i * n + j] * partial + above * curve;
                    self.adjoint_slope[a * n + j] = self.adjoint_slope[a * n + j] + add;
                }
            }
        }
    }
}
