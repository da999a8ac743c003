//! Formulas as data.

pub use super::function::Func;
use std::cmp::Ordering;
use std::fmt;

/// A comparison of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// `<`.
    Less,
    /// `<=`.
    LessEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterEqual,
    /// `==`.
    Equal,
    /// `!=`.
    NotEqual,
}

impl Relation {
    /// All of them with their signs; a longer sign stands before its beginning.
    pub const ALL: [(Relation, &'static str); 6] = [
        (Relation::LessEqual, "<="),
        (Relation::GreaterEqual, ">="),
        (Relation::Equal, "=="),
        (Relation::NotEqual, "!="),
        (Relation::Less, "<"),
        (Relation::Greater, ">"),
    ];

    /// The sign in the text form.
    pub fn sign(self) -> &'static str {
        Relation::ALL
            .iter()
            .find(|r| r.0 == self)
            .map_or("", |r| r.1)
    }

    /// Returns true if it holds between two numbers in this order.
    pub fn holds(self, order: Ordering) -> bool {
        match self {
            Relation::Less => order == Ordering::Less,
            Relation::LessEqual => order != Ordering::Greater,
            Relation::Greater => order == Ordering::Greater,
            Relation::GreaterEqual => order != Ordering::Less,
            Relation::Equal => order == Ordering::Equal,
            Relation::NotEqual => order != Ordering::Equal,
        }
    }
}

/// Declares the constants once: variant, name in C and FPCore, and the expression that it stands
/// for.
macro_rules! constants {
    ($($constant:ident $name:literal $value:literal;)*) => {
        /// A named constant of C and FPCore; in floating point it is rounded once.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs)]
        pub enum Constant {
            $($constant,)*
        }

        impl Constant {
            /// All of them with their names.
            pub const ALL: &'static [(Constant, &'static str)] = &[$((Constant::$constant, $name)),*];

            /// The name in FPCore.
            pub fn name(self) -> &'static str {
                match self {
                    $(Constant::$constant => $name,)*
                }
            }

            /// The expression that it stands for, as text.
            pub fn definition(self) -> &'static str {
                match self {
                    $(Constant::$constant => $value,)*
                }
            }
        }
    };
}

constants! {
    E "E" "exp(1)";
    Log2E "LOG2E" "1/log(2)";
    Log10E "LOG10E" "1/log(10)";
    Ln2 "LN2" "log(2)";
    Ln10 "LN10" "log(10)";
    Pi "PI" "pi";
    HalfPi "PI_2" "pi/2";
    QuarterPi "PI_4" "pi/4";
    InversePi "M_1_PI" "1/pi";
    TwoOverPi "M_2_PI" "2/pi";
    TwoOverRootPi "M_2_SQRTPI" "2/sqrt(pi)";
    Sqrt2 "SQRT2" "sqrt(2)";
    InverseSqrt2 "SQRT1_2" "1/sqrt(2)";
}

/// A loop: `while condition`, each variable is replaced by its update; the value is that of the
/// body for the last values.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Returns true if an update sees the new values of the variables before it.
    pub sequential: bool,
    /// The condition.
    pub condition: Expr,
    /// Variables with their first values and updates.
    pub variables: Vec<(String, Expr, Expr)>,
    /// The value.
    pub body: Expr,
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
    /// The integrand or summand.
    pub body: Expr,
}

