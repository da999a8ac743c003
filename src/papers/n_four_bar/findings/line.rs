//! All bars on one line.

use super::super::data::{SIZES, fall, squares};
use super::super::motion::{BITS, DIGITS, Motion};
use super::super::singular::{
    Meeting, accelerations_without_branch, jacobian_rank, meeting, on_circle, parallelogram, poles,
};
use crate::papers::{
    Draft, Finding, FindingVerdict, Subject, decided, figure, figures, known, shown,
};
use crate::reference::{Ball, Undecided};
use rug::Rational;

pub(super) fn passages(motion: &Motion) -> Result<Finding, Undecided> {
    let mut figures = Vec::new();
    let quarter = Ball::pi(BITS).shift(-1);
    for c in &motion.courses {
        for (name, quarters) in [("first", 1), ("second", 3)] {
            let angle = &quarter * &Ball::integer(BITS, quarters);
            let time = shown(&c.turning.time(&angle)?, DIGITS);
            figures.push(figure(format!("N = {}, {name} passage", c.n), time, "s"));
        }
        // At (k + 1/2) π for k = 0, 1, …: as many as ⌊φ/π + 1/2⌋.
        let count = whole_part(&(&c.states[1].angle / &quarter.shift(1) + Ball::exact(BITS, 0.5)));
        let count = decided(count.map(|n| n.to_string()));
        figures.push(figure(format!("N = {}, passages in 20 s", c.n), count, "1"));
    }
    let whole = known(&figures);
    Ok(Draft::new("passages", Subject::Claim, "0 to 20 s")
        .verdict(FindingVerdict::Confirmed)
        .titled("The mechanism goes through a singular position twice a turn, 20 to 21 times in 20 s")
        .text("With all bars on one line, at φ = 90° and 270°; the times follow from the same integral.")
        .figures(figures)
        .recorded_if(whole))
}

/// The integer part, where all of the ball has the same.
fn whole_part(x: &Ball) -> Option<f64> {
    let [low, high] = [x.lower(), x.upper()].map(rug::Float::floor);
    (low == high).then(|| low.to_f64())
}

pub(super) fn ranks() -> Finding {
    let mut figures = Vec::new();
    for n in SIZES.map(|n| n as usize) {
        let (regular, singular) = (jacobian_rank(&parallelogram(n)), meeting(n, n + 1).rank);
        let of = format!("N = {n}, rank of the {} x {} Jacobian", 2 * n, 2 * n + 1);
        figures.extend(figures! {
            "{of}, sin θ = 4/5": "{regular}" => "1";
            "{of}, horizontal": "{singular}" => "1";
        });
    }
    Draft::new("ranks", Subject::Claim, "specification")
        .verdict(FindingVerdict::Confirmed)
        .titled("The constraints lose N ranks in the horizontal position: N + 1 rates are free there")
        .text(
            "By elimination in fractions. A window's determinant on the parallelogram branch is -sin θ (ledger, \
             nb-determinant), so no other position of the motion is singular. That the number of degrees of freedom \
             increases from 1 to N + 1 is right of the rates that the Jacobian allows.",
        )
        .figures(figures)
        .recorded(&["2", "1", "4", "2", "20", "10", "80", "40"])
}

