//! Gaussian rationals: `a + b i` with rational a and b.

use rug::Rational;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// `re + im i`, exactly.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Gauss {
    /// Real part.
    pub re: Rational,
    /// Imaginary part.
    pub im: Rational,
}

impl Gauss {
    /// From its parts.
    pub fn new(re: impl Into<Rational>, im: impl Into<Rational>) -> Gauss {
        Gauss {
            re: re.into(),
            im: im.into(),
        }
    }

    /// A real number.
    pub fn real(re: impl Into<Rational>) -> Gauss {
        Gauss::new(re, 0)
    }

    /// The imaginary unit.
    pub fn i() -> Gauss {
        Gauss::new(0, 1)
    }

    /// `i^k`.
    pub fn i_power(k: i64) -> Gauss {
        match k.rem_euclid(4) {
            0 => Gauss::real(1),
            1 => Gauss::i(),
            2 => Gauss::real(-1),
            _ => Gauss::new(0, -1),
        }
    }

    /// Returns true if it is zero.
    pub fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    /// Returns true if it is one.
    pub fn is_one(&self) -> bool {
        self.re == 1 && self.im.is_zero()
    }

    /// The length of its numbers in machine words, at least one.
    pub(super) fn words(&self) -> u64 {
        let bits = |q: &Rational| q.numer().significant_bits() + q.denom().significant_bits();
        1 + u64::from(bits(&self.re).max(bits(&self.im))) / 64
    }

    /// The conjugate.
    pub fn conj(&self) -> Gauss {
        Gauss::new(self.re.clone(), -self.im.clone())
    }

    /// `re² + im²`.
    pub fn norm(&self) -> Rational {
        Rational::from(&self.re * &self.re) + Rational::from(&self.im * &self.im)
    }

    /// The inverse; `None` of zero.
    pub fn inverse(&self) -> Option<Gauss> {
        if self.is_zero() {
            return None;
        }
        if self.im.is_zero() {
            return Some(Gauss::real(self.re.clone().recip()));
        }
        let n = self.norm();
        Some(Gauss::new(
            Rational::from(&self.re / &n),
            -Rational::from(&self.im / &n),
        ))
    }

    /// The square root with real part > 0, or = 0 and imaginary part ≥ 0, if it is Gaussian
    /// rational.
    pub fn sqrt(&self) -> Option<Gauss> {
        // (x + iy)² = re + i im: x² = (|z| + re)/2, y² = (|z| − re)/2, 2xy = im.
        let size = rational_sqrt(&self.norm())?;
        let x = rational_sqrt(&(Rational::from(&size + &self.re) / 2))?;
        let y = rational_sqrt(&(Rational::from(&size - &self.re) / 2))?;
        Some(Gauss::new(x, if self.im < 0 { -y } else { y }))
    }
}

/// The non-negative rational root of a rational square.
pub(super) fn rational_sqrt(q: &Rational) -> Option<Rational> {
    let square = |n: &rug::Integer| n.is_perfect_square().then(|| n.clone().sqrt());
    if *q < 0 {
        return None;
    }
    Some(Rational::from((square(q.numer())?, square(q.denom())?)))
}

impl Add for &Gauss {
    type Output = Gauss;
    fn add(self, w: &Gauss) -> Gauss {
        Gauss::new(
            Rational::from(&self.re + &w.re),
            Rational::from(&self.im + &w.im),
        )
    }
}

impl Sub for &Gauss {
    type Output = Gauss;
    fn sub(self, w: &Gauss) -> Gauss {
        Gauss::new(
            Rational::from(&self.re - &w.re),
            Rational::from(&self.im - &w.im),
        )
    }
}

impl Mul for &Gauss {
    type Output = Gauss;
    fn mul(self, w: &Gauss) -> Gauss {
        if self.im.is_zero() && w.im.is_zero() {
            return Gauss::real(Rational::from(&self.re * &w.re));
        }
        Gauss::new(
            Rational::from(&self.re * &w.re) - Rational::from(&self.im * &w.im),
            Rational::from(&self.re * &w.im) + Rational::from(&self.im * &w.re),
        )
    }
}

impl Neg for &Gauss {
    type Output = Gauss;
    fn neg(self) -> Gauss {
        Gauss::new(-self.re.clone(), -self.im.clone())
    }
}

impl fmt::Display for Gauss {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let imaginary = |q: &Rational| match q {
            q if *q == 1 => "i".to_string(),
            q if *q == -1 => "-i".to_string(),
            q => format!("{q}*i"),
        };
        match (self.re.is_zero(), self.im.is_zero()) {
            (_, true) => write!(f, "{}", self.re),
            (true, _) => write!(f, "{}", imaginary(&self.im)),
            _ => {
                let im = imaginary(&self.im);
                let sign = if im.starts_with('-') { "" } else { "+" };
                write!(f, "({}{sign}{im})", self.re)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_and_root() {
        let z = Gauss::new(Rational::from((3, 2)), -2);
        assert!((&z * &z.inverse().unwrap()).is_one());
        assert!(Gauss::default().inverse().is_none());
        // −i/2 = ((1−i)/2)².
        let half = Gauss::new(0, Rational::from((-1, 2)));
        let root = half.sqrt().unwrap();
        assert_eq!(root, Gauss::new((1, 2), (-1, 2)));
        assert_eq!(&root * &root, half);
        assert_eq!(Gauss::real(-4).sqrt(), Some(Gauss::new(0, 2)));
        assert_eq!(Gauss::real(2).sqrt(), None);
        assert_eq!(Gauss::i().sqrt(), None);
        assert_eq!(Gauss::default().sqrt(), Some(Gauss::default()));
    }

    #[test]
    fn powers_of_i_and_text() {
        let texts: Vec<String> = (-1..4).map(|k| Gauss::i_power(k).to_string()).collect();
        assert_eq!(texts, ["-i", "1", "i", "-1", "-i"]);
        assert_eq!(Gauss::new((1, 2), -3).to_string(), "(1/2-3*i)");
    }
}
