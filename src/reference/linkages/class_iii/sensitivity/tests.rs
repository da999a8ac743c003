//! Tests of `sensitivity`.

use super::super::tests::{q, zinchenko};
use super::super::{Body, ExactAngle, Geometry};
use super::*;

const BITS: u32 = 256;
const STEP: u32 = 80;

fn masses() -> Masses {
    let body = |i: usize| Body {
        mass: Rational::from((10 + i as u32, 3)),
        inertia: Rational::from((7 * i as u32 + 2, 5)),
        about_pivot: i == 2,
        radius: Rational::from((3 + 5 * i as u32, 2)),
        angle: ExactAngle::Radians(Rational::from((2 * i as i32 - 3, 4))),
    };
    Masses {
        bodies: std::array::from_fn(body),
        gravity: q("9.81"),
    }
}

/// Outputs at the third mode.
fn outputs(g: &Geometry, phi1: &Rational, masses: &Masses) -> Vec<Ball> {
    let linkage = Linkage::new(g, BITS);
    let modes = linkage.modes(&Ball::rational(BITS, phi1)).unwrap();
    let k = linkage.kinematics(&modes[2].configuration).unwrap();
    let r = linkage.reduce(&k, masses);
    let reduced = [
        r.inertia,
        r.inertia_derivative,
        r.moment,
        r.moment_derivative,
    ];
    let rates = k.angles.into_iter().chain(k.first).chain(k.second);
    rates.chain(reduced).collect()
}

#[test]
fn derivatives_are_limits_of_differences() {
    let mut g = zinchenko();
    g.phi_b = ExactAngle::Radians(q("-0.686"));
    let (phi1, masses) = (q("0.4"), masses());
    let before = outputs(&g, &phi1, &masses);
    let mut due = [0.0; 16];
    let mut moved = |g: &Geometry, phi1: &Rational, masses: &Masses| {
        let after = outputs(g, phi1, masses);
        for ((sum, a), b) in due.iter_mut().zip(&after).zip(&before) {
            *sum += (a - b).shift(STEP as i32).to_f64().abs();
        }
    };
    let up = |x: &mut Rational| *x *= Rational::from(1) + (Rational::from(1) >> STEP);
    let turn = |x: &mut ExactAngle| {
        if let ExactAngle::Radians(x) = x {
            up(x);
        }
    };
    type Change<'a, T> = &'a dyn Fn(&mut T);
    let dimensions: [Change<Geometry>; 11] = [
        &|g| up(&mut g.l1),
        &|g| up(&mut g.l2),
        &|g| up(&mut g.l3),
        &|g| up(&mut g.l4),
        &|g| up(&mut g.l5),
        &|g| up(&mut g.lb),
        &|g| turn(&mut g.phi_b),
        &|g| up(&mut g.o3[0]),
        &|g| up(&mut g.o3[1]),
        &|g| up(&mut g.o5[0]),
        &|g| up(&mut g.o5[1]),
    ];
    for change in dimensions {
        let mut g = g.clone();
        change(&mut g);
        moved(&g, &phi1, &masses);
    }
    let mut later = phi1.clone();
    up(&mut later);
    moved(&g, &later, &masses);
    let of_body: [Change<Body>; 4] = [
        &|b| up(&mut b.mass),
        &|b| up(&mut b.inertia),
        &|b| up(&mut b.radius),
        &|b| turn(&mut b.angle),
    ];
    for i in 0..5 {
        for change in of_body {
            let mut masses = masses.clone();
            change(&mut masses.bodies[i]);
            moved(&g, &phi1, &masses);
        }
    }
    let mut heavier = masses.clone();
    up(&mut heavier.gravity);
    moved(&g, &phi1, &heavier);

    let linkage = Linkage::new(&g, 128);
    let phi = Ball::rational(128, &phi1);
    let at = linkage.placed(&phi, &before[1], &before[3]);
    let found = linkage.conditions(&phi, &at, &masses).unwrap();
    let all = [found.angles, found.first, found.second, found.reduced].concat();
    for (i, (found, due)) in all.iter().zip(due).enumerate() {
        assert!(
            (found.to_f64() / due - 1.0).abs() < 1e-14,
            "{i}: {found:?} {due}"
        );
    }
    let angles = linkage.angle_conditions(&phi, &at).unwrap();
    assert_eq!(angles, found.angles);
}

