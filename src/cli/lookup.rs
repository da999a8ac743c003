//! The methods that arguments name.

use crate::cli::failure::Failure;
use mechaudit::machine::planar::Moving;
use mechaudit::machine::{Linkage, Source};
use mechaudit::methods::{self, Evaluable};
use mechaudit::study::{Study, StudyError, is_path};
use std::path::Path;

/// Returns the method that an argument names.
pub fn method(text: &str) -> Result<Box<dyn Evaluable>, Failure> {
    match moving(text)? {
        Some(study) => Ok(Box::new(study)),
        None => mechaudit::resolve(text).map_err(Failure::caused),
    }
}

/// Returns the study that a file states, which may be the motion of a machine.
pub fn study(path: &str) -> Result<Study, Failure> {
    match moving(path)? {
        Some(study) => Ok(study),
        None => Study::open(path).map_err(Failure::caused),
    }
}

/// Returns the motion of the machine in a file; `None` for other files and names.
fn moving(text: &str) -> Result<Option<Study>, Failure> {
    let source = match is_path(text) {
        true => Source::open(Path::new(text)).ok(),
        false => None,
    };
    let Some(source) = source.filter(Linkage::names_type) else {
        return Ok(None);
    };
    let study = Moving::read_study(&source, text).map_err(|e| Failure::caused(e.in_file(text)))?;
    Ok(Some(study))
}

/// Returns the method that an argument names, or all methods without one.
pub fn methods(text: Option<&str>) -> Result<Vec<Box<dyn Evaluable>>, Failure> {
    match text {
        Some(text) => Ok(vec![method(text)?]),
        None => Ok(methods::registry()),
    }
}

/// The methods that arguments name, and what could not be read beside others.
#[derive(Default)]
pub struct Named {
    /// The methods.
    pub methods: Vec<Box<dyn Evaluable>>,
    /// Cores that were refused, each with its reason.
    pub refused: Vec<StudyError>,
}

/// Returns the methods that arguments name: all methods without one, all cores of a file in FPCore.
/// A core that cannot be read is refused by itself if there are others.
pub fn named(texts: &[String]) -> Result<Named, Failure> {
    let mut named = Named::default();
    if texts.is_empty() {
        named.methods = methods::registry();
        return Ok(named);
    }
    for text in texts {
        if !text.ends_with(".fpcore") {
            named.methods.push(method(text)?);
            continue;
        }
        for study in Study::open_all(text).map_err(Failure::caused)? {
            match study {
                Ok(study) => named.methods.push(Box::new(study)),
                Err(e) => named.refused.push(e),
            }
        }
    }
    match (named.methods.is_empty(), named.refused.is_empty()) {
        (true, false) => Err(Failure::caused(named.refused.remove(0))),
        (true, true) => Err(Failure::new("the files hold no core")),
        (false, _) => Ok(named),
    }
}

/// Refuses a method without a solver of its own, where that is to be judged.
pub fn has_solver(method: &dyn Evaluable) -> Result<(), Failure> {
    match method.has_solver() {
        true => Ok(()),
        false => Err(Failure::new(format!(
            "{} states no solver: give a program by --exec, or add [solver.NAME] to the file",
            method.name()
        ))),
    }
}
