//! Tests of `systems`.

use super::*;
use rug::Rational;

type Rows = Vec<Ball>;

/// A system by two closures.
struct By<F, J>(F, J);

impl<F, J> System for By<F, J>
where
    F: FnMut(&[Ball], u32) -> Result<Rows, &'static str>,
    J: FnMut(&[Ball], u32) -> Result<Rows, &'static str>,
{
    type Error = &'static str;
    fn values(&mut self, x: &[Ball], bits: u32) -> Result<Rows, &'static str> {
        (self.0)(x, bits)
    }
    fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Rows, &'static str> {
        (self.1)(x, bits)
    }
}

/// `x² + y² = 2 + c`, `x y = 1`: touching at (1, 1) for c = 0.
fn hyperbola(c: Rational) -> impl System<Error = &'static str> {
    By(
        move |x: &[Ball], bits| {
            let circle = x[0].square() + x[1].square() - Ball::integer(bits, 2);
            Ok(vec![
                circle - Ball::rational(bits, &c),
                &x[0] * &x[1] - Ball::integer(bits, 1),
            ])
        },
        |x: &[Ball], _| {
            Ok(vec![
                x[0].shift(1),
                x[1].shift(1),
                x[1].clone(),
                x[0].clone(),
            ])
        },
    )
}

/// `x = ((√(4 + c) + √c)/2, (√(4 + c) − √c)/2)`.
fn solution(c: i64) -> [Ball; 2] {
    let (s, d) = (
        Ball::integer(600, 4 + c).sqrt(),
        Ball::integer(600, c).sqrt(),
    );
    [(&s + &d).shift(-1), (&s - &d).shift(-1)]
}

#[test]
fn a_solution_near_a_start_is_enclosed() {
    let mut system = hyperbola(Rational::from(1));
    for goal in [53, 200] {
        let x = near(&mut system, &[1.5, 0.5], goal).unwrap();
        for (x, due) in x.iter().zip(&solution(1)) {
            assert!(x.contains_ball(due) && x.accuracy_bits() >= i64::from(goal));
        }
    }
    let x = in_box(&mut system, &[[1.0, 8.0], [-4.0, 0.875]], 100, 5000).unwrap();
    assert!(
        x.iter()
            .zip(&solution(1))
            .all(|(x, due)| x.contains_ball(due) && x.accuracy_bits() >= 100)
    );
}

#[test]
fn none_one_and_several_are_told_apart() {
    let mut system = hyperbola(Rational::from(1));
    assert!(matches!(
        in_box(&mut system, &[[-9.0, 9.0], [2.0, 9.0]], 53, 5000),
        Err(SystemError::None)
    ));
    // All four.
    let Err(SystemError::Several { solutions }) = in_box(&mut system, &[[-9.0, 9.0]; 2], 53, 5000)
    else {
        panic!("several");
    };
    assert!(
        solutions[0]
            .iter()
            .zip(&solutions[1])
            .any(|(x, y)| !x.overlaps(y))
    );
    let few = in_box(&mut system, &[[-9.0, 9.0]; 2], 53, 2);
    assert!(matches!(few, Err(SystemError::Undecided { open, .. }) if !open.is_empty()));
}

#[test]
fn a_double_solution_is_undecided() {
    let mut system = hyperbola(Rational::new());
    assert!(matches!(
        near(&mut system, &[1.25, 0.75], 53),
        Err(SystemError::Undecided { .. })
    ));
    let Err(SystemError::Undecided { open, .. }) =
        in_box(&mut system, &[[0.5, 3.0], [0.25, 3.0]], 53, 2000)
    else {
        panic!("undecided");
    };
    assert!(
        open.iter()
            .any(|part| part.iter().all(|[lo, hi]| *lo <= 1.0 && 1.0 <= *hi))
    );
}

/// A hyperbola that misses the circle: Newton's method finds nothing, and the test proves nothing.
#[test]
fn a_system_without_a_solution_is_not_enclosed() {
    let mut system = hyperbola(Rational::from((-1, 1 << 20)));
    assert!(matches!(
        near(&mut system, &[1.0, 1.0001], 53),
        Err(SystemError::Undecided { .. })
    ));
    let mut at = At {
        system: &mut system,
        n: 2,
    };
    let z = [1.25, 1.0].map(|x| Float::with_val(96, x)).to_vec();
    assert!(at.proved(&z, 96).unwrap().is_none());
}

