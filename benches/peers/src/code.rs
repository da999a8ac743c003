//! The interface of every compared code.

use num_complex::Complex64;
use std::time::Duration;

/// How a code takes its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// One value a call.
    Scalar,
    /// A slice of complex numbers a call.
    Batch,
    /// Slices of real and imaginary parts a call.
    Soa,
}

/// A code that computes W(z).
pub trait Code: Send + Sync {
    /// Its name in the tables.
    fn name(&self) -> &str;
    /// Version, where it came from.
    fn version(&self) -> &str;
    /// How it takes its points.
    fn shape(&self) -> Shape;
    /// Returns true if it is this project's.
    fn own(&self) -> bool {
        false
    }
    /// Computes all values. `out` has the length of `z`.
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]);
    /// The time that [`Code::evaluate`] takes, without what only this program needs (copies into
    /// another layout, transport to another process).
    fn time(&self, z: &[Complex64], out: &mut [Complex64]) -> Duration {
        timed(|| self.evaluate(z, out))
    }
}

/// The processor time of this thread that `f` takes: what other programs use of the core in
/// between is not counted.
#[cfg(unix)]
pub fn timed(f: impl FnOnce()) -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    let now = || {
        let t = clock_gettime(ClockId::ThreadCPUTime);
        Duration::new(t.tv_sec.unsigned_abs(), t.tv_nsec as u32)
    };
    let start = now();
    f();
    now().saturating_sub(start)
}

/// The wall time that `f` takes.
#[cfg(not(unix))]
pub fn timed(f: impl FnOnce()) -> Duration {
    let start = std::time::Instant::now();
    f();
    start.elapsed()
}

/// A code of which there is a function for one value.
pub struct Scalar<F> {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// True if it is this project's.
    pub own: bool,
    /// The function.
    pub w: F,
}

impl<F: Fn(Complex64) -> Complex64 + Send + Sync> Code for Scalar<F> {
    fn name(&self) -> &str {
        &self.name
    }
    fn version(&self) -> &str {
        &self.version
    }
    fn shape(&self) -> Shape {
        Shape::Scalar
    }
    fn own(&self) -> bool {
        self.own
    }
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]) {
        for (w, &z) in out.iter_mut().zip(z) {
            *w = (self.w)(z);
        }
    }
}

/// A code that could not be compared, and why.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Missing {
    /// Its name.
    pub name: String,
    /// The reason, and what to do about it.
    pub reason: String,
}

/// The codes found and those missing.
#[derive(Default)]
pub struct Codes {
    /// In the order of the tables.
    pub found: Vec<Box<dyn Code>>,
    /// Codes that were looked for and not found.
    pub missing: Vec<Missing>,
}

impl Codes {
    /// Adds what was found or why it is missing.
    pub fn add(&mut self, name: &str, outcome: Result<Box<dyn Code>, String>) {
        match outcome {
            Ok(code) => self.found.push(code),
            Err(reason) => self.missing.push(Missing {
                name: name.to_owned(),
                reason,
            }),
        }
    }
}
