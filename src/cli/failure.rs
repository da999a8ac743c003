//! How a run ends.

use mechaudit::audit::did_you_mean;

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
    /// Nobody reads the output any more.
    ClosedPipe,
}

impl Failure {
    pub fn new(text: impl Into<String>) -> Failure {
        Failure::Message(text.into())
    }

    /// A name that there is not.
    pub fn no_such(what: &str, name: &str, known: &[&str]) -> Failure {
        let (meant, known) = (did_you_mean(name, known), known.join(", "));
        Failure::new(format!(
            "there is no {what} {name:?}{meant}; there are: {known}"
        ))
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
