//! Functions of complex balls, and continuations of real functions to complex arguments.

use super::ball::{Balls, Value};
use super::real::unary;
use crate::Func;
use mechaudit_reference::elementary as real;
use mechaudit_reference::elementary::{ComplexEvaluated, NoValue};
use mechaudit_reference::{Ball, ComplexBall, Mag};

type Found = Result<Value, NoValue>;

const NO_REAL_FUNCTION: NoValue = NoValue::Undefined("a real function of a complex number");

fn complex(x: &Value) -> Result<ComplexBall, NoValue> {
    x.to_complex().ok_or(super::huge::UNDECIDED)
}

/// `a / b`.
pub(super) fn div(a: &ComplexBall, b: &ComplexBall, p: u32) -> ComplexEvaluated {
    real::complex::div(a, b, p)
}

/// An integer power, by squarings; one of the inverse where the exponent is negative, because the
/// power of a rectangle may hold zero.
pub(super) fn power(z: &ComplexBall, k: i32, p: u32) -> ComplexEvaluated {
    let one = ComplexBall::new(Ball::integer(p, 1), Ball::integer(p, 0));
    let z = &match k < 0 {
        true => div(&one, z, p)?,
        false => z.clone(),
    };
    let mut product: Option<ComplexBall> = None;
    let bits = k.unsigned_abs();
    for place in (0..32 - bits.leading_zeros()).rev() {
        product = product.map(|x| x.square());
        if bits >> place & 1 == 1 {
            product = Some(match product {
                Some(x) => &x * z,
                None => z.clone(),
            });
        }
    }
    Ok(product.unwrap_or(one))
}

/// The inverse of a function without zeros over a wide rectangle, whose parts may hold zero.
pub(super) fn inverse(f: Func, x: &Value, p: u32) -> Option<Value> {
    use real::complex as c;
    let of = match f {
        Func::Cosh => c::sech,
        Func::Cos => |z: &ComplexBall, p| c::sech(&z.turned(), p),
        Func::Tgamma => c::inverse_gamma,
        _ => return None,
    };
    let is_wide = |z: &ComplexBall| z.radius() > Mag::power_of_two(-10);
    match x {
        Value::Continued(z) if is_wide(z) => of(z, p).ok().map(Value::Continued),
        Value::Complex(z) if is_wide(z) => of(z, p).ok().map(Value::Complex),
        _ => None,
    }
}

/// A holomorphic function of one complex number, principal branches.
fn holomorphic(f: Func, z: &ComplexBall, p: u32) -> Option<ComplexEvaluated> {
    use real::complex as c;
    let scaled = |e: ComplexEvaluated, by: Ball| e.map(|z| z.scaled(&by));
    let log = |n: i64| real::log(&Ball::integer(p, n), p);
    Some(match f {
        Func::Exp => c::exp(z, p),
        Func::Expm1 => c::expm1(z, p),
        Func::Exp2 | Func::Exp10 => {
            let base = if f == Func::Exp2 { 2 } else { 10 };
            log(base).and_then(|log| c::exp(&z.scaled(&log), p))
        }
        Func::Log => c::log(z, p),
        Func::Log1p => c::log1p(z, p),
        Func::Log2 | Func::Log10 => {
            let base = if f == Func::Log2 { 2 } else { 10 };
            log(base).and_then(|log| scaled(c::log(z, p), log.recip()))
        }
        Func::Sqrt => c::sqrt(z, p),
        Func::Cbrt => c::cbrt(z, p),
        Func::Sin => c::sin(z, p),
        Func::Cos => c::cos(z, p),
        Func::Tan => c::tan(z, p),
        Func::Asin => c::asin(z, p),
        Func::Acos => c::acos(z, p),
        Func::Arctan => c::atan(z, p),
        Func::Sinh => c::sinh(z, p),
        Func::Cosh => c::cosh(z, p),
        Func::Tanh => c::tanh(z, p),
        Func::Asinh => c::asinh(z, p),
        Func::Acosh => c::acosh(z, p),
        Func::Atanh => c::atanh(z, p),
        Func::Erf => c::erf(z, p),
        Func::Erfc => c::erfc(z, p),
        Func::Erfcx => c::erfcx(z, p),
        Func::Erfi => c::erfi(z, p),
        Func::Dawson => c::dawson(z, p),
        Func::W => c::w(z, p),
        Func::Tgamma => c::tgamma(z, p),
        // Real numbers have the logarithm of the modulus.
        Func::Lgamma if !z.im.is_zero() => c::lgamma(z, p),
        Func::AiryAi => c::airyai(z, p),
        Func::AiryAiPrime => c::airyaiprime(z, p),
        Func::AiryBi => c::airybi(z, p),
        Func::AiryBiPrime => c::airybiprime(z, p),
        Func::SinInt => c::si(z, p),
        Func::CosInt => c::ci(z, p),
        Func::Ei => c::ei(z, p),
        Func::ExpInt => c::e1(z, p),
        Func::LambertW => c::lambertw(z, p),
        Func::Zeta => c::zeta(z, p),
        Func::Abs
        | Func::Arg
        | Func::Re
        | Func::Im
        | Func::Conj
        | Func::Lgamma
        | Func::Digamma
        | Func::Floor
        | Func::Ceil
        | Func::Round
        | Func::Trunc
        | Func::Nearbyint
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
        | Func::Voigt
        | Func::LambertWm1
        | Func::ZetaDerivative
        | Func::BesselJ
        | Func::BesselI
        | Func::BesselIe
        | Func::WeierstrassP
        | Func::WeierstrassPPrime => return None,
    })
}

