//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

pub mod andrews;
pub mod gembara_senyk;
pub mod ledger;
pub mod n_four_bar;
pub mod number;
pub mod pmksweb;
mod report;
pub mod zinchenko;

pub use report::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, SCHEMA_VERSION,
    Subject, Tally, VariantJudgement,
};

use crate::motion::Motion;
use crate::reference::Undecided;
use report::{Draft, decided, figure, figures, known, recorded, shown};

/// Called now and then with the phase, how much of it is done, and its whole.
pub type Progress<'a> = &'a (dyn Fn(&str, u64, u64) + Sync);

/// Audits a paper; undecided when a certified value cannot be had.
pub type PaperAudit = fn(Progress) -> Result<PaperReport, Undecided>;

/// A paper that is known.
struct Paper {
    key: &'static str,
    citation: fn() -> Citation,
    items: fn() -> Vec<ledger::Item>,
    audit: PaperAudit,
    motion: Option<fn() -> Motion>,
}

const PAPERS: &[Paper] = &[
    Paper {
        key: zinchenko::KEY,
        citation: zinchenko::citation,
        items: zinchenko::items,
        audit: zinchenko::report,
        motion: Some(zinchenko::motion),
    },
    Paper {
        key: gembara_senyk::KEY,
        citation: gembara_senyk::citation,
        items: gembara_senyk::items,
        audit: gembara_senyk::report,
        motion: None,
    },
    Paper {
        key: andrews::KEY,
        citation: andrews::citation,
        items: andrews::items,
        audit: andrews::report,
        motion: None,
    },
    Paper {
        key: n_four_bar::KEY,
        citation: n_four_bar::citation,
        items: n_four_bar::items,
        audit: n_four_bar::report,
        motion: None,
    },
    Paper {
        key: pmksweb::KEY,
        citation: pmksweb::citation,
        items: pmksweb::items,
        audit: pmksweb::report,
        motion: None,
    },
];

fn paper(key: &str) -> Option<&'static Paper> {
    PAPERS.iter().find(|p| p.key == key)
}

/// The audit of the paper of that key.
pub fn find(key: &str) -> Option<PaperAudit> {
    paper(key).map(|p| p.audit)
}

/// The ledger of the paper of that key, decided now.
pub fn ledger_of(key: &str) -> Option<ledger::Ledger> {
    paper(key).map(|p| ledger::Ledger::of((p.citation)(), &(p.items)()))
}

/// The motion of the mechanism of the paper of that key, where it has one.
pub fn motion_of(key: &str) -> Option<Motion> {
    paper(key).and_then(|p| p.motion).map(|motion| motion())
}

/// The keys of all papers.
pub fn keys() -> Vec<&'static str> {
    PAPERS.iter().map(|p| p.key).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn papers_are_found_by_their_keys() {
        let keys = keys();
        assert_eq!(
            keys,
            [
                "zinchenko",
                "gembara-senyk",
                "andrews",
                "n-four-bar",
                "pmksweb"
            ]
        );
        assert!(keys.iter().all(|key| find(key).is_some()));
        let moving: Vec<&&str> = keys.iter().filter(|key| motion_of(key).is_some()).collect();
        assert_eq!(moving, [&"zinchenko"]);
        assert_eq!(ledger_of("pmksweb").unwrap().paper.key, "pmksweb");
        assert!(
            find("none").is_none() && ledger_of("none").is_none() && motion_of("none").is_none()
        );
    }
}
