//! Doing the shards that are missing.

use super::folder::{Claim, Folder, State};
use crate::cli::args::CampaignRunArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::write_to;
use crate::cli::process::answers::{AnswerLines, Form};
use crate::cli::process::candidate::{Candidate, gather};
use crate::cli::process::inputs::Inputs;
use crate::cli::process::interrupt;
use crate::cli::progress::Progress;
use mechaudit::audit::{Cases, Panel};
use mechaudit::campaign::{self, Program, Stride, Who};
use mechaudit::report::words::numbers::count;
use rayon::ThreadPool;
use std::error::Error;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// The interval between two looks at a shard that another run does.
const PATIENCE: Duration = Duration::from_millis(200);

/// Does what is missing of the shards asked for; waits for those that another run does.
pub fn run(args: &CampaignRunArgs) -> Result<Outcome, Failure> {
    let folder = Folder::open(&args.folder)?;
    folder.same_program()?;
    let mut left = asked(&args.shards, folder.deal.shards())?;
    let mut run = Run::new(folder, args.jobs)?;
    while !left.is_empty() && !interrupt::is_requested() {
        let before = left.len();
        let mut others = Vec::new();
        for k in left {
            if interrupt::is_requested() {
                break;
            }
            if !run.shard(k)? {
                others.push(k);
            }
        }
        left = others;
        if left.len() == before && !interrupt::is_requested() {
            thread::sleep(PATIENCE);
        }
    }
    run.end()
}

/// The numbers of the shards asked for, in their order.
fn asked(some: &[(u64, u64)], shards: u64) -> Result<Vec<u64>, Failure> {
    let beyond = some.iter().find(|(_, to)| *to >= shards);
    if let Some((_, to)) = beyond {
        let last = shards - 1;
        return Err(Failure::new(format!(
            "--shard {to}: the shards are numbered 0 to {last}"
        )));
    }
    let mut all: Vec<u64> = match some {
        [] => (0..shards).collect(),
        some => some.iter().flat_map(|(from, to)| *from..=*to).collect(),
    };
    all.sort();
    all.dedup();
    Ok(all)
}

struct Run {
    folder: Folder,
    pool: ThreadPool,
    threads: usize,
    progress: Progress,
    /// Cases and evaluations done by anybody.
    done: AtomicU64,
    total: u64,
    own: u64,
    before: u64,
    /// Shards that cannot be done, and why.
    failed: Vec<(u64, String)>,
}

impl Run {
    fn new(folder: Folder, jobs: Option<usize>) -> Result<Run, Failure> {
        interrupt::flag();
        let mut builder = rayon::ThreadPoolBuilder::new();
        if let Some(n) = jobs {
            builder = builder.num_threads(n);
        }
        let pool = builder.build().map_err(Failure::caused)?;
        let total = folder.deal.work();
        Ok(Run {
            threads: pool.current_num_threads(),
            folder,
            pool,
            progress: Progress::new(),
            done: AtomicU64::new(0),
            total,
            own: 0,
            before: 0,
            failed: Vec::new(),
        })
    }

    fn tell(&self, more: u64) {
        let done = self.done.fetch_add(more, Ordering::Relaxed) + more;
        self.progress
            .reach(&self.folder.plan.name, done, self.total);
    }

    /// Returns true if the shard needs nothing more from this run: it is done, or cannot be. If
    /// not, somebody else does it.
    fn shard(&mut self, k: u64) -> Result<bool, Failure> {
        if self.is_done(k)? {
            self.before += 1;
            self.folder.sweep(k);
            return Ok(true);
        }
        match self.folder.claim(k)? {
            None => Ok(false),
            Some(claim) => self.claimed(k, claim).map(|()| true),
        }
    }

    /// Does a shard that nobody else does now.
    fn claimed(&mut self, k: u64, claim: Claim) -> Result<(), Failure> {
        // It may have been done since.
        if self.is_done(k)? {
            self.before += 1;
            self.folder.leave(claim);
            return Ok(());
        }
        if let State::Bad(why) = self.folder.state(k)? {
            complain(&format!("{}: {why}", self.folder.file(k).display()));
        }
        let started = Instant::now();
        let at = self.done.load(Ordering::Relaxed);
        let (plan, deal) = (&self.folder.plan, &self.folder.deal);
        let tell = |more| self.tell(more);
        let found = campaign::run(
            (plan, deal, k),
            &self.pool,
            &answers,
            &tell,
            interrupt::flag(),
        );
        match found {
            Ok(Some(content)) => {
                let took = (started.elapsed().as_secs_f64(), self.threads);
                self.folder.write(claim, k, &content, took)?;
                self.own += 1;
            }
            // Stopped: what is half done is dropped.
            Ok(None) => self.folder.leave(claim),
            Err(e) => {
                self.folder.leave(claim);
                self.done.store(at, Ordering::Relaxed);
                self.failed.push((k, e.to_string()));
            }
        }
        Ok(())
    }

