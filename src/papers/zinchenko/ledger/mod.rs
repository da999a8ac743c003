//! The ledger of the paper: (1) to (20), table 1, the velocity and acceleration systems, and the
//! numbers in the text.
//!
//! Symbols: `I_n` the reduced inertia and `dI_n` its derivative by φ, `m_im1`, `m_i`, `m_ip1`
//! second derivatives at neighbouring nodes, `S'` and `S''` derivatives of the spline, `M_kr` and
//! `S_kr` the critical moment and slip (printed with a к). The printed forms are those of the text
//! layer of a scan.

mod dynamics;
mod numbers;
mod rates;
mod spline;
mod sweep;

use crate::papers::ledger::Item;

/// All entries in the order of the paper.
pub fn items() -> Vec<Item> {
    let mut all = dynamics::items();
    all.extend(spline::items());
    all.extend(sweep::items());
    all.extend(numbers::items());
    all.extend(rates::items());
    all
}
