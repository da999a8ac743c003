//! Laurent polynomials on the unit circle.

use crate::ComplexBall;

/// Coefficient of τ^k at index `k + offset`; all of one precision.
pub(super) struct Laurent {
    pub(super) offset: i32,
    pub(super) c: Vec<ComplexBall>,
}

impl Laurent {
    pub(super) fn new(offset: i32, c: Vec<ComplexBall>) -> Laurent {
        Laurent { offset, c }
    }

    pub(super) fn mul(&self, other: &Laurent) -> Laurent {
        let bits = self.c[0].re.prec();
        let n = self.c.len() + other.c.len() - 1;
        let mut c = vec![ComplexBall::zero(bits); n];
        for (i, a) in self.c.iter().enumerate() {
            for (j, b) in other.c.iter().enumerate() {
                c[i + j] = &c[i + j] + &(a * b);
            }
        }
        Laurent::new(self.offset + other.offset, c)
    }

    pub(super) fn at(&self, k: i32) -> Option<&ComplexBall> {
        usize::try_from(k + self.offset)
            .ok()
            .and_then(|i| self.c.get(i))
    }

    pub(super) fn sub(&self, other: &Laurent) -> Laurent {
        let bits = self.c[0].re.prec();
        let offset = self.offset.max(other.offset);
        let top = |l: &Laurent| l.c.len() as i32 - l.offset;
        let n = offset + top(self).max(top(other));
        let c = (0..n)
            .map(|i| {
                let k = i - offset;
                let zero = ComplexBall::zero(bits);
                self.at(k).unwrap_or(&zero) - other.at(k).unwrap_or(&zero)
            })
            .collect();
        Laurent::new(offset, c)
    }

    /// The conjugate on the unit circle: τ → 1/τ and coefficients conjugated.
    pub(super) fn conj(&self) -> Laurent {
        let c: Vec<ComplexBall> = self.c.iter().rev().map(ComplexBall::conj).collect();
        Laurent::new(self.c.len() as i32 - 1 - self.offset, c)
    }

    pub(super) fn value(&self, tau: &ComplexBall) -> ComplexBall {
        let bits = tau.re.prec();
        let mut sum = ComplexBall::zero(bits);
        for c in self.c.iter().rev() {
            sum = &(&sum * tau) + c;
        }
        // Divide by τ^offset = multiply by conj(τ)^offset.
        for _ in 0..self.offset {
            sum = &sum * &tau.conj();
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ball;

    fn complex(re: i64, im: i64) -> ComplexBall {
        ComplexBall::new(Ball::integer(64, re), Ball::integer(64, im))
    }

    fn of(offset: i32, c: &[(i64, i64)]) -> Laurent {
        Laurent::new(offset, c.iter().map(|&(re, im)| complex(re, im)).collect())
    }

    /// The lowest power and the coefficients, which are exact.
    fn parts(l: &Laurent) -> (i32, Vec<(f64, f64)>) {
        let exact = |b: &Ball| {
            assert!(b.rad().is_zero());
            b.to_f64()
        };
        let c = l.c.iter().map(|x| (exact(&x.re), exact(&x.im)));
        (-l.offset, c.collect())
    }

    /// By hand: polynomials that begin and end at different powers.
    #[test]
    fn sums_products_and_conjugates() {
        // 1 + 2i + 3τ and τ^−2 − i τ^−1 + 5 τ + 7i τ².
        let a = of(0, &[(1, 2), (3, 0)]);
        let b = of(2, &[(1, 0), (0, -1), (0, 0), (5, 0), (0, 7)]);
        let difference = [
            (-1.0, 0.0),
            (0.0, 1.0),
            (1.0, 2.0),
            (-2.0, 0.0),
            (0.0, -7.0),
        ];
        assert_eq!(parts(&a.sub(&b)), (-2, difference.to_vec()));
        let negated = difference.map(|(x, y)| (0.0 - x, 0.0 - y));
        assert_eq!(parts(&b.sub(&a)), (-2, negated.to_vec()));
        // τ^3 + 2 τ^4 less 1 + τ: the one ends before the other begins.
        let far = of(-3, &[(1, 0), (2, 0)]).sub(&of(0, &[(1, 0), (1, 0)]));
        let due = [(-1.0, 0.0), (-1.0, 0.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0)];
        assert_eq!(parts(&far), (0, due.to_vec()));
        let product = [
            (1.0, 2.0),
            (5.0, -1.0),
            (0.0, -3.0),
            (5.0, 10.0),
            (1.0, 7.0),
            (0.0, 21.0),
        ];
        assert_eq!(parts(&a.mul(&b)), (-2, product.to_vec()));
        assert_eq!(parts(&a.conj()), (-1, vec![(3.0, 0.0), (1.0, -2.0)]));
        let ends = [-3, -2, 2, 3].map(|k| b.at(k).map(|c| c.re.to_f64() + c.im.to_f64()));
        assert_eq!(ends, [None, Some(1.0), Some(7.0), None]);
    }

    /// At τ = −i every power is exact.
    #[test]
    fn values_on_the_circle() {
        let tau = complex(0, -1);
        let value = |l: &Laurent| {
            let v = l.value(&tau);
            (v.re.to_f64(), v.im.to_f64())
        };
        // 1 + 2i − 3i, and −1 + 1 − 5i − 7i.
        assert_eq!(value(&of(0, &[(1, 2), (3, 0)])), (1.0, -1.0));
        let b = of(2, &[(1, 0), (0, -1), (0, 0), (5, 0), (0, 7)]);
        assert_eq!(value(&b), (0.0, -12.0));
        assert_eq!(value(&of(1, &[(4, 0)])), (0.0, 4.0));
    }
}
