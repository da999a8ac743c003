//! Change points, double positions and mechanisms beside them, by closed forms.

use super::super::{Attachment, Body, Drive, ExactRates, Frame, Joint, Mechanism};
use super::*;
use crate::class_iii::tests::q;

const BITS: u32 = 128;

fn at(x: &str, y: &str) -> [Rational; 2] {
    [q(x), q(y)]
}

fn pin(a: Attachment, b: Attachment) -> Joint {
    Joint::Pin { a, b }
}

/// Crank, coupler, rocker and frame of those lengths, with a dyad of two links of one length from
/// the rocker's end to a pivot.
fn four_bar([a, b, c, d]: [&str; 4], dyad: Option<(&str, [Rational; 2])>) -> Linkage {
    let end = Attachment::body;
    let mut joints = vec![
        pin(Attachment::ground(at("0", "0")), end(0, at("0", "0"))),
        pin(end(0, at(a, "0")), end(1, at("0", "0"))),
        pin(Attachment::ground(at(d, "0")), end(2, at("0", "0"))),
        pin(end(1, at(b, "0")), end(2, at(c, "0"))),
    ];
    let mut names = vec!["crank", "coupler", "rocker"];
    if let Some((length, pivot)) = dyad {
        names.extend(["link", "lever"]);
        joints.push(pin(end(2, at(c, "0")), end(3, at("0", "0"))));
        joints.push(pin(Attachment::ground(pivot), end(4, at("0", "0"))));
        joints.push(pin(end(3, at(length, "0")), end(4, at(length, "0"))));
    }
    let bodies = names.into_iter().map(Body::massless).collect();
    let mechanism = Mechanism::new(bodies, joints).expect("a mechanism");
    Linkage::new(&mechanism, &Drive::coordinate(0), BITS).expect("a drive")
}

fn direction(degrees: &str) -> ExactDrive {
    ExactDrive::Direction(Real::unit(&ExactAngle::Degrees(q(degrees))))
}

fn radians(degrees: &str) -> Ball {
    ExactAngle::Degrees(q(degrees)).to_ball(BITS)
}

/// The change point of a double crank at 180°: the coupler at 0°, the rocker at 180°, where
/// Krawczyk's test fails.
#[test]
fn a_change_point_is_proved() {
    let linkage = four_bar(["1", "2", "4", "5"], None);
    let drive = radians("180");
    let half = std::f64::consts::PI;
    let guess = [half, 1e-9, half - 1e-9];
    let floats = guess.map(|x| Float::with_val(64, x));
    assert!(linkage.position(&drive, &floats).is_err());
    let found = linkage
        .special(&drive, &direction("180"), &guess)
        .expect("exact");
    assert!(found.position.x[1].is_zero());
    assert!(found.position.x[2].overlaps(&Ball::pi(BITS)));
    let along = |body| found.quarters(body, &at("1", "0"));
    assert_eq!([0, 1, 2].map(along), [Some(2), Some(0), Some(2)]);
    assert_eq!(found.quarters(1, &at("0", "-2")), Some(3));
    assert_eq!(found.quarters(1, &at("1", "1")), None);
    assert!(ExactRates::new(&linkage, &found).is_none());
    let end = found.point(&linkage, &Attachment::body(1, at("2", "0")));
    assert!(end[0].contains(&q("1")) && end[1].is_zero());
    // A guess that is not the position, a drive that is not that of the guess, and lengths that do
    // not close there.
    let wrong = [half, 1e-3, half];
    assert!(linkage.special(&drive, &direction("180"), &wrong).is_err());
    assert!(linkage.special(&drive, &direction("90"), &guess).is_err());
    let open = four_bar(["1", "2", "4", "5.000000001"], None);
    assert!(open.special(&drive, &direction("180"), &guess).is_err());
}

