//! Formulas as data.

use std::fmt;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Func {
    /// `e^x`.
    Exp,
    /// Square root; of positive numbers.
    Sqrt,
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// `W(z) = e^{−z²}(1 + (2i/√π) ∫_0^z e^{s²} ds)`.
    W,
    /// Real part.
    Re,
    /// Imaginary part.
    Im,
    /// Absolute value.
    Abs,
    /// Argument in (−π, π].
    Arg,
    /// Principal arc tangent of a real number.
    Arctan,
}

impl Func {
    /// All of them with their names in the text form.
    pub const ALL: [(Func, &'static str); 10] = [
        (Func::Exp, "exp"),
        (Func::Sqrt, "sqrt"),
        (Func::Sin, "sin"),
        (Func::Cos, "cos"),
        (Func::W, "W"),
        (Func::Re, "re"),
        (Func::Im, "im"),
        (Func::Abs, "abs"),
        (Func::Arg, "arg"),
        (Func::Arctan, "arctan"),
    ];

    /// The name in the text form.
    pub fn name(self) -> &'static str {
        Func::ALL.iter().find(|f| f.0 == self).map_or("", |f| f.1)
    }
}

/// An integral or a sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The variable or index.
    pub var: String,
    /// Lower limit.
    pub from: Expr,
    /// Upper limit, which may be `inf`.
    pub to: Expr,
    /// What is integrated or added.
    pub body: Expr,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A decimal number without sign, as written.
    Num(String),
    /// The imaginary unit.
    I,
    /// A symbol or the name of a definition.
    Sym(String),
    /// A symbol with an index that is computed.
    Index(String, Box<Expr>),
    /// `−x`.
    Neg(Box<Expr>),
    /// A sum.
    Add(Vec<Expr>),
    /// A product.
    Mul(Vec<Expr>),
    /// A quotient.
    Div(Box<Expr>, Box<Expr>),
    /// An integer power.
    Pow(Box<Expr>, i32),
    /// A function.
    Call(Func, Box<Expr>),
    /// An integral.
    Int(Box<Bound>),
    /// A sum over an index. `series(n, f)`, which has the upper limit `each`, is the formal sum of
    /// the terms f over all n of an unspecified range of positive integers: two of them are equal
    /// if their terms are.
    Sum(Box<Bound>),
    /// A derivative: by a derivation of that name, or partial.
    Diff(Box<Expr>, String),
    /// The expression at a value of a symbol.
    At(Box<Expr>, String, Box<Expr>),
}

/// Names of constants, which cannot be defined, bound or varied.
pub(super) const RESERVED: [&str; 3] = ["i", "pi", "inf"];

/// The upper limit that makes a sum a series of like terms.
pub(super) const EACH: &str = "each";

impl Expr {
    /// A sum or a product, or its only part.
    pub(super) fn joined(mut parts: Vec<Expr>, of: fn(Vec<Expr>) -> Expr) -> Expr {
        match parts.len() {
            1 => parts.remove(0),
            _ => of(parts),
        }
    }

    /// The children, in order.
    pub fn children(&self) -> Vec<&Expr> {
        match self {
            Expr::Num(_) | Expr::I | Expr::Sym(_) => Vec::new(),
            Expr::Index(_, x) | Expr::Neg(x) | Expr::Pow(x, _) => vec![x],
            Expr::Call(_, x) | Expr::Diff(x, _) => vec![x],
            Expr::Add(x) | Expr::Mul(x) => x.iter().collect(),
            Expr::Div(a, b) | Expr::At(a, _, b) => vec![a, b],
            Expr::Int(b) | Expr::Sum(b) => vec![&b.from, &b.to, &b.body],
        }
    }

