use super::*;
use crate::pinned::{bit_by_bit, counted, largest};
use mechaudit_solvers::faddeeva::proof::lower::LIMITS;

const E: Exponential = Exponential {
    pair: 1e-31,
    rounded: 5e-16,
    short: [4e-16, 3e-16],
    leading: 1e-16,
    boxes: 0,
};

/// `(UW + ρx)/(W − x) + ½` for every D from the limit on, W no smaller than its bound, and the
/// limit attains it.
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

/// The lower bounds of |w(−z)| where the exponential is smaller: `1/(√π r) − B₁` at 7 and 48, which
/// cells and 26 terms reach to `r² = 48` and 112.
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

/// Which rectangles of the upper half-plane are behind the bounds, and what these come to.
#[test]
fn bounds_and_their_rectangles_bit_by_bit() {
    use crate::bound::Bound;
    use crate::prove::Leaf;
    let at = Rectangle {
        a: [0.0, 1.0],
        b: [0.0, 1.0],
    };
    let roots = crate::cover::roots().into_iter().filter(is_behind);
    let of = |[cell, series, huge, leading]: [f64; 4]| {
        let leaf = |formula, norm| {
            let bound = Bound {
                norm,
                ..Bound::NONE
            };
            Leaf { at, formula, bound }
        };
        let leaves = vec![
            leaf(Formula::Strip, 9.0),
            leaf(Formula::Cell { centre: (1.0, 2.0) }, 0.5 * cell),
            leaf(Formula::Huge, huge),
            leaf(Formula::Cell { centre: (2.0, 2.0) }, cell),
            leaf(Formula::Asymptotic { terms: 14 }, 8.0),
            leaf(Formula::Asymptotic { terms: 26 }, series),
        ];
        let open = Vec::new();
        let e = Exponential {
            leading: leading / TWO_52,
            ..E
        };
        let found = Dominated::together(&Certificate { leaves, open }, &e, &LIMITS);
        let d = found.expect("nothing open");
        [d.image_in_cell, d.image_by_series, d.exponential, d.huge]
    };
    let open = crate::Open { at, why: "planted" };
    let open = Certificate {
        leaves: Vec::new(),
        open: vec![open],
    };
    assert!(Dominated::together(&open, &E, &LIMITS).is_err());
    let none = Dominated::together(&Certificate::default(), &E, &LIMITS).expect("nothing open");
    assert!(none.image_in_cell.is_infinite() && none.huge.is_infinite());
    let all = [
        [1.1, 1.2, 0.9, 0.6],
        [1.2, 1.1, 0.5, 0.6],
        [f64::NAN, 1.0, 1.0, 1.0],
    ];
    let found = [
        counted("rectangles", roots),
        largest("bounds", all.into_iter().flat_map(of)),
    ];
    let due = [
        ("rectangles", 0x4f407ad25956750a, 84.0),
        ("bounds", 0x276f419187a024f4, 2.753374348581895),
    ];
    bit_by_bit(&found, &due);
}
