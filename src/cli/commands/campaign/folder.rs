//! The folder of a campaign: the plan, and a file for each shard that is done.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::output::Output;
use mechaudit::campaign::{Content, Deal, Found, Header, Identity, Plan, Record};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Grows when the plan's file changes its meaning.
const SCHEMA: u32 = 1;
/// Judgements of a campaign at most: years of a thousand cores.
const MOST_WORK: u64 = 1_000_000_000_000_000;
const PLAN: &str = "plan.json";
const SHARDS: &str = "shards";

/// The file of the plan.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanFile {
    campaign: u32,
    shards: u64,
    digest: String,
    identity: Identity,
    plan: Plan,
}

/// A campaign's folder, its plan read and checked.
pub struct Folder {
    path: PathBuf,
    pub plan: Plan,
    pub deal: Deal,
    pub identity: Identity,
    digest: String,
}

/// The state of the file of a shard.
pub enum State {
    Done(Box<Header>),
    Missing,
    /// To be done again: what is wrong with it.
    Bad(String),
    /// Neither to be used nor to be overwritten.
    Refused(String),
}

/// A shard that nobody else does until this goes.
pub struct Claim {
    path: PathBuf,
    // Held until it is dropped.
    _lock: Option<File>,
}

impl Claim {
    /// Nobody needs it any more: the shard is done.
    fn release(self) {
        // Whoever has opened it before finds the shard done.
        let _ = fs::remove_file(&self.path);
    }
}

/// Writes a file of the folder that appears whole.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    Output::open(Some(path))?.text(bytes)?;
    // The name as well survives a loss of power, where the system can say so.
    if let Ok(folder) = File::open(path.parent().unwrap_or(Path::new("."))) {
        let _ = folder.sync_all();
    }
    Ok(())
}

impl Folder {
    /// Makes the folder of a plan. One that is there already has to be the same campaign's.
    pub fn make(path: &Path, plan: Plan, shards: u64) -> Result<Folder, Failure> {
        let deal = Deal::new(&plan, shards);
        if deal.work() > MOST_WORK {
            let work = deal.work() as f64;
            return Err(Failure::new(format!(
                "{}: {work:.2e} judgements are more than the {MOST:e} of a campaign: take fewer cases, hunts or evaluations",
                plan.name,
                MOST = MOST_WORK as f64
            )));
        }
        if deal.units() < shards {
            let units = deal.units();
            return Err(Failure::new(format!(
                "--shards: {shards} are more than the {units} cases and hunts of the plan"
            )));
        }
        let digest = plan.digest();
        let made = |path: &Path| {
            fs::create_dir_all(path).map_err(|e| Failure::cannot("make the folder", path, e))
        };
        made(path)?;
        let file = path.join(PLAN);
        if file.exists() {
            let there = Folder::open(path)?;
            if there.digest == digest && there.deal.shards() == shards {
                return Ok(there);
            }
            let (name, shards) = (&there.plan.name, there.deal.shards());
            return Err(Failure::new(format!(
                "{}: there is another campaign, {name:?} in {shards} shards",
                path.display()
            )));
        }
        let other = |e: io::Error| Failure::cannot("read", path, e);
        if fs::read_dir(path).map_err(other)?.next().is_some() {
            let path = path.display();
            return Err(Failure::new(format!("{path}: the folder is not empty")));
        }
        made(&path.join(SHARDS))?;
        let plan_file = PlanFile {
            campaign: SCHEMA,
            shards,
            identity: Identity::of(&plan),
            digest,
            plan,
        };
        let mut text = serde_json::to_vec_pretty(&plan_file)?;
        text.push(b'\n');
        write(&file, &text)?;
        Ok(Folder {
            path: path.into(),
            deal,
            plan: plan_file.plan,
            identity: plan_file.identity,
            digest: plan_file.digest,
        })
    }

    /// Opens a folder that was made before.
    pub fn open(path: &Path) -> Result<Folder, Failure> {
        let file = path.join(PLAN);
        let bytes = fs::read(&file).map_err(|e| match e.kind() {
            io::ErrorKind::NotFound => Failure::new(format!(
                "{}: no campaign's folder, it has no {PLAN}",
                path.display()
            )),
            _ => Failure::cannot("read", &file, e),
        })?;
        #[derive(Deserialize)]
        struct Schema {
            campaign: u32,
        }
        let bad = |e: serde_json::Error| Failure::in_file(&file, e);
        let schema: Schema = serde_json::from_slice(&bytes).map_err(bad)?;
        if schema.campaign != SCHEMA {
            let (file, other) = (file.display(), schema.campaign);
            return Err(Failure::new(format!(
                "{file}: its form has version {other}, not {SCHEMA}"
            )));
        }
        let read: PlanFile = serde_json::from_slice(&bytes).map_err(bad)?;
        let checked = read.plan.check();
        checked.map_err(|e| Failure::in_file(&file, e))?;
        if read.plan.digest() != read.digest || read.shards == 0 {
            let file = file.display();
            return Err(Failure::new(format!(
                "{file}: the plan is not what its digest says"
            )));
        }
        Ok(Folder {
            path: path.into(),
            deal: Deal::new(&read.plan, read.shards),
            plan: read.plan,
            identity: read.identity,
            digest: read.digest,
        })
    }

