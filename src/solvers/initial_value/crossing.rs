//! Where within a step a limit is crossed.

/// Places within a step at which is looked.
const LOOKS: u32 = 4;

/// Halvings of a part of a step: down to rounding.
const HALVINGS: u32 = 60;

/// The first crossing found within a step, with its time.
///
/// `look` tells what has been crossed at a time. Its second argument is true where the step is
/// looked at from its beginning to its end, and false on the way to a crossing that was found.
pub(crate) fn first_crossing<P, E>(
    [from, to]: [f64; 2],
    mut look: impl FnMut(f64, bool) -> Result<Option<P>, E>,
) -> Result<Option<(f64, P)>, E> {
    let mut left = from;
    for k in 1..=LOOKS {
        let right = match k {
            LOOKS => to,
            _ => from + (to - from) * f64::from(k) / f64::from(LOOKS),
        };
        if let Some(mut crossed) = look(right, true)? {
            let (mut low, mut high) = (left, right);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if !(low < middle && middle < high) {
                    break;
                }
                // The first crossing may change on the way.
                match look(middle, false)? {
                    Some(earlier) => (high, crossed) = (middle, earlier),
                    None => low = middle,
                }
            }
            return Ok(Some((high, crossed)));
        }
        left = right;
    }
    Ok(None)
}
