//! Inputs that violate what the proofs of this folder rest on.

use super::enclosure::Position;
use super::energy::Forces;
use super::panel::{Loaded, Panel, exact};
use super::tests::{bars, cranked, four_bar, guess};
use super::{Drive, Linkage};
use crate::class_iii::tests::q;
use crate::{Ball, Mag};
use rug::Float;

const BITS: u32 = 160;

pub(super) fn ball(text: &str) -> Ball {
    Ball::rational(BITS, &q(text))
}

/// A driving force on a four-bar with masses.
fn forces() -> Forces {
    Forces {
        drive: q("5"),
        springs: Vec::new(),
        gravity: [q("0"), q("-2")],
    }
}

/// The four-bar's two positions at a crank angle.
pub(super) fn both(linkage: &Linkage, phi: &Ball) -> [Position; 2] {
    [[0.5, 1.6], [-1.1, -1.9]].map(|[a, b]| {
        let start = guess(&[phi.to_f64(), a, b]);
        linkage.position(phi, &start).expect("proved")
    })
}

/// The crank and the rocker cannot be joined at this angle, from whatever guess.
#[test]
fn a_box_without_a_root_is_refused() {
    // A frame of 9 is too long for a crank of 2, a coupler of 7/2 and a rocker of 3 but near φ = 0.
    let far = bars(["2", "3.5", "3", "9"]);
    let linkage = Linkage::new(&far, &Drive::coordinate(0), BITS).unwrap();
    for phi in ["0.9", "2", "3.1"] {
        for start in [[0.5, 1.6], [-1.1, -1.9], [0.0, 3.1], [0.2, 2.5]] {
            let start = guess(&[q(phi).to_f64(), start[0], start[1]]);
            assert!(linkage.position(&ball(phi), &start).is_err(), "{phi}");
        }
    }
}

/// A parallelogram on one line, where two branches meet.
#[test]
fn a_change_point_is_undecided() {
    let linkage = cranked(&bars(["1", "2", "1", "2"]));
    let flat = linkage.position(&ball("0"), &guess(&[0.0, 0.0, 0.0]));
    assert!(flat.is_err(), "{flat:?}");
    // Near it the two are told apart or nothing is said.
    let near = linkage.position(&ball("1e-6"), &guess(&[1e-6, 0.0, 1e-6]));
    if let Ok(near) = near {
        assert!(near.x[1].contains_zero());
    }
    assert!(
        linkage
            .position(&ball("0.1"), &guess(&[0.1, 0.0, 0.1]))
            .is_ok()
    );
}

/// Checks what an enclosure for an uncertain drive holds: every position in it. A radius a tenth as
/// large would miss some.
#[test]
fn radii_are_needed_and_enough() {
    let linkage = cranked(&four_bar());
    let mut most = 0.0f64;
    for start in both(&linkage, &ball("0.9")) {
        let radius = Mag::power_of_two(-20);
        let wide = linkage
            .position(&ball("0.9").widened(radius), &start.midpoints())
            .unwrap();
        for part in [-1.0, -0.5, 0.5, 1.0] {
            let moved = ball("0.9") + Ball::new(radius.to_float() * part, Mag::ZERO);
            let inside = linkage
                .position(&exact(moved.mid()), &start.midpoints())
                .unwrap();
            assert!(wide.holds(&inside));
            for (wide, inside) in wide.x.iter().zip(&inside.x) {
                let way = Float::with_val(64, wide.mid() - inside.mid()).abs();
                most = most.max((way / wide.rad().to_float()).to_f64());
            }
        }
    }
    assert!(most > 0.1, "{most}");
}

