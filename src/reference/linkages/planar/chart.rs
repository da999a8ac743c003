//! A compact set of angles that holds every position up to whole turns.
//!
//! A whole turn of a body changes no loop, but gears and the drive, `M x = c` with rational M, hold
//! for angles as real numbers: a crank at 4 rad is none at 4 − 2π, and a gear of ratio 1/2 comes
//! back after two turns of the other. Whole turns `2πv` lead from solutions to solutions if
//! `M v = 0` for the integers v.
//!
//! Gauss and Jordan's elimination solves for some of the angles, `x_p = c' − A x_f`. With q the
//! common denominator of column k of A, q turns of `x_k` and `−A_k q` of the others are such turns,
//! one for each free angle. So every solution has an image with all free `|x_k| ≤ q_k π`.

use super::system::System;
use crate::Ball;
use rug::{Integer, Rational};

/// `Σ k x`, and what it has to be.
pub(super) type Equation = (Vec<(usize, Rational)>, Ball);

/// An equation of the elimination: its coefficients, the right side, the angle it is solved for.
struct Row {
    k: Vec<Rational>,
    right: Ball,
    pivot: usize,
}

impl Row {
    /// Takes an equation away as often as it makes the coefficient of its pivot zero.
    fn reduce(&mut self, by: &Row, bits: u32) {
        let factor = self.k[by.pivot].clone();
        for (a, b) in self.k.iter_mut().zip(&by.k) {
            *a -= Rational::from(&factor * b);
        }
        self.right = &self.right - &(&Ball::rational(bits, &factor) * &by.right);
    }
}

/// The equations solved for one angle each; one that follows from the others is left out.
fn solved(equations: &[Equation], n: usize, bits: u32) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for (terms, right) in equations {
        let mut row = Row {
            k: vec![Rational::new(); n],
            right: right.clone(),
            pivot: 0,
        };
        for (i, k) in terms {
            row.k[*i] += k;
        }
        rows.iter().for_each(|other| row.reduce(other, bits));
        let Some(pivot) = row.k.iter().position(|k| !k.is_zero()) else {
            continue;
        };
        let lead = row.k[pivot].clone();
        row.k.iter_mut().for_each(|k| *k /= &lead);
        row.right = row.right / &Ball::rational(bits, &lead);
        row.pivot = pivot;
        rows.iter_mut().for_each(|other| other.reduce(&row, bits));
        rows.push(row);
    }
    rows
}

impl System {
    /// Balls for the angles, one of which holds an image of every position.
    pub(super) fn chart(&self, equations: &[Equation]) -> Vec<Ball> {
        let (n, bits) = (self.coordinates, self.bits);
        let rows = solved(equations, n, bits);
        let pi = Ball::pi(bits).magnitude();
        let free = |k: usize| {
            let common = |q: Integer, row: &Row| q.lcm(row.k[k].denom());
            let turns = rows.iter().fold(Integer::from(1), common);
            let most = Ball::rational(bits, &Rational::from(turns)).magnitude();
            Ball::integer(bits, 0).widened(most.mul(pi))
        };
        let mut x: Vec<Ball> = (0..n).map(free).collect();
        for row in &rows {
            let others = (0..n).filter(|k| *k != row.pivot && !row.k[*k].is_zero());
            let sum = others.fold(row.right.clone(), |s, k| {
                s - &Ball::rational(bits, &row.k[k]) * &x[k]
            });
            x[row.pivot] = sum;
        }
        x
    }
}
