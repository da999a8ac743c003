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
}
