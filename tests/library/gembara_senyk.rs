//! The paper of Gembara and Senyk: what follows from its formulas.

use mechaudit_cli::papers::gembara_senyk::charts;
use mechaudit_cli::reference::chirp_oscillator::{Problem, response};
use mechaudit_cli::reference::{Ball, Mag, cam_law, fourier_series};
use rug::{Float, Rational};
use std::fmt::Write;

const LAWS: [&str; 2] = ["К", "0050"];

#[test]
fn charts_of_both_laws() {
    let mut text = String::new();
    for law in LAWS {
        writeln!(
            text,
            "law {law}: xi, sum of |A_k|, k = 1 ... {}",
            charts::HARMONICS
        )
        .unwrap();
        for xi in 2..=14 {
            let sum = certified(law, &Rational::from(xi), 240);
            assert!(sum.rad().to_f64() < 1e-26, "{xi}: {:?}", sum.rad());
            writeln!(text, "{xi:2}  {:.25}", sum.mid()).unwrap();
        }
    }
    insta::with_settings!({snapshot_path => "../../snapshots", prepend_module_to_snapshot => false}, {
        insta::assert_snapshot!("gembara-senyk-charts", text);
    });
}

#[test]
fn solver_against_certified_charts() {
    for law in LAWS {
        let chart = charts::chart(law, true).unwrap();
        for xi in [2u32, 5, 9, 14] {
            let due = certified(law, &Rational::from(xi), 140).mid().to_f64();
            let point = chart
                .points
                .iter()
                .find(|p| (p.xi_rise - f64::from(xi)).abs() < 1e-9);
            let got = point.expect("on the grid").bound;
            assert!((got / due - 1.0).abs() < 1e-12, "{law} {xi}: {got} {due}");
        }
    }
}

/// `Σ|A_k|` of the run-up at `ξ` (19), corrected and enclosed.
fn certified(law: &str, xi: &Rational, prec: u32) -> Ball {
    let q = |n: i32, d: u32| Rational::from((n, d));
    // The share of a cosine; nothing of the law is without acceleration.
    let d = match law {
        "К" => q(1, 1),
        _ => Rational::new(),
    };
    let b = Rational::new();
    let form = cam_law::Law::stretched(&cam_law::Family::Scca { b, d }, &q(1, 2));
    let stroke = |start: Rational| fourier_series::Stroke {
        law: form.clone(),
        start,
        turns: q(1, 3),
    };
    let (rise, fall) = (stroke(q(0, 1)), stroke(q(1, 2)));
    // t = w_rise/(εξ): the speed is a third of w over ξ.
    let t = q(100, 3) * q(5, 1) / xi;
    let orders = fourier_series::Orders {
        first: 1,
        stride: 1,
        count: charts::HARMONICS,
    };
    let harmonics = fourier_series::harmonics(&q(1, 1), &rise, Some(&fall), orders, prec);
    (1..=charts::HARMONICS)
        .zip(harmonics)
        .fold(Ball::integer(prec, 0), |sum, (k, [a, b])| {
            let forcing = hypotenuse(&a, &b);
            let o = Rational::new;
            let values = [
                q(100, 1),
                q(2, 1),
                q(1, 5),
                o(),
                Rational::from(k),
                o(),
                o(),
                o(),
                t.clone(),
            ];
            let amplitude = Problem::new(&values)
                .ok()
                .and_then(|p| response(&p, prec).ok());
            match amplitude {
                Some(r) => sum + forcing * r.amplitude.norm_sqr().sqrt(),
                None => Ball::new(Float::new(prec), Mag::INFINITY),
            }
        })
}

/// `√(a² + b²)`, also where both may vanish.
fn hypotenuse(a: &Ball, b: &Ball) -> Ball {
    let square = a.square() + b.square();
    match square.contains_zero() {
        true => Ball::integer(a.prec(), 0).widened(a.magnitude().add(b.magnitude())),
        false => square.sqrt(),
    }
}

#[test]
fn a_harmonic_that_may_vanish_is_enclosed() {
    let ball =
        |middle: i64, radius: i64| Ball::integer(64, middle).widened(Mag::power_of_two(radius));
    assert!(hypotenuse(&ball(3, -50), &ball(4, -50)).overlaps(&Ball::integer(64, 5)));
    // Up to (1, 1), and to (1, 0).
    let both = hypotenuse(&ball(0, 0), &ball(0, 0));
    assert!(both.contains_zero() && both.overlaps(&Ball::integer(64, 2).sqrt()));
    let one = hypotenuse(&ball(0, 0), &ball(0, -50));
    assert!(one.overlaps(&Ball::integer(64, 1)));
}
