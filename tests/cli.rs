//! The program as its user meets it: output, messages and exit codes.
#![cfg(feature = "cli")]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const SCREEN: &str = include_str!("../examples/sand-screen.toml");

fn program() -> Command {
    let mut c = Command::new(env!("CARGO_BIN_EXE_mechaudit"));
    c.current_dir(env!("CARGO_MANIFEST_DIR"));
    c.env_remove("MECHAUDIT_EFFORT");
    c
}

struct Done {
    code: i32,
    out: String,
    err: String,
}

fn done(o: Output) -> Done {
    Done {
        code: o.status.code().expect("no signal"),
        out: String::from_utf8(o.stdout).expect("UTF-8"),
        err: String::from_utf8(o.stderr).expect("UTF-8"),
    }
}

fn run(args: &[&str]) -> Done {
    done(program().args(args).output().unwrap())
}

/// Runs `linkage` on a description given on standard input.
fn linkage_of(text: &[u8], args: &[&str]) -> Done {
    let mut child = program()
        .args(["linkage", "-"])
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A refusal of the arguments closes the pipe early.
    let _ = child.stdin.take().unwrap().write_all(text);
    done(child.wait_with_output().unwrap())
}

/// One line on stderr that says `part`, nothing on stdout, exit code 2.
fn refused(d: &Done, part: &str) {
    assert_eq!(d.code, 2, "{}{}", d.out, d.err);
    assert_eq!(d.err.lines().count(), 1, "{}", d.err);
    assert!(d.err.starts_with("mechaudit: "), "{}", d.err);
    assert!(d.err.contains(part), "{part:?} is missing in {}", d.err);
    assert_eq!(d.out, "");
    assert!(!d.err.contains("panicked"));
}

fn screen(from: &str, to: &str) -> Vec<u8> {
    let text = SCREEN.replacen(from, to, 1);
    assert_ne!(text, SCREEN, "{from:?} is not in the example");
    text.into_bytes()
}

fn csv(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let split = |l: &str| l.split(',').map(String::from).collect::<Vec<_>>();
    let mut lines = text.lines();
    let head = split(lines.next().expect("a header"));
    let rows: Vec<Vec<String>> = lines.map(split).collect();
    assert!(rows.iter().all(|r| r.len() == head.len()));
    (head, rows)
}

