use super::*;
use crate::case::{Case, Cases};
use crate::planted::{Planted, point, region};
use crate::settings::Settings;
use crate::{Format, Variant};

/// Three numbers, the first of which counts.
fn plain() -> Planted<'static> {
    Planted {
        inputs: vec!["n", "x", "y"],
        domain: Domain {
            regions: vec![
                region("mid", |d| vec![3.0, d.uniform(1.0, 2.0), 0.0]),
                region("far", |d| vec![3.0, d.log_uniform(1e150, 1e200), 1.0]),
            ],
            check_points: vec![
                point("one", &[1.0, 1.0, 0.0]),
                point("infinite", &[1.0, f64::INFINITY, 0.0]),
            ],
        },
        data: |j| j > 0,
        ..Planted::default()
    }
}

fn settings(cases_per_region: u64) -> Settings {
    Settings {
        cases_per_region,
        ..Settings::default()
    }
}

fn boxed(text: &str) -> Result<Vec<Case>, SamplingError> {
    let plain = plain();
    let sides = SampleBox::read(&plain, text)?;
    let variant = Variant::new(&plain).sampling(Sampling::Box(sides));
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
    // Numbers that it does not name come from the regions, one after the other.
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
        ("x=+-log 0..1", "both ends are positive"),
        ("x=log -1..0", "both ends of one sign"),
        ("z=1..2", "has no input \"z\""),
        ("x=1..2,x=1..2", "names x twice"),
    ] {
        let e = boxed(text).unwrap_err().to_string();
        assert!(e.contains(part), "{text}: {e}");
    }
}

fn near(text: &str, radius: f64) -> Result<Vec<Case>, SamplingError> {
    let plain = plain();
    let near = Near::read(&plain, &settings(200), text, radius)?;
    let variant = Variant::new(&plain).sampling(Sampling::Near(near));
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
    let expected = Cases::new(&plain(), &settings(200))
        .in_region("mid", 5)
        .unwrap();
    assert!((drawn[0].input[1] / expected.input[1] - 1.0).abs() <= 1e-6);
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
        ("one", 1.0f64.next_up(), "the radius 1.0000000000000002"),
        ("one", 1.75, "the radius 1.75"),
    ] {
        let e = near(text, radius).unwrap_err().to_string();
        assert!(e.contains(part), "{text}: {e}");
    }
}

