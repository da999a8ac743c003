use super::*;
use crate::planted::{Planted, off, output};
use crate::{Limit, Rows};
use mechaudit_reference::Mag;
use rug::Float;

const ULP: f64 = f64::EPSILON;

/// Returns the number that is exactly `ulps` ulps of one above `x`.
fn beside(x: f64, ulps: f64) -> Ball {
    Ball::new(Float::with_val(128, x) + ulps * ULP, Mag::ZERO)
}

fn exact(values: Vec<Ball>) -> ReferenceAnswer {
    ReferenceAnswer::bounded(values, "planted")
}

fn parts(method: f64, rounding: f64) -> Option<ErrorParts> {
    Some(ErrorParts { method, rounding })
}

/// The twin three quarters of an ulp from the reference, the value two and a quarter from the twin;
/// bounds from above, so a radius counts once in each part that it stands in.
#[test]
fn an_error_is_that_of_the_method_and_of_rounding() {
    let at = |twin: Ball, truth: Ball, got: f64| {
        let method = Planted {
            twin: Box::new(move |_| Some(vec![twin.clone()])),
            reference: Box::new(move |_, _| exact(vec![truth.clone()])),
            solve: Box::new(move |_| SolverAnswer::Values(vec![got])),
            ..Planted::default()
        };
        error_parts(&method, &[1.0], 0, 128).unwrap()
    };
    let near = |found: ErrorParts, method: f64, rounding: f64| {
        let above = |x: f64, expected: f64| (expected..=expected * (1.0 + 1e-9)).contains(&x);
        assert!(above(found.method, method), "{found:?}");
        assert!(above(found.rounding, rounding), "{found:?}");
    };
    let one = || beside(1.0, 0.0);
    near(at(beside(1.0, 0.75), one(), off(1.0, 3)), 0.75, 2.25);
    // To the other side.
    near(at(beside(1.0, -2.5), one(), off(1.0, 1)), 2.5, 3.5);
    // Ulps are those of the reference.
    let four = |ulps| beside(4.0, ulps);
    near(at(four(2.0), four(0.0), off(4.0, 3)), 0.5, 2.5);
    let eighth = |ulps| beside(0.125, ulps);
    near(at(eighth(1.0), eighth(0.0), 0.125), 8.0, 8.0);
    // A twin and a reference that are not exact.
    let wide = |ball: Ball, ulps: f64| ball.widened(Mag::from_f64(ulps * ULP));
    near(
        at(wide(beside(1.0, 1.0), 0.25), wide(one(), 0.5), 1.0),
        1.75,
        1.25,
    );
    // A twin of few bits takes none from the value.
    let coarse = Ball::new(Float::with_val(8, 1.5), Mag::ZERO);
    near(at(coarse, beside(1.5, 0.0), off(1.5, 1)), 0.0, 1.0);
}

/// Of an output in several rows the row with the largest error counts, and no value of another
/// output.
#[test]
fn the_worst_value_of_an_output_is_taken_apart() {
    let method = Planted {
        outputs: vec![output("x", Limit::Ulps(4.0)), output("y", Limit::Ulps(4.0))],
        rows: Some(Rows {
            index: "k",
            count: "3",
            meaning: "planted",
        }),
        reference: Box::new(|_, _| exact(vec![beside(1.0, 0.0); 6])),
        solve: Box::new(|_| {
            let ulps = [1, 9, 3, 0, 2, 5];
            SolverAnswer::Values(ulps.map(|k| off(1.0, k)).to_vec())
        }),
        twin: Box::new(|_| {
            Some(
                [0.5, 8.0, 0.25, 0.0, 2.0, 0.125]
                    .map(|k| beside(1.0, k))
                    .to_vec(),
            )
        }),
        ..Planted::default()
    };
    let of = |output| {
        error_parts(&method, &[1.0], output, 128).map(|p| {
            let rounded = |x: f64| (x * 1024.0).round() / 1024.0;
            (rounded(p.method), rounded(p.rounding))
        })
    };
    assert_eq!(of(0), Some((0.25, 2.75)));
    assert_eq!(of(1), Some((8.0, 1.0)));
    assert_eq!(of(6), None);
}

/// Without a twin, a finite input, values of both sides, or as many of each there is nothing to
/// take apart.
#[test]
fn what_cannot_be_taken_apart() {
    let values = |n: usize| vec![beside(1.0, 0.0); n];
    let at = |twin: Option<usize>, reference: usize, got: usize, x: f64| {
        let method = Planted {
            twin: Box::new(move |_| twin.map(values)),
            reference: Box::new(move |_, _| match reference {
                0 => ReferenceAnswer::Refuses("planted"),
                n => exact(values(n)),
            }),
            solve: Box::new(move |_| match got {
                0 => SolverAnswer::Refuses("planted"),
                n => SolverAnswer::Values(vec![1.0; n]),
            }),
            ..Planted::default()
        };
        error_parts(&method, &[x], 0, 128)
    };
    assert_eq!(at(Some(1), 1, 1, 1.0), parts(0.0, 0.0));
    assert_eq!(at(Some(2), 2, 2, 1.0), parts(0.0, 0.0));
    assert_eq!(at(None, 1, 1, 1.0), None);
    assert_eq!(at(Some(1), 1, 1, f64::NAN), None);
    assert_eq!(at(Some(1), 0, 1, 1.0), None);
    assert_eq!(at(Some(1), 1, 0, 1.0), None);
    for (twin, reference, got) in [
        (1, 2, 2),
        (2, 1, 2),
        (2, 2, 1),
        (2, 1, 1),
        (1, 2, 1),
        (1, 1, 2),
    ] {
        assert_eq!(at(Some(twin), reference, got, 1.0), None);
    }
}

/// The reference is computed with the requested number of bits.
#[test]
fn the_reference_has_the_bits_asked_for() {
    let method = Planted {
        twin: Box::new(|x| Some(vec![Ball::exact(64, x[0])])),
        reference: Box::new(|_, bits| exact(vec![beside(1.0, f64::from(bits))])),
        ..Planted::default()
    };
    let found = error_parts(&method, &[1.0], 0, 96).unwrap();
    assert!((found.method - 96.0).abs() < 1e-6 && found.rounding == 0.0);
}

/// The difference of value and twin has the bits of the finer one, 64 at least.
#[test]
fn roundings_have_their_bits() {
    let at = |k: u32, bits: u32| {
        let twin = Float::with_val(bits, 1) / (k + 3);
        let method = Planted {
            twin: Box::new(move |_| Some(vec![Ball::new(twin.clone(), Mag::ZERO)])),
            reference: Box::new(|_, _| exact(vec![beside(8.0, 0.0)])),
            solve: Box::new(move |_| SolverAnswer::Values(vec![8.0 + f64::from(k) / 7.0])),
            ..Planted::default()
        };
        error_parts(&method, &[1.0], 0, 128).unwrap().rounding
    };
    for (bits, expected) in [
        (53, "[aaab, 4924, e2bf, 1862, 6db7, b6db]"),
        (64, "[aaac, 4924, e2c0, 1863, 6db8, b6db]"),
        (128, "[aaac, 4924, e2c0, 1863, 6db8, b6db]"),
    ] {
        let last: Vec<u64> = (0..6).map(|k| at(k, bits).to_bits() & 0xffff).collect();
        assert_eq!(format!("{last:x?}"), expected, "{bits}");
    }
}
