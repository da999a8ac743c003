//! The committed atlas: at a small effort, without times.

use crate::cli::files::artefact::{Made, Outcome};
use mechaudit::claims::{Atlas, Code, Effort, PROFILES, Profile, algorithms, atlas};
use mechaudit::report;
use std::sync::OnceLock;

/// Points in each region.
const EFFORT: Effort = Effort {
    cases: 100,
    seed: 1,
};

/// Made once for all files.
fn small() -> &'static Atlas {
    static SMALL: OnceLock<Atlas> = OnceLock::new();
    SMALL.get_or_init(|| untimed(&codes(), &PROFILES, &EFFORT))
}

/// Every algorithm, then those that have single precision in it.
fn codes() -> Vec<Code<'static>> {
    let double = algorithms().into_iter().map(Code::double);
    let single = algorithms().into_iter().filter_map(Code::single);
    double.chain(single).collect()
}

/// Times are not the same from run to run.
fn untimed(codes: &[Code], profiles: &[Profile], effort: &Effort) -> Atlas {
    atlas(codes, profiles, effort, false, &|_| ())
}

fn made(title: &str, body: String) -> Made {
    Made {
        title: title.into(),
        facts: vec![
            ("points in each region", EFFORT.cases.to_string()),
            ("seed", EFFORT.seed.to_string()),
            ("figures", "three significant digits, upper bounds".into()),
        ],
        recipe: format!("{EFFORT:?}\n"),
        body,
    }
}

fn text(write: impl FnOnce(&mut Vec<u8>) -> Result<(), csv::Error>) -> Outcome<String> {
    let mut body = Vec::new();
    write(&mut body)?;
    Ok(String::from_utf8(body)?)
}

/// A line for each code and region.
pub fn rows() -> Outcome<Made> {
    let body = text(|out| report::atlas::rows(small(), out))?;
    Ok(made(
        "Worst relative errors found of published algorithms for W(z) and Voigt",
        body,
    ))
}

/// A line for each claim.
pub fn claims() -> Outcome<Made> {
    let body = text(|out| report::atlas::claims(small(), out))?;
    Ok(made(
        "Claims about published algorithms for W(z) and Voigt, decided",
        body,
    ))
}

/// A line for each code and accuracy.
pub fn heights() -> Outcome<Made> {
    let body = text(|out| report::atlas::heights(small(), out))?;
    Ok(made(
        "Heights Im z from which published algorithms for W(z) and Voigt met an accuracy at all points tried",
        body,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_committed_has_no_times() {
        let code = algorithms().into_iter().map(Code::double).next();
        let effort = Effort { cases: 1, seed: 1 };
        let found = untimed(code.as_slice(), &[], &effort);
        assert_eq!(found.rows.len(), 1);
        assert_eq!(found.rows[0].nanoseconds, None);
    }

    #[test]
    fn every_algorithm_in_each_precision_that_it_has() {
        let (codes, all) = (codes(), algorithms());
        let with_single = all.iter().filter(|a| a.single.is_some());
        let single: Vec<&str> = with_single.map(|a| a.name).collect();
        let double: Vec<&str> = all.iter().map(|a| a.name).collect();
        let named = |single: bool| {
            let some = codes.iter().filter(move |c| c.single == single);
            some.map(|c| c.algorithm.unwrap().name).collect::<Vec<_>>()
        };
        assert_eq!((named(false), named(true)), (double, single));
        assert!(!named(true).is_empty());
    }
}
