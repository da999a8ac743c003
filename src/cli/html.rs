//! A paper's report as one page without outside parts.

use super::html_style::{CSS, PAPER_CSS};
use super::html_text::{math, prose};
use super::paper_csv::word;
use super::text::short;
use super::text_paper::{SUBJECTS, counts, mark, of_subject, unit};
use mechaudit::papers::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport,
};
use pulldown_latex::config::DisplayMode;
use std::collections::{BTreeMap, BTreeSet};

/// The characters of `text` that mean something in HTML, written out.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// The beginning of a page about a paper, up to where its contents are due.
pub fn begun(paper: &Citation, kind: &str, style: &str, counts: &str) -> String {
    let title = escape(paper.title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}: {kind}</title>\n<style>{CSS}{PAPER_CSS}{style}</style>\n</head>\n<body>\n\
         <h1>{title}</h1>\n<p class=\"soft\">{}{}, {}</p>\n<p>{}</p>\n<div class=\"page\">\n",
        escape(paper.authors),
        paper.year.map_or(String::new(), |y| format!(" ({y})")),
        escape(paper.venue),
        escape(counts)
    )
}

/// The end of such a page.
pub fn ended(version: &str) -> String {
    format!(
        "<p class=\"soft\">Written by mechaudit {}.</p>\n</main>\n</div>\n</body>\n</html>\n",
        escape(version)
    )
}

/// A line of the contents.
pub fn entry_of_contents(id: &str, tone: &str, sign: &str, name: &str) -> String {
    format!(
        "<li class=\"t-{tone}\"><a href=\"#{}\"><span class=\"sign\">{sign}</span> {}</a></li>\n",
        escape(id),
        prose(name)
    )
}

/// The page.
pub fn page(report: &PaperReport) -> String {
    let mut out = begun(&report.paper, "audit", "", &counts(report));
    out.push_str(&contents(report));
    out.push_str("<main>\n");
    for (subject, name) in SUBJECTS {
        let findings = of_subject(report, subject);
        if !findings.is_empty() {
            out.push_str(&format!("<h2 id=\"subject-{0}\">{0}</h2>\n", name));
            out.push_str("<div class=\"flow\">\n");
            let cards = findings.iter().zip(wide(&findings));
            cards.for_each(|(f, wide)| out.push_str(&finding(f, wide)));
            out.push_str("</div>\n");
        }
    }
    out.push_str(&tallies(report));
    out.push_str(&entries(report));
    out.push_str(&ended(report.mechaudit_version));
    out
}

fn tables(report: &PaperReport) -> BTreeSet<u32> {
    report.entries.iter().map(|e| e.table).collect()
}

fn contents(report: &PaperReport) -> String {
    let mut out = String::from("<nav class=\"toc\" aria-label=\"Contents\">\n<ul>\n");
    for (subject, name) in SUBJECTS {
        let findings = of_subject(report, subject);
        if findings.is_empty() {
            continue;
        }
        out.push_str(&format!(
            "<li><a href=\"#subject-{name}\"><b>{name}</b></a>\n<ul>\n"
        ));
        for f in findings {
            let (sign, _, _) = mark(f.verdict);
            out.push_str(&entry_of_contents(f.id, tone(f.verdict), sign, &f.title));
        }
        out.push_str("</ul></li>\n");
    }
    if !report.tallies.is_empty() {
        out.push_str("<li><a href=\"#tallies\"><b>Entries that agree</b></a></li>\n");
    }
    for n in tables(report) {
        out.push_str(&format!(
            "<li><a href=\"#table-{n}\"><b>Table {n} as printed</b></a></li>\n"
        ));
    }
    out.push_str("</ul>\n</nav>\n");
    out
}

fn tone(verdict: FindingVerdict) -> &'static str {
    match verdict {
        FindingVerdict::Confirmed => "good",
        FindingVerdict::ErrorOfPaper | FindingVerdict::Refuted => "bad",
        FindingVerdict::PrintOrScan | FindingVerdict::Unexplained => "doubt",
        FindingVerdict::Recovered => "new",
    }
}

/// Formulas of more characters than this have the width of the page.
pub const WIDE: usize = 75;

/// Which cards have the width of the page: those of long formulas, and those alone between them.
fn wide(findings: &[&Finding]) -> Vec<bool> {
    let long = |g: &Figure| g.latex.is_some() && g.value.chars().count() > WIDE;
    let own: Vec<bool> = findings
        .iter()
        .map(|f| f.figures.iter().any(long))
        .collect();
    let some = own.contains(&true);
    let at = |k: Option<usize>| k.and_then(|k| own.get(k)).is_none_or(|w| *w);
    (0..own.len())
        .map(|k| own[k] || (some && at(k.checked_sub(1)) && at(Some(k + 1))))
        .collect()
}

fn finding(f: &Finding, wide: bool) -> String {
    let (sign, words, _) = mark(f.verdict);
    let wide = if wide { " wide" } else { "" };
    let mut out = format!(
        "<article class=\"finding t-{}{wide}\" id=\"{}\">\n<h3>{}</h3>\n\
         <div class=\"tag\">{sign} {words} <span class=\"soft\">· {}</span></div>\n",
        tone(f.verdict),
        escape(f.id),
        prose(&f.title),
        prose(f.place)
    );
    if !f.as_recorded {
        out.push_str("<p class=\"alarm\">Not as recorded: earlier runs found otherwise.</p>\n");
    }
    out.push_str(&format!("<p>{}</p>\n", prose(&f.text)));
    if !f.figures.is_empty() {
        out.push_str("<dl class=\"figures\">\n");
        for g in &f.figures {
            let name = prose(&g.name);
            out.push_str(&match &g.latex {
                Some(latex) => format!(
                    "<dt>{name}</dt><dd class=\"formula\">{}</dd>\n",
                    math(latex, &g.value, DisplayMode::Block)
                ),
                None => format!(
                    "<dt>{name}</dt><dd>{} {}</dd>\n",
                    prose(&g.value),
                    escape(&unit(g.unit))
                ),
            });
        }
        out.push_str("</dl>\n");
    }
    out.push_str("</article>\n");
    out
}

