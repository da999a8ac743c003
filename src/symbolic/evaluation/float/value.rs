//! Numbers in floating point, real or complex: each operation on the parts is rounded once.

use super::Floating;
use crate::Func;
use mechaudit_reference::elementary::NoValue;

/// A number in floating point. A part that is missing is exactly zero: a real number has no
/// imaginary part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatValue {
    re: Option<f64>,
    im: Option<f64>,
}

impl From<f64> for FloatValue {
    fn from(x: f64) -> FloatValue {
        FloatValue {
            re: Some(x),
            im: None,
        }
    }
}

/// The reason why a function has no complex value.
const REAL_ALONE: NoValue =
    NoValue::Undefined("a function of a complex number that floating point does not have");

type Part = Option<f64>;

impl FloatValue {
    /// The imaginary unit.
    pub(super) const I: FloatValue = FloatValue {
        re: None,
        im: Some(1.0),
    };

    pub(super) fn new(re: f64, im: f64) -> FloatValue {
        FloatValue {
            re: Some(re),
            im: Some(im),
        }
    }

    /// The number, if it is real.
    pub fn real(&self) -> Option<f64> {
        match self.im {
            None => Some(self.re()),
            Some(_) => None,
        }
    }

    /// The real part.
    pub fn re(&self) -> f64 {
        self.re.unwrap_or(0.0)
    }

    /// The imaginary part.
    pub fn im(&self) -> f64 {
        self.im.unwrap_or(0.0)
    }
}

impl Floating {
    fn plus(self, a: Part, b: Part) -> Part {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.round(a + b)),
            (a, b) => a.or(b),
        }
    }

    fn minus(self, a: Part, b: Part) -> Part {
        self.plus(a, b.map(|b| -b))
    }

    fn times(self, a: Part, b: Part) -> Part {
        Some(self.round(a? * b?))
    }

    /// `−a`.
    pub(super) fn negative(self, a: &FloatValue) -> FloatValue {
        FloatValue {
            re: a.re.map(|x| -x),
            im: a.im.map(|x| -x),
        }
    }

    /// `a + b`.
    pub(super) fn sum(self, a: &FloatValue, b: &FloatValue) -> FloatValue {
        FloatValue {
            re: self.plus(a.re, b.re),
            im: self.plus(a.im, b.im),
        }
    }

    /// `a − b`.
    pub(super) fn difference(self, a: &FloatValue, b: &FloatValue) -> FloatValue {
        FloatValue {
            re: self.minus(a.re, b.re),
            im: self.minus(a.im, b.im),
        }
    }

    /// `a b`, from the four products of the parts.
    pub(super) fn product(self, a: &FloatValue, b: &FloatValue) -> FloatValue {
        FloatValue {
            re: self.minus(self.times(a.re, b.re), self.times(a.im, b.im)),
            im: self.plus(self.times(a.re, b.im), self.times(a.im, b.re)),
        }
    }

    /// `a/b`, of complex numbers by R. L. Smith's algorithm (Comm. ACM 5, 1962, 435), which forms
    /// no `|b|²`.
    pub(super) fn quotient(self, a: &FloatValue, b: &FloatValue) -> FloatValue {
        let Some(c) = b.im else {
            let by = |x: f64| self.round(x / b.re());
            return FloatValue {
                re: a.re.map(by),
                im: a.im.map(by),
            };
        };
        let round = |x: f64| self.round(x);
        let d = b.re();
        let (re, im) = (a.re(), a.im());
        if d.abs() >= c.abs() {
            let r = round(c / d);
            let below = round(d + round(c * r));
            FloatValue::new(
                round(round(re + round(im * r)) / below),
                round(round(im - round(re * r)) / below),
            )
        } else {
            let r = round(d / c);
            let below = round(round(d * r) + c);
            FloatValue::new(
                round(round(round(re * r) + im) / below),
                round(round(round(im * r) - re) / below),
            )
        }
    }

    /// An integer power of a complex number, by repeated products.
    pub(super) fn complex_power(self, a: &FloatValue, k: i32) -> FloatValue {
        let one = FloatValue::from(1.0);
        let mut product = one;
        let mut square = *a;
        let mut left = k.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                product = self.product(&product, &square);
            }
            left >>= 1;
            if left > 0 {
                square = self.product(&square, &square);
            }
        }
        match k < 0 {
            true => self.quotient(&one, &product),
            false => product,
        }
    }

    /// A function of one complex number, from the functions of its parts.
    pub(super) fn complex_call(self, f: Func, z: &FloatValue) -> Result<FloatValue, NoValue> {
        let (x, y) = (z.re(), z.im());
        let of = |f: Func, x: f64| self.unary(f, x);
        let times = |a: f64, b: f64| self.round(a * b);
        Ok(match f {
            Func::Re => x.into(),
            Func::Im => y.into(),
            Func::Conj => FloatValue {
                im: z.im.map(|y| -y),
                ..*z
            },
            Func::Abs => self.binary(Func::Hypot, x, y)?.into(),
            Func::Arg => self.binary(Func::Atan2, y, x)?.into(),
            Func::Exp => {
                let size = of(Func::Exp, x)?;
                let (cos, sin) = (of(Func::Cos, y)?, of(Func::Sin, y)?);
                FloatValue::new(times(size, cos), times(size, sin))
            }
            Func::Log => FloatValue::new(
                of(Func::Log, self.binary(Func::Hypot, x, y)?)?,
                self.binary(Func::Atan2, y, x)?,
            ),
            Func::Sin | Func::Cos => {
                let (sin, cos) = (of(Func::Sin, x)?, of(Func::Cos, x)?);
                let (sinh, cosh) = (of(Func::Sinh, y)?, of(Func::Cosh, y)?);
                match f {
                    Func::Sin => FloatValue::new(times(sin, cosh), times(cos, sinh)),
                    _ => FloatValue::new(times(cos, cosh), times(-sin, sinh)),
                }
            }
            Func::Sqrt => self.complex_root(x, y)?,
            _ => return Err(REAL_ALONE),
        })
    }

    /// The principal root: the larger part is `√((|z| + |x|)/2)`, the other `|y|` over twice that.
    fn complex_root(self, x: f64, y: f64) -> Result<FloatValue, NoValue> {
        let size = self.binary(Func::Hypot, x, y)?;
        if size == 0.0 {
            return Ok(FloatValue::new(x, y));
        }
        let half = self.round(self.round(size + x.abs()) * 0.5);
        let larger = self.unary(Func::Sqrt, half)?;
        let other = self.round(y.abs() / self.round(2.0 * larger));
        let (re, im) = match x >= 0.0 {
            true => (larger, other),
            false => (other, larger),
        };
        Ok(FloatValue::new(re, im.copysign(y)))
    }
}
