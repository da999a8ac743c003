//! Findings in words and figures of what an analysis in Rust measured.

mod text;

use super::claim::SUBJECTS;
use super::read::{Reading, required, text, texts, word};
use super::summary::VERDICTS;
use super::table::shared;
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject, figure};
use crate::reference::Ball;
use crate::study::document::{Item as Node, Value};
use crate::study::{StudyError, intern};
use crate::symbolic::Definitions;
use std::collections::BTreeMap;
use text::{Condition, Names, Template};

/// Working precision of formulas, far above the digits of any figure.
const BITS: u32 = 256;

/// A quantity that an analysis hands to the findings of a paper.
#[derive(Clone, Debug)]
pub enum Quantity {
    /// A number with its enclosure.
    Number(Ball),
    /// A text.
    Text(String),
    /// Figures as they are.
    Figures(Vec<Figure>),
}

/// The quantities of an analysis by their names.
#[derive(Clone, Debug, Default)]
pub struct Measured(pub BTreeMap<String, Quantity>);

impl Measured {
    /// Hands over a number. One that is not finite stays unknown: no finding that needs it is as
    /// recorded.
    pub fn set(&mut self, name: impl Into<String>, x: f64) {
        if x.is_finite() {
            self.add(name, Quantity::Number(Ball::exact(BITS, x)));
        }
    }

    /// Hands over any quantity.
    pub fn add(&mut self, name: impl Into<String>, value: Quantity) {
        self.0.insert(name.into(), value);
    }
}

/// A finding with its figures and the conditions on record.
#[derive(Clone, Debug)]
pub struct Measurement {
    id: &'static str,
    subject: Subject,
    place: &'static str,
    verdict: FindingVerdict,
    title: Template,
    text: Template,
    lines: Vec<Line>,
    conditions: Vec<Condition>,
    definitions: Definitions,
}

/// A line of a finding's figures.
#[derive(Clone, Debug)]
enum Line {
    /// A list that the analysis hands over.
    List(&'static str),
    /// Name and value of a figure, its unit, and its value on record.
    One([Template; 2], &'static str, Option<&'static str>),
}

/// Reads a finding.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Measurement, StudyError> {
    node.only(&[
        "id", "subject", "place", "verdict", "title", "text", "with", "figures", "holds",
    ])?;
    let lines = required(node, "figures")?.list()?;
    let conditions = texts(node.get("holds"))?;
    let conditions = conditions.into_iter().map(Condition::read);
    required(node, "place")?;
    let finding = Measurement {
        id: reading.id(node)?,
        subject: word(node.get("subject"), &SUBJECTS, Subject::Formula)?,
        place: text(node, "place")?,
        verdict: word(
            Some(required(node, "verdict")?),
            &VERDICTS,
            FindingVerdict::Unexplained,
        )?,
        title: Template::read(required(node, "title")?)?,
        text: Template::read(required(node, "text")?)?,
        lines: lines.iter().map(line).collect::<Result<_, _>>()?,
        conditions: conditions.collect::<Result<_, _>>()?,
        definitions: shared(reading, node)?.0,
    };
    let is_judged = |line: &Line| matches!(line, Line::One(.., Some(_)));
    match finding.conditions.is_empty() && !finding.lines.iter().any(is_judged) {
        true => Err(node.fault("a finding has at least one condition or value on record")),
        false => Ok(finding),
    }
}

/// `[name, value, unit, value on record]`, the last of which may be missing, or the name of a list.
fn line(node: &Node) -> Result<Line, StudyError> {
    let Value::List(parts) = &node.value else {
        return node.text().map(|name| Line::List(intern(name)));
    };
    let [name, value, unit, recorded @ ..] = &parts[..] else {
        return Err(node.fault("a figure is [name, value, unit, value on record]"));
    };
    let recorded = recorded.first().map(|r| r.text().map(intern)).transpose()?;
    let both = [Template::read(name)?, Template::read(value)?];
    Ok(Line::One(both, intern(unit.text()?), recorded))
}

impl Measurement {
    /// The finding, which is as recorded if its figures are, its conditions hold and every number
    /// in it is known.
    pub(in crate::papers) fn finding(&self, measured: &Measured) -> Finding {
        let names = Names {
            measured,
            definitions: &self.definitions,
        };
        let mut same = self.conditions.iter().all(|c| c.holds(&names));
        let mut known = true;
        let mut written = |template: &Template| {
            let (text, all) = template.written(&names);
            known &= all;
            text
        };
        let (title, text) = (written(&self.title), written(&self.text));
        let mut figures = Vec::new();
        for line in &self.lines {
            match line {
                Line::List(name) => match measured.0.get(*name) {
                    Some(Quantity::Figures(list)) => figures.extend(list.iter().cloned()),
                    _ => same = false,
                },
                Line::One(both, unit, recorded) => {
                    let [name, value] = both.each_ref().map(&mut written);
                    same &= recorded.is_none_or(|recorded| recorded == value);
                    figures.push(figure(name, value, unit));
                }
            }
        }
        Draft::new(self.id, self.subject, self.place)
            .verdict(self.verdict)
            .titled(title)
            .text(text)
            .figures(figures)
            .recorded_if(same && known)
    }
}

#[cfg(test)]
mod tests;
