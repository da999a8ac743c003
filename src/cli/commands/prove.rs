//! Proofs of error bounds.

mod lower;
mod real;
mod study;
#[cfg(test)]
mod tests;
mod upper;

use crate::cli::args::{Part, ProveArgs};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print_as};
use crate::cli::forecast;
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use mechaudit::proof::real::Function;
use mechaudit::proof::{MOST_PARTS, Open, ProofError, Rectangle, Watch};
use mechaudit::report::text::style::{BAD, BOLD, paint};
use serde_json::{Value, json};
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Proves, and prints what is proved.
pub fn prove(args: &ProveArgs) -> Result<Outcome, Failure> {
    if mechaudit::study::is_path(&args.function) {
        return study::prove(args);
    }
    let of_studies = [
        ("--solver", args.solver.is_some()),
        ("--target", args.target.is_some()),
        ("--together", args.together.is_some()),
        ("--round-inputs", args.round_inputs),
        ("--correctly-rounded", args.correctly_rounded),
    ];
    if let Some((name, _)) = of_studies.into_iter().find(|(_, given)| *given) {
        return Err(Failure::new(format!("{name} is for studies alone")));
    }
    if let Some(function) = Function::ALL
        .into_iter()
        .find(|f| f.name() == args.function)
    {
        return real::prove(&[function], args);
    }
    match args.part {
        Some(Part::Lower) => lower::prove(args),
        Some(Part::Real) => real::prove(&Function::ALL, args),
        Some(Part::Upper) | None => upper::prove(args),
    }
}

/// The result of a proof: its report and its file of boxes.
trait Theorem {
    fn is_proved(&self) -> bool;
    fn text(&self) -> String;
    fn document(&self) -> Value;
    /// The first line of the file of boxes.
    fn columns(&self) -> String;
    fn rows(&self, out: &mut dyn Write) -> Result<(), Failure>;
}

/// Writes the boxes of theorems and prints the report; `several` is what the document of more than
/// one begins with, and its key for each.
fn tell<T: Theorem>(
    args: &ProveArgs,
    boxes: Option<Output>,
    theorems: &[T],
    several: (Value, &str),
) -> Result<Outcome, Failure> {
    let proved = theorems.iter().all(T::is_proved);
    if let Some(output) = boxes {
        output.write(|out| write_boxes(theorems, out))?;
    }
    let text = || theorems.iter().map(T::text).collect();
    print_as(args.format, text, || match theorems {
        [one] => one.document(),
        all => {
            let mut v = versioned(several.0);
            v["proved"] = json!(proved);
            v[several.1] = all.iter().map(T::document).collect();
            v
        }
    })?;
    Ok(Outcome::of(proved))
}

fn write_boxes<T: Theorem>(theorems: &[T], out: &mut dyn Write) -> Result<(), Failure> {
    let columns = theorems.first().map_or(String::new(), T::columns);
    writeln!(out, "{columns}")?;
    theorems.iter().try_for_each(|t| t.rows(out))
}

/// A document that begins with its version.
fn versioned(body: Value) -> Value {
    let mut v = json!({ "schema_version": 1, "mechaudit_version": env!("CARGO_PKG_VERSION") });
    if let (Value::Object(all), Value::Object(more)) = (&mut v, body) {
        all.extend(more);
    }
    v
}

fn line(text: impl AsRef<str>) -> String {
    format!("  {}\n", text.as_ref())
}

/// The title, then the theorem where it is proved, else how many parts are open and the first of
/// them.
fn head<P>(
    title: &str,
    theorem: Option<&[String]>,
    (what, open): (&str, &[Open<P>]),
    place: impl Fn(&P) -> String,
) -> String {
    let mut out = format!("{}\n", paint(BOLD, title));
    match theorem {
        Some(lines) => out.extend(lines.iter().map(line)),
        None => {
            let text = format!("not proved: {} {what} are open", open.len());
            out += &line(paint(BAD, &text));
            let first = open.iter().take(5);
            out.extend(first.map(|o| line(format!("{}: {}", place(&o.at), o.why))));
        }
    }
    out
}

