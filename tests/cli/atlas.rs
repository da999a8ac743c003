//! The atlas of published algorithms.

use crate::common::{Done, csv, refused, run};
use serde_json::Value;

fn json(args: &[&str]) -> Value {
    let d = run(&[&["atlas", "--format", "json", "--no-speed"], args].concat());
    assert_eq!(d.code, 0, "{}", d.err);
    serde_json::from_str(&d.out).unwrap_or_else(|e| panic!("{e}: {}", d.out))
}

fn says(d: &Done, part: &str) {
    assert!(
        d.code == 0 && d.out.contains(part),
        "{part}: {}{}",
        d.out,
        d.err
    );
}

#[test]
fn one_algorithm_with_its_claims() {
    let v = json(&["--only", "humlicek-1982", "--cases", "40"]);
    let names: Vec<&str> = v["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["humlicek-1982", "humlicek-1982 (f32)"]);
    let claims = v["claims"].as_array().unwrap();
    assert_eq!(claims.len(), 2);
    // Of each part it fails beside the axis; of the norm nothing was found against it.
    assert_eq!(claims[0]["verdict"], "in-part");
    assert_eq!(claims[1]["verdict"], "holds");
    assert!(v["rows"][0]["nanoseconds"].is_null());
    let jumps = v["rows"][0]["jumps"].as_array().unwrap();
    assert!(jumps.iter().any(|j| j["re"].as_f64().unwrap() > 0.1));
}

#[test]
fn the_point_that_refutes_a_claim_shows_it() {
    let v = json(&["--only", "weideman-1994-32", "--cases", "20"]);
    let refuted = v["claims"].as_array().unwrap().iter();
    let refuted = refuted.filter(|c| c["verdict"] == "refuted");
    let commands: Vec<&str> = refuted.map(|c| c["reproduce"].as_str().unwrap()).collect();
    assert!(!commands.is_empty());
    for command in commands {
        let args: Vec<&str> = command.split(' ').skip(1).collect();
        let d = run(&args);
        assert_eq!(d.code, 0, "{}", d.err);
        says(&d, "certified");
        says(&d, "weideman-1994-32");
    }
}

#[test]
fn at_six() {
    let d = run(&["atlas", "--only", "weideman-1994-32", "--at", "6,0"]);
    says(&d, "2.319522830243569388");
    says(&d, "-2.53");
    // Below the axis the paper defines nothing.
    let d = run(&["atlas", "--only", "weideman-1994-32", "--at", "6,-1"]);
    says(&d, "not below the axis");
}

#[test]
fn tables() {
    let args = [
        "atlas",
        "--only",
        "mclean-1994",
        "--cases",
        "10",
        "--no-speed",
        "--format",
        "csv",
    ];
    let d = run(&args);
    let (header, rows) = csv(&d.out);
    assert!(header.contains(&"worst_norm".to_string()));
    // Ten regions of the upper half-plane and all of them.
    assert_eq!(rows.len(), 11, "{}", d.out);
    let negative = header.iter().position(|h| h == "negative_re").unwrap();
    let count: u64 = rows[10][negative].parse().unwrap();
    assert!(count > 0);
    let d = run(&[&args[..], &["--table", "claims"]].concat());
    let (header, rows) = csv(&d.out);
    assert!(header.contains(&"statement".to_string()) && rows.is_empty());
}

#[test]
fn a_program_beside() {
    let program = format!("{} eval faddeeva", env!("CARGO_BIN_EXE_mechaudit"));
    let v = json(&[
        "--only",
        "wells-1999-r4",
        "--cases",
        "8",
        "--exec",
        &program,
    ]);
    let rows = v["rows"].as_array().unwrap();
    let own = rows.iter().find(|r| r["name"] == program.as_str()).unwrap();
    let parts = own["parts"].as_array().unwrap();
    let all = parts.iter().find(|p| p["region"] == "all").unwrap();
    // Rounded from certified digits.
    assert!(all["norm"]["worst"].as_f64().unwrap() < 3e-16, "{all}");
    assert_eq!((&all["wrong"], &all["negative"]), (&0.into(), &0.into()));
    let gone = json(&["--only", "wells-1999-r4", "--cases", "4", "--exec", "false"]);
    let row = gone["rows"]
        .as_array()
        .unwrap()
        .iter()
        .find(|r| r["name"] == "false");
    let all = row.unwrap()["parts"].as_array().unwrap().last().unwrap();
    assert_eq!(all["wrong"], all["cases"]);
}

#[test]
fn lines_of_the_hartmann_tran_profile() {
    let v = json(&["--only", "tran-ngo-hartmann-2013", "--cases", "10"]);
    assert_eq!(v["rows"].as_array().unwrap().len(), 0);
    let profiles = v["profiles"].as_array().unwrap();
    assert_eq!(profiles.len(), 1);
    let parts = profiles[0]["parts"].as_array().unwrap();
    let mixed = parts.iter().find(|p| p["region"] == "mixed").unwrap();
    assert!(mixed["norm"]["worst"].as_f64().unwrap() < 1e-4, "{mixed}");
    assert_eq!(mixed["worst_at"].as_array().unwrap().len(), 8);
    let claims = v["claims"].as_array().unwrap();
    assert_eq!(claims.len(), 2);
    for claim in claims {
        let command = claim["reproduce"].as_str().unwrap();
        let d = run(&command.split(' ').skip(1).collect::<Vec<_>>());
        says(&d, "certified  Re HT");
    }
    // The line of the reference's own test, by mpmath's quadrature.
    let line = "1,0.5,0.0625,0.25,-0.03125,0.125,0.25,1.5";
    let d = run(&["atlas", "--at", line]);
    says(&d, "0.16095040964210702468");
    says(&d, "without shifts and correlation");
}

#[cfg(unix)]
#[test]
fn a_program_says_what_it_is() {
    let own = env!("CARGO_BIN_EXE_mechaudit");
    let program = format!(
        "sh -c 'printf \"# name: planted\\n# version: 7\\n# ns: 47.5\\n\"; exec {own} eval faddeeva'"
    );
    let args = [
        "atlas",
        "--format",
        "json",
        "--only",
        "wells-1999-r4",
        "--cases",
        "4",
        "--exec",
    ];
    let d = run(&[&args[..], &[&program]].concat());
    assert_eq!(d.code, 0, "{}", d.err);
    let v: Value = serde_json::from_str(&d.out).unwrap();
    let rows = v["rows"].as_array().unwrap();
    let row = rows.iter().find(|r| r["name"] == "planted").unwrap();
    assert_eq!(
        (&row["source"], &row["nanoseconds"]),
        (&"7".into(), &47.5.into())
    );
    // Values rounded from certified digits do not jump.
    assert_eq!(row["jumps"].as_array().unwrap().len(), 0);
}

#[test]
fn what_there_is_not() {
    refused(&run(&["atlas", "--only", "humlicek-1983"]), "humlicek-1982");
    refused(&run(&["atlas", "--at", "1"]), "RE,IM");
    refused(&run(&["atlas", "--at", "inf,0"]), "finite");
    // A line has eight numbers, a point of the plane two.
    let only = ["atlas", "--only", "hapi-pcqsdhc", "--at", "6,0"];
    refused(&run(&only), "eight numbers");
    let only = [
        "atlas",
        "--only",
        "humlicek-1982",
        "--at",
        "1,1,0,0,0,0,0,1",
    ];
    refused(&run(&only), "RE,IM");
}
