use super::*;
use crate::answer::{ReferenceAnswer, SolverAnswer};
use crate::case::Cases;
use crate::{CheckPoint, Format, Input, Law, Output, Variant};
use rug::Rational;

/// Three numbers, the first of which counts.
struct Plain;

impl Method for Plain {
    fn name(&self) -> &'static str {
        "plain"
    }
    fn summary(&self) -> &'static str {
        ""
    }
    fn source(&self) -> &'static str {
        ""
    }
    fn inputs(&self) -> Vec<Input> {
        ["n", "x", "y"]
            .map(|name| Input { name, unit: "1" })
            .to_vec()
    }
    fn outputs(&self) -> Vec<Output> {
        Vec::new()
    }
    fn domain(&self) -> Domain {
        let region = |name, sample| Region {
            name,
            description: "",
            sample,
        };
        Domain {
            regions: vec![
                region("mid", |d| vec![3.0, d.uniform(1.0, 2.0), 0.0]),
                region("far", |d| vec![3.0, d.log_uniform(1e150, 1e200), 1.0]),
            ],
            check_points: vec![
                CheckPoint {
                    name: "one",
                    input: vec![1.0, 1.0, 0.0],
                },
                CheckPoint {
                    name: "infinite",
                    input: vec![1.0, f64::INFINITY, 0.0],
                },
            ],
        }
    }
    fn solve(&self, _: &[f64]) -> SolverAnswer {
        SolverAnswer::Declines(None)
    }
    fn reference(&self, _: &[Rational], _: u32) -> ReferenceAnswer {
        ReferenceAnswer::Refuses("always")
    }
    fn is_data(&self, j: usize) -> bool {
        j > 0
    }
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
}

fn settings(cases_per_region: u64) -> Settings {
    Settings {
        cases_per_region,
        ..Settings::default()
    }
}

fn boxed(text: &str) -> Result<Vec<Case>, SamplingError> {
    let sides = SampleBox::read(&Plain, text)?;
    let variant = Variant::new(&Plain).sampling(Sampling::Box(sides));
    let cases = Cases::new(&variant, &settings(200));
    Ok((0..cases.len()).map(|i| cases.get(i)).collect())
}

#[test]
fn boxes() {
    let all = boxed("n=2, x=-6..0,y=+-log 0x1p-20..8").unwrap();
    assert_eq!(all.len(), 200);
    let (mut negative, mut small) = (0, 0);
    for case in &all {
        let [n, x, y] = case.input[..] else { panic!() };
        assert_eq!((n, case.region), (2.0, "box"));
        assert!((-6.0..=0.0).contains(&x) && (2f64.powi(-20)..=8.0).contains(&y.abs()));
        negative += u32::from(y < 0.0);
        small += u32::from(y.abs() < 0.01);
    }
    assert!((60..140).contains(&negative) && (60..160).contains(&small));
    assert_eq!(
        all[17].place(),
        "--box 'n=2, x=-6..0,y=+-log 0x1p-20..8' --seed 1 --case 17"
    );
    // What it does not name comes from the regions, one after the other.
    let all = boxed("y=log -1e3..-1").unwrap();
    assert_eq!(all.len(), 400);
    assert!(all.iter().all(|c| (-1e3..=-1.0).contains(&c.input[2])));
    let x = |k: usize| (all[k].region, all[k].input[1]);
    assert!(x(0).0 == "mid" && x(0).1 < 2.0 && x(1).0 == "far" && x(1).1 > 1e149);
    // The widest box there is.
    let wide = format!("n=1,x={:e}..{:e},y=0", f64::MIN, f64::MAX);
    assert!(boxed(&wide).unwrap().iter().all(|c| c.input[1].is_finite()));
}

#[test]
fn what_is_no_box() {
    for (text, part) in [
        ("", "is not NAME=LO..HI"),
        ("x", "is not NAME=LO..HI"),
        ("x=1..two", "is not NAME=LO..HI"),
        ("x=1..inf", "is not NAME=LO..HI"),
        ("x=2..1", "the lower end comes first"),
        ("x=log -1..1", "both ends of one sign"),
        ("x=log 0..1", "both ends of one sign"),
        ("x=+-log -2..-1", "both ends are positive"),
        ("z=1..2", "has no single input \"z\""),
        ("x=1..2,x=1..2", "names x twice"),
    ] {
        let e = boxed(text).unwrap_err().to_string();
        assert!(e.contains(part), "{text}: {e}");
    }
}

fn near(text: &str, radius: f64) -> Result<Vec<Case>, SamplingError> {
    let near = Near::read(&Plain, &settings(200), text, radius)?;
    let variant = Variant::new(&Plain).sampling(Sampling::Near(near));
    let cases = Cases::new(&variant, &settings(200));
    Ok((0..cases.len()).map(|i| cases.get(i)).collect())
}

#[test]
fn neighbourhoods() {
    for (text, x) in [("7,-3,0", -3.0), ("one", 1.0)] {
        let all = near(text, 1e-3).unwrap();
        assert_eq!(all.len(), 200);
        let distance = |c: &Case| ((c.input[1] - x) / x).abs();
        assert!(
            all.iter()
                .all(|c| distance(c) <= 1e-3 && c.input[2].abs() <= 1e-3)
        );
        // Counts stay, and some come very near.
        assert!(all.iter().all(|c| c.input[0] == all[0].input[0]));
        assert!(all.iter().filter(|c| distance(c) < 1e-9).count() > 20);
        assert!(all.iter().filter(|c| distance(c) > 1e-4).count() > 50);
    }
    let drawn = near("mid/5", 1e-6).unwrap();
    let due = Cases::new(&Plain, &settings(200))
        .in_region("mid", 5)
        .unwrap();
    assert!((drawn[0].input[1] / due.input[1] - 1.0).abs() <= 1e-6);
    assert_eq!(
        drawn[3].place(),
        "--near mid/5 --radius 0.000001 --seed 1 --case 3"
    );
    for (text, radius, part) in [
        ("1,2", 0.1, "2 numbers where 3 are due"),
        ("nowhere", 0.1, "has no check point"),
        ("infinite", 0.1, "has no neighbours"),
        ("one", 0.0, "the radius 0"),
        ("one", f64::NAN, "the radius NaN"),
    ] {
        let e = near(text, radius).unwrap_err().to_string();
        assert!(e.contains(part), "{text}: {e}");
    }
}

#[test]
fn ordinary_is_away_from_the_ends() {
    let domain = Variant::new(&Plain).ordinary().domain();
    let names: Vec<&str> = domain.regions.iter().map(|r| r.name).collect();
    let points: Vec<&str> = domain.check_points.iter().map(|p| p.name).collect();
    assert_eq!((names, points), (vec!["mid"], vec!["one"]));
}

#[test]
fn single_precision_has_inputs_of_its_own() {
    let variant = Variant::new(&Plain).format(Format::Single);
    let cases = Cases::new(&variant, &settings(50));
    for i in 0..cases.len() {
        let input = cases.get(i).input;
        let held = |x: &f64| f64::from(*x as f32) == *x;
        assert!(input.iter().all(held), "{input:?}");
    }
    // Beyond its range: the end of it.
    let far = cases.in_region("far", 0).unwrap();
    assert_eq!(far.input[1], f64::from(f32::MAX));
}
