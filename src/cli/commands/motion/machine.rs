//! The motion of a mechanism: certified, or in floating point.

use super::{Column, Entry, Table, TableRow, shown};
use crate::cli::args::MotionArgs;
use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::source;
use mechaudit::machine::planar::{Certified, Moving, MovingError, Row};
use mechaudit::machine::{Linkage, Source};
use mechaudit::reference::nearest_f64;
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
        let rows = match self.digits {
            Some(digits) => {
                let row = Row::Motion {
                    reactions: self.reactions,
                };
                let certified = Certified::new(&self.moving, digits, &row);
                let (rows, ended) = certified_rows(certified.map_err(|e| about(&e))?, times);
                if let Some(t) = ended {
                    complain_of_end(&shown(&t));
                }
                rows
            }
            None => self.floating(times).map_err(|e| about(&e))?,
        };
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
        Ok(Table {
            title: self
                .moving
                .name
                .clone()
                .unwrap_or_else(|| "mechanism".into()),
            source: self.source.clone(),
            columns: std::iter::once(time).chain(quantities).collect(),
            inputs: Vec::new(),
            digits: self.digits,
            rows,
        })
    }

    fn floating(&self, times: &[Rational]) -> Result<Vec<TableRow>, MovingError> {
        let seconds: Vec<f64> = times.iter().map(nearest_f64).collect();
        let mut rows = Vec::new();
        let ended = self.moving.run(&seconds, Settings::default(), |moment| {
            let time = times
                .get(rows.len())
                .filter(|t| nearest_f64(t) == moment.time);
            let time = time.cloned().or_else(|| Rational::from_f64(moment.time));
            let values = self.moving.values(moment, self.reactions);
            let values = values.into_iter().map(Entry::Float);
            rows.push((time.unwrap_or_default(), values.collect()));
        })?;
        if let Some(t) = ended {
            complain_of_end(&t);
        }
        Ok(rows)
    }
}

fn complain_of_end(time: &dyn std::fmt::Display) {
    complain(&format!(
        "motion.until changes its sign at t = {time} s, where the motion ends"
    ));
}

/// The rows at some times up to the end of the motion, and the time of the end if it comes first.
pub fn certified_rows(
    mut certified: Certified,
    times: &[Rational],
) -> (Vec<TableRow>, Option<Rational>) {
    let mut rows = Vec::new();
    for time in times {
        let found = certified.at(time);
        let why = found.reason;
        let value = |decimal: Option<String>| Entry::Certified {
            why: why.clone().filter(|_| decimal.is_none()),
            decimal,
        };
        let values = found.digits.into_iter().map(value).collect();
        let ended = found.ended;
        rows.push((ended.clone().unwrap_or_else(|| time.clone()), values));
        if ended.is_some() {
            return (rows, ended);
        }
    }
    (rows, None)
}
