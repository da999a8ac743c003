//! The figures of the findings.

use super::data::{SIZES, State, fall, gravity};
use super::motion::{BITS, Course, DIGITS, Motion, QUANTITIES, TIMES, motion};
use super::printed::{Copied, Row, entries};
use super::singular::{
    Meeting, accelerations_without_branch, jacobian_rank, meeting, on_circle, parallelogram, poles,
};
use crate::papers::{Analysis, Found, decided, figure, shown};
use crate::reference::{Ball, Decimal, Undecided};
use rug::Rational;

/// Encloses the motion, looks at the singular positions and compares every printed number.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub(in crate::papers) fn analysis() -> Result<Analysis, Undecided> {
    let motion = motion(BITS)?;
    let mut analysis = prints(&motion);
    (analysis.entries, analysis.tallies) = entries(&motion);
    analysis.add("turns-over", turns_over(&motion));
    analysis.add("passages", passages(&motion)?);
    analysis.add("ranks", ranks());
    analysis.add("curves", curves());
    analysis.add("accelerations", accelerations());
    analysis.add("joint-forces", forces());
    analysis.add("certified-motion", certified_motion(&motion));
    Ok(analysis)
}

/// The findings on printed numbers.
fn prints(motion: &Motion) -> Analysis {
    let mut analysis = Analysis::default();
    let (worst, when) = library_error(motion);
    analysis.add("library-reference", library(motion, worst, when));
    let limits = [
        format!("{:.4}", worst / 1e-3),
        format!("{:.2}", worst / 1e-3 / 1e-3),
    ];
    analysis.add("tolerances", Found::values(limits, true));
    let (gap, when) = largest(gaps(motion).into_iter());
    let periods = &motion.of(40).period - &motion.of(2).period;
    let apart = [
        format!("{gap:.4}"),
        format!("{when:.2}"),
        format!("{:.6}", periods.to_f64()),
    ];
    analysis.add("opensim", Found::values(apart, true));
    analysis.add("exudyn", exudyn(motion));
    analysis.add("drift", drift(motion));
    analysis
}

/// The larger size of the two coordinates.
fn farther(along: impl Fn(usize) -> f64) -> f64 {
    along(0).abs().max(along(1).abs())
}

/// The largest with its time.
fn largest(of: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    of.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
}

/// `printed − certified` of the library's rows: largest size, and when.
fn library_error(motion: &Motion) -> (f64, f64) {
    let errors = motion.library.iter().map(|(row, due)| {
        let off = |k: usize| row.place[k].difference(&due.values[k]).to_f64();
        (farther(off), row.time.to_f64())
    });
    largest(errors)
}

/// Largest error, its time, by how much the library's run is ahead at the end, and the fewest
/// digits that are right.
fn library(motion: &Motion, worst: f64, when: f64) -> Found {
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
    let last = motion.library.last().map_or(f64::NAN, late);
    let values = [
        format!("{worst:.3e}"),
        format!("{when:.2}"),
        format!("{:.2}", last * 1e6),
        least.min().unwrap_or(0).to_string(),
    ];
    let counts = [half, numbers.len()].map(|n| n.to_string());
    Found::values(values, true).worded([format!("{worst:.1e}")].into_iter().chain(counts))
}

/// The largest distance between N = 2 and N = 40 in the 10 s of the page, and its time.
fn gaps(motion: &Motion) -> Vec<(f64, f64)> {
    let rows = motion.library.iter().zip(&motion.two);
    let rows = rows.filter(|((row, _), _)| row.time <= 10);
    rows.map(|((row, forty), two)| {
        let apart = farther(|k| (&two.values[k] - &forty.values[k]).to_f64());
        (apart, row.time.to_f64())
    })
    .collect()
}

/// Steps of EXUDYN's runs in s.
const STEPS: [&str; 4] = ["0.001", "0.0005", "0.00025", "0.000125"];

/// A number of one of them, with what is due.
fn copied<'a>(
    motion: &'a Motion,
    step: &str,
    quantity: &str,
) -> Option<&'a (Copied, Option<Ball>)> {
    let mut all = motion.exudyn.iter();
    all.find(|(c, _)| c.step == step && c.quantity == quantity)
}

