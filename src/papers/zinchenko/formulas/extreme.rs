//! The extreme position printed in the paper.

use super::sample::{self, Dimensions, Sample, degrees, number, row_angle, row_zero};
use super::{Outcome, agree, decimals, draft, greatest};
use crate::papers::{Finding, FindingVerdict, figures};
use crate::reference::class_iii::{Configuration, Kinematics, Linkage};
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

/// The crank angles between which the two dead positions are looked for, in degrees.
const BRACKETS: [(&str, &str); 2] = [("14.42", "14.43"), ("196.01", "196.02")];

/// A dead position: crank and link 2 in one line.
struct Dead {
    /// Crank angle in degrees.
    crank: Ball,
    motion: Kinematics,
    /// Whether it is the only one between the ends of the bracket.
    alone: bool,
}

impl Dead {
    /// Whether it is stretched, B beyond A, or folded, B on the other side of the crank pivot, with the rest of the
    /// linkage momentarily at rest.
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
    degrees(lo, BITS).union(&degrees(hi, BITS))
}

/// Encloses the dead position between two crank angles by halving; every position on the way is
/// proved to lie on the branch of row 0. `None` without a proved change of sign.
fn dead(linkage: &Linkage, row0: &Configuration, bracket: (&str, &str)) -> Option<Dead> {
    let (mut lo, mut hi) = (number(bracket.0), number(bracket.1));
    let start = degrees(&row_angle(0), BITS);
    let base = linkage.follow(row0, &start, &degrees(&lo, BITS))?;
    let at_lo = degrees(&lo, BITS);
    let sign = |q: &Rational| {
        let here = linkage.follow(&base, &at_lo, &degrees(q, BITS))?;
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

/// Whether a printed angle is the correct rounding to three decimals.
fn rounds_to(exact: &Ball, printed: &str) -> bool {
    let gap = exact - &Ball::rational(BITS, &number(printed));
    (Ball::rational(BITS, &number("0.0005")) - gap.abs()).is_positive()
}

/// What is left of the two loop equations with the printed angles, in centimetres.
fn closure(printed: &Printed, d: &Dimensions) -> [Ball; 4] {
    let e = |text: &str| degrees(&number(text), sample::BITS);
    let point = |r: &Ball, angle: &Ball| ComplexBall::unit(angle).scaled(r);
    let [p3, p4, p5] = printed.others.map(e);
    let p1 = e(printed.crank);
    let [o3, o5] = d.pivots.clone().map(|[x, y]| ComplexBall::new(x, y));
    let c = &o3 + &point(&d.l3, &p3);
    let b = &c + &point(&d.lb, &(&p4 + &d.phi_b));
    let first = &(&point(&d.l1, &p1) + &point(&d.l2, &p1)) - &b;
    let second = &(&c + &point(&d.l4, &p4)) - &(&o5 + &point(&d.l5, &p5));
    [first.re, first.im, second.re, second.im]
}

/// The extreme position.
pub(super) fn finding(printed: &Printed, sample: &Sample) -> Finding {
    between(BRACKETS, printed, sample)
}

/// With a stretched position in the first bracket and a folded one in the second.
fn between(brackets: [(&str, &str); 2], printed: &Printed, sample: &Sample) -> Finding {
    let linkage = sample::linkage(BITS);
    let found = row_zero(&linkage)
        .ok()
        .map(|row0| brackets.map(|b| dead(&linkage, &row0, b)));
    let mut figures = Vec::new();
    let mut checks = Vec::new();
    for (i, dead) in found.into_iter().flatten().enumerate() {
        let Some(dead) = dead else {
            checks.push((Outcome::Undecided, Outcome::Holds));
            continue;
        };
        checks.push((Outcome::of(dead.is(i == 0)), Outcome::Holds));
        if i == 1 {
            figures.extend(figures! {
                "phi_1 of the second dead position": "{}", decimals(&dead.crank, 20) => "deg";
            });
            continue;
        }
        let [phi2, phi3, phi4, phi5] = angles(&dead);
        let phi3 = phi3 + Ball::integer(BITS, 360);
        let printed_ones = [
            (&dead.crank, printed.crank),
            (&phi2, printed.crank),
            (&phi3, printed.others[0]),
            (&phi4, printed.others[1]),
            (&phi5, printed.others[2]),
        ];
        checks.extend(printed_ones.map(|(exact, text)| {
            let rounded = rounds_to(exact, text);
            (Outcome::of(rounded), Outcome::Holds)
        }));
        figures.extend(figures! {
            "phi_1 = phi_2": "{}", decimals(&dead.crank, 20) => "deg";
            "phi_3": "{}", decimals(&phi3, 20) => "deg";
            "phi_4": "{}", decimals(&phi4, 20) => "deg";
            "phi_5": "{}", decimals(&phi5, 20) => "deg";
        });
    }
    let gap = closure(printed, &sample.dimensions);
    checks.extend(gap.each_ref().map(|g| {
        let close = g.abs().upper() <= 4e-4;
        (Outcome::of(close), Outcome::Holds)
    }));
    let worst = greatest(&gap, sample::BITS);
    figures.extend(figures! {
        "largest closure error with the printed angles": "{}", decimals(&worst, 7) => "cm";
    });
    draft("extreme-position", "extreme position")
        .verdict(FindingVerdict::Confirmed)
        .titled("The printed extreme position is right to the last digit")
        .text(
            "Crank and link 2 are in one line at φ_1 = φ_2 = 14.4260375°, where links 3, 4 and 5 are \
             momentarily at rest. The position was bracketed by a proved change of sign of \
             sin(φ_2 − φ_1) and is the only one between 14.42° and 14.43°; all five printed angles are its correct \
             roundings and close both loops to 4·10⁻⁴ cm. Row 0 of the tables starts at the rounded \
             14.426°, 3.7·10⁻⁵° before it. A second dead position, with link 2 folded back over the \
             crank, lies at 196.0140594°.",
        )
        .figures(figures)
        .recorded_if(agree(&checks))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_faults_are_found() {
        let sample = Sample::new().unwrap();
        let recorded = |crank, others| finding(&Printed { crank, others }, &sample).as_recorded;
        let good = PRINTED.others;
        assert!(recorded("14.426", good));
        assert!(!recorded("14.427", good));
        assert!(!recorded("14.426", ["283.825", "22.558", "-65.721"]));
        assert!(!recorded("14.426", ["283.826", "22.557", "-65.721"]));
        // −65.72149…: the tie is close, the other rounding is still told apart.
        assert!(!recorded("14.426", ["283.826", "22.558", "-65.722"]));
    }

    #[test]
    fn the_slope_is_the_limit_of_difference_quotients() {
        let linkage = sample::linkage(BITS);
        let row0 = row_zero(&linkage).unwrap();
        let from = degrees(&row_angle(0), BITS);
        let to = &from + &Ball::integer(BITS, 1).shift(-60);
        let next = linkage.follow(&row0, &from, &to).unwrap();
        let quotient = (across(&next) - across(&row0)).shift(60);
        let due = slope(&linkage.kinematics(&row0).unwrap());
        let off = (&quotient - &due).abs().upper();
        assert!(off < 1e-10 * due.abs().lower(), "{off:e} {due:?}");
    }

    #[test]
    fn no_dead_position_where_there_is_none() {
        let linkage = sample::linkage(BITS);
        let row0 = row_zero(&linkage).unwrap();
        assert!(dead(&linkage, &row0, ("14.43", "14.44")).is_none());
    }

    #[test]
    fn a_stretched_position_is_not_folded() {
        let sample = Sample::new().unwrap();
        assert!(!between([BRACKETS[0]; 2], &PRINTED, &sample).as_recorded);
    }

    /// Seven decimals known from a separate computation with 50 digits.
    #[test]
    fn the_certified_angles_are_the_known_ones() {
        let sample = Sample::new().unwrap();
        let f = finding(&PRINTED, &sample);
        let due = [
            ("phi_1 = phi_2", "14.4260375"),
            ("phi_3", "283.8257416"),
            ("phi_4", "22.5575105"),
            ("phi_5", "-65.7214958"),
            ("phi_1 of the second dead position", "196.0140594"),
        ];
        for (name, text) in due {
            let figure = f.figures.iter().find(|x| x.name == name).unwrap();
            let gap = (number(&figure.value) - number(text)).abs();
            assert!(gap <= number("5e-8"), "{name}: {}", figure.value);
        }
    }

    /// Each condition by itself: the only one, all other links at rest as far as 10⁻²⁴ tells, and stretched.
    #[test]
    fn a_dead_position_is_at_rest() {
        let linkage = sample::linkage(BITS);
        let row0 = row_zero(&linkage).unwrap();
        let found = || dead(&linkage, &row0, BRACKETS[0]).unwrap();
        assert!(found().is(true) && !found().is(false));
        let folded = dead(&linkage, &row0, BRACKETS[1]).unwrap();
        assert!(folded.is(false) && !folded.is(true));
        let mut one_of_many = found();
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
                let mut d = found();
                d.motion.first[k] = rate;
                assert_eq!(d.is(true), due, "{k}");
            }
        }
    }

    #[test]
    fn half_a_unit_of_the_third_decimal_is_allowed() {
        for (exact, due) in [
            (14.42649, true),
            (14.42551, true),
            (14.42651, false),
            (14.42549, false),
        ] {
            let exact = Ball::exact(BITS, exact);
            assert_eq!(rounds_to(&exact, "14.426"), due, "{exact:?}");
        }
    }

    /// 4.6e-4° in φ3 move C by 4.8e-4 cm.
    #[test]
    fn angles_that_are_off_do_not_close_the_loops() {
        let sample = Sample::new().unwrap();
        let off = |others| {
            let printed = Printed {
                crank: "14.426",
                others,
            };
            let gap = closure(&printed, &sample.dimensions);
            let worst = gap.iter().map(|g| g.abs().to_f64()).fold(0.0, f64::max);
            (worst, finding(&printed, &sample).as_recorded)
        };
        let (right, recorded) = off(PRINTED.others);
        assert!(recorded && right < 4e-4, "{right}");
        // Within the rounding of the third decimal all the same.
        let (wrong, recorded) = off(["283.8262", "22.558", "-65.721"]);
        assert!(!recorded && (4e-4..8e-4).contains(&wrong), "{wrong}");
    }
}
