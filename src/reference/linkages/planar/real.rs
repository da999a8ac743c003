//! Exactly given real numbers: fractions, and what square roots and directions of angles add to
//! them.

use crate::Ball;
use crate::class_iii::ExactAngle;
use rug::{Integer, Rational};
use std::ops::{AddAssign, Mul, Neg};

/// A fraction plus fractions times irrational numbers, all exact.
///
/// ```
/// use mechaudit_reference::planar::Real;
/// use rug::Rational;
/// // The height of an equilateral triangle.
/// let height = Real::root(&Real::from(Rational::from((3, 4))));
/// assert_eq!(height.to_ball(64).to_decimal(10).unwrap(), "0.8660254038");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Real {
    rational: Rational,
    terms: Vec<(Rational, Irrational)>,
}

/// Describes what is not written as a fraction.
#[derive(Clone, Debug, PartialEq)]
enum Irrational {
    /// The root of a whole number without small square factors.
    Surd(Integer),
    Root(Box<Real>),
    Reciprocal(Box<Real>),
    Product(Box<[Real; 2]>),
    Cosine(ExactAngle),
    Sine(ExactAngle),
}

impl From<Rational> for Real {
    fn from(rational: Rational) -> Real {
        let terms = Vec::new();
        Real { rational, terms }
    }
}

impl AddAssign<&Real> for Real {
    fn add_assign(&mut self, other: &Real) {
        self.rational += &other.rational;
        for (k, a) in &other.terms {
            match self.terms.iter_mut().find(|t| t.1 == *a) {
                Some(same) => same.0 += k,
                None => self.terms.push((k.clone(), a.clone())),
            }
        }
        self.terms.retain(|t| !t.0.is_zero());
    }
}

impl Mul<&Rational> for Real {
    type Output = Real;

    fn mul(mut self, factor: &Rational) -> Real {
        self.rational *= factor;
        self.terms.iter_mut().for_each(|t| t.0 *= factor);
        self.terms.retain(|t| !t.0.is_zero());
        self
    }
}

impl Neg for Real {
    type Output = Real;

    fn neg(self) -> Real {
        self * &Rational::from(-1)
    }
}

/// Square factors up to this are taken out of a root.
const SMALL: u32 = 1000;

/// `n = root² rest`, n positive; the rest may have square factors of large primes.
fn without_squares(n: &Integer) -> (Integer, Integer) {
    let (mut root, mut rest) = (Integer::from(1), n.clone());
    for p in 2..=SMALL {
        let square = Integer::from(p * p);
        while rest.is_divisible(&square) {
            rest /= &square;
            root *= p;
        }
    }
    match rest.is_perfect_square() {
        true => (root * rest.sqrt(), Integer::from(1)),
        false => (root, rest),
    }
}

impl Real {
    fn irrational(a: Irrational) -> Real {
        let terms = vec![(Rational::from(1), a)];
        Real {
            rational: Rational::new(),
            terms,
        }
    }

    /// The square root of a number that is not negative; of a negative fraction none has a value,
    /// and its ball is the whole line.
    pub fn root(of: &Real) -> Real {
        match of.fraction().filter(|q| **q >= 0) {
            Some(q) if q.is_zero() => Real::default(),
            Some(q) => {
                let (root, rest) = without_squares(&Integer::from(q.numer() * q.denom()));
                let factor = Rational::from((root, q.denom().clone()));
                match rest == 1 {
                    true => factor.into(),
                    false => Real::irrational(Irrational::Surd(rest)) * &factor,
                }
            }
            None => Real::irrational(Irrational::Root(Box::new(of.clone()))),
        }
    }

    /// The product.
    pub fn times(&self, other: &Real) -> Real {
        match (self.fraction(), other.fraction(), self.surd(), other.surd()) {
            (_, Some(q), ..) => self.clone() * q,
            (Some(q), ..) => other.clone() * q,
            (.., Some((a, Some((b, d)))), Some((x, Some((y, e))))) if d == e => {
                let root = Real::irrational(Irrational::Surd(d.clone()));
                let factor = Rational::from(a * y) + Rational::from(b * x);
                let mut product = root * &factor;
                product.rational = Rational::from(a * x) + Rational::from(b * y) * d;
                product
            }
            _ => {
                let both = Box::new([self.clone(), other.clone()]);
                Real::irrational(Irrational::Product(both))
            }
        }
    }

