//! Tests of `cam_oscillator`.

use super::*;

fn read(law: &str) -> Result<CamOscillator, Refusal> {
    let text = include_str!("../../../examples/chirp-run-up.toml");
    let law = text.replacen("law = \"modified-sine\"", &format!("law = {law}"), 1);
    assert_ne!(law, text);
    CamOscillator::read(&Source::toml(law), Some(20))
}

#[test]
fn a_chart_has_the_points_asked_for() {
    let text = include_str!("../../../examples/chirp-chart.toml");
    let machine = CamOscillator::read(&Source::toml(text), Some(20)).unwrap();
    let file: toml::Table = text.parse().unwrap();
    let of = |key| file["chart"][key].as_float().unwrap();
    let (from, to, step) = (of("from"), of("to"), of("step"));
    let grid = machine.chart.unwrap().grid;
    assert_eq!(grid.len(), ((to - from) / step).round() as usize + 1);
    for (k, xi) in grid.iter().enumerate() {
        assert!((xi - (from + k as f64 * step)).abs() < 1e-12, "{k}");
    }
}

/// A table is met at its knots, at rest at its ends.
#[test]
fn a_law_by_a_table() {
    let machine = read("{ table = [[0, 0], [0.25, 0.125], [0.5, 0.625], [1, 1]] }").unwrap();
    assert_eq!(machine.law, "table");
    let law = &machine.drive.cycle.rise().law;
    for (x, y) in [(0.0, 0.0), (0.25, 0.125), (0.5, 0.625), (1.0, 1.0)] {
        let motion = law.motion(x).unwrap();
        assert!((motion.displacement - y).abs() < 1e-15, "{x}");
        assert!(x.fract() != 0.0 || motion.velocity.abs() < 1e-14, "{x}");
    }
    let two = "{ table = [[0, 0], [1, 1]], scca = [0.2, 0.5, 0.3] }";
    let refused = read(two).err().unwrap().to_string();
    assert!(refused.contains("exactly one of"), "{refused}");
}

/// As many rows as there are steps in the duration within rounding, and at most ten billion after
/// the first.
#[test]
fn a_run_ends_with_a_row() {
    let read = |duration: f64, step: f64| {
        let mut file: toml::Table = include_str!("../../../examples/chirp-run-up.toml")
            .parse()
            .unwrap();
        let run = file["run"].as_table_mut().unwrap();
        for (name, value) in [("duration", duration), ("step", step)] {
            run.insert(name.into(), format!("{value} s").into());
        }
        CamOscillator::read(&Source::toml(file.to_string()), Some(20))
    };
    for (duration, step, rows) in [
        (0.3, 0.1, 4),
        (0.299, 0.1, 3),
        (1.0 - 7e-13, 0.1, 11),
        (1.0 - 2e-12, 0.1, 10),
        (1e10, 1.0, 10_000_000_001),
    ] {
        let run = read(duration, step).unwrap().run.unwrap();
        assert_eq!(run.rows, rows, "{duration} {step}");
    }
    let refused = read(1e10 + 1.0, 1.0).err().unwrap().to_string();
    assert!(refused.contains("at most 1e10 rows"), "{refused}");
}

/// The last point is there if the steps end at it within rounding.
#[test]
fn charts_have_points_and_laws() {
    let read = |changes: &[(&str, &str)]| {
        let mut file: toml::Table = include_str!("../../../examples/chirp-chart.toml")
            .parse()
            .unwrap();
        let chart = file["chart"].as_table_mut().unwrap();
        for (name, value) in changes {
            let value: toml::Table = format!("x = {value}").parse().unwrap();
            chart.insert((*name).into(), value["x"].clone());
        }
        CamOscillator::read(&Source::toml(file.to_string()), Some(20))
    };
    for (changes, points, laws) in [
        ([("to", "2.3"), ("laws", "[\"cycloidal\"]")], 4, 1),
        ([("to", "2.29"), ("laws", "[\"cycloidal\"]")], 3, 1),
        (
            [("to", "2.0"), ("laws", "[\"cycloidal\", \"3-4-5\"]")],
            1,
            2,
        ),
    ] {
        let all = [&[("from", "2.0"), ("step", "0.1")], &changes[..]].concat();
        let chart = read(&all).unwrap().chart.unwrap();
        assert_eq!((chart.grid.len(), chart.drives.len()), (points, laws));
    }
    for (changes, part) in [
        (&[("laws", "[]")][..], "chart.laws names no law"),
        (&[("laws", "[\"none\"]")], "none"),
        (&[("from", "0.0")], "positive numbers in ascending order"),
        (&[("from", "3.0"), ("to", "2.9")], "in ascending order"),
        (&[("to", "inf")], "in ascending order"),
        (&[("step", "0.0")], "at most 1e5 points"),
        (&[("step", "1e-9")], "at most 1e5 points"),
    ] {
        let refused = read(changes).err().expect(part).to_string();
        assert!(refused.contains(part), "{refused}");
    }
}

