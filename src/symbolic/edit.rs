//! Single slips of a compositor's hand, undone: the family in which a minimal repair is looked for.

use super::expr::{Equation, Expr, Func};
use serde::Serialize;
use std::collections::BTreeSet;

/// The symbols and factors that may have been confused or left out in one formula.
#[derive(Clone, Debug, Default)]
pub struct Family {
    /// Groups of symbols that may stand for one another.
    pub confused: Vec<Vec<String>>,
    /// Symbols that may be missing as a factor, to the power ±1 or ±2, or instead of a zero.
    pub missing: Vec<String>,
}

impl Family {
    /// From texts: groups with blanks between the names.
    pub fn new(confused: &[&str], missing: &str) -> Family {
        let words = |t: &str| t.split_whitespace().map(String::from).collect();
        Family {
            confused: confused.iter().map(|g| words(g)).collect(),
            missing: words(missing),
        }
    }
}

/// One edit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Edit {
    /// The kind of slip that it undoes.
    pub kind: &'static str,
    /// The part as it was.
    pub before: String,
    /// The part as it becomes.
    pub after: String,
}

type Edited = Vec<(Edit, Expr)>;

fn push(out: &mut Edited, kind: &'static str, before: &Expr, after: Expr) {
    let edit = Edit {
        kind,
        before: before.to_string(),
        after: after.to_string(),
    };
    if edit.before != edit.after {
        out.push((edit, after));
    }
}

fn negated(e: &Expr) -> Expr {
    match e {
        Expr::Neg(x) => (**x).clone(),
        x => Expr::Neg(Box::new(x.clone())),
    }
}

/// A factor put in front, behind the sign.
fn with_factor(e: &Expr, factor: Expr) -> Expr {
    match e {
        Expr::Neg(x) => Expr::Neg(Box::new(with_factor(x, factor))),
        Expr::Mul(f) => Expr::Mul(std::iter::once(factor).chain(f.iter().cloned()).collect()),
        x => Expr::Mul(vec![factor, x.clone()]),
    }
}

/// Edits of a term: of a sum, an exponent, an integrand or a whole side.
fn term_edits(e: &Expr, family: &Family, out: &mut Edited) {
    push(out, "sign", e, negated(e));
    push(out, "missing i", e, with_factor(e, Expr::I));
    for name in &family.missing {
        for k in [1, 2, -1, -2] {
            let symbol = Expr::Sym(name.clone());
            let factor = match k {
                1 => symbol,
                k => Expr::Pow(Box::new(symbol), k),
            };
            push(out, "missing factor", e, with_factor(e, factor));
        }
    }
}

fn node_edits(e: &Expr, family: &Family, out: &mut Edited) {
    match e {
        Expr::Sym(name) => {
            let groups = family.confused.iter().filter(|g| g.contains(name));
            for other in groups.flatten().filter(|o| *o != name) {
                push(out, "symbol or index", e, Expr::Sym(other.clone()));
            }
            let square = Expr::Pow(Box::new(e.clone()), 2);
            push(out, "missing exponent", e, square);
        }
        Expr::Num(n) if n == "0" => {
            for name in &family.missing {
                push(out, "zero for a symbol", e, Expr::Sym(name.clone()));
            }
        }
        Expr::Num(n) => {
            for (at, old) in n.char_indices().filter(|c| c.1.is_ascii_digit()) {
                for digit in ('0'..='9').filter(|d| *d != old) {
                    let mut other = n.clone();
                    other.replace_range(at..=at, &digit.to_string());
                    push(out, "digit", e, Expr::Num(other));
                }
            }
            if let Ok(k) = n.parse::<i64>() {
                let times = [2, 3, 4].into_iter().filter_map(|f| k.checked_mul(f));
                let parts = [2, 3, 4].into_iter().filter(|d| k % d == 0).map(|d| k / d);
                for other in times.chain(parts) {
                    push(out, "constant", e, Expr::Num(other.to_string()));
                }
            }
        }
        Expr::Pow(x, k) => {
            for other in [1, 2, 3].into_iter().filter(|o| o != k) {
                let power = match other {
                    1 => (**x).clone(),
                    other => Expr::Pow(x.clone(), other),
                };
                push(out, "exponent", e, power);
            }
        }
        Expr::Mul(parts) | Expr::Add(parts) => {
            let (kind, of): (_, fn(_) -> _) = match e {
                Expr::Mul(_) => ("superfluous factor", Expr::Mul),
                _ => ("superfluous term", Expr::Add),
            };
            for k in 0..parts.len() {
                let mut rest = parts.clone();
                rest.remove(k);
                push(out, kind, e, Expr::joined(rest, of));
            }
        }
        Expr::Div(a, b) => {
            push(out, "superfluous divisor", e, (**a).clone());
            // A bare constant below makes no sense above.
            if !matches!(**b, Expr::Num(_)) {
                push(out, "inverted quotient", e, Expr::Div(b.clone(), a.clone()));
            }
        }
        Expr::Call(Func::Arctan, x) => {
            if let [Expr::Div(a, b)] = x.as_slice()
                && let (Expr::Call(Func::Im, y), Expr::Call(Func::Re, z)) = (&**a, &**b)
                && y == z
            {
                let arg = Expr::Call(Func::Arg, y.clone());
                push(out, "quadrant", e, arg);
            }
        }
        _ => {}
    }
}

