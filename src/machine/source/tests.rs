//! Tests of `source`.

use super::*;
use crate::machine::quantity::Quantity;
use crate::solvers::units::Length;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    geometry: Geometry,
    #[serde(default)]
    _kind: Choice,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Geometry {
    crank: Quantity<Length>,
    #[serde(default)]
    points: Vec<Quantity<Length>>,
    #[serde(default)]
    _count: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Choice {
    #[default]
    Linear,
    Cubic,
}

#[test]
fn refusals_name_value_rule_and_line() {
    for (toml, json, line, place, rule) in [
        (
            "[geometry]\n\ncrank = \"1 kg\"\n",
            "{\"geometry\":\n\n{\"crank\": \"1 kg\"}}",
            3,
            "geometry.crank",
            "geometry.crank = \"1 kg\" is not a length",
        ),
        (
            "[geometry]\ncrank = 7\n",
            "{\"geometry\":\n{\"crank\": 7}}",
            2,
            "geometry.crank",
            "geometry.crank = \"7\" has no unit",
        ),
        (
            "[geometry]\ncrank = \"1 m\"\npoints = [\n\"1 m\",\n\"x\"]",
            "{\"geometry\":\n{\"crank\": \"1 m\",\n\"points\": [\"1 m\"\n,\n\"x\"]}}",
            5,
            "geometry.points[1]",
            "geometry.points[1] = \"x\" does not begin with a decimal number",
        ),
        (
            "\n[geometry]\n",
            "{\n\"geometry\": {}}",
            2,
            "geometry",
            "geometry.crank is missing",
        ),
        (
            "[geometry]\ncrank = \"1 m\"\n_count = -1\n",
            "{\"geometry\":\n{\"crank\": \"1 m\",\n\"_count\": -1}}",
            3,
            "geometry._count",
            "integer `-1`, expected a whole number, 0 or more",
        ),
        (
            "_kind = \"cubik\"\n",
            "{\"_kind\": \"cubik\"}",
            1,
            "_kind",
            "_kind = \"cubik\" (did you mean \"cubic\"?) must be \"linear\" or \"cubic\"",
        ),
    ] {
        for source in [Source::toml(toml), Source::json(json)] {
            let e = source.parse::<File>().unwrap_err();
            let text = e.to_string();
            assert_eq!((e.line(), e.place()), (Some(line), place), "{text}");
            assert!(text.contains(rule), "{text}");
            assert!(!text.contains('\n') && e.source().is_some());
        }
    }
    let good = "[geometry]\ncrank = \"1 m\"\npoints = [\"1 cm\"]\n";
    let file: File = Source::toml(good).parse().unwrap();
    let read = (file.geometry.crank.to_f64(), file.geometry.points.len());
    assert_eq!(read, (1.0, 1));
    for source in [
        Source::toml("[geometri]\ncrank = \"1 m\""),
        Source::json("{\"geometri\": {}}"),
    ] {
        let e = source.parse::<File>().unwrap_err();
        let due = "line 1: unknown field `geometri` (did you mean \"geometry\"?), expected";
        assert!(e.to_string().starts_with(due), "{e}");
    }
    for source in [Source::toml("_kind = \"cubic\""), Source::json("{}")] {
        let e = source.parse::<File>().unwrap_err();
        assert_eq!(e.to_string(), "the section [geometry] is missing");
    }
}

#[test]
fn places_are_found() {
    let source = Source::toml("a = 1\n[b]\n\nc = 2\n[b.d]\ne = { f = 3 }\n");
    for (place, line) in [("a", 1), ("b", 2), ("b.c", 4), ("b.d.e", 6), ("b.x", 2)] {
        assert_eq!(source.line_of(place), Some(line), "{place}");
    }
    assert_eq!(source.line_of("x"), None);
    let source = Source::toml("[[b]]\nc = 1\n[[b]]\n\nc = 2\n");
    for (place, line) in [
        ("b[0].c", 2),
        ("b[1]", 3),
        ("b[1].c", 5),
        ("b[1].x", 3),
        ("b[7]", 1),
    ] {
        assert_eq!(source.line_of(place), Some(line), "{place}");
    }
    assert_eq!(Source::json("{\"a\": 1}").line_of("a"), None);
}

#[test]
fn texts() {
    let read = |bytes: &[u8]| Source::read(bytes, None);
    assert_eq!(read(b" {}").unwrap().form, Form::Json);
    assert_eq!(read("\u{feff}a = 1".as_bytes()).unwrap().text, "a = 1");
    assert!(read(&vec![b'#'; LONGEST as usize]).is_ok());
    let long = vec![b'#'; LONGEST as usize + 1];
    for (bytes, part) in [
        (&b"\n"[..], "empty"),
        (b"a\xff", "not UTF-8 text (at byte 1)"),
        (&long, "longer than 1 MiB"),
    ] {
        let e = read(bytes).unwrap_err().to_string();
        assert!(e.contains(part), "{e}");
    }
}

#[test]
fn no_more_is_read_than_tells_that_a_text_is_too_long() {
    let mut endless = std::io::Cursor::new(vec![b'#'; 3 * LONGEST as usize]);
    let refused = Source::read(&mut endless, None).unwrap_err();
    assert!(matches!(refused, SourceError::TooLong));
    assert_eq!(endless.position(), LONGEST + 1);
}