/// The box is held by the operator only where its image is: a box beside the zero is not one.
#[test]
fn the_image_decides() {
    let mut system = hyperbola(Rational::from(1));
    let due = solution(1);
    let mut at = At {
        system: &mut system,
        n: 2,
    };
    let z: Vec<Float> = due
        .iter()
        .map(|x| Float::with_val(96, x.mid()) + 0.001953125f64)
        .collect();
    let y = at.inverse(&z, 96).unwrap().unwrap();
    let around = |k| vec![Mag::power_of_two(k); 2];
    assert!(!at.krawczyk(&y, &z, &around(-12), 96).unwrap().is_inside);
    let held = at.krawczyk(&y, &z, &around(-7), 96).unwrap();
    assert!(
        held.is_inside
            && held
                .image
                .iter()
                .zip(&due)
                .all(|(x, due)| x.contains_ball(due))
    );
    // Over a wide box the derivative is nowhere near that of the middle.
    assert!(!at.krawczyk(&y, &z, &around(1), 96).unwrap().is_inside);
    // The solution that is found has to be the one of the box.
    let other: Vec<Ball> = due
        .iter()
        .map(|x| Ball::new(x.mid().clone() + 1u32, Mag::from_f64(0.5)))
        .collect();
    let start: Vec<Float> = due.iter().map(|x| Float::with_val(96, x.mid())).collect();
    let found = at.refined(&start, Some(&other), 53);
    assert!(matches!(found, Err(SystemError::Undecided { open, .. }) if open.len() == 1));
}

/// A linear system whose zero is beside the part of the box that it was found over.
#[test]
fn a_solution_outside_its_part_is_not_counted() {
    let half = || Ball::new(Float::with_val(96, 0.5), Mag::ZERO);
    let x = vec![half()];
    let part = |lo: f64, hi: f64| vec![[lo, hi].map(|x| Float::with_val(96, x))];
    assert!(within(&x, &part(0.0, 1.0)) && !within(&x, &part(0.5, 1.0)));
    assert!(apart(&x, &part(0.625, 1.0)) && !apart(&x, &part(0.5, 1.0)));
}

#[test]
fn wrong_data_are_named() {
    let mut system = hyperbola(Rational::from(1));
    let nan = near(&mut system, &[1.0, f64::NAN], 53);
    assert!(matches!(
        nan,
        Err(SystemError::Data(LinearError::NotFinite {
            row: 1,
            column: 0
        }))
    ));
    let turned = in_box(&mut system, &[[0.0, 1.0], [2.0, 1.0]], 53, 9);
    assert!(matches!(turned, Err(SystemError::Side { row: 1, .. })));
    let nan = in_box(&mut system, &[[0.0, 1.0], [f64::NAN, 1.0]], 53, 9);
    assert!(matches!(
        nan,
        Err(SystemError::Data(LinearError::NotFinite { row: 1, .. }))
    ));
    let mut short = By(
        |x: &[Ball], _| Ok(vec![x[0].clone()]),
        |_: &[Ball], bits| Ok(vec![Ball::integer(bits, 1); 3]),
    );
    assert!(matches!(
        near(&mut short, &[1.0, 2.0], 53),
        Err(SystemError::Data(LinearError::Length { .. }))
    ));
    let mut fails = By(
        |_: &[Ball], _| Err("no value"),
        |_: &[Ball], _| Err("no derivative"),
    );
    assert!(matches!(
        near(&mut fails, &[1.0], 53),
        Err(SystemError::Function("no derivative"))
    ));
}

/// An unknown that is zero has no relative accuracy.
#[test]
fn zero_is_a_solution() {
    let mut system = By(
        |x: &[Ball], bits| {
            Ok(vec![
                x[0].sin_cos().0 + &x[1] - Ball::integer(bits, 1),
                &x[1] - &x[0].exp(),
            ])
        },
        |x: &[Ball], bits| {
            let one = Ball::integer(bits, 1);
            Ok(vec![x[0].sin_cos().1, one.clone(), -x[0].exp(), one])
        },
    );
    let x = near(&mut system, &[0.25, 1.25], 120).unwrap();
    assert!(x[0].contains(&Rational::new()) && x[0].rad() < Mag::power_of_two(-118));
    assert!(x[1].contains(&Rational::from(1)) && x[1].accuracy_bits() >= 120);
}
