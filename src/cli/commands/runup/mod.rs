//! A machine given in a file, run up or down.

mod certified;
mod facts;
mod precision;
mod start;

use crate::cli::args::RunupArgs;
use crate::cli::commands::linkage::facts as linkage_facts;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use crate::cli::progress::waiting;
use mechaudit::machine::class_iii::Reach;
use mechaudit::machine::run_up::{
    COLUMNS, Coefficients, Machine, MachineError, Overrides, Steady, row,
};
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns;
use mechaudit::report::html::run::{Figure, Section, page};
use mechaudit::report::rows::{Form, Rows};
use mechaudit::report::svg::run_up as drawings;
use mechaudit::solvers::run_up::{Equation, Motion, Plan, Sample, inertia_range, run};
use std::io::Write;

/// The machine that the arguments name.
pub fn machine(args: &RunupArgs) -> Result<Machine, Failure> {
    let overrides = Overrides {
        coefficients: args.coefficients,
        nodes: args.nodes,
        tolerance: args.tolerance,
        method: args.method,
    };
    let machine = Machine::read(&source::open(&args.file)?, overrides);
    let machine = machine.map_err(|e: MachineError| Failure::in_file(&args.file, e))?;
    if args.nodes.is_some() && machine.coefficients == Coefficients::Exact {
        return Err(Failure::new(
            "--nodes has no meaning with exact coefficients: choose coefficients splines or hybrid",
        ));
    }
    Ok(machine)
}

/// Runs the machine as the arguments ask for.
pub fn runup(args: &RunupArgs) -> Result<Outcome, Failure> {
    if let Some(digits) = args.digits {
        return certified::certified(args, digits);
    }
    let machine = machine(args)?;
    if let Some(branch) = &machine.branch
        && let Reach::Part { .. } = branch.reach
    {
        complain(&linkage_facts::range_line(branch));
    }
    let columns = match args.work_precision {
        true => precision::COLUMNS.map(String::from).to_vec(),
        false => COLUMNS.map(String::from).to_vec(),
    };
    let columns = Columns::of(columns, &args.units.units, false)?;
    let output = Output::open(args.output.as_deref())?;
    let drawing = match args.work_precision {
        true => "work-precision.svg",
        false => "run-up.svg",
    };
    let drawing = args.svg.as_ref().map(|f| Output::within(f, drawing));
    let drawing = drawing.transpose()?;
    let in_file = |e| Failure::in_file(&args.file, e);
    let model = machine.reduced().map_err(|e| {
        Failure::caused(e)
            .about("splines")
            .about(args.file.display())
    })?;
    let equation = Equation::new(&*model, &machine.drive);
    if args.work_precision {
        return precision::table(args, &machine, &equation, columns, output, drawing)
            .map_err(|f| f.about(args.file.display()));
    }
    let warning = inertia_range(&*machine.model, machine.plan.phi)
        .ok()
        .and_then(|range| facts::light(&machine, &range));
    let motion = waiting("run-up", || run(&equation, &machine.plan)).map_err(in_file)?;
    let steady = waiting("steady cycle", || Steady::of(&machine, &equation, &motion));
    let form = args.format.rows();
    let start = start::short_start(&motion.samples).filter(|_| drawing.is_some() || form.is_none());
    let start =
        start.map(|duration| run(&equation, &enlarged(&machine.plan, duration)).map_err(in_file));
    let start = start.transpose()?.map(|m| m.samples);
    if let Some(drawing) = drawing {
        drawing.text(drawings::draw(
            &machine.name,
            &motion.samples,
            start.as_deref(),
        ))?;
    }
    let about = facts::json(&machine, &motion, &steady, warning.as_deref());
    let lines: Vec<String> = warning
        .into_iter()
        .chain(lines(&machine, &motion, &steady))
        .collect();
    output.write(|out| {
        let write = |out: &mut dyn Write, form| -> Result<(), Failure> {
            let mut rows = Rows::begin(out, form, columns, &about)?;
            for sample in &motion.samples {
                rows.row(&row(sample).map(Cell::Float))?;
            }
            Ok(rows.end()?)
        };
        if let Some(form) = form {
            return write(out, form);
        }
        let mut table = Vec::new();
        write(&mut table, Form::Table)?;
        let panels = |samples: &[Sample]| drawings::panels(samples, &motion.samples);
        let section = |key, title: &str, samples: &[Sample], table| Section {
            key,
            title: title.into(),
            figures: panels(samples).into_iter().map(Figure::Panel).collect(),
            table,
        };
        let mut sections = vec![section("runup", "The run", &motion.samples, table)];
        if let Some(start) = &start {
            sections.push(section("start", "Its start, enlarged", start, Vec::new()));
        }
        Ok(out.write_all(page(&machine.name, "run-up", &lines, &sections).as_bytes())?)
    })?;
    lines.iter().for_each(|l| complain(l));
    Ok(Outcome::AsExpected)
}

/// The first part of a run, so often that its drawing is smooth.
fn enlarged(plan: &Plan, duration: f64) -> Plan {
    Plan {
        duration,
        sampling: Some(duration / 400.0),
        ..plan.clone()
    }
}

fn lines(machine: &Machine, motion: &Motion, steady: &Steady) -> Vec<String> {
    let mut lines: Vec<String> = facts::swings(machine, motion).into_iter().collect();
    lines.push(facts::ending(machine, motion));
    lines.extend(facts::stiff(machine, motion));
    lines.push(facts::cost(machine, motion));
    lines.extend(facts::steady_lines(steady));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::machine::Source;

    fn example(changed: [&str; 2]) -> Machine {
        let text = include_str!("../../../../examples/four-bar-run-up.toml");
        let text = text.replacen(changed[0], changed[1], 1);
        Machine::read(&Source::toml(text), Overrides::default()).unwrap()
    }

    #[test]
    fn the_start_is_enlarged_by_400_samples() {
        let plan = example(["", ""]).plan;
        let found = enlarged(&plan, 0.5);
        assert_eq!((found.duration, found.sampling), (0.5, Some(0.00125)));
        assert_eq!((found.phi, found.psi), (plan.phi, plan.psi));
        assert_eq!(found.settings.tolerance, plan.settings.tolerance);
    }

    /// The end, stiffness, cost, cycle and flywheel, in this order.
    #[test]
    fn lines_come_in_their_order() {
        let machine = example(["\"2 s\"", "\"0.01 s\"\nfluctuation = 1.5"]);
        let equation = Equation::new(&*machine.model, &machine.drive);
        let mut motion = run(&equation, &machine.plan).unwrap();
        motion.stiff_from = Some(0.001);
        let steady = Steady::of(&machine, &equation, &motion);
        let lines = lines(&machine, &motion, &steady);
        let begins = [
            "the time is over after 0.010000 s",
            "stiff from 1.000e-3 s on",
            "verner98, then radau5, at tolerance",
            "steady cycle: ",
            "flywheel: none is needed",
        ];
        assert_eq!(lines.len(), begins.len(), "{lines:?}");
        for (line, begin) in lines.iter().zip(begins) {
            assert!(line.starts_with(begin), "{line}");
        }
    }
}
