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
