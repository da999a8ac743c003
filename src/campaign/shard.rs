//! One shard: a function of the plan and its number.

use super::deal::{Deal, Stride};
use super::hunts::HuntTally;
use super::plan::{Kind, Part, Plan, Program};
use super::proofs::{self, ProofTally};
use crate::audit::{Cases, HuntSettings, Method, Panel, Settings, StoredTally, Tally, hunt_until};
use rayon::ThreadPool;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A program as it called itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Who {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: Option<String>,
}

/// The findings of a shard in a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PartContent {
    /// Judgements of the method's own solver.
    Audit(StoredTally),
    /// Judgements of a program; nobody's where the shard has no cases.
    Candidate(StoredTally, Option<Who>),
    /// Hunts.
    Hunt(HuntTally),
    /// Rectangles of a proof.
    Proof(ProofTally),
}

/// The findings of a shard, part by part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Content {
    /// In the plan's order.
    pub parts: Vec<PartContent>,
}

/// The reason why a shard cannot be done.
#[derive(Debug, thiserror::Error)]
#[error("part {part}: {source}")]
pub struct ShardError {
    /// Its part, counted from one.
    pub part: usize,
    /// The reason.
    pub source: Box<dyn Error + Send + Sync>,
}

/// Judges a program at some of the cases on the panel: gives who it was, nothing if it was stopped,
/// or why not every case has an answer. `progress` is told of cases judged.
pub type Answering<'a> = dyn Fn(
        &Program,
        (Cases, Stride),
        &Panel,
        &(dyn Fn(u64) + Sync),
    ) -> Result<Option<Who>, Box<dyn Error + Send + Sync>>
    + Sync
    + 'a;

/// Does shard `k` on the threads of a pool; nothing once `stop` is set. `progress` is told of cases
/// and evaluations as they are made.
///
/// # Errors
/// A program that does not answer, a proof whose tables the reference is undecided about.
pub fn run(
    (plan, deal, k): (&Plan, &Deal, u64),
    pool: &ThreadPool,
    programs: &Answering,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Result<Option<Content>, ShardError> {
    let mut parts = Vec::new();
    for (i, (part, stride)) in plan.parts.iter().zip(deal.of(k)).enumerate() {
        let bad = |source| ShardError {
            part: i + 1,
            source,
        };
        let method = part.method();
        let variant = part.variant(&*method).map_err(|e| bad(e.into()))?;
        let settings = part.settings();
        let content = match (part.kind, &part.program) {
            (Kind::Candidate, Some(program)) => {
                let panel = Panel::lean(&variant, &settings);
                let cases = (Cases::new(&variant, &settings), stride);
                let judged = || programs(program, cases, &panel, progress);
                let who = match stride.is_empty() {
                    true => None,
                    false => pool.install(judged).map_err(bad)?,
                };
                PartContent::Candidate(panel.into_tally().stored(), who)
            }
            (Kind::Proof, _) => {
                let proved = || proofs::of(part, stride, progress, stop);
                PartContent::Proof(pool.install(proved).map_err(|e| bad(e.into()))?)
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

fn audit(
    method: &dyn Method,
    settings: &Settings,
    stride: Stride,
    pool: &ThreadPool,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Tally {
    let cases = Cases::new(method, settings);
    let panel = Panel::lean(method, settings);
    let case = |j: u64| cases.get(stride.at(j) as usize);
    pool.install(|| panel.audit(stride.len(), &case, progress, stop));
    panel.into_tally()
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
