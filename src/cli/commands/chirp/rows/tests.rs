use super::*;
use mechaudit::machine::Source;
use mechaudit::report::glossary::topics;
use mechaudit::solvers::chirp_chart::Chart;
use std::f64::consts::PI;

const RUN_UP: &str = include_str!("../../../../../examples/chirp-run-up.toml");
const CHART: &str = include_str!("../../../../../examples/chirp-chart.toml");

/// The run-up with its cam's law, duration and harmonics changed.
fn machine(law: &str, harmonics: u32) -> CamOscillator {
    let text = RUN_UP
        .replace("modified-sine", law)
        .replace("\"12 s\"", "\"4.1 s\"");
    let text = text.replace("step = \"5 ms\"", "step = \"1 ms\"");
    CamOscillator::read(&Source::toml(text), Some(harmonics)).unwrap()
}

fn columns(rows: ChirpRows, machine: &CamOscillator) -> Columns {
    Columns::of(names(rows, machine), &[], false).unwrap()
}

fn point(xi: f64, acceleration: f64) -> ChartPoint {
    ChartPoint {
        xi_rise: xi,
        xi_turn: 3.0 * xi,
        t: 0.5,
        speed: 6.0,
        bound: 1.5,
        displacement: 1.25,
        acceleration_bound: 9.0,
        acceleration,
        dynamic_coefficients: [1.1, 1.2, 1.3],
        dwell_amplitude: 0.01,
        dwell_phase: PI / 2.0,
    }
}

/// A chart with maxima at these abscissae, all on a grid of step 1.
fn law_chart(maxima: &[f64]) -> LawChart {
    let points = (0..=20).map(|k| {
        let xi = f64::from(k);
        point(xi, if maxima.contains(&xi) { 8.0 } else { 7.0 })
    });
    let mut points: Vec<ChartPoint> = points.collect();
    points[3].bound = 2.5;
    points[5].displacement = 1.2;
    LawChart {
        law: "К".into(),
        chart: Chart {
            period: Period::Rise,
            rigid: [5.5, 1.0, 1.0],
            points,
        },
    }
}

/// Ratios of 1.5/1.25, 2.5/1.25 and 1.5/1.2.
#[test]
fn a_chart_has_a_line() {
    let ratios = "formula (19) is 1.200 to 2.000 times the true peak";
    for (maxima, due) in [
        (&[][..], "К: 0 beat zones of C_phi".to_owned()),
        (&[4.0], "К: 1 beat zones of C_phi".into()),
        (
            &[4.0, 9.0],
            "К: 2 beat zones of C_phi, 5.000 apart in the mean".into(),
        ),
        (
            &[4.0, 9.0, 12.0],
            "К: 3 beat zones of C_phi, 4.000 apart in the mean".into(),
        ),
    ] {
        assert_eq!(chart_line(&law_chart(maxima)), format!("{due}; {ratios}"));
    }
}

/// Half as high and 1/n³ or less each: what is left of a law without jumps of its velocity falls
/// with 1/n².
#[test]
fn harmonics_have_a_line() {
    let machine = machine("constant-acceleration", 30);
    let line = harmonics_line(&machine);
    let (head, rest) = line.split_once(" of the lift at most").unwrap();
    let (count, bound) = head.split_once("; those left out add up to ").unwrap();
    assert_eq!(count, "30 harmonics");
    let series = FourierSeries::new(&machine.drive.cycle);
    let beyond: f64 = (31..2000)
        .map(|n| series.harmonic(n).unwrap().amplitude())
        .sum();
    let bound: f64 = bound.parse().unwrap();
    let share = beyond / 0.02;
    assert!(share <= bound && bound < 10.0 * share, "{share} {bound}");
    // 1.5·80/30
    assert_eq!(
        rest,
        ", and are filtered at shaft speeds above 4.0000 rad/s"
    );
}

