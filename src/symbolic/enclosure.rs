//! Expressions in balls, straight from the data and without the algebra; normal forms in balls.

use super::complex;
use super::error::unsupported;
use super::evaluation::{Balls, Evaluator, Stop, Value};
use super::exact::Exact;
use super::expr::Expr;
use super::graph::{Graph, Id, Node};
use super::series;
use super::walk::Definitions;
use super::work::{LIMIT, limited, step};
use super::{Algebra, ExpSum, Fraction, Poly, Symbol, SymbolicError};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::{Ball, ComplexBall};
use rug::Rational;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Working precision of enclosures.
pub const BITS: u32 = 128;

/// Rational values of the symbols.
///
/// A name without a value is an error, except at a sample: there it has a value between 1/2 and 3/2
/// that depends on the name, so that distinct symbols have distinct values. What holds at a sample
/// is shown for that point alone; samples serve to refute.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// The named values.
    pub named: BTreeMap<String, Rational>,
    /// The number of the sample, which changes the values that are not named; `None` if every name
    /// has to have a value.
    pub sample: Option<u32>,
}

impl Point {
    /// Returns the sample of that number, without named values.
    pub fn sample(number: u32) -> Point {
        Point {
            named: BTreeMap::new(),
            sample: Some(number),
        }
    }

    /// Returns the value of a symbol.
    ///
    /// # Errors
    /// [`SymbolicError::NoValue`] if it has none.
    pub fn value(&self, name: &str) -> Result<Rational, SymbolicError> {
        if let Some(q) = self.named.get(name) {
            return Ok(q.clone());
        }
        let turn = self
            .sample
            .ok_or_else(|| SymbolicError::NoValue(name.into()))?;
        // The index of a series is an integer; without the sum, what stands beside it is seen.
        if name == Symbol::INDEX.name() {
            return Ok(Rational::from(turn + 1));
        }
        if name == Symbol::SERIES.name() {
            return Ok(Rational::from((turn + 1) % 2));
        }
        // FNV-1a, reduced to a fraction with a small denominator.
        let start = 0xcbf2_9ce4_8422_2325 ^ u64::from(turn);
        let hash = name.bytes().fold(start, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
        });
        let below = 89 + (hash >> 40) % 30;
        let above = below / 2 + (hash >> 8) % below;
        // The last samples are larger and smaller, for what holds between 1/2 and 3/2 alone.
        let scale = match turn {
            4 => Rational::from(5),
            5 => Rational::from((1, 5)),
            _ => Rational::from(1),
        };
        Ok(Rational::from((above, below)) * scale)
    }
}

/// Nodes of a graph after which another is begun: some costs of a binder grow with all nodes.
const NODES: usize = 700;

/// Bits to which integrals are enclosed.
const GOAL: u32 = 40;

/// Evaluations of an integrand before an integral is given up: searches try thousands of formulas.
const EVALUATIONS: u64 = 1 << 12;

/// Precisions that are tried in turn where one is too low to tell that an operation is defined.
const HIGHER: [u32; 2] = [4 * BITS, 16 * BITS];

/// Evaluates in balls at a point. Values of what several expressions have in common are kept.
pub struct Enclosures {
    point: Point,
    /// Names whose definitions differ from one expression to the next.
    changing: Vec<String>,
    /// Nodes of the definitions that do not depend on them.
    known: HashMap<String, Id>,
    /// For each definition met, whether it depends on them.
    depends: HashMap<String, bool>,
    evaluator: Evaluator<Balls>,
}

impl Enclosures {
    /// Creates an evaluator at a point.
    pub fn new(point: &Point) -> Enclosures {
        Enclosures::of_changing(point, &[])
    }

    /// Creates an evaluator at a point for expressions whose definitions of these names differ.
    pub fn of_changing(point: &Point, changing: &[&str]) -> Enclosures {
        Enclosures {
            point: point.clone(),
            changing: changing.iter().map(|name| name.to_string()).collect(),
            known: HashMap::new(),
            depends: HashMap::new(),
            evaluator: evaluator(Arc::new(Graph::new([]).of_any_names()), BITS),
        }
    }

