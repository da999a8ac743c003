//! Derivatives of pins that hang on nothing but pins: their arms are the same at every position.

use super::chain::{Arm, Chain, Closure, Entry, Spot};

/// The arms of each pin without slides on the way to it.
pub(super) fn constant(chain: &Chain) -> Vec<Option<Vec<Arm>>> {
    let of = |closure: &Closure| match *closure {
        Closure::Pin { a, b } => {
            let mut all = Vec::new();
            walk(chain, a, 1.0, &mut all)?;
            walk(chain, b, -1.0, &mut all)?;
            Some(all)
        }
        _ => None,
    };
    chain.closures.iter().map(of).collect()
}

fn walk(chain: &Chain, mut spot: Spot, sign: f64, all: &mut Vec<Arm>) -> Option<()> {
    loop {
        let body = spot.body;
        let (on, own) = match chain.entries[body] {
            Entry::Ground => return Some(()),
            Entry::Pin { on, own } => (on, own),
            Entry::OnRail { .. } | Entry::WithRail { .. } => return None,
        };
        let turn = &chain.turns[body];
        let of_unknown = turn.unknown.map(|k| (k, 1.0));
        let of_drive = (turn.drive != 0.0).then_some((chain.unknowns, turn.drive));
        let columns = of_unknown.into_iter().chain(of_drive);
        all.extend(columns.map(|(column, by)| Arm {
            body,
            column,
            arm: spot.at - own,
            by: sign * by,
        }));
        spot = on;
    }
}
