//! The README and the book show what the program prints.
//!
//! A sample is a block ```` ```text ```` with a line `$ command` and its output; `…` on a line of
//! its own stands for any lines, at the end of one for the rest of it. `$ cat FILE` makes the file.
//! With `MECHAUDIT_SAMPLES=write` the lines are written anew instead of compared.
//!
//! The main job takes minutes: of its sample the counts, the lines of single methods and the
//! findings are compared with the parts that print them; the whole with the output in the file that
//! `MECHAUDIT_MAIN_JOB` names, which `.ci/run` makes. So do `MECHAUDIT_PROOF` and
//! `MECHAUDIT_PROOF_LOWER` for the proofs of the error bounds of the Faddeeva function, which take
//! a minute with all optimizations.

use crate::common::{run, skipped};
use mechaudit::audit::{Cases, Settings};
use mechaudit::methods;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// A command with the output shown.
#[derive(Debug)]
struct Sample {
    /// Number of the first line shown.
    start: usize,
    command: String,
    shown: Vec<String>,
}

fn samples(text: &str) -> Vec<Sample> {
    let mut all: Vec<Sample> = Vec::new();
    let mut inside = false;
    let mut open = false;
    for (i, line) in text.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(kind) => {
                inside = !inside && kind == "text";
                open = false;
            }
            None if !inside => {}
            None => match line.strip_prefix("$ ") {
                Some(command) => {
                    all.push(Sample {
                        start: i + 1,
                        command: command.into(),
                        shown: Vec::new(),
                    });
                    open = true;
                }
                None if open => all.last_mut().unwrap().shown.push(line.into()),
                None => {}
            },
        }
    }
    all
}

/// A line with its numbers made alike, and single blanks.
fn skeleton(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line.trim().chars().peekable();
    while let Some(c) = rest.next() {
        if c.is_ascii_digit() {
            let part = |c: &char| c.is_ascii_digit() || *c == '.' || *c == 'e';
            while rest.next_if(part).is_some() {}
            out.push('#');
        } else if !(c == ' ' && out.ends_with(' ')) {
            out.push(c);
        }
    }
    out
}

/// The lines due in place of those shown.
fn due(shown: &[String], printed: &[String]) -> Result<Vec<String>, String> {
    let (mut at, mut any) = (0, false);
    let mut all = Vec::new();
    for line in shown {
        if line.trim() == "…" {
            any = true;
            all.push(line.clone());
            continue;
        }
        let last = if any {
            printed.len()
        } else {
            printed.len().min(at + 1)
        };
        let near = &printed[at.min(last)..last];
        let word = |l: &str| l.split_whitespace().next().map(String::from);
        let head = line.strip_suffix('…');
        let fits: [&dyn Fn(&String) -> bool; 3] = [
            &|p| head.map_or(p == line, |h| p.starts_with(h)),
            &|p| match head {
                None => skeleton(p) == skeleton(line),
                Some(h) => skeleton(p).starts_with(&skeleton(h)),
            },
            &|p| word(p) == word(line),
        ];
        let Some(k) = fits.iter().find_map(|fit| near.iter().position(fit)) else {
            let next = near.first().map_or("(the end)", String::as_str);
            return Err(format!("{line:?} is not printed; there is {next:?}"));
        };
        all.push(match head {
            Some(h) => format!(
                "{}…",
                near[k].chars().take(h.chars().count()).collect::<String>()
            ),
            None => near[k].clone(),
        });
        (at, any) = (at + k + 1, false);
    }
    match any || at >= printed.len() {
        true => Ok(all),
        false => Err(format!("{:?} is printed but not shown", printed[at])),
    }
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(|l| l.trim_end().to_string()).collect()
}

/// Returns the output of a command, standard error last, in a folder like that of the sources.
fn printed(command: &str, folder: &Path) -> Vec<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_mechaudit"));
    let path = std::env::var("PATH").unwrap_or_default();
    let output = Command::new("sh")
        .args(["-c", command])
        .current_dir(folder)
        .env(
            "PATH",
            format!("{}:{path}", program.parent().unwrap().display()),
        )
        .env_remove("MECHAUDIT_EFFORT")
        .output()
        .unwrap();
    [output.stdout, output.stderr]
        .into_iter()
        .flat_map(|part| lines(&String::from_utf8(part).unwrap()))
        .collect()
}

