//! A paper's ledger in the form asked for.

use crate::cli::args::{PaperArgs, PaperFormat};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::{errata, output::Output};
use crate::cli::{complain, terminal};
use mechaudit::papers::PaperFile;
use mechaudit::report::{html, latex, text};
use std::time::Instant;

/// Decides the ledger and writes it, or compares it with the file.
pub fn ledger(args: &PaperArgs, paper: &PaperFile) -> Result<Outcome, Failure> {
    // With --check the file is read.
    let output = Output::open(args.output.as_deref().filter(|_| !args.check))?;
    let standard = output.is_standard() && !args.check;
    let started = Instant::now();
    let ledger = paper.ledger();
    let seconds = started.elapsed().as_secs_f64();
    let width = match standard {
        true => terminal::width(),
        false => 100,
    };
    let written = match args.format {
        PaperFormat::Text => text::ledger::ledger(&ledger, width),
        PaperFormat::Json => json(&ledger)?,
        PaperFormat::Html => html::ledger::page(&ledger),
        PaperFormat::Latex => latex::ledger(&ledger),
        PaperFormat::Errata => errata::text(&ledger).map_err(Failure::caused)?,
        PaperFormat::Csv => return Err(Failure::new("a ledger has no CSV form")),
    };
    if args.check {
        return check(args, &written);
    }
    output.write(|out| {
        out.write_all(written.as_bytes())?;
        if args.format == PaperFormat::Text && standard {
            writeln!(out, "\nDecided in {seconds:.2} s.")?;
        }
        Ok(())
    })?;
    Ok(Outcome::of(ledger.as_recorded()))
}

fn json<T: serde::Serialize>(value: &T) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(Failure::caused)?;
    Ok(text + "\n")
}

/// Returns true if the file holds what would be written.
fn check(args: &PaperArgs, written: &str) -> Result<Outcome, Failure> {
    let Some(path) = &args.output else {
        return Err(Failure::new("--check needs --output FILE to compare with"));
    };
    let held = std::fs::read_to_string(path).map_err(|e| Failure::cannot("read", path, e))?;
    // Colour is for terminals; files never have any.
    let plain = anstream::adapter::strip_str(written).to_string();
    let same = held == plain;
    if !same {
        complain(&format!("{} is not up to date", path.display()));
    }
    Ok(Outcome::of(same))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command};
    use clap::Parser;
    use mechaudit::papers;

    fn asked(line: &str) -> PaperArgs {
        let words = ["mechaudit", "paper"]
            .into_iter()
            .chain(line.split_whitespace());
        match Args::parse_from(words).command {
            Some(Command::Paper(args)) => args,
            _ => unreachable!("a paper"),
        }
    }

    /// A file has the text in 100 columns and nothing of how long it took.
    #[test]
    fn a_ledger_in_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ledger");
        let found = papers::ledger_of("n-four-bar").unwrap();
        let wide =
            |width| anstream::adapter::strip_str(&text::ledger::ledger(&found, width)).to_string();
        let due = wide(100);
        assert!(wide(99) != due && wide(101) != due);
        let file = path.display();
        let run = |more: &str| {
            let paper = papers::open("n-four-bar").unwrap().unwrap();
            ledger(&asked(&format!("n-four-bar --ledger {more}")), &paper)
        };
        let good = Outcome::of(found.as_recorded());
        assert_eq!(run(&format!("--output {file}")).unwrap(), good);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), due);
        assert_eq!(
            run(&format!("--output {file} --check")).unwrap(),
            Outcome::AsExpected
        );
        std::fs::write(&path, format!("{due} ")).unwrap();
        assert_eq!(
            run(&format!("--output {file} --check")).unwrap(),
            Outcome::Finding
        );
        assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{due} "));
        assert!(run("--format csv").is_err());
        assert_eq!(
            run(&format!("--output {file} --format json")).unwrap(),
            good
        );
        let json = std::fs::read_to_string(&path).unwrap();
        assert!(json.ends_with("}\n") && serde_json::from_str::<serde_json::Value>(&json).is_ok());
    }
}
