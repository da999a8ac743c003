//! The lower half-plane.

use super::{
    Theorem, boxes, head, line, nothing_within, opened, place, tell, up, versioned, watched,
};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use mechaudit::audit::hex_float;
use mechaudit::proof::Rectangle;
use mechaudit::proof::lower::{
    BY_HAND, LOWER_HALF_PLANE, Leaf, NOT_PROVED, Region, Theorem as Bounds, roots, theorem,
};
use mechaudit::report::text::style::{DIM, PLAIN};
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
    let seconds = begin.elapsed().as_secs_f64();
    let theorem = Lower {
        found,
        within,
        seconds,
    };
    tell(args, boxes, &[theorem], (json!({}), ""))
}

/// All that is known of w below the axis.
struct Lower {
    found: Bounds,
    within: Option<f64>,
    seconds: f64,
}

/// `Re z` and Im z, below the axis.
fn below(at: &Rectangle) -> String {
    place(at).replace(" + i ", " − i ")
}

impl Theorem for Lower {
    fn is_proved(&self) -> bool {
        self.found.open.is_empty()
    }

    fn columns(&self) -> String {
        "re_from,re_to,im_from,im_to,formula,norm".into()
    }

    /// Of rectangles on which one term dominates no bound: it is none of theirs.
    fn rows(&self, out: &mut dyn Write) -> Result<(), Failure> {
        for Leaf { at, region, norm } in &self.found.leaves {
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

    fn text(&self) -> String {
        let found = &self.found;
        let part = self.within.map_or(String::new(), |r| {
            format!(", |Re z| and |Im z| in the binades below {r}")
        });
        let theorem = [
            format!(
                "|faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for every finite f64 z with Im z < 0 where w does not overflow{part}:"
            ),
            format!("K = {}", up(found.norm)),
        ];
        let theorem = self.is_proved().then_some(&theorem[..]);
        let open = ("rectangles", &found.open[..]);
        let mut out = head("faddeeva, open lower half-plane", theorem, open, below);
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
        out += &line("In units of 2^-52; –: by an inequality, without rectangles");
        out += &line("From |z| = 2^960 on another 6 · 2^-1075 in each component: underflow");
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
            "{boxes} boxes, and {} of the exponential, {:.1} s",
            found.of_exponential, self.seconds
        ));
        out
    }

    fn document(&self) -> Value {
        let found = &self.found;
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
        versioned(json!({
            "function": "faddeeva",
            "part": "lower",
            "within": self.within,
            "proved": self.is_proved(),
            "norm": found.norm,
            "boxes_of_exponential": found.of_exponential,
            "zeros_apart": { "boxes": found.apart.boxes, "zeros": found.apart.zeros, "lines": found.apart.lines },
            "seconds": self.seconds,
            "formulas": formulas,
            "open": opened(&found.open, "box", ends),
            "by_hand": BY_HAND,
            "not_proved": NOT_PROVED,
        }))
    }
}

#[cfg(test)]
mod tests;
