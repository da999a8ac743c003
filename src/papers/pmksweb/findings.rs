//! The verdicts.

use super::drawing::{BITS, Drawn, FourBar, degrees, nearest_leaves, point, undecided};
use crate::papers::ledger::{Ledger, Verdict};
use crate::papers::{Finding, FindingVerdict, Subject, figure, figures, recorded};
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
    value
        .to_decimal(DIGITS)
        .unwrap_or_else(|| "undecided".into())
}

fn in_degrees(angle: &Ball) -> Ball {
    angle * &Ball::integer(BITS, 180) / Ball::pi(BITS)
}

fn equations(ledger: &Ledger) -> Finding {
    Finding {
        id: "equations",
        subject: Subject::Formula,
        place: "ledger",
        title: "What the verdicts rest on is proved".into(),
        verdict: FindingVerdict::Confirmed,
        text: "Positions by two circles, the side of the line between their centres, a slider next to a tangency.".into(),
        figures: vec![figure("entries proved", ledger.count(Verdict::Proved), "1")],
        as_recorded: ledger.as_recorded(),
    }
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
    let figures = vec![
        figure(
            "crank and frame less coupler and rocker",
            shown(&short),
            "cm",
        ),
        figure("counter-clockwise from the drawing", shown(&onward), "deg"),
        figure("clockwise from the drawing", shown(&back), "deg"),
        figure(
            "time at 10 rpm, counter-clockwise",
            shown(&(&onward / &Ball::integer(BITS, 60))),
            "s",
        ),
    ];
    Ok(Finding {
        id: "91-range",
        subject: Subject::Data,
        place: "issue 91",
        title: "The crank of the drawing cannot turn fully: 10 rpm end at a dead position after 2.07 s".into(),
        verdict: FindingVerdict::Confirmed,
        text: "Coupler and rocker stretched are shorter than crank and frame. Counter-clockwise from the drawing the crank \
               goes as far as the first figure, clockwise as far as the second; there B, C and D lie on one line."
            .into(),
        as_recorded: recorded(
            &figures,
            &[
                "0.44930643576421968018",
                "124.46617459405821021",
                "163.54396106150932487",
                "2.0744362432343035035",
            ],
        ),
        figures,
    })
}

/// The largest turn of the coupler over a step of the crank clockwise, in degrees, and where it ends.
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
    let figures = vec![
        figure(
            "least |BD| less the difference of coupler and rocker",
            shown(&gap),
            "cm",
        ),
        figure(
            "largest turn of the coupler for one degree",
            format!("{turn:.6}"),
            "deg",
        ),
        figure("ending at degrees clockwise from the drawing", at, "deg"),
    ];
    Ok(Finding {
        id: "91-held-side",
        subject: Subject::Claim,
        place: "issue 91",
        title: "Who intersects two circles and holds the side of BD is right between the dead positions".into(),
        verdict: FindingVerdict::Confirmed,
        text: "PMKS+ (its source of 2024), the Matlab script and the construction in Geogebra do. C is on BD only where coupler and rocker are \
               stretched or folded (ledger, pm-height); they never fold, |BD| keeping above their difference by the figure \
               below, and stretched is where the crank ends. So the side is the branch. That path looks wrong and is not: \
               with B near D the coupler whirls, by the turn below for one degree of the crank."
            .into(),
        as_recorded: linkage.never_folds()
            && recorded(&figures, &["0.024796788351602587246", "64.707081", "20"]),
        figures,
    })
}

fn nearest(linkage: &FourBar) -> Result<Finding, Undecided> {
    let mut figures = Vec::new();
    for step in [1u32, 2, 3, 4, 5, 6, 8, 10] {
        let found = nearest_leaves(linkage, &Rational::from(step))?;
        let text = found
            .as_ref()
            .map_or("not at all".into(), Rational::to_string);
        let unit = if found.is_some() { "deg" } else { "1" };
        figures.push(figure(
            format!("steps of {step} deg: leaves the branch after"),
            text,
            unit,
        ));
    }
    Ok(Finding {
        id: "91-nearest",
        subject: Subject::Claim,
        place: "issue 91",
        title: "Who takes the position nearest to the last one loses the branch at steps of 3 degrees and more".into(),
        verdict: FindingVerdict::Refuted,
        text: "Clockwise from the drawing, where the coupler whirls; both positions are legal assemblies and nothing in the \
               result shows it. Of SAM and MotionGen the issue has pictures alone, drawn from approximate positions: whether \
               they lost the branch there or went on past a dead position cannot be decided from them. Where they differ \
               from the held side between the dead positions, they are wrong."
            .into(),
        as_recorded: recorded(
            &figures,
            &["not at all", "not at all", "21", "20", "20", "24", "24", "20"],
        ),
        figures,
    })
}

