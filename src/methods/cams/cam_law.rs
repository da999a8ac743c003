//! Laws of motion of cam followers.

use super::law_input::{self as input, LawInput};
use crate::audit::{
    Budget, Domain, Draw, Law, Limit, Output, ReferenceAnswer, Uncertified,
    conditions_by_differences,
};
use crate::methods::common::{output, point, region};
use crate::methods::definition::{Definition, Entry, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::Ball;
use rug::Rational;

inputs! {
    /// A place on the stroke of a cam law.
    pub struct CamLawInput {
        x: number "x", "1";
        kind: choice "kind (0 SCCA, 1 3-4-5, 2 4-5-6-7, 3 polynomial, 4 table)", "1";
        share: number "share (of the stroke spent accelerating)", "1";
        p: choice "p (number of parameters)", "1";
        parameters: list "parameters[p] (SCCA: b, d; polynomial: c_1 …; table: x_0 …, y_0 …)", "1";
    }
}

impl<'a, T: Number> CamLawInput<'a, T> {
    fn law(&self) -> Option<LawInput<'a, T>> {
        LawInput::new(T::near(self.kind), self.share, self.parameters)
    }
}

/// Laws of motion of cam followers: `s`, `1 − s`, `s'`, `s''`, `s'''` at a place on the stroke.
///
/// A candidate is a `Fn(CamLawInput) -> [f64; 5]`.
#[derive(Clone, Copy, Debug)]
pub struct CamLaw;

