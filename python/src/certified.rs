//! Certified digits. Numbers cross the border exactly: integers in hexadecimal.

use crate::errors::{DomainError, Undecided, value_error};
use crate::pool::pool;
use mechaudit::audit::Uncertified;
use mechaudit::methods::{Evaluable, certified_digits, registry};
use mechaudit::reference::cubic_spline::{End, Spline};
use mechaudit::reference::faddeeva::{self, Scaled};
use mechaudit::reference::{Ball, ComplexBall};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use rug::{Float, Integer, Rational};
use std::sync::OnceLock;

/// A fraction: numerator and denominator.
pub type Fraction = (String, String);
/// `m 2^e`: m in hexadecimal, e in decimal digits.
type Power = (String, String);
/// Decimal digits (the last wrong by at most 0.51 units, or `None`), midpoint and radius.
pub type Component = (Option<String>, Power, Power);

/// Reads an integer.
fn integer(text: &str) -> PyResult<Integer> {
    Integer::from_str_radix(text, 16).map_err(value_error)
}

/// Reads a fraction.
pub fn rational((numerator, denominator): &Fraction) -> PyResult<Rational> {
    let denominator = integer(denominator)?;
    if denominator == 0 {
        return Err(PyValueError::new_err("the denominator is zero"));
    }
    Ok(Rational::from((integer(numerator)?, denominator)))
}

fn written(q: &Rational) -> Fraction {
    let hex = |n: &Integer| n.to_string_radix(16);
    (hex(q.numer()), hex(q.denom()))
}

fn power(x: &Float, more: &Integer) -> Power {
    match x.to_integer_exp() {
        Some((m, e)) => (m.to_string_radix(16), (Integer::from(e) + more).to_string()),
        None => ("0".into(), "0".into()),
    }
}

/// A value as it crosses the border.
pub fn component(value: &Scaled, digits: u32) -> Component {
    written_component(value, value.to_decimal(digits as usize))
}

fn written_component(value: &Scaled, decimal: Option<String>) -> Component {
    let ball = &value.ball;
    (
        decimal,
        power(ball.mid(), &value.exponent),
        power(&ball.rad().to_float(), &value.exponent),
    )
}

/// The bits that hold `digits` decimal digits, with some to spare.
pub fn bits_of(digits: u32) -> u32 {
    ((f64::from(digits) + 2.0) * std::f64::consts::LOG2_10).ceil() as u32 + 4
}

/// Values whose digits are certain.
pub fn values_of(
    method: &dyn Evaluable,
    x: &[Rational],
    digits: u32,
) -> Result<Vec<Component>, Uncertified> {
    let found = certified_digits(method, x, digits, |_| true)?;
    let crossing = found
        .into_iter()
        .map(|v| written_component(&v.value, v.decimal));
    Ok(crossing.collect())
}

/// The exception for what could not be certified.
pub fn uncertified(error: Uncertified, row: usize) -> PyErr {
    let at = match row {
        0 => String::new(),
        row => format!(" (argument {row})"),
    };
    match error {
        Uncertified::Refused(_) | Uncertified::NoNumber => {
            DomainError::new_err(format!("there is no certified value here: {error}{at}"))
        }
        _ => Undecided::new_err(format!("{error}{at}")),
    }
}

/// Returns the method of that name, or the study.
pub fn evaluable_method(name: &str) -> PyResult<&'static dyn Evaluable> {
    // Made once, and there to the end of the process.
    static ALL: OnceLock<Vec<&'static dyn Evaluable>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let leaked = |m: Box<dyn Evaluable>| &*Box::leak(m);
        registry().into_iter().map(leaked).collect()
    });
    if let Some(named) = all.iter().copied().find(|m| m.name() == name) {
        return Ok(named);
    }
    crate::study::find(name)?.ok_or_else(|| {
        let known: Vec<&str> = all.iter().map(|m| m.name()).collect();
        PyValueError::new_err(format!(
            "method: there is no {name:?}; there are: {}",
            known.join(", ")
        ))
    })
}

/// Rows computed between two looks at pending signals.
const ROWS: usize = 32;

