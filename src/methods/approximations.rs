//! Approximations with their refinements: splines of known functions, and run-ups.

#[cfg(feature = "run-up")]
use super::RunUpInput;
#[cfg(feature = "run-up")]
use super::drive::run_up;
use crate::audit::{Approximation, SolverAnswer, Uncertified};
use crate::reference::Ball;
use crate::reference::cubic_spline::Spline as ExactSpline;
use crate::solvers::cubic_spline::{Boundary, CubicSpline};
#[cfg(feature = "run-up")]
use crate::solvers::run_up::Method as Integration;
use rug::Rational;
use std::error::Error;
use std::sync::OnceLock;

/// Every approximation.
pub fn approximations() -> Vec<Box<dyn Approximation>> {
    let spline = |name, summary, ends| {
        Box::new(SplineOfWitch {
            name,
            summary,
            ends,
        })
    };
    let mut all: Vec<Box<dyn Approximation>> = vec![
        spline(
            "spline-clamped",
            "clamped cubic spline of 1/(1 + x^2) on [-1, 1], true end slopes, equal steps",
            Ends::Slopes,
        ),
        spline(
            "spline-natural",
            "natural cubic spline of the same function: its second derivatives at the ends are not 0",
            Ends::Natural,
        ),
        spline(
            "spline-not-a-knot",
            "not-a-knot cubic spline of the same function",
            Ends::NotAKnot,
        ),
    ];
    #[cfg(feature = "run-up")]
    for method in Integration::ALL {
        for machine in [Machine::BareRotor, Machine::SandScreen] {
            all.push(Box::new(RunUp::new(method, machine)));
        }
    }
    all
}

/// The approximation of that name.
///
/// ```
/// use mechaudit::audit::convergence;
/// use mechaudit::methods;
///
/// let spline = methods::find_approximation("spline-clamped").unwrap();
/// let report = convergence(&*spline)?;
/// let finest = report.levels.last().unwrap().errors[0];
/// assert!((finest.order.unwrap() - 4.0).abs() < 0.1);
/// assert!(finest.rounding.unwrap() < 1e-15);
/// # Ok::<(), mechaudit::audit::Uncertified>(())
/// ```
pub fn find_approximation(name: &str) -> Option<Box<dyn Approximation>> {
    approximations().into_iter().find(|a| a.name() == name)
}

#[derive(Clone, Copy)]
enum Ends {
    Slopes,
    Natural,
    NotAKnot,
}

/// Cubic splines of the witch of Agnesi. Everything about them is rational, so the twin is the
/// spline itself in exact arithmetic, through the exact ordinates.
struct SplineOfWitch {
    name: &'static str,
    summary: &'static str,
    ends: Ends,
}

/// Places in each interval of the finest spline, a third into each eighth of it: between the knots
/// of every level, where the third derivative jumps, and so close that the largest error of a
/// smooth function is found to two percent.
const PLACES: u32 = 8;

/// Abscissae: both ends of the range, where the error of a natural spline is largest, and the
/// places between them.
fn queries() -> impl Iterator<Item = f64> {
    let count = (COARSEST << (LEVELS - 1)) * PLACES;
    let step = 2.0 / f64::from(count);
    let inner = (0..count).map(move |i| -1.0 + (f64::from(i) + 1.0 / 3.0) * step);
    std::iter::once(-1.0).chain(inner).chain([1.0])
}

const BITS: u32 = 160;
/// Intervals of the coarsest spline, and how many splines there are, each of twice as many
/// intervals.
const COARSEST: u32 = 8;
const LEVELS: usize = 6;

/// `f` and its first three derivatives, `f = 1/(1 + x²)`.
fn witch(x: &Rational) -> [Rational; 4] {
    let square = Rational::from(x * x);
    let f = (Rational::from(1) + &square).recip();
    let f2 = Rational::from(&f * &f);
    let [f3, f4] = [Rational::from(&f2 * &f), Rational::from(&f2 * &f2)];
    // f' = −2 x f², f'' = −2 f² + 8 x² f³, f''' = 24 x f³ − 48 x³ f⁴.
    let first = Rational::from(-2 * x) * &f2;
    let second = Rational::from(-2 * &f2) + Rational::from(8 * &square) * &f3;
    let third = Rational::from(24 * x) * &f3 - Rational::from(48 * &square) * x * f4;
    [f, first, second, third]
}

impl SplineOfWitch {
    fn knots(&self, level: usize) -> Vec<Rational> {
        let n = COARSEST << level;
        (0..=n).map(|i| Rational::from((2 * i, n)) - 1).collect()
    }
}

