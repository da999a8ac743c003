use super::upper::{Upper, proved};
use super::*;
use mechaudit::proof::{Bound, Certificate, Formula, Leaf, Target, UPPER_HALF_PLANE};
use mechaudit::report::text::style::plain;

/// Made up: two rectangles of one formula, one of another without a bound of its imaginary part.
fn certificate() -> Certificate {
    let leaf = |a: [f64; 2], b: [f64; 2], formula: Formula, [norm, re, im]: [f64; 3]| Leaf {
        at: Rectangle { a, b },
        formula,
        bound: Bound {
            norm,
            re,
            im,
            tiny: 2.0,
        },
    };
    let cell = Formula::Cell {
        centre: (0.25, 0.5),
    };
    let four = Formula::Asymptotic { terms: 4 };
    Certificate {
        leaves: vec![
            leaf([0.0, 1.0], [2.0, 3.0], cell, [0.5, 1.5, 2.5]),
            leaf([1.0, 2.0], [2.0, 3.0], cell, [0.75, 1.0, 2.0]),
            leaf([8.0, 16.0], [0.0, 0.5], four, [0.25, 3.0, f64::INFINITY]),
        ],
        open: Vec::new(),
    }
}

fn theorem(found: &Certificate, within: Option<f64>) -> Upper {
    Upper::new(found.clone(), within, 1.25).unwrap()
}

fn shown(found: &Certificate, within: Option<f64>) -> String {
    plain(&theorem(found, within).text())
}

#[test]
fn every_rectangle_has_a_row() {
    let mut out = Vec::new();
    write_boxes(&[theorem(&certificate(), None)], &mut out).unwrap();
    let due = "re_from,re_to,im_from,im_to,formula,centre_re,centre_im,norm,re,im,tiny\n\
               0x0p+0,0x1p+0,0x1p+1,0x1.8p+1,Taylor cell,0x1p-2,0x1p-1,0x1p-1,0x1.8p+0,0x1.4p+1,0x1p+1\n\
               0x1p+0,0x1p+1,0x1p+1,0x1.8p+1,Taylor cell,0x1p-2,0x1p-1,0x1.8p-1,0x1p+0,0x1p+1,0x1p+1\n\
               0x1p+3,0x1p+4,0x0p+0,0x1p-1,asymptotic 4 terms,,,0x1p-2,0x1.8p+1,inf,0x1p+1\n";
    assert_eq!(String::from_utf8(out).unwrap(), due);
}

/// Bounds are rounded up.
#[test]
fn what_is_proved_in_words() {
    let found = certificate();
    let due = "\
faddeeva, closed upper half-plane
  |faddeeva(z) − w(z)| ≤ K · 2^-52 |w(z)| for every finite f64 z with Im z ≥ 0: K = 0.751
  no bound of the components
  K is attained in [1.0000e0, 2.0000e0] + i [2.0000e0, 3.0000e0]
  formula              boxes   norm     Re     Im
  Taylor, cell             2  0.751  1.501  2.501
  asymptotic, 4 terms      1  0.251  3.001      –
  Norm in units of 2^-52, components in units in the last place; –: not proved
  A component below 2^-960 in absolute value may be off by another 2.001 · 2^-1075: underflow
  3 boxes, 1.2 s
";
    assert_eq!(shown(&found, None), due);
    for (within, said) in [(8.0, "below 8: K"), (1e6, "below 1e6: K")] {
        let text = shown(&found, Some(within));
        let head = "z with Im z ≥ 0, |Re z| and Im z in the binades ";
        assert!(text.contains(&format!("{head}{said}")), "{text}");
    }
    let mut components = certificate();
    components.leaves.pop();
    let text = shown(&components, None);
    let due = "C = 2.501, attained in [0.0000e0, 1.0000e0] + i [2.0000e0, 3.0000e0]";
    assert!(text.contains(due), "{text}");
}

