//! The text form of expressions.
//!
//! | form | meaning |
//! |---|---|
//! | `12`, `0.5`, `1e-3`, `0x1.8p3` | numbers, exact as written |
//! | `a + b`, `a - b`, `a*b`, `a/b`, `a^b`, `-a` | arithmetic; `^` binds most tightly and to the right |
//! | `f(x)`, `f(x, y)` | the functions of [`Func`] |
//! | `a < b <= c`, `==`, `!=`, `and`, `or`, `not` | conditions |
//! | `if(c, a, b)` | a where c holds, else b |
//! | `let(x, v, f)` | f with x for the value v |
//! | `while(c, x, start, next, ..., f)` | a loop over x, then f |
//! | `int(x, a, b, f)`, `sum(n, 1, inf, f)`, `root(x, a, b, f)` | integral, sum, the only root |
//! | `D(f, t)`, `at(f, x, value)`, `a[n]`, `series(n, f)` | derivative, value, index, formal sum |
//!
//! `i` is the imaginary unit, `pi` the number, and `inf` a limit of integrals and sums. With
//! declared names ([`parse_declared`]) every other name is a constant of C or an error, and a
//! declared name wins over a constant or a function.

use super::expr::{Bound, Constant, EACH, Equation, Expr, Func, Loop, RESERVED, Relation, Roots};
use super::walk::is_number;
use super::{Symbol, SymbolicError};

/// Reads an expression.
///
/// # Errors
/// [`SymbolicError::Parse`] with the place and what was expected.
pub fn parse(text: &str) -> Result<Expr, SymbolicError> {
    read(text, None)
}

/// Reads an expression whose names are declared.
///
/// # Errors
/// As [`parse()`]; [`SymbolicError::Unknown`] for a name that is neither declared nor bound nor a
/// constant.
pub fn parse_declared(text: &str, declared: &dyn Fn(&str) -> bool) -> Result<Expr, SymbolicError> {
    read(text, Some(declared))
}

fn read(text: &str, declared: Option<&dyn Fn(&str) -> bool>) -> Result<Expr, SymbolicError> {
    let mut p = Parser::new(text, declared);
    let e = p.expression()?;
    p.end()?;
    Ok(e)
}

/// Reads `left = right`.
///
/// # Errors
/// As [`parse()`].
pub fn parse_equation(text: &str) -> Result<Equation, SymbolicError> {
    equation(text, None)
}

/// Reads `left = right` with declared names.
///
/// # Errors
/// As [`parse_declared`].
pub fn parse_declared_equation(
    text: &str,
    declared: &dyn Fn(&str) -> bool,
) -> Result<Equation, SymbolicError> {
    equation(text, Some(declared))
}

fn equation(
    text: &str,
    declared: Option<&dyn Fn(&str) -> bool>,
) -> Result<Equation, SymbolicError> {
    let mut p = Parser::new(text, declared);
    let left = p.sum()?;
    p.expect('=')?;
    let right = p.sum()?;
    p.end()?;
    Ok(Equation { left, right })
}

struct Parser<'a> {
    text: Vec<char>,
    at: usize,
    depth: usize,
    declared: Option<&'a dyn Fn(&str) -> bool>,
    /// Variables of the integrals, sums and values around.
    bound: Vec<String>,
    /// Takes names that are not known for variables of a loop that come later.
    lenient: bool,
}

/// Brackets within brackets and quotients of quotients; keeps every recursion over the tree short.
const DEEPEST: usize = 100;

/// The longest name where names are declared.
const LONGEST: usize = 64;

