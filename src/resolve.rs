//! The method that a text names: one of the registry, or a study in a file.

use crate::audit::did_you_mean;
use crate::methods::{Evaluable, find, registry};

/// Returns the method that a text names: a name of the registry, or with the feature `studies` a
/// path to a study, `FILE.toml`, `FILE.fpcore` or `FILE.fpcore#NAME`. The command line, the plans
/// of campaigns and candidates all resolve their METHOD here.
///
/// # Errors
/// A text that names no method, and a study that cannot be read.
///
/// ```
/// use mechaudit::resolve;
///
/// # #[cfg(feature = "special")] {
/// assert_eq!(resolve("erf")?.name(), "erf");
/// let why = resolve("errf").err().unwrap().to_string();
/// assert!(why.starts_with("there is no method \"errf\" (did you mean \"erf\"?)"));
/// # }
/// # Ok::<(), mechaudit::MethodError>(())
/// ```
pub fn resolve(text: &str) -> Result<Box<dyn Evaluable>, MethodError> {
    if let Some(method) = find(text) {
        return Ok(method);
    }
    #[cfg(feature = "studies")]
    if crate::study::is_path(text) {
        return Ok(Box::new(crate::study::Study::open(text)?));
    }
    Err(MethodError::Unknown {
        name: text.into(),
        known: registry().iter().map(|m| m.name()).collect(),
    })
}

/// The reason why a text names no method.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MethodError {
    /// No method has that name.
    #[error("there is no method {name:?}{}; there are: {}, or a file of a study (.toml, .fpcore)", did_you_mean(.name, .known), .known.join(", "))]
    Unknown {
        /// The name.
        name: String,
        /// The names of all methods.
        known: Vec<&'static str>,
    },
    /// A study that cannot be read.
    #[cfg(feature = "studies")]
    #[error(transparent)]
    Study(#[from] crate::study::StudyError),
}
