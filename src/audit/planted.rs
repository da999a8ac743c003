//! A method for tests, each of whose parts can be planted. As it is: `x` for `x`, four ulps, one
//! region.

use super::*;
use mechaudit_reference::Ball;
use rug::Rational;

type Of<'a, T> = Box<dyn Fn(&[f64]) -> T + Sync + 'a>;
type Reference<'a> = Box<dyn Fn(&[Rational], u32) -> ReferenceAnswer + Sync + 'a>;

pub(crate) struct Planted<'a> {
    pub(crate) inputs: Vec<&'static str>,
    pub(crate) outputs: Vec<Output>,
    pub(crate) rows: Option<Rows>,
    pub(crate) norm: Option<NormBudget>,
    pub(crate) proved: Vec<ProvedBound>,
    pub(crate) domain: Domain,
    pub(crate) sampling: Sampling,
    pub(crate) format: Format,
    pub(crate) hard: Vec<HardCase>,
    pub(crate) laws: Vec<Law>,
    pub(crate) solve: Of<'a, SolverAnswer>,
    pub(crate) reference: Reference<'a>,
    pub(crate) not_finite: Of<'a, ReferenceAnswer>,
    pub(crate) signs: Of<'a, Vec<Option<bool>>>,
    pub(crate) conditions: Of<'a, Option<Vec<f64>>>,
    /// In place of the conditions where the reference is at hand.
    pub(crate) beside: Option<Of<'a, Option<Vec<f64>>>>,
    pub(crate) twin: Of<'a, Option<Vec<Ball>>>,
    pub(crate) branch: Of<'a, Option<BranchAt>>,
    pub(crate) admits: Of<'a, bool>,
    pub(crate) data: fn(usize) -> bool,
}

impl Default for Planted<'_> {
    fn default() -> Self {
        Planted {
            inputs: vec!["x"],
            outputs: vec![output("x", Limit::Ulps(4.0))],
            rows: None,
            norm: None,
            proved: Vec::new(),
            domain: Domain {
                regions: vec![region("middle", |d| vec![d.uniform(1.0, 2.0)])],
                check_points: Vec::new(),
            },
            sampling: Sampling::Domain,
            format: Format::Double,
            hard: Vec::new(),
            laws: Vec::new(),
            solve: Box::new(|x| SolverAnswer::Values(x.to_vec())),
            reference: Box::new(|x, bits| ReferenceAnswer::exact(x, bits)),
            not_finite: Box::new(|_| ReferenceAnswer::Refuses("not finite")),
            signs: Box::new(|_| Vec::new()),
            conditions: Box::new(|_| None),
            beside: None,
            twin: Box::new(|_| None),
            branch: Box::new(|_| None),
            admits: Box::new(|_| true),
            data: |_| true,
        }
    }
}

pub(crate) fn output(name: &'static str, limit: Limit) -> Output {
    let budget = Budget::new(limit, "planted");
    let unit = "1";
    Output { name, unit, budget }
}

pub(crate) fn region(name: &'static str, sample: fn(&mut Draw) -> Vec<f64>) -> Region {
    Region::new(name, "planted", sample)
}

pub(crate) fn point(name: &'static str, input: &[f64]) -> CheckPoint {
    let input = input.to_vec();
    CheckPoint { name, input }
}

pub(crate) fn hard(share: f64, output: &str, input: &[f64]) -> HardCase {
    HardCase {
        share,
        output: output.into(),
        reason: "planted".into(),
        input: input.to_vec(),
        folder: None,
    }
}

/// A case of the region `middle`.
pub(crate) fn case(index: u64, input: &[f64]) -> Case {
    Case {
        method: "planted",
        region: "middle",
        input: input.to_vec(),
        origin: Origin::Random { seed: 1, index },
    }
}

/// Returns `x` plus a number of ulps.
pub(crate) fn off(x: f64, ulps: u64) -> f64 {
    f64::from_bits(x.to_bits() + ulps)
}

impl Method for Planted<'_> {
    fn name(&self) -> &'static str {
        "planted"
    }
    fn summary(&self) -> &'static str {
        "a planted method"
    }
    fn source(&self) -> &'static str {
        "a planted source"
    }
    fn inputs(&self) -> Vec<Input> {
        let inputs = self.inputs.iter();
        inputs.map(|name| Input { name, unit: "1" }).collect()
    }
    fn outputs(&self) -> Vec<Output> {
        self.outputs.clone()
    }
    fn rows(&self) -> Option<Rows> {
        self.rows
    }
    fn norm_budget(&self) -> Option<NormBudget> {
        self.norm
    }
    fn proved(&self) -> Vec<ProvedBound> {
        self.proved.clone()
    }
    fn domain(&self) -> Domain {
        self.domain.clone()
    }
    fn sampling(&self) -> Sampling {
        self.sampling.clone()
    }
    fn solve(&self, input: &[f64]) -> SolverAnswer {
        (self.solve)(input)
    }
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        (self.reference)(input, bits)
    }
    fn reference_not_finite(&self, input: &[f64]) -> ReferenceAnswer {
        (self.not_finite)(input)
    }
    fn signs_of_zero(&self, input: &[f64]) -> Vec<Option<bool>> {
        (self.signs)(input)
    }
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        (self.conditions)(input)
    }
    fn conditions_beside(&self, input: &[f64], _: &ReferenceAnswer) -> Option<Vec<f64>> {
        self.beside.as_ref().unwrap_or(&self.conditions)(input)
    }
    fn twin(&self, input: &[f64]) -> Option<Vec<Ball>> {
        (self.twin)(input)
    }
    fn format(&self) -> Format {
        self.format
    }
    fn branch(&self, input: &[f64]) -> Option<BranchAt> {
        (self.branch)(input)
    }
    fn is_data(&self, k: usize) -> bool {
        (self.data)(k)
    }
    fn hard(&self) -> Vec<HardCase> {
        self.hard.clone()
    }
    fn admits(&self, input: &[f64]) -> bool {
        (self.admits)(input)
    }
    fn laws(&self) -> Vec<Law> {
        self.laws.clone()
    }
}
