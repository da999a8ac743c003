//! Graphs next to an end of an interval of integration: bounds that tell how fast an integrand
//! grows or decays there.

use super::ball::{Balls, Value};
use super::{Evaluator, Interpretation, Stop};
use crate::graph::{Graph, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::quadrature::Germ;
use mechaudit_reference::{Ball, Mag};

/// The interpretation for all distances of at most `2^−k` from the end.
#[derive(Clone, Debug)]
pub(super) struct Germs {
    /// The exponent of the distance.
    pub k: u32,
    /// The precision of coefficients.
    pub bits: u32,
}

/// A function next to an end, and its value where it is constant.
#[derive(Clone, Debug)]
pub(super) struct Near {
    germ: Germ,
    constant: Option<Ball>,
}

impl Near {
    /// A function that may vary.
    pub fn varying(germ: Germ) -> Near {
        Near {
            germ,
            constant: None,
        }
    }

    /// The germ.
    pub fn germ(&self) -> &Germ {
        &self.germ
    }
}

const UNKNOWN: NoValue = NoValue::Undecided("a function without bounds next to an end");

type Found = Result<Near, NoValue>;

fn found(germ: Option<Germ>) -> Found {
    germ.map(Near::varying).ok_or(UNKNOWN)
}

impl Germs {
    /// A constant.
    pub fn constant_of(&self, value: &Ball) -> Near {
        Near {
            germ: Germ::constant(value, self.k),
            constant: Some(value.clone()),
        }
    }

    /// A function with values between two integers.
    fn within(&self, low: i64, high: i64) -> Germ {
        let ball = Ball::integer(self.bits, low + high).shift(-1);
        let radius = Mag::from_f64((high - low) as f64).shift(-1);
        Germ::within(&ball.widened(radius), self.k)
    }

    fn balls(&self) -> Balls {
        Balls::new(self.bits)
    }

    fn number(&self, value: Result<Value, NoValue>) -> Found {
        let value = value?;
        value.real().map(|x| self.constant_of(x)).ok_or(UNKNOWN)
    }

    /// `e^x`, `e^{−x}` and their scalings.
    fn exponential(&self, f: Func, x: &Germ) -> Option<Germ> {
        let one = Germ::constant(&Ball::integer(self.bits, 1), self.k);
        let log = |n: i64| Germ::constant(&Ball::integer(self.bits, n).ln(), self.k);
        match f {
            Func::Exp => x.exp(),
            Func::Expm1 => x.exp()?.sub(&one),
            Func::Exp2 => x.mul(&log(2))?.exp(),
            Func::Exp10 => x.mul(&log(10))?.exp(),
            Func::Sinh | Func::Cosh => {
                let half = Germ::constant(&Ball::exact(self.bits, 0.5), self.k);
                let (up, down) = (x.exp()?, x.neg().exp()?);
                let sum = match f {
                    Func::Sinh => up.sub(&down)?,
                    _ => up.add(&down)?,
                };
                // Of numbers of different size the larger one bounds the sum from below.
                sum.mul(&half)
            }
            _ => None,
        }
    }

    fn unary(&self, f: Func, x: &Germ) -> Option<Germ> {
        let one = Germ::constant(&Ball::integer(self.bits, 1), self.k);
        let log = |n: i64| Germ::constant(&Ball::integer(self.bits, n).ln(), self.k);
        match f {
            Func::Exp | Func::Expm1 | Func::Exp2 | Func::Exp10 | Func::Sinh | Func::Cosh => {
                self.exponential(f, x)
            }
            Func::Log => x.ln(),
            Func::Log1p => one.add(x)?.ln(),
            Func::Log2 => x.ln()?.div(&log(2)),
            Func::Log10 => x.ln()?.div(&log(10)),
            Func::Sqrt => x.sqrt(),
            Func::Cbrt => {
                let third = Ball::integer(self.bits, 3).recip();
                match x.is_negative() {
                    true => Some(x.neg().pow(&third)?.neg()),
                    false => x.pow(&third),
                }
            }
            Func::Sin => x.sin(),
            Func::Cos => x.cos(),
            Func::Tan => x.sin()?.div(&x.cos()?),
            Func::Arctan => x.atan(),
            Func::Tanh => {
                // (e^{2x} − 1)/(e^{2x} + 1), or its bounds.
                let twice = x.add(x)?.exp();
                let quotient = twice.and_then(|e| e.sub(&one)?.div(&e.add(&one)?));
                quotient.or_else(|| Some(self.within(-1, 1)))
            }
            Func::Abs => x.abs(),
            Func::Re | Func::Conj => Some(x.clone()),
            // erfc(x) = e^{−x²} erfcx(x), and erfcx is at most 1 for x ≥ 0.
            Func::Erfc if x.is_positive() => x.powi(2)?.neg().exp()?.mul(&self.within(0, 1)),
            Func::Erfc => Some(self.within(0, 2)),
            Func::Erfcx if x.is_positive() => Some(self.within(0, 1)),
            Func::Erf | Func::Dawson | Func::AiryAi => Some(self.within(-1, 1)),
            Func::SinInt => Some(self.within(-2, 2)),
            // 0 < E₁(x) < e^{−x} ln(1 + 1/x) (DLMF 6.8.1).
            Func::ExpInt if x.is_positive() => {
                let log = one.add(&one.div(x)?)?.ln()?;
                x.neg().exp()?.mul(&log)?.mul(&self.within(0, 1))
            }
            // e^x ≤ Γ(x) ≤ x^x ≤ e^{x²} for x ≥ 8: Γ(8) = 5040 > e^8, and ψ(x) > 1 from there on.
            Func::Tgamma => {
                let eight = Germ::constant(&Ball::integer(self.bits, 8), self.k);
                let is_large = x.sub(&eight)?.is_positive();
                is_large.then_some(())?;
                x.exp()?.between(&x.powi(2)?.exp()?)
            }
            // At most one away from the argument.
            Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint => {
                x.add(&self.within(-1, 1))
            }
            Func::Asinh | Func::Acosh | Func::Atanh => {
                let square = x.powi(2)?;
                match f {
                    Func::Asinh => x.add(&square.add(&one)?.sqrt()?)?.ln(),
                    Func::Acosh => x.add(&square.sub(&one)?.sqrt()?)?.ln(),
                    _ => {
                        let half = Germ::constant(&Ball::exact(self.bits, 0.5), self.k);
                        one.add(x)?.div(&one.sub(x)?)?.ln()?.mul(&half)
                    }
                }
            }
            Func::Asin
            | Func::Acos
            | Func::Erfcx
            | Func::Erfi
            | Func::Lgamma
            | Func::Digamma
            | Func::AiryAiPrime
            | Func::AiryBi
            | Func::AiryBiPrime
            | Func::CosInt
            | Func::Ei
            | Func::ExpInt
            | Func::LambertW
            | Func::LambertWm1
            | Func::Zeta
            | Func::ZetaDerivative
            | Func::BesselJ
            | Func::BesselI
            | Func::BesselIe
            | Func::WeierstrassP
            | Func::WeierstrassPPrime
            | Func::W
            | Func::Im
            | Func::Arg
            | Func::Pow
            | Func::Atan2
            | Func::Hypot
            | Func::Fmin
            | Func::Fmax
            | Func::Fdim
            | Func::Fmod
            | Func::Remainder
            | Func::Copysign
            | Func::Fma
            | Func::Voigt => None,
        }
    }

    fn binary(&self, f: Func, x: &Near, y: &Near) -> Option<Germ> {
        let is_integer = |x: &Near| {
            let order = x.constant.as_ref();
            order.is_some_and(|n| n.rad().is_zero() && n.mid().is_integer())
        };
        let (a, b) = (&x.germ, &y.germ);
        match f {
            Func::Pow => match (&x.constant, &y.constant) {
                (_, Some(exponent)) => {
                    let integer = exponent.mid().to_integer().and_then(|n| n.to_i32());
                    match integer.filter(|n| exponent.rad().is_zero() && *exponent.mid() == *n) {
                        Some(n) => a.powi(n),
                        None => a.pow(exponent),
                    }
                }
                _ => b.mul(&a.ln()?)?.exp(),
            },
            Func::Hypot => a.powi(2)?.add(&b.powi(2)?)?.sqrt(),
            Func::Fmin | Func::Fmax => a.either(b),
            Func::Atan2 => Some(self.within(-4, 4)),
            Func::Copysign => a.abs()?.mul(&self.within(-1, 1)),
            // |J_n(x)| ≤ 1 for an integer n (DLMF 10.9.2).
            Func::BesselJ if is_integer(x) => Some(self.within(-1, 1)),
            // |e^{−x} I_n(x)| ≤ (1/π) ∫_0^π e^{−x (1 − cos θ)} dθ (10.32.3) ≤ √(π/8x), from
            // 1 − cos θ ≥ 2θ²/π².
            Func::BesselIe if is_integer(x) && b.is_positive() => {
                let half = Ball::exact(self.bits, -0.5);
                b.pow(&half)?.mul(&self.within(-1, 1))
            }
            Func::Fdim => {
                let zero = Germ::constant(&Ball::integer(self.bits, 0), self.k);
                a.sub(b)?.either(&zero)
            }
            _ => None,
        }
    }
}

impl Interpretation for Germs {
    type V = Near;

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        let value = self.balls().number(graph, place);
        Germs::number(self, value)
    }

    fn integer(&mut self, n: i64) -> Near {
        self.constant_of(&Ball::integer(self.bits, n))
    }

    fn constant(&mut self, c: Constant) -> Found {
        let value = self.balls().constant(c);
        Germs::number(self, value)
    }

    fn imaginary_unit(&mut self) -> Found {
        Err(UNKNOWN)
    }

    fn infinity(&mut self) -> Found {
        Err(UNKNOWN)
    }

    fn neg(&mut self, a: &Near) -> Found {
        Ok(Near {
            germ: a.germ.neg(),
            constant: a.constant.as_ref().map(|x| -x),
        })
    }

    fn add(&mut self, a: &Near, b: &Near) -> Found {
        found(a.germ.add(&b.germ))
    }

    fn sub(&mut self, a: &Near, b: &Near) -> Found {
        found(a.germ.sub(&b.germ))
    }

    fn mul(&mut self, a: &Near, b: &Near) -> Found {
        found(a.germ.mul(&b.germ))
    }

    fn div(&mut self, a: &Near, b: &Near) -> Found {
        found(a.germ.div(&b.germ))
    }

    fn power(&mut self, a: &Near, k: i32) -> Found {
        found(a.germ.powi(k))
    }

    fn call(&mut self, f: Func, x: &[&Near]) -> Found {
        // A function of constants is a constant.
        let constants: Option<Vec<Value>> = x
            .iter()
            .map(|x| x.constant.clone().map(Value::Real))
            .collect();
        if let Some(constants) = constants {
            let constants: Vec<&Value> = constants.iter().collect();
            let value = self.balls().call(f, &constants);
            return Germs::number(self, value);
        }
        match x {
            [x] => found(self.unary(f, &x.germ)),
            [x, y] => found(self.binary(f, x, y)),
            [x, y, z] if f == Func::Fma => {
                found(x.germ.mul(&y.germ).and_then(|product| product.add(&z.germ)))
            }
            _ => Err(UNKNOWN),
        }
    }

    fn flat(&mut self, _: Func, _: &Near) -> Found {
        Err(UNKNOWN)
    }

    fn compare(&mut self, relation: Relation, a: &Near, b: &Near) -> Result<bool, NoValue> {
        let difference = a.germ.sub(&b.germ).ok_or(UNKNOWN)?;
        let positive = match (difference.is_positive(), difference.is_negative()) {
            (true, _) => true,
            (_, true) => false,
            _ => return Err(UNKNOWN),
        };
        Ok(match relation {
            Relation::Less | Relation::LessEqual => !positive,
            Relation::Greater | Relation::GreaterEqual => positive,
            Relation::Equal => false,
            Relation::NotEqual => true,
        })
    }

    fn to_integer(&self, a: &Near) -> Option<i64> {
        let x = Value::Real(a.constant.clone()?);
        self.balls().to_integer(&x)
    }

    fn bound(evaluator: &mut Evaluator<Germs>, binder: u32) -> Result<Near, Stop> {
        let node = evaluator.graph().find(Node::Bound(binder)).unwrap_or(0);
        Err(Stop {
            node,
            reason: UNKNOWN,
        })
    }
}
