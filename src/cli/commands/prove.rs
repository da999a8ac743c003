//! Proofs of error bounds.

mod lower;
mod real;
mod study;
#[cfg(test)]
mod tests;

use crate::cli::args::{Part, ProveArgs};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print_as};
use crate::cli::forecast;
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use mechaudit::audit::hex_float;
use mechaudit::proof::real::Function;
use mechaudit::proof::{
    Attained, Certificate, Code, Leaf, MOST_PARTS, ProofError, Rectangle, Summary, Target,
    UPPER_HALF_PLANE, Watch, first_rectangles, upper_half_plane,
};
use mechaudit::report::text::style::{BAD, BOLD, DIM, PLAIN, paint};
use mechaudit::report::text::table::Table;
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
        Some(Part::Lower) => return lower::prove(args),
        Some(Part::Real) => return real::prove(&Function::ALL, args),
        Some(Part::Upper) | None => {}
    }
    if first_rectangles(args.within).is_empty() {
        return Err(nothing_within(args.within));
    }
    let boxes = boxes(args)?;
    let begin = Instant::now();
    let target = Target {
        norm: args.norm.unwrap_or(UPPER_HALF_PLANE.norm),
        component: args.component.unwrap_or(UPPER_HALF_PLANE.component),
        ..UPPER_HALF_PLANE
    };
    let closer =
        target.norm < UPPER_HALF_PLANE.norm || target.component < UPPER_HALF_PLANE.component;
    let Some(found) = proved(target, closer, args.within)? else {
        return Ok(Outcome::Interrupted);
    };
    if let Some(output) = boxes {
        output.write(|out| write_boxes(&found, out))?;
    }
    let summary = found
        .summary()
        .ok_or_else(|| Failure::new("nothing was proved"))?;
    let seconds = begin.elapsed().as_secs_f64();
    print_as(
        args.format,
        || text(&found, &summary, args.within, seconds),
        || document(&found, &summary, args.within, seconds),
    )?;
    Ok(Outcome::of(found.open.is_empty()))
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

/// The closed upper half-plane; nothing if the user ends it.
fn proved(
    target: Target,
    closer: bool,
    within: Option<f64>,
) -> Result<Option<Certificate>, Failure> {
    watched("faddeeva", closer, move |watch| {
        let code = Code::of_the_solver()?;
        Ok(upper_half_plane(&code, target, watch, |_, r| {
            r.is_below(within)
        }))
    })
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

fn write_boxes(found: &Certificate, out: &mut dyn Write) -> Result<(), Failure> {
    writeln!(
        out,
        "re_from,re_to,im_from,im_to,formula,centre_re,centre_im,norm,re,im,tiny"
    )?;
    for Leaf { at, formula, bound } in &found.leaves {
        let [p, q, r, s] = [at.a[0], at.a[1], at.b[0], at.b[1]].map(hex_float);
        let centre = formula.centre().map(|(x, y)| [x, y].map(hex_float));
        let [x, y] = centre.unwrap_or_default();
        let [norm, re, im, tiny] = [bound.norm, bound.re, bound.im, bound.tiny].map(hex_float);
        let name = formula.name().replace(", ", " ");
        writeln!(
            out,
            "{p},{q},{r},{s},{name},{x},{y},{norm},{re},{im},{tiny}"
        )?;
    }
    Ok(())
}

fn place(at: &Rectangle) -> String {
    let ends = |[lo, hi]: [f64; 2]| format!("[{lo:.4e}, {hi:.4e}]");
    format!("{} + i {}", ends(at.a), ends(at.b))
}

/// A bound, rounded up to three places.
fn up(x: f64) -> String {
    format!("{:.3}", (x * 1000.0).next_up().ceil() / 1000.0)
}

fn text(found: &Certificate, summary: &Summary, within: Option<f64>, seconds: f64) -> String {
    let mut out = format!("{}\n", paint(BOLD, "faddeeva, closed upper half-plane"));
    let line = |text: String| format!("  {text}\n");
    if found.open.is_empty() {
        let inputs = match within {
            None => "every finite f64 z with Im z ≥ 0".to_string(),
            Some(r) => {
                let most = if r < 1e6 {
                    r.to_string()
                } else {
                    format!("{r:e}")
                };
                format!("every f64 z with Im z ≥ 0, |Re z| and Im z in the binades below {most}")
            }
        };
        out += &line(format!(
            "|faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for {inputs}: K = {}",
            up(summary.norm.bound)
        ));
        out += &line(match &summary.component {
            Some(c) if c.bound.is_finite() => format!(
                "each component within C units in its last place, C = {}, attained in {}",
                up(c.bound),
                place(&c.at)
            ),
            _ => "no bound of the components".into(),
        });
    } else {
        let text = format!("not proved: {} rectangles are open", found.open.len());
        out += &line(paint(BAD, &text));
        for open in found.open.iter().take(5) {
            out += &line(format!("{}: {}", place(&open.at), open.why));
        }
    }
    out += &line(format!("K is attained in {}", place(&summary.norm.at)));
    let mut table = Table::new(&["formula", "boxes", "norm", "Re", "Im"], &[0]);
    let part = |a: Option<Attained>| match a {
        Some(a) => (up(a.bound), PLAIN),
        None => ("–".into(), DIM),
    };
    for f in &summary.formulas {
        table.row(vec![
            (f.name.to_string(), PLAIN),
            (f.boxes.to_string(), DIM),
            (up(f.norm.bound), PLAIN),
            part(f.re),
            part(f.im),
        ]);
    }
    out += &table.render(2);
    out += &line(
        "Norm in units of 2^-52, components in units in the last place; –: not proved".into(),
    );
    out += &line(format!(
        "A component below 2^-960 in absolute value may be off by another {} · 2^-1075: underflow",
        up(summary.tiny)
    ));
    out += &line(format!("{} boxes, {seconds:.1} s", summary.boxes));
    out
}

fn document(found: &Certificate, summary: &Summary, within: Option<f64>, seconds: f64) -> Value {
    let ends = |at: &Rectangle| json!({ "re": at.a, "im": at.b });
    let attained = |a: &Attained| json!({ "bound": a.bound, "box": ends(&a.at) });
    let formulas: Vec<Value> = summary
        .formulas
        .iter()
        .map(|f| {
            json!({
                "formula": f.name,
                "boxes": f.boxes,
                "norm": attained(&f.norm),
                "re": f.re.as_ref().map(attained),
                "im": f.im.as_ref().map(attained),
                "tiny": f.tiny,
            })
        })
        .collect();
    let open: Vec<Value> = found
        .open
        .iter()
        .map(|o| json!({ "box": ends(&o.at), "why": o.why }))
        .collect();
    json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "function": "faddeeva",
        "part": "upper",
        "within": within,
        "proved": found.open.is_empty(),
        "norm": attained(&summary.norm),
        "component": summary.component.as_ref().map(attained),
        "tiny": summary.tiny,
        "boxes": summary.boxes,
        "seconds": seconds,
        "formulas": formulas,
        "open": open,
    })
}
