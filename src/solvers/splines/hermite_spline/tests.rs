use super::*;
use proptest::prelude::*;

const ALL: [Slopes; 3] = [Slopes::Pchip, Slopes::Akima, Slopes::ModifiedAkima];

fn fit(x: &[f64], y: &[f64], rule: Slopes) -> HermiteSpline {
    HermiteSpline::fit(x.to_vec(), y.to_vec(), rule).expect("an interpolant")
}

/// Slopes worked out by hand.
#[test]
fn slopes_are_those_of_the_definitions() {
    // Steps 1, 2, 1 and chords 1, 2, -1.
    let (x, y) = ([0.0, 1.0, 3.0, 4.0], [0.0, 1.0, 5.0, 4.0]);
    // Harmonic mean with weights 5 and 4: 9/(5/1 + 4/2); parabolas (4·1 − 1·2)/3 and, at the right,
    // (4·(−1) − 1·2)/3 = −2, within 3·(−1).
    let got = fit(&x, &y, Slopes::Pchip).slopes();
    for (a, b) in got.iter().zip([2.0 / 3.0, 9.0 / 7.0, 0.0, -2.0]) {
        assert!((a - b).abs() < 1e-15, "{got:?}");
    }
    // Chords continued: -1, 0, 1, 2, -1, -4, -7; differences 1, 1, 1, -3, -3, -3.
    let got = fit(&x, &y, Slopes::Akima).slopes();
    for (a, b) in got.iter().zip([0.5, 5.0 / 4.0, 5.0 / 4.0, -2.5]) {
        assert!((a - b).abs() < 1e-15, "{got:?}");
    }
    // Weights 1 + 1/2, 1 + 1/2, 1 + 3/2, 3 + 1/2, 3 + 5/2, 3 + 11/2.
    let got = fit(&x, &y, Slopes::ModifiedAkima).slopes();
    let due = [
        (2.5 * 0.0 + 1.5 * 1.0) / 4.0,
        (3.5 * 1.0 + 1.5 * 2.0) / 5.0,
        (5.5 * 2.0 - 2.5) / 8.0,
        (-8.5 + 3.5 * -4.0) / 12.0,
    ];
    for (a, b) in got.iter().zip(due) {
        assert!((a - b).abs() < 2e-15, "{got:?} {due:?}");
    }
}

/// Both clippings at the ends of a PCHIP, and a level chord beside a steep one.
#[test]
fn ends_are_clipped() {
    let slopes = |y: &[f64]| fit(&[0.0, 1.0, 2.0, 3.0], y, Slopes::Pchip).slopes();
    // d = 1.5·1 − 0.5·4 < 0.
    assert_eq!(slopes(&[0.0, 1.0, 5.0, 5.0])[0], 0.0);
    // d = 1.5·1 + 0.5·10 > 3.
    assert_eq!(slopes(&[0.0, 1.0, -9.0, 0.0])[0], 3.0);
    assert_eq!(slopes(&[0.0, -9.0, 1.0, 0.0])[3], -3.0);
    assert_eq!(slopes(&[0.0, 0.0, 5.0, 5.0]), [0.0; 4]);
    assert_eq!(slopes(&[-0.0, 0.0, -0.0, 0.0]), [0.0; 4]);
}

