//! Newton's method on the loop equations: when it stops and when it gives up; bounds of the
//! inverse.

use super::super::tests::zinchenko;
use super::*;
use crate::units::Angle;

/// Below 2⁻⁵⁰, or below 1e-12 and more than half of the correction before.
#[test]
fn when_corrections_settle() {
    let least = 2f64.powi(-50);
    assert!(settled(least, f64::INFINITY) && settled(0.0, f64::INFINITY));
    assert!(!settled(least.next_up(), 1.0));
    assert!(settled(1e-12, 1e-12) && settled(1e-12, 2e-12));
    assert!(!settled(1e-12f64.next_up(), 1e-12) && !settled(1e-12, 2.1e-12));
    assert!(!settled(1.0, 1.0) && !settled(f64::NAN, 1.0));
}

/// A correction beyond ten radians leads anywhere: it is given up, though the next ones may settle.
#[test]
fn leaps_are_given_up() {
    let linkage = zinchenko();
    let (e1, mut leaps) = (unit(0.3), 0);
    for i in 0..40 {
        for j in 0..40 {
            let p = Positions {
                phi2: 1.0,
                phi3: 0.157 * f64::from(i),
                phi4: 0.157 * f64::from(j),
                phi5: 2.5,
            };
            let f = Frame::new(&linkage.l, &p);
            let (r1, r2) = linkage.residual(e1, &f);
            let d = Jacobian::new(&linkage.l, &f)
                .solve(-r1, -r2)
                .expect("regular");
            if d.iter().any(|x| x.abs() > 10.0) {
                assert_eq!(linkage.newton(e1, p), None, "{p:?}");
                leaps += 1;
            }
        }
    }
    assert!(leaps > 20, "{leaps}");
}

/// The bound on the inverse where each of the four angles is the worst, row by row of the inverse.
#[test]
fn bounds_of_each_angle() {
    let l = zinchenko().l;
    let p = zinchenko().assembly_modes(Angle::from_rad(0.3)).modes[2];
    let mut worst = [0; 4];
    for (l2, l5, l3, l4) in [
        (0.1, 0.485, 0.6, 0.64),
        (1.04, 0.05, 0.6, 0.64),
        (1.04, 0.485, 0.1, 0.64),
        (1.04, 0.485, 0.6, 0.1),
        (9.0, 9.0, 0.1, 0.64),
        (9.0, 9.0, 0.6, 0.1),
    ] {
        for lb in [0.05, 0.22, 0.9] {
            let l = Lengths {
                l2,
                l5,
                l3,
                l4,
                lb,
                ..l
            };
            let j = Jacobian::new(&l, &Frame::new(&l, &p));
            let inv = j.m.try_inverse().expect("regular");
            let [x3, x4] = [0, 1].map(|i| inv[(i, 0)].abs() + inv[(i, 1)].abs());
            // Link 2 closes the first loop, link 5 the second.
            let x2 = 1.0 / l2 + l3 / l2 * x3 + lb / l2 * x4;
            let x5 = 1.0 / l5 + l3 / l5 * x3 + l4 / l5 * x4;
            let all = [x2, x3, x4, x5];
            let due = all.into_iter().fold(0.0, f64::max);
            worst[all.iter().position(|x| *x == due).expect("one")] += 1;
            assert!((j.inverse_norm() / due - 1.0).abs() < 1e-14);
        }
    }
    assert!(worst.iter().all(|n| *n > 0), "{worst:?}");
}

/// Links 2, 3 and 5 on one direction: neither rocker moves B along link 2.
#[test]
fn a_singular_position_is_named() {
    let flat = Positions::from_array([0.0; 4]);
    let e = zinchenko().state(Angle::from_rad(0.3), flat).unwrap_err();
    assert_eq!(e, crate::class_iii::SingularPosition { phi1: 0.3 });
    assert!(e.to_string().contains("0.3 rad"), "{e}");
    assert_eq!(
        zinchenko()
            .velocities(Angle::from_rad(0.3), flat)
            .unwrap_err(),
        e
    );
}
