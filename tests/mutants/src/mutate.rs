//! The mutants of a source file: places, and what stands there instead.

use proc_macro2::{LineColumn, Span};
use std::collections::BTreeMap;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{
    Attribute, BinOp, Block, Expr, ExprMethodCall, ImplItemFn, ItemConst, ItemFn, ItemMod,
    ItemStatic, Lit, ReturnType, Signature, Stmt, TraitItemFn, UnOp,
};

/// The kind of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An expression, replaced by another.
    Expression,
    /// A statement, left out.
    Statement,
    /// The beginning of a function's body, which returns at once.
    Entry,
}

/// A place in a file with everything that may stand there instead.
#[derive(Clone, Debug)]
pub struct Place {
    pub kind: Kind,
    pub bytes: Range<usize>,
    pub line: usize,
    pub column: usize,
    /// The function it lies in.
    pub function: String,
    /// The text that replaces it; nothing for a statement left out.
    pub instead: Vec<String>,
}

/// The places of a file, by where they begin, the outer before the inner.
pub fn places(source: &str) -> syn::Result<Vec<Place>> {
    let file = syn::parse_file(source)?;
    let mut lines = vec![0];
    lines.extend(source.match_indices('\n').map(|(i, _)| i + 1));
    let mut finder = Finder {
        source,
        lines,
        functions: Vec::new(),
        found: BTreeMap::new(),
    };
    finder.visit_file(&file);
    let mut places: Vec<Place> = finder.found.into_values().collect();
    places.sort_by_key(|p| (p.bytes.start, usize::MAX - p.bytes.end));
    Ok(places)
}

/// Methods of numbers, bounds and enclosures that are easily taken for one another.
const TWINS: [(&str, &str); 15] = [
    ("all", "any"),
    ("ceil", "floor"),
    ("ceil_mut", "floor_mut"),
    ("cos", "sin"),
    ("first", "last"),
    ("is_negative", "is_positive"),
    ("is_none", "is_some"),
    ("lower", "upper"),
    ("magnitude", "mignitude"),
    ("max", "min"),
    ("mid", "rad"),
    ("mul", "div"),
    ("add", "sub_below"),
    ("contains", "overlaps"),
    ("contains_ball", "overlaps"),
];

/// Methods whose argument may be forgotten: the receiver alone stands instead.
const DROPPED: [&str; 10] = [
    "add", "at_least", "at_most", "filter", "max", "min", "mul", "shift", "union", "widened",
];

/// Last parts of paths that are easily taken for one another.
const PATHS: [(&str, &str); 3] = [("above", "below"), ("Up", "Down"), ("Less", "Greater")];

struct Finder<'a> {
    source: &'a str,
    lines: Vec<usize>,
    functions: Vec<String>,
    found: BTreeMap<(usize, usize, bool), Place>,
}

