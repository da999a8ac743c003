//! `mechaudit linkage` for four-bar linkages and slider-cranks, as its user meets it.

use crate::common::{Done, cells, changed, column, refused, run_on, said, texts, words};

const FOUR_BAR: &str = include_str!("../../examples/four-bar.toml");
const SLIDER: &str = include_str!("../../examples/slider-crank.toml");

/// Runs `linkage` on a description given on standard input.
fn linkage(text: &str, args: &[&str]) -> Done {
    run_on(text, &[&["linkage", "-"], args].concat())
}

fn four_bar(lengths: [&str; 4]) -> String {
    let [a, b, c, d] = lengths;
    format!(
        "type = \"four-bar\"\n[geometry]\ncrank = \"{a} cm\"\ncoupler = \"{b} cm\"\nrocker = \"{c} cm\"\nframe = \"{d} cm\"\n"
    )
}

fn slider(crank: &str, rod: &str, more: &str) -> String {
    format!(
        "type = \"slider-crank\"\n[geometry]\ncrank = \"{crank} m\"\nrod = \"{rod} m\"\n{more}\n"
    )
}

fn close(x: f64, y: f64) {
    assert!((x - y).abs() <= 1e-9 * (1.0 + y.abs()), "{x} {y}");
}

#[test]
fn certified_digits_are_those_of_known_numbers() {
    // Slider of a central crank 1, rod 2 at 60 deg: 1/2 + √(4 − 3/4) = 1/2 + √13/2.
    let d = linkage(
        &slider("1", "2", ""),
        &["--step-deg", "30", "--digits", "30"],
    );
    assert_eq!(d.code, 0, "{}", d.err);
    let x = texts(&d.out, "slider_m");
    assert_eq!(x[2], "2.30277563773199464655961063374");
    // An exact zero is written as `0`.
    let zeros = [
        ("phi2_deg", [0, 6]),
        ("dslider_dphi1_m_per_rad", [0, 6]),
        ("d2phi2_dphi1_2_per_rad", [0, 6]),
        ("dphi2_dphi1", [3, 9]),
    ];
    for (name, at) in zeros {
        let column = texts(&d.out, name);
        for (k, text) in column.iter().enumerate() {
            assert_eq!(text == "0", at.contains(&k), "{name} at {k}: {text}");
        }
    }
    // A parallelogram: the rocker follows the crank, the coupler stays.
    let d = linkage(
        &four_bar(["20", "50", "20", "50"]),
        &words("--from-deg 10 --to-deg 170 --step-deg 40 --digits 25"),
    );
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(texts(&d.out, "phi2_deg").iter().all(|t| t == "0"));
    assert_eq!(texts(&d.out, "phi3_deg")[1], "50.00000000000000000000000");
    said(&d, "change-point");
}

#[test]
fn a_crank_that_cannot_turn_gives_its_range_and_the_rows_within() {
    let d = linkage(&four_bar(["30", "40", "30", "35"]), &["--step-deg", "1"]);
    assert_eq!(d.code, 0);
    let limit = "it reaches from 15.358886 deg to 344.641114 deg";
    said(&d, limit);
    let p1 = column(&d.out, "phi1_deg");
    assert_eq!((p1[0], p1[p1.len() - 1], p1.len()), (16.0, 344.0, 329));
    // Crank longer than the rod: sin φ1 from −1/2 to 1/2, the ends, where derivatives do not exist,
    // included.
    for digits in [&[][..], &["--digits", "5"]] {
        let args = [&["--step-deg", "15"][..], digits].concat();
        let d = linkage(&slider("2", "1", ""), &args);
        assert_eq!(d.code, 0, "{}", d.err);
        let range =
            "from -30.000000 deg to 30.000000 deg and from 150.000000 deg to 210.000000 deg";
        said(&d, range);
        assert_eq!(
            column(&d.out, "phi1_deg"),
            [
                0.0, 15.0, 30.0, 150.0, 165.0, 180.0, 195.0, 210.0, 330.0, 345.0
            ]
        );
    }
    let d = linkage(
        &slider("2", "1", ""),
        &["--from-deg", "40", "--to-deg", "50", "--step-deg", "5"],
    );
    assert_eq!((d.code, d.out.lines().count()), (0, 1));
    said(&d, "no crank angle of the window");
}

