//! Each method's signature as a type, for code of one's own: see [`audit`](crate::audit()).

use super::cubic_spline_common::Kind;
use super::tridiagonal;
use crate::audit::SolverAnswer;
use num_complex::Complex;

/// A method of the registry as a type.
pub trait Typed {
    /// Its name in the registry.
    const NAME: &'static str;
}

/// Code that can be audited as the method `M`: a function with the signature that `M` documents.
pub trait Candidate<M>: Sync {
    /// Its answer to an input in the method's layout.
    fn answer(&self, input: &[f64]) -> SolverAnswer;
}

/// What a candidate may return: numbers in the order of the method's outputs, or a refusal.
///
/// `None` and `Err` are refusals without a reason, right wherever the reference refuses.
pub trait IntoAnswer {
    /// The answer.
    fn into_answer(self) -> SolverAnswer;
}

impl IntoAnswer for SolverAnswer {
    fn into_answer(self) -> SolverAnswer {
        self
    }
}

impl IntoAnswer for f64 {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(vec![self])
    }
}

impl IntoAnswer for Complex<f64> {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(vec![self.re, self.im])
    }
}

impl IntoAnswer for Vec<f64> {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(self)
    }
}

impl<const N: usize> IntoAnswer for [f64; N] {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(self.to_vec())
    }
}

impl<const N: usize, const K: usize> IntoAnswer for [[f64; N]; K] {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(self.concat())
    }
}

impl<const N: usize> IntoAnswer for Vec<[f64; N]> {
    fn into_answer(self) -> SolverAnswer {
        SolverAnswer::Values(self.concat())
    }
}

impl<T: IntoAnswer> IntoAnswer for Option<T> {
    fn into_answer(self) -> SolverAnswer {
        self.map_or(SolverAnswer::Declines(None), T::into_answer)
    }
}

impl<T: IntoAnswer, E> IntoAnswer for Result<T, E> {
    fn into_answer(self) -> SolverAnswer {
        self.ok().into_answer()
    }
}

/// A spline to be made and where it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct SplineProblem<'a> {
    /// The knots, increasing; fewer than two or unordered ones have to be refused.
    pub x: &'a [f64],
    /// The ordinates.
    pub y: &'a [f64],
    /// The end values, for the kinds that have them.
    pub ends: Option<[f64; 2]>,
    /// Two abscissae. Due for each: `S, S', S'', S'''` there and the integral to the other.
    pub queries: [f64; 2],
}

impl<'a> SplineProblem<'a> {
    fn of(kind: Kind, input: &'a [f64]) -> Option<SplineProblem<'a>> {
        let p = kind.split(input)?;
        Some(SplineProblem {
            x: p.x,
            y: p.y,
            ends: p.ends.try_into().ok(),
            queries: p.queries.try_into().ok()?,
        })
    }
}

/// A spline on equal steps to be made and where it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct UniformSplineProblem<'a> {
    /// The first knot.
    pub x0: f64,
    /// The step; one that is not positive has to be refused.
    pub h: f64,
    /// The second derivatives at the ends.
    pub ends: [f64; 2],
    /// The ordinates.
    pub y: &'a [f64],
    /// Two abscissae, as in [`SplineProblem`].
    pub queries: [f64; 2],
}

/// A method as a type, and which functions can be audited as it: their signature, and how an input
/// is taken apart for them. An input that cannot be taken apart is declined for the function.
macro_rules! typed {
    ($(
        $(#[$doc:meta])*
        $marker:ident = $name:literal: Fn($($arg:ty),*), |$f:ident, $x:ident| $call:expr;
    )*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug)]
            pub struct $marker;

            impl Typed for $marker {
                const NAME: &'static str = $name;
            }

            impl<F, R> Candidate<$marker> for F
            where
                F: Fn($($arg),*) -> R + Sync,
                R: IntoAnswer,
            {
                fn answer(&self, $x: &[f64]) -> SolverAnswer {
                    let $f = self;
                    let called = || Some($call);
                    called().map_or(SolverAnswer::Declines(None), R::into_answer)
                }
            }
        )*

        #[cfg(test)]
        const NAMES: &[&str] = &[$($name),*];
    };
}

