//! Inputs as rational numbers, in memory that is used again.

use rug::Rational;
use std::cell::RefCell;

thread_local! {
    /// Numbers of inputs that are done with.
    static SPARE: RefCell<Vec<Vec<Rational>>> = const { RefCell::new(Vec::new()) };
}

/// Inputs whose memory is kept, and the most numbers of one.
const KEPT: usize = 4;
const LONGEST: usize = 256;

/// The numbers of an input, exactly.
pub(super) struct Exact(Vec<Rational>);

impl Exact {
    /// Nothing where one is infinite or NaN.
    pub(super) fn new(input: &[f64]) -> Option<Exact> {
        let spare = SPARE.with_borrow_mut(Vec::pop);
        let mut all = Exact(spare.unwrap_or_default());
        all.0.resize_with(input.len(), Rational::new);
        let mut pairs = all.0.iter_mut().zip(input);
        pairs.all(|(q, &x)| q.assign_f64(x).is_ok()).then_some(all)
    }

    pub(super) fn numbers(&self) -> &[Rational] {
        &self.0
    }
}

impl Drop for Exact {
    fn drop(&mut self) {
        let numbers = std::mem::take(&mut self.0);
        // At the end of a thread there is nowhere to keep them.
        let _ = SPARE.try_with(|spare| {
            let mut spare = spare.borrow_mut();
            if spare.len() < KEPT && numbers.len() <= LONGEST {
                spare.push(numbers);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_input_whatever_was_before() {
        for input in [
            vec![1.5, -0.0, 5e-324],
            vec![],
            vec![f64::MAX; 300],
            vec![-2.0],
            vec![0.1; 299],
        ] {
            let exact = Exact::new(&input).unwrap();
            let due: Vec<Rational> = input
                .iter()
                .filter_map(|&x| Rational::from_f64(x))
                .collect();
            assert_eq!(exact.numbers(), due);
            assert!(
                Exact::new(&[1.0, f64::NAN]).is_none() && Exact::new(&[f64::INFINITY]).is_none()
            );
        }
        assert!(SPARE.with_borrow(|spare| (1..=KEPT).contains(&spare.len())));
        assert!(SPARE.with_borrow(|spare| spare.iter().all(|x| x.len() <= LONGEST)));
    }
}
