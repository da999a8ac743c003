//! A paper's report for people: findings by subject, then the tallies.

use super::style::{self, BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::papers::{Finding, PaperReport, Tally};
use crate::report::words::numbers::{short, unit};
use crate::report::words::paper::{SUBJECTS, counts, mark, of_subject};

/// The report of one paper.
pub fn paper(report: &PaperReport, width: usize) -> String {
    let p = &report.paper;
    let parts = [p.by(), Some(p.title.to_string()), p.at()];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let title = format!("{}.", parts.join(". "));
    let mut out = paint(BOLD, &wrap(&title, 0, width));
    out.push_str("\n\n");
    out.push_str(&paragraph(&counts(report), 0, width));
    for (subject, name) in SUBJECTS {
        let findings: Vec<&Finding> = of_subject(report, subject);
        if findings.is_empty() {
            continue;
        }
        out.push_str(&format!("\n{}\n", paint(BOLD, name)));
        for f in findings {
            out.push_str(&finding(f, width));
        }
    }
    out.push_str(&tallies(&report.tallies));
    out
}

/// A finding with its text and figures.
pub fn finding(f: &Finding, width: usize) -> String {
    let (sign, words, tone) = mark(f.verdict);
    let head = format!("{} [{words}; {}]", f.title, f.place);
    let mut out = format!(
        "\n  {} {}\n",
        paint(style::of(tone), sign),
        wrap(&head, 4, width)
    );
    if !f.as_recorded {
        let warning = format!(
            "NOT AS RECORDED: {} has another verdict or figure on record, see --check",
            f.id
        );
        out.push_str(&format!("    {}\n", paint(BAD, &wrap(&warning, 4, width))));
    }
    out.push_str(&paragraph(&f.text, 4, width));
    let widest = f.figures.iter().map(|g| g.name.chars().count()).max();
    // Leaders up to a common column, as far as the names leave room.
    let column = widest.unwrap_or(0).min(width.saturating_sub(40));
    for g in &f.figures {
        let gap = column.saturating_sub(g.name.chars().count());
        let value = format!("{} {}", g.value, unit(g.unit));
        let line = format!(
            "      {} {} {}",
            g.name,
            ".".repeat(gap + 3),
            value.trim_end()
        );
        let line = match line.chars().count() {
            n if n <= width => line,
            _ => {
                let whole = format!("{}: {}", g.name, value.trim_end());
                format!("      {}", wrap(&whole, 8, width))
            }
        };
        out.push_str(&paint(DIM, &line));
        out.push('\n');
    }
    out
}

fn tallies(tallies: &[Tally]) -> String {
    let mut out = String::new();
    let mut tables: Vec<u32> = tallies.iter().map(|t| t.table).collect();
    tables.sort_unstable();
    tables.dedup();
    for number in tables {
        out.push_str(&format!(
            "\n{}\n",
            paint(BOLD, &format!("Table {number}: entries that agree"))
        ));
        let mut table = Table::new(
            &[
                "data",
                "column",
                "entries",
                "within ½ unit",
                "within 1",
                "worst units",
                "worst deviation",
            ],
            &[0, 1],
        );
        for t in tallies.iter().filter(|t| t.table == number) {
            let style = match (t.within_half, t.within_one) {
                (n, _) if n == t.entries => GOOD,
                (_, n) if n == t.entries => PLAIN,
                (_, n) if 2 * n >= t.entries => DOUBT,
                _ => BAD,
            };
            table.row(vec![
                (t.variant.replace('_', " "), PLAIN),
                (t.column.into(), PLAIN),
                (t.entries.to_string(), DIM),
                (t.within_half.to_string(), style),
                (t.within_one.to_string(), style),
                (short(t.worst_units), PLAIN),
                (short(t.worst), DIM),
            ]);
        }
        out.push_str(&table.render(2));
    }
    if !out.is_empty() {
        out.push_str(&paint(
            DIM,
            "  Units of the last printed digit; within ½ is the correct rounding.\n",
        ));
    }
    out
}

#[cfg(test)]
pub(crate) mod tests;