    /// Returns an enclosure of the value.
    ///
    /// # Errors
    /// A name without a value, an operation that is not defined or may not be, and what has no
    /// meaning in balls.
    pub fn value(
        &mut self,
        definitions: &Definitions,
        e: &Expr,
    ) -> Result<ComplexBall, SymbolicError> {
        limited(LIMIT, || {
            series::check(definitions, e)?;
            // Derivations say what a derivative is; the graph has none.
            if has_derivative(definitions, e) {
                return unsupported("a derivative in balls");
            }
            let node = self.node(definitions, e)?;
            let mut found = complex_value(&mut self.evaluator, node);
            for bits in HIGHER {
                // More bits do not help an integral that takes too many evaluations.
                let is_open = |stop: &Stop| {
                    matches!(stop.reason, NoValue::Undecided(_))
                        && !matches!(self.evaluator.graph().node(stop.node), Node::Bound(_))
                };
                if !found.as_ref().is_err_and(is_open) {
                    break;
                }
                let mut higher = evaluator(self.evaluator.graph().clone(), bits);
                for k in 0..higher.graph().inputs().len() {
                    if let Ok(value) = self.input(k, bits) {
                        higher.set_input(k, value);
                    }
                }
                found = complex_value(&mut higher, node);
            }
            found.map_err(|stop| self.error(stop))
        })
    }

    /// The node of an expression; the symbols in it have their values.
    fn node(&mut self, definitions: &Definitions, e: &Expr) -> Result<Id, SymbolicError> {
        if self.evaluator.graph().len() > NODES {
            self.known.clear();
            self.evaluator = evaluator(Arc::new(Graph::new([]).of_any_names()), BITS);
        }
        let first = self.evaluator.graph().inputs().len();
        let known = &mut self.known;
        let node = self
            .evaluator
            .extend(|graph| graph.build_keeping(definitions, e, known));
        let changing: Vec<&str> = self.changing.iter().map(String::as_str).collect();
        let depends = &mut self.depends;
        known.retain(|name, _| {
            let of_name = || definitions.reaches(&Expr::Sym(name.clone()), &changing);
            !*depends.entry(name.clone()).or_insert_with(of_name)
        });
        for k in first..self.evaluator.graph().inputs().len() {
            // A symbol without a value is an error where it is needed.
            if let Ok(value) = self.input(k, BITS) {
                self.evaluator.set_input(k, value);
            }
        }
        node
    }

    /// The value of an input.
    fn input(&self, k: usize, bits: u32) -> Result<Value, SymbolicError> {
        let value = self.point.value(&self.evaluator.graph().inputs()[k])?;
        Ok(Value::rational(bits, value))
    }

    /// The reason why a node has no value.
    fn error(&self, stop: Stop) -> SymbolicError {
        let graph = self.evaluator.graph();
        let text = graph.text(stop.node);
        match graph.node(stop.node) {
            Node::Input(k) => SymbolicError::NoValue(graph.inputs()[k as usize].clone()),
            Node::Div(_, divisor) => SymbolicError::NotInvertible(graph.text(divisor)),
            // The normal form may know the integral.
            Node::Bound(_) => SymbolicError::Unsupported(format!("{text} in balls")),
            _ => SymbolicError::Wide(text),
        }
    }
}

fn evaluator(graph: Arc<Graph>, bits: u32) -> Evaluator<Balls> {
    let mut balls = Balls::new(bits);
    // Rational numbers that grow long are slow: they serve where balls have not decided.
    balls.exact = bits > BITS;
    balls.has_complex_roots = true;
    balls.goal = GOAL;
    balls.places = GOAL + 32;
    balls.evaluations = EVALUATIONS;
    Evaluator::new(graph, balls)
}

/// The value of a node as a complex number.
fn complex_value(evaluator: &mut Evaluator<Balls>, node: Id) -> Result<ComplexBall, Stop> {
    evaluator.begin();
    let value = evaluator.value(node)?.to_complex();
    let reason = NoValue::Undefined("a value beyond every exponent");
    value.ok_or(Stop { node, reason })
}

/// Returns true if a derivative occurs, definitions followed.
pub fn has_derivative(definitions: &Definitions, e: &Expr) -> bool {
    definitions.any(e, |e| matches!(e, Expr::Diff(..)))
}

/// Returns true if the normal form of an expression shows that its value is real.
pub fn is_real(definitions: &Definitions, e: &Expr) -> bool {
    let mut exact = Exact::default();
    let form = exact.value(definitions, e);
    form.is_ok_and(|form| exact.algebra.is_real(&form))
}

/// An enclosure of an expression: straight from the data, or through the normal form where there is
/// a derivative.
///
/// # Errors
/// As [`Enclosures::value`] or [`Exact::value`].
pub fn enclose(
    definitions: &Definitions,
    e: &Expr,
    point: &Point,
) -> Result<ComplexBall, SymbolicError> {
    if has_derivative(definitions, e) {
        let mut exact = Exact::default();
        let form = exact.value(definitions, e)?;
        return enclose_form(&exact.algebra, &form, point);
    }
    Enclosures::new(point).value(definitions, e)
}