fn all(e: &Expr, is_term: bool, family: &Family, out: &mut Edited) {
    if is_term {
        term_edits(e, family, out);
    } else if let Expr::Neg(x) = e {
        push(out, "sign", e, (**x).clone());
    }
    node_edits(e, family, out);
    let children: Vec<Expr> = e.children().into_iter().cloned().collect();
    for (k, child) in children.iter().enumerate() {
        let term = match e {
            Expr::Add(_) | Expr::Call(Func::Exp, _) => true,
            Expr::Int(_) | Expr::Sum(_) => k == 2,
            _ => false,
        };
        // Which terms a series has is not in question, nor the index that numbers them.
        if matches!(e, Expr::Index(..)) || (matches!(e, Expr::Sum(_)) && k < 2) {
            continue;
        }
        let mut inner = Edited::new();
        all(child, term, family, &mut inner);
        for (edit, new) in inner {
            // A power of a power is not a slip.
            if matches!(e, Expr::Pow(..)) && edit.kind == "missing exponent" {
                continue;
            }
            let mut changed = children.clone();
            changed[k] = new;
            out.push((edit, e.with_children(changed)));
        }
    }
}

/// Every equation that one edit of the family makes of this one; equal texts only once. A left side
/// that is a mere name is left alone.
pub fn edits(equation: &Equation, family: &Family) -> Vec<(Edit, Equation)> {
    let mut out = Vec::new();
    let mut seen = BTreeSet::from([equation.to_string()]);
    let mut add = |edit: Edit, new: Equation| {
        if seen.insert(new.to_string()) {
            out.push((edit, new));
        }
    };
    let mut right = Edited::new();
    all(&equation.right, true, family, &mut right);
    for (edit, right) in right {
        let left = equation.left.clone();
        add(edit, Equation { left, right });
    }
    if !matches!(equation.left, Expr::Sym(_) | Expr::Index(..)) {
        let mut left = Edited::new();
        all(&equation.left, true, family, &mut left);
        for (edit, left) in left {
            let right = equation.right.clone();
            add(edit, Equation { left, right });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::parse_equation;
    use super::*;

    fn found(text: &str, family: &Family) -> Vec<String> {
        let e = parse_equation(text).unwrap();
        edits(&e, family).iter().map(|x| x.1.to_string()).collect()
    }

    #[test]
    fn every_slip_is_undone() {
        let family = Family::new(&["U V", "m_i m_j"], "x");
        for (printed, meant) in [
            ("y = a - i*n", "y = a + i*n"),
            ("y = exp(-z)", "y = exp(-i*z)"),
            ("y = exp(U^5)", "y = exp(U^2)"),
            ("y = U*W(V)", "y = V*W(V)"),
            ("y = -(a - b)*t", "y = (a - b)*t"),
            ("y = 4*a", "y = 2*a"),
            ("y = 4*a", "y = a"),
            ("y = 0", "y = x"),
            ("y = a + b", "y = a + x^(-2)*b"),
            ("y = a/b", "y = b/a"),
            ("y = arctan(im(A)/re(A))", "y = arg(A)"),
            ("y = int(s, U, V, exp(-s^2))", "y = int(s, U, V, exp(s^2))"),
            ("a*m_i = b*m_i", "a*m_j = b*m_i"),
        ] {
            assert!(
                found(printed, &family).contains(&meant.to_string()),
                "{printed}"
            );
        }
    }

    #[test]
    fn nothing_twice_and_never_the_print_itself() {
        let all = found("y = a*b*(c - 2*d)", &Family::new(&["a b c d"], "q"));
        let distinct: BTreeSet<_> = all.iter().collect();
        assert_eq!(distinct.len(), all.len());
        assert!(!all.contains(&"y = a*b*(c - 2*d)".to_string()) && all.len() > 30);
        assert!(all.iter().all(|t| t.starts_with("y = ")));
    }

    #[test]
    fn limits_of_integrals_are_edited_too() {
        let all = found("y = int(s, a, b, s)", &Family::new(&["a b"], ""));
        assert!(all.contains(&"y = int(s, b, b, s)".to_string()));
    }
}

#[cfg(test)]
mod kinds;
