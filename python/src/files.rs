//! The writer of files, which is the program's.

use crate::interrupt::interruptible;
use mechaudit::files::Destination;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::io;
use std::path::PathBuf;

/// The error of a file, with its name as Python has it.
fn os_error(e: &io::Error, path: PathBuf) -> PyErr {
    match e.raw_os_error() {
        Some(code) => {
            let text = e.to_string();
            let text = text
                .split(" (os error")
                .next()
                .unwrap_or_default()
                .to_owned();
            PyOSError::new_err((code, text, path.into_os_string()))
        }
        None => PyOSError::new_err(format!("cannot write {}: {e}", path.display())),
    }
}

/// Writes a file: a plain one appears whole or not at all, a link is followed, a device or FIFO is
/// written to.
#[pyfunction]
pub fn write_file(py: Python<'_>, path: PathBuf, content: &[u8]) -> PyResult<()> {
    let (name, content) = (path.clone(), content.to_vec());
    // Whoever reads a FIFO may never come.
    let done = interruptible(py, move || {
        Destination::open(&path)?.write(|out| out.write_all(&content), |e| e)
    })?;
    done.map_err(|e| os_error(&e, name))
}
