//! Accuracy of the chirp-forced oscillator, region by region.
//!
//! `MECHAUDIT_EFFORT` (a positive number, default 1) multiplies the number of cases. The table of the
//! worst found is printed with `--nocapture`.
#![cfg(feature = "oracle")]

use mechaudit::audit::{Case, Draw, Origin, Settings, audit_case};
use mechaudit::methods::find;
use rayon::prelude::*;

#[test]
fn worst_found_in_each_region() {
    let effort: f64 =
        std::env::var("MECHAUDIT_EFFORT").map_or(1.0, |t| t.parse().expect("a number"));
    let cases = (60.0 * effort).ceil() as u64;
    let method = find("chirp-response").expect("registered");
    let settings = Settings::default();
    let mut bad = 0;
    for region in method.domain().regions {
        let found: Vec<_> = (0..cases)
            .into_par_iter()
            .map(|index| {
                let mut draw = Draw::new(7, method.name(), region.name, index);
                let input = (region.sample)(&mut draw);
                let case = Case {
                    method: method.name(),
                    region: region.name,
                    input,
                    origin: Origin::Random { seed: 7, index },
                };
                audit_case(&*method, case, &settings)
            })
            .collect();
        let mut line = format!("{:<20}", region.name);
        let mut worst = (0.0, None);
        for o in 0..5 {
            let mut all: Vec<f64> = found
                .iter()
                .map(|r| {
                    r.judgement.components.get(o).map_or(f64::INFINITY, |c| {
                        if c.conditioned.is_nan() {
                            f64::INFINITY
                        } else {
                            c.conditioned
                        }
                    })
                })
                .collect();
            for (r, x) in found.iter().zip(&all) {
                if *x > worst.0 {
                    worst = (*x, Some(r));
                }
            }
            all.sort_by(f64::total_cmp);
            line += &format!(
                " {:9.3}/{:6.2}",
                all[all.len() - 1],
                all[all.len() * 99 / 100]
            );
        }
        println!("{line}");
        if worst.0 > 20.0 {
            bad += 1;
            let r = worst.1.unwrap();
            println!(
                "    {:?} {:?} {:?} bits {} cond {:?}",
                r.case.input,
                r.answer,
                r.reference,
                r.bits,
                r.judgement
                    .components
                    .iter()
                    .map(|c| c.condition)
                    .collect::<Vec<_>>()
            );
        }
    }
    assert_eq!(bad, 0);
}
