//! Ranks where a count is enough, and where it is not.

use super::{Drawing, DrawnPin, Frame, Freedom, MechanismError, Mobility};
use crate::class_iii::tests::q;

/// Bodies by the letters of their points, the ground first; a letter on several bodies is pins.
fn freedom(bodies: &[&str], at: impl Fn(char) -> [i32; 2]) -> Freedom {
    let frame = |k: usize| match k {
        0 => Frame::Ground,
        k => Frame::Body(k - 1),
    };
    let mut pins = Vec::new();
    for point in 'A'..='Z' {
        let mut on = (0..bodies.len()).filter(|&k| bodies[k].contains(point));
        let Some(first) = on.next() else { continue };
        pins.extend(on.map(|k| DrawnPin {
            frames: [frame(first), frame(k)],
            at: at(point).map(Into::into),
        }));
    }
    Drawing::new(bodies.len() - 1, pins).unwrap().freedom()
}

/// The places of points from A on.
fn places<const N: usize>(all: [[i32; 2]; N]) -> impl Fn(char) -> [i32; 2] {
    move |point| all[point as usize - 'A' as usize]
}

/// Cranks AD, BE, CF from the ground to a coupler DEF.
const CRANKS: [&str; 5] = ["ABC", "AD", "BE", "CF", "DEF"];
const PARALLEL: [[i32; 2]; 6] = [[0, 0], [2, 0], [5, 1], [1, 3], [3, 3], [6, 4]];

/// Parallel cranks, but for the place of C.
fn other([x, y]: [i32; 2]) -> impl Fn(char) -> [i32; 2] {
    let mut all = PARALLEL;
    all[2] = [x, y];
    places(all)
}

#[test]
fn a_third_crank_is_redundant_where_it_is_parallel() {
    let f = freedom(&CRANKS, places(PARALLEL));
    assert_eq!((f.velocities, f.equations, f.rank), (12, 12, 11));
    assert_eq!((f.redundant(), f.infinitesimal()), (1, 1));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    assert_eq!(f.movable, [0, 1, 2, 3]);
    // Forces along three parallel cranks that hold the coupler.
    assert_eq!(f.strained, [0, 1, 2, 3]);
    // Any other third crank locks it.
    let f = freedom(&CRANKS, other([5, 0]));
    assert_eq!((f.rank, f.mobility), (12, Mobility::Locked));
    assert!(f.movable.is_empty() && f.strained.is_empty());
}

/// Parallel cranks of other lengths have the velocity, and no proof of a motion: there is none.
#[test]
fn a_velocity_is_not_a_motion() {
    let f = freedom(&CRANKS, other([4, -2]));
    assert_eq!(f.infinitesimal(), 1);
    assert_eq!(f.mobility, Mobility::Undecided { most: 1 });
}

#[test]
fn a_triangle_is_locked_and_a_second_bar_in_it_redundant() {
    let at = || places([[0, 0], [4, 0], [1, 3], [2, 6]]);
    let f = freedom(&["AB", "AC", "BC"], at());
    assert_eq!((f.velocities, f.equations, f.rank), (6, 6, 6));
    assert_eq!((f.redundant(), f.mobility), (0, Mobility::Locked));
    // D of the bar AC, held by a bar from B as well.
    let f = freedom(&["AB", "ACD", "BC", "BD"], at());
    assert_eq!((f.redundant(), f.mobility), (1, Mobility::Locked));
    assert_eq!(f.strained, [0, 1, 2]);
}

#[test]
fn chains_have_as_many_freedoms_as_they_are_long() {
    let at = || places([[0, 0], [9, 0], [1, 3], [4, 5], [8, 4], [10, 7]]);
    let f = freedom(&["AB", "AC", "CD", "DE", "EB"], at());
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 2 });
    assert_eq!((f.redundant(), f.movable), (0, vec![0, 1, 2, 3]));
    let f = freedom(&["AB", "AC", "CD", "DB", "BF"], at());
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 2 });
    // A bar beside a triangle: one moves, the others do not.
    let f = freedom(&["AB", "AC", "CB", "BF"], at());
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 1 });
    assert_eq!(f.movable, [2]);
}

/// All bars of a parallelogram on one line: two velocities, one redundant equation.
#[test]
fn a_change_point_is_not_regular() {
    let at = places([[0, 0], [3, 0], [1, 0], [4, 0]]);
    let f = freedom(&["AB", "AC", "BD", "CD"], at);
    assert_eq!((f.redundant(), f.infinitesimal()), (1, 2));
    assert!(!matches!(f.mobility, Mobility::Regular { .. }));
}

