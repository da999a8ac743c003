//! The text form of expressions.
//!
//! `+ - * /`, integer powers `x^2`, `x^(-1)`; the functions of [`Func`]; `int(x, a, b, f)`,
//! `sum(n, 1, inf, f)`, `series(n, f)`, `D(f, t)`, `at(f, x, value)`, `a[n]`; `i` is the imaginary
//! unit, `pi` the number, and `inf` a limit of integrals and sums.

use super::expr::{Bound, EACH, Equation, Expr, Func, RESERVED};
use super::{Symbol, SymbolicError};

/// Reads an expression.
///
/// # Errors
/// [`SymbolicError::Parse`] with the place and what was expected.
pub fn parse(text: &str) -> Result<Expr, SymbolicError> {
    let mut p = Parser::new(text);
    let e = p.sum()?;
    p.end()?;
    Ok(e)
}

/// Reads `left = right`.
///
/// # Errors
/// As [`parse()`].
pub fn parse_equation(text: &str) -> Result<Equation, SymbolicError> {
    let mut p = Parser::new(text);
    let left = p.sum()?;
    p.expect('=')?;
    let right = p.sum()?;
    p.end()?;
    Ok(Equation { left, right })
}

struct Parser {
    text: Vec<char>,
    at: usize,
    depth: usize,
}

/// Brackets within brackets and quotients of quotients; keeps every recursion over the tree short.
const DEEPEST: usize = 100;

impl Parser {
    fn new(text: &str) -> Parser {
        Parser {
            text: text.chars().collect(),
            at: 0,
            depth: 0,
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

    fn power(&mut self) -> Result<Expr, SymbolicError> {
        let base = self.atom()?;
        if !self.taken('^') {
            return Ok(base);
        }
        let bracket = self.taken('(');
        let sign = if bracket && self.taken('-') { -1 } else { 1 };
        self.peek();
        let Ok(k) = self.run(char::is_ascii_digit).parse::<i32>() else {
            return self.failed("expected an integer exponent");
        };
        if k > 1000 {
            return self.failed("an exponent above 1000");
        }
        if bracket {
            self.expect(')')?;
        }
        Ok(Expr::Pow(Box::new(base), sign * k))
    }

    fn name(&mut self) -> Result<String, SymbolicError> {
        if !self.peek().is_some_and(|c| c.is_ascii_alphabetic()) {
            return self.failed("expected a name");
        }
        let name = self.run(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '\''));
        Symbol::named(&name)?;
        Ok(name)
    }

    /// The name of a variable.
    fn variable(&mut self) -> Result<String, SymbolicError> {
        let name = self.name()?;
        match RESERVED.contains(&name.as_str()) {
            true => Err(SymbolicError::Reserved(name)),
            false => Ok(name),
        }
    }

    fn atom(&mut self) -> Result<Expr, SymbolicError> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                let inner = self.sum()?;
                self.expect(')')?;
                Ok(inner)
            }
            Some(c) if c.is_ascii_digit() => {
                let digits = self.run(|c| c.is_ascii_digit() || *c == '.');
                if digits.matches('.').count() > 1 || digits.ends_with('.') {
                    return self.failed("expected a decimal number");
                }
                Ok(Expr::Num(digits))
            }
            Some(c) if c.is_ascii_alphabetic() => {
                let name = self.name()?;
                self.named(name)
            }
            Some(c) => self.failed(format!("unexpected {c:?}")),
            None => self.failed("expected an expression"),
        }
    }

    /// An argument that is not the first.
    fn next(&mut self) -> Result<Expr, SymbolicError> {
        self.expect(',')?;
        self.sum()
    }

    fn named(&mut self, name: String) -> Result<Expr, SymbolicError> {
        if let Some((f, _)) = Func::ALL.iter().find(|f| f.1 == name) {
            self.expect('(')?;
            let x = self.sum()?;
            self.expect(')')?;
            return Ok(Expr::Call(*f, Box::new(x)));
        }
        match name.as_str() {
            "i" => Ok(Expr::I),
            "int" | "sum" => {
                self.expect('(')?;
                let var = self.variable()?;
                let [from, to, body] = [self.next()?, self.next()?, self.next()?];
                self.expect(')')?;
                let bound = Box::new(Bound {
                    var,
                    from,
                    to,
                    body,
                });
                Ok(match name.as_str() {
                    "int" => Expr::Int(bound),
                    _ => Expr::Sum(bound),
                })
            }
            "series" => {
                self.expect('(')?;
                let var = self.variable()?;
                let body = self.next()?;
                self.expect(')')?;
                Ok(Expr::Sum(Box::new(Bound {
                    var,
                    from: Expr::Num("1".into()),
                    to: Expr::Sym(EACH.into()),
                    body,
                })))
            }
            "D" if self.taken('(') => {
                let x = self.sum()?;
                self.expect(',')?;
                let by = self.variable()?;
                self.expect(')')?;
                Ok(Expr::Diff(Box::new(x), by))
            }
            "at" => {
                self.expect('(')?;
                let x = self.sum()?;
                self.expect(',')?;
                let symbol = self.variable()?;
                let value = self.next()?;
                self.expect(')')?;
                Ok(Expr::At(Box::new(x), symbol, Box::new(value)))
            }
            _ if self.taken('[') => {
                let index = self.sum()?;
                self.expect(']')?;
                Ok(Expr::Index(name, Box::new(index)))
            }
            _ => Ok(Expr::Sym(name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_comes_back() {
        for text in [
            "a + b*c - d/e^2",
            "-(a - b)*c",
            "2*i/sqrt(pi)*int(z, 0, z, exp(z^2))",
            "a/(b*c)",
            "a*(b/c)",
            "a - (b - c)",
            "sum(n, 1, inf, a[n]*cos(n*x))",
            "c*series(n, D[n]*x)",
            "at(D(psi, t), t, 0)^2",
            "x^(-2)*0.94",
            "a + (-b)*c",
        ] {
            let once = parse(text).unwrap();
            assert_eq!(
                parse(&once.to_string()).unwrap(),
                once,
                "{text} gave {once}"
            );
        }
        assert_eq!(parse("a*b/c*d").unwrap().to_string(), "a*b/c*d");
    }

    #[test]
    fn faults_are_named() {
        for (text, reason) in [
            ("", "expected an expression"),
            ("a +", "expected an expression"),
            ("(a", "expected ')'"),
            ("a b", "unexpected 'b'"),
            ("x^y", "expected an integer exponent"),
            ("x^9999", "an exponent above 1000"),
            ("1.2.3", "expected a decimal number"),
            ("exp", "expected '('"),
            ("int(x, 0, 1)", "expected ','"),
            ("ω", "unexpected 'ω'"),
        ] {
            match parse(text) {
                Err(SymbolicError::Parse { reason: r, .. }) => assert_eq!(r, reason, "{text}"),
                other => panic!("{text}: {other:?}"),
            }
        }
        assert!(parse(&"(".repeat(5000)).is_err());
        // A quotient of quotients is as deep as it is long; dropping it must not need a deep stack.
        assert!(parse(&format!("a{}", "/a".repeat(90))).is_ok());
        assert!(parse(&format!("a{}", "/a".repeat(300_000))).is_err());
        assert!(matches!(
            parse("a_name_that_is_too_long"),
            Err(SymbolicError::Name(_))
        ));
        assert!(parse_equation("a = b = c").is_err() && parse_equation("a").is_err());
    }
}
