//! Tests of `recovery`.

use super::super::tables::printed;
use super::*;

#[test]
fn the_inertia_columns_give_s2_and_s4() {
    let model = Model::new();
    let which = [
        Parameter::Centre(0, 0),
        Parameter::Centre(2, 0),
        Parameter::Centre(2, 1),
    ];
    let r = model.recover(&printed(), &INERTIA_COLUMNS, &which);
    let s2 = r.get(Parameter::Centre(0, 0));
    assert!(
        (s2.value - 0.5).abs() < 4.0 * s2.deviation && s2.deviation < 1e-3,
        "{s2:?}"
    );
    let (x, y) = (
        r.get(Parameter::Centre(2, 0)),
        r.get(Parameter::Centre(2, 1)),
    );
    assert!((x.value.hypot(y.value) - 0.25).abs() < 1e-4);
    assert!((y.value.atan2(x.value).to_degrees() + 12.0).abs() < 0.02);
    assert!((0.8..1.3).contains(&r.misfit), "{}", r.misfit);
    assert_eq!(r.rank, 3);
    // s3 and s5 leave no trace in I_n.
    let blind = [Parameter::Centre(1, 0), Parameter::Centre(3, 0)];
    let all: Vec<Parameter> = which.into_iter().chain(blind).collect();
    assert_eq!(model.rank_at_recovered(&INERTIA_COLUMNS, &all), 3);
}

#[test]
fn the_moment_columns_add_s3_and_s5() {
    let which = [(0, 0), (1, 0), (2, 0), (2, 1), (3, 0)].map(|(i, k)| Parameter::Centre(i, k));
    let r = Model::new().recover_with_moment(&printed(), &which);
    assert!(
        (r.get(Parameter::Centre(1, 0)).value - 0.30).abs() < 0.01,
        "{r:?}"
    );
    assert!(
        (r.get(Parameter::Centre(3, 0)).value - 0.20).abs() < 0.01,
        "{r:?}"
    );
    assert_eq!(r.rank, 5);
}

#[test]
fn rounding_adds_no_rank() {
    let rank = |values: &[f64]| numerical_rank(&DVector::from_column_slice(values));
    assert_eq!(rank(&[4.0, 1.0, 4.1e-10]), 3);
    assert_eq!(rank(&[4.0, 1.0, 4e-10]), 2);
}