/// A disc of drives holds the positions and rates at the real drives in it; no disc reaches beyond
/// a dead position.
#[test]
fn discs_hold_what_lies_in_them_and_end_at_dead_positions() {
    let linkage = cranked(&four_bar());
    for start in both(&linkage, &ball("0.9")) {
        let radius = Mag::from_f64(0.1);
        let disc = linkage.disc(&ball("0.9"), &start, radius).expect("proved");
        let mut used = 0.0f64;
        for part in [-1.0f64, -0.6, 0.3, 1.0] {
            let drive = ball("0.9") + Ball::new(radius.to_float() * part, Mag::ZERO);
            let drive = exact(drive.mid());
            let position = linkage.position(&drive, &start.midpoints()).unwrap();
            assert!(disc.owns(&drive, &position) || part.abs() == 1.0);
            let rates = linkage.rates(&position).unwrap();
            for (k, rate) in rates.iter().enumerate() {
                // The drive's own rate is exact, but for the roundings of the other.
                let wide = &disc.rates[k].0.widened(Mag::power_of_two(-120));
                assert!(wide.contains_ball(rate), "{k} {part}");
                let way = (wide - rate).mid().clone().abs().to_f64();
                used = used.max(way / wide.rad().to_f64());
            }
            let inside = linkage.within(&disc, &drive, &start.midpoints());
            if let Some(inside) = inside {
                assert!(inside.x.iter().zip(&position.x).all(|(a, b)| a.overlaps(b)));
            }
        }
        assert!(used > 0.02, "{used}");
    }
    // The lengths 7/2 and 3 meet the crank's pin until |2 e^{iφ} − 4| = 6 at φ = π; with a frame of
    // 5 they do not.
    let linkage = cranked(&bars(["2", "3.5", "3", "5"]));
    // cos φ = (4 + 25 − 6.5²)/20 at the dead position, φ = 2.295.
    let near = linkage
        .position(&ball("2"), &guess(&[2.0, -0.1, 2.6]))
        .unwrap();
    for radius in [0.3, 0.4, 0.6, 1.0] {
        let disc = linkage.disc(&ball("2"), &near, Mag::from_f64(radius));
        assert!(disc.is_none());
    }
    // Next to it positions move away faster than the rates say: a disc that is proved holds them
    // all the same.
    let close = ["2.1", "2.2", "2.26"].iter().fold(near, |at, phi| {
        linkage
            .position(&ball(phi), &at.midpoints())
            .expect("proved")
    });
    let (left, mut proved) = ((-0.6625f64).acos() - 2.26, 0);
    for k in 1..26 {
        let radius = 0.05 * f64::from(k) * left;
        let Some(disc) = linkage.disc(&ball("2.26"), &close, Mag::from_f64(radius)) else {
            continue;
        };
        proved += 1;
        for part in [-0.999, 0.999] {
            let drive = ball("2.26") + Ball::exact(BITS, radius * part);
            let there = linkage
                .position(&drive, &close.midpoints())
                .expect("a position");
            assert!(disc.owns(&drive, &there), "{k} {part}");
        }
    }
    assert!(proved > 2, "{proved}");
}

/// A point outside the polydisc is no start for its bound: the position found there is another one.
#[test]
fn another_branch_is_not_the_disc_s() {
    let linkage = cranked(&four_bar());
    let [one, other] = both(&linkage, &ball("0.9"));
    let disc = linkage
        .disc(&ball("0.9"), &one, Mag::from_f64(0.05))
        .unwrap();
    assert!(disc.owns(&ball("0.9"), &one) && !disc.owns(&ball("0.9"), &other));
    assert!(
        linkage
            .within(&disc, &ball("0.9"), &other.midpoints())
            .is_none()
    );
    assert!(
        linkage
            .within(&disc, &ball("0.9"), &one.midpoints())
            .is_some()
    );
    // Nor is what reaches out of the polydisc, or a ball of drives that reaches out of the disc.
    let out = |x: &[Ball]| Position {
        x: (x.iter().zip(&disc.r))
            .map(|(x, r)| x.widened(r.shift(1)))
            .collect(),
    };
    assert!(!disc.owns(&ball("0.9"), &out(&one.x)));
    let wide = ball("0.9").widened(Mag::from_f64(0.06));
    assert!(!disc.owns(&wide, &one));
    assert!(linkage.within(&disc, &wide, &one.midpoints()).is_none());
    assert!(
        !one.holds(&other)
            && one.holds(&one)
            && out(&one.x).holds(&one)
            && !one.holds(&out(&one.x))
    );
    let partly = Position {
        x: [&one.x[..1], &other.x[1..]].concat(),
    };
    assert!(!one.holds(&partly));
    // Nor is a drive outside the disc, though the position there lies in the polydisc.
    let drive = ball("0.951");
    let beyond = linkage.position(&drive, &one.midpoints()).unwrap();
    assert!(!disc.owns(&drive, &beyond));
    assert!(linkage.within(&disc, &drive, &beyond.midpoints()).is_none());
}

