//! Stored tallies: every member comes back, and what is none is refused.

use super::*;
use crate::judged::judge_case;
use crate::planted::off as shifted;
use serde_json::Value;

fn settings() -> Settings {
    Settings {
        points: 3,
        conditions: true,
        ..Settings::default()
    }
}

/// Two outputs with condition numbers, a recorded excess at 1, a reference that is open at 3 and
/// fails at 4, a law.
fn method<'a>() -> Planted<'a> {
    Planted {
        outputs: vec![output("x", Limit::Ulps(4.0)), output("y", Limit::Ulps(4.0))],
        reference: Box::new(|x, bits| match x[0].to_f64() {
            3.0 => ReferenceAnswer::Undecided("planted".into()),
            4.0 => ReferenceAnswer::Failed("planted".into()),
            _ => ReferenceAnswer::exact([&x[0], &x[0]], bits),
        }),
        conditions: Box::new(|x| Some(vec![3.0 * x[0], 5.0 * x[0]])),
        hard: vec![planted::hard(2.0, "x", &[1.0])],
        laws: vec![
            Law {
                name: "first",
                statement: "planted",
                residual: |_| None,
            },
            Law {
                name: "second",
                statement: "planted",
                residual: |_| None,
            },
        ],
        ..Planted::default()
    }
}

/// One case of each verdict, two of those that could be mistaken for none.
fn whole() -> Tally {
    let method = method();
    let mut tally = Tally::lean(&method, &settings());
    let all = [
        (0, 1.0, 7, 0),
        (1, 1.0, 8, 1),
        (2, 2.0, 1, 2),
        (3, 2.5, 9, 0),
        (4, 3.0, 0, 0),
        (5, 3.0, 0, 0),
        (6, 4.0, 0, 0),
        (7, 4.0, 0, 0),
        (8, 4.0, 0, 0),
    ];
    for (i, x, a, b) in all {
        let case = planted::case(i, &[x]);
        let answer = SolverAnswer::Values(vec![shifted(x, a), shifted(x, b)]);
        tally.add(&judge_case(&method, case, answer, &settings()));
    }
    // An error beyond the range of f64.
    let mut far = judge_case(
        &method,
        planted::case(9, &[2.0]),
        SolverAnswer::Values(vec![2.0, 1.0]),
        &settings(),
    );
    far.judgement.components[1].ulps = f64::INFINITY;
    far.judgement.normwise = f64::INFINITY;
    tally.add(&far);
    let at = |i| planted::case(i, &[2.0]);
    tally.laws(&at(2), &[Some(0.25), Some(0.0)]);
    tally.laws(&at(5), &[Some(0.75), None]);
    tally
}

fn read(stored: Value) -> Result<Tally, String> {
    let read: StoredTally = serde_json::from_value(stored).map_err(|e| e.to_string())?;
    Tally::restored(&method(), &settings(), read).map_err(|e| e.to_string())
}

fn written(tally: &Tally) -> Value {
    serde_json::to_value(tally.stored()).unwrap()
}

#[test]
fn every_member_comes_back() {
    let tally = whole();
    let again = read(written(&tally)).unwrap();
    assert_eq!(written(&again), written(&tally));
    assert_eq!(again.stored(), tally.stored());
    let (expected, found) = (tally.finish(&method()), again.finish(&method()));
    let total = &found.total;
    let counts = [
        found.cases,
        found.passed,
        found.recorded,
        total.over,
        total.undecided,
        total.reference_failed,
        total.kinds.total(),
    ];
    assert_eq!(counts, [10, 1, 2, 2, 2, 3, 0]);
    assert_eq!(
        (total.cases, expected.failed()),
        (expected.total.cases, found.failed())
    );
    for (a, b) in expected.total.outputs.iter().zip(&total.outputs) {
        assert_eq!((a.ulps, a.conditioned), (b.ulps, b.conditioned));
        assert_eq!((a.values, a.kinds), (b.values, b.kinds));
        assert_eq!(a.max_condition, b.max_condition);
        assert_eq!(a.max_of_budget, b.max_of_budget);
    }
    let [x, y] = total.outputs.as_slice() else {
        panic!("two outputs")
    };
    assert!((3.0..3.0 + 1e-9).contains(&x.max_condition));
    assert!((5.0..5.0 + 1e-9).contains(&y.max_condition));
    assert_eq!((x.ulps.beyond, y.ulps.beyond, y.ulps.count), (0, 1, 4));
    assert_eq!(x.conditioned.count, 5);
    assert_eq!(total.normwise.unwrap().beyond, 1);
    assert_eq!(total.normwise, expected.total.normwise);
    assert_eq!(total.max_of_budget, expected.total.max_of_budget);
    assert_eq!(found.points.len(), 3);
    let law = |k: usize| {
        let law = &found.laws[k];
        let place = law.worst_case.as_ref().map(Case::place);
        (law.name, law.cases, law.worst, place)
    };
    let place = planted::case(5, &[2.0]).place();
    assert_eq!(law(0), ("first", 2, 0.75, Some(place)));
    assert_eq!(law(1), ("second", 1, 0.0, None));
}

