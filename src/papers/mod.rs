//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

pub mod andrews;
pub mod file;
pub mod gembara_senyk;
pub mod ledger;
pub mod n_four_bar;
pub mod number;
pub mod pmksweb;
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
use report::{Analysis, Draft, Found, decided, figure, figures, known, recorded, shown};
use std::sync::LazyLock;

/// Called now and then with the phase, how much of it is done, and its whole.
pub type Progress<'a> = &'a (dyn Fn(&str, u64, u64) + Sync);

/// The audit of a paper.
enum Audit {
    /// By the program alone.
    Whole(fn(Progress) -> Result<PaperReport, Undecided>),
    /// By its files, with an analysis for the findings that they state.
    Analysis(fn() -> Result<Analysis, Undecided>),
}

/// A paper that is compiled in.
struct Paper {
    key: &'static str,
    texts: file::Texts,
    audit: Audit,
    motion: Option<fn() -> Motion>,
}

/// The files of a paper in `reference/papers`, the first of which is `paper.toml`.
macro_rules! texts {
    ($key:literal: $($file:literal)*) => {
        &[$(($file, include_str!(concat!("../../reference/papers/", $key, "/", $file)))),*]
    };
}

const PAPERS: &[Paper] = &[
    Paper {
        key: zinchenko::KEY,
        texts: texts!("zinchenko": "paper.toml" "tables.toml" "claims.toml" "dynamics.toml" "spline.toml" "sweep.toml" "numbers.toml" "rates.toml"),
        audit: Audit::Whole(zinchenko::report),
        motion: Some(zinchenko::motion),
    },
    Paper {
        key: gembara_senyk::KEY,
        texts: texts!("gembara-senyk": "paper.toml" "model.toml" "solution.toml" "amplitude.toml" "numbers.toml"),
        audit: Audit::Analysis(gembara_senyk::analysis),
        motion: None,
    },
    Paper {
        key: andrews::KEY,
        texts: texts!("andrews": "paper.toml" "dynamics.toml" "constraints.toml"),
        audit: Audit::Analysis(andrews::analysis),
        motion: None,
    },
    Paper {
        key: n_four_bar::KEY,
        texts: texts!("n-four-bar": "paper.toml"),
        audit: Audit::Analysis(n_four_bar::analysis),
        motion: None,
    },
    Paper {
        key: pmksweb::KEY,
        texts: texts!("pmksweb": "paper.toml"),
        audit: Audit::Analysis(pmksweb::analysis),
        motion: None,
    },
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

/// The files of a paper that is compiled in.
fn file_of_known(key: &str) -> &'static PaperFile {
    file_of(key).expect("a paper that is compiled in")
}

/// Audits the paper of that key; undecided when there is no certified value.
pub fn audit(key: &str, progress: Progress) -> Option<Result<PaperReport, Undecided>> {
    Some(match paper(key)?.audit {
        Audit::Whole(audit) => audit(progress),
        Audit::Analysis(analyse) => file_of_known(key).analysed(analyse, progress),
    })
}

/// The ledger of the paper of that key, decided now.
pub fn ledger_of(key: &str) -> Option<ledger::Ledger> {
    file_of(key).map(PaperFile::ledger)
}

/// The motion of the mechanism of the paper of that key, where it has one.
pub fn motion_of(key: &str) -> Option<Motion> {
    paper(key).and_then(|p| p.motion).map(|motion| motion())
}

/// A paper that an argument names: one that is compiled in, or a folder or file of the user's.
#[derive(Debug)]
pub enum Named {
    /// The key of a paper that is compiled in.
    Key(&'static str),
    /// A paper from files.
    File(Box<PaperFile>),
}

impl Named {
    /// The paper of a key, or the paper in a folder or file; none if the text is neither.
    ///
    /// # Errors
    /// A folder that cannot be read as a paper.
    pub fn open(text: &str) -> Result<Option<Named>, StudyError> {
        if let Some(paper) = paper(text) {
            return Ok(Some(Named::Key(paper.key)));
        }
        let path = std::path::Path::new(text);
        if !path.exists() {
            return Ok(None);
        }
        let file = PaperFile::open(path)?;
        match file.analysis.filter(|key| paper(key).is_none()) {
            Some(key) => Err(StudyError::new(format!(
                "{text}: there is no analysis {key:?}"
            ))),
            None => Ok(Some(Named::File(Box::new(file)))),
        }
    }

    /// The papers that an argument names, each with its own argument: one, as [`Named::open`] has
    /// it, or those in the folders of a folder that is no paper, in the order of their names. None if
    /// it names nothing.
    ///
    /// # Errors
    /// A folder that cannot be read as a paper, and one that holds none.
    pub fn open_all(text: &str) -> Result<Vec<(String, Named)>, StudyError> {
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
            all.extend(Named::open(&text)?.map(|named| (text, named)));
        }
        Ok(all)
    }

    /// Runs the programs under test that the paper names by `by`.
    ///
    /// # Errors
    /// The paper has programs, and there is nothing that may run them.
    pub fn run_by(&self, by: Option<&'static dyn file::Programs>) -> Result<(), StudyError> {
        match (self, by) {
            (Named::File(file), Some(by)) => file.run_by(by),
            (Named::File(file), None) if file.has_programs() => {
                let reason = "solvers of the paper are programs: --exec lets them run";
                return Err(StudyError::new(format!("{}: {reason}", file.citation.key)));
            }
            _ => {}
        }
        Ok(())
    }

    /// The ledger, decided now.
    pub fn ledger(&self) -> ledger::Ledger {
        match self {
            Named::Key(key) => file_of_known(key).ledger(),
            Named::File(file) => file.ledger(),
        }
    }

    /// Audits the paper.
    ///
    /// # Errors
    /// [`Undecided`] if a certified value is undecided.
    pub fn report(&self, progress: Progress) -> Result<PaperReport, Undecided> {
        match self {
            Named::Key(key) => audit(key, progress).expect("a paper that is compiled in"),
            Named::File(file) => match file.analysis.and_then(paper).map(|p| &p.audit) {
                Some(Audit::Analysis(analyse)) => file.analysed(analyse, progress),
                _ => file.report(progress),
            },
        }
    }

    /// The motion of the mechanism of the paper, where it has one.
    pub fn motion(&self) -> Option<Motion> {
        match self {
            Named::Key(key) => motion_of(key),
            Named::File(_) => None,
        }
    }
}

/// The keys of all papers.
pub fn keys() -> Vec<&'static str> {
    PAPERS.iter().map(|p| p.key).collect()
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