/// The bound by the disc's contraction holds the position for every drive of a ball, and is of its
/// size.
#[test]
fn the_contraction_s_bound_is_needed() {
    let linkage = cranked(&four_bar());
    let [one, _] = both(&linkage, &ball("0.9"));
    let disc = linkage
        .disc(&ball("0.9"), &one, Mag::from_f64(0.05))
        .unwrap();
    let radius = Mag::power_of_two(-30);
    let wide = linkage
        .within(&disc, &ball("0.92").widened(radius), &one.midpoints())
        .unwrap();
    let mut most = 0.0f64;
    for part in [-1.0, 1.0] {
        let moved = ball("0.92") + Ball::new(radius.to_float() * part, Mag::ZERO);
        let inside = linkage
            .position(&exact(moved.mid()), &one.midpoints())
            .unwrap();
        assert!(wide.holds(&inside));
        let pairs = wide.x.iter().zip(&inside.x);
        let share = pairs.map(|(w, x)| {
            (Float::with_val(64, w.mid() - x.mid()).abs() / w.rad().to_float()).to_f64()
        });
        most = most.max(share.fold(0.0, f64::max));
    }
    assert!(most > 0.2, "{most}");
}

fn first_panel<'a>(linkage: &'a Linkage) -> (Loaded<'a>, Panel) {
    let [one, _] = both(linkage, &ball("0.9"));
    let loaded = Loaded::new(linkage, &forces(), &ball("0.9"), one);
    let panel = (0..20)
        .find_map(|k| loaded.first(&super::panel::power_of_four(-k, BITS)))
        .expect("a start");
    (loaded, panel)
}

/// A panel follows the branch of the position at its left end, and no other.
#[test]
fn panels_are_joined_by_the_position_between_them() {
    let linkage = cranked(&four_bar());
    let (loaded, panel) = first_panel(&linkage);
    let from = &panel.from + &exact(&panel.half).shift(1);
    let at = loaded.on(&panel.branch, &from).unwrap();
    let half = Float::with_val(64, &panel.half);
    assert!(loaded.panel(&from, &at, &panel.branch, &half).is_some());
    let start = guess(&[from.to_f64(), -1.1, -1.9]);
    let other = linkage.position(&from, &start).unwrap();
    assert!(loaded.panel(&from, &other, &panel.branch, &half).is_none());
}

/// The bound M of a panel holds all over the disc where it is said to.
#[test]
fn the_bound_of_the_integrand_holds() {
    let linkage = cranked(&four_bar());
    let (loaded, mut panel) = first_panel(&linkage);
    let mut share = 0.0f64;
    let mut from = &panel.from + &exact(&panel.half).shift(1);
    for _ in 0..4 {
        let at = loaded.on(&panel.branch, &from).unwrap();
        let mut half = Float::with_val(64, &panel.half * 3u32);
        panel = loop {
            match loaded.panel(&from, &at, &panel.branch, &half) {
                Some(next) => break next,
                None => half *= 0.75,
            }
        };
        let centre = &panel.from + &exact(&panel.half);
        for part in [-0.999, 0.999] {
            let drive = &centre + &Ball::new(panel.reach.to_float() * part, Mag::ZERO);
            if (&drive - &loaded.start).is_positive() {
                let one = Ball::integer(BITS, 1);
                let slowness = loaded.slowness(&panel.branch, &drive, &one).unwrap();
                let ratio = slowness.magnitude().to_f64() / panel.most.to_f64();
                assert!(ratio <= 1.0, "{ratio}");
                share = share.max(ratio);
            }
        }
        from = &from + &exact(&panel.half).shift(1);
    }
    assert!(share > 0.3, "{share}");
}

