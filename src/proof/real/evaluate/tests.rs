use super::*;

const U: f64 = 1.0 / (2.0 * TWO_52);

fn at(lo: f64, hi: f64) -> Interval {
    Interval {
        negative: true,
        ends: [lo, hi],
    }
}

fn sum(lo: f64, hi: f64, error: f64) -> Tracks {
    Tracks {
        exact: Enclosure::new(lo, hi),
        error,
        tiny: 0.0,
        small: false,
        relative: f64::INFINITY,
    }
}

fn near(x: f64, due: f64) -> bool {
    x >= due * (1.0 - 1e-14) && x <= due * (1.0 + 1e-9)
}

/// Half a unit for the last rounding, and what is wrong before it as a part of the least value in
/// units.
#[test]
fn one_rounding_after_what_is_wrong() {
    let none = Rounding::default();
    let of = |y: &Tracks, part: f64, normal: bool| rounded(y, &at(0.5, 1.0), part, normal, none);
    let due = |e: f64| 0.5 + e / U;
    assert!(near(
        of(&sum(1.0, 2.0, 0.1 * U), 0.0, true).expect("a bound"),
        due(0.1 * U)
    ));
    assert!(near(
        of(&sum(1.0, 2.0, 0.1 * U), 0.2 * U, true).expect("a bound"),
        due(0.3 * U)
    ));
    // The better of the error by size and the part.
    let mut y = sum(1.0, 2.0, 0.4 * U);
    y.relative = 0.1 * U;
    assert!(near(of(&y, 0.0, true).expect("a bound"), due(0.1 * U)));
    y.relative = 0.9 * U;
    assert!(near(of(&y, 0.0, true).expect("a bound"), due(0.4 * U)));
    // Beside underflow it is rounded twice: ¾ + e/2.
    assert!(near(
        of(&sum(1.0, 2.0, 0.1 * U), 0.0, false).expect("a bound"),
        0.8
    ));
    // More than a unit off, or a quarter where the product may be subnormal, nothing is had.
    assert!(
        of(&sum(1.0, 2.0, 0.99 * U), 0.0, true).is_ok()
            && of(&sum(1.0, 2.0, 1.01 * U), 0.0, true).is_err()
    );
    assert!(
        of(&sum(1.0, 2.0, 0.24 * U), 0.0, false).is_ok()
            && of(&sum(1.0, 2.0, 0.26 * U), 0.0, false).is_err()
    );
    assert!(of(&sum(1.0, 2.0, f64::NAN), 0.0, true).is_err());
    // A truncation is a whole unit.
    let last = Rounding {
        fma_rounds_twice: false,
        truncates: Some(Rounding::LAST),
    };
    let found = rounded(&sum(1.0, 2.0, 0.1 * U), &at(0.5, 1.0), 0.0, true, last);
    assert!(near(found.expect("a bound"), 1.1));
    let found = rounded(&sum(1.0, 2.0, 0.1 * U), &at(0.5, 1.0), 0.0, false, last);
    assert!(near(found.expect("a bound"), 1.3));
}

/// Checks that what underflows counts in units of the least value; where these are of its own size
/// nothing is had.
#[test]
fn digits_that_underflow_count() {
    let of = |least: f64, small: bool, tiny: f64, x: f64| {
        let mut y = sum(least, 2.0 * least, 0.0);
        (y.tiny, y.small) = (tiny, small);
        rounded(&y, &at(x, 1.0), 0.0, true, Rounding::default())
    };
    let far = 1.01 * FAR_ABOVE;
    // 0.999 of it is below FAR_ABOVE no longer.
    let found = of(far, false, 1e15, 1.0).expect("a bound");
    let due = 0.5 + 1e15 * TINIEST / power_of_two(-960 - 52);
    assert!(near(found, due) && found > 0.5);
    assert!(
        of(FAR_ABOVE, false, 1.0, 1.0).is_err() && of(0.9 * FAR_ABOVE, false, 1.0, 1.0).is_err()
    );
    // The factor x of a small one.
    assert!(of(2.0, true, 1.0, far).is_ok() && of(2.0, true, 1.0, 0.4 * FAR_ABOVE).is_err());
    assert!(of(2.0, false, 1.0, 0.4 * FAR_ABOVE).is_ok());
    // Nothing underflows, nothing is lost.
    assert_eq!(of(1e-300, false, 0.0, 1.0), Ok(0.5));
}

