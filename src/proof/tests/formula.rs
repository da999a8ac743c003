use super::*;

fn near(x: f64, due: f64) -> bool {
    x >= due * (1.0 - 1e-12) && x <= due * (1.0 + 1e-9)
}

fn part(lo: f64, hi: f64, error: f64) -> Tracks {
    Tracks {
        exact: Interval::new(lo, hi),
        error,
        tiny: 0.0,
        small: false,
        relative: f64::INFINITY,
    }
}

const NONE: Truncation = Truncation {
    norm: 0.0,
    re: 0.0,
    im: 0.0,
    tiny: 0.0,
    sum: None,
};

/// Differences from a centre are exact below `2^{g+53}`, g the coarser grid's exponent, and refused beyond.
#[test]
fn distances_that_are_rounded_are_refused() {
    let of = |ends: [f64; 2], centre: f64| offsets(ends, centre).map(|t| (t.ends, t.grain));
    assert_eq!(of([1.5, 1.75], 1.25), Ok(([0.25, 0.5], -52)));
    assert_eq!(of([1.5, 1.75], 2.0), Ok(([-0.5, -0.25], -52)));
    // The finer grid of the two, and the larger of both distances.
    assert_eq!(of([0.5, 1.0], 1.25), Ok(([-0.75, -0.25], -53)));
    assert!(of([0.25, 3.0], 1.25).is_err());
    assert!(of([0.25, 1.5], 1.25).is_err() && of([0.5, 0.75], 1.75).is_err());
    assert_eq!(of([1.25, 1.25], 1.25), Ok(([0.0, 0.0], -52)));
    assert_eq!(of([1e-9, 0.5], 0.0), Ok(([1e-9, 0.5], grain_of(1e-9))));
    // All numbers of them: no difference is rounded.
    assert_eq!(of([1.1, 2.0], 3.0).map(|t| t.1), Ok(-52));
    assert!(of([1.0, 2.0], 3.0).is_err());
    assert!(of([0.1, 0.2], 1.5).is_err());
}

/// A component's error in units in the last place of its least value.
#[test]
fn components_in_units_of_their_least_value() {
    let u = 2f64.powi(-52);
    let of = |r: &Tracks, truncated: f64, norm: f64| {
        component(r, truncated, norm, Interval::new(0.25, 0.5))
    };
    let (units, least) = of(&part(1.5, 1.75, u), 0.0, 0.0);
    assert!(near(units, 1.0) && near(least, 1.5));
    // The truncation is taken from the value and added to the error; the better of both bounds serves.
    let (units, least) = of(&part(1.5, 1.75, u), 0.6, 0.9);
    assert!(near(units, (0.6 + u) * 2.0 / u) && near(least, 0.9));
    let (units, _) = of(&part(1.5, 1.75, u), 0.6, u);
    assert!(near(units, 2.0));
    let negative = part(-1.75, -1.5, u);
    assert!(near(of(&negative, 0.0, 0.0).0, 1.0));
    // What may be zero has no bound, unless it is zero.
    assert_eq!(of(&part(-1.0, 1.0, u), 0.0, 0.0).0, f64::INFINITY);
    assert_eq!(of(&part(0.5, 1.0, u), 0.5, 1.0).0, f64::INFINITY);
    assert_eq!(
        of(&part(0.5, 1.0, f64::INFINITY), 0.0, 0.0).0,
        f64::INFINITY
    );
    assert_eq!(of(&part(0.0, 0.0, 0.0), 0.5, 1.0), (0.0, f64::INFINITY));
    assert_eq!(of(&part(0.0, 0.0, u), 0.0, 1.0).0, f64::INFINITY);
    assert!(of(&part(1.0, 1.0, 0.0), 0.5, 1.0).0 > 1e14);
    // Beside the factor σ: a part of the value is at most as many units of 2⁻⁵³, or by the least value.
    let small = Tracks {
        small: true,
        ..part(1.5, 1.75, u)
    };
    let (units, least) = of(&small, 0.0, 0.0);
    assert!(near(least, 0.375) && near(units, 2.0 / 1.5));
    let (units, _) = component(&small, 0.0, 0.0, Interval::new(0.5, 0.5));
    assert!(near(units, 1.0));
    let (units, least) = component(&small, 0.0, 0.0, Interval::new(0.0, 0.5));
    assert!(near(units, 2.0 / 1.5) && least == 0.0);
    // The bound of the absolute value does not serve there.
    assert!(near(of(&small, 0.1, 0.0).0, 2.0 * (0.1 + u) / 1.4 / u));
}

