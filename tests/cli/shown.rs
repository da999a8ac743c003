//! `mechaudit linkage --format html` and `--dxf`, as their user meets them.

use crate::common::{
    column, command, markup, needs_nothing_else, refused, run, run_on, said, text, words,
};
use dxf::entities::{Circle, EntityType, LwPolyline};
use dxf::enums::Units;
use dxf::{Drawing, Point};
use std::path::Path;
use tempfile::tempdir;

/// Every example that `linkage` takes.
const EXAMPLES: [&str; 20] = [
    "andrews",
    "cylinder-boom",
    "double-butterfly",
    "four-bar",
    "jansen-leg",
    "n-four-bar",
    "no-full-turn",
    "peaucellier-cell",
    "pmksweb-91",
    "pmksweb-92",
    "quick-return",
    "rack-and-wheel",
    "sand-screen",
    "sand-screen-bodies",
    "slider-crank",
    "stephenson-1",
    "stephenson-2",
    "stephenson-3",
    "watt-1",
    "watt-2",
];

fn drawing(folder: &Path) -> Drawing {
    Drawing::load_file(folder.join("mechanism.dxf")).unwrap()
}

/// The circles of a layer.
fn circles(drawing: &Drawing, layer: &str) -> Vec<Circle> {
    let of = drawing.entities().filter(|e| e.common.layer == layer);
    of.filter_map(|e| match &e.specific {
        EntityType::Circle(c) => Some(c.clone()),
        _ => None,
    })
    .collect()
}

fn path(drawing: &Drawing, layer: &str) -> LwPolyline {
    let mut of = drawing.entities().filter(|e| e.common.layer == layer);
    match of.next().map(|e| &e.specific) {
        Some(EntityType::LwPolyline(line)) => line.clone(),
        other => panic!("{layer}: {other:?}"),
    }
}

fn lines(drawing: &Drawing, layer: &str) -> Vec<[Point; 2]> {
    let of = drawing.entities().filter(|e| e.common.layer == layer);
    of.filter_map(|e| match &e.specific {
        EntityType::Line(l) => Some([l.p1.clone(), l.p2.clone()]),
        _ => None,
    })
    .collect()
}

fn distance(p: &Point, [x, y]: [f64; 2]) -> f64 {
    (p.x - x).hypot(p.y - y)
}

#[test]
fn every_linkage_has_a_page_and_a_drawing() {
    let folder = tempdir().unwrap();
    for name in EXAMPLES {
        let (page, cad) = (folder.path().join("page.html"), folder.path().join(name));
        let file = format!("examples/{name}.toml");
        let options = [
            "--format",
            "html",
            "--output",
            text(&page),
            "--dxf",
            text(&cad),
        ];
        let d = run(&[&["linkage", &*file], &options[..]].concat());
        assert_eq!((d.code, &*d.out), (0, ""), "{name}: {}", d.err);
        let page = std::fs::read_to_string(&page).unwrap();
        needs_nothing_else(&page);
        assert!(
            page.len() < 2_000_000 && !markup(&page).contains("NaN"),
            "{name}"
        );
        let drawing = drawing(&cad);
        assert_eq!(drawing.header.default_drawing_units, Units::Meters);
        for layer in ["LINKS", "JOINTS", "NAMES", "GROUND"] {
            assert!(drawing.layers().any(|l| l.name == layer), "{name}: {layer}");
        }
        let paths = drawing.layers().filter(|l| l.name.starts_with("PATH_"));
        let joints = circles(&drawing, "JOINTS").len();
        assert_eq!(paths.count(), joints, "{name}");
        assert!(joints > 1, "{name}");
    }
}

