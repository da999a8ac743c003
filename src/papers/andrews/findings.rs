//! The findings.

use super::data::BITS;
use super::entries::certified;
use super::motion::{DIGITS, Motion, TIMES};
use super::printed::{Printed, QUANTITIES, kind, unit};
use crate::papers::ledger::{Ledger, Verdict, proved};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figure, figures, known, shown};
use crate::reference::{Ball, Mag};

pub(super) fn all(ledger: &Ledger, printed: &[Printed], motion: &Motion) -> Vec<Finding> {
    let values = &motion.values;
    let (start, end): (Vec<&Printed>, Vec<&Printed>) = printed.iter().partition(|p| p.time == "0");
    vec![
        equations(ledger),
        start_values(&start, values),
        reference_solution(&end, values),
        later(&end, values),
        mirrored(&end, values),
        never_stops(motion),
        certified_motion(values),
    ]
}

fn equations(ledger: &Ledger) -> Finding {
    proved(
        ledger,
        ["equations", "M, f, g, G"],
        format!(
            "{} printed equations are proved",
            ledger.count(Verdict::Proved)
        ),
        "The constraints are the loops of the bodies, G their Jacobian, M and f what \
         Lagrange's equations give for the kinetic energy of the seven bodies and the spring. \
         The ledger lists every one.",
    )
}

/// The one whose last digit at t = 0 is wrong.
const LAMBDA_1: usize = 21;

fn start_values(start: &[&Printed], values: &[Vec<Ball>]) -> Finding {
    let right = |p: &&&Printed| p.number.is_rounded(certified(values, p));
    let agree = start.iter().filter(right).count();
    let off: Vec<&&Printed> = start.iter().filter(|p| !right(p)).collect();
    let units = |p: &Printed| p.number.units_off(certified(values, p));
    let figures = off.iter().map(|p| {
        let name = QUANTITIES[p.quantity];
        let name = format!("{name} off by, in units of the last digit");
        figure(name, format!("{:.2}", units(p)), "1")
    });
    Draft::new("start-values", Subject::Data, "t = 0")
        .verdict(FindingVerdict::Confirmed)
        .titled(format!(
            "{agree} of {} consistent values at t = 0 are right to the last digit",
            start.len()
        ))
        .text(
            "The start is the position with Θ = 0 at rest, enclosed from the constraints alone; \
             accelerations and multipliers follow. Of the 30 digits and more that are printed \
             only those of lambda_1 end in a wrong one.",
        )
        .figures(figures)
        .only_if(off.iter().all(|p| p.quantity == LAMBDA_1))
        .recorded(&["-1.79"])
}

/// Least and largest number of digits that are right among some values.
fn span(of: &[&Printed], values: &[Vec<Ball>], which: usize) -> [usize; 2] {
    let counts = || {
        let own = of.iter().filter(|p| kind(p.quantity) == which);
        own.map(|p| p.number.right_digits(certified(values, p)).0)
    };
    [counts().min(), counts().max()].map(Option::unwrap_or_default)
}

/// Digits found to be right, by kind.
const RIGHT: [[usize; 2]; 4] = [[9, 12], [7, 10], [5, 9], [5, 7]];

fn reference_solution(end: &[&Printed], values: &[Vec<Ball>]) -> Finding {
    let spans = [0, 1, 2, 3].map(|which| span(end, values, which));
    let [q, v, w, l] = spans.map(|[a, b]| format!("{a} to {b}"));
    let agree = end
        .iter()
        .filter(|p| p.number.is_within_one(certified(values, p)))
        .count();
    Draft::new("reference-solution", Subject::Tables, "t = 0.03 s")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled(format!(
            "The reference solution is right to {q} of its 16 digits in the angles, to fewer in the rest"
        ))
        .text(format!(
            "Printed with 16 digits from one run of PSIDE at tolerances 1e-14. Of the angles {q} \
             digits are right, of the rates {v}, of the accelerations {w}, of the multipliers {l}; \
             {agree} of {} values lie within a unit of the last digit. Below, all digits before the \
             bar are right and the next one is wrong.",
            end.len(),
        ))
        .figures(end.iter().map(|p| {
            let shown = p.number.marked(certified(values, p));
            figure(QUANTITIES[p.quantity], shown, unit(p.quantity))
        }))
        .recorded_if(agree == 0 && spans == RIGHT)
}

/// Shifts of the seven angles in ps, and what is left of the rates.
const LATER: [&str; 8] = [
    "1.0047", "1.0047", "1.0047", "1.0047", "1.0048", "1.0047", "1.0060", "2.1e-8",
];

/// Returns true if all shifts are the first one, but for a thousandth and two units of the last
/// digit.
fn together(shifts: &[f64], slack: &[f64]) -> bool {
    let [first, ..] = shifts else {
        return false;
    };
    let mut pairs = shifts.iter().zip(slack);
    pairs.all(|(s, unit)| (s - first).abs() <= 1e-3 + 2.0 * unit)
}

