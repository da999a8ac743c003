//! Tests of four-bar linkages and slider-cranks: what their files say, ranges, dead positions, rows
//! and certified digits.

use super::*;
use crate::machine::Linkage;

fn read(text: &str) -> Dyad {
    match Linkage::read(&Source::toml(text)).unwrap() {
        Linkage::Dyad(dyad) => *dyad,
        _ => unreachable!("a dyad"),
    }
}

fn four_bar_of([crank, coupler, rocker, frame]: [f64; 4], more: &str) -> Dyad {
    read(&format!(
        "type = \"four-bar\"\n{more}\n[geometry]\ncrank = \"{crank} m\"\ncoupler = \"{coupler} m\"\n\
         rocker = \"{rocker} m\"\nframe = \"{frame} m\"\n"
    ))
}

fn slider_of([crank, rod, offset]: [f64; 3], direction: &str, more: &str) -> Dyad {
    read(&format!(
        "type = \"slider-crank\"\n{more}\n[geometry]\ncrank = \"{crank} m\"\nrod = \"{rod} m\"\n\
         offset = \"{offset} m\"\ndirection = \"{direction}\"\n"
    ))
}

#[test]
fn rational_cosines_are_those_of_niven() {
    for k in -720..=720i32 {
        let x = f64::from(k).to_radians().cos();
        let near = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|r| (x - r).abs() < 1e-9);
        let found = cosine(&Rational::from(k));
        assert_eq!(found.is_some(), near.contains(&true), "{k}");
        if let Some(c) = found {
            assert!((c.to_f64() - x).abs() < 1e-9, "{k}");
        }
    }
    assert_eq!(cosine(&Rational::from((121, 2))), None);
    assert_eq!(cosine(&Rational::from((60, 7))), None);
}

#[test]
fn any_one_body_is_bodies() {
    let link = "{ mass = \"1 kg\", inertia = \"1 kg m^2\", radius = \"1 cm\" }";
    for (body, due) in [
        (String::new(), None),
        (format!("crank = {link}"), Some(0.0)),
        (format!("rod = {link}"), Some(0.0)),
        ("slider = { mass = \"2 kg\" }".into(), Some(2.0)),
    ] {
        let text = format!(
            "type = \"slider-crank\"\n[geometry]\ncrank = \"2 m\"\nrod = \"5 m\"\n[bodies]\n{body}\n"
        );
        let dyad = slider_crank(&Source::toml(text)).unwrap();
        let Shape::SliderCrank { bodies, .. } = dyad.shape else {
            unreachable!("a slider-crank");
        };
        assert_eq!(bodies.map(|b| b.1.kg()), due, "{body}");
    }
}

#[test]
fn descriptions_are_read() {
    let bar = four_bar_of([1.0, 3.0, 2.5, 3.5], "");
    let Shape::FourBar {
        exact,
        bodies,
        solver,
    } = &bar.shape
    else {
        panic!("a four-bar linkage");
    };
    let due = [(1, 1), (3, 1), (5, 2), (7, 2)].map(Rational::from);
    assert_eq!(exact, &due);
    let lengths = [
        solver.crank(),
        solver.coupler(),
        solver.rocker(),
        solver.frame(),
    ];
    assert_eq!(lengths.map(|l| l.m()), [1.0, 3.0, 2.5, 3.5]);
    assert!(bodies.is_none() && !bar.shape.has_bodies());
    assert_eq!(
        (bar.shape.type_name(), bar.shape.angles()),
        ("four-bar", &[0, 1, 6][..])
    );
    assert_eq!(bar.gravity.m_per_s2(), 9.80665);
    assert!(bar.name.is_none() && bar.crank.is_none() && bar.start.is_none());
    assert_eq!(bar.assembly, Assembly::Positive);
    let more = "name = \"press\"\ngravity = \"2 m/s^2\"\ncrank_speed = \"3 rad/s\"\n\
                start = { phi1 = \"12.5 deg\", assembly = \"negative\" }";
    let press = slider_of([1.0, 3.0, -0.5], "30 deg", more);
    let Shape::SliderCrank {
        exact,
        direction,
        bodies,
        solver,
    } = &press.shape
    else {
        panic!("a slider-crank");
    };
    assert_eq!(exact, &[(1, 1), (3, 1), (-1, 2)].map(Rational::from));
    assert_eq!(
        (solver.crank().m(), solver.rod().m(), solver.offset().m()),
        (1.0, 3.0, -0.5)
    );
    assert_eq!(solver.direction().rad(), 30f64.to_radians());
    assert!(direction.degrees && direction.value == 30 && bodies.is_none());
    assert_eq!(
        (press.shape.type_name(), press.shape.angles()),
        ("slider-crank", &[1, 6][..])
    );
    assert_eq!(
        (press.name.as_deref(), press.gravity.m_per_s2()),
        (Some("press"), 2.0)
    );
    assert_eq!(press.start, Some(Rational::from((25, 2))));
    assert_eq!(press.assembly, Assembly::Negative);
    let crank = press.crank.unwrap();
    assert_eq!((crank.omega.to_f64(), crank.epsilon.to_f64()), (3.0, 0.0));
    let plain = read(
        "type = \"slider-crank\"\n[geometry]\ncrank = \"1 m\"\nrod = \"3 m\"\n[start]\nphi1 = \"1 rad\"\n",
    );
    let Shape::SliderCrank {
        exact, direction, ..
    } = &plain.shape
    else {
        panic!("a slider-crank");
    };
    assert_eq!((exact[2].to_f64(), direction.to_f64()), (0.0, 0.0));
    assert_eq!(plain.start, Rational::from_f64(1f64.to_degrees()));
    assert_eq!(plain.assembly, Assembly::Positive);
    for (text, part) in [
        (
            "crank_acceleration = \"1 rad/s^2\"",
            "crank_acceleration needs crank_speed",
        ),
        (
            "start = { assembly = \"positiv\" }",
            "(did you mean \"positive\"?)",
        ),
    ] {
        let text = format!(
            "type = \"four-bar\"\n{text}\n[geometry]\ncrank = \"1 m\"\ncoupler = \"1 m\"\nrocker = \"1 m\"\nframe = \"1 m\"\n"
        );
        let refused = Linkage::read(&Source::toml(text))
            .err()
            .unwrap()
            .to_string();
        assert!(refused.contains(part), "{refused}");
    }
}

