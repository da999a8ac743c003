//! `mechaudit motion` for mechanisms, as its user meets it.

use crate::common::{column, command, csv, file, run, run_on, said};
use crate::motion::agree;
use std::f64::consts::PI;
use tempfile::tempdir;

const EXAMPLES: [&str; 5] = [
    "four-bar-damped",
    "four-bar-spring",
    "slider-crank-damped",
    "double-pendulum",
    "watt-six-bar",
];

fn table(line: &str) -> String {
    let d = command(line);
    assert_eq!(d.code, 0, "{line}: {}", d.err);
    d.out
}

/// The solver's kinematics and the enclosed solution of the formulas share nothing, and agree.
#[test]
fn floating_point_agrees_with_certified_digits() {
    for name in EXAMPLES {
        let line = format!("motion examples/motion/{name}.toml --times 0:0.4:0.2 --format csv");
        let (found, due) = (table(&line), table(&format!("{line} --digits 15")));
        let names: Vec<&str> = found.lines().next().unwrap().split(',').collect();
        assert_eq!(due.lines().next().unwrap(), names.join(","));
        for of in &names[1..] {
            for (x, y) in column(&found, of).iter().zip(column(&due, of)) {
                assert!(
                    (x - y).abs() < 1e-9 * (1.0 + y.abs()),
                    "{name} {of}: {x} {y}"
                );
            }
        }
    }
}

/// Values of mpmath in other coordinates, to 22 digits.
const WITNESS: &str = include_str!("../../reference/independent/mechanism_motion.csv");

#[test]
fn certified_motions_are_those_of_mpmath() {
    let mut compared = 0;
    for name in EXAMPLES {
        let due = csv(WITNESS).1.into_iter().filter(|row| row[0] == name);
        let due: Vec<Vec<String>> = due.collect();
        let path = format!("examples/motion/{name}.toml");
        let (head, rows) = csv(&table(&format!(
            "motion {path} --times 0.05,0.1 --digits 20 --format csv"
        )));
        for row in due {
            let k = head.iter().position(|h| *h == row[2]).unwrap();
            let found = rows.iter().find(|r| r[0] == row[1]).unwrap();
            assert!(agree(&found[k], &row[3], 20), "{row:?} {}", found[k]);
            compared += 1;
        }
    }
    assert_eq!(compared, 68);
}

/// The loop of the four-bar stays closed, and the crank turns to and fro.
#[test]
fn a_four_bar_swings() {
    let out = table("motion examples/motion/four-bar-damped.toml --times 0:5:0.01 --format csv");
    let [a, b, c] = ["crank", "coupler", "rocker"].map(|n| column(&out, &format!("theta_{n}")));
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        let x = 0.1 * a.cos() + 0.4 * b.cos() - 0.35 - 0.3 * c.cos();
        let y = 0.1 * a.sin() + 0.4 * b.sin() - 0.3 * c.sin();
        assert!(x.hypot(y) < 1e-14, "{x} {y}");
    }
    assert!((a[0] - PI / 3.0).abs() < 1e-15);
    let rates = column(&out, "omega_crank");
    assert!(rates.windows(2).filter(|w| w[0] * w[1] < 0.0).count() > 5);
}

#[test]
fn a_motion_ends_at_an_event() {
    let folder = tempdir().unwrap();
    let text = include_str!("../../examples/motion/four-bar-damped.toml");
    let text = text.replace(
        "[motion.start]",
        "[motion]\nuntil = \"omega_crank\"\n[motion.start]",
    );
    let path = file(&folder, "m.toml", &text);
    let d = run(&["motion", &path, "--times", "0:5:0.1", "--format", "csv"]);
    assert_eq!(d.code, 0, "{}", d.err);
    said(&d, "motion.until changes its sign at t = ");
    let found = d.out.clone();
    let rates = column(&found, "omega_crank");
    assert!(rates[rates.len() - 1].abs() < 1e-9, "{rates:?}");
    assert!(rates[..rates.len() - 1].iter().all(|w| *w > 0.0));
    // The same end with every digit certified.
    let d = run(&[
        "motion", &path, "--times", "0:5:0.1", "--digits", "15", "--format", "csv",
    ]);
    assert_eq!(d.code, 0, "{}", d.err);
    said(&d, "motion.until changes its sign at t = ");
    let exact = column(&d.out, "omega_crank");
    assert_eq!((exact.len(), exact.last()), (rates.len(), Some(&0.0)));
    let times = column(&d.out, "t");
    let found = column(&found, "t");
    assert!((times[times.len() - 1] - found[found.len() - 1]).abs() < 1e-10);
}

