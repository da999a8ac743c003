//! Texts with numbers, `{formula:form}`, and conditions.

use super::{BITS, Measured, Quantity};
use crate::papers::decided;
use crate::reference::Ball;
use crate::study::StudyError;
use crate::study::document::{self, Item as Node};
use crate::symbolic::evaluation::{Balls, Evaluator, Value};
use crate::symbolic::graph::{Graph, Id};
use crate::symbolic::{Definitions, Expr, parse};
use std::sync::Arc;

/// The most digits of a number.
const MOST_DIGITS: u32 = 50;

/// The names that formulas of a finding may use.
pub(super) struct Names<'a> {
    pub measured: &'a Measured,
    pub definitions: &'a Definitions,
}

impl Names<'_> {
    fn evaluated<T>(
        &self,
        e: &Expr,
        read: impl Fn(&mut Evaluator<Balls>, Id) -> Option<T>,
    ) -> Option<T> {
        let mut graph = Graph::new([]).of_any_names().of_real_functions();
        let id = graph.build(self.definitions, e).ok()?;
        let graph = Arc::new(graph);
        let mut evaluator = Evaluator::new(Arc::clone(&graph), Balls::new(BITS));
        for (k, name) in graph.inputs().iter().enumerate() {
            let Some(Quantity::Number(x)) = self.measured.0.get(name) else {
                return None;
            };
            evaluator.set_input(k, Value::Real(x.clone()));
        }
        read(&mut evaluator, id)
    }

    /// Returns true if a condition is known to hold.
    fn holds(&self, e: &Expr) -> bool {
        self.evaluated(e, |all, id| all.holds(id).ok()) == Some(true)
    }

    /// A formula in digits.
    fn written(&self, e: &Expr, form: &str) -> Option<String> {
        if let Expr::Sym(name) = e
            && let Some(Quantity::Text(text)) = self.measured.0.get(name)
        {
            return Some(text.clone());
        }
        formed(
            &self.evaluated(e, |all, id| all.value(id).ok()?.real().cloned())?,
            form,
        )
    }
}

/// A number in its form, if it is known to as many digits: `+` for the sign; then nothing for the
/// shortest digits of binary64, `5` significant ones, `.5` after the point or `.5e`.
fn formed(x: &Ball, form: &str) -> Option<String> {
    let count = |text: &str| text.parse().ok().filter(|n: &u32| *n <= MOST_DIGITS);
    let digits = form.trim_start_matches('+');
    let text = match digits
        .strip_prefix('.')
        .map(|rest| (rest, rest.strip_suffix('e')))
    {
        None if digits.is_empty() => x.to_decimal(17).map(|_| x.to_f64().to_string()),
        None => x.to_decimal(count(digits).filter(|n| *n > 0)? as usize),
        Some((rest, None)) => x.to_fixed(count(rest)?),
        Some((_, Some(n))) => {
            let n = count(n)? as usize;
            x.to_decimal(n + 2).map(|_| format!("{:.n$e}", x.to_f64()))
        }
    }?;
    let is_signed = form.starts_with('+') && !text.starts_with('-');
    Some(if is_signed { format!("+{text}") } else { text })
}

/// A text with numbers: `{formula:form}`.
#[derive(Clone, Debug)]
pub(super) struct Template {
    /// Words, each before a number.
    fields: Vec<(String, Expr, String)>,
    last: String,
}

impl Template {
    /// Reads a text.
    ///
    /// # Errors
    /// A bracket without its partner, a formula that cannot be read, an unknown form.
    pub fn read(node: &Node) -> Result<Template, StudyError> {
        let mut rest = node.text()?;
        let mut fields = Vec::new();
        while let Some((words, more)) = rest.split_once('{') {
            let Some((field, after)) = more.split_once('}') else {
                return Err(node.fault("a { without its }"));
            };
            let (formula, form) = field.rsplit_once(':').unwrap_or((field, ""));
            if formed(&Ball::integer(BITS, 1), form).is_none() {
                let forms = "a number of digits, .DIGITS or .DIGITSe, with + for a sign";
                return Err(node.fault(format!("the form {form:?} is none of: {forms}")));
            }
            fields.push((words.into(), expression(node, formula)?, form.into()));
            rest = after;
        }
        let last = rest.into();
        Ok(Template { fields, last })
    }

    /// The text with its numbers; `undecided` for one that is not known. Also returns true if all
    /// are known.
    pub fn written(&self, names: &Names) -> (String, bool) {
        let (mut text, mut known) = (String::new(), true);
        for (words, e, form) in &self.fields {
            let number = names.written(e, form);
            known &= number.is_some();
            text.extend([words.as_str(), &decided(number)]);
        }
        text.push_str(&self.last);
        (text, known)
    }
}

fn expression(node: &Node, text: &str) -> Result<Expr, StudyError> {
    parse(text).map_err(|e| node.fault(format!("{text:?}: {e}")))
}

/// A condition of a finding on record.
#[derive(Clone, Debug)]
pub(super) enum Condition {
    /// A condition on numbers.
    Numbers(Expr),
    /// The text is this one.
    Text(Template, String),
}

impl Condition {
    /// Reads a condition of the language, or `text is words`.
    ///
    /// # Errors
    /// As [`Template::read`].
    pub fn read(node: &Node) -> Result<Condition, StudyError> {
        let text = node.text()?;
        match text.split_once(" is ") {
            None => expression(node, text).map(Condition::Numbers),
            Some((found, words)) => {
                let (place, value) = (node.place, document::Value::Text(found.into()));
                let found = Template::read(&Node { place, value })?;
                Ok(Condition::Text(found, words.into()))
            }
        }
    }

    /// Returns true if it is known to hold.
    pub fn holds(&self, names: &Names) -> bool {
        match self {
            Condition::Numbers(e) => names.holds(e),
            Condition::Text(template, words) => template.written(names) == (words.clone(), true),
        }
    }
}
