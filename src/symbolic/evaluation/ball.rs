//! Graphs in balls at a working precision.

use super::mirror::{self, Mirrored};
use super::real::{binary, unary};
use super::{Evaluator, Interpretation, Stop};
use super::{complex, cost, huge};
use crate::graph::{Binding, Graph, Id, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::elementary as real;
use mechaudit_reference::elementary::complex::Bessel;
use mechaudit_reference::elementary::{Evaluated, NoValue};
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::{Float, Rational};
use std::cell::OnceCell;
use std::cmp::Ordering;

/// A value in balls.
#[derive(Clone, Debug)]
pub enum Value {
    /// A real number.
    Real(Ball),
    /// A rational number, kept exactly beside its ball where comparisons ask for it.
    Exact(Box<Exact>),
    /// A complex number.
    Complex(ComplexBall),
    /// A function of a real variable, continued to a rectangle of complex values of it, where it is
    /// holomorphic.
    Continued(ComplexBall),
    /// As [`Value::Continued`], of a function whose values are complex on the real line.
    Mirrored(Box<Mirrored>),
    /// A number of magnitude `2^exponent` or more, beyond the exponents of MPFR.
    Huge {
        /// True if it is below zero.
        negative: bool,
        /// The exponent, at least 2^20.
        exponent: i64,
    },
}

/// A rational number with its ball, which is made when it is asked for.
#[derive(Clone, Debug)]
pub struct Exact {
    number: Rational,
    prec: u32,
    ball: OnceCell<Ball>,
}

impl Exact {
    /// The number.
    pub fn number(&self) -> &Rational {
        &self.number
    }

    fn ball(&self) -> &Ball {
        self.ball.get_or_init(|| ball_of(self.prec, &self.number))
    }
}

impl Value {
    /// A rational number whose ball has a precision.
    pub fn rational(prec: u32, number: Rational) -> Value {
        let ball = OnceCell::new();
        Value::Exact(Box::new(Exact { number, prec, ball }))
    }

    /// The real number: of a complex one whose imaginary part is exactly zero as well.
    pub fn real(&self) -> Option<&Ball> {
        match self {
            Value::Real(x) => Some(x),
            Value::Exact(x) => Some(x.ball()),
            Value::Complex(z) if z.im.is_zero() => Some(&z.re),
            _ => None,
        }
    }

    /// The number as a complex one.
    pub fn to_complex(&self) -> Option<ComplexBall> {
        match self {
            Value::Real(x) => Some(ComplexBall::new(x.clone(), Ball::integer(x.prec(), 0))),
            Value::Exact(x) => Value::Real(x.ball().clone()).to_complex(),
            Value::Complex(z) | Value::Continued(z) => Some(z.clone()),
            Value::Mirrored(f) => Some(f.value.clone()),
            Value::Huge { .. } => None,
        }
    }
}

/// The interpretation in balls.
#[derive(Clone, Debug)]
pub struct Balls {
    /// The working precision in bits.
    pub prec: u32,
    /// Bits of relative accuracy that integrals and roots are enclosed to.
    pub goal: u32,
    /// True if rational numbers are kept exactly, so that equal ones are seen to be equal.
    pub exact: bool,
    /// True if values have to be holomorphic functions of the variable that is continued.
    pub holomorphic: bool,
    /// True if complex functions are continued with their mirror images: a complex value is then a
    /// constant wherever values have to be holomorphic.
    pub mirrors: bool,
    /// True if a wide enclosure is of use: of an integrand over an interval.
    pub wide: bool,
    /// True if the square root of a negative number is complex, as in the symbolic algebra, and not
    /// undefined.
    pub has_complex_roots: bool,
    /// Binary places to which an integral next to zero is enclosed, if they are fewer than the
    /// precision.
    pub places: u32,
    /// Evaluations of an integrand before an integral is given up.
    pub evaluations: u64,
    /// Bits to which the variables of integrals around are known.
    pub known: i64,
    /// The precisions of nodes; `prec` for those beyond their end.
    pub precisions: Vec<u32>,
    /// The precision at which the wide arguments of trigonometric functions are narrow ones.
    pub hint: u32,
    /// The work that is left, in units of some nanoseconds.
    pub work: u64,
    /// Tangents at poles.
    pub poles: Vec<Id>,
}

/// A value of a real function; one that is too large for MPFR is huge.
pub(super) fn wrap(found: Evaluated) -> Result<Value, NoValue> {
    match found {
        Ok(ball) => Ok(Value::Real(ball)),
        Err(NoValue::Overflow { negative }) => Ok(huge::overflow(negative)),
        Err(other) => Err(other),
    }
}

type Found = Result<Value, NoValue>;

/// Bits of numerator and denominator up to which rational numbers are kept exactly.
const LONGEST: u32 = 1 << 14;

impl Balls {
    /// Bits of relative accuracy that an integral or a root is due now: more than the goal where
    /// the working precision was raised, because a sum with it may cancel. The other half of the
    /// bits is for constants in it, which are known to the working precision alone.
    pub(super) fn due(&self) -> u32 {
        self.goal.max(self.prec / 2)
    }

    /// A rational number with its ball.
    fn rational(&self, q: Rational) -> Value {
        let bits = q
            .numer()
            .significant_bits()
            .max(q.denom().significant_bits());
        match bits <= LONGEST {
            true => Value::rational(self.prec, q),
            false => Value::Real(Ball::rational(self.prec, &q)),
        }
    }

    /// The result of an operation on rational numbers; none where one of them is not.
    fn exactly(
        &self,
        a: &Value,
        b: &Value,
        of: fn(&Rational, &Rational) -> Option<Rational>,
    ) -> Option<Value> {
        match (a, b) {
            (Value::Exact(x), Value::Exact(y)) => {
                of(&x.number, &y.number).map(|q| self.rational(q))
            }
            _ => None,
        }
    }

    /// The arithmetic of what is not real.
    fn pair(
        &self,
        a: &Value,
        b: &Value,
        of: fn(&ComplexBall, &ComplexBall, u32) -> real::ComplexEvaluated,
    ) -> Found {
        let is_complex = matches!(a, Value::Complex(_)) || matches!(b, Value::Complex(_));
        let (Some(x), Some(y)) = (a.to_complex(), b.to_complex()) else {
            return Err(huge::UNDECIDED);
        };
        let z = of(&x, &y, self.prec)?;
        if self.is_mirrored(&[a, b]) {
            let images = a.image().zip(b.image());
            let image = images.and_then(|(x, y)| of(&x, &y, self.prec).ok());
            return Ok(Mirrored::value(z, image));
        }
        Ok(match is_complex {
            true => Value::Complex(z),
            false => Value::Continued(z),
        })
    }
}

impl Interpretation for Balls {
    type V = Value;

    fn at(&mut self, id: Id, node: Node) -> Result<(), NoValue> {
        if self.poles.contains(&id) {
            return Err(NoValue::Undefined("the tangent of a right angle"));
        }
        if let Some(prec) = self.precisions.get(id as usize) {
            self.prec = *prec;
        }
        let cost = cost::of(node, self.prec);
        match self.work.checked_sub(cost) {
            Some(left) => self.work = left,
            // Nothing else is tried in its place.
            None => {
                self.work = 0;
                return Err(NoValue::Undecided(cost::REASON));
            }
        }
        Ok(())
    }

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        let q = graph.rational(place);
        Ok(match self.exact {
            true => self.rational(q.clone()),
            false => Value::Real(ball_of(self.prec, q)),
        })
    }

    fn integer(&mut self, n: i64) -> Value {
        match self.exact {
            true => self.rational(n.into()),
            false => Value::Real(Ball::integer(self.prec, n)),
        }
    }

    fn constant(&mut self, c: Constant) -> Found {
        let p = self.prec;
        let pi = || Ball::pi(p);
        let log = |n: i64| real::log(&Ball::integer(p, n), p);
        let root_of_2 = || Ball::integer(p, 2).sqrt();
        Ok(Value::Real(match c {
            Constant::Pi => pi(),
            Constant::HalfPi => pi().shift(-1),
            Constant::QuarterPi => pi().shift(-2),
            Constant::InversePi => pi().recip(),
            Constant::TwoOverPi => pi().recip().shift(1),
            Constant::TwoOverRootPi => pi().sqrt().recip().shift(1),
            Constant::E => real::exp(&Ball::integer(p, 1), p)?,
            Constant::Ln2 => log(2)?,
            Constant::Ln10 => log(10)?,
            Constant::Log2E => log(2)?.recip(),
            Constant::Log10E => log(10)?.recip(),
            Constant::Sqrt2 => root_of_2(),
            Constant::InverseSqrt2 => root_of_2().shift(-1),
        }))
    }

    fn imaginary_unit(&mut self) -> Found {
        let [zero, one] = [0, 1].map(|n| Ball::integer(self.prec, n));
        Ok(Value::Complex(ComplexBall::new(zero, one)))
    }

    fn infinity(&mut self) -> Found {
        Ok(huge::infinity())
    }

    fn neg(&mut self, a: &Value) -> Found {
        Ok(match a {
            Value::Real(x) => Value::Real(-x),
            Value::Exact(x) => self.rational(Rational::from(-&x.number)),
            Value::Complex(z) => Value::Complex(-z),
            Value::Continued(z) => Value::Continued(-z),
            Value::Mirrored(f) => f.map(|z| Ok(-z))?,
            Value::Huge { negative, exponent } => Value::Huge {
                negative: !negative,
                exponent: *exponent,
            },
        })
    }

    fn add(&mut self, a: &Value, b: &Value) -> Found {
        match (a, b) {
            (Value::Real(x), Value::Real(y)) => wrap(real::add(x, y, self.prec)),
            (Value::Exact(_), _) | (_, Value::Exact(_)) => {
                match self.exactly(a, b, |x, y| Some(Rational::from(x + y))) {
                    Some(value) => Ok(value),
                    None => self.add(&inexact(a), &inexact(b)),
                }
            }
            (Value::Huge { .. }, _) | (_, Value::Huge { .. }) => huge::add(a, b),
            _ => self.pair(a, b, |x, y, _| Ok(x + y)),
        }
    }

    fn sub(&mut self, a: &Value, b: &Value) -> Found {
        match (a, b) {
            (Value::Real(x), Value::Real(y)) => wrap(real::sub(x, y, self.prec)),
            (Value::Exact(_), _) | (_, Value::Exact(_)) => {
                match self.exactly(a, b, |x, y| Some(Rational::from(x - y))) {
                    Some(value) => Ok(value),
                    None => self.sub(&inexact(a), &inexact(b)),
                }
            }
            (Value::Huge { .. }, _) | (_, Value::Huge { .. }) => {
                let minus = self.neg(b)?;
                huge::add(a, &minus)
            }
            _ => self.pair(a, b, |x, y, _| Ok(x - y)),
        }
    }

    fn mul(&mut self, a: &Value, b: &Value) -> Found {
        match (a, b) {
            (Value::Real(x), Value::Real(y)) => wrap(real::mul(x, y, self.prec)),
            (Value::Exact(_), _) | (_, Value::Exact(_)) => {
                match self.exactly(a, b, |x, y| Some(Rational::from(x * y))) {
                    Some(value) => Ok(value),
                    None => self.mul(&inexact(a), &inexact(b)),
                }
            }
            (Value::Huge { .. }, _) | (_, Value::Huge { .. }) => huge::mul(a, b),
            // A real factor needs half of the products.
            (Value::Real(x), Value::Complex(z)) | (Value::Complex(z), Value::Real(x)) => {
                Ok(Value::Complex(z.scaled(x)))
            }
            (Value::Real(x), Value::Continued(z)) | (Value::Continued(z), Value::Real(x)) => {
                Ok(Value::Continued(z.scaled(x)))
            }
            _ => self.pair(a, b, |x, y, _| Ok(x * y)),
        }
    }

    fn div(&mut self, a: &Value, b: &Value) -> Found {
        match (a, b) {
            (Value::Real(x), Value::Real(y)) => wrap(real::div(x, y, self.prec)),
            (Value::Exact(_), _) | (_, Value::Exact(_)) => {
                let quotient =
                    |x: &Rational, y: &Rational| (*y != 0).then(|| Rational::from(x / y));
                match (self.exactly(a, b, quotient), b) {
                    (Some(value), _) => Ok(value),
                    (None, Value::Exact(y)) if y.number == 0 => {
                        Err(NoValue::Undefined("division by zero"))
                    }
                    (None, _) => self.div(&inexact(a), &inexact(b)),
                }
            }
            (Value::Huge { .. }, _) | (_, Value::Huge { .. }) => huge::div(a, b, self.prec),
            _ => self.pair(a, b, complex::div),
        }
    }

    fn power(&mut self, a: &Value, k: i32) -> Found {
        match a {
            Value::Real(x) if k == 2 => wrap(real::sqr(x, self.prec)),
            Value::Real(x) => wrap(real::powi(x, k.into(), self.prec)),
            Value::Exact(x) => match (x.number.cmp0(), k.unsigned_abs() <= 64) {
                (Ordering::Equal, _) | (_, false) => self.power(&inexact(a), k),
                (_, true) => {
                    use rug::ops::Pow;
                    Ok(self.rational(Rational::from((&x.number).pow(k))))
                }
            },
            Value::Huge { .. } => huge::power(a, k, self.prec),
            Value::Complex(z) => complex::power(z, k, self.prec).map(Value::Complex),
            Value::Continued(z) => complex::power(z, k, self.prec).map(Value::Continued),
            Value::Mirrored(f) => f.map(|z| complex::power(z, k, self.prec)),
        }
    }

    fn call(&mut self, f: Func, x: &[&Value]) -> Found {
        let p = self.prec;
        if x.iter().any(|x| matches!(x, Value::Exact(_))) {
            let rational = |x: &&Value| match x {
                Value::Exact(x) => Some(x.number.clone()),
                _ => None,
            };
            let rationals: Option<Vec<Rational>> = x.iter().map(rational).collect();
            if let Some(q) = rationals.and_then(|x| f.at_rationals(&x)) {
                return Ok(self.rational(q));
            }
            if let (Some(which), [Value::Exact(order), z]) = (bessel(f), x)
                && !order.number.denom().is_power_of_two()
            {
                return match inexact(z) {
                    Value::Real(x) => wrap(real::bessel(which, &order.number, &x, p)),
                    Value::Complex(z) => {
                        real::complex::bessel(which, &order.number, &z, p).map(Value::Complex)
                    }
                    Value::Continued(z) => {
                        real::complex::bessel(which, &order.number, &z, p).map(Value::Continued)
                    }
                    _ => Err(huge::UNDECIDED),
                };
            }
            let plain: Vec<Value> = x.iter().map(|x| inexact(x)).collect();
            let plain: Vec<&Value> = plain.iter().collect();
            return self.call(f, &plain);
        }
        match x {
            [Value::Real(x)] if self.has_complex_roots && f == Func::Sqrt && x.is_negative() => {
                let root = real::sqrt(&-x, p)?;
                Ok(Value::Complex(ComplexBall::new(Ball::integer(p, 0), root)))
            }
            [Value::Real(x)] => {
                if let Func::Sin | Func::Cos | Func::Tan = f {
                    self.hint = self.hint.max(bits_of_turns(x));
                }
                unary(f, x, p)
            }
            [Value::Real(x), Value::Real(y)] => wrap(binary(f, x, y, p)),
            [Value::Real(x), Value::Real(y), Value::Real(z)] => wrap(match f {
                Func::Fma => real::fma(x, y, z, p),
                _ => real::voigt(x, y, z, p),
            }),
            x if x.iter().any(|x| matches!(x, Value::Huge { .. })) => huge::call(f, x, p),
            x if self.is_mirrored(x) => mirror::call(f, x, self),
            [Value::Continued(z)] if f == Func::W && self.mirrors => mirror::w(z, p),
            x if x.iter().any(|x| matches!(x, Value::Complex(_))) => complex::call(f, x, self, p),
            x => complex::continued(f, x, p),
        }
    }

    fn inverse(&mut self, f: Func, x: &Value) -> Option<Value> {
        complex::inverse(f, x, self.prec)
    }

    fn flat(&mut self, f: Func, x: &Value) -> Found {
        // A sign, or a function of a complex number off its cut.
        let is_step = matches!(
            f,
            Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint
        );
        let is_off = match (f, x.real(), x) {
            _ if is_step => None,
            (Func::Arg, Some(x), _) => Some(!x.contains_zero()),
            (Func::Arg, _, Value::Continued(z)) => Some(!z.re.contains_zero()),
            (_, Some(x), _) => Some(x.is_positive()),
            (_, _, Value::Complex(z)) => Some(complex::is_off_cut(f, z, self.prec)),
            (_, _, Value::Mirrored(g)) => Some(complex::is_off_cut(f, &g.value, self.prec)),
            _ => Some(false),
        };
        match is_off {
            Some(true) => return Ok(self.integer(0)),
            Some(false) => return Err(NoValue::Undecided("the derivative at a jump")),
            None => {}
        }
        let steps = match x {
            Value::Real(x) => x,
            Value::Exact(x) => x.ball(),
            Value::Continued(z) => &z.re,
            _ => return Err(huge::UNDECIDED),
        };
        // A step function whose values over the ball are one number is constant there.
        let value = unary(f, steps, self.prec)?;
        match value.real().is_some_and(|v| v.rad().is_zero()) {
            true => Ok(self.integer(0)),
            false => Err(NoValue::Undecided("the derivative of a step")),
        }
    }

    fn compare(&mut self, relation: Relation, a: &Value, b: &Value) -> Result<bool, NoValue> {
        let order = match (a, b) {
            (Value::Exact(x), Value::Exact(y)) => Some(x.number.cmp(&y.number)),
            (Value::Huge { .. }, _) | (_, Value::Huge { .. }) => huge::order(a, b),
            _ => {
                let part = |v: &Value| match v {
                    Value::Real(x) => Some(x.clone()),
                    Value::Exact(x) => Some(x.ball().clone()),
                    Value::Continued(z) => Some(z.re.clone()),
                    Value::Complex(z) if z.im.is_zero() => Some(z.re.clone()),
                    _ => None,
                };
                match (part(a), part(b)) {
                    (Some(a), Some(b)) => order(&a, &b),
                    _ => return Err(NoValue::Undefined("complex numbers have no order")),
                }
            }
        };
        let order = order.ok_or(NoValue::Undecided(MAY_BE_EQUAL))?;
        Ok(relation.holds(order))
    }

    fn has_both(&self) -> bool {
        self.wide && !self.holomorphic
    }

    fn union(&self, a: &Value, b: &Value) -> Found {
        if let (Some(a), Some(b)) = (a.real(), b.real()) {
            return Ok(Value::Real(a.union(b)));
        }
        match (a.to_complex(), b.to_complex()) {
            (Some(a), Some(b)) => {
                let z = ComplexBall::new(a.re.union(&b.re), a.im.union(&b.im));
                Ok(Value::Complex(z))
            }
            _ => Err(huge::UNDECIDED),
        }
    }

    fn to_integer(&self, a: &Value) -> Option<i64> {
        let x = a.real()?;
        let n = x.mid().to_integer()?.to_i64()?;
        (x.rad().is_zero() && *x.mid() == n).then_some(n)
    }

    fn bound(evaluator: &mut Evaluator<Balls>, binder: u32) -> Result<Value, Stop> {
        let graph = evaluator.graph().clone();
        let node = graph.find(Node::Bound(binder)).unwrap_or(0);
        let stop = |reason| Stop { node, reason };
        match graph.binder(binder).binding {
            Binding::Integral { from, to, body } => {
                super::integral::integral(evaluator, binder, node, [from, to, body])
            }
            Binding::Root {
                from,
                to,
                body,
                slope,
                which,
            } => {
                // The hull of two parts is no function whose mean values a derivative bounds.
                let wide = std::mem::take(&mut evaluator.interpretation.wide);
                let nodes = [from, to, body, slope];
                let found = super::root::root(evaluator, binder, node, nodes, which);
                evaluator.interpretation.wide = wide;
                found
            }
            Binding::Sum { from, body, .. } => {
                super::sum::infinite(evaluator, binder, node, [from, body])
            }
            _ => Err(stop(NoValue::Undecided("a binder without a value"))),
        }
    }

    fn system(
        evaluator: &mut Evaluator<Balls>,
        binder: u32,
        node: u32,
    ) -> Result<Vec<Value>, Stop> {
        let wide = std::mem::take(&mut evaluator.interpretation.wide);
        let found = super::system::solution(evaluator, binder, node);
        evaluator.interpretation.wide = wide;
        found
    }
}

