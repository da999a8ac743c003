//! Arguments of `mechaudit motion`.

use super::number;
use crate::cli::number::{Number, NumberError};
use clap::{Args as ClapArgs, ValueEnum};
use mechaudit::study::TimesError;
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

Every digit is certified: correctly rounded, or the last one off by one at most. A value with \
fewer certified digits is undecided, and one that does not exist, as after a blow-up, is nan; the reason is \
on standard error.

Exit codes: 0, all digits are certified; 1, some are undecided or nan; 2, bad usage or input.";

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

/// Reads times.
fn times(text: &str) -> Result<Times, TimesError> {
    mechaudit::study::times(text).map(Times)
}

/// The reason why a text is no setting.
#[derive(Debug, thiserror::Error)]
pub enum SettingError {
    #[error(transparent)]
    Number(#[from] NumberError),
    #[error("{0:?} is not NAME=NUMBER")]
    Form(String),
}

/// Reads the value of an input.
fn setting(text: &str) -> Result<(String, Rational), SettingError> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(SettingError::Form(text.into()));
    };
    Ok((name.trim().into(), Number::parse(value)?.exact()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_a_name_and_a_number() {
        assert_eq!(
            setting("mu = 1/2").unwrap(),
            ("mu".into(), Rational::from((1, 2)))
        );
        assert!(setting("mu").is_err() && setting("mu=x").is_err() && setting("mu=inf").is_err());
    }
}
