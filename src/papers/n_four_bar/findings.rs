//! The quantities of the findings.

use super::data::{SIZES, State, fall};
use super::motion::{BITS, DIGITS, Motion, QUANTITIES, TIMES, motion};
use super::printed::{Row, entries};
use super::singular::{
    Meeting, accelerations_without_branch, jacobian_rank, meeting, on_circle, parallelogram,
};
use crate::papers::file::{Measured, Quantity};
use crate::papers::{figure, shown};
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Encloses the motion, looks at the singular positions and compares every printed number.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub(in crate::papers) fn analysis() -> Result<Measured, Undecided> {
    let motion = motion(BITS)?;
    let mut measured = Measured::default();
    library(&motion, &mut measured);
    exudyn(&motion, &mut measured);
    (measured.entries, measured.tallies) = entries(&motion);
    passages(&motion, &mut measured)?;
    on_one_line(&mut measured);
    certified_motion(&motion, &mut measured);
    Ok(measured)
}

/// The larger size of the two coordinates.
fn farther(along: impl Fn(usize) -> f64) -> f64 {
    along(0).abs().max(along(1).abs())
}

/// The largest with its time.
fn largest(of: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    of.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
}

/// `printed − certified` of the library's rows, by how much its run is ahead at the end, how many
/// numbers are right, and the largest distance between N = 2 and N = 40 in the 10 s of the page.
fn library(motion: &Motion, measured: &mut Measured) {
    let errors = motion.library.iter().map(|(row, due)| {
        let off = |k: usize| row.place[k].difference(&due.values[k]).to_f64();
        (farther(off), row.time.to_f64())
    });
    let (worst, when) = largest(errors);
    let rows = motion.library.iter();
    let numbers: Vec<_> = rows
        .flat_map(|(row, due)| row.place.iter().zip(&due.values))
        .collect();
    let half = numbers.iter().filter(|(p, v)| p.is_rounded(v)).count();
    let least = numbers.iter().skip(1).map(|(p, v)| p.right_digits(v).0);
    // Late by this: the distance over the speed, from the angle.
    let late = |(row, due): &(Row, State)| {
        let [x, y] = [0, 1].map(|k| row.place[k].difference(&due.values[k]));
        let [vx, vy] = [&due.values[2], &due.values[3]];
        ((x * vx + y * vy) / (vx.square() + vy.square())).to_f64()
    };
    let (gap, apart) = largest(gaps(motion).into_iter());
    for (name, x) in [
        ("worst", worst),
        ("worst_at", when),
        ("ahead", motion.library.last().map_or(f64::NAN, late)),
        ("least_digits", least.min().unwrap_or(0) as f64),
        ("half", half as f64),
        ("numbers", numbers.len() as f64),
        ("gap", gap),
        ("gap_at", apart),
    ] {
        measured.set(name, x);
    }
}

fn gaps(motion: &Motion) -> Vec<(f64, f64)> {
    let rows = motion.library.iter().zip(&motion.two);
    let rows = rows.filter(|((row, _), _)| row.time <= 10);
    rows.map(|((row, forty), two)| {
        let apart = farther(|k| (&two.values[k] - &forty.values[k]).to_f64());
        (apart, row.time.to_f64())
    })
    .collect()
}

/// Steps of EXUDYN's runs in s, by their numbers.
const STEPS: [&str; 4] = ["0.001", "0.0005", "0.00025", "0.000125"];