/// The constants of the polynomial 10 x³ − 15 x⁴ + 6 x⁵, and of a parabola.
#[test]
fn what_is_known_of_the_whole() {
    for (law, velocity, acceleration, jerk) in [
        ("3-4-5", 1.875, 10.0 / 3f64.sqrt(), Some(60.0)),
        ("constant-acceleration", 2.0, 4.0, None),
    ] {
        let found = about(&machine(law, 12));
        let near = |key: &str, due: f64| {
            let x = found[key].as_f64().unwrap();
            assert!((x - due).abs() <= 1e-12 * due.abs(), "{key}: {x}");
        };
        for (key, due) in [
            ("name", json!("run-up of a cam follower")),
            ("law", json!(law)),
            ("lift_unit", json!("m")),
            ("harmonics", json!(12)),
            ("omega0_rad_per_s", json!(0.0)),
        ] {
            assert_eq!(found[key], due);
        }
        near("w_rad_per_s", 80.0);
        near("n_rad_per_s", 1.2);
        near("epsilon_rad_per_s2", 2.5);
        near("lift", 0.02);
        near("C_v", velocity);
        near("C_a", acceleration);
        near("C_a_accelerating", acceleration);
        near("C_a_decelerating", acceleration);
        match jerk {
            Some(jerk) => near("C_j", jerk),
            None => assert!(found["C_j"].is_null()),
        }
        assert!(found["harmonics_left_out"].as_f64().unwrap() > 0.0);
    }
}

/// A cycloid whose acceleration takes 0.6 of the stroke: 2π/1.2 and −2π/0.8.
#[test]
fn both_sides_of_an_asymmetric_law_are_named() {
    let law = "{ name = \"cycloidal\", acceleration_fraction = 0.6 }";
    let text = RUN_UP.replace("\"modified-sine\"", law);
    let machine = CamOscillator::read(&Source::toml(text), Some(4)).unwrap();
    let found = about(&machine);
    for (key, due) in [
        ("C_a", PI / 0.4),
        ("C_a_accelerating", PI / 0.6),
        ("C_a_decelerating", PI / 0.4),
    ] {
        let x = found[key].as_f64().unwrap();
        assert!((x / due - 1.0).abs() < 1e-12, "{key}: {x}");
    }
}

/// The motion begins while the follower returns: before the end of the first high dwell nothing
/// has dwelt.
#[test]
fn rows_before_the_first_dwell_have_no_vibration_of_one() {
    let text = r#"
[oscillator]
frequency = "100 rad/s"
damping_ratio = 0.02
[cam]
lift = "20 mm"
law = "cycloidal"
rise = "120 deg"
high_dwell = "60 deg"
return = "120 deg"
low_dwell = "60 deg"
start = "-230 deg"
[speed]
start = "15 rad/s"
acceleration = "-1 rad/s^2"
[chart]
from = 2.23
to = 2.63
step = 0.4
"#;
    let machine = CamOscillator::read(&Source::toml(text), Some(12)).unwrap();
    let mut out = Vec::new();
    let form = (Form::Csv, columns(ChirpRows::Chart, &machine));
    chart(&mut out, form, &machine, &machine.charts().unwrap()).unwrap();
    let out = String::from_utf8(out).unwrap();
    let ends: Vec<Vec<&str>> = out
        .lines()
        .map(|l| l.rsplit(',').take(2).collect())
        .collect();
    assert_eq!(ends[0], ["dwell_phase_deg", "dwell_amplitude"]);
    assert_eq!(ends[1], ["", ""], "{out}");
    assert!(ends[2].iter().all(|x| x.parse::<f64>().is_ok()), "{out}");
}

/// More rows than are computed together, each in its place.
#[test]
fn a_history_has_a_row_for_each_step() {
    let machine = machine("3-4-5", 4);
    let response = machine.response(&machine.drive).unwrap();
    let mut out = Vec::new();
    let form = (Form::Csv, columns(ChirpRows::History, &machine));
    history(&mut out, form, &machine, &response).unwrap();
    let text = String::from_utf8(out).unwrap();
    let head = "t_s,shaft_deg,speed_rad_per_s,xi_rise,xi_turn,f_m,y_m,v_m_per_s,a_m_per_s2,\
                envelope_low_m,envelope_high_m";
    assert_eq!(text.lines().next(), Some(head));
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(CHUNK < 4101 && rows.len() == 4101);
    let near =
        |x: f64, due: f64| assert!((x - due).abs() <= 1e-12 * (1.0 + due.abs()), "{x} {due}");
    for k in [1, 2, 1000, 4095, 4096, 4097, 4100] {
        let row = &rows[k];
        let t = k as f64 / 1000.0;
        near(row[0], t);
        // From rest with 2.5 rad/s².
        let speed = 2.5 * t;
        near(row[1], (1.25 * t * t).to_degrees());
        near(row[2], speed);
        near(row[3], 80.0 / speed * 100.0 / 360.0);
        near(row[4], 80.0 / speed);
        let state = response.state(row[0]).unwrap();
        let due = [
            state.cam,
            state.displacement,
            state.velocity,
            state.acceleration,
        ];
        assert_eq!(row[5..9], due);
        let envelope = response.envelope(row[0]).unwrap();
        // The mean of the cam, (100/2 + 80 + 90/2)/360 of the lift.
        let mean = 0.02 * 175.0 / 360.0;
        near(row[9], mean - envelope);
        near(row[10], mean + envelope);
    }
}

