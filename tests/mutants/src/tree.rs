//! The copy of the project that is changed, and what cargo says about it.

use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::env;
use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::SystemTime;

/// Set where cargo runs this program in place of the compiler.
pub const COMPILER: &str = "MUTANTS_COMPILER";

/// A copy of the files that git tracks.
pub struct Tree {
    pub root: PathBuf,
    target: PathBuf,
    /// True if changes are for the libraries' own tests alone.
    only_tests: bool,
}

/// An error of the compiler, or what it names beside one: the file, and the bytes of it.
pub struct CompileError {
    pub file: String,
    pub bytes: Range<usize>,
    /// True if the error stands here; beside it is where a value went that is missing, say.
    pub primary: bool,
    pub message: String,
}

/// A program of tests.
#[derive(Clone)]
pub struct Executable {
    pub package: String,
    pub path: PathBuf,
    /// Where cargo runs it: the package's folder.
    pub folder: PathBuf,
}

/// The results of a build.
pub struct Built {
    pub executables: Vec<Executable>,
    pub errors: Vec<CompileError>,
}

impl Tree {
    /// Copies what has changed since the last copy, and what the project's own tests have compiled
    /// of others' packages if nothing is built here yet.
    ///
    /// With `only_tests`, also what they have compiled of the project, each time anew. Files keep
    /// their times however they change, so that cargo compiles nothing but the libraries' tests, of
    /// which nothing is copied.
    pub fn new(project: &Path, work: &Path, only_tests: bool) -> Result<Tree> {
        let listed = Command::new("git")
            .current_dir(project)
            .args([
                "ls-files",
                "-z",
                "--cached",
                "--others",
                "--exclude-standard",
            ])
            .output()
            .context("git ls-files")?;
        if !listed.status.success() {
            bail!("{} is no git checkout", project.display());
        }
        let root = work.join("tree");
        for name in String::from_utf8(listed.stdout)?.split_terminator('\0') {
            let from = project.join(name);
            if from.is_file() {
                let to = root.join(name);
                write_if_other(&to, &fs::read(&from)?)?;
                if only_tests {
                    same_time(&to, fs::metadata(&from)?.modified()?)?;
                }
            }
        }
        let target = work.join(if only_tests { "tests" } else { "build" });
        if only_tests && target.exists() {
            fs::remove_dir_all(&target)?;
        }
        if !target.exists() {
            let own = env::var_os("CARGO_TARGET_DIR").map_or(project.join("target"), PathBuf::from);
            take_over(&own.join("debug"), &target.join("debug"), only_tests)?;
        }
        Ok(Tree {
            root,
            target,
            only_tests,
        })
    }

    /// Replaces a file.
    pub fn write(&self, name: &str, text: &str) -> Result<()> {
        let path = self.root.join(name);
        let time = fs::metadata(&path)?.modified()?;
        write_if_other(&path, text.as_bytes())?;
        if self.only_tests {
            same_time(&path, time)?;
        }
        Ok(())
    }

    /// The root files of a package's library and programs, relative to the tree.
    pub fn roots(&self, package: &str) -> Result<Vec<String>> {
        let out = Command::new("cargo")
            .current_dir(&self.root)
            .args(["metadata", "--no-deps", "--format-version", "1"])
            .stderr(Stdio::inherit())
            .output()?;
        let data: Value = serde_json::from_slice(&out.stdout).context("cargo metadata")?;
        let packages = data["packages"].as_array().context("packages")?;
        let found = packages.iter().find(|p| p["name"] == package);
        let found = found.with_context(|| format!("there is no package {package:?}"))?;
        let targets = found["targets"].as_array().context("targets")?;
        let own = targets.iter().filter(|t| {
            let kinds = t["kind"].as_array();
            kinds.is_some_and(|k| k.iter().any(|k| k == "lib" || k == "bin"))
        });
        let root = fs::canonicalize(&self.root)?;
        own.map(|target| {
            let path = target["src_path"].as_str().context("src_path")?;
            let inside = Path::new(path).strip_prefix(&root).context("src_path")?;
            Ok(without_detours(&inside.to_string_lossy()))
        })
        .collect()
    }

    /// Checks or builds the tests of packages, of those that `cargo test` tests if none are named.
    pub fn cargo(&self, packages: &[&str], targets: &[String], build: bool) -> Result<Built> {
        let mut command = Command::new("cargo");
        command
            .current_dir(&self.root)
            .env("CARGO_TARGET_DIR", &self.target)
            .args(if build {
                &["test", "--no-run"][..]
            } else {
                &["check", "--profile", "test"]
            })
            .args(["--message-format", "json"])
            .args(packages.iter().flat_map(|p| ["--package", *p]));
        command.args(targets);
        if self.only_tests {
            command
                .env("RUSTC_WRAPPER", env::current_exe()?)
                .env(COMPILER, "");
        }
        let out = command.stderr(Stdio::piped()).output().context("cargo")?;
        let mut built = Built {
            executables: Vec::new(),
            errors: Vec::new(),
        };
        for line in out.stdout.split(|b| *b == b'\n') {
            let Ok(message) = serde_json::from_slice::<Value>(line) else {
                continue;
            };
            match message["reason"].as_str() {
                Some("compiler-artifact") if message["profile"]["test"] == true => {
                    built.executables.extend(executable(&message));
                }
                Some("compiler-message") if message["message"]["level"] == "error" => {
                    built.errors.extend(spans(&message["message"]));
                }
                _ => {}
            }
        }
        if !out.status.success() && built.errors.is_empty() {
            bail!("{}", String::from_utf8_lossy(&out.stderr));
        }
        Ok(built)
    }
}

