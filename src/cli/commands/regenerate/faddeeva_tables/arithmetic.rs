//! The numbers behind the exponential and the reduction of phases.

use super::relatives::column;
use super::{Made, Outcome, Tables, decided, parts, precision};
use mechaudit::reference::Ball;
use rug::float::Round;
use rug::{Float, Integer, Rational};
use std::fmt::Write as _;

/// Binary digits of 2/π in words of 64: the product with `2^1024 · 2^1025` needs those up to 2300.
const WORDS: u32 = 40;
/// `1/n!` for n below this.
const FACTORIALS: u32 = 32;

fn three_parts(tables: &mut Tables, doc: &str, name: &str, value: fn(u32) -> Ball) -> Outcome<()> {
    tables.depends_on(&format!("{name} = {doc}"));
    let row = decided(doc, |bits| Ok(parts::<3>(&value(bits))))?;
    writeln!(
        tables.text,
        "/// {doc} in three `f64`.\npub(super) const {name}: [f64; 3] = {};\n",
        column(&row, "")
    )?;
    Ok(())
}

fn two_over_pi(tables: &mut Tables) -> Outcome<()> {
    tables.open(
        "The binary digits of 2/π after the point, sixty-four in a word.",
        "TWO_OVER_PI_BITS",
        &format!("[u64; {WORDS}]"),
    );
    let digits = 64 * WORDS;
    let whole = decided("2/π", |bits| {
        let prec = digits + bits;
        let q = Ball::integer(prec, 2) / &Ball::pi(prec);
        let floor = |x: &Float| -> Option<Integer> {
            let x = Float::with_val(prec, x << digits);
            Some(x.to_integer_round(Round::Down)?.0)
        };
        let (low, high) = (floor(&q.lower()), floor(&q.upper()));
        Ok(if low == high { low } else { None })
    })?;
    for at in (0..WORDS).rev() {
        let word = Integer::from(&whole >> (64 * at)).to_u64_wrapping();
        let _ = writeln!(tables.text, "    {word:#018x},");
    }
    tables.close();
    Ok(())
}

fn factorials(tables: &mut Tables) -> Outcome<()> {
    tables.open(
        "`1/n!` in two parts.",
        "INVERSE_FACTORIAL",
        &format!("[[f64; 2]; {FACTORIALS}]"),
    );
    for n in 0..FACTORIALS {
        let q = Rational::from((1, Integer::from(Integer::factorial(n))));
        let row = decided("1/n!", |bits| Ok(parts::<2>(&Ball::rational(bits, &q))))?;
        let _ = writeln!(tables.text, "    {row:?},");
    }
    tables.close();
    Ok(())
}

/// `arithmetic/tables.rs`.
pub fn tables() -> Outcome<Made> {
    let mut tables = Tables::default();
    three_parts(&mut tables, "π/2", "HALF_PI", |p| Ball::pi(p).shift(-1))?;
    three_parts(&mut tables, "ln 2", "LN_2", |p| Ball::integer(p, 2).ln())?;
    two_over_pi(&mut tables)?;
    factorials(&mut tables)?;
    Ok(Made {
        title: "Numbers behind the exponential and the reduction of phases, each the nearest `f64` to what is\n\
                left, by the certified reference."
            .into(),
        facts: vec![precision()],
        recipe: tables.recipe,
        body: format!(
            "\n#![allow(clippy::approx_constant)]\n\n{}\n",
            tables.text.trim_end()
        ),
    })
}
