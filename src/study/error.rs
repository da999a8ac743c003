//! Errors of studies, with the place in the file.

pub use mechaudit_symbolic::Place;
use mechaudit_symbolic::SymbolicError;

/// Reason why a text is no study: a file, a place and a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StudyError {
    /// The file, where the study comes from one.
    pub file: Option<String>,
    /// The place, where it is known.
    pub place: Option<Place>,
    /// The rule that is broken, with the value that breaks it.
    pub reason: String,
}

impl StudyError {
    /// A fault without a place.
    pub fn new(reason: impl Into<String>) -> StudyError {
        StudyError {
            file: None,
            place: None,
            reason: reason.into(),
        }
    }

    /// The same fault at a place, unless it has one.
    pub fn at(mut self, place: impl Into<Option<Place>>) -> StudyError {
        self.place = self.place.or(place.into());
        self
    }

    /// The same fault in a file, unless it has one.
    pub fn in_file(mut self, file: &str) -> StudyError {
        self.file.get_or_insert_with(|| file.into());
        self
    }
}

impl std::fmt::Display for StudyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}: ")?;
        }
        if let Some(place) = self.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.reason)
    }
}

impl std::error::Error for StudyError {}

impl From<SymbolicError> for StudyError {
    fn from(error: SymbolicError) -> StudyError {
        StudyError::new(error.to_string())
    }
}
