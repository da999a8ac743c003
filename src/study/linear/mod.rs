//! Studies of linear algebra: inputs are matrices and vectors of numbers.
//!
//! The numbers of the inputs come one after the other, matrices row by row, of a band only the
//! places within it. Entries are exact; the reference solves over the rationals, or in balls with a
//! proved radius.

mod conditions;
pub(super) mod read;
pub(super) mod sampling;

pub(super) use conditions::conditions;
pub(super) use read::is_linear;

use super::problem::intern;
use crate::audit::{Expected, Input, Proof, ReferenceAnswer, Rows, Uncertified};
use crate::reference::banded::{self, Banded};
use crate::reference::{Ball, LinearError, Matrix, dense, eigenvalues};
use mechaudit_symbolic::evaluation::{Answer, Goal, Undecided};
use rug::Rational;

/// The most numbers of an input.
const MOST: usize = 4_000_000;

/// The largest order of a banded matrix that is written out as a dense one.
const WRITTEN_OUT: usize = 1000;

/// A number of rows or columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// A number that the study states.
    Known(usize),
    /// The one that follows from the count of numbers.
    Open,
}

impl Size {
    fn at(self, open: usize) -> usize {
        match self {
            Size::Known(n) => n,
            Size::Open => open,
        }
    }

    fn text(self, letter: &str) -> String {
        match self {
            Size::Known(n) => n.to_string(),
            Size::Open => letter.into(),
        }
    }
}

/// A matrix or a vector of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Tensor {
    /// Its name.
    pub name: String,
    /// The number of rows, or of a vector's entries.
    pub rows: Size,
    /// The number of columns; none for a vector.
    pub columns: Option<Size>,
    /// Diagonals below and above the main one, of a banded matrix.
    pub band: Option<[usize; 2]>,
}

impl Tensor {
    fn columns_at(&self, open: usize) -> usize {
        self.columns.map_or(1, |c| c.at(open))
    }

    /// The number of its numbers.
    fn count(&self, open: usize) -> usize {
        let n = self.rows.at(open);
        match self.band {
            None => n.saturating_mul(self.columns_at(open)),
            Some([lower, upper]) => {
                // Diagonal d has n − |d| places.
                let off = |most: usize| -> usize {
                    let most = most.min(n.saturating_sub(1));
                    most.saturating_mul(n).saturating_sub(most * (most + 1) / 2)
                };
                n.saturating_add(off(lower)).saturating_add(off(upper))
            }
        }
    }

    /// The places of its numbers in their order.
    fn places(&self, open: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (n, columns, band) = (self.rows.at(open), self.columns_at(open), self.band);
        (0..n).flat_map(move |i| {
            let within = match band {
                None => 0..columns,
                Some([lower, upper]) => i.saturating_sub(lower)..(i + upper + 1).min(columns),
            };
            within.map(move |j| (i, j))
        })
    }

    fn shape(&self, letter: &str) -> String {
        let rows = self.rows.text(letter);
        let shape = match self.columns {
            None => rows,
            Some(columns) => format!("{rows}*{}", columns.text(letter)),
        };
        match self.band {
            None => format!("{}[{shape}]", self.name),
            Some([lower, upper]) => format!("{}[{shape}, banded {lower}, {upper}]", self.name),
        }
    }
}

/// A problem of linear algebra; matrices and vectors by their places in the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The solution of `A x = b`.
    Solve(usize, usize),
    /// The determinant.
    Determinant(usize),
    /// The inverse, row by row.
    Inverse(usize),
    /// The x that minimises `‖A x − b‖₂`.
    LeastSquares(usize, usize),
    /// The eigenvalues of a symmetric matrix in ascending order; with a second matrix, which is
    /// positive definite, those of `A x = λ B x`.
    Eigenvalues(usize, Option<usize>),
}

impl Task {
    /// The matrix.
    fn matrix(self) -> usize {
        match self {
            Task::Solve(a, _) | Task::LeastSquares(a, _) => a,
            Task::Determinant(a) | Task::Inverse(a) | Task::Eigenvalues(a, _) => a,
        }
    }
}

