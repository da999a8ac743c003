//! The closed upper half-plane.

use super::{
    Theorem, boxes, head, line, nothing_within, opened, place, tell, up, versioned, watched,
};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use mechaudit::audit::hex_float;
use mechaudit::proof::{
    Attained, Certificate, Code, Leaf, Rectangle, Summary, Target, UPPER_HALF_PLANE,
    first_rectangles, upper_half_plane,
};
use mechaudit::report::text::style::{DIM, PLAIN};
use mechaudit::report::text::table::Table;
use serde_json::{Value, json};
use std::io::Write;
use std::time::Instant;

/// Proves, and prints what is proved.
pub fn prove(args: &ProveArgs) -> Result<Outcome, Failure> {
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
    let Some(found) = proved(target, args.within)? else {
        return Ok(Outcome::Interrupted);
    };
    let theorem = Upper::new(found, args.within, begin.elapsed().as_secs_f64())?;
    tell(args, boxes, &[theorem], (json!({}), ""))
}

/// The closed upper half-plane; nothing if the user ends it.
pub(super) fn proved(target: Target, within: Option<f64>) -> Result<Option<Certificate>, Failure> {
    let closer =
        target.norm < UPPER_HALF_PLANE.norm || target.component < UPPER_HALF_PLANE.component;
    watched("faddeeva", closer, move |watch| {
        let code = Code::of_the_solver()?;
        Ok(upper_half_plane(&code, target, watch, |_, r| {
            r.is_below(within)
        }))
    })
}

/// All that is known of w above the axis.
pub(super) struct Upper {
    found: Certificate,
    summary: Summary,
    within: Option<f64>,
    seconds: f64,
}

impl Upper {
    pub fn new(found: Certificate, within: Option<f64>, seconds: f64) -> Result<Upper, Failure> {
        let summary = found
            .summary()
            .ok_or_else(|| Failure::new("nothing was proved"))?;
        Ok(Upper {
            found,
            summary,
            within,
            seconds,
        })
    }
}

impl Theorem for Upper {
    fn is_proved(&self) -> bool {
        self.found.open.is_empty()
    }

    fn columns(&self) -> String {
        "re_from,re_to,im_from,im_to,formula,centre_re,centre_im,norm,re,im,tiny".into()
    }

    fn rows(&self, out: &mut dyn Write) -> Result<(), Failure> {
        for Leaf { at, formula, bound } in &self.found.leaves {
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

    fn text(&self) -> String {
        let (summary, within) = (&self.summary, self.within);
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
        let theorem = [
            format!(
                "|faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for {inputs}: K = {}",
                up(summary.norm.bound)
            ),
            match &summary.component {
                Some(c) if c.bound.is_finite() => format!(
                    "each component within C units in its last place, C = {}, attained in {}",
                    up(c.bound),
                    place(&c.at)
                ),
                _ => "no bound of the components".into(),
            },
        ];
        let theorem = self.is_proved().then_some(&theorem[..]);
        let open = ("rectangles", &self.found.open[..]);
        let mut out = head("faddeeva, closed upper half-plane", theorem, open, place);
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
        out +=
            &line("Norm in units of 2^-52, components in units in the last place; –: not proved");
        out += &line(format!(
            "A component below 2^-960 in absolute value may be off by another {} · 2^-1075: underflow",
            up(summary.tiny)
        ));
        out += &line(format!("{} boxes, {:.1} s", summary.boxes, self.seconds));
        out
    }

    fn document(&self) -> Value {
        let ends = |at: &Rectangle| json!({ "re": at.a, "im": at.b });
        let attained = |a: &Attained| json!({ "bound": a.bound, "box": ends(&a.at) });
        let formulas: Vec<Value> = self
            .summary
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
        versioned(json!({
            "function": "faddeeva",
            "part": "upper",
            "within": self.within,
            "proved": self.is_proved(),
            "norm": attained(&self.summary.norm),
            "component": self.summary.component.as_ref().map(attained),
            "tiny": self.summary.tiny,
            "boxes": self.summary.boxes,
            "seconds": self.seconds,
            "formulas": formulas,
            "open": opened(&self.found.open, "box", ends),
        }))
    }
}
