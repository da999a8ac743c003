//! Tests of `glossary`.

use super::*;
use crate::machine::{Linkage, Source, class_iii, dyad, planar, run_up};
use crate::report::text::{method, paper};
use std::path::Path;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn check<'a>(key: &str, names: impl IntoIterator<Item = &'a str>) {
    let mut seen = 0;
    for name in names {
        let found = topics(&[key]).any(|t| t.find(name).is_some());
        assert!(found, "{key}: {name} has no entry");
        seen += 1;
    }
    assert!(seen > 1, "{key}");
}

/// The names in the first line that is no comment.
fn heads(csv: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(csv);
    let head = text.lines().find(|l| !l.starts_with('#')).unwrap();
    head.split(',').map(String::from).collect()
}

fn strs(names: &[String]) -> impl Iterator<Item = &str> {
    names.iter().map(String::as_str)
}

#[test]
fn every_column_of_every_linkage_has_a_meaning() {
    let folder = Path::new(ROOT).join("examples");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        if path.extension().is_none_or(|e| e != "toml")
            || !text.contains("[geometry]\n") && !text.contains("[[body]]")
        {
            continue;
        }
        let Ok(linkage) = Linkage::read(&Source::toml(text)) else {
            continue;
        };
        seen += 1;
        match linkage {
            Linkage::ClassIii(l) => {
                check("linkage", strs(&class_iii::names(&l, false)));
                check("linkage", strs(&class_iii::names(&l, true)));
            }
            Linkage::Dyad(d) => check("linkage", strs(&dyad::names(&d))),
            Linkage::Planar(m) => {
                let all = planar::Columns {
                    paths: true,
                    reactions: true,
                };
                check("linkage", strs(&planar::names(&m, all)));
            }
        }
    }
    assert!(seen > 15, "{seen}");
}

#[test]
fn every_column_of_a_run_has_a_meaning() {
    check("runup", run_up::COLUMNS);
}

#[test]
fn every_column_of_every_csv_has_a_meaning() {
    let written = |write: &dyn Fn(&mut Vec<u8>)| {
        let mut out = Vec::new();
        write(&mut out);
        heads(&out)
    };
    use crate::audit::Comparison;
    use crate::report::csv;
    let report = method::tests::passing();
    let audit = written(&|out| csv::audit(std::slice::from_ref(&report), out).unwrap());
    check("audit", strs(&audit));
    let both = Comparison::new("a-method", vec![(method::tests::passing(), None)]);
    check(
        "compare",
        strs(&written(&|out| csv::comparison(&both, out).unwrap())),
    );
    let report = paper::tests::fabricated();
    check(
        "paper",
        strs(&written(&|out| csv::paper(&report, out).unwrap())),
    );
    check("hunt", crate::audit::HARD_HEADER.split(','));
    let values = Path::new(ROOT).join("reference/values/erf.csv");
    check("values", strs(&heads(&std::fs::read(values).unwrap())));
}

/// Names between quotes in the lists that are heads of tables for people.
#[test]
fn every_head_of_a_table_for_people_has_a_meaning() {
    let begins = [
        "Table::new( &[",
        "Table::new(&[",
        "let header = [",
        "header.extend([",
        "&[\"\", ",
    ];
    let mut folders = vec![Path::new(ROOT).join("src")];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.to_string_lossy().into_owned();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            if !name.ends_with(".rs") || name.contains("tests") {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let text = text
                .split("#[cfg(test)]")
                .next()
                .unwrap()
                .split_whitespace();
            let text = text.collect::<Vec<_>>().join(" ");
            for list in begins.iter().flat_map(|b| text.split(b).skip(1)) {
                let list = list.split(']').next().unwrap();
                for head in list.split('"').skip(1).step_by(2).filter(|h| h.len() > 1) {
                    let known = TOPICS.iter().any(|t| t.find(head).is_some());
                    assert!(known, "{name}: {head} has no entry");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 60, "{seen}");
}

#[test]
fn the_special_name_comes_before_the_pattern() {
    let topic = topics(&["linkage"]).next().unwrap();
    let meaning = |name| topic.find(name).map(|c| c.names);
    for (name, due) in [
        ("phi1_deg", "phi1_deg"),
        ("phi3_rad", "phi*_deg"),
        ("omega_crank_rpm", "omega*_rad_per_s"),
        ("dI_n_dphi_kg_m2_per_rad", "dI_n_dphi_kg_m2_per_rad"),
        ("dcrank_dphi", "d*_dphi | d*_ds"),
        ("d2crank_dphi_2_per_rad", "d2*_dphi_2 | d2*_ds_2"),
        ("Fx_O_crank_N", "Fx_*_N | Fy_*_N"),
        ("lever_deg", "*_deg"),
    ] {
        assert_eq!(meaning(name), Some(due), "{name}");
    }
    assert_eq!(meaning("lever"), None);
    assert_eq!(meaning("speed_m_per_s"), None);
}

/// No entry is written twice, and none is hidden by a pattern before it.
#[test]
fn every_entry_is_found_by_its_own_name() {
    for topic in TOPICS {
        for c in topic.columns {
            for name in c.names.split(SEPARATOR).filter(|n| !n.contains('*')) {
                let found = topic.find(name).unwrap();
                assert!(std::ptr::eq(found, c), "{}: {name}", topic.key);
            }
            assert!(
                !c.meaning.is_empty() && !c.meaning.ends_with('.'),
                "{}",
                c.names
            );
        }
    }
}

#[test]
fn the_chapter_of_the_book_is_what_the_code_says() {
    let held = include_str!("../../book/columns.md");
    assert!(held == chapter(), "run `mechaudit regenerate columns`");
}

#[test]
fn help_fits_a_terminal() {
    let keys: Vec<&str> = TOPICS.iter().map(|t| t.key).collect();
    let text = help("Examples:\n", &keys);
    for line in text.lines() {
        assert!(line.chars().count() <= WIDTH, "{line}");
    }
    for part in [
        "formula_19 ",
        "C_phi ",
        "K_dM ",
        "det_J_m4 ",
        "epsilon*_rad_per_s2 ",
    ] {
        assert!(text.contains(&format!("\n  {part}")), "{part}");
    }
}
