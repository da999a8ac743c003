//! Graphs in machine words: numbers in balls of 128 bits, a first pass, of which most values are
//! accurate enough; and holomorphic functions on rectangles of a complex variable, which are bounded.
//!
//! Values that these do not decide, undefined ones among them, are left to [`Balls`].

mod first_pass;
mod pointwise;

use super::ball::{Balls, Value, ball_of};
use super::{Evaluator, Interpretation, Stop};
use crate::graph::{Binding, Graph, Id, Node};
use crate::{Constant, Func, Relation};
pub(super) use first_pass::FirstPass;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::elementary::complex::Rectangle;
use mechaudit_reference::elementary::words;
use mechaudit_reference::{Ball128, Complex128};
pub(super) use pointwise::Pointwise;
use rug::Rational;
use std::cmp::Ordering;

/// A value in machine words.
#[derive(Clone, Copy)]
enum Words {
    Real(Ball128),
    Complex(Complex128),
    /// As [`Value::Continued`].
    Continued(Rectangle),
    /// A holomorphic function whose values are complex on the real line, too.
    Wide(Rectangle),
}

impl Words {
    fn real(&self) -> Option<&Ball128> {
        match self {
            Words::Real(x) => Some(x),
            Words::Complex(z) if z.im.is_zero() => Some(&z.re),
            _ => None,
        }
    }

    fn complex(&self) -> Option<Complex128> {
        match self {
            Words::Real(x) => Some(Complex128::real(*x)),
            Words::Complex(z) => Some(*z),
            _ => None,
        }
    }

    fn rectangle(&self) -> Option<Rectangle> {
        match self {
            Words::Real(x) => Rectangle::real(x.doubles()?),
            Words::Complex(z) => Rectangle::complex(z.re.doubles()?, z.im.doubles()?),
            Words::Continued(z) | Words::Wide(z) => Some(*z),
        }
    }

    /// Returns true if it is complex on the real line.
    fn is_complex(&self) -> bool {
        matches!(self, Words::Complex(_) | Words::Wide(_))
    }

    /// The same in the balls that functions take.
    fn to_value(self) -> Option<Value> {
        Some(match self {
            Words::Real(x) => Value::Real(x.to_ball()?),
            Words::Complex(z) => Value::Complex(z.to_ball()?),
            Words::Continued(z) => Value::Continued(z.to_ball()?),
            Words::Wide(z) => Value::Complex(z.to_ball()?),
        })
    }
}

/// The interpretation in machine words.
struct Short {
    /// MPFR, for the functions: its precision is theirs.
    balls: Balls,
    /// True if a function of MPFR was called: more bits of it may help.
    has_called: bool,
    /// True if MPFR evaluated it.
    has_left: bool,
    /// The node whose operation is next.
    current: Id,
    choosing: Choosing,
    /// The choices that were kept, by nodes.
    choices: Vec<Option<Chosen>>,
}

/// Treatment of functions that are holomorphic but for a choice: absolute values, extrema, steps and
/// comparisons.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Choosing {
    /// By the operands.
    Freely,
    /// By the operands, where the choice is the same for all numbers around them.
    Settled,
    /// Likewise, and the choice is kept.
    Kept,
    /// As it was kept.
    Held,
}

/// A choice that was made.
#[derive(Clone, Copy)]
enum Choice {
    /// The order of the operands, or the sign of the one.
    Order(Ordering),
    /// The integer of a step.
    Step(i64),
}

/// A choice, and the number that made it: it changes where that number passes zero, or one of the
/// integers from its own to the next.
#[derive(Clone, Copy)]
struct Chosen {
    choice: Choice,
    by: Ball128,
}

impl Chosen {
    fn order(by: Ball128) -> Option<Chosen> {
        let choice = Choice::Order(by.sign()?);
        Some(Chosen { choice, by })
    }

    fn step(by: Ball128, n: i64) -> Chosen {
        let choice = Choice::Step(n);
        Chosen { choice, by }
    }
}

