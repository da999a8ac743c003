//! Campaigns: audits, hunts and proofs of very many cases, cut into shards for any number of
//! processes and machines, and added up exactly.
//!
//! A [`Plan`] names what is judged and where; its units of work (a case, a hunt, a rectangle of a
//! proof) are numbered, and shard `k` of `N` holds those with number ≡ k (mod N). Every case has a
//! random stream of its own, so a shard is a function of the plan and its number alone; tallies add
//! up without rounding, so the sum of all shards is the same, bit for bit, for every N and in any
//! order.

mod deal;
mod hunts;
mod identity;
mod plan;
mod proofs;
mod record;
mod shard;
mod sum;

pub use deal::{Deal, Stride};
pub use hunts::{HuntTally, WorstOf};
pub use identity::Identity;
pub use plan::{Kind, Part, Plan, PlanError, Program, VariantError};
pub use proofs::{OfFormula, ProofTally};
pub use record::{Found, Header, Record, RecordError};
pub use shard::{Answering, Content, PartContent, ShardError, Who, run};
pub use sum::{PartSum, Sum, SumError};