/// The parts that are open, each under a key.
fn opened<P>(open: &[Open<P>], key: &str, ends: impl Fn(&P) -> Value) -> Vec<Value> {
    let all = open.iter();
    all.map(|o| json!({ key: ends(&o.at), "why": o.why }))
        .collect()
}

/// The file of boxes, if one is asked for.
fn boxes(args: &ProveArgs) -> Result<Option<Output>, Failure> {
    let path = args.boxes.as_deref();
    path.map(|p| Output::open(Some(p))).transpose()
}

/// No rectangle of the partition lies within the limit.
fn nothing_within(within: Option<f64>) -> Failure {
    let within = within.unwrap_or(f64::INFINITY);
    Failure::new(format!(
        "--within {within:e}: no rectangle lies below it; take a larger number"
    ))
}

/// The time that a proof with a closer target runs before an upper bound of its time is printed.
const TRIAL: Duration = Duration::from_secs(2);

/// A proof on a thread of its own, watched; nothing if the user ends it. One with a target that is
/// closer than the default may never end by itself.
fn watched<T: Send + 'static>(
    name: &str,
    closer: bool,
    proof: impl FnOnce(&Watch) -> Result<Option<T>, ProofError> + Send + 'static,
) -> Result<Option<T>, Failure> {
    let watch = Arc::new(Watch::default());
    let (working, ended) = channel::<()>();
    let worker = std::thread::spawn({
        let watch = watch.clone();
        move || {
            let _working = working;
            proof(&watch)
        }
    });
    let progress = Progress::new();
    let stop = interrupt::flag();
    let begin = Instant::now();
    let mut told = !closer;
    // Nothing is sent: it is disconnected once the proof has ended.
    while ended.recv_timeout(interrupt::POLL) == Err(RecvTimeoutError::Timeout) {
        if stop.load(Ordering::Relaxed) {
            watch.stop.store(true, Ordering::Relaxed);
        }
        if let Some((done, of)) = reached(&watch) {
            progress.show(name, done, of);
        }
        if !told && begin.elapsed() > TRIAL {
            told = true;
            complain(&at_most(name, &watch, begin.elapsed().as_secs_f64()));
        }
    }
    progress.clear();
    match worker.join() {
        Ok(Ok(None)) if watch.is_spent() => Err(Failure::new(format!(
            "{name}: given up after {:e} rectangles or intervals, with {} of {} parts done: take a larger target",
            MOST_PARTS as f64,
            watch.done.load(Ordering::Relaxed),
            watch.of.load(Ordering::Relaxed),
        ))),
        Ok(found) => found.map_err(Failure::caused),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// Says what a proof takes at most, by the parts it has looked at in these seconds.
fn at_most(name: &str, watch: &Watch, seconds: f64) -> String {
    let looked_at = watch.looked_at.load(Ordering::Relaxed).max(1) as f64;
    format!(
        "{name}: the target is closer than the default; it takes {:e} rectangles or intervals at most, about {}",
        MOST_PARTS as f64,
        forecast::time(MOST_PARTS as f64 / looked_at * seconds)
    )
}

/// Returns the number of parts done and of all parts, if there are some.
fn reached(watch: &Watch) -> Option<(u64, u64)> {
    let [done, of] = [&watch.done, &watch.of].map(|n| n.load(Ordering::Relaxed));
    (of > 0).then_some((done, of))
}

fn place(at: &Rectangle) -> String {
    let ends = |[lo, hi]: [f64; 2]| format!("[{lo:.4e}, {hi:.4e}]");
    format!("{} + i {}", ends(at.a), ends(at.b))
}

/// A bound, rounded up to three places.
fn up(x: f64) -> String {
    format!("{:.3}", (x * 1000.0).next_up().ceil() / 1000.0)
}
