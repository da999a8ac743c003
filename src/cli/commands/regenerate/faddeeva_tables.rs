//! The numbers behind the `f64` Faddeeva function, its relatives and the exponential below them,
//! from the certified reference: `tables.rs`, `constants.rs` and `relatives_tables.rs` in
//! `src/solvers/special/faddeeva/`, `tables.rs` in `src/solvers/arithmetic/`.
//!
//! Every number is the `f64` nearest to the exact one, and every second or third part of a number
//! the `f64` nearest to the exact rest: both ends of a ball have to round to it. Where they do not,
//! the precision is doubled; at [`LAST_BITS`] it gives up.

mod arithmetic;
mod real_line;
mod relatives;
#[cfg(test)]
mod tests;

pub use arithmetic::tables as arithmetic_tables;
pub use relatives::{constants, tables as relatives_tables};

use crate::cli::files::artefact::{Made, MakeError, Outcome};
use mechaudit::reference::{Ball, ComplexBall, Undecided, faddeeva};
use rug::Rational;
use rug::ops::Pow;
use std::fmt::Write as _;

const FIRST_BITS: u32 = 256;
const LAST_BITS: u32 = 8192;

/// Coefficients `c_0 … c_17` of each row.
const ORDER: usize = 17;
/// Centres on the real axis: the first and the last one, in units of one part of this many.
const REAL_AXIS: (i64, i64, i64) = (18, 144, 16);
/// Zeros, and coefficients `g_0 … g_19` of each.
const ZEROS: u32 = 12;
const ZERO_TERMS: usize = 20;
/// The step 23/64 of the trapezoidal rule, and its nodes.
const STEP: (i64, i64) = (23, 64);
const NODES: i64 = 24;

/// The `f64` nearest to every point of the ball.
fn nearest(ball: &Ball) -> Option<f64> {
    if ball.is_zero() {
        return Some(0.0);
    }
    let (low, high) = (ball.lower().to_f64(), ball.upper().to_f64());
    (ball.is_finite() && low.to_bits() == high.to_bits()).then_some(low)
}

/// The number as `N` parts, each the `f64` nearest to what is left.
fn parts<const N: usize>(ball: &Ball) -> Option<[f64; N]> {
    let mut rest = ball.clone();
    let mut parts = [0.0; N];
    for part in &mut parts {
        *part = nearest(&rest)?;
        rest = &rest - &Ball::exact(rest.prec(), *part);
    }
    Some(parts)
}

/// Repeats a calculation at rising precision until all its roundings are decided.
fn decided<T>(what: &str, f: impl Fn(u32) -> Result<Option<T>, Undecided>) -> Outcome<T> {
    let mut bits = FIRST_BITS;
    while bits <= LAST_BITS {
        if let Some(value) = f(bits)? {
            return Ok(value);
        }
        bits *= 2;
    }
    Err(MakeError::Rounding {
        what: what.into(),
        bits: LAST_BITS,
    }
    .into())
}

/// `c_0`, `c_1` in two parts, then blocks of four real and four imaginary parts.
fn complex_row(c: &[ComplexBall]) -> Option<Vec<f64>> {
    let mut row = Vec::new();
    for c in &c[..2] {
        row.extend(parts::<2>(&c.re)?);
        row.extend(parts::<2>(&c.im)?);
    }
    blocks(&mut row, &c[2..])?;
    Some(row)
}

fn blocks(row: &mut Vec<f64>, c: &[ComplexBall]) -> Option<()> {
    for four in c.chunks_exact(4) {
        for c in four {
            row.push(nearest(&c.re)?);
        }
        for c in four {
            row.push(nearest(&c.im)?);
        }
    }
    Some(())
}

/// `i^n c_n`, which is real on the imaginary axis: `c_0` and `c_1` in two parts, then the others.
fn erfcx_row(c: &[ComplexBall]) -> Option<Vec<f64>> {
    let turned = |n: usize| match n % 4 {
        0 => c[n].re.clone(),
        1 => -&c[n].im,
        2 => -&c[n].re,
        _ => c[n].im.clone(),
    };
    let mut row = Vec::new();
    for n in 0..2 {
        row.extend(parts::<2>(&turned(n))?);
    }
    for n in 2..c.len() {
        row.push(nearest(&turned(n))?);
    }
    Some(row)
}

