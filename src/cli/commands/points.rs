//! Inputs of a method, as lines for programs in any language.

use crate::cli::args::PointsArgs;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::lookup;
use crate::cli::process::wire;
use crate::cli::workload::{Selection, Workload};
use crate::cli::{args::ScopeArgs, complain, forecast};
use mechaudit::audit::{Case, Cases, Layout, Method, Origin, Settings};
use std::io::Write;
use std::path::Path;

mod certified;

/// Writes them.
pub fn points(args: &PointsArgs) -> Result<Outcome, Failure> {
    let method = lookup::method(&args.method)?;
    let output = match args.check {
        true => None,
        false => Some(Output::open(args.output.as_deref())?),
    };
    let settings = Settings {
        seed: args.seed,
        cases_per_region: args.count,
        ..Settings::default()
    };
    let scope = ScopeArgs {
        single: args.single,
        ..ScopeArgs::default()
    };
    let selection = Selection::new(&args.place, &scope);
    let workload = Workload::of_one(&*method, selection, settings)?;
    let cases = Cases::new(&workload.methods[0], &workload.settings);
    if workload.one.is_none() {
        forecast::check_points(&cases, args.decimal)?;
    }
    let one = workload.one.as_ref();
    if let Some(digits) = args.digits {
        let form = (digits, args.decimal);
        let Some(table) = certified::table(&*method, &cases, one, form)? else {
            return Ok(Outcome::Interrupted);
        };
        for open in &table.undecided {
            complain(open);
        }
        let outcome = match output {
            Some(output) => {
                output.text(&table.text)?;
                Outcome::AsExpected
            }
            None => checked(args, table.text.as_bytes())?,
        };
        return Ok(match table.undecided.is_empty() {
            true => outcome,
            false => outcome.or_finding(),
        });
    }
    match output {
        Some(output) => {
            output.write(|out| lines(&*method, &cases, one, args.decimal, out))?;
            Ok(Outcome::AsExpected)
        }
        None => {
            let mut text = Vec::new();
            lines(&*method, &cases, one, args.decimal, &mut text)?;
            checked(args, &text)
        }
    }
}

/// Compares the file that there is with what it should hold.
fn checked(args: &PointsArgs, text: &[u8]) -> Result<Outcome, Failure> {
    let path = args.output.as_deref().unwrap_or(Path::new("-"));
    let there = std::fs::read(path).map_err(|e| Failure::cannot("read", path, e))?;
    if there == text {
        return Ok(Outcome::AsExpected);
    }
    let [old, new] = [&there, text].map(|text| text.split(|b| *b == b'\n'));
    let same = old.zip(new).take_while(|(old, new)| old == new).count();
    let (path, line) = (path.display(), same + 1);
    complain(&format!(
        "{path}: line {line} is not what this command writes"
    ));
    Ok(Outcome::Finding)
}

/// Writes inputs, one a line.
fn lines(
    method: &dyn Method,
    cases: &Cases,
    one: Option<&Case>,
    decimal: bool,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    header(method, out)?;
    if let Some(case) = one {
        heading(method, case, out)?;
        return Ok(writeln!(out, "{}", wire::line(&case.input, decimal))?);
    }
    let mut region = "";
    for i in 0..cases.len() {
        let case = cases.get(i);
        if case.region != region {
            region = case.region;
            heading(method, &case, out)?;
        }
        writeln!(out, "{}", wire::line(&case.input, decimal))?;
    }
    Ok(())
}

fn header(method: &dyn Method, out: &mut dyn Write) -> Result<(), Failure> {
    let layout = Layout::new(method);
    let (name, summary) = (method.name(), method.summary());
    let version = env!("CARGO_PKG_VERSION");
    writeln!(out, "# {name}: {summary} (mechaudit {version})")?;
    writeln!(out, "# input: {}", layout.input())?;
    Ok(writeln!(out, "# answer: {}", layout.answer())?)
}

