//! Zinchenko, *Dynamic study of a sieving mechanism for moulding sand* (2008): a class-III linkage,
//! its reduced inertia and moment, and cubic splines of them.
//!
//! The findings, their figures and the conditions on record stand in `reference/papers/zinchenko`;
//! here is the analysis that measures them: the recipe behind the columns, the centres of mass that
//! belong to them, every entry's deviation, and what the paper's claim about the spline's
//! derivative is worth.

pub mod data;
mod derivative_claim;
mod design;
mod entries;
mod fitted_nodes;
mod hidden_recipe;
mod motion;
mod recipe;
mod recovery;
mod run_up;
mod tables;

pub use motion::motion;

use super::file::{Measured, Quantity};
use super::{Entry, EntryVerdict, Tally, VariantJudgement, figure};
use crate::reference::{Ball, Undecided};
use recipe::NODES;
use rug::Rational;

/// Working precision of the recomputed tables: 25 digits and room for cancellation.
const BITS: u32 = 192;

/// Measures every quantity of the findings.
///
/// # Errors
/// [`Undecided`] if a certified value is undecided at the working precision.
pub(super) fn analysis() -> Result<Measured, Undecided> {
    let mut measured = Measured::default();
    let printed = tables::printed();
    let exact = recipe::exact_nodes(&data::recovered(), NODES, BITS)?;
    let as_printed = recipe::exact_nodes(&data::printed(), NODES, BITS)?;
    let mut with_fitted = exact.clone();
    let fitted = fitted_nodes::fit(&printed, &exact[2], &mut measured);
    with_fitted[2] = fitted.into_iter().map(exact_micro).collect();
    let variants = [
        ("as_printed", as_printed),
        ("recovered", exact),
        (FITTED, with_fitted),
    ]
    .map(|(name, nodes)| (name, recipe::columns(&nodes)));
    let (entries, tallies) = entries::entries(&printed, &variants);
    count(&entries, &tallies, &mut measured);
    (measured.entries, measured.tallies) = (entries, tallies);
    hidden_recipe::measure(&printed, &mut measured);
    recovery::measure(&printed, &mut measured);
    derivative_claim::measure(&printed, &variants[1].1, BITS, &mut measured)?;
    run_up::measure(&mut measured);
    Ok(measured)
}

/// The variant with recovered masses and fitted nodes of M_o.
const FITTED: &str = "recovered_fitted_nodes";

/// A fitted node: a multiple of 1e-6, exactly.
fn exact_micro(x: f64) -> Ball {
    Ball::rational(BITS, &Rational::from(((x * 1e6).round() as i64, 1_000_000)))
}

/// The number of entries that agree under each variant, the worst I_n, and the misprints.
fn count(entries: &[Entry], tallies: &[Tally], measured: &mut Measured) {
    measured.set("total", entries.len() as f64);
    for (k, name) in ["printed", "exact", "fitted"].into_iter().enumerate() {
        let of = &tallies[k * tables::COLUMNS.len()..][..tables::COLUMNS.len()];
        let [half, one] = of
            .iter()
            .fold([0, 0], |[a, b], t| [a + t.within_half, b + t.within_one]);
        measured.set(format!("{name}_half"), half as f64);
        measured.set(format!("{name}_one"), one as f64);
        measured.set(format!("{name}_off"), of[tables::INERTIA].worst);
    }
    let mut off: Vec<(&Entry, &VariantJudgement)> =
        entries.iter().map(|e| (e, &e.variants[FITTED])).collect();
    off.retain(|(_, v)| v.verdict >= EntryVerdict::Misprint);
    measured.set("misprinted", off.len() as f64);
    let figures = off.iter().map(|(e, v)| {
        let note = v.note.as_deref().unwrap_or("no explanation");
        let short: String = v.recomputed.chars().take(10).collect();
        let name = format!("Table {} row {} {}", e.table, e.row, e.column);
        figure(
            name,
            format!("{} printed, {short}… recomputed; {note}", e.printed),
            "1",
        )
    });
    measured.add("misprints", Quantity::Figures(figures.collect()));
    off.retain(|(_, v)| v.note.is_some());
    let places = off
        .iter()
        .map(|(e, _)| format!("{}/{}/{}", e.table, e.row, e.column));
    measured.text("places", places.collect::<Vec<_>>().join(" "));
}

#[cfg(test)]
mod tests;
