//! Texts with numbers, `{formula:form}`, and conditions.

use super::super::entry::fault;
use super::Quantity;
use crate::papers::decided;
use crate::papers::ledger::Names;
use crate::reference::Ball;
use crate::study::StudyError;
use crate::study::document::{self, Item as Node};
use crate::symbolic::evaluation::{Balls, Evaluator, Value};
use crate::symbolic::graph::{Graph, Id};
use crate::symbolic::{Definitions, Expr};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A working precision of formulas, and the accuracy of integrals and roots in them.
type Precision = [u32; 2];

/// Far above the digits of any figure.
const PRECISE: Precision = [256, 128];
/// Enough for most conditions: an integral is enclosed in machine words.
const SHORT: Precision = [128, 80];
/// The most digits of a number.
const MOST_DIGITS: u32 = 50;

/// The quantities of a finding by their names.
type Quantities = BTreeMap<String, Quantity>;

/// The names that formulas of a finding may use.
pub(super) struct Scope<'a> {
    pub names: Names,
    /// Names of quantities that the finding is given; any if none.
    pub given: Option<&'a [&'static str]>,
    pub definitions: &'a Definitions,
}

/// A formula or condition of named quantities.
#[derive(Clone, Debug)]
pub(super) struct Formula {
    graph: Arc<Graph>,
    id: Id,
    /// The quantity that it is, where it is one.
    name: Option<String>,
}

impl Formula {
    fn evaluated<T>(
        &self,
        of: &Quantities,
        [bits, goal]: Precision,
        read: impl Fn(&mut Evaluator<Balls>, Id) -> Option<T>,
    ) -> Option<T> {
        let balls = Balls {
            exact: true,
            goal,
            ..Balls::new(bits)
        };
        let mut evaluator = Evaluator::new(Arc::clone(&self.graph), balls);
        for (k, name) in self.graph.inputs().iter().enumerate() {
            let value = match of.get(name)? {
                Quantity::Exact(x) => Value::rational(bits, x.clone()),
                Quantity::Printed(x) => Value::rational(bits, x.value.value.clone()),
                Quantity::Number(x) => Value::Real(x.clone()),
                Quantity::Text(_) | Quantity::Figures(_) => return None,
            };
            evaluator.set_input(k, value);
        }
        read(&mut evaluator, self.id)
    }

    /// Returns true if a condition is known to hold.
    fn holds(&self, of: &Quantities) -> bool {
        let tried = [SHORT, PRECISE].into_iter();
        let mut known = tried.filter_map(|p| self.evaluated(of, p, |all, id| all.holds(id).ok()));
        known.next() == Some(true)
    }

    /// The formula in digits.
    fn written(&self, of: &Quantities, form: &str) -> Option<String> {
        match self.name.as_ref().and_then(|name| of.get(name)) {
            Some(Quantity::Text(text)) => return Some(text.clone()),
            Some(Quantity::Printed(x)) if form.is_empty() => return Some(x.text.clone()),
            _ => {}
        }
        self.evaluated(of, PRECISE, |all, id| match (all.value(id).ok()?, form) {
            (Value::Exact(x), "/") => Some(x.number().to_string()),
            (_, "/") => None,
            (value, _) => formed(value.real()?, form),
        })
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

/// A text with numbers, `{formula:form}`; a doubled bracket is one of the text.
#[derive(Clone, Debug)]
pub(super) struct Template {
    /// Words, each before a number.
    fields: Vec<(String, Formula, String)>,
    last: String,
}

impl Template {
    /// The text with its numbers; `undecided` for one that is not known. Also returns true if all
    /// are known.
    pub fn written(&self, of: &Quantities) -> (String, bool) {
        let (mut text, mut known) = (String::new(), true);
        for (words, formula, form) in &self.fields {
            let number = formula.written(of, form);
            known &= number.is_some();
            text.extend([words.as_str(), &decided(number)]);
        }
        text.push_str(&self.last);
        (text, known)
    }
}

/// A condition of a finding on record.
#[derive(Clone, Debug)]
pub(super) enum Condition {
    /// A condition on numbers.
    Numbers(Formula),
    /// The text is this one.
    Text(Template, String),
}

impl Condition {
    /// Returns true if it is known to hold.
    pub fn holds(&self, of: &Quantities) -> bool {
        match self {
            Condition::Numbers(formula) => formula.holds(of),
            Condition::Text(template, words) => template.written(of) == (words.clone(), true),
        }
    }
}

impl Scope<'_> {
    fn formula(&self, node: &Node, text: &str) -> Result<Formula, StudyError> {
        let fault = |e| fault(e, node, &self.names);
        let e = self.names.expression(text).map_err(fault)?;
        let mut graph = Graph::new([]).of_any_names().of_real_functions();
        let id = graph.build(self.definitions, &e).map_err(fault)?;
        let is_given = |name: &String| self.given.is_none_or(|all| all.contains(&name.as_str()));
        if let Some(name) = graph.inputs().iter().find(|name| !is_given(name)) {
            return Err(node.fault(format!("{text:?}: {name} has no value")));
        }
        Ok(Formula {
            graph: Arc::new(graph),
            id,
            name: match e {
                Expr::Sym(name) => Some(name),
                _ => None,
            },
        })
    }

    /// Reads a text.
    ///
    /// # Errors
    /// A bracket without its partner, a formula that cannot be read, an unknown form.
    pub fn template(&self, node: &Node) -> Result<Template, StudyError> {
        // Brackets of the text are private characters until it is cut.
        let whole = node
            .text()?
            .replace("{{", "\u{e000}")
            .replace("}}", "\u{e001}");
        let words = |text: &str| text.replace('\u{e000}', "{").replace('\u{e001}', "}");
        let mut rest = whole.as_str();
        let mut fields = Vec::new();
        while let Some((before, more)) = rest.split_once('{') {
            let Some((field, after)) = more.split_once('}') else {
                return Err(node.fault("a { without its }"));
            };
            let (formula, form) = field.rsplit_once(':').unwrap_or((field, ""));
            if form != "/" && formed(&Ball::integer(PRECISE[0], 1), form).is_none() {
                let forms = "a number of digits, .DIGITS or .DIGITSe, with + for a sign, or /";
                return Err(node.fault(format!("the form {form:?} is none of: {forms}")));
            }
            fields.push((words(before), self.formula(node, formula)?, form.into()));
            rest = after;
        }
        let last = words(rest);
        Ok(Template { fields, last })
    }

    /// Reads a condition of the language, or `text is words`.
    ///
    /// # Errors
    /// As [`Scope::template`].
    pub fn condition(&self, node: &Node) -> Result<Condition, StudyError> {
        let text = node.text()?;
        match text.split_once(" is ") {
            None => self.formula(node, text).map(Condition::Numbers),
            Some((found, words)) => {
                let (place, value) = (node.place, document::Value::Text(found.into()));
                let found = self.template(&Node { place, value })?;
                Ok(Condition::Text(found, words.into()))
            }
        }
    }
}