impl<'a> Parser<'a> {
    fn new(text: &str, declared: Option<&'a dyn Fn(&str) -> bool>) -> Parser<'a> {
        Parser {
            text: text.chars().collect(),
            at: 0,
            depth: 0,
            declared,
            bound: Vec::new(),
            lenient: false,
        }
    }

    fn peek(&mut self) -> Option<char> {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    fn taken(&mut self, c: char) -> bool {
        let found = self.peek() == Some(c);
        self.at += usize::from(found);
        found
    }

    /// Takes a sign of several characters, or a word that no letter follows.
    fn took(&mut self, sign: &str) -> bool {
        self.peek();
        let mut rest = self.text[self.at..].iter();
        let is_word = sign.starts_with(char::is_alphabetic);
        let found = sign.chars().all(|c| rest.next() == Some(&c))
            && !(is_word && rest.next().is_some_and(|c| is_inner(*c)));
        self.at += if found { sign.chars().count() } else { 0 };
        found
    }

    /// The characters from here on that are so.
    fn run(&mut self, is_so: impl Fn(&char) -> bool) -> String {
        let start = self.at;
        while self.text.get(self.at).is_some_and(&is_so) {
            self.at += 1;
        }
        self.text[start..self.at].iter().collect()
    }

    fn failed<T>(&self, reason: impl Into<String>) -> Result<T, SymbolicError> {
        Err(SymbolicError::Parse {
            at: self.at,
            reason: reason.into(),
        })
    }

    fn expect(&mut self, c: char) -> Result<(), SymbolicError> {
        match self.taken(c) {
            true => Ok(()),
            false => self.failed(format!("expected {c:?}")),
        }
    }

    fn end(&mut self) -> Result<(), SymbolicError> {
        match self.peek() {
            None => Ok(()),
            Some(c) => self.failed(format!("unexpected {c:?}")),
        }
    }

    fn deeper(&mut self, reason: &str) -> Result<(), SymbolicError> {
        self.depth += 1;
        match self.depth > DEEPEST {
            true => self.failed(reason),
            false => Ok(()),
        }
    }

    /// A number or a condition.
    fn expression(&mut self) -> Result<Expr, SymbolicError> {
        let mut parts = vec![self.conjunction()?];
        while self.took("or") || self.took("||") {
            parts.push(self.conjunction()?);
        }
        Ok(Expr::joined(parts, Expr::Or))
    }

    fn conjunction(&mut self) -> Result<Expr, SymbolicError> {
        let mut parts = vec![self.negation()?];
        while self.took("and") || self.took("&&") {
            parts.push(self.negation()?);
        }
        Ok(Expr::joined(parts, Expr::And))
    }

    fn negation(&mut self) -> Result<Expr, SymbolicError> {
        match self.took("not") {
            true => {
                self.deeper("too many brackets")?;
                let inner = self.negation()?;
                self.depth -= 1;
                Ok(Expr::Not(Box::new(inner)))
            }
            false => self.comparison(),
        }
    }

    fn comparison(&mut self) -> Result<Expr, SymbolicError> {
        let mut parts = vec![self.sum()?];
        let mut pairs: Vec<Expr> = Vec::new();
        while let Some((relation, _)) = Relation::ALL.into_iter().find(|r| self.took(r.1)) {
            let next = self.sum()?;
            let last = parts.last().cloned().unwrap_or(Expr::I);
            pairs.push(Expr::Compare(relation, vec![last, next.clone()]));
            parts.push(next);
        }
        Ok(match pairs.len() {
            0 => parts.remove(0),
            _ => Expr::joined(pairs, Expr::And),
        })
    }

    fn sum(&mut self) -> Result<Expr, SymbolicError> {
        self.deeper("too many brackets")?;
        let mut terms = vec![self.signed()?];
        loop {
            if self.taken('+') {
                terms.push(self.product()?);
            } else if self.taken('-') {
                terms.push(Expr::Neg(Box::new(self.product()?)));
            } else {
                break;
            }
        }
        self.depth -= 1;
        Ok(Expr::joined(terms, Expr::Add))
    }

    fn signed(&mut self) -> Result<Expr, SymbolicError> {
        match self.taken('-') {
            true => Ok(Expr::Neg(Box::new(self.product()?))),
            false => self.product(),
        }
    }

    fn product(&mut self) -> Result<Expr, SymbolicError> {
        let depth = self.depth;
        let mut factors = vec![self.power()?];
        loop {
            if self.taken('*') {
                factors.push(self.power()?);
            } else if self.taken('/') {
                self.deeper("too many quotients")?;
                let below = self.power()?;
                let above = Expr::joined(factors, Expr::Mul);
                factors = vec![Expr::Div(Box::new(above), Box::new(below))];
            } else {
                self.depth = depth;
                return Ok(Expr::joined(factors, Expr::Mul));
            }
        }
    }

    /// A power; an exponent that is an integer of up to three digits is one of repeated products.
    fn power(&mut self) -> Result<Expr, SymbolicError> {
        let base = self.atom()?;
        if !self.taken('^') {
            return Ok(base);
        }
        self.deeper("too many powers")?;
        let negative = self.taken('-');
        let exponent = self.power()?;
        self.depth -= 1;
        let exponent = match negative {
            true => Expr::Neg(Box::new(exponent)),
            false => exponent,
        };
        let integer = |e: &Expr| match e {
            Expr::Num(n) => n.parse::<i32>().ok().filter(|k| *k <= 1000),
            _ => None,
        };
        let integer = match &exponent {
            Expr::Neg(e) => integer(e).map(|k| -k),
            e => integer(e),
        };
        Ok(match integer {
            Some(k) => Expr::Pow(Box::new(base), k),
            None => Expr::Call(Func::Pow, vec![base, exponent]),
        })
    }

    fn name(&mut self) -> Result<String, SymbolicError> {
        if !self.peek().is_some_and(is_first) {
            return self.failed("expected a name");
        }
        let start = self.at;
        let name = self.run(|c| is_inner(*c));
        if self.declared.is_none() {
            Symbol::named(&name)?;
        } else if name.len() > LONGEST {
            self.at = start;
            return self.failed(format!("a name of more than {LONGEST} characters"));
        }
        Ok(name)
    }

    /// The name of a variable.
    fn variable(&mut self) -> Result<String, SymbolicError> {
        let name = self.name()?;
        match RESERVED.contains(&name.as_str()) && !self.is_declared(&name) {
            true => Err(SymbolicError::Reserved(name)),
            false => Ok(name),
        }
    }

    fn is_declared(&self, name: &str) -> bool {
        self.bound.iter().any(|b| b == name) || self.declared.is_some_and(|known| known(name))
    }

    fn atom(&mut self) -> Result<Expr, SymbolicError> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.expression()?;
                self.expect(')')?;
                Ok(inner)
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if is_first(c) => {
                let start = self.at;
                let name = self.name()?;
                self.named(name, start)
            }
            Some(c) => self.failed(format!("unexpected {c:?}")),
            None => self.failed("expected an expression"),
        }
    }

