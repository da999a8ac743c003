//! The crank angles of the rows, exact.

use super::class_iii::{Branch, Reach};
use crate::reference::nearest_f64;
use rug::ops::Pow;
use rug::{Integer, Rational};

/// Crank angles in degrees, `from + k step`.
///
/// ```
/// use mechaudit_cli::machine::crank_angles::{Grid, Window};
/// let window = Window { step: (75, 10).into(), ..Window::default() };
/// let grid = Grid::new(&window, Some((14_426, 1000).into()), 1000)?;
/// assert_eq!(grid.count, 48);
/// assert_eq!(grid.angle(2), rug::Rational::from((29_426, 1000)));
/// # Ok::<(), mechaudit_cli::machine::crank_angles::GridError>(())
/// ```
pub struct Grid {
    /// The first angle.
    pub from: Rational,
    step: Rational,
    /// Their number.
    pub count: u64,
    /// True if the window was asked for, or is one turn from the start.
    asked: bool,
}

/// The crank angles asked for, in degrees.
#[derive(Clone, Debug, Default)]
pub struct Window {
    /// From one to the next.
    pub step: Rational,
    /// The first; else the file's start, else 0.
    pub from: Option<Rational>,
    /// The last, itself included; else one turn, its end left out.
    pub to: Option<Rational>,
}

/// Why a window has no rows.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// The step is zero or negative.
    #[error("the step must be positive, got {step}")]
    Step {
        /// The step in degrees.
        step: f64,
    },
    /// The last angle is before the first.
    #[error("the last crank angle, {to} deg, must not be less than the first, {from} deg")]
    Backwards {
        /// The last angle in degrees.
        to: f64,
        /// The first angle in degrees.
        from: f64,
    },
    /// Too many rows.
    #[error("a step of {step:e} deg gives more than {most} crank angles; take a larger step")]
    TooMany {
        /// The step in degrees.
        step: f64,
        /// The largest number possible.
        most: u64,
    },
}

impl Grid {
    /// The angles of the window, at most `most`; they begin at `start` if the window does not say
    /// where.
    ///
    /// # Errors
    /// [`GridError`].
    pub fn new(window: &Window, start: Option<Rational>, most: u64) -> Result<Grid, GridError> {
        let step = window.step.clone();
        let size = nearest_f64(&step);
        if step <= 0 {
            return Err(GridError::Step { step: size });
        }
        let from = window.from.clone().or(start).unwrap_or_default();
        let steps = match &window.to {
            Some(to) if *to < from => {
                let (to, from) = (nearest_f64(to), nearest_f64(&from));
                return Err(GridError::Backwards { to, from });
            }
            Some(to) => (Rational::from(to - &from) / &step).floor() + 1u32,
            None => (Rational::from(360) / &step).ceil(),
        };
        if steps > most {
            return Err(GridError::TooMany { step: size, most });
        }
        Ok(Grid {
            from,
            step,
            count: steps.numer().to_u64().unwrap_or_default(),
            asked: window.from.is_some() || window.to.is_some(),
        })
    }

    /// The angle of this number.
    pub fn angle(&self, k: i64) -> Rational {
        &self.step * Rational::from(k) + &self.from
    }

    /// The first angle that is this one but for whole turns.
    pub(super) fn first_at(&self, degrees: &Rational) -> Option<Rational> {
        let whole = |q: Rational| q.numer().to_u64().unwrap_or(u64::MAX);
        let round = Rational::from(360);
        // The places of these angles between two of the grid recur after that number of turns.
        let recur = Rational::from(&round / &self.step).denom().to_u64();
        let last = Rational::from(self.count.saturating_sub(1)) * &self.step;
        let turns = whole(Rational::from(&last / &round).floor()) + 1;
        let turns = turns.min(recur.unwrap_or(u64::MAX)).min(MOST_TURNS);
        let off = Rational::from(degrees - &self.from);
        let off = &off - Rational::from(&off / &round).floor() * &round;
        let all = (0..turns).map(|k| (&round * Rational::from(k)) + &off);
        let found = all.take_while(|x| *x <= last);
        let mut found = found.filter(|x| *Rational::from(x / &self.step).denom() == 1);
        found.next().map(|x| x + &self.from)
    }
}

