//! Tests of `panel`.

use super::super::style::{BLUE, GREEN, ORANGE, tests::whole};
use super::*;

/// The places of a drawing's dots.
pub fn dots(svg: &str) -> Vec<(f64, f64)> {
    let circles = svg.split("<circle ").skip(1);
    let value = |tag: &str, name: &str| -> f64 {
        let start = tag.find(&format!("{name}=\"")).unwrap() + name.len() + 2;
        tag[start..].split('"').next().unwrap().parse().unwrap()
    };
    circles.map(|c| (value(c, "cx"), value(c, "cy"))).collect()
}

/// The places of the last curve's points.
pub fn points(svg: &str) -> Vec<(f64, f64)> {
    let line = svg.split("points=\"").last().unwrap();
    let points = line.split('"').next().unwrap().split(' ');
    points
        .map(|p| p.split_once(',').unwrap())
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect()
}

/// The texts of a drawing.
pub fn texts(svg: &str) -> Vec<&str> {
    let inner = |tag: &str| tag.find('>').map(|k| k + 1).unwrap();
    let texts = svg.split("<text ").skip(1).map(|t| &t[inner(t)..]);
    texts.map(|t| t.split('<').next().unwrap().trim()).collect()
}

/// The values of an attribute in all elements of that name that have it.
pub fn attributes<'a>(svg: &'a str, element: &str, name: &str) -> Vec<&'a str> {
    let opening = format!("<{element} ");
    let tags = svg.split(opening.as_str()).skip(1);
    let value = |tag: &'a str| {
        let own = &tag[..tag.find('>')?];
        let mut parts = own.split('"');
        while let (Some(key), Some(value)) = (parts.next(), parts.next()) {
            if key.trim() == format!("{name}=") {
                return Some(value);
            }
        }
        None
    };
    tags.filter_map(value).collect()
}

/// Each text, its place, and the height of its letters, in pixels.
pub fn placed(svg: &str) -> Vec<(&str, [f64; 3])> {
    let number = |name: &str| -> Vec<f64> {
        let all = attributes(svg, "text", name).into_iter();
        all.map(|x| x.parse().unwrap()).collect()
    };
    let (x, y, size) = (number("x"), number("y"), number("font-size"));
    let each = texts(svg).into_iter().enumerate();
    each.map(|(k, text)| (text, [x[k], y[k], size[k]]))
        .collect()
}

pub type Points = Vec<(f64, f64)>;

