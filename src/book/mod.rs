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
//! 8. [Hunting, hard cases and recorded findings](hunting)
//! 9. [Campaigns: very many cases, on one machine or many](campaigns)
//! 10. [The atlas of published algorithms](atlas)
//! 11. [Proofs of error bounds](proofs)
//! 12. [Convergence and twins](convergence)
//! 13. [Reading the reports](reports)
//! 14. [Planar mechanisms](planar_mechanisms)
//! 15. [Commands, exit codes and file formats](formats)
//! 16. [The columns of all tables](columns)
//!
//! The purpose of the crate, its installation and its speed are described in the
//! [README](https://docs.rs/crate/mechaudit/latest/source/README.md).

#[doc = include_str!("adding_a_method.md")]
pub mod adding_a_method {}
#[doc = include_str!("atlas.md")]
pub mod atlas {}
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
