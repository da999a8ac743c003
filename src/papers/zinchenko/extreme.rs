//! The extreme position printed in the paper.

use super::data;
use crate::papers::number::Number;
use crate::papers::{Draft, Finding, FindingVerdict, Subject, decided, figures};
use crate::reference::class_iii::{Configuration, ExactAngle, Kinematics, Linkage};
use crate::reference::{Ball, ComplexBall};
use rug::{Float, Rational};

/// Working precision: brackets of 10⁻²⁷ degrees leave signs far above rounding.
const BITS: u32 = 160;

/// φ1 = φ2, φ3, φ4, φ5 in degrees, as printed.
pub(super) struct Printed {
    crank: &'static str,
    others: [&'static str; 3],
}

/// As printed.
pub(super) const PRINTED: Printed = Printed {
    crank: "14.426",
    others: ["283.826", "22.558", "-65.721"],
};

/// A number of the paper.
fn number(text: &str) -> Rational {
    data::decimal(text)
}

fn degrees(angle: &Rational) -> Ball {
    ExactAngle::Degrees(angle.clone()).to_ball(BITS)
}

/// The crank angles between which the two dead positions are looked for, in degrees.
const BRACKETS: [(&str, &str); 2] = [("14.42", "14.43"), ("196.01", "196.02")];

/// A dead position: crank and link 2 in one line.
struct Dead {
    /// Crank angle in degrees.
    crank: Ball,
    motion: Kinematics,
    /// True if it is the only one between the ends of the bracket.
    alone: bool,
}

impl Dead {
    /// Returns true if it is stretched, B beyond A, or folded, B on the other side of the crank
    /// pivot, with the rest of the linkage momentarily at rest.
    fn is(&self, stretched: bool) -> bool {
        let at_rest = |rate: &Ball| rate.contains_zero() && rate.rad().to_f64() < 1e-24;
        let rest = self.motion.first[1..].iter().all(at_rest);
        let [a, b, ..] = &self.motion.joints;
        let along = a.r.dot(&b.r);
        let right = match stretched {
            true => along.is_positive(),
            false => along.is_negative(),
        };
        self.alone && rest && right
    }
}

/// `A × B`, which is `l1 l2 sin(φ2 − φ1)`.
fn across(q: &Configuration) -> Ball {
    q.a.cross(&q.b)
}

/// Its derivative by the crank angle.
fn slope(k: &Kinematics) -> Ball {
    let [a, b, ..] = &k.joints;
    a.first.cross(&b.r) + a.r.cross(&b.first)
}

/// An interval of crank angles given in degrees, as a ball of radians.
fn arc(lo: &Rational, hi: &Rational) -> Ball {
    degrees(lo).union(&degrees(hi))
}

/// Encloses the dead position between two crank angles by halving; every position on the way is
/// proved to lie on the branch of row 0. `None` without a proved change of sign.
fn dead(linkage: &Linkage, row0: &Configuration, bracket: (&str, &str)) -> Option<Dead> {
    let (mut lo, mut hi) = (number(bracket.0), number(bracket.1));
    let start = degrees(&number(data::START_DEG));
    let base = linkage.follow(row0, &start, &degrees(&lo))?;
    let at_lo = degrees(&lo);
    let sign = |q: &Rational| {
        let here = linkage.follow(&base, &at_lo, &degrees(q))?;
        let x = across(&here);
        (x.is_positive() || x.is_negative()).then(|| x.is_positive())
    };
    let whole = linkage.follow(&base, &at_lo, &arc(&lo, &hi))?;
    let slope = slope(&linkage.kinematics(&whole).ok()?);
    let alone = slope.is_positive() || slope.is_negative();
    let below = sign(&lo)?;
    if sign(&hi)? == below {
        return None;
    }
    let tiny = number("1e-27");
    while Rational::from(&hi - &lo) > tiny {
        let middle = Rational::from(&lo + &hi) / 2;
        // A short stand-in for the middle keeps the fractions small.
        let middle = Float::with_val(BITS, &middle).to_rational()?;
        if sign(&middle)? == below {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    let there = linkage.follow(&base, &at_lo, &arc(&lo, &hi))?;
    Some(Dead {
        crank: Ball::rational(BITS, &lo).union(&Ball::rational(BITS, &hi)),
        motion: linkage.kinematics(&there).ok()?,
        alone,
    })
}

/// φ2 … φ5 in degrees.
fn angles(dead: &Dead) -> [Ball; 4] {
    let unit = &Ball::integer(BITS, 180) / &Ball::pi(BITS);
    std::array::from_fn(|i| &dead.motion.angles[i] * &unit)
}

/// Returns true if a printed angle is the correct rounding.
fn rounds_to(exact: &Ball, printed: &str) -> bool {
    Number::read(printed).is_rounded(exact)
}

/// The residuals of the two loop equations with the printed angles, in centimetres.
fn closure(printed: &Printed) -> [Ball; 4] {
    let g = data::geometry();
    let ball = |x: &Rational| Ball::rational(BITS, x);
    let point = |r: &Rational, angle: &Ball| ComplexBall::unit(angle).scaled(&ball(r));
    let pivot = |[x, y]: &[Rational; 2]| ComplexBall::new(ball(x), ball(y));
    let [p1, p3, p4, p5] = [
        printed.crank,
        printed.others[0],
        printed.others[1],
        printed.others[2],
    ]
    .map(|text| degrees(&number(text)));
    let c = &pivot(&g.o3) + &point(&g.l3, &p3);
    let b = &c + &point(&g.lb, &(&p4 + &g.phi_b.to_ball(BITS)));
    let first = &point(&Rational::from(&g.l1 + &g.l2), &p1) - &b;
    let second = &(&c + &point(&g.l4, &p4)) - &(&pivot(&g.o5) + &point(&g.l5, &p5));
    [first.re, first.im, second.re, second.im].map(|r| r * Ball::integer(BITS, 100))
}

/// The extreme position.
pub(super) fn finding(printed: &Printed) -> Finding {
    between(BRACKETS, printed)
}

/// With a stretched position in the first bracket and a folded one in the second.
fn between(brackets: [(&str, &str); 2], printed: &Printed) -> Finding {
    let start = data::start(BITS).ok();
    let found = start.map(|(linkage, row0)| brackets.map(|b| dead(&linkage, &row0, b)));
    let shown = |angle: &Ball| decided(angle.to_fixed(20));
    let mut figures = Vec::new();
    let mut recorded = false;
    if let Some([Some(stretched), Some(folded)]) = &found {
        let [phi2, phi3, phi4, phi5] = angles(stretched);
        let phi3 = phi3 + Ball::integer(BITS, 360);
        recorded = stretched.is(true)
            && folded.is(false)
            && rounds_to(&stretched.crank, printed.crank)
            && rounds_to(&phi2, printed.crank)
            && [&phi3, &phi4, &phi5]
                .into_iter()
                .zip(printed.others)
                .all(|(x, p)| rounds_to(x, p));
        figures.extend(figures! {
            "phi_1 = phi_2": "{}", shown(&stretched.crank) => "deg";
            "phi_3": "{}", shown(&phi3) => "deg";
            "phi_4": "{}", shown(&phi4) => "deg";
            "phi_5": "{}", shown(&phi5) => "deg";
            "phi_1 of the second dead position": "{}", shown(&folded.crank) => "deg";
        });
    }
    let gap = closure(printed).map(|g| g.abs());
    let worst = gap.iter().max_by(|a, b| a.upper().total_cmp(&b.upper()));
    let worst = decided(worst.and_then(|g| g.to_fixed(7)));
    figures.extend(figures! {
        "largest closure error with the printed angles": "{}", worst => "cm";
    });
    Draft::new("extreme-position", Subject::Formula, "extreme position")
        .verdict(FindingVerdict::Confirmed)
        .titled("The printed extreme position is right to the last digit")
        .text(
            "Crank and link 2 are in one line at φ_1 = φ_2 = 14.4260375°, where links 3, 4 and 5 are \
             momentarily at rest. The position was bracketed by a proved change of sign of \
             sin(φ_2 − φ_1) and is the only one between 14.42° and 14.43°; all five printed angles \
             are its correct roundings and close both loops to 4·10⁻⁴ cm. Row 0 of the tables \
             starts at the rounded 14.426°, 3.7·10⁻⁵° before it. A second dead position, with link 2 \
             folded back over the crank, lies at 196.0140594°.",
        )
        .figures(figures)
        .only_if(gap.iter().all(|g| g.upper() <= 4e-4))
        .recorded_if(recorded)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start() -> (Linkage, Configuration) {
        data::start(BITS).unwrap()
    }

    #[test]
    fn planted_faults_are_found() {
        let recorded = |crank, others| finding(&Printed { crank, others }).as_recorded;
        for (crank, others, due) in [
            ("14.426", PRINTED.others, true),
            ("14.427", PRINTED.others, false),
            ("14.426", ["283.825", "22.558", "-65.721"], false),
            ("14.426", ["283.826", "22.557", "-65.721"], false),
            // −65.72149…: the tie is close, the other rounding is still told apart.
            ("14.426", ["283.826", "22.558", "-65.722"], false),
        ] {
            assert_eq!(recorded(crank, others), due, "{crank} {others:?}");
        }
        // A stretched position is not folded, nor the other way round.
        for brackets in [
            [BRACKETS[0]; 2],
            [BRACKETS[1]; 2],
            [BRACKETS[1], BRACKETS[0]],
        ] {
            assert!(!between(brackets, &PRINTED).as_recorded);
        }
        // Without a dead position in the bracket there is nothing to compare with.
        assert!(!between([("14.43", "14.44"), BRACKETS[1]], &PRINTED).as_recorded);
    }

    #[test]
    fn the_slope_is_the_limit_of_difference_quotients() {
        let (linkage, row0) = start();
        let from = degrees(&number(data::START_DEG));
        let to = &from + &Ball::integer(BITS, 1).shift(-60);
        let next = linkage.follow(&row0, &from, &to).unwrap();
        let quotient = (across(&next) - across(&row0)).shift(60);
        let due = slope(&linkage.kinematics(&row0).unwrap());
        let off = (&quotient - &due).abs().upper();
        assert!(off < 1e-10 * due.abs().lower(), "{off:e} {due:?}");
    }

    /// Seven decimals known from a separate computation with 50 digits.
    #[test]
    fn the_certified_angles_are_the_known_ones() {
        let f = finding(&PRINTED);
        let known = [
            "14.4260375",
            "283.8257416",
            "22.5575105",
            "-65.7214958",
            "196.0140594",
        ];
        assert_eq!(f.figures.len(), 6);
        for (figure, text) in f.figures.iter().zip(known) {
            let gap = (number(&figure.value) - number(text)).abs();
            assert!(gap <= number("5e-8"), "{}: {}", figure.name, figure.value);
        }
    }

    /// Each condition by itself: the only one, all other links at rest to 10⁻²⁴, and stretched.
    #[test]
    fn a_dead_position_is_at_rest() {
        let (linkage, row0) = start();
        let found = |which: usize| dead(&linkage, &row0, BRACKETS[which]).unwrap();
        assert!(found(0).is(true) && !found(0).is(false));
        assert!(found(1).is(false) && !found(1).is(true));
        let mut one_of_many = found(0);
        one_of_many.alone = false;
        assert!(!one_of_many.is(true));
        let zero =
            |radius: f64| Ball::integer(BITS, 0).widened(crate::reference::Mag::from_f64(radius));
        for k in 1..4 {
            for (rate, due) in [
                (zero(0.9e-24), true),
                (zero(1.1e-24), false),
                (Ball::exact(BITS, 1e-30), false),
            ] {
                let mut d = found(0);
                d.motion.first[k] = rate;
                assert_eq!(d.is(true), due, "{k}");
            }
        }
    }

    /// 4.6e-4° in φ3 move C by 4.8e-4 cm.
    #[test]
    fn angles_that_are_off_do_not_close_the_loops() {
        let worst = |others| {
            let printed = Printed {
                crank: "14.426",
                others,
            };
            let gap = closure(&printed).map(|g| g.abs().to_f64());
            (
                gap.into_iter().fold(0.0, f64::max),
                finding(&printed).as_recorded,
            )
        };
        let (right, recorded) = worst(PRINTED.others);
        assert!(recorded && right < 4e-4, "{right}");
        // Within the rounding of the third decimal all the same.
        let (wrong, recorded) = worst(["283.8262", "22.558", "-65.721"]);
        assert!(!recorded && (4e-4..8e-4).contains(&wrong), "{wrong}");
    }
}
