//! Truncated power series of complex balls, for integrals.

use super::complex;
use super::enclosure::{BITS, Enclosures, Point};
use super::error::unsupported;
use super::expr::{Bound, Func};
use super::walk::{Domain, Scope};
use super::{Gauss, SymbolicError};
use mechaudit_reference::{Ball, ComplexBall};

/// Evaluates to Taylor coefficients; trailing zeros are left out.
pub(super) struct Jets<'a> {
    /// Values of the symbols.
    pub point: &'a Point,
}

impl Jets<'_> {
    /// Number of coefficients.
    pub const ORDER: usize = 48;
}

type Series = Vec<ComplexBall>;

fn number<'a>(x: &'a Series, what: &str) -> Result<&'a ComplexBall, SymbolicError> {
    match x.as_slice() {
        [c] => Ok(c),
        _ => unsupported(format!("{what} under an integral")),
    }
}

impl Domain for Jets<'_> {
    type V = Series;

    fn constant(&mut self, c: &Gauss) -> Series {
        vec![Enclosures::new(self.point).constant(c)]
    }

    fn symbol(&mut self, name: &str) -> Result<Series, SymbolicError> {
        Ok(vec![Enclosures::new(self.point).symbol(name)?])
    }

    fn add(&mut self, a: &Series, b: &Series) -> Series {
        let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
        let mut out = long.clone();
        for (x, y) in out.iter_mut().zip(short) {
            *x = &*x + y;
        }
        out
    }

    fn mul(&mut self, a: &Series, b: &Series) -> Series {
        let n = (a.len() + b.len()).saturating_sub(1).min(Self::ORDER);
        let mut out = vec![ComplexBall::zero(BITS); n];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate().take(n - i.min(n)) {
                out[i + j] = &out[i + j] + &(x * y);
            }
        }
        out
    }

    fn div(&mut self, a: &Series, b: &Series) -> Result<Series, SymbolicError> {
        let b = number(b, "a quotient")?;
        a.iter()
            .map(|x| complex::quotient(x, b))
            .collect::<Option<Series>>()
            .ok_or_else(|| SymbolicError::NotInvertible("a number that may be zero".into()))
    }

    fn call(&mut self, f: Func, x: &[Series]) -> Result<Series, SymbolicError> {
        let [x] = x else {
            return unsupported(f.name());
        };
        if let (Func::Sin | Func::Cos, [_, _, ..]) = (f, x.as_slice()) {
            // sin x = (e^{ix} − e^{−ix})/(2i), cos x = (e^{ix} + e^{−ix})/2.
            let [up, down] = [Gauss::i(), Gauss::i_power(3)].map(|i| {
                let i = self.constant(&i);
                self.mul(&i, x)
            });
            let [up, down] = [self.call(Func::Exp, &[up])?, self.call(Func::Exp, &[down])?];
            let (half, other) = match f {
                Func::Cos => (Gauss::real((1, 2)), down),
                _ => (Gauss::new(0, (-1, 2)), self.neg(&down)),
            };
            let half = self.constant(&half);
            let sum = self.add(&up, &other);
            return Ok(self.mul(&half, &sum));
        }
        if f != Func::Exp {
            let x = number(x, f.name())?;
            let x = std::slice::from_ref(x);
            return Ok(vec![Enclosures::new(self.point).call(f, x)?]);
        }
        let Some(first) = x.first() else {
            return Ok(self.constant(&Gauss::real(1)));
        };
        // e = exp q: k e_k = Σ_j j q_j e_{k−j}.
        let mut e = vec![first.exp()];
        if x.len() == 1 {
            return Ok(e);
        }
        for k in 1..Self::ORDER {
            let mut sum = ComplexBall::zero(BITS);
            for (j, q) in x.iter().enumerate().take(k + 1).skip(1) {
                let term = &e[k - j] * &q.scaled(&Ball::integer(BITS, j as i64));
                sum = &sum + &term;
            }
            e.push(sum.scaled(&Ball::integer(BITS, k as i64).recip()));
        }
        Ok(e)
    }

    fn integral(&mut self, _: &mut Scope<Series>, _: &Bound) -> Result<Series, SymbolicError> {
        unsupported("an integral under an integral")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;
    use crate::walk::Definitions;
    use rug::Rational;

    fn number(q: (i32, i32)) -> ComplexBall {
        ComplexBall::new(
            Ball::rational(BITS, &Rational::from(q)),
            Ball::integer(BITS, 0),
        )
    }

    fn overlap(a: &ComplexBall, b: &ComplexBall) -> bool {
        a.re.overlaps(&b.re) && a.im.overlaps(&b.im)
    }

    /// `e^{as+s²} e^{bs−s²} = e^{(a+b)s}`, whose coefficients are `(a+b)^k/k!`; no more of them than are exact.
    #[test]
    fn products_of_exponentials() {
        let point = Point::default();
        let mut jets = Jets { point: &point };
        let mut e = |q: &[(i32, i32)]| {
            let series: Series = q.iter().map(|q| number(*q)).collect();
            jets.call(Func::Exp, &[series]).unwrap()
        };
        let (a, b) = (e(&[(0, 1), (2, 3), (1, 1)]), e(&[(0, 1), (1, 5), (-1, 1)]));
        let product = jets.mul(&a, &b);
        assert_eq!(product.len(), Jets::ORDER);
        let mut due = Rational::from(1);
        for (k, c) in product.iter().enumerate() {
            assert!(c.re.contains(&due) && c.im.contains_zero(), "{k}");
            due *= Rational::from((13, 15)) / Rational::from(k + 1);
        }
        let long = vec![number((1, 1)); Jets::ORDER + 9];
        assert_eq!(jets.mul(&long, &a).len(), Jets::ORDER);
        let short = jets.mul(&vec![number((2, 1)), number((1, 1))], &a);
        assert_eq!(short.len(), Jets::ORDER);
        assert!(overlap(&short[1], &number((7, 3))));
    }

    /// A series without coefficients is zero.
    #[test]
    fn empty_series() {
        let point = Point::default();
        let mut jets = Jets { point: &point };
        let (none, two) = (Series::new(), vec![number((2, 1)), number((3, 1))]);
        let one = jets.call(Func::Exp, std::slice::from_ref(&none)).unwrap();
        assert!(one.len() == 1 && one[0].re.contains(&1.into()) && one[0].im.is_zero());
        assert_eq!(jets.add(&none, &two).len(), 2);
        let product = jets.mul(&two, &none);
        assert!(product.iter().all(|c| c.re.is_zero() && c.im.is_zero()));
    }

    /// Functions of what does not vary are allowed under an integral; of what does, the exponential alone is.
    #[test]
    fn functions_under_integrals() {
        let point = Point {
            named: [("x".to_string(), Rational::from(4))].into(),
            sample: None,
        };
        let value = |text: &str| {
            Enclosures::new(&point).value(&Definitions::default(), &parse(text).unwrap())
        };
        for (text, due) in [
            ("int(s, 0, 1, sqrt(x)*s)", "1"),
            ("int(s, 0, 1, abs(-x)*s)", "2"),
            ("int(s, 0, 1, W(0)*s)", "1/2"),
            ("int(s, 0, 1, cos(2*s))", "sin(2)/2"),
        ] {
            assert!(
                overlap(&value(text).unwrap(), &value(due).unwrap()),
                "{text}"
            );
        }
        for (text, due) in [
            (
                "int(s, 0, 1, sqrt(s + 1))",
                "outside the algebra: sqrt under an integral",
            ),
            (
                "int(s, 0, 1, 1/(s + 1))",
                "outside the algebra: a quotient under an integral",
            ),
            (
                "int(s, 0, 1, s/(x - 4))",
                "cannot divide by a number that may be zero",
            ),
            (
                "int(s, 0, 1, int(u, 0, 1, u))",
                "outside the algebra: an integral under an integral",
            ),
            (
                "int(s, 0, 1, D(s, s))",
                "outside the algebra: a derivative by s in balls",
            ),
        ] {
            assert_eq!(value(text).unwrap_err().to_string(), due);
        }
    }
}
