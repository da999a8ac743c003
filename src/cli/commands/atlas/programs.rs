//! Libraries and programs beside the algorithms.

use crate::cli::args::AtlasArgs;
use crate::cli::failure::Failure;
use crate::cli::process::answers::{Batch, Form, Header};
use crate::cli::process::candidate::{Candidate, CandidateProcess};
use crate::cli::process::inputs::Inputs;
use crate::cli::workload::given;
use mechaudit::audit::SolverAnswer;
use mechaudit::claims::{Code, Missing, Parts, Plane};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Duration;

/// The candidate of every library that Python reaches.
const SCRIPT: &str = include_str!("../../../../examples/atlas/libraries.py");
/// The libraries that the script knows.
const KNOWN: [(&str, Parts); 9] = [
    ("scipy", Parts::Both),
    ("libcerf", Parts::Both),
    ("mpmath", Parts::Both),
    ("jax", Parts::Both),
    ("astropy", Parts::Real),
    ("lmfit", Parts::Real),
    ("mht-accurate", Parts::Both),
    ("mht-fast", Parts::Both),
    ("hapi", Parts::Both),
];
/// The exit code of the script where a library is not installed.
const NOT_INSTALLED: i32 = 3;
/// The time for which a program may be silent.
const PATIENCE: Duration = Duration::from_secs(120);

/// A program with its name.
pub struct Library {
    name: String,
    version: String,
    command: String,
    parts: Parts,
    nanoseconds: Option<f64>,
}

/// Those that the arguments ask for, and those that are not installed.
pub fn all(args: &AtlasArgs) -> Result<(Vec<Library>, Vec<Missing>), Failure> {
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for (name, parts) in KNOWN.iter().filter(|_| args.libraries) {
        match version(name)? {
            Some(version) => {
                // Warnings of the libraries are no answers.
                let command = format!("python3 -W ignore -c {} {name}", shell_words::quote(SCRIPT));
                let timed = format!("{command} --time");
                let asked = (!args.no_speed).then(|| header(&timed));
                found.push(Library {
                    name: name.to_string(),
                    version,
                    command,
                    parts: *parts,
                    nanoseconds: asked.and_then(|h| h.ns),
                })
            }
            None => missing.push(Missing {
                name: name.to_string(),
                source: "library".into(),
                why: "not installed".into(),
            }),
        }
    }
    for command in &args.exec {
        let header = header(command);
        found.push(Library {
            name: header.name.unwrap_or_else(|| command.clone()),
            version: header.version.unwrap_or_default(),
            command: command.clone(),
            parts: Parts::Both,
            nanoseconds: header.ns.filter(|_| !args.no_speed),
        });
    }
    Ok((found, missing))
}

/// The version of a library; nothing where it is not installed.
fn version(name: &str) -> Result<Option<String>, Failure> {
    let started = Command::new("python3")
        .args(["-c", SCRIPT, name, "--version"])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output();
    let Ok(done) = started else {
        // No Python: nothing of the list is there.
        return Ok(None);
    };
    match done.status.code() {
        Some(0) => Ok(Some(String::from_utf8_lossy(&done.stdout).trim().into())),
        Some(NOT_INSTALLED) => Ok(None),
        _ => Err(Failure::new(format!("{name}: its version is not known"))),
    }
}

impl Library {
    /// As code of the survey.
    pub fn code<'a>(self) -> Code<'a> {
        let title = match self.version.is_empty() {
            true => "a program".to_string(),
            false => format!("{} {}", self.name, self.version),
        };
        let (command, parts) = (self.command, self.parts);
        let answers = move |inputs: &[Vec<f64>]| answers(&command, inputs);
        // Below the axis too, where a library goes there: what it refuses is counted.
        let plane = match self.name.as_str() {
            "jax" | "astropy" | "lmfit" | "mht-accurate" | "mht-fast" | "hapi" => Plane::Upper,
            _ => Plane::Whole,
        };
        let mut code = Code::other((self.name, title, self.version), plane, parts, answers);
        code.nanoseconds = self.nanoseconds;
        code
    }
}

/// Returns the header that a program writes before its first answer.
fn header(command: &str) -> Header {
    let answered = answered(command, vec![vec![1.0, 1.0]]);
    answered.map_or_else(|_| Header::default(), |(process, ..)| process.header())
}

/// Returns a program that has ended, its answers, and the trouble with it, if there was any.
fn answered(
    command: &str,
    inputs: Vec<Vec<f64>>,
) -> Result<(CandidateProcess, Batch, Option<String>), Failure> {
    let candidate = Candidate {
        command: command.into(),
        timeout: PATIENCE,
        run_timeout: Duration::from_secs(3600),
        form: Form::Lines,
        decimal: false,
        lines: crate::cli::process::answers::AnswerLines::default(),
    };
    let total = inputs.len();
    let cases = inputs.into_iter().map(|z| given("faddeeva", z));
    let listed = Arc::new(Inputs::listed(cases.collect()));
    let mut process = CandidateProcess::start(&candidate, &listed, total)?;
    let mut batch = Batch::default();
    let end = process.collect(total, &mut batch);
    let end = end.unwrap_or_else(|| process.rest());
    let trouble = process.end(end);
    Ok((process, batch, trouble))
}

