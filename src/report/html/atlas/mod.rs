//! The atlas as one page: findings, claims, the table, error maps on one colour scale, work and
//! precision.

mod tables;

use super::assets::{ATLAS_CSS, ATLAS_JS, AUDIT_CSS, D3_JS, FIGURES_JS, PLOT_JS};
use super::page::{Page, class, counted, embedded, filter, verdict};
use crate::claims::{Atlas, Decided, LEVELS, Map, Verdict, advice};
use crate::report::text::atlas::summary;
use crate::report::words::Tone;
use maud::{Markup, html};
use serde::Serialize;

/// Name, nanoseconds, worst errors of the norm and of Re in the ordinary region, of Re beside the
/// axis.
type Work<'a> = (&'a str, f64, Option<f64>, Option<f64>, Option<f64>);

/// The data of the script.
#[derive(Serialize)]
struct Data<'a> {
    levels: &'a str,
    maps: &'a [(String, Map)],
    work: Vec<Work<'a>>,
}

/// The page.
pub fn page(found: &Atlas, maps: &[(String, Map)]) -> String {
    let work = found.rows.iter().filter_map(|r| {
        let ordinary = r.part("ordinary")?;
        let norm = ordinary.norm.as_ref().map(|f| f.worst);
        let beside = r.part("beside-axis").and_then(|p| p.re);
        Some((
            r.name.as_str(),
            r.nanoseconds?,
            norm.filter(|_| !r.real_part_only),
            ordinary.re,
            beside,
        ))
    });
    let data = Data {
        levels: LEVELS,
        maps,
        work: work.collect(),
    };
    let main = html! {
        h1 { "The atlas: what is claimed about W(z) and Voigt, beside what is certified" } "\n"
        (verdict(Tone::Plain, "Found", &summary(found)))
        p.soft {
            "Errors are relative and upper bounds by certified references; worst is the worst found of "
            (found.effort.cases) " points a region, seed " (found.effort.seed)
            ". A claim is refuted by the point that is named; it holds as far as an audit of its domain and a "
            "hunt in it have searched."
        } "\n"
        (findings(found))
        (claims(found))
        (tables::rows(found))
        (tables::heights(found))
        @if !found.profiles.is_empty() { (tables::lines(found)) }
        @if !maps.is_empty() { (figures(maps.len())) }
        (choosing(found))
        (missing(found))
    };
    let page = Page {
        title: "The atlas of W(z) and Voigt",
        kind: "atlas",
        styles: &[AUDIT_CSS, ATLAS_CSS],
        contents: contents(found, !maps.is_empty()),
        main,
        columns: (&["atlas"], &[]),
        data: &[("atlas-data", embedded(&data))],
        scripts: &[D3_JS, PLOT_JS, FIGURES_JS, ATLAS_JS],
    };
    page.write()
}

fn contents(found: &Atlas, mapped: bool) -> Markup {
    let line = |id: &str, name: &str| html! { li { a href={ "#" (id) } { (name) } } "\n" };
    html! {
        @if !found.findings.is_empty() { (line("findings", "Findings")) }
        (line("claims", "Claims"))
        (line("rows", "Worst errors"))
        (line("heights", "Accuracy by the distance to the axis"))
        @if !found.profiles.is_empty() { (line("lines", "Hartmann-Tran profile")) }
        @if mapped {
            (line("maps", "Error maps"))
            (line("work", "Work and precision"))
        }
        (line("advice", "What meets which need"))
        @if !found.not_at_hand.is_empty() { (line("missing", "Not at hand")) }
    }
}

fn findings(found: &Atlas) -> Markup {
    html! {
        @if !found.findings.is_empty() {
            section { "\n"
                h2 #findings { "Findings" } "\n"
                @for f in &found.findings {
                    div.finding.t-bad {
                        p { (f.sentence) }
                        p.small { code { (f.reproduce) } }
                    } "\n"
                }
            } "\n"
        }
    }
}

fn tone(v: Verdict) -> Tone {
    match v {
        Verdict::Holds => Tone::Good,
        Verdict::Refuted => Tone::Bad,
        Verdict::InPart | Verdict::Open => Tone::Doubt,
        Verdict::NotTestable => Tone::Plain,
    }
}

fn claims(found: &Atlas) -> Markup {
    let verdicts = found.claims.iter().map(|c| c.verdict.words());
    html! {
        section data-filtered="" { "\n"
            h2 #claims { "Claims" } "\n"
            (filter(".claim", "claims", &counted(verdicts)))
            @for c in &found.claims { (claim(c)) }
        } "\n"
    }
}

fn claim(c: &Decided) -> Markup {
    html! {
        div.{ "finding claim " (class(tone(c.verdict))) } data-verdict=(c.verdict.words()) {
            p { b { (c.algorithm) } " " span.sign { (c.verdict.words()) }
                @if c.verdict == Verdict::InPart { " " (c.part) } }
            p { "“" (c.statement) "” " span.soft { (c.source) } }
            p.small {
                @if !c.measure.is_empty() { (c.measure) "; " (c.domain) ". " }
                @if !c.reading.is_empty() { "Read as: " (c.reading) ". " }
                @if let (Some(x), Some(bound)) = (c.found, c.bound) {
                    "Found " (format!("{x:.2e}"))
                    @if let Some(w) = c.within { " ± " (format!("{w:.1e}")) }
                    ", bound " (format!("{bound:.2e}")) ", " (c.points) " points."
                }
            }
            @if let Some(command) = &c.reproduce { p.small { code { (command) } } }
        } "\n"
    }
}

