//! Times the certified Faddeeva function on the points of `benches/compare_flint.py`,
//! single-threaded.
//!
//! Usage: `faddeeva_reference_timing BITS < POINTS`, one point a line: `set,re,im`. Prints
//! `time set seconds`, the mean per point of the best of seven runs, and `value re im` for every
//! point in order.

use mechaudit::reference::faddeeva;
use std::error::Error;
use std::hint::black_box;
use std::io::BufRead;
use std::time::Instant;

const RUNS: usize = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let bits: u32 = std::env::args()
        .nth(1)
        .ok_or("usage: BITS < points")?
        .parse()?;
    let mut sets: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let cells: Vec<&str> = line.split(',').collect();
        let [name, re, im] = &cells[..] else {
            return Err(format!("not set,re,im: {line}").into());
        };
        let point = (re.parse()?, im.parse()?);
        match sets.last_mut() {
            Some((last, points)) if last == name => points.push(point),
            _ => sets.push((name.to_string(), vec![point])),
        }
    }
    for (name, points) in &sets {
        let mut best = f64::INFINITY;
        for _ in 0..RUNS {
            let start = Instant::now();
            for &(x, y) in points {
                black_box(faddeeva::w_f64(x, y, bits)?);
            }
            best = best.min(start.elapsed().as_secs_f64());
        }
        println!("time {name} {:e}", best / points.len() as f64);
    }
    for (x, y) in sets.iter().flat_map(|(_, points)| points) {
        let w = faddeeva::w_f64(*x, *y, bits)?;
        let text = |b: &mechaudit::reference::Ball| b.mid().to_string_radix(10, Some(28));
        println!("value {} {}", text(&w.re), text(&w.im));
    }
    Ok(())
}