/// Floats are the same by their bits alone.
#[test]
fn stored_floats_are_equal_by_their_bits() {
    let with = |worst: &str| {
        let mut stored = written(&whole());
        stored["laws"][0]["worst"] = worst.into();
        let stored: StoredTally = serde_json::from_value(stored).unwrap();
        stored
    };
    let bits = |x: f64| format!("{:016x}", x.to_bits());
    assert_eq!(with(&bits(0.75)), whole().stored());
    assert_ne!(with(&bits(0.75f64.next_up())), whole().stored());
    assert_ne!(with(&bits(0.0)), with(&bits(-0.0)));
    assert_eq!(with(&bits(f64::NAN)), with(&bits(f64::NAN)));
}

/// Laws are found by their names, in whichever order, and only those of the method.
#[test]
fn stored_laws_are_found_by_their_names() {
    let mut stored = written(&whole());
    let laws = stored["laws"].as_array_mut().unwrap();
    laws.reverse();
    assert_eq!(written(&read(stored.clone()).unwrap()), written(&whole()));
    stored["laws"][1]["name"] = "third".into();
    let e = read(stored).err().unwrap();
    assert_eq!(e, "the method has no law \"third\"");
    let mut stored = written(&whole());
    stored["laws"][0]["worst_case"][0] = "nowhere".into();
    let e = read(stored).err().unwrap();
    assert_eq!(e, "the method has no region \"nowhere\"");
}

/// Of two equal residuals the one whose case is known is kept, whichever comes first.
#[test]
fn a_case_that_is_known_is_kept() {
    let mut stored = written(&whole());
    stored["laws"][0]["worst_case"] = Value::Null;
    let (known, unknown) = (whole(), read(stored).unwrap());
    let both = [
        (known.clone(), unknown.clone()),
        (unknown.clone(), known.clone()),
        (known.clone(), known),
    ];
    for (mut sum, other) in both {
        sum.merge(other);
        let law = &sum.finish(&method()).laws[0];
        assert_eq!((law.cases, law.worst), (4, 0.75));
        let place = law.worst_case.as_ref().map(Case::place);
        assert_eq!(place, Some(planted::case(5, &[2.0]).place()));
    }
    let mut none = unknown.clone();
    none.merge(unknown);
    let law = &none.finish(&method()).laws[0];
    assert!(law.worst == 0.75 && law.worst_case.is_none());
}

/// Too few outputs, half a bin, and more cases than are kept are none of a tally.
#[test]
fn what_no_tally_holds_is_refused() {
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut stored = written(&whole());
        change(&mut stored["regions"][0]);
        read(stored).err()
    };
    assert_eq!(refused(&|_| ()), None);
    let outputs = refused(&|r| drop(r["outputs"].as_array_mut().unwrap().pop()));
    assert_eq!(outputs.unwrap(), "a number of outputs that no tally holds");
    let bins = refused(&|r| {
        let bins = &mut r["outputs"][0]["ulps"]["bins"];
        bins.as_array_mut().unwrap().push(1.into());
    });
    assert_eq!(bins.unwrap(), "a spread that no tally holds");
    let worst = refused(&|r| {
        let worst = r["worst"].as_array_mut().unwrap();
        let one = worst[0].clone();
        worst.resize(WORST + 1, one);
    });
    assert_eq!(worst.unwrap(), "more cases that no tally holds");
    let points = refused(&|r| {
        let points = r["points"].as_array_mut().unwrap();
        let one = points[0].clone();
        points.push(one);
    });
    assert_eq!(points.unwrap(), "more cases that no tally holds");
}
