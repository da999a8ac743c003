//! Tests of `motion`.

use super::*;

fn empty() -> Motion {
    Motion {
        name: String::new(),
        drive: Drive {
            symbol: "s",
            unit: "m",
            values: Vec::new(),
        },
        closed: false,
        start: 0,
        points: Vec::new(),
        links: Vec::new(),
        plates: Vec::new(),
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: Vec::new(),
    }
}

fn assert_near(found: [f64; 2], due: [f64; 2]) {
    let apart = (found[0] - due[0]).hypot(found[1] - due[1]);
    assert!(apart < 1e-12, "{found:?}, due {due:?}");
}

#[test]
fn points_stay_or_move_and_are_traced_if_they_have_a_name() {
    let (here, there) = ([1.0, 2.0], [3.0, 4.0]);
    let fixed = Point::fixed("O", here);
    let moving = Point::moving("A", vec![here, there]);
    for (k, due) in [(0, here), (1, there), (2, there), (9, there)] {
        assert_eq!((fixed.at(k), moving.at(k)), (here, due));
    }
    assert!(fixed.pivot && !moving.pivot);
    for (point, due) in [
        (fixed, false),
        (moving, true),
        (Point::moving("", vec![here, there]), false),
        (Point::moving("A", vec![here]), false),
    ] {
        assert_eq!(point.is_traced(), due, "{point:?}");
    }
}

/// Points at all positions, and wheels all round; what is not determined is left out.
#[test]
fn the_extent_holds_all_that_is_drawn() {
    let mut motion = empty();
    assert_eq!(motion.extent(), [[f64::INFINITY, f64::NEG_INFINITY]; 2]);
    let path = vec![[2.0, 1.0], [5.0, -1.0], [f64::NAN, f64::INFINITY]];
    assert_eq!(motion.add(Point::moving("A", path)), 0);
    assert_eq!(motion.extent(), [[2.0, 5.0], [-1.0, 1.0]]);
    assert_eq!(motion.size(), 3.0);
    let centre = motion.add(Point::moving("", vec![[3.0, 1.0], [3.5, 2.0]]));
    assert_eq!(centre, 1);
    let radius = 1.75;
    motion.wheels.push(Wheel { centre, radius });
    assert_eq!(motion.extent(), [[1.25, 5.25], [-1.0, 3.75]]);
    assert_eq!(motion.size(), 4.75);
    // Higher than wide, and wider than high.
    motion.wheels.clear();
    motion.add(Point::fixed("O", [0.0, 7.0]));
    assert_eq!(motion.size(), 8.0);
    motion.add(Point::fixed("P", [10.0, 7.0]));
    assert_eq!(motion.size(), 10.0);
}

/// As far as something slides, and a little farther on both sides; the place where it is first is
/// always on the guide.
#[test]
fn a_guide_reaches_as_far_as_what_slides_on_it() {
    for (path, degrees, ends) in [
        (
            vec![[1.0, 1.0], [1.0, 4.0], [1.0, 0.0]],
            90.0,
            [[1.0, -0.28], [1.0, 4.28]],
        ),
        // Along (0.8, 0.6) by 5 and 10 m, where the drawing is 8 m wide.
        (
            vec![[2.0, 3.0], [6.0, 6.0], [10.0, 9.0]],
            0.6_f64.atan2(0.8).to_degrees(),
            [[1.552, 2.664], [10.448, 9.336]],
        ),
        // Backwards only.
        (
            vec![[2.0, 3.0], [-2.0, 0.0]],
            0.6_f64.atan2(0.8).to_degrees(),
            [[-2.224, -0.168], [2.224, 3.168]],
        ),
    ] {
        let mut motion = empty();
        motion.add(Point::moving("slider", path.clone()));
        let along: Vec<([f64; 2], f64)> = path.iter().map(|p| (*p, degrees.to_radians())).collect();
        motion.add_guide(&along);
        assert_eq!(motion.guides, [[1, 2]]);
        for (point, due) in motion.points[1..].iter().zip(ends) {
            assert!(point.label.is_empty() && !point.pivot && point.path.len() == 1);
            assert_near(point.path[0], due);
        }
    }
    let mut motion = empty();
    motion.add_guide(&[]);
    assert!(motion.guides.is_empty() && motion.points.is_empty());
}

