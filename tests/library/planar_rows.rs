//! Certified rows of mechanisms of every kind of joint beside mpmath
//! (`reference/independent/planar_rows.csv`), and of all examples beside the solver's.

use mechaudit::reference::{Decimal, nearest_f64};
use mechaudit::solvers::planar::State;
use mechaudit_cli::machine::planar::{
    Branch, Certifier, Columns, Machine, Reach, certified_names, choose, names, values,
};
use mechaudit_cli::machine::{self, Source};
use rug::Rational;
use std::path::Path;

const WITNESS: &str = include_str!("../../reference/independent/planar_rows.csv");
const DIGITS: u32 = 30;

/// A planet wheel about a fixed wheel, whose pin moves a block by a link.
const EPICYCLIC: &str = r#"
type = "planar"
[ground]
points = { O = ["0 cm", "0 cm"], L = ["1 cm", "2 cm"] }
[[body]]
name = "arm"
ends = ["O", "P"]
length = "7 cm"
[[body]]
name = "planet"
ends = ["P", "F"]
length = "2 cm"
[[body]]
name = "link"
ends = ["F", "E"]
length = "11 cm"
[[body]]
name = "block"
points = { E = ["0 m", "0 m"] }
[[joint]]
kind = "pin"
point = "O"
[[joint]]
kind = "pin"
point = "P"
[[joint]]
kind = "pin"
point = "F"
[[joint]]
kind = "pin"
point = "E"
[[joint]]
kind = "gears"
wheels = ["ground", "planet"]
carrier = "arm"
teeth = [40, 30]
phase = "10 deg"
[[joint]]
kind = "slide"
name = "line"
body = "block"
point = "E"
through = "L"
direction = "20 deg"
turn = "1 rad"
[drive]
body = "arm"
[start]
at = "0 deg"
near = { link = "43 deg" }
"#;

/// A slot along a side of a triangle that is given by its sides.
const HUNG_LEVER: &str = r#"
type = "planar"
[ground]
points = { O = ["0 m", "0 m"], C = ["0 m", "3 m"] }
[[body]]
name = "crank"
ends = ["C", "A"]
length = "1 m"
[[body]]
name = "plate"
ends = ["O", "B", "T"]
sides = ["6 m", "5 m", "4 m"]
clockwise = true
[[joint]]
kind = "pin"
point = "O"
[[joint]]
kind = "pin"
point = "C"
[[joint]]
kind = "slot"
name = "slot"
body = "crank"
point = "A"
on = "plate"
through = "O"
toward = "T"
[drive]
body = "crank"
[start]
at = "90 deg"
near = { plate = "145 deg" }
"#;

fn q(text: &str) -> Rational {
    Decimal::parse(text).expect("a number").value
}

fn examples() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"))
}

fn read(name: &str) -> Machine {
    let text = match name {
        "epicyclic" => EPICYCLIC.into(),
        "hung-lever" => HUNG_LEVER.into(),
        _ => std::fs::read_to_string(examples().join(format!("{name}.toml"))).expect("a file"),
    };
    Machine::read(&Source::toml(text)).expect(name)
}

/// The branch that the file means.
fn branch(machine: &Machine) -> Branch {
    let at = machine.start.at.unwrap_or_default();
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    choose(machine, at, None).expect("a branch")
}

/// The solver's position at a drive in degrees or metres; none where the branch does not reach.
fn state(machine: &Machine, branch: &Branch, value: &Rational) -> Option<State> {
    let value = nearest_f64(value);
    let drive = if machine.rotary() {
        value.to_radians()
    } else {
        value
    };
    let at = branch.turned_to(machine, drive)?;
    machine.solver.follow(&branch.start, machine.inner(at)).ok()
}

