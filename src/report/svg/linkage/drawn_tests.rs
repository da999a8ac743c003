//! Drawings of linkages of each structure.

use super::super::panel::tests::{attributes, texts};
use super::*;
use crate::machine::{Linkage, Source, class_iii as grade_iii, planar as bodies};
use crate::solvers::dyad::Assembly;
use rug::Rational;

fn read(text: &str) -> Linkage {
    Linkage::read(&Source::toml(text.to_string())).unwrap()
}

/// Where each of these labels stands.
fn labels<const N: usize>(svg: &str, names: [&str; N]) -> [(f64, f64); N] {
    let (x, y) = (attributes(svg, "text", "x"), attributes(svg, "text", "y"));
    let texts = texts(svg);
    names.map(|name| {
        let k = texts.iter().position(|t| *t == name);
        let k = k.unwrap_or_else(|| panic!("{name} is missing in {texts:?}"));
        (x[k].parse().unwrap(), y[k].parse().unwrap())
    })
}

fn circles(svg: &str) -> Vec<(f64, f64)> {
    let (x, y) = (
        attributes(svg, "circle", "cx"),
        attributes(svg, "circle", "cy"),
    );
    let number = |s: &str| s.parse::<f64>().unwrap();
    x.into_iter()
        .zip(y)
        .map(|(x, y)| (number(x), number(y)))
        .collect()
}

/// The first three circles are the pivots and the crank's end; the ground of a link that hangs is
/// above its pivot.
#[test]
fn a_four_bar_has_two_pivots() {
    let Linkage::Dyad(four_bar) = read(include_str!("../../../../examples/four-bar.toml")) else {
        panic!("a four-bar");
    };
    for (assembly, above) in [(Assembly::Positive, false), (Assembly::Negative, true)] {
        let svg = dyad(&four_bar, assembly);
        let [o1, o3, a, _] = circles(&svg)[..] else {
            panic!("{svg}");
        };
        // A frame of 35 cm, a crank of 10 along it.
        assert!((o1.1 - o3.1).abs() < 0.11 && (a.1 - o1.1).abs() < 0.11);
        let share = (a.0 - o1.0) / (o3.0 - o1.0);
        assert!((share - 10.0 / 35.0).abs() < 1e-3, "{share}");
        let [first, third] = labels(&svg, ["O1", "O3"]);
        assert!(first.1 > o1.1, "{svg}");
        assert_eq!(third.1 < o3.1, above, "{svg}");
        labels(&svg, ["crank-rocker", "1", "2", "3", "A", "B"]);
        assert!(!svg.contains("stroke-dasharray=\"12 4 2 4\"") && svg.contains("every 45° faint"));
    }
}

#[test]
fn a_slider_crank_has_a_pivot_and_a_guide() {
    let text = include_str!("../../../../examples/slider-crank.toml");
    let text = text.replace("direction = \"0 deg\"", "direction = \"30 deg\"");
    let Linkage::Dyad(slider_crank) = read(&text) else {
        panic!("a slider-crank");
    };
    let svg = dyad(&slider_crank, Assembly::Positive);
    // Pivot, crank's end, slider.
    assert_eq!(circles(&svg).len(), 3);
    assert!(svg.contains("stroke-dasharray=\"12 4 2 4\""), "{svg}");
    assert!(svg.contains("rotate(-30.000 "), "{svg}");
    let [o1, _, _] = labels(&svg, ["O1", "1", "2"]);
    assert!(o1.1 > circles(&svg)[0].1 && !texts(&svg).contains(&"O3"));
}

/// The ground of each pivot is above it exactly where the joint at the other end of its link stays
/// below.
#[test]
fn links_of_class_iii_hang_from_their_own_pivots() {
    let text = include_str!("../../../../examples/sand-screen.toml");
    let Linkage::ClassIii(linkage) = read(text) else {
        panic!("of class III");
    };
    let start = Rational::from((14_426, 1000));
    let branch = grade_iii::choose(&linkage.solver, &start, None, &linkage.start).unwrap();
    let path = grade_iii::path(&linkage, &branch, SAMPLES).unwrap();
    let svg = class_iii(&linkage, &branch, &path);
    let g = linkage.solver.geometry();
    let pivots = [("O1", 0.0, 0), ("O3", g.y3.m(), 2), ("O5", g.y5.m(), 3)];
    for (k, (name, y, joint)) in pivots.into_iter().enumerate() {
        let hangs = path.iter().all(|s| s.joints()[joint][1] < y);
        let [label] = labels(&svg, [name]);
        assert_eq!(label.1 < circles(&svg)[k].1, hangs, "{name}");
    }
    labels(&svg, ["1", "2", "3", "4", "5", "A", "B", "C", "D"]);
    assert!(svg.contains("; paths of A (dashed), B, C, D<"), "{svg}");
}

#[test]
fn a_mechanism_of_bodies_has_its_drive_in_its_own_unit() {
    let text = include_str!("../../../../examples/cylinder-boom.toml");
    let Linkage::Planar(boom) = read(text) else {
        panic!("of bodies");
    };
    let branch = bodies::choose(&boom, boom.start.at.unwrap(), None).unwrap();
    let svg = planar(&boom, &branch);
    // From 0.9 m to 1.4 m, the middle first.
    assert!(
        svg.contains("drive at 1.150 m, from 0.90 m to 1.40 m faint"),
        "{svg}"
    );
    for (name, _) in boom.points.iter().chain(&boom.outlines[0]) {
        labels(&svg, [name.as_str()]);
    }
    // Two pivots on hatched ground.
    assert_eq!(
        svg.matches("<g stroke=\"#1d2125\" stroke-width=\"1.6\">")
            .count(),
        2
    );
    let text = include_str!("../../../../examples/jansen-leg.toml");
    let Linkage::Planar(leg) = read(text) else {
        panic!("of bodies");
    };
    let degrees = leg.start.at.unwrap_or(0.0);
    let branch = bodies::choose(&leg, degrees.to_radians(), None).unwrap();
    let svg = planar(&leg, &branch);
    let start = format!("drive at {degrees:.3}°, every eighth of a turn faint");
    assert!(svg.contains(&start), "{start} is missing in {svg}");
}
