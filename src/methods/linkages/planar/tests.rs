//! Audits of planar linkages with another seed, planted faults, inputs that are none.

use super::drawn::Linkage;
use super::flow::{C, Flow, I, dot};
use super::{PlanarForcesInput, PlanarLinkage, PlanarLinkageInput, PlanarReduction};
use crate::audit::{ReferenceAnswer, Settings, SolverAnswer, Variant, audit_method};
use crate::methods::definition::{Definition, exact};
use crate::methods::find;
use crate::reference::Ball;

fn few() -> Settings {
    Settings {
        seed: 20_261_125,
        cases_per_region: 12,
        ..Settings::default()
    }
}

#[test]
fn all_pass_with_another_seed() {
    for name in ["planar-linkage", "planar-reduction", "planar-reactions"] {
        let report = audit_method(&*find(name).unwrap(), &few(), &|| ());
        let failed = report
            .failures
            .first()
            .map(|f| (&f.case, &f.judgement.reason));
        assert!(report.passed(), "{name}: {failed:?} {:?}", report.laws);
        assert!(report.laws.iter().all(|l| l.cases > 30), "{name}");
    }
}

/// One value of a body that is off by little: angles by 1e-9, rates by a millionth.
#[test]
fn small_faults_fail() {
    let method = find("planar-linkage").unwrap();
    for (place, by) in [
        (9, 1.0 + 1e-9),
        (10, 1.0 + 1e-6),
        (11, 1.0 + 1e-5),
        (14, -1.0),
    ] {
        let faulty = Variant::new(&*method)
            .solver(
                move |x| match PlanarLinkage::solve(PlanarLinkage::unpack(x).unwrap()) {
                    Ok(mut v) => {
                        v[place] *= by;
                        SolverAnswer::Values(v)
                    }
                    Err(word) => SolverAnswer::Refuses(word),
                },
            )
            .region("class-iii")
            .unwrap();
        let report = audit_method(&faulty, &few(), &|| ());
        assert!(!report.passed(), "{place}");
    }
}

#[test]
fn what_is_no_linkage_is_outside() {
    let method = find("planar-linkage").unwrap();
    let good = &method.domain().check_points[0].input;
    assert!(method.admits(good));
    // A body that there is not, a body on itself, a fraction of one, too few pins, angles that are
    // far off.
    for (place, value) in [
        (3, 9.0),
        (4, 2.0),
        (3, 0.5),
        (1, 3.0),
        (good.len() - 1, 1.5),
    ] {
        let mut bad = good.clone();
        bad[place] = value;
        assert!(!method.admits(&bad), "{place} {value}");
    }
    // Three masses and three inertias come last.
    for name in ["planar-reduction", "planar-reactions"] {
        let heavy = find(name).unwrap();
        let input = heavy.domain().check_points[0].input.clone();
        let admits = |back: usize, value: f64| {
            let mut other = input.clone();
            let place = other.len() - back;
            other[place] = value;
            heavy.admits(&other)
        };
        assert!(heavy.admits(&input));
        for back in 1..=6 {
            assert!(admits(back, 0.0), "{name} {back}");
            assert!(!admits(back, -1.0), "{name} {back}");
            assert!(!admits(back, f64::NAN), "{name} {back}");
        }
        // The angle of the last body.
        assert!(!admits(7, 1.5), "{name}");
    }
    let heavy = find("planar-reduction").unwrap();
    let mut lighter = heavy.domain().check_points[0].input.clone();
    *lighter.last_mut().unwrap() = -1.0;
    assert_eq!(
        PlanarReduction::solve(PlanarReduction::unpack(&lighter[..]).unwrap()),
        Err("masses")
    );
}

/// Checks that what is zero changes nothing, and costs the solution of a system.
#[test]
fn coordinates_of_zero_are_no_data() {
    let method = find("planar-linkage").unwrap();
    let mut zeros = 0;
    for point in method.domain().check_points {
        let i = PlanarLinkage::unpack(&point.input).unwrap();
        let data = Flow::new(&i, i.near).unwrap().data();
        assert!(data.iter().all(|d| d.size > 0.0), "{}", point.name);
        zeros += [i.xa, i.ya, i.xb, i.yb]
            .concat()
            .iter()
            .filter(|x| **x == 0.0)
            .count();
    }
    assert!(zeros > 0);
}

/// Bodies, pins, and the bodies of each pin.
fn joined(bodies: f64, pins: f64, pairs: &[[f64; 2]]) -> Option<Vec<[usize; 2]>> {
    let [a, b] = [0, 1].map(|end| pairs.iter().map(|p| p[end]).collect());
    let linkage = Linkage {
        a,
        b,
        ..Linkage::default()
    };
    let input = PlanarLinkageInput {
        bodies,
        pins,
        ..linkage.input()
    };
    input.joined()
}

