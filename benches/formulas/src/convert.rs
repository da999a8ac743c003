//! Formulas as rival3 has them.

use mechaudit_symbolic::{Constant, Definitions, Expr, Func, Relation, number, parse};
use rival::Expr as Theirs;
use rug::{Float, Rational};

/// The same formula in rival3's language; none where it lacks an operation.
pub fn expression(e: &Expr, names: &Definitions) -> Option<Theirs> {
    let one = |x: &Expr| expression(x, names).map(Box::new);
    let all = |parts: &[Expr], of: fn(Box<Theirs>, Box<Theirs>) -> Theirs| {
        let mut parts = parts.iter();
        let mut found = expression(parts.next()?, names)?;
        for part in parts {
            found = of(Box::new(found), Box::new(expression(part, names)?));
        }
        Some(found)
    };
    Some(match e {
        Expr::Num(n) => rational(number(n)?),
        Expr::Constant(Constant::Pi) => Theirs::Pi,
        Expr::Constant(Constant::E) => Theirs::E,
        Expr::Constant(c) => expression(&parse(c.definition()).ok()?, names)?,
        Expr::Sym(name) if name == "pi" => Theirs::Pi,
        Expr::Sym(name) => match names.names.get(name) {
            Some(value) => expression(value, names)?,
            None => Theirs::Var(name.clone()),
        },
        Expr::Neg(x) => Theirs::Neg(one(x)?),
        Expr::Add(terms) => {
            let mut terms = terms.iter();
            let mut found = expression(terms.next()?, names)?;
            for term in terms {
                found = match term {
                    Expr::Neg(x) => Theirs::Sub(Box::new(found), one(x)?),
                    x => Theirs::Add(Box::new(found), one(x)?),
                };
            }
            found
        }
        Expr::Mul(parts) => all(parts, Theirs::Mul)?,
        Expr::Div(a, b) => Theirs::Div(one(a)?, one(b)?),
        Expr::Pow(x, k) => Theirs::Pow(one(x)?, Box::new(rational(Rational::from(*k)))),
        Expr::If(parts) => {
            let [c, a, b] = parts.each_ref().map(one);
            Theirs::If(c?, a?, b?)
        }
        Expr::And(parts) => all(parts, Theirs::And)?,
        Expr::Or(parts) => all(parts, Theirs::Or)?,
        Expr::Not(x) => Theirs::Not(one(x)?),
        Expr::Compare(relation, parts) => {
            let [a, b] = parts.as_slice() else {
                return None;
            };
            let (a, b) = (one(a)?, one(b)?);
            match relation {
                Relation::Less => Theirs::Lt(a, b),
                Relation::LessEqual => Theirs::Le(a, b),
                Relation::Greater => Theirs::Gt(a, b),
                Relation::GreaterEqual => Theirs::Ge(a, b),
                Relation::Equal => Theirs::Eq(a, b),
                Relation::NotEqual => Theirs::Ne(a, b),
            }
        }
        Expr::Let(sequential, values, body) => {
            // Their machine shares equal subexpressions.
            let mut inner = names.clone();
            for (name, value) in values {
                let seen = if *sequential { &inner } else { names };
                let value = inlined(value, seen);
                inner.set(name, value);
            }
            expression(&inlined(body, &inner), &Definitions::default())?
        }
        Expr::Call(f, parts) => call(*f, parts, names)?,
        _ => return None,
    })
}

/// The expression with the values of names in their places.
fn inlined(e: &Expr, names: &Definitions) -> Expr {
    match e {
        Expr::Sym(name) => names.names.get(name).cloned().unwrap_or_else(|| e.clone()),
        Expr::Let(sequential, values, body) => {
            let mut inner = names.clone();
            for (name, value) in values {
                let seen = if *sequential {
                    inner.clone()
                } else {
                    names.clone()
                };
                inner.set(name, inlined(value, &seen));
            }
            inlined(body, &inner)
        }
        e => {
            let parts = e.children().into_iter().map(|x| inlined(x, names));
            e.with_children(parts.collect())
        }
    }
}

fn rational(q: Rational) -> Theirs {
    let x = q.to_f64();
    match Rational::from_f64(x) == Some(q.clone()) {
        true => Theirs::Literal(Float::with_val(53, x)),
        false => Theirs::Rational(q),
    }
}

fn call(f: Func, parts: &[Expr], names: &Definitions) -> Option<Theirs> {
    let mut arguments = parts.iter().map(|x| expression(x, names).map(Box::new));
    let mut next = || arguments.next().flatten();
    Some(match f {
        Func::Sqrt => Theirs::Sqrt(next()?),
        Func::Cbrt => Theirs::Cbrt(next()?),
        Func::Exp => Theirs::Exp(next()?),
        Func::Exp2 => Theirs::Exp2(next()?),
        Func::Expm1 => Theirs::Expm1(next()?),
        Func::Log => Theirs::Log(next()?),
        Func::Log2 => Theirs::Log2(next()?),
        Func::Log10 => Theirs::Log10(next()?),
        Func::Log1p => Theirs::Log1p(next()?),
        Func::Sin => Theirs::Sin(next()?),
        Func::Cos => Theirs::Cos(next()?),
        Func::Tan => Theirs::Tan(next()?),
        Func::Asin => Theirs::Asin(next()?),
        Func::Acos => Theirs::Acos(next()?),
        Func::Arctan => Theirs::Atan(next()?),
        Func::Sinh => Theirs::Sinh(next()?),
        Func::Cosh => Theirs::Cosh(next()?),
        Func::Tanh => Theirs::Tanh(next()?),
        Func::Asinh => Theirs::Asinh(next()?),
        Func::Acosh => Theirs::Acosh(next()?),
        Func::Atanh => Theirs::Atanh(next()?),
        Func::Erf => Theirs::Erf(next()?),
        Func::Erfc => Theirs::Erfc(next()?),
        Func::Abs => Theirs::Fabs(next()?),
        Func::Floor => Theirs::Floor(next()?),
        Func::Ceil => Theirs::Ceil(next()?),
        Func::Round => Theirs::Round(next()?),
        Func::Trunc => Theirs::Trunc(next()?),
        Func::Pow => Theirs::Pow(next()?, next()?),
        Func::Atan2 => Theirs::Atan2(next()?, next()?),
        Func::Hypot => Theirs::Hypot(next()?, next()?),
        Func::Fmin => Theirs::Fmin(next()?, next()?),
        Func::Fmax => Theirs::Fmax(next()?, next()?),
        Func::Fdim => Theirs::Fdim(next()?, next()?),
        Func::Fmod => Theirs::Fmod(next()?, next()?),
        Func::Remainder => Theirs::Remainder(next()?, next()?),
        Func::Copysign => Theirs::Copysign(next()?, next()?),
        Func::Fma => Theirs::Fma(next()?, next()?, next()?),
        _ => return None,
    })
}
