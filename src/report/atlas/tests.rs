//! Tests of `atlas`, and an atlas for those of other forms.

use super::*;
use crate::claims::{Decided, Effort, Figures, Finding, Height, Jump, Missing, Part, Row};

/// A part of which nothing is known.
pub fn part(region: &'static str, cases: u64) -> Part {
    Part {
        region,
        cases,
        norm: None,
        re: None,
        im: None,
        wrong: 0,
        negative: 0,
        worst_at: None,
    }
}

fn figures(worst: f64) -> Option<Figures> {
    Some(Figures {
        worst,
        p99: worst / 10.0,
        median: worst / 100.0,
    })
}

/// A row of which nothing is known.
pub fn row(name: &str) -> Row {
    Row {
        name: name.into(),
        title: String::new(),
        source: "Nobody (1900)".into(),
        whole_plane: true,
        real_part_only: false,
        single: false,
        parts: Vec::new(),
        derivative: None,
        heights: Vec::new(),
        jumps: Vec::new(),
        nanoseconds: None,
    }
}

pub fn claim(verdict: Verdict) -> Decided {
    Decided {
        algorithm: "first",
        statement: "accurate",
        source: "Nobody (1900)",
        reading: "of the norm",
        domain: "everywhere",
        measure: "relative error".into(),
        bound: Some(1e-6),
        verdict,
        part: "from Im z = 1 on".into(),
        points: 10,
        found: Some(2e-7),
        within: Some(1e-9),
        at: Some(vec![0.5, 1.0]),
        reproduce: Some("mechaudit atlas --at 0.5,1".into()),
    }
}

/// Two codes and two profiles; of one of each hardly anything is known.
pub fn fabricated() -> Atlas {
    let jump = |re, rising| Jump {
        between: None,
        norm: None,
        re,
        at: [0.0, 0.0],
        crossings: 9,
        rising,
    };
    let height = |norm, parts: Option<f64>| Height {
        target: 1e-4,
        norm,
        parts,
    };
    let all = Some(f64::NEG_INFINITY);
    let first = Row {
        parts: vec![
            Part {
                norm: figures(1e-3),
                re: Some(2e-3),
                im: Some(3e-3),
                worst_at: Some(vec![0.5, 1.0]),
                ..part("ordinary", 40)
            },
            Part {
                norm: figures(1.5e-2),
                re: Some(4e-2),
                ..part("beside-axis", 41)
            },
            Part {
                re: Some(5e-2),
                ..part("grid", 42)
            },
            Part {
                re: Some(6e-2),
                ..part("wings", 43)
            },
            Part {
                norm: figures(7e-2),
                ..part("lower", 44)
            },
            Part {
                wrong: 2,
                ..part("huge", 45)
            },
            Part {
                wrong: 5,
                negative: 7,
                worst_at: Some(vec![0.0; 8]),
                ..part("all", 300)
            },
        ],
        derivative: figures(8e-3),
        heights: vec![
            height(all, all),
            height(all, Some(-3.0)),
            height(Some(-20.0), None),
            height(None, None),
        ],
        jumps: vec![jump(1e-9, 2), jump(3e-9, 1)],
        nanoseconds: Some(12.345),
        ..row("first")
    };
    let bare = Row {
        single: true,
        parts: vec![part("ordinary", 30), part("all", 30)],
        heights: vec![height(None, None); 4],
        ..row("bare")
    };
    let profile = Row {
        parts: vec![
            Part {
                norm: figures(2e-3),
                re: Some(1e-3),
                ..part("doppler", 10)
            },
            Part {
                re: Some(9.0),
                ..part("mixed", 0)
            },
            Part {
                re: Some(2e-3),
                ..part("wings", 12)
            },
            Part {
                wrong: 1,
                negative: 3,
                ..part("all", 22)
            },
        ],
        nanoseconds: Some(99.6),
        ..row("profile")
    };
    let second = Row {
        parts: vec![Part {
            re: Some(0.5),
            ..part("wings", 1)
        }],
        ..row("second")
    };
    let untestable = Decided {
        part: String::new(),
        bound: None,
        found: None,
        within: None,
        at: None,
        reproduce: None,
        ..claim(Verdict::NotTestable)
    };
    Atlas {
        effort: Effort { cases: 40, seed: 7 },
        rows: vec![first, bare],
        profiles: vec![profile, second],
        claims: vec![claim(Verdict::InPart), untestable],
        findings: vec![Finding {
            algorithm: "first",
            used_by: "a library",
            sentence: "It is off.".into(),
            at: vec![0.5, 1.0],
            part: "norm",
            got: 0.5,
            due: "0.25".into(),
            error: Some(1.0),
            reproduce: "mechaudit atlas --at 0.5,1".into(),
        }],
        not_at_hand: vec![Missing {
            name: "gone".into(),
            source: "Nobody (1901)".into(),
            why: "nobody has it".into(),
        }],
    }
}