#[test]
fn pins_join_two_bodies_each_that_there_are() {
    let good = [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0], [0.0, 3.0]];
    let due = vec![[0, 1], [1, 2], [2, 3], [0, 3]];
    assert_eq!(joined(3.0, 4.0, &good), Some(due));
    assert_eq!(joined(1.0, 1.0, &[[1.0, 0.0]]), Some(vec![[1, 0]]));
    for bad in [-1.0, 0.5, 3.0, 4.0, f64::NAN, f64::INFINITY] {
        for end in [0, 1] {
            let mut pairs = good;
            pairs[2] = [3.0, 3.0];
            pairs[2][end] = bad;
            assert_eq!(joined(3.0, 4.0, &pairs), None, "{bad} at end {end}");
        }
    }
    for (bodies, pins) in [
        (2.5, 4.0),
        (3.0, 4.5),
        (-3.0, 4.0),
        (f64::NAN, 4.0),
        (3.0, f64::NAN),
        (3.0, 3.0),
        (1.0, 4.0),
        (0.0, 0.0),
        (3.0, f64::MAX),
        (f64::MAX, 4.0),
    ] {
        assert_eq!(joined(bodies, pins, &good), None, "{bodies} {pins}");
    }
}

/// Checks what the solver's homotopy is for.
#[test]
fn nine_bodies_are_the_most() {
    let pins = |count: usize| vec![[0.0, 1.0]; count];
    assert!(joined(9.0, 13.0, &pins(13)).is_some());
    assert_eq!(joined(11.0, 16.0, &pins(16)), None);
}

/// A crank of length 1 on the x-axis, a coupler of length 3 at the angle t to it, an upright rocker
/// of length 2: the rocker turns by −tan t/2 of the crank.
fn rocker_at(t: f64) -> Vec<f64> {
    let joint = [1.0 + 3.0 * t.cos(), 3.0 * t.sin()];
    four_bar([1.0, 0.0], joint, [joint[0], joint[1] - 2.0])
}

/// Pins at the origin and at three places, the frames of all bodies being that of the ground.
fn four_bar(crank: [f64; 2], joint: [f64; 2], ground: [f64; 2]) -> Vec<f64> {
    let places = [[0.0, 0.0], crank, joint, ground];
    let [x, y] = [0, 1].map(|axis| places.map(|p| p[axis]).to_vec());
    let linkage = Linkage {
        phi: 0.0,
        a: vec![0.0, 1.0, 2.0, 0.0],
        b: vec![1.0, 2.0, 3.0, 3.0],
        xa: x.clone(),
        ya: y.clone(),
        xb: x,
        yb: y,
        xs: vec![0.5; 3],
        ys: vec![0.25; 3],
        near: vec![0.0; 3],
    };
    linkage.input().to_vec()
}

fn law(name: &str, input: &[f64]) -> Option<f64> {
    let laws = PlanarLinkage::laws();
    let law = laws.iter().find(|l| l.name == name).expect(name);
    (law.residual)(input)
}

#[test]
fn a_body_that_hardly_moves_is_not_exchanged_with_the_drive() {
    let rate = |t: f64| PlanarLinkage::solve(PlanarLinkage::unpack(&rocker_at(t)).unwrap());
    assert!((rate(0.022).unwrap()[19] + 0.022f64.tan() / 2.0).abs() < 1e-12);
    for t in [0.022, -0.022] {
        let applied = law("exchange", &rocker_at(t));
        assert!(applied.is_some_and(|r| r <= 1.0), "{t}: {applied:?}");
    }
    for t in [0.018, -0.018] {
        assert_eq!(law("exchange", &rocker_at(t)), None, "{t}");
    }
}

/// Coupler and rocker nearly in line.
#[test]
fn a_body_whose_rate_is_vague_is_not_exchanged_with_the_drive() {
    let mut sides = [0, 0];
    for k in 0..120 {
        let off = 0.3 * 0.94f64.powi(k);
        let input = four_bar([1.0, 1.0], [3.0, 1.0 + off], [5.0, 1.0]);
        let here = PlanarLinkage::solve(PlanarLinkage::unpack(&input).unwrap()).unwrap();
        let conditions = PlanarLinkage::conditions(&input).unwrap();
        let known = conditions[19] / here[19].abs() < 1e4;
        assert_eq!(law("exchange", &input).is_some(), known, "{off}");
        sides[usize::from(known)] += 1;
    }
    assert!(sides.iter().all(|n| *n > 20), "{sides:?}");
}

