//! One shard: a function of the plan and its number.

use super::deal::{Deal, Stride};
use super::hunts::HuntTally;
use super::plan::{Kind, Part, Plan, Program};
use crate::audit::{
    Cases, HuntSettings, Method, Settings, StoredTally, Tally, answer_of, hunt_until,
    judge_case_briefly,
};
use rayon::ThreadPool;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Cases that a thread takes at a time.
const TAKEN: u64 = 64;

/// A program as it called itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Who {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: Option<String>,
}

/// What a shard found in a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PartContent {
    /// Judgements of the method's own solver.
    Audit(StoredTally),
    /// Judgements of a program; nobody's where the shard has no cases.
    Candidate(StoredTally, Option<Who>),
    /// Hunts.
    Hunt(HuntTally),
}

/// What a shard found, part by part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Content {
    /// In the plan's order.
    pub parts: Vec<PartContent>,
}

/// Why a shard cannot be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("part {part}: {why}")]
pub struct ShardError {
    /// Its part, counted from one.
    pub part: usize,
    /// Why not.
    pub why: String,
}

/// Judges a program at some of the cases into the tally: gives who it was, nothing if it was stopped, or
/// why not every case has an answer. `progress` is told of cases judged.
pub type Answering<'a> = dyn Fn(
        &Program,
        &dyn Method,
        (Cases, Stride),
        &Settings,
        &mut Tally,
        &(dyn Fn(u64) + Sync),
    ) -> Result<Option<Who>, String>
    + Sync
    + 'a;

/// Does shard `k` on the threads of a pool; nothing once `stop` is set. `progress` is told of cases and
/// evaluations as they are made.
///
/// # Errors
/// A program that does not answer.
pub fn run(
    (plan, deal, k): (&Plan, &Deal, u64),
    pool: &ThreadPool,
    programs: &Answering,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Result<Option<Content>, ShardError> {
    let mut parts = Vec::new();
    for (i, (part, stride)) in plan.parts.iter().zip(deal.of(k)).enumerate() {
        let bad = |why: String| ShardError { part: i + 1, why };
        let method = part.method();
        let variant = part.variant(&*method).map_err(|e| bad(e.to_string()))?;
        let settings = part.settings();
        let content = match (part.kind, &part.program) {
            (Kind::Candidate, Some(program)) => {
                let mut tally = Tally::lean(&variant, &settings);
                let cases = (Cases::new(&variant, &settings), stride);
                let judged = || programs(program, &variant, cases, &settings, &mut tally, progress);
                let who = match stride.is_empty() {
                    true => None,
                    false => pool.install(judged).map_err(bad)?,
                };
                PartContent::Candidate(tally.stored(), who)
            }
            (Kind::Hunt, _) => {
                let hunts = || hunts(&variant, part, stride, progress, stop);
                PartContent::Hunt(pool.install(hunts))
            }
            _ => {
                let tally = audit(&variant, &settings, stride, pool, progress, stop);
                PartContent::Audit(tally.stored())
            }
        };
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        parts.push(content);
    }
    Ok(Some(Content { parts }))
}

/// Each thread has a tally of its own: how cases fall to threads does not show in the sum.
fn audit(
    method: &dyn Method,
    settings: &Settings,
    stride: Stride,
    pool: &ThreadPool,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Tally {
    let cases = Cases::new(method, settings);
    let laws = method.laws();
    let next = AtomicU64::new(0);
    let one = |tally: &mut Tally, i: u64| {
        let case = cases.get(i as usize);
        let answer = answer_of(method, &case.input);
        let report = judge_case_briefly(method, case, answer, settings);
        let residuals = laws.iter().map(|l| (l.residual)(&report.case.input));
        let residuals: Vec<Option<f64>> = residuals.collect();
        tally.laws(&report.case, &residuals);
        tally.add(&report);
    };
    let tallies = pool.broadcast(|_| {
        let mut tally = Tally::lean(method, settings);
        loop {
            let from = next.fetch_add(TAKEN, Ordering::Relaxed);
            let end = stride.len().min(from.saturating_add(TAKEN));
            if from >= end {
                return tally;
            }
            for j in from..end {
                if stop.load(Ordering::Relaxed) {
                    return tally;
                }
                one(&mut tally, stride.at(j));
            }
            progress(end - from);
        }
    });
    let mut sum = Tally::lean(method, settings);
    tallies.into_iter().for_each(|t| sum.merge(t));
    sum
}

fn hunts(
    method: &dyn Method,
    part: &Part,
    stride: Stride,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> HuntTally {
    let mut sum = HuntTally::default();
    for j in 0..stride.len() {
        let seed = part.seed.wrapping_add(stride.at(j));
        let settings = HuntSettings {
            evaluations: part.evaluations,
            seed,
        };
        let told = AtomicU64::new(0);
        let tell = |made: u64| progress(made - told.swap(made, Ordering::Relaxed));
        sum.add(method, seed, &hunt_until(method, &settings, &tell, stop));
        // A hunt may end before all its evaluations.
        progress(part.evaluations - told.load(Ordering::Relaxed).min(part.evaluations));
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    sum
}
