//! Each method's signature as a type, for code of users: see [`audit`](crate::audit()).

use crate::audit::SolverAnswer;
use num_complex::Complex;

/// Code that can be audited as the method `M`: a function with the signature that `M` documents.
///
/// The compiler says which one that is:
///
/// ```compile_fail
/// // error: this is no candidate for `Faddeeva`
/// mechaudit::audit::<mechaudit::methods::Faddeeva>(|x: f64, y: f64| x + y);
/// ```
#[diagnostic::on_unimplemented(
    message = "this is no candidate for `{M}`",
    label = "not a function with the signature of `{M}`",
    note = "`{M}` documents the signature, and `mechaudit describe` prints it",
    note = "the arguments of a closure need their types: `|z: Complex64| …` with `mechaudit::Complex64`",
    note = "it returns numbers in the order of the outputs (`f64`, `Complex64`, `Vec<f64>`, arrays of \
            them), or an `Option` or `Result` of those, and is `Sync`"
)]
pub trait Candidate<M>: Sync {
    /// Its answer to an input in the method's layout.
    fn answer(&self, input: &[f64]) -> SolverAnswer;
}

/// Describes what a candidate may return: numbers in the order of the method's outputs, or a
/// refusal.
///
/// `None` and `Err` are refusals without a reason, right wherever the reference refuses.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no answer of a candidate",
    label = "neither numbers nor a refusal",
    note = "a candidate returns `f64`, `Complex64`, `Vec<f64>`, `[f64; N]`, rows of those, or an `Option` or \
            `Result` of them"
)]
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_numbers_in_a_row_or_refusals() {
        let values = |v: &[f64]| SolverAnswer::Values(v.to_vec());
        let declined = SolverAnswer::Declines(None);
        let z = Complex::new(1.0, 2.0);
        let rows = [[1.0, 2.0], [3.0, 4.0]];
        for (answer, due) in [
            (1.0.into_answer(), values(&[1.0])),
            (z.into_answer(), values(&[1.0, 2.0])),
            (vec![3.0, 1.0].into_answer(), values(&[3.0, 1.0])),
            ([3.0, 1.0].into_answer(), values(&[3.0, 1.0])),
            (rows.into_answer(), values(&[1.0, 2.0, 3.0, 4.0])),
            (rows.to_vec().into_answer(), values(&[1.0, 2.0, 3.0, 4.0])),
            (Some(1.0).into_answer(), values(&[1.0])),
            (None::<f64>.into_answer(), declined.clone()),
            (Ok::<_, String>(z).into_answer(), values(&[1.0, 2.0])),
            (Err::<f64, _>("why").into_answer(), declined.clone()),
            (Ok::<_, ()>(None::<f64>).into_answer(), declined),
            (
                SolverAnswer::Refuses("singular").into_answer(),
                SolverAnswer::Refuses("singular"),
            ),
        ] {
            assert_eq!(answer, due);
        }
    }
}
