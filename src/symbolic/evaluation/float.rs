//! Graphs in floating point: one rounding an operation.

mod value;

pub use value::FloatValue;

use super::{Balls, Evaluator, Interpretation, Stop, Value};
use crate::graph::{Graph, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::{Ball, nearest_f64};
use rug::Float;
use rug::float::Round;

/// The format of the numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// binary64.
    #[default]
    Double,
    /// binary32.
    Single,
}

/// Whose elementary functions are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Elementary {
    /// Those of the platform.
    #[default]
    Platform,
    /// Correctly rounded ones.
    Correct,
}

/// The interpretation in floating point. A number of binary32 is kept in an `f64` that holds it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Floating {
    /// The format.
    pub format: Format,
    /// The elementary functions.
    pub elementary: Elementary,
}

const COMPLEX: NoValue = NoValue::Undefined("a real function of a complex number");

impl Floating {
    /// Rounds a result of binary64. For the sum, the difference, the product, the quotient and the
    /// square root of numbers of binary32 this is the correctly rounded result of binary32, since
    /// 53 ≥ 2 · 24 + 2 (S. A. Figueroa, *When is double rounding innocuous?*, SIGNUM 30(3), 1995).
    fn round(self, x: f64) -> f64 {
        match self.format {
            Format::Double => x,
            Format::Single => f64::from(x as f32),
        }
    }

    /// The number of the format that is nearest to a real number.
    fn nearest(self, value: impl Fn(u32) -> (Float, std::cmp::Ordering)) -> f64 {
        match self.format {
            Format::Double => {
                let (mut x, way) = value(53);
                x.subnormalize_ieee_round(way, Round::Nearest);
                x.to_f64()
            }
            Format::Single => {
                let (mut x, way) = value(24);
                x.subnormalize_ieee_round(way, Round::Nearest);
                f64::from(x.to_f32())
            }
        }
    }

    fn unary(self, f: Func, x: f64) -> Result<f64, NoValue> {
        if self.elementary == Elementary::Correct
            && let Some(value) = self.correct(f, x)
        {
            return Ok(value);
        }
        if self.format == Format::Single
            && let Some(value) = single(f, x as f32)
        {
            return Ok(value.into());
        }
        let value = match f {
            Func::Exp => x.exp(),
            Func::Exp2 => x.exp2(),
            Func::Exp10 => libm::exp10(x),
            Func::Expm1 => x.exp_m1(),
            Func::Log => x.ln(),
            Func::Log2 => x.log2(),
            Func::Log10 => x.log10(),
            Func::Log1p => x.ln_1p(),
            Func::Sqrt => x.sqrt(),
            Func::Cbrt => x.cbrt(),
            Func::Sin => x.sin(),
            Func::Cos => x.cos(),
            Func::Tan => x.tan(),
            Func::Asin => x.asin(),
            Func::Acos => x.acos(),
            Func::Arctan => x.atan(),
            Func::Sinh => x.sinh(),
            Func::Cosh => x.cosh(),
            Func::Tanh => x.tanh(),
            Func::Asinh => libm::asinh(x),
            Func::Acosh => libm::acosh(x),
            Func::Atanh => libm::atanh(x),
            Func::Erf => libm::erf(x),
            Func::Erfc => libm::erfc(x),
            Func::Tgamma => libm::tgamma(x),
            Func::Lgamma => libm::lgamma(x),
            Func::Abs => x.abs(),
            Func::Floor => x.floor(),
            Func::Ceil => x.ceil(),
            Func::Round => x.round(),
            Func::Trunc => x.trunc(),
            Func::Nearbyint => x.round_ties_even(),
            Func::Re | Func::Conj => x,
            Func::Im => 0.0,
            Func::Arg => return self.binary(Func::Atan2, 0.0, x),
            Func::W
            | Func::Erfcx
            | Func::Erfi
            | Func::Dawson
            | Func::Digamma
            | Func::AiryAi
            | Func::AiryAiPrime
            | Func::AiryBi
            | Func::AiryBiPrime
            | Func::SinInt
            | Func::CosInt
            | Func::Ei
            | Func::ExpInt
            | Func::LambertW
            | Func::LambertWm1
            | Func::Zeta => {
                return Err(NoValue::Undefined("a function that is not in C's library"));
            }
            Func::Pow
            | Func::Atan2
            | Func::Hypot
            | Func::Fmin
            | Func::Fmax
            | Func::Fdim
            | Func::Fmod
            | Func::Remainder
            | Func::Copysign
            | Func::Fma
            | Func::Voigt
            | Func::ZetaDerivative
            | Func::BesselJ
            | Func::BesselI
            | Func::BesselIe
            | Func::WeierstrassP
            | Func::WeierstrassPPrime => {
                return Err(NoValue::Undefined(
                    "a function of another number of arguments",
                ));
            }
        };
        Ok(self.round(value))
    }

