//! The registry: a file for each audited method, and its line in the `mod.rs` of its subject.

#[cfg(feature = "splines")]
mod approximations;
#[cfg(feature = "cams")]
mod cams;
mod certified;
mod common;
mod definition;
#[cfg(feature = "run-up")]
mod drive;
mod inputs;
#[cfg(feature = "splines")]
mod linear;
#[cfg(feature = "linkages")]
mod linkages;
#[cfg(feature = "special")]
mod special;
#[cfg(feature = "splines")]
mod splines;
mod typed;

#[cfg(feature = "splines")]
pub use approximations::{approximations, find_approximation};
#[cfg(feature = "cams")]
pub use cams::*;
pub use certified::{CertifiedValue, certified_digits};
pub use definition::{Evaluable, Typed};
#[cfg(feature = "run-up")]
pub use drive::*;
pub use inputs::Number;
#[cfg(feature = "splines")]
pub use linear::*;
#[cfg(feature = "linkages")]
pub use linkages::*;
#[cfg(feature = "special")]
pub use special::*;
#[cfg(feature = "splines")]
pub use splines::*;
pub use typed::{Candidate, IntoAnswer};

/// Every method, in the order of reports.
pub fn registry() -> Vec<Box<dyn Evaluable>> {
    let mut all: Vec<Box<dyn Evaluable>> = Vec::new();
    #[cfg(feature = "splines")]
    all.extend(linear::methods().into_iter().chain(splines::methods()));
    #[cfg(feature = "linkages")]
    all.extend(linkages::methods());
    #[cfg(feature = "special")]
    all.extend(special::methods());
    #[cfg(feature = "cams")]
    all.extend(cams::methods());
    #[cfg(feature = "run-up")]
    all.extend(drive::methods());
    all
}

/// Returns the signature in Rust of a candidate for the method of that name, but for its result.
pub fn signature(name: &str) -> Option<&'static str> {
    find(name)?.signature()
}

/// Returns, for each part of the input of the method of that name, the field that holds it in the
/// type which a candidate in Rust takes; nothing where a candidate takes no such type.
pub fn fields(name: &str) -> Option<Vec<String>> {
    let method = find(name)?;
    let takes_fields = method.signature()?.contains("Input<");
    takes_fields.then(|| method.fields())
}

/// Returns the method of that name.
///
/// A hunt for the inputs that take up most of its budget:
///
/// ```
/// use mechaudit::audit::{HuntSettings, hunt};
/// use mechaudit::methods;
///
/// let method = methods::find("tridiagonal").unwrap();
/// let settings = HuntSettings { evaluations: 300, seed: 1 };
/// let found = hunt(&*method, &settings, &|_| ());
/// assert!(found.worst[0].share > 0.02 && found.failures.is_empty());
/// ```
///
/// The method with another solver, in one region:
///
/// ```
/// use mechaudit::audit::{Settings, SolverAnswer, Variant, audit_method};
/// use mechaudit::methods;
///
/// let method = methods::find("slider-crank").unwrap();
/// let silent = Variant::new(&*method)
///     .solver(|_| SolverAnswer::Declines(None))
///     .region("unreachable")?;
/// let settings = Settings { cases_per_region: 3, ..Settings::default() };
/// assert!(audit_method(&silent, &settings, &|| ()).passed());
/// # Ok::<(), mechaudit::audit::NoSuch>(())
/// ```
pub fn find(name: &str) -> Option<Box<dyn Evaluable>> {
    registry().into_iter().find(|m| m.name() == name)
}

#[cfg(test)]
mod tests {
    use super::registry;
    use std::collections::HashSet;

    /// The budget supposes that every row is dominant.
    #[test]
    fn systems_with_a_row_that_is_not_dominant_are_not_admitted() {
        let method = super::find("tridiagonal").expect("a method");
        // lower[1], diagonal[2], upper[1], d[2].
        let admits = |b0: f64, b1: f64| method.admits(&[-1.0, b0, b1, 1.0, 1.0, 1.0]);
        assert!(admits(2.0, 3.0));
        assert!(!admits(0.5, 3.0) && !admits(3.0, 0.5));
    }

    #[test]
    fn every_method_can_be_named_and_sampled() {
        let methods = registry();
        let names: HashSet<&str> = methods.iter().map(|m| m.name()).collect();
        assert_eq!(names.len(), methods.len(), "two methods share a name");
        for m in &methods {
            let word = |s: &str| {
                !s.is_empty()
                    && s.bytes()
                        .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-')
            };
            assert!(word(m.name()), "{}", m.name());
            assert!(
                !m.outputs().is_empty() && !m.inputs().is_empty(),
                "{}",
                m.name()
            );
            let domain = m.domain();
            assert!(
                !domain.check_points.is_empty(),
                "{} has no check point",
                m.name()
            );
            let places: Vec<&str> = domain
                .regions
                .iter()
                .map(|r| r.name)
                .chain(domain.check_points.iter().map(|c| c.name))
                .collect();
            assert!(places.iter().all(|p| word(p)), "{}: {places:?}", m.name());
            let distinct: HashSet<&&str> = places.iter().collect();
            assert_eq!(distinct.len(), places.len(), "{}: {places:?}", m.name());
        }
    }
}
