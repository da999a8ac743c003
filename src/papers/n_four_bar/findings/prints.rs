//! The printed numbers.

use super::super::data::{State, gravity};
use super::super::motion::Motion;
use super::super::printed::{Copied, Row};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject, figure, figures, recorded};
use crate::reference::{Ball, Decimal};
use rug::Rational;

/// The larger of the distances in x and y.
fn apart(a: &State, b: &State) -> f64 {
    farther(|k| (&a.values[k] - &b.values[k]).to_f64())
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

/// Numbers of the library that are right to the last digit, and all of them; then its figures.
const LIBRARY: ((usize, usize), [&str; 4]) = ((431, 802), ["4.088e-6", "18.70", "0.66", "2"]);

pub(super) fn library(motion: &Motion) -> Finding {
    let numbers = || {
        let rows = motion.library.iter();
        rows.flat_map(|(row, due)| row.place.iter().zip(&due.values))
    };
    let half = numbers().filter(|(p, v)| p.is_rounded(v)).count();
    let (worst, when) = library_error(motion);
    let all = numbers().count();
    let least = numbers().skip(1).map(|(p, v)| p.right_digits(v).0).min();
    let least = least.unwrap_or(0);
    // Late by this: the distance over the speed, from the angle.
    let late = |(row, due): &(Row, State)| {
        let [x, y] = [0, 1].map(|k| row.place[k].difference(&due.values[k]));
        let [vx, vy] = [&due.values[2], &due.values[3]];
        ((x * vx + y * vy) / (vx.square() + vy.square())).to_f64()
    };
    let last = motion.library.last().map_or(f64::NAN, late);
    let figures = figures! {
        "largest error of x or y": "{worst:.3e}" => "m";
        "at": "{when:.2}" => "s";
        "ahead in time at the end": "{:.2}", last * 1e6 => "µs";
        "fewest right digits, but for x at t = 0": "{least}" => "1";
    };
    Draft::new("library-reference", Subject::Tables, "A02_solution_data.txt")
        .verdict(FindingVerdict::Confirmed)
        .titled(format!(
            "The library's reference for N = 40 is right: within {worst:.1e} m over 20 s, {half} of {all} numbers \
             to the last of 6 digits"
        ))
        .text(
            "One run of a commercial code printed with 6 digits. It drifts off in time, by no more than the figure below, \
             and serves as a reference where a thousandth is asked for. x at t = 0 is printed as -1.03833E-13, the \
             code's error of assembly; it is 0.",
        )
        .figures(figures)
        .only_if((half, all) == LIBRARY.0)
        .recorded(&LIBRARY.1)
}

pub(super) fn tolerances(motion: &Motion) -> Finding {
    let (worst, _) = library_error(motion);
    let bottom = super::squares(40)[1].to_f64().sqrt();
    let figures = figures! {
        "error of the reference over the limit 1E-3, absolute": "{:.4}", worst / 1e-3 => "1";
        "the same, relative at the threshold": "{:.2}", worst / 1e-3 / 1e-3 => "1";
        "time in which B0 moves 1E-3 m at its fastest": "{:.3}", 1e-3 / bottom * 1e3 => "ms";
    };
    Draft::new("tolerances", Subject::Claim, "specification")
        .verdict(FindingVerdict::Unexplained)
        .titled("Which error the limits 1E-1 and 1E-3 are of cannot be decided from the specification")
        .text(
            "It names the largest allowed errors, 400 output steps and a threshold of 1E-3, and no formula that joins \
             them: a relative error with the threshold as its least divisor would be a thousand times as strict near \
             the axes as an absolute one. The reference is good enough for the absolute one and, at the threshold, is \
             not for the relative one.",
        )
        .figures(figures)
        .recorded(&["0.0041", "4.09", "0.149"])
}

/// How far N = 2 and N = 40 are apart in the 10 s of the page, and when.
fn gaps(motion: &Motion) -> Vec<(f64, f64)> {
    let rows = motion.library.iter().zip(&motion.two);
    let rows = rows.filter(|((row, _), _)| row.time <= 10);
    rows.map(|((row, forty), two)| (apart(two, forty), row.time.to_f64()))
        .collect()
}

pub(super) fn opensim(motion: &Motion) -> Finding {
    let (gap, when) = largest(gaps(motion).into_iter());
    let figures = figures! {
        "largest distance in x or y within 10 s, N = 2 and N = 40": "{gap:.4}" => "m";
        "at": "{when:.2}" => "s";
        "difference of the periods": "{:.6}", (&motion.of(40).period - &motion.of(2).period).to_f64() => "s";
    };
    Draft::new("opensim", Subject::Claim, "MBSbenchmarksInOpenSim")
        .verdict(FindingVerdict::Refuted)
        .titled("A run with N = 2 cannot match the reference perfectly, which is for N = 40")
        .text(
            "The page gives N = 2 in its table, 10 s, and says that the simulation perfectly matches the reference values. \
             The period depends on N, so that B0 of the two mechanisms is apart by the figure below; the poster of the \
             same authors gives N = 40. One of the two is wrong, and the curves are pictures, from which it cannot be \
             decided which.",
        )
        .figures(figures)
        .recorded(&["0.6866", "8.80", "0.023087"])
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

pub(super) fn exudyn(motion: &Motion) -> Finding {
    let error = |step: &&str| {
        let (copied, due) = copied(motion, step, "B0_x")?;
        Some(copied.number.difference(due.as_ref()?).to_f64())
    };
    let errors: Vec<f64> = STEPS.iter().filter_map(error).collect();
    let ratios: Vec<f64> = errors.windows(2).map(|e| e[0] / e[1]).collect();
    let marked = motion.exudyn.iter().filter_map(|(c, due)| {
        let name = format!("h = {} s, t = {} s, {}", c.step, c.time, c.quantity);
        let unit = match c.quantity.contains("_v") {
            true => "m/s",
            false => "m",
        };
        Some(figure(name, c.number.marked(due.as_ref()?), unit))
    });
    let halved = STEPS.iter().skip(1).zip(ratios).map(|(step, ratio)| {
        let name = format!("error of x at 10 s, twice the step over h = {step} s");
        figure(name, format!("{ratio:.3}"), "1")
    });
    let halved: Vec<Figure> = halved.collect();
    let second_order = recorded(&halved, &RATIOS);
    let right = || {
        let all = motion.exudyn.iter();
        all.filter_map(|(c, v)| Some(c.number.right_digits(v.as_ref()?).0))
    };
    let [least, most] = [right().min(), right().max()].map(Option::unwrap_or_default);
    Draft::new("exudyn", Subject::Tables, "fourBarMechanismIftomm.py")
        .verdict(FindingVerdict::Confirmed)
        .titled(format!("EXUDYN's runs for N = 2 are right to {least} to {most} of their 10 digits and more"))
        .text(
            "Printed from four steps of one run each and kept as the test's reference. They converge to the certified \
             state with the second order of the method: halving the step quarters the error. Before the bar all digits \
             are right, the next one is wrong.",
        )
        .figures(marked.chain(halved))
        .recorded_if(second_order && (least, most) == RIGHT)
}

/// By what halving the step divides the error: four, as far as the first digits tell.
const RATIOS: [&str; 3] = ["4.041", "4.000", "3.947"];
/// Fewest and most digits found to be right in EXUDYN's numbers.
const RIGHT: (usize, usize) = (2, 6);

/// The energy of a printed state less that at the start, for N = 2, m = l = 1: a polynomial of
/// decimals.
fn energy([y, vx, vy]: [&Decimal; 3]) -> Rational {
    let square = |d: &Decimal| Rational::from(d.value.square_ref());
    let kinetic = (square(vx) + square(vy)) * 3 / 2;
    let height = Rational::from(&y.value - 1u32) * 7 / 2 * gravity();
    kinetic + height - Rational::from((3, 2))
}

pub(super) fn drift(motion: &Motion) -> Finding {
    let find = |step, quantity| copied(motion, step, quantity).map(|(c, _)| &c.number);
    let mut figures = Vec::new();
    let mut within = Vec::new();
    for step in STEPS {
        let state = ["B0_y", "B0_vx", "B0_vy"].map(|q| find(step, q));
        let ([Some(y), Some(vx), Some(vy)], Some(drift)) = (state, find(step, "drift")) else {
            continue;
        };
        let energy = energy([&y.value, &vx.value, &vy.value]);
        within.push(Rational::from(energy.abs_ref()) < drift.value.value);
        figures.extend(figures! {
            "h = {step} s, largest drift, printed": "{}", drift.text => "J";
            "h = {step} s, drift of the printed state at 10 s, exact": "{:.4e}", energy.to_f64() => "J";
        });
    }
    Draft::new("drift", Subject::Claim, "fourBarMechanismIftomm.py")
        .verdict(FindingVerdict::Unexplained)
        .titled("Largest energy errors of a run cannot be decided; they do not contradict the printed states")
        .text(
            "The energy of the motion is constant (ledger, nb-drift); an energy error is of a run and of all its steps, \
             of which the last state is printed. The energy of that state, computed exactly from its decimals, lies far \
             below the largest error: the error is not left behind but comes and goes with the speed. A small drift at \
             the end says little of a run.",
        )
        .figures(figures)
        .recorded_if(within == [true; 4])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::n_four_bar::motion::{BITS, motion};
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
        let findings = |m: &Motion| {
            let all = [library(m), tolerances(m), opensim(m), exudyn(m), drift(m)];
            all.map(|f| (f.id, f.as_recorded))
        };
        let lost = |m: &Motion| -> Vec<&str> {
            let all = findings(m).into_iter();
            all.filter(|f| !f.1).map(|f| f.0).collect()
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
}
