//! Formal series: where they may stand.

use super::error::unsupported;
use super::expr::{EACH, Expr, Func};
use super::{Definitions, SymbolicError};
use std::collections::{BTreeMap, BTreeSet};

/// Returns true if a formal series occurs, definitions followed.
pub(super) fn is_formal(definitions: &Definitions, e: &Expr) -> bool {
    definitions.any(
        e,
        |e| matches!(e, Expr::Sum(b) if b.to == Expr::Sym(EACH.into())),
    )
}

/// Checks that `series(n, f)` occurs in an expression only where the value is linear in it.
///
/// Series are compared term by term, so that a product or a function of a series has no meaning:
/// `series(n, a[n])*series(n, b[n])` is not `series(n, a[n]*b[n])`.
///
/// # Errors
/// [`SymbolicError::Unsupported`] for a series anywhere else.
pub(super) fn check(definitions: &Definitions, e: &Expr) -> Result<(), SymbolicError> {
    let mut check = Check {
        definitions,
        known: BTreeMap::new(),
        derivations: BTreeSet::new(),
    };
    check.is_series(e).map(|_| ())
}

struct Check<'a> {
    definitions: &'a Definitions,
    /// The kind of each definition; `None` while one is looked through.
    known: BTreeMap<&'a str, Option<bool>>,
    /// Derivations whose images are looked through.
    derivations: BTreeSet<&'a str>,
}

impl<'a> Check<'a> {
    fn definition(&mut self, name: &'a str) -> Result<bool, SymbolicError> {
        let Some(body) = self.definitions.names.get(name) else {
            return Ok(false);
        };
        match self.known.get(name) {
            Some(Some(found)) => return Ok(*found),
            // The name bound inside of its own definition, or a circle, which is refused later.
            Some(None) => return Ok(false),
            None => {}
        }
        self.known.insert(name, None);
        let found = self.is_series(body)?;
        self.known.insert(name, Some(found));
        Ok(found)
    }

