//! Each crate's methods behind one signature.

use crate::TOLERANCES;
use crate::problems::{Dual, Problem};
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ImplicitRungeKutta};
use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, VectorCommon};
use mechaudit_solvers::initial_value::Dop853;
use ode_solvers::{OutputType, SVector, System};
use rustix::time::{ClockId, clock_gettime};
use std::cell::Cell;
use std::convert::Infallible;

/// A run that evaluates its right-hand side more often is given up, and so is one with as many
/// steps.
const MOST: u64 = 1_000_000;

thread_local! {
    /// Evaluations of the right-hand side.
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

fn rate<P: Problem<N>, const N: usize>(y: &[f64], out: &mut [f64]) {
    COUNT.with(|c| c.set(c.get() + 1));
    P::rate(y, out);
}

/// An integrator: the states at the end, or none where it gives up.
type Integrator<const N: usize> = fn(f64) -> Option<[f64; N]>;

/// Runs a method of `differential-equations`.
macro_rules! by_ivp {
    ($P:ident, $N:ident, $method:expr) => {{
        let f = |_: f64, y: &[f64; $N], out: &mut [f64; $N]| rate::<$P, $N>(y, out);
        let solved = IVP::ode_from_fn(f, 0.0, $P::END, $P::start())
            .method($method)
            .solve();
        let solution = solved.ok()?;
        (*solution.t.last()? == $P::END).then_some(*solution.y.last()?)
    }};
}

/// Runs every method at every tolerance.
pub fn run<P: Problem<N>, const N: usize>() {
    let explicit: [(&str, Integrator<N>); 7] = [
        ("mechaudit DOP853", mechaudit_dop853::<P, N>),
        ("ode_solvers DOPRI5", dopri5::<P, N>),
        ("ode_solvers DOP853", dop853::<P, N>),
        ("differential-equations DOPRI5", |t| {
            by_ivp!(
                P,
                N,
                ExplicitRungeKutta::dopri5()
                    .rtol(t)
                    .atol(t * 1e-3)
                    .max_steps(MOST as usize)
            )
        }),
        ("differential-equations DOP853", |t| {
            by_ivp!(
                P,
                N,
                ExplicitRungeKutta::dop853()
                    .rtol(t)
                    .atol(t * 1e-3)
                    .max_steps(MOST as usize)
            )
        }),
        ("differential-equations RKV988e", |t| {
            by_ivp!(
                P,
                N,
                ExplicitRungeKutta::rkv988e()
                    .rtol(t)
                    .atol(t * 1e-3)
                    .max_steps(MOST as usize)
            )
        }),
        ("diffsol TSIT45", tsit45::<P, N>),
    ];
    let implicit: [(&str, Integrator<N>); 3] = [
        ("differential-equations Radau5", radau5::<P, N>),
        ("diffsol BDF", bdf::<P, N>),
        ("diffsol ESDIRK34", esdirk34::<P, N>),
    ];
    for (name, method) in explicit.into_iter().chain(implicit) {
        for tolerance in TOLERANCES {
            report::<P, N>(name, tolerance, method);
        }
    }
}

/// The processor time of this thread in seconds; other work on the machine does not count.
fn processor_time() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn report<P: Problem<N>, const N: usize>(name: &str, tolerance: f64, method: Integrator<N>) {
    let mut best = f64::INFINITY;
    let mut found = None;
    for _ in 0..3 {
        COUNT.with(|c| c.set(0));
        let begun = processor_time();
        // Some crates panic where others return an error.
        found = std::panic::catch_unwind(|| method(tolerance))
            .ok()
            .flatten();
        best = best.min(processor_time() - begun);
        if found.is_none() || best > 5.0 {
            break;
        }
    }
    let head = format!("{},{name},{tolerance:e}", P::NAME);
    match found {
        Some(y) => {
            let states: Vec<String> = y.iter().map(|y| format!("{y:?}")).collect();
            let count = COUNT.with(Cell::get);
            println!("{head},{count},{best:.3e},{}", states.join(","));
        }
        None => println!("{head},,"),
    }
}

fn mechaudit_dop853<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
    let mut f = |_: f64, y: &[f64], out: &mut [f64]| {
        rate::<P, N>(y, out);
        Ok::<(), Infallible>(())
    };
    let mut solution = Dop853::new(0.0, &P::start(), tolerance);
    while solution.t() < P::END {
        solution.step(P::END, &mut f).ok()?;
        if solution.evaluations() > MOST {
            return None;
        }
    }
    solution.y().try_into().ok()
}

struct Rates<P, const N: usize>(std::marker::PhantomData<P>);

impl<P: Problem<N>, const N: usize> System<f64, SVector<f64, N>> for Rates<P, N> {
    fn system(&self, _: f64, y: &SVector<f64, N>, out: &mut SVector<f64, N>) {
        rate::<P, N>(y.as_slice(), out.as_mut_slice());
    }
}

/// A run of one of the methods of `ode_solvers`.
macro_rules! by_stepper {
    ($name:ident, $method:ident) => {
        fn $name<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
            let system = Rates::<P, N>(std::marker::PhantomData);
            let start = SVector::from(P::start());
            let absolute = tolerance * 1e-3;
            let mut stepper =
                ode_solvers::$method::new(system, 0.0, P::END, P::END, start, tolerance, absolute);
            stepper.set_output(OutputType::Sparse);
            stepper.integrate().ok()?;
            Some((*stepper.y_out().last()?).into())
        }
    };
}

by_stepper!(dopri5, Dopri5);
by_stepper!(dop853, Dop853);

fn radau5<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
    by_ivp!(
        P,
        N,
        ImplicitRungeKutta::radau5()
            .rtol(tolerance)
            .atol(tolerance * 1e-3)
    )
}

/// Solves by a method of `diffsol`.
macro_rules! by_diffsol {
    ($P:ident, $N:ident, $tolerance:ident, $method:ident $(, $solver:ty)?) => {{
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol($tolerance)
            .atol([$tolerance * 1e-3])
            .rhs_implicit(
                |y: &[f64], _: &[f64], _: f64, out: &mut [f64]| rate::<$P, $N>(y, out),
                |y: &[f64], _: &[f64], _: f64, v: &[f64], out: &mut [f64]| {
                    let mut both = [Dual(0.0, 0.0); $N];
                    let mut rates = both;
                    for i in 0..$N {
                        both[i] = Dual(y[i], v[i]);
                    }
                    $P::rate(&both, &mut rates);
                    for i in 0..$N {
                        out[i] = rates[i].1;
                    }
                },
            )
            .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&$P::start()), $N)
            .build()
            .ok()?;
        let mut solver = problem.$method$(::<$solver>)?().ok()?;
        solver.set_stop_time($P::END).ok()?;
        loop {
            match solver.step() {
                Ok(diffsol::OdeSolverStopReason::TstopReached) => break,
                Ok(_) if COUNT.with(Cell::get) <= MOST => (),
                _ => return None,
            }
        }
        let state = solver.state();
        let mut end = [0.0; $N];
        end.copy_from_slice(state.y.inner().as_slice());
        Some(end)
    }};
}

fn tsit45<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
    by_diffsol!(P, N, tolerance, tsit45)
}

fn bdf<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
    by_diffsol!(P, N, tolerance, bdf, NalgebraLU<f64>)
}

fn esdirk34<P: Problem<N>, const N: usize>(tolerance: f64) -> Option<[f64; N]> {
    by_diffsol!(P, N, tolerance, esdirk34, NalgebraLU<f64>)
}