/// A cross of two bars on one line between fixed pins: a velocity, and rigid.
#[test]
fn two_bars_on_a_line_are_not_proved_to_move() {
    let at = places([[0, 0], [5, 0], [2, 0]]);
    let f = freedom(&["AB", "AC", "CB"], at);
    assert_eq!((f.redundant(), f.infinitesimal()), (1, 1));
    assert_eq!(f.mobility, Mobility::Undecided { most: 1 });
}

#[test]
fn bad_pins_are_refused() {
    let pin = |a, b| DrawnPin {
        frames: [a, b],
        at: [q("0"), q("0")],
    };
    let pins = vec![pin(Frame::Ground, Frame::Body(1))];
    let e = Drawing::new(1, pins).unwrap_err();
    assert_eq!(e, MechanismError::Missing { joint: 0 });
    let pins = vec![pin(Frame::Body(0), Frame::Body(0))];
    let e = Drawing::new(1, pins).unwrap_err();
    assert_eq!(e, MechanismError::Itself { joint: 0 });
}

/// Coupler ABC on cranks AD, BE, CF, off the origin, the coupler listed first: none of the first
/// three pins is on the ground.
#[test]
fn the_order_of_bodies_and_the_origin_do_not_matter() {
    let at = |f| places([[8, 1], [10, 1], [13, 2], [7, -2], [9, -2], f]);
    const BODIES: [&str; 5] = ["DEF", "ABC", "AD", "BE", "CF"];
    let f = freedom(&BODIES, at([12, -1]));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    assert_eq!(
        (f.movable, f.strained),
        (vec![0, 1, 2, 3], vec![0, 1, 2, 3])
    );
    // A third crank twice as long.
    let f = freedom(&BODIES, at([11, -4]));
    assert_eq!(f.redundant(), 1);
    assert_eq!(f.mobility, Mobility::Undecided { most: 1 });
}

/// A bar that turns about the origin has no velocity there. Beside it a triangle with a second bar,
/// held too often.
#[test]
fn a_bar_about_the_origin_turns() {
    let at = || places([[1, 0], [5, 0], [2, 3], [3, 6], [0, 0]]);
    let f = freedom(&["ABE", "E", "ACD", "BC", "BD"], at());
    assert_eq!((f.movable, f.strained), (vec![0], vec![1, 2, 3]));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    let f = freedom(&["ABE", "ACD", "E", "BC", "BD"], at());
    assert_eq!((f.movable, f.strained), (vec![1], vec![0, 2, 3]));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
}

/// Three parallel cranks turn, whatever two bars on a line beside them do.
#[test]
fn one_motion_is_enough() {
    let beside = [[20, 0], [25, 0], [22, 0]];
    let at = |p| match "GHI".find(p) {
        Some(k) => beside[k],
        None => places(PARALLEL)(p),
    };
    let f = freedom(&["ABCGH", "AD", "BE", "CF", "DEF", "GI", "IH"], at);
    assert_eq!(
        (f.redundant(), f.mobility),
        (2, Mobility::Turning { most: 2 })
    );
    // Beside a body that hangs on nothing, the first of the list.
    let f = freedom(&["ABC", "", "AD", "BE", "CF", "DEF"], places(PARALLEL));
    assert_eq!(
        (f.redundant(), f.mobility),
        (1, Mobility::Turning { most: 4 })
    );
}

#[test]
fn a_body_without_pins_is_free() {
    let f = Drawing::new(1, Vec::new()).unwrap().freedom();
    assert_eq!((f.velocities, f.equations, f.rank), (3, 0, 0));
    assert_eq!((f.movable, f.strained), (vec![0], vec![]));
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 3 });
}

/// Three bars from end to end on a line, on no other body, hold one another along it; the chains
/// listed before and after them are not strained.
#[test]
fn bars_on_a_line_are_strained_and_their_neighbours_are_not() {
    let bodies = ["AF", "AB", "B", "CD", "DE", "CE", "FG", "G"];
    for turned in [false, true] {
        let all = [[-3, 1], [-1, 5], [1, 2], [4, 2], [6, 2], [8, 1], [9, 7]];
        let at = places(all.map(|[x, y]| if turned { [-y, x] } else { [x, y] }));
        let f = freedom(&bodies, at);
        assert_eq!((f.velocities, f.equations, f.rank), (21, 14, 13));
        assert_eq!(f.strained, [2, 3, 4]);
    }
}
