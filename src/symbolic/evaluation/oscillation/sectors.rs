//! Graphs on a sector of complex numbers next to an end.

use super::super::ball::{Balls, Value};
use super::super::{Evaluator, Interpretation, Stop};
use crate::graph::{Graph, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::ComplexBall;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::quadrature::Sector;
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

    /// The derivative, over a rectangle around zero, of a function that is zero there.
    fn slope_at_zero(&self, f: Func, z: &ComplexBall) -> Option<ComplexBall> {
        let mut balls = self.balls();
        let z = Value::Complex(z.clone());
        let one = balls.integer(1);
        let mut call = |f: Func, z: &Value| balls.call(f, &[z]).ok();
        let slope = match f {
            Func::Sin => call(Func::Cos, &z)?,
            Func::Sinh => call(Func::Cosh, &z)?,
            Func::Expm1 => call(Func::Exp, &z)?,
            Func::Tan | Func::Tanh => {
                let even = if f == Func::Tan {
                    Func::Cos
                } else {
                    Func::Cosh
                };
                let root = call(even, &z)?;
                balls.power(&root, -2).ok()?
            }
            Func::Log1p => {
                let below = balls.add(&one, &z).ok()?;
                balls.div(&one, &below).ok()?
            }
            Func::Arctan | Func::Asinh => {
                let square = balls.power(&z, 2).ok()?;
                let below = balls.add(&one, &square).ok()?;
                let below = match f {
                    Func::Arctan => below,
                    _ => balls.call(Func::Sqrt, &[&below]).ok()?,
                };
                balls.div(&one, &below).ok()?
            }
            _ => return None,
        };
        slope.to_complex()
    }

    fn of(&self, value: Result<Value, NoValue>) -> Found {
        let value = value?.to_complex().ok_or(UNKNOWN)?;
        Ok(self.variable.constant(&value))
    }
}

impl Interpretation for Sectors {
    type V = Sector;

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        Ok(self.variable.rational(graph.rational(place)))
    }

    fn integer(&mut self, n: i64) -> Sector {
        self.variable.rational(&Rational::from(n))
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
                let exponent = y.to_rational().ok_or(UNKNOWN)?;
                x.real_power(exponent).ok_or(UNKNOWN)
            }
            (_, [x]) => match x.vanishing(|z| self.slope_at_zero(f, z)) {
                Some(found) => Ok(found),
                None => {
                    let value = Value::Complex(x.values().ok_or(UNKNOWN)?);
                    let value = self.balls().call(f, &[&value]);
                    self.of(value)
                }
            },
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
