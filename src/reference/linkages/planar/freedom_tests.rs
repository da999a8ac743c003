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

/// Cranks AD, BE, CF from the ground to a coupler DEF.
const CRANKS: [&str; 5] = ["ABC", "AD", "BE", "CF", "DEF"];

fn parallel(point: char) -> [i32; 2] {
    match point {
        'A' => [0, 0],
        'B' => [2, 0],
        'C' => [5, 1],
        'D' => [1, 3],
        'E' => [3, 3],
        _ => [6, 4],
    }
}

#[test]
fn a_third_crank_is_redundant_where_it_is_parallel() {
    let f = freedom(&CRANKS, parallel);
    assert_eq!((f.velocities, f.equations, f.rank), (12, 12, 11));
    assert_eq!((f.redundant(), f.infinitesimal()), (1, 1));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    assert_eq!(f.movable, [0, 1, 2, 3]);
    // Forces along three parallel cranks that hold the coupler.
    assert_eq!(f.strained, [0, 1, 2, 3]);
    // Any other third crank locks it.
    let other = |p| if p == 'C' { [5, 0] } else { parallel(p) };
    let f = freedom(&CRANKS, other);
    assert_eq!((f.rank, f.mobility), (12, Mobility::Locked));
    assert!(f.movable.is_empty() && f.strained.is_empty());
}

/// Parallel cranks of other lengths have the velocity, and no proof of a motion: there is none.
#[test]
fn a_velocity_is_not_a_motion() {
    let unequal = |p| if p == 'C' { [4, -2] } else { parallel(p) };
    let f = freedom(&CRANKS, unequal);
    assert_eq!(f.infinitesimal(), 1);
    assert_eq!(f.mobility, Mobility::Undecided { most: 1 });
}

#[test]
fn a_triangle_is_locked_and_a_second_bar_in_it_redundant() {
    let at = |p| match p {
        'A' => [0, 0],
        'B' => [4, 0],
        _ => [1, 3],
    };
    let f = freedom(&["AB", "AC", "BC"], at);
    assert_eq!((f.velocities, f.equations, f.rank), (6, 6, 6));
    assert_eq!((f.redundant(), f.mobility), (0, Mobility::Locked));
    // D of the bar AC, held by a bar from B as well.
    let at = |p| if p == 'D' { [2, 6] } else { at(p) };
    let f = freedom(&["AB", "ACD", "BC", "BD"], at);
    assert_eq!((f.redundant(), f.mobility), (1, Mobility::Locked));
    assert_eq!(f.strained, [0, 1, 2]);
}

#[test]
fn chains_have_as_many_freedoms_as_they_are_long() {
    let at = |p| match p {
        'A' => [0, 0],
        'B' => [9, 0],
        'C' => [1, 3],
        'D' => [4, 5],
        'E' => [8, 4],
        _ => [10, 7],
    };
    let f = freedom(&["AB", "AC", "CD", "DE", "EB"], at);
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 2 });
    assert_eq!((f.redundant(), f.movable), (0, vec![0, 1, 2, 3]));
    let f = freedom(&["AB", "AC", "CD", "DB", "BF"], at);
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 2 });
    // A bar beside a triangle: one moves, the others do not.
    let f = freedom(&["AB", "AC", "CB", "BF"], at);
    assert_eq!(f.mobility, Mobility::Regular { freedoms: 1 });
    assert_eq!(f.movable, [2]);
}

/// All bars of a parallelogram on one line: two velocities, one redundant equation.
#[test]
fn a_change_point_is_not_regular() {
    let at = |p| match p {
        'A' => [0, 0],
        'B' => [3, 0],
        'C' => [1, 0],
        _ => [4, 0],
    };
    let f = freedom(&["AB", "AC", "BD", "CD"], at);
    assert_eq!((f.redundant(), f.infinitesimal()), (1, 2));
    assert!(!matches!(f.mobility, Mobility::Regular { .. }));
}

/// A cross of two bars on one line between fixed pins: a velocity, and rigid.
#[test]
fn two_bars_on_a_line_are_not_proved_to_move() {
    let at = |p| [i32::from(p == 'C') * 2 + i32::from(p == 'B') * 5, 0];
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
    let at = |p| match p {
        'A' => [8, 1],
        'B' => [10, 1],
        'C' => [13, 2],
        'D' => [7, -2],
        'E' => [9, -2],
        _ => [12, -1],
    };
    const BODIES: [&str; 5] = ["DEF", "ABC", "AD", "BE", "CF"];
    let f = freedom(&BODIES, at);
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    assert_eq!(
        (f.movable, f.strained),
        (vec![0, 1, 2, 3], vec![0, 1, 2, 3])
    );
    // A third crank twice as long.
    let unequal = |p| if p == 'F' { [11, -4] } else { at(p) };
    let f = freedom(&BODIES, unequal);
    assert_eq!(f.redundant(), 1);
    assert_eq!(f.mobility, Mobility::Undecided { most: 1 });
}

/// A bar that turns about the origin has no velocity there. Beside it a triangle with a second bar,
/// held too often.
#[test]
fn a_bar_about_the_origin_turns() {
    let at = |p| match p {
        'A' => [1, 0],
        'B' => [5, 0],
        'C' => [2, 3],
        'D' => [3, 6],
        _ => [0, 0],
    };
    let f = freedom(&["ABZ", "Z", "ACD", "BC", "BD"], at);
    assert_eq!((f.movable, f.strained), (vec![0], vec![1, 2, 3]));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
    let f = freedom(&["ABZ", "ACD", "Z", "BC", "BD"], at);
    assert_eq!((f.movable, f.strained), (vec![1], vec![0, 2, 3]));
    assert_eq!(f.mobility, Mobility::Turning { most: 1 });
}

/// Three parallel cranks turn, whatever two bars on a line beside them do.
#[test]
fn one_motion_is_enough() {
    let at = |p| match p {
        'G' => [20, 0],
        'I' => [22, 0],
        'H' => [25, 0],
        _ => parallel(p),
    };
    let f = freedom(&["ABCGH", "AD", "BE", "CF", "DEF", "GI", "IH"], at);
    assert_eq!(
        (f.redundant(), f.mobility),
        (2, Mobility::Turning { most: 2 })
    );
    // Beside a body that hangs on nothing, the first of the list.
    let f = freedom(&["ABC", "", "AD", "BE", "CF", "DEF"], parallel);
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
        let at = |p| {
            let [x, y] = match p {
                'A' => [-3, 1],
                'B' => [-1, 5],
                'C' => [1, 2],
                'D' => [4, 2],
                'E' => [6, 2],
                'F' => [8, 1],
                _ => [9, 7],
            };
            if turned { [-y, x] } else { [x, y] }
        };
        let f = freedom(&bodies, at);
        assert_eq!((f.velocities, f.equations, f.rank), (21, 14, 13));
        assert_eq!(f.strained, [2, 3, 4]);
    }
}
