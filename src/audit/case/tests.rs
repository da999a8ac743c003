use super::*;
use crate::planted::{Planted, hard, point, region};
use crate::{Near, SampleBox};
use std::panic::AssertUnwindSafe;

fn of(origin: Origin, input: &[f64]) -> Case {
    Case {
        method: "planted",
        region: "middle",
        input: input.to_vec(),
        origin,
    }
}

fn random(seed: u64, index: u64) -> Origin {
    Origin::Random { seed, index }
}

fn recorded(number: usize, folder: Option<&str>) -> Origin {
    let folder = folder.map(Into::into);
    Origin::Hard { number, folder }
}

fn boxed(text: &str, seed: u64, index: u64) -> Origin {
    let text = text.into();
    Origin::Box { text, seed, index }
}

fn near(text: &str, seed: u64, index: u64) -> Origin {
    Origin::Near {
        text: text.into(),
        radius: 0.5,
        seed,
        index,
    }
}

/// Two check points, three hard cases, two regions of two numbers.
fn method() -> Planted<'static> {
    let mut method = Planted {
        inputs: vec!["x", "y"],
        hard: [10.0, 11.0, 12.0].map(|x| hard(0.5, "x", &[x, 0.0])).into(),
        ..Planted::default()
    };
    method.domain.regions = vec![
        region("middle", |d| vec![d.uniform(1.0, 2.0), 0.0]),
        region("far", |d| vec![d.uniform(100.0, 200.0), 0.0]),
    ];
    method.domain.check_points = vec![point("one", &[1.0, 0.0]), point("two", &[2.0, 0.0])];
    method
}

fn settings(cases_per_region: u64) -> Settings {
    Settings {
        cases_per_region,
        seed: 7,
        ..Settings::default()
    }
}

fn in_box(text: &str) -> Planted<'static> {
    let mut method = method();
    method.sampling = Sampling::Box(SampleBox::read(&method, text).unwrap());
    method
}

fn about(text: &str) -> Planted<'static> {
    let mut method = method();
    method.sampling = Sampling::Near(Near::read(&method, &settings(4), text, 0.25).unwrap());
    method
}

/// Where a case comes from decides first, then its name or number; the input decides last.
#[test]
fn cases_have_an_order() {
    let inputs: [&[f64]; 2] = [&[1.0], &[1.0, 0.0]];
    let sorted = [
        of(Origin::CheckPoint { name: "a" }, &[9.0]),
        of(Origin::CheckPoint { name: "b" }, &[1.0]),
        of(recorded(1, None), &[1.0]),
        of(recorded(5, None), &[1.0]),
        of(recorded(5, Some("folder")), &[1.0]),
        of(random(1, 0), &[1.0]),
        of(random(2, 0), &[1.0]),
        of(random(1, 9), &[1.0]),
        of(Origin::Given, inputs[0]),
        of(Origin::Given, inputs[1]),
        of(Origin::Given, &[2.0]),
        // As bits: -0 is above every positive number.
        of(Origin::Given, &[-0.0]),
        of(Origin::Line { number: 0 }, &[1.0]),
        of(Origin::Line { number: 9 }, &[1.0]),
        of(boxed("b", 1, 0), &[1.0]),
        of(boxed("a", 2, 0), &[1.0]),
        of(boxed("b", 2, 0), &[1.0]),
        of(boxed("b", 1, 9), &[1.0]),
        of(near("b", 1, 0), &[1.0]),
        of(near("a", 2, 0), &[1.0]),
        of(near("b", 2, 0), &[1.0]),
        of(near("b", 1, 9), &[1.0]),
    ];
    for (i, a) in sorted.iter().enumerate() {
        for (j, b) in sorted.iter().enumerate() {
            assert_eq!(a.order(b), i.cmp(&j), "{a:?} {b:?}");
        }
    }
    let mut far = sorted[0].clone();
    far.region = "far";
    assert_eq!(far.order(&sorted[0]), Ordering::Less);
}

/// The points of a report are chosen by these numbers, which may never change.
#[test]
fn the_hash_is_pinned() {
    for (input, expected) in [
        (vec![], 0xf52a_15e9_a9b5_e89b),
        (vec![1.0], 0x2ea5_818f_ac93_304f),
        (vec![-0.0], 0xf5b6_f0ca_0bd5_52f0),
        (vec![0.1, -2.5], 0x9bef_e75a_4906_738f),
        (vec![0.1, -2.5, 5e-324], 0x7959_2178_0da5_2bc4_u64),
    ] {
        assert_eq!(of(Origin::Given, &input).hash(), expected, "{input:?}");
        // Neither origin nor region are part of it.
        assert_eq!(of(random(3, 4), &input).hash(), expected, "{input:?}");
    }
}