/// The answer where they do not decide.
const LEFT: NoValue = NoValue::Undecided("left to balls of more bits");

type Found = Result<Words, NoValue>;

fn decided(found: Option<Ball128>) -> Found {
    found.map(Words::Real).ok_or(LEFT)
}

fn bound(is_complex: bool, found: Option<Rectangle>) -> Found {
    let kind = match is_complex {
        true => Words::Wide,
        false => Words::Continued,
    };
    found.map(kind).ok_or(LEFT)
}

/// An operation on two numbers, of which one may be complex or continued.
fn pair(
    a: &Words,
    b: &Words,
    real: fn(&Ball128, &Ball128) -> Option<Ball128>,
    complex: fn(&Complex128, &Complex128) -> Option<Complex128>,
    other: fn(&Rectangle, &Rectangle) -> Option<Rectangle>,
) -> Found {
    if let (Words::Real(a), Words::Real(b)) = (a, b) {
        return decided(real(a, b));
    }
    if let Some((a, b)) = a.complex().zip(b.complex()) {
        return complex(&a, &b).map(Words::Complex).ok_or(LEFT);
    }
    let both = a.rectangle().zip(b.rectangle());
    let found = both.and_then(|(a, b)| other(&a, &b));
    bound(a.is_complex() || b.is_complex(), found)
}

impl Short {
    /// Returns true if a graph has values in these balls: integrals, roots and systems have none.
    fn takes(graph: &Graph) -> bool {
        (0..graph.len() as u32).all(|id| match graph.node(id) {
            Node::Bound(binder) | Node::Last(binder, _) => match graph.binder(binder).binding {
                Binding::Sum { to, .. } => graph.node(to) != Node::Infinity,
                Binding::Loop { .. } => true,
                _ => false,
            },
            Node::ImaginaryUnit => false,
            _ => true,
        })
    }

    /// Returns true if each node has one value.
    fn is_straight(graph: &Graph) -> bool {
        let is_bound = |id| matches!(graph.node(id), Node::Bound(_) | Node::Last(..));
        !(0..graph.len() as u32).any(is_bound)
    }

    fn new(bits: u32) -> Short {
        Short {
            balls: Balls::new(bits),
            has_called: false,
            has_left: false,
            current: 0,
            choosing: Choosing::Freely,
            choices: Vec::new(),
        }
    }

    /// The choice at the current node, which the operands make unless one is held.
    fn choice(&mut self, of_operands: impl FnOnce() -> Option<Chosen>) -> Option<Choice> {
        let place = self.current as usize;
        if self.choosing == Choosing::Held {
            return self.choices.get(place)?.map(|chosen| chosen.choice);
        }
        let chosen = of_operands()?;
        match self.choosing {
            Choosing::Freely | Choosing::Held => {}
            // Beside equal numbers are others.
            _ if matches!(chosen.choice, Choice::Order(Ordering::Equal)) => return None,
            Choosing::Settled => {}
            Choosing::Kept => {
                if self.choices.len() <= place {
                    self.choices.resize(place + 1, None);
                }
                self.choices[place] = Some(chosen);
            }
        }
        Some(chosen.choice)
    }

    /// A value of the functions in MPFR: a bound where these have to be holomorphic.
    fn short(&self, value: &Value) -> Found {
        match value {
            Value::Real(x) => decided(Ball128::of_ball(x)),
            Value::Continued(z) => bound(false, Rectangle::of_ball(z)),
            Value::Complex(z) if self.balls.holomorphic => bound(true, Rectangle::of_ball(z)),
            Value::Complex(z) => Complex128::of_ball(z).map(Words::Complex).ok_or(LEFT),
            _ => Err(LEFT),
        }
    }

    /// A rational number.
    fn rational(&self, q: &Rational) -> Option<Ball128> {
        Ball128::dyadic(q).or_else(|| Ball128::of_ball(&ball_of(128, q)))
    }
}

