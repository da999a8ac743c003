//! Tests of `dxf`.

use super::*;
use crate::motion::{Drive, Wheel};
use dxf::entities::{Entity, EntityType};
use dxf::enums::{AcadVersion, Units};
use dxf::{Drawing, Point as Place};

#[test]
fn units_are_those_that_the_format_knows() {
    for (name, metres, units) in [
        ("m", 1.0, Units::Meters),
        ("dm", 0.1, Units::Decimeters),
        ("cm", 0.01, Units::Centimeters),
        ("mm", 1e-3, Units::Millimeters),
        ("um", 1e-6, Units::Microns),
        ("µm", 1e-6, Units::Microns),
        ("in", 0.0254, Units::Inches),
        ("inch", 0.0254, Units::Inches),
        ("ft", 0.3048, Units::Feet),
    ] {
        let unit = Unit::of(name).unwrap();
        assert_eq!(
            (&*unit.name, unit.metres, unit.number),
            (name, metres, units as u32)
        );
    }
    // Gram and second have sizes that lengths have too.
    for name in [
        "kg", "g", "s", "ms", "rad", "m^2", "m/s", "kN", "furlong", "",
    ] {
        let unit = name.to_string();
        assert_eq!(Unit::of(name).err(), Some(NotDxf::Unit { unit }), "{name}");
    }
}

/// A crank of two metres with a named spot beside it.
fn moving() -> Motion {
    Motion {
        name: "a crank".into(),
        drive: Drive {
            symbol: "φ1",
            unit: "°",
            values: vec![0.0, 90.0],
        },
        closed: false,
        start: 1,
        points: vec![
            Point::fixed("O", [0.5, 0.0]),
            Point::moving("A", vec![[2.5, 0.0], [0.5, 2.0]]),
            Point::moving("", vec![[1.0, 0.0], [1.0, 1.0]]),
            Point::fixed("", [-1.5, 0.25]),
        ],
        links: vec![[0, 1]],
        plates: vec![vec![0, 1, 2]],
        guides: vec![[3, 0]],
        wheels: vec![Wheel {
            centre: 0,
            radius: 0.25,
        }],
        courses: Vec::new(),
    }
}

fn read(motion: &Motion, unit: &str) -> Drawing {
    let bytes = draw(motion, &Unit::of(unit).unwrap()).unwrap();
    Drawing::load(&mut &bytes[..]).unwrap()
}

/// Layer, and a word with numbers to a millionth.
fn marks(drawing: &Drawing) -> Vec<(String, String)> {
    let six = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
    let place = |p: &Place| format!("{},{}", six(p.x), six(p.y));
    let mark = |e: &Entity| {
        let text = match &e.specific {
            EntityType::Line(l) => format!("line {} {}", place(&l.p1), place(&l.p2)),
            EntityType::Circle(c) => format!("circle {} {}", place(&c.center), six(c.radius)),
            EntityType::Text(t) => {
                let (at, height) = (place(&t.location), six(t.text_height));
                format!("text {} {at} {height}", t.value)
            }
            EntityType::LwPolyline(l) => {
                let vertices = l.vertices.iter();
                let all = vertices.map(|v| format!(" {},{}", six(v.x), six(v.y)));
                let word = if l.is_closed() { "closed" } else { "open" };
                format!("{word}{}", all.collect::<String>())
            }
            other => panic!("{other:?}"),
        };
        (e.common.layer.clone(), text)
    };
    drawing.entities().map(mark).collect()
}

/// At the position shown first; letters and rings by the size of the whole, which is four metres.
#[test]
fn every_part_is_on_its_layer() {
    let drawing = read(&moving(), "m");
    assert_eq!(drawing.header.version, AcadVersion::R2007);
    assert_eq!(drawing.header.default_drawing_units, Units::Meters);
    let own = |all: &[(&str, &str)]| -> Vec<(String, String)> {
        all.iter()
            .map(|(a, b)| (a.to_string(), b.to_string()))
            .collect()
    };
    let due = own(&[
        ("LINKS", "line 0.5,0 0.5,2"),
        ("GUIDES", "line -1.5,0.25 0.5,0"),
        ("LINKS", "closed 0.5,0 0.5,2 1,1"),
        ("LINKS", "circle 0.5,0 0.25"),
        ("GROUND", "circle 0.5,0 0.032"),
        ("NAMES", "text O 0.548,0.048 0.1"),
        ("JOINTS", "circle 0.5,2 0.032"),
        ("NAMES", "text A 0.548,2.048 0.1"),
        ("PATH_A", "open 2.5,0 0.5,2"),
    ]);
    assert_eq!(marks(&drawing), due);
    let mut closed = moving();
    closed.closed = true;
    let last = marks(&read(&closed, "mm")).pop().unwrap();
    assert_eq!(last.1, "closed 2500,0 500,2000");
    let centimetres = marks(&read(&moving(), "cm"));
    assert_eq!(centimetres[3].1, "circle 50,0 25");
    assert_eq!(centimetres[5].1, "text O 54.8,4.8 10");
}

