//! The meanings of the columns of every table. Pages, `--help` and the book take their explanations
//! from here.

mod judging;
mod motions;

use super::columns::{Columns, is_angle};
use std::fmt::Write;

/// Stands between the names of an entry.
pub const SEPARATOR: &str = " | ";

/// One column, or several that mean the same.
pub struct Column {
    /// The names, separated by [`SEPARATOR`]. `*` stands for the number of a link, or the name of a
    /// body, a point, a joint, an output or a program.
    pub names: &'static str,
    /// The unit where the name does not carry it; empty where there is none.
    pub unit: &'static str,
    /// The meaning: a phrase without a full stop.
    pub meaning: &'static str,
}

/// The columns that some command prints together.
pub struct Topic {
    /// How pages and commands refer to it.
    pub key: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// Its columns, special names before patterns that match them too.
    pub columns: &'static [Column],
}

const fn column(names: &'static str, unit: &'static str, meaning: &'static str) -> Column {
    Column {
        names,
        unit,
        meaning,
    }
}

/// All topics, in the order of the book.
pub static TOPICS: &[Topic] = &[
    motions::LINKAGE,
    motions::RUN_UP,
    motions::WORK_PRECISION,
    motions::CHIRP_HISTORY,
    motions::CHIRP_CHART,
    motions::CHIRP_SPECTRUM,
    judging::AUDIT,
    judging::CAMPAIGN,
    judging::COMPARISON,
    judging::CONVERGENCE,
    judging::PAPER,
    judging::PUBLISHED,
    judging::HARD,
    judging::PROOF,
    judging::DESCRIBE,
    judging::VALUES,
];

/// The topics of these keys, in the order of the book.
pub fn topics(keys: &[&str]) -> impl Iterator<Item = &'static Topic> {
    TOPICS.iter().filter(move |t| keys.contains(&t.key))
}

impl Topic {
    /// The entry that explains a column of this name.
    pub fn find(&self, name: &str) -> Option<&'static Column> {
        self.columns.iter().find(|c| c.matches(name))
    }

    /// The entries that explain some of these columns; all where none is named.
    pub fn shown(&self, names: &[String]) -> Vec<&'static Column> {
        let used = |c: &&Column| {
            let explained = |n: &String| self.find(n).is_some_and(|f| std::ptr::eq(f, *c));
            names.is_empty() || names.iter().any(explained)
        };
        self.columns.iter().filter(used).collect()
    }
}

impl Column {
    /// Returns true if one of the names is this one, in whatever unit; `of budget` is the same as
    /// `of_budget`.
    fn matches(&self, name: &str) -> bool {
        let plain = |name: &str| name.replace(' ', "_");
        let stem = |name: &str| Columns::from(vec![plain(name)]).stem(0).to_string();
        let due = stem(name);
        self.names.split(SEPARATOR).any(|n| {
            let pattern = stem(n);
            n == name || (fits(&pattern, &due) && (pattern != "*" || is_angle(name)))
        })
    }

    /// The unit as people write it.
    pub fn unit(&self) -> String {
        match self.unit {
            "" => Columns::from(vec![
                self.names.split(SEPARATOR).next().unwrap_or("").into(),
            ])
            .unit(0),
            unit => unit.into(),
        }
    }
}

/// Returns true if a name is of this form; `*` stands for one character or more.
fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((head, rest)) => name.strip_prefix(head).is_some_and(|tail| {
            let ends = tail.char_indices().map(|(k, c)| k + c.len_utf8());
            ends.into_iter().any(|k| fits(rest, &tail[k..]))
        }),
    }
}

/// Width of a help text.
const WIDTH: usize = 80;

/// The end of a help text: the columns of these topics.
pub fn help(before: &str, keys: &[&str]) -> String {
    let mut out = before.trim_end().to_string();
    for topic in topics(keys) {
        let _ = write!(out, "\n\n{}:", topic.title);
        for c in topic.columns {
            let unit = if c.unit.is_empty() { "" } else { ", in " };
            let text = format!("{}{unit}{}", c.meaning, c.unit);
            let names = c.names.replace(SEPARATOR, ", ");
            let _ = write!(out, "\n  {names:<22}");
            // The meaning of a long name begins below it.
            let mut at = if names.chars().count() > 22 {
                WIDTH
            } else {
                24
            };
            for word in text.split(' ') {
                if at + 1 + word.chars().count() > WIDTH {
                    let _ = write!(out, "\n{:24}", "");
                    at = 24;
                }
                let _ = write!(out, " {word}");
                at += 1 + word.chars().count();
            }
        }
    }
    out
}

/// The chapter of the book.
pub fn chapter() -> String {
    let mut out = String::from(
        "The columns of all tables.\n\n\
         `*` stands for the number of a link, or for the name of a body, a point, a joint, an output or a\n\
         program. Units are those without `--units`.\n",
    );
    for topic in TOPICS {
        let _ = write!(
            out,
            "\n# {}\n\n| column | unit | meaning |\n|---|---|---|\n",
            topic.title
        );
        for c in topic.columns {
            let names: Vec<String> = c.names.split(SEPARATOR).map(|n| format!("`{n}`")).collect();
            let meaning = c
                .meaning
                .replace('|', "\\|")
                .replace('*', "\\*")
                .replace('_', "\\_");
            let _ = writeln!(out, "| {} | {} | {meaning} |", names.join(", "), c.unit());
        }
    }
    out
}

#[cfg(test)]
mod tests;