/// A function of real numbers that takes no more than arithmetic; none for others.
fn arithmetic(f: Func, x: &[&Ball128]) -> Option<Option<Ball128>> {
    Some(match (f, x) {
        (Func::Sqrt, [x]) => x.sqrt(),
        (Func::Fma, [x, y, z]) => x.mul(y).and_then(|product| product.add(z)),
        _ => return None,
    })
}

/// Returns true for a function with a choice.
fn is_choice(f: Func) -> bool {
    use Func::{Abs, Ceil, Floor, Fmax, Fmin};
    matches!(f, Abs | Fmin | Fmax | Floor | Ceil)
}

/// The choice of a function at real numbers; none where it is not decided.
fn chosen(f: Func, x: &[&Words]) -> Option<Chosen> {
    match (f, x) {
        (Func::Abs, [Words::Real(x)]) => Chosen::order(*x),
        (Func::Fmin | Func::Fmax, [Words::Real(x), Words::Real(y)]) => Chosen::order(x.sub(y)?),
        (Func::Floor, [Words::Real(x)]) => Some(Chosen::step(*x, x.floor()?)),
        // It is the floor of the next number but at integers.
        (Func::Ceil, [Words::Real(x)]) => {
            let next = x.add(&Ball128::integer(1))?;
            Some(Chosen::step(next, -x.negative().floor()?))
        }
        _ => None,
    }
}

/// The value of a function with a choice.
fn by_choice(f: Func, x: &[&Words], choice: Choice) -> Option<Words> {
    Some(match (f, choice, x) {
        (Func::Abs, Choice::Order(Ordering::Less), [x]) => negative(x),
        (Func::Abs, Choice::Order(_), [x]) => **x,
        (Func::Fmin, Choice::Order(Ordering::Less), [x, _]) => **x,
        (Func::Fmin, Choice::Order(_), [_, y]) => **y,
        (Func::Fmax, Choice::Order(Ordering::Less), [_, y]) => **y,
        (Func::Fmax, Choice::Order(_), [x, _]) => **x,
        (Func::Floor | Func::Ceil, Choice::Step(n), _) => Words::Real(Ball128::integer(n)),
        _ => return None,
    })
}

fn negative(x: &Words) -> Words {
    match x {
        Words::Real(x) => Words::Real(x.negative()),
        Words::Complex(z) => Words::Complex(z.negative()),
        Words::Continued(z) => Words::Continued(z.negative()),
        Words::Wide(z) => Words::Wide(z.negative()),
    }
}

/// A function of real numbers in machine words; none for others, and where these do not serve.
fn in_words(f: Func, x: &[&Words]) -> Option<Ball128> {
    match (f, x) {
        (Func::Exp, [Words::Real(x)]) => words::exp(x),
        (Func::Log, [Words::Real(x)]) => words::log(x),
        (Func::Sin, [Words::Real(x)]) => words::sin(x),
        (Func::Cos, [Words::Real(x)]) => words::cos(x),
        (Func::Tan, [Words::Real(x)]) => words::tan(x),
        (Func::Sinh, [Words::Real(x)]) => words::sinh(x),
        (Func::Cosh, [Words::Real(x)]) => words::cosh(x),
        (Func::Tanh, [Words::Real(x)]) => words::tanh(x),
        (Func::LambertW, [Words::Real(x)]) => words::lambertw(x),
        // MPFR sees values that are exact.
        (Func::Tgamma, [Words::Real(x)]) if !x.is_exact() => words::tgamma(x),
        (Func::Pow, [Words::Real(x), Words::Real(y)]) if !x.is_exact() => words::pow(x, y),
        _ => None,
    }
}

/// A function of complex numbers in machine words; none for others, and where these do not serve.
fn complex_in_words(f: Func, z: &Complex128) -> Option<Words> {
    let found = match f {
        Func::Re => return Some(Words::Real(z.re)),
        Func::Im => return Some(Words::Real(z.im)),
        Func::Exp => words::complex::exp(z),
        Func::Log => words::complex::log(z),
        Func::Sqrt => z.sqrt(),
        Func::Tgamma => words::complex::tgamma(z),
        _ => None,
    };
    found.map(Words::Complex)
}

