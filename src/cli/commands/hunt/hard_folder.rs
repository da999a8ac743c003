//! A folder of hard cases: `METHOD.csv` for each method, to which hunts add lines.

use crate::cli::failure::Failure;
use crate::cli::files::output::Output;
use mechaudit::audit::{HARD_HEADER, HardCase, Method};
use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

fn file(folder: &Path, method: &dyn Method) -> PathBuf {
    folder.join(format!("{}.csv", method.name()))
}

/// The hard cases of a method and the text that holds them; nothing if there is no file.
fn held(folder: &Path, method: &dyn Method) -> Result<Option<(String, Vec<HardCase>)>, Failure> {
    let path = file(folder, method);
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(Failure::cannot("read", &path, e)),
    };
    let mut cases = HardCase::read_of(method, &text).map_err(|e| Failure::in_file(&path, e))?;
    for case in &mut cases {
        case.folder = Some(folder.to_string_lossy().into_owned());
    }
    Ok(Some((text, cases)))
}

/// The hard cases of a method, if the folder has a file of them.
pub fn read(folder: &Path, method: &dyn Method) -> Result<Option<Vec<HardCase>>, Failure> {
    if !folder.is_dir() {
        let name = folder.display();
        let hint = match name.to_string().parse::<usize>() {
            Ok(n) => format!("; --hard-case {n} chooses one case"),
            Err(_) => String::new(),
        };
        return Err(Failure::new(format!(
            "--hard {name}: there is no such folder{hint}"
        )));
    }
    Ok(held(folder, method)?.map(|(_, cases)| cases))
}

/// The hard cases of a method that has to have some there.
pub fn of_method(folder: &Path, method: &dyn Method) -> Result<Vec<HardCase>, Failure> {
    let missing = || {
        Failure::new(format!(
            "--hard {}: it holds no {}.csv",
            folder.display(),
            method.name()
        ))
    };
    read(folder, method)?.ok_or_else(missing)
}

/// Whether hard cases can be added: before a hunt, not after it.
pub fn check_writable(folder: &Path, method: &dyn Method) -> Result<(), Failure> {
    Output::open(Some(&file(folder, method))).map(drop)
}

/// Adds what `worse` makes of the cases there are by then, which other hunts may add to at the same
/// time. Returns them with their numbers.
pub fn add(
    folder: &Path,
    method: &dyn Method,
    worse: impl FnOnce(&[HardCase]) -> Vec<HardCase>,
) -> Result<Vec<(usize, HardCase)>, Failure> {
    let path = file(folder, method);
    let _lock = lock(folder).map_err(|e| Failure::cannot("lock", folder, e))?;
    let (mut text, known) = held(folder, method)?.unwrap_or_default();
    let new = worse(&known);
    if new.is_empty() {
        return Ok(Vec::new());
    }
    if text.is_empty() {
        let name = method.name();
        text = format!("# Worst inputs found by mechaudit hunt {name}; lines are only added.\n");
    }
    if !text.ends_with('\n') {
        text.push('\n');
    }
    // Of comments alone there is no header.
    if known.is_empty() && !text.lines().any(|l| l == HARD_HEADER) {
        text += &format!("{HARD_HEADER}\n");
    }
    text.extend(new.iter().map(HardCase::line));
    Output::open(Some(&path))?.text(&text)?;
    Ok((known.len() + 1..).zip(new).collect())
}

/// Held by one process at a time, until it is dropped. The file of hard cases cannot be locked itself,
/// as another takes its place.
fn lock(folder: &Path) -> io::Result<File> {
    let lock = match cfg!(unix) {
        true => File::open(folder)?,
        false => File::create(folder.join(".lock"))?,
    };
    lock.lock()?;
    Ok(lock)
}
