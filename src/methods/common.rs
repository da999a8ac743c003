//! Constructors that most methods use.

use crate::audit::{Budget, CheckPoint, Draw, Limit, Output, Region};

pub(super) fn region(
    name: &'static str,
    description: &'static str,
    sample: impl Fn(&mut Draw) -> Vec<f64> + Send + Sync + 'static,
) -> Region {
    Region::new(name, description, sample)
}

pub(super) fn point(name: &'static str, input: impl Into<Vec<f64>>) -> CheckPoint {
    CheckPoint {
        name,
        input: input.into(),
    }
}

/// Check points as a table: in each line a name and the numbers.
///
/// # Panics
/// On what is no number; a test of the registry makes every domain.
pub(super) fn points(table: &'static str) -> Vec<CheckPoint> {
    let line = |line: &'static str| {
        let mut words = line.split_whitespace();
        let name = words.next().expect("a name");
        let numbers = words.map(|w| w.parse::<f64>().expect(w));
        point(name, numbers.collect::<Vec<f64>>())
    };
    table.lines().map(line).collect()
}

pub(super) fn output(name: &'static str, unit: &'static str, budget: Budget) -> Output {
    Output { name, unit, budget }
}

/// Creates an output with the budget k·u·(1 + condition).
pub(super) fn conditioned(
    name: &'static str,
    unit: &'static str,
    k: f64,
    reason: &'static str,
) -> Output {
    output(name, unit, Budget::new(Limit::Conditioned(k), reason))
}

/// The residual of a law that holds bit for bit or not at all.
pub(super) fn held(held: bool) -> Option<f64> {
    Some(if held { 0.0 } else { f64::INFINITY })
}

/// `(f(x + h) − f(x − h))/2h`, 2h being the distance of the rounded places.
pub(super) fn central_difference(f: impl Fn(f64) -> Option<f64>, x: f64, h: f64) -> Option<f64> {
    let (below, above) = (x - h, x + h);
    Some((f(above)? - f(below)?) / (above - below))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_hold_is_off_beyond_all_bounds() {
        assert_eq!((held(true), held(false)), (Some(0.0), Some(f64::INFINITY)));
    }

    /// Of a parabola the difference is the slope itself.
    #[test]
    fn differences_are_taken_on_both_sides() {
        let square = |x: f64| Some(x * x);
        assert_eq!(central_difference(square, 3.0, 0.5), Some(6.0));
        assert_eq!(central_difference(square, -1.0, 0.25), Some(-2.0));
        let from = |x: f64| (x >= 3.0).then_some(x);
        let to = |x: f64| (x <= 3.0).then_some(x);
        assert_eq!(central_difference(from, 3.0, 0.5), None);
        assert_eq!(central_difference(to, 3.0, 0.5), None);
    }

    #[test]
    fn a_line_of_a_table_is_a_name_and_numbers() {
        let found = points("first  1 -2.5\nsecond inf");
        let shown: Vec<_> = found.iter().map(|p| (p.name, &p.input[..])).collect();
        assert_eq!(
            shown,
            [("first", &[1.0, -2.5][..]), ("second", &[f64::INFINITY])]
        );
    }
}