/// Two straight pieces meet: 0/0 in Akima's formula, the mean of the chords by convention.
#[test]
fn weights_that_vanish_give_the_mean() {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let s = fit(&x, &[0.0, 0.0, 0.0, 1.0, 2.0], Slopes::Akima);
    assert_eq!(s.slopes(), [0.0, 0.0, 0.5, 1.0, 1.0]);
    let s = fit(&x, &[0.0, 0.0, 0.0, 1.0, 2.0], Slopes::ModifiedAkima);
    assert_eq!(s.slopes()[2], 0.0);
    assert_eq!(fit(&x, &[3.0; 5], Slopes::ModifiedAkima).slopes(), [0.0; 5]);
    // A bend of 10⁻¹² far from one of 1: scipy's threshold gives 0.5·10⁻¹² at knot 2.
    let x: Vec<f64> = (0..8).map(f64::from).collect();
    let y = [0.0, 0.0, 1e-12, 3e-12, 4e-12, 4e-12, 1.0, 2.0];
    let slope = fit(&x, &y, Slopes::Akima).slopes()[2];
    assert!((slope - 1.5e-12).abs() < 1e-26, "{slope}");
    // Chords of a third on both sides of knot 2, which no float is.
    let x = [0.0, 3.0, 9.0, 12.0, 18.0];
    let s = fit(&x, &[0.0, 1.0, 3.0, 7.0, 15.0], Slopes::Akima);
    assert_eq!(s.slopes()[2], 0.5 * (1.0 / 3.0) + 0.5 * (4.0 / 3.0));
}

/// Exactly collinear points whose differences are no floats, and points one unit off.
#[test]
fn collinearity_is_decided_exactly() {
    let big = 2f64.powi(60);
    // The differences need 61 bits.
    let (x, y) = ([1.0, big, 2.0 * big], [1.0, big, 2.0 * big]);
    let c = slopes::Chords::new(&x, &y);
    let s = Slopes::Akima.at_knots(&c);
    assert_eq!(s[1].slope, 1.0);
    assert_eq!((s[1].over_left.hi, s[1].over_right.hi), (0.0, 0.0));
    let y = [1.0, big, (2.0 * big).next_up()];
    let s = Slopes::Akima.at_knots(&slopes::Chords::new(&x, &y));
    assert!(s[1].over_right.hi < 0.0 && s[1].over_left.hi > 0.0);
}

/// On equal steps; on others Akima's means of chords are not the slopes of the parabola.
#[test]
fn three_points_give_the_parabola_of_akima() {
    let f = |x: f64| 2.0 * x * x - 3.0 * x + 1.0;
    let x = [-1.0, 1.0, 3.0];
    let s = fit(&x, &x.map(f), Slopes::Akima);
    for k in 0..=32 {
        let at = -1.0 + f64::from(k) / 8.0;
        assert_eq!(s.value(at), Ok(f(at)));
        let jet = s.jet(at).expect("inside");
        assert_eq!(
            (jet.first, jet.second, jet.third),
            (4.0 * at - 3.0, 4.0, 0.0)
        );
    }
    assert_eq!(s.integral(-1.0, 2.0), Ok(4.5));
}

/// Between the inner two of four points on one side of a curve Akima's cubic is a parabola,
/// exactly.
#[test]
fn opposite_excesses_cancel_exactly() {
    let x = [
        -1.8531583524249893,
        0.013882507294288082,
        1.8107409394816147,
        3.1431886261291924,
    ];
    let y = [
        -0.5104943484261693,
        -4.654121672104125,
        -4.575798373755723,
        -2.744358916957872,
    ];
    let s = fit(&x, &y, Slopes::Akima);
    assert_eq!(s.jet(1.0).map(|j| j.third), Ok(0.0));
}

/// Opposite jumps on both sides of the middle segment: its slopes, about −33, are equal by
/// definition and leave nothing of themselves in its integral, over the segment or what lies
/// between its knots.
#[test]
fn equal_slopes_leave_the_integral_alone() {
    let x = [
        3.0633212613031997,
        3.1392697364580004,
        274.3666983245242,
        274.3778196797322,
    ];
    let y = [
        2.8048960320982976,
        0.040743336077553316,
        2.4310979197376383,
        -1.9850626060012253,
    ];
    let s = fit(&x, &y, Slopes::Akima);
    let due = 0.5 * (x[2] - x[1]) * (y[1] + y[2]);
    assert!((s.slopes()[1] / s.slopes()[2] - 1.0).abs() < 1e-14);
    let (low, high) = (x[0].next_up(), x[3].next_down());
    for (a, b) in [(x[1], x[2]), (x[1], x[2].next_down())] {
        let got = s.integral(a, b).expect("inside");
        assert!((got / due - 1.0).abs() < 1e-15, "{got} {due}");
    }
    let all = s.integral(low, high).expect("inside");
    let ends = s.integral(low, x[1]).expect("inside") + s.integral(x[2], high).expect("inside");
    assert!((all - ends - due).abs() < 1e-12 * due);
}

