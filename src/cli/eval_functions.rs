//! The functions that `eval` knows: a solver and a reference under one name.

use mechaudit::reference::faddeeva as reference;
use mechaudit::reference::{Ball, ComplexBall, Undecided};
use mechaudit::solvers::faddeeva as solver;
use num_complex::Complex;
use rug::Rational;

/// A function with its two sides.
pub struct Function {
    /// What it is called on the command line.
    pub name: &'static str,
    /// In plain words.
    pub summary: &'static str,
    /// The fields of a line of input.
    pub arguments: &'static [&'static str],
    /// The fields of a line of output.
    pub values: &'static [&'static str],
    /// The solver; never refuses.
    pub solve: fn(&[f64]) -> Vec<f64>,
    /// That many certified digits of each value, or why they cannot be had.
    pub certify: fn(&[Rational], usize) -> Result<Vec<String>, String>,
}

/// All of them.
pub fn functions() -> Vec<Function> {
    let w = Function {
        name: "faddeeva.w",
        summary: "Faddeeva function W(z) = exp(-z^2) erfc(-iz)",
        arguments: &["re", "im"],
        values: &["re", "im"],
        solve: |x| complex(solver::faddeeva, x),
        certify: |x, digits| {
            let balls = certified(digits, |bits| {
                let w = reference::w(&x[0], &x[1], bits)?;
                Ok(both(&w, |b: &Ball| b.to_decimal(digits)))
            });
            // A value beyond the exponents of a ball.
            balls.or_else(|_| {
                certified(digits, |bits| {
                    let w = reference::w_scaled(&x[0], &x[1], bits)?;
                    Ok(w.iter().map(|part| part.to_decimal(digits)).collect())
                })
            })
        },
    };
    vec![w, super::eval_chirp::function()]
}

impl Function {
    /// Why these arguments are refused, if they are.
    pub fn refusal(&self, x: &[f64]) -> Option<String> {
        match self.name {
            super::eval_chirp::NAME => super::eval_chirp::refusal(x),
            _ => None,
        }
    }
}

/// The function of that name.
pub fn find(name: &str) -> Option<Function> {
    functions().into_iter().find(|f| f.name == name)
}

/// A complex function on fields.
fn complex(f: impl Fn(Complex<f64>) -> Complex<f64>, x: &[f64]) -> Vec<f64> {
    let w = f(Complex::new(x[0], x[1]));
    vec![w.re, w.im]
}

fn both<T>(w: &ComplexBall, f: impl Fn(&Ball) -> T) -> Vec<T> {
    vec![f(&w.re), f(&w.im)]
}

/// Asks at rising precision until every value has its digits. The references keep to the relative
/// accuracy asked for, so that the first time is nearly always enough.
pub fn certified(
    digits: usize,
    at: impl Fn(u32) -> Result<Vec<Option<String>>, Undecided>,
) -> Result<Vec<String>, String> {
    let first = ((digits as f64 + 2.0) * std::f64::consts::LOG2_10).ceil() as u32 + 4;
    for bits in [first, 2 * first] {
        let texts: Option<Vec<String>> = at(bits).map_err(|e| e.to_string())?.into_iter().collect();
        if let Some(texts) = texts {
            return Ok(texts);
        }
    }
    Err(format!("{digits} digits could not be certified"))
}