fn column(text: &str, name: &str) -> Vec<f64> {
    let (head, rows) = csv(text);
    let k = head.iter().position(|h| h == name).expect(name);
    rows.iter()
        .map(|r| r[k].parse().expect("a number"))
        .collect()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut all: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    all.sort();
    all
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn help_and_version() {
    for args in [
        vec!["--help"],
        vec!["audit", "--help"],
        vec!["list", "--help"],
        vec!["paper", "--help"],
        vec!["linkage", "--help"],
        vec!["eval", "--help"],
        vec!["runup", "--help"],
        vec!["points", "--help"],
        vec!["judge", "--help"],
        vec!["hunt", "--help"],
        vec!["converge", "--help"],
        vec!["completions", "--help"],
        vec!["man", "--help"],
    ] {
        let d = run(&args);
        assert_eq!((d.code, d.err.as_str()), (0, ""));
        assert!(d.out.contains("Examples:"), "{}", d.out);
    }
    let d = run(&["--version"]);
    assert_eq!(
        d.out.trim(),
        concat!("mechaudit ", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn completions_and_manual_pages() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let d = run(&["completions", shell]);
        assert!(d.code == 0 && d.out.contains("check-point"), "{shell}");
    }
    let d = run(&["man"]);
    assert!(
        d.code == 0 && d.out.contains(".TH mechaudit 1"),
        "{}",
        d.out
    );
    let to = folder();
    let d = run(&["man", "--output", text(to.path())]);
    assert_eq!((d.code, d.out.as_str()), (0, ""));
    let all = names(to.path());
    for name in ["mechaudit.1", "mechaudit-audit.1", "mechaudit-hunt.1"] {
        assert!(all.iter().any(|n| n == name), "{all:?}");
    }
}

#[test]
fn bad_usage() {
    refused(&run(&["frobnicate"]), "frobnicate");
    refused(&run(&["--seed", "x"]), "--seed");
    refused(
        &run(&["audit", "no-such-method"]),
        "there is no method \"no-such-method\"; there are: ",
    );
    refused(
        &run(&["audit", "four-bar", "--region", "nowhere"]),
        "has no region \"nowhere\"; it has: ",
    );
    refused(
        &run(&["audit", "four-bar", "--check-point", "none"]),
        "has no check point",
    );
    refused(
        &run(&["paper", "no-such-paper"]),
        "there is no paper \"no-such-paper\"",
    );
    for bad in ["0", "-1", "nan", "inf", "much", ""] {
        let d = done(
            program()
                .args(["audit", "four-bar"])
                .env("MECHAUDIT_EFFORT", bad)
                .output()
                .unwrap(),
        );
        refused(&d, "MECHAUDIT_EFFORT");
    }
}

#[test]
fn effort_multiplies_the_cases() {
    let cases = |effort: Option<&str>| {
        let mut c = program();
        c.args(["audit", "four-bar", "--cases", "4", "--format", "json"]);
        effort.map(|e| c.env("MECHAUDIT_EFFORT", e));
        let d = done(c.output().unwrap());
        assert_eq!(d.code, 0, "{}", d.out);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        v["methods"][0]["settings"]["cases_per_region"]
            .as_u64()
            .unwrap()
    };
    assert_eq!(
        (cases(None), cases(Some("0.5")), cases(Some("2"))),
        (4, 2, 8)
    );
}

#[test]
fn the_list_names_every_method() {
    let d = run(&["list"]);
    assert_eq!((d.code, d.err.as_str()), (0, ""));
    let json: serde_json::Value =
        serde_json::from_str(&run(&["list", "--format", "json"]).out).unwrap();
    let listed = json["methods"].as_array().unwrap();
    let methods = mechaudit::methods::registry();
    assert_eq!(listed.len(), methods.len());
    for m in methods {
        assert!(d.out.contains(m.name()));
        assert!(m.domain().regions.iter().all(|r| d.out.contains(r.name)));
    }
}

#[test]
fn the_reproduce_command_works() {
    use mechaudit::audit::{Case, Draw, Origin, hex_float};
    for m in mechaudit::methods::registry() {
        let domain = m.domain();
        let Some(region) = domain.regions.first() else {
            continue;
        };
        let input = (region.sample)(&mut Draw::new(9, m.name(), region.name, 3));
        let mut cases = vec![Case {
            method: m.name(),
            region: region.name,
            input,
            origin: Origin::Random { seed: 9, index: 3 },
        }];
        cases.extend(domain.check_points.first().map(|p| Case {
            method: m.name(),
            region: "check-points",
            input: p.input.clone(),
            origin: Origin::CheckPoint { name: p.name },
        }));
        for case in cases {
            let command = case.reproduce();
            let args: Vec<&str> = command.split(' ').skip(1).collect();
            let d = run(&args);
            assert_eq!(d.code, 0, "{command}\n{}{}", d.out, d.err);
            assert!(d.out.contains(&command), "{}", d.out);
            for x in &case.input {
                assert!(d.out.contains(&hex_float(*x)), "{}", d.out);
            }
            let json = run(&[&args[..], &["--format", "json"]].concat());
            let v: serde_json::Value = serde_json::from_str(&json.out).unwrap();
            assert_eq!(v["reproduce"], command.as_str());
            assert_eq!(v["passed"], true);
        }
    }
}

#[test]
fn a_region_alone_and_everything() {
    let d = run(&[
        "audit",
        "four-bar",
        "--cases",
        "3",
        "--region",
        first_region("four-bar"),
    ]);
    assert_eq!(d.code, 0);
    assert!(d.out.contains("3 of 3 cases"), "{}", d.out);
    assert!(
        d.out.contains("seed 1, 3 random cases per region"),
        "{}",
        d.out
    );
}

fn first_region(method: &str) -> &'static str {
    mechaudit::methods::find(method).unwrap().domain().regions[0].name
}

#[test]
fn pipes_have_no_colour() {
    for (key, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
        let mut c = program();
        c.args(["audit", "four-bar", "--cases", "1"])
            .env(key, value);
        let d = done(c.output().unwrap());
        assert!(!d.out.contains('\u{1b}') && !d.err.contains('\u{1b}'));
        assert!(d.out.lines().all(|l| l.chars().count() <= 100), "{}", d.out);
    }
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let mut child = program()
        .args(["linkage", "examples/sand-screen.toml", "--step-deg", "0.01"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let d = done(child.wait_with_output().unwrap());
    assert_eq!((d.code, d.err.as_str()), (0, ""));
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
    assert!(d.err.contains("the crank turns fully"), "{}", d.err);
    assert!(
        d.err
            .contains("14.426037 deg (stretched), 196.014059 deg (folded)"),
        "{}",
        d.err
    );
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
    let slow = linkage_of(SCREEN.as_bytes(), &step);
    let fast = linkage_of(&screen("\"1 rad/s\"", "\"4 rad/s\""), &step);
    let ratio = linkage_of(&screen("crank_speed = \"1 rad/s\"", ""), &step);
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
    let d = run(&[
        "linkage",
        "examples/sand-screen.toml",
        "--step-deg",
        "45",
        "--format",
        "json",
    ]);
    let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(v["full_rotation"], true);
    assert_eq!(v["turns_to_close"], 1);
    assert_eq!(v["dead_positions"].as_array().unwrap().len(), 2);
    assert_eq!(v["rows"].as_array().unwrap().len(), 8);
    assert_eq!(v["rows"][0]["phi1_deg"], 14.426);
    let d = run(&[
        "linkage",
        "examples/no-full-turn.toml",
        "--step-deg",
        "45",
        "--format",
        "json",
    ]);
    let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(v["full_rotation"], false);
    let end = |k: &str| v["crank_range"][k]["phi1_deg"].as_f64().unwrap();
    assert!(end("from") < end("to"));
}

#[test]
fn a_part_of_a_turn_is_an_answer() {
    let d = run(&["linkage", "examples/no-full-turn.toml", "--step-deg", "5"]);
    assert_eq!(d.code, 0);
    assert!(
        d.err
            .contains("the crank cannot turn fully on this branch: it reaches from -96.62"),
        "{}",
        d.err
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
    assert!(d.err.contains("no crank angle of the window"), "{}", d.err);
}

#[test]
fn all_branches_with_folds() {
    let d = run(&[
        "linkage",
        "examples/sand-screen.toml",
        "--step-deg",
        "7.5",
        "--all-branches",
    ]);
    assert_eq!(d.code, 0);
    assert!(d.err.contains("from 2 to 4 assembly modes"), "{}", d.err);
    assert!(d.err.contains("fold at phi1 = 217.270876"), "{}", d.err);
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
        &linkage_of(&screen("22.6 deg", "60 deg"), &["--step-deg", "90"]),
        "has phi4 within 15 deg of start.phi4 = 60",
    );
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
    assert!(d.err.contains("undecided: "), "{}", d.err);
    let (head, rows) = csv(&d.out);
    let cell = |name: &str| &rows[0][head.iter().position(|h| h == name).unwrap()];
    assert_eq!(cell("dphi5_dphi1"), "undecided");
    assert!(cell("phi2_deg").parse::<f64>().is_ok());
}

#[test]
fn bad_files() {
    let step = ["--step-deg", "10"];
    let bad = |text: &[u8], part: &str| refused(&linkage_of(text, &step), part);
    bad(b"", "the file is empty");
    bad(b" \n\t\n", "the file is empty");
    bad(b"name = \"\xff\xfe\"", "not UTF-8");
    bad(b"[geometry", "line 1");
    bad(b"{\"geometry\": ", "line 1");
    bad(b"name = \"x\"", "[geometry] is missing");
    bad(&screen("l5 = \"48.5 cm\"", ""), "geometry.l5 is missing");
    bad(
        &screen("l5 = \"48.5 cm\"", "l5 = 48.5"),
        "write for instance \"48.5 cm\"",
    );
    bad(&screen("l5 = \"48.5 cm\"", "l5 = nan"), "geometry.l5");
    bad(
        &screen("l5 = \"48.5 cm\"", "l5 = \"nan cm\""),
        "geometry.l5",
    );
    bad(
        &screen("l5 = \"48.5 cm\"", "l5 = \"48.5 kg\""),
        "is not a length",
    );
    bad(
        &screen("l5 = \"48.5 cm\"", "l5 = \"1e400 cm\""),
        "l5 = inf is not a finite number",
    );
    bad(
        &screen("l5 = \"48.5 cm\"", "l5 = true"),
        "a string with a number and its unit",
    );
    bad(
        &screen("l5 = ", "l7 = \"1 cm\"\nl5 = "),
        "unknown field `l7`",
    );
    bad(
        &screen("\"550 kg\"", "\"-550 kg\""),
        "mass of link 4 = -550 kg must not be negative",
    );
    bad(
        &screen("\"18 kg m^2\"", "\"18 kg\""),
        "is not a moment of inertia",
    );
    bad(&screen("[bodies.5]", "[bodies.9]"), "[bodies.9]");
    bad(&screen("class-iii", "class-ix"), "type = \"class-ix\"");
    bad(
        include_bytes!("../examples/unassemblable.toml"),
        "cannot be assembled",
    );
    refused(
        &run(&["linkage", "no/such/file.toml", "--step-deg", "1"]),
        "no/such/file.toml",
    );
    refused(
        &run(&["linkage", "examples", "--step-deg", "1"]),
        "examples",
    );
}

#[test]
fn bad_steps_and_windows() {
    let with = |args: &[&str]| run(&[&["linkage", "examples/sand-screen.toml"], args].concat());
    for step in ["0", "-1", "-0.0"] {
        refused(&with(&["--step-deg", step]), "--step-deg must be positive");
    }
    for step in ["nan", "inf", "x", ""] {
        refused(&with(&["--step-deg", step]), "--step-deg");
    }
    refused(
        &with(&["--step-deg", "1e-9"]),
        "more than 10000000 crank angles",
    );
    refused(&with(&["--step-deg", "1e-99999"]), "take a larger step");
    refused(
        &with(&["--step-deg", "1e-4", "--all-branches"]),
        "more than 100000",
    );
    refused(
        &with(&["--step-deg", "1", "--from-deg", "9", "--to-deg", "8"]),
        "--to-deg 8",
    );
    // Without a step: every 7.5 degrees.
    let d = with(&[]);
    assert_eq!((d.code, d.out.lines().count()), (0, 49));
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let folder = folder();
    let at = folder.path().join("rows.csv");
    let args = ["linkage", "examples/sand-screen.toml", "--step-deg", "60"];
    let d = run(&[&args[..], &["--output", text(&at)]].concat());
    assert_eq!((d.code, d.out.as_str()), (0, ""));
    let direct = run(&args);
    assert_eq!(std::fs::read_to_string(&at).unwrap(), direct.out);
    assert_eq!(names(folder.path()), ["rows.csv"]);
    // A refusal leaves the old file alone.
    let bad = [
        "linkage",
        "examples/unassemblable.toml",
        "--step-deg",
        "60",
        "--output",
        text(&at),
    ];
    refused(&run(&bad), "cannot be assembled");
    assert_eq!(std::fs::read_to_string(&at).unwrap(), direct.out);
    assert_eq!(names(folder.path()), ["rows.csv"]);
    let nowhere: PathBuf = folder.path().join("missing").join("rows.csv");
    refused(
        &run(&[&args[..], &["--output", text(&nowhere)]].concat()),
        "cannot write",
    );
}

#[test]
fn drawings() {
    let folder = folder();
    let dir = folder.path().join("drawings");
    for (file, due) in [
        ("examples/sand-screen.json", vec!["mechanism.svg"]),
        (
            "examples/sand-screen.toml",
            vec!["mechanism.svg", "reduced.svg"],
        ),
        (
            "examples/no-full-turn.toml",
            vec!["mechanism.svg", "reduced.svg"],
        ),
    ] {
        let d = run(&["linkage", file, "--step-deg", "60", "--svg", text(&dir)]);
        assert_eq!(d.code, 0, "{}", d.err);
        assert_eq!(names(&dir), due);
        for name in due {
            let svg = std::fs::read_to_string(dir.join(name)).unwrap();
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
        }
    }
}

#[test]
fn papers_in_every_form() {
    for key in mechaudit::papers::keys() {
        let form = |f: &str| run(&["paper", key, "--format", f]);
        let d = form("json");
        assert_eq!(d.code, 0, "{}", d.err);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        let entries = v["entries"].as_array().unwrap();
        let lines: usize = entries
            .iter()
            .map(|e| e["variants"].as_object().unwrap().len())
            .sum();
        assert_eq!(form("csv").out.lines().count(), 1 + lines);
        let html = form("html").out;
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        assert!(!html.contains("http") && !html.contains("<script"));
        assert!(!form("text").out.contains('\u{1b}'));
    }
}

#[test]
fn a_drawing_folder_that_cannot_be_made_stops_the_run_before_any_row() {
    for file in ["examples/sand-screen.toml", "examples/four-bar.toml"] {
        let d = run(&["linkage", file, "--svg", "README.md"]);
        refused(&d, "cannot make the folder README.md");
    }
}

#[test]
fn ledgers_in_every_form() {
    for key in mechaudit::papers::keys() {
        let form = |f: &str| run(&["paper", key, "--ledger", "--format", f]);
        let d = form("json");
        assert_eq!(d.code, 0, "{}", d.err);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        assert!(v["entries"].as_array().unwrap().len() > 50);
        let html = form("html").out;
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        assert!(!html.contains("http") && !html.contains("<script"));
        assert!(html.contains("<math"));
        assert!(form("latex").out.contains(r"\begin{document}"));
        let words = form("text").out;
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("all as recorded"), "{words}");
        refused(&form("csv"), "a ledger has no CSV form");
        refused(&run(&["paper", key, "--format", "latex"]), "add --ledger");
    }
    refused(
        &run(&["paper", "none", "--ledger"]),
        "there is no paper \"none\"",
    );
}

#[test]
fn errata_are_written_whole_and_checked() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("errata.json");
    let errata = |check: bool| {
        let mut args = vec!["paper", "zinchenko", "--ledger", "--format", "errata"];
        args.extend(["--output", text(&file)]);
        args.extend(check.then_some("--check"));
        run(&args)
    };
    refused(&errata(true), "cannot read");
    assert_eq!(errata(false).code, 0);
    assert_eq!(errata(true).code, 0);
    std::fs::write(&file, "{}").unwrap();
    let d = errata(true);
    assert_eq!(d.code, 1);
    assert!(d.err.contains("is not up to date"), "{}", d.err);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "{}");
    refused(&run(&["paper", "zinchenko", "--check"]), "--ledger");
}