method! {
    CamLaw "cam-law": Fn(CamLawInput<'_>), |f, i| f(i)
}

impl Definition for CamLaw {
    type Input<'a, T: Number> = CamLawInput<'a, T>;
    const SUMMARY: &'static str =
        "displacement, what is left of it, velocity, acceleration and jerk of cam laws";
    const SOURCE: &'static str = "SCCA family and polynomials: Norton, Cam Design and Manufacturing Handbook, ch. 3; splines: \
         Zinchenko 2008, eqs (8)-(17)";

    fn outputs() -> Vec<Output> {
        let budget = Budget::new(
            Limit::Conditioned(6.0),
            "the place within the law is rounded up to three times, each as good as half an ulp of \
             x; then some five operations without cancellation",
        );
        let complement = Budget::new(
            Limit::Conditioned(16.0),
            "s is 1 less the rest where the law decelerates, and the rest 1 less s before: with an \
             acceleration fraction of 0.05 that leaves up to nineteen times the error of the larger \
             one, two units of it; the condition is above 1 there",
        );
        ["s", "1 - s", "s'", "s''", "s'''"]
            .map(|name| match name.contains('\'') {
                true => output(name, "1", budget),
                false => output(name, "1", complement),
            })
            .to_vec()
    }

    fn domain() -> Domain {
        let named = |name, x: f64, b: f64, d: f64| point(name, [x, input::SCCA, 0.5, 2.0, b, d]);
        Domain {
            regions: vec![
                region(
                    "scca",
                    "any shares b, c, d, also none of one or two of them",
                    |d| at_any_place(d, input::any_scca),
                ),
                region("symmetric-polynomials", "3-4-5 and 4-5-6-7", |d| {
                    at_any_place(d, input::any_symmetric)
                }),
                region(
                    "asymmetric",
                    "SCCA, 3-4-5 and 4-5-6-7 with 5 to 95 % of the stroke spent accelerating",
                    |d| at_any_place(d, input::any_asymmetric),
                ),
                region(
                    "near-the-ends",
                    "all of these, 1e-15 to 1e-2 from an end of the stroke",
                    near_the_ends,
                ),
                region(
                    "polynomials",
                    "degree 1 to 12, coefficients up to 20",
                    |d| at_any_place(d, input::any_polynomial),
                ),
                region(
                    "tables",
                    "splines on 3 to 7 knots with zero end velocities",
                    |d| at_any_place(d, input::any_table),
                ),
            ],
            check_points: vec![
                named("harmonic-start", 0.0, 0.0, 1.0),
                named("harmonic-end", 1.0, 0.0, 1.0),
                named("constant-middle", 0.5, 0.0, 0.0),
                named("trapezoid-joint", 0.125, 0.25, 0.25),
                named("sine-only", 0.5, 1.0, 0.0),
            ],
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.law().is_some()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let law = i.law().ok_or("bad layout")?.solver().map_err(|_| "law")?;
        match (law.motion(i.x), law.remaining(i.x)) {
            (Ok(m), Ok(left)) => Ok(vec![
                m.displacement,
                left,
                m.velocity,
                m.acceleration,
                m.jerk,
            ]),
            _ => Err("place"),
        }
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let law = i.law().ok_or(Uncertified::Refused("bad layout"))?;
        let law = law.is_law().then(|| law.reference()).flatten();
        let law = law.ok_or(Uncertified::Refused("law"))?;
        if *i.x < 0 || *i.x > 1 {
            return Err(Uncertified::Refused("place"));
        }
        let [s, v, a, j, _] = law.jet(i.x, bits);
        Ok(ReferenceAnswer::bounded(
            vec![s.clone(), Ball::integer(bits, 1) - s, v, a, j],
            "exact polynomials; SCCA zones integrated in balls (reference::cam_law)",
        ))
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        match i.law()?.solver() {
            Ok(law) => law.motion(i.x).err().map(|e| e.to_string()),
            Err(e) => Some(e.to_string()),
        }
    }

    /// The place as the only number that is known to half an ulp; of a table also its inner data.
    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        let i = Self::unpack(numbers)?;
        let [_, v, a, j, k] = reference_jet(Self::unpack(&exact(numbers)?)?, 256)?;
        let moved = [&v, &v, &a, &j, &k].map(|d| i.x * d.magnitude().to_f64());
        let law = i.law()?;
        // Others have no data.
        if !law.is_table() {
            return Some(moved.to_vec());
        }
        let first = numbers.len() - i.parameters.len();
        let inner = |k: usize| k >= first && law.is_inner(k - first);
        let data = conditions_by_differences(&Entry::<Self>::NEW, numbers, inner)?;
        Some(data.iter().zip(moved).map(|(a, b)| a + b).collect())
    }

    fn laws() -> Vec<Law> {
        vec![Law {
            name: "complement",
            statement: "s + (1 - s) is 1 within 2^-52 of the larger of the two",
            residual: complement,
        }]
    }
}

fn reference_jet(i: CamLawInput<Rational>, bits: u32) -> Option<[Ball; 5]> {
    Some(i.law()?.reference()?.jet(i.x, bits))
}

fn complement(x: &[f64]) -> Option<f64> {
    match CamLaw::solve(CamLaw::unpack(x)?).ok()?[..] {
        [s, left, ..] => Some(off_one(s, left)),
        _ => None,
    }
}

fn off_one(s: f64, left: f64) -> f64 {
    let size = s.abs().max(left.abs()).max(1.0);
    (s + left - 1.0).abs() / (f64::EPSILON * size)
}

fn at_any_place(d: &mut Draw, law: fn(&mut Draw) -> Vec<f64>) -> Vec<f64> {
    let mut x = vec![d.unit()];
    x.extend(law(d));
    x
}

fn near_the_ends(d: &mut Draw) -> Vec<f64> {
    let off = d.log_uniform(1e-15, 1e-2);
    let law = [input::any_scca, input::any_symmetric, input::any_asymmetric][d.integer(0, 2)];
    let mut x = vec![if d.chance(0.5) { off } else { 1.0 - off }];
    x.extend(law(d));
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::SolverAnswer;

    #[test]
    fn what_is_no_law_or_no_place_on_it_is_refused_by_its_name() {
        let method = crate::methods::find("cam-law").unwrap();
        // x, kind, share, p, parameters
        for (input, due, admitted) in [
            (&[0.5, 5.0, 0.5, 0.0][..], "bad layout", false),
            (&[0.5, 0.0, 0.5, 1.0, 0.5], "bad layout", false),
            (&[0.5, 0.5, 0.5, 2.0, 0.0, 1.0], "bad layout", false),
            // Parts of a half and two thirds.
            (&[0.5, 0.0, 0.5, 2.0, 0.5, 0.75], "law", true),
            (&[0.5, 1.0, 1.0, 0.0], "law", true),
            (&[0.5, 3.0, 0.5, 2.0, 1.0, 0.5], "law", true),
            (&[0.5, 4.0, 0.5, 4.0, 0.25, 1.0, 0.0, 1.0], "law", true),
            (&[-1e-9, 1.0, 0.5, 0.0], "place", true),
            (&[1.0 + 1e-9, 1.0, 0.5, 0.0], "place", true),
        ] {
            assert_eq!(method.solve(input), SolverAnswer::Refuses(due), "{input:?}");
            assert_eq!(method.admits(input), admitted, "{input:?}");
            let answer = method.reference(&exact(input).unwrap(), 128);
            let word = matches!(answer, ReferenceAnswer::Refuses(word) if word == due);
            assert!(word, "{input:?}: {answer:?}");
        }
    }

    /// At mid-stroke the 3-4-5 law has s' = 15/8, s'' = 0, s''' = −30; by x that is half of each
    /// derivative's own.
    #[test]
    fn conditions_of_laws_without_data_are_those_of_the_place() {
        let found = CamLaw::conditions(&[0.5, 1.0, 0.5, 0.0]).unwrap();
        // s = 10x³ − 15x⁴ + 6x⁵ and its derivatives: 15/8, 15/8, 0, 30, 0 at 1/2.
        let due = [15.0 / 16.0, 15.0 / 16.0, 0.0, 15.0, 0.0];
        let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
        assert!(
            found.len() == 5 && found.iter().zip(&due).all(close),
            "{found:?}"
        );
        assert_eq!(CamLaw::conditions(&[0.5, 5.0, 0.5, 0.0]), None);
        assert_eq!(CamLaw::conditions(&[f64::NAN, 1.0, 0.5, 0.0]), None);
    }

    #[test]
    fn what_is_off_one_is_measured_by_the_larger_part() {
        let e = f64::EPSILON;
        for (s, left, due) in [
            (0.25, 0.75, 0.0),
            (0.25, 0.75 + e, 1.0),
            (0.25, 0.75 - e, 1.0),
            (5.0, -4.0 - 8.0 * e, 1.6),
            (-7.0, 8.0 + 16.0 * e, 2.0),
        ] {
            assert!((off_one(s, left) - due).abs() < 1e-12, "{s} {left}");
        }
    }
}
