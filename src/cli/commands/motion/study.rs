//! The motion of a study.

use super::{Column, Table};
use crate::cli::args::MotionArgs;
use crate::cli::failure::Failure;
use mechaudit::audit::{Input, Method, Output, did_you_mean};
use mechaudit::methods::Evaluable;
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::study::Study;
use rug::Rational;

/// Digits where none are asked for.
const DIGITS: u32 = 15;

/// A study with the values of its inputs.
pub struct Problem {
    study: Study,
    /// All inputs but the time.
    inputs: Vec<(&'static str, Rational)>,
    digits: u32,
}

impl Problem {
    /// Opens the study that the arguments name; refuses times before its start.
    pub fn open(args: &MotionArgs) -> Result<Problem, Failure> {
        let path = args.file.to_string_lossy();
        let about = |f: Failure| f.about(args.file.display());
        let study = Study::open(&path).map_err(Failure::caused)?;
        if args.reactions {
            let text = "--reactions are those of a mechanism's joints, of which a study has none";
            return Err(about(Failure::new(text)));
        }
        let study = study.with_time_as_input().map_err(Failure::caused)?;
        if study.problem().initial_value.is_none() {
            return Err(about(Failure::new(
                "the study states no initial value problem: [ode]",
            )));
        }
        let mut names: Vec<&'static str> = study.inputs().iter().map(|i| i.name).collect();
        let time = names.pop().unwrap_or("t");
        let mut inputs = Vec::new();
        for name in &names {
            let mut set = args.set.iter().filter(|s| s.0 == *name);
            match (set.next(), set.next()) {
                (Some((_, value)), None) => inputs.push((*name, value.clone())),
                (None, _) => {
                    let text = format!("the input {name} has no value: --set {name}=NUMBER");
                    return Err(about(Failure::new(text)));
                }
                _ => return Err(Failure::new(format!("--set gives {name} two values"))),
            }
        }
        if let Some((other, _)) = args.set.iter().find(|s| !names.contains(&s.0.as_str())) {
            let text = match other == time {
                true => format!("--set {other}: the time is set by --times"),
                false => format!(
                    "--set {other}: there is no such input{}",
                    did_you_mean(other, &names)
                ),
            };
            return Err(about(Failure::new(text)));
        }
        let problem = Problem {
            study,
            inputs,
            digits: args.digits.unwrap_or(DIGITS),
        };
        // Times increase: the first one decides.
        if let Some(first) = args.times.0.first() {
            let numbers: Vec<f64> = problem.at(first).iter().map(nearest_f64).collect();
            if let Some(why) = problem.study.refusal(&numbers) {
                return Err(about(Failure::new(why)));
            }
        }
        Ok(problem)
    }

    /// The inputs of the study at a time.
    fn at(&self, time: &Rational) -> Vec<Rational> {
        let inputs = self.inputs.iter().map(|i| i.1.clone());
        inputs.chain([time.clone()]).collect()
    }

    /// The values at these times.
    pub fn table(&self, times: &[Rational]) -> Table {
        let problem = self.study.problem();
        let inputs = self.study.inputs();
        let time = inputs.last().map(|i: &Input| Column {
            name: i.name,
            unit: i.unit,
            text: "the time".into(),
        });
        let outputs = self.study.outputs();
        let quantity = |(o, p): (&Output, &mechaudit::study::StudyOutput)| Column {
            name: o.name,
            unit: o.unit,
            text: p.text.clone(),
        };
        let quantities = outputs.iter().zip(&problem.outputs).map(quantity);
        let mut table = Table::new(
            problem.title.clone(),
            problem.source.clone(),
            time.into_iter().chain(quantities).collect(),
            Some(self.digits),
        );
        table.inputs = self.inputs.clone();
        for time in times {
            let values = self.study.digits(&self.at(time), self.digits).into_iter();
            table.push(time, values.map(|v| (Cell::certified(v.decimal), v.why)));
        }
        table
    }
}
