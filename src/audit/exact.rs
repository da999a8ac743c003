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
            let expected: Vec<Rational> = input
                .iter()
                .filter_map(|&x| Rational::from_f64(x))
                .collect();
            assert_eq!(exact.numbers(), expected);
            assert!(
                Exact::new(&[1.0, f64::NAN]).is_none() && Exact::new(&[f64::INFINITY]).is_none()
            );
        }
        assert!(SPARE.with_borrow(|spare| (1..=KEPT).contains(&spare.len())));
        assert!(SPARE.with_borrow(|spare| spare.iter().all(|x| x.len() <= LONGEST)));
    }

    /// Bit for bit what GMP makes of the number, also where the memory held others before.
    #[test]
    fn numbers_are_exact_at_the_ends_of_the_range() {
        let tiny = 5e-324;
        let least = f64::MIN_POSITIVE;
        let input = [
            0.0,
            -0.0,
            tiny,
            -tiny,
            least.next_down(),
            least,
            f64::MAX,
            f64::MIN,
            0.1,
            -1.0,
            1.0f64.next_up(),
        ];
        for input in [input.to_vec(), input.iter().rev().copied().collect()] {
            let exact = Exact::new(&input).unwrap();
            for (q, x) in exact.numbers().iter().zip(&input) {
                assert_eq!(*q, Rational::from_f64(*x).unwrap());
            }
            let power = |q: &Rational| q.denom().significant_bits() - 1;
            let least = input.iter().position(|x| *x == tiny).unwrap();
            assert_eq!(
                (
                    power(&exact.numbers()[least]),
                    exact.numbers()[least].numer()
                ),
                (1074, &1.into())
            );
        }
    }

    /// Four are kept, none of more than 256 numbers.
    #[test]
    fn little_memory_is_kept() {
        let kept = |length: usize| {
            SPARE.with_borrow_mut(Vec::clear);
            drop([(); 6].map(|()| Exact::new(&vec![1.0; length])));
            SPARE.with_borrow(Vec::len)
        };
        assert_eq!([1, 256, 257].map(kept), [4, 4, 0]);
    }
}
