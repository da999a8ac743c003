//! Several codes side by side, and what has changed since an earlier report.

use super::style::{self, BAD, BOLD, DIM, GOOD, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::audit::{Comparison, Speed, Standing};
use crate::report::baseline::Changes;
use crate::report::words::audit::{budgets, candidate, kinds, share, verdict};
use crate::report::words::numbers::{percent, short};
use anstyle::Style;

/// Changes written out.
const SHOWN: usize = 40;

/// The codes, then region by region a line for each; the best are marked.
pub fn comparison(found: &Comparison, width: usize) -> String {
    let mut out = format!("{}\n", paint(BOLD, found.method));
    if let Some(first) = found.candidates.first() {
        let text = budgets(&first.report);
        out.push_str(&format!("  budget     {}\n", wrap(&text, 13, width)));
    }
    for (k, c) in found.candidates.iter().enumerate() {
        let (word, tone) = verdict(&c.report);
        let who = c.report.candidate.as_ref();
        let who = who.map_or("the method's own solver".into(), candidate);
        let speed = c
            .speed
            .map_or(String::new(), |s| format!("; {}", speed(&s)));
        let label = paint(BOLD, &letter(k));
        let word = paint(style::of(tone), word);
        let text = format!("{word}  {}: {who}{speed}", c.name);
        out.push_str(&format!("  {label:<2} {}\n", wrap(&text, 5, width)));
        if let Some(trouble) = c.report.candidate.as_ref().and_then(|c| c.trouble.as_ref()) {
            let text = paragraph(trouble, 5, width);
            out.push_str(&format!("{}\n", paint(BAD, text.trim_end())));
        }
    }
    let header = [
        "region",
        "",
        "cases",
        "failed",
        "of budget",
        "times the best",
        "worst ulps",
        "RMS",
        "wrong",
    ];
    let mut table = Table::new(&header, &[0, 1, 8]);
    for contest in &found.regions {
        for (k, s) in contest.standings.iter().enumerate() {
            let report = &found.candidates[k].report;
            let region = report.regions.iter().chain([&report.total]);
            let region = region.into_iter().rfind(|r| r.name == contest.region);
            let wrong = region.map_or(String::new(), |r| kinds(&r.kinds));
            table.row(line(k, contest.region, s, wrong));
        }
    }
    let dispensable = ["RMS", "cases", "wrong"];
    let table = table.fitted(width.saturating_sub(2), &dispensable);
    out.push_str(&table.render(2));
    out
}

fn letter(k: usize) -> String {
    match u8::try_from(k) {
        Ok(k) if k < 26 => char::from(b'A' + k).to_string(),
        _ => k.to_string(),
    }
}

fn line(k: usize, region: &str, s: &Standing, wrong: String) -> Vec<(String, Style)> {
    let mark = if s.best { "*" } else { " " };
    let emphasis = if s.best { GOOD } else { PLAIN };
    let failed = match s.failed {
        0 => ("–".into(), DIM),
        n => (n.to_string(), BAD),
    };
    let region = if k == 0 { region } else { "" };
    vec![
        (region.into(), PLAIN),
        (format!("{}{mark}", letter(k)), emphasis),
        (s.cases.to_string(), DIM),
        failed,
        (percent(s.of_budget), style::of(share(s.of_budget))),
        (s.ratio.map_or("–".into(), short), emphasis),
        (short(s.worst_ulps), PLAIN),
        (short(s.rms_ulps), PLAIN),
        (wrong, BAD),
    ]
}

/// The time of an answer, in words.
fn speed(s: &Speed) -> String {
    let each = short(s.ns_per_answer);
    match s.start_up_ms {
        Some(ms) => format!(
            "{each} ns an answer through the protocol, start-up {} ms",
            short(ms)
        ),
        None => format!("{each} ns an answer, called"),
    }
}

/// Values that are better and worse, the worse first.
pub fn changes(found: &Changes, width: usize) -> String {
    let worse = found.changes.iter().filter(|c| !c.better).count();
    let better = found.changes.len() - worse;
    let head = format!("Since the baseline: {worse} figures worse, {better} better");
    let mut out = format!("{}\n", paint(BOLD, &head));
    let header = ["", "of", "region", "output", "figure", "before", "now"];
    let mut table = Table::new(&header, &[0, 1, 2, 3, 4]);
    for c in found.changes.iter().take(SHOWN) {
        let (word, style) = if c.better {
            ("better", GOOD)
        } else {
            ("worse", BAD)
        };
        table.row(vec![
            (word.into(), style),
            (c.of.clone(), PLAIN),
            (c.region.clone(), PLAIN),
            (c.output.clone().unwrap_or_default(), PLAIN),
            (c.figure.into(), PLAIN),
            (short(c.before), PLAIN),
            (short(c.now), style),
        ]);
    }
    if !found.changes.is_empty() {
        out.push_str(&table.render(2));
    }
    let left = found.changes.len().saturating_sub(SHOWN);
    if left > 0 {
        let text = format!("{left} more; --format json lists all of them.");
        out.push_str(&paragraph(&text, 2, width));
    }
    for text in &found.not_compared {
        out.push_str(&paragraph(text, 2, width));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{CandidateReport, Kind};
    use crate::report::baseline::Change;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::{fabricated, passing};
    use crate::report::text::style::plain;

    #[test]
    fn a_table_fills_the_width_before_columns_give_way() {
        let found = Comparison::new("a-method", vec![(fabricated(), None), (passing(), None)]);
        let table = |width| {
            let text = plain(&comparison(&found, width));
            let start = text.find("  region ").unwrap();
            text[start..].to_string()
        };
        let whole = table(200);
        let longest = whole.lines().map(|l| l.chars().count()).max().unwrap();
        assert_eq!(table(longest), whole);
        assert!(!table(longest - 1).contains("RMS"), "{whole}");
    }

    #[test]
    fn codes_have_letters_as_far_as_these_go() {
        let seen = [0, 1, 25, 26, 300].map(letter);
        assert_eq!(seen, ["A", "B", "Z", "26", "300"]);
    }

    /// Every code has its verdict, and every region a line for each; changes beyond those shown are
    /// counted.
    #[test]
    fn comparisons() {
        let mut all = Gallery::default();
        let mut other = passing();
        other.candidate = Some(CandidateReport {
            name: "other".into(),
            answered: 800,
            trouble: Some("it stopped".into()),
            ..Default::default()
        });
        // The budget shown is that of the first.
        other.budgets[0].name = "p";
        other.regions[0].max_of_budget = 0.5;
        let mut first = fabricated();
        first.regions[0].kinds[Kind::Nan] = 2;
        let speed = |start_up_ms| Speed {
            ns_per_answer: 12.5,
            start_up_ms,
            answers: 9,
        };
        let both = vec![(first, Some(speed(None))), (other, Some(speed(Some(3.0))))];
        let found = Comparison::new("a-method", both);
        for width in [200, 40] {
            all.add(format!("on {width}"), comparison(&found, width));
        }
        let change = |figure, output: Option<&str>, before: f64, now: f64| Change {
            of: "a-method".into(),
            region: "wide".into(),
            output: output.map(Into::into),
            figure,
            before,
            now,
            better: now < before,
        };
        let mut found = Changes {
            changes: vec![
                change("of budget", Some("phi2"), 0.5, 0.75),
                change("worst ulps", Some("phi2"), 7.0, 5.0),
            ],
            not_compared: vec!["other: not in the baseline".into()],
        };
        all.add("changes", changes(&found, 100));
        found.not_compared.clear();
        for n in [0, SHOWN, SHOWN + 1] {
            found.changes = vec![change("failed", None, 0.0, 1.0); n];
            let text = changes(&found, 100);
            let lines: Vec<&str> = text.lines().collect();
            let ends = [&lines[..1], &lines[lines.len() - 1..]].concat().join("\n");
            all.add(
                format!("{n} changes"),
                format!("{} lines\n{ends}", lines.len()),
            );
        }
        all.pin("comparisons");
    }
}
