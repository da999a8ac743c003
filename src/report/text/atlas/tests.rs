//! Tests of `atlas`.

use super::super::style::plain;
use super::*;
use crate::claims::{Effort, Height};

fn claim() -> Decided {
    Decided {
        algorithm: "an-algorithm",
        statement: "accurate",
        source: "Nobody (1900)",
        reading: "",
        domain: "everywhere",
        measure: "relative error".into(),
        bound: Some(1e-6),
        verdict: Verdict::Holds,
        part: String::new(),
        points: 10,
        found: Some(2e-7),
        within: None,
        at: None,
        reproduce: None,
    }
}

#[test]
fn a_claim_says_how_it_was_read_where_there_is_something_to_say() {
    let mut claim = claim();
    let facts = |c: &Decided| plain(&decided(c, 200)).lines().nth(2).unwrap().to_string();
    let found = "found 2.00e-7, bound 1.00e-6, 10 points";
    assert_eq!(
        facts(&claim),
        format!("    relative error; everywhere; {found}")
    );
    claim.reading = "of the norm";
    let read = format!("    relative error; everywhere; of the norm; {found}");
    assert_eq!(facts(&claim), read);
}

#[test]
fn an_accuracy_that_is_met_everywhere_is_green() {
    let height = |norm, parts| Height {
        target: 1e-4,
        norm,
        parts,
    };
    let all = Some(f64::NEG_INFINITY);
    let row = Row {
        name: "a".into(),
        title: String::new(),
        source: String::new(),
        whole_plane: true,
        real_part_only: false,
        single: false,
        parts: Vec::new(),
        derivative: None,
        heights: vec![
            height(all, all),
            height(all, Some(-3.0)),
            height(Some(-3.0), None),
            height(None, None),
        ],
        jumps: Vec::new(),
        nanoseconds: None,
    };
    let found = Atlas {
        effort: Effort { cases: 1, seed: 1 },
        rows: vec![row],
        profiles: Vec::new(),
        claims: Vec::new(),
        findings: Vec::new(),
        not_at_hand: Vec::new(),
    };
    let text = heights(&found, 100);
    let green = paint(GOOD, "all / all");
    let due = format!("a  {green}  all / -3  -3 / –  – / –\n");
    assert!(text.contains(&due), "{text}");
}

/// The cells of each line that begins with one of these names.
fn lines(text: &str, names: &[&str]) -> Vec<String> {
    let text = plain(text);
    let lines = text
        .lines()
        .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "));
    let named = |l: &String| names.iter().any(|n| l.starts_with(&format!("{n} ")));
    lines.filter(named).collect()
}

