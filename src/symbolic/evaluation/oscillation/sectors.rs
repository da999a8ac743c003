//! Graphs on a sector of complex numbers next to an end.

use super::super::ball::{Balls, Value};
use super::super::{Evaluator, Interpretation, Stop};
use crate::graph::{Graph, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::quadrature::Sector;
use mechaudit_reference::{Ball, ComplexBall};
use rug::Rational;

/// The interpretation on a sector next to an end.
pub(super) struct Sectors {
    /// The variable of the integrand.
    pub variable: Sector,
}

const UNKNOWN: NoValue = NoValue::Undecided("a function that is not known next to an end");

type Found = Result<Sector, NoValue>;

impl Sectors {
    const BITS: u32 = 64;

    fn balls(&self) -> Balls {
        let mut balls = Balls::new(Sectors::BITS);
        balls.holomorphic = true;
        balls
    }

    fn of(&self, value: Result<Value, NoValue>) -> Found {
        let value = value?.to_complex().ok_or(UNKNOWN)?;
        Ok(self.variable.constant(&value))
    }
}

impl Interpretation for Sectors {
    type V = Sector;

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        let value = self.balls().number(graph, place);
        self.of(value)
    }

    fn integer(&mut self, n: i64) -> Sector {
        let bits = Sectors::BITS;
        let value = ComplexBall::new(Ball::integer(bits, n), Ball::integer(bits, 0));
        self.variable.constant(&value)
    }

    fn constant(&mut self, c: Constant) -> Found {
        let value = self.balls().constant(c);
        self.of(value)
    }

    fn imaginary_unit(&mut self) -> Found {
        let value = self.balls().imaginary_unit();
        self.of(value)
    }

    fn infinity(&mut self) -> Found {
        Err(UNKNOWN)
    }

    fn neg(&mut self, a: &Sector) -> Found {
        Ok(a.negative())
    }

    fn add(&mut self, a: &Sector, b: &Sector) -> Found {
        Ok(a.add(b))
    }

    fn sub(&mut self, a: &Sector, b: &Sector) -> Found {
        Ok(a.add(&b.negative()))
    }

    fn mul(&mut self, a: &Sector, b: &Sector) -> Found {
        Ok(a.mul(b))
    }

    fn div(&mut self, a: &Sector, b: &Sector) -> Found {
        Ok(a.mul(&b.inverse().ok_or(UNKNOWN)?))
    }

    fn power(&mut self, a: &Sector, k: i32) -> Found {
        match k.unsigned_abs() {
            0..=1024 => a.power(k).ok_or(UNKNOWN),
            _ => Err(UNKNOWN),
        }
    }

    fn call(&mut self, f: Func, x: &[&Sector]) -> Found {
        match (f, x) {
            (Func::Sqrt, [x]) => x.real_power(&Rational::from((1, 2))).ok_or(UNKNOWN),
            (Func::Cbrt, [x]) => x.real_power(&Rational::from((1, 3))).ok_or(UNKNOWN),
            (Func::Pow, [x, y]) => {
                let y = y.values().ok_or(UNKNOWN)?;
                let is_exact = y.im.is_zero() && y.re.rad().is_zero();
                let exponent =
                    y.re.mid()
                        .to_rational()
                        .filter(|_| is_exact)
                        .ok_or(UNKNOWN)?;
                x.real_power(&exponent).ok_or(UNKNOWN)
            }
            (_, [x]) => {
                let value = Value::Complex(x.values().ok_or(UNKNOWN)?);
                let value = self.balls().call(f, &[&value]);
                self.of(value)
            }
            _ => Err(UNKNOWN),
        }
    }

    fn flat(&mut self, _: Func, _: &Sector) -> Found {
        Err(UNKNOWN)
    }

    fn compare(&mut self, _: Relation, _: &Sector, _: &Sector) -> Result<bool, NoValue> {
        Err(UNKNOWN)
    }

    fn to_integer(&self, _: &Sector) -> Option<i64> {
        None
    }

    fn bound(evaluator: &mut Evaluator<Sectors>, binder: u32) -> Result<Sector, Stop> {
        let node = evaluator.graph().find(Node::Bound(binder)).unwrap_or(0);
        let reason = UNKNOWN;
        Err(Stop { node, reason })
    }
}