/// The points of each line of a drawing, with its colour and width.
pub fn polylines(svg: &str) -> Vec<(String, u32, Points)> {
    let colours = attributes(svg, "polyline", "stroke").into_iter();
    let widths = attributes(svg, "polyline", "stroke-width").into_iter();
    let points = attributes(svg, "polyline", "points").into_iter();
    let place = |p: &str| {
        let (x, y) = p.split_once(',').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    let each = colours.zip(widths).zip(points);
    each.map(|((colour, width), points)| {
        let points = points.split_whitespace().map(place).collect();
        (colour.to_lowercase(), width.parse().unwrap(), points)
    })
    .collect()
}

/// The points of the lines that the program draws itself, in hundredths of a pixel.
pub fn curves(svg: &str) -> Vec<Points> {
    let own = svg.split("stroke-linejoin=\"round\"").skip(1);
    let points = own.map(|tag| tag.split("points=\"").nth(1).unwrap().split('"').next());
    let place = |p: &str| {
        let (x, y) = p.split_once(',').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    points
        .map(|p| p.unwrap().split_whitespace().map(place).collect())
        .collect()
}

/// Returns true if two places are the same to a hundredth of a pixel.
pub fn near(a: (f64, f64), b: (f64, f64)) -> bool {
    (a.0 - b.0).abs() < 0.011 && (a.1 - b.1).abs() < 0.011
}

#[test]
fn curves_have_hundredths_of_a_pixel() {
    let slope = (0..=5000).map(|k| (f64::from(k), 1e-3 * f64::from(k)));
    let slope = curve("slope", slope.collect(), BLUE);
    let svg = drawn((1000, 400), |root, page| {
        let area = titled(root, page, "a < b", "");
        panel(&area, page, ("x", "y"), &[slope])
    });
    whole(&svg);
    assert!(svg.contains("<title>a &lt; b</title>\n<desc>y of slope</desc>"));
    let points = points(&svg);
    assert_eq!(points.len(), 5001);
    let (a, b) = (points[0], points[5000]);
    for (k, p) in points.iter().enumerate() {
        let part = k as f64 / 5000.0;
        let due = (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1));
        assert!((p.0 - due.0).hypot(p.1 - due.1) < 0.02, "{k}: {p:?}");
    }
}

#[test]
fn ticks_have_exponents_where_they_are_short_or_long() {
    for (x, text) in [
        (0.0, "0"),
        (1e-3, "0.001"),
        (-1.5e-3, "-0.0015"),
        (9.99e-4, "9.99e-4"),
        (999_999.5, "999999.5"),
        (1e6, "1.00e6"),
    ] {
        assert_eq!(tick(x), text);
    }
}

#[test]
fn zero_belongs_to_a_range_that_is_near_it() {
    for (values, due) in [
        (&[1.0, 11.0][..], (0.0, 11.5)),
        (&[2.9, 10.0], (0.0, 10.355)),
        (&[3.0, 10.0], (2.65, 10.35)),
        (&[0.5, 10.0], (0.0, 10.475)),
        (&[-1.0, 1.0], (-1.1, 1.1)),
        (&[-2.0, -1.0], (-2.05, -0.95)),
        (&[0.0, 4.0], (0.0, 4.2)),
        (&[0.0], (0.0, 0.5)),
        (&[0.25], (-0.25, 0.75)),
        (&[-8.0], (-12.0, -4.0)),
        (&[4.0, 4.5], (3.975, 4.525)),
        (&[f64::NAN, 4.0, f64::INFINITY, 2.0], (1.9, 4.1)),
        (&[], (-1.0, 1.0)),
        (&[f64::NAN], (-1.0, 1.0)),
        (&[3.0, 3.0], (1.5, 4.5)),
    ] {
        let (low, high) = padded(values.iter().copied());
        let far = (low - due.0).abs().max((high - due.1).abs());
        assert!(far < 1e-12, "{values:?}: {low} to {high}");
        assert_eq!(low == 0.0, due.0 == 0.0, "{values:?}");
    }
}

/// The corners that are left to the curves, on a page of 600 by 400.
#[test]
fn labels_and_names_take_their_room_from_the_curves() {
    for (label, name, top, bottom) in [
        ("x", "a", 34.0, 48.0),
        ("x", "", 8.0, 48.0),
        ("", "a", 34.0, 28.0),
        ("", "", 8.0, 28.0),
    ] {
        let line = vec![(2.0, 0.0), (3.0, 21.0)];
        let svg = drawn((600, 400), |root, page| {
            panel(root, page, (label, "y"), &[curve(name, line, BLUE)])
        });
        let [(from, to)] = [curves(&svg)[0].clone()].map(|c| (c[0], c[1]));
        let (left, right) = (8.0 + 84.0, 600.0 - 20.0 - 1.0);
        let (top, bottom) = (top, 400.0 - 8.0 - bottom - 1.0);
        assert!(near(from, (left, bottom)), "{label:?} {name:?}: {from:?}");
        // Above the highest value is a twentieth of the range.
        let due = (right, bottom - (bottom - top) / 1.05);
        assert!(near(to, due), "{label:?} {name:?}: {to:?}");
    }
}

#[test]
fn a_title_and_a_note_take_their_room_above() {
    for (note, top) in [("", 56.0), ("how", 76.0)] {
        let svg = drawn((600, 400), |root, page| {
            let area = titled(root, page, "what", note);
            let line = vec![(0.0, 0.0), (1.0, 1.0)];
            panel(&area, page, ("x", "y"), &[curve("", line, BLUE)])
        });
        let start = curves(&svg)[0][0];
        let bottom = 400.0 - 10.0 - 8.0 - 48.0 - 1.0;
        assert!(near(start, (10.0 + 8.0 + 84.0, bottom)), "{start:?}");
        let end = curves(&svg)[0][1];
        let top = top + 8.0;
        let right = 600.0 - 24.0 - 20.0 - 1.0;
        assert!(
            near(end, (right, bottom - (bottom - top) / 1.05)),
            "{end:?}"
        );
        let mut due = vec![("what", [24.0, 18.0, 19.0])];
        due.extend((!note.is_empty()).then_some((note, [24.0, 50.0, 12.0])));
        assert_eq!(placed(&svg)[..due.len()], due);
        let described = if note.is_empty() { "y" } else { "how; y" };
        let head = format!("<title>what</title>\n<desc>{described}</desc>\n<style>");
        let (first, rest) = svg.split_once('\n').unwrap();
        assert!(first.ends_with('>') && rest.starts_with(&head), "{svg}");
        assert!(svg.ends_with("</polyline>\n</svg>\n"), "{svg}");
    }
}

#[test]
fn a_description_names_what_is_drawn() {
    let of = |label: &'static str, names: &[&'static str]| {
        let lines: Vec<Curve> = names.iter().map(|n| curve(n, Vec::new(), BLUE)).collect();
        let svg = drawn((600, 400), |root, page| {
            panel(root, page, ("x", label), &lines)
        });
        let (_, rest) = svg.split_once("<desc>").unwrap();
        rest.split_once("</desc>").unwrap().0.to_string()
    };
    assert_eq!(of("speed", &["a", "", "b"]), "speed of a, b");
    assert_eq!(of("speed", &[""]), "speed");
    assert_eq!(of("", &["a"]), "");
}

