//! The lower half-plane.

use super::{boxes, nothing_within, place, up, watched};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::print_as;
use mechaudit::audit::hex_float;
use mechaudit::proof::Rectangle;
use mechaudit::proof::lower::{
    BY_HAND, LOWER_HALF_PLANE, Leaf, NOT_PROVED, Region, Theorem, roots, theorem,
};
use mechaudit::report::text::style::{BAD, BOLD, DIM, PLAIN, paint};
use mechaudit::report::text::table::Table;
use serde_json::{Value, json};
use std::io::Write;
use std::time::Instant;

/// Proves, and prints what is proved and what is not.
pub fn prove(args: &ProveArgs) -> Result<Outcome, Failure> {
    let others = [
        ("--norm", args.norm.is_some()),
        ("--component", args.component.is_some()),
    ];
    if let Some((option, _)) = others.into_iter().find(|o| o.1) {
        let why = "is for the upper half-plane: below the axis targets are fixed";
        return Err(Failure::new(format!("{option} {why}")));
    }
    let within = args.within;
    if !roots().iter().any(|r| r.is_below(within)) {
        return Err(nothing_within(within));
    }
    let boxes = boxes(args)?;
    let begin = Instant::now();
    let found = watched("faddeeva", false, move |watch| {
        theorem(LOWER_HALF_PLANE, within, watch)
    })?;
    let Some(found) = found else {
        return Ok(Outcome::Interrupted);
    };
    if let Some(output) = boxes {
        output.write(|out| write_boxes(&found, out))?;
    }
    let seconds = begin.elapsed().as_secs_f64();
    print_as(
        args.format,
        || text(&found, within, seconds),
        || document(&found, within, seconds),
    )?;
    Ok(Outcome::of(found.open.is_empty()))
}

/// Of rectangles on which one term dominates no bound: it is none of theirs.
fn write_boxes(found: &Theorem, out: &mut dyn Write) -> Result<(), Failure> {
    writeln!(out, "re_from,re_to,im_from,im_to,formula,norm")?;
    for Leaf { at, region, norm } in &found.leaves {
        let [p, q, r, s] = [at.a[0], at.a[1], -at.b[1], -at.b[0]].map(hex_float);
        let name = region.name().replace(", ", " ");
        let norm = match region {
            Region::Dominated => String::new(),
            _ => hex_float(*norm),
        };
        writeln!(out, "{p},{q},{r},{s},{name},{norm}")?;
    }
    Ok(())
}

/// `Re z` and Im z, below the axis.
fn below(at: &Rectangle) -> String {
    place(at).replace(" + i ", " − i ")
}

fn text(found: &Theorem, within: Option<f64>, seconds: f64) -> String {
    let mut out = format!("{}\n", paint(BOLD, "faddeeva, open lower half-plane"));
    let line = |text: String| format!("  {text}\n");
    if found.open.is_empty() {
        let part = within.map_or(String::new(), |r| {
            format!(", |Re z| and |Im z| in the binades below {r}")
        });
        out += &line(format!(
            "|faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for every finite f64 z with Im z < 0 where w does not overflow{part}:"
        ));
        out += &line(format!("K = {}", up(found.norm)));
    } else {
        let text = format!("not proved: {} rectangles are open", found.open.len());
        out += &line(paint(BAD, &text));
        for open in found.open.iter().take(5) {
            out += &line(format!("{}: {}", below(&open.at), open.why));
        }
    }
    let mut table = Table::new(&["formula", "boxes", "norm", "attained in"], &[0, 3]);
    for r in &found.regions {
        table.row(vec![
            (r.name.to_string(), PLAIN),
            (r.boxes.to_string(), DIM),
            (up(r.norm), PLAIN),
            (r.at.as_ref().map_or_else(|| "–".into(), below), DIM),
        ]);
    }
    out += &table.render(2);
    out += &line("In units of 2^-52; –: by an inequality, without rectangles".into());
    out += &line("From |z| = 2^960 on another 6 · 2^-1075 in each component: underflow".into());
    out += &line(format!("By hand: {BY_HAND}"));
    for what in NOT_PROVED {
        out += &line(format!("Not proved: {what}"));
    }
    let boxes: usize = found.regions.iter().map(|r| r.boxes).sum();
    let apart = &found.apart;
    out += &line(format!(
        "No zero is next to an f64: {} boxes, {} zeros, {} lines",
        apart.boxes, apart.zeros, apart.lines
    ));
    out += &line(format!(
        "{boxes} boxes, and {} of the exponential, {seconds:.1} s",
        found.of_exponential
    ));
    out
}

fn document(found: &Theorem, within: Option<f64>, seconds: f64) -> Value {
    let ends = |at: &Rectangle| json!({ "re": at.a, "minus_im": at.b });
    let formulas: Vec<Value> = found
        .regions
        .iter()
        .map(|r| {
            json!({
                "formula": r.name,
                "boxes": r.boxes,
                "norm": r.norm,
                "box": r.at.as_ref().map(ends),
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
        "part": "lower",
        "within": within,
        "proved": found.open.is_empty(),
        "norm": found.norm,
        "boxes_of_exponential": found.of_exponential,
        "zeros_apart": { "boxes": found.apart.boxes, "zeros": found.apart.zeros, "lines": found.apart.lines },
        "seconds": seconds,
        "formulas": formulas,
        "open": open,
        "by_hand": BY_HAND,
        "not_proved": NOT_PROVED,
    })
}

#[cfg(test)]
mod tests;