fn figures(maps: usize) -> Markup {
    html! {
        section { "\n"
            h2 #maps { "Error maps" } "\n"
            p {
                "Relative errors of " (maps) " codes on one colour scale: Re z from 0 to 16 across, Im z from 1e-16 to "
                "100 up, logarithmically. Of the norm, or the larger of the two parts."
            } "\n"
            div.js #atlas-keys {} "\n"
            div.js.figures #atlas-maps {} "\n"
        } "\n"
        section { "\n"
            h2 #work { "Work and precision" } "\n"
            p {
                "Nanoseconds a value on one core, each code in turn in one run, programs as they measure themselves at the "
                "same points, against the worst relative error found. Farther down and to the left is better."
            } "\n"
            div.js.figures #atlas-work {} "\n"
        } "\n"
    }
}

fn choosing(found: &Atlas) -> Markup {
    let timed = found.rows.iter().any(|r| r.nanoseconds.is_some());
    html! {
        section { "\n"
            h2 #advice { "What meets which need" } "\n"
            p.soft { "At every point that was tried; the fastest by the times of this run, double precision alone." } "\n"
            dl {
                @for a in advice(&found.rows) {
                    dt { (a.need) }
                    dd { (a.words())
                        @if let [first, ..] = a.codes.as_slice() && timed { "; fastest: " (first) } }
                }
            } "\n"
        } "\n"
    }
}

fn missing(found: &Atlas) -> Markup {
    html! {
        @if !found.not_at_hand.is_empty() {
            section { "\n"
                h2 #missing { "Not at hand" } "\n"
                @for m in &found.not_at_hand { p { b { (m.name) } " (" (m.source) "): " (m.why) } "\n" }
            } "\n"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Code, Effort, PROFILES, atlas, find, map};
    use crate::report::html::page::tests::whole;

    #[test]
    fn the_page_is_whole() {
        let a = find("humlicek-1982").unwrap();
        let codes = [Code::double(a)];
        let effort = Effort { cases: 4, seed: 1 };
        let found = atlas(&codes, &PROFILES[..1], &effort, true, &|_| ());
        let maps = vec![("humlicek-1982".to_string(), map(&codes[0]))];
        let page = page(&found, &maps);
        whole(&page);
        for part in [
            "id=\"claims\"",
            "id=\"maps\"",
            "id=\"work\"",
            "id=\"lines\"",
            "“Relative accuracy ~1e-4 everywhere”",
        ] {
            assert!(page.contains(part), "{part}");
        }
    }

    #[test]
    fn a_claim_says_what_was_found_in_the_tone_of_its_verdict() {
        for (verdict, class, part) in [
            (Verdict::Holds, "t-good", false),
            (Verdict::Refuted, "t-bad", false),
            (Verdict::InPart, "t-doubt", true),
            (Verdict::Open, "t-doubt", false),
            (Verdict::NotTestable, "t-new", false),
        ] {
            let c = crate::report::atlas::tests::claim(verdict);
            let html = claim(&c).into_string();
            let start = format!("<div class=\"finding claim {class}\"");
            assert!(html.starts_with(&start), "{html}");
            assert_eq!(html.contains("from Im z = 1 on"), part);
            let found = "relative error; everywhere. Read as: of the norm. Found 2.00e-7 ± 1.0e-9, bound 1.00e-6, 10 points.";
            assert!(html.contains(found), "{html}");
        }
    }

    #[test]
    fn the_page_has_what_there_is() {
        let mut found = crate::report::atlas::tests::fabricated();
        let maps = vec![(
            "first".to_string(),
            map(&Code::double(find("humlicek-1982").unwrap())),
        )];
        let full = page(&found, &maps);
        let work = "\"work\":[[\"first\",12.345,0.001,0.002,0.04]]";
        assert!(full.contains(work), "{work} is missing");
        assert!(full.contains("; fastest: first</dd>"), "{full}");
        found.rows[0].real_part_only = true;
        assert!(page(&found, &maps).contains("[[\"first\",12.345,null,0.002,0.04]]"));
        found.rows[0].nanoseconds = None;
        assert!(!page(&found, &maps).contains("fastest: first"));
        let ids = ["findings", "lines", "maps", "work", "missing"];
        for id in ids {
            assert!(full.contains(&format!("id=\"{id}\"")), "{id}");
            assert!(full.contains(&format!("href=\"#{id}\"")), "{id}");
        }
        found.findings.clear();
        found.profiles.clear();
        found.not_at_hand.clear();
        let bare = page(&found, &[]);
        for id in ids {
            assert!(!bare.contains(&format!("id=\"{id}\"")), "{id}");
            assert!(!bare.contains(&format!("href=\"#{id}\"")), "{id}");
        }
    }
}
