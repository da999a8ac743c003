//! Complex balls in machine words: a real and an imaginary part of 128 bits.
//!
//! The contract is that of [`Ball128`]. Each part is accurate beside the modulus; one that is small
//! beside the other may have few bits of its own.

use super::ball128::Ball128;
use crate::ComplexBall;
use std::cmp::Ordering;

/// A complex number whose parts are known within balls.
#[derive(Clone, Copy, Debug)]
pub struct Complex128 {
    /// The real part.
    pub re: Ball128,
    /// The imaginary part.
    pub im: Ball128,
}

impl Complex128 {
    /// Zero.
    pub const ZERO: Complex128 = Complex128 {
        re: Ball128::ZERO,
        im: Ball128::ZERO,
    };

    /// The imaginary unit.
    pub fn imaginary_unit() -> Complex128 {
        Complex128 {
            re: Ball128::ZERO,
            im: Ball128::integer(1),
        }
    }

    /// A real number.
    pub fn real(re: Ball128) -> Complex128 {
        let im = Ball128::ZERO;
        Complex128 { re, im }
    }

    /// The ball of 128 bits around a ball. None if a part is unbounded or too wide.
    pub fn of_ball(z: &ComplexBall) -> Option<Complex128> {
        Some(Complex128 {
            re: Ball128::of_ball(&z.re)?,
            im: Ball128::of_ball(&z.im)?,
        })
    }

    /// The same ball with midpoints in MPFR. None beyond its exponents.
    pub fn to_ball(&self) -> Option<ComplexBall> {
        Some(ComplexBall::new(self.re.to_ball()?, self.im.to_ball()?))
    }

    /// `−z`.
    #[must_use]
    pub fn negative(&self) -> Complex128 {
        Complex128 {
            re: self.re.negative(),
            im: self.im.negative(),
        }
    }

    /// `z + w`.
    pub fn add(&self, w: &Complex128) -> Option<Complex128> {
        Some(Complex128 {
            re: self.re.add(&w.re)?,
            im: self.im.add(&w.im)?,
        })
    }

    /// `z − w`.
    pub fn sub(&self, w: &Complex128) -> Option<Complex128> {
        self.add(&w.negative())
    }

    /// `x z` for a real x.
    pub fn scaled(&self, x: &Ball128) -> Option<Complex128> {
        Some(Complex128 {
            re: self.re.mul(x)?,
            im: self.im.mul(x)?,
        })
    }

    /// `z w`.
    pub fn mul(&self, w: &Complex128) -> Option<Complex128> {
        Some(Complex128 {
            re: self.re.mul(&w.re)?.sub(&self.im.mul(&w.im)?)?,
            im: self.re.mul(&w.im)?.add(&self.im.mul(&w.re)?)?,
        })
    }

    fn square(&self) -> Option<Complex128> {
        let [sum, difference] = [self.re.add(&self.im)?, self.re.sub(&self.im)?];
        Some(Complex128 {
            re: sum.mul(&difference)?,
            im: self.re.mul(&self.im)?.shift(1),
        })
    }

    /// `|z|²`.
    pub fn norm(&self) -> Option<Ball128> {
        self.re.mul(&self.re)?.add(&self.im.mul(&self.im)?)
    }

    /// `z / w`. None where `w` may be zero.
    pub fn div(&self, w: &Complex128) -> Option<Complex128> {
        let back = Complex128 {
            re: w.re,
            im: w.im.negative(),
        };
        self.mul(&back)?.scaled(&w.inverse_norm()?)
    }

    fn inverse_norm(&self) -> Option<Ball128> {
        Ball128::integer(1).div(&self.norm()?)
    }

    /// `z^k` by squaring; of the inverse for k < 0.
    pub fn power(&self, k: i32) -> Option<Complex128> {
        let mut left = k.unsigned_abs();
        let mut square = *self;
        let mut found: Option<Complex128> = None;
        while left > 0 {
            if left & 1 == 1 {
                found = Some(match found {
                    Some(found) => found.mul(&square)?,
                    None => square,
                });
            }
            left >>= 1;
            if left > 0 {
                square = square.square()?;
            }
        }
        let one = Complex128::real(Ball128::integer(1));
        let found = found.unwrap_or(one);
        match k < 0 {
            true => one.div(&found),
            false => Some(found),
        }
    }

    /// Returns true if the principal branch of a root or a logarithm has one value here: the number
    /// is off zero and off the negative real axis, or on that axis, whose upper side counts.
    pub(crate) fn is_off_cut(&self) -> bool {
        let [re, im] = [&self.re, &self.im].map(Ball128::sign);
        match im {
            Some(Ordering::Less | Ordering::Greater) => true,
            Some(Ordering::Equal) => matches!(re, Some(Ordering::Less | Ordering::Greater)),
            None => re == Some(Ordering::Greater),
        }
    }

    /// The principal square root. None where its branch is not decided.
    ///
    /// It is `s + i y/(2s)` with `s = √((|z| + x)/2)`, and `|y|/(2s) ± i s` with `s = √((|z| − x)/2)`
    /// and the sign of y. Either holds wherever s is positive; the sum is the one without cancellation.
    pub fn sqrt(&self) -> Option<Complex128> {
        if !self.is_off_cut() {
            return None;
        }
        let is_right = self.re.sign() != Some(Ordering::Less);
        let size = self.norm()?.sqrt()?;
        let along = if is_right {
            self.re
        } else {
            self.re.negative()
        };
        let s = size.add(&along)?.shift(-1).sqrt()?;
        let other = self.im.div(&s.shift(1))?;
        Some(match (is_right, self.im.sign()) {
            (true, _) => Complex128 { re: s, im: other },
            (false, Some(Ordering::Less)) => Complex128 {
                re: other.negative(),
                im: s.negative(),
            },
            (false, _) => Complex128 { re: other, im: s },
        })
    }
}