/// Heights are words, a code that reaches none has empty fields.
#[test]
fn heights_have_a_line_for_each_accuracy() {
    let mut out = Vec::new();
    super::heights(&fabricated(), &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let due = "\
name,precision,parts,target,norm,each_part
first,double,Re and Im,1e-4,everywhere,everywhere
first,double,Re and Im,1e-4,everywhere,1e-3
first,double,Re and Im,1e-4,1e-20,
first,double,Re and Im,1e-4,,
bare,single,";
    assert!(text.starts_with(due), "{text}");
    assert_eq!(text.lines().count(), 9);
}

#[test]
fn what_is_about_all_regions_stands_in_their_line() {
    let mut out = Vec::new();
    rows(&fabricated(), &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let lines: Vec<&str> = text.lines().skip(1).collect();
    let due = [
        "first,double,ordinary,40,1e-3,1e-4,1e-5,2e-3,3e-3,0,0,0x1p-1,0x1p+0,,,",
        "first,double,beside-axis,41,1.5e-2,1.5e-3,1.5e-4,4e-2,,0,0,,,,,",
        "first,double,grid,42,,,,5e-2,,0,0,,,,,",
        "first,double,wings,43,,,,6e-2,,0,0,,,,,",
        "first,double,lower,44,7e-2,7.000000000000001e-3,7.000000000000001e-4,,,0,0,,,,,",
        "first,double,huge,45,,,,,,2,0,,,,,",
        "first,double,all,300,,,,,,5,7,,,8e-3,3e-9,1.2e1",
        "bare,single,ordinary,30,,,,,,0,0,,,,,",
        "bare,single,all,30,,,,,,0,0,,,,,",
        "profile,double,doppler,10,2e-3,2e-4,2e-5,1e-3,,0,0,,,,,",
        "profile,double,mixed,0,,,,9e0,,0,0,,,,,",
        "profile,double,wings,12,,,,2e-3,,0,0,,,,,",
        "profile,double,all,22,,,,,,1,3,,,,,1e2",
        "second,double,wings,1,,,,5e-1,,0,0,,,,,",
    ];
    assert_eq!(lines.len(), due.len(), "{text}");
    for (line, due) in lines.iter().zip(due) {
        // Divided by ten, a number may be off by its last digit.
        let off = line.contains("lower");
        assert!(off || *line == due, "{line}\n{due}");
        assert!(
            !off || line.starts_with("first,double,lower,44,7e-2,7"),
            "{line}"
        );
    }
    let columns = text.lines().next().unwrap().split(',').count();
    assert!(
        lines.iter().all(|l| l.split(',').count() == columns),
        "{text}"
    );
}

#[test]
fn a_claim_that_cannot_be_tested_says_how_it_was_read() {
    let mut out = Vec::new();
    claims(&fabricated(), &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let lines: Vec<&str> = text.lines().skip(1).collect();
    let start = "first,accurate,Nobody (1900),of the norm,everywhere,relative error,";
    assert_eq!(
        lines,
        [
            format!(
                "{start}1e-6,holds in part,from Im z = 1 on,10,2e-7,1e-9,0x1p-1,0x1p+0,\"mechaudit atlas --at 0.5,1\""
            ),
            format!("{start},not testable,of the norm,10,,,,,"),
        ]
    );
}

#[test]
fn the_document_has_words_for_what_is_everywhere() {
    let found = fabricated();
    let value = document(&found);
    let heights = &value["rows"][0]["heights"];
    let of = |k: usize| (&heights[k]["norm"], &heights[k]["parts"]);
    let [everywhere, third, twentieth, none] = [
        json!("everywhere"),
        json!("1e-3"),
        json!("1e-20"),
        Value::Null,
    ];
    assert_eq!(of(0), (&everywhere, &everywhere));
    assert_eq!(of(1), (&everywhere, &third));
    assert_eq!(of(2), (&twentieth, &none));
    assert_eq!(of(3), (&none, &none));
    assert_eq!(value["schema_version"], 1);
    assert_eq!(value["mechaudit_version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(value["advice"], json!(advice(&found.rows)));
    assert_eq!(value["rows"][0]["name"], "first");
}
