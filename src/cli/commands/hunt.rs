//! Hunting for a method's worst inputs and recording them.

use crate::cli::args::HuntArgs;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::{hard_folder, output::write_to};
use crate::cli::forecast;
use crate::cli::lookup;
use crate::cli::process::batches::Batches;
use crate::cli::process::candidate::Candidate;
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use crate::cli::terminal::width;
use crate::cli::workload::{self, Selection, reproduce_command};
use mechaudit::audit::{
    Case, HardCase, Hunt, HuntSettings, Method, Origin, Variant, Worst, hunt_answers, hunt_until,
    rounded_up,
};
use mechaudit::report::text::style::{BAD, BOLD, PLAIN, paint, wrap};
use mechaudit::report::text::table::Table;
use mechaudit::report::words;
use mechaudit::report::words::numbers::percent;
use std::cell::RefCell;

/// Hunts and records.
pub fn hunt(args: &HuntArgs) -> Result<Outcome, Failure> {
    let mut method = lookup::method(&args.method)?;
    if let Some(name) = &args.solver {
        method.select_solver(name).map_err(Failure::new)?;
    }
    let candidate = candidate(args);
    if candidate.is_none() {
        lookup::has_solver(&*method)?;
    }
    let settings = HuntSettings {
        evaluations: args.evals,
        seed: args.seed,
    };
    let folder = args.hard.as_deref();
    let known = match folder {
        Some(folder) => hard_folder::read(folder, &*method)?.unwrap_or_default(),
        None => method.hard(),
    };
    let mut known = known;
    if candidate.is_some() && folder.is_none() {
        // The built-in ones are recorded of the method's own solver.
        known.iter_mut().for_each(|case| case.share = 0.0);
    }
    if let Some(folder) = folder {
        hard_folder::check_writable(folder, &*method)?;
    }
    forecast::check_hunt(&*method, args.evals)?;
    let mut method = Variant::new(&*method).hard_cases(known.clone());
    if candidate.is_some() {
        method = method.without_laws();
    }
    let progress = Progress::new();
    let show = |made| progress.show(method.name(), made, args.evals);
    let program = candidate
        .as_ref()
        .map(|c| RefCell::new(Batches::new(&c.answering(&method))));
    let found = match &program {
        Some(program) => {
            let answers = |inputs: &[Vec<f64>]| {
                let mut program = program.borrow_mut();
                program.answers(method.name(), inputs)
            };
            hunt_answers(&method, &settings, &answers, &show, interrupt::flag())
        }
        None => hunt_until(&method, &settings, &show, interrupt::flag()),
    };
    drop(progress);
    let mut program = program.map(RefCell::into_inner);
    if let Some(why) = program.as_mut().and_then(|p| p.failure.take()) {
        return Err(why);
    }
    let worse = |known: &[HardCase]| -> Vec<HardCase> {
        let all = found.worst.iter();
        all.filter_map(|w| worse(w, known, args)).collect()
    };
    let added = folder.map(|f| hard_folder::add(f, &method, worse));
    let new: Vec<HardCase> = match &added {
        Some(Ok(added)) => added.iter().map(|(_, case)| case.clone()).collect(),
        _ => worse(&known),
    };
    let numbers = added.iter().flatten().flatten();
    let numbers: Vec<(usize, &HardCase)> = numbers.map(|(n, case)| (*n, case)).collect();
    write_to(|out| {
        write!(out, "{}", report(&method, &found, &new, args))?;
        write!(out, "{}", inputs(&method, &found, &numbers, args))?;
        if let Some(program) = &program {
            write!(out, "{}", of_program(&method, program, args))?;
        }
        let closing = match (folder, &added, new.len()) {
            (_, Some(Err(_)), n) => format!("{n} NOT recorded."),
            (_, _, 0) => "Nothing worse than what is recorded.".to_string(),
            (Some(folder), _, n) => {
                let place = hard_folder::file(folder, &method);
                format!("{n} added to {}.", place.display())
            }
            (None, _, n) => {
                format!("{n} worse than what is recorded; --hard DIR adds them to a folder.")
            }
        };
        Ok(writeln!(out, "{closing}")?)
    })?;
    added.transpose()?;
    Ok(Outcome::unless_interrupted(
        found.interrupted,
        is_good(&found, &new) && program.is_none_or(|p| p.report.trouble.is_none()),
    ))
}

/// Returns the program in place of the method's solver, if the arguments name one.
fn candidate(args: &HuntArgs) -> Option<Candidate> {
    let command = args.program.exec.as_deref()?;
    Some(workload::candidate(command, &args.program.program))
}

