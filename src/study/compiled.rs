//! A problem made ready to be evaluated.

use super::error::StudyError;
use super::initial_value::Solution;
use super::problem::{Problem, StudyCondition, StudyOutput, StudySolver, intern};
use mechaudit_symbolic::evaluation::{
    Algebraic, Answer, Certified, Evaluator, Floating, Format, Goal, LIMIT,
};
use mechaudit_symbolic::graph::{Graph, Id};
use mechaudit_symbolic::{Definitions, SymbolicError};
use rug::Rational;
use std::sync::{Arc, Mutex, PoisonError};

/// A problem with its graphs.
pub struct Compiled {
    /// The problem.
    pub problem: Problem,
    graph: Arc<Graph>,
    algebra: Arc<Algebraic>,
    outputs: Vec<Id>,
    /// `∂f_i/∂x_j`; none where the language has no derivative.
    slopes: Option<Vec<Vec<Id>>>,
    /// Evaluators that no thread uses at the moment.
    idle: Mutex<Vec<Certified>>,
    /// The highest working precision.
    limit: u32,
    /// The solution of an initial value problem.
    pub(super) motion: Option<Solution>,
}

/// The graph, the nodes of conditions and zeros of differences of a problem in floating point.
pub(super) struct Sketch {
    graph: Arc<Graph>,
    /// The condition on all inputs.
    pub condition: Option<Id>,
    /// The conditions of regions.
    pub regions: Vec<Option<Id>>,
    /// The outputs.
    pub outputs: Vec<Id>,
}

/// The formulas of a solver.
pub(super) struct FloatSolver {
    graph: Arc<Graph>,
    formulas: Vec<Id>,
    meaning: Floating,
    idle: Mutex<Vec<Evaluator<Floating>>>,
}

fn graph_of(problem: &Problem) -> Graph {
    Graph::new(problem.inputs.iter().map(|i| i.name.clone()))
}

/// The graph with the unknowns of the problem's system.
pub(super) fn graph_with_system(mut graph: Graph, problem: &Problem) -> Result<Graph, StudyError> {
    if let Some(system) = &problem.system {
        let (unknowns, equations) = (&system.unknowns, &system.equations);
        let solved = graph.solve(&problem.definitions, unknowns, equations);
        solved.map_err(|e| StudyError::new(format!("the system: {e}")))?;
    }
    Ok(graph)
}

/// The outputs that are expressions of the inputs: a problem of linear algebra and an initial value
/// problem have none.
fn expressions(problem: &Problem) -> &[StudyOutput] {
    match problem.linear.is_some() || problem.initial_value.is_some() {
        true => &[],
        false => &problem.outputs,
    }
}

fn build(
    graph: &mut Graph,
    definitions: &Definitions,
    e: &mechaudit_symbolic::Expr,
    of: &str,
) -> Result<Id, StudyError> {
    let fault = |error: SymbolicError| StudyError::new(format!("{of}: {error}"));
    graph.build(definitions, e).map_err(fault)
}

impl Compiled {
    /// Builds the graphs of a problem.
    ///
    /// # Errors
    /// A formula without meaning, an output that is a complex number or a condition.
    pub fn new(problem: Problem) -> Result<Compiled, StudyError> {
        let mut graph = graph_with_system(graph_of(&problem).of_real_functions(), &problem)?;
        let definitions = &problem.definitions;
        let mut outputs = Vec::new();
        for output in expressions(&problem) {
            let id = build(&mut graph, definitions, &output.is, &output.name)?;
            if graph.is_complex(id) {
                let name = &output.name;
                let reason = format!("the output {name} is complex: take re(...) or im(...)");
                return Err(StudyError::new(reason));
            }
            if graph.is_condition(id) {
                let reason = format!("the output {} is a condition, not a number", output.name);
                return Err(StudyError::new(reason));
            }
            outputs.push(id);
        }
        let slopes = slopes(&mut graph, &outputs, problem.inputs.len());
        // The algebra knows nothing of unknowns.
        let unknowns: Vec<&str> = match &problem.system {
            Some(system) => system.unknowns.iter().map(|u| u.0.as_str()).collect(),
            None => Vec::new(),
        };
        let expressions = problem.outputs.iter().map(|o| o.is.clone());
        let known = outputs.iter().copied().zip(expressions);
        let algebra = Algebraic {
            definitions: definitions.clone(),
            expressions: known
                .filter(|(_, e)| !definitions.reaches(e, &unknowns))
                .collect(),
        };
        let motion = problem.initial_value.as_ref();
        let motion = motion.map(|of| Solution::new(&problem, of)).transpose()?;
        Ok(Compiled {
            motion,
            graph: Arc::new(graph),
            algebra: Arc::new(algebra),
            outputs,
            slopes,
            idle: Mutex::default(),
            limit: LIMIT,
            problem,
        })
    }

    /// Sets the highest working precision in bits.
    pub fn set_limit(&mut self, bits: u32) {
        self.limit = bits;
        if let Some(motion) = &mut self.motion {
            motion.set_limit(bits);
        }
        self.idle
            .get_mut()
            .unwrap_or_else(PoisonError::into_inner)
            .clear();
    }

    fn with<T>(&self, f: impl FnOnce(&mut Certified) -> T) -> T {
        let lock = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let idle = lock().pop();
        let mut certified = idle.unwrap_or_else(|| {
            Certified::new(self.graph.clone(), self.limit).with_algebra(self.algebra.clone())
        });
        let out = f(&mut certified);
        lock().push(certified);
        out
    }