/// Runs the compiler that the arguments begin with. Tests are built without optimisation: they run
/// for seconds.
///
/// The profile could say so only for the libraries they use as well, and all would be built again.
pub fn compiler() -> Result<ExitCode> {
    let mut arguments: Vec<String> = env::args().skip(1).collect();
    if arguments.iter().any(|a| a == "--test") {
        for level in arguments.iter_mut().filter(|a| a.starts_with("opt-level=")) {
            *level = "opt-level=0".into();
        }
    }
    let (compiler, rest) = arguments.split_first().context("no compiler")?;
    let status = Command::new(compiler).args(rest).status()?;
    Ok(match status.success() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}

/// Takes over what the project's own tests have compiled, if there is any: of others' packages, or
/// all but its tests. What does not fit is compiled anew.
fn take_over(from: &Path, to: &Path, own_too: bool) -> Result<()> {
    // Cargo writes a fingerprint when its package is whole.
    for part in [".fingerprint", "build", "deps"] {
        copy(&from.join(part), &to.join(part), own_too)
            .with_context(|| from.join(part).display().to_string())?;
    }
    Ok(())
}

/// Copies what belongs to others, or all but tests, with its times, by which cargo tells what is
/// stale.
fn copy(from: &Path, to: &Path, own_too: bool) -> io::Result<()> {
    // Another cargo may be at work there.
    let there = |e: io::Error| (e.kind() != io::ErrorKind::NotFound).then_some(e);
    let entries = match fs::read_dir(from) {
        Ok(entries) => entries,
        Err(e) => return there(e).map_or(Ok(()), Err),
    };
    fs::create_dir_all(to)?;
    // Programs of tests are large, and the copy makes its own.
    let programs = from.ends_with("deps");
    for entry in entries {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default();
        let text = name.to_string_lossy();
        let left_out = match own_too {
            true => text.contains("test-lib-") || text.ends_with(".o"),
            false => text.contains("mechaudit"),
        };
        if left_out || programs && path.extension().is_none() {
            continue;
        }
        let copied = if path.is_dir() {
            copy(&path, &to.join(name), own_too)
        } else {
            copy_file(&path, &to.join(name))
        };
        copied.or_else(|e| there(e).map_or(Ok(()), Err))?;
    }
    Ok(())
}

fn copy_file(from: &Path, to: &Path) -> io::Result<()> {
    let time = fs::metadata(from)?.modified()?;
    fs::copy(from, to)?;
    same_time(to, time)
}

fn same_time(path: &Path, time: SystemTime) -> io::Result<()> {
    fs::File::options()
        .append(true)
        .open(path)?
        .set_modified(time)
}

/// The program that a message of cargo tells of.
fn executable(message: &Value) -> Option<Executable> {
    let manifest = Path::new(message["manifest_path"].as_str()?);
    // `path+file:///…/src/audit#mechaudit-audit@0.1.0`; without a name where that is the folder's.
    let (at, id) = message["package_id"].as_str()?.rsplit_once('#')?;
    let name = id
        .split_once('@')
        .map_or(at.rsplit_once('/')?.1, |(name, _)| name);
    Some(Executable {
        package: name.into(),
        path: message["executable"].as_str()?.into(),
        folder: manifest.parent()?.into(),
    })
}

/// The spans of an error.
fn spans(message: &Value) -> Vec<CompileError> {
    let text = message["message"].as_str().unwrap_or_default();
    let all = message["spans"].as_array().into_iter().flatten();
    all.filter_map(|s| {
        let number = |key: &str| s[key].as_u64().map(|n| n as usize);
        Some(CompileError {
            file: without_detours(s["file_name"].as_str()?),
            bytes: number("byte_start")?..number("byte_end")?,
            primary: s["is_primary"] == true,
            message: text.to_owned(),
        })
    })
    .collect()
}

/// The path without `folder/..`: the program's files lie outside its package's folder.
fn without_detours(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match (part, parts.last()) {
            ("..", Some(&folder)) if folder != ".." => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

fn write_if_other(path: &Path, bytes: &[u8]) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, bytes).with_context(|| path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::without_detours;

    #[test]
    fn paths_out_of_a_folder_are_shortened() {
        assert_eq!(without_detours("src/cli/../program.rs"), "src/program.rs");
        let test = without_detours("src/cli/../../tests/cli/main.rs");
        assert_eq!(test, "tests/cli/main.rs");
        assert_eq!(without_detours("../src/lib.rs"), "../src/lib.rs");
    }
}
