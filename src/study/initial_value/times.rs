//! Lists of times as text.

use crate::study::read::exact;
use rug::{Integer, Rational};

/// The most times of a list.
const MOST: usize = 1_000_000;

/// Reason why a text is no list of times.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimesError {
    /// A part is no number.
    #[error("the time {0:?} is no finite number")]
    Number(String),
    /// A part has two or more than three numbers.
    #[error("{0:?} is neither a time nor FIRST:LAST:STEP")]
    Range(String),
    /// A step is zero or negative.
    #[error("the step of {0:?} is not positive")]
    Step(String),
    /// A range has its last time before its first.
    #[error("{0:?} ends before it begins")]
    Backwards(String),
    /// The list is too long.
    #[error("more than {MOST} times")]
    TooMany,
    /// A time does not come after the one before it.
    #[error("the times do not increase at {0}")]
    Order(String),
}

/// Reads times in increasing order: numbers and ranges `FIRST:LAST:STEP`, separated by commas. The
/// last time of a range is in it if the steps meet it.
///
/// # Errors
/// See [`TimesError`].
///
/// ```
/// use rug::Rational;
///
/// let times = mechaudit::study::times("0:1:0.5,3")?;
/// assert_eq!(times, [(0, 1), (1, 2), (1, 1), (3, 1)].map(Rational::from));
/// # Ok::<(), mechaudit::study::TimesError>(())
/// ```
pub fn times(text: &str) -> Result<Vec<Rational>, TimesError> {
    let number = |text: &str| exact(text).ok_or_else(|| TimesError::Number(text.into()));
    let mut all: Vec<Rational> = Vec::new();
    for part in text.split(',') {
        let before = all.len();
        let fields: Vec<&str> = part.split(':').collect();
        match fields[..] {
            [time] => all.push(number(time)?),
            [first, last, step] => {
                let [first, last, step] = [number(first)?, number(last)?, number(step)?];
                if step <= 0 {
                    return Err(TimesError::Step(part.into()));
                }
                if last < first {
                    return Err(TimesError::Backwards(part.into()));
                }
                let steps = Rational::from(&last - &first) / &step;
                let Some(steps) = steps.trunc().numer().to_usize().filter(|n| *n < MOST) else {
                    return Err(TimesError::TooMany);
                };
                all.extend(evenly(&first, &step, steps));
            }
            _ => return Err(TimesError::Range(part.into())),
        }
        if all.len() > MOST {
            return Err(TimesError::TooMany);
        }
        if before > 0 && all[before - 1] >= all[before] {
            return Err(TimesError::Order(all[before].to_string()));
        }
    }
    Ok(all)
}

/// `first + k step` for k from 0 to `steps`.
fn evenly(first: &Rational, step: &Rational, steps: usize) -> impl Iterator<Item = Rational> {
    // Over one denominator sums are those of integers.
    let under = first.denom().clone().lcm(step.denom());
    let over = |q: &Rational| Integer::from(&under / q.denom()) * q.numer();
    let (mut next, by) = (over(first), over(step));
    (0..=steps).map(move |_| {
        let time = Rational::from((&next, &under));
        next += &by;
        time
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_exact_and_increase() {
        for (text, due) in [
            ("0:1:0.5", &[(0, 1), (1, 2), (1, 1)][..]),
            ("0:1:0.4", &[(0, 1), (2, 5), (4, 5)]),
            ("-1/3, 0x1p-1", &[(-1, 3), (1, 2)]),
            ("0,1:2:1,5", &[(0, 1), (1, 1), (2, 1), (5, 1)]),
            ("3:3:1", &[(3, 1)]),
        ] {
            let due: Vec<Rational> = due.iter().map(|q| Rational::from(*q)).collect();
            assert_eq!(times(text), Ok(due), "{text}");
        }
        for (text, due) in [
            ("0:1", "is neither a time nor"),
            ("", "is no finite number"),
            ("0:1:0", "is not positive"),
            ("0:1:-1", "is not positive"),
            ("1:0:1", "ends before it begins"),
            ("0:1:1e-7", "more than 1000000 times"),
            ("0:1e30:1e-30", "more than 1000000 times"),
            ("1,0", "do not increase at 0"),
            ("1,1", "do not increase at 1"),
            ("0,inf", "is no finite number"),
            ("0:nan:1", "is no finite number"),
        ] {
            let found = times(text).unwrap_err().to_string();
            assert!(found.contains(due), "{text}: {found}");
        }
    }
}
