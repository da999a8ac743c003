//! W(z) by crates of others, for `mechaudit atlas --exec 'target/release/examples/atlas_crates puruspe'`: reads
//! "re,im" in hexadecimal floats, writes a line for each.

use mechaudit::reference::HexFloat;
use num_complex::Complex;
use std::io::{BufRead, Write};

type W = fn(Complex<f64>) -> Complex<f64>;

/// The crates, with the versions that this package asks for.
const CRATES: [(&str, &str, W); 2] = [
    ("puruspe", "0.4", |z| {
        let (re, im) = puruspe::faddeeva(z.re, z.im);
        Complex::new(re, im)
    }),
    ("errorfunctions", "0.2", |z| {
        errorfunctions::ComplexErrorFunctions::w(z)
    }),
];

fn main() -> std::io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some((name, version, w)) = CRATES.iter().find(|c| c.0 == name) else {
        eprintln!("there are: {}", CRATES.map(|c| c.0).join(", "));
        std::process::exit(2);
    };
    let mut out = std::io::stdout().lock();
    writeln!(out, "# name: {name}\n# version: {version}")?;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let numbers: Option<Vec<f64>> = line
            .split(',')
            .map(|t| Some(HexFloat::parse(t.trim()).ok()?.to_f64()))
            .collect();
        let Some(&[re, im]) = numbers.as_deref() else {
            continue;
        };
        let value = w(Complex::new(re, im));
        writeln!(out, "{:?},{:?}", value.re, value.im)?;
    }
    out.flush()
}
