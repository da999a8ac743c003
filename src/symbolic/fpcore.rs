//! FPCore 2.0: formulas as S-expressions (<https://fpbench.org/spec/fpcore-2.0.html>), for real
//! scalars.

use crate::expr::{Constant, Expr, Loop, Relation};
use crate::{Func, Place, SymbolicError, number};
use rug::Rational;
use rug::ops::Pow;

/// A core: a formula with its arguments and properties.
#[derive(Clone, Debug)]
pub struct Core {
    /// The symbol after `FPCore`.
    pub identifier: Option<String>,
    /// The property `:name`.
    pub name: Option<String>,
    /// The arguments in order.
    pub arguments: Vec<String>,
    /// The property `:precision`: `binary64`, `binary32`, `real`.
    pub precision: Option<String>,
    /// A format that the core or a part of it asks for and that is not binary64 or binary32 all
    /// over, or a rounding that is not to nearest.
    pub other_rounding: Option<String>,
    /// The property `:pre`, a condition on the arguments, and where it stands.
    pub pre: Option<(Expr, Place)>,
    /// The property `:spec`, the formula that is meant.
    pub spec: Option<Expr>,
    /// Other properties whose values are strings, for reports: `:description`, `:cite`.
    pub texts: Vec<(String, String)>,
    /// The formula.
    pub body: Expr,
    /// The line where it begins, counted from 1.
    pub line: usize,
}

/// A fault in a text of cores, with its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct CoreError {
    /// The place.
    pub place: Place,
    /// The reason.
    pub reason: String,
    /// A name without a meaning, and the names that have one there.
    pub unknown: Option<(String, Vec<String>)>,
}

/// Brackets within brackets.
const DEEPEST: usize = 250;

/// Reads all cores of a text; each by itself, so that one with tensors does not hide the others.
///
/// # Errors
/// A text that is no sequence of lists. A core that cannot be read is an error in its place.
pub fn parse_cores(text: &str) -> Result<Vec<Result<Core, CoreError>>, CoreError> {
    let mut reader = Reader {
        text: text.as_bytes(),
        at: 0,
        depth: 0,
    };
    let mut cores = Vec::new();
    while let Some(datum) = reader.next()? {
        cores.push(core(text, &datum).map_err(|fault| fault.within(text)));
    }
    Ok(cores)
}

/// A fault at a byte of the text.
struct Fault {
    at: usize,
    reason: String,
    unknown: Option<(String, Vec<String>)>,
}

impl Fault {
    fn within(self, text: &str) -> CoreError {
        CoreError {
            place: Place::of(text, self.at),
            reason: self.reason,
            unknown: self.unknown,
        }
    }
}

fn fault<T>(at: usize, reason: impl Into<String>) -> Result<T, Fault> {
    Err(Fault {
        at,
        reason: reason.into(),
        unknown: None,
    })
}

/// A datum with the byte where it begins.
#[derive(Clone, Debug)]
struct Datum {
    at: usize,
    line: usize,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    Symbol(String),
    Text(String),
    List(Vec<Datum>),
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    fn failed<T>(&self, at: usize, reason: impl Into<String>) -> Result<T, CoreError> {
        fault(at, reason).map_err(|fault| fault.within(&String::from_utf8_lossy(self.text)))
    }