#[test]
fn what_is_no_linkage_is_refused_by_its_name() {
    let refused = |change: fn(&mut Linkage)| {
        let input = rocker_at(0.5);
        let mut linkage = Linkage::of(&PlanarLinkage::unpack(&input).unwrap());
        change(&mut linkage);
        let numbers = exact(&linkage.input().to_vec()).unwrap();
        let reference = PlanarLinkage::reference(PlanarLinkage::unpack(&numbers).unwrap(), 128);
        let word = PlanarLinkage::solve(linkage.input()).err();
        let due = reference.err().map(|e| e.to_string());
        (word, due == word.map(String::from))
    };
    assert_eq!(refused(|_| ()), (None, true));
    assert_eq!(
        refused(|l| l.near[2] = 1.0),
        (Some("no position near"), true)
    );
    assert_eq!(refused(|l| l.a[1] = 2.0), (Some("bad layout"), true));
    // Two bodies on two pins between them: the reference counts pins alone.
    assert_eq!(refused(|l| l.a[3] = 2.0).0, Some("structure"));
}

/// A crank alone: 1/4 of its frame turns about 1/2 of the ground, its centre of mass is at 2 + i.
fn pendulum(m: f64, j: f64) -> Vec<f64> {
    let linkage = Linkage {
        phi: 0.5,
        a: vec![0.0],
        b: vec![1.0],
        xa: vec![0.5],
        ya: vec![0.0],
        xb: vec![0.25],
        yb: vec![0.0],
        xs: vec![2.0],
        ys: vec![1.0],
        near: vec![0.5],
    };
    let all = PlanarForcesInput {
        speed: 3.0,
        acceleration: -4.0,
        gx: 1.0,
        gy: -9.0,
        linkage: linkage.input(),
        m: &[m],
        j: &[j],
    };
    all.to_vec()
}

/// With S = ½ + r, r = z e^{iφ}: I = m |z|² + J, M_o = m g·ir, M_o' = −m g·r, Q = I φ̈ − M_o; the
/// pin exerts m (r̈ − g) on the crank.
#[test]
fn a_pendulum_moves_as_its_closed_form_says() {
    let (m, j) = (1.5, 0.25);
    let input = pendulum(m, j);
    let r = C::new(1.75, 1.0) * C::from_polar(1.0, 0.5);
    let g = C::new(1.0, -9.0);
    let inertia = m * (1.75 * 1.75 + 1.0) + j;
    let moment = m * dot(g, I * r);
    let slope = -m * dot(g, r);
    let force = m * (I * r * -4.0 - r * 9.0 - g);
    let motion = [
        &[0.5, 1.0, 0.0, 0.5 + r.re, r.im][..],
        &[-r.im, r.re, -r.re, -r.im],
    ];
    let reduced = [inertia, 0.0, moment, slope, inertia * -4.0 - moment];
    for (name, input, due) in [
        (
            "planar-linkage",
            &input[4..input.len() - 2],
            motion.concat(),
        ),
        ("planar-reduction", &input[..], reduced.to_vec()),
        ("planar-reactions", &input[..], vec![force.re, force.im]),
    ] {
        let method = find(name).unwrap();
        let solved = match method.solve(input) {
            SolverAnswer::Values(values) => values,
            other => panic!("{name}: {other:?}"),
        };
        let reference = match method.reference(&exact(input).unwrap(), 128) {
            ReferenceAnswer::Values(reference) => reference,
            other => panic!("{name}: {other:?}"),
        };
        let reference: Vec<f64> = reference.values.iter().map(Ball::to_f64).collect();
        for found in [solved, reference] {
            let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-13 * (1.0 + b.abs());
            assert!(
                found.len() == due.len() && found.iter().zip(&due).all(close),
                "{name}: {found:?} {due:?}"
            );
        }
        let conditions = method.conditions(input).unwrap();
        assert_eq!(conditions.len(), due.len(), "{name}");
        assert!(
            conditions.iter().all(|c| c.is_finite()),
            "{name}: {conditions:?}"
        );
    }
}

#[test]
fn masses_are_not_negative() {
    for name in ["planar-reduction", "planar-reactions"] {
        let method = find(name).unwrap();
        let refused = |m: f64, j: f64| {
            let input = pendulum(m, j);
            let exact = exact(&input).unwrap();
            let answer = method.reference(&exact, 128);
            let reference = matches!(answer, ReferenceAnswer::Refuses("masses"));
            let solver = method.solve(&input) == SolverAnswer::Refuses("masses");
            assert_eq!(
                (reference, !method.admits(&input)),
                (solver, solver),
                "{name}"
            );
            solver
        };
        assert!(!refused(1.0, 0.0) && !refused(0.0, 1.0));
        assert!(refused(-1.0, 1.0) && refused(1.0, -1.0));
    }
}