/// The rest of a mechanism at a change point is regular and has other roots.
#[test]
fn a_dyad_on_a_change_point_is_enclosed() {
    let linkage = four_bar(["1", "2", "1", "2"], Some(("2", at("4", "1"))));
    let drive = radians("0");
    // From (3, 0) to (4, 1): 45° less and more than the angle with cosine √2/4.
    let half = (2f64.sqrt() / 4.0).acos();
    let slope = std::f64::consts::FRAC_PI_4;
    let guess = [
        0.0,
        1e-10,
        0.0,
        slope + half,
        slope + std::f64::consts::PI - half,
    ];
    let found = linkage
        .special(&drive, &direction("0"), &guess)
        .expect("exact");
    assert!(found.position.x[..3].iter().all(Ball::is_zero));
    for (x, g) in found.position.x[3..].iter().zip(&guess[3..]) {
        assert!((x.to_f64() - g).abs() < 1e-15 && x.accuracy_bits() > 100);
    }
    let (sine, cosine) = found.position.x[3].sin_cos();
    // |2 e^{iψ} − (1, 1)| = 2.
    assert!((sine + cosine).shift(1).contains(&q("1")));
    assert_eq!(found.quarters(3, &at("1", "0")), None);
}

/// Where crank and coupler are in line the drive by the rocker is singular: a fold, with directions
/// in a field with √3, √15 or √2.
#[test]
fn double_positions_have_roots() {
    // An isosceles triangle of crank and coupler together, frame and rocker, with the crank at 60°.
    let linkage = |drive: Drive| {
        let four = four_bar(["1", "2", "3", "3"], None);
        Linkage::new(four.mechanism(), &drive, BITS).expect("a drive")
    };
    let third = std::f64::consts::FRAC_PI_3;
    let guess = [third, third, 2.0 * third];
    let by_rocker = linkage(Drive::coordinate(2));
    let found = by_rocker.special(&radians("120"), &direction("120"), &guess);
    let found = found.expect("exact");
    for (x, degrees) in found.position.x.iter().zip(["60", "60", "120"]) {
        assert!(x.overlaps(&radians(degrees)));
    }
    let [x, y] = found.point(&by_rocker, &Attachment::body(0, at("1", "0")));
    assert!(x.contains(&q("0.5")) && y.square().contains(&q("0.75")));
}

/// A slotted lever: displacements follow from the directions, and gears from whole turns of their
/// multiples.
#[test]
fn slots_and_gears_are_exact_too() {
    let end = Attachment::body;
    let ground = Attachment::ground;
    let joints = vec![
        pin(ground(at("0", "3")), end(0, at("0", "0"))),
        pin(ground(at("0", "0")), end(1, at("0", "0"))),
        pin(ground(at("9", "0")), end(2, at("0", "0"))),
        Joint::Slot {
            a: end(1, at("0", "0")),
            direction: at("1", "0").map(Real::from),
            b: end(0, at("1", "0")),
        },
        Joint::Gear {
            a: Frame::Body(0),
            b: Frame::Body(2),
            carrier: Frame::Ground,
            ratio: q("-1.5"),
            offset: ExactAngle::Degrees(q("0")),
        },
    ];
    let bodies = ["crank", "lever", "wheel"].map(Body::massless).to_vec();
    let mechanism = Mechanism::new(bodies, joints).expect("a mechanism");
    let linkage = Linkage::new(&mechanism, &Drive::coordinate(0), BITS).expect("a drive");
    let quarter = std::f64::consts::FRAC_PI_2;
    let guess = [quarter, quarter, -1.5 * quarter, 4.0];
    let found = linkage
        .special(&radians("90"), &direction("90"), &guess)
        .expect("exact");
    let along = |body| found.quarters(body, &at("1", "0"));
    assert_eq!([0, 1, 2].map(along), [Some(1), Some(1), None]);
    assert_eq!(found.quarters(2, &at("-1", "1")), Some(0));
    assert!(found.position.x[3].contains(&q("4")) && found.position.x[3].rad().is_zero());
    // A slotted lever at 4 from its pivot, by a crank of 1: s = √(10 + 6 sin φ), ψ' = (1 + 3 sin
    // φ)/s².
    let rates = ExactRates::new(&linkage, &found).expect("regular");
    for (k, due) in [["1", "0"], ["0.25", "0"], ["-1.5", "0"], ["0", "-0.75"]]
        .iter()
        .enumerate()
    {
        let exact = rates.of(k, BITS).into_iter().zip(due);
        assert!(
            exact
                .into_iter()
                .all(|(x, due)| x.contains(&q(due)) && x.rad().is_zero())
        );
    }
    let end = Attachment::body(0, at("1", "0"));
    let [v, a] = rates.point(&linkage, &found, &end).expect("exact");
    for (found, due) in [v, a].iter().zip([["-1", "0"], ["0", "-1"]]) {
        assert!(found.iter().zip(due).all(|(x, due)| x.contains(&q(due))));
    }
    // With the wheel half a turn on its square agrees with the crank's cube as well, but not its
    // angle.
    let turned = [quarter, quarter, -1.5 * quarter + 2.0 * quarter, 4.0];
    let other = linkage
        .special(&radians("90"), &direction("90"), &turned)
        .expect("the rest");
    assert!(other.position.x[2].overlaps(&radians("-135")));
    assert_eq!(other.quarters(2, &at("-1", "1")), None);
}

