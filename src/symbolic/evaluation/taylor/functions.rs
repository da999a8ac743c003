//! Functions as operations of programs.

use super::{Compiler, Fixed, NO_SERIES, Placed, Side, Switch};
use crate::Func;
use crate::graph::{Id, Node};
use mechaudit_reference::initial_value::{Operation, Primitive, Slot};

impl Compiler<'_> {
    fn quotient(&mut self, n: i64, below: Slot) -> Slot {
        let above = self.number(n);
        self.push(Operation::Div(above, below))
    }

    /// An integer power by squares and products, which hold where the base is zero, too.
    pub(super) fn power(&mut self, a: Slot, k: i32) -> Slot {
        let mut rest = k.unsigned_abs();
        let mut square = a;
        let mut product = None;
        while rest > 0 {
            if rest % 2 == 1 {
                product = Some(match product {
                    Some(product) => self.push(Operation::Mul(product, square)),
                    None => square,
                });
            }
            rest /= 2;
            if rest > 0 {
                square = self.push(Operation::Square(square));
            }
        }
        match (product, k < 0) {
            (None, _) => self.number(1),
            (Some(product), false) => product,
            (Some(product), true) => self.quotient(1, product),
        }
    }

    fn scaled(&mut self, factor: Fixed, a: Slot) -> Slot {
        let factor = self.fixed(factor);
        self.push(Operation::Mul(factor, a))
    }

    fn primitive(&mut self, f: Primitive, a: Slot, slope: Slot) -> Slot {
        self.push(Operation::Primitive(f, vec![(a, slope)]))
    }

    fn log(&mut self, a: Slot) -> Slot {
        let slope = self.quotient(1, a);
        self.primitive(Primitive::Log, a, slope)
    }

    /// `1/(m + n a²)`, or the inverse of its root.
    fn inverse(&mut self, m: i64, n: i64, a: Slot, is_root: bool) -> Slot {
        let square = self.push(Operation::Square(a));
        let m = self.number(m);
        let sum = self.push(match n {
            1 => Operation::Add(m, square),
            _ => Operation::Sub(m, square),
        });
        let below = match is_root {
            true => self.push(Operation::Sqrt(sum)),
            false => sum,
        };
        self.quotient(1, below)
    }

    /// `(2/√π) e^{±a²}`.
    fn gaussian(&mut self, is_falling: bool, a: Slot) -> Slot {
        let mut square = self.push(Operation::Square(a));
        if is_falling {
            square = self.push(Operation::Neg(square));
        }
        let exponential = self.push(Operation::Exp(square));
        self.scaled(Fixed::TwoOverRootPi, exponential)
    }

    fn less_than(&mut self, n: i64, a: Slot) -> Slot {
        let n = self.number(n);
        self.push(Operation::Sub(n, a))
    }

    /// The logarithm of a number as a constant.
    fn log_of(&mut self, n: i64) -> Slot {
        let n = self.number(n);
        self.log(n)
    }

    pub(super) fn unary(&mut self, f: Func, id: Id, a: Slot) -> Placed {
        Ok(match f {
            Func::Exp => self.push(Operation::Exp(a)),
            Func::Exp2 | Func::Exp10 => {
                let log = self.log_of(if f == Func::Exp2 { 2 } else { 10 });
                let exponent = self.push(Operation::Mul(log, a));
                self.push(Operation::Exp(exponent))
            }
            Func::Expm1 => {
                let exponential = self.push(Operation::Exp(a));
                let one = self.number(1);
                self.push(Operation::Sub(exponential, one))
            }
            Func::Log => self.log(a),
            Func::Log2 | Func::Log10 => {
                let (log, base) = (
                    self.log(a),
                    self.log_of(if f == Func::Log2 { 2 } else { 10 }),
                );
                self.push(Operation::Div(log, base))
            }
            Func::Log1p => {
                let one = self.number(1);
                let sum = self.push(Operation::Add(one, a));
                self.log(sum)
            }
            Func::Sqrt => self.push(Operation::Sqrt(a)),
            Func::Cbrt => {
                let positive = self.is_positive(Switch::SignOf(id))?;
                let size = match positive {
                    true => a,
                    false => self.push(Operation::Neg(a)),
                };
                let root = self.push(Operation::Power(size, 1, 3));
                match positive {
                    true => root,
                    false => self.push(Operation::Neg(root)),
                }
            }
            Func::Sin => self.sine_cosine(a).0,
            Func::Cos => self.sine_cosine(a).1,
            Func::Tan => {
                let (sine, cosine) = self.sine_cosine(a);
                self.push(Operation::Div(sine, cosine))
            }
            Func::Arctan => {
                let slope = self.inverse(1, 1, a, false);
                self.primitive(Primitive::Atan, a, slope)
            }
            Func::Asin | Func::Acos => {
                let slope = self.inverse(1, -1, a, true);
                let sine = self.primitive(Primitive::Asin, a, slope);
                match f {
                    Func::Asin => sine,
                    _ => {
                        let half = self.fixed(Fixed::HalfPi);
                        self.push(Operation::Sub(half, sine))
                    }
                }
            }
            Func::Sinh | Func::Cosh | Func::Tanh => {
                let up = self.push(Operation::Exp(a));
                let down = self.quotient(1, up);
                let [sum, difference] =
                    [Operation::Add(up, down), Operation::Sub(up, down)].map(|o| self.push(o));
                let half = Fixed::Number((1, 2).into());
                match f {
                    Func::Sinh => self.scaled(half, difference),
                    Func::Cosh => self.scaled(half, sum),
                    _ => self.push(Operation::Div(difference, sum)),
                }
            }
            Func::Asinh => {
                let slope = self.inverse(1, 1, a, true);
                self.primitive(Primitive::Asinh, a, slope)
            }
            Func::Acosh => {
                let square = self.push(Operation::Square(a));
                let one = self.number(1);
                let below = self.push(Operation::Sub(square, one));
                let root = self.push(Operation::Sqrt(below));
                let slope = self.quotient(1, root);
                self.primitive(Primitive::Acosh, a, slope)
            }
            Func::Atanh => {
                let slope = self.inverse(1, -1, a, false);
                self.primitive(Primitive::Atanh, a, slope)
            }
            Func::Erf => {
                let slope = self.gaussian(true, a);
                self.primitive(Primitive::Erf, a, slope)
            }
            Func::Erfc | Func::Erfcx => {
                let slope = self.gaussian(true, a);
                let erf = self.primitive(Primitive::Erf, a, slope);
                let erfc = self.less_than(1, erf);
                match f {
                    Func::Erfc => erfc,
                    _ => {
                        let square = self.push(Operation::Square(a));
                        let exponential = self.push(Operation::Exp(square));
                        self.push(Operation::Mul(exponential, erfc))
                    }
                }
            }
            Func::Erfi => {
                let slope = self.gaussian(false, a);
                self.primitive(Primitive::Erfi, a, slope)
            }
            // e^{−a²} erfi(a) √π/2.
            Func::Dawson => {
                let slope = self.gaussian(false, a);
                let erfi = self.primitive(Primitive::Erfi, a, slope);
                let gaussian = self.gaussian(true, a);
                let product = self.push(Operation::Mul(erfi, gaussian));
                let factor = self.fixed(Fixed::TwoOverRootPi);
                let square = self.push(Operation::Square(factor));
                self.push(Operation::Div(product, square))
            }
            Func::Abs => match self.is_positive(Switch::SignOf(id))? {
                true => a,
                false => self.push(Operation::Neg(a)),
            },
            Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint => {
                match self.side(Switch::Step(f, id))? {
                    Side::Integer(n) => self.fixed(Fixed::Number(n)),
                    _ => return Err(NO_SERIES),
                }
            }
            Func::Re | Func::Conj => a,
            Func::Im => self.number(0),
            _ => return Err(NO_SERIES),
        })
    }

    pub(super) fn binary(&mut self, f: Func, left: Id, right: Id) -> Placed {
        let (a, b) = (self.known(left)?, self.known(right)?);
        Ok(match f {
            Func::Pow => {
                if let Node::Number(place) = self.graph.node(right) {
                    let exponent = self.graph.rational(place);
                    let whole = exponent.numer().to_i32().filter(|_| exponent.is_integer());
                    if let Some(k) = whole.filter(|k| k.abs() <= 1 << 16) {
                        return Ok(self.power(a, k));
                    }
                    if let Some(slot) = self.out.program.power(a, exponent) {
                        self.out.origin.resize(slot + 1, self.node);
                        return Ok(slot);
                    }
                }
                let log = self.log(a);
                let exponent = self.push(Operation::Mul(b, log));
                self.push(Operation::Exp(exponent))
            }
            Func::Hypot => {
                let squares = [a, b].map(|x| self.push(Operation::Square(x)));
                let sum = self.push(Operation::Add(squares[0], squares[1]));
                self.push(Operation::Sqrt(sum))
            }
            Func::Atan2 => {
                let squares = [a, b].map(|x| self.push(Operation::Square(x)));
                let sum = self.push(Operation::Add(squares[0], squares[1]));
                let [by_y, to_x] = [b, a].map(|x| self.push(Operation::Div(x, sum)));
                let by_x = self.push(Operation::Neg(to_x));
                let parts = vec![(a, by_y), (b, by_x)];
                self.push(Operation::Primitive(Primitive::Atan2, parts))
            }
            Func::Fmin | Func::Fmax => {
                let is_greater = self.is_greater(left, right)?;
                match is_greater == (f == Func::Fmax) {
                    true => a,
                    false => b,
                }
            }
            Func::Fdim => match self.is_greater(left, right)? {
                true => self.push(Operation::Sub(a, b)),
                false => self.number(0),
            },
            Func::Copysign => {
                let sign = self.side(Switch::SignOf(right))? != Side::Negative;
                let is_positive = match self.graph.node(left) {
                    Node::Number(place) => *self.graph.rational(place) >= 0,
                    _ => self.is_positive(Switch::SignOf(left))?,
                };
                match sign == is_positive {
                    true => a,
                    false => self.push(Operation::Neg(a)),
                }
            }
            _ => return Err(NO_SERIES),
        })
    }
}