    fn number(&mut self) -> Result<Expr, SymbolicError> {
        let start = self.at;
        let mut digits = self.run(|c| c.is_ascii_digit() || *c == '.');
        let hexadecimal = digits == "0" && matches!(self.text.get(self.at), Some('x' | 'X'));
        if hexadecimal {
            digits += &self.run(|c| c.is_ascii_hexdigit() || matches!(c, '.' | 'x' | 'X'));
        }
        let marks = if hexadecimal { ['p', 'P'] } else { ['e', 'E'] };
        let sign = self
            .text
            .get(self.at + 1)
            .is_some_and(|c| matches!(c, '+' | '-'));
        let first = self.text.get(self.at + 1 + usize::from(sign));
        if self.text.get(self.at).is_some_and(|c| marks.contains(c))
            && first.is_some_and(char::is_ascii_digit)
        {
            let end = self.at + 1 + usize::from(sign);
            digits.extend(&self.text[self.at..end]);
            self.at = end;
            digits += &self.run(char::is_ascii_digit);
        }
        match is_number(&digits) {
            true => Ok(Expr::Num(digits)),
            false => {
                self.at = start + digits.len();
                self.failed("expected a decimal number")
            }
        }
    }

    /// An argument that is not the first.
    fn next(&mut self) -> Result<Expr, SymbolicError> {
        self.expect(',')?;
        self.expression()
    }

