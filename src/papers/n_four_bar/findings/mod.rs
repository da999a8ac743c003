//! What was found.

mod line;
mod prints;

use super::data::squares;
use super::motion::{BITS, DIGITS, Motion, QUANTITIES, TIMES};
use crate::papers::ledger::{Ledger, Verdict};
use crate::papers::{Figure, Finding, FindingVerdict, Subject, figure};
use crate::reference::{Ball, Undecided};

pub(super) fn all(ledger: &Ledger, motion: &Motion) -> Result<Vec<Finding>, Undecided> {
    Ok(vec![
        equations(ledger),
        prints::library(motion),
        prints::tolerances(motion),
        prints::opensim(motion),
        prints::exudyn(motion),
        prints::drift(motion),
        turns_over(motion),
        line::passages(motion)?,
        line::ranks(),
        line::curves(),
        line::which_way(motion),
        line::accelerations(),
        line::forces(),
        certified_motion(motion),
    ])
}

/// A value to so many digits, or that it is not known to as many; and whether it is.
fn shown(value: &Ball, digits: usize) -> (String, bool) {
    match value.to_decimal(digits) {
        Some(text) => (text, true),
        None => ("undecided".into(), false),
    }
}

fn equations(ledger: &Ledger) -> Finding {
    Finding {
        id: "equations",
        subject: Subject::Formula,
        place: "ledger",
        title: "For every N the parallelograms move as one pendulum, proved".into(),
        verdict: FindingVerdict::Confirmed,
        text: "With equal cranks and rods the reduced inertia is (4N + 1) m l²/3 at every angle, and \
               φ'' = 3 (3N + 1) g sin φ/(2 (4N + 1) l) with φ from upright. The ledger has it, the loops of a window \
               and what happens on one line, with N as a symbol."
            .into(),
        figures: vec![
            figure("entries of the ledger", ledger.entries.len(), "1"),
            figure("proved", ledger.count(Verdict::Proved), "1"),
        ],
        as_recorded: ledger.as_recorded(),
    }
}

fn turns_over(motion: &Motion) -> Finding {
    let mut figures = Vec::new();
    let mut whole = true;
    let tau = Ball::pi(BITS).shift(1);
    for c in &motion.courses {
        let [top, bottom] = squares(c.n);
        whole &= top > 0 && bottom > top;
        let fastest = Ball::rational(BITS, &bottom).sqrt();
        let turns = &c.states[1].angle / &tau;
        for (name, value, unit, digits) in [
            ("period", &c.period, "s", DIGITS),
            ("largest speed of B0", &fastest, "m/s", 12),
            ("turns in 20 s", &turns, "1", 12),
        ] {
            let (text, known) = shown(value, digits);
            whole &= known;
            figures.push(figure(format!("N = {}, {name}", c.n), text, unit));
        }
    }
    Finding {
        id: "turns-over",
        subject: Subject::Claim,
        place: "0 to 20 s",
        title: "The cranks pass over the top and turn one way for ever, proved".into(),
        verdict: FindingVerdict::Confirmed,
        text: "φ'² = 1 + 6 (3N + 1) g sin²(φ/2)/(4N + 1) in 1/s² is never less than at the start, exactly. A turn takes \
               2π/agm(p, q) with the speeds p = 1 at the top and q at the bottom; angle and time go by Gauss's \
               transformation, whose means bound from both sides."
            .into(),
        figures,
        as_recorded: whole,
    }
}

fn certified_motion(motion: &Motion) -> Finding {
    let mut figures: Vec<Figure> = Vec::new();
    let mut whole = true;
    for c in &motion.courses {
        for (time, state) in TIMES.iter().zip(&c.states) {
            for ((name, unit), value) in QUANTITIES.iter().zip(&state.values) {
                let (text, known) = shown(value, DIGITS);
                whole &= known;
                figures.push(figure(
                    format!("N = {}, t = {time} s, {name}", c.n),
                    text,
                    unit,
                ));
            }
        }
    }
    Finding {
        id: "certified-motion",
        subject: Subject::Tables,
        place: "t = 10, 20 s",
        title: format!("Position and velocity of B0 for N = 1, 2, 10, 40 to {DIGITS} digits"),
        verdict: FindingVerdict::Recovered,
        text: format!(
            "Enclosed at {BITS} bits. `reference/values/n-four-bar-motion.csv` holds them, at every second of the 20."
        ),
        as_recorded: whole && figures.len() == 32,
        figures,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_without_states_is_not_the_recorded_one() {
        let none = Motion {
            courses: Vec::new(),
            library: Vec::new(),
            two: Vec::new(),
            exudyn: Vec::new(),
        };
        assert!(!certified_motion(&none).as_recorded);
    }

    #[test]
    fn what_is_not_known_to_so_many_digits_is_undecided() {
        let third = &Ball::integer(64, 1) / &Ball::integer(64, 3);
        assert_eq!(shown(&third, 5), ("0.33333".into(), true));
        assert_eq!(shown(&third, 30), ("undecided".into(), false));
    }
}