/// Checks whether `2^n s` is above 2¹⁰²⁴: all of it, and clear of the limit.
#[test]
fn overflow_is_decided_on_all_ways() {
    let way = |lo: f64, hi: f64, exponent: f64| Way {
        sum: sum(lo, hi, 0.0),
        inner: None,
        exponent: Some(exponent),
    };
    let wide = at(1.0, 2.0);
    let of = |ways: &[Way]| overflows(ways, &wide);
    assert_eq!(of(&[way(1.1, 1.2, 1024.0)]), Ok(true));
    assert_eq!(of(&[way(0.8, 0.9, 1024.0)]), Ok(false));
    assert_eq!(of(&[way(0.8, 0.9, 1025.0)]), Ok(true));
    assert_eq!(of(&[way(1.1, 1.2, 1023.0)]), Ok(false));
    assert!(of(&[way(0.9, 1.1, 1024.0)]).is_err());
    let margin = 2f64.powi(-50);
    for (lo, hi) in [
        (1.0, 1.1),
        (1.0 + 0.9 * margin, 1.1),
        (0.9, 1.0),
        (0.9, 1.0 - 0.9 * margin),
    ] {
        assert!(of(&[way(lo, hi, 1024.0)]).is_err(), "{lo} {hi}");
    }
    assert_eq!(of(&[way(1.0 + 1.5 * margin, 1.1, 1024.0)]), Ok(true));
    assert_eq!(of(&[way(0.9, 1.0 - 1.5 * margin, 1024.0)]), Ok(false));
    // Two ways of different answers, none, and one that is not known.
    assert!(of(&[way(1.1, 1.2, 1024.0), way(0.8, 0.9, 1024.0)]).is_err());
    assert_eq!(
        of(&[way(1.1, 1.2, 1024.0), way(1.3, 1.4, 1024.0)]),
        Ok(true)
    );
    assert!(of(&[]).is_err() && of(&[way(1.0, 1.0, 2100.0)]).is_err());
    assert!(
        of(&[Way {
            exponent: None,
            ..way(1.0, 1.1, 0.0)
        }])
        .is_err()
    );
    // A single number by its value: the last one whose erfcx is in the range, and the next.
    let last = 26.628_735_713_751_49;
    let point = |x: f64| overflows(&[], &at(x, x));
    assert_eq!(
        [point(last), point(f64::next_up(last))],
        [Ok(false), Ok(true)]
    );
    assert_eq!([point(1.0), point(26.7)], [Ok(false), Ok(true)]);
}