/// The roots of an equation between two limits, all of which are found and proved to be simple.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roots {
    /// The only root: `root(x, a, b, f)`.
    Only,
    /// The root at a place, counted from 1, of exactly `count`: `root(x, a, b, f, place, count)`.
    One {
        /// The place in ascending order.
        place: u32,
        /// The number of roots.
        count: u32,
    },
    /// The number of roots: `roots(x, a, b, f)`.
    Number,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A number without sign, as written: decimal, hexadecimal, or a quotient of integers.
    Num(String),
    /// A constant of C and FPCore.
    Constant(Constant),
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
    /// A function, with as many arguments as it has.
    Call(Func, Vec<Expr>),
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
    /// A root of the body between the limits, or the number of roots.
    Root(Box<Bound>, Roots),
    /// Comparisons of neighbours: `a < b <= c`.
    Compare(Relation, Vec<Expr>),
    /// True if all are.
    And(Vec<Expr>),
    /// True if one is.
    Or(Vec<Expr>),
    /// True if it is not.
    Not(Box<Expr>),
    /// True or false.
    Truth(bool),
    /// The second where the first is true, else the third.
    If(Box<[Expr; 3]>),
    /// Names for values, each of which sees those before it if `true`; then the value.
    Let(bool, Vec<(String, Expr)>, Box<Expr>),
    /// A loop.
    While(Box<Loop>),
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

    /// A function of one argument.
    pub fn call(f: Func, x: Expr) -> Expr {
        Expr::Call(f, vec![x])
    }

    /// The children, in order.
    pub fn children(&self) -> Vec<&Expr> {
        match self {
            Expr::Num(_) | Expr::Constant(_) | Expr::I | Expr::Sym(_) | Expr::Truth(_) => {
                Vec::new()
            }
            Expr::Index(_, x) | Expr::Neg(x) | Expr::Pow(x, _) => vec![x],
            Expr::Diff(x, _) | Expr::Not(x) => vec![x],
            Expr::Add(x) | Expr::Mul(x) | Expr::Call(_, x) => x.iter().collect(),
            Expr::Compare(_, x) | Expr::And(x) | Expr::Or(x) => x.iter().collect(),
            Expr::If(x) => x.iter().collect(),
            Expr::Div(a, b) | Expr::At(a, _, b) => vec![a, b],
            Expr::Int(b) | Expr::Sum(b) | Expr::Root(b, _) => vec![&b.from, &b.to, &b.body],
            Expr::Let(_, values, x) => values.iter().map(|v| &v.1).chain([&**x]).collect(),
            Expr::While(l) => {
                let variables = l.variables.iter().flat_map(|v| [&v.1, &v.2]);
                [&l.condition]
                    .into_iter()
                    .chain(variables)
                    .chain([&l.body])
                    .collect()
            }
        }
    }

    /// The same node with other children; as many as [`Expr::children`] gives.
    pub fn with_children(&self, new: Vec<Expr>) -> Expr {
        let mut new = new.into_iter();
        let mut next = || new.next().unwrap_or(Expr::Truth(false));
        match self {
            Expr::Num(_) | Expr::Constant(_) | Expr::I | Expr::Sym(_) | Expr::Truth(_) => {
                self.clone()
            }
            Expr::Index(n, _) => Expr::Index(n.clone(), Box::new(next())),
            Expr::Neg(_) => Expr::Neg(Box::new(next())),
            Expr::Pow(_, k) => Expr::Pow(Box::new(next()), *k),
            Expr::Call(f, _) => Expr::Call(*f, new.collect()),
            Expr::Diff(_, by) => Expr::Diff(Box::new(next()), by.clone()),
            Expr::Add(_) => Expr::Add(new.collect()),
            Expr::Mul(_) => Expr::Mul(new.collect()),
            Expr::Div(..) => Expr::Div(Box::new(next()), Box::new(next())),
            Expr::At(_, s, _) => Expr::At(Box::new(next()), s.clone(), Box::new(next())),
            Expr::Compare(r, _) => Expr::Compare(*r, new.collect()),
            Expr::And(_) => Expr::And(new.collect()),
            Expr::Or(_) => Expr::Or(new.collect()),
            Expr::Not(_) => Expr::Not(Box::new(next())),
            Expr::If(_) => Expr::If(Box::new([next(), next(), next()])),
            Expr::Let(sequential, values, _) => {
                let values = values
                    .iter()
                    .map(|(name, _)| (name.clone(), next()))
                    .collect();
                Expr::Let(*sequential, values, Box::new(next()))
            }
            Expr::While(l) => {
                let condition = next();
                let variables = l.variables.iter();
                let variables = variables
                    .map(|(name, ..)| (name.clone(), next(), next()))
                    .collect();
                Expr::While(Box::new(Loop {
                    sequential: l.sequential,
                    condition,
                    variables,
                    body: next(),
                }))
            }
            Expr::Int(b) | Expr::Sum(b) | Expr::Root(b, _) => {
                let bound = Box::new(Bound {
                    var: b.var.clone(),
                    from: next(),
                    to: next(),
                    body: next(),
                });
                match self {
                    Expr::Int(_) => Expr::Int(bound),
                    Expr::Root(_, which) => Expr::Root(bound, *which),
                    _ => Expr::Sum(bound),
                }
            }
        }
    }

    /// The text of an operand of a comparison or of a logical connective.
    fn operand(&self) -> String {
        match self {
            Expr::Compare(..) | Expr::And(_) | Expr::Or(_) | Expr::Not(_) => format!("({self})"),
            x => x.to_string(),
        }
    }

    /// Binding strength: sum, product, sign, power, atom.
    pub(super) fn strength(&self) -> u8 {
        match self {
            Expr::Compare(..) | Expr::And(_) | Expr::Or(_) | Expr::Not(_) => 0,
            Expr::Add(_) => 0,
            Expr::Neg(_) => 1,
            Expr::Num(n) if n.contains('/') => 2,
            Expr::Mul(_) | Expr::Div(..) => 2,
            Expr::Pow(..) => 3,
            _ => 4,
        }
    }
}

/// Expressions with commas between them.
fn list(x: &[Expr]) -> String {
    let parts: Vec<String> = x.iter().map(Expr::to_string).collect();
    parts.join(", ")
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
            Expr::Constant(c) => f.write_str(c.name()),
            Expr::Truth(t) => write!(f, "{t}"),
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
            Expr::Call(func, x) => write!(f, "{}({})", func.name(), list(x)),
            Expr::Root(b, which) => {
                let name = if *which == Roots::Number {
                    "roots"
                } else {
                    "root"
                };
                write!(f, "{name}({}, {}, {}, {}", b.var, b.from, b.to, b.body)?;
                if let Roots::One { place, count } = which {
                    write!(f, ", {place}, {count}")?;
                }
                f.write_str(")")
            }
            Expr::Compare(relation, x) => {
                let sign = format!(" {} ", relation.sign());
                let parts: Vec<String> = x.iter().map(Expr::operand).collect();
                f.write_str(&parts.join(&sign))
            }
            Expr::And(x) | Expr::Or(x) => {
                let word = if matches!(self, Expr::And(_)) {
                    " and "
                } else {
                    " or "
                };
                let parts: Vec<String> = x.iter().map(Expr::operand).collect();
                f.write_str(&parts.join(word))
            }
            Expr::Not(x) => write!(f, "not {}", x.operand()),
            Expr::If(x) => write!(f, "if({})", list(&**x)),
            Expr::Let(sequential, values, x) => {
                f.write_str(if *sequential { "let(" } else { "let_all(" })?;
                values
                    .iter()
                    .try_for_each(|(name, v)| write!(f, "{name}, {v}, "))?;
                write!(f, "{x})")
            }
            Expr::While(l) => {
                f.write_str(if l.sequential { "while(" } else { "while_all(" })?;
                write!(f, "{}, ", l.condition)?;
                let mut variables = l.variables.iter();
                variables.try_for_each(|(name, a, b)| write!(f, "{name}, {a}, {b}, "))?;
                write!(f, "{})", l.body)
            }
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
mod tests;
