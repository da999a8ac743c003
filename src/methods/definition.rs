//! The definition of a method in its file, and the [`Method`] that the registry makes of it.

use super::certified::CertifiedValue;
use super::inputs::{Field, Fields, Number};
use crate::audit::{
    BranchAt, Domain, HardCase, Input, Law, Layout, Method, NormBudget, Output, ProvedBound,
    ReferenceAnswer, Rows, SolverAnswer, Uncertified, conditions_by_differences,
};
use crate::reference::Ball;
use crate::reference::faddeeva::Scaled;
use rug::Rational;
use std::marker::PhantomData;

/// A method of the registry as a type.
pub trait Typed {
    /// Its name in the registry.
    const NAME: &'static str;
    /// The signature of a candidate in Rust, but for its result.
    const SIGNATURE: &'static str;
}

/// A method of the registry that this crate defines.
pub trait Registered: Typed + Sync + 'static {}

/// Registers a type: its name, which is also that of its files of hard cases and of certified
/// values; the signature of a candidate, and how one is called with an input.
macro_rules! method {
    ($method:ident $name:literal: Fn($($argument:ty),*), |$f:ident, $input:pat_param| $call:expr) => {
        impl $crate::methods::definition::Typed for $method {
            const NAME: &'static str = $name;
            const SIGNATURE: &'static str = stringify!(Fn($($argument),*));
        }

        impl $crate::methods::definition::Registered for $method {}

        impl<F, R> $crate::methods::typed::Candidate<$method> for F
        where
            F: Fn($($argument),*) -> R + Sync,
            R: $crate::methods::typed::IntoAnswer,
        {
            fn answer(&self, numbers: &[f64]) -> $crate::audit::SolverAnswer {
                let $f = self;
                let input = <$method as $crate::methods::definition::Definition>::unpack(numbers);
                $crate::methods::typed::IntoAnswer::into_answer(input.map(|$input| $call))
            }
        }
    };
}
pub(super) use method;

/// Declares the files of a subject, each with the types of its methods, in the order of reports.
macro_rules! methods {
    ($($visibility:vis $module:ident: $($method:ident),+;)+) => {
        $(
            $visibility mod $module;
            pub use $module::*;
        )+

        /// The methods of this subject.
        pub(super) fn methods() -> Vec<Box<dyn $crate::methods::definition::Evaluable>> {
            vec![$($(Box::new($crate::methods::definition::Entry::<$method>::NEW)),+),+]
        }
    };
}
pub(super) use methods;

// `hard(name)`: the text of `reference/hard/NAME.csv`, or nothing if there is no such file.
include!(concat!(env!("OUT_DIR"), "/hard.rs"));

/// Solver, reference, domain, budget and source of a method; [`Method`] says more of each.
pub trait Definition: Registered + Sized {
    /// Describes what the input holds.
    type Input<'a, T: Number>: Fields<'a, T>;
    /// One line in plain words.
    const SUMMARY: &'static str;
    /// Where the method comes from.
    const SOURCE: &'static str;

