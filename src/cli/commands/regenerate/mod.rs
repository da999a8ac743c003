//! Generated files: regenerated, or compared with what is held.

mod andrews_motion;
mod faddeeva_tables;
mod method_values;
mod n_four_bar_motion;
mod sand_screen;

use crate::cli::args::RegenerateArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome, chain};
use crate::cli::files::artefact::{self, Artefact, Form, Made, MakeError, broken, difference};
use crate::cli::files::errata;
use crate::cli::files::output::{Output, write_to};
use crate::cli::progress::Progress;
use mechaudit::report::glossary;
use mechaudit::report::text::style::{BAD, DIM, GOOD, paint};
use mechaudit::{methods, papers};
use std::io::ErrorKind;
use std::path::Path;

const VALUES: &str = "reference/values";
const PUBLISHED: &str = "reference/published";
const SOLVERS: &str = "src/solvers";
const BOOK: &str = "src/book";

/// Every generated file.
fn artefacts() -> Vec<Artefact> {
    let csv = |name: &str, make: Box<dyn Fn() -> artefact::Outcome<Made>>| Artefact {
        name: name.into(),
        path: Path::new(VALUES).join(format!("{name}.csv")),
        form: Form::Csv,
        make,
    };
    let rust = |name: &str, file: &str, make: fn() -> artefact::Outcome<Made>| Artefact {
        name: name.into(),
        path: Path::new(SOLVERS).join(file),
        form: Form::Rust,
        make: Box::new(make),
    };
    let errata = |key: &'static str| Artefact {
        name: errata::name(key),
        path: Path::new(PUBLISHED).join(format!("{}.json", errata::name(key))),
        form: Form::Json,
        make: Box::new(move || {
            let ledger = papers::ledger_of(key).ok_or(MakeError::NoPaper(key))?;
            errata::made(&ledger)
        }),
    };
    let mut all: Vec<Artefact> = methods::registry()
        .into_iter()
        .map(|method| {
            let name = method.name();
            csv(name, Box::new(move || method_values::made(&*method)))
        })
        .collect();
    all.push(csv("sand-screen-run-up", Box::new(sand_screen::made)));
    all.push(csv("andrews-motion", Box::new(andrews_motion::made)));
    all.push(csv("n-four-bar-motion", Box::new(n_four_bar_motion::made)));
    all.extend(papers::keys().into_iter().map(errata));
    all.push(Artefact {
        name: "columns".into(),
        path: Path::new(BOOK).join("columns.md"),
        form: Form::Chapter,
        make: Box::new(|| {
            Ok(Made {
                title: String::new(),
                facts: Vec::new(),
                recipe: String::new(),
                body: glossary::chapter(),
            })
        }),
    });
    all.extend([
        rust(
            "arithmetic-tables",
            "arithmetic/tables.rs",
            faddeeva_tables::arithmetic_tables,
        ),
        rust(
            "faddeeva-tables",
            "special/faddeeva/tables.rs",
            faddeeva_tables::tables,
        ),
        rust(
            "faddeeva-constants",
            "special/faddeeva/constants.rs",
            faddeeva_tables::constants,
        ),
        rust(
            "faddeeva-relatives-tables",
            "special/faddeeva/relatives_tables.rs",
            faddeeva_tables::relatives_tables,
        ),
    ]);
    all
}

fn chosen(names: &[String]) -> Result<Vec<Artefact>, Failure> {
    let mut all = artefacts();
    if let Some(unknown) = names.iter().find(|n| all.iter().all(|a| a.name != **n)) {
        let known: Vec<&str> = all.iter().map(|a| a.name.as_str()).collect();
        return Err(Failure::no_such("generated file", unknown, &known));
    }
    all.retain(|a| names.is_empty() || names.contains(&a.name));
    Ok(all)
}

/// Makes or compares what the arguments name.
pub fn regenerate(args: &RegenerateArgs) -> Result<Outcome, Failure> {
    let chosen = chosen(&args.names)?;
    for folder in [VALUES, PUBLISHED, SOLVERS] {
        if !args.root.join(folder).is_dir() {
            return Err(Failure::new(format!(
                "{} holds no {folder}: --root has to be the folder of mechaudit's sources",
                args.root.display()
            )));
        }
    }
    let progress = Progress::new();
    let total = chosen.len() as u64;
    let mut good = 0;
    for (done, artefact) in chosen.iter().enumerate() {
        progress.show(&artefact.name, done as u64, total);
        let path = args.root.join(&artefact.path);
        let output = match args.check {
            true => None,
            false => Some(Output::open(Some(&path))?),
        };
        let text = match artefact.text() {
            Ok(text) => text,
            Err(e) => {
                progress.clear();
                complain(&format!("{}: {}", artefact.name, chain(&*e)));
                continue;
            }
        };
        let fault = match (held(&path)?, output) {
            (Some(found), _) if found == text => None,
            (Some(found), None) => Some(fault(artefact.form, &found, &text)),
            (None, None) => Some("it is not there".into()),
            (_, Some(output)) => {
                output.text(&text)?;
                progress.clear();
                line(artefact, &paint(GOOD, "written"))?;
                good += 1;
                continue;
            }
        };
        progress.clear();
        match fault {
            None => {
                line(artefact, &paint(DIM, "as held"))?;
                good += 1;
            }
            Some(fault) => line(artefact, &paint(BAD, &fault))?,
        }
    }
    let summary = match args.check {
        true => format!("{good} of {total} files are what the references give."),
        false => format!("{good} of {total} files are up to date."),
    };
    write_to(|out| Ok(writeln!(out, "{summary}")?))?;
    Ok(Outcome::of(good as u64 == total))
}