/// A parallelogram's coupler keeps its direction and its rocker turns, at any angle; a kite's do
/// not.
#[test]
fn a_parallelogram_is_a_family() {
    let linkage = four_bar(["1", "2", "1", "2"], Some(("2", at("4", "1"))));
    let drive = radians("37");
    let guess = [37f64.to_radians(), 0.0, 37f64.to_radians(), 1.569, 2.213];
    let turns = [Some(true), Some(false), Some(true), None, None];
    let found = linkage
        .family(&drive, &direction("37"), &turns, &guess)
        .expect("a family");
    assert!(found.position.x[1].is_zero() && found.position.x[2].overlaps(&drive));
    assert_eq!(
        [0, 1, 2, 3].map(|k| found.rate(k)),
        [Some(1), Some(0), Some(1), None]
    );
    // A point of the coupler moves on a circle.
    let middle = Attachment::body(1, at("1", "0"));
    assert!(found.motion(&linkage, &middle).is_none());
    assert!(
        found
            .motion(&linkage, &Attachment::ground(at("1", "2")))
            .is_some()
    );
    // With the crank upright its direction is in the field: the coupler's middle moves to the left.
    let quarter = std::f64::consts::FRAC_PI_2;
    let upright = [quarter, 0.0, quarter, 1.047, 2.094];
    let found = linkage.family(&radians("90"), &direction("90"), &turns, &upright);
    let [p, v, a] = found
        .expect("a family")
        .motion(&linkage, &middle)
        .expect("exact");
    for (found, due) in [p, v, a].iter().zip([["1", "1"], ["-1", "0"], ["0", "-1"]]) {
        assert!(
            found
                .iter()
                .zip(due)
                .all(|(x, due)| x.contains(&q(due)) && x.rad().is_zero())
        );
    }
    // The crank alone is held where no motion of the others is told, and a kite has none.
    let crank = [Some(true), None, None, None, None];
    let found = linkage.family(&drive, &direction("37"), &crank, &guess);
    let found = found.expect("a crank");
    assert_eq!([0, 1, 2].map(|k| found.rate(k)), [Some(1), None, None]);
    let kite = four_bar(["1", "2", "1.5", "2"], None);
    let found = kite.family(&drive, &direction("37"), &turns[..3], &guess[..3]);
    assert!(found.is_ok_and(|f| f.rate(1).is_none() && f.rate(2).is_none()));
    let wrong = [Some(false), Some(false), Some(true), None, None];
    let found = linkage.family(&drive, &direction("37"), &wrong, &guess);
    assert!(found.is_err());
}