/// A holomorphic function of the second of two numbers, or of both.
fn holomorphic_in_two(f: Func, [a, b]: [&ComplexBall; 2], p: u32) -> Option<ComplexEvaluated> {
    use real::complex as c;
    let of_order = match f {
        Func::BesselJ => c::besselj,
        Func::BesselI => c::besseli,
        Func::BesselIe => c::besselie,
        Func::ZetaDerivative => c::zetaderivative,
        Func::WeierstrassP => return Some(c::weierstrassp(a, b, p)),
        Func::WeierstrassPPrime => return Some(c::weierstrasspprime(a, b, p)),
        _ => return None,
    };
    Some(match a.im.is_zero() {
        true => of_order(&a.re, b, p),
        false => Err(NoValue::Undecided("an order that is not real")),
    })
}

/// Returns true if a function is holomorphic on a box.
pub(super) fn is_off_cut(f: Func, z: &ComplexBall, p: u32) -> bool {
    matches!(holomorphic(f, z, p), Some(Ok(_)))
}

/// The principal logarithm on a box that may meet its cut: |Im| ≤ π.
fn log_across(z: &ComplexBall, p: u32) -> ComplexEvaluated {
    let size = real::hypot(&z.re, &z.im, p)?;
    let turn = Ball::integer(p, 0).widened(Ball::pi(64).magnitude());
    Ok(ComplexBall::new(real::log(&size, p)?, turn))
}

/// A square root, a logarithm or a power on a box that meets the cut along the negative real axis.
fn across_cut(f: Func, x: &[&Value], p: u32) -> Option<ComplexEvaluated> {
    let z = complex(x.first()?).ok()?;
    Some(match (f, x) {
        (Func::Sqrt, _) => {
            // |√z|² = |z|, and the real part is not negative.
            let size = Ball::new(z.magnitude().to_float(), Mag::ZERO);
            let size = real::sqrt(&size, p).ok()?.magnitude();
            let re = Ball::new(size.shift(-1).to_float(), Mag::ZERO).widened(size.shift(-1));
            Ok(ComplexBall::new(re, Ball::integer(p, 0).widened(size)))
        }
        (Func::Log, _) => log_across(&z, p),
        (Func::Pow, [_, w]) => {
            let w = complex(w).ok()?;
            log_across(&z, p).and_then(|log| real::complex::exp(&(&w * &log), p))
        }
        _ => return None,
    })
}

/// A function of complex numbers.
pub(super) fn call(f: Func, x: &[&Value], balls: &Balls, p: u32) -> Found {
    let found = off_cuts(f, x, balls.holomorphic, p);
    match found {
        Err(NoValue::Undecided(_)) if balls.wide && !balls.holomorphic => {
            across_cut(f, x, p).map_or(found, |z| z.map(Value::Complex))
        }
        found => found,
    }
}

/// A function of complex numbers, undecided where they may be on both sides of a cut.
fn off_cuts(f: Func, x: &[&Value], must_be_holomorphic: bool, p: u32) -> Found {
    if let [x] = x {
        let z = complex(x)?;
        if let Some(found) = holomorphic(f, &z, p) {
            return found.map(Value::Complex);
        }
        // These functions are not holomorphic.
        if must_be_holomorphic {
            return Err(NoValue::Undecided("a function that is not holomorphic"));
        }
        return match f {
            Func::Re => Ok(Value::Real(z.re)),
            Func::Im => Ok(Value::Real(z.im)),
            Func::Conj => Ok(Value::Complex(z.conj())),
            Func::Abs => real::hypot(&z.re, &z.im, p).map(Value::Real),
            Func::Arg if z.re.is_zero() && z.im.is_zero() => unary(f, &z.re, p),
            Func::Arg => real::atan2(&z.im, &z.re, p).map(Value::Real),
            _ if z.im.is_zero() => unary(f, &z.re, p),
            _ => Err(NO_REAL_FUNCTION),
        };
    }
    match (f, x) {
        (Func::Pow, [a, b]) => {
            real::complex::pow(&complex(a)?, &complex(b)?, p).map(Value::Complex)
        }
        (Func::Fma, [a, b, c]) => {
            let product = &complex(a)? * &complex(b)?;
            Ok(Value::Complex(&product + &complex(c)?))
        }
        (f, [a, b]) => match holomorphic_in_two(f, [&complex(a)?, &complex(b)?], p) {
            Some(found) => found.map(Value::Complex),
            None => Err(NO_REAL_FUNCTION),
        },
        _ => Err(NO_REAL_FUNCTION),
    }
}