/// Joints, ends of links and paths against the rows.
#[test]
fn a_drawing_holds_the_coordinates_of_the_library() {
    let folder = tempdir().unwrap();
    let file = "linkage examples/peaucellier-cell.toml --paths --units mm";
    let d = command(&format!(
        "{file} --from-deg 30 --dxf {}",
        text(folder.path())
    ));
    assert_eq!(d.code, 0, "{}", d.err);
    let row = command(&format!("{file} --from-deg 30 --to-deg 30")).out;
    let at = |name: &str| ["x", "y"].map(|c| column(&row, &format!("{c}_{name}_mm"))[0]);
    let drawing = drawing(folder.path());
    assert_eq!(drawing.header.default_drawing_units, Units::Millimeters);
    let joints = circles(&drawing, "JOINTS");
    let bars = lines(&drawing, "LINKS");
    assert_eq!((joints.len(), bars.len()), (4, 7));
    for name in ["A", "B", "C", "D"] {
        let near = |p: &Point| distance(p, at(name)) < 1e-10;
        assert!(joints.iter().any(|c| near(&c.center)), "{name}");
        assert!(bars.iter().flatten().any(near), "{name}");
    }
    let straight = path(&drawing, "PATH_D");
    assert!(straight.vertices.len() > 700 && !straight.is_closed());
    assert!(straight.vertices.iter().all(|v| (v.x - 105.0).abs() < 1e-9));
    // The turn of a crank, in metres, from 15 degrees on.
    let leg = "linkage examples/jansen-leg.toml --paths --step-deg 0.5";
    let args = format!(
        "{leg} --from-deg 15 --to-deg 374.5 --dxf {}",
        text(folder.path())
    );
    let rows = command(&args);
    assert_eq!(rows.code, 0, "{}", rows.err);
    let walked = path(&self::drawing(folder.path()), "PATH_F");
    let [x, y] = ["x_F_m", "y_F_m"].map(|n| column(&rows.out, n));
    assert!(walked.is_closed());
    assert_eq!((walked.vertices.len(), x.len()), (720, 720));
    for ((v, x), y) in walked.vertices.iter().zip(x).zip(y) {
        assert!((v.x - x).hypot(v.y - y) < 2e-12, "{} {x}", v.x);
    }
}

/// A length that no column has is that of the drawing.
#[test]
fn the_drawing_has_its_own_unit() {
    for (unit, due) in [("cm", Units::Centimeters), ("dm", Units::Decimeters)] {
        let folder = tempdir().unwrap();
        let file = format!("linkage examples/watt-1.toml --units {unit}");
        refused(&command(&file), &format!("no column can be in {unit}"));
        let d = command(&format!("{file} --dxf {}", text(folder.path())));
        assert_eq!(d.code, 0, "{}", d.err);
        let header = drawing(folder.path()).header;
        assert_eq!(header.default_drawing_units, due);
    }
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = tempdir().unwrap();
    let into = text(folder.path());
    for (line, part) in [
        (
            "no-full-turn.toml --all-branches --format html",
            "--format html shows one branch",
        ),
        (
            "watt-2.toml --all-branches --dxf D",
            "--dxf draws one branch",
        ),
        (
            "watt-2.toml --digits 20 --format html",
            "leave out --digits",
        ),
        (
            "peaucellier-cell.toml --from-deg 170 --dxf D",
            "does not reach --from-deg 170",
        ),
        (
            "no-full-turn.toml --from-deg 179 --dxf D",
            "does not reach --from-deg 179",
        ),
        (
            "peaucellier-cell.toml --from-deg 170 --to-deg 171 --format html",
            "there is nothing to show",
        ),
    ] {
        let d = command(&format!(
            "linkage examples/{}",
            line.replace(" D", &format!(" {into}"))
        ));
        refused(&d, part);
    }
    // As wide as the frame and the reach of the crank to its left.
    let small = |size: f64| {
        let [crank, coupler, rocker, frame] = [1.0, 3.0, 2.5, 3.5].map(|x| x / 4.5 * size);
        format!(
            "type = \"four-bar\"\n[geometry]\ncrank = \"{crank:e} m\"\ncoupler = \"{coupler:e} m\"\nrocker = \"{rocker:e} m\"\nframe = \"{frame:e} m\"\n"
        )
    };
    let drawn = |size: f64, more: &str| {
        let args = format!("linkage - --step-deg 90 --dxf {into} {more}");
        run_on(small(size), &words(&args))
    };
    let part = "choose another unit of length by --units";
    for size in [4e-8, 9.9e-7] {
        refused(&drawn(size, ""), part);
        assert_eq!(drawn(size, "--units um").code, 0);
    }
    let d = drawn(1.01e-6, "");
    assert_eq!(d.code, 0, "{}", d.err);
    // The rocker's pivot lies this far from the origin.
    let far = |x: f64| drawn(x * 4.5 / 3.5, "");
    refused(&far(1.01e15), part);
    assert_eq!(far(0.99e15).code, 0);
}

