//! All bars on one line.

use super::super::data::{SIZES, fall, squares};
use super::super::motion::{BITS, DIGITS, Motion};
use super::super::singular::{
    Meeting, accelerations_without_branch, jacobian_rank, meeting, on_circle, parallelogram, poles,
};
use super::shown;
use crate::papers::{Finding, FindingVerdict, Subject, figure, recorded};
use crate::reference::{Ball, Undecided};
use rug::Rational;

pub(super) fn passages(motion: &Motion) -> Result<Finding, Undecided> {
    let mut figures = Vec::new();
    let mut whole = true;
    let quarter = Ball::pi(BITS).shift(-1);
    for c in &motion.courses {
        for (name, quarters) in [("first", 1), ("second", 3)] {
            let angle = &quarter * &Ball::integer(BITS, quarters);
            let (text, known) = shown(&c.turning.time(&angle)?, DIGITS);
            whole &= known;
            figures.push(figure(format!("N = {}, {name} passage", c.n), text, "s"));
        }
        // At (k + 1/2) π for k = 0, 1, …: as many as ⌊φ/π + 1/2⌋.
        let count = &c.states[1].angle / &quarter.shift(1) + Ball::exact(BITS, 0.5);
        let floor = count.lower().floor();
        whole &= floor == count.upper().floor();
        figures.push(figure(
            format!("N = {}, passages in 20 s", c.n),
            floor.to_f64(),
            "1",
        ));
    }
    Ok(Finding {
        id: "passages",
        subject: Subject::Claim,
        place: "0 to 20 s",
        title: "The mechanism goes through a singular position twice a turn, 20 to 21 times in 20 s".into(),
        verdict: FindingVerdict::Confirmed,
        text: "With all bars on one line, at φ = 90° and 270°; the times follow from the same integral."
            .into(),
        figures,
        as_recorded: whole,
    })
}

pub(super) fn ranks() -> Finding {
    let mut figures = Vec::new();
    for n in SIZES.map(|n| n as usize) {
        let (regular, singular) = (jacobian_rank(&parallelogram(n)), meeting(n, n + 1).rank);
        let name = |what: &str| {
            format!(
                "N = {n}, rank of the {} x {} Jacobian, {what}",
                2 * n,
                2 * n + 1
            )
        };
        figures.push(figure(name("sin θ = 4/5"), regular, "1"));
        figures.push(figure(name("horizontal"), singular, "1"));
    }
    Finding {
        id: "ranks",
        subject: Subject::Claim,
        place: "specification",
        title: "The constraints lose N ranks in the horizontal position: N + 1 rates are free there".into(),
        verdict: FindingVerdict::Confirmed,
        text: "By elimination in fractions. A window's determinant on the parallelogram branch is -sin θ (ledger, \
               nb-determinant), so no other position of the motion is singular. That the number of degrees of freedom \
               increases from 1 to N + 1 is right of the rates that the Jacobian allows."
            .into(),
        as_recorded: recorded(&figures, &["2", "1", "4", "2", "20", "10", "80", "40"]),
        figures,
    }
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
        // For 40 windows the first, the middle and the last of 42 positions.
        let positions: Vec<usize> = match n {
            0..=10 => (0..=n + 1).collect(),
            _ => vec![0, n / 2, n + 1],
        };
        right &= positions.iter().all(|&s| meeting(n, s) == due) && regular_modes(n) == 2;
        for (what, value) in [
            ("positions with all bars on one line", n + 2),
            ("curves that meet in each", n + 1),
            (
                "curves in all, circles of one degree of freedom",
                (n + 1) * (n + 2) / 2,
            ),
            ("assembly modes for an angle of the first crank", n + 1),
            ("of these with a regular Jacobian", regular_modes(n)),
        ] {
            figures.push(figure(format!("N = {n}, {what}"), value, "1"));
        }
    }
    Finding {
        id: "curves",
        subject: Subject::Claim,
        place: "specification",
        title: "No position has more than one degree of freedom of motion: N + 1 curves meet there".into(),
        verdict: FindingVerdict::Refuted,
        text: "A window closes in three ways and no other (ledger, nb-window): as a parallelogram, or with one crank on the \
               ground and rod and other crank turning as one. In a row that leaves circles: cranks l to r turn alike, \
               those before them point right, those after them left. Circles meet only with all bars on one line. Their \
               N + 1 tangents are independent and span all rates that the Jacobian allows, but a sum of two of them \
               breaks the loops to the second order (ledger, nb-order-2): admissible are N + 1 lines, not a space of \
               N + 1 dimensions. A solver that takes any rate from the kernel leaves the mechanism. Circles with two \
               or more cranks side by side on the ground are singular all along, a rank for every window between them, \
               and are curves all the same."
            .into(),
        figures,
        as_recorded: right,
    }
}

