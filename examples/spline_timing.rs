//! Times a natural cubic spline on the data of `benches/compare_scipy.py`, single-threaded.
//!
//! Usage: `spline_timing KNOTS POINTS IN-FILE OUT-FILE`. Ordinates and abscissae are read as raw
//! little-endian `f64` from the first file (ordinates, then points), values are written to the
//! second the same way. Prints `name seconds` lines: the best of eleven runs.
//!
//! Values go to a buffer that has been written before, so that no page is touched for the first
//! time while the clock runs; `…_fresh` allocates the result within the measured time, as scipy
//! does. `floor` is the loop `out[i] = 2 x[i]` between the same two buffers, `floor_fresh` the same
//! into a new vector: what reading the points and writing the values costs on this machine.

use mechaudit::solvers::cubic_spline::{Boundary, CubicSpline, UniformCubicSpline};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

const RUNS: usize = 11;

fn best<T>(mut f: impl FnMut() -> (f64, T)) -> (f64, T) {
    let mut found = f();
    for _ in 1..RUNS {
        let next = f();
        if next.0 < found.0 {
            found = next;
        }
    }
    found
}

fn double(x: &[f64], out: &mut [f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = 2.0 * x;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().collect();
    let [_, knots, points, input, output] = &args[..] else {
        return Err("usage: spline_timing KNOTS POINTS IN-FILE OUT-FILE".into());
    };
    let (knots, points): (usize, usize) = (knots.parse()?, points.parse()?);
    let bytes = std::fs::read(input)?;
    let all: Vec<f64> = bytes
        .chunks_exact(8)
        .map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes")))
        .collect();
    if all.len() != knots + points {
        return Err(format!(
            "{} numbers in {input}, {} are due",
            all.len(),
            knots + points
        )
        .into());
    }
    let (y, x) = all.split_at(knots);

    let (fit, spline) = best(|| {
        let y = y.to_vec();
        let start = Instant::now();
        let s = UniformCubicSpline::fit(0.0, 1.0, y, Boundary::NATURAL);
        (start.elapsed().as_secs_f64(), s)
    });
    let spline = spline?;
    println!("fit_uniform {fit}");

    let abscissae: Vec<f64> = (0..knots).map(|i| i as f64).collect();
    let (fit, general) = best(|| {
        let (x, y) = (abscissae.clone(), y.to_vec());
        let start = Instant::now();
        let s = CubicSpline::fit(x, y, Boundary::NATURAL);
        (start.elapsed().as_secs_f64(), s)
    });
    let general = general?;
    println!("fit_any_knots {fit}");

    // Zeroed memory may come without pages; ones have to be written.
    let mut out = vec![1.0; points];
    let (seconds, ()) = best(|| {
        let start = Instant::now();
        double(black_box(x), black_box(&mut out));
        (start.elapsed().as_secs_f64(), ())
    });
    println!("floor {seconds}");
    let (seconds, _) = best(|| {
        let start = Instant::now();
        let mut out = vec![0.0; points];
        double(black_box(x), black_box(&mut out));
        (start.elapsed().as_secs_f64(), out)
    });
    println!("floor_fresh {seconds}");

    let (seconds, done) = best(|| {
        let start = Instant::now();
        let r = spline.values_sorted(x, &mut out);
        (start.elapsed().as_secs_f64(), r)
    });
    done?;
    println!("values_sorted {seconds}");
    let bytes: Vec<u8> = out.iter().flat_map(|v| v.to_le_bytes()).collect();
    std::fs::write(output, bytes)?;

    let (seconds, done) = best(|| {
        let start = Instant::now();
        let mut out = vec![0.0; points];
        let r = spline.values_sorted(x, &mut out);
        (start.elapsed().as_secs_f64(), r.map(|()| out))
    });
    done?;
    println!("values_sorted_fresh {seconds}");

    let (seconds, done) = best(|| {
        let start = Instant::now();
        let r = general.values_sorted(x, &mut out);
        (start.elapsed().as_secs_f64(), r)
    });
    done?;
    println!("values_sorted_any_knots {seconds}");

    let (seconds, done) = best(|| {
        let start = Instant::now();
        let r = spline.values(x, &mut out);
        (start.elapsed().as_secs_f64(), r)
    });
    done?;
    println!("values_any_order {seconds}");

    #[cfg(feature = "parallel")]
    {
        let (seconds, done) = best(|| {
            let start = Instant::now();
            let r = spline.par_values_sorted(x, &mut out);
            (start.elapsed().as_secs_f64(), r)
        });
        done?;
        println!("values_sorted_parallel {seconds}");
    }
    Ok(())
}
