//! Proofs of rounding-error bounds of the solvers of studies.

mod places;
mod witness;

use super::{boxes, line, tell, versioned, watched};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use mechaudit::audit::{Limit, Method, hex_float};
use mechaudit::proof::ProofError;
use mechaudit::proof::program::{Interval, Limits, Measure, Proof, Setting, prove as bound};
use mechaudit::report::text::style::{BAD, BOLD, DIM, paint};
use mechaudit::study::proof::same::{Same, own_study, same};
use mechaudit::study::{Problem, Study, StudySolver};
use mechaudit::symbolic::evaluation::{Elementary, Format};
use serde_json::{Map, Value, json};
use std::io::Write;
use std::time::Instant;
use witness::{Found, worst};

/// The measures in the order of the report.
const MEASURES: [Measure; 3] = [Measure::Absolute, Measure::Relative, Measure::Ulps];

/// All that is known of one output.
struct Theorem {
    study: &'static str,
    solver: String,
    output: String,
    inputs: Vec<String>,
    domain: Vec<Interval>,
    setting: Setting,
    functions: Vec<(&'static str, String)>,
    operations: usize,
    proofs: Vec<(Measure, Proof)>,
    found: Vec<(Measure, Option<Found>)>,
    same: Same,
    target: Option<(Measure, f64)>,
    seconds: f64,
}

/// Proves of every output of a study, and prints what is proved.
pub fn prove(args: &ProveArgs) -> Result<Outcome, Failure> {
    let of_w = [
        ("--part", args.part.is_some()),
        ("--norm", args.norm.is_some()),
        ("--component", args.component.is_some()),
    ];
    if let Some((name, _)) = of_w.into_iter().find(|(_, given)| *given) {
        return Err(Failure::new(format!(
            "{name} is not for studies: take --target"
        )));
    }
    let target = args.target.as_deref().map(target).transpose()?;
    let study = Study::open(&args.function).map_err(Failure::caused)?;
    let problem = study.problem();
    let solver = solver(problem, args.solver.as_deref(), &study)?;
    let boxes = boxes(args)?;
    let mut theorems = Vec::new();
    let all: Vec<Vec<usize>> = match &args.together {
        None => (0..problem.outputs.len()).map(|k| vec![k]).collect(),
        Some(names) => vec![pair(problem, names, target)?],
    };
    for outputs in &all {
        match Theorem::of(&study, &solver, outputs, target, args)? {
            None => return Ok(Outcome::Interrupted),
            Some(theorem) => theorems.push(theorem),
        }
    }
    tell(args, boxes, &theorems, (json!({}), "outputs"))
}

/// Reads a target: `2ulp`, `1e-12 relative`, `1e-9 absolute`.
fn target(text: &str) -> Result<(Measure, f64), Failure> {
    match mechaudit::study::limit(text).map_err(Failure::caused)? {
        Limit::Ulps(k) => Ok((Measure::Ulps, k)),
        Limit::Relative(r) => Ok((Measure::Relative, r)),
        Limit::Absolute(a) => Ok((Measure::Absolute, a)),
        _ => Err(Failure::new(format!(
            "--target {text:?}: a proof bounds ulps, the relative or the absolute error"
        ))),
    }
}

/// The places of the two outputs that are one complex number.
fn pair(
    problem: &Problem,
    names: &str,
    target: Option<(Measure, f64)>,
) -> Result<Vec<usize>, Failure> {
    if matches!(target, Some((Measure::Ulps, _))) {
        return Err(Failure::new(
            "--together has no ulps: a complex number has an absolute and a relative error",
        ));
    }
    let known: Vec<&str> = problem.outputs.iter().map(|o| o.name.as_str()).collect();
    let place = |name: &str| known.iter().position(|n| *n == name.trim());
    let places: Option<Vec<usize>> = names.split(',').map(place).collect();
    match places.as_deref() {
        Some([re, im]) if re != im => Ok(vec![*re, *im]),
        _ => Err(Failure::new(format!(
            "--together {names:?}: two outputs as RE,IM; there are: {}",
            known.join(", ")
        ))),
    }
}

fn solver(problem: &Problem, name: Option<&str>, study: &Study) -> Result<StudySolver, Failure> {
    if let Some(name) = name {
        // Says which there are.
        study.clone().with_solver(name).map_err(Failure::caused)?;
        let found = problem.solvers.iter().find(|s| s.name == name);
        return found
            .cloned()
            .ok_or_else(|| Failure::new("there is no such solver"));
    }
    let first = problem.solvers.first().cloned();
    first.ok_or_else(|| {
        Failure::new("the study has no solver that rounds to one format, binary64 or binary32")
    })
}

impl Theorem {
    /// Nothing if the user ends it.
    fn of(
        study: &Study,
        solver: &StudySolver,
        outputs: &[usize],
        target: Option<(Measure, f64)>,
        args: &ProveArgs,
    ) -> Result<Option<Theorem>, Failure> {
        let begin = Instant::now();
        let problem = study.problem();
        let setting = Setting {
            elementary: match args.correctly_rounded {
                true => Elementary::Correct,
                false => solver.elementary,
            },
            round_inputs: args.round_inputs,
            ..solver.setting()
        };
        let program = problem.program(solver, outputs, setting, args.within);
        let program = program.map_err(Failure::caused)?;
        let names = outputs.iter().map(|k| problem.outputs[*k].name.as_str());
        let output = names.collect::<Vec<_>>().join(" + i ");
        let refused = |e: &str| Failure::new(format!("{output}: {e}"));
        let mut proofs = Vec::new();
        for measure in MEASURES {
            let other = target.is_some_and(|(of, _)| of != measure);
            if other || (measure == Measure::Ulps && outputs.len() > 1) {
                continue;
            }
            let limits = Limits {
                boxes: args.limit,
                target: target.map_or(0.0, |t| t.1),
            };
            let name = format!("{output} {}", word(measure));
            let program = program.clone();
            let proof = watched(&name, false, move |watch| {
                Ok::<_, ProofError>(bound(&program, measure, &limits, watch))
            })?;
            match proof {
                None => return Ok(None),
                Some(proof) => proofs.push((measure, proof)),
            }
        }
        let own = own_study(problem, solver, setting, outputs, args.within);
        let own = own.map_err(Failure::caused)?;
        let mut found = Vec::new();
        for (measure, proof) in &proofs {
            let worst = worst(&own, *measure, proof, args)?;
            if let Some(f) = worst
                .as_ref()
                .filter(|f| f.error > proof.bound * (1.0 + 1e-9))
            {
                return Err(refused(&format!(
                    "the {} error at {:?} is {:e}, above the bound {:e}: what the proof rests on does not hold here",
                    word(*measure),
                    f.input,
                    f.error,
                    proof.bound
                )));
            }
            found.push((*measure, worst));
        }
        let inputs = found.iter().flat_map(|f| &f.1).map(|f| f.input.clone());
        let inputs: Vec<Vec<f64>> = inputs.collect();
        let each = outputs.iter().enumerate();
        let same = each.map(|(part, k)| same(problem, solver, (*k, part), &own, study, &inputs));
        let same = same.reduce(Same::with).expect("an output");
        Ok(Some(Theorem {
            study: Method::name(study),
            solver: solver.name.clone(),
            output,
            inputs: problem.inputs.iter().map(|i| i.name.clone()).collect(),
            domain: program.domain().to_vec(),
            setting,
            functions: program
                .functions()
                .into_iter()
                .map(|(name, a)| (name, format!("{} ulp, {}", a.ulps, a.source)))
                .collect(),
            operations: program.operations(),
            proofs,
            found,
            same,
            target,
            seconds: begin.elapsed().as_secs_f64(),
        }))
    }