    fn is_done(&self, k: u64) -> Result<bool, Failure> {
        match self.folder.state(k)? {
            State::Done(_) => {
                self.done
                    .fetch_add(self.folder.deal.work_of(k), Ordering::Relaxed);
                Ok(true)
            }
            State::Missing | State::Bad(_) => Ok(false),
            State::Refused(why) => {
                let file = self.folder.file(k);
                Err(Failure::new(format!("{}: {why}", file.display())))
            }
        }
    }

    fn end(self) -> Result<Outcome, Failure> {
        self.progress.clear();
        let stopped = interrupt::is_requested();
        let text = done(stopped, self.own, self.before);
        write_to(|out| Ok(writeln!(out, "{text}")?))?;
        outcome(stopped, &self.failed)
    }
}

fn done(stopped: bool, own: u64, before: u64) -> String {
    let mark = if stopped { "Interrupted: " } else { "" };
    let own = count(own as usize, "shard");
    format!("{mark}{own} done, {before} done before.")
}

/// Returns the outcome of a run that was stopped or left shards undone.
fn outcome(stopped: bool, failed: &[(u64, String)]) -> Result<Outcome, Failure> {
    match failed.first() {
        _ if stopped => Ok(Outcome::Interrupted),
        None => Ok(Outcome::AsExpected),
        Some((k, why)) => {
            let n = count(failed.len(), "shard");
            Err(Failure::new(format!(
                "{n} cannot be done, the first: {k}, {why}"
            )))
        }
    }
}

/// The time that a program has for a shard: plans deal shards of minutes, and one that takes a day
/// has been dealt wrongly.
const SHARD: Duration = Duration::from_secs(24 * 3600);

