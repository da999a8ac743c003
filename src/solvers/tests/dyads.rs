//! Dyads and the linkages made of them: what the certified lines do not hold.

use crate::dyad::{
    Assembly, CrankRange, DyadError, FourBar, Guide, LinkMotion, PointMotion, RrpDyad, RrrDyad,
    SliderCrank,
};
use crate::units::{Angle, AngularVelocity, Length};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn bar(l: [f64; 4]) -> FourBar {
    let [a, b, c, d] = l.map(Length::from_m);
    FourBar::new(a, b, c, d).expect("a four-bar")
}

fn slide(l: [f64; 3], direction: f64) -> SliderCrank {
    let [a, b, e] = l.map(Length::from_m);
    SliderCrank::new(a, b, e, Angle::from_rad(direction)).expect("a slider-crank")
}

fn sides() -> [Assembly; 2] {
    [Assembly::Positive, Assembly::Negative]
}

#[test]
fn lengths_are_given_back() {
    let b = bar([1.0, 3.0, 4.0, 5.0]);
    let got = [b.crank(), b.coupler(), b.rocker(), b.frame()].map(|l| l.m());
    assert_eq!(got, [1.0, 3.0, 4.0, 5.0]);
    let s = slide([1.0, 3.0, -0.5], 0.7);
    assert_eq!(
        [s.crank(), s.rod(), s.offset()].map(|l| l.m()),
        [1.0, 3.0, -0.5]
    );
    assert_eq!(s.direction().rad(), 0.7);
}

#[test]
fn links_at_the_speed_of_the_crank() {
    let angle = Angle::from_rad(0.3);
    let link = LinkMotion {
        angle,
        first: 0.5,
        second: -2.0,
    };
    let w = AngularVelocity::from_rad_per_s(10.0);
    assert_eq!(link.angular_velocity(w).rad_per_s(), 5.0);
    assert_eq!(link.angular_acceleration_rad_per_s2(w, 4.0), -198.0);
}

/// The joint's derivatives by differences, and the determinant as an area.
#[test]
fn motions_by_differences() {
    for l in [
        [1.0, 4.0, 3.0, 3.5],
        [3.5, 4.0, 3.0, 1.0],
        [1.0, 9.0, 1.9, 8.5],
        [1.0, 1.9, 9.0, 8.5],
    ] {
        // The unit of length changes nothing but the exponent.
        for unit in [1.0, 2f64.powi(60), 2f64.powi(-45)] {
            let b = bar(l.map(|x| x * unit));
            for side in sides() {
                for k in 0..40 {
                    let phi = 0.157 * f64::from(k);
                    let at = |x: f64| b.position(Angle::from_rad(x), side).ok();
                    let h = 1e-5;
                    let (Some(a), Some(m), Some(c)) = (at(phi - h), at(phi), at(phi + h)) else {
                        continue;
                    };
                    if m.transmission.rad().sin() < 0.2 {
                        continue;
                    }
                    let close = |got: f64, due: f64, size: f64| {
                        assert!((got - due).abs() < 1e-5 * size, "{l:?} {phi}: {got} {due}");
                    };
                    for i in 0..2 {
                        let (x, y) = (a.joint, c.joint);
                        let first = (y.position_m[i] - x.position_m[i]) / (2.0 * h);
                        let second = (y.first_m[i] - x.first_m[i]) / (2.0 * h);
                        close(m.joint.first_m[i], first, 10.0 * unit);
                        close(m.joint.second_m[i], second, 1000.0 * unit);
                    }
                    for (x, z, y) in [
                        (a.coupler, m.coupler, c.coupler),
                        (a.rocker, m.rocker, c.rocker),
                    ] {
                        let turn = (y.angle.rad() - x.angle.rad()) / (2.0 * h);
                        close(z.first, turn, 10.0);
                        close(z.second, (y.first - x.first) / (2.0 * h), 1000.0);
                    }
                    let gamma = m.transmission.rad();
                    let area = side.sign() * l[1] * l[2] * gamma.sin() * unit * unit;
                    assert!((m.determinant_m2 / area - 1.0).abs() < 1e-12);
                    let pressure = m.pressure_angle().rad();
                    assert!((pressure - (FRAC_PI_2 - gamma).abs()).abs() < 1e-15);
                    // The same dyad between the moving crank's end and the pivot.
                    let [p, q] = [1.0, -1.0].map(|s| if s > 0.0 { phi.cos() } else { phi.sin() });
                    let r = l[0] * unit;
                    let end = PointMotion {
                        position_m: [r * p, r * q],
                        first_m: [-r * q, r * p],
                        second_m: [-r * p, -r * q],
                    };
                    let dyad = RrrDyad::new(b.coupler(), b.rocker(), side).expect("a dyad");
                    let d = dyad
                        .solve(&end, &PointMotion::fixed([l[3] * unit, 0.0]))
                        .expect("closes");
                    for i in 0..2 {
                        close(d.joint.second_m[i], m.joint.second_m[i], 1e-4 * unit);
                    }
                    assert!((d.determinant_m2 / area - 1.0).abs() < 1e-12);
                    assert_eq!(
                        d.pressure_angle().rad(),
                        (FRAC_PI_2 - d.transmission.rad()).abs()
                    );
                }
            }
        }
    }
}