    /// Returns an error unless none of the parts is a series.
    fn scalar(&mut self, parts: &[&'a Expr], place: &str) -> Result<(), SymbolicError> {
        for part in parts {
            if self.is_series(part)? {
                return unsupported(format!("a series in {place}"));
            }
        }
        Ok(())
    }

    fn is_series(&mut self, e: &'a Expr) -> Result<bool, SymbolicError> {
        match e {
            Expr::Num(_) | Expr::Constant(_) | Expr::I | Expr::Truth(_) => Ok(false),
            Expr::Sym(name) => self.definition(name),
            Expr::Index(name, index) => {
                self.scalar(&[index], "an index")?;
                // The name with that index, or with any number.
                let is_member = |key: &str| {
                    let suffix = key.strip_prefix(name.as_str());
                    suffix
                        .and_then(|s| s.strip_prefix('_'))
                        .is_some_and(|k| k.parse::<i64>().is_ok() || **index == Expr::Sym(k.into()))
                };
                let definitions = self.definitions;
                for member in definitions.names.keys().filter(|key| is_member(key)) {
                    if self.definition(member)? {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
            Expr::Neg(x) => self.is_series(x),
            Expr::Call(Func::Re | Func::Im, x) if x.len() == 1 => self.is_series(&x[0]),
            Expr::Add(terms) => {
                let mut found = false;
                for x in terms {
                    found |= self.is_series(x)?;
                }
                Ok(found)
            }
            Expr::Mul(factors) => {
                let mut found = false;
                for x in factors {
                    if self.is_series(x)? && std::mem::replace(&mut found, true) {
                        return unsupported("a product of series");
                    }
                }
                Ok(found)
            }
            Expr::Div(a, b) => {
                self.scalar(&[b], "a divisor")?;
                self.is_series(a)
            }
            Expr::Pow(x, 1) => self.is_series(x),
            Expr::Pow(x, _) => self.scalar(&[x], "a power").map(|()| false),
            Expr::Call(f, x) => {
                let x: Vec<&Expr> = x.iter().collect();
                self.scalar(&x, f.name()).map(|()| false)
            }
            Expr::Root(..)
            | Expr::Compare(..)
            | Expr::And(_)
            | Expr::Or(_)
            | Expr::Not(_)
            | Expr::If(_)
            | Expr::Let(..)
            | Expr::While(_) => self.scalar(&e.children(), "a condition").map(|()| false),
            Expr::Int(b) => {
                self.scalar(&[&b.from, &b.to], "a limit")?;
                self.is_series(&b.body)
            }
            Expr::Sum(b) if b.to == Expr::Sym(EACH.into()) => {
                self.scalar(&[&b.body], "a series").map(|()| true)
            }
            Expr::Sum(b) => {
                self.scalar(&[&b.from, &b.to], "a limit")?;
                self.is_series(&b.body)
            }
            Expr::Diff(x, by) => {
                let definitions = self.definitions;
                let first = self.derivations.insert(by);
                let images = definitions.derivations.get(by).into_iter().flatten();
                for (_, image) in images.filter(|_| first) {
                    self.scalar(&[image], "a derivation")?;
                }
                self.is_series(x)
            }
            Expr::At(x, _, value) => {
                self.scalar(&[value], "a value")?;
                self.is_series(x)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Definitions, Identity, Outcome, parse_equation};

    fn outcome(lines: &[&str], text: &str) -> Outcome {
        let definitions = Definitions::read(lines).unwrap();
        Identity::of(&definitions, &parse_equation(text).unwrap()).outcome
    }

    #[test]
    fn series_are_equal_if_their_terms_are() {
        for text in [
            "series(n, a[n]*cos(n*x)) = series(k, cos(k*x)*a[k])",
            "series(n, a[n]) + series(n, b[n]) = series(n, a[n] + b[n])",
            "c*series(n, a[n])/2 = series(n, c*a_n/2)",
            "re(series(n, a[n]*exp(i*n*x))) = series(n, a[n]*cos(n*x))",
            "D(series(n, sin(n*x)/n), x) = series(n, cos(n*x))",
            "at(series(n, cos(n*x)), x, 2*pi) = series(n, 1)",
            "int(t, 0, 2*pi, x + series(n, a[n]*cos(n*t))) = 2*pi*x",
            "series(n, W(0)*n) = series(n, n)",
        ] {
            assert_eq!(outcome(&[], text), Outcome::Proved, "{text}");
        }
        let lines = ["a_n = D_n*cos(delta_n)", "f = c_0 + series(n, a[n])"];
        let text = "f = c_0 + series(k, D[k]*cos(delta[k]))";
        assert_eq!(outcome(&lines, text), Outcome::Proved, "{text}");
        for text in [
            "series(n, n) = series(n, n^2)",
            "1 + series(n, a[n]) = 2 + series(n, a[n])",
            "series(n, sin(n*pi/2)) = series(n, 0)",
        ] {
            assert_eq!(outcome(&[], text), Outcome::Refuted, "{text}");
        }
    }

    /// Neither a product nor a function of a sum is the sum of products or functions, and what
    /// depends on an index is not what does not.
    #[test]
    fn series_are_linear() {
        let lines = ["s = series(n, x)", "y: z = series(n, x)"];
        for text in [
            "series(n, a[n])*series(n, b[n]) = series(n, a[n]*b[n])",
            "series(n, a[n])*series(n, b[n]) = series(n, 1)*series(n, a[n]*b[n])",
            "series(n, x) + 1 = series(n, x + 1)",
            "exp(series(n, x)) = series(n, exp(x))",
            "s^2 = series(n, x^2)",
            "1/s = series(n, 1/x)",
            "n*series(n, x) = series(n, n*x)",
            "a_n*series(n, 1) = series(n, a[n])",
            "at(t^2, t, s) = series(n, x^2)",
            "sqrt(s) = series(n, sqrt(x))",
            "D(z^2, y) = 2*z*s",
            "series(n, series(m, x)) = series(n, x)",
            // Zero for every n but 2.
            "int(t, 0, 2*pi, series(k, cos(k*t)*cos(2*t))) = 0",
            "series(n, (n - 2)/(n - 2)) = series(n, 1)",
            "series(n, cos(pi*n)) = series(n, 1)",
        ] {
            assert_ne!(outcome(&lines, text), Outcome::Proved, "{text}");
        }
    }
}
