use super::*;
use crate::reference::Ball;
use rug::Rational;

fn problem(values: [f64; 9]) -> Problem {
    Problem::new(&values.map(|x| Rational::from_f64(x).unwrap())).unwrap()
}

fn overlap(a: &Response, b: &Response, what: &str) {
    for (x, y) in a.components().into_iter().zip(b.components()) {
        assert!(
            x.overlaps(y),
            "{what}: {} ± {:?}, {} ± {:?}",
            x.mid(),
            x.rad(),
            y.mid(),
            y.rad()
        );
    }
}

/// w, n, ε, Ω₀, k, δ, y₀, v₀, t
const CASES: &[[f64; 9]] = &[
    [10.0, 0.5, 4.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.5],
    [10.0, 0.5, -4.0, 30.0, 2.0, 0.3, 0.1, -2.0, 8.0],
    [10.0, 10.0, 4.0, 0.0, 2.0, 0.3, 0.1, -2.0, 3.0],
    [
        10.0,
        10.0 * (1.0 + 1e-12),
        4.0,
        0.0,
        2.0,
        0.3,
        0.1,
        -2.0,
        3.0,
    ],
    [10.0, 40.0, -4.0, 10.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 0.0, 10.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 0.0, 3.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 10.0, 0.0, 3.0, 1.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.1, 5.0, 3.0, 0.0, 0.3, 0.1, -2.0, 3.0],
    [10.0, 0.0, 1e-9, 10.0, 1.0, 0.3, 0.0, 0.0, 3.0],
    [10.0, 0.1, 100.0, -30.0, 1.0, 0.3, 0.0, 0.0, 2.0],
    [10.0, 0.1, 1.0, -3.0, 3.0, 0.3, 0.0, 0.0, 0.001],
    [10.0, 0.1, 1.0, -3.0, 3.0, 0.3, 0.5, 0.25, 0.0],
];

#[test]
fn two_ways() {
    for case in CASES {
        let p = problem(*case);
        let closed = enclose(&p, 160);
        let series = taylor::enclose(&p, 160).unwrap();
        overlap(&closed, &series, &format!("{case:?}"));
        for (x, y) in closed.components().into_iter().zip(series.components()) {
            println!(
                "{} {} {}",
                Ball::to_f64(x),
                x.accuracy_bits(),
                y.accuracy_bits()
            );
        }
    }
}
