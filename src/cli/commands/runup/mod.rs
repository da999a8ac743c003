//! A machine given in a file, run up or down.

mod facts;
mod precision;
mod start;

use crate::cli::args::RunupArgs;
use crate::cli::commands::linkage::facts as linkage_facts;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use mechaudit::machine::class_iii::Reach;
use mechaudit::machine::run_up::{Coefficients, Machine, MachineError, Overrides, Steady};
use mechaudit::report::cell::Cell;
use mechaudit::report::columns::Columns;
use mechaudit::report::rows::Rows;
use mechaudit::report::svg::run_up as drawings;
use mechaudit::solvers::run_up::{
    Equation, Hybrid, Motion, Plan, ReducedModel, Sample, Splined, inertia_range, run,
};

/// The columns of a row with their units.
const COLUMNS: [&str; 13] = [
    "t_s",
    "phi1_deg",
    "omega_rad_per_s",
    "epsilon_rad_per_s2",
    "I_kg_m2",
    "M_motor_N_m",
    "M_o_N_m",
    "M_load_N_m",
    "kinetic_energy_J",
    "work_motor_J",
    "work_weights_J",
    "work_load_J",
    "energy_balance_J",
];

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
    let exact = &*machine.model;
    let (splined, hybrid);
    let first = machine.plan.phi;
    let in_file = |e| Failure::in_file(&args.file, e);
    let splines = |e| {
        Failure::caused(e)
            .about("splines")
            .about(args.file.display())
    };
    let model: &dyn ReducedModel = match machine.coefficients {
        Coefficients::Exact => exact,
        Coefficients::Splines => {
            splined = Splined::new(exact, first, machine.nodes).map_err(splines)?;
            &splined
        }
        Coefficients::Hybrid => {
            hybrid = Hybrid::new(exact, first, machine.nodes).map_err(splines)?;
            &hybrid
        }
    };
    let equation = Equation::new(model, &machine.drive);
    if args.work_precision {
        return precision::table(args, &machine, &equation, columns, output, drawing)
            .map_err(|f| f.about(args.file.display()));
    }
    let warning = inertia_range(exact, first)
        .ok()
        .and_then(|range| facts::light(&machine, &range));
    let motion = run(&equation, &machine.plan).map_err(in_file)?;
    let steady = Steady::of(&machine, &equation, &motion);
    if let Some(drawing) = drawing {
        let start = start::short_start(&motion.samples).map(|duration| {
            let plan = Plan {
                duration,
                sampling: Some(duration / 400.0),
                ..machine.plan.clone()
            };
            run(&equation, &plan).map_err(in_file)
        });
        let start = start.transpose()?.map(|m| m.samples);
        drawing.text(&drawings::draw(
            &machine.name,
            &motion.samples,
            start.as_deref(),
        )?)?;
    }
    output.write(|out| {
        let about = facts::json(&machine, &motion, &steady, warning.as_deref());
        let mut rows = Rows::begin(out, args.format, columns, &about)?;
        for sample in &motion.samples {
            rows.row(&row(sample))?;
        }
        Ok(rows.end()?)
    })?;
    for line in warning.into_iter().chain(lines(&machine, &motion, &steady)) {
        complain(&line);
    }
    Ok(Outcome::AsExpected)
}

fn lines(machine: &Machine, motion: &Motion, steady: &Steady) -> Vec<String> {
    let mut lines = vec![facts::ending(machine, motion)];
    lines.extend(facts::stiff(machine, motion));
    lines.push(facts::cost(machine, motion));
    lines.extend(facts::steady_lines(steady));
    lines
}

fn row(s: &Sample) -> Vec<Cell> {
    let values = [
        s.t,
        s.phi.to_degrees(),
        s.psi,
        s.acceleration,
        s.inertia,
        s.motor,
        s.weights,
        s.resistance,
        s.kinetic_energy,
        s.work[0],
        s.work[1],
        s.work[2],
        s.balance,
    ];
    values.map(Cell::Float).to_vec()
}