#[test]
fn a_singular_position_has_no_conditions() {
    let linkage = Linkage::new(&zinchenko(), 128);
    // C and D as if links 3, 4 and 5 were in line: not a configuration, but singular.
    let wide = Ball::new(rug::Float::with_val(128, 0.3), Mag::from_f64(4.0));
    let at = linkage.placed(&Ball::integer(128, 0), &wide, &wide);
    assert!(
        linkage
            .angle_conditions(&Ball::integer(128, 0), &at)
            .is_none()
    );
}

/// `M_o = −dU/dφ1` with the potential energy `U = g Σ m y`, and its derivative, by differences over
/// 2^-79 rad.
#[test]
fn the_moment_is_what_the_weight_loses() {
    let (g, masses) = (zinchenko(), masses());
    let phi1 = q("0.4");
    let h = Rational::from(1) >> STEP;
    let sine = |x: Ball| x.sin_cos().0;
    let b = |x: &Rational| Ball::rational(BITS, x);
    let energy = |phi1: &Rational| {
        let angles = outputs(&g, phi1, &masses);
        let all: Vec<Ball> = [b(phi1)].into_iter().chain(angles).take(5).collect();
        let a = b(&g.l1) * sine(all[0].clone());
        let c = b(&g.o3[1]) + b(&g.l3) * sine(all[2].clone());
        let origins = [Ball::integer(BITS, 0), a, b(&g.o3[1]), c, b(&g.o5[1])];
        let mut sum = Ball::integer(BITS, 0);
        for (k, body) in masses.bodies.iter().enumerate() {
            let angle = &all[k] + body.angle.to_ball(BITS);
            let y = &origins[k] + b(&body.radius) * sine(angle);
            sum = sum + b(&body.mass) * y;
        }
        sum * b(&masses.gravity)
    };
    let slope = |of: &dyn Fn(&Rational) -> Ball| {
        let [before, after] =
            [Rational::from(&phi1 - &h), Rational::from(&phi1 + &h)].map(|x| of(&x));
        (after - before).shift(STEP as i32 - 1).to_f64()
    };
    let found = outputs(&g, &phi1, &masses);
    let near = |x: f64, due: f64| assert!((x / due - 1.0).abs() < 1e-12, "{x} {due}");
    near(found[14].to_f64(), -slope(&energy));
    near(
        found[15].to_f64(),
        slope(&|x| outputs(&g, x, &masses)[14].clone()),
    );
    near(
        found[13].to_f64(),
        slope(&|x| outputs(&g, x, &masses)[12].clone()),
    );
}

#[test]
fn a_geometry_from_its_values() {
    let v: [Rational; 11] = std::array::from_fn(|k| Rational::from((k as u32 + 1, 7)));
    let g = Geometry::from_values(&v);
    let lengths = [&g.l1, &g.l2, &g.l3, &g.l4, &g.l5, &g.lb];
    assert!(lengths.into_iter().zip(&v).all(|(l, v)| l == v));
    assert_eq!(g.phi_b, ExactAngle::Radians(v[6].clone()));
    assert_eq!((&g.o3[..], &g.o5[..]), (&v[7..9], &v[9..]));
    assert_eq!(Linkage::new(&g, 96).bits(), 96);
}

/// Over a box of positions conditions are the largest there, not those of its middle.
#[test]
fn conditions_of_a_box_are_those_of_its_worst_position() {
    let (linkage, masses) = (Linkage::new(&zinchenko(), 128), masses());
    let phi = Ball::rational(128, &q("0.4"));
    let modes = linkage.modes(&phi).unwrap();
    let angles = linkage.kinematics(&modes[2].configuration).unwrap().angles;
    let found = |off: [f64; 2], radius: f64| {
        let at = |k: usize, off: f64| {
            let middle = Ball::new(angles[k].mid().clone(), Mag::ZERO);
            (middle + Ball::exact(128, off)).widened(Mag::from_f64(radius))
        };
        let at = linkage.placed(&phi, &at(1, off[0]), &at(3, off[1]));
        let all = linkage.conditions(&phi, &at, &masses).unwrap();
        [all.angles, all.first, all.second, all.reduced].concat()
    };
    let wide = found([0.0; 2], 1e-4);
    for off in [[1e-4, 1e-4], [1e-4, -1e-4], [-1e-4, 1e-4], [-1e-4, -1e-4]] {
        let narrow = found(off, 0.0);
        assert!(
            wide.iter()
                .zip(&narrow)
                .all(|(w, n)| w.to_f64() > n.to_f64())
        );
    }
}
