//! The paper's formulas, evaluated as they are printed.
//!
//! A formula is data here: a function of exact rationals or of balls that does what the print says.
//! Each check either proves it (an identity of polynomials on a full grid, module `exact`; elsewhere
//! balls that contain zero and are narrower than 10⁻⁴⁰) or gives a counter-example, and then the
//! corrected form is put through the same check. A finding is `as_recorded` only when every
//! outcome is the recorded one; its tests plant a fault in each formula and see that change.
//!
//! The scan is the only source, so a wrong sign or index in it is called a misprint of the paper
//! *or* of the scan where the text does not settle which.

mod exact;
mod extreme;
mod motion;
mod rates;
mod reduction;
mod sample;
mod spline;
mod sweep;

use crate::papers::{Draft, Finding, FindingVerdict, Subject, decided};
use crate::reference::{Ball, Undecided};

/// What a check found out about a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Proved, or enclosed in a ball around zero narrower than [`TIGHT`].
    Holds,
    /// A counter-example exists.
    Fails,
    /// Neither.
    Undecided,
}

/// Radius below which a residual that contains zero counts as zero. Working precision is 224 bits
/// (67 digits) and residuals are sums of a few dozen terms of size up to 10⁵, so 50 digits remain;
/// a wrong term shows at 10⁻³ or more.
const TIGHT: f64 = 1e-40;

impl Outcome {
    /// One failure makes a failure; nothing checked is undecided.
    fn all(outcomes: impl IntoIterator<Item = Outcome>) -> Outcome {
        let mut found = Outcome::Undecided;
        let mut undecided = false;
        for outcome in outcomes {
            match outcome {
                Outcome::Fails => return Outcome::Fails,
                Outcome::Holds => found = Outcome::Holds,
                Outcome::Undecided => undecided = true,
            }
        }
        if undecided { Outcome::Undecided } else { found }
    }

    /// Of residuals that are zero when the formula holds.
    fn enclosed<'a>(residuals: impl IntoIterator<Item = &'a Ball>) -> Outcome {
        Outcome::all(residuals.into_iter().map(|r| {
            if !r.contains_zero() {
                Outcome::Fails
            } else if r.rad().to_f64() < TIGHT {
                Outcome::Holds
            } else {
                Outcome::Undecided
            }
        }))
    }

    fn of(condition: bool) -> Outcome {
        if condition {
            Outcome::Holds
        } else {
            Outcome::Fails
        }
    }
}

/// An upper bound on the residuals, for a figure.
fn largest<'a>(residuals: impl IntoIterator<Item = &'a Ball>) -> String {
    let largest = residuals
        .into_iter()
        .map(|r| r.magnitude().to_f64())
        .fold(0.0, f64::max);
    rounded_up(largest)
}

/// Two digits, not below `x`.
fn rounded_up(x: f64) -> String {
    let text = format!("{x:.1e}");
    match (text.parse::<f64>(), text.split_once('e')) {
        (Ok(shown), Some((_, exponent))) if shown < x => {
            let step: f64 = format!("1e{exponent}").parse().unwrap_or(0.0);
            format!("{:.1e}", shown + 0.1 * step)
        }
        _ => text,
    }
}

/// A certified number with `places` decimals.
fn decimals(value: &Ball, places: u32) -> String {
    decided(value.to_fixed(places))
}

/// The largest size of some residuals.
fn greatest<'a>(residuals: impl IntoIterator<Item = &'a Ball>, bits: u32) -> Ball {
    let sizes = residuals.into_iter().map(Ball::abs);
    sizes.fold(Ball::integer(bits, 0), |a, b| {
        if (&b - &a).is_positive() { b } else { a }
    })
}

/// A finding about a formula.
fn draft(id: &'static str, place: &'static str) -> Draft {
    Draft::new(id, Subject::Formula, place)
}

/// Whether every outcome, of which there has to be one, is the one beside it that is recorded.
fn agree(checks: &[(Outcome, Outcome)]) -> bool {
    !checks.is_empty() && checks.iter().all(|(a, b)| a == b)
}

