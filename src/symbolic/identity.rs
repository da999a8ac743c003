//! Proof or refutation of an equation.

use super::enclosure::{Point, enclose, enclose_form, has_derivative};
use super::exact::Exact;
use super::expr::{EACH, Equation, Expr};
use super::series;
use super::walk::Definitions;
use super::work::{LIMIT, limited};
use super::{Algebra, ExpSum, Symbol, SymbolicError};
use mechaudit_reference::ComplexBall;
use rug::Rational;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The verdict on an equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The normal form of the difference is zero: the sides are equal for all positive values of
    /// the free symbols at which both are defined.
    Proved,
    /// At a rational point an enclosure of the difference excludes zero.
    Refuted,
    /// Outside the algebra or past the limit on work, and enclosures at points contain zero.
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
const POINTS: u32 = 6;

impl Identity {
    /// Decides an equation for all positive values of its free symbols; refutes it at sample
    /// points.
    pub fn of(definitions: &Definitions, equation: &Equation) -> Identity {
        Identity::near(definitions, equation, &BTreeMap::new())
    }

    /// As [`Identity::of`], with values of some symbols at which it is to be refuted.
    pub fn near(
        definitions: &Definitions,
        equation: &Equation,
        named: &BTreeMap<String, Rational>,
    ) -> Identity {
        let difference = difference(equation);
        let mut exact = Exact::default();
        let form = exact.value(definitions, &difference);
        let residual = form.as_ref().ok().map(|f| exact.algebra.text(f));
        let vanishes = |form: &ExpSum| {
            let cleared = limited(LIMIT, || exact.algebra.cleared(form));
            form.is_zero() || cleared.is_ok_and(|form| form.is_zero())
        };
        let proved = form.as_ref().is_ok_and(vanishes);
        // A formal series may have the value of what stands beside it, though not term by term.
        let undecidable = form.as_ref().map_or_else(
            |_| series::is_formal(definitions, &difference),
            mixes_series,
        );
        let points = if proved || undecidable { 0 } else { POINTS };
        let through_form = has_derivative(definitions, &difference);
        let witness = (0..points).find_map(|turn| {
            let point = Point {
                named: named.clone(),
                sample: Some(turn),
            };
            // Of derivatives and of integrals to infinity there are no enclosures but of the form.
            let straight = match through_form {
                true => Err(SymbolicError::Unsupported(String::new())),
                false => enclose(definitions, &difference, &point),
            };
            let value = match (straight, &form) {
                (Err(SymbolicError::Unsupported(_)), Ok(form)) => {
                    enclose_form(&exact.algebra, form, &point)
                }
                (straight, _) => straight,
            };
            let value = value.ok().filter(excludes_zero)?;
            let exactly = exactly(&form, &exact.algebra, &point);
            Some(Witness {
                point: point.values_of(definitions, &difference),
                residual: exactly.unwrap_or_else(|| digits(&value)),
            })
        });
        let outcome = match &witness {
            _ if proved => Outcome::Proved,
            Some(_) => Outcome::Refuted,
            None => Outcome::Undecided,
        };
        Identity {
            outcome,
            residual,
            witness,
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

/// Returns true if a form has terms of a formal series and others.
fn mixes_series(form: &ExpSum) -> bool {
    let mut parts = [false; 2];
    for (_, c) in form.terms() {
        for (k, part) in c.num().coefficients(Symbol::SERIES).iter().enumerate() {
            if let Some(seen) = parts.get_mut(k) {
                *seen |= !part.is_zero();
            }
        }
    }
    parts == [true, true]
}

fn excludes_zero(z: &ComplexBall) -> bool {
    !z.re.contains_zero() || !z.im.contains_zero()
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
        p.terms().try_fold(Gauss::default(), |sum, (m, c)| {
            let product = m.iter().try_fold(c.clone(), |product, (x, k)| {
                let x = Gauss::real(point.value(&x.name()).ok()?);
                Some((0..*k).fold(product, |q, _| &q * &x))
            })?;
            Some(&sum + &product)
        })
    };
    Some((&value(f.num())? * &value(f.den())?.inverse()?).to_string())
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

impl Point {
    /// The values of the free symbols of an expression, definitions followed.
    pub fn values_of(&self, definitions: &Definitions, e: &Expr) -> Vec<(String, String)> {
        free_symbols(definitions, e)
            .into_iter()
            .filter_map(|n| Some((n.clone(), self.value(&n).ok()?.to_string())))
            .collect()
    }
}

/// The names of the free symbols, definitions followed.
fn free_symbols(definitions: &Definitions, e: &Expr) -> BTreeSet<String> {
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
        // A name that is bound in here may be free in the same definition elsewhere.
        let mut within = seen.clone();
        let binds = matches!(e, Expr::Int(_) | Expr::Sum(_) | Expr::At(..));
        let seen = if binds { &mut within } else { seen };
        for c in e.children() {
            collect(d, c, &mut inner, seen);
        }
        match e {
            Expr::Int(b) | Expr::Sum(b) => {
                for bound in [b.var.as_str(), "inf", EACH] {
                    inner.remove(bound);
                }
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse_equation;

    /// At x = 2, y = 3.
    fn found(lines: &[&str], text: &str) -> Identity {
        let definitions = Definitions::read(lines).unwrap();
        let named = [("x".into(), 2.into()), ("y".into(), 3.into())].into();
        Identity::near(&definitions, &parse_equation(text).unwrap(), &named)
    }

    fn residual(text: &str) -> String {
        let found = found(&[], text);
        assert_eq!(found.outcome, Outcome::Refuted, "{text}: {found:?}");
        found.witness.unwrap().residual
    }

    #[test]
    fn residuals_of_rational_numbers_are_exact() {
        for (text, due) in [
            ("x^3 = 0", "8"),
            ("x/y + i*x^2 = 0", "(2/3+4*i)"),
            ("(x + y^2)/(x^2*y - 5) = 1", "4/7"),
            ("x*y - y = 1", "2"),
        ] {
            assert_eq!(residual(text), due, "{text}");
        }
    }

    /// Of what is no rational function of the point: eight digits.
    #[test]
    fn other_residuals_are_digits() {
        for (text, due) in [
            ("pi = 0", "3.1415927"),
            ("x*pi + y = 0", "9.2831853"),
            ("1/(x*pi) = 0", "0.15915494"),
            ("1/(y - pi) = 0", "-7.0625133"),
            ("sqrt(x) = 0", "1.4142136"),
            ("x + sqrt(x) + sqrt(y) = 0", "5.1462644"),
            ("1/(1 + sqrt(x)) = 0", "0.41421356"),
            ("i*exp(x) = 0", "7.3890561*i"),
            ("pi - i*pi/2 = 0", "3.1415927-1.5707963*i"),
            ("pi + i*pi/2 = 0", "3.1415927+1.5707963*i"),
            ("W(i*x) + W(i*y) = 0", "0.43439683"),
            ("int(s, 0, x, exp(-s^2)) = 0", "0.88208139"),
        ] {
            let found = residual(text);
            // Trailing zeros and powers of ten are the decimals' own affair.
            let value = |s: &str| s.parse::<f64>().ok();
            match (value(&found), value(due)) {
                (Some(a), Some(b)) => assert!((a / b - 1.0).abs() < 1e-7, "{text}: {found}"),
                _ => assert_eq!(found, due, "{text}"),
            }
        }
    }

    /// The first point is that of turn 0, and the witness names the free symbols, definitions
    /// followed, and no others.
    #[test]
    fn witnesses_name_the_free_symbols() {
        let lines = ["c = a*b", "d = c + c"];
        let names = |text: &str| {
            let found = found(&lines, text);
            assert_eq!(found.outcome, Outcome::Refuted, "{text}: {found:?}");
            let point = found.witness.unwrap().point;
            for (name, value) in &point {
                let due = match name.as_str() {
                    "x" => 2.into(),
                    "y" => 3.into(),
                    name => Point::sample(0).value(name).unwrap(),
                };
                assert_eq!(*value, due.to_string(), "{text}");
            }
            point.into_iter().map(|p| p.0).collect::<Vec<_>>().join(" ")
        };
        for (text, due) in [
            ("u + pi = x", "u x"),
            ("d = x", "a b x"),
            ("c + d = c*a", "a b"),
            ("int(s, p, q, s*x) = 0", "p q x"),
            ("sum(k, 1, 4, k*x) = 0", "x"),
            ("series(k, k*x) = 0", "x"),
            ("at(t^2 + v, t, x) = 0", "v x"),
            ("s + int(s, 0, 1, s) = 7", "s"),
        ] {
            assert_eq!(names(text), due, "{text}");
        }
    }

    /// Each definition is looked through once, those of a circle too.
    #[test]
    fn coordinates_of_circles() {
        let circle = Definitions::read(&["a = b + x", "b = 2*a"]).unwrap();
        let e = parse_equation("a = y").unwrap();
        let found = Point::sample(0).values_of(&circle, &difference(&e));
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["x", "y"]);
    }

    /// Straight from the data where there is no derivative: the normal form has lost the division
    /// by zero.
    #[test]
    fn points_are_tried_without_the_algebra() {
        let text = "(x^2 - 4)/(x - 2) = 0";
        assert_eq!(found(&[], text).outcome, Outcome::Undecided);
        let derived = found(&[], "(D(x^2, x) - 4)/(x - 1) = 5");
        assert_eq!(derived.outcome, Outcome::Refuted);
    }
}
