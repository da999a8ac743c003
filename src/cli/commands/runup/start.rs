//! The window of a start too short to be seen beside the rest of the run.

use mechaudit::solvers::run_up::Sample;

/// A rise of the speed within this part of the run shows as a vertical line.
const SHORT: f64 = 0.04;

/// The length of a start that the drawing of the whole run would show as a vertical line: somewhat
/// longer than the speed takes to come to where it stays in the second half of the run.
pub fn short_start(samples: &[Sample]) -> Option<f64> {
    let end = samples.last()?.t;
    let later = samples.iter().filter(|s| 2.0 * s.t >= end);
    let (low, high) = later.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| {
        (a.min(s.psi), b.max(s.psi))
    });
    let there = samples.iter().find(|s| (low..=high).contains(&s.psi))?.t;
    if !(there > 0.0 && there < SHORT * end) {
        return None;
    }
    // One significant digit: no more than four times as long.
    let longer = 2.0 * there;
    let decade = 10f64.powf(longer.log10().floor());
    Some((longer / decade).ceil() * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(of: &[(f64, f64)]) -> Vec<Sample> {
        let one = |&(t, psi): &(f64, f64)| Sample {
            t,
            psi,
            ..Sample::default()
        };
        of.iter().map(one).collect()
    }

    /// From the middle of the run on the speed lies between 9 and 11: the start is over when it
    /// first does.
    #[test]
    fn a_start_is_short_beside_the_run() {
        let run = |rise: &[(f64, f64)]| {
            let rest = [
                (3.0, 4.0),
                (5.0, 9.0),
                (6.0, 10.0),
                (8.0, 11.0),
                (10.0, 10.0),
            ];
            short_start(&samples(&[&[(0.0, 0.0)], rise, &rest].concat()))
        };
        for (rise, due) in [
            (&[(0.1, 5.0), (0.2, 8.9), (0.3, 9.5)][..], Some(0.6)),
            (&[(0.3, 9.0)], Some(0.6)),
            (&[(0.3, 11.0)], Some(0.6)),
            (&[(0.3, 11.1), (0.35, 10.0)], Some(0.7)),
            (&[(0.06, 10.0)], Some(0.2)),
            (&[(0.003, 10.0)], Some(0.006)),
            (&[(0.399, 10.0)], Some(0.8)),
            (&[(0.4, 10.0)], None),
            (&[(0.5, 10.0)], None),
            (&[], None),
        ] {
            let found = run(rise);
            let same = match (found, due) {
                (Some(a), Some(b)) => (a - b).abs() < 1e-12,
                _ => found == due,
            };
            assert!(same, "{rise:?}: {found:?}");
        }
    }

    /// It is never over, or was from the first moment on.
    #[test]
    fn some_runs_have_no_start() {
        assert_eq!(short_start(&[]), None);
        assert_eq!(
            short_start(&samples(&[(0.0, 1.0), (0.1, 1.0), (9.0, 1.0)])),
            None
        );
    }
}