    /// A function of MPFR, or one that balls enclose, rounded once to the format; none for those
    /// that are exact.
    fn correct(self, f: Func, x: f64) -> Option<f64> {
        let x = Float::with_val(53, x);
        macro_rules! rounded {
            ($method:ident) => {
                self.nearest(|bits| Float::with_val_round(bits, x.$method(), Round::Nearest))
            };
        }
        Some(match f {
            Func::Exp => rounded!(exp_ref),
            Func::Exp2 => rounded!(exp2_ref),
            Func::Exp10 => rounded!(exp10_ref),
            Func::Expm1 => rounded!(exp_m1_ref),
            Func::Log => rounded!(ln_ref),
            Func::Log2 => rounded!(log2_ref),
            Func::Log10 => rounded!(log10_ref),
            Func::Log1p => rounded!(ln_1p_ref),
            Func::Cbrt => rounded!(cbrt_ref),
            Func::Sin => rounded!(sin_ref),
            Func::Cos => rounded!(cos_ref),
            Func::Tan => rounded!(tan_ref),
            Func::Asin => rounded!(asin_ref),
            Func::Acos => rounded!(acos_ref),
            Func::Arctan => rounded!(atan_ref),
            Func::Sinh => rounded!(sinh_ref),
            Func::Cosh => rounded!(cosh_ref),
            Func::Tanh => rounded!(tanh_ref),
            Func::Asinh => rounded!(asinh_ref),
            Func::Acosh => rounded!(acosh_ref),
            Func::Atanh => rounded!(atanh_ref),
            Func::Erf => rounded!(erf_ref),
            Func::Erfc => rounded!(erfc_ref),
            Func::Tgamma => rounded!(gamma_ref),
            Func::Lgamma => self.nearest(|bits| {
                let mut value = Float::with_val(bits, &x);
                let (_, way) = value.ln_abs_gamma_round(Round::Nearest);
                (value, way)
            }),
            // These are exact or rounded once already.
            Func::Sqrt | Func::Re | Func::Im | Func::Conj | Func::Arg => return None,
            f if f.is_rational() => return None,
            f => return self.enclosed(f, &[x.to_f64()]),
        })
    }

    /// The number that both ends of an enclosure are rounded to, at a precision that is raised
    /// until they are the same.
    fn enclosed(self, f: Func, x: &[f64]) -> Option<f64> {
        /// A function whose value is so close to a tie is not decided.
        const MOST: u32 = 2048;
        let mut bits = 128;
        while x.iter().all(|x| x.is_finite()) && bits <= MOST {
            let exact = |x: &f64| Value::Real(Ball::exact(bits, *x));
            let x: Vec<Value> = x.iter().map(exact).collect();
            let x: Vec<&Value> = x.iter().collect();
            let value = Balls::new(bits).call(f, &x).ok()?;
            let ball = value.real()?;
            let [low, high] = [ball.lower(), ball.upper()]
                .map(|end| self.nearest(|bits| Float::with_val_round(bits, &end, Round::Nearest)));
            if low == high {
                return Some(low);
            }
            bits *= 2;
        }
        None
    }

    fn binary(self, f: Func, x: f64, y: f64) -> Result<f64, NoValue> {
        let single = self.format == Format::Single;
        if self.elementary == Elementary::Correct {
            let [a, b] = [x, y].map(|x| Float::with_val(53, x));
            match f {
                Func::Pow => {
                    use rug::ops::Pow;
                    return Ok(self.nearest(|bits| {
                        Float::with_val_round(bits, (&a).pow(&b), Round::Nearest)
                    }));
                }
                Func::Atan2 => {
                    return Ok(self.nearest(|bits| {
                        Float::with_val_round(bits, a.atan2_ref(&b), Round::Nearest)
                    }));
                }
                Func::Hypot => {
                    return Ok(self.nearest(|bits| {
                        Float::with_val_round(bits, a.hypot_ref(&b), Round::Nearest)
                    }));
                }
                f if f.is_rational() => {}
                f => {
                    let why = NoValue::Undefined("a function that is not in C's library");
                    return self.enclosed(f, &[x, y]).ok_or(why);
                }
            }
        }
        Ok(match f {
            Func::Pow if single => f64::from((x as f32).powf(y as f32)),
            Func::Atan2 if single => f64::from((x as f32).atan2(y as f32)),
            Func::Hypot if single => f64::from((x as f32).hypot(y as f32)),
            Func::Pow => x.powf(y),
            Func::Atan2 => x.atan2(y),
            Func::Hypot => x.hypot(y),
            Func::Fmin => x.min(y),
            Func::Fmax => x.max(y),
            Func::Fdim => self.round(libm::fdim(x, y)),
            Func::Fmod => x % y,
            Func::Remainder => libm::remainder(x, y),
            Func::Copysign => x.copysign(y),
            _ => {
                return Err(NoValue::Undefined("a function that is not in C's library"));
            }
        })
    }
}

