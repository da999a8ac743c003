//! A paper's entries as CSV: one line for each printed entry and variant of the data.

use super::words::paper::entry;
use crate::papers::PaperReport;
use std::io::Write;

/// Writes the entries.
pub fn paper(report: &PaperReport, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "table",
        "row",
        "column",
        "printed",
        "variant",
        "recomputed",
        "units_in_last_digit",
        "verdict",
    ])?;
    for e in &report.entries {
        for (variant, r) in &e.variants {
            csv.write_record([
                &e.table.to_string(),
                &e.row.to_string(),
                e.column,
                &e.printed,
                variant,
                &r.recomputed,
                &r.units_in_last_digit.to_string(),
                entry(r.verdict),
            ])?;
        }
    }
    Ok(csv.flush()?)
}

#[cfg(test)]
mod tests {
    #[test]
    fn one_line_for_each_entry_and_variant() {
        let mut out = Vec::new();
        super::paper(&crate::report::text::paper::tests::fabricated(), &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 3 * 2);
        assert_eq!(
            lines[3],
            "1,1,phi2,1.243,as_printed,1.2345678901234567890,12,misprint"
        );
    }
}