/// The window asked for is what the slider runs over.
#[test]
fn a_page_has_the_rows_asked_for() {
    let file =
        "linkage examples/four-bar.toml --from-deg 10 --to-deg 50 --step-deg 5 --format html";
    let d = command(file);
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(
        d.out.contains("type=\"range\" min=\"0\" max=\"8\""),
        "{}",
        d.err
    );
    assert!(
        d.out
            .contains("\"drive\":[10.0,15.0,20.0,25.0,30.0,35.0,40.0,45.0,50.0]")
    );
    said(&d, "crank-rocker");
}

/// A message about a window without rows is not printed of a page.
#[test]
fn a_page_is_not_without_rows() {
    for file in ["four-bar", "sand-screen", "watt-2"] {
        let line = format!("linkage examples/{file}.toml --format html --step-deg 90");
        let d = command(&line);
        assert_eq!(d.code, 0, "{}", d.err);
        assert!(!d.err.contains("asked for lies in that range"), "{}", d.err);
    }
}

/// The values that the slider of a page runs over, and where it begins.
fn slider(page: &str) -> (Vec<f64>, usize) {
    let between = |from: &str, to: char| {
        let (_, rest) = page.split_once(from).expect(from);
        rest.split(to).next().unwrap().to_owned()
    };
    let drive = between("\"drive\":[", ']');
    let values = drive.split(',').map(|x| x.parse().unwrap());
    let start = between("type=\"range\" min=\"0\"", '>');
    let (_, start) = start.split_once("value=\"").unwrap();
    let start = start.split('"').next().unwrap().parse().unwrap();
    (values.collect(), start)
}

/// Each of the three options asks for a window; without them the page is of all that there is.
#[test]
fn a_window_is_asked_for_by_any_of_its_ends() {
    let of = |more: &str| {
        let line = format!("linkage examples/four-bar.toml --format html {more}");
        let (values, _) = slider(&command(&line).out);
        (values.len(), values[0], values[values.len() - 1])
    };
    assert_eq!(of(""), (720, 0.0, 359.5));
    assert_eq!(of("--step-deg 30"), (12, 0.0, 330.0));
    assert_eq!(of("--from-deg 15"), (48, 15.0, 367.5));
    assert_eq!(of("--to-deg 15"), (3, 0.0, 15.0));
}

/// Coupler and rocker stretch out where the crank is upright: that end of the range has a position,
/// though no velocities.
#[test]
fn a_page_begins_with_its_first_position() {
    let text = "type = \"four-bar\"\n[geometry]\ncrank = \"3 m\"\ncoupler = \"2.5 m\"\n\
                rocker = \"2.5 m\"\nframe = \"4 m\"\n";
    let window = ["--from-deg", "-90", "--to-deg", "0", "--step-deg", "30"];
    let d = run_on(
        text,
        &[&["linkage", "-", "--format", "html"][..], &window].concat(),
    );
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(slider(&d.out), (vec![-90.0, -60.0, -30.0, 0.0], 0));
}