fn line(artefact: &Artefact, what: &str) -> Result<(), Failure> {
    let path = artefact.path.display();
    write_to(|out| Ok(writeln!(out, "{path}: {what}")?))
}

/// The first difference of a file, and whether its digest is broken.
fn fault(form: Form, found: &str, due: &str) -> String {
    let place = difference(found, due).unwrap_or_default();
    match broken(form, found) {
        Some(why) => format!("{place}; {why}"),
        None => place,
    }
}

fn held(path: &Path) -> Result<Option<String>, Failure> {
    match std::fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
        Err(e) => Err(Failure::cannot("read", path, e)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Every generated file of the folders is made and compared: none is left out of what is chosen
    /// without a name.
    #[test]
    fn no_file_of_the_folders_is_left_out() {
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        let made: BTreeSet<_> = match chosen(&[]) {
            Ok(all) => all.into_iter().map(|a| a.path).collect(),
            Err(_) => panic!("without names all are chosen"),
        };
        let mut there = BTreeSet::new();
        for (folder, ending) in [
            (VALUES, ".csv"),
            (PUBLISHED, "-errata.json"),
            (BOOK, "columns.md"),
            ("src/solvers/arithmetic", "tables.rs"),
            ("src/solvers/special/faddeeva", "tables.rs"),
            ("src/solvers/special/faddeeva", "constants.rs"),
        ] {
            for entry in std::fs::read_dir(root.join(folder)).expect("a folder") {
                let name = entry.expect("an entry").file_name();
                let name = name.to_str().expect("text").to_owned();
                if name.ends_with(ending) {
                    there.insert(Path::new(folder).join(name));
                }
            }
        }
        assert_eq!(made, there);
    }

    #[test]
    fn files_are_chosen_by_name() {
        let names = |asked: &[&str]| {
            let asked: Vec<String> = asked.iter().map(|n| n.to_string()).collect();
            chosen(&asked).map(|all| all.into_iter().map(|a| a.name).collect::<Vec<_>>())
        };
        let of = |asked: &[&str]| names(asked).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(of(&["faddeeva-tables", "erf"]), ["erf", "faddeeva-tables"]);
        let all = of(&[]);
        for method in methods::registry() {
            assert!(all.iter().any(|n| n == method.name()));
        }
        let why = names(&["erf", "erff"]).unwrap_err().to_string();
        assert!(
            why.starts_with(
                "there is no generated file \"erff\" (did you mean \"erf\"?); there are: "
            ),
            "{why}"
        );
    }

    #[test]
    fn a_fault_is_a_place_and_a_digest() {
        let made = |body: &str| Made {
            title: "Numbers".into(),
            facts: Vec::new(),
            recipe: String::new(),
            body: body.into(),
        };
        let due = artefact::document("some", Form::Csv, &made("1\n")).unwrap();
        let other = artefact::document("some", Form::Csv, &made("2\n")).unwrap();
        let edited = due.replace("\n1\n", "\n2\n");
        let line = due.lines().count();
        // Its own digest holds: it is of another recipe.
        assert!(!fault(Form::Csv, &other, &due).contains(';'));
        let said = fault(Form::Csv, &edited, &due);
        let end = "; its content does not match the digest in its header";
        assert_eq!(
            said,
            format!("line {line}, column 1: found `2`, due `1`{end}")
        );
    }

    /// A folder like that of the sources, with a file of values as it is held, changed and gone.
    #[test]
    fn files_are_compared_or_written() {
        use crate::cli::ran;
        let root = tempfile::tempdir().unwrap();
        let at = |path: &str| root.path().join(path);
        let run = |more: &[&str]| {
            let root = ["regenerate", "--root", root.path().to_str().unwrap()];
            ran(&[&root[..], &["faddeeva-constants"], more].concat()).map_err(|e| e.to_string())
        };
        for folder in [VALUES, PUBLISHED, SOLVERS] {
            let why = run(&["--check"]).unwrap_err();
            let due =
                format!("holds no {folder}: --root has to be the folder of mechaudit's sources");
            assert!(why.ends_with(&due), "{why}");
            std::fs::create_dir_all(at(folder)).unwrap();
        }
        let path = "src/solvers/special/faddeeva/constants.rs";
        std::fs::create_dir_all(at(path).parent().unwrap()).unwrap();
        let due = std::fs::read_to_string(
            Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(path),
        )
        .unwrap();
        assert_eq!(run(&["--check"]), Ok(Outcome::Finding));
        assert!(!at(path).exists());
        assert_eq!(run(&[]), Ok(Outcome::AsExpected));
        assert_eq!(std::fs::read_to_string(at(path)).unwrap(), due);
        assert_eq!(run(&["--check"]), Ok(Outcome::AsExpected));
        let changed = due.replace("1.1283791670955126", "1.1283791670955127");
        std::fs::write(at(path), &changed).unwrap();
        assert_eq!(run(&["--check"]), Ok(Outcome::Finding));
        assert_eq!(std::fs::read_to_string(at(path)).unwrap(), changed);
        assert_eq!(run(&[]), Ok(Outcome::AsExpected));
        assert_eq!(std::fs::read_to_string(at(path)).unwrap(), due);
        assert!(held(&at(path)).unwrap().is_some() && held(&at("none")).unwrap().is_none());
        assert!(held(root.path()).is_err());
    }
}