/// The platform's functions of binary32.
fn single(f: Func, x: f32) -> Option<f32> {
    Some(match f {
        Func::Exp => x.exp(),
        Func::Exp2 => x.exp2(),
        Func::Expm1 => x.exp_m1(),
        Func::Log => x.ln(),
        Func::Log2 => x.log2(),
        Func::Log10 => x.log10(),
        Func::Log1p => x.ln_1p(),
        Func::Cbrt => x.cbrt(),
        Func::Sin => x.sin(),
        Func::Cos => x.cos(),
        Func::Tan => x.tan(),
        Func::Asin => x.asin(),
        Func::Acos => x.acos(),
        Func::Arctan => x.atan(),
        Func::Sinh => x.sinh(),
        Func::Cosh => x.cosh(),
        Func::Tanh => x.tanh(),
        Func::Asinh => libm::asinhf(x),
        Func::Acosh => libm::acoshf(x),
        Func::Atanh => libm::atanhf(x),
        Func::Erf => libm::erff(x),
        Func::Erfc => libm::erfcf(x),
        Func::Tgamma => libm::tgammaf(x),
        Func::Lgamma => libm::lgammaf(x),
        _ => return None,
    })
}

impl Interpretation for Floating {
    type V = FloatValue;

    fn number(&mut self, graph: &Graph, place: u32) -> Result<FloatValue, NoValue> {
        let q = graph.rational(place);
        Ok(FloatValue::from(match self.format {
            Format::Double => nearest_f64(q),
            Format::Single => self.nearest(|bits| Float::with_val_round(bits, q, Round::Nearest)),
        }))
    }

    fn integer(&mut self, n: i64) -> FloatValue {
        self.round(n as f64).into()
    }

    /// The constant of C's header, which is the nearest number.
    fn constant(&mut self, c: Constant) -> Result<FloatValue, NoValue> {
        let ball = Balls::new(128).constant(c)?;
        let value = ball.real().map(Ball::mid).ok_or(COMPLEX)?.clone();
        let nearest = self.nearest(|bits| Float::with_val_round(bits, &value, Round::Nearest));
        Ok(nearest.into())
    }

    fn imaginary_unit(&mut self) -> Result<FloatValue, NoValue> {
        Ok(FloatValue::I)
    }

    fn infinity(&mut self) -> Result<FloatValue, NoValue> {
        Ok(f64::INFINITY.into())
    }

    fn neg(&mut self, a: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(self.negative(a))
    }

    fn add(&mut self, a: &FloatValue, b: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(self.sum(a, b))
    }

    fn sub(&mut self, a: &FloatValue, b: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(self.difference(a, b))
    }

    fn mul(&mut self, a: &FloatValue, b: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(self.product(a, b))
    }

    fn div(&mut self, a: &FloatValue, b: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(self.quotient(a, b))
    }

    /// A square is a product; other powers of real numbers are those of `pow`.
    fn power(&mut self, a: &FloatValue, k: i32) -> Result<FloatValue, NoValue> {
        match (a.real(), k) {
            (_, 1) => Ok(*a),
            (_, 2) => Ok(self.product(a, a)),
            (Some(x), k) => self.binary(Func::Pow, x, k.into()).map(FloatValue::from),
            (None, k) => Ok(self.complex_power(a, k)),
        }
    }

    fn call(&mut self, f: Func, x: &[&FloatValue]) -> Result<FloatValue, NoValue> {
        if let [z] = *x
            && z.real().is_none()
        {
            return self.complex_call(f, z);
        }
        let x: Option<Vec<f64>> = x.iter().map(|x| x.real()).collect();
        let value = match x.ok_or(COMPLEX)?[..] {
            [x] => self.unary(f, x),
            [x, y] => self.binary(f, x, y),
            [x, y, z] if f == Func::Fma => Ok(match self.format {
                Format::Double => x.mul_add(y, z),
                Format::Single => f64::from((x as f32).mul_add(y as f32, z as f32)),
            }),
            _ => Err(NoValue::Undefined("a function that is not in C's library")),
        };
        value.map(FloatValue::from)
    }

    fn flat(&mut self, _: Func, _: &FloatValue) -> Result<FloatValue, NoValue> {
        Ok(0.0.into())
    }

    fn compare(
        &mut self,
        relation: Relation,
        a: &FloatValue,
        b: &FloatValue,
    ) -> Result<bool, NoValue> {
        let (Some(a), Some(b)) = (a.real(), b.real()) else {
            return Err(NoValue::Undefined("a comparison of complex numbers"));
        };
        Ok(match relation {
            Relation::Less => a < b,
            Relation::LessEqual => a <= b,
            Relation::Greater => a > b,
            Relation::GreaterEqual => a >= b,
            Relation::Equal => a == b,
            Relation::NotEqual => a != b,
        })
    }

    fn to_integer(&self, a: &FloatValue) -> Option<i64> {
        let a = a.real()?;
        (a.fract() == 0.0 && a.abs() < 9e15).then_some(a as i64)
    }

    fn bound(evaluator: &mut Evaluator<Floating>, binder: u32) -> Result<FloatValue, Stop> {
        let node = evaluator.graph().find(Node::Bound(binder)).unwrap_or(0);
        let reason = NoValue::Undefined("an integral, a root or an infinite sum in floating point");
        Err(Stop { node, reason })
    }
}

#[cfg(test)]
mod tests;