fn tallies(report: &PaperReport) -> String {
    if report.tallies.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "<h2 id=\"tallies\">Entries that agree</h2>\n<p class=\"soft\">Deviations in units of the last printed \
         digit; within ½ is the correct rounding.</p>\n<div class=\"scroll\"><table>\n\
         <tr><th>table</th><th class=\"left\">data</th><th class=\"left\">column</th>\
         <th>entries</th><th>within ½</th><th>within 1</th><th>worst units</th>\
         <th>worst deviation</th></tr>\n",
    );
    let mut tallies: Vec<_> = report.tallies.iter().collect();
    tallies.sort_by_key(|t| t.table);
    for t in tallies {
        let class = match t.entries {
            n if n == t.within_half => "agrees",
            n if n == t.within_one => "rounding",
            _ => "",
        };
        out.push_str(&format!(
            "<tr class=\"{class}\"><td>{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td>\
             <td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            t.table,
            escape(&t.variant.replace('_', " ")),
            escape(t.column),
            t.entries,
            t.within_half,
            t.within_one,
            short(t.worst_units),
            short(t.worst)
        ));
    }
    out.push_str("</table></div>\n");
    out
}

fn entries(report: &PaperReport) -> String {
    let mut out = String::new();
    for (i, number) in tables(report).into_iter().enumerate() {
        let of: Vec<&Entry> = report
            .entries
            .iter()
            .filter(|e| e.table == number)
            .collect();
        out.push_str(&format!(
            "<h2 id=\"table-{number}\">Table {number} as printed</h2>\n"
        ));
        if i == 0 {
            out.push_str(
                "<p class=\"soft\">Point at an entry for the recomputed value.</p>\n\
                 <p class=\"legend\"><span class=\"agrees\">agrees</span>\
                 <span class=\"rounding\">within one unit</span>\
                 <span class=\"misprint\">misprint</span>\
                 <span class=\"unexplained\">unexplained</span></p>\n",
            );
        }
        let variants: BTreeSet<&str> = of.iter().flat_map(|e| e.variants.keys().copied()).collect();
        out.push_str("<div class=\"side\">\n");
        for variant in variants {
            out.push_str(&format!(
                "<details open><summary>Data: {}</summary>\n{}</details>\n",
                escape(&variant.replace('_', " ")),
                grid(&of, variant)
            ));
        }
        out.push_str("</div>\n");
    }
    out
}

fn grid(entries: &[&Entry], variant: &str) -> String {
    let mut columns: Vec<&str> = Vec::new();
    let mut rows: BTreeMap<u32, Vec<&Entry>> = BTreeMap::new();
    for e in entries {
        if !columns.contains(&e.column) {
            columns.push(e.column);
        }
        rows.entry(e.row).or_default().push(e);
    }
    let mut out = String::from("<table class=\"entries\">\n<tr><th>row</th>");
    columns
        .iter()
        .for_each(|c| out.push_str(&format!("<th>{}</th>", escape(c))));
    out.push_str("</tr>\n");
    for (row, cells) in rows {
        out.push_str(&format!("<tr><th>{row}</th>"));
        for column in &columns {
            match cells.iter().find(|e| e.column == *column) {
                Some(e) => out.push_str(&cell(e, variant)),
                None => out.push_str("<td></td>"),
            }
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table>\n");
    out
}

fn cell(e: &Entry, variant: &str) -> String {
    let printed = escape(&e.printed);
    let Some(r) = e.variants.get(variant) else {
        return format!("<td>{printed}</td>");
    };
    let mut tip = format!(
        "recomputed {}\n{} units of the last digit: {}",
        r.recomputed,
        short(r.units_in_last_digit),
        word(r.verdict)
    );
    if let Some(note) = &r.note {
        tip.push_str(&format!("\n{note}"));
    }
    let class = word(r.verdict);
    let focus = match r.verdict {
        EntryVerdict::Misprint | EntryVerdict::Unexplained => " tabindex=\"0\"",
        _ => "",
    };
    format!(
        "<td class=\"{class}\"{focus} data-tip=\"{}\">{printed}</td>",
        escape(&tip)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::text_paper::tests::fabricated;

    #[test]
    fn the_page_is_whole_escaped_and_without_outside_parts() {
        let html = page(&fabricated());
        for part in [
            "<!doctype html>",
            "On &lt;tests&gt; &amp; such",
            "prefers-color-scheme: dark",
            "class=\"misprint\" tabindex=\"0\" data-tip=\"recomputed 1.2345678901234567890\n12.00 units",
            "3 for 5",
            "Not as recorded",
            "</html>",
        ] {
            assert!(html.contains(part), "{part} is missing");
        }
        for outside in ["http:", "https:", "src=", "<script", "@import", "url("] {
            assert!(!html.contains(outside), "{outside}");
        }
        for tag in [
            "table", "tr", "td", "article", "details", "div", "dl", "nav", "ul", "li",
        ] {
            let opened = html.matches(&format!("<{tag}>")).count()
                + html.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }
}