/// Everything found about the paper's formulas, in the order of the paper.
pub fn findings() -> Vec<Finding> {
    let mut all = vec![
        motion::equation_of_motion(motion::PRINTED_1),
        motion::kloss(&motion::PRINTED_2),
    ];
    let sample = sample::Sample::new();
    match &sample {
        Ok(sample) => all.extend(reduction::findings(&reduction::PRINTED, sample)),
        Err(error) => all.push(undecided("formula-3-7", "(3)-(7)", error)),
    }
    all.extend(spline::findings(&spline::PRINTED));
    all.extend(sweep::findings(&sweep::PRINTED));
    match &sample {
        Ok(sample) => all.extend([
            extreme::finding(&extreme::PRINTED, sample),
            rates::velocities(rates::VELOCITIES, sample),
            rates::accelerations(rates::ACCELERATIONS, sample),
        ]),
        Err(error) => all.push(undecided(
            "rates",
            "velocity and acceleration systems",
            error,
        )),
    }
    all
}

/// Takes the place of findings that need certified positions when there are none.
fn undecided(id: &'static str, place: &'static str, error: &Undecided) -> Finding {
    let text = format!("The certified positions could not be computed: {error}.");
    draft(id, place)
        .verdict(FindingVerdict::Unexplained)
        .titled("Not checked")
        .text(text)
        .recorded_if(false)
}

/// The formulas with a fault planted change the findings of these names and no others.
#[cfg(test)]
fn found<F: Copy>(
    printed: F,
    findings: impl Fn(&F) -> Vec<Finding>,
    due: &[&str],
    plant: fn(&mut F),
) {
    let mut faulty = printed;
    plant(&mut faulty);
    let all = findings(&faulty);
    let changed = all.iter().filter(|f| !f.as_recorded).map(|f| f.id);
    assert_eq!(changed.collect::<Vec<_>>(), due);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_finding_is_as_recorded() {
        let all = findings();
        for f in &all {
            assert!(f.as_recorded, "{}: {:?}", f.id, f.figures);
            assert!(!f.figures.is_empty() && f.text.len() > 80, "{}", f.id);
            assert!(
                f.figures.iter().all(|x| x.value != "undecided"),
                "{}: {:?}",
                f.id,
                f.figures
            );
        }
        let names: BTreeSet<_> = all.iter().map(|f| f.id).collect();
        assert_eq!((all.len(), names.len()), (19, 19));
    }

    #[test]
    fn bounds_are_not_rounded_down() {
        for (x, text) in [
            (0.0, "0.0e0"),
            (1.23e-40, "1.3e-40"),
            (9.96e5, "1.0e6"),
            (9.93e5, "1.0e6"),
        ] {
            assert_eq!(rounded_up(x), text);
        }
    }

    #[test]
    fn outcomes_do_not_flatter() {
        use crate::reference::Mag;
        let ball = |m: f64, r: i64| Ball::new(rug::Float::with_val(64, m), Mag::power_of_two(r));
        assert_eq!(Outcome::enclosed(&[]), Outcome::Undecided);
        assert_eq!(Outcome::enclosed(&[ball(0.0, -140)]), Outcome::Holds);
        assert_eq!(Outcome::enclosed(&[ball(0.0, -100)]), Outcome::Undecided);
        assert_eq!(
            Outcome::enclosed(&[ball(0.0, -140), ball(1e-30, -140)]),
            Outcome::Fails
        );
        assert_eq!(
            Outcome::enclosed(&[ball(0.0, -100), ball(0.0, -140)]),
            Outcome::Undecided
        );
    }

    /// One check that is not the recorded one is enough, and so is none at all.
    #[test]
    fn a_draft_is_recorded_with_all_its_checks() {
        let (holds, fails) = (Outcome::Holds, Outcome::Fails);
        let recorded = |checks: &[(Outcome, Outcome)]| {
            let draft = draft("", "").verdict(FindingVerdict::Confirmed);
            draft.recorded_if(agree(checks)).as_recorded
        };
        assert!(recorded(&[(holds, holds), (fails, fails)]));
        assert!(!recorded(&[(holds, holds), (fails, holds)]));
        assert!(!recorded(&[(Outcome::Undecided, holds), (holds, holds)]));
        assert!(!recorded(&[]));
        let none = Undecided {
            bits: 1,
            reason: "nothing".into(),
        };
        assert!(!undecided("id", "place", &none).as_recorded);
        assert_eq!([Outcome::of(true), Outcome::of(false)], [holds, fails]);
    }

    #[test]
    fn the_largest_residual_is_bounded_from_above() {
        use crate::reference::Mag;
        let ball = |x: i64, r: f64| Ball::integer(64, x).widened(Mag::from_f64(r));
        assert_eq!(
            largest(&[ball(0, 1e-3), ball(-2, 0.45), ball(1, 0.25)]),
            "2.5e0"
        );
        assert_eq!(largest(&[ball(0, 0.245)]), "2.5e-1");
    }
}
