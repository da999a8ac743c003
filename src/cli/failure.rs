//! How a run ends.

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

/// A run that could not be done.
#[derive(Debug)]
pub enum Failure {
    /// Bad usage or input, or the file system said no: one line for the user.
    Message(String),
    /// The same, with the error it came from.
    Caused(String, Box<dyn Error>),
    /// Nobody reads the output any more.
    ClosedPipe,
}

impl Failure {
    pub fn new(text: impl Into<String>) -> Failure {
        Failure::Message(text.into())
    }

    /// An error whose message says all that there is to say.
    pub fn caused(e: impl Error + 'static) -> Failure {
        Failure::Caused(e.to_string(), e.into())
    }

    /// An error about what a file describes.
    pub fn in_file(file: &Path, e: impl Error + 'static) -> Failure {
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
            _ => Failure::new(format!("cannot write: {e}")),
        }
    }
}

impl From<mechaudit::audit::NoSuch> for Failure {
    fn from(e: mechaudit::audit::NoSuch) -> Failure {
        Failure::new(e.to_string())
    }
}

impl From<mechaudit::report::columns::UnitsError> for Failure {
    fn from(e: mechaudit::report::columns::UnitsError) -> Failure {
        Failure::new(format!("--units: {e}"))
    }
}

impl From<mechaudit::report::svg::CannotDraw> for Failure {
    fn from(e: mechaudit::report::svg::CannotDraw) -> Failure {
        Failure::new(e.to_string())
    }
}

impl From<csv::Error> for Failure {
    fn from(e: csv::Error) -> Failure {
        match e.is_io_error() {
            true => std::io::Error::from(e).into(),
            false => Failure::new(format!("cannot write CSV: {e}")),
        }
    }
}

impl From<serde_json::Error> for Failure {
    fn from(e: serde_json::Error) -> Failure {
        std::io::Error::from(e).into()
    }
}
