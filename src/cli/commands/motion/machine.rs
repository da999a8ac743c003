//! The motion of a mechanism: certified, or in floating point.

use super::{Column, Table, shown};
use crate::cli::args::MotionArgs;
use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::source;
use mechaudit::machine::planar::{Certified, Moving, MovingError, Row};
use mechaudit::machine::{Linkage, Source};
use mechaudit::reference::nearest_f64;
use mechaudit::report::cell::Cell;
use mechaudit::solvers::planar::dynamics::Settings;
use rug::Rational;

/// A mechanism with what is asked of its motion.
pub struct Problem {
    moving: Moving,
    source: String,
    digits: Option<u32>,
    reactions: bool,
}

/// The source of a machine's file; `None` for other files.
pub fn source(args: &MotionArgs) -> Option<Source> {
    let source = source::open(&args.file).ok()?;
    Linkage::names_type(&source).then_some(source)
}

impl Problem {
    /// Reads the mechanism; refuses times before the start.
    pub fn open(args: &MotionArgs, source: &Source) -> Result<Problem, Failure> {
        let about = |text: String| Failure::new(text).about(args.file.display());
        if let Some((name, _)) = args.set.first() {
            let text = format!("--set {name}: a machine's file has its values itself");
            return Err(about(text));
        }
        let moving = Moving::read(source).map_err(|e| Failure::in_file(&args.file, e))?;
        if let Some(first) = args.times.0.first().filter(|t| **t < 0) {
            return Err(about(format!("the time {first} comes before the start 0")));
        }
        Ok(Problem {
            source: args.file.display().to_string(),
            digits: args.digits,
            reactions: args.reactions,
            moving,
        })
    }

    /// The rows at these times.
    pub fn table(&self, times: &[Rational]) -> Result<Table, Failure> {
        let about = |e: &dyn std::fmt::Display| Failure::new(e.to_string()).about(&self.source);
        let time = Column {
            name: "t",
            unit: "s",
            text: "the time".into(),
        };
        let quantities = self.moving.quantities(self.reactions);
        let quantities = quantities
            .map_err(|e| about(&e))?
            .into_iter()
            .map(|q| Column {
                name: q.name.clone().leak(),
                unit: q.unit,
                text: format!("{}: {}", q.name, q.text),
            });
        let title = self.moving.name.clone();
        let columns = std::iter::once(time).chain(quantities).collect();
        let mut table = Table::new(
            title.unwrap_or_else(|| "mechanism".into()),
            self.source.clone(),
            columns,
            self.digits,
        );
        match self.digits {
            Some(digits) => {
                let row = Row::Motion {
                    reactions: self.reactions,
                };
                let certified = Certified::new(&self.moving, digits, &row);
                if let Some(t) = certify(&mut table, certified.map_err(|e| about(&e))?, times) {
                    complain_of_end(&shown(&t));
                }
            }
            None => self.float(&mut table, times).map_err(|e| about(&e))?,
        }
        Ok(table)
    }

    /// Adds the rows in floating point.
    fn float(&self, table: &mut Table, times: &[Rational]) -> Result<(), MovingError> {
        let seconds: Vec<f64> = times.iter().map(nearest_f64).collect();
        let mut left = seconds.iter().zip(times);
        let settings = Settings {
            accelerations: self.reactions,
            ..Settings::default()
        };
        let ended = self.moving.run(&seconds, settings, |moment| {
            let values = self.moving.values(moment, self.reactions).into_iter();
            let values = values.map(|x| (Cell::Float(x), None));
            match left.next().filter(|(s, _)| **s == moment.time) {
                Some((_, time)) => table.push(time, values),
                // Where the motion ends.
                None => table.push(&Rational::from_f64(moment.time).unwrap_or_default(), values),
            }
        })?;
        if let Some(t) = ended {
            complain_of_end(&t);
        }
        Ok(())
    }
}

fn complain_of_end(time: &dyn std::fmt::Display) {
    complain(&format!(
        "motion.until changes its sign at t = {time} s, where the motion ends"
    ));
}

/// Adds the rows at some times up to the end of the motion; returns the time of the end if it comes
/// first.
pub fn certify(
    table: &mut Table,
    mut certified: Certified,
    times: &[Rational],
) -> Option<Rational> {
    for time in times {
        let found = certified.at(time);
        let why = found.reason;
        let value = |digits: Option<String>| (Cell::certified(digits), why.clone());
        let ended = found.ended;
        table.push(
            ended.as_ref().unwrap_or(time),
            found.digits.into_iter().map(value),
        );
        if ended.is_some() {
            return ended;
        }
    }
    None
}
