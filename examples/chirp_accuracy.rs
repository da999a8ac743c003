//! The worst found of the chirp-forced oscillator in each region of its audit.
//!
//! Usage: `chirp_accuracy CASES [SEED]`, cases in each region. Printed are the largest errors of y,
//! y', y'', Re A and Im A in units of 2^-53 (1 + cond), the enclosures' radii included. Condition
//! numbers, most of the work, are only computed where an error might be the largest so far.

use mechaudit::audit::{Draw, Method, ReferenceAnswer, SolverAnswer, hex_float};
use mechaudit::methods::find;
use mechaudit::reference::Ball;
use rayon::prelude::*;
use rug::Rational;
use std::sync::Mutex;

const OUTPUTS: usize = 5;
const UNIT: f64 = f64::EPSILON / 2.0;
/// Bits of the reference; the method adds what it may lose.
const BITS: u32 = 128;

/// The largest errors so far and where they were.
type Worst = [(f64, Vec<f64>); OUTPUTS];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Vec<u64> = std::env::args()
        .skip(1)
        .map(|t| t.parse())
        .collect::<Result<_, _>>()?;
    let (cases, seed) = match numbers[..] {
        [cases] if cases > 0 => (cases, 1),
        [cases, seed] if cases > 0 => (cases, seed),
        _ => return Err("usage: chirp_accuracy CASES [SEED]".into()),
    };
    let method = find("chirp-response").ok_or("the method is not registered")?;
    for region in method.domain().regions {
        let worst = Mutex::new(Worst::default());
        (0..cases).into_par_iter().for_each(|index| {
            let mut draw = Draw::new(seed, method.name(), region.name, index);
            examine(&*method, (region.sample)(&mut draw), &worst);
        });
        let worst = worst.into_inner()?;
        print!("{:<19}", region.name);
        for (error, _) in &worst {
            print!("{error:>9.3}");
        }
        let (_, input) = worst
            .iter()
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .expect("five");
        let input: Vec<String> = input.iter().map(|x| hex_float(*x)).collect();
        println!("   {}", input.join(","));
    }
    Ok(())
}

fn examine(method: &dyn Method, input: Vec<f64>, worst: &Mutex<Worst>) {
    let exact: Vec<Rational> = input
        .iter()
        .filter_map(|x| Rational::from_f64(*x))
        .collect();
    let SolverAnswer::Values(got) = method.solve(&input) else {
        panic!("refused: {input:?}");
    };
    let mut bits = BITS;
    let due = loop {
        let ReferenceAnswer::Values(due) = method.reference(&exact, bits) else {
            panic!("no reference: {input:?}");
        };
        let sharp = |b: &Ball| b.is_zero() || b.accuracy_bits() > 56;
        if bits > 4000 || due.values.iter().all(sharp) {
            break due.values;
        }
        bits *= 2;
    };
    let mut conditions = None;
    for (o, (got, due)) in got.iter().zip(&due).enumerate() {
        let error = (&Ball::exact(64, *got) - due).magnitude().to_f64();
        let size = due.mignitude().to_f64();
        let so_far = worst.lock().expect("no panic")[o].0;
        // NaN counts as infinite.
        if error / size / UNIT <= so_far || error == 0.0 {
            continue;
        }
        let c = conditions.get_or_insert_with(|| method.conditions(&input));
        let c = c.as_ref().map_or(0.0, |c| c[o]);
        let relative = error / (size + c) / UNIT;
        let relative = if relative.is_nan() {
            f64::INFINITY
        } else {
            relative
        };
        let mut worst = worst.lock().expect("no panic");
        if relative > worst[o].0 {
            worst[o] = (relative, input.clone());
        }
    }
}
