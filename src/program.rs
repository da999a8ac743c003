//! The program `mechaudit` as a library: reports, papers, machines, proofs and campaigns on top of
//! the crate [`mechaudit`], whose modules stand here under the same names.
//!
//! | module | what it holds | needs |
//! |---|---|---|
//! | `campaign` | audits and hunts cut into shards, and their exact sum | feature `report` |
//! | [`machine`] | machines as their files describe them: certified rows and branches in the user's units | |
//! | [`motion`] | a mechanism in motion, as pages and drawings show it | |
//! | `papers` | published papers: data, tables, formulas, findings | feature `report` |
//! | `proof` (`mechaudit-proof`) | error bounds of solvers proved for every input | feature `report` |
//! | `report` | audits as text and HTML, drawings of linkages; JSON, CSV, JUnit, LaTeX, charts, papers | feature `pages`; `report` |
//! | [`symbolic`] (`mechaudit-symbolic`) | polynomials, roots, exponentials and their derivatives, exactly; proofs of formulas | |
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Parts of the pages are those of papers alone.
#![cfg_attr(not(feature = "report"), allow(dead_code, unused_imports))]

#[cfg(feature = "report")]
pub mod campaign;
pub mod machine;
pub mod motion;
#[cfg(feature = "report")]
pub mod papers;
#[cfg(feature = "pages")]
pub mod report;

#[doc(no_inline)]
pub use mechaudit::{
    Complex64, audit, audit_by_name, book, candidate, compare, files, message, methods, reference,
    resolve, solvers, study,
};
#[cfg(feature = "report")]
#[doc(inline)]
pub use mechaudit_proof as proof;
#[doc(inline)]
pub use mechaudit_symbolic as symbolic;