/// Up to sixteen numbers are written out, no more.
#[test]
fn brief_cases_leave_out_long_inputs() {
    struct Brief(Option<Case>);
    impl Serialize for Brief {
        fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
            briefly_if(&self.0, to)
        }
    }
    let json = |case| serde_json::to_value(Brief(case)).unwrap();
    let short = json(Some(of(random(1, 3), &[0.5; 16])));
    let expected = serde_json::json!({
        "region": "middle",
        "input": vec![0.5; 16],
        "origin": {"kind": "random", "seed": 1, "index": 3},
        "place": "--region middle --seed 1 --case 3",
    });
    assert_eq!(short, expected);
    let long = json(Some(of(random(1, 3), &[0.5; 17])));
    assert_eq!(long["input"], serde_json::Value::Null);
    assert_eq!(long["place"], expected["place"]);
    assert_eq!(json(None), serde_json::Value::Null);
}

#[test]
fn places_are_arguments() {
    for (origin, expected) in [
        (Origin::CheckPoint { name: "one" }, "--check-point one"),
        (recorded(3, None), "--hard-case 3"),
        (recorded(3, Some("a/b")), "--hard a/b --hard-case 3"),
        (recorded(3, Some("it's")), "--hard 'it'\\''s' --hard-case 3"),
        (recorded(3, Some("")), "--hard '' --hard-case 3"),
        (Origin::Given, "--at 0x1p+0,-0x1p-1"),
        (random(5, 8), "--region middle --seed 5 --case 8"),
        (
            boxed("x=1..2, y=0", 5, 8),
            "--box 'x=1..2, y=0' --seed 5 --case 8",
        ),
        (
            near("middle/3", 5, 8),
            "--near middle/3 --radius 0.5 --seed 5 --case 8",
        ),
    ] {
        let case = of(origin, &[1.0, -0.5]);
        assert_eq!(case.place(), expected);
        assert_eq!(
            case.reproduce(),
            format!("mechaudit audit planted {expected}")
        );
    }
    // A line belongs to a file, not to a method.
    let line = of(Origin::Line { number: 12 }, &[1.0]);
    assert_eq!(line.place(), "--line 12");
    assert_eq!(line.reproduce(), "line 12 of the inputs");
}

/// Check points, hard cases and each region's cases, every one once and where it is looked for by
/// name.
#[test]
fn cases_are_numbered() {
    let method = method();
    let cases = Cases::new(&method, &settings(4));
    assert_eq!((cases.len(), cases.is_empty()), (13, false));
    let all: Vec<Case> = (0..13).map(|i| cases.get(i)).collect();
    let origins: Vec<Origin> = all.iter().map(|c| c.origin.clone()).collect();
    let mut expected = vec![
        Origin::CheckPoint { name: "one" },
        Origin::CheckPoint { name: "two" },
    ];
    expected.extend((1..=3).map(|number| recorded(number, None)));
    expected.extend((0..8).map(|i| random(7, i % 4)));
    assert_eq!(origins, expected);
    let regions: Vec<&str> = all.iter().map(|c| c.region).collect();
    let expected = [
        ["check-points"; 2].as_slice(),
        &["hard"; 3],
        &["middle"; 4],
        &["far"; 4],
    ];
    assert_eq!(regions, expected.concat());
    let named: Vec<f64> = all[..5].iter().map(|c| c.input[0]).collect();
    assert_eq!(named, [1.0, 2.0, 10.0, 11.0, 12.0]);
    for (i, case) in all[5..].iter().enumerate() {
        let (lo, hi) = [(1.0, 2.0), (100.0, 200.0)][i / 4];
        let mut stream = Draw::new(7, "planted", case.region, i as u64 % 4);
        assert_eq!(case.input, [stream.uniform(lo, hi), 0.0]);
        let again = cases.in_region(case.region, i as u64 % 4).unwrap();
        assert_eq!((&again.input, &again.origin), (&case.input, &case.origin));
    }
    // Where the next region begins.
    let ends = [2, 2, 5, 5, 5, 9, 9, 9, 9, 13, 13, 13, 13];
    for (i, case) in all.iter().enumerate() {
        assert_eq!(cases.region_of(i), (case.region, ends[i]));
    }
    assert!(cases.at_index(0).is_none());
    assert!(std::panic::catch_unwind(AssertUnwindSafe(|| cases.get(13))).is_err());
}