/// Its numbers as printed, and in their order with a bar after the digits that are right; the
/// fewest and the most of these.
fn exudyn(motion: &Motion, measured: &mut Measured) {
    for (copied, due) in &motion.exudyn {
        if let (Some(k), Some(part)) = (
            STEPS.iter().position(|step| *step == copied.step),
            copied.quantity.rsplit('_').next(),
        ) {
            let printed = Quantity::Printed(copied.number.clone());
            measured.add(format!("{part}_{k}"), printed);
            if let (Some(due), "B0_x") = (due, copied.quantity.as_str()) {
                measured.add("x", Quantity::Number(due.clone()));
            }
        }
    }
    let known = motion.exudyn.iter();
    let known = known.filter_map(|(c, due)| Some((&c.number, due.as_ref()?)));
    for (k, (number, due)) in known.clone().enumerate() {
        measured.text(format!("marked_{k}"), number.marked(due));
    }
    let right = known.map(|(number, due)| number.right_digits(due).0);
    measured.set("fewest", right.clone().min().map_or(f64::NAN, |n| n as f64));
    measured.set("most", right.max().map_or(f64::NAN, |n| n as f64));
}

/// By N the period, the angle after 20 s, and the times of the first two passages.
fn passages(motion: &Motion, measured: &mut Measured) -> Result<(), Undecided> {
    let quarter = Ball::pi(BITS).shift(-1);
    for c in &motion.courses {
        let at = |quarters| c.turning.time(&(&quarter * &Ball::integer(BITS, quarters)));
        for (name, value) in [
            ("period", c.period.clone()),
            ("angle", c.states[1].angle.clone()),
            ("first", at(1)?),
            ("second", at(3)?),
        ] {
            measured.add(format!("{name}_{}", c.n), Quantity::Number(value));
        }
    }
    Ok(())
}

/// By N the ranks of the Jacobian on the parallelogram branch and with all bars on one line, the
/// assembly modes with a regular one, and the accelerations of the outer crank there; true if all
/// positions on one line are alike.
fn on_one_line(measured: &mut Measured) {
    let mut alike = true;
    for size in SIZES {
        let n = size as usize;
        let due = Meeting {
            rank: n,
            curves: n + 1,
            tangents: n + 1,
            admissible: true,
        };
        alike &= positions(n).into_iter().all(|s| meeting(n, s) == due);
        for (name, count) in [
            ("rank", jacobian_rank(&parallelogram(n))),
            ("rank_line", meeting(n, n + 1).rank),
            ("regular", regular_modes(n)),
        ] {
            measured.set(format!("{name}_{n}"), count as f64);
        }
        let branch = fall(size);
        let Some(alone) = accelerations_without_branch(n) else {
            continue;
        };
        let off = alone
            .iter()
            .map(|a| (Rational::from(a - &branch) / &branch).to_f64());
        let off = off.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        measured.set(format!("off_{n}"), off.unwrap_or(f64::NAN));
        measured.add(format!("outer_{n}"), Quantity::Exact(alone[0].clone()));
    }
    measured.set("alike", f64::from(alike));
}

/// The positions on one line that are looked at, by the number of cranks to the right: all of them,
/// of 40 windows the first, the middle and the last.
fn positions(n: usize) -> Vec<usize> {
    match n {
        0..=10 => (0..=n + 1).collect(),
        _ => vec![0, n / 2, n + 1],
    }
}

/// Circles of the first crank whose Jacobian has full rank at sin θ = 4/5.
fn regular_modes(n: usize) -> usize {
    let full = |r: &usize| jacobian_rank(&on_circle(n, 0, *r)) == 2 * n;
    (0..=n).filter(full).count()
}

