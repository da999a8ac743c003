//! Arguments of `mechaudit motion`.

use super::number;
use crate::cli::number::{Number, NumberError};
use clap::{Args as ClapArgs, ValueEnum};
use rug::Rational;
use std::path::PathBuf;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit motion examples/studies/motion/pendulum-swing.toml --times 0:10:0.5
  mechaudit motion examples/studies/motion/lorenz.toml --times 1,2,5,10 --digits 25
  mechaudit motion examples/studies/motion/van-der-pol.toml --set mu=5 --times 0:20:0.1 --format csv
  mechaudit motion examples/studies/motion/double-pendulum.toml --times 0:10:0.05 --format html --output m.html

The file is a study with [ode], see `mechaudit::book`. Times are separated by commas; \
FIRST:LAST:STEP stands for all times from the first to the last, itself included where the steps meet \
it. Times and inputs are exact as written: decimals, hexadecimal floats or quotients.

Every digit is certified: correctly rounded, or the last one off by one at most. A value without so \
many certified digits is undecided, and one that does not exist, as after a blow-up, is nan; the reason is \
on standard error.

Exit codes: 0, all digits are certified; 1, some are undecided or nan; 2, bad usage or input.";

/// The most rows of a table.
const MOST: usize = 1_000_000;

/// Forms of a table of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionFormat {
    /// An aligned table for people
    Text,
    /// One line for each time
    Csv,
    /// The rows beside all that is known of the whole
    Json,
    /// One page without outside parts: curves that a slider moves over, and the table
    Html,
}

/// Arguments of `motion`.
#[derive(ClapArgs, Debug)]
pub struct MotionArgs {
    /// A study with [ode], or a mechanism with masses
    pub file: PathBuf,
    /// The times: FIRST:LAST:STEP, or several, separated by commas
    #[arg(long, value_name = "TIMES", value_parser = times, allow_hyphen_values = true)]
    pub times: Times,
    /// Significant digits that are certified [default: 15]
    #[arg(long, value_name = "N", value_parser = number::within::<u32>(1..=1000))]
    pub digits: Option<u32>,
    /// The forces in a mechanism's joints too
    #[arg(long)]
    pub reactions: bool,
    /// The value of an input, for each input of the file
    #[arg(long, value_name = "NAME=NUMBER", value_parser = setting)]
    pub set: Vec<(String, Rational)>,
    /// Form of the table
    #[arg(long, value_enum, default_value = "text")]
    pub format: MotionFormat,
    /// Write atomically to FILE (`-` is standard output)
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Times in increasing order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Times(pub Vec<Rational>);

/// The reason why a text is no list of times, or no setting.
#[derive(Debug, thiserror::Error)]
pub enum TimesError {
    #[error(transparent)]
    Number(#[from] NumberError),
    #[error("{0:?} is neither a time nor FIRST:LAST:STEP")]
    Range(String),
    #[error("the step of {0:?} is not positive")]
    Step(String),
    #[error("{0:?} ends before it begins")]
    Backwards(String),
    #[error("more than {MOST} times")]
    TooMany,
    #[error("the times do not increase at {0}")]
    Order(String),
    #[error("{0:?} is not NAME=NUMBER")]
    Setting(String),
}

/// An exact number.
fn exact(text: &str) -> Result<Rational, NumberError> {
    Number::parse(text)?.exact()
}

/// Reads times.
fn times(text: &str) -> Result<Times, TimesError> {
    let mut all: Vec<Rational> = Vec::new();
    for part in text.split(',') {
        let fields: Vec<&str> = part.split(':').collect();
        match fields[..] {
            [time] => all.push(exact(time)?),
            [first, last, step] => {
                let [first, last, step] = [exact(first)?, exact(last)?, exact(step)?];
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
                all.extend((0..=steps).map(|k| (&step * Rational::from(k)) + &first));
            }
            _ => return Err(TimesError::Range(part.into())),
        }
        if all.len() > MOST {
            return Err(TimesError::TooMany);
        }
    }
    match all.windows(2).find(|w| w[0] >= w[1]) {
        Some(w) => Err(TimesError::Order(w[1].to_string())),
        None => Ok(Times(all)),
    }
}

/// Reads the value of an input.
fn setting(text: &str) -> Result<(String, Rational), TimesError> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(TimesError::Setting(text.into()));
    };
    Ok((name.trim().into(), exact(value)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_exact_and_increase() {
        let due = |all: &[(i32, i32)]| Times(all.iter().map(|q| Rational::from(*q)).collect());
        for (text, all) in [
            ("0:1:0.5", &[(0, 1), (1, 2), (1, 1)][..]),
            ("0:1:0.4", &[(0, 1), (2, 5), (4, 5)]),
            ("-1/3,0x1p-1", &[(-1, 3), (1, 2)]),
            ("0,1:2:1,5", &[(0, 1), (1, 1), (2, 1), (5, 1)]),
            ("3:3:1", &[(3, 1)]),
        ] {
            assert_eq!(times(text).unwrap(), due(all), "{text}");
        }
        for (text, due) in [
            ("0:1", "is neither a time nor"),
            ("", "is neither a decimal"),
            ("0:1:0", "is not positive"),
            ("0:1:-1", "is not positive"),
            ("1:0:1", "ends before it begins"),
            ("0:1:1e-7", "more than 1000000 times"),
            ("0:1e30:1e-30", "more than 1000000 times"),
            ("1,0", "do not increase at 0"),
            ("1,1", "do not increase at 1"),
            ("0,inf", "must be finite"),
            ("0:nan:1", "must be finite"),
        ] {
            let found = times(text).unwrap_err().to_string();
            assert!(found.contains(due), "{text}: {found}");
        }
    }

    #[test]
    fn a_setting_is_a_name_and_a_number() {
        assert_eq!(
            setting("mu = 1/2").unwrap(),
            ("mu".into(), Rational::from((1, 2)))
        );
        assert!(setting("mu").is_err() && setting("mu=x").is_err() && setting("mu=inf").is_err());
    }
}