/// A power of numbers that are not both real; `twice` the exponent, where that is an integer.
fn power_in_words(z: &Words, y: &Words, twice: Option<i64>) -> Option<Words> {
    let halves = twice.filter(|k| k % 2 != 0).and_then(|k| k.try_into().ok());
    if let Some((z, y)) = z.complex().zip(y.complex()) {
        let found = match halves {
            Some(k) => z.sqrt()?.power(k),
            None => words::complex::pow(&z, &y),
        };
        return found.map(Words::Complex);
    }
    let base = z.rectangle()?;
    let found = match halves {
        Some(k) => base.sqrt()?.power(k),
        None => base.log()?.mul(&y.rectangle()?)?.exp(),
    };
    bound(z.is_complex() || y.is_complex(), found).ok()
}

/// A function over a rectangle that doubles bound; none for others.
fn bounded(f: Func, z: &Rectangle) -> Option<Rectangle> {
    match f {
        Func::Exp => z.exp(),
        Func::Sin => z.sin(),
        Func::Cos => z.cos(),
        Func::Sinh => z.sinh(),
        Func::Cosh => z.cosh(),
        Func::Sqrt => z.sqrt(),
        Func::Log => z.log(),
        Func::Tgamma => z.tgamma(),
        Func::LambertW => z.lambertw(),
        _ => None,
    }
}

impl Interpretation for Short {
    type V = Words;

