//! The figures of the findings.

use super::BITS;
use super::motion::{DIGITS, Motion, TIMES, motion};
use super::printed::{Printed, QUANTITIES, certified, entries, kind, printed, unit};
use crate::papers::{Analysis, Found, figure, shown};
use crate::reference::{Ball, Mag, Undecided};

/// Encloses the motion and compares every printed value.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub(in crate::papers) fn analysis() -> Result<Analysis, Undecided> {
    let (motion, printed) = (motion(BITS)?, printed());
    let mut analysis = digits(&printed, &motion.values);
    analysis.add("never-stops", never_stops(&motion));
    (analysis.entries, analysis.tallies) = entries(&printed, &motion.values);
    Ok(analysis)
}

/// The findings on printed and certified values.
fn digits(printed: &[Printed], values: &[Vec<Ball>]) -> Analysis {
    let (start, end): (Vec<&Printed>, Vec<&Printed>) = printed.iter().partition(|p| p.time == "0");
    let mut analysis = Analysis::default();
    analysis.add("start-values", start_values(&start, values));
    analysis.add("reference-solution", reference_solution(&end, values));
    analysis.add("later", later(&end, values));
    analysis.add("mirrored", mirrored(&end, values));
    analysis.add("certified-motion", certified_motion(values));
    analysis
}

/// The one whose last digit at t = 0 is wrong.
const LAMBDA_1: usize = 21;

fn start_values(start: &[&Printed], values: &[Vec<Ball>]) -> Found {
    let right = |p: &&&Printed| p.number.is_rounded(certified(values, p));
    let (agree, off): (Vec<&&Printed>, Vec<_>) = start.iter().partition(right);
    let units = |p: &&&Printed| format!("{:.2}", p.number.units_off(certified(values, p)));
    let only = off.iter().all(|p| p.quantity == LAMBDA_1);
    Found::values(off.iter().map(units), only)
        .worded([agree.len(), start.len()].map(|n| n.to_string()))
}

/// Least and largest number of digits that are right among some values.
fn span(of: &[&Printed], values: &[Vec<Ball>], which: usize) -> String {
    let own = of.iter().filter(|p| kind(p.quantity) == which);
    let counts = own.map(|p| p.number.right_digits(certified(values, p)).0);
    let [least, most] = [counts.clone().min(), counts.max()].map(Option::unwrap_or_default);
    format!("{least} to {most}")
}

/// The printed values with a bar after the digits that are right; how many digits are, by kind,
/// and how many values.
fn reference_solution(end: &[&Printed], values: &[Vec<Ball>]) -> Found {
    let within = |p: &&&Printed| p.number.is_within_one(certified(values, p));
    let agree = end.iter().filter(within).count();
    let marked = end.iter().map(|p| {
        let shown = p.number.marked(certified(values, p));
        figure(QUANTITIES[p.quantity], shown, unit(p.quantity))
    });
    let spans = (0..4).map(|which| span(end, values, which));
    let counts = [agree, end.len()].map(|n| n.to_string());
    Found::new(marked, true).worded(spans.chain(counts))
}

/// Returns true if all shifts are the first one, but for a thousandth and two units of the last
/// digit.
fn together(shifts: &[f64], slack: &[f64]) -> bool {
    let [first, ..] = shifts else {
        return false;
    };
    let mut pairs = shifts.iter().zip(slack);
    pairs.all(|(s, unit)| (s - first).abs() <= 1e-3 + 2.0 * unit)
}

/// `(printed − certified)/rate` of the angles in ps, and the largest relative difference that is
/// left in the rates after the first of these times.
fn later(end: &[&Printed], values: &[Vec<Ball>]) -> Found {
    let last = &values[TIMES.len()];
    let difference = |p: &Printed| p.number.difference(certified(values, p));
    let shift = |p: &&Printed| (difference(p) / &last[p.quantity + 7]).to_f64() * 1e12;
    let of = |which: usize| end.iter().filter(move |p| kind(p.quantity) == which);
    let shifts: Vec<f64> = of(0).map(shift).collect();
    let crank = shifts.first().copied().unwrap_or(f64::NAN);
    // The effect of an angle that is off by one unit of its 16th digit.
    let slack =
        of(0).map(|p| p.number.value.unit().to_f64() / last[p.quantity + 7].to_f64().abs() * 1e12);
    let fits = together(&shifts, &slack.collect::<Vec<_>>());
    let rests = of(1).map(|p| {
        let moved = difference(p).to_f64() - crank * 1e-12 * last[p.quantity + 7].to_f64();
        (moved / last[p.quantity].to_f64()).abs()
    });
    let worst = rests.fold(0.0, f64::max);
    let shifts = shifts.iter().map(|s| format!("{s:.4}"));
    Found::values(shifts.chain([format!("{worst:.1e}")]), fits).worded([format!("{crank:.3}")])
}

/// Φ'' and Ω'' as printed, which differ, and Φ'' certified.
fn mirrored(end: &[&Printed], values: &[Vec<Ball>]) -> Found {
    let printed = |quantity: usize| end.iter().find(|p| p.quantity == quantity);
    let texts = [17, 19].map(|k| printed(k).map_or("", |p| p.number.text.as_str()));
    let differ = texts[0].trim_start_matches('-') != texts[1].trim_start_matches('-');
    let certified = shown(&values[TIMES.len()][17], DIGITS);
    let all = texts.map(String::from).into_iter().chain([certified]);
    Found::values(all, differ && opposite(values))
}

/// Returns true if Φ and Ω, their rates and their accelerations are opposite at all times.
fn opposite(values: &[Vec<Ball>]) -> bool {
    let pairs = [(3, 5), (10, 12), (17, 19)];
    let at = |t: &Vec<Ball>| pairs.iter().all(|&(a, b)| (&t[a] + &t[b]).contains_zero());
    values.iter().all(at)
}

/// Returns true if nothing is certainly left over at any of the times.
fn balanced(rests: &[Ball]) -> bool {
    rests.len() == TIMES.len() && rests.iter().all(Ball::contains_zero)
}

/// Turns of the crank, the bound of its energy, the panels of the proof, and the moment that may be
/// left over in the equations of motion.
fn never_stops(motion: &Motion) -> Found {
    let course = &motion.course;
    let balance = |m: &crate::reference::planar::Moment| m.multipliers.last().cloned();
    let rests: Vec<Ball> = course.moments.iter().filter_map(balance).collect();
    let magnitudes = rests.iter().map(Ball::magnitude);
    let largest = magnitudes.fold(Mag::ZERO, Mag::max).to_f64();
    let turns = course.moments.last().map_or(f64::NAN, |m| {
        (&m.drive - &course.start.x[0]).to_f64() / std::f64::consts::TAU
    });
    let values = [
        format!("{turns:.6}"),
        format!("{:.5}", course.least_force),
        course.panels.to_string(),
        format!("{largest:.1e}"),
    ];
    Found::values(values, balanced(&rests))
}

fn certified_motion(values: &[Vec<Ball>]) -> Found {
    let mut figures = Vec::new();
    for (time, row) in TIMES.iter().zip(&values[1..]) {
        for (k, value) in row.iter().enumerate() {
            let name = format!("t = {time} s, {}", QUANTITIES[k]);
            figures.push(figure(name, shown(value, DIGITS), unit(k)));
        }
    }
    Found::new(figures, figures_are(values))
}

fn figures_are(values: &[Vec<Ball>]) -> bool {
    values.len() == TIMES.len() + 1 && values.iter().all(|v| v.len() == QUANTITIES.len())
}

#[cfg(test)]
mod tests;
