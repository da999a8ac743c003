//! `mechaudit chirp` as its user meets it.

use crate::common::{Done, cells, changed, column, refused, run_on, said};

const RUN_UP: &str = include_str!("../../examples/chirp-run-up.toml");
const RUN_DOWN: &str = include_str!("../../examples/chirp-run-down.toml");
const CHART: &str = include_str!("../../examples/chirp-chart.toml");

fn chirp(text: &str, args: &[&str]) -> Done {
    run_on(text, &[&["chirp", "-"], args].concat())
}

#[test]
fn a_history_begins_on_the_cam_and_stays_within_the_envelope() {
    let d = chirp(RUN_UP, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    let [t, y, v, a] = ["t_s", "y_m", "v_m_per_s", "a_m_per_s2"].map(|n| column(&d.out, n));
    let [low, high] = ["envelope_low_m", "envelope_high_m"].map(|n| column(&d.out, n));
    assert_eq!((t.len(), t[2400]), (2401, 12.0));
    assert!(y[0].abs() < 1e-12 && v[0].abs() < 1e-12);
    // The mean of the cam: (100/2 + 80 + 90/2)/360 of the lift.
    let mean = 0.02 * 175.0 / 360.0;
    for k in 0..=2400 {
        assert!(low[k] <= y[k] && y[k] <= high[k], "{} s", t[k]);
        assert!((low[k] + high[k] - 2.0 * mean).abs() < 1e-12);
    }
    // The equation of motion holds between the columns, with f as printed.
    let f = column(&d.out, "f_m");
    for k in (1200..=2400).step_by(100) {
        let rest = a[k] + 2.4 * v[k] + 6400.0 * (y[k] - f[k]);
        assert!(rest.abs() < 1e-9 * (1.0 + a[k].abs()), "{rest}");
    }
    let xi = (
        column(&d.out, "xi_rise")[2400],
        column(&d.out, "xi_turn")[2400],
    );
    assert!((xi.0 - 80.0 * 100.0 / 360.0 / 30.0).abs() < 1e-12);
    assert!((xi.1 - 80.0 / 30.0).abs() < 1e-12);
    // The angle in degrees is the speed's integral, by the rule of trapezoids exactly where the
    // speed is linear.
    let [angle, speed] = ["shaft_deg", "speed_rad_per_s"].map(|n| column(&d.out, n));
    for k in 1..=2400 {
        let turned = 0.5 * (speed[k] + speed[k - 1]) * (t[k] - t[k - 1]);
        let shown = angle[k] - angle[k - 1];
        assert!((shown - turned.to_degrees()).abs() < 1e-6, "{}", t[k]);
    }
    said(&d, "harmonics; those left out");
}

#[test]
fn the_shaft_stands_and_turns_back() {
    let d = chirp(RUN_DOWN, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    let (angle, f) = (column(&d.out, "shaft_deg"), column(&d.out, "f_m"));
    let (speed, y) = (column(&d.out, "speed_rad_per_s"), column(&d.out, "y_m"));
    assert_eq!(speed[800], 0.0);
    for k in 0..=800 {
        assert!((angle[k] - angle[1600 - k]).abs() < 1e-9);
        assert!((f[k] - f[1600 - k]).abs() < 1e-12);
    }
    // Near standstill the follower is on the cam.
    assert!((y[800] - f[800]).abs() < 1e-4);
    assert!(y.iter().all(|y| y.abs() < 0.04));
}

#[test]
fn charts_of_two_laws() {
    let coarse = changed(CHART, "step = 0.1", "step = 1.0");
    let d = chirp(&coarse, &["--harmonics", "90"]);
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(d.out.lines().count(), 1 + 2 * 13);
    assert!(
        d.out.lines().nth(1).unwrap().starts_with("К,2,6"),
        "{}",
        d.out
    );
    let (bound, peak) = (
        column(&d.out, "formula_19"),
        column(&d.out, "peak_displacement"),
    );
    assert!(bound.iter().zip(&peak).all(|(b, p)| p <= b), "{}", d.out);
    let k = column(&d.out, "K_dc");
    assert!(k.iter().all(|k| *k > 0.9 && *k < 9.0), "{k:?}");
    assert!(
        d.err.contains("0050: ") && d.err.contains("beat zones"),
        "{}",
        d.err
    );
    let json = chirp(&coarse, &["--harmonics", "90", "--format", "json"]);
    let value: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(value["rows"].as_array().unwrap().len(), 26);
    assert_eq!(value["beat_zones"][1]["law"], "0050");
}

#[test]
fn bad_input_is_one_line_and_exit_code_2() {
    let run_up = r#"
        frequency = "80 rad/s"     | frequency = "0 rad/s"      | w = 0 must be greater than zero
        frequency = "80 rad/s"     | frequency = "-1 rad/s"     | w = -1
        frequency = "80 rad/s"     | frequency = "nan rad/s"    | oscillator.frequency
        frequency = "80 rad/s"     |                            | oscillator.frequency is missing
        damping = "1.2 rad/s"      | damping = "-1.2 rad/s"     | n = -1.2 must not be negative
        damping = "1.2 rad/s"      | damping_ratio = nan        | n = NaN
        damping = "1.2 rad/s"      | damping = 1.2              | has no unit
        rise = "100 deg"           | rise = "110 deg"           | must fill one turn
        rise = "100 deg"           | rise = "0 deg"             | must be positive
        law = "modified-sine"      | law = "C0"                 | defined nowhere
        law = "modified-sine"      | law = "spiral"             | unknown law "spiral"
        law = "modified-sine"      | law = { scca = [0.5, 0.5, 0.5] } | b + c + d = 1.5
        law = "modified-sine"      | law = { scca = [0.5, 0.5] } | cam.law.scca: invalid length 2, expected an array of length 3
        law = "modified-sine"      | law = {}                   | exactly one of
        law = "modified-sine"      | law = { polynomial = [0, 1] } | harmonics = ...
        lift = "20 mm"             | lift = "20 kg"             | cam.lift
        lift = "20 mm"             | lift = "0 mm"              | the lift must not be 0
        acceleration = "2.5 rad/s^2" |                            | speed.acceleration is missing
        step = "5 ms"              | step = "0 s"               | run.step
        duration = "12 s"          | duration = "-12 s"         | run.duration
        [run]                      | [walk]                     | unknown field `walk`
    "#;
    let chart = r#"
        from = 2.0                 | from = 0.0                 | chart.from = 0
        to = 14.0                  | to = nan                   | chart.to = NaN
        period = "rise"            | period = "dwell"           | chart.period
        "К", "0050"                | "К", "0000"                | defined nowhere
        acceleration = "-0.2 rad/s^2" | acceleration = "0.2 rad/s^2" | a speed that the shaft does not have
    "#;
    for (example, changes) in [(RUN_UP, run_up), (CHART, chart)] {
        for [from, to, part] in cells(changes) {
            let d = chirp(&changed(example, &from, &to), &[]);
            refused(&d, &part);
            assert!(d.err.starts_with("mechaudit: -: "), "{}", d.err);
        }
    }
    let d = chirp(CHART, &["--rows", "history"]);
    refused(&d, "the section [run] is missing");
}