impl Finder<'_> {
    fn offset(&self, at: LineColumn) -> usize {
        // Columns are counted in characters.
        let line = &self.source[self.lines[at.line - 1]..];
        let within: usize = line.chars().take(at.column).map(char::len_utf8).sum();
        self.lines[at.line - 1] + within
    }

    fn bytes(&self, span: Span) -> Range<usize> {
        self.offset(span.start())..self.offset(span.end())
    }

    fn text(&self, part: &impl Spanned) -> String {
        self.source[self.bytes(part.span())].to_owned()
    }

    fn add(&mut self, kind: Kind, span: Span, bytes: Range<usize>, instead: Vec<String>) {
        if instead.is_empty() && kind != Kind::Statement {
            return;
        }
        let key = (bytes.start, bytes.end, kind == Kind::Statement);
        let start = span.start();
        let function = self.functions.join("::");
        let place = self.found.entry(key).or_insert_with(|| Place {
            kind,
            bytes,
            line: start.line,
            column: start.column + 1,
            function,
            instead: Vec::new(),
        });
        for text in instead {
            if !place.instead.contains(&text) {
                place.instead.push(text);
            }
        }
    }

    fn expression(&mut self, e: &Expr, instead: Vec<String>) {
        let bytes = self.bytes(e.span());
        self.add(Kind::Expression, e.span(), bytes, instead);
    }

    fn condition(&mut self, e: &Expr) {
        if !has_let(e) {
            self.expression(e, vec!["true".into(), "false".into()]);
        }
    }

    fn function(&mut self, signature: &Signature, block: &Block) {
        let values = match &signature.output {
            ReturnType::Default => return,
            ReturnType::Type(_, t) => returned(&self.text(t)),
        };
        let open = self.offset(block.brace_token.span.open().end());
        let instead = values.iter().map(|v| format!("return {v};")).collect();
        self.add(Kind::Entry, signature.ident.span(), open..open, instead);
    }

    fn method_call(&mut self, call: &ExprMethodCall) -> Vec<String> {
        let method = call.method.to_string();
        let receiver = self.text(&call.receiver);
        let from = self.offset(call.method.span().end());
        let rest = &self.source[from..self.bytes(call.span()).end];
        let mut instead = Vec::new();
        for (a, b) in TWINS {
            for (this, other) in [(a, b), (b, a)] {
                if method == this {
                    instead.push(format!("{receiver}.{other}{rest}"));
                }
            }
        }
        if DROPPED.contains(&method.as_str()) {
            instead.push(receiver);
        }
        instead
    }
}

/// Returns true if a condition binds variables.
fn has_let(e: &Expr) -> bool {
    match e {
        Expr::Let(_) => true,
        Expr::Binary(b) => has_let(&b.left) || has_let(&b.right),
        Expr::Paren(p) => has_let(&p.expr),
        _ => false,
    }
}

/// Returns the values that a function of that type may return at once.
fn returned(written: &str) -> Vec<&'static str> {
    let plain: String = written.split_whitespace().collect();
    match plain.as_str() {
        "bool" => vec!["true", "false"],
        "Mag" => vec!["Mag::ZERO"],
        "f64" => vec!["0.0", "1.0"],
        "String" => vec!["String::new()"],
        "i32" | "i64" | "u32" | "u64" | "usize" => vec!["0", "1"],
        t if t.starts_with("Option<bool>") => vec!["None", "Some(true)", "Some(false)"],
        t if t.starts_with("Option<Ordering>") => {
            vec!["None", "Some(Ordering::Less)", "Some(Ordering::Greater)"]
        }
        t if t.starts_with("Option<") => vec!["None"],
        t if t.starts_with("Vec<") => vec!["Vec::new()"],
        t if t.starts_with("Result<()") => vec!["Ok(())"],
        t if t.starts_with("Result<bool") => vec!["Ok(true)", "Ok(false)"],
        _ => Vec::new(),
    }
}

/// Operators that stand instead of one.
fn other_operators(op: &BinOp) -> &'static [&'static str] {
    match op {
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) => &["+", "*"],
        BinOp::Mul(_) => &["/", "+"],
        BinOp::Div(_) => &["*"],
        BinOp::Rem(_) => &["/"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::BitAnd(_) => &["|"],
        BinOp::BitOr(_) => &["&"],
        BinOp::BitXor(_) => &["|"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &["<=", ">"],
        BinOp::Le(_) => &["<", ">"],
        BinOp::Gt(_) => &[">=", "<"],
        BinOp::Ge(_) => &[">", "<"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) => &["+="],
        BinOp::MulAssign(_) => &["/=", "+="],
        BinOp::DivAssign(_) => &["*="],
        _ => &[],
    }
}

fn test_only(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| {
        a.path().is_ident("test")
            || a.path().is_ident("cfg")
                && a.parse_args::<proc_macro2::TokenStream>()
                    .is_ok_and(|t| t.to_string().contains("test"))
    })
}