/// Returns the words that judge a case again, after its place.
fn tail(args: &HuntArgs) -> String {
    let (place, scope) = Default::default();
    let tail = reproduce_command(candidate(args).as_ref(), Selection::new(&place, &scope));
    match &args.solver {
        Some(name) => format!("{tail} --solver {}", shell_words::quote(name)),
        None => tail,
    }
}

/// The program as it calls itself, and what went wrong with it.
fn of_program(method: &dyn Method, program: &Batches, args: &HuntArgs) -> String {
    let line = |text: &str| format!("  {}\n", wrap(text, 2, width()));
    let mut out = line(&words::audit::candidate(&program.report));
    if let Some(trouble) = &program.report.trouble {
        out.push_str(&line(&paint(BAD, trouble)));
    }
    if let Some(input) = &program.unanswered {
        let case = workload::given(method.name(), input.clone());
        let again = format!("{}{}", case.reproduce(), tail(args));
        out.push_str(&format!(
            "  the first input without an answer\n    again    {again}\n"
        ));
    }
    out
}

/// Nothing new is over budget, and nothing fails without a share of it.
fn is_good(found: &Hunt, new: &[HardCase]) -> bool {
    new.iter().all(|c| c.share <= 1.0) && found.failures.is_empty()
}

/// Every input found, with the outputs that it is the worst for and the command that judges it
/// again.
fn inputs(
    method: &dyn Method,
    found: &Hunt,
    recorded: &[(usize, &HardCase)],
    args: &HuntArgs,
) -> String {
    let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
    let mut distinct: Vec<(Vec<u64>, Vec<&Worst>)> = Vec::new();
    for w in &found.worst {
        let key = bits(&w.input);
        match distinct.iter_mut().find(|(k, _)| *k == key) {
            Some((_, same)) => same.push(w),
            None => distinct.push((key, vec![w])),
        }
    }
    let mut out = String::new();
    for (key, same) in distinct {
        let outputs: Vec<&str> = same.iter().map(|w| w.output).collect();
        let number = recorded.iter().find(|(_, case)| bits(&case.input) == key);
        let case = Case {
            method: method.name(),
            region: "hunt",
            input: same[0].input.clone(),
            origin: match number {
                Some((number, _)) => Origin::Hard {
                    number: *number,
                    folder: args.hard.as_ref().map(|f| f.to_string_lossy().into_owned()),
                },
                None => Origin::Given,
            },
        };
        let decimals: Vec<String> = case.input.iter().map(|x| format!("{x:?}")).collect();
        for (label, text) in [
            (paint(BOLD, "worst for "), outputs.join(", ")),
            ("  input   ".into(), decimals.join(", ")),
        ] {
            out.push_str(&format!("  {label} {}\n", wrap(&text, 13, width())));
        }
        // In one line, for a shell.
        out.push_str(&format!(
            "    again    {}{}\n",
            case.reproduce(),
            tail(args)
        ));
    }
    out
}

/// The hard case to be recorded, if it is worse than those that are.
fn worse(worst: &Worst, known: &[HardCase], args: &HuntArgs) -> Option<HardCase> {
    let before = known.iter().filter(|k| k.output == worst.output);
    let before = before.map(|k| k.share).fold(0.0, f64::max);
    let share = rounded_up(worst.share);
    // A gain of less than a hundredth is none.
    (share > 1.01 * before).then(|| HardCase {
        share,
        output: worst.output.into(),
        reason: format!(
            "{}; {} evaluations from seed {}",
            worst.reason, args.evals, args.seed
        ),
        input: worst.input.clone(),
        folder: None,
    })
}