    /// An argument in which a variable is bound.
    fn next_binding(&mut self, var: &str) -> Result<Expr, SymbolicError> {
        self.expect(',')?;
        self.bound.push(var.into());
        let body = self.expression();
        self.bound.pop();
        body
    }

    /// `var, from, to, body)`.
    fn bound(&mut self) -> Result<Box<Bound>, SymbolicError> {
        let bound = self.open_bound()?;
        self.expect(')')?;
        Ok(bound)
    }

    /// `var, from, to, body`.
    fn open_bound(&mut self) -> Result<Box<Bound>, SymbolicError> {
        let var = self.variable()?;
        let [from, to] = [self.next()?, self.next()?];
        let body = self.next_binding(&var)?;
        Ok(Box::new(Bound {
            var,
            from,
            to,
            body,
        }))
    }

    /// `var, from, to, body)`, or `var, from, to, body, place, count)`.
    fn root(&mut self) -> Result<Expr, SymbolicError> {
        let bound = self.open_bound()?;
        if self.taken(')') {
            return Ok(Expr::Root(bound, Roots::Only));
        }
        self.peek();
        let start = self.at;
        let numbers = [self.next()?, self.next()?];
        self.expect(')')?;
        let numbers = numbers.map(|x| match x {
            Expr::Num(text) => text.parse::<u32>().ok(),
            _ => None,
        });
        match numbers {
            [Some(place), Some(count)] if 1 <= place && place <= count => {
                Ok(Expr::Root(bound, Roots::One { place, count }))
            }
            _ => {
                self.at = start;
                self.failed("expected the place of a root and the number of roots: 1, 3")
            }
        }
    }

    fn arguments(&mut self) -> Result<Vec<Expr>, SymbolicError> {
        let mut arguments = vec![self.expression()?];
        while self.taken(',') {
            arguments.push(self.expression()?);
        }
        self.expect(')')?;
        Ok(arguments)
    }

    /// `name, value, ..., body)`.
    fn values(&mut self, sequential: bool) -> Result<Expr, SymbolicError> {
        let outside = self.bound.len();
        let mut values = Vec::new();
        loop {
            // A variable is followed by a comma; what is left is the body.
            let start = self.at;
            let name = self.variable().ok().filter(|_| self.taken(','));
            let Some(name) = name else {
                self.at = start;
                break;
            };
            let inside: Vec<String> = match sequential {
                true => Vec::new(),
                false => self.bound.split_off(outside),
            };
            let value = self.expression();
            self.bound.extend(inside);
            self.bound.push(name.clone());
            values.push((name, value?));
            self.expect(',')?;
        }
        let body = self.expression()?;
        self.bound.truncate(outside);
        self.expect(')')?;
        Ok(Expr::Let(sequential, values, Box::new(body)))
    }

    /// `condition, name, start, next, ..., body)`: the condition and the updates
    /// see variables that stand after them, so that the names are read first.
    fn a_loop(&mut self, sequential: bool) -> Result<Expr, SymbolicError> {
        let (start, outside) = (self.at, self.bound.len());
        if !self.lenient {
            self.lenient = true;
            let first = self.loop_once(sequential);
            self.lenient = false;
            self.bound.truncate(outside);
            let names = first?.variables.into_iter().map(|v| v.0);
            self.bound.extend(names);
            self.at = start;
        }
        let found = self.loop_once(sequential);
        self.bound.truncate(outside);
        Ok(Expr::While(Box::new(found?)))
    }

    fn loop_once(&mut self, sequential: bool) -> Result<Loop, SymbolicError> {
        let condition = self.expression()?;
        self.expect(',')?;
        let mut variables = Vec::new();
        loop {
            let here = self.at;
            let Some(name) = self.variable().ok().filter(|_| self.taken(',')) else {
                self.at = here;
                break;
            };
            let [first, update] = [self.expression()?, self.next()?];
            variables.push((name, first, update));
            self.expect(',')?;
        }
        let body = self.expression()?;
        self.expect(')')?;
        Ok(Loop {
            sequential,
            condition,
            variables,
            body,
        })
    }

