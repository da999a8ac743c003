//! The tests: which there are, what each reaches, and which of them fails for a mutant.

use crate::tree::Executable;
use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use wait_timeout::ChildExt;

/// One test of one executable.
pub struct Test {
    pub executable: Executable,
    pub name: String,
    pub takes: Duration,
    /// Mutants it caught.
    pub catches: AtomicUsize,
}

/// How a mutant fared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    Caught(String),
    TimedOut(String),
    Missed,
    /// No test comes by.
    Unreached,
}

/// The tests with what they reach.
pub struct Suite {
    pub tests: Vec<Test>,
    /// The tests that reach a mutant.
    pub reaching: BTreeMap<u32, Vec<usize>>,
    /// Tests left out because they take too long.
    pub too_long: Vec<String>,
}

/// A test has this much more time than it takes without a mutant.
const SLOWER: u32 = 10;
const MORE: Duration = Duration::from_secs(3);
/// No test without a mutant takes longer.
pub const LONGEST: Duration = Duration::from_secs(600);

/// The time that a test has with a mutant.
pub fn limit(takes: Duration) -> Duration {
    takes * SLOWER + MORE
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    Passed,
    Failed,
    TimedOut,
}

pub fn run(
    executable: &Executable,
    name: &str,
    environment: &[(&str, &str)],
    limit: Duration,
) -> Result<Ended> {
    let mut child = Command::new(&executable.path)
        .current_dir(&executable.folder)
        .args(["--exact", name, "--test-threads", "1", "--include-ignored"])
        .env("PROPTEST_CASES", "32")
        // What a mutant fails on is no case for those after it.
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true")
        .env("INSTA_UPDATE", "no")
        .envs(environment.iter().copied())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .with_context(|| executable.path.display().to_string())?;
    Ok(match child.wait_timeout(limit)? {
        Some(status) if status.success() => Ended::Passed,
        Some(_) => Ended::Failed,
        None => {
            child.kill()?;
            child.wait()?;
            Ended::TimedOut
        }
    })
}

/// The names of an executable's tests that hold one of the filters.
pub fn names(executable: &Executable, filters: &[String]) -> Result<Vec<String>> {
    let out = Command::new(&executable.path)
        .current_dir(&executable.folder)
        .args(["--list", "--format", "terse"])
        .output()?;
    let text = String::from_utf8(out.stdout)?;
    let all = text.lines().filter_map(|l| l.strip_suffix(": test"));
    Ok(all
        .filter(|n| filters.is_empty() || filters.iter().any(|f| n.contains(f.as_str())))
        .map(str::to_owned)
        .collect())
}

impl Suite {
    /// Runs every test once without a mutant.
    pub fn new(
        executables: &[Executable],
        filters: &[String],
        longest: Duration,
        jobs: usize,
        scratch: &Path,
    ) -> Result<Suite> {
        let mut all = Vec::new();
        for e in executables {
            all.extend(names(e, filters)?.into_iter().map(|n| (e.clone(), n)));
        }
        if all.is_empty() {
            bail!("no test matches");
        }
        let next = AtomicUsize::new(0);
        let found = Mutex::new(Vec::new());
        let failed: Mutex<Option<anyhow::Error>> = Mutex::new(None);
        std::thread::scope(|scope| {
            for job in 0..jobs {
                let (all, next, found, failed) = (&all, &next, &found, &failed);
                scope.spawn(move || {
                    while let Some((i, (executable, name))) = {
                        let i = next.fetch_add(1, Ordering::Relaxed);
                        all.get(i).map(|t| (i, t))
                    } {
                        let trace = scratch.join(format!("trace-{job}"));
                        match traced(executable, name, &trace) {
                            Ok(t) => found.lock().unwrap().push((i, t)),
                            Err(e) => *failed.lock().unwrap() = Some(e),
                        }
                    }
                });
            }
        });
        if let Some(e) = failed.into_inner().unwrap() {
            return Err(e);
        }
        let mut found = found.into_inner().unwrap();
        found.sort_by_key(|(i, _)| *i);
        let mut suite = Suite {
            tests: Vec::new(),
            reaching: BTreeMap::new(),
            too_long: Vec::new(),
        };
        for (i, (takes, reached)) in found {
            let (executable, name) = all[i].clone();
            if takes > longest {
                if !reached.is_empty() {
                    suite.too_long.push(name);
                }
                continue;
            }
            for m in reached {
                suite.reaching.entry(m).or_default().push(suite.tests.len());
            }
            suite.tests.push(Test {
                executable,
                name,
                takes,
                catches: AtomicUsize::new(0),
            });
        }
        Ok(suite)
    }

    /// Runs the tests that reach a mutant, the likeliest and quickest first, until one fails.
    pub fn judge(&self, mutant: u32) -> Result<Verdict> {
        let Some(reaching) = self.reaching.get(&mutant) else {
            return Ok(Verdict::Unreached);
        };
        let mut order = reaching.clone();
        let price = |i: &usize| {
            let t = &self.tests[*i];
            let catches = t.catches.load(Ordering::Relaxed) as f64;
            (t.takes.as_secs_f64() + 0.01) / (catches + 1.0)
        };
        order.sort_by(|a, b| price(a).total_cmp(&price(b)));
        let number = mutant.to_string();
        for i in order {
            let t = &self.tests[i];
            let mutant = [("MUTANT", number.as_str())];
            match run(&t.executable, &t.name, &mutant, limit(t.takes))? {
                Ended::Passed => {}
                Ended::Failed => {
                    t.catches.fetch_add(1, Ordering::Relaxed);
                    return Ok(Verdict::Caught(t.name.clone()));
                }
                Ended::TimedOut => return Ok(Verdict::TimedOut(t.name.clone())),
            }
        }
        Ok(Verdict::Missed)
    }
}

/// The time that a test takes, and the mutants it reaches.
fn traced(executable: &Executable, name: &str, trace: &Path) -> Result<(Duration, HashSet<u32>)> {
    let _ = fs::remove_file(trace);
    let path = trace.to_str().context("a path that is not text")?;
    let start = Instant::now();
    match run(executable, name, &[("MUTANT_TRACE", path)], LONGEST)? {
        Ended::Passed => {}
        _ => bail!("the test {name} fails without any mutant"),
    }
    let takes = start.elapsed();
    let reached = fs::read_to_string(trace).unwrap_or_default();
    Ok((
        takes,
        reached.lines().filter_map(|l| l.parse().ok()).collect(),
    ))
}