/// Where a rectangle is open nothing is claimed, and the first five are named.
#[test]
fn open_rectangles_are_no_proof() {
    let open = (0..6).map(|k| Open {
        at: Rectangle {
            a: [f64::from(k), 9.0],
            b: [0.0, 1.0],
        },
        why: "several formulas",
    });
    let found = Certificate {
        open: open.collect(),
        ..certificate()
    };
    let text = shown(&found, None);
    assert!(text.contains("  not proved: 6 rectangles are open\n"));
    assert!(!text.contains("K · 2^-52") && !text.contains("C = "));
    let named =
        |k: u32| format!("  [{k}.0000e0, 9.0000e0] + i [0.0000e0, 1.0000e0]: several formulas\n");
    for k in 0..6 {
        assert_eq!(text.contains(&named(k)), k < 5, "{text}");
    }
    let json = theorem(&found, None).document();
    assert_eq!(json["proved"], false);
    assert_eq!(json["open"][5]["box"]["re"], json!([5.0, 9.0]));
}

/// An end of a proof is heard at once, whatever becomes of it.
#[test]
fn a_proof_is_waited_for() {
    let ended = |found: Result<Option<u32>, ProofError>| {
        let found = watched("some", false, move |watch| {
            watch.of.store(3, Ordering::Relaxed);
            std::thread::sleep(2 * interrupt::POLL);
            found
        });
        found.map_err(|e| e.to_string())
    };
    for found in [Ok(Some(5)), Ok(None), Err("undecided".into())] {
        let due = found.clone().map_err(|e: ProofError| e.to_string());
        assert_eq!(ended(found), due);
    }
}

/// It ends by itself, which is no end by the user.
#[test]
fn a_proof_that_gives_up_says_so() {
    let looked_at = |parts: u64| {
        watched("some", true, move |watch| {
            watch.of.store(7, Ordering::Relaxed);
            watch.looked_at.store(parts, Ordering::Relaxed);
            Ok(None::<u32>)
        })
    };
    assert!(matches!(looked_at(MOST_PARTS), Ok(None)));
    let why = looked_at(MOST_PARTS + 1).unwrap_err().to_string();
    let due = "some: given up after 3e7 rectangles or intervals, with 0 of 7 parts done: take a larger target";
    assert_eq!(why, due);
    let watch = Watch::default();
    watch.looked_at.store(MOST_PARTS / 100, Ordering::Relaxed);
    let said = at_most("some", &watch, 2.0);
    assert!(
        said.ends_with("takes 3e7 rectangles or intervals at most, about 3 minutes"),
        "{said}"
    );
}

#[test]
fn a_proof_is_so_far() {
    let watch = Watch::default();
    assert_eq!(reached(&watch), None);
    watch.of.store(9, Ordering::Relaxed);
    assert_eq!(reached(&watch), Some((0, 9)));
    watch.done.store(4, Ordering::Relaxed);
    assert_eq!(reached(&watch), Some((4, 9)));
}

#[test]
fn what_is_proved_for_programs() {
    let found = certificate();
    let v = theorem(&found, Some(8.0)).document();
    let at = |from: f64, to: f64, im: [f64; 2]| json!({ "re": [from, to], "im": im });
    let cell = [2.0, 3.0];
    let due = json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "function": "faddeeva",
        "part": "upper",
        "within": 8.0,
        "proved": true,
        "norm": { "bound": 0.75, "box": at(1.0, 2.0, cell) },
        "component": null,
        "tiny": 2.0,
        "boxes": 3,
        "seconds": 1.25,
        "formulas": [
            {
                "formula": "Taylor, cell",
                "boxes": 2,
                "norm": { "bound": 0.75, "box": at(1.0, 2.0, cell) },
                "re": { "bound": 1.5, "box": at(0.0, 1.0, cell) },
                "im": { "bound": 2.5, "box": at(0.0, 1.0, cell) },
                "tiny": 2.0,
            },
            {
                "formula": "asymptotic, 4 terms",
                "boxes": 1,
                "norm": { "bound": 0.25, "box": at(8.0, 16.0, [0.0, 0.5]) },
                "re": { "bound": 3.0, "box": at(8.0, 16.0, [0.0, 0.5]) },
                "im": null,
                "tiny": 2.0,
            },
        ],
        "open": [],
    });
    assert_eq!(v["formulas"], due["formulas"]);
    for (key, value) in due.as_object().unwrap() {
        if key != "component" {
            assert_eq!(&v[key], value, "{key}");
        }
    }
}

