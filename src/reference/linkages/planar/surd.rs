//! Numbers `a + b √d` with fractions a and b: a field, in which equations are decided.

use super::real::Real;
use crate::Ball;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// `a + b √d` for the whole number d of a [`Field`].
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Surd {
    pub a: Rational,
    pub b: Rational,
}

/// A complex number of the field.
pub(super) type Vector = [Surd; 2];

/// The field with √d; d is positive and without square factors, and one for the fractions alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Field(pub Integer);

impl From<Rational> for Surd {
    fn from(a: Rational) -> Surd {
        Surd {
            a,
            b: Rational::new(),
        }
    }
}

impl Surd {
    pub(super) fn is_zero(&self) -> bool {
        // √d is no fraction unless d is one, where b is zero.
        self.a.is_zero() && self.b.is_zero()
    }

    pub(super) fn plus(&self, other: &Surd) -> Surd {
        Surd {
            a: Rational::from(&self.a + &other.a),
            b: Rational::from(&self.b + &other.b),
        }
    }

    pub(super) fn negated(&self) -> Surd {
        Surd {
            a: Rational::from(-&self.a),
            b: Rational::from(-&self.b),
        }
    }

    pub(super) fn minus(&self, other: &Surd) -> Surd {
        self.plus(&other.negated())
    }
}

impl Field {
    /// The number of the field that an exact number is, if it is written as one.
    pub(super) fn take(&self, x: &Real) -> Option<Surd> {
        let (a, root) = x.surd()?;
        let b = match root {
            None => Rational::new(),
            Some((b, d)) if *d == self.0 => b.clone(),
            Some(_) => return None,
        };
        Some(Surd { a: a.clone(), b })
    }

    pub(super) fn times(&self, x: &Surd, y: &Surd) -> Surd {
        let roots = Rational::from(&x.b * &y.b) * &self.0;
        Surd {
            a: Rational::from(&x.a * &y.a) + roots,
            b: Rational::from(&x.a * &y.b) + Rational::from(&x.b * &y.a),
        }
    }

    /// `x/y` for y other than zero.
    pub(super) fn over(&self, x: &Surd, y: &Surd) -> Surd {
        // 1/y = (a − b√d)/(a² − d b²), whose denominator is not zero for a root that is no
        // fraction.
        let conjugate = Surd {
            a: y.a.clone(),
            b: Rational::from(-&y.b),
        };
        let norm = self.times(y, &conjugate).a;
        let product = self.times(x, &conjugate);
        Surd {
            a: product.a / &norm,
            b: product.b / &norm,
        }
    }

    /// The complex product.
    pub(super) fn turned(&self, [x, y]: &Vector, [c, s]: &Vector) -> Vector {
        [
            self.times(x, c).minus(&self.times(y, s)),
            self.times(x, s).plus(&self.times(y, c)),
        ]
    }

    /// `x × y` of vectors.
    pub(super) fn cross(&self, x: &Vector, y: &Vector) -> Surd {
        self.times(&x[0], &y[1]).minus(&self.times(&x[1], &y[0]))
    }

    /// The power of a direction, of which the conjugate is the reciprocal.
    pub(super) fn power(&self, [c, s]: &Vector, n: i32) -> Vector {
        let s = if n < 0 { s.negated() } else { s.clone() };
        let one = [Surd::from(Rational::from(1)), Surd::default()];
        (0..n.unsigned_abs()).fold(one, |p, _| self.turned(&p, &[c.clone(), s.clone()]))
    }

    /// The value, enclosed; zero is exact.
    pub(super) fn to_ball(&self, x: &Surd, bits: u32) -> Ball {
        let a = Ball::rational(bits, &x.a);
        match x.b.is_zero() {
            true => a,
            false => {
                a + Ball::rational(bits, &x.b)
                    * Ball::rational(bits, &Rational::from(&self.0)).sqrt()
            }
        }
    }

    /// The direction of an angle in floating point if it is one of the field: its cosine, its sine
    /// or their quotient is a fraction of small numbers. That it is the one meant is not proved by
    /// this.
    pub(super) fn direction(&self, angle: f64) -> Option<Vector> {
        let (s, c) = angle.sin_cos();
        let one = || Rational::from(1);
        let other = |x: &Rational| self.root(&(one() - Rational::from(x.square_ref())));
        let by_cosine = || {
            let x = fraction(c)?;
            Some([Surd::from(x.clone()), signed(other(&x)?, s)])
        };
        let by_sine = || {
            let y = fraction(s)?;
            Some([signed(other(&y)?, c), Surd::from(y)])
        };
        let by_tangent = || {
            let t = fraction(s / c)?;
            let x = self.root(&(one() + Rational::from(t.square_ref())).recip())?;
            let x = signed(x, c);
            let y = self.times(&x, &t.into());
            Some([x, y])
        };
        let near = |v: &Vector| {
            let off = |x: &Surd, y: f64| (self.to_ball(x, 64).to_f64() - y).abs();
            off(&v[0], c) < NEAR && off(&v[1], s) < NEAR
        };
        let found = by_cosine().filter(near);
        found
            .or_else(|| by_sine().filter(near))
            .or_else(|| by_tangent().filter(near))
    }

