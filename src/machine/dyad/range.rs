//! Crank range and dead positions of a four-bar linkage or slider-crank.

use super::Shape;
use crate::solvers::dyad::{Assembly, CrankRange, FourBar, GrashofType, SliderCrank};

/// The crank angles within one turn, in degrees.
pub enum Turn {
    /// Every angle, with or without positions where the assembly may change.
    Full {
        /// True if there are such positions.
        change_points: bool,
    },
    /// From and to.
    Parts(Vec<[f64; 2]>),
}

/// A dead position of one assembly.
pub struct Dead {
    /// `extended` or `folded`.
    pub how: &'static str,
    /// The crank angle in degrees.
    pub crank_deg: f64,
    /// The rocker's angle in degrees, or the slider's coordinate in metres.
    pub output: f64,
}

/// The crank angles that can be reached.
///
/// ```
/// use mechaudit_cli::machine::{dyad, Linkage, Source};
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/../../examples/four-bar.toml"
/// )));
/// let Linkage::Dyad(linkage) = Linkage::read(&source)? else { unreachable!() };
/// assert!(matches!(dyad::turn(&linkage.shape), dyad::Turn::Full { change_points: false }));
/// # Ok::<(), mechaudit_cli::machine::Refusal>(())
/// ```
pub fn turn(shape: &Shape) -> Turn {
    match shape {
        Shape::FourBar { solver, .. } => four_bar_turn(solver),
        Shape::SliderCrank { solver, .. } => slider_turn(solver),
    }
}

fn four_bar_turn(solver: &FourBar) -> Turn {
    match solver.crank_range() {
        CrankRange::Full => Turn::Full {
            change_points: solver.grashof_type() == GrashofType::ChangePoint,
        },
        CrankRange::Within { limit } => Turn::Parts(vec![[-limit.deg(), limit.deg()]]),
        CrankRange::Beyond { limit } => Turn::Parts(vec![[limit.deg(), 360.0 - limit.deg()]]),
        CrankRange::Between { lower, upper } => Turn::Parts(vec![
            [lower.deg(), upper.deg()],
            [-upper.deg(), -lower.deg()],
        ]),
    }
}

/// The sine of the crank's angle to the guide lies between those of the limits.
fn slider_turn(solver: &SliderCrank) -> Turn {
    let (lower, upper) = solver.crank_limits();
    let parts = match (lower.map(|l| l.deg()), upper.map(|u| u.deg())) {
        (None, None) => {
            return Turn::Full {
                change_points: !solver.turns_fully(),
            };
        }
        (Some(l), None) => vec![[l, 180.0 - l]],
        (None, Some(u)) => vec![[-180.0 - u, u]],
        (Some(l), Some(u)) => vec![[l, u], [180.0 - u, 180.0 - l]],
    };
    let direction = solver.direction().deg();
    Turn::Parts(parts.iter().map(|p| p.map(|x| x + direction)).collect())
}

/// The dead positions of an assembly.
pub fn dead(shape: &Shape, assembly: Assembly) -> Vec<Dead> {
    match shape {
        Shape::FourBar { solver, .. } => {
            let all = solver.dead_positions(assembly);
            [("extended", all.extended), ("folded", all.folded)]
                .into_iter()
                .filter_map(|(how, p)| {
                    p.map(|p| Dead {
                        how,
                        crank_deg: p.crank.deg(),
                        output: p.rocker.deg(),
                    })
                })
                .collect()
        }
        Shape::SliderCrank { solver, .. } => {
            let all = solver.dead_centres(assembly);
            let direction = solver.direction().deg();
            [("extended", Some(all.extended)), ("folded", all.folded)]
                .into_iter()
                .filter_map(|(how, p)| {
                    p.map(|p| Dead {
                        how,
                        crank_deg: p.crank_from_guide.deg() + direction,
                        output: p.slider.m(),
                    })
                })
                .collect()
        }
    }
}

/// The rocker's swing in degrees between its dead positions, where the crank turns fully and the
/// assembly cannot change.
pub fn swing(solver: &FourBar, assembly: Assembly) -> Option<f64> {
    let full = solver.crank_range() == CrankRange::Full
        && solver.grashof_type() != GrashofType::ChangePoint;
    let swing = solver.dead_positions(assembly).swing();
    swing.filter(|_| full).map(|s| s.deg())
}