/// Lets a program answer the cases of a shard.
fn answers(
    program: &Program,
    (cases, stride): (Cases, Stride),
    panel: &Panel,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Option<Who>, Box<dyn Error + Send + Sync>> {
    let candidate = Candidate {
        command: program.exec.clone(),
        folder: None,
        timeout: Duration::try_from_secs_f64(program.timeout)?,
        run_timeout: SHARD,
        form: match program.binary {
            true => Form::Frames,
            false => Form::Lines,
        },
        decimal: program.decimal,
        lines: AnswerLines::default(),
    };
    let inputs = Inputs::dealt(cases, stride);
    let found = gather(panel, inputs, &candidate, progress);
    let Some(report) = found? else {
        return Ok(None);
    };
    match report.trouble {
        Some(why) => Err(why.into()),
        None => Ok(Some(Who {
            name: report.name,
            version: report.version,
        })),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::campaign::Plan;
    use mechaudit::machine::Source;

    /// Another run may end a shard between a look at it and the claim.
    #[test]
    fn a_shard_that_is_done_meanwhile_is_not_done_again() {
        let text = "name = \"x\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 2";
        let plan = Plan::read(&Source::toml(text)).unwrap();
        let place = tempfile::tempdir().unwrap();
        let Ok(folder) = Folder::make(&place.path().join("x"), plan, 2) else {
            panic!("a new folder");
        };
        let Ok(mut run) = Run::new(folder, Some(1)) else {
            panic!("a thread");
        };
        let mut claimed = |k: u64| {
            let claim = run.folder.claim(k).unwrap().expect("nobody else has it");
            run.claimed(k, claim).unwrap();
            (run.own, run.before)
        };
        assert_eq!(claimed(1), (1, 0));
        assert_eq!(claimed(1), (1, 1));
        assert_eq!(claimed(0), (2, 1));
        // A finished shard is finished, whoever has a claim on it.
        let claim = run.folder.claim(1).unwrap();
        assert!(claim.is_some() && run.shard(1).unwrap());
        assert_eq!((run.own, run.before), (2, 2));
        drop(claim);
        assert!(run.shard(1).unwrap());
        let names = std::fs::read_dir(place.path().join("x/shards")).unwrap();
        assert_eq!(names.count(), 2, "nothing is set aside");
    }

    #[test]
    fn shards_asked_for_are_done_once_in_their_order() {
        let of = |some: &[(u64, u64)]| asked(some, 6).map_err(|e| e.to_string());
        assert_eq!(of(&[]).unwrap(), [0, 1, 2, 3, 4, 5]);
        assert_eq!(of(&[(4, 5), (1, 1), (3, 4)]).unwrap(), [1, 3, 4, 5]);
        assert_eq!(of(&[(0, 5)]).unwrap().len(), 6);
        let why = "--shard 6: the shards are numbered 0 to 5";
        assert_eq!(of(&[(1, 1), (2, 6)]), Err(why.into()));
    }

    #[test]
    fn a_run_says_what_it_came_to() {
        assert_eq!(done(false, 1, 0), "1 shard done, 0 done before.");
        assert_eq!(
            done(true, 2, 3),
            "Interrupted: 2 shards done, 3 done before."
        );
        let failed = |n: u64| {
            (4..4 + n)
                .map(|k| (k, format!("why {k}")))
                .collect::<Vec<_>>()
        };
        let of = |stopped, n| outcome(stopped, &failed(n)).map_err(|e| e.to_string());
        assert_eq!(of(false, 0), Ok(Outcome::AsExpected));
        assert_eq!(of(true, 2), Ok(Outcome::Interrupted));
        let why = "1 shard cannot be done, the first: 4, why 4";
        assert_eq!(of(false, 1), Err(why.into()));
        let why = "2 shards cannot be done, the first: 4, why 4";
        assert_eq!(of(false, 2), Err(why.into()));
    }

    fn run_of(plan: &str, shards: u64) -> (tempfile::TempDir, Run) {
        let plan = Plan::read(&Source::toml(plan)).unwrap();
        let place = tempfile::tempdir().unwrap();
        let Ok(folder) = Folder::make(&place.path().join("x"), plan, shards) else {
            panic!("a new folder");
        };
        let Ok(run) = Run::new(folder, Some(1)) else {
            panic!("a thread");
        };
        (place, run)
    }

    const PROGRAM: &str = "name = \"x\"\n[[part]]\nkind = \"candidate\"\nmethods = [\"erf\"]\nregions = [\"small\"]\n\
                           cases = 6\nexec = ";

    /// Cases are counted as they are done; those of a shard that failed are taken back.
    #[cfg(unix)]
    #[test]
    fn what_is_done_is_what_is_written() {
        let right = format!("{PROGRAM}\"sh -c 'while read x; do echo refuse; done'\"");
        let (_place, mut run) = run_of(&right, 2);
        let total = run.total;
        assert_eq!((total, run.threads), (6, 1));
        assert!(run.shard(0).unwrap());
        let at = |run: &Run| run.done.load(Ordering::Relaxed);
        assert_eq!((at(&run), run.own, run.before), (3, 1, 0));
        assert!(run.shard(0).unwrap() && run.shard(1).unwrap());
        assert_eq!((run.own, run.before), (2, 1));
        let wrong = format!("{PROGRAM}\"sh -c 'read x; echo refuse'\"");
        let (_place, mut run) = run_of(&wrong, 2);
        assert!(run.shard(1).unwrap() && run.shard(0).unwrap());
        assert_eq!((at(&run), run.own, run.failed.len()), (0, 0, 2));
        let due = "part 1: The program answered 1 times, then it ended its output, with exit status 0; \
                   2 of 3 inputs are unanswered.";
        assert_eq!(run.failed[0], (1, due.to_string()));
        assert!(!run.folder.file(1).exists());
        let names = std::fs::read_dir(run.folder.file(1).parent().unwrap()).unwrap();
        assert_eq!(names.count(), 0, "no claim is left");
    }

    /// A shard that somebody else has is left to them; one of another version to nobody.
    #[test]
    fn shards_of_others_are_left_alone() {
        let text = "name = \"x\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 2";
        let (_place, mut run) = run_of(text, 2);
        let lock = run.folder.file(1).with_extension("lock");
        let file = std::fs::File::create(&lock).unwrap();
        file.lock().unwrap();
        assert!(!run.shard(1).unwrap() && run.shard(0).unwrap());
        // A child that another test has just forked may still hold the file open.
        file.unlock().unwrap();
        assert!(run.shard(1).unwrap());
        let path = run.folder.file(0);
        let whole = std::fs::read_to_string(&path).unwrap();
        let other = whole.replacen("\"campaign_shard\":1", "\"campaign_shard\":2", 1);
        std::fs::write(&path, other).unwrap();
        let why = run.shard(0).unwrap_err().to_string();
        let due = format!("{}: its form has version 2, not 1", path.display());
        assert_eq!(why, due);
    }
}