#[test]
fn layers_have_colours_and_the_sixth_path_that_of_the_first() {
    let mut motion = moving();
    for k in 0..5 {
        let path = vec![[0.0, 0.0], [0.1, 0.0]];
        motion.points.push(Point::moving(format!("B{k}"), path));
    }
    let drawing = read(&motion, "m");
    let colour = |name: &str| {
        let layer = drawing.layers().find(|l| l.name == name);
        layer
            .unwrap_or_else(|| panic!("{name}"))
            .color
            .index()
            .unwrap()
    };
    for (name, due) in COLOURS {
        assert_eq!(colour(name), due, "{name}");
    }
    let paths = ["A", "B0", "B1", "B2", "B3", "B4"].map(|p| colour(&format!("PATH_{p}")));
    assert_eq!(paths, [30, 5, 3, 6, 8, 30]);
}

#[test]
fn the_same_motion_is_the_same_file() {
    let bytes = || draw(&moving(), &Unit::of("m").unwrap()).unwrap();
    assert_eq!(bytes(), bytes());
}

/// Programs for CAD ask for all sections, and for handles of which each is there once.
#[test]
fn a_file_has_its_sections_and_each_handle_once() {
    let bytes = draw(&moving(), &Unit::of("m").unwrap()).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.split("\r\n").collect();
    let (pairs, rest) = lines.as_chunks::<2>();
    assert_eq!(rest, [""]);
    let values = |code: &str| -> Vec<&str> {
        let own = pairs.iter().filter(|p| p[0].trim() == code);
        own.map(|p| p[1]).collect()
    };
    let begun = pairs.windows(2).filter(|w| w[0][1] == "SECTION");
    let sections: Vec<&str> = begun.map(|w| w[1][1]).collect();
    assert_eq!(
        sections,
        ["HEADER", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS"]
    );
    assert_eq!(pairs.last().unwrap(), &["  0", "EOF"]);
    let number = |h: &&str| u32::from_str_radix(h, 16).unwrap();
    let mut handles: Vec<u32> = values("5").iter().map(number).collect();
    // The first one is the seed, beyond all that are taken.
    let seed = handles.remove(0);
    assert!(handles.iter().all(|h| *h < seed), "{seed} {handles:?}");
    for owner in values("330").iter().map(number).filter(|h| *h != 0) {
        assert!(handles.contains(&owner), "{owner:X}");
    }
    let all = handles.len();
    handles.sort_unstable();
    handles.dedup();
    assert_eq!(handles.len(), all);
}

/// Six digits of the size at least, and no coordinate beyond 1e15.
#[test]
fn what_would_lose_its_digits_is_refused() {
    let of = |size: f64, unit: &str| {
        let mut motion = moving();
        motion.points = vec![
            Point::fixed("O", [0.0, 0.0]),
            Point::fixed("P", [0.0, size]),
        ];
        motion.plates.clear();
        motion.links.clear();
        motion.guides.clear();
        motion.wheels.clear();
        draw(&motion, &Unit::of(unit).unwrap()).map(|_| ())
    };
    assert_eq!(of(1e-6, "m"), Ok(()));
    assert_eq!(of(0.9e-6, "mm"), Ok(()));
    assert_eq!(of(1e15, "m"), Ok(()));
    for (size, unit, in_unit) in [
        (0.9e-6, "m", 0.9e-6),
        (0.0, "m", 0.0),
        (1.1e15, "m", 1.1e15),
    ] {
        let unit = unit.to_string();
        assert_eq!(
            of(size, &unit),
            Err(NotDxf::Size {
                size: in_unit,
                unit
            })
        );
    }
    assert!(matches!(of(2e12, "mm"), Err(NotDxf::Size { .. })));
    assert!(matches!(of(-2e15, "m"), Err(NotDxf::Size { .. })));
    let mut motion = moving();
    for (k, bad) in [f64::NAN, f64::INFINITY].into_iter().enumerate() {
        motion.points[1].path[k][1 - k] = bad;
        let point = "A".to_string();
        let e = draw(&motion, &Unit::of("m").unwrap()).err();
        assert_eq!(e, Some(NotDxf::NotFinite { point }));
        motion = moving();
    }
}
