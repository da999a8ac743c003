//! Certified answers of linear problems, roots and systems beside those of mpmath
//! (`reference/independent/linear.csv`).

use mechaudit::reference::banded::{self, Banded};
use mechaudit::reference::roots::{interval, systems};
use mechaudit::reference::{Ball, Decimal, Matrix, dense, eigenvalues};
use rug::Rational;
use std::collections::BTreeMap;
use std::convert::Infallible;

/// 30 digits.
const GOAL: u32 = 100;

/// A function and its derivative.
fn function(name: &str, x: &Ball, bits: u32) -> [Ball; 2] {
    let n = |n: i64| Ball::integer(bits, n);
    let (sine, cosine) = x.sin_cos();
    match name {
        "cos(x)-x" => [cosine - x, -sine - n(1)],
        "x*exp(x)-1" => {
            let e = x.exp();
            [x * &e - n(1), (x + n(1)) * e]
        }
        "x^5-x-1" => {
            let fourth = x.square().square();
            [x * &fourth - x - n(1), fourth * n(5) - n(1)]
        }
        "wilkinson-5" => {
            let product = |left: Option<i64>| {
                let factors = (1..=5).filter(|k| Some(*k) != left);
                factors.fold(n(1), |p, k| p * (x - n(k)))
            };
            let slope = (1..=5).fold(n(0), |sum, k| sum + product(Some(k)));
            [product(None) + n(1).shift(-20), slope]
        }
        "sin(x^2)" => {
            let (sine, cosine) = x.square().sin_cos();
            [sine, cosine * x.shift(1)]
        }
        "exp(x)-2-x" => [x.exp() - n(2) - x, x.exp() - n(1)],
        _ => panic!("{name}"),
    }
}

struct Named(&'static str);

impl systems::System for Named {
    type Error = Infallible;
    fn values(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
        let n = |n: i64| Ball::integer(bits, n);
        let share = Ball::rational(bits, &Rational::from((3, 5)));
        Ok(match self.0 {
            "circle-and-cubic" => vec![
                x[0].square() + x[1].square() - n(4),
                &x[0] * x[0].square() - &x[1],
            ],
            "kepler" => {
                let (sine, cosine) = x[0].sin_cos();
                vec![&x[0] - &share * sine - n(1), &x[1] - n(1) + share * cosine]
            }
            _ => {
                let squares = x[0].square() + x[1].square() + x[2].square();
                let beside = (&x[0] - n(1)).square() + x[1].square() - &x[2];
                vec![squares - n(9), beside, &x[0] * &x[1] * &x[2] - n(1)]
            }
        })
    }
    fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
        let n = |n: i64| Ball::integer(bits, n);
        let share = Ball::rational(bits, &Rational::from((3, 5)));
        Ok(match self.0 {
            "circle-and-cubic" => vec![x[0].shift(1), x[1].shift(1), x[0].square() * n(3), n(-1)],
            "kepler" => {
                let (sine, cosine) = x[0].sin_cos();
                vec![n(1) - &share * cosine, n(0), -(share * sine), n(1)]
            }
            _ => {
                let mut rows: Vec<Ball> = x.iter().map(|x| x.shift(1)).collect();
                rows.extend([(&x[0] - n(1)).shift(1), x[1].shift(1), n(-1)]);
                rows.extend([&x[1] * &x[2], &x[0] * &x[2], &x[0] * &x[1]]);
                rows
            }
        })
    }
}

fn answers(kind: &str, rows: usize, columns: usize, v: &[Rational]) -> Vec<Ball> {
    let matrix = |m: usize, n: usize, v: &[Rational]| Matrix::new(m, n, v.to_vec()).unwrap();
    let (square, rest) = v.split_at(v.len().min(rows * columns));
    let entries = |m: Matrix<Ball>| m.entries().to_vec();
    match kind {
        "solve" => entries(
            dense::solve(&matrix(rows, rows, square), &matrix(rows, 1, rest), GOAL).unwrap(),
        ),
        "determinant" => vec![dense::determinant(&matrix(rows, rows, v), GOAL).unwrap()],
        "inverse" => entries(dense::inverse(&matrix(rows, rows, v), GOAL).unwrap()),
        "least-squares" => {
            let (a, b) = (matrix(rows, columns, square), matrix(rows, 1, rest));
            entries(dense::least_squares(&a, &b, GOAL).unwrap())
        }
        "eigenvalues" => eigenvalues::symmetric(&matrix(rows, rows, v), GOAL).unwrap(),
        "pencil" => {
            let (a, b) = (matrix(rows, rows, square), matrix(rows, rows, rest));
            eigenvalues::generalised(&a, &b, GOAL).unwrap()
        }
        "circle-and-cubic" | "kepler" | "three-spheres" => {
            let name = ["circle-and-cubic", "kepler", "three-spheres"]
                .into_iter()
                .find(|name| *name == kind);
            let start: Vec<f64> = v.iter().map(Rational::to_f64).collect();
            systems::near(&mut Named(name.unwrap()), &start, GOAL).unwrap()
        }
        _ => match kind.strip_prefix("banded-") {
            Some(width) => {
                let width: usize = width.parse().unwrap();
                let (band, side) = v.split_at(rows * width);
                let a = Banded::new(rows, columns, width - 1 - columns, band.to_vec()).unwrap();
                banded::solve(&a, side, GOAL).unwrap()
            }
            None => {
                let part = |k: usize| {
                    move |x: &Ball, bits: u32| {
                        Ok::<_, Infallible>(function(kind, x, bits)[k].clone())
                    }
                };
                interval::all_roots(part(0), part(1), &v[0], &v[1], GOAL, 10_000).unwrap()
            }
        },
    }
}

#[test]
fn mpmath_agrees_on_linear_problems_and_roots() {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in include_str!("../../reference/independent/linear.csv")
        .lines()
        .skip(1)
    {
        let [kind, rows, columns, numbers, due] = row.split(',').collect::<Vec<_>>()[..] else {
            panic!("{row}");
        };
        let numbers: Vec<Rational> = numbers.split(' ').map(|q| q.parse().unwrap()).collect();
        let ours = answers(
            kind,
            rows.parse().unwrap(),
            columns.parse().unwrap(),
            &numbers,
        );
        let due: Vec<&str> = due.split(' ').collect();
        assert_eq!(ours.len(), due.len(), "{kind}");
        for (ours, due) in ours.iter().zip(due) {
            let due = Ball::rational(200, &Decimal::parse(due).unwrap().value);
            let gap = (ours - &due).abs().upper();
            assert!(
                gap <= due.abs().upper() * 1e-29,
                "{kind}: {} {}",
                ours.mid(),
                due.mid()
            );
        }
        *counts.entry(kind.split('-').next().unwrap()).or_default() += 1;
    }
    let count = |kind: &str| counts[kind];
    assert_eq!(
        [
            count("solve"),
            count("determinant"),
            count("inverse"),
            count("least")
        ],
        [7, 7, 2, 4]
    );
    assert_eq!(
        [count("banded"), count("eigenvalues"), count("pencil")],
        [3, 8, 4]
    );
    // Roots and systems are of different names.
    assert_eq!(counts.len(), 7 + 9);
}
