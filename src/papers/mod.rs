//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

pub mod andrews;
pub mod file;
pub mod gembara_senyk;
pub mod ledger;
pub mod n_four_bar;
pub mod number;
mod report;
mod several;
pub mod zinchenko;

pub use report::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, SCHEMA_VERSION,
    Subject, Tally, VariantJudgement,
};

pub use file::PaperFile;
pub use several::summary;

use crate::motion::Motion;
use crate::reference::Undecided;
use crate::study::StudyError;
use file::Measured;
use report::{decided, figure, known, shown};
use std::sync::LazyLock;

/// Called now and then with the phase, how much of it is done, and its whole.
pub type Progress<'a> = &'a (dyn Fn(&str, u64, u64) + Sync);

/// A paper that is compiled in.
struct Paper {
    key: &'static str,
    texts: file::Texts,
    /// Measures what findings of its files are about.
    analyse: Option<fn() -> Result<Measured, Undecided>>,
    motion: Option<fn() -> Motion>,
}

/// A paper of `reference/papers` with its files, the first of which is `paper.toml`.
macro_rules! paper {
    ($key:literal, $analyse:expr, $motion:expr; $($file:literal)*) => {
        Paper {
            key: $key,
            texts: &[$(($file, include_str!(concat!("../../reference/papers/", $key, "/", $file)))),*],
            analyse: $analyse,
            motion: $motion,
        }
    };
}

const PAPERS: &[Paper] = &[
    paper!("zinchenko", Some(zinchenko::analysis), Some(zinchenko::motion);
        "paper.toml" "tables.toml" "claims.toml" "dynamics.toml" "spline.toml" "sweep.toml" "numbers.toml" "rates.toml"),
    paper!("gembara-senyk", Some(gembara_senyk::analysis), None;
        "paper.toml" "model.toml" "solution.toml" "amplitude.toml" "numbers.toml"),
    paper!("andrews", Some(andrews::analysis), None; "paper.toml" "dynamics.toml" "constraints.toml"),
    paper!("n-four-bar", Some(n_four_bar::analysis), None; "paper.toml"),
    paper!("pmksweb", None, None; "paper.toml"),
];

fn paper(key: &str) -> Option<&'static Paper> {
    PAPERS.iter().find(|p| p.key == key)
}

/// The files of the paper of that key, read once.
pub fn file_of(key: &str) -> Option<&'static PaperFile> {
    static FILES: LazyLock<Vec<PaperFile>> = LazyLock::new(|| {
        let read =
            |p: &Paper| PaperFile::parse(p.key, p.texts).expect("a paper that is compiled in");
        PAPERS.iter().map(read).collect()
    });
    FILES.iter().find(|file| file.citation.key == key)
}

/// Audits the paper of that key; undecided when there is no certified value.
pub fn audit(key: &str, progress: Progress) -> Option<Result<PaperReport, Undecided>> {
    file_of(key).map(|file| file.report(progress))
}

/// The ledger of the paper of that key, decided now.
pub fn ledger_of(key: &str) -> Option<ledger::Ledger> {
    file_of(key).map(PaperFile::ledger)
}

/// The motion of the mechanism of the paper of that key, where it has one.
pub fn motion_of(key: &str) -> Option<Motion> {
    paper(key).and_then(|p| p.motion).map(|motion| motion())
}

/// The paper of a key, or the paper in a folder or file; none if the text is neither.
///
/// # Errors
/// A folder that cannot be read as a paper.
pub fn open(text: &str) -> Result<Option<PaperFile>, StudyError> {
    let path = std::path::Path::new(text);
    let file = match file_of(text) {
        Some(file) => file.clone(),
        None if path.exists() => PaperFile::open(path)?,
        None => return Ok(None),
    };
    match file
        .analysis
        .filter(|key| paper(key).and_then(|p| p.analyse).is_none())
    {
        Some(key) => Err(StudyError::new(format!(
            "{text}: there is no analysis {key:?}"
        ))),
        None => Ok(Some(file)),
    }
}

/// The papers that an argument names, each with its own argument: one, as [`open`] has it, or those
/// in the folders of a folder that is no paper, in the order of their names. None if it names
/// nothing.
///
/// # Errors
/// A folder that cannot be read as a paper, and one that holds none.
pub fn open_all(text: &str) -> Result<Vec<(String, PaperFile)>, StudyError> {
    let path = std::path::Path::new(text);
    let mut below = Vec::new();
    if paper(text).is_none() && path.is_dir() && !path.join("paper.toml").exists() {
        let folders = std::fs::read_dir(path).into_iter().flatten().flatten();
        let papers = folders.filter(|f| f.path().join("paper.toml").exists());
        below.extend(papers.map(|f| f.path().display().to_string()));
        below.sort();
    }
    if below.is_empty() {
        below.push(text.into());
    }
    let mut all = Vec::new();
    for text in below {
        all.extend(open(&text)?.map(|paper| (text, paper)));
    }
    Ok(all)
}

/// The keys of all papers.
pub fn keys() -> Vec<&'static str> {
    PAPERS.iter().map(|p| p.key).collect()
}

/// The findings of that paper on what was measured alone.
#[cfg(test)]
fn on_figures(key: &str, measured: &Measured) -> Vec<Finding> {
    let file = file_of(key).unwrap();
    let ledger = ledger::Ledger::of(Citation::default(), &[]);
    let own = file.stated.iter().filter(|s| !s.is_on_ledger());
    own.map(|s| s.finding(&ledger, measured)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn papers_are_found_by_their_keys() {
        let keys = keys();
        assert_eq!(
            keys,
            [
                "zinchenko",
                "gembara-senyk",
                "andrews",
                "n-four-bar",
                "pmksweb"
            ]
        );
        let moving: Vec<&&str> = keys.iter().filter(|key| motion_of(key).is_some()).collect();
        assert_eq!(moving, [&"zinchenko"]);
        assert_eq!(ledger_of("pmksweb").unwrap().paper.key, "pmksweb");
        assert!(
            audit("none", &|_, _, _| {}).is_none()
                && ledger_of("none").is_none()
                && motion_of("none").is_none()
        );
    }
}