#[test]
fn what_cannot_be_proved_is_undecided() {
    // A rhombus folded on itself: the joint stays at the crank's pivot and the rocker at rest, but
    // an enclosure cannot tell a small number from zero.
    let d = linkage(
        &four_bar(["20", "20", "20", "20"]),
        &words("--from-deg 90 --to-deg 90 --step-deg 1 --digits 10 --branch 1"),
    );
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    assert_eq!(texts(&d.out, "dphi3_dphi1"), ["undecided"]);
    assert_eq!(texts(&d.out, "phi2_deg"), ["-90.00000000"]);
    said(&d, "could not be certified to 10 digits");
}

#[test]
fn rows_in_the_units_asked_for() {
    let metric = linkage(SLIDER, &["--step-deg", "30", "--digits", "12"]);
    let d = linkage(
        SLIDER,
        &["--step-deg", "30", "--digits", "12", "--units", "µm"],
    );
    assert_eq!(d.code, 0, "{}", d.err);
    let digits = |text: &str, name: &str| -> Vec<String> {
        let all = texts(text, name);
        let digits = |t: &String| {
            t.replace(['.', '-'], "")
                .trim_start_matches('0')
                .to_string()
        };
        all.iter().map(digits).collect()
    };
    assert_eq!(digits(&metric.out, "slider_m"), digits(&d.out, "slider_um"));
    let (m, um) = (column(&metric.out, "slider_m"), column(&d.out, "slider_um"));
    assert!(m.len() == 12 && m.iter().zip(um).all(|(m, um)| (1e6 * m - um).abs() < 1e-5));
    refused(
        &linkage(SLIDER, &["--digits", "12", "--units", "inch"]),
        "from slider_m to slider_inch is no power of ten",
    );
    refused(
        &linkage(FOUR_BAR, &["--units", "kg"]),
        "no column can be in kg; the columns are phi1_deg, branch",
    );
    let json = linkage(
        SLIDER,
        &["--step-deg", "90", "--format", "json", "--units", "mm,rad"],
    );
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["columns"][0], "phi1_rad");
    assert!(json["rows"][1]["slider_mm"].as_f64().unwrap() > 1.0);
}

#[test]
fn a_json_description_is_the_same() {
    let json = r#"{"type": "four-bar", "crank_speed": "60 rpm", "geometry": {"crank": "100 mm",
        "coupler": "0.4 m", "rocker": "30 cm", "frame": "35 cm"}}"#;
    let args = ["--step-deg", "45", "--digits", "20"];
    assert_eq!(linkage(json, &args).out, linkage(FOUR_BAR, &args).out);
}