/// The zero in three parts, then `g_n = c_{n+2}/c_1`, where `c_0 = 0` and
/// `c_{n+2} = −(2/(n + 2)) (z c_{n+1} + c_n)` (DLMF 7.10.3).
fn zero_row(k: u32, bits: u32) -> Result<Option<Vec<f64>>, Undecided> {
    let z = faddeeva::zero(k, bits)?;
    let one = Ball::integer(bits, 1);
    let mut g = vec![
        ComplexBall::zero(bits),
        ComplexBall::new(one, Ball::integer(bits, 0)),
    ];
    for n in 2..ZERO_TERMS + 2 {
        let factor = Ball::rational(bits, &Rational::from((-2, n as i64)));
        let next = (&(&z * &g[n - 1]) + &g[n - 2]).scaled(&factor);
        g.push(next);
    }
    let row = || {
        let mut row = Vec::new();
        row.extend(parts::<3>(&z.re)?);
        row.extend(parts::<3>(&z.im)?);
        blocks(&mut row, &g[2..])?;
        Some(row)
    };
    Ok(row())
}

/// The accuracy of every generated number.
fn precision() -> (&'static str, String) {
    let bits = format!("every rounding decided at {FIRST_BITS} to {LAST_BITS} bits");
    ("precision", bits)
}

/// The file as it grows, and what went into it: names, centres and sizes.
#[derive(Default)]
struct Tables {
    text: String,
    recipe: String,
}

impl Tables {
    fn depends_on(&mut self, what: &str) {
        self.recipe.push_str(what);
        self.recipe.push('\n');
    }

    fn open(&mut self, doc: &str, name: &str, kind: &str) {
        self.depends_on(&format!("{name}: {kind}"));
        for line in doc.lines() {
            let _ = writeln!(self.text, "{}", format!("/// {line}").trim_end());
        }
        let _ = writeln!(self.text, "pub(super) static {name}: {kind} = [");
    }

    fn close(&mut self) {
        self.text.push_str("];\n\n");
    }

    /// A table with a row about each centre.
    fn taylor(&mut self, table: &Taylor) -> Outcome<()> {
        let Taylor { name, kind, .. } = table;
        let centres = &table.centres;
        self.open(&table.doc, name, &format!("[{kind}; {}]", centres.len()));
        for &(x, y, per) in centres {
            let (x, y) = (Rational::from((x, per)), Rational::from((y, per)));
            let what = format!("{name} at {x} + {y} i");
            self.depends_on(&what);
            let row = decided(&what, |bits| {
                Ok((table.make)(&faddeeva::taylor(&x, &y, ORDER, bits)?))
            })?;
            let _ = writeln!(self.text, "    {kind}({row:?}),");
        }
        self.close();
        Ok(())
    }
}

/// A table of rows of Taylor coefficients of w.
struct Taylor {
    doc: String,
    name: &'static str,
    kind: &'static str,
    /// `(x + y i)/per`.
    centres: Vec<Centre>,
    make: fn(&[ComplexBall]) -> Option<Vec<f64>>,
}

type Centre = (i64, i64, i64);

/// The cells of the upper quadrant: where each begins in the index, and its centre.
fn cells() -> Vec<(usize, Centre)> {
    let mut cells = Vec::new();
    // Squares with side 1/4, up to |Re z|, |Im z| = 3.75, and a second line along the real axis.
    for j in 0..16 {
        for i in 0..29 {
            let wanted = if j == 0 { i <= 4 } else { i <= 15 || j == 1 };
            if wanted {
                cells.push(((32 * j + i) as usize, (i, j, 4)));
            }
        }
    }
    // Squares with side 1/2 outside, as far as their corner next to zero is in |z| < 7; in the
    // first column, where a side is nearer, it makes no difference.
    for j in 1..15 {
        for i in 0..15 {
            let (p, q) = (2 * i - 1, 2 * j - 1);
            if (i > 7 || j > 7) && p * p + q * q < 16 * 49 {
                cells.push(((512 + 32 * j + i) as usize, (i, j, 2)));
            }
        }
    }
    cells
}

/// Where the row of each cell is.
fn cell_index(tables: &mut Tables) -> Outcome<()> {
    let mut index = [0u16; 1024];
    for (row, (at, _)) in cells().iter().enumerate() {
        index[*at] = row.try_into()?;
    }
    tables.open(
        "The row of [`CELLS`] of a cell: the centre `(p + q i)/4` at `32 q + p`, the centre\n\
         `(p + q i)/2` at `512 + 32 q + p`. Places without a cell hold zero.",
        "CELL",
        "[u16; 1024]",
    );
    for line in index.chunks(32) {
        let line: Vec<_> = line.iter().map(u16::to_string).collect();
        let _ = writeln!(tables.text, "    {},", line.join(", "));
    }
    tables.close();
    Ok(())
}

