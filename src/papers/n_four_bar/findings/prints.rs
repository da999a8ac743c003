//! The printed numbers.

use super::super::data::{State, gravity};
use super::super::motion::Motion;
use crate::papers::number::Number;
use crate::papers::{Figure, Finding, FindingVerdict, Subject, figure, figures, recorded};
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

/// `printed − certified` of the library's rows: largest size, and when.
fn library_error(motion: &Motion) -> (f64, f64) {
    let errors = motion.library.iter().map(|(row, due)| {
        let off = |k: usize| row.place[k].difference(&due.values[k]).to_f64();
        (farther(off), row.time.to_f64())
    });
    errors.fold((0.0, 0.0), |m, e| if e.0 > m.0 { e } else { m })
}

pub(super) fn library(motion: &Motion) -> Finding {
    let numbers = || {
        let rows = motion.library.iter();
        rows.flat_map(|(row, due)| row.place.iter().zip(&due.values))
    };
    let count = |limit: f64| numbers().filter(|(p, v)| p.within(v, limit)).count();
    let (worst, when) = library_error(motion);
    let (half, all) = (count(0.5), numbers().count());
    let least = numbers().skip(1).map(|(p, v)| p.right_digits(v).0).min();
    let least = least.unwrap_or(0);
    // Late by this: the distance over the speed, from the angle.
    let late = |(row, due): &(super::super::printed::Row, State)| {
        let [x, y] = [0, 1].map(|k| row.place[k].difference(&due.values[k]));
        let [vx, vy] = [&due.values[2], &due.values[3]];
        ((x * vx + y * vy) / (vx.square() + vy.square())).to_f64()
    };
    let last = motion.library.last().map_or(f64::NAN, late);
    Finding {
        id: "library-reference",
        subject: Subject::Tables,
        place: "A02_solution_data.txt",
        title: format!(
            "The library's reference for N = 40 is right: within {worst:.1e} m over 20 s, {half} of {all} numbers \
             to the last of 6 digits"
        ),
        verdict: FindingVerdict::Confirmed,
        text: "One run of a commercial code printed with 6 digits. It drifts off in time, by no more than the figure below, \
               and serves as a reference where a thousandth is asked for. x at t = 0 is printed as -1.03833E-13, the \
               code's error of assembly; it is 0."
            .into(),
        figures: figures! {
            "largest error of x or y": "{worst:.3e}" => "m";
            "at": "{when:.2}" => "s";
            "ahead in time at the end": "{:.2}", last * 1e6 => "µs";
            "fewest right digits, but for x at t = 0": "{least}" => "1";
        },
        as_recorded: all == 802 && half > 300 && (4.0e-6..4.2e-6).contains(&worst),
    }
}

pub(super) fn tolerances(motion: &Motion) -> Finding {
    let (worst, _) = library_error(motion);
    let bottom = super::squares(40)[1].to_f64().sqrt();
    let figures = figures! {
        "error of the reference over the limit 1E-3, absolute": "{:.4}", worst / 1e-3 => "1";
        "the same, relative at the threshold": "{:.2}", worst / 1e-3 / 1e-3 => "1";
        "time in which B0 moves 1E-3 m at its fastest": "{:.3}", 1e-3 / bottom * 1e3 => "ms";
    };
    Finding {
        id: "tolerances",
        subject: Subject::Claim,
        place: "specification",
        title: "Which error the limits 1E-1 and 1E-3 are of cannot be decided from the specification".into(),
        verdict: FindingVerdict::Unexplained,
        text: "It names the largest allowed errors, 400 output steps and a threshold of 1E-3, and no formula that joins \
               them: a relative error with the threshold as its least divisor would be a thousand times as strict near \
               the axes as an absolute one. The reference is good enough for the absolute one and, at the threshold, is \
               not for the relative one."
            .into(),
        as_recorded: recorded(&figures, &["0.0041", "4.09", "0.149"]),
        figures,
    }
}

/// How far N = 2 and N = 40 are apart in the 10 s of the page, and when.
fn gaps(motion: &Motion) -> Vec<(f64, f64)> {
    let rows = motion.library.iter().zip(&motion.two);
    let rows = rows.filter(|((row, _), _)| row.time <= 10);
    rows.map(|((row, forty), two)| (apart(two, forty), row.time.to_f64()))
        .collect()
}

pub(super) fn opensim(motion: &Motion) -> Finding {
    let gaps = gaps(motion).into_iter();
    let (gap, when) = gaps.fold((0.0, 0.0), |m, g| if g.0 > m.0 { g } else { m });
    Finding {
        id: "opensim",
        subject: Subject::Claim,
        place: "MBSbenchmarksInOpenSim",
        title: "A run with N = 2 cannot match the reference perfectly, which is for N = 40".into(),
        verdict: FindingVerdict::Refuted,
        text: "The page gives N = 2 in its table, 10 s, and says that the simulation perfectly matches the reference values. \
               The period depends on N, so that B0 of the two mechanisms is apart by the figure below; the poster of the \
               same authors gives N = 40. One of the two is wrong, and the curves are pictures, from which it cannot be \
               decided which."
            .into(),
        figures: figures! {
            "largest distance in x or y within 10 s, N = 2 and N = 40": "{gap:.4}" => "m";
            "at": "{when:.2}" => "s";
            "difference of the periods": "{:.6}", (&motion.of(40).period - &motion.of(2).period).to_f64() => "s";
        },
        as_recorded: (0.68..0.69).contains(&gap),
    }
}

