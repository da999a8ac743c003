//! Tests of `paper`.

use super::super::page::tests::between;
use super::*;
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

#[test]
fn tallies_come_by_table_with_the_deviations_of_their_column() {
    let mut report = fabricated();
    report.entries[2].table = 2;
    let mut second = report.tallies[0].clone();
    (second.table, second.column, second.entries) = (2, "phi3", 1);
    (second.within_half, second.within_one) = (0, 1);
    let mut other = second.clone();
    (other.variant, other.within_half) = ("recovered", 1);
    report.tallies = vec![second.clone(), other, report.tallies[0].clone()];
    let html = tallies(&report).into_string();
    let rows = between(&html, "<tr class=\"", "</tr>");
    let heads: Vec<(&str, &str)> = rows
        .iter()
        .map(|r| {
            let class = r.split('"').next().unwrap();
            (class, between(r, "<td>", "</td>")[0])
        })
        .collect();
    assert_eq!(heads, [("", "1"), ("rounding", "2"), ("agrees", "2")]);
    let t = &report.tallies[2];
    assert_eq!(along(&report, t), [0.2, 12.0]);
    assert_eq!(along(&report, &second), [86.0]);
    let recovered = Tally {
        variant: "recovered",
        ..t.clone()
    };
    assert_eq!(along(&report, &recovered), [0.1, 0.7]);
    let none = Tally {
        column: "phi3",
        ..t.clone()
    };
    assert!(along(&report, &none).is_empty());
    report.tallies.clear();
    assert_eq!(tallies(&report).into_string(), "");
}

#[test]
fn a_grid_has_a_row_for_each_row_and_a_note_on_what_is_wrong() {
    let report = fabricated();
    let all: Vec<&Entry> = report.entries.iter().collect();
    let html = grid(&all, "as_printed").into_string();
    assert_eq!(
        between(&html.replace(" class=\"given\"", ""), "<th>", "</th>"),
        ["row", "phi2", "phi3", "0", "1"]
    );
    let rows = between(&html, "<tr><th>0", "</tr>");
    assert!(rows[0].ends_with("1.235</td><td></td>"), "{html}");
    let tips = between(&html, "data-tip=\"", "\"");
    assert_eq!(
        tips[1],
        "recomputed 1.2345678901234567890\n12.00 units of the last digit: misprint\n3 for 5"
    );
    assert!(
        tips[0].ends_with("\n0.200 units of the last digit: agrees"),
        "{tips:?}"
    );
    assert_eq!(html.matches("tabindex").count(), 2);
    let none = grid(&all, "unknown").into_string();
    assert!(none.contains("<td>1.243</td>") && !none.contains("data-tip"));
}

#[test]
fn courses_are_named_by_the_first_of_them() {
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
    let due = "3 positions of one turn by the f64 solver, one every 120.0°. Solid: centres of mass as printed; \
                   dashed: recovered. Rings: values printed in the paper's tables.";
    assert_eq!(positions(&motion).into_string(), due);
    motion.drive.values.truncate(1);
    motion.courses.clear();
    let due =
        "1 positions of one turn by the f64 solver. . Rings: values printed in the paper's tables.";
    assert_eq!(positions(&motion).into_string(), due);
}
