//! Tests that a variant changes what it names and nothing else.

use super::*;
use crate::planted::{Planted, hard, output, point, region};
use crate::{Proof, ProvedError, SampleBox};
use rug::Float;

const PROVED: ProvedBound = ProvedBound {
    error: ProvedError::Ulps(2.0),
    inputs: "all",
    command: "planted",
};

/// Two outputs, three regions, and something of everything else.
fn method<'a>() -> Planted<'a> {
    Planted {
        inputs: vec!["x", "k"],
        outputs: vec![output("x", Limit::Ulps(4.0)), output("y", Limit::Ulps(8.0))],
        rows: Some(Rows {
            index: "k",
            count: "2",
            meaning: "planted",
        }),
        norm: Some(NormBudget::new(3.0, "planted")),
        proved: vec![PROVED],
        domain: Domain {
            regions: vec![
                region("near", |d| vec![d.uniform(1.0, 2.0), 0.0]),
                region("far", |d| vec![d.log_uniform(1e150, 1e200), 0.0]),
                region("next", |d| vec![d.uniform(2.0, 3.0), 0.0]),
            ],
            check_points: vec![point("one", &[1.0, 0.0]), point("end", &[1e300, 0.0])],
        },
        hard: vec![hard(2.0, "x", &[1.5, 0.0]), hard(0.5, "y", &[1e-300, 0.0])],
        laws: vec![Law {
            name: "law",
            statement: "planted",
            residual: |_| Some(0.0),
        }],
        solve: Box::new(|x| SolverAnswer::Values([1.0, 2.0, 3.0, 4.0].map(|k| k * x[0]).to_vec())),
        reference: Box::new(|_, bits| ReferenceAnswer::bounded(balls(bits), "planted")),
        not_finite: Box::new(|_| {
            let number = Expected::Number(Ball::integer(64, 3));
            let expected = vec![
                Expected::Infinity { negative: true },
                Expected::NotANumber,
                number,
                Expected::zero(true),
            ];
            ReferenceAnswer::Expected(expected, Proof::Bounded("not finite"))
        }),
        signs: Box::new(|_| vec![Some(true), None, Some(false), Some(true)]),
        conditions: Box::new(|x| Some([1.0, 2.0, 3.0, 4.0].map(|k| 10.0 * k * x[0]).to_vec())),
        beside: Some(Box::new(|_| Some(vec![7.0; 4]))),
        twin: Box::new(|_| Some(balls(64))),
        branch: Box::new(|x| {
            Some(BranchAt {
                branch: None,
                seam: "x = 2".into(),
                distance: 2.0 - x[0],
            })
        }),
        admits: Box::new(|x| x[0] < 2.0),
        data: |k| k == 0,
        ..Planted::default()
    }
}

fn balls(bits: u32) -> Vec<Ball> {
    (1..=4)
        .map(|k| Ball::new(Float::with_val(bits, k), mechaudit_reference::Mag::ZERO))
        .collect()
}

fn mids(balls: &[Ball]) -> Vec<f64> {
    balls.iter().map(|b| b.mid().to_f64()).collect()
}

fn values(answer: ReferenceAnswer) -> Vec<f64> {
    match answer {
        ReferenceAnswer::Values(r) if r.proof == Proof::Bounded("planted") => mids(&r.values),
        other => panic!("{other:?}"),
    }
}

fn shown(answer: ReferenceAnswer) -> String {
    match answer {
        ReferenceAnswer::Expected(expected, Proof::Bounded("not finite")) => {
            let each = expected.iter().map(|d| d.to_decimal(3).unwrap());
            each.collect::<Vec<_>>().join(" ")
        }
        other => panic!("{other:?}"),
    }
}

fn regions(method: &dyn Method) -> Vec<&'static str> {
    let domain = method.domain().regions.into_iter();
    domain.map(|r| r.name).collect()
}

fn points(method: &dyn Method) -> Vec<&'static str> {
    let domain = method.domain().check_points.into_iter();
    domain.map(|p| p.name).collect()
}

