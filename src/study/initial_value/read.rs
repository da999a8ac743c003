//! `[ode]` of a study in TOML.

use super::{InitialValue, times};
use crate::audit::Limit;
use crate::study::document::{Item, Value};
use crate::study::error::StudyError;
use crate::study::problem::{Problem, Spacing, StudyInput, StudyOutput};
use crate::study::read::{Names, entries, is_name, rational, unit_and_budget};
use mechaudit_symbolic::Expr;
use mechaudit_symbolic::evaluation::State;
use rug::Rational;

/// The most states of a problem.
const MOST: usize = 200;

/// The most times of a trajectory that is one answer.
const MOST_TIMES: usize = 10_000;

/// The length of the range of times of a study that states no end.
const LENGTH: u32 = 10;

/// The states that a file declares; none where it has no `[ode]`.
pub fn states(file: &Item) -> Result<&[(String, Item)], StudyError> {
    let Some(ode) = file.get("ode") else {
        return Ok(&[]);
    };
    ode.only(&["time", "unit", "start", "until", "times", "states"])?;
    if let Some(other) = file.get("system") {
        return Err(other.fault("a study has either [ode] or [system]"));
    }
    let found = entries(ode, "states")?;
    match found.len() {
        0 => {
            Err(ode.fault("[ode] has states: x = { start = \"1\", rate = \"-x\" } in [ode.states]"))
        }
        n if n > MOST => Err(ode.fault(format!("{n} states where at most {MOST} are integrated"))),
        _ => Ok(found),
    }
}

/// The time as an input: its range begins at the start.
pub fn time(problem: &Problem, ode: &Item) -> Result<StudyInput, StudyError> {
    let (name, place) = match ode.get("time") {
        Some(item) => (item.text()?, item),
        None => ("t", ode),
    };
    is_name(name, place)?;
    is_no_constant(name, place)?;
    if problem.inputs.iter().any(|i| i.name == name) {
        return Err(place.fault(format!(
            "the time {name} is an input already: its range goes from `start` to `until` in [ode]"
        )));
    }
    let start = ode
        .get("start")
        .map(rational)
        .transpose()?
        .unwrap_or_default();
    let until = match ode.get("until") {
        None => Rational::from(&start + LENGTH),
        Some(item) => {
            let until = rational(item)?;
            if until <= start {
                return Err(item.fault(format!(
                    "the end {until} does not come after the start {start}"
                )));
            }
            until
        }
    };
    let unit = ode.get("unit").map(Item::text).transpose()?.unwrap_or("1");
    Ok(StudyInput {
        name: name.into(),
        unit: unit.into(),
        from: Some(start),
        to: Some(until),
        spacing: Spacing::Linear,
    })
}

/// Reads the states, which become outputs. The time is the last input.
pub fn read(names: &Names, ode: &Item, problem: &mut Problem) -> Result<(), StudyError> {
    let (time, start) = match problem.inputs.last() {
        Some(StudyInput {
            name,
            from: Some(start),
            ..
        }) => (name.clone(), start.clone()),
        _ => return Err(ode.fault("[ode] has no time")),
    };
    let listed = entries(ode, "states")?;
    let mut states = Vec::new();
    for (name, item) in listed {
        is_no_constant(name, item)?;
        let (state, output) = state(names, name, item, &time)?;
        let open: Vec<&str> = listed
            .iter()
            .map(|s| s.0.as_str())
            .chain([time.as_str()])
            .collect();
        if let Some(on) = open
            .iter()
            .find(|on| problem.definitions.reaches(&state.start, &[on]))
        {
            return Err(item.fault(format!("the start of {name} depends on {on}")));
        }
        states.push(state);
        problem.outputs.push(output);
    }
    let times = listed_times(ode, &start)?;
    problem.initial_value = Some(InitialValue {
        start,
        states,
        times,
    });
    Ok(())
}

/// The times of a whole trajectory; none where the file lists none.
fn listed_times(ode: &Item, start: &Rational) -> Result<Vec<Rational>, StudyError> {
    let Some(item) = ode.get("times") else {
        return Ok(Vec::new());
    };
    let all = times(item.text()?).map_err(|e| item.fault(e.to_string()))?;
    if all.len() > MOST_TIMES {
        let text = format!(
            "{} times where an answer has at most {MOST_TIMES} rows",
            all.len()
        );
        return Err(item.fault(text));
    }
    match all.first() {
        Some(first) if first < start => {
            Err(item.fault(format!("the time {first} comes before the start {start}")))
        }
        _ => Ok(all),
    }
}

/// A state: where it starts, its rate, its unit and budget.
fn state(
    names: &Names,
    name: &str,
    item: &Item,
    time: &str,
) -> Result<(State, StudyOutput), StudyError> {
    let needs = |key: &str, such: &str| {
        item.fault(format!("the state {name} has no {key}: {key} = {such}"))
    };
    if !matches!(item.value, Value::Table(_)) {
        return Err(needs("start and no rate", "..."));
    }
    item.only(&["start", "rate", "unit", "budget", "why"])?;
    let Some(start) = item.get("start") else {
        return Err(needs("start", "\"0\""));
    };
    let Some(rate) = item.get("rate") else {
        return Err(needs("rate", &format!("\"...\", its derivative by {time}")));
    };
    let mut output = StudyOutput {
        name: name.into(),
        unit: "1".into(),
        is: Expr::Sym(name.into()),
        text: format!(
            "{name}' = {}, {name} = {} at the start",
            rate.text()?,
            start.text()?
        ),
        budget: default_budget(),
        proved: None,
    };
    unit_and_budget(&mut output, item)?;
    let state = State {
        name: name.into(),
        start: names.expression(start)?,
        rate: names.expression(rate)?,
    };
    Ok((state, output))
}

/// The budget of a state that states none.
fn default_budget() -> (Limit, String) {
    let reason =
        "none is stated: a relative tolerance of 1e-9, with what disturbances of the data grow to";
    (
        Limit::Conditioned(1e-9 * 9_007_199_254_740_992.0),
        reason.into(),
    )
}

/// Refuses the name of a constant that is never hidden.
fn is_no_constant(name: &str, item: &Item) -> Result<(), StudyError> {
    match matches!(name, "i" | "pi" | "inf") {
        true => Err(item.fault(format!("{name} is a constant, no state and no time"))),
        false => Ok(()),
    }
}
