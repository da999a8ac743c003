//! Texts of nodes, for messages.

use super::{Binding, Graph, Id, Node};
use crate::{Expr, Roots};

/// Characters after which a text is cut.
const LONGEST: usize = 60;

impl Graph {
    /// The text of a node; a long one is cut.
    pub fn text(&self, id: Id) -> String {
        let mut out = String::new();
        self.write(id, 0, &mut out);
        if out.chars().count() > LONGEST {
            let mut cut: String = out.chars().take(LONGEST - 3).collect();
            cut.push_str("...");
            return cut;
        }
        out
    }

    /// The expression of a node that depends on no bound variable and holds no binder, if it has at
    /// most that number of parts when it is written out; those are counted down.
    pub fn expression(&self, id: Id, parts: &mut u32) -> Option<Expr> {
        *parts = parts.checked_sub(1)?;
        let mut of = |id: Id| self.expression(id, parts);
        Some(match self.node(id) {
            Node::Number(place) => {
                let value = self.rational(place);
                let size = Expr::Num(value.clone().abs().to_string());
                match *value < 0 {
                    true => Expr::Neg(Box::new(size)),
                    false => size,
                }
            }
            Node::Constant(c) => Expr::Constant(c),
            Node::ImaginaryUnit => Expr::I,
            Node::Input(k) => Expr::Sym(self.inputs.get(k as usize)?.clone()),
            Node::Neg(a) => Expr::Neg(Box::new(of(a)?)),
            Node::Add(a, b) => Expr::Add(vec![of(a)?, of(b)?]),
            Node::Sub(a, b) => Expr::Add(vec![of(a)?, Expr::Neg(Box::new(of(b)?))]),
            Node::Mul(a, b) => Expr::Mul(vec![of(a)?, of(b)?]),
            Node::Div(a, b) => Expr::Div(Box::new(of(a)?), Box::new(of(b)?)),
            Node::Power(a, k) => Expr::Pow(Box::new(of(a)?), k),
            Node::Unary(f, a) => Expr::Call(f, vec![of(a)?]),
            Node::Binary(f, a, b) => Expr::Call(f, vec![of(a)?, of(b)?]),
            Node::Ternary(f, a, b, c) => Expr::Call(f, vec![of(a)?, of(b)?, of(c)?]),
            _ => return None,
        })
    }

    /// Writes a node that stands where `strength` binds: 0 conditions, 1 sums, 2 products, 3
    /// powers.
    fn write(&self, id: Id, strength: u8, out: &mut String) {
        if out.len() > 2 * LONGEST {
            return;
        }
        let node = self.node(id);
        let own = match node {
            Node::Compare(..) | Node::And(..) | Node::Or(..) | Node::Not(_) => 0,
            Node::Add(..) | Node::Sub(..) | Node::Neg(_) => 1,
            Node::Mul(..) | Node::Div(..) => 2,
            Node::Power(..) => 3,
            _ => 4,
        };
        let bracket = own < strength;
        if bracket {
            out.push('(');
        }
        let mut infix = |a: Id, sign: &str, b: Id, left: u8, right: u8| {
            self.write(a, left, out);
            out.push_str(sign);
            self.write(b, right, out);
        };
        match node {
            Node::Add(a, b) => infix(a, " + ", b, 1, 2),
            Node::Sub(a, b) => infix(a, " - ", b, 1, 2),
            Node::Mul(a, b) => infix(a, "*", b, 2, 3),
            Node::Div(a, b) => infix(a, "/", b, 2, 3),
            Node::Compare(relation, a, b) => infix(a, &format!(" {} ", relation.sign()), b, 1, 1),
            Node::And(a, b) => infix(a, " and ", b, 1, 1),
            Node::Or(a, b) => infix(a, " or ", b, 1, 1),
            Node::Not(a) => {
                out.push_str("not ");
                self.write(a, 1, out);
            }
            Node::Neg(a) => {
                out.push('-');
                self.write(a, 2, out);
            }
            Node::Power(a, k) => {
                self.write(a, 4, out);
                out.push_str(&format!("^{k}"));
            }
            Node::Number(place) => out.push_str(&self.number_text(place)),
            Node::Constant(c) => out.push_str(c.name()),
            Node::ImaginaryUnit => out.push('i'),
            Node::Infinity => out.push_str("inf"),
            Node::Input(k) => out.push_str(self.inputs.get(k as usize).map_or("?", String::as_str)),
            Node::Variable(binder, k) => {
                let names = &self.binder(binder).names;
                out.push_str(names.get(k as usize).map_or("?", String::as_str));
            }
            Node::Truth(t) => out.push_str(if t { "true" } else { "false" }),
            Node::Unary(f, a) => self.list(f.name(), &[a], out),
            Node::Binary(f, a, b) => self.list(f.name(), &[a, b], out),
            Node::Ternary(f, a, b, c) => self.list(f.name(), &[a, b, c], out),
            Node::If(a, b, c) => self.list("if", &[a, b, c], out),
            Node::Flat(f, a) => self.list(&format!("{}'", f.name()), &[a], out),
            Node::Last(binder, k) => {
                let names = &self.binder(binder).names;
                if matches!(self.binder(binder).binding, Binding::Loop { .. }) {
                    out.push_str("the last ");
                }
                out.push_str(names.get(k as usize).map_or("?", String::as_str));
            }
            Node::Bound(binder) => {
                let binder = self.binder(binder);
                let (name, parts) = match binder.binding {
                    Binding::Sum { from, to, body } => ("sum", [from, to, body]),
                    Binding::Integral { from, to, body } => ("int", [from, to, body]),
                    Binding::Root {
                        from,
                        to,
                        body,
                        which,
                        ..
                    } => {
                        let name = match which {
                            Roots::Number => "roots",
                            _ => "root",
                        };
                        (name, [from, to, body])
                    }
                    _ => return,
                };
                out.push_str(&format!("{name}({}", binder.names.join(", ")));
                for part in parts {
                    out.push_str(", ");
                    self.write(part, 0, out);
                }
                out.push(')');
            }
        }
        if bracket {
            out.push(')');
        }
    }

    fn list(&self, name: &str, arguments: &[Id], out: &mut String) {
        out.push_str(name);
        for (k, a) in arguments.iter().enumerate() {
            out.push_str(if k == 0 { "(" } else { ", " });
            self.write(*a, 0, out);
        }
        out.push(')');
    }

    /// An integer or a short fraction as it is, another number as the double next to it.
    fn number_text(&self, place: u32) -> String {
        let exact = self.rational(place).to_string();
        match exact.len() <= 12 {
            true => exact,
            false => format!("{:?}", self.rational(place).to_f64()),
        }
    }
}
