//! Answers one after the other, their numbers in one piece of memory.
//!
//! One thread reads answers and others judge them. An allocator is slow to take back what another
//! thread has made; here each thread frees its own.

use mechaudit::audit::SolverAnswer;
use std::ops::Range;

/// Answers, to be read in any order.
#[derive(Debug, Default)]
pub struct Batch {
    numbers: Vec<f64>,
    answers: Vec<Packed>,
}

#[derive(Debug)]
enum Packed {
    /// These of the numbers.
    Values(Range<usize>),
    Other(SolverAnswer),
}

impl Batch {
    pub fn len(&self) -> usize {
        self.answers.len()
    }

    pub fn is_empty(&self) -> bool {
        self.answers.is_empty()
    }

    pub fn push(&mut self, answer: SolverAnswer) {
        match answer {
            SolverAnswer::Values(values) => self.push_values(&values),
            other => self.answers.push(Packed::Other(other)),
        }
    }

    fn push_values(&mut self, values: &[f64]) {
        let from = self.numbers.len();
        self.numbers.extend_from_slice(values);
        self.answers.push(Packed::Values(from..self.numbers.len()));
    }

    /// The answer of that number.
    pub fn get(&self, i: usize) -> SolverAnswer {
        match &self.answers[i] {
            Packed::Values(range) => SolverAnswer::Values(self.numbers[range.clone()].to_vec()),
            Packed::Other(other) => other.clone(),
        }
    }

    /// Adds those of another batch.
    pub fn extend(&mut self, other: &Batch, numbers: Range<usize>) {
        for answer in &other.answers[numbers] {
            match answer {
                Packed::Values(range) => self.push_values(&other.numbers[range.clone()]),
                Packed::Other(other) => self.answers.push(Packed::Other(other.clone())),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use SolverAnswer::{Declines, Fails, Values};

    #[test]
    fn answers_come_out_as_they_went_in() {
        let all = [
            Values(vec![1.0, -0.0]),
            Declines(None),
            Values(Vec::new()),
            Values(vec![3.0]),
            Fails("late".into()),
            Values(vec![4.0, 5.0, 6.0]),
        ];
        let mut batch = Batch::default();
        assert!(batch.is_empty());
        all.iter().cloned().for_each(|a| batch.push(a));
        assert_eq!(batch.len(), all.len());
        let got: Vec<_> = (0..batch.len()).map(|i| batch.get(i)).collect();
        assert_eq!(got, all);
        let mut more = Batch::default();
        more.push(Values(vec![9.0]));
        more.extend(&batch, 2..5);
        more.extend(&batch, 5..5);
        let got: Vec<_> = (0..more.len()).map(|i| more.get(i)).collect();
        assert_eq!(got[0], Values(vec![9.0]));
        assert_eq!(got[1..], all[2..5]);
    }
}
