//! Derivatives that do not see the last digits of the angles.

use super::super::tests::zinchenko;
use super::super::{ClassIii, Geometry, Positions, State};
use super::*;
use crate::units::{Angle, Length};

fn ulps(a: f64, b: f64) -> f64 {
    (a - b).abs() / (b.abs() * f64::EPSILON)
}

/// Three triangles with the sides 3, 4, 5: every direction is rational, A = (1, 0), C = (4, 3), D =
/// (8, 3), B = (4, 6).
fn rational() -> (ClassIii, Positions) {
    let m = Length::from_m;
    let linkage = ClassIii::new(Geometry {
        l1: m(1.0),
        l2: m(45f64.sqrt()),
        l3: m(5.0),
        l4: m(4.0),
        l5: m(5.0),
        lb: m(3.0),
        phi_b: Angle::from_rad(std::f64::consts::FRAC_PI_2),
        x3: m(0.0),
        y3: m(0.0),
        x5: m(11.0),
        y5: m(-1.0),
    })
    .unwrap();
    let positions = Positions {
        phi2: 6f64.atan2(3.0),
        phi3: 3f64.atan2(4.0),
        phi4: 0.0,
        phi5: 4f64.atan2(-3.0),
    };
    (linkage, positions)
}

fn all(s: &State) -> [f64; 8] {
    let (a, b) = (s.rates.first, s.rates.second);
    std::array::from_fn(|i| if i < 4 { a[i] } else { b[i - 4] })
}

#[test]
fn joints_of_rational_triangles() {
    let (linkage, positions) = rational();
    for off in [0.0, 1e-9, -3e-10] {
        let p = Positions::from_array(positions.to_array().map(|x| x + off));
        let s = linkage.state(Angle::from_rad(0.0), p).unwrap();
        let [a, b, c, d] = s.joints();
        assert_eq!(a, [1.0, 0.0]);
        for (got, due) in [(b, [4.0, 6.0]), (c, [4.0, 3.0]), (d, [8.0, 3.0])] {
            for (x, y) in got.into_iter().zip(due) {
                assert!(
                    ulps(x, y) <= 2.0 + (off * 2.0).powi(2) * 1e16,
                    "{off}: {x} for {y}"
                );
            }
        }
    }
}

/// J x = r for the rational position, solved by hand: with `v = φ3' C-turn` and so on, in
/// fractions.
#[test]
fn rates_of_rational_triangles() {
    let (linkage, positions) = rational();
    // A' = (0, 1). C' = w3 (−3, 4), B' − C' = w4 (−3, 0), D' − C' = w4 (0, 4), D' = w5 (−4, −3).
    // Loop 2: −3 w3 = −4 w5, 4 w3 + 4 w4 = −3 w5. Loop 1: −6 w2 = −3 w3 − 3 w4, 1 + 3 w2 = 4 w3.
    // So w5 = 3/4 w3, w4 = −25/16 w3, w2 = (w3 + w4)/2 = −9/32 w3, w3 = 32/155.
    let due = [-9.0 / 155.0, 32.0 / 155.0, -50.0 / 155.0, 24.0 / 155.0];
    for off in [0.0, 1e-9, -1e-9] {
        let p = Positions::from_array(positions.to_array().map(|x| x + off));
        let s = linkage.state(Angle::from_rad(0.0), p).unwrap();
        for (x, y) in s.rates.first.into_iter().zip(due) {
            assert!(ulps(x, y) <= 2.0, "{off}: {x} for {y}");
        }
    }
}

/// Angles off by up to 1e-10 rad give the same rates within their last places, though 1e-9 rad from
/// where two modes meet a rounding of the angles is worth a million times its size.
#[test]
fn rates_do_not_see_roundings_of_the_angles() {
    let linkage = zinchenko();
    for degrees in [14.426, 100.0, 217.2, 217.27] {
        let phi1 = Angle::from_deg(degrees);
        for mode in linkage.assembly_modes(phi1).modes {
            let good = linkage.state(phi1, mode).unwrap();
            for k in 0..4 {
                let mut p = mode.to_array();
                p[k] += 1e-10 / good.condition;
                let s = linkage.state(phi1, Positions::from_array(p)).unwrap();
                for (x, y) in all(&s).into_iter().zip(all(&good)) {
                    assert!(ulps(x, y) <= 8.0, "{degrees} {k}: {x} for {y}");
                }
            }
        }
    }
}

/// Checks that what is no rounding of a position is taken as it is.
#[test]
fn open_loops_stay_open() {
    let linkage = zinchenko();
    let phi1 = Angle::from_rad(0.3);
    let mode = linkage.assembly_modes(phi1).modes[0];
    let moved = Positions {
        phi4: mode.phi4 + 1e-3,
        ..mode
    };
    let s = linkage.state(phi1, moved).unwrap();
    let c = num_complex::Complex64::from_polar(0.64, moved.phi4);
    let [_, _, joint_c, joint_d] = s.joints();
    assert!((joint_d[0] - joint_c[0] - c.re).abs() < 1e-15);
    assert!((joint_d[1] - joint_c[1] - c.im).abs() < 1e-15);
}

#[test]
fn units_are_as_long_as_they_are_short_of_one() {
    for phi in [0.1, 0.7, 2.0, -3.0, 1e-8] {
        let v = super::super::loops::unit(phi);
        let long = v * (1.0 + 1e-12);
        assert!((shortness(long) + 1e-12).abs() < 1e-15, "{phi}");
        assert!(shortness(v).abs() < 2.3e-16, "{phi}");
    }
}