    /// The same node with other children; as many as [`Expr::children`] gives.
    pub fn with_children(&self, mut new: Vec<Expr>) -> Expr {
        let mut next = || new.remove(0);
        match self {
            Expr::Num(_) | Expr::I | Expr::Sym(_) => self.clone(),
            Expr::Index(n, _) => Expr::Index(n.clone(), Box::new(next())),
            Expr::Neg(_) => Expr::Neg(Box::new(next())),
            Expr::Pow(_, k) => Expr::Pow(Box::new(next()), *k),
            Expr::Call(f, _) => Expr::Call(*f, Box::new(next())),
            Expr::Diff(_, by) => Expr::Diff(Box::new(next()), by.clone()),
            Expr::Add(_) => Expr::Add(new),
            Expr::Mul(_) => Expr::Mul(new),
            Expr::Div(..) => Expr::Div(Box::new(next()), Box::new(next())),
            Expr::At(_, s, _) => Expr::At(Box::new(next()), s.clone(), Box::new(next())),
            Expr::Int(b) | Expr::Sum(b) => {
                let bound = Box::new(Bound {
                    var: b.var.clone(),
                    from: next(),
                    to: next(),
                    body: next(),
                });
                match self {
                    Expr::Int(_) => Expr::Int(bound),
                    _ => Expr::Sum(bound),
                }
            }
        }
    }

    /// Binding strength: sum, product, sign, power, atom.
    pub(super) fn strength(&self) -> u8 {
        match self {
            Expr::Add(_) => 0,
            Expr::Neg(_) => 1,
            Expr::Mul(_) | Expr::Div(..) => 2,
            Expr::Pow(..) => 3,
            _ => 4,
        }
    }
}

/// The text form, which [`parse`](super::parse) reads back.
impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let at_least = |x: &Expr, strength: u8| match x.strength() >= strength {
            true => x.to_string(),
            false => format!("({x})"),
        };
        match self {
            Expr::Num(n) => f.write_str(n),
            Expr::I => f.write_str("i"),
            Expr::Sym(s) => f.write_str(s),
            Expr::Index(s, k) => write!(f, "{s}[{k}]"),
            Expr::Neg(x) => write!(f, "-{}", at_least(x, 2)),
            Expr::Add(terms) => {
                for (k, x) in terms.iter().enumerate() {
                    match (k, x) {
                        (0, x) => write!(f, "{}", at_least(x, 1))?,
                        (_, Expr::Neg(y)) => write!(f, " - {}", at_least(y, 2))?,
                        (_, x) => write!(f, " + {}", at_least(x, 1))?,
                    }
                }
                Ok(())
            }
            Expr::Mul(factors) => {
                for (k, x) in factors.iter().enumerate() {
                    let star = if k > 0 { "*" } else { "" };
                    // A later quotient would be read as (a*b)/c.
                    let text = match x {
                        Expr::Div(..) if k > 0 => format!("({x})"),
                        Expr::Mul(_) => format!("({x})"),
                        x => at_least(x, 2),
                    };
                    write!(f, "{star}{text}")?;
                }
                Ok(())
            }
            Expr::Div(a, b) => write!(f, "{}/{}", at_least(a, 2), at_least(b, 3)),
            Expr::Pow(x, k) if *k < 0 => write!(f, "{}^({k})", at_least(x, 4)),
            Expr::Pow(x, k) => write!(f, "{}^{k}", at_least(x, 4)),
            Expr::Call(func, x) => write!(f, "{}({x})", func.name()),
            Expr::Sum(b) if b.to == Expr::Sym(EACH.into()) => {
                write!(f, "series({}, {})", b.var, b.body)
            }
            Expr::Int(b) => write!(f, "int({}, {}, {}, {})", b.var, b.from, b.to, b.body),
            Expr::Sum(b) => write!(f, "sum({}, {}, {}, {})", b.var, b.from, b.to, b.body),
            Expr::Diff(x, by) => write!(f, "D({x}, {by})"),
            Expr::At(x, s, v) => write!(f, "at({x}, {s}, {v})"),
        }
    }
}

/// `left = right`.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} = {}", self.left, self.right)
    }
}

#[cfg(test)]
#[path = "expr_tests.rs"]
mod tests;
