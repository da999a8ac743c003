//! Tests of `dyad`.

use super::*;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

#[test]
fn a_triangle_with_whole_sides() {
    let m = four_bar(&[1, 3, 4, 6].map(Rational::from), &q(0, 1), true, 200).unwrap();
    // A (1, 0), B (6, 0), |AB| = 5, right angle at C (1 + 9/5, 12/5).
    assert!(m.joint[0].contains(&q(14, 5)) && m.joint[1].contains(&q(12, 5)));
    // C' = (0·…): (C−A)·C' = (C−A)·(0, 1) = 12/5, (C−B)·C' = 0:
    // C' = (12/5) (C−A)/9, because the links are normal. φ2' = (C−A) × (C'−A')/9.
    assert!(m.coupler[1].contains(&q(-1, 5)));
    // φ3' = (C−B) × C'/16, C−B = (−16/5, 12/5), C' = (12/25, 16/25).
    assert!(m.rocker[1].contains(&q(-1, 5)));
    let right = Ball::pi(200).shift(-1);
    assert!(m.transmission.overlaps(&right));
    assert!(m.coupler[0].accuracy_bits() > 180);
}

#[test]
fn exact_refusals() {
    let at = |l: [i64; 4], bits| four_bar(&l.map(Rational::from), &q(0, 1), true, bits);
    assert_eq!(at([1, 2, 3, 6], 128).unwrap_err(), DyadRefusal::CannotClose);
    assert_eq!(at([1, 9, 3, 5], 128).unwrap_err(), DyadRefusal::CannotClose);
    assert_eq!(at([2, 7, 3, 6], 128).unwrap_err(), DyadRefusal::Singular);
    assert_eq!(at([2, 8, 3, 6], 128).unwrap_err(), DyadRefusal::Unreachable);
    assert_eq!(at([2, 8, 0, 6], 128).unwrap_err(), DyadRefusal::NotPositive);
    let slide = |e: i64| {
        slider_crank(
            &[1, 5, e].map(Rational::from),
            &q(1, 3),
            &q(1, 3),
            true,
            128,
        )
    };
    assert_eq!(slide(5).unwrap_err(), DyadRefusal::Singular);
    assert_eq!(slide(-6).unwrap_err(), DyadRefusal::CannotClose);
    assert_eq!(
        slider_crank(
            &[2, 5, 6].map(Rational::from),
            &q(1, 3),
            &q(1, 3),
            true,
            128
        )
        .unwrap_err(),
        DyadRefusal::Unreachable
    );
    assert!(slide(4).is_ok());
}

#[test]
fn a_sign_too_close_to_call_stays_undecided() {
    // The crank of the parallelogram is 1e-60 from its change point at φ1 = 0.
    let tiny = Rational::from((1, rug::Integer::from(rug::Integer::u_pow_u(10, 60))));
    let l = [1, 2, 1, 2].map(Rational::from);
    let coarse = four_bar(&l, &tiny, true, 64);
    assert!(
        matches!(coarse, Err(DyadRefusal::Undecided(_))),
        "{coarse:?}"
    );
    assert!(four_bar(&l, &tiny, true, 1024).is_ok());
}

#[test]
fn higher_precision_stays_inside() {
    let l = [q(2, 1), q(7, 3), q(5, 2), q(11, 4)];
    for (left, k) in [(true, -9), (false, 4), (true, 40)] {
        let lo = four_bar(&l, &q(k, 7), left, 80).unwrap();
        let hi = four_bar(&l, &q(k, 7), left, 400).unwrap();
        for i in 0..3 {
            assert!(lo.coupler[i].contains_ball(&hi.coupler[i]));
            assert!(lo.rocker[i].contains_ball(&hi.rocker[i]));
        }
        let l = [q(1, 1), q(3, 1), q(1, 5)];
        let lo = slider_crank(&l, &q(k, 3), &q(k, 7), left, 80).unwrap();
        let hi = slider_crank(&l, &q(k, 3), &q(k, 7), left, 400).unwrap();
        for i in 0..3 {
            assert!(lo.slider[i].contains_ball(&hi.slider[i]));
            assert!(lo.rod[i].contains_ball(&hi.rod[i]));
        }
    }
}