/// Where the following inputs come from; `judge` reads it.
fn heading(method: &dyn Method, case: &Case, out: &mut dyn Write) -> Result<(), Failure> {
    let regions = method.domain().regions;
    let place = match &case.origin {
        Origin::Random { seed, index }
        | Origin::Box { seed, index, .. }
        | Origin::Near { seed, index, .. } => format!("seed {seed}, from {index}"),
        _ => "named".into(),
    };
    let description = regions.iter().find(|r| r.name == case.region);
    let description = description.map_or(String::new(), |r| format!(": {}", r.description));
    Ok(writeln!(
        out,
        "# region {} ({place}){description}",
        case.region
    )?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;

    /// Returns the file that `points` writes.
    fn written(line: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("points");
        let line = format!("mechaudit points {line} --output {}", file.display());
        let Some(Command::Points(args)) = Args::parse_from(line.split_whitespace()).command else {
            unreachable!("points")
        };
        assert_eq!(points(&args).unwrap(), Outcome::AsExpected);
        std::fs::read_to_string(&file).unwrap()
    }

    /// Comments that begin with this, and inputs.
    fn parts<'a>(text: &'a str, begin: &str) -> (Vec<&'a str>, Vec<&'a str>) {
        let comments = text.lines().filter(|l| l.starts_with(begin));
        let inputs = text.lines().filter(|l| !l.starts_with('#'));
        (comments.collect(), inputs.collect())
    }

    /// Check points and hard cases are named, then each region with its description and the number of its
    /// inputs.
    #[test]
    fn every_region_has_a_heading() {
        let method = lookup::method("erf").unwrap();
        let text = written("erf --count 3 --seed 5");
        let (_, inputs) = parts(&text, "#");
        let domain = method.domain();
        let named = domain.check_points.len() + method.hard().len();
        assert_eq!(inputs.len(), named + 3 * domain.regions.len());
        let layout = Layout::new(&*method);
        let head = [
            format!(
                "# erf: {} (mechaudit {})",
                method.summary(),
                env!("CARGO_PKG_VERSION")
            ),
            format!("# input: {}", layout.input()),
            format!("# answer: {}", layout.answer()),
        ];
        assert!(text.lines().take(3).eq(&head), "{text}");
        for r in &domain.regions {
            let heading = format!("# region {} (seed 5, from 0): {}", r.name, r.description);
            let lines: Vec<&str> = text.lines().collect();
            let at: Vec<usize> = (0..lines.len()).filter(|k| lines[*k] == heading).collect();
            assert_eq!(at.len(), 1, "{heading}: {text}");
            let drawn = lines[at[0] + 1..]
                .iter()
                .take_while(|l| !l.starts_with('#'));
            assert_eq!(drawn.count(), 3, "{heading}");
        }
        let (headings, _) = parts(&text, "# region ");
        let named = headings.iter().filter(|h| h.ends_with(" (named)")).count();
        assert_eq!(headings.len(), domain.regions.len() + named);
        assert!((1..=2).contains(&named), "{headings:?}");
    }

    #[test]
    fn one_case_is_one_of_all() {
        let all = written("erf --region mid --count 4");
        let (headings, inputs) = parts(&all, "# region ");
        assert_eq!((headings.len(), inputs.len()), (1, 4), "{all}");
        let one = written("erf --region mid --case 2");
        let (headings, found) = parts(&one, "# region ");
        assert!(
            headings.len() == 1 && headings[0].starts_with("# region mid (seed 1, from 2): "),
            "{one}"
        );
        assert_eq!(found, [inputs[2]]);
        let other = written("erf --region mid --case 2 --seed 9");
        assert_ne!(parts(&other, "#").1, found);
    }

    /// In single precision 29 bits of the fraction are zero; a decimal reads back as the same
    /// number.
    #[test]
    fn the_form_of_numbers() {
        let numbers = |line: &str| -> Vec<f64> {
            let text = written(line);
            let (_, inputs) = parts(&text, "#");
            let fields = inputs.iter().flat_map(|l| l.split(','));
            fields
                .map(|f| crate::cli::number::Number::parse(f).unwrap().nearest())
                .collect()
        };
        let double = numbers("erf --region mid --count 5");
        assert_eq!(numbers("erf --region mid --count 5 --decimal"), double);
        let text = written("erf --region mid --count 5 --decimal");
        assert!(
            parts(&text, "#").1.iter().all(|l| !l.contains("0x")),
            "{text}"
        );
        let text = written("erf --region mid --count 5");
        assert!(
            parts(&text, "#").1.iter().all(|l| l.contains("0x")),
            "{text}"
        );
        let is_single = |x: &f64| f64::from(*x as f32) == *x;
        let single = numbers("erf --region mid --count 5 --single");
        assert!(single.iter().all(is_single) && !double.iter().all(is_single));
    }
}