#[test]
fn refusals() {
    let args = ["--step-deg", "10"];
    let four_bar = r#"
        "10 cm"     | 10                         | geometry.crank = "10" has no unit
        "10 cm"     | "10 kg"                    | is not a length
        "10 cm"     | nan                        | geometry.crank
        "10 cm"     | "0 cm"                     | crank is 0 m; it has to be greater than zero
        "10 cm"     | "-1 cm"                    | crank is -0.01 m
        "10 cm"     | "105 cm"                   | has to be shorter than the other lengths together
        frame =     | rod =                      | unknown field `rod`
        frame =     | #                          | geometry.frame is missing
        [geometry]  | [bodies.2]                 | unknown field `2`, expected one of `crank`, `coupler`, `rocker`
        [geometry]  | [bodies.rocker]\nmass = "1 kg"\ninertia = "1 kg m^2"\ninertia_about = "pivot"\nradius = "2 m"\n[geometry] | the inertia of rocker about its pivot, 1 kg m^2, is less
        [geometry]  | [points.rod]\nP = ["1 m", "0 m"]\n[geometry] | points.rod is no link
        type =      | #                          | type is missing: it is "class-iii", "four-bar"
        "four-bar"  | "five-bar"                 | type = "five-bar" must be one of "class-iii", "four-bar", "slider-crank"
        "positive"  | "up"                       | start.assembly = "up" must be
        crank_speed | crank_acceleration         | is not an angular acceleration
    "#;
    let slider_crank = r#"
        "15 mm"        | "240 mm"  | offset of 0.24 m has to be shorter
        "0 deg"        | "0 mm"    | geometry.direction = "0 mm" is not an angle
        rod =          | coupler = | unknown field `coupler`
        "slider-crank" | 7         | line 2
    "#;
    for (example, changes) in [(FOUR_BAR, four_bar), (SLIDER, slider_crank)] {
        for [from, to, part] in cells(changes) {
            refused(&linkage(&changed(example, &from, &to), &args), &part);
        }
    }
    for (more, part) in [
        (
            &["--svg", "drawings", "--all-branches"][..],
            "--svg draws one branch",
        ),
        (
            &["--branch", "2"],
            "branches 0 (positive assembly) and 1 (negative)",
        ),
        (&["--to-deg", "-1"], "--to-deg -1 must not be less"),
        (&["--digits", "0"], "--digits"),
    ] {
        refused(&linkage(SLIDER, &[&args[..], more].concat()), part);
    }
    refused(
        &linkage(SLIDER, &["--step-deg", "0"]),
        "--step-deg must be positive",
    );
    let huge = format!("crank_speed = \"1e200 rad/s\"\n{}", slider("1", "2", ""));
    let d = linkage(&huge, &args);
    assert_eq!(d.code, 2);
    said(&d, "exceeds the range of floating-point numbers");
}

/// Where both assemblies meet there is a row, asked for alone or among others, in every form.
#[test]
fn a_change_point_has_a_row() {
    let text = four_bar(["10", "20", "40", "50"]);
    let whole = ["--from-deg", "0", "--to-deg", "360", "--step-deg", "1"];
    let d = linkage(&text, &whole);
    assert_eq!(d.out.lines().count(), 362);
    let row = d.out.lines().find(|l| l.starts_with("180,"));
    assert_eq!(row, Some("180,0,0,180,,,,,180,0"));
    let line = "at phi1 = 180 deg both branches meet (change point)";
    said(&d, line);
    let alone = ["--from-deg", "180", "--to-deg", "180"];
    let d = linkage(&text, &alone);
    assert_eq!(d.out.lines().nth(1), Some("180,0,0,180,,,,,180,0"));
    said(&d, line);
    assert!(!d.err.contains("no crank angle"), "{}", d.err);
    let d = linkage(&text, &[&alone[..], &["--format", "json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(json["singular_rows"][0]["phi1_deg"], 180.0);
    assert_eq!(json["rows"][0]["phi3_deg"], 180.0);
    assert!(json["rows"][0]["dphi3_dphi1"].is_null());
    let d = linkage(&text, &[&alone[..], &["--digits", "6"]].concat());
    assert_eq!(d.out.lines().nth(1), Some("180,0,0,180.000,,,,,180.000,0"));
    let d = linkage(&text, &[&whole[..], &["--format", "html"]].concat());
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(d.out.contains("At phi1 = 180 deg both branches meet"));
    // The end of a range: the rod is square to the guide.
    let d = linkage(
        &slider("2", "1", ""),
        &["--from-deg", "30", "--to-deg", "30"],
    );
    said(&d, "at phi1 = 30 deg both branches meet (end of the range)");
    close(column(&d.out, "slider_m")[0], 3f64.sqrt());
}
