//! Tests of `fourier_series`.

use super::super::cam_law::{Family, Piece};
use super::super::fourier_transform::near_resonance;
use super::*;
use crate::cubic_spline::Spline;

fn r(n: i32, d: i32) -> Rational {
    Rational::from((n, d))
}

/// Moments `∫ s' x^k` of a polynomial law, exactly.
fn moments(law: &Law, count: usize, bits: u32) -> Vec<Ball> {
    let Form::Pieces(pieces) = &law.0 else {
        panic!("a polynomial law");
    };
    assert!(pieces.len() == 1);
    let c = &pieces[0].coefficients;
    let one = |k: usize| {
        let terms = c
            .iter()
            .enumerate()
            .skip(1)
            .map(|(j, c)| Rational::from(c * j as u32) / (j + k) as u32);
        Ball::rational(bits, &terms.sum())
    };
    (0..count).map(one).collect()
}

fn harmonic(lift: &Rational, rise: &Stroke, fall: Option<&Stroke>, n: u32) -> [Ball; 2] {
    let orders = Orders {
        first: n,
        stride: 0,
        count: 1,
    };
    harmonics(lift, rise, fall, orders, 128).remove(0)
}

/// With the phases of a stroke that starts at zero.
fn transform(law: &Law, q: &Rational, bits: u32) -> ComplexBall {
    let ready = Transform::new(law, bits);
    let phase = |x: &&Rational| cis(&-Rational::from(q * *x), bits);
    let phases: Vec<ComplexBall> = ready.corners.iter().map(phase).collect();
    ready.at(q, &phases, bits)
}

/// Zone by zone in the form that holds at resonance.
fn slowly(law: &Law, q: &Rational, bits: u32) -> ComplexBall {
    let Form::Zones(zones) = &law.0 else {
        panic!("an SCCA law");
    };
    let mut sum = ComplexBall::zero(bits);
    for z in zones {
        let moved = cis(&-Rational::from(q * &z.start), bits);
        let amplitude = Ball::rational(bits, &z.amplitude);
        sum = &sum + &(&near_resonance(z, q, bits).scaled(&amplitude) * &moved);
    }
    let iq = Ball::pi(bits) * Ball::rational(bits, q) * law.reached(bits);
    -&sum.scaled(&iq.recip()).turned()
}

fn scca(b: Rational, d: Rational, fraction: Rational) -> Law {
    Law::stretched(&Family::Scca { b, d }, &fraction)
}

#[test]
fn corners_agree_with_the_form_for_resonance() {
    let laws = [
        scca(r(1, 4), r(1, 2), r(1, 3)),
        scca(r(0, 1), r(1, 1), r(1, 2)),
        scca(r(1, 5), r(0, 1), r(9, 10)),
        scca(r(0, 1), r(0, 1), r(2, 5)),
    ];
    for law in &laws {
        for q in [r(1, 7), r(2, 1), r(3, 1), r(31, 3), r(1234567, 10)] {
            let (fast, slow) = (transform(law, &q, 192), slowly(law, &q, 192));
            assert!(fast.overlaps(&slow), "{q}");
            // Relative to the bound 4 max s'/πq.
            let scale = Mag::power_of_two(-150).div(Mag::above(&rug::Float::with_val(53, &q)));
            assert!(fast.radius() < scale && slow.radius() < scale, "{q}");
        }
    }
}

#[test]
fn beside_a_resonance_no_bits_are_lost() {
    // A quarter wave over 1/4 of the stroke: r = 2.
    let law = scca(r(1, 2), r(1, 2), r(1, 2));
    for k in [4, 20, 23, 24, 25, 40, 100] {
        let q = r(2, 1) + (r(1, 1) >> k);
        let (fast, precise) = (transform(&law, &q, 128), slowly(&law, &q, 400));
        assert!(fast.overlaps(&precise), "2^-{k}");
        assert!(fast.radius() < Mag::power_of_two(-90), "2^-{k}");
    }
}