/// Returns the answers of the program; a missing one is unanswered.
fn answers(command: &str, inputs: &[Vec<f64>]) -> Vec<SolverAnswer> {
    let (batch, trouble) = match answered(command, inputs.to_vec()) {
        Err(e) => (Batch::default(), Some(e.to_string())),
        Ok((_, batch, trouble)) => (batch, trouble),
    };
    let why = trouble.unwrap_or("nothing came".into());
    let unanswered = || SolverAnswer::Unanswered(why.clone());
    let given = |i: usize| (i < batch.len()).then(|| batch.get(i));
    (0..inputs.len())
        .map(|i| given(i).unwrap_or_else(unanswered))
        .collect()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::cli::args::{Args, Command as Asked};
    use clap::Parser;

    fn shell(script: &str) -> String {
        format!("sh -c {}", shell_words::quote(script))
    }

    const HEAD: &str = "echo '# name: w'; echo '# version: 7'; echo '# ns: 47.5'; ";

    fn asked(words: &[&str]) -> Vec<Library> {
        let read = Args::try_parse_from([&["mechaudit", "atlas"], words].concat());
        let Some(Asked::Atlas(args)) = read.unwrap().command else {
            panic!("the atlas");
        };
        let (found, missing) = all(&args).unwrap();
        assert_eq!(missing.len(), 0);
        found
    }

    #[test]
    fn programs_are_called_as_they_say() {
        let known = shell(&format!("{HEAD} read x; echo 0,0"));
        let (silent, gone) = (shell("read x; echo 0,0"), "/no/such/program");
        let of = |more: &[&str]| {
            asked(&[&["--exec", &known, "--exec", &silent, "--exec", gone], more].concat())
        };
        let found = of(&[]);
        let facts = |l: &Library| {
            (
                l.name.clone(),
                l.version.clone(),
                l.command.clone(),
                l.nanoseconds,
            )
        };
        let due = [
            ("w".to_string(), "7".to_string(), known.clone(), Some(47.5)),
            (silent.clone(), String::new(), silent.clone(), None),
            (gone.to_string(), String::new(), gone.to_string(), None),
        ];
        assert_eq!(found.iter().map(facts).collect::<Vec<_>>(), due);
        assert!(of(&["--no-speed"]).iter().all(|l| l.nanoseconds.is_none()));
        let codes: Vec<Code> = found.into_iter().map(Library::code).collect();
        let titles: Vec<&str> = codes.iter().map(|c| c.title.as_str()).collect();
        assert_eq!(titles, ["w 7", "a program", "a program"]);
        let first = &codes[0];
        let named = (
            first.name.as_str(),
            first.source.as_str(),
            first.nanoseconds,
        );
        assert_eq!(named, ("w", "7", Some(47.5)));
        assert!(
            codes
                .iter()
                .all(|c| c.plane == Plane::Whole && c.parts == Parts::Both)
        );
    }

    /// Libraries of the real line's profile and of the upper half-plane are asked nothing below it.
    #[test]
    fn libraries_have_their_half_plane() {
        for (name, parts) in KNOWN {
            let library = Library {
                name: name.into(),
                version: "1".into(),
                command: String::new(),
                parts,
                nanoseconds: None,
            };
            let code = library.code();
            let whole = ["scipy", "libcerf", "mpmath"].contains(&name);
            assert_eq!(code.plane == Plane::Whole, whole, "{name}");
            assert_eq!(
                code.parts == Parts::Real,
                ["astropy", "lmfit"].contains(&name),
                "{name}"
            );
        }
    }

    #[test]
    fn what_does_not_come_is_unanswered() {
        let inputs = vec![vec![1.0, 2.0], vec![3.0, 4.0], vec![5.0, 6.0]];
        let given = |script: &str| answers(&shell(script), &inputs);
        let all = given("while read x; do echo $x; done");
        let due: Vec<SolverAnswer> = inputs.iter().cloned().map(SolverAnswer::Values).collect();
        assert_eq!(all, due);
        let why = "The program answered 1 times, then ended: exit status 3; 2 of 3 inputs are unanswered.";
        let left = SolverAnswer::Unanswered(why.into());
        let some = given("read x; echo $x; exit 3");
        assert_eq!(some, [due[0].clone(), left.clone(), left]);
        for answer in answers("/no/such/program", &inputs) {
            let SolverAnswer::Unanswered(why) = answer else {
                panic!("{answer:?}");
            };
            assert!(why.starts_with("cannot start "), "{why}");
        }
    }
}
