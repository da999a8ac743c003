//! Truncated power series of complex balls, for integrals.

use super::complex;
use super::enclosure::{BITS, Enclosures, Point};
use super::expr::{Bound, Expr, Func};
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
        _ => Err(SymbolicError::Unsupported(format!(
            "{what} under an integral"
        ))),
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

    fn call(&mut self, f: Func, x: &Series) -> Result<Series, SymbolicError> {
        if f != Func::Exp {
            let x = number(x, f.name())?;
            return Ok(vec![Enclosures::new(self.point).call(f, x)?]);
        }
        let Some(first) = x.first() else {
            return Ok(self.constant(&Gauss::real(1)));
        };
        // e = exp q: k e_k = Σ_j j q_j e_{k−j}.
        let mut e = vec![complex::exp(first)];
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
        Err(SymbolicError::Unsupported(
            "an integral under an integral".into(),
        ))
    }

    fn derivative(
        &mut self,
        _: &mut Scope<Series>,
        _: &Expr,
        by: &str,
    ) -> Result<Series, SymbolicError> {
        Err(SymbolicError::Unsupported(format!(
            "a derivative by {by} in balls"
        )))
    }
}
