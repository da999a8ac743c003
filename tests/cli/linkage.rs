//! `mechaudit linkage` for class-III linkages.

use crate::common::{Done, changed, column, command, csv, names, refused, run, run_on, said};

const SCREEN: &str = include_str!("../../examples/sand-screen.toml");

/// Runs `linkage` on a description given on standard input.
pub fn linkage_of(text: impl AsRef<[u8]>, args: &[&str]) -> Done {
    run_on(text, &[&["linkage", "-"], args].concat())
}

/// The sand screen with something changed.
pub fn screen(from: &str, to: &str) -> String {
    changed(SCREEN, from, to)
}

#[test]
fn linkage_rows_are_those_of_the_table() {
    let d = run(&["linkage", "examples/sand-screen.toml", "--step-deg", "7.5"]);
    assert_eq!(d.code, 0, "{}", d.err);
    let phi1 = column(&d.out, "phi1_deg");
    assert_eq!(phi1.len(), 48);
    assert_eq!((phi1[0], phi1[1], phi1[47]), (14.426, 21.926, 366.926));
    // Rows 4, 8 and 36 of the published table are exact nodes.
    let inertia = column(&d.out, "I_n_kg_m2");
    for (row, printed) in [(4, 1.600), (8, 4.402), (36, 5.630)] {
        assert!((inertia[row] - printed).abs() < 6e-4);
    }
    said(&d, "the crank turns fully");
    said(&d, "14.426037 deg (stretched), 196.014059 deg (folded)");
    for name in [
        "det_J_m4",
        "condition",
        "pressure_angle_deg",
        "omega2_rad_per_s",
        "epsilon5_rad_per_s2",
    ] {
        assert!(column(&d.out, name).iter().all(|x| x.is_finite()));
    }
}

#[test]
fn crank_speed_scales_rates() {
    let step = ["--step-deg", "90"];
    let slow = linkage_of(SCREEN, &step);
    let fast = linkage_of(screen("\"1 rad/s\"", "\"4 rad/s\""), &step);
    let ratio = linkage_of(screen("crank_speed = \"1 rad/s\"", ""), &step);
    let get = |d: &Done, name| column(&d.out, name);
    for k in 0..4 {
        let (a, b) = (
            get(&slow, "omega3_rad_per_s"),
            get(&fast, "omega3_rad_per_s"),
        );
        assert_eq!(4.0 * a[k], b[k]);
        assert_eq!(a, get(&ratio, "dphi3_dphi1"));
        let (a, b) = (
            get(&slow, "epsilon3_rad_per_s2"),
            get(&fast, "epsilon3_rad_per_s2"),
        );
        assert_eq!(16.0 * a[k], b[k]);
    }
}

#[test]
fn both_file_forms_and_window_agree() {
    let args = ["--step-deg", "10", "--from-deg", "-20", "--to-deg", "40"];
    let toml = run(&[&["linkage", "examples/sand-screen.toml"][..], &args].concat());
    let json = run(&[&["linkage", "examples/sand-screen.json"][..], &args].concat());
    assert_eq!(
        column(&toml.out, "phi1_deg"),
        [-20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0]
    );
    for name in ["phi2_deg", "phi4_deg", "det_J_m4"] {
        assert_eq!(column(&toml.out, name), column(&json.out, name));
    }
}

#[test]
fn json_holds_what_is_known_of_the_turn() {
    let d = command("linkage examples/sand-screen.toml --step-deg 45 --format json");
    let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(v["full_rotation"], true);
    assert_eq!(v["crank_speed_rad_per_s"], 1.0);
    assert_eq!(v["turns_to_close"], 1);
    assert_eq!(v["dead_positions"].as_array().unwrap().len(), 2);
    assert_eq!(v["rows"].as_array().unwrap().len(), 8);
    assert_eq!(v["rows"][0]["phi1_deg"], 14.426);
    let d = command("linkage examples/no-full-turn.toml --step-deg 45 --format json");
    let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(v["full_rotation"], false);
    let end = |k: &str| v["crank_range"][k]["phi1_deg"].as_f64().unwrap();
    assert!(end("from") < end("to"));
}

#[test]
fn a_part_of_a_turn_is_an_answer() {
    let d = run(&["linkage", "examples/no-full-turn.toml", "--step-deg", "5"]);
    assert_eq!(d.code, 0);
    said(
        &d,
        "the crank cannot turn fully on this branch: it reaches from -96.62",
    );
    let phi1 = column(&d.out, "phi1_deg");
    assert!(phi1[0] > -96.7 && phi1[0] < -91.6 && *phi1.last().unwrap() > 173.0);
    assert!(phi1.windows(2).all(|w| (w[1] - w[0] - 5.0).abs() < 1e-9));
    // A window as asked for: angles outside the range are left out.
    let args = ["--step-deg", "60", "--from-deg", "0", "--to-deg", "300"];
    let d = run(&[&["linkage", "examples/no-full-turn.toml"][..], &args].concat());
    assert_eq!(column(&d.out, "phi1_deg"), [0.0, 60.0, 120.0, 300.0]);
    let away = ["--step-deg", "1", "--from-deg", "200", "--to-deg", "210"];
    let d = run(&[&["linkage", "examples/no-full-turn.toml"][..], &away].concat());
    assert_eq!(d.code, 0);
    said(&d, "no crank angle of the window");
}

#[test]
fn all_branches_with_folds() {
    let d = command("linkage examples/sand-screen.toml --step-deg 7.5 --all-branches");
    assert_eq!(d.code, 0);
    said(&d, "from 2 to 4 assembly modes");
    said(&d, "fold at phi1 = 217.270876");
    let branch = column(&d.out, "branch");
    assert_eq!(branch.len(), 4 * 48 - 2 * 8);
}