#[test]
fn any_one_link_of_a_four_bar_is_bodies() {
    let link = "{ mass = \"4 kg\", inertia = \"1 kg m^2\", radius = \"1 cm\", angle = \"20 deg\" }";
    for (name, due) in [
        ("", None),
        ("crank", Some(0)),
        ("coupler", Some(1)),
        ("rocker", Some(2)),
    ] {
        let body = if name.is_empty() {
            String::new()
        } else {
            format!("{name} = {link}")
        };
        let dyad = four_bar_of([1.0, 3.0, 2.5, 3.5], &format!("bodies = {{ {body} }}"));
        assert_eq!(dyad.shape.has_bodies(), due.is_some());
        let Shape::FourBar { bodies, .. } = dyad.shape else {
            unreachable!("a four-bar linkage");
        };
        let masses = bodies.map(|b| b.map(|b| b.mass.kg()));
        let due = due.map(|k| [0, 1, 2].map(|j| if j == k { 4.0 } else { 0.0 }));
        assert_eq!(masses, due, "{name}");
        for body in bodies.into_iter().flatten().filter(|b| b.mass.kg() > 0.0) {
            assert_eq!(
                (body.radius.m(), body.angle.rad()),
                (0.01, 20f64.to_radians())
            );
        }
    }
}

/// The crank's angle from the guide: exactly in degrees where the guide's is, and enclosed.
#[test]
fn crank_angles_are_measured_from_the_guide() {
    let near = |shape: &Shape, degrees: (i32, i32), due: f64| {
        let found = shape.relative(&Rational::from(degrees), 128);
        assert!((found.to_f64() - due).abs() < 1e-15, "{degrees:?}");
    };
    let bar = four_bar_of([1.0, 3.0, 2.5, 3.5], "").shape;
    near(&bar, (75, 2), 37.5f64.to_radians());
    for (direction, due) in [
        ("10 deg", 10f64.to_radians()),
        ("0 rad", 0.0),
        ("0.25 rad", 0.25),
    ] {
        let shape = slider_of([1.0, 3.0, 0.5], direction, "").shape;
        near(&shape, (75, 2), 37.5f64.to_radians() - due);
    }
    let rational = |direction: &str, degrees: i32| {
        let shape = slider_of([1.0, 3.0, 0.5], direction, "").shape;
        let (cos, sin) = shape.rational_cos_sin(&degrees.into());
        (cos.map(|q| q.to_f64()), sin.map(|q| q.to_f64()))
    };
    assert_eq!(rational("10 deg", 40), (None, Some(0.5)));
    assert_eq!(rational("10 deg", 70), (Some(0.5), None));
    assert_eq!(rational("10 deg", 100), (Some(0.0), Some(1.0)));
    assert_eq!(rational("-10 deg", 260), (Some(0.0), Some(-1.0)));
    assert_eq!(rational("0 rad", 180), (Some(-1.0), Some(0.0)));
    assert_eq!(rational("0.25 rad", 180), (None, None));
}

