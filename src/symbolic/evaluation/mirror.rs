//! Complex functions of a real variable, continued together with their mirror images.
//!
//! The mirror image of `F` is `F*(z) = conj F(conj z)`, which is holomorphic where `F` is so on the
//! mirrored set, and `conj F` on the real line. Real part, imaginary part, modulus and argument of `F`
//! continue by it to `(F + F*)/2`, `(F − F*)/2i`, `√(F F*)` and `(log F − log F*)/2i`.

use super::ball::{Balls, Value};
use super::complex;
use crate::Func;
use mechaudit_reference::ComplexBall;
use mechaudit_reference::elementary as real;
use mechaudit_reference::elementary::{ComplexEvaluated, NoValue};

type Found = Result<Value, NoValue>;

const UNKNOWN: NoValue = NoValue::Undecided("a function that is not holomorphic");

/// A function on a rectangle.
#[derive(Clone, Debug)]
pub struct Mirrored {
    /// Encloses its values.
    pub value: ComplexBall,
    /// Encloses the values of its mirror image, if they are known.
    pub image: Option<ComplexBall>,
}

impl Mirrored {
    /// The function with these values.
    pub(super) fn value(value: ComplexBall, image: Option<ComplexBall>) -> Value {
        Value::Mirrored(Box::new(Mirrored { value, image }))
    }

    /// A function of it that is its own mirror image.
    pub(super) fn map(&self, of: impl Fn(&ComplexBall) -> ComplexEvaluated) -> Found {
        let image = self.image.as_ref().and_then(|z| of(z).ok());
        Ok(Mirrored::value(of(&self.value)?, image))
    }
}

impl Value {
    /// The mirror image, where it is known: that of a constant is its conjugate.
    pub(super) fn image(&self) -> Option<ComplexBall> {
        match self {
            Value::Complex(z) => Some(z.conj()),
            Value::Mirrored(f) => f.image.clone(),
            other => other.to_complex(),
        }
    }
}

impl Balls {
    /// Returns true if a function of these values is complex and varies with the variable that is
    /// continued.
    pub(super) fn is_mirrored(&self, x: &[&Value]) -> bool {
        let any = |kind: fn(&Value) -> bool| x.iter().any(|x| kind(x));
        any(|x| matches!(x, Value::Mirrored(_)))
            || self.mirrors
                && any(|x| matches!(x, Value::Complex(_)))
                && any(|x| matches!(x, Value::Continued(_)))
    }
}

/// A function of values of which one is such a function.
pub(super) fn call(f: Func, x: &[&Value], balls: &Balls) -> Found {
    let p = balls.prec;
    if let (Func::Re | Func::Im | Func::Conj | Func::Abs | Func::Arg, [Value::Mirrored(x)]) = (f, x)
    {
        let (z, image) = (&x.value, x.image.as_ref().ok_or(UNKNOWN)?);
        let half = |z: ComplexBall| ComplexBall::new(z.re.shift(-1), z.im.shift(-1));
        // (a − b)/2i
        let imaginary_part = |a: &ComplexBall, b: &ComplexBall| half((b - a).turned());
        return Ok(match f {
            Func::Re => Value::Continued(half(z + image)),
            Func::Im => Value::Continued(imaginary_part(z, image)),
            Func::Abs => Value::Continued(real::complex::sqrt(&(z * image), p)?),
            Func::Arg => {
                let log = |z| real::complex::log(z, p);
                Value::Continued(imaginary_part(&log(z)?, &log(image)?))
            }
            _ => Mirrored::value(image.clone(), Some(z.clone())),
        });
    }
    let plain: Option<Vec<Value>> = x
        .iter()
        .map(|x| x.to_complex().map(Value::Complex))
        .collect();
    let images: Option<Vec<Value>> = x.iter().map(|x| x.image().map(Value::Complex)).collect();
    let of = |x: Vec<Value>| {
        let x: Vec<&Value> = x.iter().collect();
        complex::call(f, &x, balls, p)?.to_complex().ok_or(UNKNOWN)
    };
    // These functions are real on a part of the real line, and off their cuts their own images.
    let image = match f {
        Func::W => match x {
            [Value::Mirrored(x)] => x.image.as_ref().and_then(|z| real::complex::w(&-z, p).ok()),
            _ => None,
        },
        _ => images.and_then(|x| of(x).ok()),
    };
    Ok(Mirrored::value(of(plain.ok_or(UNKNOWN)?)?, image))
}

/// The Faddeeva function of a function that is real on the real line: `conj W(conj z) = W(−z)`.
pub(super) fn w(z: &ComplexBall, p: u32) -> Found {
    let image = real::complex::w(&-z, p).ok();
    Ok(Mirrored::value(real::complex::w(z, p)?, image))
}

#[cfg(test)]
mod tests;