/// The numbers with a bar after the digits that are right, and by how much halving the step divides
/// the error; the fewest and the most digits that are right.
fn exudyn(motion: &Motion) -> Found {
    let known = motion.exudyn.iter();
    let known: Vec<(&Copied, &Ball)> = known
        .filter_map(|(c, due)| Some((c, due.as_ref()?)))
        .collect();
    let error = |step: &&str| {
        let (copied, due) = copied(motion, step, "B0_x")?;
        Some(copied.number.difference(due.as_ref()?).to_f64())
    };
    let errors: Vec<f64> = STEPS.iter().filter_map(error).collect();
    let ratios = errors.windows(2).map(|e| format!("{:.3}", e[0] / e[1]));
    let marked = known.iter().map(|(c, due)| c.number.marked(due));
    let right = || known.iter().map(|(c, due)| c.number.right_digits(due).0);
    let [least, most] = [right().min(), right().max()].map(Option::unwrap_or_default);
    Found::values(marked.chain(ratios), true).worded([least, most].map(|n| n.to_string()))
}

/// The energy of a printed state less that at the start, for N = 2, m = l = 1: a polynomial of
/// decimals.
fn energy([y, vx, vy]: [&Decimal; 3]) -> Rational {
    let square = |d: &Decimal| Rational::from(d.value.square_ref());
    let kinetic = (square(vx) + square(vy)) * 3 / 2;
    let height = Rational::from(&y.value - 1u32) * 7 / 2 * gravity();
    kinetic + height - Rational::from((3, 2))
}

/// By steps the largest drift as printed, and the drift of the printed state, which is smaller.
fn drift(motion: &Motion) -> Found {
    let find = |step, quantity| copied(motion, step, quantity).map(|(c, _)| &c.number);
    let mut values = Vec::new();
    let mut within = true;
    for step in STEPS {
        let state = ["B0_y", "B0_vx", "B0_vy"].map(|q| find(step, q));
        let ([Some(y), Some(vx), Some(vy)], Some(drift)) = (state, find(step, "drift")) else {
            continue;
        };
        let energy = energy([&y.value, &vx.value, &vy.value]);
        within &= Rational::from(energy.abs_ref()) < drift.value.value;
        values.extend([drift.text.clone(), format!("{:.4e}", energy.to_f64())]);
    }
    Found::values(values, within)
}

/// By N the period and the turns in 20 s.
fn turns_over(motion: &Motion) -> Found {
    let tau = Ball::pi(BITS).shift(1);
    let values = |c: &Course| {
        let turns = &c.states[1].angle / &tau;
        [shown(&c.period, DIGITS), shown(&turns, 12)]
    };
    Found::values(motion.courses.iter().flat_map(values), true)
}

/// By N the times of the first two passages, and how many there are in 20 s.
fn passages(motion: &Motion) -> Result<Found, Undecided> {
    let mut values = Vec::new();
    let quarter = Ball::pi(BITS).shift(-1);
    for c in &motion.courses {
        for quarters in [1, 3] {
            let angle = &quarter * &Ball::integer(BITS, quarters);
            values.push(shown(&c.turning.time(&angle)?, DIGITS));
        }
        // At (k + 1/2) π for k = 0, 1, …: as many as ⌊φ/π + 1/2⌋.
        let count = whole_part(&(&c.states[1].angle / &quarter.shift(1) + Ball::exact(BITS, 0.5)));
        values.push(decided(count.map(|n| n.to_string())));
    }
    Ok(Found::values(values, true))
}

/// The integer part, where all of the ball has the same.
fn whole_part(x: &Ball) -> Option<f64> {
    let [low, high] = [x.lower(), x.upper()].map(rug::Float::floor);
    (low == high).then(|| low.to_f64())
}

/// By N the rank of the Jacobian on the parallelogram branch, and with all bars on one line.
fn ranks() -> Found {
    let of = |n: u32| {
        let n = n as usize;
        let ranks = [jacobian_rank(&parallelogram(n)), meeting(n, n + 1).rank];
        ranks.map(|rank| rank.to_string())
    };
    Found::values(SIZES.into_iter().flat_map(of), true)
}

