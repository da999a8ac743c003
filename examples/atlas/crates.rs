//! W(z) by crates of others, for `mechaudit atlas --exec 'target/release/examples/atlas_crates puruspe'`: reads
//! "re,im" in hexadecimal floats, writes a line for each.

use mechaudit::reference::HexFloat;
use num_complex::Complex;
use std::hint::black_box;
use std::io::{BufRead, Write};
use std::time::Instant;

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

/// The best of seven rounds at points of the ordinary region, a value.
fn nanoseconds(w: W) -> f64 {
    const COUNT: usize = 2000;
    let points: Vec<Complex<f64>> = (0..COUNT)
        .map(|k| {
            let t = k as f64 * 0.618_033_988_749_895;
            Complex::new(8.0 * (t - t.floor()), 0.1 + 7.9 * k as f64 / COUNT as f64)
        })
        .collect();
    let mut best = f64::INFINITY;
    for _ in 0..7 {
        let start = Instant::now();
        for &z in &points {
            black_box(w(black_box(z)));
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / COUNT as f64);
    }
    best
}

fn main() -> std::io::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some((name, version, w)) = CRATES.iter().find(|c| c.0 == name) else {
        eprintln!("there are: {}", CRATES.map(|c| c.0).join(", "));
        std::process::exit(2);
    };
    let mut out = std::io::stdout().lock();
    writeln!(out, "# name: {name}\n# version: {version}")?;
    writeln!(out, "# ns: {:.1}", nanoseconds(*w))?;
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
