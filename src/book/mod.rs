//! A short book about the crate: what its words mean, how it judges, how to use it on code of your
//! own.
//!
//! 1. [What an ulp is here](ulps)
//! 2. [How a reference earns trust](references)
//! 3. [What each reference proves](theorems)
//! 4. [How the judge works](judging)
//! 5. [A new method in one file](adding_a_method)
//! 6. [Auditing your own code](your_own_code)
//! 7. [Your own problem](your_own_problem)
//! 8. [Auditing a paper](audit_a_paper)
//! 9. [Hunting, hard cases and recorded findings](hunting)
//! 10. [Campaigns: very many cases, on one machine or many](campaigns)
//! 11. [The atlas of published algorithms](atlas)
//! 12. [Proofs of error bounds](proofs)
//! 13. [Convergence and twins](convergence)
//! 14. [Reading the reports](reports)
//! 15. [Planar mechanisms](planar_mechanisms)
//! 16. [Commands, exit codes and file formats](formats)
//! 17. [The columns of all tables](columns)
//!
//! The purpose of the crate, its installation and its speed are described in the
//! [README](https://docs.rs/crate/mechaudit/latest/source/README.md).

#[doc = include_str!("adding_a_method.md")]
pub mod adding_a_method {}
#[doc = include_str!("atlas.md")]
pub mod atlas {}
#[cfg(feature = "studies")]
#[doc = include_str!("audit_a_paper.md")]
pub mod audit_a_paper {}
#[doc = include_str!("campaigns.md")]
pub mod campaigns {}
#[doc = include_str!("columns.md")]
pub mod columns {}
#[doc = include_str!("convergence.md")]
pub mod convergence {}
#[doc = include_str!("formats.md")]
pub mod formats {}
#[doc = include_str!("hunting.md")]
pub mod hunting {}
#[doc = include_str!("judging.md")]
pub mod judging {}
#[doc = include_str!("planar_mechanisms.md")]
pub mod planar_mechanisms {}
#[doc = include_str!("proofs.md")]
pub mod proofs {}
#[doc = include_str!("references.md")]
pub mod references {}
#[doc = include_str!("reports.md")]
pub mod reports {}
#[doc = include_str!("theorems.md")]
pub mod theorems {}
#[doc = include_str!("ulps.md")]
pub mod ulps {}
#[doc = include_str!("your_own_code.md")]
pub mod your_own_code {}
#[cfg(feature = "studies")]
#[doc = include_str!("your_own_problem.md")]
pub mod your_own_problem {}
