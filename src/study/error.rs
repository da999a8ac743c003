//! Errors of studies, with the place in the file.

use mechaudit_symbolic::SymbolicError;

/// A place in a text, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Place {
    /// The place of a byte of a text.
    pub fn of(text: &str, at: usize) -> Place {
        let before = &text.as_bytes()[..at.min(text.len())];
        let start = before
            .iter()
            .rposition(|b| *b == b'\n')
            .map_or(0, |k| k + 1);
        Place {
            line: before.iter().filter(|b| **b == b'\n').count() + 1,
            column: String::from_utf8_lossy(&before[start..]).chars().count() + 1,
        }
    }
}

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
    pub fn at(mut self, place: Place) -> StudyError {
        self.place.get_or_insert(place);
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
            write!(f, "line {}, column {}: ", place.line, place.column)?;
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
