//! Tests of `paper`.

use super::*;
use crate::report::gallery::Gallery;
use crate::report::text::paper::tests::fabricated;

#[test]
fn the_page_is_whole_escaped_and_without_outside_parts() {
    let html = page(&fabricated(), None);
    for part in [
        "On &lt;tests&gt; &amp; such",
        "class=\"misprint\" tabindex=\"0\" data-tip=\"recomputed 1.2345678901234567890\n12.00 units",
        "3 for 5",
        "Not as recorded",
        "NOT as recorded</span>: 2 findings: ",
    ] {
        assert!(html.contains(part), "{part} is missing");
    }
    super::super::page::tests::whole(&html);
}

#[test]
fn cards_of_long_formulas_are_wide_and_so_is_what_is_alone_between_them() {
    let finding = |lengths: &[(bool, usize)]| {
        let mut f = fabricated().findings.remove(1);
        let figure = |(formula, n): &(bool, usize)| Figure {
            name: "a".into(),
            value: "φ".repeat(*n),
            unit: "1",
            latex: formula.then(|| "a".into()),
        };
        f.figures = lengths.iter().map(figure).collect();
        f
    };
    let (long, short) = ([(true, WIDE + 1)], [(true, WIDE), (false, WIDE + 1)]);
    let seen = |cards: &str| {
        let all: Vec<Finding> = cards
            .chars()
            .map(|c| match c {
                'L' => finding(&long),
                'M' => finding(&[long[0], short[0]]),
                _ => finding(&short),
            })
            .collect();
        let wide = wide(&all.iter().collect::<Vec<_>>());
        wide.into_iter()
            .map(|w| if w { 'w' } else { '.' })
            .collect::<String>()
    };
    for (cards, due) in [
        ("", ""),
        ("s", "."),
        ("ss", ".."),
        ("L", "w"),
        ("M", "w"),
        ("sL", "ww"),
        ("Ls", "ww"),
        ("LsL", "www"),
        ("Lss", "w.."),
        ("ssL", "..w"),
        ("sLss", "ww.."),
        ("LssL", "w..w"),
    ] {
        assert_eq!(seen(cards), due, "{cards}");
    }
}

/// Tallies by table with the deviations of their column, a grid with notes on what is wrong, and
/// courses named by the first of them.
#[test]
fn parts_of_pages() {
    let mut all = Gallery::default();
    let course = |names: &[&str]| crate::motion::Course {
        name: "y".into(),
        unit: String::new(),
        variants: names
            .iter()
            .map(|n| (n.to_string(), vec![0.0; 3]))
            .collect(),
        printed: Vec::new(),
    };
    let mut motion = crate::motion::Motion {
        name: "crank".into(),
        drive: crate::motion::Drive {
            symbol: "φ",
            unit: "°",
            values: vec![0.0, 120.0, 240.0],
        },
        closed: true,
        start: 0,
        points: Vec::new(),
        links: Vec::new(),
        plates: Vec::new(),
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: vec![course(&["as printed", "recovered"]), course(&["other"])],
    };
    all.add("positions", positions(&motion).into_string());
    motion.drive.values.truncate(1);
    motion.courses.clear();
    all.add("one position", positions(&motion).into_string());
    let mut report = fabricated();
    let entries: Vec<&Entry> = report.entries.iter().collect();
    for variant in ["as_printed", "unknown"] {
        all.add(variant, grid(&entries, variant).into_string());
    }
    report.entries[2].table = 2;
    let mut second = report.tallies[0].clone();
    (second.table, second.column, second.entries) = (2, "phi3", 1);
    (second.within_half, second.within_one) = (0, 1);
    let mut other = second.clone();
    (other.variant, other.within_half) = ("recovered", 1);
    report.tallies = vec![second, other, report.tallies[0].clone()];
    all.add("tallies", tallies(&report).into_string());
    report.tallies.clear();
    all.add("no tallies", tallies(&report).into_string());
    all.pin("paper-pages");
}
