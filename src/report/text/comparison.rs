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
    use crate::report::baseline::Change;
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
    fn changes_beyond_those_shown_are_counted() {
        let change = Change {
            of: "a-method".into(),
            region: "wide".into(),
            output: None,
            figure: "failed",
            before: 0.0,
            now: 1.0,
            better: false,
        };
        let text = |n: usize| {
            let found = Changes {
                changes: vec![change.clone(); n],
                not_compared: Vec::new(),
            };
            plain(&changes(&found, 100))
        };
        assert_eq!(text(0), "Since the baseline: 0 figures worse, 0 better\n");
        let line = "  worse  a-method  wide            failed       0  1.00\n";
        for n in [SHOWN, SHOWN + 1] {
            let text = text(n);
            assert_eq!(text.matches(line).count(), SHOWN, "{text}");
            let rest = text.rsplit(line).next();
            let left = "  1 more; --format json lists all of them.\n";
            assert_eq!(rest, Some(if n > SHOWN { left } else { "" }), "{text}");
        }
    }

    #[test]
    fn codes_have_letters_as_far_as_these_go() {
        let seen = [0, 1, 25, 26, 300].map(letter);
        assert_eq!(seen, ["A", "B", "Z", "26", "300"]);
    }

    #[test]
    fn a_line_says_what_fails_and_marks_the_best() {
        let standing = Standing {
            cases: 400,
            failed: 0,
            wrong: 0,
            of_budget: 0.5,
            worst_ulps: 2.0,
            rms_ulps: 0.25,
            ratio: Some(1.0),
            best: true,
        };
        let cells = line(0, "wide", &standing, String::new());
        let due = [
            ("wide", PLAIN),
            ("A*", GOOD),
            ("400", DIM),
            ("–", DIM),
            ("50.00 %", PLAIN),
            ("1.00", GOOD),
            ("2.00", PLAIN),
            ("0.250", PLAIN),
            ("", BAD),
        ];
        assert_eq!(cells, due.map(|(text, style)| (text.to_string(), style)));
        let worse = Standing {
            failed: 3,
            of_budget: 1.5,
            ratio: None,
            best: false,
            ..standing
        };
        let cells = line(1, "wide", &worse, "3 NaN".into());
        let texts: Vec<&str> = cells.iter().map(|c| c.0.as_str()).collect();
        let due = [
            "", "B ", "400", "3", "150.0 %", "–", "2.00", "0.250", "3 NaN",
        ];
        assert_eq!(texts, due);
        assert_eq!((cells[1].1, cells[3].1, cells[4].1), (PLAIN, BAD, BAD));
    }

    #[test]
    fn a_program_says_what_its_start_takes() {
        let of = |start_up_ms| {
            speed(&Speed {
                ns_per_answer: 12.5,
                start_up_ms,
                answers: 9,
            })
        };
        assert_eq!(of(None), "12.50 ns an answer, called");
        let due = "12.50 ns an answer through the protocol, start-up 3.00 ms";
        assert_eq!(of(Some(3.0)), due);
    }

    #[test]
    fn every_code_has_its_verdict_and_every_region_its_lines() {
        let mut other = passing();
        other.candidate = Some(crate::audit::CandidateReport {
            name: "other".into(),
            answered: 800,
            trouble: Some("it stopped".into()),
            ..Default::default()
        });
        // The budget shown is that of the first.
        other.budgets[0].name = "p";
        let mut first = fabricated();
        first.regions[0].kinds[crate::audit::Kind::Nan] = 2;
        let speed = Speed {
            ns_per_answer: 12.5,
            start_up_ms: None,
            answers: 9,
        };
        let found = Comparison::new("a-method", vec![(first, Some(speed)), (other, None)]);
        let text = plain(&comparison(&found, 200));
        let [a, b] = [0, 1].map(|k| found.candidates[k].name.as_str());
        let due = format!(
            "a-method\n  budget     phi2: 4 ulp\n  A FAIL {a}: the method's own solver; 12.50 ns an answer, \
             called\n  B FAIL {b}: other, 800 answers\n     it stopped\n"
        );
        assert!(text.starts_with(&due), "{text}\n{due}");
        let words = |l: &str| l.split_whitespace().collect::<Vec<_>>().join(" ");
        let lines: Vec<String> = text.lines().skip(due.lines().count()).map(words).collect();
        assert_eq!(lines.len(), 1 + 3 * 2, "{text}");
        assert!(
            lines[1].starts_with("wide A") && lines[1].ends_with("2 NaN"),
            "{text}"
        );
        assert!(
            lines[2].starts_with('B') && lines[5].starts_with("all A"),
            "{text}"
        );
        assert_eq!(text.matches("NaN").count(), 1, "{text}");
        // Words are flush left, numbers right.
        let line =
            "\n  wide    A     400       1    175.0 %            1.00        7.25  0.400  2 NaN\n";
        assert!(text.contains(line), "{text}");
        let narrow = plain(&comparison(&found, 40));
        let mut own = narrow.lines().skip_while(|l| !l.starts_with("  A "));
        let second = own.nth(1).unwrap();
        let indent = second.len() - second.trim_start().len();
        assert_eq!(indent, 5, "{narrow}");
    }

    #[test]
    fn worse_and_better_are_counted_and_coloured() {
        let change = |figure, before: f64, now: f64| Change {
            of: "a-method".into(),
            region: "wide".into(),
            output: Some("phi2".into()),
            figure,
            before,
            now,
            better: now < before,
        };
        let found = Changes {
            changes: vec![
                change("of budget", 0.5, 0.75),
                change("worst ulps", 7.0, 5.0),
                change("RMS ulps", 2.0, 1.0),
            ],
            not_compared: vec!["other: not in the baseline".into()],
        };
        let text = changes(&found, 100);
        let head = "Since the baseline: 1 figures worse, 2 better\n";
        let due = [
            "          of        region  output  figure      before    now",
            "  worse   a-method  wide    phi2    of budget    0.500  0.750",
            "  better  a-method  wide    phi2    worst ulps    7.00   5.00",
            "  better  a-method  wide    phi2    RMS ulps      2.00   1.00",
            "  other: not in the baseline\n",
        ];
        let due = due.join("\n");
        assert_eq!(plain(&text), format!("{head}{due}"));
        for (style, now) in [(BAD, "0.750"), (GOOD, "5.00"), (GOOD, "1.00")] {
            assert!(text.contains(&paint(style, now)), "{text:?}");
        }
        assert!(text.contains(&paint(BAD, "worse")) && text.contains(&paint(GOOD, "better")));
    }
}
