//! The sum of shards.

use super::hunts::HuntTally;
use super::plan::{Kind, Plan};
use super::proofs::ProofTally;
use super::shard::{Content, PartContent, Who};
use crate::audit::{CandidateReport, Method, MethodReport, StoredError, Tally};

/// The findings in a part, by the shards added so far.
enum Gathered {
    Tally(Box<Tally>, Option<Who>),
    Hunts(HuntTally),
    Proof(ProofTally),
}

/// The findings in a part of a campaign.
pub enum PartSum {
    /// Of an audit or a candidate.
    Report(Box<MethodReport>),
    /// Of hunts.
    Hunts(HuntTally, Box<dyn Method>),
    /// Of a proof.
    Proof(ProofTally),
}

impl PartSum {
    /// Returns true if all is as expected.
    pub fn passed(&self) -> bool {
        match self {
            PartSum::Report(report) => report.passed(),
            PartSum::Hunts(hunts, method) => hunts.passed(&**method),
            PartSum::Proof(found) => found.open == 0,
        }
    }
}

/// The reason why a shard cannot be added.
#[derive(Debug, thiserror::Error)]
pub enum SumError {
    /// It holds something else than its plan says.
    #[error("its content is of another kind than its plan's parts")]
    Kind,
    /// Of another method.
    #[error(transparent)]
    Stored(#[from] StoredError),
    /// Two programs answered.
    #[error("{0} answered here, {1} elsewhere")]
    Program(String, String),
}

/// Adds up shards of a plan in any order, in a space that does not depend on how many.
pub struct Sum<'a> {
    plan: &'a Plan,
    methods: &'a [Box<dyn Method>],
    gathered: Vec<Gathered>,
    shards: u64,
}

fn spoken(who: &Who) -> String {
    match &who.version {
        Some(version) => format!("{} {version}", who.name),
        None => who.name.clone(),
    }
}

impl<'a> Sum<'a> {
    /// Nothing added yet; the methods are [`Plan::methods`].
    ///
    /// # Panics
    /// Of a plan that was not checked.
    pub fn new(plan: &'a Plan, methods: &'a [Box<dyn Method>]) -> Sum<'a> {
        let parts = plan.parts.iter().zip(methods);
        let gathered = parts.map(|(part, method)| match part.kind {
            Kind::Hunt => Gathered::Hunts(HuntTally::default()),
            Kind::Proof => Gathered::Proof(ProofTally::default()),
            Kind::Audit | Kind::Candidate => {
                let variant = part.variant(&**method).expect("the plan was checked");
                let tally = Tally::lean(&variant, &part.settings());
                Gathered::Tally(Box::new(tally), None)
            }
        });
        Sum {
            plan,
            gathered: gathered.collect(),
            methods,
            shards: 0,
        }
    }

    /// Adds a shard.
    ///
    /// # Errors
    /// A record that is no shard of the plan; nothing is added then.
    pub fn add(&mut self, content: Content) -> Result<(), SumError> {
        if content.parts.len() != self.plan.parts.len() {
            return Err(SumError::Kind);
        }
        let mut read = Vec::new();
        for (i, found) in content.parts.into_iter().enumerate() {
            read.push(match (found, self.plan.parts[i].kind) {
                (PartContent::Audit(stored), Kind::Audit) => {
                    Gathered::Tally(Box::new(self.restored(i, stored)?), None)
                }
                (PartContent::Candidate(stored, who), Kind::Candidate) => {
                    let tally = self.restored(i, stored)?;
                    if let (Gathered::Tally(_, Some(before)), Some(who)) = (&self.gathered[i], &who)
                        && before != who
                    {
                        return Err(SumError::Program(spoken(who), spoken(before)));
                    }
                    Gathered::Tally(Box::new(tally), who)
                }
                (PartContent::Hunt(hunts), Kind::Hunt) => Gathered::Hunts(hunts),
                (PartContent::Proof(found), Kind::Proof) => Gathered::Proof(found),
                _ => return Err(SumError::Kind),
            });
        }
        self.gather(read, 1);
        Ok(())
    }

    /// Adds another sum of the same plan.
    ///
    /// # Errors
    /// Two programs that answered; nothing is added then.
    pub fn merge(&mut self, other: Sum) -> Result<(), SumError> {
        for (own, more) in self.gathered.iter().zip(&other.gathered) {
            if let (Gathered::Tally(_, Some(a)), Gathered::Tally(_, Some(b))) = (own, more)
                && a != b
            {
                return Err(SumError::Program(spoken(b), spoken(a)));
            }
        }
        self.gather(other.gathered, other.shards);
        Ok(())
    }

    fn gather(&mut self, read: Vec<Gathered>, shards: u64) {
        for (own, more) in self.gathered.iter_mut().zip(read) {
            match (own, more) {
                (Gathered::Tally(tally, who), Gathered::Tally(more, other)) => {
                    tally.merge(*more);
                    *who = who.take().or(other);
                }
                (Gathered::Hunts(hunts), Gathered::Hunts(more)) => hunts.merge(more),
                (Gathered::Proof(found), Gathered::Proof(more)) => found.merge(more),
                _ => unreachable!("parts of one plan"),
            }
        }
        self.shards += shards;
    }

    fn restored(&self, i: usize, stored: crate::audit::StoredTally) -> Result<Tally, StoredError> {
        let part = &self.plan.parts[i];
        let variant = part.variant(&*self.methods[i]).expect("it was made before");
        Tally::restored(&variant, &part.settings(), stored)
    }

    /// Returns the number of shards added.
    pub fn shards(&self) -> u64 {
        self.shards
    }

    /// Returns the findings, part by part; as of a run that was interrupted if it is not
    /// `complete`.
    pub fn finish(self, complete: bool) -> Vec<PartSum> {
        let parts = self.plan.parts.iter().zip(self.methods).zip(self.gathered);
        let finished = parts.map(|((part, method), gathered)| match gathered {
            Gathered::Hunts(hunts) => PartSum::Hunts(hunts, part.method()),
            Gathered::Proof(found) => PartSum::Proof(found),
            Gathered::Tally(mut tally, who) => {
                if !complete {
                    tally.interrupt();
                }
                let variant = part.variant(&**method).expect("it was made before");
                let mut report = tally.finish(&variant);
                report.reproduce.tail = part.tail();
                if let Some(program) = &part.program {
                    let who = who.unwrap_or(Who {
                        name: program.exec.clone(),
                        version: None,
                    });
                    report.candidate = Some(CandidateReport {
                        name: who.name,
                        version: who.version,
                        command: Some(program.exec.clone()),
                        answered: report.cases,
                        trouble: None,
                    });
                }
                PartSum::Report(Box::new(report))
            }
        });
        finished.collect()
    }
}

#[cfg(test)]
mod tests;
