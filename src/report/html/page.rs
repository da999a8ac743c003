//! The frame of every page: bar, contents, text, data and scripts.

use super::assets::{FRAME_CSS, FRAME_JS, source};
#[cfg(feature = "report")]
use super::assets::{MOTION_CSS, PAPER_CSS};
use super::glossary;
use super::prose::prose;
#[cfg(feature = "report")]
use crate::papers::Citation;
use crate::report::words::Tone;
use maud::{Markup, PreEscaped, html};
use serde::Serialize;

/// The class that gives an element its tone.
pub fn class(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "t-good",
        Tone::Bad => "t-bad",
        Tone::Doubt => "t-doubt",
        Tone::New | Tone::Plain => "t-new",
    }
}

/// A whole page.
pub struct Page<'a> {
    /// Its title.
    pub title: &'a str,
    /// The words of the bar beside the program's name.
    pub kind: &'a str,
    /// Style sheets in addition to the frame's.
    pub styles: &'a [&'a str],
    /// Lines of the contents.
    pub contents: Markup,
    /// The text.
    pub main: Markup,
    /// Topics of the columns in its tables; `main` names the columns where it has only some of
    /// them.
    pub columns: (&'a [&'a str], &'a [String]),
    /// Data for scripts: name of the element and JSON.
    pub data: &'a [(&'a str, String)],
    /// Scripts in addition to the frame's, in their order.
    pub scripts: &'a [&'a str],
}

impl Page<'_> {
    /// The page as text. Its content security policy lets no script run but those named by their
    /// digest, and nothing be fetched.
    pub fn write(&self) -> String {
        let scripts = || std::iter::once(FRAME_JS).chain(self.scripts.iter().copied());
        let allowed: Vec<String> = scripts().map(source).collect();
        let policy = format!(
            "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; \
             form-action 'none'; script-src {}",
            allowed.join(" ")
        );
        let page = html! {
            (PreEscaped("<!doctype html>\n"))
            html lang="en" { "\n"
                head { "\n"
                    meta charset="utf-8"; "\n"
                    meta http-equiv="Content-Security-Policy" content=(policy); "\n"
                    meta name="viewport" content="width=device-width, initial-scale=1"; "\n"
                    title { (self.title) } "\n"
                    style {
                        (PreEscaped(FRAME_CSS)) @for s in self.styles { (PreEscaped(*s)) }
                    } "\n"
                    // First of all: it says whether controls are shown, and in which colours.
                    script { (PreEscaped(FRAME_JS)) } "\n"
                } "\n"
                body { "\n"
                    a.skip href="#main" { "Skip to the text" } "\n"
                    header.bar {
                        b { "mechaudit" } span.kind { (self.kind) }
                        button.js #theme type="button" { "Colours: system" }
                    } "\n"
                    div.page { "\n"
                        nav.toc aria-label="Contents" tabindex="0" {
                            details open { summary { "Contents" } ul { "\n" (self.contents)
                                @if !self.columns.0.is_empty() {
                                    li { a href="#columns" { "What the columns mean" } } "\n"
                                }
                            } }
                        } "\n"
                        main #main { "\n"
                            (self.main)
                            (glossary::section(self.columns.0, self.columns.1))
                            footer { "Written by mechaudit " (env!("CARGO_PKG_VERSION")) "." } "\n"
                        } "\n"
                    } "\n"
                    @for (name, json) in self.data {
                        script type="application/json" id=(name) { (PreEscaped(json)) } "\n"
                    }
                    @for script in self.scripts { script { (PreEscaped(*script)) } "\n" }
                } "\n"
            } "\n"
        };
        page.into_string()
    }
}

/// JSON that can stand in a `script` element: no `<`, hence neither its end nor a comment.
pub fn embedded<T: Serialize>(value: &T) -> String {
    let text = serde_json::to_string(value).unwrap_or_else(|_| "null".into());
    text.replace('<', "\\u003c")
}