#[test]
fn every_table_has_a_line_for_each_code() {
    let found = crate::report::atlas::tests::fabricated();
    let text = atlas(&found, 100);
    assert_eq!(
        lines(&text, &["first", "bare", "profile", "second"]),
        [
            "first 1.0e-3 2.0e-3 4.0e-2 8.0e-3 12",
            "bare – – – – –",
            "first 1.0e-5 1.0e-4 3.0e-3 5.0e-2 6.0e-2",
            "bare – – – – –",
            // Of five wrong ones two are huge.
            "first 3 2 7 3.0e-9 3",
            "bare – – – – –",
            "profile 1e-3 – – 2e-3 – 3 100",
            "second – – – 5e-1 – – –",
            "first all / all all / -3 -20 / – – / –",
            "bare – / – – / – – / – – / –",
            "first holds in part",
            "first not testable",
        ]
    );
    let text = plain(&text);
    for part in [
        "4 codes; 2 claims: 1 holds in part, 1 not testable.\n\nWorst relative errors\n",
        "Worst found of 40 points a region.",
        "found of 12 lines a region",
        "“accurate” (Nobody (1900))",
        "relative error; everywhere; of the norm; found 2.00e-7 ± 1.0e-9, bound 1.00e-6, 10 points; holds\n    from Im z = 1 on\n",
        "\nFindings\n  It is off.\n    mechaudit atlas --at 0.5,1\n",
        "\nNot at hand\n  gone (Nobody (1901)): nobody has it\n",
        "\nWhat meets which need\n",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    assert!(text.lines().all(|l| l.chars().count() <= 100), "{text}");
    let order = ["Claims\n", "Findings\n", "Not at hand\n", "What meets"];
    let places: Vec<usize> = order.iter().map(|p| text.find(p).unwrap()).collect();
    assert!(places.is_sorted(), "{text}");
}

#[test]
fn what_there_is_nothing_of_has_no_heading() {
    let mut found = crate::report::atlas::tests::fabricated();
    found.findings.clear();
    found.not_at_hand.clear();
    found.profiles.clear();
    found.rows.clear();
    let text = plain(&atlas(&found, 100));
    for heading in ["Findings", "Not at hand", "Hartmann"] {
        assert!(!text.contains(heading), "{text}");
    }
    assert!(text.starts_with("0 codes; 2 claims: ") && text.contains("found of 0 points"));
}

/// At most 32 characters, the last one an ellipsis.
#[test]
fn long_names_are_cut() {
    for (n, due) in [(32, "x".repeat(32)), (33, "x".repeat(31) + "…")] {
        let row = crate::report::atlas::tests::row(&"x".repeat(n));
        assert_eq!(name(&row).0, due);
    }
}

#[test]
fn counts_are_bad_and_claims_have_the_colour_of_their_verdict() {
    assert_eq!(count(0), ("–".into(), DIM));
    assert_eq!(count(1), ("1".into(), BAD));
    for (verdict, style, part) in [
        (Verdict::Holds, GOOD, false),
        (Verdict::InPart, DOUBT, true),
        (Verdict::Open, DOUBT, false),
        (Verdict::Refuted, BAD, false),
        (Verdict::NotTestable, DIM, false),
    ] {
        let text = decided(&crate::report::atlas::tests::claim(verdict), 200);
        let head = format!("  first {}\n", paint(style, verdict.words()));
        assert!(text.starts_with(&head), "{text:?}");
        assert_eq!(text.contains("holds from"), part, "{text:?}");
        let command = format!("    {}\n", paint(DIM, "mechaudit atlas --at 0.5,1"));
        assert!(text.ends_with(&command), "{text:?}");
    }
}

#[test]
fn a_claim_without_figures_has_none() {
    let mut claim = claim();
    (claim.found, claim.measure) = (None, String::new());
    let text = plain(&decided(&claim, 200));
    let due = "  an-algorithm holds as far as searched\n    “accurate” (Nobody (1900))\n    \n";
    assert_eq!(text, due);
}

#[test]
fn what_is_wrapped_stays_two_characters_from_the_edge() {
    let mut found = crate::report::atlas::tests::fabricated();
    found.findings[0].sentence = "It is off ".repeat(9);
    found.not_at_hand[0].why = "nobody has it any more".into();
    let text = plain(&atlas(&found, 40));
    let wrapped = |heading: &str| -> Vec<usize> {
        let part = text.split(&format!("\n{heading}\n")).nth(1).unwrap();
        let lines = part.lines().take_while(|l| !l.is_empty());
        lines.map(|l| l.len() - l.trim_start().len()).collect()
    };
    let (command, rest) = wrapped("Findings")
        .split_last()
        .map(|(c, r)| (*c, r.to_vec()))
        .unwrap();
    assert!(
        command == 4 && rest.len() > 1 && rest.iter().all(|n| *n == 2),
        "{text}"
    );
    let advice = wrapped("What meets which need");
    assert!(
        advice.len() > 20 && advice.iter().all(|n| *n == 2),
        "{text}"
    );
    assert_eq!(wrapped("Not at hand"), [2, 2], "{text}");
    assert!(
        text.contains("\nall: every Im z >= 0; –: nowhere."),
        "{text}"
    );
    assert!(
        text.contains("\nOver all regions. wrong: NaN or infinity"),
        "{text}"
    );
}
