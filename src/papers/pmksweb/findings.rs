//! The verdicts.

use super::drawing::{BITS, Drawn, FourBar, degrees, nearest_leaves, point, undecided};
use crate::papers::ledger::{Ledger, proved};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figure, figures};
use crate::reference::{Ball, ComplexBall, Undecided};
use rug::Rational;

/// A, B, C, D of issue 91 in cm.
const DRAWING_91: [Drawn; 4] = [
    ["4.1", "3.75"],
    ["1.244", "0.196"],
    ["-2.32", "-2.293"],
    ["0.165", "1.322"],
];
/// A, B, C, G of issue 92, then D, E, F.
const DRAWING_92: [Drawn; 4] = [
    ["-3.74", "-2.41"],
    ["-2.72", "0.91"],
    ["1.58", "0.43"],
    ["7.32", "-3.51"],
];
const DYAD_92: [Drawn; 3] = [["-0.24", "4.01"], ["5.08", "5.31"], ["8.14", "3.35"]];
/// Digits shown.
const DIGITS: usize = 20;

pub(super) fn all(ledger: &Ledger) -> Result<Vec<Finding>, Undecided> {
    let linkage = FourBar::new(DRAWING_91)?;
    Ok(vec![
        equations(ledger),
        range(&linkage)?,
        held_side(&linkage)?,
        nearest(&linkage)?,
        after_the_dead_position(&linkage)?,
        lengths()?,
        tangency(ledger),
    ])
}

fn shown(value: &Ball) -> String {
    crate::papers::shown(value, DIGITS)
}

fn in_degrees(angle: &Ball) -> Ball {
    angle * &Ball::integer(BITS, 180) / Ball::pi(BITS)
}

fn equations(ledger: &Ledger) -> Finding {
    proved(
        ledger,
        ["equations", "ledger"],
        "What the verdicts rest on is proved",
        "Positions by two circles, the side of the line between their centres, a slider next to a \
         tangency.",
    )
}

/// Dead angle of the crank from the frame.
fn dead(linkage: &FourBar) -> Result<Ball, Undecided> {
    linkage.dead()?.ok_or_else(|| undecided("a dead position"))
}

fn range(linkage: &FourBar) -> Result<Finding, Undecided> {
    let [r, l, s, g] = &linkage.lengths;
    let dead = dead(linkage)?;
    let onward = in_degrees(&(&dead - linkage.drawn()));
    let back = in_degrees(&(&dead + linkage.drawn()));
    let short = r + g - l - s;
    let time = &onward / &Ball::integer(BITS, 60);
    Ok(Draft::new("91-range", Subject::Data, "issue 91")
        .verdict(FindingVerdict::Confirmed)
        .titled("The crank of the drawing cannot turn fully: 10 rpm end at a dead position after 2.07 s")
        .text(
            "Coupler and rocker stretched are shorter than crank and frame. Counter-clockwise from the drawing the crank \
             goes as far as the first figure, clockwise as far as the second; there B, C and D lie on one line.",
        )
        .figures(figures! {
            "crank and frame less coupler and rocker": "{}", shown(&short) => "cm";
            "counter-clockwise from the drawing": "{}", shown(&onward) => "deg";
            "clockwise from the drawing": "{}", shown(&back) => "deg";
            "time at 10 rpm, counter-clockwise": "{}", shown(&time) => "s";
        })
        .recorded(&[
            "0.44930643576421968018",
            "124.46617459405821021",
            "163.54396106150932487",
            "2.0744362432343035035",
        ]))
}

/// The largest turn of the coupler over a step of the crank clockwise, in degrees, and where it
/// ends.
fn swiftest(linkage: &FourBar, step: u32) -> Result<(f64, u32), Undecided> {
    let mut turns = Vec::new();
    let mut before: Option<ComplexBall> = None;
    let mut turned = 0;
    while let Some(modes) = linkage.modes(&degrees(&-Rational::from(turned)))? {
        let coupler = &modes.c[0] - &modes.b;
        if let Some(before) = &before {
            let turn = in_degrees(&before.cross(&coupler).atan2(&before.dot(&coupler)));
            turns.push((turn.to_f64().abs(), turned));
        }
        before = Some(coupler);
        turned += step;
    }
    let most = turns.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    Ok(most.unwrap_or_default())
}

fn held_side(linkage: &FourBar) -> Result<Finding, Undecided> {
    let (turn, at) = swiftest(linkage, 1)?;
    let [r, l, s, g] = &linkage.lengths;
    let gap = (r - g).abs() - (l - s).abs();
    Ok(Draft::new("91-held-side", Subject::Claim, "issue 91")
        .verdict(FindingVerdict::Confirmed)
        .titled("Who intersects two circles and holds the side of BD is right between the dead positions")
        .text(
            "PMKS+ (its source of 2024), the Matlab script and the construction in Geogebra do. C is on BD only where coupler and rocker are \
             stretched or folded (ledger, pm-height); they never fold, |BD| keeping above their difference by the figure \
             below, and stretched is where the crank ends. So the side is the branch. That path looks wrong and is not: \
             with B near D the coupler whirls, by the turn below for one degree of the crank.",
        )
        .figures(figures! {
            "least |BD| less the difference of coupler and rocker": "{}", shown(&gap) => "cm";
            "largest turn of the coupler for one degree": "{turn:.6}" => "deg";
            "ending at degrees clockwise from the drawing": "{at}" => "deg";
        })
        .only_if(linkage.never_folds())
        .recorded(&["0.024796788351602587246", "64.707081", "20"]))
}

