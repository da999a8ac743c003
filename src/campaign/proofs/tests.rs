use super::*;
use crate::campaign::{Deal, Kind, Plan};
use crate::machine::Source;
use crate::proof::{Open, upper_half_plane};

fn part(within: f64) -> Part {
    let text = format!(
        "name = \"p\"\n[[part]]\nkind = \"proof\"\nmethods = [\"faddeeva\"]\nwithin = {within}"
    );
    let mut plan = Plan::read(&Source::toml(&text)).unwrap();
    assert_eq!(plan.parts[0].kind, Kind::Proof);
    assert_eq!(
        Deal::new(&plan, 5).units(),
        first_rectangles(Some(within)).len() as u64
    );
    plan.parts.swap_remove(0)
}

/// The parts together are the proof, in any order.
#[test]
fn parts_add_up_to_the_proof() {
    let part = part(0.01);
    let n = first_rectangles(part.within).len() as u64;
    let stop = AtomicBool::new(false);
    let found = |first: u64, step: u64| {
        let stride = Stride {
            first,
            step,
            end: n,
        };
        of(&part, stride, &|_| {}, &stop).unwrap()
    };
    let whole = found(0, 1);
    for order in [[0, 1, 2], [2, 0, 1]] {
        let mut sum = ProofTally::default();
        for k in order {
            let text = serde_json::to_string(&found(k, 3)).unwrap();
            sum.merge(serde_json::from_str(&text).unwrap());
        }
        assert_eq!(sum, whole);
    }
    let code = Code::of_the_solver().unwrap();
    let wanted = |_: usize, r: &Rectangle| r.is_below(Some(0.01));
    let expected = upper_half_plane(&code, UPPER_HALF_PLANE, &Watch::default(), wanted).unwrap();
    let expected = expected.summary().unwrap();
    assert_eq!((whole.parts, whole.open), (n, 0));
    assert_eq!(whole.boxes(), expected.boxes as u64);
    let of = |m: &str| whole.bound(m);
    assert_eq!(of("norm"), expected.norm.bound);
    assert_eq!(of("re").max(of("im")), expected.component.unwrap().bound);
    let v = whole.json();
    assert_eq!(
        (&v["passed"], &v["boxes"]),
        (&json!(true), &json!(expected.boxes))
    );
    assert_eq!(v["norm"]["bound"], json!(expected.norm.bound));
}

/// A rectangle without a bound is counted, named, and no pass.
#[test]
fn open_rectangles_are_told() {
    let mut sum = ProofTally::default();
    let mut all = Certificate::default();
    for k in (0..30).rev() {
        let at = Rectangle {
            a: [f64::from(k), f64::from(k + 1)],
            b: [0.0, 1.0],
        };
        let why = "several formulas";
        let open = vec![Open { at, why }];
        all.open.extend(open.clone());
        sum.merge(ProofTally::of(&Certificate {
            open,
            ..Certificate::default()
        }));
    }
    // They may as well be parts of one rectangle.
    let one = ProofTally::of(&all);
    assert_eq!((one.parts, one.open), (1, 30));
    assert_eq!(one.first_open, sum.first_open);
    let v = sum.json();
    assert_eq!((&v["passed"], &v["open"]), (&json!(false), &json!(30)));
    let first = v["first_open"].as_array().unwrap();
    assert_eq!(first.len(), OPEN);
    assert_eq!(first[0]["box"]["re"][1], json!("0x1p+0"));
    assert_eq!((v["norm"].is_null(), sum.bound("norm")), (true, 0.0));
}

#[test]
fn what_is_no_part_of_a_proof_is_refused() {
    for (method, more, expected) in [
        ("erf", "", "not of erf"),
        ("faddeeva", "within = 1e-9", "no rectangle"),
        ("faddeeva", "within = -1.0", "positive"),
        ("faddeeva", "cases = 5", "cases belong"),
        ("faddeeva", "seeds = [2]", "methods and within alone"),
        (
            "faddeeva",
            "regions = [\"mid\"]",
            "methods and within alone",
        ),
        ("faddeeva", "ulps = 3.0", "methods and within alone"),
    ] {
        let text =
            format!("name = \"p\"\n[[part]]\nkind = \"proof\"\nmethods = [\"{method}\"]\n{more}");
        let why = Plan::read(&Source::toml(&text)).unwrap_err().to_string();
        assert!(why.contains(expected), "{why}");
    }
    let other = "name = \"p\"\n[[part]]\nmethods = [\"erf\"]\ncases = 1\nwithin = 2.0";
    let why = Plan::read(&Source::toml(other)).unwrap_err().to_string();
    assert!(why.contains("within belongs"), "{why}");
}

/// Made up: two rectangles of one formula, one of another without a bound of its imaginary part.
fn made_up() -> Certificate {
    let leaf = |at: Rectangle, terms: u32, [norm, re, im, tiny]: [f64; 4]| Leaf {
        at,
        formula: match terms {
            0 => crate::proof::Formula::Strip,
            n => crate::proof::Formula::Asymptotic { terms: n as _ },
        },
        bound: crate::proof::Bound { norm, re, im, tiny },
    };
    let at = |a: f64| Rectangle {
        a: [a, a + 1.0],
        b: [0.0, 0.5],
    };
    Certificate {
        leaves: vec![
            leaf(at(1.0), 4, [0.5, 1.5, 2.5, 0.0]),
            leaf(at(2.0), 4, [0.75, 1.0, 2.5, 3.0]),
            leaf(at(4.0), 0, [0.25, 3.0, f64::INFINITY, 1.0]),
        ],
        open: Vec::new(),
    }
}

