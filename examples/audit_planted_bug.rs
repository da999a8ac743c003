//! A planted bug and how its audit reads.
//!
//! ```sh
//! cargo run --release --example audit_planted_bug
//! ```
//!
//! The code under test solves tridiagonal systems by the sweep. In the faulty version an early
//! return treats small pivots as zero, as codes with an absolute tolerance do: right on every
//! well-scaled system, wrong on a badly scaled or nearly singular one.

use mechaudit::methods::Tridiagonal;

/// Elimination without pivoting; a pivot of at most `tiny` counts as zero.
fn sweep(lower: &[f64], diagonal: &[f64], upper: &[f64], d: &[f64], tiny: f64) -> Option<Vec<f64>> {
    let (mut pivot, mut x) = (diagonal.to_vec(), d.to_vec());
    let n = pivot.len();
    for i in 0..n {
        if i > 0 {
            let factor = lower[i - 1] / pivot[i - 1];
            pivot[i] -= factor * upper[i - 1];
            x[i] -= factor * x[i - 1];
        }
        if pivot[i].abs() <= tiny {
            return None;
        }
    }
    x[n - 1] /= pivot[n - 1];
    for i in (0..n - 1).rev() {
        x[i] = (x[i] - upper[i] * x[i + 1]) / pivot[i];
    }
    Some(x)
}

fn right(lower: &[f64], diagonal: &[f64], upper: &[f64], d: &[f64]) -> Option<Vec<f64>> {
    sweep(lower, diagonal, upper, d, 0.0)
}

fn wrong(lower: &[f64], diagonal: &[f64], upper: &[f64], d: &[f64]) -> Option<Vec<f64>> {
    sweep(lower, diagonal, upper, d, 1e-12)
}

fn main() -> Result<(), mechaudit::candidate::AuditError> {
    println!("{}", mechaudit::audit::<Tridiagonal>(right).run()?);
    println!("{}", mechaudit::audit::<Tridiagonal>(wrong).run()?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_right_one_passes() {
        let report = mechaudit::audit::<Tridiagonal>(right).run().unwrap();
        report.assert_within_budget();
    }

    #[test]
    fn the_bug_is_found_where_it_is() {
        let report = mechaudit::audit::<Tridiagonal>(wrong).run().unwrap();
        assert!(!report.passed());
        let region = |f: &mechaudit::audit::CaseReport| f.case.region;
        assert!(report.failures.iter().any(|f| region(f) == "badly-scaled"));
        assert!(report.failures.iter().all(|f| region(f) != "well-scaled"));
        let text = report.to_string();
        assert!(text.contains("a refusal, expected "), "{text}");
    }
}