/// The verdict, in the first line of a page.
pub fn verdict(tone: Tone, word: &str, rest: &str) -> Markup {
    html! { p.verdict { span.{ "sign " (class(tone)) } { (word) } ": " (rest) } "\n" }
}

/// A button for each verdict that occurs, with how often, and a search field, over the elements
/// that `selector` finds.
pub fn filter(selector: &str, what: &str, verdicts: &[(String, usize)]) -> Markup {
    html! {
        div.filter.js role="group" aria-label={ "Filter of " (what) } data-of=(selector) {
            @for (name, n) in verdicts.iter().filter(|v| v.1 > 0) {
                button type="button" aria-pressed="false" data-verdict=(name) {
                    (name) " " span.n { (n) }
                } " "
            }
            input type="search" placeholder={ "search " (what) } aria-label={ "Search " (what) };
            output aria-live="polite" {}
        } "\n"
    }
}

#[cfg(feature = "report")]
/// How often each verdict occurs, in the order of first occurrence.
pub fn counted<'a>(verdicts: impl Iterator<Item = &'a str>) -> Vec<(String, usize)> {
    let mut all: Vec<(String, usize)> = Vec::new();
    for v in verdicts {
        match all.iter_mut().find(|a| a.0 == v) {
            Some(found) => found.1 += 1,
            None => all.push((v.into(), 1)),
        }
    }
    all
}

#[cfg(feature = "report")]
/// The parts of a page about a paper.
pub struct AboutPaper<'a> {
    /// The paper.
    pub paper: &'a Citation,
    /// Kind of page, for its title.
    pub kind: &'a str,
    /// True if all is as recorded, and how many there are of what.
    pub verdict: (bool, String),
    /// Lines of the contents.
    pub contents: Markup,
    /// Everything below.
    pub main: Markup,
    /// Topics of the columns in its tables.
    pub columns: &'a [&'a str],
    /// Data for scripts.
    pub data: &'a [(&'a str, String)],
    /// Scripts in addition to the frame's.
    pub scripts: &'a [&'a str],
}

#[cfg(feature = "report")]
impl AboutPaper<'_> {
    /// The page.
    pub fn page(self) -> String {
        let paper = self.paper;
        let by: Vec<String> = [paper.by(), paper.at()].into_iter().flatten().collect();
        let (tone, word) = match self.verdict.0 {
            true => (Tone::Good, "As recorded"),
            false => (Tone::Bad, "NOT as recorded"),
        };
        let main = html! {
            h1 { (paper.title) } "\n"
            p.soft { (by.join(", ")) } "\n"
            (verdict(tone, word, &format!("{}.", self.verdict.1)))
            (self.main)
        };
        let page = Page {
            title: &format!("{}: {}", paper.title, self.kind),
            kind: &format!("{} of {}", self.kind, paper.key),
            styles: &[PAPER_CSS, MOTION_CSS],
            contents: self.contents,
            main,
            columns: (self.columns, &[]),
            data: self.data,
            scripts: self.scripts,
        };
        page.write()
    }
}

