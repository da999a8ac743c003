//! Inputs of a method, as lines for programs in any language.

use crate::cli::args::PointsArgs;
use crate::cli::commands::audit::find;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::{commands::hunt::hard_folder, forecast, process::wire};
use mechaudit::audit::{Case, Cases, Layout, Method, Settings, Variant};
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
    if let Some(folder) = &args.hard {
        chosen = chosen.hard_cases(hard_folder::of_method(folder, &*method)?);
    }
    let all = Cases::new(&chosen, &settings);
    let one = match (&args.check_point, &args.region, args.case) {
        _ if args.hard_case.is_some() => args.hard_case.map(|n| all.hard_case(n)).transpose()?,
        (Some(name), ..) => Some(all.at_check_point(name)?),
        (None, Some(region), Some(index)) => Some(all.in_region(region, index)?),
        _ => None,
    };
    let cases = match &args.region {
        Some(region) => Cases::new(&chosen.region(region)?, &settings),
        None => all,
    };
    if one.is_none() {
        forecast::points(&cases, &settings, args.decimal)?;
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
        mechaudit::audit::Origin::Random { seed, index } => format!("seed {seed}, from {index}"),
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