/// Without [run] there is no history.
#[test]
fn no_run_has_no_rows() {
    let mut machine = machine("3-4-5", 4);
    let response = machine.response(&machine.drive).unwrap();
    machine.run = None;
    let mut out = Vec::new();
    let form = (Form::Csv, columns(ChirpRows::History, &machine));
    history(&mut out, form, &machine, &response).unwrap();
    assert!(out.is_empty());
}

#[test]
fn charts_have_a_row_for_each_point() {
    let machine = machine("3-4-5", 4);
    let charts = [law_chart(&[4.0, 9.0]), law_chart(&[])];
    let mut out = Vec::new();
    let form = (Form::Json, columns(ChirpRows::Chart, &machine));
    chart(&mut out, form, &machine, &charts).unwrap();
    let found: Value = serde_json::from_slice(&out).unwrap();
    assert_eq!(found["law"], "3-4-5");
    let [first, second] = [0, 1].map(|k| &found["beat_zones"][k]);
    assert_eq!((&first["law"], &first["C"]), (&json!("К"), &json!(5.5)));
    assert_eq!(
        first["zones"],
        json!([
            { "xi": 4.0, "C_phi": 8.0, "spacing": null },
            { "xi": 9.0, "C_phi": 8.0, "spacing": 5.0 },
        ])
    );
    assert_eq!(second["zones"], json!([]));
    let rows = found["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2 * 21);
    let due = json!({
        "law": "К",
        "xi_rise": 4.0,
        "xi_turn": 12.0,
        "t_s": 0.5,
        "speed_rad_per_s": 6.0,
        "formula_19": 1.5,
        "peak_displacement": 1.25,
        "C_phi_bound": 9.0,
        "C_phi": 8.0,
        "K_dc": 1.1,
        "K_dM": 1.2,
        "K_dN": 1.3,
        "dwell_amplitude": 0.01,
        "dwell_phase_deg": 90.0,
    });
    assert_eq!(rows[4], due);
    assert_eq!(rows[21 + 4]["C_phi"], 7.0);
}

#[test]
fn a_spectrum_has_a_row_for_each_harmonic() {
    let machine = machine("3-4-5", 3);
    let mut out = Vec::new();
    let form = (Form::Json, columns(ChirpRows::Spectrum, &machine));
    spectrum(&mut out, form, &machine).unwrap();
    let found: Value = serde_json::from_slice(&out).unwrap();
    let mean = found["a_0"].as_f64().unwrap();
    assert!((mean - 0.02 * 175.0 / 360.0).abs() < 1e-15);
    let rows = found["rows"].as_array().unwrap();
    let numbers: Vec<u64> = rows.iter().map(|r| r["n"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [1, 2, 3]);
    // The rest left out after the last one is that of the whole.
    assert_eq!(rows[2]["left_out_m"], found["harmonics_left_out"]);
    for row in rows {
        let [a, b, d, delta] = ["a_m", "b_m", "D_m", "delta_deg"].map(|k| row[k].as_f64().unwrap());
        assert!(d > 0.0 && (a.hypot(b) - d).abs() < 1e-15, "{row}");
        let delta = delta.to_radians();
        assert!(
            (d * delta.cos() - a).abs() < 1e-15 && (d * delta.sin() + b).abs() < 1e-15,
            "{row}"
        );
    }
}

#[test]
fn every_column_has_a_meaning() {
    for text in [RUN_UP, CHART] {
        let machine = CamOscillator::read(&Source::toml(text), Some(5)).unwrap();
        for (rows, key) in [
            (ChirpRows::History, "history"),
            (ChirpRows::Chart, "chart"),
            (ChirpRows::Spectrum, "spectrum"),
        ] {
            let topic = topics(&[key]).next().unwrap();
            for name in names(rows, &machine) {
                assert!(topic.find(&name).is_some(), "{key}: {name} has no entry");
            }
        }
    }
}
