//! The writer of files: a plain file appears whole or not at all, a device or pipe is written as it
//! comes.
//!
//! A file that exists keeps its kind: a symbolic link is followed and its target replaced, a
//! file with several names keeps them, a device or FIFO is written to and never replaced.

pub mod temporary;

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use temporary::Temporary;

/// A place for a report, opened before the work whose results it takes: a place that cannot be
/// written to is refused at once.
pub struct Destination(Target);

enum Target {
    /// A device or a pipe, written as it comes.
    Stream(File),
    /// A new file, or one whose place is taken with its owner and mode.
    Whole(Temporary, PathBuf),
    /// A file that keeps its place: it has other names, is somebody else's, or stands in a folder
    /// that cannot be written. Its content is changed once the new one is whole.
    Content(File, Temporary),
}

impl Destination {
    /// Opens the place of that name.
    ///
    /// # Errors
    /// It is a folder or read-only, or the system refuses.
    pub fn open(path: &Path) -> io::Result<Destination> {
        Target::of(path).map(Destination)
    }

    /// Lets `write` fill the place, and returns what `write` returns. Errors of the place itself
    /// are made an `E` by `refused`.
    ///
    /// ```
    /// use mechaudit::files::Destination;
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("report.txt");
    /// Destination::open(&path)?.write(|out| out.write_all(b"passed"), |e| e)?;
    /// assert_eq!(std::fs::read(&path)?, b"passed");
    /// # Ok::<(), std::io::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of `write`, after which a file is as it was before, and those of the system.
    pub fn write<T, E>(
        self,
        write: impl FnOnce(&mut dyn Write) -> Result<T, E>,
        refused: impl FnOnce(io::Error) -> E,
    ) -> Result<T, E> {
        match self.0 {
            Target::Stream(mut file) => write(&mut file),
            Target::Whole(temporary, path) => {
                let outcome = write(&mut temporary.file())?;
                temporary.persist(&path).map_err(refused)?;
                Ok(outcome)
            }
            Target::Content(mut file, temporary) => {
                let outcome = write(&mut temporary.file())?;
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

/// Returns true if it stands for an open file of a process: `/dev/fd/3`, and where `/dev/stdout`
/// leads.
fn is_descriptor(path: &Path) -> bool {
    let folder = folder(path).canonicalize();
    folder.is_ok_and(|f| f.starts_with("/proc") || f == Path::new("/dev/fd"))
}

#[cfg(all(test, target_os = "linux"))]
mod tests;