    fn bound(&self, measure: Measure) -> Option<f64> {
        let proof = self.proofs.iter().find(|p| p.0 == measure)?;
        Some(proof.1.bound).filter(|b| b.is_finite())
    }

    fn found(&self, measure: Measure) -> Option<&Found> {
        self.found.iter().find(|f| f.0 == measure)?.1.as_ref()
    }

    fn is_refuted(&self) -> bool {
        let Some((measure, target)) = self.target else {
            return false;
        };
        self.found(measure).is_some_and(|f| f.error > target)
    }

    fn place(&self, at: &[Interval]) -> String {
        let of = |(name, x): (&String, &Interval)| match x.is_point() {
            true => format!("{name} = {:.6e}", x.lo),
            false => format!("{name} in [{:.6e}, {:.6e}]", x.lo, x.hi),
        };
        let all: Vec<String> = self.inputs.iter().zip(at).map(of).collect();
        if all.is_empty() {
            "no input".into()
        } else {
            all.join(", ")
        }
    }
}

impl super::Theorem for Theorem {
    fn is_proved(&self) -> bool {
        match self.target {
            None => self.bound(Measure::Absolute).is_some(),
            Some((measure, target)) => self.bound(measure).is_some_and(|b| b <= target),
        }
    }

    fn columns(&self) -> String {
        let ends = |name: &String| format!(",{name}_from,{name}_to");
        let names: String = self.inputs.iter().map(ends).collect();
        format!("output,measure,bound{names}")
    }

    fn rows(&self, out: &mut dyn Write) -> Result<(), Failure> {
        for (measure, proof) in &self.proofs {
            for leaf in &proof.boxes {
                let (name, measure) = (&self.output, word(*measure));
                write!(out, "{name},{measure},{}", hex_float(leaf.bound))?;
                for x in &leaf.at {
                    write!(out, ",{},{}", hex_float(x.lo), hex_float(x.hi))?;
                }
                writeln!(out)?;
            }
        }
        Ok(())
    }