pub(super) fn curves() -> Finding {
    let mut figures = Vec::new();
    let mut right = true;
    for n in SIZES.map(|n| n as usize) {
        let due = Meeting {
            rank: n,
            curves: n + 1,
            tangents: n + 1,
            admissible: true,
        };
        let others = positions(n).into_iter().filter(|&s| meeting(n, s) != due);
        right &= others.count() == 0;
        let regular = regular_modes(n);
        right &= regular == 2;
        figures.extend(figures! {
            "N = {n}, positions with all bars on one line": "{}", n + 2 => "1";
            "N = {n}, curves that meet in each": "{}", n + 1 => "1";
            "N = {n}, curves in all, circles of one degree of freedom": "{}", (n + 1) * (n + 2) / 2 => "1";
            "N = {n}, assembly modes for an angle of the first crank": "{}", n + 1 => "1";
            "N = {n}, of these with a regular Jacobian": "{regular}" => "1";
        });
    }
    Draft::new("curves", Subject::Claim, "specification")
        .verdict(FindingVerdict::Refuted)
        .titled("No position has more than one degree of freedom of motion: N + 1 curves meet there")
        .text(
            "A window closes in three ways and no other (ledger, nb-window): as a parallelogram, or with one crank on the \
             ground and rod and other crank turning as one. In a row that leaves circles: cranks l to r turn alike, \
             those before them point right, those after them left. Circles meet only with all bars on one line. Their \
             N + 1 tangents are independent and span all rates that the Jacobian allows, but a sum of two of them \
             breaks the loops to the second order (ledger, nb-order-2): admissible are N + 1 lines, not a space of \
             N + 1 dimensions. A solver that takes any rate from the kernel leaves the mechanism. Circles with two \
             or more cranks side by side on the ground are singular all along, a rank for every window between them, \
             and are curves all the same.",
        )
        .figures(figures)
        .recorded_if(right)
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

/// By N, at the passage, in m/s: more than at the top.
const SPEEDS: [&str; 4] = [
    "4.9541901457251315315",
    "4.8877397639399747404",
    "4.8220277082895526557",
    "4.8081388039202835762",
];

pub(super) fn which_way(motion: &Motion) -> Finding {
    let mut figures = Vec::new();
    for c in &motion.courses {
        let [top, bottom] = squares(c.n);
        let there = Rational::from(&top + &bottom) / 2;
        let speed = shown(&Ball::rational(BITS, &there).sqrt(), 20);
        let name = format!("N = {}, speed of B0 at the passage", c.n);
        figures.push(figure(name, speed, "m/s"));
    }
    Draft::new("which-way", Subject::Claim, "horizontal")
        .verdict(FindingVerdict::Confirmed)
        .titled("The benchmark is defined through its singular positions, by the velocity alone")
        .text(
            "The N + 1 tangents differ, so of the curves only the parallelograms' has all cranks at one rate, and the \
             cranks arrive with a rate that is not zero: whoever keeps velocities continuous stays on it, and there the \
             motion is analytic. At rest in that position, or with another rate from the kernel, nothing says which \
             curve is taken: a solver may be asked for N + 1 of them and not for one.",
        )
        .figures(figures)
        .recorded(&SPEEDS)
}

/// For each N with and without the branch, and how far apart they are: not at all for N = 1.
const FALLS: [&str; 12] = [
    "6/5",
    "6/5",
    "0.0000",
    "7/6",
    "27/22",
    "-0.0649",
    "93/82",
    "1.222951456311",
    "0.0783",
    "363/322",
    "1.222951453111",
    "0.0848",
];

pub(super) fn accelerations() -> Finding {
    let mut figures = Vec::new();
    for n in SIZES {
        let branch = fall(n);
        let Some(alone) = accelerations_without_branch(n as usize) else {
            continue;
        };
        let off = alone
            .iter()
            .map(|a| (Rational::from(a - &branch) / &branch).to_f64());
        let off = off.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let off = off.unwrap_or_default();
        let outer = match n {
            1 | 2 => alone[0].to_string(),
            _ => format!("{:.12}", alone[0].to_f64()),
        };
        figures.extend(figures! {
            "N = {n}, -θ'' l/g on the branch": "{branch}" => "1";
            "N = {n}, the same by M, G and f at the position, outer crank": "{outer}" => "1";
            "N = {n}, largest relative difference": "{off:.4}" => "1";
        });
    }
    Draft::new("accelerations", Subject::Claim, "horizontal")
        .verdict(FindingVerdict::Refuted)
        .titled("For N > 1 the equations at the singular position itself give other accelerations than the motion has")
        .text(
            "There the x rows of G vanish, and M q'' + Gᵀ λ = f with G q'' = -G' q' leaves N + 1 cranks that fall as if \
             nothing held them together. Exact fractions: only for N = 1 do they fall alike. What the loops ask for \
             shows to the third order. A code that solves for accelerations exactly there, with the pseudoinverse or by \
             dropping rows, is wrong by the figures below, and right as soon as the step goes past it.",
        )
        .figures(figures)
        .recorded(&FALLS)
}

/// By N the limit at the first rod, and how many rods have a finite force: the middle one where
/// there is one.
const POLES: [&str; 8] = ["0", "1", "-1/36", "0", "-9/164", "0", "-39/644", "0"];

pub(super) fn forces() -> Finding {
    let mut figures = Vec::new();
    let mut whole = true;
    for n in SIZES {
        let poles = poles(n);
        whole &= poles.len() == n as usize;
        let zero = poles.iter().filter(|p| **p == 0).count();
        figures.extend(figures! {
            "N = {n}, limit of sin θ F/(m g), first rod": "{}", poles[0] => "1";
            "N = {n}, rods whose force stays finite": "{zero}" => "1";
        });
    }
    Draft::new("joint-forces", Subject::Claim, "horizontal")
        .verdict(FindingVerdict::Recovered)
        .titled("For N > 1 the forces in the joints have a pole at every passage: there are none to be asked for")
        .text(
            "To fall alike the cranks have to hold each other along a line that has no lever: the force F in rod k, \
             k = 0 to N - 1, grows as m g (2k + 1 - N)/(4 (4N + 1) sin θ) (ledger, nb-moment to nb-poles). At the \
             position itself multipliers of the x equations are undetermined, N of them. Positions, velocities and \
             accelerations of the motion stay as they are. Reactions printed for N > 1 at or next to a passage tell \
             how near the step came, and nothing of the mechanism.",
        )
        .figures(figures)
        .only_if(whole)
        .recorded(&POLES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jacobian_is_named_by_its_size() {
        let names: Vec<String> = ranks()
            .figures
            .into_iter()
            .map(|f| f.name.to_string())
            .collect();
        assert_eq!(names[0], "N = 1, rank of the 2 x 3 Jacobian, sin θ = 4/5");
        assert_eq!(names[3], "N = 2, rank of the 4 x 5 Jacobian, horizontal");
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
