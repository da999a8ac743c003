//! The worst found of the chirp-forced oscillator in each region of its audit.
//!
//! Usage: `chirp_accuracy CASES [SEED]`, cases in each region. Errors are those of y, y', y'', Re A and
//! Im A in units of 2^-53 (1 + cond), the largest found and, behind the stroke, the 99th percentile.

use mechaudit::audit::{Case, Draw, Origin, Settings, Verdict, audit_case, hex_float};
use mechaudit::methods::find;
use rayon::prelude::*;

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
    let settings = Settings::default();
    println!(
        "{:<19}{:>14}{:>16}{:>16}{:>16}{:>16}",
        "", "y", "y'", "y''", "Re A", "Im A"
    );
    for region in method.domain().regions {
        let found: Vec<_> = (0..cases)
            .into_par_iter()
            .map(|index| {
                let mut draw = Draw::new(seed, method.name(), region.name, index);
                let case = Case {
                    method: method.name(),
                    region: region.name,
                    input: (region.sample)(&mut draw),
                    origin: Origin::Random { seed, index },
                };
                let report = audit_case(&*method, case, &settings);
                let failed = report.judgement.verdict != Verdict::Pass;
                let errors: Vec<f64> = report
                    .judgement
                    .components
                    .iter()
                    .map(|c| c.conditioned)
                    .collect();
                (
                    errors,
                    failed.then_some((report.case, report.judgement.reason)),
                )
            })
            .collect();
        print!("{:<19}", region.name);
        for o in 0..method.outputs().len() {
            let mut all: Vec<f64> = found
                .iter()
                .map(|(errors, _)| errors.get(o).copied().unwrap_or(f64::NAN))
                .collect();
            all.sort_by(f64::total_cmp);
            print!(
                "{:>9.3}/{:6.3}",
                all[all.len() - 1],
                all[(all.len() - 1) * 99 / 100]
            );
        }
        println!();
        for (case, reason) in found
            .iter()
            .filter_map(|(_, failed)| failed.as_ref())
            .take(3)
        {
            let input: Vec<String> = case.input.iter().map(|x| hex_float(*x)).collect();
            println!(
                "  failed: {} {}",
                input.join(" "),
                reason.as_deref().unwrap_or("")
            );
        }
    }
    Ok(())
}