    /// The vector of length one in the direction of an angle.
    pub fn unit(angle: &ExactAngle) -> [Real; 2] {
        let root = |n: u32| Real::root(&Rational::from((n, 4)).into());
        // Twelfths and eighths of a turn have roots of whole numbers.
        let first = |degrees: u32| {
            Some(match degrees {
                0 => [root(4), root(0)],
                30 => [root(3), root(1)],
                45 => [root(2), root(2)],
                60 => [root(1), root(3)],
                _ => return None,
            })
        };
        let within = match angle {
            ExactAngle::Degrees(q) if q.is_integer() => q.numer().mod_u(360),
            // No other rational number of radians is a rational part of a turn.
            ExactAngle::Radians(q) if q.is_zero() => 0,
            _ => 1,
        };
        let Some([x, y]) = first(within % 90) else {
            return [
                Irrational::Cosine(angle.clone()),
                Irrational::Sine(angle.clone()),
            ]
            .map(Real::irrational);
        };
        match within / 90 {
            0 => [x, y],
            1 => [-y, x],
            2 => [-x, -y],
            _ => [y, -x],
        }
    }

    /// The vector of length one along a vector; none along zero.
    pub fn along(vector: &[Real; 2]) -> Option<[Real; 2]> {
        let [x, y] = vector;
        if x.is_zero() && y.is_zero() {
            return None;
        }
        let mut square = x.times(x);
        square += &y.times(y);
        let length = Real::root(&square);
        let reciprocal = match (square.fraction(), length.fraction()) {
            (_, Some(q)) => Rational::from(q.recip_ref()).into(),
            // 1/√n = √n/n.
            (Some(n), None) => length * &Rational::from(n.recip_ref()),
            (None, None) => Real::irrational(Irrational::Reciprocal(Box::new(length))),
        };
        Some([x.times(&reciprocal), y.times(&reciprocal)])
    }

    /// Returns whether it is zero as written; what is zero by an identity of roots is not told.
    pub fn is_zero(&self) -> bool {
        self.rational.is_zero() && self.terms.is_empty()
    }

    /// As a fraction, if it is written as one.
    pub fn fraction(&self) -> Option<&Rational> {
        self.terms.is_empty().then_some(&self.rational)
    }

    /// As `a + b √d` with whole d: a, and b with d if there is a root.
    pub(super) fn surd(&self) -> Option<(&Rational, Option<(&Rational, &Integer)>)> {
        match &self.terms[..] {
            [] => Some((&self.rational, None)),
            [(b, Irrational::Surd(d))] => Some((&self.rational, Some((b, d)))),
            _ => None,
        }
    }

    /// The number as a formula, in parentheses where it is more than a whole number.
    ///
    /// ```
    /// use mechaudit_reference::planar::Real;
    /// use rug::Rational;
    /// let mut x = Real::root(&Rational::from((1, 2)).into());
    /// x += &Rational::from(-3).into();
    /// assert_eq!(x.formula(), "((-3) + (1/2)*sqrt(2))");
    /// ```
    pub fn formula(&self) -> String {
        let mut parts = Vec::new();
        if !self.rational.is_zero() || self.terms.is_empty() {
            parts.push(rational_formula(&self.rational));
        }
        let terms = self.terms.iter();
        parts.extend(terms.map(|(k, a)| match *k == 1 {
            true => a.formula(),
            false => format!("{}*{}", rational_formula(k), a.formula()),
        }));
        match &parts[..] {
            [one] if self.terms.is_empty() => one.clone(),
            _ => format!("({})", parts.join(" + ")),
        }
    }

    /// Its value, enclosed.
    pub fn to_ball(&self, bits: u32) -> Ball {
        let terms = self.terms.iter();
        let terms = terms.map(|(k, a)| Ball::rational(bits, k) * a.to_ball(bits));
        terms.fold(Ball::rational(bits, &self.rational), |sum, t| sum + t)
    }
}

/// A fraction as a formula.
pub(super) fn rational_formula(q: &Rational) -> String {
    match q.is_integer() && *q >= 0 {
        true => q.to_string(),
        false => format!("({q})"),
    }
}

impl Irrational {
    fn formula(&self) -> String {
        let angle = |a: &ExactAngle| match a {
            ExactAngle::Radians(q) => rational_formula(q),
            ExactAngle::Degrees(q) => {
                format!("{}*pi", rational_formula(&Rational::from(q / 180u32)))
            }
        };
        match self {
            Irrational::Surd(n) => format!("sqrt({n})"),
            Irrational::Root(x) => format!("sqrt({})", x.formula()),
            Irrational::Reciprocal(x) => format!("(1/{})", x.formula()),
            Irrational::Product(both) => format!("{}*{}", both[0].formula(), both[1].formula()),
            Irrational::Cosine(a) => format!("cos({})", angle(a)),
            Irrational::Sine(a) => format!("sin({})", angle(a)),
        }
    }

