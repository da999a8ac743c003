//! Hunting for a method's worst inputs and recording them.

use super::args::HuntArgs;
use super::audit::find;
use super::failure::{Failure, Outcome};
use super::interrupt;
use super::output::write_to;
use super::progress::Progress;
use super::text::{BAD, BOLD, PLAIN, Table, paint, percent, width, wrap};
use mechaudit::audit::{
    HARD_HEADER, HardCase, Hunt, HuntSettings, Method, Worst, hunt_until, rounded_up,
};
use std::path::Path;

/// Hunts and records.
pub fn hunt(args: &HuntArgs) -> Result<Outcome, Failure> {
    let method = find(&args.method)?;
    let settings = HuntSettings {
        evaluations: args.evals,
        seed: args.seed,
    };
    let progress = Progress::new();
    let show = |made| progress.show(method.name(), made, args.evals);
    let found = hunt_until(&*method, &settings, &show, interrupt::flag());
    drop(progress);
    let path = args.hard.join(format!("{}.csv", method.name()));
    let kept = match args.hard.is_dir() {
        true => Some(File::read(&path)?),
        false => None,
    };
    let known = match &kept {
        Some(file) => file.cases.clone(),
        None => method.hard(),
    };
    let new: Vec<HardCase> = found
        .worst
        .iter()
        .filter_map(|w| worse(w, &known, args))
        .collect();
    write_to(None, |out| {
        write!(out, "{}", report(&*method, &found, &new, args.evals))?;
        let place = path.display();
        let folder = args.hard.display();
        let closing = match (&kept, new.len()) {
            (_, 0) => "Nothing worse than what is recorded.".to_string(),
            (Some(_), n) => format!("{n} added to {place}."),
            (None, _) => format!("Not recorded: there is no folder {folder}."),
        };
        Ok(writeln!(out, "{closing}")?)
    })?;
    let over = new.iter().any(|c| c.share > 1.0);
    if let Some(file) = kept.filter(|_| !new.is_empty()) {
        file.append(&path, &*method, &new)?;
    }
    let good = !over && found.failures.is_empty();
    Ok(Outcome::unless_interrupted(found.interrupted, good))
}

/// What is recorded so far.
struct File {
    text: String,
    cases: Vec<HardCase>,
}

impl File {
    fn read(path: &Path) -> Result<File, Failure> {
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(e) => return Err(Failure::new(format!("cannot read {}: {e}", path.display()))),
        };
        let cases = HardCase::read(&text);
        let cases = cases.map_err(|e| Failure::new(format!("{}: {e}", path.display())))?;
        Ok(File { text, cases })
    }

    fn append(&self, path: &Path, method: &dyn Method, new: &[HardCase]) -> Result<(), Failure> {
        write_to(Some(path), |out| {
            if self.text.is_empty() {
                let name = method.name();
                writeln!(
                    out,
                    "# Worst inputs found by mechaudit hunt {name}; lines are only added."
                )?;
                writeln!(out, "{HARD_HEADER}")?;
            } else {
                write!(out, "{}", self.text)?;
                if !self.text.ends_with('\n') {
                    writeln!(out)?;
                }
            }
            for case in new {
                write!(out, "{}", case.line())?;
            }
            Ok(())
        })
    }
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
    })
}

fn report(method: &dyn Method, found: &Hunt, new: &[HardCase], evaluations: u64) -> String {
    let mut out = format!("{}\n", paint(BOLD, method.name()));
    out.push_str(&match found.interrupted {
        true => {
            let text = format!("interrupted after {} of {evaluations}", found.evaluations);
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
            "{n} drawn inputs fail without a share of the budget, the first: {}",
            first.reproduce()
        );
        out.push_str(&format!("  {}\n", paint(BAD, &wrap(&text, 2, width()))));
    }
    out
}
