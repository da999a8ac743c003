//! Outcomes and failures of a run.

use crate::cli::complain;
use mechaudit::audit::did_you_mean;
use mechaudit::message::readable;
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

    /// Turns what is as expected into a finding.
    pub fn or_finding(self) -> Outcome {
        match self {
            Outcome::AsExpected => Outcome::Finding,
            other => other,
        }
    }

    pub fn unless_interrupted(interrupted: bool, good: bool) -> Outcome {
        match interrupted {
            true => Outcome::Interrupted,
            false => Outcome::of(good),
        }
    }
}

/// An error and its causes on one line, long numbers in exponent form. A cause that the message
/// before it quotes is not repeated.
pub fn chain(e: &dyn Error) -> String {
    let mut text = e.to_string();
    let mut next = e.source();
    while let Some(cause) = next {
        let why = cause.to_string();
        let last = text.rsplit(": ").next().unwrap_or_default();
        // Diagrams over several lines say where, which the error above them has said.
        if !text.contains(&why) && !why.contains('\n') {
            match last.contains(' ') && why.starts_with(last) {
                // The same with more words.
                true => text.replace_range(text.len() - last.len().., &why),
                false => text += &format!(": {why}"),
            }
        }
        next = cause.source();
    }
    readable(&text).into_owned()
}

/// Puts what an error is about before its text, unless that says so itself.
pub fn said(what: &str, e: &dyn Error) -> String {
    let text = chain(e);
    match text.contains(what) {
        true => text,
        false => format!("{what}: {text}"),
    }
}

/// A run that could not be done.
#[derive(Debug)]
pub enum Failure {
    /// Bad usage or input, or the file system said no: one line for the user.
    Message(String),
    /// The same, with the error it came from.
    Caused(String, Box<dyn Error + Send + Sync>),
    /// The output named there cannot be written. It is about no input.
    Output(String, std::io::Error),
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

    /// An output that cannot be written.
    pub fn output(name: &Path, e: std::io::Error) -> Failure {
        match e.kind() {
            std::io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::Output(format!("cannot write {}: {e}", name.display()), e),
        }
    }

    /// Creates the failure to "read" or "write" a file or folder.
    pub fn cannot(act: &str, path: &Path, e: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure::caused(e).about(format!("cannot {act} {}", path.display()))
    }

    /// An error about what a file describes.
    pub fn in_file(file: &Path, e: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure::caused(e).about(file.display())
    }

    /// The same, said of something; once, if it says so itself.
    pub fn about(self, what: impl fmt::Display) -> Failure {
        if self.to_string().starts_with(&format!("{what}: ")) {
            return self;
        }
        match self {
            Failure::Message(text) => Failure::Message(format!("{what}: {text}")),
            Failure::Caused(text, e) => Failure::Caused(format!("{what}: {text}"), e),
            Failure::Output(..) | Failure::ClosedPipe => self,
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
            Failure::Message(text) | Failure::Caused(text, _) | Failure::Output(text, _) => {
                f.write_str(text)
            }
            Failure::ClosedPipe => f.write_str("nobody reads the output"),
        }
    }
}

