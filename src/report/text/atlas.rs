//! The atlas for people.

use super::style::{BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::claims::{Atlas, Decided, Figures, Row, Verdict, advice};
use crate::report::atlas::height;
use anstyle::Style;

/// Summary, rows, heights, claims, findings, what is missing, advice.
pub fn atlas(found: &Atlas, width: usize) -> String {
    let mut out = format!("{}\n\n", paint(BOLD, &summary(found)));
    out.push_str(&rows(found, width));
    out.push('\n');
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
        found.rows.len(),
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

/// Worst relative errors: of the norm and of Re in the ordinary region and beside the axis, then what is
/// counted over all regions.
fn rows(found: &Atlas, width: usize) -> String {
    let header = [
        "worst relative error",
        "norm",
        "Re",
        "Im",
        "p99",
        "p50",
        "beside: norm",
        "Re",
        "wings: Re",
        "wrong",
        "huge",
        "Re<0",
        "seam",
        "W'",
        "ns",
    ];
    let mut table = Table::new(&header, &[0]);
    for row in &found.rows {
        table.row(line(row));
    }
    let dispensable = ["p50", "p99", "Im", "wings: Re"];
    let mut out = table.fitted(width, &dispensable).render(0);
    let regions = found.rows.iter().flat_map(|r| &r.parts);
    let cases = regions
        .filter(|p| p.region == "ordinary")
        .map(|p| p.cases)
        .max();
    let note = format!(
        "Of {} points in each region: ordinary |Re z| < 8, Im z = 0.1..8; beside the axis Im z = 1e-8..0.1, \
         wings |Re z| = 8..1e4 there. wrong: NaN or infinity where a number is due, huge: those for |z| = 1e8..1e300; Re<0: where Re W > 0; seam: the largest relative jump of Re W where formulas meet.",
        cases.unwrap_or(0)
    );
    out.push_str(&paint(DIM, &paragraph(&note, 0, width)));
    out
}

fn line(row: &Row) -> Vec<(String, Style)> {
    let ordinary = row.part("ordinary");
    let beside = row.part("beside-axis");
    let norm = |f: Option<&Figures>, of: fn(&Figures) -> f64| error(f.map(of));
    let figures = ordinary.and_then(|p| p.norm.as_ref());
    let all = row.part("all");
    let huge = row.part("huge").map_or(0, |p| p.wrong);
    let jump = row.jumps.iter().map(|j| j.re).reduce(f64::max);
    vec![
        (row.name.clone(), PLAIN),
        norm(figures, |f| f.worst),
        error(ordinary.and_then(|p| p.re)),
        error(ordinary.and_then(|p| p.im)),
        norm(figures, |f| f.p99),
        norm(figures, |f| f.median),
        norm(beside.and_then(|p| p.norm.as_ref()), |f| f.worst),
        error(beside.and_then(|p| p.re)),
        error(row.part("wings").and_then(|p| p.re)),
        count(all.map_or(0, |p| p.wrong) - huge),
        count(huge),
        count(all.map_or(0, |p| p.negative)),
        error(jump),
        norm(row.derivative.as_ref(), |f| f.worst),
        match row.nanoseconds {
            Some(ns) => (format!("{ns:.0}"), PLAIN),
            None => ("–".into(), DIM),
        },
    ]
}

fn heights(found: &Atlas, width: usize) -> String {
    let header = [
        "reached from Im z on",
        "1e-4 norm",
        "each part",
        "1e-6 norm",
        "each part",
        "1e-10 norm",
        "each part",
        "2 ε norm",
        "each part",
    ];
    let mut table = Table::new(&header, &[0]);
    for row in &found.rows {
        let mut cells = vec![(row.name.clone(), PLAIN)];
        for h in &row.heights {
            for reached in [h.norm, h.parts] {
                cells.push(match reached {
                    Some(f64::NEG_INFINITY) => ("all".into(), GOOD),
                    Some(y) => (height(y), PLAIN),
                    None => ("–".into(), DIM),
                });
            }
        }
        table.row(cells);
    }
    let mut out = table.fitted(width, &[]).render(0);
    let note = "|Re z| < 1e5, Im z < 1e3, a band for every power of ten down to 1e-20 and the rest with the axis.";
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