/// At multiples of 30 or 60 degrees the condition is one of fractions: the dyad spans between the
/// difference and the sum of its links, or the rod reaches the guide; at the ends it is singular.
#[test]
fn what_is_exactly_beyond_or_singular_is_told() {
    let bar = |l: [f64; 4]| four_bar_of(l, "").shape;
    let slider = |l: [f64; 3], direction: &str| slider_of(l, direction, "").shape;
    let [within, singular, beyond] = [None, Some(Reached::Singular), Some(Reached::Beyond)];
    for (shape, degrees, due) in [
        // B is 1 m from the rocker's pivot at 60 deg, √7 m at 120 deg.
        (bar([1.0, 0.5, 0.5, 1.0]), 60, singular),
        (bar([1.0, 0.5, 0.625, 1.0]), 60, within),
        (bar([1.0, 0.5, 0.375, 1.0]), 60, beyond),
        (bar([1.0, 2.0, 1.0, 1.0]), 60, singular),
        (bar([1.0, 1.75, 1.0, 1.0]), 60, within),
        (bar([1.0, 2.25, 1.0, 1.0]), 60, beyond),
        (bar([1.0, 0.5, 0.5, 1.0]), 61, within),
        (bar([2.0, 3.0, 3.0, 3.0]), 180, within),
        (bar([2.0, 3.0, 2.0, 3.0]), 180, singular),
        (bar([2.0, 3.0, 2.0, 3.0]), 0, singular),
        (bar([2.0, 3.0, 2.0, 3.0]), 90, within),
        (bar([3.0, 2.0, 2.0, 2.0]), 120, beyond),
        (bar([1.0, 2.0, 4.0, 5.0]), 180, singular),
        (slider([2.0, 1.0, 0.0], "0 deg"), 30, singular),
        (slider([2.0, 1.0, 0.0], "0 deg"), 90, beyond),
        (slider([2.0, 1.0, 0.0], "0 deg"), 210, singular),
        (slider([2.0, 1.0, 0.0], "0 deg"), 180, within),
        (slider([2.0, 1.0, 0.0], "0 deg"), 40, within),
        (slider([2.0, 1.0, 0.0], "10 deg"), 40, singular),
        (slider([2.0, 1.0, 0.0], "0.5 rad"), 30, within),
        (slider([2.0, 1.0, 0.5], "0 deg"), 30, within),
        (slider([2.0, 1.0, 0.5], "0 deg"), 90, beyond),
        (slider([2.0, 1.0, -0.5], "0 deg"), 30, beyond),
    ] {
        let found = shape.reached(&degrees.into());
        assert_eq!(found, due, "{} {degrees}", shape.type_name());
    }
}

fn parts(shape: &Shape) -> Vec<[f64; 2]> {
    match turn(shape) {
        Turn::Parts(parts) => parts,
        Turn::Full { change_points } => vec![[f64::from(u8::from(change_points)); 2]],
    }
}

/// By the law of cosines, and by the sines at which rod and guide are square.
#[test]
fn cranks_turn_as_far_as_the_dyad_reaches() {
    let angle = |[crank, dyad, frame]: [f64; 3]| {
        let cos = (crank * crank + frame * frame - dyad * dyad) / (2.0 * crank * frame);
        cos.acos().to_degrees()
    };
    let sine = |x: f64| x.asin().to_degrees();
    let (full, changes) = (vec![[0.0; 2]], vec![[1.0; 2]]);
    let (most, least) = (angle([3.0, 5.0, 3.0]), angle([3.0, 1.0, 3.0]));
    let within = angle([3.0, 6.0, 3.5]);
    let beyond = angle([2.0, 1.95, 2.0]);
    for (lengths, due) in [
        ([1.0, 3.0, 3.0, 4.0], full.clone()),
        ([1.0, 3.0, 1.0, 3.0], changes.clone()),
        ([3.0, 3.0, 3.0, 3.5], vec![[-within, within]]),
        ([2.0, 3.0, 1.05, 2.0], vec![[beyond, 360.0 - beyond]]),
        ([3.0, 2.0, 3.0, 3.0], vec![[least, most], [-most, -least]]),
    ] {
        let found = parts(&four_bar_of(lengths, "").shape);
        assert_eq!(found.len(), due.len(), "{lengths:?}: {found:?}");
        for (x, y) in found.concat().into_iter().zip(due.concat()) {
            assert!((x - y).abs() < 1e-9, "{lengths:?}: {found:?}");
        }
    }
    let l = sine(2.0 / 3.0);
    for (lengths, due) in [
        ([2.0, 5.0, 1.0], full),
        ([2.0, 3.0, 1.0], changes),
        ([3.0, 3.0, 1.0], vec![[-l, 180.0 + l]]),
        ([3.0, 3.0, -1.0], vec![[-180.0 - l, l]]),
        ([3.0, 1.0, 1.0], vec![[0.0, l], [180.0 - l, 180.0]]),
    ] {
        for (direction, by) in [("0 deg", 0.0), ("25 deg", 25.0)] {
            let found = parts(&slider_of(lengths, direction, "").shape);
            assert_eq!(found.len(), due.len(), "{lengths:?}: {found:?}");
            let by = if due[0][0] == due[0][1] { 0.0 } else { by };
            for (x, y) in found.concat().into_iter().zip(due.concat()) {
                assert!((x - y - by).abs() < 1e-9, "{lengths:?}: {found:?}");
            }
        }
    }
}