/// Circles of the first crank whose Jacobian has full rank at sin θ = 4/5.
fn regular_modes(n: usize) -> usize {
    let full = |r: &usize| jacobian_rank(&on_circle(n, 0, *r)) == 2 * n;
    (0..=n).filter(full).count()
}

pub(super) fn which_way(motion: &Motion) -> Finding {
    let mut figures = Vec::new();
    let mut right = true;
    for c in &motion.courses {
        let [top, bottom] = squares(c.n);
        let there = Rational::from(&top + &bottom) / 2;
        right &= there > 1;
        let (text, known) = shown(&Ball::rational(BITS, &there).sqrt(), 20);
        right &= known;
        figures.push(figure(
            format!("N = {}, speed of B0 at the passage", c.n),
            text,
            "m/s",
        ));
    }
    Finding {
        id: "which-way",
        subject: Subject::Claim,
        place: "horizontal",
        title: "The benchmark is defined through its singular positions, by the velocity alone".into(),
        verdict: FindingVerdict::Confirmed,
        text: "The N + 1 tangents differ, so of the curves only the parallelograms' has all cranks at one rate, and the \
               cranks arrive with a rate that is not zero: whoever keeps velocities continuous stays on it, and there the \
               motion is analytic. At rest in that position, or with another rate from the kernel, nothing says which \
               curve is taken: a solver may be asked for N + 1 of them and not for one."
            .into(),
        figures,
        as_recorded: right,
    }
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
        let off = off.fold(0.0f64, |m, x| if x.abs() > m.abs() { x } else { m });
        let name = |what: &str| format!("N = {n}, {what}");
        figures.push(figure(name("-θ'' l/g on the branch"), &branch, "1"));
        let outer = match n {
            1 | 2 => alone[0].to_string(),
            _ => format!("{:.12}", alone[0].to_f64()),
        };
        figures.push(figure(
            name("the same by M, G and f at the position, outer crank"),
            outer,
            "1",
        ));
        figures.push(figure(
            name("largest relative difference"),
            format!("{:.4}", off),
            "1",
        ));
    }
    Finding {
        id: "accelerations",
        subject: Subject::Claim,
        place: "horizontal",
        title: "For N > 1 the equations at the singular position itself give other accelerations than the motion has".into(),
        verdict: FindingVerdict::Refuted,
        text: "There the x rows of G vanish, and M q'' + Gᵀ λ = f with G q'' = -G' q' leaves N + 1 cranks that fall as if \
               nothing held them together. Exact fractions: only for N = 1 do they fall alike. What the loops ask for \
               shows to the third order. A code that solves for accelerations exactly there, with the pseudoinverse or by \
               dropping rows, is wrong by the figures below, and right as soon as the step goes past it."
            .into(),
        as_recorded: recorded(&figures, &FALLS),
        figures,
    }
}

pub(super) fn forces() -> Finding {
    let mut figures = Vec::new();
    let mut right = true;
    for n in SIZES {
        let poles = poles(n);
        right &= poles.len() == n as usize;
        right &= (n == 1) == (poles[0] == 0);
        let zero = poles.iter().filter(|p| **p == 0).count();
        right &= zero == (n % 2) as usize;
        let name = |what: &str| format!("N = {n}, {what}");
        figures.push(figure(
            name("limit of sin θ F/(m g), first rod"),
            &poles[0],
            "1",
        ));
        figures.push(figure(name("rods whose force stays finite"), zero, "1"));
    }
    Finding {
        id: "joint-forces",
        subject: Subject::Claim,
        place: "horizontal",
        title: "For N > 1 the forces in the joints have a pole at every passage: there are none to be asked for".into(),
        verdict: FindingVerdict::Recovered,
        text: "To fall alike the cranks have to hold each other along a line that has no lever: the force F in rod k, \
               k = 0 to N - 1, grows as m g (2k + 1 - N)/(4 (4N + 1) sin θ) (ledger, nb-moment to nb-poles). At the \
               position itself multipliers of the x equations are undetermined, N of them. Positions, velocities and \
               accelerations of the motion stay as they are. Reactions printed for N > 1 at or next to a passage tell \
               how near the step came, and nothing of the mechanism."
            .into(),
        figures,
        as_recorded: right,
    }
}
