use super::*;
use crate::program::{Program, Setting};
use mechaudit_symbolic::graph::Graph;
use mechaudit_symbolic::{Definitions, parse};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// The values of operations where the condition holds are in their ranges; those of sums that it
/// bounds are narrow.
#[test]
fn ranges_hold_the_values_that_the_condition_admits() {
    let mut graph = Graph::new(["x", "y"].map(String::from));
    let mut build = |text: &str| {
        graph
            .build(&Definitions::default(), &parse(text).unwrap())
            .unwrap()
    };
    let formula = build("(x - y)*(x + y - 3)*(2*y - x)");
    let condition = build("x > y + 0.25 and x + 2*y > 4 and x*y < 3");
    let domain = [Interval::new(0.0, 4.0); 2];
    let program = Program::new(
        &graph,
        &[formula],
        Some(condition),
        &domain,
        Setting::default(),
    );
    let program = program.unwrap();
    let (tape, place) = program.condition.as_ref().unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(63);
    let (mut narrow, mut points) = (0, 0);
    for _ in 0..400 {
        let mut end = || {
            let lo = random.random_range(0.0..3.0f64);
            Interval::new(lo, lo + random.random_range(0.0..1.0))
        };
        let at = [end(), end()];
        let centre = at.map(|x| 0.5 * (x.lo + x.hi));
        let pass = |tape: &Tape, at: &[Interval], narrowing| {
            let mut pass = Pass::new(Setting::default(), 2);
            pass.narrowing = narrowing;
            pass.forward(tape, at, true, &[]).unwrap();
            pass
        };
        let there = centre.map(Interval::point);
        let [over, middle] = [&at, &there].map(|at| pass(tape, at, None));
        let steps = vec![at[0] - there[0], at[1] - there[1]];
        let values = pass(&program.tape, &there, None).value;
        let narrowing = Narrowing::new((tape, *place), [&over, &middle], steps, values);
        let found = pass(&program.tape, &at, narrowing);
        narrow += usize::from(found.is_narrowed());
        let wide = pass(&program.tape, &at, None);
        for (range, wide) in found.value.iter().zip(&wide.value) {
            assert!(wide.lo <= range.lo && range.hi <= wide.hi);
        }
        for _ in 0..40 {
            let [x, y] = at.map(|x| random.random_range(x.lo..=x.hi));
            if !(x > y + 0.25 && x + 2.0 * y > 4.0 && x * y < 3.0) {
                continue;
            }
            points += 1;
            let due = pass(&program.tape, &[x, y].map(Interval::point), None);
            for (range, value) in found.value.iter().zip(&due.value) {
                assert!(
                    range.lo <= value.hi && value.lo <= range.hi,
                    "{x} {y} {range:?} {value:?}"
                );
            }
        }
    }
    assert!(narrow > 50 && points > 500, "{narrow} {points}");
}
