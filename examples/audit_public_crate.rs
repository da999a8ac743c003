//! Audits the Faddeeva function of a public crate, `errorfunctions` 0.2, region by region.
//!
//! ```sh
//! cargo run --release --example audit_public_crate
//! ```
//!
//! The crate translates S. G. Johnson's code, which promises a relative error near 1e-13 for the
//! number as a whole. Components near their zeros are worse, and the table shows where.

use mechaudit::audit::{Limit, Spread};
use mechaudit::candidate::AuditError;
use mechaudit::methods::{self, Faddeeva};
use num_complex::Complex;

fn w(z: Complex<f64>) -> Complex<f64> {
    errorfunctions::ComplexErrorFunctions::w(z)
}

/// What is promised, in units of 2⁻⁵³ of |W|.
const PROMISED: f64 = 1e-13 / (f64::EPSILON / 2.0);

/// What was found in a region of the domain.
struct Found {
    region: &'static str,
    cases: u64,
    /// Errors of Re W and Im W in ulps.
    components: [Spread; 2],
    /// The largest `|got − W| / |W|` in units of 2⁻⁵³.
    norm: f64,
}

fn audit(cases: u64) -> Result<Vec<Found>, AuditError> {
    let domain = methods::find("faddeeva").expect("is there").domain();
    domain
        .regions
        .iter()
        .map(|region| {
            let report = mechaudit::audit::<Faddeeva>(w)
                .region(region.name)
                .cases(cases)
                // One unit in the last place: whatever is worse is written out.
                .limit(Limit::Ulps(1.0))
                .run()?;
            Ok(Found {
                region: region.name,
                cases: report.cases,
                components: [report.outputs()[0].ulps, report.outputs()[1].ulps],
                norm: report.total.normwise.map_or(f64::NAN, |n| n.max),
            })
        })
        .collect()
}

fn main() -> Result<(), AuditError> {
    println!(
        "region                         cases  Re W worst (p99) ulps  Im W worst (p99) ulps  norm / u"
    );
    for f in audit(1000)? {
        let ulps = |s: &Spread| format!("{:.3e} ({:.2e})", s.max, s.p99);
        let [re, im] = &f.components;
        let kept = if f.norm <= PROMISED {
            ""
        } else {
            "  not as promised"
        };
        println!(
            "{:<30} {:>5}  {:>21}  {:>21}  {:>8.2e}{kept}",
            f.region,
            f.cases,
            ulps(re),
            ulps(im),
            f.norm
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_crate_is_good_where_nothing_is_hard() {
        let found = super::audit(20).unwrap();
        let mid = found.iter().find(|f| f.region == "mid").unwrap();
        assert!(mid.norm < super::PROMISED, "{}", mid.norm);
        // It computes: its digits are not ours.
        assert!(found.iter().any(|f| f.norm > 4.0));
    }
}
