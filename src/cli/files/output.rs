//! Where reports go: standard output, or the destination that `--output` and its like name.

use crate::cli::args::TextOrJson;
use crate::cli::failure::Failure;
use crate::cli::process::interrupt;
use anstream::adapter::StripBytes;
use anstream::{AutoStream, ColorChoice};
use mechaudit::files::Destination;
use mechaudit::files::temporary::before_names;
use serde::Serialize;
use serde_json::Value;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Opened before the work whose results it takes: what cannot be written is refused at once.
pub struct Output {
    /// Standard output, if there is none.
    destination: Option<Destination>,
    /// As the user calls it.
    name: PathBuf,
}

/// Lets `write` write to standard output.
pub fn write_to(write: impl FnOnce(&mut dyn Write) -> Result<(), Failure>) -> Result<(), Failure> {
    Output::open(None)?.write(write)
}

/// A text to standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    Output::open(None)?.text(text)
}

/// JSON to standard output or a file.
pub fn write_json(output: Output, value: &impl Serialize) -> Result<(), Failure> {
    output.write(|out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        Ok(writeln!(out)?)
    })
}

pub fn print_json(value: &Value) -> Result<(), Failure> {
    write_json(Output::open(None)?, value)
}

/// Prints a text or a JSON value, in the selected form.
pub fn print_as(
    format: TextOrJson,
    text: impl FnOnce() -> String,
    json: impl FnOnce() -> Value,
) -> Result<(), Failure> {
    match format {
        TextOrJson::Text => print(&text()),
        TextOrJson::Json => print_json(&json()),
    }
}

impl Output {
    /// Standard output for nothing and for `-`.
    pub fn open(target: Option<&Path>) -> Result<Output, Failure> {
        let Some(name) = target.filter(|n| *n != Path::new("-")) else {
            return Ok(Output {
                destination: None,
                name: "standard output".into(),
            });
        };
        // A signal must not leave an unfinished file behind.
        before_names(interrupt::listen);
        let opened = Destination::open(name).map_err(|e| Failure::output(name, e))?;
        Ok(Output {
            destination: Some(opened),
            name: name.into(),
        })
    }

    /// A file of a folder, which is made if missing.
    pub fn within(folder: &Path, file: &str) -> Result<Output, Failure> {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::cannot("make the folder", folder, e))?;
        Output::open(Some(&folder.join(file)))
    }

    pub fn is_standard(&self) -> bool {
        self.destination.is_none()
    }

    /// Fills it with that text.
    pub fn text(self, text: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.write(|out| Ok(out.write_all(text.as_ref())?))
    }

    /// Lets `write` fill it; gives what `write` gives. Whatever `write` makes of an error of the
    /// output, the failure names the output and that error.
    pub fn write<T>(
        self,
        write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let name = &self.name;
        let refused = |e: io::Error| Failure::output(name, e);
        match self.destination {
            None => match AutoStream::choice(&io::stdout()) {
                ColorChoice::Never => filled(Plain::new(&mut io::stdout().lock()), write, refused),
                _ => filled(anstream::stdout().lock(), write, refused),
            },
            Some(destination) => {
                destination.write(|out| filled(Plain::new(out), write, refused), refused)
            }
        }
    }
}

/// Bytes that are written at once: as many as a pipe takes on Linux.
const BUFFER: usize = 1 << 16;

/// Lets `write` fill it to its end; an error of `to` is `refused`.
fn filled<T>(
    to: impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
    refused: impl FnOnce(io::Error) -> Failure,
) -> Result<T, Failure> {
    let mut out = BufWriter::with_capacity(BUFFER, Noting { to, error: None });
    let outcome = write(&mut out);
    let flushed = out.flush();
    if let Some(e) = out.get_mut().error.take() {
        return Err(refused(e));
    }
    flushed.map_err(refused)?;
    outcome
}

/// A writer that leaves colours out.
struct Plain<'a> {
    to: &'a mut dyn Write,
    state: StripBytes,
}

impl Plain<'_> {
    fn new(to: &mut dyn Write) -> Plain<'_> {
        let state = StripBytes::new();
        Plain { to, state }
    }
}

impl Write for Plain<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Nothing begins or goes on in them that is left out.
        let plain = |all: bool, b: &u8| all & (matches!(b, b' '..=b'~') | (*b == b'\n'));
        if bytes.iter().fold(true, plain) && self.state == StripBytes::default() {
            self.to.write_all(bytes)?;
            return Ok(bytes.len());
        }
        for printable in self.state.strip_next(bytes) {
            self.to.write_all(printable)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// A writer that keeps its first error, which whoever writes may call by another name.
struct Noting<W> {
    to: W,
    error: Option<io::Error>,
}

impl<W> Noting<W> {
    fn noted<T>(&mut self, done: io::Result<T>) -> io::Result<T> {
        done.inspect_err(|e| {
            let passing = e.kind() == io::ErrorKind::Interrupted;
            if self.error.is_none() && !passing {
                self.error = Some(match e.raw_os_error() {
                    Some(code) => io::Error::from_raw_os_error(code),
                    None => io::Error::new(e.kind(), e.to_string()),
                });
            }
        })
    }
}

impl<W: Write> Write for Noting<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let done = self.to.write(bytes);
        self.noted(done)
    }

    fn flush(&mut self) -> io::Result<()> {
        let done = self.to.flush();
        self.noted(done)
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    fn written(name: &Path, text: &str) {
        Output::open(Some(name)).unwrap().text(text).unwrap();
    }

    #[test]
    fn nothing_and_a_hyphen_are_standard_output() {
        let standard =
            |name: Option<&str>| Output::open(name.map(Path::new)).unwrap().is_standard();
        assert!(standard(None) && standard(Some("-")));
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("-");
        assert!(!Output::open(Some(&file)).unwrap().is_standard());
    }

    /// All of it or nothing.
    #[test]
    fn a_file_appears_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        let broken = Output::open(Some(&file)).unwrap();
        let result: Result<(), Failure> = broken.write(|out| {
            write!(out, "half")?;
            Err(Failure::new("stop"))
        });
        assert_eq!(result.unwrap_err().to_string(), "stop");
        assert!(!file.exists());
        written(&file, "one");
        let value = Output::open(Some(&file)).unwrap().write(|out| {
            write!(out, "\u{1b}[1mtwo\u{1b}[0m")?;
            Ok(7)
        });
        assert_eq!(value.unwrap(), 7);
        assert_eq!(
            std::fs::read_to_string(&file).unwrap(),
            "two",
            "without colours"
        );
        let json = Output::open(Some(&file)).unwrap();
        write_json(json, &serde_json::json!({ "a": 1 })).unwrap();
        assert_eq!(
            std::fs::read_to_string(&file).unwrap(),
            "{\n  \"a\": 1\n}\n"
        );
        let names = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(names, 1);
    }

    #[test]
    fn folders_are_made_where_they_are_missing() {
        let root = tempfile::tempdir().unwrap();
        let deep = root.path().join("a/b");
        Output::within(&deep, "file").unwrap().text("x").unwrap();
        assert_eq!(std::fs::read_to_string(deep.join("file")).unwrap(), "x");
        let blocked = Output::within(&deep.join("file"), "y")
            .map(|_| ())
            .unwrap_err();
        assert!(
            blocked.to_string().starts_with("cannot make the folder "),
            "{blocked}"
        );
        let taken = Output::open(Some(&deep)).map(|_| ()).unwrap_err();
        let due = format!("cannot write {}: it is a folder", deep.display());
        assert_eq!(taken.to_string(), due);
    }
}