    fn skip(&mut self) {
        while let Some(byte) = self.text.get(self.at) {
            match byte {
                b';' => {
                    let rest = self.text[self.at..].iter();
                    self.at += rest.take_while(|b| **b != b'\n').count();
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => return,
            }
        }
    }

    /// The next datum; none at the end.
    fn next(&mut self) -> Result<Option<Datum>, CoreError> {
        self.skip();
        let start = self.at;
        let Some(first) = self.text.get(start).copied() else {
            return Ok(None);
        };
        let form = match first {
            b'(' | b'[' => {
                self.depth += 1;
                if self.depth > DEEPEST {
                    return self.failed(start, "too many brackets");
                }
                self.at += 1;
                let close = if first == b'(' { b')' } else { b']' };
                let mut parts = Vec::new();
                loop {
                    self.skip();
                    match self.text.get(self.at) {
                        Some(byte) if *byte == close => break,
                        Some(b')' | b']') => {
                            return self.failed(self.at, "a bracket of the other kind is open");
                        }
                        None => return self.failed(start, "a bracket that is not closed"),
                        Some(_) => parts.extend(self.next()?),
                    }
                }
                self.at += 1;
                self.depth -= 1;
                Form::List(parts)
            }
            b')' | b']' => return self.failed(start, "a bracket that closes nothing"),
            b'"' => {
                self.at += 1;
                let mut out = Vec::new();
                loop {
                    match self.text.get(self.at) {
                        None => return self.failed(start, "a string that does not end"),
                        Some(b'"') => break,
                        Some(b'\\') => {
                            out.extend(self.text.get(self.at + 1));
                            self.at += 2;
                        }
                        Some(byte) => {
                            out.push(*byte);
                            self.at += 1;
                        }
                    }
                }
                self.at += 1;
                Form::Text(String::from_utf8_lossy(&out).into_owned())
            }
            _ => {
                let rest = self.text[start..].iter();
                let ends = |b: &u8| b.is_ascii_whitespace() || b"()[]\";".contains(b);
                self.at += rest.take_while(|b| !ends(b)).count();
                Form::Symbol(String::from_utf8_lossy(&self.text[start..self.at]).into_owned())
            }
        };
        let line = self.text[..start].iter().filter(|b| **b == b'\n').count() + 1;
        Ok(Some(Datum {
            at: start,
            line,
            form,
        }))
    }
}

impl Datum {
    fn symbol(&self) -> Result<&str, Fault> {
        match &self.form {
            Form::Symbol(s) => Ok(s),
            _ => fault(self.at, "expected a symbol"),
        }
    }

