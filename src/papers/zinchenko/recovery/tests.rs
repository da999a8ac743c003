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

#[test]
fn parameters_have_the_paper_s_names_and_units() {
    for (parameter, name, unit) in [
        (Parameter::Mass(0), "m2", ("kg", 1.0)),
        (Parameter::Inertia(3), "I5", ("kg m^2", 1.0)),
        (Parameter::Centre(1, 0), "s3 along the link", ("cm", 100.0)),
        (Parameter::Centre(2, 1), "s4 across the link", ("cm", 100.0)),
        (Parameter::Gravity, "g", ("m/s^2", 1.0)),
    ] {
        assert_eq!(
            (parameter.name().as_str(), parameter.shown_unit()),
            (name, unit)
        );
    }
}

/// The model is linear in a mass, in an inertia and in gravity: a step of any size is the
/// derivative times it.
#[test]
fn the_jacobian_is_the_model_s_slope() {
    let model = Model::new();
    let p = MassParameters::new(data::RECOVERED);
    let which = [
        Parameter::Mass(2),
        Parameter::Inertia(1),
        Parameter::Gravity,
    ];
    let j = model.jacobian(&p, &ALL_COLUMNS, &which);
    let here = model.columns(&p, &ALL_COLUMNS);
    assert_eq!((here.len(), j.shape()), (6 * TURN, (6 * TURN, 3)));
    for (k, parameter) in which.into_iter().enumerate() {
        let mut moved = p;
        *parameter.of(&mut moved) += 0.5;
        let off = model.columns(&moved, &ALL_COLUMNS) - &here - j.column(k) * 0.5;
        assert!(off.amax() < 1e-6, "{k}: {}", off.amax());
        assert!(j.column(k).amax() > 1e-3);
    }
    // Columns of I_n do not know gravity, those of M_o nothing else of a rocker than its weight.
    assert_eq!(j.column(2).rows(0, 4 * TURN).amax(), 0.0);
    assert_eq!(j.column(1).rows(4 * TURN, 2 * TURN).amax(), 0.0);
}

/// Half of them are smaller than the median, which is 0.6745 of a deviation.
#[test]
fn the_typical_size_is_a_median() {
    let sizes = DVector::from_column_slice(&[3.0 * 0.6745, -0.6745, 1e9, 0.0, -2.0 * 0.6745]);
    assert!((typical_size(&sizes) - 2.0).abs() < 1e-14);
}

/// With others known a parameter is determined by the norm of its column: two columns of ones and
/// of a fault each.
#[test]
fn what_is_known_alone_is_known_better_than_together() {
    let model = Model::new();
    let which = [
        Parameter::Mass(2),
        Parameter::Inertia(2),
        Parameter::Centre(2, 0),
    ];
    let scales = [1.0; 4];
    let found = model.identifiability(&printed(), &INERTIA_COLUMNS, &which, &scales);
    let doubled = model.identifiability(&printed(), &INERTIA_COLUMNS, &which, &[2.0; 4]);
    for (a, b) in found.iter().zip(&doubled) {
        assert!(
            a.alone > 0.0 && a.alone < a.together && a.together.is_finite(),
            "{a:?}"
        );
        assert!(
            (b.alone / a.alone - 2.0).abs() < 1e-9 && (b.together / a.together - 2.0).abs() < 1e-6
        );
    }
    assert_eq!(found[0].value, 550.0);
    assert_eq!(
        (found[1].value, found[2].value),
        (18.0, 0.25 * 12f64.to_radians().cos())
    );
}
