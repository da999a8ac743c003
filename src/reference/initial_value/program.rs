//! Right-hand sides of differential equations as straight-line programs.

use rug::Rational;

/// A place of an operation in a program.
pub type Slot = usize;

/// A function whose derivative along a path is a sum of products: `v′ = Σ w_j u_j′`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// Natural logarithm, w = 1/u.
    Log,
    /// Arc tangent, w = 1/(1 + u²).
    Atan,
    /// Arc sine, w = 1/√(1 − u²).
    Asin,
    /// Inverse hyperbolic sine, w = 1/√(1 + u²).
    Asinh,
    /// Inverse hyperbolic cosine, w = 1/√(u² − 1).
    Acosh,
    /// Inverse hyperbolic tangent, w = 1/(1 − u²).
    Atanh,
    /// Error function, w = (2/√π) e^{−u²}.
    Erf,
    /// Imaginary error function, w = (2/√π) e^{u²}.
    Erfi,
    /// The angle of the point (x, y), for u = (y, x): w = (x, −y)/(x² + y²).
    Atan2,
}

/// An operation on earlier values of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// A constant, by its place in the list of constants.
    Constant(usize),
    /// The time.
    Time,
    /// A state.
    State(usize),
    /// `−a`.
    Neg(Slot),
    /// `a + b`.
    Add(Slot, Slot),
    /// `a − b`.
    Sub(Slot, Slot),
    /// `a b`.
    Mul(Slot, Slot),
    /// `a²`.
    Square(Slot),
    /// `a / b`.
    Div(Slot, Slot),
    /// `√a`, for a > 0.
    Sqrt(Slot),
    /// `e^a`.
    Exp(Slot),
    /// `sin a`; the next operation is the cosine of the same.
    Sine(Slot),
    /// `cos a`; the operation before is the sine of the same.
    Cosine(Slot),
    /// `a^(p/q)`, for a > 0.
    Power(Slot, i32, i32),
    /// A function by its slopes: pairs of an argument and the derivative by it.
    Primitive(Primitive, Vec<(Slot, Slot)>),
}

/// A straight-line program of the time and the states.
#[derive(Clone, Debug, Default)]
pub struct Program {
    operations: Vec<Operation>,
    /// The degree in the time of values that are polynomials whatever the states are.
    degrees: Vec<Option<usize>>,
    constants: usize,
}

impl Program {
    /// Creates an empty program.
    pub fn new() -> Program {
        Program::default()
    }

    /// The operations.
    pub fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// The number of constants.
    pub fn constants(&self) -> usize {
        self.constants
    }

    /// The degree in the time, where a value is a polynomial of the time alone.
    pub(super) fn degree(&self, slot: Slot) -> usize {
        self.degrees[slot].unwrap_or(usize::MAX)
    }

    /// Adds a constant, whose value is given when the program runs; returns its place.
    pub fn constant(&mut self) -> Slot {
        self.constants += 1;
        self.push(Operation::Constant(self.constants - 1))
    }

    /// Adds an operation; returns its place.
    ///
    /// # Panics
    /// If an operand comes after the operation, or for a sine or a cosine alone
    /// ([`Program::sine_cosine`]).
    pub fn push(&mut self, operation: Operation) -> Slot {
        let is_pair = matches!(operation, Operation::Sine(_) | Operation::Cosine(_));
        assert!(!is_pair, "sines and cosines come in pairs");
        self.add(operation)
    }

    /// Adds the sine and the cosine of a value; returns their places.
    pub fn sine_cosine(&mut self, a: Slot) -> (Slot, Slot) {
        (self.add(Operation::Sine(a)), self.add(Operation::Cosine(a)))
    }

    fn add(&mut self, operation: Operation) -> Slot {
        let d = |slot: &Slot| self.degrees[*slot];
        let degree = match &operation {
            Operation::Constant(_) => Some(0),
            Operation::Time => Some(1),
            Operation::Neg(a) => d(a),
            Operation::Add(a, b) | Operation::Sub(a, b) => d(a).zip(d(b)).map(|(a, b)| a.max(b)),
            Operation::Mul(a, b) => d(a).zip(d(b)).map(|(a, b)| a + b),
            Operation::Square(a) => d(a).map(|a| 2 * a),
            Operation::Div(a, b) => d(a).filter(|_| d(b) == Some(0)),
            _ => None,
        };
        self.operations.push(operation);
        self.degrees.push(degree);
        self.operations.len() - 1
    }

    /// `a^(p/q)` for a positive base.
    pub fn power(&mut self, a: Slot, exponent: &Rational) -> Option<Slot> {
        /// The largest numerator and denominator: products with orders stay small integers.
        const LARGEST: i32 = 1 << 20;
        let p = exponent.numer().to_i32().filter(|p| p.abs() < LARGEST)?;
        let q = exponent.denom().to_i32().filter(|q| *q < LARGEST)?;
        Some(self.push(Operation::Power(a, p, q)))
    }
}