/// A method's values at each row of arguments.
#[pyfunction]
pub fn certify(
    py: Python<'_>,
    method: &str,
    rows: Vec<Vec<Fraction>>,
    digits: u32,
) -> PyResult<Vec<Vec<Component>>> {
    let method = evaluable_method(method)?;
    let mut found = Vec::with_capacity(rows.len());
    let threads = (rows.len() > 1).then(pool).transpose()?;
    for (k, some) in rows.chunks(ROWS).enumerate() {
        py.check_signals()?;
        let arguments = some.iter().map(|row| row.iter().map(rational).collect());
        let arguments = arguments.collect::<PyResult<Vec<Vec<Rational>>>>()?;
        let answers: Vec<_> = py.detach(|| {
            let one = |x: &Vec<Rational>| values_of(method, x, digits);
            match &threads {
                Some(threads) => threads.install(|| arguments.par_iter().map(one).collect()),
                None => arguments.iter().map(one).collect(),
            }
        });
        for (i, answer) in answers.into_iter().enumerate() {
            let row = if rows.len() == 1 { 0 } else { k * ROWS + i + 1 };
            found.push(answer.map_err(|e| uncertified(e, row))?);
        }
    }
    Ok(found)
}

/// The zero number k of w, or of erf, in the right half-plane: real and imaginary part.
#[pyfunction]
pub fn zero(py: Python<'_>, function: &str, k: u32, digits: u32) -> PyResult<[Component; 2]> {
    let bits = bits_of(digits);
    let found = py.detach(|| match function {
        "wofz" => Some(faddeeva::zero(k, bits)),
        "erf" => Some(faddeeva::zero_of_erf(k, bits)),
        _ => None,
    });
    let found: ComplexBall = found
        .ok_or_else(|| {
            PyValueError::new_err(format!(
                "function: certified zeros are those of 'wofz' and 'erf', not {function:?}"
            ))
        })?
        .map_err(|e| Undecided::new_err(e.to_string()))?;
    let part = |b: Ball| component(&Scaled::from(b), digits);
    Ok([part(found.re), part(found.im)])
}

/// The quantity asked of an exact spline.
#[derive(FromPyObject)]
pub enum Ask {
    /// A derivative at a point.
    #[pyo3(transparent)]
    At((Fraction, usize)),
    /// The integral between two points.
    #[pyo3(transparent)]
    Integral((Fraction, Fraction)),
}

/// Exact values of the spline through exact points: a fraction for each question. `kinds` has a
/// condition for each end, or the one name of a spline that has none.
#[pyfunction]
pub fn spline(
    py: Python<'_>,
    x: Vec<Fraction>,
    y: Vec<Fraction>,
    kinds: Vec<String>,
    ends: (Fraction, Fraction),
    asked: Vec<Ask>,
) -> PyResult<Vec<Fraction>> {
    let all = |v: &[Fraction]| v.iter().map(rational).collect::<PyResult<Vec<Rational>>>();
    let (x, y, first, last) = (all(&x)?, all(&y)?, rational(&ends.0)?, rational(&ends.1)?);
    let end = |kind: &str, value| {
        Some(match kind {
            "second" => End::SecondDerivative(value),
            "first" => End::FirstDerivative(value),
            "not-a-knot" => End::NotAKnot,
            _ => return None,
        })
    };
    let names: Vec<&str> = kinds.iter().map(String::as_str).collect();
    let fitted = py.detach(|| {
        Some(match names[..] {
            ["periodic"] => Spline::periodic(&x, &y),
            ["pchip"] => Spline::pchip(&x, &y),
            ["akima"] => Spline::akima(&x, &y),
            ["makima"] => Spline::modified_akima(&x, &y),
            [a, b] => Spline::with_ends(&x, &y, end(a, &first)?, end(b, &last)?),
            _ => return None,
        })
    });
    let fitted = fitted
        .ok_or_else(|| PyValueError::new_err(format!("kinds: there is no exact spline {names:?}")))?
        .map_err(value_error)?;
    let mut answers = Vec::with_capacity(asked.len());
    for ask in &asked {
        py.check_signals()?;
        answers.push(written(&match ask {
            Ask::At((x, order)) => {
                let jet = fitted.eval(&rational(x)?);
                jet.get(*order).cloned().unwrap_or_default()
            }
            Ask::Integral((a, b)) => fitted.integral(&rational(a)?, &rational(b)?),
        }));
    }
    Ok(answers)
}
