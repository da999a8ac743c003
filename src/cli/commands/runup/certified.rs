//! A run with certified digits.

use crate::cli::args::RunupArgs;
use crate::cli::commands::motion::machine::certify;
use crate::cli::commands::motion::{Column, Table, shown};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::files::source;
use crate::cli::progress::waiting;
use mechaudit::machine::run_up::CertifiedRun;

/// The columns: name, unit and definition.
const COLUMNS: [(&str, &str, &str); 4] = [
    ("t", "s", "the time"),
    ("phi1", "deg", "angle of the drive"),
    ("omega", "rad/s", "angular velocity of the drive"),
    ("epsilon", "rad/s^2", "angular acceleration of the drive"),
];

/// Computes the run and writes it.
pub fn certified(args: &RunupArgs, digits: u32) -> Result<Outcome, Failure> {
    let source = source::open(&args.file)?;
    let run = CertifiedRun::read(&source, digits).map_err(|e| Failure::in_file(&args.file, e))?;
    let output = Output::open(args.output.as_deref())?;
    let CertifiedRun {
        name,
        motion,
        times,
    } = run;
    let column = |(name, unit, text): (&'static str, &'static str, &str)| Column {
        name,
        unit,
        text: text.into(),
    };
    let mut table = Table::new(
        name.unwrap_or_else(|| "run-up".into()),
        args.file.display().to_string(),
        COLUMNS.map(column).into(),
        Some(digits),
    );
    if let Some(t) = waiting("run", || certify(&mut table, motion, &times)) {
        complain(&format!(
            "run.target_speed is reached at t = {} s",
            shown(&t)
        ));
    }
    table.write(output, args.format.rows())
}
