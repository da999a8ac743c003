//! The program `mechaudit` as a library: reports, papers, machines, proofs and campaigns on top of the crate
//! [`mechaudit`], whose modules stand here under the same names.
//!
//! | module | what it holds | needs |
//! |---|---|---|
//! | `campaign` | audits and hunts cut into shards, and their exact sum | feature `report` |
//! | [`claims`] | claims about published algorithms for W and Voigt (`mechaudit-atlas`), decided | |
//! | [`machine`] | machines as their files describe them: certified rows and branches in the user's units | |
//! | [`motion`] | a mechanism in motion, as pages and drawings show it | |
//! | [`papers`] | published papers: data, tables, formulas, findings | |
//! | [`proof`] (`mechaudit-proof`) | error bounds of solvers proved for every input | |
//! | `report` | reports as text, HTML, JSON, CSV, JUnit, LaTeX and SVG | feature `report` |
//! | [`symbolic`] (`mechaudit-symbolic`) | polynomials, roots, exponentials and their derivatives, exactly; proofs of formulas | |
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(feature = "report")]
pub mod campaign;
pub mod claims;
pub mod machine;
pub mod motion;
pub mod papers;
#[cfg(feature = "report")]
pub mod report;

#[doc(no_inline)]
pub use mechaudit::{
    Complex64, audit, audit_by_name, book, candidate, compare, methods, reference, solvers,
};
#[doc(inline)]
pub use mechaudit_proof as proof;
#[doc(inline)]
pub use mechaudit_symbolic as symbolic;