/// At the slowest point of a chart the resonance is at its ξ-th harmonic, of the rise or of the
/// turn.
#[test]
fn harmonics_reach_beyond_the_resonance() {
    let harmonics = |period: Option<&str>| {
        let mut file: toml::Table = include_str!("../../../examples/chirp-chart.toml")
            .parse()
            .unwrap();
        let cam = file["cam"].as_table_mut().unwrap();
        cam.insert("law".into(), "cycloidal".into());
        let chart = file["chart"].as_table_mut().unwrap();
        chart.remove("laws");
        match period {
            Some(period) => _ = chart.insert("period".into(), period.into()),
            None => _ = file.remove("chart"),
        }
        let source = Source::toml(file.to_string());
        CamOscillator::read(&source, None).unwrap().harmonics
    };
    // To ξ = 14, where the rise is a third of a turn.
    let own = harmonics(None);
    assert!(own < 84, "{own}");
    assert_eq!(harmonics(Some("rise")), 84);
    assert_eq!(harmonics(Some("turn")), own.max(28));
}

/// The description of the run-up with other values; a value without text is taken out.
fn changed(changes: &[(&str, &str, &str)]) -> Result<CamOscillator, Refusal> {
    let text = include_str!("../../../examples/chirp-run-up.toml");
    let mut file: toml::Table = text.parse().unwrap();
    for (section, key, value) in changes {
        let empty = || toml::Value::Table(toml::Table::new());
        let table = match *section {
            "" => &mut file,
            name => {
                let table = file.entry(name).or_insert_with(empty);
                table.as_table_mut().unwrap()
            }
        };
        if value.is_empty() {
            table.remove(*key);
        } else {
            let value: toml::Table = format!("x = {value}").parse().unwrap();
            table.insert((*key).into(), value["x"].clone());
        }
    }
    CamOscillator::read(&Source::toml(file.to_string()), None)
}

fn refusal(changes: &[(&str, &str, &str)]) -> String {
    changed(changes).err().expect("refused").to_string()
}

const FEW: (&str, &str, &str) = ("", "harmonics", "5");

#[test]
fn oscillator_and_shaft_are_read() {
    let machine = changed(&[FEW]).unwrap();
    assert_eq!(machine.name, "run-up of a cam follower");
    assert_eq!((machine.unit, &*machine.law), ("m", "modified-sine"));
    let drive = &machine.drive;
    assert_eq!((drive.oscillator.w(), drive.oscillator.n()), (80.0, 1.2));
    assert_eq!((drive.chirp.omega0, drive.chirp.eps), (0.0, 2.5));
    assert_eq!(drive.cycle.lift(), 0.02);
    let turns = |degrees: f64| degrees / 360.0;
    let cycle = &drive.cycle;
    let phases = [
        cycle.rise().turns,
        cycle.high_dwell(),
        cycle.fall().unwrap().turns,
    ];
    assert_eq!(phases, [100.0, 80.0, 90.0].map(turns));
    assert_eq!(cycle.start(), 0.0);
    assert!(machine.initial.is_none() && machine.chart.is_none());
    assert!(machine.charts().unwrap().is_empty());
    let other = changed(&[
        FEW,
        ("", "name", ""),
        ("oscillator", "damping", ""),
        ("oscillator", "damping_ratio", "0.25"),
        ("cam", "lift", "\"20 deg\""),
        ("cam", "start", "\"90 deg\""),
        ("speed", "start", "\"3 rad/s\""),
    ])
    .unwrap();
    assert_eq!(other.name, "cam-driven oscillator");
    assert_eq!(other.drive.oscillator.n(), 20.0);
    assert_eq!(
        (other.unit, other.drive.cycle.lift()),
        ("rad", 20f64.to_radians())
    );
    assert_eq!(other.drive.cycle.start(), 0.25);
    assert_eq!(other.drive.chirp.omega0, 3.0);
}