/// Limits of the formulas that take no evaluation: refused where they do not hold.
#[test]
fn formulas_are_refused_beyond_their_limits() {
    let tables = Tables::of_the_solver(Function::Erfc).expect("decided");
    let of = |function, formula, negative, lo, hi| {
        let at = Interval {
            negative,
            ends: [lo, hi],
        };
        bound(&tables, function, formula, &at, Rounding::default()).map(|b| b.1)
    };
    use Function::{Dawson, Erf, Erfc, Erfcx};
    assert!(of(Erfcx, Formula::Overflow, true, 26.6, 27.0).is_err());
    assert_eq!(of(Erfcx, Formula::Overflow, true, 26.65, 27.0), Ok(0.0));
    assert!(of(Erf, Formula::Constant, false, 1.0, 7.0).is_err());
    // 2^53 e^{−x²}/(√π x), of erfc half as much.
    let due = 2.0 * TWO_52 * (-4f64).exp() / (2.0 * 1.77);
    assert!(near(
        of(Erf, Formula::Constant, false, 2.0, 7.0).expect("a bound"),
        due
    ));
    assert!(near(
        of(Erfc, Formula::Constant, true, 2.0, 7.0).expect("a bound"),
        0.5 * due
    ));
    assert!(of(Erfc, Formula::Constant, true, 1.0, 7.0).is_err());
    assert!(of(Erfc, Formula::Constant, false, 27.29, 28.0).is_err());
    assert_eq!(of(Erfc, Formula::Constant, false, 27.3, 28.0), Ok(0.5));
    assert!(of(Dawson, Formula::Far, false, 9.9e98, 1e100).is_err());
    assert!(of(Dawson, Formula::Far, false, 1e99, 1e100).is_ok());
    assert!(of(Dawson, Formula::Far, false, 1e100, 1e200).is_ok());
    assert!(of(Erfcx, Formula::Far, false, 1e100, 4e100).is_err());
    // Of the largest numbers the value is subnormal, and rounded twice.
    let far = |x: f64| of(Erfcx, Formula::Far, false, x, 1.1 * x).expect("a bound");
    assert!(
        far(1.1e100) < 0.6 && far(1.2e308) > 0.74,
        "{} {}",
        far(1.1e100),
        far(1.2e308)
    );
    assert!(
        of(
            Erfcx,
            Formula::Value(Inner::Series { terms: 4 }),
            false,
            5e6,
            5.1e6
        )
        .is_err()
    );
    // 2e^{x²} alone: erfcx counts.
    let alone = of(Erfcx, Formula::Exponential, true, 1.0, 1.001);
    assert!(alone.is_err() || alone.expect("a bound") > 1.0);
}

/// Subnormal results are rounded twice: whether there are any is decided by the least value.
#[test]
fn subnormal_results_are_noticed() {
    let way = |lo: f64, hi: f64, exponent| Way {
        sum: sum(lo, hi, 0.0),
        inner: None,
        exponent,
    };
    let normal = |lo: f64, n: f64| way(lo, 1e9, Some(n)).is_normal();
    assert!(normal(1.0, -1021.0) && !normal(1.0, -1022.0) && !normal(1.0, -1023.0));
    assert!(normal(8.0, -1024.0) && !normal(8.0, -1025.0));
    assert!(!normal(0.99, -1021.0) && way(1e-320, 1.0, None).is_normal());
}