#[test]
fn the_largest_bounds_are_kept_with_their_rectangles() {
    let found = made_up();
    let tally = ProofTally::of(&found);
    assert_eq!((tally.parts, tally.open, tally.boxes()), (1, 0, 3));
    assert_eq!(
        (tally.bound("norm"), tally.bound("im")),
        (0.75, f64::INFINITY)
    );
    let v = tally.json();
    let shown = |from: &str, to: &str| json!({ "re": [from, to], "im": ["0x0p+0", "0x1p-1"] });
    let first = shown("0x1p+0", "0x1p+1");
    let second = shown("0x1p+1", "0x1.8p+1");
    let third = shown("0x1p+2", "0x1.4p+2");
    assert_eq!(v["norm"], json!({ "bound": 0.75, "box": second }));
    // No bound is the largest of all.
    assert_eq!(v["component"], json!({ "bound": null, "box": third }));
    assert_eq!(
        (&v["tiny"], &v["boxes"], &v["open"]),
        (&json!(3.0), &json!(3), &json!(0))
    );
    assert_eq!(
        (&v["passed"], &v["proved"], &v["rectangles"]),
        (&json!(true), &json!(true), &json!(1))
    );
    let expected = json!([
        {
            "formula": "asymptotic, 4 terms",
            "boxes": 2,
            "norm": { "bound": 0.75, "box": second },
            "re": { "bound": 1.5, "box": first },
            // Of equal bounds the first rectangle.
            "im": { "bound": 2.5, "box": first },
            "tiny": 3.0,
        },
        {
            "formula": "strip",
            "boxes": 1,
            "norm": { "bound": 0.25, "box": third },
            "re": { "bound": 3.0, "box": third },
            "im": { "bound": null, "box": third },
            "tiny": 1.0,
        },
    ]);
    assert_eq!(v["formulas"], expected);
    let names: Vec<&str> = tally.formulas().map(|(name, _)| name).collect();
    assert_eq!(names, ["asymptotic, 4 terms", "strip"]);
}

/// Whatever order rectangles come in, their sum is that of all together, but for the number of
/// parts.
#[test]
fn rectangles_add_up_in_any_order() {
    let whole = made_up();
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let mut sum = ProofTally::default();
        for k in order {
            sum.merge(ProofTally::of(&Certificate {
                leaves: vec![whole.leaves[k]],
                open: Vec::new(),
            }));
        }
        assert_eq!(sum.parts, 3);
        sum.parts = 1;
        assert_eq!(sum, ProofTally::of(&whole), "{order:?}");
    }
    let nothing = ProofTally::default();
    assert_eq!(
        (nothing.bound("norm"), nothing.bound("re"), nothing.boxes()),
        (0.0, 0.0, 0)
    );
    assert!(nothing.json()["tiny"].is_null());
}

/// The first rectangle and one a third of the way on.
#[test]
fn two_rectangles_are_probed() {
    let part = part(0.01);
    let n = first_rectangles(part.within).len() as u64;
    let stop = AtomicBool::new(false);
    let counted = std::sync::atomic::AtomicU64::new(0);
    let tell = |more: u64| {
        counted.fetch_add(more, Ordering::Relaxed);
    };
    let one = |first: u64| {
        let stride = Stride {
            first,
            step: n,
            end: n,
        };
        of(&part, stride, &tell, &stop).unwrap()
    };
    let expected = format!("{n} {:?}\n", [one(0), one(n / 3)]);
    assert!(n > 6 && probe(&part) == expected);
    assert_eq!(counted.into_inner(), 2);
    let none = Stride {
        first: n,
        step: 1,
        end: n,
    };
    assert_eq!(
        of(&part, none, &|_| panic!("there is none"), &stop).unwrap(),
        ProofTally::default()
    );
}

/// The parts of a study's domain together are a proof over all of it, whatever shard they are in.
#[test]
fn a_study_is_proved_in_parts() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("square.fpcore");
    std::fs::write(
        &file,
        "(FPCore (x y) :pre (and (<= 1 x 2) (<= 0 y 4)) (- (* x y) (* 0.1 y)))",
    )
    .unwrap();
    let file = file.to_str().unwrap();
    let text = format!("name = \"p\"\n[[part]]\nkind = \"proof\"\nmethods = [\"{file}\"]");
    let plan = Plan::read(&Source::toml(&text)).unwrap();
    let n = Deal::new(&plan, 3).units();
    assert_eq!(n, PARTS as u64);
    let part = &plan.parts[0];
    let stop = AtomicBool::new(false);
    let found = |first: u64, step: u64| {
        let stride = Stride {
            first,
            step,
            end: n,
        };
        of(part, stride, &|_| {}, &stop).unwrap()
    };
    let whole = found(0, 1);
    let mut sum = found(2, 3);
    sum.merge(found(0, 3));
    sum.merge(found(1, 3));
    assert_eq!(sum, whole);
    let program = &Study::open(file).unwrap();
    let solver = &program.problem().solvers[0];
    let program = program
        .problem()
        .program(solver, &[0], solver.setting(), None)
        .unwrap();
    let limits = Limits {
        boxes: 2_000,
        target: 0.0,
    };
    for (name, measure) in MEASURES {
        let alone = prove(&program, measure, &limits, &Watch::default())
            .unwrap()
            .bound;
        let bound = whole.bound(name);
        let near = bound <= 1.001 * alone && bound >= 0.99 * alone;
        assert!(
            near || (bound == alone && bound.is_infinite()),
            "{name}: {bound:e}, {alone:e}"
        );
    }
    let v = whole.json();
    assert_eq!((&v["proved"], &v["parts"]), (&json!(true), &json!(n)));
    assert!(
        v["formulas"][0]["absolute"]["box"]["y"].is_array() && v["relative"]["bound"].is_null()
    );
    assert_eq!(probe(part), probe(part));
}
