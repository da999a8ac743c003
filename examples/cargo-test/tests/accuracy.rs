//! The crate's function against certified references, within `cargo test`.

use mechaudit::audit;
use mechaudit::candidate::AuditError;
use mechaudit::methods::Tridiagonal;
use sweep::sweep;

#[test]
fn every_region_is_within_budget() -> Result<(), AuditError> {
    let report = audit::<Tridiagonal>(sweep).seed(1).cases(50).run()?;
    report.assert_within_budget();
    Ok(())
}

/// A factor left out is found: an audit that cannot fail would be worth nothing.
#[test]
fn a_wrong_sign_is_found() -> Result<(), AuditError> {
    let wrong = |l: &[f64], d: &[f64], u: &[f64], r: &[f64]| {
        let l: Vec<f64> = l.iter().map(|x| -x).collect();
        sweep(&l, d, u, r)
    };
    let report = audit::<Tridiagonal>(wrong)
        .region("well-scaled")
        .cases(50)
        .run()?;
    assert!(!report.passed());
    Ok(())
}