    fn outputs() -> Vec<Output>;
    fn rows() -> Option<Rows> {
        None
    }
    fn norm_budget() -> Option<NormBudget> {
        None
    }
    /// Returns what is proved of the solver's error.
    fn proved() -> Vec<ProvedBound> {
        Vec::new()
    }
    fn domain() -> Domain;
    /// Calls the code under test; its refusal by name.
    fn solve(input: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str>;
    fn reference(
        input: Self::Input<'_, Rational>,
        bits: u32,
    ) -> Result<ReferenceAnswer, Uncertified>;
    /// The word by which code of the method's kind may refuse an input that has values.
    fn may_refuse(_input: Self::Input<'_, Rational>) -> Option<&'static str> {
        None
    }
    fn reference_not_finite(_input: Self::Input<'_, f64>) -> ReferenceAnswer {
        ReferenceAnswer::Refuses("not finite")
    }
    fn signs_of_zero(_input: Self::Input<'_, f64>) -> Vec<Option<bool>> {
        Vec::new()
    }
    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        let is_data = Self::layout().is_data(&Entry::<Self>::NEW, numbers);
        conditions_by_differences(&Entry::<Self>::NEW, numbers, |j| is_data[j])
    }
    /// [`Definition::conditions`] where the reference's values are at hand.
    fn conditions_at(numbers: &[f64], _values: &[Ball]) -> Option<Vec<f64>> {
        Self::conditions(numbers)
    }
    fn twin(_input: Self::Input<'_, f64>) -> Option<Vec<Ball>> {
        None
    }
    fn admits(_input: Self::Input<'_, f64>) -> bool {
        true
    }
    /// By which formula the solver computes, and where the nearest other one begins.
    fn branch(_input: Self::Input<'_, f64>) -> Option<BranchAt> {
        None
    }
    fn laws() -> Vec<Law>;

    /// Why `eval` refuses an input, in words, where there is more to say than the solver's name for
    /// it.
    fn refusal(_input: Self::Input<'_, f64>) -> Option<String> {
        None
    }
    /// The place and the rule behind a refusal of the solver, in words: which knot, which entry.
    fn explanation(_input: Self::Input<'_, f64>) -> Option<String> {
        None
    }
    /// Values whose relative radius shrinks with `2^-bits`, for `eval`: those of the reference,
    /// unless it can say more of them than an `f64` could hold.
    fn certify(input: Self::Input<'_, Rational>, bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        let values = Self::reference(input, bits)?.certified()?;
        Ok(values.into_iter().map(Scaled::from).collect())
    }

    /// The declaration of the input.
    fn fields() -> Vec<Field> {
        <Self::Input<'static, f64> as Fields<'static, f64>>::fields()
    }
    /// Returns the layout of the input.
    fn layout() -> &'static Layout {
        <Self::Input<'static, f64> as Fields<'static, f64>>::layout()
    }
    /// Takes an input apart. Returns nothing if its numbers are not laid out as declared.
    fn unpack<T: Number>(numbers: &[T]) -> Option<Self::Input<'_, T>> {
        Self::Input::unpack(numbers)
    }
}

/// A method that can be evaluated at any input.
pub trait Evaluable: Method {
    /// Returns the signature in Rust of a candidate, but for its result, where there is one.
    fn signature(&self) -> Option<&'static str> {
        None
    }
    /// Returns the field of each part of the input in the type that declares it.
    fn fields(&self) -> Vec<String> {
        Vec::new()
    }
    /// Values whose relative radius shrinks with `2^-bits`.
    ///
    /// # Errors
    /// An input without such values.
    fn certify(&self, numbers: &[Rational], bits: u32) -> Result<Vec<Scaled>, Uncertified>;
    /// Why the input is refused, in words, where there is more to say than the solver's name for
    /// it.
    fn refusal(&self, numbers: &[f64]) -> Option<String>;
    /// The place and the rule behind a refusal, in words, where its name leaves them open.
    fn explanation(&self, numbers: &[f64]) -> Option<String>;
    /// Certified decimals of all values, where the method knows more of single values than
    /// [`Evaluable::certify`] does: that one is undefined, or undecided beside others.
    fn digits(&self, _numbers: &[Rational], _digits: u32) -> Option<Vec<CertifiedValue>> {
        None
    }
    /// Returns true if the method has a solver to be audited.
    fn has_solver(&self) -> bool {
        true
    }
    /// Audits another of the method's own solvers.
    ///
    /// # Errors
    /// A name that is not the name of a solver.
    fn select_solver(&mut self, name: &str) -> Result<(), String> {
        Err(format!(
            "{} has one solver, and none of the name {name:?}",
            self.name()
        ))
    }
}

/// The method that a definition makes.
pub(super) struct Entry<D>(PhantomData<fn() -> D>);

impl<D> Entry<D> {
    pub(super) const NEW: Entry<D> = Entry(PhantomData);
}

const BAD_LAYOUT: &str = "bad layout";

