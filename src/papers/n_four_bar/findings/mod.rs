//! The findings.

mod line;
mod prints;

use super::data::squares;
use super::motion::{BITS, DIGITS, Motion, QUANTITIES, TIMES};
use crate::papers::ledger::{Ledger, proved};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figure, figures, known, shown};
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

fn equations(ledger: &Ledger) -> Finding {
    proved(
        ledger,
        ["equations", "ledger"],
        "For every N the parallelograms move as one pendulum, proved",
        "With equal cranks and rods the reduced inertia is (4N + 1) m l²/3 at every angle, and \
         φ'' = 3 (3N + 1) g sin φ/(2 (4N + 1) l) with φ from upright. The ledger has it, the loops \
         of a window and what happens on one line, with N as a symbol.",
    )
}

fn turns_over(motion: &Motion) -> Finding {
    let mut figures = Vec::new();
    let mut faster = true;
    let tau = Ball::pi(BITS).shift(1);
    for c in &motion.courses {
        let n = c.n;
        let [top, bottom] = squares(n);
        faster &= top > 0 && bottom > top;
        let fastest = Ball::rational(BITS, &bottom).sqrt();
        figures.extend(figures! {
            "N = {n}, period": "{}", shown(&c.period, DIGITS) => "s";
            "N = {n}, largest speed of B0": "{}", shown(&fastest, 12) => "m/s";
            "N = {n}, turns in 20 s": "{}", shown(&(&c.states[1].angle / &tau), 12) => "1";
        });
    }
    let whole = faster && known(&figures);
    Draft::new("turns-over", Subject::Claim, "0 to 20 s")
        .verdict(FindingVerdict::Confirmed)
        .titled("The cranks pass over the top and turn one way for ever, proved")
        .text(
            "φ'² = 1 + 6 (3N + 1) g sin²(φ/2)/(4N + 1) in 1/s² is never less than at the start, exactly. A turn takes \
             2π/agm(p, q) with the speeds p = 1 at the top and q at the bottom; angle and time go by Gauss's \
             transformation, whose means bound from both sides.",
        )
        .figures(figures)
        .recorded_if(whole)
}

fn certified_motion(motion: &Motion) -> Finding {
    let mut figures = Vec::new();
    for c in &motion.courses {
        for (time, state) in TIMES.iter().zip(&c.states) {
            for ((name, unit), value) in QUANTITIES.iter().zip(&state.values) {
                let name = format!("N = {}, t = {time} s, {name}", c.n);
                figures.push(figure(name, shown(value, DIGITS), unit));
            }
        }
    }
    let whole = known(&figures) && figures.len() == 32;
    Draft::new("certified-motion", Subject::Tables, "t = 10, 20 s")
        .verdict(FindingVerdict::Recovered)
        .titled(format!("Position and velocity of B0 for N = 1, 2, 10, 40 to {DIGITS} digits"))
        .text(format!(
            "Enclosed at {BITS} bits. `reference/values/n-four-bar-motion.csv` holds them, at every second of the 20."
        ))
        .figures(figures)
        .recorded_if(whole)
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
}