/// A study's problem of linear algebra.
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    /// The length that is open, if one is.
    pub letter: Option<String>,
    /// Inputs in the order of the file.
    pub tensors: Vec<Tensor>,
    /// The task of each output; all have the same number of values.
    pub tasks: Vec<Task>,
}

/// The reason why there are no values.
#[derive(Debug)]
enum NoValues {
    Layout,
    Linear(LinearError),
}

impl From<LinearError> for NoValues {
    fn from(e: LinearError) -> NoValues {
        NoValues::Linear(e)
    }
}

/// The numbers of an answer, as few as show which vector it is.
fn shown(vector: &[Rational]) -> String {
    const FIRST: usize = 6;
    let number = |q: &Rational| match q.to_string() {
        text if text.len() <= 12 => text,
        _ => format!("{:e}", q.to_f64()),
    };
    let mut texts: Vec<String> = vector.iter().take(FIRST).map(number).collect();
    if vector.len() > FIRST {
        texts.push(format!("... ({} entries)", vector.len()));
    }
    texts.join(", ")
}

impl Linear {
    fn letter(&self) -> &str {
        self.letter.as_deref().unwrap_or("n")
    }

    fn count(&self, open: usize) -> usize {
        let counts = self.tensors.iter().map(|t| t.count(open));
        counts.fold(0, usize::saturating_add)
    }

