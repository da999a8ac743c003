//! A method over a domain of one's own.

use crate::audit::{
    BranchAt, Domain, HardCase, Input, Law, Method, NormBudget, Output, ReferenceAnswer, Region,
    SolverAnswer,
};
use rug::Rational;

type Admits<'a> = Box<dyn Fn(&[f64]) -> bool + Sync + 'a>;

/// The method with these regions alone; a hunt stays where `admits` holds.
pub struct Placed<'a> {
    method: &'a dyn Method,
    regions: Vec<Region>,
    admits: Admits<'a>,
}

impl<'a> Placed<'a> {
    pub fn new(
        method: &'a dyn Method,
        regions: Vec<Region>,
        admits: impl Fn(&[f64]) -> bool + Sync + 'a,
    ) -> Placed<'a> {
        Placed {
            method,
            regions,
            admits: Box::new(admits),
        }
    }
}

impl Method for Placed<'_> {
    fn name(&self) -> &'static str {
        self.method.name()
    }
    fn summary(&self) -> &'static str {
        self.method.summary()
    }
    fn source(&self) -> &'static str {
        self.method.source()
    }
    fn inputs(&self) -> Vec<Input> {
        self.method.inputs()
    }
    fn outputs(&self) -> Vec<Output> {
        self.method.outputs()
    }
    fn norm_budget(&self) -> Option<NormBudget> {
        self.method.norm_budget()
    }
    fn domain(&self) -> Domain {
        Domain {
            regions: self.regions.clone(),
            check_points: Vec::new(),
        }
    }
    fn solve(&self, input: &[f64]) -> SolverAnswer {
        self.method.solve(input)
    }
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        self.method.reference(input, bits)
    }
    fn reference_not_finite(&self, input: &[f64]) -> ReferenceAnswer {
        self.method.reference_not_finite(input)
    }
    fn signs_of_zero(&self, input: &[f64]) -> Vec<Option<bool>> {
        self.method.signs_of_zero(input)
    }
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        self.method.conditions(input)
    }
    fn branch(&self, _input: &[f64]) -> Option<BranchAt> {
        None
    }
    fn hard(&self) -> Vec<HardCase> {
        Vec::new()
    }
    fn admits(&self, input: &[f64]) -> bool {
        self.method.admits(input) && (self.admits)(input)
    }
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::find;

    #[test]
    fn conditions_are_those_of_the_method() {
        let method = find("four-bar").unwrap();
        let placed = Placed::new(&*method, Vec::new(), |_| true);
        let input = &method.domain().check_points[0].input;
        let found = placed.conditions(input);
        assert!(found.is_some() && found == method.conditions(input));
    }

    /// What a claim says is of the method, where it says it is its own.
    #[test]
    fn a_placed_method_is_the_method_elsewhere() {
        for name in ["faddeeva", "four-bar"] {
            let method = find(name).unwrap();
            let region = method.domain().regions[0].clone();
            let placed = Placed::new(&*method, vec![region.clone()], |z| z[1] > 0.0);
            let names = |of: &dyn Method| {
                let inputs = of.inputs().into_iter().map(|i| i.name);
                let outputs: Vec<&str> = of.outputs().iter().map(|o| o.name).collect();
                (inputs.collect::<Vec<_>>(), outputs)
            };
            assert_eq!(names(&placed), names(&*method));
            assert!(!names(&placed).0.is_empty() && !names(&placed).1.is_empty());
            let limit = |of: &dyn Method| of.norm_budget().map(|b| format!("{b:?}"));
            assert_eq!(limit(&placed), limit(&*method));
            let domain = placed.domain();
            let regions: Vec<&str> = domain.regions.iter().map(|r| r.name).collect();
            assert_eq!(regions, [region.name]);
            assert!(domain.check_points.is_empty() && placed.hard().is_empty());
            assert!(placed.laws().is_empty() && !method.laws().is_empty());
            let input = &method.domain().check_points[0].input;
            assert_eq!(placed.solve(input), method.solve(input));
            assert_eq!(placed.signs_of_zero(input), method.signs_of_zero(input));
            assert!(placed.branch(input).is_none());
        }
    }

    #[test]
    fn a_hunt_stays_where_both_admit_it() {
        let method = find("faddeeva").unwrap();
        let right = Placed::new(&*method, Vec::new(), |z| z[0] > 0.0);
        let both = Placed::new(&right, Vec::new(), |z| z[1] > 0.0);
        for (z, due) in [
            ([1.0, 1.0], true),
            ([-1.0, 1.0], false),
            ([1.0, -1.0], false),
            ([-1.0, -1.0], false),
        ] {
            assert_eq!(both.admits(&z), due, "{z:?}");
        }
    }
}
