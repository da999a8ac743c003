//! Tests of `lines`.

use super::*;

#[test]
fn the_reference_gives_the_digits_that_are_asked_for() {
    let p = [1.0, 0.5, 0.0625, 0.25, -0.03125, 0.125, 0.25, 1.5];
    let p = p.map(|x| Rational::from_f64(x).unwrap());
    for (bits, due) in [(80, 64), (400, 352)] {
        let ReferenceAnswer::Expected(parts, _) = HartmannTran.reference(&p, bits) else {
            panic!("no values");
        };
        for part in parts {
            assert!(part.number().unwrap().accuracy_bits() >= due, "{bits}");
        }
    }
}

#[test]
fn both_parts_are_to_be_as_good_as_the_authors_say() {
    let limits = HartmannTran.outputs();
    let limits: Vec<Limit> = limits.iter().map(|o| o.budget.limit).collect();
    assert_eq!(limits, [Limit::Relative(1e-4); 2]);
}

#[test]
fn lines_that_are_drawn_are_lines() {
    for region in regions() {
        for k in 0..200 {
            let p = (region.sample)(&mut Draw::new(1, "atlas", region.name, k));
            assert!(physical(&p), "{}: {p:?}", region.name);
            assert!(region.name != "rautian" || simple(&p));
        }
    }
}

#[test]
fn the_reference_is_of_the_profile() {
    let p = [0.01, 0.02, 0.002, 0.001, -0.0005, 0.004, 0.25, 0.03];
    let exact = p.map(|x| Rational::from_f64(x).unwrap());
    let ReferenceAnswer::Expected(expected, _) = HartmannTran.reference(&exact, 128) else {
        panic!("a value is due");
    };
    let Expected::Number(re) = &expected[0] else {
        panic!("a number is due");
    };
    let got = (mechaudit_atlas::PROFILES[0].value)(&line(&p)).re;
    let error = (re.mid().to_f64() - got).abs() / got;
    assert!(error < 1e-5, "{error:e}");
}

/// Each parameter just inside what is called a line, and just outside.
#[test]
fn what_is_no_line() {
    let inside = [0.01, 0.02, 0.002, 0.001, -0.0005, 0.004, 0.25, 0.03];
    assert!(physical(&inside));
    for (k, good, bad) in [
        (0, 1e-4, 0.9e-4),
        (0, 1.0, 1.1),
        (2, 0.006, 0.0061),
        (2, 0.0, -1e-9),
        (3, -0.006, -0.0061),
        (3, 0.006, 0.0061),
        (4, -0.002, -0.0021),
        (4, 0.002, 0.0021),
        (5, 0.02, 0.021),
        (5, 0.0, -1e-9),
        (6, 0.9, 0.91),
        (6, 0.0, -1e-9),
        (7, -300.0, -301.0),
        (7, 300.0, 301.0),
    ] {
        for (value, due) in [(good, true), (bad, false), (f64::NAN, false)] {
            let mut p = inside;
            p[k] = value;
            assert_eq!(physical(&p), due, "parameter {k} = {value}");
        }
    }
    let of_ratio = |ratio: f64| physical(&[0.01, 0.01 * ratio, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    for (ratio, due) in [
        (1.01e-5, true),
        (0.99e-5, false),
        (999.0, true),
        (1001.0, false),
    ] {
        assert_eq!(of_ratio(ratio), due, "{ratio}");
    }
}

/// Codes of simple profiles are not asked for others.
#[test]
fn shifts_and_correlation_are_not_simple() {
    let plain = [0.01, 0.02, 0.002, 0.0, 0.0, 0.004, 0.0, 0.03];
    assert!(simple(&plain));
    for k in [3, 4, 6] {
        let mut p = plain;
        p[k] = -1e-3;
        assert!(!simple(&p), "parameter {k}");
    }
}

/// Widths and distances from the centre are drawn to the ends of their ranges.
#[test]
fn any_line_is_drawn() {
    let drawn = |k: u64| {
        let p = any(&mut Draw::new(1, "atlas", "lines", k));
        [p[0], p[1] / p[0], p[7].abs() / (p[0] + p[1])]
    };
    let all: Vec<[f64; 3]> = (0..8000).map(drawn).collect();
    let range = |part: usize| {
        let values = all.iter().map(|p| p[part]);
        let least = values.clone().fold(f64::INFINITY, f64::min);
        [least, values.fold(0.0, f64::max)]
    };
    for (part, due) in [(0, [1e-3, 0.1]), (1, [1e-5, 1e3])] {
        let [least, most] = range(part).map(|x| x * (1.0 + 1e-12));
        assert!((due[0]..1.02 * due[0]).contains(&least), "{part}: {least}");
        assert!(
            (0.98 * due[1]..1.001 * due[1]).contains(&most),
            "{part}: {most}"
        );
    }
    let within = |a: f64, b: f64| all.iter().filter(|p| (a..b).contains(&p[2])).count();
    // 0.7 of them up to 8 widths, evenly.
    assert!((630..770).contains(&within(0.0, 1.0)) && (2650..2950).contains(&within(0.0, 4.0)));
    assert!((5450..5750).contains(&within(0.0, 8.0)));
    assert!(within(8.0, 8.5) > 8 && within(9e3, 1.0001e4) > 8);
}

#[test]
fn a_simple_line_is_any_line_without_shifts_and_correlation() {
    for k in 0..50 {
        let draw = || Draw::new(1, "atlas", "lines", k);
        let mut due = any(&mut draw());
        (due[3], due[4], due[6]) = (0.0, 0.0, 0.0);
        assert_eq!(any_simple(&mut draw()), due);
    }
}

#[test]
fn parameters_stand_in_the_order_of_their_names() {
    let p = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    let line = line(&p);
    assert_eq!(
        (line.doppler, line.widths, line.shifts),
        (1.0, [2.0, 3.0], [4.0, 5.0])
    );
    assert_eq!(
        (line.narrowing, line.correlation, line.detuning),
        (6.0, 7.0, 8.0)
    );
    let names = HartmannTran.inputs().into_iter().map(|i| i.name);
    assert_eq!(names.collect::<Vec<_>>(), NAMES);
}