/// By N the assembly modes with a regular Jacobian, where all positions on one line are alike.
fn curves() -> Found {
    let alike = |n: u32| {
        let n = n as usize;
        let due = Meeting {
            rank: n,
            curves: n + 1,
            tangents: n + 1,
            admissible: true,
        };
        positions(n).into_iter().all(|s| meeting(n, s) == due)
    };
    let regular = SIZES.map(|n| regular_modes(n as usize).to_string());
    Found::values(regular, SIZES.into_iter().all(alike))
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

/// By N the acceleration on the branch, that without it, and how far apart they are.
fn accelerations() -> Found {
    let mut values = Vec::new();
    for n in SIZES {
        let branch = fall(n);
        let Some(alone) = accelerations_without_branch(n as usize) else {
            continue;
        };
        let off = alone
            .iter()
            .map(|a| (Rational::from(a - &branch) / &branch).to_f64());
        let off = off.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let outer = match n {
            1 | 2 => alone[0].to_string(),
            _ => format!("{:.12}", alone[0].to_f64()),
        };
        let off = format!("{:.4}", off.unwrap_or_default());
        values.extend([branch.to_string(), outer, off]);
    }
    Found::values(values, true)
}

/// By N the limit at the first rod, and how many rods have a finite force: the middle one where
/// there is one.
fn forces() -> Found {
    let all = SIZES.map(|n| (n as usize, poles(n)));
    let whole = all.iter().all(|(n, poles)| poles.len() == *n);
    let values = all.iter().flat_map(|(_, poles)| {
        let zero = poles.iter().filter(|p| **p == 0).count();
        [poles[0].to_string(), zero.to_string()]
    });
    Found::values(values, whole)
}

fn certified_motion(motion: &Motion) -> Found {
    let mut figures = Vec::new();
    for c in &motion.courses {
        for (time, state) in TIMES.iter().zip(&c.states) {
            for ((name, unit), value) in QUANTITIES.iter().zip(&state.values) {
                let name = format!("N = {}, t = {time} s, {name}", c.n);
                figures.push(figure(name, shown(value, DIGITS), unit));
            }
        }
    }
    let whole = figures.len() == 32;
    Found::new(figures, whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::file_of_known;
    use crate::papers::number::Number;

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
        let file = file_of_known(super::super::KEY);
        let on_prints = [
            "library-reference",
            "tolerances",
            "opensim",
            "exudyn",
            "drift",
        ];
        let lost = |m: &Motion| -> Vec<&str> {
            let all = file.on_figures(&mut prints(m)).into_iter();
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

    /// ½ · 3 · (0.6² + 0.8²) + 7/2 · 9.81 · (y − 1) − 3/2.
    #[test]
    fn energy_is_that_at_the_start() {
        let read = |text: &str| Decimal::parse(text).unwrap();
        let of = |y: &str, vx: &str, vy: &str| energy([&read(y), &read(vx), &read(vy)]);
        assert_eq!(of("1", "0.6", "0.8"), 0);
        assert_eq!(of("0", "0.6", "0.8"), Rational::from((-6867, 200)));
        assert_eq!(of("1", "2", "-1"), 6);
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
        assert!(!certified_motion(&none).holds);
    }

    /// All of them, of the largest the ends and the middle.
    #[test]
    fn positions_with_all_bars_on_one_line_are_looked_at() {
        assert_eq!(positions(1), [0, 1, 2]);
        assert_eq!(positions(10), (0..12).collect::<Vec<_>>());
        assert_eq!(positions(40), [0, 20, 41]);
        assert_eq!([1, 2, 3, 5].map(regular_modes), [2; 4]);
    }

    #[test]
    fn a_ball_across_an_integer_has_no_integer_part() {
        let ball =
            |x: f64, r: f64| Ball::exact(BITS, x).widened(crate::reference::Mag::from_f64(r));
        assert_eq!(whole_part(&ball(20.5, 0.4)), Some(20.0));
        assert_eq!(whole_part(&ball(20.5, 0.6)), None);
        assert_eq!(whole_part(&ball(20.25, 0.3)), None);
        assert_eq!(whole_part(&ball(20.75, 0.3)), None);
    }
}
