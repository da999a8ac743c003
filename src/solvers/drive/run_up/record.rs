//! Describes what a run did, for doing it again in other arithmetic.

use super::stepper::Method;
use differential_equations::tableau::ButcherTableau;

/// How a stretch of the motion was covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// By a step of the method.
    Step,
    /// Along the tangent: the end of a step put onto the angle or speed that it was to end at.
    Tangent,
}

/// A stretch of the motion, between two moments in seconds. Each begins where the last one ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// How it was covered.
    pub taken: Taken,
}

/// Coefficients of an explicit Runge–Kutta method, as they are in use: rounded to doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct Tableau {
    /// `a[i][j]` for `j < i`.
    pub a: Vec<Vec<f64>>,
    /// `b[i]`.
    pub b: Vec<f64>,
}

impl Method {
    /// The coefficients of an explicit method.
    ///
    /// ```
    /// use mechaudit_solvers::run_up::Method;
    /// let weights = Method::Verner98.tableau().unwrap().b;
    /// assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    /// assert_eq!(Method::Radau5.tableau(), None);
    /// ```
    pub fn tableau(self) -> Option<Tableau> {
        match self {
            Method::Verner98 => Some(of(&ButcherTableau::rkv989e())),
            Method::Dop853 => Some(of(&ButcherTableau::dop853())),
            Method::Radau5 => None,
        }
    }
}

fn of<const S: usize, const I: usize>(t: &ButcherTableau<f64, S, I>) -> Tableau {
    Tableau {
        a: (0..S).map(|i| t.a[i][..i].to_vec()).collect(),
        b: t.b.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weights of every explicit method add up to one, and it begins with the derivative.
    #[test]
    fn tableaus() {
        for (method, stages) in [(Method::Verner98, 16), (Method::Dop853, 12)] {
            let t = method.tableau().unwrap();
            assert_eq!((t.a.len(), t.b.len()), (stages, stages));
            assert!((t.b.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(t.a.iter().enumerate().all(|(i, row)| row.len() == i));
        }
        assert_eq!(Method::Radau5.tableau(), None);
    }
}
