//! The atlas of published algorithms for W(z) and the Voigt function.

mod point;
mod programs;

use crate::cli::args::{AtlasArgs, AtlasFormat, AtlasTable};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json};
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use crate::cli::terminal::width;
use mechaudit::claims::{
    Algorithm, Code, Effort, Map, PROFILES, Profile, algorithms, atlas as whole, map,
};
use mechaudit::report::{self, html, text};

/// Points in each region where nothing else is asked for.
const CASES: u64 = 200;

/// Makes it and writes it.
pub fn atlas(args: &AtlasArgs) -> Result<Outcome, Failure> {
    let chosen = chosen(&args.only)?;
    if let Some(z) = &args.at {
        return point::show(&chosen.0, &chosen.1, z);
    }
    let output = Output::open(args.output.as_deref())?;
    let effort = Effort {
        cases: args.cases.unwrap_or(CASES),
        seed: args.seed.unwrap_or(1),
    };
    let (programs, missing) = programs::all(args)?;
    let timed = !args.no_speed;
    let mapped = args.format == AtlasFormat::Html;
    let asked = (chosen.clone(), programs);
    let made = interrupt::unless_requested(move || made(asked, effort, timed, mapped));
    let Some((mut found, maps)) = made else {
        return Ok(Outcome::Interrupted);
    };
    found.not_at_hand.extend(missing);
    match args.format {
        AtlasFormat::Text => {
            output.write(|out| Ok(write!(out, "{}", text::atlas::atlas(&found, width()))?))?
        }
        AtlasFormat::Json => write_json(output, &report::atlas::document(&found))?,
        AtlasFormat::Csv => output.write(|out| {
            let written = match args.table {
                AtlasTable::Rows => report::atlas::rows(&found, out),
                AtlasTable::Claims => report::atlas::claims(&found, out),
            };
            Ok(written?)
        })?,
        AtlasFormat::Html => output.text(html::atlas::page(&found, &maps))?,
    }
    Ok(Outcome::AsExpected)
}

type Chosen = (Vec<Algorithm>, Vec<Profile>);
type Asked = (Chosen, Vec<programs::Library>);
type Made = (mechaudit::claims::Atlas, Vec<(String, Map)>);

fn made(((chosen, profiles), programs): Asked, effort: Effort, timed: bool, mapped: bool) -> Made {
    let progress = Progress::new();
    let mut codes: Vec<Code> = chosen.iter().map(|a| Code::double(*a)).collect();
    codes.extend(programs.into_iter().map(programs::Library::code));
    codes.extend(chosen.iter().filter_map(|a| Code::single(*a)));
    // Values, derivatives, heights and seams of three groups, lines, the speed, the claims.
    let steps = 14 + mechaudit::claims::claims().len() as u64;
    let found = whole(&codes, &profiles, &effort, timed, &|what| {
        progress.tick(what, steps);
    });
    let double = codes.iter().filter(|c| mapped && !c.single);
    let maps = double.map(|c| (c.name.clone(), map(c))).collect();
    progress.clear();
    (found, maps)
}

fn chosen(names: &[String]) -> Result<Chosen, Failure> {
    let (mut chosen, mut profiles) = (algorithms(), PROFILES.to_vec());
    let of_w = chosen.iter().map(|a| a.name);
    let known: Vec<&str> = of_w.chain(profiles.iter().map(|p| p.name)).collect();
    if let Some(name) = names.iter().find(|n| !known.contains(&n.as_str())) {
        return Err(Failure::no_such("algorithm", name, &known));
    }
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    chosen.retain(|a| wanted(a.name));
    profiles.retain(|p| wanted(p.name));
    Ok((chosen, profiles))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn algorithms_and_profiles_are_chosen_by_name() {
        let of = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|n| n.to_string()).collect();
            let (algorithms, profiles) = chosen(&names)?;
            let all: Vec<&str> = algorithms
                .iter()
                .map(|a| a.name)
                .chain(profiles.iter().map(|p| p.name))
                .collect();
            Ok::<_, Failure>((algorithms.len(), profiles.len(), all))
        };
        let all = of(&[]).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((all.0, all.1), (algorithms().len(), PROFILES.len()));
        let (first, profile) = (all.2[0], PROFILES[0].name);
        let (n, m, names) = of(&[profile, first]).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((n, m, names), (1, 1, vec![first, profile]));
        let why = of(&[first, "none"]).map(|_| ()).unwrap_err().to_string();
        assert!(why.starts_with("there is no algorithm \"none\""), "{why}");
    }

    /// Maps are of codes in double precision, and made where they are asked for.
    #[test]
    fn maps_are_made_for_pages() {
        let effort = Effort { cases: 1, seed: 1 };
        let one = |mapped: bool| {
            let some = algorithms()
                .into_iter()
                .find(|a| a.single.is_some())
                .unwrap();
            let name = some.name;
            let (found, maps) = made(
                ((vec![some], Vec::new()), Vec::new()),
                effort,
                false,
                mapped,
            );
            let rows: Vec<String> = found.rows.iter().map(|r| r.name.clone()).collect();
            let names: Vec<String> = maps.into_iter().map(|m| m.0).collect();
            (name, rows, names)
        };
        let (name, rows, maps) = one(true);
        assert_eq!(rows, [name.to_string(), format!("{name} (f32)")]);
        assert_eq!(maps, [name]);
        assert!(one(false).2.is_empty());
    }
}
