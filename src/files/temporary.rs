//! Files under way: they have no name until they are whole, where the system can do that; elsewhere
//! they have a temporary name.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use tempfile::{Builder, NamedTempFile, TempPath};

/// Called before a file gets a temporary name.
static BEFORE_NAMES: OnceLock<fn()> = OnceLock::new();
/// Files with a temporary name, which no end of the program may leave behind.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn all_unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Has `listen` called before a file gets a temporary name: by a program that removes those files
/// when a signal ends it. The first call counts.
pub fn before_names(listen: fn()) {
    let _ = BEFORE_NAMES.set(listen);
}

/// Removes the files that are under way: for a program that a signal ends.
pub fn remove_unfinished() {
    for path in all_unfinished().drain(..) {
        let _ = std::fs::remove_file(path);
    }
}

/// A temporary name in the list of those to be removed, as long as it lives.
struct Unfinished(PathBuf);

impl Unfinished {
    fn new(path: &Path) -> Unfinished {
        if let Some(listen) = BEFORE_NAMES.get() {
            listen();
        }
        all_unfinished().push(path.into());
        Unfinished(path.into())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        all_unfinished().retain(|p| *p != self.0);
    }
}

/// A file of a folder that nobody else sees yet.
pub struct Temporary {
    file: File,
    folder: PathBuf,
    /// Its temporary name, if it has one.
    name: Option<(TempPath, Unfinished)>,
}

impl Temporary {
    /// Makes one with those permissions, less the umask.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub fn new(folder: &Path, mode: u32) -> io::Result<Temporary> {
        #[cfg(target_os = "linux")]
        if let Some(file) = unnamed(folder, mode) {
            return Ok(Temporary {
                file,
                folder: folder.into(),
                name: None,
            });
        }
        Temporary::named(folder, mode)
    }

    /// With a temporary name from the start.
    fn named(folder: &Path, mode: u32) -> io::Result<Temporary> {
        let (file, name) = at_free_name(folder, |path| {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create_new(true);
            #[cfg(unix)]
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, mode);
            #[cfg(not(unix))]
            let _ = mode;
            options.open(path)
        })?;
        Ok(Temporary {
            file,
            folder: folder.into(),
            name: Some(name),
        })
    }

    /// The file, to be written to.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Gives it its name, in the place of whatever has it.
    ///
    /// # Errors
    /// The file cannot be written to its end, or the name cannot be given.
    pub fn persist(self, path: &Path) -> io::Result<()> {
        self.file.sync_all()?;
        let (name, unfinished) = match self.name {
            Some(named) => named,
            // A link takes no other file's place, so it takes a detour.
            None => match link(&self.file, path) {
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {
                    at_free_name(&self.folder, |free| link(&self.file, free))?.1
                }
                done => return done,
            },
        };
        name.persist(path).map_err(|e| e.error)?;
        drop(unfinished);
        Ok(())
    }
}

/// Makes something under a free temporary name, which goes with the program.
fn at_free_name<T>(
    folder: &Path,
    mut make: impl FnMut(&Path) -> io::Result<T>,
) -> io::Result<(T, (TempPath, Unfinished))> {
    // The error that tempfile gives names the temporary file, which means nothing to anybody.
    let mut code = None;
    let made = Builder::new()
        .prefix(".mechaudit-")
        .make_in(folder, |path| {
            let unfinished = Unfinished::new(path);
            let made = make(path).inspect_err(|e| code = e.raw_os_error());
            Ok((made?, unfinished))
        });
    let made = made.map_err(|e| code.map_or(e, io::Error::from_raw_os_error));
    let ((made, unfinished), name) = made.map(NamedTempFile::into_parts)?;
    Ok((made, (name, unfinished)))
}

/// A file without a name that can be given one later.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path, mode: u32) -> Option<File> {
    use std::os::unix::fs::OpenOptionsExt;
    // The name is given by way of this folder.
    if !Path::new(DESCRIPTORS).is_dir() {
        return None;
    }
    let flags = rustix::fs::OFlags::TMPFILE.bits().cast_signed();
    let mut options = OpenOptions::new();
    options.read(true).write(true).mode(mode);
    options.custom_flags(flags).open(folder).ok()
}

#[cfg(target_os = "linux")]
const DESCRIPTORS: &str = "/proc/self/fd";

/// Gives a file a name that is free.
#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let own = format!("{DESCRIPTORS}/{}", file.as_raw_fd());
    Ok(linkat(CWD, own, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    /// Where there are no files without a name.
    #[test]
    fn a_temporary_name_goes_with_the_program() {
        let folder = tempfile::tempdir().unwrap();
        let names = || std::fs::read_dir(folder.path()).unwrap().count();
        let left = Temporary::named(folder.path(), 0o600).unwrap();
        assert_eq!(names(), 1);
        remove_unfinished();
        assert_eq!(names(), 0);
        drop(left);
        let whole = Temporary::named(folder.path(), 0o666).unwrap();
        whole.file().write_all(b"all").unwrap();
        let path = folder.path().join("file");
        whole.persist(&path).unwrap();
        // A file that is whole stays.
        remove_unfinished();
        assert_eq!(std::fs::read(&path).unwrap(), b"all");
        assert_eq!(names(), 1);
    }

    /// Nobody sees a file before it is whole, also where it takes another's place.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_under_way_has_no_name() {
        use rustix::fs::{Mode, OFlags, open};
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let flags = OFlags::TMPFILE | OFlags::WRONLY;
        if open(folder, flags, Mode::RUSR).is_err() {
            // Not on every file system.
            return;
        }
        let names = || std::fs::read_dir(folder).unwrap().count();
        let path = folder.join("file");
        for (before, text) in [(0, "first"), (1, "second")] {
            let new = Temporary::new(folder, 0o666).unwrap();
            new.file().write_all(text.as_bytes()).unwrap();
            assert_eq!(names(), before);
            new.persist(&path).unwrap();
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
            assert_eq!(names(), 1);
        }
    }
}
