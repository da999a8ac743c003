//! Laws judge planted solvers.

use super::*;

#[test]
fn the_first_three_of_nine_values_are_angles() {
    let values: Vec<f64> = (0..18).map(f64::from).collect();
    let found: Vec<&[f64]> = turns(&values).collect();
    assert_eq!(found, [[0.0, 1.0, 2.0], [9.0, 10.0, 11.0]]);
}

#[test]
fn a_difference_is_measured_by_value_and_condition() {
    let of = |b: f64, c: f64| within(2.0, &[1.0, 5.0], &[1.0 + b, 5.0], &[c, 0.0]);
    assert_eq!(of(0.0, 0.0), 0.0);
    assert_eq!(of(8.0 * U, 0.0), 4.0);
    assert_eq!(of(8.0 * U, 3.0), 1.0);
    assert_eq!(of(-8.0 * U, 3.0), 1.0);
    assert!(of(f64::NAN, 3.0).is_nan() && of(8.0 * U, f64::NAN).is_nan());
}

const HOLDS: Option<f64> = Some(0.0);
const BROKEN: Option<f64> = Some(f64::INFINITY);

fn check_point(method: &str) -> Vec<f64> {
    let method = crate::methods::find(method).unwrap();
    method.domain().check_points[0].input.clone()
}

#[test]
fn nothing_off_is_no_share_of_nothing() {
    assert_eq!((share(0.0, 0.0), share(-0.0, 4.0)), (0.0, 0.0));
    assert_eq!((share(2.0, 4.0), share(-2.0, 4.0)), (0.5, 0.5));
    assert_eq!(share(1.0, 0.0), f64::INFINITY);
    assert!(share(f64::NAN, 1.0).is_nan());
}

/// Planted solvers tell the two linkages apart by the sign of phi.
#[test]
fn a_solver_that_is_not_mirrored_breaks_the_law() {
    let x = check_point("planar-linkage");
    let law = |solve: Solve| mirror(solve, &x);
    assert!(law(|i| i.motion()).is_some_and(|r| r <= 1.0));
    let refuses: Solve = |i| match i.phi < 0.0 {
        true => Err("structure"),
        false => i.motion(),
    };
    assert_eq!(law(refuses), BROKEN);
    let moved: Solve = |i| {
        let mut all = i.motion()?;
        let last = all.len() - 1;
        all[last] += if i.phi < 0.0 { 1e-9 } else { 0.0 };
        Ok(all)
    };
    assert!(law(moved).is_some_and(|r| r > 1.0));
    assert_eq!(law(|_| Err("structure")), None);
}

/// Planted solvers tell the two linkages apart by the crank's place on the coupler, 1 m from its
/// pivot at first.
#[test]
fn a_solver_that_turns_with_the_scale_breaks_the_law() {
    let x = check_point("planar-linkage");
    let law = |solve: Solve| scale(solve, &x);
    assert_eq!(law(|i| i.motion()), HOLDS);
    fn changed(i: PlanarLinkageInput, place: usize) -> Result<Vec<f64>, &'static str> {
        let mut all = i.motion()?;
        all[place] += f64::from(u8::from(i.xa[1].hypot(i.ya[1]) > 1.5));
        Ok(all)
    }
    for (solve, due) in [
        ((|i| changed(i, 9)) as Solve, BROKEN),
        (|i| changed(i, 10), BROKEN),
        (|i| changed(i, 20), BROKEN),
        // Coordinates of centres of mass are lengths.
        (|i| changed(i, 12), HOLDS),
        (|i| changed(i, 26), HOLDS),
    ] {
        assert_eq!(law(solve), due);
    }
    let refuses: Solve = |i| match i.xa[1].hypot(i.ya[1]) > 1.5 {
        true => Err("structure"),
        false => i.motion(),
    };
    assert_eq!(law(refuses), BROKEN);
    assert_eq!(law(|_| Err("structure")), None);
}

#[test]
fn a_force_that_does_not_double_with_the_masses_breaks_the_law() {
    let x = check_point("planar-reactions");
    let law = |solve: SolveForces| masses(solve, &x);
    assert_eq!(law(|i| i.forces()), HOLDS);
    assert_eq!(law(|i| Ok(vec![i.m[0] + i.m[1], i.j[2]])), HOLDS);
    assert_eq!(law(|i| Ok(vec![i.m[0], 1.0])), BROKEN);
    assert_eq!(law(|i| Ok(vec![i.j[0] * i.j[0], i.m[0]])), BROKEN);
    assert_eq!(law(|i| Ok(vec![1.0; i.m[0] as usize])), BROKEN);
    assert_eq!(law(|_| Err("masses")), None);
}

/// Without masses nothing is asked for: pins of a four-bar, the first and the last of which are on
/// the ground.
#[test]
fn a_force_on_the_ground_that_nothing_asks_for_breaks_the_law() {
    let mut x = check_point("planar-reactions");
    let masses = x.len() - 6;
    let heavy = x.clone();
    x[masses..].fill(0.0);
    let law = |solve: SolveForces, x: &[f64]| virtual_work(solve, x);
    assert!(law(|i| i.forces(), &heavy).is_some_and(|r| r <= 1.0));
    assert_eq!(law(|_| Ok(vec![0.0; 8]), &x), Some(0.0));
    // Pins between moving bodies, and a couple of forces on the ground: pin 0 is on its body b, pin
    // 3 likewise.
    assert_eq!(
        law(|_| Ok(vec![0.0, 0.0, 5.0, 6.0, 7.0, 8.0, 0.0, 0.0]), &x),
        Some(0.0)
    );
    assert_eq!(
        law(|_| Ok(vec![2.0, 3.0, 0.0, 0.0, 0.0, 0.0, -2.0, -3.0]), &x),
        Some(0.0)
    );
    // All that is allowed is 16 u of the force itself.
    for solve in [
        (|_| Ok(vec![2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])) as SolveForces,
        |_| Ok(vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -3.0]),
    ] {
        let found = law(solve, &x).unwrap();
        assert!((found * 16.0 * U - 1.0).abs() < 1e-12, "{found:e}");
    }
    assert_eq!(law(|_| Err("masses"), &x), None);
}