#[test]
fn single_precision_has_inputs_of_its_own() {
    let plain = plain();
    let variant = Variant::new(&plain).format(Format::Single);
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

/// A number of each spacing, as it follows from the stream of its case.
#[test]
fn sides_are_drawn_by_the_stream() {
    let drawn = |side: &str, at: fn(f64) -> f64| {
        let all = boxed(&format!("n=1,x=2,y={side}")).unwrap();
        for (index, case) in (0..).zip(&all) {
            // The third number of the box.
            let mut draw = Draw::new(1, "planted", "box", index);
            let [_, _, t] = [(); 3].map(|()| draw.unit());
            let (y, expected) = (case.input[2], at(t));
            assert!(
                (y - expected).abs() <= 1e-14 * expected.abs(),
                "{side}: {y} {expected}"
            );
            assert_eq!(case.input[..2], [1.0, 2.0]);
        }
    };
    drawn("3..7", |t| 3.0 + 4.0 * t);
    drawn("-7..-3", |t| -7.0 + 4.0 * t);
    drawn("5", |_| 5.0);
    drawn("log 0.25..64", |t| (8.0 * t - 2.0).exp2());
    drawn("log 2..64", |t| (5.0 * t + 1.0).exp2());
    drawn("log 0.25..0.5", |t| (t - 2.0).exp2());
    // The smallest of them is the first.
    drawn("log -64..-0.25", |t| -(8.0 * t - 2.0).exp2());
    let all = boxed("n=1,x=2,y=+-log 0.5..8").unwrap();
    for (index, case) in (0..).zip(&all) {
        let mut draw = Draw::new(1, "planted", "box", index);
        let [_, _, t] = [(); 3].map(|()| draw.unit());
        let size = (4.0 * t - 1.0).exp2();
        let expected = draw.signed(size);
        assert!((case.input[2] - expected).abs() <= 1e-14 * size);
    }
}

/// The order in which a box names its numbers changes nothing, and a region's numbers are those of
/// its own cases.
#[test]
fn a_box_draws_alike_however_it_is_written() {
    let input = |text: &str| -> Vec<Vec<f64>> {
        let all = boxed(text).unwrap().into_iter();
        all.map(|c| c.input).collect()
    };
    assert_eq!(input("x=1..2,y=3..4,n=5"), input("n=5,y=3..4,x=1..2"));
    let all = boxed("y=7").unwrap();
    let plain = plain();
    let cases = Cases::new(&plain, &settings(200));
    for (index, case) in (0..).zip(&all) {
        let region = if index % 2 == 0 { "mid" } else { "far" };
        let mut expected = cases.in_region(region, index / 2).unwrap().input;
        expected[2] = 7.0;
        assert_eq!((case.region, &case.input), (region, &expected));
    }
}

/// Without a region to draw the rest from, a box names every number.
#[test]
fn a_box_without_regions_is_whole() {
    let method = Planted {
        inputs: vec!["x", "y"],
        domain: Domain::default(),
        ..Planted::default()
    };
    let read = |text: &str| SampleBox::read(&method, text).map(|b| b.is_whole());
    assert_eq!(read("x=1,y=2"), Ok(true));
    assert_eq!(read("x=1"), Err(SamplingError::NoRegion));
    assert_eq!(
        SampleBox::read(&plain(), "x=1").map(|b| b.is_whole()),
        Ok(false)
    );
}

/// Neighbours as they follow from the stream of their case; radii up to one, down to any.
#[test]
fn neighbours_are_drawn_by_the_stream() {
    for radius in [1.0, 1e-3, 2f64.powi(-60)] {
        let all = near("4,-3,0", radius).unwrap();
        let least = if radius < 1e-15 { radius } else { f64::EPSILON };
        let mut far = 0;
        for (index, case) in (0..).zip(&all) {
            let mut draw = Draw::new(1, "planted", "near", index);
            let own = match draw.unit() < 0.5 {
                true => radius,
                false => draw.log_uniform(least, radius),
            };
            far += usize::from(own == radius);
            let t = [(); 3].map(|()| 2.0 * draw.unit() - 1.0);
            let expected = [4.0, -3.0 - 3.0 * (own * t[1]), own * t[2]];
            for (x, expected) in case.input.iter().zip(expected) {
                assert!(
                    (x - expected).abs() <= 1e-15 * expected.abs(),
                    "{radius}: {x} {expected}"
                );
            }
        }
        assert!((70..=200).contains(&far), "{far}");
    }
    let end = near(&format!("1,{:e},0", f64::MAX), 1.0).unwrap();
    assert!(end.iter().all(|c| c.input[1].is_finite()));
}

/// A region is told by its draws 0 to 63 of seed 0, each of which has to be ordinary.
#[test]
fn ordinary_regions_are_told_by_sixty_four_draws() {
    // Far away at the draw of that seed and index, and there alone.
    fn far_at(draw: &mut Draw, seed: u64, index: u64) -> Vec<f64> {
        let there = Draw::new(seed, "m", "r", index).unit();
        let far = draw.unit() == there;
        vec![1.0, if far { 1e200 } else { 2.0 }]
    }
    let ordinary = |sample: fn(&mut Draw) -> Vec<f64>| {
        let region = region("r", sample);
        region.is_ordinary("m")
    };
    assert!(!ordinary(|d| far_at(d, 0, 0)));
    assert!(!ordinary(|d| far_at(d, 0, 17)));
    assert!(!ordinary(|d| far_at(d, 0, 63)));
    assert!(ordinary(|d| far_at(d, 0, 64)));
    assert!(ordinary(|d| far_at(d, 1, 0)));
    for (x, expected) in [
        (0.0, true),
        (1e-100, true),
        (-1e100, true),
        (1e-100f64.next_down(), false),
        ((-1e100f64).next_down(), false),
        (f64::NAN, false),
    ] {
        assert_eq!(is_ordinary(&[1.0, x]), expected, "{x}");
    }
}