fn after_the_dead_position(linkage: &FourBar) -> Result<Finding, Undecided> {
    let [r, _, _, g] = &linkage.lengths;
    let dead = dead(linkage)?;
    let (sine, _) = dead.sin_cos();
    let slope = (r * g).shift(1) * &sine;
    let figures = vec![
        figure("d|BD|²/dψ at the dead positions", shown(&slope), "cm^2"),
        figure("crank's range", shown(&in_degrees(&dead.shift(1))), "deg"),
    ];
    Ok(Finding {
        id: "91-after",
        subject: Subject::Claim,
        place: "issue 91",
        title: "The path that PMKS+ traces is half of the coupler curve: the other mode belongs to the same circuit".into(),
        verdict: FindingVerdict::Refuted,
        text: "At both ends both modes meet, smoothly (ledger, pm-simple; the slope below is not zero): one circuit, in which \
               the crank swings twice. PMKS+ turns the crank back and holds the side, so that everything retraces its way. A \
               linkage that comes to the dead position with its coupler moving goes over to the other mode as the crank turns \
               back. Positions alone do not say which; a crank that is driven at constant speed does neither."
            .into(),
        as_recorded: recorded(&figures, &["24.779718655816873906", "288.01013565556753508"]),
        figures,
    })
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
    let figures = vec![
        figure("|DE| + |EF|", shown(&reach), "cm"),
        figure("|DF| as drawn", shown(&drawn), "cm"),
        figure("|DF| after 5 degrees", shown(&five), "cm"),
        figure("|DF| after 6 degrees", shown(&six), "cm"),
        figure("|DF| of the four-bar after 78 degrees", shown(&far), "cm"),
    ];
    Ok(Finding {
        id: "92-lengths",
        subject: Subject::Claim,
        place: "issue 92",
        title: "Links DE and EF have to change their lengths if the four-bar is solved alone: the report is right".into(),
        verdict: FindingVerdict::Confirmed,
        text: "Clockwise from the drawing D and F get farther apart than DE and EF reach, within the sixth degree; the \
               four-bar ABCG goes on. The mechanism ends there, with D, E and F on one line. A program that takes ABCG as the \
               only loop (issue 122) goes on and stretches them, to the last figure."
            .into(),
        as_recorded: recorded(
            &figures,
            &[
                "9.1104277301002392261",
                "8.4059502734670040397",
                "9.0450366463552082433",
                "9.1463717169433991360",
                "11.086802857478573501",
            ],
        ),
        figures,
    })
}

fn tangency(ledger: &Ledger) -> Finding {
    let of = ledger
        .entries
        .iter()
        .filter(|e| e.place == "pull request 231");
    let (holds, all) = of.fold((0, 0), |(n, all), e| {
        (n + usize::from(e.as_recorded), all + 1)
    });
    let figures = figures! {
        "statements of the ledger that hold": "{holds} of {all}" => "1";
    };
    Finding {
        id: "231-tangency",
        subject: Subject::Claim,
        place: "pull request 231",
        title: "A slider does pass through the position in which its two roots meet, if rod and crank fit to the last digit".into(),
        verdict: FindingVerdict::Confirmed,
        text: "Where the crank pin reaches just as far from the guide as the rod is long, the distance from the foot is 2 sin z \
               times a root that keeps its sign: the smooth motion comes out on the other index, as the pull request says, and \
               a held index turns the slider back. That is a change point. With a rod that is shorter by anything the crank \
               ends at a dead position before it, with a longer one the slider turns back short of the foot (ledger, \
               pm-apart): which of the three it is cannot be decided from rounded coordinates."
            .into(),
        as_recorded: recorded(&figures, &["4 of 4"]),
        figures,
    }
}
