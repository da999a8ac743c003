//! Studies of systems of equations and of linear algebra, as users run them.

use crate::common::{file, refused, run, run_on};
use tempfile::TempDir;

const SYSTEM: &str = r#"
[system]
unknowns  = { u = { near = 1 }, v = { near = -1.7 } }
equations = ["u^2 + v^2 = 4", "exp(u) + v = 1"]
"#;

const SOLVE: &str = r#"
[inputs]
A = { shape = ["n", "n"] }
b = { shape = ["n"] }
[outputs]
x = { solve = ["A", "b"] }
"#;

const BANDED: &str = r#"
[inputs]
A = { shape = ["n", "n"], banded = [1, 1] }
b = { shape = ["n"] }
[outputs]
x = { solve = ["A", "b"] }
"#;

/// A study without inputs has a value for a blank line.
#[test]
fn a_system_has_certified_digits() {
    let folder = TempDir::new().unwrap();
    let study = file(&folder, "system.toml", SYSTEM);
    let found = run_on("\n", &["eval", &study, "--digits", "12"]);
    assert_eq!(
        (found.code, &*found.out),
        (0, "1.00416873847,-1.72963728703\n")
    );
    let bad = SYSTEM.replace("exp(u)", "exp(w)");
    let bad = file(&folder, "bad.toml", &bad);
    refused(
        &run(&["eval", &bad, "--digits", "12"]),
        "line 4, column 36: the name w is not declared",
    );
}

#[test]
fn linear_systems_have_certified_digits() {
    let folder = TempDir::new().unwrap();
    let study = file(&folder, "solve.toml", SOLVE);
    let eval = |line: &str| run_on(line, &["eval", &study, "--digits", "10"]);
    let found = eval("2,1,1,3,1,2\n4,8\n");
    assert_eq!(
        (found.code, &*found.out),
        (0, "0.2000000000,0.6000000000\n2.000000000\n")
    );
    refused(
        &eval("1,2,2,4,1,1\n"),
        "refused: singular: the columns are dependent, by (",
    );
    refused(
        &eval("1,2,2,4,1\n"),
        "5 numbers are right for no n: A[n*n], b[n]",
    );
    let bad = SOLVE.replace("\"b\"] }\n", "\"c\"] }\n");
    let bad = file(&folder, "bad.toml", &bad);
    refused(
        &run(&["eval", &bad, "--digits", "10"]),
        "line 6, column 21: there is no input c",
    );
}

/// A line of 100 000 rows is longer than a MiB.
#[test]
fn long_banded_systems_are_solved() {
    let folder = TempDir::new().unwrap();
    let study = file(&folder, "banded.toml", BANDED);
    let n = 100_000;
    // 4 on the diagonal and 1 beside it; all entries of the solution are 1.
    let mut fields = Vec::new();
    for i in 0..n {
        fields.extend((i > 0).then_some("1.0000000000"));
        fields.push("4.0000000000");
        fields.extend((i + 1 < n).then_some("1.0000000000"));
    }
    for i in 0..n {
        fields.push(if i == 0 || i + 1 == n { "5" } else { "6" });
    }
    let found = run_on(fields.join(",") + "\n", &["eval", &study, "--digits", "8"]);
    assert_eq!(found.code, 0, "{}", found.err);
    let values: Vec<&str> = found.out.trim().split(',').collect();
    assert_eq!(values.len(), n);
    assert!(
        values.iter().all(|v| *v == "1.0000000"),
        "{}",
        &found.out[..80]
    );
}
