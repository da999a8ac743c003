use super::*;
use mechaudit_solvers::faddeeva::proof::lower::LIMITS;

const E: Exponential = Exponential {
    pair: 1e-31,
    rounded: 5e-16,
    short: [4e-16, 3e-16],
    leading: 1e-16,
    boxes: 0,
};

/// `(UW + ρx)/(W − x) + ½` for every D from the limit on, W no smaller than its bound, and the limit attains it.
#[test]
fn the_smaller_exponential_counts_most_at_the_limit() {
    let (u, w) = (1.2, 0.066);
    let found = image(u, &E, &LIMITS, w);
    let at = |d: f64, w: f64| {
        let x = 2.0 * (-d).exp();
        let rho = (E.short[0] + E.short[1] * d) * TWO_52;
        (u * w + rho * x) / (w - x) + 0.5
    };
    let all = (0..400).map(|i| at(LIMITS.dominant + 0.1 * f64::from(i), w));
    assert!(all.clone().all(|k| k <= found));
    assert!(at(LIMITS.dominant, 2.0 * w) < found);
    let most = all.fold(0.0, f64::max);
    assert!(found <= most * (1.0 + 1e-9), "{found} {most}");
    // D is as far below the limit as its rounding may put it.
    let due = (at(LIMITS.dominant - 1e-12, w) - 0.5) * (1.0 + 1e-12) + 0.5;
    assert!((found / due - 1.0).abs() < 2e-14, "{found} {due}");
    // Left out beyond the second limit.
    assert!(found >= u + 2.0 * (-LIMITS.negligible).exp() / w * TWO_52);
    let mut early = LIMITS;
    early.negligible = 30.0;
    let due = u + 2.0 * (-30f64).exp() / w * TWO_52;
    assert!((image(u, &E, &early, w) / due - 1.0).abs() < 1e-9);
    // Where the exponential may be as large as w(−z), or falls slower than D grows, nothing is had.
    let mut near = LIMITS;
    near.dominant = 3.0;
    assert_eq!(image(u, &E, &near, w), f64::INFINITY);
    near.dominant = 0.9;
    assert_eq!(image(u, &E, &near, 10.0), f64::INFINITY);
    // As soon as neither is so.
    near.dominant = 1.5;
    let x = 2.0 * (-1.5f64).exp();
    let rho = (E.short[0] + E.short[1] * 1.5) * TWO_52;
    let due = (u * 0.6 + rho * x) / (0.6 - x) + 0.5;
    let found = image(u, &E, &near, 0.6);
    assert!((found / due - 1.0).abs() < 1e-9, "{found} {due}");
}

/// `(UW + ρx)/(x − W) + ½` with W at most one.
#[test]
fn the_larger_exponential_counts_least_at_the_limit() {
    let u = 1.2;
    let found = exponential(u, &E, &LIMITS);
    let at = |d: f64, w: f64| {
        let x = 2.0 * d.exp();
        (u * w + E.rounded * TWO_52 * x) / (x - w) + 0.5
    };
    for i in 0..200 {
        let d = LIMITS.dominant + 0.1 * f64::from(i);
        assert!(at(d, 1.0) <= found && at(d, 0.3) <= found);
    }
    let due = (at(LIMITS.dominant - 1e-12, 1.0) - 0.5) * (1.0 + 1e-12) + 0.5;
    assert!((found / due - 1.0).abs() < 2e-14, "{found} {due}");
}

/// The lower bounds of |w(−z)| where the exponential is smaller: `1/(√π r) − B₁` at 7 and 48, which cells and 26 terms
/// reach to `r² = 48` and 112.
#[test]
fn the_image_is_no_smaller() {
    let b1 = |r: f64| {
        (2.5 * std::f64::consts::E).sqrt() / (2.0 * std::f64::consts::PI.sqrt() * r.powi(3))
    };
    let w = |r: f64| 1.0 / (std::f64::consts::PI.sqrt() * r) - b1(r);
    for (from, part) in [(7f64, 0.459), (48.0, 0.548)] {
        for i in 0..100 {
            let r = (from + f64::from(i)).sqrt();
            assert!(w(r) >= part / r, "{r}");
        }
    }
    assert!(48f64.sqrt() < 6.93 && 112f64.sqrt() < 10.6);
}
