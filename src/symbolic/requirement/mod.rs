//! Requirements: equations, closeness, inequalities.

pub mod boxes;
mod conditions;
mod names;

pub use conditions::{Conditions, Domain};
pub use names::Names;

use crate::{
    Definitions, Equation, Expr, Func, Identity, Outcome, Point, SymbolicError, Witness, enclose,
    is_real, latex, latex_equation,
};
use mechaudit_reference::Ball;
use rug::Rational;
use std::collections::BTreeMap;
use std::fmt;

/// A requirement on expressions.
#[derive(Clone, Debug)]
pub enum Requirement {
    /// `left = right`, for all values of the symbols.
    Equal(Equation),
    /// `left ~ right within bound`: `|left − right| ≤ bound`.
    Near(Expr, Expr, Expr),
    /// `left < right`, of real numbers.
    Less(Expr, Expr),
}

impl Requirement {
    /// Reads a requirement.
    ///
    /// # Errors
    /// A formula that cannot be parsed.
    pub fn parse(text: &str) -> Result<Requirement, SymbolicError> {
        Requirement::read(text, &Names::default())
    }

    /// Reads a requirement that uses these names.
    ///
    /// # Errors
    /// A formula that cannot be parsed, or a name that is not declared.
    pub fn read(text: &str, names: &Names) -> Result<Requirement, SymbolicError> {
        // The place of an error is that in the whole text.
        let parse = |part: &str| {
            names.expression(part).map_err(|e| {
                let before = part.as_ptr() as usize - text.as_ptr() as usize;
                moved(e, before)
            })
        };
        if let Some((left, rest)) = text.split_once('~') {
            let (right, bound) =
                rest.split_once(" within ")
                    .ok_or_else(|| SymbolicError::Parse {
                        at: left.len(),
                        reason: "expected 'within'".into(),
                    })?;
            return Ok(Requirement::Near(
                parse(left)?,
                parse(right)?,
                parse(bound)?,
            ));
        }
        if let Some((left, right)) = text.split_once('<') {
            return Ok(Requirement::Less(parse(left)?, parse(right)?));
        }
        names.equation(text).map(Requirement::Equal)
    }

    /// The requirement in LaTeX, without delimiters.
    pub fn latex(&self) -> String {
        match self {
            Requirement::Equal(e) => latex_equation(e),
            Requirement::Near(a, b, c) => {
                format!(r"\left|{} - {}\right| \le {}", latex(a), latex(b), latex(c))
            }
            Requirement::Less(a, b) => format!("{} < {}", latex(a), latex(b)),
        }
    }

    /// The requirement with an expression in the place of a symbol, after all derivatives.
    fn at(self, name: &str, value: &Expr) -> Requirement {
        let at = |e: Expr| Expr::At(Box::new(e), name.into(), Box::new(value.clone()));
        match self {
            Requirement::Equal(e) => Requirement::Equal(Equation {
                left: at(e.left),
                right: at(e.right),
            }),
            Requirement::Near(a, b, c) => Requirement::Near(at(a), at(b), at(c)),
            Requirement::Less(a, b) => Requirement::Less(at(a), at(b)),
        }
    }

    /// Returns the expression that an inequality requires to be positive.
    fn slack(&self) -> Option<Expr> {
        match self {
            Requirement::Equal(_) => None,
            Requirement::Near(a, b, c) => {
                let size = Expr::call(Func::Abs, minus(a, b));
                Some(minus(c, &size))
            }
            Requirement::Less(a, b) => Some(minus(b, a)),
        }
    }

    /// The sides.
    fn sides(&self) -> [&Expr; 2] {
        match self {
            Requirement::Equal(e) => [&e.left, &e.right],
            Requirement::Near(a, b, _) | Requirement::Less(a, b) => [a, b],
        }
    }

    /// Decides it. An inequality with free symbols is not proved by what holds at a point, but it
    /// is refuted by one sample at which it fails. The named values are those of symbols at which
    /// it is to be refuted.
    pub fn decide(
        &self,
        definitions: &Definitions,
        named: &BTreeMap<String, Rational>,
    ) -> Identity {
        if let Requirement::Equal(e) = self {
            return Identity::near(definitions, e, named);
        }
        let found = self.decide_at(definitions, &Point::default());
        if !matches!(found.error, Some(SymbolicError::NoValue(_))) {
            return found;
        }
        let point = |number| Point {
            named: named.clone(),
            sample: Some(number),
        };
        (0..SAMPLES)
            .map(|number| self.decide_at(definitions, &point(number)))
            .find(|sample| sample.outcome == Outcome::Refuted)
            .unwrap_or(found)
    }

    fn decide_at(&self, definitions: &Definitions, point: &Point) -> Identity {
        // A number that may be complex is not less than another.
        let real = |e: &Expr| {
            let z = enclose(definitions, e, point)?;
            match z.im.is_zero() || is_real(definitions, e) {
                true => Ok(z.re),
                false => Err(SymbolicError::Unsupported(format!("the order of {e}"))),
            }
        };
        // The slack has to be non-negative, or positive.
        let (difference, slack, strict) = match self {
            Requirement::Equal(e) => return Identity::near(definitions, e, &point.named),
            Requirement::Near(a, b, bound) => {
                let e = minus(a, b);
                let difference = enclose(definitions, &e, point);
                let slack = difference.clone().and_then(|d| {
                    let size = match d.im.is_zero() || is_real(definitions, &e) {
                        true => d.re.abs(),
                        false => d.norm_sqr().sqrt(),
                    };
                    real(bound).map(|c| c - size)
                });
                (difference.map(|d| d.re), slack, false)
            }
            Requirement::Less(a, b) => (real(&minus(a, b)), real(&minus(b, a)), true),
        };
        let outcome = match &slack {
            Ok(s) if s.is_positive() || (!strict && s.is_zero()) => Outcome::Proved,
            Ok(s) if s.is_negative() || (strict && s.is_zero()) => Outcome::Refuted,
            _ => Outcome::Undecided,
        };
        let witness = difference.as_ref().ok().map(|d| Witness {
            point: point.values_of(definitions, &minus(self.sides()[0], self.sides()[1])),
            residual: shown(d),
        });
        Identity {
            outcome,
            residual: None,
            witness: witness.filter(|_| outcome == Outcome::Refuted),
            error: slack.err(),
        }
    }
}

/// The text that is read back.
impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Requirement::Equal(e) => write!(f, "{e}"),
            Requirement::Near(a, b, c) => write!(f, "{a} ~ {b} within {c}"),
            Requirement::Less(a, b) => write!(f, "{a} < {b}"),
        }
    }
}

fn minus(a: &Expr, b: &Expr) -> Expr {
    Expr::Add(vec![a.clone(), Expr::Neg(Box::new(b.clone()))])
}

/// An error at a place that lies further on.
fn moved(error: SymbolicError, by: usize) -> SymbolicError {
    match error {
        SymbolicError::Parse { at, reason } => SymbolicError::Parse {
            at: at + by,
            reason,
        },
        SymbolicError::Unknown { at, name } => SymbolicError::Unknown { at: at + by, name },
        other => other,
    }
}

/// Sample points tried for a refutation.
const SAMPLES: u32 = 6;

fn shown(x: &Ball) -> String {
    x.to_decimal(6)
        .unwrap_or_else(|| format!("{:.6e}", x.to_f64()))
}

#[cfg(test)]
mod tests;
