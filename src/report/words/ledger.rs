//! Verdicts of a ledger.

use super::Tone;
use super::paper::recorded;
use crate::papers::ledger::{Ledger, Repair, Verdict};
use crate::symbolic::Outcome;

/// Mark and tone of a verdict.
pub fn mark(verdict: Verdict) -> (&'static str, Tone) {
    match verdict {
        Verdict::Proved => ("✓", Tone::Good),
        Verdict::Refuted => ("✗", Tone::Bad),
        Verdict::Misprint => ("~", Tone::Doubt),
        Verdict::Undimensional => ("✗", Tone::Bad),
        Verdict::Model => ("≈", Tone::New),
        Verdict::Definition => ("·", Tone::Plain),
        Verdict::Undefined => ("?", Tone::Doubt),
        Verdict::Undecided => ("?", Tone::Bad),
    }
}

/// The word of an outcome.
pub fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Proved => "proved",
        Outcome::Refuted => "refuted",
        Outcome::Undecided => "undecided",
    }
}

/// The number of entries of each kind, in words.
pub fn entries(ledger: &Ledger) -> String {
    use Verdict as V;
    let kinds = [
        V::Proved,
        V::Misprint,
        V::Refuted,
        V::Undimensional,
        V::Model,
        V::Definition,
        V::Undefined,
        V::Undecided,
    ];
    let parts: Vec<String> = kinds
        .iter()
        .map(|v| (ledger.count(*v), v.words()))
        .filter(|k| k.0 > 0)
        .map(|(n, words)| format!("{n} {words}"))
        .collect();
    format!("{} entries: {}", ledger.entries.len(), parts.join(", "))
}

/// The number of entries, and whether they are as recorded.
pub fn counts(ledger: &Ledger) -> String {
    let changed = ledger.entries.iter().filter(|e| !e.as_recorded).count();
    format!("{}; {}.", entries(ledger), recorded(changed))
}

/// How the repair was looked for, in words.
pub fn search(repair: &Repair) -> String {
    let mut out = match repair.single_that_hold {
        0 => format!("None of {} single edits makes it true", repair.single_edits),
        1 => format!("1 of {} single edits makes it true", repair.single_edits),
        n => format!("{n} of {} single edits make it true", repair.single_edits),
    };
    if repair.pairs > 0 {
        out.push_str(&match repair.pairs_that_hold {
            1 => format!("; 1 of {} pairs of edits does", repair.pairs),
            n => format!("; {n} of {} pairs of edits do", repair.pairs),
        });
    }
    if repair.single_that_hold + repair.pairs_that_hold > 1 {
        out.push_str(&match repair.distinct.len() {
            1 => ", all of them giving the same formula".to_string(),
            n => format!(", giving {n} different formulas"),
        });
    }
    if repair.without_value > 0 {
        out.push_str(&format!("; {} divide by zero", repair.without_value));
    }
    if repair.undecided > 0 {
        out.push_str(&format!("; {} undecided", repair.undecided));
    }
    out.push('.');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::ledger::Formula;

    #[test]
    fn a_search_says_which_edits_hold_and_whether_they_agree() {
        let formula = || Formula {
            text: "y".into(),
            latex: "y".into(),
        };
        let text = |pairs_that_hold: usize, distinct: usize| {
            search(&Repair {
                single_edits: 9,
                single_that_hold: 0,
                pairs: 30,
                pairs_that_hold,
                without_value: 0,
                undecided: 0,
                distinct: (0..distinct).map(|_| formula()).collect(),
                edits: Vec::new(),
            })
        };
        let none = "None of 9 single edits makes it true; ";
        for (text, due) in [
            (text(0, 0), "0 of 30 pairs of edits do."),
            (text(1, 1), "1 of 30 pairs of edits does."),
            (
                text(2, 1),
                "2 of 30 pairs of edits do, all of them giving the same formula.",
            ),
            (
                text(3, 2),
                "3 of 30 pairs of edits do, giving 2 different formulas.",
            ),
        ] {
            assert_eq!(text, format!("{none}{due}"));
        }
    }

    #[test]
    fn a_search_counts_single_edits_and_what_came_of_the_others() {
        let formula = || Formula {
            text: "y".into(),
            latex: "y".into(),
        };
        let repair = |single_that_hold, pairs, pairs_that_hold, distinct: usize| Repair {
            single_edits: 9,
            single_that_hold,
            pairs,
            pairs_that_hold,
            without_value: 0,
            undecided: 0,
            distinct: (0..distinct).map(|_| formula()).collect(),
            edits: Vec::new(),
        };
        for (repair, due) in [
            (repair(0, 0, 0, 0), "None of 9 single edits makes it true."),
            (repair(1, 0, 0, 1), "1 of 9 single edits makes it true."),
            (
                repair(2, 0, 0, 1),
                "2 of 9 single edits make it true, all of them giving the same formula.",
            ),
            (
                repair(3, 0, 0, 2),
                "3 of 9 single edits make it true, giving 2 different formulas.",
            ),
            (
                repair(1, 1, 1, 2),
                "1 of 9 single edits makes it true; 1 of 1 pairs of edits does, giving 2 different formulas.",
            ),
        ] {
            assert_eq!(search(&repair), due);
        }
        let mut open = repair(1, 0, 0, 1);
        (open.without_value, open.undecided) = (1, 0);
        let start = "1 of 9 single edits makes it true";
        assert_eq!(search(&open), format!("{start}; 1 divide by zero."));
        (open.without_value, open.undecided) = (0, 1);
        assert_eq!(search(&open), format!("{start}; 1 undecided."));
        (open.without_value, open.undecided) = (4, 2);
        assert_eq!(
            search(&open),
            format!("{start}; 4 divide by zero; 2 undecided.")
        );
    }

    #[test]
    fn counts_say_how_many_are_not_as_recorded() {
        let mut ledger = crate::report::text::ledger::tests::fabricated();
        let entries = "3 entries: 1 proved, 1 misprint, 1 model claim tested";
        assert_eq!(counts(&ledger), format!("{entries}; all as recorded."));
        ledger.entries[0].as_recorded = false;
        ledger.entries[2].as_recorded = false;
        assert_eq!(counts(&ledger), format!("{entries}; 2 NOT as recorded."));
        ledger.entries.truncate(1);
        assert_eq!(super::entries(&ledger), "1 entries: 1 proved");
    }
}