/// Each value and its derivatives are those of closed forms, to 29 digits.
#[test]
fn mpmath_agrees_to_twenty_nine_digits() {
    let mut rows = 0;
    for line in WITNESS.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, drive, quantity, due @ ..] = &cells[..] else {
            panic!("{line}");
        };
        let machine = read(name);
        let certifier = Certifier::new(&machine, DIGITS).expect(name);
        let value = q(drive);
        let state = state(&machine, &branch(&machine), &value).expect(line);
        let row = certifier.row(&value, &state, true);
        assert_eq!(row.digits.len() + 2, certified_names(&machine, true).len());
        let base = quantity.trim_end_matches("_deg").trim_end_matches("_m");
        let columns = [
            quantity.to_string(),
            format!("d{base}_d"),
            format!("d2{base}_d"),
        ];
        for (column, due) in columns.iter().zip(due) {
            let names = certified_names(&machine, true);
            let k = names.iter().position(|n| n.starts_with(column.as_str()));
            let found = row.digits[k.expect(column) - 2].as_deref().expect(line);
            let (found, due) = (q(found), q(due));
            let gap = Rational::from(&found - &due).abs();
            let unit = due.abs() * q("1e-29");
            assert!(gap <= unit, "{line}: {column} {}", nearest_f64(&found));
        }
        rows += 1;
    }
    assert_eq!(rows, 106);
}

/// Every planar example has certified rows on the branch that its file means, and the solver's rows
/// are near them.
#[test]
fn all_planar_examples_have_certified_rows() {
    let columns = Columns {
        paths: true,
        reactions: false,
    };
    let mut files = 0;
    for entry in std::fs::read_dir(examples()).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a file");
        let Ok(machine::Linkage::Planar(mut machine)) = machine::Linkage::read(&Source::toml(text))
        else {
            continue;
        };
        // The solver's columns are derivatives by the drive, as certified ones are.
        machine.speed = None;
        let branch = match machine.start.at {
            Some(_) => branch(&machine),
            None => choose(&machine, 0.0, Some(0)).expect("a branch"),
        };
        let certifier = Certifier::new(&machine, DIGITS).expect("exact numbers");
        let (all, due) = (names(&machine, columns), certified_names(&machine, true));
        // Even steps in thousandths of a degree, between the ends of a branch that has some.
        let between = |from: f64, to: f64| {
            let at = |k: f64| from + (to - from) * (k + 0.5) / 12.0;
            let degrees = (0..12).map(|k| (at(k.into()).to_degrees() * 1e3).round());
            let exact = degrees.map(|d| Rational::from_f64(d).expect("finite") / 1000u32);
            exact.collect()
        };
        let drives: Vec<Rational> = match (&machine.exact_window, branch.reach) {
            (Some([from, to, _]), _) => (0..5)
                .map(|k| Rational::from(to - from) * Rational::from((k, 4)) + from)
                .collect(),
            (None, Reach::Part { low, high }) => {
                let [low, high] = [low, high].map(|end| end.expect("an end").drive);
                between(low, high)
            }
            (None, Reach::Whole { .. }) => (0..12).map(|k| Rational::from(30 * k + 7)).collect(),
        };
        let mut rows = 0;
        for value in &drives {
            let Some(state) = state(&machine, &branch, value) else {
                continue;
            };
            let row = certifier.row(value, &state, true);
            let floats = values(&machine, branch.loads.as_ref(), &state, columns);
            for (name, digits) in due[2..].iter().zip(&row.digits) {
                let k = all.iter().position(|n| n == name).expect(name) - 2;
                let Some(digits) = digits else {
                    // The inversor's straight line and the ram's: no proof finds that a derivative
                    // is zero everywhere on a line.
                    let stem = path.file_stem().expect("a name").to_string_lossy();
                    let straight = [("peaucellier-cell", "x_D_d"), ("quick-return", "y_C_d")]
                        .iter()
                        .any(|(file, column)| stem == *file && name.contains(column));
                    let zero = floats[k].abs() < 1e-12;
                    assert!(straight && zero, "{path:?} {name}: {:?}", row.reason);
                    continue;
                };
                let due = nearest_f64(&q(digits));
                let apart = (due - floats[k]).abs();
                assert!(
                    apart < 1e-10 * (1.0 + due.abs()),
                    "{path:?} {name}: {due} {}",
                    floats[k]
                );
            }
            rows += 1;
        }
        assert_eq!(rows, drives.len(), "{path:?}");
        files += 1;
    }
    assert!(files >= 16, "{files}");
}