pub(super) fn exudyn(motion: &Motion) -> Finding {
    let due = |step: &str, quantity: &str| {
        let at = |(c, _): &&(super::super::printed::Copied, Option<Ball>)| {
            c.step == step && c.quantity == quantity
        };
        let (copied, due) = motion.exudyn.iter().find(at)?;
        Some((&copied.number, due.as_ref()?))
    };
    let error = |step: &str| {
        let (p, v) = due(step, "B0_x")?;
        Some(p.difference(v).to_f64())
    };
    let steps = ["0.001", "0.0005", "0.00025", "0.000125"];
    let errors: Vec<f64> = steps.iter().filter_map(|s| error(s)).collect();
    let ratios: Vec<f64> = errors.windows(2).map(|e| e[0] / e[1]).collect();
    let mut figures: Vec<Figure> = Vec::new();
    for (copied, due) in &motion.exudyn {
        let Some(due) = due else { continue };
        let name = format!(
            "h = {} s, t = {} s, {}",
            copied.step, copied.time, copied.quantity
        );
        let unit = match copied.quantity.contains("_v") {
            true => "m/s",
            false => "m",
        };
        figures.push(figure(name, copied.number.marked(due), unit));
    }
    for (step, ratio) in steps.iter().skip(1).zip(&ratios) {
        let name = format!("error of x at 10 s, twice the step over h = {step} s");
        figures.push(figure(name, format!("{ratio:.3}"), "1"));
    }
    let right = motion
        .exudyn
        .iter()
        .filter_map(|(c, v)| Some(c.number.right_digits(v.as_ref()?).0));
    let (least, most) = right.fold((usize::MAX, 0), |(a, b), n| (a.min(n), b.max(n)));
    Finding {
        id: "exudyn",
        subject: Subject::Tables,
        place: "fourBarMechanismIftomm.py",
        title: format!("EXUDYN's runs for N = 2 are right to {least} to {most} of their 10 digits and more"),
        verdict: FindingVerdict::Confirmed,
        text: "Printed from four steps of one run each and kept as the test's reference. They converge to the certified \
               state with the second order of the method: halving the step quarters the error. Before the bar all digits \
               are right, the next one is wrong."
            .into(),
        figures,
        as_recorded: ratios.len() == 3
            && ratios.iter().all(|r| (3.9..4.1).contains(r))
            && (least, most) == RIGHT,
    }
}

/// Fewest and most digits found to be right in EXUDYN's numbers.
const RIGHT: (usize, usize) = (2, 6);

/// The energy of a printed state less that at the start, for N = 2, m = l = 1: a polynomial of decimals.
fn energy([y, vx, vy]: [&Decimal; 3]) -> Rational {
    let square = |d: &Decimal| Rational::from(d.value.square_ref());
    let kinetic = (square(vx) + square(vy)) * 3 / 2;
    let height = Rational::from(&y.value - 1u32) * 7 / 2 * gravity();
    kinetic + height - Rational::from((3, 2))
}

pub(super) fn drift(motion: &Motion) -> Finding {
    let find = |step: &str, quantity: &str| -> Option<&Number> {
        let at = |(c, _): &&(super::super::printed::Copied, Option<Ball>)| {
            c.step == step && c.quantity == quantity
        };
        motion.exudyn.iter().find(at).map(|(c, _)| &c.number)
    };
    let mut figures = Vec::new();
    let mut within = 0;
    for step in ["0.001", "0.0005", "0.00025", "0.000125"] {
        let state = ["B0_y", "B0_vx", "B0_vy"].map(|q| find(step, q));
        let ([Some(y), Some(vx), Some(vy)], Some(drift)) = (state, find(step, "drift")) else {
            continue;
        };
        let energy = energy([&y.value, &vx.value, &vy.value]);
        within += usize::from(Rational::from(energy.abs_ref()) < drift.value.value);
        let name = |what: &str| format!("h = {step} s, {what}");
        figures.push(figure(name("largest drift, printed"), &drift.text, "J"));
        let shown = format!("{:.4e}", energy.to_f64());
        figures.push(figure(
            name("drift of the printed state at 10 s, exact"),
            shown,
            "J",
        ));
    }
    Finding {
        id: "drift",
        subject: Subject::Claim,
        place: "fourBarMechanismIftomm.py",
        title: "Largest energy errors of a run cannot be decided; they do not contradict the printed states".into(),
        verdict: FindingVerdict::Unexplained,
        text: "The energy of the motion is constant (ledger, nb-drift); an energy error is of a run and of all its steps, \
               of which the last state is printed. The energy of that state, computed exactly from its decimals, lies far \
               below the largest error: the error is not left behind but comes and goes with the speed. A small drift at \
               the end says little of a run."
            .into(),
        as_recorded: within == 4,
        figures,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::n_four_bar::motion::{BITS, motion};

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
}