    fn text(&self) -> String {
        let format = match self.setting.format {
            Format::Single => "binary32",
            Format::Double => "binary64",
        };
        let title = format!(
            "{}: {} by {}, {format}",
            self.study, self.output, self.solver
        );
        let mut out = format!("{}\n", paint(BOLD, &title));
        let mut line = |text: String| out += &line(text);
        if let Some((measure, target)) = self.target {
            let name = format!("{target:e} {}", word(measure));
            line(match (self.is_proved(), self.is_refuted()) {
                (true, _) => format!("proved: at most {name}"),
                (_, true) => paint(
                    BAD,
                    &format!("refuted: more than {name} at the input below"),
                ),
                _ => paint(BAD, &format!("undecided: {name}")),
            });
        }
        for (measure, proof) in &self.proofs {
            line(match self.bound(*measure) {
                Some(bound) => format!("{:<9} error ≤ {}", word(*measure), up(bound)),
                None => paint(
                    DIM,
                    &format!("{:<9} error: no bound: {}", word(*measure), why(proof)),
                ),
            });
            if let Some(at) = proof.at.as_ref().filter(|_| self.bound(*measure).is_some()) {
                line(format!("          attained in {}", self.place(&at.at)));
            }
            if let Some(found) = self.found(*measure) {
                let input: Vec<String> = self
                    .inputs
                    .iter()
                    .zip(&found.input)
                    .map(|(n, x)| format!("{n} = {x:?}"))
                    .collect();
                line(format!(
                    "          found   {:.4e} at {}",
                    found.error,
                    input.join(", ")
                ));
            }
            let ended = if proof.limited {
                ", ended by the limit"
            } else {
                ""
            };
            line(paint(
                DIM,
                &format!("          {} boxes{ended}", proof.looked_at),
            ));
        }
        line(format!(
            "solver and definition over the reals: {}",
            match &self.same {
                Same::Proved(how) => format!("the same, {how}"),
                Same::Refuted(at) =>
                    format!("different, at {at:?}: the bound is of the solver's formula"),
                Same::Undecided(why) => format!("undecided, {why}"),
            }
        ));
        for (name, accuracy) in &self.functions {
            line(format!("{name}: {accuracy}"));
        }
        if self.setting.round_inputs {
            line("inputs are real numbers, rounded first".into());
        }
        line(format!(
            "{} operations, {:.1} s",
            self.operations, self.seconds
        ));
        out
    }

    fn document(&self) -> Value {
        let witness = |measure| match self.found(measure) {
            Some(f) => json!({ "error": f.error, "input": f.input }),
            None => Value::Null,
        };
        let attained = |measure: Measure| {
            let proof = self.proofs.iter().find(|p| p.0 == measure);
            let at = proof.and_then(|p| p.1.at.as_ref());
            at.map(|b| b.at.iter().map(|x| json!([x.lo, x.hi])).collect::<Vec<_>>())
        };
        let each = |f: &dyn Fn(Measure) -> Value| -> Value {
            let all = MEASURES.iter().map(|m| (word(*m).to_string(), f(*m)));
            Value::Object(all.collect::<Map<_, _>>())
        };
        let boxes = |m: Measure| self.proofs.iter().find(|p| p.0 == m).map(|p| p.1.looked_at);
        versioned(json!({
            "study": self.study,
            "output": self.output,
            "solver": self.solver,
            "format": match self.setting.format { Format::Single => "binary32", Format::Double => "binary64" },
            "round_inputs": self.setting.round_inputs,
            "inputs": self.inputs,
            "domain": self.domain.iter().map(|x| [x.lo, x.hi]).collect::<Vec<_>>(),
            "proved": self.is_proved(),
            "refuted": self.is_refuted(),
            "target": self.target.map(|(m, t)| json!({ "measure": word(m), "bound": t })),
            "absolute_error": self.bound(Measure::Absolute),
            "relative_error": self.bound(Measure::Relative),
            "ulps": self.bound(Measure::Ulps),
            "why": self.proofs.iter().find(|p| p.1.proved().is_none()).map(|p| why(&p.1)),
            "attained": each(&|m| json!(attained(m))),
            "witness": each(&witness),
            "boxes": each(&|m| json!(boxes(m))),
            "same_function": match &self.same {
                Same::Proved(how) => json!({ "outcome": "proved", "how": how }),
                Same::Refuted(at) => json!({ "outcome": "refuted", "input": at }),
                Same::Undecided(why) => json!({ "outcome": "undecided", "why": why }),
            },
            "functions": self.functions.iter().map(|(n, a)| json!({ "name": n, "accuracy": a })).collect::<Vec<_>>(),
            "operations": self.operations,
            "seconds": self.seconds,
        }))
    }
}

/// The reason why nothing is proved.
fn why(proof: &Proof) -> &'static str {
    let at = proof.at.as_ref().and_then(|b| b.why);
    at.unwrap_or("the limit ended it")
}

fn word(measure: Measure) -> &'static str {
    match measure {
        Measure::Absolute => "absolute",
        Measure::Relative => "relative",
        Measure::Ulps => "ulps",
    }
}

/// A bound with five digits, rounded up.
fn up(x: f64) -> String {
    if x == 0.0 {
        return "0: exact".into();
    }
    let mut bound = x;
    loop {
        let text = format!("{bound:.4e}");
        match text.parse::<f64>() {
            Ok(shown) if shown < x => bound = bound * (1.0 + 5e-5) + f64::MIN_POSITIVE,
            _ => return text,
        }
    }
}
