//! Laws of motion of cam followers.

use super::cam_law_input::{self as input, LawInput};
use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, Proof,
    Reference, ReferenceAnswer, Region, SolverAnswer, conditions_by_differences,
};
use crate::reference::Ball;
use rug::Rational;

/// Input: the place on the stroke, then a law. Output: `s`, `1 − s`, `s'`, `s''`, `s'''`.
pub struct Audit;

const VALUES: usize = 5;

fn law(x: &[f64]) -> Option<(f64, LawInput<'_, f64>)> {
    let (&place, rest) = x.split_first()?;
    let (law, rest) = LawInput::split(rest)?;
    rest.is_empty().then_some((place, law))
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "cam-law"
    }

    fn summary(&self) -> &'static str {
        "displacement, what is left of it, velocity, acceleration and jerk of cam laws"
    }

    fn source(&self) -> &'static str {
        "SCCA family and polynomials: Norton, Cam Design and Manufacturing Handbook, ch. 3; splines: \
         Zinchenko 2008, eqs (8)-(17)"
    }

    fn inputs(&self) -> Vec<Input> {
        let mut all = vec![Input {
            name: "x",
            unit: "1",
        }];
        all.extend(input::inputs());
        all
    }

    fn outputs(&self) -> Vec<Output> {
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
            .map(|name| {
                let budget = if name.contains('\'') {
                    budget
                } else {
                    complement
                };
                Output {
                    name,
                    unit: "1",
                    budget,
                }
            })
            .to_vec()
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/cam-law.csv"))
    }

    fn domain(&self) -> Domain {
        let region = |name, description, sample| Region {
            name,
            description,
            sample,
        };
        let named = |name, x: f64, b: f64, d: f64| CheckPoint {
            name,
            input: vec![x, input::SCCA, 0.5, 2.0, b, d],
        };
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

    fn admits(&self, x: &[f64]) -> bool {
        law(x).is_some_and(|(_, law)| law.is_whole())
    }

    fn solve(&self, x: &[f64]) -> SolverAnswer {
        let Some((place, law)) = law(x) else {
            return SolverAnswer::Refuses("bad layout");
        };
        let Ok(law) = law.solver() else {
            return SolverAnswer::Refuses("law");
        };
        match (law.motion(place), law.remaining(place)) {
            (Ok(m), Ok(left)) => SolverAnswer::Values(vec![
                m.displacement,
                left,
                m.velocity,
                m.acceleration,
                m.jerk,
            ]),
            _ => SolverAnswer::Refuses("place"),
        }
    }

    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        match reference_jet(x, bits) {
            Some([s, v, a, j, _]) => ReferenceAnswer::Values(Reference {
                values: vec![s.clone(), Ball::integer(bits, 1) - s, v, a, j],
                proof: Proof::Bounded(
                    "exact polynomials; SCCA zones integrated in balls (reference::cam_law)",
                ),
            }),
            None => ReferenceAnswer::Refuses("bad layout"),
        }
    }

    /// The place as the only number that is known to half an ulp; of a table also its data.
    fn conditions(&self, x: &[f64]) -> Option<Vec<f64>> {
        let exact: Option<Vec<Rational>> = x.iter().map(|&x| Rational::from_f64(x)).collect();
        let exact = exact?;
        let [_, v, a, j, k] = reference_jet(&exact, 256)?;
        let moved = [&v, &v, &a, &j, &k].map(|d| x[0] * d.magnitude().to_f64());
        if x[1] != input::TABLE {
            return Some(moved.to_vec());
        }
        let inner = |i: usize| input::table_data(x, 1, i);
        let data = conditions_by_differences(self, x, inner)?;
        Some(data.iter().zip(moved).map(|(a, b)| a + b).collect())
    }

    fn laws(&self) -> Vec<Law> {
        vec![Law {
            name: "complement",
            statement: "s + (1 - s) is 1 within 2^-52 of the larger of the two",
            residual: complement,
        }]
    }
}

fn reference_jet(x: &[Rational], bits: u32) -> Option<[Ball; VALUES]> {
    let (place, rest) = x.split_first()?;
    let (law, rest) = LawInput::split(rest)?;
    let law = law.reference()?;
    rest.is_empty().then(|| law.jet(place, bits))
}

fn complement(x: &[f64]) -> Option<f64> {
    let SolverAnswer::Values(v) = Audit.solve(x) else {
        return None;
    };
    let size = v[0].abs().max(v[1].abs()).max(1.0);
    Some((v[0] + v[1] - 1.0).abs() / (f64::EPSILON * size))
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