#[test]
fn damping_is_given_once() {
    let both = ("oscillator", "damping_ratio", "0.1");
    let due = "oscillator.damping and oscillator.damping_ratio exclude each other";
    assert!(refusal(&[FEW, both]).ends_with(due));
    let due = "oscillator.damping is missing, or damping_ratio";
    assert!(refusal(&[FEW, ("oscillator", "damping", "")]).ends_with(due));
}

#[test]
fn laws_are_named() {
    for (law, label) in [
        ("\"cycloidal\"", "cycloidal"),
        ("{ name = \"3-4-5\" }", "3-4-5"),
        ("{ name = \"3-4-5\", acceleration_fraction = 0.4 }", "3-4-5"),
        ("{ scca = [0.25, 0.5, 0.25] }", "scca 0.25 0.5 0.25"),
        ("{ polynomial = [0, 0, 3, -2] }", "polynomial"),
        ("{ table = [[0, 0], [0.5, 0.5], [1, 1]] }", "table"),
    ] {
        let machine = changed(&[FEW, ("cam", "law", law)]).unwrap();
        assert_eq!(machine.law, label);
        // The return is by the same law unless it has its own.
        let cycle = &machine.drive.cycle;
        let at = |law: &MotionLaw| law.motion(0.3).unwrap().displacement;
        let rise = at(&cycle.rise().law);
        assert_eq!(at(&cycle.fall().unwrap().law), rise, "{law}");
        let own = changed(&[
            FEW,
            ("cam", "law", law),
            ("cam", "return_law", "{ polynomial = [0, 1] }"),
        ])
        .unwrap();
        let cycle = &own.drive.cycle;
        assert_eq!(at(&cycle.rise().law), rise, "{law}");
        assert!((at(&cycle.fall().unwrap().law) - 0.3).abs() < 1e-15);
    }
    let scca = changed(&[FEW, ("cam", "law", "{ scca = [0.2, 0.5, 0.3] }")]).unwrap();
    let due = MotionLaw::scca(0.2, 0.5, 0.3).unwrap().motion(0.3).unwrap();
    assert_eq!(scca.drive.cycle.rise().law.motion(0.3).unwrap(), due);
    for (key, law, due) in [
        ("law", "\"cyclodal\"", "cam.law: "),
        ("return_law", "{ name = \"cyclodal\" }", "cam.return_law: "),
    ] {
        let refused = refusal(&[FEW, ("cam", key, law)]);
        assert!(refused.contains(due) && refused.contains("(did you mean \"cycloidal\"?)"));
    }
    for (law, part) in [
        ("{ acceleration_fraction = 0.4 }", "cam.law: exactly one of"),
        ("{ scca = [0.2, 0.2, 0.2] }", "cam.law: b + c + d"),
        (
            "{ table = [[0, 0], [1, 1]], acceleration_fraction = 0.4 }",
            "cam.law: ",
        ),
        ("7", "the name of a law, or a section"),
    ] {
        let refused = refusal(&[FEW, ("cam", "law", law)]);
        assert!(refused.contains(part), "{refused}");
    }
}

