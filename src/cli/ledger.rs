//! A paper's ledger in the form asked for.

use super::args::{PaperArgs, PaperFormat};
use super::failure::{Failure, Outcome};
use super::output::Output;
use super::{complain, ledger_html, ledger_latex, ledger_text, text};
use mechaudit::papers::{self, ledger::Ledger};
use std::time::Instant;

/// Decides the ledger and writes it, or compares it with the file.
pub fn ledger(args: &PaperArgs) -> Result<Outcome, Failure> {
    // With --check the file is read.
    let output = Output::open(args.output.as_deref().filter(|_| !args.check))?;
    let standard = output.is_standard() && !args.check;
    let started = Instant::now();
    let Some(ledger) = papers::ledger_of(&args.key) else {
        return Err(super::paper::unknown(&args.key));
    };
    let seconds = started.elapsed().as_secs_f64();
    let width = match standard {
        true => text::width(),
        false => 100,
    };
    let written = match args.format {
        PaperFormat::Text => ledger_text::ledger(&ledger, width),
        PaperFormat::Json => json(&ledger)?,
        PaperFormat::Html => ledger_html::page(&ledger),
        PaperFormat::Latex => ledger_latex::document(&ledger),
        PaperFormat::Errata => {
            super::regenerate::errata::text(&ledger).map_err(|e| Failure::new(e.to_string()))?
        }
        PaperFormat::Csv => return Err(Failure::new("a ledger has no CSV form")),
    };
    if args.check {
        return check(args, &written);
    }
    output.write(|out| {
        out.write_all(written.as_bytes())?;
        if args.format == PaperFormat::Text && standard {
            writeln!(out, "\nDecided in {seconds:.2} s.")?;
        }
        Ok(())
    })?;
    Ok(Outcome::of(ledger.as_recorded()))
}

fn json<T: serde::Serialize>(value: &T) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value);
    let text = text.map_err(|e| Failure::new(e.to_string()))?;
    Ok(text + "\n")
}

/// Whether the file holds what would be written.
fn check(args: &PaperArgs, written: &str) -> Result<Outcome, Failure> {
    let Some(path) = &args.output else {
        return Err(Failure::new("--check needs --output FILE to compare with"));
    };
    let held = std::fs::read_to_string(path)
        .map_err(|e| Failure::new(format!("cannot read {}: {e}", path.display())))?;
    // Colour is for terminals; files never have any.
    let plain = anstream::adapter::strip_str(written).to_string();
    let same = held == plain;
    if !same {
        complain(&format!("{} is not up to date", path.display()));
    }
    Ok(Outcome::of(same))
}

/// How many entries of each kind, in words.
pub fn counts(ledger: &Ledger) -> String {
    use papers::ledger::Verdict as V;
    let kinds = [
        V::Proved,
        V::Misprint,
        V::Refuted,
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
    let changed = ledger.entries.iter().filter(|e| !e.as_recorded).count();
    let recorded = match changed {
        0 => "all as recorded".into(),
        n => format!("{n} NOT as recorded"),
    };
    format!(
        "{} entries: {}; {recorded}.",
        ledger.entries.len(),
        parts.join(", ")
    )
}

/// How the repair was looked for, in words.
pub fn search(repair: &papers::ledger::Repair) -> String {
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

/// At most so many characters, with an ellipsis.
pub fn clipped(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let head: String = text.chars().take(most).collect();
    format!("{head} …")
}
