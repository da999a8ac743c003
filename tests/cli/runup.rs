//! `mechaudit runup` as its user meets it.

use crate::common::{Done, cells, changed, column, drawing, refused, run_on, said, words};

const SCREEN: &str = include_str!("../../examples/sand-screen-run-up.toml");
const FOUR_BAR: &str = include_str!("../../examples/four-bar-run-up.toml");

fn runup(text: &str, args: &[&str]) -> Done {
    run_on(text, &[&["runup", "-"], args].concat())
}

#[test]
fn the_screen_runs_up() {
    let d = runup(SCREEN, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    let (t, omega) = (column(&d.out, "t_s"), column(&d.out, "omega_rad_per_s"));
    assert_eq!((t.len(), t[0], t[3000]), (3001, 0.0, 3.0));
    for (k, due) in [
        (10, 9.893_806_153_974_392),
        (100, 9.654_357_617_467_618),
        (1000, 9.504_285_733_743_605),
        (3000, 9.704_704_223_655_904),
    ] {
        assert!((omega[k] - due).abs() < 1e-10, "{k}: {}", omega[k]);
    }
    let balance = column(&d.out, "energy_balance_J");
    assert!(balance.iter().all(|b| b.abs() < 1e-8));
    // The light dead position, with its cause.
    said(&d, "falls to 0.03435 kg·m²");
    said(&d, "I_1 = 0: the file gives neither motor.rotor_inertia");
    said(&d, "9.985716 rad/s in the mean");
    said(&d, "flywheel: 57.1159 kg·m² more");
    let geared = changed(SCREEN, "# rotor_inertia", "rotor_inertia");
    let geared = changed(&geared, "# ratio = 15 ", "ratio = 15 ");
    let geared = changed(&geared, "\"10 rad/s\"", "\"150 rad/s\"");
    let geared = changed(&geared, "\"200 N m\"", "\"13.3333333333 N m\"");
    let d = runup(&geared, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(!d.err.contains("warning"), "{}", d.err);
}

#[test]
fn coefficients_and_methods_can_be_chosen() {
    // Without the search for a flywheel.
    let screen = changed(SCREEN, "fluctuation = 0.05", "");
    let last = |args: &[&str]| {
        let d = runup(&screen, args);
        assert_eq!(d.code, 0, "{args:?}: {}", d.err);
        (*column(&d.out, "omega_rad_per_s").last().unwrap(), d)
    };
    let (exact, _) = last(&[]);
    let (hybrid, d) = last(&["--coefficients", "hybrid", "--nodes", "12"]);
    assert!((hybrid - exact).abs() > 1e-4 && (hybrid - exact).abs() < 2e-2);
    said(&d, "energy is not kept");
    let lost = *column(&d.out, "energy_balance_J").last().unwrap();
    assert!((lost + 0.8275).abs() < 1e-3, "{lost}");
    let (splines, _) = last(&["--coefficients", "splines", "--nodes", "48"]);
    assert!((splines - exact).abs() < 2e-4);
    for method in ["dop853", "radau5"] {
        let (other, d) = last(&["--method", method, "--tolerance", "1e-11"]);
        assert!((other - exact).abs() < 1e-8, "{method}: {other}");
        said(&d, method);
    }
}

#[test]
fn stalls_and_captures_are_reported_at_once() {
    let weak = changed(SCREEN, "\"200 N m\"", "\"5 N m\"");
    let weak = changed(&weak, "[run]", "[load]\nconstant = \"10 N m\"\n[run]");
    let weak = changed(&weak, "\"3 s\"", "\"10000 s\"");
    let weak = changed(&weak, "step = \"1 ms\"", "step = \"10 ms\"");
    let d = runup(&weak, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    said(&d, "stalled: the crank");
    let held = changed(
        &weak,
        "\"14.426 deg\"\nphi4 = \"22.6 deg\"",
        "\"320 deg\"\nmode = 2",
    );
    let d = runup(&held, &[]);
    said(&d, "does not start at phi1 = 320.000 deg");
    assert_eq!(d.out.lines().count(), 2);
    let fan = changed(FOUR_BAR, "\"0.05 N m s\"", "\"1.5 N m s\"");
    let fan = changed(&fan, "\"2 s\"", "\"1000 s\"\nsettle = 1e-7");
    let fan = changed(
        &fan,
        "step = \"2 ms\"",
        "step = \"100 ms\"\ntarget_speed = \"30 rad/s\"",
    );
    let d = runup(&fan, &[]);
    said(&d, "captured after");
}

#[test]
fn drawings_and_files_are_written_whole() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = folder.path().join("pictures");
    let rows = folder.path().join("rows.csv");
    let (p, r) = (pictures.to_str().unwrap(), rows.to_str().unwrap());
    let d = runup(FOUR_BAR, &["--svg", p, "--output", r]);
    assert_eq!((d.code, d.out.as_str()), (0, ""), "{}", d.err);
    assert_eq!(
        std::fs::read_to_string(&rows).unwrap().lines().count(),
        1002
    );
    let svg = std::fs::read_to_string(pictures.join("run-up.svg")).unwrap();
    assert!(svg.contains("crank speed") && svg.contains("work of the motor"));
    assert_eq!(drawing(&svg).len(), 8);
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    let d = runup(FOUR_BAR, &["--svg", taken.to_str().unwrap()]);
    refused(&d, "cannot make the folder");
    refused(&runup(FOUR_BAR, &["--output", p]), "is a folder");
}

#[test]
fn the_same_file_serves_linkage() {
    let d = run_on(SCREEN, &["linkage", "-", "--step-deg", "90"]);
    assert_eq!((d.code, d.out.lines().count()), (0, 5), "{}", d.err);
}

#[test]
fn slider_cranks_run_too() {
    let text = r#"
type = "slider-crank"
[geometry]
crank = "50 mm"
rod = "180 mm"
[bodies.rod]
mass = "1 kg"
inertia = "0.003 kg m^2"
radius = "60 mm"
[bodies.slider]
mass = "2 kg"
[motor]
kind = "linear"
standstill_torque = "20 N m"
no_load_speed = "300 rpm"
flywheel = "0.05 kg m^2"
[run]
duration = "1 s"
"#;
    let d = runup(text, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    let omega = column(&d.out, "omega_rad_per_s");
    assert_eq!(omega.len(), 1001);
    assert!((omega[1000] - 31.4).abs() < 3.0, "{}", omega[1000]);
    assert!(!d.err.contains("warning"), "{}", d.err);
    refused(
        &runup(&changed(text, "bodies.slider", "bodies.piston"), &[]),
        "unknown field `piston`, expected one of `crank`, `rod`, `slider`",
    );
    refused(
        &runup(&changed(text, "\"2 kg\"", "\"-2 kg\""), &[]),
        "mass of link 3 = -2 kg",
    );
}

#[test]
fn bad_input_is_one_clear_line() {
    let (motor, _) = SCREEN.split_once("[motor]").unwrap();
    refused(&runup(motor, &[]), "the section [motor] is missing");
    let (no_run, _) = SCREEN.split_once("[run]").unwrap();
    refused(&runup(no_run, &[]), "the section [run] is missing");
    refused(&runup("", &[]), "the file is empty");
    let changes = r#"
        "kloss"           | "steam"                    | motor.kind = "steam" must be one of
        "kloss"           | "linear"                   | motor.synchronous_speed has no meaning with kind = "linear"
        overload = 2.2    | overload = 0.5             | k = 0.5 must be at least 1
        overload = 2.2    | overload = nan             | overload factor = NaN is not a finite number
        overload = 2.2    |                            | motor.overload is missing
        overload = 2.2    | overload = "2.2"           | expected a number
        rated_slip = 0.05 | rated_slip = 1.5           | slip 1.5 must lie between 0 and 1
        rated_slip = 0.05 | rated_slip = 0.05\ncritical_slip = 0.2 | exclude each other
        "200 N m"         | 200                        | motor.rated_torque = "200" has no unit
        "200 N m"         | "200 N"                    | is not a torque
        "200 N m"         | "-200 N m"                 | rated torque = -200 N m must be greater than zero
        rated_slip = 0.05 | rated_slip = 0.05\nratio = 0 | must not be zero
        rated_slip = 0.05 | rated_slip = 0.05\nrotor_inertia = "-1 kg m^2" | rotor inertia = -1
        rated_slip        | rated_slop                 | unknown field `rated_slop`
        "3 s"             | "0 s"                      | duration = 0 must be greater than zero
        "3 s"             | "3 m"                      | is not a time
        "1 ms"            | "1e-9 s"                   | more than ten million samples
        1e-12             | 1e-20                      | must lie between 1e-14 and 1e-2
        [run]             | [load]\nviscous = "-1 N m s"\n[run] | viscous resistance = -1
    "#;
    for [from, to, part] in cells(changes) {
        refused(&runup(&changed(SCREEN, &from, &to), &[]), &part);
    }
    let options = "
        --method euler             | '--method <NAME>' [possible values: verner98, dop853, radau5]
        --coefficients none        | '--coefficients <MODEL>' [possible values: exact, splines, hybrid]
        --coefficients splines --nodes 2 | from 3 to 100000
        --tolerance x              | invalid value
        --method radau             | 'radau' for '--method <NAME>' [possible values: verner98, dop853, radau5]; a similar value exists: 'radau5'
        --coefficients spline      | a similar value exists: 'splines'
        --nodes 12                 | --nodes has no meaning with exact coefficients
        --nodes 12 --coefficients exact | --nodes has no meaning with exact coefficients
    ";
    for [args, part] in cells(options) {
        refused(&runup(SCREEN, &words(&args)), &part);
    }
    // Without the names of Rust's types.
    let fields = r#"
        nodes = 12              | run.nodes has no meaning with exact
        method = "radau"        | run.method = "radau" (did you mean "radau5"?) must be one of "verner98", "dop853", "radau5"
        coefficients = "spline" | run.coefficients = "spline" (did you mean "splines"?) must be one of "exact"
        nodes = "x"             | string "x", expected a whole number, 0 or more
        nodes = -3              | integer `-3`, expected a whole number, 0 or more
        settle = "x"            | string "x", expected a number
        duraton = 3             | unknown field `duraton` (did you mean "duration"?), expected one of
    "#;
    for [field, part] in cells(fields) {
        let text = changed(SCREEN, "[run]", &format!("[run]\n{field}"));
        refused(&runup(&text, &[]), &part);
    }
    let bodiless = SCREEN.replace("bodies.2", "x2").replace("[x2]", "[[x]]");
    refused(&runup(&bodiless, &[]), "unknown field `x`");
    let (head, tail) = SCREEN.split_once("[motor]").unwrap();
    let (_, run) = tail.split_once("[run]").unwrap();
    let table = |points: &str| {
        let motor = format!("[motor]\nkind = \"table\"\nreading = \"linear\"\n{points}\n");
        runup(&format!("{head}{motor}[run]{run}"), &[])
    };
    refused(&table(""), "motor.points is missing");
    refused(&table("points = []"), "motor.points is empty");
    refused(
        &table("points = [[\"1 rpm\", \"1 N m\"], [\"1 rpm\", \"2 N m\"]]"),
        "not greater than its predecessor",
    );
    refused(
        &table("points = [[\"0 rpm\", \"900 N m\"], [\"1 rpm\", \"900 N m\"]]"),
        "tabulated from 0 to",
    );
}

/// The load has a part in it.
#[test]
fn a_load_that_holds_the_machine_is_named() {
    let held = changed(FOUR_BAR, "constant = \"2 N m\"", "constant = \"200 N m\"");
    let d = runup(&held, &[]);
    let said =
        "motor and weights give 12.845724 N m together against a constant load of 200.000000 N m";
    assert!(d.code == 0 && d.err.contains(said), "{}", d.err);
}

#[test]
fn work_and_precision() {
    let short = changed(FOUR_BAR, "\"2 s\"", "\"0.05 s\"");
    let folder = tempfile::tempdir().unwrap();
    let d = runup(
        &short,
        &["--work-precision", "--svg", folder.path().to_str().unwrap()],
    );
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(d.out.lines().count(), 1 + 3 * 19);
    for line in d.out.lines().skip(1) {
        let tolerance: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
        let halves = -2.0 * tolerance.log10();
        assert!((halves - halves.round()).abs() < 1e-9, "{line}");
    }
    // It is no error that is said.
    let said =
        "mechaudit: the column error_rad_per_s is the worst difference of the speed at 8 moments";
    assert!(d.err.starts_with(said), "{}", d.err);
    for method in ["verner98", "dop853", "radau5"] {
        let own = d.out.lines().filter(|l| l.starts_with(method));
        let error = own.map(|l| l.rsplit(',').next().unwrap().parse::<f64>().unwrap());
        let errors: Vec<f64> = error.collect();
        assert!(
            errors[18] < 1e-9 && errors[18] <= errors[0],
            "{method}: {errors:?}"
        );
    }
    // Each method has a curve of its own points.
    let svg = std::fs::read_to_string(folder.path().join("work-precision.svg")).unwrap();
    let curves: Vec<usize> = drawing(&svg).iter().map(Vec::len).collect();
    assert!(
        curves.len() == 3 && curves.iter().all(|n| (10..=19).contains(n)),
        "{curves:?}"
    );
}

#[test]
fn work_and_precision_in_json() {
    let short = changed(FOUR_BAR, "\"2 s\"", "\"0.01 s\"");
    let d = runup(&short, &["--work-precision", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    for (key, due) in [
        ("schema_version", serde_json::json!(1)),
        ("mechaudit_version", env!("CARGO_PKG_VERSION").into()),
        ("name", "crank-rocker, run-up".into()),
        ("duration_s", serde_json::json!(0.01)),
    ] {
        assert_eq!(json[key], due);
    }
    assert_eq!(json["rows"].as_array().unwrap().len(), 3 * 19);
}

/// Only where the crank does not turn fully.
#[test]
fn how_far_the_crank_turns_is_said() {
    let short = changed(SCREEN, "\"3 s\"", "\"0.01 s\"");
    let short = changed(&short, "fluctuation = 0.05", "");
    let d = runup(&short, &[]);
    assert!(d.code == 0 && !d.err.contains("fully"), "{}", d.err);
    let held = changed(&short, "l1 = \"10 cm\"", "l1 = \"45 cm\"");
    let held = changed(&held, "\"22.6 deg\"", "\"22 deg\"");
    let d = runup(&held, &[]);
    said(
        &d,
        "the crank cannot turn fully on this branch: it reaches from -96.62",
    );
}

#[test]
fn a_stiff_machine_is_run_up_by_radaus_method_and_that_is_said() {
    let text = changed(SCREEN, "\"200 N m\"", "\"1e6 N m\"");
    let d = runup(&text, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    said(&d, "radau5 took over from verner98");
    let gentle = runup(SCREEN, &["--format", "json"]);
    assert!(!gentle.err.contains("stiff"), "{}", gentle.err);
    assert!(
        gentle.out.contains("\"stiff_from_s\": null"),
        "{}",
        &gentle.out[..600]
    );
}

/// A four-bar linkage let go under its own weight: it swings, and its energy stays.
#[test]
fn a_crank_swings_through_its_turning_points() {
    let text = "type = \"four-bar\"\ngravity = \"9.81 m/s^2\"\n[geometry]\ncrank = \"0.5 m\"\ncoupler = \"1 m\"\n\
                rocker = \"0.6 m\"\nframe = \"0.9 m\"\n[start]\nphi1 = \"-60 deg\"\nassembly = \"negative\"\n\
                [bodies.crank]\nmass = \"1 kg\"\ninertia = \"0.0208 kg m^2\"\nradius = \"25 cm\"\n\
                [bodies.coupler]\nmass = \"2 kg\"\ninertia = \"0.1667 kg m^2\"\nradius = \"50 cm\"\n\
                [bodies.rocker]\nmass = \"1.2 kg\"\ninertia = \"0.036 kg m^2\"\nradius = \"30 cm\"\n\
                [motor]\nkind = \"off\"\n[run]\nduration = \"3 s\"\nstep = \"50 ms\"\n";
    let d = runup(text, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    said(
        &d,
        "the crank comes to rest and goes on from there 4 times, first after 0.70",
    );
    said(&d, "the time is over after 3.000000 s");
    let [t, phi, energy] = ["t_s", "phi1_deg", "energy_balance_J"].map(|n| column(&d.out, n));
    assert_eq!((t.len(), t[60]), (61, 3.0));
    assert!(energy.iter().all(|x| x.abs() < 1e-8));
    // Back at the height that it was let go from, and never beyond.
    assert!(phi.iter().all(|x| *x <= -60.0 + 1e-6));
    let json = runup(text, &["--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["outcome"]["kind"], "time_up");
    let rests = json["events"].as_array().unwrap().iter();
    assert_eq!(rests.filter(|e| e["kind"] == "rest").count(), 4);
    // Friction holds it in the end.
    let held = changed(text, "[run]", "[load]\nconstant = \"0.5 N m\"\n[run]");
    let d = runup(&changed(&held, "\"3 s\"", "\"1000 s\""), &[]);
    said(&d, "stalled: the crank comes to rest after ");
}

/// A soft start, and tables over time that are refused.
#[test]
fn a_motor_may_be_a_table_over_time() {
    let soft = include_str!("../../examples/soft-start.toml");
    let d = runup(soft, &[]);
    assert_eq!(d.code, 0, "{}", d.err);
    let [t, motor] = ["t_s", "M_motor_N_m"].map(|n| column(&d.out, n));
    for (t, motor) in t.into_iter().zip(motor) {
        let due = match t {
            t if t < 0.5 => 8.0 * t,
            t if t < 2.0 => 4.0 + 8.0 * (t - 0.5) / 1.5,
            _ => 12.0,
        };
        assert!((motor - due).abs() < 1e-12, "{t}: {motor} {due}");
    }
    let changes = r#"
        "0.5 s"      | "2 s"        | the time of point 3, 2 s, must be greater than the one before, 2 s
        "0 s"        | "0.1 s"      | the first time of the torque, 0.1 s, must be 0 s
        "0.5 s"      | "50 rpm"     | motor.points has speeds and times
        "0.5 s"      | "5 kg"       | is not an angular velocity
        "4 N m"      | "4 N"        | is not a torque
        flywheel     | reading = "cubic"\nflywheel | has no meaning for a torque over time
    "#;
    for [from, to, part] in cells(changes) {
        refused(&runup(&changed(soft, &from, &to), &[]), &part);
    }
    let start = soft.find("points").unwrap();
    let end = start + soft[start..].find('\n').unwrap();
    let empty = format!("{}points = []{}", &soft[..start], &soft[end..]);
    refused(&runup(&empty, &[]), "motor.points is empty");
}

#[test]
fn certified_digits_of_a_run() {
    let text = include_str!("../../examples/four-bar-run-up.toml");
    let text = text.replace(
        "step = \"2 ms\"",
        "step = \"20 ms\"\ntarget_speed = \"20 rad/s\"",
    );
    // Friction holds the crank of the second at first.
    let held = include_str!("../../examples/soft-start.toml");
    let held = held.replace("step = \"5 ms\"", "step = \"1 s\"");
    for (machine, end) in [(&text, "run.target_speed is reached at t = "), (&held, "")] {
        let [d, due] = [&["--digits", "12"][..], &[]].map(|args| runup(machine, args));
        assert_eq!(d.code, 0, "{}", d.err);
        said(&d, end);
        for (of, other) in [
            ("t", "t_s"),
            ("phi1", "phi1_deg"),
            ("omega", "omega_rad_per_s"),
            ("epsilon", "epsilon_rad_per_s2"),
        ] {
            let (found, due) = (column(&d.out, of), column(&due.out, other));
            assert!(found.len() > 3 && found.len() == due.len(), "{}", d.out);
            let near = |(x, y): (&f64, &f64)| (x - y).abs() < 1e-7 * (1.0 + y.abs());
            assert!(found.iter().zip(&due).all(near), "{of}: {found:?} {due:?}");
        }
    }
    let d = runup(&text, &["--digits", "12", "--method", "dop853"]);
    assert_eq!(d.code, 2);
}
