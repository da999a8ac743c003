//! The registry: one file for each audited method, one word in the list below.

mod approximations;
mod cam_law_input;
mod chirp_regions;
mod cubic_spline_common;
mod cubic_spline_conditions;
mod cubic_spline_domain;
mod cubic_spline_laws;
mod faddeeva_curves;
mod faddeeva_laws;
mod faddeeva_regions;
mod faddeeva_relatives;
mod faddeeva_relatives_laws;
mod faddeeva_relatives_regions;
mod four_bar_laws;
mod four_bar_regions;
mod run_up_twin;
mod typed;
mod voigt_regions;

use crate::audit::Method;
use faddeeva_relatives::Related;

pub use approximations::{approximations, find_approximation};
pub use typed::*;

macro_rules! registry {
    ($($module:ident $(: $relative:ident)?),* $(,)?) => {
        $(mod $module;)*

        /// Every audited method.
        pub fn registry() -> Vec<Box<dyn Method>> {
            vec![$(Box::new(registry!(@entry $module $($relative)?))),*]
        }
    };
    (@entry $module:ident) => { $module::Audit };
    (@entry $module:ident $relative:ident) => { Related($module::$relative) };
}

registry![
    tridiagonal,
    cyclic_tridiagonal,
    cubic_spline_second_derivatives,
    cubic_spline_clamped,
    cubic_spline_not_a_knot,
    cubic_spline_periodic,
    cubic_spline_uniform,
    four_bar,
    slider_crank,
    class_iii_assembly_modes,
    class_iii,
    faddeeva,
    faddeeva_derivative: FaddeevaDerivative,
    erf: Erf,
    erfc: Erfc,
    erfcx: Erfcx,
    erfi: Erfi,
    dawson: Dawson,
    voigt,
    cam_law,
    cam_fourier_series,
    chirp_response,
    run_up,
];

/// The method of that name.
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
pub fn find(name: &str) -> Option<Box<dyn Method>> {
    registry().into_iter().find(|m| m.name() == name)
}

#[cfg(test)]
mod tests {
    use super::registry;
    use std::collections::HashSet;

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