#[test]
fn points_that_are_no_numbers() {
    let rest = PointMotion::fixed([0.0, 0.0]);
    let there = PointMotion::fixed([2.0, 1.0]);
    let m = Length::from_m;
    let rrr = RrrDyad::new(m(2.0), m(3.0), Assembly::Positive).expect("a dyad");
    let rrp = RrpDyad::new(m(3.0), Assembly::Positive).expect("a dyad");
    let guide = Guide {
        origin_m: [0.0, 1.0],
        direction: Angle::from_rad(0.2),
    };
    assert!(rrr.solve(&rest, &there).is_ok() && rrp.solve(&rest, &guide).is_ok());
    for bad in [f64::NAN, f64::INFINITY] {
        for k in 0..6 {
            let mut p = there;
            [&mut p.position_m, &mut p.first_m, &mut p.second_m][k / 2][k % 2] = bad;
            let refused = |e: Result<(), DyadError>| matches!(e, Err(DyadError::NotFinite { .. }));
            assert!(refused(rrr.solve(&rest, &p).map(|_| ())), "{k}");
            assert!(refused(rrr.solve(&p, &rest).map(|_| ())), "{k}");
            assert!(refused(rrp.solve(&p, &guide).map(|_| ())), "{k}");
        }
    }
}

/// At a change point the crank still turns fully, and the flat positions are dead ones.
#[test]
fn change_points() {
    for l in [
        [2.0, 5.0, 2.0, 5.0],
        [5.0, 2.0, 5.0, 2.0],
        [3.0, 5.0, 4.0, 6.0],
        [1.0, 5.0, 3.0, 3.0],
        [3.0, 5.0, 3.0, 1.0],
        [1.0, 3.0, 5.0, 3.0],
        [3.0, 3.0, 5.0, 1.0],
    ] {
        assert_eq!(bar(l).crank_range(), CrankRange::Full, "{l:?}");
    }
    for side in sides() {
        let d = bar([2.0, 5.0, 2.0, 5.0]).dead_positions(side);
        let flat = d.extended.expect("a flat position");
        assert!(flat.crank.rad().abs() < 1e-15, "{flat:?}");
    }
}

/// The swing is what the rocker's angle covers in a turn; angles lie in (−π, π].
#[test]
fn swings_of_rockers() {
    for l in [
        [1.0, 4.0, 3.0, 3.5],
        [1.0, 3.0, 4.0, 3.5],
        [2.0, 7.0, 9.0, 6.0],
        [1.0, 8.0, 2.5, 8.2],
    ] {
        for side in sides() {
            let b = bar(l);
            let d = b.dead_positions(side);
            let (mut low, mut high) = (f64::MAX, f64::MIN);
            for k in 0..20_000 {
                let phi = Angle::from_rad(TAU * f64::from(k) / 20_000.0);
                let angle = b
                    .position(phi, side)
                    .expect("a full turn")
                    .rocker
                    .angle
                    .rad();
                (low, high) = (low.min(angle), high.max(angle));
            }
            let swing = d.swing().expect("a swing").rad();
            assert!(
                (swing - (high - low)).abs() < 1e-6,
                "{l:?}: {swing} {}",
                high - low
            );
            for p in [d.extended.expect("stretched"), d.folded.expect("folded")] {
                let crank = p.crank.rad();
                assert!(-PI < crank && crank <= PI, "{l:?}: {crank}");
                let m = b.position(p.crank, side).expect("closes");
                assert!(m.rocker.first.abs() < 1e-12, "{l:?}");
                let off = (m.rocker.angle.rad() - p.rocker.rad()).rem_euclid(TAU);
                assert!(off.min(TAU - off) < 1e-12, "{l:?}: {off}");
            }
        }
    }
}

