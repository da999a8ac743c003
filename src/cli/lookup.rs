//! Looks up the method and the settings that arguments and environment name.

use crate::cli::args::RunArgs;
use crate::cli::failure::Failure;
use mechaudit::audit::Settings;
use mechaudit::methods::{self, Evaluable};
use mechaudit::reference::Decimal;

/// Returns the method that an argument names.
pub fn method(text: &str) -> Result<Box<dyn Evaluable>, Failure> {
    methods::resolve(text).map_err(Failure::caused)
}

/// Returns the settings that arguments and environment select.
pub fn settings(args: &RunArgs) -> Result<Settings, Failure> {
    let effort = effort(std::env::var_os("MECHAUDIT_EFFORT").as_deref())?;
    Ok(at_effort(args, effort))
}

fn at_effort(args: &RunArgs, effort: f64) -> Settings {
    let default = Settings::default();
    let cases = args.cases.unwrap_or(default.cases_per_region);
    // Saturates; at least one case unless none were asked for.
    let scaled = (cases as f64 * effort).ceil() as u64;
    Settings {
        seed: args.seed.unwrap_or(default.seed),
        cases_per_region: if effort == 1.0 { cases } else { scaled },
        ..default
    }
}

fn effort(value: Option<&std::ffi::OsStr>) -> Result<f64, Failure> {
    let Some(value) = value else { return Ok(1.0) };
    let text = value.to_string_lossy();
    match Decimal::nearest(&text) {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Failure::new(format!(
            "MECHAUDIT_EFFORT = {text:?} must be a positive number, for instance 0.1 or 10"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;

    #[test]
    fn effort_is_a_positive_number() {
        assert_eq!(effort(None).unwrap(), 1.0);
        assert_eq!(effort(Some("2.5".as_ref())).unwrap(), 2.5);
        for bad in ["", "0", "-1", "nan", "inf", "ten"] {
            assert!(effort(Some(bad.as_ref())).is_err(), "{bad}");
        }
    }

    fn run(words: &[&str]) -> RunArgs {
        let read = Args::try_parse_from([&["mechaudit", "audit"], words].concat());
        match read.unwrap().command {
            Some(Command::Audit(args)) => args.run,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn settings_are_the_usual_ones_but_for_what_is_asked() {
        let of = |words: &[&str], effort: f64| at_effort(&run(words), effort);
        let usual = Settings::default();
        let numbers = |s: Settings| (s.seed, s.cases_per_region);
        assert_eq!(numbers(of(&[], 1.0)), numbers(usual.clone()));
        assert_eq!(numbers(of(&["--seed", "7", "--cases", "3"], 1.0)), (7, 3));
        // Rounded up, and no more than there is.
        for (cases, effort, due) in [
            ("3", 0.1, 1),
            ("30", 0.1, 3),
            ("31", 0.1, 4),
            ("3", 2.0, 6),
            ("9007199254740993", 1.0, 9_007_199_254_740_993),
            ("9007199254740993", 1e30, u64::MAX),
        ] {
            let found = of(&["--cases", cases], effort);
            assert_eq!(found.cases_per_region, due, "{cases} {effort}");
        }
        let most = usual.cases_per_region * 2;
        assert_eq!(of(&[], 2.0).cases_per_region, most);
    }
}
