//! Ledgers of planted items.

use super::*;
use crate::papers::{FindingVerdict, Subject};
use crate::symbolic::Family;
use Kind::{Formula as Numbered, Statement};

/// Neither sign of √2·√2 − 2 can be told in balls.
const OPEN: &str = "sqrt(2)*sqrt(2) < 2";

fn item() -> Item {
    Item::new("id", "(1)", Numbered)
}

fn citation() -> Citation {
    Citation {
        key: "key",
        ..Citation::default()
    }
}

#[test]
fn a_verdict_follows_from_all_requirements() {
    let decided = |requirements: &[&'static str]| decide(&item().requires(requirements)).verdict;
    assert_eq!(decided(&[]), Verdict::Undecided);
    assert_eq!(decided(&["1 < 2", "x = x"]), Verdict::Proved);
    assert_eq!(decided(&["1 < 2", "2 < 1"]), Verdict::Refuted);
    assert_eq!(decided(&["2 < 1", OPEN, "1 < 2"]), Verdict::Refuted);
    assert_eq!(decided(&["1 < 2", OPEN]), Verdict::Undecided);
    assert_eq!(decide(&item().definition()).verdict, Verdict::Definition);
    assert_eq!(decide(&item().undefined()).verdict, Verdict::Undefined);
    // A requirement is tested, whatever was declared.
    let declared = decide(&item().definition().requires(&["1 < 2"]));
    let feared = decide(&item().requires(&["1 < 2"]).refuted(&[], ""));
    for found in [declared, feared] {
        assert_eq!((found.verdict, found.as_recorded), (Verdict::Proved, false));
    }
    let unreadable = decide(&item().printed("y = (2*x").requires(&["y = x"]));
    assert_eq!(
        (unreadable.verdict, unreadable.as_recorded),
        (Verdict::Undecided, false)
    );
}

#[test]
fn outcomes_are_compared_with_the_record_one_by_one() {
    let model = || item().model();
    let recorded = |item: Item| decide(&item).as_recorded;
    assert!(recorded(
        model().also("1 < 2").but_not("2 < 1").also("x = x")
    ));
    assert!(!recorded(model()));
    assert!(!recorded(model().also("1 < 2").also("2 < 1")));
    assert!(!recorded(model().also("2 < 1").also("1 < 2")));
    assert!(!recorded(model().but_not("1 < 2").also("1 < 2")));
    assert!(!recorded(model().also(OPEN)));
    assert!(recorded(item().requires(&["1 < 2"])));
    assert!(recorded(item().requires(&["1 < 2"]).also("2 < 3")));
    assert!(!recorded(item().requires(&["1 < 2"]).also("3 < 2")));
    assert!(!recorded(item().requires(&["2 < 1"])));
    let facts = decide(&model().also("1 < 2").but_not("2 < 1"));
    let outcomes = facts.obligations.iter().map(|o| (o.printed, o.recorded));
    let (yes, no) = (Outcome::Proved, Outcome::Refuted);
    assert_eq!(
        outcomes.collect::<Vec<_>>(),
        [(yes, Some(yes)), (no, Some(no))]
    );
}

/// y = 2x + 1 has the wrong sign where y = 2x − 1 is due.
#[test]
fn a_repair_has_as_many_edits_as_are_recorded() {
    let wrong = || {
        item()
            .printed("y = 2*x + 1")
            .requires(&["y = 2*x - 1", "1 < 2"])
    };
    let found = decide(&wrong().misprint(1, &[], ""));
    assert_eq!(
        (found.verdict, found.as_recorded),
        (Verdict::Misprint, true)
    );
    assert_eq!(found.printed.as_ref().unwrap().text, "y = 2*x + 1");
    assert_eq!(found.corrected.as_ref().unwrap().text, "y = 2*x - 1");
    let repair = found.repair.as_ref().unwrap();
    assert_eq!(
        (repair.edits.len(), repair.single_that_hold, repair.pairs),
        (1, 1, 0)
    );
    assert_eq!((repair.edits[0].kind, repair.distinct.len()), ("sign", 1));
    let first = &found.obligations[0];
    assert_eq!(
        (first.printed, first.corrected),
        (Outcome::Refuted, Some(Outcome::Proved))
    );
    assert_eq!(first.residual.as_deref(), Some("2"));
    // A proved statement leaves no residual, and has no point at which it fails.
    let second = &found.obligations[1];
    assert!(second.residual.is_none() && second.witness.is_none());
    // One edit where two are recorded.
    let found = decide(&wrong().misprint(2, &[], ""));
    assert_eq!(
        (found.verdict, found.as_recorded),
        (Verdict::Misprint, false)
    );
    // Two where one is not enough.
    let twice = item().printed("y = x + z + w").requires(&["y = x - z - w"]);
    let found = decide(&twice.clone().misprint(2, &[], ""));
    let repair = found.repair.as_ref().unwrap();
    assert_eq!(
        (repair.edits.len(), found.as_recorded),
        (2, true),
        "{repair:?}"
    );
    assert_eq!(repair.single_that_hold, 0);
    assert!(repair.pairs > repair.pairs_that_hold && repair.pairs_that_hold > 0);
    let found = decide(&twice.refuted(&[], ""));
    assert_eq!((found.verdict, found.as_recorded), (Verdict::Refuted, true));
    assert!(found.corrected.is_none() && found.repair.unwrap().pairs == 0);
    // Without a family nothing is looked for.
    let found = decide(&wrong());
    assert!(found.repair.is_none() && found.corrected.is_none());
    assert_eq!(
        (found.verdict, found.as_recorded),
        (Verdict::Refuted, false)
    );
}

/// Edits that cannot be judged are never on record.
#[test]
fn an_undecided_edit_is_not_recorded() {
    let item = item().printed("y = x + 1").requires(&["y = x - 1", OPEN]);
    let found = decide(&item.misprint(1, &[], ""));
    let last = finding(&found).unwrap().figures.pop().unwrap();
    assert_eq!((&*last.name, &*last.value), ("edits left undecided", "1"));
    let repair = found.repair.unwrap();
    assert_eq!(found.verdict, Verdict::Refuted);
    assert!(
        repair.undecided == 1 && repair.edits.is_empty(),
        "{repair:?}"
    );
    let item = Item {
        family: Some(Family::new(&[], "")),
        expected: Verdict::Refuted,
        ..super::Item::new("id", "", Numbered)
    };
    let item = item.printed("y = x + 1").requires(&["y = x - 1", OPEN]);
    assert!(!decide(&item).as_recorded);
}

/// Each verdict's contribution to a report, by the slip that the first edit undoes.
#[test]
fn findings_say_who_is_to_blame() {
    let edit = |kind| Edit {
        kind,
        before: String::new(),
        after: String::new(),
    };
    let entry = |verdict, kinds: &[&'static str], pairs| {
        let mut e = decide(&item().claims("A claim.").note("And a note."));
        e.verdict = verdict;
        e.repair = Some(Repair {
            single_edits: 9,
            single_that_hold: 1,
            pairs,
            pairs_that_hold: 2,
            edits: kinds.iter().map(|&k| edit(k)).collect(),
            ..Repair::default()
        });
        e
    };
    let found = |e: &LedgerEntry| finding(e).map(|f| (f.verdict, f.title));
    let misprinted = (FindingVerdict::PrintOrScan, "(1) is misprinted".to_string());
    let wrong = (FindingVerdict::ErrorOfPaper, "(1) is wrong".to_string());
    for (verdict, kinds, due) in [
        (Verdict::Misprint, &["sign"][..], Some(&misprinted)),
        (Verdict::Misprint, &["quadrant"][..], Some(&wrong)),
        (
            Verdict::Misprint,
            &["sign", "zero for a symbol"],
            Some(&wrong),
        ),
        (Verdict::Refuted, &[][..], Some(&wrong)),
        (Verdict::Proved, &["quadrant"][..], None),
        (Verdict::Definition, &[][..], None),
        (Verdict::Undefined, &[][..], None),
    ] {
        assert_eq!(
            found(&entry(verdict, kinds, 0)).as_ref(),
            due,
            "{verdict:?}"
        );
    }
    let open = finding(&entry(Verdict::Undecided, &[], 0)).unwrap();
    assert_eq!(open.verdict, FindingVerdict::Unexplained);
    assert_eq!(open.title, "(1) is undecided");
    assert_eq!(open.text, "A claim. And a note.");
    // Without a printed form, the requirement that fails is shown with what it is off by.
    let number = item()
        .requires(&["1 < 2", "20 ~ 21 within 0.5"])
        .refuted(&[], "");
    let shown = finding(&decide(&number)).unwrap().figures.into_iter();
    let shown: Vec<String> = shown.map(|f| format!("{} {}", f.name, f.value)).collect();
    assert_eq!(
        shown,
        [
            "requirement 20 ~ 21 within 0.5",
            "left side less right side -1.00000"
        ]
    );
    let names = |pairs| -> Vec<String> {
        let f = finding(&entry(Verdict::Misprint, &["sign"], pairs)).unwrap();
        f.figures
            .into_iter()
            .map(|f| f.name + " " + &f.value)
            .collect()
    };
    assert_eq!(
        names(0),
        ["single edits tried 9", "single edits that hold 1"]
    );
    let pairs = ["pairs of edits tried 1", "pairs that hold 2"];
    assert_eq!(names(1)[2..], pairs);
    // A claim about the model is refuted by one of its statements.
    let model = Item::new("id", "(1)", Statement)
        .claims("It holds.")
        .model();
    let refuted = finding(&decide(&model.clone().also("1 < 2").but_not("2 < 1"))).unwrap();
    assert_eq!(
        (refuted.verdict, refuted.subject),
        (FindingVerdict::Refuted, Subject::Claim)
    );
    assert_eq!(
        (refuted.title.as_str(), refuted.text.as_str()),
        ("It holds", "It holds.")
    );
    assert!(finding(&decide(&model.also("1 < 2"))).is_none());
    // Both forms are shown where there are both.
    let wrong = item().printed("y = 2*x + 1").requires(&["y = 2*x - 1"]);
    let f = finding(&decide(&wrong.misprint(1, &[], ""))).unwrap();
    let shown: Vec<[&str; 2]> = f.figures.iter().map(|f| [&*f.name, &*f.value]).collect();
    assert_eq!(
        shown[..2],
        [["printed", "y = 2*x + 1"], ["corrected", "y = 2*x - 1"]]
    );
    assert!(f.figures[0].latex.is_some() && f.figures[2].latex.is_none());
}

#[test]
fn a_ledger_counts_its_entries_and_lists_what_is_wrong() {
    let items = [
        item().requires(&["1 < 2"]),
        item()
            .printed("y = 2*x + 1")
            .requires(&["y = 2*x - 1"])
            .misprint(1, &[], ""),
        item().requires(&["2 < 1", "3 < 1"]).refuted(&[], ""),
        item().definition(),
    ];
    let ledger = Ledger::of(citation(), &items);
    assert!(ledger.as_recorded());
    let verdicts = [
        Verdict::Proved,
        Verdict::Misprint,
        Verdict::Refuted,
        Verdict::Definition,
    ];
    assert_eq!(verdicts.map(|v| ledger.count(v)), [1; 4]);
    assert_eq!(ledger.count(Verdict::Undecided), 0);
    let errata = ledger.errata().errata;
    let of: Vec<Verdict> = errata.iter().map(|e| e.verdict).collect();
    assert_eq!(of, [Verdict::Misprint, Verdict::Refuted]);
    assert_eq!(errata[0].residual.as_deref(), Some("2"));
    assert_eq!((errata[0].edits.len(), errata[1].edits.len()), (1, 0));
    // A number leaves what it is off by.
    assert_eq!(errata[1].residual.as_deref(), Some("1.00000"));
    let mut one_off = ledger.clone();
    one_off.entries[3].as_recorded = false;
    assert!(!one_off.as_recorded());
    assert!(!Ledger::of(citation(), &[]).as_recorded());
}

/// A residual of more than 160 characters gives way to the value at the point where it fails.
#[test]
fn an_erratum_is_short() {
    let of = |length: usize| {
        let wrong = item()
            .printed("y = 2*x + 1")
            .requires(&["x = x", "y = 2*x - 1"]);
        let mut ledger = Ledger::of(citation(), &[wrong.refuted(&[], "")]);
        let o = &mut ledger.entries[0].obligations[1];
        o.residual = Some("x".repeat(length));
        o.witness.as_mut().unwrap().residual = "7".into();
        ledger.errata().errata[0].residual.clone().unwrap()
    };
    assert_eq!(of(160), "x".repeat(160));
    assert_eq!(of(161), "7");
}
