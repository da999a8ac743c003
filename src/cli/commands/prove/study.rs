//! Proofs of rounding-error bounds of the solvers of studies.

mod witness;

use super::{boxes, watched};
use crate::cli::args::ProveArgs;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::print_as;
use mechaudit::audit::{Limit, Method, hex_float};
use mechaudit::proof::ProofError;
use mechaudit::proof::program::{
    Interval, Limits, Measure, Program, Proof, Setting, prove as bound,
};
use mechaudit::report::text::style::{BAD, BOLD, DIM, paint};
use mechaudit::study::{Problem, Study, StudySolver};
use mechaudit::symbolic::evaluation::{Elementary, Format};
use mechaudit::symbolic::graph::Graph;
use rug::Rational;
use rug::float::Round;
use serde_json::{Map, Value, json};
use std::io::Write;
use std::time::Instant;
use witness::{Found, Same, own_study, same, worst};

/// The measures in the order of the report.
const MEASURES: [Measure; 3] = [Measure::Absolute, Measure::Relative, Measure::Ulps];

/// All that is known of one output.
struct Theorem {
    study: &'static str,
    solver: String,
    output: String,
    inputs: Vec<String>,
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
    for k in 0..problem.outputs.len() {
        match Theorem::of(&study, &solver, k, target, args)? {
            None => return Ok(Outcome::Interrupted),
            Some(theorem) => theorems.push(theorem),
        }
    }
    if let Some(output) = boxes {
        output.write(|out| write_boxes(&theorems, out))?;
    }
    let text = || theorems.iter().map(Theorem::text).collect();
    print_as(args.format, text, || match theorems.as_slice() {
        [one] => one.document(),
        all => json!({
            "schema_version": 1,
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "proved": all.iter().all(Theorem::is_proved),
            "outputs": all.iter().map(Theorem::document).collect::<Vec<Value>>(),
        }),
    })?;
    Ok(Outcome::of(theorems.iter().all(Theorem::is_proved)))
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

fn solver(problem: &Problem, name: Option<&str>, study: &Study) -> Result<StudySolver, Failure> {
    if problem.linear.is_some() || problem.system.is_some() {
        return Err(Failure::new(
            "only studies of formulas have a proof: this is one of linear algebra or of a system",
        ));
    }
    if let Some(name) = name {
        // Says which there are.
        study.clone().with_solver(name).map_err(Failure::caused)?;
        let found = problem.solvers.iter().find(|s| s.name == name);
        return found
            .cloned()
            .ok_or_else(|| Failure::new("there is no such solver"));
    }
    let first = problem.solvers.first().cloned();
    first.ok_or_else(|| Failure::new("the study states no solver: nothing rounds"))
}

/// The numbers of the format between the ends of an input; the reals, if inputs are rounded.
fn range(
    input: &mechaudit::study::StudyInput,
    setting: Setting,
    within: Option<f64>,
) -> Result<Interval, Failure> {
    let single = setting.format == Format::Single;
    let largest = if single {
        f64::from(f32::MAX)
    } else {
        f64::MAX
    };
    let largest = within.map_or(largest, |w| w.min(largest));
    let end = |q: &Option<Rational>, outside: f64, up: bool| {
        let Some(q) = q else { return outside };
        // Inward to a number of the format, or outward to one where inputs are real.
        let way = if up == setting.round_inputs {
            Round::Up
        } else {
            Round::Down
        };
        let bits = if single && !setting.round_inputs {
            24
        } else {
            53
        };
        rug::Float::with_val_round(bits, q, way).0.to_f64_round(way)
    };
    let (from, to) = (
        end(&input.from, -largest, false),
        end(&input.to, largest, true),
    );
    // Below the normal numbers of binary32 there are fewer bits.
    let (from, to) = match single && !setting.round_inputs {
        true => {
            let (p, q) = (from as f32, to as f32);
            let p = if f64::from(p) < from { p.next_up() } else { p };
            let q = if f64::from(q) > to { q.next_down() } else { q };
            (f64::from(p), f64::from(q))
        }
        false => (from, to),
    };
    let (from, to) = (from.max(-largest), to.min(largest));
    if !(from <= to) {
        return Err(Failure::new(format!(
            "no number of the format lies in the range of {}",
            input.name
        )));
    }
    Ok(Interval::new(from, to))
}

impl Theorem {
    /// Nothing if the user ends it.
    fn of(
        study: &Study,
        solver: &StudySolver,
        k: usize,
        target: Option<(Measure, f64)>,
        args: &ProveArgs,
    ) -> Result<Option<Theorem>, Failure> {
        let begin = Instant::now();
        let problem = study.problem();
        let setting = Setting {
            format: solver.format,
            elementary: match args.correctly_rounded {
                true => Elementary::Correct,
                false => solver.elementary,
            },
            round_inputs: args.round_inputs,
        };
        let output = &problem.outputs[k];
        let refused = |e: &dyn std::fmt::Display| Failure::new(format!("{}: {e}", output.name));
        let mut graph = Graph::new(problem.inputs.iter().map(|i| i.name.clone()));
        let formula = graph.build(&solver.definitions, &solver.formulas[k]);
        let formula = formula.map_err(|e| refused(&e))?;
        let condition = match &problem.condition {
            Some(e) => Some(
                graph
                    .build(&problem.definitions, e)
                    .map_err(|e| refused(&e))?,
            ),
            None => None,
        };
        let domain = problem.inputs.iter();
        let domain: Vec<Interval> = domain
            .map(|i| range(i, setting, args.within))
            .collect::<Result<_, _>>()?;
        let program = Program::new(&graph, formula, condition, &domain, setting);
        let program = program.map_err(|e| refused(&e))?;
        let mut proofs = Vec::new();
        for measure in MEASURES {
            if target.is_some_and(|(of, _)| of != measure) {
                continue;
            }
            let limits = Limits {
                boxes: args.limit,
                target: target.map_or(0.0, |t| t.1),
            };
            let name = format!("{} {}", output.name, word(measure));
            let program = program.clone();
            let proof = watched(&name, false, move |watch| {
                Ok::<_, ProofError>(bound(&program, measure, &limits, watch))
            })?;
            match proof {
                None => return Ok(None),
                Some(proof) => proofs.push((measure, proof)),
            }
        }
        let own = own_study(problem, solver, setting, k)?;
        let mut found = Vec::new();
        for (measure, proof) in &proofs {
            let worst = worst(&own, *measure, proof.bound, args)?;
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
        let same = same(problem, solver, k, &own, study, inputs.collect());
        Ok(Some(Theorem {
            study: Method::name(study),
            solver: solver.name.clone(),
            output: output.name.clone(),
            inputs: problem.inputs.iter().map(|i| i.name.clone()).collect(),
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

    fn is_proved(&self) -> bool {
        match self.target {
            None => self.bound(Measure::Absolute).is_some(),
            Some((measure, target)) => self.bound(measure).is_some_and(|b| b <= target),
        }
    }

    fn is_refuted(&self) -> bool {
        let Some((measure, target)) = self.target else {
            return false;
        };
        self.found(measure).is_some_and(|f| f.error > target)
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
        let mut line = |text: String| out += &format!("  {text}\n");
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
                None => {
                    let why = proof
                        .at
                        .as_ref()
                        .and_then(|b| b.why)
                        .unwrap_or("the limit ended it");
                    paint(
                        DIM,
                        &format!("{:<9} error: no bound: {why}", word(*measure)),
                    )
                }
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
        json!({
            "schema_version": 1,
            "mechaudit_version": env!("CARGO_PKG_VERSION"),
            "study": self.study,
            "output": self.output,
            "solver": self.solver,
            "format": match self.setting.format { Format::Single => "binary32", Format::Double => "binary64" },
            "round_inputs": self.setting.round_inputs,
            "proved": self.is_proved(),
            "refuted": self.is_refuted(),
            "target": self.target.map(|(m, t)| json!({ "measure": word(m), "bound": t })),
            "absolute_error": self.bound(Measure::Absolute),
            "relative_error": self.bound(Measure::Relative),
            "ulps": self.bound(Measure::Ulps),
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
        })
    }
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

fn write_boxes(theorems: &[Theorem], out: &mut dyn Write) -> Result<(), Failure> {
    let ends = |name: &String| format!(",{name}_from,{name}_to");
    let names: String = theorems
        .first()
        .map_or(String::new(), |t| t.inputs.iter().map(ends).collect());
    writeln!(out, "output,measure,bound{names}")?;
    for theorem in theorems {
        for (measure, proof) in &theorem.proofs {
            for leaf in &proof.boxes {
                let (name, measure) = (&theorem.output, word(*measure));
                write!(out, "{name},{measure},{}", hex_float(leaf.bound))?;
                for x in &leaf.at {
                    write!(out, ",{},{}", hex_float(x.lo), hex_float(x.hi))?;
                }
                writeln!(out)?;
            }
        }
    }
    Ok(())
}