    fn named(&mut self, name: String, start: usize) -> Result<Expr, SymbolicError> {
        if self.is_declared(&name) {
            return match self.peek() {
                Some('(') => self.failed(format!("{name} is a name here, not a function")),
                Some('[') => self.index(name),
                _ => Ok(Expr::Sym(name)),
            };
        }
        if let Some(f) = Func::named(&name) {
            if self.taken('(') {
                let arguments = self.arguments()?;
                if arguments.len() != f.arity() {
                    self.at = start;
                    let found = arguments.len();
                    let due = match f.arity() {
                        1 => "one argument".to_string(),
                        n => format!("{n} arguments"),
                    };
                    return self.failed(format!("{name} takes {due}, not {found}"));
                }
                return Ok(Expr::Call(f, arguments));
            }
            // Aliases are names of symbols as well.
            if f.name() == name || self.declared.is_some() {
                return self.failed("expected '('");
            }
        }
        match name.as_str() {
            "i" => Ok(Expr::I),
            "int" if self.taken('(') => Ok(Expr::Int(self.bound()?)),
            "sum" if self.taken('(') => Ok(Expr::Sum(self.bound()?)),
            "root" if self.taken('(') => self.root(),
            "roots" if self.taken('(') => Ok(Expr::Root(self.bound()?, Roots::Number)),
            "int" | "sum" => self.failed("expected '('"),
            "if" if self.taken('(') => {
                let arguments = self.arguments()?;
                match <[Expr; 3]>::try_from(arguments) {
                    Ok(parts) => Ok(Expr::If(Box::new(parts))),
                    Err(other) => {
                        self.at = start;
                        self.failed(format!("if takes 3 arguments, not {}", other.len()))
                    }
                }
            }
            "let" | "let_all" if self.taken('(') => self.values(name == "let"),
            "while" | "while_all" if self.taken('(') => self.a_loop(name == "while"),
            "true" => Ok(Expr::Truth(true)),
            "false" => Ok(Expr::Truth(false)),
            "series" if self.taken('(') => {
                let var = self.variable()?;
                let body = self.next_binding(&var)?;
                self.expect(')')?;
                Ok(Expr::Sum(Box::new(Bound {
                    var,
                    from: Expr::Num("1".into()),
                    to: Expr::Sym(EACH.into()),
                    body,
                })))
            }
            "D" if self.taken('(') => {
                let x = self.expression()?;
                self.expect(',')?;
                self.peek();
                let here = self.at;
                let by = self.variable()?;
                self.is_known(&by, here)?;
                self.expect(')')?;
                Ok(Expr::Diff(Box::new(x), by))
            }
            "at" if self.taken('(') => {
                let x = self.expression()?;
                self.expect(',')?;
                self.peek();
                let here = self.at;
                let symbol = self.variable()?;
                self.is_known(&symbol, here)?;
                let value = self.next()?;
                self.expect(')')?;
                Ok(Expr::At(Box::new(x), symbol, Box::new(value)))
            }
            _ if self.peek() == Some('[') => self.index(name),
            "pi" | "inf" => Ok(Expr::Sym(name)),
            _ if self.declared.is_none() || self.lenient => Ok(Expr::Sym(name)),
            "e" => Ok(Expr::Constant(Constant::E)),
            _ => {
                if let Some((c, _)) = Constant::ALL.iter().find(|c| c.1 == name) {
                    return Ok(Expr::Constant(*c));
                }
                Err(SymbolicError::Unknown { at: start, name })
            }
        }
    }

    fn is_known(&self, name: &str, at: usize) -> Result<(), SymbolicError> {
        match self.declared.is_none() || self.lenient || self.is_declared(name) {
            true => Ok(()),
            false => Err(SymbolicError::Unknown {
                at,
                name: name.into(),
            }),
        }
    }

    fn index(&mut self, name: String) -> Result<Expr, SymbolicError> {
        self.expect('[')?;
        let index = self.sum()?;
        self.expect(']')?;
        Ok(Expr::Index(name, Box::new(index)))
    }
}

fn is_first(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

fn is_inner(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '_' | '\'')
}

#[cfg(test)]
mod tests;