    fn list(&self) -> Result<&[Datum], Fault> {
        match &self.form {
            Form::List(parts) => Ok(parts),
            _ => fault(self.at, "expected a list"),
        }
    }
}

/// A core of its datum.
fn core(text: &str, datum: &Datum) -> Result<Core, Fault> {
    let mut parts = datum.list()?.iter().peekable();
    match parts.next().map(Datum::symbol) {
        Some(Ok("FPCore")) => {}
        _ => return fault(datum.at, "expected (FPCore ...)"),
    }
    let identifier = match parts.peek().map(|p| &p.form) {
        Some(Form::Symbol(name)) => {
            let name = name.clone();
            parts.next();
            Some(name)
        }
        _ => None,
    };
    let Some(list) = parts.next() else {
        return fault(datum.at, "a core without arguments");
    };
    let mut arguments: Vec<String> = Vec::new();
    for argument in list.list()? {
        let name = match &argument.form {
            Form::Symbol(name) => name.clone(),
            // (! props... name)
            Form::List(parts) => match (parts.first(), parts.last()) {
                (Some(first), Some(last)) if first.symbol().is_ok_and(|s| s == "!") => {
                    last.symbol()?.to_string()
                }
                _ => return fault(argument.at, "an argument that is not a real scalar"),
            },
            Form::Text(_) => return fault(argument.at, "expected a name"),
        };
        if arguments.contains(&name) {
            return fault(argument.at, format!("the argument {name} is named twice"));
        }
        if name == "inf" {
            return fault(argument.at, "inf is infinity, and no name");
        }
        arguments.push(name);
    }
    let mut found = Core {
        identifier,
        name: None,
        arguments: arguments.clone(),
        precision: None,
        other_rounding: None,
        pre: None,
        spec: None,
        texts: Vec::new(),
        body: Expr::Truth(false),
        line: datum.line,
    };
    let mut names = arguments;
    while let Some(part) = parts.next() {
        let property = match &part.form {
            Form::Symbol(s) if s.starts_with(':') => s.as_str(),
            _ => {
                if let Some(extra) = parts.next() {
                    return fault(extra.at, "a core with more than one body");
                }
                found.body = expression(part, &mut names)?;
                found.other_rounding = other_rounding(datum, found.precision.as_deref());
                return Ok(found);
            }
        };
        let Some(value) = parts.next() else {
            return fault(part.at, format!("the property {property} has no value"));
        };
        match (property, &value.form) {
            (":name", Form::Text(text)) => found.name = Some(text.clone()),
            (":precision", Form::Symbol(s)) => found.precision = Some(s.clone()),
            (":pre", _) => {
                let place = Place::of(text, value.at);
                found.pre = Some((expression(value, &mut names)?, place));
            }
            (":spec", _) => found.spec = Some(expression(value, &mut names)?),
            (property, Form::Text(text)) => {
                found.texts.push((property[1..].to_string(), text.clone()));
            }
            _ => {}
        }
    }
    fault(datum.at, "a core without a body")
}

/// The first format other than the core's own, or rounding other than to nearest.
fn other_rounding(core: &Datum, precision: Option<&str>) -> Option<String> {
    let own = precision.unwrap_or("binary64");
    if !["binary64", "binary32", "real"].contains(&own) {
        return Some(own.into());
    }
    let mut open = vec![core];
    while let Some(datum) = open.pop() {
        let Form::List(parts) = &datum.form else {
            continue;
        };
        for pair in parts.windows(2) {
            let [Form::Symbol(property), Form::Symbol(value)] = [&pair[0].form, &pair[1].form]
            else {
                continue;
            };
            let due = match property.as_str() {
                ":precision" => own,
                ":round" => "nearestEven",
                _ => continue,
            };
            if value != due {
                return Some(value.clone());
            }
        }
        open.extend(parts);
    }
    None
}

/// A symbol: a name that is bound, a number or a constant.
fn atom(at: usize, s: &str, names: &[String]) -> Result<Expr, Fault> {
    if names.iter().any(|name| name == s) {
        return Ok(Expr::Sym(s.into()));
    }
    let (sign, size) = match s.strip_prefix('-') {
        Some(size) => (true, size),
        None => (false, s.strip_prefix('+').unwrap_or(s)),
    };
    if size.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        if number(size).is_none() {
            return fault(at, format!("{s} is no number, or too long for one"));
        }
        let size = Expr::Num(size.into());
        return Ok(if sign {
            Expr::Neg(Box::new(size))
        } else {
            size
        });
    }
    match s {
        "TRUE" => return Ok(Expr::Truth(true)),
        "FALSE" => return Ok(Expr::Truth(false)),
        "INFINITY" => return Ok(Expr::Sym("inf".into())),
        // No real number is meant, and in floating point 0/0 is NaN.
        "NAN" => {
            let zero = || Box::new(Expr::Num("0".into()));
            return Ok(Expr::Div(zero(), zero()));
        }
        _ => {}
    }
    match Constant::ALL.iter().find(|c| c.1 == s) {
        Some((c, _)) => Ok(Expr::Constant(*c)),
        None => Err(Fault {
            at,
            reason: format!("the name {s} is not bound"),
            unknown: Some((
                s.into(),
                names
                    .iter()
                    .map(String::as_str)
                    .chain(Constant::ALL.iter().map(|c| c.1))
                    .map(String::from)
                    .collect(),
            )),
        }),
    }
}

