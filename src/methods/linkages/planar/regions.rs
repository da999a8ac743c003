//! Where planar linkages are audited.

use super::drawn::{Group, Linkage, Places};
use crate::audit::{Draw, Region};
use crate::methods::common::region;

const NEAR_FOLD: &str = "dyads stretched and the three links of a triad through one point but for 2e-5 to 0.1 of them \
    (1e-3 where two dyads are), no two positions so near that f64 cannot tell them apart";

/// Up to three dyads.
fn dyads(d: &mut Draw) -> Linkage {
    let groups = vec![Group::Dyad; d.integer(1, 3)];
    Linkage::drawn(d, &groups, Places::Ordinary)
}

/// A group, sometimes with a dyad before or after it.
fn with_dyad(d: &mut Draw, group: Group, places: Places) -> Linkage {
    let groups = match d.integer(0, 3) {
        0 => vec![Group::Dyad, group],
        1 => vec![group, Group::Dyad],
        _ => vec![group],
    };
    Linkage::drawn(d, &groups, places)
}

fn any_groups(d: &mut Draw) -> Vec<Group> {
    match d.integer(0, 6) {
        0 => vec![Group::Dyad],
        1 => vec![Group::Dyad; 2],
        2 => vec![Group::Dyad; 3],
        3 => vec![Group::Triad, Group::Dyad],
        4 => vec![Group::Dyad, Group::Triad],
        5 => vec![Group::Dyad, Group::FourCornered],
        _ => vec![Group::SixBodies],
    }
}

fn any(d: &mut Draw) -> Linkage {
    let groups = any_groups(d);
    Linkage::drawn(d, &groups, Places::Ordinary)
}

fn near_fold(d: &mut Draw) -> Linkage {
    let groups = match d.chance(0.5) {
        true => vec![Group::Dyad; d.integer(1, 2)],
        false => vec![Group::Triad],
    };
    // The second of two dyads bears the errors of the first.
    let least = if groups.len() == 2 { 1e-3 } else { 2e-5 };
    let off = d.log_uniform(least, 0.1);
    Linkage::drawn(d, &groups, Places::NearFold(off))
}

fn crowded(d: &mut Draw) -> Linkage {
    let size = d.log_uniform(1e-4, 1.0);
    let groups = match d.integer(0, 2) {
        0 => vec![Group::Dyad; 2],
        1 => vec![Group::Triad],
        _ => vec![Group::FourCornered],
    };
    Linkage::drawn(d, &groups, Places::Crowded(size))
}

fn scaled(d: &mut Draw) -> Linkage {
    let factor = d.log_uniform(1e-6, 1e4);
    any(d).scaled(factor)
}

pub(super) fn of_linkages() -> Vec<Region> {
    vec![
        region(
            "class-ii",
            "one to three dyads on a crank, on one another or on the ground",
            |d| dyads(d).input().to_vec(),
        ),
        region(
            "class-iii",
            "a ternary body on three links, a dyad before or after it or none",
            |d| {
                with_dyad(d, Group::Triad, Places::Ordinary)
                    .input()
                    .to_vec()
            },
        ),
        region(
            "class-iv",
            "two ternary bodies with two links between them, a dyad before or after it or none",
            |d| {
                with_dyad(d, Group::FourCornered, Places::Ordinary)
                    .input()
                    .to_vec()
            },
        ),
        region(
            "six-bodies",
            "two ternary bodies on one pin, two links at each: an eight-bar of one group",
            |d| {
                Linkage::drawn(d, &[Group::SixBodies], Places::Ordinary)
                    .input()
                    .to_vec()
            },
        ),
        region("near-fold", NEAR_FOLD, |d| near_fold(d).input().to_vec()),
        region(
            "different-lengths",
            "the inner pins of groups crowded within 1e-4 to 1 of the other links",
            |d| crowded(d).input().to_vec(),
        ),
        region(
            "scaled",
            "up to eight bodies with the ground, from micrometres to ten kilometres",
            |d| scaled(d).input().to_vec(),
        ),
        region(
            "apart",
            "a link too long for its dyad: must be refused",
            |d| Linkage::apart(d).input().to_vec(),
        ),
    ]
}

pub(super) fn of_forces() -> Vec<Region> {
    vec![
        region(
            "ordinary",
            "up to eight bodies with the ground, masses 0.1 to 10 kg, speeds to 20 rad/s",
            |d| any(d).in_motion(d),
        ),
        region("near-fold", NEAR_FOLD, |d| near_fold(d).in_motion(d)),
        region(
            "different-lengths",
            "the inner pins of groups crowded within 1e-4 to 1 of the other links",
            |d| crowded(d).in_motion(d),
        ),
        region("scaled", "from micrometres to ten kilometres", |d| {
            scaled(d).in_motion(d)
        }),
        region(
            "apart",
            "a link too long for its dyad: must be refused",
            |d| Linkage::apart(d).in_motion(d),
        ),
    ]
}
