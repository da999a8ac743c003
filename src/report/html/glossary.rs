//! The columns of a page's tables, explained at its end.

use super::prose::prose;
use crate::report::glossary::{SEPARATOR, topics};
use maud::{Markup, html};

/// The entries of these topics that explain some of the named columns; all of them without names.
pub fn section(keys: &[&str], names: &[String]) -> Markup {
    let only = topics(keys).count() == 1;
    html! {
        @if !keys.is_empty() { h2 #columns { "What the columns mean" } "\n" }
        @for topic in topics(keys) {
            details open[only] data-topic=(topic.key) { summary { (topic.title) } "\n"
                dl.columns { "\n"
                    @for c in topic.shown(names) {
                        @let unit = c.unit();
                        div {
                            dt { @for (k, name) in c.names.split(SEPARATOR).enumerate() {
                                @if k > 0 { ", " } code { (name) }
                            } }
                            dd { (prose(c.meaning)) @if !unit.is_empty() { ", in " (unit) } }
                        } "\n"
                    }
                } "\n"
            } "\n"
        }
    }
}
