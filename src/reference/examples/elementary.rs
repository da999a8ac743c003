//! Answers functions of balls line by line, for checks by another program.
//!
//! A line is a name, the precision of the result and the operands, each `bits m e r s` for the ball
//! `m 2^e ± r 2^s` with a midpoint of `bits` bits. A complex function has the prefix `complex_`,
//! and its operands and its answer consist of two balls; so has an operation on rectangles between
//! doubles, with the prefix `rectangle_`. The answer is `m e r s`, or `undefined`,
//! `undecided` or `overflow` with a sign.

use mechaudit_reference::elementary::complex::{self, Rectangle};
use mechaudit_reference::elementary::{self, NoValue};
use mechaudit_reference::{Ball, ComplexBall, Mag};
use rug::{Float, Integer};
use std::io::{BufRead, BufWriter, Write};

type Word<'a> = std::str::SplitAsciiWhitespace<'a>;

fn next<T: std::str::FromStr>(words: &mut Word) -> Option<T> {
    words.next()?.parse().ok()
}

fn ball(words: &mut Word) -> Option<Ball> {
    let bits = next(words)?;
    let (m, e): (Integer, i32) = (next(words)?, next(words)?);
    let (r, s): (f64, i64) = (next(words)?, next(words)?);
    let mid = Float::with_val(bits, m) << e;
    Some(Ball::new(mid, Mag::from_f64(r).shift(s)))
}

fn written(ball: &Ball) -> String {
    let (m, e) = ball.mid().to_integer_exp().unwrap_or_default();
    let s = ball.rad().exponent().unwrap_or(0) - 52;
    let r = ball.rad().shift(-s).to_f64();
    format!("{m} {e} {r} {s}")
}

fn reason(why: NoValue) -> String {
    match why {
        NoValue::Undefined(_) => "undefined".into(),
        NoValue::Undecided(_) => "undecided".into(),
        NoValue::Overflow { negative: true } => "overflow -".into(),
        NoValue::Overflow { negative: false } => "overflow +".into(),
    }
}

fn box_of(words: &mut Word) -> Option<ComplexBall> {
    Some(ComplexBall::new(ball(words)?, ball(words)?))
}

/// The balls of an answer.
type Answer = Result<Vec<Ball>, NoValue>;

fn of_complex(found: Result<ComplexBall, NoValue>) -> Answer {
    found.map(|z| vec![z.re, z.im])
}

macro_rules! table {
    (one: $($one:ident)*; two: $($two:ident)*; three: $($three:ident)*;
        ordered: $($ordered:ident)*; rectangle: $($rectangle:ident)*; complex: $($complex:ident)*; complex_two: $($pair:ident)*;) => {
        fn value(name: &str, prec: u32, words: &mut Word) -> Option<Answer> {
            let b = ball;
            if let Some(name) = name.strip_prefix("rectangle_") {
                let z = Rectangle::of_ball(&box_of(words)?);
                let found = z.and_then(|z| match name {
                    $(stringify!($rectangle) => z.$rectangle(),)*
                    "mul" => z.mul(&Rectangle::of_ball(&box_of(words)?)?),
                    "cube" => z.power(3),
                    _ => None,
                });
                let undecided = NoValue::Undecided("left to balls");
                return Some(of_complex(found.and_then(|z| z.to_ball()).ok_or(undecided)));
            }
            if let Some(name) = name.strip_prefix("complex_") {
                return match name {
                    $(stringify!($complex) => Some(of_complex(complex::$complex(&box_of(words)?, prec))),)*
                    $(stringify!($ordered) => {
                        Some(of_complex(complex::$ordered(&b(words)?, &box_of(words)?, prec)))
                    })*
                    $(stringify!($pair) => {
                        Some(of_complex(complex::$pair(&box_of(words)?, &box_of(words)?, prec)))
                    })*
                    _ => None,
                };
            }
            let found = match name {
                $(stringify!($one) => elementary::$one(&b(words)?, prec),)*
                $(stringify!($two) => elementary::$two(&b(words)?, &b(words)?, prec),)*
                $(stringify!($ordered) => elementary::$ordered(&b(words)?, &b(words)?, prec),)*
                $(stringify!($three) => {
                    elementary::$three(&b(words)?, &b(words)?, &b(words)?, prec)
                })*
                "powi" => elementary::powi(&b(words)?, next(words)?, prec),
                _ => return None,
            };
            Some(found.map(|x| vec![x]))
        }
    };
}

table! {
    one: sqrt cbrt exp exp2 exp10 expm1 log log2 log10 log1p sin cos tan asin acos atan sinh cosh
        tanh asinh acosh atanh erf erfc erfcx erfi dawson tgamma lgamma digamma fabs floor ceil
        round trunc nearbyint recip sqr sinpi cospi tanpi airyai airyaiprime airybi airybiprime si ci e1 ei
        lambertw lambertwm1 zeta;
    two: hypot pow atan2 fmin fmax fdim fmod remainder copysign add sub mul div;
    three: fma voigt;
    ordered: besselj besseli besselie zetaderivative;
    rectangle: inverse sqrt exp sinh cosh sech sin cos sec;
    complex: exp log sqrt sin cos tan sinh cosh tanh asin acos atan asinh acosh atanh expm1 log1p
        cbrt recip erf erfc erfcx erfi dawson w tgamma lgamma airyai airyaiprime airybi
        airybiprime si ci e1 lambertw zeta;
    complex_two: pow div weierstrassp weierstrasspprime;
}

fn main() -> std::io::Result<()> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let mut words = line.split_ascii_whitespace();
        let name = words.next().unwrap_or_default();
        let found = next(&mut words).and_then(|prec| value(name, prec, &mut words));
        match found {
            Some(Ok(balls)) => {
                let parts: Vec<String> = balls.iter().map(written).collect();
                writeln!(out, "{}", parts.join(" "))?;
            }
            Some(Err(why)) => writeln!(out, "{}", reason(why))?,
            None => {
                out.flush()?;
                return Err(std::io::Error::other(format!("not understood: {line}")));
            }
        }
        // An answer for each line at once: whoever asks can tell which line takes long.
        out.flush()?;
    }
    Ok(())
}
