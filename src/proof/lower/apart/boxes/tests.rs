use super::*;
use crate::pinned::{bit_by_bit, counted};

fn zero(k: u32) -> ComplexBall {
    faddeeva::zero(k, 160).expect("decided")
}

fn square(a: f64, b: f64, side: f64) -> Rectangle {
    Rectangle {
        a: [a, a + side],
        b: [b, b + side],
    }
}

/// A zero is next to a number only if both its components are.
#[test]
fn zeros_next_to_numbers_are_found() {
    let z = zero(1);
    assert!(is_off(&z));
    let number = |x: f64, off: i32| {
        Ball::exact(300, x).widened(Mag::ZERO) + Ball::integer(300, 1).shift(off)
    };
    let ball = |p: i32, q: i32| ComplexBall::new(number(2.0, p), number(-1.5, q));
    assert!(!is_off(&ball(-100, -100)));
    assert!(!is_off(&ball(-101, -101)) && !is_off(&ball(-200, -110)));
    assert!(is_off(&ball(-99, -101)) && is_off(&ball(-101, -99)));
    // Known to too few digits it may be next to one.
    let blurred = ComplexBall::new(
        number(2.0, -90).widened(Mag::power_of_two(-80)),
        number(-1.5, -90).widened(Mag::power_of_two(-80)),
    );
    assert!(!is_off(&blurred));
}

/// All of the rectangle is within `1/(8R)` of a zero.
#[test]
fn rectangles_beside_a_zero() {
    let zeros = [(2.0, 1.5), (5.0, 4.0)];
    for (x, y) in zeros {
        assert!(is_beside(&square(x - 0.004, y - 0.004, 0.008), &zeros));
        // Its farthest corner counts.
        for (p, q) in [
            (0.0, 0.0),
            (-0.0078, 0.0),
            (0.0, -0.0078),
            (-0.0078, -0.0078),
        ] {
            assert!(!is_beside(&square(x + p, y + q, 0.0078), &zeros));
            assert!(is_beside(
                &square(x + p * 0.9, y + q * 0.9, 0.00702),
                &zeros
            ));
        }
    }
    assert!(!is_beside(&square(3.0, 1.5, 0.001), &zeros));
}

/// Squares without a zero, one around a known zero, and one around a zero that is not given.
#[test]
fn a_zero_that_is_left_out_stays_open() {
    let z = zero(1);
    let (x, y) = (z.re.mid().to_f64(), -z.im.mid().to_f64());
    assert_eq!(count(square(2.0, 1.0, 0.01), 0, &[]), Ok(1));
    let around = square(x - 0.013, y - 0.011, 0.024);
    let found = count(around, 0, &[(x, y)]).expect("proved");
    assert!(found > 4);
    // Without it, halved as often as may be.
    assert!(count(square(x - 1e-6, y - 1e-6, 2e-6), DEPTH - 8, &[]).is_err());
    // Inside the unit circle and beyond the last one nothing has to be shown.
    assert_eq!(count(square(0.1, 0.1, 0.5), 0, &[]), Ok(0));
    assert_eq!(count(square(8.0, 8.0, 0.5), 0, &[]), Ok(0));
    // Across the circle something has, by the farthest corner; beyond by the nearest.
    let flat = |a, b| count(Rectangle { a, b }, 0, &[]).expect("proved");
    let (long, short) = ([0.1, 1.2], [0.1, 0.2]);
    assert!(flat(long, short) > 0 && flat(short, long) > 0);
    let long = [11.0, 12.0];
    assert!(flat(long, short) > 0 && flat(short, long) > 0);
    assert!(count(square(0.7, 0.7, 0.1), 0, &[]).expect("proved") > 0);
    // Where 2e^{−z²} is larger than any w(−z): all over the rectangle.
    assert!(is_large(&square(0.5, 9.0, 0.3)) && !is_large(&square(1.0, 1.0, 1.0)));
    assert_eq!(count(square(0.5, 9.0, 0.3), 0, &[]), Ok(1));
    // The last of the zeros is beyond the circle.
    let last = zero(ZEROS);
    assert!(last.norm_sqr().lower() > 130 && REACH * REACH > 126.0);
    assert!(zero(ZEROS - 2).norm_sqr().lower() > 112);
}

/// The whole is the disc, and zeros are given below the axis.
#[test]
fn the_whole_and_its_zeros() {
    assert_eq!([WHOLE.a, WHOLE.b], [[0.0, REACH]; 2]);
    let z = zero(1);
    let found = places(&[zero(2), z.clone()]).expect("off");
    assert_eq!(found[1], (z.re.mid().to_f64(), -z.im.mid().to_f64()));
    assert!(found[0].0 > found[1].0 && found.iter().all(|(x, y)| *x > 0.0 && *y > 0.0));
    let number = |x: f64| Ball::exact(300, x);
    let next = ComplexBall::new(number(2.0), number(-1.5));
    assert!(places(&[z, next]).is_err());
}

/// The number of squares that show that there is no zero, and the depth from which on they are too
/// few.
#[test]
fn squares_bit_by_bit() {
    let all: Vec<ComplexBall> = (1..=3).map(zero).collect();
    let all = places(&all).expect("off");
    let squares = [
        square(1.75, 1.25, 0.375),
        square(2.5, 2.0, 0.25),
        square(0.5, 0.75, 0.5),
        square(0.25, 2.0, 0.75),
        square(7.75, 7.75, 0.25),
    ];
    let counts = squares.map(|s| count(s, 0, &all));
    let deepest = squares.map(|s| {
        (0..=DEPTH)
            .rev()
            .find(|depth| count(s, *depth, &all).is_ok())
    });
    let around = |r: f64| all.iter().map(move |z| square(z.0 - r, z.1 - r, 2.0 * r));
    let sides = [
        0.0074,
        0.0075,
        0.0076,
        0.0077,
        0.0076367532364,
        0.0076367532374,
    ];
    let beside: Vec<bool> = sides
        .into_iter()
        .flat_map(around)
        .map(|s| is_beside(&s, &all))
        .collect();
    // 2e^{b²} from 1 to 8.
    let large = (0..64).map(|i| f64::from(i) / 40.0);
    let large: Vec<bool> = large
        .map(|b| {
            is_large(&Rectangle {
                a: [0.0; 2],
                b: [b; 2],
            })
        })
        .collect();
    let sizes = large.iter().chain(&beside).filter(|x| **x).count();
    let found = [
        counted("counts", counts),
        counted("deepest", deepest),
        counted("beside a zero", beside),
        ("large", crate::pinned::digest(large), sizes as f64),
    ];
    let due = [
        ("counts", 0x54bdf746c94918c1, 5.0),
        ("deepest", 0xd432ea3d9a326c0f, 5.0),
        ("beside a zero", 0x3f00929ff075e7a6, 18.0),
        ("large", 0x5e7f428641a427fb, 47.0),
    ];
    bit_by_bit(&found, &due);
}