/// Sums `y u + E`, E left out or added.
#[test]
fn sums_of_two_positive_terms() {
    let t = OfSum {
        slope: 0.01,
        exponential: 0.02,
        most: 0.001,
        least: 0.5,
    };
    let sigma = Interval::new(0.25, 0.5);
    let mut r = part(2.0, 3.0, 0.03);
    (r.small, r.relative) = (true, 0.001);
    // E/y and |u − U|, and rounding as a part or by its size.
    let left = 0.001 / 0.25 + 0.01;
    let (units, least) = of_sum(&r, &t, sigma);
    let size = 2.0 - left;
    assert!(near(units, (0.003 + left) / size * 2.0 * TWO_52) && near(least, size * 0.25));
    r.relative = 1.0;
    assert!(near(
        of_sum(&r, &t, sigma).0,
        (0.03 + left) / size * 2.0 * TWO_52
    ));
    // Nothing left of it, or a y that may be zero: no bound.
    for lo in [left, 0.0, -1.0] {
        let none = Tracks {
            exact: Interval::new(lo, 3.0),
            ..r
        };
        assert_eq!(of_sum(&none, &t, sigma).0, f64::INFINITY, "{lo}");
    }
    assert_eq!(of_sum(&r, &t, Interval::new(0.0, 0.5)).0, f64::INFINITY);
    // Both terms: no larger a part than one of them.
    (r.small, r.relative) = (false, 0.001);
    let part = |slope: f64, exponential: f64| {
        let worst = f64::max(slope / (0.5 - slope), exponential);
        (0.001 * (1.0 + worst) + worst) * 2.0 * TWO_52
    };
    let (units, least) = of_sum(&r, &t, sigma);
    assert!(near(units, part(0.01, 0.02)) && near(least, 2.0 * 0.99));
    let other = OfSum { slope: 0.1, ..t };
    assert!(near(of_sum(&r, &other, sigma).0, part(0.1, 0.02)));
    let none = OfSum { slope: 0.5, ..t };
    assert_eq!(of_sum(&r, &none, sigma).0, f64::INFINITY);
    let negative = Tracks {
        exact: Interval::new(-1.0, 3.0),
        ..r
    };
    assert_eq!(of_sum(&negative, &t, sigma).1, 0.0);
}

/// The norm from both components, the truncation, and what underflows.
#[test]
fn norms_from_components() {
    let of = |parts: [Tracks; 2], truncation: Truncation| {
        Evaluated { parts, truncation }.bound(Interval::new(0.25, 0.5))
    };
    let u = 1.0 / TWO_52;
    let both = [part(3.0, 3.5, 3.0 * u), part(-4.5, -4.0, 4.0 * u)];
    let found = of(both, NONE);
    assert!(
        near(found.norm, 1.0) && near(found.re, 1.5) && near(found.im, 2.0) && found.tiny == 0.0
    );
    let cut = Truncation {
        norm: 1.0,
        re: 1.0,
        im: 0.5,
        ..NONE
    };
    let found = of(both, cut);
    assert!(near(found.norm, (5.0 * u + 1.0) / 4.0 / u));
    assert!(
        near(found.re, 0.5 * (3.0 + 1.0 / u)) || near(found.re, 1.0 / u + 3.0),
        "{found:?}"
    );
    // A factor σ of one of them, from its least and its largest.
    let small = [
        Tracks {
            small: true,
            ..both[0]
        },
        both[1],
    ];
    let found = of(small, NONE);
    let due = f64::hypot(1.5, 4.0) / f64::hypot(0.75, 4.0);
    assert!(near(found.norm, due), "{found:?}");
    // Far above underflow what is lost is a part of a unit; beside it, it is told apart.
    let lost = |scale: f64, tiny: f64| {
        let part = |r: &Tracks| Tracks {
            exact: Interval::new(r.exact.lo * scale, r.exact.hi * scale),
            error: r.error * scale,
            tiny,
            ..*r
        };
        of([part(&both[0]), part(&both[1])], NONE)
    };
    let (above, below) = (2.0 * FAR_ABOVE, 0.125 * FAR_ABOVE);
    let found = lost(above, 1e16);
    let more = 2e16 * TINIEST / (5.0 * above) * TWO_52;
    assert!(
        found.tiny == 0.0 && near(found.norm, 1.0 + more),
        "{found:?} {more}"
    );
    let found = lost(below, 7.0);
    assert!(found.tiny == 7.0 && near(found.re, 1.5), "{found:?}");
    assert!(near(
        lost_units(2f64.powi(40), 1.5),
        2f64.powi(40) * TINIEST / u
    ));
    let sum = Some(OfSum {
        slope: 0.0,
        exponential: 0.0,
        most: 0.0,
        least: 1.0,
    });
    let with_sum = |scale: f64| {
        let mut re = part(3.0 * scale, 3.5 * scale, 0.0);
        (re.relative, re.tiny) = (u, 1e16);
        of([re, part(1.0, 1.0, 0.0)], Truncation { sum, ..NONE })
    };
    assert!(with_sum(FAR_ABOVE).tiny == 0.0 && with_sum(FAR_ABOVE).re > 2.0);
    assert!(with_sum(0.1 * FAR_ABOVE).tiny == 1e16 && near(with_sum(0.1 * FAR_ABOVE).re, 2.0));
    // What may be zero has no bound.
    assert_eq!(
        of([part(-1.0, 1.0, u), part(-1.0, 1.0, u)], NONE).norm,
        f64::INFINITY
    );
    let worst = found.max(Bound {
        norm: 9.0,
        re: 0.0,
        im: 9.0,
        tiny: 0.0,
    });
    assert_eq!(
        [worst.norm, worst.re, worst.im, worst.tiny],
        [9.0, found.re, 9.0, found.tiny]
    );
}
