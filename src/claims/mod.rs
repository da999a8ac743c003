//! Describes what is claimed about published algorithms for W(z) and the Voigt function, beside
//! what is certified.
//!
//! `mechaudit-atlas` has the algorithms; here they are surveyed by the audit's judge ([`survey`]),
//! and what their papers and users say of them is decided ([`decide`]): a claim is data, with the
//! statement as printed, its domain, its measure and its source.
//!
//! ```
//! use mechaudit_cli::claims::{Effort, Verdict, claims, decide};
//!
//! let claim = claims().into_iter().find(|c| c.algorithm == "humlicek-1982").unwrap();
//! let decided = decide(&claim, &Effort { cases: 10, seed: 1 });
//! assert_ne!(decided.verdict, Verdict::NotTestable);
//! ```

mod advice;
mod breaks;
mod claim;
mod code;
mod data;
mod decide;
mod effort;
mod findings;
mod heights;
mod lines;
mod maps;
mod mean;
mod regions;
mod seams;
mod speed;
mod survey;
mod whole;

pub use advice::{Advice, advice};
pub use claim::{Claim, Measure, Place, Statistic, Verdict};
pub use code::{Code, algorithms};
pub use data::claims;
pub use decide::{Decided, decide};
pub use effort::Effort;
pub use findings::{Finding, findings};
pub use heights::{Height, TARGETS};
pub use lines::{HartmannTran, answer};
pub use maps::{LEVELS, Map, level, map};
pub use mean::{Mean, mean};
pub use seams::Jump;
pub use speed::{nanoseconds, nanoseconds_of_lines};
pub use survey::{Figures, Part, Row, survey, survey_lines};
pub use whole::{Atlas, Missing, atlas};

pub use mechaudit_atlas::{
    Algorithm, NOT_AT_HAND, NotAtHand, PROFILES, Parts, Plane, Profile, all, find,
};

use crate::audit::{Case, Format, Limit, Method, Origin, Variant};

/// The relative limit that measured errors are judged by: an answer is off by exactly that much by
/// no accident that happens, as zero for a value is by 1.
const WHOLE: f64 = 3.0;

/// The method with errors measured, as the code answers, or all of one kind whose first it is.
fn measured<'a>(method: &'a dyn Method, code: Option<&Code>) -> Variant<'a> {
    let mut variant = Variant::new(method).limit(Limit::Relative(WHOLE));
    if code.is_some_and(|c| c.parts == Parts::Real) {
        variant = variant.outputs(&["Re W"]).expect("an output of W");
    }
    if code.is_some_and(|c| c.single) {
        variant = variant.format(Format::Single);
    }
    variant
}

/// A case of a method at a point.
fn at(method: &'static str, input: &[f64]) -> Case {
    Case {
        method,
        region: "given",
        input: input.to_vec(),
        origin: Origin::Given,
    }
}

/// Three significant digits: what does not depend on the last bit of a figure.
fn rounded(x: f64) -> f64 {
    match x.is_finite() {
        true => format!("{x:.2e}").parse().unwrap_or(x),
        false => x,
    }
}