/// Where one of the two is given the other is zero, in the follower's own unit.
#[test]
fn the_start_is_as_the_lift() {
    let start = |lift: &str, y: &str, v: &str| {
        changed(&[
            FEW,
            ("cam", "lift", lift),
            ("initial", "displacement", y),
            ("initial", "velocity", v),
        ])
    };
    let (slider, rocker) = ("\"20 mm\"", "\"20 deg\"");
    for (lift, y, v, due) in [
        (slider, "", "", None),
        (slider, "\"5 mm\"", "", Some((0.005, 0.0))),
        (slider, "", "\"-3 m/s\"", Some((0.0, -3.0))),
        (slider, "\"5 mm\"", "\"2 cm/s\"", Some((0.005, 0.02))),
        (rocker, "\"0.5 rad\"", "\"-3 rad/s\"", Some((0.5, -3.0))),
    ] {
        let machine = start(lift, y, v).unwrap();
        let found = machine.initial.map(|i| (i.displacement, i.velocity));
        assert_eq!(found, due, "{y} {v}");
        // The response begins with the values asked for.
        if let Some((y, v)) = due {
            let state = machine
                .response(&machine.drive)
                .unwrap()
                .state(0.0)
                .unwrap();
            assert!((state.displacement - y).abs() < 1e-12 && (state.velocity - v).abs() < 1e-11);
        }
    }
    for (lift, y, v, due) in [
        (
            slider,
            "\"5 deg\"",
            "",
            "initial.displacement must be a length",
        ),
        (
            rocker,
            "\"5 mm\"",
            "",
            "initial.displacement must be an angle",
        ),
        (
            slider,
            "",
            "\"1 rad/s\"",
            "initial.velocity must be a velocity",
        ),
        (
            rocker,
            "",
            "\"1 m/s\"",
            "initial.velocity must be an angular velocity",
        ),
    ] {
        let refused = start(lift, y, v).err().unwrap().to_string();
        assert!(
            refused.ends_with(&format!("{due}, as cam.lift is given")),
            "{refused}"
        );
    }
    let due = "cam.lift = \"1 kg\" is not a length; write it for instance in cm (or an angle)";
    assert!(refusal(&[FEW, ("cam", "lift", "\"1 kg\"")]).ends_with(due));
}

/// A thousand steps if nobody says how long they are.
#[test]
fn runs_have_steps() {
    let run = |duration: &str, step: &str| {
        changed(&[FEW, ("run", "duration", duration), ("run", "step", step)])
    };
    for (duration, step, due) in [
        ("\"12 s\"", "\"5 ms\"", (12.0, 0.005, 2401)),
        ("\"12 s\"", "", (12.0, 0.012, 1001)),
        ("\"0.5 s\"", "\"1 s\"", (0.5, 1.0, 1)),
    ] {
        let run = run(duration, step).unwrap().run.unwrap();
        assert_eq!((run.duration, run.step, run.rows), due);
    }
    let none = changed(&[FEW, ("", "run", "")]).unwrap();
    assert!(none.run.is_none());
    for (duration, step, due) in [
        ("\"0 s\"", "\"1 s\"", "run.duration = 0 s must be positive"),
        ("\"0 s\"", "", "run.duration = 0 s must be positive"),
        (
            "\"-1 s\"",
            "\"1 s\"",
            "run.duration = -1 s must be positive",
        ),
        (
            "\"1 s\"",
            "\"0 s\"",
            "run.step = 0 s must be positive and give at most 1e10 rows",
        ),
        (
            "\"1 s\"",
            "\"-1 s\"",
            "run.step = -1 s must be positive and give at most 1e10 rows",
        ),
    ] {
        let refused = run(duration, step).err().unwrap().to_string();
        assert!(refused.ends_with(due), "{refused}");
    }
}

/// Charts of up to a hundred thousand steps; the last point is there if the steps end at it within
/// 1e-12 of their number.
#[test]
fn charts_have_bounds() {
    let points = |from: &str, to: &str, step: &str| {
        let chart = format!("{{ from = {from}, to = {to}, step = {step}, period = \"turn\" }}");
        let down = [
            FEW,
            ("speed", "start", "\"1000 rad/s\""),
            ("speed", "acceleration", "\"-1 rad/s^2\""),
            ("", "chart", &chart),
        ];
        changed(&down).map(|m| {
            let chart = m.chart.unwrap();
            assert_eq!(
                (chart.drives.len(), &*chart.drives[0].0),
                (1, "modified-sine")
            );
            chart.grid.len()
        })
    };
    for (from, to, step, due) in [
        ("1.0", "2.0", "0.1", 11),
        ("1.0", "1.9999999999993", "0.1", 11),
        ("1.0", "1.9999999999985", "0.1", 10),
        ("0.5", "0.5", "0.25", 1),
        ("1.0", "100001.0", "1.0", 100_001),
    ] {
        assert_eq!(points(from, to, step).unwrap(), due, "{from} {to} {step}");
    }
    let step = "must be positive and give at most 1e5 points";
    let order = "must be positive numbers in ascending order";
    for (from, to, by, due) in [
        ("1.0", "100002.0", "1.0", step),
        ("1.0", "2.0", "-0.1", step),
        ("1.0", "1.0", "0.0", step),
        ("-1.0", "2.0", "0.1", order),
        ("nan", "2.0", "0.1", order),
    ] {
        let refused = points(from, to, by).err().unwrap().to_string();
        assert!(refused.ends_with(due), "{refused}");
    }
}

