//! Complex numbers in double-double.

use crate::double_double::Dd;
use num_complex::Complex;
use std::ops::{Add, Mul, Neg, Sub};

/// A complex number in double-double.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cd(pub Dd, pub Dd);

impl Add for Cd {
    type Output = Cd;
    fn add(self, o: Cd) -> Cd {
        Cd(self.0 + o.0, self.1 + o.1)
    }
}

impl Sub for Cd {
    type Output = Cd;
    fn sub(self, o: Cd) -> Cd {
        Cd(self.0 - o.0, self.1 - o.1)
    }
}

impl Mul for Cd {
    type Output = Cd;
    fn mul(self, o: Cd) -> Cd {
        Cd(self.0 * o.0 - self.1 * o.1, self.0 * o.1 + self.1 * o.0)
    }
}

impl Neg for Cd {
    type Output = Cd;
    fn neg(self) -> Cd {
        Cd(-self.0, -self.1)
    }
}

impl Cd {
    pub fn scaled(self, x: Dd) -> Cd {
        Cd(self.0 * x, self.1 * x)
    }

    pub fn plus_one(self) -> Cd {
        Cd(self.0.add_f(1.0), self.1)
    }

    /// `−i` times it.
    pub fn turned(self) -> Cd {
        Cd(self.1, -self.0)
    }

    pub fn value(self) -> Complex<f64> {
        Complex::new(self.0.value(), self.1.value())
    }

    /// `1/z`
    pub fn inverse(self) -> Cd {
        let norm = self.0.square() + self.1.square();
        Cd(self.0.div(norm), -self.1.div(norm))
    }

    /// `(−i)^m` times it.
    pub fn turned_by(self, m: usize) -> Cd {
        match m % 4 {
            0 => self,
            1 => self.turned(),
            2 => -self,
            _ => -self.turned(),
        }
    }

    /// The larger component, without its sign.
    pub fn size(self) -> f64 {
        self.0.hi.abs().max(self.1.hi.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(re: f64, im: f64) -> Cd {
        Cd(Dd::from(re), Dd::from(im))
    }

    #[test]
    fn rules_of_complex_numbers() {
        let z = number(3.0, -4.0);
        assert_eq!((-z).value(), Complex::new(-3.0, 4.0));
        assert_eq!(z.turned().value(), Complex::new(-4.0, -3.0));
        for (m, due) in [(3.0, -4.0), (-4.0, -3.0), (-3.0, 4.0), (4.0, 3.0)]
            .iter()
            .enumerate()
        {
            for turns in [m, m + 4, m + 40] {
                assert_eq!(
                    z.turned_by(turns).value(),
                    Complex::new(due.0, due.1),
                    "{turns}"
                );
            }
        }
        assert_eq!((z.size(), number(-1.0, 0.5).size()), (4.0, 1.0));
        assert_eq!(z.plus_one().value(), Complex::new(4.0, -4.0));
        let one = z * z.inverse();
        assert!((one - number(1.0, 0.0)).size() < 1e-31, "{one:?}");
        assert_eq!(
            (z * z + z - z.scaled(Dd::from(2.0))).value(),
            Complex::new(-10.0, -20.0)
        );
    }
}