/// `(printed − certified)/rate` of the angles.
fn later(end: &[&Printed], values: &[Vec<Ball>]) -> Finding {
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
    let named = of(0).zip(&shifts).map(|(p, s)| {
        let name = format!("(printed - certified)/rate, {}", QUANTITIES[p.quantity]);
        figure(name, format!("{s:.4}"), "ps")
    });
    let left = figures! {
        "largest relative difference that is left in the rates after that time": "{worst:.1e}" => "1";
    };
    Draft::new("later", Subject::Tables, "t = 0.03 s")
        .verdict(FindingVerdict::Recovered)
        .titled(format!("The printed angles are those of a moment {crank:.3} ps later"))
        .text(
            "All seven differ from the certified ones by the same time times their rates, as far as \
             16 digits tell: the run kept to the constraints and is ahead by 3e-11 of the time. \
             That sets the limit of what agreement with this reference can show.",
        )
        .figures(named.chain(left))
        .only_if(fits)
        .recorded(&LATER)
}

fn mirrored(end: &[&Printed], values: &[Vec<Ball>]) -> Finding {
    let printed = |quantity: usize| end.iter().find(|p| p.quantity == quantity);
    let texts = [17, 19].map(|k| printed(k).map_or("", |p| p.number.text.as_str()));
    let differ = texts[0].trim_start_matches('-') != texts[1].trim_start_matches('-');
    let certified = values[TIMES.len()][17].to_decimal(DIGITS);
    Draft::new("mirrored", Subject::Tables, "t = 0.03 s")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("Phi'' and Omega'' are opposite; the print contradicts itself in the last two digits")
        .text(
            "With e = zf and zt = u the chains K5-K4 and K7-K6 between A and P are mirror images, so \
             that Φ = -Ω at all times (ledger, an-mirror). The printed Φ'' and Ω'' differ by 9e-10; \
             both are wrong long before.",
        )
        .figures(figures! {
            "Phi_ddot as printed": "{}", texts[0] => "rad/s^2";
            "Omega_ddot as printed": "{}", texts[1] => "rad/s^2";
            "Phi_ddot = -Omega_ddot, certified": "{}", certified.unwrap_or_default() => "rad/s^2";
        })
        .recorded_if(differ && opposite(values))
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

fn never_stops(motion: &Motion) -> Finding {
    let course = &motion.course;
    let balance = |m: &crate::reference::planar::Moment| m.multipliers.last().cloned();
    let rests: Vec<Ball> = course.moments.iter().filter_map(balance).collect();
    let largest = rests
        .iter()
        .fold(Mag::ZERO, |m, b| m.max(b.magnitude()))
        .to_f64();
    let turns = course.moments.last().map_or(f64::NAN, |m| {
        (&m.drive - &course.start.x[0]).to_f64() / std::f64::consts::TAU
    });
    Draft::new("never-stops", Subject::Claim, "0 to 0.03 s")
        .verdict(FindingVerdict::Confirmed)
        .titled("The crank turns one way all the time, proved; energy gives the time as an integral")
        .text(
            "Torque and spring are conservative, so ½ I(β) β'² = mom (β - β0) - V(β) + V(β0). The \
             right side over β - β0 stays above the bound given, and the mechanism has one position \
             for every β on the way. The moment that is left over in the equations of motion at the \
             three times, which has to vanish, does so within its enclosure.",
        )
        .figures(figures! {
            "turns of the crank in 0.03 s": "{turns:.6}" => "1";
            "lower bound of (mom (β - β0) - V + V0)/(β - β0)": "{:.5}", course.least_force => "N·m";
            "panels": "{}", course.panels => "1";
            "largest moment that can be left over": "{largest:.1e}" => "N·m";
        })
        .recorded_if(turned(&rests, turns, course.least_force))
}

/// Returns true if nothing is left over, and turns and bound are those recorded.
fn turned(rests: &[Ball], turns: f64, least_force: f64) -> bool {
    balanced(rests) && format!("{turns:.6} {least_force:.5}") == "2.526184 0.00116"
}

fn certified_motion(values: &[Vec<Ball>]) -> Finding {
    let mut figures = Vec::new();
    for (time, row) in TIMES.iter().zip(&values[1..]) {
        for (k, value) in row.iter().enumerate() {
            let name = format!("t = {time} s, {}", QUANTITIES[k]);
            figures.push(figure(name, shown(value, DIGITS), unit(k)));
        }
    }
    let whole = known(&figures) && figures_are(values);
    Draft::new("certified-motion", Subject::Tables, "t = 0.01, 0.02, 0.03 s")
        .verdict(FindingVerdict::Recovered)
        .titled(format!("All angles, rates, accelerations and multipliers to {DIGITS} digits"))
        .text(format!(
            "Enclosed at {BITS} bits: positions by a contraction over complex discs of β, the time by \
             Gauss and Legendre's rule with a proved bound, its inverse by an interval Newton step, the \
             rest from the equations at that position. `reference/values/andrews-motion.csv` holds \
             them."
        ))
        .figures(figures)
        .recorded_if(whole)
}

fn figures_are(values: &[Vec<Ball>]) -> bool {
    values.len() == TIMES.len() + 1 && values.iter().all(|v| v.len() == QUANTITIES.len())
}

#[cfg(test)]
mod tests;
