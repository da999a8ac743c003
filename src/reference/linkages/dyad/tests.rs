//! Tests of `dyad`.

use super::*;

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
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

const BITS: u32 = 320;

/// `(f(φ + h) − f(φ − h)) / 2h` at h = 2^-60, wrong by some 2^-118.
fn slope(f: impl Fn(&Rational) -> Ball, phi: &Rational) -> Ball {
    let h = Rational::from(1) >> 60u32;
    let [before, after] = [Rational::from(phi - &h), Rational::from(phi + &h)].map(|x| f(&x));
    (after - before).shift(59).widened(Mag::power_of_two(-90))
}

/// Crank-rocker, double crank, and double rockers with the crank shorter and longer than the frame;
/// with long couplers and rockers, whose joint is far out beyond either end of the base.
fn four_bars() -> [[Rational; 4]; 8] {
    [
        [q(1, 1), q(4, 1), q(3, 1), q(7, 2)],
        [q(4, 1), q(3, 1), q(7, 2), q(1, 1)],
        [q(2, 1), q(7, 3), q(5, 2), q(11, 4)],
        [q(3, 1), q(1, 1), q(5, 2), q(11, 4)],
        [q(3, 2), q(2, 1), q(5, 2), q(3, 2)],
        [q(4, 1), q(6, 1), q(5, 2), q(1, 1)],
        [q(4, 1), q(5, 2), q(6, 1), q(1, 1)],
        [q(1, 1), q(6, 1), q(5, 2), q(4, 1)],
    ]
}

