//! Functions of real balls.

use super::ball::{Value, wrap};
use crate::Func;
use mechaudit_reference::elementary as real;
use mechaudit_reference::elementary::{Evaluated, NoValue};
use mechaudit_reference::{Ball, ComplexBall};

type Found = Result<Value, NoValue>;

/// A function of a real number.
pub(super) fn unary(f: Func, x: &Ball, p: u32) -> Found {
    let wrapped = match f {
        Func::Exp => real::exp(x, p),
        Func::Exp2 => real::exp2(x, p),
        Func::Exp10 => real::exp10(x, p),
        Func::Expm1 => real::expm1(x, p),
        Func::Log => real::log(x, p),
        Func::Log2 => real::log2(x, p),
        Func::Log10 => real::log10(x, p),
        Func::Log1p => real::log1p(x, p),
        Func::Sqrt => real::sqrt(x, p),
        Func::Cbrt => real::cbrt(x, p),
        Func::Sin => real::sin(x, p),
        Func::Cos => real::cos(x, p),
        Func::Tan => real::tan(x, p),
        Func::Asin => real::asin(x, p),
        Func::Acos => real::acos(x, p),
        Func::Arctan => real::atan(x, p),
        Func::Sinh => real::sinh(x, p),
        Func::Cosh => real::cosh(x, p),
        Func::Tanh => real::tanh(x, p),
        Func::Asinh => real::asinh(x, p),
        Func::Acosh => real::acosh(x, p),
        Func::Atanh => real::atanh(x, p),
        Func::Erf => real::erf(x, p),
        Func::Erfc => real::erfc(x, p),
        Func::Erfcx => real::erfcx(x, p),
        Func::Erfi => real::erfi(x, p),
        Func::Dawson => real::dawson(x, p),
        Func::Tgamma => real::tgamma(x, p),
        Func::Lgamma => real::lgamma(x, p),
        Func::Digamma => real::digamma(x, p),
        Func::AiryAi => real::airyai(x, p),
        Func::AiryAiPrime => real::airyaiprime(x, p),
        Func::AiryBi => real::airybi(x, p),
        Func::AiryBiPrime => real::airybiprime(x, p),
        Func::SinInt => real::si(x, p),
        Func::CosInt => real::ci(x, p),
        Func::Ei => real::ei(x, p),
        Func::ExpInt => real::e1(x, p),
        Func::LambertW => real::lambertw(x, p),
        Func::LambertWm1 => real::lambertwm1(x, p),
        Func::Zeta => real::zeta(x, p),
        Func::Abs => real::fabs(x, p),
        Func::Floor => real::floor(x, p),
        Func::Ceil => real::ceil(x, p),
        Func::Round => real::round(x, p),
        Func::Trunc => real::trunc(x, p),
        Func::Nearbyint => real::nearbyint(x, p),
        Func::Re | Func::Conj => Ok(x.clone()),
        Func::Im => Ok(Ball::integer(p, 0)),
        Func::Arg => match () {
            () if x.is_positive() => Ok(Ball::integer(p, 0)),
            () if x.is_negative() => Ok(Ball::pi(p)),
            () if x.is_zero() => Err(NoValue::Undefined("the argument of zero")),
            () => Err(NoValue::Undecided("the sign of an argument")),
        },
        Func::W => {
            let z = ComplexBall::new(x.clone(), Ball::integer(p, 0));
            return real::complex::w(&z, p).map(Value::Complex);
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
        | Func::WeierstrassPPrime => Err(NoValue::Undefined(
            "a function of another number of arguments",
        )),
    };
    wrap(wrapped)
}

/// A function of two real numbers.
pub(super) fn binary(f: Func, x: &Ball, y: &Ball, p: u32) -> Evaluated {
    match f {
        Func::Pow => real::pow(x, y, p),
        Func::Atan2 => real::atan2(x, y, p),
        Func::Hypot => real::hypot(x, y, p),
        Func::Fmin => real::fmin(x, y, p),
        Func::Fmax => real::fmax(x, y, p),
        Func::Fdim => real::fdim(x, y, p),
        Func::Fmod => real::fmod(x, y, p),
        Func::Remainder => real::remainder(x, y, p),
        Func::Copysign => real::copysign(x, y, p),
        Func::ZetaDerivative => real::zetaderivative(x, y, p),
        Func::BesselJ => real::besselj(x, y, p),
        Func::BesselI => real::besseli(x, y, p),
        Func::BesselIe => real::besselie(x, y, p),
        _ => Err(NoValue::Undefined(
            "a function of another number of arguments",
        )),
    }
}
