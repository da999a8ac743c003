//! Outcomes and failures of a run.

use crate::cli::complain;
use mechaudit::audit::did_you_mean;
use std::error::Error;
use std::fmt;
use std::path::Path;

/// A run that came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything as expected.
    AsExpected,
    /// An accuracy finding that is not a recorded one, or an undecided digit.
    Finding,
    /// The user ended it; what was done until then is reported.
    Interrupted,
}

impl Outcome {
    pub fn of(good: bool) -> Outcome {
        if good {
            Outcome::AsExpected
        } else {
            Outcome::Finding
        }
    }

    /// Says how many values stayed undecided; any is a finding.
    pub fn decided(undecided: usize, digits: u32) -> Outcome {
        if undecided > 0 {
            complain(&format!(
                "undecided: {undecided} {} could not be certified to {digits} digits",
                if undecided == 1 { "value" } else { "values" }
            ));
        }
        Outcome::of(undecided == 0)
    }

    pub fn unless_interrupted(interrupted: bool, good: bool) -> Outcome {
        match interrupted {
            true => Outcome::Interrupted,
            false => Outcome::of(good),
        }
    }
}

/// An error and its causes on one line. A cause that the message before it quotes is not repeated.
pub fn chain(e: &dyn Error) -> String {
    let mut text = e.to_string();
    let mut next = e.source();
    while let Some(cause) = next {
        let why = cause.to_string();
        // Diagrams over several lines say where, which the error above them has said.
        if !text.contains(&why) && !why.contains('\n') {
            text += &format!(": {why}");
        }
        next = cause.source();
    }
    text
}

/// A run that could not be done.
#[derive(Debug)]
pub enum Failure {
    /// Bad usage or input, or the file system said no: one line for the user.
    Message(String),
    /// The same, with the error it came from.
    Caused(String, Box<dyn Error + Send + Sync>),
    /// Nobody reads the output any more.
    ClosedPipe,
}

impl Failure {
    pub fn new(text: impl Into<String>) -> Failure {
        Failure::Message(text.into())
    }

    /// An error with all that caused it.
    pub fn caused(e: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        let e = e.into();
        Failure::Caused(chain(&*e), e)
    }

    /// What cannot be done to a file or folder: "read", "write".
    pub fn cannot(act: &str, path: &Path, e: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure::caused(e).about(format!("cannot {act} {}", path.display()))
    }

    /// An error about what a file describes.
    pub fn in_file(file: &Path, e: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure::caused(e).about(file.display())
    }

    /// The same, said of something.
    pub fn about(self, what: impl fmt::Display) -> Failure {
        match self {
            Failure::Message(text) => Failure::Message(format!("{what}: {text}")),
            Failure::Caused(text, e) => Failure::Caused(format!("{what}: {text}"), e),
            Failure::ClosedPipe => Failure::ClosedPipe,
        }
    }

    /// A name that there is not.
    pub fn no_such(what: &str, name: &str, known: &[&str]) -> Failure {
        let (meant, known) = (did_you_mean(name, known), known.join(", "));
        Failure::new(format!(
            "there is no {what} {name:?}{meant}; there are: {known}"
        ))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Failure::Message(text) | Failure::Caused(text, _) => f.write_str(text),
            Failure::ClosedPipe => f.write_str("nobody reads the output"),
        }
    }
}

impl Error for Failure {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Failure::Caused(_, e) => Some(&**e),
            Failure::Message(_) | Failure::ClosedPipe => None,
        }
    }
}

impl From<std::io::Error> for Failure {
    fn from(e: std::io::Error) -> Failure {
        match e.kind() {
            std::io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::caused(e).about("cannot write"),
        }
    }
}

impl From<mechaudit::audit::NoSuch> for Failure {
    fn from(e: mechaudit::audit::NoSuch) -> Failure {
        Failure::caused(e)
    }
}

impl From<mechaudit::report::columns::UnitsError> for Failure {
    fn from(e: mechaudit::report::columns::UnitsError) -> Failure {
        Failure::caused(e).about("--units")
    }
}

impl From<mechaudit::report::svg::CannotDraw> for Failure {
    fn from(e: mechaudit::report::svg::CannotDraw) -> Failure {
        Failure::caused(e)
    }
}

impl From<csv::Error> for Failure {
    fn from(e: csv::Error) -> Failure {
        match e.is_io_error() {
            true => std::io::Error::from(e).into(),
            false => Failure::caused(e).about("cannot write CSV"),
        }
    }
}

impl From<serde_json::Error> for Failure {
    fn from(e: serde_json::Error) -> Failure {
        std::io::Error::from(e).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::reference::HexFloat;

    #[derive(Debug, thiserror::Error)]
    #[error("line {0}")]
    struct OnLine(u64, #[source] Box<dyn Error + Send + Sync>);

    #[test]
    fn failures_tell_their_causes_once() {
        let cause = HexFloat::parse("0x").unwrap_err();
        let why = cause.to_string();
        let failure = Failure::caused(OnLine(3, Box::new(cause))).about("inputs");
        assert_eq!(failure.to_string(), format!("inputs: line 3: {why}"));
        assert!(failure.source().and_then(Error::source).is_some());
        let quoted = OnLine(3, "on line 3, line 3".into());
        assert_eq!(chain(&quoted), "line 3: on line 3, line 3");
        assert_eq!(
            chain(&OnLine(3, Box::new(OnLine(3, "x".into())))),
            "line 3: x"
        );
    }
}