/// The period is that of the rise unless the file says the turn.
#[test]
fn charts_have_a_period() {
    let chart = |period: &str| {
        let chart = format!("{{ from = 2.0, to = 3.0, step = 0.5{period} }}");
        let down = [
            FEW,
            ("speed", "start", "\"1000 rad/s\""),
            ("speed", "acceleration", "\"-1 rad/s^2\""),
            ("", "chart", &chart),
        ];
        changed(&down).map(|m| m.chart.unwrap().period)
    };
    for (text, due) in [
        ("", Period::Rise),
        (", period = \"rise\"", Period::Rise),
        (", period = \"turn\"", Period::Turn),
    ] {
        assert_eq!(chart(text).unwrap(), due);
    }
    let refused = chart(", period = \"turns\"").err().unwrap().to_string();
    let due = "chart.period = \"turns\" (did you mean \"turn\"?) must be \"rise\" or \"turn\"";
    assert!(refused.ends_with(due), "{refused}");
}

#[test]
fn harmonics_are_those_asked_for() {
    let read = |file: Option<u32>, option: Option<u32>| {
        let mut text = include_str!("../../../examples/chirp-run-up.toml").to_string();
        if let Some(n) = file {
            text = format!("harmonics = {n}\n{text}");
        }
        CamOscillator::read(&Source::toml(text), option).map(|m| m.harmonics)
    };
    for (file, option, due) in [
        (Some(1), None, 1),
        (Some(100_000), None, 100_000),
        (Some(7), Some(9), 9),
        (None, Some(9), 9),
        (Some(0), Some(1), 1),
    ] {
        assert_eq!(read(file, option).unwrap(), due);
    }
    for (file, option, n) in [
        (Some(0), None, 0),
        (Some(100_001), None, 100_001),
        (Some(1), Some(0), 0),
    ] {
        let refused = read(file, option).unwrap_err().to_string();
        let due = format!("harmonics = {n} must be between 1 and 100000");
        assert!(refused.ends_with(&due), "{refused}");
    }
}

/// Of all that are drawn the law that needs most tells how many; what is left out of it is a ten
/// thousandth of the lift.
#[test]
fn harmonics_are_enough_for_every_law() {
    let own = |law: &str, lift: &str| {
        let law = format!("\"{law}\"");
        let machine = changed(&[("cam", "law", &law), ("cam", "lift", lift)]).unwrap();
        let series = FourierSeries::new(&machine.drive.cycle);
        let lift = machine.drive.cycle.lift().abs();
        let (n, bound) = (machine.harmonics, 1e-4 * lift);
        assert_eq!(series.harmonics_for(bound, 0).unwrap(), n);
        assert!(series.harmonics_for(0.5 * bound, 0).unwrap() > n);
        n
    };
    let (rough, smooth) = ("0050", "4-5-6-7");
    let [most, least] = [rough, smooth].map(|law| own(law, "\"20 mm\""));
    assert!(least < most, "{least} {most}");
    assert_eq!(own(rough, "\"-20 mm\""), most);
    let down = |law: &str, laws: &str, to: &str| {
        let law = format!("\"{law}\"");
        let chart =
            format!("{{ from = 2.0, to = {to}, step = 0.05, period = \"turn\", laws = [{laws}] }}");
        let machine = changed(&[
            ("cam", "law", &law),
            ("speed", "start", "\"1000 rad/s\""),
            ("speed", "acceleration", "\"-1 rad/s^2\""),
            ("", "chart", &chart),
        ]);
        machine.unwrap().harmonics
    };
    for (law, laws) in [
        (rough, "\"4-5-6-7\""),
        (smooth, "\"0050\""),
        (smooth, "\"0050\", \"4-5-6-7\""),
        (smooth, "\"4-5-6-7\", \"0050\""),
    ] {
        assert_eq!(down(law, laws, "2.0"), most, "{law} {laws}");
    }
    // Twice the slowest point's, rounded up: 2 · 500.05.
    assert_eq!(down(smooth, "\"4-5-6-7\"", "500.05"), 1001);
    let refused = refusal(&[
        ("cam", "law", "{ polynomial = [0, 1] }"),
        ("cam", "lift", "\"20 mm\""),
    ]);
    assert!(refused.contains("harmonics = ..."), "{refused}");
}