fn nearest(linkage: &FourBar) -> Result<Finding, Undecided> {
    let mut figures = Vec::new();
    for step in [1u32, 2, 3, 4, 5, 6, 8, 10] {
        let found = nearest_leaves(linkage, &Rational::from(step))?;
        let (after, unit) = match found {
            Some(angle) => (angle.to_string(), "deg"),
            None => ("not at all".into(), "1"),
        };
        let name = format!("steps of {step} deg: leaves the branch after");
        figures.push(figure(name, after, unit));
    }
    Ok(Draft::new("91-nearest", Subject::Claim, "issue 91")
        .verdict(FindingVerdict::Refuted)
        .titled("Who takes the position nearest to the last one loses the branch at steps of 3 degrees and more")
        .text(
            "Clockwise from the drawing, where the coupler whirls; both positions are legal assemblies and nothing in the \
             result shows it. Of SAM and MotionGen the issue has pictures alone, drawn from approximate positions: whether \
             they lost the branch there or went on past a dead position cannot be decided from them. Where they differ \
             from the held side between the dead positions, they are wrong.",
        )
        .figures(figures)
        .recorded(&["not at all", "not at all", "21", "20", "20", "24", "24", "20"]))
}

fn after_the_dead_position(linkage: &FourBar) -> Result<Finding, Undecided> {
    let [r, _, _, g] = &linkage.lengths;
    let dead = dead(linkage)?;
    let (sine, _) = dead.sin_cos();
    let slope = (r * g).shift(1) * &sine;
    let range = in_degrees(&dead.shift(1));
    Ok(Draft::new("91-after", Subject::Claim, "issue 91")
        .verdict(FindingVerdict::Refuted)
        .titled("The path that PMKS+ traces is half of the coupler curve: the other mode belongs to the same circuit")
        .text(
            "At both ends both modes meet, smoothly (ledger, pm-simple; the slope below is not zero): one circuit, in which \
             the crank swings twice. PMKS+ turns the crank back and holds the side, so that everything retraces its way. A \
             linkage that comes to the dead position with its coupler moving goes over to the other mode as the crank turns \
             back. Positions alone do not say which; a crank that is driven at constant speed does neither.",
        )
        .figures(figures! {
            "d|BD|²/dψ at the dead positions": "{}", shown(&slope) => "cm^2";
            "crank's range": "{}", shown(&range) => "deg";
        })
        .recorded(&["24.779718655816873906", "288.01013565556753508"]))
}

fn lengths() -> Result<Finding, Undecided> {
    let linkage = FourBar::new(DRAWING_92)?;
    let [_, b, c, g] = DRAWING_92.map(point);
    let [d, e, f] = DYAD_92.map(point);
    let reach = (&e - &d).norm_sqr().sqrt() + (&f - &e).norm_sqr().sqrt();
    // D in the axes of BC and F in those of GC.
    let on_coupler = (&d - &b).div(&(&c - &b));
    let on_rocker = (&f - &g).div(&(&c - &g));
    let apart = |turned: i32| {
        let modes = linkage.modes(&degrees(&Rational::from(turned)))?;
        let modes = modes.ok_or_else(|| undecided("a position of the four-bar"))?;
        let [c, _] = &modes.c;
        let d = &modes.b + &(&on_coupler * &(c - &modes.b));
        let f = &g + &(&on_rocker * &(c - &g));
        Ok((&f - &d).norm_sqr().sqrt())
    };
    let [drawn, five, six, far] = [apart(0)?, apart(-5)?, apart(-6)?, apart(-78)?];
    Ok(Draft::new("92-lengths", Subject::Claim, "issue 92")
        .verdict(FindingVerdict::Confirmed)
        .titled("Links DE and EF have to change their lengths if the four-bar is solved alone: the report is right")
        .text(
            "Clockwise from the drawing D and F get farther apart than DE and EF reach, within the sixth degree; the \
             four-bar ABCG goes on. The mechanism ends there, with D, E and F on one line. A program that takes ABCG as the \
             only loop (issue 122) goes on and stretches them, to the last figure.",
        )
        .figures(figures! {
            "|DE| + |EF|": "{}", shown(&reach) => "cm";
            "|DF| as drawn": "{}", shown(&drawn) => "cm";
            "|DF| after 5 degrees": "{}", shown(&five) => "cm";
            "|DF| after 6 degrees": "{}", shown(&six) => "cm";
            "|DF| of the four-bar after 78 degrees": "{}", shown(&far) => "cm";
        })
        .recorded(&[
            "9.1104277301002392261",
            "8.4059502734670040397",
            "9.0450366463552082433",
            "9.1463717169433991360",
            "11.086802857478573501",
        ]))
}

fn tangency(ledger: &Ledger) -> Finding {
    let entries = ledger.entries.iter();
    let of: Vec<_> = entries.filter(|e| e.place == "pull request 231").collect();
    let holds = of.iter().filter(|e| e.as_recorded).count();
    Draft::new("231-tangency", Subject::Claim, "pull request 231")
        .verdict(FindingVerdict::Confirmed)
        .titled("A slider does pass through the position in which its two roots meet, if rod and crank fit to the last digit")
        .text(
            "Where the crank pin reaches just as far from the guide as the rod is long, the distance from the foot is 2 sin z \
             times a root that keeps its sign: the smooth motion comes out on the other index, as the pull request says, and \
             a held index turns the slider back. That is a change point. With a rod that is shorter by anything the crank \
             ends at a dead position before it, with a longer one the slider turns back short of the foot (ledger, \
             pm-apart): which of the three it is cannot be decided from rounded coordinates.",
        )
        .figures(figures! {
            "statements of the ledger that hold": "{holds} of {}", of.len() => "1";
        })
        .recorded(&["4 of 4"])
}