/// The sign of the real part.
fn sign(z: &ComplexBall) -> Result<bool, NoValue> {
    match (z.re.is_positive(), z.re.is_negative()) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(NoValue::Undecided("a real part that may be zero")),
    }
}

fn real_part(z: &ComplexBall) -> Value {
    Value::Real(z.re.clone())
}

/// A function of a real variable, continued to where its argument is complex: by the branch that
/// holds on the real line there.
pub(super) fn continued(f: Func, x: &[&Value], p: u32) -> Found {
    let signed = |positive: bool, z: &ComplexBall| if positive { z.clone() } else { -z };
    let step = |f: Func, z: &ComplexBall| {
        let value = unary(f, &z.re, p)?;
        match value.real() {
            Some(n) if n.rad().is_zero() => Ok(n.clone()),
            _ => Err(NoValue::Undecided("a step")),
        }
    };
    let found = match x {
        [x] => {
            let z = complex(x)?;
            match f {
                Func::Abs => signed(sign(&z)?, &z),
                Func::Re | Func::Conj => z,
                Func::Im => return Ok(Value::Real(Ball::integer(p, 0))),
                Func::Arg => return unary(f, &z.re, p),
                // Odd on the real line.
                Func::Cbrt => {
                    let positive = sign(&z)?;
                    signed(positive, &real::complex::cbrt(&signed(positive, &z), p)?)
                }
                Func::Lgamma if sign(&z)? => real::complex::lgamma(&z, p)?,
                Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint => {
                    return step(f, &z).map(Value::Real);
                }
                Func::W => return real::complex::w(&z, p).map(Value::Complex),
                f => match holomorphic(f, &z, p) {
                    Some(found) => found?,
                    None => return Err(NoValue::Undecided("a function without continuation")),
                },
            }
        }
        [a, b] => {
            let (a, b) = (complex(a)?, complex(b)?);
            match f {
                Func::Pow => match (b.im.is_zero() && b.re.rad().is_zero()).then(|| b.re.mid()) {
                    Some(k) if k.is_integer() && *k < 1000 && *k > -1000 => {
                        power(&a, k.to_i32_saturating().unwrap_or(0), p)?
                    }
                    _ => real::complex::pow(&a, &b, p)?,
                },
                Func::Hypot => real::complex::sqrt(&(&a.square() + &b.square()), p)?,
                Func::Fmin | Func::Fmax => {
                    let first_is_larger = sign(&(&a - &b))?;
                    if first_is_larger == (f == Func::Fmax) {
                        a
                    } else {
                        b
                    }
                }
                Func::Fdim => {
                    let difference = &a - &b;
                    match sign(&difference)? {
                        true => difference,
                        false => return Ok(Value::Real(Ball::integer(p, 0))),
                    }
                }
                Func::Copysign => {
                    let positive = sign(&a)? == sign(&b)?;
                    signed(positive, &a)
                }
                Func::Fmod | Func::Remainder => {
                    let quotient = div(&a, &b, p)?;
                    let of = if f == Func::Fmod {
                        Func::Trunc
                    } else {
                        Func::Nearbyint
                    };
                    let n = step(of, &quotient)?;
                    &a - &b.scaled(&n)
                }
                // atan2(y, x) = atan(y/x) right of the axis, else ±π/2 − atan(x/y).
                Func::Atan2 => {
                    if b.re.is_positive() {
                        real::complex::atan(&div(&a, &b, p)?, p)?
                    } else {
                        let half = Ball::pi(p).shift(-1);
                        let half = if sign(&a)? { half } else { -half };
                        let angle = real::complex::atan(&div(&b, &a, p)?, p)?;
                        let half = ComplexBall::new(half, Ball::integer(p, 0));
                        &half - &angle
                    }
                }
                f => match holomorphic_in_two(f, [&a, &b], p) {
                    Some(found) => found?,
                    None => return Err(NoValue::Undecided("a function without continuation")),
                },
            }
        }
        [a, b, c] => {
            let (a, b, c) = (complex(a)?, complex(b)?, complex(c)?);
            match f {
                Func::Fma => &(&a * &b) + &c,
                // Re W((x + iγ)/(σ√2))/(σ√(2π)) is (W(z) + W(−z̄))/2 on the real line.
                Func::Voigt if sign(&b)? && sign(&c)? => {
                    let below = b.scaled(&Ball::integer(p, 2).sqrt());
                    let up = div(&(&a + &c.turned()), &below, p)?;
                    let down = div(&(&c.turned() - &a), &below, p)?;
                    let sum = &real::complex::w(&up, p)? + &real::complex::w(&down, p)?;
                    let width = below.scaled(&Ball::pi(p).sqrt().shift(1));
                    div(&sum, &width, p)?
                }
                _ => return Err(NoValue::Undecided("a function without continuation")),
            }
        }
        _ => return Err(NO_REAL_FUNCTION),
    };
    Ok(match found.im.is_zero() {
        true => real_part(&found),
        false => Value::Continued(found),
    })
}