/// An enclosure of a normal form.
///
/// # Errors
/// As [`Enclosures::value`].
pub fn enclose_form(
    algebra: &Algebra,
    form: &ExpSum,
    point: &Point,
) -> Result<ComplexBall, SymbolicError> {
    limited(LIMIT, || Values::new(algebra, point, BITS).form(form))
}

/// Samples at which a function is looked at to see that it is not zero.
const SAMPLES: u32 = 3;

fn excludes_zero(z: &ComplexBall) -> bool {
    !z.re.contains_zero() || !z.im.contains_zero()
}

/// Returns true if an enclosure at a sample point excludes zero.
pub(super) fn is_somewhere_not_zero(algebra: &Algebra, f: &Fraction) -> bool {
    (0..SAMPLES).any(|turn| {
        let value = enclose_fraction(algebra, f, &Point::sample(turn), BITS);
        value.is_ok_and(|z| excludes_zero(&z))
    })
}

/// As [`is_somewhere_not_zero`], for a sum of exponentials.
pub(super) fn is_form_somewhere_not_zero(algebra: &Algebra, form: &ExpSum) -> bool {
    (0..SAMPLES).any(|turn| {
        let value = enclose_form(algebra, form, &Point::sample(turn));
        value.is_ok_and(|z| excludes_zero(&z))
    })
}

/// An enclosure of an element of the field, at a working precision.
pub(super) fn enclose_fraction(
    algebra: &Algebra,
    f: &Fraction,
    point: &Point,
    bits: u32,
) -> Result<ComplexBall, SymbolicError> {
    Values::new(algebra, point, bits).fraction(f)
}

/// Enclosures of normal forms at a point; those of symbols are kept.
pub(super) struct Values<'a> {
    algebra: &'a Algebra,
    point: &'a Point,
    /// The working precision.
    pub bits: u32,
    known: BTreeMap<Symbol, ComplexBall>,
}

impl<'a> Values<'a> {
    fn new(algebra: &'a Algebra, point: &'a Point, bits: u32) -> Values<'a> {
        Values {
            algebra,
            point,
            bits,
            known: BTreeMap::new(),
        }
    }

    /// The value of a sum of exponentials.
    pub(super) fn form(&mut self, form: &ExpSum) -> Result<ComplexBall, SymbolicError> {
        let mut sum = ComplexBall::zero(self.bits);
        for (p, c) in form.terms() {
            let p = self.fraction(p)?;
            let c = self.fraction(c)?;
            sum = &sum + &(&c * &p.exp());
        }
        Ok(sum)
    }

    /// The value of a fraction.
    pub(super) fn fraction(&mut self, f: &Fraction) -> Result<ComplexBall, SymbolicError> {
        let num = self.poly(f.num())?;
        if f.den().is_one() {
            return Ok(num);
        }
        let den = self.poly(f.den())?;
        complex::quotient(&num, &den)
            .ok_or_else(|| SymbolicError::NotInvertible(f.den().to_string()))
    }

    fn poly(&mut self, p: &Poly) -> Result<ComplexBall, SymbolicError> {
        let mut sum = ComplexBall::zero(self.bits);
        for (m, c) in p.terms() {
            let mut product = ComplexBall::rational(self.bits, &c.re, &c.im);
            for (x, k) in m {
                let value = self.symbol(*x)?;
                for _ in 0..*k {
                    step(2)?;
                    product = &product * &value;
                }
            }
            sum = &sum + &product;
        }
        Ok(sum)
    }

    fn symbol(&mut self, x: Symbol) -> Result<ComplexBall, SymbolicError> {
        if let Some(value) = self.known.get(&x) {
            return Ok(value.clone());
        }
        let algebra = self.algebra;
        let roots = algebra.roots().iter();
        let integrals = algebra.antiderivatives().iter();
        let kernels = algebra.kernels().iter();
        let value = if let Some((_, p)) = roots.clone().find(|(s, _)| *s == x) {
            complex::sqrt(&self.poly(p)?)?
        } else if let Some((_, z)) = integrals.clone().find(|(g, _)| *g == x) {
            complex::antiderivative(&self.fraction(z)?)?
        } else if let Some((_, kernel)) = kernels.clone().find(|(k, _)| *k == x) {
            kernel.enclose(self)?
        } else {
            let re = match x == Symbol::PI {
                true => Ball::pi(self.bits),
                false => Ball::rational(self.bits, &self.point.value(&x.name())?),
            };
            ComplexBall::new(re, Ball::integer(self.bits, 0))
        };
        self.known.insert(x, value.clone());
        Ok(value)
    }
}

#[cfg(test)]
mod tests;
