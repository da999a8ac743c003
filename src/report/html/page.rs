//! What every page has: its head, its style, its end.

use super::prose::prose;
use super::style::{CSS, PAPER_CSS};
use crate::papers::Citation;
use crate::report::words::Tone;
use maud::{Markup, PreEscaped, html};

/// The class that gives an element its tone.
pub fn class(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "t-good",
        Tone::Bad => "t-bad",
        Tone::Doubt => "t-doubt",
        Tone::New | Tone::Plain => "t-new",
    }
}

/// A whole page with a style of its own besides the common one.
pub fn document(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (PreEscaped("<!doctype html>\n"))
        html lang="en" { "\n"
            head { "\n"
                meta charset="utf-8"; "\n"
                meta name="viewport" content="width=device-width, initial-scale=1"; "\n"
                title { (title) } "\n"
                style { (PreEscaped(CSS)) (PreEscaped(style)) } "\n"
            } "\n"
            body { "\n" (body) } "\n"
        } "\n"
    };
    page.into_string()
}

/// The verdict, in the first line of a page.
pub fn verdict(tone: Tone, word: &str, rest: &str) -> Markup {
    html! { p.verdict { span.{ "sign " (class(tone)) } { (word) } ": " (rest) } "\n" }
}

/// What a page about a paper consists of.
pub struct AboutPaper<'a> {
    /// The paper.
    pub paper: &'a Citation,
    /// Kind of page, for its title.
    pub kind: &'a str,
    /// Style besides that of all such pages.
    pub style: &'a str,
    /// Whether all is as recorded, and how many there are of what.
    pub verdict: (bool, String),
    /// Lines of the contents.
    pub contents: Markup,
    /// Everything below.
    pub main: Markup,
    /// Version of the program.
    pub version: &'a str,
}

impl AboutPaper<'_> {
    /// The page.
    pub fn page(&self) -> String {
        let paper = self.paper;
        let year = paper.year.map_or(String::new(), |y| format!(" ({y})"));
        let (tone, word) = match self.verdict.0 {
            true => (Tone::Good, "As recorded"),
            false => (Tone::Bad, "NOT as recorded"),
        };
        let body = html! {
            h1 { (paper.title) } "\n"
            p.soft { (paper.authors) (year) ", " (paper.venue) } "\n"
            (verdict(tone, word, &format!("{}.", self.verdict.1)))
            div.page { "\n"
                nav.toc aria-label="Contents" { "\n" ul { "\n" (self.contents) } "\n" } "\n"
                main { "\n"
                    (self.main)
                    p.soft { "Written by mechaudit " (self.version) "." } "\n"
                } "\n"
            } "\n"
        };
        let title = format!("{}: {}", paper.title, self.kind);
        document(&title, &format!("{PAPER_CSS}{}", self.style), &body)
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
    /// Refuses a page that is not whole, or needs anything from outside.
    pub fn whole(page: &str) {
        assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
        for outside in [
            "http:", "https:", "src=", "<script", "@import", "url(", "merror",
        ] {
            assert!(!page.contains(outside), "{outside}");
        }
        for tag in [
            "article", "code", "dd", "details", "div", "dl", "dt", "figure", "li", "main", "math",
            "mrow", "nav", "p", "pre", "span", "svg", "table", "td", "th", "tr", "ul",
        ] {
            let opened = page.matches(&format!("<{tag}>")).count()
                + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }
}