/// The states of all sizes, unless one is missing.
fn certified_motion(motion: &Motion, measured: &mut Measured) {
    let mut figures = Vec::new();
    for c in &motion.courses {
        for (time, state) in TIMES.iter().zip(&c.states) {
            for ((name, unit), value) in QUANTITIES.iter().zip(&state.values) {
                let name = format!("N = {}, t = {time} s, {name}", c.n);
                figures.push(figure(name, shown(value, DIGITS), unit));
            }
        }
    }
    if figures.len() == 32 {
        measured.add("motion", Quantity::Figures(figures));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::number::Number;
    use crate::papers::on_figures;

    #[test]
    fn the_larger_coordinate_counts() {
        assert_eq!(farther(|k| [-2.0, 1.0][k]), 2.0);
        assert_eq!(farther(|k| [1.0, -2.0][k]), 2.0);
    }

    #[test]
    fn ten_seconds_are_compared() {
        let gaps = gaps(&motion(BITS).unwrap());
        assert_eq!((gaps.len(), gaps[200].1), (201, 10.0));
    }

    /// The printed and the certified numbers, both of which a finding is recorded with.
    #[test]
    fn a_number_that_is_off_is_no_longer_as_recorded() {
        let right = motion(BITS).unwrap();
        let on_prints = [
            "library-reference",
            "tolerances",
            "opensim",
            "exudyn",
            "drift",
        ];
        let lost = |m: &Motion| -> Vec<&str> {
            let mut measured = Measured::default();
            library(m, &mut measured);
            exudyn(m, &mut measured);
            passages(m, &mut measured).unwrap();
            let all = on_figures("n-four-bar", &measured).into_iter();
            let lost = all.filter(|f| !f.as_recorded && on_prints.contains(&f.id));
            lost.map(|f| f.id).collect()
        };
        assert!(lost(&right).is_empty());
        // A row less at the end.
        let mut m = right;
        let last = (m.library.pop().unwrap(), m.two.pop().unwrap());
        assert_eq!(lost(&m), ["library-reference"]);
        m.library.push(last.0);
        m.two.push(last.1);
        assert!(lost(&m).is_empty());
        // The last row alone, by 1e-7 s along the way.
        let small = Ball::rational(BITS, &Rational::from((1, 10_000_000)));
        let place = |m: &Motion| [0, 1].map(|k| m.library[400].1.values[k].clone());
        let before = place(&m);
        let state = &mut m.library[400].1;
        for k in [0, 1] {
            let step = &state.values[k + 2] * &small;
            state.values[k] = &state.values[k] + &step;
        }
        assert_eq!(lost(&m), ["library-reference"]);
        for (k, value) in before.into_iter().enumerate() {
            m.library[400].1.values[k] = value;
        }
        // A largest drift that the printed state exceeds, and another position for two windows.
        let drift = m.exudyn.iter_mut().find(|(c, _)| c.quantity == "drift");
        let number = &mut drift.unwrap().0.number;
        let before = std::mem::replace(number, Number::read("1e-6"));
        assert_eq!(lost(&m), ["drift"]);
        let drift = m.exudyn.iter_mut().find(|(c, _)| c.quantity == "drift");
        drift.unwrap().0.number = before;
        let x = m.two[100].values[0].clone();
        m.two[100].values[0] = &x + &Ball::integer(BITS, 3);
        assert_eq!(lost(&m), ["opensim"]);
        m.two[100].values[0] = x;
        // One step of four.
        m.exudyn.retain(|(c, _)| c.step != "0.00025");
        assert_eq!(lost(&m), ["exudyn", "drift"]);
    }

    #[test]
    fn the_largest_is_told_with_its_time() {
        let of = |all: &[(f64, f64)]| largest(all.iter().copied());
        assert_eq!(of(&[(1.0, 0.5), (3.0, 1.0), (2.0, 1.5)]), (3.0, 1.0));
        assert_eq!(of(&[]), (0.0, 0.0));
    }

    #[test]
    fn a_motion_without_states_is_not_the_recorded_one() {
        let none = Motion {
            courses: Vec::new(),
            library: Vec::new(),
            two: Vec::new(),
            exudyn: Vec::new(),
        };
        let mut measured = Measured::default();
        certified_motion(&none, &mut measured);
        assert!(measured.quantities.is_empty());
    }

    /// All of them, of the largest the ends and the middle.
    #[test]
    fn positions_with_all_bars_on_one_line_are_looked_at() {
        assert_eq!(positions(1), [0, 1, 2]);
        assert_eq!(positions(10), (0..12).collect::<Vec<_>>());
        assert_eq!(positions(40), [0, 20, 41]);
        assert_eq!([1, 2, 3, 5].map(regular_modes), [2; 4]);
    }
}