#[test]
fn a_moved_corner_is_noticed() {
    // Planted: one phase is off by 1e-20 turns.
    let law = scca(r(1, 4), r(1, 2), r(1, 3));
    let q = r(7, 3);
    let ready = Transform::new(&law, 128);
    let mut phases: Vec<ComplexBall> = ready
        .corners
        .iter()
        .map(|x| cis(&-Rational::from(&q * *x), 128))
        .collect();
    let due = slowly(&law, &q, 128);
    assert!(ready.at(&q, &phases, 128).overlaps(&due));
    let off = Rational::from((1, 10u64.pow(19))) / 10u32;
    phases[1] = &phases[1] * &cis(&off, 128);
    assert!(!ready.at(&q, &phases, 128).overlaps(&due));
}

#[test]
fn short_strokes_keep_their_digits() {
    let c: Vec<Rational> = [0, 0, 0, 0, 35, -84, 70, -20].map(|c| r(c, 1)).into();
    let rise = Stroke {
        law: Law::polynomial(&c).unwrap(),
        start: r(1, 7),
        turns: r(1, 1000),
    };
    let [a, b] = harmonic(&r(1, 1), &rise, None, 1);
    assert!(a.rad() < Mag::power_of_two(-120) && b.rad() < Mag::power_of_two(-120));
}

#[test]
fn equal_steps_are_single_harmonics() {
    let stroke = |law, start, turns| Stroke { law, start, turns };
    let rise = stroke(scca(r(1, 4), r(1, 2), r(1, 3)), r(1, 7), r(1, 3));
    let c: Vec<Rational> = [0, 0, 0, 10, -15, 6].map(|c| r(c, 1)).into();
    let fall = stroke(Law::polynomial(&c).unwrap(), r(1, 2), r(2, 5));
    let orders = Orders {
        first: 900_000,
        stride: 7,
        count: 8,
    };
    let all = harmonics(&r(3, 2), &rise, Some(&fall), orders, 128);
    for (n, [a, b]) in orders.iter().zip(&all) {
        let [c, d] = harmonic(&r(3, 2), &rise, Some(&fall), n);
        assert!(a.overlaps(&c) && b.overlaps(&d));
        assert!(a.rad() < Mag::power_of_two(-130) && b.rad() < Mag::power_of_two(-130));
    }
}

/// Knots and ordinates of a table.
fn table() -> [[Rational; 5]; 2] {
    let knots = [r(0, 1), r(1, 5), r(1, 2), r(9, 10), r(1, 1)];
    let ordinates = [r(0, 1), r(1, 9), r(2, 3), r(4, 5), r(1, 1)];
    [knots, ordinates]
}

/// A stroke by the spline through a table.
fn by_spline(x: &[Rational], y: &[Rational]) -> Stroke {
    Stroke {
        law: Law::spline(&Spline::clamped(x, y, &r(0, 1), &r(0, 1)).unwrap(), x),
        start: r(1, 11),
        turns: r(2, 7),
    }
}

/// Orders 3, 5 and 7.
const ODD: Orders = Orders {
    first: 3,
    stride: 2,
    count: 3,
};

#[test]
fn conditions_of_a_table_are_its_differences() {
    let [knots, ordinates] = table();
    let values = |stroke: &Stroke| -> Vec<Ball> {
        // The condition of the mean is that of one stroke: its area.
        let area = stroke.law.mean(300) * Ball::rational(300, &stroke.turns);
        let harmonics = harmonics(&r(1, 1), stroke, None, ODD, 300);
        std::iter::once(area)
            .chain(harmonics.into_iter().flatten())
            .collect()
    };
    let base = by_spline(&knots, &ordinates);
    let before = values(&base);
    let mut due = vec![0.0; before.len()];
    for j in 1..4 {
        for of_knot in [true, false] {
            let (mut x, mut y) = (knots.clone(), ordinates.clone());
            let moved = if of_knot { &mut x[j] } else { &mut y[j] };
            *moved *= r(1, 1) + (r(1, 1) >> 60);
            for ((sum, a), b) in due.iter_mut().zip(values(&by_spline(&x, &y))).zip(&before) {
                *sum += (a - b).shift(60).to_f64().abs();
            }
        }
    }
    let (mean, found) = data_conditions(&r(1, 1), &base, ODD, 128);
    let found = std::iter::once(mean).chain(found.into_iter().flatten());
    for (found, due) in found.zip(due) {
        assert!(
            (found.to_f64() / due - 1.0).abs() < 1e-13,
            "{found:?} {due}"
        );
    }
}