    /// The open length of an input of `found` numbers; any number where none is open.
    fn open(&self, found: usize) -> Option<usize> {
        if self.letter.is_none() {
            return (self.count(0) == found).then_some(0);
        }
        // The count grows with the length.
        let (mut low, mut high) = (0, found.min(MOST));
        while low < high {
            let middle = low + (high - low) / 2;
            match self.count(middle) < found {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        (low > 0 && self.count(low) == found).then_some(low)
    }

    /// The reason why `found` numbers are no input, if they are none.
    pub(super) fn refusal(&self, found: usize) -> Option<String> {
        if self.open(found).is_some() {
            return None;
        }
        let shapes = self.tensors.iter().map(|t| t.shape(self.letter()));
        let shapes = shapes.collect::<Vec<_>>().join(", ");
        Some(match &self.letter {
            Some(letter) => format!("{found} numbers are right for no {letter}: {shapes}"),
            None => format!("{found} numbers where {} are due: {shapes}", self.count(0)),
        })
    }

    /// The layout of the input: one part for each matrix, or all numbers where a length is open.
    pub(super) fn inputs(&self, units: &[&'static str]) -> Vec<Input> {
        if self.letter.is_some() {
            let shapes = self.tensors.iter().map(|t| t.shape(self.letter()));
            let name = format!("values[N] ({})", shapes.collect::<Vec<_>>().join(", then "));
            let unit = "1";
            return vec![Input {
                name: intern(&name),
                unit,
            }];
        }
        let tensors = self.tensors.iter().zip(units);
        let input = |(t, unit): (&Tensor, &&'static str)| Input {
            name: intern(&format!("{}[{}]", t.name, t.count(0))),
            unit,
        };
        tensors.map(input).collect()
    }

    /// The number of values of each output: two factors.
    fn values_of(&self, task: Task) -> Option<(Size, Size)> {
        let one = Size::Known(1);
        let a = &self.tensors[task.matrix()];
        match task {
            Task::Determinant(_) => None,
            Task::Solve(_, b) => Some((a.rows, self.tensors[b].columns.unwrap_or(one))),
            Task::LeastSquares(_, b) => {
                let rows = a.columns.unwrap_or(one);
                Some((rows, self.tensors[b].columns.unwrap_or(one)))
            }
            Task::Inverse(_) => Some((a.rows, a.rows)),
            Task::Eigenvalues(..) => Some((a.rows, one)),
        }
    }

    /// The rows of answers.
    pub(super) fn rows(&self) -> Option<Rows> {
        let (rows, columns) = self.values_of(*self.tasks.first()?)?;
        let count = match (rows, columns) {
            (Size::Known(m), Size::Known(n)) => (m * n).to_string(),
            (rows, Size::Known(1)) => rows.text(self.letter()),
            (m, n) => format!("{}*{}", m.text(self.letter()), n.text(self.letter())),
        };
        Some(Rows {
            index: "i",
            count: intern(&count),
            meaning: "entries in their order",
        })
    }

    /// The matrix of a place, dense.
    fn dense(
        &self,
        which: usize,
        parts: &[&[Rational]],
        open: usize,
    ) -> Result<Matrix<Rational>, NoValues> {
        let tensor = &self.tensors[which];
        let (m, n) = (tensor.rows.at(open), tensor.columns_at(open));
        if tensor.band.is_none() {
            return Ok(Matrix::new(m, n, parts[which].to_vec())?);
        }
        if m > WRITTEN_OUT {
            let reason = format!("a banded matrix of order {m} above {WRITTEN_OUT} is only solved");
            return Err(LinearError::from(crate::reference::Undecided::new(0, reason)).into());
        }
        let mut entries = vec![Rational::new(); m * n];
        for ((i, j), x) in tensor.places(open).zip(parts[which]) {
            entries[i * n + j].clone_from(x);
        }
        Ok(Matrix::new(m, n, entries)?)
    }

    fn banded(
        &self,
        which: usize,
        parts: &[&[Rational]],
        open: usize,
        [lower, upper]: [usize; 2],
    ) -> Result<Banded, NoValues> {
        let tensor = &self.tensors[which];
        let (n, width) = (tensor.rows.at(open), lower + upper + 1);
        let mut entries = vec![Rational::new(); n.saturating_mul(width)];
        for ((i, j), x) in tensor.places(open).zip(parts[which]) {
            entries[i * width + lower + j - i].clone_from(x);
        }
        Ok(Banded::new(n, lower, upper, entries)?)
    }

    /// The values of one output.
    fn values_at(
        &self,
        task: Task,
        parts: &[&[Rational]],
        open: usize,
        bits: u32,
    ) -> Result<Vec<Ball>, NoValues> {
        let dense = |which: usize| self.dense(which, parts, open);
        let entries = |x: Matrix<Ball>| x.entries().to_vec();
        Ok(match task {
            Task::Solve(a, b) => match self.tensors[a].band {
                Some(band) if self.tensors[b].columns_at(open) == 1 => {
                    banded::solve(&self.banded(a, parts, open, band)?, parts[b], bits)?
                }
                _ => entries(dense::solve(&dense(a)?, &dense(b)?, bits)?),
            },
            Task::Determinant(a) => vec![dense::determinant(&dense(a)?, bits)?],
            Task::Inverse(a) => entries(dense::inverse(&dense(a)?, bits)?),
            Task::LeastSquares(a, b) => {
                entries(dense::least_squares(&dense(a)?, &dense(b)?, bits)?)
            }
            Task::Eigenvalues(a, None) => eigenvalues::symmetric(&dense(a)?, bits)?,
            Task::Eigenvalues(a, Some(b)) => {
                eigenvalues::generalised(&dense(a)?, &dense(b)?, bits)?
            }
        })
    }

    /// The numbers of each input.
    fn parts<'a, T>(&self, mut numbers: &'a [T], open: usize) -> Vec<&'a [T]> {
        let mut parts = Vec::new();
        for tensor in &self.tensors {
            let (part, rest) = numbers.split_at(tensor.count(open).min(numbers.len()));
            parts.push(part);
            numbers = rest;
        }
        parts
    }

    /// The values of all outputs, row by row.
    fn values(&self, numbers: &[Rational], bits: u32) -> Result<Vec<Ball>, NoValues> {
        let open = self.open(numbers.len()).ok_or(NoValues::Layout)?;
        let parts = self.parts(numbers, open);
        let all = self
            .tasks
            .iter()
            .map(|task| self.values_at(*task, &parts, open, bits));
        let all: Vec<Vec<Ball>> = all.collect::<Result<_, _>>()?;
        let count = all.first().map_or(0, Vec::len);
        Ok((0..count)
            .flat_map(|i| all.iter().map(move |values| values[i].clone()))
            .collect())
    }

    /// The reference at an input.
    pub(super) fn reference(&self, numbers: &[Rational], bits: u32) -> ReferenceAnswer {
        match self.values(numbers, bits) {
            Ok(values) => {
                let values = values.into_iter().map(Expected::Number);
                ReferenceAnswer::Expected(values.collect(), PROOF)
            }
            Err(NoValues::Layout) => ReferenceAnswer::Refuses("bad layout"),
            Err(NoValues::Linear(e)) => match word(&e) {
                Some(word) => ReferenceAnswer::Refuses(word),
                None => ReferenceAnswer::Undecided(e.to_string()),
            },
        }
    }

    /// Balls of the values, or a refusal that says why.
    pub(super) fn certify(
        &self,
        numbers: &[Rational],
        bits: u32,
    ) -> Result<Vec<Ball>, Uncertified> {
        self.values(numbers, bits).map_err(|why| match why {
            NoValues::Layout => Uncertified::Refused("bad layout"),
            NoValues::Linear(e) => match word(&e) {
                Some(word) => {
                    let why = match &e {
                        LinearError::Singular { null } => {
                            format!("the columns are dependent, by ({})", shown(null))
                        }
                        LinearError::NotPositiveDefinite { witness } => {
                            format!("the form is not positive at ({})", shown(witness))
                        }
                        LinearError::NotSymmetric { row, column } => {
                            let (row, column) = (row + 1, column + 1);
                            format!("row {row}, column {column} differs from its mirror image")
                        }
                        other => other.to_string(),
                    };
                    Uncertified::Refused(intern(&format!("{word}: {why}")))
                }
                None => Uncertified::Undecided(e.to_string()),
            },
        })
    }
}

impl Linear {
    /// The values at a goal, for studies that are asked as formulas are.
    pub(super) fn answers(&self, numbers: &[Rational], goal: Goal) -> Vec<Answer> {
        let bits = match goal {
            Goal::Bits(bits) | Goal::Double(bits) => bits,
            Goal::Nearest => 128,
        };
        let open = self.open(numbers.len()).unwrap_or(0);
        let first = self.tasks.first().and_then(|task| self.values_of(*task));
        let count = first.map_or(1, |(m, n)| m.at(open).saturating_mul(n.at(open)));
        let undefined = |reason| Answer::Undefined {
            reason,
            place: self.letter().into(),
        };
        match self.certify(numbers, bits) {
            Ok(values) => values
                .into_iter()
                .map(|ball| match ball.is_zero() {
                    true => Answer::Zero,
                    false => Answer::Number(ball),
                })
                .collect(),
            Err(Uncertified::Refused(word)) => vec![undefined(word); count * self.tasks.len()],
            Err(why) => {
                let why = Undecided {
                    reason: intern(&why.to_string()),
                    place: self.letter().into(),
                    bits,
                };
                vec![Answer::Undecided(why); count * self.tasks.len()]
            }
        }
    }
}

/// Reason to believe the references.
const PROOF: Proof = Proof::Bounded(
    "exact solutions over the rationals, or balls whose radii a residual and an approximate inverse prove",
);

/// The word for an input without values.
fn word(e: &LinearError) -> Option<&'static str> {
    match e {
        LinearError::Singular { .. } => Some("singular"),
        LinearError::NotSymmetric { .. } => Some("not symmetric"),
        LinearError::NotPositiveDefinite { .. } => Some("not positive definite"),
        LinearError::NotSquare { .. } | LinearError::Length { .. } => Some("bad layout"),
        LinearError::NotFinite { .. } => Some("not finite"),
        LinearError::Undecided(_) => None,
    }
}

#[cfg(test)]
mod tests;
