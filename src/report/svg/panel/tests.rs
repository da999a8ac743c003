//! Tests of `panel`.

use super::super::style::{BLUE, GREEN, ORANGE, tests::whole};
use super::*;
use crate::report::gallery::Gallery;

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

#[test]
fn curves_have_hundredths_of_a_pixel() {
    let slope = (0..=5000).map(|k| (f64::from(k), 1e-3 * f64::from(k)));
    let slope = curve("slope", slope.collect(), BLUE);
    let svg = drawn((1000, 400), |root, page| {
        let area = titled(root, page, "a < b", "");
        panel(&area, page, ("x", "y"), &[slope])
    });
    whole(&svg);
    let line = attributes(&svg, "polyline", "points").pop().unwrap();
    let place = |p: &str| {
        p.split_once(',')
            .map(|(x, y)| [x, y].map(|t| t.parse().unwrap()))
    };
    let points: Vec<[f64; 2]> = line.split(' ').map(|p| place(p).unwrap()).collect();
    assert_eq!(points.len(), 5001);
    let (a, b) = (points[0], points[5000]);
    for (k, p) in points.iter().enumerate() {
        let part = k as f64 / 5000.0;
        let due = [0, 1].map(|i| a[i] + part * (b[i] - a[i]));
        assert!((p[0] - due[0]).hypot(p[1] - due[1]) < 0.02, "{k}: {p:?}");
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
        (&[2.9, 10.0][..], (0.0, 10.355)),
        (&[3.0, 10.0], (2.65, 10.35)),
        (&[0.5, 10.0], (0.0, 10.475)),
        (&[-1.0, 1.0], (-1.1, 1.1)),
        (&[-2.0, -1.0], (-2.05, -0.95)),
        (&[0.0, 4.0], (0.0, 4.2)),
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

/// Room for labels, names, titles and notes; ticks; the line of zero; strokes and legends.
#[test]
fn panels() {
    let mut all = Gallery::default();
    let one = |width: u32, labels, names: &[&'static str], points: &[(f64, f64)]| {
        let curves: Vec<Curve> = names
            .iter()
            .map(|n| curve(n, points.to_vec(), BLUE))
            .collect();
        drawn((width, 300), |root, page| {
            panel(root, page, labels, &curves)
        })
    };
    let line = [(2.0, 0.0), (3.0, 21.0)];
    for labels in [("x", "y"), ("", "y"), ("x", "")] {
        all.add(
            format!("{labels:?}"),
            one(600, labels, &["a", "", "b"], &line),
        );
    }
    for (low, high) in [(-0.5, 0.5), (-21.0, -1.0), (0.0, 7.0), (-1e-12, 1e-12)] {
        let points = [(0.0, low), (1.0, high)];
        all.add(
            format!("{low} to {high}"),
            one(600, ("", "y"), &[""], &points),
        );
    }
    let back = [(4.0, 0.0), (5.0, 1.0), (2.0, 2.0)];
    for points in [&[][..], &[(2.0, 1.0)], &back] {
        all.add(format!("{points:?}"), one(300, ("", ""), &[""], points));
    }
    for (width, last) in [(1500, 11.0), (412, 4.0), (411, 4.0), (231, 3.0)] {
        let points = [(0.0, 0.0), (last, 1.0)];
        all.add(
            format!("{last} on {width}"),
            one(width, ("", ""), &[""], &points),
        );
    }
    for note in ["", "how"] {
        let svg = drawn((600, 400), |root, page| {
            let area = titled(root, page, "a < b", note);
            let both = [
                curve("ab", line.to_vec(), BLUE),
                curve("", Vec::new(), GREEN),
                dashed("c", line.to_vec(), ORANGE),
            ];
            panel(&area, page, ("x", "y"), &both)
        });
        all.add(format!("titled, {note:?}"), svg);
    }
    all.pin("panels");
}
