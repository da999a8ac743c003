//! The crank angles of the rows, exact.

use super::args::LinkageArgs;
use super::branch::{Branch, Reach};
use super::failure::Failure;
use super::fields::in_degrees;
use super::linkage_file::Linkage;
use super::quantity::nearest;
use rug::Rational;

/// Rows at most.
const MOST_ROWS: u64 = 10_000_000;
/// Crank angles at most when every branch is kept in memory.
const MOST_ANGLES: u64 = 100_000;

/// Crank angles in degrees, `from + k step`.
pub struct Grid {
    pub from: Rational,
    step: Rational,
    pub count: u64,
    /// Whether the window was asked for, or is one turn from the start.
    asked: bool,
}

impl Grid {
    /// The grid asked for; it begins at `start` if the arguments do not say where.
    pub fn new(args: &LinkageArgs, start: Option<Rational>) -> Result<Grid, Failure> {
        let step = args.step_deg.value.clone();
        if step <= 0 {
            let text = nearest(&step);
            return Err(Failure::new(format!(
                "--step-deg must be positive, got {text}"
            )));
        }
        let from = match (&args.from_deg, start) {
            (Some(from), _) => from.value.clone(),
            (None, Some(start)) => start,
            (None, None) => Rational::new(),
        };
        let steps = match &args.to_deg {
            Some(to) if to.value < from => {
                return Err(Failure::new(format!(
                    "--to-deg {} must not be less than the first crank angle, {} deg",
                    nearest(&to.value),
                    nearest(&from)
                )));
            }
            Some(to) => (Rational::from(&to.value - &from) / &step).floor() + 1u32,
            None => (Rational::from(360) / &step).ceil(),
        };
        let most = if args.all_branches {
            MOST_ANGLES
        } else {
            MOST_ROWS
        };
        if steps > most {
            return Err(Failure::new(format!(
                "--step-deg {:e} gives more than {most} crank angles; take a larger step",
                nearest(&step)
            )));
        }
        Ok(Grid {
            from,
            step,
            count: steps.numer().to_u64().unwrap_or(0),
            asked: args.from_deg.is_some() || args.to_deg.is_some(),
        })
    }

    pub fn angle(&self, k: i64) -> Rational {
        &self.step * Rational::from(k) + &self.from
    }
}

/// The file's start angle in degrees.
pub fn start_degrees(linkage: &Linkage) -> Option<Rational> {
    in_degrees(linkage.start.phi1.as_ref()?)
}

/// The crank angles that can be reached: as asked for, and on the branch's own count of turns.
pub fn plan(grid: &Grid, branch: &Branch) -> Plan {
    let whole = Plan {
        first: 0,
        last: grid.count as i64 - 1,
        limits: None,
        from: grid.from.clone(),
        step: grid.step.clone(),
    };
    let Reach::Part { low, high } = branch.reach else {
        return whole;
    };
    let degrees = |x: f64| Rational::from_f64(x.to_degrees()).unwrap_or_default();
    let (low, high) = (degrees(low.reached), degrees(high.reached));
    if grid.asked {
        return Plan {
            limits: Some((low, high)),
            ..whole
        };
    }
    let steps = |x: &Rational| Rational::from(x - &grid.from) / &grid.step;
    let integer = |q: Rational| q.numer().to_i64().unwrap_or(0);
    let (first, last) = (integer(steps(&low).ceil()), integer(steps(&high).floor()));
    Plan {
        first,
        // No more than one turn and no more than asked for.
        last: last.min(first + grid.count as i64 - 1),
        ..whole
    }
}

/// The angles in order.
pub struct Plan {
    first: i64,
    last: i64,
    limits: Option<(Rational, Rational)>,
    from: Rational,
    step: Rational,
}

impl Plan {
    /// Each angle as asked for, and on the branch's own count of turns.
    pub fn angles(&self) -> impl Iterator<Item = (Rational, Rational)> + '_ {
        (self.first..=self.last).filter_map(|k| {
            let shown = &self.step * Rational::from(k) + &self.from;
            let at = match &self.limits {
                None => shown.clone(),
                Some((low, high)) => {
                    let turns = (Rational::from(low - &shown) / 360u32).ceil();
                    let at = turns * 360u32 + &shown;
                    if at > *high {
                        return None;
                    }
                    at
                }
            };
            Some((shown, at))
        })
    }

    pub fn len(&self) -> u64 {
        match self.limits {
            None => (self.last - self.first + 1).max(0) as u64,
            Some(_) => self.angles().count() as u64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_in_a_part_of_the_turn_are_brought_there() {
        let q = |n: i64| Rational::from(n);
        let plan = Plan {
            first: 0,
            last: 5,
            limits: Some((q(-100), q(70))),
            from: q(0),
            step: q(60),
        };
        let all: Vec<(Rational, Rational)> = plan.angles().collect();
        let due = [(0, 0), (60, 60), (300, -60)].map(|(a, b)| (q(a), q(b)));
        assert_eq!(all, due);
        assert_eq!(plan.len(), 3);
    }
}