#[test]
fn there_may_be_no_cases() {
    let mut method = method();
    let only_named = Cases::new(&method, &settings(0));
    assert_eq!((only_named.len(), only_named.is_empty()), (5, false));
    assert_eq!(only_named.get(4).input[0], 12.0);
    method.domain.check_points.truncate(1);
    method.hard.clear();
    let one = Cases::new(&method, &settings(0));
    assert_eq!((one.len(), one.is_empty()), (1, false));
    method.domain.check_points.clear();
    let none = Cases::new(&method, &settings(0));
    assert_eq!((none.len(), none.is_empty()), (0, true));
    // More than can be counted are as many as can be.
    let many = Cases::new(&method, &settings(u64::MAX));
    assert_eq!((many.len(), many.is_empty()), (usize::MAX, false));
    assert_eq!(many.region_of(3), ("middle", usize::MAX));
}

/// Hard cases are counted from one: neither zero nor one more than there are is one.
#[test]
fn hard_cases_are_found_by_number() {
    let mut method = method();
    method.hard[1].folder = Some("folder".into());
    let cases = Cases::new(&method, &settings(4));
    for (number, x, folder) in [(1, 10.0, None), (2, 11.0, Some("folder")), (3, 12.0, None)] {
        let case = cases.hard_case(number).unwrap();
        assert_eq!((case.region, case.input), ("hard", vec![x, 0.0]));
        assert_eq!(case.origin, recorded(number, folder));
    }
    for number in [0, 4, usize::MAX] {
        let e = cases.hard_case(number).unwrap_err();
        let expected = format!(
            "planted has no hard case \"{number}\"; it has: those of its file, counted from 1"
        );
        assert_eq!(e.to_string(), expected);
    }
    method.hard.clear();
    let e = Cases::new(&method, &settings(4)).hard_case(1).unwrap_err();
    let expected = "planted has no hard case \"1\"; it has: none";
    assert_eq!(e.to_string(), expected);
}

#[test]
fn names_that_there_are_not_are_refused() {
    let cases = Cases::new(&method(), &settings(4));
    let e = cases.at_check_point("on").unwrap_err().to_string();
    assert!(e.contains("planted has no check point \"on\""), "{e}");
    assert!(e.ends_with("it has: one, two"), "{e}");
    let e = cases.in_region("hard", 0).unwrap_err().to_string();
    assert!(e.contains("planted has no region \"hard\""), "{e}");
    assert!(e.ends_with("it has: middle, far"), "{e}");
    assert_eq!(cases.at_check_point("two").unwrap().input, [2.0, 0.0]);
}

/// A box of every number is one region; otherwise the regions take turns.
#[test]
fn a_box_has_regions_unless_it_is_whole() {
    let whole = Cases::new(&in_box("x=3..4, y=5"), &settings(4));
    assert_eq!(whole.len(), 4);
    for i in 0..4 {
        assert_eq!(whole.region_of(i), ("box", 4));
        let case = whole.get(i);
        assert!((3.0..4.0).contains(&case.input[0]) && case.input[1] == 5.0);
        assert_eq!(case.origin, boxed("x=3..4, y=5", 7, i as u64));
    }
    let part = Cases::new(&in_box("y=5"), &settings(4));
    assert_eq!(part.len(), 8);
    for i in 0..8 {
        let region = ["middle", "far"][i % 2];
        assert_eq!(part.region_of(i), (region, i + 1));
        let case = part.get(i);
        assert_eq!((case.region, case.input[1]), (region, 5.0));
        let again = part.at_index(i as u64).unwrap();
        assert_eq!((again.input, again.origin), (case.input, case.origin));
    }
    // Beyond the number of a run's cases one may be asked for by its index, not by its number.
    assert_eq!(part.at_index(8).unwrap().region, "middle");
    assert!(std::panic::catch_unwind(AssertUnwindSafe(|| part.get(8))).is_err());
}

#[test]
fn a_neighbourhood_is_one_region() {
    let cases = Cases::new(&about("two"), &settings(4));
    assert_eq!(cases.len(), 4);
    for i in 0..4 {
        assert_eq!(cases.region_of(i), ("near", 4));
        let case = cases.get(i);
        assert!((1.5..=2.5).contains(&case.input[0]));
        let expected = Origin::Near {
            text: "two".into(),
            radius: 0.25,
            seed: 7,
            index: i as u64,
        };
        assert_eq!((case.region, &case.origin), ("near", &expected));
        let again = cases.at_index(i as u64).unwrap();
        assert_eq!((again.input, again.origin), (case.input, case.origin));
    }
}

/// Numbers of a case are those of the format, wherever they come from.
#[test]
fn inputs_are_numbers_of_the_format() {
    let mut method = method();
    method.format = Format::Single;
    method.domain.check_points = vec![point("tenth", &[0.1, f64::NAN])];
    let cases = Cases::new(&method, &settings(4));
    assert_eq!(cases.get(0).input[0], f64::from(0.1f32));
    assert!(cases.get(0).input[1].is_nan());
    let drawn = (0..cases.len()).map(|i| cases.get(i).input[0]);
    assert!(drawn.into_iter().all(|x| f64::from(x as f32) == x));
}
