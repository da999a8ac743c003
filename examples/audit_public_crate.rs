//! Audits the Faddeeva function of a public crate, `errorfunctions` 0.2, region by region.
//!
//! ```sh
//! cargo run --release --example audit_public_crate
//! ```
//!
//! The crate translates S. G. Johnson's code, which promises a relative error near 1e-13 for the
//! number as a whole. Components near their zeros are worse, and the table shows where.

use mechaudit::audit::{Limit, Spread};
use mechaudit::candidate::{AuditError, Report};
use mechaudit::methods::Faddeeva;
use num_complex::Complex;

fn w(z: Complex<f64>) -> Complex<f64> {
    errorfunctions::ComplexErrorFunctions::w(z)
}

/// The promised accuracy, in units of 2⁻⁵³ of |W|.
const PROMISED: f64 = 1e-13 / (f64::EPSILON / 2.0);

fn audit(cases: u64) -> Result<Report, AuditError> {
    mechaudit::audit::<Faddeeva>(w)
        .cases(cases)
        // One unit in the last place: whatever is worse is written out.
        .limit(Limit::Ulps(1.0))
        .run()
}

fn main() -> Result<(), AuditError> {
    println!(
        "region                         cases  Re W worst (p99) ulps  Im W worst (p99) ulps  norm / u"
    );
    for region in &audit(1000)?.regions {
        let ulps = |s: &Spread| format!("{:.3e} ({:.2e})", s.max, s.p99);
        let norm = region.normwise.map_or(0.0, |s| s.max);
        let kept = if norm <= PROMISED {
            ""
        } else {
            "  not as promised"
        };
        println!(
            "{:<30} {:>5}  {:>21}  {:>21}  {norm:>8.2e}{kept}",
            region.name,
            region.cases,
            ulps(&region.outputs[0].ulps),
            ulps(&region.outputs[1].ulps),
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_crate_is_good_where_nothing_is_hard() {
        let report = super::audit(20).unwrap();
        let norm = |region: &str| {
            let found = report.regions.iter().find(|r| r.name == region).unwrap();
            found.normwise.unwrap().max
        };
        assert!(norm("mid") < super::PROMISED, "{}", norm("mid"));
        // It computes: its digits are not ours.
        assert!(report.regions.iter().any(|r| norm(r.name) > 4.0));
    }
}
