//! Pins what the audit of Zinchenko (2008) says: oracle digits, deviations and verdicts of all
//! 441 printed entries, and the findings.

use crate::pin;
use mechaudit_cli::papers::{self, EntryVerdict, PaperReport};
use std::fmt::Write;
use std::sync::OnceLock;

fn report() -> &'static PaperReport {
    static REPORT: OnceLock<PaperReport> = OnceLock::new();
    REPORT.get_or_init(|| {
        let report = papers::audit("zinchenko", &|_, _, _| ());
        report.expect("a paper").expect("decided")
    })
}

/// One table under one variant: printed, recomputed to 20 digits, deviation, verdict.
fn table(number: u32, variant: &str) -> String {
    let mut text = String::from("row column printed recomputed units_in_last_digit verdict\n");
    for e in report().entries.iter().filter(|e| e.table == number) {
        let v = &e.variants[variant];
        let digits: String = v.recomputed.chars().take(22).collect();
        let verdict = format!("{:?}", v.verdict).to_lowercase();
        writeln!(
            text,
            "{:2} {:9} {:>9} {digits:22} {:+.3} {verdict}",
            e.row, e.column, e.printed, v.units_in_last_digit
        )
        .expect("a string");
    }
    text
}

#[test]
fn tables_with_recovered_data() {
    pin("zinchenko-table-2-recovered", &table(2, "recovered"));
    pin("zinchenko-table-3-recovered", &table(3, "recovered"));
}

#[test]
fn tables_with_printed_data() {
    pin("zinchenko-table-2-as-printed", &table(2, "as_printed"));
    pin("zinchenko-table-3-as-printed", &table(3, "as_printed"));
}

/// The fitted nodes come from a least-squares fit in f64, so only verdicts are pinned.
#[test]
fn verdicts_with_fitted_nodes() {
    let mut text = String::new();
    for e in &report().entries {
        let v = &e.variants["recovered_fitted_nodes"];
        if v.verdict != EntryVerdict::Agrees {
            let note = v.note.as_deref().unwrap_or("");
            writeln!(
                text,
                "table {} row {:2} {:9} {:>9} {:?} {note}",
                e.table, e.row, e.column, e.printed, v.verdict
            )
            .expect("a string");
        }
    }
    pin("zinchenko-fitted-nodes", &text);
}

#[test]
fn findings() {
    let mut text = String::new();
    for f in &report().findings {
        writeln!(
            text,
            "{:?} {} [{}] {:?}\n    {}",
            f.subject, f.id, f.place, f.verdict, f.title
        )
        .expect("a string");
    }
    pin("zinchenko-findings", &text);
    let open: Vec<&str> = report()
        .findings
        .iter()
        .filter(|f| !f.as_recorded)
        .map(|f| f.id)
        .collect();
    assert!(open.is_empty(), "not as recorded: {open:?}");
}