impl<D: Definition> Method for Entry<D> {
    fn name(&self) -> &'static str {
        D::NAME
    }
    fn summary(&self) -> &'static str {
        D::SUMMARY
    }
    fn source(&self) -> &'static str {
        D::SOURCE
    }
    fn inputs(&self) -> Vec<Input> {
        D::fields().into_iter().map(|f| f.input).collect()
    }
    fn outputs(&self) -> Vec<Output> {
        D::outputs()
    }
    fn rows(&self) -> Option<Rows> {
        D::rows()
    }
    fn norm_budget(&self) -> Option<NormBudget> {
        D::norm_budget()
    }
    fn proved(&self) -> Vec<ProvedBound> {
        D::proved()
    }
    fn domain(&self) -> Domain {
        D::domain()
    }
    fn solve(&self, numbers: &[f64]) -> SolverAnswer {
        match D::unpack(numbers).ok_or(BAD_LAYOUT).and_then(D::solve) {
            Ok(values) => SolverAnswer::Values(values),
            Err(word) => SolverAnswer::Refuses(word),
        }
    }
    fn reference(&self, numbers: &[Rational], bits: u32) -> ReferenceAnswer {
        let input = D::unpack(numbers).ok_or(Uncertified::Refused(BAD_LAYOUT));
        input
            .and_then(|input| D::reference(input, bits))
            .unwrap_or_else(ReferenceAnswer::from)
    }
    fn may_refuse(&self, numbers: &[Rational]) -> Option<&'static str> {
        D::may_refuse(D::unpack(numbers)?)
    }
    fn reference_not_finite(&self, numbers: &[f64]) -> ReferenceAnswer {
        let refused = ReferenceAnswer::Refuses(BAD_LAYOUT);
        D::unpack(numbers).map_or(refused, D::reference_not_finite)
    }
    fn signs_of_zero(&self, numbers: &[f64]) -> Vec<Option<bool>> {
        D::unpack(numbers).map_or(Vec::new(), D::signs_of_zero)
    }
    fn conditions(&self, numbers: &[f64]) -> Option<Vec<f64>> {
        D::conditions(numbers)
    }
    fn conditions_beside(&self, numbers: &[f64], reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        match reference {
            ReferenceAnswer::Values(r) => D::conditions_at(numbers, &r.values),
            ReferenceAnswer::Refuses(_) | ReferenceAnswer::Failed(_) => None,
            ReferenceAnswer::Expected(..) | ReferenceAnswer::Undecided(_) => D::conditions(numbers),
        }
    }
    fn twin(&self, numbers: &[f64]) -> Option<Vec<Ball>> {
        D::twin(D::unpack(numbers)?)
    }
    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(hard(D::NAME))
    }
    fn branch(&self, numbers: &[f64]) -> Option<BranchAt> {
        D::branch(D::unpack(numbers)?)
    }
    fn is_data(&self, k: usize) -> bool {
        D::fields().get(k).is_none_or(|f| f.is_data)
    }
    fn admits(&self, numbers: &[f64]) -> bool {
        D::unpack(numbers).is_some_and(D::admits)
    }
    fn laws(&self) -> Vec<Law> {
        D::laws()
    }
}

impl<D: Definition> Evaluable for Entry<D> {
    fn signature(&self) -> Option<&'static str> {
        Some(D::SIGNATURE)
    }
    fn fields(&self) -> Vec<String> {
        D::fields().into_iter().map(|f| f.path).collect()
    }
    fn certify(&self, numbers: &[Rational], bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        D::certify(
            D::unpack(numbers).ok_or(Uncertified::Refused(BAD_LAYOUT))?,
            bits,
        )
    }
    fn refusal(&self, numbers: &[f64]) -> Option<String> {
        D::refusal(D::unpack(numbers)?)
    }
    fn explanation(&self, numbers: &[f64]) -> Option<String> {
        D::explanation(D::unpack(numbers)?)
    }
}

/// [`Definition::conditions`] by [`Definition::conditions_at`] at values of `bits` bits, or of up
/// to eight times as many where the reference is undecided with fewer.
pub(super) fn conditions_at_reference<D: Definition>(
    numbers: &[f64],
    bits: u32,
) -> Option<Vec<f64>> {
    let exact = exact(numbers)?;
    for bits in [1, 2, 4, 8].map(|times| times * bits) {
        let answer = D::reference(D::unpack(&exact)?, bits);
        match answer.and_then(ReferenceAnswer::certified) {
            Ok(values) => return D::conditions_at(numbers, &values),
            Err(Uncertified::Undecided(_)) => {}
            Err(_) => return None,
        }
    }
    None
}