/// A line of the contents.
pub fn entry_of_contents(id: &str, tone: Tone, sign: &str, name: &str) -> Markup {
    html! {
        li class=(class(tone)) {
            a href={ "#" (id) } { span.sign { (sign) } " " (prose(name)) }
        } "\n"
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::report::glossary::topics;

    /// The text between these two, each time.
    pub fn between<'a>(text: &'a str, before: &str, after: &str) -> Vec<&'a str> {
        let parts = text.split(before).skip(1);
        parts.map(|p| p.split(after).next().unwrap()).collect()
    }

    /// The page without its scripts' and style sheets' text, and how many scripts run.
    pub fn markup(page: &str) -> (String, usize) {
        let mut parts = page.split("<script>");
        let mut out = parts.next().unwrap().to_string();
        let mut scripts = 0;
        for part in parts {
            let (script, rest) = part.split_once("</script>").unwrap();
            assert!(page.contains(&source(script)), "a script out of the policy");
            out.push_str(rest);
            scripts += 1;
        }
        let style = out.find("<style>").unwrap()..out.find("</style>").unwrap();
        out.replace_range(style, "");
        (out, scripts)
    }

    /// Refuses a page that is not whole, or needs anything from outside.
    pub fn whole(page: &str) {
        assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
        assert!(page.len() < 2_000_000, "{} bytes", page.len());
        assert!(page.contains("content=\"default-src 'none';"));
        let (markup, _) = markup(page);
        for outside in ["http:", "https:", "src=", "@import", "url(", "merror"] {
            assert!(!markup.contains(outside), "{outside}");
        }
        explained(page, &markup);
        assert!(!markup.contains(" title=\""), "a text for the mouse alone");
        for tag in [
            "article", "button", "code", "dd", "details", "div", "dl", "dt", "figure", "li",
            "main", "math", "mrow", "nav", "p", "pre", "section", "span", "svg", "table", "tbody",
            "td", "th", "thead", "tr", "ul",
        ] {
            let opened = markup.matches(&format!("<{tag}>")).count()
                + markup.matches(&format!("<{tag} ")).count();
            assert_eq!(
                opened,
                markup.matches(&format!("</{tag}>")).count(),
                "{tag}"
            );
        }
    }

    /// Refuses a column that the page does not explain; heads of class `given` are names from
    /// outside.
    fn explained(page: &str, markup: &str) {
        let keys = between(page, "data-topic=\"", "\"");
        for head in between(markup, "<thead>", "</thead>") {
            for th in between(head, "<th", "</th>")
                .into_iter()
                .filter(|t| t.contains('>'))
            {
                let (tag, text) = th.split_once('>').unwrap();
                let text = text.split('<').next().unwrap().replace("&lt;", "<");
                let known = topics(&keys).any(|t| t.find(text.trim()).is_some());
                assert!(
                    known || text.is_empty() || tag.contains("given"),
                    "{text}: no meaning"
                );
            }
        }
    }

    #[test]
    fn data_end_no_script() {
        let hostile = "</script><script>alert(1)</script><!--\u{2028}'\"\\";
        let json = embedded(&[hostile]);
        assert!(!json.contains('<'), "{json}");
        let back: Vec<String> = serde_json::from_str(&json).unwrap();
        assert_eq!(back, [hostile]);
    }

    #[test]
    fn verdicts_are_counted_in_the_order_in_which_they_come() {
        let all = ["b", "a", "b", "b", "c", "a"];
        let due = [("b", 3), ("a", 2), ("c", 1)].map(|(v, n)| (v.to_string(), n));
        assert_eq!(counted(all.into_iter()), due);
        assert_eq!(counted([].into_iter()), []);
    }

    #[test]
    fn a_page_about_a_paper_says_at_once_whether_all_is_as_recorded() {
        let of = |year, recorded| {
            let about = AboutPaper {
                paper: &Citation {
                    key: "key",
                    authors: "A. Nobody",
                    title: "On tests",
                    year,
                    venue: "Nowhere",
                    source: "",
                },
                kind: "audit",
                verdict: (recorded, "2 findings".into()),
                contents: html! {},
                main: html! { "the rest" },
                columns: &[],
                data: &[],
                scripts: &[],
            };
            about.page()
        };
        let page = of(Some(1900), true);
        for part in [
            "<title>On tests: audit</title>",
            "audit of key",
            "<p class=\"soft\">A. Nobody (1900), Nowhere</p>",
            "<span class=\"sign t-good\">As recorded</span>: 2 findings.</p>\nthe rest",
        ] {
            assert!(page.contains(part), "{part} is missing");
        }
        let page = of(None, false);
        assert!(page.contains("<p class=\"soft\">A. Nobody, Nowhere</p>"));
        assert!(page.contains("<span class=\"sign t-bad\">NOT as recorded</span>"));
    }
}
