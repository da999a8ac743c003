//! The solvers against certified values, without GMP or MPFR.
//!
//! The values are those of `reference/values/`; `tests/solver_values/allowed.csv` says how far off
//! each of them a solver may be. `tests/solver_values/special.csv` has more points of the Faddeeva
//! family, with both. Each value is asked for on all paths there are: one point, batches, all
//! cores. `tests/library/solver_values.rs` writes the allowances.
//!
//! These are unit tests of the lean build, not a target in `tests/`, so that a mutant is compiled
//! once (`tests/mutants.md`).

mod drives;
mod faddeeva;
mod linkages;
mod motion;
mod planar;
mod spline_edges;
mod splines;
mod stability;
mod systems;

/// Describes what a solver says: values, or the word of its refusal.
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

/// A decimal, or a hexadecimal float such as `-0x1.8p-3`.
fn number(text: &str) -> f64 {
    match text.contains("0x") {
        true => crate::hex::hex(text),
        false => text.parse().unwrap_or_else(|e| panic!("{text:?}: {e}")),
    }
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(number).collect()
}

/// The lines of a file below its comments and its header.
fn body(file: &str, header: &str) -> String {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let text = std::fs::read_to_string(format!("{root}/{file}")).expect("a file");
    let start = text.find(header).expect("the columns");
    text[start + header.len()..].trim_start().to_owned()
}

/// All lines of a method: those of `reference/values/`, then those of the Faddeeva family's own
/// file.
fn lines(method: &str) -> Vec<Line> {
    let values = body(
        &format!("reference/values/{method}.csv"),
        "region,case,input,value,radius,condition",
    );
    let allowed = body(
        "tests/solver_values/allowed.csv",
        "method,region,case,allowed",
    );
    let special = body(
        "tests/solver_values/special.csv",
        "place,input,value,allowed",
    );
    let start = format!("{method},");
    let mut allowed = allowed.lines().filter_map(|l| l.strip_prefix(&start));
    let certified = values.lines().map(|text| {
        let fields: Vec<&str> = text.split(',').collect();
        let [region, case, input, value, radius, _] = fields[..] else {
            panic!("{text:?} has not six columns");
        };
        let place = format!("{region},{case}");
        let own = allowed.next().and_then(|l| l.strip_prefix(&place));
        let own = own.and_then(|l| l.strip_prefix(','));
        let own = own.unwrap_or_else(|| {
            panic!("{method} at {place} has no allowance: `solver_values::write` writes it")
        });
        let mut line = line([&place, input, value, own]);
        // The value itself is only so well known.
        let due = line.due.iter_mut().flatten();
        let radii = numbers(radius);
        due.zip(radii).for_each(|(due, radius)| due.1 += radius);
        line
    });
    let mut all: Vec<Line> = certified.collect();
    assert!(!all.is_empty(), "{method} has no values");
    all.extend(special.lines().filter_map(|text| {
        let fields: Vec<&str> = text.split(',').collect();
        let fields: [&str; 4] = fields.try_into().expect("four columns");
        let (name, _) = fields[0].rsplit_once('-').expect("a method and a number");
        (name == method).then(|| line(fields))
    }));
    all
}

fn line([place, input, value, allowed]: [&str; 4]) -> Line {
    let due = match value.strip_prefix("refuse ") {
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

/// Returns whether the values are the ones that are due.
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

/// Returns whether two numbers are the same number, zeros with their signs.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn a_planted_fault_is_found() {
    let line = line([
        "x",
        "1.0 2.0",
        "0.33333333333333333333 inf nan",
        "1e-16 0 0",
    ]);
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
