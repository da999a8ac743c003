//! The solvers against certified values, without GMP or MPFR: `tests/solver_values/`.
//!
//! Every line of a file is an input, the values to 20 digits by the certified reference and what
//! each may be off by; `tests/library/solver_values_written.rs` writes them. Each value is asked for on all
//! paths there are: one point, batches, all cores.
//!
//! These are unit tests of the lean build, not a target in `tests/`, so that a mutant is compiled
//! once (`tests/mutants.md`).

mod chart;
mod chirps;
mod drives;
mod dyads;
mod faddeeva;
mod laws;
mod linkages;
mod motion;
mod planar;
mod spline_edges;
mod splines;
mod stability;
mod systems;

/// What a solver says: values, or the word of its refusal.
type Answer = Result<Vec<f64>, String>;

/// A way through a solver, with its name.
type Path<'a> = (&'a str, &'a dyn Fn(&[f64]) -> Answer);

/// A line of a file.
struct Line {
    place: String,
    input: Vec<f64>,
    /// The values, each with what it may be off by; or the word of the refusal.
    due: Result<Vec<(f64, f64)>, String>,
}

fn numbers(text: &str) -> Vec<f64> {
    let number = |t: &str| t.parse().unwrap_or_else(|e| panic!("{t:?}: {e}"));
    text.split_whitespace().map(number).collect()
}

fn lines(method: &str) -> Vec<Line> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/solver_values");
    let text = std::fs::read_to_string(format!("{folder}/{method}.csv")).expect("a file");
    let (header, rest) = text.split_once('\n').expect("a header");
    assert_eq!(header, "place,input,value,allowed");
    let all: Vec<Line> = rest.lines().map(line).collect();
    assert!(!all.is_empty(), "{method} has no values");
    all
}

fn line(text: &str) -> Line {
    let fields: Vec<&str> = text.split(',').collect();
    let [place, input, value, allowed] = fields[..] else {
        panic!("{text:?} has not four columns");
    };
    let due = match value.strip_prefix("refused: ") {
        Some(word) => Err(word.into()),
        None => {
            let (values, allowed) = (numbers(value), numbers(allowed));
            assert_eq!(values.len(), allowed.len(), "{place}");
            Ok(values.into_iter().zip(allowed).collect())
        }
    };
    Line {
        place: place.into(),
        input: numbers(input),
        due,
    }
}

/// Half a unit in the last place: what the recorded value lost when it was read.
fn half_ulp(x: f64) -> f64 {
    let x = x.abs().min(f64::MAX.next_down());
    (x.next_up() - x) / 2.0
}

fn close(got: f64, (due, allowed): (f64, f64)) -> bool {
    match due {
        _ if due.is_nan() => got.is_nan(),
        _ if due.is_infinite() => {
            got == due || got.abs() == f64::MAX && got.signum() == due.signum()
        }
        _ => (got - due).abs() <= allowed + half_ulp(due),
    }
}

/// Whether the values are the ones that are due.
fn fits(due: &[(f64, f64)], got: &[f64]) -> bool {
    due.len() == got.len() && got.iter().zip(due).all(|(g, d)| close(*g, *d))
}

impl Line {
    fn check(&self, path: &str, answer: &Answer) {
        let right = match (&self.due, answer) {
            (Ok(due), Ok(got)) => fits(due, got),
            (Err(word), Err(got)) => word == got,
            _ => false,
        };
        let Line { place, input, due } = self;
        assert!(
            right,
            "{path} at {place}, {input:?}:\ndue {due:?}\ngot {answer:?}"
        );
    }
}

/// Holds every path to every line of a file.
fn hold(method: &str, paths: &[Path]) {
    for line in lines(method) {
        for (name, path) in paths {
            line.check(&format!("{method}, {name},"), &path(&line.input));
        }
    }
}

/// Whether two numbers are the same number, zeros with their signs.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn a_planted_fault_is_found() {
    let line = line("x,1.0 2.0,0.33333333333333333333 inf nan,1e-16 0 0");
    let due = line.due.as_ref().expect("values");
    let (third, inf, nan) = (1.0 / 3.0, f64::INFINITY, f64::NAN);
    assert!(fits(due, &[third, inf, nan]));
    assert!(!fits(due, &[third, inf]));
    assert!(!fits(due, &[third + 3e-16, inf, nan]));
    assert!(!fits(due, &[nan, inf, nan]));
    assert!(!fits(due, &[third, -inf, nan]));
    assert!(!fits(due, &[third, inf, 0.0]));
    assert!(close(f64::MAX, (inf, 0.0)) && !close(1e308, (inf, 0.0)));
}