#[test]
fn pieces_agree_with_moments() {
    let c: Vec<Rational> = [0, 0, 0, 10, -15, 6].map(|c| r(c, 1)).into();
    let law = Law::polynomial(&c).unwrap();
    for q in [r(1, 100), r(3, 7), r(16, 3)] {
        let direct = transform(&law, &q, 256);
        let radians = Ball::pi(256) * Ball::rational(256, &q);
        let series = by_moments(&moments(&law, 120, 256), &radians, 256);
        assert!(direct.overlaps(&series));
        assert!(direct.re.accuracy_bits() > 150 && series.re.accuracy_bits() > 150);
    }
}

#[test]
fn zones_agree_with_known_transforms() {
    // About the middle of the stroke: π² cos(q/2)/(π² − q²) and sinc(q/2) 4π²/(4π² − q²).
    let bits = 192;
    let about_middle = |b, d, q: &Rational| {
        let law = Law::stretched(&Family::Scca { b, d }, &r(1, 2));
        &transform(&law, q, bits) * &cis(&(q.clone() / 2u32), bits)
    };
    for q in [r(1, 3), r(7, 2), r(1001, 7)] {
        let half = q.clone() / 2u32;
        let wave = cis(&half, bits);
        let square = Rational::from(&q * &q);
        let harmonic = &wave.re / Ball::rational(bits, &(r(1, 1) - &square));
        let found = about_middle(r(0, 1), r(1, 1), &q);
        assert!(found.re.overlaps(&harmonic) && found.im.contains(&r(0, 1)));
        let sinc = &wave.im / (Ball::pi(bits) * Ball::rational(bits, &half));
        let cycloidal = sinc * Ball::rational(bits, &(r(4, 1) / (r(4, 1) - &square)));
        let found = about_middle(r(1, 2), r(1, 2), &q);
        assert!(found.re.overlaps(&cycloidal) && found.re.accuracy_bits() > 150);
    }
    // At resonance, q = π: π/4.
    let found = about_middle(r(0, 1), r(1, 1), &r(1, 1));
    assert!(found.re.overlaps(&Ball::pi(bits).shift(-2)) && found.re.accuracy_bits() > 170);
}

#[test]
fn half_turns_up_and_down() {
    let law = Law::stretched(
        &Family::Scca {
            b: r(0, 1),
            d: r(1, 1),
        },
        &r(1, 2),
    );
    let stroke = |start| Stroke {
        law: law.clone(),
        start,
        turns: r(1, 2),
    };
    let (rise, fall) = (stroke(r(0, 1)), stroke(r(1, 2)));
    let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), 1);
    assert!(a.contains(&r(-1, 1)) && a.accuracy_bits() > 110 && b.contains(&r(0, 1)));
    assert!(mean(&r(2, 1), &rise, Some(&fall), 128).contains(&r(1, 1)));
    for n in [2, 3, 1000] {
        let [a, b] = harmonic(&r(2, 1), &rise, Some(&fall), n);
        assert!(a.contains(&r(0, 1)) && b.contains(&r(0, 1)));
    }
}

/// Two parabolas that meet at λ: the mean is `μ + (λ − μ)/3`.
fn parabolas(fraction: Rational) -> Law {
    scca(r(0, 1), r(0, 1), fraction)
}

