//! The tests: which there are, what each reaches, and which of them fails for a mutant.

use crate::render::Mutant;
use crate::tree::Executable;
use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use wait_timeout::ChildExt;

/// One test of one executable.
pub struct Test {
    pub executable: Executable,
    pub name: String,
    pub takes: Duration,
    /// How it fared with the mutants of each file.
    tries: Mutex<HashMap<usize, Tries>>,
}

/// The number of mutants that a test was shown and of those it caught.
#[derive(Clone, Copy, Default)]
struct Tries {
    shown: f64,
    caught: f64,
}

impl Test {
    /// The seconds that it is expected to cost for each catch among mutants of a file; what it did
    /// there counts most.
    fn price(&self, file: usize) -> f64 {
        let tries = self.tries.lock().expect("no job panics");
        let (mut shown, mut caught) = (2.0, 1.0);
        for (at, t) in &*tries {
            let weight = if *at == file { 4.0 } else { 1.0 };
            shown += weight * t.shown;
            caught += weight * t.caught;
        }
        (self.takes.as_secs_f64() + 0.01) * shown / caught
    }

    fn tried(&self, file: usize, caught: bool) {
        let mut tries = self.tries.lock().expect("no job panics");
        let t = tries.entry(file).or_default();
        t.shown += 1.0;
        t.caught += f64::from(caught);
    }
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
    let mut command = Command::new(&executable.path);
    // Processes that the test starts end with it.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let mut child = command
        .current_dir(&executable.folder)
        .args(["--exact", name, "--test-threads", "1", "--include-ignored"])
        .env("PROPTEST_CASES", "32")
        // A case that a mutant fails on is not kept for those after it.
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true")
        .env("INSTA_UPDATE", "no")
        .envs(environment.iter().copied())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .with_context(|| executable.path.display().to_string())?;
    let ended = match child.wait_timeout(limit)? {
        Some(status) if status.success() => Ended::Passed,
        Some(_) => Ended::Failed,
        None => Ended::TimedOut,
    };
    end_group(&child);
    if ended == Ended::TimedOut {
        child.kill()?;
        child.wait()?;
    }
    Ok(ended)
}

/// Ends what a test has started and left behind; there may be nothing.
fn end_group(child: &Child) {
    #[cfg(unix)]
    {
        use rustix::process::{Pid, Signal, kill_process_group};
        let _ = kill_process_group(Pid::from_child(child), Signal::KILL);
    }
    #[cfg(not(unix))]
    let _ = child;
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
    /// Runs every test once without a mutant. Those that fail are left out, and named.
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
                            Ok(Some(t)) => found.lock().unwrap().push((i, t)),
                            Ok(None) => {
                                eprintln!("{name} fails without any mutant and is left out");
                            }
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
                tries: Mutex::default(),
            });
        }
        Ok(suite)
    }

    /// Runs the tests that reach a mutant, the likeliest and quickest first, until one fails or the
    /// time is spent.
    pub fn judge(&self, mutant: &Mutant, most: Option<Duration>) -> Result<Verdict> {
        let Some(reaching) = self.reaching.get(&mutant.number) else {
            return Ok(Verdict::Unreached);
        };
        let price = |i: usize| (i, self.tests[i].price(mutant.file));
        let mut order: Vec<(usize, f64)> = reaching.iter().copied().map(price).collect();
        order.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let number = mutant.number.to_string();
        let start = Instant::now();
        for (i, _) in order {
            if most.is_some_and(|most| start.elapsed() > most) {
                break;
            }
            let t = &self.tests[i];
            let named = [("MUTANT", number.as_str())];
            let ended = run(&t.executable, &t.name, &named, limit(t.takes))?;
            t.tried(mutant.file, ended != Ended::Passed);
            match ended {
                Ended::Passed => {}
                Ended::Failed => return Ok(Verdict::Caught(t.name.clone())),
                Ended::TimedOut => return Ok(Verdict::TimedOut(t.name.clone())),
            }
        }
        Ok(Verdict::Missed)
    }
}

/// The time that a test takes, and the mutants it reaches; nothing of one that fails.
fn traced(
    executable: &Executable,
    name: &str,
    trace: &Path,
) -> Result<Option<(Duration, HashSet<u32>)>> {
    let _ = fs::remove_file(trace);
    let path = trace.to_str().context("a path that is not text")?;
    let start = Instant::now();
    if run(executable, name, &[("MUTANT_TRACE", path)], LONGEST)? != Ended::Passed {
        return Ok(None);
    }
    let takes = start.elapsed();
    let reached = fs::read_to_string(trace).unwrap_or_default();
    let reached = reached.lines().filter_map(|l| l.parse().ok());
    Ok(Some((takes, reached.collect())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn test(takes: u64) -> Test {
        Test {
            executable: executable("/bin/true".into()),
            name: String::new(),
            takes: Duration::from_millis(takes),
            tries: Mutex::default(),
        }
    }

    fn executable(path: std::path::PathBuf) -> Executable {
        Executable {
            package: String::new(),
            path,
            folder: "/".into(),
        }
    }

    #[test]
    fn a_slow_test_that_catches_in_a_file_comes_before_a_quick_one_that_does_not() {
        let (quick, slow) = (test(50), test(200));
        assert!(quick.price(7) < slow.price(7));
        for _ in 0..3 {
            quick.tried(7, false);
            slow.tried(7, true);
        }
        assert!(slow.price(7) < quick.price(7));
        // Elsewhere it counts less.
        assert!(slow.price(8) > slow.price(7));
    }

    /// Checks that processes of a test end with it, by itself or by the time limit.
    #[cfg(unix)]
    #[test]
    fn nothing_is_left_behind() {
        use std::os::unix::fs::PermissionsExt;
        for (last, ended) in [("exit 1", Ended::Failed), ("sleep 60", Ended::TimedOut)] {
            let name = format!("mutants-{}-{ended:?}", std::process::id());
            let folder = std::env::temp_dir().join(name);
            fs::create_dir_all(&folder).unwrap();
            let (script, started) = (folder.join("script"), folder.join("started"));
            let text = format!(
                "#!/bin/sh\nsleep 60 &\necho $! > {}\n{last}\n",
                started.display()
            );
            fs::write(&script, text).unwrap();
            fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).unwrap();
            let limit = Duration::from_secs(2);
            assert_eq!(run(&executable(script), "", &[], limit).unwrap(), ended);
            let number = fs::read_to_string(&started)
                .unwrap()
                .trim()
                .parse()
                .unwrap();
            let process = rustix::process::Pid::from_raw(number).unwrap();
            // Ended, and waited for by whatever takes its parent's place.
            let gone = || {
                let stat = fs::read_to_string(format!("/proc/{number}/stat"));
                let zombie = stat.is_ok_and(|s| s.contains(") Z "));
                zombie || rustix::process::test_kill_process(process).is_err()
            };
            let waited = Instant::now();
            while !gone() {
                assert!(waited.elapsed() < Duration::from_secs(10), "{last}");
                std::thread::sleep(Duration::from_millis(10));
            }
            fs::remove_dir_all(&folder).unwrap();
        }
    }
}
