//! Assur groups of linkages drawn in textbooks.

use super::*;

/// The groups of bodies joined so.
fn of(bodies: usize, joined: &[[usize; 2]]) -> Option<Vec<usize>> {
    let spot = |body| Spot {
        body,
        at: C::default(),
    };
    let pins: Vec<[Spot; 2]> = joined.iter().map(|ends| ends.map(spot)).collect();
    groups(bodies, &pins)
}

#[test]
fn groups_are_the_fewest_bodies_that_their_pins_determine() {
    // A crank alone.
    assert_eq!(of(1, &[[0, 1]]), Some(vec![0, 0]));
    // A four-bar: one dyad.
    let four_bar = [[0, 1], [1, 2], [2, 3], [0, 3]];
    assert_eq!(of(3, &four_bar), Some(vec![0, 0, 1, 1]));
    // Watt's: a second dyad on the bodies of the first.
    let watt = [[0, 1], [1, 2], [2, 3], [0, 3], [2, 4], [3, 5], [4, 5]];
    assert_eq!(of(5, &watt), Some(vec![0, 0, 1, 1, 2, 2]));
    // The same with the numbers of the dyads exchanged.
    let turned = [[0, 1], [1, 4], [4, 5], [0, 5], [4, 2], [5, 3], [2, 3]];
    assert_eq!(of(5, &turned), Some(vec![0, 0, 2, 2, 1, 1]));
    // Two dyads on the crank, neither on the other: in the order of their bodies.
    let beside = [[0, 1], [1, 2], [2, 3], [0, 3], [1, 4], [4, 5], [0, 5]];
    assert_eq!(of(5, &beside), Some(vec![0, 0, 1, 1, 2, 2]));
    // Stephenson's third: a triad.
    let stephenson = [[0, 1], [1, 2], [2, 3], [3, 4], [3, 5], [0, 4], [0, 5]];
    assert_eq!(of(5, &stephenson), Some(vec![0, 0, 1, 1, 1, 1]));
    // The double butterfly: six bodies of one group.
    #[rustfmt::skip]
    let butterfly = [
        [0, 1], [0, 4], [1, 2], [1, 5], [2, 3], [3, 4], [3, 6], [5, 6], [5, 7], [4, 7],
    ];
    assert_eq!(of(7, &butterfly), Some(vec![0, 0, 1, 1, 1, 1, 1, 1]));
}

#[test]
fn what_no_pins_determine_has_no_groups() {
    // Body 2 turns about one pin, body 3 about another.
    assert_eq!(of(3, &[[0, 1], [0, 1], [1, 2], [2, 3]]), None);
}

/// By their definitions in components.
#[test]
fn products_of_vectors() {
    let (a, b) = (C::new(2.0, 3.0), C::new(5.0, 7.0));
    assert_eq!(dot(a, b), 31.0);
    assert_eq!((cross(a, b), cross(b, a)), (-1.0, 1.0));
}

/// A crank of length 2 at 0.5 rad and a second body on its end and, by a rod, on the ground.
fn crank() -> Flow {
    let linkage = super::super::drawn::Linkage {
        phi: 0.5,
        a: vec![0.0, 1.0, 2.0, 0.0],
        b: vec![1.0, 2.0, 3.0, 3.0],
        xa: vec![0.0, 2.0, 3.0, 4.0],
        ya: vec![0.0; 4],
        xb: vec![0.0, 0.0, 2.0, 0.0],
        yb: vec![0.0; 4],
        xs: vec![1.0, 1.5, 1.0],
        ys: vec![0.5, 0.0, 0.0],
        near: vec![0.5, 0.0, 1.5],
    };
    Flow::new(&linkage.input(), &[0.5, 0.25, 1.5]).unwrap()
}

/// With its body and in it at once: `O + e^{iθ} z` and its derivatives by the drive, by
/// differences.
#[test]
fn a_point_changes_with_its_body_and_in_it() {
    let flow = crank();
    let (spot, by) = (flow.centre(1), C::new(0.25, -0.5));
    let mut d = Motion::still(flow.bodies);
    d.origin[2] = [C::new(0.5, 2.0), C::new(-1.0, 0.25), C::new(0.125, 3.0)];
    d.turn[2] = [0.75, -0.5, 0.375];
    let at = |h: f64| -> Path {
        let [turn, first, second] = [0, 1, 2].map(|k| flow.motion.turn[2][k] + h * d.turn[2][k]);
        let [o, o1, o2] = [0, 1, 2].map(|k| flow.motion.origin[2][k] + d.origin[2][k] * h);
        let arm = C::from_polar(1.0, turn) * (spot.at + by * h);
        [
            o + arm,
            o1 + I * first * arm,
            o2 + (I * second - first * first) * arm,
        ]
    };
    let h = 1e-6;
    let found = flow.change(spot, by, &d);
    for (k, (more, less)) in at(h).into_iter().zip(at(-h)).enumerate() {
        let due = (more - less) / (2.0 * h);
        assert!(
            (found[k] - due).norm() < 1e-8,
            "{k}: {}, due {due}",
            found[k]
        );
    }
}

/// A point of the crank turns about the origin, with r' = i r and r'' = −r.
#[test]
fn a_point_of_the_crank_turns_with_it() {
    let flow = crank();
    let [r, first, second] = flow.path(flow.centre(0));
    let due = C::new(1.0, 0.5) * C::from_polar(1.0, 0.5);
    assert!((r - due).norm() < 1e-15);
    assert!((first - I * due).norm() < 1e-14 && (second + due).norm() < 1e-14);
    // The drive is turned: the point moves by r' for a radian, r' by r'', and r'' by −r'.
    let data = flow.data();
    let drive = data.iter().find(|d| matches!(d.of, Change::Drive)).unwrap();
    assert_eq!(drive.size, 0.5);
    let change = flow.change(flow.centre(0), C::default(), &flow.moved(drive));
    for (got, due) in change.into_iter().zip([I * due, -due, -I * due]) {
        assert!((got - due).norm() < 1e-13, "{got} {due}");
    }
}