impl<'ast> Visit<'ast> for Finder<'_> {
    // A constant evaluated by the compiler cannot be switched at run time.
    fn visit_item_const(&mut self, _: &'ast ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_angle_bracketed_generic_arguments(
        &mut self,
        _: &'ast syn::AngleBracketedGenericArguments,
    ) {
    }

    fn visit_item_mod(&mut self, m: &'ast ItemMod) {
        if !test_only(&m.attrs) {
            visit::visit_item_mod(self, m);
        }
    }

    fn visit_item_fn(&mut self, f: &'ast ItemFn) {
        if test_only(&f.attrs) || f.sig.constness.is_some() {
            return;
        }
        self.functions.push(f.sig.ident.to_string());
        self.function(&f.sig, &f.block);
        visit::visit_block(self, &f.block);
        self.functions.pop();
    }

    fn visit_item_impl(&mut self, i: &'ast syn::ItemImpl) {
        if !test_only(&i.attrs) {
            let name = self.text(&*i.self_ty);
            self.functions.push(name);
            visit::visit_item_impl(self, i);
            self.functions.pop();
        }
    }

    fn visit_impl_item_fn(&mut self, f: &'ast ImplItemFn) {
        if test_only(&f.attrs) || f.sig.constness.is_some() {
            return;
        }
        self.functions.push(f.sig.ident.to_string());
        self.function(&f.sig, &f.block);
        visit::visit_block(self, &f.block);
        self.functions.pop();
    }

    fn visit_trait_item_fn(&mut self, f: &'ast TraitItemFn) {
        if let Some(block) = &f.default {
            self.functions.push(f.sig.ident.to_string());
            self.function(&f.sig, block);
            visit::visit_block(self, block);
            self.functions.pop();
        }
    }

    fn visit_stmt(&mut self, s: &'ast Stmt) {
        if let Stmt::Local(local) = s
            && test_only(&local.attrs)
        {
            return;
        }
        if let Stmt::Expr(e, Some(_)) = s {
            let assigns = match e {
                Expr::Binary(b) => {
                    other_operators(&b.op)
                        .iter()
                        .any(|o| o.ends_with('=') && o.len() == 2)
                        && !matches!(
                            b.op,
                            BinOp::Eq(_)
                                | BinOp::Ne(_)
                                | BinOp::Lt(_)
                                | BinOp::Le(_)
                                | BinOp::Gt(_)
                                | BinOp::Ge(_)
                        )
                }
                _ => false,
            };
            if assigns || matches!(e, Expr::Assign(_) | Expr::MethodCall(_) | Expr::Call(_)) {
                let bytes = self.bytes(s.span());
                self.add(Kind::Statement, s.span(), bytes, Vec::new());
            }
        }
        visit::visit_stmt(self, s);
    }

    fn visit_expr(&mut self, e: &'ast Expr) {
        match e {
            Expr::Binary(b) => {
                let (left, right) = (self.text(&*b.left), self.text(&*b.right));
                let instead = other_operators(&b.op)
                    .iter()
                    .map(|op| format!("{left} {op} {right}"))
                    .collect();
                self.expression(e, instead);
            }
            Expr::Unary(u) => {
                if matches!(u.op, UnOp::Neg(_) | UnOp::Not(_)) {
                    let operand = self.text(&*u.expr);
                    self.expression(e, vec![operand]);
                }
            }
            Expr::Lit(l) => {
                let instead = match &l.lit {
                    Lit::Int(i) => match i.base10_parse::<u128>() {
                        Ok(n) => {
                            let suffix = i.suffix();
                            let mut texts = vec![format!("{}{suffix}", n + 1)];
                            if n > 0 {
                                texts.push(format!("{}{suffix}", n - 1));
                            }
                            texts
                        }
                        Err(_) => Vec::new(),
                    },
                    Lit::Float(f) => match f.base10_parse::<f64>() {
                        Ok(0.0) => vec!["1.0".into()],
                        Ok(_) => vec![format!("({f} * 2.0)"), format!("({f} * 0.5)")],
                        Err(_) => Vec::new(),
                    },
                    Lit::Bool(b) => vec![(!b.value).to_string()],
                    _ => Vec::new(),
                };
                self.expression(e, instead);
            }
            Expr::MethodCall(call) => {
                let instead = self.method_call(call);
                self.expression(e, instead);
            }
            Expr::If(i) => self.condition(&i.cond),
            Expr::While(w) => self.condition(&w.cond),
            Expr::Path(p) => {
                if let Some(last) = p.path.segments.last() {
                    let bytes = self.bytes(last.ident.span());
                    let whole = self.bytes(e.span());
                    let mut instead = Vec::new();
                    for (a, b) in PATHS {
                        for (this, other) in [(a, b), (b, a)] {
                            if last.ident == this && p.path.segments.len() > 1 {
                                let before = &self.source[whole.start..bytes.start];
                                instead.push(format!("{before}{other}"));
                            }
                        }
                    }
                    self.expression(e, instead);
                }
                return;
            }
            Expr::Repeat(r) => {
                // Its length is a constant.
                self.visit_expr(&r.expr);
                return;
            }
            Expr::Match(m) => {
                self.visit_expr(&m.expr);
                for arm in &m.arms {
                    if let Some((_, guard)) = &arm.guard {
                        self.condition(guard);
                        self.visit_expr(guard);
                    }
                    self.visit_expr(&arm.body);
                }
                return;
            }
            _ => {}
        }
        visit::visit_expr(self, e);
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, places};

    #[test]
    fn operators_literals_conditions_and_entries() {
        let source = "fn f(a: f64, b: &[f64]) -> bool {\n    // μ\n    if a < 1.5 && b.len() > 2 { return true; }\n    a == -b[0]\n}\n";
        let found = places(source).unwrap();
        let at = |text: &str| {
            let place = found.iter().find(|p| &source[p.bytes.clone()] == text);
            place.unwrap_or_else(|| panic!("{text}")).instead.clone()
        };
        assert_eq!(at("a < 1.5"), ["a <= 1.5", "a > 1.5"]);
        assert_eq!(at("1.5"), ["(1.5 * 2.0)", "(1.5 * 0.5)"]);
        assert_eq!(
            at("a < 1.5 && b.len() > 2"),
            ["true", "false", "a < 1.5 || b.len() > 2"]
        );
        assert_eq!(at("-b[0]"), ["b[0]"]);
        let entry = found.iter().find(|p| p.kind == Kind::Entry).unwrap();
        assert_eq!(entry.instead, ["return true;", "return false;"]);
        assert_eq!(entry.function, "f");
    }

    #[test]
    fn tests_constants_patterns_and_types_are_left_alone() {
        let source = "const A: usize = 1 + 2;\n#[cfg(test)]\nmod t { fn f() -> bool { 1 < 2 } }\nfn g(x: [u8; 3]) { match x[0] { 7 => {} _ => {} } }\nconst fn h() -> i32 { 1 }\n";
        let found = places(source).unwrap();
        let texts: Vec<&str> = found.iter().map(|p| &source[p.bytes.clone()]).collect();
        assert_eq!(texts, ["0"]);
    }

    #[test]
    fn bounds_are_dropped_and_turned() {
        let source = "fn f(a: Mag, b: Mag) -> Mag { a.add(Mag::above(&b)).magnitude() }";
        let found = places(source).unwrap();
        let all: Vec<&str> = found
            .iter()
            .flat_map(|p| &p.instead)
            .map(String::as_str)
            .collect();
        assert!(all.contains(&"a") && all.contains(&"Mag::below"), "{all:?}");
        assert!(
            all.contains(&"a.add(Mag::above(&b)).mignitude()"),
            "{all:?}"
        );
    }
}