/// Limits of the crank, where lengths nearly cancel: `4ad sin²(φ/2) = (b + c)² − (a − d)²`, of
/// integers without error.
#[test]
fn limits_of_the_crank_between_nearly_equal_sums() {
    let unit = 2f64.powi(-40);
    let one: i128 = 1 << 40;
    for k in 0..60i128 {
        for (a, d) in [
            (2 * one + 12_345 * k, one + 777 * k),
            (one - 99 * k, 2 * one + 13 * k),
        ] {
            // b + c a little more than |a − d|, b and c of the same size.
            let gap = (a - d).abs() + 1 + 1000 * k * k;
            let b = gap / 3 + 5 * k;
            let c = gap - b;
            let l = [a, b, c, d].map(|x| x as f64 * unit);
            let [la, lb, lc, ld] = l.map(Length::from_m);
            let Ok(bar) = FourBar::new(la, lb, lc, ld) else {
                continue;
            };
            let limit = match bar.crank_range() {
                CrankRange::Within { limit } => limit,
                CrankRange::Between { upper, .. } => upper,
                other => panic!("{other:?}"),
            };
            let product = (b + c - a + d) * (b + c + a - d);
            let due = product as f64 / (4.0 * a as f64 * d as f64);
            let got = (0.5 * limit.rad()).sin().powi(2);
            assert!((got / due - 1.0).abs() < 2e-15, "{k}: {got} {due}");
        }
    }
}

#[test]
fn slider_cranks_at_their_limits() {
    // b = a + |e|: the crank does not pass, and stands still at the limit's angle.
    for e in [0.5, -0.5] {
        assert!(!slide([1.0, 1.5, e], 0.0).turns_fully());
        assert!(slide([1.0, 1.75, e], 0.0).turns_fully());
        assert!(!slide([1.0, 1.25, e], 0.0).turns_fully());
        assert_eq!(slide([1.0, 1.5, e], 0.0).crank_limits(), (None, None));
        let (low, high) = slide([1.0, 1.25, e], 0.0).crank_limits();
        // sin ψ = e ± b, where that is possible.
        let due = |n: f64| (n.abs() < 1.0).then(|| n.asin());
        for (got, due) in [(low, due(e - 1.25)), (high, due(e + 1.25))] {
            assert_eq!(got.is_some(), due.is_some(), "{e}");
            if let (Some(got), Some(due)) = (got, due) {
                assert!((got.rad() - due).abs() < 1e-15, "{e}");
            }
        }
    }
    for l in [
        [1.0, 3.0, 0.5],
        [1.0, 3.0, -0.5],
        [1.0, 3.0, 0.0],
        [1.0, 2.0, 0.75],
    ] {
        for direction in [0.0, 1.2] {
            let s = slide(l, direction);
            for side in sides() {
                let (mut low, mut high) = (f64::MAX, f64::MIN);
                for k in 0..20_000 {
                    let phi = Angle::from_rad(TAU * f64::from(k) / 20_000.0);
                    let x = s.position(phi, side).expect("a full turn").slider_m;
                    (low, high) = (low.min(x), high.max(x));
                }
                let stroke = s.stroke().expect("a stroke").m();
                assert!((stroke - (high - low)).abs() < 1e-6, "{l:?}: {stroke}");
                let d = s.dead_centres(side);
                for c in [d.extended, d.folded.expect("folded")] {
                    let psi = c.crank_from_guide.rad();
                    assert!(-PI < psi && psi <= PI, "{l:?}: {psi}");
                    let m = s
                        .position(Angle::from_rad(psi + direction), side)
                        .expect("closes");
                    assert!((m.slider_m - c.slider.m()).abs() < 1e-14, "{l:?}");
                    assert!(m.slider_first_m.abs() < 1e-14, "{l:?}");
                }
            }
        }
    }
}
