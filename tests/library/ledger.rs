//! Pins the ledgers of the papers, and plants faults in them.

use crate::pin;
use mechaudit_cli::papers;
use mechaudit_cli::papers::ledger::{Item, Ledger, LedgerEntry, Verdict, decide};
use mechaudit_symbolic::{Family, Outcome, edits, parse_equation};
use std::fmt::Write;
use std::sync::OnceLock;

fn ledgers() -> &'static [Ledger] {
    static LEDGERS: OnceLock<Vec<Ledger>> = OnceLock::new();
    LEDGERS.get_or_init(|| {
        papers::keys()
            .iter()
            .filter_map(|k| papers::ledger_of(k))
            .collect()
    })
}

fn items() -> Vec<Item> {
    let files = papers::keys().into_iter().filter_map(papers::file_of);
    files.flat_map(|file| file.items.clone()).collect()
}

fn summary(e: &LedgerEntry) -> String {
    let mut out = format!("{} [{}] {}\n", e.id, e.place, e.verdict.words());
    let mut line = |label: &str, text: &str| writeln!(out, "    {label} {text}").expect("a string");
    if let Some(f) = &e.printed {
        line("printed  ", &f.text);
    }
    if let Some(f) = &e.corrected {
        line("corrected", &f.text);
    }
    if let Some(r) = &e.repair {
        let counts = format!(
            "{} of {} single edits, {} of {} pairs, {} without value, {} undecided, {} formula(s)",
            r.single_that_hold,
            r.single_edits,
            r.pairs_that_hold,
            r.pairs,
            r.without_value,
            r.undecided,
            r.distinct.len()
        );
        line("search   ", &counts);
    }
    for o in &e.obligations {
        line(&format!("{:?}", o.printed).to_lowercase(), &o.formula.text);
    }
    out
}

#[test]
fn ledgers_are_as_recorded() {
    for ledger in ledgers() {
        let open: Vec<&str> = ledger
            .entries
            .iter()
            .filter(|e| !e.as_recorded)
            .map(|e| e.id)
            .collect();
        assert!(open.is_empty(), "not as recorded: {open:?}");
        let text: String = ledger.entries.iter().map(summary).collect();
        pin(&format!("{}-ledger", ledger.paper.key), &text);
    }
}

/// Every numbered formula of the two papers that number them has an entry.
#[test]
fn every_number_is_covered() {
    for (ledger, last) in ledgers().iter().zip([20, 19]) {
        for k in 1..=last {
            let number = format!("({k})");
            let found = ledger.entries.iter().any(|e| e.place.starts_with(&number));
            assert!(found, "{} {number}", ledger.paper.key);
        }
        let mut ids: Vec<&str> = ledger.entries.iter().map(|e| e.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), ledger.entries.len());
    }
}

#[test]
fn errata_files_are_up_to_date() {
    for ledger in ledgers() {
        let file = format!(
            "{}/reference/published/{}-errata.json",
            env!("CARGO_MANIFEST_DIR"),
            ledger.paper.key
        );
        let held = std::fs::read_to_string(&file).unwrap();
        let mut held: serde_json::Value = serde_json::from_str(&held).unwrap();
        // How it was made; `mechaudit regenerate --check` compares the whole file.
        held.as_object_mut()
            .unwrap()
            .shift_remove("generated")
            .unwrap();
        let now = serde_json::to_value(ledger.errata()).unwrap();
        assert!(held == now, "{file} is not up to date");
    }
}

#[test]
fn every_misprint_has_one_repair_that_is_proved() {
    for e in ledgers().iter().flat_map(|l| &l.entries) {
        let Some(r) = &e.repair else { continue };
        assert_eq!(r.undecided, 0, "{}", e.id);
        match e.verdict {
            Verdict::Misprint => {
                assert_eq!(r.distinct.len(), 1, "{}: {:?}", e.id, r.distinct);
                assert!(e.obligations.iter().any(|o| o.printed == Outcome::Refuted));
                for o in e.obligations.iter().filter(|o| o.recorded.is_none()) {
                    assert_eq!(o.corrected, Some(Outcome::Proved), "{}", e.id);
                    assert!(
                        o.printed != Outcome::Refuted || o.witness.is_some(),
                        "{}",
                        e.id
                    );
                }
            }
            _ => assert_eq!((r.single_that_hold, r.pairs_that_hold), (0, 0), "{}", e.id),
        }
    }
}

/// A sign error planted in a formula that is proved is refuted, and the search finds the way back.
#[test]
fn planted_sign_errors_are_found_and_undone() {
    let (mut formulas, mut planted, mut refuted, mut senseless) = (0, 0, 0, 0);
    for item in items() {
        let Some(text) = item.printed.filter(|_| item.expected == Verdict::Proved) else {
            continue;
        };
        let right = parse_equation(text).unwrap();
        let signs = edits(&right, &Family::default());
        let mut signs = signs.into_iter().filter(|(e, _)| e.kind == "sign");
        // Every other formula, of these in turn the first sign and the second.
        formulas += 1;
        if formulas % 2 == 1 {
            continue;
        }
        if let Some((_, faulty)) = signs.nth(formulas / 2 % 2) {
            planted += 1;
            let bad = Item {
                printed: Some(Box::leak(faulty.to_string().into_boxed_str())),
                facts: Vec::new(),
                family: Some(Family::default()),
                most_edits: 1,
                expected: Verdict::Misprint,
                ..item.clone()
            };
            let found = decide(&bad);
            if found.verdict == Verdict::Proved {
                // The sign does not matter there: under a square, or of a whole equation.
                continue;
            }
            if found.verdict == Verdict::Undecided {
                // It divides by zero, so there is nothing to refute; it is not accepted either.
                senseless += 1;
                continue;
            }
            refuted += 1;
            assert_eq!(found.verdict, Verdict::Misprint, "{}: {faulty}", item.id);
            assert!(found.repair.unwrap().single_that_hold > 0, "{}", item.id);
        }
    }
    println!("{refuted} of {planted} refuted and undone, {senseless} without a value");
    assert!(planted > 40 && senseless < 3 && refuted * 10 > planted * 8);
}

/// A corrected form with one sign turned is not accepted in its place.
#[test]
fn corrupted_corrections_are_refuted() {
    let all: Vec<&LedgerEntry> = ledgers().iter().flat_map(|l| &l.entries).collect();
    let mut tried = 0;
    for item in items() {
        let entry = all.iter().find(|e| e.id == item.id).unwrap();
        let Some(corrected) = &entry.corrected else {
            continue;
        };
        let right = parse_equation(&corrected.text).unwrap();
        let signs = edits(&right, &Family::default());
        let bad = signs
            .iter()
            .filter(|(e, _)| e.kind == "sign")
            .any(|(_, e)| {
                let bad = Item {
                    printed: Some(Box::leak(e.to_string().into_boxed_str())),
                    family: None,
                    facts: Vec::new(),
                    ..item.clone()
                };
                let found = decide(&bad);
                found.verdict == Verdict::Refuted && !found.as_recorded
            });
        assert!(bad, "{}", item.id);
        tried += 1;
    }
    assert_eq!(tried, 17);
}
