//! Proof or refutation of an equation.

use super::enclosure::{Point, enclose, enclose_form, has_derivative};
use super::exact::Exact;
use super::expr::{Equation, Expr};
use super::walk::Definitions;
use super::{Algebra, ExpSum, SymbolicError};
use mechaudit_reference::ComplexBall;
use serde::Serialize;
use std::collections::BTreeSet;

/// What is known of an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The normal form of the difference is zero.
    Proved,
    /// At a rational point an enclosure of the difference excludes zero.
    Refuted,
    /// Outside the algebra, and enclosures at points contain zero.
    Undecided,
}

/// A point at which an equation fails.
#[derive(Clone, Debug, Serialize)]
pub struct Witness {
    /// Values of the symbols.
    pub point: Vec<(String, String)>,
    /// Left side minus right side there: exact if it is rational, else decimal digits that hold.
    pub residual: String,
}

/// An equation with what was found.
#[derive(Clone, Debug)]
pub struct Identity {
    /// Proved or refuted.
    pub outcome: Outcome,
    /// The normal form of left minus right, if it is in the algebra.
    pub residual: Option<String>,
    /// Where it fails.
    pub witness: Option<Witness>,
    /// Why there is no normal form.
    pub error: Option<SymbolicError>,
}

/// Points tried before an equation is left undecided.
const POINTS: u32 = 4;

impl Identity {
    /// Decides an equation at points of the program's choice.
    pub fn of(definitions: &Definitions, equation: &Equation) -> Identity {
        Identity::at(definitions, equation, &Point::default())
    }

    /// Decides an equation; the point's named values are kept.
    pub fn at(definitions: &Definitions, equation: &Equation, point: &Point) -> Identity {
        let difference = difference(equation);
        let mut exact = Exact::default();
        let form = exact.value(definitions, &difference);
        let residual = form.as_ref().ok().map(|f| exact.algebra.text(f));
        if form.as_ref().is_ok_and(ExpSum::is_zero) {
            return Identity {
                outcome: Outcome::Proved,
                residual,
                witness: None,
                error: None,
            };
        }
        for turn in 0..POINTS {
            let point = Point {
                turn,
                ..point.clone()
            };
            let Ok(value) = enclose_either(definitions, &difference, &form, &exact.algebra, &point)
            else {
                continue;
            };
            if excludes_zero(&value) {
                let witness = Witness {
                    point: coordinates(definitions, &difference, &point),
                    residual: exactly(&form, &exact.algebra, &point)
                        .unwrap_or_else(|| digits(&value)),
                };
                return Identity {
                    outcome: Outcome::Refuted,
                    residual,
                    witness: Some(witness),
                    error: form.err(),
                };
            }
        }
        Identity {
            outcome: Outcome::Undecided,
            residual,
            witness: None,
            error: form.err(),
        }
    }
}

fn difference(equation: &Equation) -> Expr {
    Expr::Add(vec![
        equation.left.clone(),
        Expr::Neg(Box::new(equation.right.clone())),
    ])
}

fn excludes_zero(z: &ComplexBall) -> bool {
    !z.re.contains_zero() || !z.im.contains_zero()
}

fn enclose_either(
    definitions: &Definitions,
    difference: &Expr,
    form: &Result<ExpSum, SymbolicError>,
    algebra: &Algebra,
    point: &Point,
) -> Result<ComplexBall, SymbolicError> {
    match form {
        Ok(form) if has_derivative(definitions, difference) => enclose_form(algebra, form, point),
        _ => enclose(definitions, difference, point),
    }
}

/// The exact value at the point, if nothing but rational numbers enters.
fn exactly(
    form: &Result<ExpSum, SymbolicError>,
    algebra: &Algebra,
    point: &Point,
) -> Option<String> {
    use super::{Gauss, Poly};
    let f = form.as_ref().ok()?.as_fraction()?;
    let special = |p: &Poly| {
        p.symbols().iter().any(|x| {
            x.name() == "pi"
                || algebra.roots().iter().any(|(s, _)| s == x)
                || algebra.antiderivatives().iter().any(|(g, _)| g == x)
        })
    };
    if special(f.num()) || special(f.den()) {
        return None;
    }
    let value = |p: &Poly| {
        p.terms().fold(Gauss::default(), |sum, (m, c)| {
            let product = m.iter().fold(c.clone(), |product, (x, k)| {
                let x = Gauss::real(point.value(&x.name()));
                (0..*k).fold(product, |q, _| &q * &x)
            });
            &sum + &product
        })
    };
    Some((&value(f.num()) * &value(f.den()).inverse()?).to_string())
}

/// Eight digits that hold.
fn digits(z: &ComplexBall) -> String {
    let part = |b: &mechaudit_reference::Ball| match b.contains_zero() {
        true => "0".to_string(),
        false => b
            .to_decimal(8)
            .unwrap_or_else(|| format!("{:.3e}", b.to_f64())),
    };
    match (part(&z.re), part(&z.im)) {
        (re, im) if im == "0" => re,
        (re, im) if re == "0" => format!("{im}*i"),
        (re, im) if im.starts_with('-') => format!("{re}{im}*i"),
        (re, im) => format!("{re}+{im}*i"),
    }
}

/// The values of the free symbols, definitions followed.
fn coordinates(definitions: &Definitions, e: &Expr, point: &Point) -> Vec<(String, String)> {
    fn collect(d: &Definitions, e: &Expr, names: &mut BTreeSet<String>, seen: &mut Vec<String>) {
        if let Expr::Sym(name) = e {
            match d.names.get(name) {
                Some(body) if !seen.contains(name) => {
                    seen.push(name.clone());
                    collect(d, body, names, seen);
                }
                Some(_) => {}
                None => {
                    names.insert(name.clone());
                }
            }
        }
        let mut inner = BTreeSet::new();
        for c in e.children() {
            collect(d, c, &mut inner, seen);
        }
        match e {
            Expr::Int(b) | Expr::Sum(b) => {
                inner.remove(&b.var);
                inner.remove("inf");
                inner.remove("each");
                inner.remove("n_num");
            }
            Expr::At(_, s, _) => {
                inner.remove(s);
            }
            _ => {}
        }
        names.extend(inner);
    }
    let mut names = BTreeSet::new();
    collect(definitions, e, &mut names, &mut Vec::new());
    names.remove("pi");
    names
        .into_iter()
        .map(|n| (n.clone(), point.value(&n).to_string()))
        .collect()
}