    /// Refuses a program that does not compute as the one that made the plan.
    pub fn same_program(&self) -> Result<(), Failure> {
        match Identity::of(&self.plan).differs(&self.identity) {
            None => Ok(()),
            Some(how) => Err(Failure::new(format!(
                "{}: the plan is of another program: {how}",
                self.path.join(PLAN).display()
            ))),
        }
    }

    fn record(&self, shard: u64) -> Record<'_> {
        Record {
            plan: &self.digest,
            shard,
            shards: self.deal.shards(),
            identity: &self.identity,
        }
    }

    /// The file of a shard.
    pub fn file(&self, shard: u64) -> PathBuf {
        self.path.join(SHARDS).join(format!("{shard:06}.json"))
    }

    /// The bytes of a shard's file, if there is one.
    pub fn bytes(&self, shard: u64) -> Result<Option<Vec<u8>>, Failure> {
        let file = self.file(shard);
        match fs::read(&file) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(Failure::cannot("read", &file, e)),
        }
    }

    /// The state of the file of a shard.
    pub fn state(&self, shard: u64) -> Result<State, Failure> {
        let Some(bytes) = self.bytes(shard)? else {
            return Ok(State::Missing);
        };
        Ok(match self.record(shard).read(&bytes) {
            Found::Whole(header, _) => State::Done(header),
            Found::Damaged(why) => State::Bad(format!("damaged, {why}")),
            Found::Foreign(why) => State::Bad(format!("foreign, {why}")),
            Found::OtherVersion(why) => State::Refused(why),
        })
    }

    /// Returns the states of all shards.
    pub fn states(&self) -> Result<Vec<State>, Failure> {
        let all = (0..self.deal.shards()).into_par_iter();
        all.map(|k| self.state(k)).collect()
    }

    /// Returns the findings of a shard, if it is done.
    pub fn content(&self, shard: u64) -> Result<Option<Content>, Failure> {
        let file = self.file(shard);
        let Some(bytes) = self.bytes(shard)? else {
            return Ok(None);
        };
        match self.record(shard).read(&bytes) {
            Found::Whole(_, body) => {
                let content = Content::read(body).map_err(|e| Failure::in_file(&file, e))?;
                Ok(Some(content))
            }
            Found::Damaged(_) | Found::Foreign(_) => Ok(None),
            Found::OtherVersion(why) => Err(Failure::in_file(&file, why)),
        }
    }

    /// Makes sure that nobody else does a shard; nothing if somebody does. Where a file system has
    /// no locks two may do it: they write the same.
    pub fn claim(&self, shard: u64) -> Result<Option<Claim>, Failure> {
        let path = self.lock(shard);
        let mut options = OpenOptions::new();
        let file = options.write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(|e| Failure::cannot("write", &path, e))?;
        match file.try_lock() {
            Ok(()) => Ok(Some(Claim {
                path,
                _lock: Some(file),
            })),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(_)) => Ok(Some(Claim { path, _lock: None })),
        }
    }

    fn lock(&self, shard: u64) -> PathBuf {
        self.path.join(SHARDS).join(format!("{shard:06}.lock"))
    }

    /// Takes away what a program that was killed between its last write and its end has left of the
    /// claim of a shard that is done.
    pub fn sweep(&self, shard: u64) {
        if self.lock(shard).exists()
            && let Ok(Some(claim)) = self.claim(shard)
        {
            claim.release();
        }
    }

    /// A shard that is done, or is left to another run, is no longer claimed. Should two runs do it
    /// now, they write the same.
    pub fn leave(&self, claim: Claim) {
        claim.release();
    }

    /// Writes a shard that is claimed. A file in its place that is none of it is set aside.
    pub fn write(
        &self,
        claim: Claim,
        shard: u64,
        content: &Content,
        (seconds, threads): (f64, usize),
    ) -> Result<(), Failure> {
        let bytes = self.record(shard).write(content, seconds, threads);
        let file = self.file(shard);
        if file.exists() {
            let aside = file.with_extension("json.aside");
            fs::rename(&file, &aside).map_err(|e| Failure::cannot("set aside", &file, e))?;
            let (file, aside) = (file.display(), aside.display());
            complain(&format!("{file}: done again, set aside as {aside}"));
        }
        write(&file, &bytes)?;
        claim.release();
        Ok(())
    }
}

#[cfg(test)]
mod tests;