fn shares(method: &dyn Method) -> Vec<f64> {
    method.hard().iter().map(|h| h.share).collect()
}

fn limits(method: &dyn Method) -> Vec<(&'static str, Limit)> {
    let outputs = method.outputs().into_iter();
    outputs.map(|o| (o.name, o.budget.limit)).collect()
}

const OWN: [(&str, Limit); 2] = [("x", Limit::Ulps(4.0)), ("y", Limit::Ulps(8.0))];

#[test]
fn unchanged_it_is_the_method() {
    let own = method();
    let variant = Variant::new(&own);
    let same: &dyn Method = &variant;
    assert_eq!(
        (same.name(), same.summary(), same.source()),
        ("planted", "a planted method", "a planted source")
    );
    let names: Vec<&str> = same.inputs().iter().map(|i| i.name).collect();
    assert_eq!(names, ["x", "k"]);
    assert_eq!(limits(same), OWN);
    assert_eq!(same.rows(), own.rows);
    assert_eq!(same.norm_budget(), own.norm);
    assert_eq!(same.proved(), [PROVED]);
    assert_eq!(regions(same), ["near", "far", "next"]);
    assert_eq!(points(same), ["one", "end"]);
    assert_eq!(same.sampling(), Sampling::Domain);
    let solved = SolverAnswer::Values(vec![1.5, 3.0, 4.5, 6.0]);
    assert_eq!(same.solve(&[1.5]), solved);
    assert_eq!(values(same.reference(&[], 64)), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(shown(same.reference_not_finite(&[])), "-inf nan 3.00 -0");
    let signs = [Some(true), None, Some(false), Some(true)];
    assert_eq!(same.signs_of_zero(&[]), signs);
    assert_eq!(same.conditions(&[0.5]), Some(vec![5.0, 10.0, 15.0, 20.0]));
    let reference = same.reference(&[], 64);
    let beside = same.conditions_beside(&[0.5], &reference);
    assert_eq!(beside, Some(vec![7.0; 4]));
    assert_eq!(mids(&same.twin(&[]).unwrap()), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(same.format(), Format::Double);
    assert_eq!(same.branch(&[0.5]).unwrap().distance, 1.5);
    assert!(same.is_data(0) && !same.is_data(1));
    assert_eq!(shares(same), [2.0, 0.5]);
    assert!(same.admits(&[1.0]) && !same.admits(&[2.0]));
    let laws: Vec<&str> = same.laws().iter().map(|l| l.name).collect();
    assert_eq!(laws, ["law"]);
}

/// A refusal and a reference that does not decide pass through.
#[test]
fn what_are_no_values_are_not_selected_from() {
    let own = Planted {
        solve: Box::new(|_| SolverAnswer::Refuses("planted")),
        reference: Box::new(|_, _| ReferenceAnswer::Undecided("planted".into())),
        conditions: Box::new(|_| None),
        ..method()
    };
    let one = Variant::new(&own).outputs(&["y"]).unwrap();
    assert_eq!(one.solve(&[1.0]), SolverAnswer::Refuses("planted"));
    let reference = one.reference(&[], 64);
    assert!(matches!(reference, ReferenceAnswer::Undecided(w) if w == "planted"));
    assert_eq!(one.conditions(&[1.0]), None);
}

#[test]
fn another_solver_has_no_laws_proof_or_twin() {
    let own = method();
    let other = Variant::new(&own).solver(|x| SolverAnswer::Values(vec![x[0] / 2.0]));
    assert_eq!(other.solve(&[3.0]), SolverAnswer::Values(vec![1.5]));
    assert!(other.laws().is_empty() && other.proved().is_empty());
    assert!(other.twin(&[]).is_none());
    // Records of hard cases, the domain and the budgets stay.
    assert_eq!(shares(&other), [2.0, 0.5]);
    assert_eq!(points(&other), ["one", "end"]);
    assert_eq!(limits(&other), OWN);
    // The answer is the other code's alone, whatever is selected.
    let other = other.outputs(&["y"]).unwrap();
    assert_eq!(other.solve(&[3.0]), SolverAnswer::Values(vec![1.5]));
    let same = Variant::new(&own).without_laws();
    assert!(same.laws().is_empty() && same.proved().is_empty());
    assert!(same.twin(&[]).is_some());
}

#[test]
fn only_regions_asked_for() {
    let own = method();
    let one = Variant::new(&own).region("next").unwrap();
    assert_eq!(regions(&one), ["next"]);
    assert!(points(&one).is_empty() && one.hard().is_empty());
    let two = one.region("near").unwrap();
    assert_eq!(regions(&two), ["near", "next"]);
    let e = two.region("nxt").err().unwrap();
    assert_eq!((e.what, e.name.as_str()), ("region", "nxt"));
    assert_eq!(e.known, ["near", "far", "next"]);
}

/// With user-supplied regions the numbers are the method's, and nothing of its domain stays.
#[test]
fn in_regions_of_ones_own() {
    let own = method();
    let elsewhere = region("elsewhere", |d| vec![d.uniform(5.0, 6.0), 0.0]);
    let right = Variant::new(&own).placed(vec![elsewhere], |x| x[0] > 0.0);
    assert_eq!(regions(&right), ["elsewhere"]);
    assert!(points(&right).is_empty() && right.hard().is_empty());
    assert!(right.laws().is_empty() && right.proved().is_empty());
    let x = [1.5, 0.0];
    assert_eq!(right.solve(&x), own.solve(&x));
    assert_eq!(right.conditions(&x), own.conditions(&x));
    assert_eq!(right.signs_of_zero(&x), own.signs_of_zero(&x));
    assert_eq!(limits(&right), limits(&own));
    // A hunt stays where all admit it.
    let both = Variant::new(&right).placed(Vec::new(), |x| x[1] > 0.0);
    for (x, expected) in [
        ([1.0, 1.0], true),
        ([-1.0, 1.0], false),
        ([1.0, -1.0], false),
        ([-1.0, -1.0], false),
    ] {
        assert_eq!(both.admits(&x), expected, "{x:?}");
    }
}

#[test]
fn ordinary_numbers_alone() {
    let own = method();
    let ordinary = Variant::new(&own).ordinary();
    assert_eq!(regions(&ordinary), ["near", "next"]);
    assert_eq!(points(&ordinary), ["one"]);
    assert_eq!(shares(&ordinary), [2.0]);
}

#[test]
fn cases_of_a_box() {
    let own = method();
    let sides = SampleBox::read(&own, "x=1..2").unwrap();
    let sampling = Sampling::Box(sides);
    let boxed = Variant::new(&own).sampling(sampling.clone());
    assert_eq!(Method::sampling(&boxed), sampling);
    // A box of the method's own is kept.
    let own = Planted {
        sampling: sampling.clone(),
        ..method()
    };
    assert_eq!(Method::sampling(&Variant::new(&own)), sampling);
}

/// Proofs and records refer to the method's own format and budget.
#[test]
fn another_format_or_limit_has_nothing_recorded() {
    let own = method();
    let single = Variant::new(&own).format(Format::Single);
    assert_eq!(Method::format(&single), Format::Single);
    assert!(single.proved().is_empty() && single.laws().len() == 1);
    assert_eq!(shares(&single), [0.0, 0.0]);
    assert_eq!(single.norm_budget(), own.norm);
    let wide = Variant::new(&own).limit(Limit::Relative(1e-9));
    assert_eq!(wide.proved(), [PROVED]);
    assert_eq!(shares(&wide), [0.0, 0.0]);
    assert_eq!(wide.norm_budget(), None);
    let relative = Limit::Relative(1e-9);
    assert_eq!(limits(&wide), [("x", relative), ("y", relative)]);
    assert_eq!(Method::outputs(&wide)[0].budget.reason, AS_ASKED);
    let both = Variant::new(&own).limit(relative).format(Format::Single);
    assert_eq!(shares(&both), [0.0, 0.0]);
    // Inputs of the cases stay.
    let inputs: Vec<Vec<f64>> = wide.hard().into_iter().map(|h| h.input).collect();
    assert_eq!(inputs, [[1.5, 0.0], [1e-300, 0.0]]);
}

#[test]
fn other_hard_cases() {
    let own = method();
    let other = Variant::new(&own).hard_cases(vec![hard(3.0, "y", &[1.25, 0.0])]);
    assert_eq!(shares(&other), [3.0]);
    let none = Variant::new(&own).hard_cases(Vec::new());
    assert!(none.hard().is_empty());
    let region = Variant::new(&own)
        .hard_cases(vec![hard(3.0, "y", &[1.25, 0.0])])
        .region("near")
        .unwrap();
    assert!(region.hard().is_empty());
}

/// A limit on the norm takes the place of the outputs' own, and stands beside user-supplied ones.
#[test]
fn a_limit_of_the_norm() {
    let own = method();
    let r = 2f64.powi(-20);
    let norm = Variant::new(&own).norm_limit(r);
    let of_norm = Limit::OfNorm(r);
    assert_eq!(limits(&norm), [("x", of_norm), ("y", of_norm)]);
    let budget = norm.norm_budget().unwrap();
    assert_eq!((budget.factor, budget.reason), (2f64.powi(33), AS_ASKED));
    assert_eq!(shares(&norm), [0.0, 0.0]);
    let single = Variant::new(&own).norm_limit(r).format(Format::Single);
    assert_eq!(single.norm_budget().unwrap().factor, 16.0);
    let relative = Limit::Relative(1e-3);
    let both = Variant::new(&own).limit(relative).norm_limit(r);
    assert_eq!(limits(&both), [("x", relative), ("y", relative)]);
    assert_eq!(both.norm_budget().unwrap().factor, 2f64.powi(33));
    let one = Variant::new(&own).norm_limit(r).outputs(&["y"]).unwrap();
    assert_eq!(one.norm_budget().unwrap().factor, 2f64.powi(33));
}

/// Values, references, signs, conditions and twins of the selected outputs, row by row, and no norm
/// of all.
#[test]
fn selected_outputs() {
    let own = method();
    let one = Variant::new(&own).outputs(&["y"]).unwrap();
    assert_eq!(limits(&one), [OWN[1]]);
    assert_eq!(one.norm_budget(), None);
    assert_eq!(one.solve(&[1.5]), SolverAnswer::Values(vec![3.0, 6.0]));
    let reference = one.reference(&[], 64);
    assert_eq!(values(reference.clone()), [2.0, 4.0]);
    assert_eq!(shown(one.reference_not_finite(&[])), "nan -0");
    assert_eq!(one.signs_of_zero(&[]), [None, Some(true)]);
    assert_eq!(one.conditions(&[0.5]), Some(vec![10.0, 20.0]));
    // Those by the whole reference are not at hand.
    let beside = one.conditions_beside(&[0.5], &reference);
    assert_eq!(beside, Some(vec![10.0, 20.0]));
    assert_eq!(mids(&one.twin(&[]).unwrap()), [2.0, 4.0]);
    let first = Variant::new(&own).outputs(&["x"]).unwrap();
    assert_eq!(first.solve(&[1.5]), SolverAnswer::Values(vec![1.5, 4.5]));
    // In the method's order.
    let both = Variant::new(&own).outputs(&["y", "x"]).unwrap();
    assert_eq!(limits(&both), OWN);
    assert_eq!(values(both.reference(&[], 64)), [1.0, 2.0, 3.0, 4.0]);
    let e = Variant::new(&own).outputs(&["x", "z"]).err().unwrap();
    assert_eq!((e.what, e.name.as_str()), ("output", "z"));
    assert_eq!(e.known, ["x", "y"]);
}

#[test]
#[should_panic(expected = "a budget is finite and positive")]
fn a_limit_is_positive() {
    let own = method();
    let _ = Variant::new(&own).limit(Limit::Ulps(0.0));
}