/// Bounds of every formula of the four functions over intervals of some sizes.
#[test]
fn formulas_bit_by_bit() {
    use crate::pinned::{counted, digest, of_binades, units};
    use crate::real::choice;
    let mut unit = units(15);
    let mut found = Vec::new();
    for function in Function::ALL {
        let tables = Tables::of_the_solver(function).expect("decided");
        let mut ends: Vec<[f64; 2]> = vec![
            [SMALL.next_down(); 2],
            [SMALL; 2],
            [SMALL * 0.5, SMALL],
            [SMALL * 0.5, SMALL.next_down()],
            [26.5, 26.5],
            [26.64, 26.65],
            [26.641, 26.641],
            [26.7, 26.8],
            [27.3, 27.5],
            [1e150, 1.1e150],
            [1e99, 1.1e99],
        ];
        for i in 0..60 {
            let x = match i % 3 {
                0 => of_binades(&mut unit, [-1000, 300]),
                1 => 7.0 * unit(),
                _ => 27.0 * unit(),
            };
            let side = of_binades(&mut unit, [-14, -7]);
            ends.push([x, x * (1.0 + side)]);
        }
        let mut all = Vec::new();
        for ends in ends {
            for &negative in function.signs() {
                let at = Interval { negative, ends };
                let formula = choice(function, negative, ends[0]);
                all.push(bound(&tables, function, formula, &at, Rounding::default()));
            }
        }
        let most = all.iter().flatten().map(|b| b.1).fold(0.0, f64::max);
        found.push((function.name(), digest(&all), most));
    }
    // Limits that are met exactly.
    let near = |x: f64| (0..33).map(move |i| f64::from_bits(x.to_bits() + i - 16));
    let tables = Tables::of_the_solver(Function::Erfc).expect("decided");
    let of = |function, formula, x: f64| {
        let at = Interval {
            negative: false,
            ends: [x, x.next_up()],
        };
        bound(&tables, function, formula, &at, Rounding::default())
    };
    let zero = near(745.2f64.sqrt()).map(|x| of(Function::Erfc, Formula::Constant, x));
    let above = near(710f64.sqrt()).map(|x| of(Function::Erfcx, Formula::Overflow, x));
    let met: Vec<_> = zero.chain(above).collect();
    let way = |exponent: f64| Way {
        sum: sum(1.25, 1.5, 0.0),
        inner: None,
        exponent: Some(exponent),
    };
    let exponents = [24.0, 25.0, 1024.0, 2023.0, 2024.0];
    let over = exponents.map(|n| overflows(&[way(n)], &at(1.0, 2.0)));
    let ones = [0.5, 1.0, 2.0].iter().flat_map(|x| {
        let margin = power_of_two(-50);
        let all = [
            x - margin,
            *x,
            x + margin,
            (x - margin).next_down(),
            (x + margin).next_up(),
        ];
        all.into_iter()
            .flat_map(move |lo| all.map(|hi| above_one([lo, hi])))
    });
    let mut roundings = Vec::new();
    for error in [
        0.0, 0.125, 0.249, 0.25, 0.2500001, 0.5, 0.999, 1.0, 1.0000001,
    ] {
        for [lo, hi] in [[1.0, 1.5], [1e-310, 1e-300], [FAR_ABOVE, 1.0]] {
            for (tiny, small) in [(0.0, false), (2.0, false), (2.0, true)] {
                let y = Tracks {
                    tiny,
                    small,
                    ..sum(lo, hi, error * U * lo)
                };
                for normal in [true, false] {
                    roundings.push(rounded(&y, &at(0.5, 1.0), 0.0, normal, Rounding::default()));
                }
            }
        }
    }
    for m in near(FAR_ABOVE / 0.999) {
        let y = Tracks {
            tiny: 2.0,
            ..sum(m, 1.5 * m, 0.0)
        };
        roundings.push(rounded(&y, &at(0.5, 1.0), 0.0, true, Rounding::default()));
    }
    // An error that is the limit itself.
    for e in [0.25, 1.0] {
        let part = (e * U).next_down();
        let part = [part.next_down(), part, part.next_up()];
        roundings.extend(part.map(|p| {
            rounded(
                &sum(1.0, 1.5, 0.0),
                &at(1.0, 1.5),
                p,
                e == 1.0,
                Rounding::default(),
            )
        }));
    }
    let binades = [-1074, -1030, -1022, -1000, -960];
    let under = binades.map(|k| {
        let ends = [power_of_two(k), 1.5 * power_of_two(k)];
        (underflowing(ends, 1e-33), beyond_subnormal(ends[0]))
    });
    let scaled = [[1e99, 1.1e99], [1.0, 1.5], [1.5, 2.0], [1e-300, 1.1e-300]].map(scaled);
    let beside = [
        None,
        Some(-1.0),
        Some(0.0),
        Some(60.0),
        Some(899.0),
        Some(901.0),
        Some(2000.0),
    ];
    found.extend([
        counted("above one", ones),
        counted("roundings", roundings),
        counted("underflow", under),
        counted("beside", beside.map(erfcx_beside)),
        counted("scaled", scaled),
        counted("limits", met),
        counted("overflow", over),
    ]);
    let due = [
        ("erf", 0x26b1333344471b0d, 0.5020259033620119),
        ("erfc", 0xb4b54cc8c174e70f, 1.4889496290529702),
        ("erfcx", 0x9dd9eca47b0552a3, 1.1220819062517629),
        ("dawson", 0x1cd6160d931512d0, 1.1220819062517744),
        ("above one", 0x6bf1dfe6c438348e, 75.0),
        ("roundings", 0xf1a8f848acb1b367, 201.0),
        ("underflow", 0x3138881588042297, 5.0),
        ("beside", 0x40b7f185ea96ec2d, 7.0),
        ("scaled", 0xc3f596ed59a3c664, 4.0),
        ("limits", 0x381d3f7926f41751, 66.0),
        ("overflow", 0x2047f73bb01969ca, 5.0),
    ];
    crate::pinned::bit_by_bit(&found, &due);
}