fn report(method: &dyn Method, found: &Hunt, new: &[HardCase], args: &HuntArgs) -> String {
    let mut out = format!("{}\n", paint(BOLD, method.name()));
    out.push_str(&match found.interrupted {
        true => {
            let text = format!("interrupted after {} of {}", found.evaluations, args.evals);
            format!("  {} evaluations\n", paint(BAD, &text))
        }
        false => format!("  {} evaluations\n", found.evaluations),
    });
    let mut table = Table::new(&["output", "of budget", "", "found"], &[0, 2, 3]);
    for w in &found.worst {
        let mark = match new.iter().any(|c| c.output == w.output) {
            true => "new",
            false => "",
        };
        let style = if w.share > 1.0 { BAD } else { PLAIN };
        table.row(vec![
            (w.output.into(), PLAIN),
            (percent(w.share), style),
            (mark.into(), PLAIN),
            (w.reason.clone(), PLAIN),
        ]);
    }
    out.push_str(&table.render(2));
    if let Some(first) = found.failures.first() {
        let n = found.failures.len();
        let text = format!(
            "{n} inputs fail without a share of the budget, the first: {}{}",
            first.reproduce(),
            tail(args)
        );
        out.push_str(&format!("  {}\n", paint(BAD, &wrap(&text, 2, width()))));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use crate::gallery::Gallery;
    use clap::Parser;

    fn worst(share: f64) -> Worst {
        Worst {
            output: "Re erf",
            share,
            input: vec![1.0, 0.0],
            reason: "drawn".into(),
        }
    }

    /// Recorded is what is worse by more than a hundredth than the worst of the same output.
    #[test]
    fn small_gains_are_none() {
        let args = arguments(&["--evals", "5", "--seed", "2"]);
        let known = |output: &str, share: f64| HardCase {
            share,
            output: output.into(),
            reason: String::new(),
            input: vec![0.5, 0.0],
            folder: None,
        };
        let known = [
            known("Re erf", 0.25),
            known("Re erf", 0.5),
            known("Im erf", 0.9),
        ];
        let is_worse =
            |share: f64, known: &[HardCase]| worse(&worst(share), known, &args).is_some();
        assert!(is_worse(0.506, &known));
        for small in [0.0, 0.3, 0.5, 0.5049] {
            assert!(!is_worse(small, &known), "{small}");
        }
        // Without an error there is nothing to record.
        assert!(is_worse(1e-9, &[]) && !is_worse(0.0, &[]));
        let new = worse(&worst(0.75), &known, &args).unwrap();
        assert_eq!(new.reason, "drawn; 5 evaluations from seed 2");
    }

    fn arguments(more: &[&str]) -> HuntArgs {
        let words = ["mechaudit", "hunt", "erf"].into_iter();
        let Some(Command::Hunt(args)) = Args::parse_from(words.chain(more.iter().copied())).command
        else {
            unreachable!("hunt")
        };
        args
    }

    fn of(output: &'static str, share: f64, x: f64) -> Worst {
        Worst {
            output,
            input: vec![x, 0.0],
            ..worst(share)
        }
    }

    fn whole(worst: Vec<Worst>) -> Hunt {
        Hunt {
            worst,
            failures: Vec::new(),
            evaluations: 7,
            interrupted: false,
        }
    }

    fn recorded(w: &Worst) -> HardCase {
        HardCase {
            share: w.share,
            output: w.output.into(),
            reason: w.reason.clone(),
            input: w.input.clone(),
            folder: None,
        }
    }

    /// A share is a number of [0, ∞).
    #[test]
    fn what_is_over_budget_is_a_finding() {
        let good = |shares: &[f64], failures: usize| {
            let new: Vec<HardCase> = shares.iter().map(|s| recorded(&worst(*s))).collect();
            let failure = Case {
                method: "erf",
                region: "hunt",
                input: vec![1.0, 0.0],
                origin: Origin::Given,
            };
            let found = Hunt {
                failures: vec![failure; failures],
                ..whole(Vec::new())
            };
            is_good(&found, &new)
        };
        for (shares, failures, due) in [
            (&[][..], 0, true),
            (&[0.5, 1.0], 0, true),
            (&[0.5, 1.001], 0, false),
            (&[1.5, 0.25], 0, false),
            (&[f64::INFINITY], 0, false),
            (&[], 1, false),
            (&[0.5], 2, false),
        ] {
            assert_eq!(good(shares, failures), due, "{shares:?} {failures}");
        }
    }

    /// The new input beside its share, the first failure, and every input once with all its outputs.
    #[test]
    fn reports() {
        let mut all = Gallery::default();
        let method = lookup::method("erf").unwrap();
        let (re, im) = (of("Re erf", 12.5, 1.0), of("Im erf", 0.5, 2.0));
        let args = arguments(&["--evals", "9"]);
        let mut found = whole(vec![re.clone(), im]);
        all.add("new", report(&*method, &found, &[recorded(&re)], &args));
        found.interrupted = true;
        all.add("interrupted", report(&*method, &found, &[], &args));
        let failure = |x: f64| Case {
            method: "erf",
            region: "hunt",
            input: vec![x, 0.0],
            origin: Origin::Given,
        };
        (found.interrupted, found.failures) = (false, vec![failure(1.0), failure(3.0)]);
        found.worst = [0.6, 1.0, 1.5]
            .map(|share| of("Re erf", share, 1.0))
            .to_vec();
        all.add("failures", report(&*method, &found, &[], &args));
        found.worst = vec![
            of("Re erf", 0.5, 1.0),
            of("Im erf", 0.4, 1.0),
            of("Re erf", 0.3, -0.0),
        ];
        let case = recorded(&found.worst[2]);
        let args = arguments(&["--hard", "some/folder"]);
        all.add("inputs", inputs(&*method, &found, &[(4, &case)], &args));
        all.pin("hunts");
    }
}