/// An expression of its datum.
fn expression(datum: &Datum, names: &mut Vec<String>) -> Result<Expr, Fault> {
    let at = datum.at;
    let parts = match &datum.form {
        Form::Symbol(s) => return atom(at, s, names),
        Form::Text(_) => return fault(at, "a string where a number is expected"),
        Form::List(parts) => parts.as_slice(),
    };
    let [head, rest @ ..] = parts else {
        return fault(at, "an empty list");
    };
    let name = head.symbol()?;
    let all = |names: &mut Vec<String>| -> Result<Vec<Expr>, Fault> {
        rest.iter().map(|x| expression(x, names)).collect()
    };
    let count = |n: usize| match rest.len() == n {
        true => Ok(()),
        false => fault(
            at,
            format!(
                "{name} takes {n} argument{}, not {}",
                if n == 1 { "" } else { "s" },
                rest.len()
            ),
        ),
    };
    Ok(match name {
        "+" | "*" => {
            if rest.is_empty() {
                return fault(at, format!("{name} of nothing"));
            }
            let of = if name == "+" { Expr::Add } else { Expr::Mul };
            Expr::joined(all(names)?, of)
        }
        "-" => {
            let mut terms = all(names)?.into_iter();
            match (terms.next(), terms.len()) {
                (None, _) => return fault(at, "- of nothing"),
                (Some(x), 0) => Expr::Neg(Box::new(x)),
                (Some(x), _) => {
                    let rest = terms.map(|x| Expr::Neg(Box::new(x)));
                    Expr::Add(std::iter::once(x).chain(rest).collect())
                }
            }
        }
        "/" if rest.len() == 1 => {
            let one = Expr::Num("1".into());
            Expr::Div(Box::new(one), Box::new(expression(&rest[0], names)?))
        }
        "/" => {
            count(2)?;
            let [a, b] = pair(all(names)?, at)?;
            Expr::Div(Box::new(a), Box::new(b))
        }
        "pow" => {
            count(2)?;
            let [a, b] = pair(all(names)?, at)?;
            Expr::Call(Func::Pow, vec![a, b])
        }
        "and" => Expr::And(all(names)?),
        "or" if rest.is_empty() => Expr::Truth(false),
        "or" => Expr::Or(all(names)?),
        "not" => {
            count(1)?;
            Expr::Not(Box::new(expression(&rest[0], names)?))
        }
        "if" => {
            count(3)?;
            let mut parts = all(names)?.into_iter();
            let mut next = || parts.next().unwrap_or(Expr::Truth(false));
            Expr::If(Box::new([next(), next(), next()]))
        }
        "let" | "let*" => {
            count(2)?;
            let sequential = name == "let*";
            let outside = names.len();
            let mut values = Vec::new();
            for binding in rest[0].list()? {
                let [variable, value] = binding.list()? else {
                    return fault(binding.at, "expected (name value)");
                };
                let value = expression(value, names)?;
                values.push((variable.symbol()?.to_string(), value));
                if sequential {
                    names.push(variable.symbol()?.to_string());
                }
            }
            names.extend(values.iter().map(|v| v.0.clone()));
            let body = expression(&rest[1], names);
            names.truncate(outside);
            Expr::Let(sequential, values, Box::new(body?))
        }
        "while" | "while*" => {
            count(3)?;
            let sequential = name == "while*";
            let outside = names.len();
            let mut starts = Vec::new();
            for binding in rest[1].list()? {
                let [variable, start, update] = binding.list()? else {
                    return fault(binding.at, "expected (name start next)");
                };
                let start = expression(start, names)?;
                starts.push((variable.symbol()?.to_string(), start, update));
                if sequential {
                    names.push(variable.symbol()?.to_string());
                }
            }
            names.extend(starts.iter().map(|v| v.0.clone()));
            let mut variables = Vec::new();
            for (variable, start, update) in starts {
                variables.push((variable, start, expression(update, names)?));
            }
            let condition = expression(&rest[0], names)?;
            let body = expression(&rest[2], names);
            names.truncate(outside);
            Expr::While(Box::new(Loop {
                sequential,
                condition,
                variables,
                body: body?,
            }))
        }
        // (! props... expression)
        "!" => match rest.last() {
            Some(last) => expression(last, names)?,
            None => return fault(at, "! of nothing"),
        },
        "cast" => {
            count(1)?;
            expression(&rest[0], names)?
        }
        "digits" => {
            count(3)?;
            digits(rest).map_or_else(|| fault(at, "expected (digits m e b)"), Ok)?
        }
        // Every real number is finite.
        "isfinite" | "isinf" | "isnan" => {
            count(1)?;
            expression(&rest[0], names)?;
            Expr::Truth(name == "isfinite")
        }
        "isnormal" => {
            count(1)?;
            let zero = Expr::Num("0".into());
            Expr::Compare(Relation::NotEqual, vec![expression(&rest[0], names)?, zero])
        }
        "signbit" => {
            count(1)?;
            let zero = Expr::Num("0".into());
            Expr::Compare(Relation::Less, vec![expression(&rest[0], names)?, zero])
        }
        "array" | "ref" | "dim" | "size" | "tensor" | "tensor*" | "for" | "for*" => {
            return fault(
                at,
                format!("{name} is for tensors, and only real scalars are read"),
            );
        }
        name => {
            let sign = if name == "=" { "==" } else { name };
            if let Some((relation, _)) = Relation::ALL.iter().find(|r| r.1 == sign) {
                return compared(*relation, all(names)?, at);
            }
            match Func::named(name)
                .filter(|_| !matches!(name, "abs" | "gamma" | "ln" | "re" | "im"))
            {
                Some(f) => {
                    count(f.arity())?;
                    Expr::Call(f, all(names)?)
                }
                None => {
                    return Err(Fault {
                        at: head.at,
                        reason: format!("there is no operator {name}"),
                        unknown: Some((
                            name.into(),
                            Func::ALL.iter().map(|f| f.1.into()).collect(),
                        )),
                    });
                }
            }
        }
    })
}

