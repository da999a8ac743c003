use super::*;
use crate::gallery::Gallery;
use mechaudit::proof::Open;
use mechaudit::proof::lower::{Apart, OfRegion};

/// Made up: a rectangle of a formula, and one on which one term dominates.
fn found() -> Lower {
    let at = Rectangle {
        a: [0.5, 1.0],
        b: [2.0, 3.0],
    };
    let leaf = |region: Region, norm: f64| Leaf { at, region, norm };
    let region = |name: &'static str, boxes: usize, norm: f64, at: Option<Rectangle>| OfRegion {
        name,
        boxes,
        norm,
        at,
    };
    let found = Bounds {
        norm: 2.25,
        regions: vec![
            region("strip", 3, 2.25, Some(at)),
            region("around the zeros", 0, 1.5, None),
        ],
        of_exponential: 7,
        apart: Apart {
            boxes: 11,
            zeros: 12,
            lines: 13,
        },
        open: Vec::new(),
        leaves: vec![leaf(Region::Strip, 2.25), leaf(Region::Dominated, 0.0)],
    };
    Lower {
        found,
        within: None,
        seconds: 1.25,
    }
}

/// In words, for programs and as rows, with all that is not proved; where a rectangle is open
/// nothing is claimed, and the first five are named.
#[test]
fn theorems() {
    let mut all = Gallery::default();
    let mut out = Vec::new();
    super::super::write_boxes(&[found()], &mut out).unwrap();
    all.add("boxes", String::from_utf8(out).unwrap());
    all.add("text", found().text());
    let part = Lower {
        within: Some(8.0),
        ..found()
    };
    all.add("within 8", part.text().lines().nth(1).unwrap());
    all.add_json("document", part.document());
    let mut found = found();
    let open = (0..6).map(|k| Open {
        at: Rectangle {
            a: [f64::from(k), 9.0],
            b: [0.5, 1.0],
        },
        why: "several formulas",
    });
    found.found.open = open.collect();
    assert!(!found.text().contains("K = ") && found.document()["proved"] == false);
    all.add("open", found.text());
    all.pin("theorems-below");
}
