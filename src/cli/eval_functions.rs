//! The functions that `eval` knows: a solver and a reference under one name.

use mechaudit::reference::Undecided;
use mechaudit::reference::faddeeva as reference;
use mechaudit::reference::faddeeva::Scaled;
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
    /// The solver.
    pub solve: fn(&[f64]) -> Vec<f64>,
    /// The certified values, each with a relative radius of at most 2^-bits.
    pub certify: Certify,
    /// Why these arguments are refused, if they are.
    pub refusal: fn(&[f64]) -> Option<String>,
}

/// The reference of a function.
pub type Certify = fn(&[Rational], u32) -> Result<Vec<Scaled>, Undecided>;

impl Function {
    /// A function of a complex argument with a complex value.
    const fn complex(
        name: &'static str,
        summary: &'static str,
        solve: fn(&[f64]) -> Vec<f64>,
        certify: Certify,
    ) -> Function {
        const PARTS: &[&str] = &["re", "im"];
        Function {
            name,
            summary,
            arguments: PARTS,
            values: PARTS,
            solve,
            certify,
            refusal: |_| None,
        }
    }

    /// That many certified digits of each value, or why they cannot be had.
    pub fn digits(&self, x: &[Rational], digits: usize) -> Result<Vec<String>, String> {
        let first = ((digits as f64 + 2.0) * std::f64::consts::LOG2_10).ceil() as u32 + 4;
        // The references keep to the relative accuracy asked for, so that the first time is nearly
        // always enough.
        for bits in [first, 2 * first] {
            let values = (self.certify)(x, bits).map_err(|e| e.to_string())?;
            let texts = values.iter().map(|v| v.to_decimal(digits));
            if let Some(texts) = texts.collect() {
                return Ok(texts);
            }
        }
        Err(format!("{digits} digits could not be certified"))
    }
}

/// Both sides of a function of a complex argument.
macro_rules! complex {
    ($name:literal, $summary:literal, $solver:ident, $reference:ident) => {
        Function::complex(
            $name,
            $summary,
            |x| {
                let value = solver::$solver(Complex::new(x[0], x[1]));
                vec![value.re, value.im]
            },
            |x, bits| Ok(reference::$reference(&x[0], &x[1], bits)?.to_vec()),
        )
    };
}

/// All of them.
static FUNCTIONS: [Function; 9] = [
    complex!(
        "faddeeva.w",
        "Faddeeva function W(z) = exp(-z^2) erfc(-iz)",
        faddeeva,
        w_scaled
    ),
    complex!(
        "faddeeva.w_derivative",
        "its derivative W'(z) = -2 z W(z) + 2i/sqrt(pi)",
        w_derivative,
        w_derivative_scaled
    ),
    complex!("faddeeva.erf", "error function erf(z)", erf, erf_scaled),
    complex!(
        "faddeeva.erfc",
        "complementary error function erfc(z) = 1 - erf(z)",
        erfc,
        erfc_scaled
    ),
    complex!(
        "faddeeva.erfcx",
        "scaled complementary error function exp(z^2) erfc(z)",
        erfcx,
        erfcx_scaled
    ),
    complex!(
        "faddeeva.erfi",
        "imaginary error function erfi(z) = -i erf(iz)",
        erfi,
        erfi_scaled
    ),
    complex!(
        "faddeeva.dawson",
        "Dawson's function F(z) = exp(-z^2) int_0^z exp(t^2) dt",
        dawson,
        dawson_scaled
    ),
    Function {
        name: "faddeeva.voigt",
        summary: "Voigt profile at x: standard deviation sigma, half-width gamma",
        arguments: &["x", "sigma", "gamma"],
        values: &["value"],
        solve: |x| vec![solver::voigt(x[0], x[1], x[2])],
        certify: |x, bits| Ok(vec![reference::voigt_scaled(&x[0], &x[1], &x[2], bits)?]),
        refusal: |_| None,
    },
    super::eval_chirp::FUNCTION,
];

/// The table.
pub fn functions() -> &'static [Function] {
    &FUNCTIONS
}

/// The function of that name.
pub fn find(name: &str) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|f| f.name == name)
}
