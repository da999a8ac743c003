//! The numbers behind the relatives of the Faddeeva function: constants, zeros of erf, and the
//! maximum of Dawson's function.

use super::{Made, Outcome, decided, parts, precision};
use mechaudit::reference::{Ball, Undecided, faddeeva};
use rug::Rational;
use std::fmt::Write as _;

/// Zeros of erf.
const ZEROS: u32 = 14;

/// An array as rustfmt breaks it.
pub(super) fn column(row: &[f64], indent: &str) -> String {
    let lines: String = row
        .iter()
        .map(|x| format!("{indent}    {x:?},\n"))
        .collect();
    format!("[\n{lines}{indent}]")
}

/// A number of two parts, by its name in Rust and in words.
type Constant = (&'static str, &'static str, fn(u32) -> Ball);

const CONSTANTS: [Constant; 7] = [
    ("TWO_OVER_SQRT_PI", "2/√π", |p| {
        Ball::integer(p, 2) / &Ball::pi(p).sqrt()
    }),
    ("HALF_SQRT_PI", "√π/2", |p| Ball::pi(p).sqrt().shift(-1)),
    ("INV_SQRT_PI", "1/√π", |p| Ball::pi(p).sqrt().recip()),
    ("INV_SQRT_2", "1/√2", |p| {
        Ball::integer(p, 2).sqrt().shift(-1)
    }),
    ("INV_SQRT_2_PI", "1/√(2π)", |p| {
        Ball::pi(p).shift(1).sqrt().recip()
    }),
    ("SQRT_LN_2", "√(ln 2)", |p| {
        Ball::integer(p, 2).ln().sqrt()
    }),
    ("INV_PI", "1/π", |p| Ball::pi(p).recip()),
];

/// `constants.rs`.
pub fn constants() -> Outcome<Made> {
    let mut recipe = String::new();
    let mut text =
        String::from("\n#![allow(clippy::approx_constant)]\n\nuse crate::double_double::Dd;\n\n");
    for (name, meaning, value) in CONSTANTS {
        writeln!(recipe, "{name} = {meaning}")?;
        let [hi, lo] = decided(meaning, |bits| Ok(parts::<2>(&value(bits))))?;
        writeln!(text, "/// {meaning}.")?;
        writeln!(
            text,
            "pub(super) const {name}: Dd = Dd::new({hi:?}, {lo:?});"
        )?;
    }
    Ok(Made {
        title: "Constants as sums of two `f64`, each the nearest one to what is left.".into(),
        facts: vec![precision()],
        recipe,
        body: text,
    })
}

/// The zero of F′ on the positive real axis, `F(x₀) = 1/(2x₀)`: bisection by certified signs of
/// `F′ = 1 − 2xF`, which falls from 0 to 3/2.
fn maximum(bits: u32) -> Result<Ball, Undecided> {
    let (mut low, mut high) = (Rational::new(), Rational::from(1));
    for _ in 0..bits {
        let middle = Rational::from(&low + &high) / 2u32;
        let f = faddeeva::dawson(&middle, &Rational::new(), bits)?.re;
        let slope = Ball::integer(bits, 1) - &(f * &Ball::rational(bits, &middle)).shift(1);
        if slope.is_positive() {
            low = middle;
        } else if slope.is_negative() {
            high = middle;
        } else {
            break;
        }
    }
    Ok(Ball::rational(bits, &low).union(&Ball::rational(bits, &high)))
}

/// `relatives_tables.rs`.
pub fn tables() -> Outcome<Made> {
    let mut text = format!(
        "\n/// The zeros of erf in the first quadrant by increasing modulus (DLMF 7.13(i)): real and\n\
         /// imaginary part in three `f64` each.\n\
         pub(super) const ZEROS_OF_ERF: [[f64; 6]; {ZEROS}] = [\n"
    );
    for k in 1..=ZEROS {
        let row = decided(&format!("zero {k} of erf"), |bits| {
            let z = faddeeva::zero_of_erf(k, bits)?;
            let row = || Some([parts::<3>(&z.re)?, parts::<3>(&z.im)?].concat());
            Ok(row())
        })?;
        writeln!(text, "    {},", column(&row, "    "))?;
    }
    writeln!(text, "];\n")?;
    let x = decided("the maximum of F", |bits| Ok(parts::<3>(&maximum(bits)?)))?;
    writeln!(
        text,
        "/// Where Dawson's function is largest: x₀ in three `f64`.\n\
         pub(super) const MAXIMUM_OF_DAWSON: [f64; 3] = {};\n",
        column(&x, "")
    )?;
    let minus_inverse = decided("-1/x₀", |bits| Ok(parts::<2>(&-maximum(bits)?.recip())))?;
    writeln!(
        text,
        "/// `−1/x₀` in two `f64`.\n\
         pub(super) const MINUS_INVERSE_MAXIMUM: [f64; 2] = {minus_inverse:?};"
    )?;
    Ok(Made {
        title: "Zeros and extrema of the relatives of the Faddeeva function, each part the nearest `f64`\n\
                to what is left, by the certified reference."
            .into(),
        facts: vec![precision()],
        recipe: format!("{ZEROS} zeros of erf, the maximum of Dawson's function"),
        body: text,
    })
}
