//! A folder of hard cases: `METHOD.csv` for each method, to which hunts add lines.

use crate::cli::failure::Failure;
use crate::cli::files::output::Output;
use mechaudit::audit::{HARD_HEADER, HardCase, Method};
use mechaudit::study;
use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The file of a method's hard cases.
pub fn file(folder: &Path, method: &dyn Method) -> PathBuf {
    folder.join(format!("{}.csv", stem(method.name())))
}

/// The name of a method as that of a file: of a study the name of its file without the folder, and
/// that of the core.
fn stem(name: &str) -> String {
    if !study::is_path(name) {
        return name.into();
    }
    let path = study::file_of(name);
    let core = name[path.len()..].trim_start_matches('#');
    let stem = Path::new(path).file_stem().unwrap_or_default();
    let parts = [&*stem.to_string_lossy(), core].map(|part| {
        let plain = |c: char| match c.is_alphanumeric() || "._-".contains(c) {
            true => c,
            false => '-',
        };
        part.chars().map(plain).collect::<String>()
    });
    parts.join("-").trim_end_matches('-').into()
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
            stem(method.name())
        ))
    };
    read(folder, method)?.ok_or_else(missing)
}

/// Returns true if hard cases can be added: before a hunt, not after it.
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

/// Held by one process at a time, until it is dropped. The file of hard cases cannot be locked
/// itself, as another takes its place.
fn lock(folder: &Path) -> io::Result<File> {
    let lock = match cfg!(unix) {
        true => File::open(folder)?,
        false => File::create(folder.join(".lock"))?,
    };
    lock.lock()?;
    Ok(lock)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::lookup;
    use std::fs::{create_dir, read_to_string, write};
    use tempfile::tempdir;

    fn case(share: f64, re: f64) -> HardCase {
        HardCase {
            share,
            output: "Re erf".into(),
            reason: "by hand".into(),
            input: vec![re, 0.0],
            folder: None,
        }
    }

    /// Lines stay as they are, whether the last one is ended or not; there is one header.
    #[test]
    fn lines_are_added_to_what_is_there() {
        let method = lookup::method("erf").unwrap();
        let head = "# Worst inputs found by mechaudit hunt erf; lines are only added.\n";
        let [old, new] = [case(0.25, 1.0), case(0.5, 2.0)].map(|c| c.line());
        let begun = format!("{HARD_HEADER}\n{old}");
        for (before, due) in [
            (None, format!("{head}{HARD_HEADER}\n{new}")),
            (Some(String::new()), format!("{head}{HARD_HEADER}\n{new}")),
            (
                Some("# ours\n".into()),
                format!("# ours\n{HARD_HEADER}\n{new}"),
            ),
            (
                Some(format!("# ours\n{HARD_HEADER}\n")),
                format!("# ours\n{HARD_HEADER}\n{new}"),
            ),
            (Some(begun.clone()), format!("{begun}{new}")),
            (Some(begun.trim_end().into()), format!("{begun}{new}")),
        ] {
            let folder = tempdir().unwrap();
            let path = folder.path().join("erf.csv");
            let known = usize::from(before.as_ref().is_some_and(|t| t.contains("Re erf")));
            before.iter().for_each(|text| write(&path, text).unwrap());
            check_writable(folder.path(), &*method).unwrap();
            let added = add(folder.path(), &*method, |there| {
                assert_eq!(there.len(), known, "{before:?}");
                vec![case(0.5, 2.0)]
            });
            assert_eq!(added.unwrap(), [(known + 1, case(0.5, 2.0))]);
            assert_eq!(read_to_string(&path).unwrap(), due, "{before:?}");
            let found = of_method(folder.path(), &*method).unwrap();
            let own = folder.path().to_str().map(str::to_owned);
            assert_eq!(found.len(), known + 1);
            assert!(found.iter().all(|c| c.folder == own));
        }
    }

    /// A study's file is found by its name wherever it stands; a core's name may hold anything.
    #[test]
    fn the_file_of_a_study_has_no_path() {
        for (name, due) in [
            ("erf", "erf"),
            ("a/b/drop.toml", "drop"),
            ("../x y.fpcore", "x-y"),
            ("a/b.fpcore#c/d#e", "b-c-d-e"),
            ("b.fpcore#2", "b-2"),
        ] {
            assert_eq!(stem(name), due);
        }
    }

    #[test]
    fn nothing_new_leaves_the_folder_alone() {
        let method = lookup::method("erf").unwrap();
        let folder = tempdir().unwrap();
        let added = add(folder.path(), &*method, |_| Vec::new());
        assert!(added.unwrap().is_empty());
        assert!(!folder.path().join("erf.csv").exists());
        assert!(read(folder.path(), &*method).unwrap().is_none());
        let why = of_method(folder.path(), &*method).unwrap_err().to_string();
        assert!(why.ends_with(": it holds no erf.csv"), "{why}");
    }

    #[test]
    fn what_is_no_folder_of_hard_cases() {
        let method = lookup::method("erf").unwrap();
        let folder = tempdir().unwrap();
        let missing = folder.path().join("none");
        let why = read(&missing, &*method).unwrap_err().to_string();
        assert!(why.ends_with("none: there is no such folder"), "{why}");
        let why = read(Path::new("3"), &*method).unwrap_err().to_string();
        assert_eq!(
            why,
            "--hard 3: there is no such folder; --hard-case 3 chooses one case"
        );
        // Something that cannot be read is not a file that is missing.
        create_dir(folder.path().join("erf.csv")).unwrap();
        assert!(read(folder.path(), &*method).is_err());
        assert!(check_writable(folder.path(), &*method).is_err());
        assert!(add(folder.path(), &*method, |_| vec![case(0.5, 2.0)]).is_err());
    }
}