fn taylor_tables() -> [Taylor; 4] {
    let (first, last, per) = REAL_AXIS;
    let disc = (0..5).flat_map(|j| (0..5).map(move |i| (i, -j, 4)));
    [
        Taylor {
            doc: "Taylor coefficients of w about the centres of the cells of the upper quadrant."
                .into(),
            name: "CELLS",
            kind: "ComplexRow",
            centres: cells().into_iter().map(|(_, centre)| centre).collect(),
            make: complex_row,
        },
        Taylor {
            doc: "Taylor coefficients of w about the centres `(p − q i)/4` of the lower half-disc, at\n\
                  `5 q + p`."
                .into(),
            name: "DISC",
            kind: "ComplexRow",
            centres: disc.collect(),
            make: complex_row,
        },
        Taylor {
            doc: format!(
                "Taylor coefficients of w about `{first}/{per}, {}/{per}, …` on the real axis.",
                first + 1
            ),
            name: "REAL_AXIS",
            kind: "ComplexRow",
            centres: (first..=last).map(|i| (i, 0, per)).collect(),
            make: complex_row,
        },
        Taylor {
            doc: "Taylor coefficients of `erfcx s = w(i s)` about `0, 1/4, … 28/4`.".into(),
            name: "IMAGINARY_AXIS",
            kind: "RealRow",
            centres: (0..29).map(|j| (0, j, 4)).collect(),
            make: erfcx_row,
        },
    ]
}

fn zero_table(tables: &mut Tables) -> Outcome<()> {
    tables.open(
        "The zeros of w in the fourth quadrant by increasing modulus, and `g_n = c_{n+2}/c_1` there.",
        "ZEROS",
        &format!("[ZeroRow; {ZEROS}]"),
    );
    for k in 1..=ZEROS {
        let what = format!("zero {k}");
        tables.depends_on(&what);
        let row = decided(&what, |bits| zero_row(k, bits))?;
        let _ = writeln!(tables.text, "    ZeroRow({row:?}),");
    }
    tables.close();
    Ok(())
}

/// The square of node `k` of a rule.
fn node_square(rule: i64, k: i64) -> Rational {
    Rational::from(((2 * k + rule) * STEP.0, 2 * STEP.1)).pow(2)
}

fn trapezoidal(tables: &mut Tables) -> Outcome<()> {
    let what = format!("h = {}/{}", STEP.0, STEP.1);
    tables.depends_on(&what);
    tables.open(
        "The squares `τ = (k + σ)²h²` of the nodes of the trapezoidal rule, exactly: `h = 23/64`,\n\
         σ = 0 and σ = 1/2.",
        "TRAPEZOIDAL_NODES",
        &format!("[[f64; {NODES}]; 2]"),
    );
    for rule in 0..2 {
        let mut row = Vec::new();
        for k in 0..NODES {
            let tau = node_square(rule, k);
            let value = tau.to_f64();
            if tau != value {
                let what = format!("the square of node {k}");
                return Err(MakeError::NotExact { what }.into());
            }
            row.push(value);
        }
        let _ = writeln!(tables.text, "    {row:?},");
    }
    tables.close();

    tables.open(
        "The weights `(2h/π) e^{−τ}` (half of it for τ = 0) of the nodes: for each rule the first\n\
         parts and the second ones.",
        "TRAPEZOIDAL_WEIGHTS",
        &format!("[[[f64; {NODES}]; 2]; 2]"),
    );
    for rule in 0..2 {
        let (mut high, mut low) = (Vec::new(), Vec::new());
        for k in 0..NODES {
            let tau = node_square(rule, k);
            let factor = Rational::from((if tau == 0 { 1 } else { 2 } * STEP.0, STEP.1));
            let [a, b] = decided("a weight", |bits| {
                let e = Ball::rational(bits, &Rational::from(-&tau)).exp();
                let weight = &(&Ball::rational(bits, &factor) * &e) / &Ball::pi(bits);
                Ok(parts::<2>(&weight))
            })?;
            high.push(a);
            low.push(b);
        }
        let _ = writeln!(
            tables.text,
            "    [\n        {high:?},\n        {low:?},\n    ],"
        );
    }
    tables.close();
    Ok(())
}

/// `tables.rs`.
pub fn tables() -> Outcome<Made> {
    let mut tables = Tables::default();
    cell_index(&mut tables)?;
    for table in &taylor_tables() {
        tables.taylor(table)?;
    }
    zero_table(&mut tables)?;
    trapezoidal(&mut tables)?;
    real_line::polynomials(&mut tables)?;
    real_line::values(&mut tables)?;
    let body = format!(
        "\nuse super::taylor::{{ComplexRow, RealRow}};\n\
         use super::zeros::ZeroRow;\n\
         \n\
         {}\n",
        tables.text.trim_end(),
    );
    Ok(Made {
        title: "Coefficients of the Faddeeva function, each the nearest `f64` by the certified reference."
            .into(),
        facts: vec![precision()],
        recipe: tables.recipe,
        body,
    })
}