/// Bounds are never rounded down, and what has three places is still raised.
#[test]
fn bounds_are_rounded_up() {
    for (x, due) in [
        (0.0, "0.001"),
        (0.9990001, "1.000"),
        (1.2341, "1.235"),
        (2.0, "2.001"),
        (12.3456, "12.346"),
    ] {
        assert_eq!(up(x), due);
    }
}

/// Below a million as it is, then with an exponent.
#[test]
fn a_part_of_the_plane_is_named() {
    let found = certificate();
    for (within, said) in [
        (0.5, "below 0.5: K"),
        (999_999.0, "below 999999: K"),
        (1e6, "below 1e6: K"),
        (2.5e7, "below 2.5e7: K"),
    ] {
        let text = shown(&found, Some(within));
        assert!(text.contains(said), "{text}");
    }
}

/// A file for the rectangles is refused before anything is proved.
#[test]
fn a_file_that_cannot_be_written_is_refused() {
    use crate::cli::ran;
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("none/boxes.csv");
    let boxes = ["--boxes", file.to_str().unwrap()];
    for words in [
        &["prove", "faddeeva", "--within", "0.01"][..],
        &["prove", "faddeeva", "--part", "lower"],
        &["prove", "faddeeva", "--part", "real"],
        &["prove", "erf"],
    ] {
        let why = ran(&[words, &boxes].concat()).unwrap_err().to_string();
        assert!(why.starts_with("cannot write "), "{why}");
    }
}

#[test]
fn options_belong_to_a_part() {
    use crate::cli::ran;
    let lower = "is for the upper half-plane: below the axis targets are fixed";
    let line = "is for faddeeva alone: the real line is proved for every real argument";
    let erf = "is for faddeeva alone: erf is proved for every real argument";
    for (words, due) in [
        ("faddeeva --part lower --norm 2", format!("--norm {lower}")),
        (
            "faddeeva --part lower --component 2",
            format!("--component {lower}"),
        ),
        ("faddeeva --part real --norm 2", format!("--norm {line}")),
        (
            "faddeeva --part real --within 2",
            format!("--within {line}"),
        ),
        ("erf --norm 2", format!("--norm {erf}")),
        ("erf --within 2", format!("--within {erf}")),
        ("erf --part real", format!("--part {erf}")),
        ("erf --part upper --norm 2", format!("--part {erf}")),
    ] {
        let words: Vec<&str> = ["prove"].into_iter().chain(words.split(' ')).collect();
        assert_eq!(ran(&words).unwrap_err().to_string(), due);
    }
}

/// A hundredth of the binades about zero is proved in a moment: the bounds asked for are those that
/// are met.
#[test]
fn targets_are_those_asked_for() {
    let found = |norm: f64, component: f64| {
        let target = Target {
            norm,
            component,
            ..UPPER_HALF_PLANE
        };
        let found = proved(target, Some(0.01)).unwrap().unwrap();
        assert!(found.open.is_empty());
        found.summary().unwrap()
    };
    let usual = found(UPPER_HALF_PLANE.norm, UPPER_HALF_PLANE.component);
    assert!(usual.norm.bound <= UPPER_HALF_PLANE.norm);
    assert!(usual.component.unwrap().bound <= UPPER_HALF_PLANE.component);
}
