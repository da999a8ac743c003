//! The four-bar linkage.

use super::{four_bar_laws, four_bar_regions};
use crate::audit::{
    Budget, Domain, HardCase, Input, Law, Limit, Method, Output, Proof, Reference, ReferenceAnswer,
    SolverAnswer, conditions_by_differences,
};
use crate::reference::dyad::{DyadRefusal, four_bar};
use crate::solvers::dyad::{Assembly, FourBar, FourBarMotion};
use crate::solvers::units::{Angle, Length};
use rug::Rational;
use std::cmp::Ordering;

/// Crank and RRR dyad: position, both derivatives, transmission angle.
pub struct Audit;

const POSITION: &str = "a mixed forward-backward stable position: a few roundings of each length \
    and of the crank angle, and of the three angles that are added";
const FIRST: &str = "the position's errors pass through the link directions into two quotients";
const SECOND: &str = "two squares of the first derivatives and the position's errors once more";

pub(super) fn motion(x: &[f64]) -> Result<FourBarMotion, &'static str> {
    let &[a, b, c, d, phi, side] = x else {
        return Err("layout");
    };
    let [a, b, c, d] = [a, b, c, d].map(Length::from_m);
    let side = if side > 0.0 {
        Assembly::Positive
    } else {
        Assembly::Negative
    };
    FourBar::new(a, b, c, d)
        .and_then(|bar| bar.position(Angle::from_rad(phi), side))
        .map_err(|e| e.name())
}

pub(super) fn values(m: &FourBarMotion) -> Vec<f64> {
    let (b, c) = (m.coupler, m.rocker);
    vec![
        b.angle.rad(),
        c.angle.rad(),
        b.first,
        c.first,
        b.second,
        c.second,
        m.transmission.rad(),
        m.joint.position_m[0],
        m.joint.position_m[1],
    ]
}

/// The word of a reference that gives no values.
pub(super) fn refusal(why: DyadRefusal) -> ReferenceAnswer {
    match why {
        DyadRefusal::NotPositive => ReferenceAnswer::Refuses("not positive"),
        DyadRefusal::CannotClose => ReferenceAnswer::Refuses("cannot close"),
        DyadRefusal::Unreachable => ReferenceAnswer::Refuses("unreachable"),
        DyadRefusal::Singular => ReferenceAnswer::Refuses("singular"),
        DyadRefusal::Undecided(u) => ReferenceAnswer::Undecided(u.to_string()),
    }
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "four-bar"
    }

    fn summary(&self) -> &'static str {
        "four-bar linkage: angles, derivatives by the crank angle, transmission angle"
    }

    fn source(&self) -> &'static str {
        "loop equation a e1 + b e2 = (d, 0) + c e3 and its derivatives, equations (1) to (6) of \
         the solver; Artobolevskii, Theory of Mechanisms and Machines, class-II groups"
    }

    fn inputs(&self) -> Vec<Input> {
        let input = |name, unit| Input { name, unit };
        vec![
            input("a (crank)", "m"),
            input("b (coupler)", "m"),
            input("c (rocker)", "m"),
            input("d (frame)", "m"),
            input("phi1", "rad"),
            input("assembly (1 or -1)", "1"),
        ]
    }

    fn outputs(&self) -> Vec<Output> {
        let output = |name, unit, k, reason| Output {
            name,
            unit,
            budget: Budget::new(Limit::Conditioned(k), reason),
        };
        vec![
            output("phi2", "rad", 4.0, POSITION),
            output("phi3", "rad", 4.0, POSITION),
            output("phi2'", "1", 8.0, FIRST),
            output("phi3'", "1", 8.0, FIRST),
            output("phi2''", "1", 12.0, SECOND),
            output("phi3''", "1", 12.0, SECOND),
            output("mu", "rad", 4.0, POSITION),
            output("x_C", "m", 8.0, POSITION),
            output("y_C", "m", 8.0, POSITION),
        ]
    }

    fn domain(&self) -> Domain {
        four_bar_regions::domain()
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/four-bar.csv"))
    }

    fn admits(&self, x: &[f64]) -> bool {
        x.len() == 6 && x[5].abs() == 1.0
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match motion(input) {
            Ok(m) => SolverAnswer::Values(values(&m)),
            Err(name) => SolverAnswer::Refuses(name),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let [a, b, c, d, phi, side] = input else {
            return ReferenceAnswer::Failed("six inputs are due".into());
        };
        let lengths = [a, b, c, d].map(Rational::clone);
        let m = match four_bar(&lengths, phi, side.cmp0() == Ordering::Greater, bits) {
            Ok(m) => m,
            Err(why) => return refusal(why),
        };
        let [phi2, first2, second2] = m.coupler;
        let [phi3, first3, second3] = m.rocker;
        let [x, y] = m.joint;
        ReferenceAnswer::Values(Reference {
            values: vec![
                phi2,
                phi3,
                first2,
                first3,
                second2,
                second3,
                m.transmission,
                x,
                y,
            ],
            proof: Proof::Bounded(
                "intersection of circles in ball arithmetic, implicit differentiation",
            ),
        })
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        conditions_by_differences(self, input, |j| j != 5)
    }

    fn laws(&self) -> Vec<Law> {
        four_bar_laws::all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Draw, Settings, audit_method};

    #[test]
    fn the_audit_passes_with_another_seed() {
        let settings = Settings {
            seed: 20_240_607,
            cases_per_region: 40,
            ..Settings::default()
        };
        let report = audit_method(&Audit, &settings, &|| ());
        let failed = report
            .failures
            .first()
            .map(|f| (&f.case, &f.judgement.reason));
        assert!(report.passed(), "{failed:?} {:?}", report.laws);
        assert!(report.laws.iter().all(|l| l.cases > 100));
    }

    #[test]
    fn refusing_regions_refuse() {
        let refused = |name: &str, word: &'static str| {
            let point = Audit
                .domain()
                .check_points
                .into_iter()
                .find(|p| p.name == name);
            assert_eq!(
                Audit.solve(&point.unwrap().input),
                SolverAnswer::Refuses(word)
            );
        };
        refused("folded-exactly", "singular");
        refused("never-closed", "cannot close");
        refused("out-of-reach", "unreachable");
        refused("too-near", "unreachable");
        let domain = Audit.domain();
        let region = domain
            .regions
            .iter()
            .find(|r| r.name == "unreachable")
            .unwrap();
        for i in 0..100 {
            let x = (region.sample)(&mut Draw::new(3, "m", "r", i));
            assert_eq!(Audit.solve(&x), SolverAnswer::Refuses("unreachable"));
        }
    }
}