/// Turns of a grid that are looked through for one angle: a grid has at most ten million angles,
/// few of them in each.
const MOST_TURNS: u64 = 100_000;

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
    let integer = |q: Rational| q.numer().to_i64().unwrap_or_default();
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

    /// Their number.
    pub fn count(&self) -> u64 {
        match self.limits {
            None => (self.last - self.first + 1).max(0) as u64,
            Some(_) => self.angles().count() as u64,
        }
    }
}

/// A rational number whose decimals end, written out.
///
/// ```
/// use mechaudit_cli::machine::crank_angles::decimal;
/// assert_eq!(decimal(&(-1, 8).into()), "-0.125");
/// ```
pub fn decimal(q: &Rational) -> String {
    let mut rest = q.denom().clone();
    let [twos, fives] = [2, 5].map(|p| rest.remove_factor_mut(&Integer::from(p)));
    let places = twos.max(fives) as usize;
    let scaled = Rational::from(10).pow(places as u32) * q;
    let n: Integer = scaled.numer().clone();
    let digits = format!(
        "{:0>width$}",
        n.clone().abs().to_string(),
        width = places + 1
    );
    let (whole, fraction) = digits.split_at(digits.len() - places);
    let sign = if n < 0 { "-" } else { "" };
    match places {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{fraction}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_in_a_part_of_the_turn_are_brought_there() {
        let q = |n: i64| Rational::from(n);
        for ([low, high], from, due) in [
            ([-100, 70], 0, &[(0, 0), (60, 60), (300, -60)][..]),
            // The ends are reached.
            ([-60, 60], 0, &[(0, 0), (60, 60), (300, -60)]),
            ([-59, 59], 0, &[(0, 0)]),
            // The turn has 360 degrees, forwards and backwards.
            ([360, 361], 1, &[(1, 361)]),
            ([-1079, -1078], 1, &[(1, -1079)]),
        ] {
            let plan = Plan {
                first: 0,
                last: 5,
                limits: Some((q(low), q(high))),
                from: q(from),
                step: q(60),
            };
            let all: Vec<(Rational, Rational)> = plan.angles().collect();
            let due: Vec<_> = due.iter().map(|(a, b)| (q(*a), q(*b))).collect();
            assert_eq!(all, due, "{low} to {high}");
            assert_eq!(plan.count(), due.len() as u64);
        }
    }

    #[test]
    fn angles_are_counted_from_the_first() {
        for (first, last, due) in [(3, 7, 5), (-2, 2, 5), (4, 4, 1), (5, 4, 0)] {
            let plan = Plan {
                first,
                last,
                limits: None,
                from: Rational::from(10),
                step: Rational::from(2),
            };
            assert_eq!((plan.count(), plan.angles().count() as u64), (due, due));
        }
    }

    #[test]
    fn decimals_are_written_out() {
        for (n, d, text) in [
            (14_426, 1000, "14.426"),
            (-1, 8, "-0.125"),
            (360, 1, "360"),
            (-300, 1, "-300"),
            (0, 1, "0"),
            (-1, 20, "-0.05"),
            (1, 2, "0.5"),
            (7, 5, "1.4"),
            (-1003, 16, "-62.6875"),
            (1, 125, "0.008"),
        ] {
            assert_eq!(decimal(&Rational::from((n, d))), text);
        }
        for text in ["1e-1300", "-7.25e-2000", "6.5e1300"] {
            let number = |text: &str| crate::reference::Decimal::parse(text).unwrap().value;
            let exact = number(text);
            assert_eq!(number(&decimal(&exact)), exact, "{text}");
        }
    }

    #[test]
    fn windows_have_their_ends() {
        let q = |tenths: i64| Rational::from((tenths, 10));
        let window = |[step, from, to]: [Option<i64>; 3]| Window {
            step: step.map(q).unwrap_or_default(),
            from: from.map(q),
            to: to.map(q),
        };
        for (asked, start, due) in [
            // A turn without its end, from the start if there is one.
            ([Some(900), None, None], None, (0, 4)),
            ([Some(900), None, None], Some(5), (5, 4)),
            ([Some(700), None, None], None, (0, 6)),
            ([Some(900), Some(10), None], Some(5), (10, 4)),
            // To an angle with it.
            ([Some(10), Some(0), Some(30)], None, (0, 4)),
            ([Some(10), Some(0), Some(39)], None, (0, 4)),
            ([Some(10), Some(30), Some(30)], None, (30, 1)),
        ] {
            let grid = Grid::new(&window(asked), start.map(q), 10).unwrap();
            assert_eq!((&grid.from, grid.count), (&q(due.0), due.1), "{asked:?}");
            assert_eq!(grid.angle(2), q(due.0 + 2 * asked[0].unwrap()));
        }
        for (asked, most, due) in [
            ([Some(0), None, None], 10, GridError::Step { step: 0.0 }),
            ([Some(-10), None, None], 10, GridError::Step { step: -1.0 }),
            (
                [Some(10), Some(30), Some(29)],
                10,
                GridError::Backwards { to: 2.9, from: 3.0 },
            ),
            (
                [Some(900), None, None],
                3,
                GridError::TooMany {
                    step: 90.0,
                    most: 3,
                },
            ),
        ] {
            let found = Grid::new(&window(asked), None, most);
            assert_eq!(found.err(), Some(due));
        }
        assert!(Grid::new(&window([Some(900), None, None]), None, 4).is_ok());
    }

    /// A branch between two angles in degrees, or all round.
    fn branch(ends: Option<[f64; 2]>) -> Branch {
        use crate::machine::class_iii::{End, choose};
        let text = include_str!("../../examples/sand-screen.toml");
        let file = crate::machine::Linkage::read(&crate::machine::Source::toml(text)).unwrap();
        let crate::machine::Linkage::ClassIii(linkage) = file else {
            unreachable!("of class III");
        };
        let branch = choose(&linkage.solver, &15.into(), Some(2), &linkage.start).unwrap();
        let end = |degrees: f64| End {
            phi1: f64::NAN,
            reached: degrees.to_radians(),
            phi4: 0.0,
        };
        let reach = match ends {
            Some([low, high]) => Reach::Part {
                low: end(low),
                high: end(high),
            },
            None => branch.reach,
        };
        Branch { reach, ..branch }
    }

    /// Without a window the grid goes through the whole branch, or one turn of it; with one each
    /// angle is looked for on it.
    #[test]
    fn rows_are_on_the_branch() {
        let window = |step: i32, from: Option<i32>, to: Option<i32>| Window {
            step: step.into(),
            from: from.map(Rational::from),
            to: to.map(Rational::from),
        };
        let turn = |k: i32| (k, k);
        for (window, start, ends, due) in [
            (
                window(90, None, None),
                10,
                None,
                [10, 100, 190, 280].map(turn).to_vec(),
            ),
            (
                window(90, Some(0), None),
                10,
                None,
                [0, 90, 180, 270].map(turn).to_vec(),
            ),
            (
                window(90, None, Some(190)),
                10,
                None,
                [10, 100, 190].map(turn).to_vec(),
            ),
            (
                window(30, None, None),
                10,
                Some([-101.0, 71.0]),
                [-80, -50, -20, 10, 40, 70].map(turn).to_vec(),
            ),
            // Ends beside the grid.
            (
                window(30, None, None),
                10,
                Some([-79.0, 69.0]),
                [-50, -20, 10, 40].map(turn).to_vec(),
            ),
            (
                window(30, None, None),
                10,
                Some([-81.0, -51.0]),
                vec![turn(-80)],
            ),
            (window(30, None, None), 10, Some([11.0, 39.0]), vec![]),
            // Three turns and more.
            (
                window(120, None, None),
                10,
                Some([-371.0, 800.0]),
                [-350, -230, -110].map(turn).to_vec(),
            ),
            (
                window(90, Some(0), None),
                10,
                Some([-100.0, 71.0]),
                vec![(0, 0), (270, -90)],
            ),
            (
                window(90, None, Some(280)),
                10,
                Some([-100.0, 71.0]),
                vec![(10, 10), (280, -80)],
            ),
        ] {
            let grid = Grid::new(&window, Some(start.into()), 100).unwrap();
            let plan = plan(&grid, &branch(ends));
            let found: Vec<(Rational, Rational)> = plan.angles().collect();
            let due: Vec<_> = due.into_iter().map(|(a, b)| (a.into(), b.into())).collect();
            assert_eq!(found, due, "{window:?} {ends:?}");
            assert_eq!(plan.count(), due.len() as u64);
        }
    }
}