impl Error for Failure {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Failure::Caused(_, e) => Some(&**e),
            Failure::Output(_, e) => Some(e),
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

impl From<csv::Error> for Failure {
    fn from(e: csv::Error) -> Failure {
        match e.kind() {
            csv::ErrorKind::Io(why) if why.kind() == std::io::ErrorKind::BrokenPipe => {
                Failure::ClosedPipe
            }
            csv::ErrorKind::Io(_) => Failure::caused(e).about("cannot write"),
            _ => Failure::caused(e).about("cannot write CSV"),
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
        let more = OnLine(3, "line 3 is the end of the file".into());
        assert_eq!(chain(&more), "line 3 is the end of the file");
        assert_eq!(
            chain(&OnLine(3, Box::new(OnLine(3, "x".into())))),
            "line 3: x"
        );
    }

    #[test]
    fn an_outcome_is_of_what_was_found() {
        assert_eq!(
            [Outcome::of(true), Outcome::of(false)],
            [Outcome::AsExpected, Outcome::Finding]
        );
        for (interrupted, good, due) in [
            (false, true, Outcome::AsExpected),
            (false, false, Outcome::Finding),
            (true, true, Outcome::Interrupted),
            (true, false, Outcome::Interrupted),
        ] {
            assert_eq!(Outcome::unless_interrupted(interrupted, good), due);
        }
        for (undecided, due) in [
            (0, Outcome::AsExpected),
            (1, Outcome::Finding),
            (2, Outcome::Finding),
        ] {
            assert_eq!(Outcome::decided(undecided, 30), due);
        }
    }

    /// A closed pipe is no failure; other errors of files are printed.
    #[test]
    fn a_closed_pipe_is_quiet() {
        use std::io::{Error as Io, ErrorKind};
        let pipe = || Io::from(ErrorKind::BrokenPipe);
        let full = || Io::from(ErrorKind::StorageFull);
        let why = full().to_string();
        assert!(matches!(Failure::from(pipe()), Failure::ClosedPipe));
        assert_eq!(
            Failure::from(full()).to_string(),
            format!("cannot write: {why}")
        );
        assert!(matches!(
            Failure::from(csv::Error::from(pipe())),
            Failure::ClosedPipe
        ));
        assert_eq!(
            Failure::from(csv::Error::from(full())).to_string(),
            format!("cannot write: {why}")
        );
        let json = |e: Io| {
            struct Bad(Option<Io>);
            impl std::io::Write for Bad {
                fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
                    Err(self.0.take().expect("one write"))
                }
                fn flush(&mut self) -> std::io::Result<()> {
                    Ok(())
                }
            }
            Failure::from(serde_json::to_writer(Bad(Some(e)), &1).unwrap_err())
        };
        assert!(matches!(json(pipe()), Failure::ClosedPipe));
        assert!(json(full()).to_string().starts_with("cannot write: "));
        let mut rows = csv::WriterBuilder::new().from_writer(Vec::new());
        rows.write_record(["a", "b"]).unwrap();
        let uneven = rows.write_record(["a"]).unwrap_err();
        let text = Failure::from(uneven).to_string();
        assert!(text.starts_with("cannot write CSV: "), "{text}");
    }

    #[test]
    fn a_failure_is_said_of_something() {
        let file = Path::new("some/file");
        let cause = || std::io::Error::other("gone");
        assert_eq!(
            Failure::cannot("read", file, cause()).to_string(),
            "cannot read some/file: gone"
        );
        assert_eq!(
            Failure::in_file(file, cause()).to_string(),
            "some/file: gone"
        );
        assert_eq!(Failure::new("no").about("it").to_string(), "it: no");
        assert_eq!(
            Failure::new("no").about("it").about("it").to_string(),
            "it: no"
        );
        // An output is about no input.
        let full = std::io::Error::from(std::io::ErrorKind::StorageFull);
        let output = Failure::output(Path::new("out"), full).about("input");
        assert!(
            output.to_string().starts_with("cannot write out: "),
            "{output}"
        );
        assert!(Failure::new("no").source().is_none());
        assert!(matches!(
            Failure::ClosedPipe.about("it"),
            Failure::ClosedPipe
        ));
        assert_eq!(Failure::ClosedPipe.to_string(), "nobody reads the output");
        let none = Failure::no_such("thing", "abd", &["abc", "xyz"]).to_string();
        assert_eq!(
            none,
            "there is no thing \"abd\" (did you mean \"abc\"?); there are: abc, xyz"
        );
    }

    /// A diagram over several lines is left to the error above it.
    #[test]
    fn causes_are_on_one_line() {
        let diagram = OnLine(1, Box::new(OnLine(2, "a\nb".into())));
        assert_eq!(chain(&diagram), "line 1: line 2");
        let long = OnLine(1, Box::new(OnLine(2, Box::new(OnLine(3, "x".into())))));
        assert_eq!(chain(&long), "line 1: line 2: line 3: x");
    }
}