/// `a_0` by the areas of its parts; whole turns before the start do not count.
#[test]
fn means_of_whole_cycles() {
    let rise = |start| Stroke {
        law: parabolas(r(1, 4)),
        start,
        turns: r(1, 4),
    };
    let fall = Stroke {
        law: parabolas(r(1, 3)),
        start: r(5, 8),
        turns: r(3, 10),
    };
    let holds = |x: Ball, due: Rational| x.contains(&due) && x.accuracy_bits() > 110;
    // 1/4 · 7/12 up, 1/4 on top, 3/10 · (1 − 5/9) down.
    let cycle = mean(&r(3, 1), &rise(r(1, 8)), Some(&fall), 128);
    assert!(holds(cycle, r(127, 80)));
    // 1/4 · 7/12 up, 5/8 on top, less the mean 1/2 of θ/2π.
    for start in [r(1, 8), r(9, 8), r(-7, 8)] {
        assert!(holds(mean(&r(3, 1), &rise(start), None, 128), r(13, 16)));
    }
}

/// At constant speed over B turns from S on `z_n = e^{−2πin(S + B/2)} sinc πnB`, and
/// `a_n + i b_n = (Im z_n + i Re z_n)/πn`.
#[test]
fn a_ramp_anywhere_in_the_turn() {
    let law = Law::polynomial(&[r(0, 1), r(1, 1)]).unwrap();
    for (start, turns) in [(r(1, 12), r(1, 6)), (r(2, 7), r(1, 3)), (r(-3, 5), r(1, 2))] {
        let rise = Stroke {
            law: law.clone(),
            start: start.clone(),
            turns: turns.clone(),
        };
        for n in [1u32, 2, 5] {
            let pi = || Ball::pi(160);
            let ball = |x: &Rational| Ball::rational(160, x);
            let middle = ball(&((Rational::from(&turns / 2u32) + &start) * n)) * pi().shift(1);
            let half = ball(&Rational::from(&turns * n)) * pi();
            let sinc = half.sin_cos().0 / &half / (pi() * Ball::integer(160, i64::from(n)));
            let (sine, cosine) = middle.sin_cos();
            let [a, b] = harmonic(&r(1, 1), &rise, None, n);
            assert!(a.overlaps(&-(sine * &sinc)) && b.overlaps(&(cosine * &sinc)));
            assert!(a.rad() < Mag::power_of_two(-120) && b.rad() < Mag::power_of_two(-120));
        }
    }
}

/// The greatest of `max |s^(j)|/(πq)^j`, in whole bits from above: none for zones, and a limited
/// number.
#[test]
fn bits_that_the_integration_by_parts_loses() {
    let law = |end: Rational, c: &[i32]| {
        let coefficients = c.iter().map(|&c| r(c, 1)).collect();
        let start = r(0, 1);
        Law(Form::Pieces(vec![Piece {
            start,
            end,
            coefficients,
        }]))
    };
    let at = |law: &Law, angle: f64| guard(law, angle / PI, 128);
    let small = 0.9 / 1024.0;
    // s' = 1: 1024/0.9 is 2^10.15.
    assert_eq!(at(&law(r(1, 1), &[0, 1]), small), 11);
    assert_eq!(at(&law(r(1, 1), &[7, -1]), small), 11);
    // s''' = 12, times 2^30.46: 2^34.04.
    assert_eq!(at(&law(r(1, 1), &[0, 0, 3, -2]), small), 35);
    // s' is at most 8, s'' is 16: 8/4.01 is just below 2.
    assert_eq!(at(&law(r(1, 4), &[0, 4, 8]), 4.01), 1);
    assert_eq!(at(&law(r(1, 4), &[0, 4, 8]), 3.99), 2);
    assert_eq!(at(&law(r(1, 4), &[0, 4, 8]), 1000.0), 0);
    assert_eq!(at(&law(r(1, 1), &[0, 1]), 1e-60), 128);
    assert_eq!(at(&scca(r(1, 4), r(1, 2), r(1, 2)), 1e-60), 0);
}

/// Checks that a value computed with few bits is not below that computed with many.
#[test]
fn conditions_are_bounds_from_above() {
    let [knots, ordinates] = table();
    let stroke = by_spline(&knots, &ordinates);
    let all = |bits| {
        let (mean, found) = data_conditions(&r(1, 1), &stroke, ODD, bits);
        std::iter::once(mean).chain(found.into_iter().flatten())
    };
    for (few, many) in all(32).zip(all(256)) {
        assert!(few > many && few.to_f64() < 1.01 * many.to_f64());
    }
}
