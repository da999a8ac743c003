use super::*;

#[test]
fn the_first_partition_covers_the_quadrant() {
    assert_eq!(hole(&roots()), None);
}

#[test]
fn a_hole_is_found() {
    let all = roots();
    for missing in [0, 1, 2, 3, 700, all.len() - 1] {
        let some: Vec<Rectangle> = (0..all.len())
            .filter(|i| *i != missing)
            .map(|i| all[i])
            .collect();
        let found = hole(&some).expect("a hole");
        let r = all[missing];
        assert!(r.a[0] <= found[0] && found[0] <= r.a[1], "{missing}");
        assert!(r.b[0] <= found[1] && found[1] <= r.b[1], "{missing}");
    }
    // One number is enough.
    let mut all = roots();
    all[5].b[1] = all[5].b[1].next_down();
    assert!(hole(&all).is_some());
}

#[test]
fn halves_cover_the_whole() {
    let whole = Rectangle {
        a: [1.0, 4.0],
        b: [0.0, 0.5],
    };
    for across_re in [true, false] {
        let [p, q] = whole.halves(across_re);
        let (side, first, second) = match across_re {
            true => (whole.a, p.a, q.a),
            false => (whole.b, p.b, q.b),
        };
        assert_eq!((first[0], second[1]), (side[0], side[1]));
        assert_eq!(first[1].next_up(), second[0]);
    }
}

#[test]
fn pieces_are_constant_and_adjacent() {
    let found = pieces([0.0, 10.0], |x| x.floor() as i64);
    assert_eq!(found.len(), 11);
    for pair in found.windows(2) {
        assert_eq!(pair[0].0[1].next_up(), pair[1].0[0]);
    }
}
