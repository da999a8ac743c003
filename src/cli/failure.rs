//! How a run ends.

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

impl From<csv::Error> for Failure {
    fn from(e: csv::Error) -> Failure {
        match e.into_kind() {
            csv::ErrorKind::Io(e) => e.into(),
            other => Failure::new(format!("cannot write CSV: {other:?}")),
        }
    }
}

impl From<serde_json::Error> for Failure {
    fn from(e: serde_json::Error) -> Failure {
        std::io::Error::from(e).into()
    }
}