/// The numbers as exact fractions, if all are finite.
pub(super) fn exact(numbers: &[f64]) -> Option<Vec<Rational>> {
    numbers.iter().map(|&x| Rational::from_f64(x)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::find;

    /// A number too few, one too many, none.
    #[test]
    fn what_is_not_laid_out_as_it_should_be_is_refused() {
        for name in ["four-bar", "faddeeva", "cam-law", "planar-linkage"] {
            let method = find(name).unwrap();
            let good = method.domain().check_points[0].input.clone();
            assert!(method.admits(&good), "{name}");
            let longer = [&good[..], &[0.5]].concat();
            for bad in [&good[..good.len() - 1], &longer, &[]] {
                let exact = exact(bad).unwrap();
                assert_eq!(method.solve(bad), SolverAnswer::Refuses("bad layout"));
                for answer in [
                    method.reference(&exact, 128),
                    method.reference_not_finite(bad),
                ] {
                    assert!(
                        matches!(answer, ReferenceAnswer::Refuses("bad layout")),
                        "{name}"
                    );
                }
                assert!(method.signs_of_zero(bad).is_empty() && method.twin(bad).is_none());
                assert!(
                    method.branch(bad).is_none() && !method.admits(bad),
                    "{name}"
                );
                assert_eq!(method.refusal(bad), None, "{name}");
                let refused = Err(Uncertified::Refused(BAD_LAYOUT));
                assert_eq!(method.certify(&exact, 64).map(|_| ()), refused, "{name}");
            }
        }
    }

    #[test]
    fn conditions_are_those_of_values_or_of_what_is_not_decided() {
        let method = find("four-bar").unwrap();
        let input = [1.0, 3.0, 4.0, 6.0, 0.0, 1.0];
        let due = method.conditions(&input);
        assert!(due.is_some());
        let exact = exact(&input).unwrap();
        let values = method.reference(&exact, 128);
        let beside = |answer: &ReferenceAnswer| method.conditions_beside(&input, answer);
        assert!(matches!(values, ReferenceAnswer::Values(_)));
        assert_eq!(beside(&values), due);
        assert_eq!(beside(&ReferenceAnswer::Undecided("few bits".into())), due);
        assert_eq!(beside(&ReferenceAnswer::Refuses("singular")), None);
        assert_eq!(beside(&ReferenceAnswer::Failed("lost".into())), None);
    }

    /// The side of a four-bar is chosen; a number that there is not counts as data.
    #[test]
    fn numbers_that_choose_are_no_data() {
        let method = find("four-bar").unwrap();
        let data: Vec<bool> = (0..8).map(|k| method.is_data(k)).collect();
        assert_eq!(data, [true, true, true, true, true, false, true, true]);
    }

    #[test]
    fn fractions_are_those_of_finite_numbers() {
        let halves = [0.5, -1.5].map(|x| Rational::from_f64(x).unwrap());
        assert_eq!(exact(&[0.5, -1.5]), Some(halves.to_vec()));
        assert_eq!(exact(&[]), Some(Vec::new()));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(exact(&[0.5, bad]), None);
        }
    }

    /// Functions that have limits say what is due; others refuse.
    #[test]
    fn what_is_not_finite_is_refused_without_a_limit() {
        let refused = find("four-bar").unwrap();
        let input = [1.0, 3.0, 4.0, f64::INFINITY, 0.0, 1.0];
        let answer = refused.reference_not_finite(&input);
        assert!(matches!(answer, ReferenceAnswer::Refuses("not finite")));
        assert!(refused.signs_of_zero(&input).is_empty() && refused.twin(&input).is_none());
        let limit = find("faddeeva").unwrap();
        let found = limit.reference_not_finite(&[f64::INFINITY, 0.0]);
        assert!(matches!(found, ReferenceAnswer::Expected(..)));
    }

    /// Numbers of vectors are boxed in inputs that are long enough; the others are drawn again.
    #[test]
    fn elements_of_vectors_may_be_boxed() {
        use crate::audit::{Cases, SampleBox, Sampling, Settings, Variant};
        let settings = Settings {
            cases_per_region: 20,
            ..Settings::default()
        };
        for (name, text, bounds) in [
            ("cam-law", "parameters[0]=0.25..0.5,x=0..1", 0.25..=0.5),
            ("tridiagonal", "diagonal[3]=7..8", 7.0..=8.0),
        ] {
            let method = find(name).unwrap();
            let (part, k) = match name {
                "cam-law" => (4, 0),
                _ => (1, 3),
            };
            let sides = SampleBox::read(&*method, text).unwrap();
            let variant = Variant::new(&*method).sampling(Sampling::Box(sides));
            let cases = Cases::new(&variant, &settings);
            let layout = Layout::new(&*method);
            assert!(cases.len() > 20);
            for case in (0..cases.len()).map(|i| cases.get(i)) {
                let at = layout.place(part, k, &case.input).expect(name);
                assert!(bounds.contains(&case.input[at]), "{name}: {:?}", case.input);
            }
        }
        let method = find("tridiagonal").unwrap();
        for (text, due) in [
            (
                "diagonal[99]=1",
                "no region of tridiagonal draws diagonal[99]: its vector is shorter",
            ),
            ("diagonal=1", "tridiagonal has no input \"diagonal\""),
            ("x[0]=1", "tridiagonal has no input \"x[0]\""),
        ] {
            let why = SampleBox::read(&*method, text).unwrap_err().to_string();
            assert!(why.starts_with(due), "{why}");
        }
    }
}