    /// The values of all outputs.
    pub fn values(&self, inputs: &[Rational], goal: Goal) -> Vec<Answer> {
        self.with(|certified| certified.values(inputs, &self.outputs, goal))
    }

    /// `Σ_j |x_j ∂f_i/∂x_j|` for each output, to a few digits.
    pub fn conditions(&self, inputs: &[Rational]) -> Option<Vec<f64>> {
        /// Bits of the derivatives.
        const BITS: u32 = 24;
        if let Some(motion) = &self.motion {
            return motion.conditions(inputs);
        }
        let slopes = self.slopes.as_ref()?;
        self.with(|certified| {
            let of = |slopes: &Vec<Id>| {
                let mut sum = 0.0;
                for (j, slope) in slopes.iter().enumerate() {
                    if inputs[j] == 0 {
                        continue;
                    }
                    let answer = certified
                        .values(inputs, &[*slope], Goal::Double(BITS))
                        .pop()?;
                    let slope = match answer {
                        Answer::Zero => continue,
                        Answer::Number(ball) => ball,
                        Answer::Huge { .. } => return Some(f64::INFINITY),
                        Answer::Undefined { .. } | Answer::Undecided(_) => return None,
                    };
                    let x = crate::reference::Ball::rational(64, &inputs[j]);
                    sum += (&x * &slope).magnitude().to_f64();
                }
                Some(sum)
            };
            slopes.iter().map(of).collect()
        })
    }
}

/// The derivatives of all outputs by all inputs.
fn slopes(graph: &mut Graph, outputs: &[Id], inputs: usize) -> Option<Vec<Vec<Id>>> {
    let mut all = Vec::new();
    for output in outputs {
        let mut row = Vec::new();
        for k in 0..inputs {
            let leaf = graph.input(k);
            row.push(graph.derivative(*output, leaf).ok()?);
        }
        all.push(row);
    }
    Some(all)
}

impl Sketch {
    /// Builds the conditions and outputs of a problem.
    pub fn new(problem: &Problem) -> Result<Sketch, StudyError> {
        let mut graph = graph_with_system(graph_of(problem), problem)?;
        let definitions = &problem.definitions;
        let mut condition = |c: &Option<StudyCondition>, of: &str| {
            let Some(StudyCondition { is, place }) = c else {
                return Ok(None);
            };
            let id = build(&mut graph, definitions, is, of)?;
            match graph.is_condition(id) {
                true => Ok(Some(id)),
                false => {
                    let reason = format!("{of}: {is} is a number, not a condition");
                    Err(StudyError::new(reason).at(*place))
                }
            }
        };
        let whole = condition(&problem.condition, "where")?;
        let regions = problem.regions.iter();
        let regions = regions.map(|region| condition(&region.condition, &region.name));
        let regions = regions.collect::<Result<_, _>>()?;
        let mut outputs = Vec::new();
        for output in expressions(problem) {
            outputs.push(build(&mut graph, definitions, &output.is, &output.name)?);
        }
        Ok(Sketch {
            graph: Arc::new(graph),
            condition: whole,
            regions,
            outputs,
        })
    }

    /// An evaluator in binary64.
    pub fn evaluator(&self) -> Evaluator<Floating> {
        Evaluator::new(self.graph.clone(), Floating::default())
    }

    /// The graph.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }
}

impl FloatSolver {
    /// Builds a solver's formulas.
    pub fn new(problem: &Problem, solver: &StudySolver) -> Result<FloatSolver, StudyError> {
        let mut graph = graph_of(problem);
        let mut formulas = Vec::new();
        for formula in &solver.formulas {
            let of = format!("the solver {}", solver.name);
            let id = build(&mut graph, &solver.definitions, formula, &of)?;
            if graph.is_complex(id) {
                let reason = format!("{of} has a complex formula: take re(...) or im(...)");
                return Err(StudyError::new(reason));
            }
            formulas.push(id);
        }
        Ok(FloatSolver {
            graph: Arc::new(graph),
            formulas,
            meaning: Floating {
                format: solver.format,
                elementary: solver.elementary,
            },
            idle: Mutex::default(),
        })
    }

    /// The format of the numbers.
    pub fn format(&self) -> Format {
        self.meaning.format
    }

    /// The graph and the nodes of its formulas.
    pub fn graph(&self) -> (&Graph, &[Id]) {
        (&self.graph, &self.formulas)
    }

    /// An evaluator of the formulas.
    pub fn evaluator(&self) -> Evaluator<Floating> {
        Evaluator::new(self.graph.clone(), self.meaning)
    }

    /// The values at an input, or the reason why the formulas have none in floating point.
    pub fn values(&self, input: &[f64]) -> Result<Vec<f64>, &'static str> {
        let lock = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let idle = lock().pop();
        let mut evaluator = idle.unwrap_or_else(|| self.evaluator());
        evaluator.reset(false);
        for (k, x) in input.iter().enumerate() {
            evaluator.set_input(k, (*x).into());
        }
        let value = |id: &Id| match evaluator.value(*id) {
            Ok(x) => Ok(x.re()),
            Err(stop) => Err(intern(&stop.reason.to_string())),
        };
        let found = self.formulas.iter().map(value).collect();
        lock().push(evaluator);
        found
    }
}