/// A PCHIP whose slopes are 0 and, by the limit at the end, three chords is
/// `y_i + k³ (y_{i+1} − y_i)` on its last segment: what is linear and quadratic there vanishes
/// exactly.
#[test]
fn a_limited_slope_beside_a_level_one_leaves_a_cube() {
    let (h, rise) = (640.3, -3.1);
    let s = fit(
        &[-3.0, -0.1, 0.0, h],
        &[-1.0, -20.0, 0.0, rise],
        Slopes::Pchip,
    );
    assert_eq!(s.slopes()[2..], [0.0, 3.0 * (rise / h)]);
    for at in [1e-9, 1e-4, 0.3, 7.0, 200.0] {
        let k: f64 = at / h;
        let jet = s.jet(at).expect("inside");
        let due = (k.powi(3) * rise, 3.0 * k * k * rise / h);
        assert!(
            (jet.value / due.0 - 1.0).abs() < 2e-15,
            "{at}: {jet:?} {due:?}"
        );
        assert!(
            (jet.first / due.1 - 1.0).abs() < 2e-15,
            "{at}: {jet:?} {due:?}"
        );
        let area = s.integral(0.0, at).expect("inside");
        assert!(
            (area / (0.25 * at * due.0) - 1.0).abs() < 2e-15,
            "{at}: {area}"
        );
    }
}

#[test]
fn what_is_no_interpolant_is_refused() {
    use CubicSplineError as E;
    let refused = |x: &[f64], y: &[f64]| HermiteSpline::fit(x.to_vec(), y.to_vec(), Slopes::Akima);
    assert!(matches!(
        refused(&[0.0], &[0.0]),
        Err(E::TooFewKnots { .. })
    ));
    assert!(matches!(
        refused(&[0.0, 1.0], &[0.0]),
        Err(E::Length { .. })
    ));
    assert!(matches!(
        refused(&[0.0, 0.0], &[0.0, 1.0]),
        Err(E::NotIncreasing { .. })
    ));
    assert!(matches!(
        refused(&[0.0, f64::NAN], &[0.0, 1.0]),
        Err(E::NotFinite { .. })
    ));
    assert!(matches!(
        refused(&[0.0, 1.0], &[0.0, f64::INFINITY]),
        Err(E::NotFinite { .. })
    ));
    let steep = refused(&[0.0, 1e-300, 1.0], &[0.0, 1e10, 0.0]);
    assert!(matches!(steep, Err(E::Overflow { knot: 0 })));
    let s = fit(&[0.0, 1.0], &[0.0, 1.0], Slopes::Akima);
    assert!(matches!(s.value(2.0), Err(EvaluationError::Outside { .. })));
    assert!(matches!(
        s.value(f64::NAN),
        Err(EvaluationError::NotFinite { .. })
    ));
    assert!(s.values(&[0.5], &mut []).is_err());
}

#[test]
fn beyond_the_knots() {
    let s = fit(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], Slopes::Pchip);
    let with = |e| s.clone().with_extrapolation(e);
    let wrapped = with(Extrapolation::Wrap);
    assert_eq!(wrapped.value(2.5), s.value(0.5));
    assert_eq!(wrapped.value(-0.5), s.value(1.5));
    let turn = s.integral(0.0, 2.0).expect("inside");
    assert!((wrapped.integral(-2.0, 4.0).expect("wrapped") - 3.0 * turn).abs() < 1e-15);
    assert_eq!(with(Extrapolation::Clamp).value(7.0), Ok(0.0));
    assert_eq!(with(Extrapolation::Linear).value(3.0), Ok(-2.0));
    assert_eq!(with(Extrapolation::EndPolynomial).value(3.0), Ok(-3.0));
}