#[test]
fn branches_can_be_chosen() {
    let without = screen("phi4 = \"22.6 deg\"", "");
    let d = linkage_of(&without, &["--step-deg", "90"]);
    refused(&d, "which branch? the assembly modes there are 0 (phi4 = ");
    let d = linkage_of(&without, &["--step-deg", "90", "--branch", "2"]);
    assert_eq!(d.code, 0);
    let due = run(&["linkage", "examples/sand-screen.toml", "--step-deg", "90"]);
    assert_eq!(d.out, due.out);
    refused(
        &linkage_of(&without, &["--step-deg", "90", "--branch", "4"]),
        "there is no branch 4",
    );
    refused(
        &linkage_of(screen("22.6 deg", "60 deg"), &["--step-deg", "90"]),
        "has phi4 within 15 deg of start.phi4 = 60",
    );
}

/// Without a speed of the crank, and with one and an acceleration.
#[test]
fn certified_rates_are_by_the_cranks_angle_or_in_time() {
    let given = "crank_speed = \"1 rad/s\"\n";
    let faster = "crank_speed = \"3 rad/s\"\ncrank_acceleration = \"-2 rad/s^2\"\n";
    for speed in ["", faster] {
        let text = screen(given, speed);
        let rows = |more: &[&str]| {
            let d = linkage_of(&text, &[&["--step-deg", "120"], more].concat());
            assert_eq!(d.code, 0, "{}", d.err);
            d.out
        };
        let (floats, certified) = (rows(&[]), rows(&["--digits", "15"]));
        let (names, lines) = csv(&certified);
        assert!(lines.len() == 3 && names.len() > 15, "{certified}");
        for name in names {
            let due = column(&floats, &name);
            for (x, y) in column(&certified, &name).iter().zip(due) {
                assert!((x - y).abs() <= 1e-9 * (1.0 + y.abs()), "{name}: {x} {y}");
            }
        }
    }
}

#[test]
fn certified_digits_agree_with_floats_and_with_more_digits() {
    let file = "examples/sand-screen.toml";
    let few = run(&["linkage", file, "--step-deg", "60", "--digits", "20"]);
    assert_eq!(few.code, 0, "{}", few.err);
    let many = run(&["linkage", file, "--step-deg", "60", "--digits", "40"]);
    let floats = run(&["linkage", file, "--step-deg", "60"]);
    let (head, rows) = csv(&few.out);
    let more = csv(&many.out).1;
    for (k, name) in head.iter().enumerate() {
        let float = column(&floats.out, name);
        for (row, x) in rows.iter().zip(&float) {
            let certified: f64 = row[k].parse().unwrap();
            assert!(
                (certified - x).abs() <= 1e-11 * (1.0 + x.abs()),
                "{name}: {certified} {x}"
            );
        }
        if k > 1 {
            for (a, b) in rows.iter().zip(&more) {
                // The last digit may be rounded.
                assert_eq!(
                    a[k][..a[k].len().min(18)],
                    b[k][..a[k].len().min(18)],
                    "{name}"
                );
                let digits = |t: &str| {
                    let mantissa = t.split('e').next().unwrap();
                    let all: String = mantissa.chars().filter(char::is_ascii_digit).collect();
                    all.trim_start_matches('0').len()
                };
                assert_eq!(
                    (digits(&a[k]), digits(&b[k])),
                    (20, 40),
                    "{name}: {} {}",
                    a[k],
                    b[k]
                );
            }
        }
    }
    refused(
        &run(&["linkage", file, "--step-deg", "60", "--digits", "0"]),
        "--digits",
    );
}

#[test]
fn a_digit_left_open_is_a_finding() {
    // O3-O5 and links 3, 4, 5 form a kite: φ5 stays at 180 degrees, and of its zero rate no digit
    // can be certified.
    let file = br#"
        type = "class-iii"
        [geometry]
        l1 = "1 m"
        l2 = "5.6 m"
        l3 = "2 m"
        l4 = "2 m"
        l5 = "2 m"
        lb = "1 m"
        phi_b = "-40 deg"
        x3 = "5 m"
        y3 = "3 m"
        x5 = "7 m"
        y5 = "3 m"
        [start]
        phi1 = "10 deg"
        phi4 = "-105 deg"
    "#;
    let d = linkage_of(file, &["--step-deg", "360", "--digits", "20"]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    said(&d, "undecided: ");
    let (head, rows) = csv(&d.out);
    let cell = |name: &str| &rows[0][head.iter().position(|h| h == name).unwrap()];
    assert_eq!(cell("dphi5_dphi1"), "undecided");
    assert!(cell("phi2_deg").parse::<f64>().is_ok());
    let d = linkage_of(
        file,
        &["--step-deg", "360", "--digits", "20", "--all-branches"],
    );
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    said(&d, "undecided: ");
}

/// Masses have a drawing of their own.
#[test]
fn without_masses_there_is_one_drawing() {
    let (bare, _) = SCREEN.split_once("[bodies").unwrap();
    let missing = "reduced.svg is not drawn: the file gives no masses";
    for (text, drawn) in [
        (bare, &["mechanism.svg"][..]),
        (SCREEN, &["mechanism.svg", "reduced.svg"]),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let args = ["--step-deg", "90", "--svg", folder.path().to_str().unwrap()];
        let d = linkage_of(text, &args);
        assert_eq!(
            (d.code, names(folder.path())),
            (0, drawn.iter().map(|n| n.to_string()).collect())
        );
        assert_eq!(d.err.contains(missing), drawn.len() == 1, "{}", d.err);
    }
}
