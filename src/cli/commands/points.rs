//! Inputs of a method, as lines for programs in any language.

use crate::cli::args::PointsArgs;
use crate::cli::commands::audit::find;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::{forecast, process::wire, scope};
use mechaudit::audit::{Case, Cases, Format, Layout, Method, Origin, Settings, Variant};
use std::io::Write;

/// Writes them.
pub fn points(args: &PointsArgs) -> Result<Outcome, Failure> {
    let method = find(&args.method)?;
    let output = Output::open(args.output.as_deref())?;
    let settings = Settings {
        seed: args.seed,
        cases_per_region: args.count,
        ..Settings::default()
    };
    let mut chosen = Variant::new(&*method);
    if args.single {
        chosen = chosen.format(Format::Single);
    }
    let chosen = scope::placed(chosen, &args.place, &settings, true)?;
    let one = scope::one_case(&chosen, &args.place, &settings)?;
    let cases = match one {
        Some(_) => Cases::new(&chosen, &settings),
        None => Cases::new(&scope::regions(chosen, &args.place)?, &settings),
    };
    if one.is_none() {
        forecast::points(&cases, args.decimal)?;
    }
    output.write(|out| {
        header(&*method, out)?;
        if let Some(case) = one {
            heading(&*method, &case, out)?;
            return Ok(writeln!(out, "{}", wire::line(&case.input, args.decimal))?);
        }
        let mut region = "";
        for i in 0..cases.len() {
            let case = cases.get(i);
            if case.region != region {
                region = case.region;
                heading(&*method, &case, out)?;
            }
            writeln!(out, "{}", wire::line(&case.input, args.decimal))?;
        }
        Ok(())
    })?;
    Ok(Outcome::AsExpected)
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