    fn to_ball(&self, bits: u32) -> Ball {
        match self {
            Irrational::Surd(n) => Ball::rational(bits, &Rational::from(n)).sqrt(),
            Irrational::Root(x) => x.to_ball(bits).sqrt(),
            Irrational::Reciprocal(x) => x.to_ball(bits).recip(),
            Irrational::Product(both) => {
                let [a, b] = &**both;
                a.to_ball(bits) * b.to_ball(bits)
            }
            Irrational::Cosine(a) => a.to_ball(bits).sin_cos().1,
            Irrational::Sine(a) => a.to_ball(bits).sin_cos().0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn q(n: i32, d: i32) -> Real {
        Rational::from((n, d)).into()
    }

    fn decimal(x: &Real) -> String {
        x.to_ball(128).to_decimal(20).unwrap()
    }

    /// Equal roots cancel, and roots of squares are fractions.
    #[test]
    fn roots_are_written_in_one_way() {
        let root = |n, d| Real::root(&q(n, d));
        assert_eq!(root(9, 4), q(3, 2));
        assert_eq!(root(0, 1), Real::default());
        assert_eq!(root(12, 1), root(3, 1) * &Rational::from(2));
        let mut sum = root(3, 4);
        sum += &(-root(12, 1) * &Rational::from((1, 4)));
        assert!(sum.is_zero());
        assert_eq!(decimal(&root(2, 1)), "1.4142135623730950488");
        assert!(!Real::root(&q(-1, 1)).to_ball(64).is_finite());
        // A root of a root: √(1 + √2).
        let mut nested = root(2, 1);
        nested += &q(1, 1);
        assert_eq!(decimal(&Real::root(&nested)), "1.5537739740300373073");
        // The square of a prime above those tried.
        assert_eq!(root(1_018_081, 1), q(1009, 1));
    }

    #[test]
    fn directions_have_length_one() {
        let degrees = |n| Real::unit(&ExactAngle::Degrees(Rational::from(n)));
        assert_eq!(degrees(-90), [q(0, 1), q(-1, 1)]);
        assert_eq!(degrees(540), [q(-1, 1), q(0, 1)]);
        assert_eq!(decimal(&degrees(60)[1]), "0.86602540378443864676");
        for n in (-720..720).step_by(5) {
            let angle = ExactAngle::Degrees(Rational::from(n));
            let (sin, cos) = angle.to_ball(128).sin_cos();
            let [x, y] = Real::unit(&angle).map(|x| x.to_ball(128));
            assert!(x.overlaps(&cos) && y.overlaps(&sin), "{n}");
        }
        let radian = Real::unit(&ExactAngle::Radians(Rational::from(1)));
        assert_eq!(decimal(&radian[0]), "0.54030230586813971740");
        assert_eq!(Real::along(&[q(3, 1), q(-4, 1)]), Some([q(3, 5), q(-4, 5)]));
        assert_eq!(Real::along(&[q(0, 1), q(0, 1)]), None);
        let [x, y] = Real::along(&[q(1, 1), q(2, 1)]).unwrap();
        assert_eq!(decimal(&x), "0.44721359549995793928");
        assert_eq!(y, x * &Rational::from(2));
        let root = Real::root(&q(2, 1));
        let [x, _] = Real::along(&[root.clone(), q(1, 1)]).unwrap();
        assert_eq!(decimal(&x), "0.81649658092772603273");
        // (1 + √2)(1 − √2) = −1, and (√2, √7) has length 3.
        let [mut sum, mut rest] = [q(1, 1), q(1, 1)];
        sum += &root;
        rest += &-root.clone();
        assert_eq!(sum.times(&rest), q(-1, 1));
        let [x, _] = Real::along(&[root.clone(), Real::root(&q(7, 1))]).unwrap();
        assert_eq!(x, root * &Rational::from((1, 3)));
        // (1 + √2, 1): a root of a number with a root.
        let [_, y] = Real::along(&[sum, q(1, 1)]).unwrap();
        assert_eq!(decimal(&y), "0.38268343236508977173");
    }
}
