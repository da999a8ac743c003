//! A solver's own formula beside the definition of its output.

use crate::audit::{Cases, Method, Settings};
use crate::study::{Problem, Study, StudyError, StudyInput, StudyOutput, StudySolver};
use mechaudit_proof::program::Setting;
use mechaudit_symbolic::evaluation::{Answer, Goal};
use mechaudit_symbolic::graph::Graph;
use mechaudit_symbolic::{Equation, Expr, Identity, Outcome as Decision, Symbol};
use rug::Rational;

/// The verdict on solver and definition as functions over the reals.
#[derive(Clone, Debug, PartialEq)]
pub enum Same {
    /// They are, and how it is known.
    Proved(&'static str),
    /// They differ at an input.
    Refuted(Vec<f64>),
    /// Neither is known, and why.
    Undecided(String),
}

impl Same {
    /// The verdict on two outputs.
    pub fn with(self, other: Same) -> Same {
        match (&self, &other) {
            (Same::Refuted(_), _) | (Same::Undecided(_), Same::Undecided(_) | Same::Proved(_)) => {
                self
            }
            _ => other,
        }
    }
}

/// The study whose definition is the solver's own formula: its references are what rounding alone
/// is off from. Its inputs are those of the proof.
pub fn own_study(
    problem: &Problem,
    solver: &StudySolver,
    setting: Setting,
    outputs: &[usize],
    within: Option<f64>,
) -> Result<Problem, StudyError> {
    let mut own = problem.clone();
    if let Some(most) = within.and_then(Rational::from_f64) {
        for input in &mut own.inputs {
            let to = input.to.take().unwrap_or(most.clone());
            input.to = Some(to.min(most.clone()));
            input.from = input.from.take().max(Some(Rational::from(-&most)));
        }
    }
    own.outputs = outputs
        .iter()
        .map(|k| StudyOutput {
            is: solver.formulas[*k].clone(),
            text: solver.formulas[*k].to_string(),
            proved: None,
            ..problem.outputs[*k].clone()
        })
        .collect();
    // Conditions keep their own names.
    let regions = problem.regions.iter().filter_map(|r| r.condition.as_ref());
    let conditions = problem.condition.iter().chain(regions);
    let conditions: Vec<&Expr> = conditions.map(|c| &c.is).collect();
    let definitions = &problem.definitions;
    let clash = |name: &&String| conditions.iter().any(|e| definitions.reaches(e, &[name]));
    if let Some(name) = problem.redefined(solver).find(clash) {
        return Err(StudyError::new(format!(
            "the solver and the conditions of the study define {name} differently"
        )));
    }
    for (name, e) in &solver.definitions.names {
        own.definitions.set(name, e.clone());
    }
    let mut alone = solver.clone();
    alone.formulas = outputs
        .iter()
        .map(|k| solver.formulas[*k].clone())
        .collect();
    alone.elementary = setting.elementary;
    own.solvers = vec![alone];
    Ok(own)
}

/// Inputs beside those of the hunts at which solver and definition are compared, and those of each
/// region among them.
const DRAWN: usize = 128;
const OF_REGION: u64 = 24;

/// The study's check points and some draws.
fn drawn(study: &Study) -> Vec<Vec<f64>> {
    let settings = Settings {
        cases_per_region: OF_REGION,
        ..Settings::default()
    };
    let cases = Cases::new(study, &settings);
    let some = 0..cases.len().min(DRAWN);
    some.map(|i| cases.get(i).input).collect()
}

/// Decides whether the solver's formula is the definition over the reals.
pub fn same(
    problem: &Problem,
    solver: &StudySolver,
    (k, part): (usize, usize),
    own: &Problem,
    study: &Study,
    inputs: &[Vec<f64>],
) -> Same {
    let is = &problem.outputs[k].is;
    let mut graph = Graph::new(problem.inputs.iter().map(|i| i.name.clone()));
    let both = [
        graph.build(&problem.definitions, is),
        graph.build(&solver.definitions, &solver.formulas[k]),
    ];
    let differs = || {
        let mut names = problem.redefined(solver);
        names.find(|n| problem.definitions.reaches(is, &[n]))
    };
    // Loops have nodes of their own each time that they are built.
    let is_written_alike = *is == solver.formulas[k] && differs().is_none();
    if matches!(&both, [Ok(a), Ok(b)] if a == b) || is_written_alike {
        return Same::Proved("the same formula");
    }
    if let Ok(of_solver) = Study::new(own.clone()) {
        let drawn = drawn(study);
        let tried = inputs.iter().chain(&drawn);
        for input in tried.filter(|x| study.admits(x)) {
            let exact: Option<Vec<Rational>> =
                input.iter().map(|x| Rational::from_f64(*x)).collect();
            let Some(exact) = exact else { continue };
            let ours = of_solver
                .answers(&exact, Goal::Double(72))
                .into_iter()
                .nth(part);
            let due = study.answers(&exact, Goal::Double(72)).into_iter().nth(k);
            let differ = match (ours, due) {
                (Some(Answer::Number(a)), Some(Answer::Number(b))) => !a.overlaps(&b),
                (Some(Answer::Zero), Some(Answer::Number(b))) => !b.contains_zero(),
                (Some(Answer::Number(a)), Some(Answer::Zero)) => !a.contains_zero(),
                (Some(Answer::Undefined { .. }), Some(Answer::Number(_) | Answer::Zero))
                | (Some(Answer::Number(_) | Answer::Zero), Some(Answer::Undefined { .. })) => true,
                _ => false,
            };
            if differ {
                return Same::Refuted(input.clone());
            }
        }
    }
    // The algebra reads both sides with one set of definitions.
    if let Some(name) = differs() {
        return Same::Undecided(format!("the solver defines {name} differently"));
    }
    // The algebra takes names without a definition for positive numbers, and some for its own.
    let taken = problem.inputs.iter().find(|i| !Symbol::is_free(&i.name));
    if let Some(StudyInput { name, .. }) = taken {
        return Same::Undecided(format!("{name} has a meaning of its own in the algebra"));
    }
    let positive = |i: &StudyInput| i.from.as_ref().is_some_and(|q| *q > 0);
    let equation = Equation {
        left: is.clone(),
        right: solver.formulas[k].clone(),
    };
    let everywhere = match both {
        [Ok(a), Ok(b)] => graph.continues([a, b], |k| positive(&problem.inputs[k])),
        _ => problem.inputs.iter().all(positive),
    };
    let decided = Identity::of(&own.definitions, &equation);
    match decided.outcome {
        Decision::Proved if everywhere => Same::Proved("by the algebra where both have a value"),
        Decision::Proved => {
            Same::Undecided("proved by the algebra for positive inputs alone".into())
        }
        _ => Same::Undecided(
            "the algebra does not decide it, and no point tried tells them apart".into(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(input: &str, is: &str, solver: &str) -> Same {
        let text = format!("[inputs]\n{input}\n[outputs]\ny = \"{is}\"\n[solver.s]\n{solver}");
        let study = Study::parse(&text, "pair").unwrap();
        let problem = study.problem();
        let solver = &problem.solvers[0];
        let own = own_study(problem, solver, solver.setting(), &[0], None).ok();
        same(problem, solver, (0, 0), &own.unwrap(), &study, &[])
    }

    const X: &str = "x = { from = -1, to = 3 }";
    const PI: &str = "pi = { from = 1, to = 2 }";

    /// Each pair is equal but for some inputs, at which one of them may have no value.
    #[test]
    fn functions_that_differ_somewhere_are_not_the_same() {
        for (is, solver) in [
            ("(x^2 - 9)/(x - 3)", "x + 3"),
            ("x + 3", "(x^2 - 9)/(x - 3)"),
            ("sqrt(x)^2", "x"),
            ("1/(1/x)", "x"),
            ("log(x) - log(x)", "0*x"),
            ("if(x == 3, 5, x)", "x"),
            ("sqrt(x^2)", "x"),
        ] {
            let found = of(X, is, &format!("y = \"{solver}\""));
            assert!(matches!(found, Same::Refuted(_)), "{is}: {found:?}");
        }
    }

    /// The same text is another formula where the solver gives a name another value.
    #[test]
    fn names_are_the_solver_s_own() {
        let own = "y = \"pi*x\"\n[solver.s.let]\npi = \"3\"";
        assert!(matches!(of(X, "pi*x", own), Same::Refuted(_)));
        // Equal all the same, which the algebra does not see with one set of definitions.
        let input = format!("{X}\n[let]\nz = \"5\"");
        let own = "y = \"x + z - z\"\n[solver.s.let]\nz = \"7\"";
        let why = "the solver defines z differently";
        assert_eq!(of(&input, "x + z - z", own), Same::Undecided(why.into()));
    }

    /// An input that has the name of a constant of the algebra is not that constant.
    #[test]
    fn inputs_are_no_constants_of_the_algebra() {
        let found = of(PI, "cos(pi)^2 + sin(pi)^2", "y = \"1 + 0*pi\"");
        let why = "pi has a meaning of its own in the algebra";
        assert_eq!(found, Same::Undecided(why.into()));
        let found = of(X, "x^2 - 1", "y = \"(x - 1)*(x + 1)\"");
        let how = "by the algebra where both have a value";
        assert_eq!(found, Same::Proved(how));
        // The algebra takes x for a positive number.
        let found = of(X, "sqrt(x^2)", "y = \"abs(x)\"");
        let why = "proved by the algebra for positive inputs alone";
        assert_eq!(found, Same::Undecided(why.into()));
    }
}