/// Certified digits are those of floating point in every column, whatever the crank's motion,
/// direction and assembly.
#[test]
fn certified_rows_are_those_of_the_solver() {
    let motions = [
        "",
        "crank_speed = \"3 rad/s\"\ncrank_acceleration = \"-5 rad/s^2\"",
        "crank_speed = \"40 deg/s\"",
    ];
    let mut checked = 0;
    for more in motions {
        for dyad in [
            four_bar_of([10.0, 40.0, 30.0, 35.0], more),
            four_bar_of([30.0, 30.0, 30.0, 35.0], more),
            slider_of([2.0, 5.0, 1.0], "0 deg", more),
            slider_of([2.0, 5.0, -1.0], "25 deg", more),
            slider_of([2.0, 5.0, 0.0], "-0.5 rad", more),
        ] {
            for assembly in ASSEMBLIES {
                for degrees in [(0, 1), (30, 1), (50, 1), (-151, 2), (415, 1)] {
                    let at = Rational::from(degrees);
                    let floats = floating(&dyad, &at, assembly).unwrap();
                    let (values, floats) = match (certified(&dyad, &at, assembly, 15), floats) {
                        (Proved::Values(values), Some(floats)) => (values, floats),
                        (Proved::Unreachable, None) => continue,
                        (Proved::Singular(values), Some(floats)) => {
                            assert!(values[2].is_none() && floats[2].is_nan());
                            continue;
                        }
                        _ => panic!("reached by one alone"),
                    };
                    for (k, (text, x)) in values.iter().zip(floats).enumerate() {
                        let text = text
                            .as_deref()
                            .unwrap_or_else(|| panic!("digits of value {k} at {at}"));
                        let digits: f64 = text.parse().unwrap();
                        assert!(
                            (digits - x).abs() < 1e-9 * (1.0 + x.abs()),
                            "{k} at {at}: {text} {x}"
                        );
                        checked += 1;
                    }
                }
            }
        }
    }
    assert!(checked > 900, "{checked}");
}

/// Rates are derivatives by the crank's angle with its speed and acceleration.
#[test]
fn rates_follow_from_the_cranks_motion() {
    let (w, e) = (3.0, -5.0);
    let more = "crank_speed = \"3 rad/s\"\ncrank_acceleration = \"-5 rad/s^2\"";
    let at = Rational::from(50);
    for [still, moved] in [
        ["", more].map(|m| four_bar_of([10.0, 40.0, 30.0, 35.0], m)),
        ["", more].map(|m| slider_of([2.0, 5.0, 1.0], "10 deg", m)),
    ] {
        let [x, y] =
            [&still, &moved].map(|d| floating(d, &at, Assembly::Positive).unwrap().unwrap());
        for k in [0, 1, 6, 7] {
            assert_eq!(x[k], y[k]);
        }
        for k in [2, 3] {
            assert!((y[k] - x[k] * w).abs() < 1e-12);
            assert!((y[k + 2] - x[k + 2] * w * w - x[k] * e).abs() < 1e-12);
        }
    }
}

#[test]
fn values_out_of_range_are_refused_with_their_column() {
    let fast = "crank_speed = \"1e200 rad/s\"";
    for (dyad, column) in [
        (
            four_bar_of([10.0, 40.0, 30.0, 35.0], fast),
            "epsilon2_rad_per_s2",
        ),
        (
            slider_of([2.0, 5.0, 1.0], "0 deg", fast),
            "slider_acceleration_m_per_s2",
        ),
    ] {
        let refused = floating(&dyad, &50.into(), Assembly::Positive);
        let column = column.to_string();
        assert_eq!(
            refused,
            Err(RowError::Range {
                column,
                degrees: 50.0
            })
        );
    }
    assert_eq!(ASSEMBLIES.map(number), [0, 1]);
}

