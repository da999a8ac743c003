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
        let start = start::short_start(&motion.samples);
        let start = start
            .map(|duration| run(&equation, &enlarged(&machine.plan, duration)).map_err(in_file));
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

/// The first part of a run, so often that its drawing is smooth.
fn enlarged(plan: &Plan, duration: f64) -> Plan {
    Plan {
        duration,
        sampling: Some(duration / 400.0),
        ..plan.clone()
    }
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
    fn a_row_has_the_values_that_its_columns_name() {
        let sample = Sample {
            t: 1.0,
            phi: std::f64::consts::PI,
            psi: 3.0,
            acceleration: 4.0,
            inertia: 5.0,
            motor: 6.0,
            weights: 7.0,
            resistance: 8.0,
            kinetic_energy: 9.0,
            work: [10.0, 11.0, 12.0],
            balance: 13.0,
        };
        let due = [
            ("t_s", 1.0),
            ("phi1_deg", 180.0),
            ("omega_rad_per_s", 3.0),
            ("epsilon_rad_per_s2", 4.0),
            ("I_kg_m2", 5.0),
            ("M_motor_N_m", 6.0),
            ("M_o_N_m", 7.0),
            ("M_load_N_m", 8.0),
            ("kinetic_energy_J", 9.0),
            ("work_motor_J", 10.0),
            ("work_weights_J", 11.0),
            ("work_load_J", 12.0),
            ("energy_balance_J", 13.0),
        ];
        let found: Vec<_> = COLUMNS.into_iter().zip(row(&sample)).collect();
        assert_eq!(found, due.map(|(name, x)| (name, Cell::Float(x))));
    }

    #[test]
    fn the_start_is_enlarged_by_400_samples() {
        let plan = example(["", ""]).plan;
        let found = enlarged(&plan, 0.5);
        assert_eq!((found.duration, found.sampling), (0.5, Some(0.00125)));
        assert_eq!((found.phi, found.psi), (plan.phi, plan.psi));
        assert_eq!(found.settings.tolerance, plan.settings.tolerance);
    }

    /// How it ends, stiffness, cost, cycle and flywheel, in this order.
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