/// Increasing knots and ordinates for them.
fn points() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    prop::collection::vec((0.01f64..3.0, -5.0f64..5.0), 2..9).prop_map(|v| {
        let mut at = -4.0;
        let x = v.iter().map(|(h, _)| {
            at += h;
            at
        });
        (x.collect(), v.iter().map(|(_, y)| *y).collect())
    })
}

fn inside(x: &[f64], t: f64) -> f64 {
    let (a, b) = (x[0], x[x.len() - 1]);
    (a + t * (b - a)).clamp(a, b)
}

proptest! {
    #[test]
    fn ordinates_are_met((x, y) in points()) {
        for rule in ALL {
            let s = fit(&x, &y, rule);
            for (x, y) in x.iter().zip(&y) {
                prop_assert_eq!(s.value(*x), Ok(*y));
            }
            for (i, x) in x.iter().enumerate() {
                prop_assert_eq!(s.jet(*x).map(|j| j.first), Ok(s.slopes()[i]));
            }
        }
    }

    #[test]
    fn monotone_points_give_a_monotone_pchip((x, mut y) in points(), t in 0.0f64..1.0, u in 0.0f64..1.0) {
        y.sort_by(f64::total_cmp);
        let s = fit(&x, &y, Slopes::Pchip);
        let (a, b) = (inside(&x, t.min(u)), inside(&x, t.max(u)));
        let (low, high) = (s.value(a).unwrap(), s.value(b).unwrap());
        prop_assert!(high >= low - 1e-14, "{low} {high}");
        prop_assert!(s.jet(a).unwrap().first >= -1e-12);
        for (i, d) in y.windows(2).zip(x.windows(2)).map(|(y, x)| (y[1] - y[0]) / (x[1] - x[0])).enumerate() {
            for k in [i, i + 1] {
                prop_assert!(s.slopes()[k] >= 0.0 && s.slopes()[k] <= 3.0 * d * (1.0 + 1e-15));
            }
        }
    }

    /// The line through the points, whatever the knots.
    #[test]
    fn lines_are_reproduced((x, _) in points(), t in 0.0f64..1.0, a in -3i32..3, b in -3i32..3) {
        let f = |x: f64| f64::from(a) * x + f64::from(b);
        let y: Vec<f64> = x.iter().map(|x| f(*x)).collect();
        for rule in ALL {
            let s = fit(&x, &y, rule);
            let at = inside(&x, t);
            prop_assert!((s.value(at).unwrap() - f(at)).abs() <= 4e-14);
        }
    }

    /// Mirrored points give mirrored values, bit for bit.
    #[test]
    fn reflection((x, y) in points(), t in 0.0f64..1.0) {
        let turned: Vec<f64> = x.iter().rev().map(|x| -x).collect();
        let back: Vec<f64> = y.iter().rev().copied().collect();
        for rule in ALL {
            let (s, r) = (fit(&x, &y, rule), fit(&turned, &back, rule));
            let at = inside(&x, t);
            prop_assert_eq!(s.value(at), r.value(-at));
            prop_assert_eq!(s.jet(at).unwrap().first, -r.jet(-at).unwrap().first);
        }
    }

    /// Abscissae in quarters and ordinates in eighths with the other sign.
    #[test]
    fn scaling((x, y) in points(), t in 0.0f64..1.0) {
        let fine: Vec<f64> = x.iter().map(|x| 4.0 * x).collect();
        let turned: Vec<f64> = y.iter().map(|y| -8.0 * y).collect();
        for rule in ALL {
            let (s, r) = (fit(&x, &y, rule), fit(&fine, &turned, rule));
            let at = inside(&x, t);
            let (a, b) = (s.jet(at).unwrap(), r.jet(4.0 * at).unwrap());
            let due = (-8.0 * a.value, -2.0 * a.first, -0.5 * a.second, -0.125 * a.third);
            prop_assert_eq!((b.value, b.first, b.second, b.third), due);
        }
    }
}