typed! {
    /// `Fn(lower, diagonal, upper, right side) -> solution`, all slices of `f64`.
    Tridiagonal = "tridiagonal": Fn(&[f64], &[f64], &[f64], &[f64]), |f, x| {
        let p = tridiagonal::split(x)?;
        f(p.lower, p.diagonal, p.upper, p.d)
    };

    /// `Fn(lower, diagonal, upper, right side) -> solution`, all slices of the same length;
    /// `lower[0]` stands in the last column, the last of `upper` in the first.
    CyclicTridiagonal = "cyclic-tridiagonal": Fn(&[f64], &[f64], &[f64], &[f64]), |f, x| {
        let [lower, diagonal, upper, d] = super::cyclic_tridiagonal::split(x)?;
        f(lower, diagonal, upper, d)
    };

    /// `Fn(SplineProblem) -> [[S, S', S'', S''', integral]; 2]`, second derivatives at the ends.
    CubicSplineSecondDerivatives = "cubic-spline-second-derivatives": Fn(SplineProblem<'_>), |f, x|
        f(SplineProblem::of(Kind::SecondDerivatives, x)?);

    /// `Fn(SplineProblem) -> [[S, S', S'', S''', integral]; 2]`, first derivatives at the ends.
    CubicSplineClamped = "cubic-spline-clamped": Fn(SplineProblem<'_>), |f, x|
        f(SplineProblem::of(Kind::Clamped, x)?);

    /// `Fn(SplineProblem) -> [[S, S', S'', S''', integral]; 2]`.
    CubicSplineNotAKnot = "cubic-spline-not-a-knot": Fn(SplineProblem<'_>), |f, x|
        f(SplineProblem::of(Kind::NotAKnot, x)?);

    /// `Fn(SplineProblem) -> [[S, S', S'', S''', integral]; 2]`; unequal first and last ordinates
    /// have to be refused.
    CubicSplinePeriodic = "cubic-spline-periodic": Fn(SplineProblem<'_>), |f, x|
        f(SplineProblem::of(Kind::Periodic, x)?);

    /// `Fn(UniformSplineProblem) -> [[S, S', S'', S''', integral]; 2]`.
    CubicSplineUniform = "cubic-spline-uniform": Fn(UniformSplineProblem<'_>), |f, x| {
        let &[x0, h, m0, mn, q0, q1, ref y @ ..] = x else {
            return None;
        };
        f(UniformSplineProblem { x0, h, ends: [m0, mn], y, queries: [q0, q1] })
    };

    /// `Fn([crank, coupler, rocker, frame], phi1, positive assembly) -> [phi2, phi3, phi2', phi3',
    /// phi2'', phi3'', mu, x_C, y_C]`, metres and radians, derivatives by `phi1`.
    FourBar = "four-bar": Fn([f64; 4], f64, bool), |f, x| {
        let &[a, b, c, d, phi, side] = x else {
            return None;
        };
        f([a, b, c, d], phi, side > 0.0)
    };

    /// `Fn([crank, rod, offset], guide's angle, phi1, positive assembly) -> [x, x', x'', phi2,
    /// phi2', phi2'', mu]`, metres and radians, derivatives by `phi1`.
    SliderCrank = "slider-crank": Fn([f64; 3], f64, f64, bool), |f, x| {
        let &[a, b, e, delta, phi, side] = x else {
            return None;
        };
        f([a, b, e], delta, phi, side > 0.0)
    };

    /// `Fn(&[l1, l2, l3, l4, l5, lB, phiB, x3, y3, x5, y5], phi1) -> Vec<[phi2, phi3, phi4, phi5]>`,
    /// the modes by `phi4`; no mode at all is a refusal.
    ClassIiiAssemblyModes = "class-iii-assembly-modes": Fn(&[f64; 11], f64), |f, x|
        f(x.get(..11)?.try_into().ok()?, *x.get(11)?);

    /// `Fn(&[f64]) -> ` 16 values, inputs and outputs as `mechaudit list` lays them out.
    ClassIii = "class-iii": Fn(&[f64]), |f, x| f(x);

    /// `Fn(Complex<f64>) -> Complex<f64>`: W(z).
    Faddeeva = "faddeeva": Fn(Complex<f64>), |f, x| {
        let &[re, im] = x else {
            return None;
        };
        f(Complex::new(re, im))
    };

    /// `Fn(&[f64]) -> [phi, psi]`, inputs as `mechaudit list` lays them out.
    RunUp = "run-up": Fn(&[f64]), |f, x| f(x);
}

#[cfg(test)]
mod tests {
    use super::NAMES;

    #[test]
    fn every_name_is_in_the_registry() {
        for name in NAMES {
            assert!(crate::methods::find(name).is_some(), "{name}");
        }
    }
}