/// The ball of a rational number: exact and without a division for one that a double holds.
pub(super) fn ball_of(prec: u32, q: &Rational) -> Ball {
    /// Bits of numbers that are kept whole, however few are asked for.
    const SHORT: u32 = 64;
    let denominator = q.denom();
    match denominator.is_power_of_two() && q.numer().significant_bits() <= SHORT {
        true => {
            let numerator = Float::with_val(SHORT, q.numer());
            Ball::new(numerator >> (denominator.significant_bits() - 1), Mag::ZERO)
        }
        false => Ball::rational(prec, q),
    }
}

/// The precision at which the argument of a trigonometric function has a radius of some `2^-80`, if
/// it has one above `2^-10` now; zero if it has less.
fn bits_of_turns(x: &Ball) -> u32 {
    match (x.rad().exponent(), x.magnitude().exponent()) {
        (Some(-10..), Some(e)) => u32::try_from(e + 80).unwrap_or(0),
        _ => 0,
    }
}

/// Reason that exact rational numbers may settle.
pub(super) const MAY_BE_EQUAL: &str = "a comparison of numbers that may be equal";

/// A value without its exact rational number.
fn inexact(x: &Value) -> Value {
    match x {
        Value::Exact(x) => Value::Real(x.ball().clone()),
        x => x.clone(),
    }
}

/// How two numbers are ordered, if the balls decide it.
fn order(a: &Ball, b: &Ball) -> Option<Ordering> {
    if a.rad().is_zero() && b.rad().is_zero() {
        return a.mid().partial_cmp(b.mid());
    }
    // The difference of the midpoints to a few bits, against the radii.
    let difference = a - b;
    match () {
        () if difference.is_positive() => Some(Ordering::Greater),
        () if difference.is_negative() => Some(Ordering::Less),
        () => None,
    }
}

/// The Bessel function that is meant, whose order has to be exact.
pub(super) fn bessel(f: Func) -> Option<Bessel> {
    match f {
        Func::BesselJ => Some(Bessel::First),
        Func::BesselI => Some(Bessel::Modified),
        Func::BesselIe => Some(Bessel::Scaled),
        _ => None,
    }
}
