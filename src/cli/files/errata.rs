//! Errata of a paper.

use super::artefact::{Form, Made, Outcome, document};
use mechaudit::papers::ledger::Ledger;

/// The name of a paper's errata.
pub fn name(paper: &str) -> String {
    format!("{paper}-errata")
}

/// The errata of a decided ledger.
pub fn made(ledger: &Ledger) -> Outcome<Made> {
    let errata = ledger.errata();
    Ok(Made {
        title: format!("What is wrong in {} as printed", ledger.paper.key),
        facts: vec![
            ("precision", "exact: proofs in rational arithmetic".into()),
            ("entries", ledger.entries.len().to_string()),
        ],
        recipe: serde_json::to_string(ledger)?,
        body: serde_json::to_string_pretty(&errata)? + "\n",
    })
}

/// The whole file.
pub fn text(ledger: &Ledger) -> Outcome<String> {
    document(&name(ledger.paper.key), Form::Json, &made(ledger)?)
}
