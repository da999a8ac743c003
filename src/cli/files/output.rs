//! Where reports go: standard output, a plain file that appears whole or not at all, or anything else
//! that can be written to.

use crate::cli::args::TextOrJson;
use crate::cli::failure::Failure;
use crate::cli::files::temporary::Temporary;
use anstream::StripStream;
use serde::Serialize;
use serde_json::Value;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

/// Opened before the work whose results it takes: what cannot be written is refused at once.
pub struct Output {
    target: Target,
    /// As the user calls it.
    name: PathBuf,
}

enum Target {
    Standard,
    /// A device, a pipe: written as it comes.
    Stream(File),
    /// A new file, or one whose place is taken with its owner and mode.
    Whole(Temporary, PathBuf),
    /// A file that keeps its place: it has other names, is somebody else's, or stands in a folder
    /// that cannot be written. Its content is changed once the new one is whole.
    Content(File, Temporary),
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

/// What is said in the form asked for.
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
        let name = target.unwrap_or(Path::new("-"));
        let refused = |e: io::Error| Failure::cannot("write", name, e);
        let target = match name == Path::new("-") {
            true => Target::Standard,
            false => Target::of(name).map_err(refused)?,
        };
        let name = name.into();
        Ok(Output { target, name })
    }

    /// A file of a folder, which is made if missing.
    pub fn within(folder: &Path, file: &str) -> Result<Output, Failure> {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::cannot("make the folder", folder, e))?;
        Output::open(Some(&folder.join(file)))
    }

    pub fn is_standard(&self) -> bool {
        matches!(self.target, Target::Standard)
    }

    /// Fills it with that text.
    pub fn text(self, text: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.write(|out| Ok(out.write_all(text.as_ref())?))
    }

    /// Lets `write` fill it; gives what `write` gives.
    pub fn write<T>(
        self,
        write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let refused = |e: io::Error| match e.kind() {
            // Nobody reads it any more.
            io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::cannot("write", &self.name, e),
        };
        match self.target {
            Target::Standard => filled(anstream::stdout().lock(), write, Failure::from),
            Target::Stream(file) => filled(StripStream::new(file), write, refused),
            Target::Whole(temporary, path) => {
                let outcome = fill(&temporary, write)?;
                temporary.persist(&path).map_err(refused)?;
                Ok(outcome)
            }
            Target::Content(mut file, temporary) => {
                let outcome = fill(&temporary, write)?;
                let mut whole = temporary.file();
                let mut copy = || {
                    whole.rewind()?;
                    file.set_len(0)?;
                    io::copy(&mut whole, &mut file)?;
                    file.sync_all()
                };
                copy().map_err(refused)?;
                Ok(outcome)
            }
        }
    }
}

fn fill<T>(
    temporary: &Temporary,
    write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let file = temporary.file().try_clone()?;
    filled(StripStream::new(file), write, Failure::from)
}

/// Lets `write` fill it to its end, which is `refused` if it cannot be written.
fn filled<T>(
    to: impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>,
    refused: impl FnOnce(io::Error) -> Failure,
) -> Result<T, Failure> {
    let mut out = BufWriter::new(to);
    let outcome = write(&mut out)?;
    out.flush().map_err(refused)?;
    Ok(outcome)
}

impl Target {
    fn of(name: &Path) -> io::Result<Target> {
        let path = followed(name)?;
        let known = match path.metadata() {
            Ok(known) => known,
            Err(e) if e.kind() == io::ErrorKind::NotFound => {
                let new = Temporary::new(folder(&path), 0o666)?;
                return Ok(Target::Whole(new, path));
            }
            Err(e) => return Err(e),
        };
        if known.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if is_descriptor(&path) {
            // A file may hold something before.
            return Ok(Target::Stream(OpenOptions::new().append(true).open(path)?));
        }
        // A superuser could write it all the same.
        if known.is_file() && known.permissions().readonly() {
            return Err(io::Error::other("it is read-only"));
        }
        let file = OpenOptions::new().write(true).open(&path)?;
        if !known.is_file() {
            return Ok(Target::Stream(file));
        }
        Ok(match in_its_place(&path, &known) {
            Some(temporary) => Target::Whole(temporary, path),
            None => {
                let anywhere = Temporary::new(&std::env::temp_dir(), 0o600)?;
                Target::Content(file, anywhere)
            }
        })
    }
}

/// A file that can take a known one's place: beside it, with the same owner and mode.
fn in_its_place(path: &Path, known: &Metadata) -> Option<Temporary> {
    // Nobody else may read it before it has the mode.
    let temporary = Temporary::new(folder(path), 0o600).ok()?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let own = temporary.file().metadata().ok()?;
        let owner = |m: &Metadata| (m.uid(), m.gid());
        if known.nlink() > 1 {
            return None;
        }
        if owner(&own) != owner(known) {
            fchown(temporary.file(), Some(known.uid()), Some(known.gid())).ok()?;
        }
    }
    let kept = temporary.file().set_permissions(known.permissions());
    kept.ok().map(|()| temporary)
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
}

/// Links that a path may lead through, as systems have it.
const LINKS: usize = 40;

/// Where symbolic links lead, also if nothing is there yet.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    // One more look tells that the last of them leads to no other.
    for _ in 0..=LINKS {
        if is_descriptor(&path) {
            return Ok(path);
        }
        match path.read_link() {
            Ok(to) => path = folder(&path).join(to),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether it stands for an open file of a process: `/dev/fd/3`, and where `/dev/stdout` leads.
fn is_descriptor(path: &Path) -> bool {
    let folder = folder(path).canonicalize();
    folder.is_ok_and(|f| f.starts_with("/proc") || f == Path::new("/dev/fd"))
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    /// As many links are followed as by the system, and no more.
    #[test]
    fn links_are_followed_as_the_system_does() {
        let folder = tempfile::tempdir().unwrap();
        let at = |k: usize| folder.path().join(k.to_string());
        std::fs::write(at(0), "").unwrap();
        for k in 1..=LINKS + 1 {
            symlink(at(k - 1), at(k)).unwrap();
            let found = followed(&at(k));
            assert_eq!(found.is_ok(), File::open(at(k)).is_ok(), "{k} links");
            assert_eq!(found.is_ok(), k <= LINKS, "{k} links");
            assert!(found.is_err() || found.unwrap() == at(0));
        }
    }

    fn written(name: &Path, text: &str) {
        Output::open(Some(name)).unwrap().text(text).unwrap();
    }

    #[test]
    fn a_folder_is_the_part_before_the_name() {
        for (path, due) in [("a/b", "a"), ("/a", "/"), ("a", "."), ("a/b/c", "a/b")] {
            assert_eq!(folder(Path::new(path)), Path::new(due));
        }
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
    fn a_shorter_content_takes_the_place_of_a_longer_one() {
        let folder = tempfile::tempdir().unwrap();
        let [file, other] = ["file", "other"].map(|n| folder.path().join(n));
        std::fs::write(&file, "something long").unwrap();
        std::fs::hard_link(&file, &other).unwrap();
        written(&file, "short");
        assert_eq!(std::fs::read_to_string(&other).unwrap(), "short");
        std::fs::remove_file(&other).unwrap();
        written(&file, "new");
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "new");
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

    /// Whatever stands for an open file of a process is no file of a folder.
    #[test]
    fn descriptors_are_known_by_their_folder() {
        for (path, due) in [
            ("/dev/fd/1", true),
            ("/proc/self/fd/1", true),
            ("/dev/null", false),
            ("/tmp/file", false),
        ] {
            assert_eq!(is_descriptor(Path::new(path)), due, "{path}");
        }
    }
}
