use super::*;
use mechaudit::proof::Open;
use mechaudit::proof::lower::{Apart, OfRegion};
use mechaudit::report::text::style::plain;

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

#[test]
fn every_rectangle_has_a_row() {
    let mut out = Vec::new();
    super::super::write_boxes(&[found()], &mut out).unwrap();
    let name = Region::Dominated.name();
    let due = format!(
        "re_from,re_to,im_from,im_to,formula,norm\n\
         0x1p-1,0x1p+0,-0x1.8p+1,-0x1p+1,strip,0x1.2p+1\n\
         0x1p-1,0x1p+0,-0x1.8p+1,-0x1p+1,{name},\n"
    );
    assert_eq!(String::from_utf8(out).unwrap(), due);
}

#[test]
fn what_is_proved_in_words() {
    let due = "\
faddeeva, open lower half-plane
  |faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for every finite f64 z with Im z < 0 where w does not overflow:
  K = 2.251
  formula           boxes   norm  attained in
  strip                 3  2.251  [5.0000e-1, 1.0000e0] − i [2.0000e0, 3.0000e0]
  around the zeros      0  1.501  –
  In units of 2^-52; –: by an inequality, without rectangles
  From |z| = 2^960 on another 6 · 2^-1075 in each component: underflow
";
    let text = plain(&found().text());
    let (head, rest) = text.split_at(due.len().min(text.len()));
    assert_eq!(head, due);
    assert_eq!(rest.lines().next(), Some(&*format!("  By hand: {BY_HAND}")));
    for what in NOT_PROVED {
        assert!(
            rest.contains(&format!("\n  Not proved: {what}\n")),
            "{rest}"
        );
    }
    let end = "  No zero is next to an f64: 11 boxes, 12 zeros, 13 lines\n  \
               3 boxes, and 7 of the exponential, 1.2 s\n";
    assert!(rest.ends_with(end), "{rest}");
    let part = plain(
        &Lower {
            within: Some(8.0),
            ..found()
        }
        .text(),
    );
    let said = "overflow, |Re z| and |Im z| in the binades below 8:\n";
    assert!(part.contains(said), "{part}");
}

/// Where a rectangle is open nothing is claimed, and the first five are named.
#[test]
fn open_rectangles_are_no_proof() {
    let mut found = found();
    let open = (0..6).map(|k| Open {
        at: Rectangle {
            a: [f64::from(k), 9.0],
            b: [0.5, 1.0],
        },
        why: "several formulas",
    });
    found.found.open = open.collect();
    let text = plain(&found.text());
    assert!(text.contains("  not proved: 6 rectangles are open\n"));
    assert!(!text.contains("K = "), "{text}");
    for k in 0..6 {
        let line =
            format!("  [{k}.0000e0, 9.0000e0] − i [5.0000e-1, 1.0000e0]: several formulas\n");
        assert_eq!(text.contains(&line), k < 5, "{text}");
    }
    let json = found.document();
    assert_eq!(json["proved"], false);
    assert_eq!(json["open"][5]["box"]["re"], json!([5.0, 9.0]));
}

#[test]
fn what_is_proved_for_programs() {
    let v = Lower {
        within: Some(8.0),
        ..found()
    }
    .document();
    let due = json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "function": "faddeeva",
        "part": "lower",
        "within": 8.0,
        "proved": true,
        "norm": 2.25,
        "boxes_of_exponential": 7,
        "zeros_apart": { "boxes": 11, "zeros": 12, "lines": 13 },
        "seconds": 1.25,
        "formulas": [
            {
                "formula": "strip",
                "boxes": 3,
                "norm": 2.25,
                "box": { "re": [0.5, 1.0], "minus_im": [2.0, 3.0] },
            },
            { "formula": "around the zeros", "boxes": 0, "norm": 1.5, "box": null },
        ],
        "open": [],
        "by_hand": BY_HAND,
        "not_proved": NOT_PROVED,
    });
    assert_eq!(v, due);
}