    /// The root of a fraction, if it is one or a multiple of √d.
    fn root(&self, square: &Rational) -> Option<Surd> {
        let of = |q: &Rational| {
            let both = q.numer().is_perfect_square() && q.denom().is_perfect_square();
            (*q >= 0 && both)
                .then(|| Rational::from((q.numer().clone().sqrt(), q.denom().clone().sqrt())))
        };
        match of(square) {
            Some(a) => Some(a.into()),
            None => {
                let b = of(&(square.clone() / &self.0))?;
                let a = Rational::new();
                Some(Surd { a, b })
            }
        }
    }
}

/// The whole numbers under the roots that directions near an angle may have.
pub(super) fn roots_near(angle: f64) -> Vec<Integer> {
    let (s, c) = angle.sin_cos();
    let of = |x: f64, sign: i32| {
        let q = fraction(x).filter(|q| *q.denom() < SMALL)?;
        let square = Rational::from(1) + Rational::from(q.square_ref()) * sign;
        let root = Real::root(&square.into());
        Some(root.surd()?.1?.1.clone())
    };
    let all = [of(c, -1), of(s, -1), of(s / c, 1)];
    all.into_iter().flatten().collect()
}

/// With what sign the number is on the side of `like`.
fn signed(x: Surd, like: f64) -> Surd {
    if like < 0.0 { x.negated() } else { x }
}

/// How near a fraction has to be to be taken for what is meant, and with what denominators.
const NEAR: f64 = 1e-7;
const LARGEST: u32 = 2000;
/// Denominators of fractions whose roots are tried.
const SMALL: u32 = 200;

/// The first convergent of a number's continued fraction that is near it.
fn fraction(x: f64) -> Option<Rational> {
    let whole = Rational::from_f64(x)?;
    let (mut h, mut k) = (
        [Integer::from(0), Integer::from(1)],
        [Integer::from(1), Integer::from(0)],
    );
    let mut rest = whole.clone();
    loop {
        let a = Integer::from(rest.floor_ref());
        let next = |v: &[Integer; 2]| Integer::from(&a * &v[1]) + &v[0];
        let (p, q) = (next(&h), next(&k));
        if q.cmp(&Integer::from(LARGEST)) == Ordering::Greater {
            return None;
        }
        let found = Rational::from((p.clone(), q.clone()));
        if Rational::from(&found - &whole).to_f64().abs() < NEAR {
            return Some(found);
        }
        h = [h[1].clone(), p];
        k = [k[1].clone(), q];
        rest = (rest - &a).recip();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn q(n: i32, d: i32) -> Rational {
        Rational::from((n, d))
    }

    fn surd(a: Rational, b: Rational) -> Surd {
        Surd { a, b }
    }

    #[test]
    fn a_field_with_a_root() {
        let field = Field(Integer::from(3));
        let x = surd(q(1, 2), q(-2, 3));
        let y = surd(q(2, 1), q(1, 1));
        // (1/2 − 2/3 √3)(2 + √3) = 1 − 2 + (1/2 − 4/3) √3.
        let product = field.times(&x, &y);
        assert_eq!(product, surd(q(-1, 1), q(-5, 6)));
        assert_eq!(field.over(&product, &y), x);
        let value = field.to_ball(&product, 64).to_f64();
        assert!((value + 1.0 + 5.0 / 6.0 * 3f64.sqrt()).abs() < 1e-15);
        let sixth = [surd(q(1, 2), q(0, 1)), surd(q(0, 1), q(1, 2))];
        let one = [Surd::from(q(1, 1)), Surd::default()];
        assert_eq!(field.power(&sixth, 6), one);
        assert_eq!(field.power(&sixth, -12), one);
        assert_ne!(field.power(&sixth, 3), one);
    }

    #[test]
    fn directions_are_found_by_fractions() {
        let plain = Field(Integer::from(1));
        let pythagoras = [q(-3, 5), q(4, 5)].map(Surd::from);
        let angle = 0.8f64.atan2(-0.6);
        assert_eq!(plain.direction(angle + 1e-9), Some(pythagoras.clone()));
        assert_eq!(plain.direction(angle + 1e-4), None);
        assert_eq!(plain.direction(1.0), None);
        let half = surd(q(0, 1), q(-1, 2));
        let eighth = Field(Integer::from(2)).direction(-3.0 * std::f64::consts::FRAC_PI_4);
        assert_eq!(eighth, Some([half.clone(), half]));
        assert_eq!(Field(Integer::from(3)).direction(angle), Some(pythagoras));
        assert_eq!(roots_near(0.25f64.asin()), [Integer::from(15)]);
        assert!(roots_near(std::f64::consts::FRAC_PI_4).contains(&Integer::from(2)));
    }
}