/// Lines across the whole panel in the colour of its axes: the axis, and zero where it is within.
#[test]
fn zero_has_a_line_where_values_are_on_both_sides() {
    for (values, zero) in [
        ([-0.5, 0.5], true),
        ([0.0, 4.0], false),
        ([2.0, 3.0], false),
        // With the air above the highest value the range ends at zero.
        ([-21.0, -1.0], false),
        ([-3.0, -2.0], false),
    ] {
        let line = vec![(0.0, values[0]), (1.0, values[1])];
        let svg = drawn((600, 400), |root, page| {
            panel(root, page, ("", ""), &[curve("", line, BLUE)])
        });
        let across: Vec<f64> = polylines(&svg)
            .into_iter()
            .filter(|(colour, width, p)| *colour == hex(AXIS) && *width == 1 && p.len() == 2)
            .map(|(.., p)| (p[0], p[1]))
            .filter(|(a, b)| a.1 == b.1 && b.0 - a.0 > 400.0)
            .map(|(a, _)| a.1)
            .collect();
        assert_eq!(across.len(), 1 + usize::from(zero), "{values:?}: {svg}");
        // Half-way, where the range is the same on both sides.
        let middle = (8.0 + 363.0) / 2.0;
        let there = across.iter().any(|y| (y - middle).abs() <= 1.0);
        assert_eq!(there, zero, "{values:?}: {across:?}");
    }
}

#[test]
fn a_single_point_and_no_point_at_all_have_a_unit_of_abscissa() {
    let abscissae = |points: Vec<(f64, f64)>| {
        let svg = drawn((600, 300), |root, page| {
            panel(root, page, ("", ""), &[curve("", points, BLUE)])
        });
        let below = placed(&svg).into_iter().filter(|t| t.1[1] > 270.0);
        let ticks: Vec<f64> = below.map(|t| t.0.parse().unwrap()).collect();
        (ticks[0], ticks[ticks.len() - 1], curves(&svg)[0].clone())
    };
    let (first, last, points) = abscissae(vec![(2.0, 1.0)]);
    assert_eq!((first, last), (2.0, 3.0));
    assert!((points[0].0 - 92.0).abs() < 0.011, "{points:?}");
    let (first, last, _) = abscissae(Vec::new());
    assert_eq!((first, last), (0.0, 1.0));
    let (first, last, points) = abscissae(vec![(4.0, 0.0), (5.0, 1.0), (2.0, 2.0)]);
    assert_eq!((first, last), (2.0, 5.0));
    assert_eq!((points[2].0, points[1].0), (92.0, 579.0));
}