/// With the crank at 30 deg the rod is all but in line with the guide, lower by 1e-k m: sixteen
/// times the first bits tell 1e-600 from zero, and not 1e-700.
#[test]
fn digits_are_looked_for_at_sixteen_times_the_first_bits() {
    for (k, proved) in [(20, true), (100, true), (600, true), (700, false)] {
        let offset = format!("0.5{}1", "0".repeat(k - 2));
        let text = format!(
            "type = \"slider-crank\"\n[geometry]\ncrank = \"1 m\"\nrod = \"2 m\"\noffset = \"{offset} m\"\n"
        );
        let Proved::Values(values) = certified(&read(&text), &30.into(), Assembly::Positive, 10)
        else {
            panic!("within reach");
        };
        assert_eq!(values[1].is_some(), proved, "{k}");
        if let (Some(text), true) = (&values[1], k < 300) {
            let due = (0.5 * 10f64.powi(-(k as i32))).to_degrees();
            assert!(
                (text.parse::<f64>().unwrap() / due - 1.0).abs() < 1e-9,
                "{text} {due}"
            );
        }
        assert!([0, 2, 3, 4, 6, 7].iter().all(|i| values[*i].is_some()));
    }
}

/// Digits of what is exactly zero cannot be proved from an enclosure: the rod stands still where
/// the crank is square to the guide, and lies along the guide where its ends are as high.
#[test]
fn values_that_are_zero_are_zero() {
    let row = |dyad: &Dyad, degrees: i32, assembly: Assembly| -> Vec<bool> {
        let Proved::Values(values) = certified(dyad, &degrees.into(), assembly, 10) else {
            panic!("within reach");
        };
        values.iter().map(|v| v.as_deref() == Some("0")).collect()
    };
    let zeros = |found: Vec<bool>| -> Vec<usize> { (0..8).filter(|k| found[*k]).collect() };
    let (ahead, behind) = (Assembly::Positive, Assembly::Negative);
    let central = slider_of([2.0, 5.0, 0.0], "0 deg", "");
    let high = slider_of([2.0, 5.0, 1.0], "0 deg", "");
    let turned = slider_of([2.0, 5.0, 1.0], "10 deg", "");
    for (dyad, degrees, assembly, due) in [
        (&central, 0, ahead, &[1, 2, 5][..]),
        (&central, 180, ahead, &[1, 2, 5]),
        (&central, 0, behind, &[2, 5]),
        (&central, 90, ahead, &[3]),
        (&central, 270, behind, &[3]),
        (&central, 45, ahead, &[]),
        (&high, 30, ahead, &[1]),
        (&high, 150, ahead, &[1]),
        (&high, 30, behind, &[]),
        (&high, 0, ahead, &[]),
        (&high, 90, ahead, &[3]),
        (&turned, 40, ahead, &[]),
        (&turned, 100, behind, &[3]),
    ] {
        assert_eq!(zeros(row(dyad, degrees, assembly)), due, "{degrees}");
    }
}

#[test]
fn paths_go_over_a_turn_or_the_range() {
    let bar = four_bar_of([1.0, 3.0, 3.0, 4.0], "start = { phi1 = \"30 deg\" }");
    assert_eq!(range(&bar), ([30.0, 390.0], true));
    let plain = four_bar_of([1.0, 3.0, 3.0, 4.0], "");
    assert_eq!(range(&plain), ([0.0, 360.0], true));
    let (all, turn) = path(&bar, Assembly::Negative, 4);
    let at: Vec<f64> = all.iter().map(|p| p.crank_deg).collect();
    assert_eq!((at, turn), (vec![30.0, 120.0, 210.0, 300.0, 390.0], true));
    for p in &all {
        assert_eq!(Some(*p), position(&bar, Assembly::Negative, p.crank_deg));
    }
    let rocker = four_bar_of([3.0, 3.0, 3.0, 3.5], "");
    let ([low, high], turn) = range(&rocker);
    let (all, whole) = path(&rocker, Assembly::Positive, 10);
    assert!(!turn && !whole && low == -high);
    // The ends may be beyond reach by rounding.
    assert!(
        all.len() >= 9
            && all
                .iter()
                .all(|p| low <= p.crank_deg && p.crank_deg <= high)
    );
    assert_eq!(position(&rocker, Assembly::Positive, 180.0), None);
}