/// The forces on a rocker and on the rest of a machine, certified and not.
#[test]
fn forces_in_joints_along_a_motion() {
    let line =
        "motion examples/motion/four-bar-damped.toml --times 0:0.4:0.2 --reactions --format csv";
    let (found, due) = (table(line), table(&format!("{line} --digits 15")));
    let names: Vec<&str> = found.lines().next().unwrap().split(',').collect();
    let forces: Vec<&&str> = names.iter().filter(|n| n.starts_with('F')).collect();
    assert_eq!(forces.len(), 8, "{names:?}");
    for of in forces {
        for (x, y) in column(&found, of).iter().zip(column(&due, of)) {
            assert!((x - y).abs() < 1e-8 * (1.0 + y.abs()), "{of}: {x} {y}");
        }
    }
    let d = command("motion examples/studies/motion/lorenz.toml --times 1 --reactions");
    assert_eq!(d.code, 2);
    said(&d, "--reactions are those of a mechanism's joints");
}

#[test]
fn bad_files_and_arguments_exit_with_two() {
    let folder = tempdir().unwrap();
    let good = include_str!("../../examples/motion/slider-crank-damped.toml");
    for (k, (text, due)) in [
        (
            good.replace("omega_crank", "omega_crnk"),
            "the names are t, theta_crank, omega_crank",
        ),
        (
            good.replace("[motion.near]\nrod = \"-8 deg\"", ""),
            "which position? there are ",
        ),
        (
            good.replace("mass", "# mass")
                .replace("inertia", "# ")
                .replace("centre", "# "),
            "no body has a mass",
        ),
        (
            good.replace("35 cm", "3 cm"),
            "the mechanism cannot be assembled at the start",
        ),
        (
            good.replace("crank = { at", "slide = { at"),
            "motion.start.slide = \"slide\" is no body",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let path = file(&folder, &format!("{k}.toml"), &text);
        let d = run(&["motion", &path, "--times", "0:1:0.5"]);
        assert_eq!((d.code, d.out.as_str()), (2, ""), "{due}: {}", d.err);
        said(&d, due);
        assert_eq!(d.err.lines().count(), 1, "{}", d.err);
    }
    let early = command("motion examples/motion/double-pendulum.toml --times=-1:1:0.5");
    assert_eq!(early.code, 2);
    said(&early, "comes before the start 0");
}

/// The motion is a study: simulations are judged by it, and it is evaluated at a time.
#[test]
fn a_mechanism_is_a_study() {
    let machine = "examples/motion/double-pendulum.toml";
    let folder = tempdir().unwrap();
    let rows = table(&format!("motion {machine} --times 0:0.2:0.1 --format csv"));
    let path = file(&folder, "sim.csv", &rows);
    let d = run(&["judge", machine, "--table", &path]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    assert!(
        d.out.contains("12 of 12 entries within budget"),
        "{}",
        d.out
    );
    let wrong = rows.replacen("0.1,0.4", "0.1,0.5", 1);
    assert_ne!(wrong, rows);
    let path = file(&folder, "wrong.csv", &wrong);
    let d = run(&["judge", machine, "--table", &path]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    let d = run_on("0.1\n", &["eval", machine, "--digits", "15"]);
    let due = table(&format!(
        "motion {machine} --times 0.1 --digits 15 --format csv"
    ));
    assert_eq!(
        format!("0.1,{}", d.out),
        due.lines().nth(1).unwrap().to_string() + "\n"
    );
}
