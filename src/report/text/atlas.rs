//! The atlas for people.

use super::style::{BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::claims::{Atlas, Decided, Figures, Row, Verdict, advice};
use crate::report::atlas::worst_jump;
use anstyle::Style;

/// Summary, rows, heights, claims, findings, what is missing, advice.
pub fn atlas(found: &Atlas, width: usize) -> String {
    let mut out = format!("{}\n\n", paint(BOLD, &summary(found)));
    out.push_str(&rows(found, width));
    out.push_str(&heights(found, width));
    out.push_str(&format!("\n{}\n", paint(BOLD, "Claims")));
    for claim in &found.claims {
        out.push_str(&decided(claim, width));
    }
    if !found.findings.is_empty() {
        out.push_str(&format!("\n{}\n", paint(BOLD, "Findings")));
        for f in &found.findings {
            out.push_str(&paragraph(&f.sentence, 2, width));
            out.push_str(&format!("    {}\n", paint(DIM, &f.reproduce)));
        }
    }
    if !found.not_at_hand.is_empty() {
        out.push_str(&format!("\n{}\n", paint(BOLD, "Not at hand")));
        for m in &found.not_at_hand {
            out.push_str(&paragraph(
                &format!("{} ({}): {}", m.name, m.source, m.why),
                2,
                width,
            ));
        }
    }
    out.push_str(&format!("\n{}\n", paint(BOLD, "What meets which need")));
    for a in advice(&found.rows) {
        out.push_str(&paragraph(&format!("{}: {}", a.need, a.words()), 2, width));
    }
    out
}

/// How many of what.
pub fn summary(found: &Atlas) -> String {
    let each = [
        Verdict::Holds,
        Verdict::InPart,
        Verdict::Refuted,
        Verdict::Open,
        Verdict::NotTestable,
    ];
    let each = each
        .into_iter()
        .map(|v| (v, found.count(v)))
        .filter(|v| v.1 > 0)
        .map(|(v, n)| format!("{n} {}", v.words()));
    let claims: Vec<String> = each.collect();
    format!(
        "{} codes; {} claims: {}.",
        found.rows.len() + found.profiles.len(),
        found.claims.len(),
        claims.join(", ")
    )
}

fn error(x: Option<f64>) -> (String, Style) {
    match x {
        Some(x) => (format!("{x:.1e}"), PLAIN),
        None => ("–".into(), DIM),
    }
}

fn count(n: u64) -> (String, Style) {
    match n {
        0 => ("–".into(), DIM),
        n => (n.to_string(), BAD),
    }
}

/// The longest name in a table.
const NAME: usize = 32;

fn name(row: &Row) -> (String, Style) {
    let long = row.name.chars().count() > NAME;
    let shown: String = match long {
        true => row.name.chars().take(NAME - 1).chain(['…']).collect(),
        false => row.name.clone(),
    };
    (shown, PLAIN)
}

type Cells = fn(&Row) -> Vec<(String, Style)>;

/// A table with a title, a line for each row, and a note.
fn table(
    (title, header): (&str, &[&'static str]),
    rows: &[Row],
    cells: Cells,
    note: &str,
    width: usize,
) -> String {
    let mut table = Table::new(header, &[0]);
    for row in rows {
        table.row([vec![name(row)], cells(row)].concat());
    }
    let mut out = format!("{}\n{}", paint(BOLD, title), table.render(0));
    out.push_str(&paint(DIM, &paragraph(note, 0, width)));
    out.push('\n');
    out
}

/// Worst relative errors in the ordinary region and beside the axis, then what is counted over all
/// regions.
fn rows(found: &Atlas, width: usize) -> String {
    let regions = found.rows.iter().flat_map(|r| &r.parts);
    let cases = regions
        .filter(|p| p.region == "ordinary")
        .map(|p| p.cases)
        .max();
    let worst = format!(
        "Worst found of {} points a region. norm, Re: ordinary, |Re z| < 8, Im z = 0.1..8; beside Re: of Re W at \
         Im z = 1e-8..0.1; W': by -2zW + 2i/sqrt(pi), ordinary; ns: a value, all in one run, programs as they measure \
         themselves.",
        cases.unwrap_or(0)
    );
    let mut out = table(
        (
            "Worst relative errors",
            &["", "norm", "Re", "beside Re", "W'", "ns"],
        ),
        &found.rows,
        worst_errors,
        &worst,
        width,
    );
    out.push_str(&table(
        (
            "More of them",
            &["", "p50", "p99", "Im", "grid", "wings"],
        ),
        &found.rows,
        more_errors,
        "p50, p99: half and 99 % of the errors of the norm are below, ordinary; grid: of Re W where Re z is a multiple of 1/4, Im z = 1e-12..0.1; wings: of Re W, |Re z| = 8..1e4, Im z = 1e-8..0.1.",
        width,
    ));
    out.push_str(&table(
        (
            "What no line shape does",
            &["", "wrong", "huge", "Re<0", "seam", "rising"],
        ),
        &found.rows,
        counts,
        "Over all regions. wrong: NaN or infinity where a number is due, huge: those for |z| = 1e8..1e300; Re<0: negative \
         where Re W > 0; seam: the largest relative jump of Re W between neighbouring floats; rising: level crossings of \
         seams at which Re W rises away from the imaginary axis, where it falls.",
        width,
    ));
    if !found.profiles.is_empty() {
        out.push_str(&lines(found, width));
    }
    out
}

/// The Hartmann–Tran profile.
fn lines(found: &Atlas, width: usize) -> String {
    let cases = found.profiles.iter().flat_map(|r| &r.parts);
    let cases = cases.filter(|p| p.region == "wings").map(|p| p.cases).max();
    let note = format!(
        "Worst relative error of Re found of {} lines a region: Gamma_0 of 1e-5..0.1, 0.1..10, 10..1000 Doppler widths \
         within 8 widths of the centre, farther out, without shifts and correlation (rautian). Re<0: of all regions.",
        cases.unwrap_or(0)
    );
    table(
        (
            "Hartmann-Tran profile",
            &[
                "", "doppler", "mixed", "coll.", "wings", "rautian", "Re<0", "ns",
            ],
        ),
        &found.profiles,
        |row| {
            let regions = ["doppler", "mixed", "collisions", "wings", "rautian"];
            let re = |name: &&str| {
                let asked = row.part(name).filter(|p| p.cases > 0);
                short_error(asked.and_then(|p| p.re))
            };
            let mut cells: Vec<(String, Style)> = regions.iter().map(re).collect();
            cells.push(count(row.part("all").map_or(0, |p| p.negative)));
            cells.push(time(row));
            cells
        },
        &note,
        width,
    )
}

/// One digit.
fn short_error(x: Option<f64>) -> (String, Style) {
    match x {
        Some(x) => (format!("{x:.0e}"), PLAIN),
        None => ("–".into(), DIM),
    }
}

fn time(row: &Row) -> (String, Style) {
    match row.nanoseconds {
        Some(ns) => (format!("{ns:.0}"), PLAIN),
        None => ("–".into(), DIM),
    }
}

fn of(f: Option<&Figures>, part: fn(&Figures) -> f64) -> (String, Style) {
    error(f.map(part))
}

fn norm<'a>(row: &'a Row, region: &str) -> Option<&'a Figures> {
    row.part(region).and_then(|p| p.norm.as_ref())
}

fn worst_errors(row: &Row) -> Vec<(String, Style)> {
    vec![
        of(norm(row, "ordinary"), |f| f.worst),
        error(row.part("ordinary").and_then(|p| p.re)),
        error(row.part("beside-axis").and_then(|p| p.re)),
        of(row.derivative.as_ref(), |f| f.worst),
        time(row),
    ]
}

fn more_errors(row: &Row) -> Vec<(String, Style)> {
    vec![
        of(norm(row, "ordinary"), |f| f.median),
        of(norm(row, "ordinary"), |f| f.p99),
        error(row.part("ordinary").and_then(|p| p.im)),
        error(row.part("grid").and_then(|p| p.re)),
        error(row.part("wings").and_then(|p| p.re)),
    ]
}

fn counts(row: &Row) -> Vec<(String, Style)> {
    let all = row.part("all");
    let huge = row.part("huge").map_or(0, |p| p.wrong);
    vec![
        count(all.map_or(0, |p| p.wrong) - huge),
        count(huge),
        count(all.map_or(0, |p| p.negative)),
        error(worst_jump(row)),
        count(row.jumps.iter().map(|j| j.rising).sum()),
    ]
}

fn heights(found: &Atlas, width: usize) -> String {
    let reached = |h: Option<f64>| match h {
        Some(f64::NEG_INFINITY) => "all".to_string(),
        Some(k) => format!("{k}"),
        None => "–".into(),
    };
    let mut table = Table::new(&["", "1e-4", "1e-6", "1e-10", "2 ε"], &[0]);
    for row in &found.rows {
        let mut cells = vec![name(row)];
        for h in &row.heights {
            let all = [h.norm, h.parts] == [Some(f64::NEG_INFINITY); 2];
            let text = format!("{} / {}", reached(h.norm), reached(h.parts));
            cells.push((text, if all { GOOD } else { PLAIN }));
        }
        table.row(cells);
    }
    let title = "Where an accuracy is met: the k of Im z >= 10^k, of the norm / of each part";
    let mut out = format!("{}\n{}", paint(BOLD, title), table.render(0));
    let note = "all: every Im z >= 0; –: nowhere. |Re z| < 1e5, Im z < 1e3, a band for every power of ten down to 1e-20 and the rest with the axis.";
    out.push_str(&paint(DIM, &paragraph(note, 0, width)));
    out
}

fn decided(c: &Decided, width: usize) -> String {
    let style = match c.verdict {
        Verdict::Holds => GOOD,
        Verdict::InPart | Verdict::Open => DOUBT,
        Verdict::Refuted => BAD,
        Verdict::NotTestable => DIM,
    };
    let mut out = format!("  {} {}\n", c.algorithm, paint(style, c.verdict.words()));
    let said = format!("“{}” ({})", c.statement, c.source);
    out.push_str(&format!("    {}\n", wrap(&said, 4, width)));
    let mut facts = Vec::new();
    if !c.measure.is_empty() {
        facts.push(format!("{}; {}", c.measure, c.domain));
    }
    if !c.reading.is_empty() {
        facts.push(c.reading.into());
    }
    if let (Some(found), Some(bound)) = (c.found, c.bound) {
        let within = c.within.map_or(String::new(), |w| format!(" ± {w:.1e}"));
        facts.push(format!(
            "found {found:.2e}{within}, bound {bound:.2e}, {} points",
            c.points
        ));
    }
    if c.verdict == Verdict::InPart {
        facts.push(format!("holds {}", c.part));
    }
    out.push_str(&format!("    {}\n", wrap(&facts.join("; "), 4, width)));
    if let Some(command) = &c.reproduce {
        out.push_str(&format!("    {}\n", paint(DIM, command)));
    }
    out
}

#[cfg(test)]
mod tests;