/// Checks what Taylor coefficients leave out: I and V at the real ends of the reach, from three
/// coefficients and Cauchy's bound.
#[test]
fn the_tail_is_bounded() {
    // Σ s^n for |s| ≤ 1/2, bounded by 10 on the disc of radius 9/10.
    let series = vec![Ball::integer(64, 1); 3];
    let bound = super::panel::tail(
        &series,
        Mag::from_f64(10.0),
        Mag::from_f64(0.9),
        [1, 0],
        Mag::from_f64(0.5),
    );
    // s + s² + … = 1.
    assert!(
        bound >= Mag::from_f64(1.0) && bound < Mag::from_f64(5.0),
        "{bound:?}"
    );
    let divided = super::panel::tail(
        &series,
        Mag::from_f64(10.0),
        Mag::from_f64(0.9),
        [2, 1],
        Mag::from_f64(0.5),
    );
    // (s² + s³ + …)/s = 1.
    assert!(
        divided >= Mag::from_f64(1.0) && divided < Mag::from_f64(9.0),
        "{divided:?}"
    );
    let outside = super::panel::tail(
        &series,
        Mag::from_f64(10.0),
        Mag::from_f64(0.9),
        [1, 0],
        Mag::from_f64(0.9),
    );
    assert!(!outside.is_finite());
}

/// A part of a panel that reaches beyond where its bound holds has no integral.
#[test]
fn an_integral_stays_in_its_panel() {
    let (linkage, forces) = (cranked(&four_bar()), forces());
    let (loaded, panel) = first_panel(&linkage);
    let from = &panel.from + &exact(&panel.half).shift(1);
    let at = loaded.on(&panel.branch, &from).unwrap();
    let half = Float::with_val(64, &panel.half / 4u32);
    let panel = loaded.panel(&from, &at, &panel.branch, &half).unwrap();
    let path = super::conservative::Path::new(loaded, &forces).unwrap();
    let end = |k: &str| &panel.from + &(exact(&panel.half).shift(1) * ball(k));
    assert!(path.integral(&panel, &end("1")).is_ok());
    assert!(path.integral(&panel, &end("1.1")).is_err());
}

/// The drive at a time that is known within a radius: the Newton step over `b ± 2δ` has to stay
/// inside. Next to the start, where the speed grows like a root, it does not for a wide one.
#[test]
fn the_drive_at_a_time_is_a_newton_step_that_stays_inside() {
    let (linkage, forces) = (cranked(&four_bar()), forces());
    let (loaded, panel) = first_panel(&linkage);
    let from = &panel.from + &exact(&panel.half).shift(1);
    let at = loaded.on(&panel.branch, &from).unwrap();
    let half = (0..20).map(|k| Float::with_val(64, &panel.half) * 3u32 * 0.8f64.powi(k));
    let panel = half
        .into_iter()
        .find_map(|half| loaded.panel(&from, &at, &panel.branch, &half))
        .unwrap();
    let path = super::conservative::Path::new(loaded, &forces).unwrap();
    let middle = &panel.from + &exact(&panel.half);
    let due = path.integral(&panel, &middle).unwrap();
    let (mut narrow, mut refused) = (0, 0);
    for k in 0..40 {
        let radius = due.magnitude().mul(Mag::from_f64(4.0 * 0.8f64.powi(k)));
        match path.invert(&panel, &due.widened(radius), middle.mid()) {
            // The result holds the drive at both ends of the time.
            Ok(drive) => {
                narrow += 1;
                let wide = |b: &rug::Float| path.integral(&panel, &exact(b)).unwrap();
                if (&due - &wide(&drive.lower())).is_positive() {
                    let (low, high) = (wide(&drive.lower()), wide(&drive.upper()));
                    let by = Ball::new(radius.to_float(), Mag::ZERO);
                    assert!(!(&low - &(&due - &by)).is_positive(), "{k}");
                    assert!(!(&high - &(&due + &by)).is_negative(), "{k}");
                }
            }
            Err(e) => refused += i32::from(e.reason.contains("is not proved")),
        }
    }
    assert!(narrow > 3 && refused > 0, "{narrow} {refused}");
}
