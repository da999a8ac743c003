use super::upper::{Upper, proved};
use super::*;
use crate::gallery::Gallery;
use mechaudit::proof::{Bound, Certificate, Formula, Leaf, Target, UPPER_HALF_PLANE};

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

/// In words, for programs and as rows, bounds rounded up; where a rectangle is open nothing is
/// claimed, and the first five are named.
#[test]
fn theorems() {
    let mut all = Gallery::default();
    let mut out = Vec::new();
    write_boxes(&[theorem(&certificate(), None)], &mut out).unwrap();
    all.add("boxes", String::from_utf8(out).unwrap());
    all.add("text", theorem(&certificate(), None).text());
    all.add_json("document", theorem(&certificate(), Some(8.0)).document());
    for within in [0.5, 999_999.0, 1e6, 2.5e7] {
        let text = theorem(&certificate(), Some(within)).text();
        all.add(format!("within {within}"), text.lines().nth(1).unwrap());
    }
    let mut components = certificate();
    components.leaves.pop();
    all.add("components", theorem(&components, None).text());
    let open = (0..6).map(|k| Open {
        at: Rectangle {
            a: [f64::from(k), 9.0],
            b: [0.0, 1.0],
        },
        why: "several formulas",
    });
    let found = theorem(
        &Certificate {
            open: open.collect(),
            ..certificate()
        },
        None,
    );
    assert!(!found.text().contains("K · 2^-52") && found.document()["proved"] == false);
    all.add("open", found.text());
    all.add_json("open", found.document());
    all.pin("theorems");
}
