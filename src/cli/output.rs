//! Where reports go: standard output, or a file that appears whole or not at all.

use super::failure::Failure;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Lets `write` fill standard output, or the file `target`.
///
/// A file is written under a temporary name in the same folder and renamed at the end.
pub fn write_to(
    target: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let Some(path) = target else {
        let mut out = BufWriter::new(anstream::stdout().lock());
        write(&mut out)?;
        return Ok(out.flush()?);
    };
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    let refused = |e: std::io::Error| Failure::new(format!("cannot write {}: {e}", path.display()));
    if path.is_dir() {
        return Err(Failure::new(format!("{} is a folder", path.display())));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".mechaudit-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any new file; the umask still applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let (file, temporary) = builder.tempfile_in(folder).map_err(refused)?.into_parts();
    let mut out = BufWriter::new(anstream::StripStream::new(file));
    write(&mut out)?;
    let file = out
        .into_inner()
        .map_err(|e| refused(e.into_error()))?
        .into_inner();
    file.sync_all().map_err(refused)?;
    drop(file);
    temporary.persist(path).map_err(|e| refused(e.error))?;
    Ok(())
}