impl Approximation for SplineOfWitch {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        self.summary
    }

    fn work_unit(&self) -> &'static str {
        "intervals"
    }

    fn outputs(&self) -> Vec<(&'static str, Option<f64>)> {
        // A natural spline is off by f'' at the ends.
        let order = match self.ends {
            Ends::Slopes | Ends::NotAKnot => 4.0,
            Ends::Natural => 2.0,
        };
        let orders = [0.0, 1.0, 2.0, 3.0].map(|derivative| Some(order - derivative));
        ["S", "S'", "S''", "S'''"].into_iter().zip(orders).collect()
    }

    fn places(&self) -> String {
        let finest = COARSEST << (LEVELS - 1);
        let all = finest * PLACES + 2;
        format!(
            "the largest error at {all} places: both ends of [-1, 1] and {PLACES} in each of {finest} equal intervals"
        )
    }

    fn levels(&self) -> Vec<String> {
        (0..LEVELS).map(|k| (COARSEST << k).to_string()).collect()
    }

    fn run(&self, level: usize) -> (u64, SolverAnswer) {
        let knots = self.knots(level);
        let x: Vec<f64> = knots.iter().map(Rational::to_f64).collect();
        let y = x.iter().map(|x| 1.0 / (1.0 + x * x)).collect();
        let slope = |x: f64| -2.0 * x / (1.0 + x * x).powi(2);
        let boundary = match self.ends {
            Ends::Slopes => Boundary::clamped(slope(-1.0), slope(1.0)),
            Ends::Natural => Boundary::second_derivatives(0.0, 0.0),
            Ends::NotAKnot => Boundary::NOT_A_KNOT,
        };
        let values = || -> Result<Vec<f64>, Box<dyn Error>> {
            let s = CubicSpline::fit(x, y, boundary)?;
            let mut all = Vec::new();
            for q in queries() {
                let j = s.jet(q)?;
                all.extend([j.value, j.first, j.second, j.third]);
            }
            Ok(all)
        };
        let answer =
            values().map_or_else(|e| SolverAnswer::Fails(e.to_string()), SolverAnswer::Values);
        (u64::from(COARSEST << level), answer)
    }

    fn twin(&self, level: usize) -> Option<Vec<Ball>> {
        let x = self.knots(level);
        let jets: Vec<[Rational; 4]> = x.iter().map(witch).collect();
        let y: Vec<Rational> = jets.iter().map(|j| j[0].clone()).collect();
        let spline = match self.ends {
            Ends::Slopes => ExactSpline::clamped(&x, &y, &jets[0][1], &jets[x.len() - 1][1]),
            Ends::Natural => ExactSpline::natural(&x, &y),
            Ends::NotAKnot => ExactSpline::not_a_knot(&x, &y),
        };
        let spline = spline.ok()?;
        let at = |q: f64| Some(spline.eval(&Rational::from_f64(q)?));
        let values: Option<Vec<[Rational; 4]>> = queries().map(at).collect();
        Some(balls(&values?))
    }

    fn truth(&self) -> Result<Vec<Ball>, Uncertified> {
        let exact = queries().filter_map(Rational::from_f64);
        let values: Vec<[Rational; 4]> = exact.map(|q| witch(&q)).collect();
        Ok(balls(&values))
    }
}

fn balls(jets: &[[Rational; 4]]) -> Vec<Ball> {
    jets.iter()
        .flatten()
        .map(|v| Ball::rational(BITS, v))
        .collect()
}

#[cfg(feature = "run-up")]
#[derive(Clone, Copy)]
enum Machine {
    BareRotor,
    SandScreen,
}

#[cfg(feature = "run-up")]
/// A run-up at falling tolerances against its enclosure. The twin takes the steps that were
/// accepted, with the same coefficients, in balls; an implicit method has none.
struct RunUp {
    method: Integration,
    machine: Machine,
    truth: OnceLock<Result<Vec<Ball>, Uncertified>>,
}

#[cfg(feature = "run-up")]
impl RunUp {
    fn new(method: Integration, machine: Machine) -> RunUp {
        let truth = OnceLock::new();
        RunUp {
            method,
            machine,
            truth,
        }
    }

    fn input(&self) -> RunUpInput<'static> {
        match self.machine {
            Machine::BareRotor => run_up::bare_rotor_under_kloss(),
            Machine::SandScreen => run_up::sand_screen_from_rest(0.004),
        }
    }

    fn tolerance(level: usize) -> f64 {
        10f64.powi(-3 - level as i32)
    }
}

#[cfg(feature = "run-up")]
impl Approximation for RunUp {
    fn name(&self) -> &'static str {
        use Integration::{Dop853, Radau5, Verner98};
        match (self.method, self.machine) {
            (Verner98, Machine::BareRotor) => "run-up-verner98-rotor",
            (Verner98, Machine::SandScreen) => "run-up-verner98-sand-screen",
            (Dop853, Machine::BareRotor) => "run-up-dop853-rotor",
            (Dop853, Machine::SandScreen) => "run-up-dop853-sand-screen",
            (Radau5, Machine::BareRotor) => "run-up-radau5-rotor",
            (Radau5, Machine::SandScreen) => "run-up-radau5-sand-screen",
        }
    }

    fn summary(&self) -> &'static str {
        match self.machine {
            Machine::BareRotor => "constant inertia from rest to its Kloss motor's speed",
            Machine::SandScreen => "the sand screen's first 4 ms under its Kloss motor",
        }
    }

    fn work_unit(&self) -> &'static str {
        "evaluations"
    }

    fn outputs(&self) -> Vec<(&'static str, Option<f64>)> {
        vec![("phi", None), ("psi", None)]
    }

    fn places(&self) -> String {
        let milliseconds = 1e3 * self.input().duration;
        format!("the error at the end of the run, at {milliseconds} ms, not along it")
    }

    fn levels(&self) -> Vec<String> {
        (0..11)
            .map(|k| format!("{:e}", RunUp::tolerance(k)))
            .collect()
    }

    fn is_regular(&self) -> bool {
        false
    }

    fn run(&self, level: usize) -> (u64, SolverAnswer) {
        run_up::at_tolerance(self.input(), RunUp::tolerance(level), self.method)
    }

    fn twin(&self, level: usize) -> Option<Vec<Ball>> {
        run_up::twin(self.input(), RunUp::tolerance(level), self.method)
    }

    fn twin_of_half_steps(&self, level: usize) -> Option<Vec<Ball>> {
        run_up::twin_of_half_steps(self.input(), RunUp::tolerance(level), self.method)
    }

    fn truth(&self) -> Result<Vec<Ball>, Uncertified> {
        let truth = || run_up::truth(self.input(), BITS);
        self.truth.get_or_init(truth).clone()
    }
}

#[cfg(test)]
mod tests;