/// Samples of a file against the program.
fn check(file: &str) {
    let path = Path::new(ROOT).join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for held in ["examples", "reference"] {
        let from = Path::new(ROOT).join(held);
        std::os::unix::fs::symlink(from, folder.path().join(held)).unwrap();
    }
    let mut new: Vec<String> = text.lines().map(String::from).collect();
    let (mut wrong, mut misfits) = (String::new(), String::new());
    for sample in samples(&text) {
        let command = sample.command.as_str();
        if let Some(name) = command.strip_prefix("cat ") {
            let content = sample.shown.join("\n") + "\n";
            std::fs::write(folder.path().join(name), content).unwrap();
            continue;
        }
        if command.contains("python3") && Command::new("python3").arg("-V").output().is_err() {
            skipped("python3");
            continue;
        }
        let kept = match command {
            "mechaudit" => Some("MECHAUDIT_MAIN_JOB"),
            "mechaudit prove faddeeva" => Some("MECHAUDIT_PROOF"),
            "mechaudit prove faddeeva --part lower" => Some("MECHAUDIT_PROOF_LOWER"),
            _ => None,
        };
        let found = match kept.map(output_in) {
            None => printed(command, folder.path()),
            Some(Some(file)) => lines(&std::fs::read_to_string(file).unwrap()),
            Some(None) => {
                if command == "mechaudit" && !writing() {
                    parts_of_the_main_job(&sample.shown);
                }
                continue;
            }
        };
        match due(&sample.shown, &found) {
            Err(why) => misfits += &format!("{file}: $ {command}: {why}\n"),
            Ok(due) => {
                for (k, (line, was)) in due.into_iter().zip(&sample.shown).enumerate() {
                    if line != *was {
                        let place = sample.start + k;
                        wrong += &format!("{file}:{}: {was:?}\n  is now {line:?}\n", place + 1);
                        new[place] = line;
                    }
                }
            }
        }
    }
    // Lines that came or went are for a person to write.
    assert!(misfits.is_empty(), "{misfits}");
    if writing() {
        std::fs::write(&path, new.join("\n") + "\n").unwrap();
    } else {
        assert!(
            wrong.is_empty(),
            "MECHAUDIT_SAMPLES=write makes them anew\n{wrong}"
        );
    }
}

fn writing() -> bool {
    std::env::var("MECHAUDIT_SAMPLES").is_ok_and(|v| v == "write")
}

/// The file that a variable names.
fn output_in(variable: &str) -> Option<PathBuf> {
    std::env::var_os(variable).map(|name| Path::new(ROOT).join(name))
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn parts_of_the_main_job(shown: &[String]) {
    let all = methods::registry();
    let settings = Settings::default();
    let cases: usize = all.iter().map(|m| Cases::new(&**m, &settings).len()).sum();
    let (n, counts) = (all.len(), "papers with 82 findings");
    let due = format!("{counts}; {n} methods pass, {cases} cases.");
    assert!(
        shown[0].contains(&due),
        "{:?}\n  holds no {due:?}",
        shown[0]
    );
    let rows = shown.iter().filter(|line| {
        let first = line.split_whitespace().next();
        first.is_some_and(|word| methods::find(word).is_some())
    });
    let mut met = 0;
    for row in rows {
        let fields: Vec<&str> = row.split_whitespace().collect();
        let [name, cases, ulps, conditioned, share, "%", "pass"] = fields[..] else {
            panic!("{row:?} is no line of a method that passes");
        };
        let full = run(&["audit", name]).out;
        let heading = words(full.lines().next().unwrap());
        assert_eq!(heading, format!("{name} pass {cases} of {cases} cases"));
        // Each is the worst of some output.
        let outputs: Vec<String> = full.lines().map(words).collect();
        let found = |value: &str| outputs.iter().any(|l| l.split(' ').any(|w| w == value));
        let worst = found(ulps) && found(conditioned) && found(share);
        assert!(worst, "{row}\n{full}");
        met += 1;
    }
    assert!(met > 0, "no method is shown");
    let paper = words(&run(&["paper", "zinchenko"]).out);
    let from = shown.iter().position(|l| l.starts_with("zinchenko: "));
    let said = &shown[from.expect("no paper is shown") + 1..];
    for part in said.iter().map(|l| words(l.trim_end_matches('…'))) {
        assert!(paper.contains(&part), "{part:?} is not in the report");
    }
}

#[test]
fn the_readme() {
    check("README.md");
    check("examples/README.md");
}

#[test]
fn the_book() {
    let mut met = 0;
    for entry in std::fs::read_dir(Path::new(ROOT).join("src/book")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.ends_with(".md") {
            check(&format!("src/book/{name}"));
            met += 1;
        }
    }
    assert!(met > 5);
}

#[test]
fn samples_are_found_and_compared() {
    let text = "```text\n$ one\na 1\n…\nb 2.5e3 …\n$ two\n```\n```sh\n$ three\n```\n";
    let all = samples(text);
    assert_eq!(all.len(), 2);
    assert_eq!(
        (all[0].start, all[0].shown.len(), all[1].shown.len()),
        (2, 3, 0)
    );
    let shown = &all[0].shown;
    let print = |text: &str| due(shown, &lines(text));
    assert_eq!(print("a 1\nx\nb 2.5e3 and more"), Ok(shown.clone()));
    let other = ["a 7", "…", "b 3.1e7 …"].map(String::from).to_vec();
    assert_eq!(print("a 7\nb 3.1e7 c"), Ok(other));
    for wrong in ["x\na 1\nb 2.5e3 c", "a 1\nx", "a 1\nb 2.5e3 c\nmore", ""] {
        assert!(print(wrong).is_err(), "{wrong:?}");
    }
}