/// Comparisons of neighbours; of all pairs where all have to differ.
fn compared(relation: Relation, parts: Vec<Expr>, at: usize) -> Result<Expr, Fault> {
    if parts.is_empty() {
        return fault(at, "a comparison of nothing");
    }
    let mut pairs = Vec::new();
    for (k, a) in parts.iter().enumerate() {
        let reach = if relation == Relation::NotEqual {
            parts.len()
        } else {
            k + 2
        };
        for b in parts.iter().take(reach).skip(k + 1) {
            pairs.push(Expr::Compare(relation, vec![a.clone(), b.clone()]));
        }
    }
    Ok(match pairs.len() {
        0 => Expr::Truth(true),
        _ => Expr::joined(pairs, Expr::And),
    })
}

fn pair(parts: Vec<Expr>, at: usize) -> Result<[Expr; 2], Fault> {
    <[Expr; 2]>::try_from(parts).or_else(|_| fault(at, "expected two arguments"))
}

/// `m b^e` of `(digits m e b)`.
fn digits(parts: &[Datum]) -> Option<Expr> {
    let integer = |d: &Datum| d.symbol().ok()?.parse::<rug::Integer>().ok();
    let [m, e, b] = parts else {
        return None;
    };
    let (m, e, b) = (integer(m)?, integer(e)?.to_i32()?, integer(b)?);
    if e.unsigned_abs() > 20_000 || !(2..=1000).contains(&b) {
        return None;
    }
    let power = b.pow(e.unsigned_abs());
    let value = match e < 0 {
        true => Rational::from((m.clone().abs(), power)),
        false => Rational::from(m.clone().abs() * power),
    };
    let size = Expr::Num(value.to_string());
    Some(if m < 0 {
        Expr::Neg(Box::new(size))
    } else {
        size
    })
}

impl Core {
    /// The name under which it is asked for: the symbol, else the property `:name`.
    pub fn title(&self) -> &str {
        self.identifier
            .as_deref()
            .or(self.name.as_deref())
            .unwrap_or("unnamed")
    }
}

impl From<CoreError> for SymbolicError {
    fn from(error: CoreError) -> SymbolicError {
        SymbolicError::Parse {
            at: 0,
            reason: error.to_string(),
        }
    }
}

#[cfg(test)]
mod tests;
