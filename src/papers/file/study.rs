//! Studies and machines of the folder, whose certified values stand behind numbers of the paper.

use super::entry::fault;
use super::read::Reading;
use crate::audit::Limit;
use crate::machine::planar::Moving;
use crate::machine::{Linkage, Source};
use crate::papers::ledger::Names;
use crate::study::document::Item as Node;
use crate::study::{Problem, Study, StudyError, StudyOutput};
use crate::symbolic::Expr;

/// Opens the study that a key names, or the motion of a machine.
///
/// # Errors
/// A file that is not there, and its faults.
pub(super) fn open(reading: &Reading, file: &Node) -> Result<Study, StudyError> {
    let name = file.text()?;
    let stem = name.rsplit('/').next().unwrap_or(name);
    let stem = stem.split('.').next().unwrap_or(stem);
    let text = reading.source.read(name).map_err(|e| e.at(file.place))?;
    let machine = Source::toml(text.as_str());
    let study = match Linkage::names_type(&machine) {
        true => Moving::read_study(&machine, stem),
        false => Study::parse(&text, stem),
    };
    study.map_err(|e| file.fault(format!("{name}: {e}")))
}

/// Returns the study whose outputs are the given expressions of the names that a study declares.
///
/// # Errors
/// A study of linear algebra, and an expression without meaning, at its place.
pub(super) fn with_outputs(
    study: &Study,
    file: &Node,
    outputs: &[(&str, &Node)],
) -> Result<Study, StudyError> {
    let problem = study.problem();
    if problem.linear.is_some() {
        return Err(file.fault("a study of linear algebra has no columns"));
    }
    let unknowns = problem.system.iter().flat_map(|s| &s.unknowns);
    let states = problem.initial_value.iter().flat_map(|s| &s.states);
    let own = problem.inputs.iter().map(|i| &i.name);
    let own = own.chain(unknowns.map(|u| &u.0));
    let own = own.chain(states.map(|s| &s.name));
    let names = Names::declared(own.chain(problem.definitions.names.keys()).cloned());
    let mut all = Vec::new();
    for (name, node) in outputs {
        let text = node.text()?;
        let is = names.expression(text).map_err(|e| fault(e, node, &names))?;
        all.push(output(name, text, is));
    }
    let problem = Problem {
        outputs: all,
        solvers: Vec::new(),
        ..problem.clone()
    };
    Study::new(problem).map_err(|e| e.at(file.place))
}

/// An output whose value alone is asked for.
pub(super) fn output(name: &str, text: &str, is: Expr) -> StudyOutput {
    StudyOutput {
        name: name.into(),
        unit: "1".into(),
        is,
        text: text.into(),
        proved: None,
        budget: (Limit::Ulps(1.0), "the value alone is asked for".into()),
    }
}

#[cfg(test)]
mod tests;
