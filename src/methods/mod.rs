//! The registry: a file for each audited method, and its line in the list below.

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

use crate::audit::did_you_mean;
use definition::{Entry, Registered};
use num_complex::Complex;

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

/// A line for each method: its type, which [`definition::Definition`] makes a method; its name, which
/// is also that of its files of hard cases and of certified values; the signature of a candidate, and
/// how one is called with an input. The lines stand under the feature of their subject.
macro_rules! registry {
    ($($subject:literal { $(
        $method:ident $name:literal:
        Fn($($argument:ty),*), |$f:ident, $input:pat_param| $call:expr;
    )* })*) => {
        /// Every method, in the order of reports.
        pub fn registry() -> Vec<Box<dyn Evaluable>> {
            let mut all: Vec<Box<dyn Evaluable>> = Vec::new();
            $(
                #[cfg(feature = $subject)]
                all.extend([$(Box::new(Entry::<$method>::NEW) as Box<dyn Evaluable>),*]);
            )*
            all
        }

        /// The signature in Rust of a candidate for the method of that name, but for its result.
        pub fn signature(name: &str) -> Option<&'static str> {
            match name {
                $($(
                    #[cfg(feature = $subject)]
                    $name => Some($method::SIGNATURE),
                )*)*
                _ => None,
            }
        }

        /// For each part of the input of the method of that name, the field that holds it in the
        /// type which a candidate in Rust takes; nothing where a candidate takes no such type.
        pub fn fields(name: &str) -> Option<Vec<String>> {
            let fields = match name {
                $($(
                    #[cfg(feature = $subject)]
                    $name => <$method as definition::Definition>::fields(),
                )*)*
                _ => return None,
            };
            let takes_fields = signature(name)?.contains("Input<");
            takes_fields.then(|| fields.into_iter().map(|f| f.path).collect())
        }

        $($(
            #[cfg(feature = $subject)]
            impl Typed for $method {
                const NAME: &'static str = $name;
                const SIGNATURE: &'static str = stringify!(Fn($($argument),*));
            }

            #[cfg(feature = $subject)]
            impl Registered for $method {
                const HARD: &'static str = include_str!(concat!(
                    env!("CARGO_MANIFEST_DIR"), "/reference/hard/", $name, ".csv"
                ));
            }

            // There has to be one; `mechaudit regenerate` fills it.
            #[cfg(feature = $subject)]
            const _: &str = include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"), "/reference/values/", $name, ".csv"
            ));

            #[cfg(feature = $subject)]
            impl<F, R> Candidate<$method> for F
            where
                F: Fn($($argument),*) -> R + Sync,
                R: IntoAnswer,
            {
                fn answer(&self, numbers: &[f64]) -> crate::audit::SolverAnswer {
                    let $f = self;
                    let input = <$method as definition::Definition>::unpack(numbers);
                    input.map(|$input| $call).into_answer()
                }
            }
        )*)*
    };
}

registry! {
"splines" {
    Tridiagonal "tridiagonal":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d);
    TridiagonalPivoting "tridiagonal-pivoting":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d);
    CyclicTridiagonal "cyclic-tridiagonal":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d);
    CubicSplineSecondDerivatives "cubic-spline-second-derivatives":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    CubicSplineClamped "cubic-spline-clamped":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    CubicSplineNotAKnot "cubic-spline-not-a-knot":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    CubicSplinePeriodic "cubic-spline-periodic":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    CubicSplineUniform "cubic-spline-uniform":
        Fn(UniformSplineProblem<'_>), |f, i| f(i.into());
    CubicSplineMixedEnds "cubic-spline-mixed-ends":
        Fn(CubicSplineMixedEndsInput<'_>), |f, i| f(i);
    Pchip "pchip":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    Akima "akima":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
    ModifiedAkima "modified-akima":
        Fn(SplineProblem<'_>), |f, i| f(i.into());
}
"linkages" {
    FourBar "four-bar":
        Fn([f64; 4], f64, bool), |f, i| f([i.a, i.b, i.c, i.d], i.phi1, i.assembly > 0.0);
    SliderCrank "slider-crank":
        Fn([f64; 3], f64, f64, bool), |f, i| f([i.a, i.b, i.e], i.delta, i.phi1, i.assembly > 0.0);
    ClassIiiAssemblyModes "class-iii-assembly-modes":
        Fn(&[f64; 11], f64), |f, i| f(&i.geometry.values(), i.phi1);
    ClassIii "class-iii":
        Fn(ClassIiiInput<'_>), |f, i| f(i);
    PlanarLinkage "planar-linkage":
        Fn(PlanarLinkageInput<'_>), |f, i| f(i);
    PlanarReduction "planar-reduction":
        Fn(PlanarForcesInput<'_>), |f, i| f(i);
    PlanarReactions "planar-reactions":
        Fn(PlanarForcesInput<'_>), |f, i| f(i);
}
"special" {
    Faddeeva "faddeeva":
        Fn(Complex<f64>), |f, z| f(z.into());
    FaddeevaDerivative "faddeeva-derivative":
        Fn(Complex<f64>), |f, z| f(z.into());
    Erf "erf":
        Fn(Complex<f64>), |f, z| f(z.into());
    Erfc "erfc":
        Fn(Complex<f64>), |f, z| f(z.into());
    Erfcx "erfcx":
        Fn(Complex<f64>), |f, z| f(z.into());
    Erfi "erfi":
        Fn(Complex<f64>), |f, z| f(z.into());
    Dawson "dawson":
        Fn(Complex<f64>), |f, z| f(z.into());
    Voigt "voigt":
        Fn(f64, f64, f64), |f, i| f(i.x, i.sigma, i.gamma);
    VoigtHwhm "voigt-hwhm":
        Fn(f64, f64), |f, i| f(i.sigma, i.gamma);
}
"cams" {
    CamLaw "cam-law":
        Fn(CamLawInput<'_>), |f, i| f(i);
    CamFourierSeries "cam-fourier-series":
        Fn(CamFourierSeriesInput<'_>), |f, i| f(i);
    ChirpResponse "chirp-response":
        Fn(ChirpResponseInput<'_>), |f, i| f(i);
}
"run-up" {
    RunUp "run-up":
        Fn(RunUpInput<'_>), |f, i| f(i);
}
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

/// Returns the method that a text names. The command line, the plans of campaigns and candidates all
/// resolve their METHOD here.
///
/// # Errors
/// A text that names no method.
///
/// ```
/// use mechaudit::methods::resolve;
///
/// assert_eq!(resolve("erf")?.name(), "erf");
/// let why = resolve("errf").err().unwrap().to_string();
/// assert!(why.starts_with("there is no method \"errf\" (did you mean \"erf\"?)"));
/// # Ok::<(), mechaudit::methods::MethodError>(())
/// ```
pub fn resolve(text: &str) -> Result<Box<dyn Evaluable>, MethodError> {
    find(text).ok_or_else(|| MethodError::Unknown {
        name: text.into(),
        known: registry().iter().map(|m| m.name()).collect(),
    })
}

/// The reason why a text names no method.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MethodError {
    /// No method has that name.
    #[error("there is no method {name:?}{}; there are: {}", did_you_mean(.name, .known), .known.join(", "))]
    Unknown {
        /// The name.
        name: String,
        /// The names of all methods.
        known: Vec<&'static str>,
    },
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