/// The links have their lengths, the joint is on its side, angles are those of the links, and every
/// derivative is that of the value before it.
#[test]
fn a_four_bar_is_closed_and_moves_as_it_says() {
    let mut seen = 0;
    for l in four_bars() {
        for (k, left) in (-12..=12).flat_map(|k| [(k, true), (k, false)]) {
            let phi = q(2 * k + 1, 5);
            let Ok(m) = four_bar(&l, &phi, left, BITS) else {
                continue;
            };
            seen += 1;
            let (sin, cos) = Ball::rational(BITS, &phi).sin_cos();
            let a = Ball::rational(BITS, &l[0]);
            let end = ComplexBall::new(&a * &cos, &a * &sin);
            let pivot = ComplexBall::new(Ball::rational(BITS, &l[3]), Ball::integer(BITS, 0));
            let [x, y] = m.joint.clone();
            let joint = ComplexBall::new(x, y);
            let links = [&joint - &end, &joint - &pivot];
            for (link, (length, angle)) in
                links.iter().zip([(&l[1], &m.coupler), (&l[2], &m.rocker)])
            {
                assert!(
                    link.norm_sqr()
                        .contains(&Rational::from(length.square_ref()))
                );
                let (sin, cos) = angle[0].sin_cos();
                let length = Ball::rational(BITS, length);
                assert!((&length * &cos).overlaps(&link.re) && (&length * &sin).overlaps(&link.im));
            }
            assert_eq!(m.determinant.is_positive(), left);
            assert!(m.determinant.overlaps(&links[0].cross(&links[1])));
            let transmission = &m.coupler[0] - &m.rocker[0];
            assert!(
                transmission
                    .sin_cos()
                    .1
                    .overlaps(&m.transmission.sin_cos().1)
            );
            assert!(m.transmission.is_positive());
            for n in 0..2 {
                let value = |of: fn(&FourBarBalls) -> &[Ball; 3]| {
                    slope(
                        |x| of(&four_bar(&l, x, left, BITS).unwrap())[n].clone(),
                        &phi,
                    )
                };
                assert!(value(|m| &m.coupler).overlaps(&m.coupler[n + 1]));
                assert!(value(|m| &m.rocker).overlaps(&m.rocker[n + 1]));
            }
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Over several turns of the crank no angle jumps; where the crank is shorter than the frame they
/// start from principal values, and next to the crank's own angle where it is longer.
#[test]
fn angles_of_a_four_bar_are_continuous() {
    for l in four_bars() {
        for left in [true, false] {
            let at = |k: i64| four_bar(&l, &q(k, 16), left, 96).ok();
            for k in -200..200 {
                let (Some(m), Some(next)) = (at(k), at(k + 1)) else {
                    continue;
                };
                let moved = |of: fn(&FourBarBalls) -> &Ball| (of(&next) - of(&m)).to_f64().abs();
                // A rate of at most 24 next to dead positions.
                assert!(
                    moved(|m| &m.coupler[0]) < 1.5 && moved(|m| &m.rocker[0]) < 1.5,
                    "{k}"
                );
                let phi = k as f64 / 16.0;
                let [a, d] = [&l[0], &l[3]].map(Rational::to_f64);
                let span = [d - a * phi.cos(), -a * phi.sin()];
                let theta = match a <= d {
                    true => span[1].atan2(span[0]),
                    false => {
                        let principal = (-span[1]).atan2(-span[0]);
                        let turns = ((phi - principal) / std::f64::consts::TAU).round();
                        principal + turns * std::f64::consts::TAU
                    }
                };
                // Of the base's angle the links are off by less than half a turn, on their side of
                // it.
                for angle in [&m.coupler[0], &m.rocker[0]] {
                    let off = angle.to_f64() - theta;
                    assert!(off.abs() < std::f64::consts::PI, "{k} {off}");
                    assert_eq!(off > 0.0, left == (a <= d), "{k} {off}");
                }
            }
        }
    }
}

#[test]
fn a_slider_crank_is_closed_and_moves_as_it_says() {
    let mut seen = 0;
    for l in [
        [q(1, 1), q(3, 1), q(1, 5)],
        [q(2, 1), q(3, 1), q(-1, 1)],
        [q(3, 1), q(2, 1), q(5, 2)],
    ] {
        for (k, ahead) in (-12..=12).flat_map(|k| [(k, true), (k, false)]) {
            let (delta, phi) = (q(2 * k - 5, 7), q(3 * k + 1, 5));
            let Ok(m) = slider_crank(&l, &delta, &phi, ahead, BITS) else {
                continue;
            };
            seen += 1;
            let (sin, cos) = Ball::rational(BITS, &phi).sin_cos();
            let (sd, cd) = Ball::rational(BITS, &delta).sin_cos();
            let [a, b, e] = [0, 1, 2].map(|n| Ball::rational(BITS, &l[n]));
            // P = x t + e n.
            let x = &m.slider[0];
            let p = ComplexBall::new(x * &cd - &e * &sd, x * &sd + &e * &cd);
            let rod = &p - &ComplexBall::new(&a * &cos, &a * &sin);
            assert!(rod.norm_sqr().contains(&Rational::from(l[1].square_ref())));
            let (sin, cos) = m.rod[0].sin_cos();
            assert!((&b * &cos).overlaps(&rod.re) && (&b * &sin).overlaps(&rod.im));
            // From the guide's direction, or from the opposite one, at most a quarter turn.
            let turned = (m.rod[0].to_f64() - delta.to_f64()) / std::f64::consts::PI;
            let due = if ahead { -0.5..0.5 } else { 0.5..1.5 };
            assert!(due.contains(&turned), "{turned} {ahead}");
            let acute = 0.5 - (turned - if ahead { 0.0 } else { 1.0 }).abs();
            assert!((m.transmission.to_f64() / std::f64::consts::PI - acute).abs() < 1e-12);
            for n in 0..2 {
                let value = |of: fn(&SliderCrankBalls) -> &[Ball; 3]| {
                    slope(
                        |x| of(&slider_crank(&l, &delta, x, ahead, BITS).unwrap())[n].clone(),
                        &phi,
                    )
                };
                assert!(value(|m| &m.slider).overlaps(&m.slider[n + 1]));
                assert!(value(|m| &m.rod).overlaps(&m.rod[n + 1]));
            }
        }
    }
    assert!(seen > 80, "{seen}");
}

/// Lengths that cannot be joined are refused by exact fractions at dead positions and for all crank
/// angles, and by balls elsewhere.
#[test]
fn what_cannot_be_joined_is_refused() {
    use DyadRefusal::{CannotClose, NotPositive, Singular, Unreachable};
    let (dead, small, wide) = (q(0, 1), q(1, 10), q(3, 1));
    for (l, phi, due) in [
        ([1, 2, 3, 6], &dead, Err(CannotClose)),
        ([1, 9, 3, 5], &dead, Err(CannotClose)),
        ([2, 2, 2, 6], &dead, Err(CannotClose)),
        ([2, 3, 1, 6], &dead, Err(CannotClose)),
        ([1, 2, 4, 6], &dead, Ok(())),
        ([2, 7, 3, 6], &dead, Err(Singular)),
        ([2, 1, 5, 6], &dead, Err(Singular)),
        ([4, 1, 2, 5], &dead, Err(Singular)),
        ([2, 8, 3, 6], &dead, Err(Unreachable)),
        ([4, 3, 1, 5], &dead, Err(Unreachable)),
        ([2, 8, 0, 6], &dead, Err(NotPositive)),
        // |AB| is 5.8 at three radians and 1.1 at a tenth.
        ([2, 2, 2, 3], &wide, Err(Unreachable)),
        ([2, 5, 2, 3], &small, Err(Unreachable)),
        ([2, 2, 2, 3], &small, Ok(())),
        ([0, 2, 2, 3], &small, Err(NotPositive)),
        ([2, 0, 2, 3], &small, Err(NotPositive)),
        ([2, 2, 0, 3], &small, Err(NotPositive)),
        ([2, 2, 2, 0], &small, Err(NotPositive)),
    ] {
        let found = four_bar(&l.map(Rational::from), phi, true, 128).map(drop);
        assert_eq!(found, due, "{l:?} {phi}");
    }
    let third = q(1, 3);
    for (l, delta, phi, due) in [
        ([1, 5, 5], &third, &third, Err(Singular)),
        ([1, 5, -6], &third, &third, Err(CannotClose)),
        ([2, 5, 6], &third, &third, Err(Unreachable)),
        ([1, 5, 4], &third, &third, Ok(())),
        // The crank's end is at the height 1.8 and at −1.8; the guide at 3.
        ([2, 2, 3], &dead, &q(11, 10), Ok(())),
        ([2, 2, 3], &dead, &q(-11, 10), Err(Unreachable)),
        ([0, 2, 1], &dead, &q(1, 1), Err(NotPositive)),
        ([2, 0, 1], &dead, &q(1, 1), Err(NotPositive)),
    ] {
        let found = slider_crank(&l.map(Rational::from), delta, phi, true, 128).map(drop);
        assert_eq!(found, due, "{l:?} {delta} {phi}");
    }
}

#[test]
fn signs_turns_and_finiteness() {
    let ball = |x: f64, rad: f64| Ball::exact(128, x).widened(Mag::from_f64(rad));
    assert_eq!(sign(&ball(0.5, 0.25), 128, "x"), Ok(Ordering::Greater));
    assert_eq!(sign(&ball(-0.5, 0.25), 128, "x"), Ok(Ordering::Less));
    for x in [ball(0.5, 0.5), ball(0.0, 0.0), ball(-0.5, 1.0)] {
        assert!(matches!(sign(&x, 128, "x"), Err(DyadRefusal::Undecided(_))));
    }
    let turn = Ball::pi(256).shift(1);
    let x = ball(0.5, 0.0);
    for k in [-3, 0, 1, 7] {
        for (off, told) in [
            (-0.39, true),
            (0.0, true),
            (0.39, true),
            (0.41, false),
            (-0.41, false),
        ] {
            let near = &x + (Ball::integer(256, k) + Ball::exact(256, off)) * &turn;
            match lifted(&x, &near, 128) {
                Ok(found) => {
                    assert!(told, "{k} {off}");
                    let due = &x + Ball::integer(256, k) * &turn;
                    assert!((&found - &due).magnitude() < Mag::from_f64(1e-36));
                    assert!(k != 0 || found.rad().is_zero());
                }
                Err(e) => assert!(!told && matches!(e, DyadRefusal::Undecided(_))),
            }
        }
        // A ball of half-width 0.3 turns about 0.2 off: some of it is farther than 0.4.
        let near = &x + (Ball::integer(256, k) + ball(0.2, 0.3)) * &turn;
        assert!(lifted(&x, &near, 128).is_err());
    }
    let endless = ball(1.0, f64::INFINITY);
    assert!(all_finite([&x, &x], 128).is_ok());
    assert!(all_finite([&x, &endless], 128).is_err());
    assert!(all_finite([&endless, &x], 128).is_err());
}

/// A rod that stands nearly upright on its guide, to either side of it.
#[test]
fn steep_rods() {
    for (k, ahead) in [(97, true), (97, false), (-97, true), (-97, false)] {
        let l = [q(1, 1), q(1, 1), q(k, 100)];
        for delta in [q(0, 1), q(5, 2), q(-7, 1)] {
            let m = slider_crank(&l, &delta, &delta, ahead, 128).unwrap();
            let tilt = (k as f64 / 100.0).asin();
            let due = match ahead {
                true => delta.to_f64() + tilt,
                false => delta.to_f64() + std::f64::consts::PI - tilt,
            };
            assert!(
                (m.rod[0].to_f64() - due).abs() < 1e-14,
                "{k} {ahead} {delta}"
            );
        }
    }
}

/// Dyads that are nearly stretched, 150° and more at the joint: the turns of both angles are told
/// there too.
#[test]
fn stretched_dyads_keep_their_turns() {
    for l in [[1, 2, 2, 3], [3, 2, 2, 1]] {
        let mut l = l.map(|x| q(x, 1));
        l[1] += q(1, 20);
        for (k, left) in [
            (3, true),
            (3, false),
            (-3, true),
            (-3, false),
            (9, true),
            (-9, false),
        ] {
            let m = four_bar(&l, &q(k, 1), left, 128).unwrap();
            assert!(m.transmission.to_f64() > 2.6, "{}", m.transmission.to_f64());
        }
    }
}

/// With a ball that is wide, at every angle in it.
#[test]
fn values_within_a_ball_are_those_at_every_angle() {
    let step = q(1, 200);
    let mut seen = 0;
    let shapes = four_bars()
        .into_iter()
        .flat_map(|l| [(l.clone(), true), (l, false)]);
    for (l, left) in shapes {
        for k in -30..30 {
            let slide = [0, 1, 3].map(|i| l[i].clone());
            let angle = |j: i64| q(k, 10) + q(j, 4) * &step;
            let wide = Ball::rational(128, &angle(0)).widened(Mag::from_f64(0.005_01));
            if let Ok(m) = four_bar_within(&l, &wide, left) {
                for at in (-4..=4).map(angle) {
                    let n = four_bar(&l, &at, left, 128).unwrap();
                    let pairs = m.coupler.iter().zip(&n.coupler);
                    let mut pairs = pairs.chain(m.rocker.iter().zip(&n.rocker));
                    assert!(pairs.all(|(m, n)| m.contains_ball(n)), "{l:?} {at}");
                    assert!(m.determinant.contains_ball(&n.determinant), "{l:?} {at}");
                    assert!(m.transmission.contains_ball(&n.transmission), "{l:?} {at}");
                    seen += 1;
                }
            }
            if let Ok(m) = slider_crank_within(&slide, &wide, left) {
                for at in (-4..=4).map(angle) {
                    let n = slider_crank(&slide, &q(0, 1), &at, left, 128).unwrap();
                    let pairs = m.slider.iter().zip(&n.slider);
                    let mut pairs = pairs.chain(m.rod.iter().zip(&n.rod));
                    assert!(pairs.all(|(m, n)| m.contains_ball(n)), "{slide:?} {at}");
                    assert!(
                        m.transmission.contains_ball(&n.transmission),
                        "{slide:?} {at}"
                    );
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 4000, "{seen}");
}