    fn at(&mut self, id: Id, _: Node) -> Result<(), NoValue> {
        self.current = id;
        Ok(())
    }

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        decided(self.rational(graph.rational(place)))
    }

    fn integer(&mut self, n: i64) -> Words {
        Words::Real(Ball128::integer(n))
    }

    fn constant(&mut self, c: Constant) -> Found {
        self.short(&Balls::new(128).constant(c)?)
    }

    fn imaginary_unit(&mut self) -> Found {
        Ok(Words::Complex(Complex128::imaginary_unit()))
    }

    fn infinity(&mut self) -> Found {
        Err(LEFT)
    }

    fn neg(&mut self, a: &Words) -> Found {
        Ok(negative(a))
    }

    fn add(&mut self, a: &Words, b: &Words) -> Found {
        pair(a, b, Ball128::add, Complex128::add, Rectangle::add)
    }

    fn sub(&mut self, a: &Words, b: &Words) -> Found {
        pair(a, b, Ball128::sub, Complex128::sub, |a, b| {
            a.add(&b.negative())
        })
    }

    fn mul(&mut self, a: &Words, b: &Words) -> Found {
        pair(a, b, Ball128::mul, Complex128::mul, Rectangle::mul)
    }

    fn div(&mut self, a: &Words, b: &Words) -> Found {
        pair(a, b, Ball128::div, Complex128::div, |a, b| {
            a.mul(&b.inverse()?)
        })
    }

    fn power(&mut self, a: &Words, k: i32) -> Found {
        match a {
            // Zero to the power of zero is for the others to define.
            Words::Real(x) if x.is_zero() => Err(LEFT),
            Words::Real(x) => decided(x.power(k)),
            Words::Complex(z) => z.power(k).map(Words::Complex).ok_or(LEFT),
            Words::Continued(z) => bound(false, z.power(k)),
            Words::Wide(z) => bound(true, z.power(k)),
        }
    }

    fn call(&mut self, f: Func, x: &[&Words]) -> Found {
        if is_choice(f) && !x.iter().any(|x| x.is_complex()) {
            match self.choice(|| chosen(f, x)) {
                Some(choice) => return by_choice(f, x, choice).ok_or(LEFT),
                None if self.choosing != Choosing::Freely => return Err(LEFT),
                // Steps have values on both sides.
                None if matches!(f, Func::Floor | Func::Ceil) => {}
                None if x.iter().all(|x| matches!(x, Words::Real(_))) => return Err(LEFT),
                None => {}
            }
        }
        let found = match x {
            [Words::Real(a)] => arithmetic(f, &[a]),
            [Words::Real(a), Words::Real(b)] => arithmetic(f, &[a, b]),
            [Words::Real(a), Words::Real(b), Words::Real(c)] => arithmetic(f, &[a, b, c]),
            [z, y] if f == Func::Pow => {
                let twice = y.real().map(|y| Words::Real(y.shift(1)));
                let twice = twice.and_then(|y| self.to_integer(&y));
                match power_in_words(z, y, twice) {
                    Some(found) => return Ok(found),
                    None => None,
                }
            }
            [Words::Complex(z)] => match complex_in_words(f, z) {
                Some(found) if !self.balls.holomorphic => return Ok(found),
                _ => None,
            },
            [z @ (Words::Continued(rectangle) | Words::Wide(rectangle))] => {
                match bounded(f, rectangle) {
                    Some(found) => return bound(z.is_complex(), Some(found)),
                    None => None,
                }
            }
            _ => None,
        };
        if let Some(found) = found {
            return decided(found);
        }
        self.has_called = true;
        if let Some(found) = in_words(f, x) {
            return decided(Some(found));
        }
        let values: Option<Vec<Value>> = x.iter().map(|x| x.to_value()).collect();
        let values = values.ok_or(LEFT)?;
        let operands: Vec<&Value> = values.iter().collect();
        self.has_left = true;
        let found = self.balls.call(f, &operands)?;
        self.short(&found)
    }

    fn inverse(&mut self, f: Func, x: &Words) -> Option<Words> {
        let (Words::Continued(z) | Words::Wide(z)) = x else {
            return None;
        };
        let found = match f {
            Func::Cosh => z.sech(),
            Func::Cos => z.sec(),
            Func::Tgamma => z.inverse_gamma(),
            _ => return None,
        };
        match found {
            None if f == Func::Tgamma => {
                let found = self.balls.inverse(f, &x.to_value()?)?;
                self.short(&found).ok()
            }
            found => bound(x.is_complex(), found).ok(),
        }
    }

    fn flat(&mut self, _: Func, _: &Words) -> Found {
        Err(LEFT)
    }

    fn compare(&mut self, relation: Relation, a: &Words, b: &Words) -> Result<bool, NoValue> {
        if a.is_complex() || b.is_complex() {
            return Err(LEFT);
        }
        if self.choosing != Choosing::Freely {
            let order = || match (a, b) {
                (Words::Real(a), Words::Real(b)) => Chosen::order(a.sub(b)?),
                _ => None,
            };
            return match self.choice(order) {
                Some(Choice::Order(order)) => Ok(relation.holds(order)),
                _ => Err(LEFT),
            };
        }
        let order = match (a, b) {
            (Words::Real(a), Words::Real(b)) => a.sub(b).and_then(|d| d.sign()),
            _ => {
                let parts = a.rectangle().zip(b.rectangle());
                parts.and_then(|(a, b)| {
                    let ([a, b], [c, d]) = (a.real_part(), b.real_part());
                    match () {
                        () if b < c => Some(Ordering::Less),
                        () if d < a => Some(Ordering::Greater),
                        () => None,
                    }
                })
            }
        };
        Ok(relation.holds(order.ok_or(LEFT)?))
    }

    fn to_integer(&self, a: &Words) -> Option<i64> {
        let x = a.real()?.to_ball()?;
        self.balls.to_integer(&Value::Real(x))
    }

    fn bound(evaluator: &mut Evaluator<Short>, binder: u32) -> Result<Words, Stop> {
        let node = evaluator.graph().find(Node::Bound(binder)).unwrap_or(0);
        Err(Stop { node, reason: LEFT })
    }
}
