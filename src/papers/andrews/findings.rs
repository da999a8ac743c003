//! The quantities of the findings.

use super::BITS;
use super::motion::{DIGITS, Motion, TIMES, motion};
use super::printed::{KINDS, Printed, QUANTITIES, certified, entries, kind, printed, unit};
use crate::papers::file::{Measured, Quantity};
use crate::papers::{figure, shown};
use crate::reference::{Ball, Mag, Undecided};

/// Encloses the motion and compares every printed value.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub(in crate::papers) fn analysis() -> Result<Measured, Undecided> {
    let (motion, printed) = (motion(BITS)?, printed());
    let mut measured = digits(&printed, &motion.values);
    never_stops(&motion, &mut measured);
    (measured.entries, measured.tallies) = entries(&printed, &motion.values);
    Ok(measured)
}

/// The quantities of printed and certified values.
fn digits(printed: &[Printed], values: &[Vec<Ball>]) -> Measured {
    let (start, end): (Vec<&Printed>, Vec<&Printed>) = printed.iter().partition(|p| p.time == "0");
    let mut measured = Measured::default();
    start_values(&start, values, &mut measured);
    reference_solution(&end, values, &mut measured);
    later(&end, values, &mut measured);
    measured.set("opposite", f64::from(opposite(values)));
    certified_motion(values, &mut measured);
    measured
}

/// The number of values at the start that are right to the last digit, and by how much the others
/// are off.
fn start_values(start: &[&Printed], values: &[Vec<Ball>], measured: &mut Measured) {
    let right = |p: &&&Printed| p.number.is_rounded(certified(values, p));
    let (agree, off): (Vec<&&Printed>, Vec<_>) = start.iter().partition(right);
    measured.set("right_start", agree.len() as f64);
    measured.set("all_start", start.len() as f64);
    let names: Vec<&str> = off.iter().map(|p| QUANTITIES[p.quantity]).collect();
    measured.text("wrong_start", names.join(" "));
    let units = off
        .iter()
        .map(|p| format!("{:.2}", p.number.units_off(certified(values, p))));
    measured.text("off_start", units.collect::<Vec<_>>().join(" "));
}

/// The printed values with a bar after the digits that are right; how many digits are, by kind,
/// and how many values.
fn reference_solution(end: &[&Printed], values: &[Vec<Ball>], measured: &mut Measured) {
    let marked = end.iter().map(|p| {
        let shown = p.number.marked(certified(values, p));
        figure(QUANTITIES[p.quantity], shown, unit(p.quantity))
    });
    measured.add("reference", Quantity::Figures(marked.collect()));
    for (which, kind_of) in KINDS.into_iter().enumerate() {
        let own = end.iter().filter(|p| kind(p.quantity) == which);
        let counts = own.map(|p| p.number.right_digits(certified(values, p)).0);
        let [least, most] = [counts.clone().min(), counts.max()].map(Option::unwrap_or_default);
        measured.text(kind_of, format!("{least} to {most}"));
    }
    let within = |p: &&&Printed| p.number.is_within_one(certified(values, p));
    measured.set("right_end", end.iter().filter(within).count() as f64);
    measured.set("all_end", end.len() as f64);
}

/// `(printed − certified)/rate` of the angles in ps, by how much these are farther apart than two
/// units of the last digit, and the largest relative difference that is left in the rates after the
/// first of these times; the second derivatives of Φ and Ω as printed, and that of Φ certified.
fn later(end: &[&Printed], values: &[Vec<Ball>], measured: &mut Measured) {
    let last = &values[TIMES.len()];
    let difference = |p: &Printed| p.number.difference(certified(values, p));
    let shift = |p: &Printed| (difference(p) / &last[p.quantity + 7]).to_f64() * 1e12;
    let of = |which: usize| end.iter().filter(move |p| kind(p.quantity) == which);
    let crank = of(0).next().map_or(f64::NAN, |p| shift(p));
    let mut apart = 0.0f64;
    for p in of(0) {
        // The effect of an angle that is off by one unit of its 16th digit.
        let unit = p.number.value.unit().to_f64() / last[p.quantity + 7].to_f64().abs() * 1e12;
        apart = apart.max((shift(p) - crank).abs() - 2.0 * unit);
        measured.set(format!("late_{}", QUANTITIES[p.quantity]), shift(p));
    }
    measured.set("apart", apart);
    let rests = of(1).map(|p| {
        let moved = difference(p).to_f64() - crank * 1e-12 * last[p.quantity + 7].to_f64();
        (moved / last[p.quantity].to_f64()).abs()
    });
    measured.set("rest", rests.fold(0.0, f64::max));
    for p in end.iter().filter(|p| [17, 19].contains(&p.quantity)) {
        let name = QUANTITIES[p.quantity];
        measured.add(name, Quantity::Printed(p.number.clone()));
    }
    measured.add("certified", Quantity::Number(last[17].clone()));
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
fn never_stops(motion: &Motion, measured: &mut Measured) {
    let course = &motion.course;
    let balance = |m: &crate::reference::planar::Moment| m.multipliers.last().cloned();
    let rests: Vec<Ball> = course.moments.iter().filter_map(balance).collect();
    let magnitudes = rests.iter().map(Ball::magnitude);
    let largest = magnitudes.fold(Mag::ZERO, Mag::max).to_f64();
    let turns = course.moments.last().map_or(f64::NAN, |m| {
        (&m.drive - &course.start.x[0]).to_f64() / std::f64::consts::TAU
    });
    for (name, x) in [
        ("turns", turns),
        ("least_force", course.least_force),
        ("panels", course.panels as f64),
        ("left_over", largest),
        ("balanced", f64::from(balanced(&rests))),
    ] {
        measured.set(name, x);
    }
}

/// The values at all times, unless one is missing.
fn certified_motion(values: &[Vec<Ball>], measured: &mut Measured) {
    let mut figures = Vec::new();
    for (time, row) in TIMES.iter().zip(&values[1..]) {
        for (k, value) in row.iter().enumerate() {
            let name = format!("t = {time} s, {}", QUANTITIES[k]);
            figures.push(figure(name, shown(value, DIGITS), unit(k)));
        }
    }
    if figures_are(values) {
        measured.add("motion", Quantity::Figures(figures));
    }
}

fn figures_are(values: &[Vec<Ball>]) -> bool {
    values.len() == TIMES.len() + 1 && values.iter().all(|v| v.len() == QUANTITIES.len())
}

#[cfg(test)]
mod tests;