/// 7 % of the drawing long and 4 % high, about the place where it is, turned with the guide.
#[test]
fn a_block_lies_along_its_guide() {
    let mut motion = empty();
    motion.add(Point::moving("slider", vec![[0.0, 0.0], [100.0, 40.0]]));
    let angle = 0.6_f64.atan2(0.8);
    motion.add_block(&[([0.0, 0.0], 0.0), ([100.0, 40.0], angle)]);
    assert_eq!(motion.plates, [[1, 2, 3, 4]]);
    for (point, [a, b]) in
        motion.points[1..]
            .iter()
            .zip([[-3.5, -2.0], [3.5, -2.0], [3.5, 2.0], [-3.5, 2.0]])
    {
        assert!(!point.is_traced() && !point.pivot);
        assert_near(point.path[0], [a, b]);
        let turned = [100.0 + 0.8 * a - 0.6 * b, 40.0 + 0.6 * a + 0.8 * b];
        assert_near(point.path[1], turned);
    }
}

/// Counter-clockwise from the leftmost corner, of these the lowest; no corner lies between two
/// others.
#[test]
fn hulls_have_no_inner_points() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    for (corners, due) in [
        (vec![], vec![]),
        (vec![[1.0, 1.0]], vec![]),
        (vec![[1.0, 1.0], [0.0, 3.0]], vec![1, 0]),
        (vec![[1.0, 3.0], [1.0, 0.0]], vec![1, 0]),
        (vec![[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]], vec![0, 2]),
        (vec![[4.0, 0.0], [0.0, 0.0], [1.0, 3.0]], vec![1, 0, 2]),
        (square.to_vec(), vec![0, 1, 2, 3]),
        (
            [
                &square[..],
                &[[1.0, 0.5], [1.0, 0.0], [2.0, 1.0], [0.0, 1.5]],
            ]
            .concat(),
            vec![0, 1, 2, 3],
        ),
        (
            vec![[0.0, 0.0], [3.0, 1.0], [4.0, 4.0], [1.0, 3.0], [2.0, 2.0]],
            vec![0, 1, 2, 3],
        ),
        // As far to the right: the upper one is a corner as well.
        (vec![[3.0, 5.0], [0.0, 2.0], [3.0, -1.0]], vec![1, 2, 0]),
    ] {
        assert_eq!(hull(&corners), due, "{corners:?}");
    }
}

/// Pivots where the geometry has them, joints at the ends of links that keep their lengths.
#[test]
fn a_linkage_of_class_iii_is_drawn_between_its_joints() {
    use crate::machine::{Linkage, Source, class_iii};
    let text = include_str!("../../examples/sand-screen.toml");
    let Linkage::ClassIii(linkage) = Linkage::read(&Source::toml(text)).unwrap() else {
        unreachable!("of class III");
    };
    let start = linkage.start_degrees().unwrap();
    let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start).unwrap();
    let states = class_iii::path(&linkage, &branch, 3).unwrap();
    let shown = super::class_iii(&linkage.solver, &states, vec![1.0, 2.0, 3.0, 4.0]);
    assert_eq!((shown.closed, shown.start), (true, 0));
    assert_eq!(shown.drive.values, [1.0, 2.0, 3.0, 4.0]);
    let labels: Vec<&str> = shown.points.iter().map(|p| &*p.label).collect();
    assert_eq!(labels, ["O1", "O3", "O5", "A", "B", "C", "D"]);
    for (point, due) in shown
        .points
        .iter()
        .zip([[0.0, 0.0], [0.75, 0.93], [1.285, 1.035]])
    {
        assert!(point.pivot);
        assert_near(point.at(0), due);
    }
    assert_eq!(shown.plates.len(), 1);
    let named: Vec<&str> = shown.plates[0].iter().map(|k| labels[*k]).collect();
    assert_eq!(named, ["B", "C", "D"]);
    for k in 0..4 {
        let apart = |[a, b]: [usize; 2]| {
            let (p, q) = (shown.points[a].at(k), shown.points[b].at(k));
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        for (link, due) in shown.links.iter().zip([0.1, 1.04, 0.6, 0.485]) {
            assert!((apart(*link) - due).abs() < 1e-12);
        }
    }
}