/// Sixty pixels apart at least, but for three.
#[test]
fn there_are_three_to_eleven_labels_across_and_seven_up() {
    let shown = |width: u32, last: f64, high: f64| {
        let line = curve("", vec![(0.0, 0.0), (last, high)], BLUE);
        let svg = drawn((width, 300), |root, page| {
            panel(root, page, ("", ""), &[line])
        });
        let across = placed(&svg).iter().filter(|t| t.1[1] > 270.0).count();
        (across, placed(&svg).len() - across)
    };
    for (width, last, due) in [
        (1500, 10.0, 11),
        (1500, 11.0, 6),
        (112 + 300, 4.0, 5),
        (112 + 299, 4.0, 3),
        (112 + 2 * 60 + 59, 2.0, 3),
        (112 + 119, 2.0, 3),
        (112 + 119, 3.0, 2),
    ] {
        assert_eq!(shown(width, last, 1.0).0, due, "{last} on {width}");
    }
    assert_eq!(shown(600, 1.0, 6.0).1, 7);
    assert_eq!(shown(600, 1.0, 7.0).1, 4);
}

#[test]
fn small_values_have_labels_of_their_own() {
    for size in [1e-6, 1e-12, 1.3e-3, 0.3, 0.7, 1.0, 29.0, 1e12] {
        let line = curve("", vec![(0.0, -size), (1.0, size)], BLUE);
        let svg = drawn((600, 300), |root, page| {
            panel(root, page, ("", ""), &[line])
        });
        let left = placed(&svg).into_iter().filter(|t| t.1[1] < 270.0);
        let ticks: Vec<f64> = left
            .map(|t| t.0.replace('−', "-").parse().unwrap())
            .collect();
        assert!(
            ticks.len() > 2 && ticks.is_sorted_by(|a, b| a < b),
            "{ticks:?}"
        );
        assert!(ticks.contains(&0.0), "{ticks:?}");
    }
}

/// Strokes of 27 pixels, the name behind them, and the next one 26 pixels farther.
#[test]
fn a_legend_has_a_stroke_and_a_name_for_each_curve() {
    let curves = [
        curve("ab", Vec::new(), BLUE),
        curve("", Vec::new(), GREEN),
        dashed("c", Vec::new(), ORANGE),
    ];
    let svg = drawn((600, 100), |root, page| legend(root, page, &curves));
    assert_eq!(
        placed(&svg),
        [("ab", [134.0, 10.0, 12.0]), ("c", [210.0, 10.0, 12.0])]
    );
    let stroke = |colour, from: f64, to: f64| (hex(colour), 3, vec![(from, 18.0), (to, 18.0)]);
    assert_eq!(
        polylines(&svg),
        [stroke(BLUE, 100.0, 127.0), stroke(ORANGE, 176.0, 203.0),]
    );
}

#[test]
fn curves_are_two_pixels_wide_and_dashed_where_they_are_to_be() {
    let line = || vec![(0.0, 0.0), (1.0, 1.0)];
    let svg = drawn((600, 400), |root, page| {
        let both = [curve("a", line(), BLUE), dashed("b", line(), ORANGE)];
        panel(root, page, ("", ""), &both)
    });
    let own: Vec<&str> = svg.lines().filter(|l| l.contains("linejoin")).collect();
    let [solid, dashed] = own[..] else {
        panic!("{own:?}");
    };
    assert!(solid.contains("stroke-width=\"2\"") && !solid.contains("dasharray"));
    assert!(dashed.contains("stroke-width=\"2\"") && dashed.contains("dasharray=\"7 5\""));
    assert!(solid.contains(&hex(BLUE)) && dashed.contains(&hex(ORANGE)));
}

#[test]
fn axes_have_larger_letters_than_their_ticks() {
    let line = vec![(2.0, 2.0), (3.0, 3.0)];
    let svg = drawn((600, 400), |root, page| {
        panel(root, page, ("across", "up"), &[curve("", line, BLUE)])
    });
    for (text, [_, _, size]) in placed(&svg) {
        let due = if ["across", "up"].contains(&text) {
            14.0
        } else {
            12.0
        };
        assert_eq!(size, due, "{text}");
    }
}
